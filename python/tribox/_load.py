"""Bricks.load: a file of bricks."""

import errno
import os

import numpy as np

from ._errors import InputError, shown
from ._grids import Grid

KINDS = dict(at=("<u4", (-1, 3)), bits=("<u8", (-1, 8)), inside=("<u8", (-1, 8)), origin=("<f8", (3,)), cell=("<f8", (3,)),
             size=("<u4", (3,)), shift=("<f8", (3,)), ids=("<u4", (-1,)), shard=("<u4", (2,)))
WANTED = {"inside", "ids", "shard"}  # if they are there


def arrays_of(path, file):
    found = {}
    for name, (kind, shape) in KINDS.items():
        if name in WANTED and name not in file.files:
            continue
        of = file[name]
        if of.dtype.str != kind or of.ndim != len(shape) or of.shape[1:] != shape[1:] or shape[0] not in (-1, len(of)):
            raise InputError(f"{path}: not a .npz file of bricks: its {name} is {of.dtype} of shape {of.shape}")
        found[name] = of.astype(kind[1:], copy=False)  # of this machine's byte order
    return found


def read(path):
    with open(path, "rb") as stream:
        try:
            with np.load(stream, allow_pickle=False) as file:
                return arrays_of(path, file)
        except (InputError, MemoryError):
            raise
        except Exception as error:  # of NumPy, zipfile and zlib, whatever the damage is, a place before the file's beginning too
            if isinstance(error, OSError) and error.errno not in (None, errno.EINVAL):
                raise
            raise InputError(f"{path}: not a .npz file of bricks, or a damaged one: {error}") from error


def load_bricks(path):
    """at, bits, grid, shift, shard, ids and inside."""
    if not isinstance(path, (str, os.PathLike)):
        raise InputError(f"path = {shown(path)}; give the path of a file; tribox merge makes one of many parts")
    path = os.fspath(path)
    found = read(path)
    at, bits, ids, inside, shard = (found.get(name) for name in ("at", "bits", "ids", "inside", "shard"))
    for rows in (bits,) if inside is None else (bits, inside):
        if len(rows) != len(at):
            raise InputError(f"{path}: damaged: {len(at)} places of {len(rows)} bricks")
    if ids is not None and len(ids) != np.count_nonzero(np.unpackbits(bits.view(np.uint8))):
        raise InputError(f"{path}: damaged: {len(ids)} ids of other cells")
    return (at, bits, Grid(*(found[name] for name in ("origin", "cell", "size"))), tuple(found["shift"].tolist()),
            None if shard is None else tuple(shard.tolist()), ids, inside)
