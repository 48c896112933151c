"""Help, version, and every way of writing a wrong command line."""

import json

import meshes
import support

COMMANDS = ("overlap", "voxelize", "partition", "merge", "info", "demo")
OPTIONS = {
    "overlap": ["--format", "--shift", "--box", "--boxes", "--oriented", "--inside", "--out", "--rest", "--list", "--json", "--accuracy",
                "--axes", "--order",
                "--kernel", "--help"],
    "voxelize": ["--resolution", "--cell", "--origin", "--size", "--format", "--shift", "--out", "--out-format", "--preview", "--up",
                 "--picture-size", "--json", "--quiet", "--threads",
                 "--shard", "--count", "--thin", "--fill", "--labels", "--inside-only", "--colours", "--ids", "--accuracy", "--axes", "--kernel", "--help"],
    "merge": ["--out", "--out-format", "--preview", "--up", "--picture-size", "--threads", "--json", "--quiet",
              "--help"],
    "partition": ["--format", "--shift", "--resolution", "--cell", "--origin", "--size", "--out", "--memory", "--threads",
                  "--json", "--quiet", "--help"],
    "info": ["--json", "--help"],
    "demo": ["--quick", "--picture", "--help"],
}


class Help(support.TestCase):
    def check(self, text):
        self.assertRegex(text, r"(?m)^Usage: tribox ")
        self.assertIn("Exit codes:", text)
        self.assertIn("Example", text)
        self.assertLessEqual(max(map(len, text.splitlines())), 100)
        self.assertLessEqual(len(text.splitlines()), 54)

    def test_program(self):
        text = self.succeed("--help")
        self.check(text)
        for command in COMMANDS:
            self.assertRegex(text, r"(?m)^  %s " % command)
        for same in (("-h",), ("help",)):
            self.assertEqual(self.succeed(*same), text)

    def test_commands(self):
        for command in COMMANDS:
            text = self.succeed(command, "--help")
            self.check(text)
            for option in OPTIONS[command]:
                self.assertRegex(text, r"(?m)^  (-\w, |    )?%s " % option)
            for same in ((command, "-h"), (command, "--he"), ("help", command)):
                self.assertEqual(self.succeed(*same), text)

    def test_wins_over_what_is_missing(self):
        self.assertEqual(self.succeed("overlap", "--list", "--help"), self.succeed("overlap", "--help"))

    def test_version(self):
        version = json.loads(self.succeed("info", "--json"))["version"]
        self.assertRegex(version, r"\A\d+\.\d+\.\d+\Z")
        self.assertEqual(self.succeed("--version"), "tribox %s\n" % version)


