"""Every error is a tribox.Error that says what is wrong, where, and what to do: a table of wrong calls. Nothing is written."""

import errno
import os
import pickle
import subprocess
import sys
import tempfile
from types import SimpleNamespace
from unittest import mock

import numpy as np
import tribox
from tribox import BadIndexError, InputError, InputTypeError

import cases
from cases import GRIDS, HI, LO

NAN, INF = float("nan"), float("inf")
GRID = (0, 0, 0), 1, (4, 5, 6)
TRIANGLES = cases.lattice(70)
VERTICES, FACES = cases.shared_vertices(TRIANGLES, np.int32)
VOXELS, INDEX, GRID_OF_70 = tribox.voxelize(TRIANGLES, GRID), tribox.Index(TRIANGLES), tribox.Grid(*GRID)
NONE, WIDE, EYE = TRIANGLES[:0], TRIANGLES.astype(float), np.eye(3)
FORMS = (TRIANGLES, tribox.Soup.of(TRIANGLES), tribox.Mesh(VERTICES, FACES), NONE, tribox.Soup.of(NONE))
BOXED = tribox.overlap, tribox.overlap_any, tribox.overlap_all, tribox.classify, tribox.crop, tribox.find, tribox.split
INDICES = INDEX, tribox.Index(TRIANGLES, keep_order=True), tribox.Index(NONE)
GRIDDED = tribox.voxelize, tribox.bricks, tribox.cell_lists
OPTIONS = (("BAD_OPTION", "^axes = 8; give a union of AXES_BOX", dict(axes=8)), ("BAD_OPTION", "axes = -1", dict(axes=-1)),
           (None, "^accuracy = 'exakt'; give one of 'exact', 'conservative', 'fast'", dict(accuracy="exakt")),
           ("NO_KERNEL", "^kernel = 'sse9'; this processor runs .*scalar", dict(kernel="sse9")))
ORDER = ("BAD_OPTION", "^axis_order = 4; give one of 0, 123, 132, 213, 231, 312, 321", dict(axis_order=4))
THREE, WHOLE = "give three numbers: x, y, z", "give whole numbers"
WAYS = r"give cell, .*, or resolution, .*; or a grid: tribox\.Grid\(origin, cell, size\)"
ODD_POINTS = (1, 2), (1, 2, 3, 4), 1, "abc", (1, "x", 2), (1, None, 2), np.zeros((3, 2)), ()


