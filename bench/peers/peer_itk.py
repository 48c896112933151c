"""ITK's filter from a mesh of triangles to the solid in an image."""

import ctypes

import numpy as np

import compiled

NAME = "ITK 5.2"
LIBRARIES = "ITKCommon", "ITKMesh", "ITKTransform", "itkvnl_algo", "itkvnl", "itksys", "itkv3p_netlib"
itk_cells = compiled.function("itk", "-I/usr/include/ITK-5.2", *(f"-l{name}-5.2" for name in LIBRARIES))


def solid(task):
    return compiled.way(task, itk_cells, *compiled.arrays(task), task.middle(), ctypes.c_double(task.grid.cell[0]),
                        np.array(task.grid.size, np.int32))


WAYS = {"middles": ("TriangleMeshToBinaryImageFilter", solid)}
