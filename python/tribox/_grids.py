"""Grids of cells: from what callers write, or around their triangles, and what may be wrong with them."""

from fractions import Fraction
from math import floor, inf, isfinite, nextafter
from operator import index
from typing import NamedTuple, SupportsIndex, Tuple

import numpy as np

from ._arguments import are_floats, check, three
from ._bounds import bounds_of
from ._errors import InputError, named, shown
from ._ffi import ffi
from ._library import lib
from ._numbers import DOUBLE, FLOAT
from ._triangles import held
from ._typing import TrianglesLike

GRID, GRID_F64 = ffi.typeof("tribox_grid *"), ffi.typeof("tribox_grid_f64 *")
WORDS_MAX = 1 << 31  # of one call
SIZE_MAX = (1 << 32) - 1  # cells along an axis


class Grid(NamedTuple):
    """A grid, as origin, cell and size of tribox.voxelize and tribox.bricks: tribox.bricks(mesh, *grid)."""

    origin: Tuple[float, float, float]
    cell: Tuple[float, float, float]
    size: Tuple[int, int, int]


def is_lone(value):
    try:
        iter(value)
    except TypeError:
        return True
    return False


def grid_of(origin, cell, size):
    """A grid of floats where they hold its numbers and tell its planes apart, else of doubles."""
    cells = three("cell", (cell,) * 3 if is_lone(cell) else cell)
    start = three("origin", origin)
    try:
        numbers = start, cells, tuple(map(index, size))
        _, _, (_, _, _) = numbers
        grid = ffi.new(GRID_F64, numbers)
    except (OverflowError, TypeError, ValueError):
        raise InputError(f"size = {shown(size)}; give three numbers of cells, x, y, z, each less than 2^32") from None
    if are_floats(*start, *cells):
        single = ffi.new(GRID, numbers)
        if status_of(single) == lib.TRIBOX_OK:
            return single
    return grid


def in_double(grid):
    return grid if ffi.typeof(grid) is GRID_F64 else ffi.new(GRID_F64, (tuple(grid.origin), tuple(grid.cell), tuple(grid.size)))


def is_single(grid):
    """Whether the planes of a grid are floats."""
    return ffi.typeof(grid) is GRID


def has_doubles(held_):
    """Whether triangles are of float64, so that planes are too."""
    return not held_.is_soup and held_.vertices.dtype == DOUBLE


def status_of(grid, options=ffi.NULL):
    """What the library says to a voxelization of no triangles."""
    word = ffi.new("uint64_t *")
    if is_single(grid):
        return lib.tribox_voxelize_layers(ffi.new("tribox_soup *"), grid, 0, 0, options, word, ffi.NULL)
    return lib.tribox_voxelize_f64(ffi.new("tribox_mesh *"), grid, (0, 0, 0), (1, 1, 1), options, word, ffi.NULL)


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
    """What is wrong with an axis of a grid; None if nothing is."""
    if not isfinite(origin) or not isfinite(cell):
        return f"the origin or the cell is not finite on the {axis} axis"
    if not cell > 0 or not size:
        return f"the cell or the size is not greater than zero on the {axis} axis"
    if not status_of(ffi.new(GRID_F64, ((origin, 0, 0), (cell, 1, 1), (size, 1, 1)))):
        return None
    if not isfinite(origin + size * cell):
        return f"the grid ends beyond the largest float64 on the {axis} axis"
    enough = sufficient_cell(origin, size)
    larger = f"cells of {enough:.17g} are large enough, or" if isfinite(enough) else "choose fewer cells, or"
    return f"float64 cannot tell cells of {cell:.17g} apart on the {axis} axis, so far from 0; {larger} move the origin towards 0"


def check_grid(grid, options, axes, **given):
    """Raises what is wrong with a grid or the options, before memory is taken for cells. given: the grid as the caller has it."""
    status = status_of(grid, options)
    if status == lib.TRIBOX_BAD_GRID:
        faults = (fault_of_axis(axis, grid.origin[a], grid.cell[a], grid.size[a]) for a, axis in enumerate("xyz"))
        raise InputError(f"{next(filter(None, faults))}: {named(given)}", "BAD_GRID")
    check(status, axes=axes)


