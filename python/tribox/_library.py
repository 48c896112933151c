"""Loads libtribox: the file that the environment variable TRIBOX_LIBRARY names, or the installed library."""

import os
from itertools import count, takewhile

from ._ffi import ffi

NAME = "libtribox.so.0"


def load():
    path = os.environ.get("TRIBOX_LIBRARY") or NAME
    try:
        library = ffi.dlopen(path)
    except OSError as error:
        raise ImportError(f"{error}; install libtribox, or set TRIBOX_LIBRARY to the path of {NAME}") from None
    try:
        for function in dir(library):
            getattr(library, function)
    except ffi.error as error:
        raise ImportError(f"{path} does not fit this module: {error}") from None
    return library


def list_kernels():
    """Of each kernel that this processor runs the name, and the library's own spelling, which lives as long as the library."""
    pointers = map(lib.tribox_kernel_list, count())
    return {ffi.string(pointer).decode(): pointer for pointer in takewhile(bool, pointers)}


lib = load()
VERSION = f"{lib.TRIBOX_VERSION_MAJOR}.{lib.TRIBOX_VERSION_MINOR}.{lib.TRIBOX_VERSION_PATCH}"
KERNELS = list_kernels()


def kernels():
    """The names of the kernels that this processor runs, widest first. The first is the default."""
    return list(KERNELS)


def kernel_name(name=None):
    """The kernel that calls run with kernel=name; None if the name is unknown, or this processor cannot run that kernel."""
    if name is None:
        return kernels()[0]
    return name if isinstance(name, str) and name in KERNELS else None
