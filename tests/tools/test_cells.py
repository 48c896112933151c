"""tribox voxelize: the cells of every grid, in every format, by every way: whole, threads, pipes, tiles, partitions, shards."""

import itertools
import os
import re
import subprocess

import harness
import numpy as np
import readers
import triangles as meshes
from harness import Voxels, grid_of, read, text_of

LATTICE = meshes.lattice_triangles(24, seed=5)
# Triangles of floats, three cells long or so, where floats are 1/16 apart, whose planes float would move.
HIGH = meshes.floats(np.random.default_rng(31).uniform(-2, 2, (25, 3, 3)) +
                     np.random.default_rng(32).uniform(0, 12, (25, 1, 3)) + [1e6, -7e5, 6e5])
FAR = meshes.far_triangles(7, seed=12)
SMALL = np.array(meshes.lattice_triangles(4, seed=3)) * 2.0 ** -20
SHIFTED = ("--shift", "557818.3,5108000,0.7")
OTHERS = ("cells", "ply", "obj", "glb")  # below, and in test_shells


# Sizes around 8 and 64, more than 4096 in a row, one cell, none that is set, cells of three lengths, planes in faces, ends of .vox.
GRIDS = [
    (LATTICE, grid_of("9", "-3,-3,-3", "1,1,1")), (LATTICE, ("--resolution", "7")), (LATTICE, grid_of("0.5", "-2,-2,-2", "8,8,8")),
    (LATTICE, grid_of("0.3,0.5,0.25", "-2,-2.1,-2", "13,9,17")), (LATTICE, grid_of("0.06,0.7,0.9", "-2,-2,-2", "70,7,5")),
    (LATTICE, grid_of("0.03,0.5,0.5", "-2,-2,-2", "128,8,9")), (LATTICE, grid_of("0.001,4,4", "-2,-2,-2", "4101,1,1")),
    (LATTICE, grid_of("0.5", "50,50,50", "10,11,12")), (LATTICE, grid_of("0.30000000001", "-2,-2,-2", "12,13,14")),
    (LATTICE, ("--cell", "0.4,0.7,1.1")), (LATTICE, grid_of("0.3", "-0.7,-1.1,0.2", "3,9,4")),
    (LATTICE, ("--resolution", "5", "--origin", "-5,-3,-2.5")),
    (LATTICE, grid_of("0.1", "-2,-2,-2", "5,70,9")), *((LATTICE,
                                                        grid_of(text_of(4 / n for n in size), "-2,-2,-2", "%d,%d,%d" % size))
                                                      for size in ((256, 4, 4), (3, 256, 4), (4, 4, 256))),
    (HIGH, ("--resolution", "13")), (HIGH, ("--cell", "1.1")), (HIGH, grid_of("0.7", "1000001.3,-699998.7,600001.1", "11,12,13")),
    (FAR, ("--resolution", "7")), (FAR, ("--cell", "0.7")),
    (FAR, ("--cell", "0.3,0.9,1.7", "--origin", "557818.1,5108008.3,810.5")),
    (FAR, grid_of("0.4", "557819.9,5108010,812", "4,3,2")), (FAR, ("--cell", "0.9", *SHIFTED)),
    (LATTICE, ("--shift", "0.5,-1,2", "--resolution", "11")),
]


