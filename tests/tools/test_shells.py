"""The surface of cells as a mesh: tribox voxelize -o cells.ply, .obj and .glb, and tribox merge."""

import collections
import functools
import itertools
import os
import random

import triangles as meshes
import harness
import readers

SEED = harness.SEED


def block(nx, ny, nz):
    return set(itertools.product(range(nx), range(ny), range(nz)))


# Two cells that touch in an edge are in a block without two of its cells, which holds them together around both ends.
SCENES = {
    "an edge twice along z": ((2, 2, 3), block(2, 2, 3) - {(0, 0, 1), (1, 1, 1)}),
    "an edge twice along y": ((2, 3, 2), block(2, 3, 2) - {(1, 1, 0), (0, 1, 1)}),
    "an edge twice along x": ((3, 2, 2), block(3, 2, 2) - {(1, 0, 0), (1, 1, 1)}),
    "a long edge twice": ((2, 2, 7), block(2, 2, 7) - {(i, i, k) for i in (0, 1) for k in range(1, 6)}),
    "checkerboard": ((6, 5, 4), {c for c in block(6, 5, 4) if sum(c) % 2}),
    "cavity": ((3, 3, 3), block(3, 3, 3) - {(1, 1, 1)}),
    "tunnel": ((3, 3, 3), block(3, 3, 3) - {(1, 1, k) for k in range(3)}),
    "steps": ((8, 8, 8), {c for c in block(8, 8, 8) if sum(c) < 9}),
    "borders": ((65, 4, 3), block(65, 4, 3) - {(i, 1, 1) for i in range(1, 64)}),
    "across words": ((130, 5, 2), {c for c in block(130, 5, 2) if (c[0] // 7 + c[1]) % 3}),
    "rows": ((5, 130, 66), {(2, j, 30) for j in range(130)} | {(4, 63, k) for k in range(66)} | {(4, 64, 65)}),
    "clear": ((4, 5, 6), set()),
}


def random_scenes(count):
    pick = random.Random(SEED)
    for n in range(count):
        size = [pick.randint(1, 9) for _ in range(3)]
        size[n % 3] = pick.choice((size[n % 3], 63, 64, 65))
        share = pick.choice((0.1, 0.3, 0.5, 0.7, 0.9))
        yield tuple(size), {c for c in block(*size) if pick.random() < share}


# What is to be true of the meshes of cells, found from the cells alone.

def surface_in(path):
    vertices, triangles, _ = readers.mesh(path)
    return list(map(tuple, vertices.tolist())), list(map(tuple, triangles.tolist()))


def faces(cells):
    """How many faces look along each axis, 0 to 2, up or down."""
    count = collections.Counter()
    for cell in cells:
        for axis, step in itertools.product(range(3), (-1, 1)):
            if tuple(x + step * (a == axis) for a, x in enumerate(cell)) not in cells:
                count[axis, step > 0] += 1
    return count


STEPS = tuple((1 << n, step) for n, step in enumerate(itertools.product((-1, 0, 1), repeat=3)))


@functools.lru_cache(None)
def groups(near):
    """How many groups there are, which hang together by faces, of cells around a part of them: a bit of STEPS for each."""
    left, count = {step for bit, step in STEPS if near & bit}, 0
    while left:
        count, reached = count + 1, [left.pop()]
        for cell in reached:
            beside = {other for other in left if sum(abs(a - b) for a, b in zip(cell, other)) == 2}
            left -= beside
            reached.extend(beside)
    return count


def euler(cells):
    """Of the surface: twice that of the body, of cells with their faces, edges and points; an edge or a point in which groups of
    cells touch is each group's own."""
    around = collections.defaultdict(int)  # each part of a cell, in halves of its side
    for x, y, z in cells:
        for bit, (i, j, k) in STEPS:
            around[2 * x + i, 2 * y + j, 2 * z + k] |= bit
    body = 0
    for part, near in around.items():
        sides = sum(x % 2 for x in part)  # 0 in the cell, 1 in a face, 2 in an edge, 3 in a point
        body += (1 if sides < 2 else groups(near)) * (1 if sides % 2 else -1)
    return 2 * body


def umbrellas(triangles):
    """Around how many vertices the triangles are not one ring."""
    links = collections.defaultdict(dict)
    for t in triangles:
        for n in range(3):
            links[t[n]][t[(n + 1) % 3]] = t[(n + 2) % 3]
    broken = 0
    for ring in links.values():
        first = at = next(iter(ring))
        steps = 0
        while at in ring and (steps == 0 or at != first):
            at, steps = ring[at], steps + 1
        broken += at != first or steps != len(ring)
    return broken


def check_surface(vertices, triangles, cells):
    """All of it for cells of side 1 from 0, 0, 0 on. Returns nothing; what is wrong is an AssertionError."""
    edges = collections.Counter(edge for a, b, c in triangles for edge in ((a, b), (b, c), (c, a)))
    assert all(count == 1 and edges[b, a] == 1 for (a, b), count in edges.items()), "edges without their opposite"
    assert set(itertools.chain(*triangles)) == set(range(len(vertices))), "vertices of no triangle"
    assert umbrellas(triangles) == 0, "vertices where sheets touch"
    assert len(vertices) - len(edges) // 2 + len(triangles) == euler(cells), "Euler's count"
    volume, area = 0, collections.Counter()
    for triangle in triangles:
        p, q, r = (vertices[n] for n in triangle)
        u, v = [b - a for a, b in zip(p, q)], [b - a for a, b in zip(p, r)]
        normal = [u[(a + 1) % 3] * v[(a + 2) % 3] - u[(a + 2) % 3] * v[(a + 1) % 3] for a in range(3)]
        (axis,) = (a for a in range(3) if normal[a])
        area[axis, normal[axis] > 0] += abs(normal[axis]) / 2
        volume += p[axis] * normal[axis] / 2 if axis == 0 else 0
    assert area == faces(cells), "areas"
    assert volume == len(cells), "volume"


class Shells(harness.TestCase):
    def points(self, cells):
        """A mesh with a point in the middle of each cell, and one outside, as there is no mesh of none."""
        middles = [tuple(x + 0.5 for x in cell) for cell in sorted(cells)] + [(-9, -9, -9)]
        return self.write("points.f32", meshes.pack_floats([(p, p, p) for p in middles]))

    def shell(self, size, cells, ending, *options):
        out = self.path("cells" + ending)
        self.succeed("voxelize", self.points(cells), "--cell", "1", "--origin", "0,0,0", "--size", "%d,%d,%d" % size, "-q", "-o",
                     out, *options)
        return surface_in(out)


class Surface(Shells):
    def check(self, size, cells, what):
        vertices, triangles = self.shell(size, cells, ".ply")
        try:
            check_surface(vertices, triangles, cells)
        except AssertionError as wrong:
            self.fail("%s, %s: %s" % (what, size, wrong))
        for ending in (".obj", ".glb"):
            self.assertEqual(self.shell(size, cells, ending), (vertices, triangles), (what, ending))
        return len(triangles)

    def test_scenes(self):
        for name, (size, cells) in SCENES.items():
            self.check(size, cells, name)

    def test_random_cells(self):
        for n, (size, cells) in enumerate(random_scenes(24)):
            self.check(size, cells, n)

    def test_faces_are_merged(self):
        """A block of any size has the faces of one cell; two that meet have vertices of the one on the edges of the other."""
        self.assertEqual(self.check((64, 3, 65), block(64, 3, 65), "full"), 12)
        small = {(i, 0, 0) for i in range(10)} | {(4, 1, 0)}
        self.assertEqual(self.check((10, 2, 1), small, "a cell on a bar"), 28)

    def test_corners_of_every_kind(self):
        """All ways in which eight cells meet, each in blocks of its own."""
        for first in range(0, 256, 32):
            cells = {(3 * (n % 8) + (s & 1), 3 * (n // 8) + (s >> 1 & 1), s >> 2) for n in range(32) for s in range(8)
                     if first + n >> s & 1}
            self.check((24, 12, 2), cells, first)

    def test_clear_cells(self):
        for ending in readers.MESHES:
            self.assertEqual(self.shell((3, 3, 3), set(), ending), ([], []))


class Places(Shells):
    GRIDS = {"no floats": ("--cell", "0.3,0.1,0.7", "--origin=-2.1,-2,-1.9", "--size", "14,41,6"), "resolution": ("-r", "19"),
             "shifted": ("--shift", "1e6,-0.1,7", "--cell", "0.3", "--origin=-1000002,-3,-9", "--size", "15,15,15"),
             "tiny": ("--cell", "1e-9", "--origin", "1,1,1", "--size", "4,5,6")}

    def test_planes(self):
        """Vertices are on the planes of the grid and in their middle, the shift is given back; .ply, .obj and .glb agree."""
        mesh = self.write("mesh.ply", meshes.ply_of(meshes.lattice_triangles(9, seed=3)))
        for name, options in self.GRIDS.items():
            found = {}
            for ending in readers.MESHES:
                about = self.ask("voxelize", mesh, *options, "-o", self.path("x" + ending))
                found[ending] = surface_in(self.path("x" + ending))
            grid, shift = about["grid"], about.get("shift", [0, 0, 0])
            self.assertEqual(found[".ply"], found[".obj"])
            self.assertEqual(found[".ply"][1], found[".glb"][1])
            planes = [[x + shift[a] for x in meshes.planes(grid, a)] for a in range(3)]
            for vertex, other in zip(*(found[ending][0] for ending in (".ply", ".glb"))):
                on_planes = [vertex[a] in planes[a] for a in range(3)]
                self.assertGreaterEqual(sum(on_planes), 2, (name, vertex))
                for a in range(3):
                    far = abs(grid["origin"][a]) + abs(shift[a]) + 50 * grid["cell"][a]
                    self.assertAlmostEqual(vertex[a], other[a], delta=4e-16 * far)

    def test_voxelized_again(self):
        """The cells of the surface are those on both sides of a face, and their neighbours."""
        size, cells = SCENES["steps"]
        touched = set()
        for cell in block(*size):
            near = {tuple(x + d for x, d in zip(cell, step)) for step in itertools.product((-1, 0, 1), repeat=3)}
            touched |= {cell} if near & cells and near - cells else set()
        for ending in (".ply", ".obj", ".glb"):
            if ending == ".glb" and harness.lacks("libassimp"):
                continue
            self.shell(size, cells, ending)
            self.succeed("voxelize", self.path("cells" + ending), "--cell", "1", "--origin", "0,0,0", "--size", "8,8,8", "-q", "-o",
                         self.path("again.npy"))
            self.assertEqual(readers.places_of(self.path("again.npy")), touched, ending)


class Ways(Shells):
    def setUp(self):
        super().setUp()
        self.mesh = self.write("mesh.ply", meshes.ply_of(meshes.lattice_triangles(24, seed=9)))

    def test_filled(self):
        """A box with its inside has no second surface."""
        mesh = self.write("box.ply", meshes.ply_of(meshes.cube((1.5,) * 3, (5.5,) * 3)))
        grid = ("--cell", "1", "--origin", "0,0,0", "--size", "8,8,8", "-q")
        solid = {c for c in block(8, 8, 8) if min(c) >= 1 and max(c) <= 5}
        hollow = {c for c in solid if min(c) == 1 or max(c) == 5}
        for options, cells in (((), hollow), (("--fill", "outside"), solid), (("--fill", "parity"), solid)):
            self.succeed("voxelize", mesh, *grid, "-o", self.path("box_cells.ply"), *options)
            check_surface(*surface_in(self.path("box_cells.ply")), cells)

    def test_refused_before_the_work(self):
        for ending, size, reason in ((".glb", "8388609,1,1",
                                      r"\.glb holds at most 8388608 cells on each axis, .*; write .ply or .obj"),
                                     (".ply", "100000,100000,100000",
                                      "the most is 16.0 GiB: choose fewer cells, or write .npz or .vdb"),
                                     (".obj", "2000000000,1,20", "of memory here and .* are available: choose fewer cells")):
            self.fail_with(1, reason, "voxelize", self.mesh, "--cell", "1", "--origin=-2,-2,-2", "--size", size, "-o",
                           self.path("no" + ending))
        self.assertEqual(os.listdir(self.folder), ["mesh.ply"])

    def test_vtk_reads(self):
        """Closed, no edge of more than two triangles, and as large as the cells: by VTK, what ParaView has."""
        size, cells = SCENES["an edge twice along z"]
        paths = []
        for ending in readers.MESHES:
            self.shell(size, cells, ending)
            paths.append(self.path("cells" + ending))
        found = self.foreign("vtk_mesh", *paths)
        vertices, triangles = surface_in(paths[0])
        for path, of_one in zip(paths, found):
            self.assertEqual((of_one["triangles"], of_one["vertices"], of_one["edges"]), (len(triangles), len(vertices), 0), path)
            self.assertAlmostEqual(of_one["volume"], len(cells), places=5)


if __name__ == "__main__":
    harness.main()
