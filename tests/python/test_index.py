"""An Index answers as tribox.overlap does, in the caller's numbers, whatever it was made of."""

import copy
import pickle
import threading
from unittest import mock

import numpy as np
import tribox
from tribox import BadIndexError, InputError, InputTypeError, _index, _order
from tribox._library import lib

import cases
from cases import HI, LO

NAN, TRIBOX_INDEX_BLOCK = float("nan"), lib.TRIBOX_INDEX_BLOCK
BOXES = [(LO, HI), ((0, 0, 0), (2, 2, 2)), ((-2, -2, -2), (2, 2, 2)), ((0.5, -2, -2), (0.5, 2, 2)), ((3, 3, 3), (4, 4, 4)),
         ((1, 0, 0), (-1, 1, 1))]


def forms(triangles):
    """The same triangles in every form, with the options of Index."""
    streams = np.ascontiguousarray(triangles.T)
    mesh = tribox.Mesh(*cases.shared_vertices(np.nan_to_num(triangles), np.uint32)) if np.isfinite(triangles).all() else triangles
    for form in (triangles, mesh, tribox.Soup(streams), streams.T, tribox.Soup([list(axis) for axis in streams]),
                 triangles.astype(float)):
        for keep_order in (False, True):
            yield tribox.Index(form, keep_order=keep_order)


def streams_of(boxes):
    return [np.ascontiguousarray(np.float32([box[side] for box in boxes]).reshape(-1, 3).T) for side in range(2)]


