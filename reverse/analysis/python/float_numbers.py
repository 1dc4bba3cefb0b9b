"""Which numbers of Python may be floats, where a whole number is asked for: by what is stored."""

from __future__ import annotations

from functools import cached_property

from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.analysis.python.inferred_types import InferredTypes
from rebsync.reverse.analysis.python.value_types import MessageType
from rebsync.reverse.analysis.stores import (
    AnyValue,
    CallResult,
    ElementOf,
    Key,
    PartOf,
    Source,
    key_of,
)
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.libraries.attributes import FLOAT_METHODS, is_float

_DEEPEST = 4  # names that follow each other
_COMPUTING = frozenset(
    {
        *(Operator.ADD, Operator.SUBTRACT, Operator.MULTIPLY, Operator.FLOOR_DIVIDE),
        *(Operator.FLOOR_MODULO, Operator.POWER),
    }
)
_OF_FLOATS = frozenset(
    {
        *("builtins.float", "time.time", "time.monotonic", "time.perf_counter", "random.random"),
        *("random.uniform", "random.gauss", "math.fsum", "statistics.mean"),
        *(f"math.{name}" for name in ("sqrt", "sin", "cos", "tan", "atan2", "hypot", "fabs")),
        *(f"math.{name}" for name in ("exp", "log", "pow", "degrees", "radians", "atan", "fmod")),
    }
)


class FloatNumbers:
    """The values of one program."""

    def __init__(self, origins: Origins, types: InferredTypes) -> None:
        self._stores = origins.graph.stores
        self._types = types
        self._fields = origins.table.fields
        self._made: dict[Key, bool] = {}  # which names are of containers of floats

    def has(self, value: e.Expression, function: str) -> bool:
        """Whether a number of a function is a float, or one is stored under its name."""
        return self._is_float((function, value), 0)

    def _is_float_field(self, of: e.Expression, name: str, function: str) -> bool:
        """Whether a field of a message is a float."""
        messages = (t for t in self._types.of(of, function) if isinstance(t, MessageType))
        fields = (self._fields(t.name) or {} for t in messages)
        return any(each.get(name, "").startswith("float") for each in fields)

    def _is_float(self, source: Source, depth: int) -> bool:
        function, value = source
        match value:
            case e.Literal(constant):
                return isinstance(constant, float)
            case e.Binary(Operator.TRUE_DIVIDE):
                return True
            case e.Binary(operator, left, right) if operator in _COMPUTING:
                return any(self._is_float((function, each), depth) for each in (left, right))
            case e.Unary(Operator.NEGATE | Operator.PLUS, of):
                return self._is_float((function, of), depth)
            case e.Conditional(_, one, other):
                return any(self._is_float((function, each), depth) for each in (one, other))
            case CallResult(call):
                return getattr(call.callee, "name", "") in _OF_FLOATS | FLOAT_METHODS
            case e.LibraryReference(name):
                return is_float(name)
            case e.Attribute(of, name) if self._is_float_field(of, name, function):
                return True
            case AnyValue():
                return False
            case e.Index(of, index):
                return not isinstance(index, e.Slice) and self._has_floats((function, of), depth)
            case ElementOf(of) | PartOf(of):
                return self._has_floats((function, of), depth)
            case e.Local() | e.Temporary() | e.Captured() | e.Global() | e.Attribute():
                key = key_of(value, function)
                if key is None or depth == _DEEPEST:
                    return False
                return any(self._is_float(each, depth + 1) for each in self._stores.sources(key))
            case _:
                return False

    def _has_floats(self, source: Source, depth: int) -> bool:
        """Whether a float may be among the elements of a container.

        What is put into any container of the program may be put into this one.
        """
        return self._puts_floats or self._is_made_of_floats(source, depth)

    @cached_property
    def _puts_floats(self) -> bool:
        puts = ((p.function, p.value) for p in self._types.containers.puts if p.value is not None)
        return any(self._is_float(put, 1) or self._is_made_of_floats(put, 1) for put in puts)

    def _is_made_of_floats(self, source: Source, depth: int) -> bool:
        function, value = source
        match value:
            case e.Build(_, elements):
                inside = [p.operand if isinstance(p, e.Spread) else p for p in elements]
            case e.BuildMapping(_, entries):
                inside = [p.operand if isinstance(p, e.Spread) else p[1] for p in entries]
            case e.Binary(Operator.ADD | Operator.MULTIPLY, left, right):
                inside = [left, right]
            case CallResult(call):
                inside = [a.value for a in call.arguments]
            case e.Index(of) | ElementOf(of) | PartOf(of) | e.Copy(of):
                return self._is_made_of_floats((function, of), depth)
            case e.LibraryReference(name):  # that `map` calls
                return name in _OF_FLOATS
            case e.Attribute(of, name) if self._is_float_field(of, name, function):
                return True
            case e.Local() | e.Temporary() | e.Captured() | e.Global() | e.Attribute():
                key = key_of(value, function)
                if key is not None and key not in self._made:
                    self._made[key] = False  # of itself it is made of no others
                    stored = self._stores.sources(key)
                    self._made[key] = any(self._is_made_of_floats(each, 1) for each in stored)
                return key is not None and self._made[key]
            case _:
                return False
        parts = [(function, each) for each in inside]
        return any(self._is_float(p, depth) or self._is_made_of_floats(p, depth) for p in parts)
