"""tribox voxelize --preview: the right axis is up, what is right is right, shadows fall, and nothing hidden shows."""

import triangles as meshes
import harness
import readers

WIDTH, HEIGHT = 160, 120


# Stands along z on a foot that reaches along x.
LETTER_L = meshes.cube((0, 0, 0), (1, 1, 4)) + meshes.cube((0, 0, 0), (3, 1, 1))


def is_clay(pixel):
    """Clay is at least as red as blue; background and shadows are bluer."""
    return pixel[0] >= pixel[2]


class Picture:
    def __init__(self, path):
        pixels = readers.read_png(path)
        self.height, self.width = pixels.shape[:2]
        self.rows = [list(map(tuple, row)) for row in pixels.tolist()]
        self.clay = [(x, y) for y, row in enumerate(self.rows) for x, pixel in enumerate(row) if is_clay(pixel)]

    def bounds(self):
        """Left, top, right, bottom of the voxels."""
        xs, ys = zip(*self.clay)
        return min(xs), min(ys), max(xs), max(ys)

    def shares(self):
        """How much of their bounds the voxels fill: upper left, upper right, lower left and lower right quarter."""
        left, top, right, bottom = self.bounds()
        middle = (left + right + 1) / 2, (top + bottom + 1) / 2
        counts = [0, 0, 0, 0]
        for x, y in self.clay:
            counts[2 * (y >= middle[1]) + (x >= middle[0])] += 1
        return [4 * n / (right + 1 - left) / (bottom + 1 - top) for n in counts]

    def empty_quarter(self):
        shares = self.shares()
        return ["upper left", "upper right", "lower left", "lower right"][shares.index(min(shares))]


