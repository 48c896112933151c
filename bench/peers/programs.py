"""Peers in C and C++, which the programs of the benchmarks time: rows as those of run.py."""

import json
import os
import subprocess


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
