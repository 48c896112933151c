"""ids: for each cell the lowest triangle that tribox.voxelize sets it for alone, of every form, window and number of threads."""

import importlib.util
import os
import pickle
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import tribox

import cases

GRIDS = {"floats": ((-2, -1.5, -1), (0.03125, 0.0625, 0.09375), (131, 50, 33)),
         "doubles": ((-2.1, -1.5, -1), (0.03, 0.06, 0.09), (131, 50, 33)),
         "small": ((-2, -2, -2), 1, (3, 4, 5))}


class IdTests(cases.TestCase):
    def setUp(self):
        self.triangles = np.concatenate([cases.lattice(20) / 2, cases.scattered(40)])

    def expected(self, grid):
        """An array of the lowest number for each cell, -1 where there is none, from a call for each triangle."""
        lowest = np.full(grid[2][::-1], -1)
        for t in range(len(self.triangles) - 1, -1, -1):
            lowest[np.asarray(tribox.voxelize(self.triangles[t:t + 1], grid))] = t
        return lowest

    def check(self, answer, lowest, offset=(0, 0, 0)):
        i, j, k = (answer.cells() - offset).T
        self.assertEqual(answer.ids.dtype, np.uint32)
        self.assert_same(answer.ids, lowest[k, j, i].astype(np.uint32))
        self.assertEqual(len(answer.ids), np.count_nonzero(lowest >= 0))

    def test_cells(self):
        for grid in GRIDS.values():
            lowest = self.expected(grid)
            for form in cases.forms(self.triangles):
                for threads in (1, 3):
                    voxels = tribox.voxelize(form, grid, ids=True, threads=threads)
                    self.check(voxels, lowest)
                    self.assert_same(voxels.words.copy(), tribox.voxelize(form, grid).words.copy())
                for side in (8, 24, 128):
                    self.check(tribox.bricks(form, grid, side=side, ids=True, threads=2), lowest)
            first, size = (1, 1, 2), (2, 3, 3)
            part = tribox.voxelize(self.triangles, grid, window=(first, size), ids=True)
            self.check(part, lowest[2:5, 1:4, 1:3], first)
            self.check(tribox.voxelize(self.triangles, grid, layers=(1, 3), ids=True), lowest[1:4], (0, 0, 1))

    def test_files(self):
        grid = GRIDS["floats"]
        lowest, voxels = self.expected(grid), tribox.voxelize(self.triangles, grid, ids=True)
        self.check(pickle.loads(pickle.dumps(voxels)), lowest)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "cells.npz")
            for whole in (voxels, tribox.bricks(self.triangles, grid, side=16, ids=True)):
                whole.save(path)
                self.check(tribox.Bricks.load(path), lowest)
                with np.load(path) as file:
                    self.assertEqual(file["ids"].dtype.str, "<u4")
            found = dict(np.load(path))
            for wrong in (found["ids"][1:], found["ids"].astype(np.int64)):
                np.savez(path, **{**found, "ids": wrong})
                with self.assertRaises(tribox.InputError):
                    tribox.Bricks.load(path)
            tribox.voxelize(self.triangles, grid).save(path)
            self.assertIsNone(tribox.Bricks.load(path).ids)

    def test_colours(self):
        """A look-up: the colours of triangles become those of cells."""
        colours = np.random.default_rng(1).integers(0, 256, (len(self.triangles), 3), np.uint8)
        voxels = tribox.voxelize(self.triangles, resolution=40, ids=True)
        self.assertEqual(colours[voxels.ids].shape, voxels.points().shape)

    @unittest.skipUnless("TRIBOX_PROGRAM" in os.environ, "built without the program")
    def test_example(self):
        """As many cells of each material as have its colour."""
        examples = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../examples/colours")
        with tempfile.TemporaryDirectory() as folder:
            def run(*words):
                return subprocess.run(words, cwd=folder, check=True, capture_output=True, text=True, timeout=120).stdout

            run(sys.executable, "-B", os.path.join(examples, "scene.py"))
            for option, name in (("--ids", "scene.npz"), ("--colours", "colours.npz")):
                run(os.environ["TRIBOX_PROGRAM"], "voxelize", "scene.obj", "--resolution", "160", option, "-o", name)
            printed = [line.split() for line in run(sys.executable, "-B", os.path.join(examples, "materials.py")).splitlines()]
            with open(os.path.join(folder, "scene.mtl")) as file:
                names, colours = zip(*((n.split()[1], c.split()[1:]) for n, c in zip(file, file)))
            with np.load(os.path.join(folder, "colours.npz")) as file:
                found, counts = np.unique(file["colours"], axis=0, return_counts=True)
            kd = np.floor(255 * np.array(colours, float) + 0.5)
            expected = {name: int(counts[(found == colour).all(1)][0]) for name, colour in zip(names, kd)}
            self.assertEqual({name: int(cells) for name, cells in printed}, expected)
            self.assertEqual(len(expected), 9)

    def test_none(self):
        grid = GRIDS["small"]
        self.assertEqual(len(tribox.voxelize(self.triangles[:0], grid, ids=True).ids), 0)
        self.assertEqual(len(tribox.bricks(self.triangles[:0], grid, ids=True).ids), 0)
        self.assertEqual(len(tribox.voxelize(self.triangles, grid, window=((1, 1, 1), (0, 2, 2)), ids=True).ids), 0)

    def test_refused(self):
        grid = GRIDS["small"]
        for more in (dict(fill="outside"), dict(into=tribox.voxelize(self.triangles, grid))):
            with self.assertRaisesRegex(tribox.InputError, "without fill and into"):
                tribox.voxelize(self.triangles, grid, ids=True, **more)
        with self.assertRaisesRegex(tribox.InputError, "leave out thin"):
            tribox.voxelize(self.triangles, grid, ids=True, thin=True)
        vertices, faces = cases.shared_vertices(self.triangles, np.int32)
        faces[3, 1] = len(vertices)
        with self.assertRaisesRegex(IndexError, r"faces\[3, 1\]"):
            tribox.voxelize(tribox.Mesh(vertices, faces), grid, ids=True)
        kept = tribox.voxelize(self.triangles, grid, ids=True)
        tribox.voxelize(self.triangles, grid, into=kept)
        for none in (kept, tribox.voxelize(self.triangles, grid)):
            with self.assertRaisesRegex(tribox.InputError, r"^these Voxels have no ids; voxelize\(..., ids=True\) makes some"):
                none.ids


