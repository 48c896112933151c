"""Meshes with colours, and readers of what tribox voxelize --colours writes; what is right is found from the triangles alone.

A colour is (red, green, blue) in bytes. Each reader of a file returns {cell: colour} or, of a mesh, triangles with a colour each.
"""

import itertools
import json
import math
import struct

import meshes
import volumes

GREY = (204, 204, 204)


def lowest(triangles, grid):
    """The lowest number of a triangle that overlaps each cell, one triangle after another, in rational numbers."""
    found = {}
    for number, triangle in enumerate(triangles):
        for cell in volumes.occupied([triangle], grid):
            found.setdefault(cell, number)
    return found


def mean(colours):
    """The nearest; a half goes up."""
    return tuple((2 * sum(c[a] for c in colours) + len(colours)) // (2 * len(colours)) for a in range(3))


def linear(byte):
    s = byte / 255
    return s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4


# PLY: of each type its letter for struct, and what a byte becomes.
TYPES = {"uchar": ("B", lambda byte: byte), "ushort": ("H", lambda byte: 257 * byte), "float": ("f", lambda byte: byte / 255),
         "double": ("d", lambda byte: byte / 255), "int": ("i", lambda byte: byte)}


def ply(vertices, polygons, vertex_colours=None, face_colours=None, kind="uchar", form="ascii", names=("red", "green", "blue"),
        faces_first=False):
    """The other properties around the colours are there to be passed over."""
    letter, scale = TYPES[kind]
    order = ">" if form == "binary_big_endian" else "<"
    records = {"vertex": [], "face": []}
    for n, vertex in enumerate(vertices):
        colour = [scale(byte) for byte in vertex_colours[n]] if vertex_colours else []
        records["vertex"].append((order + "f" + "3f" + "3" + letter if colour else order + "f3f", [7, *vertex, *colour]))
    for n, polygon in enumerate(polygons):
        colour = [scale(byte) for byte in face_colours[n]] if face_colours else []
        form_of_face = order + "B" + "%di" % len(polygon) + (("3" + letter) if colour else "") + "H"
        records["face"].append((form_of_face, [len(polygon), *polygon, *colour, 9]))
    colour_lines = ["property %s %s" % (kind, name) for name in names]
    about = {"vertex": ["property float confidence"] + ["property float " + axis for axis in "xyz"] + (colour_lines if vertex_colours else []),
             "face": ["property list uchar int vertex_indices"] + (colour_lines if face_colours else []) + ["property ushort flags"]}
    elements = ["face", "vertex"] if faces_first else ["vertex", "face"]
    head = ["ply", "format %s 1.0" % form]
    for element in elements:
        head += ["element %s %d" % (element, len(records[element])), *about[element]]
    body = b""
    for layout, numbers in itertools.chain(*(records[element] for element in elements)):
        body += (" ".join("%.17g" % x for x in numbers) + "\n").encode() if form == "ascii" else struct.pack(layout, *numbers)
    return ("\n".join(head + ["end_header"]) + "\n").encode() + body


def read_vox(path):
    """MagicaVoxel: a model, and a palette of which cells have the numbers, counted from 1."""
    data = volumes.read(path)
    assert data[:8] == struct.pack("<4sI", b"VOX ", 150) and data[8:20] == struct.pack("<4sII", b"MAIN", 0, len(data) - 20)
    at, chunks = 20, {}
    while at < len(data):
        name, size, children = struct.unpack_from("<4sII", data, at)
        assert children == 0 and name not in chunks
        chunks[name] = data[at + 12:at + 12 + size]
        at += 12 + size
    assert list(chunks) == [b"SIZE", b"XYZI", b"RGBA"] and len(chunks[b"RGBA"]) == 1024
    palette = list(struct.iter_unpack("<4B", chunks[b"RGBA"]))
    assert all(colour[3] == 255 for colour in palette)
    cells = list(struct.iter_unpack("<4B", chunks[b"XYZI"][4:]))
    assert all(c[3] >= 1 for c in cells) and struct.unpack("<I", chunks[b"XYZI"][:4]) == (len(cells),)
    return {c[:3]: palette[c[3] - 1][:3] for c in cells}


def read_ply(path):
    head, _, body = volumes.read(path).partition(b"end_header\n")
    lines = head.decode().splitlines()
    vertices, faces = (int(line.split()[2]) for line in lines if line.startswith("element"))
    assert lines[-4:] == ["property list uchar int vertex_indices", "property uchar red", "property uchar green", "property uchar blue"]
    assert len(body) == 24 * vertices + 16 * faces
    places = list(struct.iter_unpack("<3d", body[:24 * vertices]))
    for face in struct.iter_unpack("<B3i3B", body[24 * vertices:]):
        yield [places[n] for n in face[1:4]], face[4:]


def one_colour(corners, colours):
    assert len(set(colours)) == 1, colours
    return corners, colours[0]


def read_obj(path):
    places, colours = [], []
    for line in volumes.read(path).decode().splitlines():
        word, *values = line.split()
        if word == "v":
            assert len(values) == 6
            places.append(tuple(float(x) for x in values[:3]))
            colours.append(tuple(math.floor(255 * float(x) + 0.5) for x in values[3:]))
        elif word == "f":
            numbers = [int(x) - 1 for x in values]
            yield one_colour([places[n] for n in numbers], [colours[n] for n in numbers])


def read_glb(path):
    """Colours are linear there, in 16 bits: which byte they were is found by the nearest."""
    data = volumes.read(path)
    length, = struct.unpack_from("<I", data, 12)
    about, data = json.loads(data[20:20 + length]), data[28 + length:]
    position, number, colour = about["accessors"]
    vertices, triangles = about["bufferViews"]
    assert about["meshes"][0]["primitives"][0]["attributes"] == {"POSITION": 0, "COLOR_0": 2} and vertices["byteStride"] == 20
    assert (colour["componentType"], colour["type"], colour["normalized"], colour["byteOffset"]) == (5123, "VEC4", True, 12)
    assert colour["count"] == position["count"] and vertices["byteLength"] == 20 * position["count"] == triangles["byteOffset"]
    byte_of = {math.floor(65535 * linear(byte) + 0.5): byte for byte in range(256)}
    assert len(byte_of) == 256
    node = about["nodes"][0]
    corners = []
    for x, y, z, *rgba in struct.iter_unpack("<3f4H", data[:vertices["byteLength"]]):
        assert rgba[3] == 65535
        place = tuple(o + p * s for o, p, s in zip(node["translation"], (x, y, z), node["scale"]))
        corners.append((place, tuple(byte_of[c] for c in rgba[:3])))
    for triangle in struct.iter_unpack("<3I", data[triangles["byteOffset"]:]):
        yield one_colour([corners[n][0] for n in triangle], [corners[n][1] for n in triangle])


READERS = {".ply": read_ply, ".obj": read_obj, ".glb": read_glb}


def is_within(point, polygon):
    """Whether a point of a plane is in a triangle, or on its edge."""
    turns = []
    for n in range(3):
        (ax, ay), (bx, by) = polygon[n - 1], polygon[n]
        turns.append((bx - ax) * (point[1] - ay) - (by - ay) * (point[0] - ax))
    return all(t >= -1e-9 for t in turns) or all(t <= 1e-9 for t in turns)


def faces_of(triangles, grid):
    """The colours of each face of a cell, (cell, axis, is_up), by the triangles over its middle."""
    found = {}
    for corners, colour in triangles:
        places = [[(v[a] - grid["origin"][a]) / grid["cell"][a] for a in range(3)] for v in corners]
        u, v = ([b - a for a, b in zip(places[0], p)] for p in places[1:])
        normal = [u[(a + 1) % 3] * v[(a + 2) % 3] - u[(a + 2) % 3] * v[(a + 1) % 3] for a in range(3)]
        axis = max(range(3), key=lambda a: abs(normal[a]))
        others = [a for a in range(3) if a != axis]
        flat, plane, is_up = [[p[a] for a in others] for p in places], round(places[0][axis]), normal[axis] > 0
        spans = [range(math.floor(min(p[a] for p in places)), math.ceil(max(p[a] for p in places))) for a in others]
        for i, j in itertools.product(*spans):
            if is_within((i + 0.5, j + 0.5), flat):
                cell = [0, 0, 0]
                cell[axis], cell[others[0]], cell[others[1]] = plane - is_up, i, j
                found.setdefault((tuple(cell), axis, is_up), set()).add(tuple(colour))
    return found


def faces_expected(cells):
    """The same, from the colours of cells."""
    found = {}
    for cell, axis, step in itertools.product(cells, range(3), (-1, 1)):
        beside = tuple(x + step * (a == axis) for a, x in enumerate(cell))
        if beside not in cells:
            found[cell, axis, step > 0] = {cells[cell]}
    return found
