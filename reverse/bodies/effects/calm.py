"""Which functions touch nothing of the model: found out once for bodies that name the same."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import field

from rebsync.records import dataclass

_Names = Mapping[str, object]


@dataclass(slots=True)
class Sure:
    """What is known of functions, by the ids of their bodies, for all bodies of a class.

    It holds where names stand for the same members and functions: there is a table for each.
    """

    _tables: list[tuple[_Names, _Names, dict[int, bool]]] = field(default_factory=list)

    def among(self, members: _Names, functions: _Names) -> dict[int, bool]:
        """The table for bodies that can name these."""
        for *names, table in self._tables:
            if names == [members, functions]:
                return table
        table = {}
        self._tables.append((dict(members), dict(functions), table))
        return table


@dataclass(slots=True)
class Calm:
    """What one body finds out, and takes from what others have.

    A function that calls itself, perhaps by others, may not end: it counts as one that touches
    something, as do those that call it.
    """

    shared: Sure = field(default_factory=Sure)
    _sure: dict[int, bool] | None = None
    _running: set[int] = field(default_factory=set)

    def is_running(self, body: int) -> bool:
        """Whether it is being found out of a function."""
        return body in self._running

    def of(self, body: int, members: _Names, functions: _Names, looks: Callable[[], bool]) -> bool:
        """Whether a function touches nothing; `looks` finds out."""
        if self._sure is None:
            self._sure = self.shared.among(members, functions)
        if body not in self._sure:
            self._sure[body] = False  # as far as a call of itself goes
            self._running.add(body)
            self._sure[body] = looks()
            self._running.discard(body)
        return self._sure[body]
