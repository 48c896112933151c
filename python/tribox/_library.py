"""Loads libtribox: the file that the environment variable TRIBOX_LIBRARY names, or that in a wheel, or the installed library."""

from __future__ import annotations

import os
import sys
from itertools import count, takewhile
from typing import List, Optional

from ._ffi import ffi

NAME = "libtribox.1.dylib" if sys.platform == "darwin" else "libtribox.so.1"
BESIDE = "tribox.dll" if os.name == "nt" else "libtribox.so"


def library_path():
    """Where the library is; a name alone is looked for by the system."""
    beside = os.path.join(os.path.dirname(os.path.abspath(__file__)), BESIDE)
    return os.environ.get("TRIBOX_LIBRARY") or (beside if os.path.exists(beside) else NAME)


def load():
    path = library_path()
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
VERSION = ffi.string(lib.tribox_version()).decode()
KERNELS = list_kernels()


def kernels() -> List[str]:
    """The names of the kernels that this processor runs, widest first. The first is the default."""
    return list(KERNELS)


def kernel_name(name: Optional[str] = None) -> Optional[str]:
    """The kernel that calls run with kernel=name; None if the name is unknown, or this processor cannot run that kernel."""
    if name is None:
        return kernels()[0]
    return name if isinstance(name, str) and name in KERNELS else None
