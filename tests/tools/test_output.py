"""Where the answer goes: full and closed outputs, and locales with a decimal comma."""

import json
import os
import shutil
import subprocess

import meshes
import support


class Output(support.TestCase):
    def setUp(self):
        super().setUp()
        self.mesh = self.write("mesh.obj", meshes.obj([((0, 0, 0), (1.5, 0, 0), (0, 1.5, 0))] * 3000))
        self.commands = [("--help",), ("--version",), ("info",), ("info", "--json"), ("info", "--help"), ("demo", "--help"),
                         ("demo", "--quick"), ("overlap", "--help")]
        self.commands += [("overlap", self.mesh, "--box", support.UNIT_BOX, *more) for more in ((), ("--list",), ("--json",))]

    def lose_output(self, redirection):
        for command in self.commands:
            done = subprocess.run(["sh", "-c", 'exec "$0" "$@" ' + redirection, support.program(), *command], capture_output=True,
                                  timeout=120)
            self.assertEqual(done.returncode, 1, command)
            self.assert_one_line(done.stderr.decode(), "cannot write the output: ")

    def test_full(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("no /dev/full here")
        self.lose_output(">/dev/full")

    def test_closed(self):
        self.lose_output(">&-")

    def test_streaming_stops(self):
        """With the output gone, the rest of the boxes is not worked through."""
        if not os.path.exists("/dev/full"):
            self.skipTest("no /dev/full here")
        boxes = self.write("boxes.txt", "0 0 0 1 1 1\n" * 3 + "wrong\n")
        with open("/dev/full", "wb") as full:
            done = subprocess.run([support.program(), "overlap", self.mesh, "--boxes", boxes], stdout=full, stderr=subprocess.PIPE)
        self.assertEqual(done.returncode, 1)
        self.assert_one_line(done.stderr.decode(), "cannot write the output: ")


class Locale(support.TestCase):
    def make_locale(self):
        """Compiles a German locale into the test's folder; None where that cannot be done."""
        if not shutil.which("localedef"):
            return None
        subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", os.path.join(self.folder, "de_DE.UTF-8")], capture_output=True)
        env = {"LOCPATH": self.folder, "LC_ALL": "de_DE.UTF-8"}
        told = subprocess.run(["locale", "decimal_point"], capture_output=True, env={**os.environ, **env})
        return env if told.stdout.strip() == b"," else None

    def test_decimal_comma(self):
        env = self.make_locale()
        if env is None:
            self.skipTest("no locale with a decimal comma can be made here")
        triangles = [((0.125, 0.5, 0), (0.125, 0.5, 0), (0.125, 0.5, 0))]
        for name in ("text.obj", "ascii.ply", "ascii.stl", "text.off", "text.gltf"):
            mesh = self.write(name, meshes.FORMATS[name](triangles))
            for how in ({}, {"env": env}):
                text = self.succeed("overlap", mesh, "--box", "0.125,0.5,0,0.125,0.5,0.25", "--json", **how)
                answer = json.loads(text)
                self.assertEqual((answer["overlapping"], answer["box"]["hi"]), (1, [0.125, 0.5, 0.25]))
            self.assertIn("0.125,0.5,0,", self.succeed("overlap", mesh, "--box", "0.125,0.5,0,1,1,1", env=env))


if __name__ == "__main__":
    support.main()
