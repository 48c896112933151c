"""tribox partition in pieces: little memory, several meshes as one, any number of threads, and partitions that are joined."""

import itertools
import json
import os
import random
import resource
import signal
import struct
import subprocess
import time

import meshes
import support
import volumes

SIZE = (300, 130, 257)  # 3 x 2 x 3 tiles of 128
GRID = ("--cell", "0.0137,0.031,0.0158", "--origin", "-2,-2,-2", "--size", "%d,%d,%d" % SIZE)
NEVER = float("nan")


def stl(triangles):
    records = b"".join(struct.pack("<12fH", 0, 0, 0, *itertools.chain(*u), 7) for u in triangles)
    return bytes(80) + struct.pack("<I", len(triangles)) + records


def f32(triangles):
    return b"".join(struct.pack("<9f", *itertools.chain(*u)) for u in triangles)


def f64(triangles):
    return b"".join(struct.pack("<9d", *itertools.chain(*u)) for u in triangles)


def off(triangles):
    lines = ["OFF", "%d %d 0" % (3 * len(triangles), len(triangles))]
    lines += ["%r %r %r" % tuple(vertex) for u in triangles for vertex in u]
    lines += ["3 %d %d %d" % (n, n + 1, n + 2) for n in range(0, 3 * len(triangles), 3)]
    return "\n".join(lines) + "\n"


class Pieces(support.TestCase):
    def setUp(self):
        super().setUp()
        self.pick = random.Random(os.environ.get("TRIBOX_SEED", 12))
        self.number = 0
        self.triangles = [self.triangle() for _ in range(2000)]
        self.mesh = self.write("all.f32", f32(self.triangles))

    def triangle(self):
        """Small ones, large ones, some outside the grid and a few that are not finite; corners are floats of few digits."""
        reach = self.pick.choice((0.05, 0.05, 0.05, 0.3, 3))
        center = [self.pick.uniform(-2.5, 2.5) for _ in range(3)]
        corners = [[round(64 * (c + self.pick.uniform(-reach, reach))) / 64 for c in center] for _ in range(3)]
        if self.pick.random() < 0.01:
            corners[1][2] = self.pick.choice((NEVER, float("inf")))
        return corners

    def path(self, name):
        return os.path.join(self.folder, name)

    def partition(self, *arguments):
        """The bytes of both files, and the summary."""
        self.number += 1
        folder = self.path("tiles%d" % self.number)
        result = support.run("partition", *arguments, "--json", "-o", folder)
        self.assertEqual(result.code, 0, result.stderr)
        self.assertEqual(sorted(os.listdir(folder)), ["index", "triangles"])
        return [volumes.read(os.path.join(folder, name)) for name in ("index", "triangles")], json.loads(result.stdout), folder

    def refuse(self, code, pattern, *arguments, **how):
        result = support.run(*arguments, **how)
        self.assertEqual(result.code, code, result.stderr)
        self.assertRegex(result.stderr, r"\A(tribox [a-z]+: warning[^\n]*\n)?tribox [a-z]+: [^\n]*(" + pattern + r")[^\n]*\n\Z")
        self.assertFalse([name for name in os.listdir(self.folder) if name.startswith(".")])


