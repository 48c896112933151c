"""The work in each layer of a window of cells, as a few of the triangles tell it."""

from __future__ import annotations

import numpy as np

from ._masks import row_words
from ._overlap import BOX

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
