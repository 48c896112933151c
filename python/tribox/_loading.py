"""Files of cells, as the program tribox and this module write them, read again."""

import errno
import json
import os
import re
import warnings
from importlib import import_module
from importlib.util import find_spec
from math import prod

import numpy as np

from ._errors import Error, InputError, path_of, shown
from ._files import HOLDS, IDS, LABELS, OCCUPIED
from ._grids import Grid
from ._masks import WORD, row_words

KINDS = dict(at=("<u4", (-1, 3)), bits=("<u8", (-1, 8)), inside=("<u8", (-1, 8)), origin=("<f8", (3,)), cell=("<f8", (3,)),
             size=("<u4", (3,)), shift=("<f8", (3,)), ids=("<u4", (-1,)), shard=("<u4", (2,)), colours=("|u1", (-1, 3)))
WANTED = {"inside", "ids", "shard", "colours"}  # if they are there


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


def octets_of(path):
    with open(path, "rb") as file:
        return file.read()


def numbers_in(text):
    return tuple(map(float, re.findall(r"[-+.\w]+", text)))


def is_sound(cells, nx):
    """Whether numbers are those of cells: words, bools, labels or ids."""
    kind = cells.dtype.kind
    if kind == "i":
        return cells.min(initial=-1) >= -1
    if kind == "u" and cells.itemsize == 8:
        return not (nx % 64 and (cells[..., -1] >> np.uint64(nx % 64)).any())
    return cells.view(np.uint8).max(initial=0) <= (1 if kind == "b" else 2)


def dense(octets, dtype, shape):
    """An array of a number for each cell, or of words."""
    cells = np.frombuffer(octets, dtype)
    if cells.size != prod(shape):
        raise ValueError(f"{len(octets)} bytes of cells, and {prod(shape) * cells.itemsize} belong to {shape} of {cells.dtype}")
    return cells.reshape(shape)


def set_cells(places, size):
    """An array of bool. places: (i, j, k) of each cell that is set."""
    if ((places < 0) | (places >= size)).any():
        raise ValueError(f"cells beyond the {' x '.join(map(str, size))} of the grid")
    cells = np.zeros(size[::-1], bool)
    cells[tuple(places.T[::-1])] = True
    if np.count_nonzero(cells) != len(places):
        raise ValueError("a cell that comes twice")
    return cells


def load_npy(path, grid):
    array = np.load(path, allow_pickle=False)
    if array.dtype.kind in "iu" and array.ndim == 2 and array.shape[1] == 3:
        return set_cells(array, grid.size), grid
    if array.shape != grid.size[::-1] or array.dtype.str not in (OCCUPIED.dtype, LABELS.dtype, IDS.dtype):
        raise ValueError(f"{array.dtype} of shape {array.shape}, and all cells have shape {grid.size[::-1]}; of a window, "
                         "tribox.Voxels(cells, grid, window) makes Voxels of an array of bool")
    return array, grid


def load_raw(path, grid):
    """Bits, labels or ids, by what lengths and numbers tell."""
    octets, size, found = octets_of(path), grid.size, []
    for dtype, shape in ("<u8", (*size[:0:-1], row_words(size[0]))), (LABELS.dtype, size[::-1]), (IDS.dtype, size[::-1]):
        if len(octets) == prod(shape) * np.dtype(dtype).itemsize:
            found.append(dense(octets, dtype, shape))
    found = [cells for cells in found if is_sound(cells, size[0])]
    if len(found) != 1:
        raise ValueError(f"{len(octets)} bytes, which are {'bits as well as numbers' if found else 'neither bits nor numbers'} of "
                         f"{grid.sides()}")
    return found[0] if found[0].itemsize < 8 else found[0].astype(WORD, copy=False), grid


def load_nrrd(path, _):
    head, _, cells = octets_of(path).partition(b"\n\n")
    fields = dict(line.split(": ", 1) for line in head.decode("ascii").splitlines() if ": " in line and line[0] != "#")
    cell = numbers_in(fields["space directions"])[::4]
    origin = [middle - side / 2 for middle, side in zip(numbers_in(fields["space origin"]), cell)]
    grid = Grid(origin, cell, map(int, fields["sizes"].split()))
    kinds = IDS, LABELS if LABELS.remark.encode() in head else OCCUPIED
    dtype = {kind.nrrd.partition("\n")[0]: kind.dtype for kind in kinds}[fields["type"]]
    return dense(cells, dtype, grid.size[::-1]), grid


