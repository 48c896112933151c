"""Files of volumes through the programs that they are written for: every cell, and where the grid is."""

import json
import os
import re
import resource
import shutil
import struct
import subprocess
import zipfile

import meshes
import support
import volumes


# Sizes around 8 and 64, more than 4096 in a row, one cell, none that is set, cells of three lengths, a shifted mesh.
GRIDS = {
    "one": ("--cell", "9", "--origin=-3,-3,-3", "--size", "1,1,1"),
    "small": ("--resolution", "7"),
    "eights": ("--cell", "0.5", "--origin=-2,-2,-2", "--size", "8,8,8"),
    "odd": ("--cell", "0.3,0.5,0.25", "--origin=-2,-2.1,-2", "--size", "13,9,17"),
    "wide": ("--cell", "0.06,0.7,0.9", "--origin=-2,-2,-2", "--size", "70,7,5"),
    "words": ("--cell", "0.03,0.5,0.5", "--size", "128,8,9"),
    "long": ("--cell", "0.001,4,4", "--origin=-2,-2,-2", "--size", "4101,1,1"),
    "empty": ("--cell", "0.5", "--origin", "50,50,50", "--size", "10,11,12"),
    "no floats": ("--cell", "0.30000000001", "--origin=-2,-2,-2", "--size", "12,13,14"),
    "shifted": ("--shift", "0.5,-1,2", "--resolution", "11"),
}


class Volumes(support.TestCase):
    def setUp(self):
        super().setUp()
        self.mesh = self.write("mesh.ply", meshes.ply_binary(meshes.lattice_triangles(24, seed=9)))

    def path(self, name):
        return os.path.join(self.folder, name)

    def dense(self, name, *options):
        """The cells by our own reader of .npy, and the grid."""
        note = re.escape("note: %s does not hold that its cells are shifted" % self.path(name))
        run = self.succeed if "--shift" not in options else lambda *a: self.succeed_with_note(note, *a)
        found = json.loads(run("voxelize", self.mesh, "-o", self.path(name), "--json", *options))
        return volumes.read_npy(self.path(name))[1], found

    def check_place(self, found, grid, shift):
        """The corner or the middle of the first cell, and the lengths, to the last bits of a double."""
        for a in range(3):
            corner, cell = grid["origin"][a] + shift[a], grid["cell"][a]
            for key, value in (("origin", corner), ("middle", corner + cell / 2), ("cell", cell), ("begins", corner)):
                if key in found:
                    self.assertTrue(abs(found[key][a] - value) <= 1e-15 * (abs(corner) + cell), (key, found[key], value))

    def check(self, program, ending, *options, has_place=True):
        expected, paths = [], []
        for name, grid in GRIDS.items():
            expected.append(self.dense("dense.npy", *grid))
            paths.append(self.path(name + ending))
            words = ("voxelize", self.mesh, "-o", paths[-1], "--quiet", *options, *grid)
            if has_place or "--shift" not in grid:
                self.assertEqual(self.succeed(*words), "")
            else:
                self.succeed_with_note("note: .* does not hold that its cells are shifted by 0.5,-1,2$", *words)
        for (cells, answer), found, path in zip(expected, self.foreign(program, *paths), paths):
            self.assertEqual(len(found["cells"]), answer["occupied"], path)
            self.assertEqual({tuple(cell) for cell in found["cells"]}, cells, path)
            self.assertEqual(found.get("active", len(cells)), len(cells), path)
            self.assertEqual(found.get("size", answer["grid"]["size"]), answer["grid"]["size"], path)
            shift = answer.get("shift", [0, 0, 0])
            self.assertEqual(found.get("shift", shift), shift, path)
            self.assertEqual(found.get("type", "float64"), "float64", path)
            yield found, answer["grid"], shift


