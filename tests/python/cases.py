"""What the tests of the Python module share: questions with their answers, and triangles in every form in which they come."""

import argparse
import functools
import json
import os
import re
import subprocess
import sys
import unittest
from types import SimpleNamespace

import numpy as np
import tribox

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tools"))
import triangles as meshes  # noqa: E402

LO, HI = (-0.5, -0.75, -1), (0.5, 0.25, 1)
WINDOW = (5, 1, 2), (60, 7, 2)  # that answers.c asks about
GRIDS = {"floats": ((-2, -1.5, -1), (0.03125, 0.0625, 0.09375), (131, 50, 33)),
         "doubles": ((-2.1, -1.5, -1), (0.03, 0.06, 0.09), (131, 50, 33))}


def seed():
    return int(os.environ.get("TRIBOX_TEST_SEED", "1"))


def lattice(count):
    """On multiples of 1/8, where touching is common."""
    return np.array(meshes.lattice_triangles(count, seed()), np.float32).reshape(count, 3, 3)


def scattered(count):
    """Of all sizes, around the origin."""
    pick = np.random.default_rng(seed())
    sizes = 2.0 ** pick.integers(-20, 20, (count, 1, 1))
    return (pick.uniform(-1, 1, (count, 3, 3)) * sizes + pick.uniform(-1, 1, (count, 1, 3))).astype(np.float32)


def some():
    """Of both kinds, near the grids."""
    return np.concatenate([lattice(40) / 2, scattered(60)])


def truth(triangles, lo, hi):
    """In rational numbers."""
    mask = np.zeros(len(triangles), bool)
    mask[meshes.overlapping(triangles, (*map(float, lo), *map(float, hi)))] = True
    return mask


def shared_vertices(triangles, dtype):
    """The same triangles as vertices and faces, in an order of their own."""
    vertices, faces = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    return vertices, faces.reshape(-1, 3).astype(dtype)


def aligned_badly(array):
    """A copy of an array at an address that is not a multiple of its item's size."""
    store = np.zeros(array.nbytes + 1, np.uint8)
    copy = store[1:].view(array.dtype).reshape(array.shape)
    copy[...] = array
    return copy


def padded(triangles, more=2):
    """Vertices with something else around x, y, z."""
    store = np.full((*triangles.shape[:2], 3 + more), np.nan, triangles.dtype)
    store[:, :, 1:4] = triangles
    return store[:, :, 1:4]


class Vector3d:
    """Open3D's vectors: no array, but NumPy makes one of them."""

    def __init__(self, rows):
        self.rows = rows

    def __array__(self, dtype=None, copy=None):
        return self.rows if dtype is None else self.rows.astype(dtype)

    def __len__(self):
        return len(self.rows)


def of_libraries(vertices, faces):
    """The mesh as trimesh, Open3D, PyVista, meshio and others have it."""
    yield SimpleNamespace(vertices=vertices, faces=faces.astype(np.int64), triangles=faces)
    yield SimpleNamespace(vertices=Vector3d(vertices.astype(float)), triangles=Vector3d(faces))
    yield SimpleNamespace(points=vertices, faces=np.insert(faces.astype(np.int64), 0, 3, 1).ravel(), n_strips=0)
    yield SimpleNamespace(points=vertices, faces=faces)
    yield SimpleNamespace(points=vertices, cells_dict={"triangle": faces, "line": np.array([[0, 1]])})


