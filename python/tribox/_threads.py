"""Threads for one call: the library's calls release the interpreter's lock, so they run at once."""

import os
from concurrent.futures import ThreadPoolExecutor
from operator import index

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


def in_threads(threads, work, parts):
    """[work(part) for part in parts], `threads` of them at once. After an error no further part is started, and it is raised."""
    threads = min(threads, len(parts))
    if threads <= 1:
        return [work(part) for part in parts]
    with ThreadPoolExecutor(threads) as pool:
        return list(pool.map(work, parts))
