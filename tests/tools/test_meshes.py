"""Mesh files: the same triangles from every format, what each spelling means, and what is no mesh or only part of one."""

import gzip
import itertools
import json
import os
import re
import resource
import struct

import harness
import numpy as np
import triangles as meshes
from harness import MIB, UNIT_BOX, text_of
from triangles import INF, NAN, ply_text

TRIANGLES = meshes.lattice_triangles(20, seed=4)
ONE = ((0, 0, 0), (1, 0, 0), (0, 1, 0))
VERTICES, OBJ = "0 0 0\n1 0 0\n0 1 0\n", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
GIGANTIC = ("4294967295", "4294967297", "99999999999", "18446744073709551615", "18446744073709551616", "9" * 40)
STL = meshes.stl_ascii([ONE]).decode()
HEAD = meshes.ply([("vertex", meshes.XYZ, []), ("face", meshes.CORNERS, [])], "ascii").decode()
WHERE = (-0.75, -0.5, -0.5, 0.5, 0.5, 1)
POINT, CORNER, ALL = "0.25,0.25,0,0.25,0.25,0", "0,0,0,0,0,0", "-9,-9,-9,9,9,9"


def squares(line_end, more=""):
    return "".join(line_end + line + more for line in ("4 2 0", "0 0 0", "1 0 0", "0 1 0", "1 1 0", "3 0 1 2", "4 0 1 3 2"))


def polygon(corners, form):
    """A face of these corners."""
    numbers = range(form == "obj", len(corners) + (form == "obj"))
    if form == "obj":
        return "".join("v " + p + "\n" for p in corners) + "f %s\n" % " ".join(map(str, numbers))
    face = "%d %s\n" % (len(corners), " ".join(map(str, numbers)))
    lines = "".join(p + "\n" for p in corners)
    return ply_text(lines, face) if form == "ply" else "OFF %d 1 0\n%s%s" % (len(corners), lines, face)


# Spellings: the ending, the text, and the numbers of triangles that overlap boxes.
STRIPS = ply_text("0 0 0\n1 0 0\n0 1 0\n1 1 0\n9 9 9\n", "8 0 1 2 3 -1 2 3 4\n",
                  **{"element face": "element tristrips", "uchar": "int"})
GROUPS = ("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\n"
          "o a\nusemtl A\nf 1 2 3\nusemtl B\nf 4 4 4\nusemtl A\nf 1 2 3\ng b\nf 4 4 4\no c\nusemtl B\nf 1 2 3\n")
