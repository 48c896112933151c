"""The order sweep: runs build/bench/order on every scene and size in several processes, joins what they measured, and draws it.

Leaves in the folder --out: order.csv, the medians; axes.csv; order.json, everything; tables.md and order.svg, the tables and the
chart of findings.md. Progress goes to standard error.
"""

import argparse
import csv
import json
import os
import random
import shlex
import shutil
import subprocess
import sys
import time

import order_join
import order_tables

SIZES = (800, 20000, 1000000)  # in the first-level cache, in the second, in none
MEDIANS = ("scene", "size", "pairs", "hit_rate", "kernel", "lanes", "accuracy", "axes", "order", "ns", "to_best", "to_paper",
           "to_paper_least", "verdict", "unlike_exact", "left_1", "bytes")


def parse():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True, help="the program order, build/bench/order")
    parser.add_argument("--out", required=True, help="the folder for results and charts; made if it is not there")
    parser.add_argument("--quick", action="store_true", help="20,000 pairs, 5 rounds, 3 processes, no meshes: under a minute")
    parser.add_argument("--processes", type=int, default=5, help="processes for each scene and size (default 5)")
    parser.add_argument("--seconds", type=int, default=2, help="seconds of rounds in each process, 5 rounds at least (default 2)")
    parser.add_argument("--size", type=int, action="append", help="pairs of a scene; may be repeated (default 800, 20000, 1000000)")
    parser.add_argument("--scene", action="append", help="only this scene; may be repeated")
    parser.add_argument("--meshes", default=os.environ.get("TRIBOX_MESHES"),
                        help="a folder of meshes, PLY, STL, OBJ or OFF, for octree scenes (default: $TRIBOX_MESHES, or none)")
    parser.add_argument("--seed", type=int, default=1, help="of the scenes and of all turns (default 1)")
    wanted = parser.parse_args()
    if wanted.quick:
        wanted.size, wanted.seconds, wanted.processes, wanted.meshes = wanted.size or [20000], 0, 3, None
    wanted.size = wanted.size or list(SIZES)
    if wanted.processes < 2:
        parser.error("--processes: give 2 or more, since the spread is the range between processes")
    return wanted


def scenes_of(wanted):
    """The arguments that select each drawn scene."""
    listed = subprocess.run([wanted.program, "--list"], capture_output=True, text=True, check=True).stdout
    names = [line.split()[0] for line in listed.splitlines()]
    unknown = [name for name in wanted.scene or () if name not in names]
    if unknown:
        sys.exit("order_sweep: unknown scene '%s'; the scenes are: %s" % (unknown[0], " ".join(names)))
    return [("--scene", name) for name in names if not wanted.scene or name in wanted.scene]


def units_of(wanted):
    """What a process measures: a scene and its size. Meshes, whose octrees have sizes of their own, come at one size only."""
    units = [(scene, size) for size in wanted.size for scene in scenes_of(wanted)]
    if wanted.meshes and not wanted.scene:
        files = sorted(name for name in os.listdir(wanted.meshes) if name.lower().endswith((".ply", ".stl", ".obj", ".off")))
        units += [(("--mesh", os.path.join(wanted.meshes, name)), order_join.middle(wanted.size)) for name in files]
    return units