class Answers(cases.TestCase):
    def check(self, index, expected, lo, hi=None, **options):
        """All questions about one box, against n bools."""
        count, numbers = len(expected), np.flatnonzero(expected).astype(np.uint32)
        self.assert_same(index.overlap(lo, hi, **options), expected)
        packed = index.overlap(lo, hi, packed=True, **options)
        self.assert_same(tribox.mask_indices(packed), numbers)
        self.assertEqual(packed.size, (count + 63) // 64)
        listed = index.list(lo, hi, **options)
        self.assert_same(listed if 'as given' in repr(index) else np.sort(listed), numbers)
        self.assertEqual(index.count(lo, hi, **options), len(numbers))
        self.assertIs(index.any(lo, hi, **options), len(numbers) > 0)

    def test_truth(self):
        for count in (0, 1, 63, 64, 65, 300):
            triangles = cases.lattice(count)
            answers = [cases.truth(triangles, *box) for box in BOXES]
            for index in forms(triangles):
                self.assertEqual(len(index), count)
                for box, expected in zip(BOXES, answers):
                    self.check(index, expected, *box)

    def test_like_overlap(self):
        """More than 4096 triangles of all sizes, some of them not finite."""
        triangles = cases.scattered(10000)
        triangles[5, 1, 2], triangles[4000:4100, 0, 0], triangles[-1, 2, 1] = NAN, np.inf, -np.inf
        for index in forms(triangles):
            for box in BOXES:
                self.check(index, tribox.overlap(triangles, *box), *box)

    def test_options(self):
        triangles = cases.lattice(200)
        for index in (tribox.Index(triangles), tribox.Index(triangles, keep_order=True)):
            for options in (dict(accuracy="conservative"), dict(axes=tribox.AXES_BOX), dict(axis_order=321),
                            dict(axes=tribox.AXES_BOX | tribox.AXES_EDGES), *(dict(kernel=name) for name in tribox.kernels())):
                self.check(index, tribox.overlap(triangles, LO, HI, **options), LO, HI, **options)
            fast = index.overlap(LO, HI, accuracy="fast")
            self.assertFalse((tribox.overlap(triangles, LO, HI, accuracy="fast") & ~fast).any())

    def test_oriented(self):
        triangles = cases.scattered(5000)
        turned = np.array([[0.8, 0.6, 0], [-0.6, 0.8, 0], [0, 0, 1]])
        for index in forms(triangles):
            for box in (((0, 0.25, 0), (0.5, 1, 2), turned), ((0, 0, 0), (3, 3, 3), np.eye(3)), ((0, 0, 0), (-1, 1, 1), turned)):
                self.check(index, tribox.overlap_oriented(triangles, *box), tribox.OrientedBox(*box))

    def test_out(self):
        triangles = cases.lattice(130)
        expected = tribox.overlap(triangles, LO, HI)
        for index in (tribox.Index(triangles), tribox.Index(triangles, keep_order=True)):
            for out in (np.ones(130, bool), np.ones(260, bool)[::2]):
                self.assertIs(index.overlap(LO, HI, out=out), out)
                self.assert_same(out, expected)
            words = np.full(3, 2 ** 64 - 1, np.uint64)
            self.assertIs(index.overlap(LO, HI, out=words), words)
            self.assert_same(words, tribox.overlap(triangles, LO, HI, packed=True))

    def test_lists(self):
        """Also where more is found than there was room for at first, and where nothing is."""
        triangles = cases.lattice(1000)
        far = [((10, 10, 10), (11, 11, 11))]
        for index in (tribox.Index(triangles), tribox.Index(triangles, keep_order=True)):
            for boxes in (BOXES, BOXES * 20, far, [], [((NAN, 0, 0), (1, 1, 1)), *BOXES, ((0, 0, 0), (1, np.inf, 1))]):
                numbers, start = index.lists(*streams_of(boxes))
                self.assertEqual((numbers.dtype, start.dtype, start.shape), (np.uint32, np.intp, (len(boxes) + 1,)))
                self.assertEqual((start[0], start[-1]), (0, len(numbers)))
                los, his = streams_of(boxes)
                forms = [(los.T.astype(float), his.T), (np.stack([los.T, his.T], 1),), (los.T.tolist(), his.T.tolist()),
                         (np.nextafter(los.T.astype(float), -9), his.T)]  # which float32 cannot hold: no answer moves
                for form in forms[:3] if len(boxes) == 3 else [(los.astype(float), his), *forms]:
                    for one, other in zip(index.lists(*form), (numbers, start)):
                        self.assert_same(one, other)
                for i, box in enumerate(boxes):
                    own = numbers[start[i]:start[i + 1]]
                    expected = index.list(*box) if np.isfinite(box).all() else np.empty(0, np.uint32)
                    self.assert_same(own, expected)
            everything = [((-9, -9, -9), (9, 9, 9))] * 100
            numbers, start = index.lists(*streams_of(everything))
            self.assert_same(start, np.arange(101) * 1000)

    def test_long_list(self):
        """Longer than the room for a first answer."""
        triangles = np.resize(cases.lattice(300), (9000, 3, 3))
        expected = np.flatnonzero(np.resize(cases.truth(triangles[:300], *BOXES[2]), 9000)).astype(np.uint32)
        self.assertGreater(len(expected), 4096)
        self.assert_same(np.sort(tribox.Index(triangles).list(*BOXES[2])), expected)

    def test_rows(self):
        """Rows of three boxes are rows; lists that outgrow their room are whole, of float32 and of float64."""
        triangles = np.resize(cases.lattice(50), (5000, 3, 3))
        for index in (tribox.Index(triangles), tribox.Index(triangles, keep_order=True)):
            for boxes in (BOXES[:3], [BOXES[2]] * 70, [BOXES[3], BOXES[2]] * 9, BOXES * 30):
                rows = np.array(boxes, np.float32)
                each = [index.list(*box) for box in boxes]
                for los, his in ((rows[:, 0], rows[:, 1]), (rows[:, 0] - 1e-9, rows[:, 1] + 1e-9)):
                    numbers, start = index.lists(los, his)
                    self.assert_same(start, np.cumsum([0, *map(len, each)]))
                    self.assert_same(numbers, np.concatenate(each))
        self.refuse(InputError, None, "^lo has shape", index.lists, rows[:, :, :2])

    def test_corners(self):
        index = tribox.Index(cases.lattice(100))
        for corners in (np.array([LO, HI]), (LO, HI), [list(LO), np.array(HI)]):
            self.assert_same(index.list(corners), index.list(LO, HI))
            self.assertEqual((index.count(corners), index.any(corners)), (index.count(LO, HI), index.any(LO, HI)))
            self.assert_same(index.overlap(corners), index.overlap(LO, HI))

    def test_repr(self):
        triangles = cases.lattice(100)
        size = tribox._library.lib.tribox_index_bytes(100)
        where = repr(tribox.Soup.of(triangles)).partition(", ")[2][:-1]
        for kind in "float32", "float64":
            form = triangles.astype(kind)
            self.assertEqual(repr(tribox.Index(form)), f"<tribox.Index: 100 triangles of {kind} in order, {size} bytes, {where}>")
            given = tribox.Index(form, keep_order=True)
            self.assertEqual(repr(given), f"<tribox.Index: 100 triangles of {kind} as given, {size} bytes, {where}>")


class Arrays(cases.TestCase):
    def test_soup_in_place(self):
        """A Soup whose order is kept is read where it lies; anything else is copied, and may change."""
        triangles = cases.lattice(100)
        expected = tribox.overlap(triangles, LO, HI)
        soup = tribox.Soup.of(triangles)
        wide = triangles.astype(float)
        for form in (triangles, soup, wide, tribox.Mesh(wide), tribox.Mesh(triangles)):
            for keep_order in (False, True):
                index, kept = tribox.Index(form, keep_order=keep_order), soup.streams.copy()
                triangles[:], soup.streams[:], wide[:] = NAN, NAN, NAN
                is_read = keep_order and form is soup
                self.assert_same(index.overlap(LO, HI), expected & (not is_read))
                triangles[:], soup.streams[:], wide[:] = kept.T, kept, kept.T

    def test_what_is_held_lives(self):
        index = tribox.Index(tribox.Soup.of(cases.lattice(200)), keep_order=True)
        expected = cases.truth(cases.lattice(200), LO, HI)
        for _ in range(20):
            np.full((200, 3, 3), np.nan, np.float32)
            self.assert_same(index.overlap(LO, HI), expected)

    def test_threads(self):
        triangles = np.resize(cases.lattice(500), (20000, 3, 3))
        index, wrong = tribox.Index(triangles), []
        expected = [np.sort(index.list(*box)) for box in BOXES]

        def work():
            for turn in range(60):
                wrong.extend([turn] * (not np.array_equal(np.sort(index.list(*BOXES[turn % 6])), expected[turn % 6])))

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])


    def test_made_by_threads(self):
        """The same bytes, whatever the number of threads, on both sides of where they share."""
        for count in (0, 100, _order.SHARED_LEAST - 1, _order.SHARED_LEAST, 5 * TRIBOX_INDEX_BLOCK + 1):
            triangles = np.resize(cases.lattice(500), (count, 3, 3)) + np.arange(count, dtype=np.float32)[:, None, None] % 97
            faces = np.arange(3 * count).reshape(-1, 3)
            for form in triangles, tribox.Soup.of(triangles), tribox.Mesh(triangles.reshape(-1, 3), faces), triangles.astype(float):
                for keep_order in (False, True):
                    one = tribox.Index(form, keep_order=keep_order)
                    for threads in (2, 3, 8):
                        with mock.patch.object(_index, "processors", lambda: 8):
                            index = tribox.Index(form, keep_order=keep_order, threads=threads)
                        np.testing.assert_array_equal(index._nodes, one._nodes)
                        np.testing.assert_array_equal(index.list(*BOXES[2]), one.list(*BOXES[2]))
                        if not keep_order:
                            np.testing.assert_array_equal(index._ids, one._ids)

    def test_wrong_by_threads(self):
        count = 2 * _order.SHARED_LEAST
        faces = np.zeros((count, 3), np.uint32)
        faces[-1, 1] = 9
        for keep_order in (False, True):
            self.refuse(BadIndexError, "BAD_VERTEX", rf"^faces\[{count - 1}, 1\] is 9, but there are 3", tribox.Index,
                        tribox.Mesh(np.zeros((3, 3), np.float32), faces), keep_order=keep_order, threads=2)
        self.refuse(InputError, None, "^threads = 0", tribox.Index, cases.lattice(9), threads=0)

    def test_lists_by_threads(self):
        """Boxes are shared out; some have more triangles than there is room for at first."""
        index, pick = tribox.Index(np.resize(cases.lattice(500), (3000, 3, 3))), np.random.default_rng(cases.seed())
        for count in (0, 1, 255, 256, 257, 1000):
            lo = pick.uniform(-2, 1, (count, 3)).astype(np.float32)
            hi = (lo + pick.uniform(-0.1, 2, (count, 3))).astype(np.float32)
            for los, his in (lo, hi), (lo + 1e-9, hi.astype(float)):
                expected = index.lists(los, his)
                for threads in (2, 3, 8):
                    with mock.patch.object(_index, "processors", lambda: 8):
                        numbers, start = index.lists(los, his, threads=threads)
                    np.testing.assert_array_equal(numbers, expected[0])
                    np.testing.assert_array_equal(start, expected[1])
                    self.assertEqual((numbers.dtype, start.dtype), (expected[0].dtype, expected[1].dtype))


