"""tribox voxelize --ids: of each cell the lowest triangle, in every format, against rational numbers, one triangle after another."""

import functools
import itertools
import json
import os
import random
import struct
import subprocess
import zipfile

import coloured
import meshes
import support
import volumes
from test_labels import npy_of

SEED = int(os.environ.get("TRIBOX_TEST_SEED", "1"))
NAN = float("nan")
SIZE = (131, 11, 70)  # 3 x 1 x 2 tiles, and bricks that the grid cuts
ABOUT = {"origin": [-2, -2.25, -2], "cell": [0.5, 0.75, 0.5], "size": SIZE}
GRID = ("--cell", "0.5,0.75,0.5", "--origin=-2,-2.25,-2", "--size", "%d,%d,%d" % SIZE)


def around(corner, reach, pick):
    """In steps of 1/8, on planes of the grid among others."""
    return tuple(tuple(c + pick.randint(-reach, reach) / 8 for c in corner) for _ in range(3))


@functools.lru_cache
def scene():
    """Triangles in every tile and across their borders; on planes, doubled, of one point and of two; large ones before and after."""
    print("seed", SEED)
    pick = random.Random(SEED)
    corners = [(x, 0.75, z) for x in (-2, 14, 30, 62, 63.5) for z in (-2, 6, 14, 30, 33)]
    triangles = [around(corner, 12, pick) for corner in corners for _ in range(3)]
    flat = [tuple((x, y, 14.0) for x, y, _ in triangle) for triangle in triangles[:30:3]]
    points = [((x, 0.0, z),) * 3 for x, z in ((30, 30), (30.25, 30), (-2, -2), (63.5, 33))]
    lines = [((x, 0.0, 14.0), (x + 2, 0.0, 14.0), (x + 2, 0.0, 14.0)) for x in (29, 30)]
    large = [((-2, 1, -2), (63, 1.25, 33), (62, 1, 33)), ((28, -2, 12), (33, 6, 17), (28, 6, 17))]
    triangles = large[1:] + triangles + flat + points + lines + large
    triangles += pick.sample(triangles, 20)
    pick.shuffle(triangles)
    return triangles + triangles[::-7]


@functools.lru_cache
def truth():
    return coloured.lowest(scene(), ABOUT)