class Progress:
    """A line on standard error: how much is done, and about how long the rest takes."""

    def __init__(self, units):
        self.left, self.total, self.seconds, self.begin = list(units), len(units), {}, time.monotonic()

    def expected(self, unit):
        """What the unit took before, or what others of its size took, or any."""
        alike = [s for other, s in self.seconds.items() if other[1] == unit[1]] or list(self.seconds.values()) or [0]
        return self.seconds.get(unit, sum(alike) / len(alike))

    def show(self, unit):
        rest = sum(map(self.expected, self.left))
        text = "[%d/%d] %s, %d pairs; " % (self.total - len(self.left) + 1, self.total, os.path.basename(unit[0][1]), unit[1])
        text += "about %d:%02d left" % divmod(round(rest), 60) if self.seconds else "estimating the time left"
        if sys.stderr.isatty():
            print("\r\x1b[K" + text, end="", file=sys.stderr, flush=True)
        elif (self.total - len(self.left)) % max(1, self.total // 20) == 0:
            print(text, file=sys.stderr, flush=True)

    def done(self, unit, seconds):
        self.left.remove(unit)
        self.seconds[unit] = seconds

    def end(self):
        took = "measured in %d:%02d" % divmod(round(time.monotonic() - self.begin), 60)
        print(("\r\x1b[K" if sys.stderr.isatty() else "") + took, file=sys.stderr)


def run_unit(wanted, unit, process):
    """One process: a scene at a size. Processes differ in the turns that the contestants take."""
    (option, scene), size = unit
    command = [wanted.program, option, scene, "--size", str(size), "--seconds", str(wanted.seconds), "--seed", str(wanted.seed),
               "--turns", str(1000 * wanted.seed + process), "--json"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        sys.exit("\n%sorder_sweep: '%s' failed with status %d" % (done.stderr, shlex.join(command), done.returncode))
    return json.loads(done.stdout)


def run_all(wanted):
    """Every unit in every process, in a fresh random order each time. Returns the machine and the joined scenes."""
    units = units_of(wanted)
    progress, runs, machine = Progress(units * wanted.processes), {unit: [] for unit in units}, None
    turns = random.Random(wanted.seed)
    for process in range(wanted.processes):
        for unit in turns.sample(units, len(units)):
            progress.show(unit)
            begin = time.monotonic()
            output = run_unit(wanted, unit, process)
            progress.done(unit, time.monotonic() - begin)
            machine = machine or output
            runs[unit].append(output["scenes"][0])
    progress.end()
    return machine, [order_join.Scene(unit[1], runs[unit]) for unit in units]


def command_of(wanted):
    """The command as it can be repeated elsewhere: without folders."""
    words = ["order_sweep.py", "--processes", str(wanted.processes), "--seconds", str(wanted.seconds), "--seed", str(wanted.seed)]
    words += [word for size in wanted.size for word in ("--size", str(size))]
    words += [word for scene in wanted.scene or () for word in ("--scene", scene)]
    return shlex.join(words) + (" --meshes FOLDER" if wanted.meshes else "")


def header_of(wanted, machine):
    header = {name: machine[name] for name in ("processor", "virtual", "compiler", "flags", "commit", "load_average")}
    header["command"] = command_of(wanted)
    header["processes"] = wanted.processes
    header["seed"] = wanted.seed
    return header


def write_csv(path, header, names, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        for name, value in header.items():
            file.write("# %s: %s\n" % (name, value))
        writer = csv.DictWriter(file, names, lineterminator="\n")
        writer.writeheader()
        for row in rows:
            cells = {name: row.get(name, "") for name in names}
            writer.writerow({name: "%.5g" % value if isinstance(value, float) else value for name, value in cells.items()})


def write_all(out, header, scenes):
    rows = [order_join.row_of(scene, key) for scene in scenes for key in scene.entrants]
    axes = [row for scene in scenes for row in order_join.axes_rows(scene)]
    write_csv(os.path.join(out, "order.csv"), header, MEDIANS, rows)
    write_csv(os.path.join(out, "axes.csv"), header, list(axes[0]), axes)
    with open(os.path.join(out, "order.json"), "w", encoding="utf-8") as file:
        json.dump({**header, "scenes": {scene.name: scene.what for scene in scenes}, "rows": rows, "axes": axes}, file, indent=1)
        file.write("\n")
    with open(os.path.join(out, "tables.md"), "w", encoding="utf-8") as file:
        file.write(order_tables.all_tables(rows))


def draw(out):
    """Draws the chart. Returns what is wrong, or None."""
    if not shutil.which("gnuplot"):
        return "gnuplot is not installed (on Debian: apt-get install gnuplot-nox)"
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "order.gp")
    done = subprocess.run(["gnuplot", "-c", script, os.path.join(out, "order.csv"), os.path.join(out, "order.svg")],
                          capture_output=True, text=True)
    return "gnuplot: " + done.stderr.strip() if done.returncode else None


def main():
    wanted = parse()
    os.makedirs(wanted.out, exist_ok=True)
    machine, scenes = run_all(wanted)
    write_all(wanted.out, header_of(wanted, machine), scenes)
    problem = draw(wanted.out)
    print("results%s in %s" % ("" if problem else " and a chart", wanted.out))
    if problem:
        print("no chart: " + problem)


if __name__ == "__main__":
    main()
