"""crop(): the mesh of the triangles in a box, and of the others, in every form in which triangles come."""

from types import SimpleNamespace

import numpy as np
import tribox
from tribox import BadIndexError, InputError

import cases

LO, HI = (-1.5, -1.375, -1.5), (1.25, 1.625, 1.5)


class Crop(cases.TestCase):
    def setUp(self):
        self.triangles = cases.lattice(200)
        self.vertices, self.faces = cases.shared_vertices(self.triangles, np.int32)
        self.truth = cases.truth(self.triangles, LO, HI)

    def check(self, part, vertices, faces, mask):
        """By sets and dictionaries. vertices, faces: the whole mesh."""
        numbers = [n for n, is_set in enumerate(mask.tolist()) if is_set]
        corners = faces.tolist()
        used = sorted({c for n in numbers for c in corners[n]})
        place = {c: n for n, c in enumerate(used)}
        self.assertIs(type(part), tribox.Cropped)
        self.assert_same(part.face_numbers, np.array(numbers, np.intp))
        self.assert_same(part.vertex_numbers, np.array(used, np.intp))
        self.assert_same(part.vertices, vertices[used].reshape(-1, 3))
        self.assert_same(part.faces, np.array([[place[c] for c in corners[n]] for n in numbers], np.uint32).reshape(-1, 3))

    def check_all(self, triangles, vertices, faces):
        inside = self.triangles.min(1) >= LO
        inside = inside.all(1) & (self.triangles.max(1) <= HI).all(1)
        self.assertTrue(0 < inside.sum() < self.truth.sum() < len(self.truth))
        for options, mask in (({}, self.truth), ({"inside": True}, inside)):
            self.check(tribox.crop(triangles, LO, HI, **options), vertices, faces, mask)
            self.check(tribox.crop(triangles, (LO, HI), rest=True, **options), vertices, faces, ~mask)

    def test_forms(self):
        unused = np.concatenate([self.vertices[:1], self.vertices, self.vertices[:2]])
        for dtype in (np.uint16, np.int32, np.int64):
            for vertices in (unused, unused.astype(float), np.asfortranarray(unused)):
                faces = (self.faces + 1).astype(dtype)
                self.check_all((vertices, faces), vertices, faces)
                self.check_all(tribox.Mesh(vertices, faces), vertices, faces)
        self.check_all(SimpleNamespace(vertices=self.vertices, faces=self.faces), self.vertices, self.faces)
        counted = np.insert(self.faces.astype(np.int64), 0, 3, 1).ravel()
        self.check_all(SimpleNamespace(points=self.vertices, faces=counted, n_strips=0), self.vertices, self.faces)
        rows, each = self.triangles.reshape(-1, 3), np.arange(600).reshape(-1, 3)
        for triangles in (self.triangles, self.triangles.tolist(), tribox.Soup.of(self.triangles), np.asfortranarray(self.triangles)):
            of = rows.astype(float) if isinstance(triangles, list) else rows
            self.check_all(triangles, of, each)

    def test_attributes(self):
        """A look-up gives what belongs to each face and each vertex."""
        colors, normals = np.arange(200), np.arange(len(self.vertices)) * 0.5
        part = tribox.crop((self.vertices, self.faces), LO, HI)
        np.testing.assert_array_equal(part.vertices[part.faces], self.triangles[colors[part.face_numbers]])
        np.testing.assert_array_equal(normals[part.vertex_numbers][part.faces], normals[self.faces[part.face_numbers]])
        again = tribox.crop((part.vertices, part.faces), LO, HI)
        self.assert_same(again.face_numbers, np.arange(len(part.faces)))
        self.assert_same(again.vertices, part.vertices)
        self.assert_same(again.faces, part.faces)

    def test_oriented(self):
        box = tribox.OrientedBox((0.125, 0, 0), (0.5, 0.75, 1), ((0.8, 0.6, 0), (-0.6, 0.8, 0), (0, 0, 1)))
        mask = tribox.overlap_oriented(self.triangles, *box)
        self.check(tribox.crop((self.vertices, self.faces), box), self.vertices, self.faces, mask)
        for options in ({"inside": True}, {"hi": HI}):
            self.refuse(InputError, None, "give an OrientedBox without them", tribox.crop, self.triangles, box, **options)

    def test_odd_triangles(self):
        """What is not finite is in the rest, as it was; none and all are meshes, too."""
        vertices = np.concatenate([self.vertices, [[np.nan, -0.0, np.inf]]]).astype(np.float32)
        faces = np.concatenate([self.faces, [[len(self.vertices), 0, 0]], [[1, 1, 1]]])
        rest = tribox.crop((vertices, faces), LO, HI, rest=True)
        self.assertIn(200, rest.face_numbers)
        self.assertEqual(rest.vertices[-1].tobytes(), vertices[-1].tobytes())
        nothing = tribox.crop((self.vertices, self.faces), HI, LO)
        self.assertEqual([array.shape for array in nothing], [(0, 3), (0, 3), (0,), (0,)])
        self.assertEqual(nothing.vertices.dtype, np.float32)
        self.check(tribox.crop((vertices, faces), HI, LO, rest=True), vertices, faces, np.ones(202, bool))
        self.assertEqual(len(tribox.crop(self.triangles[:0], LO, HI).faces), 0)

    def test_wrong(self):
        self.refuse(BadIndexError, "BAD_VERTEX", "faces", tribox.crop, (self.vertices[:9], self.faces), LO, HI)
        self.refuse(BadIndexError, "BAD_VERTEX", "faces", tribox.crop, (self.vertices, self.faces - 9), HI, LO, rest=True)


if __name__ == "__main__":
    cases.main()
