"""How a program that is checked by `mypy --strict` uses the module: read by test_types.py, never run.

A line that ends in "# wrong" has to be an error.
"""

from typing import List, Tuple

import meshes_of_others
import numpy as np
import tribox
from numpy.typing import NDArray

Three = Tuple[float, float, float]
triangles = np.zeros((1, 3, 3), np.float32)
lo, hi = (0, 0, 0), np.ones(3, np.float32)
mesh = tribox.Mesh(np.zeros((3, 3)), [[0, 1, 2]])
soup = tribox.Soup.of(mesh, origin=(0, 0, 0))
forms: List[tribox.TrianglesLike] = [triangles, triangles.tolist(), mesh, soup, meshes_of_others.trimesh, meshes_of_others.open3d,
                                     meshes_of_others.pyvista, meshes_of_others.meshio]

for form in forms:
    mask: NDArray[np.bool_] = tribox.overlap(form, lo, hi, accuracy="fast", axes=tribox.AXES_BOX, order=132, kernel="sse2")
    words: NDArray[np.uint64] = tribox.overlap(form, lo, [1, 1, np.float32(1)], packed=True)
    numbers: NDArray[np.uint32] = tribox.mask_indices(words)
    is_any: bool = tribox.overlap_any(form, lo, hi) and tribox.overlap_all(form, lo, hi)
    overlaps, inside = tribox.classify(form, lo, hi)
    turned: NDArray[np.bool_] = tribox.overlap_oriented(form, lo, hi, np.eye(3))
    cells: NDArray[np.bool_] = tribox.voxelize(form, lo, 0.5, (2, 2, 2), threads=None, fill="outside", layers=(0, 1))
    around, grid = tribox.voxelize(form, resolution=np.int64(64), threads=2)
    origin: Three = grid.origin
    at, bits = tribox.bricks(form, *tribox.grid_around(form, 4096), tile=64)
    places: NDArray[np.int64] = tribox.Bricks(at, bits).cells()
    parts: tribox.Partition = tribox.partition(form, lo, 1, (8, 8, 8), "tiles")

index = tribox.Index(triangles, keep_order=True)
count: int = index.count(lo, hi) + len(index) + tribox.tile_count((8, 8, 8))
listed: NDArray[np.uint32] = index.list(lo, hi)
lists, starts = index.lists(np.zeros((3, 5)), np.ones((3, 5)))
many: NDArray[np.bool_] = tribox.overlap_boxes(triangles[0], np.zeros((3, 5)), np.ones((3, 5)))
shares: List[Tuple[int, int]] = parts.shares(8)
names: List[str] = tribox.kernels()
version: str = tribox.__version__
try:
    tribox.Mesh.of(meshes_of_others.pyvista)
except tribox.Error as error:
    status: str = error.status or str(error)

tribox.overlap(triangles, lo, hi, accuracy="exakt")  # wrong
tribox.overlap(triangles, "abc", hi)  # wrong
tribox.overlap(triangles, lo)  # wrong
tribox.overlap(triangles, lo, hi, kernel=3)  # wrong
tribox.overlap(object(), lo, hi)  # wrong
tribox.voxelize(triangles, lo, 0.5)  # wrong
tribox.voxelize(triangles, resolution=0.5)  # wrong
tribox.voxelize(triangles, resolution=64, fill="all")  # wrong
tribox.Index(triangles, order=3)  # wrong
tribox.Mesh(mesh)  # wrong
index.list(lo, hi).nothing()  # wrong
tribox.kernel_names()  # wrong
