"""tribox overlap -o and --rest: each face of the mesh in one of two files, with all that it had, told by a reader of its own."""

import json
import os
import resource

import faces
import triangles as meshes
import harness
from test_meshes import STRIPS

SEED = harness.SEED
BOX = (-0.5, 0.125, -0.75, 0.25, 0.75, 0.5)
LARGE = (-1.5, -1.375, -1.625, 1.75, 1.5, 1.625)  # which all but a few overlap

XYZ, CORNERS = meshes.XYZ, meshes.CORNERS
SCHEMAS = {
    "plain": [("vertex", None, XYZ), ("face", None, CORNERS)],
    "attributes": [
        ("vertex", None, [("red", "uchar"), *XYZ, ("nx", "double"), ("quality", "short"), ("weights", "uchar", "float")]),
        ("face", None, [("flags", "uint"), ("texcoord", "uchar", "float"), ("vertex_index", "uint", "uint"), ("red", "uchar"),
                        ("names", "ushort", "char")])],
    "doubles, faces first": [
        ("face", None, [("vertex_indices", "ushort", "short"), ("area", "double")]),
        ("camera", 2, [("view", "double"), ("matrix", "uchar", "double")]),
        ("vertex", None, [("z", "double"), ("x", "double"), ("y", "double")])],
    "other elements": [
        ("material", 3, [("ambient", "uchar"), ("name", "uchar", "uchar")]),
        ("vertex", None, XYZ),
        ("edge", 4, [("vertex1", "int"), ("vertex2", "int"), ("crease", "char")]),
        ("patch", 2, [("names", "uchar", "int"), ("vertex_indices", "uchar", "int")]),
        ("face", None, CORNERS),
        ("tristrips", 0, CORNERS),
        ("empty", 0, [("thing", "int")]),
        ("user", 1, [("number", "ushort")])],
    "corners of floats": [("vertex", None, XYZ), ("face", None, [("vertex_indices", "char", "float")])],
    "corners of doubles": [("vertex", None, XYZ), ("face", None, [("vertex_indices", "int", "double"), ("n", "uchar")])],
}


