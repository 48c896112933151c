"""Draws the charts of an order sweep with gnuplot, from order.csv: order_charts.py RESULTS."""

import os
import re
import shutil
import subprocess
import sys
import tempfile

import order_summary

HERE = os.path.dirname(os.path.abspath(__file__))


def box_size(scene):
    """The scene paper is box-1."""
    return 1.0 if scene == "paper" else float(scene[4:]) if scene.startswith("box-") else None


def write_table(path, rows):
    with open(path, "w", encoding="utf-8") as file:
        for row in rows:
            file.write(" ".join('"%s"' % cell if isinstance(cell, str) else "%.6g" % cell for cell in row) + "\n")


def gnuplot(folder, script, chart, **variables):
    """Runs a script of this directory on the tables of a chart in a folder. Returns what is wrong, or None."""
    quoted = {name: value if isinstance(value, int) else "'%s'" % value for name, value in variables.items()}
    settings = "; ".join("%s = %s" % item for item in quoted.items())
    done = subprocess.run(["gnuplot", "-e", "chart = '%s'; %s" % (chart, settings), os.path.join(HERE, script)], cwd=folder,
                          capture_output=True, text=True)
    return "gnuplot: " + done.stderr.strip() if done.returncode else None


def draw_boxes(folder, results):
    """Nanoseconds by box size, a panel for each kernel, a curve for each order."""
    boxes = sorted(filter(box_size, results.scenes()), key=box_size)
    if len(boxes) < 2:
        return None
    for kernel in results.kernels:
        rows = []
        for scene in boxes:
            orders = results.orders((scene, results.size, kernel, "exact"))
            rows.append((box_size(scene), orders[0]["hit_rate"], *(order["ns"] for order in orders)))
        write_table(os.path.join(folder, "boxes_%s.dat" % kernel), rows)
    return gnuplot(folder, "order_boxes.gp", "boxes", kernels=" ".join(results.kernels))


def draw_left(folder, results):
    """Packets left after the first group, by lanes: the box normals, the plane, the edges."""
    scenes = results.scenes()
    lanes = {results.get(scenes[0], kernel)["lanes"]: kernel for kernel in results.kernels}
    for order in ("123", "213", "312"):
        rows = []
        for scene in scenes:
            name = re.sub(r"\.(ply|stl|obj|off)$", "", scene, flags=re.I)
            shares = (results.get(scene, lanes[count], order=order)["left_1"] for count in sorted(lanes))
            rows.append((name, *(100 * share for share in shares)))
        write_table(os.path.join(folder, "left_%s.dat" % order), rows)
    return gnuplot(folder, "order_left.gp", "left", scenes=len(scenes), lanes=" ".join("%d" % count for count in sorted(lanes)))


def draw(out):
    """Draws all charts into a folder of results. Returns what is wrong, or None."""
    if not shutil.which("gnuplot"):
        return "gnuplot is not installed (on Debian: apt-get install gnuplot-nox)"
    results = order_summary.Results(out)
    with tempfile.TemporaryDirectory() as folder:
        problem = draw_boxes(folder, results) or draw_left(folder, results)
        for name in os.listdir(folder):
            if name.endswith(".svg"):
                shutil.move(os.path.join(folder, name), os.path.join(out, name))
    return problem


if __name__ == "__main__":
    sys.exit(draw(sys.argv[1]) if len(sys.argv) == 2 else __doc__)
