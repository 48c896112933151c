"""The exceptions, and how a status of the library becomes one."""

from __future__ import annotations

import os
from typing import List, Optional

from ._ffi import ffi
from ._library import lib

STATUS = ffi.typeof("tribox_status").elements
SHOWN_MAX = 200  # characters of a value in a message


class Brief(type):
    """Leaves what every class has, and the operators of arrays, out of help()."""

    def __dir__(cls) -> List[str]:
        return [name for name in super().__dir__() if name == "__init__" or not name.startswith("__")]


class Error(Exception, metaclass=Brief):
    """Every error of this module. On an error nothing has been written.

    status: the library's name for it, such as "BAD_BOX"; None if the arguments could not be passed to the library.
    """

    def __init__(self, text: str, status: Optional[str] = None) -> None:
        super().__init__(text)
        self.status = status


class InputError(Error, ValueError):
    """A value that the library cannot use."""


class InputTypeError(Error, TypeError):
    """A type or dtype that the library cannot read, or not without a copy."""


class BadIndexError(Error, IndexError):
    """A face refers to a vertex, or a number to a triangle, that does not exist."""


def shown(value):
    """A value as it looks in a message: short, and whatever it is. (Python refuses to print integers of thousands of digits.)"""
    try:
        text = repr(value)
    except Exception:
        return f"<{type(value).__name__}>"
    text = text.encode("ascii", "backslashreplace").decode()
    return text if len(text) <= SHOWN_MAX else f"{text[:SHOWN_MAX]}..."


def path_of(path, advice=""):
    if not isinstance(path, (str, os.PathLike)):
        raise InputTypeError(f"path = {shown(path)}; give the path of a file{advice}")
    return os.fspath(path)


def named(arguments):
    return ", ".join(f"{name} = {shown(value)}" for name, value in arguments.items())


def error_of(status, **arguments):
    """The exception for a status other than TRIBOX_OK. arguments: those that the status is about."""
    text = ffi.string(lib.tribox_status_text(status)).decode()
    if status == lib.TRIBOX_BAD_ARGUMENT:
        text = "the library cannot take an argument in which this module found nothing wrong; please report the call"
    return InputError(f"{text}: {named(arguments)}" if arguments else text, STATUS[status].replace("TRIBOX_", ""))


def bad_index(mesh, faces):
    """The exception for the first index of a tribox_mesh that refers to no vertex; None if all are right."""
    first = ffi.new("size_t *")
    wrong = lib.tribox_mesh_bad_vertices(mesh, first)
    if not wrong:
        return None
    face, corner = divmod(first[0], 3)
    return BadIndexError(f"faces[{face}, {corner}] is {faces[face, corner]}, but there are {mesh.vertices} vertices; "
                         f"wrong indices in all: {wrong}", "BAD_VERTEX")


def check_indices(held_):
    """Raises what is wrong with the indices of a mesh."""
    error = held_.faces is not None and bad_index(held_.struct, held_.faces)
    if error:
        raise error
