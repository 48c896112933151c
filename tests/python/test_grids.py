"""tribox.grid_around, and resolution= in its place: the grid that the program lays around the same triangles."""

import copy
import json
import os
import pickle
import subprocess
import tempfile
import unittest
from fractions import Fraction

import numpy as np
import tribox

import cases

NOT_FINITE = (np.nan, np.inf, -np.inf)


def by_program(triangles, way, value):
    """The Grid and the packed words of tribox voxelize."""
    with tempfile.TemporaryDirectory() as folder:
        out, form = os.path.join(folder, "cells.raw"), f"f{8 * triangles.itemsize}"
        number = repr(float(value)).removesuffix(".0")
        done = subprocess.run([os.environ["TRIBOX_PROGRAM"], "voxelize", "-", "--format", form, f"--{way}", number, "-o", out,
                               "--json"], input=triangles.tobytes(), capture_output=True, timeout=120, check=True)
        grid = json.loads(done.stdout)["grid"]
        nx, ny, nz = grid["size"]
        return tribox.Grid(grid["origin"], grid["cell"], (nx, ny, nz)), np.fromfile(out, "<u8").reshape(nz, ny, (nx + 63) // 64)


def meshes():
    """Near, far, flat, small, large, of floats and of doubles, and one that floats cannot tell cells of."""
    lattice, north = cases.lattice(20), np.array([557820.0, 5108010.0, 431.25])
    pick = np.random.default_rng(cases.seed())
    yield lattice
    yield cases.scattered(20)
    yield lattice * np.float32(0.1)
    yield lattice * [0, 1, 0.5] + [1 / 3, 0, 0]
    yield (lattice * np.float32(1e-20)).astype(np.float32)
    yield lattice.astype(float) * 1e300
    yield (lattice + north).astype(np.float32)
    yield lattice * 0.8 + north
    yield (lattice * np.float32(2.0 ** -20) + np.float32(1)).astype(np.float32)
    yield pick.uniform(-1, 1, (20, 3, 3)).astype(np.float32) + pick.uniform(-99, 99, 3).astype(np.float32)


class Grids(cases.TestCase):
    @unittest.skipUnless("TRIBOX_PROGRAM" in os.environ, "built without the program")
    def test_like_the_program(self):
        for number, triangles in enumerate(meshes()):
            sides = np.ptp(triangles.reshape(-1, 3).astype(float), 0)
            for way, value in (*(("resolution", n) for n in (1, 3, 64, 100)), ("cell", sides.max() / 30),
                               ("cell", sides.max() / 32)):
                grid, words = by_program(triangles, way, value)
                self.assertEqual(tribox.grid_around(triangles, **{way: value}), grid, number)
                answer = tribox.voxelize(triangles, **{way: value}, threads=2)
                self.assertEqual(answer.grid, grid)
                self.assert_same(answer.words, words, number)

    def test_resolution(self):
        """The answer is that of the grid, whose planes hold the mesh."""
        for triangles in meshes():
            voxels = tribox.voxelize(triangles, resolution=9)
            grid = voxels.grid
            self.assert_same(tribox.voxelize(triangles, grid), np.array(voxels))
            self.assertEqual(max(grid.size), 9)
            layers = tribox.voxelize(triangles, resolution=9, layers=(0, 1))
            self.assertEqual(layers.grid, grid)
            self.assert_same(layers, voxels[:1])
            self.check_around(triangles, grid)

    def check_around(self, triangles, grid):
        corners = triangles.reshape(-1, 3).astype(float)
        lo, hi = grid.box(0, 0, 0)[0], grid.box(*(size - 1 for size in grid.size))[1]
        self.assertEqual(lo, tuple(corners.min(0)))
        self.assertTrue((hi >= corners.max(0)).all())
        for axis, size in enumerate(grid.size):
            if size > 1:
                last = grid.box(*(grid.size[a] - 1 if a == axis else 0 for a in range(3)))[0][axis]
                self.assertLess(last, corners.max(0)[axis])

    def test_cell(self):
        """cell= alone: one length or three, the very number."""
        for triangles in meshes():
            sides = np.ptp(triangles.reshape(-1, 3).astype(float), 0)
            for cell in (sides.max() / 7, np.float64(sides.max() / 8), tuple(np.maximum(sides, sides.max() / 64) / (5, 6, 7))):
                voxels = tribox.voxelize(triangles, cell=cell)
                self.assertEqual(voxels.grid.cell, tuple(np.broadcast_to(cell, 3)))
                self.check_around(triangles, voxels.grid)
                self.assert_same(tribox.voxelize(triangles.astype(float), voxels.grid), np.array(voxels))
        point = np.full((1, 3, 3), 0.1)
        self.assertEqual(tribox.voxelize(point, cell=1), np.ones((1, 1, 1), bool))
        for wrong, what in ((0, "greater than zero"), (-1, "greater than zero"), (np.nan, "finite"), ((1, 0, 1), "greater"),
                            (np.inf, "finite"),
                            (1e-12, "more than 2.32 - 1 cells along the . axis; give larger cells: cell = 1e-12")):
            self.refuse(tribox.InputError, "BAD_GRID", what, tribox.voxelize, cases.lattice(9), cell=wrong)
        for wrong in ("x", (1, 2), [[1, 2, 3]]):
            self.refuse(tribox.InputError, None, "^cell = .*; give the length of a cell, or three", tribox.voxelize, point,
                        cell=wrong)
        self.refuse(tribox.InputError, "BAD_GRID", "float64 cannot tell cells .* apart .*: cell = 1e-10", tribox.voxelize,
                    cases.lattice(9) + 2.0 ** 40, cell=1e-10)

    def test_grid(self):
        """A Grid is a value, of numbers as they are, and has the boxes of its cells."""
        grid = tribox.Grid(np.float32((0.1, 0, 1)), 0.1, np.array([3, 4, 5]))
        self.assertEqual(grid.origin, (float(np.float32(0.1)), 0, 1))
        self.assertEqual((grid.cell, grid.size), ((0.1, 0.1, 0.1), (3, 4, 5)))
        self.assertEqual([type(x) for x in (*grid.origin, *grid.cell, *grid.size)], [float] * 6 + [int] * 3)
        self.assertEqual(len({grid, tribox.Grid(*grid), pickle.loads(pickle.dumps(grid)), copy.deepcopy(grid)}), 1)
        self.assertNotEqual(grid, tribox.Grid(grid.origin, grid.cell, (3, 4, 6)))
        for cell in ((0, 0, 0), (2, 3, 4)):
            for side, bound in enumerate(grid.box(*cell)):
                exact = [float(Fraction(o) + (at + side) * Fraction(c)) for o, c, at in zip(grid.origin, grid.cell, cell)]
                self.assertEqual(list(bound), exact)
        for wrong in ((3, 0, 0), (-1, 0, 0), (0, 0, 1.5)):
            self.refuse(tribox.InputError, None, r"^\(i, j, k\) = .*; give a cell of the 3 x 4 x 5 cells", grid.box, *wrong)
        with self.assertRaises(AttributeError):
            grid.cell = 1

    def test_forms(self):
        """What is not finite, and vertices that no face names, do not count."""
        triangles = cases.scattered(40)
        grid = tribox.grid_around(triangles, 77)
        vertices, faces = cases.shared_vertices(triangles, np.uint32)
        far = np.full((3, 3), 1e30, np.float32)
        for wrong in NOT_FINITE:
            broken = np.array([far], np.float32)
            broken[0, 1, 2] = wrong
            mixed = np.concatenate([broken, triangles, broken])
            more = tribox.Mesh(np.concatenate([vertices, far, np.array([[wrong, 0, 0]], np.float32)]),
                               np.concatenate([faces, [[0, 1, len(vertices) + 3], [len(vertices) + 3, 2, len(vertices)]]]))
            for form in (mixed, more, tribox.Soup.of(mixed), np.asfortranarray(mixed)):
                self.assertEqual(tribox.grid_around(form, 77), grid)

    def test_refused(self):
        triangles, refuse = cases.lattice(5), self.refuse
        for call in (tribox.grid_around, lambda mesh, resolution: tribox.voxelize(mesh, resolution=resolution)):
            for wrong in (0, -1, 1.5, 1 << 31, "9", np.nan):
                refuse(tribox.InputError, None, "^resolution = .*; give how many cells", call, triangles, wrong)
            refuse(tribox.InputError, None, "all lie in one point, .* give cell, or a grid", call, 0 * triangles, 9)
            for nothing in (triangles[:0], triangles * np.float32(np.nan)):
                refuse(tribox.InputError, None, "none whose coordinates are all finite", call, nothing, 9)
            refuse(tribox.InputError, "BAD_GRID", "float64 cannot tell cells .*: resolution = ", call,
                   1 + triangles.astype(float) * 2.0 ** -50, 1 << 20)
            ends = np.zeros((1, 3, 3))
            ends[0, 0], ends[0, 1] = -1.7e308, 1.7e308
            refuse(tribox.InputError, "BAD_GRID", "not finite.*: resolution = 1", call, ends, 1)
            bad = tribox.Mesh(triangles[0], np.array([[0, 1, 3]], np.uint32))
            refuse(tribox.BadIndexError, "BAD_VERTEX", r"faces\[0, 2\] is 3", call, bad, 9)
        grid = (0, 0, 0), 1, (2, 2, 2)
        ways = r"give cell, .*, or resolution, .*; or a grid: tribox\.Grid\(origin, cell, size\)"
        for call in (tribox.voxelize, tribox.bricks):
            refuse(tribox.InputError, None, f"^no grid; {ways}", call, triangles)
            for given in (dict(cell=1, resolution=2), dict(grid=grid, cell=1), dict(grid=grid, resolution=2)):
                refuse(tribox.InputError, None, f"exclude each other; {ways}", call, triangles, **given)
            for wrong in (3, 0.5, (0, 0, 0, 0), "grid", (1, 2)):
                refuse(tribox.InputTypeError, None, f"^grid = .*; {ways}", call, triangles, wrong)
        refuse(tribox.InputError, "BAD_OPTION", "axes = 8", tribox.voxelize, triangles, resolution=2, axes=8)


if __name__ == "__main__":
    cases.main()
