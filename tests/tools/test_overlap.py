"""The answers of tribox overlap: against separating axes in whole numbers, of every mesh, box, way of testing and output."""

import contextlib
import itertools
import json
import math
import os
import re
import resource
import select
import struct
import subprocess
import threading
import time

import harness
import numpy as np
import triangles as meshes
from harness import MIB, UNIT_BOX, text_of

BLOCK = 4096  # triangles, as in tools/read/triangle_file.h
STAGES = ["none", "in file order", "ordered"]
LATTICE = meshes.lattice_triangles(200, seed=8) + [((0, 0, 0),) * 3, ((0.5, 0, 0), (0, 0.5, 0), (0, 0, 0.25)), ((-1, 0, 0),) * 3]
BOXES = [(-0.5, -0.5, -0.5, 0.5, 0.5, 0.5), (-2, -2, -2, 2, 2, 2), (-1, -2, -2, 2, 1, 2), (0, 0, 0, 0, 0, 0), (3, 3, 3, 4, 4, 4),
         (-1, 0, -0.25, 0.125, 1, 0.25), (0.5, -2, -2, 0.5, 2, 2)]
FEW = LATTICE[:40]  # repeated: near in number is not near in space, so that an order pays soon
OF_FEW = [meshes.overlapping(FEW, box) for box in BOXES]
COS, SIN = math.cos(math.sqrt(2)), math.sin(math.sqrt(2))
TURNED = (0.25, -0.125, 0, 1, 0.5, 0.25, 0.6, 0.8, 0, -0.8, 0.6, 0, 0, 0, 1)
SHEARED = (0, 0, 0, 0.5, 0.75, 1, 1, 0.25, 0, 0, 1, -0.5, 0.5, 0, 2)
ORIENTED = [TURNED, SHEARED, (0.1, 0.2, 0.3, 0.7, 0.6, 0.5, COS, SIN, 0, -SIN, COS, 0, 0, 0, -1),
            (0, 0, 0, .5, .5, .5, 1, 0, 0, 0, 1, 0, 0, 0, 1)]
FAR = meshes.far_triangles(150, seed=1)
FAR_BOXES = [(*lo, *(np.array(lo) + [0.3, 0.9, 1.5]))
             for lo in np.round(np.array(meshes.FAR) + [[-1.3, 0.1, -0.4], [0.2, -1.7, -0.5]], 1).tolist()]
# A mesh of floats in tenths, and bounds between two floats, beyond them and in places, or thinner than they are apart.
TENTHS = meshes.floats(np.random.default_rng(10).integers(0, 13, (90, 3, 3)) / 10)
NEAR, THIN = [float(np.float32(n / 10)) + step * 1e-12 for n in (2, 3, 7, 9) for step in (-1, 1)], float(np.float32(0.3)) + 1e-12
BETWEEN = [(NEAR[n], NEAR[1], NEAR[2], NEAR[5], NEAR[6], NEAR[7 - n]) for n in range(3)] + [
    (-1e300, 0.1234567890123, -1.0, 1e300, 0.6, 1e39), (1e39, 0.0, 0.0, 1e40, 1.0, 1.0), (-1e300,) * 3 + (1e300,) * 3,
    (THIN, 0.0, 0.0, THIN + 1e-12, 1.0, 1.0), (THIN, 0.0, 0.0, THIN, 1.0, 1.0), (0.1, 0.1, 0.1, 0.1000000000001, 0.6, 0.6)]

# What is asked: triangles, boxes, and the formats of the mesh; whether positions are doubles.
QUESTIONS = [(LATTICE, BOXES, ("little.ply", "raw.f32"), False), (TENTHS, BETWEEN, ("little.ply", "binary.stl", "raw.f32"), False),
             (FAR, FAR_BOXES, tuple(meshes.FORMATS_OF_DOUBLES), True), (LATTICE, ORIENTED, ("little.ply", "raw.f32"), False),
             (FAR, [(*meshes.FAR, 0.7, 0.7, 0.7, 1, 0, 0, 0, 1, 0, 0, 0, 1)], ("binary_little_endian.ply", "raw.f64"), True)]
OF_THE_TIME = ("mesh", "line", "index", "runs", "seconds", "ns_per_triangle", "total_seconds", "undecided", "positions")


def lasting(answer):
    return {key: value for key, value in answer.items() if key not in OF_THE_TIME}


class Overlap(harness.TestCase):
    def mesh(self, name, triangles):
        return self.write(name, (meshes.FORMATS_OF_DOUBLES | meshes.FORMATS)[name](triangles))