def wrong_boxes():
    """(error, status, pattern, call, arguments, keywords) of calls about a box."""
    calls = [(call, form) for call in BOXED for form in FORMS]
    calls += [(call, None) for index in INDICES for call in (index.overlap, index.count, index.any, index.list)]
    for call, form in calls:
        first = [] if form is None else [form]
        for value in (NAN, INF, -INF, 10 ** 400, -10 ** 5000):
            yield InputError, "BAD_BOX", r"NaN or inf.*: lo = .*, hi = \(1, 1, 1\)", call, [*first, (0, value, 0), (1, 1, 1)], {}
        for odd in ODD_POINTS:
            yield InputError, None, f"^hi = .*; {THREE}", call, [*first, LO, odd], {}
            yield InputError, None, f"^lo = .*; {THREE}", call, [*first, odd, HI], {}
        for status, pattern, keywords in (*OPTIONS, ORDER):
            yield InputError, status, pattern, call, [*first, LO, HI], keywords
        if form is None:
            for axes in (tribox.AXES_PLANE, tribox.AXES_PLANE | tribox.AXES_EDGES):
                yield InputError, "BAD_OPTION", f"axes = {axes}; an Index needs AXES_BOX", call, [LO, HI], dict(axes=axes)
            for half, axis, pattern in (((1, INF, 1), EYE, r"half = \(1, inf, 1\)"),
                                        (HI, np.eye(4), "axis = .*; give three times three")):
                yield InputError, "BAD_BOX" if axis is EYE else None, pattern, call, [tribox.OrientedBox(LO, half, axis)], {}
            box = tribox.OrientedBox(LO, HI, EYE)
            yield InputError, "BAD_OPTION", "axes = 3; give AXES_ALL or AXES_BOX", call, [box], dict(axes=3)
            yield InputError, "BAD_OPTION", "axes = 6", call, [box], dict(axes=6, accuracy="fast")
            yield InputError, None, "^hi = .*; give an OrientedBox alone", call, [box, HI], {}
        else:
            yield InputError, "BAD_BOX", r"half = \(1, inf, 1\)", tribox.overlap_oriented, [form, LO, (1, INF, 1), EYE], {}
    overlap, oriented = tribox.overlap, tribox.overlap_oriented
    for status, pattern, keywords in (*OPTIONS, ORDER):
        yield InputError, status, pattern, oriented, [TRIANGLES, LO, HI, EYE], keywords
    for odd in (EYE[:2], np.eye(4), 3, None):
        yield InputError, None, "axis = .*; give three times three numbers", oriented, [TRIANGLES, LO, HI, odd], {}
    yield InputError, None, r"axis\[0\] = .*three numbers", oriented, [TRIANGLES, LO, HI, np.eye(4)[:3]], {}
    for odd in (LO, 3, None, "abc", (LO,), (LO, HI, LO)):
        yield InputError, None, r"^lo = .* no hi; give lo and hi, .* or both .* \(2, 3\)", overlap, [TRIANGLES, odd], {}
    many = r"^hi = .*; tribox\.Index\(triangles\)\.lists\(lo, hi\) takes many"
    yield InputError, None, many, overlap, [TRIANGLES, LO, [HI, HI]], {}
    for odd in ("first", None, 1):
        yield InputError, None, "^what = .*; give one of 'hit', 'miss'", tribox.find, [TRIANGLES, LO, HI, odd], {}
    for name, known, status in (("accuracy", "exact", None), ("kernel", tribox.kernel_name(), "NO_KERNEL")):
        for odd in ([known], {known}, "\udcff", f"{known}\0x", f"{known} ", known.upper(), known.encode(), np.array([known] * 2),
                    1):
            yield InputError, status, f"^{name} = ", overlap, [TRIANGLES, LO, HI], {name: odd}
    for odd in ([7], {}, 7.0, "7", np.array([7, 7]), 10 ** 400):
        yield InputError, "BAD_OPTION", "^axes = ", overlap, [TRIANGLES, LO, HI], dict(axes=odd)
    yield InputError, "BAD_OPTION", "axis_order = '123'", overlap, [TRIANGLES, LO, HI], dict(axis_order="123")
    box = tribox.OrientedBox(LO, HI, EYE)
    yield InputError, None, "give an OrientedBox without it", tribox.crop, [TRIANGLES, box], {"inside": True}
    for call in (overlap, tribox.find, tribox.crop):
        yield InputError, None, "^hi = .*; give an OrientedBox alone", call, [TRIANGLES, box, HI], {}
    for call in (tribox.classify, tribox.split):
        yield InputError, None, "overlap, find and crop take an OrientedBox", call, [TRIANGLES, box], {}
    of_vtk, scene = SimpleNamespace(GetPolys=None), SimpleNamespace(geometry={}, graph=None)
    for odd, pattern in (("cube.ply", r"str; give tribox.read\(path\)"), (os, "give real numbers"), (of_vtk, "pyvista.wrap"),
                         (scene, r"scene.to_mesh\(\)"), ([tribox.Mesh(VERTICES, FACES)] * 2, "list; give one of them a call")):
        yield InputTypeError, None, f"^triangles is .*{pattern}", overlap, [odd, LO, HI], {}
    split = [TRIANGLES, LO, HI]
    yield InputError, "BAD_BOX", r"middle = \(9, 0, 0\)", tribox.split, [*split, (9, 0, 0)], {}
    yield InputError, "BAD_OPTION", "axes = 2", tribox.split, split, dict(axes=tribox.AXES_PLANE)
    for odd, error, pattern in (([0, 500], BadIndexError, r"numbers\[1\] is 500, but there are 70 triangles"),
                                ([-1], BadIndexError, r"\[0\] is -1"),
                                (np.array([7, 2**32 - 1], np.uint32), BadIndexError, r"numbers\[1\] is 4294967295"),
                                ([0.5], InputTypeError, WHOLE), ([[1]], InputTypeError, r"of int64 and shape \(1, 1\)")):
        yield error, "BAD_VERTEX" if error is BadIndexError else None, pattern, tribox.split, split, dict(numbers=odd)


