"""Triangles in NumPy arrays as the structs of the library: pointers into the arrays, without copies where it can read them."""

from __future__ import annotations

import os
from typing import Any, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arguments import DOUBLE, FLOAT, address_of, array_of, check_floats, first_of, numbers, place_of
from ._errors import BadIndexError, Brief, InputError, InputTypeError, check_indices, error_of
from ._ffi import ffi
from ._library import lib
from ._typing import MeshLike, TrianglesLike


def bounds_of(held_):
    """The least and the greatest x, y, z of all triangles that are finite; None if there is none."""
    if held_.is_soup:
        streams = [stream for axis in held_.streams for stream in axis]
        is_used = np.logical_and.reduce([np.isfinite(stream) for stream in streams])
        if not is_used.any():
            return None
        used = [[stream[is_used] for stream in axis] for axis in held_.streams]
        return [[float(min(map(np.min, axis))) for axis in used], [float(max(map(np.max, axis))) for axis in used]]
    points, is_finite = held_.vertices, np.isfinite(held_.vertices)
    if held_.faces is None:
        is_used = np.repeat(is_finite.all((1, 2)), 3)
        points = points.reshape(-1, 3)
    else:
        check_indices(held_)
        is_used, faces = np.zeros(len(points), bool), held_.faces
        is_used[faces if is_finite.all() else faces[is_finite.all(1)[faces].all(1)]] = True
    if not is_used.any():
        return None
    points = points if is_used.all() else points[is_used]
    axes = [points[:, a] for a in range(3)]  # one by one, many times as fast
    return [[axis.min().item() for axis in axes], [axis.max().item() for axis in axes]]


def point(numbers):
    """As it looks in a repr."""
    return f"({', '.join(format(number, '.7g') for number in numbers)})"


def extent(held_):
    """Their bounds, for a repr, which raises nothing."""
    try:
        bounds = bounds_of(held_)
    except BadIndexError:
        return "with wrong indices"
    return "without bounds" if bounds is None else f"from {point(bounds[0])} to {point(bounds[1])}"


NO_AREA = "vertex", "line"  # cells that no box is asked about


def as_they_are(mesh, faces):
    return faces


def of_blocks(mesh, cells):
    """The triangles of meshio, whose cells come by kind."""
    others = [kind for kind in cells if kind != "triangle" and kind not in NO_AREA]
    if others:
        raise InputError(f"triangles has cells of kind {', '.join(map(repr, others))}; make triangles of them, or give "
                         'tribox.Mesh(mesh.points, mesh.cells_dict["triangle"]) for those that are triangles alone')
    return cells.get("triangle", np.empty((0, 3), np.uint32))


def of_polygons(mesh, faces):
    """The triangles of PyVista, where each face is the number of its vertices and then these."""
    faces = np.asarray(faces)
    if faces.ndim != 1:
        return faces
    if faces.size % 4 or (faces[::4] != 3).any() or getattr(mesh, "n_strips", 0):
        raise InputError("triangles has faces that are no triangles, or strips; give mesh.triangulate()")
    return faces.reshape(-1, 4)[:, 1:]


# trimesh, Open3D, meshio, PyVista, and whatever is like them.
FORMS = (("vertices", "faces", as_they_are), ("vertices", "triangles", as_they_are), ("points", "cells_dict", of_blocks),
         ("points", "faces", of_polygons))


def advice_about(what):
    """What to give in place of something that is often taken for triangles; None if it is not known."""
    if isinstance(what, (str, bytes, os.PathLike)):
        return "tribox.read(path), the mesh of a file"
    if hasattr(what, "GetPolys"):
        return "pyvista.wrap(polydata).triangulate()"
    if hasattr(what, "geometry") and hasattr(what, "graph"):
        return "scene.to_mesh(), or in older versions of trimesh scene.dump(concatenate=True)"
    if isinstance(what, (list, tuple)) and what and parts_of(what[0]):
        return "one of them a call, with into= in voxelize; or one mesh made of all"
    return None


def parts_of(mesh):
    """(name, vertices, name, faces) of a mesh; None if it is none."""
    for vertices, faces, triangles_of in FORMS:
        if hasattr(mesh, vertices) and hasattr(mesh, faces):
            return vertices, getattr(mesh, vertices), faces, triangles_of(mesh, getattr(mesh, faces))
    return None


INDEX = np.dtype(np.uint32)
INDEX_BYTES = {np.dtype(np.uint16): 2, INDEX: 4, np.dtype(np.int32): 4}
MESH, SOUP = ffi.typeof("tribox_mesh *"), ffi.typeof("tribox_soup *")