def ids_of(array, size=SIZE):
    """{cell: id} of int32 for all cells."""
    numbers = struct.unpack("<%di" % (len(array) // 4), array)
    assert len(numbers) == size[0] * size[1] * size[2]
    assert min(numbers) >= -1
    return {(n % size[0], n // size[0] % size[1], n // size[0] // size[1]): number for n, number in enumerate(numbers) if number >= 0}


def read_npz(path):
    with zipfile.ZipFile(path) as file:
        assert file.testzip() is None
        (_, at), (_, bits), (header, ids) = (npy_of(file.read(name + ".npy")) for name in ("at", "bits", "ids"))
    assert "'<u4'" in header and "'shape': (%d,)" % (len(ids) // 4) in header
    cells = [(8 * a + bit % 8, 8 * b + bit // 8, 8 * c + k) for (a, b, c), words in zip(struct.iter_unpack("<3I", at), struct.iter_unpack("<8Q", bits))
             for k, word in enumerate(words) for bit in range(64) if word >> bit & 1]
    assert len(cells) == len(set(cells)) == len(ids) // 4
    return dict(zip(cells, struct.unpack("<%dI" % len(cells), ids)))


def read_dense(path):
    """Whatever stands before and after."""
    data, length = volumes.read(path), 4 * SIZE[0] * SIZE[1] * SIZE[2]
    if path.endswith(".vti"):
        head, rest = data.split(b'<AppendedData encoding="raw">\n   _')
        assert b'<DataArray type="Int32" Name="id" format="appended" offset="0"/>' in head and b'Scalars="id"' in head
        assert struct.unpack_from("<Q", rest) == (length,) and rest[8 + length:] == b"\n  </AppendedData>\n</VTKFile>\n"
        return ids_of(rest[8:8 + length])
    head, cells = data[:-length], data[-length:]
    if path.endswith(".nrrd"):
        assert b"\ntype: int32\nendian: little\ndimension: 3\n" in head and head.endswith(b"\n\n")
    if path.endswith(".npy"):
        assert "'descr': '<i4', 'fortran_order': False, 'shape': (70, 11, 131)" in npy_of(data)[0]
    assert path.endswith(".raw") == (not head)
    return ids_of(cells)


READERS = {".npz": read_npz, ".npy": read_dense, ".nrrd": read_dense, ".vti": read_dense, ".raw": read_dense,
           ".vdb": volumes.read_vdb_numbers}


class Ids(support.TestCase):
    def setUp(self):
        super().setUp()
        self.mesh = self.write("mesh.f32", meshes.pack_floats(scene()))

    def path(self, name):
        return os.path.join(self.folder, name)

    def ids(self, mesh, ending, *options):
        out = self.path("ids" + ending)
        self.succeed("voxelize", mesh, *GRID, "--ids", *options, "-q", "-o", out)
        return READERS[ending](out)

    def test_formats(self):
        for ending in READERS:
            if ending == ".vdb" and not support.has_openvdb():
                continue
            for threads in "1", "3":
                self.assertEqual(self.ids(self.mesh, ending, "--threads", threads), truth(), (ending, threads))
        self.assertEqual(self.ids(self.mesh, ".npz", "--deflate"), truth())

    def test_doubles(self):
        """Places that float32 does not hold, and cells that lie between those that it does."""
        triangles = [tuple(tuple(x + 2.0 ** -40 for x in v) for v in t) for t in scene()[-60:]]
        mesh = self.write("mesh.f64", b"".join(struct.pack("<9d", *itertools.chain(*t)) for t in triangles))
        lowest = coloured.lowest(triangles, ABOUT)
        self.assertNotEqual(lowest, coloured.lowest(scene()[-60:], ABOUT))
        for ending in (".npz", ".raw"):
            self.assertEqual(self.ids(mesh, ending), lowest)

    def test_not_finite(self):
        """A number each, and no cells."""
        triangles = [((NAN, 0, 0),) * 3, *scene()[:40], ((0, 0, 0), (0, NAN, 0), (1, 1, 1)), *scene()[40:]]
        mesh = self.write("nan.f32", meshes.pack_floats(triangles))
        expected = {cell: n + 1 + (n >= 40) for cell, n in truth().items()}
        out = self.path("ids.npz")
        self.succeed_with_note("2 of %d triangles have NaN" % len(triangles), "voxelize", mesh, *GRID, "--ids", "-q", "-o", out)
        self.assertEqual(read_npz(out), expected)

    def test_polygons(self):
        """Numbers are of the triangles that polygons are cut into, and of those alone."""
        square = [(-1.9, y, z) for y, z in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        triangles = [tuple(square[:3]), (square[0], square[2], square[3]), *scene()]
        vertices = square + [v for triangle in scene() for v in triangle]
        polygons = [(0, 1, 2, 3), (0, 1), *((n, n + 1, n + 2) for n in range(4, len(vertices), 3))]
        first = coloured.lowest([tuple(tuple(map(volumes.float_of, v)) for v in t) for t in triangles[:2]], ABOUT)
        lowest = {cell: n + 2 for cell, n in truth().items()}
        self.assertEqual(self.ids(self.write("polygons.ply", coloured.ply(vertices, polygons)), ".raw"), {**lowest, **first})

    def test_shards(self):
        """Each cell is in one of the parts, which say which part they are."""
        for shards in (1, 3, 8):
            parts = []
            for shard in range(1, shards + 1):
                parts.append(self.ids(self.mesh, ".npz", "--shard", "%d/%d" % (shard, shards)))
                with zipfile.ZipFile(self.path("ids.npz")) as file:
                    self.assertEqual(npy_of(file.read("shard.npy"))[1], struct.pack("<2I", shard, shards))
            self.assertEqual({cell: n for part in parts for cell, n in part.items()}, truth())
            self.assertEqual(sum(map(len, parts)), len(truth()))

    def test_none(self):
        mesh = self.write("none.f32", meshes.pack_floats([((900, 0, 0),) * 3]))
        for ending in (".npz", ".raw"):
            self.assertEqual(self.ids(mesh, ending), {})

    def test_output(self):
        """Standard output, the summary, and the picture, which is as without ids."""
        for word in ("npy", "npz"):
            done = subprocess.run([support.program(), "voxelize", self.mesh, *GRID, "--ids", "-o", "-", "--out-format", word],
                                  capture_output=True, timeout=120)
            self.ids(self.mesh, "." + word)
            self.assertEqual((done.returncode, done.stderr, done.stdout), (0, b"", volumes.read(self.path("ids." + word))))
        pictures = [self.path(name) for name in ("one.png", "two.png")]
        for picture, options in zip(pictures, (("--ids",), ())):
            found = json.loads(self.succeed("voxelize", self.mesh, *GRID, *options, "--json", "-o", self.path("x.npz"), "-p", picture,
                                            "--picture-size", "80x60"))
            self.assertEqual((found.get("ids"), found["occupied"]), (True if options else None, len(truth())))
        self.assertEqual(*map(volumes.read, pictures))
        self.assertIn("\nids          the lowest triangle of each cell\n",
                      self.succeed("voxelize", self.mesh, *GRID, "--ids", "-o", self.path("x.npz")))

    def test_memory(self):
        """Bricks go beyond what memory holds of the whole; what does not fit is refused before."""
        grid = ("--cell", "0.5,0.75,0.5", "--origin=-2,-2.25,-2", "--size", "20000,4000,20000")
        self.succeed("voxelize", self.mesh, *grid, "--ids", "-q", "-o", self.path("far.npz"))
        found = read_npz(self.path("far.npz"))
        self.assertEqual({cell: n for cell, n in found.items() if all(c < s for c, s in zip(cell, SIZE))}, truth())
        grid = grid[:-1] + ("20000,4000,200",)
        self.fail_with(1, "the ids of .* cells take .* of memory in this format and .* are available; write .npz or .vdb",
                       "voxelize", self.mesh, *grid, "--ids", "-o", self.path("x.raw"))

    def test_refused(self):
        for pattern, options in (
                ("leave out --ids", ("--count",)), ("leave out --fill", ("--fill", "outside", "-o", "x.npz")),
                ("leave out --thin", ("--thin", "-o", "x.npz")), ("run it for each", ("--colours", "-o", "x.npz")),
                ("--ids and --vdb-grid exclude each other", ("--vdb-grid", "mask", "-o", "x.vdb")),
                *(("--ids: .%s holds none; write .npz" % word, ("--out-format", word, "-o", "x"))
                  for word in ("cells", "binvox", "vox", "ply", "obj", "glb"))):
            self.fail_with(2, pattern, "voxelize", self.mesh, *GRID, "--ids", *options)
        self.succeed("partition", self.mesh, *GRID, "-q", "-o", self.path("tiles"))
        self.succeed("partition", self.mesh, *GRID, "--ids", "-q", "-o", self.path("numbered"))
        tiles, numbered = self.path("tiles"), self.path("numbered")
        self.fail_with(1, "tiles: has no numbers of its triangles; make it with 'tribox partition --ids'", "voxelize", tiles, "--ids",
                       "-o", self.path("x.npz"))
        for command in (("voxelize", "--ids"), ("partition",)):
            self.fail_with(1, "numbered has the numbers of its triangles and .*tiles has none; make both with --ids, or neither",
                           command[0], tiles, numbered, *command[1:], "-o", self.path("x.npz"))
        self.fail_with(2, "which has ids or has none: leave out --ids", "partition", numbered, "--ids", "-o", self.path("x"))

    def whole(self, ending, *options):
        """The file of one process about the mesh."""
        out = self.path("whole" + ending)
        self.done("voxelize", self.mesh, *GRID, "--ids", *options, "-q", "-o", out)
        return volumes.read(out)

    def done(self, *arguments):
        """Warnings aside, as of triangles that are not finite."""
        result = support.run(*arguments)
        self.assertEqual((result.code, result.stdout), (0, ""), result.stderr)

    def numbered(self, name, triangles, *options):
        """The partition of some triangles."""
        mesh, out = self.write(name + ".f32", meshes.pack_floats(triangles)), self.path(name)
        self.done("partition", mesh, *GRID, "--ids", "-q", *options, "-o", out)
        return out

    def test_partitions(self):
        """Sorted in any memory, in pieces, and joined, triangles have the numbers that they have in the mesh."""
        pieces = [scene()[:37], scene()[37:38], [((NAN, 0, 0),) * 3] * 5, scene()[38:]]
        self.mesh = self.write("mesh.f32", meshes.pack_floats(sum(pieces, [])))
        with_nan = {cell: n + (n >= 38) * 5 for cell, n in truth().items()}
        small, parts = ("--memory", "1K", "--threads", "3"), []
        for name, triangles in zip("abcd", pieces):
            if name == "c":  # a mesh of nothing else is refused: it goes with its neighbour
                continue
            parts.append(self.numbered(name, triangles if name != "d" else pieces[2] + triangles, *(small if name == "d" else ())))
        joined, files = self.path("joined"), [self.path(name + ".f32") for name in "abd"]
        self.done("partition", *parts, *small, "-q", "-o", joined)
        self.done("partition", *files, *GRID, "--ids", *small, "-q", "-o", self.path("all"))
        expected = self.whole(".npz")
        self.assertEqual(read_npz(self.path("whole.npz")), with_nan)
        for given in parts, [joined], [self.path("all")], [self.numbered("mesh", sum(pieces, []), *small)]:
            for threads in "1", "3":
                out = self.path("x.npz")
                self.done("voxelize", *given, "--ids", "-q", "-t", threads, "-o", out)
                self.assertEqual(volumes.read(out), expected, (given, threads))
        self.assertEqual(*(volumes.read(os.path.join(self.path(name), "numbers")) for name in ("joined", "all")))

    def test_damaged_numbers(self):
        folder, other = self.numbered("tiles", scene()), self.numbered("other", scene()[:9])
        path = os.path.join(folder, "numbers")
        octets = bytearray(volumes.read(path))
        for changed, why in ((octets[:-4], "its numbers are not as many as its index says"),
                             (bytes(a ^ (n == 77) for n, a in enumerate(octets)), "the checksum of its triangles does not match")):
            with open(path, "wb") as file:
                file.write(changed)
            for command in (("voxelize", "--ids"), ("voxelize",), ("partition", other)):
                self.fail_with(1, "tiles: damaged: " + why, command[0], folder, *command[1:], "-o", self.path("x.npz"))

    def parts(self, mesh, count, *options):
        """The files of all shards."""
        names = [self.path("%d.part.npz" % shard) for shard in range(1, count + 1)]
        for shard, name in enumerate(names, 1):
            self.succeed("voxelize", mesh, *options, "--ids", "-q", "--shard", "%d/%d" % (shard, count), "-o", name)
        return names

    def test_merge(self):
        """Parts of a mesh and of a partition are the same files, and become what one process writes, in every format."""
        folder = self.numbered("tiles", scene())
        for count in 1, 3:
            expected = list(map(volumes.read, self.parts(self.mesh, count, *GRID)))
            names = self.parts(folder, count)
            self.assertEqual(list(map(volumes.read, names)), expected)
            for ending in READERS:
                if ending == ".vdb" and not support.has_openvdb():
                    continue
                for options in ((), ("-t", "1"), ("--deflate",))[:3 if ending == ".npz" else 1]:
                    out = self.path("merged" + ending)
                    self.succeed("merge", *names[::-1], "-q", *options, "-o", out)
                    deflate = [option for option in options if option == "--deflate"]
                    whole = self.whole(ending, *deflate)
                    if ending == ".vdb":  # with a number of its own
                        self.assertEqual(READERS[ending](out), truth())
                    else:
                        self.assertEqual(volumes.read(out), whole, (ending, options))
        self.fail_with(1, "1.part.npz: has ids, and .glb holds none: write .npz", "merge", *names, "-o", self.path("x.glb"))
        self.fail_with(1, "has ids, a grid of whole numbers: leave out --vdb-grid", "merge", *names, "--vdb-grid", "mask",
                       "-o", self.path("x.vdb"))
        octets = volumes.read(names[1])
        self.succeed("voxelize", folder, "-q", "--shard", "2/3", "-o", names[1])
        self.fail_with(1, "they differ in the ids: some have none", "merge", *names, "-o", self.path("x.npz"))
        for changed, why in ((octets[:-40], "not a part, or only the beginning of one"),
                             (octets[:400] + bytes([octets[400] ^ 1]) + octets[401:], "damaged")):
            with open(names[1], "wb") as file:
                file.write(changed)
            self.fail_with(1, "2.part.npz: .*" + why, "merge", *names, "-o", self.path("x.npz"))

    def test_order(self):
        """Shards of one mesh in two orders have other ids: of its triangles, of those that are not finite, and of partitions."""
        nan, mesh = ((NAN, 0, 0),) * 3, scene()
        orders = [mesh, mesh[::-1], [mesh[1], mesh[0], *mesh[2:]], [nan, *mesh], [*mesh[:9], nan, *mesh[9:]]]
        files = [(self.write("%d.f32" % n, meshes.pack_floats(order)), *GRID) for n, order in enumerate(orders)]
        tiles = [self.numbered("%d.tiles" % n, order) for n, order in enumerate((mesh[:9], mesh[9:]))]
        for one, other in (files[0], files[1]), (files[0], files[2]), (files[3], files[4]), (tiles, tiles[::-1]):
            for ids, second, is_sound in (("--ids",), one, True), ((), other, True), (("--ids",), other, False):
                for shard, source in (1, one), (2, second):
                    self.done("voxelize", *source, *ids, "-q", "--shard", "%d/2" % shard, "-o", self.path("%d.part.npz" % shard))
                merge = ("merge", self.path("1.part.npz"), self.path("2.part.npz"), "-q", "-o", self.path("x.npz"))
                if is_sound:
                    self.succeed(*merge)
                else:
                    self.fail_with(1, "differ in the order of the triangles, whose numbers the ids are: run the shards with one", *merge)


if __name__ == "__main__":
    support.main()
