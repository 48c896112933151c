"""tribox voxelize --shard and tribox merge: the parts are the whole, bit for bit, however they were started."""

import json
import os
import re
import shutil
import struct
import subprocess
import zipfile

import meshes
import support
import volumes

SIZE = (390, 270, 140)  # 4 x 3 x 2 tiles, the last of each axis cut
GRID = ("--cell", "0.0101,0.0145,0.029", "--origin", "-2,-2,-2", "--size", "%d,%d,%d" % SIZE)


class Shards(support.TestCase):
    def setUp(self):
        super().setUp()
        self.mesh = self.write("mesh.ply", meshes.ply_binary(meshes.lattice_triangles(12, seed=6)))
        self.occupied = json.loads(self.succeed("voxelize", self.mesh, *GRID, "--json", "-o", self.path("whole.raw")))["occupied"]
        self.whole = volumes.read(self.path("whole.raw"))

    def path(self, name):
        return os.path.join(self.folder, name)

    def part(self, shard, shards, *options, mesh=None, name="p", grid=GRID):
        path = self.path("%s%d.npz" % (name, shard))
        found = json.loads(self.succeed("voxelize", mesh or self.mesh, *grid, "--shard", "%d/%d" % (shard, shards), "--json",
                                        "-o", path, *options))
        self.assertEqual((found["shard"], found["shards"]), (shard, shards))
        return path, found

    def parts(self, shards, *options, **how):
        return [self.part(shard, shards, *options, **how)[0] for shard in range(1, shards + 1)]

    def merge(self, parts, name):
        return json.loads(self.succeed("merge", *parts, "-o", self.path(name), "--json"))

    def check_merge(self, parts):
        found = self.merge(parts, "merged.raw")
        self.assertEqual(volumes.read(self.path("merged.raw")), self.whole)
        self.assertEqual((found["parts"], found["grid"]["size"]), (len(parts), list(SIZE)))
        self.assertEqual(found["occupied"], self.occupied)

    def check_shards(self, shards, *options, **how):
        found = [self.part(shard, shards, *options, **how)[1] for shard in range(1, shards + 1)]
        tiles = [f["tiles"] for f in found]
        self.assertEqual(sum(tiles), 4 * 3 * 2)
        self.assertEqual([f["first_tile"] for f in found], [sum(tiles[:n]) for n in range(shards)])
        self.check_merge([self.path("p%d.npz" % n) for n in range(shards, 0, -1)])

    def test_other_accuracies(self):
        """A triangle whose rounded cells reach into a tile that it does not touch itself."""
        corners = ((float.fromhex("0x1.fffffep-38"), float.fromhex("0x1.000002p+8"), .5),
                   (float.fromhex("0x1.fffffcp+7"), 0, .5), (1, 1, .5))
        mesh = self.write("long.ply", meshes.ply_binary([corners]))
        grid = ("--cell", "1", "--origin", "0,0,0", "--size", "384,384,8")
        for accuracy in ("conservative", "fast"):
            options = ("--accuracy", accuracy)
            whole = json.loads(self.succeed("voxelize", mesh, *grid, *options, "--json", "-o", self.path("one.npz")))
            merged = self.merge(self.parts(2, *options, mesh=mesh, grid=grid), "two.npz")
            self.assertEqual((merged["occupied"], merged["bricks"]), (whole["occupied"], whole["bricks"]))
            self.assertEqual(volumes.read(self.path("two.npz")), volumes.read(self.path("one.npz")))

    def test_any_number(self):
        for shards in (1, 2, 3, 7, 64):
            self.check_shards(shards, "--threads", str(1 + shards % 3))

    def test_partition(self):
        """The shards of a partition are those of the mesh, byte for byte, and so is the file that they become."""
        folder = self.path("tiles")
        found = json.loads(self.succeed("partition", self.mesh, *GRID, "--json", "-o", folder))
        self.assertEqual((found["grid"]["size"], found["tile"], found["tiles"]), (list(SIZE), 128, 24))
        for shards in (1, 2, 7, 64):
            self.check_shards(shards, mesh=folder, grid=())
        for shard in range(1, 8):
            of_mesh, of_tiles = (self.part(shard, 7, mesh=mesh, grid=grid, name=name)[0]
                                 for mesh, grid, name in ((self.mesh, GRID, "m"), (folder, (), "t")))
            self.assertEqual(volumes.read(of_mesh), volumes.read(of_tiles))

    def test_sparse_whole(self):
        """Merged bricks are those of one run, in its order."""
        self.succeed("voxelize", self.mesh, *GRID, "--quiet", "-o", self.path("whole.npz"))
        parts = self.parts(5)
        for threads in "127":
            self.succeed("merge", *parts, "--threads", threads, "--quiet", "-o", self.path("merged.npz"))
            self.assertEqual(volumes.read(self.path("merged.npz")), volumes.read(self.path("whole.npz")))

    def test_doubles(self):
        """Meshes and grids of doubles, and floats in a grid of doubles."""
        wide = self.write("wide.f64", struct.pack("<18d", *(0.1 * n * n % 3 + 1e9 / 7 for n in range(18))))
        for name, mesh, grid in (("wide", wide, ("--resolution", "300")), ("fine", self.mesh, ("--cell", "0.01234567890123"))):
            self.succeed("voxelize", mesh, *grid, "--quiet", "-o", self.path("whole.raw"))
            folder = self.path(name)
            self.succeed("partition", mesh, *grid, "--quiet", "-o", folder)
            for parts in (self.parts(3, mesh=mesh, grid=grid), self.parts(4, mesh=folder, grid=(), name="t")):
                self.merge(parts, "merged.raw")
                self.assertEqual(volumes.read(self.path("merged.raw")), volumes.read(self.path("whole.raw")), name)

    def test_every_format(self):
        cube = ("--resolution", "150")
        few = ("--cell", "0.3,0.4,0.35", "--origin", "-2,-2,-2", "--size", "70,10,12")
        for ending, grid in (("npy", GRID), ("vox", few), ("binvox", cube), ("npz", GRID)):
            joined = self.parts(3, name="c", grid=grid)
            self.succeed("voxelize", self.mesh, *grid, "--quiet", "-o", self.path("whole." + ending))
            self.merge(joined, "merged." + ending)
            self.assertEqual(volumes.read(self.path("merged." + ending)), volumes.read(self.path("whole." + ending)))

    def test_summary(self):
        text = self.succeed("merge", *self.parts(2), "-o", self.path("m.npy"))
        self.assertRegex(text, r"(?m)^parts        2\ngrid         390 x 270 x 140 cells of .*\noccupied     \d+ cells\nbricks       \d+\nwritten  ")
        self.assertEqual(self.succeed("merge", *self.parts(2), "-o", self.path("m.npy"), "--quiet"), "")

    def refuse(self, pattern, *parts):
        self.fail_with(1, pattern, "merge", *parts, "-o", self.path("refused.npz"))
        self.assertFalse([name for name in os.listdir(self.folder) if "refused" in name])

    def test_parts_that_do_not_fit(self):
        parts = self.parts(3)
        self.refuse("shard 3 of 3 is missing", *parts[:2])
        self.refuse("shard 1 of 3 is missing", *parts[1:])
        self.refuse("shard 2 of 3 is missing", parts[0], parts[2])
        self.refuse("shards 1,3-4,6-9 of 9 are missing; run them, or give their parts too",
                    *(self.part(n, 9, name="n")[0] for n in (2, 5)))
        self.refuse("p2.npz and .*p2.npz are both shard 2 of 3; give each once", *parts, parts[1])
        self.refuse("they differ in the number of shards", *parts[:2], self.part(3, 4, name="q")[0])
        self.refuse("they differ in the grid", *parts[:2], self.part(3, 3, name="q", grid=("--cell", "0.3"))[0])
        self.refuse("they differ in the accuracy", *parts[:2], self.part(3, 3, "--accuracy", "fast", name="q")[0])
        self.refuse("they differ in the choice of axes", *parts[:2], self.part(3, 3, "--axes", "box", name="q")[0])
        other = self.write("other.ply", meshes.ply_binary(meshes.lattice_triangles(12, seed=7)))
        self.refuse("they differ in the mesh", *parts[:2], self.part(3, 3, mesh=other, name="q")[0])

    def rewritten(self, path, **arrays):
        """A part with other arrays, (shape, bytes) each, under checksums that fit, as NumPy would write it."""
        out = self.path("rewritten.npz")
        with zipfile.ZipFile(path) as file, zipfile.ZipFile(out, "w") as to:
            for name in file.namelist():
                header, content = file.read(name)[:128], file.read(name)[128:]
                if name[:-4] in arrays:
                    shape, content = arrays[name[:-4]]
                    header = re.sub(rb"'shape': .*\n", (b"'shape': %s, }" % str(shape).encode()), header).ljust(127) + b"\n"
                with to.open(name, "w", force_zip64=True) as member:  # as numpy.savez
                    member.write(header + content)
        return out

    def arrays(self, path):
        """Places and bits, a list each."""
        with zipfile.ZipFile(path) as file:
            at, bits = (file.read(name)[128:] for name in ("at.npy", "bits.npy"))
        return list(struct.iter_unpack("<3I", at)), list(struct.iter_unpack("<8Q", bits))

    def test_not_a_part(self):
        first, second = self.parts(2)
        self.refuse("missing.npz: cannot open the part: No such file", first, self.path("missing.npz"))
        self.refuse("not a regular file", self.folder)
        data = volumes.read(second)
        for name, content in (("mesh.ply", volumes.read(self.mesh)), ("none.npz", b""), ("old.part", b"tribox part 6\n".ljust(200)),
                              ("start.npz", data[:10]), ("cut.npz", data[:-1]), ("half.npz", data[:len(data) // 2]),
                              ("long.npz", data + b"\0"), ("later.npz", data[:500] + data[501:])):
            self.refuse(name + ": not a part, or only the beginning of one, or damaged", first, self.write(name, content))
        numbered = volumes.read(self.part(1, 1, "--ids")[0])
        for name, why in ((b"ids", "it has members that parts do not have"), (b"size", "or no part: it lacks size.npy")):
            renamed = self.write("renamed.npz", numbered.replace(name + b".npy", name + b".npx"))
            self.refuse("renamed.npz: damaged.*" + why, renamed)
        self.succeed("voxelize", self.mesh, *GRID, "--quiet", "-o", self.path("whole.npz"))
        self.refuse("whole.npz: is no part of a whole; give the files that tribox voxelize --shard", first, self.path("whole.npz"))

    def test_numpys_parts(self):
        """Written anew and deflated they are the same parts."""
        first, second = self.parts(2)
        self.check_merge([self.rewritten(second), first])
        self.check_merge([self.part(2, 2, "--deflate")[0], first])

    def test_large_deflated_part(self):
        """Which is read in several pieces."""
        grid = ("--resolution", "1200")
        path = self.part(1, 1, "--deflate", grid=grid)[0]
        with zipfile.ZipFile(path) as file:
            self.assertGreater(file.getinfo("bits.npy").compress_size, 3 << 16)
        self.succeed("voxelize", self.mesh, *grid, "--quiet", "-o", self.path("whole.npz"))
        self.merge([path], "merged.npz")
        self.assertEqual(volumes.read(self.path("merged.npz")), volumes.read(self.path("whole.npz")))

    def long(self, data):
        """The file with a list in which nothing fits 32 bits, as one of more than 4 GB has it."""
        start = at = data.index(b"PK\1\2")
        none, entries = 2**32 - 1, []
        while data[at:at + 4] == b"PK\1\2":
            stored, size, name = struct.unpack_from("<2IH", data, at + 20)
            place, = struct.unpack_from("<I", data, at + 42)
            entries.append(data[at:at + 20] + struct.pack("<2I2H", none, none, name, 28) + data[at + 32:at + 42]
                           + struct.pack("<I", none) + data[at + 46:at + 46 + name]
                           + struct.pack("<2H3Q", 1, 24, size, stored, place))
            at += 46 + name
        entries, count = b"".join(entries), len(entries)
        return (data[:start] + entries + struct.pack("<IQ2H2I4Q", 0x06064b50, 44, 45, 45, 0, 0, count, count, len(entries), start)
                + struct.pack("<2IQI", 0x07064b50, 0, start + len(entries), 1)
                + struct.pack("<I4H2IH", 0x06054b50, 0, 0, count, count, len(entries), none, 0))

    def test_long_parts(self):
        first, second = self.parts(2)
        path = self.write("long.npz", self.long(volumes.read(second)))
        with zipfile.ZipFile(path) as file:
            self.assertIsNone(file.testzip())
        self.check_merge([first, path])

    def test_flipped_bits(self):
        """A bit of bytes all over the file: no change gives another answer, and none but of dates and the like goes unnoticed."""
        whole = self.path("whole.npz")
        for options in ((), ("--ids", "--deflate")):
            data = volumes.read(self.part(1, 1, *options)[0])
            self.succeed("voxelize", self.mesh, *GRID, *options[:1], "--quiet", "-o", whole)
            end, refused = data.index(b"PK\1\2"), 0
            places = [*range(0, 200, 3), *range(200, end, end // 100), *range(end - 700, len(data), 7)]
            for at in places:
                flipped = bytearray(data)
                flipped[at] ^= 1 << at % 8
                result = support.run("merge", self.write("flipped.npz", bytes(flipped)), "-q", "-o", self.path("x.npz"))
                if result.code:
                    self.assertRegex(result.stderr, "^tribox merge: .*flipped.npz: (damaged|not a part|is no part)")
                    refused += 1
                else:
                    self.assertEqual(volumes.read(self.path("x.npz")), volumes.read(whole), at)
            self.assertGreater(refused, len(places) * 2 // 3)

    def test_bricks_where_none_may_be(self):
        """The grid has 390 cells along x, so that two of the eight of a last brick are not used; 270 along y, 140 along z."""
        path = self.part(1, 1)[0]
        places, bits = self.arrays(path)
        for why, n, at, words in (("cells outside the grid", 0, (48, 0, 0), [0x40] + [0] * 7),
                                  ("cells outside the grid", 0, (0, 33, 0), [1 << 48] + [0] * 7),
                                  ("cells outside the grid", 0, (0, 0, 17), [0] * 4 + [1] * 4),
                                  ("bricks outside its tiles", 0, (49, 0, 0), [1] * 8),
                                  ("bricks are out of order", -1, (0, 0, 0), [1] * 8),
                                  ("bricks are out of order", -2, places[-1], [1] * 8)):
            other_places, other_bits = list(places), list(bits)
            other_places[n], other_bits[n] = at, words
            count = len(bits)
            self.refuse("rewritten.npz: damaged: (it has|its) " + why + "; run shard 1 of 1 again",
                        self.rewritten(path, at=((count, 3), b"".join(struct.pack("<3I", *at) for at in other_places)),
                                       bits=((count, 8), b"".join(struct.pack("<8Q", *words) for words in other_bits))))

    def test_brick_of_another_part(self):
        first, second = self.parts(2)
        places, _ = self.arrays(second)
        strange = ((len(places), 3), b"".join(struct.pack("<3I", *at) for at in [(0, 0, 0), *places[1:]]))
        self.refuse("rewritten.npz: damaged: it has bricks outside its tiles; run shard 2 of 2", first,
                    self.rewritten(second, at=strange))

    def test_arrays_that_do_not_fit(self):
        path = self.part(1, 1, "--ids")[0]
        with zipfile.ZipFile(path) as file:
            arrays = {name[:-4]: file.read(name)[128:] for name in file.namelist()}
        bricks, ids, senseless = len(arrays["at"]) // 12, len(arrays["ids"]) // 4, "what it says of the whole makes no sense"
        for why, name, shape, content in (("its arrays do not fit its bricks", "at", (bricks - 1, 3), arrays["at"][:-12]),
                                          ("its arrays do not fit its bricks", "bits", (bricks, 7), arrays["bits"]),
                                          ("its arrays do not fit its bricks", "ids", (ids,), arrays["ids"][:-1]),
                                          ("its ids are not those of its cells", "ids", (ids - 1,), arrays["ids"][:-4]),
                                          ("its ids are not those of its cells", "ids", (ids + 1,), arrays["ids"] + bytes(4)),
                                          ("its size.npy is not what was written", "size", (2,), arrays["size"][:8]),
                                          (senseless, "shard", (2,), struct.pack("<2I", 0, 1)),
                                          (senseless, "shard", (2,), struct.pack("<2I", 2, 1)),
                                          (senseless, "tiles", (2,), struct.pack("<2Q", 1, 0)),
                                          (senseless, "shift", (3,), struct.pack("<3d", 0, float("nan"), 0)),
                                          (senseless, "cell", (3,), struct.pack("<3d", 0, 1, 1)),
                                          (senseless, "whole", (7,), arrays["whole"][:48] + bytes(8))):
            self.refuse("rewritten.npz: damaged: " + why, self.rewritten(path, **{name: (shape, content)}))

    def test_sizes_that_do_not_fit(self):
        """A member of more bytes than the file has, or than deflated ones can stand for."""
        for options in ((), ("--deflate",)):
            data = bytearray(volumes.read(self.part(1, 1, *options)[0]))
            struct.pack_into("<I", data, data.index(b"PK\1\2") + 24, 2**31)
            self.refuse("large.npz: not a part, or only the beginning of one, or damaged", self.write("large.npz", bytes(data)))

    def test_other_borders(self):
        """A part that begins where the one before it does not end, all else alike."""
        first, second = self.parts(2)
        with zipfile.ZipFile(second) as file:
            start, end = struct.unpack("<2Q", file.read("tiles.npy")[128:])
        self.refuse(r"rewritten.npz begins with tile \d+ in place of \d+: it was cut otherwise than the others; run shard 2 of 2",
                    first, self.rewritten(second, tiles=((2,), struct.pack("<2Q", start + 1, end))))
        self.refuse("rewritten.npz ends before the last tile", first,
                    self.rewritten(second, tiles=((2,), struct.pack("<2Q", start, end - 1))))

    def test_gnu_parallel(self):
        parallel = shutil.which("parallel")
        if not parallel or "GNU" not in subprocess.run([parallel, "--version"], capture_output=True).stdout.decode():
            self.skipTest("no GNU parallel")
        subprocess.run([parallel, "--will-cite", "-j", "2", support.program(), "voxelize", self.mesh, *GRID, "--quiet",
                        "--shard", "{}/7", "-o", self.path("gnu.{}.npz"), ":::", *map(str, range(1, 8))], check=True, timeout=100,
                       stdin=subprocess.DEVNULL)
        self.check_merge([self.path("gnu.%d.npz" % n) for n in range(1, 8)])

    def test_mpirun(self):
        """As documented: a shell per process, which counts from 0."""
        if not shutil.which("mpirun"):
            self.skipTest("no mpirun")
        root = ["--allow-run-as-root"] if os.geteuid() == 0 else []
        script = 'i=$((OMPI_COMM_WORLD_RANK + 1)); exec "$0" voxelize "$@" --shard "$i/$OMPI_COMM_WORLD_SIZE" -o "%s.$i.npz"'
        done = subprocess.run(["mpirun", *root, "--oversubscribe", "-n", "3", "sh", "-c", script % self.path("mpi"),
                               support.program(), self.mesh, *GRID, "--quiet", "--threads", "1"], capture_output=True, timeout=100)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.check_merge([self.path("mpi.%d.npz" % n) for n in range(1, 4)])


if __name__ == "__main__":
    support.main()
