"""The package for pip: what it holds, what its tag promises, and that it works where it is installed, without a network.

It is built by the compiler without optimisation (CFLAGS), as the files and flags are what is asked about here. What the optimised
library needs of a system is asked of that of meson's build, which has the same files and flags.
"""

import glob
import os
import re
import shlex
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest
import zipfile
from importlib.util import find_spec

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
BUILD = os.environ.get("BUILD", os.path.join(ROOT, "build"))
NEWEST = 2, 17  # the C library that manylinux_2_17 promises to be enough
MODULES = sorted(os.path.basename(file) for file in glob.glob(os.path.join(ROOT, "python", "tribox", "*.py")))
# What takes the program of the wheel: a mesh is read, and its cells are the same in a file of each format but one.
WITH_PROGRAM = """
import os, tempfile, tribox
from tribox._files import HOLDS
os.chdir(tempfile.mkdtemp())
with open("a.off", "w") as file:
    file.write("OFF\\n4 2 0\\n0 0 0\\n5 0 0\\n0 7 1\\n0 0 9\\n3 0 1 2\\n3 0 2 3\\n")
mesh = tribox.read("a.off")
voxels = tribox.voxelize(mesh, cell=1)
assert len(mesh) == 2 and voxels.sum() > 50
for ending in set(HOLDS) - {".vdb"}:
    voxels.save("a" + ending)
    assert (tribox.Voxels.load("a" + ending, voxels.grid) == voxels).all(), ending
try:
    tribox.read("a.glb")  # one of its own
except tribox.InputError as error:
    assert "built without libassimp" in str(error), error
else:
    raise AssertionError
"""
KEPT = "PATH", "HOME", "LANG", "TMPDIR", "CCACHE_DIR"  # of the environment; what helps tests of the build tree hides faults
sys.path.insert(0, os.path.join(ROOT, "python"))

from making.library import VERSION  # noqa: E402


def environment(**more):
    kept = {name: os.environ[name] for name in KEPT if name in os.environ}
    cached = {"CC": "ccache cc"} if shutil.which("ccache") else {}  # it is built twice
    return {**kept, **cached, "CFLAGS": "-O0", "PIP_DISABLE_PIP_VERSION_CHECK": "1", "PYTHONDONTWRITEBYTECODE": "1", **more}


def run(*command, **keywords):
    """What a command prints; its failure is this test's, with all that it said."""
    keywords = {"env": environment(), **keywords}
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **keywords)
    if done.returncode:
        raise AssertionError(f"{shlex.join(command)} failed:\n{done.stdout[-4000:]}")
    return done.stdout


def in_tree():
    """What is at the top of the source tree, and all below python."""
    found = set(glob.glob(os.path.join(ROOT, "*")) + glob.glob(os.path.join(ROOT, "build", "*")))
    found.update(glob.glob(os.path.join(ROOT, "python", "**"), recursive=True))
    return {name for name in found if "__pycache__" not in name}


def versions(library):
    """The versions of the C library's symbols that a library needs."""
    found = re.findall(r"GLIBC_(\d+)\.(\d+)", run("objdump", "-T", library))
    return {(int(major), int(minor)) for major, minor in found}


def needed(library):
    return set(re.findall(r"NEEDED +(\S+)", run("objdump", "-p", library)))


def exported(library):
    return set(re.findall(r"(?m)^[0-9a-f]+ g +DF? +\.text.* (\S+)$", run("objdump", "-T", library)))


