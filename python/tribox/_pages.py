"""Room for many cells, on large pages where the system has them, and taken by the thread that first writes it."""

from __future__ import annotations

import mmap

import numpy as np

from ._masks import WORD

LARGE_PAGE = 1 << 21
# From here on malloc of glibc takes fresh pages for every array, and gives them back. Less is mostly used again, and clearing it
# takes less than fresh pages, which NumPy asks to be large, too.
MAPPED = 1 << 25
CAN_MAP = hasattr(mmap, "MADV_HUGEPAGE")


def mapped(count):
    """So many words of fresh pages, which are clear. They are given back with the last array that looks at them."""
    octets = -(-8 * count // LARGE_PAGE) * LARGE_PAGE
    try:
        pages = mmap.mmap(-1, octets + LARGE_PAGE, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
    except OSError as error:
        raise MemoryError(f"no memory for {octets} bytes of cells") from error
    words = np.frombuffer(pages, WORD)
    start = -words.ctypes.data % LARGE_PAGE
    try:
        pages.madvise(mmap.MADV_HUGEPAGE, start, octets)
    except OSError:  # a system without them: it is slower and no other
        pass
    return words[start // 8:start // 8 + count]


def new_words(shape):
    """(words, whether they are clear): others are to be cleared by who writes them."""
    count = shape[0] * shape[1] * shape[2]
    if CAN_MAP and 8 * count >= MAPPED:
        return mapped(count).reshape(shape), True
    return np.empty(shape, WORD), False
