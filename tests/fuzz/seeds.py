"""Writes the first inputs of the fuzz targets into a new folder, with a dictionary, and prints their names: python3 seeds.py FOLDER

input.c and the targets say what the bytes mean. Inputs for which a fault was once found are kept in found/.
"""

import io
import os
import random
import shutil
import struct
import sys
import zipfile

BITS, LATTICE, FAR_LATTICE, NEAR_KNOWN, BETWEEN_KNOWN, NASTY, POWER, ANY_WAY = range(8)
BYTES_OF_NUMBER = {BITS: 4, LATTICE: 1, FAR_LATTICE: 1, NEAR_KNOWN: 2, BETWEEN_KNOWN: 3, NASTY: 1, POWER: 2}
UNITS = UNIT_ONE, UNIT_EIGHTH, UNIT_HUGE, UNIT_SUBNORMAL = 0, 1, 6, 7
BOX, ORIENTED, BOXES = range(3)
KINDS = OF_SOUP, OF_FLOATS, OF_NARROW, OF_DOUBLES = range(4)


def lattice(*numbers):
    return bytes((number + 16) % 32 for number in numbers)


def floats(*numbers):
    return struct.pack("<%df" % len(numbers), *numbers)


def drawn(source, way, count, is_wide=False):
    """`count` numbers, all written in one way."""
    if way == ANY_WAY:
        return b"".join(bytes([w]) + drawn(source, w, 1, is_wide) for w in source.choices(range(ANY_WAY), k=count))
    if way == BITS:
        return struct.pack("<%d%s" % (count, "fd"[is_wide]), *(source.uniform(-2, 2) for _ in range(count)))
    return source.randbytes(count * BYTES_OF_NUMBER[way])


def shape(way, numbers, kind=0):
    return bytes([way + 8 * kind]) + numbers


def options(axes=0, order=0):
    return bytes([axes, order])


UNIT_BOX = shape(LATTICE, lattice(-1, 1, -1, 1, -1, 1))
CONTACTS = {
    "face": lattice(1, 0, 0, 3, 1, 0, 3, 0, 1),
    "edge": lattice(0, 2, 0, 2, 0, 0, 3, 3, 0),
    "vertex": lattice(1, 1, 1, 3, 0, 1, 1, 3, 3),
    "plane": lattice(3, 0, 0, 0, 3, 0, 0, 0, 3),
    "beside_edge": lattice(0, 3, 0, 3, 0, 0, 3, 3, 0),
    "inside": lattice(0, 0, 0, 1, 0, 0, 0, 1, 1),
    "around": lattice(-9, -9, 0, 9, -9, 0, 0, 9, 0),
}


def things(source, kind, way, count=16, run=b"", in_frame=None):
    """What things_draw reads; in_frame: the byte before each triangle about an oriented box, 0 where it lies in its frame."""
    triangles = b"".join(b"\0" + source.randbytes(9) if in_frame == 0 else
                         (b"\1" if in_frame else b"") + shape(way, drawn(source, way, 9, kind == OF_DOUBLES), source.randrange(4))
                         for _ in range(count))
    width = source.randrange(8)
    numbers = source.choice((bytes(3 * count), source.randbytes(3 * count).translate(bytes(n % 250 for n in range(256)))))
    numbers = numbers if width % 3 else b""
    layout = b"" if kind == OF_SOUP else bytes([source.randrange(250), width, source.randrange(250),
                                                source.randrange(64)]) + numbers
    return source.randbytes(1) + bytes([count - 1]) + run + triangles + layout


def a_box(source, form, way, is_wide=False):
    """And an oriented one: with axes of a rotation, or any."""
    if form != ORIENTED:
        return shape(way, drawn(source, way, 6, is_wide), source.choice((0, 0, 0, 1, 7, 8)))
    numbers = bytes([way]) + drawn(source, way, 3, is_wide)
    axes = source.choice((b"\1" + source.randbytes(4), b"\0" + bytes([way]) + drawn(source, way, 9, is_wide),
                          *(b"\0" + bytes([LATTICE]) + lattice(*numbers) for numbers in
                            ((1, 0, 0, 0, 1, 0, 0, 0, 1), (1, 1, 0, -1, 1, 0, 0, 0, 1), (1, 0, 0, 1, 1, 0, 1, 1, 1),
                             (1, 0, 0, 1, 0, 0, 0, 0, 1), (0,) * 9))))
    return numbers + bytes([way]) + drawn(source, way, 3, is_wide) + axes + b"\1\1" + source.randbytes(1)