class Preview(harness.TestCase):
    def setUp(self):
        super().setUp()
        self.mesh = self.write("mesh.obj", meshes.obj(LETTER_L))
        self.need("libpng")

    def draw(self, *options, mesh=None, size="%dx%d" % (WIDTH, HEIGHT)):
        self.succeed("voxelize", mesh or self.mesh, "-o", self.path("out.npy"), "--preview", self.path("p.png"), "--quiet",
                     *(("--picture-size", size) if size else ()), *options)
        return harness.read(self.path("p.png"))

    def picture(self, *options, **how):
        self.draw(*options, **how)
        return Picture(self.path("p.png"))

    def test_size(self):
        for size, due in ((None, (1280, 960)), ("33x77", (33, 77)), ("1x1", (1, 1))):
            self.draw("--resolution", "8", size=size)
            self.assertEqual(readers.open_png(self.path("p.png"))[:2], due)

    def test_same_for_every_thread_count(self):
        self.assertEqual(len({self.draw("--resolution", "9", "--threads", n) for n in ("1", "2", "7")}), 1)

    def test_what_is_up(self):
        """The L is open at its upper right; turned in space, with the axis up that it stands along, it looks the same."""
        expected = self.picture("--resolution", "40")
        self.assertEqual(expected.empty_quarter(), "upper right")
        for word in ("z", "x", "y", "-x", "-y", "-z"):
            axis, sign = "xyz".index(word[-1]), -1 if word[0] == "-" else 1
            up, right = ([sign * (a == axis) for a in range(3)], [axis != 0, axis == 0, 0])
            front = [right[(a + 1) % 3] * up[(a + 2) % 3] - right[(a + 2) % 3] * up[(a + 1) % 3] for a in range(3)]
            turned = [tuple(tuple(x * right[a] - y * front[a] + z * up[a] for a in range(3)) for x, y, z in t) for t in LETTER_L]
            picture = self.picture("--resolution", "40", "--up", word, mesh=self.write("turned.obj", meshes.obj(turned)))
            self.assertLess(len(set(picture.clay) ^ set(expected.clay)), len(expected.clay) / 50, word)

    def test_what_a_format_says_is_up(self):
        """Of glTF y is up, and the summary says so; --up has the last word."""
        upright = [tuple((x, z, -y) for x, y, z in t) for t in LETTER_L]
        mesh, other = self.write("upright.glb", meshes.glb(upright)), self.write("upright.stl", meshes.stl_binary(upright))
        picture = self.path("up.png")
        size = ("-r", "40", "--picture-size", "%dx%d" % (WIDTH, HEIGHT), "-o", self.path("x.npy"), "--preview", picture)
        for path, up, said, quarter in ((mesh, [], "y, as glTF has it; --up tells otherwise", "upper right"),
                                        (mesh, ["--up", "y"], "y", "upper right"), (mesh, ["--up", "-y"], "-y", "lower right"),
                                        (other, [], "z; where the mesh has another, --up tells, as in --up y", None)):
            text = self.succeed("voxelize", path, *size, *up)
            self.assertIn("\npreview      %s\nup           %s\n" % (picture, said), text)
            if quarter:
                self.assertEqual(Picture(picture).empty_quarter(), quarter, up)

    def test_default_view(self):
        """From the front, the right and above: three sides, of which the top is the brightest, and the right in shadow."""
        self.assertEqual(self.draw("--resolution", "9"), self.draw("--resolution", "9", "--up", "z"))
        picture = self.picture("--resolution", "20", mesh=self.cube())
        left, top, right, bottom = picture.bounds()
        sides = [sum(picture.rows[int(top + down * (bottom - top))][int(left + across * (right - left))])
                 for across, down in ((0.5, 0.15), (0.3, 0.6), (0.85, 0.6))]
        self.assertEqual(sides, sorted(sides, reverse=True))
        self.assertGreater(sides[0], sides[2] + 100)

    def cube(self):
        return self.write("cube.obj", meshes.obj(meshes.cube((0, 0, 0), (1, 1, 1))))

    def test_shadow(self):
        """The ground is dark on the right, away from the sun, and as bright as the background on the left."""
        picture = self.picture("--resolution", "20", mesh=self.cube())
        left, _, right, bottom = picture.bounds()

        def dark(columns):
            return sum(picture.rows[y][x][0] < picture.rows[y][0][0] - 40 for y in range(bottom) for x in columns)
        self.assertGreater(dark(range(right + 2, WIDTH)), 300)
        self.assertLess(dark(range(left - 2)), 20)

    def test_hidden_cells_do_not_show(self):
        shell = meshes.cube((0, 0, 0), (8, 6, 5))
        inside = [t for n in range(4) for t in meshes.cube((1 + 2 * n, 0.3, 0.3), (2 + 2 * n, 5.7, 4.7))]
        empty, full = self.write("empty.obj", meshes.obj(shell)), self.write("full.obj", meshes.obj(shell + inside))
        for resolution in ("10", "77", "150"):
            self.assertEqual(self.draw("--resolution", resolution, mesh=empty), self.draw("--resolution", resolution, mesh=full))

    def test_edges_of_large_cells(self):
        """A wall of 6 x 6 cells has lines between them, one of fine cells is even."""
        wall = self.write("wall.obj", meshes.obj(meshes.cube((0, 0, 0), (6, 1, 6))))

        def changes(resolution):
            picture = self.picture("--resolution", resolution, mesh=wall)
            left, top, right, bottom = picture.bounds()
            row = [sum(p) for p in picture.rows[(top + bottom) // 2][left + WIDTH // 16:(left + 2 * right) // 3]]
            return sum(abs(a - b) > 20 for a, b in zip(row, row[1:]))
        self.assertGreaterEqual(changes("6"), 6)
        self.assertEqual(changes("300"), 0)

    def test_merged(self):
        parts = [self.path("%d.part.npz" % n) for n in (1, 2, 3)]
        for n, part in enumerate(parts):
            self.succeed("voxelize", self.mesh, "--resolution", "7", "--shard", "%d/3" % (n + 1), "--quiet", "-o", part)
        look = ["--up", "y", "--picture-size", "80x60"]
        self.succeed("merge", *parts, "-o", self.path("m.npy"), "--preview", self.path("m.png"), "--quiet", *look)
        self.assertEqual(harness.read(self.path("m.png")), self.draw("--resolution", "7", *look, size=None))

    def test_nothing_to_see(self):
        picture = self.picture("--cell", "1", "--origin", "50,50,50", "--size", "4,4,4")
        self.assertTrue(all(len(set(row)) == 1 for row in picture.rows))
        self.assertFalse(picture.clay)

    def test_one_cell(self):
        """It fills the height, and is as wide as a cube is from there."""
        left, top, right, bottom = self.picture("--cell", "8").bounds()
        self.assertAlmostEqual(bottom - top, 0.9 * HEIGHT, delta=3)
        self.assertAlmostEqual((right - left) / (bottom - top), 1.38 / 1.49, delta=0.05)

    def test_shape_does_not_depend_on_cells(self):
        """Cells that are no cubes, and so fine that some are joined."""
        cubes = self.picture("--cell", "0.05").bounds()
        for cell in ("0.1,0.05,0.05", "0.05,0.05,0.1", "0.05,0.2,0.05", "0.05,0.05,0.001"):
            for a, b in zip(self.picture("--cell", cell).bounds(), cubes):
                self.assertAlmostEqual(a, b, delta=4, msg=cell)

    def test_long_bar(self):
        bar = self.write("bar.obj", meshes.obj(meshes.cube((0, 0, 0), (0.5, 1500, 0.5))))
        for cell in ("1", "1,1,0.000001"):
            self.assertTrue(self.picture("--cell", cell, "--size", "1,1501,1", mesh=bar).rows)
        self.assertTrue(self.picture("--cell", "1", mesh=bar).clay)


if __name__ == "__main__":
    harness.main()
