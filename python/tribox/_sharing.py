"""One voxelization, by as many threads as gain something."""

from __future__ import annotations

from collections import deque
from functools import reduce
from typing import Any, NamedTuple, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _c
from ._errors import check_indices
from ._ffi import ffi
from ._layers import LayersWork
from ._library import lib
from ._masks import pointer_to
from ._numbers import FLOAT
from ._threads import cut, in_threads, processors, taken_from
from ._triangles import Part, Soup, is_double

SHARES_EACH = 8  # of each thread: some triangles have far more cells than others
SLABS_EACH = 4  # of each thread, of layers that are cut without looking for the work in each, where triangles are
FEW = 1 << 11
COPIED_AT_ONCE = 1 << 16  # triangles
COPIED_COUNTS = range(1 << 19, 1 << 22)  # fewer take no time, and more take memory: 36 bytes each
JOINED_ALONE = 1 << 14  # words of cells that one thread joins
# Nanoseconds, as measured with two threads:
START = 9e4  # of threads
MESH, SOUP = 5, 2  # of a triangle, whether or not it meets a cell
COPIED, SKIPPED = 2.5, 0.7  # of a triangle that becomes part of a soup, and of one in other layers
CELLS = 3.5  # of a word of cells, at the least
JOIN = 1.5  # of a word of cells that every thread has for itself
CUT, SAMPLE = 3.5e5, 2e4  # of cutting layers; of work for each triangle that is looked at for that


class Task(NamedTuple):
    """Triangles and a window of a grid, of which they set cells."""

    held: Any
    grid: Any
    first: Tuple[int, int, int]
    size: Tuple[int, int, int]
    options: Any
    words: NDArray[np.uint64]
    are_clear: bool  # otherwise they are made so
    call: Any = _c.voxelize

    def run(self, threads):
        """Sets the cells; returns the status."""
        way = self.way(min(threads, processors()))
        if way:
            return way()
        if not self.are_clear:
            self.words.fill(0)
        return self.set(self.held, self.first, self.size, self.words)

    def set(self, held_, first, size, words):
        return self.call(held_, self.grid, ffi.new("tribox_window *", (first, size)), self.options, pointer_to(words), ffi.NULL)

    def way(self, threads):
        """What shares the work out where that gains something."""
        if threads < 2:
            return None
        count, words = self.held.struct.count, self.words.size
        work, gained = (SOUP if self.held.is_soup else MESH) * count + CELLS * words, 1 - 1 / threads
        looked_at, join = COPIED / threads * count * self.is_copied() + SKIPPED * gained * count, JOIN * words
        looked_at += CUT * (count >= FEW)
        if work * gained < START + min(looked_at, join):
            return None
        if join < looked_at:
            return lambda: self.by_shares(threads)
        return lambda: self.by_slabs(threads, int(work / SAMPLE))

    def is_copied(self):
        """Whether threads first make a soup of the triangles, of which they skip sooner what is elsewhere."""
        return not self.held.is_soup and not is_double(self.held) and self.held.struct.count in COPIED_COUNTS

    def by_slabs(self, threads, sample):
        """By threads, each of which owns some layers and looks at all triangles. sample: how many tell what work there is."""
        count, triangles = self.held.struct.count, self.held
        if self.is_copied():
            triangles = Soup(np.empty((3, 3, count), FLOAT))

        def prepare(part):
            if part is None and count < FEW:
                return cut(self.size[2], threads * SLABS_EACH)
            if part is None:
                return LayersWork(self.held, self.grid, self.first, self.size, self.options.axes, sample).cut(threads)
            to = Part(triangles, *part).struct
            return lib.tribox_mesh_to_soup(self.held.struct, ffi.NULL, part[0], to.count, ffi.NULL, to.x, to.y, to.z)

        def work(slab):
            low, high = slab
            own = self.words[low:high]
            if not self.are_clear:
                own.fill(0)
            return self.set(triangles, (*self.first[:2], self.first[2] + low), (*self.size[:2], high - low), own)

        parts = cut(count, -(-count // COPIED_AT_ONCE)) if triangles is not self.held else []
        slabs, *statuses = in_threads(threads, prepare, [None, *parts])
        return max(statuses, default=0) or max(in_threads(threads, work, slabs))

    def by_shares(self, threads):
        """By threads, each of which has some of the triangles, and all cells but the first's for itself."""
        check_indices(self.held)  # of all triangles: one share should write nothing where another has a wrong one
        shares, used, statuses = deque(cut(self.held.struct.count, threads * SHARES_EACH)), [self.words], []
        if not self.are_clear:
            self.words.fill(0)

        def work(number):
            own = None
            for share in taken_from(shares):
                if own is None:
                    own = np.zeros_like(self.words) if number else self.words
                statuses.append(self.set(Part(self.held, *share), self.first, self.size, own))
            if number and own is not None:
                used.append(own)

        def join(layers):
            reduce(lambda into, own: np.bitwise_or(into, own, out=into), (own[slice(*layers)] for own in used))

        in_threads(threads, work, range(threads))
        in_threads(threads if self.words.size > JOINED_ALONE else 1, join, cut(self.size[2], threads))
        return max(statuses)
