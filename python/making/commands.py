"""What setuptools does otherwise for this package: the library, its declarations for cffi, and a tag that fits every Python 3."""

import os
import subprocess
import sys
import tempfile

from setuptools.command.build_py import build_py

from making.library import ROOT, Compiler, files

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # before 70.1
    from wheel.bdist_wheel import bdist_wheel


class BuildPy(build_py):
    """Puts the library, the program and _ffi.py beside the modules."""

    def run(self):
        super().run()
        folder = os.path.join(self.build_lib, "tribox")
        headers = [os.path.join(ROOT, "include", header) for header in ("tribox.h", "tribox_threads.h")]
        declarations = os.path.join(ROOT, "python", "declarations.py")
        subprocess.run([sys.executable, declarations, *headers, os.path.join(folder, "_ffi.py")], check=True)
        with tempfile.TemporaryDirectory() as scratch:
            Compiler().build(folder, scratch)

    def get_outputs(self, include_bytecode=True):
        made = "_ffi.py", Compiler().library, Compiler().program
        paths = (os.path.join(self.build_lib, "tribox", name) for name in made)
        return super().get_outputs(include_bytecode) + [path for path in paths if os.path.exists(path)]

    def get_source_files(self):
        """What a source distribution holds."""
        return files(ROOT)


class BdistWheel(bdist_wheel):
    """Not bound to a version of Python, as cffi loads the library when it is asked, but to a processor."""

    def finalize_options(self):
        self.distribution.has_ext_modules = lambda: True
        super().finalize_options()

    def get_tag(self):
        return "py3", "none", Compiler().platform() or super().get_tag()[2]