VTI_ENDS = b'<AppendedData encoding="raw">\n   _', b"\n  </AppendedData>\n</VTKFile>\n"


def load_vti(path, _):
    head, _, cells = octets_of(path).partition(VTI_ENDS[0])
    if not cells.endswith(VTI_ENDS[1]):
        raise ValueError("its end is missing")
    about = dict(re.findall(r'(\w+)="([^"]*)"', head.decode("ascii")))
    grid = Grid(numbers_in(about["Origin"]), numbers_in(about["Spacing"]), map(int, about["WholeExtent"].split()[1::2]))
    dtype = {(kind.name, kind.vtk): kind.dtype for kind in (OCCUPIED, LABELS, IDS)}[about["Name"], about["type"]]
    return dense(memoryview(cells)[8:-len(VTI_ENDS[1])], dtype, grid.size[::-1]), grid


def load_binvox(path, wanted):
    """A cube of cells, of which those of a smaller grid may be wanted."""
    head, _, runs = octets_of(path).partition(b"\ndata\n")
    found = re.fullmatch(rb"#binvox 1\ndim (\d+) \1 \1\ntranslate (.+)\nscale (.+)", head)
    side = int(found[1])
    grid = Grid(numbers_in(found[2].decode("ascii")), float(found[3]) / side, (side,) * 3)
    values, counts = np.frombuffer(runs, np.uint8).reshape(-1, 2).T
    if counts.sum(dtype=np.uint64) != side ** 3:
        raise ValueError(f"{counts.sum(dtype=np.uint64)} cells in place of {side ** 3}")
    cells = np.repeat(values != 0, counts).reshape(side, side, side).transpose(1, 2, 0)
    if wanted is None or max(wanted.size) != side:
        return cells, grid
    nx, ny, nz = wanted.size
    if np.count_nonzero(cells) != np.count_nonzero(cells[:nz, :ny, :nx]):
        raise ValueError(f"cells beyond the {wanted.sides()} of the grid")
    return cells[:nz, :ny, :nx], Grid(grid.origin, grid.cell, wanted.size)


def load_vox(path, grid):
    """Its palette tells labels from colours."""
    octets, chunks, at = octets_of(path), {b"SIZE": [], b"XYZI": [], b"RGBA": []}, 20
    while at < len(octets):
        name, length = octets[at:at + 4], int.from_bytes(octets[at + 4:at + 8], "little")
        chunks.setdefault(name, []).append(octets[at + 12:at + 12 + length])
        at += 12 + length
    (size,), (rows,), palettes = (chunks[name] for name in (b"SIZE", b"XYZI", b"RGBA"))
    size, count, places = np.frombuffer(size, "<u4"), int.from_bytes(rows[:4], "little"), np.frombuffer(rows[4:], np.uint8)
    if octets[:4] != b"VOX " or at != len(octets) or len(places) != 4 * count or not places[3::4].all():
        raise ValueError(f"{len(octets)} bytes, and {count} cells")
    if tuple(size.tolist()) != grid.size:
        raise ValueError(f"it has {' x '.join(map(str, size))} cells, and grid {grid.sides()}")
    places = places.reshape(-1, 4)
    places = places[np.lexsort(places.T[:3])]
    cells = set_cells(places[:, :3], grid.size)
    if not palettes:
        return cells, grid
    palette = np.frombuffer(palettes[0], np.uint8).reshape(256, 4)
    if palette[2:].any():
        return cells, grid, palette[places[:, 3] - 1, :3]
    labels = cells.view(np.uint8)
    labels[cells] = places[:, 3]
    return labels, grid


