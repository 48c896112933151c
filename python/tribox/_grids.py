"""Grids of cells, and what may be wrong with them."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, isfinite
from typing import Any, Iterator, SupportsIndex, Tuple

import numpy as np

from ._arguments import check, three, wholes
from ._errors import InputError, named, shown
from ._ffi import ffi
from ._library import lib

SIZE_MAX = (1 << 32) - 1  # cells along an axis



def cells_of(cell):
    """The lengths of a cell, of which one number stands for three."""
    try:
        iter(cell)
    except TypeError:
        cell = (cell,) * 3
    return three("cell", cell, "give the length of a cell, or three: x, y, z")


@dataclass(frozen=True)
class Grid:
    """A grid of closed cells: Grid(origin, cell, size).

    origin: the lower corner of the first cell, three numbers. cell: the length of a cell, or three; both in the unit of the
        triangles. size: the cells on each axis, (nx, ny, nz).

    Plane p of an axis lies at the double nearest to origin + p * cell. Raises InputError if numbers are not finite or not positive,
    or if two planes round to the same double.
    """

    origin: Tuple[float, float, float]
    cell: Tuple[float, float, float]
    size: Tuple[int, int, int]

    def __init__(self, origin: Any, cell: Any, size: Any) -> None:
        sizes = wholes(size, 0, SIZE_MAX)
        if not sizes:
            raise InputError(f"size = {shown(size)}; give three numbers of cells, x, y, z, each less than 2^32")
        for name, value in (("origin", three("origin", origin)), ("cell", cells_of(cell)), ("size", sizes)):
            object.__setattr__(self, name, value)
        check_planes(self, origin=origin, cell=cell, size=size)

    def __iter__(self) -> Iterator[Any]:
        """origin, cell, size = grid"""
        return iter((self.origin, self.cell, self.size))

    def box(self, i: SupportsIndex, j: SupportsIndex, k: SupportsIndex) -> Tuple[Tuple[float, ...], Tuple[float, ...]]:
        """(lo, hi) of cell (i, j, k): the very box that voxelize asks about."""
        cell = wholes((i, j, k), 0, SIZE_MAX)
        if not cell or any(at >= size for at, size in zip(cell, self.size)):
            raise InputError(f"(i, j, k) = {shown((i, j, k))}; give a cell of the {self.sides()}")
        box = lib.tribox_grid_cell(struct_of(self), *cell)
        return tuple(box.lo), tuple(box.hi)

    def sides(self) -> str:
        """Its size, as it is written."""
        return "{} x {} x {} cells".format(*self.size)


def struct_of(grid):
    return ffi.new("tribox_grid *", tuple(grid))


def status_of(struct):
    """What the library says to a voxelization of no triangles into no cells."""
    word = ffi.new("uint64_t *")
    return lib.tribox_voxelize(ffi.new("tribox_soup *"), struct, ffi.new("tribox_window *"), ffi.NULL, word, ffi.NULL)


def sufficient_cell(origin, size):
    """A length that `size` cells on an axis can have: planes twice the spacing of doubles apart are distinct. inf if none."""
    cell = 0.0
    while True:
        end = origin + size * cell
        if not isfinite(end):
            return inf
        needed = 2 * float(np.spacing(max(abs(origin), abs(end))))
        if cell >= needed:
            return cell
        cell = needed


def fault_of_axis(axis, origin, cell, size):
    """What is wrong with an axis of a grid that the library refuses; None if nothing is, as far as one can see here."""
    if not isfinite(origin) or not isfinite(cell):
        return f"the origin or the cell is not finite on the {axis} axis"
    if not cell > 0 or not size:
        return f"the cell or the size is not greater than zero on the {axis} axis"
    if not isfinite(origin + size * cell):
        return f"the grid ends beyond the largest float64 on the {axis} axis"
    if not status_of(ffi.new("tribox_grid *", ((origin, 0, 0), (cell, 1, 1), (size, 1, 1)))):
        return None
    enough = sufficient_cell(origin, size)
    larger = f"cells of {enough:.17g} are large enough, or" if isfinite(enough) else "choose fewer cells, or"
    return f"float64 cannot tell cells of {cell:.17g} apart on the {axis} axis, so far from 0; {larger} move the origin towards 0"


def check_planes(grid, **given):
    """Raises what is wrong with a grid. given: as the caller has it."""
    status = status_of(struct_of(grid))
    if status == lib.TRIBOX_BAD_GRID:
        faults = (fault_of_axis(*axis) for axis in zip("xyz", grid.origin, grid.cell, grid.size))
        raise InputError(f"{next(filter(None, faults))}: {named(given)}", "BAD_GRID")
    check(status)
