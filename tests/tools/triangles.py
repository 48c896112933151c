"""Writes triangles as mesh files, and knows the exact answer about them by separating axes in whole numbers of any size."""

import base64
import json
import math
import random
import struct
from fractions import Fraction

import numpy as np

NAN, INF = math.nan, math.inf


def integers(*arrays):
    """The finite numbers of these arrays times one that makes them all integers: of 64 bits where products of three fit, else of
    Python's."""
    ratios = [[float(x).as_integer_ratio() for x in np.ravel(array)] for array in arrays]
    scale = max(q for row in ratios for _, q in row)
    rows = [[p * (scale // q) for p, q in row] for row in ratios]
    kind = np.int64 if max(abs(n) for row in rows for n in row) < 1 << 17 else object
    return [np.array(row, kind).reshape(np.shape(array)) for row, array in zip(rows, arrays)]


def touching(v, lo, hi):
    """Whether triangles (..., 3, 3) and boxes, all of integers, have a point in common: none of the thirteen axes parts them."""
    v, h = 2 * v - (lo + hi)[..., None, :], hi - lo
    apart = ((v.min(-2) > h) | (v.max(-2) < -h) | (h < 0)).any(-1)
    f = np.roll(v, -1, -2) - v
    n = np.stack([f[..., 0, a - 2] * f[..., 1, a - 1] - f[..., 0, a - 1] * f[..., 1, a - 2] for a in range(3)], -1)
    apart |= abs((n * v[..., 0, :]).sum(-1)) > (abs(n) * h).sum(-1)
    for a in range(3):
        b, c = a - 2, a - 1
        for j in range(3):
            along = v[..., b] * f[..., j, c, None] - v[..., c] * f[..., j, b, None]
            reach = h[..., b] * abs(f[..., j, c]) + h[..., c] * abs(f[..., j, b])
            apart |= (along.min(-1) > reach) | (along.max(-1) < -reach)
    return ~apart


def overlapping(triangles, box):
    """The numbers of those that overlap a box of six or of fifteen numbers; none with NaN or infinity does."""
    t = np.array(triangles, float).reshape(-1, 3, 3)
    finite = np.flatnonzero(np.isfinite(t).all((1, 2)))
    if not len(finite):
        return []
    if len(box) == 15:
        (v, center, half), (axes, one) = integers(t[finite], box[:3], box[3:6]), integers(np.reshape(box[6:], (3, 3)), 1.0)
        v = ((v - center)[:, :, None, :].astype(object) * axes).sum(-1)
        return finite[touching(v, -half * one, half * one)].tolist()
    v, box = integers(t[finite], box)
    return finite[touching(v, box[None, :3], box[None, 3:])].tolist()


def inside(triangles, box):
    t = np.array(triangles, float).reshape(-1, 3, 3)
    return np.flatnonzero(((t >= box[:3]) & (t <= box[3:])).all((1, 2))).tolist()


def planes(grid, axis):
    """Rounded once, to the nearest double."""
    origin, cell = Fraction(grid["origin"][axis]), Fraction(grid["cell"][axis])
    return np.array([float(origin + p * cell) for p in range(grid["size"][axis] + 1)])


def lowest(triangles, grid):
    """Of each cell [k, j, i] the lowest number of a triangle that overlaps it, or -1."""
    cells, bounds = np.full(grid["size"][::-1], -1, np.int32), [planes(grid, a) for a in range(3)]
    t = np.array(triangles, float).reshape(-1, 3, 3)
    finite = np.isfinite(t).all((1, 2))
    whole = integers(np.where(finite[:, None, None], t, 0), *bounds)
    for n in np.flatnonzero(finite)[::-1]:
        low, high = t[n].min(0), t[n].max(0)
        near = [np.arange(max(np.searchsorted(b, low[a]) - 1, 0), min(np.searchsorted(b, high[a], "right"), len(b) - 1))
                for a, b in enumerate(bounds)]
        k, j, i = (index.ravel() for index in np.meshgrid(*near[::-1], indexing="ij"))
        if not len(i):
            continue
        lo, hi = (np.stack([b[index + s] for b, index in zip(whole[1:], (i, j, k))], -1) for s in (0, 1))
        hit = touching(np.broadcast_to(whole[0][n], (len(i), 3, 3)), lo, hi)
        cells[k[hit], j[hit], i[hit]] = n
    return cells


def occupied(triangles, grid):
    return lowest(triangles, grid) >= 0


def floats(triangles):
    return np.array(triangles, np.float32).astype(float)


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


FAR = (557820.125, 5108010.25, 812.5)  # UTM, and a height


def far_triangles(count, seed):
    """In steps of a tenth around a place far away, which no double holds exactly; degenerate ones among them."""
    pick = np.random.default_rng(seed)
    triangles = np.array(FAR) + pick.integers(-20, 21, (count, 3, 3)) / 10
    triangles[::10, 2] = triangles[::10, 1]
    return triangles


def cube(low, high):
    """Twelve triangles that close a box."""
    corners = [tuple((high if n >> a & 1 else low)[a] for a in range(3)) for n in range(8)]
    faces = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    return [tuple(corners[n] for n in three) for a, b, c, d in faces for three in ((a, b, c), (a, c, d))]


def pack_floats(triangles, kind="<f4"):
    """Nine numbers a triangle: raw triangles, if they are little-endian."""
    return np.array(triangles, kind).tobytes()


def pack_doubles(triangles):
    return pack_floats(triangles, "<f8")


# PLY of any elements: (name, properties, records); a property is (name, type) or, of a list, (name, type of the count, type).
LETTERS = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f", "double": "d"}
NAMES = {"int16": "short", "uint16": "ushort", "uint32": "uint"}


def letter(kind):
    return LETTERS[NAMES.get(kind, kind)]


def words_of(record):
    for value in record:
        yield from map(repr, [len(value), *value] if isinstance(value, (list, tuple)) else [value])


def ply(elements, form="binary_little_endian", line_end="\n", comments=("comment made by a test",), after=""):
    """after: what each number has after its line's words, where the form is text."""
    head, body, order = ["ply", "format %s 1.0" % form, *comments], [], ">" if "big" in form else "<"
    for element, properties, records in elements:
        head.append("element %s %d" % (element, len(records)))
        head += ["property " + " ".join((["list"] if len(types) == 2 else []) + [*types, name]) for name, *types in properties]
        for record in records:
            if form == "ascii":
                body.append((" ".join(words_of(record)) + after + line_end).encode())
                continue
            for value, (_, *types) in zip(record, properties):
                many = value if len(types) == 2 else [value]
                body.append(struct.pack(order + letter(types[0]), len(value)) if len(types) == 2 else b"")
                body.append(struct.pack("%s%d%s" % (order, len(many), letter(types[-1])), *many))
    return (line_end.join(head + ["end_header"]) + line_end).encode() + b"".join(body)


XYZ = [("x", "float"), ("y", "float"), ("z", "float")]
CORNERS = [("vertex_indices", "uchar", "int")]


def ply_of(triangles, form="binary_little_endian", line_end="\n", kind="float"):
    vertices = np.array(triangles, float).reshape(-1, 3).tolist()
    faces = [[range_of] for range_of in np.arange(len(vertices)).reshape(-1, 3).tolist()]
    return ply([("vertex", [(name, kind) for name, _ in XYZ], vertices), ("face", CORNERS, faces)], form, line_end)


def ply_text(vertices, faces="3 0 1 2\n", counts=None, **replaced):
    """By text as it stands; keywords are words of the header and what stands in their place."""
    count = counts or (vertices.count("\n"), faces.count("\n"))
    head = ply([("vertex", XYZ, [0] * 0), ("face", CORNERS, [])], "ascii").decode()
    head = head.replace("vertex 0", "vertex %s" % count[0]).replace("face 0", "face %s" % count[1])
    for old, new in replaced.items():
        head = head.replace(old, new)
    return head + vertices + faces


def lines_of(triangles, before=""):
    return "".join(before + "%r %r %r\n" % tuple(vertex) for vertex in np.array(triangles, float).reshape(-1, 3).tolist())


def face_lines(count, before, first=0):
    return "".join("%s %d %d %d\n" % (before, n, n + 1, n + 2) for n in range(first, 3 * count + first, 3))


def obj(triangles):
    return (lines_of(triangles, "v ") + face_lines(len(triangles), "f", 1)).encode()


def off(triangles):
    header = "OFF\n# made by a test\n%d %d 0\n" % (3 * len(triangles), len(triangles))
    return (header + lines_of(triangles) + face_lines(len(triangles), "3")).encode()


def stl_binary(triangles, header=b"made by a test"):
    records = np.zeros(len(triangles), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
    records["corners"] = np.array(triangles, np.float32).reshape(-1, 3, 3)
    return header.ljust(80, b" ") + struct.pack("<I", len(triangles)) + records.tobytes()


def stl_ascii(triangles):
    facet = "facet normal 0 0 1\nouter loop\n%sendloop\nendfacet\n"
    facets = "".join(facet % lines_of(triangle, "vertex ") for triangle in triangles)
    return ("solid test\n" + facets + "endsolid test\n").encode()


def gltf_document(triangles, nodes=({},)):
    """The JSON part and the binary part. Every node has mesh 0; those that are nobody's children are the scene's."""
    children = {child for node in nodes for child in node.get("children", [])}
    vertices = np.array(triangles, "<f4").reshape(-1, 3)
    data, count = vertices.tobytes(), len(vertices)
    return {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [i for i in range(len(nodes)) if i not in children]}],
        "nodes": [{"mesh": 0, **node} for node in nodes],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": 16 * count}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 12 * count},
                        {"buffer": 0, "byteOffset": 12 * count, "byteLength": 4 * count}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3",
                       "min": vertices.min(0).tolist(), "max": vertices.max(0).tolist()},
                      {"bufferView": 1, "componentType": 5125, "count": count, "type": "SCALAR"}],
    }, data + np.arange(count, dtype="<u4").tobytes()


