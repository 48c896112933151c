"""The 64-bit checksum of partitions: FNV-1a with words of 64 bits in place of bytes. The man page of tribox states it (FORMATS)."""

import sys

import numpy as np

EMPTY, PRIME, WORD_MAX = 0xcbf29ce484222325, 0x100000001b3, (1 << 64) - 1


def checksum(octets):
    """Of a whole number of words."""
    total = EMPTY
    for word in np.frombuffer(octets, np.uint64).tolist():
        total = (total ^ word) * PRIME & WORD_MAX
        total ^= total >> 32
    return total


def checksums(halves, starts, ends):
    """Of many parts of an array of uint32, halves[starts[n]:ends[n]] each, where a zero fills the last word: all at once."""
    order = np.argsort(starts - ends, kind="stable")  # the longest first, so that those that go on are at the front
    at, end = starts[order].astype(np.int64), ends[order].astype(np.int64)
    steps, totals = (end - at + 1) >> 1, np.full(len(order), EMPTY, np.uint64)
    shift = np.array([0, 32] if sys.byteorder == "little" else [32, 0], np.uint64)  # of the halves of a word, as they lie
    for step in range(int(steps[0]) if len(steps) else 0):
        active = int(np.searchsorted(-steps, -step, "left"))
        low = at[:active] + 2 * step
        has_high = low + 1 < end[:active]
        high = np.where(has_high, halves[np.where(has_high, low + 1, low)], 0).astype(np.uint64)
        word = halves[low].astype(np.uint64) << shift[0] | high << shift[1]
        total = (totals[:active] ^ word) * np.uint64(PRIME)
        totals[:active] = total ^ total >> np.uint64(32)
    answer = np.empty_like(totals)
    answer[order] = totals
    return answer
