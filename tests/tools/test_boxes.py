"""--boxes: files of boxes, answered line by line."""

import json
import os
import select
import subprocess

import meshes
import support

TRIANGLES = meshes.lattice_triangles(300, seed=5)


class Boxes(support.TestCase):
    def setUp(self):
        super().setUp()
        self.mesh = self.write("mesh.stl", meshes.stl_binary(TRIANGLES))

    def answers(self, boxes, *options):
        text = self.succeed("overlap", self.mesh, "--boxes", self.write("boxes.txt", boxes), "--json", *options)
        return [json.loads(line) for line in text.splitlines()]

    def test_answers(self):
        boxes = [(-0.5, -0.5, -0.5, 0.5, 0.5, 0.5), (0, 0, 0, 2, 2, 2), (1.5, 1.5, 1.5, 1.5, 1.5, 1.5), (5, 5, 5, 6, 6, 6)]
        lines = "".join(" ".join(map(str, box)) + "\n" for box in boxes)
        answers = self.answers(lines, "--list")
        self.assertEqual([a["indices"] for a in answers], [meshes.overlapping(TRIANGLES, box) for box in boxes])
        self.assertEqual([a["line"] for a in answers], [1, 2, 3, 4])
        self.assertEqual([a["runs"] for a in answers], [1] * 4)
        self.assertEqual([a["box"]["lo"] + a["box"]["hi"] for a in answers], [list(box) for box in boxes])

        text = self.succeed("overlap", self.mesh, "--boxes", "-", stdin=lines.encode())
        for line, box in zip(text.splitlines(), boxes):
            count = len(meshes.overlapping(TRIANGLES, box))
            self.assertRegex(line, r"^%s: %d of 300 triangles overlap \(%.2f %%\), \d+ undecided, [\d.]+ (ns per triangle|us by an index)$"
                             % (",".join("%g" % b for b in box), count, 100 * count / 300))
        self.assertEqual(len(text.splitlines()), len(boxes))

    def test_forms(self):
        lines = ("# a comment\n\n  \t\n0,0,0,1,1,1\n 0, 0, 0  1 1\t1 # the same\r\n0 0 0 1 1 1#\n\r\n#0 0 0\n0 ,0 ,0 ,1 ,1 ,1")
        answers = self.answers(lines)
        self.assertEqual([a["line"] for a in answers], [4, 5, 6, 9])
        self.assertEqual(len({a["overlapping"] for a in answers}), 1)

    def test_long_comment(self):
        self.assertEqual(len(self.answers("0 0 0 1 1 1 #" + "x" * 3000000 + "\n0 0 0 1 1 1\n")), 2)

    def test_many(self):
        """Twenty thousand boxes: one line each, none kept."""
        box_lines = "".join("%d 0 0 %d 1 1\n" % (i % 7 - 3, i % 7 - 2) for i in range(20000))
        self.assertEqual(len(self.answers(box_lines)), 20000)

    def test_no_box(self):
        for content in ("", "# nothing\n\n"):
            path = self.write("boxes.txt", content)
            self.assertEqual(self.succeed_with_note("note: .*boxes.txt: there is no box in it", "overlap", self.mesh, "--boxes", path), "")

    def test_empty_box_is_noted_with_its_line(self):
        path = self.write("boxes.txt", "0 0 0 1 1 1\n0 0 9 1 1 -1\n")
        text = self.succeed_with_note(r"note: .*boxes.txt:2: the lower bound 9 exceeds the upper bound -1 on the z axis",
                                      "overlap", self.mesh, "--boxes", path, "--json")
        self.assertEqual(json.loads(text.splitlines()[1])["overlapping"], 0)

    def test_wrong_lines(self):
        def wrong(line, pattern):
            """The boxes before it are answered; then one line names the place."""
            path = self.write("boxes.txt", b"0 0 0 1 1 1\n# two\n" + line + b"\n0 0 0 1 1 1\n")
            result = support.run("overlap", self.mesh, "--boxes", path)
            self.assertEqual((result.code, len(result.stdout.splitlines())), (1, 1))
            self.assert_one_line(result.stderr, r"^tribox overlap: [^\n]*boxes\.txt:3: " + pattern)
        wrong(b"0 0 0 1 1", "5 numbers where 6 are needed")
        wrong(b"0 0 0 1 1 1 1", "more than 6 numbers")
        wrong(b"0 0 0,,1 1 1", "number 4 of 6 is missing")
        wrong(b"0 0 0 1 1 one", r"'one' \(number 6 of 6\) is not a number")
        wrong(b"0 0 0 1 1 inf", r"'inf' \(number 6 of 6\) is not finite")
        wrong(b"0 0 0 1 1 9e999", r"'9e999' \(number 6 of 6\) is too large for double")
        wrong(b"0 0 0 1 1 1e-999", r"'1e-999' \(number 6 of 6\) is too small for double")
        wrong(b"0 0 0 1 1 1\0", "a NUL byte, so this is not a text file")
        wrong(b"0 " * 5000, "the line is too long")

    def test_stdin_is_named(self):
        self.fail_with(1, "stdin:1: 1 number where 6", "overlap", self.mesh, "--boxes", "-", stdin=b"7\n")

    def test_no_file(self):
        self.fail_with(1, "missing: cannot open the boxes file: No such file", "overlap", self.mesh, "--boxes", "missing")
        self.fail_with(1, "cannot (open|read) the boxes( file)?: ", "overlap", self.mesh, "--boxes", self.folder)

    def test_streaming(self):
        """Each box is answered before the next is sent."""
        process = subprocess.Popen([support.program(), "overlap", self.mesh, "--boxes", "-", "--json"],
                                   stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0)
        with process:
            for i in range(5):
                os.write(process.stdin.fileno(), b"%d 0 0 9 1 1\n" % i)
                ready, _, _ = select.select([process.stdout], [], [], 60)
                self.assertTrue(ready, "no answer within a minute")
                self.assertEqual(json.loads(process.stdout.readline())["line"], i + 1)
            process.stdin.close()
        self.assertEqual(process.returncode, 0)


if __name__ == "__main__":
    support.main()