class Answers(Overlap):
    def test_exact(self):
        """Every mesh and box by every kernel, with the counts inside; and what the answer says beside it."""
        for triangles, boxes, names, is_double in QUESTIONS:
            truth = [meshes.overlapping(triangles, box) for box in boxes]
            self.assertGreater(sum(map(len, truth)), 15)
            for name in names:
                mesh = self.mesh(name, triangles)
                kernels = harness.kernels() if name == names[0] else [""]
                for (box, expected), kernel in itertools.product(zip(boxes, truth), kernels):
                    answer = self.overlap(mesh, box, *(("--kernel", kernel) if kernel else ()))
                    self.assertEqual((answer["indices"], answer["overlapping"], answer["triangles"]),
                                     (expected, len(expected), len(triangles)), (name, box, kernel))
                    self.assertEqual((answer["kernel"], answer["accuracy"]), (kernel or harness.kernels()[0], "exact"))
                    self.assertEqual((answer["positions"], answer["rounded"]), ("float64" if is_double else "float32", 0))
                    self.assertAlmostEqual(answer["share_percent"], 100 * len(expected) / len(triangles), places=3)
                    self.assertEqual((answer["not_finite"], answer["mesh"], answer["seconds"] > 0), (0, mesh, True))
                    if len(box) == 6:
                        self.assertEqual(answer["box"], {"lo": list(box[:3]), "hi": list(box[3:])})
                        counted = self.ask("overlap", mesh, "--box", text_of(box), "--inside")
                        inside = len(meshes.inside(triangles, box))
                        self.assertEqual([counted[key] for key in ("overlapping", "inside", "straddling", "missing")],
                                         [len(expected), inside, len(expected) - inside, len(triangles) - len(expected)])
                        self.assertNotIn("indices", counted)
                    else:
                        self.assertEqual(answer["oriented"], {"center": list(box[:3]), "half": list(box[3:6]),
                                                              "axes": np.reshape(box[6:], (3, 3)).tolist()})
                        self.assertNotIn("box", answer)

    def test_other_ways(self):
        """Orders change nothing; other accuracies and fewer axes find more; on a lattice of eighths floats make no error."""
        mesh, far, expected = self.mesh("little.ply", LATTICE), self.mesh("raw.f64", FAR), meshes.overlapping(LATTICE, BOXES[0])
        for kernel in harness.kernels():
            for order in ("123", "132", "213", "231", "312", "321"):
                self.assertEqual(self.overlap(mesh, BOXES[0], "--kernel", kernel, "--order", order)["indices"], expected)
            answer = self.overlap(mesh, BOXES[0], "--kernel", kernel, "--accuracy", "fast")
            self.assertEqual((answer["indices"], answer["accuracy"], answer["undecided"]), (expected, "fast", 0))
            answer = self.overlap(mesh, BOXES[0], "--kernel", kernel, "--accuracy", "conservative")
            self.assertTrue(set(expected) <= set(answer["indices"]) and answer["accuracy"] == "conservative")
        for box in (TURNED, SHEARED):
            more = self.overlap(mesh, box, "--accuracy", "conservative")["indices"]
            self.assertLessEqual(set(meshes.overlapping(LATTICE, box)), set(more))
        for more in (("--accuracy", "conservative"), ("--accuracy", "fast"), ("--axes", "box"), ("--axes", "plane,edges")):
            self.assertLessEqual(set(meshes.overlapping(FAR, FAR_BOXES[0])), set(self.overlap(far, FAR_BOXES[0], *more)["indices"]))

    def test_axes(self):
        for triangles, box, name in ((LATTICE, BOXES[0], "little.ply"), (TENTHS, BETWEEN[1], "raw.f32")):
            mesh, found, truth = self.mesh(name, triangles), {}, set(meshes.overlapping(triangles, box))
            for axes in ("box", "plane", "edges", "box,plane", "edges,box", "box,plane,edges"):
                answer = self.overlap(mesh, box, "--axes", axes)
                self.assertEqual(sorted(answer["axes"]), sorted(axes.split(",")))
                found[axes] = set(answer["indices"])
            t = np.array(triangles)
            near = np.flatnonzero(((t.min(1) <= box[3:]) & (t.max(1) >= box[:3])).all(1)).tolist()
            self.assertEqual((found["box"], found["box,plane"]), (set(near), found["box"] & found["plane"]))
            self.assertEqual((found["edges,box"], found["box,plane,edges"]), (found["box"] & found["edges"], truth))
            self.assertEqual(found["box"] & found["plane"] & found["edges"], truth)
            self.assertTrue(truth < found["box"] and truth < found["plane"] and truth < found["edges"])
            boxes = self.overlap(mesh, TURNED, "--axes", "box")["indices"]
            exact = meshes.overlapping(triangles, TURNED)
            self.assertTrue(set(exact) < set(boxes))
            self.assertEqual(self.overlap(mesh, TURNED, "--axes", "edges,plane,box")["indices"], exact)

    def test_text(self):
        mesh, expected, box = self.mesh("little.ply", LATTICE), meshes.overlapping(LATTICE, BOXES[0]), text_of(BOXES[0])
        self.assertEqual(self.succeed("overlap", mesh, "--box", box, "--list"), "".join("%d\n" % i for i in expected))
        self.assertEqual(self.succeed("overlap", mesh, "--box", "3,3,3,4,4,4", "--list"), "")
        counts = {"overlapping": len(expected), "inside": len(meshes.inside(LATTICE, BOXES[0]))}
        counts.update(straddling=counts["overlapping"] - counts["inside"], missing=len(LATTICE) - counts["overlapping"])
        for name, options in (("little.ply", ()), ("raw.f32", ("--inside",)), ("little.ply", ("--inside",))):
            mesh = self.mesh(name, LATTICE)
            text = self.succeed("overlap", mesh, "--box", box, *options)
            fields = dict(re.split(r"  +", line, maxsplit=1) for line in text.splitlines())
            self.assertEqual([fields[key] for key in ("mesh", "box", "triangles")], [mesh, UNIT_BOX, str(len(LATTICE))])
            shown = counts if options else {"overlapping": len(expected)}
            self.assertEqual({key: fields[key] for key in counts if key in fields},
                             {key: "%d (%.2f %%)" % (count, 100 * count / len(LATTICE)) for key, count in shown.items()})
            self.assertNotIn("undecided", fields)
            self.assertEqual(fields["test"], "exact, axes box,plane,edges, kernel " + harness.kernels()[0])
        self.assertRegex(fields["time"], r"^[\d.]+ m?s, [\d.]+ ns per triangle \(the test alone, best of [1-5] runs?\)$")
        self.assertRegex(self.succeed("overlap", self.mesh("raw.f64", FAR), "--box", box),
                         r"(?m)^triangles +150\npositions +float64$")
        self.assertIn("\nbox          oriented 0,0,0,0.5,0.75,1,1,0.25,0,0,1,-0.5,0.5,0,2\n",
                      self.succeed("overlap", mesh, "--oriented", text_of(SHEARED)))

    def test_decimals(self):
        """What a float gives back is that float to a mesh of floats, and the double to a mesh of doubles."""
        point = (0.1, 0.7, 557820.13)
        for name, boxes in (("little.ply", {"0.1,0.7,557820.13": [0], "0.1,0.7,557820.13000000": []}),
                            ("raw.f64", {"0.1,0.7,557820.13": [0]})):
            for text, indices in boxes.items():
                self.assertEqual(self.overlap(self.mesh(name, [(point,) * 3]), text + "," + text)["indices"], indices)


