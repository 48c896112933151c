"""An example of an engine gives the cells of one process, or an error and no cells: test_engine.py ENGINE [--seed N]"""

import argparse
import os
import random
import re
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import faults
import runs

LIMIT = 120  # seconds that a run may take


class Engines(unittest.TestCase):
    name = None  # of the engine

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.engine = runs.engine_of(cls.name, folder.name, *runs.ENGINES[cls.name].suits)

    def setUp(self):
        self.engine.clear()
        self.log = tempfile.TemporaryFile("w+")
        self.addCleanup(self.log.close)

    def run_once(self, **options):
        """How a run ended, and what it printed."""
        self.log.seek(0)
        self.log.truncate()
        how, killed, _ = faults.run(self.engine, LIMIT, self.log, **options)
        self.log.seek(0)
        return how, killed, self.log.read()

    def left(self):
        """What a run left beside its answer."""
        return [name for name in os.listdir(self.engine.case.folder) if name.startswith(self.engine.out)]

    def test_right(self):
        for workers in self.engine.numbers:
            self.engine.clear()
            self.engine.workers = workers
            how, _, said = self.run_once()
            self.assertEqual(how, "right", said)
            self.assertEqual(self.left(), [self.engine.out])

    def test_ids(self):
        """The lowest triangle of each cell is that of one process."""
        self.engine.has_ids = True
        self.addCleanup(setattr, self.engine, "has_ids", False)
        how, _, said = self.run_once()
        self.assertEqual(how, "right", said)

    def test_there_already(self):
        """What there is under the name is not touched."""
        os.mkdir(self.engine.path)
        process = runs.start(self.engine, LIMIT, self.log)
        self.assertNotEqual(process.wait(LIMIT + runs.GRACE), 0)
        self.assertEqual((self.left(), os.listdir(self.engine.path)), ([self.engine.out], []))

    def test_other_command(self):
        """What a failed run left is taken by the same command alone."""
        runs.shards.take_up(self.engine.jobs, self.engine.case.path, 7)
        how, _, said = self.run_once()
        self.assertEqual(how, "error", said)
        self.assertIn("jobs is of another command", said)

    def test_no_mesh(self):
        """What is no mesh, or not there, is said in one line, with no traceback; and how far a run is in lines of their own."""
        case, path = self.engine.case, self.engine.case.path
        self.addCleanup(setattr, case, "path", path)
        for name, content, why in (("none.ply", None, "none.ply: No such file"), ("bad.ply", b"x\n", "bad.ply: not a PLY file")):
            case.path = os.path.join(case.folder, name)
            if content:
                with open(case.path, "wb") as file:
                    file.write(content)
            for self.engine.workers in self.engine.numbers:
                self.engine.clear()
                how, _, said = self.run_once()
                self.assertEqual(how, "error", said)
                self.assertEqual(said.count(why), 1, said)
                if self.engine.name == "dask":
                    said = re.sub(r"(?m)^\S+ \S+ - distributed\.\S+ - INFO - .*\n", "", said)  # of what killed workers left
                    self.assertRegex(said, r"\A[^\n]*%s[^\n]*\n(sort: 1 of 1\n)?\Z" % why)

    def test_sorted_twice(self):
        """Whoever sorts a mesh that another has sorted meanwhile takes it as it is; a failure is one where it is not there."""
        mesh, jobs = self.engine.case.path, self.engine.jobs
        os.mkdir(jobs)
        self.assertRaises(subprocess.CalledProcessError, runs.shards.sort, mesh, 0, jobs)
        runs.shards.sort(mesh, 9, jobs)
        with unittest.mock.patch("os.path.exists", side_effect=[False, True]):
            runs.shards.sort(mesh, 9, jobs)

    def test_damaged(self):
        """What a task refuses ends the run, and says why."""
        self.engine.damage()
        how, _, said = self.run_once()
        self.assertEqual(how, "error", said)
        self.assertRegex(said, "damaged: the checksum")

    def test_limit(self):
        """A run that takes longer than it may ends, and without an answer unless it had just written it."""
        process = runs.start(self.engine, 1, self.log)
        self.assertIn(faults.outcome(self.engine, process, runs.GRACE), ("error", "right"))

    def test_killed(self):
        self.kill(random.Random(self.seed), False)

    def test_all_killed(self):
        self.kill(random.Random(self.seed + 1), True)

    def kill(self, pick, kills_all):
        """The same command again is right after an error."""
        how, killed, said = self.run_once(moment=pick.uniform(0, 3), pick=pick, kills_all=kills_all)
        when = f"{killed[1]} killed at {killed[0]:.2f} s" if killed else "not killed"
        print(f"{self.name}: {when}: {how}, {len(self.engine.lies())} files", file=sys.stderr)
        self.assertIn(how, ("right", "error"), said)
        if how == "error":
            self.assertIsNotNone(killed, said)
            self.assertEqual(self.run_once()[0], "right")


def main():
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("engine", choices=runs.ENGINES)
    parser.add_argument("--seed", type=int, default=int(os.environ.get("TRIBOX_TEST_SEED", "1")))
    options, rest = parser.parse_known_args()
    print(f"seed {options.seed}", file=sys.stderr)
    runs.need(**runs.ENGINES[options.engine].needs)
    Engines.name, Engines.seed = options.engine, options.seed
    unittest.main("__main__", argv=[sys.argv[0], *rest])


if __name__ == "__main__":
    main()
