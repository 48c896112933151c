"""examples/colours: cells have the colours of their triangles, of a scene and of a texture; and examples/python."""

import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import tribox

import cases

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../examples/colours")


class Scene(cases.TestCase):
    @unittest.skipUnless("TRIBOX_PROGRAM" in os.environ, "built without the program")
    def test_example(self):
        """As many cells of each material as have its colour."""
        with tempfile.TemporaryDirectory() as folder:
            def run(*words):
                return subprocess.run(words, cwd=folder, check=True, capture_output=True, text=True, timeout=120).stdout

            run(sys.executable, "-B", os.path.join(EXAMPLES, "scene.py"))
            for option, name in (("--ids", "scene.npz"), ("--colours", "colours.npz")):
                run(os.environ["TRIBOX_PROGRAM"], "voxelize", "scene.obj", "--resolution", "160", option, "-o", name)
            printed = [line.split() for line in run(sys.executable, "-B", os.path.join(EXAMPLES, "materials.py")).splitlines()]
            with open(os.path.join(folder, "scene.mtl")) as file:
                names, colours = zip(*((n.split()[1], c.split()[1:]) for n, c in zip(file, file)))
            with np.load(os.path.join(folder, "colours.npz")) as file:
                found, counts = np.unique(file["colours"], axis=0, return_counts=True)
            kd = np.floor(255 * np.array(colours, float) + 0.5)
            expected = {name: int(counts[(found == colour).all(1)][0]) for name, colour in zip(names, kd)}
            self.assertEqual({name: int(cells) for name, cells in printed}, expected)
            self.assertEqual(len(expected), 9)


DRAWN = """
import pathlib, sys
class Stub:
    def __getattr__(self, name):
        return lambda *arguments, **keywords: self
    def __iter__(self):
        return iter((self, [self] * 3))
    def savefig(self, name):
        pathlib.Path(name).write_text("drawn")
sys.modules["matplotlib.pyplot"] = pyplot = Stub()
use = print
"""


class FirstSteps(cases.TestCase):
    """examples/python."""

    @unittest.skipUnless("TRIBOX_PROGRAM" in os.environ, "built without the program")
    def test_example(self):
        """With a matplotlib and without it runs, and what it prints and writes is of its torus."""
        for matplotlib, drawn in ("raise ImportError", False), (DRAWN, True):
            with tempfile.TemporaryDirectory() as folder:
                with open(os.path.join(folder, "matplotlib.py"), "w") as file:
                    file.write(matplotlib)
                environment = {**os.environ, "PYTHONPATH": os.pathsep.join([folder, os.environ.get("PYTHONPATH", "")])}
                script = os.path.join(EXAMPLES, "..", "python", "first_steps.py")
                done = subprocess.run([sys.executable, "-B", "-W", "error", script], cwd=folder, capture_output=True, text=True,
                                      timeout=120, env=environment, check=False)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertRegex(done.stdout, r"(?s)1800 vertices of float32, 3600 faces.*\n\d+ triangles overlap.*'inside': \d+")
                self.assertEqual(os.path.exists(os.path.join(folder, "torus.png")), drawn)
                surface, solid = (tribox.Voxels.load(os.path.join(folder, name)) for name in ("torus.npz", "torus.nrrd"))
                self.assert_same(np.asarray(surface), solid.labels() == 1)


class TextureTests(cases.TestCase):
    """examples/colours/texture.py."""

    def setUp(self):
        spec = importlib.util.spec_from_file_location("texture", os.path.join(EXAMPLES, "texture.py"))
        self.texture = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(self.texture)

    def test_globe(self):
        """A cell has the colour of its own longitude and latitude, but near the edges of stripes."""
        triangles, coordinates = self.texture.globe()
        voxels = tribox.voxelize(triangles, resolution=60, ids=True)
        found = self.texture.colours_of(voxels, triangles, coordinates, self.texture.stripes())
        x, y, z = voxels.points().T
        stripe = np.arctan2(y, x) / (2 * np.pi) % 1 * 12
        height = (np.arcsin(z / np.sqrt(x * x + y * y + z * z)) / np.pi + 0.5 - 0.75) * 64
        is_clear = (abs(stripe - np.round(stripe)) > 0.3) & (abs(height) > 2) & (abs(z) < 0.9)
        light = np.where(stripe.astype(int) % 2, 230, 70)
        expected = np.stack([np.maximum(light, 230 * (height > 0)), light, light], axis=-1)[is_clear]
        self.assertGreater(len(expected), 3000)
        self.assert_same(found[is_clear], expected.astype(np.uint8))

    def test_places(self):
        """Each corner has its own, off the plane too; outside none is negative."""
        triangles = np.array([[(0, 0, 0), (4, 0, 0), (0, 8, 0)]] * 2, float)
        points = np.array([(1, 4, 3), (-4, 4, 0)], float)  # a quarter of b and half of c; on the edge from a to c
        self.assertEqual(self.texture.places_in(triangles, points).tolist(), [[0.25, 0.25, 0.5], [0.75, 0, 0.25]])

    def test_thin(self):
        """Segments and points have a colour too, that of their first corner."""
        triangles = np.array([[(0, 0, 0), (4, 0, 0), (2, 0, 0)], [(1, 2, 3)] * 3], np.float32)
        points = np.array([(3, 1, 0), (1, 2, 3)], float)
        self.assert_same(self.texture.places_in(triangles.astype(float), points), np.array([(1, 0, 0), (1, 0, 0)], float))


if __name__ == "__main__":
    cases.main()