def load_vdb(path, _):
    """By the Python module of OpenVDB, under either of its names."""
    with open(path, "rb"):  # or the reason why not
        pass
    module = next(filter(find_spec, ("openvdb", "pyopenvdb")), None)
    if not module:
        raise Error(f"{path}: a .vdb is read by the Python module of OpenVDB, openvdb or pyopenvdb, which is not here; install "
                    "it, or save the cells as .npz as well")
    try:
        grids = {grid.name: grid for grid in import_module(module).readAll(path)[0]}
    except TypeError as error:
        raise InputError(f"{path}: the Python module of OpenVDB reads no ids and no masks: {error}; save the cells as .npz as "
                         "well") from None
    except OSError as error:
        raise ValueError(error) from None
    about = grids["tribox"].metadata
    grid = Grid(about["origin"], about["cell"], about["size"])
    cells, inside = (numbers_of_vdb(grids.get(name), grid.size, bool) for name in ("tribox", "inside"))
    if "Cd" in grids:
        return cells, grid, bytes_of_light(numbers_of_vdb(grids["Cd"], (*grid.size, 3), np.float32)[cells])
    return cells if inside is None else cells.view(np.uint8) + inside, grid


def numbers_of_vdb(of, shape, dtype):
    """Of all cells, those of x, y, z in the order of k, j, i."""
    if of is None:
        return None
    numbers = np.zeros(shape, dtype)
    of.copyToArray(numbers)
    return np.ascontiguousarray(np.swapaxes(numbers, 0, 2))


def bytes_of_light(light):
    """The colours on screen that are linear light."""
    screen = np.arange(256) / 255
    levels = np.where(screen <= 0.04045, screen / 12.92, ((screen + 0.055) / 1.055) ** 2.4)
    return np.searchsorted((levels[1:] + levels[:-1]) / 2, light).astype(np.uint8)


def load_ply(path, grid):
    head, _, body = octets_of(path).partition(b"end_header\n")
    vertices, faces = map(int, re.findall(rb"element \w+ (\d+)", head))
    rows = np.frombuffer(body, np.uint8, offset=24 * vertices).reshape(faces, 16 if b"red" in head else 13)
    corners = np.frombuffer(body, "<f8", 3 * vertices).reshape(-1, 3)
    return within_faces(planes_at(corners, grid), np.ascontiguousarray(rows[:, 1:13]).view("<i4"), grid)


def load_obj(path, grid):
    head, *rows = map(bytes.split, octets_of(path).splitlines())
    corners, faces = ([row[1:4] for row in rows if row[:1] == [letter]] for letter in (b"v", b"f"))
    if [int(head[-4]), int(head[-2])] != [len(corners), len(faces)]:
        raise ValueError(f"{len(corners)} vertices and {len(faces)} triangles are not all that its first line counts")
    return within_faces(planes_at(np.array(corners, float).reshape(-1, 3), grid), np.array(faces, int).reshape(-1, 3) - 1, grid)


def load_glb(path, grid):
    """Its coordinates count cells, and its node says where these are."""
    octets = octets_of(path)
    end = 20 + int.from_bytes(octets[12:16], "little")
    about, body = json.loads(octets[20:end]), octets[end + 8:]
    if int.from_bytes(octets[8:12], "little") != len(octets):
        raise ValueError(f"{len(octets)} bytes in place of {int.from_bytes(octets[8:12], 'little')}")
    if "nodes" not in about:
        return within_faces(np.empty((0, 3)), np.empty((0, 3), int), grid)
    of_corners, of_faces = about["bufferViews"]
    own = Grid(about["nodes"][0]["translation"], about["nodes"][0]["scale"], grid.size)
    rows = np.frombuffer(body, np.uint8, of_corners["byteLength"]).reshape(-1, of_corners.get("byteStride", 12))[:, :12]
    faces = np.frombuffer(body, "<u4", of_faces["byteLength"] // 4, of_faces["byteOffset"])
    return within_faces(np.ascontiguousarray(rows).view("<f4").astype(float), faces.reshape(-1, 3), own)


def planes_at(corners, grid):
    """The numbers of the planes of the grid on which corners lie, and a half less where they lie before these."""
    numbers = np.empty(corners.shape)
    for a, size in enumerate(grid.size):
        boxes = [grid.box(*(p if b == a else 0 for b in range(3))) for p in range(size)]
        planes = np.array([*(lo[a] for lo, _ in boxes), boxes[-1][1][a]])
        numbers[:, a] = np.searchsorted(planes, corners[:, a])
        numbers[:, a] -= 0.5 * (planes[np.minimum(numbers[:, a].astype(int), size)] != corners[:, a])
    return numbers


def within_faces(corners, faces, grid):
    """The cells whose faces these triangles are, of corners in planes of the grid, which are counted."""
    from ._voxelize import voxelize  # which returns Voxels, which are read here

    counted = Grid((0, 0, 0), 1, grid.size)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of a mesh that is not closed, which the areas show
        cells = np.asarray(voxelize((corners, faces), counted, fill="middles"))
        triangles = corners[faces]
        areas = np.abs(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])) / 2
    are_whole, sides = corners % 1 == 0, np.pad(cells.view(np.int8), 1)
    if (areas.sum(0).tolist() != [np.count_nonzero(np.diff(sides, axis=2 - a)) for a in range(3)]
            or (np.count_nonzero(are_whole, axis=1) < 2).any()  # in the middle of an edge of a cell it is two
            or (np.count_nonzero(areas, axis=1) > 1).any() or areas[~are_whole[faces[:, 0]]].any()):
        raise ValueError("its faces are not those of cells of the grid")
    return cells, grid


