"""Tells when nothing runs in some processes: what was sent has been heard, and all wait.

`stillness.py PID...` reads lines; it answers each when every thread of the processes sleeps, or
after LIMIT seconds. It is a process of its own since a thread that waits for Python's lock sleeps
too: one of another process shows its lock's holder.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Sequence

LIMIT = 2.0
_PAUSE = 0.0005
_BUSY = (b"R", b"D")


class Processes:
    """The threads of processes, whose states are read again and again."""

    def __init__(self, numbers: Sequence[str]) -> None:
        self._numbers = numbers
        self._states: dict[str, int] = {}
        self._last = ""  # that was busy, and is asked first

    def await_stillness(self) -> None:
        """Looks twice: between two looks at sleepers nobody was there to wake another."""
        limit = time.monotonic() + LIMIT
        while not (self._sleeps() and self._sleeps()) and time.monotonic() < limit:
            time.sleep(_PAUSE)

    def _sleeps(self) -> bool:
        if self._last and self._is_busy(self._last):
            return False
        self._last = next(filter(self._is_busy, self._threads()), "")
        return not self._last

    def _threads(self) -> list[str]:
        return [f"/proc/{n}/task/{t}/stat" for n in self._numbers for t in _entries(n)]

    def _is_busy(self, path: str) -> bool:
        try:
            if path not in self._states:
                self._states[path] = os.open(path, os.O_RDONLY)
            text = os.pread(self._states[path], 200, 0)
        except OSError:  # it has ended
            return False
        return text.rpartition(b") ")[2][:1] in _BUSY


def _entries(number: str) -> list[str]:
    try:
        with os.scandir(f"/proc/{number}/task") as entries:
            return [entry.name for entry in entries]
    except OSError:
        return []


def main(numbers: Sequence[str]) -> None:
    processes = Processes(numbers)
    for _ in sys.stdin:
        processes.await_stillness()
        print(flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
