"""Meshes of other libraries, which are known by their attributes: where their vertices and triangles are."""

import numpy as np

from ._errors import InputError

NO_AREA = "vertex", "line"  # cells that no box is asked about


def as_they_are(mesh, faces):
    return faces


def of_blocks(mesh, cells):
    """The triangles of meshio, whose cells come by kind."""
    others = [kind for kind in cells if kind != "triangle" and kind not in NO_AREA]
    if others:
        raise InputError(f"triangles has cells of kind {', '.join(map(repr, others))}; make triangles of them, or give "
                         'tribox.Mesh(mesh.points, mesh.cells_dict["triangle"]) for those that are triangles alone')
    return cells.get("triangle", np.empty((0, 3), np.uint32))


def of_polygons(mesh, faces):
    """The triangles of PyVista, where each face is the number of its vertices and then these."""
    faces = np.asarray(faces)
    if faces.ndim != 1:
        return faces
    if faces.size % 4 or (faces[::4] != 3).any() or getattr(mesh, "n_strips", 0):
        raise InputError("triangles has faces that are no triangles, or strips; give mesh.triangulate()")
    return faces.reshape(-1, 4)[:, 1:]


# trimesh, Open3D, meshio, PyVista, and whatever is like them.
FORMS = (("vertices", "faces", as_they_are), ("vertices", "triangles", as_they_are), ("points", "cells_dict", of_blocks),
         ("points", "faces", of_polygons))


def parts_of(mesh):
    """(name, vertices, name, faces) of a mesh; None if it is none."""
    for vertices, faces, triangles_of in FORMS:
        if hasattr(mesh, vertices) and hasattr(mesh, faces):
            return vertices, getattr(mesh, vertices), faces, triangles_of(mesh, getattr(mesh, faces))
    return None
