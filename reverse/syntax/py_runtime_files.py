"""Which files are modules of the run-time part of generated packages in Python."""

from __future__ import annotations

from rebsync.source import Source

# The modules of the run-time part, and what each has that people's of that name lack.
_RUNTIME = {
    "mailbox": ("\nclass Mailbox",),
    "startup": ("\nclass Startup",),
    "values": ("\nclass Violation",),
    "watchdog": ("\nclass Watchdog", "def add_check("),
    "drive": ("\nclass Drive", "def move("),
    "sensor": ("\nclass Sensor", "def seen("),
    "actions": ("\nclass Actions", "Clients"),
    "clients": ("\nclass Clients", "def answer("),
    "services": ("\nclass Services", "Clients"),
    "lifecycle": ("\nclass RebecNode", "\nclass Managed("),
}


def is_runtime_file(source: Source) -> bool:
    """Whether a file is a module of the run-time part, which is the same in all packages."""
    stem = source.path.rpartition("/")[2].removesuffix(".py")
    return stem in _RUNTIME and all(text in source.text for text in _RUNTIME[stem])
