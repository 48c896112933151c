"""tribox.cell_lists: by cell, the triangles that tribox.overlap finds in its box, in grids of any size."""

import dataclasses
from unittest import mock

import numpy as np
import tribox

import cases

GRIDS = {"floats": ((-2, -1.5, -1), (0.25, 0.5, 0.375), (15, 6, 5)),
         "doubles": ((-1.1, -1.5, -1), (0.3, 0.7, 1 / 3), (7, 5, 6)),
         "thin": ((-2, -1.5, -1), (0.03125, 4, 4), (130, 1, 1))}


class CellTests(cases.TestCase):
    def setUp(self):
        self.triangles = np.concatenate([cases.lattice(40) / 2, cases.scattered(60)])
        self.triangles[7, 1, 2] = np.nan

    def check(self, lists, triangles, cells=None, **options):
        """Each cell, of a whole grid by default, is asked about by itself."""
        nx, ny, nz = lists.grid.size
        asked = [(i, j, k) for k in range(nz) for j in range(ny) for i in range(nx)] if cells is None else cells
        expected = [(cell, np.flatnonzero(tribox.overlap(triangles, *lists.grid.box(*cell), **options))) for cell in asked]
        found = {tuple(cell): lists.triangles[start:end] for cell, start, end in
                 zip(lists.cells.tolist(), lists.start[:-1], lists.start[1:])}
        for cell, numbers in expected:
            self.assertEqual(found.get(tuple(cell), np.empty(0)).tolist(), numbers.tolist(), cell)
        if cells is None:
            self.assertEqual([tuple(cell) for cell in lists.cells.tolist()], [cell for cell, numbers in expected if len(numbers)])
        self.assertEqual((lists.cells.dtype, lists.start.dtype, lists.triangles.dtype), (np.uint32, np.intp, np.uint32))
        self.assertEqual((lists.start[0], lists.start[-1]), (0, len(lists.triangles)))

    def assert_equal(self, lists, expected):
        self.assertEqual(lists.grid, expected.grid)
        for name in ("cells", "start", "triangles"):
            self.assert_same(getattr(lists, name), getattr(expected, name))

    def test_too_large(self):
        """Refused before the work; the bound is never more than the answer has."""
        triangle = np.array([[[0, 0, 0], [2, 0, 0], [0, 2, 0]]], np.float32)
        self.refuse(tribox.InputError, None, "at least 2e.12 numbers of triangles, and can have 4.29e.09 at most; give larger cells",
                    tribox.cell_lists, triangle, resolution=2000000)
        for triangles in (self.triangles, self.triangles.astype(float)):
            for name, grid in GRIDS.items():
                count = len(tribox.cell_lists(triangles, grid).triangles)
                with mock.patch("tribox._cells.NUMBERS_MAX", count), mock.patch("tribox._cells.BLOCK", 7):
                    tribox.cell_lists(triangles, grid)
        flat = np.array([[[0, 0, 1], [64, 0, 1], [0, 64, 1]]], np.float32)
        with mock.patch("tribox._cells.NUMBERS_MAX", 2047):
            self.refuse(tribox.InputError, None, "at least 2.05e.03 numbers", tribox.cell_lists, flat, ((0, 0, 0), (1, 1, 1), (64, 64, 2)))

    def test_by_cell(self):
        for grid in GRIDS.values():
            for form in cases.forms(self.triangles):
                lists = tribox.cell_lists(form, grid)
                self.check(lists, form)
                self.assertTrue(len(lists.cells))

    def test_voxels(self):
        """The cells of voxelize, in their order."""
        for way in (dict(cell=0.05), dict(resolution=70), dict(grid=((-2, -1.5, -1), 0.03, (131, 100, 70)))):
            lists, voxels = tribox.cell_lists(self.triangles[:40], **way), tribox.voxelize(self.triangles[:40], **way)
            self.assertEqual(lists.grid, voxels.grid)
            self.assert_same(lists.cells.astype(np.int64), voxels.cells())
            self.assert_same(lists.points(), voxels.points())

    def test_tiles(self):
        """In windows of a few cells, and cut out of larger tiles."""
        for grid in GRIDS.values():
            expected = tribox.cell_lists(self.triangles, grid)
            for side, most in (1, 1), (1, 1000), (2, 4), (5, 1), (5, 1000):
                with mock.patch("tribox._cells.SIDE", side), mock.patch("tribox._cells.TILES_MAX", most):
                    for form in cases.forms(self.triangles):
                        self.assert_equal(tribox.cell_lists(form, grid), expected)

    def test_threads(self):
        grid = (-2, -1.5, -1), 0.05, (131, 50, 33)
        for form in cases.forms(self.triangles):
            whole = tribox.cell_lists(form, grid)
            for threads in (2, 7, None):
                self.assert_equal(tribox.cell_lists(form, grid, threads=threads), whole)

    def test_beyond_memory(self):
        """Grids whose cells, and whose tiles, no memory holds."""
        near = (self.triangles[:6] / 4096).astype(np.float32)
        for grid in ((-0.03125, 2.0 ** -18, 1 << 14), (-4.7, 0.7e-5, (1 << 20) + 5)):
            lists = tribox.cell_lists(near, ((grid[0],) * 3, grid[1], (grid[2],) * 3), threads=2)
            self.assertGreater(len(lists.cells), 100)
            self.check(lists, near, lists.cells[::1 + len(lists.cells) // 200].tolist())
            step = np.random.default_rng(cases.seed()).integers(-1, 2, (200, 3))
            self.check(lists, near, (lists.cells[:200].astype(int) + step).tolist())

    def test_options(self):
        grid = GRIDS["doubles"]
        for options in (dict(kernel="scalar"), dict(axes=tribox.AXES_BOX), dict(axes=tribox.AXES_PLANE)):
            self.check(tribox.cell_lists(self.triangles, grid, **options), self.triangles, **options)
        exact = tribox.cell_lists(self.triangles, grid)
        for accuracy in ("conservative", "fast"):
            more = tribox.cell_lists(self.triangles, grid, accuracy=accuracy)
            pairs = [{(*cell, number) for cell, start, end in zip(lists.cells.tolist(), lists.start[:-1], lists.start[1:])
                      for number in lists.triangles[start:end]} for lists in (exact, more)]
            self.assertLessEqual(*pairs)

    def test_nothing(self):
        for nothing in (self.triangles[:0], np.full((5, 3, 3), np.nan, np.float32), self.triangles + np.float32(1e20)):
            for grid in (*GRIDS.values(), ((0, 0, 0), 1, (1 << 30,) * 3)):
                lists = tribox.cell_lists(nothing, grid, threads=2)
                self.assertEqual((lists.cells.shape, lists.start.tolist(), lists.triangles.shape), ((0, 3), [0], (0,)))
                self.assertEqual(lists.points().shape, (0, 3))
        self.assertRegex(repr(lists), r"^<tribox.CellLists: 0 triangles in 0 cells, of a grid of 1073741824 x .* cells>$")

    def test_frozen(self):
        with self.assertRaises(dataclasses.FrozenInstanceError):
            tribox.cell_lists(self.triangles, GRIDS["floats"]).grid = None

    def test_refused(self):
        refuse, grid = self.refuse, GRIDS["floats"]
        refuse(tribox.InputError, None, "^no grid; give cell", tribox.cell_lists, self.triangles)
        refuse(tribox.InputError, None, "exclude each other", tribox.cell_lists, self.triangles, grid, cell=1)
        refuse(tribox.InputError, "BAD_GRID", "cell = 0", tribox.cell_lists, self.triangles, ((0, 0, 0), 0, (1, 1, 1)))
        refuse(tribox.InputError, "BAD_OPTION", "axes = 8", tribox.cell_lists, self.triangles, grid, axes=8)
        refuse(tribox.InputError, None, "^accuracy = ", tribox.cell_lists, self.triangles, grid, accuracy="exakt")
        refuse(tribox.InputError, "NO_KERNEL", "^kernel = ", tribox.cell_lists, self.triangles, grid, kernel="none")
        refuse(tribox.InputError, None, "^threads = 0", tribox.cell_lists, self.triangles, grid, threads=0)
        refuse(tribox.InputTypeError, None, "^triangles", tribox.cell_lists, "mesh.ply", grid)
        bad = tribox.Mesh(self.triangles[0], np.full((9, 3), 3, np.uint32))
        for threads in (1, 3):
            refuse(tribox.BadIndexError, "BAD_VERTEX", "faces", tribox.cell_lists, bad, grid, threads=threads)


if __name__ == "__main__":
    cases.main()