def triangles():
    """Every form of question, every layout and every way to write numbers; the same contacts of each layout."""
    source = random.Random(1)
    files = {}
    for form in (BOX, ORIENTED, BOXES):
        for kind in KINDS[:1 if form == BOXES else 4]:
            for way in range(8):
                for number, axes in enumerate((0, source.choice((1, 2, 4, 5, 6)))):
                    is_wide = kind == OF_DOUBLES and number
                    head = bytes([source.choice(UNITS)]) + options(axes % 2 if form == ORIENTED else axes, source.randrange(7))
                    box = a_box(source, form, BITS if way == NEAR_KNOWN else way, is_wide)
                    boxes = bytes([15]) + b"".join(a_box(source, BOX, way) for _ in range(15)) if form == BOXES else b""
                    files["%d_%d_%d_%d" % (form, kind, way, number)] = (
                        head + bytes([form + 3 * kind + (96 if is_wide else 0), source.choice((16, 190, 251))]) + box +
                        things(source, kind, way, 1 if form == BOXES else 16,
                               in_frame=number if form == ORIENTED else None) + boxes +
                        source.randbytes(60))
    for kind in KINDS:
        head = bytes([UNIT_ONE]) + options() + bytes([3 * kind, 1])
        for name, numbers in CONTACTS.items():
            files["contact_%s_%d" % (name, kind)] = head + UNIT_BOX + b"\0\0" + shape(LATTICE, numbers)
        one = bytes([0, 0]) + shape(LATTICE, CONTACTS["plane"])
        for name, layout in {"missing": (254, 0, 0, 0), "too_small": (0, 0, 255, 3), "six": (255, 0, 0, 0), "width_3": (0, 8, 0, 0),
                             "behind": (0, 1, 0, 0, 0, 0, 250), "greatest": (0, 2, 0, 0, 255), "columns": (0, 1, 3, 5)}.items():
            files["layout_%s_%d" % (name, kind)] = head + UNIT_BOX + one + bytes(layout)
        files["none_%d" % kind] = head[:-1] + b"\0" + UNIT_BOX
    for count in (0, 1, 63, 64, 65, 255):
        files["mask_of_%d" % count] = (bytes([UNIT_ONE]) + options() + b"\0\0" + UNIT_BOX + bytes([0, 0, LATTICE]) +
                                         bytes([0] * 9 + [0, 0, count]) + b"\xff" * 32)
    return files


def index():
    source = random.Random(6)
    around, flat = shape(LATTICE, lattice(-16, 15, -16, 15, -16, 15)), shape(LATTICE, lattice(0, 1, -5, 5, -5, 5), 1)
    files = {}
    for kind in KINDS:
        for way in range(8):
            for many in (0, 1):
                boxes = source.choice((UNIT_BOX, flat)) + a_box(source, BOX, way) + around
                damage = source.choice((b"\0", b"\0", bytes([1, 6, 0, 7, 255]), bytes([9, 0, 0, 255, 0, 3, 0, 255, 0]),
                                        b"\xff" + source.randbytes(130)))
                files["%d_%d_%d" % (kind, way, many)] = (
                    bytes([source.choice(UNITS)]) + options(source.choice((0, 0, 1, 3))) +
                    bytes([many + 2 * kind, 255 if many else source.choice((0, 1, 180, 250))]) + boxes +
                    things(source, kind, way, run=bytes([source.choice((0, 63, 255))]) if many
                           else b"") + source.randbytes(3) + damage)
    for side in range(6):
        half = [-16, 15] * 3
        half[side] = 0
        files["half_%d" % side] = (bytes([UNIT_ONE]) + options() + bytes([1 + 2 * (side % 4), 255]) +
                                   shape(LATTICE, lattice(*half)) +
                                   around + flat + things(source, side % 4, LATTICE, run=b"\77") + b"\1\0\377\0")
    files["wrong_axes"] = bytes([UNIT_ONE]) + options(6) + b"\0\276" + UNIT_BOX * 3 + things(source, OF_SOUP, LATTICE)
    files["wrong_box"] = (bytes([UNIT_ONE]) + options() + b"\0\276" + shape(NASTY, bytes([15] * 6)) * 3 +
                          things(source, OF_SOUP, LATTICE))
    return files


