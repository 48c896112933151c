"""Files of cells, as the program tribox writes them, some by the program itself; and those that can be read again."""

import errno
import os
import re
import secrets
from collections import namedtuple
from contextlib import suppress
from types import SimpleNamespace

import numpy as np

from ._errors import Error, InputError, shown
from ._grids import Grid
from ._masks import bools, labels_of
from ._program import write_by_program

Kind = namedtuple("Kind", "name dtype nrrd vtk range remark")
OCCUPIED = Kind("occupied", "|b1", "uint8", "UInt8", ' RangeMin="0" RangeMax="1"', "")
LABELS = Kind("label", "|u1", "uint8", "UInt8", ' RangeMin="0" RangeMax="2"', ": 1, and that it encloses: 2")
IDS = Kind("id", "<i4", "int32\nendian: little", "Int32", "", ": the number of the lowest triangle, else -1")
IDS_MAX = (1 << 31) - 1


def decimal(number):
    """The shortest decimal that is this number."""
    if number == 0 or float(np.float32(1e-5)) <= abs(number) < 1e9:
        return np.format_float_positional(number, trim="-")
    return np.format_float_scientific(number, trim="-", exp_digits=2)


def point(numbers, between):
    return between.join(map(decimal, numbers))


def write_cells(file, voxels):
    """A byte a cell, or with ids four, layer by layer."""
    inside, ids, nx = voxels.inside, voxels._ids, voxels.shape[2]
    for k, words in enumerate(voxels.words):
        cells = bools(words, nx)
        if ids is not None:
            numbers, count = np.full(cells.shape, -1, IDS.dtype), np.count_nonzero(cells)
            numbers[cells], ids, cells = ids[:count], ids[count:], numbers
        elif inside is not None:
            cells = labels_of(words, inside.words[k], nx)
        file.write(cells.tobytes())


def kind_of(voxels):
    """What the cells hold in dense files."""
    if voxels._ids is None:
        return OCCUPIED if voxels.inside is None else LABELS
    if len(voxels._ids) and voxels._ids.max() > IDS_MAX:
        raise InputError(f"ids up to {voxels._ids.max()} do not fit int32, as dense files have them; give a name that ends in .npz")
    return IDS


def write_npy(file, voxels):
    np.lib.format.write_array_header_1_0(file, dict(descr=kind_of(voxels).dtype, fortran_order=False, shape=voxels.shape))
    write_cells(file, voxels)


def write_nrrd(file, voxels):
    grid, kind = voxels.grid, kind_of(voxels)
    x, y, z = grid.cell
    directions = " ".join(f"({point(row, ',')})" for row in ((x, 0, 0), (0, y, 0), (0, 0, z)))
    middle = point((start + cell / 2 for start, cell in zip(grid.origin, grid.cell)), ",")
    file.write(f"""NRRD0004
# cells of a grid that a mesh overlaps{kind.remark}, by tribox
type: {kind.nrrd}
dimension: 3
space dimension: 3
sizes: {' '.join(map(str, grid.size))}
space directions: {directions}
centers: cell cell cell
kinds: domain domain domain
encoding: raw
space origin: ({middle})

""".encode("ascii"))
    write_cells(file, voxels)


def write_vti(file, voxels):
    grid, kind = voxels.grid, kind_of(voxels)
    extent = " ".join(f"0 {size}" for size in grid.size)
    file.write(f"""<?xml version="1.0"?>
<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
  <ImageData WholeExtent="{extent}" Origin="{point(grid.origin, ' ')}" Spacing="{point(grid.cell, ' ')}">
    <Piece Extent="{extent}">
      <CellData Scalars="{kind.name}">
        <DataArray type="{kind.vtk}" Name="{kind.name}" format="appended"{kind.range} offset="0"/>
      </CellData>
    </Piece>
  </ImageData>
  <AppendedData encoding="raw">
   _""".encode("ascii"))
    file.write(np.array(np.prod(grid.size, dtype=np.uint64) * np.dtype(kind.dtype).itemsize, "<u8").tobytes())
    write_cells(file, voxels)
    file.write(b"\n  </AppendedData>\n</VTKFile>\n")


