"""One soup, box after box: a question costs what its answer and the border of the box cost, not the soup."""

import sys
from typing import Any, Dict, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arguments import check, finite_three, options_of, three, three_times_three
from ._bounds import extent
from ._errors import InputError, check_indices, error_of
from ._ffi import ffi
from ._library import VERSION, lib
from ._masks import bools, check_out, new_words, packed_bits, pointer_to
from ._numbers import FLOAT
from ._overlap import ALL, BOX_F64, ORIENTED, bounds, box_of, boxes_of, fill_words, floats_about
from ._triangles import Soup, gathered, held
from ._typing import Accuracy, Answer, Frame, TrianglesLike, Vector

NUMBER, SIZE = np.dtype(np.uint32), np.dtype(np.uintp)
NUMBERS, SIZES, FOUND = ffi.typeof("uint32_t[]"), ffi.typeof("size_t[]"), ffi.typeof("size_t *")
SCRATCH_FLOATS = 4  # a triangle, for an order
FIRST_ROOM = 4096  # numbers; an answer that has more is asked for twice


def order_of(held_):
    """The order in which triangles are near in number where they are near in space."""
    struct = held_.struct
    order, scratch = np.empty(struct.count, NUMBER), np.empty(struct.count * SCRATCH_FLOATS, FLOAT)
    call = lib.tribox_soup_sort if held_.is_soup else lib.tribox_mesh_sort
    status = call(struct, ffi.from_buffer(NUMBERS, order), ffi.from_buffer(scratch))
    if status:
        check_indices(held_)
        raise error_of(status, triangles=struct.count)
    return order


def built(soup):
    """The nodes of an index over a Soup, as an array of bytes."""
    size = lib.tribox_index_bytes(soup.struct.count)
    nodes = np.empty(size, np.uint8)
    status = lib.tribox_index_build(soup.struct, ffi.NULL, ffi.from_buffer(nodes), ffi.NULL)
    if status:
        raise error_of(status, triangles=len(soup))
    return nodes


def is_double_box(box):
    return ffi.typeof(box[0]) is BOX_F64


