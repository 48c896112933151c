"""Writes triangles as mesh files, and knows the exact answer about them by clipping in rational numbers."""

import base64
import itertools
import json
import math
import random
import struct
from fractions import Fraction


def integers(numbers):
    """These numbers times one that makes them all integers, and that one."""
    ratios = [x.as_integer_ratio() for x in numbers]
    scale = math.lcm(*(q for _, q in ratios))
    return [p * (scale // q) for p, q in ratios], scale


def clip(points, plane):
    """The part of a convex polygon on the closed side a x + b y + c z <= d of a plane (a, b, c, d). A point is (x w, y w, z w, w)
    with any w > 0: all are integers."""
    a, b, c, d = plane
    kept = []
    depths = [d * w - a * x - b * y - c * z for x, y, z, w in points]
    for k, (p, depth) in enumerate(zip(points, depths)):
        q, depth_q = points[k - 1], depths[k - 1]
        if depth_q < 0 < depth or depth < 0 < depth_q:
            kept.append([abs(depth_q) * x + abs(depth) * y for x, y in zip(p, q)])
        if depth >= 0:
            kept.append(p)
    return kept


def planes_of(slabs):
    """slabs: (axis, least, most), the points p with least <= axis . p <= most. Two planes each."""
    for axis, least, most in slabs:
        (a, b, c, low, high), _ = integers([*axis, least, most])
        yield from ((-a, -b, -c, -low), (a, b, c, high))


def overlaps_planes(triangle, planes):
    numbers, scale = integers([x for vertex in triangle for x in vertex])
    points = [[*numbers[k:k + 3], scale] for k in (0, 3, 6)]
    for plane in planes:
        points = clip(points, plane)
    return bool(points)


def planes_of_box(box):
    return list(planes_of(((a == 0, a == 1, a == 2), box[a], box[3 + a]) for a in range(3)))


def overlaps(triangle, box):
    return overlaps_planes(triangle, planes_of_box(box))


def overlapping(triangles, box):
    planes = planes_of_box(box)
    return [i for i, triangle in enumerate(triangles) if overlaps_planes(triangle, planes)]


def overlapping_oriented(triangles, box):
    """box: the fifteen numbers of --oriented."""
    numbers = [Fraction(x) for x in box]
    center, half, slabs = numbers[:3], numbers[3:6], []
    for k in range(3):
        axis = numbers[6 + 3 * k:9 + 3 * k]
        middle = sum(x * y for x, y in zip(axis, center))
        slabs.append((axis, middle - half[k], middle + half[k]))
    planes = list(planes_of(slabs))
    return [i for i, triangle in enumerate(triangles) if overlaps_planes(triangle, planes)]


def inside(triangles, box):
    return [i for i, triangle in enumerate(triangles) if all(box[a] <= v[a] <= box[3 + a] for v in triangle for a in range(3))]


def lattice_triangles(count, seed):
    """Triangles in steps of 1/8, degenerate ones among them, so that text holds them exactly."""
    pick = random.Random(seed)
    triangles = []
    for _ in range(count):
        vertices = [tuple(pick.randint(-16, 16) / 8 for _ in range(3)) for _ in range(3)]
        if pick.random() < 0.1:
            vertices[2] = vertices[pick.randint(0, 1)]
        triangles.append(tuple(vertices))
    return triangles


def pack_floats(triangles, order="<"):
    """Nine floats a triangle: raw triangles, if they are little-endian."""
    return struct.pack("%s%df" % (order, 9 * len(triangles)), *(x for triangle in triangles for vertex in triangle for x in vertex))


def ply_header(format_name, vertices, faces, element="face", line_end="\n"):
    lines = ["ply", "format %s 1.0" % format_name, "comment made by a test", "element vertex %d" % vertices]
    lines += ["property float " + axis for axis in "xyz"]
    lines += ["element %s %d" % (element, faces), "property list uchar int vertex_indices", "end_header", ""]
    return line_end.join(lines).encode()


def ply_binary(triangles, big_endian=False, line_end="\n"):
    order = ">" if big_endian else "<"
    name = "binary_big_endian" if big_endian else "binary_little_endian"
    faces = b"".join(struct.pack(order + "B3i", 3, 3 * i, 3 * i + 1, 3 * i + 2) for i in range(len(triangles)))
    return ply_header(name, 3 * len(triangles), len(triangles), line_end=line_end) + pack_floats(triangles, order) + faces


def vertex_lines(triangles, before=""):
    return "".join(before + "%.9g %.9g %.9g\n" % tuple(vertex) for vertex in itertools.chain(*triangles))


def face_lines(triangles, before, first=0):
    return "".join("%s %d %d %d\n" % (before, 3 * i + first, 3 * i + first + 1, 3 * i + first + 2) for i in range(len(triangles)))


def ply_ascii(triangles):
    body = vertex_lines(triangles) + face_lines(triangles, "3")
    return ply_header("ascii", 3 * len(triangles), len(triangles)) + body.encode()


def obj(triangles):
    return (vertex_lines(triangles, "v ") + face_lines(triangles, "f", 1)).encode()


def off(triangles):
    header = "OFF\n# made by a test\n%d %d 0\n" % (3 * len(triangles), len(triangles))
    return (header + vertex_lines(triangles) + face_lines(triangles, "3")).encode()


def stl_binary(triangles, header=b"made by a test"):
    body = b"".join(struct.pack("<12x9f2x", *p, *q, *r) for p, q, r in triangles)
    return header.ljust(80, b" ") + struct.pack("<I", len(triangles)) + body


def stl_ascii(triangles):
    facets = "".join("facet normal 0 0 1\nouter loop\n" + vertex_lines([triangle], "vertex ") + "endloop\nendfacet\n"
                     for triangle in triangles)
    return ("solid test\n" + facets + "endsolid test\n").encode()


def gltf_document(triangles, nodes):
    """The JSON part and the binary part. Every node has mesh 0; those that are nobody's children are the scene's."""
    children = {child for node in nodes for child in node.get("children", [])}
    positions = pack_floats(triangles)
    indices = struct.pack("<%dI" % (3 * len(triangles)), *range(3 * len(triangles)))
    columns = list(zip(*itertools.chain(*triangles)))
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [i for i in range(len(nodes)) if i not in children]}],
        "nodes": [{"mesh": 0, **node} for node in nodes],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": len(positions) + len(indices)}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(positions)},
                        {"buffer": 0, "byteOffset": len(positions), "byteLength": len(indices)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3 * len(triangles), "type": "VEC3",
                       "min": [min(c) for c in columns], "max": [max(c) for c in columns]},
                      {"bufferView": 1, "componentType": 5125, "count": 3 * len(triangles), "type": "SCALAR"}]}
    return document, positions + indices


def gltf(triangles, nodes=({},)):
    document, data = gltf_document(triangles, nodes)
    document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    return json.dumps(document).encode()


def glb(triangles):
    document, data = gltf_document(triangles, [{}])
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


FORMATS = {
    "little.ply": ply_binary,
    "big.ply": lambda triangles: ply_binary(triangles, big_endian=True),
    "cr_lf.ply": lambda triangles: ply_binary(triangles, line_end="\r\n"),
    "cr.ply": lambda triangles: ply_binary(triangles, line_end="\r"),
    "ascii.ply": ply_ascii,
    "text.obj": obj,
    "text.off": off,
    "binary.stl": stl_binary,
    "solid.stl": lambda triangles: stl_binary(triangles, b"solid, and binary all the same"),
    "ascii.stl": stl_ascii,
    "raw.f32": pack_floats,
    "text.gltf": gltf,
    "binary.glb": glb,
}
