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
STAGES = ["none", "in file order", "ordered"]


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


def lines(triangles, before=""):
    return "".join(before + "%r %r %r\n" % v for t in triangles for v in t)


FORMATS = {
    "little.ply": ply,
    "big.ply": lambda triangles: ply(triangles, ">"),
    "ascii.ply": lambda triangles: meshes.ply_header("ascii", 3 * len(triangles), len(triangles)).decode() + lines(triangles) +
    meshes.face_lines(triangles, "3"),
    "text.off": lambda triangles: "OFF %d %d 0\n" % (3 * len(triangles), len(triangles)) + lines(triangles) + meshes.face_lines(triangles, "3"),
    "text.obj": lambda triangles: lines(triangles, "v ") + meshes.face_lines(triangles, "f", 1),
    "text.stl": lambda triangles: "solid\n" + "".join("facet normal 0 0 1\nouter loop\n" + lines([t], "vertex ") + "endloop\nendfacet\n"
                                                      for t in triangles) + "endsolid\n",
    "raw.f64": pack_doubles,
}


def text_of(box):
    return ",".join(map(repr, box))


def boxes_near(count, seed, offset=FAR):
    pick = random.Random(seed)
    boxes = []
    for _ in range(count):
        lo = [x + pick.randint(-20, 15) / 10 for x in offset]
        boxes.append(tuple(lo) + tuple(x + pick.randint(0, 15) / 10 for x in lo))
    return boxes


class Overlap(support.TestCase):
    def test_every_format(self):
        triangles = far_triangles(150, seed=1)
        for box in boxes_near(3, seed=2):
            expected = meshes.overlapping(triangles, box)
            for name, content in FORMATS.items():
                answer = self.overlap(self.write(name, content(triangles)), text_of(box))
                self.assertEqual((answer["indices"], answer["positions"], answer["rounded"]), (expected, "float64", 0), name)
                self.assertEqual(answer["box"], {"lo": list(box[:3]), "hi": list(box[3:])})

    def test_every_way(self):
        triangles = far_triangles(200, seed=3)
        mesh, box = self.write("far.ply", ply(triangles)), boxes_near(1, seed=4)[0]
        expected = meshes.overlapping(triangles, box)
        for kernel in json.loads(self.succeed("info", "--json"))["kernels"]:
            self.assertEqual(self.overlap(mesh, text_of(box), "--kernel", kernel)["indices"], expected)
        for more in (("--accuracy", "conservative"), ("--accuracy", "fast"), ("--axes", "box"), ("--axes", "plane,edges")):
            self.assertLessEqual(set(expected), set(self.overlap(mesh, text_of(box), *more)["indices"]))
        self.assertRegex(self.succeed("overlap", mesh, "--box", text_of(box)), r"(?m)^triangles +200\npositions +float64$")

    def test_boxes_and_inside(self):
        triangles, boxes = far_triangles(60, seed=5), boxes_near(8, seed=6)
        text = "".join(text_of(box) + "\n" for box in boxes)
        for name in ("little.ply", "raw.f64"):
            mesh = self.write(name, FORMATS[name](triangles))
            found = self.succeed("overlap", mesh, "--boxes", "-", "--json", "--list", stdin=text.encode())
            self.assertEqual([json.loads(line)["indices"] for line in found.splitlines()], [meshes.overlapping(triangles, box) for box in boxes])
            found = self.succeed("overlap", mesh, "--boxes", "-", "--json", "--inside", stdin=text.encode())
            self.assertEqual([json.loads(line)["inside"] for line in found.splitlines()], [len(meshes.inside(triangles, box)) for box in boxes])

    def test_streams(self):
        """Around the edges of blocks, from a file and from standard input, not finite ones among them."""
        some, box = far_triangles(70, seed=7), boxes_near(1, seed=8)[0]
        expected = meshes.overlapping(some, box)
        nan = ((float("nan"), 0.0, 0.0),) * 3
        for count in (70, 4096, 4097, 8260):
            triangles = (some * 120)[:count] + [nan]
            packed = pack_doubles(triangles)
            indices = [i for start in range(0, count, 70) for i in (start + k for k in expected) if i < count]
            for arguments, stdin in (((self.write("raw.f64", packed),), b""), (("-", "--format", "f64"), packed)):
                text = self.succeed_with_note("1 of %d triangles have NaN or infinite coordinates and overlap nothing; the first is number %d$" %
                                              (count + 1, count), "overlap", *arguments, "--box", text_of(box), "--list", stdin=stdin)
                self.assertEqual(text, "".join("%d\n" % i for i in indices))
        for size in (1, 71, 73, 72 * 4096 + 8):
            self.fail_with(1, "stdin: truncated: %d triangles were read, then it ends with %d of 72 bytes of the next" % divmod(size, 72),
                           "overlap", "-", "--format", "f64", "--box", "0,0,0,1,1,1", stdin=bytes(size))
            self.fail_with(1, "cut.f64: truncated, or not raw triangles: after %d triangles of 72 bytes it has %d bytes more" % divmod(size, 72),
                           "overlap", self.write("cut.f64", bytes(size)), "--box", "0,0,0,1,1,1")

    def test_oriented(self):
        """As the doubles that they are."""
        triangles = far_triangles(80, seed=9)
        mesh = self.write("far.ply", ply(triangles))
        exact = [repr(x) for x in FAR]
        for content in (mesh, self.write("far.f64", pack_doubles(triangles))):
            text = self.succeed("overlap", content, "--oriented", ",".join(exact) + ",0.7,0.7,0.7,1,0,0,0,1,0,0,0,1", "--json", "--list")
            answer = json.loads(text)
            self.assertEqual((answer["positions"], answer["oriented"]["center"]), ("float64", list(FAR)))
            self.assertEqual((answer["oriented"]["half"], answer["rounded"]), ([0.7] * 3, 0))
            self.assertEqual(answer["indices"], meshes.overlapping_oriented(triangles, list(FAR) + [0.7] * 3 + [1, 0, 0, 0, 1, 0, 0, 0, 1]))


