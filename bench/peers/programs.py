"""Peers in C and C++, which the programs of the benchmarks time: rows as those of run.py."""

import collections
import csv
import json
import os
import re
import subprocess
import tempfile


def voxels(build, path, cells):
    """Voxelizers in float."""
    command = [os.path.join(build, "bench", "tribox-bench"), "voxels", "--no-scenes", "--json", "--limit", "1", "--rounds", "5",
               "--cells", ",".join(map(str, cells)), path]
    for table, n in zip(json.loads(subprocess.check_output(command))["tables"], cells):
        rows = {row["contestant"]: row for row in table["rows"]}
        ours, theirs = (rows[name]["ns_a_triangle"] * rows[name]["triangles"] / 1e9 for name in ("exact", "Schwarz-Seidel"))
        yield {"peer": "Schwarz and Seidel 2010, in float", "question": "surface", "cells": n, "way": "bench/voxels",
               "ours": [ours] * 2, "theirs": [theirs] * 2, "of": rows["exact"]["set"],
               "unlike": rows["Schwarz-Seidel"]["cells_unlike"] or 0}


def trees(build, path, _):
    """Lists of the triangles in boxes, 0.1 to 50 % of the mesh."""
    with tempfile.TemporaryDirectory() as folder:
        table = os.path.join(folder, "peers.csv")
        command = [os.path.join(build, "tests", "peers", "peers"), "--boxes", "10", "--rounds", "3", "--csv", table, path]
        text = subprocess.check_output(command, text=True)
        with open(table, encoding="utf-8") as file:
            times = collections.defaultdict(dict)
            for line in csv.DictReader(file):
                times[line["contestant"]][line["part"]] = float(line["us"]) / 1e6
    hits = int(re.search(r"boxes, (\d+) hits", text)[1])
    for name, missed, extra in re.findall(r"(\w+) missing (\d+), extra (\d+)", text):
        agreement = {"of": hits, "missed": int(missed), "extra": int(extra)}  # over all sizes
        for part, theirs in times[name].items():
            yield {"peer": name, "question": "boxes of 0.1 to 50 %", "cells": 0, "way": f"tests/peers, {100 * float(part):g} %",
                   "ours": [times["list"][part]] * 2, "theirs": [theirs] * 2, **agreement}
            agreement = {}


SETUP = "meson setup DIR -Dbuildtype=release -Dtests=enabled -Dpeers=enabled; meson compile -C DIR; then --build DIR"
PROGRAMS = {os.path.join("bench", "tribox-bench"): voxels, os.path.join("tests", "peers", "peers"): trees}
