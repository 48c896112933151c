#!/usr/bin/env python3
"""workflows.py ROOT: the files for hosted CI are whole, and all that they run are scripts of the project, with what these take."""
import glob
import os
import re
import sys

try:
    import yaml
except ImportError:
    print("there is no yaml module (Debian: python3-yaml): skipped")
    sys.exit(77)

ROOT = sys.argv[1]
KEYS = {"file": {"name", True, "jobs"}, "job": {"strategy", "runs-on", "container", "defaults", "steps"}, "step": {"uses", "with", "run"}}
NEEDED = {"file": {"name", True, "jobs"}, "job": {"runs-on", "steps"}, "step": set()}  # YAML takes the word on for true
failures = []


def check(where, kind, what):
    if not isinstance(what, dict) or not NEEDED[kind] <= what.keys() <= KEYS[kind]:
        failures.append(f"{where}: a {kind} takes {KEYS[kind]} and needs {NEEDED[kind]}")
        return {}
    return what


def check_run(where, line):
    words = line.split()
    script = words[1] if words[0] == "sh" else words[0]
    path = os.path.join(ROOT, script)
    if not os.path.isfile(path) or (words[0] == script and not os.access(path, os.X_OK)):
        failures.append(f"{where}: {script} is no script of the project")
        return
    with open(path, encoding="utf-8") as file:
        text = file.read()
    for word in words[words.index(script) + 1:]:
        if script == ".ci/elsewhere" and f"\n{word})" not in text or script == ".ci/run" and f" {word}" not in text:
            failures.append(f"{where}: {script} knows no {word}")


def check_step(where, step):
    if ("uses" in step) == ("run" in step):
        failures.append(f"{where}: a step has either uses or run")
    if not re.fullmatch(r"[\w-]+/[\w-]+@v\d+", step.get("uses", "a/b@v1")):
        failures.append(f"{where}: {step['uses']} is no action of a version")
    for line in step.get("run", "").splitlines():
        check_run(where, line)


count = 0
for path in sorted(glob.glob(os.path.join(ROOT, ".github", "workflows", "*"))):
    name = os.path.basename(path)
    with open(path, encoding="utf-8") as file:
        text = file.read()
    if "No job of this file has ever run" not in text.splitlines()[0]:
        failures.append(f"{name}: its first line has to say that it is untried, until it is not")
    for of_job, job in check(name, "file", yaml.safe_load(text)).get("jobs", {}).items():
        where = f"{name}: {of_job}"
        job = check(where, "job", job)
        matrix = job.get("strategy", {}).get("matrix", {})
        for use in re.findall(r"\$\{\{(.*?)\}\}", str(job)):
            if use.strip().partition("matrix.")[2] not in matrix:
                failures.append(f"{where}: {use.strip()} is not in its matrix")
        for step in job.get("steps", []):
            check_step(where, check(where, "step", step))
            count += 1

print(*failures, sep="\n")
print(f"{count} steps, {len(failures)} faults")
sys.exit(bool(failures) or not count)
