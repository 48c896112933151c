"""Meshes, boxes and grids that float cannot hold: exact about the doubles, far from the origin too. And --shift."""

import json
import os
import random
import struct
import zipfile

import meshes
import support
import volumes

FAR = (557820.125, 5108010.25, 812.5)  # UTM, and a height


def far_triangles(count, seed, offset=FAR):
    """In steps of a tenth around a place far away, which no double holds exactly; degenerate ones among them."""
    pick = random.Random(seed)
    triangles = []
    for _ in range(count):
        vertices = [tuple(x + pick.randint(-20, 20) / 10 for x in offset) for _ in range(3)]
        if pick.random() < 0.1:
            vertices[2] = vertices[pick.randint(0, 1)]
        triangles.append(tuple(vertices))
    return triangles


def pack_doubles(triangles, order="<"):
    return struct.pack("%s%dd" % (order, 9 * len(triangles)), *(x for t in triangles for v in t for x in v))


def ply(triangles, order="<"):
    name = "binary_little_endian" if order == "<" else "binary_big_endian"
    faces = b"".join(struct.pack(order + "B3i", 3, 3 * i, 3 * i + 1, 3 * i + 2) for i in range(len(triangles)))
    return meshes.ply_header(name, 3 * len(triangles), len(triangles)).replace(b"float", b"double") + pack_doubles(triangles, order) + faces


def text_of(box):
    return ",".join(map(repr, box))