class Answers(Voxels):
    def check(self, ending, options, triangles, truth, grid, shift):
        """The cells, where the file says that they are, and what the summary says."""
        mesh, size = self.mesh_of(triangles), grid["size"]
        has_place = ending.rpartition(".")[2] in ("npz", "vdb", "vti", "nrrd", "binvox")
        path, found = self.voxelize(mesh, *options, ending=ending,
                                    note=".* does not hold that its cells are shifted by" if any(shift) and not has_place else None)
        cells, stated = readers.read(path, size)
        self.assertTrue(np.array_equal(cells != 0, truth), (ending, options))
        self.assertEqual((found["occupied"], found["output"], found["grid"], found["triangles"], found["not_finite"]),
                         (int(truth.sum()), path, grid, len(triangles), 0))
        self.assertEqual(found["positions"], "float32" if mesh.endswith("f32") and shift[0] in (0, 0.5) else "float64")
        self.assertTrue(0 < found["seconds"] < found["total_seconds"], found)
        own = np.zeros(3) if ending.endswith("npz") else shift  # which keeps it apart
        if "shift" in stated:
            self.assertEqual(stated["shift"], list(shift))
        for key, due in (("origin", np.array(grid["origin"]) + own), ("cell", np.array(grid["cell"]))):
            if key in stated:
                slack = 1e-15 * (abs(due) + max(grid["cell"])) if not ending.endswith("binvox") else 2e-7 * abs(due)
                slack = 0 if ending.endswith("npz") else slack
                self.assertTrue((abs(np.array(stated[key]) - due) <= slack).all(), (ending, key, stated[key], due))

    def test_empty(self):
        """What is cut where nothing overlaps has no cells, in a grid that is given; there is none around it."""
        grid = grid_of("1", "0,0,0", "3,4,5")
        for name, data in (("mesh.ply", meshes.ply_of(LATTICE)), ("text.ply", meshes.FORMATS["ascii.ply"](LATTICE)),
                           ("mesh.off", meshes.off(LATTICE)), ("mesh.stl", meshes.stl_binary(LATTICE)),
                           ("mesh.f32", meshes.pack_floats(LATTICE)), ("mesh.f64", meshes.pack_floats(LATTICE, "<f8"))):
            cut, box = self.path("cut" + name), ("--box", "80,80,80,90,90,90")
            self.succeed("overlap", self.write(name, data), *box, "-o", cut, note=".*: has no face")
            for command, *words in (("voxelize", "--cell", "1", "--size", "3,4,5", "--count"), ("overlap", *box), ("info",),
                                    ("overlap", "--boxes", "-"), ("partition", *grid, "-o", self.path("x.tiles"))):
                self.fail_with(1, ".*: contains no triangles", command, cut, *words)
            for ending, options in itertools.product((".npy", ".npz"), ((), ("--fill", "outside"), ("--shift", "auto"))):
                for mesh, stdin in (((cut,), b""), (("-", "--format", name[-3:]), read(cut))):
                    path, found = self.voxelize(*mesh, *grid, *options, ending=ending, stdin=stdin)
                    self.assertEqual((found["triangles"], found["occupied"], found["ns_per_triangle"]), (0, 0, None))
                    self.assertFalse(readers.read(path, (3, 4, 5))[0].any())

    def test_grids(self):
        """Every format, against separating axes in whole numbers."""
        for triangles, options in GRIDS:
            shift = [float(x) for x in options[options.index("--shift") + 1].split(",")] if "--shift" in options else [0.0] * 3
            moved = np.array(triangles) - shift
            grid = self.ask("voxelize", self.mesh_of(triangles), *options, "--count")["grid"]
            truth = meshes.occupied(moved, grid)
            self.assertTrue(truth.any() or "50,50,50" in str(options))
            for word in harness.formats():
                if (word in OTHERS or word in ("vox", "binvox") and max(grid["size"]) > 256
                        or word == "binvox" and len(set(grid["cell"])) > 1):
                    continue
                more = ("--vdb-grid", "mask") if word == "vdb" else ()
                self.check("." + word, (*options, *more), triangles, truth, grid, shift)
            self.check(".npz", (*options, "--deflate"), triangles, truth, grid, shift)
            self.check(".npy", (*options, "--out-format", "cells"), triangles, truth, grid, shift)

    def test_stated_grids(self):
        """The grid that was asked for; by --resolution one that holds the mesh as narrowly as it can."""
        grid = self.ask("voxelize", self.mesh_of(LATTICE), *GRIDS[2][1], "--count")["grid"]
        self.assertEqual(grid, {"origin": [-2, -2, -2], "cell": [0.5] * 3, "size": [8, 8, 8]})
        for seed, n in itertools.product(range(4), (1, 2, 3, 10, 333)):
            t = meshes.floats(np.array(meshes.lattice_triangles(9, seed)) * 0.1 + 7 / 3)
            grid, lo, hi = self.ask("voxelize", self.mesh_of(t), "-r", str(n), "--count")["grid"], t.min((0, 1)), t.max((0, 1))
            self.assertEqual((grid["size"][int(np.argmax(hi - lo))], grid["origin"], len(set(grid["cell"]))), (n, lo.tolist(), 1))
            for a in range(3):
                bounds = meshes.planes(grid, a)
                self.assertTrue(bounds[-1] >= hi[a] and (bounds[-2] < hi[a] or len(bounds) == 2))
        flat = self.write("flat.obj", "v 0 0 2\nv 4 0 2\nv 0 4 2\nf 1 2 3\n")
        found = self.ask("voxelize", flat, "-r", "4", "--count")
        self.assertEqual((found["grid"]["size"], found["occupied"]), ([4, 4, 1], 13))
        point = self.write("point.obj", "v 1 2 3\nf 1 1 1\n")
        self.assertEqual(self.ask("voxelize", point, "-c", "1", "--count")["grid"],
                         {"origin": [1, 2, 3], "cell": [1] * 3, "size": [1] * 3})
        self.fail_with(1, "point.obj: the whole mesh lies in one point and has no longest side; "
                       "give --cell in place of --resolution", "voxelize", point,
                       "-r", "4", "--count")

    def test_not_finite(self):
        nan = ((meshes.NAN, 0, 0), (9, 0, 0), (0, 9, 0))
        mesh = self.write("nan.f32", meshes.pack_floats([nan, ((0, 0, 0), (1, 0, 0), (0, 1, 0))]))
        self.assertEqual(self.ask("voxelize", mesh, "-r", "2", "--count", note="1 of 2 triangles have NaN")["grid"]["size"],
                         [2, 2, 1])
        result = harness.run("voxelize", self.write("all.f32", meshes.pack_floats([nan])), "-r", "2", "--count")
        self.assertEqual(result.code, 1)
        self.assertIn("none of its triangles has finite coordinates", result.stderr)

    def test_refused_grids(self):
        finer = "finer than double on the %s axis: near %s it cannot tell cells of %s apart; choose cells of %s or more, or move"
        mesh = self.mesh_of(LATTICE)
        rows = [("a grid of .* cells takes .*, a bit per cell; the most is 16.0 GiB: choose fewer cells", "-r", "262144"),
                ("the grid has more than 2147483648 cells along the x axis; choose larger cells", "--cell", "1e-30"),
                ("reaches beyond what double holds on the y axis", *grid_of("1,1e308,1", "0,0,0", "2,9,2")),
                ("the mesh ends at x = [0-9.]+, before the grid starts at 100; move --origin, or give --size", "-c", "1",
                 "--origin", "100,0,0")]
        for axis, origin, cell, size, words in (
                ("x", "1e18,0,0", "1", "2,2,2", ("1e\\+18", "1", "128")),
            ("y", "0,-1e18,0", "1", "2,2,2", ("-1e\\+18", "1", "128")),
                ("z", "0,0,5108010", "1,1,1e-10", "2,2,9", ("5108010.000000001", "1e-10", "9.313225746154785e-10")),
                ("y", "0,9007199254740992,0", "1", "9,9,9", (r"9.007199254741e\+15", "1", "2"))):
            rows.append((finer % (axis, *words), *grid_of(cell, origin, size)))
            self.out("voxelize", mesh, *grid_of(words[2], origin, size), ending=".raw")
        os.remove(self.path("out.raw"))
        for size in ("257,1,1", "1,257,1", "1,1,1000"):
            self.fail_with(1, r"no.vox: .vox holds at most 256 cells on each axis, the grid has %s; "
                           r"choose fewer cells, or write .npy, .binvox or .raw"
                           % size.replace(",", " x "), "voxelize", mesh, "-c", "1", "--size", size, "-o", self.path("no.vox"))
        self.refuse(1, "voxelize", [(row[0], mesh, *row[1:], "-o", self.path("x.npy")) for row in rows] + [
            ("binvox takes cubic cells only, these are 1 x 1 x 2; give --cell one length, or choose .npy", mesh, "-c", "1,1,2",
             "-o", self.path("x.binvox")),
            ("binvox fills a grid up to a cube, here of 3000000.3 cells, and 2097152.3 are the most", mesh,
             *grid_of("1", "0,0,0", "1,3000000,1"),
             "-o", self.path("long.binvox"))])
        huge = (mesh, *grid_of("0.0001", "-2,-2,-2", "16384,16384,16384"))
        most = "the most is 16.0 GiB: choose fewer cells, or "
        self.refuse(1, "voxelize", [
            (r"a grid of 16384 x 16384 x 16384 cells takes 512 GiB, a bit per cell; %swrite bricks, -o FILE.npz or .vdb" % most,
             *huge, "-o", "x.raw"),
            (".*" + most + "write bricks, -o FILE.npz or .vdb", *huge, "--fill", "outside", "-o", "x.raw"),
            (".*choose fewer cells, or leave out --thin", mesh,
                                                                                                   "-r", "60000", "--thin", "-o",
             "x.npz"),
            (".*" + most + "leave out the picture", *huge, "-o", "x.npz", "-p", "x.png")][:4 if not harness.lacks("libpng") else 3])

    def test_other_tests(self):
        """Fewer axes find what they find, conservative misses nothing, and fast says what it left undecided."""
        mesh, options = self.mesh_of(LATTICE), GRIDS[2][1]
        exact = meshes.occupied(LATTICE, {"origin": [-2] * 3, "cell": [0.5] * 3, "size": [8] * 3})
        bounds, boxes = meshes.planes({"origin": [-2], "cell": [0.5], "size": [8]}, 0), np.zeros((8, 8, 8), bool)
        for t in np.array(LATTICE):
            near = [(bounds[:-1] <= t[:, a].max()) & (bounds[1:] >= t[:, a].min()) for a in range(3)]
            boxes |= near[2][:, None, None] & near[1][:, None] & near[0]
        for way in (("--axes", "box"), ("--axes", "plane"), ("--axes", "box,edges"), ("--accuracy", "conservative"),
                    ("--accuracy", "fast")):
            path, found = self.voxelize(mesh, *options, *way)
            cells = readers.read(path)[0] != 0
            self.assertEqual(found[way[0][2:]], way[1].split(",") if way[0] == "--axes" else way[1])
            more = way[0] != "--axes" or (cells > exact).any()
            holds = np.array_equal(cells, boxes) if way[1] == "box" else way[1] == "fast" or (cells >= exact).all() and more
            self.assertTrue(holds, way)
        self.assertEqual(found["undecided"], 0)

    def test_summary(self):
        mesh = self.mesh_of(LATTICE)
        cells = int(meshes.occupied(LATTICE, {"origin": [-2] * 3, "cell": [0.5] * 3, "size": [8] * 3}).sum())
        for ending, has_place in ((".npy", False), (".raw", False), (".vti", True), (".npz", True)):
            out = self.path("s" + ending)
            text = self.succeed("voxelize", mesh, *GRIDS[2][1], "-t", "1", "-o", out)
            fields = dict(re.split(r"  +", line, maxsplit=1) for line in text.splitlines())
            self.assertEqual([fields[key] for key in ("mesh", "triangles", "grid", "occupied", "written")], [
                mesh, "24", "8 x 8 x 8 cells of 0.5, from -2,-2,-2", "%d cells (%.4g %%)" % (cells, 100 * cells / 512), out])
            self.assertRegex(fields["test"], r"^exact, axes box,plane,edges, kernel \w+, 1 thread$")
            self.assertRegex(fields["time"], r"^[\d.]+ ms \(the voxelization alone\)$")
            self.assertEqual(fields.get("place"), None if has_place else "not in the file: keep origin and cell, which --json "
                             "prints with all digits")
            self.assertNotIn("undecided", fields)
        thirds = ("voxelize", mesh, "-c", "0.333333333333", "--origin=-2.0123456789,-3,-2", "--count")
        self.assertRegex(self.succeed(*thirds), r"\ngrid .* of 0.333333, from -2.01235,-3,-2\n")
        self.assertEqual(self.ask(*thirds)["grid"]["origin"], [-2.0123456789, -3, -2])
        many = self.succeed("voxelize", mesh, "--cell", "0.05,0.05,0.1", "--origin", "0,0,0", "-o", self.path("m.npy"))
        self.assertRegex(many, r"\ngrid +\d+ x \d+ x \d+ cells of 0.05 x 0.05 x 0.1, from 0,0,0\n")
        self.assertRegex(many, r"\ntime         [\d.]+ m?s, [\d.]+ (thousand|million|billion) cells a second "
                               r"\(the voxelization alone\)\n")
        self.assertRegex(self.succeed("voxelize", mesh, *GRIDS[2][1], *SHIFTED, "--count"), r"(?m)^shift +557818.3,5108000,0.7$")
        for options, tiles in ((), ""), (("--accuracy", "fast"), ", tiles of 128"):
            self.assertRegex(self.succeed("voxelize", mesh, *TILES, "--count", *options),
                             r"(?m)^occupied     \d+ cells \(.*\)\nbricks       \d+ of 8 x 8 x 8 cells%s\n" % tiles)
        self.assertIn("\nids          the lowest triangle of each cell\n",
                      self.succeed("voxelize", mesh, "-r", "9", "--ids", "-o", self.path("x.npz")))


