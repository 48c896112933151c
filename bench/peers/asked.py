"""What all are asked about a mesh, tribox's way to answer it, and how two answers are compared."""

import collections

import numpy as np
import tribox

BOXES, PART = 1000, 0.01  # how many boxes, and the side of each relative to the longest of the mesh
FACE = np.dtype([("corners", "u1"), ("face", "<u4", 3)])
HEAD = ["ply", "format binary_little_endian 1.0", "element vertex", *("property float " + axis for axis in "xyz"), "element face",
        "property list uchar int vertex_indices"]

Timed = collections.namedtuple("Timed", "cpu wall")  # the answer of a peer that times itself, in seconds


def read(path):
    """(vertices, faces)"""
    with open(path, "rb") as file:
        head, _, rest = file.read().partition(b"end_header\n")
    lines = [line for line in head.decode("latin-1").splitlines() if not line.startswith("comment")]
    if [line.rpartition(" ")[0] if line.startswith("element") else line for line in lines] != HEAD:
        raise SystemExit(f"{path}: give a PLY file with a head of these lines: {', '.join(HEAD)}")
    vertices, faces = (int(line.split()[2]) for line in lines if line.startswith("element "))
    rows = np.frombuffer(rest, FACE, faces, 12 * vertices)
    if (rows["corners"] != 3).any():
        raise SystemExit(f"{path}: has faces that are no triangles")
    return np.frombuffer(rest, "<f4", 3 * vertices).reshape(-1, 3), np.ascontiguousarray(rows["face"])


class Task:
    """A mesh, and with it the grid, the boxes and the box that all are asked about."""

    def __init__(self, vertices, faces, grid=None):
        self.vertices, self.faces, self.grid, self.mesh = vertices, faces, grid, tribox.Mesh(vertices, faces)
        lo, hi = self.vertices.min(0).astype(float), self.vertices.max(0).astype(float)
        self.lo, self.hi = lo + (hi - lo) / 4, hi - (hi - lo) / 4
        picked = np.random.default_rng(1).integers(len(self.faces), size=BOXES)
        middles, half = self.vertices[self.faces[picked]].astype(float).mean(1), PART / 2 * (hi - lo).max()
        self.los, self.his = middles - half, middles + half

    def middle(self):
        """That of the first cell."""
        return np.array(self.grid.origin) + np.array(self.grid.cell) / 2


def indexed(task):
    index = tribox.Index(task.mesh)
    return lambda: index.lists(task.los, task.his)


def pairs_of(numbers, start):
    """Of lists of triangles, one after another: a number for each box and triangle."""
    return np.repeat(np.arange(len(start) - 1, dtype=np.uint64), np.diff(start)) << 32 | np.asarray(numbers).astype(np.uint64)


def triangles_of(vertices, faces):
    """Each triangle as an opaque value."""
    return np.ascontiguousarray(np.asarray(vertices, np.float32)[np.asarray(faces)].reshape(-1, 9)).view("V36").ravel()


def crop(task, **options):
    return lambda: tribox.crop(task.mesh, task.lo, task.hi, **options)


def triangles_of_part(part):
    return triangles_of(part.vertices, part.faces)


# Question: (the call for a task, what is compared of its answer).
QUESTIONS = {
    "surface": (lambda task: lambda: tribox.voxelize(task.mesh, task.grid), np.asarray),
    "middles": (lambda task: lambda: tribox.voxelize(task.mesh, task.grid, fill="middles"), np.asarray),
    "index": (lambda task: lambda: tribox.Index(task.mesh), None),
    "boxes": (indexed, lambda lists: pairs_of(*lists)),
    "crop": (crop, triangles_of_part),
    "crop inside": (lambda task: crop(task, inside=True), triangles_of_part),
}


def differences(ours, theirs):
    """{"of": how many are in ours, "missed": how many of them are not in theirs, "extra": how many only theirs has}"""
    if ours.dtype == bool:
        if ours.shape != theirs.shape:
            raise ValueError(f"cells of shape {theirs.shape} instead of {ours.shape}")
        of, found, shared = (int(np.count_nonzero(cells)) for cells in (ours, theirs, ours & theirs))
    else:
        of, found = len(ours), len(theirs)
        (ours, times), (theirs, their_times) = (np.unique(values, return_counts=True) for values in (ours, theirs))
        _, at, their_at = np.intersect1d(ours, theirs, assume_unique=True, return_indices=True)
        shared = int(np.minimum(times[at], their_times[their_at]).sum())
    return {"of": of, "missed": of - shared, "extra": found - shared}
