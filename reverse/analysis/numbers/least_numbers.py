"""Which numbers of C++ may be the least of their type: of these there is no opposite."""

from __future__ import annotations

from rebsync.reverse.analysis.facts import bare
from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.analysis.stores import CallResult, TemporaryVariable, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import Operator

_LEAST = frozenset({"INT32_MIN", "INT64_MIN", "INT_MIN", "LONG_MIN", "LLONG_MIN"})


class LeastNumbers:
    """The numbers of one function."""

    def __init__(self, origins: Origins, function: str) -> None:
        self._origins = origins
        self._function = function

    def may_be(self, value: e.Expression) -> bool:
        """Whether a number may be one that is written as the least of its type."""
        match bare(value):
            case e.LibraryReference(name):
                return name.rpartition("::")[2] in _LEAST
            case e.Literal(int() as number):
                return number in (-(1 << 31), -(1 << 63))
            case e.Unary(Operator.NEGATE, e.Literal(int() as number)):
                return number in (1 << 31, 1 << 63)
            case inner:
                key = key_of(inner, self._function)
        stored = self._origins.graph.stores.of(key) if key is not None else []
        return any(self._is_stored(v) for _, v in stored)

    def _is_stored(self, value: object) -> bool:
        while isinstance(value, e.Convert):
            value = value.operand
        match value:
            case CallResult(s.Call(_, s.LibraryCallee(name))):
                return name.endswith(("::min", "::lowest")) and "numeric_limits" in name
            case e.Literal() | e.Unary() | e.LibraryReference():
                return self.may_be(value)
            case e.Temporary(number):
                key = TemporaryVariable(self._function, number)
                stored = [v for _, v in self._origins.graph.stores.of(key)]
                return any(self._is_stored(v) for v in stored if isinstance(v, CallResult))
            case _:
                return False