class TextureTests(cases.TestCase):
    """examples/colours/texture.py."""

    def setUp(self):
        path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../examples/colours/texture.py")
        spec = importlib.util.spec_from_file_location("texture", path)
        self.texture = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(self.texture)

    def test_globe(self):
        """A cell has the colour of its own longitude and latitude, but near the edges of stripes."""
        triangles, coordinates = self.texture.globe()
        voxels = tribox.voxelize(triangles, resolution=60, ids=True)
        found = self.texture.colours_of(voxels, triangles, coordinates, self.texture.stripes())
        x, y, z = voxels.points().T
        stripe = np.arctan2(y, x) / (2 * np.pi) % 1 * 12
        height = (np.arcsin(z / np.sqrt(x * x + y * y + z * z)) / np.pi + 0.5 - 0.75) * 64
        is_clear = (abs(stripe - np.round(stripe)) > 0.3) & (abs(height) > 2) & (abs(z) < 0.9)
        light = np.where(stripe.astype(int) % 2, 230, 70)
        expected = np.stack([np.maximum(light, 230 * (height > 0)), light, light], axis=-1)[is_clear]
        self.assertGreater(len(expected), 3000)
        self.assert_same(found[is_clear], expected.astype(np.uint8))

    def test_places(self):
        """Each corner has its own, off the plane too; outside none is negative."""
        triangles = np.array([[(0, 0, 0), (4, 0, 0), (0, 8, 0)]] * 2, float)
        points = np.array([(1, 4, 3), (-4, 4, 0)], float)  # a quarter of b and half of c; on the edge from a to c
        self.assertEqual(self.texture.places_in(triangles, points).tolist(), [[0.25, 0.25, 0.5], [0.75, 0, 0.25]])

    def test_thin(self):
        """Segments and points have a colour too, that of their first corner."""
        triangles = np.array([[(0, 0, 0), (4, 0, 0), (2, 0, 0)], [(1, 2, 3)] * 3], np.float32)
        points = np.array([(3, 1, 0), (1, 2, 3)], float)
        self.assert_same(self.texture.places_in(triangles.astype(float), points), np.array([(1, 0, 0), (1, 0, 0)], float))


if __name__ == "__main__":
    cases.main()
