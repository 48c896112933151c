"""What the examples for Dask and MPI share: the program sorts a mesh, however large, and a task voxelizes its share of the tiles.

A file gets its name only when it is whole, and making it again gives the same bytes. So a task that was killed is simply run again.
The files lie on a disk that all machines see, and the program `tribox` is on the PATH.
"""

import os
import subprocess


def tribox(*words):
    """Runs the program, which reports errors on stderr."""
    subprocess.run(["tribox", *map(str, words), "--quiet"], check=True)


def sort(mesh, resolution, jobs, ids=False):
    """Sorts the triangles by tiles of the grid, so that a shard reads only its own; unless that has been done."""
    folder = os.path.join(jobs, "tiles")
    try:
        if not os.path.exists(folder):
            tribox("partition", mesh, "-r", resolution, *["--ids"] * ids, "-o", folder)
    except subprocess.CalledProcessError:  # as where the same task runs twice and the other was first
        if not os.path.exists(folder):
            raise


def voxelize(jobs, number, count, ids=False):
    """The path of the bricks of shard number 1 .. `count`, made unless the file exists."""
    path = os.path.join(jobs, f"{number}.npz")
    if not os.path.exists(path):
        tribox("voxelize", os.path.join(jobs, "tiles"), *["--ids"] * ids, "--shard", f"{number}/{count}", "-t", 1, "-o", path)
    return path


def take_up(folder, mesh, *command):
    """Makes the folder of a run, or continues with the one that the same command made. Refuses one of another command."""
    try:
        about, path = os.stat(mesh), os.path.join(folder, "command")
    except OSError as error:
        raise SystemExit(f"{mesh}: {error.strerror}") from None
    line = " ".join(map(str, (os.path.realpath(mesh), about.st_size, about.st_mtime_ns, *command)))
    os.makedirs(folder, exist_ok=True)
    if not os.path.exists(path):
        with open(f"{path}.draft", "w") as file:
            file.write(line)
        os.replace(f"{path}.draft", path)
    with open(path) as file:
        if (other := file.read()) != line:
            raise SystemExit(f"{folder} is of another command, {other}: repeat that one, remove {folder}, or give another OUT")
