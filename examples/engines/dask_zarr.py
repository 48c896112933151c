"""A mesh into a Zarr array of packed cells, with Dask: dask_zarr.py MESH RESOLUTION OUT.zarr [--ids] [--workers N] [--shards N]

Cell (i, j, k) is bit i % 64 of word [k, j, i // 64] of the array, as in Voxels.words. With --ids, number [k, j, i] is that of the
lowest triangle in the cell, -1 if there is none. Chunks without cells are not stored.

One task sorts the mesh, which may be larger than memory, by tiles into a folder. Then each task voxelizes its share of the tiles,
of about equal work, into a file of bricks, and writes these into the array. A tile is a chunk, and a task owns its chunks and
writes each whole: if a worker is killed, its task is run again. OUT.zarr appears when all tasks have ended. If a run ends early,
the same command continues from the files in OUT.zarr.jobs.

Workers import shards.py: on other machines it has to be on their PYTHONPATH.
"""

import argparse
import contextlib
import faulthandler
import logging
import os
import shutil
import subprocess
import sys

import numpy as np
import shards
import tribox
import zarr
from dask.distributed import Client, LocalCluster, as_completed


def tiles_of(bricks, side):
    """The runs of bricks, first to before end, that belong to one tile."""
    tiles = bricks.at // (side // 8)
    borders = (np.flatnonzero((tiles[1:] != tiles[:-1]).any(1)) + 1).tolist()
    return zip([0, *borders], [*borders, len(tiles)]) if len(tiles) else ()


def chunk_of(at, values, side):
    """The cells of a tile, side x side x side, of those of its bricks."""
    chunk = np.full((side // 8,) * 3 + (8, 8, 8), -1 if values.dtype == np.int32 else 0, values.dtype)
    i, j, k = at.T % (side // 8)
    chunk[k, j, i] = values
    return chunk.transpose(0, 3, 1, 4, 2, 5).reshape(side, side, side)


def store(part, path, side, ids):
    """Writes the chunks of the tiles of a part; returns how many cells they have."""
    bricks, array, done = tribox.Bricks.load(part), zarr.open(path, mode="r+", write_empty_chunks=True), 0  # none is empty
    for first, end in tiles_of(bricks, side):
        cells = np.unpackbits(bricks.bits[first:end].astype("<u8").view(np.uint8).reshape(-1, 8, 8, 1), -1, bitorder="little")
        count = np.count_nonzero(cells)
        if ids:
            values = np.full(cells.shape, -1, np.int32)
            values[cells.astype(bool)] = bricks.ids[done:done + count]
            chunk = chunk_of(bricks.at[first:end], values, side)
        else:
            chunk = np.packbits(chunk_of(bricks.at[first:end], cells, side), -1, bitorder="little").view("<u8")
        x, y, z = bricks.at[first] // (side // 8) * side
        corner = z, y, x if ids else x // 64
        there = tuple(slice(start, start + most) for start, most in zip(corner, chunk.shape))
        array[there] = chunk[tuple(slice(most - int(start)) for start, most in zip(corner, array.shape))]
        done += count
    return done


def make_array(path, part, ids):
    """Makes the array for the grid of a part; returns how many cells the side of a tile has."""
    with np.load(part) as file:
        (nx, ny, nz), side = file["size"].tolist(), int(file["whole"][6])
        grid = {name: file[name].tolist() for name in ("origin", "cell", "size")}
    cells = 1 if ids else 64  # in an element
    array = zarr.open(path, mode="w", shape=(nz, ny, -(-nx // cells)), chunks=(side, side, side // cells),
                      dtype="<i4" if ids else "<u8", fill_value=-1 if ids else 0)
    array.attrs.update(grid)
    return side


def run(each, mesh, resolution, count, jobs, ids):
    """All tasks, step by step. each: runs one for every call. Returns how many cells there are."""
    each(shards.sort, [(mesh, resolution, jobs, ids)])
    parts = each(shards.voxelize, [(jobs, n, count, ids) for n in range(1, count + 1)])
    side = make_array(f"{jobs}/cells", parts[0], ids)
    return sum(each(store, [(part, f"{jobs}/cells", side, ids) for part in parts]))


def attempt(task, *call):
    """What it returns, or the error of the program, which has said why and would fail again. Raises if the program was killed."""
    try:
        return task(*call)
    except subprocess.CalledProcessError as error:
        if error.returncode < 0:
            raise
        return error


def told(task, ends, count):
    """The ends of a task's calls as they come, counted on stderr: in one line of a terminal, else in lines."""
    has_lines = not sys.stderr.isatty()
    for n, end in enumerate(ends, 1):
        print(f"{task.__name__}: {n} of {count}", end="\n" if has_lines or n == count else "\r", file=sys.stderr, flush=True)
        yield end


def checked(ends):
    """The ends, unless one is an error."""
    if any(isinstance(end, Exception) for end in ends):
        sys.exit(1)
    return ends


def one_by_one(task, calls):
    return checked(list(told(task, (attempt(task, *call) for call in calls), len(calls))))


@contextlib.contextmanager
def dask(workers):
    # Workers come when they can: a cluster that is made with some waits for each, for ever where one dies on its way.
    cluster = LocalCluster(n_workers=0, threads_per_worker=1, dashboard_address=":0")
    client = Client(cluster)

    def each(task, calls):
        futures = [client.submit(attempt, task, *call, retries=3, pure=False) for call in calls]
        for _ in told(task, as_completed(futures), len(futures)):
            pass
        return checked(client.gather(futures))

    try:
        cluster.scale(workers)
        yield each
    finally:
        logging.getLogger("distributed.nanny").setLevel(logging.ERROR)  # that a worker is slow to end, and killed, is no news
        for part in client, cluster:  # which do not end either where a worker died on its way
            with contextlib.suppress(Exception):
                part.close(timeout=5)


def main():
    parser = argparse.ArgumentParser(description="A mesh into a Zarr array of packed cells, with Dask.")
    parser.add_argument("mesh", help="what tribox reads")
    parser.add_argument("resolution", type=int)
    parser.add_argument("out")
    parser.add_argument("--ids", action="store_true", help="the lowest triangle of each cell in place of its bit")
    parser.add_argument("--workers", type=int, default=os.cpu_count(), help="processes; 0: this one, without Dask")
    parser.add_argument("--shards", type=int, default=16, help="shares of tiles: what is lost with a worker")
    parser.add_argument("--timeout", type=int, default=3600, help="seconds after which the run ends with an error")
    options = parser.parse_args()
    faulthandler.dump_traceback_later(options.timeout, exit=True)
    if os.path.exists(options.out):
        parser.error(f"{options.out} exists")
    mesh, jobs = os.path.abspath(options.mesh), os.path.abspath(options.out) + ".jobs"
    shards.take_up(jobs, mesh, options.resolution, options.shards, *["--ids"] * options.ids)
    with dask(options.workers) if options.workers else contextlib.nullcontext(one_by_one) as each:
        cells = run(each, mesh, options.resolution, options.shards, jobs, options.ids)
    os.rename(f"{jobs}/cells", options.out)
    shutil.rmtree(jobs)
    print(f"{cells} cells")


if __name__ == "__main__":
    main()
