"""bench/peers: answers are compared as they are, and whatever a peer does ends in a line."""

import json
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import cases
from test_voxels import torus

HERE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "bench", "peers")
sys.path.append(HERE)
import asked  # noqa: E402
import run  # noqa: E402

# An Open3D that never ends a grid, and dies of a crop.
OPEN3D = """import os
__version__ = "0"
class utility:
    Vector3dVector = Vector3iVector = list
class geometry:
    AxisAlignedBoundingBox = lambda lo, hi: None
    class TriangleMesh:
        __init__ = lambda self, vertices, faces: None
        crop = lambda self, box: os.abort()
    class VoxelGrid:
        create_from_triangle_mesh_within_bounds = lambda *bounds: sum(iter(int, 1))
"""


# What there is none of in the answer of a peer; of others they miss none. A level set is near the middles.
NONE = {("VTK", "surface"): ["extra"], ("VTK", "crop"): ["extra"], ("VTK", "middles"): ["missed", "extra"],
        ("OpenVDB", "middles"): []}


class Peers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def run_py(self, *words, modules=()):
        """(exit status, text, {(peer, question): row}), with modules before those that are installed."""
        for name, text in modules:
            self.written(name + ".py", text.encode())
        path = os.path.join(self.folder, "rows.json")
        mesh = self.written("torus.ply", self.ply(*torus(np.random.default_rng(cases.seed()))))
        command = [sys.executable, "-B", run.__file__, "--cells", "16", "--rounds", "1", "--json", path, mesh, *words]
        env = {**os.environ, "PYTHONPATH": os.pathsep.join([self.folder, os.environ.get("PYTHONPATH", "")])}
        done = subprocess.run(command, env=env, stdout=subprocess.PIPE, text=True, check=False)
        with open(path, encoding="utf-8") as file:
            return done.returncode, done.stdout, {(row["peer"].split()[0], row["question"]): row for row in json.load(file)}

    def test_agreement(self):
        code, text, rows = self.run_py("--peers", "vtk,openvdb", "--questions", "surface,middles,boxes,crop")
        self.assertEqual(code, 0, text)
        if not rows:
            self.skipTest(text)
        for (peer, question), row in rows.items():
            self.assertGreater(row["of"], 100)
            self.assertGreater(min(row["ours"] + row["theirs"]), 0)
            for none in NONE.get((peer, question), ["missed"]):
                self.assertEqual(row[none], 0, row)

    def test_ends(self):
        code, text, rows = self.run_py("--peers", "openvdb,open3d,programs", "--limit", "1",
                                       modules=[("pyopenvdb", "raise ImportError('none')"), ("open3d", OPEN3D)])
        self.assertEqual(code, 1, text)
        self.assertIn("openvdb: not here (none): apt install python3-openvdb", text)
        self.assertIn("tests/peers/peers: not here: meson setup", text)
        self.assertEqual(set(rows), {("Open3D", "surface"), ("Open3D", "crop inside")})
        self.assertEqual((rows["Open3D", "surface"]["theirs"], rows["Open3D", "surface"]["is_over"]), ([1, 1], True))
        self.assertRegex(text, r"surface +16 .* > 1,000 +> [\d.,]+ ")
        self.assertEqual(rows["Open3D", "crop inside"]["failed"], "ended by signal 6")

    def test_differences(self):
        cells = np.zeros((3, 4, 5), bool)
        cells[1, 1:3, 2] = True
        other = np.roll(cells, 1, 1)
        self.assertEqual(asked.differences(cells, cells.copy()), {"of": 2, "missed": 0, "extra": 0})
        self.assertEqual(asked.differences(cells, other | cells), {"of": 2, "missed": 0, "extra": 1})
        self.assertEqual(asked.differences(cells, other), {"of": 2, "missed": 1, "extra": 1})
        self.assertRaises(ValueError, asked.differences, cells, cells[:2])
        lists = asked.pairs_of([7, 3, 3], [0, 1, 1, 3])  # of three boxes; the second has none, the last one twice
        self.assertEqual(lists.tolist(), [7, 2 << 32 | 3, 2 << 32 | 3])
        self.assertEqual(asked.differences(lists, asked.pairs_of([3, 7], [0, 0, 1, 2])), {"of": 3, "missed": 3, "extra": 2})
        self.assertEqual(asked.differences(lists, lists[:2]), {"of": 3, "missed": 1, "extra": 0})

    def ply(self, vertices, faces):
        rows = np.zeros(len(faces), asked.FACE)
        rows["corners"], rows["face"] = 3, faces
        head = "\n".join([*asked.HEAD, "end_header\n"]).replace("vertex\n", f"vertex {len(vertices)}\ncomment x\n")
        return head.replace("face\n", f"face {len(faces)}\n").encode() + vertices.tobytes() + rows.tobytes()

    def written(self, name, data):
        path = os.path.join(self.folder, name)
        with open(path, "wb") as file:
            file.write(data)
        return path

    def test_read(self):
        vertices, faces = np.arange(12, dtype=np.float32).reshape(4, 3), [[0, 1, 2], [0, 2, 3]]
        ply = self.ply(vertices, faces)
        found = asked.read(self.written("m.ply", ply))
        np.testing.assert_array_equal(found[0], vertices)
        np.testing.assert_array_equal(found[1], faces)
        for old, new in ((b"little", b"big"), (b"float z", b"float z\nproperty uchar red"), (b"\x03", b"\x04")):
            self.assertRaises(SystemExit, asked.read, self.written("m.ply", ply.replace(old, new)))
        self.assertEqual([len(part) for part in asked.read(run.torus(self.folder))], [24000, 48000])


if __name__ == "__main__":
    cases.main()
