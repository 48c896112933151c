"""A partition into a file of bricks, with MPI: mpirun -n 4 python3 -m mpi4py mpi_bricks.py PARTITION OUT.npy

PARTITION is a folder that `tribox partition MESH --resolution N -o PARTITION` wrote, on a file system that all ranks see. OUT.npy
has 76 bytes a brick: numpy.load(OUT.npy)["at"] and ["bits"] are as those of tribox.bricks, in the same order.

Each rank has tiles of about equal work, reads their triangles alone, and writes its bricks after those of the ranks before it: an
exclusive scan of their counts, and one collective write. OUT.npy appears when all ranks have written. A rank that is killed ends
the run with an error, and so does one that fails, which is what `-m mpi4py` is for; then run it again. `mpirun --timeout S` limits
its time.
"""

import io
import os
import sys

import numpy as np
import tribox
from mpi4py import MPI

BRICK = np.dtype([("at", "<u4", 3), ("bits", "<u8", 8)])


def npy_header(count):
    """What stands before the bricks in a .npy file."""
    header = io.BytesIO()
    np.lib.format.write_array_header_1_0(header, dict(descr=BRICK.descr, fortran_order=False, shape=(count,)))
    return header.getvalue()


def write(world, path, records):
    """Writes the records of all ranks, one rank after the other."""
    before, count = world.exscan(len(records)) or 0, world.allreduce(len(records))
    header, record = npy_header(count), MPI.BYTE.Create_contiguous(BRICK.itemsize).Commit()
    file = MPI.File.Open(world, path, MPI.MODE_CREATE | MPI.MODE_EXCL | MPI.MODE_WRONLY)
    if world.rank == 0:
        file.Write_at(0, header)
    file.Write_at_all(len(header) + before * BRICK.itemsize, [records, len(records), record])
    file.Close()
    return count


def main():
    folder, out = sys.argv[1:]
    world = MPI.COMM_WORLD
    if os.path.exists(out):
        sys.exit(f"{out} exists")
    partition = tribox.Partition(folder)
    share = partition.shares(world.size)[world.rank]
    partition.check(share)
    bricks = partition.bricks(share)
    records = np.empty(len(bricks.at), BRICK)
    records["at"], records["bits"] = bricks.at, bricks.bits
    draft = world.bcast(f"{out}.draft-{os.getpid()}")
    count = write(world, draft, records)
    world.Barrier()
    if world.rank == 0:
        os.rename(draft, out)
        print(f"{count} bricks of {world.size} ranks")


main()
