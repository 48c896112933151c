"""The library's bits, and NumPy's arrays of bool."""

from __future__ import annotations

import sys

import numpy as np
from numpy.typing import NDArray

from ._errors import InputError, InputTypeError
from ._ffi import ffi
from ._library import lib

WORD, BYTE, BOOL = np.dtype(np.uint64), np.dtype(np.uint8), np.dtype(bool)
WORDS = ffi.typeof("uint64_t[]")
MASK_WORDS_MAX = 1 << 26  # of a mask that is listed


def new_words(count):
    return np.empty((count + 63) >> 6, WORD)


def pointer_to(words):
    return ffi.from_buffer(WORDS, words)


def bools(words, count):
    """The first `count` bits along the last axis, as an array of bool."""
    if sys.byteorder == "big":
        words = words.byteswap()
    return np.unpackbits(words.view(BYTE), -1, count, "little").view(BOOL)


def labels_of(words, inside, count):
    """1 for the first `count` bits that are set, and 2 for those of inside."""
    return bools(words, count).view(BYTE) + bools(inside, count).view(BYTE)


def row_words(width):
    """Of a row of so many cells."""
    return (width + 63) >> 6


def rows_of_words(cells):
    """An array of bool as words along the last axis, bit i % 64 of word i // 64 for its element i."""
    words = np.zeros((*cells.shape[:-1], row_words(cells.shape[-1])), WORD)
    words.view(BYTE)[..., :(cells.shape[-1] + 7) >> 3] = np.packbits(cells, -1, "little")
    return words.byteswap() if sys.byteorder == "big" else words


def check_out(out, shape, packed_shape):
    """Whether out is for packed bits: uint64 of one shape, where bool has the other. Anything else is an error."""
    dtype = out.dtype if isinstance(out, np.ndarray) else None
    if dtype != BOOL and dtype != WORD:
        raise InputTypeError(f"out is {dtype or type(out).__name__}; give a NumPy array of bool, or of uint64 for packed bits")
    wanted = shape if dtype == BOOL else packed_shape
    if out.shape != wanted:
        raise InputError(f"out has shape {out.shape}; give {wanted}")
    if not out.flags.writeable:
        raise InputError("out is read-only; give an array that can be written to")
    if dtype == WORD and not out.flags.c_contiguous:
        raise InputError("out is not contiguous; give packed bits an array that is, or bools")
    return dtype == WORD


def mask_indices(mask: NDArray[np.uint64]) -> NDArray[np.uint32]:
    """The indices of the set bits of packed words, in ascending order: an array of uint32.

    mask: a contiguous array of uint64, such as packed=True returns, of at most 2^26 words. Anything else raises an Error.
    """
    if not isinstance(mask, np.ndarray) or mask.dtype != WORD or not mask.flags.c_contiguous:
        raise InputTypeError("mask must be a contiguous array of uint64, as packed=True returns it")
    words, count = pointer_to(mask), 64 * mask.size
    if mask.size > MASK_WORDS_MAX:
        raise InputError(f"mask has {mask.size} words; list more than 2^26 in parts")
    indices = np.empty(lib.tribox_mask_indices(words, count, ffi.NULL), np.uint32)
    lib.tribox_mask_indices(words, count, ffi.from_buffer("uint32_t[]", indices))
    return indices
