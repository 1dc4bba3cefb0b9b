"""The progress of a long search, on one line of a terminal."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, TextIO

from rebsync.terminal import one_line

if TYPE_CHECKING:
    from rebsync.checker.exploration import Progress, Report

_SILENCE = 0.5  # seconds before the first line, and between two
_CLEAR = "\r\x1b[K"


@contextmanager
def progress(stream: TextIO) -> Iterator[Report | None]:
    """What a search reports to; nothing is shown where nobody watches."""
    if not stream.isatty():
        yield None
        return
    shown = [time.monotonic()]

    def report(now: Progress) -> None:
        if time.monotonic() - shown[-1] >= _SILENCE:
            shown.append(time.monotonic())
            stream.write(_CLEAR + one_line(told(now)))
            stream.flush()

    try:
        yield report
    finally:
        if len(shown) > 1:
            stream.write(_CLEAR)
            stream.flush()


def told(now: Progress) -> str:
    """`1,200,000 states, 800,000/s, depth 34, 52 MiB`; or what is done after the search."""
    if now.task:
        return (
            f"{now.states:,} states, {now.task}, {now.seconds:,.0f} s, "
            f"{now.memory / 2**20:,.0f} MiB"
        )
    found = (
        f", violated so far: {', '.join(dict.fromkeys(now.violations))}" if now.violations else ""
    )
    rate = now.states / now.seconds if now.seconds > 0 else 0
    return (
        f"{now.states:,} states, {rate:,.0f}/s, {now.waiting:,} waiting, "
        f"depth {now.depth}, {now.memory / 2**20:,.0f} MiB{found}"
    )
