"""float64 as it is: exact about every number, in every form, at every offset, for boxes and grids of doubles as well."""

import os
import pickle
import types
from fractions import Fraction

import numpy as np
import tribox

import cases

NORTH = np.array([557820.0, 5108010.0, 431.25])  # of UTM coordinates


def far(count):
    """A lattice moved by a huge offset, multiples of it that float64 rounds, and numbers of all sizes."""
    pick = np.random.default_rng(cases.seed())
    lattice = cases.lattice(count).astype(float)
    return {"moved": lattice + NORTH, "tenths": lattice * 0.8 + 0.1, "tenths, moved": lattice * 0.8 + NORTH / 3,
            "2^100": lattice * 2.0 ** 100, "2^-1000": lattice * 2.0 ** -1000, "near the end": lattice * 2.0 ** 1020,
            "all sizes": pick.uniform(-1, 1, (count, 3, 3)) * 2.0 ** pick.integers(-1000, 1000, (count, 1, 1)),
            "next to it": np.nextafter(lattice, pick.choice([-np.inf, np.inf], lattice.shape)) + 4}


def boxes_about(triangles):
    """Boxes whose bounds are numbers of the vertices, one ulp off, or any."""
    pick = np.random.default_rng(cases.seed())
    corners = triangles.reshape(-1, 3)
    for nudge in (0, np.inf, -np.inf):
        lo, hi = (np.array([corners[pick.integers(len(corners)), a] for a in range(3)]) for _ in range(2))
        lo, hi = np.minimum(lo, hi), np.maximum(lo, hi)
        yield lo, np.nextafter(hi, nudge) if nudge else hi
    yield np.median(corners, 0), np.quantile(corners, 0.8, 0)


def forms(triangles):
    """The same triangles in every form that holds float64."""
    vertices, faces = cases.shared_vertices(triangles, np.int64)
    padded = np.full((*triangles.shape[:2], 5), np.nan)
    padded[:, :, 1:4] = triangles
    yield triangles
    yield triangles.tolist()
    yield triangles.astype(">f8")
    yield padded[:, :, 1:4]
    yield np.asfortranarray(triangles)
    yield np.repeat(triangles, 2, 0)[::2]
    yield triangles[::-1][::-1]
    yield tribox.Mesh(vertices, faces)
    yield tribox.Mesh(np.asfortranarray(vertices), faces.astype(np.int32))
    yield tribox.Mesh(np.repeat(np.repeat(vertices, 2, 0), 3, 1)[::2, ::3], faces.tolist())
    yield tribox.Mesh(vertices[::-1], len(vertices) - 1 - faces)
    yield types.SimpleNamespace(vertices=vertices, faces=faces)


