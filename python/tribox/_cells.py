"""All triangles of each cell that has any: of grids of any size, as only those cells take memory."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import Optional, SupportsIndex

import numpy as np
from numpy.typing import NDArray

from . import _c
from ._arguments import check, options_of
from ._errors import Brief, InputError
from ._ffi import ffi
from ._grids import Grid, grid_given, struct_of
from ._library import lib
from ._overlap import ALL, overlap
from ._threads import in_threads, threads_of
from ._tiles import NUMBER, NUMBERS, SIZE, SIZES, Listed, Tiling
from ._triangles import Mesh, by_number, held
from ._typing import Accuracy, Cell, GridLike, TrianglesLike
from ._voxels import middles

SIDE = 32  # cells of a window along each axis, at most: its starts fit into a cache
TILES_MAX = 1 << 22  # that triangles are listed by at once
NUMBERS_MAX, BLOCK = 1 << 32, 1 << 18  # of triangles in the answer at most; that are measured at once


@dataclass(frozen=True, eq=False)
class CellLists(metaclass=Brief):
    """The cells that any triangle overlaps, and for each cell all triangles that do.

    cells: (i, j, k) of each, uint32 of shape (m, 3). triangles: triangle numbers, uint32: cell n has
    triangles[start[n]:start[n + 1]], one or more, in rising order. start: m + 1 places, intp. grid: the Grid.

    triangles[start[:-1]] has the lowest triangle number of each cell, np.diff(start) how many triangles each cell has, and
    np.repeat(np.arange(len(cells)), np.diff(start)) the cell of each entry of triangles.
    """

    cells: NDArray[np.uint32]
    start: NDArray[np.intp]
    triangles: NDArray[np.uint32]
    grid: Grid

    def __repr__(self) -> str:
        return f"<tribox.CellLists: {len(self.triangles)} triangles in {len(self.cells)} cells, of a grid of {self.grid.sides()}>"

    def points(self) -> NDArray[np.float64]:
        """The middles of the cells: an array of float64 of shape (m, 3)."""
        return middles(self.grid, self.cells)


def halves(first, size):
    """Windows that together are one, cut in two along each axis that is longer than a tile."""
    lows = [(0, count) if count <= SIDE else (0, count // 2, count) for count in size]
    for k, j, i in product(*(zip(ends, ends[1:]) for ends in reversed(lows))):
        yield tuple(f + low for f, (low, _) in zip(first, (i, j, k))), tuple(high - low for low, high in (i, j, k))


class Lister:
    """What lists the cells of windows: the grid, and how triangles are asked."""

    def __init__(self, grid, accuracy, axes, kernel):
        self.grid, self.struct, self.options = grid, struct_of(grid), options_of(accuracy, axes, 0, kernel)
        self.asked = dict(axes=axes, kernel=kernel)

    def lists(self, held_, ids, first, size):
        """Parts of the answer, (cells, counts, triangles) each. ids: the numbers of the triangles, which overlap the window."""
        if max(size) <= SIDE:
            return [self.of_window(held_, ids, first, size)]
        parts = []
        for low, sides in halves(first, size):
            last = [f + count - 1 for f, count in zip(low, sides)]
            inside = np.flatnonzero(overlap(held_, self.grid.box(*low)[0], self.grid.box(*last)[1], **self.asked))
            if len(inside):
                parts += self.lists(Mesh(by_number(held_, inside)), ids[inside], low, sides)
        return parts

    def of_window(self, held_, ids, first, size):
        starts = np.empty(size[0] * size[1] * size[2] + 1, SIZE)
        given = held_, self.struct, ffi.new("tribox_window *", (first, size)), self.options, ffi.from_buffer(SIZES, starts)
        check(_c.cell_lists(*given, ffi.NULL))
        numbers = np.empty(starts[-1], NUMBER)
        check(_c.cell_lists(*given, ffi.from_buffer(NUMBERS, numbers)))
        counts = np.diff(starts.view(np.intp))
        places = np.flatnonzero(counts)
        row, i = np.divmod(places, max(1, size[0]))
        k, j = np.divmod(row, max(1, size[1]))
        return (np.stack([i, j, k], 1) + first).astype(NUMBER), counts[places], ids[numbers]


def in_order(cells, counts, triangles):
    """The same by k, then j, then i; and where each cell's triangles begin."""
    order = np.lexsort(cells.T)
    begins = (np.cumsum(counts) - counts)[order]
    start = np.zeros(len(order) + 1, np.intp)
    np.cumsum(counts[order], out=start[1:])
    places = np.repeat(begins - start[:-1], counts[order]) + np.arange(start[-1])
    return cells[order], start, triangles[places]


def check_size(held_, grid):
    """Refuses an answer that no memory holds. A triangle within the grid is in no fewer cells than its shadow has squares."""
    low, least = np.array(grid.origin), 0.0
    high = low + np.multiply(grid.cell, grid.size)
    for first in range(0, held_.struct.count, BLOCK):
        corners = by_number(held_, slice(first, first + BLOCK)).astype(float)
        corners = corners[((corners >= low) & (corners <= high)).all((1, 2))] / grid.cell
        shadows = np.abs(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])).max(1, initial=0) / 2
        least += shadows.sum()
    if least > NUMBERS_MAX:
        raise InputError(f"the answer would have at least {least:.3g} numbers of triangles, "
                         f"and can have {NUMBERS_MAX:.3g} at most; "
                         "give larger cells, or a grid around a part of the mesh")


def side_for(size):
    """Of the tiles that triangles are listed by first, so that there are not too many."""
    side = SIDE
    while lib.tribox_tile_count(size, side) > TILES_MAX:
        side *= 2
    return side


def cell_lists(triangles: TrianglesLike, grid: Optional[GridLike] = None, *, cell: Optional[Cell] = None,
               resolution: Optional[SupportsIndex] = None, threads: Optional[SupportsIndex] = 1, accuracy: Accuracy = "exact",
               axes: int = ALL, kernel: Optional[str] = None) -> CellLists:
    """Tells which triangles overlap which cell: CellLists, all triangles of each cell that has any.

    triangles, grid, cell, resolution, threads, accuracy, axes, kernel: as for voxelize. At "exact" the cells are those that
        voxelize sets, in the order of Voxels.cells(). At "fast" they are as at "conservative".

    The grid may be of any size. The answer takes 28 bytes for each cell and 4 for each of its triangles; the call takes about as
    much again, and 5 MB for each thread.

    Raises errors as voxelize does; also if the answer would have more than 2^32 numbers of triangles.
    """
    held_, threads_ = held(triangles), threads_of(threads)
    chosen = grid_given(held_, grid, cell, resolution)
    lister, tiling = Lister(chosen, accuracy, axes, kernel), Tiling(chosen, side_for(chosen.size))
    lists = Listed(held_, tiling, 0, tiling.count, options_of("exact", axes, 0, kernel), threads_)
    if len(lists.list) * tiling.side ** 2 > NUMBERS_MAX:  # as many as check_size can count at most
        check_size(held_, chosen)
    firsts, sizes = tiling.windows(lists.numbers)

    def work(n):
        place = lists.places[n]
        return lister.lists(lists.of(place), lists.ids(place), tuple(firsts[n].tolist()), tuple(sizes[n].tolist()))

    none = np.empty((0, 3), NUMBER), np.empty(0, np.intp), np.empty(0, NUMBER)
    parts = [part for parts in in_threads(threads_, work, range(len(lists.numbers))) for part in parts]
    cells, start, numbers = in_order(*map(np.concatenate, zip(none, *parts)))
    return CellLists(cells, start, numbers, chosen)
