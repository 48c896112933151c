"""Makes a mesh with materials: scene.py writes scene.obj and scene.mtl, a knot over a chequered board, into the current folder.

    python3 scene.py
    tribox voxelize scene.obj --resolution 200 --colours -o scene.vox --preview scene.png --up z
"""

import math

MATERIALS = {"light": (0.93, 0.90, 0.82), "dark": (0.22, 0.26, 0.33), "rim": (0.55, 0.35, 0.2)}
STRIPES = [(0.86, 0.16, 0.16), (0.96, 0.55, 0.10), (0.98, 0.85, 0.20), (0.30, 0.68, 0.30), (0.16, 0.52, 0.80), (0.45, 0.28, 0.66)]
MATERIALS.update(("stripe%d" % n, colour) for n, colour in enumerate(STRIPES))


def knot(t):
    """Where the middle of the tube is: twice around the axis and three times around the ring."""
    r = 2 + 0.8 * math.cos(3 * t)
    return r * math.cos(2 * t), r * math.sin(2 * t), 0.9 * math.sin(3 * t) + 1.75


def cross(a, b):
    return tuple(a[(n + 1) % 3] * b[(n + 2) % 3] - a[(n + 2) % 3] * b[(n + 1) % 3] for n in range(3))


def unit(a):
    length = math.sqrt(sum(x * x for x in a))
    return tuple(x / length for x in a)


def tube(steps=720, around=36, radius=0.48):
    """Vertices ring after ring, and faces of four with a material each: a stripe winds about the tube."""
    vertices, faces = [], []
    for i in range(steps):
        t = 2 * math.pi * i / steps
        here, next_one = knot(t), knot(t + 1e-3)
        along = unit(tuple(b - a for a, b in zip(here, next_one)))
        side = unit(cross(along, (0, 0, 1)))
        up = cross(side, along)
        for j in range(around):
            a = 2 * math.pi * j / around
            vertices.append(tuple(here[n] + radius * (math.cos(a) * side[n] + math.sin(a) * up[n]) for n in range(3)))
            corners = [(i + di) % steps * around + (j + dj) % around for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1))]
            faces.append(("stripe%d" % ((6 * j // around + 18 * i // steps) % 6), corners))
    return vertices, faces


def board(squares=8, side=0.9):
    """The squares lie beside each other; a rim of four faces closes the edge below them."""
    half, vertices, faces = squares * side / 2, [], []

    def square(material, *corners):
        faces.append((material, range(len(vertices), len(vertices) + 4)))
        vertices.extend(corners)

    for i in range(squares):
        for j in range(squares):
            x, y = i * side - half, j * side - half
            square("dark" if (i + j) % 2 else "light", (x, y, 0), (x + side, y, 0), (x + side, y + side, 0), (x, y + side, 0))
    edge = [(-half, -half), (half, -half), (half, half), (-half, half)]
    for (x, y), (u, v) in zip(edge, edge[1:] + edge[:1]):
        square("rim", (x, y, -0.3), (u, v, -0.3), (u, v, 0), (x, y, 0))
    return vertices, faces


def main():
    with open("scene.mtl", "w") as file:
        for name, colour in MATERIALS.items():
            file.write("newmtl %s\nKd %g %g %g\n" % (name, *colour))
    with open("scene.obj", "w") as file:
        file.write("mtllib scene.mtl\n")
        first = 1
        for vertices, faces in (board(), tube()):
            file.writelines("v %.6f %.6f %.6f\n" % vertex for vertex in vertices)
            for material in MATERIALS:
                file.write("usemtl %s\n" % material)
                file.writelines("f %d %d %d %d\n" % tuple(first + n for n in corners) for name,
                                corners in faces if name == material)
            first += len(vertices)


if __name__ == "__main__":
    main()
