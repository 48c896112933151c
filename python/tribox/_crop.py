"""The mesh of the triangles in a box, or of the others."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, Iterator, Optional

import numpy as np
from numpy.typing import NDArray

from ._boxes import OrientedBox
from ._errors import InputError
from ._overlap import ALL, classify, overlap, overlap_oriented
from ._triangles import INDEX, by_number, held
from ._typing import Accuracy, Region, TrianglesLike, Vector


@dataclass(frozen=True, eq=False)
class Cropped:
    """Some triangles of a mesh: vertices, faces, face_numbers, vertex_numbers = tribox.crop(mesh, lo, hi).

    Attributes of faces and vertices are looked up by them: colors[face_numbers], normals[vertex_numbers].
    """

    vertices: NDArray[Any]
    """Those that a face has, as they were, in the order of the mesh: of shape (k, 3), float32 or float64."""
    faces: NDArray[np.uint32]
    """The faces in the order of the mesh, of shape (m, 3): numbers of these vertices."""
    face_numbers: NDArray[np.intp]
    """Which triangles of the mesh they are."""
    vertex_numbers: NDArray[np.intp]
    """Which vertices of the mesh they are; for triangles without faces 3 * triangle + corner."""

    def __iter__(self) -> Iterator[NDArray[Any]]:
        return iter((self.vertices, self.faces, self.face_numbers, self.vertex_numbers))


def crop(triangles: TrianglesLike, lo: Region, hi: Optional[Vector] = None, *, inside: bool = False, rest: bool = False,
         accuracy: Accuracy = "exact", axes: int = ALL, axis_order: int = 0, kernel: Optional[str] = None) -> Cropped:
    """The mesh of the triangles that overlap the box, whole and as they were: vertices, faces, face_numbers, vertex_numbers.

        >>> part = tribox.crop(mesh, (0, 0, 0), (10, 10, 10))
        >>> colors = mesh.visual.face_colors[part.face_numbers]
        >>> rest = tribox.crop(mesh, (0, 0, 0), (10, 10, 10), rest=True)

    triangles: as for overlap, meshes of other libraries included.
    lo, hi: as for overlap; or lo alone, an OrientedBox.
    inside: only those that lie wholly inside; not with an OrientedBox.
    rest: all other triangles instead, so that each triangle is in one of the two meshes.

    Nothing is cut or merged: a triangle across the border is in the part, with all three corners. A vertex that no face of the
    result uses is left out. Other arguments and errors are as for overlap.
    """
    held_ = held(triangles)
    options: Dict[str, Any] = {"accuracy": accuracy, "axes": axes, "axis_order": axis_order, "kernel": kernel}
    if isinstance(lo, OrientedBox):
        if inside or hi is not None:
            raise InputError("inside is for boxes from lo to hi, and hi for those alone; give an OrientedBox without them")
        mask = overlap_oriented(held_, *lo, **options)
    else:
        mask = classify(held_, lo, hi, **options)[1] if inside else overlap(held_, lo, hi, **options)
    numbers = np.flatnonzero(~mask if rest else mask)
    if held_.faces is None:
        corners = 3 * numbers[:, None] + np.arange(3)
        return Cropped(by_number(held_, numbers).reshape(-1, 3), np.arange(corners.size, dtype=INDEX).reshape(-1, 3), numbers,
                       corners.ravel())
    corners = held_.faces[numbers]
    is_used = np.zeros(len(held_.vertices), bool)
    is_used[corners] = True
    used = np.flatnonzero(is_used)
    places = np.cumsum(is_used, dtype=INDEX) - INDEX.type(1)
    return Cropped(held_.vertices[used], places[corners], numbers, used)
