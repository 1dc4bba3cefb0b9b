"""The memory of this process."""

from __future__ import annotations

import os
from pathlib import Path

_PAGES = Path("/proc/self/statm")
_STATUS = Path("/proc/self/status")


def used_memory() -> int:
    """Bytes that the process holds now, as the system counts them; 0 where it does not tell."""
    try:
        pages = _PAGES.read_text(encoding="ascii").split()[1]
        return int(pages) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError, IndexError):
        return peak_memory()


def peak_memory() -> int:
    """The most bytes that the process has held so far; 0 where the system does not tell.

    On Linux `getrusage` also counts what the process held before it became this program.
    """
    try:
        for line in _STATUS.read_text(encoding="ascii", errors="replace").splitlines():
            if line.startswith("VmHWM:"):
                return int(line.split()[1]) * 1024
    except (OSError, ValueError, IndexError):
        pass
    try:
        import resource
        import sys
    except ImportError:
        return 0
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak if sys.platform == "darwin" else peak * 1024
