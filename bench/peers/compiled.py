"""Peers in C++: a program of ours asks them, compiled as it is needed, and takes the time itself."""

import ctypes
import os
import subprocess
import tempfile

import numpy as np

from asked import Timed

HERE, FOLDER = os.path.dirname(os.path.abspath(__file__)), tempfile.TemporaryDirectory()


def function(name, *flags):
    """NAME_cells of NAME.cc."""
    library = os.path.join(FOLDER.name, name + ".so")
    try:
        subprocess.run(["c++", "-O3", "-shared", "-fPIC", os.path.join(HERE, name + ".cc"), "-o", library, *flags], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    except (OSError, subprocess.CalledProcessError):
        raise ImportError(name + " does not compile") from None
    found = getattr(ctypes.CDLL(library), name + "_cells")
    found.restype = ctypes.c_double
    return found


def way(task, cells_of, *arguments):
    """Its arguments are numbers and arrays; the cells come last."""
    cells = np.zeros(task.grid.size[::-1], np.uint8)
    raw = [n.ctypes.data_as(ctypes.c_void_p) if isinstance(n, np.ndarray) else n for n in (*arguments, cells)]

    def call():
        cells.fill(0)
        taken = cells_of(*raw)
        if taken < 0:
            raise MemoryError
        return Timed(taken, taken)
    return call, lambda _, kept=arguments: cells.view(bool)


def arrays(task):
    """Arguments of a mesh: vertices, how many, faces, how many."""
    vertices, faces = np.ascontiguousarray(task.vertices, np.float32), np.ascontiguousarray(task.faces, np.int32)
    return vertices, len(vertices), faces, len(faces)
