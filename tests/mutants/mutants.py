#!/usr/bin/env python3
"""Mutants: faults put into the source one at a time, each of which the tests have to catch. The faults: mutants.txt.

Works on copies of the tree in a temporary folder. Ends with 0 if the tests catch every fault, 1 if one survives, 2 if the suite
itself is at fault: a text that is not found, a fault that does not build, tests that fail without any.
"""
import argparse
import collections
import concurrent.futures
import dataclasses
import fnmatch
import itertools
import json
import math
import os
import platform
import queue
import random
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
SUITES = ("counts", "exact", "calls", "kernels", "voxels", "inputs", "index", "doubles", "scale", "read")
SHORTENED = {"exact", "voxels", "index", "scale", "doubles", "shortened"}  # whose programs take --short: a tenth of the pairs
ROOMS = ("src", os.path.join("tools", "read"), os.path.join("tools", "console"))
SKIPPED = 77
NINJA = os.environ.get("NINJA", "ninja")
NARROW = {"x86_64": ("sse2", "sse")}  # a kernel besides the scalar one, and its folder: these two show most faults
WALL_LIMIT = 1800  # seconds for one build or test; the machine may be busy otherwise

# Most tests look at a fault for a moment only: compiled fast is better than running fast, and no inlining is forced (kernel.h).
SETUP = ["--buildtype", "plain", "-Doptimization=1", "-Dc_args=-U__OPTIMIZE__", "-Ddefault_library=static", "-Dtests=enabled",
         "-Dembree=disabled", "-Dtools=disabled", "-Dbench=disabled", "-Dpython=disabled"]


class SuiteError(Exception):
    """The list, the tree or the machine is at fault, and not the tests."""


# The list.


@dataclasses.dataclass
class Mutant:
    name: str
    path: str
    function: str  # "" for the whole file
    old: str  # stands once in it
    new: str
    needs: str  # a test that must not be skipped here, or ""


def expanded(text):
    """The text for every i and j that it names in braces: {i} and {j} run over 0, 1, 2."""
    letters = [letter for letter in "ij" if "{" + letter + "}" in text]
    for numbers in itertools.product("012", repeat=len(letters)):
        one = text
        for letter, number in zip(letters, numbers):
            one = one.replace("{" + letter + "}", number)
        yield one


class Sources:
    """The files of src/ and of the readers, found by what they define: a file that moves takes its faults along."""

    def __init__(self):
        self.text = {}
        for room in ROOMS:
            for folder, _, names in os.walk(os.path.join(ROOT, room)):
                for name in names:
                    if name.endswith((".c", ".h")):
                        with open(os.path.join(folder, name), encoding="utf-8") as file:
                            self.text[os.path.relpath(os.path.join(folder, name), ROOT)] = file.read()

    def path_of(self, base, function):
        """The one file of that name, or the one that defines the function, in src/ before others; several are as good as none."""
        paths = [path for path, text in self.text.items()
                 if (not base or os.path.basename(path) == base) and (not function or starts_of(function, text))]
        paths = [path for path in paths if path.startswith("src")] or paths
        if len(paths) == 1:
            return paths[0]
        what = ": ".join(filter(None, (base, function)))
        raise SuiteError(f"there is {what} in {len(paths)} files{': ' + ', '.join(sorted(paths)) if paths else ''}; "
                         "name the place as it is called today, as FUNCTION, FILE or FILE: FUNCTION")


def read_list(path, sources):
    mutants, place, old, needs, lost = [], None, None, "", []
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            line = line.rstrip()
            header = re.fullmatch(r"(?:(\w+\.[ch])(?:: )?)?(\w+)?(?: needs (.+))?", line) if line else None
            fault = re.fullmatch(r"\+ ([a-z0-9{}-]+):(?: (.*))?", line)
            if header:
                base, function, needs = header.groups(default="")
                place, old = None, None
                try:
                    place = sources.path_of(base, function), function
                except SuiteError as error:
                    lost.append(f"{path}:{number}: {error}")
            elif line.startswith("- ") and place:
                old = line[2:]
            elif fault and old:
                for one in expanded(line):
                    name, new = re.fullmatch(r"\+ ([a-z0-9-]+):(?: (.*))?", one).groups(default="")
                    mutants.append(Mutant(name, *place, old, new.replace("@", old), needs))
            elif line and not line.startswith("#") and not lost:
                raise SuiteError(f"{path}:{number}: neither a place, a text '- ' nor a fault '+ name: ' below one: {line}")
    if lost:
        raise SuiteError("\n".join(lost))
    for name, count in collections.Counter(mutant.name for mutant in mutants).items():
        if count > 1:
            raise SuiteError(f"{path}: {count} faults are called '{name}'; give each a name of its own")
    return mutants


