"""tribox voxelize tile by tile, --count and --fill, and tribox partition: the cells of the dense grid, in little memory."""

import json
import os
import random
import resource
import signal
import struct
import subprocess
import time
import zipfile
from array import array

import meshes
import support
import volumes

SIZE = (300, 130, 257)  # 3 x 2 x 3 tiles of 128
GRID = ("--cell", "0.0137,0.031,0.0158", "--origin", "-2,-2,-2", "--size", "%d,%d,%d" % SIZE)


def cube(low, high):
    """Twelve triangles that close a box, with corners of small whole numbers."""
    corners = [tuple((high if n >> a & 1 else low)[a] for a in range(3)) for n in range(8)]
    faces = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    return [tuple(corners[n] for n in three) for a, b, c, d in faces for three in ((a, b, c), (a, c, d))]


class Tiles(support.TestCase):
    def setUp(self):
        super().setUp()
        self.mesh = self.write("mesh.f32", meshes.pack_floats(meshes.lattice_triangles(12, seed=9)))

    def path(self, name):
        return os.path.join(self.folder, name)

    def voxelize(self, *arguments):
        return json.loads(self.succeed("voxelize", *arguments, "--json"))

    def dense(self, mesh, grid, *options):
        """The summary and the bits of the whole grid in one piece."""
        found = self.voxelize(mesh, *grid, *options, "-o", self.path("dense.raw"))
        return found, volumes.read(self.path("dense.raw"))

    def parts(self, mesh, grid, *options):
        """The bits that come out of bricks, by way of parts."""
        found = [self.voxelize(mesh, *grid, *options, "--shard", "%d/2" % n, "-o", self.path("t%d.part.npz" % n)) for n in (1, 2)]
        self.succeed("merge", self.path("t1.part.npz"), self.path("t2.part.npz"), "--quiet", "-o", self.path("tiles.raw"))
        return found, volumes.read(self.path("tiles.raw"))


