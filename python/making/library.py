"""The library and the program inside the package: files, flags, and one compiler call for each file. Needs neither meson nor CMake.

CC names the compiler, gcc or clang, which may be a cross compiler; CFLAGS go after the flags that are here.
"""

import os
import re
import shlex
import subprocess
from concurrent.futures import ThreadPoolExecutor
from glob import glob

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
PROCESSORS = ("x86_64", "aarch64", "arm64")  # those of wheels
COMMON = ["-std=c11", "-O3", "-fvisibility=hidden", "-Iinclude", "-Isrc"]
# The program beside it is static, so that it is bound to no C library; what has to be loaded, and pictures, are left out.
PROGRAM = ["-Itools", "-ffp-contract=off", "-DPAPER_WALKS=paper_walks_any",
           *("-DWITHOUT_" + part for part in ("ASSIMP", "OPENVDB", "PNG"))]
LEFT_OUT = re.compile(r"/(assimp_plugin|read_by_assimp|bricks_vdb|picture_png)\.c$")
KERNEL = re.compile(r"/(pairs|settle|cells|rows|nodes)_\w+\.c$")
MANYLINUX = "manylinux_2_17_"  # as old a C library as any that NumPy is made for; tests/python/test_wheel.py proves it

with open(os.path.join(ROOT, "include", "tribox.h"), encoding="ascii") as header:
    VERSION = ".".join(re.findall(r"(?m)^#define TRIBOX_VERSION_[A-Z]* *(\d+)$", header.read()))


def files(root):
    """The files that the package is made of, relative to the root of the repository."""
    patterns = ["pyproject.toml", "LICENSE", "include/*.h", *("src/" + "*/" * depth + "*.[ch]" for depth in range(3)),
                "tools/*.[ch]", "tools/*/*.[ch]",
                "python/README.md", "python/declarations.py", "python/*/*.py", "python/tribox/py.typed"]
    found = [os.path.relpath(file, root) for pattern in patterns for file in glob(os.path.join(root, pattern))]
    return sorted(file.replace(os.sep, "/") for file in found)


class Compiler:
    """CC, and what it compiles for."""

    def __init__(self):
        self.command = shlex.split(os.environ.get("CC", "cc"))
        self.extra = shlex.split(os.environ.get("CFLAGS", ""))
        self.target = self.output("-dumpmachine")
        self.processor = self.target.split("-")[0]
        self.is_windows = "mingw" in self.target
        self.library = "tribox.dll" if self.is_windows else "libtribox.so"
        self.program = "tribox.exe" if self.is_windows else "tribox"

    def output(self, *arguments):
        try:
            return subprocess.run([*self.command, *arguments], check=True, stdout=subprocess.PIPE, text=True).stdout.strip()
        except OSError as error:
            raise SystemExit(f"{self.command[0]}: {error.strerror}; set CC to gcc or clang") from None

    def platform(self):
        """The last part of a wheel's tag; None: that of the Python that runs this."""
        if self.is_windows:
            return {"x86_64": "win_amd64"}.get(self.processor)
        return MANYLINUX + self.processor if self.processor in PROCESSORS and "linux-gnu" in self.target else None

    def flags(self):
        """Those of all sources."""
        position = ["-DTRIBOX_SHARED_BUILD", "-D__USE_MINGW_ANSI_STDIO=1"] if self.is_windows else ["-fPIC"]
        aligned = ["-mstackrealign"] if "clang" in self.output("--version") and self.processor == "x86_64" else []
        return [*COMMON, *position, *aligned, *self.extra]

    def run(self, *arguments):
        subprocess.run([*self.command, *arguments], check=True, cwd=ROOT)

    def links_program(self, scratch):
        """Whether one can be linked: it takes zlib, and both that and the C library as archives."""
        probe = [*self.command, *self.extra, "-x", "c", "-", "-static", "-lz", "-o", os.path.join(scratch, "probe")]
        code = "#include <zlib.h>\nint main(void) { return !zlibVersion(); }\n"
        return not subprocess.run(probe, input=code, stderr=subprocess.DEVNULL, text=True, check=False).returncode

    def build(self, folder, scratch):
        """Writes the library and the program into a folder; scratch: an empty one, for objects."""
        os.makedirs(folder, exist_ok=True)
        flags = self.flags()

        def compile_one(source):
            target = os.path.join(scratch, source.replace("/", "-") + ".o")
            self.run(*flags, *(PROGRAM if source.startswith("tools") else []), "-c", source, "-o", target)
            return target

        def compile_all(start, is_left_out):
            # The kernels first: they take the longest.
            sources = [file for file in files(ROOT) if file.startswith(start) and file.endswith(".c") and not is_left_out(file)]
            with ThreadPoolExecutor(os.cpu_count()) as pool:
                return list(pool.map(compile_one, sorted(sources, key=lambda file: not KERNEL.search(file))))

        objects = compile_all("src/", lambda file: False)
        to = os.path.join(os.path.abspath(folder), "")
        # GNU ld makes the base of a DLL of its path, and each build has another.
        needs = ["-Wl,--disable-auto-image-base"] if self.is_windows else []
        maths = [] if self.processor in PROCESSORS else ["-lm"]  # to set the rounding mode
        self.run("-shared", "-s", *self.extra, *objects, *maths, *needs, "-o", to + self.library)
        if not self.links_program(scratch):
            print("tribox: without the program, which read() and some formats of save() run: no static zlib or C library is here")
            return
        others = "_posix.c" if self.is_windows else "_windows.c"
        objects += compile_all("tools/", lambda file: LEFT_OUT.search(file) or file.endswith(others))
        self.run("-static", "-pthread", "-s", *self.extra, *objects, "-lz", "-lm", "-o", to + self.program)
