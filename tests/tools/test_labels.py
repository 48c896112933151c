"""tribox voxelize --fill with --labels and --inside-only, and --fill middles: every format, in one piece and tile by tile."""

import io
import itertools
import os
import struct
import subprocess
import zipfile

import meshes
import support
import volumes
from test_tiles import Tiles, cube

SIZE = (140, 131, 19)  # 2 x 2 x 1 tiles, and bricks that the grid cuts
GRID = ("--cell", "0.03,0.0213,0.18", "--origin", "-2,-0.7,-1.7", "--size", "%d,%d,%d" % SIZE)
SHELL = (cube((-1.7, -0.3, -1.45), (1.7, 1.91, 1.4)) + cube((-1.2, -0.1, -1.1), (1.15, 1.5, 1.2)) +
         cube((-0.5, 0.1, -0.7), (0.2, 0.8, 0.8)))
BY_TILES = ("--accuracy", "conservative")  # which small grids in one piece are not; no face here is near a plane of the grid


FROM_DIGITS = bytes.maketrans(b"01", b"\0\1")
OF_BYTE = [bytes(n >> i & 1 for i in range(8)) for n in range(256)]


def bits_of(words, size):
    """The cells of rows of words, as bytes 0 and 1."""
    row = (size[0] + 63) // 64 * 8
    cells = bytearray()
    for n in range(size[1] * size[2]):
        number = int.from_bytes(words[n * row:(n + 1) * row], "little")
        cells += format(number, "0%db" % (8 * row))[:-size[0] - 1:-1].encode().translate(FROM_DIGITS)
    return bytes(cells)


def npy_of(data):
    """The text of the header, and the array."""
    start = 10 + struct.unpack_from("<H", data, 8)[0]
    return data[10:start].decode(), data[start:]