def wrong_bounds():
    """Of many boxes, about one triangle or an index."""
    bounds, one = np.zeros((3, 9), np.float32), TRIANGLES[0]
    for call, first in ((tribox.overlap_boxes, [one]), (INDEX.lists, [])):
        yield InputTypeError, None, "lo is ndarray of object; give real numbers", call, [*first, bounds.astype(object), bounds], {}
        yield InputTypeError, None, "hi is str", call, [*first, bounds, "hi"], {}
        turned = tribox.OrientedBox(LO, HI, EYE)
        for odd in (turned, [turned, turned]):
            yield InputError, None, "overlap, find and crop take an OrientedBox", call, [*first, odd], {}
        for odd in (bounds[:2], bounds[0], bounds[None], 3, np.zeros((5, 4))):
            pattern = r"^hi has shape .*; give \(m, 3\), a row for each box, or \(3, m\)"
            yield InputError, None, pattern, call, [*first, bounds, odd], {}
            yield InputError, None, r"^lo has shape .* no hi; .* both .* \(m, 2, 3\)", call, [*first, odd], {}
        yield InputError, None, "^lo has 9 boxes and hi 8", call, [*first, bounds, bounds.T[:8]], {}
        yield InputError, "BAD_OPTION", "axis_order = 7", call, [*first, bounds, bounds], dict(axis_order=7)
    for odd in (TRIANGLES[:2, 0], 3, None):
        yield InputError, None, "triangle = .*; give three times three numbers", tribox.overlap_boxes, [odd, bounds, bounds], {}
    yield InputError, "BAD_OPTION", "axes = 6", INDEX.lists, [bounds, bounds], dict(axes=6)


