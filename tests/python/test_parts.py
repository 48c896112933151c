"""Bricks.load: parts that tribox voxelize --shard wrote are the file that it writes at once, byte for byte, or are refused."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
import tribox

import cases

GRID = ("--cell", "0.0101,0.0145,0.029", "--origin", "-2,-2,-2", "--size", "390,270,140")  # 4 x 3 x 2 tiles
FARTHER = ("--cell", "0.0101,0.0145,0.029", "--origin", "-2,-2,-1", "--size", "390,270,140")
PLACE = {"shard", "tiles", "whole"}


class Parts(cases.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.mesh = "mesh.f32"
        (self.folder / self.mesh).write_bytes((cases.lattice(12) * np.float32(0.5)).tobytes())

    def program(self, *arguments, to="stdout"):
        """Runs the program in the folder."""
        if "TRIBOX_PROGRAM" not in os.environ:
            self.skipTest("built without the program")
        with open(self.folder / to, "wb") as stdout:
            subprocess.run([os.environ["TRIBOX_PROGRAM"], *arguments, "--quiet"], cwd=self.folder, stdin=subprocess.DEVNULL,
                           stdout=stdout, stderr=subprocess.PIPE, timeout=120, check=True)

    def part(self, shard, shards, *options, mesh=None, grid=GRID, name="p"):
        path = f"{name}.{shard}.npz"
        self.program("voxelize", mesh or self.mesh, *grid, "--shard", f"{shard}/{shards}", "-o", path, *options)
        return str(self.folder / path)

    def parts(self, shards, *options, **how):
        return [self.part(shard, shards, *options, **how) for shard in range(1, shards + 1)]

    def whole(self, *options, grid=GRID):
        self.program("voxelize", self.mesh, *grid, "-o", "whole.npz", *options)
        return tribox.Bricks.load(self.folder / "whole.npz")

    def assert_whole(self, found, whole):
        self.assert_same(found.at, whole.at)
        self.assert_same(found.bits, whole.bits)
        self.assertEqual((found.grid, found.shift, found.shard), (whole.grid, whole.shift, None))

    def test_ids(self):
        """Of the parts and of the whole, as tribox.bricks has them."""
        whole = self.whole("--ids")
        triangles = (cases.lattice(12) * np.float32(0.5)).reshape(-1, 3, 3)
        here = tribox.bricks(triangles, whole.grid, side=64, ids=True)
        self.assertGreater(len(whole.ids), 10000)
        for found in (here, *(tribox.Bricks.load(self.parts(shards, "--ids", name=f"i{shards}")) for shards in (1, 5))):
            self.assert_whole(found, whole)
            self.assert_same(found.ids, whole.ids)
        mixed = [self.part(1, 2, "--ids", name="m"), self.part(2, 2, name="m")]
        self.refuse_load("differ in the size of tiles", mixed)
        (self.folder / "back.f32").write_bytes(triangles[::-1].tobytes())
        back = self.part(2, 2, "--ids", name="b", mesh="back.f32")
        self.refuse_load("differ in the order of the triangles, whose numbers the ids are: run the shards", [mixed[0], back])
        tribox.Bricks.load([self.part(1, 2, name="n"), self.part(2, 2, name="n", mesh="back.f32")])

    def test_any_number(self):
        whole = self.whole()
        self.assertGreater(len(whole.at), 500)
        self.program("partition", self.mesh, *GRID, "-o", "tiles")
        for shards in (1, 2, 5, 64):
            for how in (dict(), dict(mesh="tiles", grid=())):
                for options in ((), ("--deflate", "--threads", "1")):
                    paths = self.parts(shards, *options, name=f"n{shards}", **how)
                    self.assert_whole(tribox.Bricks.load(paths[::-1]), whole)
                    self.assert_whole(tribox.Bricks.load(self.folder / f"n{shards}.*.npz"), whole)

    def test_one_process(self):
        """The arrays themselves, and what a whole has beside the bricks, are in the parts as in the whole."""
        self.whole()
        with np.load(self.folder / "whole.npz") as whole:
            self.assertEqual(set(whole.files) & PLACE, set())
            files = [np.load(path) for path in self.parts(5)]
            for name in whole.files:
                found = [file[name] for file in files]
                joined = np.concatenate(found) if name in ("at", "bits") else found[0]
                self.assertEqual((joined.dtype.str, joined.tobytes()), (whole[name].dtype.str, whole[name].tobytes()), name)
            self.assertEqual([file["shard"].tolist() for file in files], [[shard, 5] for shard in range(1, 6)])
            self.assertEqual([file["tiles"][0] for file in files[1:]], [file["tiles"][1] for file in files[:-1]])
            self.assertEqual((files[0]["tiles"][0], files[4]["tiles"][1]), (0, 4 * 3 * 2))
            sums = files[0]["whole"][1:3]
            for file in files:
                self.assertEqual(set(file.files), set(whole.files) | PLACE)
                self.assertEqual(file["whole"].tolist(), [12, *sums, 4, 0, tribox.AXES_ALL, 128])
                tile = file["at"].astype(int) // 16 @ [1, 4, 12]
                self.assertTrue(((tile >= file["tiles"][0]) & (tile < file["tiles"][1])).all())
                file.close()

    def test_one_part(self):
        path = self.part(2, 5)
        part = tribox.Bricks.load(path)
        self.assertEqual(part.shard, (2, 5))
        self.assertIn(", shard 2 of 5>", repr(part))
        self.assertNotIn("shard", repr(self.whole()))

    def test_standard_output(self):
        path = self.part(2, 5)
        self.program("voxelize", self.mesh, *GRID, "--shard", "2/5", "-o", "-", "--out-format", "npz", to="stdout.npz")
        self.assertEqual(Path(self.folder, "stdout.npz").read_bytes(), Path(path).read_bytes())

    def test_shift(self):
        whole = self.whole("--shift", "1,0.5,-3")
        self.assertEqual(whole.shift, (1, 0.5, -3))
        self.assert_whole(tribox.Bricks.load(self.parts(3, "--shift", "1,0.5,-3")), whole)
        whole.save(self.folder / "again.npz")
        self.assert_whole(tribox.Bricks.load(self.folder / "again.npz"), whole)
        self.assert_whole(tribox.Bricks.load([self.folder / "again.npz"]), whole)

    def refuse_load(self, pattern, path):
        self.refuse(tribox.InputError, None, pattern, tribox.Bricks.load, path)

    def test_sets_that_do_not_fit(self):
        parts = self.parts(3)
        self.refuse_load("of 3 shards 1 are missing: 3; give the files of all", parts[:2])
        self.refuse_load("of 3 shards 1 are missing: 1;", parts[1:])
        self.refuse_load("of 3 shards 2 are missing: 1, 3;", parts[1:2])
        self.refuse_load(r"of 64 shards 63 are missing: 1, 3, .*, 21, \.\.\.;", [self.part(2, 64, name="n")])
        self.refuse_load("p.2.npz and .*p.2.npz are both shard 2 of 3; give each once", parts + parts[1:2])
        other = self.folder / "other.f32"
        other.write_bytes(cases.lattice(13).tobytes())
        for what, part in (("number of shards", self.part(3, 4, name="q")), ("grid", self.part(3, 3, grid=FARTHER, name="r")),
                           ("shift", self.part(3, 3, "--shift", "1,0,0", name="s")),
                           ("mesh", self.part(3, 3, mesh=str(other), name="t")),
                           ("accuracy", self.part(3, 3, "--accuracy", "fast", name="u")),
                           ("choice of axes", self.part(3, 3, "--axes", "box", name="v"))):
            self.refuse_load(f"p.1.npz and .* do not fit together: they differ in the {what}$", parts[:2] + [part])
        self.whole()
        whole = str(self.folder / "whole.npz")
        for paths in (parts + [whole], [whole] + parts, [whole, whole]):
            self.refuse_load("whole.npz is no part of a whole; give the files of all shards, or that file alone", paths)
        self.refuse_load("there are no such files", str(self.folder / "x.*.npz"))
        for wrong in (None, 3, b"x.npz", []):
            self.refuse_load("^path = ", wrong)
        self.assertRaises(FileNotFoundError, tribox.Bricks.load, str(self.folder / "x.npz"))

    def changed(self, path, **arrays):
        with np.load(path) as file:
            found = {name: file[name] for name in file.files}
        np.savez(self.folder / "changed.npz", **{**found, **arrays})
        return str(self.folder / "changed.npz")

    def test_damaged(self):
        first, second = self.parts(2)
        tiles = np.load(second)["tiles"]
        self.refuse_load(r"changed.npz begins with tile \d+ in place of \d+: it was cut otherwise",
                         [first, self.changed(second, tiles=tiles + np.array([1, 0], "<u8"))])
        self.refuse_load("changed.npz ends before the last tile",
                         [first, self.changed(second, tiles=tiles - np.array([0, 1], "<u8"))])
        for shard in ((0, 2), (3, 2)):
            self.refuse_load("damaged: shard . of 2", [first, self.changed(second, shard=np.array(shard, "<u4"))])
        self.refuse_load("its whole is uint64 of shape", self.changed(second, whole=np.zeros(6, "<u8")))
        self.refuse_load("its at is float64", self.changed(second, at=np.zeros((3, 3))))
        self.refuse_load(r"its bits is uint64 of shape \(3,\)", self.changed(second, bits=np.zeros(3, "<u8")))
        self.refuse_load("damaged: .* places of 1 bricks", self.changed(second, bits=np.zeros((1, 8), "<u8")))
        data = Path(second).read_bytes()
        flipped = bytearray(data)
        flipped[200] ^= 4
        np.save(self.folder / "array.npy", np.zeros(3))
        np.savez(self.folder / "other.npz", x=np.zeros(3))
        encrypted, newer = bytearray(data), bytearray(data)
        for at in [n for n in range(len(data) - 4) if data[n:n + 4] in (b"PK\3\4", b"PK\1\2")]:
            is_member = data[at:at + 4] == b"PK\3\4"
            encrypted[at + 8 - 2 * is_member] |= 1
            newer[at + 6 - 2 * is_member] = 181
        contents = {"short.npz": data[:-50], "flipped.npz": flipped, "text.npz": b"x\n", "none.npz": b"", "encrypted.npz": encrypted,
                    "newer.npz": newer}
        for name, content in contents.items():
            (self.folder / name).write_bytes(content)
        for name in (*contents, "array.npy", "other.npz"):
            self.refuse_load(f"{name}: not a .npz file of bricks", str(self.folder / name))


if __name__ == "__main__":
    cases.main()
