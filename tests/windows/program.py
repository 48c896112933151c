"""The program for Windows under wine, beside the one of this machine: the same bytes, names in UTF-16, interrupts.

program.py HERE WINE FOLDER [TEST...]: the program of this machine, wine.sh, and the folder of the build for Windows.
"""

import json
import os
import pty
import signal
import stat
import struct
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tools"))
import harness as support  # noqa: E402
import triangles as meshes  # noqa: E402
from harness import UNIT_BOX, read  # noqa: E402

HERE, WINE, BUILD = map(os.path.abspath, sys.argv[1:4])
NAMES = ("plain", "with a space", "h\u00e9 \u65e5\u672c", "\U0001f389 \u00df'%PATH%")
TRIANGLES = meshes.lattice_triangles(3000, seed=4)
GRID = ("--cell", "0.0625", "--origin", "-2,-2,-2", "--size", "70,65,130")
OF_THE_TIME = ("runs", "seconds", "ns_per_triangle", "total_seconds", "processor")


class Windows(support.TestCase):
    def setUp(self):
        super().setUp()
        self.mesh = self.write("mesh.f32", meshes.pack_floats(TRIANGLES))

    def run_both(self, *arguments, stdin=b""):
        return [subprocess.run([program, *arguments], input=stdin, capture_output=True, timeout=120)
                for program in (HERE, support.program())]

    def ask_both(self, *arguments, stdin=b""):
        """What both programs print; what they say is the same."""
        done = self.run_both(*arguments, stdin=stdin)
        self.assertEqual((done[0].returncode, done[0].stderr), (done[1].returncode, done[1].stderr), arguments)
        return [one.stdout for one in done]

    def assert_same(self, *arguments, stdin=b""):
        here, there = self.ask_both(*arguments, stdin=stdin)
        self.assertEqual(here, there, arguments)
        return there

    def assert_same_files(self, name, *arguments):
        """The file or folder that both write."""
        contents = []
        for program, where in ((HERE, "here"), (support.program(), "there")):
            os.makedirs(self.path(where), exist_ok=True)
            path = os.path.join(self.path(where), name)
            done = subprocess.run([program, *arguments, "--quiet", "-o", path], capture_output=True, timeout=120)
            self.assertEqual((done.returncode, done.stderr), (0, b""), arguments)
            contents.append([read(os.path.join(path, one)) for one in ("index", "triangles")] if os.path.isdir(path)
                            else read(path))
        self.assertEqual(contents[0], contents[1], arguments)
        return os.path.join(self.path("there"), name)


class Answers(Windows):
    def test_overlap(self):
        mesh = self.write("mesh.obj", meshes.obj(TRIANGLES[:300]))
        for path, stdin, form in ((mesh, b"", ()), ("-", meshes.stl_binary(TRIANGLES), ("--format", "stl")),
                                  ("-", read(self.mesh), ("--format", "f32"))):
            self.assert_same("overlap", path, *form, "--box", UNIT_BOX, "--list", stdin=stdin)
            here, there = map(json.loads, self.ask_both("overlap", path, *form, "--box", UNIT_BOX, "--json", stdin=stdin))
            self.assertEqual(*({key: one[key] for key in one if key not in OF_THE_TIME} for one in (here, there)))
        self.assertIn(b"kernel", self.ask_both("overlap", mesh, "--box", "0.1,0.1,0.1,0.2,1e-7,3")[1])

    def test_boxes_with_line_ends_of_windows(self):
        boxes = self.write("boxes.txt", "# two\r\n-0.5,-0.5,-0.5,0.5,0.5,0.5\r\n\r\n0 0 0 1 1 1\r\n")
        self.assertEqual(len(self.ask_both("overlap", self.mesh, "--boxes", boxes)[1].splitlines()), 2)

    def test_words_and_ways_of_testing(self):
        box = ("overlap", self.mesh, "--box", UNIT_BOX, "--list")
        for arguments in ((*box, "--kernel", "scalar"), (*box, "--kernel", "sse2"), (*box, "--accuracy", "fast"),
                          (*box, "--axes", "box"), (*box, "--order", "321"), ("--version",), ("overlap", "--help"),
                          ("info", "--js", "--json"), ("overlap", "m.obj", "--o", "1"), ("overlap", "--list=yes"),
                          ("overlap", "m.obj", "--box"), ("overlap", "m.obj", "-lb", "1,2"), ("-x",), ()):
            self.assert_same(*arguments)

    def test_info_and_demo(self):
        about = json.loads(self.succeed("info", "--json"))
        self.assertIn("scalar", about["kernels"])
        self.assertNotIn("unknown", about["processor"])
        rows = [line.split() for line in self.succeed("demo", "--quick").splitlines()]
        self.assertEqual({(row[4], row[7]) for row in rows if row[1:2] == ["exact"]}, {("0", "0")})


