"""The colours of cells: tribox voxelize --colours, from each way in which meshes have them into each file that holds them.

What is right is found from the triangles alone. A colour is (red, green, blue) in bytes; a reader of a file returns {cell: colour}
or, of a mesh, triangles with a colour each.
"""

import functools
import itertools
import math
import os
import random
import struct

import harness
import numpy as np
import readers
import triangles as meshes

SEED = harness.SEED
GRID = ("--cell", "0.5,0.75,0.5", "--origin=-2,-2.25,-2", "--size", "8,6,9")
ABOUT = {"origin": [-2, -2.25, -2], "cell": [0.5, 0.75, 0.5], "size": [8, 6, 9]}

GREY = (204, 204, 204)


def lowest_in(triangles, grid):
    """The lowest number of a triangle that overlaps each cell (i, j, k)."""
    cells = meshes.lowest(triangles, grid)
    return {(int(i), int(j), int(k)): int(cells[k, j, i]) for k, j, i in np.argwhere(cells >= 0)}


def mean(colours):
    """The nearest; a half goes up."""
    return tuple((2 * sum(c[a] for c in colours) + len(colours)) // (2 * len(colours)) for a in range(3))


# PLY: of each type what a byte becomes.
TYPES = {"uchar": int, "ushort": lambda byte: 257 * byte, "float": lambda byte: byte / 255, "double": lambda byte: byte / 255,
         "int": int}


def ply(vertices, polygons, vertex_colours=None, face_colours=None, kind="uchar", form="ascii", names=("red", "green", "blue"),
        faces_first=False):
    """The other properties around the colours are there to be passed over."""
    def of(colours, n):
        return [TYPES[kind](byte) for byte in colours[n]] if colours else []

    colour = [(name, kind) for name in names]
    elements = [("vertex", [("confidence", "float"), *meshes.XYZ, *(colour if vertex_colours else [])],
                 [[7, *vertex, *of(vertex_colours, n)] for n, vertex in enumerate(vertices)]),
                ("face", [*meshes.CORNERS, *(colour if face_colours else []), ("flags", "ushort")],
                 [[list(polygon), *of(face_colours, n), 9] for n, polygon in enumerate(polygons)])]
    return meshes.ply(elements[::-1] if faces_first else elements, form)


def triangles_of(path):
    """The corners of each, and its colour."""
    vertices, triangles, colours = readers.mesh(path)
    return [] if colours is None else list(zip(vertices[triangles].tolist(), map(tuple, colours.tolist())))


def is_within(point, polygon):
    """Whether a point of a plane is in a triangle, or on its edge."""
    turns = []
    for n in range(3):
        (ax, ay), (bx, by) = polygon[n - 1], polygon[n]
        turns.append((bx - ax) * (point[1] - ay) - (by - ay) * (point[0] - ax))
    return all(t >= -1e-9 for t in turns) or all(t <= 1e-9 for t in turns)


def faces_of(triangles, grid):
    """The colours of each face of a cell, (cell, axis, is_up), by the triangles over its middle."""
    found = {}
    for corners, colour in triangles:
        places = [[(v[a] - grid["origin"][a]) / grid["cell"][a] for a in range(3)] for v in corners]
        u, v = ([b - a for a, b in zip(places[0], p)] for p in places[1:])
        normal = [u[(a + 1) % 3] * v[(a + 2) % 3] - u[(a + 2) % 3] * v[(a + 1) % 3] for a in range(3)]
        axis = max(range(3), key=lambda a: abs(normal[a]))
        others = [a for a in range(3) if a != axis]
        flat, plane, is_up = [[p[a] for a in others] for p in places], round(places[0][axis]), normal[axis] > 0
        spans = [range(math.floor(min(p[a] for p in places)), math.ceil(max(p[a] for p in places))) for a in others]
        for i, j in itertools.product(*spans):
            if is_within((i + 0.5, j + 0.5), flat):
                cell = [0, 0, 0]
                cell[axis], cell[others[0]], cell[others[1]] = plane - is_up, i, j
                found.setdefault((tuple(cell), axis, is_up), set()).add(tuple(colour))
    return found


def faces_expected(cells):
    """The same, from the colours of cells."""
    found = {}
    for cell, axis, step in itertools.product(cells, range(3), (-1, 1)):
        beside = tuple(x + step * (a == axis) for a, x in enumerate(cell))
        if beside not in cells:
            found[cell, axis, step > 0] = {cells[cell]}
    return found


def pick_colours(count, seed):
    """Ends and neighbours of ends among them."""
    pick = random.Random(seed)
    return [tuple(pick.choice((0, 1, 254, 255, pick.randrange(256))) for _ in range(3)) for _ in range(count)]


@functools.lru_cache
def scene():
    triangles = meshes.lattice_triangles(14, seed=SEED)
    return triangles, lowest_in(triangles, ABOUT)


class Colours(harness.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.triangles, cls.lowest = scene()
        cls.vertices = [v for triangle in cls.triangles for v in triangle]
        cls.corners = [(3 * n, 3 * n + 1, 3 * n + 2) for n in range(len(cls.triangles))]
        cls.colours = pick_colours(len(cls.triangles), SEED)

    def setUp(self):
        super().setUp()
        self.mesh = self.write("coloured.ply", ply(self.vertices, self.corners, face_colours=self.colours))

    def voxelize(self, mesh, name, *options):
        out = self.path(name)
        return out, self.ask("voxelize", mesh, *GRID, "--colours", "-o", out, *options)

    def cells(self, colours):
        """What is right, of colours of triangles."""
        return {cell: colours[number] for cell, number in self.lowest.items()}

    def check(self, name, content, colours, whose):
        mesh = self.write(name, content)
        out, found = self.voxelize(mesh, "cells.vox")
        self.assertEqual(readers.palette_of(out), self.cells(colours), name)
        self.assertEqual(found["colours"], whose, name)
        said = self.ask("info", mesh, "-o", self.path("mesh.npz"))
        with np.load(self.path("mesh.npz")) as arrays:
            self.assertEqual((list(map(tuple, arrays["colours"].tolist())), said["colours"]), (list(colours), whose), name)


class Meshes(Colours):
    def test_ply_faces(self):
        for form in ("ascii", "binary_little_endian", "binary_big_endian"):
            for kind in TYPES:
                content = ply(self.vertices, self.corners, face_colours=self.colours, kind=kind, form=form)
                self.check("%s.%s.ply" % (form, kind), content, self.colours, "faces")

    def test_ply_vertices(self):
        own = pick_colours(len(self.vertices), SEED + 1)
        means = [mean([own[n] for n in corners]) for corners in self.corners]
        for form in ("ascii", "binary_little_endian"):
            for first in (False, True):
                content = ply(self.vertices, self.corners, own, form=form, faces_first=first)
                self.check("vertices.ply", content, means, "vertices")
        content = ply(self.vertices, self.corners, own, names=("diffuse_red", "diffuse_green", "diffuse_blue"))
        self.check("diffuse.ply", content, means, "vertices")
        content = ply(self.vertices, self.corners, own, self.colours, form="binary_little_endian")
        self.check("both.ply", content, self.colours, "faces")

    def test_ply_numbers_out_of_range(self):
        """Of floats: what is beyond 0 and 1 is the end, NaN is 0; a half of a byte goes up."""
        rows = [("nan", "-1", "inf"), ("2", "-0", "1e-9"), ("0.5", "0.0019", "0.00197"), ("-inf", "1", "0.999")]
        expected = [(0, 0, 255), (255, 0, 0), (128, 0, 1), (0, 255, 255)]
        content = ply(self.vertices, self.corners, face_colours=[(0, 0, 0)] * len(self.corners), kind="float").decode()
        head, body = content.split("end_header\n")
        lines = body.splitlines()
        for n in range(len(self.corners)):
            words = lines[len(self.vertices) + n].split()
            lines[len(self.vertices) + n] = " ".join(words[:4] + list(rows[n % 4]) + words[7:])
        self.check("range.ply", head + "end_header\n" + "\n".join(lines) + "\n",
                   [expected[n % 4] for n in range(len(self.corners))], "faces")

    def gltf(self, materials, own=None):
        """A file whose triangle n has material n % len(materials), and whose corners have colours `own`, as floats of light."""
        document, data = meshes.gltf_document(self.triangles, [{}])
        count, primitives = len(materials), []
        if own:
            document["bufferViews"].append({"buffer": 0, "byteOffset": len(data), "byteLength": 12 * len(own)})
            document["accessors"].append({"bufferView": 2, "componentType": 5126, "count": len(own), "type": "VEC3"})
            data += b"".join(struct.pack("<3f", *map(readers.linear, colour)) for colour in own)
        for n, material in enumerate(materials):
            corners = [c for triangle in self.corners[n::count] for c in triangle]
            document["bufferViews"].append({"buffer": 0, "byteOffset": len(data), "byteLength": 4 * len(corners)})
            document["accessors"].append({"bufferView": len(document["bufferViews"]) - 1, "componentType": 5125,
                                          "count": len(corners), "type": "SCALAR"})
            data += struct.pack("<%dI" % len(corners), *corners)
            primitives.append({"attributes": {"POSITION": 0, **({"COLOR_0": 2} if own else {})},
                               "indices": len(document["accessors"]) - 1, **({} if material is None else {"material": n})})
        document["materials"] = [{"name": "m%d" % n, **(material or {})} for n, material in enumerate(materials)]
        document["meshes"] = [{"primitives": primitives}]
        document["textures"], document["images"] = [{"source": 0}], [{"uri": "none.png"}]
        order = [n for k in range(count) for n in range(k, len(self.triangles), count)]
        return meshes.in_text(document, data), order

    def check_gltf(self, name, content, order, colours, whose):
        """Its triangles come primitive by primitive."""
        lowest = lowest_in([self.triangles[n] for n in order], ABOUT)
        out, found = self.voxelize(self.write(name, content), "cells.vox")
        self.assertEqual(readers.palette_of(out), {cell: colours[order[number]] for cell, number in lowest.items()}, name)
        self.assertEqual(found["colours"], whose, name)

    @staticmethod
    def base(colour, **more):
        return {"pbrMetallicRoughness": {"baseColorFactor": [*map(readers.linear, colour), 1], **more}}

    def test_gltf(self):
        """Light becomes bytes; materials and colours of vertices are multiplied; textures are said to be left out."""
        self.need("libassimp")
        three = pick_colours(3, SEED + 2)
        content, order = self.gltf(list(map(self.base, three)))
        count = len(self.triangles)
        self.check_gltf("materials.gltf", content, order, [three[n % 3] for n in range(count)], "materials")
        each = [colour for colour in self.colours for _ in range(3)]
        content, order = self.gltf([None], each)
        self.check_gltf("vertices.gltf", content, order, self.colours, "vertices")
        content, order = self.gltf([self.base((255, 0, 255)), self.base((255, 255, 255))], each)
        self.check_gltf("both.gltf", content, order, [(c[0], c[1] if n % 2 else 0, c[2]) for n, c in enumerate(self.colours)],
                        "vertices")
        content, _ = self.gltf([self.base(three[0]), self.base((255, 255, 255), baseColorTexture={"index": 0})])
        mesh, out = self.write("texture.gltf", content), self.path("x.vox")
        self.succeed("voxelize", mesh, *GRID, "--colours", "-q", "-o", out,
                     note="%d of %d triangles have a texture, which is not read: they are grey" % (count // 2, count))
        self.assertTrue(set(readers.palette_of(out).values()) <= {three[0], GREY})
        content, _ = self.gltf([self.base((255, 255, 255), baseColorTexture={"index": 0})])
        self.fail_with(1, "has no colours: .*not of textures", "voxelize", self.write("only.gltf", content), *GRID, "--colours",
                       "-o", out)

    def test_own_glb(self):
        """What is written is read again: the cells of a mesh of cells have their colours."""
        self.need("libassimp")
        glb, _ = self.voxelize(self.mesh, "cells.glb")
        again, found = self.voxelize(glb, "again.vox")
        self.assertEqual(found["colours"], "vertices")
        self.assertTrue(set(readers.palette_of(again).values()) <= set(self.colours))

    def test_polygons(self):
        """A polygon has one colour, also where its corners have some; lines and points have none."""
        square = [(-1.9, y, z) for y, z in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        vertices, polygons = square + self.vertices, [(0, 1, 2, 3), (0, 1), (2,), *(tuple(n + 4 for n in c) for c in self.corners)]
        triangles = [tuple(square[:3]), (square[0], square[2], square[3]), *self.triangles]
        lowest = lowest_in([tuple(tuple(map(float, map(np.float32, v))) for v in t) for t in triangles], ABOUT)
        own = pick_colours(len(vertices), SEED + 2)
        means = [mean([own[n] for n in polygon]) for polygon in polygons if len(polygon) > 2]
        out, _ = self.voxelize(self.write("polygons.ply", ply(vertices, polygons, own)), "cells.vox")
        self.assertEqual(readers.palette_of(out), {cell: means[max(number - 1, 0)] for cell, number in lowest.items()})

    def test_strips(self):
        own = pick_colours(4, SEED)
        square = [(-1.75, -1, -1), (-1.75, 1, -1), (-1.75, -1, 1), (-1.75, 1, 1)]
        colour = [(name, "uchar") for name in ("red", "green", "blue")]
        content = meshes.ply([("vertex", [*meshes.XYZ, *colour], [[*v, *c] for v, c in zip(square, own)]),
                              ("tristrips", [("vertex_indices", "int", "int")], [[[0, 1, 2, 3, -1, 3, 2, 1]]])], "ascii")
        triangles = [(0, 1, 2), (1, 2, 3), (3, 2, 1)]
        out, _ = self.voxelize(self.write("strips.ply", content), "cells.vox")
        lowest = lowest_in([tuple(square[n] for n in t) for t in triangles], ABOUT)
        self.assertEqual(readers.palette_of(out),
                         {cell: mean([own[n] for n in triangles[t]]) for cell, t in lowest.items()})

    def test_off(self):
        def off(word, vertex, face):
            lines = ["%.9g %.9g %.9g%s" % (*v, vertex(n)) for n, v in enumerate(self.vertices)]
            lines += ["3 %d %d %d%s" % (*c, face(n)) for n, c in enumerate(self.corners)]
            return "%s\n# a comment\n%d %d 0\n" % (word, len(self.vertices), len(self.corners)) + "\n".join(lines) + "\n"

        own = pick_colours(len(self.vertices), SEED + 3)
        means = [mean([own[n] for n in corners]) for corners in self.corners]
        whole, share = " %d %d %d 255", " %.6f %.6f %.6f"
        self.check("whole.off", off("OFF", lambda n: "", lambda n: whole % self.colours[n]), self.colours, "faces")
        self.check("share.off", off("OFF", lambda n: "", lambda n: share % tuple(c / 255 for c in self.colours[n])), self.colours,
                   "faces")
        self.check("vertices.off", off("COFF", lambda n: whole % own[n], lambda n: ""), means, "vertices")
        some = [colour if n % 2 else (204, 204, 204) for n, colour in enumerate(own)]
        self.check("some.off", off("COFF", lambda n: whole % own[n] if n % 2 else "", lambda n: ""),
                   [mean([some[n] for n in corners]) for corners in self.corners], "vertices")
        self.check("normals.off", off("CNOFF", lambda n: " 0 0 1" + share % tuple(c / 255 for c in own[n]), lambda n: ""), means,
                   "vertices")
        self.fail_with(1, "has no colours: ", "voxelize", self.write("none.off", off("OFF", lambda n: "", lambda n: "")), *GRID,
                       "--colours", "-o", self.path("no.vox"))


class Materials(Colours):
    """Three materials in turn, the last of them with one number and a blank in its name."""

    LIBRARY = ("# colours\r\nnewmtl red\r\nKa 0 1 0\r\nKd 1 0 0\r\nmap_Kd no.png\r\n\r\n"
               "newmtl half\nKd 0.5 0.25 0.125\nnewmtl dark one\n"
               "kd 0.2\nnewmtl red\nKd 0 0 1\nnewmtl spectral\nKd spectral file.rfl\n")
    NAMES = {"red": (255, 0, 0), "half": (128, 64, 32), "dark one": (51, 51, 51)}

    def obj(self, library="mtllib scene.mtl\n", names=tuple(NAMES), vertices=lambda n: ""):
        lines = ["v %.9g %.9g %.9g%s" % (*v, vertices(n)) for n, v in enumerate(self.vertices)]
        for n, corners in enumerate(self.corners):
            if n % 2 == 0:
                lines += ["g part%d" % n, "usemtl %s " % names[n // 2 % len(names)]]
            lines.append("f " + " ".join("%d/1" % (c - len(self.vertices)) for c in corners))
            lines.append("l 1 2")
        return library + "vt 0 0\n" + "\n".join(lines) + "\n"

    def expected(self, names):
        return [self.NAMES.get(names[n // 2 % len(names)], GREY) for n in range(len(self.corners))]

    def test_materials(self):
        """Of one library or several, with a blank in the name or a folder before it."""
        os.mkdir(self.path("sub"))
        self.write("first.mtl", "newmtl red\nKd 1 0 0\n")
        for library in ("scene.mtl", "two words.mtl", "first.mtl scene.mtl", "sub\\deep.mtl"):
            self.write(library.replace("first.mtl ", "").replace("\\", "/"), self.LIBRARY)
            self.check("scene.obj", self.obj("mtllib %s\n" % library), self.expected(tuple(self.NAMES)), "materials")

    def test_vertices(self):
        """Colours of vertices go before materials, where all corners have one."""
        self.write("scene.mtl", self.LIBRARY)
        own = pick_colours(len(self.vertices), SEED + 4)
        means = [mean([own[n] for n in corners]) for corners in self.corners]
        self.check("vertices.obj", self.obj(vertices=lambda n: " %.6f %.6f %.6f" % tuple(c / 255 for c in own[n])), means,
                   "vertices")
        some = lambda n: " %.6f %.6f %.6f" % tuple(c / 255 for c in own[n]) if n % 9 else ""
        mixed = [means[n] if all(c % 9 for c in corners) else self.expected(tuple(self.NAMES))[n]
                 for n, corners in enumerate(self.corners)]
        mesh = self.write("some.obj", self.obj(vertices=some))
        self.assertEqual(readers.palette_of(self.voxelize(mesh, "cells.vox")[0]), self.cells(mixed))

    def grey(self, name, content, pattern, names):
        mesh, out = self.write(name, content), self.path("grey.vox")
        self.succeed("voxelize", mesh, *GRID, "--colours", "-q", "-o", out, note=pattern)
        self.assertEqual(readers.palette_of(out), self.cells(self.expected(names)))

    def test_missing(self):
        self.write("scene.mtl", self.LIBRARY)
        names = ("red", "half", "absent", "red", "half", "half", "half")
        self.grey("absent.obj", self.obj(names=names),
                  "warning: .*absent.obj: material 'absent' is in none of its .mtl files: its faces are grey", names)
        names = ("red", "half", "spectral", "red", "half", "half", "half")
        self.grey("spectral.obj", self.obj(names=names), "material 'spectral' has no Kd that is a colour: its faces are grey",
                  names)
        names = tuple(self.NAMES)
        self.grey("lost.obj", self.obj("mtllib lost.mtl\nmtllib scene.mtl\n"),
                  "its materials '.*/lost.mtl' are no file that can be read", names)

    def test_none(self):
        result = harness.run("voxelize", self.write("none.obj", self.obj("mtllib none.mtl\n")), *GRID, "--colours", "-o",
                             self.path("no.vox"))
        self.assertEqual(result.code, 1)
        self.assertRegex(result.stderr,
                         r"(?s)none.mtl' are no file.*material 'red' is in none.*in all 7 lines.*"
                         r"none.obj: has no colours: .*; leave out --colours\n\Z")
        self.assertFalse(os.path.exists(self.path("no.vox")))


class Files(Colours):
    def setUp(self):
        super().setUp()
        self.expected = self.cells(self.colours)

    def test_meshes(self):
        """Every face of a cell has the colour of its cell, and there are no others."""
        for ending in readers.MESHES:
            out, _ = self.voxelize(self.mesh, "cells" + ending)
            self.assertEqual(faces_of(triangles_of(out), ABOUT), faces_expected(self.expected), ending)

    def test_merged(self):
        """Where all have one colour, there are as many triangles as without colours; else no more than a square for a face."""
        counts = []
        for colours in ([(9, 8, 7)] * len(self.corners), self.colours):
            mesh = self.write("one.ply", ply(self.vertices, self.corners, face_colours=colours))
            counts.append(len(list(triangles_of(self.voxelize(mesh, "one_cells.ply")[0]))))
        self.succeed("voxelize", self.mesh, *GRID, "-q", "-o", self.path("plain.ply"))
        head = harness.read(self.path("plain.ply")).split(b"end_header")[0].decode()
        self.assertIn("element face %d\n" % counts[0], head)
        self.assertGreater(counts[1], counts[0])

    def test_numpy(self):
        for options in ((), ("--deflate",)):
            self.assertEqual(readers.read(self.voxelize(self.mesh, "cells.npz", *options)[0], None, "colours"), self.expected)

    def test_openvdb(self):
        self.need("OpenVDB")
        (found,) = self.foreign("openvdb_colours", self.voxelize(self.mesh, "cells.vdb")[0])
        self.assertEqual({tuple(cell) for cell in found["cells"]}, set(self.expected))
        self.assertEqual({tuple(cell) for cell, _ in found["colours"]}, set(self.expected))
        for cell, colour in found["colours"]:
            for light, byte in zip(colour, self.expected[tuple(cell)]):
                self.assertAlmostEqual(light, readers.linear(byte), places=6)
        self.assertEqual(found["middle"], [o + c / 2 for o, c in zip(ABOUT["origin"], ABOUT["cell"])])

    def test_vtk(self):
        """What ParaView has: a colour for each face."""
        (found,) = self.foreign("vtk_faces", self.voxelize(self.mesh, "cells.ply")[0])
        self.assertEqual(faces_of(zip(found["faces"], found["colors"]), ABOUT), faces_expected(self.expected))

    def test_preview(self):
        """Cells of one colour, lit: pixels have its hue, those of the ground do not."""
        mesh = self.write("blue.ply", ply(self.vertices, self.corners, face_colours=[(0, 0, 255)] * len(self.corners)))
        self.voxelize(mesh, "cells.vox", "--preview", self.path("blue.png"), "--picture-size", "160x120")
        pixels = readers.read_png(self.path("blue.png")).reshape(-1, 3).tolist()
        blue = sum(p[2] > 2 * p[0] + 30 and p[2] > 2 * p[1] + 30 for p in pixels)
        self.assertGreater(blue, len(pixels) // 8)
        self.assertLess(blue, len(pixels) // 2)


class Palette(Colours):
    def check_palette(self, count):
        """A row of points with a colour each, spread over the cube of colours."""
        pick = random.Random(SEED)
        colours = [tuple(n.to_bytes(3, "big")) for n in pick.sample(range(1 << 24), count)]
        points = [(n % 200 + 0.5, n // 200 + 0.5, 0.5) for n in range(count)]
        content = ply(points, [(n, n, n) for n in range(count)], face_colours=colours, form="binary_little_endian")
        mesh, out = self.write("points.ply", content), self.path("points.vox")
        self.succeed("voxelize", mesh, "--cell", "1", "--origin", "0,0,0", "--size", "200,%d,1" % (count // 200 + 1), "--colours",
                     "-q", "-o", out, note=None if count <= 255 else "note: .*more than the 255 colours of its palette")
        found = readers.palette_of(out)
        self.assertEqual(set(found), {(n % 200, n // 200, 0) for n in range(count)})
        return [(found[n % 200, n // 200, 0], colour) for n, colour in enumerate(colours)]

    def test_as_they_are(self):
        for count in (1, 2, 254, 255):
            for found, colour in self.check_palette(count):
                self.assertEqual(found, colour)

    def test_more(self):
        """All colours of the palette are means of what they stand for, and close to it."""
        for count in (256, 257, 5000):
            pairs = self.check_palette(count)
            groups = {}
            for found, colour in pairs:
                groups.setdefault(found, []).append(colour)
            self.assertGreaterEqual(len(groups), 250)
            for found, colours in groups.items():
                self.assertEqual(found, mean(colours))
            far = sum(sum((a - b) ** 2 for a, b in zip(found, colour)) for found, colour in pairs) / len(pairs)
            self.assertLess(far ** 0.5, 40, count)


class Ways(Colours):
    def test_threads(self):
        """The same bytes by any number of threads, over many tiles; of doubles too."""
        triangles = meshes.lattice_triangles(300, seed=SEED)
        vertices = [v for t in triangles for v in t]
        corners = [(3 * n, 3 * n + 1, 3 * n + 2) for n in range(len(triangles))]
        content = ply(vertices, corners, face_colours=pick_colours(300, SEED))
        for name, text in (("floats", content),
                           ("doubles",
                            content.replace(b"0.125", b"0.12500000001").replace(b"property float x", b"property double x"))):
            mesh = self.write(name + ".ply", text)
            for word in ("npz", "ply", "glb"):
                written = set()
                for threads in ("1", "2", "7"):
                    out = self.path("%s.%s" % (threads, word))
                    self.succeed("voxelize", mesh, "--cell", "0.0154,0.2,0.2", "--origin=-2,-2,-2", "--size", "260,20,20",
                                 "--colours", "-q", "-t", threads, "-o", out)
                    written.add(harness.read(out))
                self.assertEqual(len(written), 1, (name, word))

    def test_cells_are_the_same(self):
        """Colours change no cell, and what has none is written as before."""
        _, found = self.voxelize(self.mesh, "cells.vox")
        plain = self.ask("voxelize", self.mesh, *GRID, "-o", self.path("cells.npy"))
        self.assertEqual(found["occupied"], plain["occupied"])
        self.assertNotIn("colours", plain)
        self.assertEqual(readers.places_of(self.path("cells.npy")), set(self.lowest))

    def test_no_cell(self):
        for ending in (".vox", ".npz", ".ply", ".obj", ".glb"):
            self.succeed("voxelize", self.mesh, "--cell", "1", "--origin", "50,50,50", "--size", "3,4,5", "--colours", "-q", "-o",
                         self.path("no" + ending))
        self.assertEqual(readers.palette_of(self.path("no.vox")), {})

    def test_shift(self):
        self.succeed("voxelize", self.mesh, "--shift", "1,2,3", "--cell", "0.5,0.75,0.5", "--origin=-3,-4.25,-5", "--size", "8,6,9",
                     "--colours", "-q", "-o", self.path("cells.ply"))
        self.assertEqual(faces_of(triangles_of(self.path("cells.ply")), ABOUT),
                         faces_expected(self.cells(self.colours)))


    def test_meshes_without(self):
        half = ply(self.vertices, self.corners, face_colours=self.colours, names=("red", "green", "alpha"))
        rows = [("half.ply", half), ("raw.bin", meshes.pack_floats(self.triangles), "--format", "f32"),
                *((name, write(self.triangles)) for name, write in meshes.FORMATS.items())]
        for name, content, *options in rows:
            mesh = self.write(name, content)
            self.fail_with(1, "(has no colours|no colours of its format are read): .*; leave out --colours", "voxelize", mesh,
                           *GRID, "--colours", "-o", self.path("no.vox"), *options)


if __name__ == "__main__":
    harness.main()
