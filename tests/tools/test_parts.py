"""Parts and partitions: what is damaged, does not fit or is no part is named, and how meshes of any layout and size are sorted."""

import io
import itertools
import json
import os
import re
import resource
import shutil
import struct
import zipfile

import harness
import numpy as np
import readers
import triangles as meshes
from harness import SEED, Voxels, grid_of, read
from triangles import INF, NAN

SIZE = (390, 270, 140)  # 4 x 3 x 2 tiles, the last of each axis cut
GRID = grid_of("0.0101,0.0145,0.029", "-2,-2,-2", "390,270,140")
TRIANGLES = np.array(meshes.lattice_triangles(12, seed=6))
SMALL = meshes.floats(np.random.default_rng(SEED).uniform(-2, 2, (5000, 1, 3)) +
                      np.random.default_rng(SEED).uniform(-0.01, 0.01, (5000, 3, 3)))
DAMAGED = "not a part, or only the beginning of one, or damaged"


class Parts(Voxels):
    def setUp(self):
        super().setUp()
        self.mesh = self.mesh_of(TRIANGLES)

    def part(self, shard, *options, mesh=None, name="p", grid=GRID):
        path = self.path(name + shard.partition("/")[0] + ".npz")
        self.succeed("voxelize", mesh or self.mesh, *grid, "--shard", shard, "-q", "-o", path, *options)
        return path

    def refuse_parts(self, pattern, *parts):
        self.fail_with(1, pattern, "merge", *parts, "-o", self.path("refused.npz"))

    def merged(self, *parts):
        return self.out("merge", *parts)

    def test_parts_that_do_not_fit(self):
        parts = [self.part("%d/3" % n) for n in (1, 2, 3)]
        for gone in (1, 2, 3):
            self.refuse_parts("shard %d of 3 is missing" % gone, *parts[:gone - 1], *parts[gone:])
        self.refuse_parts("shards 1,3-4,6-9 of 9 are missing; run them, or give their parts too",
                          *(self.part("%d/9" % n, name="n") for n in (2, 5)))
        self.refuse_parts("p2.npz and .*p2.npz are both shard 2 of 3; give each once", *parts, parts[1])
        other = self.mesh_of(meshes.lattice_triangles(12, seed=7), "other")
        for what, shard, options, how in (
                ("number of shards", "3/4", (), {}), ("grid", "3/3", (), {"grid": ("--cell", "0.3")}),
            ("accuracy", "3/3", ("--accuracy", "fast"), {}),
                ("choice of axes", "3/3", ("--axes", "box"), {}), ("mesh", "3/3", (), {"mesh": other}),
            ("ids: some have none", "3/3", ("--ids",), {}),
                ("shift", "3/3", ("--shift", "1,2,3"), {})):
            self.refuse_parts("they differ in the (%s|grid)" % what if what == "shift" else "they differ in the " + what,
                              *parts[:2],
                              self.part(shard, *options, name="q", **how))
        numbered = self.part("1/1", "--ids")
        self.fail_with(1, "p1.npz: has ids, and .glb holds none: write .npz", "merge", numbered, "-o", self.path("x.glb"))
        self.fail_with(1, "has ids, a grid of whole numbers: leave out --vdb-grid", "merge", numbered, "--vdb-grid", "mask", "-o",
                       self.path("x.vdb"))

    def test_order(self):
        """Shards of one mesh in two orders have other ids: of its triangles, of those that are not finite, and of partitions."""
        nan, t = [[(NAN, 0, 0)] * 3], TRIANGLES
        orders = [t, t[::-1], t[[1, 0, *range(2, 12)]], np.concatenate([nan, t]), np.concatenate([t[:9], nan, t[9:]])]
        files = [[self.mesh_of(order, "order%d" % n), *GRID] for n, order in enumerate(orders)]
        tiles = [self.path("a.tiles"), self.path("b.tiles")]
        for folder, some in zip(tiles, (t[:9], t[9:])):
            self.succeed("partition", self.mesh_of(some), *GRID, "--ids", "-q", "-o", folder)
        for one, other in (files[0], files[1]), (files[0], files[2]), (files[3], files[4]), (tiles, tiles[::-1]):
            for ids, second, is_sound in (("--ids",), one, True), ((), other, True), (("--ids",), other, False):
                parts = [self.path("%d.npz" % shard) for shard in (1, 2)]
                for shard, source in (1, one), (2, second):
                    harness.run("voxelize", *source, *ids, "-q", "--shard", "%d/2" % shard, "-o", parts[shard - 1])
                if is_sound:
                    self.merged(*parts)
                else:
                    self.refuse_parts("differ in the order of the triangles, whose numbers the ids are: run the shards with one",
                                      *parts)

    def rewritten(self, path, kind=zipfile.ZIP_STORED, **arrays):
        """A part with other arrays under checksums that fit, as NumPy would write it."""
        stored = {**readers.arrays(path), **arrays}
        with zipfile.ZipFile(self.path("rewritten.npz"), "w", kind) as to:
            for name, array in ((name, array) for name, array in stored.items() if array is not None):
                with to.open(name + ".npy", "w", force_zip64=True) as member:  # as numpy.savez
                    np.lib.format.write_array(member, np.asanyarray(array), (1, 0))
        return self.path("rewritten.npz")

    def test_not_a_part(self):
        first, second = self.part("1/2"), self.part("2/2")
        self.refuse_parts("missing.npz: cannot open the part: No such file", first, self.path("missing.npz"))
        self.refuse_parts("not a regular file", self.folder)
        data = read(second)
        for name, content in (("mesh.ply", b"ply\n"), ("none.npz", b""), ("old.part", b"tribox part 6\n".ljust(200)),
                              ("start.npz", data[:10]),
                              ("cut.npz", data[:-1]), ("half.npz", data[:len(data) // 2]), ("long.npz", data + b"\0"),
                              ("later.npz", data[:500] + data[501:])):
            self.refuse_parts(name + ": " + DAMAGED, first, self.write(name, content))
        numbered = read(self.part("1/1", "--ids"))
        for name, why in ((b"ids", "it has members that parts do not have"), (b"size", "or no part: it lacks size.npy")):
            self.refuse_parts("renamed.npz: damaged.*" + why,
                              self.write("renamed.npz", numbered.replace(name + b".npy", name + b".npx")))
        for options in ((), ("--deflate",)):  # a member of more bytes than the file has, or than deflated ones can stand for
            large = bytearray(read(self.part("1/1", *options)))
            struct.pack_into("<I", large, large.index(b"PK\1\2") + 24, 2 ** 31)
            self.refuse_parts("large.npz: " + DAMAGED, self.write("large.npz", bytes(large)))
        whole, _ = self.voxelize(self.mesh, *GRID)
        self.refuse_parts("cells.npz: is no part of a whole; give the files that tribox voxelize --shard", first, whole)

    def long(self, data):
        """The file with a list in which nothing fits 32 bits, as one of more than 4 GB has it."""
        start = at = data.index(b"PK\1\2")
        none, entries = 2 ** 32 - 1, []
        while data[at:at + 4] == b"PK\1\2":
            stored, size, name = struct.unpack_from("<2IH", data, at + 20)
            place, = struct.unpack_from("<I", data, at + 42)
            entries.append(data[at:at + 20] + struct.pack("<2I2H", none, none, name,
                                                          28) + data[at + 32:at + 42] + struct.pack("<I", none)
                           + data[at + 46:at + 46 + name] + struct.pack("<2H3Q", 1, 24, size, stored, place))
            at += 46 + name
        listed, count = b"".join(entries), len(entries)
        return (data[:start] + listed + struct.pack("<IQ2H2I4Q", 0x06064b50, 44, 45, 45, 0, 0, count, count, len(listed), start)
                + struct.pack("<2IQI", 0x07064b50, 0, start + len(listed),
                              1) + struct.pack("<I4H2IH", 0x06054b50, 0, 0, count, count, len(listed), none, 0))

    def test_other_forms(self):
        """Written anew, deflated, read in several pieces, and with a list of 64 bits they are the same parts."""
        first, second = self.part("1/2"), self.part("2/2")
        whole = self.merged(first, second)
        self.assertEqual(self.merged(first, self.rewritten(second)), whole)
        self.assertEqual(self.merged(first, self.rewritten(second, zipfile.ZIP_DEFLATED)), whole)
        path = self.write("long.npz", self.long(read(second)))
        with zipfile.ZipFile(path) as file:
            self.assertIsNone(file.testzip())
        self.assertEqual(self.merged(first, path), whole)
        path, fine = self.part("1/1", "--deflate", grid=("--resolution",
                                                         "1200")), self.out("voxelize", self.mesh, "--resolution", "1200")
        with zipfile.ZipFile(path) as file:
            self.assertGreater(file.getinfo("bits.npy").compress_size, 3 << 16)
        self.assertEqual(self.merged(path), fine)
        self.write("deflated.npz", self.out("voxelize", self.mesh, "--resolution", "1200", "--deflate"))
        stored, deflated = (np.load(file) for file in (io.BytesIO(fine), self.path("deflated.npz")))
        self.assertTrue(all(np.array_equal(stored[name], deflated[name]) for name in stored.files))

    def test_flipped_bits(self):
        """No change of a bit gives another answer, and none but of dates and the like goes unnoticed."""
        for options in ((), ("--ids", "--deflate")):
            data, whole = read(self.part("1/1", *options)), self.out("voxelize", self.mesh, *GRID, *options[:1])
            end, refused = data.index(b"PK\1\2"), 0
            places = [*range(0, 200, 5), *range(200, end, end // 60), *range(end - 700, len(data), 11)]
            for at in places:
                flipped = bytearray(data)
                flipped[at] ^= 1 << at % 8
                result = harness.run("merge", self.write("flipped.npz", bytes(flipped)), "-q", "-o", self.path("x.npz"))
                if result.code:
                    self.assertRegex(result.stderr, "^tribox merge: .*flipped.npz: (damaged|not a part|is no part)")
                    refused += 1
                else:
                    self.assertEqual(read(self.path("x.npz")), whole, at)
            self.assertGreater(refused, len(places) * 3 // 5)

    def test_arrays(self):
        """Of 390 cells along x two of the eight of a last brick are not used; of 270 along y, 140 along z as many."""
        path, first, second = self.part("1/1", "--ids"), self.part("1/2", name="s"), self.part("2/2", name="s")
        plain = self.part("1/1", name="plain")  # in the order of other tiles
        stored, senseless = readers.arrays(path), "what it says of the whole makes no sense"
        ids, (at, bits) = stored["ids"], [readers.arrays(plain)[name] for name in ("at", "bits")]
        rows = [("its arrays do not fit its bricks", {"at": at[:-1]}), ("its arrays do not fit its bricks", {"bits": bits[:, :7]}),
                ("its ids are not those of its cells", {"ids": ids[:-1]}),
                ("its ids are not those of its cells", {"ids": np.append(ids, ids[:1])}),
                ("its size.npy is not what was written", {"size": stored["size"][:2]}),
                (senseless, {"shard": np.array([0, 1], "<u4")}),
                (senseless, {"shard": np.array([2, 1], "<u4")}), (senseless, {"tiles": np.array([1, 0], "<u8")}),
                (senseless, {"shift": np.array([0, NAN, 0])}), (senseless, {"cell": np.array([0, 1., 1])}),
                (senseless, {"whole": np.append(stored["whole"][:6], np.zeros(1, stored["whole"].dtype))})]
        for why, n, place, words in (
                ("cells outside the grid", 0, (48, 0, 0), [0x40] + [0] * 7),
            ("cells outside the grid", 0, (0, 33, 0), [1 << 48] + [0] * 7),
                ("cells outside the grid", 0, (0, 0, 17), [0] * 4 + [1] * 4), ("bricks outside its tiles", 0, (49, 0, 0), [1] * 8),
                ("bricks are out of order", -1, (0, 0, 0), [1] * 8), ("bricks are out of order", -2, tuple(at[-1]), [1] * 8)):
            places, others = at.copy(), bits.copy()
            places[n], others[n] = place, words
            rows.append(("(it has|its) %s; run shard 1 of 1 again" % why, {"at": places, "bits": others}))
        order = [1, 0, *range(2, len(at))]  # two of one tile
        rows.append(("its bricks are out of order; run shard 1 of 1 again", {"at": at[order], "bits": bits[order]}))
        for why, arrays in rows:
            self.refuse_parts("rewritten.npz: damaged: " + why,
                              self.rewritten(plain if "bits" in arrays and "at" in arrays else path, **arrays))
        stored = readers.arrays(second)
        strange, (start, end) = stored["at"].copy(), stored["tiles"]
        strange[0] = 0
        for why, arrays in (("damaged: it has bricks outside its tiles; run shard 2 of 2", {"at": strange}),
                            ("begins with tile .* in place of .*: it was cut otherwise than the others; run shard 2 of 2",
                             {"tiles": np.array([start + 1, end], "<u8")}),
                            ("ends before the last tile", {"tiles": np.array([start, end - 1], "<u8")})):
            self.refuse_parts("rewritten.npz.*" + why, first, self.rewritten(second, **arrays))

    def coloured(self):
        """The mesh with a colour of each triangle."""
        points, count = TRIANGLES.reshape(-1, 3).tolist(), len(TRIANGLES)
        rows = ["%r %r %r" % tuple(p) for p in points] + ["3 %d %d %d %d 9 %d" % (3 * n, 3 * n + 1, 3 * n + 2, 20 * n, 255 - n)
                                                          for n in range(count)]
        return self.write("coloured.off", "OFF\n%d %d 0\n%s\n" % (len(points), count, "\n".join(rows)))

    def test_wholes(self):
        """A file of the whole becomes each other that holds as much, byte by byte as if that had been written at first."""
        holds = {each["word"]: each["holds"] for each in self.ask("info")["formats"]}
        grid = ("--cell", "0.05")
        for what, mesh, options in (("", self.mesh, ()), ("ids", self.mesh, ("--ids", "--deflate")),
                                    ("colours", self.coloured(), ("--colours",)),
                                    ("labels", self.mesh, ("--fill", "outside", "--labels"))):
            whole = self.path("whole.npz")
            self.succeed("voxelize", mesh, *grid, *options, "-q", "-o", whole)
            for word in harness.formats():
                to = ("--out-format", word, "-q", "-o")
                if what not in holds[word]:
                    self.fail_with(1, "whole.npz: has %s, and .%s holds none: write .npz.* or voxelize without --%s" %
                                   (what, word, what), "merge", whole, *to, self.path("x"))
                    continue
                own = [option for option in options if option != "--deflate"]
                self.succeed("voxelize", mesh, *grid, *own, *to, self.path("one"))
                self.succeed("merge", whole, *to, self.path("other"))
                one, other = read(self.path("one")), read(self.path("other"))
                if word == "vdb":
                    one, other = map(readers.without_vdb_id, (one, other))
                self.assertEqual(one, other, (word, what))

    def test_arrays_of_wholes(self):
        whole = self.path("whole.npz")
        self.succeed("voxelize", self.mesh, *GRID, "--ids", "-q", "-o", whole)
        stored = readers.arrays(whole)
        at, bits, ids = stored["at"], stored["bits"], stored["ids"]
        beyond, twice, cells = at.copy(), at.copy(), len(ids)
        beyond[3], twice[-1] = (49, 0, 0), twice[5]
        again = self.rewritten(whole, at=at[::-1], bits=bits[::-1], ids=ids[::-1])  # in another order: those of other cells
        self.succeed("merge", again, "-q", "-o", self.path("again.npz"))
        self.assertEqual(readers.arrays(self.path("again.npz"))["at"].tolist(), at[::-1].tolist())
        for why, arrays in (("it has bricks outside the grid", {"at": beyond}),
                            ("it ends early, or has a brick twice", {"at": twice}),
                            ("its ids are not those of its cells", {"ids": ids[1:]}),
                            ("it has ids that int32 does not hold", {"ids": ids + np.uint32(2 ** 31)}),
                            (None, {"inside": bits, "ids": None}),
                            ("cells are inside that are not set", {"inside": ~bits, "ids": None}),
                            ("its arrays do not fit its bricks", {"inside": bits[1:], "ids": None}),
                            ("its colours are not those of its cells", {"colours": np.zeros((cells - 1, 3), "u1"), "ids": None}),
                            ("what it says of the whole makes no sense", {"shift": np.array([0, NAN, 0])})):
            path = self.rewritten(whole, **arrays)
            if why:
                self.refuse_parts("rewritten.npz: damaged: %s; write it again" % why, path)
            else:
                self.succeed("merge", path, "-q", "-o", self.path("x.npz"))
        self.refuse_parts("has more than one of ids, inside and colours", self.rewritten(whole, inside=bits))
        self.refuse_parts("whole.npz: is no part of a whole; .* or one that is whole alone", whole, whole)

    def test_summary(self):
        parts = [self.part("%d/2" % n) for n in (1, 2)]
        self.assertRegex(self.succeed("merge", *parts, "-o", self.path("m.npy")),
                         r"(?m)^parts        2\ngrid         390 x 270 x 140 cells of .*\n"
                         r"occupied     \d+ cells\nbricks       \d+\nwritten  ")


class Partitions(Voxels):
    def setUp(self):
        super().setUp()
        pick = np.random.default_rng(SEED)
        reach = pick.choice([0.05, 0.05, 0.05, 0.3, 3], (2000, 1, 1))
        t = np.round(64 * (pick.uniform(-2.5, 2.5, (2000, 1, 3)) + reach * pick.uniform(-1, 1, (2000, 3, 3)))) / 64
        t[::150, 1, 2], t[75::300, 1, 2] = NAN, INF
        self.triangles, self.mesh, self.number, self.mask = t, self.mesh_of(t), 0, os.umask(0)
        os.umask(self.mask)

    def partition(self, *words, names=("index", "triangles")):
        """The bytes of both files, the summary and the folder."""
        self.number += 1
        folder = self.path("tiles%d" % self.number)
        result = harness.run("partition", *words, "--json", "-o", folder)
        self.assertEqual(result.code, 0, result.stderr)
        self.assertEqual(sorted(os.listdir(folder)), sorted(names))
        self.assertEqual(os.stat(folder).st_mode & 0o777, 0o777 & ~self.mask)
        return [read(os.path.join(folder, name)) for name in names], json.loads(result.stdout), folder

    def refuse_partition(self, code, pattern, *words, **how):
        there, result = self.there(), harness.run(*words, **how)
        self.assertEqual((result.code, self.there()), (code, there), result.stderr)
        self.assertRegex(result.stderr, r"\A(tribox [a-z]+: warning[^\n]*\n)?tribox [a-z]+: [^\n]*(" + pattern + r")[^\n]*\n\Z")

    def test_tiles(self):
        """Each has its triangles in the order of the mesh, those with a corner in its box among them, and records add up."""
        (index, triangles), found, folder = self.partition(self.mesh, *GRID, "-m", "9000")
        self.assertEqual((list(found), found["output"]), ("mesh inputs triangles positions not_finite grid tile "
                          "tiles filled_tiles sorted spilled_bytes threads "
                                                          "seconds output".split(), folder))
        t, cell = self.triangles, np.array([0.0101, 0.0145, 0.029])
        self.assertEqual(found["not_finite"], (~np.isfinite(t)).any((1, 2)).sum())
        self.assertEqual((found["grid"]["size"], found["tile"], found["tiles"]), (list(SIZE), 128, 24))
        of = {meshes.pack_floats(one): n for n, one in enumerate(t)}
        records = [struct.unpack_from("<4Q", index, at) for at in range(176, len(index), 32)]
        self.assertEqual(found["filled_tiles"], len(records))
        places = [record[1] for record in records] + [len(triangles) // 36]
        self.assertEqual(places[-1], found["sorted"])
        for (tile, first, _, _), end in zip(records, places[1:]):
            numbers = [of[triangles[36 * p:36 * p + 36]] for p in range(first, end)]
            self.assertEqual(numbers, sorted(set(numbers)), tile)
            at = np.array([tile % 4, tile // 4 % 3, tile // 12])
            low, high = -2 + 128 * at * cell, -2 + np.minimum(128 * at + 128, SIZE) * cell
            with_corner = ((low + 1e-6 < t) & (t < high - 1e-6)).all(2).any(1) & np.isfinite(t).all((1, 2))
            self.assertLessEqual(set(np.flatnonzero(with_corner).tolist()), set(numbers))

    def test_memory_and_threads(self):
        whole, found, _ = self.partition(self.mesh, *GRID)
        self.assertEqual(found["spilled_bytes"], 0)
        for memory, threads in itertools.product(("1", "3000", "40K", "600K", "1G"), "17"):
            files, found, _ = self.partition(self.mesh, *GRID, "-m", memory, "-t", threads)
            self.assertEqual((files, found["spilled_bytes"] > 0), (whole, memory not in ("600K", "1G")), (memory, threads))
        mesh = self.mesh_of([[[n / 1024, 0, 0], [0, 1 / 8, 0], [0, 0, 1 / 8]]
                             for n in range(1025)])  # all of them in one tile, one more than are written at once
        whole, _, _ = self.partition(mesh, "-r", "64")
        self.assertEqual(whole[1], read(mesh))
        for threads in "12":
            self.assertEqual(self.partition(mesh, "-r", "64", "-m", "1000", "-t", threads)[0], whole)

    def test_several_meshes(self):
        """Of any formats, in one grid around all; of floats and doubles; with a shift."""
        writers = {"f32": meshes.pack_floats, "stl": meshes.stl_binary, "off": meshes.off, "f64": meshes.pack_doubles}
        finite = self.triangles[np.isfinite(self.triangles).all((1, 2))]
        for t, options, endings in ((self.triangles, ("-r", "400"), ("f32", "stl", "f32", "stl")),
                                    (finite, ("-r", "400"), ("stl", "off", "f32")),
                                    (self.triangles, GRID, ("stl", "f64", "f32")),
                                    (finite + [5000, 70, -12], ("-r", "300", "--shift", "auto"), ("f64",) * 3),
                                    (finite + [5000, 70, -12], ("-r", "300", "--shift", "0.1,0.2,0.3"), ("f64", "f32"))):
            (whole, found, folder), paths = self.partition(self.write("all.f64", meshes.pack_doubles(t)), *options), []
            for n, (ending, some) in enumerate(zip(endings, np.array_split(t, len(endings)))):
                paths.append(self.write("piece%d.%s" % (n, ending), writers[ending](some)))
            for memory, threads in (("1G", "2"), ("20K", "3")):
                files, told, _ = self.partition(*paths, *options, "-m", memory, "-t", threads)
                if "f64" in endings or t is finite or t is self.triangles:
                    self.assertEqual(told["triangles"], len(t))
                if ("f64" in endings) == (found["positions"] == "float64") or "auto" in options:
                    self.assertEqual(files, whole, endings)

    def sorted_first(self, where, *words, ending=".npz", **how):
        """What voxelize writes with little memory, which it says, after it did so with enough; the same."""
        for memory, said in (("8G", ""), ("3000", "note: .*: larger than the memory for it, so its triangles are sorted into a "
                                          "temporary partition in %s\n" % where)):
            how["env"] = {"TMPDIR": "" if where != self.folder else where}
            out, there = self.path("sorted" + ending), self.there()
            result = harness.run("voxelize", *words, "-m", memory, "-o", out, **how)
            self.assertRegex(result.stderr, r"\A(tribox voxelize: warning.*\n)?%s(tribox voxelize: warning.*\n)?\Z" % (
                said and "tribox voxelize: " + said))
            self.assertEqual((result.code, self.there()), (0, sorted(there + [out])), words)
            cells = read(out)
            os.remove(out)
            whole = whole if said else cells
            self.assertEqual(cells, whole, (words, memory))
            yield cells

    def test_sorted_first(self):
        """A mesh that is larger than --memory: the same file as with enough, and nothing left beside it."""
        far, finite = np.array(self.triangles) + 1e6, TRIANGLES
        stl, ply = self.write("m.stl", meshes.stl_binary(self.triangles)), self.write("m.ply", meshes.ply_of(finite))
        wide = self.write("wide.ply", meshes.ply_of(far[np.isfinite(far).all((1, 2))] + 0.1, kind="double"))
        grid = grid_of("0.0154,0.0286,0.031", "-2,-2,-2", "260,140,130")  # 3 x 2 x 2 tiles
        for mesh, options, endings in ((self.mesh, (), ("npz", "nrrd", "obj")), (self.mesh, ("--ids",), ("npz", "npy")),
                                       (self.mesh, ("--fill", "outside", "--labels"), ("npz", "nrrd")),
                                       (self.mesh, ("--shard", "2/3"), ("npz",)), (stl, (), ("npz",)), (ply, (), ("npz",))):
            for ending in endings:
                list(self.sorted_first(self.path(""), mesh, *grid, *options, ending="." + ending))
        for mesh, *options in ((self.mesh, "-r", "200"), (wide, "-r", "200"), (wide, "-r", "200", "--shift", "auto"),
                               (self.mesh_of(far, "far"), "-r", "200", "--shift", "auto"), (stl, "-c", "0.02", "--shift", "1,2,3")):
            list(self.sorted_first(self.folder, mesh, *options))
        text = self.write("text.obj", meshes.obj(finite))
        self.assertEqual(self.out("voxelize", text, *grid, "-m", "3000"), self.out("voxelize", text, *grid))

    def test_sorted_first_of_a_pipe(self):
        """Less than a block, and more than memory has room for at first, and later; shifted, and as doubles."""
        for count, memory, (form, pack) in itertools.product(
                (100, 150000), (1000, 3 << 20, 9 << 20),
                (("f32", meshes.pack_floats), ("stl", meshes.stl_binary), ("f64", lambda t: meshes.pack_floats(t, "<f8")))):
            pick = np.random.default_rng(SEED)  # each triangle has cells of its own
            t = pick.uniform(-2, 2, (count, 1, 3)) + pick.uniform(-0.01, 0.01, (count, 3, 3))
            mesh, words = pack(t), (*GRID, "--ids") if count < 1000 else GRID
            path, pipe = self.write("m." + form, mesh), ("voxelize", "-", "--format", form)
            whole, out = self.out("voxelize", path, *words), self.path("piped.npz")
            result = harness.run(*pipe, *words, "-m", str(memory), "-o", out, stdin=mesh)
            room = 65536 * (72 if form == "f64" else 36)  # at first, then twice as much and what is copied
            self.assertEqual((result.code, read(out) == whole, "sorted" in result.stderr),
                             (0, True, count > (0 if memory < room else 65536 if memory < 3 * room else 131072)), (memory, form))
            os.remove(out)
        result = harness.run(*pipe, *GRID, "--shift", "1,2,3", "-m", "1000", "-o", out, stdin=mesh)
        self.assertEqual((result.code, read(out)), (0, self.out("voxelize", path, *GRID, "--shift", "1,2,3")))
        self.fail_with(1, "stdin: truncated", *pipe, *GRID, "-q", "-m", "1000", "-o", out + "x.npz", stdin=mesh[:-1])  # of doubles

    def test_sorted_first_in_vain(self):
        """The disk is full, or there is no such folder: a line, and nothing is left."""
        out, place = self.path("x.npz"), r"the temporary partition in .* \(TMPDIR names the folder\): cannot write "
        for mesh, stdin in ((self.mesh, b""), ("-", read(self.mesh))):
            words = ("voxelize", mesh, "--format", self.mesh[-3:], *GRID, "-q", "-m", "3000", "-o", out)
            for size in (50, 5000, 30000):
                self.fail_with(1, place + "all of it: File too large; nothing of it was kept", *words, stdin=stdin,
                               limit=(resource.RLIMIT_FSIZE, size))
            self.fail_with(1, place + "there: No such file", *words, stdin=stdin, env={"TMPDIR": self.path("none")})

    @harness.unless_sanitized
    def test_little_memory(self):
        """Six million triangles, 216 MB, within 80000 KiB: as a file, as a pipe, and as a partition, which is read then."""
        limit, path = self.need_limit(resource.RLIMIT_AS, 80000 << 10), self.path("big.f32")
        with open(path, "wb") as file:
            for _ in range(600):
                file.write(meshes.pack_floats(np.resize(SMALL, (10000, 3, 3))))
        words = ("-r", "512", "--ids")
        whole = self.out("voxelize", path, *words)
        with open(path, "rb") as stdin:
            self.assertEqual(self.out("voxelize", "-", "--format", "f32", *words, stdin=stdin, limit=limit), whole)
        self.assertEqual(self.out("voxelize", path, *words, limit=limit), whole)
        process = harness.start("voxelize", path, "-r", "512", "-q", "-m", "40M", "-o", self.path("m.npz"))
        with process.stderr:
            self.assertEqual(process.stderr.read(), b"")
        _, process.returncode, usage = os.wait4(process.pid, 0)
        self.assertEqual(process.returncode, 0)
        self.assertLess(usage.ru_maxrss, 130 << 10)  # pages of a map would count, too
        self.succeed("partition", path, *words, "-q", "-o", self.path("t"), limit=limit)
        self.assertEqual(self.out("voxelize", self.path("t"), "--ids", limit=limit), whole)
        for name, mesh in (("a", path), ("b", self.mesh_of(SMALL + 0.1, "wide"))):  # floats, which become doubles, and doubles
            self.succeed("partition", mesh, *GRID, "--ids", "-q", "-o", self.path(name))
        both = ("voxelize", self.path("a"), self.path("b"), "--ids")
        self.assertEqual(self.out(*both, limit=limit), self.out(*both))
        with open(self.path("a/numbers"), "r+b") as file:
            file.seek(4000000)
            file.write(b"xxxx")
        self.refuse_partition(1, "a: damaged: the checksum of its triangles does not match", *both[:2], "--count", limit=limit)

    def test_layouts_of_ply(self):
        """Faces that refer to vertices anywhere; one element more, of nothing, has the file read as a whole."""
        pick = np.random.default_rng(SEED)
        names = {"f": "float", "d": "double", "B": "uchar", "H": "ushort", "i": "int", "I": "uint"}
        some = [pick.integers(0, 250, n).tolist() for n in pick.choice([0, 1, 2, 3, 3, 3, 3, 3, 4, 5, 9], 4500)]
        layouts = [(*how, some if how[1:] == ("f", "i", "B") else some[:400])
                   for how in itertools.product("<>", "fd", "BHiI", "Bi")]
        layouts.append(("<", "f", "i", "i", [pick.integers(0, 250, n).tolist() for n in (3, 300, 3, 1000, 4, 90)]))
        for order, number, index, count, faces in layouts:
            vertices = np.round(64 * pick.uniform(-2, 2, (250, 3))) / 64 + (1 / 3 if number == "d" else 0)
            elements = [("vertex", [*((axis, names[number]) for axis in "zxy"), ("red", "uchar")],
                         [[*v, 77] for v in vertices.tolist()]),
                        ("face", [("flags", "ushort"), ("vertex_indices", names[count], names[index]), ("area", "float")],
                         [[5, f, 0.5] for f in faces])]
            form = "binary_%s_endian" % {"<": "little", ">": "big"}[order]
            mapped = self.write("mapped.ply", meshes.ply(elements, form))
            whole = self.write("whole.ply", meshes.ply([*elements, ("nothing", [("nothing", "int")], [])], form))
            for options in (GRID, ("-r", "300"), ("-r", "300", "--shift", "0.5,0.25,1"))[:3 if len(faces) == 4500 else 1]:
                expected = self.partition(whole, *options)[0]
                for memory, threads in (("1", "3"), ("30K", "2"), ("1G", "1")):
                    self.assertEqual(self.partition(mapped, *options, "-m", memory, "-t", threads)[0], expected,
                                     (order, number, index, count))
        good, one = read(mapped), [("vertex", meshes.XYZ, [[0, 0, 0]] * 250)]
        for content, why in ((good[:-1], "truncated: the header promises 6"),
                             (good.replace(b"element v", b"elemental v"), "'elemental vertex 250' in its header is not understood"),
                             *((meshes.ply([*one, ("face", meshes.CORNERS, faces)]), why) for faces, why in (
                                 ([[[0, 1, 2]]] * 9 + [[[0, 250, 1]]], "face 9 refers to vertex 250"),
                                 ([[[0, 1, 2]], [[0, -1, 1]]], "face 1 refers to vertex -1"),
                                 ([[[0, 1]]], "contains no triangles")))):
            self.refuse_partition(1, "bad.ply: .*" + why, "partition", self.write("bad.ply", content), *GRID, "-o", self.path("x"))

    def test_refused(self):
        piece, other = self.mesh_of(self.triangles[:300], "a"), self.mesh_of(self.triangles[300:], "b")
        here = self.partition(piece, *GRID)[2]
        named = self.partition(piece, *GRID, "--ids", names=("index", "numbers", "triangles"))[2]
        x, never = self.path("x"), self.mesh_of(np.full((3, 3, 3), NAN), "never")
        for differing, options in (("grid", grid_of("0.0101,0.0145,0.03", "-2,-2,-2", "390,270,140")),
                                   ("shift", (*GRID, "--shift", "1,2,3"))):
            there = self.partition(other, *options)[2]
            for command in (("partition", "-o", x), ("voxelize", "--shard", "1/2", "-o", x + ".npz")):
                self.refuse_partition(1, "do not fit together: they differ in the " + differing, *command, here, there)
        there, copied = self.partition(other, *GRID)[2], shutil.copytree(here, self.path("copied"))
        for again in (here, os.path.join(here, "..", os.path.basename(here)), copied):
            for command in (("partition", "-o", x), ("voxelize", "--count")):
                self.refuse_partition(1, "tiles1 and %s are the same partition; give it once" % re.escape(again), *command, here,
                                      there, again)
        for code, why, *words in (
                (2, "is a partition and .* is a mesh: give meshes alone or partitions alone", "partition", here, self.mesh, "-o", x,
                 *GRID),
                (2, "is no partition", "voxelize", here, self.mesh, "-o", x + ".npz"),
                (2, "one mesh at a time", "voxelize", self.mesh, here, "-o", x + ".npz", *GRID),
                (1, "none of its triangles has finite coordinates", "partition", never, *GRID, "-o", x),
                (1, "none of their triangles has finite coordinates", "partition", never, never, "-r", "9", "-o", x),
                (1, "none.f32: cannot open the mesh file", "partition", self.mesh, self.path("none.f32"), *GRID, "-o", x),
                (1, "has no numbers of its triangles; make it with 'tribox partition --ids'", "voxelize", here, "--ids", "-o",
                 x + ".npz"),
                (1, "has the numbers of its triangles and .* has none; make both with --ids, or neither", "voxelize", here, named,
                 "--ids", "-o", x + ".npz"),
                (1, "has the numbers of its triangles and .* has none; make both with --ids, or neither", "partition", here, named,
                 "-o", x),
                (2, "which has ids or has none: leave out --ids", "partition", named, "--ids", "-o", x),
                (1, os.path.basename(here) + ": is there already; remove it, or give another name", "partition", piece, "-r", "9",
                 "-o", here),
                (1, "none/x: cannot write there: No such file", "partition", piece, "-r", "9", "-o", self.path("none/x")),
                (1, "is no partition|no partition: ", "voxelize", self.folder, "--count")):
            self.refuse_partition(code, why, *words)
        for memory, limit in itertools.product(("1G", "3000"), (500, 5000, 30000)):
            self.refuse_partition(1, "x: cannot write all of it: File too large; nothing of it was kept", "partition", self.mesh,
                                  *GRID, "-m", memory, "-o", x,
                                  limit=(resource.RLIMIT_FSIZE, limit))
        self.refuse_partition(1, "x: cannot write all of it: File too large", "partition",
                              self.mesh_of([((0, 0, 0), (1, 0, 0), (0, 1, 1))], "one"), "-r", "9",
                              "-o", x, limit=(resource.RLIMIT_FSIZE, 100))  # for its index alone

    def test_damaged(self):
        """A changed byte is named, wherever it is."""
        pieces = [self.mesh_of(some, "piece%d" % n) for n, some in enumerate(np.array_split(self.triangles, 3))]
        apart = [self.partition(piece, *GRID, "--ids", names=("index", "numbers", "triangles"))[2] for piece in pieces]
        x = self.path("x.npz")

        def each(pattern, *commands):
            for command in commands or (("voxelize", apart[1], "--count"), ("partition", *apart, "-o", x)):
                self.refuse_partition(1, "(tiles2: )?(damaged: )?(%s)" % pattern, *command)
        for name in ("index", "triangles", "numbers"):
            path = os.path.join(apart[1], name)
            whole, not_index = read(path), name != "index"
            for at in [*range(0, 176, 7), *range(176, len(whole), len(whole) // 40)][25 * not_index:]:
                flipped = bytearray(whole)
                flipped[at] ^= 1 << at % 8
                self.write(path, bytes(flipped))
                each("the checksum of its triangles does not match" if not_index else
                     "damaged: .*; make the partition again|not a partition folder|another byte order",
                     ("voxelize", apart[1], *["--ids"] * not_index,
                      *(("-o", x) if not_index else ("--count",))))
            if not_index:
                each(os.path.basename(apart[1]) + ": damaged: the checksum of its triangles does not match",
                     ("partition", *apart, "-m", "1000", "-o", x),
                     ("voxelize", *apart, "--ids", "-o", x))
                self.write(path, whole[:-4])
                each("its %s are not as many as its index says" % name)
            else:
                for cut in (0, 100, len(whole) - 1):
                    self.write(path, whole[:cut])
                    each("its index has")
            self.write(path, whole)


if __name__ == "__main__":
    harness.main()
