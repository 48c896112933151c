"""tribox.bricks: the cells of tribox.voxelize, and the bricks of the library's own call, one by one."""

from unittest import mock

import numpy as np
import tribox
from tribox._ffi import ffi
from tribox._library import lib

import cases

GRIDS = {"floats": ((-2, -1.5, -1), (0.03125, 0.0625, 0.09375), (131, 50, 33)),
         "doubles": ((-2.1, -1.5, -1), (0.03, 0.06, 0.09), (131, 50, 33)),
         "thin": ((-2, -1.5, -1), (0.0078125, 4, 4), (500, 1, 1)),
         "small": ((-2, -2, -2), 1, (3, 4, 5))}


def dense(bricks, size):
    """An array of bool, of cells within the grid and one brick more on each side, as bits there would be wrong."""
    across = np.array(size) // 8 + 2
    cells = np.zeros((across[2], 8, across[1], 8, across[0], 8), bool)
    for (i, j, k), bits in zip(bricks.at, bricks.bits):
        octets = bits.astype("<u8").view(np.uint8).reshape(8, 8, 1)
        cells[k, :, j, :, i] = np.unpackbits(octets, -1, bitorder="little")
    return cells.reshape(8 * across[::-1])


def by_sink(triangles, grid, side):
    """The bricks as the library hands them to a sink, from lists of all triangles."""
    mesh, struct = tribox.Mesh(triangles), tribox._grids.struct_of(tribox.Grid(*grid))
    tiles, found = tribox.tile_count(grid[2], side), []

    @ffi.callback("int(void *, const uint32_t *, const uint64_t *)")
    def take(_, at, bits):
        found.append((list(at[0:3]), list(bits[0:8])))
        return 0

    starts = np.arange(tiles + 1, dtype=np.uintp) * len(mesh)
    numbers = np.tile(np.arange(len(mesh), dtype=np.uint32), tiles)
    scratch = np.empty(lib.tribox_bricks_bytes(side), np.uint8)
    share, sink = ffi.new("tribox_tiles *", (side, 0, tiles)), ffi.new("tribox_sink *", (take, ffi.NULL))
    status = lib.tribox_mesh_bricks(mesh.struct, struct, share, ffi.from_buffer("size_t[]", starts),
                                    ffi.from_buffer("uint32_t[]", numbers), ffi.NULL, ffi.from_buffer(scratch), sink, ffi.NULL)
    assert not status, status
    at, bits = zip(*found)
    return tribox.Bricks(np.array(at, np.uint32), np.array(bits, np.uint64), tribox.Grid(*grid))


