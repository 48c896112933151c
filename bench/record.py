#!/usr/bin/env python3
"""Asks questions of tribox-bench in ten processes each, and records the tables: record.py BUILD OUT [MESH ...].

A figure that differs is the median of the processes, with the least and the most in brackets. A column *_least has the least.
OUT.json has what each process said.
"""
import argparse
import json
import os
import statistics
import subprocess

QUESTIONS = (("ratios --rounds 7", False), ("sweep --quick", False), ("voxels --quick", False), ("index --quick", False),
             ("ratios --rounds 7", True), ("sweep --quick --no-scenes", True), ("voxels --quick --no-scenes", True),
             ("index --quick", True))


DROPPED = ("rounds", "from", "to", "scene", "triangles")  # within one process, or in the title


def ask(words):
    return json.loads(subprocess.run(words, stdout=subprocess.PIPE, check=True).stdout)


def figure(number):
    return f"{number:.3g}" if abs(number) < 1000 else f"{number:.0f}"


def cell(name, values):
    """One figure of all processes."""
    if any(value is None or isinstance(value, str) for value in values) or len(set(values)) == 1:
        value = values[0]
        return "-" if value is None else value if isinstance(value, str) else figure(value)
    if name.endswith("_least"):
        return figure(min(values))
    return f"{figure(statistics.median(values))} ({figure(min(values))} to {figure(max(values))})"


def merged(tables):
    """The lines of one table, which each process made."""
    yield "\n" + tables[0].get("title", "")
    names = [name for name in tables[0]["rows"][0] if not name.endswith("_quartile") and name not in DROPPED]
    rows = [[cell(name, [row.get(name) for row in same]) for name in names] for same in zip(*(table["rows"] for table in tables))]
    widths = [max(map(len, column)) for column in zip(names, *rows)]
    for row in (names, *rows):
        yield "  ".join(text.ljust(width) for text, width in zip(row, widths)).rstrip()


def disturbed(answers):
    """How many rows have a median time more than a tenth above their least, in the middle of the processes; of how many."""
    marks = []
    for runs in answers:
        for tables in zip(*([table["rows"] for table in run["tables"] if "rows" in table] for run in runs)):
            for same in zip(*tables):
                if "ns_least" in same[0]:
                    median, least = (statistics.median(row[name] for row in same) for name in ("ns_median", "ns_least"))
                    marks.append(median > 1.1 * least)
    return sum(marks), len(marks)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build")
    parser.add_argument("out")
    parser.add_argument("meshes", nargs="*", metavar="MESH")
    parser.add_argument("--processes", type=int, default=10)
    arguments = parser.parse_args()
    asked = [[f"{arguments.build}/bench/tribox-bench", *words.split(), "--json", *(arguments.meshes if meshes else ())]
             for words, meshes in QUESTIONS if arguments.meshes or not meshes]
    # In turns, so that what disturbs for some minutes disturbs a few processes of each question.
    answers = list(zip(*([ask(words) for words in asked] for _ in range(arguments.processes))))
    with open(arguments.out + ".json", "w", encoding="utf-8") as file:
        json.dump(answers, file)
    with open(arguments.out, "w", encoding="utf-8") as file:
        first = answers[0][0]
        for name in ("processor", "compiler", "flags", "commit", "limits"):
            print(f"{name}: {first[name]}", file=file)
        on = f"{len(os.sched_getaffinity(0))} of {os.cpu_count()} processors"
        print(f"processes: {arguments.processes} a table, on {on}; median (least to most) of them", file=file)
        print("disturbed: {} of {} rows with both times; there the least is to be trusted".format(*disturbed(answers)), file=file)
        for words, runs in zip(asked, answers):
            print(f"\n== {' '.join(word for word in words[1:] if word != '--json')}", file=file)
            # A table without rows says how many were disturbed, and is not in every process.
            for tables in zip(*([table for table in run["tables"] if "rows" in table] for run in runs)):
                if any(table["rows"] != tables[0]["rows"] for table in tables):  # not counts alone
                    print("\n".join(merged(tables)), file=file)


if __name__ == "__main__":
    main()
