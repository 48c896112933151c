"""tribox voxelize --shard and tribox merge: the parts are the whole, bit for bit, however they were started."""

import json
import os
import shutil
import struct
import subprocess

import meshes
import support
import volumes

GRID = ("--cell", "0.3,0.4,0.35", "--origin", "-2,-2,-2", "--size", "70,10,12")


class Shards(support.TestCase):
    def setUp(self):
        super().setUp()
        self.mesh = self.write("mesh.ply", meshes.ply_binary(meshes.lattice_triangles(60, seed=6)))
        self.succeed("voxelize", self.mesh, *GRID, "--quiet", "-o", self.path("whole.raw"))
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
        self.assertEqual((found["parts"], found["grid"]["size"]), (len(parts), [70, 10, 12]))
        self.assertEqual(found["occupied"], len(volumes.read_raw(self.path("whole.raw"), (70, 10, 12))[1]))

    def test_any_number(self):
        for shards in (1, 2, 3, 4, 5, 6, 7, 12, 13, 30):
            found = [self.part(shard, shards)[1] for shard in range(1, shards + 1)]
            layers = [f["layers"] for f in found]
            self.assertEqual(sum(layers), 12)
            self.assertLessEqual(max(layers) - min(layers), 1)
            self.assertEqual([f["first_layer"] for f in found], [sum(layers[:n]) for n in range(shards)])
            self.check_merge([self.path("p%d.part" % n) for n in range(shards, 0, -1)])

    def test_every_format(self):
        parts = self.parts(5)
        cube = self.parts(3, name="c", grid=("--resolution", "20"))
        for ending in ("npy", "vox", "binvox"):
            grid, joined = (("--resolution", "20"), cube) if ending == "binvox" else (GRID, parts)
            self.succeed("voxelize", self.mesh, *grid, "--quiet", "-o", self.path("whole." + ending))
            self.merge(joined, "merged." + ending)
            self.assertEqual(volumes.read(self.path("merged." + ending)), volumes.read(self.path("whole." + ending)))

    def test_summary(self):
        text = self.succeed("merge", *self.parts(2), "-o", self.path("m.npy"))
        self.assertRegex(text, r"(?m)^parts        2\ngrid         70 x 10 x 12 cells of .*\noccupied     \d+ cells\nwritten  ")
        self.assertEqual(self.succeed("merge", *self.parts(2), "-o", self.path("m.npy"), "--quiet"), "")

    def refuse(self, pattern, *parts):
        self.fail_with(1, pattern, "merge", *parts, "-o", self.path("refused.npy"))
        self.assertFalse([name for name in os.listdir(self.folder) if "refused" in name])

    def test_parts_that_do_not_fit(self):
        parts = self.parts(3)
        self.refuse("shard 3 of 3 is missing", *parts[:2])
        self.refuse("shard 1 of 3 is missing", *parts[1:])
        self.refuse("shard 2 of 3 is missing", parts[0], parts[2])
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
        for bytes_left in (0, 10, 151):
            self.refuse("short.part: not a part file, or only the beginning", first, self.write("short.part", data[:bytes_left]))
        for damaged in (data[:-1], data[:152], data + b"\0"):
            self.refuse(r"long.part: damaged: it has %d bytes, shard 2 of 2 has %d; run that shard again" % (len(damaged), len(data)),
                        first, self.write("long.part", damaged))
        self.refuse("damaged: its header makes no sense; run that shard again", first,
                    self.write("bad.part", data[:20] + b"\7\0\0\0" + data[24:]))
        self.refuse("another byte order", first, self.write("big.part", data[:16] + data[19:15:-1] + data[20:]))

    def checksum(self, data):
        """As the manual says: FNV-1a with words in place of bytes, of all but the checksum itself."""
        total = 0xcbf29ce484222325
        for word, in struct.iter_unpack("=Q", data[:144] + data[152:]):
            total = (total ^ word) * 0x100000001b3 % 2**64
            total ^= total >> 32
        return struct.pack("=Q", total)

    def test_flipped_bits(self):
        """A bit of every byte of the header, and of bytes all over the words: no change goes unnoticed."""
        data = volumes.read(self.part(2, 6)[0])
        self.assertEqual(data[144:152], self.checksum(data))
        self.assertGreater(len(data), 152 + 2 * 10 * 16 - 1)
        for at in list(range(152)) + list(range(152, len(data), 7)):
            flipped = bytearray(data)
            flipped[at] ^= 1 << at % 8
            self.refuse("flipped.part: (damaged|not a part file|written on a machine of another byte order)",
                        self.write("flipped.part", bytes(flipped)))

    def test_cells_outside_the_grid(self):
        """With a checksum that fits. The grid has 70 cells along x, so that 58 bits of a row are not used."""
        data = volumes.read(self.part(1, 1)[0])
        for at in (152 + 8, 152 + 15, len(data) - 1):
            stray = bytearray(data)
            stray[at] |= 0x80
            stray[144:152] = self.checksum(bytes(stray))
            self.refuse("stray.part: damaged: it has cells outside the grid; run shard 1 of 1 again",
                        self.write("stray.part", bytes(stray)))

    def test_another_version(self):
        data = bytearray(volumes.read(self.part(1, 1)[0]))
        data[12:13] = b"1"
        data[144:152] = self.checksum(bytes(data))
        self.refuse("old.part: damaged, or written by another version of tribox; run that shard again",
                    self.write("old.part", bytes(data)))

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

    def test_slurm_array(self):
        """The line of an array job, with the variables that Slurm sets."""
        for task in range(1, 5):
            subprocess.run(["sh", "-c", '"$0" voxelize "$@" --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" '
                            '-o "%s.$SLURM_ARRAY_TASK_ID.part"' % self.path("array"), support.program(), self.mesh, *GRID, "--quiet"],
                           env={**os.environ, "SLURM_ARRAY_TASK_ID": str(task), "SLURM_ARRAY_TASK_COUNT": "4"}, check=True)
        self.check_merge([self.path("array.%d.part" % n) for n in range(1, 5)])


if __name__ == "__main__":
    support.main()
