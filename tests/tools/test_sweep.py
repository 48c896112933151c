"""tribox sweep: its counts against the axes in rational numbers, its forms, and its errors. Times are only there, not judged."""

import itertools
import math
import os
import random
import re
import xml.etree.ElementTree

import triangles as meshes
import harness

ORDERS = [123, 132, 213, 231, 312, 321]
LANES = [1, 4, 8, 16]
GROUPS = {1: range(0, 3), 2: range(3, 4), 3: range(4, 13)}
BOX = (-0.5, -0.25, -0.5, 0.5, 0.5, 0.75)


def separations(triangle, box):
    """For each of the thirteen axes whether it separates, and whether the outer side of its edge does."""
    center = [(lo + hi) / 2 for lo, hi in zip(box[:3], box[3:])]
    half = [(hi - lo) / 2 for lo, hi in zip(box[:3], box[3:])]
    v = [[x - c for x, c in zip(vertex, center)] for vertex in triangle]
    f = [[q - p for p, q in zip(v[j], v[(j + 1) % 3])] for j in range(3)]
    apart = [min(u[a] for u in v) > half[a] or max(u[a] for u in v) < -half[a] for a in range(3)]
    n = [f[0][(a + 1) % 3] * f[1][(a + 2) % 3] - f[0][(a + 2) % 3] * f[1][(a + 1) % 3] for a in range(3)]
    apart.append(abs(sum(p * q for p, q in zip(n, v[0]))) > sum(h * abs(x) for h, x in zip(half, n)))
    outer = list(apart)
    for i, j in itertools.product(range(3), range(3)):
        a, b = (i + 1) % 3, (i + 2) % 3
        p, q = (u[a] * f[j][b] - u[b] * f[j][a] for u in (v[j], v[(j + 2) % 3]))
        r = half[a] * abs(f[j][b]) + half[b] * abs(f[j][a])
        apart.append(min(p, q) > r or max(p, q) < -r)
        outer.append(p > r if p < q else p < -r)
    return apart, outer


