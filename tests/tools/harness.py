"""Runs the program tribox and looks at what it returns and leaves; the tests of all areas share it."""

import contextlib
import functools
import importlib
import json
import os
import pty
import re
import resource
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np
import triangles as meshes

SEED = int(os.environ.get("TRIBOX_TEST_SEED", "1"))
MIB = 1 << 20
UNIT_BOX = "-0.5,-0.5,-0.5,0.5,0.5,0.5"
UNIT_ORIENTED = "0,0,0,0.5,0.5,0.5,1,0,0,0,1,0,0,0,1"

# For what says nothing new about memory and takes long where a sanitizer looks at each access.
SANITIZED = bool(os.environ.get("TRIBOX_SANITIZED"))
unless_sanitized = unittest.skipIf(SANITIZED, "a build with a sanitizer")
ways = set()


def surroundings(arguments, env):
    """The environment of a run. A sanitizer looks for leaks, which takes as long as ten runs, once for each set of options."""
    way = frozenset("".join(re.findall("^-+[a-z-]+|[.][a-z]+[0-9]*$", argument)) for argument in arguments)
    is_known = SANITIZED and way in ways
    ways.add(way)
    return {**os.environ, **({"ASAN_OPTIONS": "detect_leaks=0"} if is_known else {}), **(env or {})}


def program():
    return os.environ["TRIBOX_PROGRAM"]


def read(path):
    with open(path, "rb") as file:
        return file.read()


def text_of(numbers):
    """As an option has them, in so many digits that they are doubles to any mesh."""
    return ",".join("%.17g" % x for x in numbers)


class Result:
    def __init__(self, code, stdout, stderr):
        self.code, self.octets, self.stderr = code, stdout, stderr.decode()

    @property
    def stdout(self):
        return self.octets.decode()


def run(*arguments, stdin=b"", env=None, limit=None, cwd=None, stdout=subprocess.PIPE):
    """Runs tribox with these arguments to its end. stdin: bytes or a file. limit: a resource and how much, as for setrlimit."""
    given = {"input": stdin} if isinstance(stdin, bytes) else {"stdin": stdin}
    done = subprocess.run([program(), *arguments], **given, stdout=stdout, stderr=subprocess.PIPE, timeout=120, cwd=cwd,
                          env=surroundings(arguments, env),
                          preexec_fn=None if limit is None else lambda: resource.setrlimit(limit[0], (limit[1], limit[1])))
    return Result(done.returncode, done.stdout or b"", done.stderr)


def start(*arguments, **how):
    """The program as a process; what it says goes to a pipe."""
    return subprocess.Popen([program(), *arguments], **{"stderr": subprocess.PIPE, **how})


@functools.lru_cache
def kernels():
    return json.loads(run("info", "--json").stdout)["kernels"]


@functools.lru_cache
def formats():
    """The words of --out-format, as the program lists them, of those that can be written here."""
    words = [each["word"] for each in json.loads(run("info", "--json").stdout)["formats"]]
    return [word for word in words if word != "vdb" or not lacks("OpenVDB")]


@functools.lru_cache
def lacks(part):
    """Whether the program was built without libassimp, OpenVDB or libpng."""
    with tempfile.TemporaryDirectory() as folder:
        mesh, out = os.path.join(folder, "mesh.f32"), os.path.join(folder, "x")
        for path, content in ((mesh, bytes(36)), (mesh + ".gltf", b"{}")):
            with open(path, "wb") as file:
                file.write(content)
        words = {"libassimp": ("overlap", mesh + ".gltf", "--box", UNIT_BOX),
                 "OpenVDB": ("voxelize", mesh, "-c", "1", "-o", out + ".vdb"),
                 "libpng": ("voxelize", mesh, "-c", "1", "-o", out + ".npy", "-p", out + ".png")}[part]
        return "built without" in run(*words).stderr


