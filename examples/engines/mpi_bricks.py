"""A mesh into a file of bricks, with MPI: mpirun -n 4 python3 -m mpi4py mpi_bricks.py MESH RESOLUTION OUT.npz [--ids]

The first rank sorts the mesh by tiles; each voxelizes its share of the tiles, of about equal work, and has the bricks: here it
counts their cells. The first joins the files of all. With --ids OUT.npz has the lowest triangle of each cell too.

A rank that is killed ends the run with an error, and so does one that fails, which is what `-m mpi4py` is for. The same command
goes on with what lies in OUT.npz.jobs. `mpirun --timeout S` limits its time.
"""

import os
import shutil
import sys

import shards
import tribox
from mpi4py import MPI


def main():
    (mesh, resolution, out), ids = sys.argv[1:4], sys.argv[4:] == ["--ids"]
    world, jobs = MPI.COMM_WORLD, out + ".jobs"
    if os.path.exists(out):
        sys.exit(f"{out} exists")
    if world.rank == 0:
        shards.take_up(jobs, mesh, resolution, world.size, "ranks", *sys.argv[4:])
        shards.sort(mesh, resolution, jobs, ids)
    world.Barrier()
    part = shards.voxelize(jobs, world.rank + 1, world.size, ids)
    cells, parts = world.reduce(len(tribox.Bricks.load(part).cells())), world.gather(part)
    if world.rank == 0:
        shards.tribox("merge", *parts, "-o", out)
        shutil.rmtree(jobs)
        print(f"{cells} cells of {world.size} ranks")


main()
