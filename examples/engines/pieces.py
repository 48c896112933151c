"""Pieces of a mesh, what the examples for Dask, MPI and Slurm share: a task reads its own piece, and no other reads the mesh.

Binary .stl and .ply, .f32 (nine floats a triangle) and .f64. A task owns the files that it makes: each has its name when it is
whole, and whoever makes it again makes the same, so that a task that was killed is simply run again. slurm_job.sh runs

    python3 pieces.py cut MESH I/N FOLDER           piece I of N as FOLDER/I.f32 or I.f64, and the box around it as FOLDER/I.bounds
    python3 pieces.py grid RESOLUTION BOUNDS...     the grid around all pieces as options of `tribox partition`
"""

import os
import sys

import numpy as np
import tribox

STL = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
RAW = {".f32": np.dtype([("corners", "<f4", (3, 3))]), ".f64": np.dtype([("corners", "<f8", (3, 3))])}
PLY = {"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4", "double": "f8",
       "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4", "float32": "f4", "float64": "f8"}


def refuse(path, why):
    raise SystemExit(f"{path}: {why}; `tribox partition` reads it in one process")


def share(count, number, pieces):
    """Where piece number 1 .. `pieces` of so many begins, and how many it has."""
    first = count * (number - 1) // pieces
    return first, count * number // pieces - first


def records(path, kind, start, first, count):
    found = np.fromfile(path, kind, count, offset=start + first * kind.itemsize)
    return found if len(found) == count else refuse(path, "damaged: it ends before its last triangle")


def ply_elements(path):
    """Where the elements of a file begin, and for each how many it has and a record of it."""
    with open(path, "rb") as file:
        header, end, _ = file.read(1 << 16).partition(b"end_header\n")
    lines = [line.split() for line in header.decode("latin-1").splitlines()]
    order = {"binary_little_endian": "<", "binary_big_endian": ">"}.get(next((w[1] for w in lines if w[:1] == ["format"]), None))
    if not end or not order:
        refuse(path, "not a binary PLY file")
    elements = {}
    for words in lines:
        if words[:1] == ["element"]:
            fields = elements.setdefault(words[1], (int(words[2]), []))[1]
        elif words[:2] == ["property", "list"]:
            fields += [("sides", order + PLY[words[2]]), ("corners", order + PLY[words[3]], 3)]  # of a triangle
        elif words[:1] == ["property"]:
            fields.append((words[2], order + PLY[words[1]]))
    if list(elements)[:2] != ["vertex", "face"] or "sides" in dict((f[0], 0) for f in elements["vertex"][1]):
        refuse(path, "its vertices and then its faces do not come first")
    return len(header) + len(end), *((count, np.dtype(fields)) for count, fields in (elements["vertex"], elements["face"]))


def read_ply(path, number, pieces):
    start, (vertices, vertex), (triangles, face) = ply_elements(path)
    faces = records(path, face, start + vertices * vertex.itemsize, *share(triangles, number, pieces))
    corners = faces["corners"].astype(np.int64)
    if not (faces["sides"] == 3).all() or corners.min(initial=0) < 0 or corners.max(initial=0) >= max(1, vertices):
        refuse(path, "not every face is a triangle of its vertices")
    points = np.memmap(path, vertex, "r", start, vertices) if vertices else np.empty(0, vertex)
    return np.stack([points[axis][corners] for axis in "xyz"], -1)


def read(path, number, pieces):
    """The triangles of a piece, of shape (n, 3, 3)."""
    end, size = os.path.splitext(path)[1].lower(), os.path.getsize(path)
    kind, start = (STL, 84) if end == ".stl" else (RAW.get(end), 0)
    if end == ".ply":
        triangles = read_ply(path, number, pieces)
    elif not kind or (size - start) % kind.itemsize or kind is STL and np.fromfile(path, "<u4", 1, offset=80) != size // 50 - 1:
        refuse(path, "neither a binary .stl or .ply nor whole triangles of a .f32 or .f64")
    else:
        triangles = records(path, kind, start, *share((size - start) // kind.itemsize, number, pieces))["corners"]
    return np.ascontiguousarray(triangles, triangles.dtype.newbyteorder("="))


def bounds(triangles):
    """The box around those that are finite, as a triangle from corner to corner: an array with one, or none."""
    finite = triangles[np.isfinite(triangles).all((1, 2))].reshape(-1, 3)
    return np.array([[finite.min(0), finite.max(0), finite.max(0)]] if len(finite) else np.empty((0, 3, 3)), float)


def grid(all_bounds, resolution):
    """The grid of the whole mesh."""
    return tribox.grid_around(np.concatenate(all_bounds), resolution)


def put(path, octets):
    """A file that has its name when it is whole."""
    draft = f"{path}.draft-{os.uname().nodename}-{os.getpid()}"
    with open(draft, "wb") as file:
        file.write(octets)
    os.replace(draft, path)


def sort(triangles, folder, grid_, ids=False):
    """The Partition of a piece, which is made unless it is there. ids: its triangles keep their numbers in the piece."""
    try:
        if not os.path.exists(folder):
            return tribox.partition(triangles, folder, grid_, ids=ids)
    except OSError:  # as where the same task runs twice and the other was first
        if not os.path.exists(folder):
            raise
    return tribox.Partition(folder)


def take_up(folder, mesh, *command):
    """Makes the folder of a run, or goes on with that of the same command; refuses another's."""
    about, path = os.stat(mesh), os.path.join(folder, "command")
    line = " ".join(map(str, (os.path.realpath(mesh), about.st_size, about.st_mtime_ns, *command)))
    os.makedirs(folder, exist_ok=True)
    if not os.path.exists(path):
        put(path, line.encode())
    with open(path) as file:
        if (other := file.read()) != line:
            raise SystemExit(f"{folder} is of another command, {other}: repeat that one, remove {folder}, or give another OUT")


def cut(mesh, which, folder):
    number, pieces = map(int, which.split("/"))
    triangles = read(mesh, number, pieces)
    put(os.path.join(folder, f"{number}.f{8 * triangles.dtype.itemsize}"), triangles.astype(triangles.dtype.newbyteorder("<")).data)
    put(os.path.join(folder, f"{number}.bounds"), bounds(triangles).data)


def print_grid(resolution, *paths):
    whole = grid([np.fromfile(path).reshape(-1, 3, 3) for path in paths], int(resolution))
    print(*(f"--{name}={','.join(map(repr, numbers))}" for name, numbers in zip(("origin", "cell", "size"), whole)))


if __name__ == "__main__":
    {"cut": cut, "grid": print_grid}[sys.argv[1]](*sys.argv[2:])