def starts_of(function, text):
    """Where a function is defined, and not only declared."""
    return [found.start() for found in re.finditer(rf"^\w[^;\n]*\b{function}\(", text, re.M)
            if not re.match(r"[^;{]*;", text[found.start():])]


def extent_of(function, text, path):
    """From the line with its name to the first line that is a closing brace alone, or ends its line."""
    starts = starts_of(function, text)
    if len(starts) != 1:
        raise SuiteError(f"{path} defines {function}() {len(starts)} times, and should once")
    line_end = text.index("\n", starts[0])
    if text[starts[0]:line_end].endswith("}"):
        return starts[0], line_end
    return starts[0], text.index("\n}", starts[0])


def mutated(mutant, text):
    """The text of the file with the fault in it. How lines are broken does not matter."""
    start, end = extent_of(mutant.function, text, mutant.path) if mutant.function else (0, len(text))
    pattern = r"\s+".join(map(re.escape, mutant.old.split()))
    part = text[start:end]
    places = len(re.findall(pattern, part))
    if places != 1:
        where = f"{mutant.function}() of {mutant.path}" if mutant.function else mutant.path
        raise SuiteError(f"{where} has the text {places} times, and should have it once: {mutant.old}")
    return text[:start] + re.sub(pattern, lambda _: mutant.new, part) + text[end:]


# A copy of the tree, its build, and the tests in it.


@dataclasses.dataclass
class Test:
    name: str
    command: list
    folder: str
    environment: dict
    full: list  # the command at length where `command` is the short form; else empty


def run(command, output=subprocess.DEVNULL, **how):
    """The exit status, or None if it took too long."""
    try:
        return subprocess.run(command, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT, check=False,
                              **how).returncode
    except subprocess.TimeoutExpired:
        return None


def not_source(folder, names):
    return [name for name in names if name == ".git" or os.path.exists(os.path.join(folder, name, "meson-private"))]


class Site:
    """A copy of the tree with a build of its own, in which one fault at a time is tried; kernels: of those, or "" of all."""

    def __init__(self, folder, threads, kernels):
        self.root, self.build, self.threads = os.path.join(folder, "tree"), os.path.join(folder, "build"), threads
        shutil.copytree(ROOT, self.root, ignore=not_source)
        os.environ.setdefault("CCACHE_BASEDIR", os.path.dirname(folder))  # where there is one: copies share what is compiled
        os.environ.setdefault("CCACHE_NOHASHDIR", "1")
        self.share_library()
        self.make(["meson", "setup", *SETUP, f"-Dkernels={kernels}", self.build, self.root])

    def make(self, setup):
        folder = os.path.dirname(self.build)
        with open(os.path.join(folder, "log"), "w+", encoding="utf-8") as log:
            # In a folder of its own: CMake, which meson asks about itself, cannot run twice in one.
            if run(setup, log, cwd=folder) != 0 or not self.compiles(output=log):
                log.seek(0)
                raise SuiteError("the tree does not build:\n" + "".join(log.readlines()[-20:]))
        self.tests = self.list_tests()

    def share_library(self):
        """The library that tests look into becomes a shared one: a fault then links it alone, and not some hundred programs."""
        path = os.path.join(self.root, "src", "meson.build")
        with open(path, encoding="utf-8") as file:
            text = file.read()
        text = text.replace("static_library('tribox_inside'", "shared_library('tribox_inside'")
        text = text.replace("gnu_symbol_visibility: 'hidden'", "gnu_symbol_visibility: 'default'")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)

    def compiles(self, *targets, output=subprocess.DEVNULL):
        return run([NINJA, "-C", self.build, f"-j{self.threads}", *targets], output, timeout=WALL_LIMIT) == 0

    def list_tests(self):
        listed = subprocess.run(["meson", "introspect", "--tests", self.build], check=True, capture_output=True).stdout
        drop = ("TRIBOX_TEST_SEED", "TRIBOX_MESHES")
        clean = {key: value for key, value in os.environ.items() if key not in drop}
        tests = {}
        for test in json.loads(listed):
            suites = {suite.split(":")[-1] for suite in test["suite"]}
            if suites & set(SUITES):
                has_short = bool(suites & SHORTENED) and "--short" not in test["cmd"]
                tests[test["name"]] = Test(test["name"], test["cmd"] + ["--short"] * has_short, test["workdir"] or self.build,
                                           {**clean, **test["env"]}, test["cmd"] if has_short else [])
        return tests

    def status(self, name, seconds, at_length=False):
        """The exit status of a test; below zero where a signal ended it, such as SIGXCPU after that much processor time."""
        test = self.tests[name]
        limited = ["sh", "-c", 'ulimit -t "$0"; exec "$@"', str(seconds), *(test.full if at_length else test.command)]
        return run(limited, cwd=test.folder, env=test.environment, timeout=WALL_LIMIT)

    def programs_of(self, name):
        """What has to be built before a test runs: the parts of its command that lie in the build."""
        inside = (os.path.relpath(word, self.build) for word in self.tests[name].command if os.path.isabs(word))
        return [path for path in inside if not path.startswith("..")]

    def write(self, mutant, text):
        with open(os.path.join(self.root, mutant.path), "w", encoding="utf-8") as file:
            file.write(text)