class TestCase(unittest.TestCase):
    """A test with a folder of its own for the files that it writes."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, content):
        path = self.path(name)
        if path.endswith((".gltf", ".glb")):
            self.need("libassimp")
        with open(path, "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return path

    def need(self, part):
        if lacks(part):
            self.skipTest("built without " + part)

    def module(self, name):
        """One of another program's, which may be missing."""
        try:
            return importlib.import_module(name)
        except ImportError as error:
            return self.skipTest(error)

    def there(self):
        """All that is in the folder."""
        return sorted(os.path.join(folder, name) for folder, folders, names in os.walk(self.folder) for name in folders + names)

    def succeed(self, *arguments, note=None, **how):
        """Runs tribox, which has to succeed, in silence or with one line of a note; returns its standard output."""
        result = run(*arguments, **how)
        self.assertEqual(result.code, 0, (arguments, result.stderr))
        if note is None:
            self.assertEqual(result.stderr, "", arguments)
        else:
            self.assert_one_line(result.stderr, note)
        return result.stdout

    def ask(self, *arguments, **how):
        """The same as JSON."""
        return json.loads(self.succeed(*arguments, "--json", **how))

    def foreign(self, program, *paths):
        """What another program reads from these files (foreign.py), as lists and numbers."""
        foreign = self.module("foreign")
        try:
            return json.loads(json.dumps([getattr(foreign, "with_" + program)(path) for path in paths]))
        except ImportError as error:
            return self.skipTest(error)

    def overlap(self, mesh, box, *options, **how):
        """The answer about one box, its list included; of a box of fifteen numbers as of an oriented one."""
        box = box if isinstance(box, str) else text_of(box)
        return self.ask("overlap", mesh, "--oriented" if box.count(",") == 14 else "--box", box, "--list", *options, **how)

    def answers(self, mesh, boxes, *options, **how):
        """The answers about boxes, a list each, or the text of them."""
        lines = boxes if isinstance(boxes, bytes) else "".join(text_of(box) + "\n" for box in boxes).encode()
        text = self.succeed("overlap", mesh, "--boxes", "-", "--json", *options, stdin=lines, **how)
        return [json.loads(line) for line in text.splitlines()]

    def out(self, *arguments, ending=".npz", **how):
        """The bytes of the file that a command writes by -o."""
        path = self.path("out" + ending)
        self.succeed(*arguments, "-q", "-o", path, **how)
        return read(path)

    def fail_with(self, code, pattern, *arguments, stdout_is="", **how):
        """Runs tribox, which has to print one line on standard error and nothing else, and to leave no file."""
        there = self.there()
        result = run(*arguments, **how)
        self.assertEqual(result.code, code, (arguments, result.stderr))
        self.assertEqual(result.stdout, stdout_is, arguments)
        self.assert_one_line(result.stderr, pattern)
        self.assertEqual(self.there(), there, arguments)

    def refuse(self, code, command, rows, **how):
        """The same for each row: a pattern, and the words after the command; the code 2 goes with a hint at the help."""
        for pattern, *words in rows:
            with self.subTest(pattern=pattern, words=words):
                hint = ".*see 'tribox %s --help'" % command if code == 2 else ""
                self.fail_with(code, "^tribox %s: (.* )?(%s)" % (command, pattern) + hint, command, *words, **how)

    def assert_one_line(self, stderr, pattern):
        self.assertRegex(stderr, pattern)
        self.assertRegex(stderr, r"\Atribox[^\n]*: [^\n]+\n\Z")

    def wait_for(self, is_true, process=None):
        """Until it is, or the process ends."""
        deadline = time.monotonic() + 60
        while not is_true() and (process is None or process.poll() is None) and time.monotonic() < deadline:
            time.sleep(0.001)

    def need_limit(self, kind, least):
        """A limit that the program needs to run at all is none to test with."""
        if run("info", limit=(kind, least)).code:
            self.skipTest("this build needs more than %d MiB by itself" % (least >> 20))
        return kind, least

    def on_terminal(self, *arguments, meanwhile=lambda process: None, **how):
        """What is said on standard error where that is a terminal."""
        leader, follower = pty.openpty()
        process = start(*arguments, stderr=follower, stdout=subprocess.DEVNULL, **how)
        os.close(follower)
        meanwhile(process)
        said = b""
        with contextlib.suppress(OSError):  # Linux ends a terminal without a writer so
            while part := os.read(leader, 65536):
                said += part
        os.close(leader)
        self.assertEqual(process.wait(60), 0)
        return said.decode()


def grid_of(cell, origin, size):
    return ("--cell", cell, "--origin=" + origin, "--size", size)


class Voxels(TestCase):
    def mesh_of(self, triangles, name="mesh"):
        """Floats as such where they are, else doubles."""
        t = np.array(triangles, float)
        is_float = np.array_equal(t, meshes.floats(t), equal_nan=True)
        return self.write(name + (".f32" if is_float else ".f64"), meshes.pack_floats(t, "<f4" if is_float else "<f8"))

    def voxelize(self, *words, ending=".npz", **how):
        """The path and the answer."""
        path = self.path("cells" + ending)
        return path, self.ask("voxelize", *words, "-o", path, **how)


def main():
    """The program is the last argument; others go to unittest."""
    os.environ["TRIBOX_PROGRAM"] = os.path.abspath(sys.argv.pop())
    print("seed", SEED)
    unittest.main()
