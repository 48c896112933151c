"""Where the answer goes: full and closed outputs, files that get in each other's way, and locales with a decimal comma."""

import fcntl
import itertools
import json
import os
import random
import re
import shutil
import struct
import subprocess
import time

import triangles as meshes
import harness


class Output(harness.TestCase):
    def setUp(self):
        super().setUp()
        self.mesh = self.write("mesh.obj", meshes.obj([((0, 0, 0), (1.5, 0, 0), (0, 1.5, 0))] * 3000))
        self.commands = [("--help",), ("--version",), ("info",), ("info", "--json"), ("info", "--help"), ("demo", "--help"),
                         ("demo", "--quick"), ("sweep", self.mesh, "--quick"), ("overlap", "--help")]
        self.commands += [("overlap", self.mesh, "--box", harness.UNIT_BOX, *more)
                          for more in ((), ("--list",), ("--json",), ("-o", "-"))]

    def test_full_and_closed(self):
        places = (">/dev/full", ">&-")[not os.path.exists("/dev/full"):]
        for command, redirection in itertools.product(self.commands, places):
            done = subprocess.run(["sh", "-c", 'exec "$0" "$@" ' + redirection, harness.program(), *command], capture_output=True,
                                  timeout=120)
            self.assertEqual(done.returncode, 1, command)
            self.assert_one_line(done.stderr.decode(), "cannot write the output: ")

    def test_lost_on_the_way(self):
        """A pipe has no room for the blocks, and some for what is left of the list after them."""
        if not hasattr(fcntl, "F_SETPIPE_SZ"):
            self.skipTest("pipes keep their size here")
        reader, writer = os.pipe()
        fcntl.fcntl(writer, fcntl.F_SETPIPE_SZ, 4096)
        os.set_blocking(writer, False)
        os.write(writer, b"x")
        result = harness.run("overlap", self.mesh, "--box", harness.UNIT_BOX, "--list", stdout=writer)
        os.close(reader)
        os.close(writer)
        self.assertEqual(result.code, 1)
        self.assert_one_line(result.stderr, "cannot write the output: ")

    def test_streaming_stops(self):
        """With the output gone, the rest of the boxes is not worked through."""
        if not os.path.exists("/dev/full"):
            self.skipTest("no /dev/full here")
        boxes = self.write("boxes.txt", "0 0 0 1 1 1\n" * 3 + "wrong\n")
        with open("/dev/full", "wb") as full:
            done = harness.run("overlap", self.mesh, "--boxes", boxes, stdout=full)
        self.assertEqual(done.code, 1)
        self.assert_one_line(done.stderr, "cannot write the output: ")


WAYS = {"itself": lambda path, _: path, "folder": lambda path, _: os.path.join(os.path.dirname(path), ".", os.path.basename(path)),
        "hard": lambda path, link: os.link(path, link) or link, "symbolic": lambda path, link: os.symlink(path, link) or link}


