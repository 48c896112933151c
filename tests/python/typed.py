"""How a program that is checked by `mypy --strict` uses the module: read by test_types.py, never run.

A line that ends in "# wrong" has to be an error.
"""

from typing import Any, Dict, List, Optional, Tuple

import numpy as np
import tribox
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


Three = Tuple[float, float, float]
triangles = np.zeros((1, 3, 3), np.float32)
lo, hi = (0, 0, 0), np.ones(3, np.float32)
mesh = tribox.Mesh(np.zeros((3, 3)), [[0, 1, 2]])
soup = tribox.Soup.of(mesh)
forms: List[tribox.TrianglesLike] = [triangles, triangles.tolist(), mesh, soup, (np.zeros((3, 3)), [[0, 1, 2]]),
                                     Trimesh(), Open3d(), PyVista(), Meshio()]
box = tribox.OrientedBox(lo, hi, np.eye(3))

for form in forms:
    mask: NDArray[np.bool_] = tribox.overlap(form, lo, hi, accuracy="fast", axes=tribox.AXES_BOX, axis_order=132, kernel="sse2")
    words: NDArray[np.uint64] = tribox.overlap(form, lo, [1, 1, np.float32(1)], packed=True)
    both: NDArray[np.bool_] = tribox.overlap(form, [[0, 0, 0], [1, 1, 1]]) | tribox.overlap(form, np.zeros((2, 3)))
    numbers: NDArray[np.uint32] = tribox.mask_indices(words)
    is_any: bool = tribox.overlap_any(form, lo, hi) and tribox.overlap_all(form, lo, hi)
    first: Optional[int] = tribox.find(form, lo, hi, "miss")
    overlaps, inside = tribox.classify(form, lo, hi)
    children: NDArray[np.uint8] = tribox.split(form, lo, hi, numbers=[0])
    turned: NDArray[np.bool_] = tribox.overlap_oriented(form, lo, hi, np.eye(3))
    voxels: tribox.Voxels = tribox.voxelize(form, (lo, 0.5, (2, 2, 2)), threads=0, fill="outside", into=None)
    around: tribox.Voxels = tribox.voxelize(form, resolution=np.int64(64), threads=2, layers=(0, 1))
    told: NDArray[np.uint8] = tribox.voxelize(form, resolution=8, thin=True, fill="parity", labels=True).labels()
    cubes = tribox.voxelize(form, cell=0.1) | tribox.voxelize(form, cell=(1, 2, np.float32(3)), window=((0, 0, 0), (1, 1, 1)))
    bricks: tribox.Bricks = tribox.bricks(form, resolution=4096, side=64, tiles=(0, 1))
    by_cell: tribox.CellLists = tribox.cell_lists(form, resolution=np.int64(64), threads=None, accuracy="exact")
    copied: tribox.Mesh = tribox.Mesh(form)

cells: NDArray[np.bool_] = np.asarray(voxels)
total: int = int(voxels.sum()) + len(voxels) + voxels.shape[0]
points: NDArray[np.float64] = voxels.points()
places: NDArray[np.int64] = bricks.cells()
lowest: NDArray[np.uint32] = by_cell.triangles[by_cell.start[:-1]]
middles: NDArray[np.float64] = by_cell.points()
origin: Three = tribox.Grid(lo, 0.5, [1, 2, 3]).origin
grid: tribox.Grid = tribox.grid_around(triangles, cell=0.5)
voxels.with_colors(tribox.voxelize(tribox.read("mesh.ply"), cell=1, colors=True).colors).save("voxels.npz")
shard: Optional[Tuple[int, int]] = tribox.Bricks.load("a.npz").shard
loaded: tribox.Voxels = tribox.Voxels.load("a.npy", ((0, 0, 0), 0.5, (2, 2, 2)))
index = tribox.Index(triangles, keep_order=True, threads=None)
count: int = index.count(lo, hi) + len(index) + tribox.tile_count((8, 8, 8)) + index.count(box)
listed: NDArray[np.uint32] = index.list(lo, hi)
lists, starts = index.lists(np.zeros((5, 3)), np.ones((5, 3)), threads=2)
lists, starts = index.lists([[[0, 0, 0], [1, 1, 1]]])
part: tribox.Cropped = tribox.crop(Trimesh(), lo, hi, inside=True)
vertices, faces, face_numbers, vertex_numbers = tribox.crop(triangles, box, rest=True)
chosen: NDArray[np.intp] = part.face_numbers
many: NDArray[np.bool_] = tribox.overlap_boxes(triangles[0], np.zeros((5, 3)), np.ones((5, 3)))
names: List[str] = tribox.kernels()
version: str = tribox.__version__
try:
    tribox.Mesh(PyVista())
except tribox.Error as error:
    status: str = error.status or str(error)

tribox.overlap(triangles, lo, hi, accuracy="exakt")  # wrong
tribox.overlap(triangles, lo, object())  # wrong
tribox.overlap(triangles)  # wrong
tribox.overlap(triangles, lo, hi, kernel=3)  # wrong
tribox.overlap(object(), lo, hi)  # wrong
tribox.crop(triangles, lo, hi, "rest")  # wrong
tribox.find(triangles, lo, hi, "first")  # wrong
tribox.voxelize(triangles, lo, 0.5)  # wrong
tribox.voxelize(triangles, 0.5)  # wrong
tribox.voxelize(triangles, resolution=0.5)  # wrong
tribox.voxelize(triangles, resolution=64, fill="all")  # wrong
tribox.voxelize(triangles, resolution=64, fill="outside", labels="all")  # wrong
tribox.voxelize(triangles, cell=1, into=cells)  # wrong
tribox.Index(triangles, axis_order=3)  # wrong
tribox.Mesh(object())  # wrong
voxels.save(3)  # wrong
tribox.read(3)  # wrong
tribox.voxelize(triangles, cell=1, colors=lambda: 3)  # wrong
index.list(lo, hi).nothing()  # wrong
tribox.cell_lists(triangles, resolution=64, fill="outside")  # wrong
tribox.kernel_names()  # wrong
