"""An order in which triangles are near in number where they are near in space, by one thread or several: it is the same."""

from __future__ import annotations

import numpy as np

from . import _c
from ._errors import check_indices, error_of
from ._ffi import ffi
from ._library import lib
from ._numbers import DOUBLE, FLOAT
from ._threads import cut, in_threads
from ._triangles import Mesh, Part, Soup, by_number, check_sound, is_double

NUMBER = np.dtype(np.uint32)
NUMBERS, COUNT = ffi.typeof("uint32_t[]"), ffi.typeof("size_t *")
SCRATCH_FLOATS = 4  # a triangle
PARTS_EACH = 4  # of each thread
SHARED_LEAST = 1 << 16  # triangles: threads gain nothing with fewer


def threads_for(threads, count):
    return threads if count >= SHARED_LEAST else 1


def sort_by_steps(held_, order, scratch, threads):
    """The steps of one sort, each by threads; returns the status."""
    count, numbers, room = held_.struct.count, ffi.from_buffer(NUMBERS, order), ffi.from_buffer(scratch)

    def halves(part):
        first, end = part
        before = ffi.new(COUNT)
        check_sound(lib.tribox_sort_cut(room, count, first, end - first, before))
        middle = first + before[0]
        return [(first, middle), (middle, end)]

    def finish(part):
        first, end = part
        check_sound(lib.tribox_sort_finish(room, count, first, end - first, numbers))

    status = max(in_threads(threads, lambda part: _c.sort_start(held_, *part, room), cut(count, threads * PARTS_EACH)))
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
