"""Readers of the files of tribox voxelize, written from the descriptions of the formats, and the cells by exact clipping.

Each reader returns the sizes (nx, ny, nz) and the set of occupied cells (i, j, k).
"""

import ast
import math
import struct
import subprocess
import sys
import zlib
from fractions import Fraction

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


def read_vox(path):
    """MagicaVoxel: the chunk MAIN with one model, its size and a list of cells."""
    data = read(path)
    assert data[:8] == struct.pack("<4sI", b"VOX ", 150)
    assert data[8:20] == struct.pack("<4sII", b"MAIN", 0, len(data) - 20)
    assert data[20:32] == struct.pack("<4sII", b"SIZE", 12, 0)
    size = struct.unpack_from("<3I", data, 32)
    assert data[44:56] == struct.pack("<4sII", b"XYZI", len(data) - 56, 0)
    count = struct.unpack_from("<I", data, 56)[0]
    cells = [tuple(data[60 + 4 * n:64 + 4 * n]) for n in range(count)]
    assert len(data) == 60 + 4 * count and len(set(cells)) == count
    assert max(size) <= 256 and all(c == 1 and i < size[0] and j < size[1] and k < size[2] for i, j, k, c in cells)
    return size, {cell[:3] for cell in cells}


class Bytes:
    """Numbers, strings and masks one after the other."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, form):
        found = struct.unpack_from("<" + form, self.data, self.at)
        self.at += struct.calcsize("<" + form)
        return found if len(found) > 1 else found[0]

    def text(self):
        return self.take("%ds" % self.take("I")).decode()

    def bits(self, count):
        """The numbers of those that are set."""
        mask = int.from_bytes(self.take("%ds" % (count // 8)), "little")
        return [n for n in range(mask.bit_length()) if mask >> n & 1]


def read_vdb_node(data, corner, log2s, cells):
    """A node of 2^(log2 of its own and all below) cells along each axis, its children in the order of their numbers, z fastest."""
    own, below = log2s[0], sum(log2s[1:])
    children = data.bits(8 ** own)
    if below:
        assert not data.bits(8 ** own) and data.take("b") == 0  # no tile is active, and so no value is stored
    for n in children:
        place = n >> 2 * own, n >> own & (1 << own) - 1, n & (1 << own) - 1
        at = tuple(c + (p << below) for c, p in zip(corner, place))
        if below:
            read_vdb_node(data, at, log2s[1:], cells)
        else:
            assert at not in cells
            cells[at] = True


def without_vdb_id(written):
    """The bytes of such a file but for the random id, which is text of 36 letters."""
    return written[:21] + written[57:]


def read_vdb_masks(path):
    """OpenVDB 224, one MaskGrid. Returns its metadata, as (type, bytes), its transform in doubles, and the cells."""
    about, transform, cells, _ = read_vdb(path, "Tree_mask_5_4_3", "b")
    return about, transform, set(cells)


def read_vdb_numbers(path):
    """OpenVDB 224, one Int32Grid of -1. Returns the values of its active cells by their place."""
    _, _, cells, data = read_vdb(path, "Tree_int32_5_4_3", "i", -1)
    places = iter(cells)
    labels = {}
    while len(labels) < len(cells):
        count = len(data.bits(512))
        assert count and data.take("b") == 0  # of a leaf active values alone follow
        labels.update((next(places), data.take("i")) for _ in range(count))
    return labels


def read_vdb(path, tree, number, background=0):
    """Up to the values of leaves."""
    data, cells = Bytes(read(path)), {}
    assert data.take("qI") == (0x56444220, 224)
    data.take("II")
    has_offsets = data.take("b")
    data.take("36s")
    assert data.take("II") == (0, 1) and data.text() == "tribox" and data.text() == tree and data.text() == ""
    start, _, end = data.take("qqq")
    assert not has_offsets or (data.at == start and end == len(data.data))
    assert data.take("I") == 2  # active values alone, not compressed
    about = {}
    for _ in range(data.take("I")):
        name, kind = data.text(), data.text()
        about[name] = kind, data.take("%ds" % data.take("I"))
    assert data.text() in ("ScaleTranslateMap", "UniformScaleTranslateMap")
    transform = data.take("18d")
    assert data.take("I") == 1 and data.take(number) == background  # one buffer; the background
    tiles, children = data.take("II")
    assert tiles == 0
    for _ in range(children):
        read_vdb_node(data, data.take("iii"), (5, 4, 3), cells)
    return about, transform, cells, data


def float_of(number):
    return struct.unpack("<f", struct.pack("<f", number))[0]


def planes(grid, axis):
    """Rounded once, to the nearest double."""
    origin, cell = Fraction(grid["origin"][axis]), Fraction(grid["cell"][axis])
    return [float(origin + p * cell) for p in range(grid["size"][axis] + 1)]


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
    width, height, data = open_png(path)
    return width, height, unfilter(data, 3 * width, height)


def png_size(path):
    """Width and height of a file that is whole; its rows stay as they are stored, which is quick where they are many."""
    return open_png(path)[:2]


def open_png(path):
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
    rows = zlib.decompress(b"".join(c for n, c in parts if n == b"IDAT"))
    assert len(rows) == (3 * width + 1) * height
    return width, height, rows


def unfilter(data, stride, height):
    rows, above = [], bytes(stride)
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
