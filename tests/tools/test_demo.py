"""tribox info and tribox demo."""

import os
import re

import harness
import readers

ACCURACIES = ["fast", "conservative", "exact"]
ROW = re.compile(r"(?m)^(\w+) +(-|fast|conservative|exact|mesh)((?: +[\d.]+){6})$")


def found(text):
    """What does not depend on time: overlaps, the last column of each scene, occupied cells."""
    return re.findall(r"\d+, (\d+) overlap", text), [row[2].split()[2::3] for row in ROW.findall(text)], \
        re.search(r"(\d+) of them occupied", text)[1]


class Demo(harness.TestCase):
    def test_text(self):
        text = self.succeed("demo", "--quick", cwd=self.folder)
        self.assertEqual(os.listdir(self.folder), [])
        lines = text.splitlines()
        self.assertLessEqual(max(map(len, lines)), 100)
        self.assertLessEqual(len(lines), 24)
        self.assertRegex(text, r"\A[\x20-\x7e\n]*\Z")
        self.assertRegex(lines[1], r"^ +100000, \d+ overlap +200000, \d+ overlap$")
        self.assertIn("Medians of 3 rounds", text)
        rows = ROW.findall(text)
        self.assertEqual([row[:2] for row in rows], [("paper", "-")] + [
            (kernel, accuracy) for k, kernel in enumerate(harness.kernels()) for accuracy in ACCURACIES + ["mesh"] * (k < 2)])
        for row in rows:
            columns = [float(word) for word in row[2].split()]
            self.assertGreater(min(columns[0::3] + columns[1::3]), 0)
            self.assertLess(max(columns[2::3]), 1 if row[1] in ("exact", "mesh") else 100)
        self.assertEqual(rows[0][2].split()[1::3], ["1.00"] * 2)
        self.assertEqual(len({len(line) for line in lines if re.match(r"kernel +accuracy|paper +-", line)}), 1)

    def test_picture_of_the_voxels(self):
        self.need("libpng")
        path = self.path("knot.png")
        result = harness.run("demo", "--quick", "--picture", path, cwd=self.folder)
        self.assertEqual((result.code, result.stderr, os.listdir(self.folder)), (0, "", ["knot.png"]))
        self.assertRegex(result.stdout, r"(?m)^Voxels of the mesh: 123 x 128 x 53 cells, \d+ of them occupied; [\d.]+ ms, ")
        self.assertIn("drawn in %s\n" % path, result.stdout)
        self.assertEqual(readers.open_png(path)[:2], (1280, 960))
        self.fail_with(1, "none/knot.png: cannot write there", "demo", "--quick", "--picture", self.folder + "/none/knot.png")

    @harness.unless_sanitized
    def test_where_the_picture_goes(self):
        result = harness.run("demo", cwd=self.folder)
        drawn = os.listdir(self.folder)
        self.assertIn(drawn, (["tribox-demo.png"], []))  # none without libpng
        self.assertEqual("drawn in tribox-demo.png" in result.stdout, bool(drawn))

    @harness.unless_sanitized
    def test_answers_repeat(self):
        one, other = (found(self.succeed("demo", "--quick")) for _ in range(2))
        self.assertEqual(one, other)
        for overlapping, count in zip(one[0], (100000, 200000)):
            self.assertTrue(0 < int(overlapping) < count)


if __name__ == "__main__":
    harness.main()
