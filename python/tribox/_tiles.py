"""Cubes of cells, the unit of work on grids beyond memory: their places, their triangles, and the lowest in each cell."""

from __future__ import annotations

import threading
from typing import SupportsIndex

import numpy as np

from . import _c
from ._arguments import check, whole, wholes
from ._errors import InputError, check_indices, shown
from ._ffi import ffi
from ._grids import SIZE_MAX, struct_of
from ._library import lib
from ._masks import BYTE, MASK_WORDS_MAX, WORD, bools, mask_indices, pointer_to, row_words
from ._overlap import check_answer
from ._threads import cut, in_threads
from ._triangles import Mesh, by_number, check_count
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
        check_count(held_, "lists of tiles")
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


AT_ONCE = 1 << 23  # cells, of four bytes each: more layers are taken in turn


def set_with_ids(held_, grid, first, size, options, words, room=None):
    """Sets the cells of a window, whose words are clear. Returns the ids of all its cells: any numbers of those that stay clear."""
    nx, ny, nz = size
    ids = np.empty((nz, ny, nx), NUMBER) if room is None else room[:nx * ny * nz].reshape(nz, ny, nx)
    window = ffi.new("tribox_window *", (first, size))
    check(_c.voxelize_ids(held_, 0, grid, window, options, pointer_to(words), ffi.from_buffer(NUMBERS, ids), ffi.NULL))
    return ids


class Room(threading.local):
    """Ids of as many cells, for each thread: new memory would take longer than they do."""

    def __init__(self, cells):
        self.ids = np.empty(cells, NUMBER)


def set_ones(ids, words):
    """The ids of the cells that are set."""
    found, across = mask_indices(words), 64 * words.shape[2]
    gap = across - ids.shape[2]
    return ids.reshape(-1)[found - found // NUMBER.type(across) * NUMBER.type(gap) if gap else found]


def window_ids(task, threads):
    """Sets the cells of a Task. Returns the ids of those that are set, in the order of k, j, i."""
    check_indices(task.held)
    nx, ny, nz = task.size
    if not task.words.size:
        return np.empty(0, NUMBER)

    slabs = cut(nz, max(threads, -(-nx * ny * nz // AT_ONCE)))
    room = Room(nx * ny * max(high - low for low, high in slabs))

    def work(slab):
        low, high = slab
        own = task.words[low:high]
        own.fill(0)
        first, size = (*task.first[:2], task.first[2] + low), (nx, ny, high - low)
        ids = set_with_ids(task.held, task.grid, first, size, task.options, own, room.ids)
        return set_ones(ids, own) if own.size <= MASK_WORDS_MAX else ids[bools(own, nx)]

    return np.concatenate(in_threads(threads, work, slabs))


def brick_ids(ids, at, bits):
    """Those of the cells of the bricks that a tile was cut into, in their order. at: of the bricks, counted from the first."""
    nx, ny, nz = (-(-size // 8) for size in ids.shape[::-1])
    padded = np.zeros((8 * nz, 8 * ny, 8 * nx), NUMBER)
    padded[:ids.shape[0], :ids.shape[1], :ids.shape[2]] = ids
    i, j, k = at.T
    found = padded.reshape(nz, 8, ny, 8, nx, 8)[k, :, j, :, i, :]
    return found[bits_of_bricks(bits)]


def cells_of_ids(ids, are_set):
    """An array of a number for each cell, of those that are set the next of ids."""
    cells = np.zeros(are_set.shape, NUMBER)
    cells[are_set] = ids[:np.count_nonzero(are_set)]
    return cells


def bits_of_bricks(bits):
    """An array of bool of shape (n, 8, 8, 8): brick, k, j, i."""
    octets = bits.astype("<u8", copy=False).view(BYTE).reshape(-1, 8, 8, 1)
    return np.unpackbits(octets, -1, bitorder="little").view(bool)
