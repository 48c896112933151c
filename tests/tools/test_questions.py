"""Questions besides the plain one: which triangles lie wholly inside, and which overlap an oriented box?"""

import json
import math
import re

import meshes
import support

TRIANGLES = meshes.lattice_triangles(200, seed=8) + [((0, 0, 0),) * 3, ((0.5, 0, 0), (0, 0.5, 0), (0, 0, 0.25)), ((-1, 0, 0),) * 3]
BOXES = [(-0.5, -0.5, -0.5, 0.5, 0.5, 0.5), (-2, -2, -2, 2, 2, 2), (-1, -2, -2, 2, 1, 2), (0, 0, 0, 0, 0, 0), (3, 3, 3, 4, 4, 4)]


def text_of(numbers):
    return ",".join("%.17g" % x for x in numbers)


class Questions(support.TestCase):
    def setUp(self):
        super().setUp()
        self.kernels = json.loads(self.succeed("info", "--json"))["kernels"]
        self.ply = self.write("mesh.ply", meshes.ply_binary(TRIANGLES))
        self.raw = self.write("mesh.f32", meshes.pack_floats(TRIANGLES))


class Inside(Questions):
    def counts(self, box):
        inside, overlapping = len(meshes.inside(TRIANGLES, box)), len(meshes.overlapping(TRIANGLES, box))
        return {"triangles": len(TRIANGLES), "overlapping": overlapping, "inside": inside, "straddling": overlapping - inside,
                "missing": len(TRIANGLES) - overlapping}

    def check(self, answer, box):
        expected = self.counts(box)
        self.assertEqual({key: answer[key] for key in expected}, expected)

    def test_counts(self):
        self.assertGreater(min(self.counts(BOXES[2])["inside"], self.counts(BOXES[2])["straddling"]), 9)
        for box in BOXES:
            for mesh in (self.ply, self.raw):
                for kernel in self.kernels:
                    self.check(json.loads(self.succeed("overlap", mesh, "--box", text_of(box), "--inside", "--json", "--kernel", kernel)), box)

    def test_boxes(self):
        lines = "".join(text_of(box) + "\n" for box in BOXES).encode()
        text = self.succeed("overlap", self.raw, "--boxes", "-", "--inside", "--json", stdin=lines)
        for line, box in zip(text.splitlines(), BOXES):
            self.check(json.loads(line), box)
        text = self.succeed("overlap", self.ply, "--boxes", "-", "--inside", stdin=lines)
        for line, box in zip(text.splitlines(), BOXES):
            expected = self.counts(box)
            self.assertRegex(line, r"^%s: %d of %d triangles overlap \([\d.]+ %%\), %d inside, \d+ undecided, [\d.]+ ns per triangle$"
                             % (text_of(box), expected["overlapping"], len(TRIANGLES), expected["inside"]))

    def test_summary(self):
        expected = self.counts(BOXES[2])
        for mesh in (self.ply, self.raw):
            text = self.succeed("overlap", mesh, "--box", text_of(BOXES[2]), "--inside")
            for name in ("overlapping", "inside", "straddling", "missing"):
                self.assertRegex(text, r"(?m)^%s +%d \(%.2f %%\)$" % (name, expected[name], 100 * expected[name] / len(TRIANGLES)))
            self.assertNotIn("inside ", self.succeed("overlap", mesh, "--box", text_of(BOXES[2])))

    def test_blocks(self):
        """The sum over blocks is that of the whole."""
        many = TRIANGLES * 30
        answers = [json.loads(self.succeed("overlap", self.write(name, content(many)), "--box", text_of(BOXES[2]), "--inside", "--json"))
                   for name, content in (("many.ply", meshes.ply_binary), ("many.f32", meshes.pack_floats))]
        for answer in answers:
            self.assertEqual((answer["overlapping"], answer["inside"]), tuple(30 * self.counts(BOXES[2])[k] for k in ("overlapping", "inside")))


class Oriented(Questions):
    turned = (0.25, -0.125, 0, 1, 0.5, 0.25, 0.6, 0.8, 0, -0.8, 0.6, 0, 0, 0, 1)
    sheared = (0, 0, 0, 0.5, 0.75, 1, 1, 0.25, 0, 0, 1, -0.5, 0.5, 0, 2)

    def test_indices(self):
        """For rotations, a sheared frame and a mirrored one, exact as for other boxes."""
        angle = math.sqrt(2)
        cos, sin = math.cos(angle), math.sin(angle)
        tilted = (0.1, 0.2, 0.3, 0.7, 0.6, 0.5, cos, sin, 0, -sin, cos, 0, 0, 0, -1)
        for box in (self.turned, self.sheared, tilted):
            expected = meshes.overlapping_oriented(TRIANGLES, box)
            self.assertGreater(len(expected), 15)
            for mesh in (self.ply, self.raw):
                for kernel in self.kernels:
                    text = self.succeed("overlap", mesh, "--oriented", text_of(box), "--list", "--json", "--kernel", kernel)
                    self.assertEqual(json.loads(text)["indices"], expected)

    def test_upright_is_a_box(self):
        expected = meshes.overlapping(TRIANGLES, BOXES[0])
        text = self.succeed("overlap", self.ply, "--oriented", support.UNIT_ORIENTED, "--list")
        self.assertEqual(text, "".join("%d\n" % i for i in expected))

    def test_conservative(self):
        for box in (self.turned, self.sheared):
            text = self.succeed("overlap", self.raw, "--oriented", text_of(box), "--list", "--accuracy", "conservative")
            self.assertLessEqual(set(meshes.overlapping_oriented(TRIANGLES, box)), set(map(int, text.split())))

    def test_axes(self):
        """The triangle's bounding box in the frame; all thirteen by name."""
        boxes = json.loads(self.succeed("overlap", self.raw, "--oriented", text_of(self.turned), "--axes", "box", "--list", "--json"))
        exact = meshes.overlapping_oriented(TRIANGLES, self.turned)
        self.assertTrue(set(exact) < set(boxes["indices"]))
        named = self.succeed("overlap", self.raw, "--oriented", text_of(self.turned), "--axes", "edges,plane,box", "--list")
        self.assertEqual([int(i) for i in named.split()], exact)

    def test_forms(self):
        answer = json.loads(self.succeed("overlap", self.ply, "--oriented", text_of(self.sheared), "--json"))
        self.assertEqual(answer["oriented"], {"center": [0, 0, 0], "half": [0.5, 0.75, 1],
                                              "axes": [[1, 0.25, 0], [0, 1, -0.5], [0.5, 0, 2]]})
        self.assertNotIn("box", answer)
        fields = dict(re.split(r"  +", line, maxsplit=1) for line in
                      self.succeed("overlap", self.ply, "--oriented", text_of(self.sheared)).splitlines())
        self.assertEqual(fields["box"], "oriented " + text_of(self.sheared))

    def test_empty(self):
        for k in range(3):
            half = ["1", "1", "1"]
            half[k] = "-0.5"
            text = self.succeed_with_note("note: --oriented: half length %d is -0.5: a box of negative size is empty" % (k + 1), "overlap",
                                          self.raw, "--oriented", "0,0,0,%s,1,0,0,0,1,0,0,0,1" % ",".join(half), "--json")
            self.assertEqual(json.loads(text)["overlapping"], 0)


if __name__ == "__main__":
    support.main()