def cells():
    """Grids of each length of rows, of units and not, as fine as float and refused; then what is asked, walls and triangles."""
    source = random.Random(2)
    files = {}

    def add(name, how, places, sizes, steps, kind, way, unit=UNIT_ONE, is_wide=0):
        asked = bytes([steps % 3, source.choice((0, 5, 255)), 1, 64, 1, 2, 0, 3, steps % 4, source.choice((0, 1, 2)),
                       3][:10 + (steps % 4 == 0)])
        files[name] = (bytes([unit]) + how + bytes([kind + 128 * is_wide]) + places + bytes(sizes) + asked +
                       source.randbytes(16) + b"\5" +
                       things(source, kind, way, 6))

    units = bytes([LATTICE]) + lattice(-8, -2, -2) + bytes([LATTICE]) + lattice(1, 2, 3)
    odd = bytes([BITS]) + floats(-0.7, -0.3, 0.1) + bytes([BITS]) + floats(0.01, 0.3, 0.2)
    for kind in KINDS:
        for way in range(8):
            for number in range(5):
                sizes = (source.randrange(135), source.randrange(7),
                         source.randrange(7)) if number else (source.choice((4, 10, 14)), 5, 6)
                add("%d_%d_%d" % (kind, way, number), options(), source.choice((units, odd)) if number else units, sizes,
                    way + number,
                    kind, way, source.choice((UNIT_ONE, UNIT_EIGHTH)))
        for axes in (1, 2, 4, 5):
            add("axes_%d_%d" % (axes, kind), options(axes), units, (4, 2, 1), axes, kind, LATTICE, UNIT_EIGHTH)
    for row in range(15):
        add("row_%d" % row, options(), odd, (row, 4, 2), row, row % 4, BITS)
    fine = bytes([FAR_LATTICE]) + lattice(0, 1, 2) + bytes([BITS]) + floats(0.125, 0.125, 0.0625)
    add("as_fine_as_float", options(), fine, (4, 3, 2), 1, OF_SOUP, NEAR_KNOWN)
    for number, cell in enumerate((0, float("nan"), float("inf"))):
        add("wrong_cells_%d" % number, options(), bytes([LATTICE]) + lattice(0, 0, 0) + bytes([BITS]) + floats(cell, 1, 1),
            (4, 3, 3), 1, OF_SOUP, LATTICE)
    for unit in UNITS:
        add("unit_%d" % unit, options(), bytes([LATTICE]) + lattice(-8, -4, 0) + bytes([LATTICE]) + lattice(2, 4, 2), (8, 4, 4), 1,
            unit % 4, LATTICE, unit)
        add("wide_%d" % unit, options(), bytes([POWER]) + source.randbytes(6) + bytes([LATTICE]) + lattice(2, 4, 2), (8, 4, 4), 1,
            OF_DOUBLES, LATTICE, unit, 1)
    return files


def grid():
    source = random.Random(5)
    files = {}
    for name, way in ("bits", BITS), ("near", NEAR_KNOWN), ("powers", POWER):
        triangles = b"".join(shape(way, drawn(source, way, 9)) for _ in range(3))
        files["resolution_" + name] = bytes([UNIT_ONE, 0, 0, 1, 99, 0]) + bytes([4, 4, 4]) + triangles
        files["cell_" + name] = bytes([UNIT_ONE, 0, 0, 0, BITS]) + floats(0.1, 0.2, 0.3) + bytes([0, 4, 4, 4]) + triangles
        files["cell_of_doubles_" + name] = (bytes([UNIT_ONE, 0, 0, 0, BITS]) + floats(0.1, 0.2, 0.3) + bytes([21, 4, 4, 4]) +
                                            triangles)
        files["origin_and_size_" + name] = (bytes([UNIT_ONE, 1, 1, 0, BITS]) + floats(0.1, 0.2, 0.3) + bytes([0, LATTICE]) +
                                            lattice(-9, -9, -9) + bytes([0, 40, 40, 40]) + triangles)
    return files


