"""What a second thread gains in Python: PYTHONPATH=... python3 bench/python_threads.py MESH.ply ... [--rounds N]

Meshes are binary PLY of float32 vertices and triangles, as those of Stanford. Milliseconds of wall, the least of the rounds, each
of which runs one thread and two in turn: voxelize for grids of a growing resolution, Index, and 1,000 boxes of 1 % of its width.
"""

import argparse
import os
import sys
import time

import numpy as np
import tribox

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "peers"))
import asked  # noqa: E402

RESOLUTIONS = 16, 64, 128, 256, 512, 1024


def calls(mesh):
    """(name, call of a number of threads)"""
    for resolution in RESOLUTIONS:
        grid = tribox.grid_around(mesh, resolution)
        yield f"voxelize {resolution}", lambda threads, grid=grid: tribox.voxelize(mesh, grid, threads=threads)
    yield "Index", lambda threads: tribox.Index(mesh, threads=threads)
    index, half = tribox.Index(mesh), np.ptp(mesh.vertices, 0).max() / 200
    middles = mesh.vertices[mesh.faces[np.random.default_rng(1).integers(len(mesh), size=1000)]].mean(1)
    yield "1,000 boxes", lambda threads: index.lists(middles - half, middles + half, threads=threads)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("meshes", nargs="+")
    parser.add_argument("--rounds", type=int, default=9)
    options = parser.parse_args()
    for path in options.meshes:
        for name, call in calls(tribox.Mesh(*asked.read(path))):
            least = {1: float("inf"), 2: float("inf")}
            for _ in range(options.rounds):
                for threads in least:
                    begin = time.perf_counter()
                    call(threads)
                    least[threads] = min(least[threads], 1e3 * (time.perf_counter() - begin))
            print(f"{os.path.basename(path):20} {name:14} {least[1]:8.2f} {least[2]:8.2f} {least[1] / least[2]:5.2f}", flush=True)


if __name__ == "__main__":
    main()