class Readers(Volumes):
    def test_bricks(self):
        """Numbers of the grid are kept as they are, and the shift apart."""
        for options in ((), ("--deflate",)):
            for found, grid, _ in self.check("numpy", ".npz", *options):
                self.assertEqual((found["origin"], found["cell"]), (grid["origin"], grid["cell"]))
            for name in GRIDS:
                with zipfile.ZipFile(self.path(name + ".npz")) as file:
                    self.assertIsNone(file.testzip())
                    kind = zipfile.ZIP_DEFLATED if options else zipfile.ZIP_STORED
                    self.assertEqual({member.compress_type for member in file.infolist()}, {kind})

    def test_many_bricks(self):
        """More than zlib's buffers hold."""
        for name, options in (("stored.npz", ()), ("deflated.npz", ("--deflate",))):
            self.succeed("voxelize", self.mesh, "--resolution", "600", "-q", "-o", self.path(name), *options)
        with zipfile.ZipFile(self.path("stored.npz")) as stored, zipfile.ZipFile(self.path("deflated.npz")) as deflated:
            for name in ("at.npy", "bits.npy"):
                self.assertEqual(stored.read(name), deflated.read(name))
            self.assertGreater(deflated.getinfo("bits.npy").compress_size, 100000)

    def test_list_of_cells(self):
        for _ in self.check("numpy", ".npy", "--out-format", "cells", has_place=False):
            pass

    def test_paraview(self):
        for found, grid, shift in self.check("vtk", ".vti"):
            self.check_place(found, grid, shift)

    def test_slicer(self):
        for found, grid, shift in self.check("teem", ".nrrd"):
            self.check_place(found, grid, shift)

    def test_openvdb(self):
        """By default a file that OpenVDB's own Python module reads."""
        support.skip_without_openvdb(self)
        for found, grid, shift in self.check("openvdb", ".vdb"):
            self.check_place(found, grid, shift)

    def test_openvdb_and_small_cells(self):
        """It takes no volume below 3e-15, so that lengths are multiplied."""
        support.skip_without_openvdb(self)
        small = self.write("small.ply", meshes.ply_binary([[[x * 2 ** -20 for x in v] for v in t] for t in
                                                           meshes.lattice_triangles(4, seed=3)]))
        self.succeed_with_note("note: .*small.vdb has lengths of the mesh times 1000, as OpenVDB takes no cells as small as these$",
                               "voxelize", small, "-r", "40", "-q", "-o", self.path("small.vdb"))
        found, = self.foreign("openvdb", self.path("small.vdb"))
        for a in range(3):
            self.assertTrue(volumes.is_close(found["middle"][a], 1000 * (found["begins"][a] + found["lengths"][a] / 2)))
            self.assertTrue(volumes.is_close(found["cell"][a], 1000 * found["lengths"][a]))
        self.fail_with(1, "are too small for .vdb; write .npz", "voxelize", small, "--cell", "1e-30", "--size", "4,4,4", "--origin",
                       "0,0,0", "-o", self.path("x.vdb"))

    def test_openvdb_masks(self):
        """OpenVDB's Python module does not know them: our own reader does, and OpenVDB's program says how many cells there are."""
        support.skip_without_openvdb(self)
        for name, grid in GRIDS.items():
            cells, answer = self.dense("dense.npy", *grid)
            self.succeed("voxelize", self.mesh, "-o", self.path("masks.vdb"), "--vdb-grid", "mask", "--quiet", *grid)
            about, transform, found = volumes.read_vdb_masks(self.path("masks.vdb"))
            self.assertEqual(found, cells, name)
            self.check_place({"middle": transform[:3], "cell": transform[3:6]}, answer["grid"],
                             answer.get("shift", [0, 0, 0]))
            self.assertEqual(about["size"], ("vec3i", struct.pack("<3i", *answer["grid"]["size"])))
            if shutil.which("vdb_print"):
                self.check_printed(cells)

    def check_printed(self, cells):
        text = subprocess.run(["vdb_print", "-l", self.path("masks.vdb")], capture_output=True, text=True, check=True).stdout
        self.assertIn("Type: Tree_mask_5_4_3", text)
        self.assertEqual(int(re.search(r"active voxels: +([\d,]+)", text)[1].replace(",", "")), len(cells))

    def test_openvdb_to_a_pipe(self):
        """Places in the file are not filled in then, and not looked at."""
        support.skip_without_openvdb(self)
        self.dense("dense.npy", *GRIDS["odd"])
        with open(self.path("pipe.vdb"), "wb") as file:
            subprocess.run([support.program(), "voxelize", self.mesh, *GRIDS["odd"], "--out-format", "vdb", "-o", "-"], stdout=file,
                           check=True, timeout=60)
        found, = self.foreign("openvdb", self.path("pipe.vdb"))
        self.assertEqual({tuple(cell) for cell in found["cells"]}, volumes.read_npy(self.path("dense.npy"))[1])

