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

    `_own` counts a function that calls itself as one that touches nothing until that is known:
    what was found while it counted so is not for others, unless it turned out to be right.
    """

    shared: Sure = field(default_factory=Sure)
    _own: dict[int, bool] = field(default_factory=dict)
    _sure: dict[int, bool] | None = None
    _depth: int = 0

    def of(self, body: int, members: _Names, functions: _Names, looks: Callable[[], bool]) -> bool:
        """Whether a function touches nothing; `looks` finds out."""
        if body in self._own:
            return self._own[body]
        if self._sure is None:
            self._sure = self.shared.among(members, functions)
        if body in self._sure:
            return self._sure[body]
        before = len(self._own)
        self._own[body] = True  # as far as a call of itself goes
        self._depth += 1
        self._own[body] = calm = looks()
        self._depth -= 1
        if not self._depth:
            found = list(self._own.items())[before:]
            self._sure.update((b, known) for b, known in found if calm or not known)
        return calm
