"""Triangles as people hold them: read where they lie, kept alive, called what they are; and cropped with their numbers."""

import doctest
import inspect
import os
import tempfile
import tracemalloc
import weakref

import numpy as np
import tribox

import cases
from cases import HI, LO

try:
    import meshio
except ImportError:
    meshio = None


def start_of(array):
    return array.__array_interface__["data"][0]


def address(pointer):
    return int(tribox._ffi.ffi.cast("uintptr_t", pointer))


class Layouts(cases.TestCase):
    def setUp(self):
        self.triangles = cases.lattice(200)
        self.expected = cases.truth(self.triangles, LO, HI)

    def read_in_place(self, triangles):
        """The answers are right, and the struct points to the array."""
        self.assert_same(tribox.overlap(triangles, LO, HI), self.expected)
        struct = tribox._triangles.held(triangles).struct
        pointer = struct.x[0] if hasattr(struct, "x") else struct.positions
        self.assertIn(start_of(triangles), [address(pointer) + (8 if getattr(struct, "axes", 0) else 0)])

    def test_arrays(self):
        """Rows and columns, of floats and of doubles, of structured dtypes and of files."""
        store = np.zeros((200, 3), [("colour", np.uint8, 4), ("position", np.float32, 3)])
        store["position"] = self.triangles
        read_only = self.triangles.copy()
        read_only.flags.writeable = False
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "triangles.npy")
            np.save(path, self.triangles)
            for array in (self.triangles, *(cases.padded(self.triangles, more) for more in (2, 5, 9)), store["position"],
                          cases.aligned_badly(self.triangles), np.asfortranarray(self.triangles),
                          np.ascontiguousarray(self.triangles.T).T,
                          self.triangles[:, :, ::-1].copy()[:, :, ::-1], self.triangles[:], read_only, np.load(path, mmap_mode="r"),
                          self.triangles.astype(float), cases.padded(self.triangles.astype(float))):
                self.read_in_place(array)
        for i in range(20):  # with one triangle the distance to the next is ignored
            for one in (self.triangles[i::200], self.triangles[i:i + 1], cases.padded(self.triangles)[i::200]):
                self.assert_same(tribox.overlap(one, LO, HI), self.expected[i:i + 1])

    def test_meshes(self):
        for points in (np.float32, float):
            vertices, faces = cases.shared_vertices(self.triangles.astype(points), np.uint32)
            room = np.full((len(vertices), 7), np.nan, points)
            room[:, 1:6:2] = vertices
            for array in (vertices, np.asfortranarray(vertices), room[:, 1:6:2], cases.aligned_badly(vertices)):
                for indices in (faces, faces.astype(np.uint16), faces.astype(np.int32), cases.aligned_badly(faces)):
                    mesh = tribox.Mesh(array, indices)
                    if not (array.strides[1] == room.strides[1] * 2 and points is np.float32):
                        self.assertEqual(address(mesh.struct.positions), start_of(array))
                    self.assertEqual(address(mesh.struct.indices), start_of(indices))
                    self.assertEqual(len(mesh), 200)
                    self.assert_same(tribox.overlap(mesh, LO, HI), self.expected)
        self.assertEqual(tribox.overlap(tribox.Mesh(vertices[:0], faces[:0]), LO, HI).size, 0)
        self.assertEqual(tribox.overlap(tribox.Mesh(vertices[:1], 0 * faces[:1]), LO, HI).size, 1)
        wide = self.triangles.astype(float)
        self.assertIs(tribox.Mesh(wide).vertices, wide)
        self.assertIsNone(tribox.Mesh(wide).faces)
        self.assertIs(tribox.Mesh(tribox.Mesh(vertices, faces)).vertices, vertices)

    def test_soups(self):
        streams = np.ascontiguousarray(self.triangles.T)
        for view in (streams, cases.aligned_badly(streams), np.concatenate([streams, streams], 2)[:, :, :200], streams[::-1][::-1]):
            self.assert_same(tribox.overlap(tribox.Soup(view), LO, HI), self.expected)
        struct = tribox.Soup(streams).struct
        for v in range(3):
            self.assertEqual([address(axis[v]) for axis in (struct.x, struct.y, struct.z)],
                             [start_of(streams[a][v]) for a in range(3)])
        for form in cases.forms(self.triangles):
            soup = tribox.Soup.of(form)
            self.assert_same(soup.streams, streams)
            self.assertFalse(isinstance(form, np.ndarray) and np.shares_memory(soup.streams, form))

    def test_libraries(self):
        """All calls take their meshes, and none triangles."""
        vertices, faces = cases.shared_vertices(self.triangles, np.int32)
        others = list(cases.of_libraries(vertices, faces))
        if meshio:
            others.append(meshio.Mesh(vertices, [("triangle", faces[:7]), ("vertex", [[0]]), ("triangle", faces[7:])]))
        for mesh in others:
            self.assert_same(tribox.overlap(tribox.Mesh(tribox.Mesh(mesh)), LO, HI), self.expected)
            self.assertEqual(tribox.grid_around(mesh, 9), tribox.grid_around(self.triangles, 9))
        none = np.empty((0, 3))
        for mesh in (dict(points=none, faces=np.empty(0, int)), dict(points=none, cells_dict={})):
            self.assertEqual(tribox.overlap(cases.SimpleNamespace(**mesh), LO, HI).shape, (0,))

    def nine(self):
        return [[self.triangles[:, v, axis].copy() for v in range(3)] for axis in range(3)]

    def test_what_is_held_lives(self):
        """Arrays are kept that a struct points into: also where a container hands out copies, or loses them."""
        handed = []

        class Axis:
            def __init__(self, streams):
                self.streams = streams

            def __len__(self):
                return 3

            def __getitem__(self, v):
                if v > 2:
                    raise IndexError
                copy = self.streams[v].copy()
                handed.append(weakref.ref(copy))
                return copy

        copies = tribox.Soup([Axis(streams) for streams in self.nine()])
        nested, objects = self.nine(), np.empty((3, 3), object)
        for axis, v in np.ndindex(3, 3):
            objects[axis, v] = nested[axis][v].copy()
            handed += weakref.ref(nested[axis][v]), weakref.ref(objects[axis, v])
        soups = copies, tribox.Soup(nested), tribox.Soup(objects)
        mesh = tribox.Mesh(*cases.shared_vertices(self.triangles, np.uint32))
        kept = tribox.Index(tribox.Soup.of(self.triangles), keep_order=True)
        objects[:] = None
        for streams in nested:
            streams[:] = [None] * 3
        self.assertEqual(([reference for reference in handed if reference() is None], len(handed)), ([], 27))
        for _ in range(20):
            np.full((200, 3, 3), np.nan, np.float32)
            for form in (*soups, mesh):
                self.assert_same(tribox.overlap(form, LO, HI), self.expected)
            self.assert_same(kept.overlap(LO, HI), self.expected)
        for soup in soups:
            self.assert_same(np.array(soup.streams), np.ascontiguousarray(self.triangles.T))

    def test_arrays_stay(self):
        """What a struct points into cannot be replaced; an Index that keeps the order reads a Soup in place, copies all else."""
        mesh, streams = tribox.Mesh(*cases.shared_vertices(self.triangles, np.uint32)), np.ascontiguousarray(self.triangles.T)
        soup, wide = tribox.Soup(streams), self.triangles.astype(float)
        self.assertIs(soup.streams, streams)
        for thing, name in ((mesh, "vertices"), (mesh, "faces"), (soup, "streams")):
            with self.assertRaises(AttributeError, msg=name):
                setattr(thing, name, getattr(thing, name)[:1].copy())
        for form in (self.triangles, soup, wide, tribox.Mesh(wide), tribox.Mesh(self.triangles)):
            for keep_order in (False, True):
                index, before = tribox.Index(form, keep_order=keep_order), streams.copy()
                self.triangles[:], streams[:], wide[:] = np.nan, np.nan, np.nan
                self.assert_same(index.overlap(LO, HI), self.expected & (not (keep_order and form is soup)))
                self.triangles[:], streams[:], wide[:] = before.T, before, before.T

    def peak(self, call):
        tracemalloc.start()
        try:
            call()
            return tracemalloc.get_traced_memory()[1]
        finally:
            tracemalloc.stop()

    def test_big_arrays(self):
        """36 MB of triangles take the memory of the answer, or of a block of streams, and no more."""
        triangles = np.resize(cases.lattice(1000), (1000000, 3, 3))
        mesh = tribox.Mesh(triangles.reshape(-1, 3), np.arange(3000000, dtype=np.uint32).reshape(-1, 3))
        streams = tribox.Soup.of(triangles)
        for form in (triangles, mesh, streams, streams.streams.T):
            for call, most in ((lambda: tribox.overlap(form, LO, HI), 1.3e6),
                               (lambda: tribox.overlap(form, LO, HI, packed=True), 3e5),
                               (lambda: tribox.overlap_any(form, HI, LO), 3e6),
                               (lambda: tribox.voxelize(form, (LO, 1, (2, 2, 2))), 3e6)):
                self.assertLess(self.peak(call), most)


