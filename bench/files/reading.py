#!/usr/bin/env python3
"""reading.py PROGRAM[,PROGRAM] MESH: what it takes to read a mesh, in each format that libassimp writes, beside libassimp.

Least processor time and wall time of a whole `tribox overlap` with one thread and a box that nothing touches; of libassimp from
the file to its triangles."""
import ctypes
import ctypes.util
import os
import subprocess
import sys
import tempfile
import time

from files import run

ROUNDS = int(os.environ.get("ROUNDS", "9"))
FORMATS = (("plyb", "binary.ply"), ("ply", "text.ply"), ("obj", "mesh.obj"), ("stlb", "binary.stl"), ("stl", "text.stl"))
NOWHERE = "1e30,1e30,1e30,2e30,2e30,2e30"
TRIANGULATE, JOIN = 0x8, 0x2  # aiProcess_Triangulate, aiProcess_JoinIdenticalVertices

assimp = ctypes.CDLL(ctypes.util.find_library("assimp") or "libassimp.so.5")
assimp.aiImportFile.restype = ctypes.c_void_p
assimp.aiImportFile.argtypes = ctypes.c_char_p, ctypes.c_uint
assimp.aiReleaseImport.argtypes = (ctypes.c_void_p,)
assimp.aiExportScene.argtypes = ctypes.c_void_p, ctypes.c_char_p, ctypes.c_char_p, ctypes.c_uint


def by_program(program, path):
    """Processor and wall time in milliseconds."""
    return run([program, "overlap", path, "--box", NOWHERE, "--threads", "1"], stdout=subprocess.DEVNULL)[::-1]


def import_once(path):
    before, start = time.process_time(), time.monotonic()
    assert assimp.aiImportFile(path.encode(), TRIANGULATE), path
    print(1e3 * (time.process_time() - before), 1e3 * (time.monotonic() - start))


def by_assimp(path):
    """The same, in a process of its own."""
    return tuple(map(float, subprocess.check_output([sys.executable, __file__, "--import", path]).split()))


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    if sys.argv[1] == "--import":
        return import_once(sys.argv[2])
    programs, mesh = sys.argv[1].split(","), sys.argv[2]
    ways = [(by_program, program) for program in programs] + [(by_assimp,)]
    print("| format | MB |" + "".join(" %s: processor, wall ms |" % name for name in (*programs, "libassimp")))
    print("|---|---:|" + "---:|" * len(ways))
    with tempfile.TemporaryDirectory() as folder:
        scene = assimp.aiImportFile(mesh.encode(), TRIANGULATE | JOIN)
        assert scene, mesh
        for word, name in FORMATS:
            assert assimp.aiExportScene(scene, word.encode(), os.path.join(folder, name).encode(), 0) == 0, word
        assimp.aiReleaseImport(scene)
        for _, name in FORMATS:
            path = os.path.join(folder, name)
            times = [[] for _ in ways]
            for _ in range(ROUNDS):
                for (way, *program), taken in zip(ways, times):
                    taken.append(way(*program, path))
            print("| %s | %.0f |" % (name, os.path.getsize(path) / 1e6) +
                  "".join(" %.0f, %.0f |" % tuple(map(min, zip(*taken))) for taken in times), flush=True)


main()
