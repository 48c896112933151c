"""Triangles in NumPy arrays as the structs of the library: pointers into the arrays, without copies where it can read them."""

from typing import Any, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arguments import finite_three
from ._bounds import extent
from ._errors import BadIndexError, InputError, InputTypeError, check_indices, error_of
from ._ffi import ffi
from ._library import lib
from ._meshes import parts_of
from ._numbers import DOUBLE, FLOAT, array_of, first_of, floats, numbers, place_of
from ._typing import MeshLike, TrianglesLike, Vector

INDEX = np.dtype(np.uint32)
INDEX_BYTES = {np.dtype(np.uint16): 2, INDEX: 4, np.dtype(np.int32): 4}
MESH, SOUP, INDICES = ffi.typeof("tribox_mesh *"), ffi.typeof("tribox_soup *"), ffi.typeof("uint32_t[]")
BLOCK = 1 << 16  # triangles: as streams they are 2.3 MB, and blocks start at whole words of a mask
WIDE_BLOCK = 1 << 12  # the same, as doubles: 295 KB, which fit a cache
LOCAL = ("this call is about float32: give an origin near the triangles, which tribox.Soup.of and tribox.Index subtract before "
         "they round, or ask tribox.overlap, classify or voxelize, which take float64 as it is")

NOWHERE = 0.0, 0.0, 0.0  # an origin that moves nothing

new, from_buffer, NULL = ffi.new, ffi.from_buffer, ffi.NULL


def check_floats(name, array):
    if not isinstance(array, np.ndarray) or array.dtype != FLOAT:
        raise InputTypeError(f"{name} is {getattr(array, 'dtype', type(array).__name__)}; streams are NumPy arrays of "
                             "float32: tribox.Soup.of(triangles, origin=...) makes them of other numbers")


def address_of(array):
    """Where an array begins. from_buffer takes contiguous arrays alone."""
    return ffi.cast("void *", array.__array_interface__["data"][0])


def strides_of(count, stride, axis_stride, item):
    """(stride, axis_stride) of a tribox_mesh for vertices so far apart; None if no mesh can be. 0, as there, is the usual."""
    if count <= 1:
        stride = 0
    if axis_stride == item and (count <= 1 or stride >= 3 * item):
        return stride, 0
    return (stride, axis_stride) if axis_stride >= item and (count <= 1 or stride >= item) else None


class Array:
    """An array of shape (n, 3, 3) as a tribox_mesh."""

    __slots__ = "vertices", "faces", "struct", "is_double"
    is_soup = False

    def __init__(self, triangles, stride, axis_stride):
        count = len(triangles)
        self.vertices, self.faces = triangles, None
        start = address_of(triangles) if stride else from_buffer(triangles)
        self.struct = new(MESH, (start, stride, 3 * count, NULL, 0, count, triangles.itemsize, axis_stride))
        self.is_double = triangles.dtype == DOUBLE or axis_stride != 0


def array_held(triangles):
    """An array of shape (n, 3, 3) as an Array or, where it is stored as nine streams of float32, as a Soup."""
    shape = triangles.shape
    if shape[1:] != (3, 3):
        raise InputError(f"triangles has shape {shape}; give (n, 3, 3): triangle, vertex, axis")
    if triangles.flags.c_contiguous:
        return Array(triangles, 0, 0)
    per_triangle, per_vertex, per_axis = triangles.strides
    if shape[0] <= 1 or per_triangle == 3 * per_vertex:
        strides = strides_of(3 * shape[0], per_vertex, per_axis, triangles.itemsize)
        if strides:
            return Array(triangles, *strides)
    if triangles.dtype == FLOAT and per_triangle == 4:
        return Soup(triangles.T)
    return Array(np.ascontiguousarray(triangles), 0, 0)


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


