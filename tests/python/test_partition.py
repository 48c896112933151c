"""tribox.partition and tribox.Partition: the bricks of the mesh, from a folder, whole or not at all."""

import os
import pickle
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
import tribox
from tribox._checksum import checksum, checksums
from tribox._partition import HEADER

import cases

FLOATS = (-2, -1.5, -1), (0.03125, 0.0625, 0.09375), (131, 50, 33)
DOUBLES = (-2.1, -1.5, -1), (0.03, 0.06, 0.09), (131, 50, 33)


class PartitionTests(cases.TestCase):
    def setUp(self):
        self.triangles = np.concatenate([cases.lattice(40) / 2, np.full((1, 3, 3), np.inf, np.float32), cases.scattered(60)])
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.count = 0

    def new(self, form, grid, **options):
        self.count += 1
        return tribox.partition(form, os.path.join(self.folder, str(self.count)), grid, **options)

    def variants(self):
        mesh = tribox.Mesh(*cases.shared_vertices(self.triangles, np.int32))
        for form in (self.triangles, mesh, tribox.Soup.of(self.triangles), np.asfortranarray(self.triangles)):
            yield form, FLOATS
            yield form, DOUBLES
        for form in (self.triangles.astype(float), tribox.Mesh(*cases.shared_vertices(self.triangles.astype(float), np.int32))):
            yield form, FLOATS

    def assert_equal(self, bricks, expected):
        self.assert_same(bricks.at, expected.at)
        self.assert_same(bricks.bits, expected.bits)

    def test_bricks(self):
        for form, grid in self.variants():
            for side in (8, 32):
                expected = tribox.bricks(form, grid, side=side)
                partition = self.new(form, grid, side=side)
                self.assertEqual((partition.grid, partition.side, partition.shift), (tribox.Grid(*grid), side, (0, 0, 0)))
                self.assertEqual(partition.tile_count, tribox.tile_count(grid[2], side))
                partition.check()
                self.assert_equal(partition.bricks(), expected)
                self.assert_equal(partition.bricks(threads=3), expected)
                for count in (1, 2, 7, 1000):
                    shares = partition.shares(count)
                    self.assertEqual(len(shares), count)
                    self.assertEqual([first for first, _ in shares] + [partition.tile_count],
                                     [0] + [first + number for first, number in shares])
                    work = [partition.work[(first <= partition.numbers) & (partition.numbers < first + number)].sum()
                            for first, number in shares]
                    self.assertLessEqual(max(work), partition.work.sum() / count + partition.work.max())
                    if count < 10:
                        parts = [partition.bricks(share) for share in shares]
                        self.assert_equal(cases.joined(parts), expected)

    def test_tiles(self):
        for form, grid in self.variants():
            whole, partition = np.array(tribox.voxelize(form, grid)), self.new(form, grid, side=32)
            for number in range(partition.tile_count):
                (i, j, k), (ni, nj, nk) = partition.window(number)
                cells = partition.voxelize(number)
                self.assert_same(cells, whole[k:k + nk, j:j + nj, i:i + ni])
                self.assertEqual((cells.grid, cells.window), (partition.grid, partition.window(number)))
                self.assert_same(partition.voxelize(np.int64(number)).words,
                                 tribox.voxelize(form, grid, window=partition.window(number)).words)
                self.assertEqual(number in partition.numbers, len(partition.triangles(number)) > 0)

    def test_triangles(self):
        """Those that overlap the tile, in the order of the mesh."""
        partition = self.new(self.triangles, FLOATS, side=32)
        for number in range(partition.tile_count):
            first, size = map(np.array, partition.window(number))
            lo, hi = (np.array(FLOATS[0]) + at * np.array(FLOATS[1]) for at in (first, first + size))
            self.assert_same(np.array(partition.triangles(number)), self.triangles[tribox.overlap(self.triangles, lo, hi)])

    def test_options(self):
        partition = self.new(self.triangles, FLOATS, side=32)
        self.assert_equal(partition.bricks(kernel="scalar"), partition.bricks())
        self.assertTrue((partition.voxelize(3, accuracy="conservative") >= partition.voxelize(3)).all())
        self.refuse(tribox.InputError, "BAD_OPTION", "axes = 8", partition.bricks, axes=8)
        self.refuse(tribox.InputError, None, r"^tiles = .*within the", partition.bricks, (0, 1 << 20))
        for wrong in (-1, partition.tile_count, 1.5, "1", None):
            for call in (partition.window, partition.triangles, partition.voxelize):
                self.refuse(tribox.InputError, None, "^number = .*; give that of a tile", call, wrong)

    def test_wrong_shares(self):
        partition = self.new(self.triangles, FLOATS, side=32)
        self.assertEqual(partition.shares(np.int64(3)), partition.shares(3))
        for wrong in (0, -3, 1 << 31, 10 ** 400, 2.5, "x", None, (1, 2)):
            self.refuse(tribox.InputError, None, "^count = .*; give how many shares to make", partition.shares, wrong)

    def test_nothing(self):
        for nothing in (self.triangles[:0], np.full((5, 3, 3), np.nan), self.triangles + np.float32(1e20)):
            partition = self.new(nothing, FLOATS)
            partition.check()
            self.assertEqual(len(partition.numbers), 0)
            self.assertEqual(len(partition.bricks().at), 0)
            self.assertEqual(sum(partition.shares(2)[1]), partition.tile_count)
            self.assertFalse(partition.voxelize(0).any())

    def program(self, *arguments, mesh=b""):
        """Runs the program in the folder."""
        subprocess.run([os.environ["TRIBOX_PROGRAM"], *arguments, "--quiet"], input=mesh, cwd=self.folder, capture_output=True,
                       timeout=120, check=True)

    @unittest.skipUnless("TRIBOX_PROGRAM" in os.environ, "built without the program")
    def test_by_program(self):
        """Its partitions are read, with a shift as well."""
        for triangles in (self.triangles, self.triangles.astype(float) + [0.1, 5e6, 0]):
            for shift in ((0, 0, 0), (1, 2, 0.5)):
                self.count += 1
                name, moved = f"by_program_{self.count}", (triangles - shift).astype(triangles.dtype)
                self.program("partition", "-", "--format", f"f{8 * triangles.itemsize}", "-r", "300", "-o", name, "--shift",
                             ",".join(map(str, shift)), mesh=triangles.tobytes())
                partition = tribox.Partition(os.path.join(self.folder, name))
                partition.check()
                self.assertEqual(partition.shift, shift)
                if triangles.dtype == float or not any(shift):
                    self.assertEqual(partition.grid, tribox.grid_around(moved, 300))
                    self.assert_equal(partition.bricks(), tribox.bricks(moved, partition.grid, side=partition.side))

    @unittest.skipUnless("TRIBOX_PROGRAM" in os.environ, "built without the program")
    def test_for_program(self):
        """The program voxelizes those of tribox.partition, whole and in shards."""
        for form, grid in self.variants():
            partition = self.new(form, grid, side=16)
            self.program("voxelize", partition.folder, "-o", "whole.npz")
            parts = [f"{shard}.part" for shard in (1, 2, 3)]
            for shard, part in enumerate(parts, 1):
                self.program("voxelize", partition.folder, "--shard", f"{shard}/3", "-o", part)
            self.program("merge", *parts, "-o", "merged.npz")
            for name in ("whole.npz", "merged.npz"):
                with np.load(os.path.join(self.folder, name)) as file:
                    self.assert_equal(tribox.Bricks(file["at"], file["bits"], partition.grid), partition.bricks())
                    self.assertEqual(tuple(file["size"]), grid[2])

    def assert_ids(self, bricks, expected):
        self.assert_equal(bricks, expected)
        self.assert_same(bricks.ids, expected.ids)

    def test_ids(self):
        """Those of the mesh, whole, by shares and by tiles; blocks and threads make no difference."""
        for form, grid in self.variants():
            expected = tribox.bricks(form, grid, side=16, ids=True)
            with mock.patch("tribox._partition.BLOCK", 50):
                partition = self.new(form, grid, side=16, ids=True)
            partition.check()
            self.assertTrue(partition.has_ids)
            self.assert_ids(partition.bricks(ids=True), expected)
            self.assert_ids(partition.bricks(ids=True, threads=3), expected)
            self.assert_same(np.concatenate([partition.bricks(share, ids=True).ids for share in partition.shares(7)]), expected.ids)
            for number in (0, *partition.numbers[::9].tolist()):
                self.assert_same(partition.voxelize(number, ids=True).ids,
                                 tribox.voxelize(form, grid, window=partition.window(number), ids=True).ids)
                self.assertEqual(len(partition.ids(number)), len(partition.triangles(number)))
            self.assert_equal(partition.bricks(), self.new(form, grid, side=16).bricks())
        plain = self.new(self.triangles, FLOATS)
        for call, arguments in ((plain.ids, (0,)), (plain.bricks, ()), (plain.voxelize, (0,))):
            self.refuse(tribox.InputError, None, "has no numbers of its triangles; make it with ids=True, or leave out ids",
                        call, *arguments, **({} if call == plain.ids else {"ids": True}))
        path = Path(partition.folder, "numbers")
        octets = path.read_bytes()
        path.write_bytes(octets[:-1] + bytes([octets[-1] ^ 1]))
        self.refuse(tribox.InputError, None, "the checksum of tile .* does not match", tribox.Partition(partition.folder).check)
        path.write_bytes(octets[:-4])
        self.refuse(tribox.InputError, None, "its numbers are not as many as its index says", tribox.Partition, partition.folder)

    @unittest.skipUnless("TRIBOX_PROGRAM" in os.environ, "built without the program")
    def test_ids_and_program(self):
        """Each reads those of the other."""
        Path(self.folder, "mesh.f32").write_bytes(self.triangles.tobytes())
        place = [f"--{name}={','.join(map(repr, numbers))}" for name, numbers in zip(("origin", "cell", "size"), FLOATS)]
        self.program("partition", "mesh.f32", *place, "--ids", "-o", "by_program")
        by_program = tribox.Partition(os.path.join(self.folder, "by_program"))
        by_program.check()
        expected = tribox.bricks(self.triangles, FLOATS, side=by_program.side, ids=True)
        self.assert_ids(by_program.bricks(ids=True), expected)
        partition = self.new(self.triangles, FLOATS, side=by_program.side, ids=True)
        self.program("voxelize", partition.folder, "--ids", "-o", "ids.npz")
        self.assert_ids(tribox.Bricks.load(os.path.join(self.folder, "ids.npz")), expected)

    @unittest.skipUnless("TRIBOX_PROGRAM" in os.environ, "built without the program")
    def test_sums(self):
        """The hashes of the mesh are those of the program, of floats and of doubles, whose parts merge with those of the mesh."""
        for mesh, name in ((cases.lattice(40).astype(float) * 0.1, "f64"), (cases.lattice(40), "f32")):
            mesh[3, 1, 1] = np.nan
            Path(self.folder, "mesh." + name).write_bytes(mesh.tobytes())
            self.program("partition", "mesh." + name, "-r", "300", "--ids", "-o", name)
            by_program = tribox.Partition(os.path.join(self.folder, name))
            ours = self.new(mesh, by_program.grid, side=by_program.side, ids=True)
            heads = [np.fromfile(Path(one.folder, "index"), HEADER, 1) for one in (by_program, ours)]
            for field in "triangles", "sums", "not_finite", "places":
                self.assert_same(heads[1][field], heads[0][field])
            for shard, source in enumerate((["mesh." + name, "-r", "300"], [name]), 1):
                self.program("voxelize", *source, "--ids", "--shard", f"{shard}/2", "-o", f"{shard}.part")
            self.program("merge", "1.part", "2.part", "-o", f"{name}.npz")

    def test_checksums(self):
        """Those of many parts are those of each."""
        pick = np.random.default_rng(cases.seed())
        halves = pick.integers(0, 1 << 32, 4000, dtype=np.uint32)
        for longest in (1, 4, 40, 400):
            starts = pick.integers(0, 3600, 60)
            ends = starts + pick.integers(1, longest + 1, 60)
            each = [checksum(np.append(halves[a:b], np.zeros((b - a) % 2, np.uint32)).tobytes()) for a, b in zip(starts, ends)]
            for count in (0, 1, 15, 16, 60):
                for block in (1 << 19, 100):
                    with mock.patch("tribox._checksum.BLOCK", block):
                        self.assertEqual(checksums(halves, starts[:count], ends[:count]).tolist(), each[:count])

    def test_pickle(self):
        partition = self.new(self.triangles, FLOATS)
        again = pickle.loads(pickle.dumps(partition))
        self.assertEqual(again.folder, partition.folder)
        self.assert_equal(again.bricks(), partition.bricks())
        self.assertLess(len(pickle.dumps(partition)), 1000)

    def test_blocks(self):
        """Written a few triangles at a time it is the same."""
        whole = self.new(self.triangles, FLOATS, side=16)
        with mock.patch("tribox._partition.BLOCK", 50):
            parts = self.new(self.triangles, FLOATS, side=16)
        for name in ("index", "triangles"):
            self.assertEqual(*(Path(one.folder, name).read_bytes() for one in (whole, parts)))

    def test_whole_or_not_at_all(self):
        path = os.path.join(self.folder, "there")
        with mock.patch("tribox._partition.write_index", side_effect=OSError("no space left")):
            self.assertRaisesRegex(OSError, "no space", tribox.partition, self.triangles, path, FLOATS)
        self.assertEqual(os.listdir(self.folder), [])
        tribox.partition(self.triangles, path, FLOATS)
        with self.assertRaisesRegex(FileExistsError, "exists; remove it, or give another"):
            tribox.partition(self.triangles, path, FLOATS)
        self.assertRaises(FileNotFoundError, tribox.partition, self.triangles, os.path.join(self.folder, "no", "folder"), FLOATS)
        self.assertEqual(os.listdir(self.folder), ["there"])

    def damaged(self, partition, name, change):
        """A copy with one file changed."""
        self.count += 1
        copy = os.path.join(self.folder, str(self.count))
        shutil.copytree(partition.folder, copy)
        with open(os.path.join(copy, name), "r+b") as file:
            content = bytearray(file.read())
            file.seek(0)
            file.truncate()
            file.write(change(content))
        return copy

    def test_damaged(self):
        partition = self.new(self.triangles, FLOATS, side=32)
        refuse, pick = self.refuse, np.random.default_rng(cases.seed())
        sizes = {name: os.path.getsize(os.path.join(partition.folder, name)) for name in ("index", "triangles")}

        def flip(place):
            def change(content):
                content[place] ^= 1 << int(pick.integers(8))
                return content
            return change

        for place in [*range(176), *pick.integers(176, sizes["index"], 30)]:
            copy = self.damaged(partition, "index", flip(place))
            refuse(tribox.InputError, None, "not a partition|; make the partition again", tribox.Partition, copy)
        for place in pick.integers(0, sizes["triangles"], 20):
            copy = tribox.Partition(self.damaged(partition, "triangles", flip(place)))
            number = partition.numbers[np.searchsorted(partition._ends, place // 36, "right")]
            refuse(tribox.InputError, None, f"the checksum of tile {number} does not match; make", copy.check)
            refuse(tribox.InputError, None, f"of tile {number} does", copy.check, (int(number), 1))
            copy.check((0, int(number)))
            copy.check((int(number) + 1, copy.tile_count - int(number) - 1))
        for name, change in (("index", lambda content: content[:100]), ("index", lambda content: content[:-32]),
                             ("index", lambda content: content + bytes(32)), ("triangles", lambda content: content[:-36]),
                             ("triangles", lambda content: content + bytes(1)), ("index", lambda content: b"")):
            refuse(tribox.InputError, None, "not a partition|make the partition again", tribox.Partition,
                   self.damaged(partition, name, change))
        self.assertRaises(FileNotFoundError, tribox.Partition, os.path.join(self.folder, "nowhere"))


if __name__ == "__main__":
    cases.main()
