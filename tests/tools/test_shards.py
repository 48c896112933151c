"""tribox voxelize --shard and tribox merge: the parts are the whole, bit for bit, however they were started."""

import json
import os
import shutil
import struct
import subprocess

import meshes
import support
import volumes

SIZE = (390, 270, 140)  # 4 x 3 x 2 tiles, the last of each axis cut
GRID = ("--cell", "0.0101,0.0145,0.029", "--origin", "-2,-2,-2", "--size", "%d,%d,%d" % SIZE)
HEADER, BRICK, END = 176, 80, 24


class Shards(support.TestCase):
    def setUp(self):
        super().setUp()
        self.mesh = self.write("mesh.ply", meshes.ply_binary(meshes.lattice_triangles(12, seed=6)))
        self.occupied = json.loads(self.succeed("voxelize", self.mesh, *GRID, "--json", "-o", self.path("whole.raw")))["occupied"]
        self.whole = volumes.read(self.path("whole.raw"))

    def path(self, name):
        return os.path.join(self.folder, name)

    def part(self, shard, shards, *options, mesh=None, name="p", grid=GRID):
        path = self.path("%s%d.part" % (name, shard))
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
        self.check_merge([self.path("p%d.part" % n) for n in range(shards, 0, -1)])

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
        self.refuse("p2.part and .*p2.part are both shard 2 of 3; give each once", *parts, parts[1])
        self.refuse("they differ in the number of shards", *parts[:2], self.part(3, 4, name="q")[0])
        self.refuse("they differ in the grid", *parts[:2], self.part(3, 3, name="q", grid=("--cell", "0.3"))[0])
        self.refuse("they differ in the accuracy", *parts[:2], self.part(3, 3, "--accuracy", "fast", name="q")[0])
        self.refuse("they differ in the choice of axes", *parts[:2], self.part(3, 3, "--axes", "box", name="q")[0])
        other = self.write("other.ply", meshes.ply_binary(meshes.lattice_triangles(60, seed=7)))
        self.refuse("they differ in the mesh", *parts[:2], self.part(3, 3, mesh=other, name="q")[0])

    def test_damaged_parts(self):
        first, second = self.parts(2)
        self.refuse("missing.part: cannot open the part: No such file", first, self.path("missing.part"))
        self.refuse("mesh.ply: not a part file", first, self.mesh)
        self.refuse("not a regular file", self.folder)
        data = volumes.read(second)
        for bytes_left in (0, 10, HEADER - 1):
            self.refuse("short.part: not a part file, or only the beginning", first, self.write("short.part", data[:bytes_left]))
        self.refuse("short.part: damaged: it ends early; run shard 2 of 2 again", first, self.write("short.part", data[:HEADER + 3]))
        for damaged in (data[:-1], data[:HEADER + END], data + b"\0", data[:HEADER] + data[HEADER + BRICK:]):
            self.refuse(r"long.part: damaged: it has %d bytes, which do not fit its number of bricks; run shard 2 of 2" % len(damaged),
                        first, self.write("long.part", damaged))
        self.refuse("damaged: its header makes no sense; run that shard again", first,
                    self.write("bad.part", data[:20] + b"\7\0\0\0" + data[24:]))
        self.refuse("another byte order", first, self.write("big.part", data[:16] + data[19:15:-1] + data[20:]))

    def sealed(self, data):
        """With the checksum that the manual describes: FNV-1a with words in place of bytes, of all that stands before it."""
        total = 0xcbf29ce484222325
        for word, in struct.iter_unpack("=Q", data[:-8]):
            total = (total ^ word) * 0x100000001b3 % 2**64
            total ^= total >> 32
        return data[:-8] + struct.pack("=Q", total)

    def test_flipped_bits(self):
        """A bit of every byte of the header and the end, and of bytes all over the bricks: no change goes unnoticed."""
        data = volumes.read(self.part(1, 1)[0])
        self.assertEqual(data, self.sealed(data))
        self.assertGreater(len(data), 20 * BRICK)
        for at in [*range(0, HEADER, 3), *range(HEADER, len(data) - END, len(data) // 40), *range(len(data) - END, len(data))]:
            flipped = bytearray(data)
            flipped[at] ^= 1 << at % 8
            self.refuse("flipped.part: (damaged|not a part file|written on a machine of another byte order)|missing|ends before",
                        self.write("flipped.part", bytes(flipped)))

    def stray(self, pattern, data, at, brick):
        """Puts a brick in place of number `at`, under a checksum that fits."""
        start = HEADER + BRICK * at
        self.refuse(pattern + "; run shard 1 of 1 again",
                    self.write("stray.part", self.sealed(data[:start] + struct.pack("=4I8Q", *brick) + data[start + BRICK:])))

    def test_bricks_where_none_may_be(self):
        """The grid has 390 cells along x, so that two of the eight of a last brick are not used; 270 along y, 140 along z."""
        data = volumes.read(self.part(1, 1)[0])
        bricks = (len(data) - HEADER - END) // BRICK
        last = struct.unpack_from("=3I", data, len(data) - END - BRICK)
        for at, bits in (((48, 0, 0), [0x40] + [0] * 7), ((0, 33, 0), [1 << 48] + [0] * 7), ((0, 0, 17), [0] * 4 + [1] * 4)):
            self.stray("stray.part: damaged: it has cells outside the grid", data, 0, (*at, 1, *bits))
        self.stray("damaged: it has bricks outside its tiles", data, 0, (49, 0, 0, 1, *[1] * 8))
        self.stray("damaged: its bricks are out of order", data, bricks - 1, (0, 0, 0, 1, *[1] * 8))
        self.stray("damaged: its bricks are out of order", data, bricks - 2, (*last, 1, *[1] * 8))
        self.stray("damaged: its cells are not as many as it says", data, bricks - 1, (*last, 0, *[1] * 8))

    def test_other_borders(self):
        """A part that begins where the one before it does not end, all else alike."""
        first, second = self.parts(2)
        data = bytearray(volumes.read(second))
        struct.pack_into("=Q", data, HEADER - 16, struct.unpack_from("=Q", data, HEADER - 16)[0] + 1)
        self.refuse(r"cut.part begins with tile \d+ in place of \d+: it was cut otherwise than the others; run shard 2 of 2 again",
                    first, self.write("cut.part", self.sealed(bytes(data))))
        data = bytearray(volumes.read(second))
        struct.pack_into("=Q", data, HEADER - 8, 23)
        self.refuse("cut.part ends before the last tile", first, self.write("cut.part", self.sealed(bytes(data))))

    def test_another_version(self):
        data = bytearray(volumes.read(self.part(1, 1)[0]))
        data[12:13] = b"1"
        self.refuse("old.part: damaged, or written by another version of tribox; run that shard again",
                    self.write("old.part", self.sealed(bytes(data))))

    def test_gnu_parallel(self):
        parallel = shutil.which("parallel")
        if not parallel or "GNU" not in subprocess.run([parallel, "--version"], capture_output=True).stdout.decode():
            self.skipTest("no GNU parallel")
        subprocess.run([parallel, "--will-cite", "-j", "2", support.program(), "voxelize", self.mesh, *GRID, "--quiet",
                        "--shard", "{}/7", "-o", self.path("gnu.{}.part"), ":::", *map(str, range(1, 8))], check=True, timeout=100,
                       stdin=subprocess.DEVNULL)
        self.check_merge([self.path("gnu.%d.part" % n) for n in range(1, 8)])

    def test_mpirun(self):
        """As documented: a shell per process, which counts from 0."""
        if not shutil.which("mpirun"):
            self.skipTest("no mpirun")
        root = ["--allow-run-as-root"] if os.geteuid() == 0 else []
        script = 'i=$((OMPI_COMM_WORLD_RANK + 1)); exec "$0" voxelize "$@" --shard "$i/$OMPI_COMM_WORLD_SIZE" -o "%s.$i.part"'
        done = subprocess.run(["mpirun", *root, "--oversubscribe", "-n", "3", "sh", "-c", script % self.path("mpi"),
                               support.program(), self.mesh, *GRID, "--quiet", "--threads", "1"], capture_output=True, timeout=100)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.check_merge([self.path("mpi.%d.part" % n) for n in range(1, 4)])


if __name__ == "__main__":
    support.main()
