"""Files that are no mesh, or only part of one: one clear line each, and never an answer."""

import os
import re

import meshes
import support

TRIANGLES = meshes.lattice_triangles(20, seed=4)
AGAIN = r"[^\n]*; write it again"


class BadMeshes(support.TestCase):
    def refuse(self, path, pattern):
        for arguments in (("--box", support.UNIT_BOX), ("--box", support.UNIT_BOX, "--list"), ("--boxes", "-", "--json")):
            self.fail_with(1, r"^tribox overlap: [^\n]*%s: %s" % (os.path.basename(path), pattern),
                           "overlap", path, *arguments, stdin=b"0 0 0 1 1 1\n")

    def test_no_file(self):
        self.refuse(os.path.join(self.folder, "missing.ply"), "cannot open the mesh file: No such file")
        self.refuse(self.folder, "is a directory; give a mesh file")
        self.refuse("/dev/null", "is not a regular file")
        for name in ("empty.obj", "empty.ply", "empty.off", "empty.stl", "empty.f32", "empty"):
            self.refuse(self.write(name, ""), "the file is empty")
        for name in ("folder.obj", "folder.stl", "folder.f32"):
            os.mkdir(os.path.join(self.folder, name))
            self.refuse(os.path.join(self.folder, name), "is a directory; give a mesh file")
        for name in ("missing.stl", "missing.f32"):
            self.refuse(os.path.join(self.folder, name), "cannot open the mesh file: No such file")

    def test_unreadable(self):
        for name in ("little.ply", "binary.stl", "raw.f32"):
            path = self.write(name, meshes.FORMATS[name](TRIANGLES))
            os.chmod(path, 0)
            if os.access(path, os.R_OK):
                self.skipTest("this user may read every file")
            self.refuse(path, "cannot open the mesh file: Permission denied")

    def test_no_mesh(self):
        for name in ("notes.txt", "notes.gltf", "no_ending"):
            self.refuse(self.write(name, "hello\n"),
                        "not a (mesh that libassimp can read, or a damaged one|PLY, OFF, OBJ, STL, .f32 or .f64 file)")
    def test_part_is_damaged(self):
        mesh = self.write("scene.gltf", "{}")
        self.write("tribox_assimp.so", "no library\n")
        result = support.run("overlap", mesh, "--box", support.UNIT_BOX, env={"LD_LIBRARY_PATH": self.folder})
        self.assertEqual(result.code, 1)
        self.assert_one_line(result.stderr, "scene.gltf: not a PLY, .* file, and what reads others cannot be loaded: .*tribox_assimp.so")

    def test_no_mesh_of_a_kind(self):
        self.refuse(self.write("notes.obj", "hello\n"), "not an OBJ file, or an empty one: it has no line with a vertex, 'v X Y Z'")
        self.refuse(self.write("notes.ply", "hello\n"), "not a PLY file: it does not begin with 'ply'")
        self.refuse(self.write("notes.stl", "hello\n"), "truncated, or not an STL file")
        self.refuse(self.write("notes.off", "hello\n"), "not an OFF file: it does not begin with 'OFF'")
        self.refuse(self.write("counts.off", "OFF\n"), "truncated, or not text")
        for name in ("bytes.ply", "bytes.stl", "bytes.obj", "bytes.off", "bytes.glb"):
            self.refuse(self.write(name, bytes(range(256)) * 40), ".")

    def test_no_triangles(self):
        for content in ("v 0 0 0\nv 1 1 1\n", "v 0 0 0\nv 1 1 1\nl 1 2\n", "v 0 0 0\nv 1 1 1\np 1 2\n"):
            self.refuse(self.write("points.obj", content), "contains no triangles .points or lines at most.; give a mesh with faces")
        self.refuse(self.write("points.ply", meshes.ply_header("ascii", 2, 0) + b"0 0 0\n1 1 1\n"), "contains no triangles")
        self.refuse(self.write("none.stl", meshes.stl_binary([])), "contains no triangles")

    def test_vertices_that_are_not_there(self):
        vertices = b"0 0 0\n1 0 0\n0 1 0\n"
        self.refuse(self.write("far.ply", meshes.ply_header("ascii", 3, 2) + vertices + b"3 0 1 2\n3 0 1 3\n"),
                    "damaged: face 1 refers to vertex 3, the mesh has 3")
        self.refuse(self.write("negative.ply", meshes.ply_header("ascii", 3, 1) + vertices + b"3 0 1 -1\n"), "damaged: face 0 .*-1")
        self.refuse(self.write("far.off", b"OFF\n3 1 0\n" + vertices + b"3 0 1 3\n"), "damaged: face 0 refers to vertex 3")
        self.refuse(self.write("negative.off", b"OFF\n3 1 0\n" + vertices + b"3 0 -1 2\n"), "damaged: face 0 refers to vertex -1")
        for vertex in ("4", "-4", "0", "-0", "4/1/1"):
            self.refuse(self.write("far.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 %s\nv 1 1 1\n" % vertex if vertex[0] == "-" else
                                   "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 %s\n" % vertex),
                        "damaged: line 4 refers to vertex %s, the file has 3, counted from 1" % vertex)

    def test_header_of_ply(self):
        whole = meshes.ply_ascii(TRIANGLES)
        for old, new in ((b"property float x", b"property number x"), (b"list uchar int", b"list uchar"),
                         (b"element vertex 60", b"element vertex many"), (b"format ascii", b"format morse")):
            self.refuse(self.write("header.ply", whole.replace(old, new)), "not a sound PLY file: '.*' in its header is not understood")
        for old, new, pattern in ((b"property float z\n", b"", "promises 60 of 'vertex' without one x, one y and one z each"),
                                  (b"float z", b"float x", "promises 60 of 'vertex' without one x, one y and one z each"),
                                  (b"vertex_indices", b"vertices", "promises 20 of 'face' without one list vertex_indices each"),
                                  (b"format ascii 1.0\n", b"", "header does not say which format it has"),
                                  (b"element face", b"element vertex", "header has 'vertex' twice")):
            self.refuse(self.write("header.ply", whole.replace(old, new)), "not a sound PLY file: .*" + pattern)

    def test_words_that_are_not_numbers(self):
        """The line is named."""
        for name, old, line in (("ascii.ply", b"end_header\n", 11), ("text.off", b"60 20 0\n", 4)):
            whole = meshes.FORMATS[name](TRIANGLES)
            for word in (b"1,5", b"0.5f", b"x", b"1.IND", b"--1"):
                start = whole.index(old) + len(old)
                end = whole.index(b" ", start)
                self.refuse(self.write(name, whole[:start] + word + whole[end:]), "damaged: line %d has '%s' where a (number|coordinate of a vertex) "
                            "should be" % (line, re.escape(word.decode())))
        content = meshes.off(TRIANGLES)
        for old, new, pattern in ((b"3 0 1 2\n", b"3 0 1\n", "line 64 ends where the number of a vertex should follow"),
                                  (b"3 0 1 2\n", b"3 0 1 #2\n", "line 64 ends where the number of a vertex should follow"),
                                  (b"60 20 0\n", b"60 20 0\n1 2\n", "line 4 ends where a coordinate of a vertex should follow"),
                                  (b"3 0 1 2\n", b"3 0 1 2.5\n", "line 64 has '2.5' where the number of a vertex should be")):
            self.refuse(self.write("words.off", content.replace(old, new, 1)), "damaged: " + pattern)

    def test_words_of_obj(self):
        vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
        for line, pattern in (("v 1 2 x\n", "line 4 has 'x' where a coordinate of a vertex should be"), ("v 1,2 3\n", "line 4 has '1,2' where"),
                              ("v 1 2\n\n", "line 4 ends where a coordinate of a vertex should follow"),
                              ("v 1 2 # 3\n", "line 4 ends where a coordinate of a vertex should follow"),
                              ("f 1 2 3.5\n", "line 4 has '3.5' where the number of a vertex should be"), ("f 1 2 --3\n", "line 4 has '--3' where"),
                              ("f 1 2 3/x\n", "line 4 has '3/x' where"), ("f 1 2 /3\n", "line 4 has '/3' where"),
                              ("f\n", "line 4 ends where the number of a vertex should follow")):
            self.refuse(self.write("words.obj", vertices + line + "f 1 2 3\n"), "damaged: " + pattern)

    def test_grammar_of_stl(self):
        whole = meshes.stl_ascii(TRIANGLES)
        for old, new, pattern in ((b"outer", b"inner", "line 3 has 'inner' where 'outer' should be"),
                                  (b"endloop", b"vertex 1 2 3\nendloop", "line 7 has 'vertex' where 'endloop' should be"),
                                  (b"vertex", b"normal", "line 4 has 'normal' where 'vertex' should be"),
                                  (b"facet", b"point", "line 2 has 'point' where 'facet' or 'endsolid' should be"),
                                  (b"endsolid test\n", b"endsolid test\nmore\n", "line 143 has 'more' where 'solid' should be")):
            count = -1 if old.startswith(b"end") and b"more" in new else 1
            self.refuse(self.write("grammar.stl", whole.replace(old, new, count) + b" \n"), "damaged: " + pattern)

    def test_other_kinds_of_off(self):
        self.refuse(self.write("binary.off", b"OFF BINARY\n" + bytes(99)), "is binary, and only OFF as text is read")
        for word in ("4OFF", "nOFF", "C4nOFF"):
            self.refuse(self.write("four.off", word + "\n3 1 0\n"), "has vertices of other than three coordinates")


