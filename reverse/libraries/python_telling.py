"""What the tables say of what tells people something in Python: arguments of logs, transforms."""

from __future__ import annotations

from collections.abc import Mapping

from rebsync.reverse.libraries.registry import derived, libraries
from rebsync.reverse.libraries.routines import Kind, Language, LogCall


@derived
def log_arguments() -> Mapping[str, LogCall]:
    """What logs with the arguments that it takes, by full names: `get_logger().info`."""
    found = (pair for lib in libraries(Language.PYTHON) for pair in lib.log_arguments.items())
    return dict(found)


@derived
def broadcasters() -> frozenset[str]:
    """The classes of what sends transforms as they change."""
    made = (pair for lib in libraries(Language.PYTHON) for pair in lib.unmodelled.items())
    return frozenset(name for name, routine in made if routine.kind is Kind.BROADCASTER)
