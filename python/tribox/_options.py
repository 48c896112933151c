"""The keywords of a call as tribox_options."""

from functools import lru_cache

from ._errors import InputError, no_kernel
from ._ffi import ffi
from ._library import kernel_named, lib

ACCURACIES = {"exact": lib.TRIBOX_EXACT, "conservative": lib.TRIBOX_CONSERVATIVE, "fast": lib.TRIBOX_FAST}


# A call takes few microseconds, so options are made once. They point to nothing that Python could free.
@lru_cache(maxsize=256)
def options_of(accuracy, axes, order, kernel):
    if accuracy not in ACCURACIES:
        raise InputError(f"accuracy = {accuracy!r}; it is one of {', '.join(map(repr, ACCURACIES))}")
    try:
        options = ffi.new("tribox_options *", (ACCURACIES[accuracy], axes, order, ffi.NULL))
    except (OverflowError, TypeError) as error:
        raise InputError(f"axes = {axes!r}, order = {order!r}: {error}") from None
    if kernel is not None:
        options.kernel = kernel_named(kernel)
        if not options.kernel:
            raise no_kernel(kernel)
    return options
