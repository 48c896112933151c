"""Files of cells as the program writes them, whose planes are those that were asked about; and meshes as the program reads them."""

import copy
import json
import os
import pickle
import re
import resource
import subprocess
import sys
import tempfile
import unittest
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
GRIDS = {"tenths": ((-2.1, -1.5, 1e-6), (0.3, 1 / 3, 0.7), (13, 9, 11)), "one": ((-2, -2, -2), 4, (1, 1, 1)),
         "far": ((557820.1, 5108010, -1e9), (0.1, 1e-5, 2e9), (70, 3, 2))}


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

    def test_npy(self):
        for voxels in self.voxels():
            self.assert_same(np.load(self.saved(voxels, ".npy")), np.array(voxels))
        part = tribox.voxelize(cases.lattice(30), GRIDS["tenths"], window=((1, 2, 3), (8, 6, 7)))
        self.assert_same(np.load(self.saved(part, ".NPY")), np.array(part))

    def test_npz(self):
        for voxels in self.voxels():
            for thing in (voxels, tribox.Bricks(*self.bricks(voxels), voxels.grid)):
                with np.load(self.saved(thing, ".npz")) as file:
                    grid = tribox.Grid(file["origin"], file["cell"], file["size"])
                    bricks = tribox.Bricks(file["at"], file["bits"], grid)
                    self.assertEqual({name: file[name].dtype.str for name in file.files},
                                     dict(at="<u4", bits="<u8", origin="<f8", cell="<f8", size="<u4", shift="<f8"))
                self.assertEqual(grid, voxels.grid)
                self.assertEqual(sorted(bricks.cells().tolist()), sorted(voxels.cells().tolist()))
                self.assertTrue(bricks.bits.any(1).all())

    def bricks(self, voxels):
        """at and bits, a brick at a time."""
        nz, ny, nx = (-(-size // 8) * 8 for size in voxels.shape)
        cells = np.zeros((nz, ny, nx), bool)
        cells[tuple(slice(size) for size in voxels.shape)] = voxels
        found = [((i, j, k), [sum(1 << int(x + 8 * y) for y, x in np.argwhere(cells[8 * k + z, 8 * j:8 * j + 8, 8 * i:8 * i + 8]))
                              for z in range(8)]) for k, j, i in np.ndindex(nz // 8, ny // 8, nx // 8)]
        found = [brick for brick in found if any(brick[1])]
        return (np.array([at for at, _ in found], np.uint32).reshape(-1, 3),
                np.array([bits for _, bits in found], np.uint64).reshape(-1, 8))

    def test_nrrd(self):
        for voxels in self.voxels():
            head, _, body = self.saved(voxels, ".nrrd").read_bytes().partition(b"\n\n")
            fields = dict(line.split(": ", 1) for line in head.decode("ascii").splitlines() if ": " in line)
            self.assertEqual(tuple(map(int, fields["sizes"].split())), voxels.grid.size)
            directions = np.array([eval(row) for row in fields["space directions"].split()], float)
            self.assert_same(directions, np.diag(voxels.grid.cell))
            middle = eval(fields["space origin"])
            for a in range(3):
                self.assertEqual(middle[a], voxels.grid.origin[a] + voxels.grid.cell[a] / 2)
            self.assert_same(np.frombuffer(body, np.uint8).reshape(voxels.shape).astype(bool), np.array(voxels))

    def test_vti(self):
        for voxels in self.voxels():
            content = self.saved(voxels, ".vti").read_bytes()
            head, _, rest = content.partition(b'<AppendedData encoding="raw">\n   _')
            attributes = dict(re.findall(r'(\w+)="([^"]*)"', head.decode("ascii")))
            self.assertEqual(tribox.Grid(attributes["Origin"].split(), attributes["Spacing"].split(),
                                         [int(x) for x in attributes["WholeExtent"].split()[1::2]]), voxels.grid)
            length, = np.frombuffer(rest, "<u8", 1)
            self.assertEqual(length, voxels.size)
            self.assert_same(np.frombuffer(rest, np.uint8, length, 8).reshape(voxels.shape).astype(bool), np.array(voxels))
            self.assertEqual(rest[8 + int(length):], b"\n  </AppendedData>\n</VTKFile>\n")

    @NEEDS_PROGRAM
    def test_like_the_program(self):
        """Byte by byte, but for .npz, whose arrays are the same, in an order of their own."""
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
                subprocess.run([os.environ["TRIBOX_PROGRAM"], "voxelize", "-", "--format", "f64", *options, "-o", path, "--quiet"],
                               input=mesh.tobytes(), capture_output=True, timeout=120, check=True)
                ours = self.saved(voxels, ending)
                if ending != ".npz":
                    self.assertEqual(ours.read_bytes(), Path(path).read_bytes(), ending)
                    continue
                with np.load(path) as one, np.load(ours) as other:
                    self.assertEqual(set(one.files), set(other.files))
                    orders = [np.lexsort(file["at"].T) for file in (one, other)]
                    ids = [{(*cell, id) for cell,
                            id in zip(bricks.cells().tolist(), () if bricks.ids is None else bricks.ids.tolist())}
                           for bricks in map(tribox.Bricks.load, (path, ours))]
                    self.assertEqual(*ids)
                    for name in set(one.files) - {"ids"}:
                        arrays = [file[name][order] if name in ("at", "bits", "inside") else file[name]
                                  for file, order in zip((one, other), orders)]
                        self.assert_same(*arrays, name)

    def program(self, *words):
        return subprocess.run([os.environ["TRIBOX_PROGRAM"], *map(str, words)], capture_output=True, timeout=120, check=True).stdout

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
        with self.assertWarnsRegex(UserWarning, f"^{out} has the 255 colours of its palette") as warned:
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
        for path in (3, None, b"x.ply", ["x.ply"]):
            refuse(tribox.InputError, None, "^path = .*; give the path of a mesh file", tribox.read, path)
        voxels, out = next(self.voxels()), folder / "x.vox"
        calls = (tribox.read, holed), (voxels.save, out)
        for path, pattern in (("", "takes the program tribox, which is not on PATH .* TRIBOX_PROGRAM"),
                              (str(folder / "none"), "none does not run: "), (str(holed), "does not run: "),
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
        shard = tribox.Bricks(*self.bricks(voxels), voxels.grid, shard=(2, 5))
        refuse(tribox.InputError, None, "shard 2 of 5; tribox merge", shard.save, out)

    @NEEDS_PROGRAM
    def test_binvox(self):
        """A grid of cubes, filled up to a cube."""
        for cells in (self.pick.random((4, 5, 9)) < 0.4, np.zeros((1, 1, 1), bool), np.ones((9, 9, 9), bool)):
            voxels = tribox.Voxels(cells, tribox.Grid((-2.1, 1, 1e6), 0.5, cells.shape[::-1]))
            path = self.saved(voxels, ".binvox")
            again, side = tribox.Voxels.load(path), max(cells.shape)
            self.assertEqual(again.grid, tribox.Grid(voxels.grid.origin, 0.5, (side,) * 3))
            self.assert_same(again.cells(), voxels.cells())
            octets = path.read_bytes()
            for content in (octets[:-2], octets[:-1], octets[:9], b"", octets.replace(b"dim", b"din"), octets + b"\1\1"):
                path.write_bytes(content)
                self.refuse(tribox.InputError, None, f"{path.name}: not a file of cells", tribox.Voxels.load, path)

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
            subprocess.run([os.environ["TRIBOX_PROGRAM"], "voxelize", mesh, "-r", "300", *options, "-q", "-o", path], timeout=120,
                           check=True)
        bricks, shifted = tribox.Bricks.load(part), tribox.Bricks.load(str(whole))
        self.assertEqual((bricks.shard, bricks.ids, shifted.shard, shifted.shift), ((2, 5), None, None, (1, 0.5, -3)))
        self.assertIn(", shard 2 of 5>", repr(bricks))
        self.assertNotIn("shard", repr(shifted))
        again = tribox.Bricks.load(self.saved(shifted, ".npz"))
        self.assertEqual((again.grid, again.shift), (shifted.grid, shifted.shift))
        for name in ("at", "bits", "ids"):
            self.assert_same(getattr(again, name), getattr(shifted, name))
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
            self.refuse(tribox.InputError, None, "^path = .*; give the path of a file", tribox.Bricks.load, wrong)
        self.assertRaises(FileNotFoundError, tribox.Bricks.load, "no.npz")

    def test_ids_and_labels(self):
        """Of bricks as of voxels, in .npz and, as bytes of all cells, in the others; and saved again."""
        told = (tribox.voxelize(cases.some(), GRIDS["tenths"], ids=True),
                tribox.bricks(cases.some(), GRIDS["tenths"], side=16, ids=True),
                tribox.voxelize(cases.some(), resolution=30, fill="outside", labels=True))
        for thing in told:
            path = self.saved(thing, ".npz")
            bricks = tribox.Bricks.load(path)
            again = tribox.Bricks.load(self.saved(bricks, ".npz"))
            self.assertEqual(sorted(bricks.cells().tolist()), sorted(thing.cells().tolist()))
            if thing is not told[2]:
                numbers = [dict(zip(map(tuple, one.cells().tolist()), one.ids.tolist())) for one in (thing, bricks, again)]
                self.assertEqual(numbers, numbers[:1] * 3)
                self.assertEqual(bricks.ids.dtype, np.uint32)
                continue
            labels = thing.labels()
            for one in (bricks, again):
                found = np.zeros_like(labels)
                for cells, label in ((one.cells(), 1), (tribox.Bricks(one.at, one.inside, one.grid).cells(), 2)):
                    found[tuple(cells.T[::-1])] = label
                self.assert_same(found, labels)
            self.assert_same(np.load(self.saved(thing, ".npy")), labels)
            for ending in (".nrrd", ".vti"):
                self.assertIn(labels.tobytes(), self.saved(thing, ending).read_bytes())
            self.assertIsNone(tribox.Bricks.load(self.saved(thing.inside, ".npz")).inside)
        self.assertIsNone(tribox.Bricks.load(self.saved(tribox.voxelize(cases.some(), GRIDS["tenths"]), ".npz")).ids)

    def test_read_again(self):
        """Voxels of each file are those that were saved, with grid, ids and labels."""
        told = (*self.voxels(), tribox.voxelize(cases.some(), GRIDS["tenths"], ids=True),
                tribox.voxelize(cases.some(), resolution=70, ids=True),
                tribox.voxelize(cases.some(), resolution=30, fill="outside", labels=True))
        for voxels in told:
            for ending in (".npz", ".nrrd", ".VTI"):
                again = tribox.Voxels.load(self.saved(voxels, ending))
                np.testing.assert_array_equal(again.words, voxels.words)
                origin, cell, size = map(np.array, voxels.grid)
                ulp = np.spacing(np.maximum(abs(origin), abs(origin + cell / 2))) * (ending == ".nrrd")
                self.assertTrue((abs(origin - again.grid.origin) <= ulp).all())
                self.assertEqual((again.window, again.grid.cell, again.grid.size), (voxels.window, (*cell,), (*size,)))
                for name in ("_ids", "_inside"):
                    self.assertEqual(getattr(again, name) is None, getattr(voxels, name) is None)
                    np.testing.assert_array_equal(getattr(again, name), getattr(voxels, name))
        for ending in (".nrrd", ".vti"):
            path = self.saved(told[-1], ending)
            octets = path.read_bytes()
            other = octets.replace(b"uint8", b"uint9").replace(b"UInt8", b"X")
            for content in (octets[:-1], octets + b"x", octets[:50], b"", other):
                path.write_bytes(content)
                self.refuse(tribox.InputError, None, f"{path.name}: (not a file of cells|damaged: )", tribox.Voxels.load, path)
        part = tribox.Bricks(*self.bricks(told[1]), told[1].grid, shard=(2, 5))
        self.refuse(tribox.InputError, None, "shard 2 of 5; tribox merge", part.voxels)
        for path, pattern in ((3, "give the path"), ("x.npy", "has no grid: tribox.Voxels"), ("x.vdb", "end in .npz, .nrrd, .vti")):
            self.refuse(tribox.InputError, None, f"^path = .*{pattern}", tribox.Voxels.load, path)

    def test_refused(self):
        voxels, refuse = next(self.voxels()), self.refuse
        bricks = tribox.bricks(cases.lattice(9), GRIDS["tenths"])
        for path in ("x", "x.npz.gz", ".npz", "x.xyz", Path("x.f32")):
            for thing in (voxels, bricks):
                refuse(tribox.InputError, None, r"^path = .*end in \.npz, \.npy, .*\.vdb, \.vox, .*\.glb", thing.save, path)
        far = tribox.voxelize(cases.lattice(9), GRIDS["tenths"], ids=True)
        far._with_ids(far.ids + np.uint32(1 << 31))
        refuse(tribox.InputError, None, "^ids up to 21474836.* do not fit int32", far.save, os.path.join(self.folder, "x.npy"))
        part = tribox.voxelize(cases.lattice(9), GRIDS["tenths"], layers=(0, 2))
        for ending in (".npz", ".nrrd", ".vti"):
            path = os.path.join(self.folder, "x" + ending)
            refuse(tribox.InputError, None, "hold whole grids; voxelize without a window", part.save, path)
        self.assertEqual(os.listdir(self.folder), [])
        self.assertRaises(FileNotFoundError, voxels.save, os.path.join(self.folder, "no", "x.npy"))
        self.assertRaises(TypeError, voxels.save, 3)


if __name__ == "__main__":
    cases.main()
