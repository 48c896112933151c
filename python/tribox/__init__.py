"""Which of many triangles overlap a box, or the cells of a grid? Exactly, on NumPy arrays.

    >>> import numpy as np, tribox
    >>> triangles = np.array([[[0, 0, 0], [2, 0, 0], [0, 2, 0]], [[5, 5, 5], [6, 5, 5], [5, 6, 5]]], np.float32)
    >>> tribox.overlap(triangles, (-1, -1, -1), (1, 1, 1))
    array([ True, False])
    >>> tribox.voxelize(triangles, origin=(0, 0, 0), cell=1, size=(3, 3, 1)).astype(int)
    array([[[1, 1, 1],
            [1, 1, 0],
            [1, 0, 0]]])

Triangles are an array of shape (n, 3, 3), a Mesh of vertices and faces, a mesh of trimesh, Open3D, PyVista or meshio as it is, or a
Soup of nine streams. Coordinates, boxes and cells are in one unit of length, whatever that is. float32 and float64 are read in
place, rows and columns alike; lists, whole numbers and other layouts are copied. Nothing is rounded: numbers that cannot be taken
as they are, are an error that says which and what to do.

    >>> utm = triangles + np.array([557820.1, 5108010.2, 700.3])
    >>> tribox.overlap(utm, (557820, 5108010, 700), (557821, 5108011, 701))
    array([ True, False])

Triangles that are asked about many boxes belong in an Index, whose answers are the same and come hundreds of times as fast:

    >>> index = tribox.Index(triangles)
    >>> index.list((-1, -1, -1), (1, 1, 1))
    array([0], dtype=uint32)

A grid can be laid around a mesh, voxelized by threads, filled, and asked for a window of its cells. Where its cells need not fit
into memory it comes as bricks of 8 x 8 x 8 cells, those that are not empty:

    >>> cells, grid = tribox.voxelize(triangles, resolution=64, threads=2, fill="outside")
    >>> cells.shape, grid.size
    ((54, 64, 64), (64, 64, 54))
    >>> at, bits = tribox.bricks(triangles, *tribox.grid_around(triangles, 4096))
    >>> at.shape, bits.shape
    ((18532, 3), (18532, 8))

For many machines partition() sorts a mesh by tiles of the grid into a folder, of which each task maps what it needs: see Partition,
and examples/engines, which run it with Dask, MPI and Slurm.

Boxes and triangles contain their borders: touching is overlap. By default answers are exact for every finite input, float32 or
float64; bounds of boxes and grids are taken as they are, too: 0.1 is the double, np.float32(0.1) the float, which is faster where
triangles are float32. Only oriented boxes are float32 throughout. Indices and Soups hold float32; of larger numbers they are made
about an origin. A triangle with a NaN or an infinity overlaps nothing. Whatever is wrong with an argument is a tribox.Error. Calls
release the interpreter's lock, so threads run at once.

The library is that in the wheel, or else the installed libtribox.so.0; the environment variable TRIBOX_LIBRARY may name another.
All is typed; tribox.TrianglesLike is the type of what is taken for triangles.
"""

from ._bricks import Bricks, bricks
from ._errors import BadIndexError, Error, InputError, InputTypeError
from ._fill import OpenMeshWarning
from ._grids import Grid, grid_around
from ._index import Index
from ._library import VERSION, kernel_name, kernels, lib
from ._masks import mask_indices
from ._overlap import classify, overlap, overlap_all, overlap_any, overlap_boxes, overlap_oriented
from ._partition import Partition, partition
from ._tiles import tile_count
from ._triangles import Mesh, Soup
from ._typing import TrianglesLike as TrianglesLike
from ._voxelize import voxelize

AXES_BOX, AXES_PLANE, AXES_EDGES = lib.TRIBOX_AXES_BOX, lib.TRIBOX_AXES_PLANE, lib.TRIBOX_AXES_EDGES
AXES_ALL = lib.TRIBOX_AXES_ALL
__version__ = VERSION
__all__ = [
    "AXES_ALL", "AXES_BOX", "AXES_EDGES", "AXES_PLANE", "BadIndexError", "Bricks", "Error", "Grid", "Index", "InputError",
    "InputTypeError", "Mesh", "OpenMeshWarning", "Partition", "Soup", "bricks", "classify", "grid_around",
    "kernel_name", "kernels", "mask_indices", "overlap", "overlap_all", "overlap_any", "overlap_boxes", "overlap_oriented",
    "partition", "tile_count", "voxelize",
]
