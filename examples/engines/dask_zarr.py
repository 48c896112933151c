"""A partition into a Zarr array of packed cells, with Dask: python3 dask_zarr.py PARTITION OUT.zarr [--workers N] [--timeout S]

PARTITION is a folder that `tribox partition MESH --resolution N -o PARTITION` wrote. Word [k, j, i // 64] of the array has cell
(i, j, k) as its bit i % 64, as Voxels.words has it; chunks without cells are not stored.

A tile is a chunk and a task owns its chunks: it reads its triangles from the partition, asks no other task, and writes each chunk
whole, so that a task which a killed worker had begun is simply run again. OUT.zarr appears when all tasks have ended; a run that is
killed, or takes longer than the timeout, leaves OUT.zarr.draft-* at most.
"""

import argparse
import contextlib
import faulthandler
import os
import shutil

import numpy as np
import tribox
import zarr
from dask.distributed import Client, LocalCluster

SHARES_EACH = 8  # of each worker: what is lost with a worker, and how long others wait for the last


def voxelize_share(partition, path, share):
    """The task: writes the chunks of its tiles; returns how many cells they have."""
    partition.check(share)
    array, cells = zarr.open(path, mode="r+", write_empty_chunks=True), 0  # none is empty: it need not look
    first, count = share
    for number in partition.numbers[np.isin(partition.numbers, range(first, first + count))].tolist():
        voxels = partition.voxelize(number)
        some, words, (i, j, k) = voxels.sum(), voxels.words, voxels.window[0]
        if some:
            array[k:k + words.shape[0], j:j + words.shape[1], i // 64:i // 64 + words.shape[2]] = words
            cells += some
    return cells


def new_array(partition, path):
    nx, ny, nz = partition.grid.size
    side = partition.side
    array = zarr.open(path, mode="w", shape=(nz, ny, (nx + 63) // 64), chunks=(side, side, side // 64), dtype="<u8", fill_value=0)
    array.attrs.update(origin=partition.grid.origin, cell=partition.grid.cell, size=partition.grid.size)


def with_dask(partition, path, workers):
    """Runs the tasks; returns how many cells all have."""
    # Workers come when they can: a cluster that is made with some waits for each, for ever where one dies on its way.
    cluster = LocalCluster(n_workers=0, threads_per_worker=1, dashboard_address=":0")
    client = Client(cluster)
    try:
        cluster.scale(workers)
        tasks = [client.submit(voxelize_share, partition, path, share, retries=3, pure=False)
                 for share in partition.shares(SHARES_EACH * workers)]
        return sum(client.gather(tasks))
    finally:
        for part in client, cluster:  # which do not end either where a worker died on its way
            with contextlib.suppress(Exception):
                part.close(timeout=5)


def main():
    parser = argparse.ArgumentParser(description="A partition into a Zarr array of packed cells, with Dask.")
    parser.add_argument("partition")
    parser.add_argument("out")
    parser.add_argument("--workers", type=int, default=os.cpu_count(), help="processes; 0: this one, without Dask")
    parser.add_argument("--timeout", type=int, default=3600, help="seconds after which the run ends with an error")
    options = parser.parse_args()
    faulthandler.dump_traceback_later(options.timeout, exit=True)
    partition, draft = tribox.Partition(options.partition), f"{options.out}.draft-{os.getpid()}"
    if os.path.exists(options.out):
        parser.error(f"{options.out} exists")
    if partition.side % 64:
        parser.error(f"tiles of {partition.side} cells are no chunks of whole words; make them of a multiple of 64")
    new_array(partition, draft)
    try:
        whole = 0, partition.tile_count
        cells = with_dask(partition, draft, options.workers) if options.workers else voxelize_share(partition, draft, whole)
        os.rename(draft, options.out)
    finally:
        shutil.rmtree(draft, ignore_errors=True)
    print(f"{cells} cells")


if __name__ == "__main__":
    main()
