"""Triangles into the cells of a grid."""

from operator import index
from typing import Optional, SupportsIndex, Tuple, Union, overload

import numpy as np

from ._arguments import check, options_of
from ._errors import InputError, check_indices, named, shown
from ._ffi import ffi
from ._fill import fill_of, filled
from ._grids import WORDS_MAX, Grid, check_grid, cubes_around, grid_for, is_single
from ._library import lib
from ._masks import WORD, bools, check_out, pointer_to
from ._overlap import ALL
from ._threads import in_threads, processors, threads_of
from ._triangles import Part, Soup, held, meshes, soups, widened
from ._typing import Accuracy, Answer, Cell, Cells, Fill, Range, TrianglesLike, Vector, Window

PARTS_EACH = 4  # slabs of each thread: some have far more triangles than others
# Where threads gain something, as measured with two of them:
SHARED_LEAST = 1 << 19  # triangles: fewer are done before their cells are joined,
CELLS_OF_ONE = 1  # as are those of fewer than one for so many words of cells
SLABS = range(1 << 21, 1 << 22)  # words of cells: more are fresh pages, which threads take from the system in turn
MANY_CELLS = 64  # words of cells a triangle: from there on it is cells that take the time, and not looking at triangles again


def window_of(window, layers, grid):
    """(first, size) of the cells that are wanted, all by default."""
    sizes = tuple(grid.size)
    if layers is not None and window is not None:
        raise InputError("layers and window exclude each other; a window can be of whole layers")
    if layers is not None:
        first, count = layers_of(layers, sizes[2])
        return (0, 0, first), (*sizes[:2], count)
    if window is None:
        return (0, 0, 0), sizes
    try:
        first, size = (tuple(map(index, three)) for three in window)
        (_, _, _), (_, _, _) = first, size
    except (TypeError, ValueError):
        first, size = (-1,) * 3, sizes
    if any(f < 0 or s < 0 or f + s > all_ for f, s, all_ in zip(first, size, sizes)):
        raise InputError(f"window = {shown(window)}; give (first, size), each of three numbers of cells, x, y, z, within the "
                         f"{sizes[0]} x {sizes[1]} x {sizes[2]} cells of the grid")
    return first, size


def layers_of(layers, size):
    """(first, count), within the grid."""
    try:
        first, count = map(index, layers)
    except (TypeError, ValueError):
        first, count = -1, 0
    if first < 0 or count < 0 or first + count > size:
        raise InputError(f"layers = {shown(layers)}; give (first, count) within the {size} layers")
    return first, count


def check_room(shape, **given):
    """Raises that there are too many words for a call to write."""
    words = shape[0] * shape[1] * shape[2]
    if words > WORDS_MAX:
        raise InputError(f"the cells take {words / 2 ** 27:.4g} GiB, a bit per cell, and can take {WORDS_MAX >> 27} at most; give "
                         f"a window, or fewer cells: {named(given)}", "BAD_GRID")


def set_cells(held_, grid, first, size, options, words):
    """Sets the bits of a window of a grid; returns the status."""
    check_indices(held_)
    if not all(size):
        return 0
    if is_single(grid):
        for _, soup in soups(held_):
            status = lib.tribox_voxelize_window(soup, grid, first, size, options, pointer_to(words), ffi.NULL)
            if status:
                return status
        return 0
    for _, mesh in meshes(held_):
        status = lib.tribox_voxelize_f64(mesh, grid, first, size, options, pointer_to(words), ffi.NULL)
        if status:
            return status
    return 0


