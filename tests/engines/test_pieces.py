"""The pieces of a mesh, of every format and however many, are the mesh; files that are not whole are refused: test_pieces.py"""

import os
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import numpy as np
import runs
import tribox
from runs import pieces

HEADER = """ply
format binary_{order}_endian 1.0
element vertex {vertices}
property {kind} x
property uchar red
property {kind} y
property {kind} z
element face {faces}
property list uchar {corner} vertex_indices
property uchar flags
end_header
"""


def ply(mesh, order, kind, corner):
    """A file of vertices and faces that have more than places and corners."""
    points, faces = np.unique(mesh.reshape(-1, 3), axis=0, return_inverse=True)
    sign = "<" if order == "little" else ">"
    size = sign + ("f8" if kind == "double" else "f4")
    vertex = np.zeros(len(points), [("x", size), ("red", "u1"), ("y", size), ("z", size)])
    face = np.zeros(len(mesh), [("sides", "u1"), ("corners", sign + pieces.PLY[corner], 3), ("flags", "u1")])
    vertex["x"], vertex["y"], vertex["z"] = points.T
    face["sides"], face["corners"] = 3, faces.reshape(-1, 3)
    header = HEADER.format(order=order, kind=kind, corner=corner, vertices=len(points), faces=len(mesh))
    return header.encode() + vertex.tobytes() + face.tobytes()


def stl(mesh):
    records = np.zeros(len(mesh), pieces.STL)
    records["corners"] = mesh
    return bytes(80) + np.array(len(mesh), "<u4").tobytes() + records.tobytes()


class Pieces(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder, self.mesh = folder.name, runs.bumpy_sphere(5)
        wide = self.mesh.astype(float) + 1e-9
        self.files = {"a.stl": (stl(self.mesh), self.mesh), "a.f32": (self.mesh.astype("<f4").tobytes(), self.mesh),
                      "a.f64": (wide.astype("<f8").tobytes(), wide)}
        for order in "little", "big":
            for corner in "int", "ushort":
                self.files[f"{order}.{corner}.ply"] = ply(self.mesh, order, "float", corner), self.mesh
                self.files[f"{order}.{corner}.wide.ply"] = ply(wide, order, "double", corner), wide

    def path(self, name, octets=None):
        path = os.path.join(self.folder, name)
        if octets is not None:
            with open(path, "wb") as file:
                file.write(octets)
        return path

    def test_read(self):
        for name, (octets, mesh) in self.files.items():
            path = self.path(name, octets)
            for count in 1, 3, len(mesh), len(mesh) + 7:
                parts = [pieces.read(path, n, count) for n in range(1, count + 1)]
                self.assertTrue(np.array_equal(np.concatenate(parts), mesh), (name, count))
                self.assertEqual({part.dtype for part in parts}, {mesh.dtype}, name)
                self.assertLessEqual(np.ptp(list(map(len, parts))), 1, (name, count))

    def test_grid(self):
        """Of the pieces, it is that of the mesh; triangles that are not finite do not count."""
        mesh = np.concatenate([self.mesh, self.mesh[:1] + 5, self.mesh[:3] + 50])
        mesh[-3:, 1, 1] = np.nan, np.inf, -np.inf
        for each in mesh, mesh.astype(float) / 3:
            boxes = [pieces.bounds(part) for part in (each[:0], each[-2:], *np.array_split(each, 7))]
            self.assertEqual(pieces.grid(boxes, 77), tribox.grid_around(each, 77))

    def test_cut(self):
        """The program's partitions of all pieces have the cells of the mesh."""
        path, command = self.path("a.stl", stl(self.mesh - 9)), [sys.executable, "-B", pieces.__file__]
        for n in "123":
            subprocess.run([*command, "cut", path, f"{n}/3", self.folder], check=True)
        boxes = [self.path(f"{n}.bounds") for n in "123"]
        options = subprocess.run([*command, "grid", "90", *boxes], check=True, stdout=subprocess.PIPE, text=True).stdout.split()
        program = os.environ["TRIBOX_PROGRAM"]
        for n in "123":
            subprocess.run([program, "partition", self.path(f"{n}.f32"), *options, "-q", "-o", self.path(n)], check=True)
        subprocess.run([program, "voxelize", *map(self.path, "123"), "-q", "-o", self.path("all.npz")], check=True)
        found, expected = np.load(self.path("all.npz")), tribox.bricks(self.mesh - 9, resolution=90)
        self.assertTrue(runs.same_bricks(tribox.Bricks(found["at"], found["bits"], expected.grid), expected))

    def test_refused(self):
        good = {name: octets for name, (octets, _) in self.files.items()}
        some = good["little.int.ply"]
        start = some.index(b"end_header\n") + len(b"end_header\n")
        quad, far = bytearray(some), bytearray(some)
        quad[-14] = 4
        far[-13:-9] = b"\xff\xff\xff\xff"
        for name, octets, why in (
                ("a.stl", good["a.stl"][:-1], "whole triangles"), ("a.stl", b"solid a\n" * 20, "whole triangles"),
                ("a.f32", good["a.f32"] + b"1234", "whole triangles"), ("a.obj", b"", "neither a binary"),
                ("a.ply", some[:-20], "ends before its last triangle"), ("a.ply", bytes(quad), "not every face is a triangle"),
                ("a.ply", bytes(far), "not every face is a triangle"), ("a.ply", some[:start - 4], "not a binary PLY"),
                ("a.ply", some.replace(b"binary_little_endian", b"ascii"), "not a binary PLY"),
                ("a.ply", some.replace(b"element vertex", b"element edge"), "do not come first")):
            with self.assertRaisesRegex(SystemExit, f"{name}: .*{why}.*; `tribox partition` reads it"):
                pieces.read(self.path(name, octets), 1, 1)

    def test_taken_up(self):
        """The folder of a run is taken by the same command about the same file alone."""
        path, jobs = self.path("a.f32", self.files["a.f32"][0]), self.path("jobs")
        pieces.take_up(jobs, path, 64, 3)
        pieces.take_up(jobs, path, 64, 3)
        self.assertEqual(os.listdir(jobs), ["command"])
        for octets, resolution in (None, 65), (bytes(36), 64):
            with self.assertRaisesRegex(SystemExit, "jobs is of another command, .*a.f32 .* 64 3: repeat that one, remove"):
                pieces.take_up(jobs, self.path("a.f32", octets), resolution, 3)

    def test_sorted_twice(self):
        """Whoever sorts a piece that another has sorted meanwhile takes it as it is."""
        grid, folder = tribox.grid_around(self.mesh, 64), self.path("1.tiles")
        first = pieces.sort(self.mesh, folder, grid)
        for makes in FileExistsError, OSError:  # before the triangles are sorted, and when the folder gets its name
            with unittest.mock.patch("os.path.exists", side_effect=[False, True]), \
                    unittest.mock.patch("tribox.partition", side_effect=makes):
                self.assertTrue(np.array_equal(pieces.sort(self.mesh, folder, grid).numbers, first.numbers))
        with unittest.mock.patch("tribox.partition", side_effect=OSError), self.assertRaises(OSError):
            pieces.sort(self.mesh, self.path("2.tiles"), grid)
        self.assertEqual([name for name in os.listdir(self.folder)], ["1.tiles"])


if __name__ == "__main__":
    unittest.main()
