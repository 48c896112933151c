"""Files of cells as the program writes them, whose planes are those that were asked about; and meshes as the program reads them."""

import copy
import dataclasses
import importlib.util
import json
import os
import pickle
import re
import resource
import subprocess
import sys
import tempfile
import unittest
from itertools import product
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import numpy as np
import tribox

import cases
from cases import meshes

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tools"))
import readers  # noqa: E402

NEEDS_PROGRAM = unittest.skipUnless("TRIBOX_PROGRAM" in os.environ, "built without the program")
HAS_OPENVDB = any(map(importlib.util.find_spec, ("openvdb", "pyopenvdb")))
GRIDS = {"tenths": ((-2.1, -1.5, 1e-6), (0.3, 1 / 3, 0.7), (13, 9, 11)), "one": ((-2, -2, -2), 4, (1, 1, 1)),
         "far": ((557820.1, 5108010, -1e9), (0.1, 1e-5, 2e9), (70, 3, 2)), "cubes": ((-2.1, 1, 1e6), 0.5, (9, 5, 4))}
ALONE = ".npz", ".npy", ".nrrd", ".vti"  # which take no program
FACES = ".ply", ".obj", ".glb"


class Files(cases.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder, self.count = folder.name, 0
        self.pick = np.random.default_rng(cases.seed())

    def voxels(self):
        for numbers in GRIDS.values():
            grid = tribox.Grid(*numbers)
            for share in (0, 0.3, 1):
                yield tribox.Voxels(self.pick.random(grid.size[::-1]) < share, grid)

    def saved(self, thing, ending):
        self.count += 1
        path = Path(self.folder, f"{self.count}{ending}")
        self.assertIsNone(thing.save(path))
        return path

    def told(self):
        """Also with ids, labels and colors, and which of these they have."""
        for voxels in self.voxels():
            yield "bits", voxels
        for voxels in list(self.voxels())[1::3]:
            some, count = self.pick.integers(0, 1 << 63, voxels.words.shape, np.uint64), voxels.sum()
            yield "ids", tribox.Voxels(voxels.words, voxels.grid)._with_ids(self.pick.integers(0, 1 << 31, count, np.uint32))
            yield "labels", tribox.Voxels(voxels.words, voxels.grid)._with_inside(voxels.words & some)
            palette = self.pick.integers(0, 256, (200, 3), np.uint8)
            yield "colors", voxels.with_colors(palette[self.pick.integers(0, 200, count)])

    def assert_alike(self, one, other):
        """The same cells, and all that is known of them."""
        self.assertEqual((one.grid, one.window), (other.grid, other.window))
        for name in ("_words", "_ids", "_inside", "_colors"):
            a, b = getattr(one, name), getattr(other, name)
            self.assertEqual(a is None, b is None, name)
            np.testing.assert_array_equal(a, b, name)

    def test_by_readers(self):
        """What is written here, as readers of their own see it."""
        for what, voxels in self.told():
            for ending in ALONE if what != "colors" else ():
                cells, grid = readers.read(str(self.saved(voxels, ending)), None, what)
                expected = voxels.labels() if what == "labels" else np.array(voxels)
                if what == "ids":
                    expected = np.where(expected, 0, -1)
                    expected[np.asarray(voxels)] = voxels.ids
                np.testing.assert_array_equal(cells, expected)
                self.assert_near(grid or dict(zip(("origin", "cell", "size"), voxels.grid)), voxels.grid, ending == ".nrrd")
        part = tribox.voxelize(cases.lattice(30), GRIDS["tenths"], window=((1, 2, 3), (8, 6, 7)))
        self.assert_same(np.load(self.saved(part, ".NPY")), np.array(part))

    def assert_near(self, found, grid, is_rounded):
        """A grid, or all but the roundings of its origin."""
        origin, cell, size = map(np.array, grid)
        ulp = np.spacing(np.maximum(abs(origin), abs(origin + cell / 2))) * is_rounded
        self.assertTrue((abs(origin - found["origin"]) <= ulp).all())
        self.assertEqual((tuple(found["cell"]), tuple(found["size"])), (grid.cell, grid.size))

    @NEEDS_PROGRAM
    def test_like_the_program(self):
        """Byte by byte, but for .npz, whose bricks have an order of their own."""
        triangles = cases.lattice(40).astype(float) * (0.1, 1e-6, 3e9)
        mesh = triangles + (5e6, 0.1, 0)
        for options, way in ((("--cell", "0.01,1e-7,1e9"), dict(cell=(0.01, 1e-7, 1e9))),
                             (("--cell", "0.05,1e-6,3e8", "--fill", "outside"), dict(cell=(0.05, 1e-6, 3e8), fill="outside")),
                             (("--resolution", "9", "--ids"), dict(resolution=9, ids=True)),
                             (("-r", "9", "--fill", "outside", "--labels"), dict(resolution=9, fill="outside", labels=True)),
                             (("--resolution", "9"), dict(resolution=9))):
            voxels = tribox.voxelize(mesh, **way)
            for ending in (".npy", ".nrrd", ".vti", ".npz"):
                path = os.path.join(self.folder, "program" + ending)
                self.program("voxelize", "-", "--format", "f64", *options, "-o", path, "--quiet", input=mesh.tobytes())
                ours = self.saved(voxels, ending)
                if ending == ".npz":
                    self.assert_alike(*map(tribox.Voxels.load, (path, ours)))
                else:
                    self.assertEqual(ours.read_bytes(), Path(path).read_bytes(), ending)

    def program(self, *words, **keywords):
        command = [os.environ["TRIBOX_PROGRAM"], *map(str, words)]
        return subprocess.run(command, capture_output=True, timeout=120, check=True, **keywords).stdout

    def coloured(self):
        """A file of a mesh, its triangles, and a colour of each."""
        triangles, path = cases.lattice(60), Path(self.folder, "coloured.off")
        colors = self.pick.integers(0, 256, (60, 3)).astype(np.uint8)
        lines = ["OFF", "180 60 0", *(" ".join(map(repr, p)) for p in triangles.reshape(-1, 3).tolist()),
                 *(" ".join(map(str, (3, 3 * n, 3 * n + 1, 3 * n + 2, *c))) for n, c in enumerate(colors.tolist()))]
        path.write_text("\n".join(lines))
        return path, triangles, colors

    @NEEDS_PROGRAM
    def test_every_format(self):
        """Of Voxels and Bricks what the program writes of the same mesh, byte by byte; what a format does not hold is refused."""
        formats = {each["ending"]: each for each in reversed(json.loads(self.program("info", "--json"))["formats"])}
        path, triangles, colors = self.coloured()
        for what, options, way in (("", (), {}), ("ids", ("--ids",), dict(ids=True)),
                                   ("colors", ("--colours",), dict(colors=colors)),
                                   ("labels", ("--fill", "outside", "--labels"), dict(fill="outside", labels=True))):
            voxels = tribox.voxelize(triangles, cell=0.1, **way)
            bricks = tribox.Bricks.load(self.saved(voxels, ".npz"))
            for ending, about in formats.items():
                ours = rf"path = .*; \{ending} holds no {what}; give a name that ends in .npz, .*, or save tribox.Voxels"
                if what.replace("or", "our") not in about["holds"]:
                    for thing in (voxels, bricks):
                        self.refuse(tribox.InputError, None, ours, thing.save, Path(self.folder, "x" + ending))
                    continue
                whole = Path(self.folder, "program" + ending)
                if subprocess.run([os.environ["TRIBOX_PROGRAM"], "voxelize", path, "--cell", "0.1", *options, "-q", "-o", whole],
                                  capture_output=True, timeout=120).returncode and ending == ".vdb":
                    continue  # built without OpenVDB
                for thing in (voxels, bricks) if ending != ".npz" else ():
                    written = self.saved(thing, ending).read_bytes(), whole.read_bytes()
                    self.assertEqual(*map(readers.without_vdb_id, written) if ending == ".vdb" else written, (ending, what))

    @NEEDS_PROGRAM
    def test_colors(self):
        """The colour of a cell is that of its lowest triangle, from the mesh to the file and back."""
        path, triangles, colors = self.coloured()
        ids = tribox.voxelize(triangles, cell=0.1, ids=True)
        mesh, like = tribox.read(path), SimpleNamespace(vertices=triangles.reshape(-1, 3), faces=np.arange(180).reshape(-1, 3))
        like.visual = SimpleNamespace(face_colors=np.insert(colors, 3, 255, 1))
        self.assert_same(mesh.face_colors, colors)
        for voxels in (ids.with_colors(colors[ids.ids]), *(tribox.voxelize(one, ids.grid, colors=True) for one in (mesh, like)),
                       tribox.voxelize(triangles, ids.grid, colors=colors, threads=2)):
            again = tribox.Voxels.load(self.saved(voxels, ".npz"))
            for one in (voxels, again, pickle.loads(pickle.dumps(voxels))):
                self.assert_same(one.colors, colors[ids.ids])
            self.assert_same(voxels[2:9, :, 3:].colors, colors[ids[2:9, :, 3:].ids])
            self.refuse(tribox.InputError, None, "^these Voxels have no ids", getattr, voxels, "ids")
            self.assertFalse(voxels.colors.flags.writeable)
        program = Path(self.folder, "program.npz")
        self.program("voxelize", path, "--cell", "0.1", "--colours", "-o", program)
        self.assert_same(tribox.Voxels.load(program).colors, colors[ids.ids])
        many, out = ids.with_colors(self.pick.integers(0, 256, (ids.sum(), 3)).astype(np.uint8)), Path(self.folder, "many.vox")
        with self.assertWarnsRegex(UserWarning, f"^{out}: the cells have more than the 255 colours") as warned:
            many.save(out)
        self.assertEqual(warned.filename, __file__)
        refuse, wrong = self.refuse, tribox.InputError
        refuse(wrong, None, "^these Voxels have no colors; voxelize", getattr, ids, "colors")
        refuse(wrong, None, r"of each cell$", ids.with_colors, colors)
        for odd in (colors[1:], colors.astype(int), colors[:, :2], [1, 2]):
            refuse(wrong, None, r"^colors is .* give uint8 of shape \(60, 3\), .* of each triangle$", tribox.voxelize, triangles,
                   cell=1, colors=odd)
        refuse(wrong, None, "^colors = True, and triangles has no", tribox.voxelize, triangles, cell=1, colors=True)
        refuse(wrong, None, "^ids and colors exclude", tribox.voxelize, triangles, cell=1, colors=colors, ids=True)
        refuse(wrong, None, "^colors are .*without fill", tribox.voxelize, triangles, cell=1, colors=colors, fill="outside")
        refuse(wrong, None, "^colors are .*leave out thin", tribox.voxelize, triangles, cell=1, colors=colors, thin=True)

    @NEEDS_PROGRAM
    def test_read(self):
        """Meshes of every format, of floats and doubles, are the same triangles, for every call."""
        floats = cases.lattice(30)
        doubles = floats.astype(float) + 0.1
        for triangles, formats in (floats, meshes.FORMATS), (doubles, meshes.FORMATS_OF_DOUBLES):
            for name, write in formats.items():
                path = Path(self.folder, "-" + name)
                content = write(triangles.tolist())
                path.write_bytes(content if isinstance(content, bytes) else content.encode())
                try:
                    mesh = tribox.read(path)
                except tribox.InputError as error:
                    self.assertIn("built without libassimp", str(error))
                    continue
                for same in (mesh, pickle.loads(pickle.dumps(mesh)), tribox.Mesh(triangles), copy.deepcopy(tribox.Mesh(triangles))):
                    corners = same.vertices if same.faces is None else same.vertices[same.faces]
                    self.assert_same(corners, triangles, name)
                self.assertIsNone(mesh.face_colors)
                self.assert_same(*(np.array(tribox.voxelize(one, GRIDS["tenths"])) for one in (mesh, triangles)))
                self.assert_same(tribox.overlap(mesh, cases.LO, cases.HI), tribox.overlap(triangles, cases.LO, cases.HI))
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        os.rename("-little.ply", "-")  # which is no option, and not the standard input
        self.assertEqual(len(tribox.read("-")), 30)

    @NEEDS_PROGRAM
    def test_not_read(self):
        """The program's line is the error, its warnings are warnings; and what to do without it."""
        folder, refuse = Path(self.folder), self.refuse
        broken, holed, other = folder / "broken.ply", folder / "holed.off", folder / "program"
        broken.write_bytes(b"ply\nformat ascii 1.0\nend_header\n")
        holed.write_text("OFF\n3 2 0\n0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n3 0 1 1\n")
        other.write_text("#!/bin/sh\necho \"tribox $1: unexpected 'x'\" >&2; exit 2\n")
        with self.assertWarnsRegex(UserWarning, "^.*holed.off: 1 of 2 triangles have NaN") as warned:
            self.assertEqual(len(tribox.read(holed)), 2)
        self.assertEqual(warned.filename, __file__)
        refuse(tribox.InputError, None, "^[^:]*broken.ply: contains no triangles", tribox.read, broken)
        self.assertRaises(FileNotFoundError, tribox.read, folder / "none.ply")
        self.assertRaises(IsADirectoryError, tribox.read, folder)
        voxels, out = next(self.voxels()), folder / "x.vox"
        for path, call in product((3, None, b"x.ply", ["x.ply"]), (tribox.read, voxels.save)):
            refuse(tribox.InputTypeError, None, "^path = .*; give the path of a file", call, path)
        calls = (tribox.read, holed), (voxels.save, out)
        for path, pattern in (("", "takes the program tribox, which is not in this package and not on PATH: .* TRIBOX_PROGRAM"),
                              (str(folder / "none"), "none does not run: "), (str(holed), "does not run: "),
                              ("/bin/true", "tribox, and /bin/true, which wrote nothing, is another"),
                              (str(other), "of this version, and .*program is of another: unexpected 'x'")):
            other.chmod(0o700)
            with mock.patch.dict(os.environ, TRIBOX_PROGRAM=path, PATH=self.folder):
                for call, argument in calls:
                    refuse(tribox.Error, None, pattern, call, argument)
        with mock.patch.dict(os.environ, TRIBOX_PROGRAM="", PATH=os.path.dirname(os.environ["TRIBOX_PROGRAM"])):
            voxels.save(out)
        narrow = tribox.Voxels(np.ones((1, 1, 300), bool), tribox.Grid((0, 0, 0), (1, 2, 3), (300, 1, 1)))
        content = out.read_bytes()
        refuse(tribox.InputError, None, "^.*x.vox: .*256", narrow.save, out)
        refuse(tribox.InputError, None, "^.*x.binvox: .*cubic", narrow.save, folder / "x.binvox")
        self.assertEqual((sorted(os.listdir(folder)), out.read_bytes()), (["broken.ply", "holed.off", "program", "x.vox"], content))
        shard = dataclasses.replace(tribox.bricks(cases.lattice(9), voxels.grid), shard=(2, 5))
        refuse(tribox.InputError, None, "shard 2 of 5; tribox merge", shard.save, out)
        refuse(tribox.InputError, None, "shard 2 of 5; tribox merge", shard.voxels)

    def test_whole_or_as_it_was(self):
        """Where a write fails, or the user ends it, what had the name is still there and nothing else; links stay links."""
        old, hard = Path(self.folder, "old"), resource.getrlimit(resource.RLIMIT_FSIZE)[1]
        mesh = cases.lattice(40)
        voxels, bricks = tribox.voxelize(mesh, resolution=40, ids=True), tribox.bricks(mesh, resolution=40)
        plain = tribox.Voxels(voxels.words, voxels.grid)
        for thing, ending in ((voxels, ".npz"), (voxels, ".npy"), (voxels, ".nrrd"), (voxels, ".vti"), (bricks, ".npz"),
                              *[(plain, ".glb"), (bricks, ".obj")] * ("TRIBOX_PROGRAM" in os.environ)):
            path = Path(self.folder, "x" + ending)
            old.write_bytes(b"what was there")
            path.symlink_to(old)
            resource.setrlimit(resource.RLIMIT_FSIZE, (5000, hard))
            try:
                self.assertRaises(OSError, thing.save, path)
            finally:
                resource.setrlimit(resource.RLIMIT_FSIZE, (hard, hard))
            with mock.patch("os.replace", side_effect=KeyboardInterrupt):
                self.assertRaises(KeyboardInterrupt, thing.save, path)
            self.assertEqual((sorted(os.listdir(self.folder)), old.read_bytes()), (["old", path.name], b"what was there"))
            thing.save(path)
            self.assertTrue(path.is_symlink() and old.stat().st_size > 5000)
            path.unlink()

    @NEEDS_PROGRAM
    def test_load(self):
        """A part and a shifted whole, of the program's and saved again; none that is damaged."""
        mesh, part, whole = Path(self.folder, "m.f32"), Path(self.folder, "part.npz"), Path(self.folder, "whole.npz")
        mesh.write_bytes(cases.lattice(40).tobytes())
        for path, options in ((part, ("--shard", "2/5")), (whole, ("--shift", "1,0.5,-3", "--ids", "--deflate"))):
            self.program("voxelize", mesh, "-r", "300", *options, "-q", "-o", path)
        bricks, shifted = tribox.Bricks.load(part), tribox.Bricks.load(str(whole))
        self.assertEqual((bricks.shard, bricks.ids, shifted.shard, shifted.shift), ((2, 5), None, None, (1, 0.5, -3)))
        self.assertIn(", shard 2 of 5>", repr(bricks))
        self.assertNotIn("shard", repr(shifted))
        again = tribox.Bricks.load(self.saved(shifted, ".npz"))
        self.assertEqual(again.shift, shifted.shift)
        self.assert_alike(again.voxels(), shifted.voxels())
        self.check_damaged(part, whole)

    def check_damaged(self, part, whole):
        path = Path(self.folder, "changed.npz")
        for of, why, arrays in ((part, "its at is float64", dict(at=np.zeros((3, 3)))),
                                (part, "its shard is", dict(shard=np.zeros(3, "<u4"))),
                                (part, r"its bits is uint64 of shape \(3,\)", dict(bits=np.zeros(3, "<u8"))),
                                (part, "damaged: .* places of 1 bricks", dict(bits=np.zeros((1, 8), "<u8"))),
                                (part, "damaged: .* places of 2 bricks", dict(inside=np.zeros((2, 8), "<u8"))),
                                (whole, "its ids is int64", dict(ids=np.zeros(3, "<i8"))),
                                *((whole, f"damaged: {n} ids of other cells", dict(ids=np.zeros(n, "<u4"))) for n in (3, 1000000))):
            with np.load(of) as file:
                np.savez(path, **{**{name: file[name] for name in file.files}, **arrays})
            self.refuse(tribox.InputError, None, "changed.npz: .*" + why, tribox.Bricks.load, path)
        data = part.read_bytes()
        encrypted, newer, flipped = bytearray(data), bytearray(data), bytearray(data)
        flipped[200] ^= 4
        for at in [n for n in range(len(data) - 4) if data[n:n + 4] in (b"PK\3\4", b"PK\1\2")]:
            is_member = data[at:at + 4] == b"PK\3\4"
            encrypted[at + 8 - 2 * is_member] |= 1
            newer[at + 6 - 2 * is_member] = 181
        for content in (data[:-50], flipped, b"x\n", b"", encrypted, newer, self.saved(next(self.voxels()), ".npy").read_bytes()):
            path.write_bytes(content)
            self.refuse(tribox.InputError, None, "changed.npz: not a .npz file of bricks", tribox.Bricks.load, path)
        for wrong in (None, 3, b"x.npz", [path]):
            self.refuse(tribox.InputTypeError, None, "^path = .*; give the path of a file", tribox.Bricks.load, wrong)
        self.assertRaises(FileNotFoundError, tribox.Bricks.load, "no.npz")
        self.refuse(tribox.InputError, None, "^path = .*; Bricks are read from .npz; tribox.Voxels", tribox.Bricks.load, "no.npy")

    def test_bricks(self):
        """As Voxels, saved and saved again."""
        ids = tribox.voxelize(cases.some(), GRIDS["tenths"], ids=True)
        things = (ids, tribox.bricks(cases.some(), GRIDS["tenths"], side=16, ids=True)), *((one, one) for _, one in self.told())
        for voxels, thing in things:
            bricks = tribox.Bricks.load(self.saved(thing, ".npz"))
            for one in (bricks, tribox.Bricks.load(self.saved(bricks, ".npz"))):
                self.assert_alike(one.voxels(), voxels)

    def files(self, what):
        """The endings of files of such Voxels that can be written and read here."""
        for ending, holds in tribox._files.HOLDS.items():
            if ending in ALONE or "TRIBOX_PROGRAM" in os.environ and not (ending == ".vdb" and (what == "ids" or not HAS_OPENVDB)):
                if what == "bits" or what in holds:
                    yield ending

    def test_read_again(self):
        """Voxels of every file are those that were saved, with grid, ids, labels and colors; those of a slice in its grid."""
        for (what, voxels), key in product(self.told(), (np.s_[:], np.s_[1:4, 1:, -11:-2])):
            grid, part = voxels.grid, voxels[key]
            for ending in self.files(what):
                if ending == ".binvox" and len(set(grid.cell)) > 1 or ending == ".npy" and part.window != voxels.window:
                    continue
                path = self.saved(part, ending.upper() if what == "ids" else ending)
                again, expected = tribox.Voxels.load(path, grid), part
                if ending in FACES and what == "colors":
                    expected = tribox.Voxels(part.words, grid, part.window)
                self.assertEqual((again.grid, again.sum()), (grid, part.sum()), ending)
                self.assert_alike(again[key], expected)
                if ending in (".npy", ".raw", ".vox", *FACES):
                    self.refuse(tribox.InputError, None, rf"{path.name}: a {ending} does not say .*; give grid=tribox\.Grid",
                                tribox.Voxels.load, path)
                    continue
                own = tribox.Voxels.load(path).grid
                size = (max(grid.size),) * 3 if ending == ".binvox" else grid.size
                self.assert_near(own.__dict__, tribox.Grid(grid.origin, grid.cell, size), ending == ".nrrd")

    def test_not_read_again(self):
        """Damaged files, other grids, and what nobody knows."""
        grid, refuse, wrong = tribox.Grid((0, 1, 2), 0.5, (9, 5, 4)), self.refuse, tribox.InputError
        smaller = tribox.Grid(grid.origin, grid.cell, (9, 5, 3))
        others = [tribox.Grid(origin, cell, grid.size) for origin, cell in (((0, 1, 2.5), 0.5), (grid.origin, 99),
                                                                            (grid.origin, (1, 0.5, 0.5)), ((-9,) * 3, 99))]
        voxels = tribox.Voxels(self.pick.random((4, 5, 9)) < 0.5, grid)
        for ending in self.files("bits"):
            path = self.saved(voxels, ending)
            octets = path.read_bytes()
            for other in (smaller, *others * (ending not in (".npy", ".raw", ".vox"))):
                pattern = f"^grid = .*{path.name} has Grid.*; give that|{path.name}: not a .* damaged one.*; (give|save) the"
                refuse(wrong, None, pattern, tribox.Voxels.load, path, other)
            middle = octets.replace(b"\xf0\x3f", b"\xe0\x3f") if ending == ".ply" else b"x"  # a half in place of 1
            longer = octets[:-9] if ending in (".npz", ".npy", ".obj", ".vdb") else octets + b"x"
            for content in (octets[:-9], octets[:50], b"", middle, longer):
                path.write_bytes(content)
                refuse(wrong, None, f"{path.name}: not a .*damaged", tribox.Voxels.load, path, grid)
        for ending in (".nrrd", ".vti"):
            path = self.saved(voxels, ending)
            octets = path.read_bytes()
            for old, new in (b"uint8", b"uint9"), (b"UInt8", b"X"), (octets[-99:-40], b"\2" * 59):
                path.write_bytes(octets.replace(old, new))
                if old in octets:
                    refuse(wrong, None, f"{path.name}: not a file of cells", tribox.Voxels.load, path)
        raw = Path(self.folder, "x.raw")
        for nx, words in (2, [1, 2, 3]), (8, [1, 0, 2]):
            raw.write_bytes(np.array(words, "<u8").tobytes())
            refuse(wrong, None, "x.raw: .*24 bytes, which are bits as well as numbers", tribox.Voxels.load, raw,
                   ((0, 0, 0), 1, (nx, 3, 1)))
        for path, more, pattern in ((3, (), "path = 3; give the path"), ("x.xyz", (), "names end in .npz, .npy"),
                                    ("x.npy", (7,), "^grid = 7")):
            self.refuse((tribox.InputError, tribox.InputTypeError), None, pattern, tribox.Voxels.load, path, *more)
        self.assertRaises(FileNotFoundError, tribox.Voxels.load, "no.nrrd")
        places = Path(self.folder, "places.npy")
        np.save(places, voxels.cells())
        self.assert_alike(tribox.Voxels.load(places, grid), voxels)
        np.save(places, np.tile(voxels.cells().astype(np.int32), (2, 1)))
        refuse(wrong, None, "places.npy: .*a cell that comes twice", tribox.Voxels.load, places, grid)
        refuse(wrong, None, "cells beyond the 9 x 5 x 3", tribox.Voxels.load, places, tuple(smaller))
        refuse(wrong, None, r"of a window, tribox\.Voxels\(", tribox.Voxels.load, self.saved(voxels[1:], ".npy"), grid)

    def test_other_faces(self):
        """Closed meshes of the areas of cells: a block between planes, and a prism that leans as stairs do."""
        path, sides = Path(self.folder, "other.obj"), [(n, n % 4 + 1) for n in (1, 2, 3, 4)]
        faces = [(1, 3, 2), (1, 4, 3), (5, 6, 7), (5, 7, 8), *((a, b, b + 4) for a, b in sides),
                 *((a, b + 4, a + 4) for a, b in sides)]
        for left, lean in (0, 0), (0.5, 0), (0, 1):
            corners = (left, 0), (left + 2, 0), (left + lean + 2, 2), (left + lean, 2)
            path.write_text("\n".join(["# 8 vertices, 12 triangles", *(f"v {x} {y} {z}" for z in (0, 1) for x, y in corners),
                                       *("f {} {} {}".format(*face) for face in faces)]))
            asked = path, ((0, 0, 0), 1, (3, 2, 1))
            if left or lean:
                self.refuse(tribox.InputError, None, "other.obj: .*its faces are not those of cells", tribox.Voxels.load, *asked)
            else:
                self.assertEqual(tribox.Voxels.load(*asked).sum(), 4)

    @unittest.skipUnless(HAS_OPENVDB, "no Python module of OpenVDB")
    @NEEDS_PROGRAM
    def test_openvdb(self):
        path = self.saved(tribox.voxelize(cases.some(), GRIDS["cubes"], ids=True), ".vdb")
        self.refuse(tribox.InputError, None, f"{path.name}: .*reads no ids.*; save the cells as .npz", tribox.Voxels.load, path)
        with mock.patch("tribox._loading.find_spec", lambda name: None):
            self.refuse(tribox.Error, None, f"{path.name}: .* is not here; install it", tribox.Voxels.load, path)

    def test_slices(self):
        """Of a grid that no memory holds, where a format takes bricks or the window alone."""
        grid = tribox.Grid((0, 0, 0), 2.0 ** -40, (1 << 30,) * 3)
        part = tribox.voxelize(np.eye(3)[None], grid, window=((5, 1 << 20, 9), (70, 9, 9))) | tribox.Voxels(
            self.pick.random((9, 9, 70)) < 0.3, grid, ((5, 1 << 20, 9), (70, 9, 9)))
        self.assertEqual(sorted(tribox.Bricks.load(self.saved(part, ".npz")).cells().tolist()), sorted(part.cells().tolist()))
        self.refuse(tribox.InputError, None, r"\.nrrd holds every cell of a grid.*; give a name that ends in \.npz, or in \.npy",
                    part.save, Path(self.folder, "x.nrrd"))

    def test_refused(self):
        voxels, refuse = next(self.voxels()), self.refuse
        bricks = tribox.bricks(cases.lattice(9), GRIDS["tenths"])
        for path in ("x", "x.npz.gz", ".npz", "x.xyz", Path("x.f32")):
            for thing in (voxels, bricks):
                refuse(tribox.InputError, None, r"^path = .*end in \.npz, \.npy, .*\.vdb, \.vox, .*\.glb", thing.save, path)
        far = tribox.voxelize(cases.lattice(9), GRIDS["tenths"], ids=True)
        far._with_ids(far.ids + np.uint32(1 << 31))
        refuse(tribox.InputError, None, "^ids up to 21474836.* do not fit int32", far.save, os.path.join(self.folder, "x.npy"))
        self.assertEqual(os.listdir(self.folder), [])
        self.assertRaisesRegex(FileNotFoundError, "no/x.npy'$", voxels.save, os.path.join(self.folder, "no", "x.npy"))


if __name__ == "__main__":
    cases.main()