def ply(form, line_end=b"\n", vertices=3, faces=1):
    header = line_end.join([b"ply", b"format %s 1.0" % form, b"comment a triangle", b"element vertex %d" % vertices,
                            b"property float x", b"property float y", b"property float z", b"element face %d" % faces,
                            b"property list uchar int vertex_indices", b"end_header", b""])
    if form == b"ascii":
        return header + line_end.join([b"0 0 0", b"1 0 0", b"0 1 0", b"3 0 1 2", b""])
    order = "<" if form == b"binary_little_endian" else ">"
    return header + struct.pack(order + "9fB3i", 0, 0, 0, 1, 0, 0, 0, 1, 0, 3, 0, 1, 2)


FIRST_BRICK, LAST_BRICK = ((0, 0, 0), [1] + [0] * 7), ((8, 0, 0), [0x3f] + [0] * 7)


def part(shard=1, shards=1, size=(70, 2, 3), bricks=(FIRST_BRICK, LAST_BRICK), position_bytes=4, tile=8, tiles=None, has_ids=False,
         how=zipfile.ZIP_STORED, **others):
    """Of a row of tiles of one brick each, of which every shard has as many. others: members in place of those that it has."""
    count = (size[0] + 7) // 8
    first, end = tiles or (count * (shard - 1) // shards, count * shard // shards)
    there = [brick for brick in bricks if first <= brick[0][0] < end or tiles]
    cells, file = sum(bin(word).count("1") for _, words in there for word in words), io.BytesIO()
    members = dict(bits=("<u8", (len(there), 8), b"".join(struct.pack("<8Q", *words) for _, words in there)),
                   at=("<u4", (len(there), 3), b"".join(struct.pack("<3I", *at) for at, _ in there)),
                   origin=("<f8", (3,), bytes(24)), cell=("<f8", (3,), struct.pack("<3d", 1, 1, 1)),
                   size=("<u4", (3,), struct.pack("<3I", *size)), shift=("<f8", (3,), bytes(24)),
                   shard=("<u4", (2,), struct.pack("<2I", shard, shards)), tiles=("<u8", (2,), struct.pack("<2Q", first, end)),
                   whole=("<u8", (7,), struct.pack("<7Q", 12, 34, 56, position_bytes, 0, 7, tile)))
    members.update(dict(ids=("<u4", (cells,), bytes(4 * cells))) if has_ids else {}, **others)
    with zipfile.ZipFile(file, "w", how) as to:
        for name, (kind, shape, content) in members.items():
            text = "{'descr': '%s', 'fortran_order': False, 'shape': %s, }" % (kind, shape)
            to.writestr(zipfile.ZipInfo(name + ".npy"), b"\x93NUMPY\1\0v\0" + text.encode().ljust(117) + b"\n" + content, how)
    return file.getvalue()


def partition(records=((0, 0, 5, 0), (1, 1, 7, 0)), places=3, tile=64, numbers=(0, 4), size=(100, 50, 50), record_bytes=32,
              magic=b"tribox tiles 3\n"):
    index = (magic.ljust(16, b"\0") +
             struct.pack("<2I9d6I7Q", 0x01020304, tile, 0, 0, 0, 1, 1, 1, 0, 0, 0, *size, *numbers, record_bytes, 2, 34, 56, 0,
                         len(records),
                         places, 0) + b"".join(struct.pack("<4Q", *record) for record in records))
    return bytes([len(index) // 8]) + index + struct.pack("<9%s" % "fd"[numbers[1] == 8], *range(9)) * places


def ply_files():
    files = {}
    for name, form in {"ascii": b"ascii", "little": b"binary_little_endian", "big": b"binary_big_endian"}.items():
        for end_name, line_end in {"lf": b"\n", "cr_lf": b"\r\n", "cr": b"\r"}.items():
            files["%s_%s" % (name, end_name)] = ply(form, line_end)
        files[name + "_cut"] = ply(form)[:-1]
        files[name + "_huge"] = ply(form, vertices=2**64 - 1, faces=2**63)
    plain, binary = ply(b"ascii"), ply(b"binary_little_endian")
    files["far_index"] = plain.replace(b"3 0 1 2", b"3 0 1 4294967298")
    files["strips"] = plain.replace(b"element face", b"element tristrips").replace(b"3 0 1 2", b"8 0 1 2 -1 0 1 2 1")
    files["doubles"] = plain.replace(b"float", b"double").replace(b"1 0 0", b"1e39 16777217 -0.1234567890123")
    header, body = plain.split(b"element vertex 3\n")
    vertex, face = body.split(b"element face 1\n")
    face, values = face.split(b"end_header\n")
    files["faces_first"] = (header + b"element face 1\n" + face + b"element vertex 3\n" + vertex +
                            b"end_header\n3 0 1 2\n" + values[:-8])
    files["other_elements"] = plain.replace(b"element vertex",
                                            b"element other 1\nproperty list char double d\nelement vertex").replace(
        b"end_header\n", b"end_header\n2 0.5 1\n")
    files["float_lists"] = plain.replace(b"uchar int", b"int8 float").replace(b"3 0 1 2", b"3 0 1 1.5")
    files["no_end"] = plain.replace(b"end_header\n", b"")
    files["many_properties"] = plain.replace(b"property float x", b"property float x\n" * 257)
    files["first_byte_lf"] = binary.replace(b"end_header\n", b"end_header\n\n")
    for name, form in {"ascii": b"ascii", "little": b"binary_little_endian", "big": b"binary_big_endian"}.items():
        face = ply(form)[-8 if name == "ascii" else -13:]
        files["several_" + name] = ply(form).replace(b"element face 1", b"element face 3") + 2 * face
    wide_counts = ply(b"binary_little_endian", faces=9).replace(b"list uchar", b"list ushort")
    files["count_cut"] = wide_counts[:-13] + struct.pack("<H3iB", 3, 0, 1, 2, 1)
    return files


def off_files():
    plain = b"OFF\n# a triangle\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
    return {"triangle": plain, "cut": plain[:-4], "far_index": plain.replace(b"0 1 2", b"0 1 3"),
            "negative_index": plain.replace(b"0 1 2", b"0 -1 2"), "huge": b"OFF\n18446744073709551615 1 0\n",
            "prefixes": b"STCN" + plain, "comments": plain.replace(b"\n", b" 255 0 0#red\n\n").replace(b"OFF", b"OFF\n#"),
            "counts_at_once": plain.replace(b"OFF\n# a triangle\n", b"OFF"), "binary": b"OFF BINARY\n" + bytes(20),
            "polygons": b"OFF 5 3 0\n0 0 0\n4 0 0\n1 1 0\n0 4 0\n9e9 1.23456789012345 nan\n4 0 1 2 3\n5 4 0 2 1 3\n2 0 1\n"}


BINARY_STL = b"a triangle".ljust(80) + struct.pack("<I12fH", 1, *[0] * 12, 0)
TEXT_STL = b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n"


def stl_files():
    return {"binary": BINARY_STL, "binary_cut": BINARY_STL[:-1], "text": TEXT_STL, "text_cut": TEXT_STL[:-11],
            "two": TEXT_STL.replace(b"endsolid a", TEXT_STL[8:]),
            "solid_binary": b"solid" + BINARY_STL[5:], "huge": BINARY_STL[:80] + b"\xff" * 4 + BINARY_STL[84:]}


def boxes_files():
    return {"plain": b"0,0,0,1,1,1\n-1 -2 -3 4 5 6\n", "comments": b"# boxes\n\n0 0 0 1 1 1 # one\n\t\n1e-3,2,3,0x1p4,5,6",
            "empty_box": b"1 1 1 0 0 0\n", "not_finite": b"0 0 0 1 1 inf\n", "too_large": b"0 0 0 1 1 1e39\n",
            "too_small": b"0 0 0 1 1 1e-60\n", "few": b"0 0 0 1 1\n", "many": b"0 0 0 1 1 1 1\n", "commas": b"0,,0,1,1,1\n",
            "nul": b"0 0 0 1 1 1\0\n", "long_line": b"0 " * 600 + b"\n", "text": b"lower upper\n", "cr_lf": b"0 0 0 1 1 1\r\n"}


def part_files():
    """The first two bytes are the size of the first part; 65535 means that there is only one."""
    whole, half, ids = part(), part(1, 2), part(has_ids=True)
    single = {"whole": whole, "one_of_two": half, "more_shards_than_tiles": part(2, 20), "cut": whole[:-1], "long": whole + b"\0",
              "half": whole[:len(whole) // 2], "shard_0": part(0, 1, tiles=(0, 9)), "huge": part(size=(2**31, 64, 1), bricks=()),
              "old": b"tribox part 6\n" + bytes(200), "doubles": part(position_bytes=8), "three_bytes": part(position_bytes=3),
              "ids": ids, "deflated": part(has_ids=True, how=zipfile.ZIP_DEFLATED), "few_ids": part(ids=("<u4", (1,), bytes(4))),
              "many_ids": part(ids=("<u4", (99,), bytes(396))), "no_rows": part(at=("<u4", (0, 3), b"")),
              "stranger": part(x=("<u4", (0,), b"")), "bits_of_7": part(bits=("<u8", (2, 7), bytes(112))),
              "tile_of_12": part(tile=12), "no_tile": part(tile=0),
              "out_of_order": part(bricks=(LAST_BRICK, FIRST_BRICK)), "twice": part(bricks=(FIRST_BRICK, FIRST_BRICK)),
              "one_tile": part(tile=128, tiles=(0, 1)), "other_tiles": part(tiles=(5, 9)), "too_many_tiles": part(tiles=(0, 10)),
              "backwards": part(tiles=(5, 3)), "stray_x": part(bricks=(((8, 0, 0), [0x40] + [0] * 7),)),
              "stray_y": part(bricks=(((0, 0, 0), [1 << 16] + [0] * 7),)), "stray_z": part(bricks=(((0, 0, 0), [0] * 7 + [1]),)),
              "outside": part(bricks=(((0, 1, 0), [1] * 8),))}
    second = {"two": part(2, 2), "same": half, "misfit": part(2, 2, size=(71, 2, 3)), "gap": part(2, 2, tiles=(7, 9))}
    return {**{name: b"\xff\xff" + content for name, content in single.items()},
            **{name: struct.pack("<H", len(half)) + half + content for name, content in second.items()}}


def partition_files():
    whole = partition()
    return {"whole": whole, "empty": partition(records=(), places=0), "doubles": partition(numbers=(0, 8)),
            "numbers": partition(numbers=(4, 4)), "number_bytes": partition(numbers=(8, 4)),
            "doubles_in_floats": partition(numbers=(4, 8)), "cut": whole[:-1],
            "no_triangles": whole[:233], "header_cut": b"\x12" + whole[1:], "tile_of_12": partition(tile=12),
            "backwards": partition(records=((1, 0, 5, 0), (0, 1, 7, 0))),
            "same_tile": partition(records=((1, 0, 5, 0), (1, 1, 7, 0))),
            "beyond_tiles": partition(records=((0, 0, 5, 0), (2, 1, 7, 0))),
            "no_place": partition(records=((0, 0, 5, 0), (1, 0, 7, 0))),
            "far_place": partition(records=((0, 0, 5, 0), (1, 2**63, 7, 0))),
            "gap": partition(records=((0, 1, 5, 0), (1, 2, 7, 0))),
            "much_work": partition(records=((0, 0, 2**63, 0), (1, 1, 2**63, 0))), "record_of_40": partition(record_bytes=40),
            "magic": partition(magic=b"tribox tiles 1\n"), "other": partition(magic=b"something else")}


def triangles_files():
    """The first byte modulo 4 is the format: 0 by name, 1 STL, 2 floats, 3 doubles; from 128 on, through standard input."""
    by_name, stl, raw, doubles = (bytes([choice]) for choice in range(4))
    stl_by_stdin, raw_by_stdin, doubles_by_stdin = (bytes([choice]) for choice in (129, 130, 131))
    numbers, wide = struct.pack("<18f", *range(18)), struct.pack("<18d", *(number / 10 for number in range(18)))
    return {"binary": stl + BINARY_STL, "binary_cut": stl + BINARY_STL[:-1], "header_cut": stl + BINARY_STL[:70],
            "long": stl + BINARY_STL + b"x", "text_asked": stl + TEXT_STL, "by_name": by_name + BINARY_STL,
            "text": by_name + TEXT_STL, "raw": raw + numbers, "raw_cut": raw + numbers[:-1], "stdin": stl_by_stdin + BINARY_STL,
            "stdin_cut": stl_by_stdin + BINARY_STL[:-1], "stdin_raw": raw_by_stdin + numbers,
            "stdin_raw_cut": raw_by_stdin + numbers[:-1], "doubles": doubles + wide, "doubles_cut": doubles + wide[:-1],
            "stdin_doubles": doubles_by_stdin + wide, "stdin_doubles_cut": doubles_by_stdin + wide[:-1]}


def obj_files():
    plain = b"# a triangle\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
    return {"triangle": plain, "cut": plain[:-3], "no_line_end": plain[:-1], "slashes": plain.replace(b"1 2 3", b"1/1 2//5 3/4/5"),
            "negative": plain.replace(b"1 2 3", b"-3 -2 -1"), "far_index": plain.replace(b"1 2 3", b"1 2 4"),
            "index_0": plain.replace(b"1 2 3", b"0 1 2"), "too_negative": plain.replace(b"1 2 3", b"-4 1 2"),
            "faces_first": b"f 1 2 3\nf 1 2 3 4\nf -1 1 2\n" + plain[:-8] + b"v 1.1 2.2 3.3\nf -1 -2 -3\n",
            "continued": plain.replace(b" 2 ", b" \\\n2\\\r\n").replace(b"v 0 1", b"v\\\n 0 1"),
            "comment": plain.replace(b"\n", b"#\\\n\n"),
            "more": plain.replace(b" 0\n", b" 0 1 255 0 0\n") + b"vn 0 0 1\ng a\nusemtl b\np 1\nl 1 2\nf 1 2\n",
            "doubles": plain.replace(b"1 0", b"557820.123456789 0x1p-200"), "word": plain.replace(b"1 0", b"one 0"),
            "comb": b"v 0 0 0\nv 6 0 0\nv 6 4 0\nv 5 4 0\nv 5 1 0\nv 1 1 0\nv 1 4 0\nv 0 4 0\n"
                    b"f 1 2 3 4 5 6 7 8\nf 8 7 6 5 4 3 2 1\nf 1 3 2 4 6 5 8 7\n",
            "polygon": b"v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\nf 1 2 3 4\nf 2 1 4 3 2 1\n"}


# In the order of the readers of fuzz_files.c.
READERS = {"boxes": boxes_files, "part": part_files, "triangles": triangles_files, "partition": partition_files}


def files():
    return {"%s_%s" % (reader, name): bytes([number]) + content
            for number, (reader, make) in enumerate(READERS.items()) for name, content in make().items()}


def meshes():
    """The files of each format, in parts of several lengths and by several threads, and with a change each."""
    source = random.Random(9)
    files = {}
    for ending, make in enumerate((ply_files, obj_files, stl_files, off_files)):
        for name, content in make().items():
            for number, part in enumerate((0, 6, 39, 254)):
                head = bytes([ending + 4 * number + 64 * source.randrange(2), part])
                files["%d_%s_%d" % (ending, name, part)] = head + content
                at = source.randrange(len(content))
                changed = content[:at] + source.choice([b"\r", b" ", b"\t", b"9", b"-", b"e", b"\n",
                                                        b"nan"]) + content[at + number % 2:]
                files["%d_%s_%d_changed" % (ending, name, part)] = head + changed
    return files


# Words of the formats that the program reads.
WORDS = ("ply\n|format ascii 1.0\n|format binary_little_endian 1.0\n|format binary_big_endian 1.0\n|element vertex |"
         "element face |element tristrips |property float x\n|property list uchar int vertex_indices\n|"
         "property list uint double vertex_index\n|uchar|uint64|end_header\n|end_header\r\n|OFF\n|STCN|v |f |vn |//|\\\n|solid |"
         "facet|endsolid|18446744073709551615|4294967296|-1|1e39|0x1p-149|nan|inf|shard.npy|\x04\x03\x02\x01").split("|")
TARGETS = (triangles, index, cells, grid, files, meshes)


def main():
    shutil.rmtree(sys.argv[1], ignore_errors=True)
    for make in TARGETS:
        folder = os.path.join(sys.argv[1], make.__name__)
        os.makedirs(folder)
        for name, content in make().items():
            with open(os.path.join(folder, name), "wb") as file:
                file.write(content)
            print(f"{make.__name__}/{name}")
    with open(os.path.join(sys.argv[1], "words"), "w", encoding="ascii") as file:
        file.writelines('"%s"\n' % "".join(c if " " <= c and c not in '"\\' else "\\x%02x" % ord(c) for c in word)
                        for word in WORDS)


if __name__ == "__main__":
    main()