class TruncatedMeshes(support.TestCase):
    """Cut at every place that a reader could stumble over; the last byte of a text is a line end, without which it is whole."""

    def refuse_cuts(self, name, least_missing, pattern):
        whole = meshes.FORMATS[name](TRIANGLES)
        self.assertEqual(self.overlap(self.write(name, whole), support.UNIT_BOX)["triangles"], len(TRIANGLES))
        sizes = set(range(4, len(whole) - least_missing, 97)) | set(range(len(whole) - least_missing - 30, len(whole) - least_missing + 1))
        for size in sizes:
            path = self.write(name, whole[:size])
            self.fail_with(1, r"^tribox overlap: [^\n]*%s: %s" % (name, pattern), "overlap", path, "--box", support.UNIT_BOX)

    def test_ply(self):
        for name in ("little.ply", "big.ply", "cr_lf.ply", "cr.ply"):
            self.refuse_cuts(name, 1, "truncated: " + AGAIN)
        self.refuse_cuts("ascii.ply", 3, "truncated: " + AGAIN)

    def test_stl(self):
        self.refuse_cuts("binary.stl", 1, "truncated, or not an STL file" + AGAIN)
        self.refuse_cuts("solid.stl", 1, "(truncated%s|no triangles|not a mesh)" % AGAIN)
        self.refuse_cuts("ascii.stl", 14, "(truncated%s|not a mesh)" % AGAIN)

    def test_raw(self):
        """Only between triangles can a cut not be seen."""
        whole = meshes.pack_floats(TRIANGLES)
        for size in [*range(1, 75), *range(75, len(whole), 29), len(whole) - 36, len(whole) - 1]:
            path = self.write("cut.f32", whole[:size])
            if size % 36:
                self.fail_with(1, r"^tribox overlap: [^\n]*cut.f32: truncated, or not raw triangles: after %d triangles of 36 bytes it "
                               "has %d bytes more; write it again" % divmod(size, 36), "overlap", path, "--box", support.UNIT_BOX)
            else:
                self.assertEqual(self.overlap(path, support.UNIT_BOX)["triangles"], size // 36)

    def test_obj(self):
        """A cut among the vertices leaves no faces, or faces of vertices that are not there."""
        whole = meshes.obj(TRIANGLES)
        for size in range(1, whole.index(b"f "), 41):
            self.fail_with(1, r"^tribox overlap: [^\n]*cut.obj: (truncated|not an OBJ file|contains no triangles)", "overlap",
                           self.write("cut.obj", whole[:size]), "--box", support.UNIT_BOX)

    def test_off(self):
        self.refuse_cuts("text.off", 4, "(truncated%s|not a mesh)" % AGAIN)

    def test_gltf(self):
        self.refuse_cuts("text.gltf", 1, "not a mesh")
        self.refuse_cuts("binary.glb", 1, "not a mesh")


if __name__ == "__main__":
    support.main()
