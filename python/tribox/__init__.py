"""Which of many triangles overlap a box, or the cells of a grid? Exactly, on NumPy arrays.

    >>> import numpy as np, tribox
    >>> triangles = np.array([[[0, 0, 0], [2, 0, 0], [0, 2, 0]], [[5, 5, 5], [6, 5, 5], [5, 6, 5]]], np.float32)
    >>> tribox.overlap(triangles, (-1, -1, -1), (1, 1, 1))
    array([ True, False])
    >>> tribox.voxelize(triangles, origin=(0, 0, 0), cell=1, size=(3, 3, 1)).astype(int)
    array([[[1, 1, 1],
            [1, 1, 0],
            [1, 0, 0]]])

Triangles are an array of shape (n, 3, 3), a Mesh of vertices and faces, or a Soup of nine streams. They are float32 and are read
in place; an array that would have to be copied is an error, which says how to convert it. Converting float64 to float32 rounds:
where coordinates are large, subtract an origin first.

Triangles that are asked about many boxes belong in an Index, whose answers are the same and come hundreds of times as fast:

    >>> index = tribox.Index(triangles)
    >>> index.list((-1, -1, -1), (1, 1, 1))
    array([0], dtype=uint32)

Boxes and triangles contain their borders: touching is overlap. By default answers are exact for every finite float32 input. A
triangle with a NaN or an infinity overlaps nothing. Lone numbers (bounds of a box, a grid) are rounded to float32. Whatever is
wrong with an argument is a tribox.Error. Calls release the interpreter's lock, so threads run at once.

The library is the installed libtribox.so.0, or the file that the environment variable TRIBOX_LIBRARY names.
"""

from ._errors import BadIndexError, Error, InputError, InputTypeError
from ._index import Index
from ._library import VERSION, kernel_name, kernels, lib
from ._masks import mask_indices
from ._overlap import classify, overlap, overlap_all, overlap_any, overlap_boxes, overlap_oriented
from ._triangles import Mesh, Soup
from ._voxelize import voxelize

AXES_BOX, AXES_PLANE, AXES_EDGES = lib.TRIBOX_AXES_BOX, lib.TRIBOX_AXES_PLANE, lib.TRIBOX_AXES_EDGES
AXES_ALL = lib.TRIBOX_AXES_ALL
__version__ = VERSION
__all__ = [
    "AXES_ALL", "AXES_BOX", "AXES_EDGES", "AXES_PLANE", "BadIndexError", "Error", "Index", "InputError", "InputTypeError", "Mesh",
    "Soup", "classify", "kernel_name", "kernels", "mask_indices", "overlap", "overlap_all", "overlap_any", "overlap_boxes",
    "overlap_oriented", "voxelize",
]
