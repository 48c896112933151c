"""tribox voxelize and merge where something is wrong: one clear line, and never a part of a file."""

import os
import pty
import re
import resource
import shutil
import signal
import subprocess
import tempfile
import time

import meshes
import support
import volumes


def is_running(process):
    try:
        with open("/proc/%d/stat" % process) as file:
            return file.read().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


class Failures(support.TestCase):
    def setUp(self):
        super().setUp()
        self.mesh = self.write("mesh.ply", meshes.ply_binary(meshes.lattice_triangles(24, seed=8)))
        self.part = self.path("all.part.npz")
        self.succeed("voxelize", self.mesh, "--resolution", "40", "--shard", "1/1", "--quiet", "-o", self.part)
        self.there = sorted(os.listdir(self.folder))

    def path(self, name):
        return os.path.join(self.folder, name)

    def refuse(self, code, pattern, *arguments, **how):
        self.fail_with(code, pattern, *arguments, **how)
        self.assertEqual(sorted(os.listdir(self.folder)), self.there, arguments)


class WrongCommandLine(Failures):
    def wrong(self, pattern, *options):
        self.refuse(2, pattern + ".*see 'tribox voxelize --help'", "voxelize", *options)

    def test_what_is_missing(self):
        self.wrong("no mesh file given", "--resolution", "8", "-o", "x.npy")
        self.wrong("no grid given; give --resolution or --cell", self.mesh, "-o", "x.npy")
        self.wrong("no output given; give -o FILE", self.mesh, "--resolution", "8")
        self.wrong("'b.ply' is one file too many", self.mesh, "b.ply")
        for look in (("--up", "y"), ("--picture-size", "64x48")):
            self.wrong("--up and --picture-size need --preview", self.mesh, "--resolution", "8", "-o", "x.npy", *look)
        for option in ("--resolution", "--cell", "--origin", "--size", "-o", "--preview", "--threads", "--shard", "--up"):
            self.wrong("option %s needs a value" % option, self.mesh, option)

    def test_what_excludes_each_other(self):
        self.wrong("--resolution and --cell exclude each other", self.mesh, "--resolution", "8", "--cell", "1", "-o", "x.npy")
        self.wrong("--json and --quiet exclude each other", self.mesh, "--cell", "1", "-o", "x.npy", "--json", "--quiet")
        self.wrong("a shard is written as .npz, not as npy", self.mesh, "--cell", "1", "-o", "x.npy", "--shard", "1/2")
        self.wrong("--preview needs all cells: give it to 'tribox merge'", self.mesh, "--cell", "1", "-o", "x.part.npz", "--shard",
                   "1/2", "--preview", "x.png")

    def test_values(self):
        for value in ("0", "-1", "1.5", "", "x", "1e3", "9999999999", "8 "):
            self.wrong("--resolution: '%s' is not a whole number from 1 to " % re.escape(value), self.mesh, "--resolution", value)
        for value in ("0", "257", "two"):
            self.wrong("--threads: '%s' is not a whole number from 1 to 256" % value, self.mesh, "--threads", value)
        for value in ("1", "1,2", "1,2,3,4", "0,1,1", "1,2,3,", "1,2,-3", "1 2 3"):
            self.wrong("--size: '%s' is not NX,NY,NZ" % value, self.mesh, "--size", value)
        self.wrong("--cell: 0 is not greater than 0", self.mesh, "--cell", "0")
        self.wrong("--cell: -2 is not greater than 0", self.mesh, "--cell", "1,-2,1")
        for value, pattern in (("3", "'3' is not I/N, such as 3/8"), ("0/3", "its I: '0' is not a whole number from 1 to 3"),
                               ("4/3", "its I: '4' is not a whole number from 1 to 3"), ("1/0", "its N: '0' is not a whole number"),
                               ("/2", "its I: ''"), ("1/", "its N: ''"), ("1/2/3", "its N: '2/3'")):
            self.wrong("--shard.*" + pattern, self.mesh, "--shard", value)
        self.wrong("--up: 'w' is none of x, y, z, -x, -y, -z", self.mesh, "--up", "w")
        for value in ("640", "x", "0x8", "8x0", "8x4097", "8x6x4", "8 x 6", "123456789x8"):
            self.wrong("--picture-size.*: '.*' is no", self.mesh, "--picture-size", value)
        for name in ("x", "x.txt", ".npy", "x.NPY", ""):
            self.wrong("-o: '%s' does not end in .npz, .vdb, .npy, .vti, .nrrd, .raw, .binvox, .vox, .ply, .obj or .glb" % name, self.mesh, "--cell", "1", "-o", name)
        self.refuse(2, r"^tribox voxelize: --cell: 2 numbers where 3 are needed; give SX,SY,SZ$", "voxelize", self.mesh, "--cell", "1,2")
        self.refuse(2, r"^tribox voxelize: --origin: 'a' \(number 2 of 3\) is not a number", "voxelize", "--origin", "1,a,3")

    def test_merge(self):
        self.refuse(2, "no parts given; see 'tribox merge --help'", "merge", "-o", "x.npy")
        self.refuse(2, "no output given", "merge", self.part)
        self.refuse(2, "'x.part' does not end in .npz", "merge", self.part, "-o", "x.part")
        self.refuse(2, "--up and --picture-size need --preview", "merge", self.part, "-o", "x.npy", "--up", "x")
        self.refuse(2, "exclude each other", "merge", self.part, "-o", "x.npy", "--json", "--quiet")


