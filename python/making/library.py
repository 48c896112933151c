"""The library inside the package: its files, its flags, and one compiler call for each file. Needs neither meson nor CMake.

CC names the compiler, gcc or clang, which may be a cross compiler; CFLAGS go after the flags that are here, and before those of all
files in kernels.txt.
"""

import os
import re
import shlex
import subprocess
from concurrent.futures import ThreadPoolExecutor
from glob import glob

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
PROCESSORS = {"x86_64": "x86", "aarch64": "aarch64", "arm64": "aarch64"}  # those of wheels, and what kernels.txt calls them
with open(os.path.join(ROOT, "src", "kernels.txt"), encoding="ascii") as lines:
    LINES = lines.read()
KERNELS = re.findall(r"(?m)^(\w+) (\w+) (\w+):(.*)$", LINES)
ALL = re.search(r"(?m)^all:(.*)$", LINES).group(1).split()
COMMON = ["-std=c11", "-O3", "-fvisibility=hidden", "-Iinclude", "-Isrc"]
MANYLINUX = "manylinux_2_17_"  # as old a C library as any that NumPy is made for; tests/python/test_wheel.py proves it

with open(os.path.join(ROOT, "include", "tribox.h"), encoding="ascii") as header:
    VERSION = ".".join(re.findall(r"(?m)^#define TRIBOX_VERSION_[A-Z]* *(\d+)$", header.read()))


def rooms(root):
    """The folders of src but those of kernels and of their text, of which "" is src itself."""
    source = os.path.join(root, "src")
    folders = [os.path.relpath(folder, source) for folder, _, _ in os.walk(source)]
    own = {"kernel", *(folder for _, folder, _, _ in KERNELS)}
    return sorted("" if folder == "." else folder for folder in folders if folder.split(os.sep)[0] not in own)


def files(root):
    """The files that the package is made of, relative to the root of the repository."""
    kernels = [folder for _, folder, processor, _ in KERNELS if processor in ("any", *PROCESSORS.values())]
    folders = [*rooms(root), "kernel", "kernel/*", *kernels]
    patterns = ["pyproject.toml", "LICENSE", "include/*.h", *(os.path.join("src", folder, "*.[ch]") for folder in folders),
                "src/kernels.txt", "python/README.md", "python/declarations.py", "python/*/*.py", "python/tribox/py.typed"]
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
        """{source: its flags}, relative to the root."""
        kernels = [kernel for kernel in KERNELS if kernel[2] in ("any", PROCESSORS.get(self.processor))]
        core = ["-DTRIBOX_" + name.upper() for name, _, _, _ in kernels if name != "scalar"]
        position = ["-DTRIBOX_SHARED_BUILD"] if self.is_windows else ["-fPIC"]
        is_clang = "clang" in self.output("--version")
        of_kernels = ["-mstackrealign"] if is_clang else ["-Wa,-muse-unaligned-vector-move"] if self.is_windows else []
        flags = {room: core for room in rooms(ROOT)}
        flags.update({folder: of_kernels + own.split() for _, folder, _, own in kernels})
        return {os.path.relpath(source, ROOT): [*COMMON, *position, *own, *self.extra, *ALL]
                for folder, own in flags.items() for source in glob(os.path.join(ROOT, "src", folder, "*.c"))}

    def run(self, *arguments):
        subprocess.run([*self.command, *arguments], check=True, cwd=ROOT)

    def build(self, folder, scratch):
        """Writes the library into a folder; scratch: an empty one, for objects. Returns its path."""
        os.makedirs(folder, exist_ok=True)

        def compile_one(pair):
            source, flags = pair
            target = os.path.join(scratch, source.replace(os.sep, "-") + ".o")
            self.run(*flags, "-c", source, "-o", target)
            return target

        # The kernels first: they take the longest.
        sources = sorted(self.flags().items(), key=lambda pair: -pair[0].count(os.sep))
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            objects = list(pool.map(compile_one, sources))
        path = os.path.join(os.path.abspath(folder), self.library)
        needs = [] if self.processor in PROCESSORS else ["-lm"]  # to set the rounding mode
        # GNU ld makes the base of a DLL of its path, and each build has another.
        needs += ["-Wl,--disable-auto-image-base"] if self.is_windows else []
        self.run("-shared", "-s", *self.extra, *objects, *needs, "-o", path)
        return path