class Crop(harness.TestCase):
    def run_crop(self, mesh, *options, pattern="", names=("-o", "--rest"), box=BOX, ending=None):
        """What is written, by the options' names, and the JSON."""
        ending = ending or os.path.splitext(mesh)[1]
        files = {name: self.path(name.strip("-") + ending) for name in names}
        result = harness.run("overlap", mesh, "--box", ",".join(map(repr, box)), "--json", *options,
                             *(word for pair in files.items() for word in pair))
        self.assertEqual(result.code, 0, result.stderr)
        self.assertRegex(result.stderr, r"\A%s\Z" % pattern)
        written = {name: harness.read(path) for name, path in files.items()}
        for path in files.values():
            os.unlink(path)
        return written, json.loads(result.stdout)

    def assert_same(self, found, expected, what):
        self.assertEqual(found.other, expected.other, what)
        self.assertEqual(found.vertices, expected.vertices, what)
        for n, (own, due) in enumerate(zip(found.faces, expected.faces)):
            self.assertEqual(own, due, (what, n))
        self.assertEqual(len(found.faces), len(expected.faces), what)

    def check(self, scene, name, data, read, others=(), pattern=None, is_partial=True, keep=lambda whole: whole):
        """others: numbers of the faces of the file that are none of the scene. keep: what is to be found of the whole."""
        mesh, whole = self.write(name, data), keep(read(data))
        notes = pattern if pattern is not None else "(tribox.*NaN or infinite.*\n)?"
        for how, box, options in (("overlapping", BOX, ()), ("inside", LARGE, ("--inside",))):
            part = scene.in_part(box, how)
            rest = [n for n in range(len(whole.faces)) if n not in set(part)]
            self.assertTrue(part and len(rest) > len(others) + len(scene.faces) // 4)
            due = {"-o": whole.of(part), "--rest": whole.of(rest)}
            written, told = self.run_crop(mesh, "-t", "1", *options, pattern=notes, box=box)
            for option, file in written.items():
                if is_of_pairs(data):
                    self.assertTrue(is_of_pairs(file))
                self.assert_same(read(file), due[option], (name, how, option))
                found = told[{"-o": "part", "--rest": "rest"}[option]]
                self.assertEqual(found["faces"], len(due[option].faces) - (len(others) if option == "--rest" else 0))
                self.assertEqual(found.get("vertices", 0), len(due[option].vertices))
            again, _ = self.run_crop(mesh, "-t", "2", *options, pattern=notes, box=box)
            self.assertEqual(again, written)
        if not is_partial:
            return
        for alone in ("-o", "--rest"):
            self.assertEqual(self.run_crop(mesh, "--inside", names=(alone,), pattern=notes, box=LARGE)[0], {alone: written[alone]})


class Formats(Crop):
    def test_ply(self):
        for n, (name, schema) in enumerate(SCHEMAS.items()):
            scene = faces.Scene(SEED + n)
            for form in ("ascii", "binary_little_endian", "binary_big_endian"):
                for line_end in ("\n", "\r\n") if form == "ascii" else ("\n", "\r\n", "\r"):
                    with self.subTest(name, form=form, line_end=line_end):
                        self.check_ply(scene, faces.ply(scene, schema, form, line_end))

    def check_ply(self, scene, data):
        notes = "((tribox.*its (4 of 'edge'|2 of 'patch') refer to vertices, and are left out.*|tribox.*NaN or infinite.*)\n)*"
        self.check(scene, "mesh.ply", data, faces.read_ply, pattern=notes, keep=without_edges)

    def test_ply_as_one_line(self):
        scene = faces.Scene(SEED + 5)
        data = faces.ply(scene, SCHEMAS["attributes"], "ascii")
        head, _, body = data.partition(b"end_header\n")
        self.check(scene, "mesh.ply", head + b"end_header\n" + body.replace(b"\n", b"\t "), faces.read_ply)

    def test_large_records(self):
        """Of more bytes than any buffer; the header is as long."""
        scene = faces.Scene(SEED, triangles=20, polygons=4)
        schema = [("vertex", None, [*XYZ, *(("v%d" % k, "double") for k in range(300))]),
                  ("face", None, [*(("f%d" % k, "uint") for k in range(600)), *CORNERS])]
        for form in ("ascii", "binary_big_endian"):
            data = faces.ply(scene, schema, form).replace(b"obj_info", b"comment " + 99999 * b"x" + b"\nobj_info", 1)
            self.check(scene, "mesh.ply", data, faces.read_ply, is_partial=False)

    def test_obj(self):
        for n, options in enumerate(({}, {"is_negative": True}, {"line_end": "\r\n"}, {"is_mixed": True},
                                     {"is_mixed": True, "is_negative": True})):
            with self.subTest(**options):
                scene = faces.Scene(SEED + n, least=None)
                count = len(scene.faces)
                data = faces.obj(scene, **options)
                read = faces.read_obj
                if options.get("is_mixed"):  # the elements stand anywhere
                    self.assertEqual([face[1][0] for face in read(data).faces], count * ["f"] + ["l", "p"])
                self.check(scene, "mesh.obj", data, read, others=(count, count + 1),
                           pattern="((tribox.*1 lines of curves and surfaces are left out.*|tribox.*NaN or infinite.*)\n)*")
                for side in self.run_crop(self.write("mesh.obj", data), pattern="(.*\n)*")[0].values():
                    self.assertNotIn(b"o empty", side)
                    self.assertEqual(read(side).unused, 0)

    def test_obj_that_refers_to_nothing(self):
        """No reader minds textures and normals that are not there; what refers to nothing still does. A line of a backslash ends
        a file, as it does for the reader."""
        text = "v 0 0 0\nv 9 9 9\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 1\nf 1/2/7 3/0 4/-9\nf 2//1 2 2/5\n\\\nv 5 5 5\nf 1 1 1\n"
        written, _ = self.run_crop(self.write("mesh.obj", text))
        self.assertEqual(written["-o"].decode(), "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 1 1\nf 1/1/7 2/0 3/-9\n")
        self.assertEqual(written["--rest"].decode(), "v 9 9 9\nf 1//1 1 1/5\n")

    def test_off(self):
        for n, options in enumerate(({}, {"line_end": "\r\n"}, {"is_joined": True}, {"head": "OFF"})):
            with self.subTest(**options):
                scene = faces.Scene(SEED + n)
                self.check(scene, "mesh.off", faces.off(scene, **options), faces.read_off)

    def test_triangles(self):
        """Without vertices of their own; also more than the 4096 of a block, in masks of words of 64."""
        for count in (60, 9001):
            scene = faces.Scene(SEED, triangles=count, polygons=0, least=None)
            scene.faces = [face for face in scene.faces if len(face) == 3]
            self.check(scene, "mesh.stl", faces.stl_binary(scene), faces.read_stl_binary, is_partial=count == 60)
            for line_end in ("\n", "\r\n") if count == 60 else ():
                self.check(scene, "mesh.stl", faces.stl_text(scene, line_end), faces.read_stl_text)
            for form, size in (("f", 4), ("d", 8)) if count == 60 else ():
                self.check(scene, "mesh.f%d" % (8 * size), faces.raw(scene, form), faces.read_raw(size))

    def test_names_say_less_than_the_file(self):
        scene = faces.Scene(SEED)
        mesh = self.write("mesh.dat", faces.off(scene, head="OFF"))
        written, _ = self.run_crop(mesh, ending=".off", pattern="(.*\n)?")
        self.assertTrue(written["-o"].startswith(b"OFF\n# made by a test\n"))
        triangles = self.write("mesh.bin", meshes.stl_binary(meshes.lattice_triangles(50, SEED)))
        self.run_crop(triangles, "--format", "stl", ending=".STL", box=(-1, -1, -1, 0, 0, 0))

    def test_texts(self):
        """What becomes of comments, of counts, of lines that end early, and of groups without faces."""
        box = (-1, -1, -1, 1, 1, 1)
        for name, text, part, rest in (
                ("a.off", "OFF # 3 2 9\n5 2 7 # counts\n\n0 0 0 1 0 0\n9 9 9\n# a vertex\n0 1 0\n9 8 9\n1 0 0\n3 0 2 4 7 7 7\n"
                 "4 1 3 1 3",
                 "OFF # 3 2 9\n3 1 0 # counts\n\n0 0 0 1 0 0\n# a vertex\n0 1 0\n1 0 0\n3 0 1 2 7 7 7\n",
                 "OFF # 3 2 9\n2 1 0 # counts\n\n9 9 9\n# a vertex\n9 8 9\n4 0 1 0 1"),
                ("a.obj", "v 0 0 0\r\nv 9 9 9\r\n\r\ng one\r\nv 0 1 0\r\nusemtl red\r\ng two\r\nf 1 1 3\r\n# here\r\ng three\r\n"
                 "f 2 2 \\\r\n2",
                 "v 0 0 0\r\n\r\nv 0 1 0\r\nusemtl red\r\ng two\r\nf 1 1 2\r\n# here\r\n",
                 "v 9 9 9\r\n\r\n# here\r\nusemtl red\r\ng three\r\nf 1 1 \\\r\n1")):
            written, _ = self.run_crop(self.write(name, text), box=box)
            self.assertEqual(written["-o"].decode(), part)
            self.assertEqual(written["--rest"].decode(), rest)


def is_of_pairs(data):
    """Whether lines end in CR LF alone."""
    return 0 < data.count(b"\r\n") == data.count(b"\n")


def without_edges(content):
    """The header's lines and the records of what refers to vertices."""
    other, element = [], ""
    for entry in content.other:
        words = entry.split() if isinstance(entry, str) else entry
        element = words[1] if words[0] == "element" else element
        if (element if words[0] in ("element", "property") else words[0]) not in ("edge", "patch"):
            other.append(entry)
    return faces.Content(content.vertices, content.faces, other)


class Ways(Crop):
    def setUp(self):
        super().setUp()
        self.triangles = meshes.lattice_triangles(300, SEED)
        self.mesh = self.write("mesh.ply", meshes.ply_of(self.triangles))

    def test_oriented(self):
        box = (0.1, 0, 0, 0.5, 0.75, 1, 0.8, 0.6, 0, -0.6, 0.8, 0, 0, 0, 1)
        due = meshes.overlapping(self.triangles, box)
        part = self.path("part.ply")
        self.succeed("overlap", self.mesh, "--oriented", ",".join(map(repr, box)), "-o", part)
        self.assert_same(faces.read_ply(harness.read(part)), faces.read_ply(harness.read(self.mesh)).of(due), "oriented")

    def test_shift(self):
        """The box is about the mesh that was moved; what is written has not moved."""
        moved = ",".join(repr(b - s) for b, s in zip(BOX, 2 * (1.0, 2.0, -3.0)))
        straight, _ = self.run_crop(self.mesh)
        shifted, told = self.run_crop(self.mesh, "--shift", "1,2,-3", box=[float(b) for b in moved.split(",")])
        self.assertEqual(shifted, straight)
        self.assertEqual(told["shift"], [1, 2, -3])

    def test_list_and_counts_stay(self):
        for mesh in (self.mesh, self.write("mesh.f32", meshes.pack_floats(self.triangles))):
            part, box = self.path("x" + os.path.splitext(mesh)[1]), ",".join(map(repr, BOX))
            alone = self.succeed("overlap", mesh, "--box", box, "--list")
            self.assertEqual(self.succeed("overlap", mesh, "--box", box, "--list", "-o", part), alone)
            said = self.succeed("overlap", mesh, "--box", box, "-o", part)
            self.assertIn("\npart         %s (%d face" % (part, alone.count("\n")), said)

    def test_nothing_and_everything(self):
        for ending, data in ((".ply", meshes.ply_of(self.triangles)), (".PLY", meshes.FORMATS["ascii.ply"](self.triangles)),
                             (".obj", meshes.obj(self.triangles)), (".off", meshes.off(self.triangles)),
                             (".stl", meshes.stl_binary(self.triangles)), (".stl", meshes.stl_ascii(self.triangles)),
                             (".f32", meshes.pack_floats(self.triangles))):
            mesh = self.write("mesh" + ending, data)
            everything = (-9, -9, -9, 9, 9, 9)
            written, told = self.run_crop(mesh, box=everything, pattern="tribox.*rest%s: has no face, since all are in the box\n"
                                          % ending.replace(".", r"\."))
            self.assertEqual(told["part"]["faces"], 300)
            self.assertEqual(told["rest"]["faces"], 0)
            self.assertEqual(written["-o"].replace(b" 900 300 0", b""), data.replace(b" 900 300 0", b""))
            nothing, told = self.run_crop(mesh, box=(8, 8, 8, 9, 9, 9), pattern="tribox.*o%s: has no face, since none is in the "
                                          "box\n" % ending.replace(".", r"\."))
            self.assertEqual(nothing["--rest"], written["-o"])
            self.assertEqual(nothing["-o"], written["--rest"])

    def test_standard_output(self):
        written, _ = self.run_crop(self.mesh)
        box = ",".join(map(repr, BOX))
        for option, *others in (("-o",), ("--rest",), ("-o", "--rest", self.path("r.ply"))):
            done = harness.run("overlap", self.mesh, "--box", box, option, "-", *others)
            self.assertEqual((done.code, done.stderr, done.octets), (0, "", written[option]))


class Refusals(Crop):
    def setUp(self):
        super().setUp()
        self.mesh = self.write("mesh.ply", meshes.ply_of(meshes.lattice_triangles(300, SEED)))
        os.mkdir(self.path("folder"))

    def refuse(self, code, pattern, *options, mesh=None, **how):
        self.fail_with(code, pattern, "overlap", mesh or self.mesh, *options, **how)

    def test_names(self):
        box = ("--box", harness.UNIT_BOX)
        for name in ("x.obj", "x", "x.ply.gz", "x.stl", "ply"):
            self.refuse(2, "-o: '.*' does not end in .ply", *box, "-o", self.path(name))
            self.refuse(2, "--rest: '.*' does not end in .ply", *box, "--rest", self.path(name))
        self.refuse(1, "no.folder.*x.ply: cannot write there: No such file", *box, "-o", self.path("x.ply"), "--rest",
                    self.path("no/folder/x.ply"))

    def test_meshes(self):
        box = ("--box", harness.UNIT_BOX, "-o", self.path("x.ply"))
        self.refuse(1, "cannot open the mesh file: No such file", *box, mesh=self.path("none.ply"))
        self.refuse(1, "is a directory", *box, mesh=self.path("folder"))
        self.refuse(1, "is not a regular file, and -o and --rest read the mesh twice", *box, mesh="/dev/null")
        for name, data, pattern in (("empty.ply", b"", "the file is empty"), ("scene.3ds", b"MM\0\0", "convert it to one of these"),
                                    ("cut.ply", meshes.ply_of(meshes.lattice_triangles(9, 1))[:-1], "truncated"),
                                    ("strips.ply", STRIPS, "has strips of triangles, which -o and --rest do not cut")):
            mesh = self.write(name, data)
            self.refuse(1, pattern, *box, mesh=mesh)

    def test_full_disk(self):
        """Small files fail when they are closed, large ones while they are written; neither file is kept."""
        for count, limit in ((300, 2000), (9000, 100000)):
            for name, write in (("a.ply", meshes.ply_of), ("a.obj", meshes.obj), ("a.off", meshes.off),
                                ("t.ply", meshes.FORMATS["ascii.ply"]), ("a.stl", meshes.stl_binary), ("t.stl", meshes.stl_ascii),
                                ("a.f32", meshes.pack_floats)):
                mesh = self.write(name, write(meshes.lattice_triangles(count, SEED)))
                ending = os.path.splitext(name)[1]
                self.refuse(1, "(x|y)%s: cannot write all of it: File too large; nothing of it was kept" % ending, "--box",
                            harness.UNIT_BOX, "-o", self.path("x" + ending), "--rest", self.path("y" + ending), mesh=mesh,
                            limit=(resource.RLIMIT_FSIZE, limit))
        mesh = self.write("a.ply", meshes.ply_of(meshes.lattice_triangles(300, SEED)))
        self.refuse(1, "y.ply: cannot write all of it: File too large; nothing of it was kept", "--box", "8,8,8,9,9,9", "-o",
                    self.path("x.ply"), "--rest", self.path("y.ply"), limit=(resource.RLIMIT_FSIZE, 2000), mesh=mesh)


if __name__ == "__main__":
    harness.main()