class Index:
    """An index over triangles, for many questions about them: each costs what its answer costs, and no longer what the soup does.

    triangles: as for overlap, at most 2^32. float64 that float32 cannot hold needs an origin.
    keep_order: False copies the triangles into an order in which near ones are near in number, which takes some 100 ns and 40 bytes
        for each, 16 more on the way, and makes questions fastest. True leaves them as they come: a Soup is then read where it lies
        and must not change; others are copied.
    origin: three numbers, near the triangles, which are subtracted in float64 before the coordinates are rounded to float32, and
        from every box that is asked. Answers are then exact about coordinates that are off by 2^-24 of their distance from it.

    Answers are those of tribox.overlap, for boxes of any numbers, and have the numbers that the triangles have in the array, Mesh
    or Soup. Boxes that float32 holds, once moved, are answered fastest. accuracy, axes, order and kernel are as for overlap; axes
    must include AXES_BOX, and "fast" may report triangles more. Threads may ask one Index at once. It can be pickled, and copied by
    the module copy; len() is the number of triangles. Errors are those of overlap.
    """

    def __init__(self, triangles: TrianglesLike, *, keep_order: bool = False, origin: Optional[Vector] = None) -> None:
        held_ = held(triangles)
        self.origin = None if origin is None else finite_three("origin", origin)
        if self.origin or held_.is_double:
            held_ = Soup.of(held_, self.origin)
        if not keep_order:
            order = order_of(held_)
            self._set(gathered(held_.struct, order), order)
        else:
            self._set(held_ if held_.is_soup else Soup.of(held_), None)

    def _set(self, soup, ids, nodes=None):
        """soup: the triangles in the order of the index. ids: the number that each has for the caller; None: its place in soup."""
        self._soup, self._ids, self._nodes = soup, ids, built(soup) if nodes is None else nodes
        self._struct = ffi.new("tribox_index *", (ffi.from_buffer(self._nodes), len(soup)))
        self._id_pointer = ffi.NULL if ids is None else ffi.from_buffer(NUMBERS, ids)

    @property
    def soup(self) -> Soup:
        """The triangles in the order of the index."""
        return self._soup

    @property
    def ids(self) -> Optional[NDArray[np.uint32]]:
        """The number that each triangle of the soup has for the caller; None: its place there."""
        return self._ids

    @property
    def nodes(self) -> NDArray[np.uint8]:
        """The tree, as bytes."""
        return self._nodes

    def __len__(self) -> int:
        return int(self._struct.count)

    def __repr__(self) -> str:
        order = "as given" if self.ids is None else "in order"
        where = extent(self.soup, self.origin) if self.origin else extent(self.soup)
        return f"<tribox.Index: {len(self)} triangles {order}, {len(self.nodes)} bytes, {where}>"

    def __getstate__(self) -> Dict[str, Any]:
        return {"version": VERSION, "byteorder": sys.byteorder, "streams": np.asarray(self.soup.streams, order="C"),
                "ids": self.ids, "nodes": self.nodes, "origin": self.origin}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        """Nodes that another version of the library, or the other byte order, wrote are built again."""
        soup, nodes, ids, self.origin = Soup(state["streams"]), state["nodes"], state["ids"], state.get("origin")
        if ids is not None and (ids.dtype, ids.shape) != (NUMBER, (len(soup),)):
            raise InputError(f"a pickled Index of {len(soup)} triangles has {ids.shape} numbers of type {ids.dtype}")
        fits = (state["version"], state["byteorder"], len(nodes)) == (VERSION, sys.byteorder, lib.tribox_index_bytes(len(soup)))
        self._set(soup, ids, nodes if fits else None)

    def overlap(self, lo: Vector, hi: Vector, *, accuracy: Accuracy = "exact", axes: int = ALL, order: int = 0,
                kernel: Optional[str] = None, packed: bool = False, out: Optional[Answer] = None) -> Answer:
        """Tells which triangles overlap the closed box from lo to hi: an array of n bool, as tribox.overlap returns it.

        lo, hi: three numbers each. packed, out: as for tribox.overlap. All n are written; list() is faster where few overlap.
        """
        count = len(self)
        if out is not None:
            packed = check_out(out, (count,), ((count + 63) >> 6,))
        answer = self._mask("", self._straight(lo, hi), (accuracy, axes, order, kernel), packed)
        if out is None:
            return answer
        out[:] = answer
        return out

    def overlap_oriented(self, center: Vector, half: Vector, frame: Frame, *, accuracy: Accuracy = "exact", axes: int = ALL,
                         order: int = 0, kernel: Optional[str] = None, packed: bool = False) -> Answer:
        """overlap() for the oriented box of the points p with abs(frame[k] @ (p - center)) <= half[k], k = 0, 1, 2.

        frame: the three directions of the box, shape (3, 3).
        """
        return self._mask("_oriented", self._oriented(center, half, frame), (accuracy, axes, order, kernel), packed)

    def count(self, lo: Vector, hi: Vector, *, accuracy: Accuracy = "exact", axes: int = ALL, order: int = 0,
              kernel: Optional[str] = None) -> int:
        """The number of triangles that overlap the closed box from lo to hi, three numbers each."""
        box, test, report = self._straight(lo, hi), (accuracy, axes, order, kernel), ffi.new("tribox_report *")
        if is_double_box(box):
            return len(self._numbers("", box, test))
        self._ask(lib.tribox_index_overlap, box, test, ffi.NULL, report)
        return int(report.overlapping)

    def any(self, lo: Vector, hi: Vector, *, accuracy: Accuracy = "exact", axes: int = ALL, order: int = 0,
            kernel: Optional[str] = None) -> bool:
        """Whether any triangle overlaps the closed box from lo to hi, three numbers each."""
        box, test, found = self._straight(lo, hi), (accuracy, axes, order, kernel), ffi.new(FOUND)
        if is_double_box(box):
            return len(self._numbers("", box, test)) > 0
        self._ask(lib.tribox_index_any, box, test, found)
        return found[0] < len(self)

    def list(self, lo: Vector, hi: Vector, *, accuracy: Accuracy = "exact", axes: int = ALL, order: int = 0,
             kernel: Optional[str] = None) -> NDArray[np.uint32]:
        """The numbers of the triangles that overlap the closed box from lo to hi, three numbers each: an array of uint32.

        They come in the order of the index, which is ascending with keep_order=True alone.
        """
        return self._numbers("", self._straight(lo, hi), (accuracy, axes, order, kernel))

    def list_oriented(self, center: Vector, half: Vector, frame: Frame, *, accuracy: Accuracy = "exact", axes: int = ALL,
                      order: int = 0, kernel: Optional[str] = None) -> NDArray[np.uint32]:
        """list() for an oriented box, as for overlap_oriented()."""
        return self._numbers("_oriented", self._oriented(center, half, frame), (accuracy, axes, order, kernel))

    def lists(self, lo: ArrayLike, hi: ArrayLike, *, accuracy: Accuracy = "exact", axes: int = ALL, order: int = 0,
              kernel: Optional[str] = None) -> Tuple[NDArray[np.uint32], NDArray[np.intp]]:
        """list() for many boxes: (list, start), where list[start[i]:start[i + 1]] has the triangles of box i.

        lo, hi: arrays of shape (3, m): axis, box. A box that is empty or not finite has no triangles. list: an array of uint32.
        start: m + 1 places, an array of intp. Boxes that are near in number should be near in space; those of numbers that float32
        cannot hold are asked one by one.
        """
        options = options_of(accuracy, axes, order, kernel)
        los, his = bounds(lo, hi)
        if self.origin:
            origin = np.array(self.origin)[:, None]
            los, his = bounds(los - origin, his - origin)
        if los.dtype != FLOAT:
            return self._each(los, his, (accuracy, axes, order, kernel))
        boxes = boxes_of(los, his)
        start, room = np.empty(boxes.count + 1, SIZE), FIRST_ROOM + 64 * boxes.count
        while True:
            numbers = np.empty(room, NUMBER)
            check(lib.tribox_index_lists(self._struct, self.soup.struct, boxes, options, self._id_pointer, room,
                                         ffi.from_buffer(NUMBERS, numbers), ffi.from_buffer(SIZES, start)), axes=axes, order=order)
            total = int(start[-1])
            if total <= room:
                return numbers if total == room else numbers[:total].copy(), start.view(np.intp)
            room = total

    def _straight(self, lo, hi):
        """A box where the soup is, and what the caller says of it, for messages."""
        given = dict(lo=lo, hi=hi)
        if self.origin:
            lo, hi = self._moved("lo", lo), self._moved("hi", hi)
        return box_of(lo, hi), given

    def _oriented(self, center, half, frame):
        """The same for an oriented box."""
        middle = self._moved("center", center) if self.origin else three("center", center)
        box = ffi.new(ORIENTED, (middle, three("half", half), three_times_three("frame", frame)))
        return box, dict(center=center, half=half, frame=frame)

    def _moved(self, name, point):
        return tuple(x - o for x, o in zip(three(name, point), self.origin))

    def _each(self, los, his, test):
        """lists() for boxes of doubles."""
        found, start = [], np.zeros(los.shape[1] + 1, np.intp)
        for i, (lo, hi) in enumerate(zip(los.T.tolist(), his.T.tolist())):
            is_finite = np.isfinite([lo, hi]).all()
            found.append(self._exactly((ffi.new(BOX_F64, (lo, hi)), {}), test) if is_finite else np.empty(0, NUMBER))
            start[i + 1] = start[i] + len(found[-1])
        return np.concatenate([np.empty(0, NUMBER), *found]), start

    def _exactly(self, box, test):
        """The triangles that overlap a box of doubles: those that overlap one of floats around it, asked again."""
        struct, given = box
        options = options_of(*test)
        places = self._listed("", (floats_about(struct, True), given), ("conservative", *test[1:]), ffi.NULL)
        words = new_words(len(places))
        check(fill_words(gathered(self.soup.struct, places), struct, options, words), axes=test[1], order=test[2], **given)
        left = places[bools(words, len(places))]
        return left if self.ids is None else self.ids[left]

    def _mask(self, kind, box, test, packed):
        """All bits, in the caller's order. kind: what the names of the calls end with."""
        if self.ids is None and not is_double_box(box):
            words = new_words(len(self))
            self._ask(getattr(lib, "tribox_index_overlap" + kind), box, test, pointer_to(words), ffi.NULL)
            return words if packed else bools(words, len(self))
        mask = np.zeros(len(self), bool)
        mask[self._numbers(kind, box, test)] = True
        return packed_bits(mask) if packed else mask

    def _numbers(self, kind, box, test):
        return self._exactly(box, test) if is_double_box(box) else self._listed(kind, box, test, self._id_pointer)

    def _listed(self, kind, box, test, ids):
        """ids: the numbers to list the triangles by; NULL: their places in the soup."""
        call, found, room = getattr(lib, "tribox_index_list" + kind), ffi.new(FOUND), FIRST_ROOM
        while True:
            numbers = np.empty(room, NUMBER)
            self._ask(call, box, test, ids, room, ffi.from_buffer(NUMBERS, numbers), found)
            if found[0] <= room:
                return numbers if found[0] == room else numbers[:found[0]].copy()
            room = found[0]

    def _ask(self, call, box, test, *receivers):
        """Calls with a box, as _straight() returns it, and options: accuracy, axes, order, kernel."""
        struct, given = box
        status = call(self._struct, self.soup.struct, struct, options_of(*test), *receivers)
        check(status, axes=test[1], order=test[2], **given)
