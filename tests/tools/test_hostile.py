"""Meshes that promise more than there is, refer to what is not there, or hold triangles that are none: never a crash, a hang or a guess."""

import json
import math
import resource
import struct

import meshes
import support

TRIANGLES = meshes.lattice_triangles(20, seed=4)
VERTICES = "0 0 0\n1 0 0\n0 1 0\n"
GIGANTIC = ("4294967295", "4294967297", "99999999999", "18446744073709551615", "18446744073709551616", "9" * 40)


class Gigantic(support.TestCase):
    """Counts beyond all reason, in memory that would not do for one of them."""

    def setUp(self):
        super().setUp()
        self.limit = (resource.RLIMIT_AS, 512 << 20)
        if support.run("info", limit=self.limit).code:
            self.limit = None  # a sanitizer needs terabytes of addresses

    def refuse(self, name, content, pattern):
        path = self.write(name, content)
        self.fail_with(1, r"^tribox overlap: [^\n]*%s: %s" % (name, pattern), "overlap", path, "--box", support.UNIT_BOX, limit=self.limit)

    def test_ply(self):
        bodies = {"ascii": (VERTICES + "3 0 1 2\n").encode(),
                  "binary_little_endian": meshes.pack_floats(TRIANGLES[:1]) + struct.pack("<B3i", 3, 0, 1, 2),
                  "binary_big_endian": meshes.pack_floats(TRIANGLES[:1], ">") + struct.pack(">B3i", 3, 0, 1, 2)}
        for form, body in bodies.items():
            header = meshes.ply_header(form, 3, 1)
            self.assertEqual(self.overlap(self.write("sound.ply", header + body), support.UNIT_BOX)["triangles"], 1)
            for count in (count.encode() for count in GIGANTIC):
                for element, old in ((b"vertex", b"vertex 3"), (b"face", b"face 1")):
                    more = header.replace(old, element + b" " + count)
                    self.refuse("more.ply", more + body, "truncated: the header promises [0-9]+ of '%s'" % element.decode())
                    properties = [line for line in more.split(b"\n") if not line.startswith(b"property")]
                    self.refuse("none.ply", b"\n".join(properties) + body, r"not a sound PLY file: the header promises [0-9]+ of '\w+' "
                                "without a property")
                other = header.replace(b"end_header", b"element other " + count + b"\nend_header")
                self.refuse("other.ply", other + body, "not a sound PLY file: the header promises [0-9]+ of 'other' without")
                other = header.replace(b"end_header", b"element other " + count + b"\nproperty double d\nend_header")
                self.refuse("other.ply", other + body, "truncated: the header promises [0-9]+ of 'other', the file has bytes for [0-9]+ at most")

    def test_lists_of_ply(self):
        for count in GIGANTIC:
            self.refuse("list.ply", meshes.ply_header("ascii", 3, 1) + (VERTICES + count + " 0 1 2\n").encode(), "truncated: ")
        for count in ("-1", "1.5"):
            self.refuse("list.ply", meshes.ply_header("ascii", 3, 1) + (VERTICES + count + " 0 1 2\n").encode(),
                        "damaged: number 0 of 'face' has a list of %s values" % count)
        header = meshes.ply_header("binary_little_endian", 3, 1).replace(b"list uchar", b"list uint")
        for count in (0x7FFFFFFF, 0x80000000, 0xFFFFFFFF):
            body = meshes.pack_floats(TRIANGLES[:1]) + struct.pack("<I3i", count, 0, 1, 2)
            self.refuse("list.ply", header + body, "truncated: ")

    def test_off(self):
        for count in GIGANTIC:
            for counts in ((count, 1), (3, count), (count, 2), (count, count)):
                self.refuse("more.off", "OFF\n%s %s 0\n%s3 0 1 2\n" % (*counts, VERTICES), "truncated: ")
            self.refuse("corners.off", "OFF\n3 1 0\n%s%s 0 1 2\n" % (VERTICES, count), "truncated: face 0 has fewer than its")

    def test_stl(self):
        """50 n + 84 is the size of the file in 32 bits for the last of these numbers."""
        whole = meshes.stl_binary(TRIANGLES * 4)
        self.assertEqual((50 * (80 + 2 ** 31) + 84) % 2 ** 32, len(whole))
        for count in (0, 79, 81, 2 ** 31 - 1, 2 ** 31, 2 ** 32 - 1, 80 + 2 ** 31):
            what = "truncated" if count > 80 else "has bytes after its last triangle"
            for header in (whole[:80], b"solid" + whole[5:80], bytes(80)):
                content = header + struct.pack("<I", count) + whole[84:]
                self.refuse("count.stl", content, "%s, or not an STL file: it has 4084 bytes where a binary STL file of %d triangles, as "
                            "its header says, has %d; write it again" % (what, count, 84 + 50 * count))

    def test_gltf(self):
        for count in GIGANTIC:
            for part, key in (("accessors", "count"), ("buffers", "byteLength"), ("bufferViews", "byteLength")):
                document = json.loads(meshes.gltf(TRIANGLES))
                document[part][0][key] = int(count)
                result = support.run("overlap", self.write("more.gltf", json.dumps(document)), "--box", support.UNIT_BOX, limit=self.limit)
                self.assertIn(result.code, (0, 1), (part, key, count))  # some of these numbers libassimp takes for none
                if result.code:
                    self.assert_one_line(result.stderr, "not a mesh that libassimp can read, or a damaged one")


