"""Every call gives the answers that the library gives here (answers.c), and those of rational numbers: a table of ways to ask."""

import copy
import pickle
import warnings
from types import SimpleNamespace

import numpy as np
import tribox

import cases
from cases import WINDOW

BOX, ORDERS = tribox.AXES_BOX, (123, 132, 213, 231, 312, 321)


def unpacked(words, count):
    assert words.shape == ((count + 63) // 64,) and not np.setdiff1d(tribox.mask_indices(words), np.arange(count)).size
    return np.unpackbits(words.astype("<u8").view(np.uint8), bitorder="little")[:count].view(bool)


def marked(numbers, count):
    """A list as a mask."""
    assert numbers.dtype == np.uint32 and len(np.unique(numbers)) == len(numbers)
    mask = np.zeros(count, bool)
    mask[numbers] = True
    return mask


def written(a, out):
    answer = tribox.overlap(a.form, *a.box, out=out)
    assert answer is out
    return out


def ways_of_index(name):
    """How an index is asked; name: of it, its answers and its box."""
    def each(index, box):
        lists, start = index.lists(np.array([box]), threads=2) if isinstance(box, tuple) else (index.list(box), None)
        assert start is None or start.dtype == np.intp and start.tolist() == [0, len(lists)]
        return lists

    answer, box = ("axes7", lambda a: a.box) if name.endswith("box") else ("oriented7", lambda a: a.oriented)
    index = (lambda a: a.kept) if name.startswith("kept") else (lambda a: a.index)
    return [(answer, lambda a: index(a).overlap(box(a))),
            (answer, lambda a: unpacked(index(a).overlap(box(a), packed=True), a.count)),
            (answer, lambda a: index(a).overlap(box(a), out=np.ones(2 * a.count, bool)[::2])),
            (answer, lambda a: marked(index(a).list(box(a)), a.count)), (answer, lambda a: marked(each(index(a), box(a)), a.count)),
            (answer, lambda a: np.arange(a.count) < 0 if not index(a).any(box(a)) else a.answers[answer]),
            (answer, lambda a: a.answers[answer] if index(a).count(box(a)) == a.answers[answer].sum() else ~a.answers[answer])]


# (answer, how it is asked)
PAIRS = [
    *((f"axes{n}", lambda a, n=n: tribox.overlap(a.form, *a.box, axes=n)) for n in range(1, 8)),
    *(("axes7", lambda a, order=order: tribox.overlap(a.form, *a.box, axis_order=order)) for order in ORDERS),
    *(("axes7", lambda a, kernel=kernel: tribox.overlap(a.form, *a.box, kernel=kernel)) for kernel in tribox.kernels()),
    ("axes7", lambda a: tribox.overlap(a.form, a.box)),
    ("axes7", lambda a: tribox.overlap(a.form, list(a.box[0]), np.array(a.box[1]))),
    ("axes7", lambda a: unpacked(tribox.overlap(a.form, *a.box, packed=True), a.count)),
    ("axes7", lambda a: written(a, np.ones(a.count, bool))),
    ("axes7", lambda a: written(a, np.ones((a.count, 2), bool)[:, 0])),
    ("axes7", lambda a: unpacked(written(a, np.full((a.count + 63) // 64, -1, np.int64).view(np.uint64)), a.count)),
    ("axes7", lambda a: tribox.classify(a.form, *a.box)[0]),
    ("axes7", lambda a: unpacked(tribox.classify(a.form, a.box, packed=True)[0], a.count)),
    ("axes7", lambda a: marked(tribox.crop(a.form, *a.box).face_numbers.astype(np.uint32), a.count)),
    ("axes7", lambda a: ~marked(tribox.crop(a.form, a.box, rest=True).face_numbers.astype(np.uint32), a.count)),
    ("inside", lambda a: tribox.classify(a.form, *a.box)[1]),
    ("inside", lambda a: unpacked(tribox.classify(a.form, *a.box, packed=True)[1], a.count)),
    ("inside", lambda a: marked(tribox.crop(a.form, *a.box, inside=True).face_numbers.astype(np.uint32), a.count)),
    ("axes7First", lambda a: tribox.find(a.form, *a.box)),
    ("axes7FirstMiss", lambda a: tribox.find(a.form, a.box, what="miss")),
    ("oriented7First", lambda a: tribox.find(a.form, a.oriented)),
    ("oriented7FirstMiss", lambda a: tribox.find(a.form, a.oriented, what="miss")),
    ("isAny", lambda a: tribox.overlap_any(a.form, *a.box)),
    ("isAll", lambda a: tribox.overlap_all(a.form, a.box)),
    ("children", lambda a: tribox.split(a.form, *a.box)),
    ("childrenAt", lambda a: tribox.split(a.form, *a.box, (a.box[0][0], a.box[1][1], a.box[0][2]), axes=BOX)),
    ("oriented7", lambda a: tribox.overlap_oriented(a.form, *a.oriented)),
    ("oriented7", lambda a: unpacked(tribox.overlap_oriented(a.form, *a.oriented, packed=True), a.count)),
    ("oriented7", lambda a: marked(tribox.crop(a.form, a.oriented).face_numbers.astype(np.uint32), a.count)),
    ("oriented1", lambda a: tribox.overlap(a.form, a.oriented, axes=BOX)),
    *(way for name in ("index, box", "kept, box", "index, oriented", "kept, oriented") for way in ways_of_index(name)),
]


def voxels(a, **keywords):
    return tribox.voxelize(a.form, a.grid, **keywords)


def dense(bricks):
    """The cells of bricks, which are in the order of tiles of 16 cells."""
    cells, at = np.zeros(bricks.grid.size[::-1], bool), bricks.cells()
    cells[tuple(at.T[::-1])] = True
    assert (bricks.at.dtype, bricks.bits.dtype) == (np.uint32, np.uint64) and bricks.bits.any(1).all() and len(at) == cells.sum()
    return cells


def filled(a, fill, **keywords):
    """A warning tells of an open mesh, and outside of one in which nothing is."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        answer = voxels(a, fill=fill, **keywords)
    is_warned = np.array_equal(answer, a.answers["cells"]) if fill == "outside" else a.answers.get("isOdd", 0)
    assert [one.category for one in caught] == [tribox.OpenMeshWarning] * is_warned, caught
    assert all(one.filename == __file__ for one in caught)
    return answer


def in_window(cells):
    return ((cells >= WINDOW[0]) & (cells < np.add(*WINDOW))).all(1)


def window_of_lists(a, **keywords):
    """(counts, numbers) of the cells of the window."""
    lists = tribox.cell_lists(a.form, a.grid, **keywords)
    assert (lists.cells.dtype, lists.start.dtype, lists.triangles.dtype) == (np.uint32, np.intp, np.uint32)
    counts, is_in = np.diff(lists.start), in_window(lists.cells)
    return counts[is_in], lists.triangles[np.repeat(is_in, counts)]


def cells_of_lists(a):
    lists, cells = tribox.cell_lists(a.form, a.grid, threads=2), np.zeros((5, 9, 70), bool)
    cells[tuple(lists.cells.T[::-1].astype(int))] = True
    return cells


def ids_of_bricks(a, side):
    bricks = tribox.bricks(a.form, a.grid, side=side, ids=True, threads=2)
    cells = bricks.cells()
    order = np.lexsort(cells.T)
    return bricks.ids[order][in_window(cells[order])]


def added(a, **keywords):
    """Into what was there."""
    into = tribox.voxelize(a.triangles[:0], a.grid, **keywords)
    assert voxels(a, into=into, threads=2, **keywords) is into
    return into


def joined(parts):
    """Bricks of several shares as one."""
    return tribox.Bricks(*(np.concatenate([getattr(part, name) for part in parts]) for name in ("at", "bits")), parts[0].grid)


CELLS = [
    ("cells", voxels),
    ("cells", lambda a: voxels(a, threads=2)),
    ("cells", lambda a: voxels(a, kernel="scalar")),
    ("cells", lambda a: np.concatenate([voxels(a, layers=layers) for layers in ((0, 2), (2, 0), (2, 3))])),
    ("cells", added),
    ("cells", cells_of_lists),
    ("cells", lambda a: tribox.voxelize(a.form, tribox.Grid(*a.grid), ids=True)),
    *(("cells", lambda a, side=side: dense(tribox.bricks(a.form, a.grid, side=side))) for side in (8, 24, 1024)),
    ("cells",
     lambda a: dense(joined([tribox.bricks(a.form, a.grid, side=8, tiles=share, threads=2) for share in ((0, 7), (7, 11))]))),
    ("thin", lambda a: voxels(a, thin=True)),
    ("outside", lambda a: filled(a, "outside")),
    ("outside", lambda a: filled(a, "outside", threads=2)),
    ("parity", lambda a: filled(a, "parity", labels=True)),
    ("parity", lambda a: np.asarray(filled(a, "middles")) | a.answers["cells"]),
    ("parity", lambda a: (filled(a, "parity", labels=True).labels() == 2) | a.answers["cells"]),
    ("windowCells", lambda a: voxels(a, window=WINDOW)),
    ("windowCells", lambda a: added(a, window=WINDOW)),
    ("windowThin", lambda a: voxels(a, window=WINDOW, thin=True)),
    ("windowIds", lambda a: voxels(a, window=WINDOW, ids=True).ids),
    ("windowIds", lambda a: voxels(a, window=WINDOW, ids=True, threads=2).ids),
    *(("windowIds", lambda a, side=side: ids_of_bricks(a, side)) for side in (8, 24)),
    ("windowCounts", lambda a: window_of_lists(a)[0]),
    ("window", lambda a: window_of_lists(a, threads=2)[1]),
]


class Asking(cases.TestCase):
    def check(self, question, form, ways, about):
        a = SimpleNamespace(**vars(question), form=form, count=len(question.triangles))
        if ways is PAIRS:
            a.index, a.kept = (tribox.Index(form, keep_order=keep_order) for keep_order in (False, True))
        for number, (name, ask) in enumerate(ways):
            if name in a.answers:
                answer, expected = ask(a), a.answers[name]
                message = f"{question.name}, {about}, way {number} to {name}"
                if isinstance(expected, np.ndarray):
                    self.assert_same(np.asarray(answer), expected, message)
                else:
                    self.assertEqual((type(answer), answer), (type(expected), expected), message)

    def check_forms(self, question, ways, step=1, first=0):
        answers = question.answers
        answers.update(isAny=bool(answers["axes7"].any()), isAll=bool(answers["axes7"].all()))
        for name in {"axes7", "oriented7"} & answers.keys():
            for key, mask in (name + "First", answers[name]), (name + "FirstMiss", ~answers[name]):
                answers[key] = int(mask.argmax()) if mask.any() else None
        for number, form in enumerate(cases.forms(question.triangles)):
            if number % step == first % step:
                self.check(question, form, ways, f"form {number}")


class Answers(Asking):
    def test_pairs(self):
        for number, question in enumerate(cases.questions()):
            self.check_forms(question, PAIRS, 8, number // 2)

    def test_cells(self):
        asked = [question for question in cases.questions() if "cells" in question.answers]
        self.assertGreater(len(asked), 50)
        for number, question in enumerate(asked):
            self.check_forms(question, CELLS, 16, number // 2)

    def test_order(self):
        for question in cases.questions():
            self.assert_same(tribox.Index(question.triangles)._ids, question.answers["order"], question.name)

    def test_accuracies(self):
        """And that the options reach the library, which no answer on ordinary triangles would tell."""
        for question in cases.questions():
            exact = question.answers["axes7"]
            more, fast = (tribox.overlap(question.triangles, *question.box, accuracy=word) for word in ("conservative", "fast"))
            self.assertTrue((more >= exact).all(), question.name)
            if question.name == "eighths" and question.triangles.dtype == np.float32:
                self.assert_same(fast, exact)
        options = tribox._arguments.options_of("fast", 3, 213, "scalar")
        self.assertEqual((options.accuracy, options.axes, options.axis_order), (2, 3, 213))
        self.assertEqual(tribox._ffi.ffi.string(options.kernel), b"scalar")
        self.assertEqual(tribox._arguments.options_of("conservative", 7, 0, None).accuracy, 1)

    def test_counts(self):
        """Of every small number of triangles, in every form."""
        triangles = cases.lattice(300)
        mask = cases.truth(triangles, cases.LO, cases.HI)
        for count in (0, 1, 2, 3, 63, 64, 65, 129):
            inside = ((triangles[:count] >= cases.LO) & (triangles[:count] <= cases.HI)).all((1, 2))
            self.check_forms(cases.Question(name=f"{count}", triangles=triangles[:count], box=(cases.LO, cases.HI), answers={
                "axes7": mask[:count], "inside": inside}), PAIRS, 3, count)

    def test_copies_of_index(self):
        for question in cases.questions()[::9]:
            index = tribox.Index(question.triangles)
            for other in (pickle.loads(pickle.dumps(index, 2)), pickle.loads(pickle.dumps(index)), copy.copy(index),
                          copy.deepcopy(index)):
                self.assertEqual(repr(other), repr(index))
                self.assert_same(other._nodes, index._nodes)
                self.assert_same(other.list(question.box), index.list(question.box))


class Truth(Asking):
    """In rational numbers: what answers.c does not ask."""

    def test_many_boxes(self):
        """About one triangle, and by rows and columns, of floats and doubles, with some that are no boxes."""
        bounds = cases.lattice(170).reshape(-1, 3)[:500]
        for scale in (np.float32(1), 0.7):
            lo, hi = np.minimum(bounds, bounds[::-1]) * scale, np.maximum(bounds, bounds[::-1]) * scale
            lo[7, 1], hi[8, 2] = np.nan, np.inf
            for triangle in cases.lattice(5):
                expected = np.array([np.isfinite([a, b]).all() and cases.truth(triangle[None], a, b)[0] for a, b in zip(lo, hi)])
                for form in ((lo, hi), (lo.T, hi.T), (lo.astype(float), hi), (lo.tolist(), np.asfortranarray(hi)),
                             (np.stack([lo, hi], 1),)):
                    for one in (triangle, triangle.tolist(), triangle.astype(float)):
                        self.assert_same(tribox.overlap_boxes(one, *form), expected)
                    self.assert_same(unpacked(tribox.overlap_boxes(triangle, *form, packed=True), 500), expected)
                for rows in (lo[:3], np.asfortranarray(lo[:3])):  # three rows are rows
                    self.assert_same(tribox.overlap_boxes(triangle, rows, hi[:3], kernel="scalar"), expected[:3])
        for none in ((lo[:0], hi[:0]), (lo.T[:, :0], hi.T[:, :0]), ([], []), (np.zeros((0, 2, 3)),)):
            self.assertEqual(tribox.overlap_boxes(triangle, *none).shape, (0,))

    def test_lists(self):
        """Of many boxes: also where more is found than there was room for, of floats and of doubles, where one is no box."""
        triangles = np.resize(cases.lattice(50), (5000, 3, 3))
        boxes = [(cases.LO, cases.HI), ((-2, -2, -2), (2, 2, 2)), ((0.5, -2, -2), (0.5, 2, 2)), ((3, 3, 3), (4, 4, 4)),
                 ((1, 0, 0), (-1, 1, 1))]
        for index in (tribox.Index(triangles), tribox.Index(triangles, keep_order=True)):
            for asked in (boxes, boxes[:3], [boxes[1]] * 70, [boxes[2], boxes[1]] * 9, [boxes[3]], [],
                          [((np.nan, 0, 0), (1, 1, 1)), *boxes]):
                rows = np.array(asked, np.float32).reshape(-1, 2, 3)
                each = [index.list(*box) if np.isfinite(box).all() else np.empty(0, np.uint32) for box in asked]
                lo, hi = rows[:, 0], rows[:, 1]
                for form in ((lo, hi), (rows,), (lo.astype(float), hi), (lo.tolist(), hi.tolist()), (lo - 1e-9, hi + 1e-9),
                             *([] if len(lo) == 3 else [(lo.T, hi.T)])):
                    for threads in (1, 3):
                        numbers, start = index.lists(*form, threads=threads)
                        self.assert_same(start, np.cumsum([0, *map(len, each)], dtype=np.intp))
                        self.assert_same(numbers, np.concatenate([np.empty(0, np.uint32), *each]))

    def test_children(self):
        """Of some triangles, some of them more than once."""
        triangles, numbers = cases.lattice(300), np.random.default_rng(1).integers(0, 300, 700)
        whole = tribox.split(triangles, cases.LO, cases.HI)
        for listed in (numbers, numbers.astype(np.uint32), numbers.tolist(), np.uint16(numbers)[::-1], []):
            self.assert_same(tribox.split(triangles, cases.LO, cases.HI, numbers=listed), whole[np.array(listed, int)])

    def test_other_numbers(self):
        """Numbers of other types are the same numbers."""
        lattice = cases.lattice(50) * 8
        expected = cases.truth(lattice, (-4, -4, -4), (4, 4, 4))
        for dtype in (np.int8, np.int16, np.int32, np.int64, np.float16, ">f4", ">i4", np.longdouble):
            self.assert_same(tribox.overlap(lattice.astype(dtype), (-4, -4, -4), (4, 4, 4)), expected)
        large = lattice.astype(np.int64) + (1 << 52)
        self.assert_same(tribox.overlap(large, [(1 << 52) - 4] * 3, [(1 << 52) + 4] * 3), expected)
        point, tenth = np.full((1, 3, 3), 0.1, np.float32), np.float32(0.1)
        self.assertEqual([tribox.overlap_any(point, (x,) * 3, (x,) * 3) for x in (tenth, 0.1)], [True, False])


if __name__ == "__main__":
    cases.main()
