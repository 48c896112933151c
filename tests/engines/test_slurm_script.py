"""slurm.sh where Slurm does not answer, where OUT is seen late, and what it refuses: with commands that only play Slurm's."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "engines", "slurm.sh")

SBATCH = """#!/bin/sh
cat >/dev/null
echo "$@" >>submitted
echo 7
"""

# The first of the answers that are left, each a script; with none left the job is over.
SQUEUE = """#!/bin/sh
next=$(ls answers | head -n 1)
test -n "$next" || exit 0
mv "answers/$next" answer
exec sh answer
"""

RUNS = "echo '7 all merge user R 0:01 1 node'"
SILENT = "echo 'slurm_load_jobs error: Unable to contact slurm controller (connect failure)' >&2; exit 1"
FORGOTTEN = "echo 'slurm_load_jobs error: Invalid job id specified' >&2; exit 1"
MADE = "touch out.npz"
MADE_LATE = "(sleep 2; touch out.npz) >/dev/null 2>&1 &"


class ScriptTests(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        for name, content in (("sbatch", SBATCH), ("squeue", SQUEUE)):
            with open(os.open(self.path(name), os.O_CREAT | os.O_WRONLY, 0o755), "w") as file:
                file.write(content)

    def path(self, name):
        return os.path.join(self.folder, name)

    def run_script(self, *answers, mesh="mesh.f32", resolution=1024, shards=3, seconds=1):
        """Its exit code, what it said, and how many jobs it submitted. answers: of squeue, one after the other."""
        shutil.rmtree(self.path("answers"), ignore_errors=True)
        os.mkdir(self.path("answers"))
        for number, answer in enumerate(answers):
            with open(self.path(f"answers/{number}"), "w") as file:
                file.write(answer)
        with open(self.path("submitted"), "w+") as submitted:
            done = subprocess.run(["sh", SCRIPT, mesh, str(resolution), str(shards), "out.npz"], cwd=self.folder, timeout=60,
                                  env={**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}", "OUT_SECONDS": str(seconds)},
                                  stderr=subprocess.PIPE, text=True)
            return done.returncode, done.stderr, len(submitted.readlines())

    def left(self):
        """What answers of squeue were not asked for."""
        return os.listdir(self.path("answers"))

    def test_right(self):
        self.assertEqual(self.run_script(RUNS, MADE), (0, "", 3))
        self.assertFalse(os.path.exists(self.path("out.npz.jobs")))

    def test_no_answer(self):
        """While Slurm does not answer, the job is not taken for ended."""
        for end in ("", FORGOTTEN):
            code, said, _ = self.run_script(SILENT, RUNS, end)
            self.assertEqual((code, self.left()), (1, []))
            self.assertRegex(said, "^a job failed: out.npz.jobs/")
        self.assertEqual(self.run_script(SILENT, SILENT, RUNS, SILENT, MADE), (0, "", 3))

    def test_late(self):
        """A file system may show OUT some time after the job that wrote it has ended."""
        for end in ("", FORGOTTEN + "\n"):
            self.assertEqual(self.run_script(RUNS, f"{MADE_LATE}\n{end}", seconds=20), (0, "", 3))
            os.remove(self.path("out.npz"))

    def test_other_command(self):
        """What a failed run left is taken by the same command alone."""
        self.assertEqual(self.run_script()[::2], (1, 3))
        os.mkdir(self.path("out.npz.jobs/tiles"))
        for other in (dict(resolution=4096), dict(shards=2), dict(mesh="other.f32")):
            code, said, submitted = self.run_script(MADE, **other)
            self.assertEqual((code, submitted), (2, 0), other)
            self.assertRegex(said, "^out.npz.jobs is of another command, /.*/mesh.f32 1024 3: .* remove out.npz.jobs, or")
        self.assertEqual(self.run_script(MADE, mesh=self.path("mesh.f32")), (0, "", 2))
        self.assertEqual(self.run_script()[:2], (2, "out.npz exists\n"))
        os.remove(self.path("out.npz"))
        self.assertEqual(self.run_script(MADE, resolution=4096), (0, "", 3))


if __name__ == "__main__":
    unittest.main(argv=sys.argv)
