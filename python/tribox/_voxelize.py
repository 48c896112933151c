"""Triangles into the cells of a grid."""

from operator import index

import numpy as np

from ._errors import InputError
from ._ffi import ffi
from ._library import lib
from ._masks import WORD, bools, check_out, pointer_to
from ._options import options_of
from ._overlap import ALL, check, three
from ._triangles import soups

GRID = ffi.typeof("tribox_grid *")


def grid_of(origin, cell, size):
    cells = three("cell", (cell,) * 3 if np.ndim(cell) == 0 else cell)
    start = three("origin", origin)
    try:
        nx, ny, nz = map(index, size)
        return ffi.new(GRID, (start, cells, (nx, ny, nz)))
    except (OverflowError, TypeError, ValueError):
        raise InputError(f"size = {size!r}; it is three numbers of cells, x, y, z, each less than 2^32") from None


def layers_of(layers, grid):
    """(first, count), all layers by default."""
    try:
        first, count = (0, grid.size[2]) if layers is None else map(index, layers)
    except (TypeError, ValueError):
        first, count = -1, 0
    if first < 0 or count < 0 or first + count > grid.size[2]:
        raise InputError(f"layers = {layers!r}; it is (first, count), of the {grid.size[2]} layers")
    return first, count


def ask_first(grid, options, axes, **named):
    """Raises what is wrong with a grid or the options, before there is memory for the cells: a voxelization of no triangles."""
    status = lib.tribox_voxelize_layers(ffi.new("tribox_soup *"), grid, 0, 0, options, ffi.new("uint64_t *"), ffi.NULL)
    check(status, axes=axes, **named)


def voxelize(triangles, origin, cell, size, *, layers=None, accuracy="exact", axes=ALL, kernel=None, packed=False, out=None):
    """Tells of each cell of a grid whether some triangle overlaps it: an array of bool, of shape (nz, ny, nx).

    triangles: as for overlap. Arrays and meshes are copied to streams block by block, in 2.3 MB of memory.
    origin: the lower corner of the grid. cell: the length of a cell, or three. size: how many cells on each axis, (nx, ny, nz).
    layers: (first, count) for these layers along z alone, with the same answers as the whole; for threads and for large grids.
    packed: returns uint64 words of shape (nz, ny, words) instead; bit i % 64 of word i // 64 of a row is cell i along x.
    out: an array of either kind, in which the cells are set; those that are set already stay so.
    """
    grid = grid_of(origin, cell, size)
    options = options_of(accuracy, axes, 0, kernel)
    ask_first(grid, options, axes, origin=origin, cell=cell, size=size)
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
