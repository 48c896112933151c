"""Readers of the meshes of cells that tribox voxelize writes, and what is to be true of them, found from the cells alone.

Each reader returns vertices (x, y, z) and triangles of three numbers of vertices.
"""

import collections
import functools
import itertools
import json
import struct

import volumes


def read_ply(path):
    head, _, body = volumes.read(path).partition(b"end_header\n")
    lines = [line for line in head.decode().split("\n") if not line.startswith("comment")]
    count = [int(line.split()[2]) for line in lines if line.startswith("element")]
    assert lines == ["ply", "format binary_little_endian 1.0", "element vertex %d" % count[0], "property double x",
                     "property double y", "property double z", "element face %d" % count[1],
                     "property list uchar int vertex_indices", ""]
    assert len(body) == 24 * count[0] + 13 * count[1]
    faces = list(struct.iter_unpack("<B3i", body[24 * count[0]:]))
    assert all(face[0] == 3 for face in faces)
    return list(struct.iter_unpack("<3d", body[:24 * count[0]])), [face[1:] for face in faces]


def read_obj(path):
    found = {"v": [], "f": []}
    for line in volumes.read(path).decode().splitlines():
        word, *values = line.split()
        if word != "#":
            assert len(values) == 3
            found[word].append(tuple(float(x) if word == "v" else int(x) - 1 for x in values))
    return found["v"], found["f"]


def read_glb_parts(path):
    """The JSON and the bytes behind it, as the specification has it."""
    data = volumes.read(path)
    assert struct.unpack_from("<4sII", data) == (b"glTF", 2, len(data)) and len(data) % 4 == 0
    length, kind = struct.unpack_from("<I4s", data, 12)
    assert kind == b"JSON" and length % 4 == 0
    about, rest = json.loads(data[20:20 + length]), data[20 + length:]
    assert about["asset"]["version"] == "2.0"
    if rest:
        assert struct.unpack_from("<I4s", rest) == (len(rest) - 8, b"BIN\0") and about["buffers"] == [{"byteLength": len(rest) - 8}]
    return about, rest[8:]


def read_glb(path):
    """Also places the vertices, in doubles."""
    about, data = read_glb_parts(path)
    assert about["scene"] == 0
    if not data:
        assert about["scenes"] == [{}] and "meshes" not in about
        return [], []
    (node,), (view, indices) = about["nodes"], about["bufferViews"]
    assert about["scenes"] == [{"nodes": [0]}] and (view["target"], indices["target"]) == (34962, 34963)
    positions, numbers = about["accessors"]
    assert about["meshes"] == [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}]
    assert (positions["componentType"], positions["type"], numbers["componentType"], numbers["type"]) == (5126, "VEC3", 5125, "SCALAR")
    assert view["byteLength"] == 12 * positions["count"] and indices["byteLength"] == 4 * numbers["count"]
    assert view["byteLength"] == indices["byteOffset"] and indices["byteOffset"] + indices["byteLength"] == len(data)
    vertices = list(struct.iter_unpack("<3f", data[:indices["byteOffset"]]))
    assert positions["min"] == [min(v[a] for v in vertices) for a in range(3)]
    assert positions["max"] == [max(v[a] for v in vertices) for a in range(3)]
    placed = [tuple(o + x * s for o, x, s in zip(node["translation"], v, node["scale"])) for v in vertices]
    return placed, list(struct.iter_unpack("<3I", data[indices["byteOffset"]:]))


READERS = {".ply": read_ply, ".obj": read_obj, ".glb": read_glb}


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
