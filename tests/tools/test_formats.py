"""Mesh files: the same triangles from every format, bit for bit where the format is binary, and what a scene does to them."""

import json
import math
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
        result = support.run("overlap", mesh, "--box", "-9,-9,-9,9,9,9", "--json")
        missing = 5 - json.loads(result.stdout)["triangles"]
        if missing:
            self.assert_one_line(result.stderr, "warning: .*crossed.obj: %d of 5 triangles are missing: libassimp cannot" % missing)
        else:
            self.assertEqual(result.stderr, "")

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
