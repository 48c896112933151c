"""Triangles into the cells of a grid, and what they enclose."""

from __future__ import annotations

import mmap
import warnings
from typing import Optional, SupportsIndex, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _c
from ._arguments import check, meaning, options_of, range_of
from ._errors import Brief, InputError, InputTypeError, shown
from ._ffi import ffi
from ._grids import grid_given, struct_of
from ._library import lib
from ._masks import WORD, pointer_to, row_words
from ._overlap import ALL, check_answer
from ._sharing import Task
from ._threads import threads_of
from ._tiles import window_ids
from ._triangles import COUNT_MAX, check_count, held
from ._typing import Accuracy, Cell, Fill, GridLike, Range, TrianglesLike, Window
from ._voxels import Voxels, colors_of, window_of

LARGE_PAGE = 1 << 21
# From here on malloc of glibc takes fresh pages for every array, and gives them back. Less is mostly used again, and clearing it
# takes less than fresh pages, which NumPy asks to be large, too.
MAPPED = 1 << 25
CAN_MAP = hasattr(mmap, "MADV_HUGEPAGE")


def mapped(count):
    """So many words of fresh pages, which are clear. They are given back with the last array that looks at them."""
    octets = -(-8 * count // LARGE_PAGE) * LARGE_PAGE
    try:
        pages = mmap.mmap(-1, octets + LARGE_PAGE, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
    except OSError as error:
        raise MemoryError(f"no memory for {octets} bytes of cells") from error
    words = np.frombuffer(pages, WORD)
    start = -words.ctypes.data % LARGE_PAGE
    try:
        pages.madvise(mmap.MADV_HUGEPAGE, start, octets)
    except OSError:  # a system without them: it is slower and no other
        pass
    return words[start // 8:start // 8 + count]


def new_words(shape):
    """(words, whether they are clear): others are to be cleared by who writes them."""
    count = shape[0] * shape[1] * shape[2]
    if CAN_MAP and 8 * count >= MAPPED:
        return mapped(count).reshape(shape), True
    return np.empty(shape, WORD), False


class OpenMeshWarning(UserWarning, metaclass=Brief):
    """A mesh is certainly not closed, so its inside is not well defined; or nothing was found inside."""


def fill_outside(held_, grid, words, scratch, solid):
    check(lib.tribox_fill_outside(tuple(grid.size), words, scratch, solid, ffi.NULL))


def fill_parity(held_, grid, words, scratch, solid, is_of_middles=False):
    odd = ffi.new("size_t *")
    check(_c.fill_parity(held_, grid, words, scratch, solid, ffi.NULL, odd))
    if odd[0]:
        warnings.warn(f"the mesh is not closed: {odd[0]} of {grid.size[1] * grid.size[2]} rows of cells cross it an odd number of "
                      'times, and are filled to their end; fill="outside" only requires that no hole is larger than a cell',
                      OpenMeshWarning, stacklevel=5 if is_of_middles else 4)


def fill_middles(*arguments):
    """Parity of the middles: the words have no surface."""
    fill_parity(*arguments, is_of_middles=True)


FILLS = {"outside": fill_outside, "parity": fill_parity, "middles": fill_middles}


def fill_of(word):
    """The call that a word stands for, or None."""
    call = meaning(word, FILLS)
    if call is None and word is not None:
        raise InputError(f"fill = {shown(word)}; give None or one of {', '.join(map(repr, FILLS))}")
    return call


def filled(call, held_, grid, words):
    """The cells of a surface and those inside."""
    solid, scratch = np.empty_like(words), np.empty(lib.tribox_fill_bytes(tuple(grid.size)), np.uint8)
    call(held_, grid, pointer_to(words), ffi.from_buffer(scratch), pointer_to(solid))
    if call is fill_outside and np.array_equal(solid, words):
        warnings.warn('fill = "outside" fills nothing: the surface is open by a cell or more, or encloses none; give larger cells '
                      'if it has holes, smaller ones if its walls are near to each other, or fill = "parity"', OpenMeshWarning,
                      stacklevel=3)
    return solid


WORDS_MAX = 1 << 31  # of one call


def window_wanted(window, layers, grid):
    """(first, size) of the cells that are wanted, all by default."""
    if layers is None:
        return window_of(window, grid)
    if window is not None:
        raise InputError("layers and window exclude each other; a window can be of whole layers")
    first, count = range_of("layers", layers, grid.size[2], "layers")
    return (0, 0, first), (*grid.size[:2], count)


def new_cells(shape, grid):
    """Words for the cells of a window, and whether they are clear."""
    nz, ny, nx = shape
    words = nz * ny * row_words(nx)
    if words > WORDS_MAX:
        raise InputError(f"the cells take {words / 2 ** 27:.4g} GiB, a bit per cell, and can take {WORDS_MAX >> 27} at most; give "
                         f"a window, or fewer cells, or ask tribox.bricks: {grid}", "BAD_GRID")
    return new_words((nz, ny, row_words(nx)))


def check_into(into, grid, window):
    if not isinstance(into, Voxels):
        raise InputTypeError(f"into = {shown(into)}; give Voxels, to which the cells are added")
    if (into.grid, into.window) != (grid, window):
        raise InputError(f"into has the cells {into.window} of {into.grid}, and not {window} of {grid}; give its grid and window")


def check_thin(options, fill_call):
    if options.accuracy or options.axes not in (0, ALL):
        raise InputError('thin = True is exact and of all axes; leave out accuracy and axes', "BAD_OPTION")
    if fill_call is fill_middles:
        raise InputError('fill = "middles" has no cells of the surface; leave out thin, or give fill = "parity"')


def check_labels(fill_call, into):
    if fill_call is None or fill_call is fill_middles:
        raise InputError('labels = True tells the surface from what it encloses; give fill = "outside" or "parity"')
    if into is not None:
        raise InputError("labels and into exclude each other: labels are of one mesh")


def check_ids_wanted(what, fill_call, into, thin):
    if fill_call or into is not None:
        raise InputError(f"{what} are those of triangles that overlap a cell; voxelize with {what}, but without fill and into")
    if thin:
        raise InputError(f"{what} are those of all triangles that overlap a cell; leave out thin")


def colors_wanted(triangles, colors, count):
    """Of each triangle."""
    if colors is True:
        colors = getattr(triangles, "face_colors", None)
        if colors is None:
            colors = getattr(getattr(triangles, "visual", None), "face_colors", None)
        if colors is None:
            raise InputError("colors = True, and triangles has no face_colors; give an array of uint8 of shape (n, 3), red, green "
                             "and blue of each triangle")
    return colors_of(colors, count, "triangle")


def voxelize(triangles: TrianglesLike, grid: Optional[GridLike] = None, *, cell: Optional[Cell] = None,
             resolution: Optional[SupportsIndex] = None, window: Optional[Window] = None, layers: Optional[Range] = None,
             thin: bool = False, fill: Optional[Fill] = None, labels: bool = False, threads: Optional[SupportsIndex] = 1,
             accuracy: Accuracy = "exact", axes: int = ALL, kernel: Optional[str] = None, into: Optional[Voxels] = None,
             ids: bool = False, colors: Union[bool, ArrayLike, None] = None) -> Voxels:
    """Marks the cells of a grid that any triangle overlaps, the surface alone: returns Voxels, a boolean array with its grid.

        voxelize(mesh, cell=0.05)        a grid around the mesh, of cells of this length; cell=(x, y, z) if they are not cubes
        voxelize(mesh, resolution=256)   a grid around the mesh, of cubes, this many along its longest side
        voxelize(mesh, grid)             tribox.Grid(origin, cell, size), or (origin, cell, size)

    triangles: as for overlap; one with a NaN or an infinity sets no cell.
    window: ((i, j, k), (ni, nj, nk)) for only the ni x nj x nk cells from cell (i, j, k) on, with the same exact answers as for the
        whole grid. Use it for tasks, and for grids of any size: only the bits of the window take memory, at most 16 GiB.
    layers: (first, count) for only these layers along z.
    thin: about half of these cells: those in which a triangle crosses a line through the middle along x, y or z. A flat surface is
        then one cell thick, and still does not leak: no path across faces of cells leads through it, but one across edges may.
        Exact, with all axes.
    fill: "outside" also sets every cell that cannot be reached from outside the grid across faces of clear cells, and warns
        (OpenMeshWarning) if there is none; "parity" also those from whose middle a ray along x crosses the triangles an odd number
        of times, so that a hole does not empty the inside, and warns if the mesh is certainly not closed; "middles" sets only
        those, without the cells of the surface, as VTK's stencils and PyVista do. Whole grids only.
    labels: with fill, tells the cells of the surface from those inside: voxels.labels() are 1 and 2, voxels.inside has only the
        cells inside, and files hold the labels. Not with into.
    threads: how many may share the work, never more than there are processors; used if they save time: with many triangles, or with
        many cells and few triangles. 1 by default, 0 for one on each processor. The answers do not depend on it.
    into: Voxels of the same grid and window, to which the cells are added, and which are returned. They lose their ids, labels and
        colors. Nothing else changes Voxels in place.
    ids: True for Voxels whose ids say which triangle is in a cell: for each set cell the lowest number of a triangle that overlaps
        it, in the order of cells(). A look-up turns ids into colours, materials, parts: face_colors[voxels.ids]. Only for the
        surface, without fill and into. It takes two to three times as long, and four bytes a cell for some layers at a time.
    colors: of the triangles, uint8 of shape (n, 3), for Voxels with colors: each cell has the colour of the triangle that ids would
        name. True for the colours of the mesh: face_colors of tribox.read, or visual.face_colors of trimesh. Not with ids.
    accuracy, axes, kernel: as for overlap.

    Raises errors as overlap does; also for a grid in which two planes round to the same double, or which needs over 16 GiB.
    """
    held_, options, threads, fill_call = held(triangles), options_of(accuracy, axes, 0, kernel), threads_of(threads), fill_of(fill)
    chosen = grid_given(held_, grid, cell, resolution)
    if fill_call and (window is not None or layers is not None):
        raise InputError("fill needs the whole grid: what is outside a part of it may be inside the whole")
    of_triangles = None if colors is None or colors is False else colors_wanted(triangles, colors, len(held_))
    if ids and of_triangles is not None:
        raise InputError("ids and colors exclude each other; voxelize with ids, and give voxels.with_colors(colors[voxels.ids])")
    wanted_of_cells = "colors" if of_triangles is not None else "ids" if ids else None
    if wanted_of_cells:
        check_ids_wanted(wanted_of_cells, fill_call, into, thin)
    if thin:
        check_thin(options, fill_call)
    if labels:
        check_labels(fill_call, into)
    wanted = window_wanted(window, layers, chosen)
    if into is not None:
        check_into(into, chosen, wanted)
    words, are_clear = new_cells(wanted[1][::-1], chosen) if into is None or fill_call else (into._words, True)
    struct = struct_of(chosen)
    task = Task(held_, struct, wanted[0], wanted[1], options, words, are_clear, _c.voxelize_thin if thin else _c.voxelize)
    if wanted_of_cells:
        check_count(held_, "ids", COUNT_MAX - 1)
        found = window_ids(task, threads)
        voxels = Voxels(words, chosen, wanted)
        return voxels._with_ids(found) if of_triangles is None else voxels.with_colors(of_triangles[found])
    if fill_call is not fill_middles:
        check_answer(held_, task.run(threads))
    elif not are_clear:
        words[...] = 0
    surface = words
    if fill_call:
        words = filled(fill_call, held_, struct, surface)
    if into is not None:
        return into._add(words)
    voxels = Voxels(words, chosen, wanted)
    return voxels._with_inside(words & ~surface) if labels else voxels
