"""tribox voxelize: its cells against exact clipping, its grids, and its files through independent readers."""

import json
import os
import re
import subprocess

import meshes
import support
import volumes

ENDINGS = ("npy", "raw", "binvox", "vox")


class Voxelize(support.TestCase):
    def setUp(self):
        super().setUp()
        self.triangles = meshes.lattice_triangles(24, seed=5)
        self.mesh = self.write("mesh.ply", meshes.ply_binary(self.triangles))

    def path(self, name):
        return os.path.join(self.folder, name)

    def voxelize(self, out, *options, mesh=None):
        """What --json prints."""
        return json.loads(self.succeed("voxelize", mesh or self.mesh, "-o", self.path(out), "--json", *options))

    def cells(self, *options, mesh=None):
        """The grid and the cells of a run."""
        found = self.voxelize("cells.npy", *options, mesh=mesh)
        size, cells = volumes.read_npy(self.path("cells.npy"))
        self.assertEqual(list(size), found["grid"]["size"])
        self.assertEqual(found["occupied"], len(cells))
        return found["grid"], cells


class Answers(Voxelize):
    def check(self, *options):
        grid, cells = self.cells(*options)
        self.assertEqual(cells, volumes.occupied(self.triangles, grid))
        self.assertTrue(cells)
        return grid, cells

    def test_faces_on_planes(self):
        grid, _ = self.check("--cell", "0.5", "--origin=-2,-2,-2", "--size", "8,8,8")
        self.assertEqual(grid, {"origin": [-2, -2, -2], "cell": [0.5] * 3, "size": [8, 8, 8]})

    def test_other_grids(self):
        self.check("--resolution", "7")
        self.check("--cell", "0.4,0.7,1.1")
        self.check("--cell=0.3", "--origin", "-0.7,-1.1,0.2", "--size", "3,9,4")
        self.check("--cell", "0.05,1,1", "--origin", "-2,-2,-2")
        self.check("--resolution", "5", "--origin", "-5,-3,-2.5")
        self.check("--cell", "1e-3,4,4", "--origin", "-0.1,-2,-2", "--size", "200,1,1")

    def test_every_kernel_and_thread_count(self):
        self.voxelize("one.raw", "--resolution", "70", "--threads", "1")
        expected = volumes.read(self.path("one.raw"))
        for threads in range(2, 9):
            self.assertEqual(self.voxelize("more.raw", "--resolution", "70", "--threads", str(threads))["threads"], threads)
            self.assertEqual(volumes.read(self.path("more.raw")), expected, threads)
        for kernel in json.loads(self.succeed("info", "--json"))["kernels"]:
            self.assertEqual(self.voxelize("more.raw", "--resolution", "70", "--kernel", kernel)["kernel"], kernel)
            self.assertEqual(volumes.read(self.path("more.raw")), expected, kernel)

    def test_more_threads_than_layers(self):
        grid, cells = self.cells("--cell", "0.1,0.1,2.5", "--threads", "200")
        self.assertEqual((grid["size"][2], cells), (2, self.cells("--cell", "0.1,0.1,2.5", "--threads", "1")[1]))

    def test_many_triangles(self):
        """More of them than are handed to the library at a time: the cells of all are those of the halves together."""
        step = 1 / 64
        triangles = [((x, y, (x * 7 + y * 5) % 32 * step), (x + step, y, 0), (x, y + step, step)) for x, y in
                     ((n % 400 * step, n // 400 * step) for n in range(140000))]
        grid = ("--cell", "0.25", "--origin", "0,0,0", "--size", "30,30,3")
        found = []
        for part in (triangles, triangles[:70000], triangles[70000:]):
            found.append(self.cells(*grid, "--threads", "3", mesh=self.write("many.ply", meshes.ply_binary(part)))[1])
        self.assertEqual(found[0], found[1] | found[2])
        self.assertTrue(found[1] - found[2] and found[2] - found[1])

    def test_accuracy(self):
        exact = self.cells("--resolution", "20")[1]
        self.assertLessEqual(exact, self.cells("--resolution", "20", "--accuracy", "conservative")[1])
        found = self.voxelize("fast.npy", "--resolution", "20", "--accuracy", "fast")
        self.assertEqual((found["accuracy"], found["undecided"]), ("fast", 0))

    def test_axes(self):
        grid, cells = self.cells("--cell", "0.5", "--origin=-2,-2,-2", "--axes", "box")
        boxes = set()
        bounds = [volumes.planes(grid, a) for a in range(3)]
        for t in self.triangles:
            near = [[n for n in range(grid["size"][a]) if bounds[a][n] <= max(v[a] for v in t)
                     and bounds[a][n + 1] >= min(v[a] for v in t)] for a in range(3)]
            boxes.update((i, j, k) for i in near[0] for j in near[1] for k in near[2])
        self.assertEqual(cells, boxes)
        everything = self.cells("--cell", "0.5", "--origin=-2,-2,-2")[1]
        for axes in ("plane", "box,edges"):
            self.assertLessEqual(everything, self.cells("--cell", "0.5", "--origin=-2,-2,-2", "--axes", axes)[1])


class Grids(Voxelize):
    def test_resolution_holds_the_mesh(self):
        for seed in range(5):
            triangles = [tuple(tuple(volumes.float_of(x * 0.1 + 7 / 3) for x in v) for v in t)
                         for t in meshes.lattice_triangles(9, seed)]
            mesh = self.write("other.ply", meshes.ply_binary(triangles))
            for n in (1, 2, 3, 10, 333):
                grid = self.voxelize("o.raw", "--resolution", str(n), mesh=mesh)["grid"]
                lo = [min(v[a] for t in triangles for v in t) for a in range(3)]
                hi = [max(v[a] for t in triangles for v in t) for a in range(3)]
                longest = max(range(3), key=lambda a: hi[a] - lo[a])
                self.assertEqual((grid["size"][longest], grid["origin"]), (n, lo))
                self.assertEqual(len(set(grid["cell"])), 1)
                for a in range(3):
                    bounds = volumes.planes(grid, a)
                    self.assertGreaterEqual(bounds[-1], hi[a])
                    self.assertTrue(bounds[-2] < hi[a] or len(bounds) == 2)

    def test_flat_and_small_meshes(self):
        flat = self.write("flat.obj", meshes.obj([((0, 0, 2), (4, 0, 2), (0, 4, 2))]))
        grid, cells = self.cells("--resolution", "4", mesh=flat)
        self.assertEqual((grid["size"], len(cells)), ([4, 4, 1], 13))
        point = self.write("point.obj", meshes.obj([((1, 2, 3),) * 3]))
        self.fail_with(1, "point.obj: the whole mesh lies in one point and has no longest side; give --cell in place of --resolution",
                       "voxelize", point, "--resolution", "4", "-o", self.path("x.npy"))
        self.assertEqual(self.cells("--cell", "1", mesh=point), ({"origin": [1, 2, 3], "cell": [1] * 3, "size": [1] * 3}, {(0, 0, 0)}))

    def test_not_finite(self):
        nan = float("nan")
        mesh = self.write("nan.ply", meshes.ply_binary([((nan, 0, 0), (9, 0, 0), (0, 9, 0)), ((0, 0, 0), (1, 0, 0), (0, 1, 0))]))
        text = self.succeed_with_note("1 of 2 triangles have NaN", "voxelize", mesh, "--resolution", "2", "--json",
                                      "-o", self.path("nan.npy"))
        self.assertEqual(json.loads(text)["grid"]["size"], [2, 2, 1])
        mesh = self.write("all.ply", meshes.ply_binary([((nan, 0, 0), (9, 0, 0), (0, 9, 0))]))
        result = support.run("voxelize", mesh, "--resolution", "2", "-o", self.path("all.npy"))
        self.assertEqual(result.code, 1)
        self.assertIn("none of its triangles has finite coordinates", result.stderr)

    def refuse(self, pattern, *options):
        self.fail_with(1, pattern, "voxelize", self.mesh, *options, "-o", self.path("refused.npy"))
        self.assertEqual(os.listdir(self.folder), ["mesh.ply"])

    def test_refused_grids(self):
        self.refuse("a grid of .* cells takes .*, a bit per cell; the most is 16.0 GiB: choose fewer cells",
                    "--resolution", "2000000000")
        self.refuse("the grid has more than 2147483648 cells along the x axis; choose larger cells", "--cell", "1e-30")
        finer = "finer than double on the %s axis: near %s it cannot tell cells of %s apart; choose cells of %s or more, or move"
        for axis, origin, cell, size, words in (
                ("x", "1e18,0,0", "1", "2,2,2", ("1e\\+18", "1", "128")), ("y", "0,-1e18,0", "1", "2,2,2", ("-1e\\+18", "1", "128")),
                ("z", "0,0,5108010", "1,1,1e-10", "2,2,9", ("5108010.000000001", "1e-10", "9.313225746154785e-10")),
                ("y", "0,9007199254740992,0", "1", "9,9,9", (r"9.007199254741e\+15", "1", "2"))):
            grid = ("--origin=" + origin, "--size", size)
            self.refuse(finer % (axis, *words), "--cell", cell, *grid)
            self.succeed("voxelize", self.mesh, "--cell", words[2], "--quiet", "-o", self.path("served.raw"), *grid)
            os.remove(self.path("served.raw"))
        self.refuse("reaches beyond what double holds on the y axis", "--cell", "1,1e308,1", "--origin", "0,0,0", "--size", "2,9,2")
        self.refuse("the mesh ends at x = [0-9.]+, before the grid starts at 100; move --origin, or give --size",
                    "--cell", "1", "--origin", "100,0,0")


class Files(Voxelize):
    def check_all(self, *options):
        """All formats hold the same cells, those of the .npy."""
        grid, expected = self.cells(*options)
        size = tuple(grid["size"])
        for ending in ENDINGS:
            self.assertEqual(self.voxelize("same." + ending, *options)["output"], self.path("same." + ending))
        self.assertEqual(volumes.read_npy(self.path("same.npy")), (size, expected))
        self.assertEqual(volumes.read_raw(self.path("same.raw"), size), (size, expected))
        self.assertEqual(volumes.read_vox(self.path("same.vox")), (size, expected))
        side, cells, translate, scale = volumes.read_binvox(self.path("same.binvox"))
        self.assertEqual((side, cells), ((volumes.side_of(size),) * 3, expected))
        for a in range(3):
            self.assertTrue(volumes.is_close(translate[a], grid["origin"][a]) or translate[a] == grid["origin"][a])
        self.assertTrue(volumes.is_close(scale, grid["cell"][0] * side[0]))

    def test_formats_agree(self):
        self.check_all("--resolution", "12")
        self.check_all("--cell", "0.1", "--size", "70,5,9")
        self.check_all("--cell", "0.1", "--size", "5,70,9")
        self.check_all("--cell", "0.1", "--size", "64,3,40")
        self.check_all("--cell", "5", "--size", "1,1,1")
        self.check_all("--cell", "1", "--origin", "50,50,50", "--size", "3,4,5")  # nothing in it

    def test_vox_of_the_largest_size(self):
        for size in ((256, 4, 4), (3, 256, 4), (4, 4, 256)):
            options = ("--cell", "%.9g,%.9g,%.9g" % tuple(4 / n for n in size), "--origin=-2,-2,-2", "--size", "%d,%d,%d" % size)
            _, expected = self.cells(*options)
            self.voxelize("large.vox", *options)
            self.assertEqual(volumes.read_vox(self.path("large.vox")), (size, expected), size)
            self.assertTrue(expected)

    def test_vox_ends_at_256(self):
        for size in ("257,1,1", "1,257,1", "1,1,1000"):
            self.fail_with(1, r"no.vox: .vox holds at most 256 cells on each axis, the grid has %s; choose fewer cells, or write .npy, "
                           ".binvox or .raw" % size.replace(",", " x "), "voxelize", self.mesh, "--cell", "1", "--size", size, "-o",
                           self.path("no.vox"))
        self.assertFalse(os.path.exists(self.path("no.vox")))

    def test_numpy_reads(self):
        python = volumes.python_with_numpy()
        if not python:
            self.skipTest("no NumPy")
        self.voxelize("numpy.npy", "--resolution", "9")
        size, cells = volumes.read_npy(self.path("numpy.npy"))
        script = "import json, numpy, sys; a = numpy.load(sys.argv[1]); k, j, i = numpy.nonzero(a); " \
                 "print(json.dumps([str(a.dtype), a.shape, list(zip(i.tolist(), j.tolist(), k.tolist()))]))"
        kind, shape, found = json.loads(subprocess.check_output([python, "-c", script, self.path("numpy.npy")]))
        self.assertEqual((kind, tuple(shape[::-1]), {tuple(cell) for cell in found}), ("bool", size, cells))

    def test_binvox_wants_cubes(self):
        self.fail_with(1, "binvox takes cubic cells only, these are 1 x 1 x 2; give --cell one length, or choose .npy",
                       "voxelize", self.mesh, "--cell", "1,1,2", "-o", self.path("no.binvox"))

    def test_summary(self):
        text = self.succeed("voxelize", self.mesh, "--cell", "0.5", "--origin=-2,-2,-2", "--size", "8,8,8", "--threads", "1",
                            "-o", self.path("s.npy"))
        fields = dict(re.split(r"  +", line, maxsplit=1) for line in text.splitlines())
        cells = len(volumes.read_npy(self.path("s.npy"))[1])
        self.assertEqual(fields["mesh"], self.mesh)
        self.assertEqual(fields["triangles"], "24")
        self.assertEqual(fields["grid"], "8 x 8 x 8 cells of 0.5, from -2,-2,-2")
        self.assertEqual(fields["occupied"], "%d cells (%.4g %%)" % (cells, 100 * cells / 512))
        self.assertRegex(fields["test"], r"^exact, axes box,plane,edges, kernel \w+, 1 thread$")
        self.assertRegex(fields["time"], r"^[\d.]+ ms \(the voxelization alone\)$")
        self.assertNotIn("preview", fields)
        many = self.succeed("voxelize", self.mesh, "--cell", "0.05,0.05,0.1", "--origin", "0,0,0", "-o", self.path("m.npy"))
        self.assertRegex(many, r"\ngrid +\d+ x \d+ x \d+ cells of 0.05 x 0.05 x 0.1, from 0,0,0\n")
        self.assertRegex(many, r"\ntime         [\d.]+ m?s, [\d.]+ (thousand|million|billion) cells a second \(the voxelization alone\)\n")
        self.assertEqual(fields["written"], self.path("s.npy"))

    def test_json(self):
        found = self.voxelize("j.npy", "--cell", "0.5", "--axes", "box,plane")
        self.assertEqual(found["axes"], ["box", "plane"])
        self.assertEqual((found["mesh"], found["triangles"], found["not_finite"]), (self.mesh, 24, 0))
        self.assertNotIn("tile", found)
        self.assertGreater(found["seconds"], 0)
        self.assertNotIn("shard", found)

    def test_quiet(self):
        self.assertEqual(self.succeed("voxelize", self.mesh, "--cell", "1", "--quiet", "-o", self.path("q.npy")), "")


if __name__ == "__main__":
    support.main()
