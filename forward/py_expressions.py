"""Expressions of the model in Python (rows "Behaviour" of the mapping).

Python's integers have no width and its arithmetic no order of widths: what the model wraps or
rounds is wrapped by `int32(...)` and its kin, at the latest where the value is used.
"""

from __future__ import annotations

from rebsync import model as m
from rebsync import precedence
from rebsync.forward.py_calls import call
from rebsync.forward.py_expression_writer import PyExpressionWriter
from rebsync.forward.py_operators import (
    ATOM,
    BINARY,
    COMPARISON,
    NOT,
    TERNARY,
    UNARY,
    Text,
    atom,
    float_literal,
)
from rebsync.forward.py_places import assigned, stepped
from rebsync.forward.py_ranges import fits, is_distance, value_range
from rebsync.forward.py_types import py_format, py_string
from rebsync.intervals import Interval
from rebsync.names import graph_name
from rebsync.records import dataclass
from rebsync.static.constants import constant
from rebsync.static.symbols import BuiltinSymbol, EnvSymbol, KnownRebecSymbol, StateSymbol
from rebsync.static.types import DOUBLE, FLOAT, INT, is_boolean, is_floating, is_integer, wider

_CLOCK = {
    "now": "self._mailbox.now()",
    "currentMessageArrival": "self._mailbox.arrival()",
    "currentMessageDeadline": "self._mailbox.expiry()",
    "currentMessageWaitingTime": "self._mailbox.waiting_time()",
    "sender": "self._mailbox.sender()",
}
_WORDS = {"&&": "and", "||": "or"}
_CASTS = {
    "byte": "to_byte",
    "short": "to_short",
    "int": "to_int",
    "float": "to_float",
    "double": "to_double",
    "boolean": "to_boolean",
}
_SHIFTS = {"<<": "shift_left", ">>": "shift_right"}
_COMPARED = frozenset({"<", "<=", ">", ">=", "==", "!="})
_EXACT = 2**24  # integers below are floats as well


