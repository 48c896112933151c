"""tribox.voxelize: by definition tribox.overlap of every triangle with every cell."""

import numpy as np
import tribox

import cases

ORIGIN, CELL, SIZE = (-2, -1.5, -1), (0.5, 0.375, 0.25), (7, 8, 9)


def plane(axis, number, origin=ORIGIN, cell=CELL):
    """Where plane p of an axis lies: rounded once, from double."""
    return np.float32(float(np.float32(origin[axis])) + number * float(np.float32(cell[axis])))


def cell_by_cell(triangles, size=SIZE, **options):
    """Asks tribox.overlap about every cell."""
    answer = np.zeros(size[::-1], bool)
    for k, j, i in np.ndindex(*answer.shape):
        lo, hi = ([plane(axis, number + past) for axis, number in enumerate((i, j, k))] for past in (0, 1))
        answer[k, j, i] = tribox.overlap(triangles, lo, hi, **options).any()
    return answer


class Voxelize(cases.TestCase):
    def setUp(self):
        self.triangles = np.concatenate([cases.lattice(12) / 2, cases.scattered(12)])
        self.expected = cell_by_cell(self.triangles)
        self.assertTrue(self.expected.any() and not self.expected.all())

    def forms(self):
        yield self.triangles
        yield tribox.Mesh(*cases.shared_vertices(self.triangles, np.int32))
        yield tribox.Soup.of(self.triangles)
        yield np.asfortranarray(self.triangles)

    def test_forms(self):
        for form in self.forms():
            self.assert_same(tribox.voxelize(form, ORIGIN, CELL, SIZE), self.expected)

    def test_rational(self):
        """One triangle, in exact rational numbers."""
        one = self.triangles[:1]
        answer = tribox.voxelize(one, ORIGIN, CELL, (3, 4, 5))
        for k, j, i in np.ndindex(5, 4, 3):
            lo, hi = ([plane(axis, number + past) for axis, number in enumerate((i, j, k))] for past in (0, 1))
            self.assertEqual(answer[k, j, i], cases.truth(one, lo, hi)[0])

    def test_options(self):
        self.assert_same(tribox.voxelize(self.triangles, ORIGIN, CELL, SIZE, kernel="scalar"), self.expected)
        self.assertTrue(np.all(tribox.voxelize(self.triangles, ORIGIN, CELL, SIZE, accuracy="conservative") >= self.expected))
        for axes in (tribox.AXES_BOX, tribox.AXES_BOX | tribox.AXES_PLANE):
            self.assert_same(tribox.voxelize(self.triangles, ORIGIN, CELL, SIZE, axes=axes),
                             cell_by_cell(self.triangles, axes=axes))
        self.assert_same(tribox.voxelize(self.triangles, np.array(ORIGIN), np.float32(0.5), np.array(SIZE)),
                         tribox.voxelize(self.triangles, ORIGIN, (0.5, 0.5, 0.5), SIZE))

    def test_packed(self):
        for width in (1, 7, 63, 64, 65, 130):
            cell = (3.5 / width, 0.375, 0.25)
            bools = tribox.voxelize(self.triangles, ORIGIN, cell, (width, 8, 9))
            words = tribox.voxelize(self.triangles, ORIGIN, cell, (width, 8, 9), packed=True)
            self.assertEqual((words.dtype, words.shape), (np.uint64, (9, 8, (width + 63) // 64)))
            for i in range(64 * words.shape[2]):
                bit = (words[..., i // 64] >> np.uint64(i % 64)) & np.uint64(1)
                np.testing.assert_array_equal(bit, bools[..., i] if i < width else 0 * bit)

    def test_accumulates(self):
        first, second = self.triangles[::2].copy(), self.triangles[1::2].copy()
        packed = tribox.voxelize(self.triangles, ORIGIN, CELL, SIZE, packed=True)
        for out in (np.zeros(SIZE[::-1], bool), np.zeros((9, 8, 7, 2), bool)[..., 0], np.zeros((9, 8, 1), np.uint64)):
            self.assertIs(tribox.voxelize(first, ORIGIN, CELL, SIZE, out=out), out)
            self.assertIs(tribox.voxelize(second, ORIGIN, CELL, SIZE, out=out), out)
            self.assert_same(out, self.expected if out.dtype == bool else packed)
            out.fill(~out.dtype.type(0))
            tribox.voxelize(first[:0], ORIGIN, CELL, SIZE, out=out)
            self.assertTrue((out == ~out.dtype.type(0)).all())

    def test_layers(self):
        for form in self.forms():
            parts = [tribox.voxelize(form, ORIGIN, CELL, SIZE, layers=layers) for layers in ((0, 2), (2, 0), (2, 6), (8, 1))]
            self.assert_same(np.concatenate(parts), self.expected)
        layer = tribox.voxelize(self.triangles, ORIGIN, CELL, (1 << 12, 1 << 10, 1 << 15), layers=(3, 1))
        self.assertEqual(layer.shape, (1, 1 << 10, 1 << 12))

    def test_blocks(self):
        """What decides lies in the last of three blocks."""
        far = np.full((2 * 65536 + 7, 3, 3), 99, np.float32)
        far[-len(self.triangles):] = self.triangles
        self.assert_same(tribox.voxelize(far, ORIGIN, CELL, SIZE), self.expected)

    def test_nothing(self):
        self.assertFalse(tribox.voxelize(self.triangles[:0], ORIGIN, CELL, SIZE).any())
        self.assertFalse(tribox.voxelize(np.full((5, 3, 3), np.nan, np.float32), ORIGIN, CELL, SIZE).any())


if __name__ == "__main__":
    cases.main()