class Files(Windows):
    def test_voxels(self):
        for threads in ("1", "4"):
            for ending in ("npy", "npz", "nrrd", "raw"):
                self.assert_same_files("voxels." + ending, "voxelize", self.mesh, *GRID, "--threads", threads)
        self.assert_same_files("filled.npz", "voxelize", self.mesh, *GRID, "--fill", "outside")
        wide = self.write("wide.f64", struct.pack("<18d", *(0.1 * n * n % 3 + 1e9 / 7 for n in range(18))))
        for grid in (("--resolution", "300"), ("--cell", "0.0123456789,0.02,0.03")):
            self.assert_same_files("wide.npz", "voxelize", wide, *grid)

    def test_pipes(self):
        for word in ("npy", "npz"):
            self.assert_same("voxelize", "-", "--format", "f32", *GRID, "--out-format", word, "-o", "-", stdin=read(self.mesh))

    def test_shards(self):
        whole = self.assert_same_files("whole.npz", "voxelize", self.mesh, *GRID)
        tiles = self.assert_same_files("tiles", "partition", self.mesh, *GRID)
        for mesh, grid in ((self.mesh, GRID), (tiles, ())):
            parts = [self.assert_same_files("%d.part.npz" % n, "voxelize", mesh, *grid, "--shard", "%d/3" % n) for n in (1, 2, 3)]
            merged = self.assert_same_files("merged.npz", "merge", *parts)
            self.assertEqual(read(merged), read(whole))

    def test_names(self):
        for name in NAMES:
            folder = self.path(name)
            os.mkdir(folder)
            mesh = os.path.join(folder, name + ".stl")
            with open(mesh, "wb") as file:
                file.write(meshes.stl_binary(TRIANGLES[:10]))
            self.assertIn(name.encode(), self.ask_both("overlap", mesh, "--box", UNIT_BOX)[1])
            for out in (name + ".npz", name + ".npy"):
                self.succeed("voxelize", mesh, "--resolution", "9", "--quiet", "-o", os.path.join(folder, out))
            self.succeed("partition", mesh, "--resolution", "9", "--quiet", "-o", os.path.join(folder, name + " tiles"))
            self.succeed("voxelize", os.path.join(folder, name + " tiles"), "--quiet", "-o", os.path.join(folder, "of tiles.npz"))
            self.assertEqual(read(os.path.join(folder, "of tiles.npz")), read(os.path.join(folder, name + ".npz")))
            self.assertEqual(sorted(os.listdir(folder)), sorted([name + ".stl", name + ".npz", name + ".npy", name + " tiles",
                                                                 "of tiles.npz"]))
            self.fail_with(1, "%s.ply: cannot open the mesh file: No such file or directory" % name.replace("%", ".PATH.")[:4],
                           "overlap", os.path.join(folder, name[:4] + ".ply"), "--box", UNIT_BOX)

    def test_separators(self):
        """Backslashes part folders, too."""
        os.mkdir(self.path("deep"))
        self.succeed("voxelize", self.mesh, "--resolution", "9", "--quiet", "-o", "deep\\x.npz", cwd=self.folder)
        self.assertEqual(os.listdir(self.path("deep")), ["x.npz"])

    def test_takes_the_place_of_another(self):
        out = self.write("out.npy", "what was there")
        self.succeed("voxelize", self.mesh, "--resolution", "9", "--quiet", "-o", out)
        self.assertEqual(read(out)[:6], b"\x93NUMPY")
        self.assertEqual(stat.S_IMODE(os.stat(out).st_mode) & 0o400, 0o400)

    def test_links(self):
        """The file that a symbolic link leads to is written, wherever it is, and the link stays."""
        os.mkdir(self.path("elsewhere"))
        real = self.write("elsewhere/h\u00e9.npy", "what was there")
        os.symlink("elsewhere/h\u00e9.npy", self.path("link.npy"))
        os.symlink("link.npy", self.path("link_to_link.npy"))
        self.succeed("voxelize", self.mesh, "--resolution", "9", "--quiet", "-o", self.path("link_to_link.npy"))
        self.assertEqual(os.readlink(self.path("link_to_link.npy")), "link.npy")
        self.assertEqual(os.readlink(self.path("link.npy")), "elsewhere/h\u00e9.npy")
        self.assertEqual(read(real)[:6], b"\x93NUMPY")
        self.assertEqual(os.listdir(self.path("elsewhere")), ["h\u00e9.npy"])