class Pairs(harness.TestCase):
    """Files that get in each other's way."""

    def contents(self):
        return {path: harness.read(path) for path in self.there() if os.path.isfile(path)}

    def commands(self):
        """Each with what it reads and its options for files."""
        triangles, cells = meshes.lattice_triangles(40, seed=1), ("-o", "--preview")
        mesh, stream = self.write("m.ply", meshes.ply_of(triangles)), self.write("s.f32", meshes.pack_floats(triangles))
        obj = self.write("m.obj", b"mtllib m.mtl\nusemtl a\n" + meshes.obj(triangles))
        materials, tiles, grid = self.write("m.mtl", "newmtl a\nKd 1 0 0\n"), self.path("tiles"), ("-r", "20")
        parts, raw = [self.path("1.part.npz"), self.path("2.part.npz")], ("--out-format", "raw")
        self.succeed("partition", mesh, *grid, "--ids", "-q", "-o", tiles)
        for n, part in enumerate(parts, 1):
            self.succeed("voxelize", mesh, *grid, "--shard", "%d/2" % n, "-q", "-o", part)
        yield ("overlap", mesh, "--box", harness.UNIT_BOX), [mesh], ("-o", "--rest")
        yield ("voxelize", mesh, *grid, *raw), [mesh], cells
        yield ("voxelize", "-", "--format", "f32", *grid, *raw), [stream], cells
        yield ("voxelize", obj, "--colours", *grid, "--out-format", "vox"), [obj, materials], cells[:1]
        if not harness.lacks("libassimp"):
            document, data = meshes.gltf_document(triangles, [{}])
            document["buffers"][0]["uri"] = "m.png"
            scene, buffer = self.write("m.gltf", json.dumps(document)), self.write("m.png", data)
            yield ("voxelize", scene, *grid, *raw), [scene, buffer], cells
        yield ("voxelize", tiles, *raw), [self.path("tiles", name) for name in ("index", "triangles", "numbers")], cells
        yield ("merge", *parts, *raw), parts, cells

    def refuse(self, pattern, one, command, *options):
        """Under every name that the file can have, the last word of the options."""
        before = self.contents()
        for way, give in WAYS.items():
            if way == "hard" and os.path.dirname(one) != self.folder:
                continue  # a partition does not lose its own name of the file
            link = self.path("link" + os.path.splitext(one)[1])
            with open(self.stdin, "rb") as stdin:
                done = harness.run(*command, *options, give(one, link), stdin=stdin)
            self.assertEqual(done.code, 2, (command, options, done.stderr))
            self.assert_one_line(done.stderr, pattern)
            if os.path.lexists(link):
                os.remove(link)
            self.assertEqual(self.contents(), before)

    def test_pairs(self):
        """No command writes over what it reads, nor two of its files as one."""
        for command, reads, options in self.commands():
            self.stdin, ending = reads[0], ".ply" if options[-1] == "--rest" else ".png"
            old = self.write("old" + ending, "what was there")
            for one in reads:
                for option in options:
                    first = () if option == "-o" else ("-o", self.path("x.ply"))
                    self.refuse("is the (mesh|part|file of its .*) itself|is in .*, which is read", one, command, *first, option)
            if len(options) == 2:
                self.refuse("-o and %s are one file, '.*'; give two names" % options[1], old, command, "-o", old, options[1])

    def test_both_or_neither(self):
        """The last name cannot be given: it is too long."""
        mesh, part, rest = (self.write("m.ply", meshes.ply_of(meshes.lattice_triangles(40, seed=1))), self.path("part.ply"),
                            self.path("x" * (os.pathconf(self.folder, "PC_NAME_MAX") - 3) + ".ply"))
        for before in (None, "what was there"):
            if before:
                self.write("part.ply", before)
            there = self.contents()
            self.fail_with(1, "x.ply: cannot write all of it: File name too long; nothing of it was kept", "overlap", mesh, "--box",
                           harness.UNIT_BOX, "-o", part, "--rest", rest)
            self.assertEqual(self.contents(), there)
        self.succeed("overlap", mesh, "--box", harness.UNIT_BOX, "-o", part, "--rest", self.path("rest.ply"))
        self.assertEqual(sorted(os.listdir(self.folder)), ["m.ply", "part.ply", "rest.ply"])

    def change(self, process, path, change, there):
        """Changes a file while the program runs."""
        change(path)
        _, error = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 1, error)
        self.assert_one_line(error.decode(), os.path.basename(path) + ": has changed while it was read; nothing was kept$")
        self.assertEqual(sorted(os.listdir(self.folder)), there)

    def test_changed_meshes(self):
        """Cut, as most programs begin to save, or of another time, while somebody is waited for to read more of what is written."""
        triangles = meshes.lattice_triangles(6000, seed=1)
        for name, write in (("m.ply", meshes.ply_of), ("t.ply", meshes.FORMATS["ascii.ply"]), ("m.obj", meshes.obj),
                            ("m.off", meshes.off),
                            ("m.stl", meshes.stl_binary), ("t.stl", meshes.stl_ascii), ("m.f32", meshes.pack_floats)):
            for change in (lambda path: os.utime(path, (0, 0)), lambda path: os.truncate(path, 0)):
                mesh = self.write(name, write(triangles))
                there = sorted(os.listdir(self.folder))
                process = harness.start("overlap", mesh, "--box=-9,-9,-9,9,9,9", "-o", "-", "--rest", self.path("x" + name[1:]),
                                        stdout=subprocess.PIPE)
                process.stdout.read(1000)
                time.sleep(0.1)
                self.change(process, mesh, change, there)

    def test_changed_partitions(self):
        mesh, tiles = self.write("m.ply", meshes.ply_of(meshes.lattice_triangles(300, seed=1))), self.path("tiles")
        self.succeed("partition", mesh, "-r", "3000", "-q", "-o", tiles)
        there = sorted(os.listdir(self.folder))
        process = harness.start("voxelize", tiles, "-t", "1", "-q", "-o", self.path("x.npz"))
        self.wait_for(lambda: sorted(os.listdir(self.folder)) != there, process)
        self.change(process, self.path("tiles", "triangles"), lambda path: os.truncate(path, 0), there)


