"""Which triangles overlap a box?"""

from ._arguments import check, options_of, three, three_times_three
from ._errors import InputError
from ._ffi import ffi
from ._library import lib
from ._masks import bools, check_out, new_words, pointer_to
from ._triangles import SOUP, check_floats, check_indices, held, soups

BOX, ORIENTED = ffi.typeof("tribox_box *"), ffi.typeof("tribox_oriented_box *")
ALL = lib.TRIBOX_AXES_ALL


def overlap(triangles, lo, hi, *, accuracy="exact", axes=ALL, order=0, kernel=None, packed=False, out=None):
    """Tests every triangle against the closed box from lo to hi. Returns an array of n bool.

    triangles: an array of shape (n, 3, 3) of float32, a Mesh or a Soup; read in place.
    lo, hi: three numbers each; like all lone numbers they are rounded to float32. lo > hi on an axis makes the empty box.
    accuracy: "exact", "conservative" or "fast". axes: a union of AXES_BOX, AXES_PLANE and AXES_EDGES.
    order: the order of the groups of axes, such as 132; 0: found as it goes. It changes no answer. kernel: a name, such as "avx2".
    packed: returns uint64 words instead; bit i % 64 of word i // 64 is triangle i.
    out: an array to write to and return: n bool, or uint64 words for packed bits.
    """
    struct, faces = held(triangles)
    box = ffi.new(BOX, (three("lo", lo), three("hi", hi)))
    options = options_of(accuracy, axes, order, kernel)
    call = lib.tribox_overlap if ffi.typeof(struct) is SOUP else lib.tribox_overlap_indexed
    count = struct.count
    words = None
    if out is not None:
        packed = check_out(out, (count,), ((count + 63) >> 6,))
        words = out if packed else None
    if words is None:
        words = new_words(count)
    status = call(struct, box, options, pointer_to(words), ffi.NULL)
    if status:
        if status == lib.TRIBOX_BAD_INDEX:
            check_indices(struct, faces)
        check(status, axes=axes, order=order, lo=lo, hi=hi)
    if packed:
        return words
    if out is None:
        return bools(words, count)
    out[:] = bools(words, count)
    return out


def first_triangle(call, triangles, lo, hi, accuracy, axes, order, kernel):
    """Whether the call finds a triangle among them."""
    box = ffi.new(BOX, (three("lo", lo), three("hi", hi)))
    options = options_of(accuracy, axes, order, kernel)
    found = ffi.new("size_t *")
    for _, soup in soups(triangles):
        check(call(soup, box, options, found), axes=axes, order=order, lo=lo, hi=hi)
        if found[0] < soup.count:
            return True
    return False


def overlap_any(triangles, lo, hi, *, accuracy="exact", axes=ALL, order=0, kernel=None):
    """Whether any triangle overlaps the box. Most of what follows the first that does is not tested."""
    return first_triangle(lib.tribox_overlap_any, triangles, lo, hi, accuracy, axes, order, kernel)


def overlap_all(triangles, lo, hi, *, accuracy="exact", axes=ALL, order=0, kernel=None):
    """Whether all triangles overlap the box."""
    return not first_triangle(lib.tribox_overlap_all, triangles, lo, hi, accuracy, axes, order, kernel)


def classify(triangles, lo, hi, *, accuracy="exact", axes=ALL, order=0, kernel=None, packed=False):
    """Tells which triangles overlap the box, and which of them lie wholly inside: two arrays of bool, or of packed bits."""
    box = ffi.new(BOX, (three("lo", lo), three("hi", hi)))
    options = options_of(accuracy, axes, order, kernel)
    count = held(triangles)[0].count
    mask, inside = new_words(count), new_words(count)
    for first, soup in soups(triangles):
        status = lib.tribox_classify(soup, box, options, pointer_to(mask[first // 64:]), pointer_to(inside[first // 64:]), ffi.NULL)
        check(status, axes=axes, order=order, lo=lo, hi=hi)
    return (mask, inside) if packed else (bools(mask, count), bools(inside, count))


def overlap_oriented(triangles, center, half, frame, *, accuracy="exact", axes=ALL, order=0, kernel=None, packed=False):
    """overlap for the oriented box of the points p with abs(frame[k] @ (p - center)) <= half[k], k = 0, 1, 2.

    frame: the three directions of the box, shape (3, 3).
    """
    box = ffi.new(ORIENTED, (three("center", center), three("half", half), three_times_three("frame", frame)))
    options = options_of(accuracy, axes, order, kernel)
    count = held(triangles)[0].count
    mask = new_words(count)
    for first, soup in soups(triangles):
        status = lib.tribox_overlap_oriented(soup, box, options, pointer_to(mask[first // 64:]), ffi.NULL)
        check(status, axes=axes, order=order, center=center, half=half, frame=frame)
    return mask if packed else bools(mask, count)


def overlap_boxes(triangle, lo, hi, *, accuracy="exact", axes=ALL, order=0, kernel=None, packed=False):
    """Tests one triangle against many boxes. Returns an array of n bool.

    triangle: three vertices of three numbers. lo, hi: arrays of shape (3, n) of float32: axis, box; each row is contiguous.
    """
    corners = ffi.new("float[3][3]", three_times_three("triangle", triangle))
    options = options_of(accuracy, axes, order, kernel)
    boxes = ffi.new("tribox_boxes *", (bounds("lo", lo), bounds("hi", hi), lo.shape[1]))
    if lo.shape != hi.shape:
        raise InputError(f"lo has shape {lo.shape} and hi {hi.shape}")
    mask = new_words(boxes.count)
    check(lib.tribox_overlap_boxes(corners, boxes, options, pointer_to(mask), ffi.NULL), axes=axes, order=order)
    return mask if packed else bools(mask, boxes.count)


def bounds(name, array):
    """Pointers to the rows of bounds of boxes."""
    check_floats(name, array)
    if array.ndim != 2 or len(array) != 3 or array.shape[1] > 1 and array.strides[1] != 4:
        raise InputError(f"{name} has shape {array.shape} and strides {array.strides}; give (3, n) with contiguous rows: "
                         f"np.ascontiguousarray({name}.T) of an array (n, 3)")
    start = array.__array_interface__["data"][0]
    return [ffi.cast("float *", start + axis * array.strides[0]) for axis in range(3)]
