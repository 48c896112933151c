"""The tables of findings.md, of the rows that order_join.py makes: of the first size, at EXACT where no accuracy is named."""

from order_join import DEFAULT, ORDERS

CHOICES = ("box", "box+plane", "box+edges", "plane", "edges", "plane+edges")


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---" + "|---:" * (len(head) - 1) + "|"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


class Rows:
    """The rows of one size."""

    def __init__(self, rows):
        first = [row for row in rows if row["size"] == rows[0]["size"]]
        self.scenes = list(dict.fromkeys(row["scene"] for row in first))
        self.kernels = list(dict.fromkeys(row["kernel"] for row in first if row["kernel"] != "paper"))
        self.by_key = {(row["scene"], row["kernel"], row["accuracy"], row["axes"], row["order"]): row for row in first}

    def get(self, scene, kernel, order=DEFAULT, axes="all"):
        return self.by_key[(scene, kernel, "fast" if kernel == "paper" else "exact", axes, order)]


def times(rows, kernel):
    """The nanoseconds of the fixed order with the least median, and each order's time over it, process by process."""
    orders = ORDERS if kernel == "paper" else (DEFAULT, *ORDERS)
    lines = []
    for scene in rows.scenes:
        best = min((rows.get(scene, kernel, order) for order in ORDERS), key=lambda row: row["ns"])
        ratios = ["%.2f" % rows.get(scene, kernel, order)["to_best"] for order in orders]
        lines.append([scene, "%.1f %%" % (100 * best["hit_rate"]), "%.2f" % best["ns"], *ratios])
    head = ["the default" if order == DEFAULT else str(order) for order in orders]
    return table(["scene", "overlap", "least median: ns", *head], lines)


def left(rows):
    """The share of the packets of each kernel in which a pair is left after the first group."""
    lines = []
    for scene in rows.scenes:
        shares = [" / ".join("%.0f" % (100 * rows.get(scene, kernel, order)["left_1"]) for kernel in rows.kernels)
                  for order in (123, 213, 312)]
        lines.append([scene, *shares])
    return table(["scene", "box normals first", "plane first", "edges first"], lines)


def left_out(rows):
    """Of each choice of axes the pairs that are reported and do not overlap, and its time over that of all axes."""
    lines = []
    for scene in rows.scenes:
        cells = []
        for axes in CHOICES:
            row, whole = (rows.get(scene, rows.kernels[0], axes=choice) for choice in (axes, "all"))
            cells.append("%.2f (%.2f)" % (100 * row["unlike_exact"] / row["pairs"], row["ns"] / whole["ns"]))
        lines.append([scene, *cells])
    return table(["scene", *CHOICES], lines)


def all_tables(rows):
    found = Rows(rows)
    times_of = [times(found, kernel) for kernel in (found.kernels[0], "scalar", "paper")]
    return "\n".join([*times_of, left(found), left_out(found)])