class Json(harness.TestCase):
    def test_paths(self):
        """Whatever bytes a path has, they can be had back from the object."""
        names = [b'quote" backslash\\ tab\t line\n',
                 "umlaut \u00fc, euro \u20ac, clef \U0001d11e, end \U0010ffff".encode(),
                 b"byte \xff\x80",
                 b"cut \xe2\x82", b"cut \xf0\x9d\x84 here", b"overlong \xc0\xaf \xe0\x80\xaf",
                 b"surrogate \xed\xa0\x80\xed\xb0\x80",
                 b"beyond \xf4\x90\x80\x80 \xf8\x88\x80\x80\x80",
                 bytes(range(1, 47)) + bytes(range(48, 128)), bytes(range(128, 256))]
        for name in names:
            path = self.write(os.fsdecode(name), bytes(36))
            found = self.ask("overlap", path, "--format", "f32", "--box", harness.UNIT_BOX)
            self.assertEqual(found["mesh"].encode("utf-8", "surrogateescape"), os.fsencode(path))


class Numbers(harness.TestCase):
    """The shortest decimals that read back as the same floats."""

    def setUp(self):
        super().setUp()
        self.mesh = self.write("mesh.obj", meshes.obj([((0, 0, 0), (1, 0, 0), (0, 1, 0))]))

    def printed(self, bound):
        bounds = "0,0,0,%s,1,1" % bound
        text = self.succeed("overlap", self.mesh, "--box", bounds)
        found = re.search(r"(?m)^box +0,0,0,(.*),1,1$", text).group(1)
        self.assertIn('"hi": [%s, 1, 1]' % found, self.succeed("overlap", self.mesh, "--box", bounds, "--json"))
        return found

    def test_forms(self):
        for bound in ("0", "10", "50", "557820", "5108010.5", "0.1", "0.00001", "0.000123", "100000000", "123456792", "999999936",
                      "1e+09", "3.4028235e+38", "9.9999e-06", "1e-45", "1.5"):
            self.assertEqual(self.printed(bound), bound)
        self.assertEqual(self.printed("0.30000001"), "0.3")
        for bound in ("16777217", "0.123456789012", "5108010.123456789", "3.5e+38", "1.7976931348623157e+308"):
            self.assertEqual(self.printed(bound), bound)

    def test_read_back(self):
        random_numbers = random.Random(1)
        numbers = [struct.unpack("<f", struct.pack("<I", random_numbers.randrange(1, 0x7f800000)))[0] for _ in range(2000)]
        boxes = self.write("boxes.txt", "".join("0 0 0 %.9g 1 1\n" % number for number in numbers))
        lines = self.succeed("overlap", self.mesh, "--boxes", boxes).splitlines()
        self.assertEqual(len(lines), len(numbers))
        for number, line in zip(numbers, lines):
            text = line.split(",")[3]
            self.assertEqual(struct.pack("<f", float(text)), struct.pack("<f", number), text)
            self.assertEqual("e" in text, not 1e-5 <= number < 1e9, text)
            self.assertLessEqual(len(text.split("e")[0].replace(".", "").strip("0")), 9)


class Locale(harness.TestCase):
    def make_locale(self):
        """Compiles a German locale into the test's folder; None where that cannot be done."""
        if not shutil.which("localedef"):
            return None
        subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", os.path.join(self.folder, "de_DE.UTF-8")], capture_output=True)
        env = {"LOCPATH": self.folder, "LC_ALL": "de_DE.UTF-8"}
        told = subprocess.run(["locale", "decimal_point"], capture_output=True, env={**os.environ, **env})
        return env if told.stdout.strip() == b"," else None

    def test_decimal_comma(self):
        env = self.make_locale()
        if env is None:
            self.skipTest("no locale with a decimal comma can be made here")
        triangles = [((0.125, 0.5, 0), (0.125, 0.5, 0), (0.125, 0.5, 0))]
        for name in ("text.obj", "ascii.ply", "ascii.stl", "text.off", "text.gltf"):
            mesh = self.write(name, meshes.FORMATS[name](triangles))
            for how in ({}, {"env": env}):
                answer = self.ask("overlap", mesh, "--box", "0.125,0.5,0,0.125,0.5,0.25", **how)
                self.assertEqual((answer["overlapping"], answer["box"]["hi"]), (1, [0.125, 0.5, 0.25]))
            self.assertIn("0.125,0.5,0,", self.succeed("overlap", mesh, "--box", "0.125,0.5,0,1,1,1", env=env))


if __name__ == "__main__":
    harness.main()
