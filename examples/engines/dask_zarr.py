"""A mesh into a Zarr array of packed cells, with Dask: python3 dask_zarr.py MESH RESOLUTION OUT.zarr [--ids] [--workers N] [--pieces N]

Word [k, j, i // 64] of the array has cell (i, j, k) as its bit i % 64, as Voxels.words has it; with --ids number [k, j, i] is that
of the lowest triangle in the cell, -1 where there is none. Chunks without cells are not stored.

The shuffle goes through files, on a disk that all workers see: each task sorts its piece of the mesh by tiles into a folder; then
each reads its tiles from the folders of all pieces. None asks another for what it holds, so that nobody waits for one that is gone.
A tile is a chunk and a task owns its chunks and writes each whole: a task that a killed worker had begun is run again. OUT.zarr
appears when all have ended. What a run that ends before leaves in OUT.zarr.jobs, the same command goes on with.

Workers import pieces.py: on other machines it has to be on their PYTHONPATH.
"""

import argparse
import contextlib
import faulthandler
import os
import shutil
import sys

import numpy as np
import pieces
import tribox
import zarr
from dask.distributed import Client, LocalCluster, as_completed


def bounds_of(mesh, number, count):
    return pieces.bounds(pieces.read(mesh, number, count))


def sort_piece(mesh, number, count, folder, grid, ids):
    pieces.sort(pieces.read(mesh, number, count), folder, grid, ids)
    return folder


def tiles_of(folders, number, count):
    """The tiles of a share: (window, triangles, their numbers) of each. Every count-th of all, as neighbours take equally long."""
    parts = [tribox.Partition(folder) for folder in folders]
    before = np.cumsum([0] + [part.triangle_count for part in parts]).tolist()
    for tile in np.unique(np.concatenate([part.numbers for part in parts])).tolist()[number - 1::count]:
        for part in parts:
            part.check((tile, 1))
        numbers = [part.ids(tile) + np.uint32(first) for part, first in zip(parts, before) if part.has_ids]
        yield parts[0].window(tile), np.concatenate([part.triangles(tile) for part in parts]), np.concatenate(numbers or [[]])


def chunk_of(voxels, numbers, ids):
    """What the array holds of a tile."""
    if not ids:
        return voxels.words
    chunk = np.full(voxels.shape, -1, np.int32)
    chunk[np.array(voxels)] = numbers[voxels.ids]
    return chunk


def voxelize_share(folders, number, count, path, grid, ids):
    """Writes the chunks of its tiles; returns how many cells they have, which a file says when they are there."""
    done = f"{path}.done/{number}"
    if not os.path.exists(done):
        array, cells = zarr.open(path, mode="r+", write_empty_chunks=True), 0  # none is empty: it need not look
        for ((i, j, k), size), triangles, numbers in tiles_of(folders, number, count):
            voxels = tribox.voxelize(triangles, grid, window=((i, j, k), size), ids=ids)
            if some := voxels.sum():
                chunk, x = chunk_of(voxels, numbers, ids), i if ids else i // 64
                array[k:k + chunk.shape[0], j:j + chunk.shape[1], x:x + chunk.shape[2]] = chunk
                cells += some
        pieces.put(done, str(cells).encode())
    with open(done) as file:
        return int(file.read())


def make_array(path, grid, ids, side=128):
    """Makes it unless it is there."""
    os.makedirs(f"{path}.done", exist_ok=True)
    if not os.path.exists(f"{path}/.zattrs"):
        shutil.rmtree(f"{path}.done"), os.mkdir(f"{path}.done")
        nx, ny, nz = grid.size
        cells = 1 if ids else 64  # in an element
        array = zarr.open(path, mode="w", shape=(nz, ny, -(-nx // cells)), chunks=(side, side, side // cells),
                          dtype="<i4" if ids else "<u8", fill_value=-1 if ids else 0)
        array.attrs.update(origin=grid.origin, cell=grid.cell, size=grid.size)


def run(each, mesh, resolution, count, jobs, ids):
    """All tasks, step by step. each: runs one for every number. Returns how many cells there are."""
    grid = pieces.grid(each(bounds_of, [(mesh, n, count) for n in range(1, count + 1)]), resolution)
    folders = each(sort_piece, [(mesh, n, count, f"{jobs}/{n}.tiles", grid, ids) for n in range(1, count + 1)])
    make_array(f"{jobs}/cells", grid, ids)
    return sum(each(voxelize_share, [(folders, n, count, f"{jobs}/cells", grid, ids) for n in range(1, count + 1)]))


def told(task, ends, count):
    """The ends of a task's calls as they come, counted on stderr."""
    for n, end in enumerate(ends, 1):
        print(f"\r{task.__name__}: {n} of {count}", end="\n" if n == count else "", file=sys.stderr, flush=True)
        yield end


@contextlib.contextmanager
def dask(workers):
    # Workers come when they can: a cluster that is made with some waits for each, for ever where one dies on its way.
    cluster = LocalCluster(n_workers=0, threads_per_worker=1, dashboard_address=":0")
    client = Client(cluster)

    def each(task, calls):
        futures = [client.submit(task, *call, retries=3, pure=False) for call in calls]
        for _ in told(task, as_completed(futures), len(futures)):
            pass
        return client.gather(futures)

    try:
        cluster.scale(workers)
        yield each
    finally:
        for part in client, cluster:  # which do not end either where a worker died on its way
            with contextlib.suppress(Exception):
                part.close(timeout=5)


def main():
    parser = argparse.ArgumentParser(description="A mesh into a Zarr array of packed cells, with Dask.")
    parser.add_argument("mesh", help="binary .stl or .ply, .f32, .f64")
    parser.add_argument("resolution", type=int)
    parser.add_argument("out")
    parser.add_argument("--ids", action="store_true", help="the lowest triangle of each cell in place of its bit")
    parser.add_argument("--workers", type=int, default=os.cpu_count(), help="processes; 0: this one, without Dask")
    parser.add_argument("--pieces", type=int, default=16, help="of the mesh, and shares of tiles: what is lost with a worker")
    parser.add_argument("--timeout", type=int, default=3600, help="seconds after which the run ends with an error")
    options = parser.parse_args()
    faulthandler.dump_traceback_later(options.timeout, exit=True)
    if os.path.exists(options.out):
        parser.error(f"{options.out} exists")
    mesh, jobs = os.path.abspath(options.mesh), os.path.abspath(options.out) + ".jobs"
    pieces.take_up(jobs, mesh, options.resolution, options.pieces, *["--ids"] * options.ids)
    here = contextlib.nullcontext(lambda task, calls: list(told(task, (task(*call) for call in calls), len(calls))))
    with dask(options.workers) if options.workers else here as each:
        cells = run(each, mesh, options.resolution, options.pieces, jobs, options.ids)
    shutil.rmtree(f"{jobs}/cells.done")  # first, as they say that the chunks are there
    os.rename(f"{jobs}/cells", options.out)
    shutil.rmtree(jobs)
    print(f"{cells} cells")


if __name__ == "__main__":
    main()