class NothingHalfWritten(Failures):
    def test_places_that_take_no_file(self):
        for command in (("voxelize", self.mesh, "--cell", "1"), ("merge", self.part)):
            self.refuse(1, "none/x.npy: cannot write there: No such file", *command, "-o", self.path("none/x.npy"))
            self.refuse(1, "mesh.ply/x.npy: cannot write there: Not a directory", *command, "-o", self.mesh + "/x.npy")
        os.mkdir(self.path("folder.npy"))
        os.symlink("/dev/full", self.path("full.npy"))
        self.there = sorted(self.there + ["folder.npy", "full.npy"])
        self.refuse(1, "folder.npy: is a directory; give the name of a file", "voxelize", self.mesh, "--cell", "1", "-o",
                  self.path("folder.npy"))
        self.refuse(1, "full.npy: is not a regular file", "voxelize", self.mesh, "--cell", "1", "-o", self.path("full.npy"))

    def test_read_only_folder(self):
        if os.geteuid() == 0:
            self.skipTest("root may write everywhere")
        os.mkdir(self.path("locked"), 0o555)
        self.fail_with(1, "locked/x.npy: cannot write there: Permission denied", "voxelize", self.mesh, "--cell", "1", "-o",
                       self.path("locked/x.npy"))

    def test_no_room(self):
        """A limit on the size of files does what a full disk does: a write fails halfway."""
        limit = (resource.RLIMIT_FSIZE, 2000)
        for ending in ("npy", "raw", "binvox", "vox"):
            for command in (("voxelize", self.mesh, "--resolution", "40"), ("merge", self.part)):
                self.refuse(1, r"x\.%s: cannot write all of it: File too large; nothing of it was kept" % ending, *command,
                          "-o", self.path("x." + ending), limit=limit)
        self.refuse(1, "x.part.npz: cannot write all of it: File too large", "voxelize", self.mesh, "--resolution", "40", "--shard", "1/1",
                  "-o", self.path("x.part.npz"), limit=limit)
        self.refuse(1, "cannot write all of it", "voxelize", self.mesh, "--resolution", "40", "-o", self.path("x.npy"),
                  limit=(resource.RLIMIT_FSIZE, 0))

    def test_an_older_file_stays(self):
        path = self.write("old.npy", "what was there")
        self.there = sorted(self.there + ["old.npy"])
        self.refuse(1, "old.npy: cannot write all of it", "voxelize", self.mesh, "--resolution", "40", "-o", path,
                  limit=(resource.RLIMIT_FSIZE, 2000))
        self.assertEqual(volumes.read(path), b"what was there")
        self.succeed("voxelize", self.mesh, "--resolution", "4", "--quiet", "-o", path)
        self.assertEqual(volumes.read_npy(path)[0][0:1], volumes.read_npy(path)[0][:1])

    def test_rights_of_a_new_file(self):
        self.succeed("voxelize", self.mesh, "--resolution", "4", "--quiet", "-o", self.path("new.npy"))
        mask = os.umask(0)
        os.umask(mask)
        self.assertEqual(os.stat(self.path("new.npy")).st_mode & 0o777, 0o666 & ~mask)

    def interrupt(self, number, times=1):
        self.write("big.npy", "what was there")
        self.there = sorted({*self.there, "big.npy"})
        process = subprocess.Popen([support.program(), "voxelize", self.mesh, "--resolution", "900", "--quiet", "-o",
                                    self.path("big.npy")], stderr=subprocess.PIPE)
        deadline = time.monotonic() + 60
        while sorted(os.listdir(self.folder)) == self.there and time.monotonic() < deadline:
            time.sleep(0.001)
        for _ in range(times):
            os.kill(process.pid, number)
        error = process.communicate()[1]
        self.assertEqual(process.returncode, -number)
        return set(os.listdir(self.folder)) - set(self.there), error.decode()

    def test_interrupted(self):
        """Once, or twice at once as programs with a limit of time do it, to the child and its group: what the name was before stays."""
        for times in (1, *[2] * 20):
            left, error = self.interrupt(signal.SIGTERM, times)
            self.assertEqual(left, set())
            self.assert_one_line(error, "^tribox voxelize: interrupted: nothing was written; run it again$")
            self.assertEqual(volumes.read(self.path("big.npy")), b"what was there")

    def has_file(self, child):
        """Whether the process has the file that it writes."""
        try:
            return any(".tribox-" in os.readlink("/proc/%d/fd/%s" % (child, fd)) for fd in os.listdir("/proc/%d/fd" % child))
        except OSError:
            return False

    def start_openvdb(self, is_at_work):
        """Returns the program and its child that knows OpenVDB, which still loads it, or is at work."""
        support.skip_without_openvdb(self)
        process = subprocess.Popen([support.program(), "voxelize", self.mesh, "-r", "1500", "-q", "-o", self.path("big.vdb")],
                                   stderr=subprocess.PIPE)
        children, deadline = [], time.monotonic() + 60
        while process.poll() is None and time.monotonic() < deadline:
            with open("/proc/%d/task/%d/children" % (process.pid, process.pid)) as file:
                children = [int(word) for word in file.read().split()]
            if children and (not is_at_work or self.has_file(children[0])):
                break
            time.sleep(0.001)
        self.assertEqual(len(children), 1)
        return process, children[0]

    def test_openvdb_killed(self):
        """By the system where memory is short, say: the program goes on to its own end."""
        for is_at_work in (False, True):
            process, child = self.start_openvdb(is_at_work)
            os.kill(child, signal.SIGKILL)
            error = process.communicate(timeout=60)[1].decode()
            self.assertEqual(process.returncode, 1)
            self.assert_one_line(error, r"big\.vdb: OpenVDB failed: it broke off, most likely for lack of memory; write \.npz$")
            self.assertEqual(sorted(os.listdir(self.folder)), self.there)

    def test_openvdb_interrupted(self):
        """The program alone gets the signal, and takes the process that knows OpenVDB with it, which says nothing."""
        for is_at_work, number in ((False, signal.SIGTERM), (True, signal.SIGTERM), (True, signal.SIGINT)):
            process, child = self.start_openvdb(is_at_work)
            os.kill(process.pid, number)
            error = process.communicate(timeout=60)[1].decode()
            self.assertEqual(process.returncode, -number)
            self.assert_one_line(error, "^tribox voxelize: interrupted: nothing was written; run it again$")
            self.assertEqual(sorted(os.listdir(self.folder)), self.there)
            deadline = time.monotonic() + 60
            while is_running(child) and time.monotonic() < deadline:
                time.sleep(0.01)
            self.assertFalse(is_running(child))

    def test_openvdb_missing(self):
        """The program that knows OpenVDB is not there, or a library that it needs, or the disk is full before it is whole."""
        support.skip_without_openvdb(self)
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        alone, its = (os.path.join(place.name, name) for name in ("tribox", "tribox-vdb"))
        shutil.copy(support.program(), alone)
        environment = {**os.environ, "LD_LIBRARY_PATH": os.path.join(os.path.dirname(support.program()), "..", "src")}
        for lines, reason in (("", r"cannot start \S+/tribox-vdb, which writes \.vdb: No such file or directory"),
                              ("echo no libopenvdb.so >&2; exit 127", r"cannot load what writes \.vdb: no libopenvdb\.so"),
                              ("exit 3", "OpenVDB failed: it broke off, most likely for lack of memory")):
            if lines:
                with open(its, "w") as file:
                    file.write("#!/bin/sh\n" + lines + "\n")
                os.chmod(its, 0o755)
            done = subprocess.run([alone, "voxelize", self.mesh, "-r", "40", "-o", self.path("x.vdb")], env=environment,
                                  capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assert_one_line(done.stderr, r"x\.vdb: " + reason + r"; write \.npz$")
        self.refuse(1, "x.vdb: cannot write all of it: File too large", "voxelize", self.mesh, "-r", "300", "-o", self.path("x.vdb"),
                    limit=(resource.RLIMIT_FSIZE, 2000))
        self.assertEqual(sorted(os.listdir(self.folder)), self.there)

    def test_binvox_of_a_long_grid(self):
        """The cube that binvox fills up a grid to is not written on where the disk is full, nor begun where it cannot be counted."""
        for size in ("100,20000,100", "20000,100,100"):
            self.refuse(1, "long.binvox: cannot write all of it", "voxelize", self.mesh, "--cell", "1", "--origin", "0,0,0", "--size",
                        size, "-o", self.path("long.binvox"), limit=(resource.RLIMIT_FSIZE, 20000))
        self.refuse(1, r"long.binvox: binvox fills a grid up to a cube, here of 3000000\^3 cells, and 2097152\^3 are the most",
                    "voxelize", self.mesh, "--cell", "1", "--origin", "0,0,0", "--size", "1,3000000,1", "-o", self.path("long.binvox"))

    def test_killed(self):
        """Here the unfinished file stays, which has a name of its own."""
        left, error = self.interrupt(signal.SIGKILL)
        self.assertEqual((len(left), error), (1, ""))
        self.assertRegex(left.pop(), r"\A\.tribox-\w{6}\Z")
        self.assertEqual(volumes.read(self.path("big.npy")), b"what was there")

    def test_longest_names(self):
        longest = os.pathconf(self.folder, "PC_NAME_MAX")
        for length in (longest - 7, longest):
            path = self.path("x" * (length - 4) + ".npy")
            self.succeed("voxelize", self.mesh, "--resolution", "4", "--quiet", "-o", path)
            self.assertTrue(os.path.isfile(path))
            self.there = sorted(self.there + [os.path.basename(path)])
        self.refuse(1, "x.npy: cannot write all of it: File name too long; nothing of it was kept", "voxelize", self.mesh, "--resolution", "4",
                    "-o", self.path("x" * (longest - 3) + ".npy"))

    def test_links(self):
        """The file that a symbolic link leads to is written, wherever it is, and the link stays."""
        os.mkdir(self.path("elsewhere"))
        for name in ("real.npy", "elsewhere/real.npy"):
            self.write(name, "what was there")
            os.symlink(name, self.path("link.npy"))
            os.symlink("link.npy", self.path("link_to_link.npy"))
            before = sorted(os.listdir(self.folder))
            self.succeed("voxelize", self.mesh, "--resolution", "4", "--quiet", "-o", self.path("link_to_link.npy"))
            self.assertEqual(sorted(os.listdir(self.folder)), before)
            self.assertEqual(os.readlink(self.path("link.npy")), name)
            self.assertEqual(max(volumes.read_npy(self.path(name))[0]), 4)
            os.unlink(self.path("link.npy"))
            os.unlink(self.path("link_to_link.npy"))
        os.symlink("nowhere.npy", self.path("dangling.npy"))
        self.there = sorted(os.listdir(self.folder))
        self.refuse(1, "dangling.npy: cannot follow this link: No such file or directory", "voxelize", self.mesh, "--resolution", "4",
                    "-o", self.path("dangling.npy"))

    def test_mesh_that_is_none(self):
        self.refuse(1, "missing.ply: cannot open the mesh file", "voxelize", self.path("missing.ply"), "--cell", "1", "-o",
                  self.path("x.npy"))


class Memory(Failures):
    def test_refused_before_it_is_taken(self):
        limit = (resource.RLIMIT_AS, 1 << 30)
        if support.run("info", limit=limit).code:
            self.skipTest("this build needs more than 1 GiB of addresses by itself")
        pattern = (r"^tribox voxelize: 4000 x 4000 x 4000 cells take 7\.5 GiB of memory here and [\d.]+ MiB are available: choose "
                   r"fewer cells, or write bricks, -o FILE.npz or .vdb$")
        grid = ("voxelize", self.mesh, "--cell", "0.001", "--size", "4000,4000,4000")
        self.refuse(1, pattern, *grid, "-o", self.path("x.raw"), limit=limit)
        small = (*grid[:-1], "4000,400,4000")
        self.succeed(*small, "--quiet", "-o", self.path("x.npz"), limit=limit)


@support.unless_sanitized
class LittleMemory(Failures):
    """Limits on addresses, from little more than the program itself takes to enough for all: the file, or a line and nothing."""

    MIB = 1 << 20
    SPAN = 72 * MIB

    def setUp(self):
        super().setUp()
        self.tiles = self.path("mesh.tiles")
        self.succeed("partition", self.mesh, "-r", "300", "-q", "-o", self.tiles)
        os.mkdir(self.path("out"))

    def least(self):
        """Where the program runs at all."""
        limit = 4 * self.MIB
        while support.run("info", limit=(resource.RLIMIT_AS, limit)).code:
            limit += self.MIB
        return limit

    def write_within(self, limit, name, *arguments, pattern="memory"):
        """The bytes of the file, or None after a line of this pattern."""
        result = support.run("voxelize", *arguments, "-q", "-o", self.path("out/" + name), limit=(resource.RLIMIT_AS, limit))
        left = os.listdir(self.path("out"))
        if result.code:
            self.assertEqual((result.code, left), (1, []), (limit, result.stderr))
            self.assert_one_line(result.stderr, pattern)
            return None
        self.assertEqual((result.stderr, left), ("", [name]), limit)
        written = volumes.read(self.path("out/" + name))
        os.remove(self.path("out/" + name))
        return written

    def test_threads(self):
        """Where one thread has the memory that it needs, eight do the work, or as many of them as have theirs."""
        least = self.least()
        grid = ("-r", "300")
        for name, *arguments in (("x.npz", self.mesh, *grid), ("x.npz", self.tiles), ("x.part.npz", self.mesh, *grid, "--shard", "1/2"),
                                 ("x.raw", self.mesh, *grid), ("x.raw", self.mesh, *grid, "--fill", "outside")):
            whole = self.write_within(1 << 40, name, *arguments)
            for limit in range(least, least + self.SPAN, 6 * self.MIB):
                alone = self.write_within(limit, name, *arguments, "-t", "1")
                if alone:
                    self.assertEqual(alone, whole, (name, limit))
                    self.assertEqual(self.write_within(limit + self.MIB, name, *arguments, "-t", "8"), whole, (name, limit))
                else:
                    self.write_within(limit, name, *arguments, "-t", "8")

    def test_openvdb(self):
        """OpenVDB starts threads and may end the process that it is in: that is a line here, and no file is left."""
        support.skip_without_openvdb(self)
        wholes = set()
        for limit in [1 << 40, *range(self.least(), self.least() + 2 * self.SPAN, 9 * self.MIB)]:
            written = self.write_within(limit, "x.vdb", self.mesh, "-r", "100", "-t", "2",
                                        pattern=r"x\.vdb: .*(memory|failed|cannot).*; write \.npz$")
            if written:
                wholes.add(volumes.without_vdb_id(written))
        self.assertEqual(len(wholes), 1)


class Progress(Failures):
    def on_terminal(self, *arguments, rest_at=None):
        """rest_at: seconds after which it rests for one."""
        leader, follower = pty.openpty()
        process = subprocess.Popen([support.program(), *arguments], stderr=follower, stdout=subprocess.DEVNULL)
        if rest_at is not None:
            time.sleep(rest_at)
            process.send_signal(signal.SIGSTOP)
            time.sleep(1)
            process.send_signal(signal.SIGCONT)
        os.close(follower)
        text = b""
        try:
            while part := os.read(leader, 65536):
                text += part
        except OSError:
            pass  # Linux ends a terminal without a writer so
        os.close(leader)
        self.assertEqual(process.wait(), 0)
        return text.decode()

    def test_short_work_shows_none(self):
        self.assertEqual(self.on_terminal("voxelize", self.mesh, "--resolution", "8", "-o", self.path("x.npy")), "")

    def test_quiet_shows_none(self):
        arguments = ("voxelize", self.mesh, "--resolution", "700", "-o", self.path("x.npy"))
        self.assertEqual(self.on_terminal(*arguments, "--quiet"), "")
        text = self.on_terminal(*arguments)
        if text:  # the work has taken long enough
            self.assertRegex(text, r"\A(\r(voxelizing|writing) \[#*\.*\] +\d+ %  [^\r\n]* left *)+\r +\r")
            self.assertTrue(text.endswith(" \r"))

    def test_reading(self):
        """What is read at once would show nothing, so the program is made to rest on the way."""
        text = meshes.obj(meshes.lattice_triangles(3000, seed=3)) * 100
        box = ("--box", support.UNIT_BOX, "-t", "1")
        for name, content in (("long.obj", text), ("long.f32", meshes.pack_floats(meshes.lattice_triangles(3000, seed=3)) * 300)):
            mesh, shown = self.write(name, content), ""
            for rest_at in (0.02, 0.05, 0.01, 0.03, 0.1, 0.2, 0.4):
                shown = self.on_terminal("overlap", mesh, *box, "--shift", "0,0,0", rest_at=rest_at)
                if "reading" in shown:
                    break
            self.assertRegex(shown, r"\A(\rreading \[#*\.*\] +\d+ %  [^\r\n]*)+\r +\r")
            quiet = ("voxelize", mesh, "-r", "8", "-t", "1", "--quiet", "-o", self.path("x.npy"))
            self.assertEqual(self.on_terminal(*quiet, rest_at=rest_at), "")

    def test_what_is_done(self):
        """By tiles the bar also says how many of them are done, and how many in a second."""
        text = self.on_terminal("voxelize", self.mesh, "--resolution", "2500", "--count", "--threads", "1")
        if text:  # the work has taken long enough
            self.assertRegex(text, r"\A(\rvoxelizing \[#*\.*\] +\d+ %  [\d.]+k? of [\d.]+k? tiles, [\d.]+k?/s, [^\r\n]* left *)+\r +\r")
            self.assertLessEqual(max(map(len, text.split("\r"))), 85)


if __name__ == "__main__":
    support.main()
