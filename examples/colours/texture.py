"""A texture on the cells of a mesh, by the number of the triangle in each: texture.py OUT.ply [RESOLUTION] makes a globe with one.

colours_of takes what trimesh and Open3D have: corners of triangles, their texture coordinates, and the pixels.
"""

import sys

import numpy as np
import tribox


def places_in(triangles, points):
    """Of one point each: the barycentric coordinates of what the triangle's plane has nearest to it, none below 0."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    normals = np.cross(b - a, c - a)
    area = np.maximum((normals * normals).sum(-1), np.finfo(float).tiny)  # a segment gives its first corner
    v = (np.cross(points - a, c - a) * normals).sum(-1) / area
    w = (np.cross(b - a, points - a) * normals).sum(-1) / area
    places = np.maximum(np.stack([1 - v - w, v, w], axis=-1), 0)
    return places / places.sum(-1, keepdims=True)


def colours_of(voxels, triangles, coordinates, pixels):
    """The colour of each set cell.

    coordinates: (n, 3, 2), u and v of each corner. pixels: (height, width, 3), whose first row is v = 1.
    """
    places = places_in(triangles[voxels.ids].astype(float), voxels.points())
    u, v = np.einsum("nc,ncd->dn", places, coordinates[voxels.ids]) % 1
    return pixels[((1 - v) * pixels.shape[0]).astype(int) % pixels.shape[0], (u * pixels.shape[1]).astype(int)]


def globe(around=96, up=48):
    """Triangles of a sphere, u from west to east and v from south to north."""
    u, v = np.meshgrid(np.linspace(0, 1, around + 1), np.linspace(0, 1, up + 1), indexing="ij")
    east, north = 2 * np.pi * u, np.pi * (v - 0.5)
    points = np.stack([np.cos(east) * np.cos(north), np.sin(east) * np.cos(north), np.sin(north), u, v], axis=-1)
    a, b, c, d = points[:-1, :-1], points[1:, :-1], points[1:, 1:], points[:-1, 1:]
    corners = np.concatenate([np.stack(corner, axis=2).reshape(-1, 3, 5) for corner in ((a, b, c), (a, c, d))])
    return corners[..., :3].astype(np.float32), corners[..., 3:]


def stripes():
    """Pixels of 12 meridian stripes, light and dark, red in the north."""
    row, column = np.mgrid[0:64, 0:120]
    light = np.where(column // 10 % 2, 230, 70)
    return np.stack([np.maximum(light, 230 * (row < 16)), light, light], axis=-1).astype(np.uint8)


def write_points(path, points, colours):
    cells = np.empty(len(points), [("at", "<f4", 3), ("colour", "u1", 3)])
    cells["at"], cells["colour"] = points, colours
    names = "".join(f"property float {n}\n" for n in "xyz") + "".join(f"property uchar {n}\n" for n in ("red", "green", "blue"))
    with open(path, "wb") as file:
        file.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(cells)}\n{names}end_header\n".encode())
        file.write(cells.tobytes())


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    mesh, uv = globe()
    found = tribox.voxelize(mesh, resolution=int(sys.argv[2]) if len(sys.argv) > 2 else 100, ids=True)
    write_points(sys.argv[1], found.points(), colours_of(found, mesh, uv, stripes()))
