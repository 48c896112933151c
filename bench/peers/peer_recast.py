"""Recast's spans of solid cells, columns along y."""

import ctypes

import numpy as np

import compiled

NAME, recast_cells = "Recast", compiled.function("recast", "-lRecast")


def spans(task):
    lo, size = np.array(task.grid.origin), np.array(task.grid.size, np.int32)
    hi, areas = lo + np.array(task.grid.cell) * size, np.full(len(task.faces), 63, np.uint8)
    return compiled.way(task, recast_cells, *compiled.arrays(task), areas, lo.astype(np.float32), hi.astype(np.float32),
                        ctypes.c_float(task.grid.cell[0]), size)


WAYS = {"surface": ("rcRasterizeTriangles, spans", spans)}
