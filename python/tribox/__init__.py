"""Which of many triangles overlap a box, or the cells of a grid? Exactly, on NumPy arrays.

    >>> import numpy as np, tribox
    >>> triangles = np.array([[[0, 0, 0], [2, 0, 0], [0, 2, 0]], [[5, 5, 5], [6, 5, 5], [5, 6, 5]]], np.float32)
    >>> tribox.overlap(triangles, (-1, -1, -1), (1, 1, 1))
    array([ True, False])

The names of the module, each with a help() of its own:

    read(path)            the mesh of a file of any format that the program reads
    overlap, find, overlap_any, overlap_all, classify, overlap_boxes, overlap_oriented, split, crop
                          triangles and a box; OrientedBox is a turned box
    Index                 many boxes: .list(), .lists(), .count(), .any(), .overlap()
    voxelize              Voxels: .points(), .cells(), .labels(), .ids, .colors, .inside, .with_colors(), .save(), Voxels.load(),
                          and all that arrays have; in a Grid, or grid_around() the mesh
    bricks                Bricks, of grids beyond memory: .points(), .cells(), .voxels(), .save(), Bricks.load()
    cell_lists            CellLists: all triangles of each cell
    Mesh, Soup            triangles as the library reads them: convert once, and give them to many calls

Triangles are an array of shape (n, 3, 3), a Mesh of vertices and faces, a mesh of trimesh, Open3D, PyVista or meshio, or a Soup of
nine streams. Coordinates, boxes and cells are in the same unit of length, whichever it is. float32 and float64 are read in place,
rows and columns alike; lists, whole numbers and other layouts are copied. Nothing is rounded: if a number cannot be taken as it is,
an error names the argument and says what to do.

    >>> utm = triangles + np.array([557820.1, 5108010.2, 700.3])
    >>> tribox.overlap(utm, (557820, 5108010, 700), (557821, 5108011, 701))
    array([ True, False])

For many boxes about the same triangles make an Index, which gives the same answers, up to hundreds of times as fast:

    >>> index = tribox.Index(utm)
    >>> index.list((557820, 5108010, 700), (557821, 5108011, 701))
    array([0], dtype=uint32)
    >>> numbers, start = index.lists(utm.min(1), utm.max(1))    # of the bounds of each triangle, rows
    >>> numbers[start[1]:start[2]]
    array([1], dtype=uint32)

crop() makes a mesh of the triangles in a box, with their original numbers, by which attributes can be looked up:

    >>> part = tribox.crop(utm, (557820, 5108010, 700), (557821, 5108011, 701))
    >>> part.faces, part.face_numbers
    (array([[0, 1, 2]], dtype=uint32), array([0]))

voxelize() returns Voxels, an array of bool that knows its grid. The grid is laid around the mesh, or given:

    >>> voxels = tribox.voxelize(triangles, cell=0.1)
    >>> voxels.shape, voxels.sum(), voxels.grid.size
    ((50, 60, 60), 292, (60, 60, 50))
    >>> tribox.voxelize(triangles, resolution=64, thin=True, threads=2)
    <tribox.Voxels: 297 of 64 x 64 x 54 cells, from (0, 0, 0) to (6, 6, 5.0625)>
    >>> tribox.voxelize(triangles, tribox.Grid(origin=(0, 0, 0), cell=1, size=(3, 3, 1))).astype(int)
    array([[[1, 1, 1],
            [1, 1, 0],
            [1, 0, 0]]])
    >>> voxels.points()[:1]
    array([[0.05, 0.05, 0.05]])

With ids, Voxels say which triangle is in a cell, the lowest of several. Look attributes of triangles up by ids, and they become
attributes of cells. Colours go into files by with_colors(), or at once by voxelize(..., colors=colours):

    >>> voxels = tribox.voxelize(triangles, resolution=4, ids=True)
    >>> colours = np.array([[255, 0, 0], [0, 0, 255]], np.uint8)    # of each triangle; of trimesh: mesh.visual.face_colors
    >>> voxels.ids
    array([0, 0, 0, 1], dtype=uint32)
    >>> voxels.with_colors(colours[voxels.ids]).colors[-1]    # and .save("cells.vox")
    array([  0,   0, 255], dtype=uint8)

A grid too large for memory comes as bricks of 8 x 8 x 8 cells, without the empty ones:

    >>> bricks = tribox.bricks(triangles, resolution=4096)
    >>> bricks.at.shape, bricks.bits.shape
    ((18532, 3), (18532, 8))

cell_lists() says which triangles are in which cell, in the order of voxels.cells():

    >>> lists = tribox.cell_lists(triangles, cell=0.1)
    >>> lists.cells[40], lists.triangles[lists.start[40]:lists.start[41]]
    (array([0, 2, 0], dtype=uint32), array([0], dtype=uint32))
    >>> lowest = lists.triangles[lists.start[:-1]]    # one for each cell: colours[lowest] are its colours

read() and some formats of save() run the program tribox: the one that the environment variable TRIBOX_PROGRAM names, that of the
wheel, which has neither libassimp for glTF nor OpenVDB, or the one on PATH. For meshes larger than memory, and for many machines,
use the program itself: examples/engines run it with Dask, MPI and Slurm.

Boxes and triangles contain their borders: touching is overlap. By default answers are exact for every finite input, float32 or
float64. Bounds of boxes and planes of grids are doubles: 0.1 is the double, np.float32(0.1) the float. A Soup holds float32. A
triangle with a NaN or an infinity overlaps nothing. A wrong argument raises a tribox.Error. Calls use one thread; threads=0 takes
one for each processor. They release the interpreter's lock, so your threads run in parallel.

The library is the one in the wheel, or else the installed libtribox.so.1; the environment variable TRIBOX_LIBRARY may name another.
Everything is typed; tribox.TrianglesLike is the type of what can be passed as triangles.
"""

from ._boxes import OrientedBox
from ._bricks import Bricks, bricks
from ._cells import CellLists, cell_lists
from ._errors import BadIndexError, Error, InputError, InputTypeError
from ._grids import Grid, grid_around
from ._index import Index
from ._library import VERSION, kernel_name, kernels, lib
from ._masks import mask_indices
from ._overlap import Cropped, classify, crop, find, overlap, overlap_all, overlap_any, overlap_boxes, overlap_oriented, split
from ._program import read
from ._tiles import tile_count
from ._triangles import Mesh, Soup
from ._typing import TrianglesLike as TrianglesLike
from ._voxelize import OpenMeshWarning, voxelize
from ._voxels import Voxels

AXES_BOX, AXES_PLANE, AXES_EDGES = lib.TRIBOX_AXES_BOX, lib.TRIBOX_AXES_PLANE, lib.TRIBOX_AXES_EDGES
AXES_ALL = lib.TRIBOX_AXES_ALL
__version__ = VERSION
__all__ = [
    "AXES_ALL", "AXES_BOX", "AXES_EDGES", "AXES_PLANE", "BadIndexError", "Bricks", "CellLists", "Cropped", "Error", "Grid", "Index",
    "InputError", "InputTypeError", "Mesh", "OpenMeshWarning", "OrientedBox", "Soup", "Voxels", "bricks", "cell_lists",
    "classify", "crop", "find", "grid_around", "kernel_name", "kernels", "mask_indices", "overlap", "overlap_all", "overlap_any",
    "overlap_boxes", "overlap_oriented", "read", "split", "tile_count", "voxelize",
]
