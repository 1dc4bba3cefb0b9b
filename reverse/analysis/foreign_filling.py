"""Which containers functions of libraries may fill that no table knows: those that they get.

Such a function may also keep a container for later, so that any other of them may fill it then.
Numbers and texts that it gets it leaves as they are ([decision 72]).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rebsync.reverse.analysis.foreign_emptying import runs_unknown, whole
from rebsync.reverse.analysis.problems import ProblemNotes
from rebsync.reverse.analysis.stores import (
    CapturedVariable,
    Key,
    TemporaryVariable,
    key_of,
)
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.libraries.endless import FINITE
from rebsync.reverse.libraries.outcomes import CallOutcome

_NOTHING = CallOutcome()


class ForeignFilling:
    """What libraries may fill while one function runs."""

    def __init__(self, notes: ProblemNotes) -> None:
        self._origins = notes.origins
        self._table = notes.table
        self._program = notes.origins.graph.program
        self._function = notes.function.name
        self._names: dict[frozenset[Key], frozenset[Key]] = {}
        self._handed: dict[frozenset[Key], bool] = {}

    def may_fill(self, body: s.Body, function: str, over: Iterable[e.Expression]) -> bool:
        """Whether a body calls what may fill one of some containers of the function."""
        calls = [c for c in walk(body) if isinstance(c, s.Call) and self._is_foreign(c, function)]
        keys = {key_of(each, self._function) for each in over} - {None} if calls else set()
        asked = frozenset(k for k in keys if k is not None)
        if asked not in self._names:
            self._names[asked] = self._aliases(asked)
        names = self._names[asked]
        if not names or not calls:
            return False
        if names not in self._handed:
            self._handed[names] = self._is_handed(names)
        return self._handed[names] or any(self._gets(c, function, names) for c in calls)

    def _gets(self, call: s.Call, function: str, names: frozenset[Key]) -> bool:
        """Whether a call gets what has one of some names."""
        return any(
            key_of(part, function) in names for a in call.arguments for part in whole(a.value)
        )

    def _is_handed(self, names: frozenset[Key]) -> bool:
        """Whether such a function gets a container anywhere, and may have kept it."""
        for name in self._functions(names):
            for node in walk(self._program.function(name).body):
                match node:
                    case s.Call() if self._gets(node, name, names) and runs_unknown(
                        self._origins, node, name, self._is_unknown
                    ):
                        return True
                    case _:
                        pass
        return False

    def _aliases(self, names: frozenset[Key]) -> frozenset[Key]:
        """Some variables, and all that get what they hold, by itself or in a container."""
        found, before = set(names), 0
        stores = list(self._stores(names)) if names else []
        while len(found) != before:
            before = len(found)
            found |= {to for to, values in stores if not found.isdisjoint(values)}
        return frozenset(found)

    def _stores(self, names: frozenset[Key]) -> Iterator[tuple[Key, frozenset[Key]]]:
        for name in self._functions(names):
            for node in walk(self._program.function(name).body):
                if isinstance(node, s.Assign | s.Declare) and node.value is not None:
                    to = key_of(node.target, name)
                    values = (key_of(part, name) for part in whole(node.value))
                    if to is not None:
                        yield to, frozenset(v for v in values if v is not None)

    def _functions(self, names: frozenset[Key]) -> Iterable[str]:
        """The functions that may store what some variables hold."""
        if all(isinstance(n, CapturedVariable | TemporaryVariable) for n in names):
            return {
                n.function for n in names if isinstance(n, CapturedVariable | TemporaryVariable)
            }
        return self._program.functions

    def _is_foreign(self, call: s.Call, function: str) -> bool:
        return runs_unknown(self._origins, call, function, self._is_unknown)

    def _is_unknown(self, name: str) -> bool:
        if name.partition(".")[0] in FINITE or self._table.is_standard(name):
            return False
        return self._table.function(name) == _NOTHING