class Refused(Windows):
    def tearDown(self):
        self.assertEqual([name for name in os.listdir(self.folder) if name.startswith(".tribox")], [])

    def test_bad_meshes(self):
        """What the system says of a file, and what a reader does."""
        for mesh in (self.path("nowhere.ply"), self.folder, self.write("cut.f32", b"\0" * 37)):
            self.assert_same("overlap", mesh, "--box", UNIT_BOX)

    def test_outputs(self):
        for out, why in ((self.folder, "is a directory; give the name of a file"),
                         (self.path("nowhere/x.npy"), "cannot write there: No such file or directory")):
            self.fail_with(1, why, "voxelize", self.mesh, "--resolution", "9", "--out-format", "npy", "-o", out)
        os.mkdir(self.path("there"))
        self.fail_with(1, "is there already; remove it", "partition", self.mesh, "--resolution", "9", "-o", self.path("there"))
        self.fail_with(1, "cannot open index in it, so that it is no partition: No such file", "voxelize", self.path("there"), "-o",
                       "x.npz")

    def test_picture(self):
        self.fail_with(1, "--preview: this program was built without libpng", "voxelize", self.mesh, "--resolution", "9", "-o",
                       self.path("x.npy"), "--preview", self.path("x.png"))
        self.assertEqual(os.listdir(self.folder), ["mesh.f32"])


class Interrupted(Windows):
    GRID = ("--cell", "0.001", "--origin", "-2,-2,-2", "--size", "4000,4000,4000")

    def end(self, number, *arguments):
        """Ends a run once it has begun to write. What it leaves, and says."""
        before = set(os.listdir(self.folder))
        process = support.start(*arguments, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        self.wait_for(lambda: set(os.listdir(self.folder)) != before)
        process.send_signal(number)
        said = process.communicate(timeout=60)[1].decode()
        self.assertNotEqual(process.returncode, 0)
        return set(os.listdir(self.folder)) - before, said

    def what_stays(self, names):
        """Of what is left, without the open files that wine removes a moment after their program ended."""
        self.wait_for(lambda: not names & set(os.listdir(self.folder)))
        return names & set(os.listdir(self.folder))

    def test_ctrl_c(self):
        """wine makes Ctrl-C of SIGINT."""
        self.write("x.npz", "what was there")
        for command in (("voxelize", "-o", self.path("x.npz")), ("voxelize", "--shard", "1/2", "-o", self.path("x.part.npz")),
                        ("partition", "-o", self.path("x"))):
            left, said = self.end(signal.SIGINT, command[0], self.mesh, *self.GRID, "--quiet", *command[1:])
            self.assertEqual(self.what_stays(left), set(), command)
            self.assert_one_line(said, "interrupted: nothing was written; run ")
        self.assertEqual(read(self.path("x.npz")), b"what was there")

    def end_in_console(self, *arguments):
        """Presses Ctrl-C once a run in a console shows UTF-8 there and, if it writes, has begun to. What in_console says last."""
        screen, console = pty.openpty()
        command = subprocess.list2cmdline(["tools/tribox.exe", *arguments])
        process = subprocess.Popen([WINE, BUILD, "in_console.exe", command], cwd=BUILD, stdin=subprocess.PIPE, stdout=console,
                                   stderr=subprocess.PIPE)
        self.assertEqual(process.stderr.readline().rstrip(), b"shows UTF-8")
        self.wait_for(lambda: "-o" not in arguments or os.listdir(self.folder) != ["mesh.f32"])
        said = process.communicate(b"\n", timeout=60)[1].decode().splitlines()[-1]
        os.close(screen)
        os.close(console)
        return said

    def test_console_left_as_it_was(self):
        for arguments in (("voxelize", self.mesh, *self.GRID, "--quiet", "-o", self.path("x.npz")),
                          ("overlap", "-", "--format", "f32", "--box", UNIT_BOX)):
            with self.subTest(arguments=arguments):
                self.assertEqual(self.end_in_console(*arguments), "leaves 437")
            self.assertEqual(self.what_stays(set(os.listdir(self.folder)) - {"mesh.f32"}), set())

    def test_killed(self):
        self.write("x.npy", "what was there")
        left, _ = self.end(signal.SIGKILL, "voxelize", self.mesh, "--resolution", "900", "--quiet", "-o", self.path("x.npy"))
        self.assertTrue(all(name.startswith(".tribox-") for name in left), left)
        self.assertEqual(read(self.path("x.npy")), b"what was there")


if __name__ == "__main__":
    program = os.path.join(BUILD, "tribox")
    with open(program, "w") as script:
        script.write('#!/bin/sh\nexec "%s" "%s" "%s/tools/tribox.exe" "$@"\n' % (WINE, BUILD, BUILD))
    os.chmod(program, 0o755)
    os.environ["TRIBOX_PROGRAM"] = program
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