USUAL = 0, 0, 0, 0


def layout_of(count, stride, axis_stride, item):
    """Where the lowest x, y or z begins, stride, axis_stride and axes of a tribox_mesh for vertices so far apart; None if no mesh
    can be. 0, as there, is the usual."""
    if count <= 1:
        stride = 0
    if axis_stride < 0:  # array[:, ::-1]
        begin, axis_stride, axes = 2 * axis_stride, -axis_stride, 321
    else:
        begin, axes = 0, 0
    if axis_stride == item and (count <= 1 or stride >= 3 * item):
        return begin, stride, 0, axes
    return (begin, stride, axis_stride, axes) if axis_stride >= item and (count <= 1 or stride >= item) else None


def faces_of(name, faces, vertices):
    """Faces as the library reads them: the caller's array, or a copy whose indices are then known to be right."""
    array = array_of(name, faces)
    if array.dtype.kind not in "iu":
        raise InputTypeError(f"{name} is {type(faces).__name__} of {array.dtype}; give whole numbers, the numbers of three "
                             "vertices for each triangle")
    if array.ndim != 2 or array.shape[1] != 3:
        raise InputError(f"{name} has shape {array.shape}; give (n, 3): triangle, vertex")
    if array.dtype in INDEX_BYTES:
        return np.ascontiguousarray(array)
    wrong = array >= vertices if array.dtype.kind == "u" else (array < 0) | (array >= vertices)
    if wrong.any():
        raise BadIndexError(f"{name}[{place_of(wrong)}] is {first_of(array, wrong)}, but there are {vertices} vertices; "
                            f"wrong indices in all: {np.count_nonzero(wrong)}", "BAD_VERTEX")
    if vertices > 1 << 32 and array.size and array.max() > np.iinfo(INDEX).max:
        raise InputError(f"{name} refers to vertices beyond 2^32, and an index has 32 bits; give fewer vertices at a time")
    return np.ascontiguousarray(array, INDEX)


def layout_of_triangles(triangles):
    """layout_of() for an array of shape (n, 3, 3)."""
    count, (per_triangle, per_vertex, per_axis) = len(triangles), triangles.strides
    if count <= 1 or per_triangle == 3 * per_vertex:
        return layout_of(3 * count, per_vertex, per_axis, triangles.itemsize)
    return None