class Folders(Pieces):
    def test_tiles_of_the_lists(self):
        """Each tile has its triangles in the order of the mesh, those that touch its box among them, and records add up."""
        (index, triangles), found, _ = self.partition(self.mesh, *GRID, "-m", "9000")
        self.assertEqual(found["not_finite"], sum(any(c != c or abs(c) > 9 for v in u for c in v) for u in self.triangles))
        of = {struct.pack("<9f", *itertools.chain(*u)): n for n, u in enumerate(self.triangles)}
        records = [struct.unpack_from("<4Q", index, at) for at in range(176, len(index), 32)]
        places = [record[1] for record in records] + [len(triangles) // 36]
        self.assertEqual(places[-1], found["sorted"])
        for (tile, first, _, _), end in zip(records, places[1:]):
            numbers = [of[triangles[36 * p:36 * p + 36]] for p in range(first, end)]
            self.assertEqual(numbers, sorted(set(numbers)), tile)
            at = (tile % 3, tile // 3 % 2, tile // 6)
            low = [-2 + 128 * at[a] * (0.0137, 0.031, 0.0158)[a] for a in range(3)]
            high = [-2 + min(128 * at[a] + 128, SIZE[a]) * (0.0137, 0.031, 0.0158)[a] for a in range(3)]
            for n, u in enumerate(self.triangles):
                corner_in = any(all(low[a] + 1e-6 < v[a] < high[a] - 1e-6 for a in range(3)) for v in u)
                if corner_in and all(abs(c) < 9 for v in u for c in v):
                    self.assertIn(n, numbers)

    def test_any_memory_and_threads(self):
        whole, found, _ = self.partition(self.mesh, *GRID)
        self.assertEqual(found["spilled_bytes"], 0)
        for memory, threads in itertools.product(("1", "3000", "40K", "300K", "1G"), "127"):
            files, found, _ = self.partition(self.mesh, *GRID, "-m", memory, "-t", threads)
            self.assertEqual(files, whole, (memory, threads))
            self.assertEqual(found["spilled_bytes"] > 0, memory not in ("300K", "1G"), memory)

    def test_a_crowded_tile(self):
        """A tile of more triangles than fit into the memory."""
        mesh = self.write("one.f32", f32([[[n / 1024, 0, 0], [0, 1 / 8, 0], [0, 0, 1 / 8]] for n in range(1001)]))
        whole, _, _ = self.partition(mesh, "-r", "64")
        for threads in "12":
            self.assertEqual(self.partition(mesh, "-r", "64", "-m", "1000", "-t", threads)[0], whole)

    def test_several_meshes(self):
        whole, _, _ = self.partition(self.mesh, "-r", "400")
        cuts = (0, 1, 700, 701, 1500, 2000)
        for writers in ((f32, stl, f32, f32, stl), (stl, off, f32, stl, f32)):
            paths = []
            for n, (write, first, end) in enumerate(zip(writers, cuts, cuts[1:])):
                some = self.triangles[first:end]
                if write is off and any(c != c or abs(c) > 9 for u in some for v in u for c in v):
                    write = stl
                paths.append(self.write("p%d.%s" % (n, write.__name__), write(some)))
            for memory, threads in (("2G", "2"), ("20K", "3")):
                self.assertEqual(self.partition(*paths, "-r", "400", "-m", memory, "-t", threads)[0], whole)

    def test_doubles_among_them(self):
        wide = self.write("wide.f64", f64(self.triangles))
        whole, found, _ = self.partition(wide, *GRID)
        self.assertEqual(found["positions"], "float64")
        first, second = self.write("a.stl", stl(self.triangles[:900])), self.write("b.f64", f64(self.triangles[900:]))
        for memory in ("1G", "10K"):
            self.assertEqual(self.partition(first, second, *GRID, "-m", memory)[0], whole)

    def test_shift(self):
        far = [[[c + offset for c, offset in zip(v, (5000, 70, -12))] for v in u] for u in self.triangles]
        for shift in ("auto", "5000,70,-12", "0.1,0.2,0.3"):
            options = ("-r", "300", "--shift", shift)
            whole, found, _ = self.partition(self.write("far.f64", f64(far)), *options)
            self.assertEqual(found["positions"], "float64" if "0.1" in shift else "float32")
            pieces = [self.write("far%d.f64" % n, f64(far[n * 500:n * 500 + 500])) for n in range(4)]
            self.assertEqual(self.partition(*pieces, *options, "-m", "20K")[0], whole)
            found = json.loads(self.succeed("voxelize", self.path("far.f64"), *options, "--count", "--json")
                               if not found["not_finite"] else support.run("voxelize", self.path("far.f64"), *options, "--count",
                                                                           "--json").stdout)
            tiles = json.loads(self.succeed("voxelize", self.path("tiles%d" % self.number), "--count", "--json"))
            self.assertEqual((found["occupied"], found["bricks"], found["grid"]), (tiles["occupied"], tiles["bricks"], tiles["grid"]))


class Ply(Pieces):
    """Faces that refer to vertices anywhere; one element more, of nothing, has the file read as a whole."""

    def ply(self, order, number, index, count, faces, more=""):
        name = {"f": "float", "d": "double", "B": "uchar", "H": "ushort", "i": "int", "I": "uint"}
        vertices = [[round(64 * self.pick.uniform(-2, 2)) / 64 + (1 / 3 if number == "d" else 0) for _ in range(3)] for _ in range(250)]
        header = ["ply", "format binary_%s_endian 1.0" % {"<": "little", ">": "big"}[order], "element vertex 250"]
        header += ["property %s %s" % (name[number], axis) for axis in "zxy"] + ["property uchar red", "element face %d" % len(faces)]
        header += ["property ushort flags", "property list %s %s vertex_indices" % (name[count], name[index]), "property float area"]
        body = b"".join(struct.pack(order + "3" + number + "B", *vertex, 77) for vertex in vertices)
        body += b"".join(struct.pack("%sH%s%d%sf" % (order, count, len(f), index), 5, len(f), *f, 0.5) for f in faces)
        return ("\n".join(header) + "\n" + more + "end_header\n").encode() + body

    def check(self, *how):
        state = self.pick.getstate()
        mapped = self.write("mapped.ply", self.ply(*how))
        self.pick.setstate(state)
        whole = self.write("whole.ply", self.ply(*how, "element nothing 0\nproperty int nothing\n"))
        for options in (GRID, ("-r", "300"), ("-r", "300", "--shift", "0.5,0.25,1"))[:3 if how[1:3] == ("f", "i") else 1]:
            expected = self.partition(whole, *options)[0]
            for memory, threads in (("1", "3"), ("30K", "2"), ("1G", "1")):
                self.assertEqual(self.partition(mapped, *options, "-m", memory, "-t", threads)[0], expected, how[:4])

    def test_every_layout(self):
        faces = [[self.pick.randrange(250) for _ in range(self.pick.choice((0, 1, 2, 3, 3, 3, 3, 3, 4, 5, 9)))] for _ in range(9000)]
        for order, number, index, count in itertools.product("<>", "fd", "BHiI", "Bi"):
            self.check(order, number, index, count, faces if (number, index, count) == ("f", "i", "B") else faces[:700])

    def test_polygons(self):
        """Many corners, of which blocks cut some in the middle."""
        self.check("<", "f", "i", "i", [[self.pick.randrange(250) for _ in range(n)] for n in (3, 300, 3, 1000, 4, 90)])

    def test_refused(self):
        """What is wrong is said as of any PLY file."""
        good = self.ply("<", "f", "i", "B", [[0, 1, 2]] * 50)
        for content, why in ((good[:-1], "truncated: the header promises 50"), (good[:300], "truncated"), (good[:80], "truncated"),
                             (self.ply("<", "f", "i", "B", [[0, 1, 2]] * 9 + [[0, 250, 1]]), "face 9 refers to vertex 250"),
                             (self.ply("<", "f", "i", "B", [[0, 1, 2], [0, -1, 1]]), "face 1 refers to vertex -1"),
                             (self.ply("<", "f", "i", "B", [[0, 1]]), "contains no triangles")):
            self.refuse(1, "bad.ply: .*" + why, "partition", self.write("bad.ply", content), *GRID, "-o", self.path("x"))


class Joined(Pieces):
    def setUp(self):
        super().setUp()
        self.pieces = [self.write("a.f32", f32(self.triangles[:300])), self.write("b.stl", stl(self.triangles[300:1600])),
                       self.write("c.f32", f32(self.triangles[1600:]))]

    def test_folders(self):
        """Pieces that were sorted apart become the folder of all, byte for byte."""
        whole, _, _ = self.partition(self.mesh, *GRID)
        apart = [self.partition(piece, *GRID)[2] for piece in self.pieces]
        for memory, threads in (("1G", "2"), ("5000", "1"), ("5000", "3")):
            files, found, _ = self.partition(*apart, "-m", memory, "-t", threads)
            self.assertEqual(files, whole)
            self.assertEqual((found["inputs"], found["triangles"]), (3, 2000))
        self.assertEqual(self.partition(self.partition(*apart[:2])[2], apart[2])[0], whole)

    def test_shards(self):
        """Shards of several partitions are those of the whole mesh."""
        whole = self.partition(self.mesh, *GRID)[2]
        apart = [self.partition(piece, *GRID)[2] for piece in self.pieces]
        for shard in ("1/1", "1/3", "2/3", "3/3"):
            for name, folders in (("whole.part.npz", [whole]), ("apart.part.npz", apart)):
                self.succeed("voxelize", *folders, "--shard", shard, "--quiet", "-o", self.path(name))
            self.assertEqual(volumes.read(self.path("whole.part.npz")), volumes.read(self.path("apart.part.npz")))

    def test_doubles(self):
        wide = self.write("b.f64", f64(self.triangles[300:1600]))
        apart = [self.partition(piece, *GRID)[2] for piece in (self.pieces[0], wide, self.pieces[2])]
        self.assertEqual(self.partition(*apart)[0], self.partition(self.write("all.f64", f64(self.triangles)), *GRID)[0])
        for name, folders in (("one.npz", [self.partition(self.mesh, *GRID)[2]]), ("three.npz", apart)):
            self.succeed("voxelize", *folders, "--quiet", "-o", self.path(name))
        self.assertEqual(volumes.read(self.path("one.npz")), volumes.read(self.path("three.npz")))

    def test_refused(self):
        here = self.partition(self.pieces[0], *GRID)[2]
        for differing, options in (("grid", ("--cell", "0.0137,0.031,0.0159", "--origin", "-2,-2,-2", "--size", "%d,%d,%d" % SIZE)),
                                   ("shift", (*GRID, "--shift", "1,2,3"))):
            other = self.partition(self.pieces[1], *options)[2]
            for command in (("partition",), ("voxelize", "--shard", "1/2")):
                self.refuse(1, "do not fit together: they differ in the " + differing, *command, here, other, "-o", self.path("x.part.npz"))
        self.refuse(2, "is a partition and .* is a mesh: give meshes alone or partitions alone", "partition", here, self.mesh, "-o",
                    self.path("x"), *GRID)
        self.refuse(2, "which has its grid: leave out --cell", "partition", here, here, "-o", self.path("x"), "--cell", "1")
        self.refuse(2, "is no partition", "voxelize", here, self.mesh, "-o", self.path("x.npz"))
        self.refuse(2, "one mesh at a time", "voxelize", self.mesh, here, "-o", self.path("x.npz"), *GRID)

    def test_damaged(self):
        """A piece with a changed byte is named, wherever it is among them."""
        apart = [self.partition(piece, *GRID)[2] for piece in self.pieces]
        for n, memory in itertools.product(range(3), ("1G", "1000")):
            path = os.path.join(apart[n], "triangles")
            content = volumes.read(path)
            flipped = bytearray(content)
            flipped[self.pick.randrange(len(content))] ^= 1 << self.pick.randrange(8)
            self.write(path, bytes(flipped))
            pattern = os.path.basename(apart[n]) + ": damaged: the checksum of its triangles does not match"
            self.refuse(1, pattern, "partition", *apart, "-m", memory, "-o", self.path("x"))
            self.refuse(1, pattern, "voxelize", *apart, "--count")
            self.write(path, content)


class Failures(Pieces):
    def test_memory_option(self):
        for size in ("", "0", "-1", "1g", "1.5G", "G", "99999999999T", "1GB", "1 G"):
            self.refuse(2, "--memory: '%s' is no size" % size, "partition", self.mesh, *GRID, "-o", self.path("x"), "--memory", size)

    def test_disk_full(self):
        """In the files of runs, the triangles and the index."""
        for memory in ("1G", "3000"):
            for limit in (500, 5000, 30000):
                self.refuse(1, "x: cannot write all of it: File too large; nothing of it was kept", "partition", self.mesh, *GRID, "-m", memory,
                            "-o", self.path("x"), limit=(resource.RLIMIT_FSIZE, limit))

    def test_no_triangles(self):
        never = self.write("never.f32", f32([[[NEVER] * 3] * 3] * 3))
        for grid in (GRID, ("-r", "9")):
            self.refuse(1, "none of its triangles has finite coordinates", "partition", never, *grid, "-o", self.path("x"))
            self.refuse(1, "none of their triangles has finite coordinates", "partition", never, never, *grid, "-o", self.path("x"))
        self.refuse(1, "cut.f32: truncated", "partition", self.mesh, self.write("cut.f32", bytes(35)), *GRID, "-o", self.path("x"))
        self.refuse(1, "none.f32: cannot open the mesh file", "partition", self.mesh, self.path("none.f32"), *GRID, "-o", self.path("x"))

    def test_killed(self):
        """While runs are in files beside it: nothing is left by a signal that can be caught, and no half of it in any case."""
        arguments = ("partition", self.mesh, "-r", "3000", "-m", "3000", "-q", "-o", self.path("x"))
        start = time.monotonic()
        support.run(*arguments)
        taken = time.monotonic() - start
        whole = {name: volumes.read(self.path("x/" + name)) for name in ("index", "triangles")}
        for number in (signal.SIGTERM, signal.SIGKILL) * 6:
            subprocess.run(["rm", "-rf", self.path("x")], check=True)
            process = subprocess.Popen([support.program(), *arguments], stderr=subprocess.DEVNULL)
            time.sleep(self.pick.uniform(0, 1.1 * taken))
            process.send_signal(number)
            process.wait()
            if os.path.exists(self.path("x")):
                self.assertEqual({name: volumes.read(self.path("x/" + name)) for name in whole}, whole)
            drafts = [name for name in os.listdir(self.folder) if name.startswith(".tribox-")]
            self.assertFalse(drafts if number == signal.SIGTERM else [])
            for name in drafts:
                runs = set(os.listdir(self.path(name))) - {"index", "triangles"}
                self.assertFalse([run for run in runs if os.path.getsize(self.path(name + "/" + run))])  # they lose their names while empty
                subprocess.run(["rm", "-rf", self.path(name)], check=True)


if __name__ == "__main__":
    support.main()
