"""Triangles into the cells of a grid."""

from math import inf, isfinite
from operator import index

import numpy as np

from ._arguments import are_floats, check, options_of, three
from ._errors import InputError, named, shown
from ._ffi import ffi
from ._library import lib
from ._masks import WORD, bools, check_out, pointer_to
from ._overlap import ALL
from ._triangles import check_indices, held, meshes, soups

GRID, GRID_F64 = ffi.typeof("tribox_grid *"), ffi.typeof("tribox_grid_f64 *")
WORDS_MAX = 1 << 31  # of a grid


def is_lone(value):
    try:
        iter(value)
    except TypeError:
        return True
    return False


def grid_of(origin, cell, size):
    """A grid of floats where they hold its numbers and tell its planes apart, else of doubles."""
    cells = three("cell", (cell,) * 3 if is_lone(cell) else cell)
    start = three("origin", origin)
    try:
        numbers = start, cells, tuple(map(index, size))
        _, _, (_, _, _) = numbers
        grid = ffi.new(GRID_F64, numbers)
    except (OverflowError, TypeError, ValueError):
        raise InputError(f"size = {shown(size)}; give three numbers of cells, x, y, z, each less than 2^32") from None
    if are_floats(*start, *cells):
        single = ffi.new(GRID, numbers)
        if status_of(single) == lib.TRIBOX_OK:
            return single
    return grid


def in_double(grid):
    return grid if ffi.typeof(grid) is GRID_F64 else ffi.new(GRID_F64, (tuple(grid.origin), tuple(grid.cell), tuple(grid.size)))


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
    word = ffi.new("uint64_t *")
    if ffi.typeof(grid) is GRID:
        return lib.tribox_voxelize_layers(ffi.new("tribox_soup *"), grid, 0, 0, options, word, ffi.NULL)
    return lib.tribox_voxelize_f64(ffi.new("tribox_mesh *"), grid, (0, 0, 0), (1, 1, 1), options, word, ffi.NULL)


def sufficient_cell(origin, size):
    """A length that `size` cells on an axis can have: planes twice the spacing of doubles apart are distinct. inf if none."""
    cell = 0.0
    while True:
        end = origin + size * cell
        if not isfinite(end):
            return inf
        needed = 2 * float(np.spacing(max(abs(origin), abs(end))))
        if cell >= needed:
            return cell
        cell = needed


def fault_of_axis(axis, origin, cell, size):
    """What is wrong with an axis of a grid; None if nothing is."""
    if not isfinite(origin) or not isfinite(cell):
        return f"the origin or the cell is not finite on the {axis} axis"
    if not cell > 0 or not size:
        return f"the cell or the size is not greater than zero on the {axis} axis"
    if not status_of(ffi.new(GRID_F64, ((origin, 0, 0), (cell, 1, 1), (size, 1, 1)))):
        return None
    if not isfinite(origin + size * cell):
        return f"the grid ends beyond the largest float64 on the {axis} axis"
    enough = sufficient_cell(origin, size)
    larger = f"cells of {enough:.17g} are large enough, or" if isfinite(enough) else "choose fewer cells, or"
    return f"float64 cannot tell cells of {cell:.17g} apart on the {axis} axis, so far from 0; {larger} move the origin towards 0"


def check_grid(grid, options, axes, **given):
    """Raises what is wrong with a grid or the options, before memory is taken for cells. given: the grid as the caller has it."""
    status = status_of(grid, options)
    if status == lib.TRIBOX_BAD_GRID:
        faults = (fault_of_axis(axis, grid.origin[a], grid.cell[a], grid.size[a]) for a, axis in enumerate("xyz"))
        raise InputError(f"{next(filter(None, faults))}: {named(given)}", "BAD_GRID")
    check(status, axes=axes)


def check_room(shape, **given):
    """Raises that there are too many words for a call to write."""
    words = shape[0] * shape[1] * shape[2]
    if words > WORDS_MAX:
        raise InputError(f"the grid takes {words / 2 ** 27:.4g} GiB, a bit per cell, and can take {WORDS_MAX >> 27} at most; "
                         f"choose fewer cells: {named(given)}", "BAD_GRID")


def set_cells(held_, grid, first, count, options, words):
    """Sets the bits of layers of a grid; returns the status."""
    if ffi.typeof(grid) is GRID:
        for _, soup in soups(held_):
            status = lib.tribox_voxelize_layers(soup, grid, first, count, options, pointer_to(words), ffi.NULL)
            if status:
                return status
        return 0
    check_indices(held_)
    for _, mesh in meshes(held_) if count else ():
        size = grid.size[0], grid.size[1], count
        status = lib.tribox_voxelize_f64(mesh, grid, (0, 0, first), size, options, pointer_to(words), ffi.NULL)
        if status:
            return status
    return 0


def voxelize(triangles, origin, cell, size, *, layers=None, accuracy="exact", axes=ALL, kernel=None, packed=False, out=None):
    """Tells which cells of a grid some triangle overlaps, the surface alone: an array of bool of shape (nz, ny, nx).

    triangles: as for overlap.
    origin: the lower corner of the grid. cell: the length of a cell, or three. size: the cells on each axis, (nx, ny, nz).
        Plane p lies at origin + p * cell, rounded to float32 where triangles, origin and cell are float32 and that tells all planes
        apart, and else to float64: the number 0.1 is the double, np.float32(0.1) the float, which is faster.
    layers: (first, count) for these layers along z alone, with the same answers as for the whole; for threads and large grids.
    packed: returns uint64 words of shape (nz, ny, words) instead; bit i % 64 of word i // 64 of a row is cell i along x.
    out: an array of either kind, in which cells are set; those already set stay set.
    """
    held_, grid, options = held(triangles), grid_of(origin, cell, size), options_of(accuracy, axes, 0, kernel)
    if held_.is_double:
        grid = in_double(grid)
    check_grid(grid, options, axes, origin=origin, cell=cell, size=size)
    first, count = layers_of(layers, grid)
    shape = count, grid.size[1], grid.size[0]
    packed_shape = count, grid.size[1], (grid.size[0] + 63) >> 6
    check_room(packed_shape, origin=origin, cell=cell, size=size)
    words = None
    if out is not None:
        packed = check_out(out, shape, packed_shape)
        words = out if packed else None
    if words is None:
        words = np.zeros(packed_shape, WORD)
    check(set_cells(held_, grid, first, count, options, words), axes=axes)
    if packed:
        return words
    if out is None:
        return bools(words, shape[2])
    return np.logical_or(out, bools(words, shape[2]), out=out)
