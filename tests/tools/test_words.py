"""Help, version, and every command line that is refused before anything is read: each message once, and no file is left."""

import json
import os
import random
import re

import harness
from harness import UNIT_BOX, UNIT_ORIENTED

OPTIONS = {
    "overlap": "--format --shift --box --boxes --oriented --inside --out --rest --list --json --accuracy --axes --order --kernel "
               "--threads --quiet --help",
    "voxelize": "--resolution --cell --origin --size --format --shift --out --out-format --deflate --vdb-grid --preview --up "
                "--picture-size --json --quiet --memory --threads --shard --count --thin --fill --labels --inside-only --colours "
                "--ids --accuracy --axes --kernel --help",
    "merge": "--out --out-format --preview --up --picture-size --threads --json --quiet --help",
    "partition": "--format --shift --resolution --cell --origin --size --out --memory --threads --json --quiet --help",
    "info": "--out --json --quiet --help",
    "demo": "--quick --quiet --picture --help",
    "sweep": "--octree --grid --box --quick --quiet --verbose --json --chart --help",
}
A, B, V, CELL = ("a.obj",), ("a.obj", "--box", UNIT_BOX), ("a.obj", "-r", "8", "-o", "x.npz"), ("a.obj", "--cell", "1")
FILL = (*CELL, "--fill", "outside")
TILES = "(is a partition|is a folder, so a partition)"

