"""Loads libtribox: the file that the environment variable TRIBOX_LIBRARY names, or the installed library."""

import os

from ._ffi import ffi

NAME = "libtribox.so.0"


def load():
    path = os.environ.get("TRIBOX_LIBRARY") or NAME
    try:
        library = ffi.dlopen(path)
    except OSError as error:
        raise ImportError(f"{error}; install libtribox, or let TRIBOX_LIBRARY name the file {NAME}") from None
    try:
        for function in dir(library):
            getattr(library, function)
    except ffi.error as error:
        raise ImportError(f"{path} does not fit this module: {error}") from None
    return library


lib = load()


def kernel_named(name):
    """The library's spelling of a kernel, which lives for ever; a null pointer if this processor cannot run it. None: the best."""
    text = ffi.NULL if name is None else ffi.new("char[]", str(name).encode())
    return lib.tribox_kernel_name(ffi.new("tribox_options *", {"kernel": text}))


def kernel_name(name=None):
    """The kernel that calls run with kernel=name; None if this processor cannot run it."""
    text = kernel_named(name)
    return ffi.string(text).decode() if text else None
