"""Expressions of Python as expressions of the model.

Whole numbers of Python have no bounds: each place where the model must have the same number is
noted as a need, which following all bodies shows to hold or not.
"""

from __future__ import annotations

from collections.abc import Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync import precedence
from rebsync.intervals import INT32, Interval, unsigned
from rebsync.literals import exact_literal_of
from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import bare, binary, chosen, is_calm, negated, tight
from rebsync.reverse.models.texts import text_literal
from rebsync.reverse.python.bodies import (
    body_calls,
    body_functions,
    body_presence,
    body_tables,
    body_texts,
)
from rebsync.reverse.python.bodies.body_effects import is_harmless, stores_around
from rebsync.reverse.python.bodies.body_expression_reader import BodyExpressionReader
from rebsync.reverse.python.bodies.body_floats import doubled, is_zero
from rebsync.reverse.python.bodies.body_scope import Message, Pending, Var, unknown
from rebsync.reverse.python.expressions.conditions import comparison, connected, signs_of
from rebsync.reverse.python.expressions.values import REAL, STRING, TRUTH, WHOLE, Value, as_number
from rebsync.reverse.syntax.py_tree import (
    field,
    named,
    number_of,
    text_in,
    text_of,
)

_POSITIVE = Interval(1, INT32.high)
_DIVISOR = "a divisor that may be 0 or negative"
_RING = frozenset({"+", "-", "*"})
_HUGE = 1e300
_BITS = frozenset({"&", "|", "^"})


