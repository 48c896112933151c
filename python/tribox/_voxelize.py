"""Triangles into the cells of a grid."""

from __future__ import annotations

from typing import Optional, SupportsIndex

import numpy as np

from . import _c
from ._around import grid_given
from ._arguments import options_of, range_of
from ._errors import InputError, InputTypeError, check_indices, shown
from ._ffi import ffi
from ._fill import fill_of, filled
from ._grids import struct_of
from ._masks import WORD, pointer_to, row_words
from ._overlap import ALL, check_answer
from ._threads import in_threads, processors, threads_of
from ._triangles import Part, held
from ._typing import Accuracy, Cell, Fill, GridLike, Range, TrianglesLike, Window
from ._voxels import Voxels, window_of

WORDS_MAX = 1 << 31  # of one call
PARTS_EACH = 4  # slabs of each thread: some have far more triangles than others
# Where threads gain something, as measured with two of them:
SHARED_LEAST = 1 << 19  # triangles: fewer are done before their cells are joined,
CELLS_OF_ONE = 1  # as are those of fewer than one for so many words of cells
SLABS = range(1 << 21, 1 << 22)  # words of cells: more are fresh pages, which threads take from the system in turn
MANY_CELLS = 64  # words of cells a triangle: from there on it is cells that take the time, and not looking at triangles again


def window_wanted(window, layers, grid):
    """(first, size) of the cells that are wanted, all by default."""
    if layers is None:
        return window_of(window, grid)
    if window is not None:
        raise InputError("layers and window exclude each other; a window can be of whole layers")
    first, count = range_of("layers", layers, grid.size[2], "layers")
    return (0, 0, first), (*grid.size[:2], count)


def new_cells(shape, grid):
    """Words for the cells of a window, all clear."""
    nz, ny, nx = shape
    words = nz * ny * row_words(nx)
    if words > WORDS_MAX:
        raise InputError(f"the cells take {words / 2 ** 27:.4g} GiB, a bit per cell, and can take {WORDS_MAX >> 27} at most; give "
                         f"a window, or fewer cells, or ask tribox.bricks: {grid}", "BAD_GRID")
    return np.zeros((nz, ny, row_words(nx)), WORD)


def set_cells(held_, grid, first, size, options, words):
    """Sets the bits of a window of a grid; returns the status."""
    return _c.voxelize(held_, grid, ffi.new("tribox_window *", (first, size)), options, pointer_to(words), ffi.NULL)


def cut(count, parts):
    """(first, end) of so many parts of about one size."""
    return [(count * part // parts, count * (part + 1) // parts) for part in range(parts)]


def set_slabs(held_, grid, first, size, options, words, threads):
    """The same by threads, each of which owns some layers. Every part looks at all triangles."""
    def work(slab):
        low, high = slab
        corner, part = (*first[:2], first[2] + low), (*size[:2], high - low)
        return set_cells(held_, grid, corner, part, options, words[low:high])

    return max(in_threads(threads, work, cut(size[2], min(size[2], threads * PARTS_EACH))))


def set_shares(held_, grid, first, size, options, words, threads):
    """The same by threads, each of which has some of the triangles, and all cells but the first's for itself."""
    own = [words] + [np.zeros_like(words) for _ in range(1, threads)]

    def work(number):
        share = Part(held_, *cut(held_.struct.count, threads)[number])
        return set_cells(share, grid, first, size, options, own[number])

    status = max(in_threads(threads, work, range(threads)))
    for cells in own[1:]:
        np.bitwise_or(words, cells, out=words)
    return status


def set_cells_at_once(held_, grid, first, size, options, words, threads):
    """The same by as many threads as gain something: never more than there are processors, and one where neither way pays."""
    threads, count = min(threads, processors()), held_.struct.count
    if threads > 1:
        check_indices(held_)  # of all triangles: one part should write nothing where another has a wrong one
    if threads > 1 and words.size in SLABS and words.size >= MANY_CELLS * count:
        return set_slabs(held_, grid, first, size, options, words, threads)
    if threads > 1 and count >= SHARED_LEAST and words.size <= CELLS_OF_ONE * count:
        return set_shares(held_, grid, first, size, options, words, threads)
    return set_cells(held_, grid, first, size, options, words)


def check_into(into, grid, window):
    if not isinstance(into, Voxels):
        raise InputTypeError(f"into = {shown(into)}; give Voxels, to which the cells are added")
    if (into.grid, into.window) != (grid, window):
        raise InputError(f"into has the cells {into.window} of {into.grid}, and not {window} of {grid}; give its grid and window")


def voxelize(triangles: TrianglesLike, grid: Optional[GridLike] = None, *, cell: Optional[Cell] = None,
             resolution: Optional[SupportsIndex] = None, window: Optional[Window] = None, layers: Optional[Range] = None,
             fill: Optional[Fill] = None, threads: Optional[SupportsIndex] = 1, accuracy: Accuracy = "exact", axes: int = ALL,
             kernel: Optional[str] = None, into: Optional[Voxels] = None) -> Voxels:
    """Tells which cells of a grid some triangle overlaps, the surface alone: Voxels, an array of bool that knows its grid.

        voxelize(mesh, cell=0.05)        a grid around the mesh, of cells of that length; cell=(x, y, z) where they are no cubes
        voxelize(mesh, resolution=256)   a grid around the mesh, of cubes, so many of them along its longest side
        voxelize(mesh, grid)             tribox.Grid(origin, cell, size), or (origin, cell, size)

    triangles: as for overlap; one with a NaN or an infinity sets no cell.
    window: ((i, j, k), (ni, nj, nk)) for the ni x nj x nk cells from cell (i, j, k) on alone, with the same exact answers as for
        the whole: for tasks, and for grids of any size, as only the bits of the window take memory, 16 GiB at most.
    layers: (first, count) for these layers along z alone.
    fill: "outside" sets every cell, too, that cannot be reached from outside the grid through faces of cells that are clear;
        "parity" those from whose middle a ray along x crosses the triangles an odd number of times, which holes of a mesh do not
        empty, and warns (OpenMeshWarning) where the mesh is certainly not closed. For whole grids.
    threads: how many may share the work, where that gains time: with many triangles, or with many cells and few triangles; never
        more than there are processors. None for one on each processor. The answers do not depend on it.
    into: Voxels of the same grid and window, to which the cells are added, and which are returned.
    accuracy, axes, kernel: as for overlap.

    Raises errors as overlap does: also for a grid whose planes float64 cannot tell apart, and for one that needs more than 16 GiB.
    """
    held_, options, threads, fill_call = held(triangles), options_of(accuracy, axes, 0, kernel), threads_of(threads), fill_of(fill)
    chosen = grid_given(held_, grid, cell, resolution)
    if fill_call and (window is not None or layers is not None):
        raise InputError("fill needs the whole grid: what is outside a part of it may be inside the whole")
    wanted = window_wanted(window, layers, chosen)
    if into is not None:
        check_into(into, chosen, wanted)
    words = new_cells(wanted[1][::-1], chosen) if into is None or fill_call else into._words
    struct = struct_of(chosen)
    check_answer(held_, set_cells_at_once(held_, struct, wanted[0], wanted[1], options, words, threads))
    if fill_call:
        words = filled(fill_call, held_, struct, words)
    return Voxels(words, chosen, wanted) if into is None else into._add(words)
