"""Cells of grids beyond memory: bricks of 8 x 8 x 8 cells, of which there are some wherever a surface is."""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass, replace
from functools import reduce
from typing import Optional, SupportsIndex, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from ._arguments import options_of, range_of
from ._errors import Brief, InputError, path_of
from ._files import save_bricks
from ._grids import Grid, grid_given
from ._loading import load_bricks
from ._masks import BYTE, WORD, bools, row_words
from ._overlap import ALL
from ._threads import in_threads, threads_of
from ._tiles import (NUMBER, Listed, Tiling, Workshop, bits_of_bricks, brick_ids, cells_of_ids, set_padded_tile, set_with_ids,
                     side_of)
from ._triangles import COUNT_MAX, check_count, held
from ._typing import Accuracy, Cell, GridLike, Range, TrianglesLike
from ._voxelize import new_cells
from ._voxels import Voxels, fixed, middles

BATCH_BYTES, BATCH_MAX = 1 << 20, 1 << 10  # of tiles that are cut into bricks at once


@dataclass(frozen=True, eq=False)
class Bricks(metaclass=Brief):
    """Bricks of 8 x 8 x 8 cells, without the empty ones. Brick n has the cells 8 * at[n] + (i, j, k), for i, j, k = 0 .. 7.

    at: uint32 of shape (n, 3): x, y, z. bits: uint64 of shape (n, 8): bit i + 8 * j of bits[n, k] is that cell. grid: the Grid.
    shift: what was subtracted from the mesh, if the bricks come from a file that says so. shard: (I, N) if the file is only
    part I of N; else None. ids: if they were wanted, or a file has them, uint32: for each set cell the lowest number of a
    triangle that overlaps it, in the order of cells(); else None. inside: if cells have labels, which of bits are inside, in the
    same shape; else None. colors: if a file has them, uint8 of shape (m, 3), in the order of cells(); else None.
    """

    at: NDArray[np.uint32]
    bits: NDArray[np.uint64]
    grid: Grid
    shift: Tuple[float, float, float] = (0.0, 0.0, 0.0)
    shard: Optional[Tuple[int, int]] = None
    ids: Optional[NDArray[np.uint32]] = None
    inside: Optional[NDArray[np.uint64]] = None
    colors: Optional[NDArray[np.uint8]] = None

    def __repr__(self) -> str:
        part = f", shard {self.shard[0]} of {self.shard[1]}" if self.shard else ""
        return f"<tribox.Bricks: {len(self.at)} bricks that are not empty, of a grid of {self.grid.sides()}{part}>"

    @staticmethod
    def load(path: Union[str, "os.PathLike[str]"]) -> Bricks:
        """Reads a .npz file of bricks. It may be a part that tribox voxelize --shard I/N wrote; shard says so.

        Raises InputError for a file that does not hold bricks or is damaged. `tribox merge` makes one file of all parts.
        """
        return Bricks(*load_bricks(path))

    def voxels(self) -> Voxels:
        """All cells of the grid, clear or set, as Voxels with ids, labels or colors. InputError for a part, or over 16 GiB."""
        if self.shard:
            raise InputError(f"these Bricks are shard {self.shard[0]} of {self.shard[1]}; tribox merge makes one file of all")
        shape = self.grid.size[::-1]
        voxels = Voxels(dense(self.at, self.bits, shape, self.grid), self.grid)
        if self.ids is not None or self.colors is not None:
            order = np.lexsort(self.cells().T)
            voxels._ids = None if self.ids is None else fixed(self.ids[order])
            voxels._colors = None if self.colors is None else fixed(self.colors[order])
        return voxels if self.inside is None else voxels._with_inside(dense(self.at, self.inside, shape, self.grid))

    def cells(self) -> NDArray[np.int64]:
        """The set cells, (i, j, k) each: an array of int64 of shape (m, 3), in the order of the bricks."""
        brick, k, j, i = np.nonzero(bits_of_bricks(self.bits))
        return 8 * self.at[brick].astype(np.int64) + np.stack([i, j, k], 1)

    def points(self) -> NDArray[np.float64]:
        """The middles of the cells that are set: an array of float64 of shape (m, 3), in the order of cells()."""
        return middles(self.grid, self.cells())

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes a file of any format that Voxels.save writes, by the ending of its name; for a part, only .npz.

        Formats that hold all cells, such as .npy, take memory for these.
        """
        save_bricks(self, path_of(path))


def joined(bricks, grid):
    """Bricks, pairs of at and bits, of several parts as one."""
    none = np.empty((0, 3), NUMBER), np.empty((0, 8), WORD)
    return Bricks(*map(np.concatenate, zip(none, *bricks)), grid)


def cut(words, corners):
    """The bricks of whole tiles. words: of shape (tiles, nz, ny, row words). corners: the bricks' places at those of the tiles."""
    tiles, nz, ny, row_words = words.shape
    words = little(words)
    rows = np.bitwise_or.reduce(words.reshape(tiles, nz // 8, 8, ny, row_words), 2).reshape(tiles, nz // 8, ny // 8, 8, row_words)
    is_any = reduce(np.bitwise_or, (rows[..., j, :] for j in range(8))).view(BYTE)
    tile, k, j, i = np.nonzero(is_any)
    at = corners[tile] + np.stack([i, j, k], 1)
    return at.astype(NUMBER), bits_at(words, tile, i, j, k)


def dense(at, bits, shape, grid):
    """The words of all cells of such a grid."""
    nz, ny, nx = (-(-size // 8) * 8 for size in shape)
    words, are_clear = new_cells((nz, ny, nx), grid)
    if not are_clear:
        words[...] = 0
    i, j, k = at.T
    octets = words.view(BYTE).reshape(nz // 8, 8, ny // 8, 8, 8 * row_words(nx))
    octets[k, :, j, :, i] = little(bits).view(BYTE).reshape(-1, 8, 8)
    return np.ascontiguousarray(little(words)[:shape[0], :shape[1], :row_words(shape[2])])


def bits_at(words, tile, i, j, k):
    """Of bricks in tiles, whose words are little-endian."""
    tiles, nz, ny, row_words = words.shape
    octets = words.view(BYTE).reshape(tiles, nz // 8, 8, ny // 8, 8, 8 * row_words)
    bits = octets[tile, k, :, j, :, i].view(WORD)[..., 0]
    return little(bits)


def bricks_in(voxels):
    """The bricks of all cells of a grid or a window, in the order of z, y and x."""
    first, size = voxels.window
    low = tuple(f // 8 * 8 for f in first)
    voxels = voxels._within(low, tuple(f + s - l for f, s, l in zip(first, size, low)))
    parts, of_cells, insides, start = [], [], [], 0
    numbers = voxels._ids if voxels._colors is None else numbers_of(voxels._colors)  # which come into the order of bricks
    for k in range(0, voxels.shape[0], 8):
        layers = voxels.words[k:k + 8]
        at, bits = cut(padded(layers), np.zeros((1, 3), np.int64))
        parts.append((at + np.array([low[0] // 8, low[1] // 8, (low[2] + k) // 8], NUMBER), bits))
        if numbers is not None:
            in_cells = cells_of_ids(numbers[start:], bools(layers, voxels.shape[2]))
            of_cells.append(brick_ids(in_cells, at, bits))
            start += len(of_cells[-1])
        if voxels._inside is not None:
            i, j, _ = at.T
            insides.append(bits_at(little(padded(voxels._inside[k:k + 8])), 0 * i, i, j, 0 * i))
    found = np.concatenate([np.empty(0, NUMBER), *of_cells])
    return replace(joined(parts, voxels.grid), ids=None if voxels._ids is None else found,
                   colors=None if voxels._colors is None else found.view(BYTE).reshape(-1, 4)[:, :3],
                   inside=None if voxels._inside is None else np.concatenate([np.empty((0, 8), WORD), *insides]))


def numbers_of(colors):
    """One of each colour, whose first three bytes it is."""
    return np.pad(colors, ((0, 0), (0, 1))).view(NUMBER)[:, 0]


def padded(layers):
    """Eight layers at most as a tile of whole bricks."""
    tile = np.zeros((1, 8, -(-layers.shape[1] // 8) * 8, layers.shape[2]), WORD)
    tile[0, :len(layers), :layers.shape[1]] = layers
    return tile


def little(words):
    """In little-endian order."""
    return words.byteswap() if sys.byteorder == "big" else words


def bricks_of(lists, tiling, options, threads):
    """The bricks of the tiles that have triangles. """
    nx, ny, nz = (-(-size // 8) * 8 for size in np.minimum(tiling.side, tiling.size).tolist())
    shape = nz, ny, row_words(nx)
    most = max(1, min(BATCH_MAX, BATCH_BYTES // (8 * shape[0] * shape[1] * shape[2])))
    first, size = tiling.windows(lists.numbers)

    workshop = Workshop((min(most, len(lists.numbers)), *shape))

    def work(start):
        end = min(start + most, len(lists.numbers))
        words = workshop.words[:end - start]
        words.fill(0)
        for n in range(start, end):
            triangles, window = lists.of(lists.places[n]), (first[n].tolist(), size[n].tolist())
            set_padded_tile(triangles, tiling.struct, *window, options, words[n - start])
        return cut(words, first[start:end] // 8)

    return joined(in_threads(threads, work, range(0, len(lists.numbers), most)), tiling.grid)


def bricks_with_ids(listed, tiling, options, threads):
    """The same tile by tile, with the ids of their cells."""
    first, size = tiling.windows(listed.numbers)

    def work(n):
        window, place = (first[n].tolist(), size[n].tolist()), listed.places[n]
        nx, ny, nz = window[1]
        words = np.zeros((-(-nz // 8) * 8, -(-ny // 8) * 8, row_words(nx)), WORD)
        own = words if words.shape[:2] == (nz, ny) else np.zeros((nz, ny, row_words(nx)), WORD)
        ids = set_with_ids(listed.of(place), tiling.struct, *window, options, own)
        words[:nz, :ny] = own
        at, bits = cut(words[None], np.zeros((1, 3), np.int64))
        return (at + first[n] // 8).astype(NUMBER), bits, listed.ids(place)[brick_ids(ids, at, bits)]

    parts = in_threads(threads, work, range(len(listed.numbers)))
    whole = joined([part[:2] for part in parts], tiling.grid)
    return replace(whole, ids=np.concatenate([np.empty(0, NUMBER), *(part[2] for part in parts)]))


def bricks(triangles: TrianglesLike, grid: Optional[GridLike] = None, *, cell: Optional[Cell] = None,
           resolution: Optional[SupportsIndex] = None, side: SupportsIndex = 128, tiles: Optional[Range] = None,
           threads: Optional[SupportsIndex] = 1, accuracy: Accuracy = "exact", axes: int = ALL,
           kernel: Optional[str] = None, ids: bool = False) -> Bricks:
    """voxelize for grids whose cells need not fit into memory: Bricks, at and bits, of the cells that any triangle overlaps.

    triangles, grid, cell, resolution, threads, accuracy, axes, kernel: as for voxelize.
    side: of a tile, in cells, a multiple of 8; tiles are cubes of cells, done one at a time. Only the order of bricks depends on
        it: by the number of their tile, then by z, y and x.
    tiles: (first, count) for only these of the tile_count(grid.size, side) tiles: the share of a task or a machine.
    ids: True for Bricks with ids: for each set cell the lowest number of a triangle that overlaps it, as in voxelize.

    Raises errors as voxelize does. Bricks take 76 bytes each; a surface has 64 to 69 cells in each, however fine the grid.
    """
    held_, options, threads_ = held(triangles), options_of(accuracy, axes, 0, kernel), threads_of(threads)
    listing = options_of("exact", axes, 0, kernel)  # cells that are not exact depend on which tiles are asked
    tiling = Tiling(grid_given(held_, grid, cell, resolution), side_of(side))
    first, count = range_of("tiles", tiles, tiling.count, "tiles")
    if ids:
        check_count(held_, "ids", COUNT_MAX - 1)
    listed = Listed(held_, tiling, first, count, listing, threads_)
    return (bricks_with_ids if ids else bricks_of)(listed, tiling, options, threads_)
