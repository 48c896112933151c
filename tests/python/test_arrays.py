"""Arrays as people hold them are read where they lie."""

import os
import tempfile
import tracemalloc
import weakref

import numpy as np
import tribox

import cases
from cases import HI, LO


def start_of(array):
    return array.__array_interface__["data"][0]


def address(pointer):
    return int(tribox._ffi.ffi.cast("uintptr_t", pointer))


def aligned_badly(array):
    """A copy of an array at an address that is not a multiple of its item's size."""
    store = np.zeros(array.nbytes + 1, np.uint8)
    copy = store[1:].view(array.dtype).reshape(array.shape)
    copy[...] = array
    return copy


class Layouts(cases.TestCase):
    def setUp(self):
        self.triangles = cases.lattice(200)
        self.expected = cases.truth(self.triangles, LO, HI)

    def read_in_place(self, triangles):
        """The answers are right, and the struct points to the array."""
        self.assert_same(tribox.overlap(triangles, LO, HI), self.expected)
        struct = tribox._triangles.held(triangles).struct
        self.assertIn(start_of(triangles), [address(struct.x[0])] if hasattr(struct, "x") else [address(struct.positions) + (8 if struct.axes else 0)])

    def padded(self, dtype_bytes):
        """Vertices with something else after x, y, z."""
        store = np.full((200, 3, dtype_bytes // 4), np.nan, np.float32)
        store[:, :, :3] = self.triangles
        return store[:, :, :3]

    def test_arrays(self):
        self.read_in_place(self.triangles)
        for size in (16, 32, 48):
            self.read_in_place(self.padded(size))
        self.read_in_place(aligned_badly(self.triangles))
        self.read_in_place(np.asfortranarray(self.triangles))
        self.read_in_place(self.triangles[:, :, ::-1].copy()[:, :, ::-1])
        self.read_in_place(np.ascontiguousarray(self.triangles.T).T)
        self.read_in_place(self.triangles[:])
        read_only = self.triangles.copy()
        read_only.flags.writeable = False
        self.read_in_place(read_only)

    def test_fields(self):
        """Vertices of a structured dtype, such as a position and a colour."""
        store = np.zeros((200, 3), [("colour", np.uint8, 4), ("position", np.float32, 3)])
        store["position"] = self.triangles
        self.read_in_place(store["position"])

    def test_mapped_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "triangles.npy")
            np.save(path, self.triangles)
            self.read_in_place(np.load(path, mmap_mode="r"))

    def test_one_triangle(self):
        """With one triangle the distance to the next is ignored."""
        for i in range(20):
            one = self.triangles[i::200]
            for one in (one, self.triangles[i:i + 1], self.padded(16)[i::200], np.asfortranarray(one)):
                self.assert_same(tribox.overlap(one, LO, HI), self.expected[i:i + 1])

    def test_streams(self):
        streams = np.ascontiguousarray(self.triangles.T)
        self.read_in_place(np.ascontiguousarray(self.triangles.T).T)
        for view in (streams, aligned_badly(streams), np.concatenate([streams, streams], 2)[:, :, :200], streams[::-1][::-1]):
            self.assert_same(tribox.overlap(tribox.Soup(view), LO, HI), self.expected)
        struct = tribox.Soup(streams).struct
        for v in range(3):
            pointers = [address(stream[v]) for stream in (struct.x, struct.y, struct.z)]
            self.assertEqual(pointers, [start_of(streams[axis][v]) for axis in range(3)])

    def test_soup_of(self):
        streams, mesh = np.ascontiguousarray(self.triangles.T), tribox.Mesh(*cases.shared_vertices(self.triangles, np.uint16))
        for form in (self.triangles, self.padded(16), np.asfortranarray(self.triangles), mesh, tribox.Soup(streams)):
            soup = tribox.Soup.of(form)
            self.assert_same(soup.streams, streams)
            self.assertFalse(isinstance(form, np.ndarray) and np.shares_memory(soup.streams, form))

    def test_meshes(self):
        vertices, faces = cases.shared_vertices(self.triangles, np.uint32)
        room = np.full((len(vertices), 5), np.nan, np.float32)
        room[:, 1:4] = vertices
        for points in (vertices, room[:, 1:4], aligned_badly(vertices)):
            for indices in (faces, faces.astype(np.uint16), faces.astype(np.int32), aligned_badly(faces)):
                mesh = tribox.Mesh(points, indices)
                self.assertEqual(address(mesh.struct.positions), start_of(points))
                self.assertEqual(address(mesh.struct.indices), start_of(indices))
                self.assertEqual(len(mesh), 200)
                self.assert_same(tribox.overlap(mesh, LO, HI), self.expected)
                self.assert_same(tribox.overlap(tribox.Soup.of(mesh), LO, HI), self.expected)
        self.assertEqual(tribox.overlap(tribox.Mesh(vertices[:0], faces[:0]), LO, HI).size, 0)
        self.assertEqual(tribox.overlap(tribox.Mesh(vertices[:1], 0 * faces[:1]), LO, HI).size, 1)

    def test_what_is_held_lives(self):
        """A Mesh and a Soup keep the arrays that they point to."""
        mesh = tribox.Mesh(*cases.shared_vertices(self.triangles, np.uint32))
        soup = tribox.Soup([[self.triangles[:, v, axis].copy() for v in range(3)] for axis in range(3)])
        for _ in range(20):
            np.full((200, 3, 3), np.nan, np.float32)
            self.assert_same(tribox.overlap(mesh, LO, HI), self.expected)
            self.assert_same(tribox.overlap(soup, LO, HI), self.expected)


    def nine(self):
        return [[self.triangles[:, v, axis].copy() for v in range(3)] for axis in range(3)]

    def test_containers_change(self):
        """A Soup keeps its nine arrays where a container hands out copies, or loses them."""
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
        lost, lost_objects = tribox.Soup(nested), tribox.Soup(objects)
        objects[:] = None
        for streams in nested:
            streams[:] = [None] * 3
        self.assertEqual([reference for reference in handed if reference() is None], [])
        self.assertEqual(len(handed), 27)
        for soup in (copies, lost, lost_objects):
            self.assert_same(tribox.overlap(soup, LO, HI), self.expected)
            self.assert_same(np.array(soup.streams), np.ascontiguousarray(self.triangles.T))
            self.assert_same(tribox.Soup.of(soup).streams, np.ascontiguousarray(self.triangles.T))

    def test_arrays_stay(self):
        """What a struct points into cannot be replaced."""
        mesh, streams = tribox.Mesh(*cases.shared_vertices(self.triangles, np.uint32)), np.ascontiguousarray(self.triangles.T)
        soup = tribox.Soup(streams)
        self.assertIs(soup.streams, streams)
        for thing, name in ((mesh, "vertices"), (mesh, "faces"), (soup, "streams")):
            with self.assertRaises(AttributeError, msg=name):
                setattr(thing, name, getattr(thing, name)[:1].copy())
            self.assert_same(tribox.overlap(thing, LO, HI), self.expected)


class Memory(cases.TestCase):
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
        expected = np.resize(cases.truth(triangles[:1000], LO, HI), 1000000)
        for form in (triangles, mesh, streams, streams.streams.T):
            self.assert_same(tribox.overlap(form, LO, HI), expected)
            self.assertLess(self.peak(lambda: tribox.overlap(form, LO, HI)), 1.3e6)
            self.assertLess(self.peak(lambda: tribox.overlap(form, LO, HI, packed=True)), 3e5)
            self.assertLess(self.peak(lambda: tribox.overlap_any(form, HI, LO)), 3e6)
            self.assertLess(self.peak(lambda: tribox.voxelize(form, (LO, 1, (2, 2, 2)))), 3e6)


if __name__ == "__main__":
    cases.main()
