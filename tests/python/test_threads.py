"""Threads call at once, on shared input and into shared cells."""

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
        expected = [np.resize(cases.truth(self.triangles[:500], *box), 20000) for box in self.boxes]

        def work(number):
            for round_number in range(ROUNDS):
                form = (self.triangles, mesh, soup)[(number + round_number) % 3]
                self.assert_same(tribox.overlap(form, *self.boxes[number]), expected[number])
                self.assert_same(tribox.classify(form, *self.boxes[number])[0], expected[number])

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

    def test_layers(self):
        grid = (-2, -2, -2), 0.03125, (128, 128, 128)
        whole, each = tribox.voxelize(self.triangles[:500], grid), 128 // THREADS
        parts = at_once(lambda number: tribox.voxelize(self.triangles[:500], grid, layers=(number * each, each)))
        self.assert_same(np.concatenate(parts), np.array(whole))


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
