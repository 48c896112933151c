"""What is to be true of the meshes of cells that tribox voxelize writes, found from the cells alone."""

import collections
import functools
import itertools

import readers


def read(path):
    vertices, triangles, _ = readers.mesh(path)
    return list(map(tuple, vertices.tolist())), list(map(tuple, triangles.tolist()))


def faces(cells):
    """How many faces look along each axis, 0 to 2, up or down."""
    count = collections.Counter()
    for cell in cells:
        for axis, step in itertools.product(range(3), (-1, 1)):
            if tuple(x + step * (a == axis) for a, x in enumerate(cell)) not in cells:
                count[axis, step > 0] += 1
    return count


STEPS = tuple((1 << n, step) for n, step in enumerate(itertools.product((-1, 0, 1), repeat=3)))


@functools.lru_cache(None)
def groups(near):
    """How many groups there are, which hang together by faces, of cells around a part of them: a bit of STEPS for each."""
    left, count = {step for bit, step in STEPS if near & bit}, 0
    while left:
        count, reached = count + 1, [left.pop()]
        for cell in reached:
            beside = {other for other in left if sum(abs(a - b) for a, b in zip(cell, other)) == 2}
            left -= beside
            reached.extend(beside)
    return count


def euler(cells):
    """Of the surface: twice that of the body, of cells with their faces, edges and points; an edge or a point in which groups of
    cells touch is each group's own."""
    around = collections.defaultdict(int)  # each part of a cell, in halves of its side
    for x, y, z in cells:
        for bit, (i, j, k) in STEPS:
            around[2 * x + i, 2 * y + j, 2 * z + k] |= bit
    body = 0
    for part, near in around.items():
        sides = sum(x % 2 for x in part)  # 0 in the cell, 1 in a face, 2 in an edge, 3 in a point
        body += (1 if sides < 2 else groups(near)) * (1 if sides % 2 else -1)
    return 2 * body


def umbrellas(triangles):
    """Around how many vertices the triangles are not one ring."""
    links = collections.defaultdict(dict)
    for t in triangles:
        for n in range(3):
            links[t[n]][t[(n + 1) % 3]] = t[(n + 2) % 3]
    broken = 0
    for ring in links.values():
        first = at = next(iter(ring))
        steps = 0
        while at in ring and (steps == 0 or at != first):
            at, steps = ring[at], steps + 1
        broken += at != first or steps != len(ring)
    return broken


def check(vertices, triangles, cells):
    """All of it for cells of side 1 from 0, 0, 0 on. Returns nothing; what is wrong is an AssertionError."""
    edges = collections.Counter(edge for a, b, c in triangles for edge in ((a, b), (b, c), (c, a)))
    assert all(count == 1 and edges[b, a] == 1 for (a, b), count in edges.items()), "edges without their opposite"
    assert set(itertools.chain(*triangles)) == set(range(len(vertices))), "vertices of no triangle"
    assert umbrellas(triangles) == 0, "vertices where sheets touch"
    assert len(vertices) - len(edges) // 2 + len(triangles) == euler(cells), "Euler's count"
    volume, area = 0, collections.Counter()
    for triangle in triangles:
        p, q, r = (vertices[n] for n in triangle)
        u, v = [b - a for a, b in zip(p, q)], [b - a for a, b in zip(p, r)]
        normal = [u[(a + 1) % 3] * v[(a + 2) % 3] - u[(a + 2) % 3] * v[(a + 1) % 3] for a in range(3)]
        (axis,) = (a for a in range(3) if normal[a])
        area[axis, normal[axis] > 0] += abs(normal[axis]) / 2
        volume += p[axis] * normal[axis] / 2 if axis == 0 else 0
    assert area == faces(cells), "areas"
    assert volume == len(cells), "volume"
