"""An index for many boxes: a query takes time for its answer and the border of the box, not for all triangles."""

from __future__ import annotations

from typing import Any, Dict, Optional, SupportsIndex, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _c
from ._arguments import DOUBLE, FLOAT, check, options_of
from ._boxes import OrientedBox, Rows, Streams, bounds_of_boxes, box_of, oriented_of
from ._errors import Brief, InputError, check_indices, error_of, shown
from ._ffi import ffi
from ._library import lib
from ._masks import bools, check_out, new_words, pointer_to, rows_of_words
from ._overlap import ALL, BOX, check_oriented
from ._threads import cut, in_threads, processors, threads_of
from ._triangles import Mesh, Part, Soup, by_number, check_count, check_sound, extent, held, is_double
from ._typing import Accuracy, Answer, Boxes, Region, TrianglesLike, Vector

NUMBER = np.dtype(np.uint32)
NUMBERS = ffi.typeof("uint32_t[]")
SIZE = np.dtype(np.uintp)
SIZES, FOUND = ffi.typeof("size_t[]"), ffi.typeof("size_t *")
SCRATCH_FLOATS = 4  # a triangle
PARTS_EACH = 4  # of each thread
SHARED_LEAST = 1 << 16  # triangles: threads gain nothing with fewer
FIRST_ROOM = 4096  # numbers; an answer that has more is asked for twice
ROOM_EACH = 64  # numbers for each of many boxes, at first
BOXES_LEAST = 128  # boxes of float32 that threads share out


def threads_for(threads, count):
    return threads if count >= SHARED_LEAST else 1


def sort_by_steps(held_, order, scratch, threads):
    """The steps of one sort, each by threads; returns the status."""
    count, numbers, room = held_.struct.count, ffi.from_buffer(NUMBERS, order), ffi.from_buffer(scratch)

    def halves(part):
        first, end = part
        before = ffi.new(FOUND)
        check_sound(lib.tribox_sort_cut(room, count, first, end - first, before))
        middle = first + before[0]
        return [(first, middle), (middle, end)]

    def finish(part):
        first, end = part
        check_sound(lib.tribox_sort_finish(room, count, first, end - first, numbers))

    parts = cut(count, threads * PARTS_EACH)
    status = max(in_threads(threads, lambda part: _c.sort_start(held_, part[0], part[1] - part[0], room), parts))
    if not status:
        parts = [(0, count)]
        while len(parts) < threads * PARTS_EACH:  # of SHARED_LEAST triangles, which can all be cut as often
            parts = sum(in_threads(threads, halves, parts), [])
        in_threads(threads, finish, parts)
    return status


def order_of(held_, threads=1):
    """The order. Raises what is wrong with the indices of a mesh."""
    count = held_.struct.count
    order, scratch = np.empty(count, NUMBER), np.empty(count * SCRATCH_FLOATS, FLOAT)
    threads = threads_for(threads, count)
    if threads > 1:
        status = sort_by_steps(held_, order, scratch, threads)
    else:
        status = _c.sort(held_, ffi.from_buffer(NUMBERS, order), ffi.from_buffer(scratch))
    if status:
        check_indices(held_)
        raise error_of(status, triangles=count)
    return order


def in_order(held_, order, threads=1):
    """Triangles in an order, None for their own, as what an index is fastest over: a Soup, or a Mesh of float64."""
    count, double = held_.struct.count, is_double(held_)
    threads = threads_for(threads, count)
    if order is None:
        check_indices(held_)
        if held_.is_soup or not double:
            return held_ if held_.is_soup else Soup.of(held_)
    numbers = np.arange(count) if order is None else order
    parts = cut(count, threads * PARTS_EACH) if threads > 1 else [(0, count)]
    if double:
        triangles = np.empty((count, 3, 3), DOUBLE)

        def copy(part):
            triangles[slice(*part)] = by_number(held_, numbers[slice(*part)])

        in_threads(threads, copy, parts)
        return Mesh(triangles)
    soup, order_ = Soup(np.empty((3, 3, count), FLOAT)), ffi.from_buffer(NUMBERS, order)
    in_threads(threads, lambda part: check_sound(_c.gather(held_, order_, part[0], Part(soup, *part))), parts)
    return soup