# Of each command, what is wrong and the words that are refused.
WRONG = {
    "overlap": [
        ("option '--o' is ambiguous; write more of it", *A, "--o", "123"), ("option '--bo=1' is ambiguous", *A, "--bo=1"),
        ("option --box is given twice", *A, "--box", "0,0,0,1,1,1", "--box=0,0,0,1,1,1"), ("option -b needs a value", *A, "-jb"),
        *(("option --box needs a value, and '%s' is an option" % word, *A, "--box", word)
          for word in ("--json", "--js", "--boxes=3")),
        *(("option --%s needs a value" % option, *A, "--" + option)
          for option in ("box", "boxes", "oriented", "format", "shift", "accuracy", "axes", "order", "kernel")),
        *(("option %s takes no value" % option, *A, option + "=yes") for option in ("--list", "--json")),
        ("no mesh file given", "--box", UNIT_BOX), ("one mesh at a time: 'b.obj' is one file too many", *B, "b.obj"),
        ("no box given", *A), ("--box, --boxes and --oriented exclude each other", *B, "--boxes", "-"),
        (".* exclude each other", *B, "--oriented", UNIT_ORIENTED),
        (".* exclude each other", *A, "--boxes", "-", "--oriented", UNIT_ORIENTED),
        ("--list with --boxes needs --json", *A, "--boxes", "-", "--list"),
        ("standard input needs its format: --format ply, off, stl, obj, f32 or f64;", "-", "--box", UNIT_BOX),
        ("--boxes needs the mesh as a file", "-", "--format", "stl", "--boxes", "b.txt"),
        (".*'a.obj' is one file too many", "-", *B, "--format", "stl"),
        ("--inside counts triangles and --list lists them", *B, "--inside", "--list", "--json"),
        ("--inside goes with --box or --boxes, not with --oriented", *A, "--oriented", UNIT_ORIENTED, "--inside"),
        ("--inside goes with --box or --boxes", *A, "--oriented", UNIT_ORIENTED, "--inside", "-o", "x.obj"),
        *(("--oriented is exact with all axes or with --axes box", *A, "--axes", axes, "--oriented", UNIT_ORIENTED)
          for axes in ("plane", "edges", "box,plane", "box,edges", "edges,plane")),
        *(("%s: '.*' is none of .*" % option, *B, option, value) for option, values in (
            ("--accuracy", ("", "Exact", "exactly", "e")), ("--axes", ("", "box,", ",box", "box,planes", "box plane", "all")),
            ("--order", ("", "0", "12", "1234", "322", "3 1 2")), ("--kernel", ("", "AVX2", "avx", "best")),
            ("--format", ("", "STL", "gltf", "f16", ".stl"))) for value in values),
        ("-o and --rest write the faces about one box", *A, "--boxes", "b", "-o", "x.obj"),
        ("-o and --rest need the mesh as a file", "-", "--box", UNIT_BOX, "--format", "stl", "-o", "x.stl"),
        ("-o and --rest cannot both go to standard output", *B, "-o", "-", "--rest", "-"),
        ("--json and -o - exclude each other", *B, "--json", "-o", "-"),
        ("--list and --rest - exclude each other", *B, "--list", "--rest", "-"),
    ],
    "voxelize": [
        ("no mesh file given", "-r", "8", "-o", "x.npy"), ("no grid given; give --resolution or --cell", *A, "-o", "x.npy"),
        ("no output given; give -o FILE, or --count", *A, "-r", "8"),
        ("one mesh at a time.*'b.ply' is one file too many", "-r", "8", *A, "-o", "x.npz", "b.ply"),
        ("one mesh at a time: '0.1' is one file too many; the numbers of an option have commas, or blanks in quotes, between them",
         *A, "-o", "x.npz", "-c", "0.1", "0.1", "0.1"),
        *(("--up and --picture-size need --preview", *V, *look) for look in (("--up", "y"), ("--picture-size", "64x48"))),
        *(("option %s needs a value" % option, *A, option)
          for option in ("--resolution", "--cell", "--origin", "--size", "-o", "--preview", "--threads", "--shard", "--up")),
        ("--resolution and --cell exclude each other", *V, "--cell", "1"),
        ("a shard is written as .npz, not as npy", *CELL, "-o", "x.npy", "--shard", "1/2"),
        ("a shard is written as .npz, not as raw", *CELL, "-o", "-", "--out-format", "raw", "--shard", "1/2"),
        ("--preview needs all cells: give it to 'tribox merge'", *V, "--shard", "1/2", "--preview", "x.png"),
        *(("--resolution: '%s' is not a whole number from 1 to 262144;" % value, *A, "-r", value)
          for value in ("262145", "2000000000", "0", "-1", "1.5", "", "x", "1e3", "9999999999", "8 ")),
        *(("--threads: '%s' is not a whole number from 1 to 256" % value, *A, "-t", value) for value in ("0", "257", "two")),
        *(("--size: '%s' is not NX,NY,NZ" % value, *A, "--size", value)
          for value in ("1", "1,2", "1,2,3,4", "0,1,1", "1,2,3,", "1,2,-3", "1 2 3")),
        ("--cell: 0 is not greater than 0", *A, "--cell", "0"), ("--cell: -2 is not greater than 0", *A, "--cell", "1,-2,1"),
        *(("--shard.*" + why, *A, "--shard", value) for value, why in (
            ("3", "'3' is not I/N, such as 3/8"), ("0/3", "its I: '0' is not a whole number from 1 to 3"),
            ("4/3", "its I: '4' is not a whole number from 1 to 3"), ("1/0", "its N: '0' is not a whole number"),
            ("/2", "its I: ''"), ("1/", "its N: ''"), ("1/2/3", "its N: '2/3'"))),
        ("--up: 'w' is none of x, y, z, -x, -y, -z", *A, "--up", "w"),
        *(("--picture-size.*: '.*' is no", *A, "--picture-size", size)
          for size in ("640", "x", "0x8", "8x0", "8x4097", "8x6x4", "8 x 6", "123456789x8")),
        *(("-o: '%s' does not end in .npz, .vdb, .npy, .vti, .nrrd, .raw, .binvox, .vox, .ply, .obj or .glb" % name,
           *CELL, "-o", name)
          for name in ("x", "x.txt", ".npy", "x.NPY", "")),
        *(("--preview: '%s' does not end in .png" % name, *V, "--preview", name) for name in ("p.jpg", "png", ".png", "", "-")),
        ("standard input needs its format: --format ply, off, stl, ", "-", "-r", "8", "-o", "x.npy"),
        ("standard output needs its format, --out-format WORD: one of npz, ", *CELL, "-o", "-"),
        ("--out-format: 'png' is none of npz, vdb", *CELL, "-o", "-", "--out-format", "png"),
        ("--json and -o - exclude", *CELL, "-o", "-", "--out-format", "raw", "--json"),
        ("--deflate is for .npz alone", *CELL, "-o", "x.npy", "--deflate"),
        ("--vdb-grid is for .vdb alone", *V, "--vdb-grid", "mask"),
        ("--vdb-grid: 'float' is none of bool, mask;", *CELL, "-o", "x.vdb", "--vdb-grid", "float"),
        *(("--count only prints: leave out " + option, *CELL, "--count", *words) for option, *words in (
            ("--out", "-o", "x.npz"), ("--preview", "-p", "x.png"), ("--quiet", "-q"),
            ("--labels", "--fill", "outside", "--labels"),
            ("--ids", "--ids"), ("--colours", "--colours"))),
        ("--fill: 'inside' is none of outside, parity, middles;", *CELL, "--fill", "inside"),
        *((r"--fill: '%s' is none of .* \(did you mean '%s'\?\);" % words, *CELL, "--fill", words[0])
          for words in (("pa", "parity"), ("partiy", "parity"), ("Outside", "outside"), ("midle", "middles"))),
        *((r"unknown option '%s' \(did you mean '--%s'\?\);" % words, *CELL, words[0]) for words in (
            ("--colr", "colours"), ("--tihn=1", "thin"), ("--resolutoin", "resolution"), ("--quit", "quiet"), ("--hlep", "help"))),
        ("unknown option '--brightness';", *CELL, "--brightness"),
        ("option --colours is given twice", *CELL, "--colors", "--colours"), ("option --colours takes no v", *CELL, "--color=1"),
        *(("%s needs all cells at once: leave out --shard" % option, *V, "--shard", "1/2", option, *word)
          for option, *word in (("--fill", "outside"), ("--thin",), ("--colours",))),
        *(("--thin is exact and of all axes", *V, "--thin", *way) for way in (("--accuracy", "fast"), ("--axes", "box"))),
        *(("--fill middles has no cells of the surface: leave out " + option, *V, "--fill", "middles", option)
          for option in ("--thin", "--labels", "--inside-only")),
        *(("--memory: '%s' is no size" % size, *V, "--memory", size) for size in ("", "0", "1GBB", "1B")),
        *(("--memory sorts a larger mesh by tiles", *V, "-m", "1G", *words)
          for words in (("--thin",), ("--accuracy", "fast"), ("--axes", "box"), ("--fill", "parity"), ("--fill", "middles"))),
        (TILES + ", which is sorted: leave out --memory", ".", "-m", "1G", "-o", "x.npz"),
        ("--labels is about a filled mesh: give --fill outside or --fill parity", *V, "--labels"),
        ("--inside-only is about a filled mesh", *V, "--inside-only"),
        ("--labels and --inside-only exclude each other", *FILL, "--labels", "--inside-only", "-o", "x.npz"),
        *(("%s and --vdb-grid exclude each other" % word[-1], *CELL, *word, "--vdb-grid", "mask", "-o", "x.vdb")
          for word in (("--fill", "outside", "--labels"), ("--ids",))),
        *(("--labels: %s holds no labels; write npz, vdb, npy, vti, nrrd, raw or vox, or give --inside-only" % word,
           *FILL, "--labels", "--out-format", word, "-o", "x") for word in ("binvox", "ply", "obj", "glb", "cells")),
        *(("--ids: .%s holds none; write .npz" % word, *CELL, "--ids", "--out-format", word, "-o", "x")
          for word in ("cells", "binvox", "vox", "ply", "obj", "glb")),
        *((".*" + why, *V, "--ids", *words) for why, *words in (
            ("leave out --fill", "--fill", "outside"), ("leave out --thin", "--thin"), ("run it for each", "--colours"))),
        (".*--fill", *V, "--colours", "--fill", "outside"),
        *((r"--colours: \.%s holds none; write .npz, .vdb, .vox, .ply, .obj or .glb" % word, *CELL, "--colours", "-o", "x." + word)
          for word in ("npy", "vti", "nrrd", "binvox", "raw")),
        # The folder of a test is a partition before it is looked into.
        *(("%s, which has its grid: leave out %s" % (TILES, option), ".", "-o", "x.npz", option, value)
          for option, value in (("--resolution", "9"), ("--shift", "auto"))),
        (TILES + ".*which is for all axes: leave out --axes", ".", "--axes", "box", "-o", "x.npz"),
        (TILES + ".*lacks what lies before its grid: --fill parity needs the mesh itself", ".", "--fill", "parity", "-o", "x.npz"),
        (".*--fill middles needs the mesh itself", ".", "--fill", "middles", "-o", "x.npz"),
        (TILES + ".*which is for tiles: --thin needs the mesh itself", ".", "--thin", "-o", "x.npz"),
        (TILES + ".*which lacks the colours", ".", "--colours", "-o", "x.npz"),
    ],
    "merge": [
        ("no parts given", "-o", "x.npy"), ("no output given", "a.npz"),
        ("-o: 'x.part' does not end in .npz", "a.npz", "-o", "x.part"),
        ("--up and --picture-size need --preview", "a.npz", "-o", "x.npy", "--up", "x")],
    "partition": [
        ("no mesh file given", "-r", "9", "-o", "x"), ("no grid given", *A, "-o", "x"),
        ("no output given; give -o FOLDER", *A, "-r", "9"),
        ("-o: '-' is not the name of a folder", *A, "-r", "9", "-o", "-"),
        *(("--memory: '%s' is no size" % size, *A, "-r", "9", "-o", "x", "--memory", size)
          for size in ("", "0", "-1", "1Gb", "1.5G", "G", "99999999999T", "1KM", "1 G")),
        (".*which has its grid: leave out --cell", ".", ".", "-o", "x", "--cell", "1")],
    "info": [("option --json is given twice", "--json", "--json"), ("option -j is given twice", "--js", "-j"),
             ("option -j is given twice", "-jj"),
             ("option --help takes no value", "--help=yes"), ("one mesh at a time: 'b.obj' is one file too many", *A, "b.obj"),
             ("--out: 'x.ply' is no name that ends in .npz", *A, "-o", "x.ply"), ("--out: '-' is no name", *A, "-o", "-"),
             ("--out is of a mesh: give one", "-o", "x.npz")],
    "demo": [("unexpected 'a.obj'", *A), ("option --quick takes no value", "--quick=yes"),
             ("--picture: 'knot.jpg' does not end in .png", "--picture", "knot.jpg")],
    "sweep": [
        ("no mesh file given",), ("one mesh at a time: 'b.obj' is one file too many", *A, "b.obj"),
        ("unknown option '--kernel'", *A, "--kernel", "x"),
        *(("--box, --octree and --grid exclude each other", *A, "--octree", "4", *other)
          for other in (("--grid", "4"), ("--box", UNIT_BOX))),
        *(("%s: '%s' is not a whole number from 1 to %d" % (option, value, most), *A, option, value)
          for option, most, values in (("--octree", 10, ("0", "11", "-1", "", "3x", " 3", "9" * 20)),
                                       ("--grid", 4096, ("0", "4097", "1.5"))) for value in values),
        ("--box: the empty box overlaps nothing in any order", *A, "--box", "0,2,0,1,1,1"),
        *(("--chart: '.*' would be an SVG all the same; name it .svg", *A, "--chart", name)
          for name in ("c.png", "c.svg.pdf", "."))],
}
NUMBERS = {  # options of numbers: what is wrong with which
    "--box": [
        ("number 1 of 6 is missing", ""), ("3 numbers where 6 are needed; give LX,LY,LZ,HX,HY,HZ", "1,2,3"),
        ("1 number where 6 are needed; give LX,LY,LZ,HX,HY,HZ, with commas, or blanks in quotes", "1"),
        ("more than 6 numbers", "1,2,3,4,5,6,7"), ("number 3 of 6 is missing", "1,2,,4,5,6"),
        ("more than 6 numbers", "1,2,3,4,5,6,"),
        ("number 1 of 6 is missing", ",1,2,3,4,5,6"), (r"'x' \(number 3 of 6\) is not a number; write it like", "1,2,x,4,5,6"),
        (r"'3m' \(number 3 of 6\) is not a number", "1,2,3m,4,5,6"), (r"'1e' \(number 3 of 6\) is not a number", "1,2,1e,4,5,6"),
        (r"'1;2;3;4;5;6' \(number 1 of 6\) is not a number", "1;2;3;4;5;6"),
        (r"'nan' \(number 3 of 6\) is not finite", "1,2,nan,4,5,6"),
        (r"'-inf' \(number 1 of 6\) is not finite", "-inf,2,3,4,5,6"),
        (r"'1e309' \(number 6 of 6\) is too large for double, which ends at 1\.79769313e\+308", "1,2,3,4,5,1e309"),
        (r"'-1\.8e308' \(number 5 of 6\) is too large for double", "1,2,3,4,-1.8e308,5"),
        (r"'1e-324' \(number 2 of 6\) is too small for double; give 0 or at least 4\.9e-324", "1,1e-324,3,4,5,6"),
        ("'--json'", "--json")],
    "--oriented": [
        ("6 numbers where 15 are needed; give CX,CY,CZ,HX,HY,HZ and three axes of three numbers", UNIT_BOX),
        ("more than 15 numbers", UNIT_ORIENTED + ",1"), (r"'nan' \(number 15 of 15\) is not finite", UNIT_ORIENTED[:-1] + "nan")],
    "--shift": [("2 numbers where 3 are needed; give X,Y,Z or auto", "1,2"), ("'automatic' .* is not a number", "automatic")],
}