def in_text(document, data):
    """A glTF file that holds its buffer."""
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    document["buffers"] = [{"byteLength": len(data), "uri": uri}]
    return json.dumps(document).encode()


def gltf(triangles, nodes=({},)):
    return in_text(*gltf_document(triangles, nodes))


def glb(triangles):
    document, data = gltf_document(triangles)
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


FORMATS = {
    "little.ply": ply_of,
    "big.ply": lambda triangles: ply_of(triangles, "binary_big_endian"),
    "cr_lf.ply": lambda triangles: ply_of(triangles, line_end="\r\n"),
    "cr.ply": lambda triangles: ply_of(triangles, line_end="\r"),
    "ascii.ply": lambda triangles: ply_of(triangles, "ascii"),
    "text.obj": obj,
    "text.off": off,
    "binary.stl": stl_binary,
    "solid.stl": lambda triangles: stl_binary(triangles, b"solid, and binary all the same"),
    "ascii.stl": stl_ascii,
    "raw.f32": pack_floats,
    "text.gltf": gltf,
    "binary.glb": glb,
}
FORMATS_OF_DOUBLES = {
    **{form + ".ply": lambda triangles, form=form: ply_of(triangles, form, kind="double")
       for form in ("ascii", "binary_little_endian", "binary_big_endian")},
    "text.obj": obj, "text.off": off, "ascii.stl": stl_ascii, "raw.f64": pack_doubles}