class Foreign(Voxels):
    """The programs that the files are for read them as our readers do."""

    def files(self, word, *options):
        for triangles, grid in GRIDS[:9] + [GRIDS[-1]]:
            path, found = self.voxelize(self.mesh_of(triangles), *grid, *options, ending="." + word)
            truth = meshes.occupied(np.array(triangles) - found.get("shift", [0] * 3), found["grid"])
            yield (path, truth, np.array(found["grid"]["origin"]) + found.get("shift", [0] * 3),
                   np.array(found["grid"]["cell"]), found)

    def assert_near(self, own, due, cell):
        self.assertTrue((abs(np.array(own) - due) <= 1e-15 * (abs(due) + cell)).all(), (own, due))

    def test_paraview(self):
        vtk, image = self.module("vtkmodules.vtkIOXML"), self.module("vtkmodules.util.numpy_support")
        for path, truth, origin, cell, found in self.files("vti"):
            reader = vtk.vtkXMLImageDataReader()
            reader.SetFileName(path)
            reader.Update()
            data = reader.GetOutput()
            values = image.vtk_to_numpy(data.GetCellData().GetScalars()).reshape(truth.shape)
            self.assertEqual((reader.GetErrorCode(), data.GetCellData().GetScalars().GetName()), (0, "occupied"))
            self.assertTrue(np.array_equal(values, truth))
            self.assert_near(data.GetOrigin(), origin, cell)
            self.assert_near(data.GetSpacing(), cell, cell)

    def test_slicer(self):
        for path, truth, origin, cell, found in self.files("nrrd"):
            try:
                values = subprocess.run(["teem-unu", "data", path], capture_output=True, check=True).stdout
                head = subprocess.run(["teem-unu", "head", path], capture_output=True, check=True, text=True).stdout
            except FileNotFoundError as error:
                self.skipTest(error)
            self.assertTrue(np.array_equal(np.frombuffer(values, "u1").reshape(truth.shape), truth))
            self.assert_near([float(x) for x in re.search(r"space origin: \((.*)\)", head)[1].split(",")], origin + cell / 2, cell)

    def test_openvdb(self):
        """By default a file that OpenVDB's own Python module reads; of masks its program says how many there are."""
        self.need("OpenVDB")
        openvdb = self.module("pyopenvdb")
        for path, truth, origin, cell, found in self.files("vdb"):
            (grid,), _ = openvdb.readAll(path)
            items = [item for item in grid.citerOnValues() if item.min == item.max]
            cells = np.zeros(truth.shape, bool)
            for item in items:
                cells[item.min[::-1]] = item.value
            self.assertTrue(np.array_equal(cells, truth))
            self.assertEqual((len(items), grid.activeVoxelCount(), list(grid["size"]), list(grid["shift"])),
                             (truth.sum(), truth.sum(), found["grid"]["size"],
                                                                                                     found.get("shift", [0, 0, 0])))
            for own, due in ((grid.transform.voxelSize(), cell), (grid.transform.indexToWorld((0, 0, 0)), origin + cell / 2),
                             (grid["cell"], cell)):
                self.assert_near(own, due, cell + abs(origin))
        path, found = self.voxelize(self.mesh_of(LATTICE), "-r", "30", "--vdb-grid", "mask", ending=".vdb")
        with self.subTest("vdb_print"):
            try:
                text = subprocess.run(["vdb_print", "-l", path], capture_output=True, text=True, check=True).stdout
            except FileNotFoundError as error:
                self.skipTest(error)
            self.assertIn("Type: Tree_mask_5_4_3", text)
            self.assertEqual(int(re.search(r"active voxels: +([\d,]+)", text)[1].replace(",", "")), found["occupied"])

    def test_openvdb_and_small_cells(self):
        """It takes no volume below 3e-15, so that lengths are multiplied."""
        self.need("OpenVDB")
        small, openvdb = self.mesh_of(SMALL, "small"), self.module("pyopenvdb")
        self.succeed("voxelize", small, "-r", "40", "-q", "-o", self.path("small.vdb"),
                     note="note: .*small.vdb has lengths of the mesh times 1000, as OpenVDB takes no cells as small as these$")
        (grid,), _ = openvdb.readAll(self.path("small.vdb"))
        self.assertTrue(np.allclose(grid.transform.indexToWorld((0, 0, 0)),
                                    1000 * (np.array(grid["origin"]) + np.array(grid["cell"]) / 2), rtol=1e-6, atol=0))
        self.assertTrue(np.allclose(grid.transform.voxelSize(), 1000 * np.array(grid["cell"]), rtol=1e-6, atol=0))
        self.fail_with(1, "are too small for .vdb; write .npz", "voxelize", small, *grid_of("1e-30", "0,0,0", "4,4,4"), "-o",
                       self.path("x.vdb"))


