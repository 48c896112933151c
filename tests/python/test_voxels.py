"""Voxels, an array that knows its grid; grids around triangles; insides, bricks and lists of cells where answers.c has none."""

import copy
import dataclasses
import inspect
import json
import os
import pickle
import subprocess
import tempfile
import unittest
import warnings
from fractions import Fraction
from types import SimpleNamespace
from unittest import mock

import numpy as np
import tribox

import cases
from cases import GRIDS

TENTHS = (-2.1, -1.4, -1.1), (0.7, 0.3, 0.3), (7, 8, 9)


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
        for name in ("nothing", "vertices"):
            self.assertRaises(AttributeError, getattr, voxels, name)

    def test_stay(self):
        """Bits of one grid and windows of it are Voxels, with the ids and the cells inside of a window."""
        told = tribox.voxelize(self.triangles, GRIDS["floats"], ids=True)
        solid = tribox.voxelize(self.triangles, GRIDS["floats"], fill="outside", labels=True)
        a, b, numbers = np.array(told), np.array(solid), np.full(told.shape, -1)
        numbers[a] = told.ids
        for call in (lambda a, b: a & b, lambda a, b: a | b, lambda a, b: a ^ b, lambda a, b: ~a, lambda a, b: np.logical_not(b),
                     lambda a, b: np.logical_or(b, a)):
            voxels = call(told, solid)
            self.assert_same(np.asarray(voxels), call(a, b))
            self.assertEqual((voxels.grid, voxels.window, voxels.sum()), (told.grid, told.window, np.count_nonzero(call(a, b))))
        for key in (np.s_[2:30], np.s_[:, 4:], np.s_[-7:, 3:20, 60:129], np.s_[5:2, :, -1:], np.s_[:], np.s_[..., 3:60],
                    np.s_[2:9, ..., 5:], np.s_[...]):
            part, other = told[key], solid[key]
            self.assert_same(np.asarray(part), a[key])
            self.assert_same(part.ids.astype(int), numbers[key][a[key]])
            self.assert_same(other.labels(), solid.labels()[key])
            self.assert_same(part.cells(), tribox.voxelize(self.triangles, GRIDS["floats"], window=part.window).cells())
            self.assert_same(np.asarray(part[1:]), a[key][1:])
        for other, pattern in ((told[1:], "give Voxels of one grid"), (self.voxels, "0.7, 0.3, 0.3.*give Voxels of one grid")):
            self.refuse(tribox.InputError, None, pattern, lambda: told & other)

    def test_is_read(self):
        """What they hold is not written by mistake; a copy can be."""
        voxels = self.voxels
        for call in (lambda: np.asarray(voxels).fill(True), lambda: voxels.words.fill(0), lambda: setattr(voxels, "grid", None)):
            self.assertRaises((ValueError, AttributeError), call)
        with self.assertRaises(TypeError):
            voxels[0, 0, 0] = True
        with self.assertRaisesRegex(TypeError, "Voxels are read-only; write a = a [|] b"):
            voxels |= voxels
        np.array(voxels)[:] = True
        self.assert_same(voxels, self.array)
        with self.assertRaises(dataclasses.FrozenInstanceError):
            tribox.cell_lists(self.triangles, TENTHS).grid = None

    def test_lazily(self):
        """To count cells, and to find them, takes no bools."""
        with mock.patch("tribox._voxels.bools", side_effect=AssertionError):
            voxels = tribox.voxelize(self.triangles, TENTHS)
            self.assertEqual((voxels.sum(), len(voxels.points())), (self.array.sum(), self.array.sum()))
            repr(voxels)

    def test_cells(self):
        for window in (None, ((0, 0, 0), (7, 8, 9)), ((2, 3, 1), (4, 2, 7)), ((2, 3, 1), (4, 0, 7)), ((0, 0, 9), (0, 0, 0))):
            voxels = tribox.voxelize(self.triangles, TENTHS, window=window)
            expected = np.argwhere(np.array(voxels))[:, ::-1] + voxels.window[0]
            self.assert_same(voxels.cells(), expected.astype(np.int64))
            points = voxels.points()
            self.assertEqual((points.dtype, points.shape), (np.float64, expected.shape))
            for cell, point in zip(voxels.cells(), points):
                lo, hi = map(np.array, voxels.grid.box(*cell))
                np.testing.assert_allclose(point, (lo + hi) / 2, 1e-15, 1e-15)
                self.assertTrue(tribox.overlap_any(self.triangles, lo, hi))
        for width in (1, 7, 63, 64, 65, 130, 257):
            voxels = tribox.voxelize(self.triangles, ((-2, -1.5, -1), (3.5 / width, 0.375, 0.25), (width, 8, 9)))
            words, bools = voxels.words, np.asarray(voxels)
            self.assertEqual((words.dtype, words.shape), (np.uint64, (9, 8, (width + 63) // 64)))
            self.assert_same(voxels.cells(), np.argwhere(bools)[:, ::-1].copy())
            self.assert_same(np.unpackbits(words.astype("<u8").view(np.uint8), -1, bitorder="little").astype(bool),
                             np.pad(bools, ((0, 0), (0, 0), (0, -width % 64))))
            np.testing.assert_array_equal(tribox.Voxels(bools, voxels.grid).words, words)
            self.assert_same(tribox.Voxels(words, voxels.grid), bools)

    def test_copies(self):
        part = tribox.voxelize(self.triangles, TENTHS, window=((1, 2, 3), (4, 5, 6)))
        for voxels in (self.voxels, part):
            for other in (pickle.loads(pickle.dumps(voxels)), copy.copy(voxels), copy.deepcopy(voxels)):
                self.assert_same(other, np.array(voxels))
                self.assertEqual((other.grid, other.window), (voxels.grid, voxels.window))
        told = [tribox.voxelize(self.triangles, TENTHS, **more) for more in (dict(ids=True), dict(fill="outside", labels=True))]
        ids, labels = (pickle.loads(pickle.dumps(voxels)) for voxels in told)
        self.assert_same(ids.ids, told[0].ids)
        self.assert_same(labels.labels(), told[1].labels())
        tribox.voxelize(self.triangles, TENTHS, into=ids)
        self.refuse(tribox.InputError, None, "have no ids", lambda: ids.ids)

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


def by_program(triangles, way, value):
    """The Grid and the packed words of tribox voxelize."""
    with tempfile.TemporaryDirectory() as folder:
        out, form = os.path.join(folder, "cells.raw"), f"f{8 * triangles.itemsize}"
        done = subprocess.run([os.environ["TRIBOX_PROGRAM"], "voxelize", "-", "--format", form, f"--{way}",
                               repr(float(value)).removesuffix(".0"), "-o", out, "--json"], input=triangles.tobytes(),
                              capture_output=True, timeout=120, check=True)
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
    def check_around(self, triangles, grid):
        corners = triangles.reshape(-1, 3).astype(float)
        lo, hi = grid.box(0, 0, 0)[0], grid.box(*(size - 1 for size in grid.size))[1]
        self.assertEqual(lo, tuple(corners.min(0)))
        self.assertTrue((hi >= corners.max(0)).all())
        for axis, size in enumerate(grid.size):
            if size > 1:
                last = grid.box(*(grid.size[a] - 1 if a == axis else 0 for a in range(3)))[0][axis]
                self.assertLess(last, corners.max(0)[axis])

    @unittest.skipUnless("TRIBOX_PROGRAM" in os.environ, "built without the program")
    def test_like_the_program(self):
        for number, triangles in enumerate(meshes()):
            sides = np.ptp(triangles.reshape(-1, 3).astype(float), 0)
            for way, value in (*(("resolution", n) for n in (1, 3, 64, 100)), *(("cell", sides.max() / n) for n in (30, 32))):
                grid, words = by_program(triangles, way, value)
                self.assertEqual(tribox.grid_around(triangles, **{way: value}), grid, number)
                answer = tribox.voxelize(triangles, **{way: value}, threads=2)
                self.assertEqual(answer.grid, grid)
                self.assert_same(answer.words, words, number)

    def test_around(self):
        """The same for each call; the planes hold the mesh, and the cell is the very number that was given."""
        for triangles in meshes():
            longest = np.ptp(triangles.reshape(-1, 3).astype(float), 0).max()
            sides = np.maximum(np.ptp(triangles.reshape(-1, 3).astype(float), 0), longest / 64)
            for way in (dict(resolution=9), dict(cell=longest / 7), dict(cell=np.float64(longest / 8)),
                        dict(cell=tuple(sides / (5, 6, 7)))):
                voxels, grid = tribox.voxelize(triangles, **way), tribox.grid_around(triangles, **way)
                self.check_around(triangles, grid)
                self.assertEqual(max(grid.size) if "resolution" in way else grid.cell,
                                 way.get("resolution") or tuple(np.broadcast_to(way["cell"], 3)))
                self.assertEqual((voxels.grid, voxels.window), (grid, ((0, 0, 0), grid.size)))
                bricks, lists = tribox.bricks(triangles, **way), tribox.cell_lists(triangles, **way)
                layer = tribox.voxelize(triangles, layers=(0, 1), **way)
                self.assertEqual((bricks.grid, lists.grid, layer.grid), (grid,) * 3)
                self.assert_same(tribox.voxelize(triangles.astype(float), grid), np.array(voxels))
                self.assert_same(layer, voxels[:1])
                self.assert_same(lists.cells.astype(np.int64), voxels.cells())
                self.assert_same(lists.points(), voxels.points())
                self.assertEqual(sorted(bricks.points().tolist()), sorted(voxels.points().tolist()))
        self.assertEqual(tribox.voxelize(np.full((1, 3, 3), 0.1), cell=1), np.ones((1, 1, 1), bool))

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
        with self.assertRaises(AttributeError):
            grid.cell = 1
        self.assertEqual((tribox.tile_count((128, 129, 1)), tribox.tile_count((1 << 20,) * 3, 8)), (2, 1 << 51))

    def test_forms(self):
        """What is not finite, and vertices that no face names, do not count."""
        triangles = cases.scattered(40)
        grid = tribox.grid_around(triangles, 77)
        vertices, faces = cases.shared_vertices(triangles, np.uint32)
        far = np.full((3, 3), 1e30, np.float32)
        for wrong in (np.nan, np.inf, -np.inf):
            broken = np.array([far], np.float32)
            broken[0, 1, 2] = wrong
            mixed = np.concatenate([broken, triangles, broken])
            more = tribox.Mesh(np.concatenate([vertices, far, np.array([[wrong, 0, 0]], np.float32)]),
                               np.concatenate([faces, [[0, 1, len(vertices) + 3], [len(vertices) + 3, 2, len(vertices)]]]))
            for form in (mixed, more, tribox.Soup.of(mixed), np.asfortranarray(mixed)):
                self.assertEqual(tribox.grid_around(form, 77), grid)


class Sparse(cases.TestCase):
    """Windows, bricks and lists of grids of any size."""

    def test_beyond_memory(self):
        """Bricks and lists of grids of which no memory holds the cells; of the second, not even the tiles."""
        near = (cases.some()[:20] / 512).astype(np.float32)
        grid = tribox.Grid((-0.03125,) * 3, 2.0 ** -18, (1 << 14,) * 3)
        bricks = tribox.bricks(near, grid, threads=2)
        self.assertGreater(len(bricks.at), 20)
        for at, bits in list(zip(bricks.at, bricks.bits))[::len(bricks.at) // 20]:
            window = tribox.voxelize(near, grid, window=(8 * at.astype(int), (8, 8, 8)))
            octets = bits.astype("<u8").view(np.uint8).reshape(8, 8, 1)
            self.assert_same(np.unpackbits(octets, -1, bitorder="little").astype(bool), window)
        near = near[:6] / np.float32(8)
        for grid in (grid, tribox.Grid((-4.7,) * 3, 0.7e-5, ((1 << 20) + 5,) * 3)):
            lists = tribox.cell_lists(near, grid, threads=2)
            self.assertGreater(len(lists.cells), 100)
            found = {tuple(cell): lists.triangles[a:b].tolist() for cell, a,
                     b in zip(lists.cells.tolist(), lists.start, lists.start[1:])}
            steps = np.random.default_rng(cases.seed()).integers(-1, 2, (200, 3))
            for cell in [*lists.cells[::1 + len(found) // 200], *(lists.cells[:200].astype(int) + steps[:len(found)])]:
                numbers = np.flatnonzero(tribox.overlap(near, *grid.box(*map(int, cell)))).tolist()
                self.assertEqual(found.get(tuple(cell.tolist()), []), numbers)
        large = (-2, -2, -2), 1, (1 << 12, 1 << 10, 1 << 15)
        self.assertEqual(tribox.voxelize(near, large, layers=(3, 1)).window, ((0, 0, 3), (1 << 12, 1 << 10, 1)))

    def test_options(self):
        triangles, grid = cases.some(), GRIDS["doubles"]
        for options in (dict(kernel="scalar"), dict(axes=tribox.AXES_BOX), dict(axes=tribox.AXES_PLANE)):
            cells = tribox.voxelize(triangles, grid, **options).cells()
            self.assert_same(tribox.cell_lists(triangles, grid, **options).cells.astype(np.int64), cells)
            self.assertEqual(sorted(tribox.bricks(triangles, grid, side=32, **options).cells().tolist()), sorted(cells.tolist()))
        lists = [tribox.cell_lists(triangles, grid, accuracy=word) for word in ("exact", "conservative", "fast")]
        pairs = [{(*cell, number) for cell, a, b in zip(one.cells.tolist(), one.start, one.start[1:])
                  for number in one.triangles[a:b]} for one in lists]
        self.assertTrue(pairs[0] <= pairs[1] and pairs[0] <= pairs[2])
        more = tribox.voxelize(triangles, grid, accuracy="conservative")
        self.assertTrue((more >= np.asarray(tribox.voxelize(triangles, grid))).all())

    def test_nothing(self):
        triangles = cases.some()
        for nothing in (triangles[:0], np.full((5, 3, 3), np.nan, np.float32), triangles + np.float32(1e20)):
            for grid in (*GRIDS.values(), ((0, 0, 0), 1, (1 << 30,) * 3)):
                bricks = tribox.bricks(nothing, grid, side=1024, tiles=(0, 1), ids=True)
                lists = tribox.cell_lists(nothing, grid, threads=2)
                self.assertEqual((bricks.at.shape, bricks.bits.shape, bricks.cells().shape, bricks.ids.shape),
                                 ((0, 3), (0, 8), (0, 3), (0,)))
                self.assertEqual((bricks.at.dtype, bricks.bits.dtype), (np.uint32, np.uint64))
                self.assertEqual((lists.cells.shape, lists.start.tolist(), lists.triangles.shape, lists.points().shape),
                                 ((0, 3), [0], (0,), (0, 3)))
            self.assertEqual(len(tribox.voxelize(nothing, GRIDS["floats"], ids=True).ids), 0)
        self.assertEqual(len(tribox.voxelize(triangles, GRIDS["floats"], window=((1, 1, 1), (0, 2, 2)), ids=True).ids), 0)

    def test_too_large(self):
        """The bound that lists of cells are refused by is never more than the answer has."""
        for triangles in (cases.some(), cases.some().astype(float)):
            for grid in GRIDS.values():
                count = len(tribox.cell_lists(triangles, grid).triangles)
                with mock.patch("tribox._cells.NUMBERS_MAX", count), mock.patch("tribox._cells.BLOCK", 7):
                    tribox.cell_lists(triangles, grid)
        flat = np.array([[[0, 0, 1], [64, 0, 1], [0, 64, 1]]], np.float32)
        with mock.patch("tribox._cells.NUMBERS_MAX", 2047):
            self.refuse(tribox.InputError, None, "at least 2.05e.03 numbers", tribox.cell_lists, flat, ((0, 0, 0), 1, (64, 64, 2)))


def torus(pick, around=40, across=20, tube=0.37):
    """Vertices, in floats, and faces of a torus that lies anyhow."""
    u, v = np.meshgrid(np.arange(around) * 2 * np.pi / around, np.arange(across) * 2 * np.pi / across, indexing="ij")
    far = 1 + tube * np.cos(v)
    points = np.stack([far * np.cos(u), far * np.sin(u), tube * np.sin(v)], -1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    a, b, c, d = ((i + x) % around * across + (j + y) % across for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
    turn = np.linalg.qr(pick.normal(size=(3, 3)))[0]
    faces = [np.stack(three, -1).reshape(-1, 3) for three in ((a, b, c), (a, c, d))]
    return (points @ turn).astype(np.float32), np.concatenate(faces)


class Insides(cases.TestCase):
    def test_closed(self):
        """What fills, labels and the thin surface of one mesh have to do with each other."""
        pick = np.random.default_rng(cases.seed())
        for number in range(12):
            points, faces = torus(pick, *((12, 8) if number % 2 else ()))
            mesh = tribox.Mesh(points.astype(pick.choice([np.float32, np.float64])), faces)
            surface = tribox.voxelize(mesh, resolution=int(pick.integers(20, 120)))
            grid, full = surface.grid, np.asarray(surface)
            thin, thin2 = (np.asarray(tribox.voxelize(mesh, grid, thin=True, threads=threads)) for threads in (1, 2))
            self.assert_same(thin, thin2)
            self.assertFalse((thin & ~full).any())
            middles = np.asarray(tribox.voxelize(mesh, grid, fill="middles"))
            self.assert_same(np.asarray(tribox.voxelize(mesh, grid, thin=True, fill="parity")), thin | middles)
            self.assertFalse((middles & ~np.asarray(tribox.voxelize(mesh, grid, thin=True, fill="outside"))).any())
            self.assert_same(tribox.voxelize(mesh, grid, thin=True, fill="parity", labels=True).labels() == 1, thin)
            into = tribox.voxelize(mesh, grid, fill="middles", into=tribox.Voxels(surface.words.copy(), grid))
            self.assert_same(np.asarray(into), full | middles)
            for fill in ("outside", "parity"):
                plain = tribox.voxelize(mesh, grid, fill=fill)
                self.assertIsNone(plain.inside)
                voxels = tribox.voxelize(mesh, grid, fill=fill, labels=True, threads=1 + number % 2)
                self.assert_same(np.asarray(voxels), np.asarray(plain))
                self.assert_same(voxels.labels(), np.asarray(plain).astype(np.uint8) * 2 - full)
                self.assert_same(np.asarray(voxels.inside), voxels.labels() == 2)
                self.assertEqual((voxels.inside.grid, voxels.inside.window), (grid, voxels.window))

    def test_into(self):
        """Cells that were set before are no part of the surface."""
        points, faces = torus(np.random.default_rng(cases.seed()))
        grid = tribox.Grid((-2, -2, -2), 0.125, (32, 32, 32))
        solid = tribox.voxelize((points, faces), grid, fill="outside")
        before = np.zeros(solid.shape, bool)
        before[:, :, :2] = before[:, :, -2:] = before[:, :2] = before[:, -2:] = before[:2] = before[-2:] = True
        into = tribox.Voxels(before, solid.grid)
        self.assertIs(tribox.voxelize((points, faces), grid, fill="outside", into=into), into)
        self.assert_same(into, before | solid)

    def test_open(self):
        """Who fills an open mesh is warned, and nobody else."""
        points, faces = torus(np.random.default_rng(cases.seed()))
        for fill, pattern in (*((fill, "the mesh is not closed: [0-9]+ of [0-9]+ rows") for fill in ("middles", "parity")),
                              ("outside", "fills nothing: the surface is open by a cell or more, or encloses none; give larger")):
            for mesh in faces[:-30], faces:
                with warnings.catch_warnings(record=True) as caught:
                    warnings.simplefilter("always")
                    tribox.voxelize(tribox.Mesh(points, mesh), resolution=50, fill=fill)
                self.assertEqual([(one.category, one.filename) for one in caught],
                                 [(tribox.OpenMeshWarning, __file__)] * (mesh is not faces))
                for one in caught:
                    self.assertRegex(str(one.message), pattern)


if __name__ == "__main__":
    cases.main()
