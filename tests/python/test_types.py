"""Type hints: the module is consistent, a program that uses it passes mypy --strict, and mistakes are found."""

import inspect
import os
import pydoc
import re
import subprocess
import sys
import tempfile
import unittest

import tribox

import cases

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))


def mypy(*arguments, folder):
    """What it prints: errors alone."""
    done = subprocess.run([sys.executable, "-m", "mypy", "--no-error-summary", "--hide-error-context", f"--cache-dir={folder}",
                           *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=folder,
                          env={**os.environ, "MYPYPATH": os.path.dirname(os.path.dirname(tribox.__file__))})
    if "No module named mypy" in done.stdout:
        raise unittest.SkipTest("there is no mypy")
    return done.stdout


class Types(cases.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = folder.name

    def test_module(self):
        config = os.path.join(ROOT, "pyproject.toml")
        self.assertEqual(mypy("--config-file", config, "-p", "tribox", folder=self.folder), "")

    def test_user(self):
        path = os.path.join(HERE, "typed.py")
        said = mypy("--strict", "--config-file=", path, folder=self.folder)
        found = {int(line) for line in re.findall(r"typed\.py:(\d+): error", said)}
        with open(path, encoding="utf-8") as file:
            wrong = {number for number, line in enumerate(file, 1) if line.endswith("# wrong\n")}
        self.assertTrue(wrong)
        self.assertEqual(found, wrong, said)

    def test_everything_public(self):
        """Functions and methods without an underscore have types and a docstring."""
        def missing(name, thing):
            if not inspect.isroutine(thing):
                return []
            hints = getattr(thing, "__annotations__", {})
            code = thing.__code__
            names = [n for n in code.co_varnames[:code.co_argcount + code.co_kwonlyargcount] if n not in ("self", "cls")]
            return [name] if not thing.__doc__ or {*names, "return"} - hints.keys() else []

        found = []
        for name in tribox.__all__:
            thing = getattr(tribox, name)
            found += missing(name, thing)
            if isinstance(thing, type) and "tribox" in thing.__module__:
                self.assertTrue(thing.__doc__, name)
                for inner in vars(thing):
                    if not inner.startswith("_"):
                        found += missing(f"{name}.{inner}", getattr(thing, inner))
        self.assertEqual(found, [])

    def test_help_of_all(self):
        """It begins with what there is, each method by its name, and has no methods that every class or array has."""
        text = pydoc.render_doc(tribox, renderer=pydoc.plaintext)
        self.assertLess(text.count("\n"), 900)
        self.assertNotRegex(text, "__radd__|__setattr__")
        for thing in tribox.Voxels, tribox.Bricks, tribox.Index:
            for name, method in vars(thing).items():
                if inspect.isroutine(method) and not name.startswith("_"):
                    self.assertIn(f".{name}(", tribox.__doc__)
        for name in tribox.__all__:
            if inspect.isfunction(getattr(tribox, name)) and name not in ("kernels", "kernel_name", "mask_indices", "tile_count"):
                self.assertRegex(tribox.__doc__, rf"\b{name}\b")

    def test_help(self):
        """Signatures are of names that one can read, and lines of a terminal's width."""
        for name in tribox.__all__:
            thing = getattr(tribox, name)
            if not callable(thing) or issubclass(type(thing), type) and issubclass(thing, BaseException):
                continue
            text = pydoc.render_doc(thing, renderer=pydoc.plaintext)
            self.assertNotRegex(text, r"_SupportsArray|_NestedSequence|typing\.|numpy\.ndarray\[|ForwardRef|Union\[.*Union\[")
            for line in (inspect.getdoc(thing) or "").splitlines():
                self.assertLessEqual(len(line), 132, line)


if __name__ == "__main__":
    cases.main()
