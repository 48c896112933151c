"""Threads for one call: the library's calls release the interpreter's lock, so they run at once."""

import os
from collections import deque
from operator import index
from queue import SimpleQueue
from threading import Lock, Thread
from typing import List

from ._errors import InputError, shown


def processors():
    """Those that this process may use, where the system tells."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def threads_of(threads):
    """How many threads are wanted; one for each processor that this process may use if it is 0 or None."""
    try:
        count = index(0 if threads is None else threads)
    except TypeError:
        count = -1
    if count < 0:
        raise InputError(f"threads = {shown(threads)}; give a whole number, or 0 for one on each processor")
    return count or processors()


parked: List["Helper"] = []  # that wait to be called, in place of being started anew
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=parked.clear)  # a child has none of these threads


class Helper:
    """A thread that stays till the process ends."""

    def __init__(self):
        self.calls = SimpleQueue()
        Thread(target=self.help, name="tribox", daemon=True).start()

    def help(self):
        while True:
            run, done = self.calls.get()
            try:
                run()
                run = None  # or what it refers to would stay too
                parked.append(self)
            finally:
                done.release()


def new_helper():
    """None where the system starts no thread."""
    try:
        return Helper()
    except RuntimeError:
        return None


def called(count, run):
    """So many helpers run something, or as many as the system starts: a lock for each, which it releases at its end."""
    locks = []
    for _ in range(count):
        try:
            helper = parked.pop()
        except IndexError:
            helper = new_helper()
        if not helper:
            break
        done = Lock()
        done.acquire()
        helper.calls.put((run, done))
        locks.append(done)
    return locks


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

    others = called(threads - 1, run)
    run()
    for done in others:
        done.acquire()
    if failures:
        raise failures[0]
    return answers
