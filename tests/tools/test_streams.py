"""Binary STL and raw triangles, read in blocks: the answers of a mesh in one piece, from files, pipes and standard input."""

import os
import pty
import resource
import struct
import subprocess

import meshes
import support

BLOCK = 4096  # triangles, as in tools/read/triangle_file.h
PACKED = {"stl": meshes.stl_binary, "f32": meshes.pack_floats}
TRIANGLES = meshes.lattice_triangles(2 * BLOCK + 70, seed=6)
OF_THE_TIME = ("mesh", "index", "runs", "seconds", "ns_per_triangle", "total_seconds", "undecided")


class Voxels(support.TestCase):
    """Triangles in and cells out through pipes: the same bytes as by way of files."""

    GRID = ("--resolution", "20")

    def path(self, name):
        return os.path.join(self.folder, name)

    def through(self, *arguments, stdin=b"", **how):
        """What tribox writes on standard output, where nothing else is, and what it says."""
        done = subprocess.run([support.program(), *arguments], input=stdin, capture_output=True, timeout=120, **how)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout, done.stderr

    def file(self, name, *arguments):
        self.succeed(*arguments, "--quiet", "-o", self.path(name))
        with open(self.path(name), "rb") as file:
            return file.read()

    def test_mesh_from_a_pipe(self):
        """Of one triangle, of blocks, and of so many that the memory grows twice."""
        for count in (1, BLOCK, BLOCK + 1, 16 * BLOCK, 16 * BLOCK + 1, 40 * BLOCK + 3):
            triangles = (TRIANGLES * 20)[:count] if count < 20 * BLOCK else TRIANGLES[:3] * count
            triangles = triangles[:count - 1] + [((-3, -3, -3), (9, 9, 9), (2, 8, 5))]
            for form, pack in PACKED.items():
                with self.subTest(count=count, form=form):
                    packed = pack(triangles)
                    expected = self.file("file.raw", "voxelize", self.write("mesh." + form, packed), *self.GRID)
                    self.through("voxelize", "-", "--format", form, *self.GRID, "-o", self.path("pipe.raw"), stdin=packed)
                    with open(self.path("pipe.raw"), "rb") as file:
                        self.assertEqual(file.read(), expected)

    def test_file_to_a_pipe(self):
        mesh = self.write("mesh.f32", meshes.pack_floats(TRIANGLES[:99]))
        for word in ("npy", "binvox", "vox", "raw"):
            expected = self.file("file." + word, "voxelize", mesh, *self.GRID)
            self.assertEqual(self.through("voxelize", mesh, *self.GRID, "-o", "-", "--out-format", word), (expected, b""))
            self.assertEqual(self.file("other", "voxelize", mesh, *self.GRID, "--out-format", word), expected)
            part = self.file("all.part.npz", "voxelize", mesh, *self.GRID, "--shard", "1/1")
            self.assertEqual(self.through("voxelize", mesh, *self.GRID, "--shard", "1/1", "-o", "-", "--out-format", "npz"), (part, b""))
            self.assertEqual(self.through("merge", self.path("all.part.npz"), "-o", "-", "--out-format", word), (expected, b""))

    def test_both(self):
        """The notes name standard input; the preview is a file as ever."""
        packed = meshes.pack_floats(TRIANGLES[:99]) + struct.pack("<9f", *[float("nan")] * 9)
        found, said = self.through("voxelize", "-", "--format", "f32", *self.GRID, "-o", "-", "--out-format", "npy", stdin=packed)
        self.assertEqual(found, self.file("file.npy", "voxelize", self.write("mesh.f32", packed[:-36]), *self.GRID))
        self.assert_one_line(said.decode(), "warning: stdin: 1 of 100 triangles have NaN")

    def test_wrong_command_line(self):
        mesh = self.write("mesh.f32", meshes.pack_floats(TRIANGLES[:9]))
        for pattern, arguments in (("standard input needs its format: --format stl, f32 or", ("-", "-o", "x.npy")),
                                   ("standard output needs its format, --out-format WORD: one of npz, ", (mesh, "-o", "-")),
                                   ("--out-format: 'png' is none of npz, vdb", (mesh, "-o", "-", "--out-format", "png")),
                                   ("--json and -o - exclude", (mesh, "-o", "-", "--out-format", "raw", "--json")),
                                   ("a shard is written as .npz, not as raw", (mesh, "-o", "-", "--out-format", "raw", "--shard", "1/2")),
                                   ("--preview: '-' does not end", (mesh, "-o", "-", "--out-format", "raw", "--preview", "-"))):
            self.fail_with(2, "^tribox voxelize: %s.*see 'tribox voxelize --help'" % pattern, "voxelize", *self.GRID, *arguments)

    def test_never_to_a_terminal(self):
        leader, follower = pty.openpty()
        mesh = self.write("mesh.f32", meshes.pack_floats(TRIANGLES[:9]))
        done = subprocess.run([support.program(), "voxelize", mesh, *self.GRID, "-o", "-", "--out-format", "raw"], stdout=follower,
                              stderr=subprocess.PIPE, timeout=120)
        os.set_blocking(leader, False)
        self.assertRaises(BlockingIOError, os.read, leader, 1)
        os.close(follower)
        os.close(leader)
        self.assertEqual(done.returncode, 2)
        self.assert_one_line(done.stderr.decode(), "-o -: standard output is a terminal; send it to a program or a file")

    def test_broken_streams(self):
        packed = meshes.pack_floats(TRIANGLES)
        for content, pattern in ((b"", "stdin: contains no triangles"), (packed[:50], "stdin: truncated: 1 triangles were read")):
            self.fail_with(1, pattern, "voxelize", "-", "--format", "f32", *self.GRID, "-o", "-", "--out-format", "raw",
                           stdin=content)
        for content in (bytes(80) + struct.pack("<I", 2 ** 32 - 1) + bytes(500), meshes.stl_binary(TRIANGLES)[:-1]):
            self.fail_with(1, r"stdin: truncated: \d+ of \d+ promised", "voxelize", "-", "--format", "stl", *self.GRID, "-o",
                           self.path("x.raw"), stdin=content)

    def test_nobody_takes_it(self):
        """A reader that has gone, a full disk, and a limit on the size of files: a line and exit code 1."""
        mesh = self.write("mesh.f32", meshes.pack_floats(TRIANGLES[:99]))
        takes_none, gone = os.pipe()
        os.close(takes_none)
        places = [(gone, "Broken pipe")]
        if os.path.exists("/dev/full"):
            places.append((os.open("/dev/full", os.O_WRONLY), "No space left on device"))
        for place, reason in places:
            for size in ("4", "100"):
                done = subprocess.run([support.program(), "voxelize", mesh, "--resolution", size, "-o", "-", "--out-format", "npy"],
                                      stdout=place, stderr=subprocess.PIPE, timeout=120)
                self.assertEqual(done.returncode, 1)
                self.assert_one_line(done.stderr.decode(), "^tribox voxelize: cannot write the output: " + reason)
            os.close(place)

    def test_memory(self):
        """A stream is refused before it takes what is not there."""
        limit = (resource.RLIMIT_AS, 64 << 20)
        if support.run("info", limit=limit).code:
            self.skipTest("this build needs more than 64 MiB of addresses by itself")
        self.fail_with(1, r"stdin: after \d+ triangles the next take [\d.]+ MiB of memory and [\d.]+ MiB are available; save the "
                       "mesh as a file, which takes less", "voxelize", "-", "--format", "f32", "--cell", "1", "-o",
                       self.path("x.raw"), stdin=bytes(36 << 20), limit=limit)


if __name__ == "__main__":
    support.main()