class Mesh(metaclass=Brief):
    """Vertices of shape (m, 3) and faces of shape (n, 3), the numbers of their vertices: Mesh(vertices, faces).

    vertices: arrays of float32 and float64 are read in place, with any distance between vertices and between axes: rows, columns
        (order="F"), fields of a structured dtype, axes turned round ([:, ::-1], for a grid whose rows run along z). Other real
        numbers and lists are copied, without rounding.
    faces: arrays of uint16, uint32 and int32 are read in place if contiguous; other whole numbers and lists are copied.

    Mesh(mesh) takes a mesh of another library, once for many calls: one that has `vertices` and `faces` (trimesh), `vertices` and
    `triangles` (Open3D), `points` and `faces` (PyVista), or `points` and `cells_dict` (meshio). It also takes a tuple (vertices,
    faces), an array of shape (n, 3, 3), and nested lists of such a shape. Every call takes all of these, too.

    Coordinates are in the unit of boxes and grids. A triangle with a NaN or an infinity overlaps nothing.

    Raises InputError, InputTypeError or BadIndexError if vertices or faces cannot be taken. Indices that are read in place are
    checked by each call.
    """

    __slots__ = "_vertices", "_faces", "_face_colors", "struct"
    is_soup = False
    _vertices: NDArray[Any]
    _faces: Optional[NDArray[Any]]
    _face_colors: Optional[NDArray[np.uint8]]
    struct: Any

    def __init__(self, vertices: Union[TrianglesLike, MeshLike], faces: Optional[ArrayLike] = None) -> None:
        if faces is not None:
            self._index("vertices", vertices, "faces", faces)
        elif isinstance(vertices, (Mesh, Soup)):
            other = Mesh(by_number(vertices, slice(None))) if isinstance(vertices, Soup) else vertices
            self._vertices, self._faces, self.struct = other._vertices, other._faces, other.struct
        elif isinstance(vertices, tuple) and len(vertices) == 2:
            self._index("vertices", vertices[0], "faces", vertices[1])
        else:
            parts = None if isinstance(vertices, np.ndarray) else parts_of(vertices)
            if parts:
                self._index(*parts)
            else:
                self._take(array_of_triangles(vertices))

    def _index(self, vertices_name, vertices, faces_name, faces):
        """The names are those by which the caller knows the arrays."""
        vertices = numbers(vertices_name, vertices)
        if vertices.ndim != 2 or vertices.shape[1] != 3:
            raise InputError(f"{vertices_name} has shape {vertices.shape}; give (m, 3): vertex, axis")
        count = len(vertices)
        layout = layout_of(count, *vertices.strides, vertices.itemsize)
        if not layout:
            vertices, layout = np.ascontiguousarray(vertices), USUAL
        begin, stride, axis_stride, axes = layout
        faces = faces_of(faces_name, faces, count)
        self._vertices, self._faces = vertices, faces
        if faces.dtype.kind == "i":
            count = min(count, 1 << 31)  # negative numbers, read as unsigned, refer to no vertex
        start, first = ffi.cast("void *", address_of(vertices) + begin), ffi.cast("void *", address_of(faces))
        self.struct = ffi.new(MESH, (start, stride, count, first, faces.itemsize, len(faces), vertices.itemsize, axis_stride, axes))

    def _take(self, triangles):
        """An array of shape (n, 3, 3)."""
        layout = USUAL if triangles.flags.c_contiguous else layout_of_triangles(triangles)
        if not layout:
            triangles, layout = np.ascontiguousarray(triangles), USUAL
        begin, stride, axis_stride, axes = layout
        count = len(triangles)
        self._vertices, self._faces = triangles, None
        start = ffi.cast("void *", address_of(triangles) + begin) if stride or begin else ffi.from_buffer(triangles)
        self.struct = ffi.new(MESH, (start, stride, 3 * count, ffi.NULL, 0, count, triangles.itemsize, axis_stride, axes))

    @property
    def vertices(self) -> NDArray[Any]:
        """The array that is read, of shape (m, 3), or (n, 3, 3) if there are no faces. For other vertices make another Mesh."""
        return self._vertices

    @property
    def faces(self) -> Optional[NDArray[Any]]:
        """The array that is read; None if every three vertices are a triangle."""
        return self._faces

    @property
    def face_colors(self) -> Optional[NDArray[np.uint8]]:
        """uint8 of shape (n, 3) if tribox.read made the mesh from a file with colours; else None."""
        return getattr(self, "_face_colors", None)

    def __len__(self) -> int:
        return int(self.struct.count)

    def __reduce__(self) -> Any:
        return mesh_of, (self.vertices, self.faces, self.face_colors)

    def __repr__(self) -> str:
        what = "triangles" if self.faces is None else f"faces of {self.faces.dtype}"
        return (f"<tribox.Mesh: {self.struct.vertices} vertices of {self.vertices.dtype}, {len(self)} {what}, {extent(self)}>")


def mesh_of(vertices, faces, face_colors):
    """A Mesh with colours of its faces, or None."""
    mesh = Mesh(vertices, faces)
    mesh._face_colors = face_colors
    return mesh


class Soup(metaclass=Brief):
    """Triangles as nine streams, the fastest form: streams[axis][vertex] is a contiguous array of n float32. Arrays are not copied.

    streams: an array of shape (3, 3, n), or sequences of nine arrays. Soup.of(triangles) makes one of triangles in any form.
    """

    faces, is_soup = None, True

    def __init__(self, streams: Union[NDArray[Any], Sequence[Any]]) -> None:
        try:
            nested = tuple(tuple(axis) for axis in streams) if len(streams) == 3 else ()
        except TypeError:
            raise InputTypeError(f"streams is of type {type(streams).__name__}; give an array of shape (3, 3, n)") from None
        if [len(axis) for axis in nested] != [3, 3, 3]:
            raise InputError("streams must hold three axes of three vertices each: shape (3, 3, n)")
        for stream in (stream for axis in nested for stream in axis):
            if not isinstance(stream, np.ndarray) or stream.dtype != FLOAT:
                raise InputTypeError(f"a stream is {getattr(stream, 'dtype', type(stream).__name__)}; streams are NumPy arrays of "
                                     "float32: tribox.Soup.of(triangles) makes them of other forms")
            if stream.ndim != 1 or len(stream) != len(nested[0][0]) or len(stream) > 1 and stream.strides[0] != 4:
                raise InputError(f"a stream has shape {stream.shape} and strides {stream.strides}; give nine contiguous "
                                 "arrays of one length")
        self._arrays = nested  # what the struct points into: a container may hand out copies, or change
        is_whole = isinstance(streams, np.ndarray) and streams.dtype == FLOAT
        self._streams: Union[NDArray[Any], Sequence[Any]] = streams if is_whole else nested
        pointers = [[ffi.cast("float *", address_of(stream)) for stream in axis] for axis in nested]
        self.struct = ffi.new(SOUP, (*pointers, len(nested[0][0])))

    @property
    def streams(self) -> Union[NDArray[Any], Sequence[Any]]:
        """The array of shape (3, 3, n) that is read, or the nine arrays, as tuples."""
        return self._streams

    def __len__(self) -> int:
        return int(self.struct.count)

    def __repr__(self) -> str:
        return f"<tribox.Soup: {len(self)} triangles, {extent(self)}>"

    @classmethod
    def of(cls, triangles: TrianglesLike) -> Soup:
        """A copy of triangles in any form as streams: for float32 triangles that are used in many calls.

        Nothing is rounded: float64 that float32 cannot hold is an error.
        """
        held_ = held(triangles)
        if held_.is_soup:
            return cls(np.array(held_.streams, order="C"))
        check_floats("triangles" if held_.faces is None else "vertices", held_.vertices)
        check_indices(held_)
        soup = cls(np.empty((3, 3, held_.struct.count), FLOAT))
        to = soup.struct
        check_sound(lib.tribox_mesh_to_soup(held_.struct, ffi.NULL, 0, to.count, ffi.NULL, to.x, to.y, to.z))
        return soup