def wrong_triangles():
    """Of every call that takes any."""
    calls = [(call, [LO, HI], {}) for call in BOXED] + [(call, [GRID], {}) for call in GRIDDED]
    calls += [(call, [], {}) for call in (tribox.Soup.of, tribox.Index, tribox.Mesh)] + [(tribox.grid_around, [9], {})]

    def each(error, status, pattern, triangles):
        for call, arguments, keywords in calls:
            yield error, status, pattern, call, [triangles, *arguments], keywords

    cut = [np.zeros((3, 3), np.float32), np.zeros((1, 3), np.uint32)]
    for triangles in (None, "triangles", b"t", [[[None] * 3] * 3], [[["1", 2, 3]] * 3], [[[10 ** 400, 0, 0]] * 3], cut, object(),
                      SimpleNamespace(vertices=VERTICES)):
        yield from each(InputTypeError, None, "^triangles is", triangles)
    for dtype in (complex, np.complex64, bool, "S4", "U2", object, "M8[s]"):
        yield from each(InputTypeError, None, "triangles is ndarray of .*; give real numbers", np.zeros((1, 3, 3), dtype))
    for dtype, wrong in ((np.int64, -(1 << 53) - 1), (np.uint64, (1 << 64) - 1), (np.longdouble, np.longdouble(1) / 3)):
        triangles = np.ones((20, 3, 3), dtype)
        triangles[17, 2, 0] = triangles[19, 0, 0] = wrong
        yield from each(InputError, None, r"triangles\[17, 2, 0\] is .*: float64, the widest that is read, cannot hold it",
                        triangles)
    for shape in ((), (9,), (3, 3), (1, 9), (3, 3, 4), (1, 3, 2), (1, 1, 3, 3)):
        yield from each(InputError, None, r"has shape \(.*; give \(n, 3, 3\)", np.zeros(shape, np.float32))
    for kind in ("quad", "tetra", "triangle6"):
        mesh = SimpleNamespace(points=VERTICES, cells_dict={"triangle": FACES, kind: np.array([[0, 1, 2, 3]])})
        yield from each(InputError, None, f"triangles has cells of kind '{kind}'; make triangles of them, or give tribox.Mesh",
                        mesh)
    counted = np.insert(FACES.astype(np.int64), 0, 3, 1).ravel()
    for faces in (np.concatenate([counted, [4, 0, 1, 2, 3]]), np.array([2, 0, 1, 4, 0, 1, 2, 3]), counted[:-1]):
        yield from each(InputError, None, "triangles has faces that are no triangles, .*; give mesh.triangulate()",
                        SimpleNamespace(points=VERTICES, faces=faces))
    yield from each(InputError, None, "or strips; give mesh.triangulate()",
                    SimpleNamespace(points=VERTICES, faces=counted, n_strips=1))
    yield from each(InputError, None, r"^points has shape \(.*, 2\); give \(m, 3\)",
                    SimpleNamespace(points=VERTICES[:, :2], faces=FACES))
    yield from each(InputTypeError, None, f"^triangles is ndarray of float64; {WHOLE}",
                    SimpleNamespace(vertices=VERTICES, triangles=FACES.astype(float)))
    for dtype in (np.float32, complex, bool, object, "U4"):
        yield from each(InputTypeError, None, f"faces is ndarray of .*; {WHOLE}", (VERTICES, FACES.astype(dtype)))
    for odd in (EYE, [[0, 1, 2.0]], "faces"):
        yield from each(InputTypeError, None, f"faces is .*; {WHOLE}", (VERTICES, odd))
    for odd in (FACES[:, :2], FACES.ravel(), FACES[None]):
        yield from each(InputError, None, r"faces has shape .*give \(n, 3\): triangle, vertex", (VERTICES, odd))
    yield InputTypeError, None, "vertices is ndarray of complex64", tribox.Mesh, [VERTICES.astype(np.complex64), FACES], {}
    for call, arguments, keywords in [*calls, (tribox.overlap_oriented, [LO, HI, EYE], {}),
                                      (tribox.voxelize, [GRID], dict(ids=True)), (tribox.voxelize, [GRID], dict(threads=2)),
                                      (tribox.cell_lists, [GRIDS["doubles"]], dict(threads=3)),
                                      (tribox.Index, [], dict(keep_order=True))]:
        for dtype, wrong in ((np.uint16, len(VERTICES)), (np.uint32, 2 ** 32 - 1), (np.int32, -1), (np.int64, 1 << 32)):
            faces = FACES.astype(dtype)
            faces[17, 2] = faces[20, 0] = wrong
            pattern = fr"faces\[17, 2\] is {wrong}, but there are {len(VERTICES)} vertices; wrong indices in all: 2"
            for vertices in (VERTICES, VERTICES.astype(float) + 0.1):
                if call is not tribox.Mesh and (call != tribox.Soup.of or vertices is VERTICES):
                    yield BadIndexError, "BAD_VERTEX", pattern, lambda *others, given=(vertices, faces), call=call, **more: call(
                        given, *others, **more), arguments, keywords
            if dtype == np.int64:  # where they have to be copied anyway, indices are looked at
                for form in (faces, faces.tolist(), faces.astype(">i8"), np.asfortranarray(faces)):
                    yield BadIndexError, "BAD_VERTEX", pattern, tribox.Mesh, [VERTICES, form], {}
    yield InputError, None, r"triangles\[.*\] is .*, which float32 cannot hold; .* every call takes float64", tribox.Soup.of, [
        WIDE + 0.1], {}


def wrong_streams():
    streams = np.zeros((3, 3, 8), np.float32)
    for odd in (streams[:2], streams[:, :2], [], [streams[0]] * 4):
        yield InputError, None, "streams must hold three axes of three vertices each", tribox.Soup, [odd], {}
    for odd in (streams[:, :, ::2], streams[..., None], [*streams[:2], [*streams[2][:2], streams[2][2][:7]]]):
        yield InputError, None, "a stream has shape .*give nine contiguous arrays of one length", tribox.Soup, [odd], {}
    yield InputTypeError, None, r"a stream is float64; .*tribox\.Soup\.of\(triangles\)", tribox.Soup, [streams.astype(float)], {}
    yield InputTypeError, None, "a stream is list", tribox.Soup, [streams.tolist()], {}
    for odd in (3, np.zeros(3, np.float32), None):
        yield InputTypeError, None, r"streams is of type .*shape \(3, 3, n\)", tribox.Soup, [odd], {}