class FarIndices(support.TestCase):
    """An index of 2^32 is no 0, and one of 2^32 + 1 no 1."""

    def test_far(self):
        for index in ("3", "-1", "2147483647", "2147483648") + GIGANTIC:
            for name, content in (("far.ply", meshes.ply_header("ascii", 3, 1) + (VERTICES + "3 0 1 %s\n" % index).encode()),
                                  ("far.off", "OFF\n3 1 0\n%s3 0 1 %s\n" % (VERTICES, index))):
                self.fail_with(1, "%s: damaged: face 0 refers to vertex" % name, "overlap", self.write(name, content), "--box",
                               support.UNIT_BOX)
        for index in ("4", "-4", "0", "2147483647", "2147483648") + GIGANTIC:
            content = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 %s\n" % index
            self.fail_with(1, "far.obj: damaged: line 4 refers to vertex %s, the file has 3, counted from 1" % index, "overlap",
                           self.write("far.obj", content), "--box", support.UNIT_BOX)

    def test_binary_ply(self):
        for order, form in (("<", "binary_little_endian"), (">", "binary_big_endian")):
            for index in (3, -1, 2 ** 31 - 1, -2 ** 31):
                content = meshes.ply_header(form, 3, 1) + meshes.pack_floats(TRIANGLES[:1], order) + struct.pack(order + "B3i", 3, 0, 1, index)
                self.fail_with(1, "far.ply: damaged: face 0 refers to vertex %d, the mesh has 3" % index, "overlap",
                               self.write("far.ply", content), "--box", support.UNIT_BOX)


class Degenerate(support.TestCase):
    def test_points_segments_and_duplicates(self):
        """They are the points and segments that they are, each as often as it is there."""
        point, segment = ((1, 1, 1),) * 3, ((-2, -2, -2), (2, 2, 2), (-2, -2, -2))
        line = ((-2, 0, 0), (0, 0, 0), (2, 0, 0))  # three vertices of a straight line
        far, good = ((3, 3, 3),) * 3, ((0, 0, 0), (1, 0, 0), (0, 1, 0))
        triangles = [point, segment, line, good, good, far, segment, point, tuple(reversed(good)), line] * 3
        boxes = [(1, 1, 1, 1, 1, 1), (0.5, 0.5, 0.5, 0.5, 0.5, 0.5), (0.5, -1, -1, 0.75, 1, 1), (-2, 0, 0, -1, 0, 0),
                 (-9, -9, -9, 9, 9, 9), (1, 1, -1, 2, 2, 0.5), (-1, -1, 1.5, 1, 1, 2)]
        for name, content in meshes.FORMATS.items():
            mesh = self.write(name, content(triangles))
            for box in boxes:
                with self.subTest(name=name, box=box):
                    answer = self.overlap(mesh, ",".join(map(str, box)))
                    self.assertEqual((answer["triangles"], answer["indices"]), (30, meshes.overlapping(triangles, box)))

    def test_nothing_but(self):
        for triangle in (((1, 1, 1),) * 3, ((0, 0, 0), (0, 0, 0), (2, 2, 2))):
            for name, content in meshes.FORMATS.items():
                answer = self.overlap(self.write(name, content([triangle] * 100)), "1,1,1,1,1,1")
                self.assertEqual((answer["triangles"], answer["overlapping"]), (100, 100), name)

    def test_no_finite_triangle(self):
        for number in (math.nan, math.inf, -math.inf):
            for name in ("little.ply", "ascii.ply", "binary.stl", "ascii.stl", "text.obj", "text.off", "raw.f32"):
                mesh = self.write(name, meshes.FORMATS[name]([((0, 0, 0), (1, 0, 0), (0, 1, number))] * 5))
                text = self.succeed_with_note("warning: .*%s: 5 of 5 triangles have NaN or infinite coordinates" % name,
                                              "overlap", mesh, "--box", support.UNIT_BOX, "--json", "--list")
                answer = json.loads(text)
                self.assertEqual((answer["triangles"], answer["not_finite"], answer["indices"]), (5, 5, []))

    def test_numbers_too_large(self):
        for name, content in (("large.obj", "v 0 1e999 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
                              ("large.off", "OFF\n3 1 0\n0 1e999 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
                              ("large.ply", meshes.ply_header("ascii", 3, 1) + b"0 1e999 0\n1 0 0\n0 1 0\n3 0 1 2\n")):
            self.succeed_with_note("1 of 1 triangles have NaN or infinite", "overlap", self.write(name, content), "--box", support.UNIT_BOX)


if __name__ == "__main__":
    support.main()
