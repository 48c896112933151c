"""Readers of what tribox voxelize writes, from the descriptions of the formats.

read(path, size) returns a number for each cell [k, j, i], 0 where there is none or, of ids, -1; and the grid as far as the file
says where it is: origin, cell and size. mesh(path) reads faces of cells, palette(path) colours.
"""

import ast
import json
import re
import struct
import zipfile
import zlib

import numpy as np
from harness import read as content_of


def read(path, size=None, what="bits"):
    """what: bits, labels or ids, which some formats do not say. size: of .raw, which says nothing, (nx, ny, nz)."""
    return globals()["read_" + path.rpartition(".")[2]](path, size, what)


def npy(data):
    """Version 1.0: magic, version, length of the text, a Python dict, then the array."""
    assert data[:8] == b"\x93NUMPY\x01\x00"
    start = 10 + struct.unpack_from("<H", data, 8)[0]
    assert start % 64 == 0 and data[start - 1:start] == b"\n"
    about = ast.literal_eval(data[10:start].decode("ascii"))
    assert sorted(about) == ["descr", "fortran_order", "shape"] and about["fortran_order"] is False
    return np.frombuffer(data[start:], about["descr"]).reshape(about["shape"])


def places_of(path):
    """Of the cells that are set, (i, j, k) each."""
    return set(map(tuple, np.argwhere(read(path)[0])[:, ::-1].tolist()))


def checked(cells, what):
    assert cells.dtype == {"bits": np.dtype(bool), "labels": np.dtype("u1"), "ids": np.dtype("<i4")}[what]
    if what == "bits":
        assert set(np.unique(cells.view("u1"))) <= {0, 1}
    return cells


def read_npy(path, size, what):
    """The array of all cells, or the coordinates of those that are set."""
    array = npy(content_of(path))
    if array.shape[1:] != (3,) or array.ndim != 2:
        return checked(array, what), {}
    assert array.dtype == "<i4"
    cells = np.zeros(size[::-1], bool)
    cells[tuple(array.T[::-1])] = True
    assert cells.sum() == len(array)
    return cells, {}


def arrays(path):
    with zipfile.ZipFile(path) as file:
        assert file.testzip() is None
        return {name[:-4]: npy(file.read(name)) for name in file.namelist()}


def read_npz(path, _, what):
    stored = arrays(path)
    more = {"bits": [], "labels": ["inside"], "ids": ["ids"], "colours": ["colours"]}[what]
    assert sorted(set(stored) - {"shard", "tiles", "whole"}) == sorted(["at", "bits", "cell", "origin", "shift", "size", *more])
    assert stored["at"].dtype == stored["size"].dtype == "<u4" and stored["bits"].dtype == "<u8" and stored["bits"].any(1).all()
    assert stored["origin"].dtype == stored["cell"].dtype == "<f8" and stored["at"].shape == (len(stored["bits"]), 3)
    grid = {name: stored[name].tolist() for name in ("origin", "cell", "size", "shift")}
    cells = {"ids": -1}.get(what, 0) * np.ones(grid["size"][::-1], np.int32)
    places = bits_of_bricks(stored["at"], stored["bits"])
    if what == "labels":
        inside = bits_of_bricks(stored["at"], stored["inside"])
        cells[places], cells[inside] = 1, 2
        assert (cells > 0).sum() == len(places[0])
    elif what == "colours":
        assert stored["colours"].dtype == np.uint8
        return {place: tuple(colour) for place, colour in zip(zip(*(p.tolist() for p in places[::-1])), stored["colours"].tolist())}
    else:
        cells[places] = stored["ids"] if what == "ids" else 1
        assert what != "ids" or stored["ids"].dtype == "<u4"
    return cells, grid


def bits_of_bricks(at, bits):
    """The cells of bricks of eight, as indices, brick for brick and row for row."""
    n, k, j, i = np.nonzero(np.unpackbits(bits.view(np.uint8).reshape(-1, 8, 8, 1), axis=-1, bitorder="little"))
    return tuple(8 * at[n, a].astype(int) + x for a, x in ((2, k), (1, j), (0, i)))


