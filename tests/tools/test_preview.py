"""tribox voxelize --preview: a PNG of the right size that shows the voxels."""

import os

import meshes
import support
import volumes

CUBE = [((x, y, z), (x2, y2, z2), (x3, y3, z3)) for (x, y, z), (x2, y2, z2), (x3, y3, z3) in
        (((0, 0, 0), (1, 0, 0), (0, 1, 0)), ((0, 0, 0), (0, 0, 1), (0, 1, 0)), ((0, 0, 0), (1, 0, 0), (0, 0, 1)))]


class Preview(support.TestCase):
    def setUp(self):
        super().setUp()
        self.mesh = self.write("mesh.obj", meshes.obj(CUBE))
        probe = support.run("voxelize", self.path("none.obj"), "--cell", "1", "-o", self.path("x.npy"), "--preview", "x.png")
        if "built without libpng" in probe.stderr:
            self.skipTest("built without libpng")

    def path(self, name):
        return os.path.join(self.folder, name)

    def preview(self, name, *options):
        self.succeed("voxelize", self.mesh, "-o", self.path("out.npy"), "--preview", self.path(name), "--quiet", *options)
        return volumes.read(self.path(name))

    def test_picture(self):
        self.preview("a.png", "--resolution", "16")
        width, height, rows = volumes.read_png(self.path("a.png"))
        self.assertEqual((width, height), (1280, 960))
        colours = [row[3 * x:3 * x + 3] for row in rows[::4] for x in range(0, width, 4)]
        self.assertGreater(len(set(colours)), 500)
        # Clay is redder than blue, the background is bluer than red.
        clay = sum(red > blue + 15 for red, green, blue in colours)
        self.assertTrue(len(colours) / 10 < clay < len(colours) * 9 / 10, clay)
        self.assertTrue(all(row[0] <= row[2] for row in rows))

    def test_same_for_every_thread_count(self):
        self.assertEqual(len({self.preview("t.png", "--resolution", "9", "--threads", n) for n in ("1", "7")}), 1)

    def test_up(self):
        pictures = [self.preview("up.png", "--resolution", "5", *up) for up in ((), ("--up", "z"), ("--up=-y",))]
        self.assertEqual(pictures[0], pictures[1])
        self.assertNotEqual(pictures[0], pictures[2])

    def test_merged(self):
        parts = [self.path("%d.part" % n) for n in (1, 2, 3)]
        for n, part in enumerate(parts):
            self.succeed("voxelize", self.mesh, "--resolution", "7", "--shard", "%d/3" % (n + 1), "--quiet", "-o", part)
        self.succeed("merge", *parts, "-o", self.path("m.npy"), "--preview", self.path("m.png"), "--up", "y", "--quiet")
        self.assertEqual(volumes.read(self.path("m.png")), self.preview("w.png", "--resolution", "7", "--up", "y"))

    def test_nothing_to_see(self):
        self.preview("none.png", "--cell", "1", "--origin", "50,50,50", "--size", "4,4,4")
        self.assertEqual(volumes.read_png(self.path("none.png"))[:2], (1280, 960))

    def test_cells_that_are_no_cubes_and_fine_grids(self):
        self.preview("long.png", "--cell", "0.2,0.1,0.1")
        self.preview("thin.png", "--cell", "0.0002", "--size", "5000,40,40")  # drawn coarser
        self.assertEqual(volumes.read_png(self.path("thin.png"))[:2], (1280, 960))

    def test_names(self):
        for name in ("p.jpg", "png", ".png", ""):
            self.fail_with(2, "--preview: '%s' does not end in .png" % name, "voxelize", self.mesh, "--cell", "1", "-o", "x.npy",
                           "--preview", name)


if __name__ == "__main__":
    support.main()