class BoxesOfDoubles(support.TestCase):
    """A mesh of floats against bounds between two floats."""

    @classmethod
    def setUpClass(cls):
        pick = random.Random(10)
        cls.triangles = [tuple(tuple(volumes.float_of(pick.randint(0, 12) / 10) for _ in range(3)) for _ in range(3)) for _ in range(90)]
        tenths = [volumes.float_of(n / 10) + step * 1e-12 for n in range(13) for step in (-1, 1)]
        cls.boxes = [tuple(pick.choice(tenths[:14]) for _ in range(3)) + tuple(pick.choice(tenths[14:]) for _ in range(3)) for _ in range(10)]
        cls.boxes += [(-1e300, 0.1234567890123, -1.0, 1e300, 0.6, 1e39), (1e39, 0.0, 0.0, 1e40, 1.0, 1.0), (-1e300,) * 3 + (1e300,) * 3]
        x = volumes.float_of(0.3) + 1e-12  # thinner than the floats are apart
        cls.boxes += [(x, 0.0, 0.0, x + 1e-12, 1.0, 1.0), (x, 0.0, 0.0, x, 1.0, 1.0), (0.1, 0.1, 0.1, 0.1000000000001, 0.6, 0.6)]
        cls.lists = [meshes.overlapping(cls.triangles, box) for box in cls.boxes]

    def test_every_file(self):
        for name, content in (("mesh.ply", meshes.ply_binary), ("mesh.stl", meshes.stl_binary), ("mesh.f32", meshes.pack_floats)):
            mesh = self.write(name, content(self.triangles))
            for box, expected in list(zip(self.boxes, self.lists))[::3]:
                answer = self.overlap(mesh, ",".join("%.17g" % x for x in box))
                self.assertEqual((answer["indices"], answer["positions"]), (expected, "float32"), box)
                self.assertEqual(answer["box"]["lo"] + answer["box"]["hi"], list(box))

    def test_inside_and_axes(self):
        mesh = self.write("mesh.ply", meshes.ply_binary(self.triangles))
        for box, expected in zip(self.boxes, self.lists):
            text = ",".join("%.17g" % x for x in box)
            answer = json.loads(self.succeed("overlap", mesh, "--box", text, "--inside", "--json"))
            self.assertEqual((answer["overlapping"], answer["inside"]), (len(expected), len(meshes.inside(self.triangles, box))), box)
        box, expected = ",".join("%.17g" % x for x in self.boxes[0]), set(self.lists[0])
        found = {axes: set(self.overlap(mesh, box, "--axes", axes)["indices"]) for axes in ("box", "plane", "edges")}
        self.assertEqual(found["box"] & found["plane"] & found["edges"], expected)

    def test_index(self):
        """Through all stages, with boxes of floats in between."""
        mesh = self.write("mesh.f32", meshes.pack_floats(self.triangles))
        floats = ["0,0,0,0.5,0.5,0.5", "0.25,0.25,0,1,1,1"]
        text = "".join(",".join("%.17g" % x for x in box) + "\n" for box in self.boxes) + "\n".join(floats) + "\n"
        lists = self.lists + [meshes.overlapping(self.triangles, [float(x) for x in box.split(",")]) for box in floats]
        for more in (("--list",), ()):
            answers = [json.loads(line) for line in
                       self.succeed("overlap", mesh, "--boxes", "-", "--json", *more, stdin=(text * 40).encode()).splitlines()]
            self.assertEqual(len(answers), 40 * len(lists))
            self.assertEqual([stage for stage in STAGES if stage in {a["index"] for a in answers}], STAGES)
            for at, answer in enumerate(answers):
                expected = lists[at % len(lists)]
                self.assertEqual(answer.get("indices", expected), expected, (at, answer["index"]))
                self.assertEqual(answer["overlapping"], len(expected), (at, answer["index"]))

    def test_decimals(self):
        """What a float gives back is that float to a mesh of floats, and the double to a mesh of doubles."""
        point = tuple(volumes.float_of(x) for x in (0.1, 0.7, 557820.13))
        mesh = self.write("floats.ply", meshes.ply_binary([(point,) * 3]))
        self.assertEqual(self.overlap(mesh, "0.1,0.7,557820.13,0.1,0.7,557820.13")["indices"], [0])
        self.assertEqual(self.overlap(mesh, "0.1,0.7,557820.13000000,0.1,0.7,557820.13000000")["indices"], [])
        mesh = self.write("doubles.ply", ply([((0.1, 0.7, 557820.13),) * 3]))
        self.assertEqual(self.overlap(mesh, "0.1,0.7,557820.13,0.1,0.7,557820.13")["indices"], [0])


