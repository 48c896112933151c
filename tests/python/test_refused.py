"""What are no numbers, or numbers that float64 cannot hold, is refused, with its place."""

import numpy as np
import tribox
from tribox import BadIndexError, InputError, InputTypeError

import cases
from cases import HI, LO


class Refused(cases.TestCase):
    def refuse_triangles(self, error, pattern, triangles):
        calls = [lambda: tribox.overlap(triangles, LO, HI), lambda: tribox.classify(triangles, LO, HI),
                 lambda: tribox.voxelize(triangles, (LO, 1, (2, 2, 2))), lambda: tribox.Soup.of(triangles)]
        for call in calls:
            self.refuse(error, None, pattern, call)

    def test_types(self):
        ragged = [np.zeros((3, 3), np.float32), np.zeros((1, 3), np.uint32)]
        huge = [[[10 ** 400, 0, 0]] * 3]
        for triangles in (None, "triangles", b"t", [[[None] * 3] * 3], [[["1", 2, 3]] * 3], huge, ragged):
            self.refuse_triangles(InputTypeError, "triangles is", triangles)
        for dtype in (complex, np.complex64, bool, "S4", "U2", object, "M8[s]"):
            self.refuse_triangles(InputTypeError, "triangles is ndarray of .*; give real numbers", np.zeros((1, 3, 3), dtype))

    def test_numbers_beyond_float64(self):
        for dtype, wrong in ((np.int64, -(1 << 53) - 1), (np.uint64, (1 << 64) - 1), (np.longdouble, np.longdouble(1) / 3)):
            triangles = np.ones((20, 3, 3), dtype)
            triangles[17, 2, 0] = triangles[19, 0, 0] = wrong
            self.refuse_triangles(InputError, r"triangles\[17, 2, 0\] is .*: float64, the widest that is read, cannot hold it",
                                  triangles)

    def test_shapes(self):
        for shape in ((), (9,), (3, 3), (1, 9), (3, 3, 4), (1, 3, 2), (1, 1, 3, 3)):
            self.refuse_triangles(InputError, r"has shape \(.*; give \(n, 3, 3\)", np.zeros(shape, np.float32))

    def test_meshes(self):
        vertices, faces = cases.shared_vertices(cases.lattice(20), np.uint32)
        refuse = self.refuse
        refuse(InputTypeError, None, "vertices is ndarray of complex64", tribox.Mesh, vertices.astype(np.complex64), faces)
        refuse(InputError, None, r"vertices has shape \(.*, 2\); give \(m, 3\)", tribox.Mesh, vertices[:, :2], faces)
        for dtype in (np.float32, complex, bool, object, "U4"):
            refuse(InputTypeError, None, "faces is ndarray of .*; give whole numbers", tribox.Mesh, vertices, faces.astype(dtype))
        for odd in (faces[:, :2], faces.ravel(), faces[None]):
            refuse(InputError, None, r"faces has shape .*give \(n, 3\): triangle, vertex", tribox.Mesh, vertices, odd)
        for odd in (np.eye(3), [[0, 1, 2.0]], "faces"):
            refuse(InputTypeError, None, "faces is .*; give whole numbers", tribox.Mesh, vertices, odd)

    def test_indices(self):
        """Where faces have to be copied anyway their indices are looked at."""
        vertices, faces = cases.shared_vertices(cases.lattice(20), np.int64)
        for wrong in (-1, len(vertices), 1 << 32, -(1 << 63)):
            bad = faces.copy()
            bad[17, 2] = bad[19, 0] = wrong
            for form in (bad, bad.tolist(), bad.astype(">i8"), np.asfortranarray(bad)):
                self.refuse(BadIndexError, "BAD_VERTEX", fr"faces\[17, 2\] is {wrong}, but there are {len(vertices)} vertices; "
                            "wrong indices in all: 2", tribox.Mesh, vertices, form)

    def test_streams(self):
        streams = np.zeros((3, 3, 8), np.float32)
        for odd in (streams[:2], streams[:, :2], [], [streams[0]] * 4):
            self.refuse(InputError, None, "streams must hold three axes of three vertices each", tribox.Soup, odd)
        for odd in (streams[:, :, ::2], streams[..., None], [*streams[:2], [*streams[2][:2], streams[2][2][:7]]]):
            self.refuse(InputError, None, "a stream has shape .*give nine contiguous arrays of one length", tribox.Soup, odd)
        self.refuse(InputTypeError, None, r"a stream is float64; .*tribox\.Soup\.of\(triangles\)", tribox.Soup,
                    streams.astype(float))
        self.refuse(InputTypeError, None, "a stream is list", tribox.Soup, streams.tolist())
        for odd in (3, np.zeros(3, np.float32), None):
            self.refuse(InputTypeError, None, r"streams is of type .*shape \(3, 3, n\)", tribox.Soup, odd)


if __name__ == "__main__":
    cases.main()
