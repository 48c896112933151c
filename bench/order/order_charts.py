"""Draws the charts of the order sweep with gnuplot."""

import os
import shutil
import subprocess
import tempfile

import order_join

HERE = os.path.dirname(os.path.abspath(__file__))
BOX_SIZES = {"paper": 1.0}  # the scene paper is box-1


def box_size(scene):
    return BOX_SIZES.get(scene.name) or (float(scene.name[4:]) if scene.name.startswith("box-") else None)


def write_table(path, *blocks):
    """Rows of words and numbers; several blocks are what gnuplot selects by `index`."""
    def line(row):
        return " ".join('"%s"' % cell if isinstance(cell, str) else "%.6g" % cell for cell in row) + "\n"
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n\n".join("".join(map(line, rows)) for rows in blocks))


def gnuplot(folder, script, chart, **variables):
    """Runs a script of this directory on the tables of a chart in a folder. Returns what is wrong, or None."""
    quoted = {name: value if isinstance(value, int) else "'%s'" % value.replace("'", "''") for name, value in variables.items()}
    settings = "; ".join("%s = %s" % item for item in quoted.items())
    done = subprocess.run(["gnuplot", "-e", "chart = '%s'; %s" % (chart, settings), os.path.join(HERE, script)], cwd=folder,
                          capture_output=True, text=True)
    return "gnuplot: " + done.stderr.strip() if done.returncode else None


def draw_heat(folder, scenes, kernel, size):
    """Order x scene: the time of each order over that of the best, and whether a difference is shown."""
    chart = "heat_%s_%d" % (kernel, size)
    accuracies = ("exact", "conservative", "fast") if kernel != "paper" else ("fast",)
    panels = []
    for accuracy in accuracies:
        rows = []
        for x, scene in enumerate(scenes):
            best = scene.best(kernel, accuracy)
            for y, order in enumerate(order_join.ORDERS):
                key = (kernel, accuracy, order_join.ALL_AXES, order)
                is_shown = scene.verdict(key) == "slower"
                rows.append((x, y, scene.ratio(key, best).median, int(is_shown)))
        panels.append(rows)
    write_table(os.path.join(folder, chart + ".dat"), *panels)
    subject = "the paper's test" if kernel == "paper" else kernel
    title = "%s, %d pairs: time over that of the fastest order; in brackets: no difference beyond the spread" % (subject, size)
    names = ", ".join('"%s" %d' % (scene.name, x) for x, scene in enumerate(scenes))
    return gnuplot(folder, "order_heat.gp", chart, title=title, scenes=len(scenes), names=names,
                   accuracies=" ".join(accuracies))


def draw_boxes(folder, scenes, kernels):
    """Nanoseconds by box size, a panel for each kernel, a curve for each order."""
    boxes = sorted((scene for scene in scenes if box_size(scene)), key=box_size)
    if len(boxes) < 2:
        return None
    for kernel in kernels:
        rows = []
        for scene in boxes:
            times = [scene.time((kernel, "exact", order_join.ALL_AXES, order)).median for order in order_join.ORDERS]
            rows.append((box_size(scene), scene.why["overlapping"] / scene.why["pairs"], *times))
        write_table(os.path.join(folder, "boxes_%s.dat" % kernel), rows)
    return gnuplot(folder, "order_boxes.gp", "boxes", kernels=" ".join(kernels))


def draw_first(folder, scenes):
    """Which axis rejects first, for the default order and for the paper's."""
    for order in (order_join.DEFAULT_ORDER, 312):
        rows = []
        for scene in scenes:
            first = next(o["first"] for o in scene.why["orders"] if o["order"] == order)
            parts = [*first[:4], sum(first[4:]), scene.why["overlapping"]]
            rows.append((scene.name, *(100 * part / scene.why["pairs"] for part in parts)))
        write_table(os.path.join(folder, "first_%d.dat" % order), rows)
    return gnuplot(folder, "order_first.gp", "first")


def draw_left(folder, scenes):
    """Packets left after the first group, by lanes: the box normals, the plane, the edges."""
    for order in (123, 213, 312):
        rows = []
        for scene in scenes:
            lanes = next(o["lanes"] for o in scene.why["orders"] if o["order"] == order)
            rows.append((scene.name, *(100 * w["packets_left"][0] / w["packets"] for w in lanes)))
        write_table(os.path.join(folder, "left_%d.dat" % order), rows)
    return gnuplot(folder, "order_left.gp", "left")


def draw_all(folder, scenes):
    kernels = ["paper", *scenes[0].kernels()]
    sizes = sorted({scene.size for scene in scenes})
    middle = [scene for scene in scenes if scene.size == order_join.middle(sizes)]
    problems = [draw_heat(folder, [s for s in scenes if s.size == size], kernel, size) for kernel in kernels for size in sizes]
    problems += [draw_boxes(folder, middle, kernels[1:]), draw_first(folder, middle), draw_left(folder, middle)]
    return next((problem for problem in problems if problem), None)


def draw(out, scenes):
    """Draws all charts into a folder. Returns what is wrong, or None."""
    if not shutil.which("gnuplot"):
        return "gnuplot is not installed (on Debian: apt-get install gnuplot-nox)"
    with tempfile.TemporaryDirectory() as folder:
        problem = draw_all(folder, scenes)
        for name in os.listdir(folder):
            if name.endswith(".svg"):
                shutil.move(os.path.join(folder, name), os.path.join(out, name))
    return problem