class BrickTests(cases.TestCase):
    def setUp(self):
        self.triangles = np.concatenate([cases.lattice(40) / 2, cases.scattered(60)])

    def check_like(self, bricks, cells):
        """They have these cells, each brick once and none empty."""
        answer = dense(bricks, cells.shape[::-1])
        nz, ny, nx = cells.shape
        self.assert_same(answer[:nz, :ny, :nx].copy(), cells)
        self.assertEqual(answer.sum(), cells.sum())
        self.assertEqual((bricks.at.dtype, bricks.bits.dtype), (np.uint32, np.uint64))
        self.assertEqual(len(np.unique(bricks.at, axis=0)), len(bricks.at))
        self.assertTrue(bricks.bits.any(1).all())

    def assert_equal(self, bricks, expected):
        self.assert_same(bricks.at, expected.at)
        self.assert_same(bricks.bits, expected.bits)

    def test_like_dense(self):
        for grid in GRIDS.values():
            for form in cases.forms(self.triangles):
                cells = np.array(tribox.voxelize(form, grid))
                for side in (8, 24, 64, 128, 1024):
                    bricks = tribox.bricks(form, grid, side=side)
                    self.check_like(bricks, cells)
                places = np.sort(bricks.cells() @ [1, 1 << 20, 1 << 40])
                self.assert_same(places, np.sort(np.argwhere(cells) @ [1 << 40, 1 << 20, 1]))

    def test_like_the_library(self):
        """The order included: by tile, z, y and x."""
        for name in GRIDS:
            for side in (8, 24, 64):
                expected = by_sink(self.triangles, GRIDS[name], side)
                self.assert_equal(tribox.bricks(self.triangles, GRIDS[name], side=side), expected)

    def test_shares(self):
        for grid in GRIDS.values():
            for form in cases.forms(self.triangles):
                whole, count = tribox.bricks(form, grid, side=16), tribox.tile_count(grid[2], 16)
                cuts = [0, 0, count // 3, count // 2, count // 2, count]
                shares = [(first, end - first) for first, end in zip(cuts, cuts[1:])]
                parts = [tribox.bricks(form, grid, side=16, tiles=share, threads=2) for share in shares]
                self.assert_equal(cases.joined(parts), whole)

    def test_threads(self):
        for grid in GRIDS.values():
            for form in cases.forms(self.triangles):
                whole = tribox.bricks(form, grid, side=8)
                for threads in (2, 7, None):
                    self.assert_equal(tribox.bricks(form, grid, side=8, threads=threads), whole)

    def test_threads_list(self):
        """Which triangles are in which tile, in parts of a few."""
        for grid in GRIDS.values():
            for form in cases.forms(self.triangles):
                whole = tribox.bricks(form, grid, side=64)
                with mock.patch("tribox._tiles.LISTED_ALONE", 0):
                    for threads in (2, 3, 7):
                        self.assert_equal(tribox.bricks(form, grid, side=64, threads=threads), whole)

    def test_beyond_memory(self):
        """A grid of 2^42 cells, whose bricks are the windows around them."""
        grid = (-0.03125,) * 3, 2.0 ** -18, (1 << 14,) * 3
        near = (self.triangles[:20] / 512).astype(np.float32)
        bricks = tribox.bricks(near, grid, threads=2)
        self.assertGreater(len(bricks.at), 20)
        for at, bits in list(zip(bricks.at, bricks.bits))[::len(bricks.at) // 20]:
            window = tribox.voxelize(near, grid, window=(8 * at.astype(int), (8, 8, 8)))
            octets = bits.astype("<u8").view(np.uint8).reshape(8, 8, 1)
            self.assert_same(np.unpackbits(octets, -1, bitorder="little").astype(bool), window)

    def test_options(self):
        grid = GRIDS["floats"]
        exact = np.array(tribox.voxelize(self.triangles, grid))
        for options in (dict(kernel="scalar"), dict(axes=tribox.AXES_BOX), dict(axes=tribox.AXES_PLANE)):
            cells = np.array(tribox.voxelize(self.triangles, grid, **options))
            self.check_like(tribox.bricks(self.triangles, grid, side=32, **options), cells)
        more = dense(tribox.bricks(self.triangles, grid, side=32, accuracy="conservative"), grid[2])
        self.assertTrue((more[:33, :50, :131] >= exact).all())

    def test_nothing(self):
        for nothing in (self.triangles[:0], np.full((5, 3, 3), np.nan, np.float32), self.triangles + np.float32(1e20)):
            for grid in GRIDS.values():
                bricks = tribox.bricks(nothing, grid, threads=2)
                self.assertEqual((bricks.at.shape, bricks.bits.shape), ((0, 3), (0, 8)))
                self.assertEqual((bricks.at.dtype, bricks.bits.dtype), (np.uint32, np.uint64))
                self.assertEqual(bricks.cells().shape, (0, 3))

    def test_refused(self):
        refuse, grid = self.refuse, GRIDS["floats"]
        for side in (0, 4, 12, 1032, -8, 1.5, "8", None):
            refuse(tribox.InputError, None, "^side = .*; give how many cells", tribox.bricks, self.triangles, grid, side=side)
            refuse(tribox.InputError, None, "^side = ", tribox.tile_count, grid[2], side)
        for tiles in ((0, 3), (2, 1), (-1, 1), (1, -1), (3, 0), (0, 1.5), 3, "ab"):
            refuse(tribox.InputError, None, r"^tiles = .*; give \(first, count\).*within the 2 tiles", tribox.bricks,
                   self.triangles, grid, tiles=tiles)
        for size in ((1, 2), 3, "abc", (1, -2, 3), (1 << 32, 1, 1)):
            refuse(tribox.InputError, None, "^size = ", tribox.tile_count, size)
        refuse(tribox.InputError, "BAD_GRID", "cell = 0", tribox.bricks, self.triangles, ((0, 0, 0), 0, (1, 1, 1)))
        refuse(tribox.InputError, "BAD_OPTION", "axes = 8", tribox.bricks, self.triangles, grid, axes=8)
        refuse(tribox.InputError, None, "^threads = 0", tribox.bricks, self.triangles, grid, threads=0)
        bad = tribox.Mesh(self.triangles[0], np.full((9, 3), 3, np.uint32))
        for name in ("floats", "doubles"):
            refuse(tribox.BadIndexError, "BAD_VERTEX", "faces", tribox.bricks, bad, GRIDS[name])

    def test_grids(self):
        """The three ways to a grid, and the places in it."""
        for way in (dict(cell=0.05), dict(resolution=70), dict(grid=GRIDS["doubles"])):
            bricks, voxels = tribox.bricks(self.triangles[:40], **way), tribox.voxelize(self.triangles[:40], **way)
            self.assertEqual(bricks.grid, voxels.grid)
            self.assertEqual(sorted(bricks.points().tolist()), sorted(voxels.points().tolist()))

    def test_tile_count(self):
        self.assertEqual(tribox.tile_count((128, 129, 1)), 2)
        self.assertEqual(tribox.tile_count((1 << 20, 1 << 20, 1 << 20), 8), 1 << 51)


if __name__ == "__main__":
    cases.main()