def grid_for(held_, origin, cell, size):
    """The grid of these numbers that suits these triangles."""
    grid = grid_of(origin, cell, size)
    return in_double(grid) if has_doubles(held_) else grid


def single(number):
    """Rounded to float32; infinite beyond it."""
    with np.errstate(over="ignore", under="ignore"):
        return float(FLOAT.type(number))


def double(number):
    """The double nearest to a rational number; infinite beyond them."""
    try:
        return float(number)
    except OverflowError:
        return inf if number > 0 else -inf


class Axis:
    """The planes of one axis of a grid that is being chosen, as tribox_grid and tribox_grid_f64 have them."""

    def __init__(self, origin, is_float):
        self.origin, self.is_float = origin, is_float

    def plane(self, number, cell):
        if self.is_float:
            return single(self.origin + number * cell)
        return double(Fraction(number) * Fraction(cell) + Fraction(self.origin)) if isfinite(cell) else cell

    def steps(self, end, step):
        """(end - origin) / step, where the difference alone may overflow."""
        length = end - self.origin
        return length / step if isfinite(length) else end / step - self.origin / step

    def next(self, cell):
        return float(np.nextafter(FLOAT.type(cell), FLOAT.type(inf))) if self.is_float else nextafter(cell, inf)

    def cell_reaching(self, cells, end):
        """The least cell with which `cells` of them reach the end."""
        cell = self.steps(end, cells)
        cell = single(cell) if self.is_float else cell
        while self.plane(cells, cell) < end:
            cell = self.next(cell)
        return cell

    def cells_reaching(self, cell, end):
        """The least number of cells that reach the end, at least one."""
        cells = max(1, floor(self.steps(end, cell)) - 1)
        while self.plane(cells, cell) < end:
            cells += 1
        return cells


def cubes(bounds, resolution, is_float):
    """The grid of cubes around bounds, `resolution` of them along the longest side."""
    lo, hi = bounds
    longest = max(range(3), key=lambda a: hi[a] - lo[a])
    axes = [Axis(number, is_float) for number in lo]
    cell = axes[longest].cell_reaching(resolution, hi[longest])
    return Grid(tuple(lo), (cell,) * 3, tuple(axis.cells_reaching(cell, end) for axis, end in zip(axes, hi)))


def resolution_of(value):
    try:
        resolution = index(value)
    except TypeError:
        resolution = 0
    if not 1 <= resolution <= SIZE_MAX >> 1:
        raise InputError(f"resolution = {shown(value)}; give how many cells, 1 to 2^31 - 1, are to lie along the longest side")
    return resolution


def cubes_around(held_, resolution):
    """The grid of grid_around, as it is and as a Grid."""
    count, bounds = resolution_of(resolution), bounds_of(held_)
    if bounds is None:
        raise InputError("triangles has none whose coordinates are all finite: there is nothing to lay a grid around")
    if bounds[0] == bounds[1]:
        raise InputError(f"triangles all lie in one point, {tuple(bounds[0])}, and have no longest side; give origin, cell and "
                         "size")
    if not has_doubles(held_):
        chosen = cubes(bounds, count, True)
        grid = grid_of(*chosen)
        if is_single(grid):
            return grid, chosen
    chosen = cubes(bounds, count, False)
    return grid_for(held_, *chosen), chosen


def grid_around(triangles: TrianglesLike, resolution: SupportsIndex) -> Grid:
    """The Grid of cubes that holds the triangles, `resolution` of them along their longest side, as the program tribox chooses it.

    triangles: as for voxelize; those with a NaN or an infinity do not count. resolution: a whole number from 1 on.

    Its origin is the lower corner of the box around the triangles; the cell is the smallest with which the planes reach the upper.
    Raises InputError where no triangle is finite, or where all lie in one point.
    """
    grid, chosen = cubes_around(held(triangles), resolution)
    check_grid(grid, ffi.NULL, None, resolution=resolution)
    return chosen