def check_sound(status):
    """For calls that cannot fail but for a fault of this module's."""
    if status:
        raise error_of(status)


def array_of_triangles(triangles):
    advice = None if isinstance(triangles, np.ndarray) else advice_about(triangles)
    if advice:
        raise InputTypeError(f"triangles is of type {type(triangles).__name__}; give {advice}")
    array = numbers("triangles", triangles, "in an array of shape (n, 3, 3), or a mesh")
    if array.shape[1:] != (3, 3):
        raise InputError(f"triangles has shape {array.shape}; give (n, 3, 3): triangle, vertex, axis; or tribox.Mesh(vertices, "
                         "faces)")
    return array


def held(triangles):
    """Triangles in any form as a Mesh or a Soup: what has a struct, and keeps alive what that points to."""
    if isinstance(triangles, (Mesh, Soup, Part)):
        return triangles
    if not isinstance(triangles, np.ndarray):
        return Mesh(triangles)
    array = array_of_triangles(triangles)
    if array.dtype == FLOAT and array.strides[0] == 4 and not layout_of_triangles(array):
        return Soup(array.T)
    mesh = Mesh.__new__(Mesh)
    mesh._take(array)
    return mesh


COUNT_MAX = 1 << 32  # of triangles whose numbers are uint32


def check_count(held_, what, most=COUNT_MAX):
    """Refuses more triangles than have numbers. what: has these."""
    if held_.struct.count > most:
        raise InputError(f"triangles are {held_.struct.count}, and {what} can be of {most} at most; give them in parts")


def is_double(held_):
    """Whether coordinates are of float64."""
    return not held_.is_soup and held_.vertices.dtype == DOUBLE


class Part:
    """Triangles first to before end of others, where these lie."""

    __slots__ = "whole", "faces", "struct", "is_soup"

    def __init__(self, held_, first, end):
        self.whole = held_  # it keeps alive what the struct points to
        self.is_soup, self.faces = held_.is_soup, held_.faces
        if held_.is_soup:
            streams = ([stream + first for stream in axis] for axis in (held_.struct.x, held_.struct.y, held_.struct.z))
            self.struct = ffi.new(SOUP, (*streams, end - first))
            return
        self.struct = ffi.new(MESH, held_.struct[0])
        self.struct.count = end - first
        if held_.faces is not None:
            self.struct.indices = bytes_on(self.struct.indices, 3 * first * self.struct.index_bytes)
            return
        stride = self.struct.stride or 3 * self.struct.position_bytes
        self.struct.positions = bytes_on(self.struct.positions, 3 * first * stride)
        self.struct.vertices = 3 * (end - first)


def bytes_on(pointer, count):
    return ffi.cast("char *", pointer) + count


def by_number(held_, numbers_):
    """Triangles with these numbers, as an array of shape (n, 3, 3)."""
    if held_.is_soup:
        return np.stack([np.stack([stream[numbers_] for stream in axis], 1) for axis in held_.streams], 2)
    if held_.faces is not None:
        return held_.vertices[held_.faces[numbers_]]
    return np.ascontiguousarray(held_.vertices[numbers_])