@dataclass(slots=True)
class PyExpressions(PyExpressionWriter):
    """Prints the expressions of one class.

    `seen` has what samples the sensor of a draw; `locals` the names of local variables, by their
    declaration; `temporaries` counts those that a body needs to keep the order of evaluation.
    """

    def text(self, expression: m.Expression) -> str:
        """The expression, of exactly the value that it has in the model."""
        return self._exact(expression).text

    def stored(self, expression: m.Expression, type_: m.Type) -> str:
        """The expression as it is stored in a variable of a type."""
        if type_.dimensions:
            text = self.text(expression)
            return text if isinstance(expression, m.Call) else f"copied({text})"
        given = self.type_of(expression)
        if is_integer(type_) and given is not None and is_integer(given):
            raw = self.raw(expression).text
            narrow = not fits(self._range(expression), type_.name)
            return f"{py_format(type_)}({raw})" if narrow else raw
        return self._converted(expression, type_).text

    def is_whole(self, expression: m.Expression) -> bool:
        """Whether an expression is of integers."""
        type_ = self.type_of(expression)
        return type_ is not None and is_integer(type_)

    def operand(self, expression: m.Expression, least: int, exact: bool = True) -> str:
        """The expression as an operand of an operator that binds at a level."""
        found = self._exact(expression) if exact else self.raw(expression)
        return found.at(least)

    def _range(self, expression: m.Expression) -> Interval:
        return value_range(expression, self.type_of)

    def _exact(self, expression: m.Expression) -> Text:
        raw = self.raw(expression)
        if self.is_whole(expression) and not fits(self._range(expression), "int"):
            return atom(f"int32({raw.text})")
        return raw

    def _converted(self, expression: m.Expression, type_: m.Type) -> Text:
        """The expression as a value of a type with a point, where it is none yet."""
        if type_ in (FLOAT, DOUBLE) and self.is_whole(expression):
            return atom(f"{py_format(type_)}({self.text(expression)})")
        return self._exact(expression)

    # --- kinds of expressions -------------------------------------------------------------------

    def raw(self, expression: m.Expression) -> Text:
        """The expression, its value not wrapped yet."""
        match expression:
            case m.IntLiteral(value):
                return Text(str(value), UNARY if value < 0 else ATOM)
            case m.FloatLiteral():
                return atom(float_literal(expression.text))
            case m.BoolLiteral():
                return atom("True" if expression.value else "False")
            case m.StringLiteral():
                return atom(py_string(expression.text))
            case m.NullLiteral():
                return atom("NULL")
            case m.Name():
                return atom(self._name(expression))
            case m.Self():
                return atom("self._mailbox.self()")
            case m.Super():
                return atom("super()")
            case m.Member(target=m.Self(), name=name):
                return atom(f"self.{self.names.members[name]}")
            case m.Member(target=target, name=name):
                return atom(f"{self.text(target)}.{name}")
            case m.Index(target, index):
                return atom(f"{self.operand(target, ATOM)}[{self.text(index)}]")
            case m.Call():
                return atom(call(self, expression))
            case m.Paren(m.Paren() as inner):
                return self.raw(inner)
            case m.Paren(inner):
                found = self.raw(inner)
                return atom(f"({found.text})")
            case _:
                return self._compound(expression)

    def _compound(self, expression: m.Expression) -> Text:
        match expression:
            case m.Cast(type_, operand):
                return atom(self._cast(type_, operand))
            case m.Unary("++" | "--") | m.Postfix():
                return atom(stepped(self, expression))
            case m.Unary("!", operand):
                return Text(f"not {self.operand(operand, NOT)}", NOT)
            case m.Unary(operator, operand):
                return self._signed(operator, operand)
            case m.Binary():
                return self._binary(expression)
            case m.InstanceOf(operand, type_):
                asked = f'{self.text(operand)}, "{graph_name(type_.name)}"'
                return atom(f"self._mailbox.is_a({asked})")
            case m.Conditional():
                return self._conditional(expression)
            case m.Choice():
                return atom(self._choice(expression))
            case m.Assign():
                return atom(assigned(self, expression))
            case m.New() | m.Broken():
                raise ValueError("an expression that the analysis reports as an error")
            case _:
                raise AssertionError(expression)

    def _name(self, name: m.Name) -> str:
        symbol = self.analysis.symbols.get(id(name))
        match symbol:
            case StateSymbol() | KnownRebecSymbol():
                return f"self.{self.names.members[name.name]}"
            case EnvSymbol():
                return f"self.{self.names.env[name.name]}"
            case BuiltinSymbol():
                return _CLOCK[name.name]
            case _:
                declared = id(getattr(symbol, "declaration", None))
                return self.locals.get(declared) or self.names.local(name.name)

    def _cast(self, type_: m.Type, operand: m.Expression) -> str:
        if type_.name in self.class_types:
            return f'to_rebec("{graph_name(type_.name)}", {self.text(operand)})'
        return f"{_CASTS[type_.name]}({self.text(operand)})"

    def _signed(self, operator: str, operand: m.Expression) -> Text:
        type_ = self.type_of(operand)
        exact = type_ is None or not is_integer(type_)
        return Text(f"{operator}{self.operand(operand, UNARY, exact)}", UNARY)

    def _conditional(self, expression: m.Conditional) -> Text:
        type_ = self.type_of(expression) or INT
        parts = [
            self.raw(e) if is_integer(type_) else self._converted(e, type_)
            for e in (expression.then, expression.otherwise)
        ]
        condition = self.operand(expression.condition, TERNARY + 1)
        then, otherwise = parts[0].at(TERNARY + 1), parts[1].at(TERNARY)
        return Text(f"{then} if {condition} else {otherwise}", TERNARY)

    def _choice(self, expression: m.Choice) -> str:
        type_ = self.type_of(expression) or INT
        stored = INT if is_integer(type_) else type_
        options = ", ".join(self.stored(o, stored) for o in expression.options)
        seen = self.seen.get(id(expression))
        return f"self._mailbox.choose([{options}]{f', {seen}' if seen else ''})"

    # --- binary operators -----------------------------------------------------------------------

    def _binary(self, expression: m.Binary) -> Text:
        operator, left, right = expression.operator, expression.left, expression.right
        if operator in _WORDS:
            word = _WORDS[operator]
            level = BINARY[word]
            texts = self.operand(left, level), self.operand(right, level + 1)
            return Text(f"{texts[0]} {word} {texts[1]}", level)
        types = [self.type_of(e) or INT for e in (left, right)]
        if any(is_floating(t) for t in types):
            return self._real(expression, wider(types[0], types[1]))
        if operator in _COMPARED:
            return self._infix(operator, left, right, True)
        if all(is_boolean(t) for t in types):
            return self._infix(operator, left, right, True)
        return self._whole(expression)

    def _whole(self, expression: m.Binary) -> Text:
        operator, left, right = expression.operator, expression.left, expression.right
        if operator in ("/", "%"):
            function = "divide" if operator == "/" else "remainder"
            return atom(f"{function}({self._passed(expression)})")
        if operator in _SHIFTS and not is_distance(right):
            return atom(f"{_SHIFTS[operator]}({self._passed(expression)})")
        return self._infix(operator, left, right, operator == ">>")

    def _passed(self, expression: m.Binary) -> str:
        """The operands as arguments, without the parentheses that only an operator needs."""
        level = precedence.BINARY[expression.operator]
        left = _without(expression.left, level)
        return f"{self.text(left)}, {self.text(_without(expression.right, level + 1))}"

    def _real(self, expression: m.Binary, type_: m.Type) -> Text:
        """An operator on numbers of which one has a point, and the other becomes one."""
        operator = expression.operator
        one, other = (self._real_operand(e, type_) for e in (expression.left, expression.right))
        if operator in _COMPARED:
            level = COMPARISON
            return Text(f"{one.at(level + 1)} {operator} {other.at(level + 1)}", level)
        if operator == "%":
            result = atom(f"modulus({one.text}, {other.text})")
        elif operator == "/" and not constant(expression.right):
            result = atom(f"quotient({one.text}, {other.text})")
        else:
            level = BINARY[operator]
            result = Text(f"{one.at(level)} {operator} {other.at(level + 1)}", level)
        return atom(f"float32({result.text})") if type_ == FLOAT else result

    def _real_operand(self, expression: m.Expression, type_: m.Type) -> Text:
        if not self.is_whole(expression):
            return self._exact(expression)
        if type_ == FLOAT and self._range(expression).magnitude > _EXACT:
            return atom(f"float32({self.text(expression)})")
        return self._exact(expression)

    def _infix(self, operator: str, left: m.Expression, right: m.Expression, exact: bool) -> Text:
        level = BINARY[operator]
        first = level + 1 if operator in _COMPARED else level
        one = self.operand(left, first, exact)
        return Text(f"{one} {operator} {self.operand(right, level + 1, exact)}", level)


def _without(operand: m.Expression, level: int) -> m.Expression:
    """What is in the parentheses that an operand of an operator of a level must have."""
    if isinstance(operand, m.Paren) and precedence.binding(operand.inner) < level:
        return operand.inner
    return operand