class WrongCommandLine(support.TestCase):
    def test_program(self):
        self.fail_with(2, r"^tribox: no command given; see 'tribox --help'")
        self.fail_with(2, r"^tribox: 'overlay' is not a command;", "overlay")
        self.fail_with(2, r"^tribox: unknown option '--quick';", "--quick", "demo")
        self.fail_with(2, r"^tribox: 'overlay' is not a command;", "help", "overlay")

    def test_unknown_options(self):
        for command in COMMANDS:
            for option in ("--tint", "-x", "--tint=red", "--jsonl", "--json2=1"):
                self.fail_with(2, r"^tribox %s: unknown option '%s'; see 'tribox %s --help'" % (command, option, command),
                               command, option)

    def test_ambiguous_options(self):
        self.fail_with(2, "option '--o' is ambiguous; write more of it", "overlap", "m.obj", "--o", "123")
        self.fail_with(2, "option '--bo=1' is ambiguous", "overlap", "m.obj", "--bo=1")

    def test_given_twice(self):
        self.fail_with(2, "option --json is given twice", "info", "--json", "--json")
        self.fail_with(2, "option -j is given twice", "info", "--js", "-j")
        self.fail_with(2, "option -j is given twice", "info", "-jj")
        self.fail_with(2, "option --box is given twice", "overlap", "m.obj", "--box", "0,0,0,1,1,1", "--box=0,0,0,1,1,1")

    def test_values(self):
        for option in ("--box", "--boxes", "--oriented", "--format", "--shift", "--accuracy", "--axes", "--order", "--kernel"):
            self.fail_with(2, "option %s needs a value" % option, "overlap", "m.obj", option)
        self.fail_with(2, "option -b needs a value", "overlap", "m.obj", "-jb")
        for word in ("--json", "--js", "--boxes=3"):
            self.fail_with(2, "option --box needs a value, and '%s' is an option" % word, "overlap", "m.obj", "--box", word)
        self.fail_with(2, "--json", "overlap", "m.obj", "--box=--json")
        for command, option in (("overlap", "--list"), ("overlap", "--json"), ("info", "--json"), ("demo", "--quick"),
                                ("info", "--help")):
            self.fail_with(2, "option %s takes no value" % option, command, option + "=yes")

    def test_operands(self):
        self.fail_with(2, "no mesh file given", "overlap", "--box", support.UNIT_BOX)
        self.fail_with(2, "'b.obj' is one file too many", "overlap", "a.obj", "b.obj", "--box", support.UNIT_BOX)
        self.fail_with(2, "unexpected 'a.obj'", "info", "a.obj")
        self.fail_with(2, "unexpected 'a.obj'", "demo", "a.obj")

    def test_box_or_boxes(self):
        self.fail_with(2, "no box given", "overlap", "a.obj")
        self.fail_with(2, "exclude each other", "overlap", "a.obj", "--box", support.UNIT_BOX, "--boxes", "-")
        self.fail_with(2, "exclude each other", "overlap", "a.obj", "--box", support.UNIT_BOX, "--oriented", support.UNIT_ORIENTED)
        self.fail_with(2, "exclude each other", "overlap", "a.obj", "--boxes", "-", "--oriented", support.UNIT_ORIENTED)
        self.fail_with(2, "--list with --boxes needs --json", "overlap", "a.obj", "--boxes", "-", "--list")

    def test_standard_input(self):
        self.fail_with(2, "standard input needs its format: --format stl, f32 or f64;",
                       "overlap", "-", "--box", support.UNIT_BOX)
        self.fail_with(2, "--boxes needs the mesh as a file", "overlap", "-", "--format", "stl", "--boxes", "b.txt")
        self.fail_with(2, "'a.obj' is one file too many", "overlap", "-", "a.obj", "--format", "stl", "--box", support.UNIT_BOX)

    def test_inside(self):
        self.fail_with(2, "--inside counts triangles and --list lists them", "overlap", "a.obj", "--box", support.UNIT_BOX, "--inside",
                       "--list", "--json")
        self.fail_with(2, "--inside goes with --box or --boxes, not with --oriented", "overlap", "a.obj", "--oriented", support.UNIT_ORIENTED,
                       "--inside")

    def test_axes_of_oriented_boxes(self):
        for axes in ("plane", "edges", "box,plane", "box,edges", "edges,plane"):
            self.fail_with(2, "--oriented is exact with all axes or with --axes box", "overlap", "a.obj", "--axes", axes, "--oriented",
                           support.UNIT_ORIENTED)

    def test_oriented_numbers(self):
        def wrong(box, pattern):
            self.fail_with(2, r"^tribox overlap: --oriented: " + pattern, "overlap", "a.obj", "--oriented", box)
        wrong(support.UNIT_BOX, "6 numbers where 15 are needed; give CX,CY,CZ,HX,HY,HZ and three axes of three numbers")
        wrong(support.UNIT_ORIENTED + ",1", "more than 15 numbers")
        wrong("1e309" + support.UNIT_ORIENTED[1:], r"'1e309' \(number 1 of 15\) is too large for double, which ends at 1\.79769313e\+308")
        wrong("1e-325" + support.UNIT_ORIENTED[1:], r"'1e-325' \(number 1 of 15\) is too small for double; give 0 or at least 4\.9e-324")
        wrong(support.UNIT_ORIENTED[:-1] + "nan", r"'nan' \(number 15 of 15\) is not finite")

    def test_words(self):
        def wrong(option, *values):
            for value in values:
                self.fail_with(2, r"^tribox overlap: %s: '.*' (is none of|is neither|does not run here;) .*; see 'tribox overlap --help'" % option,
                               "overlap", "a.obj", "--box", support.UNIT_BOX, option, value)
        wrong("--accuracy", "", "Exact", "exactly", "e")
        wrong("--axes", "", "box,", ",box", "box,planes", "box plane", "all")
        wrong("--order", "", "0", "12", "1234", "322", "3 1 2")
        wrong("--kernel", "", "AVX2", "avx", "best")
        wrong("--format", "", "STL", "ply", "f16", ".stl")

    def test_kernel_of_another_processor(self):
        here = json.loads(self.succeed("info", "--json"))["kernels"]
        for kernel in {"avx512", "avx2", "sse2", "neon", "scalar"} - set(here):
            self.fail_with(2, "--kernel: '%s' does not run here; choose one of %s;" % (kernel, ", ".join(here)),
                           "overlap", "a.obj", "--box", support.UNIT_BOX, "--kernel", kernel)

    def test_box_numbers(self):
        def wrong(box, pattern):
            self.fail_with(2, r"^tribox overlap: --box: " + pattern, "overlap", "a.obj", "--box", box)
        wrong("", "number 1 of 6 is missing")
        wrong("1,2,3", "3 numbers where 6 are needed; give LX,LY,LZ,HX,HY,HZ")
        wrong("1", "1 number where 6")
        wrong("1,2,3,4,5,6,7", "more than 6 numbers")
        wrong("1,2,,4,5,6", "number 3 of 6 is missing")
        wrong("1,2,3,4,5,6,", "more than 6 numbers")
        wrong(",1,2,3,4,5,6", "number 1 of 6 is missing")
        wrong("1,2,x,4,5,6", r"'x' \(number 3 of 6\) is not a number; write it like")
        wrong("1,2,3m,4,5,6", r"'3m' \(number 3 of 6\) is not a number")
        wrong("1,2,1e,4,5,6", r"'1e' \(number 3 of 6\) is not a number")
        wrong("1;2;3;4;5;6", r"'1;2;3;4;5;6' \(number 1 of 6\) is not a number")
        wrong("1,2,nan,4,5,6", r"'nan' \(number 3 of 6\) is not finite")
        wrong("-inf,2,3,4,5,6", r"'-inf' \(number 1 of 6\) is not finite")
        wrong("1,2,3,4,5,1e309", r"'1e309' \(number 6 of 6\) is too large for double, which ends at 1\.79769313e\+308")
        wrong("1,2,3,4,-1.8e308,5", r"'-1\.8e308' \(number 5 of 6\) is too large for double")
        wrong("1,1e-324,3,4,5,6", r"'1e-324' \(number 2 of 6\) is too small for double; give 0 or at least 4\.9e-324")


