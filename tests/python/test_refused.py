"""Arrays that cannot be read where they lie are refused, with the words to convert them by."""

import numpy as np
import tribox
from tribox import InputError, InputTypeError

import cases
from cases import HI, LO


class Refused(cases.TestCase):
    def refuse_triangles(self, error, pattern, triangles):
        calls = [lambda: tribox.overlap(triangles, LO, HI), lambda: tribox.classify(triangles, LO, HI),
                 lambda: tribox.voxelize(triangles, LO, 1, (2, 2, 2)), lambda: tribox.Soup.of(triangles)]
        for call in calls:
            self.refuse(error, None, pattern, call)

    def test_types(self):
        for triangles in ([[[0, 0, 0]] * 3], None, 1, "triangles", (np.zeros((3, 3), np.float32), np.zeros((1, 3), np.uint32))):
            self.refuse_triangles(InputTypeError, "triangles is of type .*; give a NumPy array, a tribox.Mesh or a", triangles)
        for dtype in (np.float64, np.float16, np.int32, ">f4", "S4", object):
            self.refuse_triangles(InputTypeError, r"dtype .*; convert it once: triangles\.astype\(np\.float32\)",
                                  np.zeros((1, 3, 3), dtype))

    def test_shapes(self):
        for shape in ((), (9,), (3, 3), (1, 9), (3, 3, 4), (1, 3, 2), (1, 1, 3, 3)):
            self.refuse_triangles(InputError, r"has shape \(.*; give \(n, 3, 3\)", np.zeros(shape, np.float32))

    def test_strides(self):
        triangles = cases.lattice(20)
        records = np.zeros(20, [("normal", "<f4", 3), ("vertices", "<f4", (3, 3)), ("attribute", "<u2")])
        for view in (triangles[::2], triangles[::-1], triangles[:, ::-1], triangles[:, :, ::-1], triangles.transpose(0, 2, 1),
                     np.broadcast_to(triangles[:1], (20, 3, 3)), np.broadcast_to(triangles[:, :1], (20, 3, 3)),
                     np.broadcast_to(triangles[:1, :1], (20, 3, 3)), records["vertices"]):
            self.refuse_triangles(InputError, r"strides .*np\.ascontiguousarray\(triangles\)", view)
            self.assert_same(tribox.overlap(np.ascontiguousarray(view), LO, HI), cases.truth(np.array(view), LO, HI))

    def test_meshes(self):
        vertices, faces = cases.shared_vertices(cases.lattice(20), np.uint32)
        refuse = self.refuse
        refuse(InputTypeError, None, r"vertices has dtype float64.*astype", tribox.Mesh, vertices.astype(float), faces)
        refuse(InputTypeError, None, "vertices is of type list", tribox.Mesh, vertices.tolist(), faces)
        refuse(InputError, None, r"vertices has shape \(.*, 2\); give \(m, 3\)", tribox.Mesh, vertices[:, :2], faces)
        apart = np.repeat(vertices, 2, 1)[:, ::2]
        for odd in (vertices[::-1], np.asfortranarray(vertices), apart, np.broadcast_to(vertices[:1], vertices.shape)):
            refuse(InputError, None, r"vertices has the strides .*np\.ascontiguousarray\(vertices\)", tribox.Mesh, odd, faces)
        for dtype in (np.int64, np.uint64, np.float32, np.int16, ">u4"):
            refuse(InputTypeError, None, r"faces is .*convert it once: np\.asarray\(faces, np\.uint32\)", tribox.Mesh, vertices,
                   faces.astype(dtype))
        refuse(InputTypeError, None, r"faces is list", tribox.Mesh, vertices, faces.tolist())
        for odd in (faces[:, :2], faces.ravel(), faces[::2], np.asfortranarray(faces)):
            refuse(InputError, None, r"faces has shape .*give \(n, 3\), contiguous", tribox.Mesh, vertices, odd)

    def test_streams(self):
        streams = np.zeros((3, 3, 8), np.float32)
        for odd in (streams[:2], streams[:, :2], [], [streams[0]] * 4):
            self.refuse(InputError, None, "streams must hold three axes of three vertices each", tribox.Soup, odd)
        for odd in (streams[:, :, ::2], streams[..., None], [*streams[:2], [*streams[2][:2], streams[2][2][:7]]]):
            self.refuse(InputError, None, "a stream has shape .*give nine contiguous arrays of one length", tribox.Soup, odd)
        self.refuse(InputTypeError, None, "a stream has dtype float64", tribox.Soup, streams.astype(float))
        self.refuse(InputTypeError, None, "a stream is of type list", tribox.Soup, streams.tolist())
        for odd in (3, np.zeros(3, np.float32), None):
            self.refuse(InputTypeError, None, r"streams is of type .*shape \(3, 3, n\)", tribox.Soup, odd)


if __name__ == "__main__":
    cases.main()
