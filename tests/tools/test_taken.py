"""tribox voxelize while the mesh is read: what it prints and writes is what comes of the same triangles, stored first."""

import itertools
import json
import os
import random
import re
import struct

import support
import volumes

# Times, and how many pairs went to a slower stage, which the order of the triangles changes.
CHANGING = re.compile(r"(?m)^(time|undecided) .*\n|, \"(seconds|ns_per_triangle|undecided)\": [^,}]*")
NAN, INFINITE = float("nan"), float("inf")


def ply(vertices, faces, is_stored):
    """A binary file; an edge after the faces is left to the reader that knows every spelling, which stores the triangles."""
    header = ("ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
              "element face %d\nproperty list uchar int vertex_indices\n%send_header\n"
              % (len(vertices), len(faces), "element edge 1\nproperty int a\n" if is_stored else ""))
    data = b"".join(struct.pack("<3f", *v) for v in vertices) + b"".join(struct.pack("<B%dI" % len(f), len(f), *f) for f in faces)
    return header.encode() + data + (bytes(4) if is_stored else b"")


def field(side, seed):
    """Vertices and faces of hills, some of the triangles long and some of no area."""
    rng = random.Random(seed)
    vertices = [(x + rng.random() / 2, y + rng.random() / 2, rng.random() * 3) for y in range(side) for x in range(side)]
    faces = []
    for n in range(side * (side - 1)):
        if n % side + 1 < side:
            faces += [(n, n + 1, n + side), (n + 1, n + side + 1, n + side)]
    for n in range(side):
        faces[n] = tuple(rng.randrange(len(vertices)) for _ in range(3))
    return vertices, faces


class Taken(support.TestCase):
    def setUp(self):
        super().setUp()
        for name in ("taken", "stored"):
            os.mkdir(os.path.join(self.folder, name))

    def run_in(self, name, options, out):
        """The exit code, what is said, what is printed, and the file."""
        folder = os.path.join(self.folder, name)
        path = os.path.join(folder, "out")
        to = ("-o", "out", "--out-format", out) if out else ("--count",)
        result = support.run("voxelize", "mesh.ply", *options, *to, cwd=folder)
        data = None
        if os.path.exists(path):
            data = volumes.read(path)
            os.remove(path)
        return result.code, result.stderr, CHANGING.sub("", result.stdout), data

    def compare(self, mesh, *options, out="npz", threads="1237", code=0):
        vertices, faces = mesh
        for name in ("taken", "stored"):
            with open(os.path.join(self.folder, name, "mesh.ply"), "wb") as file:
                file.write(ply(vertices, faces, name == "stored"))
        for t in threads:
            taken, stored = (self.run_in(name, (*options, "--threads", t), out) for name in ("taken", "stored"))
            self.assertEqual(taken[:3], stored[:3], (options, t))
            self.assertEqual(taken[0], code, taken[1])
            self.assertTrue(taken[3] == stored[3], (options, t))
        return taken[:3]

    def test_formats_and_options(self):
        mesh = field(130, 1)
        for out in ("npz", "npy", "raw", "cells", "nrrd", "binvox", "vox", "obj", None):
            self.compare(mesh, "-r", "150", out=out, threads="13")
            self.compare(mesh, "-r", "40", "--json", out=out, threads="2")
        for options in (("--fill", "outside"), ("--fill", "parity"), ("--axes", "box"), ("--axes", "plane,edges"),
                        ("--shift", "auto"), ("--accuracy", "fast"), ("--accuracy", "conservative"), ("--kernel", "scalar")):
            self.compare(mesh, "-r", "30", "--json", *options, threads="13")
        self.compare(mesh, "-r", "3000", threads="2")

    def test_grids(self):
        mesh = field(20, 2)
        for options in (("-c", "0.3"), ("-c", "0.3,1,0.7", "--origin=-3,-1,0"), ("-c", "2", "--origin", "1,1,1", "--size", "9,9,2"),
                        ("-r", "16", "--origin", "0,5,1"), ("-r", "70", "--size", "20,30,2"), ("-r", "1")):
            self.compare(mesh, *options)
        for options in (("-c", "1", "--origin", "50,0,0"), ("-c", "1e-9"), ("-c", "1e-18"), ("-c", "1", "--origin=-1e20,0,0")):
            self.compare(mesh, *options, code=1, threads="12")
        self.compare(mesh, "-r", "300", out="vox", code=1, threads="12")

    def test_vertices_that_no_face_has(self):
        vertices, faces = field(90, 3)
        for axis, far in itertools.product(range(3), (-1000, 1000, NAN, -INFINITE, 1e-3)):
            extra = tuple(far if a == axis else 1 for a in range(3))
            self.compare((vertices + [extra], faces), "-r", "50", "--json", threads="13")
        self.compare(([(-5e7, 2, 2)] + vertices, [tuple(n + 1 for n in f) for f in faces]), "-c", "0.5", threads="12")

    def test_vertices_that_are_not_finite(self):
        vertices, faces = field(90, 4)
        for number in (NAN, INFINITE, -INFINITE):
            for place in (100, 4000, len(vertices) - 1):
                odd = list(vertices)
                odd[place] = (odd[place][0], number, odd[place][2])
                _, said, printed = self.compare((odd, faces), "-r", "50", "--json", threads="13")
                self.assertIn("NaN or infinite", said)
                self.assertGreater(json.loads(printed)["not_finite"], 0)
        everywhere = [(NAN, NAN, NAN)] * 3
        for grid in (("-r", "5"), ("-c", "1", "--origin", "0,0,0", "--size", "4,4,4")):
            self.compare((everywhere, [(0, 1, 2)]), *grid, code=1)

    def test_zeros(self):
        vertices, faces = field(60, 5)
        for zeros in ((0.0, 0.0), (-0.0, 0.0), (0.0, -0.0), (-0.0, -0.0)):
            for a, places in itertools.product(range(3), ((0, 3000), (3000, 0), (77, 78))):
                odd = [list(v) for v in vertices]
                for place, zero in zip(places, zeros):
                    odd[place][a] = zero
                    odd[place + 1][a] = -0.0 if a == 2 else 4
                self.compare((odd, faces), "-r", "20", "--json", threads="2")

    def test_few_and_extreme(self):
        one = [(0, 0, 0), (1, 0, 0), (0, 1, 1)]
        self.compare((one, [(0, 1, 2)]), "-r", "9")
        self.compare((one, [(2, 2, 2)]), "-c", "1")
        self.compare((one, [(2, 2, 2)]), "-r", "4", code=1)
        self.compare((one, []), "-r", "4", code=1)
        for scale in (1e-45, 1e-39, 1e-20, 1e20, 3e38):
            self.compare(([tuple(scale * x for x in v) for v in one], [(0, 1, 2), (1, 0, 1)]), "-r", "100")

    def test_damaged(self):
        vertices, faces = field(90, 6)
        for place, odd in ((0, (0, 1, 8100)), (-1, (0, 1, 2 ** 32 - 1)), (9000, (1, 2)), (5, (4, 5, 6, 7)), (8000, ())):
            self.compare((vertices, faces[:place] + [odd] + faces[place:]), "-r", "30", code=odd[2:3] in ((8100,), (2 ** 32 - 1,)))


if __name__ == "__main__":
    support.main()