TURNED = ply_text("", "3 0 0 0\n3 0 1 2\n9 9 9\n1 0 0\n0 1 0\n", (3, 2))
TURNED = re.sub(r"(?s)(element vertex.*?)(element face.*?)(end_header)", r"\2\1\3", TURNED)
SPELLINGS = [
    ("ply", TURNED, {"0.5,0.5,0,0.5,0.5,0": [1]}),
    ("ply", STRIPS, {ALL: [0, 1, 2], CORNER: [0], "1,1,0,1,1,0": [1, 2], "9,9,9,9,9,9": [2]}),
    *(("off", keyword + squares(end, more).lstrip("\r\n") if end[0] != "\r" else
       (keyword + squares(end, more).lstrip("\r\n")).replace("\n", end),
       {ALL: [0, 1, 2], CORNER: [0, 1, 2]})
      for keyword in ("OFF\n", "OFF # a comment\n", "OFF ", "OFF", "# first\n\nOFF\n", "COFF\n", "NOFF\n", "STCNOFF\n")
      for more in ("", " # red", "#red", " 255 0 0", " 0.5 0.5 0.5 1 # half", " 7")
      for end in ("\n", "\r\n", "\r", "\n\n# between\n")
      if not (end == "\n\n# between\n" and keyword.endswith(("OFF", " ")))),
    *(("stl", text, {"0.5,0.5,0,0.5,0.5,0": [0]}) for text in (
        STL.upper(), STL.replace("\n", "\r\n"), STL.replace("\n", "\n\t\n "), STL.replace("solid test", "solid"),
        STL.replace("solid test", "solid a facet of endsolid"), STL.replace("0 0 1", "nan nan nan"),
        "solid\n" + " ".join(STL.split("\n")[1:-2]) + "\nendsolid")),
    ("stl", 2 * meshes.stl_ascii([((9,) * 3,) * 3, ONE]).decode(), {UNIT_BOX: [1, 3]}),
    *(("obj", text, {POINT: [0], ALL: [0]}) for text in (
        OBJ + "f 1 2 3", OBJ.replace("\n", " 0.5 0.5 0.5\n") + "f 1 2 3\n", OBJ + "vt 0 0\nvn 0 0 1\nf 1/1 2/1/1 3//1\n",
        OBJ + "f -3 -2 -1\nv 9 9 9\n", OBJ + "f \\\n1 2\\\n3 # a comment\n", "f 1 2 3\n" + OBJ,
        "# first\r\n\r\nmtllib a b.mtl\r\n" + OBJ.replace("\n", "\r\n") + "g a\r\ns off\r\nusemtl f\r\nf 1 2 3\r\n",
        OBJ.replace("\n", "\r") + "f 1 2 3\r", "v 0 0 0\nf -1 2 3\nv 1 0 0\nv 0 1 0\n", OBJ + "# f 1 1 1\nf 1 2 3\n",
        OBJ.replace("v", "\tv ") + " f\t1\t2  3 \n")),
    ("obj", GROUPS, {UNIT_BOX: [0, 2, 4]}),
    ("obj", "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 2 5 0\nf 1 2 3 4\nf 1 2 3 6 4\nf 1 2 5 4\nf 1 2 3\nf 1 1 2\n",
     {ALL: list(range(9))}),
]
# Arrows and combs, which no corner or not each sees all of: points that are covered, and points that are not.
SHAPES = [(("0 0 0", "0 4 0", "1 1 0", "4 0 0"), 2, {"2,2,0": False, "0.5,0.5,0": True}),
          (("0 0 0", "6 0 0", "6 4 0", "5 4 0", "5 1 0", "1 1 0", "1 4 0", "0 4 0"), 6,
           {"3,2,0": False, "3,3,0": False, "0.5,3,0": True, "5.5,3,0": True, "3,0.5,0": True, "6.5,2,0": False})]
# Decimals of floats and of doubles.
FLOATS = ("0.1", "+.5e0", "-0.25E+1", "0x1.8p1", "1234567e-3", "557820.13", "0000000000000000000001.5",
          "5.0000000000000000000000000", "1e-45")
DOUBLES = ("557820.15", "1.00000005960464", "1.000000059604645", "16777217", "9007199254740995", "7e-46", "3.4028235677e38",
           "1e99", "0x1p-200", "2.2250738585072012e-308", "123456789012345678e-17", "0.333333333333", "123456789e-4")


