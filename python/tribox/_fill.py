"""The inside of a surface."""

import warnings

import numpy as np

from . import _c
from ._arguments import check, meaning
from ._errors import InputError, shown
from ._ffi import ffi
from ._library import lib
from ._masks import pointer_to


class OpenMeshWarning(UserWarning):
    """A mesh is certainly not closed, so its inside is not well defined."""


def fill_outside(held_, grid, words, scratch, solid):
    check(lib.tribox_fill_outside(tuple(grid.size), words, scratch, solid, ffi.NULL))


def fill_parity(held_, grid, words, scratch, solid, is_of_middles=False):
    odd = ffi.new("size_t *")
    check(_c.fill_parity(held_, grid, words, scratch, solid, ffi.NULL, odd))
    if odd[0]:
        warnings.warn(f"the mesh is not closed: {odd[0]} of {grid.size[1] * grid.size[2]} rows of cells cross it an odd number of "
                      'times, and are filled to their end; fill="outside" asks nothing of a mesh but that no hole is larger than a '
                      "cell", OpenMeshWarning, stacklevel=5 if is_of_middles else 4)


def fill_middles(*arguments):
    """Parity of the middles: the words have no surface."""
    fill_parity(*arguments, is_of_middles=True)


FILLS = {"outside": fill_outside, "parity": fill_parity, "middles": fill_middles}


def fill_of(word):
    """The call that a word stands for, or None."""
    call = meaning(word, FILLS)
    if call is None and word is not None:
        raise InputError(f"fill = {shown(word)}; give None or one of {', '.join(map(repr, FILLS))}")
    return call


def filled(call, held_, grid, words):
    """The cells of a surface and those inside."""
    solid, scratch = np.empty_like(words), np.empty(lib.tribox_fill_bytes(tuple(grid.size)), np.uint8)
    call(held_, grid, pointer_to(words), ffi.from_buffer(scratch), pointer_to(solid))
    return solid
