"""Mesh files: the same triangles from every format, bit for bit where the format is binary, and what a scene does to them."""

import itertools
import json
import math
import os
import random
import struct
import subprocess

import meshes
import support


def float_of(bits):
    return struct.unpack("<f", struct.pack("<I", bits))[0]


def wild_points(count, seed):
    """Finite floats of every size and sign, subnormal ones among them."""
    pick = random.Random(seed)
    floats = iter(lambda: float_of(pick.getrandbits(32)), None)
    finite = (x for x in floats if math.isfinite(x))
    return [tuple(next(finite) for _ in range(3)) for _ in range(count)]


class Formats(support.TestCase):
    def test_same_answers(self):
        triangles = meshes.lattice_triangles(200, seed=2)
        box = (-0.75, -0.5, -0.5, 0.5, 0.5, 1)
        expected = meshes.overlapping(triangles, box)
        for name, content in meshes.FORMATS.items():
            with self.subTest(name):
                mesh = self.write(name, content(triangles))
                answer = self.overlap(mesh, ",".join(map(str, box)))
                self.assertEqual((answer["triangles"], answer["indices"]), (200, expected))

    def test_bit_exact(self):
        """A triangle that is a point overlaps a box that is a point just when every coordinate is the same float."""
        points = wild_points(60, seed=3)
        boxes = "".join("%.9g %.9g %.9g %.9g %.9g %.9g\n" % (p + p) for p in points)
        for name in ("little.ply", "big.ply", "cr_lf.ply", "cr.ply", "binary.stl", "solid.stl", "raw.f32"):
            with self.subTest(name):
                mesh = self.write(name, meshes.FORMATS[name]([(p, p, p) for p in points]))
                text = self.succeed("overlap", mesh, "--boxes", "-", "--json", "--list", stdin=boxes.encode())
                self.assertEqual([json.loads(line)["indices"] for line in text.splitlines()], [[i] for i in range(60)])

    def test_first_byte_of_ply(self):
        """Data that begins with a line end must not be taken for the end of the header."""
        for first in (10, 13, 0x0A0D, 0x0D0A, 0x0A0A0A0A, 0x0D0D0D0D, 32, 9, 0):
            x = float_of(0x3F000000 | first)
            point = (x, 2.0, 3.0)
            for line_end in ("\n", "\r\n", "\r"):
                mesh = self.write("first.ply", meshes.ply_binary([(point, point, point)], line_end=line_end))
                self.assertEqual(self.overlap(mesh, "%.9g,2,3,%.9g,2,3" % (x, x))["indices"], [0], (first, line_end))

    def test_types_of_ply(self):
        """Coordinates, counts and indices of every type, beside elements and properties that nobody asks for."""
        whole, indices = [("char", "b"), ("uchar", "B"), ("int16", "h"), ("uint16", "H"), ("int", "i"), ("uint32", "I")], [0, 1, 2, 0, 3, 1]
        corners = [(0, 0, 0), (4, 0, 0), (0, 4, 0), (3, 2, 1)]
        for (count, count_code), (number, code) in itertools.product(whole, whole + [("float", "f"), ("double", "d")]):
            lines = ["ply", "format %s 1.0", "obj_info a test", "element camera 2", "property double view", "property list uchar short more",
                     "element vertex 4", "property uchar red"] + ["property %s %s" % (number, axis) for axis in "xyz"]
            lines += ["property list int float weights", "element face 2", "property list uchar float texcoord",
                      "property list %s %s vertex_index" % (count, number), "property float quality", "end_header", ""]
            form = "dB2hdB" + ("B3" + code + "i3f") * 4 + ("Bf" + count_code + "3" + code + "f") * 2
            values = [1.5, 2, 7, 8, 2.5, 0]
            for corner in corners:
                values += [255, *corner, 3, 0.5, 0.25, 0.125]
            for i in range(2):
                values += [1, 0.5, 3, *indices[3 * i:3 * i + 3], 9]
            for name, body in (("ascii", " ".join(map(str, values)).encode()), ("binary_little_endian", struct.pack("<" + form, *values)),
                               ("binary_big_endian", struct.pack(">" + form, *values))):
                mesh = self.write("types.ply", ("\n".join(lines) % name).encode() + body)
                self.assertEqual(self.overlap(mesh, "3,2,1,3,2,1")["indices"], [1], (count, number, name))
                self.assertEqual(self.overlap(mesh, "0,4,0,0,4,0")["indices"], [0], (count, number, name))

    def test_faces_before_vertices_of_ply(self):
        header = meshes.ply_header("ascii", 3, 2).split(b"\n")
        vertex, face = header[3:7], header[7:9]
        mesh = self.write("turned.ply", b"\n".join(header[:3] + face + vertex + header[9:]) + b"3 0 0 0\n3 0 1 2\n9 9 9\n1 0 0\n0 1 0\n")
        self.assertEqual(self.overlap(mesh, "0.5,0.5,0,0.5,0.5,0")["indices"], [1])

    def test_strips_of_ply(self):
        header = meshes.ply_header("ascii", 5, 1, element="tristrips").replace(b"uchar", b"int")
        mesh = self.write("strips.ply", header + b"0 0 0\n1 0 0\n0 1 0\n1 1 0\n9 9 9\n8 0 1 2 3 -1 2 3 4\n")
        self.assertEqual(self.overlap(mesh, "-9,-9,-9,9,9,9")["triangles"], 3)
        for box, indices in (("0,0,0,0,0,0", [0]), ("1,1,0,1,1,0", [1, 2]), ("9,9,9,9,9,9", [2])):
            self.assertEqual(self.overlap(mesh, box)["indices"], indices)

    def test_kinds_of_off(self):
        """Comments anywhere, colours and normals after coordinates, colours after faces, counts beside the keyword."""
        vertices, faces = ("0 0 0", "1 0 0", "0 1 0", "1 1 0"), ("3 0 1 2", "4 0 1 3 2")
        for keyword in ("OFF\n", "OFF # a comment\n", "OFF ", "OFF", "# first\n\nOFF\n", "COFF\n", "NOFF\n", "STCNOFF\n"):
            for more in ("", " # red", "#red", " 255 0 0", " 0.5 0.5 0.5 1 # half", " 7"):
                for line_end in ("\n", "\r\n", "\r", "\n\n# between\n"):
                    content = keyword + "4 2 0" + "".join(line_end + line + more for line in vertices + faces)
                    mesh = self.write("kinds.off", content.replace("\n", line_end) if line_end[0] == "\r" else content)
                    answer = self.overlap(mesh, "0,0,0,0,0,0")
                    self.assertEqual((answer["triangles"], answer["indices"]), (3, [0, 1, 2]), content)

    def test_layout_of_stl(self):
        """Letters of either case, names of solids, lines that are not those of others."""
        text = meshes.stl_ascii([((0, 0, 0), (1, 0, 0), (0, 1, 0))]).decode()
        for content in (text.upper(), text.replace("\n", "\r\n"), text.replace("\n", "\n\t\n "), text.replace("solid test", "solid"),
                        text.replace("solid test", "solid a facet of endsolid"), text.replace("0 0 1", "nan nan nan"),
                        "solid\n" + " ".join(text.split("\n")[1:-2]) + "\nendsolid"):
            self.assertEqual(self.overlap(self.write("layout.stl", content), "0.5,0.5,0,0.5,0.5,0")["indices"], [0], content)

    def positions(self, mesh):
        return json.loads(self.succeed("overlap", mesh, "--box", support.UNIT_BOX, "--json"))["positions"]

    def test_text_is_rounded_to_the_nearest(self):
        """A point and a box that is a point: floats and decimals that floats give back, doubles otherwise, rounded but once."""
        cases = [("0.1", "float32"), ("+.5e0", "float32"), ("-0.25E+1", "float32"), ("0x1.8p1", "float32"), ("1234567e-3", "float32"),
                 ("557820.13", "float32"), ("0000000000000000000001.5", "float32"), ("5.0000000000000000000000000", "float32"), ("1e-45", "float32"),
                 ("557820.15", "float64"), ("1.00000005960464", "float64"), ("1.000000059604645", "float64"), ("16777217", "float64"),
                 ("9007199254740995", "float64"), ("7e-46", "float64"), ("3.4028235677e38", "float64"), ("1e99", "float64"), ("0x1p-200", "float64"),
                 ("2.2250738585072012e-308", "float64"), ("123456789012345678e-17", "float64"), ("0.333333333333", "float64"), ("123456789e-4", "float64")]
        for text, positions in cases:
            point, triangle = "%s 0 0\n" % text, "3 0 1 2\n"
            exact = struct.unpack("<d", struct.pack("<d", float.fromhex(text) if "x" in text else float(text)))[0]
            box = "%s,0,0,%s,0,0" % (2 * (text,)) if positions == "float32" else "%.17g,0,0,%.17g,0,0" % (exact, exact)
            for name, content in (("near.ply", meshes.ply_header("ascii", 3, 1).decode() + 3 * point + triangle),
                                  ("near.off", "OFF 3 1 0\n" + 3 * point + triangle), ("near.obj", 3 * ("v " + point) + "f 1 2 3\n")):
                mesh = self.write(name, content)
                self.assertEqual((self.overlap(mesh, box)["indices"], self.positions(mesh)), ([0], positions), text)

    def test_doubles_of_ply(self):
        """Bit for bit in every form; doubles that are floats are taken for floats."""
        pick = random.Random(11)
        wild = (struct.unpack("<d", struct.pack("<Q", pick.getrandbits(64)))[0] for _ in iter(int, 1))
        finite = (x for x in wild if math.isfinite(x))
        points = [tuple(next(finite) for _ in range(3)) for _ in range(20)]
        boxes = "".join("%.17g %.17g %.17g %.17g %.17g %.17g\n" % (p + p) for p in points)
        for form, order in (("ascii", ""), ("binary_little_endian", "<"), ("binary_big_endian", ">")):
            header = meshes.ply_header(form, 60, 20).replace(b"float", b"double")
            numbers = [x for p in points for _ in range(3) for x in p]
            body = struct.pack(order + "180d", *numbers) if order else (" ".join(map(repr, numbers)) + "\n").encode()
            faces = [(3, 3 * i, 3 * i + 1, 3 * i + 2) for i in range(20)]
            body += b"".join(struct.pack(order + "B3i", *f) if order else b"%d %d %d %d\n" % f for f in faces)
            mesh = self.write("doubles.ply", header + body)
            text = self.succeed("overlap", mesh, "--boxes", "-", "--json", "--list", stdin=boxes.encode())
            self.assertEqual([json.loads(line)["indices"] for line in text.splitlines()], [[i] for i in range(20)], form)
            self.assertEqual(self.positions(mesh), "float64")
            whole = struct.pack(order + "9d", *range(9)) if order else b"0 1 2 3 4 5 6 7 8 "
            face = struct.pack(order + "B3i", 3, 0, 1, 2) if order else b"3 0 1 2\n"
            mesh = self.write("whole.ply", meshes.ply_header(form, 3, 1).replace(b"float", b"double") + whole + face)
            self.assertEqual(self.positions(mesh), "float32")
        tenth = meshes.ply_header("ascii", 3, 1) + b"0.1 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
        self.assertEqual(self.positions(self.write("tenth.ply", tenth)), "float32")
        self.assertEqual(self.positions(self.write("tenth.ply", tenth.replace(b"float", b"double"))), "float64")

    def test_polygons_of_ply_and_off(self):
        """A fan around a corner that sees all of the polygon, and ears where there is no such corner."""
        arrow = ("0 0 0", "0 4 0", "1 1 0", "4 0 0")
        for first in range(4):
            turned = arrow[first:] + arrow[:first]
            for name, start in (("arrow.ply", meshes.ply_header("ascii", 4, 1).decode()), ("arrow.off", "OFF 4 1 0\n")):
                mesh = self.write(name, start + "".join(p + "\n" for p in turned) + "4 0 1 2 3\n")
                self.assertEqual(self.overlap(mesh, "2,2,0,2,2,0")["overlapping"], 0)
                self.assertEqual(self.overlap(mesh, "0.5,0.5,0,0.5,0.5,0")["overlapping"] > 0, True)
        # Two teeth, which no corner sees at once: neither the gap between them nor what is outside is covered.
        corners = ("0 0 0", "6 0 0", "6 4 0", "5 4 0", "5 1 0", "1 1 0", "1 4 0", "0 4 0")
        for first in range(8):
            for turned in (corners[first:] + corners[:first], (corners[first:] + corners[:first])[::-1]):
                for name, content in (("comb.off", "OFF 8 1 0\n" + "".join(p + "\n" for p in turned) + "8 0 1 2 3 4 5 6 7\n"),
                                      ("comb.obj", "".join("v " + p + "\n" for p in turned) + "f 1 2 3 4 5 6 7 8\n")):
                    mesh = self.write(name, content)
                    self.assertEqual(self.overlap(mesh, "-9,-9,-9,9,9,9")["triangles"], 6)
                    for point, is_inside in (("3,2,0", 0), ("3,3,0", 0), ("0.5,3,0", 1), ("5.5,3,0", 1), ("3,0.5,0", 1), ("6.5,2,0", 0)):
                        self.assertEqual(self.overlap(mesh, point + "," + point)["overlapping"] > 0, bool(is_inside), (turned, point))
        mixed = "OFF 4 5 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n1 0\n2 0 1\n0\n3 0 0 1\n4 0 1 2 3\n"
        self.assertRegex(self.succeed("overlap", self.write("mixed.off", mixed), "--box", support.UNIT_BOX),
                         r"(?m)^triangles +3 \(and 2 points or lines, left out\)$")

    def test_polygons(self):
        mesh = self.write("polygons.obj", "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 2 5 0\n"
                          "f 1 2 3 4\nf 1 2 3 6 4\nf 1 2 5 4\nf 1 2 3\nf 1 1 2\n")
        self.assertEqual(self.overlap(mesh, "-9,-9,-9,9,9,9")["triangles"], 2 + 3 + 2 + 1 + 1)
        # The third polygon is an arrow that leaves out the corner at (4, 4): cut well, it does not cover (2, 2).
        mesh = self.write("arrow.obj", "v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\nf 1 2 3 4\n")
        self.assertEqual(self.overlap(mesh, "2,2,0,2,2,0")["overlapping"], 0)
        self.assertEqual(self.overlap(mesh, "0.5,0.5,0,0.5,0.5,0")["overlapping"] > 0, True)

    def test_polygons_that_cannot_be_cut(self):
        mesh = self.write("crossed.obj", "v 0 3 0\nv 1 3 0\nv 1 0 0\nv 2 2 0\nv 2 0 0\nv 3 0 0\nf 1 2 3 4 5 6\nf 1 2 3\n")
        text = self.succeed_with_note("warning: .*crossed.obj: 1 polygon cannot be cut well, so the triangles cover too much", "overlap", mesh, "--box",
                                      "-9,-9,-9,9,9,9", "--json")
        self.assertEqual(json.loads(text)["triangles"], 5)

    def test_forms_of_obj(self):
        """Numbers after the coordinates, texture and normals, negative numbers, continued lines, faces before their vertices."""
        vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
        for content in (vertices + "f 1 2 3", vertices.replace("\n", " 0.5 0.5 0.5\n") + "f 1 2 3\n", vertices + "vt 0 0\nvn 0 0 1\nf 1/1 2/1/1 3//1\n",
                        vertices + "f -3 -2 -1\nv 9 9 9\n", vertices + "f \\\n1 2\\\n3 # a comment\n", "f 1 2 3\n" + vertices,
                        "# first\r\n\r\nmtllib a b.mtl\r\n" + vertices.replace("\n", "\r\n") + "g a\r\ns off\r\nusemtl f\r\nf 1 2 3\r\n",
                        vertices.replace("\n", "\r") + "f 1 2 3\r", "v 0 0 0\nf -1 2 3\nv 1 0 0\nv 0 1 0\n",
                        vertices + "# f 1 1 1\nf 1 2 3\n", vertices.replace("v", "\tv ") + " f\t1\t2  3 \n"):
            answer = self.overlap(self.write("form.obj", content), "0.25,0.25,0,0.25,0.25,0")
            self.assertEqual((answer["triangles"], answer["indices"]), (1, [0]), content)

    def test_points_and_lines_are_left_out(self):
        mesh = self.write("mixed.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\np 3\nf 1 2 3\nl 2 3\n")
        self.assertRegex(self.succeed("overlap", mesh, "--box", support.UNIT_BOX),
                         r"(?m)^triangles +1 \(and 3 points or lines, left out\)$")
        self.assertEqual(self.overlap(mesh, support.UNIT_BOX)["indices"], [0])

    def test_order_of_groups_and_materials(self):
        mesh = self.write("groups.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\no a\nusemtl A\nf 1 2 3\nusemtl B\nf 4 4 4\n"
                          "usemtl A\nf 1 2 3\ng b\nf 4 4 4\no c\nusemtl B\nf 1 2 3\n")
        self.assertEqual(self.overlap(mesh, support.UNIT_BOX)["indices"], [0, 2, 4])

    def test_solids_of_stl(self):
        triangle, far = ((0, 0, 0), (1, 0, 0), (0, 1, 0)), ((9, 9, 9), (9, 9, 9), (9, 9, 9))
        mesh = self.write("solids.stl", meshes.stl_ascii([far, triangle]) + meshes.stl_ascii([far, triangle]))
        self.assertEqual(self.overlap(mesh, support.UNIT_BOX)["indices"], [1, 3])

    def test_transforms_of_a_scene(self):
        triangle = ((0, 0, 0), (1, 0, 0), (0.1, 1, 0))
        nodes = [{}, {"translation": [10, 0, 0], "children": [2]}, {"scale": [2, 2, 2], "translation": [0, 20, 0]}]
        mesh = self.write("nodes.gltf", meshes.gltf([triangle], nodes))
        x = float_of(0x3DCCCCCD)  # 0.1
        for box, indices in (((x, 1, 0), [0]), ((11, 0, 0), [1]), ((10 + 2 * x, 22, 0), [2]), ((10, 1, 0), [])):
            self.assertEqual(self.overlap(mesh, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g" % (box + box))["indices"], indices)

    def test_not_finite(self):
        nan, inf = math.nan, math.inf
        good = ((0, 0, 0), (1, 0, 0), (0, 1, 0))
        triangles = [good, ((nan, 0, 0), (1, 0, 0), (0, 1, 0)), good, ((0, 0, 0), (1, -inf, 0), (0, 1, 0))]
        for name in sorted(set(meshes.FORMATS) - {"text.gltf", "binary.glb"}):  # whose JSON has no such numbers
            mesh = self.write(name, meshes.FORMATS[name](triangles))
            text = self.succeed_with_note("warning: .*%s: 2 of 4 triangles have NaN or infinite coordinates and "
                                          "overlap nothing; the first is number 1$" % name,
                                          "overlap", mesh, "--box", support.UNIT_BOX, "--json", "--list")
            answer = json.loads(text)
            self.assertEqual((answer["triangles"], answer["not_finite"], answer["indices"]), (4, 2, [0, 2]))

    def test_names(self):
        content = meshes.ply_binary([((0, 0, 0), (1, 0, 0), (0, 1, 0))])
        for name in ("upper.PLY", "with blank.ply", 'quote" back\\slash.ply', "\u00fcmlaut.ply", "no_ending", "tab\there.ply"):
            mesh = self.write(name, content)
            self.assertEqual(self.overlap(mesh, support.UNIT_BOX)["mesh"], mesh)
        mesh = self.write(b"not \xff utf-8.ply".decode(errors="surrogateescape"), content)
        output = subprocess.run([support.program(), "overlap", mesh, "--box", support.UNIT_BOX, "--json"], capture_output=True, check=True)
        self.assertIn("not \udcff utf-8.ply", json.loads(output.stdout.decode())["mesh"])


if __name__ == "__main__":
    support.main()
