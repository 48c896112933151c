"""What a call from Python costs beyond the work: PYTHONPATH=... python3 bench/python_call.py [--rounds N] [MESH.ply ...]

Each row is one way to ask about one triangle. "raw" is the call of the C function with all its arguments made beforehand, and is
subtracted from the others. Every round runs all rows; it prints the least and the median of the rounds, in microseconds.

Then a box of 1,000 by Index.lists, about triangles that near it are as dense as those of a scanned mesh: of float32 as lanes, and
of float64 one by one, which is to take 1.2 times as long at most.

Of meshes, binary PLY of float32 vertices and triangles as those of Stanford, it says instead what a second thread gains, in
milliseconds of wall, the least of the rounds: voxelize for grids of a growing resolution, Index, and 1,000 boxes of 1 % of its
width.
"""

import argparse
import os
import statistics
import sys
import timeit

import numpy as np
import tribox
from tribox._ffi import ffi
from tribox._library import lib
from tribox._triangles import held

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "peers"))
import asked  # noqa: E402

LO, HI, CALLS, RESOLUTIONS = (-1, -1, -1), (1, 1, 1), 100, (16, 64, 128, 256, 512, 1024)


def rows():
    one = np.zeros((1, 3, 3), np.float32)
    mesh, soup = tribox.Mesh(one[0], np.array([[0, 1, 2]], np.uint32)), tribox.Soup.of(one)
    lo, hi, out = np.array(LO, np.float32), np.array(HI, np.float32), np.zeros(1, bool)
    struct, box, words = held(one).struct, ffi.new("tribox_box *", (LO, HI)), ffi.new("uint64_t[1]")
    yield "raw", lambda: lib.tribox_mesh_overlap(struct, box, ffi.NULL, words, ffi.NULL)
    yield "array", lambda: tribox.overlap(one, LO, HI)
    yield "array, bounds in arrays", lambda: tribox.overlap(one, lo, hi)
    yield "array, out", lambda: tribox.overlap(one, LO, HI, out=out)
    yield "array, packed", lambda: tribox.overlap(one, LO, HI, packed=True)
    yield "Mesh", lambda: tribox.overlap(mesh, LO, HI)
    yield "Soup", lambda: tribox.overlap(soup, LO, HI)
    yield "Soup, packed", lambda: tribox.overlap(soup, LO, HI, packed=True)


def boxes():
    """Ways to ask an Index over a bumpy sphere about 1,000 boxes of 1 % of its width."""
    pick = np.random.default_rng(1)
    v, u = np.meshgrid(np.linspace(0, np.pi, 501), np.linspace(0, 2 * np.pi, 1001), indexing="ij")
    radius = 1 + 0.1 * np.sin(7 * u) * np.sin(5 * v) ** 2
    points = np.stack([radius * np.sin(v) * np.cos(u), radius * np.sin(v) * np.sin(u), radius * np.cos(v)], 2)
    a, b, c, d = points[:-1, :-1], points[1:, :-1], points[:-1, 1:], points[1:, 1:]
    triangles = np.concatenate([np.stack([a, b, d], 2).reshape(-1, 3, 3), np.stack([a, d, c], 2).reshape(-1, 3, 3)])
    middles = triangles[pick.integers(len(triangles), size=1000)].mean(1)
    lo, hi = middles - 0.01, middles + 0.01
    index, wide = tribox.Index(triangles.astype(np.float32)), tribox.Index(triangles)
    lo_single, hi_single = lo.astype(np.float32), hi.astype(np.float32)
    yield "boxes of float32", lambda: index.lists(lo_single, hi_single)
    yield "boxes of float64", lambda: index.lists(lo, hi)
    yield "about float64", lambda: wide.lists(lo, hi)


def timed(calls, rounds, number):
    """{name: microseconds of one call, in each round}"""
    times = {name: [] for name in calls}
    for _ in range(rounds):
        for name, call in calls.items():
            times[name].append(timeit.timeit(call, number=number) / number * 1e6)
    return times


def shared(mesh):
    """(name, call of a number of threads)"""
    for resolution in RESOLUTIONS:
        grid = tribox.grid_around(mesh, resolution)
        yield f"voxelize {resolution}", lambda threads, grid=grid: tribox.voxelize(mesh, grid, threads=threads)
    yield "Index", lambda threads: tribox.Index(mesh, threads=threads)
    task, index = asked.Task(mesh.vertices, mesh.faces), tribox.Index(mesh)
    yield "1,000 boxes", lambda threads: index.lists(task.los, task.his, threads=threads)


def tell_threads(path, rounds):
    for name, call in shared(tribox.Mesh(*asked.read(path))):
        times = timed({threads: lambda threads=threads: call(threads) for threads in (1, 2)}, rounds, 1)
        one, two = (min(times[threads]) / 1000 for threads in (1, 2))
        print(f"{os.path.basename(path):20} {name:14} {one:8.2f} {two:8.2f} {one / two:5.2f}", flush=True)


def tell_calls(rounds):
    times = timed(dict(rows()), rounds, CALLS)
    raw = times["raw"]
    print(f"{'':26}{'least':>8}{'median':>8}{'added, least':>14}{'added, median':>15}   (microseconds a call)")
    for name, taken in times.items():
        least, median = min(taken), statistics.median(taken)
        print(f"{name:26}{least:8.2f}{median:8.2f}{least - min(raw):14.2f}{median - statistics.median(raw):15.2f}")
    for name, taken in timed(dict(boxes()), max(1, rounds // 20), 1).items():
        print(f"{name:26}{min(taken) / 1000:8.2f}{statistics.median(taken) / 1000:8.2f}   (microseconds a box)")


parser = argparse.ArgumentParser()
parser.add_argument("meshes", nargs="*")
parser.add_argument("--rounds", type=int)
options = parser.parse_args()
for mesh_path in options.meshes:
    tell_threads(mesh_path, options.rounds or 9)
if not options.meshes:
    tell_calls(options.rounds or 500)