class Doubles(cases.TestCase):
    def test_overlap(self):
        for name, triangles in far(24).items():
            for lo, hi in boxes_about(triangles):
                expected = cases.truth(triangles, lo, hi)
                for form in forms(triangles):
                    self.assert_same(tribox.overlap(form, lo, hi), expected, name)
                for kernel in tribox.kernels():
                    self.assert_same(tribox.overlap(triangles, lo.tolist(), hi.tolist(), kernel=kernel), expected, name)
                self.assertIs(tribox.overlap_any(triangles, lo, hi), bool(expected.any()))
                self.assertIs(tribox.overlap_all(triangles, lo, hi), bool(expected.all()))
                self.assertTrue(tribox.overlap_all(triangles[expected], lo, hi))
                inside = ((triangles >= lo) & (triangles <= hi)).all((1, 2))
                self.assert_same(np.array(tribox.classify(triangles, lo, hi)), np.array([expected, inside]), name)

    def test_in_place(self):
        """Rows and columns of float64 are read where they lie."""
        triangles = far(20)["moved"]
        vertices, faces = cases.shared_vertices(triangles, np.uint32)
        columns, table = np.asfortranarray(vertices), np.zeros((len(vertices), 7))
        for form, array in ((triangles, triangles), (triangles[:, :, :], triangles), (tribox.Mesh(vertices, faces), vertices),
                            (tribox.Mesh(columns, faces), columns), (tribox.Mesh(table[:, 1::2], faces), table[:, 1:])):
            held = tribox._triangles.held(form)
            self.assertTrue(np.shares_memory(held.vertices, array))
            address = int(tribox._ffi.ffi.cast("uintptr_t", held.struct.positions))
            self.assertEqual(address, array.__array_interface__["data"][0])

    def test_axes(self):
        triangles = far(60)["tenths, moved"]
        lo, hi = next(boxes_about(triangles))
        expected = (triangles.min(1) <= hi).all(1) & (triangles.max(1) >= lo).all(1)
        self.assert_same(tribox.overlap(triangles, lo, hi, axes=tribox.AXES_BOX), expected)

    def test_packed_and_out(self):
        triangles = far(200)["moved"]
        lo, hi = NORTH - 0.3, NORTH + 0.7
        expected = cases.truth(triangles, lo, hi)
        words = tribox.overlap(triangles, lo, hi, packed=True)
        self.assert_same(tribox.mask_indices(words), np.flatnonzero(expected).astype(np.uint32))
        out = np.ones(200, bool)
        self.assertIs(tribox.overlap(triangles, lo, hi, out=out), out)
        self.assert_same(out, expected)

    def test_boxes_of_doubles(self):
        """Floats against bounds that float32 cannot hold, in all forms of floats."""
        triangles = cases.lattice(100) * np.float32(0.8) + np.float32(0.1)
        vertices, faces = cases.shared_vertices(triangles, np.uint16)
        corner = triangles.reshape(-1, 3)
        for lo, hi in (((0.1, 0.1, 0.1), (0.7, 0.8, 0.9)), (-1 / np.arange(3, 6), np.nextafter(corner.max(0).astype(float), -9)),
                       ((-1e300, -0.1, -1e-300), (1e300, 0.1, 1e-300)), ((0.1, 0, 0), (-0.1, 1, 1))):
            expected = cases.truth(triangles, lo, hi)
            soup = tribox.Soup.of(triangles)
            for form in (triangles, np.asfortranarray(triangles), tribox.Mesh(vertices, faces), soup, soup.streams.T,
                         tribox.Mesh(np.asfortranarray(vertices), faces)):
                self.assert_same(tribox.overlap(form, lo, hi), expected)
                self.assertIs(tribox.overlap_any(form, lo, hi), bool(expected.any()))
                self.assertIs(tribox.overlap_all(form, lo, hi), bool(expected.all()))
                self.assert_same(tribox.classify(form, lo, hi)[0], expected)
            for index in (tribox.Index(triangles), tribox.Index(triangles, keep_order=True)):
                self.assert_same(index.overlap(lo, hi), expected)
                self.assert_same(np.sort(index.list(lo, hi)), np.flatnonzero(expected).astype(np.uint32))
                self.assertEqual((index.count(lo, hi), index.any(lo, hi)), (expected.sum(), expected.any()))

    def test_blocks(self):
        """A Soup is asked about a box of doubles block by block."""
        triangles = np.resize(cases.lattice(1000), (3 * 65536 + 77, 3, 3))
        expected = np.resize(cases.truth(triangles[:1000], (-0.1,) * 3, (0.1,) * 3), len(triangles))
        soup = tribox.Soup.of(triangles)
        self.assert_same(tribox.overlap(soup, (-0.1,) * 3, (0.1,) * 3), expected)
        self.assert_same(tribox.classify(soup, (-0.1,) * 3, (0.1,) * 3)[0], expected)
        soup.streams[:, :, :-1] = 99
        soup.streams[:, :, -1] = 0
        self.assertTrue(tribox.overlap_any(soup, (-0.1,) * 3, (0.1,) * 3))

    def test_one_triangle(self):
        triangles = far(3)["tenths"]
        for dtype in (np.float32, float):
            boxes = np.sort(np.array([cases.lattice(20)[:, 0].T, cases.lattice(20)[:, 1].T]), 0).astype(dtype)
            boxes[0, 1, 7], boxes[1, 2, 8] = np.nan, np.inf
            for one in (*triangles, *triangles.astype(np.float32)):
                for lo, hi in (boxes, boxes * dtype(0.7)):
                    expected = [np.isfinite([a, b]).all() and cases.truth(one[None], a, b)[0] for a, b in zip(lo.T, hi.T)]
                    self.assert_same(tribox.overlap_boxes(one, lo, hi), np.array(expected))
                    words = tribox.overlap_boxes(one, lo.tolist(), np.asfortranarray(hi), packed=True)
                    self.assert_same(tribox.mask_indices(words), np.flatnonzero(expected).astype(np.uint32))

    def test_other_numbers(self):
        """Numbers of other types are the same numbers."""
        lattice = cases.lattice(50) * 8
        expected = cases.truth(lattice, (-4, -4, -4), (4, 4, 4))
        for dtype in (np.int8, np.int16, np.int32, np.int64, np.float16, ">f4", ">i4", np.longdouble):
            self.assert_same(tribox.overlap(lattice.astype(dtype), (-4, -4, -4), (4, 4, 4)), expected)
        large = lattice.astype(np.int64) + (1 << 52)
        self.assert_same(tribox.overlap(large, [(1 << 52) - 4] * 3, [(1 << 52) + 4] * 3), expected)


