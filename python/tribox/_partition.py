"""A mesh sorted by tiles on disk: folders as the program tribox writes and reads them, of which a task maps what it needs."""

from __future__ import annotations

import os
import secrets
import shutil
from typing import Any, List, Optional, SupportsIndex, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from ._around import grid_given
from ._arguments import options_of, range_of, whole
from ._bounds import point
from ._bricks import Bricks, bricks_of, bricks_with_ids
from ._checksum import checksum, checksums, checksums_of_rows
from ._errors import InputError, shown
from ._grids import Grid
from ._ids import check_ids, set_with_ids
from ._masks import WORD, bools, row_words
from ._overlap import ALL
from ._threads import threads_of
from ._tiles import NUMBER, Listed, Tiling, set_tile, side_of
from ._triangles import Mesh, by_number, held, is_double
from ._typing import Accuracy, Cell, GridLike, Range, TrianglesLike
from ._voxels import Voxels

MAGIC, BYTE_ORDER, HASH_BYTES = b"tribox tiles 3\n", 0x01020304, 8
HEADER = np.dtype([("magic", "S16"), ("byte_order", "u4"), ("tile", "u4"), ("origin", "f8", 3), ("cell", "f8", 3),
                   ("shift", "f8", 3), ("size", "u4", 3), ("number_bytes", "u4"), ("position_bytes", "u4"), ("record_bytes", "u4"),
                   ("triangles", "u8"), ("sums", "u8", 2), ("not_finite", "u8"), ("records", "u8"), ("places", "u8"),
                   ("checksum", "u8")])
RECORD = np.dtype([("tile", "u8"), ("first", "u8"), ("work", "u8"), ("checksum", "u8")])
NUMBERED_MAX = (1 << 31) - 1  # triangles of a mesh that numbers are kept of: ids of the program are int32
TILE_COST, PLACE_COST, CELL_COST = 20000, 60, 10  # nanoseconds, roughly: only their ratios matter
BLOCK = 1 << 20  # triangles that are written at once
SHARES_MAX = (1 << 31) - 1


