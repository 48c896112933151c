"""slurm.sh where Slurm does not answer, where OUT is seen late, and what it refuses: with commands that only play Slurm's."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "engines")
SCRIPT = os.path.join(EXAMPLES, "slurm.sh")

SBATCH = """#!/bin/sh
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
            self.make(name, content, 0o755)
        for mesh in "mesh.f32", "other.f32":
            self.make(mesh)

    def path(self, name):
        return os.path.join(self.folder, name)

    def make(self, name, content="", mode=0o644):
        with open(os.open(self.path(name), os.O_CREAT | os.O_WRONLY | os.O_TRUNC, mode), "w") as file:
            file.write(content)

    def read(self, name):
        with open(self.path(name)) as file:
            return file.read()

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
        self.assertEqual(self.run_script(RUNS, MADE), (0, "", 4))
        self.assertFalse(os.path.exists(self.path("out.npz.jobs")))

    def test_no_answer(self):
        """While Slurm does not answer, the job is not taken for ended."""
        for end in ("", FORGOTTEN):
            code, said, _ = self.run_script(SILENT, RUNS, end)
            self.assertEqual((code, self.left()), (1, []))
            self.assertRegex(said, "^a job failed: out.npz.jobs/")
        self.assertEqual(self.run_script(SILENT, SILENT, RUNS, SILENT, MADE), (0, "", 4))

    def test_late(self):
        """A file system may show OUT some time after the job that wrote it has ended."""
        for end in ("", FORGOTTEN + "\n"):
            self.assertEqual(self.run_script(RUNS, f"{MADE_LATE}\n{end}", seconds=20), (0, "", 4))
            os.remove(self.path("out.npz"))

    def test_other_command(self):
        """What a failed run left is taken by the same command alone."""
        self.assertEqual(self.run_script()[::2], (1, 4))
        for piece in 1, 2, 3:
            os.mkdir(self.path(f"out.npz.jobs/{piece}.tiles"))
        for other in (dict(resolution=4096), dict(shards=2), dict(mesh="other.f32")):
            code, said, submitted = self.run_script(MADE, **other)
            self.assertEqual((code, submitted), (2, 0), other)
            self.assertRegex(said, "^out.npz.jobs is of another command, /.*/mesh.f32 0 .* 1024 3: .* remove out.npz.jobs, or")
        self.assertEqual(self.run_script(MADE, mesh=self.path("mesh.f32")), (0, "", 3))
        self.assertEqual(self.run_script()[:2], (2, "out.npz exists\n"))
        os.remove(self.path("out.npz"))
        self.assertEqual(self.run_script(MADE, resolution=4096), (0, "", 4))

    def test_what_is_there(self):
        """Only what is missing is submitted, and waits for the array before it."""
        self.run_script()
        self.assertRegex(self.read("submitted"), "cut --array=1,2,3 .*\n.*=afterok:7 .*=sort --array=1,2,3 .*\n"
                                                 ".*=afterok:7 .*=voxelize --array=1,2,3 .*\n.*=afterok:7 .*=merge ")
        os.mkdir(self.path("out.npz.jobs/1.tiles"))
        for name in "1.bounds", "2.bounds", "3.bounds", "2.part":
            self.make(f"out.npz.jobs/{name}")
        self.run_script()
        self.assertRegex(self.read("submitted"), "^--parsable [^\n]*=sort --array=2,3 .*\n.*=voxelize --array=1,3 ")
        for piece in 2, 3:
            os.mkdir(self.path(f"out.npz.jobs/{piece}.tiles"))
        self.assertEqual(self.run_script(MADE), (0, "", 2))
        self.assertRegex(self.read("submitted"), "^--parsable [^\n]*=voxelize --array=1,3 ")

    def run_job(self, step, restarts):
        """Its exit code, and what it asked of scontrol."""
        self.make("scontrol", '#!/bin/sh\necho "$@" >>requeued\n', 0o755)
        self.make("requeued")
        job = dict(SLURM_JOB_ID="6", SLURM_ARRAY_TASK_ID="2", SLURM_RESTART_COUNT=str(restarts))
        given = dict(jobs="jobs", out="out.npz", n="3", mesh="mesh.f32", resolution="9", here=EXAMPLES)
        done = subprocess.run(["sh", os.path.join(EXAMPLES, "slurm_job.sh"), step], cwd=self.folder, timeout=60,
                              stderr=subprocess.DEVNULL, env={"PATH": f"{self.folder}:{os.environ['PATH']}", **job, **given})
        return done.returncode, self.read("requeued")

    def test_killed(self):
        """A job whose program is killed is queued again, three times; one that fails is not."""
        os.mkdir(self.path("jobs"))
        for program, steps in (("python3", ("cut", "sort")), ("tribox", ("voxelize", "merge"))):
            for command, restarts, expected in (("kill -9 $$", 0, (137, "requeue 6\n")), ("kill -9 $$", 2, (137, "requeue 6\n")),
                                                ("kill -9 $$", 3, (137, "")), ("exit 1", 0, (1, "")), ("exit 0", 0, (0, ""))):
                self.make(program, f"#!/bin/sh\n{command}\n", 0o755)
                for step in steps if expected[0] else steps[:1]:
                    self.assertEqual(self.run_job(step, restarts), expected, (step, command))

    def test_sorted_by_another(self):
        """A folder that appears while a job makes it is as good as its own; none at all is a failure, and the piece stays."""
        os.mkdir(self.path("jobs"))
        self.make("python3", "#!/bin/sh\n", 0o755)
        for command, expected, left in (("exit 1", (1, ""), ["2.f32"]), ("mkdir jobs/2.tiles; exit 1", (0, ""), ["2.tiles"])):
            self.make("jobs/2.f32")
            self.make("tribox", f"#!/bin/sh\n{command}\n", 0o755)
            self.assertEqual(self.run_job("sort", 0), expected)
            self.assertEqual(os.listdir(self.path("jobs")), left)


if __name__ == "__main__":
    unittest.main(argv=sys.argv)
