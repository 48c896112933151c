"""Cubes of cells, the unit of work on grids beyond memory: their places, and the triangles of each."""

from __future__ import annotations

import threading
from typing import SupportsIndex

import numpy as np

from . import _c
from ._arguments import check, whole, wholes
from ._errors import InputError, shown
from ._ffi import ffi
from ._grids import SIZE_MAX, struct_of
from ._library import lib
from ._masks import WORD, pointer_to, row_words
from ._overlap import check_answer
from ._threads import cut, in_threads
from ._triangles import Mesh, by_number
from ._typing import Cells

SIDE_MAX = 1024
SIZE, NUMBER = np.dtype(np.uintp), np.dtype(np.uint32)
PARTS_EACH, LISTED_ALONE = 16, 1 << 17  # of each thread; so few triangles that one thread lists them sooner
SIZES, NUMBERS = ffi.typeof("size_t[]"), ffi.typeof("uint32_t[]")


def side_of(side):
    cells = whole(side, 8, SIDE_MAX)
    if cells is None or cells % 8:
        raise InputError(f"side = {shown(side)}; give how many cells the side of a tile has, a multiple of 8 up to {SIDE_MAX}")
    return cells


def tile_count(size: Cells, side: SupportsIndex = 128) -> int:
    """The number of tiles of a grid of (nx, ny, nz) cells: tile (i, j, k) is number (k * nj + j) * ni + i of ni x nj x nk."""
    sizes = wholes(size, 0, SIZE_MAX)
    if not sizes:
        raise InputError(f"size = {shown(size)}; give three numbers of cells, x, y, z, each less than 2^32")
    return int(lib.tribox_tile_count(sizes, side_of(side)))


class Tiling:
    """A grid cut into tiles."""

    def __init__(self, grid, side):
        self.grid, self.struct, self.side, self.size = grid, struct_of(grid), side, np.array(grid.size, np.int64)
        self.along = -(-self.size // side)
        self.count = int(lib.tribox_tile_count(grid.size, side))

    def windows(self, numbers):
        """(first, size) of tiles with these numbers: arrays of shape (n, 3)."""
        ni, nj, _ = self.along
        first = np.stack([numbers % ni, numbers // ni % nj, numbers // (ni * nj)], 1) * self.side
        return first, np.minimum(self.side, self.size - first)


class Listed:
    """Triangles by tile, as lists of their numbers: those of `count` tiles of a tiling, from the first on."""

    def __init__(self, held_, tiling, first, count, options, threads=1):
        tiles = ffi.new("tribox_tiles *", (tiling.side, first, count))
        few = threads < 2 or len(held_) <= LISTED_ALONE
        parts = cut(len(held_), 1 if few else max(1, min(PARTS_EACH * threads, len(held_) // max(count, 1)))) or [(0, 0)]
        places = np.empty((len(parts), count), SIZE)  # by part and tile: how many, and then where

        def list_part(number, to):
            low, high = parts[number]
            return _c.tile_lists_part(held_, low, high - low, tiling.struct, tiles, options,
                                      ffi.from_buffer(SIZES, places[number]), to)

        def list_all(to):
            check_answer(held_, max(in_threads(threads, lambda number: list_part(number, to), range(len(parts)))))

        list_all(ffi.NULL)
        by_tile = places.T.ravel()  # in each tile the parts follow each other
        ends = np.cumsum(by_tile, dtype=SIZE)
        places[:] = (ends - by_tile).reshape(count, len(parts)).T
        self.held, self.starts = held_, np.append(places[0], ends[-1:] if count else SIZE.type(0)).astype(SIZE)
        self.list = np.empty(self.starts[-1], NUMBER)
        list_all(ffi.from_buffer(NUMBERS, self.list))
        self.places = np.flatnonzero(np.diff(self.starts))  # of tiles that have triangles
        self.numbers = self.places + first

    def of(self, place):
        """The triangles of a tile."""
        return Mesh(by_number(self.held, self.ids(place)))

    def ids(self, place):
        """Their numbers, in rising order."""
        start, end = self.starts[place:place + 2].tolist()
        return self.list[start:end]


class Workshop(threading.local):
    """The cells of some tiles, for each thread."""

    def __init__(self, shape):
        self.words = np.empty(shape, WORD)


def set_tile(held_, grid, first, size, options, words):
    """Sets the cells of a tile that these, its triangles, overlap."""
    check(_c.voxelize(held_, grid, ffi.new("tribox_window *", (first, size)), options, pointer_to(words), ffi.NULL))


def set_padded_tile(held_, grid, first, size, options, padded):
    """The same for words of the largest tile, of which this one may have a part only."""
    own = padded
    if padded.shape != (size[2], size[1], row_words(size[0])):
        own = np.zeros((size[2], size[1], row_words(size[0])), WORD)
    set_tile(held_, grid, first, size, options, own)
    if own is not padded:
        padded[:size[2], :size[1], :own.shape[2]] = own