def write_bricks(file, bricks):
    """.npz"""
    grid, ids = bricks.grid, {} if bricks.ids is None else dict(ids=bricks.ids)
    labels = {} if bricks.inside is None else dict(inside=bricks.inside)
    colors = {} if bricks.colors is None else dict(colours=bricks.colors)
    np.savez(file, bits=bricks.bits, at=bricks.at, **labels, **colors, origin=np.array(grid.origin), cell=np.array(grid.cell),
             size=np.array(grid.size, np.uint32), shift=np.array(bricks.shift, float), **ids)


def write_npz(file, voxels):
    from ._bricks import bricks_in  # which is made of what is here

    write_bricks(file, bricks_in(voxels))


WRITERS = {".npz": write_npz, ".npy": write_npy, ".nrrd": write_nrrd, ".vti": write_vti}
# What each format holds besides cells; a test asks the program.
HOLDS = {".npz": ("ids", "labels", "colors"), ".npy": ("ids", "labels"), ".nrrd": ("ids", "labels"), ".vti": ("ids", "labels"),
         ".vdb": ("ids", "labels", "colors"), ".vox": ("labels", "colors"), ".ply": ("colors",), ".obj": ("colors",),
         ".glb": ("colors",), ".binvox": (), ".raw": ("ids", "labels")}


def ending_of(path, cells):
    """Of a format that holds all that is known of cells, Voxels or Bricks."""
    ending = os.path.splitext(path)[1].lower()
    if ending not in HOLDS:
        raise InputError(f"path = {shown(path)}; files are written whose names end in {', '.join(HOLDS)}")
    for what, one in (("ids", cells.ids), ("labels", cells.inside), ("colors", cells.colors)):
        if one is not None and what not in HOLDS[ending]:
            others = ", ".join(other for other, held in HOLDS.items() if what in held)
            raise InputError(f"path = {shown(path)}; {ending} holds no {what}; give a name that ends in {others}, or save "
                             "tribox.Voxels(voxels.words, voxels.grid), the cells alone")
    return ending


def write_new(path, write, what):
    """Beside the name until it is complete, so that what was there stays if it cannot be; where links lead to."""
    target = os.path.realpath(path)
    draft = os.path.join(os.path.dirname(target), f".tribox-{secrets.token_hex(8)}")
    try:
        with open(draft, "xb") as file:
            write(file, what)
        os.replace(draft, target)
    except BaseException:
        with suppress(OSError):
            os.remove(draft)
        raise


def save_voxels(voxels, path):
    ending = ending_of(path, SimpleNamespace(ids=voxels._ids, inside=voxels._inside, colors=voxels._colors))
    if ending != ".npy" and voxels.window[1] != voxels.grid.size:
        raise InputError(f"path = {shown(path)}; these are the cells {voxels.window} of a grid of {voxels.grid.sides()}, and files "
                         "but .npy hold whole grids; voxelize without a window, or give a name that ends in .npy")
    write_as(path, ending, WRITERS, voxels)


def save_bricks(bricks, path):
    ending = ending_of(path, bricks)
    if bricks.shard and ending != ".npz":
        raise InputError(f"path = {shown(path)}; these Bricks are shard {bricks.shard[0]} of {bricks.shard[1]}; tribox merge makes "
                         "one file of all")
    write_as(path, ending, {".npz": write_bricks}, bricks)


def write_as(path, ending, writers, cells):
    """By one of these writers, else by the program."""
    def by_program(file, what):
        write_by_program(file, lambda npz: writers[".npz"](npz, what), path, ending)

    write_new(path, writers.get(ending, by_program), cells)


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
