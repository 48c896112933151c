"""What a call from Python costs beyond the work: PYTHONPATH=... python3 bench/python_call.py [ROUNDS]

Each row is one way to ask about one triangle. "raw" is the call of the C function with all its arguments made beforehand, and is
subtracted from the others. Every round runs all rows; it prints the least and the median of the rounds, in microseconds.
"""

import statistics
import sys
import timeit

import numpy as np
import tribox
from tribox._ffi import ffi
from tribox._library import lib
from tribox._triangles import held

LO, HI, CALLS = (-1, -1, -1), (1, 1, 1), 100


def rows():
    one = np.zeros((1, 3, 3), np.float32)
    mesh, soup = tribox.Mesh(one[0], np.array([[0, 1, 2]], np.uint32)), tribox.Soup.of(one)
    lo, hi, out = np.array(LO, np.float32), np.array(HI, np.float32), np.zeros(1, bool)
    struct, box, words = held(one)[0], ffi.new("tribox_box *", (LO, HI)), ffi.new("uint64_t[1]")
    yield "raw", lambda: lib.tribox_mesh_overlap(struct, box, ffi.NULL, words, ffi.NULL)
    yield "array", lambda: tribox.overlap(one, LO, HI)
    yield "array, bounds in arrays", lambda: tribox.overlap(one, lo, hi)
    yield "array, out", lambda: tribox.overlap(one, LO, HI, out=out)
    yield "array, packed", lambda: tribox.overlap(one, LO, HI, packed=True)
    yield "Mesh", lambda: tribox.overlap(mesh, LO, HI)
    yield "Soup", lambda: tribox.overlap(soup, LO, HI)
    yield "Soup, packed", lambda: tribox.overlap(soup, LO, HI, packed=True)


def main(rounds="500"):
    calls = dict(rows())
    times = {name: [] for name in calls}
    for _ in range(int(rounds)):
        for name, call in calls.items():
            times[name].append(timeit.timeit(call, number=CALLS) / CALLS * 1e6)
    raw = times["raw"]
    print(f"{'':26}{'least':>8}{'median':>8}{'added, least':>14}{'added, median':>15}   (microseconds a call)")
    for name, taken in times.items():
        least, median = min(taken), statistics.median(taken)
        print(f"{name:26}{least:8.2f}{median:8.2f}{least - min(raw):14.2f}{median - statistics.median(raw):15.2f}")


main(*sys.argv[1:])