class Help(harness.TestCase):
    def check(self, text):
        self.assertRegex(text, r"(?m)^Usage: tribox ")
        self.assertLessEqual(max(map(len, text.splitlines())), 100)
        if "tribox sweep" not in text[:14]:
            self.assertIn("Exit codes:", text)
            self.assertIn("Example", text)
            self.assertLessEqual(len(text.splitlines()), 54)

    def test_help(self):
        text = self.succeed("--help")
        self.check(text)
        for same in (("-h",), ("help",)):
            self.assertEqual(self.succeed(*same), text)
        self.assertEqual(self.succeed("overlap", "--list", "--help"), self.succeed("overlap", "--help"))
        for command, options in OPTIONS.items():
            self.assertRegex(text, r"(?m)^  %s " % command)
            of_command = self.succeed(command, "--help")
            self.check(of_command)
            for option in options.split():
                self.assertRegex(of_command, r"(?m)^  (-\w, |    )?%s( |$)" % option)
            for same in ((command, "-h"), (command, "--he"), ("help", command)):
                self.assertEqual(self.succeed(*same), of_command)

    def test_version_and_info(self):
        info = self.ask("info")
        self.assertEqual(sorted(info), ["default_kernel", "formats", "kernels", "positions", "processor", "version"])
        self.assertRegex(info["version"], r"\A\d+\.\d+\.\d+\Z")
        self.assertEqual(self.succeed("--version"), "tribox %s\n" % info["version"])
        self.assertEqual((info["kernels"][0], info["kernels"][-1], info["positions"]),
                         (info["default_kernel"], "scalar", ["float32", "float64"]))
        self.assertTrue(info["processor"])
        self.assertEqual(self.succeed("info"), "version         %s\nprocessor       %s\nkernels         %s\ndefault kernel  %s\n"
                         "positions       float32, float64\nformats         %s\n" % (
                             info["version"], info["processor"], " ".join(info["kernels"]), info["default_kernel"],
                             " ".join(each["word"] for each in info["formats"])))