class Shift(Overlap):
    def test_subtracts(self):
        triangles = np.array(meshes.lattice_triangles(60, seed=11))
        for name in ("little.ply", "raw.f32", "binary.stl", "text.obj", "binary_little_endian.ply", "raw.f64"):
            for shift in ((0.5, -2.0, 0.125), (0.1, 1e-9, 557820.15)):
                box = (*(-0.5 - np.array(shift)), *(0.5 - np.array(shift)))
                answer = self.overlap(self.mesh(name, triangles), box, "--shift", text_of(shift))
                self.assertEqual(answer["indices"], meshes.overlapping(triangles - shift, box), name)
                self.assertEqual(answer["shift"], list(shift), name)
                self.assertEqual(answer["positions"], "float64" if shift[0] == 0.1 else "float32", name)
        x = repr(0.7 - 0.5)  # from the doubles nearest to the text, before any of it is rounded
        mesh = self.write("text.obj", "v 0.7 0 0\nv 0.7 0 0\nv 0.7 0 0\nf 1 2 3\n")
        self.assertEqual(self.overlap(mesh, "%s,0,0,%s,0,0" % (x, x), "--shift", "0.5,0,0")["indices"], [0])

    def test_auto(self):
        for offset, extent, shift in ((meshes.FAR, 20, [557800, 5108000, 800]), ((-557820.5, 3.5, -0.5), 7, [-557820, 0, 0]),
                                      ((1e7, 0.123456, 1234.5678), 0.01, [1e7, 0.12, 1234.56]), ((5, 5, 5), 0, [5, 5, 5])):
            mesh = self.mesh("raw.f64", [(offset, np.array(offset) + extent, offset)])
            self.assertEqual(self.overlap(mesh, "0,0,0,1,1,1", "--shift", "auto")["shift"], shift)
            self.assertRegex(self.succeed("overlap", mesh, "--box", UNIT_BOX, "--shift", "auto"),
                             r"(?m)^shift +%s\n" % ",".join("%.15g" % x for x in shift))


