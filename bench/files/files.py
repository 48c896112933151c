#!/usr/bin/env python3
"""files.py PROGRAM[,PROGRAM] MESH...: file to file, by format, cells and threads: least wall and processor time as a table."""
import os
import resource
import subprocess
import sys
import tempfile
import time

ROUNDS, CELLS = int(os.environ.get("ROUNDS", "5")), os.environ.get("CELLS", "256 1024").split()
FORMATS, THREADS = os.environ.get("FORMATS", "npz vdb npy nrrd raw").split(), os.environ.get("THREADS", "1 2").split()


def run(arguments, **how):
    """Wall and processor time in milliseconds."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run(arguments, check=True, **how)
    wall, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return 1e3 * wall, 1e3 * (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)


def main():
    programs = sys.argv[1].split(",")
    print("| mesh | cells | file | threads | program | wall ms | processor ms | MB on disk |\n"
          "|---|---:|---|---:|---|---:|---:|---:|")
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out")
        for mesh, cells, word, threads in ((m, c, w, t) for m in sys.argv[2:] for c in CELLS for w in FORMATS for t in THREADS):
            times, disk = {p: [] for p in programs}, {}
            for program in programs * ROUNDS:
                times[program].append(run([program, "voxelize", mesh, "-r", cells, "-t", threads, "-q", "--out-format", word, "-o",
                                           out]))
                disk[program] = os.stat(out).st_blocks / 2048
                os.remove(out)
            for number, program in enumerate(programs, 1):
                wall, used = (min(column) for column in zip(*times[program]))
                print("| %s | %s | %s | %s | %d | %.0f | %.0f | %.2f |" % (
                    os.path.basename(mesh), cells, word, threads, number, wall, used,
                                                                       disk[program]), flush=True)


if __name__ == "__main__":
    main()
