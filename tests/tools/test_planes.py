"""Every format says where the grid is, or JSON does: each cell of a file is found again from the origin and cell that are stated.

Plane p lies at origin + p * cell, rounded once: cells are found by exact clipping, of meshes of floats whose planes float would move.
"""

import json
import os
import random
import re
import struct
import zipfile

import meshes
import support
import volumes


def far_floats(count, seed):
    """Triangles of floats, three cells long or so, where floats are 1/16 apart."""
    pick = random.Random(seed)
    corner = (1000000.0, -700000.0, 600000.0)
    triangles = []
    for _ in range(count):
        middle = [c + pick.uniform(0, 12) for c in corner]
        triangles.append(tuple(tuple(volumes.float_of(m + pick.uniform(-2, 2)) for m in middle) for _ in range(3)))
    return triangles


def three(text):
    return [float(x) for x in re.split(r"[ ,]+", text.strip())]


def cells_of_bytes(data, size):
    nx, ny, nz = size
    assert len(data) == nx * ny * nz
    return {(n % nx, n // nx % ny, n // nx // ny) for n, value in enumerate(data) if value}


def read_npz(path):
    with zipfile.ZipFile(path) as file:
        def array(name, form):
            data = file.read(name + ".npy")
            data = data[10 + struct.unpack_from("<H", data, 8)[0]:]
            return struct.unpack("<%d%s" % (len(data) // struct.calcsize(form), form), data)
        at, bits, size = array("at", "I"), array("bits", "Q"), array("size", "I")
        cells = {(8 * at[3 * n] + b % 8, 8 * at[3 * n + 1] + b // 8, 8 * at[3 * n + 2] + k)
                 for n in range(len(at) // 3) for k in range(8) for b in range(64) if bits[8 * n + k] >> b & 1}
        return {"origin": list(array("origin", "d")), "cell": list(array("cell", "d")), "size": list(size)}, cells


def read_vti(path):
    data = volumes.read(path)
    start = data.index(b'encoding="raw">') + len(b'encoding="raw">')
    start = data.index(b"_", start) + 1
    text = data[:start].decode()
    size = [int(n) for n in re.search(r'WholeExtent="0 (\d+) 0 (\d+) 0 (\d+)"', text).groups()]
    length, = struct.unpack_from("<Q", data, start)
    grid = {"origin": three(re.search('Origin="([^"]*)"', text)[1]), "cell": three(re.search('Spacing="([^"]*)"', text)[1]), "size": size}
    return grid, cells_of_bytes(data[start + 8:start + 8 + length], size)


def read_nrrd(path):
    """Its origin is the middle of the first cell."""
    head, data = volumes.read(path).split(b"\n\n", 1)
    text = head.decode()
    size = [int(n) for n in re.search(r"(?m)^sizes: (.*)$", text)[1].split()]
    directions = [three(v) for v in re.findall(r"\(([^)]*)\)", re.search(r"(?m)^space directions: (.*)$", text)[1])]
    middle = three(re.search(r"(?m)^space origin: \((.*)\)$", text)[1])
    cell = [directions[a][a] for a in range(3)]
    return {"origin": [m - c / 2 for m, c in zip(middle, cell)], "cell": cell, "size": size}, cells_of_bytes(data, size)


def read_binvox(path):
    """Its cube is as long as the scale."""
    size, cells, translate, scale = volumes.read_binvox(path)
    return {"origin": translate, "cell": [scale / size[0]] * 3, "size": list(size)}, cells


def read_vdb(path):
    about, _, cells = volumes.read_vdb_masks(path)
    return {"origin": list(struct.unpack("<3d", about["origin"][1])), "cell": list(struct.unpack("<3d", about["cell"][1])),
            "size": list(struct.unpack("<3i", about["size"][1]))}, cells


READERS = {".npz": read_npz, ".vti": read_vti, ".nrrd": read_nrrd, ".binvox": read_binvox}

# Cells that are no floats, and a default grid, whose cell is none.
GRIDS = (("--resolution", "13"), ("--cell", "1.1"), ("--cell", "0.7", "--origin", "1000001.3,-699998.7,600001.1", "--size", "11,12,13"))


class Planes(support.TestCase):
    def setUp(self):
        super().setUp()
        self.triangles = far_floats(25, seed=31)
        self.mesh = self.write("mesh.f32", meshes.pack_floats(self.triangles))

    def voxelize(self, name, *options, mesh=None):
        path = os.path.join(self.folder, name)
        return path, json.loads(self.succeed("voxelize", mesh or self.mesh, "-o", path, "--json", *options))

    def check(self, grid, cells, name):
        self.assertEqual(cells, volumes.occupied(self.triangles, grid), name)
        self.assertTrue(cells, name)

    def test_what_files_state(self):
        for options in GRIDS:
            for ending, read in READERS.items():
                path, answer = self.voxelize("cells" + ending, *options)
                grid, cells = read(path)
                self.assertEqual(len(cells), answer["occupied"], ending)
                grid["size"] = answer["grid"]["size"]  # .binvox fills it up to a cube
                self.check(grid, cells, (ending, options))

    def test_what_openvdb_states(self):
        support.skip_without_openvdb(self)
        for options in GRIDS:
            path, _ = self.voxelize("cells.vdb", "--vdb-grid", "mask", *options)
            self.check(*read_vdb(path), (".vdb", options))

    def test_what_json_states(self):
        """Of formats that have no place for it."""
        for options in GRIDS:
            path, answer = self.voxelize("cells.npy", *options)
            self.check(answer["grid"], volumes.read_npy(path)[1], ".npy")
            path, answer = self.voxelize("cells.raw", *options)
            self.check(answer["grid"], volumes.read_raw(path, answer["grid"]["size"])[1], ".raw")
            path, answer = self.voxelize("cells.vox", *options)
            self.check(answer["grid"], volumes.read_vox(path)[1], ".vox")

    def test_floats_and_doubles(self):
        """A mesh of floats has the grid and the cells that the same mesh has as doubles."""
        wide = self.write("mesh.f64", struct.pack("<%dd" % (9 * len(self.triangles)), *(x for t in self.triangles for v in t for x in v)))
        for options in GRIDS + (("--cell", "0.3", "--fill", "outside"),):
            path, narrow = self.voxelize("narrow.raw", *options)
            other, doubles = self.voxelize("wide.raw", *options, mesh=wide)
            self.assertEqual((narrow["positions"], doubles["positions"]), ("float32", "float64"))
            self.assertEqual((narrow["grid"], narrow["occupied"]), (doubles["grid"], doubles["occupied"]))
            self.assertEqual(volumes.read(path), volumes.read(other))


if __name__ == "__main__":
    support.main()
