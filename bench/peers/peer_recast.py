"""Recast's spans of solid cells, columns along y. A program of ours, compiled here, asks it; it times itself."""

import ctypes
import os
import subprocess
import tempfile

import numpy as np

from asked import Timed

HERE, FOLDER = os.path.dirname(os.path.abspath(__file__)), tempfile.TemporaryDirectory()
try:
    library = os.path.join(FOLDER.name, "recast.so")
    subprocess.run(["c++", "-O3", "-shared", "-fPIC", os.path.join(HERE, "recast.cc"), "-o", library, "-lRecast"], check=True,
                   stderr=subprocess.PIPE)
except (OSError, subprocess.CalledProcessError):
    raise ImportError("librecast does not compile") from None
NAME = "Recast"
recast_cells = ctypes.CDLL(library).recast_cells
recast_cells.restype = ctypes.c_double


def spans(task):
    nx, ny, nz = task.grid.size
    lo = np.array(task.grid.origin, np.float32)
    hi = (np.array(task.grid.origin) + np.array(task.grid.cell) * task.grid.size).astype(np.float32)
    vertices, faces = np.ascontiguousarray(task.vertices, np.float32), np.ascontiguousarray(task.faces, np.int32)
    areas, size = np.full(len(faces), 63, np.uint8), np.array(task.grid.size, np.int32)

    def call():
        cells = np.zeros((nz, ny, nx), np.uint8)
        numbers = vertices, len(vertices), faces, areas, len(faces), lo, hi, ctypes.c_float(task.grid.cell[0]), size, cells
        taken = recast_cells(*(n.ctypes.data_as(ctypes.c_void_p) if isinstance(n, np.ndarray) else n for n in numbers))
        if taken < 0:
            raise MemoryError
        call.cells = cells.view(bool)
        return Timed(taken, taken)
    return call, lambda _: call.cells


WAYS = {"surface": ("rcRasterizeTriangles, spans", spans)}