class Crop(cases.TestCase):
    def test_parts(self):
        """Corners are where they were, in the order of the mesh, none that no face has; with their numbers in it."""
        triangles = cases.lattice(200)
        lo, hi = (-1.5, -1.375, -1.5), (1.25, 1.625, 1.5)
        mask = cases.truth(triangles, lo, hi)
        for form in cases.forms(triangles):
            held = tribox._triangles.held(form)
            for rest, wanted in ((False, mask), (True, ~mask)):
                part = tribox.crop(form, lo, hi, rest=rest)
                self.assertIs(type(part), tribox.Cropped)
                self.assert_same(part.face_numbers, np.flatnonzero(wanted))
                self.assertEqual((part.faces.dtype, part.vertex_numbers.dtype), (np.uint32, np.intp))
                np.testing.assert_array_equal(part.vertices[part.faces], triangles[wanted])
                self.assertEqual(np.unique(part.faces).tolist(), list(range(len(part.vertices))))
                self.assertTrue((np.diff(part.vertex_numbers) > 0).all())
                if held.faces is None:
                    self.assertEqual(part.vertex_numbers.tolist(), [3 * n + v for n in np.flatnonzero(wanted) for v in range(3)])
                else:
                    self.assert_same(part.vertices, held.vertices[part.vertex_numbers])
        again = tribox.crop((part.vertices, part.faces), lo, hi, rest=True)
        for one, other in zip(again, (part.vertices, part.faces, np.arange(len(part.faces)), np.arange(len(part.vertices)))):
            self.assert_same(one, other)

    def test_odd_triangles(self):
        """What is not finite is in the rest, as it was; none and all are meshes, too."""
        vertices, faces = cases.shared_vertices(cases.lattice(200), np.int32)
        vertices = np.concatenate([vertices, [[np.nan, -0.0, np.inf]]]).astype(np.float32)
        faces = np.concatenate([faces, [[len(vertices) - 1, 0, 0]], [[1, 1, 1]]])
        rest, nothing = tribox.crop((vertices, faces), LO, HI, rest=True), tribox.crop((vertices, faces), HI, LO)
        self.assertIn(200, rest.face_numbers)
        self.assertEqual(rest.vertices[-1].tobytes(), vertices[-1].tobytes())
        self.assertEqual(([array.shape for array in nothing], nothing.vertices.dtype), ([(0, 3), (0, 3), (0,), (0,)], np.float32))
        self.assertEqual(len(tribox.crop((vertices, faces), HI, LO, rest=True).faces), 202)
        self.assertEqual(len(tribox.crop(vertices[:0].reshape(-1, 3, 3), LO, HI).faces), 0)


