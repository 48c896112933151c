"""What callers write, numbers and words, as the library takes it. Whatever cannot be taken is an InputError."""

from functools import lru_cache
from math import inf, isfinite
from struct import Struct

from numpy import ndarray

from ._errors import InputError, error_of, named, shown
from ._ffi import ffi
from ._library import KERNELS, lib

FLOATS = {count: Struct(f"{count}f") for count in (6, 9)}
ACCURACIES = {"exact": lib.TRIBOX_EXACT, "conservative": lib.TRIBOX_CONSERVATIVE, "fast": lib.TRIBOX_FAST}


def number(value):
    """A lone number as float. One that float cannot hold is infinite, as it is when floats are rounded to float32."""
    try:
        return float(value)
    except OverflowError:
        return inf if value > 0 else -inf


def three(name, numbers):
    try:
        x, y, z = map(number, numbers.tolist() if isinstance(numbers, ndarray) else numbers)
    except (TypeError, ValueError):
        raise InputError(f"{name} = {shown(numbers)}; give three numbers: x, y, z") from None
    return x, y, z


def finite_three(name, numbers):
    x, y, z = three(name, numbers)
    if not (isfinite(x) and isfinite(y) and isfinite(z)):
        raise InputError(f"{name} = {shown(numbers)}; give three finite numbers")
    return x, y, z


def are_floats(*numbers):
    """Whether float32 holds these numbers; NaN and infinity are what they are in either."""
    form = FLOATS[len(numbers)]
    try:
        rounded = form.unpack(form.pack(*numbers))
    except OverflowError:
        return False
    return rounded == numbers or all(a == b or a != a for a, b in zip(numbers, rounded))


def three_times_three(name, rows):
    try:
        first, second, third = rows
    except (TypeError, ValueError):
        raise InputError(f"{name} = {shown(rows)}; give three times three numbers") from None
    return [three(f"{name}[{place}]", row) for place, row in enumerate((first, second, third))]


def meaning(word, meanings):
    """What a word stands for; None if it stands for nothing."""
    return meanings.get(word) if isinstance(word, str) else None


def new_options(accuracy, axes, order, kernel):
    value = meaning(accuracy, ACCURACIES)
    if value is None:
        raise InputError(f"accuracy = {shown(accuracy)}; give one of {', '.join(map(repr, ACCURACIES))}")
    try:
        options = ffi.new("tribox_options *", (value, axes, order, ffi.NULL))
    except (OverflowError, TypeError) as error:
        raise InputError(f"{named(dict(axes=axes, order=order))}: {error}") from None
    if kernel is not None:
        options.kernel = meaning(kernel, KERNELS) or ffi.NULL
        if not options.kernel:
            raise InputError(f"kernel = {shown(kernel)}; this processor runs {', '.join(KERNELS)}", "NO_KERNEL")
    return options


# A call takes a few microseconds, so options are made once. They point to nothing that Python could free.
cached_options = lru_cache(maxsize=256, typed=True)(new_options)


def options_of(accuracy, axes, order, kernel):
    """The keywords of a call as tribox_options."""
    try:
        return cached_options(accuracy, axes, order, kernel)
    except TypeError:  # it has no hash, so it is not an option either
        return new_options(accuracy, axes, order, kernel)


def check(status, **arguments):
    """Raises what a status stands for. arguments: those of the call that it may be about."""
    if status:
        options = ("accuracy", "axes", "order")
        is_option = status == lib.TRIBOX_BAD_OPTION
        raise error_of(status, **{name: value for name, value in arguments.items() if (name in options) == is_option})
