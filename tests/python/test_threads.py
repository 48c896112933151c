"""Threads call at once, on shared input and into shared cells; and calls have threads of their own."""

import os
import subprocess
import sys
import threading
import time
import unittest
import weakref
from unittest import mock

import numpy as np
import tribox
from tribox import _index, _sharing, _voxelize
from tribox._threads import in_threads

import cases
from cases import HI, LO

THREADS, ROUNDS = 4, 100


def at_once(work):
    """Runs work(0), work(1), ... in threads that start together; returns what they return."""
    answers, failures, start = [None] * THREADS, [], threading.Barrier(THREADS)

    def run(number):
        try:
            start.wait()
            answers[number] = work(number)
        except BaseException as failure:
            failures.append(failure)

    threads = [threading.Thread(target=run, args=(number,)) for number in range(THREADS)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    if failures:
        raise failures[0]
    return answers


class Threads(cases.TestCase):
    def setUp(self):
        self.triangles = np.resize(cases.lattice(500), (20000, 3, 3))
        self.boxes = [(np.add(LO, number / 8), np.add(HI, number / 4)) for number in range(THREADS)]

    def test_shared_input(self):
        mesh, soup = tribox.Mesh(*cases.shared_vertices(self.triangles, np.uint32)), tribox.Soup.of(self.triangles)
        index = tribox.Index(mesh)
        expected = [np.resize(cases.truth(self.triangles[:500], *box), 20000) for box in self.boxes]

        def work(number):
            for round_number in range(ROUNDS):
                form = (self.triangles, mesh, soup)[(number + round_number) % 3]
                self.assert_same(tribox.overlap(form, *self.boxes[number]), expected[number])
                self.assert_same(tribox.classify(form, *self.boxes[number])[0], expected[number])
                self.assert_same(index.overlap(*self.boxes[number]), expected[number])

        at_once(work)

    def test_errors(self):
        """A thread gets its own errors, and others none of them."""
        def work(number):
            for round_number in range(ROUNDS):
                if number % 2:
                    self.refuse(tribox.InputError, "BAD_BOX", f"{number}, nan, {round_number}", tribox.overlap, self.triangles[:9],
                                (number, float("nan"), round_number), HI)
                else:
                    tribox.overlap(self.triangles[:9], LO, HI)

        at_once(work)


class Sharing(cases.TestCase):
    """How the calls share their work: the answers are those of one thread."""

    def setUp(self):
        self.triangles = cases.some()

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
            with mock.patch.multiple(_sharing, processors=lambda: 64, **way), mock.patch.object(_voxelize, "MAPPED", mapped):
                yield way

    def test_threads(self):
        """As they are shared out, by layers and by triangles, whatever pays."""
        for _ in self.ways():
            for grid in cases.GRIDS.values():
                for form in cases.forms(self.triangles):
                    self.ask_threads(form, grid)
            for accuracy in "conservative", "fast":
                for form in cases.forms(self.triangles):
                    self.ask_threads(form, cases.GRIDS["floats"], accuracy=accuracy)
                self.ask_threads(tribox.Soup.of(self.triangles[:1]), cases.GRIDS["floats"], accuracy=accuracy)
            self.ask_threads(np.zeros((0, 3, 3), np.float32), cases.GRIDS["floats"])
            self.ask_threads(tribox.Mesh(np.zeros((0, 3)), np.zeros((0, 3), int)), cases.GRIDS["floats"])
            self.ask_threads(self.triangles, cases.GRIDS["floats"], axes=tribox.AXES_PLANE)

    def test_sizes(self):
        """Threads on both sides of what decides how they share, and of large pages."""
        for count, size in (40, 16), (40, 600), (3000, 300), (1 << 15, 64), (1 << 16, 200), (1 << 19, 64), (1 << 19, 300):
            triangles = tribox.Soup.of(np.resize(cases.lattice(40) / 64, (count, 3, 3)))
            grid = (*cases.GRIDS["floats"][:2], (size,) * 3)
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
                    tribox.voxelize(triangles, (*cases.GRIDS["floats"][:2], (size,) * 3), threads=threads)
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
                    work = _sharing.LayersWork(tribox._triangles.held(triangles), grid, (0, 0, 0), size, tribox.AXES_ALL, 100)
                    cuts = work.cut(parts)
                    self.assertEqual([k for low, high in cuts for k in range(low, high)], list(range(size[2])))
                    self.assertLessEqual(len(cuts), parts)
        many = tribox.Mesh(np.resize(high, (5000, 3, 3)))
        halves = _sharing.LayersWork(many, grid, (0, 0, 0), grid.size, tribox.AXES_ALL, 100).cut(2)
        self.assertIn(halves[0][1], (30, 31))

    def test_bad_indices_by_threads(self):
        """A wrong index in the last share: no other share has written."""
        vertices, faces = cases.shared_vertices(self.triangles, np.uint32)
        faces[-1, 2] = len(vertices)
        wrong, into = tribox.Mesh(vertices, faces), tribox.voxelize(self.triangles[:0], cases.GRIDS["floats"])
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
            words, are_clear = _voxelize.new_words((1, 1 << 12, 1 << 14))
            self.assertTrue(are_clear)
            self.assertTrue(not words.any() and words.flags.writeable and not words.ctypes.data % _voxelize.LARGE_PAGE)
            part = words[0, -1, :]
            del words
            part[-1] = 1
            self.assertGreater(mapped(), before + 400)
            del part
            self.assertLess(mapped(), before + 100)

    def test_bricks(self):
        """Of whatever tiles, and where triangles are listed in parts of a few; and lists of cells, of windows of a few."""
        for grid in cases.GRIDS.values():
            for form in self.triangles, tribox.Soup.of(self.triangles), self.triangles.astype(float):
                for side in (8, 64):
                    whole = tribox.bricks(form, grid, side=side)
                    for threads, alone in ((2, 1 << 16), (None, 1 << 16), (2, 0), (7, 0)):
                        with mock.patch("tribox._tiles.LISTED_ALONE", alone):
                            bricks = tribox.bricks(form, grid, side=side, threads=threads)
                        self.assert_same(bricks.at, whole.at)
                        self.assert_same(bricks.bits, whole.bits)
                whole = tribox.cell_lists(form, grid)
                for side, most, threads in (1 << 5, 1 << 22, 7), (1 << 5, 1 << 22, None), (7, 1, 2), (7, 1000, 1), (40, 4, 2):
                    with mock.patch("tribox._cells.SIDE", side), mock.patch("tribox._cells.TILES_MAX", most):
                        lists = tribox.cell_lists(form, grid, threads=threads)
                    for name in ("cells", "start", "triangles"):
                        self.assert_same(getattr(lists, name), getattr(whole, name))

    def test_index(self):
        """The same bytes, whatever the number of threads, on both sides of where they share; wrong indices are named."""
        for count in (0, 100, _index.SHARED_LEAST - 1, _index.SHARED_LEAST, 5 * tribox._library.lib.TRIBOX_INDEX_BLOCK + 1):
            triangles = np.resize(cases.lattice(500), (count, 3, 3)) + np.arange(count, dtype=np.float32)[:, None, None] % 97
            faces = np.arange(3 * count).reshape(-1, 3)
            for form in triangles, tribox.Soup.of(triangles), tribox.Mesh(triangles.reshape(-1, 3), faces), triangles.astype(float):
                for keep_order in (False, True):
                    one = tribox.Index(form, keep_order=keep_order)
                    for threads in (2, 3, 8):
                        with mock.patch.object(_index, "processors", lambda: 8):
                            index = tribox.Index(form, keep_order=keep_order, threads=threads)
                        np.testing.assert_array_equal(index._nodes, one._nodes)
                        np.testing.assert_array_equal(index.list((-2,) * 3, (2,) * 3), one.list((-2,) * 3, (2,) * 3))
                        np.testing.assert_array_equal(index._ids, one._ids)
        faces = np.zeros((2 * _index.SHARED_LEAST, 3), np.uint32)
        faces[-1, 1] = 9
        for keep_order in (False, True):
            self.refuse(tribox.BadIndexError, "BAD_VERTEX", rf"faces\[{len(faces) - 1}, 1\] is 9", tribox.Index,
                        (np.zeros((9, 3)), faces),
                        keep_order=keep_order, threads=2)
        self.refuse(tribox.InputError, None, "^threads = -1", tribox.Index, self.triangles, threads=-1)

    def test_lists(self):
        index, pick = tribox.Index(np.resize(cases.lattice(500), (3000, 3, 3))), np.random.default_rng(cases.seed())
        for count in (0, 1, 255, 256, 257, 1000):
            lo = pick.uniform(-2, 1, (count, 3)).astype(np.float32)
            hi = (lo + pick.uniform(-0.1, 2, (count, 3))).astype(np.float32)
            for los, his in (lo, hi), (lo + 1e-9, hi.astype(float)):
                expected = index.lists(los, his)
                for threads in (2, 3, 8):
                    with mock.patch.object(_index, "processors", lambda: 8):
                        for one, other in zip(index.lists(los, his, threads=threads), expected):
                            self.assert_same(one, other)

    def test_damaged_pickle(self):
        """Numbers that are not one for each triangle would be read beyond their end."""
        state = tribox.Index(self.triangles).__getstate__()
        for odd in (state["ids"][1:], state["ids"].astype(np.uint16)):
            other = tribox.Index.__new__(tribox.Index)
            self.refuse(tribox.InputError, None, "100 triangles", other.__setstate__, {**state, "ids": odd})


class InThreads(cases.TestCase):
    """How the module shares work out."""

    def test_order(self):
        for threads in (1, 2, 3, 8):
            for count in (0, 1, 2, 50):
                self.assertEqual(in_threads(threads, lambda part: part * part, range(count)), [n * n for n in range(count)])

    def test_failure(self):
        """Whatever a part raises is raised, in whichever thread it was, and few parts more are started."""
        for error in (IndexError, RuntimeError, KeyboardInterrupt):
            for wrong in (0, 1, 5):
                begun = []

                def work(part):
                    begun.append(part)
                    if part == wrong:
                        raise error(part)
                    time.sleep(0.001)

                with self.assertRaisesRegex(error, str(wrong)):
                    in_threads(2, work, range(1000))
                self.assertLess(len(begun), 500)

    def test_no_threads(self):
        """Where the system starts none, one does all."""
        with mock.patch("tribox._threads.parked", []), \
                mock.patch.object(threading.Thread, "start", side_effect=RuntimeError("can't start new thread")):
            self.assertEqual(in_threads(4, str, range(9)), list(map(str, range(9))))

    def test_helpers_stay(self):
        """They are called again, and hold on to nothing meanwhile."""
        before = threading.active_count()
        for _ in range(50):
            held = np.zeros(10)
            kept = weakref.ref(held)
            self.assertEqual(in_threads(4, lambda part, held=held: held.sum() + part, range(50)), list(range(50)))
            del held
            self.assertIsNone(kept())
        self.assertLessEqual(threading.active_count(), before + 3)

    def test_nested(self):
        """Each of the threads has others to help it."""
        self.assertEqual(in_threads(3, lambda part: sum(in_threads(3, int, range(part))), range(20)),
                         [part * (part - 1) // 2 for part in range(20)])

    @unittest.skipUnless(hasattr(os, "fork"), "needs fork")
    def test_forked(self):
        """A child has none of its parent's threads, and starts its own."""
        script = ("import os, signal; from tribox._threads import in_threads; in_threads(4, str, range(50)); child = os.fork()\n"
                  "if not child: signal.alarm(20); os._exit(in_threads(4, int, range(50)) != list(range(50)))\n"
                  "raise SystemExit(os.waitpid(child, 0)[1])")
        self.assertEqual(subprocess.run([sys.executable, "-W", "ignore", "-c", script], timeout=60).returncode, 0)


if __name__ == "__main__":
    cases.main()
