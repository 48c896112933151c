"""The answers of tribox.overlap and its relatives: against exact clipping, in every form that triangles have."""

import doctest
import unittest

import numpy as np
import tribox

import cases
from cases import HI, LO

KERNELS = tribox.kernels()
ORDERS = (123, 132, 213, 231, 312, 321)
MANY = 2 * 65536 + 77  # more than two blocks


def forms(triangles):
    """The same triangles in every form that the calls take."""
    yield triangles
    for dtype in (np.uint16, np.uint32, np.int32):
        yield tribox.Mesh(*cases.shared_vertices(triangles, dtype))
    streams = np.ascontiguousarray(triangles.T)
    yield tribox.Soup(streams)
    yield tribox.Soup([[stream.copy() for stream in axis] for axis in streams])
    yield streams.T


class Overlap(cases.TestCase):
    def setUp(self):
        self.triangles = np.concatenate([cases.lattice(300), cases.scattered(200)])
        self.expected = cases.truth(self.triangles, LO, HI)
        self.assertGreater(self.expected.sum(), 50)
        self.assertGreater((~self.expected).sum(), 50)

    def test_forms(self):
        for form in forms(self.triangles):
            self.assert_same(tribox.overlap(form, LO, HI), self.expected, type(form))

    def test_ways(self):
        for form in forms(self.triangles):
            for kernel in KERNELS:
                for order in ORDERS:
                    self.assert_same(tribox.overlap(form, LO, HI, kernel=kernel, axis_order=order), self.expected, (kernel, order))

    def test_accuracies(self):
        lattice = cases.lattice(300)
        expected = cases.truth(lattice, LO, HI)
        for form in forms(lattice):
            self.assert_same(tribox.overlap(form, LO, HI, accuracy="exact"), expected)
            self.assertTrue(np.all(tribox.overlap(form, LO, HI, accuracy="conservative") >= expected))
            # Every operation on this lattice is exact in float.
            self.assert_same(tribox.overlap(form, LO, HI, accuracy="fast"), expected)

    def test_options(self):
        """What no answer on these triangles would tell: the options reach the library."""
        options = tribox._arguments.options_of("fast", 3, 213, "scalar")
        self.assertEqual((options.accuracy, options.axes, options.axis_order), (2, 3, 213))
        self.assertEqual(tribox._ffi.ffi.string(options.kernel), b"scalar")
        self.assertEqual(tribox._arguments.options_of("conservative", 7, 0, None).accuracy, 1)

    def test_axes(self):
        box = np.all((self.triangles.min(1) <= HI) & (self.triangles.max(1) >= LO), 1)
        self.assertTrue(np.any(box != self.expected))
        for form in forms(self.triangles):
            self.assert_same(tribox.overlap(form, LO, HI, axes=tribox.AXES_BOX), box)
            some = tribox.overlap(form, LO, HI, axes=tribox.AXES_BOX | tribox.AXES_EDGES)
            self.assertTrue(np.all((self.expected <= some) & (some <= box)))
        everything = tribox.AXES_BOX | tribox.AXES_PLANE | tribox.AXES_EDGES
        self.assertEqual(everything, tribox.AXES_ALL)

    def test_counts(self):
        for count in (0, 1, 2, 3, 63, 64, 65, 128, 129):
            for form in forms(self.triangles[:count]):
                self.assert_same(tribox.overlap(form, LO, HI), self.expected[:count], count)

    def test_packed(self):
        for count in (0, 1, 64, 65, 500):
            words = tribox.overlap(self.triangles[:count], LO, HI, packed=True)
            self.assertEqual((words.dtype, words.shape), (np.uint64, ((count + 63) // 64,)))
            bits = [int(words[i // 64]) >> i % 64 & 1 for i in range(64 * len(words))]
            self.assertEqual(bits, self.expected[:count].astype(int).tolist() + [0] * (len(bits) - count))
            self.assert_same(tribox.mask_indices(words), np.flatnonzero(self.expected[:count]).astype(np.uint32))

    def test_out(self):
        for form in forms(self.triangles):
            out = np.ones(500, bool)
            self.assertIs(tribox.overlap(form, LO, HI, out=out), out)
            self.assert_same(out, self.expected)
            apart = np.ones((500, 2), bool)
            self.assert_same(tribox.overlap(form, LO, HI, out=apart[:, 0]), self.expected)
            self.assertTrue(apart[:, 1].all())
            words = np.full(8, -1, np.int64).view(np.uint64)
            self.assertIs(tribox.overlap(form, LO, HI, out=words), words)
            self.assert_same(words, tribox.overlap(form, LO, HI, packed=True))

    def test_numbers(self):
        """Bounds may be any three numbers, and are taken as they are."""
        both = np.array([LO, HI])
        for corners in (both, both.tolist(), (LO, HI), [LO, np.array(HI)]):
            self.assert_same(tribox.overlap(self.triangles, corners), self.expected)
            self.assert_same(tribox.classify(self.triangles, corners)[0], self.expected)
        for lo, hi in ((list(LO), np.array(HI)), (np.float32(LO), map(np.float32, HI)), (LO, np.array(HI, np.float16))):
            self.assert_same(tribox.overlap(self.triangles, lo, hi), self.expected)
        point, tenth = np.full((1, 3, 3), 0.1, np.float32), np.float32(0.1)
        self.assertTrue(tribox.overlap(point, (tenth, tenth, tenth), (tenth, tenth, tenth))[0])
        self.assertFalse(tribox.overlap(point, (0, 0, 0), (0.1, 0.1, 0.1))[0])

    def test_no_overlap(self):
        for lo, hi in (((1, 0, 0), (0, 1, 1)), ((1e38, 0, 0), (3e38, 1, 1))):
            self.assertFalse(tribox.overlap(self.triangles, lo, hi).any())
        for value in (np.nan, np.inf, -np.inf):
            broken = self.triangles.copy()
            broken[:, 1, 2] = value
            for form in forms(broken):
                self.assertFalse(tribox.overlap(form, LO, HI).any())


class Relatives(cases.TestCase):
    def setUp(self):
        self.triangles = np.concatenate([cases.lattice(200), cases.lattice(100) / 4])
        self.expected = cases.truth(self.triangles, LO, HI)
        self.inside = np.all((self.triangles >= LO) & (self.triangles <= HI), (1, 2))

    def test_any_all(self):
        self.assertTrue(self.inside.any())
        for lo, hi in ((LO, HI), ((5, 5, 5), (6, 6, 6)), ((-9, -9, -9), (9, 9, 9))):
            answers = cases.truth(self.triangles, lo, hi)
            for form in forms(self.triangles):
                self.assertIs(tribox.overlap_any(form, lo, hi), bool(answers.any()))
                self.assertIs(tribox.overlap_all(form, lo, hi), bool(answers.all()))
                self.assertEqual(tribox.find(form, lo, hi), answers.argmax() if answers.any() else None)
                self.assertEqual(tribox.find(form, (lo, hi), what="miss"), None if answers.all() else (~answers).argmax())
        none = np.zeros((0, 3, 3), np.float32)
        self.assertEqual((tribox.overlap_any(none, LO, HI), tribox.overlap_all(none, LO, HI)), (False, True))

    def test_any_all_first_and_last(self):
        """The one that counts is the first of all, or the last of the last block."""
        for place in (0, 65535, 65536, MANY - 1):
            triangles = np.full((MANY, 3, 3), 9, np.float32)
            triangles[place] = 0
            for form in (triangles, tribox.Soup.of(triangles)):
                self.assertTrue(tribox.overlap_any(form, LO, HI), place)
                self.assertEqual(tribox.find(form, LO, HI), place)
                self.assertEqual(tribox.find(form, (8, 8, 8), (9, 9, 9), "miss"), place)
                self.assertFalse(tribox.overlap_all(form, (8, 8, 8), (9, 9, 9)), place)
            self.assertFalse(tribox.overlap_any(triangles, (1, 1, 1), (2, 2, 2)))
            self.assertTrue(tribox.overlap_all(triangles, (0, 0, 0), (9, 9, 9)))

    def test_classify(self):
        for form in forms(self.triangles):
            overlapping, inside = tribox.classify(form, LO, HI)
            self.assert_same(overlapping, self.expected)
            self.assert_same(inside, self.inside)
            overlapping, inside = tribox.classify(form, LO, HI, packed=True)
            self.assert_same(overlapping, tribox.overlap(form, LO, HI, packed=True))
            self.assert_same(tribox.mask_indices(inside), np.flatnonzero(self.inside).astype(np.uint32))

    def test_split(self):
        numbers, middle = np.random.default_rng(1).integers(0, len(self.triangles), 700), (0.25, -0.5, 0.125)
        for at in (None, middle):
            planes = np.array([LO, np.add(LO, HI) / 2 if at is None else at, HI])
            corners = [[planes[(c >> a & 1) + side, a] for a in range(3)] for c in range(8) for side in range(2)]
            expected = sum(tribox.overlap(self.triangles, *corners[2 * c:2 * c + 2]).astype(np.uint8) << c for c in range(8))
            for form in forms(self.triangles):
                self.assert_same(tribox.split(form, LO, HI, at), expected, type(form))
                for listed in (numbers, numbers.astype(np.uint32), numbers.tolist(), np.uint16(numbers)[::-1], []):
                    order = np.array(listed, int)
                    self.assert_same(tribox.split(form, (LO, HI), None, at, listed), expected[order], type(form))
        for wrong, error, text in (([0, 500], tribox.BadIndexError, r"numbers\[1\] is 500, but there are 300 triangles"),
                                   (np.array([7, 2**32 - 1], np.uint32), tribox.BadIndexError, r"numbers\[1\] is 4294967295"),
                                   ([-1], tribox.BadIndexError, r"numbers\[0\] is -1"), ([0.5], tribox.InputTypeError, "whole"),
                                   ([[1]], tribox.InputTypeError, r"of int64 and shape \(1, 1\)")):
            with self.assertRaisesRegex(error, text):
                tribox.split(self.triangles, LO, HI, numbers=wrong)
        for arguments, text in (({"middle": (9, 0, 0)}, r"middle = \(9, 0, 0\)"), ({"axes": tribox.AXES_PLANE}, "axes = 2")):
            with self.assertRaisesRegex(tribox.InputError, text):
                tribox.split(self.triangles, LO, HI, **arguments)

    def test_boxes(self):
        bounds = self.triangles.reshape(-1, 3)[:500]
        lo, hi = (np.ascontiguousarray(part.T) for part in (np.minimum(bounds, bounds[::-1]), np.maximum(bounds, bounds[::-1])))
        for triangle in self.triangles[:5]:
            expected = np.array([cases.truth(triangle[None], lo[:, i], hi[:, i])[0] for i in range(500)])
            self.assert_same(tribox.overlap_boxes(triangle, lo, hi), expected)
            for form in ((lo.T, hi.T), (lo.T.astype(float), hi), (lo.T.tolist(), hi.T.tolist()), (np.stack([lo.T, hi.T], 1),)):
                self.assert_same(tribox.overlap_boxes(triangle, *form), expected)
            self.assert_same(tribox.overlap_boxes(triangle.tolist(), lo[:, :70], hi[:, :70], kernel="scalar"), expected[:70])
            words = tribox.overlap_boxes(triangle, lo, hi, packed=True)
            self.assert_same(tribox.mask_indices(words), np.flatnonzero(expected).astype(np.uint32))
        for none in ((lo[:, :0], hi[:, :0]), (lo.T[:0], hi.T[:0]), ([], []), (np.zeros((0, 2, 3)),)):
            self.assertEqual(tribox.overlap_boxes(triangle, *none).shape, (0,))
        for rows in (lo[:, :3].T, np.array(lo[:, :3].T, order="F")):  # three rows are rows
            self.assert_same(tribox.overlap_boxes(self.triangles[4], rows, hi[:, :3].T), expected[:3])

    def test_oriented(self):
        center, half = (0.25, -0.5, 0), (1.5, 0.5, 0.75)
        for frame in (((1, 0, 0), (0, 1, 0), (0, 0, 1)), ((1, 1, 0), (-1, 1, 0), (0, 0, 1)), ((1, 2, 2), (2, 1, -2), (2, -2, 1))):
            # The move is exact on the lattice, and the box is axis-aligned after it.
            moved = (self.triangles.astype(float) - center) @ np.transpose(frame)
            expected = cases.truth(moved, np.negative(half), half)
            self.assertTrue(expected.any() and not expected.all())
            for form in forms(self.triangles):
                self.assert_same(tribox.overlap_oriented(form, center, half, frame), expected)
                self.assert_same(tribox.overlap_oriented(form, center, half, np.array(frame), packed=True),
                                 tribox.overlap_oriented(tribox.Soup.of(form), center, half, frame, packed=True))

    def test_blocks(self):
        triangles = np.resize(self.triangles, (MANY, 3, 3))
        soup = tribox.Soup.of(triangles)
        self.assertEqual(len(soup), MANY)
        expected = np.resize(self.expected, MANY)
        self.assert_same(tribox.overlap(triangles, LO, HI), expected)
        for form in (triangles, soup):
            overlapping, inside = tribox.classify(form, LO, HI)
            self.assert_same(overlapping, expected)
            self.assert_same(inside, np.resize(self.inside, MANY))
            self.assert_same(tribox.overlap_oriented(form, (0, 0, 0), (1, 1, 1), np.eye(3)),
                             np.resize(cases.truth(self.triangles, (-1, -1, -1), (1, 1, 1)), MANY))

    def test_indices(self):
        self.assertEqual(tribox.mask_indices(np.zeros(3, np.uint64)).size, 0)
        self.assertEqual(tribox.mask_indices(np.array([1, 0, 1 << 63], np.uint64)).tolist(), [0, 191])


class Documents(unittest.TestCase):
    def test_examples(self):
        results = doctest.testmod(tribox)
        self.assertEqual((results.failed, results.attempted > 0), (0, True))

    def test_names(self):
        for name in tribox.__all__:
            self.assertTrue(hasattr(tribox, name), name)
            if callable(getattr(tribox, name)):
                self.assertTrue(getattr(tribox, name).__doc__, name)
        self.assertIn(tribox.kernel_name(), KERNELS)
        self.assertIsNone(tribox.kernel_name("sse9"))
        self.assertEqual((tribox.kernel_name(), tribox.kernel_name("scalar")), (KERNELS[0], KERNELS[-1]))


if __name__ == "__main__":
    cases.main()
