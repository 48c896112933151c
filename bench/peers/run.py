#!/usr/bin/env python3
"""tribox beside other libraries that are here: how many times as long they take, and how far their answers agree.

Each peer and question is asked in a process of its own, on one processor, in turns with tribox; the least of the rounds counts.
"""

import argparse
import itertools
import json
import math
import os
import re
import signal
import struct
import subprocess
import sys
import tempfile
import threading

HERE = os.path.dirname(os.path.abspath(__file__))
PEERS = {
    "vtk": "apt install python3-vtk9",
    "openvdb": "apt install python3-openvdb",
    "open3d": "apt install python3-open3d",
    "recast": "apt install librecast-dev",
    "itk": "apt install libinsighttoolkit5-dev",
    "bvh": "npm install --prefix DIR three three-mesh-bvh, and set NODE_PATH=DIR/node_modules",
}
CELLS = "surface", "middles"  # questions about cells


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, default, text in (
            ("--build", "", "a build of tribox, for its module and programs; else the installed module"),
            ("--cells", "128,256,1024", "along the longest side; without it 128,256,1024"),
            ("--peers", ",".join([*PEERS, "programs"]), "some of " + ", ".join([*PEERS, "programs"])),
            ("--questions", None, "some of surface, middles, index, boxes, crop, crop inside"),
            ("--rounds", 5, "at the most; fewer where they take more than a tenth of the limit"),
            ("--limit", 60, "seconds until a peer is ended; without it 60"),
            ("--json", None, "a file for all figures")):
        parser.add_argument(name, default=default, type=type(default) if default else str, help=text)
    parser.add_argument("meshes", metavar="MESH", nargs="*", help="a binary PLY file of triangles; else a torus")
    o = parser.parse_args()
    o.cells, o.peers = sorted(map(int, o.cells.split(","))), o.peers.split(",")
    o.questions = o.questions.split(",") if o.questions else None
    if o.build:
        module = os.path.join(os.path.abspath(o.build), "python")
        os.environ["TRIBOX_LIBRARY"] = os.path.join(os.path.abspath(o.build), "src", "libtribox.so.1")
        os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, [module, os.environ.get("PYTHONPATH")]))
    return o


def child(limit, *words):
    """What it says, whatever becomes of it. The limit is from tribox's answer to the peer's."""
    values, timer = {}, None
    with tempfile.TemporaryFile("w+") as err:
        process = subprocess.Popen([sys.executable, "-B", os.path.join(HERE, "one.py"), *map(str, words)], stdout=subprocess.PIPE,
                                   stderr=err, text=True, start_new_session=True)
        for text in process.stdout:
            values.update(json.loads(text) if text.startswith("{") else {})
            if "ours" in values and not timer:
                timer = threading.Timer(limit, os.killpg, (process.pid, signal.SIGKILL))
                timer.start()
            elif "theirs" in values:
                timer.cancel()
        code = process.wait()
        if timer:
            timer.cancel()
        err.seek(0)
        if code == -signal.SIGKILL and "ours" in values and "theirs" not in values:
            values.update(theirs=[limit] * 2, is_over=True)
        elif code:
            values["failed"] = f"ended by signal {-code}" if code < 0 else err.read().strip().rpartition("\n")[2]
    return values


def answers(peer, questions, path, o):
    """Rows of one peer about one mesh. What took too long is not asked in more cells."""
    for question in (q for q in questions if not o.questions or q in o.questions):
        for cells in o.cells if question in CELLS else [0]:
            row = child(o.limit, peer, question, path, cells, o.rounds, o.limit / 10)
            row = {"peer": row.pop("name", peer), "question": question, "cells": cells, **row}
            yield row
            if row.get("is_over") or "failed" in row:
                break


def voxels(build, path, cells):
    """Voxelizers in float."""
    command = [os.path.join(build, "bench", "tribox-bench"), "voxels", "--no-scenes", "--json", "--limit", "1", "--rounds", "5",
               "--cells", ",".join(map(str, cells)), path]
    for table, n in zip(json.loads(subprocess.check_output(command))["tables"], cells):
        ours, theirs = (next(row for row in table["rows"] if row["way"] == name) for name in ("exact", "Schwarz-Seidel"))
        row = {"peer": "Schwarz and Seidel 2010, in float", "question": "surface", "cells": n, "way": "bench/voxels",
               "ours": [ours["ms"] / 1e3] * 2}
        yield {**row, "theirs": [theirs["ms"] / 1e3] * 2, "of": ours["cells"], "unlike": theirs["cells_unlike"]} \
            if theirs["ms"] else {**row, "theirs": [1] * 2, "is_over": True}


def trees(build, path, _):
    """Lists of the triangles in boxes, 0.1 to 50 % of the mesh."""
    command = [os.path.join(build, "tests", "peers", "peers"), "--boxes", "10", "--rounds", "3", "--json", path]
    times, answers, *_ = (table["rows"] for table in json.loads(subprocess.check_output(command))["tables"])
    us = {(row["contestant"], row["box_%"]): row["us"] for row in times}
    for peer in answers:
        agreement = {"of": peer["all_hits"], "missed": peer["missing"], "extra": peer["extra"]}  # over all sizes
        for part in [part for name, part in us if name == peer["peer"]]:
            ours, theirs = us["list", part] / 1e6, us[peer["peer"], part] / 1e6
            yield {"peer": peer["peer"], "question": "boxes of 0.1 to 50 %", "cells": 0, "way": f"tests/peers, {part:g} %",
                   "ours": [ours] * 2, "theirs": [theirs] * 2, **agreement}
            agreement = {}