class Voxelize(support.TestCase):
    def path(self, name):
        return os.path.join(self.folder, name)

    def cells(self, mesh, *options, name="cells.npy"):
        found = json.loads(self.succeed("voxelize", mesh, "-o", self.path(name), "--json", *options))
        size, cells = volumes.read_npy(self.path(name))
        self.assertEqual((list(size), found["occupied"]), (found["grid"]["size"], len(cells)))
        return found, cells

    def check(self, triangles, mesh, *options):
        found, cells = self.cells(mesh, *options)
        self.assertEqual(cells, volumes.occupied(triangles, found["grid"]))
        self.assertTrue(cells)
        return found

    def test_against_clipping(self):
        triangles = far_triangles(7, seed=12)
        mesh = self.write("far.ply", ply(triangles))
        for options in (("--resolution", "7"), ("--cell", "0.7"), ("--cell", "0.3,0.9,1.7", "--origin", "557818.1,5108008.3,810.5"),
                        ("--cell", "0.4", "--origin", "557819.9,5108010,812", "--size", "4,3,2")):
            found = self.check(triangles, mesh, *options)
            self.assertEqual(found["positions"], "float64")

    def test_floats_in_a_grid_of_doubles(self):
        """Cells that floats could not tell apart, or that are no floats themselves."""
        triangles = [tuple(tuple(volumes.float_of(x) for x in v) for v in t) for t in meshes.lattice_triangles(5, seed=13)]
        for name, content in (("mesh.ply", meshes.ply_binary), ("mesh.stl", meshes.stl_binary)):
            mesh = self.write(name, content(triangles))
            found = self.check(triangles, mesh, "--cell", "0.333333333333333", "--size", "9,9,9")
            self.assertEqual((found["positions"], found["grid"]["cell"]), ("float32", [0.333333333333333] * 3))
            self.check(triangles, mesh, "--cell", "0.7", "--origin", "-1.123456789,-2,-2")
        high = [tuple((x, y, z + 5108010) for x, y, z in t) for t in meshes.lattice_triangles(2, seed=14)]
        high = [tuple(tuple(volumes.float_of(x) for x in v) for v in t) for t in high]
        mesh = self.write("high.ply", meshes.ply_binary(high))
        self.check(high, mesh, "--cell", "0.5,0.5,0.125", "--size", "8,8,20")

    def test_moved_by_what_is_exact(self):
        """The cells of a mesh and a grid are those at the origin, for every number of threads and in shards."""
        near = meshes.lattice_triangles(40, seed=15)
        far = [tuple(tuple(x + o for x, o in zip(v, (557820, 5108010, 800))) for v in t) for t in near]
        _, expected = self.cells(self.write("near.ply", meshes.ply_binary(near)), "--cell", "0.0625", "--origin", "-2,-2,-2", "--size", "65,64,63")
        mesh = self.write("far.ply", ply(far))
        grid = ("--cell", "0.0625", "--origin", "557818,5108008,798", "--size", "65,64,63")
        for threads in ("1", "3"):
            self.assertEqual(self.cells(mesh, *grid, "--threads", threads)[1], expected)
        parts = [self.path("%d.part.npz" % shard) for shard in (1, 2, 3)]
        for shard, part in enumerate(parts):
            self.succeed("voxelize", mesh, *grid, "--shard", "%d/3" % (shard + 1), "--quiet", "-o", part)
        found = json.loads(self.succeed("merge", *parts, "-o", self.path("all.npy"), "--json"))
        self.assertEqual(volumes.read_npy(self.path("all.npy")), ((65, 64, 63), expected))
        self.assertEqual(found["grid"]["origin"], [557818, 5108008, 798])
        with zipfile.ZipFile(parts[0]) as file:
            self.assertEqual([struct.unpack("<3d", file.read(name)[128:]) for name in ("origin.npy", "cell.npy", "shift.npy")],
                             [(557818, 5108008, 798), (0.0625,) * 3, (0,) * 3])

    def test_shift(self):
        """Subtracted before all else, and kept where a format has a place for it."""
        triangles = far_triangles(12, seed=16)
        mesh, shift = self.write("far.ply", ply(triangles)), (557818.3, 5108000.0, 0.7)
        moved = [tuple(tuple(x - s for x, s in zip(v, shift)) for v in t) for t in triangles]
        options = ("voxelize", mesh, "--cell", "0.9", "--shift", text_of(shift))
        found = json.loads(self.succeed_with_note("note: .*a.npy does not hold that its cells are shifted by 557818.3,5108000,0.7$", *options, "-o",
                                                  self.path("a.npy"), "--json"))
        self.assertEqual(found["shift"], list(shift))
        self.assertEqual(volumes.read_npy(self.path("a.npy"))[1], volumes.occupied(moved, found["grid"]))
        self.assertRegex(self.succeed(*options, "-o", self.path("a.binvox")), r"(?m)^shift +557818.3,5108000,0.7$")
        _, cells, translate, _ = volumes.read_binvox(self.path("a.binvox"))
        self.assertEqual(cells, volumes.read_npy(self.path("a.npy"))[1])
        self.assertEqual(translate, [x + s for x, s in zip(found["grid"]["origin"], shift)])
        for name in ("a.vox", "a.raw"):
            self.succeed_with_note("note: .*%s does not hold that" % name, *options, "-o", self.path(name), "--quiet")
        parts = [self.path("%d.part.npz" % shard) for shard in (1, 2)]
        for shard, part in enumerate(parts):
            self.succeed(*options, "--shard", "%d/2" % (shard + 1), "-o", part)
        self.assertEqual(json.loads(self.succeed("merge", *parts, "-o", self.path("b.binvox"), "--json"))["shift"], list(shift))
        self.assertEqual(volumes.read(self.path("b.binvox")), volumes.read(self.path("a.binvox")))
        other = self.path("other.part.npz")
        self.succeed("voxelize", mesh, "--cell", "0.9", "--origin", ",".join(map(repr, found["grid"]["origin"])), "--size",
                     ",".join(map(str, found["grid"]["size"])), "--shard", "2/2", "-o", other)
        self.fail_with(1, "they differ in the shift", "merge", parts[0], other, "-o", self.path("c.npy"))

    def test_bunny_in_utm(self):
        """A scan, 20 m long, in the coordinates of a map."""
        path = os.path.join(os.environ.get("TRIBOX_MESHES", ""), "stanford-bunny.ply")
        if not os.path.isfile(path):
            self.skipTest("no stanford-bunny.ply; TRIBOX_MESHES names the folder of meshes")
        with open(path, "rb") as file:
            head, end, body = file.read().partition(b"end_header\n")
        count = int(head.split(b"element vertex ")[1].split()[0])
        numbers = struct.unpack("<%df" % (3 * count), body[:12 * count])
        lo, hi = ([pick(numbers[a::3]) for a in range(3)] for pick in (min, max))
        scale = 20 / max(h - l for l, h in zip(lo, hi))
        moved = [(x - lo[k % 3]) * scale + (557820, 5108010, 0)[k % 3] for k, x in enumerate(numbers)]
        mesh = self.write("utm.ply", head.replace(b"float", b"double") + end + struct.pack("<%dd" % (3 * count), *moved) + body[12 * count:])
        self.assertEqual(self.cells(mesh, "--cell", "0.5")[0]["occupied"], 5379)


if __name__ == "__main__":
    support.main()