def read_raw(path, size, what):
    """Bits: words of 64 cells, each row of cells along x starts with a word; little-endian, the low bit first. Else numbers."""
    data = content_of(path)
    if what != "bits":
        return np.frombuffer(data, {"labels": "u1", "ids": "<i4"}[what]).reshape(size[::-1]), {}
    rows = np.frombuffer(data, "u1").reshape(size[2], size[1], (size[0] + 63) // 64 * 8)
    cells = np.unpackbits(rows, axis=-1, bitorder="little")
    assert not cells[..., size[0]:].any()
    return cells[..., :size[0]], {}


def three(text):
    return [float(x) for x in re.split(r"[ ,]+", text.strip())]


def read_binvox(path, size, _):
    """Runs of (value, count); y runs fastest, then z, then x, in a cube, which is as long as the scale."""
    head, runs = content_of(path).split(b"\ndata\n", 1)
    found = re.fullmatch(r"#binvox 1\ndim (\d+) \1 \1\ntranslate (.*)\nscale (.*)", head.decode())
    side, runs = int(found[1]), np.frombuffer(runs, "u1").reshape(-1, 2)
    assert set(runs[:, 0]) <= {0, 1} and runs[:, 1].all()
    cells = np.repeat(runs[:, 0], runs[:, 1]).reshape(side, side, side).transpose(1, 2, 0)
    size = size or [side] * 3
    assert side == max(size) and cells.sum() == cells[:size[2], :size[1], :size[0]].sum()
    return cells[:size[2], :size[1], :size[0]], {"origin": three(found[2]), "cell": [float(found[3]) / side] * 3}


def vox(path):
    """MagicaVoxel: the size, (i, j, k, colour from 1) of each cell, and the palette as far as there is one."""
    data = content_of(path)
    assert data[:20] == struct.pack("<4sI4sII", b"VOX ", 150, b"MAIN", 0, len(data) - 20)
    at, chunks = 20, {}
    while at < len(data):
        name, length, children = struct.unpack_from("<4sII", data, at)
        assert children == 0 and name not in chunks
        chunks[name] = data[at + 12:at + 12 + length]
        at += 12 + length
    assert list(chunks)[:2] == [b"SIZE", b"XYZI"] and list(chunks)[2:] in ([], [b"RGBA"])
    cells = np.frombuffer(chunks[b"XYZI"][4:], "u1").reshape(-1, 4)
    palette = np.frombuffer(chunks.get(b"RGBA", b""), "u1").reshape(-1, 4)
    assert (len(cells),) == struct.unpack("<I", chunks[b"XYZI"][:4]) and cells[:, 3].all() and len(palette) in (0, 256)
    return struct.unpack("<3I", chunks[b"SIZE"]), cells, palette


def read_vox(path, _, what):
    """Labels have two colours, white and orange."""
    size, places, palette = vox(path)
    assert max(size) <= 256 and (what == "bits" and not len(palette) or palette[:2].tolist() == [[255] * 4, [255, 128, 0, 255]])
    cells = np.zeros(size[::-1], np.uint8)
    cells[tuple(places.T[2::-1])] = places[:, 3]
    assert (cells > 0).sum() == len(places)
    return cells, {}


def palette_of(path):
    """Of coloured cells."""
    _, cells, palette = vox(path)
    assert len(palette) and (palette[:, 3] == 255).all()
    return {tuple(c[:3].tolist()): tuple(palette[c[3] - 1, :3].tolist()) for c in cells}


DENSE = {"bits": ("uint8", "UInt8", "occupied", "u1"), "labels": ("uint8", "UInt8", "label", "u1"),
         "ids": ("int32", "Int32", "id", "<i4")}


def read_nrrd(path, _, what):
    """Its origin is the middle of the first cell."""
    head, data = content_of(path).split(b"\n\n", 1)
    fields = dict(line.split(": ", 1) for line in head.decode().splitlines() if ": " in line)
    size = [int(n) for n in fields["sizes"].split()]
    assert fields["type"] == DENSE[what][0] and fields["encoding"] == "raw" and fields["dimension"] == "3"
    directions = [three(v) for v in re.findall(r"\(([^)]*)\)", fields["space directions"])]
    assert np.array_equal(np.diag(np.diag(directions)), directions)
    cell = [directions[a][a] for a in range(3)]
    origin = [m - c / 2 for m, c in zip(three(fields["space origin"].strip("()")), cell)]
    return np.frombuffer(data, DENSE[what][3]).reshape(size[::-1]), {"origin": origin, "cell": cell, "size": size}


def read_vti(path, _, what):
    head, data = content_of(path).split(b'<AppendedData encoding="raw">\n   _')
    text, length = head.decode(), struct.unpack_from("<Q", data)[0]
    assert data[8 + length:] == b"\n  </AppendedData>\n</VTKFile>\n" and 'Scalars="%s"' % DENSE[what][2] in text
    assert '<DataArray type="%s" Name="%s" format="appended"' % DENSE[what][1:3] in text
    size = [int(n) for n in re.search(r'WholeExtent="0 (\d+) 0 (\d+) 0 (\d+)"', text).groups()]
    origin, cell = (three(re.search(word + '="([^"]*)"', text)[1]) for word in ("Origin", "Spacing"))
    grid = {"origin": origin, "cell": cell, "size": size}
    return np.frombuffer(data[8:8 + length], DENSE[what][3]).reshape(size[::-1]), grid


class Octets:
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
        return np.flatnonzero(np.unpackbits(np.frombuffer(self.take("%ds" % (count // 8)), "u1"), bitorder="little")).tolist()


def vdb_node(data, corner, log2s, cells):
    """A node of 2^(log2 of its own and all below) cells along each axis, its children in the order of their numbers, z fastest."""
    own, below = log2s[0], sum(log2s[1:])
    children = data.bits(8 ** own)
    if below:
        assert not data.bits(8 ** own) and data.take("b") == 0  # no tile is active, and so no value is stored
    for n in children:
        at = tuple(c + (p << below) for c, p in zip(corner, (n >> 2 * own, n >> own & (1 << own) - 1, n & (1 << own) - 1)))
        if below:
            vdb_node(data, at, log2s[1:], cells)
        else:
            cells.append(at)


def without_vdb_id(written):
    """The bytes of such a file but for the random id, which is text of 36 letters."""
    return written[:21] + written[57:]


def read_vdb(path, _, what):
    """OpenVDB 224, one grid of masks or of ids."""
    tree, number, background = {"bits": ("Tree_mask_5_4_3", "b", 0), "ids": ("Tree_int32_5_4_3", "i", -1)}[what]
    data, places, about = Octets(content_of(path)), [], {}
    assert data.take("qI") == (0x56444220, 224)
    data.take("II")
    has_offsets = data.take("b")
    data.take("36s")
    assert data.take("II") == (0, 1) and [data.text() for _ in range(3)] == ["tribox", tree, ""]
    start, _, end = data.take("qqq")
    assert not has_offsets or (data.at == start and end == len(data.data))
    assert data.take("I") == 2  # active values alone, not compressed
    for _ in range(data.take("I")):
        name, kind = data.text(), data.text()
        about[name] = kind, data.take("%ds" % data.take("I"))
    assert data.text() in ("ScaleTranslateMap", "UniformScaleTranslateMap")
    transform = data.take("18d")
    assert data.take("I") == 1 and data.take(number) == background  # one buffer; the background
    tiles, children = data.take("II")
    assert tiles == 0
    for _ in range(children):
        vdb_node(data, data.take("iii"), (5, 4, 3), places)
    grid = {name: list(struct.unpack(form, about[name][1])) for name, form in (("size", "<3i"), ("origin", "<3d"), ("cell", "<3d"))}
    grid.update(middle=transform[:3], lengths=transform[3:6])
    cells, values = np.full(grid["size"][::-1], background, np.int32), [1] * len(places)
    if what == "ids":
        values = []
        while len(values) < len(places):
            count = len(data.bits(512))
            assert count and data.take("b") == 0  # of a leaf active values alone follow
            values += data.take("%di" % count) if count > 1 else [data.take("i")]
    if places:
        assert len(set(places)) == len(places)
        cells[tuple(np.array(places).T[::-1])] = values
    return cells, grid


# Faces of cells: vertices (n, 3), triangles (m, 3) and a colour for each of these in bytes, or None.

def linear(byte):
    s = byte / 255
    return s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4


LIGHT = np.array([int(65535 * linear(byte) + 0.5) for byte in range(256)])


def mesh(path):
    return globals()["mesh_" + path.rpartition(".")[2]](path)


def mesh_ply(path):
    head, _, body = content_of(path).partition(b"end_header\n")
    lines = [line for line in head.decode().splitlines() if not line.startswith("comment")]
    (vertices, faces), colours = (int(line.split()[2]) for line in lines if line.startswith("element")), lines[8:]
    assert lines[:8] == ["ply", "format binary_little_endian 1.0", "element vertex %d" % vertices,
                         *("property double " + a for a in "xyz"),
                         "element face %d" % faces, "property list uchar int vertex_indices"]
    assert colours in ([], ["property uchar red", "property uchar green", "property uchar blue"])
    records = np.frombuffer(body[24 * vertices:], [("count", "u1"), ("corners", "<i4", 3), ("colour", "u1", len(colours))])
    assert len(records) == faces and (records["count"] == 3).all()
    return np.frombuffer(body[:24 * vertices], "<f8").reshape(-1, 3), records["corners"], records["colour"] if colours else None


def of_corners(vertices, triangles, colours):
    """All corners of a face have its colour."""
    if len(triangles) == 0 or colours is None:
        return vertices, triangles, None
    assert (colours[triangles] == colours[triangles][:, :1]).all()
    return vertices, triangles, colours[triangles][:, 0]


def mesh_obj(path):
    lines = [line.split() for line in content_of(path).decode().splitlines() if not line.startswith("#")]
    assert {line[0] for line in lines} <= {"v", "f"}
    rows, faces = (np.array([[float(x) for x in line[1:]] for line in lines if line[0] == word]) for word in "vf")
    rows, faces = rows if len(rows) else np.zeros((0, 3)), faces.astype(int).reshape(-1, 3) - 1
    return of_corners(rows[:, :3], faces, np.floor(255 * rows[:, 3:] + 0.5).astype("u1") if rows.shape[1] > 3 else None)


def mesh_glb(path):
    """Colours are linear there, in 16 bits: which byte they were is found by the nearest."""
    data = content_of(path)
    assert struct.unpack_from("<4sII", data) == (b"glTF", 2, len(data)) and len(data) % 4 == 0
    length, kind = struct.unpack_from("<I4s", data, 12)
    about, rest = json.loads(data[20:20 + length]), data[20 + length:]
    assert kind == b"JSON" and length % 4 == 0 and about["asset"]["version"] == "2.0" and about["scene"] == 0
    if not rest:
        assert about["scenes"] == [{}] and "meshes" not in about
        return np.zeros((0, 3)), np.zeros((0, 3), int), None
    assert struct.unpack_from("<I4s", rest) == (len(rest) - 8, b"BIN\0") and about["buffers"] == [{"byteLength": len(rest) - 8}]
    (node,), (view, indices), (positions, numbers, *colours) = about["nodes"], about["bufferViews"], about["accessors"]
    rest = rest[8:]
    stride, attributes = (20, {"POSITION": 0, "COLOR_0": 2}) if colours else (12, {"POSITION": 0})
    (primitive,) = about["meshes"][0]["primitives"]
    assert about["scenes"] == [{"nodes": [0]}] and (view["target"], indices["target"]) == (34962, 34963)
    assert (primitive["attributes"], primitive["indices"], view.get("byteStride", 12)) == (attributes, 1, stride)
    assert (positions["componentType"], positions["type"]) == (5126, "VEC3")
    assert (numbers["componentType"], numbers["type"]) == (5125, "SCALAR")
    assert view["byteLength"] == stride * positions["count"] == indices["byteOffset"]
    assert indices["byteLength"] == 4 * numbers["count"]
    assert indices["byteOffset"] + indices["byteLength"] == len(rest)
    records = np.frombuffer(rest[:view["byteLength"]], [("place", "<f4", 3), ("colour", "<u2", 4 if colours else 0)])
    assert positions["min"] == records["place"].min(0).tolist() and positions["max"] == records["place"].max(0).tolist()
    for of_colours in colours:
        assert [of_colours[key] for key in ("componentType", "type", "normalized", "byteOffset", "count")] == [
            5123, "VEC4", True, 12, positions["count"]]
        assert (records["colour"][:, 3] == 65535).all() and np.isin(records["colour"][:, :3], LIGHT).all()
    vertices = np.array(node["translation"]) + records["place"].astype(float) * node["scale"]
    octets = np.searchsorted(LIGHT, records["colour"][:, :3]).astype("u1") if colours else None
    return of_corners(vertices, np.frombuffer(rest[indices["byteOffset"]:], "<u4").reshape(-1, 3).astype(int), octets)


MESHES = (".ply", ".obj", ".glb")


def read_png(path):
    """Rows of (red, green, blue), of an 8-bit RGB file."""
    width, height, data = open_png(path)
    rows, above = [], bytes(3 * width)
    for y in range(height):
        kind, row = data[y * (3 * width + 1)], bytearray(data[y * (3 * width + 1) + 1:(y + 1) * (3 * width + 1)])
        for x in range(3 * width if kind else 0):
            left, up, corner = row[x - 3] if x >= 3 else 0, above[x], above[x - 3] if x >= 3 else 0
            guess = left + up - corner
            row[x] = row[x] + (left if kind == 1 else up if kind == 2 else (left + up) // 2 if kind == 3 else
                               min((left, up, corner), key=lambda p: abs(guess - p))) & 255
        rows.append(bytes(row))
        above = rows[-1]
    return np.frombuffer(b"".join(rows), "u1").reshape(height, width, 3).astype(int)


def open_png(path):
    """Width, height and the rows as they are stored, of a file that is whole."""
    data = content_of(path)
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, parts = 8, []
    while at < len(data):
        length, name = struct.unpack_from(">I4s", data, at)
        content = data[at + 8:at + 8 + length]
        assert struct.unpack_from(">I", data, at + 8 + length)[0] == zlib.crc32(name + content)
        parts.append((name, content))
        at += 12 + length
    assert parts[0][0] == b"IHDR" and parts[-1] == (b"IEND", b"")
    width, height, *how = struct.unpack(">IIBBBBB", parts[0][1])
    assert how == [8, 2, 0, 0, 0]
    rows = zlib.decompress(b"".join(content for name, content in parts if name == b"IDAT"))
    assert len(rows) == (3 * width + 1) * height
    return width, height, rows
