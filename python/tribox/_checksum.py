"""The 64-bit checksum of partitions: FNV-1a with words of 64 bits in place of bytes. The man page of tribox states it (FORMATS)."""

import sys

import numpy as np

EMPTY, PRIME, WORD_MAX = 0xcbf29ce484222325, 0x100000001b3, (1 << 64) - 1
BLOCK = 1 << 19  # words that are taken at once
FEW = 16  # parts: fewer go one by one


def go_on(total, words):
    for word in words:
        total = (total ^ word) * PRIME & WORD_MAX
        total ^= total >> 32
    return total


def checksum(octets):
    """Of a whole number of words."""
    return go_on(EMPTY, np.frombuffer(octets, np.uint64).tolist())


def checksums_of_rows(words):
    """Of each row of an array of uint64."""
    totals = np.full(len(words), EMPTY, np.uint64)
    for column in words.T:
        totals = (totals ^ column) * np.uint64(PRIME)
        totals ^= totals >> np.uint64(32)
    return totals


def words_of(halves, at, ends):
    """The words that begin at these places of an array of uint32; a zero fills one that ends after its first half."""
    has_high = at + 1 < ends
    high = halves[np.where(has_high, at + 1, at)].astype(np.uint64)
    high[~has_high] = 0
    low, shift = halves[at].astype(np.uint64), np.uint64(32)
    return low | high << shift if sys.byteorder == "little" else low << shift | high


def checksums_in_step(halves, starts, ends, counts):
    """Of parts of which none is longer than the one before it, counts[n] words of each: a word of each at a step."""
    active = np.searchsorted(-counts, -np.arange(counts[0]), "left")  # parts that have such a word
    begins = np.cumsum(active) - active
    part = np.repeat(np.arange(len(counts)), counts)
    step = np.arange(len(part)) - np.repeat(np.cumsum(counts) - counts, counts)
    words = np.empty(len(part), np.uint64)
    words[begins[step] + part] = words_of(halves, starts[part] + 2 * step, ends[part])
    totals, shifted = np.full(len(counts), EMPTY, np.uint64), np.empty(len(counts), np.uint64)
    prime, half = np.uint64(PRIME), np.uint64(32)
    steps = int(np.searchsorted(-active, -FEW, "right"))
    for begin, count in zip(begins[:steps].tolist(), active[:steps].tolist()):
        total, above = totals[:count], shifted[:count]
        np.bitwise_xor(total, words[begin:begin + count], out=total)
        np.multiply(total, prime, out=total)
        np.right_shift(total, half, out=above)
        np.bitwise_xor(total, above, out=total)
    for n in np.flatnonzero(counts > steps).tolist():
        totals[n] = go_on(int(totals[n]), words[begins[steps:counts[n]] + n].tolist())
    return totals


def checksums(halves, starts, ends):
    """Of many parts of an array of uint32, halves[starts[n]:ends[n]] each."""
    starts, ends = starts.astype(np.int64), ends.astype(np.int64)
    counts = (ends - starts + 1) >> 1
    order, answer = np.argsort(-counts, kind="stable"), np.empty(len(counts), np.uint64)
    block = np.cumsum(counts[order]) // BLOCK
    for part in np.split(order, np.flatnonzero(np.diff(block)) + 1) if len(order) else ():
        answer[part] = checksums_in_step(halves, starts[part], ends[part], counts[part])
    return answer
