"""The interface between the parts of the reader of people's expressions, and their state."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import ClassVar

from tree_sitter import Node

from rebsync import model as m
from rebsync.intervals import INT32, Interval
from rebsync.literals import exact_literal_of
from rebsync.records import dataclass
from rebsync.reverse.analysis.intervals.needs import Need
from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import bare, cast
from rebsync.reverse.models.texts import text_literal
from rebsync.reverse.python.bodies.body_reading import Reading
from rebsync.reverse.python.bodies.body_scope import Frame, Meaning, Message, Nobody, Own, unknown
from rebsync.reverse.python.expressions.operands import OperandReader
from rebsync.reverse.python.expressions.values import STRING, WHOLE, Value
from rebsync.reverse.python.values.interfaces import interface_of
from rebsync.reverse.syntax.py_tree import field, text_of
from rebsync.source import Span
from rebsync.static.types import DOUBLE


@dataclass(eq=False, slots=True)
class BodyExpressionReader(OperandReader):
    """Reads the expressions of one run of a function."""

    reading: Reading
    frame: Frame
    within: str
    running: tuple[int, ...] = ()
    mixes: ClassVar[bool] = True

    def meaning(self, node: Node) -> tuple[Meaning, str]:
        """What a name or attribute stands for, and the path of fields behind it."""
        if node.type == "identifier":
            return self.reading.name(text_of(node), node, self.frame), ""
        if node.type != "attribute":
            return Nobody(), ""
        holder, name = field(node, "object"), text_of(field(node, "attribute"))
        meaning, path = self.meaning(holder)
        if isinstance(meaning, Own) and not path:
            return self.reading.attribute(name, node, self.frame), ""
        if isinstance(meaning, Message):
            number = self.reading.types.constant(meaning.type, name) if not path else None
            if number is not None:
                return _constant(number), ""
            return meaning, f"{path}.{name}" if path else name
        if self.reading.values.is_stored(name) or not isinstance(meaning, Nobody | Value):
            return Nobody(), ""
        found = self.reading.constant(self.reading.values.ways(node, self.frame.scope))
        return found or self._constant_of_message(node) or Nobody(), ""

    def _constant_of_message(self, node: Node) -> Value | None:
        """`Mode.RUN`: a constant of a message type of the package."""
        type_, _, name = self.reading.external(node, self.frame).rpartition(".")
        of = interface_of(type_) if type_ else None
        number = self.reading.types.constant(of, name) if of is not None else None
        return _constant(number) if number is not None else None

    def real(self, value: Value, node: Node, what: str = "real") -> m.Expression:
        """A number where the model is to compute with 64 bits."""
        if value.kind == STRING:
            raise unknown(self.frame, node, "a number that a text is")
        if value.kind == WHOLE:
            self.need(value, node, what)
            inner = bare(value.expression)
            if isinstance(inner, m.IntLiteral):
                return exact_literal_of(float(inner.value))
            return cast(DOUBLE, value.expression)
        return cast(DOUBLE, value.expression) if value.single else value.expression

    def need(
        self,
        value: Value,
        node: Node,
        what: str = "",
        within: Interval = INT32,
        strict: str = "",
    ) -> m.Expression:
        """The value, of which the model must have the same number."""
        if self._is_refused(node, what):
            if strict:
                raise Unread(self.span(node), strict)
            raise unknown(self.frame, node, "a number that may be beyond its int")
        self._noted(value.expression, node, what, within)
        return value.expression

    def _noted(self, expression: m.Expression, node: Node, what: str, within: Interval) -> None:
        mark = (self.frame.py.source.path, node.start_byte, node.end_byte, what)
        plain = bare(expression)
        self.reading.needs.setdefault(id(plain), []).append(Need(plain, within, mark))

    def _is_refused(self, node: Node, what: str) -> bool:
        mark = (self.frame.py.source.path, node.start_byte, node.end_byte, what)
        return self.reading.learnt.is_refused(mark)

    def span(self, node: Node) -> Span:
        return self.frame.span(node)

    def unread(self, node: Node, why: str) -> Unknown:
        return Unknown(self.span(node), why, "")

    @property
    def rounds_to_whole(self) -> bool:
        return self.reading.unit.version == 3

    def library(self, function: Node) -> str:
        return self.reading.external(function, self.frame)

    def may_fail(self, node: Node) -> bool:
        return False  # what may raise is asked of whole statements: `body_raising`

    @contextmanager
    def standing_for(self, names: Sequence[str], values: Sequence[Value]) -> Iterator[None]:
        bound = self.frame.bound
        outer = dict(bound)
        bound.update(zip(names, values, strict=True))
        try:
            yield
        finally:
            bound.clear()
            bound.update(outer)

    @abstractmethod
    def note(self, node: Node, why: str) -> None:
        """Lists a place of which the model allows more than the code."""


def _constant(value: int | str) -> Value:
    """A constant of a message type."""
    if isinstance(value, str):
        return Value(text_literal(value), STRING)
    return Value(exact_literal_of(value), WHOLE)