class Wrong(harness.TestCase):
    def test_program(self):
        for pattern, *words in (("no command given; see 'tribox --help'",), ("'overlay' is not a command", "overlay"),
                                ("unknown option '--quick';", "--quick", "demo"),
                                *((r"unknown option '%s' \(did you mean '--%s'\?\);" % words, words[0]) for words in (
                                    ("--verison", "version"), ("-v", "version"), ("-version", "version"), ("--hlep", "help"))),
                                (r"'voxelise' is not a command \(did you mean 'voxelize'\?\);", "voxelise"),
                                (r"'part' is not a command \(did you mean 'partition'\?\);", "part"),
                                *(("'%s' is written --version; " % word, word) for word in ("-V", "version")),
                                ("'overlay' is not a command", "help", "overlay")):
            self.fail_with(2, "^tribox: " + pattern, *words)

    def test_commands(self):
        for command, rows in WRONG.items():
            unknown = [("unknown option '%s'" % option, option)
                       for option in ("--tint", "-x", "--tint=red", "--jsonl", "--json2=1")]
            self.refuse(2, command, rows + unknown * (command != "sweep"), cwd=self.folder)

    def test_any_words(self):
        """Whatever they are, up to a mesh that is not there: an exit code, a line unless all went well, and no file."""
        pick = random.Random(harness.SEED)
        values = ("a.obj", "a.npz", "-", ".", UNIT_BOX, "1", "-1", "0" * 40 + "1/2", "box,,edges", "", "1e99", "--", "f32", "x.vox")
        for _ in range(150):
            command = pick.choice(("overlap", "voxelize", "merge", "partition", "info"))
            options = OPTIONS[command].split()
            words = [pick.choice((*values, *(pick.choice(options)[:pick.randint(3, 13)] + end for end in ("", "=1", "", ""))))
                     for _ in range(pick.randrange(9))]
            result = harness.run(command, *words, cwd=self.folder)
            self.assertIn(result.code, (0, 1, 2), words)
            self.assertRegex(result.stderr, r"\A(tribox[^\n]*: [^\n]+\n){%d,}\Z" % (result.code > 0), words)
            self.assertEqual(self.there(), [], words)

    def test_numbers(self):
        for option, rows in NUMBERS.items():
            for pattern, value in rows:
                self.fail_with(2, "^tribox overlap: %s: %s" % (option, pattern), "overlap", "a.obj", option + "=" + value)
        self.fail_with(2, "^tribox sweep: --box: number 1 of 6 is missing", "sweep", "a.obj", "--box", "")
        self.fail_with(2, "^tribox voxelize: --cell: 2 numbers where 3 are needed; give one number, or three: SX,SY,SZ, with "
                          "commas, or blanks in quotes$", "voxelize", "a.obj", "--cell", "1,2")
        self.fail_with(2, r"^tribox voxelize: --origin: 'a' \(number 2 of 3\) is not a number", "voxelize", "--origin", "1,a,3")

    def test_kernel_of_another_processor(self):
        here = harness.kernels()
        with open(os.path.join(os.path.dirname(__file__), "..", "..", "src", "kernels.txt"), encoding="utf-8") as file:
            kernels = re.findall(r"(?m)^(\w+) \w+$", file.read())
        for kernel in set(kernels) - {*here, "wasm128"}:
            message = r"--kernel: '%s' is none of %s \(what runs here\)" % (kernel, ", ".join(here))
            self.refuse(2, "overlap", [(message, *B, "--kernel", kernel)])