class Answers(Tiles):
    def test_cells_of_the_whole(self):
        few = ("--cell", "0.02,0.5,0.5", "--origin", "-2,-2,-2", "--size", "200,8,8")  # without the box each triangle is everywhere
        for grid, options in ((GRID, ()), (GRID, ("--axes", "box")), (few, ("--axes", "plane,edges")), (GRID, ("--kernel", "scalar"))):
            whole, bits = self.dense(self.mesh, grid, *options)
            for threads in "123":
                found, tiles = self.parts(self.mesh, grid, *options, "--threads", threads)
                self.assertEqual(tiles, bits, (options, threads))
                self.assertEqual(sum(f["occupied"] for f in found), whole["occupied"])

    def test_files_for_any_number_of_threads(self):
        for ending in ("npz", "cells"):
            files = []
            for threads in "123":
                self.voxelize(self.mesh, *GRID, "--threads", threads, "--out-format", ending, "-o", self.path("out"))
                files.append(volumes.read(self.path("out")))
            self.assertEqual(files[0], files[1])
            self.assertEqual(files[0], files[2])

    def test_coordinates(self):
        """Small enough for an answer in rational numbers."""
        triangles = meshes.lattice_triangles(3, seed=3)
        mesh = self.write("few.f32", meshes.pack_floats(triangles))
        grid = ("--cell", "0.5", "--origin", "-2,-2,-2", "--size", "9,7,8")
        found = self.voxelize(mesh, *grid, "--out-format", "cells", "-o", self.path("cells.npy"))
        data = volumes.read(self.path("cells.npy"))
        count = found["occupied"]
        numbers = struct.unpack("<%di" % (3 * count), data[len(data) - 12 * count:])
        cells = set(zip(numbers[::3], numbers[1::3], numbers[2::3]))
        self.assertEqual(cells, volumes.occupied(triangles, found["grid"]))

    def test_count(self):
        whole = self.dense(self.mesh, GRID)[0]
        self.voxelize(self.mesh, *GRID, "-o", self.path("bricks.npz"))
        for threads in "12":
            found = self.voxelize(self.mesh, *GRID, "--count", "--threads", threads)
            self.assertEqual(found["occupied"], whole["occupied"])
            self.assertNotIn("tile", found)
            self.assertNotIn("output", found)
        shards = [self.voxelize(self.mesh, *GRID, "--count", "--shard", "%d/3" % n) for n in (1, 2, 3)]
        for member in ("occupied", "bricks"):
            self.assertEqual(sum(shard[member] for shard in shards), found[member])
        for options, tiles in ((), ""), (("--accuracy", "fast"), ", tiles of 128"):
            self.assertRegex(self.succeed("voxelize", self.mesh, *GRID, "--count", *options),
                             r"(?m)^occupied     \d+ cells \(.*\)\nbricks       \d+ of 8 x 8 x 8 cells%s\n" % tiles)

    def test_either_way(self):
        """All cells at once, or tile by tile: the same bytes, on both sides of the border at 2 MB of bits, whatever the threads."""
        for size, has_tiles in ((GRID[GRID.index("--size") + 1], False), ("1,1,1", False), ("64,512,512", False), ("65,512,512", True),
                                ("129,127,136", False), ("8,9,70", False)):
            grid = [*GRID[:GRID.index("--size") + 1], size]
            self.voxelize(self.mesh, *grid, "--shard", "1/1", "-o", self.path("t.part.npz"))
            self.succeed("merge", self.path("t.part.npz"), "--quiet", "-o", self.path("t.npz"))
            for threads in (1, 2, 3, 7, 64):
                found = self.voxelize(self.mesh, *grid, "--threads", str(threads), "-o", self.path("a.npz"))
                self.assertEqual("tile" in found, has_tiles, size)
                self.assertEqual(volumes.read(self.path("a.npz")), volumes.read(self.path("t.npz")), (size, threads))

    def test_threads_share_triangles_or_layers(self):
        """Enough work for many threads, below 2 MB of bits and above, of floats and of doubles: the bits of one thread."""
        triangles = meshes.lattice_triangles(1000, seed=5)
        several = (self.write("many.f32", meshes.pack_floats(triangles)), self.write("many.obj", meshes.obj(
            [[[x + 1e-9 for x in vertex] for vertex in t] for t in triangles])))
        for mesh in several:
            for size, *options in (("60,70,80",), ("60,70,80", "--accuracy", "fast"), ("320,256,240",), ("64,40,9000",),
                                   ("320,256,240", "--accuracy", "conservative")):
                grid = ("--cell", "0.0179", "--origin=-2,-2,-2", "--size", size, *options)
                found = [(self.voxelize(mesh, *grid, "--threads", threads, "-o", self.path("a.raw"))["occupied"],
                          volumes.read(self.path("a.raw"))) for threads in ("1", "2", "3", "7", "64")]
                for other in found[1:]:
                    self.assertEqual(other[0], found[0][0], (mesh, grid))
                    self.assertEqual(other[1], found[0][1], (mesh, grid))

    def test_threads_list_triangles(self):
        """Enough triangles that threads list them in several runs, in many tiles: floats, doubles and wide ones, all one file."""
        places = [t[0] for t in meshes.lattice_triangles(36000, seed=30)]
        small = [[[x / 64 for x in vertex] for vertex in t] for t in meshes.lattice_triangles(1000, seed=31)]
        triangles = [[[x + y for x, y in zip(vertex, place)] for vertex in small[i % 1000]] for i, place in enumerate(places)]
        triangles[17000:17000] = meshes.lattice_triangles(20, seed=32)
        several = (self.write("runs.f32", meshes.pack_floats(triangles)), self.write("runs.obj", meshes.obj(
            [[[x + 1e-9 for x in vertex] for vertex in t] for t in triangles])))
        grid = ("--cell", "0.00617", "--origin=-2,-2,-2", "--size", "700,650,500")
        for mesh in several:
            for options in ((), ("--accuracy", "conservative"), ("--shard", "2/3")):
                files = []
                for threads in ("1", "2", "3", "7"):
                    self.voxelize(mesh, *grid, *options, "--threads", threads, "-o", self.path("a.npz"))
                    files.append(volumes.read(self.path("a.npz")))
                for other in files[1:]:
                    self.assertEqual(other, files[0], (mesh, options))

    def test_places_of_many_bricks(self):
        """So many that their places wait in memory and in a file, on the way to a file and to a pipe. The mesh covers each brick."""
        side, tile = 600, 16  # bricks
        tiles = [range(first, min(first + tile, side)) for first in range(0, side, tile)]
        expected = array("I", (n for js in tiles for is_ in tiles for j in js for i in is_ for n in (i, j, 0)))
        grid = ("--cell", "1,1,1", "--origin=0,0,0", "--size", "%d,%d,3" % (8 * side, 8 * side))
        low, high = 0.0, 8.0 * side
        mesh = self.write("square.obj", meshes.obj([((low, low, 0.5), (high, low, 0.5), (high, high, 0.5)),
                                                    ((low, low, 0.5), (high, high, 0.5), (low, high, 0.5))]))
        for threads in "12":
            self.voxelize(mesh, *grid, "--threads", threads, "-o", self.path("a.npz"))
            with zipfile.ZipFile(self.path("a.npz")) as file:
                self.assertEqual(file.read("at.npy")[128:], expected.tobytes())
                self.assertEqual(file.read("bits.npy")[128:], (b"\xff" * 8 + bytes(56)) * side ** 2)
            piped = subprocess.run([support.program(), "voxelize", mesh, *grid, "--threads", threads, "--out-format", "npz", "-o",
                                    "-"], capture_output=True, check=True, timeout=60).stdout
            self.assertEqual(piped, volumes.read(self.path("a.npz")))

    def test_picture(self):
        small = ("--picture-size", "80x60")
        if support.run("voxelize", self.mesh, *GRID, "--quiet", "-o", self.path("a.raw"), *small, "--preview", self.path("a.png")).code:
            self.skipTest("built without libpng")
        self.voxelize(self.mesh, *GRID, "-o", self.path("b.npz"), *small, "--preview", self.path("b.png"))
        self.assertEqual(volumes.read(self.path("a.png")), volumes.read(self.path("b.png")))

    def test_nothing_in_the_grid(self):
        grid = ("--cell", "1", "--origin", "100,100,100", "--size", "200,200,200")
        self.assertEqual(self.voxelize(self.mesh, *grid, "--count")["bricks"], 0)
        self.succeed("partition", self.mesh, *grid, "--quiet", "-o", self.path("none"))
        self.assertEqual(self.voxelize(self.path("none"), "--count")["bricks"], 0)
        self.assertEqual(self.parts(self.mesh, grid)[1], bytes(200 * 200 * 4 * 8))
        self.assertEqual(self.parts(self.path("none"), ())[1], bytes(200 * 200 * 4 * 8))

    def test_partition(self):
        """Any output of a partition is that of its mesh."""
        self.succeed("partition", self.mesh, *GRID, "--quiet", "-o", self.path("tiles"))
        self.assertEqual(os.listdir(self.path("tiles")).sort(), ["index", "triangles"].sort())
        for ending, options in (("raw", ()), ("npz", ()), ("npz", ("--accuracy", "conservative")), ("binvox", ("--threads", "1"))):
            grid = GRID
            if ending == "binvox":
                grid = ("--resolution", "140")
                self.succeed("partition", self.mesh, *grid, "--quiet", "-o", self.path("cubes"))
            self.voxelize(self.mesh, *grid, *options, "-o", self.path("a." + ending))
            self.voxelize(self.path("cubes" if ending == "binvox" else "tiles"), *options, "-o", self.path("b." + ending))
            self.assertEqual(volumes.read(self.path("a." + ending)), volumes.read(self.path("b." + ending)), (ending, options))

    def test_shifted_partition(self):
        grid = ("--shift", "1000,-5,0.1", "--resolution", "200")
        self.succeed("partition", self.mesh, *grid, "--quiet", "-o", self.path("tiles"))
        found = self.voxelize(self.path("tiles"), "-o", self.path("a.npz"))
        self.voxelize(self.mesh, *grid, "-o", self.path("b.npz"))
        self.assertEqual(found["shift"], [1000, -5, 0.1])
        self.assertEqual(volumes.read(self.path("a.npz")), volumes.read(self.path("b.npz")))