def cut(count, parts):
    """(first, end) of so many parts of about one size."""
    return [(count * part // parts, count * (part + 1) // parts) for part in range(parts)]


def set_slabs(held_, grid, first, size, options, words, threads):
    """The same by threads, each of which owns some layers. Every part looks at all triangles."""
    held_ = Soup.of(held_) if is_single(grid) else widened(held_)  # once, not in each part

    def work(slab):
        low, high = slab
        corner, part = (*first[:2], first[2] + low), (*size[:2], high - low)
        return set_cells(held_, grid, corner, part, options, words[low:high])

    return max(in_threads(threads, work, cut(size[2], min(size[2], threads * PARTS_EACH))))


def set_shares(held_, grid, first, size, options, words, threads):
    """The same by threads, each of which has some of the triangles, and all cells but the first's for itself."""
    check_indices(held_)  # of the whole, for what an error says
    own = [words] + [np.zeros_like(words) for _ in range(1, threads)]

    def work(number):
        share = Part(held_, *cut(held_.struct.count, threads)[number])
        return set_cells(share, grid, first, size, options, own[number])

    status = max(in_threads(threads, work, range(threads)))
    for cells in own[1:]:
        np.bitwise_or(words, cells, out=words)
    return status


def set_cells_at_once(held_, grid, first, size, options, words, threads):
    """The same by as many threads as gain something: never more than there are processors, and one where neither way pays."""
    threads, count = min(threads, processors()), held_.struct.count
    if threads > 1 and words.size in SLABS and words.size >= MANY_CELLS * count:
        return set_slabs(held_, grid, first, size, options, words, threads)
    if threads > 1 and count >= SHARED_LEAST and words.size <= CELLS_OF_ONE * count:
        return set_shares(held_, grid, first, size, options, words, threads)
    return set_cells(held_, grid, first, size, options, words)


@overload
def voxelize(triangles: TrianglesLike, *, resolution: SupportsIndex, window: Optional[Window] = None,
             layers: Optional[Range] = None, threads: Optional[SupportsIndex] = 1, fill: Optional[Fill] = None,
             accuracy: Accuracy = "exact", axes: int = ALL, kernel: Optional[str] = None, packed: bool = False,
             out: Optional[Answer] = None) -> Tuple[Answer, Grid]: ...


@overload
def voxelize(triangles: TrianglesLike, origin: Vector, cell: Cell, size: Cells, *, window: Optional[Window] = None,
             layers: Optional[Range] = None, threads: Optional[SupportsIndex] = 1, fill: Optional[Fill] = None,
             accuracy: Accuracy = "exact", axes: int = ALL, kernel: Optional[str] = None, packed: bool = False,
             out: Optional[Answer] = None) -> Answer: ...


def voxelize(triangles: TrianglesLike, origin: Optional[Vector] = None, cell: Optional[Cell] = None, size: Optional[Cells] = None,
             *, resolution: Optional[SupportsIndex] = None, window: Optional[Window] = None, layers: Optional[Range] = None,
             threads: Optional[SupportsIndex] = 1, fill: Optional[Fill] = None, accuracy: Accuracy = "exact", axes: int = ALL,
             kernel: Optional[str] = None, packed: bool = False,
             out: Optional[Answer] = None) -> Union[Answer, Tuple[Answer, Grid]]:
    """Tells which cells of a grid some triangle overlaps, the surface alone: an array of bool of shape (nz, ny, nx).

    triangles: as for overlap; one with a NaN or an infinity sets no cell.
    origin: the lower corner of the grid. cell: the length of a cell, or three; both in the unit of the triangles. size: the cells
        on each axis, (nx, ny, nz).
        Plane p lies at origin + p * cell, rounded to float32 where triangles, origin and cell are float32 and that tells all planes
        apart, and else to float64: the number 0.1 is the double, np.float32(0.1) the float, which is faster.
    resolution: in their place, the number of cells along the longest side of the triangles: the grid is that of grid_around, and
        the answer is (cells, grid).
    window: ((i, j, k), (ni, nj, nk)) for the ni x nj x nk cells from cell (i, j, k) on alone, with the same exact answers as for
        the whole: for tasks, and for grids of any size, as only the bits of the window take memory, 16 GiB at most.
    layers: (first, count) for these layers along z alone.
    threads: how many may share the work, where that gains time: with many triangles, or with many cells and few triangles; never
        more than there are processors. None for one on each processor. The answers do not depend on it.
    fill: "outside" sets every cell, too, that cannot be reached from outside the grid through faces of cells that are clear;
        "parity" those from whose middle a ray along x crosses the triangles an odd number of times, which holes of a mesh do not
        empty, and warns (OpenMeshWarning) where the mesh is certainly not closed. For whole grids.
    packed: returns uint64 words of shape (nz, ny, words) instead; bit i % 64 of word i // 64 of a row is cell i along x.
    out: an array of either kind, in which cells are set; those already set stay set.

    Raises errors as overlap does: also for a grid whose planes float64 cannot tell apart, and for one that needs more than 16 GiB.
    """
    held_, options, threads, fill_call = held(triangles), options_of(accuracy, axes, 0, kernel), threads_of(threads), fill_of(fill)
    grid, chosen, given = grid_given(held_, resolution, origin=origin, cell=cell, size=size)
    check_grid(grid, options, axes, **given)
    if fill_call and (window is not None or layers is not None):
        raise InputError("fill needs the whole grid: what is outside a part of it may be inside the whole")
    first, count = window_of(window, layers, grid)
    shape, packed_shape = count[::-1], (*count[:0:-1], (count[0] + 63) >> 6)
    check_room(packed_shape, **given)
    words = None
    if out is not None:
        packed = check_out(out, shape, packed_shape)
        words = out if packed and not fill_call else None
    if words is None:
        words = np.zeros(packed_shape, WORD)
    check(set_cells_at_once(held_, grid, first, count, options, words, threads), axes=axes)
    if fill_call:
        words = filled(fill_call, held_, grid, words)
    answer = merged(words, shape, packed, out)
    return answer if chosen is None else (answer, chosen)


def grid_given(held_, resolution, **numbers):
    """The grid, the Grid that was chosen for the triangles or None, and what the caller gave."""
    given = {name: value for name, value in numbers.items() if value is not None}
    if resolution is None:
        if not given:
            raise InputError("no grid is given; give origin, cell and size, or resolution")
        return grid_for(held_, **numbers), None, numbers
    if given:
        raise InputError(f"resolution chooses origin, cell and size; do not give it with {named(given)}")
    return *cubes_around(held_, resolution), dict(resolution=resolution)


def merged(words, shape, packed, out):
    """The answer in the form that the caller wants it in."""
    if out is None:
        return words if packed else bools(words, shape[2])
    if out is not words:
        np.bitwise_or(out, words if packed else bools(words, shape[2]), out=out)
    return out