class Partition:
    """The folder of a partition, which tribox.partition or the program's `tribox partition` wrote, mapped into memory.

    grid: its Grid. side: of a tile, in cells. tile_count: tiles of the grid. numbers: the tiles that have triangles, in rising
    order; all others are empty. work: about how many nanoseconds each of these takes. shift: what was subtracted from the mesh.
    triangle_count: of the mesh. has_ids: whether the numbers of its triangles are kept, as ids ask for.

    Only what is needed is read. It can be pickled, as the name of the folder, and threads may use one at the same time. Opening it
    checks the index; check() checks the triangles.
    """

    def __init__(self, folder: Union[str, "os.PathLike[str]"]) -> None:
        self.folder = os.path.abspath(os.fspath(folder))
        with open(os.path.join(self.folder, "index"), "rb") as file:
            octets = file.read()
        header, records = self._index(octets)
        self.grid = Grid(*(header[name].tolist() for name in ("origin", "cell", "size")))
        self.side, self.shift = int(header["tile"]), tuple(header["shift"].tolist())
        self.numbers, self.work = records["tile"].astype(np.int64), records["work"].astype(np.int64)
        self._checksums = records["checksum"]
        self._ends = np.append(records["first"], header["places"])[1:].astype(np.int64)
        self._starts = records["first"].astype(np.int64)
        kind = np.dtype(f"f{header['position_bytes']}")
        places, self.triangle_count = int(header["places"]), int(header["triangles"])
        self._map = self._mapped("triangles", kind, (places, 3, 3))
        self.has_ids = bool(header["number_bytes"])
        self._ids = self._mapped("numbers", NUMBER, (places,)) if self.has_ids else None
        self._tiling = Tiling(self.grid, self.side)
        self.tile_count = self._tiling.count

    def _damaged(self, why):
        return InputError(f"{self.folder}: {why}; make the partition again")

    def _index(self, octets):
        """The header and the records of an index that is whole."""
        if not octets.startswith(MAGIC[:12]):
            raise InputError(f"{self.folder}: not a partition; give a folder that tribox.partition or tribox partition wrote")
        if len(octets) < HEADER.itemsize or not octets.startswith(MAGIC):
            raise self._damaged("damaged, or of another version of tribox")
        header = np.frombuffer(octets, HEADER, 1)[0]
        if header["byte_order"] != BYTE_ORDER:
            raise self._damaged("written on a machine of another byte order")
        if len(octets) != HEADER.itemsize + int(header["records"]) * RECORD.itemsize or header["record_bytes"] != RECORD.itemsize:
            raise self._damaged("damaged: its index has another size than it should")
        end = HEADER.itemsize - HASH_BYTES
        if checksum(octets[:end] + octets[HEADER.itemsize:]) != int(header["checksum"]):
            raise self._damaged("damaged: the checksum of its index does not match")
        return header, np.frombuffer(octets, RECORD, offset=HEADER.itemsize)

    def _mapped(self, name, kind, shape):
        path = os.path.join(self.folder, name)
        if os.path.getsize(path) != np.prod(shape) * kind.itemsize:
            raise self._damaged(f"damaged: its {name} are not as many as its index says")
        return np.memmap(path, kind, "r", shape=shape) if shape[0] else np.empty(shape, kind)

    def __reduce__(self):
        return Partition, (self.folder,)

    def __repr__(self) -> str:
        ends = [start + count * cell for start, count, cell in zip(self.grid.origin, self.grid.size, self.grid.cell)]
        size = " x ".join(map(str, self.grid.size))
        return (f"<tribox.Partition: {len(self.numbers)} of {self.tile_count} tiles have triangles, {len(self._map)} in all, "
                f"{size} cells from {point(self.grid.origin)} to {point(ends)}, {shown(self.folder)}>")

    def shares(self, count: SupportsIndex) -> List[Tuple[int, int]]:
        """`count` shares of about equal work, (first, count) of their tiles each; together they are all tiles."""
        parts = whole(count, 1, SHARES_MAX)
        if parts is None:
            raise InputError(f"count = {shown(count)}; give how many shares to make, a whole number, 1 to 2^31 - 1")
        middles = np.cumsum(self.work) - self.work / 2
        cuts = np.searchsorted(middles, self.work.sum() * np.arange(1, parts) / parts)
        borders = [0, *np.append(self.numbers, self.tile_count)[cuts].tolist(), self.tile_count]
        return [(first, end - first) for first, end in zip(borders, borders[1:])]

    def _places(self, tiles):
        """The places, first to before end, of tiles among those that have triangles."""
        first, count = range_of("tiles", tiles, self.tile_count, "tiles")
        return np.searchsorted(self.numbers, (first, first + count)).tolist()

    def _place(self, number):
        """Where a tile is among those that have triangles; None if it is not."""
        if whole(number, 0, self.tile_count - 1) is None:
            raise InputError(f"number = {shown(number)}; give that of a tile, less than {self.tile_count}")
        place = int(np.searchsorted(self.numbers, number))
        return place if place < len(self.numbers) and self.numbers[place] == number else None

    def triangles(self, number: SupportsIndex) -> NDArray[Any]:
        """The triangles of a tile, and some that come close: an array of shape (n, 3, 3), which is read as it is used."""
        return self._map[self._slice(self._place(number))]

    def ids(self, number: SupportsIndex) -> NDArray[np.uint32]:
        """The numbers of these triangles in the mesh, rising. InputError if they were not kept: partition(..., ids=True)."""
        self._check_ids(True)
        return self._ids[self._slice(self._place(number))]

    def _slice(self, place):
        """Where the triangles of a tile are."""
        return slice(0) if place is None else slice(int(self._starts[place]), int(self._ends[place]))

    def _check_ids(self, ids):
        if ids and not self.has_ids:
            raise InputError(f"{self.folder}: has no numbers of its triangles; make it with ids=True, or leave out ids")

    def window(self, number: SupportsIndex) -> Tuple[Tuple[int, int, int], Tuple[int, int, int]]:
        """The cells of a tile, as the window of tribox.voxelize: (first, size)."""
        self._place(number)
        return self._tiling.window(int(number))

    def voxelize(self, number: SupportsIndex, *, accuracy: Accuracy = "exact", axes: int = ALL, kernel: Optional[str] = None,
                 ids: bool = False) -> Voxels:
        """The cells of a tile: tribox.voxelize of the mesh with window=self.window(number)."""
        options = options_of(accuracy, axes, 0, kernel)
        self._check_ids(ids)
        place, (first, size) = self._place(number), self.window(number)
        words = np.zeros((size[2], size[1], row_words(size[0])), WORD)
        task, found = (self._tiling.struct, first, size, options, words), np.empty(0, NUMBER)
        if place is not None and ids:
            found = self._ids[self._slice(place)][set_with_ids(Mapped(self, [place]).of(place), *task)[bools(words, size[0])]]
        elif place is not None:
            set_tile(Mapped(self, [place]).of(place), *task)
        voxels = Voxels(words, self.grid, (first, size))
        return voxels._with_ids(found) if ids else voxels

    def bricks(self, tiles: Optional[Range] = None, *, threads: Optional[SupportsIndex] = 1, accuracy: Accuracy = "exact",
               axes: int = ALL, kernel: Optional[str] = None, ids: bool = False) -> Bricks:
        """tribox.bricks of the mesh and the grid. tiles: (first, count), such as one of shares()."""
        options, threads = options_of(accuracy, axes, 0, kernel), threads_of(threads)
        self._check_ids(ids)
        return (bricks_with_ids if ids else bricks_of)(Mapped(self, np.arange(*self._places(tiles))), self._tiling, options, threads)

    def check(self, tiles: Optional[Range] = None) -> None:
        """Reads the triangles of tiles (first, count), by default all, and raises an InputError if they are not those written."""
        first, end = self._places(tiles)
        halves = self._map.reshape(-1).view(np.uint32)
        each = halves.size // max(1, len(self._map))
        found = checksums(halves, each * self._starts[first:end], each * self._ends[first:end])
        if self.has_ids:
            found += checksums(self._ids, self._starts[first:end], self._ends[first:end])
        wrong = np.flatnonzero(found != self._checksums[first:end])
        if len(wrong):
            raise self._damaged(f"damaged: the checksum of tile {self.numbers[first + wrong[0]]} does not match")