class Mesh:
    """Vertices of shape (m, 3) and faces of shape (n, 3), the numbers of their vertices.

    vertices: arrays of float32 and float64 are read in place, with any distance between vertices and between axes: rows, columns
        (order="F"), fields of a structured dtype. Other real numbers and lists are copied, without rounding.
    faces: arrays of uint16, uint32 and int32 are read in place if contiguous; other whole numbers and lists are copied.

    Coordinates are in whatever unit those of boxes and grids are in. A triangle with a NaN or an infinity overlaps nothing.

    Meshes of other libraries can be given to every call in place of a Mesh, and Mesh.of(mesh) saves copying their faces in each:
    what has `vertices` and `faces` (trimesh), `vertices` and `triangles` (Open3D), `points` and `faces` (PyVista), or `points` and
    `cells_dict` (meshio).

    Raises InputError, InputTypeError or BadIndexError where vertices or faces cannot be taken. Indices that are read in place are
    looked at by the calls.
    """

    is_soup = False

    def __init__(self, vertices: ArrayLike, faces: ArrayLike) -> None:
        self._set("vertices", vertices, "faces", faces)

    @classmethod
    def of(cls, mesh: MeshLike) -> "Mesh":
        """A Mesh of a mesh of another library, once and for many calls; a Mesh as it is.

        Raises InputTypeError where it has no vertices and faces, InputError where it has faces that are no triangles.
        """
        if isinstance(mesh, cls):
            return mesh
        made = foreign(mesh)
        if made is None:
            raise InputTypeError(f"mesh is of type {type(mesh).__name__}; give what has vertices and faces, as the meshes of "
                                 "trimesh, Open3D, PyVista and meshio have")
        return made

    def _set(self, vertices_name, vertices, faces_name, faces):
        """The names are those by which the caller knows the arrays."""
        vertices = numbers(vertices_name, vertices)
        if vertices.ndim != 2 or vertices.shape[1] != 3:
            raise InputError(f"{vertices_name} has shape {vertices.shape}; give (m, 3): vertex, axis")
        count = len(vertices)
        strides = strides_of(count, *vertices.strides, vertices.itemsize)
        if not strides:
            vertices, strides = np.ascontiguousarray(vertices), (0, 0)
        faces = faces_of(faces_name, faces, count)
        self._vertices, self._faces = vertices, faces
        if faces.dtype.kind == "i":
            count = min(count, 1 << 31)  # negative numbers, read as unsigned, refer to no vertex
        self.struct = new(MESH, (address_of(vertices), strides[0], count, address_of(faces), faces.itemsize, len(faces),
                                 vertices.itemsize, strides[1]))
        self.is_double = vertices.dtype == DOUBLE or strides[1] != 0

    @property
    def vertices(self) -> NDArray[Any]:
        """The array that is read. Other vertices are another Mesh."""
        return self._vertices

    @property
    def faces(self) -> NDArray[Any]:
        """The array that is read."""
        return self._faces

    def __len__(self) -> int:
        return len(self._faces)

    def __repr__(self) -> str:
        return (f"<tribox.Mesh: {len(self.vertices)} vertices of {self.vertices.dtype}, {len(self)} faces of {self.faces.dtype}, "
                f"{extent(self)}>")


class Soup:
    """Triangles as nine streams, the fastest form: streams[axis][vertex] is a contiguous array of n float32. Arrays are not copied.

    streams: an array of shape (3, 3, n), or sequences of nine arrays.
    """

    faces, is_soup, is_double = None, True, False

    def __init__(self, streams: Union[NDArray[Any], Sequence[Any]]) -> None:
        try:
            nested = tuple(tuple(axis) for axis in streams) if len(streams) == 3 else ()
        except TypeError:
            raise InputTypeError(f"streams is of type {type(streams).__name__}; give an array of shape (3, 3, n)") from None
        if [len(axis) for axis in nested] != [3, 3, 3]:
            raise InputError("streams must hold three axes of three vertices each: shape (3, 3, n)")
        for stream in (stream for axis in nested for stream in axis):
            check_floats("a stream", stream)
            if stream.ndim != 1 or len(stream) != len(nested[0][0]) or len(stream) > 1 and stream.strides[0] != 4:
                raise InputError(f"a stream has shape {stream.shape} and strides {stream.strides}; give nine contiguous "
                                 "arrays of one length")
        self._arrays = nested  # what the struct points into: a container may hand out copies, or change
        is_whole = isinstance(streams, np.ndarray) and streams.dtype == FLOAT
        self._streams: Union[NDArray[Any], Sequence[Any]] = streams if is_whole else nested
        pointers = [[ffi.cast("float *", address_of(stream)) for stream in axis] for axis in nested]
        self.struct = new(SOUP, (*pointers, len(nested[0][0])))

    @property
    def streams(self) -> Union[NDArray[Any], Sequence[Any]]:
        """The array of shape (3, 3, n) that is read, or the nine arrays, as tuples."""
        return self._streams

    def __len__(self) -> int:
        return int(self.struct.count)

    def __repr__(self) -> str:
        return f"<tribox.Soup: {len(self)} triangles, {extent(self)}>"

    @classmethod
    def of(cls, triangles: TrianglesLike, origin: Optional[Vector] = None) -> "Soup":
        """A copy of triangles in any form as streams: for triangles that are tested many times.

        origin: three numbers, which are subtracted in float64 before the coordinates are rounded to float32. Answers about the Soup
            are then about boxes with the origin subtracted as well, and exact about coordinates that are off by 2^-24 of their
            distance from it. Without an origin nothing is rounded: float64 that float32 cannot hold is an error.
        """
        held_ = held(triangles)
        if origin is None and held_.is_soup:
            return cls(np.array(held_.streams, order="C"))
        if origin is None:
            check_single(held_)
        origin = NOWHERE if origin is None else finite_three("origin", origin)
        check_indices(held_)
        soup = cls(np.empty((3, 3, held_.struct.count), FLOAT))
        for first, mesh in [(0, held_.struct)] if not held_.is_soup else meshes(held_):
            fill(soup.struct, first, mesh, 0, mesh.count, origin)
        return soup


