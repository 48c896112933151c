"""one.py PEER [QUESTION MESH CELLS ROUNDS SECONDS]: who it is, tribox's time, then both and how far they agree, as lines of JSON.

It is a process of its own, on one processor, so that a peer may crash, or be ended. No round begins after SECONDS.
"""

import json
import os
import sys
import time
import warnings

if hasattr(os, "sched_setaffinity"):
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})  # before a peer counts them


def say(**values):
    print(json.dumps(values), flush=True)


def timed(call):
    """(the answer, [processor seconds, wall seconds])"""
    cpu, wall = time.process_time(), time.perf_counter()
    answer = call()
    taken = time.process_time() - cpu, time.perf_counter() - wall
    return answer, tuple(answer) if isinstance(answer, asked.Timed) else taken


def least(times):
    return [min(column) for column in zip(*times)]


def ask(ways, question, mesh, cells, rounds, seconds):
    vertices, faces = asked.read(mesh)
    task = asked.Task(vertices, faces, int(cells) and asked.tribox.grid_around(asked.tribox.Mesh(vertices, faces), int(cells)))
    ours, seen = asked.QUESTIONS[question]
    ours = ours(task)
    with warnings.catch_warnings():
        warnings.simplefilter("error", asked.tribox.OpenMeshWarning)
        try:
            own, _ = timed(ours)
        except asked.tribox.OpenMeshWarning:
            say(skipped="the mesh is not closed")
            return
    times = [timed(ours)[1]], []
    say(way=ways[question][0], ours=times[0][0])
    theirs, answer = ways[question][1](task)
    begin = time.perf_counter()
    for number in range(int(rounds)):
        if number and time.perf_counter() - begin > float(seconds):
            break
        if number:
            times[0].append(timed(ours)[1])
        found, taken = timed(theirs)
        times[1].append(taken)
    say(ours=least(times[0]), theirs=least(times[1]), rounds=len(times[1]))
    if seen:
        say(**asked.differences(seen(own), answer(found)))


import asked  # noqa: E402
import peers  # noqa: E402

try:
    title, answers = getattr(peers, sys.argv[1])()
except ImportError as error:
    say(absent=str(error))
else:
    say(name=title)
    if len(sys.argv) > 2:
        ask(answers, *sys.argv[2:])
    else:
        say(questions=list(answers), kernel=asked.tribox.kernel_name())