def wrong_grids():
    """Of every call that takes one: (origin, cell, size), or a grid around the triangles."""
    for origin, cell, size, cause in (
            ((NAN, 0, 0), 1, (4, 5, 6), "the origin or the cell is not finite on the x axis"),
            ((10 ** 400, 0, 0), 1, (4, 5, 6), "the origin or the cell is not finite on the x axis"),
            ((0, 0, 0), (1, INF, 1), (4, 5, 6), "the origin or the cell is not finite on the y axis"),
            ((0, 0, 0), 0, (4, 5, 6), "the cell or the size is not greater than zero on the x axis"),
            ((0, 0, 0), (1, -1, 1), (4, 5, 6), "the cell or the size is not greater than zero on the y axis"),
            ((0, 0, 0), 1, (4, 5, 0), "the cell or the size is not greater than zero on the z axis"),
            ((0, 0, 1.5e308), 1e307, (4, 5, 6), "the grid ends beyond the largest float64 on the z axis"),
            ((0, 1e17, 0), 1, (4, 5, 6), "float64 cannot tell cells of 1 apart on the y axis, .* cells of 32 are large enough"),
            ((0, 0, 1.797693134862315e308), 1e290, (1, 1, 100), "float64 cannot .*; choose fewer cells, or move the origin")):
        for call in GRIDDED:
            pattern = f"^{cause}.*origin ?= ?.*, cell ?= ?.*, size ?= ?"
            yield InputError, "BAD_GRID", pattern, call, [TRIANGLES, (origin, cell, size)], {}
    large = (0, 0, 0), 1, (1 << 20,) * 3
    yield InputError, "BAD_GRID", "^the cells take 1.342e.08 GiB, .* 16 at most; give a window.*origin=", tribox.voxelize, [
        TRIANGLES, large], {}
    for call in GRIDDED:
        for size in ((1, 2), 3, None, "xyz", (1, -2, 3), (1, 1 << 32, 1), (1, 2, 3, 4), (NAN, 1, 1), (1.5, 1, 1),
                     (10 ** 400, 1, 1)):
            yield InputError, None, "^size = .*; give three numbers of cells", call, [TRIANGLES, ((0, 0, 0), 1, size)], {}
        for origin, cell, word in (((0, 0), 1, "origin"), ((0, 0, 0), (1, 1), "cell"), ((0, 0, 0), "x", "cell"),
                                   ((0, 0, 0), ((1, 2), 3, [4]), "cell")):
            pattern = f"^{word} = .*; give (three numbers|the length of a cell, or three): x, y, z"
            yield InputError, None, pattern, call, [TRIANGLES, (origin, cell, (1, 1, 1))], {}
        for status, pattern, keywords in OPTIONS:
            yield InputError, status, pattern, call, [TRIANGLES, GRID], keywords
        for odd in (-1, 1.5, "2"):
            yield InputError, None, "^threads = .*; give a whole number", call, [TRIANGLES, GRID], dict(threads=odd)
        yield InputError, None, f"^no grid; {WAYS}", call, [TRIANGLES], {}
        for given in (dict(cell=1, resolution=2), dict(grid=GRID, cell=1), dict(grid=GRID, resolution=2)):
            yield InputError, None, f"exclude each other; {WAYS}", call, [TRIANGLES], given
        for odd in (3, 0.5, (0, 0, 0, 0), "grid", (1, 2)):
            yield InputTypeError, None, f"^grid = .*; {WAYS}", call, [TRIANGLES, odd], {}
    for call in (*GRIDDED, tribox.grid_around):
        for odd in (0, -1, 1.5, 1 << 31, "9", NAN):
            yield InputError, None, "^resolution = .*; give how many cells", call, [TRIANGLES], dict(resolution=odd)
        ends = np.array([[[-1.7e308] * 3, [1.7e308, 0, 0], [0] * 3]])
        for status, pattern, triangles, cells in ((None, "all lie in one point, .* give cell, or a grid", 0 * TRIANGLES, 9),
                                                  (None, "none whose coordinates are all finite", NONE, 9),
                                                  (None, "none whose coordinates are all finite", TRIANGLES * np.float32(NAN), 9),
                                                  ("BAD_GRID", "not finite.*: resolution = 1", ends, 1),
                                                  ("BAD_GRID", "float64 cannot tell cells .*: resolution = ", 1 + WIDE * 2.0 ** -50,
                                                   1 << 20)):
            yield InputError, status, pattern, call, [triangles], dict(resolution=cells)
        for odd, pattern in ((0, "greater than zero"), (-1, "greater than zero"), (NAN, "finite"), ((1, 0, 1), "greater"),
                             (INF, "finite"),
                             (1e-12, "more than 2.32 - 1 cells along the . axis; give larger cells: cell = 1e-12")):
            yield InputError, "BAD_GRID", pattern, call, [TRIANGLES], dict(cell=odd)
        for odd in ("x", (1, 2), [[1, 2, 3]]):
            yield InputError, None, "^cell = .*; give the length of a cell, or three", call, [TRIANGLES], dict(cell=odd)
        yield InputError, "BAD_GRID", "float64 cannot tell cells .* apart .*: cell = 1e-10", call, [
            TRIANGLES + np.float32(2 ** 40)], dict(cell=1e-10)
    for odd in ((4, 0, 0), (-1, 0, 0), (0, 0, 1.5)):
        yield InputError, None, r"^\(i, j, k\) = .*; give a cell of the 4 x 5 x 6 cells", GRID_OF_70.box, odd, {}


