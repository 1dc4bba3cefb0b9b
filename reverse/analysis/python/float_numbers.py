"""Which numbers of Python may be floats, where a whole number is asked for: by what is stored."""

from __future__ import annotations

from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.analysis.python.inferred_types import InferredTypes
from rebsync.reverse.analysis.python.value_types import MessageType
from rebsync.reverse.analysis.stores import AnyValue, CallResult, Source, key_of
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
            case e.Local() | e.Temporary() | e.Captured() | e.Global() | e.Attribute():
                key = key_of(value, function)
                if key is None or depth == _DEEPEST:
                    return False
                return any(self._is_float(each, depth + 1) for each in self._stores.sources(key))
            case _:
                return False
