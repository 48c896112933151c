"""Binary STL and raw triangles, read in blocks: the answers of a mesh in one piece, from files, pipes and standard input."""

import contextlib
import json
import os
import pty
import random
import resource
import select
import struct
import subprocess
import threading
import time

import meshes
import support

BLOCK = 4096  # triangles, as in tools/read/triangle_file.h
PACKED = {"stl": meshes.stl_binary, "f32": meshes.pack_floats}
TRIANGLES = meshes.lattice_triangles(2 * BLOCK + 70, seed=6)
OF_THE_TIME = ("mesh", "index", "runs", "seconds", "ns_per_triangle", "total_seconds", "undecided")


def any_triangles(count, seed):
    """Floats of all bits, NaN and infinity among them."""
    pick = random.Random(seed)
    return [struct.unpack("<9f", struct.pack("<9I", *(pick.getrandbits(32) for _ in range(9)))) for _ in range(count)]


class Streams(support.TestCase):
    def ask(self, *arguments, **how):
        """The answer as JSON without its times, and what was said beside it."""
        result = support.run("overlap", *arguments, "--json", "--list", **how)
        self.assertEqual(result.code, 0, result.stderr)
        answer = json.loads(result.stdout)
        return {key: answer[key] for key in answer if key not in OF_THE_TIME}, result.stderr.rpartition(": ")[2]

    def test_same_as_in_one_piece(self):
        """Around the edges of words and blocks, in both formats, from a file, from standard input, and for --boxes."""
        for count in (1, 2, 63, 64, 65, BLOCK - 1, BLOCK, BLOCK + 1, 2 * BLOCK - 1, 2 * BLOCK, 2 * BLOCK + 1, 2 * BLOCK + 70):
            triangles = TRIANGLES[:count]
            whole = self.ask(self.write("mesh.ply", meshes.ply_binary(triangles)), "--box", support.UNIT_BOX)
            for form, pack in PACKED.items():
                with self.subTest(count=count, form=form):
                    packed = pack(triangles)
                    path = self.write("mesh." + form, packed)
                    self.assertEqual(self.ask(path, "--box", support.UNIT_BOX), whole)
                    self.assertEqual(self.ask("-", "--format", form, "--box", support.UNIT_BOX, stdin=packed), whole)
                    in_line = self.ask(path, "--boxes", "-", stdin=support.UNIT_BOX.encode())
                    self.assertEqual(in_line[0].pop("line"), 1)
                    self.assertEqual(in_line, whole)

    def test_against_clipping(self):
        expected = meshes.overlapping(TRIANGLES[:BLOCK + 9], (-0.5, -0.5, -0.5, 0.5, 0.5, 0.5))
        for form, pack in PACKED.items():
            text = self.succeed("overlap", "-", "--format", form, "--box", support.UNIT_BOX, "--list", stdin=pack(TRIANGLES[:BLOCK + 9]))
            self.assertEqual(text, "".join("%d\n" % i for i in expected))

    def test_every_way_of_testing(self):
        kernels = json.loads(self.succeed("info", "--json"))["kernels"]
        ply = self.write("mesh.ply", meshes.ply_binary(TRIANGLES))
        ways = [("--kernel", kernel) for kernel in kernels] + [("--axes", "box,plane"), ("--accuracy", "fast"), ("--order", "213")]
        for way in ways:
            whole = self.ask(ply, "--box", support.UNIT_BOX, *way)
            self.assertEqual(self.ask("-", "--format", "f32", "--box", support.UNIT_BOX, *way, stdin=meshes.pack_floats(TRIANGLES)), whole)

    def test_all_floats(self):
        """Bit for bit, with what is not finite counted from the first block to the last."""
        rows = any_triangles(2 * BLOCK + 5, seed=7)
        triangles = [(row[:3], row[3:6], row[6:]) for row in rows]
        for rest in (triangles, TRIANGLES[:BLOCK + 3] + triangles[:1000]):
            whole = self.ask(self.write("mesh.ply", meshes.ply_binary(rest)), "--box", "-1,-1,-1,1e20,1e20,1e20")
            self.assertGreater(whole[0]["not_finite"], 0)
            for form, pack in PACKED.items():
                packed = pack(rest)
                self.assertEqual(self.ask("-", "--format", form, "--box", "-1,-1,-1,1e20,1e20,1e20", stdin=packed), whole)
                self.assertEqual(self.ask(self.write("mesh." + form, packed), "--box", "-1,-1,-1,1e20,1e20,1e20"), whole)
        first = next(i for i, row in enumerate(rows) if not all(abs(x) <= 3.5e38 for x in row))
        self.succeed_with_note("warning: stdin: [0-9]+ of %d triangles have NaN or infinite coordinates and overlap nothing; the first is "
                               "number %d$" % (BLOCK + 5 + len(rows), BLOCK + 5 + first), "overlap", "-", "--format", "f32", "--box",
                               support.UNIT_BOX, stdin=meshes.pack_floats(TRIANGLES[:BLOCK + 5] + triangles))

    def test_summary(self):
        text = self.succeed("overlap", "-", "--format", "stl", "--box", support.UNIT_BOX, stdin=meshes.stl_binary(TRIANGLES))
        self.assertRegex(text, r"\Amesh         -\nbox          %s\ntriangles    %d\n" % (support.UNIT_BOX, len(TRIANGLES)))
        self.assertRegex(text, r"(?m)^time +[\d.]+ m?s, [\d.]+ ns per triangle \(the test alone, in blocks; with reading the mesh [\d.]+ m?s\)$")
        answer = json.loads(self.succeed("overlap", "-", "--format", "stl", "--box", support.UNIT_BOX, "--json",
                                         stdin=meshes.stl_binary(TRIANGLES)))
        self.assertNotIn("indices", answer)
        self.assertEqual(answer["runs"], 1)
        self.assertTrue(0 < answer["seconds"] < answer["total_seconds"])

    def test_format_wins_over_the_name(self):
        for form, pack in PACKED.items():
            for name in ("mesh", "mesh.bin", "mesh.ply", "mesh.stl", "mesh.f32"):
                path = self.write(name, pack(TRIANGLES[:99]))
                for question in (("--box", support.UNIT_BOX), ("--boxes", "-")):
                    answer, _ = self.ask(path, "--format", form, *question, stdin=support.UNIT_BOX.encode())
                    self.assertEqual(answer["triangles"], 99)

    def test_other_commands(self):
        """They read the same files, in one piece."""
        grids = []
        for name, pack in (("mesh.ply", meshes.ply_binary), ("mesh.f32", meshes.pack_floats), ("mesh.stl", meshes.stl_binary)):
            out = os.path.join(self.folder, "out.raw")
            self.succeed("voxelize", self.write(name, pack(TRIANGLES[:500])), "--resolution", "40", "-o", out, "--quiet")
            with open(out, "rb") as file:
                grids.append(file.read())
        self.assertEqual(grids[1:], grids[:1] * 2)
        self.fail_with(1, "mesh.f32: truncated", "voxelize", self.write("mesh.f32", bytes(50)), "--resolution", "4", "-o", out)

    @contextlib.contextmanager
    def fed(self, path, content):
        """Meanwhile another thread writes into the fifo."""
        def feed():
            with open(path, "wb") as file:
                file.write(content)
        thread = threading.Thread(target=feed, daemon=True)
        thread.start()
        yield
        thread.join(60)

    def test_fifo(self):
        path = os.path.join(self.folder, "fifo")
        os.mkfifo(path)
        for form, pack in PACKED.items():
            with self.fed(path, pack(TRIANGLES)):
                self.assertEqual(self.ask(path, "--format", form, "--box", support.UNIT_BOX)[0]["triangles"], len(TRIANGLES))
            with self.fed(path, pack(TRIANGLES)):
                answer, _ = self.ask(path, "--format", form, "--boxes", "-", stdin=support.UNIT_BOX.encode())
            self.assertEqual(answer["triangles"], len(TRIANGLES))
        for question in (("--boxes", "-"), ("--box", support.UNIT_BOX)):
            with self.fed(path, b""):
                self.fail_with(1, "fifo: contains no triangles", "overlap", path, "--format", "f32", *question)

    def test_printed_as_they_come(self):
        """The numbers of a block are there before the next block is sent."""
        process = subprocess.Popen([support.program(), "overlap", "-", "--format", "f32", "--box", "0,0,0,0,0,0", "--list"],
                                   stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0)
        block = bytes(36 * (BLOCK - 1)) + struct.pack("<9f", *[9] * 9)
        with process:
            for i in range(3):
                process.stdin.write(block)
                for number in range(i * BLOCK, (i + 1) * BLOCK - 1):
                    ready, _, _ = select.select([process.stdout], [], [], 60)
                    self.assertTrue(ready, "no answer within a minute")
                    self.assertEqual(process.stdout.readline(), b"%d\n" % number)
            process.stdin.close()
            self.assertEqual(process.stdout.read(), b"")
        self.assertEqual(process.returncode, 0)

    def test_ends_when_the_list_is_lost(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("no /dev/full here")
        for more in ((), ("--json",)):
            with open("/dev/full", "wb") as full, open("/dev/zero", "rb") as zeros:
                done = subprocess.run([support.program(), "overlap", "-", "--format", "f32", "--box", "0,0,0,0,0,0", "--list", *more],
                                      stdin=zeros, stdout=full, stderr=subprocess.PIPE, timeout=120)
            self.assertEqual(done.returncode, 1)
            self.assert_one_line(done.stderr.decode(), "cannot write the output: ")

    def test_progress(self):
        """A bar for a stream that knows its length and takes its time; gone in the end."""
        leader, follower = pty.openpty()
        packed = meshes.stl_binary(TRIANGLES)
        process = subprocess.Popen([support.program(), "overlap", "-", "--format", "stl", "--box", support.UNIT_BOX],
                                   stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=follower)
        os.close(follower)
        process.stdin.write(packed[:84 + 50 * BLOCK])
        process.stdin.flush()
        time.sleep(0.9)
        process.communicate(packed[84 + 50 * BLOCK:])
        said = b""
        with contextlib.suppress(OSError):  # Linux ends a terminal without a writer so
            while part := os.read(leader, 10000):
                said += part
        os.close(leader)
        self.assertEqual(process.returncode, 0)
        self.assertRegex(said, rb"\rtesting \[#+\.*\] +\d+ %")
        self.assertTrue(said.endswith(b"\r" + b" " * 79 + b"\r"))


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


class Cut(support.TestCase):
    """Streams that end too soon, or do not end: no summary, and a line that says where."""

    def refuse(self, content, form, pattern, *more):
        self.fail_with(1, "^tribox overlap: stdin: " + pattern, "overlap", "-", "--format", form, "--box", support.UNIT_BOX, *more,
                       stdin=content)

    def test_raw(self):
        whole = meshes.pack_floats(TRIANGLES)
        for count in (0, 1, BLOCK - 1, BLOCK, BLOCK + 1, 2 * BLOCK):
            for rest in (1, 17, 35):
                self.refuse(whole[:36 * count + rest], "f32", "truncated: %d triangles were read, then it ends with %d of 36 bytes of the "
                            "next; write it again$" % (count, rest), "--json")

    def test_stl(self):
        whole = meshes.stl_binary(TRIANGLES)
        for count in (0, 1, BLOCK - 1, BLOCK, BLOCK + 1, 2 * BLOCK, len(TRIANGLES) - 1):
            for rest in (0, 1, 49):
                self.refuse(whole[:84 + 50 * count + rest], "stl", "truncated: %d of %d promised triangles were read, then it ends with %d "
                            "of 50 bytes of the next; write it again$" % (count, len(TRIANGLES), rest), "--json")

    def test_header_of_stl(self):
        whole = bytes(80) + meshes.stl_binary(TRIANGLES)[80:]
        for size in (1, 79, 80, 83):
            self.refuse(whole[:size], "stl", "truncated, or not an STL file: it has %d bytes, but the header alone of a binary one has 84" % size)

    def test_nothing(self):
        self.refuse(b"", "stl", "the file is empty")
        self.refuse(b"", "f32", "contains no triangles")
        self.refuse(meshes.stl_binary([]), "stl", "contains no triangles", "--json", "--list")
        for form in PACKED:
            self.fail_with(1, "/dev/null: (the file is empty|contains no triangles)", "overlap", "/dev/null", "--format", form, "--box",
                           support.UNIT_BOX)

    def test_more_than_is_promised(self):
        for count in (1, BLOCK, BLOCK + 1):
            for more in (b"\0", bytes(50), bytes(5000)):
                self.refuse(meshes.stl_binary(TRIANGLES[:count]) + more, "stl",
                            "has bytes after the %d triangles that its header promises; write it again$" % count)

    def test_gigantic(self):
        for count in (2 ** 31, 2 ** 32 - 1):
            content = bytes(80) + struct.pack("<I", count) + bytes(500)
            self.refuse(content, "stl", "truncated: 10 of %d promised triangles were read" % count)

    def test_text(self):
        pattern = "is text, and only binary STL can be streamed; give it as a file named .stl, without --format$"
        for content in (meshes.stl_ascii(TRIANGLES[:3]), b"solid empty\nendsolid empty\n", "solid \u00fcber\n".encode() * 9, b"hello\n"):
            self.refuse(content, "stl", pattern)
            self.fail_with(1, "text.stl: " + pattern, "overlap", self.write("text.stl", content), "--format", "stl", "--box",
                           support.UNIT_BOX)

    def test_read_error(self):
        for form in PACKED:
            folder = os.open(self.folder, os.O_RDONLY)
            done = subprocess.run([support.program(), "overlap", "-", "--format", form, "--box", support.UNIT_BOX], stdin=folder,
                                  capture_output=True, timeout=120)
            os.close(folder)
            self.assertEqual((done.returncode, done.stdout), (1, b""))
            self.assert_one_line(done.stderr.decode(), "stdin: cannot read the mesh( after 0 triangles)?: Is a directory")

    def test_list_up_to_the_cut(self):
        """What is printed is right; that it is not all, the exit code tells."""
        result = support.run("overlap", "-", "--format", "f32", "--box", "0,0,0,0,0,0", "--list", stdin=bytes(36 * BLOCK + 1))
        self.assertEqual((result.code, result.stdout), (1, "".join("%d\n" % i for i in range(BLOCK))))
        self.assert_one_line(result.stderr, "stdin: truncated: %d triangles were read" % BLOCK)


class Memory(support.TestCase):
    """Three million triangles, 108 million bytes, in 64 MiB of addresses for all there is."""

    def setUp(self):
        super().setUp()
        self.limit = (resource.RLIMIT_AS, 64 << 20)
        if support.run("info", limit=self.limit).code:
            self.skipTest("this build needs more than 64 MiB of addresses by itself")

    def stream(self, form, head, block, blocks):
        process = subprocess.Popen([support.program(), "overlap", "-", "--format", form, "--box", support.UNIT_BOX, "--json"],
                                   stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                   preexec_fn=lambda: resource.setrlimit(self.limit[0], (self.limit[1], self.limit[1])))
        with process:
            process.stdin.write(head)
            for _ in range(blocks):
                process.stdin.write(block)
            process.stdin.close()
            answer = json.loads(process.stdout.read())
        self.assertEqual(process.returncode, 0)
        return answer

    def test_streams(self):
        triangles = TRIANGLES[:5000]
        overlapping = len(meshes.overlapping(triangles, (-0.5, -0.5, -0.5, 0.5, 0.5, 0.5)))
        raw = self.stream("f32", b"", meshes.pack_floats(triangles), 600)
        self.assertEqual((raw["triangles"], raw["overlapping"]), (3000000, 600 * overlapping))
        head = bytes(80) + struct.pack("<I", 3000000)
        stl = self.stream("stl", head, meshes.stl_binary(triangles)[84:], 600)
        self.assertEqual((stl["triangles"], stl["overlapping"]), (3000000, 600 * overlapping))

    def test_files(self):
        """One box is asked of the file in blocks; for more than one it has to be in memory, where it does not fit."""
        path = self.write("zeros.f32", b"")
        os.truncate(path, 36 * 3000000)
        answer = json.loads(self.succeed("overlap", path, "--box", support.UNIT_BOX, "--json", limit=self.limit))
        self.assertEqual((answer["triangles"], answer["overlapping"]), (3000000, 3000000))
        self.fail_with(1, "zeros.f32: out of memory for 3000000 triangles; to voxelize it, sort it first: tribox partition .*zeros.f32 -o "
                       "NAME.tiles, with the same grid", "overlap", path, "--boxes", "-", limit=self.limit)


if __name__ == "__main__":
    support.main()
