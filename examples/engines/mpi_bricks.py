"""A mesh into a file of bricks, with MPI: mpirun -n 4 python3 -m mpi4py mpi_bricks.py MESH RESOLUTION OUT.npz [--ids]

The first rank sorts the mesh by tiles. Each voxelizes its share of the tiles, of about equal work, and then has the bricks: here it
counts their cells. The first joins the files of all. With --ids, OUT.npz also has the lowest triangle of each cell.

If a rank is killed or fails, the run ends with an error (for failures, `-m mpi4py` sees to that). The same command then continues
from the files in OUT.npz.jobs. `mpirun --timeout S` limits its time.
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
