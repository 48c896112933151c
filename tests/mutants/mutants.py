#!/usr/bin/env python3
"""Mutants: faults put into the source one at a time, each of which the default tests have to catch. The faults: mutants.txt.

Works on copies of the tree in a temporary folder. Ends with 0 if the tests catch every mutant but those that the list explains;
with 1 if one survives without a reason, or is caught in spite of one; with 2 if the suite itself is at fault: a text that is not
found, a mutant that does not build, tests that fail without any.
"""
import argparse
import collections
import concurrent.futures
import contextlib
import dataclasses
import fnmatch
import json
import math
import os
import queue
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

FOLDER = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(FOLDER))
SUITES = ("exact", "kernels", "voxels", "inputs")
SKIPPED = 77
NINJA = os.environ.get("NINJA", "ninja")
WALL_LIMIT = 1800  # seconds for one build or test; the machine may be busy otherwise

# Most tests look at a mutant for a moment only: compiled fast is better than running fast, and no inlining is forced (kernel.h).
SETUP = ["--buildtype", "plain", "-Doptimization=1", "-Dc_args=-U__OPTIMIZE__", "-Ddefault_library=static", "-Dtests=enabled",
         "-Dtools=disabled", "-Dbench=disabled"]


class SuiteError(Exception):
    """The list, the tree or the machine is at fault, and not the tests."""


# The list.


@dataclasses.dataclass
class Mutant:
    name: str
    path: str
    old: str = ""
    new: str = ""
    needs: str = ""  # a test that must not be skipped here
    reason: str = ""  # why no test can catch it


FIELDS = {"- ": "old", "+ ": "new", "needs ": "needs", "survives ": "reason"}


def read_list(path):
    mutants = []
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            line = line.rstrip()
            header = re.fullmatch(r"([a-z0-9-]+): (\S+)", line)
            prefix = next(filter(line.startswith, FIELDS), None)
            if header:
                mutants.append(Mutant(*header.groups()))
            elif prefix and mutants:
                field = FIELDS[prefix]
                joined = getattr(mutants[-1], field) + "\n" + line[len(prefix):]
                setattr(mutants[-1], field, joined.strip())
            elif line and not line.startswith("#"):
                raise SuiteError(f"{path}:{number}: neither 'name: file' nor one of {', '.join(map(repr, FIELDS))}: {line}")
    counts = collections.Counter(mutant.name for mutant in mutants)
    for mutant in mutants:
        if not mutant.old or counts[mutant.name] > 1:
            raise SuiteError(f"{path}: mutant '{mutant.name}' needs a name of its own and a text to find, in a line '- '")
    return mutants


def mutated(mutant, text):
    """The text with the fault in it. How the lines of the list and of the text are broken does not matter."""
    pattern = r"\s+".join(map(re.escape, mutant.old.split()))
    places = len(re.findall(pattern, text))
    if places != 1:
        raise SuiteError(f"{mutant.path} has the text {places} times, and should have it once: {mutant.old}")
    return re.sub(pattern, lambda _: mutant.new, text)


# A copy of the tree, its build, and the tests in it.


@dataclasses.dataclass
class Test:
    name: str
    command: list
    folder: str
    environment: dict


def run(command, output=subprocess.DEVNULL, **how):
    """The exit status, or None if it took too long."""
    try:
        return subprocess.run(command, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT, check=False, **how).returncode
    except subprocess.TimeoutExpired:
        return None


def not_source(folder, names):
    return [name for name in names if name == ".git" or os.path.exists(os.path.join(folder, name, "meson-private"))]


