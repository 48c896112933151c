"""What callers write, numbers, arrays and words, as the library takes it. Whatever cannot be taken is an Error."""

from functools import lru_cache
from math import inf
from operator import index

import numpy as np
from numpy import ndarray

from ._errors import InputError, InputTypeError, error_of, shown
from ._ffi import ffi
from ._library import KERNELS, lib

FLOAT, DOUBLE = np.dtype(np.float32), np.dtype(np.float64)
WHOLE_MAX = 1 << 53  # up to here float64 holds every whole number


def address_of(array):
    """Where an array begins. from_buffer takes contiguous arrays alone."""
    return array.__array_interface__["data"][0]


def array_of(name, value):
    """Nested lists, and whatever else NumPy makes an array of."""
    if isinstance(value, np.ndarray):
        return value
    try:
        return np.asarray(value)
    except Exception as error:
        raise InputTypeError(f"{name} is of type {type(value).__name__}, of which NumPy makes no array: {shown(error)}") from None


def place_of(wrong):
    """The first place where an array of bool is true, as it is written."""
    return ", ".join(map(str, np.argwhere(wrong)[0]))


def first_of(array, wrong):
    """The number at that place."""
    return array[tuple(np.argwhere(wrong)[0])]


def numbers(name, value, form="in a NumPy array or in nested lists"):
    """An array of float32 or float64 with these numbers, the caller's own where it is one."""
    array = array_of(name, value)
    dtype = array.dtype
    if dtype == FLOAT or dtype == DOUBLE:
        return array
    if dtype.kind not in "iuf":
        raise InputTypeError(f"{name} is {type(value).__name__} of {dtype}; give real numbers, {form}")
    if np.can_cast(dtype, FLOAT):
        return array.astype(FLOAT)
    with np.errstate(over="ignore"):
        same = array.astype(DOUBLE)
    if dtype.kind == "f":
        wrong = (same != array) & ~np.isnan(array)
    elif dtype.itemsize == 8:
        wrong = array > WHOLE_MAX if dtype.kind == "u" else (array > WHOLE_MAX) | (array < -WHOLE_MAX)
    else:
        return same
    if wrong.any():
        raise InputError(f"{name}[{place_of(wrong)}] is {first_of(array, wrong)}, of {dtype}: float64, the widest that is read, "
                         "cannot hold it; round, or subtract an offset")
    return same


def check_floats(name, array):
    """Raises what float32 cannot hold of an array."""
    with np.errstate(over="ignore", under="ignore"):
        wrong = (array.astype(FLOAT) != array) & ~np.isnan(array)
    if wrong.any():
        raise InputError(f"{name}[{place_of(wrong)}] is {float(first_of(array, wrong))!r}, which float32 cannot hold; a Soup is of "
                         "float32: give the triangles themselves, as every call takes float64, or round them")


ACCURACIES = {"exact": lib.TRIBOX_EXACT, "conservative": lib.TRIBOX_CONSERVATIVE, "fast": lib.TRIBOX_FAST}
AXES = range(1, lib.TRIBOX_AXES_ALL + 1)
AXIS_ORDERS = 0, 123, 132, 213, 231, 312, 321


def number(value):
    """A lone number as float. One that float cannot hold is infinite."""
    try:
        return float(value)
    except OverflowError:
        return inf if value > 0 else -inf


def three(name, numbers, advice="give three numbers: x, y, z"):
    try:
        x, y, z = map(number, numbers.tolist() if isinstance(numbers, ndarray) else numbers)
    except (TypeError, ValueError):
        raise InputError(f"{name} = {shown(numbers)}; {advice}") from None
    return x, y, z


def three_times_three(name, rows):
    try:
        first, second, third = rows
    except (TypeError, ValueError):
        raise InputError(f"{name} = {shown(rows)}; give three times three numbers") from None
    return [three(f"{name}[{place}]", row) for place, row in enumerate((first, second, third))]


def whole(value, least, most):
    """A whole number within these; None if it is none."""
    try:
        value = index(value)
    except TypeError:
        return None
    return value if least <= value <= most else None


def wholes(values, least, most, count=3):
    """So many whole numbers within these, as a tuple; None if they are none."""
    try:
        values = tuple(whole(value, least, most) for value in values)
    except TypeError:
        return None
    return values if len(values) == count and None not in values else None


def range_of(name, value, count, what):
    """(first, count) of some of so many, by default of all."""
    if value is None:
        return 0, count
    pair = wholes(value, 0, count, 2)
    if not pair or sum(pair) > count:
        raise InputError(f"{name} = {shown(value)}; give (first, count) within the {count} {what}")
    return pair


def meaning(word, meanings):
    """What a word stands for; None if it stands for nothing."""
    return meanings.get(word) if isinstance(word, str) else None


def new_options(accuracy, axes, axis_order, kernel):
    value = meaning(accuracy, ACCURACIES)
    if value is None:
        raise InputError(f"accuracy = {shown(accuracy)}; give one of {', '.join(map(repr, ACCURACIES))}")
    if whole(axes, AXES[0], AXES[-1]) is None:
        raise InputError(f"axes = {shown(axes)}; give a union of AXES_BOX, AXES_PLANE and AXES_EDGES", "BAD_OPTION")
    if whole(axis_order, 0, 321) not in AXIS_ORDERS:
        raise InputError(f"axis_order = {shown(axis_order)}; give one of {', '.join(map(str, AXIS_ORDERS))}", "BAD_OPTION")
    options = ffi.new("tribox_options *", (value, axes, axis_order, ffi.NULL))
    if kernel is not None:
        options.kernel = meaning(kernel, KERNELS) or ffi.NULL
        if not options.kernel:
            raise InputError(f"kernel = {shown(kernel)}; this processor runs {', '.join(KERNELS)}", "NO_KERNEL")
    return options


# A call takes a few microseconds, so options are made once. They point to nothing that Python could free.
cached_options = lru_cache(maxsize=256, typed=True)(new_options)


def options_of(accuracy, axes, axis_order, kernel):
    """The keywords of a call as tribox_options."""
    try:
        return cached_options(accuracy, axes, axis_order, kernel)
    except TypeError:  # it has no hash, so it is not an option either
        return new_options(accuracy, axes, axis_order, kernel)


def check(status, **arguments):
    """Raises what a status stands for. arguments: those of the call that it may be about."""
    if status:
        is_option = status == lib.TRIBOX_BAD_OPTION
        raise error_of(status, **{name: value for name, value in arguments.items() if (name == "axes") == is_option})
