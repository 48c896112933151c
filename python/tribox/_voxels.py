"""Cells that are set: what every voxelization returns."""

from __future__ import annotations

import os
from abc import ABCMeta
from dataclasses import replace
from typing import Any, Iterator, Optional, Tuple, Union

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin
from numpy.typing import ArrayLike, NDArray

from ._arguments import array_of, wholes
from ._errors import Brief, InputError, InputTypeError, path_of, shown
from ._ffi import ffi
from ._files import save_voxels
from ._grids import SIZE_MAX, Grid, grid_of
from ._library import lib
from ._loading import check_grid, load_cells
from ._masks import BOOL, WORD, bools, labels_of, pointer_to, row_words, rows_of_words
from ._triangles import point
from ._typing import GridLike, Window


# What gives bools of bools, cell by cell.
BITWISE = {np.bitwise_and: np.bitwise_and, np.bitwise_or: np.bitwise_or, np.bitwise_xor: np.bitwise_xor, np.invert: np.invert,
           np.logical_and: np.bitwise_and, np.logical_or: np.bitwise_or, np.logical_xor: np.bitwise_xor, np.logical_not: np.invert}


class BriefArray(Brief, ABCMeta):  # which the operators are for type checkers
    pass


class Voxels(NDArrayOperatorsMixin, metaclass=BriefArray):
    """Cells of a grid, as an array of bool of shape (nz, ny, nx) that knows its grid: voxels[k, j, i] is cell (i, j, k).

    Voxels can be used like such an array, without a copy: np.asarray(voxels), voxels[3], voxels.sum(), voxels.any(axis=0),
    np.argwhere(voxels), and so on. They are read-only; np.array(voxels) is a copy that can be written to.

    a & b, a | b, a ^ b and ~a are Voxels of the same cells, without ids, labels and colors, which voxels.with_colors() adds. Grids
    or windows that differ are an InputError; with an array the result is an array. voxels[2:5, :, 10:] are Voxels of that window of
    the grid, with their ids and the cells inside. Any other index, such as voxels[3] or voxels[::2], gives what an array gives.

    grid: the Grid. window: (first, size) of the cells of the grid that are here, which may be only some.
    words: the cells in memory, uint64 of shape (nz, ny, words): bit i % 64 of word i // 64 of a row is cell i along x. Bools, eight
        times as large, are made when first needed.

    inside: after voxelize(..., labels=True) the cells inside, also as Voxels; else None. labels() is then an array of 1 for cells
        of the surface, 2 for those inside, and 0.

    Voxels(cells, grid) makes them from an array of bool, or from such words; Voxels(cells, grid, window) from some of the grid's
    cells.

    As a VoxelGrid of trimesh:

        transform = np.diag([*voxels.grid.cell, 1])
        transform[:3, 3] = voxels.grid.origin + (np.array(voxels.window[0]) + 0.5) * voxels.grid.cell
        trimesh.voxel.VoxelGrid(np.asarray(voxels).T, transform)

    As a VoxelGrid of Open3D, where cells are cubes:

        origin, cell, size = map(np.array, voxels.grid)
        cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(voxels.points()))
        open3d.geometry.VoxelGrid.create_from_point_cloud_within_bounds(cloud, cell[0], origin, origin + size * cell)
    """

    ndim, dtype = 3, BOOL

    def __init__(self, cells: Any, grid: Grid, window: Optional[Window] = None) -> None:
        if not isinstance(grid, Grid):
            raise InputTypeError(f"grid = {shown(grid)}; give tribox.Grid(origin, cell, size)")
        self._grid, self._window = grid, window_of(window, grid)
        cells = np.asarray(cells)
        wanted = self.shape if cells.dtype == BOOL else (*self.shape[:2], row_words(self.shape[2]))
        if cells.dtype != BOOL and cells.dtype != WORD:
            raise InputTypeError(f"cells is an array of {cells.dtype}; give bools, or words of uint64")
        if cells.shape != wanted:
            raise InputError(f"cells has shape {cells.shape}; give {wanted}")
        self._words = np.ascontiguousarray(cells) if cells.dtype == WORD else rows_of_words(cells)
        self._cells: Optional[NDArray[np.bool_]] = None
        self._ids: Optional[NDArray[np.uint32]] = None
        self._colors: Optional[NDArray[np.uint8]] = None
        self._inside: Optional[NDArray[np.uint64]] = None

    @property
    def grid(self) -> Grid:
        """The grid, of which these are all cells or some."""
        return self._grid

    @property
    def window(self) -> Tuple[Tuple[int, int, int], Tuple[int, int, int]]:
        """(first, size), of three numbers of cells each, x, y, z."""
        return self._window

    @property
    def words(self) -> NDArray[np.uint64]:
        """The cells, a bit each, to be read."""
        words = self._words.view()
        words.flags.writeable = False
        return words

    @property
    def ids(self) -> NDArray[np.uint32]:
        """The lowest number of a triangle for each cell that is set, in the order of cells(). Without them an InputError."""
        if self._ids is None:
            raise InputError("these Voxels have no ids; voxelize(..., ids=True) makes some that have")
        return self._ids

    @property
    def colors(self) -> NDArray[np.uint8]:
        """Red, green and blue of each set cell, uint8 of shape (m, 3), in the order of cells(). Without them an InputError."""
        if self._colors is None:
            raise InputError("these Voxels have no colors; voxelize(..., colors=...) or with_colors() makes some that have")
        return self._colors

    def with_colors(self, colors: ArrayLike) -> Voxels:
        """The same cells with these colors, for files that hold them; ids and labels, whose place they take, are left out.

        colors: uint8 of shape (m, 3), in the order of cells(): such as face_colors[voxels.ids], or those of a texture at
            voxels.points(). A fourth column, alpha, is left out.
        """
        voxels = Voxels(self._words, self._grid, self._window)
        voxels._colors = fixed(colors_of(colors, self.sum(), "cell"))
        return voxels

    @property
    def inside(self) -> Optional[Voxels]:
        """The cells that are inside, where they are told apart."""
        return None if self._inside is None else Voxels(self._inside, self._grid, self._window)

    def labels(self) -> NDArray[np.uint8]:
        """An array of uint8 of shape (nz, ny, nx): 1 for cells of the surface, 2 for those inside, and 0.

        Raises InputError for Voxels that have no labels.
        """
        if self._inside is None:
            raise InputError("these Voxels have no labels; voxelize(..., fill=..., labels=True) makes some that have")
        return labels_of(self._words, self._inside, self.shape[2])

    @property
    def shape(self) -> Tuple[int, int, int]:
        """(nz, ny, nx)"""
        return self._window[1][::-1]

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> NDArray[Any]:
        if self._cells is None:
            self._cells = bools(self._words, self.shape[2])
            self._cells.flags.writeable = False
        cells = self._cells if dtype is None else self._cells.astype(dtype, copy=False)
        return cells.copy() if copy else cells

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **keywords: Any) -> Any:
        if any(isinstance(array, Voxels) for array in keywords.get("out", ())):
            return NotImplemented
        if ufunc in BITWISE and method == "__call__" and not keywords and all(isinstance(one, Voxels) for one in inputs):
            return self._of_bits(BITWISE[ufunc], inputs)
        return getattr(ufunc, method)(*(np.asarray(one) if isinstance(one, Voxels) else one for one in inputs), **keywords)

    def __ior__(self, other: Any) -> Any:
        raise InputTypeError("Voxels are read-only; write a = a | b for a |= b, and so for & and ^")

    __iand__ = __ixor__ = __ior__

    def __getattr__(self, name: str) -> Any:
        """All else that an array has."""
        if name.startswith("_") or not hasattr(np.ndarray, name):
            raise AttributeError(f"Voxels have no {name}")
        return getattr(np.asarray(self), name)

    def __getitem__(self, key: Any) -> Any:
        window = self._window_at(key)
        return np.asarray(self)[key] if window is None else self._part(*window)

    def __setitem__(self, key: Any, value: Any) -> None:
        raise InputTypeError("Voxels are read-only; np.array(voxels) is a copy that can be written to, and tribox.Voxels(copy, "
                             "voxels.grid, voxels.window) makes Voxels of it")

    def __iter__(self) -> Iterator[NDArray[np.bool_]]:
        return iter(np.asarray(self))

    def __len__(self) -> int:
        return self.shape[0]

    def __bool__(self) -> bool:
        return bool(np.asarray(self))  # which raises, as arrays do

    def __repr__(self) -> str:
        lo, hi = (self.grid.box(*at)[side] if all(self.shape) else self.grid.origin for side, at in enumerate(self._corners()))
        part = "" if self._window[1] == self.grid.size else f" of a grid of {self.grid.sides()}"
        return (f"<tribox.Voxels: {self.sum()} of {' x '.join(map(str, self._window[1]))} cells{part}, from {point(lo)} to "
                f"{point(hi)}>")

    def _corners(self):
        """The first cell and the last."""
        first, size = self._window
        return first, [f + s - 1 for f, s in zip(first, size)]

    def _of_bits(self, ufunc, inputs):
        """Voxels of an operation on the cells of all these."""
        for other in inputs:
            if (other.grid, other.window) != (self.grid, self.window):
                raise InputError(f"these are cells {inputs[0].window} of {inputs[0].grid} and {inputs[1].window} of "
                                 f"{inputs[1].grid}; give Voxels of one grid and window, or np.asarray() of them")
        words = ufunc(*(other._words for other in inputs))
        if ufunc is np.invert and words.size and self.shape[2] % 64:
            words[..., -1] &= WORD.type((1 << self.shape[2] % 64) - 1)
        return Voxels(words, self._grid, self._window)

    def _window_at(self, key):
        """(first, end), in the order of axes of the array, of what slices without a step cut out; None if it is not such a box."""
        key = key if isinstance(key, tuple) else (key,)
        for at in [at for at, one in enumerate(key) if one is Ellipsis][:1]:
            key = (*key[:at], *(slice(None),) * (4 - len(key)), *key[at + 1:])
        if len(key) > 3 or not all(isinstance(one, slice) and one.step in (None, 1) for one in key):
            return None
        ranges = [one.indices(size)[:2] for one, size in zip((*key, *(slice(None),) * (3 - len(key))), self.shape)]
        return [first for first, _ in ranges], [max(range_) for range_ in ranges]

    def _part(self, first, end):
        """The cells in a box of places in the array."""
        key = tuple(map(slice, first, end))
        cells = np.asarray(self)
        size = [e - f for f, e in zip(first, end)]
        part = Voxels(cells[key], self._grid, ([f + s for f, s in zip(self._window[0], first[::-1])], size[::-1]))
        if self._ids is not None or self._colors is not None:
            is_in = np.zeros(self.shape, bool)
            is_in[key] = True
            is_in = is_in[cells]
            part._ids = None if self._ids is None else fixed(self._ids[is_in])
            part._colors = None if self._colors is None else fixed(self._colors[is_in])
        return part if self._inside is None else part._with_inside(rows_of_words(bools(self._inside, self.shape[2])[key]))

    def _within(self, first, size):
        """The same cells, and clear ones around them, in a larger window."""
        if (first, size) == self._window:
            return self
        before = [own - f for own, f in zip(self._window[0], first)]
        rows = tuple(slice(b, b + count) for b, count in zip(before[:0:-1], self.shape))
        sides = (0, 0), (0, 0), (before[0], size[0] - before[0] - self.shape[2])

        def wide(words):
            larger = np.zeros((*size[:0:-1], row_words(size[0])), WORD)
            larger[rows] = rows_of_words(np.pad(bools(words, self.shape[2]), sides))
            return larger

        voxels = Voxels(wide(self._words), self._grid, (first, size))
        voxels._ids, voxels._colors = self._ids, self._colors
        return voxels if self._inside is None else voxels._with_inside(wide(self._inside))

    def _add(self, words):
        """Adds cells, which may be these very words."""
        if words is not self._words:
            np.bitwise_or(self._words, words, out=self._words)
        self._cells = self._ids = self._inside = self._colors = None
        return self

    def _with_ids(self, ids):
        self._ids = fixed(ids)
        return self

    def _with_inside(self, words):
        self._inside = words
        return self

    def __reduce__(self) -> Any:
        more = {name: value for name, value in vars(self).items() if name in ("_ids", "_inside", "_colors") and value is not None}
        return (Voxels, (self._words, self._grid, self._window), *([more] if more else []))

    def sum(self, axis: Any = None, **keywords: Any) -> Any:
        """How many cells are set: in all, or along axes as arrays of bool are summed up."""
        if axis is not None or any(value is not None for value in keywords.values()):
            return np.asarray(self).sum(axis, **keywords)
        return self._list(ffi.NULL)

    def _list(self, cells):
        """Writes the set cells where there is room, and returns how many there are."""
        return lib.tribox_window_cells(pointer_to(self._words), self.shape[::-1], cells)

    def cells(self) -> NDArray[np.int64]:
        """The cells that are set, (i, j, k) of the grid each: an array of int64 of shape (m, 3), in the order of k, j, i."""
        cells = np.empty((self._list(ffi.NULL), 3), np.uint32)
        self._list(ffi.from_buffer("uint32_t(*)[3]", cells) if cells.size else ffi.NULL)
        return cells.astype(np.int64) + np.array(self._window[0], np.int64)

    def points(self) -> NDArray[np.float64]:
        """The middles of the cells that are set: an array of float64 of shape (m, 3), in the order of cells()."""
        return middles(self.grid, self.cells())

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes a file by the ending of its name, of every format of the program tribox, with what that holds.

        .npz: the grid and the bricks that are not empty: numpy.load(path) has at, bits, origin, cell, size and shift, and ids,
        inside (the bits of the cells inside) or colours. .npy: an array of bool, without the grid. .nrrd: for 3D Slicer. .vti: for
        ParaView. In .npy, .nrrd and .vti, labels are uint8 and ids int32 of every cell, -1 where it is clear.

        .vdb (OpenVDB; ids, labels, colors), .vox (MagicaVoxel; labels, colors of a palette), .ply, .obj and .glb (faces; colors),
        .binvox (cubes) and .raw (bits; ids, labels) are written by the program tribox, see help(tribox.read). That of the wheel
        writes no .vdb.

        Of a window, such as voxels[2:5], a .npy is the array; all others are of the whole grid, in which the other cells are clear.

        Raises InputError for other kinds, for one that does not hold the ids, labels or colors that there are, and for a grid that
        the format cannot hold; OSError if the file cannot be written; Error without the program. What had the name before is
        then still there.
        """
        save_voxels(self, path_of(path))

    @staticmethod
    def load(path: Union[str, "os.PathLike[str]"], grid: Optional[GridLike] = None) -> Voxels:
        """Reads a file that save() or the program tribox wrote, with all ids, labels and colors that it holds.

        .npz, .nrrd, .vti, .vdb and .binvox have their grid. Give that of others: .npy, also of a list of cells, .raw, .vox, .ply,
        .obj and .glb. One that is given for the former is checked, and is then that of the Voxels: a .nrrd, which says where the
        middle of the first cell is, may be off by a rounding, and a .binvox is of a cube, up to which its grid was filled.

        What does not come back: the colors of .ply, .obj and .glb, where cells without a face have none; ids of a .vdb, as the
        Python module of OpenVDB, openvdb or pyopenvdb, which a .vdb takes, does not read them; colors that were too many for a
        .vox; and which window it was. A .raw of 2 or 8 cells along x that can be bits as well as ids or labels is refused.

        Raises InputError for other files, for damaged ones, for a part of a whole, and for one of another grid; Error for a .vdb
        without that module.
        """
        from ._bricks import Bricks  # which is made of Voxels

        path, given = path_of(path), grid if grid is None or isinstance(grid, Grid) else grid_of(grid)
        if os.path.splitext(path)[1].lower() == ".npz":
            bricks = Bricks.load(path)
            return replace(bricks, grid=check_grid(path, given, bricks.grid)).voxels()
        cells, whole, colors = load_cells(path, given)
        if cells.dtype.kind == "i":
            return Voxels(cells >= 0, whole)._with_ids(cells[cells >= 0].astype(np.uint32))
        if cells.dtype == np.uint8:
            return Voxels(cells != 0, whole)._with_inside(rows_of_words(cells == 2))
        return Voxels(cells, whole).with_colors(*colors) if colors else Voxels(cells, whole)


def fixed(array):
    """Read-only from now on."""
    array.flags.writeable = False
    return array


def colors_of(colors, count, what):
    """A copy of so many colours, a row of three bytes each. what: has them."""
    array = array_of("colors", colors)
    if array.dtype != np.uint8 or array.ndim != 2 or array.shape[1] not in (3, 4) or len(array) != count:
        raise InputError(f"colors is an array of {array.dtype} of shape {array.shape}; give uint8 of shape ({count}, 3), red, "
                         f"green and blue of each {what}")
    return np.array(array[:, :3], order="C")


def middles(grid, cells):
    """Of cells, (i, j, k) each."""
    return grid.origin + (cells + 0.5) * grid.cell


def window_of(window, grid):
    """(first, size) of the cells that are wanted, by default of all."""
    if window is None:
        return (0, 0, 0), grid.size
    pair = tuple(wholes(part, 0, SIZE_MAX) for part in window) if np.iterable(window) else ()
    if len(pair) != 2 or None in pair or any(f + s > all_ for f, s, all_ in zip(*pair, grid.size)):
        raise InputError(f"window = {shown(window)}; give (first, size), each of three numbers of cells, x, y, z, within the "
                         f"{grid.sides()} of the grid")
    return pair
