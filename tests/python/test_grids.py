"""tribox.grid_around, and resolution= in its place: the grid that the program lays around the same triangles."""

import json
import os
import subprocess
import tempfile
import unittest

import numpy as np
import tribox

import cases

NOT_FINITE = (np.nan, np.inf, -np.inf)


def by_program(triangles, resolution):
    """The Grid and the packed words of tribox voxelize."""
    with tempfile.TemporaryDirectory() as folder:
        out, form = os.path.join(folder, "cells.raw"), f"f{8 * triangles.itemsize}"
        done = subprocess.run([os.environ["TRIBOX_PROGRAM"], "voxelize", "-", "--format", form, "-r", str(resolution), "-o", out,
                               "--json"], input=triangles.tobytes(), capture_output=True, timeout=120, check=True)
        grid = json.loads(done.stdout)["grid"]
        number = np.float32 if grid["planes"] == "float32" else np.float64
        corner, cell = (tuple(float(number(x)) for x in grid[name]) for name in ("origin", "cell"))
        nx, ny, nz = grid["size"]
        return tribox.Grid(corner, cell, (nx, ny, nz)), np.fromfile(out, "<u8").reshape(nz, ny, (nx + 63) // 64)


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
            for resolution in (1, 3, 64, 100):
                grid, words = by_program(triangles, resolution)
                self.assertEqual(tribox.grid_around(triangles, resolution), grid, number)
                answer, chosen = tribox.voxelize(triangles, resolution=resolution, packed=True, threads=2)
                self.assertEqual(chosen, grid)
                self.assert_same(answer, words, number)

    def test_resolution(self):
        """The answer is that of the grid."""
        for triangles in meshes():
            cells, grid = tribox.voxelize(triangles, resolution=9)
            self.assert_same(cells, tribox.voxelize(triangles, *grid))
            self.assertEqual(max(grid.size), 9)
            layers, again = tribox.voxelize(triangles, resolution=9, layers=(0, 1))
            self.assertEqual(again, grid)
            self.assert_same(layers, cells[:1])

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
            refuse(tribox.InputError, None, "all lie in one point, .* give origin, cell and size", call, 0 * triangles, 9)
            for nothing in (triangles[:0], triangles * np.float32(np.nan)):
                refuse(tribox.InputError, None, "none whose coordinates are all finite", call, nothing, 9)
            refuse(tribox.InputError, "BAD_GRID", "float64 cannot tell cells .*: resolution = ", call,
                   1 + triangles.astype(float) * 2.0 ** -50, 1 << 20)
            ends = np.zeros((1, 3, 3))
            ends[0, 0], ends[0, 1] = -1.7e308, 1.7e308
            refuse(tribox.InputError, "BAD_GRID", "not finite.*: resolution = 1", call, ends, 1)
            bad = tribox.Mesh(triangles[0], np.array([[0, 1, 3]], np.uint32))
            refuse(tribox.BadIndexError, "BAD_VERTEX", r"faces\[0, 2\] is 3", call, bad, 9)
        refuse(tribox.InputError, None, "^no grid is given; give origin, cell and size, or resolution", tribox.voxelize, triangles)
        refuse(tribox.InputError, None, "^resolution chooses .* with cell = 1$", tribox.voxelize, triangles, cell=1, resolution=2)
        refuse(tribox.InputError, "BAD_OPTION", "axes = 8", tribox.voxelize, triangles, resolution=2, axes=8)


if __name__ == "__main__":
    cases.main()