SETUP = "meson setup DIR -Dbuildtype=release -Dtests=enabled -Dpeers=enabled; meson compile -C DIR; then --build DIR"
PROGRAMS = {os.path.join("bench", "tribox-bench"): voxels, os.path.join("tests", "peers", "peers"): trees}


def factor(row):
    """Of processor times; of those by the clock where that is all that is known."""
    clock = bool(row.get("is_over"))
    return row["theirs"][clock] / row["ours"][clock]


def agreement(rows):
    rows = [row for row in rows if "of" in row]
    of, missed, extra, unlike = (sum(row.get(name, 0) for row in rows) for name in ("of", "missed", "extra", "unlike"))
    if not rows:
        return ""
    if unlike:
        return f"{unlike:,} of {of:,} differ"
    return f"{missed:,} missed, {extra:,} extra of {of:,}" if missed or extra else f"the same {of:,}"


def short(number):
    return f"{number:,.0f}" if number >= 100 else f"{number:.3g}"


def bound(number, is_over):
    return ("> " if is_over else "") + short(number)


def line(row):
    head = f"{row['mesh']:16} {row['peer']:34} {row.get('way', ''):28} {row['question']:20} {row['cells'] or '':>5}"
    if "theirs" not in row:
        return f"{head}  {row.get('skipped') or row['failed']}"
    times = [bound(number, row.get("is_over")) for number in (1e3 * row["theirs"][0], factor(row))]
    return head + "{:>10} {:>10} {:>10}  ".format(short(1e3 * row["ours"][0]), *times) + agreement([row])


def table(rows):
    """A row for each peer, question and number of cells, over the meshes."""
    groups = {}
    for row in rows:
        if "theirs" in row:
            groups.setdefault((row["peer"], row["way"].partition(",")[0], row["question"], row["cells"] or ""), []).append(row)
    yield "| peer | way | question | cells | times tribox: least, mean, most | agreement |"
    yield "|---|---|---|---:|---:|---|"
    for key, of in groups.items():
        of.sort(key=factor)
        mean, is_over = math.exp(sum(math.log(factor(row)) for row in of) / len(of)), any(row.get("is_over") for row in of)
        spread = bound(factor(of[0]), of[0].get("is_over")), bound(mean, is_over), bound(factor(of[-1]), is_over)
        yield f"| {' | '.join(map(str, key))} | {', '.join(spread)} | {agreement(of)} |"


def head(kernel):
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        yield "processor  " + re.search(r"(?<=model name\t: ).*|$", file.read())[0] + f"; kernel {kernel}"
    yield "commit     " + subprocess.getoutput(f"git -C '{HERE}' describe --always --dirty")
    yield "command    bench/peers/run.py " + " ".join(re.sub(r"^/.*/", "", word) for word in sys.argv[1:])
    yield "limits     processor time; one thread on one processor; the least of some rounds, in turns; a process for each row"


def torus(folder):
    """Around a ring, rings of corners."""
    path, rings, corners = os.path.join(folder, "torus.ply"), 400, 60
    with open(path, "wb") as file:
        file.write(("ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\nproperty float y\n"
                    "property float z\nelement face %d\nproperty list uchar int vertex_indices\nend_header\n" %
                    (rings * corners, 2 * rings * corners)).encode())
        for ring, corner in itertools.product(range(rings), range(corners)):
            t, turn = 2 * math.pi * ring / rings, 2 * math.pi * corner / corners
            radius = 2 + 0.85 * math.cos(turn)
            file.write(struct.pack("<3f", radius * math.cos(t), radius * math.sin(t), 0.85 * math.sin(turn)))
        for ring, corner in itertools.product(range(rings), range(corners)):
            a, b, c, d = ((ring + i) % rings * corners + (corner + j) % corners for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)))
            file.write(struct.pack("<B3IB3I", 3, a, b, c, 3, a, c, d))
    return path


def main():
    o, rows, here, kernel = options(), [], {}, None
    for peer in (p for p in o.peers if p != "programs"):
        said = child(o.limit, peer)
        if "questions" in said:
            here[peer], kernel = said["questions"], said["kernel"]
        elif "absent" in said:
            print(f"{peer}: not here ({said['absent']}): {PEERS[peer]}")
        else:
            return f"{peer}: {said['failed']}"
    built = PROGRAMS if "programs" in o.peers else {}
    for program in [p for p in built if not o.build or not os.path.exists(os.path.join(o.build, p))]:
        print(f"{program}: not here: {SETUP}")
        built = {name: call for name, call in built.items() if name != program}
    print(*head(kernel), "\nmilliseconds of tribox, of the peer, how many times as long, and how the answers differ\n", sep="\n")
    with tempfile.TemporaryDirectory() as folder:
        for path in o.meshes or [torus(folder)]:
            for row in itertools.chain(*(answers(peer, questions, path, o) for peer, questions in here.items()),
                                       *(call(o.build, path, o.cells) for call in built.values())):
                rows.append({"mesh": os.path.basename(path), **row})
                print(line(rows[-1]), flush=True)
    print("", *table(rows), sep="\n")
    if o.json:
        with open(o.json, "w", encoding="utf-8") as file:
            json.dump(rows, file, indent=1)
    return any("failed" in row for row in rows)


if __name__ == "__main__":
    sys.exit(main())
