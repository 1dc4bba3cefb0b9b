"""Does something with each of many packages, in several processes where that is worth while."""

from __future__ import annotations

import gc
import os
import signal
import sys
import threading
from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from functools import partial
from itertools import chain, islice
from multiprocessing import get_context
from operator import attrgetter
from typing import TypeVar

from rebsync.diagnostics import RebsyncError
from rebsync.long_numbers import allow_long_numbers
from rebsync.reverse.files.packages import Listing
from rebsync.reverse.files.reading import Chosen, read

_SIZE = attrgetter("size")
T = TypeVar("T")
G = TypeVar("G")

ENOUGH = 100_000  # bytes of code, from which on starting processes is paid back
_WASTE = 300_000  # bytes of code, after which what they left in memory is cleared away
_since = 0  # bytes read since the last time, in this process
_AHEAD = 4  # packages for each process that are handed out before their turn
_TOGETHER = 64  # of so many the largest are handed out first, as otherwise they are waited for


def each(listings: Iterator[Listing], work: Callable[[Chosen], T]) -> Iterator[T]:
    """What `work` makes of each of some packages, in their order.

    `work` and what it gives must be fit for another process: a function of a module, and values
    that can be pickled. RebsyncError: one of them may not be read.
    """
    first = _first(listings)
    every = chain(first, listings)
    if len(first) < 2:
        yield from (work(read(listing)) for listing in first)
    elif sum(listing.size for listing in first) < ENOUGH or processors() < 2:
        yield from (_done(work, listing) for listing in every)
    else:
        yield from in_processes(every, partial(_done, work), attrgetter("root"), _SIZE)


def _first(listings: Iterator[Listing]) -> list[Listing]:
    """So many listings that it can be told whether they are much work."""
    found: list[Listing] = []
    size = 0
    for listing in listings:
        found.append(listing)
        size += listing.size
        if len(found) > 1 and size >= ENOUGH:
            break
    return found


def _done(work: Callable[[Chosen], T], listing: Listing) -> T:
    try:
        return work(read(listing))
    finally:
        _clear(listing.size)


def _clear(size: int) -> None:
    """Collects what is no longer used once so much code was read that there may be much of it.

    Commands run without that, but this one may take long; a collection takes some hundredths of a
    second, as long as reading a small package.
    """
    global _since
    _since += size
    if _since >= _WASTE:
        _since = 0
        gc.collect()


# --- processes ----------------------------------------------------------------------------------


def in_processes(
    every: Iterator[G],
    task: Callable[[G], T],
    root_of: Callable[[G], str],
    size_of: Callable[[G], int] = lambda _: 0,
) -> Iterator[T]:
    """What `task` makes of each, in their order, on all processors, the largest early.

    RebsyncError: one of them has ended the process that it was in; it tells the root of that.
    """
    processes = processors()
    waiting: deque[tuple[G, Future[T]]] = deque()
    more: list[G] = []
    pool = _pool(processes)
    try:
        while True:
            if len(waiting) < processes * _AHEAD:
                more = list(islice(every, _TOGETHER))
                begun: dict[int, Future[T]] = {}
                for number in sorted(range(len(more)), key=lambda n: -size_of(more[n])):
                    begun[number] = pool.submit(task, more[number])
                waiting += ((one, begun[number]) for number, one in enumerate(more))
                more = []
            if not waiting:
                break
            yield waiting[0][1].result()
            waiting.popleft()
    except BrokenProcessPool:
        lost = [*(one for one, _ in waiting), *more]
        yield from (_alone(one, task, root_of) for one in chain(lost, every))
    finally:
        # At its own end the interpreter would close pipes that the pool's thread still uses; it
        # waits there for the tasks that have begun in any case.
        pool.shutdown(cancel_futures=True)


def _alone(one: G, task: Callable[[G], T], root_of: Callable[[G], str]) -> T:
    """Does it in a process of its own, as one of several packages has ended the process it was in.

    RebsyncError: this package did.
    """
    with _pool(1) as pool:
        try:
            return pool.submit(task, one).result()
        except BrokenProcessPool:
            why = "reading this package ended the process that read it; memory may be short"
            raise RebsyncError.of(root_of(one), "RS806", why) from None


def _pool(processes: int) -> ProcessPoolExecutor:
    """Processes that are copies of this one where that is safe, which is quicker."""
    safe = sys.platform.startswith("linux") and threading.active_count() == 1
    context = get_context("fork" if safe else "spawn")
    return ProcessPoolExecutor(processes, context, initializer=_begin)


def _begin() -> None:
    """Leaves an interrupt to the first process, and what is there already out of collections."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    allow_long_numbers()
    gc.freeze()


def processors() -> int:
    """How many processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
