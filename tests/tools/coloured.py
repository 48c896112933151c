"""Meshes with colours, and readers of what tribox voxelize --colours writes; what is right is found from the triangles alone.

A colour is (red, green, blue) in bytes. Each reader of a file returns {cell: colour} or, of a mesh, triangles with a colour each.
"""

import itertools
import math
import struct

import numpy as np
import readers
import triangles as meshes

GREY = (204, 204, 204)


def lowest(triangles, grid):
    """The lowest number of a triangle that overlaps each cell (i, j, k)."""
    cells = meshes.lowest(triangles, grid)
    return {(int(i), int(j), int(k)): int(cells[k, j, i]) for k, j, i in np.argwhere(cells >= 0)}


def mean(colours):
    """The nearest; a half goes up."""
    return tuple((2 * sum(c[a] for c in colours) + len(colours)) // (2 * len(colours)) for a in range(3))


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


def triangles_of(path):
    """The corners of each, and its colour."""
    vertices, triangles, colours = readers.mesh(path)
    return [] if colours is None else list(zip(vertices[triangles].tolist(), map(tuple, colours.tolist())))


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
