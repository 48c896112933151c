"""Runs the program tribox and looks at what it returns; the tests of all areas share it."""

import functools
import json
import os
import resource
import subprocess
import sys
import tempfile
import unittest

DEBIAN = "/usr/bin/python3"
FOREIGN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "foreign.py")
UNIT_BOX = "-0.5,-0.5,-0.5,0.5,0.5,0.5"
UNIT_ORIENTED = "0,0,0,0.5,0.5,0.5,1,0,0,0,1,0,0,0,1"


def program():
    return os.environ["TRIBOX_PROGRAM"]


class Result:
    def __init__(self, code, stdout, stderr):
        self.code, self.stdout, self.stderr = code, stdout, stderr


def run(*arguments, stdin=b"", env=None, limit=None, cwd=None):
    """Runs tribox with these arguments to its end. limit: a resource and how much of it there is, as for setrlimit."""
    done = subprocess.run([program(), *arguments], input=stdin, capture_output=True, timeout=120, cwd=cwd,
                          env=None if env is None else {**os.environ, **env},
                          preexec_fn=None if limit is None else lambda: resource.setrlimit(limit[0], (limit[1], limit[1])))
    return Result(done.returncode, done.stdout.decode(), done.stderr.decode())


@functools.lru_cache
def has_libassimp():
    with tempfile.NamedTemporaryFile(suffix=".gltf") as mesh:
        mesh.write(b"{}")
        mesh.flush()
        return "built without libassimp" not in run("overlap", mesh.name, "--box", UNIT_BOX).stderr


@functools.lru_cache
def has_openvdb():
    with tempfile.TemporaryDirectory() as folder:
        mesh, out = os.path.join(folder, "mesh.f32"), os.path.join(folder, "try.vdb")
        with open(mesh, "wb") as file:
            file.write(bytes(36))
        result = run("voxelize", mesh, "--cell", "1", "--quiet", "-o", out)
    return "built without OpenVDB" not in result.stderr


def skip_without_openvdb(test):
    if not has_openvdb():
        test.skipTest("built without OpenVDB")


# For what says nothing new about memory and takes long where a sanitizer looks at each access.
unless_sanitized = unittest.skipIf(os.environ.get("TRIBOX_SANITIZED"), "a build with a sanitizer")


class TestCase(unittest.TestCase):
    """A test with a folder of its own for the files that it writes."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def write(self, name, content):
        path = os.path.join(self.folder, name)
        if path.endswith((".gltf", ".glb")) and not has_libassimp():
            self.skipTest("built without libassimp")
        with open(path, "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return path

    def succeed(self, *arguments, **how):
        """Runs tribox, which has to succeed in silence, and returns its standard output."""
        result = run(*arguments, **how)
        self.assertEqual((result.code, result.stderr), (0, ""), arguments)
        return result.stdout

    def succeed_with_note(self, pattern, *arguments, **how):
        """The same where one line of a note or warning is due."""
        result = run(*arguments, **how)
        self.assertEqual(result.code, 0, result.stderr)
        self.assert_one_line(result.stderr, pattern)
        return result.stdout

    def fail_with(self, code, pattern, *arguments, **how):
        """Runs tribox, which has to print nothing but one line on standard error."""
        result = run(*arguments, **how)
        self.assertEqual(result.code, code, (arguments, result.stderr))
        self.assertEqual(result.stdout, "", arguments)
        self.assert_one_line(result.stderr, pattern)

    def assert_one_line(self, stderr, pattern):
        self.assertRegex(stderr, pattern)
        self.assertRegex(stderr, r"\Atribox[^\n]*: [^\n]+\n\Z")

    def foreign(self, program, *paths):
        """What another program reads from these files (foreign.py), by Debian's Python, whose packages have it."""
        if not os.path.exists(DEBIAN):
            self.skipTest("no Python of Debian's")
        done = subprocess.run([DEBIAN, "-B", FOREIGN, program, *paths], capture_output=True, timeout=120)
        self.assertEqual((done.returncode, done.stderr.decode()), (0, ""))
        found = json.loads(done.stdout)
        if isinstance(found, str):
            self.skipTest(found)
        return found

    def overlap(self, mesh, box, *options):
        """The answer about one box as JSON, its list included."""
        return json.loads(self.succeed("overlap", mesh, "--box", box, "--list", "--json", *options))


def main():
    """The program is the last argument; others go to unittest."""
    os.environ["TRIBOX_PROGRAM"] = os.path.abspath(sys.argv.pop())
    unittest.main()
