"""Writes the figures of the order sweep into findings.md: every block between <!-- figures: NAME --> and <!-- end -->.

    python3 bench/order/order_summary.py RESULTS [SECOND]

RESULTS is a folder that the sweep wrote; SECOND one of another run of the same command, for the block on reproducibility.
"""

import csv
import os
import re
import sys

FINDINGS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "findings.md")
ORDERS = ("123", "132", "213", "231", "312", "321")
FIXED = "132"  # the default before the library found the order as it goes
FOUND = "0"
GOAL = 1.05
GROUP_NAMES = {"1": "box normals", "2": "plane", "3": "edges"}


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


class Results:
    """The tables of one sweep."""

    def __init__(self, folder):
        self.header, self.rows = self.read(os.path.join(folder, "order.csv"))
        _, self.axes = self.read(os.path.join(folder, "axes.csv"))
        self.by_key = {(r["scene"], r["size"], r["kernel"], r["accuracy"], r["axes"], r["order"]): r for r in self.rows}
        self.sizes = sorted({row["size"] for row in self.rows})
        self.size = self.sizes[len(self.sizes) // 2]
        self.kernels = list(dict.fromkeys(row["kernel"] for row in self.rows if row["kernel"] != "paper"))

    @staticmethod
    def read(path):
        with open(path, newline="", encoding="utf-8") as file:
            lines = file.read().splitlines()
        header = [line[2:].split(": ", 1) for line in lines if line.startswith("# ")]
        table = csv.DictReader(line for line in lines if not line.startswith("# "))
        keep = ("scene", "kernel", "accuracy", "axes", "order", "axis", "verdict")
        return dict(header), [{k: v if k in keep else number(v) for k, v in row.items()} for row in table]

    def scenes(self, size=None):
        return list(dict.fromkeys(row["scene"] for row in self.rows if row["size"] == (size or self.size)))

    def get(self, scene, kernel, accuracy="exact", axes="all", order=FIXED, size=None):
        """Choices of axes are timed in the default order: the one found, or in older results the fixed one."""
        key = (scene, size or self.size, kernel, accuracy, axes)
        return self.by_key.get((*key, order), self.by_key.get((*key, FOUND)) if axes != "all" else None)

    def cells(self):
        """Every scene, size, kernel and accuracy."""
        return list(dict.fromkeys((r["scene"], r["size"], r["kernel"], r["accuracy"]) for r in self.rows if r["kernel"] != "paper"))

    def orders(self, cell):
        return [self.by_key[(*cell, "all", order)] for order in ORDERS]

    def best(self, cell):
        return min(self.orders(cell), key=lambda row: row["ns"])


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "|".join(["---"] + ["---:"] * (len(head) - 1)) + "|"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def percent(value, digits=1):
    return "%.*f %%" % (digits, 100 * value)


def machine(r):
    h = r.header
    virtual = ", virtual" if h["virtual"] == "True" else ""
    return "\n".join(["- processor: %s%s; load average at the start: %s" % (h["processor"], virtual, h["load_average"]),
                      "- compiler: %s; %s" % (h["compiler"], h["flags"]),
                      "- commit: %s" % h["commit"],
                      "- command: `%s` (%s processes)" % (h["command"], h["processes"])])


def slowest(r, scene, kernel, accuracy="exact"):
    return max(r.orders((scene, r.size, kernel, accuracy)), key=lambda row: row["to_best"])


def worth(r, kernel, accuracy="exact"):
    """The least and the most that the choice of an order is worth, over all scenes."""
    ratios = sorted((slowest(r, scene, kernel, accuracy)["to_best"], scene) for scene in r.scenes())
    return "from %.2f (%s) to %.2f (%s) times the fastest" % (*ratios[0], *ratios[-1])


def times(r, kernel, accuracy):
    """Nanoseconds on every scene, by order. Bold: the fastest beyond the spread; a star: tied with the fastest."""
    own, last = r.get("paper", kernel, accuracy, order="312"), slowest(r, "paper", kernel, accuracy)
    text = "On `paper` the fastest order is %s; 312 takes %s times its time, the slowest, %s, %.2f times.\n" % (
        r.best(("paper", r.size, kernel, accuracy))["order"], "%.2f" % own["to_best"], last["order"], last["to_best"])
    text += "Over all scenes the slowest order takes %s.\n\n" % worth(r, kernel, accuracy)
    rows = []
    for scene in r.scenes():
        orders = r.orders((scene, r.size, kernel, accuracy))
        row = [scene, percent(orders[0]["hit_rate"])]
        row += [("**%.2f**" if o["verdict"] == "fastest" else "%.2f *" if o["verdict"] == "tied" else "%.2f") % o["ns"]
                for o in orders]
        rows.append(row + ["%.2f" % max(o["to_best"] for o in orders)])
    return text + table(["scene", "overlap", *ORDERS, "slowest over fastest"], rows)


def paper(r):
    return times(r, "paper", "fast")


def scalar(r):
    return times(r, "scalar", "exact")


def lanes(r):
    """What the order is worth with each number of lanes: the slowest over the fastest, and the fastest."""
    rows = []
    for scene in r.scenes():
        row = [scene]
        for kernel in r.kernels:
            cell = (scene, r.size, kernel, "exact")
            tied = [o["order"] for o in r.orders(cell) if o["verdict"] != "slower"]
            row.append("%.2f: %s" % (max(o["to_best"] for o in r.orders(cell)), "all" if len(tied) == 6 else " ".join(tied)))
        rows.append(row)
    names = ["%s, %d lane%s" % (k, r.get("paper", k)["lanes"], "" if k == "scalar" else "s") for k in r.kernels]
    worths = "\n".join("- %s: %s" % (name, worth(r, kernel)) for name, kernel in zip(names, r.kernels))
    text = "The slowest order takes, over all scenes:\n\n%s\n\n" % worths
    return text + "By scene, slowest over fastest, and the fastest and those tied with it:\n\n" + table(["scene", *names], rows)


def paper_order(r):
    """Where the edges first are the fastest beyond the spread, or no slower than any."""
    won, tied = [], 0
    for cell in r.cells():
        orders = {o["order"]: o for o in r.orders(cell)}
        first = [orders["312"], orders["321"]]
        others = [o for name, o in orders.items() if name not in ("312", "321")]
        if any(o["verdict"] != "slower" for o in first) and all(o["verdict"] == "slower" for o in others):
            won.append((cell, min(o["to_best"] for o in others)))
        tied += orders["312"]["verdict"] != "slower"
    text = "312 is the fastest or tied with it in %d of %d cells (scene x size x kernel x accuracy); " % (tied, len(r.cells()))
    text += "the edges first beat every other order in %d.\n\n" % len(won)
    by_scene = {}
    for (scene, _, kernel, _), gain in won:
        by_scene.setdefault(scene, {}).setdefault(kernel, []).append(gain)
    rows = [[scene, *("%d, up to %.2f" % (len(k[n]), max(k[n])) if n in k else "-" for n in r.kernels)]
            for scene, k in by_scene.items()]
    return text + table(["scene", *("%s: cells, times" % k for k in r.kernels)], rows) if rows else text.strip()


def boxes(r):
    """By the size of the box: the fastest order, and the time of 132 over its."""
    named = [(1.0 if s == "paper" else float(s[4:]), s) for s in r.scenes() if s == "paper" or s.startswith("box-")]
    rows = []
    for size, scene in sorted(named):
        row = ["%g" % size, percent(r.get(scene, "scalar")["hit_rate"], 2)]
        for kernel in r.kernels:
            best = r.best((scene, r.size, kernel, "exact"))
            row.append("%s: %.2f" % (best["order"], r.get(scene, kernel)["to_best"]))
        rows.append(row)
    return table(["box", "overlap", *("%s: best, 132 over it" % kernel for kernel in r.kernels)], rows)


def soup(r):
    """The same triangles in random and in spatial order, at every size."""
    rows = []
    most = r.sizes[-1]
    gains = [r.get("sparse", k, size=most)["ns"] / r.get("sorted", k, size=most)["ns"] for k in r.kernels]
    text = "At %d pairs the spatial order makes order 132 faster, by a factor of: %s.\n\n" % (
        most, ", ".join("%s %.2f" % pair for pair in zip(r.kernels, gains)))
    for size in r.sizes:
        for kernel in r.kernels:
            for scene in ("sparse", "sorted"):
                plain, paper = (r.get(scene, kernel, order=order, size=size) for order in (FIXED, "312"))
                rows.append(["%d" % size, kernel, scene, "%.2f" % plain["ns"], "%.2f" % paper["ns"], "%.1f" % plain["bytes"],
                             percent(plain["left_1"]), percent(paper["left_1"])])
    return text + table(["pairs", "kernel", "triangles", "132: ns", "312: ns", "132: bytes", "packets left by the box normals",
                  "by the edges"], rows)


def axes(r):
    """What each axis rejects of what the box normals leave, and what nothing else rejects."""
    wanted = [s for s in r.scenes() if s in ("paper", "box-0.1", "octree") or "." in s and not s.startswith("box-")]
    names = list(dict.fromkeys(row["axis"] for row in r.axes))[3:]
    rows = []
    for scene in wanted:
        found = {row["axis"]: row for row in r.axes if row["scene"] == scene and row["size"] == r.size}
        left = 1 - sum(found[axis]["first_132"] for axis in "xyz")
        for title, column in (("of those left", "no_box_normal_does"), ("alone, of all", "alone")):
            whole = left if column == "no_box_normal_does" else 1
            rows.append(["%s: %s" % (scene, title), percent(left), *("%.1f" % (100 * found[a][column] / whole) for a in names)])
    return table(["scene, percent", "left by the box normals", *names], rows)


def left_out(r):
    """False reports of each choice of axes, and the time it takes of that of all axes, on the widest kernel and the scalar one."""
    choices = ("box", "box+plane", "box+edges", "plane", "edges", "plane+edges")
    kernels = [r.kernels[0], "scalar"]
    rows = []
    for scene in r.scenes():
        row = [scene]
        for choice in choices:
            found = r.get(scene, kernels[0], axes=choice)
            ratios = [r.get(scene, k, axes=choice)["ns"] / r.get(scene, k)["ns"] for k in kernels]
            row.append("%.2f (%.2f, %.2f)" % (100 * found["unlike_exact"] / found["pairs"], *ratios))
        rows.append(row)
    return table(["scene", *choices], rows)


def left_by(r, scene, group):
    """Packets that a group leaves when it comes first: one lane, and the widest kernel."""
    order = {"1": "132", "2": "213", "3": "312"}[group]
    shares = (percent(r.get(scene, kernel, order=order)["left_1"], 0) for kernel in ("scalar", r.kernels[0]))
    return "%s %s / %s" % (GROUP_NAMES[group], *shares)


def default(r):
    """Where 132 is more than 5 % slower than the best: by how much at most, and which order is faster."""
    behind, cells = {}, r.cells()
    for cell in cells:
        plain = r.by_key[(*cell, "all", FIXED)]
        if plain["to_best"] > GOAL and plain["verdict"] == "slower":
            behind.setdefault(cell[0], {}).setdefault(cell[2], []).append((plain["to_best"], r.best(cell)["order"]))
    count = sum(len(found) for kernels in behind.values() for found in kernels.values())
    text = "Within 5 %% of the best, or no difference shown: %d of %d cells (scene x size x kernel x accuracy). The others:\n\n" % (
        len(cells) - count, len(cells))
    rows = []
    for scene, kernels in behind.items():
        row = [scene]
        for kernel in r.kernels:
            found = kernels.get(kernel)
            row.append("%d: up to %.2f, %s" % (len(found), *max(found)) if found else "-")
        ahead = max(max(found) for found in kernels.values())[1]
        same = "the same tests" if ahead[0] == "1" else left_by(r, scene, ahead[0])
        rows.append(row + [left_by(r, scene, "1"), same])
    head = ["scene", *r.kernels, "packets left, 1 lane / widest, by the", "instead by the"]
    return text + table(head, rows)


def found(r):
    """What the order found while walking takes, of the time of the best fixed one: least and most over accuracies, and the best."""
    cells = [cell for cell in r.cells() if cell[3] != "conservative"]
    if not any((*cell, "all", FOUND) in r.by_key for cell in cells):
        return "Not in the recorded run."
    goal = {size: GOAL if size >= 20000 else 1.1 for size in r.sizes}
    over = {cell: r.by_key[(*cell, "all", FOUND)]["to_best"] for cell in cells}
    texts = ["%d of %d at %d pairs" % (sum(over[c] <= goal[c[1]] for c in cells if c[1] == size),
                                       sum(c[1] == size for c in cells), size) for size in r.sizes]
    text = "Within 10 %% of the best fixed order at 800 pairs and 5 %% above: %s (scene x kernel x FAST, EXACT).\n\n" % ", ".join(texts)
    rows = []
    for scene in dict.fromkeys(cell[0] for cell in cells):
        row = [scene]
        for kernel in r.kernels:
            sizes = (max((over[c] for c in cells if c[:3] == (scene, size, kernel)), default=None) for size in r.sizes)
            row.append(" / ".join("-" if most is None else "%.2f" % most for most in sizes))
        rows.append(row)
    return text + table(["scene", *r.kernels], rows)


def baseline(r):
    """The scalar kernel against the paper's test, each in the same order."""
    rows, slower = [], 0
    for scene in r.scenes():
        found = [r.get(scene, "scalar", accuracy, order=o) for o in ("312", FIXED) for accuracy in ("fast", "exact")]
        slower += found[0]["to_paper_least"] > 1
        paper_ns = [r.get(scene, "paper", "fast", order=o)["ns"] for o in ("312", FIXED)]
        rows.append([scene, *("%.2f" % ns for ns in paper_ns), *("%.2f" % f["to_paper"] for f in found)])
    text = "FAST in order 312 is slower than the paper's test in order 312, beyond the spread, on %d of %d scenes.\n\n" % (
        slower, len(rows))
    head = ["scene", "paper 312: ns", "paper 132: ns", "FAST 312", "EXACT 312", "FAST 132", "EXACT 132"]
    return text + table(head, rows)


def reproduced(r, second):
    """Cells where a run shows one fastest order, and the other run another."""
    shown = differing = 0
    for cell in r.cells():
        for one, other in ((r, second), (second, r)):
            winner = one.best(cell)
            if winner["verdict"] == "fastest":
                shown += 1
                differing += other.best(cell)["order"] != winner["order"]
    return "Of %d cells in which a run shows one fastest order, the other run has another least time in %d." % (shown, differing)


BLOCKS = (machine, paper, scalar, lanes, paper_order, boxes, soup, axes, left_out, default, found, baseline)


def main():
    if len(sys.argv) not in (2, 3) or sys.argv[1].startswith("-"):
        sys.exit(__doc__.strip())
    first, *rest = [Results(folder) for folder in sys.argv[1:]]
    blocks = {block.__name__: block(first) for block in BLOCKS}
    if rest:
        blocks["reproduced"] = reproduced(first, rest[0])
    with open(FINDINGS, encoding="utf-8") as file:
        text = file.read()
    for name, block in blocks.items():
        pattern = r"(<!-- figures: %s -->\n).*?(<!-- end -->)" % name
        text, found = re.subn(pattern, lambda match, block=block: match.group(1) + block + "\n" + match.group(2), text, flags=re.S)
        if found != 1:
            sys.exit("order_summary: findings.md has %d blocks '%s' where one is needed" % (found, name))
    with open(FINDINGS, "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main()
