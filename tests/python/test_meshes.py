"""Meshes of other libraries are taken as they are, wherever triangles are, and look like what they are."""

from types import SimpleNamespace

import numpy as np
import tribox
from tribox import InputError, InputTypeError

import cases
from cases import HI, LO

try:
    import meshio
except ImportError:
    meshio = None

GRID = (-1, -1, -1), 0.25, (8, 8, 8)


class Vector3d:
    """Open3D's vectors: no array, but NumPy makes one of them."""

    def __init__(self, rows):
        self.rows = rows

    def __array__(self, dtype=None, copy=None):
        return self.rows if dtype is None else self.rows.astype(dtype)

    def __len__(self):
        return len(self.rows)


def counted(faces):
    """PyVista's faces: 3, a, b, c, 3, ..."""
    return np.insert(faces.astype(np.int64), 0, 3, 1).ravel()


class Meshes(cases.TestCase):
    def setUp(self):
        self.triangles = cases.lattice(60)
        self.vertices, self.faces = cases.shared_vertices(self.triangles, np.int32)

    def trimesh(self):
        return SimpleNamespace(vertices=self.vertices.astype(float), faces=self.faces.astype(np.int64), triangles=self.triangles)

    def open3d(self):
        return SimpleNamespace(vertices=Vector3d(self.vertices.astype(float)), triangles=Vector3d(self.faces))

    def pyvista(self):
        return SimpleNamespace(points=self.vertices, faces=counted(self.faces), n_strips=0)

    def by_rows(self):
        return SimpleNamespace(points=self.vertices, faces=self.faces)

    def cells(self, **others):
        return SimpleNamespace(points=self.vertices.astype(float), cells_dict={"triangle": self.faces.astype(np.int64), **others})

    def forms(self):
        yield from (self.trimesh(), self.open3d(), self.pyvista(), self.by_rows(), self.cells(line=np.array([[0, 1]])))
        if meshio:
            yield meshio.Mesh(self.vertices, [("triangle", self.faces[:7]), ("vertex", [[0]]), ("triangle", self.faces[7:])])

    def test_calls(self):
        expected = cases.truth(self.triangles, LO, HI)
        cells = tribox.voxelize(self.triangles, GRID)
        around = tribox.grid_around(self.triangles, 9)
        for mesh in self.forms():
            self.assert_same(tribox.overlap(mesh, LO, HI), expected)
            self.assert_same(tribox.classify(mesh, LO, HI)[0], expected)
            self.assertEqual(tribox.overlap_any(mesh, LO, HI), expected.any())
            self.assertEqual(tribox.overlap_all(mesh, LO, HI), expected.all())
            self.assertEqual(tribox.overlap_oriented(mesh, (0, 0, 0), (9, 9, 9), np.eye(3)).shape, expected.shape)
            self.assert_same(np.sort(tribox.Index(mesh).list(LO, HI)), np.flatnonzero(expected).astype(np.uint32))
            self.assert_same(tribox.Soup.of(mesh).streams, np.ascontiguousarray(self.triangles.T))
            self.assert_same(tribox.voxelize(mesh, GRID, threads=2), cells)
            self.assertEqual(tribox.grid_around(mesh, 9), around)
            self.assertEqual(tribox.voxelize(mesh, resolution=9).grid, tribox.grid_around(mesh, 9))
            self.assertEqual(len(tribox.bricks(mesh, GRID).cells()), cells.sum())
            self.assert_same(tribox.overlap(tribox.Mesh(mesh), LO, HI), expected)

    def test_mesh(self):
        """Mesh(...) takes whatever the calls take, without a copy where they need none."""
        expected = cases.truth(self.triangles, LO, HI)
        pair = self.vertices, self.faces
        wide = self.triangles.astype(float)
        for form in (*self.forms(), pair, (self.vertices.tolist(), self.faces.tolist()), self.triangles, self.triangles.tolist(),
                     wide, np.asfortranarray(wide), tribox.Soup.of(self.triangles), tribox.Mesh(*pair),
                     tribox.Mesh(self.triangles)):
            mesh = tribox.Mesh(form)
            self.assertEqual(len(mesh), len(self.triangles))
            self.assert_same(tribox.overlap(mesh, LO, HI), expected)
            self.assert_same(tribox.overlap(form, LO, HI), expected)
            self.assert_same(tribox.overlap(tribox.Mesh(mesh), LO, HI), expected)
            repr(mesh)
        by_rows = tribox.Mesh(self.by_rows())
        self.assertIs(by_rows.vertices, self.vertices)
        self.assertIs(tribox.Mesh(by_rows).vertices, self.vertices)
        self.assertIs(tribox.Mesh(wide).vertices, wide)
        self.assertIsNone(tribox.Mesh(wide).faces)
        self.assertEqual(tribox.Mesh(self.trimesh()).vertices.dtype, float)
        for odd in (3, [[1, 2, 3]], self.vertices, SimpleNamespace(vertices=self.vertices), None, (self.vertices,), "mesh"):
            self.refuse((InputError, InputTypeError), None, r"^triangles .*give .*\(n, 3, 3\)", tribox.Mesh, odd)
        for odd in ((self.vertices, self.vertices), (self.vertices, "faces")):
            self.refuse(InputTypeError, None, "^faces is .*; give whole numbers", tribox.Mesh, odd)

    def test_nothing(self):
        none = np.empty((0, 3))
        for mesh in (SimpleNamespace(points=none, faces=np.empty(0, int)), SimpleNamespace(points=none, cells_dict={})):
            self.assertEqual(tribox.overlap(mesh, LO, HI).shape, (0,))

    def refused(self, pattern, mesh, error=InputError):
        for call in (tribox.overlap, tribox.classify):
            self.refuse(error, None, pattern, call, mesh, LO, HI)
        self.refuse(error, None, pattern, tribox.voxelize, mesh, GRID)

    def test_other_cells(self):
        """No triangle is left out in silence."""
        quad = np.array([[0, 1, 2, 3]])
        for kind in ("quad", "tetra", "triangle6"):
            mesh = self.cells(**{kind: quad})
            self.refused(f"triangles has cells of kind '{kind}'; make triangles of them, or give tribox.Mesh", mesh)
        mixed = np.concatenate([counted(self.faces), [4, 0, 1, 2, 3]])
        hidden = np.array([2, 0, 1, 4, 0, 1, 2, 3])  # as many numbers as two triangles have
        for faces in (mixed, hidden, counted(self.faces)[:-1]):
            mesh = SimpleNamespace(points=self.vertices, faces=faces)
            self.refused("triangles has faces that are no triangles, .*; give mesh.triangulate()", mesh)
        strips = self.pyvista()
        strips.n_strips = 1
        self.refused("or strips; give mesh.triangulate()", strips)

    def test_names(self):
        """What is wrong is called what the caller calls it."""
        flat = SimpleNamespace(points=self.vertices[:, :2], faces=self.faces)
        self.refused(r"^points has shape \(.*, 2\); give \(m, 3\)", flat)
        wrong = SimpleNamespace(vertices=self.vertices, triangles=self.faces.astype(float))
        self.refused("^triangles is ndarray of float64; give whole numbers", wrong, InputTypeError)
        for odd in (SimpleNamespace(vertices=self.vertices), object()):
            self.refused(r"^triangles is .* of object; give real numbers, in an array of shape \(n, 3, 3\), or a mesh", odd,
                         InputTypeError)


