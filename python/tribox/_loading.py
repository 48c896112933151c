"""Files of cells, as the program tribox and this module write them, read again."""

import errno
import os
import re

import numpy as np

from ._errors import Error, InputError, shown
from ._files import IDS, LABELS
from ._grids import Grid

KINDS = dict(at=("<u4", (-1, 3)), bits=("<u8", (-1, 8)), inside=("<u8", (-1, 8)), origin=("<f8", (3,)), cell=("<f8", (3,)),
             size=("<u4", (3,)), shift=("<f8", (3,)), ids=("<u4", (-1,)), shard=("<u4", (2,)), colours=("|u1", (-1, 3)))
WANTED = {"inside", "ids", "shard", "colours"}  # if they are there


def arrays_of(path, file):
    found = {}
    for name, (kind, shape) in KINDS.items():
        if name in WANTED and name not in file.files:
            continue
        of = file[name]
        if of.dtype.str != kind or of.ndim != len(shape) or of.shape[1:] != shape[1:] or shape[0] not in (-1, len(of)):
            raise InputError(f"{path}: not a .npz file of bricks: its {name} is {of.dtype} of shape {of.shape}")
        found[name] = of.astype(kind[1:], copy=False)  # of this machine's byte order
    return found


def read(path):
    with open(path, "rb") as stream:
        try:
            with np.load(stream, allow_pickle=False) as file:
                return arrays_of(path, file)
        except (InputError, MemoryError):
            raise
        except Exception as error:  # of NumPy, zipfile and zlib, whatever the damage is, a place before the file's beginning too
            if isinstance(error, OSError) and error.errno not in (None, errno.EINVAL):
                raise
            raise InputError(f"{path}: not a .npz file of bricks, or a damaged one: {error}") from error


def ending_of_input(path):
    """Of a file of cells that can be read here."""
    if not isinstance(path, (str, os.PathLike)):
        raise InputError(f"path = {shown(path)}; give the path of a file")
    ending = os.path.splitext(path)[1].lower()
    if ending == ".npy":
        raise InputError(f"path = {shown(path)}; a .npy has no grid: tribox.Voxels(numpy.load(path), grid) makes Voxels of it")
    if ending not in (".npz", ".binvox", *HEADS):
        raise InputError(f"path = {shown(path)}; files are read whose names end in .npz, {', '.join(HEADS)}, .binvox; others do "
                         "not say where their cells are, or hold faces")
    return ending


def numbers_in(text):
    return tuple(map(float, re.findall(r"[-+.\w]+", text)))


def grid_of_nrrd(head):
    fields = dict(line.split(": ", 1) for line in head.splitlines() if ": " in line and line[0] != "#")
    cell = numbers_in(fields["space directions"])[::4]
    origin = [middle - side / 2 for middle, side in zip(numbers_in(fields["space origin"]), cell)]
    return Grid(origin, cell, map(int, fields["sizes"].split())), fields["type"].partition("\n")[0]


def grid_of_vti(head):
    attributes = dict(re.findall(r'(\w+)="([^"]*)"', head))
    size = map(int, attributes["WholeExtent"].split()[1::2])
    return Grid(numbers_in(attributes["Origin"]), numbers_in(attributes["Spacing"]), size), attributes["type"]


# The end of a head, how many bytes lie between it and the cells, how many behind these, and what the head says.
HEADS = {".nrrd": (b"\n\n", 0, 0, grid_of_nrrd),
         ".vti": (b'<AppendedData encoding="raw">\n   _', 8, len("\n  </AppendedData>\n</VTKFile>\n"), grid_of_vti)}
HEAD_MAX = 4096
TYPES = {name: np.dtype(kind.dtype) for kind in (LABELS, IDS) for name in (kind.nrrd.partition("\n")[0], kind.vtk)}


def load_dense(path):
    """An array of a number for each cell, the grid, and whether they are labels."""
    end, before, behind, grid_of_head = HEADS[ending_of_input(path)]
    with open(path, "rb") as file:
        head, found, _ = file.read(HEAD_MAX).partition(end)
        try:
            grid, type_ = grid_of_head(head.decode("ascii"))
            dtype = TYPES[type_]
        except (Error, ValueError, LookupError) as error:
            raise InputError(f"{path}: not a file of cells as tribox writes them: {error}") from error
        start, count = len(head) + len(end) + before, int(np.prod(grid.size, dtype=np.uint64))
        octets = os.fstat(file.fileno()).st_size
        if not found or octets != start + count * dtype.itemsize + behind:
            raise InputError(f"{path}: damaged: {octets} bytes, and {grid.sides()} of {dtype}")
        file.seek(start)
        is_labels = LABELS.remark.encode() in head or f'Name="{LABELS.name}"'.encode() in head
        return np.fromfile(file, dtype, count).reshape(grid.size[::-1]), grid, is_labels


def load_binvox(path):
    """An array of bool and the grid, a cube of cells."""
    with open(path, "rb") as file:
        head, _, runs = file.read().partition(b"\ndata\n")
    found = re.fullmatch(rb"#binvox 1\ndim (\d+) \1 \1\ntranslate (.+)\nscale (.+)", head)
    try:
        side = int(found[1])
        grid = Grid(numbers_in(found[2].decode("ascii")), float(found[3]) / side, (side,) * 3)
        values, counts = np.frombuffer(runs, np.uint8).reshape(-1, 2).T
        if counts.sum(dtype=np.uint64) != side ** 3:
            raise ValueError(f"{counts.sum(dtype=np.uint64)} cells in place of {side ** 3}")
    except (Error, ValueError, TypeError, ArithmeticError) as error:
        raise InputError(f"{path}: not a file of cells as tribox writes them, or a damaged one: {error}") from error
    return np.repeat(values != 0, counts).reshape(side, side, side).transpose(1, 2, 0), grid


def load_bricks(path):
    """at, bits, grid, shift, shard, ids, inside and colors."""
    if not isinstance(path, (str, os.PathLike)):
        raise InputError(f"path = {shown(path)}; give the path of a file; tribox merge makes one of many parts")
    path = os.fspath(path)
    found = read(path)
    at, bits, ids, inside, shard, colors = map(found.get, ("at", "bits", "ids", "inside", "shard", "colours"))
    for rows in (bits,) if inside is None else (bits, inside):
        if len(rows) != len(at):
            raise InputError(f"{path}: damaged: {len(at)} places of {len(rows)} bricks")
    for what, rows in ("ids", ids), ("colours", colors):
        if rows is not None and len(rows) != np.count_nonzero(np.unpackbits(bits.view(np.uint8))):
            raise InputError(f"{path}: damaged: {len(rows)} {what} of other cells")
    return (at, bits, Grid(*(found[name] for name in ("origin", "cell", "size"))), tuple(found["shift"].tolist()),
            None if shard is None else tuple(shard.tolist()), ids, inside, colors)
