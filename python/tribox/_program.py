"""The program tribox: it reads files of meshes, and writes the formats of cells that are not written here."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import tempfile
import warnings
from typing import Union

import numpy as np

from ._errors import Error, InputError, path_of
from ._triangles import Mesh, mesh_of


OWN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "tribox.exe" if os.name == "nt" else "tribox")  # the wheel's


def program(what):
    """Its path. what: it is needed for."""
    path = os.environ.get("TRIBOX_PROGRAM") or shutil.which(OWN) or shutil.which("tribox")
    if not path:
        raise Error(f"{what} takes the program tribox, which is not in this package and not on PATH: install it, as BUILD.md says, "
                    "or set the environment variable TRIBOX_PROGRAM to where it is")
    return path


def run(what, out, *arguments, shown_as=None, stacklevel):
    """Runs it to its end. Its failure becomes an InputError, and what it warns of warnings of the caller's.

    out: the file that it has written then.
    shown_as: a name in what it says, and another to be said in place of that.
    """
    path = program(what)
    try:
        done = subprocess.run([path, *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                              check=False)
    except OSError as error:
        raise Error(f"{what} takes the program tribox, and {path} does not run: {error}") from error
    lines = done.stderr.decode("utf-8", "backslashreplace").splitlines()
    said = [re.sub(rf"^tribox {arguments[0]}: (warning: |note: )?", "", line) for line in lines]
    if shown_as:
        said = [line.replace(*shown_as) for line in said]
    if done.returncode == 2:
        raise Error(f"{what} takes a program tribox of this version, and {path} is of another: {'; '.join(said)}")
    if done.returncode:
        more = "; TRIBOX_PROGRAM may name a program that has it" if "built without" in "".join(said) else ""
        raise InputError(("; ".join(said) or f"{path} ended with {done.returncode}") + more)
    if not (os.path.exists(out) and os.path.getsize(out)):
        raise Error(f"{what} takes the program tribox, and {path}, which wrote nothing, is another")
    for line in said:
        warnings.warn(line, stacklevel=stacklevel)


def read(path: Union[str, "os.PathLike[str]"]) -> Mesh:
    """Reads a file of a mesh as the program tribox does: PLY, OBJ, STL, OFF, raw triangles, and by libassimp glTF and others.

    Returns a Mesh, which every call takes: vertices are float32, or float64 where these do not hold the numbers of the file, each
    place of a triangle once; faces are triangles, into which polygons are cut. mesh.face_colors are the colours of the faces, uint8
    of shape (n, 3), those of PLY, OFF, materials and corners; None if the file has none.

    It runs the program, on all processors: the one that the environment variable TRIBOX_PROGRAM names, that of the wheel, which is
    without libassimp, or the one on PATH.

    Raises InputError for what is no mesh, OSError for a file that is not there, and Error without the program. What the program
    warns of, such as triangles with a NaN, are warnings.
    """
    name = path_of(path)
    with open(path, "rb"):  # or the reason why not
        pass
    with tempfile.TemporaryDirectory(prefix="tribox-") as folder:
        out = os.path.join(folder, "mesh.npz")
        run("tribox.read", out, "info", "--quiet", "--out", out, "--", "./-" if name == "-" else name, stacklevel=3)  # - is stdin
        with np.load(out, allow_pickle=False) as arrays:
            return mesh_of(arrays["vertices"], arrays["faces"], arrays["colours"] if "colours" in arrays.files else None)


def write_by_program(file, write_npz, path, ending):
    """Writes a format of the program's in place of an open file. write_npz: writes the same cells to one of bricks."""
    with tempfile.TemporaryDirectory(prefix="tribox-") as folder:
        cells = os.path.join(folder, "cells.npz")
        with open(cells, "xb") as npz:
            write_npz(npz)
        file.close()
        run(f"a file that ends in {ending}", file.name, "merge", cells, "--quiet", "--out-format", ending[1:], "--out", file.name,
            shown_as=(file.name, path), stacklevel=8)
