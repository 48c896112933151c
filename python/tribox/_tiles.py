"""Cubes of cells, the unit of work on grids beyond memory: their places, and the triangles of each."""

import threading
from operator import index
from typing import SupportsIndex

import numpy as np

from ._arguments import check
from ._errors import InputError, check_indices, shown
from ._ffi import ffi
from ._grids import is_single
from ._library import lib
from ._masks import WORD, pointer_to
from ._numbers import FLOAT
from ._triangles import Soup, array_held, mesh_held
from ._typing import Cells

TILE_MAX = 1024
SIZE, NUMBER = np.dtype(np.uintp), np.dtype(np.uint32)
SIZES, NUMBERS = ffi.typeof("size_t[]"), ffi.typeof("uint32_t[]")


def tile_of(tile):
    try:
        cells = index(tile)
    except TypeError:
        cells = 0
    if cells % 8 or not 8 <= cells <= TILE_MAX:
        raise InputError(f"tile = {shown(tile)}; give how many cells the side of a tile has, a multiple of 8 up to {TILE_MAX}")
    return cells


def tile_count(size: Cells, tile: SupportsIndex = 128) -> int:
    """The number of tiles of a grid of (nx, ny, nz) cells: tile (i, j, k) is number (k * nj + j) * ni + i of ni x nj x nk."""
    try:
        sizes = ffi.new("uint32_t[3]", tuple(map(index, size)))
        _, _, _ = size
    except (IndexError, OverflowError, TypeError, ValueError):
        raise InputError(f"size = {shown(size)}; give three numbers of cells, x, y, z, each less than 2^32") from None
    return int(lib.tribox_tiles(sizes, tile_of(tile)))


def range_of(tiles, count):
    """(first, end) of the tiles that are wanted, all by default."""
    try:
        first, end = (0, count) if tiles is None else map(index, tiles)
    except (TypeError, ValueError):
        first, end = -1, 0
    if not 0 <= first <= end <= count:
        raise InputError(f"tiles = {shown(tiles)}; give (first, end), the numbers of tiles, within the {count} tiles")
    return first, end


class Tiling:
    """A grid cut into tiles."""

    def __init__(self, grid, tile):
        self.grid, self.tile, self.size = grid, tile, np.array(tuple(grid.size), np.int64)
        self.along = -(-self.size // tile)
        self.count = lib.tribox_tiles(tuple(grid.size), tile)

    def windows(self, numbers):
        """(first, size) of tiles with these numbers: arrays of shape (n, 3)."""
        ni, nj, _ = self.along
        first = np.stack([numbers % ni, numbers // ni % nj, numbers // (ni * nj)], 1) * self.tile
        return first, np.minimum(self.tile, self.size - first)


    def window(self, number):
        """The same of one tile, as tuples."""
        ni, nj, _ = self.along.tolist()
        first = tuple(at * self.tile for at in (number % ni, number // ni % nj, number // (ni * nj)))
        return first, tuple(min(self.tile, size - at) for size, at in zip(self.grid.size, first))


class Listed:
    """Triangles by tile, as lists of their numbers: those of tiles first .. end - 1 of a tiling."""

    def __init__(self, held_, tiling, first, end, options):
        grid, ending = tiling.grid, "" if is_single(tiling.grid) else "_f64"
        check_indices(held_)
        self.held = (held_ if held_.is_soup else Soup.of(held_)) if is_single(grid) else mesh_held(held_)
        self.starts = np.empty(end - first + 1, SIZE)
        starts = ffi.from_buffer(SIZES, self.starts)
        call = self.held.struct, grid, tiling.tile, first, end, options, starts
        check(getattr(lib, "tribox_tiles_count" + ending)(*call))
        self.list = np.empty(self.starts[-1], NUMBER)
        check(getattr(lib, "tribox_tiles_fill" + ending)(*call, ffi.from_buffer(NUMBERS, self.list)))
        self.places = np.flatnonzero(np.diff(self.starts))  # of tiles that have triangles
        self.numbers = self.places + first

        self.most = int(np.diff(self.starts).max(initial=0))  # triangles of a tile

    def of(self, place, room):
        """The triangles of a tile, as a struct in the room or as something that is held."""
        start, end = self.starts[place:place + 2].tolist()
        triangles = self.list[start:end]
        if not self.held.is_soup:
            return array_held(self.held.vertices[triangles if self.held.faces is None else self.held.faces[triangles]])
        to = room.struct
        to.count = end - start
        check(lib.tribox_soup_gather(self.held.struct, ffi.from_buffer(NUMBERS, triangles), 0, to.count, to.x, to.y, to.z))
        return room


class Room:
    """Memory for the triangles of a tile as nine streams."""

    def __init__(self, most):
        self.numbers = np.empty(9 * most, FLOAT)
        start = ffi.from_buffer("float[]", self.numbers)
        streams = [[start + (3 * axis + vertex) * most for vertex in range(3)] for axis in range(3)]
        self.struct = ffi.new("tribox_soup *", (*streams, 0))


class Workshop(threading.local):
    """What each thread needs for its tiles."""

    def __init__(self, most, shape):
        self.room, self.words = Room(most), np.empty(shape, WORD)


def set_tile(held_, grid, first, size, options, words):
    """Sets the cells of a tile that these, its triangles, overlap."""
    if is_single(grid):
        check(lib.tribox_voxelize_window(held_.struct, grid, first, size, options, pointer_to(words), ffi.NULL))
    else:
        check(lib.tribox_voxelize_f64(held_.struct, grid, first, size, options, pointer_to(words), ffi.NULL))


def set_padded_tile(held_, grid, first, size, options, padded):
    """The same for words of the largest tile, of which this one may have a part only."""
    words = (size[0] + 63) >> 6
    if padded.shape == (size[2], size[1], words):
        set_tile(held_, grid, first, size, options, padded)
        return
    own = np.zeros((size[2], size[1], words), WORD)
    set_tile(held_, grid, first, size, options, own)
    padded[:size[2], :size[1], :words] = own