class Words(cases.TestCase):
    def test_reprs(self):
        triangles = np.array([[[0, 0, 0], [1, 0, 0], [0, 2, 0.1]], [[np.nan] * 3] * 3], np.float32)
        vertices, faces = triangles.reshape(-1, 3), np.arange(6, dtype=np.uint16).reshape(2, 3)
        where, bytes_ = "from (0, 0, 0) to (1, 2, 0.1)>", tribox._library.lib.tribox_index_bytes(2)
        grid = tribox.voxelize(cases.lattice(40), ((-8, -8, -8), 8, (2, 2, 2)))
        part = tribox.voxelize(cases.lattice(40), grid.grid, window=((1, 0, 0), (1, 1, 1)))
        for thing, text in (
                (tribox.Mesh(vertices, faces), "<tribox.Mesh: 6 vertices of float32, 2 faces of uint16, " + where),
                (tribox.Mesh(vertices, faces + 1), "<tribox.Mesh: 6 vertices of float32, 2 faces of uint16, with wrong indices>"),
                (tribox.Soup.of(triangles), "<tribox.Soup: 2 triangles, " + where),
                (tribox.Soup.of(triangles[1:]), "<tribox.Soup: 1 triangles, without bounds>"),
                (tribox.Soup.of(triangles[:0]), "<tribox.Soup: 0 triangles, without bounds>"),
                (tribox.Index(triangles), f"<tribox.Index: 2 triangles of float32 in order, {bytes_} bytes, {where}"),
                (tribox.Index(triangles, keep_order=True),
                 f"<tribox.Index: 2 triangles of float32 as given, {bytes_} bytes, {where}"),
                (grid, "<tribox.Voxels: 8 of 2 x 2 x 2 cells, from (-8, -8, -8) to (8, 8, 8)>"),
                (part, "<tribox.Voxels: 1 of 1 x 1 x 1 cells of a grid of 2 x 2 x 2 cells, from (0, -8, -8) to (8, 0, 0)>"),
                (tribox.cell_lists(triangles[:0], grid.grid),
                 "<tribox.CellLists: 0 triangles in 0 cells, of a grid of 2 x 2 x 2 cells>")):
            self.assertEqual(repr(thing), text)
        self.assertIn("of float64 in order", repr(tribox.Index(triangles.astype(float))))
        repr(tribox.voxelize(cases.lattice(40), grid.grid, layers=(2, 0)))

    def test_examples(self):
        results = doctest.testmod(tribox)
        self.assertEqual((results.failed, results.attempted > 0), (0, True))

    def test_names(self):
        for name in tribox.__all__:
            self.assertTrue(not callable(getattr(tribox, name)) or inspect.getdoc(getattr(tribox, name)), name)
        kernels = tribox.kernels()
        self.assertEqual((tribox.kernel_name(), tribox.kernel_name("scalar")), (kernels[0], kernels[-1]))
        self.assertEqual(tribox.AXES_BOX | tribox.AXES_PLANE | tribox.AXES_EDGES, tribox.AXES_ALL)
        self.assertEqual(tribox.mask_indices(np.zeros(3, np.uint64)).size, 0)
        self.assertEqual(tribox.mask_indices(np.array([1, 0, 1 << 63], np.uint64)).tolist(), [0, 191])


if __name__ == "__main__":
    cases.main()
