"""The interface between the parts of the reader of generated expressions, and their state."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import field as with_default
from dataclasses import replace
from typing import ClassVar, TypeVar

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.findings import Unread
from rebsync.reverse.python.expressions.operands import OperandReader
from rebsync.reverse.python.expressions.values import OTHER, Value
from rebsync.reverse.python.generated.cuts import Cuts
from rebsync.reverse.python.generated.kinds import kind_of
from rebsync.reverse.python.generated.names import Callee, Closure, ModelNames
from rebsync.reverse.syntax.py_tree import Py
from rebsync.source import Span
from rebsync.static.types import BOOLEAN, DOUBLE, INT

_Reader = TypeVar("_Reader", bound="ModelExpressionReader")
_ASKING = frozenset({"bool", "boolean", "to_boolean", "assertion", "any", "all"})


@dataclass(eq=False, slots=True)
class ModelExpressionReader(OperandReader):
    """Reads the expressions of one body; `locals` are its variables by their names in Python.

    `types` are those of the locals, by their names in the model; `bound` names that stand for an
    expression while a comprehension is read; `closures` what functions of the body give, which do
    nothing; `kept_sends` what sends, by the names of locals that stand for it, and `kept_tables`
    what is looked up; `moments` the times of sends, by those that hold them; `own` is what the
    object is called; `cuts` are the integers that are cut to the width that they have in the model.
    """

    py: Py
    names: ModelNames
    locals: dict[str, str] = with_default(default_factory=dict)
    kept: dict[str, Node] = with_default(default_factory=dict)
    types: dict[str, m.Type] = with_default(default_factory=dict)
    bound: dict[str, m.Expression] = with_default(default_factory=dict)
    closures: dict[str, Closure] = with_default(default_factory=dict)
    kept_sends: dict[str, Callee] = with_default(default_factory=dict)
    kept_tables: dict[str, Node] = with_default(default_factory=dict)
    moments: dict[str, dict[str, m.Name]] = with_default(default_factory=dict)
    own: str = "self"
    cuts: Cuts = with_default(default_factory=Cuts)

    mixes: ClassVar[bool] = False
    asking: ClassVar[frozenset[str]] = _ASKING

    @property
    def rounds_to_whole(self) -> bool:
        return True

    def unread(self, node: Node, why: str) -> Unread:
        return Unread(self.py.span(node), why)

    def span(self, node: Node) -> Span:
        return self.py.span(node)

    def hides(self, comprehension: Node) -> bool:
        return True

    def value(self, expression: m.Expression) -> Value:
        """An expression with its kind."""
        kind = self.kind(expression)
        return Value(expression, kind.name if kind in (INT, DOUBLE, BOOLEAN) else OTHER)

    def read(self, node: Node) -> Value:
        return self.value(self.expression(node))

    @abstractmethod
    def expression(self, node: Node) -> m.Expression:
        """An expression. Unread: the model has none for it."""

    def hides_name(self, name: str) -> bool:
        """Whether a name is one of the body's own, whatever the module calls so."""
        own = self.locals, self.closures, self.kept_sends, self.kept, self.kept_tables, self.moments
        is_part = any(name == each.partition(".")[0] for each in self.bound)
        return is_part or any(name in names for names in own)

    def of_run_time(self, called: str) -> str:
        """What the run-time part calls a function; what is none of it as it is called."""
        is_own = self.hides_name(called.partition(".")[0])
        return called if is_own else self.names.constants.of_run_time(called)

    def variable(self, name: str) -> str | None:
        """The variable of the model that a name or attribute is."""
        return self.locals.get(name) or self.names.variables.get(name.removeprefix("self."))

    def kind(self, expression: m.Expression) -> m.Type | None:
        """The widest type of the kind of an expression, if it can be told."""
        return kind_of(
            expression, lambda n: self.types.get(n, self.names.types.get(n)), self.names.results
        )

    @contextmanager
    def standing_for(self, names: Sequence[str], values: Sequence[Value]) -> Iterator[None]:
        """Lets names stand for expressions meanwhile."""
        outer = dict(self.bound)
        self.bound.update(zip(names, (v.expression for v in values), strict=True))
        try:
            yield
        finally:
            self.bound.clear()
            self.bound.update(outer)

    def inside(self: _Reader, bound: Mapping[str, m.Expression]) -> _Reader:
        """A reader of a method that is read in its place, where its parameters are expressions.

        Locals of the caller have no names there, but still hide variables of these names.
        """
        hidden = {f"around {name}": local for name, local in self.locals.items()}
        around = replace(self, locals=hidden, bound=dict(bound), kept={}, closures={})
        return replace(around, kept_sends={}, kept_tables={}, moments={})

    @abstractmethod
    def index(self, node: Node) -> m.Expression:
        """An index: as it is, kept in a name, or checked by `at` of an array that is."""

    @abstractmethod
    def stored(
        self, target: m.Expression, place: Node, value: Node, whole: Node, statement: bool = False
    ) -> m.Expression:
        """An assignment: `x = int32.add(x, 1)` is what the model writes `x++`, or `++x`."""