def held(triangles):
    """Triangles in any form as a Mesh, a Soup or an Array: what has a struct, and keeps alive what that points to."""
    if isinstance(triangles, (Mesh, Soup, Array, Part)):
        return triangles
    mesh = None if isinstance(triangles, np.ndarray) else foreign(triangles)
    return array_held(numbers("triangles", triangles, "in an array of shape (n, 3, 3), or a mesh")) if mesh is None else mesh


def foreign(mesh):
    """A mesh of another library as a Mesh; None if it is none."""
    parts = parts_of(mesh)
    if parts is None:
        return None
    made = Mesh.__new__(Mesh)
    made._set(*parts[0], *parts[1])
    return made


def mesh_held(held_):
    """The same triangles as a Mesh or an Array: what has a tribox_mesh."""
    return array_held(np.stack([np.stack(axis, 1) for axis in held_.streams], 2)) if held_.is_soup else held_


def check_single(held_):
    """Raises what float32 cannot hold of the coordinates."""
    if not held_.is_soup:
        floats("triangles" if held_.faces is None else "vertices", held_.vertices, LOCAL)


def fill(soup, at, mesh, first, count, origin=None):
    """Copies triangles of a mesh with good indices to place `at` of the streams of a soup; with an origin, relative to it."""
    streams = [[stream + at for stream in axis] for axis in (soup.x, soup.y, soup.z)]
    streams = [new("float *[3]", axis) for axis in streams]
    if origin is None:
        status = lib.tribox_mesh_to_soup(mesh, first, count, NULL, *streams)
    else:
        status = lib.tribox_mesh_to_soup(mesh, origin, first, count, NULL, *streams)
    if status:
        raise error_of(status, first=first, count=count)


class Part:
    """Triangles first to before end of others, where these lie."""

    __slots__ = "whole", "vertices", "faces", "struct", "is_soup", "is_double"

    def __init__(self, held_, first, end):
        self.whole = held_  # it keeps alive what the struct points to
        self.is_soup, self.is_double, self.faces = held_.is_soup, held_.is_double, held_.faces
        self.vertices = None if held_.is_soup else held_.vertices
        if held_.is_soup:
            streams = ([stream + first for stream in axis] for axis in (held_.struct.x, held_.struct.y, held_.struct.z))
            self.struct = new(SOUP, (*streams, end - first))
            return
        self.struct = new(MESH, held_.struct[0])
        self.struct.count = end - first
        if held_.faces is not None:
            self.struct.indices = bytes_on(self.struct.indices, 3 * first * self.struct.index_bytes)
            return
        stride = self.struct.stride or 3 * self.struct.position_bytes
        self.struct.positions = bytes_on(self.struct.positions, 3 * first * stride)
        self.struct.vertices = 3 * (end - first)


def bytes_on(pointer, count):
    return ffi.cast("char *", pointer) + count


def widened(held_):
    """The same triangles with coordinates of float64, as a Mesh or an Array; themselves where they are a mesh of doubles."""
    if held_.is_double:
        return held_
    if held_.faces is not None:
        return Mesh(held_.vertices.astype(DOUBLE), held_.faces)
    return array_held(mesh_held(held_).vertices.astype(DOUBLE))


def soups(triangles):
    """Triangles in any form as tribox_soups, each with the number of its first triangle. The next soup overwrites the last."""
    held_ = held(triangles)
    struct = held_.struct
    if held_.is_soup:
        yield 0, struct
        return
    check_single(held_)
    check_indices(held_)
    origin = NOWHERE if held_.is_double else None
    block = Soup(np.empty((3, 3, min(struct.count, BLOCK)), FLOAT))
    for first in range(0, max(struct.count, 1), BLOCK):
        block.struct.count = min(struct.count - first, BLOCK)
        fill(block.struct, 0, struct, first, block.struct.count, origin)
        yield first, block.struct


def gathered(struct, order):
    """Triangles, by their numbers, as a Soup of their own."""
    soup = Soup(np.empty((3, 3, len(order)), FLOAT))
    call = lib.tribox_soup_gather if ffi.typeof(struct) is SOUP else lib.tribox_mesh_gather
    to = soup.struct
    status = call(struct, ffi.from_buffer(INDICES, order), 0, len(order), to.x, to.y, to.z)
    if status:
        raise error_of(status, triangles=len(order))
    return soup


def meshes(held_):
    """Triangles as tribox_meshes of doubles: those that are, whole; others, block by block, widened."""
    if held_.is_double:
        yield 0, held_.struct
        return
    block = Array(np.empty((max(1, min(held_.struct.count, WIDE_BLOCK)), 3, 3)), 0, 0)
    for start, soup in soups(held_):
        for first in range(0, max(soup.count, 1), WIDE_BLOCK):
            block.struct.count = min(soup.count - first, WIDE_BLOCK)
            for axis, streams in enumerate((soup.x, soup.y, soup.z)):
                for vertex in range(3):
                    part = ffi.buffer(streams[vertex] + first, 4 * block.struct.count)
                    block.vertices[:block.struct.count, vertex, axis] = np.frombuffer(part, FLOAT)
            yield start + first, block.struct