class Places(Volumes):
    """Where files go: names, standard output, disks that are full."""

    SPARSE = ("npz", "cells")
    DENSE = ("vti", "nrrd", "ply", "obj", "glb")

    def test_standard_output(self):
        """The file itself, where it is written by going back in it too; for that a nameless one is made and leaves nothing."""
        for word in self.SPARSE + self.DENSE:
            self.succeed("voxelize", self.mesh, *GRIDS["odd"], "-q", "--out-format", word, "-o", self.path("file.npy"))
            self.check_stdout(word, volumes.read(self.path("file.npy")))

    def check_stdout(self, word, expected):
        temporary = self.path("temporary")
        os.makedirs(temporary, exist_ok=True)
        done = subprocess.run([support.program(), "voxelize", self.mesh, *GRIDS["odd"], "--out-format", word, "-o", "-"],
                              capture_output=True, timeout=60, env={**os.environ, "TMPDIR": temporary})
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        self.assertEqual(done.stdout, expected, word)
        self.assertEqual(os.listdir(temporary), [])

    def test_no_place_for_temporary_files(self):
        self.fail_with(1, "^tribox voxelize: /nonexistent: cannot write there: No such file", "voxelize", self.mesh, *GRIDS["odd"],
                       "--out-format", "npz", "-o", "-", env={"TMPDIR": "/nonexistent"})

    def test_full_disk(self):
        """Standard output that is full; a file that becomes too large for its limit."""
        grid = ("--resolution", "100")
        for word in self.SPARSE + self.DENSE + (("vdb",) if support.has_openvdb() else ()):
            with open("/dev/full", "wb") as full:
                done = subprocess.run([support.program(), "voxelize", self.mesh, *grid, "--out-format", word, "-o", "-"],
                                      stdout=full, stderr=subprocess.PIPE, timeout=60)
            self.assertEqual(done.returncode, 1)
            self.assert_one_line(done.stderr.decode(), "cannot write the output: No space left on device")
            for limit in (100, 20000):
                self.fail_with(1, "x.npy: cannot write all of it: File too large; nothing of it was kept", "voxelize", self.mesh, *grid,
                               "--out-format", word, "-o", self.path("x.npy"), limit=(resource.RLIMIT_FSIZE, limit))
                self.assertEqual(os.listdir(self.folder), ["mesh.ply"])

    def has_holes(self):
        with open(self.path("hole"), "wb") as file:
            file.seek(1 << 20)
            file.write(b"1")
        blocks = os.stat(self.path("hole")).st_blocks
        os.remove(self.path("hole"))
        return blocks <= 64

    def test_holes(self):
        """A file of few cells takes less place than it has bytes, which are those that go to standard output."""
        is_sparse = self.has_holes()
        for size in ("200,100,300", "4096,3,50", "8192,2,9", "8191,3,7", "64,64,2", "1,1,1"):
            for origin in ("-2,-2,-2", "-9,-9,-9", "50,50,50"):
                for word in ("npy", "nrrd", "vti", "raw"):
                    grid = ("--cell", "0.05", "--origin=" + origin, "--size", size, "--out-format", word)
                    self.succeed("voxelize", self.mesh, *grid, "-q", "-o", self.path("x"))
                    done = subprocess.run([support.program(), "voxelize", self.mesh, *grid, "-o", "-"], capture_output=True, timeout=60)
                    self.assertEqual(volumes.read(self.path("x")), done.stdout, (size, origin, word))
                    about = os.stat(self.path("x"))
                    if is_sparse and size == "200,100,300":
                        self.assertLess(512 * about.st_blocks, about.st_size / 2, (origin, word))
                    os.remove(self.path("x"))

    def test_layers_as_they_are_done(self):
        """
        The same bytes for any number of threads and for what takes bytes as they come, which gets all layers at once: rows that end
        amid words and blocks, more layers than a thread takes at once. Where the file becomes too large nothing is left.
        """
        for word, size, threads in (("npy", "130,701,300", "125"), ("raw", "130,701,300", "2"), ("vti", "1000,120,160", "2")):
            grid = ("--cell", "0.03", "--origin=-2.3,-2,-2.1", "--size", size, "--out-format", word)
            done = subprocess.run([support.program(), "voxelize", self.mesh, *grid, "-o", "-"], capture_output=True, timeout=60)
            for count in threads:
                self.succeed("voxelize", self.mesh, *grid, "-q", "-o", self.path("x"), "-t", count)
                self.assertEqual(volumes.read(self.path("x")) == done.stdout, True, (word, count))
                os.remove(self.path("x"))
                self.fail_with(1, "x.npy: cannot write all of it: File too large; nothing of it was kept", "voxelize", self.mesh, *grid,
                               "-t", count, "-o", self.path("x.npy"), limit=(resource.RLIMIT_FSIZE, len(done.stdout) // 2))
                self.assertEqual(os.listdir(self.folder), ["mesh.ply"])

    def test_folder_that_is_not_there(self):
        for word in self.SPARSE + self.DENSE:
            self.fail_with(1, "cannot write there: No such file", "voxelize", self.mesh, *GRIDS["odd"], "--out-format", word, "-o",
                           self.path("nowhere/x"))

    def test_names(self):
        for name in ("Würfel ✓.npz", "a b.vti", "-.nrrd", "..npz"):
            os.makedirs(self.path("né"), exist_ok=True)
            self.succeed("voxelize", self.mesh, *GRIDS["small"], "-q", "-o", self.path("né/" + name))
            self.assertIn(name, os.listdir(self.path("né")))

    def test_same_bytes_again(self):
        for word in self.SPARSE + self.DENSE:
            files = []
            for threads in ("1", "4"):
                self.succeed("voxelize", self.mesh, *GRIDS["odd"], "-q", "--out-format", word, "-o", self.path("x"), "-t", threads)
                files.append(volumes.read(self.path("x")))
            self.assertEqual(files[0], files[1], word)

    def test_a_link_to_the_file_stays(self):
        os.makedirs(self.path("elsewhere"))
        os.symlink("elsewhere/x.npz", self.path("link.npz"))
        target = self.path("elsewhere/x.npz")
        open(target, "wb").close()
        self.succeed("voxelize", self.mesh, *GRIDS["small"], "-q", "-o", self.path("link.npz"))
        self.assertTrue(os.path.islink(self.path("link.npz")) and zipfile.is_zipfile(target))


class Options(Volumes):
    def test_summary_of_files_without_place(self):
        for name, has_place in (("x.npy", False), ("x.raw", False), ("x.vti", True), ("x.npz", True)):
            text = self.succeed("voxelize", self.mesh, *GRIDS["small"], "-o", self.path(name))
            self.assertEqual("\nplace        not in the file: keep origin and cell\n" in text, not has_place, name)

    def test_what_a_format_does_not_have(self):
        self.fail_with(2, "--deflate is for .npz alone", "voxelize", self.mesh, "-r", "8", "-o", "x.npy", "--deflate")
        self.fail_with(2, "--vdb-grid is for .vdb alone", "voxelize", self.mesh, "-r", "8", "-o", "x.npz", "--vdb-grid", "mask")
        self.fail_with(2, "--vdb-grid: 'float' is neither bool nor mask", "voxelize", self.mesh, "-r", "8", "-o", "x.vdb",
                       "--vdb-grid", "float")


if __name__ == "__main__":
    support.main()
