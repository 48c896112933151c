"""Triangles in NumPy arrays as the structs of the library: pointers into the arrays, no copies."""

import numpy as np

from ._errors import InputError, InputTypeError, bad_index, error_of
from ._ffi import ffi
from ._library import lib

FLOAT = np.dtype(np.float32)
INDEX_BYTES = {np.dtype(np.uint16): 2, np.dtype(np.uint32): 4, np.dtype(np.int32): 4}
MESH, SOUP = ffi.typeof("tribox_mesh *"), ffi.typeof("tribox_soup *")
BLOCK = 1 << 16  # triangles: as streams they are 2.3 MB, and blocks start at whole words of a mask

new, from_buffer, NULL = ffi.new, ffi.from_buffer, ffi.NULL


def check_floats(name, array):
    if not isinstance(array, np.ndarray):
        raise InputTypeError(f"{name} is of type {type(array).__name__}; give a NumPy array, np.asarray(..., np.float32)")
    if array.dtype != FLOAT:
        raise InputTypeError(f"{name} has dtype {array.dtype}, the library reads float32; convert it once: "
                             f"{name}.astype(np.float32)")


def address_of(array):
    """Where an array begins. from_buffer takes contiguous arrays alone."""
    return ffi.cast("void *", array.__array_interface__["data"][0])


def mesh_without_faces(triangles):
    """An array of shape (n, 3, 3) as a tribox_mesh, or, where it is stored as nine streams, as a tribox_soup."""
    if triangles.dtype != FLOAT:
        check_floats("triangles", triangles)
    shape = triangles.shape
    if shape[1:] != (3, 3):
        raise InputError(f"triangles has shape {shape}; give (n, 3, 3): triangle, vertex, axis")
    count = shape[0]
    if triangles.flags.c_contiguous:
        return new(MESH, (from_buffer(triangles), 12, 3 * count, NULL, 0, count))
    per_triangle, per_vertex, per_axis = triangles.strides
    if per_axis == 4 and per_vertex >= 12 and (count == 1 or per_triangle == 3 * per_vertex):
        return new(MESH, (address_of(triangles), per_vertex, 3 * count, NULL, 0, count))
    if per_triangle == 4:
        return Soup(triangles.T).struct
    raise InputError(f"triangles has the strides {triangles.strides}, which cannot be read in place; copy it once: "
                     "np.ascontiguousarray(triangles)")


class Mesh:
    """Vertices, an array of shape (m, 3) of float32, and faces, of shape (n, 3) of uint16, uint32 or int32. Nothing is copied.

    Vertices may be 12 bytes or more apart; faces are contiguous.
    """

    def __init__(self, vertices, faces):
        check_floats("vertices", vertices)
        if vertices.ndim != 2 or vertices.shape[1] != 3:
            raise InputError(f"vertices has shape {vertices.shape}; give (m, 3): vertex, axis")
        if len(vertices) and (vertices.strides[1] != 4 or len(vertices) > 1 and vertices.strides[0] < 12):
            raise InputError(f"vertices has the strides {vertices.strides}, which cannot be read in place; copy it once: "
                             "np.ascontiguousarray(vertices)")
        if not isinstance(faces, np.ndarray) or faces.dtype not in INDEX_BYTES:
            raise InputTypeError(f"faces is {getattr(faces, 'dtype', type(faces).__name__)}; the library reads arrays of uint16, "
                                 "uint32 or int32; convert it once: np.asarray(faces, np.uint32)")
        if faces.ndim != 2 or faces.shape[1] != 3 or not faces.flags.c_contiguous:
            raise InputError(f"faces has shape {faces.shape} and strides {faces.strides}; give (n, 3), contiguous")
        count = len(vertices)
        if faces.dtype.kind == "i":
            count = min(count, 1 << 31)  # negative numbers, read as unsigned, refer to no vertex
        stride = vertices.strides[0] if len(vertices) > 1 else 12
        self.vertices, self.faces = vertices, faces
        self.struct = new(MESH, (address_of(vertices), stride, count, address_of(faces), faces.itemsize, len(faces)))

    def __len__(self):
        return len(self.faces)

    def __repr__(self):
        return f"<tribox.Mesh: {len(self.vertices)} vertices, {len(self)} faces of {self.faces.dtype}>"


class Soup:
    """Triangles as nine streams, the fastest form: streams[axis][vertex] is a contiguous array of n float32. Nothing is copied.

    streams: an array of shape (3, 3, n), or sequences of nine arrays.
    """

    def __init__(self, streams):
        try:
            nested = [list(axis) for axis in streams] if len(streams) == 3 else []
        except TypeError:
            raise InputTypeError(f"streams is of type {type(streams).__name__}; give an array of shape (3, 3, n)") from None
        if [len(axis) for axis in nested] != [3, 3, 3]:
            raise InputError("streams must hold three axes of three vertices each: shape (3, 3, n)")
        for stream in (stream for axis in nested for stream in axis):
            check_floats("a stream", stream)
            if stream.ndim != 1 or len(stream) != len(nested[0][0]) or len(stream) > 1 and stream.strides[0] != 4:
                raise InputError(f"a stream has shape {stream.shape} and strides {stream.strides}; give nine contiguous "
                                 "arrays of one length")
        self.streams = streams
        pointers = [[ffi.cast("float *", address_of(stream)) for stream in axis] for axis in nested]
        self.struct = new(SOUP, (*pointers, len(nested[0][0])))

    def __len__(self):
        return self.struct.count

    def __repr__(self):
        return f"<tribox.Soup: {len(self)} triangles>"

    @classmethod
    def of(cls, triangles):
        """A copy of a mesh, or of an array of shape (n, 3, 3), as streams: for triangles that are tested many times."""
        struct, faces = held(triangles)
        if ffi.typeof(struct) is SOUP:
            return cls(np.array(triangles.T if isinstance(triangles, np.ndarray) else triangles.streams, order="C"))
        check_indices(struct, faces)
        soup = cls(np.empty((3, 3, struct.count), FLOAT))
        fill(soup.struct, struct, 0, struct.count)
        return soup


def held(triangles):
    """The struct of triangles in any form, and their faces, if any, for messages. The struct points into the caller's arrays."""
    if isinstance(triangles, np.ndarray):
        return mesh_without_faces(triangles), None
    if isinstance(triangles, Mesh):
        return triangles.struct, triangles.faces
    if isinstance(triangles, Soup):
        return triangles.struct, None
    raise InputTypeError(f"triangles is of type {type(triangles).__name__}; give a NumPy array, a tribox.Mesh or a tribox.Soup")


def check_indices(mesh, faces):
    error = faces is not None and bad_index(mesh, faces)
    if error:
        raise error


def fill(soup, mesh, first, count):
    """Copies triangles of a mesh with good indices to the streams of a soup that has room for them."""
    soup.count = count
    status = lib.tribox_mesh_to_streams(mesh, first, count, NULL, soup.x, soup.y, soup.z)
    if status:
        raise error_of(status, first=first, count=count)


def soups(triangles):
    """Triangles in any form as tribox_soups, each with the number of its first triangle. The next soup overwrites the last."""
    struct, faces = held(triangles)
    if ffi.typeof(struct) is SOUP:
        yield 0, struct
        return
    check_indices(struct, faces)
    block = Soup(np.empty((3, 3, min(struct.count, BLOCK)), FLOAT))
    for first in range(0, max(struct.count, 1), BLOCK):
        fill(block.struct, struct, first, min(struct.count - first, BLOCK))
        yield first, block.struct