class Shift(support.TestCase):
    def test_subtracts(self):
        for name, content in (("floats.ply", meshes.ply_binary), ("floats.f32", meshes.pack_floats), ("floats.stl", meshes.stl_binary),
                              ("text.obj", meshes.obj), ("doubles.ply", ply), ("raw.f64", pack_doubles)):
            triangles = meshes.lattice_triangles(60, seed=11)
            for shift in ((0.5, -2.0, 0.125), (0.1, 1e-9, 557820.15)):
                moved = [tuple(tuple(x - s for x, s in zip(v, shift)) for v in t) for t in triangles]
                box = tuple(x - s for x, s in zip((-0.5,) * 3, shift)) + tuple(x - s for x, s in zip((0.5,) * 3, shift))
                answer = self.overlap(self.write(name, content(triangles)), text_of(box), "--shift", text_of(shift))
                self.assertEqual((answer["indices"], answer["shift"]), (meshes.overlapping(moved, box), list(shift)), name)
                self.assertEqual(answer["positions"], "float64" if shift[0] == 0.1 else "float32", name)

    def test_decimals_are_subtracted_from(self):
        """From the doubles nearest to the text, before any of it is rounded."""
        mesh = self.write("text.obj", "v 0.7 0 0\nv 0.7 0 0\nv 0.7 0 0\nf 1 2 3\n")
        x = repr(0.7 - 0.5)
        self.assertEqual(self.overlap(mesh, "%s,0,0,%s,0,0" % (x, x), "--shift", "0.5,0,0")["indices"], [0])

    def test_auto(self):
        for offset, extent, shift in ((FAR, 20, [557800, 5108000, 800]), ((-557820.5, 3.5, -0.5), 7, [-557820, 0, 0]),
                                      ((1e7, 0.123456, 1234.5678), 0.01, [1e7, 0.12, 1234.56])):
            triangle = (offset, tuple(x + extent for x in offset), offset)
            mesh = self.write("auto.ply", ply([triangle]))
            answer = self.overlap(mesh, "0,0,0,1,1,1", "--shift", "auto")
            self.assertEqual(answer["shift"], shift)
            self.assertRegex(self.succeed("overlap", mesh, "--box", "0,0,0,1,1,1", "--shift", "auto"),
                             r"(?m)^shift +%s\n" % ",".join("%.15g" % x for x in shift))
        point = self.write("point.obj", "v 5 5 5\nf 1 1 1\n")
        self.assertEqual(self.overlap(point, "0,0,0,1,1,1", "--shift", "auto")["shift"], [5, 5, 5])

    def test_sweep(self):
        """Which rounds to float: next to nothing of a mesh that is near the origin by then."""
        mesh = self.write("far.ply", ply(far_triangles(9, seed=17)))
        text = self.succeed_with_note(r"rounding to float moved coordinates of [0-9]+ vertices by up to [1-9](\.\d)?e-0[678]$", "sweep", mesh,
                                      "--grid", "1", "--json", "--quick", "--shift", "auto")
        self.assertEqual(json.loads(text)["shift"], [557810, 5108000, 810])

    def test_wrong(self):
        self.fail_with(2, "--shift: 2 numbers where 3 are needed; give X,Y,Z or auto", "overlap", "a.ply", "--box", support.UNIT_BOX,
                       "--shift", "1,2")
        self.fail_with(2, "--shift: 'automatic' .* is not a number", "voxelize", "a.ply", "--cell", "1", "-o", "a.npy", "--shift",
                       "automatic")


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