class Right(harness.TestCase):
    def setUp(self):
        super().setUp()
        self.mesh = self.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")

    def test_forms_of_boxes(self):
        for box in ("0,0,0,1,1,1", "0 0 0 1 1 1", " 0, 0 ,0\t1,1,1 ", "0,0,0,1e0,+1,0x1p0", "-0,0,0,1.,1.0,100e-2",
                    "-3.4028235e38,-1,-1,3.4028235e38,1,1", "1.4e-45,1.4e-45,0,1,1,1"):
            self.assertEqual(self.overlap(self.mesh, box)["overlapping"], 1, box)

    def test_forms_of_options(self):
        expected = self.succeed("overlap", self.mesh, "--list", "--box", UNIT_BOX)
        self.assertEqual(expected, "0\n")
        for options in (("-l", "-b", UNIT_BOX), ("-lb", UNIT_BOX), ("-b" + UNIT_BOX, "--li"), ("--lis", "--box=" + UNIT_BOX)):
            self.assertEqual(self.succeed("overlap", *options, self.mesh), expected, options)
        self.assertEqual(self.succeed("overlap", "-lb", UNIT_BOX, "--", self.mesh), expected)
        self.write("--json", harness.read(self.mesh) + b"f 1 1 1\n")
        self.assertEqual(self.succeed("overlap", "-lb", UNIT_BOX, "--", "--json", cwd=self.folder), "0\n1\n")

    def test_quiet(self):
        """Every command takes it; what was asked for is printed all the same, and of a file that is written nothing."""
        self.assertEqual(self.succeed("overlap", self.mesh, "-lqb", UNIT_BOX), "0\n")
        self.assertEqual(self.overlap(self.mesh, UNIT_BOX, "-q")["indices"], [0])
        self.assertIn("triangles overlap", self.succeed("overlap", self.mesh, "--quiet", "--boxes", "-", stdin=b"0 0 0 1 1 1"))
        self.assertEqual(self.succeed("overlap", self.mesh, "-qb", UNIT_BOX, "-o", self.path("x.obj")), "")
        self.assertEqual(self.succeed("info", "-q"), self.succeed("info"))
        self.assertIn("triangles    1\n", self.succeed("info", self.mesh, "-q"))
        self.assertEqual(self.succeed("info", self.mesh, "-q", "-o", self.path("x.npz")), "")
        self.assertTrue(self.succeed("sweep", self.mesh, "--quick", "--quiet", "--box", UNIT_BOX))
        self.assertTrue(self.succeed("demo", "--quick", "-q"))
        out = self.path("cells.npz")
        for words in (("overlap", self.mesh, "-b", UNIT_BOX, "-o", self.path("y.obj")),
                      ("voxelize", self.mesh, "-r", "8", "-o", out), ("merge", out, "-o", self.path("x.npy")),
                      ("info", self.mesh, "-o", self.path("y.npz")),
                      ("partition", self.mesh, "-r", "8", "-o", self.path("folder"))):
            self.assertTrue(json.loads(self.succeed(*words, "-qj")), words)

    def test_sizes_of_memory(self):
        for n, size in enumerate(("1G", "1g", "1GB", "1gB", "9999k", "99999999")):
            self.succeed("partition", self.mesh, "-r", "8", "-qm", size, "-o", self.path(str(n)))

    def test_empty_boxes(self):
        text = self.succeed("overlap", self.mesh, "--box", "0,2,0,1,1,1", "--json",
                            note="note: --box: the lower bound 2 exceeds the upper bound 1 on the y axis: an empty box")
        self.assertEqual(json.loads(text)["overlapping"], 0)
        for k in range(3):
            half = ["1"] * k + ["-0.5"] + ["1"] * (2 - k)
            found = self.ask("overlap", self.mesh, "--oriented", "0,0,0,%s,1,0,0,0,1,0,0,0,1" % ",".join(half),
                             note="note: --oriented: half length %d is -0.5: a box of negative size is empty" % (k + 1))
            self.assertEqual(found["overlapping"], 0)


if __name__ == "__main__":
    harness.main()
