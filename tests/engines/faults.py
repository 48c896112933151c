"""Kills a worker of an engine (SIGKILL) at a random moment, again and again, and looks at how each run ends.

    faults.py ENGINE [--kills N] [--seed N] [--limit SECONDS] [--workers N] [--rings N] [--resolution N]

ENGINE is dask or mpi. Every fourth kill is of all processes of a run at once, as where the power fails. A run may end with the
right cells, or with an error and no cells, after which the same command again has to give the right ones. Wrong cells, and a run
that goes on for longer than the limit, are failures.
"""

import argparse
import collections
import contextlib
import os
import random
import signal
import subprocess
import sys
import tempfile
import time

import runs


def processes():
    """The parent and the command line of each process, by its number."""
    found = {}
    for number in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{number}/stat") as stat, open(f"/proc/{number}/cmdline") as command:
                found[int(number)] = int(stat.read().rpartition(")")[2].split()[1]), command.read().replace("\0", " ")
        except OSError:
            pass
    return found


def below(found, root):
    """The processes that this one started, and those that they did."""
    family = {root}
    while True:
        more = {number for number, (parent, _) in found.items() if parent in family} - family
        if not more:
            return family - {root}
        family |= more


def workers_of(engine, process):
    """The processes that do the engine's work."""
    found = processes()
    return sorted(number for number in below(found, process.pid) if engine.word in found[number][1])


def end(process):
    """Ends a run that does not end, with all that it started."""
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    process.wait()


def kill(numbers):
    """Whether one of them was still there."""
    found = False
    for number in numbers:
        with contextlib.suppress(ProcessLookupError):
            os.kill(number, signal.SIGKILL)
            found = True
    return found


def kill_some(engine, process, moment, pick, kills_all):
    """Kills a worker, or all, when that moment has come and there is one; returns the run's age and what it killed, or None."""
    begin = time.monotonic()
    while process.poll() is None:
        age = time.monotonic() - begin
        workers = workers_of(engine, process) if age >= moment else ()
        if workers and kill([process.pid, *below(processes(), process.pid)] if kills_all else [pick.choice(workers)]):
            return age, "all" if kills_all else "a worker"
        time.sleep(0.01)
    return None


def outcome(engine, process, limit):
    """right, error, wrong or hung."""
    try:
        code = process.wait(limit)
    except subprocess.TimeoutExpired:
        end(process)
        return "hung"
    if code and not os.path.exists(engine.path):
        return "error"
    return "right" if engine.is_right() else "wrong"


def run(engine, limit, log, moment=None, pick=None, kills_all=False):
    """One run: (how it ended, when and which worker was killed or None, how long it took)."""
    begin = time.monotonic()
    process = runs.start(engine, limit, log)
    killed = None if moment is None else kill_some(engine, process, moment, pick, kills_all)
    return outcome(engine, process, limit + runs.GRACE), killed, time.monotonic() - begin


def faults(engine, count, pick, limit, log):
    """Runs until that many had a worker killed, and after each error again; returns how many ended how."""
    ended, begin = collections.Counter(), time.monotonic()
    first, _, takes = run(engine, limit, log)
    print(f"{engine.name}: without a kill {first}, {takes:.1f} s", flush=True)
    ended["undisturbed", first] += 1
    number = 0
    while number < count:
        engine.clear()
        kills_all = number % 4 == 3
        how, killed, seconds = run(engine, limit, log, pick.uniform(0, takes), pick, kills_all)
        lies = len(engine.lies())
        again = run(engine, limit, log)[0] if how == "error" else None
        number += killed is not None
        ended["killed" if killed else "not killed", how] += 1
        if again:
            ended["again", again] += 1
        when = f"{killed[1]} killed at {killed[0]:.2f} s" if killed else "it ended before a worker was killed"
        then = f"; again, from {lies} files: {again}" if again else ""
        print(f"{engine.name} {number}: {when}: {how}, {seconds:.1f} s{then}", flush=True)
    print(f"{engine.name}: {time.monotonic() - begin:.0f} s: "
          + ", ".join(f"{kind} {how} {n}" for (kind, how), n in sorted(ended.items())), flush=True)
    return ended


def are_good(ended):
    """Whether no cell was wrong, nothing hung, and all that nobody disturbed was right."""
    return all(how == "right" or (kind, how) == ("killed", "error") for kind, how in ended)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("engine", choices=runs.ENGINES)
    parser.add_argument("--kills", type=int, default=2)
    parser.add_argument("--seed", type=int, default=int(os.environ.get("TRIBOX_TEST_SEED", "1")))
    parser.add_argument("--limit", type=int, default=120, help="seconds that a run may take")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--rings", type=int, default=40, help="of the sphere: it has 4 times the square of triangles")
    parser.add_argument("--resolution", type=int, default=300)
    options = parser.parse_args()
    print(f"seed {options.seed}", flush=True)
    with tempfile.TemporaryDirectory() as folder, open(os.path.join(folder, "log"), "w+") as log:
        engine = runs.engine_of(options.engine, folder, options.rings, options.resolution)
        engine.workers = options.workers
        ended = faults(engine, options.kills, random.Random(options.seed), options.limit, log)
        if not are_good(ended):
            log.seek(0)
            print(log.read()[-20000:], file=sys.stderr)
            sys.exit(1)


if __name__ == "__main__":
    main()
