"""Triangles to ask about, and the true answers, in rational numbers; shared by the tests of the Python module."""

import argparse
import os
import re
import sys
import unittest

import numpy as np
import tribox

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tools"))
import meshes  # noqa: E402

LO, HI = (-0.5, -0.75, -1), (0.5, 0.25, 1)


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


def truth(triangles, lo, hi):
    box = (*map(float, lo), *map(float, hi))
    return np.array([meshes.overlaps(triangle, box) for triangle in triangles.tolist()], bool)


def shared_vertices(triangles, dtype):
    """The same triangles as vertices and faces, in an order of their own."""
    vertices, faces = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    return vertices, faces.reshape(-1, 3).astype(dtype)


def forms(triangles):
    """The same triangles in each form that calls take."""
    yield triangles
    yield tribox.Mesh(*shared_vertices(triangles, np.int32))
    yield tribox.Mesh(triangles[..., ::-1].reshape(-1, 3).copy()[:, ::-1], np.arange(3 * len(triangles)).reshape(-1, 3))
    yield tribox.Mesh(np.asfortranarray(triangles.reshape(-1, 3)), np.arange(3 * len(triangles)).reshape(-1, 3))
    yield tribox.Soup.of(triangles)
    yield triangles.astype(float)
    yield tribox.Mesh(*shared_vertices(triangles.astype(float), np.uint16))


def joined(bricks):
    """Of several shares as one."""
    at, bits = (np.concatenate([getattr(part, name) for part in bricks]) for name in ("at", "bits"))
    return tribox.Bricks(at, bits, bricks[0].grid)


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
