"""Threads for one call: the library's calls release the interpreter's lock, so they run at once."""

import os
from collections import deque
from operator import index
from threading import Thread

from ._errors import InputError, shown


def processors():
    """Those that this process may use, where the system tells."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def threads_of(threads):
    """How many threads are wanted; one for each processor that this process may use where it is None."""
    try:
        count = processors() if threads is None else index(threads)
    except TypeError:
        count = 0
    if count < 1:
        raise InputError(f"threads = {shown(threads)}; give a whole number, 1 or more, or None for one on each processor")
    return count


def started(count, run):
    """So many threads that run something, or as many as the system starts."""
    threads = []
    for _ in range(count):
        thread = Thread(target=run)
        try:
            thread.start()
        except RuntimeError:
            break
        threads.append(thread)
    return threads


def cut(count, parts):
    """(first, end) of so many parts of about one size, or of fewer where there is not so much."""
    parts = min(count, parts)
    return [(count * part // parts, count * (part + 1) // parts) for part in range(parts)]


def taken_from(left):
    """The parts in a deque, till none is left. Threads may take from one at once."""
    while True:
        try:
            part = left.popleft()
        except IndexError:
            return
        yield part


def in_threads(threads, work, parts):
    """[work(part) for part in parts], `threads` of them at once. After an error no further part is started, and it is raised."""
    threads = min(threads, len(parts))
    if threads <= 1:
        return [work(part) for part in parts]
    answers, failures, left = [None] * len(parts), [], deque(enumerate(parts))

    def run():
        for number, part in taken_from(left):
            try:
                answers[number] = work(part)
            except BaseException as failure:
                failures.append(failure)
                left.clear()

    others = started(threads - 1, run)
    run()
    for other in others:
        other.join()
    if failures:
        raise failures[0]
    return answers
