"""The exceptions, and how a status of the library becomes one."""

from ._ffi import ffi
from ._library import kernel_named, lib

STATUS = ffi.typeof("tribox_status").elements
KERNELS = ("scalar", "sse2", "avx2", "avx512", "neon")


class Error(Exception):
    """Every error of this module. On an error nothing has been written.

    status: the library's name for it, such as "BAD_BOX"; None where the arguments could not be handed to the library.
    """

    def __init__(self, text, status=None):
        super().__init__(text)
        self.status = status


class InputError(Error, ValueError):
    """A value that cannot be served."""


class InputTypeError(Error, TypeError):
    """A type or dtype that cannot be served, or not without a copy."""


class BadIndexError(Error, IndexError):
    """A face refers to a vertex that is not there."""


def error_of(status, **arguments):
    """The exception for a status other than TRIBOX_OK. arguments: those that the status is about."""
    text = ffi.string(lib.tribox_status_text(status)).decode()
    details = ", ".join(f"{name} = {value}" for name, value in arguments.items())
    return InputError(f"{text}: {details}", STATUS[status].replace("TRIBOX_", ""))


def no_kernel(name):
    runnable = ", ".join(kernel for kernel in KERNELS if kernel_named(kernel))
    return error_of(lib.TRIBOX_NO_KERNEL, kernel=f"{name!r}; this processor runs {runnable}")


def bad_index(mesh, faces):
    """The exception for the first index of a tribox_mesh that refers to no vertex; None if all do."""
    first = ffi.new("size_t *")
    wrong = lib.tribox_mesh_bad_indices(mesh, first)
    if not wrong:
        return None
    face, corner = divmod(first[0], 3)
    return BadIndexError(f"faces[{face}, {corner}] is {faces[face, corner]}, but there are {mesh.vertices} vertices; "
                         f"{wrong} of the indices are wrong", "BAD_INDEX")