class Site:
    """A copy of the tree with a build of its own, in which one mutant at a time is tried."""

    def __init__(self, folder, threads):
        self.root, self.build, self.threads = os.path.join(folder, "tree"), os.path.join(folder, "build"), threads
        shutil.copytree(ROOT, self.root, ignore=not_source)
        with open(os.path.join(folder, "log"), "w+", encoding="utf-8") as log:
            # In a folder of its own: CMake, which meson asks about itself, cannot run twice in one.
            if run(["meson", "setup", *SETUP, self.build, self.root], log, cwd=folder) != 0 or not self.compiles(log):
                log.seek(0)
                raise SuiteError("the tree does not build:\n" + "".join(log.readlines()[-20:]))
        self.tests = self.list_tests()

    def compiles(self, output=subprocess.DEVNULL):
        return run([NINJA, "-C", self.build, f"-j{self.threads}"], output, timeout=WALL_LIMIT) == 0

    def list_tests(self):
        listed = subprocess.run(["meson", "introspect", "--tests", self.build], check=True, capture_output=True).stdout
        drop = ("TRIBOX_TEST_SEED", "TRIBOX_MESHES")
        clean = {key: value for key, value in os.environ.items() if key not in drop}
        return {test["name"]: Test(test["name"], test["cmd"], test["workdir"] or self.build, {**clean, **test["env"]})
                for test in json.loads(listed) if {suite.split(":")[-1] for suite in test["suite"]} & set(SUITES)}

    def status(self, name, seconds):
        """The exit status of a test; below zero where a signal ended it, such as SIGXCPU after so many seconds of processor time."""
        test = self.tests[name]
        limited = ["sh", "-c", 'ulimit -t "$0"; exec "$@"', str(seconds), *test.command]
        return run(limited, cwd=test.folder, env=test.environment, timeout=WALL_LIMIT)

    @contextlib.contextmanager
    def with_mutant(self, mutant):
        path = os.path.join(self.root, mutant.path)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        write(path, mutated(mutant, text))
        try:
            yield
        finally:
            write(path, text)


def write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


class Tests:
    """Which tests to run, for how long, and in which order: those first that caught most mutants in the least time."""

    def __init__(self, site):
        self.seconds, self.catches, self.lock = {}, collections.Counter(), threading.Lock()
        for name in site.tests:
            start = time.monotonic()
            status = site.status(name, WALL_LIMIT)
            if status == 0:
                self.seconds[name] = time.monotonic() - start
            elif status != SKIPPED:
                raise SuiteError(f"the test '{name}' fails without any mutant")

    def in_order(self):
        with self.lock:
            return sorted(self.seconds, key=lambda name: self.seconds[name] / (1 + self.catches[name]))

    def catcher(self, site):
        """The first test that fails or hangs, or None."""
        for name in self.in_order():
            status = site.status(name, 20 + 10 * math.ceil(self.seconds[name]))
            if status not in (0, SKIPPED):
                with self.lock:
                    self.catches[name] += 1
                return name + (", which hangs" if status in (None, -signal.SIGXCPU, -signal.SIGKILL) else "")
        return None


# Verdicts.

CAUGHT, EXPLAINED, SKIPPED_HERE = "caught", "survives, as explained", "skipped"
SURVIVED, CAUGHT_AFTER_ALL, BROKEN = "SURVIVED", "CAUGHT AFTER ALL", "BROKEN"


def judge(site, tests, mutant):
    if mutant.needs and mutant.needs not in tests.seconds:
        return SKIPPED_HERE, f"as the test '{mutant.needs}' is"
    try:
        with site.with_mutant(mutant):
            if not site.compiles():
                return BROKEN, "does not build"
            catcher = tests.catcher(site)
    except SuiteError as error:
        return BROKEN, str(error)
    if catcher:
        return (CAUGHT_AFTER_ALL if mutant.reason else CAUGHT), f"by {catcher}"
    return (EXPLAINED, "") if mutant.reason else (SURVIVED, f"in {mutant.path}: {mutant.old}")


def show_progress(done, count, start):
    """On a terminal, a line that the next result overwrites."""
    if sys.stdout.isatty():
        left = (time.monotonic() - start) / done * (count - done) / 60
        print(f"{done} of {count}, about {left:.0f} min left", end="\r", flush=True)


