"""Triangles into the cells of a grid."""

from math import isfinite
from operator import index

import numpy as np

from ._arguments import check, options_of, three
from ._errors import InputError, named, shown
from ._ffi import ffi
from ._library import lib
from ._masks import WORD, bools, check_out, pointer_to
from ._overlap import ALL
from ._triangles import soups

GRID = ffi.typeof("tribox_grid *")
WORDS_MAX = 1 << 31  # of a grid


def is_lone(value):
    try:
        iter(value)
    except TypeError:
        return True
    return False


def grid_of(origin, cell, size):
    cells = three("cell", (cell,) * 3 if is_lone(cell) else cell)
    start = three("origin", origin)
    try:
        nx, ny, nz = map(index, size)
        return ffi.new(GRID, (start, cells, (nx, ny, nz)))
    except (OverflowError, TypeError, ValueError):
        raise InputError(f"size = {shown(size)}; give three numbers of cells, x, y, z, each less than 2^32") from None


def layers_of(layers, grid):
    """(first, count), all layers by default."""
    try:
        first, count = (0, grid.size[2]) if layers is None else map(index, layers)
    except (TypeError, ValueError):
        first, count = -1, 0
    if first < 0 or count < 0 or first + count > grid.size[2]:
        raise InputError(f"layers = {shown(layers)}; give (first, count) within the {grid.size[2]} layers")
    return first, count


def status_of(grid, options=ffi.NULL):
    """What the library says to a voxelization of no triangles."""
    return lib.tribox_voxelize_layers(ffi.new("tribox_soup *"), grid, 0, 0, options, ffi.new("uint64_t *"), ffi.NULL)


def sufficient_cell(origin, size):
    """A length that `size` cells on an axis can have: planes twice the spacing of floats apart are distinct. inf if none."""
    cell = 0.0
    while True:
        end = origin + size * cell
        if abs(end) > np.finfo(np.float32).max:
            return np.inf
        needed = 2 * float(np.spacing(np.float32(max(abs(origin), abs(end)))))
        if cell >= needed:
            return cell
        cell = needed


def fault_of_axis(axis, origin, cell, size):
    """What is wrong with an axis of a grid; None if nothing is."""
    if not isfinite(origin) or not isfinite(cell):
        return f"the origin or the cell is not finite as float32 on the {axis} axis"
    if not cell > 0 or not size:
        return f"the cell or the size is not greater than zero on the {axis} axis"
    if not status_of(ffi.new(GRID, ((origin, 0, 0), (cell, 1, 1), (size, 1, 1)))):
        return None
    if origin + size * cell > np.finfo(np.float32).max:
        return f"the grid ends beyond the largest float32 on the {axis} axis"
    enough = sufficient_cell(origin, size)
    larger = f"cells of {enough:.9g} are large enough, or" if isfinite(enough) else "choose fewer cells, or"
    return f"float32 cannot tell cells of {cell:.9g} apart on the {axis} axis, so far from 0; {larger} move the origin towards 0"


def fault_of(grid):
    """Which of its conditions a grid does not meet."""
    for a, axis in enumerate("xyz"):
        fault = fault_of_axis(axis, grid.origin[a], grid.cell[a], grid.size[a])
        if fault:
            return fault
    gigabytes = (grid.size[0] + 63) // 64 * grid.size[1] * grid.size[2] / 2 ** 27
    return f"the grid takes {gigabytes:.4g} GiB, a bit per cell, and can take {WORDS_MAX >> 27} at most; choose fewer cells"


def check_grid(grid, options, axes, **given):
    """Raises what is wrong with a grid or the options, before memory is taken for cells. given: the grid as the caller has it."""
    status = status_of(grid, options)
    if status == lib.TRIBOX_BAD_GRID:
        raise InputError(f"{fault_of(grid)}: {named(given)}", "BAD_GRID")
    check(status, axes=axes)


def voxelize(triangles, origin, cell, size, *, layers=None, accuracy="exact", axes=ALL, kernel=None, packed=False, out=None):
    """Tells which cells of a grid some triangle overlaps, the surface alone: an array of bool of shape (nz, ny, nx).

    triangles: as for overlap. Arrays and meshes are copied to streams block by block, in 2.3 MB of memory.
    origin: the lower corner of the grid. cell: the length of a cell, or three. size: the cells on each axis, (nx, ny, nz).
    layers: (first, count) for these layers along z alone, with the same answers as for the whole; for threads and large grids.
    packed: returns uint64 words of shape (nz, ny, words) instead; bit i % 64 of word i // 64 of a row is cell i along x.
    out: an array of either kind, in which cells are set; those already set stay set.
    """
    grid = grid_of(origin, cell, size)
    options = options_of(accuracy, axes, 0, kernel)
    check_grid(grid, options, axes, origin=origin, cell=cell, size=size)
    first, count = layers_of(layers, grid)
    shape = count, grid.size[1], grid.size[0]
    packed_shape = count, grid.size[1], lib.tribox_grid_row_words(grid)
    words = None
    if out is not None:
        packed = check_out(out, shape, packed_shape)
        words = out if packed else None
    if words is None:
        words = np.zeros(packed_shape, WORD)
    for _, soup in soups(triangles):
        check(lib.tribox_voxelize_layers(soup, grid, first, count, options, pointer_to(words), ffi.NULL), axes=axes)
    if packed:
        return words
    if out is None:
        return bools(words, shape[2])
    return np.logical_or(out, bools(words, shape[2]), out=out)
