"""--boxes with very many boxes: an index is built and the mesh is put in order on the way, and no answer shows it."""

import array
import json
import os
import random
import resource
import select
import subprocess

import meshes
import support

# The first of these are repeated, so that exact clipping knows all answers; in this order triangles that are near in number are not
# near in space, so that an order pays soon.
PERIOD = 40
LATTICE = meshes.lattice_triangles(PERIOD, seed=9)
BOXES = [(-0.5, -0.5, -0.5, 0.5, 0.5, 0.5), (0, 0, 0, 2, 2, 2), (-1, -2, -2, 0.125, 0, 2), (1.5, 1.5, 1.5, 1.5, 1.5, 1.5),
         (0.5, -2, -2, 0.5, 2, 2), (0, 0, 0, -1, 1, 1), (5, 5, 5, 6, 6, 6), (-2, -2, -2, 2, 2, 2)]
EXACT = [meshes.overlapping(LATTICE, box) for box in BOXES]
STAGES = ["none", "in file order", "ordered"]
OF_THE_TIME = ("line", "index", "runs", "seconds", "ns_per_triangle", "total_seconds", "undecided")


def as_line(box):
    return ",".join(map(str, box))


def repeated(count):
    return (LATTICE * (count // PERIOD + 1))[:count]


def expected(which, count):
    return [i for start in range(0, count, PERIOD) for i in (start + k for k in EXACT[which]) if i < count]


class Index(support.TestCase):
    def answers(self, path, rounds, *options):
        """Of all boxes in turn, so many times."""
        lines = "".join(as_line(box) + "\n" for box in BOXES) * rounds
        result = support.run("overlap", path, "--boxes", "-", "--json", *options, stdin=lines.encode())
        self.assertEqual(result.code, 0, result.stderr)
        found = [json.loads(line) for line in result.stdout.splitlines()]
        self.assertEqual([a["line"] for a in found], list(range(1, rounds * len(BOXES) + 1)))
        return found

    def check_stages(self, answers, stages):
        """These, one after the other, and none of them left out."""
        seen = [a["index"] for a in answers]
        self.assertEqual(seen, sorted(seen, key=STAGES.index))
        self.assertEqual([stage for stage in STAGES if stage in seen], stages)

    def test_lists(self):
        for count, rounds in ((1, 20), (64, 40), (65, 40), (500, 80)):
            answers = self.answers(self.write("mesh.f32", meshes.pack_floats(repeated(count))), rounds, "--list")
            self.check_stages(answers, STAGES)
            lists = [expected(which, count) for which in range(len(BOXES))]
            for at, answer in enumerate(answers):
                self.assertEqual(answer["indices"], lists[at % len(BOXES)], (count, at, answer["index"]))
                self.assertEqual((answer["overlapping"], answer["triangles"]), (len(answer["indices"]), count))

    def test_counts(self):
        for count, rounds in ((63, 40), (4097, 200)):
            answers = self.answers(self.write("mesh.f32", meshes.pack_floats(repeated(count))), rounds)
            self.check_stages(answers, STAGES)
            counts = [len(expected(which, count)) for which in range(len(BOXES))]
            self.assertEqual([a["overlapping"] for a in answers], counts * rounds)

    def small_lists(self, path, threads):
        lines = "".join(as_line((x, y, -2, x + 0.01, y + 0.01, 2)) + "\n" for x in (-1, 0, 1) for y in (-1, 0, 1)) * 50
        result = support.run("overlap", path, "--boxes", "-", "--json", "--list", "--threads", str(threads), stdin=lines.encode())
        answers = [json.loads(line) for line in result.stdout.splitlines()]
        self.check_stages(answers, STAGES)
        return [a["indices"] for a in answers]

    def test_threads(self):
        """Of so many triangles that threads share the order and the index; those without a place come last in it."""
        pick = random.Random(7)
        numbers = array.array("f", ())
        for _ in range(40001):
            place = [pick.uniform(-2, 2) for _ in range(3)]
            numbers.extend(place[n % 3] + pick.uniform(-0.1, 0.1) for n in range(9))
        numbers[9 * 33000] = float("nan")
        doubles = array.array("d", numbers)
        doubles[1] += 1e-12
        for path in (self.write("mesh.f32", numbers.tobytes()), self.write("mesh.f64", doubles.tobytes())):
            lists = [self.small_lists(path, threads) for threads in (1, 2, 3, 200)]
            self.assertEqual(lists[1:], 3 * lists[:1])

    def test_doubles(self):
        """Far from zero, where floats would see all triangles in one place."""
        far = 2.0**30
        count, rounds = 500, 80
        numbers = array.array("d", (x + far for triangle in repeated(count) for vertex in triangle for x in vertex))
        path = self.write("mesh.f64", numbers.tobytes())
        lines = "".join(",".join(repr(bound + far) for bound in box) + "\n" for box in BOXES) * rounds
        result = support.run("overlap", path, "--boxes", "-", "--json", "--list", stdin=lines.encode())
        self.assertEqual(result.code, 0, result.stderr)
        answers = [json.loads(line) for line in result.stdout.splitlines()]
        self.check_stages(answers, STAGES)
        for at, answer in enumerate(answers):
            self.assertEqual(answer["indices"], expected(at % len(BOXES), count), (at, answer["index"]))
            self.assertEqual(answer["positions"], "float64")

    def test_every_way_of_testing(self):
        """Whatever is asked, the answer is the same before and after, and that about one box."""
        pick = random.Random(3)
        triangles = [tuple(tuple(pick.uniform(-2, 2) for _ in range(3)) for _ in range(3)) for _ in range(700)]
        triangles[17] = triangles[18] = triangles[699] = ((0, 0, 0), (1, float("nan"), 0), (0, float("inf"), 0))
        path = self.write("mesh.f32", meshes.pack_floats(triangles))
        kernels = json.loads(self.succeed("info", "--json"))["kernels"]
        indexed = [("--accuracy", "conservative"), ("--axes", "box"), ("--axes", "box,edges"), ("--order", "321"),
                   *(("--kernel", kernel) for kernel in kernels)]
        linear = [("--accuracy", "fast"), ("--axes", "plane,edges")]
        for way in indexed + linear:
            with self.subTest(way=way):
                answers = self.answers(path, 60, "--list", *way)
                self.check_stages(answers, STAGES if way in indexed else STAGES[:1])
                for which, box in enumerate(BOXES):
                    one = json.loads(support.run("overlap", path, "--box", as_line(box), "--json", "--list", *way).stdout)
                    for answer in answers[which::len(BOXES)]:
                        self.assertEqual({key: answer[key] for key in answer if key not in OF_THE_TIME},
                                         {key: one[key] for key in one if key not in OF_THE_TIME})
        self.check_stages(self.answers(path, 60, "--inside"), STAGES[:1])

    def test_text(self):
        path = self.write("mesh.f32", meshes.pack_floats(repeated(300)))
        text = self.succeed("overlap", path, "--boxes", "-", stdin="".join(as_line(box) + "\n" for box in BOXES[:5]).encode() * 20)
        for at, line in enumerate(text.splitlines()):
            count = len(expected(at % 5, 300))
            start = "%s: %d of 300 triangles overlap (%.2f %%), " % (",".join("%g" % b for b in BOXES[at % 5]), count, count / 3)
            self.assertEqual(line[:len(start)], start)
            self.assertRegex(line[len(start):], r"^\d+ undecided, [\d.]+ (ns per triangle|us by an index)$")
        self.assertIn("us by an index", text.splitlines()[-1])

    def test_streaming(self):
        """With an index, too, each box is answered before the next is sent."""
        path = self.write("mesh.f32", meshes.pack_floats(repeated(500)))
        seen = set()
        process = subprocess.Popen([support.program(), "overlap", path, "--boxes", "-", "--json", "--list"], stdin=subprocess.PIPE,
                                   stdout=subprocess.PIPE, bufsize=0)
        with process:
            for at in range(400):
                os.write(process.stdin.fileno(), as_line(BOXES[at % 5]).encode() + b"\n")
                ready, _, _ = select.select([process.stdout], [], [], 60)
                self.assertTrue(ready, "no answer within a minute")
                answer = json.loads(process.stdout.readline())
                self.assertEqual(answer["indices"], expected(at % 5, 500))
                seen.add(answer["index"])
            process.stdin.close()
        self.assertEqual((process.returncode, seen), (0, set(STAGES)))

    def test_wrong_line(self):
        """After very many boxes a wrong one ends the run as the first does."""
        path = self.write("mesh.f32", meshes.pack_floats(repeated(300)))
        boxes = self.write("boxes.txt", (as_line(BOXES[0]) + "\n") * 200 + "0 0 0 1 1\n")
        result = support.run("overlap", path, "--boxes", boxes)
        self.assertEqual((result.code, len(result.stdout.splitlines())), (1, 200))
        self.assert_one_line(result.stderr, r"boxes\.txt:201: 5 numbers where 6 are needed")


@support.unless_sanitized
class Memory(support.TestCase):
    """A million triangles take 36 MB, an index over them 0.4, and an order as much again as the triangles."""

    def test_no_room_for_an_order(self):
        beside = 48 << 20
        if support.run("info", limit=(resource.RLIMIT_AS, beside)).code:
            self.skipTest("this build needs more than 48 MiB of addresses by itself")
        count = 1000000 // PERIOD * PERIOD
        path = self.write("many.f32", meshes.pack_floats(LATTICE) * (count // PERIOD))
        boxes = "-1.01,-1.03,-1.02,1.04,1.05,1.06\n" * 100
        whole, short = (support.run("overlap", path, "--boxes", "-", "--json", stdin=boxes.encode(), limit=limit)
                        for limit in (None, (resource.RLIMIT_AS, beside + 36 * count)))
        self.assertEqual((whole.code, short.code, short.stderr), (0, 0, whole.stderr))
        whole, short = ([json.loads(line) for line in result.stdout.splitlines()] for result in (whole, short))
        self.assertEqual([a["overlapping"] for a in short], [a["overlapping"] for a in whole])
        self.assertEqual({a["index"] for a in whole}, set(STAGES))
        self.assertEqual({a["index"] for a in short}, set(STAGES[:2]))


if __name__ == "__main__":
    support.main()
