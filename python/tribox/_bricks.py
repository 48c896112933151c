"""Cells of grids beyond memory: bricks of 8 x 8 x 8 cells, of which there are some wherever a surface is."""

import sys
from functools import reduce
from typing import NamedTuple, Optional, SupportsIndex

import numpy as np
from numpy.typing import NDArray

from ._arguments import options_of
from ._grids import check_grid, grid_for
from ._masks import BYTE, WORD
from ._overlap import ALL
from ._threads import in_threads, threads_of
from ._tiles import NUMBER, Listed, Tiling, Workshop, range_of, set_padded_tile, tile_of
from ._triangles import held
from ._typing import Accuracy, Cell, Cells, Range, TrianglesLike, Vector

BATCH_BYTES, BATCH_MAX = 1 << 20, 1 << 10  # of tiles that are cut into bricks at once


class Bricks(NamedTuple):
    """Bricks of 8 x 8 x 8 cells, those that are not empty. Brick n has the cells 8 * at[n] + (i, j, k), for i, j, k = 0 .. 7.

    at: uint32 of shape (n, 3): x, y, z. bits: uint64 of shape (n, 8): bit i + 8 * j of bits[n, k] is that cell.

    numpy.savez(file, **bricks._asdict()) writes what the program tribox writes, but for the grid.
    """

    at: NDArray[np.uint32]
    bits: NDArray[np.uint64]

    def cells(self) -> NDArray[np.int64]:
        """The cells that are set, (i, j, k) each: an array of int64 of shape (m, 3), in the order of the bricks."""
        octets = (self.bits.byteswap() if sys.byteorder == "big" else self.bits).view(BYTE).reshape(-1, 8, 8, 1)
        brick, k, j, i = np.nonzero(np.unpackbits(octets, -1, bitorder="little"))
        return 8 * self.at[brick].astype(np.int64) + np.stack([i, j, k], 1)


def no_bricks():
    return Bricks(np.empty((0, 3), NUMBER), np.empty((0, 8), WORD))


def joined(bricks):
    """Bricks of several parts as one."""
    bricks = [part for part in bricks if len(part.at)]
    return Bricks(*map(np.concatenate, zip(*bricks))) if bricks else no_bricks()


def cut(words, corners):
    """The bricks of whole tiles. words: of shape (tiles, nz, ny, row words). corners: the bricks' places at those of the tiles."""
    tiles, nz, ny, row_words = words.shape
    if sys.byteorder == "big":
        words = words.byteswap()
    rows = np.bitwise_or.reduce(words.reshape(tiles, nz // 8, 8, ny, row_words), 2).reshape(tiles, nz // 8, ny // 8, 8, row_words)
    is_any = reduce(np.bitwise_or, (rows[..., j, :] for j in range(8))).view(BYTE)
    tile, k, j, i = np.nonzero(is_any)
    octets = words.view(BYTE).reshape(tiles, nz // 8, 8, ny // 8, 8, 8 * row_words)
    bits = octets[tile, k, :, j, :, i].view(WORD)[..., 0]
    at = corners[tile] + np.stack([i, j, k], 1)
    return Bricks(at.astype(NUMBER), bits.byteswap() if sys.byteorder == "big" else bits)


def bricks_of(lists, tiling, options, threads):
    """The bricks of the tiles that have triangles. lists: a Listed, or what has its numbers, places and of()."""
    nx, ny, nz = (-(-size // 8) * 8 for size in np.minimum(tiling.tile, tiling.size).tolist())
    shape = nz, ny, (nx + 63) >> 6
    most = max(1, min(BATCH_MAX, BATCH_BYTES // (8 * shape[0] * shape[1] * shape[2])))
    first, size = tiling.windows(lists.numbers)

    workshop = Workshop(lists.most, (min(most, len(lists.numbers)), *shape))

    def work(start):
        end = min(start + most, len(lists.numbers))
        words = workshop.words[:end - start]
        words.fill(0)
        for n in range(start, end):
            triangles = lists.of(lists.places[n], workshop.room)
            set_padded_tile(triangles, tiling.grid, first[n].tolist(), size[n].tolist(), options, words[n - start])
        return cut(words, first[start:end] // 8)

    return joined(in_threads(threads, work, range(0, len(lists.numbers), most)))


def bricks(triangles: TrianglesLike, origin: Vector, cell: Cell, size: Cells, *, tile: SupportsIndex = 128,
           tiles: Optional[Range] = None, threads: Optional[SupportsIndex] = 1, accuracy: Accuracy = "exact", axes: int = ALL,
           kernel: Optional[str] = None) -> Bricks:
    """voxelize for grids whose cells need not fit into memory: Bricks, at and bits, of the cells that some triangle overlaps.

    triangles, origin, cell, size, threads, accuracy, axes, kernel: as for voxelize. bricks(mesh, *grid_around(mesh, 4096)) lays the
        grid around the mesh.
    tile: the side of the cubes of cells that are taken one at a time, a multiple of 8. The bricks do not depend on it, but their
        order: by the number of their tile, then by z, y and x.
    tiles: (first, end) for tiles first .. end - 1 of tile_count(size, tile) alone: the share of a task or a machine.

    Raises errors as voxelize does. Bricks take 76 bytes each; a surface has 64 to 69 cells in each, however fine the grid.
    """
    held_, options, threads_ = held(triangles), options_of(accuracy, axes, 0, kernel), threads_of(threads)
    listing = options_of("exact", axes, 0, kernel) # as a Partition's: cells that are not exact depend on which tiles are asked
    grid = grid_for(held_, origin, cell, size)
    check_grid(grid, options, axes, origin=origin, cell=cell, size=size)
    tiling = Tiling(grid, tile_of(tile))
    first, end = range_of(tiles, tiling.count)
    return bricks_of(Listed(held_, tiling, first, end, listing), tiling, options, threads_)
