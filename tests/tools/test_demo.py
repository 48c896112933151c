"""tribox info and tribox demo."""

import functools
import json
import os
import pty
import re
import subprocess

import support
import volumes

ACCURACIES = ["fast", "conservative", "exact"]


@functools.lru_cache
def quick_demo():
    return json.loads(support.run("demo", "--quick", "--json").stdout)


class Info(support.TestCase):
    def test_json(self):
        info = json.loads(self.succeed("info", "--json"))
        self.assertEqual(sorted(info), ["default_kernel", "kernels", "positions", "processor", "version"])
        self.assertEqual(info["kernels"][0], info["default_kernel"])
        self.assertEqual(info["kernels"][-1], "scalar")
        self.assertTrue(info["processor"])

    def test_text(self):
        info = json.loads(self.succeed("info", "--json"))
        fields = dict(re.split(r"  +", line, maxsplit=1) for line in self.succeed("info").splitlines())
        self.assertEqual(fields, {"version": info["version"], "processor": info["processor"],
                                  "kernels": " ".join(info["kernels"]), "default kernel": info["default_kernel"],
                                  "positions": ", ".join(info["positions"])})
        self.assertEqual(info["positions"], ["float32", "float64"])


class Demo(support.TestCase):
    def expected_rows(self):
        kernels = json.loads(self.succeed("info", "--json"))["kernels"]
        return [("paper", None)] + [(kernel, accuracy) for k, kernel in enumerate(kernels)
                                    for accuracy in ACCURACIES + ["mesh"] * (k < 2)]

    def check_scene(self, scene):
        rows = scene["rows"]
        self.assertEqual([(row["kernel"], row["accuracy"]) for row in rows], self.expected_rows())
        exact = {row["overlapping"] for row in rows if row["accuracy"] in ("exact", "mesh")}
        self.assertEqual(len(exact), 1)
        self.assertTrue(0 < min(exact) < scene["triangles"])
        for row in rows:
            if row["accuracy"] in ("exact", "mesh"):
                self.assertEqual(row["unlike_exact"], 0)
            if row["accuracy"] == "conservative":
                self.assertEqual(row["overlapping"] - row["unlike_exact"], min(exact))
            self.assertLess(row["unlike_exact"], scene["triangles"] / 1000)
            self.assertGreater(row["ns_per_triangle"], 0)
            self.assertAlmostEqual(row["ns_per_triangle"] * row["million_triangles_per_second"] / 1000, 1, places=3)
            self.assertGreater(row["times_paper"], 0)
        self.assertEqual(rows[0]["times_paper"], 1)

    def test_json(self):
        demo = quick_demo()
        self.assertEqual([scene["triangles"] for scene in demo["scenes"]], [100000, 200000])
        self.assertEqual(demo["rounds"], 3)
        for scene in demo["scenes"]:
            self.check_scene(scene)
        voxels = demo["voxels"]
        self.assertEqual((max(voxels["size"]), voxels["picture"]), (128, None))
        self.assertTrue(10000 < voxels["occupied"] < 100000)
        self.assertGreater(voxels["seconds"], 0)

    def test_text(self):
        text = self.succeed("demo", "--quick", cwd=self.folder)
        self.assertEqual(os.listdir(self.folder), [])
        lines = text.splitlines()
        self.assertLessEqual(max(map(len, lines)), 100)
        self.assertLessEqual(len(lines), 24)
        self.assertRegex(text, r"\A[\x20-\x7e\n]*\Z")
        rows = re.findall(r"(?m)^(\w+) +(-|fast|conservative|exact|mesh)((?: +[\d.]+){6})$", text)
        expected = [(kernel, accuracy or "-") for kernel, accuracy in self.expected_rows()]
        self.assertEqual([row[:2] for row in rows], expected)
        self.assertEqual({column for row in rows if row[1] == "exact" for column in row[2].split()[2::3]}, {"0"})
        self.assertEqual(len({len(line) for line in lines if re.match(r"kernel +accuracy|paper +-", line)}), 1)

    def test_picture_of_the_voxels(self):
        path = os.path.join(self.folder, "knot.png")
        result = support.run("demo", "--quick", "--picture", path, cwd=self.folder)
        if "built without libpng" in result.stderr:
            self.assertEqual((result.code, os.listdir(self.folder)), (1, []))
            self.skipTest("built without libpng")
        self.assertEqual((result.code, result.stderr, os.listdir(self.folder)), (0, "", ["knot.png"]))
        self.assertRegex(result.stdout, r"(?m)^Voxels of the mesh: 123 x 128 x 53 cells, \d+ of them occupied; [\d.]+ ms, ")
        self.assertIn("drawn in %s\n" % path, result.stdout)
        self.assertEqual(volumes.png_size(path), (1280, 960))
        self.fail_with(2, "--picture: 'knot.jpg' does not end in .png", "demo", "--picture", "knot.jpg")
        self.fail_with(1, "none/knot.png: cannot write there", "demo", "--quick", "--json", "--picture", self.folder + "/none/knot.png")

    @support.unless_sanitized
    def test_where_the_picture_goes(self):
        result = support.run("demo", cwd=self.folder)
        drawn = os.listdir(self.folder)
        self.assertIn(drawn, (["tribox-demo.png"], []))  # none without libpng
        self.assertEqual("drawn in tribox-demo.png" in result.stdout, bool(drawn))

    @support.unless_sanitized
    def test_answers_repeat(self):
        def found(demo):
            return [demo["voxels"]["occupied"]], [[(row["overlapping"], row["unlike_exact"]) for row in scene["rows"]] for scene in demo["scenes"]]
        self.assertEqual(found(json.loads(self.succeed("demo", "--quick", "--json"))), found(quick_demo()))

    def on_terminal(self, **env):
        """What demo prints to a terminal, line ends made plain."""
        leader, follower = pty.openpty()
        plain = {name: value for name, value in os.environ.items() if name not in ("NO_COLOR", "TERM")}
        process = subprocess.Popen([support.program(), "demo", "--quick"], stdout=follower, env={**plain, **env})
        os.close(follower)
        text = b""
        try:
            while True:
                part = os.read(leader, 65536)
                if not part:
                    break
                text += part
        except OSError:
            pass  # Linux ends a terminal without a writer so
        os.close(leader)
        self.assertEqual(process.wait(), 0)
        return text

    @support.unless_sanitized
    def test_bold_on_a_terminal_only(self):
        self.assertEqual(self.on_terminal(TERM="xterm").count(b"\x1b[1m"), 1)
        self.assertNotIn(b"\x1b", self.on_terminal(TERM="dumb"))
        self.assertNotIn(b"\x1b", self.on_terminal(TERM="xterm", NO_COLOR="1"))
        self.assertNotIn(b"\x1b", self.on_terminal())


if __name__ == "__main__":
    support.main()