# What reads each ending, and what the file does not say.
PLACE, LENGTHS = "origin, cell and size of the grid", "how many cells the grid has"
READERS = {".npy": (load_npy, PLACE), ".nrrd": (load_nrrd, ""), ".vti": (load_vti, ""), ".vdb": (load_vdb, ""),
           ".vox": (load_vox, "origin and cell of the grid"), ".ply": (load_ply, PLACE), ".obj": (load_obj, PLACE),
           ".glb": (load_glb, LENGTHS), ".binvox": (load_binvox, ""), ".raw": (load_raw, PLACE)}


def load_cells(path, grid):
    """Words, bools, labels or ids of all cells, the grid, and where they are held the colours. Not of .npz."""
    ending = os.path.splitext(path)[1].lower()
    if ending not in READERS:
        raise InputError(f"path = {shown(path)}; files are read whose names end in {', '.join(HOLDS)}")
    load, lacks = READERS[ending]
    if lacks and grid is None:
        raise InputError(f"{path}: a {ending} does not say {lacks}; give grid=tribox.Grid(origin, cell, size), the one that it was "
                         "saved with, or save .npz, which does")
    try:
        cells, own, *colors = load(path, grid)
        if not is_sound(cells, own.size[0]):
            raise ValueError(f"a number that no cell has, of {cells.dtype}")
    except (MemoryError, OSError):
        raise
    except Exception as error:  # whatever the damage leads to
        if isinstance(error, Error) and str(error).startswith(path):
            raise
        why = f"it has no {error}" if isinstance(error, KeyError) else error
        raise InputError(f"{path}: not a file of cells as tribox writes them, or a damaged one: {why}; "
                         f"{'give the grid that it was saved with, or ' if lacks else ''}save the cells anew, "
                         "best as .npz") from error
    return cells, check_grid(path, grid, own), colors


def check_grid(path, grid, own):
    """The grid that was given, from which that of the file may differ by the rounding of decimals; without it that of the file."""
    if grid is None:
        return own
    numbers = zip((*grid.origin, *grid.cell), (*own.origin, *own.cell), 2 * own.cell)
    if grid.size == own.size and all(abs(given - found) <= 2 * np.spacing(abs(found) + cell) for given, found, cell in numbers):
        return grid
    raise InputError(f"grid = {shown(grid)}; {path} has {own}; give that")


def load_bricks(path):
    """at, bits, grid, shift, shard, ids, inside and colors."""
    path = path_of(path, "; tribox merge makes one of many parts")
    if os.path.splitext(path)[1].lower() in set(HOLDS) - {".npz"}:
        raise InputError(f"path = {shown(path)}; Bricks are read from .npz; tribox.Voxels.load reads the other formats")
    found = read(path)
    at, bits, ids, inside, shard, colors = map(found.get, ("at", "bits", "ids", "inside", "shard", "colours"))
    for rows in (bits,) if inside is None else (bits, inside):
        if len(rows) != len(at):
            raise InputError(f"{path}: damaged: {len(at)} places of {len(rows)} bricks")
    for what, rows in ("ids", ids), ("colours", colors):
        if rows is not None and len(rows) != np.count_nonzero(np.unpackbits(bits.view(np.uint8))):
            raise InputError(f"{path}: damaged: {len(rows)} {what} of other cells")
    return (at, bits, Grid(*(found[name] for name in ("origin", "cell", "size"))), tuple(found["shift"].tolist()),
            None if shard is None else tuple(shard.tolist()), ids, inside, colors)