def oriented_truth(triangles, center, half, axis):
    """In the frame of the box, in rational numbers: exact for any axes."""
    corners = [[[Fraction(float(x)) - Fraction(float(c)) for x, c in zip(vertex, center)] for vertex in triangle]
               for triangle in triangles]
    moved = [[[sum(Fraction(float(a)) * x for a, x in zip(row, vertex)) for row in axis] for vertex in triangle]
             for triangle in corners]
    box = *(-Fraction(float(h)) for h in half), *(Fraction(float(h)) for h in half)
    return np.array([cases.meshes.overlaps(triangle, box) for triangle in moved], bool)


def turned():
    """Axes that no float32 holds, of a box that is turned, and one that is sheared."""
    angle = 0.3
    c, s = np.cos(angle), np.sin(angle)
    yield np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    yield np.array([[0.1, 0.2, 0.7], [0, 1 / 3, 0.1], [-0.9, 0, 0.3]])


class Oriented(cases.TestCase):
    def test_truth(self):
        """About doubles: meshes and boxes alike, and Soups of floats and boxes of doubles."""
        pick = np.random.default_rng(cases.seed())
        for name in ("moved", "tenths", "tenths, moved", "next to it"):
            triangles = far(24)[name]
            for axis in turned():
                center, half = triangles[pick.integers(24)].mean(0), np.array([0.7, 1.1, 0.4])
                expected = oriented_truth(triangles, center, half, axis)
                for form in forms(triangles):
                    self.assert_same(tribox.overlap_oriented(form, center, half, axis), expected, name)
                corner = np.abs(axis @ (triangles[3, 1] - center))  # half lengths that end at a vertex, or an ulp before it
                for half in (corner, np.nextafter(corner, 0)):
                    self.assert_same(tribox.overlap_oriented(triangles, center, half, axis),
                                     oriented_truth(triangles, center, half, axis), name)
        floats = cases.lattice(24)
        for axis in turned():
            expected = oriented_truth(floats, (0.1, 0.2, 0.3), (0.7, 1.1, 0.4), axis)
            self.assertTrue(expected.any() and not expected.all())
            for form in (floats, tribox.Soup.of(floats), tribox.Mesh(*cases.shared_vertices(floats, np.uint16))):
                self.assert_same(tribox.overlap_oriented(form, (0.1, 0.2, 0.3), (0.7, 1.1, 0.4), axis), expected)


class Indices(cases.TestCase):
    """An Index over doubles is exact about them."""

    def check(self, triangles, form, name):
        los, his = map(np.array, zip(*boxes_about(triangles)))
        answers = [cases.truth(triangles, *box) for box in zip(los, his)]
        for keep_order in (False, True):
            made = tribox.Index(form, keep_order=keep_order)
            for index in (made, pickle.loads(pickle.dumps(made))):
                for box, expected in zip(zip(los, his), answers):
                    self.assert_same(index.overlap(*box), expected, name)
                    self.assert_same(np.sort(index.list(*box)), np.flatnonzero(expected).astype(np.uint32), name)
                    self.assertEqual((index.count(*box), index.any(*box)), (expected.sum(), expected.any()), name)
            for boxes in ((los, his), (np.stack([los, his], 1),)):
                numbers, start = index.lists(*boxes)
                for i, expected in enumerate(answers):
                    self.assert_same(np.sort(numbers[start[i]:start[i + 1]]), np.flatnonzero(expected).astype(np.uint32), name)
            for axis in turned():
                box = tribox.OrientedBox(triangles[0, 0], np.ptp(triangles.reshape(-1, 3), 0) / 3, axis)
                expected = tribox.overlap_oriented(triangles, *box)
                self.assert_same(index.overlap(box), expected, name)
                self.assert_same(np.sort(index.list(box)), np.flatnonzero(expected).astype(np.uint32), name)
                self.assertEqual((index.count(box), index.any(box)), (expected.sum(), expected.any()), name)

    def test_index(self):
        for name, triangles in far(150).items():
            self.check(triangles, triangles, name)
        for form in forms(far(150)["tenths, moved"]):
            self.check(far(150)["tenths, moved"], form, "form")

    def test_not_finite(self):
        triangles = far(5000)["tenths, moved"]
        triangles[7, 1, 2], triangles[4000:4200, 0, 0], triangles[-1, 2, 1] = np.nan, np.inf, -np.inf
        lo, hi = NORTH / 3 - 0.3, NORTH / 3 + 0.7
        index, expected = tribox.Index(triangles), tribox.overlap(triangles, lo, hi)
        self.assertTrue(expected.any())
        self.assert_same(index.overlap(lo, hi), expected)

    def test_floats(self):
        """float64 that float32 holds is the same everywhere."""
        triangles = cases.lattice(100)
        wide, box = triangles.astype(float), (cases.LO, cases.HI)
        self.assert_same(tribox.Soup.of(wide).streams, tribox.Soup.of(triangles).streams)
        self.assert_same(tribox.Index(wide).overlap(*box), tribox.overlap(triangles, *box))
        self.assert_same(tribox.overlap_oriented(wide, *box, np.eye(3)), tribox.overlap_oriented(triangles, *box, np.eye(3)))
        self.refuse(tribox.InputError, None, r"triangles\[.*\] is .*, which float32 cannot hold; .* every call takes float64",
                    tribox.Soup.of, wide + 0.1)


