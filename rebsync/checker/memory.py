"""The memory of this process, and what is left of the machine's."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

_ROOT = Path("/")
NO_MEMORY = "there was no more memory"


def used_memory() -> int:
    """Bytes that the process holds now, as the system counts them; 0 where it does not tell."""
    try:
        pages = Path("/proc/self/statm").read_text(encoding="ascii").split()[1]
        return int(pages) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError, IndexError):
        return peak_memory()


def peak_memory() -> int:
    """The most bytes that the process has held so far; 0 where the system does not tell.

    On Linux `getrusage` also counts what the process held before it became this program.
    """
    peak = _amounts(_ROOT / "proc/self/status").get("VmHWM")
    if peak is not None:
        return peak * 1024
    try:
        import resource
        import sys
    except ImportError:
        return 0
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak if sys.platform == "darwin" else peak * 1024


def is_scarce(used: int, root: Path = _ROOT) -> bool:
    """Whether a process that holds `used` bytes is about to be killed for want of memory.

    Then less than a tenth is left of the machine's memory, or of that of a control group that the
    process is in, and the process holds more than is left. False where the system does not tell.
    """
    return any(left < min(whole // 10, used) for whole, left in _memories(root))


def _memories(root: Path) -> Iterator[tuple[int, int]]:
    """How many bytes there are, and are left: of the machine, and of each control group."""
    machine = _amounts(root / "proc/meminfo")
    if "MemTotal" in machine and "MemAvailable" in machine:
        yield machine["MemTotal"] * 1024, machine["MemAvailable"] * 1024
    for group in _groups(root):
        try:
            bound, current = (
                int((group / name).read_text(encoding="ascii"))
                for name in ("memory.max", "memory.current")
            )
        except (OSError, ValueError):  # the root has none; "max" is no bound
            continue
        yield bound, bound - current + _amounts(group / "memory.stat").get("inactive_file", 0)


def _groups(root: Path) -> Iterator[Path]:
    """The control groups (version 2) of this process, the innermost first.

    In a container its own group is mounted as the root, whatever its name outside.
    """
    mounted = root / "sys/fs/cgroup"
    yield mounted
    try:
        lines = (root / "proc/self/cgroup").read_text(encoding="utf-8").splitlines()
    except (OSError, ValueError):
        return
    name = next((line[len("0::/") :] for line in lines if line.startswith("0::/")), "")
    group = mounted / name
    while group != mounted and ".." not in group.parts:
        yield group
        group = group.parent


def _amounts(path: Path) -> dict[str, int]:
    """The numbers of a file of the system by their names, without units; none if there is none."""
    try:
        lines = path.read_text(encoding="ascii", errors="replace").splitlines()
    except OSError:
        return {}
    pairs = (line.split()[:2] for line in lines)
    named = ((pair[0].rstrip(":"), pair[1]) for pair in pairs if len(pair) == 2)
    return {name: int(amount) for name, amount in named if amount.isdecimal()}