def forms(triangles):
    """The same triangles, of float32 or float64, in each form that calls take; first as they are."""
    vertices, faces = shared_vertices(triangles, np.int64)
    streams = np.ascontiguousarray(triangles.T)
    yield triangles
    yield np.asfortranarray(triangles)
    yield aligned_badly(triangles)
    yield padded(triangles)
    yield triangles.tolist() if len(triangles) else triangles
    yield triangles.astype(triangles.dtype.newbyteorder())
    yield np.repeat(triangles, 2, 0)[::2]
    yield triangles[:, :, ::-1].copy()[:, :, ::-1]
    yield triangles[::-1].copy()[::-1]
    if triangles.dtype == np.float32:
        yield tribox.Soup(streams)
        yield tribox.Soup([[stream.copy() for stream in axis] for axis in streams])
        yield streams.T
        yield triangles.astype(float)
    for dtype in (np.uint16, np.uint32, np.int32, np.int64):
        yield tribox.Mesh(vertices, faces.astype(dtype))
    yield tribox.Mesh(triangles)
    yield tribox.Mesh(vertices.astype(float), faces)
    yield tribox.Mesh(np.asfortranarray(vertices), aligned_badly(faces.astype(np.int32)))
    yield tribox.Mesh(np.repeat(np.repeat(vertices, 2, 0), 3, 1)[::2, ::3], faces.tolist() if len(faces) else faces)
    yield tribox.Mesh(vertices[::-1], len(vertices) - 1 - faces)
    yield tribox.Mesh(padded(vertices[:, None])[:, 0], faces)
    yield vertices, faces
    yield from of_libraries(vertices, faces)


class Question(SimpleNamespace):
    """triangles, box, oriented, grid, and answers by name."""

    @classmethod
    def read(cls, line):
        """A line of answers.c, its numbers as those that the module returns."""
        said = json.loads(line)
        words = {name: np.array(value, np.uint32) for name, value in said.items() if isinstance(value, list)}
        numbers = {name: words[name].view(float) for name in ("box", "oriented", "grid")}
        triangles = words["positions"].view(float if said["isDouble"] else np.float32).reshape(-1, 3, 3)
        count, answers = len(triangles), {"order": words["order"]}
        for name, shape in (*((name, (count,)) for name in (*(f"axes{n}" for n in range(1, 8)), "inside", "oriented1",
                                                            "oriented7")),
                            *((name, (5, 9, 70)) for name in ("cells", "thin", "outside", "parity")),
                            *((name, (2, 7, 60)) for name in ("windowCells", "windowThin"))):
            if name in words:
                rows = words[name].reshape(*shape[:-1], -1)
                answers[name] = np.unpackbits(rows.view(np.uint8), -1, shape[-1], "little").view(bool)
        for name in {"children", "childrenAt"} & words.keys():
            answers[name] = words[name].view(np.uint8)
        if "window" in words:
            starts = words["windowStarts"].astype(int)
            answers.update(window=words["window"], windowCounts=np.diff(starts)[np.diff(starts) > 0],
                           windowIds=words["window"][starts[:-1][np.diff(starts) > 0]], isOdd=said["parityOdd"] > 0)
        box, oriented, grid = numbers["box"], numbers["oriented"], numbers["grid"]
        return cls(name=said["scene"], triangles=triangles, box=(tuple(box[:3]), tuple(box[3:])),
                   oriented=tribox.OrientedBox(oriented[:3], oriented[3:6], oriented[6:].reshape(3, 3)),
                   grid=(grid[:3], grid[3:6], words["grid"][12:15]), answers=answers)


@functools.lru_cache(None)
def questions():
    """Those of answers.c, on the scenes of the tests in C."""
    command = [os.environ["TRIBOX_ANSWERS"], "--seed", str(seed())]
    lines = subprocess.run(command, stdout=subprocess.PIPE, check=True, text=True).stdout.splitlines()
    return [Question.read(line) for line in lines[1:]]


class TestCase(unittest.TestCase):
    def assert_same(self, answer, expected, message=None):
        self.assertEqual((answer.dtype, answer.shape), (expected.dtype, expected.shape), message)
        if not np.array_equal(answer, expected):  # many times as quick, and that says where
            np.testing.assert_array_equal(answer, expected, message or "")

    def refuse(self, error, status, pattern, call, *arguments, **keywords):
        """The call raises this kind of error, with this status of the library and a message that matches."""
        with self.assertRaisesRegex(error, re.compile(pattern, re.DOTALL)) as raised:
            call(*arguments, **keywords)
        self.assertEqual(raised.exception.status, status)


def main():
    """--seed N asks about others; all else goes to unittest."""
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("--seed", default=str(seed()))
    known, rest = parser.parse_known_args()
    os.environ["TRIBOX_TEST_SEED"] = known.seed
    print(f"seed {known.seed}", file=sys.stderr)
    unittest.main("__main__", argv=[sys.argv[0], *rest])
