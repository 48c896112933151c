"""Readers of the files of tribox voxelize, written from the descriptions of the formats, and the cells by exact clipping.

Each reader returns the sizes (nx, ny, nz) and the set of occupied cells (i, j, k).
"""

import ast
import math
import struct
import subprocess
import sys
import zlib

import meshes


def read(path):
    with open(path, "rb") as file:
        return file.read()


def read_npy(path):
    """Version 1.0: magic, version, length of the text, a Python dict, then the array; bytes 0 and 1 are bools."""
    data = read(path)
    assert data[:8] == b"\x93NUMPY\x01\x00"
    start = 10 + struct.unpack_from("<H", data, 8)[0]
    assert start % 64 == 0 and data[start - 1:start] == b"\n"
    about = ast.literal_eval(data[10:start].decode("ascii"))
    assert sorted(about) == ["descr", "fortran_order", "shape"]
    assert about["descr"] == "|b1" and about["fortran_order"] is False
    nz, ny, nx = about["shape"]
    cells = data[start:]
    assert len(cells) == nx * ny * nz and set(cells) <= {0, 1}
    return (nx, ny, nz), {(n % nx, n // nx % ny, n // nx // ny) for n, value in enumerate(cells) if value}


def read_raw(path, size):
    """Words of 64 cells, each row of cells along x starts with a word; little-endian, the low bit first."""
    nx, ny, nz = size
    row = (nx + 63) // 64
    data = read(path)
    words = struct.unpack("<%dQ" % (row * ny * nz), data)
    cells = set()
    for n, word in enumerate(words):
        for bit in range(64):
            if word >> bit & 1:
                cells.add((n % row * 64 + bit, n // row % ny, n // row // ny))
    assert all(i < nx for i, j, k in cells)
    return size, cells


def read_binvox(path):
    """Also returns translate and scale. Runs of (value, count); y runs fastest, then z, then x."""
    data = read(path)
    lines = data.split(b"\n", 5)
    assert lines[0] == b"#binvox 1" and lines[4] == b"data"
    words = [line.split() for line in lines[1:4]]
    assert [w[0] for w in words] == [b"dim", b"translate", b"scale"]
    depth, height, width = (int(n) for n in words[0][1:])
    assert depth == height == width
    runs, cells, n = lines[5], set(), 0
    assert len(runs) % 2 == 0
    for value, count in zip(runs[::2], runs[1::2]):
        assert value in (0, 1) and count > 0
        if value:
            cells.update((m // width // width, m % width, m // width % width) for m in range(n, n + count))
        n += count
    assert n == depth ** 3
    return (width,) * 3, cells, [float(x) for x in words[1][1:]], float(words[2][1])


def chunks(data):
    """The chunks of a RIFF-like file one after the other, children behind their parent: (id, content)."""
    at = 0
    while at < len(data):
        name, content, children = data[at:at + 4].decode(), *struct.unpack_from("<II", data, at + 4)
        at += 12
        yield name, data[at:at + content]
        at += content
    assert at == len(data)


class Fields:
    def __init__(self, data):
        self.data, self.at = data, 0

    def number(self):
        self.at += 4
        return struct.unpack_from("<i", self.data, self.at - 4)[0]

    def string(self):
        length = self.number()
        self.at += length
        return self.data[self.at - length:self.at].decode()

    def dictionary(self):
        return {self.string(): self.string() for _ in range(self.number())}

    def end(self):
        assert self.at == len(self.data)


def read_vox_places(nodes):
    """Walks the scene graph from node 0. Returns for each model its translation."""
    places = {}

    def walk(node, at):
        kind, value = nodes[node]
        if kind == "nTRN":
            child, move = value
            walk(child, [a + b for a, b in zip(at, move)])
        elif kind == "nGRP":
            for child in value:
                walk(child, at)
        else:
            assert value not in places
            places[value] = at
    walk(0, [0, 0, 0])
    return places


def read_node(name, fields, nodes):
    node = fields.number()
    assert fields.dictionary() == {} and node not in nodes
    if name == "nTRN":
        child, reserved, _, frames = (fields.number() for _ in range(4))
        assert reserved == -1 and frames == 1
        nodes[node] = name, (child, [int(n) for n in fields.dictionary().get("_t", "0 0 0").split()])
    elif name == "nGRP":
        nodes[node] = name, [fields.number() for _ in range(fields.number())]
    else:
        assert fields.number() == 1
        nodes[node] = name, fields.number()
        assert fields.dictionary() == {}
    fields.end()


def read_vox(path):
    """MagicaVoxel: models of at most 256 cells a side. A translation moves the cell at size // 2 of its model.

    Cells are counted from the lowest corner of all models."""
    data = read(path)
    assert data[:4] == b"VOX " and struct.unpack_from("<I", data, 4)[0] == 150
    assert data[8:12] == b"MAIN" and struct.unpack_from("<II", data, 12) == (0, len(data) - 20)
    sizes, models, nodes = [], [], {}
    for name, content in chunks(data[20:]):
        if name == "SIZE":
            sizes.append(struct.unpack("<3I", content))
            assert max(sizes[-1]) <= 256
        elif name == "XYZI":
            count = struct.unpack_from("<I", content)[0]
            assert len(content) == 4 + 4 * count and set(content[7::4]) <= {1}
            models.append({tuple(content[4 + 4 * n:7 + 4 * n]) for n in range(count)})
            assert len(models[-1]) == count
        else:
            read_node(name, Fields(content), nodes)
    places = read_vox_places(nodes) if nodes else {0: [n // 2 for n in sizes[0]]}
    assert sorted(places) == list(range(len(models))) == list(range(len(sizes)))
    corners = [[t - n // 2 for t, n in zip(places[m], sizes[m])] for m in range(len(models))]
    lowest = [min(corner[a] for corner in corners) for a in range(3)]
    size = tuple(max(c[a] + n[a] for c, n in zip(corners, sizes)) - lowest[a] for a in range(3))
    cells = set()
    for corner, model in zip(corners, models):
        assert all(x < n for cell in model for x, n in zip(cell, sizes[corners.index(corner)]))
        cells.update(tuple(x + c - low for x, c, low in zip(cell, corner, lowest)) for cell in model)
    return size, cells


def float_of(number):
    return struct.unpack("<f", struct.pack("<f", number))[0]


def planes(grid, axis):
    return [float_of(grid["origin"][axis] + p * grid["cell"][axis]) for p in range(grid["size"][axis] + 1)]


def single_floats(grid):
    """The grid as --json prints it, its decimals taken for the floats that they stand for."""
    return {"origin": [float_of(x) for x in grid["origin"]], "cell": [float_of(x) for x in grid["cell"]], "size": grid["size"]}


def occupied(triangles, grid):
    """The cells that some triangle overlaps, in rational numbers."""
    bounds = [planes(grid, axis) for axis in range(3)]
    cells = set()
    for triangle in triangles:
        near = [[n for n in range(grid["size"][a]) if bounds[a][n] <= max(v[a] for v in triangle)
                 and bounds[a][n + 1] >= min(v[a] for v in triangle)] for a in range(3)]
        for i in near[0]:
            for j in near[1]:
                for k in near[2]:
                    at = (i, j, k)
                    if at not in cells and meshes.overlaps(triangle, [bounds[a][at[a] + s] for s in (0, 1) for a in range(3)]):
                        cells.add(at)
    return cells


def python_with_numpy():
    """A Python that has NumPy: this one, or Debian's own; None if there is none."""
    for python in (sys.executable, "/usr/bin/python3"):
        try:
            if not subprocess.run([python, "-c", "import numpy"], capture_output=True).returncode:
                return python
        except OSError:
            pass
    return None


def read_png(path):
    """Width, height and rows of (red, green, blue), of an 8-bit RGB file."""
    data = read(path)
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, parts = 8, []
    while at < len(data):
        length, name = struct.unpack_from(">I4s", data, at)
        content = data[at + 8:at + 8 + length]
        assert struct.unpack_from(">I", data, at + 8 + length)[0] == zlib.crc32(name + content)
        parts.append((name, content))
        at += 12 + length
    assert parts[0][0] == b"IHDR" and parts[-1] == (b"IEND", b"")
    width, height, depth, colour, compression, filters, interlace = struct.unpack(">IIBBBBB", parts[0][1])
    assert (depth, colour, compression, filters, interlace) == (8, 2, 0, 0, 0)
    return width, height, unfilter(zlib.decompress(b"".join(c for n, c in parts if n == b"IDAT")), 3 * width, height)


def unfilter(data, stride, height):
    rows, above = [], bytes(stride)
    assert len(data) == (stride + 1) * height
    for y in range(height):
        kind, row = data[y * (stride + 1)], bytearray(data[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for x in range(stride if kind else 0):
            left, up, corner = row[x - 3] if x >= 3 else 0, above[x], above[x - 3] if x >= 3 else 0
            guess = left + up - corner
            row[x] = row[x] + (left if kind == 1 else up if kind == 2 else (left + up) // 2 if kind == 3 else
                               min((left, up, corner), key=lambda p: abs(guess - p))) & 255
        rows.append(bytes(row))
        above = rows[-1]
    return rows


def side_of(size):
    """The side of the cube that .binvox fills a grid up to."""
    return max(size)


def is_close(a, b):
    return math.isclose(a, b, rel_tol=1e-6)