class Wheel(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        work = cls.work = cls.folder.name
        cls.before = in_tree()
        run(sys.executable, "-m", "build", "--no-isolation", "--outdir", work, ROOT, cwd="/")
        cls.sdist, = glob.glob(os.path.join(work, "*.tar.gz"))
        cls.wheel, = glob.glob(os.path.join(work, "*.whl"))
        with zipfile.ZipFile(cls.wheel) as wheel:
            cls.names = wheel.namelist()
            wheel.extractall(os.path.join(work, "unpacked"))
        cls.library, cls.program = (os.path.join(work, "unpacked", "tribox", name) for name in ("libtribox.so", "tribox"))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def about(self, name):
        with open(os.path.join(self.work, "unpacked", f"tribox-{VERSION}.dist-info", name), encoding="utf-8") as file:
            return file.read()

    def test_tree_is_clean(self):
        """Neither the package nor its tests write beside the sources."""
        self.assertEqual(in_tree() - self.before, set())

    def test_names(self):
        version = run("sh", os.path.join(ROOT, "packaging", "version.sh")).strip()
        self.assertEqual(VERSION, version)
        platform = {"x86_64": "manylinux_2_17_x86_64", "aarch64": "manylinux_2_17_aarch64"}[os.uname().machine]
        self.assertEqual(os.path.basename(self.wheel), f"tribox-{version}-py3-none-{platform}.whl")
        self.assertEqual(os.path.basename(self.sdist), f"tribox-{version}.tar.gz")
        self.assertIn(f"Tag: py3-none-{platform}\n", self.about("WHEEL"))
        self.assertIn("Root-Is-Purelib: false\n", self.about("WHEEL"))

    def test_wheel_contents(self):
        inside = [name for name in self.names if ".dist-info/" not in name]
        made = "_ffi.py", "libtribox.so", "py.typed", "tribox"
        self.assertEqual(sorted(inside), sorted("tribox/" + name for name in [*MODULES, *made]))
        for line in ("Requires-Python: >=3.9", "Requires-Dist: numpy (>=1.21)", "Requires-Dist: cffi (>=1.12)"):
            self.assertRegex(self.about("METADATA").replace("(", "").replace(")", ""), re.escape(re.sub("[()]", "", line)) + "\n")
        self.assertIn("# tribox\n", self.about("METADATA"))

    def test_sdist_contents(self):
        """All sources, and what makes the package of them."""
        with tarfile.open(self.sdist) as sdist:
            inside = {name.partition("/")[2] for name in sdist.getnames() if not sdist.getmember(name).isdir()}
        parts = "src", "include", "tools"
        sources = {name for name in inside if name.startswith(tuple(part + "/" for part in parts))}
        made = {"pyproject.toml", "LICENSE", "PKG-INFO", "setup.cfg", "python/README.md", "python/declarations.py",
                "python/tribox/py.typed", *(f"python/tribox/{name}" for name in MODULES),
                *(f"python/making/{name}.py" for name in ("__init__", "backend", "commands", "library"))}
        rest = {name for name in inside - sources if ".egg-info/" not in name}
        self.assertEqual(rest, made)
        ours = {os.path.relpath(os.path.join(folder, name), ROOT) for part in parts
                for folder, _, names in os.walk(os.path.join(ROOT, part)) for name in names if name.endswith((".c", ".h"))}
        self.assertEqual(sources, ours)

    def test_symbols(self):
        """The tag: any Linux with a C library of that version, and nothing else."""
        for library in (self.library, os.path.join(BUILD, "src", "libtribox.so.1")):
            self.assertLessEqual(max(versions(library)), NEWEST)
            self.assertEqual(needed(library), {"libc.so.6"})
        public = run("sh", os.path.join(ROOT, "packaging", "symbols.sh")).split()
        self.assertEqual(exported(self.library), set(public))
        self.assertGreater(max(versions(sys.executable)), NEWEST)  # these eyes see
        self.assertEqual(needed(self.program), set())

    def virtual(self, name):
        """A fresh environment with this machine's NumPy and cffi: its python."""
        folder = os.path.join(self.work, name)
        run(sys.executable, "-m", "venv", "--without-pip", "--system-site-packages", folder)
        return os.path.join(folder, "bin", "python3")

    def installs(self, name, *what):
        """pip installs it without a network, and the tests pass."""
        python = self.virtual(name)
        run(python, "-m", "pip", "install", "--no-index", *what, cwd="/")
        where = run(python, "-c", "import tribox; print(tribox._library.library_path(), tribox.__version__)", cwd="/").split()
        self.assertTrue(where[0].startswith(os.path.join(self.work, name)), where)
        self.assertEqual(where[1], VERSION)
        return python

    def test_wheel_installs(self):
        python = self.installs("from_wheel", self.wheel)
        for test in ("test_refused.py", "test_forms.py"):
            run(python, os.path.join(HERE, test), cwd="/")
        readme = "import doctest; failed, tried = doctest.testfile({!r}, False); assert tried and not failed"
        run(python, "-c", readme.format(os.path.join(ROOT, "python", "README.md")), cwd="/")
        run(python, "-c", "import doctest, tribox; failed, tried = doctest.testmod(tribox); assert tried and not failed", cwd="/")
        run(python, "-c", WITH_PROGRAM, cwd="/", env=environment(PATH="/"))
        run(python, "-m", "pip", "uninstall", "-y", "tribox", cwd="/")
        self.assertEqual(glob.glob(os.path.join(self.work, "from_wheel", "lib", "*", "site-packages", "tribox*")), [])

    def test_checkout_installs(self):
        """`pip install .`, as people type it, where there is no network."""
        self.installs("from_checkout", "--no-build-isolation", ROOT)
        self.test_tree_is_clean()

    def test_named_library(self):
        """TRIBOX_LIBRARY goes before the library in the package."""
        code = "import tribox._library as l; print(l.library_path())"
        unpacked = environment(PYTHONPATH=os.path.join(self.work, "unpacked"))
        self.assertEqual(run(sys.executable, "-c", code, env=unpacked, cwd="/").strip(), self.library)
        other = os.path.join(BUILD, "src", "libtribox.so.1")
        unpacked["TRIBOX_LIBRARY"] = other
        self.assertEqual(run(sys.executable, "-c", code, env=unpacked, cwd="/").strip(), other)

    def test_editable(self):
        with self.assertRaisesRegex(AssertionError, "no editable installation.*PYTHONPATH=build/python"):
            self.installs("editable", "--no-build-isolation", "-e", ROOT)

    def test_no_compiler(self):
        """One clear line, and no package."""
        with self.assertRaisesRegex(AssertionError, "no-such-compiler: .*; set CC to gcc or clang"):
            run(sys.executable, "-m", "build", "--no-isolation", "--wheel", "--outdir", self.work + "/none", ROOT, cwd="/",
                env=environment(CC="no-such-compiler"))
        self.assertEqual(glob.glob(os.path.join(self.work, "none", "*")), [])


if __name__ == "__main__":
    missing = [program for program in ("objdump", "cc") if not shutil.which(program)]
    missing += [module for module in ("build", "cffi", "pip", "setuptools", "venv", "wheel") if not find_spec(module)]
    if missing:
        print(f"there is no {' and no '.join(missing)}: skipped")
        sys.exit(77)
    unittest.main()
