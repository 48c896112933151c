"""Windows, threads and insides: the bits of tribox.voxelize in one piece."""

import warnings
from unittest import mock

import numpy as np
import tribox
from tribox import _layers, _pages, _sharing

import cases

GRIDS = {"floats": ((-2, -1.5, -1), (0.03125, 0.0625, 0.09375), (131, 50, 33)),
         "doubles": ((-2.1, -1.5, -1), (0.03, 0.06, 0.09), (131, 50, 33))}


def box_mesh(lo, hi):
    """A closed box as 12 triangles."""
    corners = np.array([[x, y, z] for z in (lo[2], hi[2]) for y in (lo[1], hi[1]) for x in (lo[0], hi[0])], np.float32)
    quads = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    return corners[[[a, b, c] for p, q, r, s in quads for a, b, c in ((p, q, r), (p, r, s))]]


class Windows(cases.TestCase):
    def setUp(self):
        self.triangles = np.concatenate([cases.lattice(40) / 2, cases.scattered(60)])
        self.pick = np.random.default_rng(cases.seed())

    def windows(self, size):
        yield (0, 0, 0), size
        yield (64, 3, 5), (64, 1, 2)
        yield np.array([130, 49, 32]), [1, 1, 1]
        for _ in range(12):
            ends = np.sort(self.pick.integers(0, np.add(size, 1), (2, 3)), 0)
            yield ends[0], ends[1] - ends[0]

    def test_windows(self):
        for name, grid in GRIDS.items():
            for form in cases.forms(self.triangles):
                whole = np.array(tribox.voxelize(form, grid))
                self.assertTrue(whole.any() and not whole.all())
                for first, size in self.windows(grid[2]):
                    (i, j, k), (ni, nj, nk) = first, size
                    expected = whole[k:k + nk, j:j + nj, i:i + ni]
                    answer = tribox.voxelize(form, grid, window=(first, size))
                    self.assert_same(answer, expected, f"{name}: {first} {size}")
                    self.assertEqual(answer.words.shape, (nk, nj, (ni + 63) // 64))
                    self.assertEqual(answer.window, (tuple(first), tuple(size)))
                    into = tribox.voxelize(form[:0] if isinstance(form, np.ndarray) else form, grid, window=(first, size))
                    self.assertIs(tribox.voxelize(form, grid, window=(first, size), into=into, threads=2), into)
                    self.assert_same(into, expected)

    def test_forms_agree(self):
        """Points on planes as float32 rounds them: in every form, and as float64, they lie in the cells of the planes stated."""
        cell = np.float32(0.1)
        rows = np.repeat((np.arange(41) * float(cell) - 2).astype(np.float32), 9).reshape(41, 3, 3)
        columns = tribox.Mesh(np.asfortranarray(rows.reshape(-1, 3)), np.arange(123).reshape(-1, 3))
        grid = (-2,) * 3, cell, (40,) * 3
        expected = tribox.voxelize(rows.astype(float), grid)
        for form in (rows, columns, tribox.Soup.of(rows), np.asfortranarray(rows)):
            self.assert_same(tribox.voxelize(form, grid), expected)

    def test_beyond_memory(self):
        """A grid of 2^60 cells has windows; the whole of it is refused."""
        grid = (-2, -2, -2), 2.0 ** -18, (1 << 20,) * 3
        near = self.triangles[:40]
        corner = np.floor((near[0, 0] + 2) * 2 ** 18).astype(int) - 20
        cells = np.array(tribox.voxelize(near, grid, window=(corner, (70, 40, 40))))
        for k, j, i in np.argwhere(cells)[::97]:
            lo = (corner + (i, j, k)) * 2.0 ** -18 - 2
            self.assertTrue(tribox.overlap_any(near, lo, lo + 2.0 ** -18))
        self.assertTrue(cells.any())
        self.refuse(tribox.InputError, "BAD_GRID", "16 at most; give a window", tribox.voxelize, near, grid)

    def test_refused(self):
        for wrong in (3, (0, 1), ((0, 0, 0),), ((0, 0, 0), (132, 1, 1)), ((0, -1, 0), (1, 1, 1)), ((0, 0, 33), (1, 1, 1)),
                      ((0, 0, 0), (1, 1)), ((0, 0, 0), (1, 1, 1.5)), ((0, 0, 0), (1, 1, -1)), "window",
                      ((0, 0, 1 << 70), (1, 1, 1))):
            for grid in GRIDS.values():
                self.refuse(tribox.InputError, None, r"^window = .*; give \(first, size\).* within the 131 x 50 x 33 cells",
                            tribox.voxelize, self.triangles, grid, window=wrong)
        both = dict(window=((0, 0, 0), (1, 1, 1)), layers=(0, 1))
        self.refuse(tribox.InputError, None, "layers and window exclude", tribox.voxelize, self.triangles, grid, **both)
        for wrong in (0, -1, 1.5, "2"):
            self.refuse(tribox.InputError, None, "^threads = .*; give a whole number", tribox.voxelize, self.triangles, grid,
                        threads=wrong)

    def ask_threads(self, form, grid, **keywords):
        whole = tribox.voxelize(form, grid, **keywords)
        part = tribox.voxelize(form, grid, layers=(7, 9), **keywords)
        for threads in (2, 3, None):
            self.assert_same(tribox.voxelize(form, grid, threads=threads, **keywords), whole)
            self.assert_same(tribox.voxelize(form, grid, threads=threads, layers=(7, 9), **keywords), part)
            before = np.zeros(whole.shape, bool)
            before[0, 0, :3] = True
            into = tribox.Voxels(before, whole.grid)
            self.assertIs(tribox.voxelize(form, grid, into=into, threads=threads, **keywords), into)
            self.assert_same(into, whole | before)

    def ways(self):
        """Each way in which threads share work out, whatever pays; and cells in fresh pages and in others."""
        slabs, shares = dict(START=0, CELLS=1e9, JOIN=1e12), dict(START=0, CELLS=1e9, JOIN=0)
        copies = dict(COPIED_COUNTS=range(1 << 22), COPIED_AT_ONCE=7, FEW=0)
        for way, mapped in ({}, 1 << 25), (slabs, 1 << 25), (slabs, 0), (shares, 0), ({**slabs, **copies}, 1 << 25):
            with mock.patch.multiple(_sharing, processors=lambda: 64, **way), mock.patch.object(_pages, "MAPPED", mapped):
                yield way

    def test_threads(self):
        """As they are shared out, by layers and by triangles, whatever pays."""
        for _ in self.ways():
            for grid in GRIDS.values():
                for form in cases.forms(self.triangles):
                    self.ask_threads(form, grid)
            for accuracy in "conservative", "fast":
                for form in cases.forms(self.triangles):
                    self.ask_threads(form, GRIDS["floats"], accuracy=accuracy)
                    self.ask_threads(tribox.Soup.of(self.triangles[:1]), GRIDS["floats"], accuracy=accuracy)
            self.ask_threads(np.zeros((0, 3, 3), np.float32), GRIDS["floats"])
            self.ask_threads(tribox.Mesh(np.zeros((0, 3)), np.zeros((0, 3), int)), GRIDS["floats"])
            self.ask_threads(self.triangles, GRIDS["floats"], axes=tribox.AXES_PLANE)

    def test_sizes(self):
        """Threads on both sides of what decides how they share, and of large pages."""
        for count, size in (40, 16), (40, 600), (3000, 300), (1 << 15, 64), (1 << 16, 200), (1 << 19, 64), (1 << 19, 300):
            triangles = tribox.Soup.of(np.resize(cases.lattice(40) / 64, (count, 3, 3)))
            grid = (*GRIDS["floats"][:2], (size,) * 3)
            expected = tribox.voxelize(triangles, grid).words
            for threads in (2, 3, 8):
                with mock.patch.object(_sharing, "processors", lambda: 8):
                    self.assert_same(tribox.voxelize(triangles, grid, threads=threads).words, expected)

    def test_work(self):
        """No more work at once than processors, and no cells and triangles again where that is most of the work."""
        calls = []

        def look(task, held_, first, size, words):
            calls.append((held_.struct.count, size[2]))
            return call(task, held_, first, size, words)

        call = _sharing.Task.set
        for count, size in (40, 16), (40, 600), (1 << 16, 16), (1 << 16, 200), (1 << 19, 64), (1 << 19, 300):
            triangles = np.resize(cases.lattice(40) / 64, (count, 3, 3))
            for threads in (1, 2, 64):
                calls.clear()
                with mock.patch.object(_sharing.Task, "set", look), mock.patch.object(_sharing, "processors", lambda: 2):
                    tribox.voxelize(triangles, (*GRIDS["floats"][:2], (size,) * 3), threads=threads)
                looked, layers = (sum(each) for each in zip(*calls))
                self.assertTrue(looked == count or layers == size and looked <= max(2 * count, 1 << 11), (count, size, calls))
                self.assertLessEqual(len(calls), 2 * _sharing.SHARES_EACH)

    def test_cut(self):
        """Layers are cut where their work is, and none is lost, of whatever triangles."""
        high = np.array([[0, 0, 30], [64, 0, 30.5], [0, 64, 31]], np.float32)
        mixed = np.concatenate([np.full((9, 3, 3), np.nan), np.full((9, 3, 3), np.inf), np.full((9, 3, 3), 1e300), self.triangles])
        for triangles in np.resize(high, (5000, 3, 3)), mixed, self.triangles[:0]:
            grid = tribox.Grid((0, 0, 0), 1, (64, 64, 40))
            for size in grid.size, (64, 64, 1), (3, 5, 40):
                for parts in (1, 2, 3, 50):
                    work = _layers.LayersWork(tribox._triangles.held(triangles), grid, (0, 0, 0), size, tribox.AXES_ALL, 100)
                    cuts = work.cut(parts)
                    self.assertEqual([k for low, high in cuts for k in range(low, high)], list(range(size[2])))
                    self.assertLessEqual(len(cuts), parts)
        many = tribox.Mesh(np.resize(high, (5000, 3, 3)))
        halves = _layers.LayersWork(many, grid, (0, 0, 0), grid.size, tribox.AXES_ALL, 100).cut(2)
        self.assertIn(halves[0][1], (30, 31))

    def test_bad_indices_by_threads(self):
        """A wrong index in the last share: no other share has written."""
        vertices, faces = cases.shared_vertices(self.triangles, np.uint32)
        faces[-1, 2] = len(vertices)
        wrong, into = tribox.Mesh(vertices, faces), tribox.voxelize(self.triangles[:0], GRIDS["floats"])
        for _ in self.ways():
            self.refuse(tribox.BadIndexError, "BAD_VERTEX", rf"faces\[{len(faces) - 1}, 2\]", tribox.voxelize, wrong, into.grid,
                        threads=2, into=into)
            self.assertFalse(into.words.any())

    def test_pages(self):
        """Fresh pages are clear, and given back with the last array that looks at them."""
        def mapped():
            with open("/proc/self/status") as status:
                return int(next(line for line in status if line.startswith("VmSize")).split()[1]) >> 10

        before = mapped()
        for _ in range(3):
            words, are_clear = _pages.new_words((1, 1 << 12, 1 << 14))
            self.assertTrue(are_clear)
            self.assertTrue(not words.any() and words.flags.writeable and not words.ctypes.data % _pages.LARGE_PAGE)
            part = words[0, -1, :]
            del words
            part[-1] = 1
            self.assertGreater(mapped(), before + 400)
            del part
            self.assertLess(mapped(), before + 100)


class Insides(cases.TestCase):
    def test_box(self):
        for dtype in (np.float32, float):
            mesh = box_mesh((-1.5, -1, -0.5), (1, 0.75, 1.25)).astype(dtype)
            for grid in GRIDS.values():
                surface = np.array(tribox.voxelize(mesh, grid))
                k, j, i = np.nonzero(surface)
                solid = surface.copy()
                solid[k.min():k.max() + 1, j.min():j.max() + 1, i.min():i.max() + 1] = True
                self.assertGreater(solid.sum(), 2 * surface.sum())
                for form in (mesh, tribox.Mesh(mesh.reshape(-1, 3), np.arange(36).reshape(-1, 3)), tribox.Soup.of(mesh)):
                    for fill in ("outside", "parity"):
                        with warnings.catch_warnings():
                            warnings.simplefilter("error")
                            self.assert_same(tribox.voxelize(form, grid, fill=fill), solid)
                            self.assert_same(tribox.voxelize(form, grid, fill=fill, threads=2), solid)

    def test_open(self):
        """Without its lids the box is empty by flood, and by parity along x full, with a warning where it has one side alone."""
        mesh, grid = box_mesh((-1.5, -1, -0.5), (1, 0.75, 1.25)), GRIDS["floats"]
        surface = tribox.voxelize(mesh[4:], grid)
        self.assert_same(tribox.voxelize(mesh[4:], grid, fill="outside"), surface)
        with self.assertWarnsRegex(tribox.OpenMeshWarning, "the mesh is not closed: [0-9]+ of 1650 rows") as caught:
            tribox.voxelize(mesh[:-2], grid, fill="parity")
        self.assertEqual(caught.filename, __file__)

    def test_into(self):
        """Cells that were set before are no part of the surface."""
        mesh, grid = box_mesh((-1.5, -1, -0.5), (1, 0.75, 1.25)), GRIDS["floats"]
        solid = tribox.voxelize(mesh, grid, fill="outside")
        before = np.zeros(solid.shape, bool)
        before[:, :, :2] = before[:, :, -2:] = before[:, :2] = before[:, -2:] = before[:2] = before[-2:] = True
        into = tribox.Voxels(before, solid.grid)
        self.assertIs(tribox.voxelize(mesh, grid, fill="outside", into=into), into)
        self.assert_same(into, before | solid)

    def test_refused(self):
        mesh, grid = box_mesh((0, 0, 0), (1, 1, 1)), GRIDS["floats"]
        for wrong in ("flood", True, 3):
            self.refuse(tribox.InputError, None, "^fill = .*; give None or one of 'outside', 'parity'", tribox.voxelize, mesh,
                        grid, fill=wrong)
        for part in (dict(layers=(0, 1)), dict(window=((0, 0, 0), (1, 1, 1)))):
            self.refuse(tribox.InputError, None, "fill needs the whole grid", tribox.voxelize, mesh, grid, fill="outside", **part)


if __name__ == "__main__":
    cases.main()