class Formats(harness.TestCase):
    def test_same_answers(self):
        triangles = [[(-0.0, 0, 1), (0, -0.0, 1), (2, 0, 1)], *meshes.lattice_triangles(199, seed=2)]
        for name, content in meshes.FORMATS.items():
            answer = self.overlap(self.write(name, content(triangles)), WHERE)
            self.assertEqual((answer["triangles"], answer["indices"]), (200, meshes.overlapping(triangles, WHERE)), name)
            said = self.ask("info", self.path(name), "-o", self.path("mesh.npz"))
            with np.load(self.path("mesh.npz")) as arrays:
                places, faces = arrays["vertices"], arrays["faces"]
                self.assertEqual(sorted(arrays.files), ["faces", "vertices"], name)
            self.assertEqual((said["triangles"], said["positions"], places.dtype, faces.dtype),
                             (200, "float64" if name.endswith("f64") else "float32", said["positions"], np.uint32), name)
            self.assertEqual(places[faces].tolist(), np.array(triangles).tolist(), name)
            self.assertEqual(len(np.unique(places, axis=0)), len(places), name)
            self.assertEqual([said["lo"], said["hi"]], [places.min(0).tolist(), places.max(0).tolist()], name)

    def test_bit_exact(self):
        """A triangle that is a point overlaps a box that is a point just when each coordinate is the same number, wild as it is."""
        pick = np.random.default_rng(3)
        singles = ("little.ply", "big.ply", "cr_lf.ply", "cr.ply", "binary.stl", "solid.stl", "raw.f32")
        for kind, bits, names in (("f4", np.uint32, singles), ("f8", np.uint64, tuple(meshes.FORMATS_OF_DOUBLES))):
            wild = pick.integers(0, np.iinfo(bits).max, 600, bits).view(kind)
            points = wild[np.isfinite(wild)][:180].astype(float).reshape(60, 3)
            for name in names:
                content = (meshes.FORMATS if kind == "f4" else meshes.FORMATS_OF_DOUBLES)[name]
                mesh = self.write(name, content([(p, p, p) for p in points]))
                answers = self.answers(mesh, np.hstack([points, points]).tolist(), "--list")
                self.assertEqual([answer["indices"] for answer in answers], [[i] for i in range(60)], name)
                self.assertEqual(answers[0]["positions"], "float32" if kind == "f4" else "float64")
        for form in ("ascii", "binary_little_endian", "binary_big_endian"):  # doubles that are floats are taken for floats
            mesh = self.write("whole.ply", meshes.ply_of([np.arange(9)], form, kind="double"))
            self.assertEqual(self.overlap(mesh, UNIT_BOX)["positions"], "float32")

    def test_first_byte_of_ply(self):
        """Data that begins with a line end must not be taken for the end of the header."""
        for first, line_end in itertools.product((10, 13, 0x0A0D, 0x0D0A, 0x0A0A0A, 0x0D0D0D, 32, 9, 0), ("\n", "\r\n", "\r")):
            x, = struct.unpack("<f", struct.pack("<I", 0x3F000000 | first))
            mesh = self.write("first.ply", meshes.ply_of([((x, 2.0, 3.0),) * 3], line_end=line_end))
            self.assertEqual(self.overlap(mesh, (x, 2, 3, x, 2, 3))["indices"], [0], (first, line_end))

    def test_types_of_ply(self):
        """Coordinates, counts and indices of every type, beside elements and properties that nobody asks for."""
        whole = ["char", "uchar", "int16", "uint16", "int", "uint32"]
        for count, number in itertools.product(whole, whole + ["float", "double"]):
            elements = [("camera", [("view", "double"), ("more", "uchar", "short")], [[1.5, [7, 8]], [2.5, []]]),
                        ("vertex", [("red", "uchar"), *((axis, number) for axis in "xyz"), ("weights", "int", "float")],
                         [[255, *corner, [0.5, 0.25, 0.125]] for corner in ((0, 0, 0), (4, 0, 0), (0, 4, 0), (3, 2, 1))]),
                        ("face", [("texcoord", "uchar", "float"), ("vertex_index", count, number), ("quality", "float")],
                         [[[0.5], [0, 1, 2], 9], [[0.5], [0, 3, 1], 9]])]
            for form in ("ascii", "binary_little_endian", "binary_big_endian"):
                mesh = self.write("types.ply", meshes.ply(elements, form))
                found = [answer["indices"] for answer in self.answers(mesh, [(3, 2, 1) * 2, (0, 4, 0) * 2], "--list")]
                self.assertEqual(found, [[1], [0]], (count, number, form))

    def test_spellings(self):
        for ending, text, boxes in SPELLINGS:
            mesh = self.write("mesh." + ending, text)
            answers = self.answers(mesh, ("".join(box + "\n" for box in boxes)).encode(), "--list")
            self.assertEqual([answer["indices"] for answer in answers], list(boxes.values()), text)

    def test_numbers(self):
        """Rounded to the nearest, but once: a point and a box that is a point."""
        for text in FLOATS + DOUBLES:
            x = float.fromhex(text) if "x" in text else float(text)
            box = "%s,0,0,%s,0,0" % (text, text) if text in FLOATS else text_of((x, 0, 0, x, 0, 0))
            point = text + " 0 0\n"
            for name, content in (("near.ply", ply_text(3 * point)), ("near.off", "OFF 3 1 0\n" + 3 * point + "3 0 1 2\n"),
                                  ("near.obj", 3 * ("v " + point) + "f 1 2 3\n")):
                answer = self.overlap(self.write(name, content), box)
                kind = "float32" if text in FLOATS else "float64"
                self.assertEqual((answer["indices"], answer["positions"]), ([0], kind), (name, text))

    def test_polygons(self):
        """A fan around a corner that sees all of the polygon, and ears where there is no such corner."""
        for corners, triangles, points in SHAPES:
            for first, form, way in itertools.product(range(len(corners)), ("ply", "off", "obj"), (1, -1)):
                turned = (corners[first:] + corners[:first])[::way]
                mesh = self.write("shape." + form, polygon(turned, form))
                answers = self.answers(mesh, "".join("%s,%s\n" % (p, p) for p in points).encode())
                self.assertEqual([answer["overlapping"] > 0 for answer in answers], list(points.values()), (form, turned))
                self.assertEqual(answers[0]["triangles"], triangles)

    def test_far_back(self):
        """Corners counted back from the last vertex, further than a face; one binary quadrilateral, whose second half is met."""
        t = meshes.lattice_triangles(50, seed=1)
        lines = meshes.obj(t).decode().splitlines()
        vertices = "\n".join(["v 9 9 9", *(line for line in lines if line.startswith("v "))]) + "\n"
        back = "".join("f %d %d %d\n" % (n, n + 1, n + 2) for n in range(-150, 0, 3))
        boxes = [(*np.min(one, 0), *np.max(one, 0)) for one in t]
        found = [[answer["indices"] for answer in self.answers(self.write(name, content), boxes, "--list")]
                 for name, content in (("back.obj", vertices + back), ("floats.f32", meshes.pack_floats(t)))]
        self.assertEqual(found[0], found[1])
        square = [("vertex", meshes.XYZ, [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]), ("face", meshes.CORNERS, [[[0, 1, 2, 3]]])]
        for form in ("binary_little_endian", "binary_big_endian"):
            self.assertEqual(self.overlap(self.write("square.ply", meshes.ply(square, form)), "0,0.9,0,0.1,1,0")["indices"], [1])

    def test_notes(self):
        found = self.overlap(self.write("crossed.obj", CROSSED + "f 1 2 3 4 5 6\nf 1 2 3\n"), ALL,
                             note="warning: .*crossed.obj: 1 polygon cannot be cut well, so the triangles cover too much")
        self.assertEqual(found["triangles"], 5)
        mixed = "OFF 4 5 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n1 0\n2 0 1\n0\n3 0 0 1\n4 0 1 2 3\n"
        for name, content, left_out in (("mixed.off", mixed, (3, 2)), ("mixed.obj", OBJ + "l 1 2\np 3\nf 1 2 3\nl 2 3\n", (1, 3))):
            self.assertRegex(self.succeed("overlap", self.write(name, content), "--box", UNIT_BOX),
                             r"(?m)^triangles +%d \(and %d points or lines, left out\)$" % left_out)

    def test_uncut(self):
        """AC3D, by libassimp, which cuts the polygons itself."""
        self.need("libassimp")
        mesh = self.write("crossed.ac", "AC3Db\nMATERIAL \"\" rgb 1 1 1 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans 0\n"
                          "OBJECT world\nkids 1\nOBJECT poly\nnumvert 6\n" + CROSSED.replace("v ", "") +
                          "numsurf 1\nSURF 0x20\nmat 0\nrefs 6\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n4 0 0\n5 0 0\nkids 0\n")
        for words in (("overlap", mesh, "--box", ALL), ("info", mesh), ("voxelize", mesh, "-r", "9", "--count"),
                      ("partition", mesh, "-r", "9", "-o", self.path("tiles"))):
            told = self.succeed(*words, note="warning: .*crossed.ac: 2 of 4 triangles are missing: libassimp cannot cut polygons "
                                "that cross themselves")
            self.assertRegex(told, "(?m)^triangles +2$")

    def test_scenes(self):
        nodes = [{}, {"translation": [10, 0, 0], "children": [2]}, {"scale": [2, 2, 2], "translation": [0, 20, 0]}]
        mesh, x = self.write("nodes.gltf", meshes.gltf([((0, 0, 0), (1, 0, 0), (0.1, 1, 0))], nodes)), float(np.float32(0.1))
        for box, indices in (((x, 1, 0), [0]), ((11, 0, 0), [1]), ((float(np.float32(10 + 2 * x)), 22, 0), [2]), ((10, 1, 0), [])):
            self.assertEqual(self.overlap(mesh, box + box)["indices"], indices)

    def test_not_finite(self):
        good, bad = ONE, [((NAN, 0, 0), (1, 0, 0), (0, 1, 0)), ((0, 0, 0), (1, -INF, 0), (0, 1, 0)),
                          ((0, 0, 0), (1, 0, 0), (0, 1, INF))]
        for name in sorted(set(meshes.FORMATS) - {"text.gltf", "binary.glb"}):  # whose JSON has no such numbers
            for triangles, expected in (([good, bad[0], good, bad[1]], [0, 2]), (bad, [])):
                count, first = len(triangles) - len(expected), int(bool(expected))
                mesh = self.write(name, meshes.FORMATS[name](triangles))
                answer = self.overlap(mesh, UNIT_BOX, note="warning: .*%s: %d of %d triangles have NaN or infinite coordinates and "
                                      "overlap nothing; the first is number %d$" % (name, count, len(triangles), first))
                self.assertEqual((answer["triangles"], answer["not_finite"], answer["indices"]), (len(triangles), count, expected))
        large = VERTICES.replace("0 0 0", "0 1e999 0")
        for name, content in (("large.obj", "v " + large.strip().replace("\n", "\nv ") + "\nf 1 2 3\n"),
                              ("large.off", "OFF\n3 1 0\n" + large + "3 0 1 2\n"), ("large.ply", ply_text(large))):
            self.succeed("overlap", self.write(name, content), "--box", UNIT_BOX, note="1 of 1 triangles have NaN or infinite")

    def test_degenerate(self):
        """Points and segments are the points and segments that they are, each as often as it is there."""
        triangles = [((1, 1, 1),) * 3, ((-2, -2, -2), (2, 2, 2), (-2, -2, -2)), ((-2, 0, 0), (0, 0, 0), (2, 0, 0)),
                     ONE, ONE, ((3, 3, 3),) * 3, ((1, 1, 1),) * 3, ONE[::-1]] * 3
        boxes = [(1, 1, 1, 1, 1, 1), (0.5, 0.5, 0.5, 0.5, 0.5, 0.5), (0.5, -1, -1, 0.75, 1, 1), (-2, 0, 0, -1, 0, 0),
                 (-9, -9, -9, 9, 9, 9), (1, 1, -1, 2, 2, 0.5), (-1, -1, 1.5, 1, 1, 2)]
        alone = (triangles, triangles[:1] * 100, triangles[1:2] * 100)
        for (name, content), some in itertools.product(meshes.FORMATS.items(), alone):
            answers = self.answers(self.write(name, content(some)), boxes, "--list")
            self.assertEqual([answer["indices"] for answer in answers], [meshes.overlapping(some, box) for box in boxes], name)

    def test_names(self):
        content = meshes.ply_of([ONE])
        for name in ("upper.PLY", "with blank.ply", 'quote" back\\slash.ply', "\u00fcmlaut.ply", "no_ending", "tab\there.ply"):
            mesh = self.write(name, content)
            self.assertEqual(self.overlap(mesh, UNIT_BOX)["mesh"], mesh)


