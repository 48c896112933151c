"""Grids of cells, what may be wrong with them, and which a caller means: one that is given, or one around the triangles."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import floor, inf, isfinite, nextafter
from typing import Any, Iterator, Optional, SupportsIndex, Tuple

import numpy as np

from ._arguments import check, three, whole, wholes
from ._errors import Brief, InputError, InputTypeError, named, shown
from ._ffi import ffi
from ._library import lib
from ._triangles import bounds_of, held
from ._typing import Cell, TrianglesLike

SIZE_MAX = (1 << 32) - 1  # cells along an axis


def cells_of(cell):
    """The lengths of a cell, of which one number stands for three."""
    try:
        iter(cell)
    except TypeError:
        cell = (cell,) * 3
    return three("cell", cell, "give the length of a cell, or three: x, y, z")


@dataclass(frozen=True)
class Grid(metaclass=Brief):
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
        """(lo, hi) of cell (i, j, k): the very box that voxelize tests."""
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


WAYS = ("give cell, the length of a cell, or resolution, the cells along the longest side, for a grid around the triangles; or a "
        "grid: tribox.Grid(origin, cell, size)")


def double(number):
    """The double nearest to a rational number; infinite beyond them."""
    try:
        return float(number)
    except OverflowError:
        return inf if number > 0 else -inf


class Axis:
    """The planes of one axis of a grid that is being chosen, as tribox_grid has them."""

    def __init__(self, origin):
        self.origin = origin

    def plane(self, number, cell):
        return double(Fraction(number) * Fraction(cell) + Fraction(self.origin)) if isfinite(cell) else cell

    def steps(self, end, step):
        """(end - origin) / step, where the difference alone may overflow."""
        length = end - self.origin
        return length / step if isfinite(length) else end / step - self.origin / step

    def cell_reaching(self, cells, end):
        """The least cell with which `cells` of them reach the end."""
        cell = self.steps(end, cells)
        while self.plane(cells, cell) < end:
            cell = nextafter(cell, inf)
        return cell

    def cells_reaching(self, cell, end):
        """The least number of cells that reach the end, at least one; too many for a grid where there are."""
        steps = self.steps(end, cell)
        if not steps < SIZE_MAX:
            return SIZE_MAX + 1
        cells = max(1, floor(steps) - 1)
        while self.plane(cells, cell) < end:
            cells += 1
        return cells


def bounds_for(held_):
    bounds = bounds_of(held_)
    if bounds is None:
        raise InputError("triangles has none whose coordinates are all finite: there is nothing to lay a grid around")
    return bounds


def around(bounds, cells, **given):
    """The grid of such cells that starts at the lower bounds and reaches the upper."""
    lo, hi = bounds
    sizes = tuple(Axis(start).cells_reaching(cell, end) for start, cell, end in zip(lo, cells, hi))
    if max(sizes) > SIZE_MAX:
        axis = "xyz"[sizes.index(max(sizes))]
        raise InputError(f"the grid has more than 2^32 - 1 cells along the {axis} axis; give larger cells: {named(given)}",
                         "BAD_GRID")
    try:
        return Grid(lo, cells, sizes)
    except InputError as error:
        raise InputError(f"{str(error).partition(': origin')[0]}: {named(given)}", error.status) from None


def by_cell(held_, cell):
    cells, bounds = cells_of(cell), bounds_for(held_)
    if not all(0 < length < inf for length in cells):
        raise InputError(f"cell = {shown(cell)}; give lengths greater than zero, and finite", "BAD_GRID")
    return around(bounds, cells, cell=cell)


def by_resolution(held_, resolution):
    count = whole(resolution, 1, SIZE_MAX >> 1)
    if count is None:
        raise InputError(f"resolution = {shown(resolution)}; give how many cells, an int from 1 to 2^31 - 1, are to lie along the "
                         "longest side")
    lo, hi = bounds = bounds_for(held_)
    if lo == hi:
        raise InputError(f"triangles all lie in one point, {tuple(lo)}, and have no longest side; give cell, or a grid")
    longest = max(range(3), key=lambda a: hi[a] - lo[a])
    return around(bounds, (Axis(lo[longest]).cell_reaching(count, hi[longest]),) * 3, resolution=resolution)


def grid_given(held_, grid, cell, resolution):
    """The Grid that a caller means by one of the three."""
    given = {name: value for name, value in (("grid", grid), ("cell", cell), ("resolution", resolution)) if value is not None}
    if not given:
        raise InputError(f"no grid; {WAYS}")
    if len(given) > 1:
        raise InputError(f"{named(given)}: these exclude each other; {WAYS}")
    if cell is not None:
        return by_cell(held_, cell)
    if resolution is not None:
        return by_resolution(held_, resolution)
    return grid if isinstance(grid, Grid) else grid_of(grid)


def grid_of(numbers):
    """A Grid of (origin, cell, size)."""
    try:
        origin, cell, size = numbers
    except (TypeError, ValueError):
        raise InputTypeError(f"grid = {shown(numbers)}; {WAYS}") from None
    return Grid(origin, cell, size)


def grid_around(triangles: TrianglesLike, resolution: Optional[SupportsIndex] = None, *, cell: Optional[Cell] = None) -> Grid:
    """The Grid that holds the triangles: of cubes, `resolution` of them along the longest side, or of cells of a given length.

    triangles: as for voxelize; those with a NaN or an infinity do not count. resolution: a whole number from 1 on. cell: the length
        of a cell, or three.

    Its origin is the lower corner of the box around the triangles, and its planes reach the upper corner. With a resolution, the
    cell is the longest side over the resolution, or the next larger number with which the planes reach that corner. The program
    tribox chooses the same grid. Raises InputError if no triangle is finite, or if all lie in one point and a resolution is given.
    """
    return grid_given(held(triangles), None, cell, resolution)
