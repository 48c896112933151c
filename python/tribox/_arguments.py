"""What callers write, numbers and words, as the library takes it. Whatever cannot be taken is an InputError."""

from functools import lru_cache
from math import inf
from operator import index

from numpy import ndarray

from ._errors import InputError, error_of, shown
from ._ffi import ffi
from ._library import KERNELS, lib

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