class Index(metaclass=Brief):
    """An index over triangles, for many queries: the time of a query grows with its answer, not with all triangles.

    triangles: as for overlap, at most 2^32, of float32 or float64.
    keep_order: False copies the triangles into an order in which near triangles have near numbers, which makes queries fastest. It
        takes about 100 ns and 40 bytes for each triangle (76 for float64), and 16 more while it is made. True keeps their order: a
        Soup is then read in place and must not change; others are copied.

    threads: how many may share the work of making it. 1 by default, 0 for one on each processor. The Index does not depend on it.

    Answers are those of tribox.overlap, exact about the coordinates given. Triangles have their numbers in the array, Mesh or Soup.
    A box is lo and hi, three numbers each, or lo alone of shape (2, 3), or an OrientedBox. accuracy, axes, axis_order and kernel
    are as for overlap; axes must include AXES_BOX, and "fast" may report more triangles. Threads may query one Index at the same
    time. An Index can be pickled, and copied by the module copy; len() is the number of triangles. Errors are those of overlap.
    """

    _held: Union[Mesh, Soup]
    _ids: Optional[NDArray[np.uint32]]
    _nodes: NDArray[np.uint8]

    def __init__(self, triangles: TrianglesLike, *, keep_order: bool = False, threads: Optional[SupportsIndex] = 1) -> None:
        held_, threads = held(triangles), min(threads_of(threads), processors())
        check_count(held_, "an Index")
        order = None if keep_order else order_of(held_, threads)
        self._set(in_order(held_, order, threads), order, threads)

    def _set(self, held_, ids, threads=1):
        """held_: the triangles in the order of the index. ids: the number that each has for the caller; None: its place there."""
        self._held, self._ids = held_, ids
        self._nodes = np.empty(lib.tribox_index_bytes(len(held_)), np.uint8)
        ids_ = ffi.NULL if ids is None else ffi.from_buffer(NUMBERS, ids)
        self._index = _c.Indexed(ffi.from_buffer(self._nodes), held_, ids_)
        check(self._build(threads_for(threads, len(held_))), triangles=len(self))

    def _build(self, threads):
        """Writes the nodes; returns the status."""
        index, nodes, count, block = self._index.struct, self._index.nodes, len(self), lib.TRIBOX_INDEX_BLOCK
        if threads <= 1:
            return lib.tribox_index_build(index, ffi.NULL, nodes)

        def update(part):
            first, end = block * part[0], min(count, block * part[1])
            return lib.tribox_index_update(index, first, end - first, ffi.NULL, nodes)

        parts = cut(-(-count // block), threads)
        return max(in_threads(threads, update, parts)) or lib.tribox_index_update(index, 0, 0, ffi.NULL, nodes)

    def __len__(self) -> int:
        return len(self._held)

    def __repr__(self) -> str:
        order = "as given" if self._ids is None else "in order"
        what = "float64" if is_double(self._held) else "float32"
        return f"<tribox.Index: {len(self)} triangles of {what} {order}, {len(self._nodes)} bytes, {extent(self._held)}>"

    def __getstate__(self) -> Dict[str, Any]:
        whole = np.asarray(self._held.streams, order="C") if isinstance(self._held, Soup) else self._held.vertices
        return {"triangles": whole, "ids": self._ids}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        """The nodes, which are those of one version of the library, are built again."""
        triangles, ids = state["triangles"], state["ids"]
        held_: Union[Mesh, Soup] = Soup(triangles) if triangles.dtype == FLOAT else Mesh(triangles)
        if ids is not None and (ids.dtype, ids.shape) != (NUMBER, (len(held_),)):
            raise InputError(f"a pickled Index of {len(held_)} triangles has {ids.shape} numbers of type {ids.dtype}")
        self._set(held_, ids)

    def overlap(self, lo: Region, hi: Optional[Vector] = None, *, accuracy: Accuracy = "exact", axes: int = ALL,
                axis_order: int = 0, kernel: Optional[str] = None, packed: bool = False, out: Optional[Answer] = None) -> Answer:
        """Tells which triangles overlap the box: an array of n bool, as tribox.overlap returns it.

        packed, out: as for tribox.overlap. All n are written, so list() is faster if few overlap.
        """
        question = self._question(lo, hi, accuracy, axes, axis_order, kernel)
        count = len(self)
        if out is not None:
            packed = check_out(out, (count,), ((count + 63) >> 6,))
        if self._ids is None:
            words = new_words(count)
            self._ask(lib.tribox_index_overlap, question, pointer_to(words), ffi.NULL)
            answer = words if packed else bools(words, count)
        else:
            answer = np.zeros(count, bool)
            answer[self._list(question)] = True
            answer = rows_of_words(answer) if packed else answer
        if out is None:
            return answer
        out[:] = answer
        return out

    def count(self, lo: Region, hi: Optional[Vector] = None, *, accuracy: Accuracy = "exact", axes: int = ALL, axis_order: int = 0,
              kernel: Optional[str] = None) -> int:
        """The number of triangles that overlap the box."""
        question, report = self._question(lo, hi, accuracy, axes, axis_order, kernel), ffi.new("tribox_report *")
        self._ask(lib.tribox_index_overlap, question, ffi.NULL, report)
        return int(report.overlapping)

    def any(self, lo: Region, hi: Optional[Vector] = None, *, accuracy: Accuracy = "exact", axes: int = ALL, axis_order: int = 0,
            kernel: Optional[str] = None) -> bool:
        """Whether any triangle overlaps the box."""
        question, found = self._question(lo, hi, accuracy, axes, axis_order, kernel), ffi.new(FOUND)
        self._ask(lib.tribox_index_any, question, found)
        return found[0] < len(self)

    def list(self, lo: Region, hi: Optional[Vector] = None, *, accuracy: Accuracy = "exact", axes: int = ALL, axis_order: int = 0,
             kernel: Optional[str] = None) -> NDArray[np.uint32]:
        """The numbers of the triangles that overlap the box: an array of uint32.

        They are in the order of the index, which is ascending only with keep_order=True.
        """
        return self._list(self._question(lo, hi, accuracy, axes, axis_order, kernel))

    def lists(self, lo: Boxes, hi: Optional[Boxes] = None, *, accuracy: Accuracy = "exact", axes: int = ALL, axis_order: int = 0,
              kernel: Optional[str] = None, threads: Optional[SupportsIndex] = 1) -> Tuple[NDArray[np.uint32], NDArray[np.intp]]:
        """list() for many boxes: (list, start), where list[start[i]:start[i + 1]] has the triangles of box i.

        lo, hi: the corners of m boxes, arrays of shape (m, 3), or (3, m) if m is not 3; or lo alone, of shape (m, 2, 3). A box that
            is empty or not finite has no triangles.

        threads: how many may share the boxes. 1 by default, 0 for one on each processor. The lists do not depend on it.

        list: an array of uint32. start: m + 1 places, an array of intp. Boxes with near numbers should be near in space.
        """
        options, workers = options_of(accuracy, axes, axis_order, kernel), min(threads_of(threads), processors())
        check_box_axes(axes)
        los, his = bounds_of_boxes(lo, hi)
        count, lists = los.shape[1], self._lists if los.dtype == FLOAT else self._lists_each

        def work(part):
            first, end = part
            numbers, start = lists(los[:, first:end], his[:, first:end], options, np.zeros(end - first + 1, SIZE))
            return numbers[:start[-1]], start

        parts = min(PARTS_EACH * workers, count // BOXES_LEAST) if workers > 1 and los.dtype == FLOAT else 1
        each = in_threads(workers, work, cut(count, parts) if parts > 1 else [(0, count)])
        ends = np.cumsum([start[-1] for _, start in each], dtype=SIZE)
        starts = [each[0][1], *(start[1:] + end for (_, start), end in zip(each[1:], ends))]
        return np.concatenate([numbers for numbers, _ in each]), np.concatenate(starts).view(np.intp)

    def _lists(self, los, his, options, start):
        """By one call; those beyond its room by a second."""
        count = los.shape[1]
        numbers, done = np.empty(FIRST_ROOM + ROOM_EACH * count, NUMBER), 0
        while True:
            base, boxes = int(start[done]), Streams(los[:, done:], his[:, done:])
            to, starts = ffi.from_buffer(NUMBERS, numbers) + base, ffi.from_buffer(SIZES, start[done:])
            check(lib.tribox_index_lists(self._index.struct, boxes.struct, options, len(numbers) - base, to, starts))
            start[done:] += SIZE.type(base)
            if start[-1] <= len(numbers):
                return numbers, start
            done = int(np.searchsorted(start, len(numbers), "right")) - 1
            numbers = longer(numbers, int(start[-1]))

    def _lists_each(self, los, his, options, start):
        """Box by box."""
        count, rows = los.shape[1], Rows(los, his)
        numbers, done = np.empty(FIRST_ROOM + ROOM_EACH * count, NUMBER), 0
        while done < count:
            status, done, room = _c.list_each(self._index, rows.regions, options, numbers, start, done)
            check(status)
            numbers = numbers if done == count else longer(numbers, max(room, 2 * len(numbers)))
        return numbers, start

    def _question(self, lo, hi, accuracy, axes, axis_order, kernel):
        """(region, options, what the caller says of the box, for messages)."""
        options = options_of(accuracy, axes, axis_order, kernel)
        check_box_axes(axes)
        if isinstance(lo, OrientedBox):
            if hi is not None:
                raise InputError(f"hi = {shown(hi)}; give an OrientedBox alone")
            check_oriented(accuracy, axes)
            return _c.Region(oriented=oriented_of(*lo)), options, vars(lo)
        return _c.Region(box_of(lo, hi)), options, dict(lo=lo, hi=hi)

    def _list(self, question):
        found, room = ffi.new(FOUND), FIRST_ROOM
        while True:
            numbers = np.empty(room, NUMBER)
            self._ask(lib.tribox_index_list, question, room, ffi.from_buffer(NUMBERS, numbers), found)
            if found[0] <= room:
                return numbers if found[0] == room else numbers[:found[0]].copy()
            room = found[0]

    def _ask(self, call, question, *receivers):
        region, options, given = question
        check(call(self._index.struct, region.struct, options, *receivers), **given)


def longer(numbers, count):
    """The same numbers at the start of an array of so many."""
    return np.concatenate([numbers, np.empty(count - len(numbers), NUMBER)])


def check_box_axes(axes):
    if not axes & BOX:
        raise InputError(f"axes = {axes}; an Index needs AXES_BOX among them: without it far triangles overlap, too", "BAD_OPTION")