class Reprs(cases.TestCase):
    def setUp(self):
        self.triangles = np.array([[[0, 0, 0], [1, 0, 0], [0, 2, 0.1]], [[np.nan] * 3] * 3], np.float32)

    def test_meshes(self):
        vertices, faces = self.triangles.reshape(-1, 3), np.arange(6, dtype=np.uint16).reshape(2, 3)
        where = "from (0, 0, 0) to (1, 2, 0.1)>"
        self.assertEqual(repr(tribox.Mesh(vertices, faces)), "<tribox.Mesh: 6 vertices of float32, 2 faces of uint16, " + where)
        self.assertEqual(repr(tribox.Soup.of(self.triangles)), "<tribox.Soup: 2 triangles, " + where)
        self.assertTrue(repr(tribox.Mesh(vertices, faces + 1)).endswith("2 faces of uint16, with wrong indices>"))
        self.assertEqual(repr(tribox.Soup.of(self.triangles[1:])), "<tribox.Soup: 1 triangles, without bounds>")
        self.assertEqual(repr(tribox.Soup.of(self.triangles[:0])), "<tribox.Soup: 0 triangles, without bounds>")

    def test_index(self):
        where = r"from \(0, 0, 0\) to \(1, 2, 0\.1\)"
        self.assertRegex(repr(tribox.Index(self.triangles)),
                         rf"^<tribox.Index: 2 triangles of float32 in order, \d+ bytes, {where}>$")


if __name__ == "__main__":
    cases.main()