class RightCommandLine(support.TestCase):
    def setUp(self):
        super().setUp()
        self.mesh = self.write("mesh.obj", meshes.obj([((0, 0, 0), (1, 0, 0), (0, 1, 0))]))

    def count(self, *arguments):
        return json.loads(self.succeed("overlap", *arguments, "--json"))["overlapping"]

    def test_forms(self):
        for box in ("0,0,0,1,1,1", "0 0 0 1 1 1", " 0, 0 ,0\t1,1,1 ", "0,0,0,1e0,+1,0x1p0", "-0,0,0,1.,1.0,100e-2"):
            self.assertEqual(self.count(self.mesh, "--box", box), 1, box)
        self.assertEqual(self.count("--box=-1,-1,-1,1,1,1", self.mesh), 1)
        self.assertRegex(self.succeed("overlap", "--box", "-1,-1,-1,1,1,1", "--", self.mesh), "overlapping  1 ")

    def test_short_and_abbreviated_options(self):
        expected = self.succeed("overlap", self.mesh, "--list", "--box", support.UNIT_BOX)
        for options in (("-l", "-b", support.UNIT_BOX), ("-lb", support.UNIT_BOX), ("-b" + support.UNIT_BOX, "--li"),
                        ("--lis", "--box=" + support.UNIT_BOX)):
            self.assertEqual(self.succeed("overlap", *options, self.mesh), expected, options)

    def test_operands_after_the_options(self):
        """A mesh whose name looks like an option."""
        self.write("--json", meshes.ply_ascii([((0, 0, 0), (1, 0, 0), (0, 1, 0))]))
        self.assertIn("mesh         --json\n", self.succeed("overlap", "-b", support.UNIT_BOX, "--", "--json", cwd=self.folder))

    def test_ends_of_the_float_range(self):
        self.assertEqual(self.count(self.mesh, "--box", "-3.4028235e38,-1,-1,3.4028235e38,1,1"), 1)
        self.assertEqual(self.count(self.mesh, "--box", "1.4e-45,1.4e-45,0,1,1,1"), 1)

    def test_empty_box_is_noted(self):
        text = self.succeed_with_note("note: --box: the lower bound 2 exceeds the upper bound 1 on the y axis: an empty box",
                                      "overlap", self.mesh, "--box", "0,2,0,1,1,1", "--json")
        self.assertEqual(json.loads(text)["overlapping"], 0)


if __name__ == "__main__":
    support.main()
