"""Where voxelize and merge write: files, links, pipes, full disks, signals, little memory; all of a file or nothing of it."""

import itertools
import os
import random
import resource
import shutil
import signal
import struct
import subprocess
import tempfile
import time

import harness
import numpy as np
import readers
import triangles as meshes
from harness import MIB, SEED, UNIT_BOX, Voxels, grid_of, read
from test_cells import LATTICE, TILES

TOO_LARGE = "cannot write all of it: File too large; nothing of it was kept"


class Files(Voxels):
    def setUp(self):
        super().setUp()
        self.mesh = self.mesh_of(LATTICE)


class Places(Files):
    def test_standard_output(self):
        """The file itself, where it is written by going back in it too: for that a nameless one is made and leaves nothing."""
        temporary, part = self.path("temporary"), self.path("part.npz")
        os.mkdir(temporary)
        self.succeed("voxelize", self.mesh, "-r", "20", "--shard", "1/1", "-q", "-o", part)
        piped = harness.run("voxelize", self.mesh, "-r", "20", "--shard", "1/1", "-o", "-", "--out-format", "npz")
        self.assertEqual((piped.octets, piped.stderr), (read(part), ""))
        for word in (word for word in harness.formats() if word != "vdb"):  # whose files differ by a number
            expected = self.out("voxelize", self.mesh, "-r", "20", "--out-format", word)
            for command in (("voxelize", self.mesh, "-r", "20"), ("merge", part)):
                done = harness.run(*command, "--out-format", word, "-o", "-", env={"TMPDIR": temporary})
                self.assertEqual((done.code, done.stderr, done.octets, os.listdir(temporary)), (0, "", expected, []),
                                 (word, command[0]))
        self.fail_with(1, "^tribox voxelize: /nonexistent: cannot write there: No such file", "voxelize", self.mesh, "-r", "20",
                       "--out-format", "npz", "-o", "-", env={"TMPDIR": "/nonexistent"})
        result = harness.run("voxelize", "-", "--format", "f32", "-r", "20", "-o", "-", "--out-format", "npy",
                             stdin=read(self.mesh) + struct.pack("<9f", *[meshes.NAN] * 9))
        self.assertEqual(result.octets, self.out("voxelize", self.mesh, "-r", "20", ending=".npy"))
        self.assert_one_line(result.stderr, "warning: stdin: 1 of 25 triangles have NaN")

    def test_rights(self):
        """A file that takes the place of another has its rights."""
        for rights in (0o600, 0o664):
            path = self.path("kept.npz")
            self.succeed("voxelize", self.mesh, "-r", "20", "-q", "-o", path)
            os.chmod(path, rights)
            self.succeed("voxelize", self.mesh, "-r", "21", "-q", "-o", path)
            self.assertEqual(os.stat(path).st_mode & 0o777, rights)

    def test_pipe_of_openvdb(self):
        """Places in the file are not filled in then, and not looked at."""
        self.need("OpenVDB")
        words = ("voxelize", self.mesh, "-r", "20", "--vdb-grid", "mask")
        self.write("pipe.vdb", harness.run(*words, "--out-format", "vdb", "-o", "-").octets)
        self.succeed(*words, "-q", "-o", self.path("x.vdb"))
        self.assertTrue(np.array_equal(readers.read(self.path("pipe.vdb"))[0], readers.read(self.path("x.vdb"))[0]))

    def test_from_a_pipe(self):
        """Of one triangle, of blocks, and of so many that the memory grows twice."""
        for count, (form, pack) in itertools.product((1, 4096, 4097, 65536, 65537, 163843),
                                                     (("f32", meshes.pack_floats), ("stl", meshes.stl_binary))):
            packed = pack(np.concatenate([np.resize(LATTICE, (count - 1, 3, 3)), [((-3, -3, -3), (9, 9, 9), (2, 8, 5))]]))
            words = ("-r", "20", "--out-format", "raw")
            self.assertEqual(self.out("voxelize", "-", "--format", form, *words, stdin=packed),
                             self.out("voxelize", self.write("m." + form, packed), *words))
        gigantic = bytes(80) + struct.pack("<I", 2 ** 32 - 1) + bytes(500)
        for content in (gigantic, packed[:-1]):
            self.fail_with(1, r"stdin: truncated: \d+ of \d+ promised", "voxelize", "-", "--format", "stl", "-r", "9", "-o",
                           self.path("x.raw"), stdin=content)
        limit = self.need_limit(resource.RLIMIT_AS, 64 * MIB)
        self.fail_with(1, r"stdin: after \d+ triangles the next take [\d.]+ MiB of memory and [\d.]+ MiB are available; "
                       "save the mesh as a file, which takes less", "voxelize", "-", "--format", "f32", "-c", "1", "--axes", "box",
                       "-o", self.path("x.raw"), stdin=bytes(72 << 20), limit=limit)

    def test_whole_from_a_pipe(self):
        """What is read as a whole, of a few bytes and of more than are read at once, with another name than its own as well."""
        many, tenths = meshes.lattice_triangles(40000, seed=3), np.array(LATTICE) + 0.1
        for form, content in (("ply", meshes.ply_of(LATTICE)), ("ply", meshes.ply_of(LATTICE, "ascii")),
                              ("ply", meshes.ply_of(tenths, kind="double")), ("ply", meshes.ply_of(many)),
                              ("off", meshes.off(LATTICE)), ("obj", meshes.obj(LATTICE)), ("obj", meshes.obj(many))):
            path, other, pipe = self.write("m." + form, content), self.write("m.other", content), ("-", "--format", form)
            for words in (("-r", "20"), ("-r", "20", "--shift", "auto", "--ids")):
                whole = self.out("voxelize", path, *words)
                self.assertEqual(self.out("voxelize", *pipe, *words, stdin=content), whole, form)
                self.assertEqual(self.out("voxelize", other, *pipe[1:], *words), whole, form)
            self.assertEqual(self.overlap("-", harness.UNIT_BOX, *pipe[1:], stdin=content)["indices"],
                             self.overlap(path, harness.UNIT_BOX)["indices"])
            for folder, *mesh in (("a", path), ("b", *pipe)):
                self.succeed("partition", *mesh, "-r", "20", "-q", "-o", self.path(folder), stdin=content)
            self.assertEqual(read(self.path("a/triangles")), read(self.path("b/triangles")))
            shutil.rmtree(self.path("a"))
            shutil.rmtree(self.path("b"))
        words = ("voxelize", "-", "-r", "9", "-o", self.path("x.npz"), "--format")
        for form, content, why in (("ply", b"", "the file is empty"), ("ply", meshes.ply_of(LATTICE)[:-3], ".*the file ends"),
                                   ("obj", b"v 1 2 3\n", "contains no triangles"), ("off", b"solid", ""), ("ply", b"OFF", "")):
            self.fail_with(1, "stdin:(1:)? " + why, *words, form, stdin=content)
        self.fail_with(1, "stdin: its colours need the mesh as a file", *words, "ply", "--colours", stdin=meshes.ply_of(LATTICE))
        limit = self.need_limit(resource.RLIMIT_AS, 64 * MIB)
        self.fail_with(1, "stdin: out of memory after [0-9]+ bytes; save it as binary .stl, .f32 or .f64, which 'tribox voxelize' "
                       "and 'tribox partition' sort on the disk", *words, "obj", stdin=meshes.obj(LATTICE) * 50000, limit=limit)
        for form in ("ply", "off"):  # nothing more is read
            self.fail_with(1, "stdin: not an? .* file: it does not begin with '(?i:%s)'" % form, *words, form,
                           stdin=bytes(72 << 20), limit=limit)

    def test_nobody_takes_it(self):
        """A reader that has gone, a full disk, a terminal."""
        takes_none, gone = os.pipe()
        os.close(takes_none)
        words = ("voxelize", self.mesh, "-o", "-", "--out-format")
        for place, reason in ((gone, "Broken pipe"), (os.open("/dev/full", os.O_WRONLY), "No space left on device")):
            for word, size in itertools.product(harness.formats(), ("4", "100")):
                result = harness.run(*words, word, "-r", size, stdout=place)
                self.assertEqual(result.code, 1)
                self.assert_one_line(result.stderr, "^tribox voxelize: cannot write the output: " +
                                     (reason if word != "vdb" else ""))
            os.close(place)
        leader, follower = os.openpty()
        result = harness.run(*words, "raw", "-r", "9", stdout=follower)
        os.set_blocking(leader, False)
        self.assertRaises(BlockingIOError, os.read, leader, 1)
        self.assertEqual(result.code, 2)
        self.assert_one_line(result.stderr, "-o -: standard output is a terminal; send it to a program or a file")
        os.close(leader)
        os.close(follower)

    def test_names(self):
        """What a name is now is what it was, or the whole file: folders, links, devices, long names, other letters."""
        part, longest = self.path("part.npz"), os.pathconf(self.folder, "PC_NAME_MAX")
        self.succeed("voxelize", self.mesh, "-r", "9", "--shard", "1/1", "-q", "-o", part)
        os.mkdir(self.path("folder.npy"))
        os.symlink("/dev/full", self.path("full.npy"))
        os.symlink("nowhere.npy", self.path("dangling.npy"))
        rows = [("none/x.npy", "cannot write there: No such file"), ("mesh.f32/x.npy", "cannot write there: Not a directory"),
                ("folder.npy", "is a directory; give the name of a file"), ("full.npy", "is not a regular file"),
                ("dangling.npy", "cannot follow this link: No such file or directory"),
                ("x" * (longest - 3) + ".npy", "cannot write all of it: File name too long; nothing of it was kept")]
        if os.geteuid():
            os.mkdir(self.path("locked"), 0o555)
            rows.append(("locked/x.npy", "cannot write there: Permission denied"))
        for (name, why), command in itertools.product(rows, (("voxelize", self.mesh, "-r", "9"), ("merge", part))):
            self.fail_with(1, "%s: %s" % (name[-12:], why), *command, "-o", self.path(name))
        mask = os.umask(0)
        os.umask(mask)
        os.mkdir(self.path("né"))
        for name in ("x" * (longest - 11) + ".npy", "x" * (longest - 4) + ".npy", "né/Würfel ✓.npz", "a b.vti", "-.nrrd", "..npz"):
            self.succeed("voxelize", self.mesh, "-r", "9", "-q", "-o", self.path(name))
            self.assertEqual(os.stat(self.path(name)).st_mode & 0o777, 0o666 & ~mask)
        os.mkdir(self.path("elsewhere"))
        for ending, name in itertools.product((".npy", ".npz"), ("real", "elsewhere/real")):
            self.write(name + ending, "what was there")
            links = self.path("link" + ending), self.path("link_to_link" + ending)
            os.symlink(name + ending, links[0])
            os.symlink("link" + ending, links[1])
            there = self.there()
            self.succeed("voxelize", self.mesh, "-r", "4", "-q", "-o", links[1])
            self.assertEqual((self.there(), os.readlink(links[0]), max(readers.read(self.path(name + ending))[0].shape)),
                             (there, name + ending, 4))
            for link in links:
                os.unlink(link)

    def test_full_disk(self):
        """A limit on the size of files does what a full disk does: a write fails halfway, and an older file stays."""
        part = self.path("part.npz")
        self.succeed("voxelize", self.mesh, "-r", "90", "--shard", "1/1", "-q", "-o", part)
        self.succeed("partition", self.mesh, "-r", "90", "-q", "-o", self.path("tiles"))
        old = self.write("old", "what was there")
        for word, limit in itertools.product(harness.formats(), (0, 100, 2000)):
            for command in (("voxelize", self.mesh, "-r", "90"), ("merge", part)):
                self.fail_with(1, "old: " + TOO_LARGE, *command, "--out-format", word, "-o", old,
                               limit=(resource.RLIMIT_FSIZE, limit))
        for words in ((self.mesh, "-r", "90", "--shard", "1/1"), (self.path("tiles"),)):
            self.fail_with(1, TOO_LARGE, "voxelize", *words, "-o", self.path("x.npz"), limit=(resource.RLIMIT_FSIZE, 1000))
        for size in ("100,20000,100", "20000,100,100"):  # the cube is not written on where the disk is full
            self.fail_with(1, TOO_LARGE, "voxelize", self.mesh, *grid_of("1", "0,0,0", size), "-o", self.path("long.binvox"),
                           limit=(resource.RLIMIT_FSIZE, 20000))
        self.assertEqual(read(old), b"what was there")

    def test_layers(self):
        """The same bytes as to a pipe, which gets all layers at once; files of few cells take less place than they have bytes."""
        self.write("hole", b"")
        os.truncate(self.path("hole"), MIB)
        is_sparse = os.stat(self.path("hole")).st_blocks <= 64
        rows = [("npy", "0.03", "130,701,300", "125"), ("raw", "0.03", "130,701,300", "2"), ("vti", "0.03", "1000,120,160", "2")]
        rows += [(word, "0.05", size, "2") for word in ("npy", "nrrd", "vti", "raw")
                 for size in ("200,100,300", "4096,3,50", "8192,2,9", "8191,3,7", "64,64,2", "1,1,1")]
        for word, cell, size, threads in rows:
            for origin in ("-2.3,-2,-2.1",) if cell == "0.03" else ("-2,-2,-2", "-9,-9,-9", "50,50,50"):
                words = ("voxelize", self.mesh, *grid_of(cell, origin, size), "--out-format", word)
                piped = harness.run(*words, "-o", "-").octets
                for count in threads:
                    self.assertTrue(self.out(*words, "-t", count) == piped, (word, size, count))
                about = os.stat(self.path("out.npz"))
                if is_sparse and size == "200,100,300":
                    self.assertLess(512 * about.st_blocks, about.st_size / 2, (origin, word))
                if cell == "0.03":
                    self.fail_with(1, "x.npy: " + TOO_LARGE, *words, "-t", threads[-1], "-o", self.path("x.npy"),
                                   limit=(resource.RLIMIT_FSIZE, len(piped) // 2))

    def test_many(self):
        """More triangles than are handed out at a time, more bricks than wait, sizes around what is done at once."""
        pick = np.random.default_rng(SEED)
        small = pick.uniform(-2, 2, (36000, 1, 3)) + pick.uniform(-1 / 32, 1 / 32, (36000, 3, 3))
        side = 8.0 * 600
        square = [((0, 0, 0.5), (side, 0, 0.5), (side, side, 0.5)), ((0, 0, 0.5), (side, side, 0.5), (0, side, 0.5))]
        threads = ("1", "3", "7")
        borders = [(LATTICE, (*TILES[:-1], size), ("npz",), threads)
                   for size in ("64,512,512", "65,512,512", "129,127,136", "8,9,70", "1,1,1")]
        many = [(np.concatenate([small[:17000], LATTICE[:20], small[17000:]]) + e,
                 (*grid_of("0.00617", "-2,-2,-2", "700,650,500"), *more), ("npz",), threads)
                for e, more in ((0, ()), (1e-9, ("--accuracy", "conservative")), (0, ("--shard", "2/3")))]
        shared = [(np.array(meshes.lattice_triangles(500, 5)) + e, (*grid_of("0.0179", "-2,-2,-2", size), *more), ("raw",),
                   threads) for e, size, *more in (
            (0, "60,70,80"), (1e-9, "60,70,80", "--accuracy", "fast"), (0, "320,256,240"), (1e-9, "64,40,900"))]
        for t, words, formats, counts in (*borders, *many, *shared, (square, grid_of("1", "0,0,0", "4800,4800,3"), ("npz",), "12")):
            mesh = self.mesh_of(t if np.array(t).dtype == float and np.array(t).max() != side else np.array(t, float), "many")
            for word in formats:
                found = {self.out("voxelize", mesh, *words, "-t", count, "--out-format", word) for count in counts}
                self.assertEqual(len(found), 1, words)
        for kernel in harness.kernels():
            found.add(self.out("voxelize", mesh, *words, "--kernel", kernel, "--out-format", word))
        found.add(harness.run("voxelize", mesh, *words, "--out-format", "npz", "-o", "-").octets)
        self.assertEqual(len(found), 1)
        stored, tiles = readers.arrays(self.path("out.npz")), [range(first, min(first + 16, 600)) for first in range(0, 600, 16)]
        self.assertEqual(stored["at"].tolist(), [[i, j, 0] for js in tiles for is_ in tiles for j in js for i in is_])
        self.assertTrue((stored["bits"] == [2 ** 64 - 1] + [0] * 7).all())
        few = np.float32([((x, y, 0.1), (x + .02, y, 0), (x, y + .02, .02)) for n in range(140000) for x,
                          y in [(n % 400 / 64, n // 400 / 64)]])
        cells = [readers.read(self.voxelize(self.mesh_of(t, "few"), *grid_of("0.25", "0,0,0", "30,30,3"), "-t", "3")[0])[0]
                 for t in (few, few[:70000], few[70000:])]
        self.assertTrue(np.array_equal(cells[0], cells[1] | cells[2]) and (cells[1] > cells[2]).any()
                        and (cells[2] > cells[1]).any())


class Signals(Files):
    BIG = ("-r", "900", "-q", "-o")

    def end(self, number, times, said, *arguments, is_at_work=None):
        """Sends it once the program has begun to write; what was there is left, and a file without a name after SIGKILL."""
        there = self.there()
        process = harness.start(*arguments, preexec_fn=lambda: number != signal.SIGKILL and signal.signal(number, signal.SIG_DFL))
        self.wait_for(is_at_work or (lambda: self.there() != there), process)
        for _ in range(times):
            process.send_signal(number)
        error = process.communicate(timeout=60)[1].decode()
        self.assertEqual(process.returncode, -number)
        left = [name for name in self.there() if name not in there]
        if number == signal.SIGKILL:
            self.assertEqual(error, "")
            self.assertRegex(" ".join(map(os.path.basename, left)), r"\A\.tribox-\w{6}\Z")
        else:
            self.assertEqual(left, [])
            self.assert_one_line(error, said)

    def test_signals(self):
        """Once, or twice at once as programs with a limit of time do it, to the child and its group."""
        out, shard = self.write("big.npy", "what was there"), self.path("2.npz")
        again = "^tribox voxelize: interrupted: nothing was written; run "
        for number, times in ((signal.SIGHUP, 1), (signal.SIGTERM, 1), *[(signal.SIGTERM, 2)] * 10):
            self.end(number, times, again + "it again$", "voxelize", self.mesh, *self.BIG, out)
        self.end(signal.SIGKILL, 1, "", "voxelize", self.mesh, *self.BIG, out)
        self.assertEqual(read(out), b"what was there")
        many = self.write("many.f32", meshes.pack_floats(meshes.lattice_triangles(400, seed=2)))
        self.end(signal.SIGTERM, 1, again + "shard 2 of 3 again, parts that are there stay good", "voxelize", many,
                 *grid_of("0.001", "-2,-2,-2", "4000,4000,4000"), "-q", "--shard", "2/3", "-o", shard)

    def test_while_it_reads(self):
        """Before there is any file. What has been read of the pipe is more than it holds."""
        again = "nothing was written; run "
        for said, command, *words in ((again + "it again", "voxelize", "-o", self.path("x.npy")),
                                      (again + "shard 2 of 3 again, .*", "voxelize", "--shard", "2/3", "-o", self.path("x.npz")),
                                      ("the output is not whole; run it again", "voxelize", "--out-format", "npy", "-o", "-"),
                                      (again + "it again", "partition", "-o", self.path("tiles"))):
            process = harness.start(command, "-", "--format", "f32", "-r", "9", "-q", *words, stdin=subprocess.PIPE,
                                    preexec_fn=lambda: signal.signal(signal.SIGTERM, signal.SIG_DFL))
            process.stdin.write(bytes(36 << 15))
            process.send_signal(signal.SIGTERM)
            error = process.communicate(timeout=60)[1].decode()
            self.assertEqual(process.returncode, -signal.SIGTERM)
            self.assert_one_line(error, "^tribox %s: interrupted: %s$" % (command, said))

    def test_ignored(self):
        """As nohup has it, and a shell what it puts in the background: that ends nothing."""
        there, ends = self.there(), (signal.SIGHUP, signal.SIGINT)
        process = harness.start("voxelize", self.mesh, *self.BIG, self.path("x.npy"),
                                preexec_fn=lambda: [signal.signal(number, signal.SIG_IGN) for number in ends])
        self.wait_for(lambda: self.there() != there, process)
        for number in ends:
            process.send_signal(number)
        self.assertEqual((process.communicate(timeout=60)[1], process.returncode, self.there()),
                         (b"", 0, sorted([*there, self.path("x.npy")])))

    def test_at_any_moment(self):
        """Nothing stands under the name but the whole; after a signal that can be caught nothing is left beside it either."""
        pick, mesh = random.Random(SEED), self.mesh_of(meshes.lattice_triangles(60, 3), "some")
        faces, outs = self.write("some.obj", meshes.obj(meshes.lattice_triangles(3000, 3)) * 4), ("out", "out.obj", "rest.obj")
        remove = ["rm", "-rf", *map(self.path, outs)]
        for arguments in (("voxelize", mesh, *TILES, "-q", "-o", self.path("out")),
                          ("partition", mesh, *TILES, "-q", "-o", self.path("out")),
                          ("partition", mesh, "-r", "2000", "-m", "3000", "-q", "-o", self.path("out")),
                          ("voxelize", mesh, "-r", "700", "-m", "3000", "-q", "-o", self.path("out")),
                          ("voxelize", mesh, *TILES, "-q", "--shard", "1/1", "-o", self.path("out")),
                          ("overlap", faces, "--box", UNIT_BOX, "-o", self.path("out.obj"), "--rest", self.path("rest.obj"))):
            arguments += ("--out-format", "npz") * (arguments[0] == "voxelize")
            subprocess.run(remove, check=True)
            before, start = self.there(), time.monotonic()
            self.succeed(*arguments)
            taken, whole = time.monotonic() - start, {path: read(path) for path in self.there() if os.path.isfile(path)}
            for number in (signal.SIGKILL, signal.SIGTERM, signal.SIGINT) * 4:
                subprocess.run(remove, check=True)
                process = harness.start(*arguments)
                time.sleep(pick.uniform(0, 1.1 * taken))
                process.send_signal(number)
                said = process.communicate(timeout=60)[1].decode()
                self.assertIn(process.returncode, (0, -number))
                left = [path for path in self.there() if path not in before and ".tribox-" in path]
                if number != signal.SIGKILL:
                    self.assertEqual(left, [])
                    self.assertRegex(said, r"\A(tribox [a-z]+: interrupted: (nothing was|the faces are) written[^\n]*\n)?\Z")
                for path in [path for path in self.there() if path not in before + left and os.path.isfile(path)]:
                    self.assertEqual(read(path), whole[path])
                for path in left:  # runs lose their names while they are empty
                    folder, name = os.path.split(path)
                    if os.path.isfile(path) and name not in ("index", "triangles") and os.path.basename(folder).startswith("."):
                        self.assertEqual(os.path.getsize(path), 0)
                subprocess.run(["rm", "-rf", *[path for path in left if os.path.basename(path).startswith(".")]], check=True)

    def children(self, process):
        with open("/proc/%d/task/%d/children" % (process.pid, process.pid)) as file:
            return [int(word) for word in file.read().split()]

    def with_openvdb(self, is_at_work):
        """The program and its child that knows OpenVDB, which still loads it, or is at work and has the file that it writes."""
        process = harness.start("voxelize", self.mesh, "-r", "1500", "-q", "-o", self.path("big.vdb"))

        def has_child():
            try:
                found = self.children(process)
                return found and (not is_at_work or any(".tribox-" in os.readlink("/proc/%d/fd/%s" % (found[0], fd))
                                                        for fd in os.listdir("/proc/%d/fd" % found[0])))
            except OSError:
                return False
        self.wait_for(has_child, process)
        return process, self.children(process)[0]

    def test_openvdb(self):
        """The child is killed, by the system where memory is short, say; or the program is told to end, and takes it along."""
        self.need("OpenVDB")
        there = self.there()
        for is_at_work, number, is_child in itertools.product((False, True), (signal.SIGKILL, signal.SIGTERM), (True, False)):
            if (number == signal.SIGKILL) != is_child:
                continue
            process, child = self.with_openvdb(is_at_work)
            os.kill(child if is_child else process.pid, number)
            error = process.communicate(timeout=60)[1].decode()
            self.assertEqual((process.returncode, self.there()), (1 if is_child else -number, there))
            self.assert_one_line(error, r"big\.vdb: OpenVDB failed: it broke off, most likely for lack of memory; write \.npz$"
                                 if is_child else "^tribox voxelize: interrupted: nothing was written; run it again$")
            self.wait_for(lambda: not os.path.exists("/proc/%d" % child) or b") Z" in read("/proc/%d/stat" % child))
            self.assertTrue(not os.path.exists("/proc/%d" % child) or b") Z" in read("/proc/%d/stat" % child))

    def test_openvdb_missing(self):
        """The program that knows OpenVDB is not there, or a library that it needs."""
        self.need("OpenVDB")
        with tempfile.TemporaryDirectory() as place:
            alone, its = os.path.join(place, "tribox"), os.path.join(place, "tribox-vdb")
            shutil.copy(harness.program(), alone)
            environment = {**os.environ, "LD_LIBRARY_PATH": os.path.join(os.path.dirname(harness.program()), "..", "src")}
            for lines, reason in (("", r"cannot start \S+/tribox-vdb, which writes \.vdb: No such file or directory"),
                                  ("echo no libopenvdb.so >&2; exit 127", r"cannot load what writes \.vdb: no libopenvdb\.so"),
                                  ("exit 3", "OpenVDB failed: it broke off, most likely for lack of memory")):
                if lines:
                    with open(its, "w") as file:
                        file.write("#!/bin/sh\n" + lines + "\n")
                    os.chmod(its, 0o755)
                done = subprocess.run([alone, "voxelize", self.mesh, "-r", "40", "-o", self.path("x.vdb")], env=environment,
                                      capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stdout), (1, ""))
                self.assert_one_line(done.stderr, r"x\.vdb: " + reason + r"; write \.npz$")


class Memory(Files):
    def test_refused_before_it_is_taken(self):
        limit = self.need_limit(resource.RLIMIT_AS, 1 << 30)
        self.fail_with(1, r"^tribox voxelize: 4000 x 4000 x 4000 cells take 7\.5 GiB of memory here and [\d.]+ MiB are available: "
                       r"choose fewer cells, or write "
                       "bricks, -o FILE.npz or .vdb$", "voxelize", self.mesh, "-c", "0.001", "--size", "4000,4000,4000", "-o",
                       self.path("x.raw"), limit=limit)
        self.out("voxelize", self.mesh, "-c", "0.001", "--size", "4000,400,4000", limit=limit)
        self.fail_with(1, r"^tribox voxelize: the table of tiles takes 128 MiB of memory and [\d.]+ MiB are available$", "voxelize",
                       self.mesh, "-c", "0.001", "--size", "32768,32768,32768", "--count",
                       limit=self.need_limit(resource.RLIMIT_AS, 96 * MIB))

    @harness.unless_sanitized
    def test_little(self):
        """Limits from little more than the program takes to enough for all: the file, or a line; eight threads do what one can."""
        least, wholes, mesh = 4 * MIB, set(), self.write("mesh.ply", meshes.ply_of(LATTICE))
        while harness.run("info", limit=(resource.RLIMIT_AS, least)).code:
            least += MIB
        self.succeed("partition", mesh, "-r", "300", "-q", "-o", self.path("tiles"))

        def within(limit, out, *words, pattern="memory"):
            there, result = self.there(), harness.run("voxelize", *words, "-q", "-o", self.path(out),
                                                      limit=(resource.RLIMIT_AS, limit))
            if result.code:
                self.assertEqual((result.code, self.there()), (1, there), (limit, result.stderr))
                self.assert_one_line(result.stderr, pattern)
                return None
            self.assertEqual(result.stderr, "")
            written = read(self.path(out))
            os.remove(self.path(out))
            return written
        grid = (mesh, "-r", "300")
        raw = self.write("mesh.f32", meshes.pack_floats(LATTICE))
        for out, *words in (("x.npz", *grid), ("x.npz", raw, "-r", "300"), ("x.npz", self.path("tiles")),
                            ("x.npz", *grid, "--shard", "1/2"), ("x.raw", *grid), ("x.raw", *grid, "--fill", "outside")):
            whole = within(1 << 40, out, *words)
            for limit in range(least, least + 72 * MIB, 6 * MIB):
                alone = within(limit, out, *words, "-t", "1")
                if alone:
                    self.assertTrue(alone == whole == within(limit + MIB, out, *words, "-t", "8"), (words, limit))
                else:
                    within(limit, out, *words, "-t", "8")
        if not harness.lacks("OpenVDB"):  # which starts threads and may end the process that it is in
            for limit in [1 << 40, *range(least, least + 144 * MIB, 9 * MIB)]:
                written = within(limit, "x.vdb", mesh, "-r", "100", "-t", "2",
                                 pattern=r"memory|x\.vdb: .*(failed|cannot).*; write \.npz$")
                wholes |= {readers.without_vdb_id(written)} if written else set()
            self.assertEqual(len(wholes), 1)


class Progress(Files):
    def test_bars(self):
        """None for short work or where it is not wanted; of tiles it says how many are done, and how many in a second."""
        bar = r"\A(\r(%s) \[#*\.*\] +\d+ %%  %s[^\r\n]* left *)+\r +\r\Z"
        for words, pattern in ((("-r", "8", "-o", self.path("x.npy")), None), (("-r", "700", "-q", "-o", self.path("x.npy")), None),
                               (("-r", "700", "-o", self.path("x.npy")), bar % ("voxelizing|writing", "")),
                               (("-r", "2500", "--count", "-t", "1"),
                                bar % ("voxelizing", r"[\d.]+k? of [\d.]+k? tiles, [\d.]+k?/s, "))):
            said = self.on_terminal("voxelize", self.mesh, *words)
            if said or not pattern:  # the work has taken long enough
                self.assertRegex(said, pattern or r"\A\Z")
                self.assertLessEqual(max(map(len, said.split("\r"))), 85)

    def test_reading(self):
        """What is read at once would show nothing, so the program is made to rest on the way."""
        def rest(seconds):
            def wait(process):
                for number, duration in ((signal.SIGSTOP, seconds), (signal.SIGCONT, 1)):
                    time.sleep(duration)
                    process.send_signal(number)
            return wait
        some = meshes.lattice_triangles(3000, seed=3)
        for name, content in (("long.obj", meshes.obj(some) * 100), ("long.f32", meshes.pack_floats(some) * 300)):
            mesh, shown = self.write(name, content), ""
            for seconds in (0.02, 0.05, 0.01, 0.03, 0.1, 0.2, 0.4):
                shown = self.on_terminal("overlap", mesh, "--box", UNIT_BOX, "-t", "1", "--shift", "0,0,0", meanwhile=rest(seconds))
                if "reading" in shown:
                    break
            self.assertRegex(shown, r"\A(\rreading \[#*\.*\] +\d+ %  [^\r\n]*)+\r +\r")
            for words in (("voxelize", mesh, "-r", "8", "-o", self.path("x.npy")),
                          ("overlap", mesh, "--box", UNIT_BOX, "--shift", "0,0,0")):
                self.assertEqual(self.on_terminal(*words, "-t", "1", "-q", meanwhile=rest(seconds)), "")


if __name__ == "__main__":
    harness.main()
