"""Which triangles overlap a box?"""

from typing import Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike

from ._arguments import are_floats, check, options_of, three, three_times_three
from ._errors import InputError, check_indices
from ._ffi import ffi
from ._library import lib
from ._masks import bools, check_out, new_words, packed_bits, pointer_to
from ._numbers import DOUBLE, FLOAT, numbers
from ._triangles import gathered, held, meshes, soups
from ._typing import Accuracy, Answer, Frame, TrianglesLike, Vector

BOX, BOX_F64, ORIENTED = ffi.typeof("tribox_box *"), ffi.typeof("tribox_box *"), ffi.typeof("tribox_oriented_box *")
ALL = lib.TRIBOX_AXES_ALL
MOST = np.finfo(FLOAT).max
NOT_FINITE, EMPTY = (np.nan,) * 3, ((1, 1, 1), (0, 0, 0))


def box_of(lo, hi):
    """A box of floats where they hold its numbers, else of doubles."""
    lo, hi = three("lo", lo), three("hi", hi)
    return ffi.new(BOX if are_floats(*lo, *hi) else BOX_F64, (lo, hi))


def floats_about(box, outside):
    """The least box of floats that contains a box of doubles, or else the greatest within; empty or not finite where that is."""
    lo, hi = np.array(tuple(box.lo)), np.array(tuple(box.hi))
    if not np.isfinite([lo, hi]).all():
        return ffi.new(BOX, (NOT_FINITE, NOT_FINITE))
    with np.errstate(over="ignore", under="ignore"):
        low, high = lo.astype(FLOAT), hi.astype(FLOAT)
    if outside:
        low, high = np.where(low > lo, below(low), low), np.where(high < hi, above(high), high)
    else:
        low, high = np.where(low < lo, above(low), low), np.where(high > hi, below(high), high)
    if (lo > hi).any() or (low > MOST).any() or (high < -MOST).any():
        return ffi.new(BOX, EMPTY)
    return ffi.new(BOX, (np.maximum(low, -MOST).tolist(), np.minimum(high, MOST).tolist()))


def below(numbers):
    return np.nextafter(numbers, FLOAT.type(-np.inf))


def above(numbers):
    return np.nextafter(numbers, FLOAT.type(np.inf))


def check_answer(held_, status, **arguments):
    """Raises what the status of a call about a mesh stands for."""
    if status == lib.TRIBOX_BAD_VERTEX:
        check_indices(held_)
    check(status, **arguments)


def fill_words(held_, box, options, words):
    """The bits of triangles that overlap a box; returns the status."""
    if held_.is_double:
        return lib.tribox_mesh_overlap(held_.struct, double_box(box), options, pointer_to(words), ffi.NULL)
    if ffi.typeof(box) is BOX_F64:
        return fill_words_about(held_, box, options, words)
    call = lib.tribox_overlap if held_.is_soup else lib.tribox_mesh_overlap
    return call(held_.struct, box, options, pointer_to(words), ffi.NULL)


def fill_words_about(held_, box, options, words):
    """The same of floats and a box of doubles: boxes of floats around and in it tell all but what overlaps the larger alone."""
    status = fill_words(held_, floats_about(box, True), options, words)
    if status or options.accuracy != lib.TRIBOX_EXACT:
        return status
    sure = np.empty_like(words)
    fill_words(held_, floats_about(box, False), options, sure)
    places = np.flatnonzero(bools(words & ~sure, held_.struct.count)).astype(np.uint32)
    for first, mesh in meshes(gathered(held_.struct, places)):
        found = new_words(mesh.count)
        lib.tribox_mesh_overlap(mesh, box, options, pointer_to(found), ffi.NULL)
        wrong = places[first:first + mesh.count][~bools(found, mesh.count)]
        np.bitwise_and.at(words, wrong >> 6, ~(np.uint64(1) << (wrong & 63).astype(np.uint64)))
    return status


def double_box(box):
    return box if ffi.typeof(box) is BOX_F64 else ffi.new(BOX_F64, (tuple(box.lo), tuple(box.hi)))


