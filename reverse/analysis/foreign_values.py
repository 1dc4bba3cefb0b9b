"""Values of libraries that no table knows, and parts of these: they have what code asks of them."""

from __future__ import annotations

from rebsync.reverse.analysis.origins import ANYTHING, LibraryOrigin, Origin, Origins
from rebsync.reverse.analysis.stores import CallResult, Stored, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.libraries.outcome_classes import PLAIN_CLASSES

_DEEPEST = 5


class ForeignValues:
    """The values of one program."""

    def __init__(self, origins: Origins) -> None:
        self._origins = origins
        self._table = origins.table

    def has(self, value: e.Expression, function: str, depth: int = 0) -> bool:
        """Whether a value is of such a library, or a part of what it made, or gave."""
        if not self._table.trusts_others or depth > _DEEPEST:
            return False
        held = self._origins.of(value, function)
        if held != ANYTHING:
            return all(map(self._is_object, held))
        key = key_of(value, function)
        stored = self._origins.graph.stores.of(key) if key is not None else []
        if stored:
            return all(self._is_stored(each, depth + 1) for each in stored)
        match value:
            case e.Attribute(of) | e.Index(of):
                return self.has(of, function, depth + 1)
            case _:
                return False

    def _is_stored(self, stored: Stored, depth: int) -> bool:
        function, value = stored
        match value:
            case CallResult(s.Call(_, s.MethodCallee(receiver, name))):
                return not self._origins.methods_of_any(name) and self.has(
                    receiver, function, depth
                )
            case e.Index() | e.Attribute() | e.Local() | e.Temporary():
                return self.has(value, function, depth)
            case _:
                return False

    def _is_object(self, origin: Origin) -> bool:
        if not isinstance(origin, LibraryOrigin) or not origin.of_object:
            return False
        if self._table.has_methods_of(origin.name):
            return False
        return origin.name not in PLAIN_CLASSES and not self._table.is_standard(origin.name)
