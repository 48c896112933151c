"""Open3D's ways."""

import numpy as np
import open3d

from asked import triangles_of

NAME = "Open3D " + open3d.__version__


def made(task):
    return open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(task.vertices), open3d.utility.Vector3iVector(task.faces))


def voxels(task):
    mesh, size, cell, first = made(task), np.array(task.grid.size), task.grid.cell[0], task.middle()  # cell 0 lies around a bound

    def answer(grid):
        cells = np.zeros(size, bool)
        at = np.array([voxel.grid_index for voxel in grid.get_voxels()]).reshape(-1, 3)
        cells[tuple(at[(at < size).all(1)].T)] = True
        return cells.T
    make = open3d.geometry.VoxelGrid.create_from_triangle_mesh_within_bounds
    return lambda: make(mesh, cell, first, first + cell * size), answer


def crop(task):
    mesh, box = made(task), open3d.geometry.AxisAlignedBoundingBox(task.lo, task.hi)
    return lambda: mesh.crop(box), lambda part: triangles_of(part.vertices, part.triangles)


WAYS = {"surface": ("VoxelGrid", voxels), "crop inside": ("crop", crop)}