def source_of(mutant):
    with open(os.path.join(ROOT, mutant.path), encoding="utf-8") as file:
        return file.read()


class Tests:
    """Which tests to run, for how long, and in which order: those first that caught most faults in the least time, of this function
    above all, then of this file, then of its folder, then of any."""

    def __init__(self, sites, pool):
        self.seconds, self.catches, self.lock = {}, collections.defaultdict(collections.Counter), threading.Lock()
        self.at_length = set()  # those whose long form caught a fault: it has to pass without any, too
        names = list(sites[0].tests)
        list(pool.map(lambda k: [self.time(sites[k], name) for name in names[k::len(sites)]], range(len(sites))))

    def time(self, site, name):
        start = time.monotonic()
        status = site.status(name, WALL_LIMIT)
        if status == 0:
            self.seconds[name] = time.monotonic() - start
        elif status != SKIPPED:
            raise SuiteError(f"the test '{name}' fails without any fault")

    def check_lengths(self, site):
        """Once all faults are out again: a long form that caught one is no use if it always fails."""
        for name in sorted(self.at_length):
            if not site.compiles(*site.programs_of(name)) or site.status(name, WALL_LIMIT, at_length=True) not in (0, SKIPPED):
                raise SuiteError(f"the test '{name}' fails without any fault")

    @staticmethod
    def neighbourhoods(mutant):
        return {mutant.path + ":" + mutant.function: 30, mutant.path: 10, os.path.dirname(mutant.path): 3, "": 1}

    def in_order(self, mutant):
        with self.lock:
            def cost(name):
                caught = sum(weight * self.catches[place][name] for place, weight in self.neighbourhoods(mutant).items())
                return (self.seconds[name] + 0.1) / (1 + caught)
            return sorted(self.seconds, key=cost)

    def fails(self, site, mutant, name, at_length=False):
        if not site.compiles(*site.programs_of(name)):
            raise SuiteError("does not build")
        seconds = math.ceil(self.seconds[name]) * (20 if at_length else 1)
        status = site.status(name, 20 + 10 * seconds, at_length)
        if status in (0, SKIPPED):
            return None
        with self.lock:
            if at_length:
                self.at_length.add(name)
            for place in self.neighbourhoods(mutant):
                self.catches[place][name] += 1
        return name + " at length" * at_length + (", which hangs" if status in (None, -signal.SIGXCPU, -signal.SIGKILL) else "")

    def catcher(self, site, mutant, is_last):
        """The first test that fails or hangs, or None: short forms first, long ones in the last round. Each is built when its turn
        comes, as most faults are caught by the first few."""
        for at_length in (False, True)[:1 + is_last]:
            for name in self.in_order(mutant):
                if (not at_length or site.tests[name].full) and (caught := self.fails(site, mutant, name, at_length)):
                    return caught
        return None


# Verdicts.

CAUGHT, SKIPPED_HERE, SURVIVED, BROKEN = "caught", "skipped", "SURVIVED", "BROKEN"


def judge(site, tests, mutant, is_last):
    if mutant.needs and mutant.needs not in tests.seconds:
        return SKIPPED_HERE, f"as the test '{mutant.needs}' is"
    text = source_of(mutant)
    try:
        site.write(mutant, mutated(mutant, text))
        catcher = tests.catcher(site, mutant, is_last)
    except SuiteError as error:
        return BROKEN, str(error)
    finally:
        site.write(mutant, text)
    return (CAUGHT, f"by {catcher}") if catcher else (SURVIVED, f"in {mutant.path} {mutant.function}: {mutant.old}")


def show_progress(done, count, start):
    """On a terminal, a line that the next result overwrites."""
    if sys.stdout.isatty():
        left = (time.monotonic() - start) / done * (count - done) / 60
        print(f"{done} of {count}, about {left:.0f} min left", end="\r", flush=True)


def judge_round(sites, pool, mutants, is_last):
    """(the fault, its verdict and what there is to say) of each, in their order."""
    print("running the tests without a fault", flush=True)
    tests, free = Tests(sites, pool), queue.SimpleQueue()
    for site in sites:
        free.put(site)

    def judge_in_a_free_site(mutant):
        site = free.get()
        try:
            return mutant, *judge(site, tests, mutant, is_last)
        finally:
            free.put(site)

    try:
        yield from pool.map(judge_in_a_free_site, mutants)
    except KeyboardInterrupt:
        pool.shutdown(wait=False, cancel_futures=True)
        raise
    tests.check_lengths(sites[0])