PLY, OFF, GRAMMAR = (meshes.FORMATS[name](TRIANGLES).decode() for name in ("ascii.ply", "text.off", "ascii.stl"))
CROSSED = "v 0 3 0\nv 1 3 0\nv 1 0 0\nv 2 2 0\nv 2 0 0\nv 3 0 0\n"
UNSOUND = "not a sound PLY file: "


def with_word(text, start, word):
    """In place of the first word after it."""
    at = text.index(start) + len(start)
    return text[:at] + word + text[text.index(" ", at):]


# What is no mesh: the name of the file, what is in it and what is said.
BAD = [
    *(("empty" + ending, "", "the file is empty") for ending in (".obj", ".ply", ".off", ".stl", "")),
    *((name, "hello\n", "not a (mesh that libassimp can read, or a damaged one|file of .ply, .off, .stl, .obj, .f32 or .f64)")
      for name in ("notes.txt", "notes.gltf", "no_ending")),
    *(("mesh" + name, gzip.compress(PLY.encode()), "is compressed; give it as in 'zcat FILE | tribox COMMAND - --format ply'")
      for name in (".ply.gz", ".obj.gz", ".ply", ".off")),
    ("notes.obj", "hello\n", "not an OBJ file, or an empty one: it has no line with a vertex, 'v X Y Z'"),
    ("notes.ply", "hello\n", "not a PLY file: it does not begin with 'ply'"),
    ("notes.stl", "hello\n", "truncated, or not an STL file"),
    ("notes.off", "hello\n", "not an OFF file: it does not begin with 'OFF'"), ("counts.off", "OFF\n", "truncated, or not text"),
    *((name, bytes(range(256)) * 40, ".") for name in ("bytes.ply", "bytes.stl", "bytes.obj", "bytes.off", "bytes.glb")),
    *(("points.obj", OBJ + more, "contains no triangles .points or lines at most.; give a mesh with faces")
      for more in ("", "l 1 2\n", "p 1 2\n")),
    ("points.ply", ply_text(VERTICES, ""), "contains no triangles"),
    *((name, content, "contains no triangles") for name, content in (("none.stl", bytes(84)), ("none.f32", ""), ("none.f64", ""))),
    *(("far.ply", ply_text(VERTICES, "3 0 1 2\n3 0 1 %s\n" % n), "damaged: face 1 refers to vertex")
      for n in ("3", "-1", "2147483647", "2147483648", *GIGANTIC)),
    ("far.ply", ply_text(VERTICES, "3 0 1 2\n3 0 1 3\n"), "damaged: face 1 refers to vertex 3, the mesh has 3"),
    *(("far.off", "OFF\n3 1 0\n" + VERTICES + "3 0 1 %s\n" % n, "damaged: face 0 refers to vertex")
      for n in ("3", "-1", "2147483648", *GIGANTIC)),
    *(("far.obj", OBJ + "f 1 2 %s\nv 1 1 1\n" % n if n[0] == "-" else OBJ + "f 1 2 %s\n" % n,
       "damaged: line 4 refers to vertex %s, the file has 3, counted from 1" % n)
      for n in ("4", "-4", "0", "-0", "4/1/1", "2147483648", *GIGANTIC)),
    *(("far.ply", meshes.ply([("vertex", meshes.XYZ, ONE), ("face", meshes.CORNERS, [[[0, 1, n]]])], "binary_%s_endian" % order),
       "damaged: face 0 refers to vertex %d, the mesh has 3" % n)
      for order in ("little", "big") for n in (3, -1, 2 ** 31 - 1, -2 ** 31)),
    *(("header.ply", PLY.replace(old, new), UNSOUND + "'.*' in its header is not understood") for old, new in (
        ("property float x", "property number x"), ("list uchar int", "list uchar"), ("element vertex 60", "element vertex many"),
        ("format ascii", "format morse"))),
    *(("header.ply", PLY.replace(old, new), UNSOUND + ".*" + why) for old, new, why in (
        ("property float z\n", "", "promises 60 of 'vertex' without one x, one y and one z each"),
        ("float z", "float x", "promises 60 of 'vertex' without one x, one y and one z each"),
        ("vertex_indices", "vertices", "promises 20 of 'face' without one list vertex_indices each"),
        ("format ascii 1.0\n", "", "header does not say which format it has"),
        ("element face", "element vertex", "header has 'vertex' twice"))),
    *((name, with_word(text, start, word),
       "damaged: line %d has '%s' where a (number|coordinate of a vertex) should be" % (line, re.escape(word)))
      for name, text, start, line in (("a.ply", PLY, "end_header\n", 11), ("a.off", OFF, "60 20 0\n", 4))
      for word in ("1,5", "0.5f", "x", "1.IND", "--1")),
    *(("words.off", OFF.replace(old, new, 1), "damaged: " + why) for old, new, why in (
        ("3 0 1 2\n", "3 0 1\n", "line 64 ends where the number of a vertex should follow"),
        ("3 0 1 2\n", "3 0 1 #2\n", "line 64 ends where the number of a vertex should follow"),
        ("60 20 0\n", "60 20 0\n1 2\n", "line 4 ends where a coordinate of a vertex should follow"),
        ("3 0 1 2\n", "3 0 1 2.5\n", "line 64 has '2.5' where the number of a vertex should be"))),
    *(("words.obj", OBJ + line + "f 1 2 3\n", "damaged: line 4 " + why) for line, why in (
        ("v 1 2 x\n", "has 'x' where a coordinate of a vertex should be"), ("v 1,2 3\n", "has '1,2' where"),
        ("v 1 2\n\n", "ends where a coordinate of a vertex should follow"),
        ("v 1 2 # 3\n", "ends where a coordinate of a vertex should follow"),
        ("f 1 2 3.5\n", "has '3.5' where the number of a vertex should be"),
        ("f 1 2 --3\n", "has '--3' where"), ("f 1 2 3/x\n", "has '3/x' where"),
        ("f 1 2 /3\n", "has '/3' where"), ("f\n", "ends where the number of a vertex should follow"))),
    *(("grammar.stl", GRAMMAR.replace(old, new, count) + " \n", "damaged: line " + why) for old, new, count, why in (
        ("outer", "inner", 1, "3 has 'inner' where 'outer' should be"),
        ("vertex", "normal", 1, "4 has 'normal' where 'vertex' should be"),
        ("endloop", "vertex 1 2 3\nendloop", 1, "7 has 'vertex' where 'endloop' should be"),
        ("facet", "point", 1, "2 has 'point' where 'facet' or 'endsolid' should be"),
        ("endsolid test\n", "endsolid test\nmore\n", -1, "143 has 'more' where 'solid' should be"))),
    ("binary.off", b"OFF BINARY\n" + bytes(99), "is binary, and only OFF as text is read"),
    *(("four.off", word + "\n3 1 0\n", "has vertices of other than three coordinates") for word in ("4OFF", "nOFF", "C4nOFF")),
    # Counts beyond all reason.
    *(("more.ply", ply_text(VERTICES).replace(old, old[:-1] + n), "truncated: the header promises [0-9]+ of '%s'" % old.split()[0])
      for n in GIGANTIC for old in ("vertex 3", "face 1")),
    *(("none.ply", re.sub("property.*\n", "", ply_text(VERTICES).replace("face 1", "face " + n)),
       UNSOUND + r"the header promises [0-9]+ of '\w+' without a property") for n in GIGANTIC),
    *(("other.ply", ply_text(VERTICES, end_header="element other %s\n%send_header" % (n, more)), why)
      for n in GIGANTIC for more, why in (
        ("", UNSOUND + "the header promises [0-9]+ of 'other' without"),
        ("property double d\n", "truncated: the header promises [0-9]+ of 'other', the file has bytes for [0-9]+ at most"))),
    *(("list.ply", ply_text(VERTICES, n + " 0 1 2\n"), "truncated: ") for n in GIGANTIC),
    *(("list.ply", ply_text(VERTICES, n + " 0 1 2\n"), "damaged: number 0 of 'face' has a list of %s values" % n)
      for n in ("-1", "1.5")),
    *(("list.ply", meshes.ply([("vertex", meshes.XYZ, ONE), ("face", [("vertex_indices", "uint", "int")], [[[0, 1, 2]]])])[:-16] +
       struct.pack("<I3i", n, 0, 1, 2), "truncated: ") for n in (0x7FFFFFFF, 0x80000000, 0xFFFFFFFF)),
    *(("more.off", "OFF\n%s %s 0\n%s3 0 1 2\n" % (*counts, VERTICES), "truncated: ")
      for n in GIGANTIC for counts in ((n, 1), (3, n), (n, 2), (n, n))),
    *(("corners.off", "OFF\n3 1 0\n%s%s 0 1 2\n" % (VERTICES, n), "truncated: face 0 has fewer than its") for n in GIGANTIC),
    # 50 n + 84 is the size of the file in 32 bits for the last of these numbers.
    *(("count.stl", head + struct.pack("<I", n) + meshes.stl_binary(TRIANGLES * 4)[84:],
       "%s, or not an STL file: it has 4084 bytes where a binary STL file of %d triangles, as its header says, has %d; "
       "write it again" % ("truncated" if n > 80 else "has bytes after its last triangle", n, 84 + 50 * n))
      for n in (0, 79, 81, 2 ** 31 - 1, 2 ** 31, 2 ** 32 - 1, 80 + 2 ** 31)
      for head in (b"made by a test".ljust(80), b"solid".ljust(80), bytes(80))),
]


