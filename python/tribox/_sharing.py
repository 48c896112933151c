"""One voxelization, by as many threads as gain something; and how much work is in each layer of its cells."""

from __future__ import annotations

from collections import deque
from functools import reduce
from typing import Any, NamedTuple, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _c
from ._arguments import FLOAT
from ._errors import check_indices
from ._ffi import ffi
from ._library import lib
from ._masks import pointer_to, row_words
from ._overlap import BOX
from ._threads import cut, in_threads, processors, taken_from
from ._triangles import Part, Soup, is_double

BINS = 1 << 10  # at most: layers, or groups of them
TRIANGLE, ROW, WORD = 4, 7, 0.7  # nanoseconds, roughly: only their ratios matter


def sample_of(held_, stride):
    """Each of so many triangles, as an array of shape (n, 3, 3), whatever their indices are."""
    if held_.is_soup:
        return np.stack([np.stack([stream[::stride] for stream in axis], 1) for axis in held_.streams], 2)
    if held_.faces is None:
        return held_.vertices[::stride]
    return held_.vertices.take(held_.faces[::stride], 0, mode="clip") if len(held_.vertices) else np.empty((0, 3, 3))


class LayersWork:
    """sample: how many triangles are looked at, at least, where there are as many."""

    def __init__(self, held_, grid, first, size, axes, sample):
        count, (_, ny, self.layers) = held_.struct.count, size
        bins = min(self.layers, BINS)
        each = self.layers / bins
        work = np.full(bins, WORD * ny * row_words(size[0]) * each)
        if axes & BOX and count:
            stride = count // sample | 1  # odd: quads are often two triangles each
            work += stride * self._in_bins(sample_of(held_, stride), grid, first, size, bins, each)
        self.up_to = np.cumsum(work)

    @staticmethod
    def _in_bins(triangles, grid, first, size, bins, each):
        """Of these triangles: what one costs by itself and by the rows of cells that it meets."""
        with np.errstate(all="ignore"):
            place = (triangles - tuple(grid.origin)) / tuple(grid.cell) - first  # in cells
            a, b, c = place[:, 0], place[:, 1], place[:, 2]
            lo, hi = np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
            (_, y, z), (_, other_y, other_z), (_, wide, high) = (b - a).T, (c - a).T, (hi - lo).T
            height = high + 1
            rows = np.abs(y * other_z - other_y * z) / 2 + wide + height
            in_bin = (TRIANGLE / height + ROW * np.minimum(rows / height, size[1])) * np.minimum(height, each)
            in_bin[~((hi >= 0) & (lo <= size)).all(1)] = 0  # as of what is not finite
            from_, to = (np.fmin(np.fmax(at[:, 2] / each, 0), bins - 1).astype(int) for at in (lo, hi))
        return np.cumsum(np.bincount(from_, in_bin, bins + 1) - np.bincount(to + 1, in_bin, bins + 1))[:bins]

    def cut(self, parts):
        """(first, end) of so many parts of about the same work, of the layers that they have."""
        bins, each = len(self.up_to), self.layers / len(self.up_to)
        ends = np.interp(self.up_to[-1] * np.arange(1, parts) / parts, self.up_to, np.arange(1, bins + 1)).tolist()
        borders = [0, *(round(each * end) for end in ends), self.layers]
        return [(low, high) for low, high in zip(borders, borders[1:]) if low < high]


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