class Fills(Tiles):
    def test_cube(self):
        """A closed box whose faces lie within cells: all that is between them is inside, by both definitions."""
        mesh = self.write("cube.f32", meshes.pack_floats(cube((1.5, 1.5, 1.5), (9.5, 8.5, 7.5))))
        grid = ("--cell", "1", "--origin", "0,0,0", "--size", "11,10,9")
        surface = volumes.read_raw(self.dense_path(mesh, grid), (11, 10, 9))[1]
        solid = {(i, j, k) for i in range(1, 10) for j in range(1, 9) for k in range(1, 8)}
        for fill in ("outside", "parity"):
            found = self.voxelize(mesh, *grid, "--fill", fill, "-o", self.path("solid.raw"))
            self.assertEqual(volumes.read_raw(self.path("solid.raw"), (11, 10, 9))[1], solid)
            self.assertEqual((found["fill"], found["occupied"], found["inside"]), (fill, len(surface), len(solid) - len(surface)))
            self.assertEqual(found.get("odd_rows"), 0 if fill == "parity" else None)
            counted = self.voxelize(mesh, *grid, "--fill", fill, "--count")
            self.assertEqual((counted["occupied"], counted["inside"]), (found["occupied"], found["inside"]))
            sparse = self.voxelize(mesh, *grid, "--fill", fill, "--out-format", "cells", "-o", self.path("solid.npy"))
            self.assertEqual(sparse["inside"], found["inside"])
            self.assertEqual(os.path.getsize(self.path("solid.npy")) % 64, 12 * len(solid) % 64)

    def dense_path(self, mesh, grid):
        self.dense(mesh, grid)
        return self.path("dense.raw")

    def test_doubles(self):
        triangles = cube((1.1, 1.2, 1.3), (9.7, 8.6, 7.4))
        mesh = self.write("cube.f64", struct.pack("<108d", *(x + 1e9 / 7 for t in triangles for v in t for x in v)))
        found = [self.voxelize(mesh, "--resolution", "20", "--fill", fill, "--count") for fill in ("outside", "parity")]
        self.assertEqual(found[0]["inside"], found[1]["inside"])
        self.assertGreater(found[0]["inside"], 1000)

    def test_open(self):
        """Without the face at the upper end of x; rays leave through it once."""
        mesh = self.write("open.f32", meshes.pack_floats(cube((1.5, 1.5, 1.5), (9.5, 8.5, 7.5))[:-2]))
        grid = ("--cell", "1", "--origin", "0,0,0", "--size", "11,10,9")
        text = self.succeed_with_note(r"warning: .*open.f32 is not closed: (42|35|56|30) rows of cells cross it an odd number of times",
                                      "voxelize", mesh, *grid, "--fill", "parity", "--json", "-o", self.path("a.npz"))
        self.assertGreater(json.loads(text)["odd_rows"], 0)
        self.assertEqual(self.voxelize(mesh, *grid, "--fill", "outside", "--count")["inside"], 0)
        self.assertIn("inside       0 cells (outside; the surface is open by a cell or more, or encloses none)\n",
                      self.succeed("voxelize", mesh, *grid, "--fill", "outside", "--count"))

    def bits_of(self, path, size):
        """Of a file of bricks, as the words of the grid."""
        row = (size[0] + 63) // 64 * 8
        bits = bytearray(row * size[1] * size[2])
        with zipfile.ZipFile(path) as file:
            places, bricks = array("I", file.read("at.npy")[128:]), file.read("bits.npy")[128:]
        for n in range(len(places) // 3):
            i, j, k = places[3 * n:3 * n + 3]
            for m in range(64):
                if bricks[64 * n + m]:
                    bits[((8 * k + m // 8) * size[1] + 8 * j + m % 8) * row + i] = bricks[64 * n + m]
        return bits

    def check_whole(self, mesh, grid, fill):
        """Tile by tile there are the cells of the whole, in one order for any number of threads."""
        whole, dense = self.dense(mesh, grid, "--fill", fill, "--threads", "3")
        self.assertEqual(self.dense(mesh, grid, "--fill", fill, "--threads", "1")[1], dense)
        files = []
        for threads in "13":
            found = self.voxelize(mesh, *grid, "--fill", fill, "--threads", threads, "-o", self.path("solid.npz"))
            for member in ("occupied", "inside", "odd_rows", "undecided"):
                self.assertEqual(found.get(member), whole.get(member), (grid, fill))
            counted = self.voxelize(mesh, *grid, "--fill", fill, "--threads", threads, "--count")
            self.assertEqual([counted[m] for m in ("inside", "bricks")], [found[m] for m in ("inside", "bricks")])
            files.append(volumes.read(self.path("solid.npz")))
        self.assertEqual(files[0], files[1])
        self.assertEqual(self.bits_of(self.path("solid.npz"), found["grid"]["size"]), dense, (grid, fill))
        return whole, dense

    def test_tiles(self):
        """A shell with a box in it: 3 x 2 x 2 tiles, grids that hold it and that cut it, floats and doubles."""
        shell = (cube((-1.7, -0.3, -1.65), (1.7, 1.31, 1.6)) + cube((-1.5, -0.2, -1.5), (1.45, 1.2, 1.5)) +
                 cube((-1.2, 0.1, -1.3), (-0.9, 0.8, 1.3)))
        floats = self.write("shell.f32", meshes.pack_floats(shell))
        doubles = self.write("shell.f64", struct.pack("<%dd" % (9 * len(shell)), *(x + 1 / 3e9 for t in shell for v in t for x in v)))
        holding = ("--cell", "0.016,0.0156,0.027", "--origin", "-2,-0.5,-2", "--size", "259,131,143")
        cutting = ("--cell", "0.016,0.0156,0.027", "--origin", "-1.6,-0.5,-1.55", "--size", "150,131,41")
        for mesh in (floats, doubles):
            for grid in (holding, cutting):
                found = [self.check_whole(mesh, grid, fill)[0] for fill in ("outside", "parity")]
                if grid == holding: # all that is in the shell; of parity not what lies between it and the box
                    self.assertGreater(found[0]["inside"], 1.5 * found[1]["inside"])
                self.assertGreater(found[1]["inside"], 10000)

    def test_partition(self):
        self.succeed("partition", self.mesh, *GRID, "--quiet", "-o", self.path("tiles"))
        whole, dense = self.dense(self.mesh, GRID, "--fill", "outside")
        found = self.voxelize(self.path("tiles"), "--fill", "outside", "-o", self.path("tiles.raw"))
        self.assertEqual(volumes.read(self.path("tiles.raw")), dense)
        self.assertEqual((found["inside"], found["occupied"]), (whole["inside"], whole["occupied"]))

    def test_beyond_memory(self):
        """A box in a grid of 512 GiB, and a grid that lies in a box."""
        mesh = self.write("box.f32", meshes.pack_floats(cube((1.5, 1.5, 1.5), (9.5, 8.5, 7.5))))
        grid = ("--cell", "1", "--origin", "0,0,0", "--size", "16384,16384,16384")
        for fill in ("outside", "parity"):
            found = self.voxelize(mesh, *grid, "--fill", fill, "-o", self.path("x.npy"), "--out-format", "cells")
            self.assertEqual((found["occupied"], found["inside"], found["bricks"]), (294, 210, 4))
        inner = ("--cell", "0.0001", "--origin", "2,2,2", "--size", "65536,64,140")
        found = self.voxelize(mesh, *inner, "--fill", "parity", "--count")
        self.assertEqual((found["occupied"], found["inside"]), (0, 65536 * 64 * 140))
        self.assertEqual(self.voxelize(mesh, *inner, "--fill", "outside", "--count")["inside"], 0)


class Refusals(Tiles):
    def setUp(self):
        super().setUp()
        self.succeed("partition", self.mesh, *GRID, "--quiet", "-o", self.path("tiles"))
        self.there = sorted(os.listdir(self.folder))

    def refuse(self, code, pattern, *arguments, **how):
        self.fail_with(code, pattern, *arguments, **how)
        self.assertEqual(sorted(os.listdir(self.folder)), self.there, arguments)

    def test_command_lines(self):
        tiles = self.path("tiles")
        for pattern, arguments in (
                ("no output given; give -o FILE, or --count", (self.mesh, *GRID)),
                ("--count only prints: leave out --out", (self.mesh, *GRID, "--count", "-o", "x.npz")),
                ("--count only prints: leave out --preview", (self.mesh, *GRID, "--count", "-p", "x.png")),
                ("--count only prints: leave out --quiet", (self.mesh, *GRID, "--count", "-q")),
                ("--fill: 'inside' is none of outside, parity and middles", (self.mesh, *GRID, "--fill", "inside")),
                ("--fill needs all cells at once: leave out --shard",
                 (self.mesh, *GRID, "--fill", "outside", "--shard", "1/2", "-o", "x.part.npz")),
                ("a folder, so a partition, which has its grid: leave out --resolution", (tiles, "-r", "9", "-o", "x.npz")),
                ("a folder, so a partition, which has its grid: leave out --shift", (tiles, "--shift", "auto", "-o", "x.npz")),
                ("a partition, which is for all axes: leave out --axes", (tiles, "--axes", "box", "-o", "x.npz")),
                ("lacks what lies before its grid: --fill parity needs the mesh itself", (tiles, "--fill", "parity", "-o", "x.npz"))):
            self.refuse(2, pattern + ".*see 'tribox voxelize --help'", "voxelize", *arguments)
        for pattern, arguments in (("no mesh file given", ("-r", "9", "-o", "x")), ("no grid given", (self.mesh, "-o", "x")),
                                   ("no output given; give -o FOLDER", (self.mesh, "-r", "9")),
                                   ("-o: '-' is not the name of a folder", (self.mesh, "-r", "9", "-o", "-")),
                                   ("exclude each other", (self.mesh, "-r", "9", "-o", "x", "--json", "-q"))):
            self.refuse(2, pattern + ".*see 'tribox partition --help'", "partition", *arguments)

    def test_places(self):
        self.refuse(1, "tiles: is there already; remove it, or give another name", "partition", self.mesh, "-r", "9", "-o",
                    self.path("tiles"))
        self.refuse(1, "none/x: cannot write there: No such file", "partition", self.mesh, "-r", "9", "-o", self.path("none/x"))
        self.refuse(1, "x: cannot write all of it: File too large; nothing of it was kept", "partition", self.mesh, *GRID, "-o",
                    self.path("x"), limit=(resource.RLIMIT_FSIZE, 1000))
        self.refuse(1, "x.npz: cannot write all of it: File too large", "voxelize", self.path("tiles"), "-o", self.path("x.npz"),
                    limit=(resource.RLIMIT_FSIZE, 1000))

    def test_too_large(self):
        grid = ("--cell", "0.0001", "--origin", "-2,-2,-2", "--size", "16384,16384,16384")
        self.refuse(1, r"16384 x 16384 x 16384 cells takes 512 GiB, a bit per cell; the most is 16.0 GiB: choose fewer cells, or write "
                    r"bricks, -o FILE.npz or .vdb", "voxelize", self.mesh, *grid, "-o", self.path("x.raw"))
        self.refuse(1, "the most is 16.0 GiB: choose fewer cells, or write bricks, -o FILE.npz or .vdb", "voxelize", self.mesh, *grid,
                    "--fill", "outside", "-o", self.path("x.raw"))
        self.refuse(1, "the most is 16.0 GiB: choose fewer cells, or leave out the picture", "voxelize", self.mesh, *grid, "-o",
                    self.path("x.npz"), "-p", self.path("x.png"))

    def test_damaged_partition(self):
        self.refuse(1, "is no partition|no partition: ", "voxelize", self.folder, "--count")
        index, triangles = (volumes.read(self.path("tiles/" + name)) for name in ("index", "triangles"))
        for at in [*range(0, 176, 7), *range(176, len(index), 5)]:
            flipped = bytearray(index)
            flipped[at] ^= 1 << at % 8
            self.write("tiles/index", bytes(flipped))
            self.refuse(1, "damaged: .*; make the partition again|not a partition folder|another byte order", "voxelize", self.path("tiles"),
                        "--count")
        for cut in (0, 100, len(index) - 1):
            self.write("tiles/index", index[:cut])
            self.refuse(1, "tiles: damaged: its index has", "voxelize", self.path("tiles"), "--count")
        self.write("tiles/index", index)
        for at in range(0, len(triangles), len(triangles) // 20):
            flipped = bytearray(triangles)
            flipped[at] ^= 1 << at % 8
            self.write("tiles/triangles", bytes(flipped))
            self.refuse(1, "the checksum of its triangles does not match", "voxelize", self.path("tiles"), "-o", self.path("x.npz"))
        self.write("tiles/triangles", triangles[:-1])
        self.refuse(1, "its triangles are not as many as its index says", "voxelize", self.path("tiles"), "--count")


class Memory(Tiles):
    @support.unless_sanitized
    def test_large_grid(self):
        """4,398,046,511,104 cells, 512 GiB of bits."""
        limit = (resource.RLIMIT_AS, 256 << 20)
        mesh = self.write("one.f32", struct.pack("<9f", 0, 0, 0, 1, 0.002, 0.001, 0.001, 0.003, 1))
        grid = ("--cell", "0.0001", "--origin", "0,0,0", "--size", "16384,16384,16384")
        found = json.loads(self.succeed("voxelize", mesh, *grid, "--count", "--json", "--threads", "2", limit=limit))
        self.assertGreater(found["occupied"], 40_000_000)
        self.succeed("partition", mesh, *grid, "--quiet", "-o", self.path("tiles"), limit=limit)
        counts = [json.loads(self.succeed("voxelize", self.path("tiles"), "--count", "--json", "--threads", "1", "--shard",
                                          "%d/2" % n, limit=limit)) for n in (1, 2)]
        self.assertEqual(sum(count["occupied"] for count in counts), found["occupied"])
        self.assertLess(max(count["occupied"] for count in counts), 0.6 * found["occupied"])


class Killed(Tiles):
    def kill(self, number, moment, *arguments):
        """Whether the run was still there at that moment."""
        process = subprocess.Popen([support.program(), *arguments], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL)
        time.sleep(moment)
        process.send_signal(number)
        stderr = process.communicate()[1].decode()
        self.assertIn(process.returncode, (0, -number))
        if process.returncode:
            if number != signal.SIGKILL and stderr:
                self.assertRegex(stderr, r"\Atribox [a-z]+: interrupted: nothing was written[^\n]*\n\Z")
        return process.returncode != 0

    def test_at_any_moment(self):
        """Nothing stands under the name but the whole; after a signal that can be caught nothing is left beside it either."""
        pick = random.Random(os.environ.get("TRIBOX_SEED", 11))
        work = (("voxelize", self.mesh, *GRID, "--quiet", "-o", self.path("out.npz")),
                ("partition", self.mesh, *GRID, "--quiet", "-o", self.path("out")),
                ("voxelize", self.mesh, *GRID, "--quiet", "--shard", "1/1", "-o", self.path("out.part.npz")))
        for arguments in work:
            start = time.monotonic()
            self.succeed(*arguments)
            taken = time.monotonic() - start
            whole = {name: self.content(name) for name in os.listdir(self.folder)}
            for number in (signal.SIGKILL, signal.SIGTERM, signal.SIGINT):
                for _ in range(4):
                    self.forget()
                    before = set(os.listdir(self.folder))
                    was_there = self.kill(number, pick.uniform(0, 1.1 * taken), *arguments)
                    new = set(os.listdir(self.folder)) - before
                    for name in new - {n for n in new if n.startswith(".tribox-")}:
                        self.assertEqual(self.content(name), whole[name])
                    if number != signal.SIGKILL or not was_there:
                        self.assertFalse([name for name in new if name.startswith(".tribox-")], (number, was_there))

    def forget(self):
        subprocess.run(["rm", "-rf", self.path("out"), self.path("out.npz"), self.path("out.part.npz")], check=True)

    def content(self, name):
        path = self.path(name)
        return {inner: volumes.read(os.path.join(path, inner)) for inner in os.listdir(path)} if os.path.isdir(path) else volumes.read(path)

    def test_what_is_left_to_do(self):
        """A shard that is interrupted says which; merge names the shards that are missing."""
        triangles = meshes.lattice_triangles(400, seed=2)
        mesh = self.write("many.f32", meshes.pack_floats(triangles))
        grid = ("--cell", "0.001", "--origin", "-2,-2,-2", "--size", "4000,4000,4000")
        process = subprocess.Popen([support.program(), "voxelize", mesh, *grid, "--quiet", "--shard", "2/3", "-o", self.path("2.part.npz")],
                                   stderr=subprocess.PIPE)
        deadline = time.monotonic() + 60
        while not any(name.startswith(".tribox-") for name in os.listdir(self.folder)) and time.monotonic() < deadline:
            time.sleep(0.001)
        process.send_signal(signal.SIGTERM)
        stderr = process.communicate()[1].decode()
        self.assertEqual(process.returncode, -signal.SIGTERM)
        self.assert_one_line(stderr, "interrupted: nothing was written; run shard 2 of 3 again, parts that are there stay good")
        self.assertEqual(sorted(os.listdir(self.folder)), ["many.f32", "mesh.f32"])


if __name__ == "__main__":
    support.main()
