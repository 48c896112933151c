"""Files of cells, as the program tribox writes them."""

import os

import numpy as np

from ._errors import InputError, shown
from ._masks import bools, labels_of


def decimal(number):
    """The shortest decimal that is this number."""
    if number == 0 or float(np.float32(1e-5)) <= abs(number) < 1e9:
        return np.format_float_positional(number, trim="-")
    return np.format_float_scientific(number, trim="-", exp_digits=2)


def point(numbers, between):
    return between.join(map(decimal, numbers))


def write_bytes(file, voxels):
    """A byte a cell, layer by layer."""
    inside = voxels.inside
    for k, layer in enumerate(voxels.words):
        nx = voxels.shape[2]
        file.write((bools(layer, nx) if inside is None else labels_of(layer, inside.words[k], nx)).tobytes())


def write_npy(file, voxels):
    np.lib.format.write_array_header_1_0(file, dict(descr="|b1" if voxels.inside is None else "|u1", fortran_order=False, shape=voxels.shape))
    write_bytes(file, voxels)


def write_nrrd(file, voxels):
    grid = voxels.grid
    x, y, z = grid.cell
    directions = " ".join(f"({point(row, ',')})" for row in ((x, 0, 0), (0, y, 0), (0, 0, z)))
    middle = point((start + cell / 2 for start, cell in zip(grid.origin, grid.cell)), ",")
    labels = "" if voxels.inside is None else ": 1, and that it encloses: 2"
    file.write(f"""NRRD0004
# cells of a grid that a mesh overlaps{labels}, by tribox
type: uint8
dimension: 3
space dimension: 3
sizes: {' '.join(map(str, grid.size))}
space directions: {directions}
centers: cell cell cell
kinds: domain domain domain
encoding: raw
space origin: ({middle})

""".encode("ascii"))
    write_bytes(file, voxels)


def write_vti(file, voxels):
    grid = voxels.grid
    extent = " ".join(f"0 {size}" for size in grid.size)
    name, most = ("occupied", 1) if voxels.inside is None else ("label", 2)
    file.write(f"""<?xml version="1.0"?>
<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
  <ImageData WholeExtent="{extent}" Origin="{point(grid.origin, ' ')}" Spacing="{point(grid.cell, ' ')}">
    <Piece Extent="{extent}">
      <CellData Scalars="{name}">
        <DataArray type="UInt8" Name="{name}" format="appended" RangeMin="0" RangeMax="{most}" offset="0"/>
      </CellData>
    </Piece>
  </ImageData>
  <AppendedData encoding="raw">
   _""".encode("ascii"))
    file.write(np.array(np.prod(grid.size, dtype=np.uint64), "<u8").tobytes())
    write_bytes(file, voxels)
    file.write(b"\n  </AppendedData>\n</VTKFile>\n")


def write_bricks(file, bricks):
    """.npz"""
    grid, ids = bricks.grid, {} if bricks.ids is None else dict(ids=bricks.ids)
    labels = {} if bricks.inside is None else dict(inside=bricks.inside)
    np.savez(file, bits=bricks.bits, at=bricks.at, **labels, origin=np.array(grid.origin), cell=np.array(grid.cell),
             size=np.array(grid.size, np.uint32), shift=np.array(bricks.shift, float), **ids)


def write_npz(file, voxels):
    from ._bricks import bricks_in  # which is made of what is here

    write_bricks(file, bricks_in(voxels))


WRITERS = {".npz": write_npz, ".npy": write_npy, ".nrrd": write_nrrd, ".vti": write_vti}


def ending_of(path, endings):
    ending = os.path.splitext(path)[1].lower()
    if ending not in endings:
        raise InputError(f"path = {shown(path)}; here files are written whose names end in {', '.join(endings)}; the program "
                         "writes others: tribox voxelize MESH -o FILE")
    return ending


def save_voxels(voxels, path):
    ending = ending_of(path, WRITERS)
    if ending != ".npy" and voxels.window[1] != voxels.grid.size:
        raise InputError(f"path = {shown(path)}; these are the cells {voxels.window} of a grid of {voxels.grid.sides()}, and files "
                         "but .npy hold whole grids; voxelize without a window, or give a name that ends in .npy")
    with open(path, "wb") as file:
        WRITERS[ending](file, voxels)


def save_bricks(bricks, path):
    ending_of(path, (".npz",))
    with open(path, "wb") as file:
        write_bricks(file, bricks)