def overlap(triangles: TrianglesLike, lo: Vector, hi: Vector, *, accuracy: Accuracy = "exact", axes: int = ALL, order: int = 0,
            kernel: Optional[str] = None, packed: bool = False, out: Optional[Answer] = None) -> Answer:
    """Tests every triangle against the closed box from lo to hi. Returns an array of n bool.

    triangles: an array of shape (n, 3, 3): triangle, vertex, axis; a Mesh, a mesh of another library, or a Soup. float32 and
        float64 are read in place. One with a NaN or an infinity overlaps nothing.
    lo, hi: three finite numbers each, x, y, z, in the unit of the triangles, taken as they are. lo > hi on an axis makes the empty
        box, which nothing overlaps.
    accuracy: "exact", "conservative" or "fast". axes: a union of AXES_BOX, AXES_PLANE and AXES_EDGES.
    order: the order of the groups of axes, such as 132; 0: found as it goes. It changes no answer. kernel: a name, such as "avx2".
    packed: returns uint64 words instead; bit i % 64 of word i // 64 is triangle i.
    out: an array to write to and return: n bool, or uint64 words for packed bits.

    Raises InputError (a ValueError), InputTypeError (a TypeError) or BadIndexError (an IndexError): which argument is wrong, how,
    and what to give. Nothing is written to out then.
    """
    held_, box, options = held(triangles), box_of(lo, hi), options_of(accuracy, axes, order, kernel)
    count = held_.struct.count
    words = None
    if out is not None:
        packed = check_out(out, (count,), ((count + 63) >> 6,))
        words = out if packed else None
    if words is None:
        words = new_words(count)
    status = fill_words(held_, box, options, words)
    if status:
        check_answer(held_, status, axes=axes, order=order, lo=lo, hi=hi)
    if packed:
        return words
    if out is None:
        return bools(words, count)
    out[:] = bools(words, count)
    return out


def is_found(held_, box, options, what, **arguments):
    """Whether there is a first hit, or a first miss, among the triangles."""
    found = ffi.new("size_t *")
    is_double = held_.is_double or ffi.typeof(box) is BOX_F64
    call, box = (lib.tribox_mesh_find, double_box(box)) if is_double else (lib.tribox_find, box)
    for _, part in meshes(held_) if is_double else soups(held_):
        check_answer(held_, call(part, box, options, what, found), **arguments)
        if found[0] < part.count:
            return True
    return False


def overlap_any(triangles: TrianglesLike, lo: Vector, hi: Vector, *, accuracy: Accuracy = "exact", axes: int = ALL, order: int = 0,
                kernel: Optional[str] = None) -> bool:
    """Whether any triangle overlaps the box: False where there is none. Arguments and errors are as for overlap.

    Most of what follows the first that does is not tested.
    """
    held_, box, options = held(triangles), box_of(lo, hi), options_of(accuracy, axes, order, kernel)
    return is_found(held_, box, options, lib.TRIBOX_FIRST_HIT, axes=axes, order=order, lo=lo, hi=hi)


def overlap_all(triangles: TrianglesLike, lo: Vector, hi: Vector, *, accuracy: Accuracy = "exact", axes: int = ALL, order: int = 0,
                kernel: Optional[str] = None) -> bool:
    """Whether all triangles overlap the box: True where there is none. Arguments and errors are as for overlap."""
    held_, box, options = held(triangles), box_of(lo, hi), options_of(accuracy, axes, order, kernel)
    return not is_found(held_, box, options, lib.TRIBOX_FIRST_MISS, axes=axes, order=order, lo=lo, hi=hi)


def classify(triangles: TrianglesLike, lo: Vector, hi: Vector, *, accuracy: Accuracy = "exact", axes: int = ALL, order: int = 0,
             kernel: Optional[str] = None, packed: bool = False) -> Tuple[Answer, Answer]:
    """Tells which triangles overlap the box, and which of them lie wholly inside: two arrays of n bool, or of packed bits.

    A triangle that touches the border from inside is inside. Arguments and errors are as for overlap.
    """
    held_, box, options = held(triangles), box_of(lo, hi), options_of(accuracy, axes, order, kernel)
    is_double, count = held_.is_double or ffi.typeof(box) is BOX_F64, held_.struct.count
    call, box = lib.tribox_mesh_classify if is_double else lib.tribox_classify, double_box(box) if is_double else box
    mask, inside = new_words(count), new_words(count)
    for first, part in meshes(held_) if is_double else soups(held_):
        status = call(part, box, options, pointer_to(mask[first >> 6:]), pointer_to(inside[first >> 6:]), ffi.NULL)
        check_answer(held_, status, axes=axes, order=order, lo=lo, hi=hi)
    return (mask, inside) if packed else (bools(mask, count), bools(inside, count))


