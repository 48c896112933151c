"""Joins what several processes measured of the same scenes: medians, the range between processes, and who is the fastest.

The figure of a process is the least of its rounds: other work on the machine only ever adds to a time.
"""

import statistics

ORDERS = (123, 132, 213, 231, 312, 321)
DEFAULT = 0  # the order that the library finds as it goes
ALL_AXES = 7
GROUPS = {1: "box", 2: "plane", 4: "edges"}
LEAST_DIFFERENCE = 1.01  # a smaller ratio does not count as a difference, however small the spread


def axes_word(axes):
    return "all" if axes == ALL_AXES else "+".join(word for bit, word in GROUPS.items() if axes & bit)


def middle(sizes):
    return sorted(sizes)[len(sizes) // 2]


class Spread:
    """A figure of each process: the median, and the range between processes."""

    def __init__(self, values):
        self.median, self.least, self.most = statistics.median(values), min(values), max(values)


def key_of(entrant):
    """What makes an entrant the same in every process."""
    return tuple(entrant[name] for name in ("kernel", "accuracy", "axes", "order"))


def paper_key(order):
    """The paper's test, whose arithmetic is that of FAST and whose order is fixed."""
    return ("paper", "fast", ALL_AXES, 132 if order == DEFAULT else order)


class Scene:
    """One scene at one size, as every process measured it."""

    def __init__(self, size, runs):
        first = runs[0]
        self.name, self.what, self.size, self.why = first["scene"], first["what"], size, first
        self.entrants = {key_of(e): e for e in first["entrants"]}
        self.processes = [{key_of(e): min(e["ns_per_pair"]) for e in run["entrants"]} for run in runs]

    def time(self, key):
        return Spread([process[key] for process in self.processes])

    def ratio(self, key, to):
        """The time of one over that of another, process by process."""
        return Spread([process[key] / process[to] for process in self.processes])

    def kernels(self):
        return list(dict.fromkeys(key[0] for key in self.entrants if key[0] != "paper"))

    def best(self, kernel, accuracy):
        return min(((kernel, accuracy, ALL_AXES, order) for order in ORDERS), key=lambda key: self.time(key).median)

    def is_slower(self, key, than):
        """Every process says so, and by more than the least difference."""
        return self.ratio(key, than).least > LEAST_DIFFERENCE

    def verdict(self, key):
        """fastest: all other orders are slower; tied: no difference from the least median is shown; slower."""
        best = self.best(*key[:2])
        if key != best:
            return "slower" if self.is_slower(key, best) else "tied"
        others = ((*key[:3], order) for order in ORDERS if order != key[3])
        return "fastest" if all(self.is_slower(other, key) for other in others) else "tied"


def share(part, whole):
    return part / whole if whole else 0.0


def why_columns(scene, key):
    """The counts that explain an order's time at its number of lanes."""
    why = scene.why
    order = next(o for o in why["orders"] if o["order"] == key[3])
    lanes = next(w for w in order["lanes"] if w["lanes"] == scene.entrants[key]["lanes"])
    columns = {"left_%d" % (k + 1): share(left, lanes["packets"]) for k, left in enumerate(lanes["packets_left"])}
    columns["bytes"] = share(lanes["bytes"], why["pairs"])
    columns.update({"first_" + name: share(n, why["pairs"]) for name, n in zip(why["axes"]["names"], order["first"])})
    return columns


def row_of(scene, key):
    """A line of order.csv."""
    kernel, accuracy, axes, order = key
    entrant, why = scene.entrants[key], scene.why
    row = {"scene": scene.name, "size": scene.size, "pairs": why["pairs"], "hit_rate": share(why["overlapping"], why["pairs"]),
           "kernel": kernel, "lanes": entrant["lanes"], "accuracy": accuracy, "axes": axes_word(axes), "order": order}
    figures = {"ns": scene.time(key), "to_312": scene.ratio(key, (kernel, accuracy, ALL_AXES, 312)),
               "to_best": scene.ratio(key, scene.best(kernel, accuracy)), "to_paper": scene.ratio(key, paper_key(order))}
    for name, spread in figures.items():
        row.update({name: spread.median, name + "_least": spread.least, name + "_most": spread.most})
    row["verdict"] = scene.verdict(key) if axes == ALL_AXES else ""
    row.update({name: entrant.get(name, "") for name in ("reported", "unlike_exact", "undecided")})
    if axes == ALL_AXES and order != DEFAULT:
        row.update(why_columns(scene, key))
    return row


def axes_rows(scene):
    """The lines of axes.csv: what each axis rejects, as shares of the pairs."""
    why, pairs = scene.why, scene.why["pairs"]
    for i, axis in enumerate(why["axes"]["names"]):
        row = {"scene": scene.name, "size": scene.size, "axis": axis}
        row.update({name: share(why["axes"][name][i], pairs) for name in ("separates", "no_box_normal_does", "alone")})
        row.update({"first_%d" % order["order"]: share(order["first"][i], pairs) for order in why["orders"]})
        yield row
