"""tribox.voxelize: by definition tribox.overlap of every triangle with every cell. Voxels: an array that knows its grid."""

import copy
import inspect
import pickle
import re
from fractions import Fraction
from types import SimpleNamespace
from unittest import mock

import numpy as np
import tribox

import cases

GRID = ORIGIN, CELL, SIZE = (-2, -1.5, -1), (0.5, 0.375, 0.25), (7, 8, 9)
TENTHS = (-2.1, -1.4, -1.1), (0.7, 0.3, 0.3), (7, 8, 9)


def plane(number, origin, cell):
    """Where plane p of an axis lies: rounded once."""
    return float(Fraction(origin) + number * Fraction(cell))


def corners(grid, i, j, k):
    origin, cell, _ = grid
    return tuple([plane(at + past, *axis) for at, *axis in zip((i, j, k), origin, cell)] for past in (0, 1))


def cell_by_cell(triangles, grid, **options):
    """Asks tribox.overlap about every cell."""
    answer = np.zeros(grid[2][::-1], bool)
    for k, j, i in np.ndindex(*answer.shape):
        answer[k, j, i] = tribox.overlap(triangles, *corners(grid, i, j, k), **options).any()
    return answer


class Voxelize(cases.TestCase):
    def setUp(self):
        self.triangles = np.concatenate([cases.lattice(12) / 2, cases.scattered(12)])
        self.expected = cell_by_cell(self.triangles, GRID)
        self.assertTrue(self.expected.any() and not self.expected.all())

    def forms(self):
        yield self.triangles
        yield self.triangles.astype(float)
        yield tribox.Mesh(*cases.shared_vertices(self.triangles, np.int32))
        yield tribox.Soup.of(self.triangles)
        yield np.asfortranarray(self.triangles)

    def test_forms(self):
        for grid in (GRID, TENTHS, tribox.Grid(*GRID), tribox.Grid(*TENTHS)):
            origin, cell, size = grid
            expected = cell_by_cell(self.triangles, (origin, cell, size))
            for form in self.forms():
                self.assert_same(tribox.voxelize(form, grid), expected)

    def test_rational(self):
        """A few triangles, in exact rational numbers."""
        few = self.triangles[:3]
        for origin, cell, _ in (GRID, TENTHS):
            answer = tribox.voxelize(few, (origin, cell, (3, 4, 5)))
            for k, j, i in np.ndindex(5, 4, 3):
                self.assertEqual(answer[k, j, i], cases.truth(few, *corners((origin, cell, None), i, j, k)).any())

    def test_stated_planes(self):
        """Floats, too, are in the cells that origin and cell state: a point a hair beside a plane that no float32 is."""
        grid = tribox.Grid((0, 0, 0), 0.1, (100, 1, 1))
        for number in range(1, 100):
            at = number * 0.1
            for x in (np.nextafter(np.float32(at), np.float32(-1)), np.float32(at), np.nextafter(np.float32(at), np.float32(99))):
                expected = [plane(i, 0, 0.1) <= float(x) <= plane(i + 1, 0, 0.1) for i in range(100)]
                point = np.full((1, 3, 3), [x, 0, 0], np.float32)
                self.assert_same(tribox.voxelize(point, grid)[0, 0], np.array(expected))

    def test_options(self):
        self.assert_same(tribox.voxelize(self.triangles, GRID, kernel="scalar"), self.expected)
        self.assertTrue(np.all(tribox.voxelize(self.triangles, GRID, accuracy="conservative") >= self.expected))
        for axes in (tribox.AXES_BOX, tribox.AXES_BOX | tribox.AXES_PLANE):
            self.assert_same(tribox.voxelize(self.triangles, GRID, axes=axes), cell_by_cell(self.triangles, GRID, axes=axes))
        self.assert_same(tribox.voxelize(self.triangles, (np.array(ORIGIN), np.float32(0.5), np.array(SIZE))),
                         tribox.voxelize(self.triangles, tribox.Grid(ORIGIN, (0.5, 0.5, 0.5), SIZE)))

    def test_words(self):
        for width in (1, 7, 63, 64, 65, 130):
            voxels = tribox.voxelize(self.triangles, (ORIGIN, (3.5 / width, 0.375, 0.25), (width, 8, 9)))
            words, bools = voxels.words, np.asarray(voxels)
            self.assertEqual((words.dtype, words.shape), (np.uint64, (9, 8, (width + 63) // 64)))
            for i in range(64 * words.shape[2]):
                bit = (words[..., i // 64] >> np.uint64(i % 64)) & np.uint64(1)
                np.testing.assert_array_equal(bit, bools[..., i] if i < width else 0 * bit)
            again = tribox.Voxels(bools, voxels.grid)
            np.testing.assert_array_equal(again.words, words)
            self.assert_same(tribox.Voxels(words, voxels.grid), bools)

    def test_into(self):
        first, second = self.triangles[::2].copy(), self.triangles[1::2].copy()
        for window in (None, ((1, 0, 2), (5, 8, 3))):
            into = tribox.voxelize(first[:0], GRID, window=window)
            self.assertFalse(into.any())
            for part in (first, second, first[:0]):
                self.assertIs(tribox.voxelize(part, GRID, window=window, into=into), into)
            self.assert_same(into, tribox.voxelize(self.triangles, GRID, window=window))
        for wrong, error in ((np.zeros(SIZE[::-1], bool), tribox.InputTypeError), (True, tribox.InputTypeError),
                             (tribox.voxelize(first, TENTHS), tribox.InputError),
                             (tribox.voxelize(first, GRID, layers=(0, 8)), tribox.InputError)):
            self.refuse(error, None, "^into ", tribox.voxelize, first, GRID, into=wrong)

    def test_layers(self):
        for form in self.forms():
            parts = [tribox.voxelize(form, GRID, layers=layers) for layers in ((0, 2), (2, 0), (2, 6), (8, 1))]
            self.assert_same(np.concatenate(parts), self.expected)
        layer = tribox.voxelize(self.triangles, (ORIGIN, CELL, (1 << 12, 1 << 10, 1 << 15)), layers=(3, 1))
        self.assertEqual((layer.shape, layer.window), ((1, 1 << 10, 1 << 12), ((0, 0, 3), (1 << 12, 1 << 10, 1))))

    def test_blocks(self):
        """What decides comes last of very many."""
        far = np.full((2 * 65536 + 7, 3, 3), 99, np.float32)
        far[-len(self.triangles):] = self.triangles
        for form in (far, tribox.Soup.of(far)):
            self.assert_same(tribox.voxelize(form, GRID), self.expected)

    def test_nothing(self):
        self.assertFalse(tribox.voxelize(self.triangles[:0], GRID).any())
        self.assertFalse(tribox.voxelize(np.full((5, 3, 3), np.nan, np.float32), GRID).any())


class Arrays(cases.TestCase):
    """Voxels are used as the array of bool that they stand for."""

    def setUp(self):
        self.triangles = cases.lattice(40)
        self.voxels = tribox.voxelize(self.triangles, TENTHS)
        self.array = np.array(self.voxels)
        self.assertTrue(self.array.any() and not self.array.all())

    def test_like_an_array(self):
        voxels, array = self.voxels, self.array
        self.assertEqual((voxels.shape, voxels.dtype, voxels.ndim, voxels.size, len(voxels)), ((9, 8, 7), bool, 3, array.size, 9))
        self.assertIs(type(array), np.ndarray)
        for call in (lambda a: a.sum(), np.sum, np.count_nonzero, lambda a: a.sum(axis=1), lambda a: np.sum(a, axis=(0, 2)), np.any,
                     lambda a: a.any(axis=0), lambda a: a.all(), np.argwhere, lambda a: ~a, lambda a: a | a[::-1], lambda a: a & 1,
                     lambda a: a == a.T.T, lambda a: a[3], lambda a: a[1:5, ::2], lambda a: a[-1, 0, 2], lambda a: a[a], list,
                     lambda a: a.astype(np.uint8), lambda a: a.T, lambda a: a.nonzero(), lambda a: np.pad(a, 1), np.asarray,
                     lambda a: a.tolist(), lambda a: np.stack([a, a]), lambda a: np.where(a, 1.5, 0), lambda a: a.mean(),
                     lambda a: array[a], lambda a: a != array, lambda a: array ^ a, lambda a: np.logical_or.reduce(a)):
            answer, expected = call(voxels), call(array)
            np.testing.assert_array_equal(answer, expected)
            self.assertEqual(np.asarray(answer).dtype, np.asarray(expected).dtype)
        self.assertRaises(ValueError, bool, voxels)
        self.assertRaises(AttributeError, lambda: voxels.nothing)
        self.assertRaises(AttributeError, lambda: voxels.vertices)

    def test_is_read(self):
        """What they hold is not written by mistake; a copy can be."""
        voxels = self.voxels
        for call in (lambda: np.asarray(voxels).fill(True), lambda: voxels.words.fill(0), lambda: setattr(voxels, "grid", None)):
            self.assertRaises((ValueError, AttributeError), call)
        with self.assertRaises(TypeError):
            voxels[0, 0, 0] = True
        with self.assertRaises(TypeError):
            voxels |= voxels
        np.array(voxels)[:] = True
        self.assert_same(voxels, self.array)

    def test_lazily(self):
        """To count cells, and to find them, takes no bools."""
        with mock.patch("tribox._voxels.bools", side_effect=AssertionError):
            voxels = tribox.voxelize(self.triangles, TENTHS)
            self.assertEqual(voxels.sum(), self.array.sum())
            self.assertEqual(len(voxels.points()), self.array.sum())
            repr(voxels)

    def test_cells(self):
        for window in (None, ((0, 0, 0), (7, 8, 9)), ((2, 3, 1), (4, 2, 7)), ((2, 3, 1), (4, 0, 7)), ((0, 0, 9), (0, 0, 0))):
            voxels = tribox.voxelize(self.triangles, TENTHS, window=window)
            first = voxels.window[0]
            expected = np.argwhere(np.array(voxels))[:, ::-1] + first
            self.assert_same(voxels.cells(), expected.astype(np.int64))
            points = voxels.points()
            self.assertEqual((points.dtype, points.shape), (np.float64, expected.shape))
            for cell, point in zip(voxels.cells(), points):
                lo, hi = map(np.array, corners(TENTHS, *cell))
                np.testing.assert_allclose(point, (lo + hi) / 2, 1e-15, 1e-15)
                self.assertTrue(tribox.overlap_any(self.triangles, lo, hi))
        wide = tribox.voxelize(self.triangles, ((-2, -2, -2), (1 / 64, 1, 1), (257, 4, 4)))
        self.assert_same(wide.cells(), np.argwhere(np.array(wide))[:, ::-1].copy())
        self.assertEqual(wide.sum(), np.array(wide).sum())

    def test_grid(self):
        self.assertEqual(self.voxels.grid, tribox.Grid(*TENTHS))
        self.assertEqual(self.voxels.window, ((0, 0, 0), (7, 8, 9)))
        for form in (dict(resolution=5), dict(cell=0.3)):
            voxels = tribox.voxelize(self.triangles, **form)
            self.assertEqual(voxels.grid, tribox.grid_around(self.triangles, **form))
            self.assert_same(tribox.voxelize(self.triangles, voxels.grid), np.array(voxels))

    def test_copies(self):
        part = tribox.voxelize(self.triangles, TENTHS, window=((1, 2, 3), (4, 5, 6)))
        for voxels in (self.voxels, part):
            for other in (pickle.loads(pickle.dumps(voxels)), copy.copy(voxels), copy.deepcopy(voxels)):
                self.assert_same(other, np.array(voxels))
                self.assertEqual((other.grid, other.window), (voxels.grid, voxels.window))

    def test_repr(self):
        self.assertEqual(repr(tribox.voxelize(self.triangles, ((-8, -8, -8), 8, (2, 2, 2)))),
                         "<tribox.Voxels: 8 of 2 x 2 x 2 cells, from (-8, -8, -8) to (8, 8, 8)>")
        self.assertEqual(repr(tribox.voxelize(self.triangles, ((-8, -8, -8), 8, (2, 2, 2)), window=((1, 0, 0), (1, 1, 1)))),
                         "<tribox.Voxels: 1 of 1 x 1 x 1 cells of a grid of 2 x 2 x 2 cells, from (0, -8, -8) to (8, 0, 0)>")
        repr(tribox.voxelize(self.triangles, TENTHS, layers=(9, 0)))

    def test_made(self):
        grid, refuse = tribox.Grid(*TENTHS), self.refuse
        refuse(tribox.InputTypeError, None, r"^grid = .*; give tribox\.Grid", tribox.Voxels, self.array, TENTHS)
        refuse(tribox.InputTypeError, None, "^cells is an array of uint8", tribox.Voxels, self.array.astype(np.uint8), grid)
        refuse(tribox.InputError, None, r"^cells has shape \(8, 8, 7\); give \(9, 8, 7\)", tribox.Voxels, self.array[1:], grid)
        refuse(tribox.InputError, None, r"give \(9, 8, 1\)", tribox.Voxels, np.zeros((9, 8, 2), np.uint64), grid)
        refuse(tribox.InputError, None, "^window = ", tribox.Voxels, self.array, grid, ((0, 0, 0), (7, 8, 10)))

    def lines_of_help(self, library):
        """The lines of the help text about another library's grids."""
        lines = inspect.getdoc(tribox.Voxels).partition(f"As a VoxelGrid of {library}")[2].partition(":\n\n")[2].split("\n\n")[0]
        return inspect.cleandoc(lines)

    def test_trimesh(self):
        """A cell's place in trimesh is transform @ (i, j, k, 1), its middle; encoding[i, j, k] says whether it is set."""
        made = []
        trimesh = SimpleNamespace(voxel=SimpleNamespace(VoxelGrid=lambda encoding, transform: made.append((encoding, transform))))
        for window in (None, ((1, 2, 3), (4, 5, 6))):
            voxels = tribox.voxelize(self.triangles, TENTHS, window=window)
            exec(self.lines_of_help("trimesh"), dict(np=np, trimesh=trimesh, voxels=voxels))
            encoding, transform = made.pop()
            places = np.argwhere(encoding)
            points = (transform @ np.column_stack([places, np.ones(len(places))]).T).T[:, :3]
            np.testing.assert_allclose(sorted(points.tolist()), sorted(voxels.points().tolist()), 1e-14, 1e-14)

    def test_open3d(self):
        """A cell's number in Open3D is that of its middle, counted from the lower bound."""
        made = []

        def create(cloud, side, lo, hi):
            made.append((np.floor((cloud - lo) / side).astype(int), np.round((hi - lo) / side)))

        geometry = SimpleNamespace(PointCloud=lambda points: points,
                                   VoxelGrid=SimpleNamespace(create_from_point_cloud_within_bounds=create))
        open3d = SimpleNamespace(geometry=geometry, utility=SimpleNamespace(Vector3dVector=lambda points: points))
        voxels = tribox.voxelize(self.triangles, cell=0.1)
        exec(self.lines_of_help("Open3D"), dict(np=np, open3d=open3d, voxels=voxels))
        cells, size = made.pop()
        self.assert_same(cells, voxels.cells())
        self.assertEqual(tuple(size), voxels.grid.size)
        self.assertLessEqual(max(len(re.findall(r"\n", self.lines_of_help(name))) for name in ("trimesh", "Open3D")), 2)


if __name__ == "__main__":
    cases.main()
