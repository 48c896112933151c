"""The answers of tribox overlap: against exact clipping, in every form, with every way of testing."""

import json
import re

import meshes
import support

BOXES = [(-0.5, -0.5, -0.5, 0.5, 0.5, 0.5), (-1, 0, -0.25, 0.125, 1, 0.25), (0.5, 0.5, 0.5, 0.5, 0.5, 0.5), (3, 3, 3, 4, 4, 4)]


def text_of(box):
    return ",".join("%.9g" % bound for bound in box)


class Answers(support.TestCase):
    def setUp(self):
        super().setUp()
        self.triangles = meshes.lattice_triangles(700, seed=1)
        self.mesh = self.write("mesh.ply", meshes.ply_binary(self.triangles))
        self.kernels = json.loads(self.succeed("info", "--json"))["kernels"]

    def test_exact(self):
        for box in BOXES:
            expected = meshes.overlapping(self.triangles, box)
            answer = self.overlap(self.mesh, text_of(box))
            self.assertEqual(answer["indices"], expected)
            self.assertEqual(answer["overlapping"], len(expected))
            self.assertEqual(answer["triangles"], 700)
            self.assertAlmostEqual(answer["share_percent"], 100 * len(expected) / 700, places=3)
            self.assertEqual(answer["box"], {"lo": list(box[:3]), "hi": list(box[3:])})
            self.assertEqual((answer["not_finite"], answer["mesh"]), (0, self.mesh))
            self.assertGreater(answer["seconds"], 0)

    def test_exact_everywhere(self):
        expected = meshes.overlapping(self.triangles, BOXES[0])
        for kernel in self.kernels:
            for order in ("123", "132", "213", "231", "312", "321"):
                answer = self.overlap(self.mesh, text_of(BOXES[0]), "--kernel", kernel, "--order", order)
                self.assertEqual((answer["indices"], answer["kernel"]), (expected, kernel))

    def test_accuracy(self):
        expected = meshes.overlapping(self.triangles, BOXES[0])
        for kernel in self.kernels:
            answer = self.overlap(self.mesh, text_of(BOXES[0]), "--kernel", kernel, "--accuracy", "exact")
            self.assertEqual((answer["indices"], answer["accuracy"]), (expected, "exact"))
            answer = self.overlap(self.mesh, text_of(BOXES[0]), "--kernel", kernel, "--accuracy", "conservative")
            self.assertLessEqual(set(expected), set(answer["indices"]))
            self.assertEqual(answer["accuracy"], "conservative")
            # On a lattice of eighths single precision makes no error.
            answer = self.overlap(self.mesh, text_of(BOXES[0]), "--kernel", kernel, "--accuracy", "fast")
            self.assertEqual((answer["indices"], answer["accuracy"], answer["undecided"]), (expected, "fast", 0))

    def test_axes(self):
        def found(axes):
            answer = self.overlap(self.mesh, text_of(BOXES[0]), "--axes", axes)
            self.assertEqual(sorted(answer["axes"]), sorted(axes.split(",")))
            return set(answer["indices"])
        box, plane, edges = found("box"), found("plane"), found("edges")
        everything = set(meshes.overlapping(self.triangles, BOXES[0]))
        near = {i for i, t in enumerate(self.triangles)
                if all(min(v[a] for v in t) <= 0.5 and max(v[a] for v in t) >= -0.5 for a in range(3))}
        self.assertEqual(box, near)
        self.assertEqual(found("box,plane"), box & plane)
        self.assertEqual(found("edges,box"), box & edges)
        self.assertEqual(found("box,plane,edges"), everything)
        self.assertEqual(box & plane & edges, everything)
        self.assertTrue(everything < box and everything < plane and everything < edges)

    def test_list(self):
        expected = meshes.overlapping(self.triangles, BOXES[0])
        text = self.succeed("overlap", self.mesh, "--box", text_of(BOXES[0]), "--list")
        self.assertEqual(text, "".join("%d\n" % i for i in expected))
        self.assertEqual(self.succeed("overlap", self.mesh, "--box", text_of(BOXES[3]), "--list"), "")
        self.assertNotIn("indices", json.loads(self.succeed("overlap", self.mesh, "--box", text_of(BOXES[0]), "--json")))

    def test_summary(self):
        expected = len(meshes.overlapping(self.triangles, BOXES[0]))
        text = self.succeed("overlap", self.mesh, "--box", text_of(BOXES[0]))
        fields = dict(re.split(r"  +", line, maxsplit=1) for line in text.splitlines())
        self.assertEqual(fields["mesh"], self.mesh)
        self.assertEqual(fields["box"], support.UNIT_BOX)
        self.assertEqual(fields["triangles"], "700")
        self.assertEqual(fields["overlapping"], "%d (%.2f %%)" % (expected, 100 * expected / 700))
        self.assertRegex(fields["undecided"], r"^\d+$")
        self.assertEqual(fields["test"], "exact, axes box,plane,edges, kernel %s" % self.kernels[0])
        self.assertRegex(fields["time"], r"^[\d.]+ m?s, [\d.]+ ns per triangle \(the test alone, best of [1-5] runs?\)$")

    def test_counts_around_words(self):
        for count in (1, 2, 63, 64, 65, 128, 129):
            mesh = self.write("count.stl", meshes.stl_binary(self.triangles[:count]))
            self.assertEqual(self.overlap(mesh, text_of(BOXES[0]))["indices"],
                             meshes.overlapping(self.triangles[:count], BOXES[0]))


if __name__ == "__main__":
    support.main()
