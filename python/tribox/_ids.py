"""For each cell that is set the lowest number of a triangle that overlaps it."""

from __future__ import annotations

import threading

import numpy as np

from . import _c
from ._arguments import check
from ._errors import InputError, check_indices
from ._ffi import ffi
from ._masks import BYTE, MASK_WORDS_MAX, bools, mask_indices, pointer_to
from ._threads import cut, in_threads
from ._tiles import NUMBER, NUMBERS

AT_ONCE = 1 << 23  # cells, of four bytes each: more layers are taken in turn
TRIANGLES_MAX = 0xFFFFFFFF


def check_ids(held_):
    if held_.struct.count > TRIANGLES_MAX:
        raise InputError(f"{held_.struct.count} triangles are too many for ids; give at most {TRIANGLES_MAX}")


def set_with_ids(held_, grid, first, size, options, words, room=None):
    """Sets the cells of a window, whose words are clear. Returns the ids of all its cells: any numbers of those that stay clear."""
    nx, ny, nz = size
    ids = np.empty((nz, ny, nx), NUMBER) if room is None else room[:nx * ny * nz].reshape(nz, ny, nx)
    window = ffi.new("tribox_window *", (first, size))
    check(_c.voxelize_ids(held_, 0, grid, window, options, pointer_to(words), ffi.from_buffer(NUMBERS, ids), ffi.NULL))
    return ids


class Room(threading.local):
    """Ids of as many cells, for each thread: new memory would take longer than they do."""

    def __init__(self, cells):
        self.ids = np.empty(cells, NUMBER)


def set_ones(ids, words):
    """The ids of the cells that are set."""
    found, across = mask_indices(words), 64 * words.shape[2]
    gap = across - ids.shape[2]
    return ids.reshape(-1)[found - found // NUMBER.type(across) * NUMBER.type(gap) if gap else found]


def window_ids(task, threads):
    """Sets the cells of a Task. Returns the ids of those that are set, in the order of k, j, i."""
    check_indices(task.held)
    nx, ny, nz = task.size
    if not task.words.size:
        return np.empty(0, NUMBER)

    slabs = cut(nz, max(threads, -(-nx * ny * nz // AT_ONCE)))
    room = Room(nx * ny * max(high - low for low, high in slabs))

    def work(slab):
        low, high = slab
        own = task.words[low:high]
        own.fill(0)
        first, size = (*task.first[:2], task.first[2] + low), (nx, ny, high - low)
        ids = set_with_ids(task.held, task.grid, first, size, task.options, own, room.ids)
        return set_ones(ids, own) if own.size <= MASK_WORDS_MAX else ids[bools(own, nx)]

    return np.concatenate(in_threads(threads, work, slabs))


def brick_ids(ids, at, bits):
    """Those of the cells of the bricks that a tile was cut into, in their order. at: of the bricks, counted from the first."""
    nx, ny, nz = (-(-size // 8) for size in ids.shape[::-1])
    padded = np.zeros((8 * nz, 8 * ny, 8 * nx), NUMBER)
    padded[:ids.shape[0], :ids.shape[1], :ids.shape[2]] = ids
    i, j, k = at.T
    found = padded.reshape(nz, 8, ny, 8, nx, 8)[k, :, j, :, i, :]
    return found[bits_of_bricks(bits)]


def cells_of_ids(ids, are_set):
    """An array of a number for each cell, of those that are set the next of ids."""
    cells = np.zeros(are_set.shape, NUMBER)
    cells[are_set] = ids[:np.count_nonzero(are_set)]
    return cells


def bits_of_bricks(bits):
    """An array of bool of shape (n, 8, 8, 8): brick, k, j, i."""
    octets = bits.astype("<u8", copy=False).view(BYTE).reshape(-1, 8, 8, 1)
    return np.unpackbits(octets, -1, bitorder="little").view(bool)
