"""What methods must give that Python calls by itself: it refuses other results with a TypeError.

`__bool__` gives a truth value, `__len__` a size; what no type is known of is refused too.
"""

from __future__ import annotations

from collections.abc import Mapping

from rebsync.reverse.analysis.facts import Facts
from rebsync.reverse.analysis.held_values import held_by
from rebsync.reverse.analysis.outcomes.outcome_expressions import OutcomeExpressions
from rebsync.reverse.analysis.python.library_arguments import LibraryArguments
from rebsync.reverse.analysis.stores import CallResult, Stored
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import COMPARISONS, Operator
from rebsync.reverse.ir.program import Function, FunctionKind
from rebsync.reverse.libraries.routines import Language

_WRONG = "is of another type"
_TRUTH, _ITERATOR = "truth", "iterator"
# The kinds of results, as arguments of libraries have them.
_RESULTS: Mapping[str, str] = {
    **{"__bool__": _TRUTH, "__iter__": _ITERATOR, "__len__": "natural", "__hash__": "whole"},
    **{"__index__": "whole", "__int__": "whole", "__str__": "text", "__repr__": "text"},
    "__format__": "text",
}
_TELLING = frozenset(
    {"builtins.bool", "builtins.isinstance", "builtins.any", "builtins.all", "builtins.hasattr"}
)
_ITERATORS = frozenset(
    f"builtins.{name}" for name in ("iter", "map", "filter", "zip", "enumerate", "reversed")
)
_DEEPEST = 3  # of variables that are stored in others


class SpecialResults:
    """The results of one function."""

    def __init__(self, expressions: OutcomeExpressions, arguments: LibraryArguments) -> None:
        self._expressions = expressions
        self._notes = expressions.notes
        self._arguments = arguments
        self._kind = kind_of(self._notes.function, self._notes.table.language)

    def check(self, node: s.Return, facts: Facts) -> None:
        """Notes a result that is refused."""
        if not self._kind:
            return
        value = e.Literal(None) if node.value is None else node.value
        match self._kind:
            case "truth":
                is_right = self._is_truth((self._notes.function.name, value), 0)
            case "iterator":
                is_right = self._is_iterator(value)
            case kind:
                is_right = self._arguments.is_within(value, kind, facts)
        if not is_right:
            self._notes.fails(node, _WRONG)

    def _is_truth(self, stored: Stored, depth: int) -> bool:
        function, value = stored
        match value:
            case e.Literal(constant):
                return isinstance(constant, bool)
            case e.Unary(Operator.NOT) | CallResult(s.Call(_, s.LibraryCallee("builtins.bool"))):
                return True
            case e.Binary(operator, left, right) if operator in COMPARISONS:
                own = self._notes.origins.own_classes
                return not (own(left, function) or own(right, function))
            case e.And(left, right) | e.Or(left, right) | e.Conditional(_, left, right):
                return all(self._is_truth((function, each), depth) for each in (left, right))
            case CallResult(s.Call(_, s.LibraryCallee(name))):
                return name in _TELLING
            case e.Local() | e.Temporary() | e.Captured() | e.Global() | e.Attribute():
                held = held_by(self._notes.origins, value, function) if depth < _DEEPEST else []
                return bool(held) and all(self._is_truth(each, depth + 1) for each in held)
            case _:
                return False

    def _is_iterator(self, value: e.Expression) -> bool:
        """Whether a value gives elements itself: an iterator of Python's, or one of a class."""
        held = held_by(self._notes.origins, value, self._notes.function.name)
        called = [getattr(v.call.callee, "name", "") for _, v in held if isinstance(v, CallResult)]
        if held and len(called) == len(held):
            return _ITERATORS.issuperset(called)
        own = e.Local(self._notes.function.receiver or "")
        name = self._notes.function.owner if value == own else None
        return name is not None and self._notes.origins.has_method(name, "__next__")


def kind_of(function: Function, language: Language) -> str:
    """The kind of what a method must give; empty for any."""
    if language is not Language.PYTHON or function.owner is None:
        return ""
    is_plain = function.kind is FunctionKind.FUNCTION
    return _RESULTS.get(function.name.rpartition(".")[2], "") if is_plain else ""