def cells_of_bricks(at, rows, size):
    """The same of bricks, a byte for eight cells."""
    cells = bytearray(size[0] * size[1] * size[2])
    for n in range(len(at) // 12):
        corner = [8 * x for x in struct.unpack_from("<3I", at, 12 * n)]
        wide = min(8, size[0] - corner[0])
        for place in range(64):  # a row of eight cells
            if rows[64 * n + place]:
                first = ((corner[2] + place // 8) * size[1] + corner[1] + place % 8) * size[0] + corner[0]
                cells[first:first + wide] = OF_BYTE[rows[64 * n + place]][:wide]
    return bytes(cells)


class Filled(Tiles):
    def setUp(self):
        super().setUp()
        self.shell = self.write("shell.f32", meshes.pack_floats(SHELL))

    def raw(self, *options):
        self.succeed("voxelize", self.shell, *GRID, *options, "-q", "-o", self.path("x.raw"))
        return volumes.read(self.path("x.raw"))

    def truth(self, fill):
        """A byte for each cell, by the files of the surface and of all."""
        surface, solid = bits_of(self.raw(), SIZE), bits_of(self.raw("--fill", fill), SIZE)
        labels = bytes(0 if not s else 1 if f else 2 for s, f in zip(solid, surface))
        self.assertTrue(labels.count(1) > 1000 and labels.count(2) > 1000)
        return labels

    def ways(self):
        return (), BY_TILES, (*BY_TILES, "--threads", "1")


class Labels(Filled):
    def write_labels(self, ending, fill, *options):
        found = self.voxelize(self.shell, *GRID, "--fill", fill, "--labels", *options, "-o", self.path("l" + ending))
        self.assertEqual((found["fill"], found["cells"]), (fill, "labels"))
        return volumes.read(self.path("l" + ending))

    def test_dense(self):
        for fill in ("outside", "parity"):
            truth = self.truth(fill)
            self.assertEqual(self.write_labels(".raw", fill), truth)
            header, cells = npy_of(self.write_labels(".npy", fill))
            self.assertIn("'descr': '|u1'", header)
            self.assertEqual(cells, truth)
            nrrd = self.write_labels(".nrrd", fill)
            self.assertEqual(nrrd[-len(truth):], truth)
            vti = self.write_labels(".vti", fill)
            self.assertIn(truth, vti)
            self.assertIn(b'Name="label" format="appended" RangeMin="0" RangeMax="2"', vti)

    def test_vox(self):
        """Two colours, which the palette has: white and orange."""
        truth, data = self.truth("outside"), self.write_labels(".vox", "outside")
        self.assertEqual(struct.unpack_from("<4sII", data, 8), (b"MAIN", 0, len(data) - 20))
        count = struct.unpack_from("<I", data, 56)[0]
        labels = bytearray(len(truth))
        for i, j, k, label in struct.iter_unpack("4B", data[60:60 + 4 * count]):
            labels[(k * SIZE[1] + j) * SIZE[0] + i] = label
        self.assertEqual(labels, truth)
        self.assertEqual(struct.unpack_from("<4sII", data, 60 + 4 * count), (b"RGBA", 1024, 0))
        self.assertEqual(len(data), 60 + 4 * count + 12 + 1024)
        self.assertEqual(data[-1024:-1016], bytes((255, 255, 255, 255, 255, 128, 0, 255)))

    def test_bricks(self):
        """bits are of all cells, as without labels, and inside says which are."""
        for fill in ("outside", "parity"):
            truth = self.truth(fill)
            for way in self.ways():
                for packing in ((), ("--deflate",)):
                    data = self.write_labels(".npz", fill, *way, *packing)
                    with zipfile.ZipFile(io.BytesIO(data)) as file:
                        self.assertIsNone(file.testzip())
                        at, bits, inside = (npy_of(file.read(name + ".npy"))[1] for name in ("at", "bits", "inside"))
                        self.assertIn("'<u8'", npy_of(file.read("inside.npy"))[0])
                    self.assertEqual(cells_of_bricks(at, bits, SIZE), bytes(map(bool, truth)), (fill, way))
                    self.assertEqual(cells_of_bricks(at, inside, SIZE), bytes(label == 2 for label in truth), (fill, way))
                self.succeed("voxelize", self.shell, *GRID, "--fill", fill, *way, "-q", "-o", self.path("plain.npz"))
                with zipfile.ZipFile(self.path("plain.npz")) as file:
                    self.assertEqual((npy_of(file.read("at.npy"))[1], npy_of(file.read("bits.npy"))[1]), (at, bits))

    def test_standard_output(self):
        data = self.write_labels(".npz", "outside")
        done = subprocess.run([support.program(), "voxelize", self.shell, *GRID, "--fill", "outside", "--labels", "-o", "-",
                               "--out-format", "npz"], capture_output=True, timeout=60)
        self.assertEqual((done.returncode, done.stderr, done.stdout), (0, b"", data))

    def test_partition(self):
        self.succeed("partition", self.shell, *GRID, "-q", "-o", self.path("tiles"))
        for ending in (".raw", ".npz"):
            whole = self.write_labels(ending, "outside", *BY_TILES)
            self.succeed("voxelize", self.path("tiles"), "--fill", "outside", "--labels", "-q", "-o", self.path("p" + ending))
            self.assertEqual(volumes.read(self.path("p" + ending)), whole)

    def test_openvdb(self):
        support.skip_without_openvdb(self)
        truth = self.truth("outside")
        files = set()
        for way in self.ways():
            self.write_labels(".vdb", "outside", *way)
            files.add(volumes.without_vdb_id(volumes.read(self.path("l.vdb"))))
        self.assertEqual(len(files), 1)
        labels = bytearray(len(truth))
        (found,) = self.foreign("openvdb_labels", self.path("l.vdb"))
        for i, j, k in found["tribox"] + found["inside"]:
            labels[(k * SIZE[1] + j) * SIZE[0] + i] += 1
        self.assertEqual(labels, truth)


class InsideOnly(Filled):
    def test_cells(self):
        for fill in ("outside", "parity"):
            inside = bytes(label == 2 for label in self.truth(fill))
            bricks = set()
            for way in self.ways():
                words = self.raw("--fill", fill, "--inside-only", *way)
                self.assertEqual(bits_of(words, SIZE), inside)
                options = (*GRID, "--fill", fill, "--inside-only", *way)
                found = self.voxelize(self.shell, *options, "--out-format", "cells", "-o", self.path("c.npy"))
                self.assertEqual((found["cells"], found["inside"]), ("inside", sum(inside)))
                count = len(npy_of(volumes.read(self.path("c.npy")))[1]) // 12
                self.assertEqual(count, sum(inside))
                counted = self.voxelize(self.shell, *options, "--count")
                self.assertEqual((counted["inside"], counted["bricks"]), (found["inside"], found["bricks"]))
                bricks.add(found["bricks"])
            self.assertEqual(len(bricks), 1)


class Middles(Filled):
    def test_middles(self):
        """Cells whose middle is in a box, without a surface, by the boxes' own numbers."""
        def within(n, a, origin, cell):
            """The numbers on axis a whose middle is in box n."""
            found = [v[a] for t in SHELL[12 * n:12 * n + 12] for v in t]
            return [i for i in range(SIZE[a]) if min(found) < origin + (i + .5) * cell < max(found)]

        truth = bytearray(SIZE[0] * SIZE[1] * SIZE[2])
        for n in range(3):
            for k, j, i in itertools.product(within(n, 2, -1.7, .18), within(n, 1, -.7, .0213), within(n, 0, -2, .03)):
                truth[(k * SIZE[1] + j) * SIZE[0] + i] ^= 1
        for way in self.ways():
            self.assertEqual(bits_of(self.raw("--fill", "middles", *way), SIZE), truth)
            found = self.voxelize(self.shell, *GRID, "--fill", "middles", *way, "--out-format", "cells", "-o", self.path("c.npy"))
            self.assertEqual((found["inside"], found["odd_rows"], "occupied" in found), (sum(truth), 0, False))
            counted = self.voxelize(self.shell, *GRID, "--fill", "middles", *way, "--count")
            self.assertEqual((counted["inside"], counted["bricks"]), (found["inside"], found["bricks"]))

    def test_parity(self):
        """Parity sets these and the surface, in grids that cut the mesh, of floats and doubles."""
        doubles = self.write("shell.f64", struct.pack("<%dd" % (9 * len(SHELL)), *(x + 1 / 3e9 for t in SHELL for v in t for x in v)))
        for mesh in (self.shell, doubles):
            for grid in (GRID, ("--cell", "0.02", "--origin", "-1,-0.2,-1.2", "--size", "70,67,66")):
                sets = []
                for options in ((), ("--fill", "parity"), ("--fill", "middles"), ("--fill", "middles", *BY_TILES)):
                    self.succeed("voxelize", mesh, *grid, *options, "-q", "-o", self.path("x.raw"))
                    sets.append(int.from_bytes(volumes.read(self.path("x.raw")), "little"))
                self.assertEqual(sets[0] | sets[2], sets[1])
                self.assertEqual(sets[2], sets[3])

    def test_open(self):
        mesh = self.write("open.f32", meshes.pack_floats(cube((1.5, 1.5, 1.5), (9.5, 8.5, 7.5))[:-2]))
        self.succeed_with_note("warning: .*open.f32 is not closed: 42 rows of cells", "voxelize", mesh, "--cell", "1", "--origin",
                               "0,0,0", "--size", "11,10,9", "--fill", "middles", "-q", "-o", self.path("x.raw"))


class Thin(Filled):
    def test_cells(self):
        """Some of the others, as words and as bricks, whatever the threads; and filled they leak nowhere."""
        full, solid = (int.from_bytes(self.raw(*options), "little") for options in ((), ("--fill", "outside")))
        words = self.raw("--thin")
        thin = int.from_bytes(words, "little")
        self.assertEqual(thin & ~full, 0)
        self.assertNotEqual(thin, full)
        for threads in "123":
            self.assertEqual(self.raw("--thin", "--threads", threads), words)
        found = self.voxelize(self.shell, *GRID, "--thin", "--out-format", "cells", "-o", self.path("c.npy"))
        self.assertEqual((found["thin"], found["occupied"]), (True, bin(thin).count("1")))
        counted = self.voxelize(self.shell, *GRID, "--thin", "--count")
        self.assertEqual((counted["occupied"], counted["bricks"]), (found["occupied"], found["bricks"]))
        middles = int.from_bytes(self.raw("--fill", "middles"), "little")
        self.assertEqual(int.from_bytes(self.raw("--thin", "--fill", "parity"), "little"), thin | middles)
        filled = int.from_bytes(self.raw("--thin", "--fill", "outside"), "little")
        self.assertEqual((middles & ~filled, filled & ~solid), (0, 0))

    def test_doubles(self):
        """Floats as doubles have the same cells; with many triangles and few cells threads share the triangles."""
        triangles = meshes.lattice_triangles(3000, seed=4)
        floats = self.write("a.f32", meshes.pack_floats(triangles))
        doubles = self.write("a.f64", struct.pack("<%dd" % (9 * len(triangles)), *(x for t in triangles for v in t for x in v)))
        found = []
        for mesh in (floats, doubles):
            for threads in "13":
                self.succeed("voxelize", mesh, "-r", "40", "--thin", "--threads", threads, "-q", "-o", self.path("x.raw"))
                found.append(volumes.read(self.path("x.raw")))
        self.assertEqual(found[1:], found[:-1])

    def test_refused(self):
        self.succeed("partition", self.shell, *GRID, "--quiet", "-o", self.path("tiles"))
        there, thin = sorted(os.listdir(self.folder)), (self.shell, *GRID, "--thin", "-o", "x.npz")
        for pattern, arguments in (("--thin is exact and of all axes", (*thin, "--accuracy", "fast")),
                                   ("--thin is exact and of all axes", (*thin, "--axes", "box")),
                                   ("--fill middles has no cells of the surface: leave out --thin", (*thin, "--fill", "middles")),
                                   ("--thin needs all cells at once: leave out --shard", (*thin, "--shard", "1/2")),
                                   ("is a partition, which is for tiles: --thin needs the mesh itself",
                                    (self.path("tiles"), "--thin", "-o", "x.npz"))):
            self.fail_with(2, pattern + ".*see 'tribox voxelize --help'", "voxelize", *arguments)
        self.fail_with(1, "choose fewer cells, or leave out --thin", "voxelize", self.shell, "-r", "60000", "--thin", "-o", "x.npz")
        self.assertEqual(sorted(os.listdir(self.folder)), there)


class Refused(Filled):
    def test_command_lines(self):
        self.succeed("partition", self.shell, *GRID, "--quiet", "-o", self.path("tiles"))
        there, fill = sorted(os.listdir(self.folder)), (self.shell, *GRID, "--fill", "outside")
        for pattern, arguments in (
                ("--labels is about a filled mesh: give --fill outside or --fill parity", (self.shell, *GRID, "--labels", "-o", "x.npz")),
                ("--inside-only is about a filled mesh", (self.shell, *GRID, "--inside-only", "-o", "x.npz")),
                ("--labels and --inside-only exclude each other", (*fill, "--labels", "--inside-only", "-o", "x.npz")),
                ("--fill middles has no cells of the surface: leave out --labels, or give --fill parity",
                 (self.shell, *GRID, "--fill", "middles", "--labels", "-o", "x.npz")),
                ("--fill middles has no cells of the surface: leave out --inside-only",
                 (self.shell, *GRID, "--fill", "middles", "--inside-only", "-o", "x.npz")),
                ("--count only prints: leave out --labels", (*fill, "--labels", "--count")),
                ("--labels and --vdb-grid exclude each other", (*fill, "--labels", "--vdb-grid", "mask", "-o", "x.vdb")),
                ("--fill middles needs the mesh itself", (self.path("tiles"), "--fill", "middles", "-o", "x.npz"))):
            self.fail_with(2, pattern + ".*see 'tribox voxelize --help'", "voxelize", *arguments)
        for word, ending in (("binvox", ".binvox"), ("ply", ".ply"), ("obj", ".obj"), ("glb", ".glb"), ("cells", ".npy")):
            self.fail_with(2, "--labels: %s holds no labels; write npz, vdb, npy, vti, nrrd, raw or vox, or give --inside-only" % word,
                           "voxelize", *fill, "--labels", "--out-format", word, "-o", "x" + ending)
        self.assertEqual(sorted(os.listdir(self.folder)), there)


del Tiles  # whose own tests are of another script
if __name__ == "__main__":
    support.main()
