"""Boxes as callers write them: one, an oriented one, or very many."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Iterator

import numpy as np

from ._arguments import DOUBLE, FLOAT, address_of, numbers, three, three_times_three
from ._errors import Brief, InputError, shown
from ._ffi import ffi
from ._typing import Frame, Vector

BOX, BOXES, ORIENTED = ffi.typeof("tribox_box *"), ffi.typeof("tribox_box[]"), ffi.typeof("tribox_oriented_box *")
REGIONS = ffi.typeof("tribox_region[]")
NO_BOX = 1, 1, 1, 0, 0, 0  # the empty box


@dataclass(frozen=True, eq=False)
class OrientedBox(metaclass=Brief):
    """The closed box of the points p with abs(axis[k] @ (p - center)) <= half[k], for k = 0, 1, 2.

    overlap, find, crop and an Index take one in place of lo and hi.

    center, half: three finite numbers each, in the unit of the triangles. axis: the three directions of the box, of shape (3, 3);
    of length 1 if half is to be in that unit. They need not be orthonormal. All numbers are taken as doubles, without rounding.
    """

    center: Vector
    half: Vector
    axis: Frame

    def __iter__(self) -> Iterator[Any]:
        """center, half, axis = box"""
        return iter((self.center, self.half, self.axis))


def corner(name, point):
    try:
        return three(name, point)
    except InputError as error:
        if not np.iterable(point) or not any(map(np.iterable, point)) or isinstance(point, str):
            raise
        raise InputError(f"{error}, as one box is asked about here; tribox.Index(triangles).lists(lo, hi) takes many") from None


def check_unturned(lo):
    if isinstance(lo, OrientedBox):
        raise InputError(f"lo = {shown(lo)}; this call takes a box from lo to hi; overlap, find and crop take an OrientedBox")


def box_of(lo, hi):
    """One box; hi is None where lo has both corners."""
    check_unturned(lo)
    if hi is None:
        try:
            lo, hi = lo
        except (TypeError, ValueError):
            raise InputError(f"lo = {shown(lo)} and there is no hi; give lo and hi, three numbers each, or both corners as one "
                             "argument of shape (2, 3)") from None
    return ffi.new(BOX, (corner("lo", lo), corner("hi", hi)))


def oriented_of(center, half, axis):
    return ffi.new(ORIENTED, (three("center", center), three("half", half), three_times_three("axis", axis)))


def columns(name, bounds):
    """Bounds of boxes as an array of shape (3, m)."""
    shape = bounds.shape
    if shape == (0,):
        return bounds.reshape(3, 0)
    if len(shape) != 2 or 3 not in shape:
        raise InputError(f"{name} has shape {shape}; give (m, 3), a row for each box, or (3, m)")
    return bounds.T if shape[1] == 3 else bounds


def bounds_of_boxes(lo, hi):
    """The lower and the upper bounds of many boxes, of shape (3, m); both of float32 if that holds them, else of float64."""
    check_unturned(lo[0] if isinstance(lo, (list, tuple)) and lo else lo)
    if hi is None:
        both = numbers("lo", lo)
        if both.ndim != 3 or both.shape[1:] != (2, 3):
            raise InputError(f"lo has shape {both.shape} and there is no hi; give lo and hi, of shape (m, 3) each, or both corners "
                             "as one argument of shape (m, 2, 3)")
        los, his = both[:, 0].T, both[:, 1].T
    else:
        los, his = columns("lo", numbers("lo", lo)), columns("hi", numbers("hi", hi))
    if los.shape != his.shape:
        raise InputError(f"lo has {los.shape[1]} boxes and hi {his.shape[1]}")
    if los.dtype == his.dtype == FLOAT:
        return los, his
    with np.errstate(over="ignore", under="ignore"):
        singles = los.astype(FLOAT), his.astype(FLOAT)
    if all(np.array_equal(single, array, equal_nan=True) for single, array in zip(singles, (los, his))):
        return singles
    return los.astype(DOUBLE), his.astype(DOUBLE)


class Streams:
    """Bounds of float32 as tribox_boxes."""

    def __init__(self, los, his):
        self.arrays = [array if array.shape[1] <= 1 or array.strides[1] == 4 else np.ascontiguousarray(array)
                       for array in (los, his)]
        pointers = [[ffi.cast("float *", address_of(array) + axis * array.strides[0]) for axis in range(3)]
                    for array in self.arrays]
        self.struct = ffi.new("tribox_boxes *", (*pointers, los.shape[1]))


class Rows:
    """Bounds as an array of tribox_box, and one of tribox_region; a box that is not finite is empty."""

    def __init__(self, los, his):
        self.array = np.concatenate([los, his]).T.astype(DOUBLE, order="C")
        self.array[~np.isfinite(self.array).all(1)] = NO_BOX
        self.boxes = ffi.from_buffer(BOXES, self.array)
        self.pointers = np.zeros((len(self.array), 2), np.uintp)
        self.pointers[:, 0] = address_of(self.array) + self.array.strides[0] * np.arange(len(self.array))
        self.regions = ffi.from_buffer(REGIONS, self.pointers)
