"""voxelize with fill and labels, and by the middles of cells, which VTK's stencils do too."""

import os
import pickle
import sys
import tempfile
import unittest
import warnings

import numpy as np
import tribox

import cases


def torus(around, across, tube):
    u, v = np.meshgrid(np.arange(around) * 2 * np.pi / around, np.arange(across) * 2 * np.pi / across, indexing="ij")
    far = 1 + tube * np.cos(v)
    points = np.stack([far * np.cos(u), far * np.sin(u), tube * np.sin(v)], -1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    a, b, c, d = ((i + x) % around * across + (j + y) % across for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
    return points, np.concatenate([np.stack(three, -1).reshape(-1, 3) for three in ((a, b, c), (a, c, d))])


def turned(pick, around=40, across=20, tube=0.37):
    """A torus, in floats, that lies anyhow."""
    points, faces = torus(around, across, tube)
    turn = np.linalg.qr(pick.normal(size=(3, 3)))[0]
    return (points @ turn).astype(np.float32), faces


class Labels(cases.TestCase):
    def setUp(self):
        self.mesh = tribox.Mesh(*turned(np.random.default_rng(cases.seed())))
        self.grid = tribox.voxelize(self.mesh, resolution=67).grid
        self.surface = np.asarray(tribox.voxelize(self.mesh, self.grid))

    def test_labels(self):
        for fill in ("outside", "parity"):
            plain = tribox.voxelize(self.mesh, self.grid, fill=fill)
            self.assertIsNone(plain.inside)
            self.refuse(tribox.InputError, None, "these Voxels have no labels; voxelize.*labels=True", plain.labels)
            for threads in (1, 2):
                voxels = tribox.voxelize(self.mesh, self.grid, fill=fill, labels=True, threads=threads)
                self.assert_same(np.asarray(voxels), np.asarray(plain))
                labels = voxels.labels()
                self.assert_same(labels, np.asarray(plain).astype(np.uint8) * 2 - self.surface)
                self.assertGreater(np.count_nonzero(labels == 2), 1000)
                self.assert_same(np.asarray(voxels.inside), labels == 2)
                self.assertEqual((voxels.inside.grid, voxels.inside.window), (voxels.grid, voxels.window))
                self.assert_same(pickle.loads(pickle.dumps(voxels)).labels(), labels)

    def test_files(self):
        """As numpy.load and the program have them."""
        voxels = tribox.voxelize(self.mesh, self.grid, fill="outside", labels=True)
        labels = voxels.labels()
        with tempfile.TemporaryDirectory() as folder:
            for ending in ("npz", "npy", "nrrd", "vti"):
                voxels.save(os.path.join(folder, "x." + ending))
            self.assert_same(np.load(os.path.join(folder, "x.npy")), labels)
            for ending in ("nrrd", "vti"):
                with open(os.path.join(folder, "x." + ending), "rb") as file:
                    self.assertIn(labels.tobytes(), file.read())
            bricks = tribox.Bricks.load(os.path.join(folder, "x.npz"))
            bricks.save(os.path.join(folder, "y.npz"))
            again = tribox.Bricks.load(os.path.join(folder, "y.npz"))
            for one in (bricks, again):
                found = np.zeros_like(labels)
                for cells, label in ((one.cells(), 1), (tribox.Bricks(one.at, one.inside, one.grid).cells(), 2)):
                    found[tuple(cells.T[::-1])] = label
                self.assert_same(found, labels)
            voxels.inside.save(os.path.join(folder, "z.npz"))
            self.assertIsNone(tribox.Bricks.load(os.path.join(folder, "z.npz")).inside)
            with np.load(os.path.join(folder, "x.npz")) as file:
                stored = {name: file[name] for name in file.files}
            with open(os.path.join(folder, "short.npz"), "wb") as file:
                np.savez(file, **{**stored, "inside": stored["inside"][1:]})
            self.refuse(tribox.InputError, None, "short.npz: damaged: .* places of .* bricks", tribox.Bricks.load,
                        os.path.join(folder, "short.npz"))

    def test_refused(self):
        voxels = tribox.voxelize(self.mesh, self.grid)
        for pattern, keywords in (('give fill = "outside" or "parity"', dict(labels=True)),
                                  ('give fill = "outside" or "parity"', dict(labels=True, fill="middles")),
                                  ("labels and into exclude each other", dict(labels=True, fill="outside", into=voxels)),
                                  ("give None or one of 'outside', 'parity', 'middles'", dict(fill="centre")),
                                  ("fill needs the whole grid", dict(fill="middles", layers=(0, 1)))):
            self.refuse(tribox.InputError, None, pattern, tribox.voxelize, self.mesh, self.grid, **keywords)


class Thin(cases.TestCase):
    def test_cells(self):
        """Fewer than the others, of the same on any way; and what parity fills is what the outside does not reach."""
        pick = np.random.default_rng(cases.seed())
        for round_ in range(10):
            points, faces = turned(pick)
            mesh = tribox.Mesh(points.astype(pick.choice([np.float32, np.float64])), faces)
            grid = tribox.voxelize(mesh, resolution=int(pick.integers(2, 150))).grid
            full, thin = tribox.voxelize(mesh, grid), tribox.voxelize(mesh, grid, thin=True)
            self.assertFalse((np.asarray(thin) & ~np.asarray(full)).any())
            self.assert_same(np.asarray(tribox.voxelize(mesh, grid, thin=True, threads=2)), np.asarray(thin))
            layers = (grid.size[2] // 3, grid.size[2] // 2)
            part = tribox.voxelize(mesh, grid, thin=True, layers=layers)
            self.assert_same(np.asarray(part), np.asarray(thin)[layers[0]:sum(layers)])
            middles = np.asarray(tribox.voxelize(mesh, grid, fill="middles"))
            outside, parity = (tribox.voxelize(mesh, grid, thin=True, fill=fill) for fill in ("outside", "parity"))
            self.assert_same(np.asarray(parity), np.asarray(thin) | middles)
            self.assertFalse((middles & ~np.asarray(outside)).any())
            labels = tribox.voxelize(mesh, grid, thin=True, fill="parity", labels=True).labels()
            self.assert_same(labels == 1, np.asarray(thin))

    def test_plane(self):
        """A square in the plane between cells is one cell thick, as one within them."""
        for x in (2, 2.3):
            square = np.array([[[x, 0, 0], [x, 4, 0], [x, 4, 4]], [[x, 0, 0], [x, 4, 4], [x, 0, 4]]], np.float32)
            grid = tribox.Grid((0, 0, 0), 1, (4, 4, 4))
            self.assertEqual([tribox.voxelize(square, grid, thin=thin).sum() for thin in (True, False)], [16, 32 if x == 2 else 16])

    def test_refused(self):
        for keywords in (dict(accuracy="fast"), dict(accuracy="conservative"), dict(axes=1)):
            self.refuse(tribox.InputError, "BAD_OPTION", "exact and of all axes", tribox.voxelize, cases.lattice(3), resolution=3,
                        thin=True, **keywords)
        self.refuse(tribox.InputError, None, "leave out thin", tribox.voxelize, cases.lattice(3), resolution=3, thin=True,
                    fill="middles")


class Middles(cases.TestCase):
    def test_parity(self):
        """Parity sets these and the surface."""
        pick = np.random.default_rng(cases.seed())
        for round_ in range(20):
            points, faces = turned(pick, 12, 8)
            mesh = tribox.Mesh(points.astype(pick.choice([np.float32, np.float64])), faces)
            surface = tribox.voxelize(mesh, resolution=int(pick.integers(1, 80)))
            middles = tribox.voxelize(mesh, surface.grid, fill="middles")
            self.assert_same(surface | middles, np.asarray(tribox.voxelize(mesh, surface.grid, fill="parity")))
            into = tribox.voxelize(mesh, surface.grid, fill="middles", into=tribox.Voxels(surface.words.copy(), surface.grid))
            self.assert_same(np.asarray(into), np.asarray(surface | middles))

    def test_open(self):
        points, faces = turned(np.random.default_rng(cases.seed()))
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            tribox.voxelize(tribox.Mesh(points, faces[:-30]), resolution=50, fill="middles")
        self.assertEqual([(one.category, one.filename) for one in caught], [(tribox.OpenMeshWarning, __file__)])

    def test_vtk(self):
        """Equal cell by cell on closed meshes."""
        sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "bench", "peers"))
        try:
            import peer_vtk
        except ImportError:
            self.skipTest("no VTK")
        from asked import Task
        pick = np.random.default_rng(cases.seed())
        for round_ in range(30):
            points, faces = turned(pick, int(pick.integers(5, 50)), int(pick.integers(4, 30)))
            cell = pick.uniform(0.02, 0.1, 3)
            grid = tribox.Grid(pick.uniform(-1.5, -1, 3), cell, np.ceil(2.2 / cell).astype(int))
            found = tribox.voxelize(tribox.Mesh(points, faces), grid, fill="middles")
            self.assertGreater(found.sum(), 100)
            call, answer = peer_vtk.stencil(Task(points, faces, grid))
            self.assert_same(np.asarray(found), answer(call()), f"round {round_}")


if __name__ == "__main__":
    cases.main()