# Of each scene: triangles, a grid of some tiles, options, and the endings of the files.
MANY = np.array(meshes.lattice_triangles(60, seed=9)) * 0.999
SHELL = (meshes.cube((-1.7, -0.3, -1.45), (1.7, 1.91, 1.4)) + meshes.cube((-1.2, -0.1, -1.1), (1.15, 1.5, 1.2)) +
         meshes.cube((-0.5, 0.1, -0.7), (0.2, 0.8, 0.8)))
TILES = grid_of("0.0137,0.031,0.0158", "-2,-2,-2", "300,130,257")  # 3 x 2 x 3 of 128
CUT = grid_of("0.016,0.0156,0.027", "-1.6,-0.5,-1.55", "150,131,41")
HELD = grid_of("0.03,0.0213,0.18", "-2,-0.7,-1.7", "140,131,19")
NEVER = np.array([[[meshes.NAN] * 3] * 3] * 3)
SCENES = {
    "floats": (meshes.floats(MANY), TILES, (), ("npz", "raw")),
    "surfaces": (LATTICE, grid_of("0.03125,0.0625,0.125", "-2,-2,-2", "129,65,33"), (), ("ply", "obj", "glb")),
    "doubles": (MANY, TILES, (), ("npz", "raw")),
    "few": (LATTICE, ("-r", "150"), (), ("npz", "binvox", "vox", "npy", "vti", "nrrd", "cells")),
    "small": (LATTICE[:1], ("-r", "9"), (), ("npz", "vox")),
    "box": (LATTICE, TILES, ("--axes", "box"), ("npz",)),
    "no box": (LATTICE, grid_of("0.02,0.5,0.5", "-2,-2,-2", "200,8,8"), ("--axes", "plane,edges"), ("npz",)),
    "conservative": (LATTICE, TILES, ("--accuracy", "conservative"), ("npz", "raw")),
    "fast": (LATTICE, TILES, ("--accuracy", "fast"), ("npz",)),
    # A triangle whose rounded cells reach into a tile that it does not touch itself.
    **{"long " + word: ([((float.fromhex("0x1.fffffep-38"), float.fromhex("0x1.000002p+8"), .5),
                          (float.fromhex("0x1.fffffcp+7"), 0, .5), (1, 1, .5))],
                        grid_of("1", "0,0,0", "384,384,8"), ("--accuracy", word), ("npz",)) for word in ("conservative", "fast")},
    "scalar": (LATTICE, TILES, ("--kernel", "scalar"), ("npz",)),
    "nothing": (LATTICE, grid_of("1", "100,100,100", "200,200,200"), (), ("npz", "raw", "ply")),
    "padded": (SHELL, grid_of("0.03", "-2,-0.7,-1.7", "70,131,90"), ("--fill", "parity"), ("npz", "binvox")),
    "shifted": (LATTICE, ("--shift", "1000,-5,0.1", "-r", "200"), (), ("npz", "binvox")),
    "auto": (FAR, ("--shift", "auto", "-r", "200"), (), ("npz",)),
    "ids": (np.concatenate([MANY, NEVER, MANY[::-7]]), grid_of("0.03,0.06,0.03", "-2,-2,-2", "131,66,130"), ("--ids",),
            ("npz", "npy", "raw", "nrrd", "vti")),
    "deflated": (LATTICE, TILES, ("--deflate",), ("npz",)), "deflated ids": (LATTICE, TILES, ("--ids", "--deflate"), ("npz",)),
    **{"%s %s %s" % (fill, name, what): (np.array(SHELL) + offset, grid, ("--fill", fill, *((what,) if what else ())),
                                         ("npz", "raw", "vti"))
       for fill in ("outside", "parity", "middles") for name, grid, offset in (("held", HELD, 0), ("cut", CUT, 1 / 3e9))
       for what in ("", "--labels", "--inside-only") if fill != "middles" or not what},
    "thin": (SHELL, HELD, ("--thin",), ("npz", "raw")), "thin filled": (SHELL, HELD, ("--thin", "--fill", "outside"), ("npz",)),
}


