"""A mesh into a file of bricks, with MPI: mpirun -n 4 python3 -m mpi4py mpi_bricks.py MESH RESOLUTION OUT.npy [--ids]

OUT.npy has 76 bytes a brick: numpy.load(OUT.npy)["at"] and ["bits"] are as those of tribox.bricks, in the same order. With --ids
["ids"] has the lowest triangle of each of a brick's cells, -1 of those that are not set.

Each rank reads its piece of the mesh and sorts it by tiles; then all exchange triangles, so that each has those of its own tiles,
of about equal work; it writes their bricks after those of the ranks before it, in one collective write. OUT.npy appears when all
have written. A rank that is killed ends the run with an error, and so does one that fails, which is what `-m mpi4py` is for. The
pieces that were sorted by then lie in OUT.npy.jobs, on a disk that all see: the same command goes on with them. `mpirun --timeout
S` limits its time.
"""

import io
import os
import shutil
import sys

import numpy as np
import pieces
import tribox
from mpi4py import MPI

BRICK = [("at", "<u4", 3), ("bits", "<u8", 8)]
IDS = ("ids", "<i4", (8, 8, 8))  # k, j, i


def record(size):
    """What is sent and written in counts of such records, as counts of bytes may be too large for MPI."""
    return MPI.BYTE.Create_contiguous(size).Commit()


def owners(world, part):
    """All tiles that have triangles, and the rank that each is for: runs of about equal work."""
    numbers, work = (np.concatenate(each) for each in zip(*world.allgather((part.numbers, part.work))))
    numbers, place = np.unique(numbers, return_inverse=True)
    work = np.bincount(place, work, len(numbers))
    return numbers, ((np.cumsum(work) - work / 2) * world.size // max(1, work.sum())).astype(int)


def exchange(world, part, of_tile, numbers, owner):
    """The triangles, or what else of_tile gives of each, of this rank's tiles, of all ranks."""
    tiles = [of_tile(number) for number in part.numbers.tolist()]
    send = np.concatenate([of_tile(0)[:0], *tiles])  # by tile, so by rank
    counts = np.bincount(owner[np.searchsorted(numbers, part.numbers)], list(map(len, tiles)), world.size).astype(int)
    received = np.array(world.alltoall(counts.tolist()))
    found, kind = np.empty((received.sum(), *send.shape[1:]), send.dtype), record(send.itemsize * int(np.prod(send.shape[1:])))
    world.Alltoallv([send, counts, np.cumsum(counts) - counts, kind], [found, received, np.cumsum(received) - received, kind])
    return found


def exchange_numbered(world, part, *owned):
    """The same in the order of the mesh, each once, and their numbers in the mesh."""
    before = np.uint32(world.exscan(part.triangle_count) or 0)
    triangles = exchange(world, part, part.triangles, *owned)
    numbers, first = np.unique(exchange(world, part, lambda tile: part.ids(tile) + before, *owned), return_index=True)
    return triangles[first], numbers


def records_of(bricks, numbers):
    """Bricks as they are written. numbers: None, or of the triangles that they are of."""
    records = np.empty(len(bricks.at), BRICK + [IDS] * (numbers is not None))
    records["at"], records["bits"] = bricks.at, bricks.bits
    if numbers is not None:
        cells = np.unpackbits(records["bits"].view(np.uint8).reshape(-1, 8, 8, 1), -1, bitorder="little").astype(bool)
        records["ids"] = -1
        records["ids"][cells] = numbers[bricks.ids]
    return records


def npy_header(kind, count):
    """What stands before the bricks in a .npy file."""
    header = io.BytesIO()
    np.lib.format.write_array_header_1_0(header, dict(descr=kind.descr, fortran_order=False, shape=(count,)))
    return header.getvalue()


def write(world, path, records):
    """Writes the records of all ranks, one rank after the other; returns how many they are."""
    before, count = world.exscan(len(records)) or 0, world.allreduce(len(records))
    header, size = npy_header(records.dtype, count), records.itemsize
    file = MPI.File.Open(world, path, MPI.MODE_CREATE | MPI.MODE_WRONLY)
    file.Set_size(len(header) + count * size)
    if world.rank == 0:
        file.Write_at(0, header)
    file.Write_at_all(len(header) + before * size, [records, len(records), record(size)])
    file.Close()
    return count


def main():
    (mesh, resolution, out), ids = sys.argv[1:4], sys.argv[4:] == ["--ids"]
    world, jobs = MPI.COMM_WORLD, out + ".jobs"
    if os.path.exists(out):
        sys.exit(f"{out} exists")
    if world.rank == 0:
        pieces.take_up(jobs, mesh, resolution, world.size, "ranks", *sys.argv[4:])
    world.Barrier()
    piece = pieces.read(mesh, world.rank + 1, world.size)
    grid = pieces.grid(world.allgather(pieces.bounds(piece)), int(resolution))
    part = pieces.sort(piece, f"{jobs}/{world.rank + 1}.tiles", grid, ids)
    part.check()
    numbers, owner = owners(world, part)
    mine = numbers[owner == world.rank]
    tiles = (int(mine[0]), int(mine[-1] - mine[0] + 1)) if len(mine) else (0, 0)
    owned = numbers, owner
    triangles, of_mesh = exchange_numbered(world, part, *owned) if ids else (exchange(world, part, part.triangles, *owned), None)
    count = write(world, f"{jobs}/bricks", records_of(tribox.bricks(triangles, grid, tiles=tiles, ids=ids), of_mesh))
    world.Barrier()
    if world.rank == 0:
        os.rename(f"{jobs}/bricks", out)
        shutil.rmtree(jobs)
        print(f"{count} bricks of {world.size} ranks")


main()
