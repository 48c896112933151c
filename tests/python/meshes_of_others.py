"""The attributes that meshes of other libraries have, for typed.py."""

from typing import Any, Dict

import numpy as np
from numpy.typing import NDArray


class Trimesh:
    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]


class Open3d:
    vertices: Any
    triangles: Any


class PyVista:
    points: NDArray[np.float32]
    faces: NDArray[np.int64]


class Meshio:
    points: NDArray[np.float64]

    @property
    def cells_dict(self) -> Dict[str, NDArray[np.int64]]:
        return {}


trimesh, open3d, pyvista, meshio = Trimesh(), Open3d(), PyVista(), Meshio()
