"""Do these triangles overlap this box, or these cells of a grid? Exactly, for very many triangles at once, on NumPy arrays.

    >>> import numpy as np, tribox
    >>> triangles = np.array([[[0, 0, 0], [2, 0, 0], [0, 2, 0]], [[5, 5, 5], [6, 5, 5], [5, 6, 5]]], np.float32)
    >>> tribox.overlap(triangles, (-1, -1, -1), (1, 1, 1))
    array([ True, False])
    >>> tribox.voxelize(triangles, origin=(0, 0, 0), cell=1, size=(3, 3, 1)).astype(int)
    array([[[1, 1, 1],
            [1, 1, 0],
            [1, 0, 0]]])

Triangles are given as they are held: an array of shape (n, 3, 3), a Mesh of vertices and faces, or a Soup of nine streams. They are
float32 and are read in place; what would need a copy is an error that tells how to make it.

Box and triangle contain their borders: touching is overlap. By default answers are exact for every finite float32 input. A triangle
with a NaN or an infinity overlaps nothing. Lone numbers (bounds of a box, a grid) are rounded to float32. Every error is a
tribox.Error. Calls release the lock of the interpreter, so threads run at once.

The library is the installed libtribox.so.0, or the file that the environment variable TRIBOX_LIBRARY names.
"""

from ._errors import BadIndexError, Error, InputError, InputTypeError
from ._library import kernel_name, lib
from ._masks import mask_indices
from ._overlap import classify, overlap, overlap_all, overlap_any, overlap_boxes, overlap_oriented
from ._triangles import Mesh, Soup
from ._voxelize import voxelize

AXES_BOX, AXES_PLANE, AXES_EDGES = lib.TRIBOX_AXES_BOX, lib.TRIBOX_AXES_PLANE, lib.TRIBOX_AXES_EDGES
AXES_ALL = lib.TRIBOX_AXES_ALL
__version__ = f"{lib.TRIBOX_VERSION_MAJOR}.{lib.TRIBOX_VERSION_MINOR}.{lib.TRIBOX_VERSION_PATCH}"
__all__ = [
    "AXES_ALL", "AXES_BOX", "AXES_EDGES", "AXES_PLANE", "BadIndexError", "Error", "InputError", "InputTypeError", "Mesh", "Soup",
    "classify", "kernel_name", "mask_indices", "overlap", "overlap_all", "overlap_any", "overlap_boxes", "overlap_oriented",
    "voxelize",
]