class Ways(Voxels):
    """The bytes of one thread that has all cells at once are those of each other way."""

    def of_mesh(self, mesh, words, ending):
        for threads in ("2", "7"):
            yield "threads", self.out("voxelize", mesh, *words, "-t", threads, "--out-format", ending, **self.how)
        yield "pipe", harness.run("voxelize", "-", "--format", mesh[-3:], *words, "--out-format", ending, "-o", "-",
                                  stdin=read(mesh)).octets

    def parts(self, where, words, count=3):
        """The paths of all shards; each says which it is, and their tiles go on where those before them end."""
        paths, at = [self.path("%d.part.npz" % n) for n in range(1, count + 1)], 0
        for n, path in enumerate(paths, 1):
            found = self.ask("voxelize", *where, *words, "--shard", "%d/%d" % (n, count), "-t", str(n % 3 + 1), "-o", path,
                             **self.how)
            self.assertEqual([found[key] for key in ("shard", "shards", "first_tile")], [n, count, at])
            at += found["tiles"]
        return paths

    def check_merged(self, parts, options, wholes, what):
        """In another order."""
        more = [word for word in options if word == "--deflate"]
        for threads, (ending, whole) in enumerate(wholes.items(), 1):
            told = self.ask("merge", *parts[::-1], *more, "--out-format", ending, "-t", str(threads), "-o", self.path("m"))
            self.assertEqual(told["parts"], len(parts))
            self.assertTrue(read(self.path("m")) == whole, (what, "merged", ending, len(parts)))

    def partition(self, *words):
        self.number = getattr(self, "number", 0) + 1
        folder = self.path("tiles%d" % self.number)
        self.succeed("partition", *words, "-q", "-o", folder, **self.how)
        return folder

    def partitions(self, mesh, t, grid, options):
        """Of the mesh, of pieces sorted at once, of pieces apart, and of these joined: the same files, in any memory."""
        cut, ids = len(t) // 3, tuple(word for word in options if word == "--ids")
        whole = self.partition(mesh, *grid, *ids)
        folders, apart = [self.partition(mesh, *grid, *ids, "-m", "9000", "-t", "3")], []
        if cut and "--size" in grid:
            pieces = [self.mesh_of(part, "piece%d" % n) for n, part in enumerate((t[:cut], t[cut:]))]
            folders.append(self.partition(*pieces, *grid, *ids, "-m", "20K"))
            first = self.partition(pieces[1], *grid, *ids)
            self.how = {}
            apart = [self.partition(pieces[0], *grid, *ids), first]
            folders.append(self.partition(*apart, "-m", "5000"))
        for folder, name in itertools.product(folders, os.listdir(whole)):
            self.assertEqual(read(os.path.join(folder, name)), read(os.path.join(whole, name)), name)
        return [[whole]] + [apart] * bool(apart)

    def test_ways(self):
        for name, (t, grid, options, endings) in SCENES.items():
            t, mesh = np.array(t, float), self.mesh_of(t, "all")
            bad, is_filled, wholes, parts = (~np.isfinite(t)).any((1, 2)).sum(), bool({"--fill", "--thin"} & set(options)), {}, []
            self.how = {"note": "%d of [0-9]+ triangles have NaN" % bad} if bad else {}
            for ending in endings:
                words = [word for word in (*grid, *options) if word != "--deflate" or ending == "npz"]
                wholes[ending] = self.out("voxelize", mesh, *words, "-t", "1", "--out-format", ending, **self.how)
                for way, octets in self.of_mesh(mesh, words, ending):
                    self.assertTrue(octets == wholes[ending], (name, way, ending))
            for count in () if is_filled else (1, 3):
                parts = self.parts([mesh], (*grid, *options), count)
                self.check_merged(parts, options, wholes, name)
            octets = [read(part) for part in parts]
            if {"--thin", "--axes", "parity", "middles"} & set(options):
                continue
            for folders in self.partitions(mesh, t, grid, options):
                self.how = {}
                for ending, whole in wholes.items():
                    self.assertTrue(self.out("voxelize", *folders, *options, "-t", "2", "--out-format", ending) == whole,
                                    (name, folders, ending))
                if not is_filled:
                    self.assertEqual([read(part) for part in self.parts(folders, options)], octets)

    def test_counts(self):
        """--count says what the file would hold."""
        for name, (t, grid, options, _) in SCENES.items():
            if "--ids" in options or "--deflate" in options or "--labels" in options:
                continue
            mesh = self.mesh_of(t)
            _, found = self.voxelize(mesh, *grid, *options)
            for threads in "12":
                counted = self.ask("voxelize", mesh, *grid, *options, "--count", "-t", threads)
                for key in ("occupied", "bricks", "inside", "odd_rows", "undecided", "shift"):
                    if key != "undecided" or "fast" not in options:
                        self.assertEqual(counted.get(key), found.get(key), (name, key))
                self.assertNotIn("output", counted)
            if not {"--fill", "--thin"} & set(options):
                shards = [self.ask("voxelize", mesh, *grid, *options, "--count", "--shard", "%d/3" % n) for n in (1, 2, 3)]
                self.assertEqual([sum(shard[key] for shard in shards) for key in ("occupied", "bricks")],
                                 [found[key] for key in ("occupied", "bricks")])


if __name__ == "__main__":
    harness.main()