def judge_all(folder, mutants, jobs):
    """Judges the faults in as many sites as there are jobs, with two kernels; what these let pass, with all. Returns how many came
    to each verdict."""
    count = min(jobs, len(mutants))
    kernels, own = NARROW.get(platform.machine(), ("", ""))
    with open(os.path.join(ROOT, "src", "kernels.txt"), encoding="utf-8") as file:
        folders = set(re.findall(r"(?m)^\w+ (\w+)$", file.read())) - {"scalar", own}
    left = [mutant for mutant in mutants if own and mutant.path.split("/")[1] in folders]
    verdicts, start = collections.Counter(), time.monotonic()
    print(f"building {'a copy' if count == 1 else f'{count} copies'} of the tree in {folder}", flush=True)
    with concurrent.futures.ThreadPoolExecutor(count) as pool:
        sites = list(pool.map(lambda k: Site(os.path.join(folder, str(k)), max(1, jobs // count), kernels), range(count)))
        for is_last in (False, True) if own else (True,):
            asked = left if own and is_last else [mutant for mutant in mutants if mutant not in left]
            if not asked:  # all were caught; the build still has the last of them
                continue
            if own and is_last:
                list(pool.map(lambda site: site.make(["meson", "configure", "-Dkernels=", site.build]), sites))
            for mutant, verdict, detail in judge_round(sites, pool, asked, is_last):
                if verdict in (SURVIVED, SKIPPED_HERE) and not is_last:
                    left.append(mutant)
                    continue
                verdicts[verdict] += 1
                print(f"{verdict:<8} {mutant.name}: {detail}", flush=True)
                show_progress(sum(verdicts.values()), len(mutants), start)
    return verdicts


def parse_arguments():
    parser = argparse.ArgumentParser(description="Puts the faults of mutants.txt into the source, one by one, and runs the tests.")
    parser.add_argument("--only", metavar="PATTERN", nargs="+", default=["*"],
                        help="only the faults of these names, such as 'edge-*'")
    parser.add_argument("--sample", type=int, metavar="N", help="only N of them, drawn by the seed")
    parser.add_argument("--seed", type=int, metavar="N", help="of the sample (default: another one every time)")
    parser.add_argument("--list", action="store_true", help="print the faults, look for their texts, and change nothing")
    parser.add_argument("--keep", action="store_true", help="keep the copies of the tree and their builds")
    parser.add_argument("--jobs", type=int, default=2, metavar="N", help="faults tried at a time (default: 2)")
    arguments = parser.parse_args()
    if arguments.jobs < 1 or (arguments.sample is not None and arguments.sample < 1):
        parser.error("--jobs and --sample must be 1 or more")
    return arguments


def check_texts(mutants):
    """Every text is in its function, and once: looked at before anything is built."""
    faults = []
    for mutant in mutants:
        try:
            mutated(mutant, source_of(mutant))
        except (OSError, SuiteError) as error:
            faults.append(f"{mutant.name}: {error}")
    if faults:
        raise SuiteError("the source has moved away from the list; these need its texts of today:\n  " + "\n  ".join(faults))


def main():
    arguments = parse_arguments()
    mutants = [mutant for mutant in read_list(os.path.join(FOLDER, "mutants.txt"), Sources())
               if any(fnmatch.fnmatch(mutant.name, pattern) for pattern in arguments.only)]
    if not mutants:
        raise SuiteError(f"no fault is called {' or '.join(arguments.only)}; --list prints the names")
    check_texts(mutants)
    if arguments.list:
        for mutant in mutants:
            print(f"{mutant.name}: {mutant.path} {mutant.function}")
        return 0
    if arguments.sample:
        seed = random.SystemRandom().randrange(10**6) if arguments.seed is None else arguments.seed
        print(f"sample of seed {seed}", flush=True)
        mutants = random.Random(seed).sample(mutants, min(arguments.sample, len(mutants)))
    folder = tempfile.mkdtemp(prefix="tribox-mutants-")
    try:
        verdicts = judge_all(folder, mutants, arguments.jobs)
    finally:
        if not arguments.keep:
            shutil.rmtree(folder, ignore_errors=True)
    print(f"{len(mutants)} faults:", ", ".join(f"{count} {verdict}" for verdict, count in verdicts.items()))
    return 2 if verdicts[BROKEN] else 1 if verdicts[SURVIVED] else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except SuiteError as error:
        print(f"mutants: {error}", file=sys.stderr)
        sys.exit(2)