def overlap_oriented(triangles: TrianglesLike, center: Vector, half: Vector, frame: Frame, *, accuracy: Accuracy = "exact",
                     axes: int = ALL, order: int = 0, kernel: Optional[str] = None, packed: bool = False) -> Answer:
    """overlap for the oriented box of the points p with abs(frame[k] @ (p - center)) <= half[k], k = 0, 1, 2.

    center, half: three finite numbers each, in the unit of the triangles.
    frame: the three directions of the box, shape (3, 3), finite; of length 1 where half is to be in that unit.

    Here all is float32: the numbers of the box are rounded to it, and triangles of float64 that it cannot hold are an error. Other
    arguments and errors are as for overlap.
    """
    box = ffi.new(ORIENTED, (three("center", center), three("half", half), three_times_three("frame", frame)))
    options = options_of(accuracy, axes, order, kernel)
    held_ = held(triangles)
    count = held_.struct.count
    mask = new_words(count)
    for first, soup in soups(held_):
        status = lib.tribox_overlap_oriented(soup, box, options, pointer_to(mask[first // 64:]), ffi.NULL)
        check(status, axes=axes, order=order, center=center, half=half, frame=frame)
    return mask if packed else bools(mask, count)


def overlap_boxes(triangle: Frame, lo: ArrayLike, hi: ArrayLike, *, accuracy: Accuracy = "exact", axes: int = ALL, order: int = 0,
                  kernel: Optional[str] = None, packed: bool = False) -> Answer:
    """Tests one triangle against many boxes. Returns an array of n bool.

    triangle: three vertices of three numbers. lo, hi: arrays of shape (3, n): axis, box. A box that is not finite
        overlaps nothing, nor does a triangle that is not. Other arguments and errors are as for overlap.

    Numbers that float32 cannot hold take a call for each box, of a microsecond; else thousands of boxes take as long.
    """
    rows, options = three_times_three("triangle", triangle), options_of(accuracy, axes, order, kernel)
    los, his = bounds(lo, hi)
    count = los.shape[1]
    if los.dtype == FLOAT and are_floats(*(x for row in rows for x in row)):
        mask, boxes = new_words(count), boxes_of(los, his)
        status = lib.tribox_overlap_boxes(ffi.new("float[3][3]", rows), boxes, options, pointer_to(mask), ffi.NULL)
        check(status, axes=axes, order=order)
        return mask if packed else bools(mask, count)
    mask = each_box(held(np.array([rows])), los, his, options, axes=axes, order=order)
    return packed_bits(mask) if packed else mask


def each_box(held_, los, his, options, **arguments):
    """One triangle against boxes of doubles, one by one."""
    mask, word, box = np.zeros(los.shape[1], bool), new_words(1), ffi.new(BOX_F64)
    check(fill_words(held_, box, options, word), **arguments)  # of the options, where there is no box
    for i in np.flatnonzero(np.isfinite(los).all(0) & np.isfinite(his).all(0)):
        box.lo, box.hi = los[:, i].tolist(), his[:, i].tolist()
        check(fill_words(held_, box, options, word), **arguments)
        mask[i] = bool(word[0])
    return mask


def bounds(lo, hi):
    """The bounds of boxes, of shape (3, n), both of float32 or of float64."""
    lo, hi = numbers("lo", lo), numbers("hi", hi)
    for name, array in (("lo", lo), ("hi", hi)):
        if array.ndim != 2 or len(array) != 3:
            raise InputError(f"{name} has shape {array.shape}; give (3, n), as {name}.T of an array (n, 3)")
    if lo.shape != hi.shape:
        raise InputError(f"lo has shape {lo.shape} and hi {hi.shape}")
    if lo.dtype != FLOAT or hi.dtype != FLOAT:
        with np.errstate(over="ignore", under="ignore"):
            singles = lo.astype(FLOAT), hi.astype(FLOAT)
        if not all(np.array_equal(single, array, equal_nan=True) for single, array in zip(singles, (lo, hi))):
            return lo.astype(DOUBLE), hi.astype(DOUBLE)
        lo, hi = singles
    return [array if array.shape[1] <= 1 or array.strides[1] == 4 else np.ascontiguousarray(array) for array in (lo, hi)]


def boxes_of(los, his):
    """Bounds of float32 as tribox_boxes, which points into them."""
    starts = [(array.__array_interface__["data"][0], array.strides[0]) for array in (los, his)]
    pointers = [[ffi.cast("float *", start + axis * stride) for axis in range(3)] for start, stride in starts]
    return ffi.new("tribox_boxes *", (*pointers, los.shape[1]))