class Bad(harness.TestCase):
    def setUp(self):
        super().setUp()
        self.limit = (resource.RLIMIT_AS, 512 * MIB)
        if harness.run("info", limit=self.limit).code:
            self.limit = None  # a sanitizer needs terabytes of addresses

    def refuse_file(self, path, pattern, *question):
        self.fail_with(1, "^tribox overlap: [^\n]*%s: %s" % (os.path.basename(path), pattern),
                       "overlap", path, *(question or ("--box", UNIT_BOX)),
                       stdin=b"0 0 0 1 1 1\n", limit=self.limit)

    def test_files(self):
        """One question about one box, and some about many, which need the mesh in memory."""
        for n, (name, content, pattern) in enumerate(BAD):
            if not (name.endswith((".gltf", ".glb")) and harness.lacks("libassimp")):
                with self.subTest(name=name, pattern=pattern, row=n):
                    path = self.write(name, content)
                    self.refuse_file(path, pattern, *((), ("--boxes", "-", "--json"), ("--box", UNIT_BOX, "--list"))[n % 3])

    def test_no_file(self):
        for ending in (".ply", ".stl", ".f32", ".obj"):
            self.refuse_file(self.path("missing" + ending), "cannot open the mesh file: No such file")
            os.mkdir(self.path("folder" + ending))
            self.refuse_file(self.path("folder" + ending), "is a directory; give a mesh file")
        self.refuse_file("/dev/null", "is not a regular file")
        path = self.write("locked.ply", meshes.ply_of(TRIANGLES))
        os.chmod(path, 0)
        if not os.access(path, os.R_OK):  # as root may
            self.refuse_file(path, "cannot open the mesh file: Permission denied")

    def test_part_is_damaged(self):
        mesh = self.write("scene.gltf", "{}")
        self.write("tribox_assimp.so", "no library\n")
        self.fail_with(1, "scene.gltf: not a file of .*, and what reads others cannot be loaded: .*tribox_assimp.so", "overlap",
                       mesh, "--box", UNIT_BOX, env={"LD_LIBRARY_PATH": self.folder})

    def test_cut(self):
        """At every place that a reader could stumble over; the last byte of a text is a line end, without which it is whole."""
        again = r"[^\n]*; write it again"
        for name, least, pattern in (
                *((name, 1, "truncated: " + again) for name in ("little.ply", "big.ply", "cr_lf.ply", "cr.ply")),
                ("ascii.ply", 3, "truncated: " + again), ("binary.stl", 1, "truncated, or not an STL file" + again),
                ("solid.stl", 1, "(truncated%s|no triangles|not a mesh)" % again),
                ("ascii.stl", 14, "(truncated%s|not a mesh)" % again), ("text.off", 4, "(truncated%s|not a mesh)" % again),
                ("text.obj", 0, "(truncated|not an OBJ file|contains no triangles)"),
                ("text.gltf", 1, "not a mesh"), ("binary.glb", 1, "not a mesh"),
                ("raw.f32", 1, "truncated, or not raw triangles: after [0-9]+ triangles of 36 bytes "
                               "it has [0-9]+ bytes more" + again)):
            if name.endswith((".gltf", ".glb")) and harness.lacks("libassimp"):
                continue
            whole = meshes.FORMATS[name](TRIANGLES)
            self.assertEqual(self.overlap(self.write(name, whole), UNIT_BOX)["triangles"], len(TRIANGLES))
            end = (whole.index(b"f ") if name == "text.obj" else len(whole)) - least
            at_an_end = {n for n in range(len(whole)) if name == "raw.f32" and n % 36 == 0}
            for size in sorted({*range(4, end, 97), *range(end - 10, end + 1)} - at_an_end):
                self.refuse_file(self.write(name, whole[:size]), pattern)
        for size in (1, 35, 71, 73, 72 * 4096 + 8):
            form, of_one = (("f64", 72), ("f32", 36))[size in (35, 71)]
            self.refuse_file(self.write("cut." + form, bytes(size)),
                             "truncated, or not raw triangles: after %d triangles of %d bytes it has %d bytes more; "
                             "write it again" % (size // of_one, of_one, size % of_one))
        self.assertEqual(self.overlap(self.write("cut.f32", meshes.pack_floats(TRIANGLES)[:36 * 7]), UNIT_BOX)["triangles"], 7)

    def test_gltf(self):
        """Some of these numbers libassimp takes for none."""
        counts = (("accessors", "count"), ("buffers", "byteLength"), ("bufferViews", "byteLength"))
        for n, (part, key) in itertools.product(GIGANTIC, counts):
            document = json.loads(meshes.gltf(TRIANGLES))
            document[part][0][key] = int(n)
            result = harness.run("overlap", self.write("more.gltf", json.dumps(document)), "--box", UNIT_BOX, limit=self.limit)
            self.assertIn(result.code, (0, 1), (part, key, n))
            if result.code:
                self.assert_one_line(result.stderr, "not a mesh that libassimp can read, or a damaged one")


if __name__ == "__main__":
    harness.main()