class Mapped:
    """Triangles by tile, those of a partition."""

    def __init__(self, partition_, places):
        self.partition, self.places, self.numbers = partition_, places, partition_.numbers[places]

    def of(self, place):
        return Mesh(self.partition._map[self.partition._slice(place)])

    def ids(self, place):
        return self.partition._ids[self.partition._slice(place)]


def work_of(triangles, grid):
    """About how many nanoseconds each of the triangles takes, beyond the tiles that it is in."""
    with np.errstate(all="ignore"):
        corners = (triangles.astype(float) - grid.origin) / grid.cell
        sides = np.abs(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])).sum(1) / 2
        work = CELL_COST * (sides + np.ptp(corners, 1).sum(1))
    return np.where(np.isfinite(work), work, 0)


def sums_of(held_):
    """How many triangles have a coordinate that is not finite; the sum of the checksums of the others, and with their numbers."""
    count, sums = 0, np.zeros(2, np.uint64)
    for first in range(0, held_.struct.count, BLOCK):
        triangles = by_number(held_, slice(first, first + BLOCK)).astype(float).reshape(-1, 9)
        finite = np.isfinite(triangles).all(1)
        each = checksums_of_rows(triangles.view(np.uint64)) * finite
        sums += each.sum(dtype=np.uint64), (each * np.arange(first, first + len(each), dtype=np.uint64)).sum(dtype=np.uint64)
        count += int((~finite).sum())
    return count, sums