@dataclass(eq=False, slots=True)
class PyExpressions(BodyExpressionReader):
    """Reads the expressions of one run of a function."""

    def read(self, node: Node) -> Value:
        """An expression; `Unknown` is raised where nobody knows its value."""
        try:
            return self._read(node)
        except Unread:
            # The model has nothing of it: neither what was read before this was found.
            path, span = self.frame.py.source.path, self.span(node)
            within = {p for p in self.reading.exact if p[0] == path and span.holds(p[1])}
            self.reading.exact -= within
            raise

    def _read(self, node: Node) -> Value:
        match node.type:
            case "integer" | "float":
                return self._number(node)
            case "true" | "false":
                return Value(m.BoolLiteral(node.type == "true", self.span(node)), TRUTH)
            case "parenthesized_expression" if len(named(node)) == 1:
                inner = self.read(named(node)[0])
                plain = isinstance(inner.expression, (m.Name, m.Paren, m.Call))
                shown = inner.expression if plain else m.Paren(inner.expression)
                return Value(shown, inner.kind, inner.single, inner.mixed)
            case "identifier" | "attribute":
                return self._place(node)
            case "named_expression" if node.id in self.reading.stored:
                return self._place(field(node, "name"))
            case "unary_operator" | "not_operator":
                return self._unary(node)
            case "string" | "concatenated_string" if (text := text_in(node)) is not None:
                return Value(text_literal(text, self.span(node)), STRING)
            case "binary_operator" if body_texts.is_operation(node):
                return self.operation(
                    text_of(field(node, "operator")),
                    self.read(field(node, "left")),
                    self.read(field(node, "right")),
                    node,
                )
            case "comparison_operator":
                return Value(self._compared(node), TRUTH)
            case "boolean_operator":
                return connected(self, node)
            case "conditional_expression" if len(named(node)) == 3:
                return self._conditional(node)
            case "subscript":
                return body_tables.element(self, node)
            case "call":
                found = body_calls.called(self, node)
                self._is_exact(node)
                return found
            case _:
                raise unknown(self.frame, node, f'"{short(node)}"')

    def _is_exact(self, node: Node) -> None:
        """Notes that the model has a value or operation: it is shown to raise nothing."""
        self.reading.exact.add((self.frame.py.source.path, self.span(node)))

    def condition(self, node: Node) -> m.Expression:
        """A condition; one that nobody knows may be true or false, and is listed."""
        there = body_presence.is_there(self, node)
        if there is not None:
            return there
        try:
            return self.truth(self.read(node), node)
        except Unknown as open_:
            if not is_harmless(self.reading, node, self.frame):
                raise Unread(open_.span, open_.why, open_.hint) from open_
            self.note(node, open_.why)
            return m.Choice((m.BoolLiteral(True), m.BoolLiteral(False)), self.span(node))

    def note(self, node: Node, why: str) -> None:
        """Lists a place of which the model allows more than the code."""
        source = self.frame.py.source
        self.reading.findings.approximated(source, self.span(node), why, "", self.within)

    def truth(self, value: Value, node: Node) -> m.Expression:
        """What Python takes for true."""
        if value.kind == TRUTH:
            return bare(value.expression)
        if value.kind == STRING:
            return body_texts.is_filled(self, value, node)
        zero = exact_literal_of(0 if value.kind == WHOLE else 0.0)
        if value.kind == WHOLE:
            self.need(value, node)
        return binary("!=", value.expression, zero, self.span(node))

    # --- names ----------------------------------------------------------------------------------

    def _place(self, node: Node) -> Value:
        meaning, path = self.meaning(node)
        match meaning:
            case Value():
                return meaning
            case Message() if path:
                return self.reading.read_field(meaning, path, node, self.frame)
            case Var():
                return self._variable(meaning, node)
            case _:
                if "_parameter(" in text_of(node):
                    return body_calls.parameter(self, node)
                found = body_functions.value_of_property(self, node)
                if found is None:
                    raise unknown(self.frame, node, f'"{short(node)}"')
                return found

    def _variable(self, variable: Var, node: Node) -> Value:
        kind = self.reading.learnt.kind(variable.key)
        if kind is None:
            self.reading.learnt.pending.add(variable.key)
            raise Pending(self.span(node), f'nothing that is read gives "{short(node)}" a value')
        owner = self.frame.owner_of(variable.key) or self.frame
        if not variable.is_state and text_of(node) not in owner.assigned:
            if kind == STRING:
                raise unknown(self.frame, node, f'"{short(node)}"')
            raise Unread(self.span(node), f'"{short(node)}" may have no value yet')
        self._is_exact(node)
        mixed = self.reading.learnt.is_mixed(variable.key)
        return Value(m.Name(variable.name, self.span(node)), kind, mixed=mixed)

    # --- operators ------------------------------------------------------------------------------

    def _number(self, node: Node) -> Value:
        number = number_of(node)
        if isinstance(number, int) and number > INT32.high:
            raise unknown(self.frame, node, "a number beyond its int")
        if number is None or abs(number) > _HUGE:
            raise Unread(self.span(node), "this number is none of the model")
        return Value(exact_literal_of(number), REAL if isinstance(number, float) else WHOLE)

    def _unary(self, node: Node) -> Value:
        inner = field(node, "argument")
        if node.type == "not_operator":
            return Value(negated(self.condition(inner)), TRUTH)
        value, operator = self.read(inner), text_of(field(node, "operator"))
        if value.kind == STRING:
            raise unknown(self.frame, node, f'"{short(node)}"')
        value = as_number(value)
        if operator == "~" and value.kind != WHOLE:
            raise Unread(self.span(node), f'"{operator}" of such a value is not read')
        if operator == "+":
            return value
        operand = tight(value.expression, precedence.PREFIX)
        found = m.Unary(operator, operand, self.span(node))
        return Value(found, value.kind, value.single, value.mixed)

    def operation(self, operator: str, left: Value, right: Value, node: Node) -> Value:
        """An operation on two numbers."""
        found = self._operation(operator, left, right, node)
        self._is_exact(node)
        return found

    def _operation(self, operator: str, left: Value, right: Value, node: Node) -> Value:
        if STRING in (left.kind, right.kind):
            return body_texts.joined(self, operator, left, right, node)
        if left.kind == right.kind == TRUTH and operator in _BITS:
            return self._bits_of_truth(operator, left, right, node)
        left, right = as_number(left), as_number(right)
        if left.kind == right.kind == WHOLE:
            return self._whole(operator, left, right, node)
        if operator in ("*", "+", "-", "/"):
            if operator == "/":
                self._is_not_zero(right, node)
                self._is_real(left, right, node)
            sides = self.real(left, node), self.real(right, node)
            return Value(doubled(operator, *sides, self.span(node)), REAL)
        raise Unread(self.span(node), f'"{operator}" of floats has no like in the model')

    def _bits_of_truth(self, operator: str, left: Value, right: Value, node: Node) -> Value:
        """`|`, `&` and `^` of two truth values, both of which are looked at."""
        if not is_calm(right.expression):
            raise Unread(self.span(node), f'"{operator}" of such values is not read')
        sign = {"|": "||", "&": "&&", "^": "!="}[operator]
        return Value(binary(sign, left.expression, right.expression, self.span(node)), TRUTH)

    def _whole(self, operator: str, left: Value, right: Value, node: Node) -> Value:
        if operator in _RING:
            return Value(
                binary(operator, left.expression, right.expression, self.span(node)), WHOLE
            )
        if operator == "/" and self.reading.unit.version != 2:
            self._is_real(left, right, node)
            self._is_not_zero(right, node)
            sides = self.real(left, node), self.real(right, node, "right")
            return Value(doubled("/", *sides, self.span(node)), REAL)
        if operator in ("/", "//", "%"):
            return self._divided("%" if operator == "%" else "/", left, right, node)
        if operator in _BITS or operator == ">>":
            self.need(left, node, "left")
            self.need(right, node, "right", Interval(0, 31) if operator == ">>" else INT32)
            found = binary(operator, left.expression, right.expression, self.span(node))
            return Value(found, WHOLE)
        match right.expression:
            case m.IntLiteral(places) if operator == "<<" and places < 31:
                by = m.IntLiteral(1 << places)
                return Value(binary("*", left.expression, by, self.span(node)), WHOLE)
        raise Unread(self.span(node), f'"{operator}" is not read')

    def _divided(self, operator: str, left: Value, right: Value, node: Node) -> Value:
        """Python rounds down, the model towards 0: the same where nothing is negative."""
        by = bare(right.expression)
        self.need(right, node, "by", _POSITIVE, strict=_DIVISOR)
        span = self.span(node)
        if not self._is_refused(node, "dividend"):
            self._noted(left.expression, node, "dividend", unsigned(31))
            return Value(binary(operator, left.expression, right.expression, span), WHOLE)
        if not isinstance(by, m.IntLiteral) or not 0 < by.value < 1 << 30:
            raise Unread(span, "it rounds down where the model's rounds towards 0")
        self.need(left, node, "left")
        rest = binary("%", binary("+", binary("%", left.expression, by), by), by, span)
        if operator == "%":
            return Value(rest, WHOLE)
        if not is_calm(left.expression):
            raise Unread(span, "it rounds down where the model's rounds towards 0")
        above = Value(binary("-", left.expression, rest), WHOLE)
        return Value(binary("/", self.need(above, node, "above"), by, span), WHOLE)

    def _is_not_zero(self, value: Value, node: Node) -> None:
        match bare(value.expression):
            case m.IntLiteral(number):
                if not number:
                    raise Unread(self.span(node), _DIVISOR)
                return
            case m.FloatLiteral() | m.Unary("-", m.FloatLiteral() | m.IntLiteral()):
                if not any(
                    isinstance(n, (m.FloatLiteral, m.IntLiteral)) and is_zero(n)
                    for n in m.walk(value.expression)
                ):
                    return
        if value.kind == WHOLE:
            self.need(value, node, "by", _POSITIVE, strict=_DIVISOR)
            return
        raise Unread(self.span(node), "it may divide by 0, which ends the callback in Python")

    def _is_real(self, left: Value, right: Value, node: Node) -> None:
        if self.reading.unit.version != 3 and not (_is_float(left) or _is_float(right)):
            raise Unread(
                self.span(node),
                "Python 2 and 3 divide whole numbers differently, and the file may be of either",
                "say which in its first line: #!/usr/bin/env python3",
            )

    # --- conditions -----------------------------------------------------------------------------

    def _compared(self, node: Node) -> m.Expression:
        operands = named(node)
        signs = signs_of(node)
        if (there := body_presence.compared_with_none(self, operands, signs)) is not None:
            return there.expression
        if (same := body_presence.identical(self, operands, signs, node)) is not None:
            return same
        if (same := body_texts.identical(self, operands, signs, node)) is not None:
            return same
        return comparison(self, node)

    def compared(
        self, sign: str, left: Value, right: Value, node: Node, number: int
    ) -> m.Expression:
        """The comparison with a number in `node`."""
        if STRING in (left.kind, right.kind):
            return body_texts.compared(self, sign, left, right, node)
        pair = self._pair(left, right, node, number)
        return binary("!=" if sign == "<>" else sign, *pair, self.span(node))

    def hides(self, comprehension: Node) -> bool:
        clauses = (c for c in named(comprehension) if c.type == "for_in_clause")
        return not any(stores_around(self.reading, c, self.frame) for c in clauses)

    def container(self, node: Node, ordered: bool) -> Sequence[Value] | None:
        return body_tables.container(self, node, ordered)

    def table(self, node: Node) -> Sequence[tuple[Value, Value]] | None:
        return body_tables.table(self, node)

    def _pair(
        self, left: Value, right: Value, node: Node, number: int
    ) -> tuple[m.Expression, m.Expression]:
        if not left.kind == right.kind == TRUTH:
            left, right = as_number(left), as_number(right)
        for side, value in (("left", left), ("right", right)):
            if value.kind == WHOLE:
                self.need(value, node, f"{side} {number}")
        if left.kind == right.kind:
            return left.expression, right.expression
        return self.real(left, node), self.real(right, node)

    def _conditional(self, node: Node) -> Value:
        then, condition, otherwise = named(node)
        asked = self.condition(condition)
        return self.joined(asked, self.read(then), self.read(otherwise), node)

    def joined(self, asked: m.Expression, one: Value, other: Value, node: Node) -> Value:
        """One of two values, as a condition says."""
        if STRING in (one.kind, other.kind) and one.kind != other.kind:
            raise unknown(self.frame, node, f'"{short(node)}"')
        if TRUTH in (one.kind, other.kind) and one.kind != other.kind:
            raise Unread(self.span(node), "its values are of two kinds")
        if one.kind == other.kind == WHOLE or one.kind in (TRUTH, STRING):
            mixed = one.kind == STRING and (one.mixed or other.mixed)
            found = chosen(asked, one.expression, other.expression)
            return Value(found, one.kind, mixed=mixed)
        sides = self.real(one, node, "one"), self.real(other, node, "other")
        mixed = one.mixed or other.mixed or WHOLE in (one.kind, other.kind)
        return Value(chosen(asked, *sides), REAL, mixed=mixed)


def _is_float(value: Value) -> bool:
    return value.kind == REAL and not value.mixed


def short(node: Node) -> str:
    text = " ".join(text_of(node).split())
    return text if len(text) <= 40 else f"{text[:37]}..."