def judge_all(folder, mutants, jobs):
    """Judges the mutants in as many sites as there are jobs. Returns how many came to each verdict."""
    count = min(jobs, len(mutants))
    print(f"building {'a copy' if count == 1 else f'{count} copies'} of the tree in {folder}", flush=True)
    with concurrent.futures.ThreadPoolExecutor(count) as pool:
        sites = list(pool.map(lambda k: Site(os.path.join(folder, str(k)), max(1, jobs // count)), range(count)))
        print("running the tests without a mutant", flush=True)
        tests = Tests(sites[0])
        free = queue.SimpleQueue()
        for site in sites:
            free.put(site)

        def judge_in_a_free_site(mutant):
            site = free.get()
            try:
                return judge(site, tests, mutant)
            finally:
                free.put(site)

        verdicts, start = collections.Counter(), time.monotonic()
        try:
            for mutant, (verdict, detail) in zip(mutants, pool.map(judge_in_a_free_site, mutants)):
                verdicts[verdict] += 1
                print(f"{verdict:<8} {mutant.name}: {detail}".rstrip(": "), flush=True)
                show_progress(sum(verdicts.values()), len(mutants), start)
        except KeyboardInterrupt:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return verdicts


def parse_arguments():
    parser = argparse.ArgumentParser(description="Puts the faults of mutants.txt into the source, one at a time, and runs the tests.")
    parser.add_argument("--only", metavar="PATTERN", nargs="+", default=["*"], help="only the mutants of these names, such as 'axis-*'")
    parser.add_argument("--list", action="store_true", help="print the mutants, look for their texts, and change nothing")
    parser.add_argument("--keep", action="store_true", help="keep the copies of the tree and their builds")
    parser.add_argument("--jobs", type=int, default=2, metavar="N", help="mutants tried at a time (default: 2)")
    arguments = parser.parse_args()
    if arguments.jobs < 1:
        parser.error("--jobs must be 1 or more")
    return arguments


def check_texts(mutants):
    """Every text is in the tree, and once: looked at before anything is built."""
    texts, faults = {}, []
    for mutant in mutants:
        try:
            if mutant.path not in texts:
                with open(os.path.join(ROOT, mutant.path), encoding="utf-8") as file:
                    texts[mutant.path] = file.read()
            mutated(mutant, texts[mutant.path])
        except (OSError, SuiteError) as error:
            faults.append(f"{mutant.name}: {error}")
    if faults:
        raise SuiteError("the source has moved away from the list; these entries need its texts of today:\n  " + "\n  ".join(faults))


def print_list(mutants):
    for mutant in mutants:
        print(f"{mutant.name}: {mutant.path}")
        if mutant.reason:
            print("    survives:", " ".join(mutant.reason.split()))


def main():
    arguments = parse_arguments()
    mutants = [mutant for mutant in read_list(os.path.join(FOLDER, "mutants.txt"))
               if any(fnmatch.fnmatch(mutant.name, pattern) for pattern in arguments.only)]
    if not mutants:
        raise SuiteError(f"no mutant is called {' or '.join(arguments.only)}; --list prints the names")
    if arguments.list:
        print_list(mutants)
    check_texts(mutants)
    if arguments.list:
        return 0
    folder = tempfile.mkdtemp(prefix="tribox-mutants-")
    try:
        verdicts = judge_all(folder, mutants, arguments.jobs)
    finally:
        if not arguments.keep:
            shutil.rmtree(folder, ignore_errors=True)
    print(f"{len(mutants)} mutants:", ", ".join(f"{count} {verdict}" for verdict, count in verdicts.items()))
    return 2 if verdicts[BROKEN] else 1 if verdicts[SURVIVED] or verdicts[CAUGHT_AFTER_ALL] else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except SuiteError as error:
        print(f"mutants: {error}", file=sys.stderr)
        sys.exit(2)
