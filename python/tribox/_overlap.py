"""Which triangles overlap a box? And the mesh of these, or of the others."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, Iterator, Literal, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _c
from ._arguments import FLOAT, array_of, check, first_of, options_of, place_of, three, three_times_three
from ._boxes import OrientedBox, Rows, Streams, bounds_of_boxes, box_of, oriented_of
from ._errors import BadIndexError, Brief, InputError, InputTypeError, check_indices, shown
from ._ffi import ffi
from ._library import lib
from ._masks import bools, check_out, new_words, pointer_to, rows_of_words
from ._triangles import INDEX, Mesh, by_number, held
from ._typing import Accuracy, Answer, Boxes, Corners, Frame, Region, TrianglesLike, Vector

ALL, BOX = lib.TRIBOX_AXES_ALL, lib.TRIBOX_AXES_BOX
WHATS = {"hit": lib.TRIBOX_FIRST_HIT, "miss": lib.TRIBOX_FIRST_MISS}


def check_answer(held_, status, **arguments):
    """Raises what the status of a call about triangles stands for."""
    if status == lib.TRIBOX_BAD_VERTEX:
        check_indices(held_)
    check(status, **arguments)


def overlap(triangles: TrianglesLike, lo: Region, hi: Optional[Vector] = None, *, accuracy: Accuracy = "exact", axes: int = ALL,
            axis_order: int = 0, kernel: Optional[str] = None, packed: bool = False, out: Optional[Answer] = None) -> Answer:
    """Tests every triangle against the closed box from lo to hi. Returns an array of n bool.

    triangles: an array of shape (n, 3, 3): triangle, vertex, axis; a Mesh, a mesh of another library, a tuple (vertices, faces), or
        a Soup. float32 and float64 are read in place. A triangle with a NaN or an infinity overlaps nothing.
    lo, hi: three finite numbers each, x, y, z, in the unit of the triangles, taken as doubles without rounding; or lo alone, of
        shape (2, 3), as trimesh's bounds. lo > hi on an axis makes the box empty, and nothing overlaps it.
    accuracy: "exact", "conservative" or "fast". axes: a union of AXES_BOX, AXES_PLANE and AXES_EDGES.
    axis_order: of the groups of axes, such as 132; with 0 the call chooses. It changes no answer. kernel: a name, such as "avx2".
    packed: returns uint64 words instead; bit i % 64 of word i // 64 is triangle i.
    out: an array to write to and return: n bool, or uint64 words for packed bits.

    Raises InputError (a ValueError), InputTypeError (a TypeError) or BadIndexError (an IndexError), which say which argument is
    wrong, how, and what to give. After an error, out is unchanged.
    """
    held_, options = held(triangles), options_of(accuracy, axes, axis_order, kernel)
    ask, box, said = asked_by(lo, hi, accuracy, axes)
    count = held_.struct.count
    words = None
    if out is not None:
        packed = check_out(out, (count,), ((count + 63) >> 6,))
        words = out if packed else None
    if words is None:
        words = new_words(count)
    status = ask(held_, box, options, pointer_to(words), ffi.NULL)
    if status:
        check_answer(held_, status, **said)
    if packed:
        return words
    if out is None:
        return bools(words, count)
    out[:] = bools(words, count)
    return out


def asked_by(lo, hi, accuracy, axes):
    """The call about a box or an oriented one, what it takes, and what to name in a message."""
    if not isinstance(lo, OrientedBox):
        return _c.overlap, box_of(lo, hi), dict(lo=lo, hi=hi)
    if hi is not None:
        raise InputError(f"hi = {shown(hi)}; give an OrientedBox alone, without hi")
    check_oriented(accuracy, axes)
    return _c.overlap_oriented, oriented_of(*lo), dict(zip(("center", "half", "axis"), lo))


def find(triangles: TrianglesLike, lo: Region, hi: Optional[Vector] = None, what: Literal["hit", "miss"] = "hit", *,
         accuracy: Accuracy = "exact", axes: int = ALL, axis_order: int = 0, kernel: Optional[str] = None) -> Optional[int]:
    """The number of the first triangle that overlaps the box, or with what="miss" does not overlap it; None if there is none.

    Most triangles after it are not tested, except with an OrientedBox, when all are. Other arguments and errors are as for overlap.
    """
    if what not in WHATS:
        raise InputError(f"what = {shown(what)}; give one of {', '.join(map(repr, WHATS))}")
    if isinstance(lo, OrientedBox):
        hits = overlap(triangles, lo, hi, accuracy=accuracy, axes=axes, axis_order=axis_order, kernel=kernel)
        numbers = np.flatnonzero(hits if what == "hit" else ~hits)
        return int(numbers[0]) if len(numbers) else None
    held_, box, options = held(triangles), box_of(lo, hi), options_of(accuracy, axes, axis_order, kernel)
    found = ffi.new("size_t *")
    check_answer(held_, _c.find(held_, box, options, WHATS[what], found), lo=lo, hi=hi)
    return int(found[0]) if found[0] < held_.struct.count else None


def overlap_any(triangles: TrianglesLike, lo: Region, hi: Optional[Vector] = None, *, accuracy: Accuracy = "exact",
                axes: int = ALL, axis_order: int = 0, kernel: Optional[str] = None) -> bool:
    """Whether any triangle overlaps the box: False if there are no triangles. Arguments and errors are as for overlap."""
    return find(triangles, lo, hi, "hit", accuracy=accuracy, axes=axes, axis_order=axis_order, kernel=kernel) is not None


def overlap_all(triangles: TrianglesLike, lo: Region, hi: Optional[Vector] = None, *, accuracy: Accuracy = "exact",
                axes: int = ALL, axis_order: int = 0, kernel: Optional[str] = None) -> bool:
    """Whether all triangles overlap the box: True if there are no triangles. Arguments and errors are as for overlap."""
    return find(triangles, lo, hi, "miss", accuracy=accuracy, axes=axes, axis_order=axis_order, kernel=kernel) is None


def classify(triangles: TrianglesLike, lo: Corners, hi: Optional[Vector] = None, *, accuracy: Accuracy = "exact", axes: int = ALL,
             axis_order: int = 0, kernel: Optional[str] = None, packed: bool = False) -> Tuple[Answer, Answer]:
    """Tells which triangles overlap the box, and which of them lie wholly inside: two arrays of n bool, or of packed bits.

    A triangle that touches the border from inside is inside. Arguments and errors are as for overlap.
    """
    held_, box, options = held(triangles), box_of(lo, hi), options_of(accuracy, axes, axis_order, kernel)
    count = held_.struct.count
    mask, inside = new_words(count), new_words(count)
    status = _c.classify(held_, box, options, pointer_to(mask), pointer_to(inside), ffi.NULL)
    check_answer(held_, status, lo=lo, hi=hi)
    return (mask, inside) if packed else (bools(mask, count), bools(inside, count))


def triangle_numbers(value, count):
    """Whole numbers as uint32. Those of the type are checked by the call."""
    array = array_of("numbers", value)
    if array.ndim != 1 or array.size and array.dtype.kind not in "iu":
        raise InputTypeError(f"numbers is of {array.dtype} and shape {array.shape}; give whole numbers, those of triangles")
    if array.dtype != np.uint32:
        check_numbers(array, count)
    return np.ascontiguousarray(array, np.uint32)


def check_numbers(array, count):
    wrong = (array < 0) | (array >= count)
    if wrong.any():
        raise BadIndexError(f"numbers[{place_of(wrong)}] is {first_of(array, wrong)}, but there are {count} triangles",
                            "BAD_VERTEX")


def split(triangles: TrianglesLike, lo: Corners, hi: Optional[Vector] = None, middle: Optional[Vector] = None,
          numbers: Optional[ArrayLike] = None, *, accuracy: Accuracy = "exact", axes: int = ALL, axis_order: int = 0,
          kernel: Optional[str] = None) -> NDArray[np.uint8]:
    """Tells which of the eight children of a box each triangle overlaps, for octrees: an array of n uint8.

    Bit c of a byte is child c: from lo to middle on axis a if bit a of c is 0, and from middle to hi if it is 1.

    middle: where children meet, three numbers that are not outside the box; by default the doubles nearest to (lo + hi) / 2.
    numbers: of the n triangles that are tested, in any order, some perhaps more than once; by default all. uint32 is read in place.
        With children = split(..., numbers=numbers), numbers[children >> c & 1 == 1] are those of child c.
    axes: AXES_ALL or AXES_BOX.

    If all leaves have one size, voxelize or bricks are many times as fast. Other arguments and errors are as for overlap; a number
    that no triangle has is a BadIndexError.
    """
    held_, box, options = held(triangles), box_of(lo, hi), options_of(accuracy, axes, axis_order, kernel)
    at = ffi.NULL if middle is None else ffi.new("double[3]", three("middle", middle))
    count = held_.struct.count
    listed = None if numbers is None else triangle_numbers(numbers, count)
    children = np.empty(count if listed is None else len(listed), np.uint8)
    list_ = ffi.NULL if listed is None else ffi.from_buffer("uint32_t[]", listed)
    status = _c.split(held_, list_, len(children), box, at, options, ffi.from_buffer("uint8_t[]", children), ffi.NULL)
    if status == lib.TRIBOX_BAD_VERTEX and listed is not None:
        check_numbers(listed, count)
    check_answer(held_, status, lo=lo, hi=hi, middle=middle, axes=axes)
    return children


def overlap_oriented(triangles: TrianglesLike, center: Vector, half: Vector, axis: Frame, *, accuracy: Accuracy = "exact",
                     axes: int = ALL, axis_order: int = 0, kernel: Optional[str] = None, packed: bool = False) -> Answer:
    """overlap for the oriented box of the points p with abs(axis[k] @ (p - center)) <= half[k], for k = 0, 1, 2.

    center, half, axis: as for OrientedBox.
    axes: AXES_ALL or AXES_BOX; any others, too, if accuracy is not "exact".

    Other arguments and errors are as for overlap.
    """
    return overlap(triangles, OrientedBox(center, half, axis), accuracy=accuracy, axes=axes, axis_order=axis_order, kernel=kernel,
                   packed=packed)


def check_oriented(accuracy, axes):
    if accuracy == "exact" and axes not in (ALL, BOX):
        raise InputError(f"axes = {axes}; give AXES_ALL or AXES_BOX for an oriented box, or another accuracy", "BAD_OPTION")


def overlap_boxes(triangle: Frame, lo: Boxes, hi: Optional[Boxes] = None, *, accuracy: Accuracy = "exact", axes: int = ALL,
                  axis_order: int = 0, kernel: Optional[str] = None, packed: bool = False) -> Answer:
    """Tests one triangle against many boxes. Returns an array of m bool.

    triangle: three vertices of three numbers.
    lo, hi: the corners of m boxes, arrays of shape (m, 3), or (3, m) if m is not 3; or lo alone, of shape (m, 2, 3). A box or a
        triangle that is not finite overlaps nothing.

    If float32 cannot hold a box's numbers, the box takes a call of its own, of a microsecond: as long as thousands of other boxes.
    Other arguments and errors are as for overlap.
    """
    one, options = np.array([three_times_three("triangle", triangle)]), options_of(accuracy, axes, axis_order, kernel)
    los, his = bounds_of_boxes(lo, hi)
    count = los.shape[1]
    with np.errstate(over="ignore", under="ignore"):
        single = one.astype(FLOAT)
    if los.dtype == FLOAT and np.array_equal(single, one, equal_nan=True):
        mask, boxes = new_words(count), Streams(los, his)
        check(lib.tribox_overlap_boxes(ffi.from_buffer("float[]", single), boxes.struct, options, pointer_to(mask), ffi.NULL))
        return mask if packed else bools(mask, count)
    mesh, rows, words, found = Mesh(one), Rows(los, his), new_words(1), np.zeros(count, bool)
    word = pointer_to(words)
    for i in range(count):
        check(_c.overlap(mesh, rows.boxes + i, options, word, ffi.NULL))
        found[i] = words[0]
    return rows_of_words(found) if packed else found


@dataclass(frozen=True, eq=False)
class Cropped(metaclass=Brief):
    """Some triangles of a mesh: vertices, faces, face_numbers, vertex_numbers = tribox.crop(mesh, lo, hi).

    Look attributes of faces and vertices up by their numbers: colors[face_numbers], normals[vertex_numbers].
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
    """The mesh of the triangles that overlap the box, whole and unchanged: vertices, faces, face_numbers, vertex_numbers.

        >>> part = tribox.crop(mesh, (0, 0, 0), (10, 10, 10))
        >>> colors = mesh.visual.face_colors[part.face_numbers]
        >>> rest = tribox.crop(mesh, (0, 0, 0), (10, 10, 10), rest=True)

    triangles: as for overlap, meshes of other libraries included.
    lo, hi: as for overlap; or lo alone, an OrientedBox.
    inside: only those that lie wholly inside; not with an OrientedBox.
    rest: all other triangles instead: each triangle is in one of the two meshes.

    Nothing is cut or merged: a triangle across the border is in the part, with all three corners. A vertex that no face of the
    result uses is left out. Other arguments and errors are as for overlap.
    """
    held_ = held(triangles)
    options: Dict[str, Any] = {"accuracy": accuracy, "axes": axes, "axis_order": axis_order, "kernel": kernel}
    if not inside:
        mask = overlap(held_, lo, hi, **options)
    elif isinstance(lo, OrientedBox):
        raise InputError("inside is for boxes from lo to hi; give an OrientedBox without it")
    else:
        mask = classify(held_, lo, hi, **options)[1]
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
