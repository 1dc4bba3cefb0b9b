"""Which numbers cannot be negative, by how they are computed and by what was tested."""

from __future__ import annotations

from rebsync.reverse.analysis.facts import Facts, IsBelow, IsPositive, IsSize, tested
from rebsync.reverse.analysis.held_values import held_by
from rebsync.reverse.analysis.origins import LibraryOrigin
from rebsync.reverse.analysis.problems import ProblemNotes
from rebsync.reverse.analysis.stores import AnyValue, CallResult, TemporaryVariable
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.ir.walk import walk

_UNSIGNED = tuple(t.Integer(bits, False) for bits in (8, 16, 32, 64))
_DEPTH = 4  # of variables that are computed from others
_SIZING = ("::resize", "::reserve")
_KEEPING = frozenset(
    {
        *(Operator.ADD, Operator.MULTIPLY, Operator.SHIFT_RIGHT),
        *(Operator.FLOOR_DIVIDE, Operator.TRUE_DIVIDE, Operator.TRUNCATING_DIVIDE),
    }
)


class Signs:
    """Numbers of one function."""

    def __init__(self, notes: ProblemNotes) -> None:
        self._notes = notes
        self._active: set[e.Local] = set()

    def is_positive(self, value: e.Expression, facts: Facts) -> bool:
        """Whether a number is zero or more."""
        if any(isinstance(f, IsPositive | IsSize | IsBelow) and f.value == value for f in facts):
            return True
        match value:
            case e.Literal(int() | float() as number):
                return number >= 0
            case e.Conditional(test, then, otherwise):
                first = self.is_positive(then, tested(facts, test, True))
                return first and self.is_positive(otherwise, tested(facts, test, False))
            case e.Convert(_, operand, type_):
                is_wide = isinstance(type_, t.Float) or (
                    isinstance(type_, t.Integer) and (type_.bits or 64) >= 32
                )
                return is_wide and self.is_positive(operand, facts)
            case e.AddressOf(target):
                return self.is_positive(target, facts)
            case e.Binary():
                return self._is_computed(value, facts)
            case e.Local() if self._is_counter(value):
                return True
            case e.Local() | e.Global() | e.Captured() | e.Attribute() if self._is_written(value):
                return True
            case e.Temporary(number) if self._is_range_or_size(number, facts):
                return True
            case _:
                return getattr(value, "type", None) in _UNSIGNED

    def _is_computed(self, value: e.Binary, facts: Facts) -> bool:
        """What an operator gives; whole numbers with a bound may wrap."""
        bits = value.type.bits if isinstance(value.type, t.Integer) else None
        match value:
            case e.Binary(Operator.FLOOR_MODULO, left, right):
                held = self._notes.origins.of(left, self._notes.function.name)
                is_text = LibraryOrigin("str", True) in held
                return self.is_positive(right, facts) and not is_text
            case e.Binary(Operator.BIT_AND, left, right):
                return any(self.is_positive(part, facts) for part in (left, right))
            case e.Binary() if bits is not None:
                return value.type in _UNSIGNED and value.operator is not Operator.SUBTRACT
            case e.Binary(Operator.POWER, _, e.Literal(int() as power)) if power % 2 == 0:
                return True
            case e.Binary(Operator.MULTIPLY, left, right) if left == right:
                return True
            case e.Binary(operator, left, right) if operator in _KEEPING:
                return all(self.is_positive(part, facts) for part in (left, right))
            case _:
                return False

    def _is_range_or_size(self, number: int, facts: Facts) -> bool:
        """Whether a temporary holds what a function gives that never gives less than zero."""
        key = TemporaryVariable(self._notes.function.name, number)
        stored = [v for _, v in self._notes.origins.graph.stores.of(key)]
        return bool(stored) and all(
            isinstance(v, CallResult) and self._is_from_zero(v.call, facts) for v in stored
        )

    def _is_from_zero(self, call: s.Call, facts: Facts) -> bool:
        if not isinstance(call.callee, s.LibraryCallee):
            return False
        values = [a.value for a in call.arguments]
        match call.callee.name:
            case "builtins.abs" | "math.fabs" | "builtins.len" | "math.sqrt" | "math.hypot":
                return True
            case "builtins.max":
                return len(values) > 1 and any(self.is_positive(v, facts) for v in values)
            case "builtins.min":
                return len(values) > 1 and all(self.is_positive(v, facts) for v in values)
            case "builtins.range":
                return len(values) == 1 or self._is_upwards(values)
            case _:
                return False

    def _is_upwards(self, values: list[e.Expression]) -> bool:
        """Whether the numbers of a range begin at zero or more, and do not go down."""
        written = [v for v in (values[0], *values[2:]) if isinstance(v, e.Literal)]
        numbers = [v.value for v in written if isinstance(v.value, int)]
        return len(numbers) == len(values) - 1 and all(n >= 0 for n in numbers)

    def _is_written(self, value: e.Expression) -> bool:
        """Whether all that is ever stored under a name is written as zero or more.

        What sets a size takes a reference to a number, and leaves it as it is.
        """
        stored = [v for _, v in held_by(self._notes.origins, value, self._notes.function.name)]
        calls = [n for n in walk(self._notes.function) if isinstance(n, s.Call)]
        sizes = [c for c in calls if isinstance(c.callee, s.LibraryCallee)]
        lent = sum(
            isinstance(a.value, e.AddressOf) and a.value.target == value
            for c in sizes
            if c.callee.name.endswith(_SIZING)  # type: ignore[union-attr]
            for a in c.arguments
        )
        numbers = [v.value for v in stored if isinstance(v, e.Literal)]
        are_positive = all(isinstance(n, int | float) and n >= 0 for n in numbers)
        others = [v for v in stored if not isinstance(v, e.Literal)]
        is_lent = len(others) <= lent and all(isinstance(v, AnyValue) for v in others)
        return bool(numbers) and are_positive and is_lent

    def _is_counter(self, variable: e.Local) -> bool:
        """Whether all that a variable of Python gets in its function is zero or more."""
        function = self._notes.function
        is_typed = isinstance(variable.type, t.Integer) and variable.type.bits is not None
        if is_typed or variable.name in function.captured or self._notes.is_parameter(variable):
            return False
        if variable in self._active:
            return True
        if len(self._active) >= _DEPTH:
            return False
        self._active.add(variable)
        try:
            nodes = [n for n in walk(function) if getattr(n, "target", None) == variable]
            return bool(nodes) and all(map(self._stores_positive, nodes))
        finally:
            self._active.discard(variable)

    def _stores_positive(self, node: object) -> bool:
        no_facts: Facts = frozenset()
        match node:
            case s.Assign(_, value) | s.Declare(_, _, value) if value is not None:
                return self.is_positive(value, no_facts)
            case s.CompoundAssign(_, operator, value) if operator in _KEEPING:
                return self.is_positive(value, no_facts)
            case s.Call():
                return self._is_from_zero(node, no_facts)
            case s.ForEach(_, e.Temporary() as iterable):
                return self.is_positive(iterable, no_facts)
            case _:
                return False
