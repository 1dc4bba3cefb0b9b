"""Which classes of a program of Python may answer for a value: run a method that no text calls."""

from __future__ import annotations

from rebsync.reverse.analysis.origins import ClassOrigin, LibraryOrigin, Origins, PlainOrigin
from rebsync.reverse.analysis.python.message_values import MessageValues
from rebsync.reverse.ir import expressions as e

# Containers that ask their elements nothing where they are asked for one, for all, or how many.
CONTAINERS = frozenset({"list", "tuple", "deque", "set", "dict", "str"})


class OperandClasses:
    """The values of one program."""

    def __init__(self, origins: Origins) -> None:
        self._origins = origins
        self._messages = MessageValues(origins.graph)

    def of(self, value: e.Expression, function: str, asks_elements: bool) -> frozenset[str] | None:
        """The classes of a value, or (`asks_elements`) of what is in it too; None if not known."""
        if self._messages.has(value, function):
            return frozenset()
        found = frozenset[str]()
        for origin in self._origins.of(value, function):
            match origin:
                case ClassOrigin(name):
                    found |= self._origins.graph.family(name)
                case PlainOrigin() | LibraryOrigin("str", True):
                    pass
                case LibraryOrigin(name, True) if name in CONTAINERS and not asks_elements:
                    pass
                case _:
                    return None
        return found
