"""Arrays of numbers as callers hold them: float32 and float64 as they are, all else as the same numbers in one of the two."""

import numpy as np

from ._errors import InputError, InputTypeError, shown

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
