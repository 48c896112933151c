"""Prints the knot of tribox demo as an OBJ mesh, for bench/peers/run.py."""

from math import cos, pi, sin, sqrt

RINGS, CORNERS = 400, 60


def point(ring, corner):
    """As knot_point of tools/cmd_demo.c."""
    radius, swing, tube = 2, 0.85, 0.42
    t, turn = 2 * pi * ring / RINGS, 2 * pi * corner / CORNERS
    cp, sp, cq, sq = cos(2 * t), sin(2 * t), cos(3 * t), sin(3 * t)
    rho = radius + swing * cq
    center, outward = (rho * cp, rho * sp, swing * sq), (cq * cp, cq * sp, sq)
    along = (-3 * swing * sq * cp - 2 * rho * sp, -3 * swing * sq * sp + 2 * rho * cp, 3 * swing * cq)
    length = sqrt(sum(x * x for x in along))
    sideward = [(along[a - 2] * outward[a - 1] - along[a - 1] * outward[a - 2]) / length for a in range(3)]
    return tuple(center[a] + tube * (cos(turn) * outward[a] + sin(turn) * sideward[a]) for a in range(3))


def number(ring, corner):
    return ring % RINGS * CORNERS + corner % CORNERS + 1


for r in range(RINGS):
    for c in range(CORNERS):
        print("v %.7g %.7g %.7g" % point(r, c))
for r in range(RINGS):
    for c in range(CORNERS):
        print("f", number(r, c), number(r + 1, c), number(r + 1, c + 1), number(r, c + 1))
