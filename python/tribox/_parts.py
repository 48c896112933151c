"""Bricks.load: files of bricks, and those of all parts of one whole as one."""

import errno
import glob
import os
from dataclasses import dataclass
from typing import Any, Optional, Tuple

import numpy as np

from ._errors import InputError, shown
from ._grids import Grid
from ._tiles import tile_count

KINDS = dict(at=("<u4", (-1, 3)), bits=("<u8", (-1, 8)), inside=("<u8", (-1, 8)), origin=("<f8", (3,)), cell=("<f8", (3,)),
             size=("<u4", (3,)), shift=("<f8", (3,)), ids=("<u4", (-1,)))
PART_KINDS = dict(shard=("<u4", (2,)), tiles=("<u8", (2,)), whole=("<u8", (7,)))
WHOLE = (("mesh", slice(0, 2)), ("mesh", 3), ("accuracy", 4), ("choice of axes", 5), ("size of tiles", 6))
ORDER = ("order of the triangles, whose numbers the ids are: run the shards with one file of the mesh, and with partitions in one "
         "order")
SHOWN_SHARDS = 20


@dataclass
class Part:
    """A file of bricks but for its bits. shard, tiles, whole: None where it is no part."""

    path: str
    at: Any
    grid: Grid
    shift: Tuple[float, ...]
    has_ids: bool
    shard: Optional[Tuple[int, ...]] = None
    tiles: Optional[Tuple[int, ...]] = None
    whole: Optional[Tuple[int, ...]] = None


def array(path, file, name, kinds):
    kind, shape = kinds[name]
    found = file[name]
    if found.dtype.str != kind or found.ndim != len(shape) or found.shape[1:] != shape[1:] or shape[0] not in (-1, len(found)):
        raise InputError(f"{path}: not a .npz file of bricks: its {name} is {found.dtype} of shape {found.shape}")
    return found.astype(kind[1:], copy=False)  # of this machine's byte order


def read(path, take):
    """What take makes of the arrays of a file."""
    with open(path, "rb") as stream:
        try:
            with np.load(stream, allow_pickle=False) as file:
                return take(file)
        except (InputError, MemoryError):
            raise
        except Exception as error:  # of NumPy, zipfile and zlib, whatever the damage is, a place before the file's beginning too
            if isinstance(error, OSError) and error.errno not in (None, errno.EINVAL):
                raise
            raise InputError(f"{path}: not a .npz file of bricks, or a damaged one: {error}") from error


def part_of(path):
    def take(file):
        at, origin, cell, size, shift = (array(path, file, name, KINDS) for name in ("at", "origin", "cell", "size", "shift"))
        place = [tuple(array(path, file, name, PART_KINDS).tolist()) for name in PART_KINDS] if "shard" in file.files else []
        return Part(path, at, Grid(origin, cell, size), tuple(shift.tolist()), "ids" in file.files, *place)

    part = read(path, take)
    if part.shard and not 1 <= part.shard[0] <= part.shard[1]:
        raise InputError(f"{path}: damaged: shard {part.shard[0]} of {part.shard[1]}")
    return part


def bits_of(part):
    return rows_of(part, read(part.path, lambda file: array(part.path, file, "bits", KINDS)))


def inside_of(part):
    """Which cells are inside; None without labels."""
    return rows_of(part, read(part.path, lambda file: array(part.path, file, "inside", KINDS) if "inside" in file.files else None))


def rows_of(part, rows):
    if rows is not None and len(rows) != len(part.at):
        raise InputError(f"{part.path}: damaged: {len(part.at)} places of {len(rows)} bricks")
    return rows


def ids_of(path, bits):
    """The ids of a file of these bricks; None where it has none."""
    ids = read(path, lambda file: array(path, file, "ids", KINDS) if "ids" in file.files else None)
    if ids is not None and len(ids) != np.count_nonzero(np.unpackbits(bits.view(np.uint8))):
        raise InputError(f"{path}: damaged: {len(ids)} ids of other cells")
    return ids


def check_alike(one, other):
    if not other.shard:
        raise InputError(f"{other.path} is no part of a whole; give the files of all shards, or that file alone")
    pairs = [("grid", one.grid, other.grid), ("shift", one.shift, other.shift),
             ("number of shards", one.shard[1], other.shard[1])]
    pairs += [(name, one.whole[at], other.whole[at]) for name, at in WHOLE]
    pairs += [("ids: some have none", one.has_ids, other.has_ids)]
    pairs += [(ORDER, one.whole[2], other.whole[2])] if one.has_ids else []
    for name, first, second in pairs:
        if first != second:
            raise InputError(f"{one.path} and {other.path} do not fit together: they differ in the {name}")


def check_complete(parts):
    """Of parts by rising shard: each once, and their tiles one after another."""
    shards = parts[0].shard[1]
    for one, other in zip(parts, parts[1:]):
        if one.shard == other.shard:
            raise InputError(f"{one.path} and {other.path} are both shard {one.shard[0]} of {shards}; give each once")
    if len(parts) < shards:
        missing, there = [], {part.shard[0] for part in parts}
        for shard in range(1, shards + 1):
            if shard not in there and len(missing) <= SHOWN_SHARDS:
                missing.append(str(shard))
        more = ", ..." if len(missing) > SHOWN_SHARDS else ""
        raise InputError(f"of {shards} shards {shards - len(parts)} are missing: {', '.join(missing[:SHOWN_SHARDS])}{more}; give "
                         "the files of all")
    ends = [0, *(part.tiles[1] for part in parts)]
    for part, end in zip(parts, ends):
        if part.tiles[0] != end:
            raise InputError(f"{part.path} begins with tile {part.tiles[0]} in place of {end}: it was cut otherwise than the "
                             "others")
    if ends[-1] != tile_count(parts[0].grid.size, parts[0].whole[6]):
        raise InputError(f"{parts[-1].path} ends before the last tile: it was cut otherwise than the others")


def joined(parts):
    """at, bits and ids of all, with room for the bits of one part beside them."""
    at = np.concatenate([part.at for part in parts])
    bits, ids, start = np.empty((len(at), 8), np.uint64), [], 0
    for part in parts:
        own = bits[start:start + len(part.at)]
        own[:] = bits_of(part)
        ids.append(ids_of(part.path, own))
        start += len(part.at)
    return at, bits, np.concatenate(ids) if parts[0].has_ids else None


def paths_of(path):
    """A path alone, or a list."""
    if not isinstance(path, (str, os.PathLike)):
        if isinstance(path, bytes) or not np.iterable(path):
            raise InputError(f"path = {shown(path)}; give the path of a file, a list of paths, or a pattern such as 'big.*.npz'")
        return [os.fspath(one) for one in path]
    path = os.fspath(path)
    return path if os.path.exists(path) or not glob.has_magic(path) else sorted(glob.glob(path))


def load_bricks(path):
    """at, bits, grid, shift, shard, ids and inside."""
    paths = paths_of(path)
    if isinstance(paths, str):
        part = part_of(paths)
        bits = bits_of(part)
        return part.at, bits, part.grid, part.shift, part.shard, ids_of(part.path, bits), inside_of(part)
    if not paths:
        raise InputError(f"path = {shown(path)}; there are no such files")
    parts = [part_of(one) for one in paths]
    if len(parts) == 1 and not parts[0].shard:
        return load_bricks(paths[0])
    for part in parts:
        check_alike(parts[0], part)
    parts.sort(key=lambda part: part.shard)
    check_complete(parts)
    at, bits, ids = joined(parts)
    return at, bits, parts[0].grid, parts[0].shift, None, ids, None