def repeated(triangles, count):
    return (triangles * (count // len(triangles) + 1))[:count]


class Boxes(Overlap):
    """--boxes: answered line by line, by an index and in another order once there are many, and no answer shows it."""

    def expected(self, which, count):
        return [i for start in range(0, count, 40) for i in (start + k for k in OF_FEW[which]) if i < count]

    def check_stages(self, answers, stages=tuple(STAGES)):
        """These, one after the other, and none of them left out."""
        seen = [answer["index"] for answer in answers]
        self.assertEqual(seen, sorted(seen, key=STAGES.index))
        self.assertEqual([stage for stage in STAGES if stage in seen], list(stages))

    def test_stages(self):
        for count, rounds, options in ((1, 20, ("--list",)), (64, 40, ("--list",)), (65, 40, ("--list",)), (500, 80, ("--list",)),
                                       (63, 40, ()), (4097, 200, ())):
            answers = self.answers(self.mesh("raw.f32", repeated(FEW, count)), BOXES * rounds, *options)
            self.check_stages(answers)
            self.assertEqual([answer["line"] for answer in answers], list(range(1, rounds * len(BOXES) + 1)))
            lists = [self.expected(which, count) for which in range(len(BOXES))]
            for at, answer in enumerate(answers):
                due = lists[at % len(BOXES)]
                self.assertEqual((answer["overlapping"], answer["triangles"], answer.get("indices", due)),
                                 (len(due), count, due), (at, answer["index"]))

    def test_doubles(self):
        """Far from zero, where floats would see all in one place; and floats against bounds of doubles and of floats."""
        far = np.array(repeated(FEW, 500)) + 2.0 ** 30
        answers = self.answers(self.mesh("raw.f64", far), [[x + 2.0 ** 30 for x in box] for box in BOXES] * 80, "--list")
        self.check_stages(answers)
        for at, answer in enumerate(answers):
            self.assertEqual((answer["indices"], answer["positions"]),
                             (self.expected(at % len(BOXES), 500), "float64"), (at, answer["index"]))
        boxes = [*BETWEEN, (0, 0, 0, 0.5, 0.5, 0.5), (0.25, 0.25, 0, 1, 1, 1)]
        lists = [meshes.overlapping(TENTHS, box) for box in boxes]
        for more in (("--list",), ()):
            answers = self.answers(self.mesh("raw.f32", TENTHS), boxes * 40, *more)
            self.check_stages(answers)
            for at, answer in enumerate(answers):
                due = lists[at % len(boxes)]
                self.assertEqual((answer["overlapping"], answer.get("indices", due)), (len(due), due), (at, answer["index"]))

    def test_every_way(self):
        """Whatever is asked, the answer is the same before and after, and that about one box."""
        triangles = np.random.default_rng(3).uniform(-2, 2, (700, 3, 3))
        triangles[[17, 18, 699]] = ((0, 0, 0), (1, meshes.NAN, 0), (0, meshes.INF, 0))
        path, linear = self.mesh("raw.f32", triangles), [("--accuracy", "fast"), ("--axes", "plane,edges")]
        indexed = [("--accuracy", "conservative"), ("--axes", "box"), ("--axes", "box,edges"), ("--order", "321"),
                   *(("--kernel", kernel) for kernel in harness.kernels())]
        note = "3 of 700 triangles have NaN"
        for way in indexed + linear:
            answers = self.answers(path, BOXES * 60, "--list", *way, note=note)
            self.check_stages(answers, STAGES if way in indexed else STAGES[:1])
            for which, box in enumerate(BOXES):
                one = lasting(self.overlap(path, box, *way, note=note))
                for answer in answers[which::len(BOXES)]:
                    self.assertEqual(lasting(answer), one, way)
        answers = self.answers(path, BOXES * 60, "--inside", note=note)
        self.check_stages(answers, STAGES[:1])
        inside = [len(meshes.inside(meshes.floats(triangles), box)) for box in BOXES]
        self.assertEqual([answer["inside"] for answer in answers], inside * 60)

    def test_threads(self):
        """Of so many triangles that threads share the order and the index; those without a place come last in it."""
        pick = np.random.default_rng(7)
        triangles = (pick.uniform(-2, 2, (40001, 1, 3)) + pick.uniform(-0.1, 0.1, (40001, 3, 3))).astype(np.float32).astype(float)
        triangles[33000, 0, 0] = meshes.NAN
        boxes = [(x, y, -2, x + 0.01, y + 0.01, 2) for x in (-1, 0, 1) for y in (-1, 0, 1)] * 50
        for name, first in (("raw.f32", 0), ("raw.f64", 1e-12)):
            triangles[0, 0, 0] += first
            mesh = self.mesh(name, triangles)
            found = [self.answers(mesh, boxes, "--list", "-t", t, note="1 of 40001") for t in ("1", "2", "3", "200")]
            self.check_stages(found[0])
            for other in found:
                self.assertEqual([answer["indices"] for answer in other], [answer["indices"] for answer in found[0]])

    def test_text(self):
        for name, end, options in (("raw.f32", r"[\d.]+ (ns per triangle|us by an index)", ()),
                                   ("little.ply", r"%d inside, [\d.]+ ns per triangle", ("--inside",))):
            text = self.succeed("overlap", self.mesh(name, LATTICE), "--boxes", "-", *options,
                                stdin="".join(text_of(b) + "\n" for b in BOXES * 20).encode())
            self.assertEqual(len(text.splitlines()), 20 * len(BOXES))
            for box, line in zip(BOXES * 20, text.splitlines()):
                count = len(meshes.overlapping(LATTICE, box)) if text.index(line) < 2000 else int(line.split()[1])
                self.assertRegex(line, "^%s: %d of 203 triangles overlap \\(%.2f %%\\), %s$" % (
                    ",".join("%g" % b for b in box), count, 100 * count / 203,
                    end % len(meshes.inside(LATTICE, box)) if options else end))
            self.assertEqual("us by an index" in text, not options)

    def test_forms(self):
        for lines, at in ((b"# a comment\n\n  \t\n0,0,0,1,1,1\n 0, 0, 0  1 1\t1 # the same\r\n0 0 0 1 1 1#\n\r\n"
                           b"#0 0 0\n0 ,0 ,0 ,1 ,1 ,1", [4, 5, 6, 9]),
                          (b"0 0 0 1 1 1 #" + b"x" * 3000000 + b"\n0 0 0 1 1 1\n", [1, 2])):
            answers = self.answers(self.mesh("raw.f32", FEW), lines)
            self.assertEqual([answer["line"] for answer in answers], at)
            self.assertEqual(len({answer["overlapping"] for answer in answers}), 1)

    def test_notes(self):
        mesh, empty = self.mesh("raw.f32", FEW), self.write("boxes.txt", "0 0 0 1 1 1\n0 0 9 1 1 -1\n")
        text = self.succeed("overlap", mesh, "--boxes", empty, "--json",
                            note="note: .*boxes.txt:2: the lower bound 9 exceeds the upper bound -1 on the z axis")
        self.assertEqual(json.loads(text.splitlines()[1])["overlapping"], 0)
        for content in ("", "# nothing\n\n"):
            path = self.write("none", content)
            self.assertEqual(self.succeed("overlap", mesh, "--boxes", path, note="note: .*none: there is no box in it"), "")

    def test_wrong_lines(self):
        """The boxes before it are answered, few or many; then one line names the place."""
        mesh = self.mesh("raw.f32", FEW)
        for line, pattern in ((b"0 0 0 1 1", "5 numbers where 6 are needed"), (b"0 " * 5000, "the line is too long"),
                              (b"0 0 0 1 1 inf", r"'inf' \(number 6 of 6\) is not finite"),
                              (b"0 0 0 1 1 1\0", "a NUL byte, so this is not a text file")):
            for count in (1, 200):
                path = self.write("boxes.txt", b"0 0 0 1 1 1\n" * count + b"# two\n" + line + b"\n0 0 0 1 1 1\n")
                result = harness.run("overlap", mesh, "--boxes", path)
                self.assertEqual((result.code, len(result.stdout.splitlines())), (1, count))
                self.assert_one_line(result.stderr, r"^tribox overlap: [^\n]*boxes\.txt:%d: " % (count + 2) + pattern)
        self.fail_with(1, "stdin:1: 1 number where 6", "overlap", mesh, "--boxes", "-", stdin=b"7\n")
        self.fail_with(1, "missing: cannot open the boxes file: No such file", "overlap", mesh, "--boxes", "missing")
        self.fail_with(1, "cannot (open|read) the boxes( file)?: ", "overlap", mesh, "--boxes", self.folder)

    def test_streaming(self):
        """Each box is answered before the next is sent, with an index too."""
        seen = set()
        mesh = self.mesh("raw.f32", repeated(FEW, 500))
        with harness.start("overlap", mesh, "--boxes", "-", "--json", "--list",
                           stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0) as process:
            for at in range(400):
                os.write(process.stdin.fileno(), text_of(BOXES[at % len(BOXES)]).encode() + b"\n")
                self.assertTrue(select.select([process.stdout], [], [], 60)[0], "no answer within a minute")
                answer = json.loads(process.stdout.readline())
                self.assertEqual((answer["indices"], answer["line"]), (self.expected(at % len(BOXES), 500), at + 1))
                seen.add(answer["index"])
            process.stdin.close()
        self.assertEqual((process.returncode, seen), (0, set(STAGES)))

    @harness.unless_sanitized
    def test_no_room_for_an_order(self):
        """A million triangles take 36 MB, an index over them 0.4, and an order as much again as the triangles."""
        kind, beside = self.need_limit(resource.RLIMIT_AS, 48 * MIB)
        path = self.write("many.f32", meshes.pack_floats(FEW) * 25000)
        whole, short = (self.answers(path, [(-1.01, -1.03, -1.02, 1.04, 1.05, 1.06)] * 100, limit=limit)
                        for limit in (None, (kind, beside + 36000000)))
        self.assertEqual([answer["overlapping"] for answer in short], [answer["overlapping"] for answer in whole])
        self.check_stages(whole)
        self.check_stages(short, STAGES[:2])


class Streams(Overlap):
    """Binary STL and raw triangles, read in blocks: the answers of a mesh in one piece, from files, pipes and standard input."""

    PACKED = {"stl": meshes.stl_binary, "f32": meshes.pack_floats, "f64": meshes.pack_doubles}
    TRIANGLES = meshes.lattice_triangles(2 * BLOCK + 70, seed=6)

    def check(self, triangles, *way, box=BOXES[0], note=None):
        """Those of the mesh as PLY, however it comes; the place that a note names is the file's."""
        whole = lasting(self.overlap(self.mesh("little.ply", triangles), box, *way, note=note))
        if "--axes" not in way:
            self.assertEqual(whole["indices"], meshes.overlapping(meshes.floats(triangles), box))
        for form, pack in self.PACKED.items():
            packed = pack(triangles if form != "f64" else meshes.floats(triangles))
            path = self.write("mesh." + form, packed)
            for answer in (self.overlap(path, box, *way, note=note),
                           self.overlap("-", box, "--format", form, *way, note=note, stdin=packed),
                           self.answers(path, [box], "--list", *way, note=note)[0]):
                self.assertEqual(lasting(answer), whole, (len(triangles), form))
            text = self.succeed("overlap", "-", "--format", form, "--box", text_of(box), "--list", *way, note=note, stdin=packed)
            self.assertEqual(text, "".join("%d\n" % i for i in whole["indices"]))

    def test_same_as_in_one_piece(self):
        for count in (1, 2, 63, 64, 65, 129, BLOCK - 1, BLOCK, BLOCK + 1, 2 * BLOCK, 2 * BLOCK + 1, 2 * BLOCK + 70):
            self.check(self.TRIANGLES[:count])
        ways = [("--axes", "box,plane"), ("--accuracy", "fast"), ("--order", "213")]
        for way in [("--kernel", kernel) for kernel in harness.kernels()] + ways:
            self.check(self.TRIANGLES, *way)

    def test_all_floats(self):
        """Of all bits, with what is not finite counted from the first block to the last."""
        bits = np.random.default_rng(7).integers(0, 1 << 32, (2 * BLOCK + 5, 3, 3), np.uint32)
        wild = bits.view(np.float32)
        first = BLOCK + 5 + int(np.flatnonzero(~np.isfinite(wild).all((1, 2)))[0])
        triangles = np.concatenate([np.array(self.TRIANGLES[:BLOCK + 5], np.float32), wild])
        for rows, number in ((wild, first - BLOCK - 5), (triangles, first)):
            self.check(rows, box=(-1, -1, -1, 1e20, 1e20, 1e20),
                       note="warning: .*: [0-9]+ of %d triangles have NaN or infinite coordinates and overlap nothing; "
                            "the first is number %d$" % (len(rows), number))

    def test_summary(self):
        packed = meshes.stl_binary(self.TRIANGLES)
        text = self.succeed("overlap", "-", "--format", "stl", "--box", UNIT_BOX, stdin=packed)
        self.assertRegex(text, r"\Amesh         -\nbox          %s\ntriangles    %d\n" % (UNIT_BOX, len(self.TRIANGLES)))
        self.assertRegex(text, r"(?m)^time +[\d.]+ m?s, [\d.]+ ns per triangle "
                               r"\(the test alone, in blocks; with reading the mesh [\d.]+ m?s\)$")
        answer = self.ask("overlap", "-", "--format", "stl", "--box", UNIT_BOX, stdin=packed)
        self.assertEqual((answer["runs"], "indices" in answer, 0 < answer["seconds"] < answer["total_seconds"]), (1, False, True))

    def test_format_wins_over_the_name(self):
        for form, name in itertools.product(("stl", "f32"), ("mesh", "mesh.ply", "mesh.stl", "mesh.f32")):
            path = self.write(name, self.PACKED[form](self.TRIANGLES[:99]))
            self.assertEqual(self.overlap(path, UNIT_BOX, "--format", form)["triangles"], 99)
            self.assertEqual(self.answers(path, BOXES[:1], "--format", form)[0]["triangles"], 99)

    @contextlib.contextmanager
    def fed(self, path, content):
        """Meanwhile another thread writes into the fifo."""
        def feed():
            with open(path, "wb") as file:
                file.write(content)
        thread = threading.Thread(target=feed, daemon=True)
        thread.start()
        yield path
        thread.join(60)

    def test_fifo(self):
        path = self.path("fifo")
        os.mkfifo(path)
        for form in ("stl", "f32"):
            with self.fed(path, self.PACKED[form](self.TRIANGLES)):
                self.assertEqual(self.overlap(path, UNIT_BOX, "--format", form)["triangles"], len(self.TRIANGLES))
            with self.fed(path, self.PACKED[form](self.TRIANGLES)):
                self.assertEqual(self.answers(path, BOXES[:1], "--format", form)[0]["triangles"], len(self.TRIANGLES))
        for question in (("--boxes", "-"), ("--box", UNIT_BOX)):
            with self.fed(path, b""):
                self.fail_with(1, "fifo: contains no triangles", "overlap", path, "--format", "f32", *question)

    def test_printed_as_they_come(self):
        """The numbers of a block are there before the next block is sent."""
        block = bytes(36 * (BLOCK - 1)) + struct.pack("<9f", *[9] * 9)
        with harness.start("overlap", "-", "--format", "f32", "--box", "0,0,0,0,0,0", "--list",
                           stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0) as process:
            for i in range(3):
                process.stdin.write(block)
                for number in range(i * BLOCK, (i + 1) * BLOCK - 1):
                    self.assertTrue(select.select([process.stdout], [], [], 60)[0], "no answer within a minute")
                    self.assertEqual(process.stdout.readline(), b"%d\n" % number)
            process.stdin.close()
            self.assertEqual(process.stdout.read(), b"")
        self.assertEqual(process.returncode, 0)

    def test_ends_when_the_list_is_lost(self):
        for more in ((), ("--json",)):
            with open("/dev/full", "wb") as full, open("/dev/zero", "rb") as zeros:
                result = harness.run("overlap", "-", "--format", "f32", "--box", "0,0,0,0,0,0", "--list", *more,
                                     stdin=zeros, stdout=full)
            self.assertEqual(result.code, 1)
            self.assert_one_line(result.stderr, "cannot write the output: ")

    def test_progress(self):
        """A bar for a stream that knows its length and takes its time; gone in the end."""
        packed = meshes.stl_binary(self.TRIANGLES)

        def feed(process):
            process.stdin.write(packed[:84 + 50 * BLOCK])
            process.stdin.flush()
            time.sleep(0.9)
            process.communicate(packed[84 + 50 * BLOCK:])
        said = self.on_terminal("overlap", "-", "--format", "stl", "--box", UNIT_BOX, stdin=subprocess.PIPE, meanwhile=feed)
        self.assertRegex(said, r"\rtesting \[#+\.*\] +\d+ %")
        self.assertTrue(said.endswith("\r" + " " * 79 + "\r"))

    def test_cut(self):
        """No summary, and a line that says where."""
        def cut(form, content, pattern, *more):
            self.fail_with(1, "^tribox overlap: stdin: %s$" % pattern,
                           "overlap", "-", "--format", form, "--box", UNIT_BOX, *more, stdin=content)
        whole = meshes.stl_binary(self.TRIANGLES, b"")
        for count, form in itertools.product((0, 1, BLOCK - 1, BLOCK, 2 * BLOCK), ("f32", "f64", "stl")):
            size, packed = {"f32": 36, "f64": 72, "stl": 50}[form], self.PACKED[form](self.TRIANGLES)
            for rest in (1, 17, size - 1) + (0,) * (form == "stl"):
                cut(form, packed[:84 * (form == "stl") + size * count + rest],
                    "truncated: %d %striangles were read, then it ends with %d of %d bytes of the next; write it again" %
                    (count, "of %d promised " % len(self.TRIANGLES) * (form == "stl"), rest, size), "--json")
        for size in (1, 79, 80, 83):
            cut("stl", whole[:size].replace(b" ", b"\0"),
                "truncated, or not an STL file: it has %d bytes, but the header alone of a binary one has 84.*" % size)
        for count, more in itertools.product((1, BLOCK, BLOCK + 1), (b"\0", bytes(50), bytes(5000))):
            cut("stl", meshes.stl_binary(self.TRIANGLES[:count]) + more,
                "has bytes after the %d triangles that its header promises; write it again" % count)
        for count in (2 ** 31, 2 ** 32 - 1):
            cut("stl", bytes(80) + struct.pack("<I", count) + bytes(500),
                "truncated: 10 of %d promised triangles were read.*" % count)
        pattern = "is text, and only binary STL can be streamed; give it as a file named .stl, without --format"
        for content in (meshes.stl_ascii(self.TRIANGLES[:3]), b"solid empty\nendsolid empty\n",
                        "solid \u00fcber\n".encode() * 9, b"hello\n"):
            cut("stl", content, pattern)
        cut("stl", meshes.ply_of(self.TRIANGLES[:3]), "not an STL file: it begins with 'ply'; give --format ply")
        text = self.write("text.stl", "hello\n")
        self.fail_with(1, "text.stl: " + pattern, "overlap", text, "--format", "stl", "--box", UNIT_BOX)
        cut("stl", b"", "the file is empty.*")
        cut("f32", b"", "contains no triangles.*")
        cut("stl", bytes(84), "contains no triangles.*", "--json", "--list")
        self.fail_with(1, "stdin: truncated: %d triangles were read" % BLOCK, "overlap", "-", "--format", "f32", "--box",
                       "0,0,0,0,0,0", "--list", stdin=bytes(36 * BLOCK + 1), stdout_is="".join("%d\n" % i for i in range(BLOCK)))

    def test_read_error(self):
        for form in ("stl", "f32"):
            self.fail_with(1, "/dev/null: (the file is empty|contains no triangles)",
                           "overlap", "/dev/null", "--format", form, "--box", UNIT_BOX)
            folder = os.open(self.folder, os.O_RDONLY)
            self.fail_with(1, "stdin: cannot read the mesh( after 0 triangles)?: Is a directory",
                           "overlap", "-", "--format", form, "--box", UNIT_BOX, stdin=folder)
            os.close(folder)

    def test_memory(self):
        """Three million triangles, 108 MB, in 64 MiB of addresses: by blocks; for more than one box all have to be there."""
        limit, triangles = self.need_limit(resource.RLIMIT_AS, 64 * MIB), self.TRIANGLES[:5000]
        overlapping = len(meshes.overlapping(triangles, BOXES[0]))
        for form, head, block in (("f32", b"", meshes.pack_floats(triangles)),
                                  ("stl", bytes(80) + struct.pack("<I", 3000000), meshes.stl_binary(triangles)[84:])):
            answer = self.ask("overlap", "-", "--format", form, "--box", UNIT_BOX, stdin=head + block * 600, limit=limit)
            self.assertEqual((answer["triangles"], answer["overlapping"]), (3000000, 600 * overlapping))
        path = self.write("zeros.f32", b"")
        os.truncate(path, 36 * 3000000)
        answer = self.ask("overlap", path, "--box", UNIT_BOX, limit=limit)
        self.assertEqual((answer["triangles"], answer["overlapping"]), (3000000, 3000000))
        self.fail_with(1, "zeros.f32: out of memory for 3000000 triangles; to voxelize it, sort it first: "
                       "tribox partition .*zeros.f32 -o NAME.tiles, with the same grid",
                       "overlap", path, "--boxes", "-", limit=limit)


if __name__ == "__main__":
    harness.main()
