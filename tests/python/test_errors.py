"""Every error is a tribox.Error that says what is wrong, where, and what to do; and nothing is written."""

import errno
import os
import pickle
import subprocess
import sys
import tempfile
from unittest import mock

import numpy as np
import tribox
from tribox import BadIndexError, InputError, InputTypeError

import cases
from cases import HI, LO

NAN, INF = float("nan"), float("inf")
GRID = (0, 0, 0), 1, (4, 5, 6)
ORDERS = "give one of 0, 123, 132, 213, 231, 312, 321"


class Errors(cases.TestCase):
    def setUp(self):
        self.triangles = cases.lattice(70)
        self.forms = self.triangles, tribox.Soup.of(self.triangles), tribox.Mesh(*cases.shared_vertices(self.triangles, np.uint32))
        self.calls = tribox.overlap, tribox.overlap_any, tribox.overlap_all, tribox.classify

    def test_kinds(self):
        for kind, builtin in ((InputError, ValueError), (InputTypeError, TypeError), (BadIndexError, IndexError)):
            self.assertTrue(issubclass(kind, tribox.Error) and issubclass(kind, builtin))
        with self.assertRaises(tribox.Error) as raised:
            tribox.overlap(self.triangles, LO, (NAN, 1, 1))
        copy = pickle.loads(pickle.dumps(raised.exception))
        self.assertEqual((str(copy), copy.status), (str(raised.exception), "BAD_BOX"))

    def test_box(self):
        for form in self.forms:
            for call in self.calls:
                for value in (NAN, INF, -INF):
                    pattern = r"a bound of the box is NaN or infinite: lo = \(0, .*\), hi = \(1, 1, 1\)"
                    self.refuse(InputError, "BAD_BOX", pattern, call, form, (0, value, 0), (1, 1, 1))
                for odd in ((1, 2), (1, 2, 3, 4), 1, None, "abc", (1, "x", 2), (1, None, 2), np.zeros((3, 2)), ()):
                    if odd is not None:
                        self.refuse(InputError, None, "^hi = .*; give three numbers: x, y, z", call, form, LO, odd)
                    self.refuse(InputError, None, "^lo = .*; give three numbers: x, y, z", call, form, odd, HI)

    def test_options(self):
        def oriented(form, lo, hi, **options):
            return tribox.overlap_oriented(form, lo, hi, np.eye(3), **options)

        refuse = self.refuse
        for form in self.forms:
            for call in (*self.calls, oriented):
                refuse(InputError, "BAD_OPTION", f"^axis_order = 4; {ORDERS}", call, form, LO, HI, axis_order=4)
                refuse(InputError, "BAD_OPTION", "^axes = 8; give a union of AXES_BOX", call, form, LO, HI, axes=8)
                refuse(InputError, "BAD_OPTION", "axes = -1", call, form, LO, HI, axes=-1)
                refuse(InputError, "BAD_OPTION", "axis_order = '123'", call, form, LO, HI, axis_order="123")
                pattern = "accuracy = 'exakt'; give one of 'exact', 'conservative', 'fast'"
                refuse(InputError, None, pattern, call, form, LO, HI, accuracy="exakt")
                pattern = "kernel = 'sse9'; this processor runs .*scalar"
                refuse(InputError, "NO_KERNEL", pattern, call, form, LO, HI, kernel="sse9")
        for odd in (LO, 3, None, "abc", (LO,), (LO, HI, LO)):
            self.refuse(InputError, None, r"^lo = .* no hi; give lo and hi, .* or both .* \(2, 3\)", tribox.overlap, self.triangles,
                        odd)
        self.refuse(InputError, None, r"^hi = .*; tribox\.Index\(triangles\)\.lists\(lo, hi\) takes many", tribox.overlap,
                    self.triangles, LO, [HI, HI])
        for odd in ("first", None, 1):
            self.refuse(InputError, None, "^what = .*; give one of 'hit', 'miss'", tribox.find, self.triangles, LO, HI, odd)
        for options in (dict(axes=8), dict(accuracy=1), dict(kernel="")):
            with self.assertRaises(InputError):
                tribox.voxelize(self.triangles, GRID, **options)

    def test_indices(self):
        vertices, faces = cases.shared_vertices(self.triangles, np.int32)
        count = len(vertices)
        for dtype, wrong in ((np.uint16, count), (np.uint32, 2 ** 32 - 1), (np.int32, -1), (np.int32, count)):
            bad = faces.copy().astype(dtype)
            bad[17, 2] = bad[20, 0] = wrong
            mesh = tribox.Mesh(vertices, bad)
            pattern = fr"faces\[17, 2\] is {wrong}, but there are {count} vertices; wrong indices in all: 2"
            for call in self.calls:
                self.refuse(BadIndexError, "BAD_VERTEX", pattern, call, mesh, LO, HI)
            self.refuse(BadIndexError, "BAD_VERTEX", pattern, tribox.voxelize, mesh, GRID)
            self.refuse(BadIndexError, "BAD_VERTEX", pattern, tribox.Soup.of, mesh)
            self.refuse(BadIndexError, "BAD_VERTEX", pattern, tribox.overlap_oriented, mesh, LO, HI, np.eye(3))

    def test_negative_indices(self):
        """Among more than 2^31 vertices, here a file of nothing but holes, a negative index is none of them either."""
        with tempfile.TemporaryFile() as file:
            try:
                file.truncate(12 << 31 | 1 << 10)
                vertices = np.memmap(file, np.float32, "r", shape=((1 << 31) + 5, 3))
            except (OSError, OverflowError, ValueError) as error:
                self.skipTest(f"no file of 26 GB, not even of holes: {error}")
            mesh = tribox.Mesh(vertices, np.array([[0, 1, -(1 << 31)]], np.int32))
            self.refuse(BadIndexError, "BAD_VERTEX", r"faces\[0, 2\] is -2147483648", tribox.overlap, mesh, LO, HI)

    def test_no_triangles(self):
        """Errors are reported for no triangles, too."""
        none = np.zeros((0, 3, 3), np.float32)
        for form in (none, tribox.Soup.of(none), tribox.Mesh(none[0:0, 0], np.zeros((0, 3), np.uint32))):
            for call in self.calls:
                self.refuse(InputError, "BAD_BOX", "infinite", call, form, LO, (INF, 1, 1))
                self.refuse(InputError, "BAD_OPTION", "axis_order = 5", call, form, LO, HI, axis_order=5)
            self.refuse(InputError, "BAD_BOX", "infinite", tribox.overlap_oriented, form, LO, (INF, 1, 1), np.eye(3))
            self.refuse(InputError, "BAD_GRID", "cell = 0", tribox.voxelize, form, (LO, 0, (1, 1, 1)))

    def test_oriented(self):
        refuse = self.refuse
        for form in self.forms:
            refuse(InputError, "BAD_BOX", r"half = \(1, inf, 1\)", tribox.overlap_oriented, form, LO, (1, INF, 1), np.eye(3))
            for frame in (np.eye(3)[:2], np.eye(4), 3, None):
                pattern = "axis = .*; give three times three numbers"
                refuse(InputError, None, pattern, tribox.overlap_oriented, form, LO, HI, frame)
            refuse(InputError, None, r"axis\[0\] = .*three numbers", tribox.overlap_oriented, form, LO, HI, np.eye(4)[:3])

    def test_boxes(self):
        bounds, refuse = np.zeros((3, 9), np.float32), self.refuse
        one = self.triangles[0]
        refuse(InputTypeError, None, "lo is ndarray of object; give real numbers", tribox.overlap_boxes, one, bounds.astype(object),
               bounds)
        refuse(InputTypeError, None, "hi is str", tribox.overlap_boxes, one, bounds, "hi")
        for odd in (bounds[:2], bounds[0], bounds[None], 3, np.zeros((5, 4))):
            refuse(InputError, None, r"^hi has shape .*; give \(m, 3\), a row for each box, or \(3, m\)", tribox.overlap_boxes, one,
                   bounds, odd)
            refuse(InputError, None, r"^lo has shape .* no hi; .* both .* \(m, 2, 3\)", tribox.overlap_boxes, one, odd)
        refuse(InputError, None, "^lo has 9 boxes and hi 8", tribox.overlap_boxes, one, bounds, bounds.T[:8])
        for odd in (self.triangles[:2, 0], 3, None):
            pattern = "triangle = .*; give three times three numbers"
            refuse(InputError, None, pattern, tribox.overlap_boxes, odd, bounds, bounds)
        refuse(InputError, "BAD_OPTION", "axis_order = 7", tribox.overlap_boxes, one, bounds, bounds, axis_order=7)

    def test_grid(self):
        for origin, cell, size, cause in (
                ((NAN, 0, 0), 1, (4, 5, 6), "the origin or the cell is not finite on the x axis"),
                ((0, 0, 0), (1, INF, 1), (4, 5, 6), "the origin or the cell is not finite on the y axis"),
                ((0, 0, 0), 0, (4, 5, 6), "the cell or the size is not greater than zero on the x axis"),
                ((0, 0, 0), (1, -1, 1), (4, 5, 6), "the cell or the size is not greater than zero on the y axis"),
                ((0, 0, 0), 1, (4, 5, 0), "the cell or the size is not greater than zero on the z axis"),
                ((0, 0, 1.5e308), 1e307, (4, 5, 6), "the grid ends beyond the largest float64 on the z axis"),
                ((0, 0, 0), 1, (1 << 20, 1 << 20, 1 << 20), "the cells take 1.342e.08 GiB, .* 16 at most; give a window"),
                ((0, 1e17, 0), 1, (4, 5, 6), "float64 cannot tell cells of 1 apart on the y axis, .* cells of 32 are large enough"),
                ((0, 0, 1.797693134862315e308), 1e290, (1, 1, 100), "float64 cannot .*; choose fewer cells, or move the origin")):
            self.refuse(InputError, "BAD_GRID", f"^{cause}.*origin ?= ?.*, cell ?= ?.*, size ?= ?", tribox.voxelize,
                        self.triangles, (origin, cell, size))
        for size in ((1, 2), 3, None, "xyz", (1, -2, 3), (1, 1 << 32, 1), (1, 2, 3, 4), (NAN, 1, 1), (1.5, 1, 1)):
            pattern = "^size = .*; give three numbers of cells"
            self.refuse(InputError, None, pattern, tribox.voxelize, self.triangles, ((0, 0, 0), 1, size))
        for origin, cell, word in (((0, 0), 1, "origin"), ((0, 0, 0), (1, 1), "cell"), ((0, 0, 0), "x", "cell")):
            pattern = f"^{word} = .*; give (three numbers|the length of a cell, or three): x, y, z"
            self.refuse(InputError, None, pattern, tribox.voxelize, self.triangles, (origin, cell, (1, 1, 1)))
        for layers in ((0, 7), (6, 1), (-1, 2), (1 << 32, 1), (0, "x"), (0,), (0, 1.5), 3):
            self.refuse(InputError, None, r"layers = .*within the 6 layers", tribox.voxelize, self.triangles, GRID, layers=layers)

    def test_out(self):
        read_only = np.zeros(70, bool)
        read_only.flags.writeable = False
        refuse = self.refuse
        for form in self.forms:
            for out in (np.zeros(70, np.uint8), [False] * 70, np.zeros(70, np.int64), np.zeros(70, ">u8")):
                pattern = "^out is .*bool, or of uint64 for packed bits"
                refuse(InputTypeError, None, pattern, tribox.overlap, form, LO, HI, out=out)
            for out in (np.zeros(69, bool), np.zeros((70, 1), bool), np.zeros(3, np.uint64)):
                refuse(InputError, None, r"^out has shape .*; give \((70|2),\)", tribox.overlap, form, LO, HI, out=out)
            for out in (read_only, np.zeros(4, np.uint64)[::2]):
                refuse(InputError, None, "^out is read-only, or not contiguous", tribox.overlap, form, LO, HI, out=out)

    def test_no_memory(self):
        """Of large cells, whose pages are mapped, as of small ones."""
        with mock.patch("mmap.mmap", side_effect=OSError(errno.ENOMEM, "Cannot allocate memory")):
            self.assertRaises(MemoryError, tribox.voxelize, self.triangles, ((0, 0, 0), 1, (4096, 4096, 4096)))

    def test_nothing_is_written(self):
        vertices, faces = cases.shared_vertices(np.resize(self.triangles, (70000, 3, 3)), np.uint32)
        faces[-1, 2] = len(vertices)
        late, into = tribox.Mesh(vertices, faces), tribox.voxelize(self.triangles[:0], GRID)
        for arguments, count in (((late, LO, HI), 70000), ((self.triangles, LO, (NAN, 0, 0)), 70)):
            for out in (np.zeros(count, bool), np.zeros((count + 63) // 64, np.uint64)):
                self.assertRaises(tribox.Error, tribox.overlap, *arguments, out=out)
                self.assertFalse(out.any())
        for fill in (None, "outside", "parity"):
            self.assertRaises(BadIndexError, tribox.voxelize, late, GRID, into=into, fill=fill)
            self.assertFalse(into.words.any())

    def test_mask_indices(self):
        for odd in ([1], np.zeros(2, bool), np.zeros(4, np.uint64)[::2]):
            self.refuse(InputTypeError, None, "mask must be a contiguous array of uint64", tribox.mask_indices, odd)
        huge = np.broadcast_to(np.uint64(0), (1, 1 << 27))
        self.refuse(InputTypeError, None, "contiguous", tribox.mask_indices, huge)


    def test_sufficient_cell(self):
        """The cell that a message recommends does, and a quarter of it does not."""
        for start in (1e17, -1e17, 3, -1e300, 2.0 ** 53 - 4, 0.1):
            for size in (1, 5, 1000):
                cell = tribox._grids.sufficient_cell(start, size)
                self.assertFalse(tribox.voxelize(self.triangles[:0], ((start, 0, 0), (cell, 1, 1), (size, 1, 1))).any())
                with self.assertRaises(InputError):
                    tribox.voxelize(self.triangles[:0], ((start, 0, 0), (cell / 4, 1, 1), (max(size, 5), 1, 1)))


class Oddities(cases.TestCase):
    """Arguments that Python itself stumbles over, in every place that takes them."""

    def setUp(self):
        self.triangles = cases.lattice(10)

    def calls(self, odd, **options):
        """(status, call) for each place of three numbers, with `odd` among them."""
        one, corner, far, frame = (0, 0, 0), (odd, 0, 0), (1, 1, 1), np.eye(3)
        bounds = np.zeros((3, 2), np.float32)
        for call in (tribox.overlap, tribox.overlap_any, tribox.overlap_all, tribox.classify, tribox.crop):
            yield "BAD_BOX", lambda call=call: call(self.triangles, corner, far, **options)
            yield "BAD_BOX", lambda call=call: call(self.triangles, one, corner, **options)
        yield "BAD_BOX", lambda: tribox.overlap_oriented(self.triangles, corner, far, frame, **options)
        yield "BAD_BOX", lambda: tribox.overlap_oriented(self.triangles, one, corner, frame, **options)
        yield "BAD_BOX", lambda: tribox.overlap_oriented(self.triangles, one, far, (corner, far, far), **options)
        yield "BAD_GRID", lambda: tribox.voxelize(self.triangles, (corner, 1, (2, 2, 2)), **options)
        yield "BAD_GRID", lambda: tribox.voxelize(self.triangles, (one, (odd, 1, 1), (2, 2, 2)), **options)
        yield "BAD_GRID", lambda: tribox.voxelize(self.triangles, (one, odd, (2, 2, 2)), **options)
        yield None, lambda: tribox.overlap_boxes((corner, far, far), bounds, bounds, **options)

    def test_huge_numbers(self):
        for odd in (10 ** 400, -10 ** 400, 10 ** 5000):
            for status, call in self.calls(odd):
                if status is None:
                    self.assertFalse(call().any())
                else:
                    self.refuse(InputError, status, "infinite|not finite|not greater than zero", call)
            self.refuse(InputError, None, "^size = ", tribox.voxelize, self.triangles, ((0, 0, 0), 1, (odd, 1, 1)))
            self.refuse(InputError, None, "^layers = ", tribox.voxelize, self.triangles, GRID, layers=(0, odd))
            self.refuse(InputError, "BAD_OPTION", "^axes = ", tribox.overlap, self.triangles, LO, HI, axes=odd)
        self.refuse(InputError, None, "^cell = ", tribox.voxelize, self.triangles, ((0, 0, 0), ((1, 2), 3, [4]), (1, 1, 1)))

    def test_words(self):
        for name, known, status in (("accuracy", "exact", None), ("kernel", tribox.kernel_name(), "NO_KERNEL")):
            for odd in ([known], {known}, "\udcff", f"{known}\0x", f"{known} ", known.upper(), known.encode(),
                        np.array([known] * 2), 1):
                for _, call in self.calls(0, **{name: odd}):
                    self.refuse(InputError, status, f"^{name} = ", call)
        for odd in ([7], {}, 7.0, "7", np.array([7, 7])):
            self.refuse(InputError, "BAD_OPTION", "^axes = ", tribox.overlap, self.triangles, LO, HI, axes=odd)
        for odd in ("\udcff", f"{tribox.kernel_name()}\0x", [], 5):
            self.assertIsNone(tribox.kernel_name(odd))


class Library(cases.TestCase):
    """What an import says where the library is not there, or does not fit."""

    def import_with(self, library):
        environment = {**os.environ, "TRIBOX_LIBRARY": library}
        done = subprocess.run([sys.executable, "-B", "-c", "import tribox"], capture_output=True, env=environment, timeout=60,
                              text=True)
        self.assertNotEqual(done.returncode, 0)
        return done.stderr

    def test_not_there(self):
        self.assertRegex(self.import_with("/no/libtribox.so"),
                         "ImportError: .*/no/libtribox.so.*; install libtribox, or set TRIBOX_LIBRARY to the path of libtribox.so")

    def test_another(self):
        self.assertRegex(self.import_with("libc.so.6"), "ImportError: libc.so.6 does not fit this module: .*tribox_")


if __name__ == "__main__":
    cases.main()