def plane(origin, number, cell):
    """Where plane p of a grid of doubles lies: rounded once."""
    return float(Fraction(float(origin)) + number * Fraction(float(cell)))


def cell_by_cell(triangles, origin, cell, size):
    answer = np.zeros(size[::-1], bool)
    for k, j, i in np.ndindex(*answer.shape):
        lo, hi = ([plane(origin[a], number + past, cell[a]) for a, number in enumerate((i, j, k))] for past in (0, 1))
        answer[k, j, i] = cases.truth(triangles, lo, hi).any()
    return answer


class Voxels(cases.TestCase):
    ORIGIN, CELL, SIZE = (-0.3, -0.7, -0.1), (0.3, 0.1, 1 / 3), (3, 5, 4)

    def test_forms(self):
        for name in ("moved", "tenths", "tenths, moved"):
            triangles = far(5)[name]
            origin = triangles.reshape(-1, 3).min(0) + self.ORIGIN
            expected = cell_by_cell(triangles, origin, self.CELL, self.SIZE)
            for form in forms(triangles):
                self.assert_same(tribox.voxelize(form, (origin, self.CELL, self.SIZE)), expected, name)
            grid = origin, self.CELL, self.SIZE
            parts = [tribox.voxelize(triangles, grid, layers=layers) for layers in ((0, 1), (1, 0), (1, 3))]
            self.assert_same(np.concatenate(parts), expected)

    def test_floats_in_a_grid_of_doubles(self):
        triangles = cases.lattice(6)
        expected = cell_by_cell(triangles, self.ORIGIN, self.CELL, self.SIZE)
        for form in (triangles, tribox.Soup.of(triangles), tribox.Mesh(*cases.shared_vertices(triangles, np.int64))):
            self.assert_same(tribox.voxelize(form, (self.ORIGIN, self.CELL, self.SIZE)), expected)
        into = tribox.voxelize(triangles[:0], (self.ORIGIN, self.CELL, self.SIZE))
        for one in triangles:
            tribox.voxelize(one[None], into.grid, into=into)
        self.assert_same(into, expected)

    def test_finer_than_floats(self):
        """Planes that float32 does not tell apart, double does: the cells are those of the same mesh about the origin."""
        triangles = cases.lattice(40)
        near = tribox.voxelize(triangles, ((-2, -2, -2), 1 / 16, (64, 64, 64)))
        offset = np.array([1 << 24, 1 << 25, -(1 << 26)])
        self.assert_same(tribox.voxelize(triangles + offset, (offset - 2, 1 / 16, (64, 64, 64))), near)
        self.assertTrue(near.any())

    def test_bunny(self):
        """20 m long at UTM coordinates, in cells of half a metre: 5379 as everywhere else, where float32 made 6666 of it."""
        path = os.path.join(os.environ.get("TRIBOX_MESHES", ""), "stanford-bunny.ply")
        if not os.path.exists(path):
            self.skipTest("no stanford-bunny.ply; TRIBOX_MESHES names the folder of meshes")
        with open(path, "rb") as file:
            head, _, body = file.read().partition(b"end_header\n")
        count = int(head.split(b"element vertex ")[1].split()[0])
        scanned = np.frombuffer(body, "<f4", 3 * count).reshape(-1, 3).astype(float)
        faces = np.frombuffer(body, [("corners", "u1"), ("face", "<i4", 3)], offset=12 * count)["face"]
        sides = np.ptp(scanned, 0)
        origin, vertices = NORTH * (1, 1, 0), (scanned - scanned.min(0)) * (20 / sides.max()) + NORTH * (1, 1, 0)
        size = np.ceil((vertices.max(0) - origin) / 0.5).astype(int)
        for form in (tribox.Mesh(vertices, faces), types.SimpleNamespace(vertices=vertices, faces=faces.astype(np.int64))):
            self.assertEqual(np.count_nonzero(tribox.voxelize(form, (origin, 0.5, size))), 5379)
        mesh = tribox.Mesh(vertices.astype(np.float32), faces)
        self.assertNotEqual(np.count_nonzero(tribox.voxelize(mesh, (origin, 0.5, size))), 5379)


if __name__ == "__main__":
    cases.main()
