"""Files of cells, as the program tribox writes them, some by the program itself."""

import os
import secrets
from collections import namedtuple
from contextlib import suppress
from types import SimpleNamespace

import numpy as np

from ._errors import InputError, shown
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
                             "tribox.Voxels(voxels.words, voxels.grid, voxels.window), the cells alone")
    return ending


def write_new(path, write, what):
    """Beside the name until it is complete, so that what was there stays if it cannot be; where links lead to."""
    target = os.path.realpath(path)
    draft = os.path.join(os.path.dirname(target), f".tribox-{secrets.token_hex(8)}")
    try:
        with open(draft, "xb") as file:
            write(file, what)
        os.replace(draft, target)
    except BaseException as error:
        with suppress(OSError):
            os.remove(draft)
        if getattr(error, "filename", None) == draft:
            error.filename = os.fspath(path)
        raise


def save_voxels(voxels, path):
    ending = ending_of(path, SimpleNamespace(ids=voxels._ids, inside=voxels._inside, colors=voxels._colors))
    if ending in (".nrrd", ".vti"):
        try:
            voxels = voxels._within((0, 0, 0), voxels.grid.size)
        except (MemoryError, ValueError):
            raise InputError(f"path = {shown(path)}; {ending} holds every cell of a grid, and there is no memory for "
                             f"{voxels.grid.sides()}; give a name that ends in .npz, or in .npy for the window alone") from None
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