def wrong_cells():
    """What belongs to one of the calls about cells."""
    given = [TRIANGLES, GRID]
    for error, status, pattern, keywords in (
            *((InputError, None, r"layers = .*within the 6 layers", dict(layers=odd)) for odd in (
                (0, 7), (6, 1), (-1, 2), (1 << 32, 1), (0, "x"), (0,), (0, 1.5), 3, (0, 10 ** 400))),
            *((InputError, None, r"^window = .*; give \(first, size\).* within the 4 x 5 x 6 cells", dict(window=odd)) for odd in (
                3, (0, 1), ((0, 0, 0),), ((0, 0, 0), (5, 1, 1)), ((0, -1, 0), (1, 1, 1)), ((0, 0, 6), (1, 1, 1)), "window",
                ((0, 0, 0), (1, 1)), ((0, 0, 0), (1, 1, 1.5)), ((0, 0, 0), (1, 1, -1)), ((0, 0, 1 << 70), (1, 1, 1)))),
            (InputError, None, "layers and window exclude", dict(window=((0, 0, 0), (1, 1, 1)), layers=(0, 1))),
            *((InputError, None, "^fill = .*; give None or one of 'outside', 'parity', 'middles'",
               dict(fill=odd)) for odd in ("flood", True, 3)),
            *((InputError, None, "fill needs the whole grid", dict(fill=fill, **part)) for fill in ("outside", "middles")
              for part in (dict(layers=(0, 1)), dict(window=((0, 0, 0), (1, 1, 1))))),
            *((InputError, None, 'give fill = "outside" or "parity"', dict(labels=True, **more)) for more in ({},
                dict(fill="middles"))),
            (InputError, None, "labels and into exclude each other", dict(labels=True, fill="outside", into=VOXELS)),
            *((InputError, None, "without fill and into", {"ids": True, **more}) for more in (
                dict(fill="outside"), dict(into=VOXELS))),
            *((InputError, None, "leave out thin", {"thin": True, **more}) for more in (dict(ids=True), dict(fill="middles"))),
            *((InputError, "BAD_OPTION", "exact and of all axes", dict(thin=True, **more)) for more in (
                dict(accuracy="fast"), dict(accuracy="conservative"), dict(axes=1))),
            *((error, None, "^into ", dict(into=odd)) for odd, error in (
                (np.zeros((6, 5, 4), bool), InputTypeError), (True, InputTypeError),
                (tribox.voxelize(NONE, ((0, 0, 0), 2, (4, 5, 6))), InputError),
                (tribox.voxelize(NONE, GRID, layers=(0, 5)), InputError)))):
        yield error, status, pattern, tribox.voxelize, given, keywords
    for odd in (0, 4, 12, 1032, -8, 1.5, "8", None):
        yield InputError, None, "^side = .*; give how many cells", tribox.bricks, given, dict(side=odd)
        yield InputError, None, "^side = ", tribox.tile_count, [GRID[2], odd], {}
    for odd in ((0, 3), (2, 1), (-1, 1), (1, -1), (3, 0), (0, 1.5), 3, "ab"):
        pattern = r"^tiles = .*; give \(first, count\).*within the 2 tiles"
        yield InputError, None, pattern, tribox.bricks, [TRIANGLES, GRIDS["floats"]], dict(tiles=odd)
    for odd in ((1, 2), 3, "abc", (1, -2, 3), (1 << 32, 1, 1)):
        yield InputError, None, "^size = ", tribox.tile_count, [odd], {}
    array = np.array(VOXELS)
    yield InputTypeError, None, r"^grid = .*; give tribox\.Grid", tribox.Voxels, [array, GRID], {}
    yield InputTypeError, None, "^cells is an array of uint8", tribox.Voxels, [array.astype(np.uint8), GRID_OF_70], {}
    yield InputError, None, r"^cells has shape \(5, 5, 4\); give \(6, 5, 4\)", tribox.Voxels, [array[1:], GRID_OF_70], {}
    yield InputError, None, r"give \(6, 5, 1\)", tribox.Voxels, [np.zeros((6, 5, 2), np.uint64), GRID_OF_70], {}
    yield InputError, None, "^window = ", tribox.Voxels, [array, GRID_OF_70, ((0, 0, 0), (4, 5, 7))], {}
    yield InputError, None, r"^these Voxels have no labels; voxelize.*labels=True", VOXELS.labels, [], {}
    yield InputError, None, r"^these Voxels have no ids; voxelize\(..., ids=True\) makes some", lambda: VOXELS.ids, [], {}
    triangle = np.array([[[0, 0, 0], [2, 0, 0], [0, 2, 0]]], np.float32)
    yield InputError, None, "at least 2e.12 numbers of triangles, and can have 4.29e.09 at most; give larger cells", *(
        tribox.cell_lists, [triangle], dict(resolution=2000000))