class Pickles(cases.TestCase):
    def setUp(self):
        self.triangles = cases.lattice(5000)
        self.expected = cases.truth(self.triangles[:200], LO, HI)

    def same(self, index, other):
        self.assertEqual(repr(index), repr(other))
        np.testing.assert_array_equal(other._nodes, index._nodes)
        for box in BOXES:
            self.assert_same(other.list(*box), index.list(*box))
        self.assert_same(other.overlap(LO, HI)[:200], self.expected)

    def test_copies(self):
        for index in forms(self.triangles):
            for protocol in (2, pickle.HIGHEST_PROTOCOL):
                self.same(index, pickle.loads(pickle.dumps(index, protocol)))
            self.same(index, copy.deepcopy(index))
            self.same(index, copy.copy(index))

    def test_damaged(self):
        """Numbers that are not one for each triangle would be read beyond their end."""
        state = tribox.Index(self.triangles).__getstate__()
        for odd in (state["ids"][1:], state["ids"].astype(np.uint16)):
            other = tribox.Index.__new__(tribox.Index)
            self.refuse(InputError, None, "5000 triangles", other.__setstate__, {**state, "ids": odd})


class Errors(cases.TestCase):
    def setUp(self):
        self.triangles = cases.lattice(70)
        self.index = tribox.Index(self.triangles)

    def test_triangles(self):
        for odd in (None, "triangles", self.triangles.astype(complex)):
            self.refuse(InputTypeError, None, "triangles is .*; give real numbers", tribox.Index, odd)
        for odd in ([[0, 0, 0]], 1):
            self.refuse(InputError, None, "triangles has shape", tribox.Index, odd)
        vertices, faces = cases.shared_vertices(self.triangles, np.uint32)
        for keep_order in (False, True):
            for wrong, kind in ((len(vertices), np.uint32), (-1, np.int32)):
                bad = faces.astype(kind)
                bad[17, 2] = wrong
                for points in (vertices, vertices.astype(float) + 0.1):
                    self.refuse(BadIndexError, "BAD_VERTEX", fr"faces\[17, 2\] is {wrong}", tribox.Index, (points, bad),
                                keep_order=keep_order)

    def test_questions(self):
        kept = tribox.Index(self.triangles, keep_order=True)
        for index in (self.index, kept, tribox.Index(self.triangles[:0])):
            for call in (index.overlap, index.count, index.any, index.list):
                self.refuse(InputError, "BAD_BOX", r"NaN or infinite: lo = \(nan, 0, 0\)", call, (NAN, 0, 0), HI)
                self.refuse(InputError, None, "^hi = .*; give three numbers", call, LO, (1, 2))
                for axes in (tribox.AXES_PLANE, tribox.AXES_PLANE | tribox.AXES_EDGES):
                    self.refuse(InputError, "BAD_OPTION", f"axes = {axes}; an Index needs AXES_BOX", call, LO, HI, axes=axes)
                self.refuse(InputError, "BAD_OPTION", "axis_order = 4", call, LO, HI, axis_order=4)
                self.refuse(InputError, None, "accuracy = 'exakt'", call, LO, HI, accuracy="exakt")
                self.refuse(InputError, "NO_KERNEL", "kernel = 'sse9'", call, LO, HI, kernel="sse9")

    def test_oriented(self):
        box, axis = tribox.OrientedBox, np.eye(3)
        for call in (self.index.overlap, self.index.count, self.index.any, self.index.list):
            self.refuse(InputError, "BAD_BOX", r"half = \(1, inf, 1\)", call, box(LO, (1, np.inf, 1), axis))
            self.refuse(InputError, None, "axis = .*; give three times three numbers", call, box(LO, HI, np.eye(4)))
            self.refuse(InputError, "BAD_OPTION", "axes = 6", call, box(LO, HI, axis), axes=6, accuracy="fast")
            self.refuse(InputError, "BAD_OPTION", "axes = 3; give AXES_ALL or AXES_BOX", call, box(LO, HI, axis), axes=3)
            self.refuse(InputError, None, "^hi = .*; give an OrientedBox alone", call, box(LO, HI, axis), HI)

    def test_out(self):
        out = np.zeros(70, bool)
        for odd in (np.zeros(69, bool), np.zeros(3, np.uint64)):
            self.refuse(InputError, None, "out has shape", self.index.overlap, LO, HI, out=odd)
        with self.assertRaises(tribox.Error):
            self.index.overlap(LO, (9, 9, NAN), out=out)
        self.assertFalse(out.any())

    def test_boxes(self):
        bounds = np.zeros((3, 9), np.float32)
        self.refuse(InputError, None, r"lo has shape .*; give \(m, 3\)", self.index.lists, bounds[:2], bounds)
        self.refuse(InputTypeError, None, "hi is ndarray of complex128", self.index.lists, bounds, bounds.astype(complex))
        self.refuse(InputError, None, "lo has 9 boxes and hi 8", self.index.lists, bounds, bounds[:, :8])
        self.refuse(InputError, "BAD_OPTION", "axes = 6", self.index.lists, bounds, bounds, axes=6)


if __name__ == "__main__":
    cases.main()