class Sweep(harness.TestCase):
    def setUp(self):
        super().setUp()
        pick = random.Random(1)  # steps of 1/4096: products are exact in double, and hardly an edge is parallel to a box axis
        self.triangles = [tuple(tuple(pick.randint(-8192, 8192) / 4096 for _ in range(3)) for _ in range(3)) for _ in range(704)]
        self.mesh = self.write("mesh.ply", meshes.ply_of(self.triangles))
        self.kernels = harness.kernels()

    def sweep(self, *options):
        found = self.ask("sweep", self.mesh, "--quick", *options)
        self.assertEqual(found["rounds"], 5)
        return found

    def check(self, found):
        """What has to hold of every sweep."""
        entrants, pairs = found["entrants"], found["pairs"]
        keys = [(e["kernel"], e["accuracy"], e["axes"], e["order"]) for e in entrants]
        self.assertEqual(len(set(keys)), len(keys))
        self.assertEqual(len(keys), 6 + 27 * len(self.kernels))
        self.assertEqual([e["kernel"] for e in entrants if e["order"] == 321 and e["accuracy"] == "fast"], ["paper", *self.kernels])
        for e in entrants:
            self.assertEqual(len(e["ns_per_pair"]), found["rounds"])
            self.assertGreater(min(e["ns_per_pair"]), 0)
            if e["accuracy"] == "exact":
                self.assertEqual(e["reported"] - e["unlike_exact"], found["overlapping"])
                self.assertEqual(e["unlike_exact"] > 0 and e["axes"] == 7, False)
        for order in found["orders"]:
            self.assertEqual(sum(order["first"]) + found["overlapping"], pairs)
            for w in order["lanes"]:
                self.assertEqual(w["packets_left"], sorted(w["packets_left"], reverse=True))
                self.assertTrue(w["bytes"] <= 36 * pairs)
        advice = found["advice"]
        self.assertEqual(advice["kernel"], self.kernels[0])
        self.assertIn((advice["kernel"], "exact", advice["axes"], advice["order"]), keys)
        self.assertTrue(0 <= advice["gain_percent"] < 100)
        self.assertRegex(advice["text"], r"\AUse [^\n]*\.\Z")

    def test_counts(self):
        found = self.sweep("--box", ",".join(map(str, BOX)))
        self.check(found)
        both = [separations(triangle, BOX) for triangle in self.triangles]
        aparts, outers = [apart for apart, _ in both], [outer for _, outer in both]
        self.assertEqual((found["pairs"], found["soups"], found["overlapping"]), (704, 1, sum(not any(a) for a in aparts)))
        self.assertEqual(found["overlapping"], len(meshes.overlapping(self.triangles, BOX)))
        columns = {"separates": lambda a, k: a[k], "alone": lambda a, k: a[k] and sum(a) == 1,
                   "no_box_normal_does": lambda a, k: a[k] and not any(a[:3])}
        for name, holds in columns.items():
            self.assertEqual(found["axes"][name], [sum(holds(a, k) for a in aparts) for k in range(13)], name)
        for order in found["orders"]:
            self.check_order(order, outers)

    def check_order(self, order, outers):
        groups = [GROUPS[int(digit)] for digit in str(order["order"])]
        sequence = [axis for group in groups for axis in group]
        first = [next((axis for axis in sequence if outer[axis]), None) for outer in outers]
        self.assertEqual(order["first"], [first.count(axis) for axis in range(13)])
        for w, lanes in zip(order["lanes"], LANES):
            packets = [outers[i:i + lanes] for i in range(0, len(outers), lanes)]
            self.assertEqual((w["lanes"], w["packets"]), (lanes, len(packets)))

            def left(axes):
                return sum(any(not any(outer[axis] for axis in axes) for outer in packet) for packet in packets)
            asked = [sum(map(list, groups[:k + 1]), []) for k in range(3)]
            self.assertEqual(w["packets_left"], [left(axes) for axes in asked])
            loads = [left(()), left((0,)), left((0, 1))] if order["order"] < 200 else [len(packets)] * 3
            self.assertEqual(w["bytes"], 12 * lanes * sum(loads))

    def test_octree(self):
        found = self.sweep("--octree", "2")
        self.check(found)
        self.assertEqual(found["soups"] % 8, 0)
        self.assertRegex(found["tested"], r"^\d+ leaves of an octree of depth 2,")

    @harness.unless_sanitized
    def test_default_is_an_octree(self):
        found = self.ask("sweep", self.mesh)
        self.assertTrue(self.sweep()["rounds"] <= found["rounds"] <= 32)
        self.check(found)
        self.assertRegex(found["tested"], r"^\d+ leaves of an octree of depth 3,")

    def test_grid(self):
        found = self.sweep("--grid", "5")
        self.check(found)
        self.assertEqual(found["pairs"], found["soups"] * 704)
        self.assertGreater(found["overlapping"], found["soups"])

    @harness.unless_sanitized
    def test_text(self):
        short = self.succeed("sweep", self.mesh, "--box", harness.UNIT_BOX, "--quick")
        advice, empty, *lines = short.splitlines()
        self.assertRegex(advice, r"\AUse .* here.*\.\Z")
        self.assertEqual(empty, "")
        self.assertEqual([line.split()[0] for line in lines], ["mesh", "triangles", "tested", "pairs", "processor", "time"])

    def test_tables(self):
        text = self.succeed("sweep", self.mesh, "--box", harness.UNIT_BOX, "--verbose", "--quick")
        self.assertLessEqual(max(map(len, text.splitlines()[1:])), 100)
        rows = re.findall(r"(?m)^(\w+) +(?:(fast|conservative|exact) +)?((?:[\d.]+ +|- +){7})(none|-|\d{3}, by [\d.]+ %)$", text)
        expected = [("paper", "")] + [(k, a) for k in self.kernels for a in ("fast", "conservative", "exact")]
        self.assertEqual([row[:2] for row in rows], expected)
        for order in ORDERS:
            self.assertIn("first in order %d" % order, text)

    def test_chart(self):
        path = os.path.join(self.folder, "chart.svg")
        found = self.ask("sweep", self.mesh, "--quick", "--chart", path)
        with open("/proc/cpuinfo") as file:
            model = re.search(r"model name\s*: (.*)", file.read())
        of_model = r" \(family \d+, model \d+\)(, virtual)?$"
        self.assertRegex(found["processor"], re.escape(model[1]) + of_model if model else "unknown")
        root = xml.etree.ElementTree.parse(path).getroot()
        rectangles = root.findall("{http://www.w3.org/2000/svg}rect")
        self.assertEqual(len(rectangles), 1 + 7 + 7 * 3 * len(self.kernels) + 6)
        self.assertEqual({text.text for text in root.iter() if text.text in (*self.kernels, "paper")}, {*self.kernels, "paper"})
        title, axis = [text.text for text in root.findall("{http://www.w3.org/2000/svg}text")][:2]
        self.assertRegex(title, r"^mesh\.ply: \d+ pairs, \d+ leaves of an octree")
        self.assertTrue(axis.endswith("; " + found["processor"]), axis)

    def test_not_finite(self):
        self.triangles[5] = ((math.nan, 0, 0), (1, 0, 0), (0, 1, 0))
        self.triangles[6] = ((0, math.inf, 0), (1, 0, 0), (0, 1, 0))
        self.mesh = self.write("some.ply", meshes.ply_of(self.triangles))
        for options in (("--grid", "4"), ("--octree", "1")):
            found = self.sweep(*options)
            self.assertEqual(found["pairs"], 702 * found["soups"])
            self.assertEqual(sum(found["orders"][0]["first"]) + found["overlapping"], found["pairs"])

    def test_shift(self):
        """Which rounds to float: next to nothing of a mesh that is near the origin by then."""
        far = self.write("far.ply", meshes.ply_of(meshes.far_triangles(9, seed=17), kind="double"))
        found = self.ask("sweep", far, "--grid", "1", "--quick", "--shift", "auto",
                         note=r"rounding to float moved coordinates of [0-9]+ vertices by up to [1-9](\.\d)?e-0[678]$")
        self.assertEqual(found["shift"], [557810, 5108000, 810])

    def test_flat_and_tiny(self):
        flat, point = ((0, 0, 0), (1, 0, 0), (0, 1, 0)), ((3, 3, 3), (3, 3, 3), (3, 3, 3))
        for triangle, options in ((flat, ("--octree", "3")), (point, ("--octree", "3")), (point, ("--grid", "7"))):
            self.mesh = self.write("tiny.ply", meshes.ply_of([triangle]))
            self.check(self.sweep(*options))


class Wrong(harness.TestCase):
    def test_files(self):
        self.fail_with(1, "nowhere.obj: cannot open the mesh file", "sweep", "nowhere.obj")
        bad = self.write("bad.ply", meshes.ply_of([((math.nan, 0, 0), (1, 0, 0), (0, 1, 0))]))
        for options in ((), ("--grid", "3"), ("--box", harness.UNIT_BOX)):
            self.fail_with(1, "no triangle has finite coordinates", "sweep", bad, *options)
        mesh = self.write("mesh.ply", meshes.ply_of([((0, 0, 0), (1, 0, 0), (0, 1, 0))]))
        chart = os.path.join(self.folder, "no", "c.svg")
        self.fail_with(1, "--chart: cannot write '.*': No such file", "sweep", mesh, "--chart", chart)
        if os.path.exists("/dev/full"):
            self.fail_with(1, "--chart: '/dev/full' could not be written to its end", "sweep", mesh, "--quick", "--chart",
                           "/dev/full")


if __name__ == "__main__":
    harness.main()