def wrong_answers():
    """Arrays to write to, and masks."""
    read_only = np.zeros(70, bool)
    read_only.flags.writeable = False
    for call, first in (*((tribox.overlap, [form, LO, HI]) for form in FORMS[:3]), (INDEX.overlap, [LO, HI])):
        for out in (np.zeros(70, np.uint8), [False] * 70, np.zeros(70, np.int64), np.zeros(70, ">u8")):
            yield InputTypeError, None, "^out is .*bool, or of uint64 for packed bits", call, first, dict(out=out)
        for out in (np.zeros(69, bool), np.zeros((70, 1), bool), np.zeros(3, np.uint64)):
            yield InputError, None, r"^out has shape .*; give \((70|2),\)", call, first, dict(out=out)
        for out in (read_only, np.zeros(4, np.uint64)[::2]):
            pattern = f"^out is {'read-only' if out is read_only else 'not contiguous'}; give"
            yield InputError, None, pattern, call, first, dict(out=out)
    for odd in ([1], np.zeros(2, bool), np.zeros(4, np.uint64)[::2], np.broadcast_to(np.uint64(0), (1, 1 << 27))):
        yield InputTypeError, None, "mask must be a contiguous array of uint64", tribox.mask_indices, [odd], {}


class Refused(cases.TestCase):
    def test_tables(self):
        for table in (wrong_boxes, wrong_bounds, wrong_triangles, wrong_streams, wrong_grids, wrong_cells, wrong_answers):
            for error, status, pattern, call, arguments, keywords in table():
                with self.subTest(f"{table.__name__}: {pattern}, {getattr(call, '__name__', call)}"):
                    self.refuse(error, status, pattern, call, *arguments, **keywords)

    def test_kinds(self):
        for kind, builtin in ((InputError, ValueError), (InputTypeError, TypeError), (BadIndexError, IndexError)):
            self.assertTrue(issubclass(kind, tribox.Error) and issubclass(kind, builtin))
        with self.assertRaises(tribox.Error) as raised:
            tribox.overlap(TRIANGLES, LO, (NAN, 1, 1))
        copy = pickle.loads(pickle.dumps(raised.exception))
        self.assertEqual((str(copy), copy.status), (str(raised.exception), "BAD_BOX"))
        for odd in ("\udcff", f"{tribox.kernel_name()}\0x", [], 5, "sse9"):
            self.assertIsNone(tribox.kernel_name(odd))

    def holes(self, dtype, rows):
        """So many rows of three, in a file of nothing else."""
        file = tempfile.TemporaryFile()
        self.addCleanup(file.close)
        try:
            file.truncate(3 * rows * np.dtype(dtype).itemsize)
            return np.memmap(file, dtype, "r", shape=(rows, 3))
        except (OSError, OverflowError, ValueError) as error:
            self.skipTest(f"no file of 26 GB, not even of holes: {error}")

    def test_negative_indices(self):
        """Among more than 2^31 vertices a negative index is none of them either."""
        mesh = tribox.Mesh(self.holes(np.float32, (1 << 31) + 5), np.array([[0, 1, -(1 << 31)]], np.int32))
        self.refuse(BadIndexError, "BAD_VERTEX", r"faces\[0, 2\] is -2147483648", tribox.overlap, mesh, LO, HI)

    def test_too_many(self):
        """More triangles than numbers of 32 bits; and what the library would say."""
        mesh = tribox.Mesh(VERTICES, self.holes(np.uint16, (1 << 32) + 1))
        for what, call, *arguments in (("an Index", tribox.Index), ("lists of tiles", tribox.bricks, GRID),
                                       ("lists of tiles", tribox.cell_lists, GRID)):
            self.refuse(InputError, None, f"^triangles are 4294967297, and {what} can be of 4294967296 at most; give them in parts",
                        call, mesh, *arguments)
        for call in tribox.voxelize, tribox.bricks:
            self.refuse(InputError, None, "ids can be of 4294967295 at most", call, tribox.Mesh(VERTICES, mesh.faces[1:]), GRID,
                        ids=True)
        error = tribox._errors.error_of(tribox._library.lib.TRIBOX_BAD_ARGUMENT)
        self.assertRegex(str(error), "cannot take an argument .* report the call$")

    def test_no_memory(self):
        """Of large cells, whose pages are mapped, as of small ones."""
        with mock.patch("mmap.mmap", side_effect=OSError(errno.ENOMEM, "Cannot allocate memory")):
            self.assertRaises(MemoryError, tribox.voxelize, TRIANGLES, ((0, 0, 0), 1, (4096, 4096, 4096)))

    def test_nothing_is_written(self):
        vertices, faces = cases.shared_vertices(np.resize(TRIANGLES, (70000, 3, 3)), np.uint32)
        faces[-1, 2] = len(vertices)
        late, into = tribox.Mesh(vertices, faces), tribox.voxelize(NONE, GRID)
        for arguments, count in (((late, LO, HI), 70000), ((TRIANGLES, LO, (NAN, 0, 0)), 70)):
            for out in (np.zeros(count, bool), np.zeros((count + 63) // 64, np.uint64)):
                self.assertRaises(tribox.Error, tribox.overlap, *arguments, out=out)
                self.assertFalse(out.any())
        for more in (dict(fill=None), dict(fill="outside"), dict(fill="parity"), dict(threads=2)):
            self.assertRaises(BadIndexError, tribox.voxelize, late, GRID, into=into, **more)
            self.assertFalse(into.words.any())

    def test_sufficient_cell(self):
        """The cell that a message recommends does, and a quarter of it does not."""
        for start in (1e17, -1e17, 3, -1e300, 2.0 ** 53 - 4, 0.1):
            for size in (1, 5, 1000):
                cell = tribox._grids.sufficient_cell(start, size)
                self.assertFalse(tribox.voxelize(NONE, ((start, 0, 0), (cell, 1, 1), (size, 1, 1))).any())
                with self.assertRaises(InputError):
                    tribox.voxelize(NONE, ((start, 0, 0), (cell / 4, 1, 1), (max(size, 5), 1, 1)))

    def test_library(self):
        """What an import says where the library is not there, or does not fit."""
        for library, pattern in (("/no/libtribox.so",
                                  "ImportError: .*/no/libtribox.so.*; install libtribox, or set TRIBOX_LIBRARY to the path of"),
                                 ("libc.so.6", "ImportError: libc.so.6 does not fit this module: .*tribox_")):
            done = subprocess.run([sys.executable, "-B", "-c", "import tribox"], capture_output=True, timeout=60, text=True,
                                  env={**os.environ, "TRIBOX_LIBRARY": library})
            self.assertNotEqual(done.returncode, 0)
            self.assertRegex(done.stderr, pattern)


if __name__ == "__main__":
    cases.main()