def write_triangles(file, lists, held_, tiling, ids):
    """Writes the triangles of all tiles; returns their records. ids: of their numbers too, which are those of the lists."""
    counts = np.diff(lists.starts)[lists.places].astype(np.int64)
    records = np.zeros(len(counts), RECORD)
    records["tile"], records["first"] = lists.numbers, np.cumsum(counts) - counts
    tiles_each = np.bincount(lists.list, minlength=held_.struct.count)
    most = CELL_COST * 3.0 * tiling.side ** 2
    start = 0
    while start < len(counts):
        end = max(start + 1, int(np.searchsorted(np.cumsum(counts[start:]), BLOCK, "right")) + start)
        begins = records["first"][start:end].astype(np.int64)
        numbers = lists.list[begins[0]:begins[-1] + counts[end - 1]]
        triangles = by_number(held_, numbers)
        file.write(triangles)
        work = np.minimum(work_of(triangles, tiling.grid) / tiles_each[numbers], most)
        records["work"][start:end] = TILE_COST + PLACE_COST * counts[start:end] + np.add.reduceat(work, begins - begins[0])
        halves = triangles.reshape(-1).view(np.uint32)
        places = (begins - begins[0]) * (halves.size // len(triangles))
        records["checksum"][start:end] = checksums(halves, places, np.append(places[1:], halves.size))
        if ids:
            begins -= begins[0]
            records["checksum"][start:end] += checksums(numbers, begins, np.append(begins[1:], len(numbers)))
        start = end
    return records


def write_index(file, held_, tiling, lists, records, ids):
    header = np.zeros((), HEADER)
    grid, (broken, sums) = tiling.grid, sums_of(held_)
    given = dict(magic=MAGIC, byte_order=BYTE_ORDER, tile=tiling.side, origin=grid.origin, cell=grid.cell, size=grid.size,
                 position_bytes=8 if is_double(held_) else 4, record_bytes=RECORD.itemsize,
                 number_bytes=NUMBER.itemsize * bool(ids),
                 triangles=held_.struct.count, sums=sums, not_finite=broken, records=len(records),
                 places=len(lists.list))
    for name, value in given.items():
        header[name] = value
    header["checksum"] = checksum(header.tobytes()[:HEADER.itemsize - HASH_BYTES] + records.tobytes())
    file.write(header.tobytes() + records.tobytes())


def partition(triangles: TrianglesLike, folder: Union[str, "os.PathLike[str]"], grid: Optional[GridLike] = None, *,
              cell: Optional[Cell] = None, resolution: Optional[SupportsIndex] = None, side: SupportsIndex = 128,
              ids: bool = False) -> Partition:
    """Sorts triangles by the tiles of a grid into a new folder, which tasks and machines map: returns its Partition.

    triangles, grid, cell, resolution: as for voxelize. side: of the tiles, in cells, a multiple of 8.
    folder: must not exist (FileExistsError). It appears when it is complete, or not at all.
    ids: True to keep the numbers of the triangles, for voxelize and bricks with ids.

    A triangle takes 36 bytes (72 of float64; 4 more with ids) for each tile that it is in. The program tribox takes the folder in
    place of a mesh.
    """
    held_, options = held(triangles), options_of("exact", ALL, 0, None)
    tiling = Tiling(grid_given(held_, grid, cell, resolution), side_of(side))
    folder = os.path.abspath(os.fspath(folder))
    if os.path.lexists(folder):
        raise FileExistsError(f"folder = {shown(folder)} exists; remove it, or give another")
    if ids:
        check_ids(held_, NUMBERED_MAX)
    lists = Listed(held_, tiling, 0, tiling.count, options)
    draft = os.path.join(os.path.dirname(folder), f".tribox-{secrets.token_hex(8)}")
    os.mkdir(draft)
    try:
        with open(os.path.join(draft, "triangles"), "wb") as file:
            records = write_triangles(file, lists, held_, tiling, ids)
        if ids:
            lists.list.tofile(os.path.join(draft, "numbers"))
        with open(os.path.join(draft, "index"), "wb") as file:
            write_index(file, held_, tiling, lists, records, ids)
        os.rename(draft, folder)
    finally:
        shutil.rmtree(draft, ignore_errors=True)
    return Partition(folder)
