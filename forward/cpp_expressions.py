"""Expressions of the model in C++ (rows "Behaviour" of the mapping)."""

from __future__ import annotations

import re
from collections.abc import Sequence

from rebsync import model as m
from rebsync import precedence
from rebsync.forward.cpp_names import CppNames
from rebsync.forward.cpp_operands import (
    bare,
    enclosed,
    float_literal,
    in_order,
    is_bitwise,
    is_distance,
    is_int,
    looks_like_template,
    nth,
    when,
)
from rebsync.forward.cpp_types import LOWEST, cpp_type, stored_type
from rebsync.forward.sends import Send, ToAny, ToKnown, ToSelf, send_of
from rebsync.forward.topics import Topics
from rebsync.names import graph_name, unique
from rebsync.records import dataclass
from rebsync.static import Analysis
from rebsync.static.constants import constant
from rebsync.static.effects import assigns_apart, conflicting, indices_of
from rebsync.static.symbols import (
    BuiltinSymbol,
    EnvSymbol,
    KnownRebecSymbol,
    MethodSymbol,
    StateSymbol,
)
from rebsync.static.types import DOUBLE, NULL, is_floating, is_integer
from rebsync.unions import assert_never

_CLOCK = {
    "now": "mailbox_.now()",
    "currentMessageArrival": "mailbox_.arrival()",
    "currentMessageDeadline": "mailbox_.expiry()",
    "currentMessageWaitingTime": "mailbox_.waitingTime()",
    "sender": "mailbox_.sender()",
}
_WORD = re.compile(r"[A-Za-z_]\w*")
_NARROW = {"byte": 2**7, "short": 2**15}
_EXACT = 2**24  # integers below are floats as well
_SHIFTS = {"<<": "shiftLeft", ">>": "shiftRight"}
_OPERATIONS = {"/": "divide", "%": "remainder", **_SHIFTS}


@dataclass(frozen=True, slots=True)
class CppExpressions:
    """Prints the expressions of one class; `seen` names the user's function of a sensor's draw.

    `taken` are names of the body around them that no further local may have.
    """

    analysis: Analysis
    topics: Topics
    names: CppNames
    class_types: dict[str, str]
    seen: dict[int, str]
    taken: frozenset[str] = frozenset()

    def text(self, expression: m.Expression) -> str:
        """The expression in C++, its parentheses as in the model."""
        match expression:
            case m.IntLiteral() | m.FloatLiteral() | m.BoolLiteral():
                return _literal(expression)
            case m.StringLiteral() | m.NullLiteral():
                return _literal(expression)
            case m.Name():
                return self._name(expression)
            case m.Self():
                return "mailbox_.self()"
            case m.Super():
                return "*this"
            case m.Member():
                return self._member(expression)
            case m.Index():
                return self._index(expression)
            case m.Call():
                return self._call(expression)
            case m.Paren(inner):
                return f"({self.text(inner)})"
            case m.Cast(type_, operand):
                return self._cast(type_, operand)
            case m.Unary("-", m.IntLiteral(0x80000000)):
                return LOWEST
            case m.Unary(operator, operand):
                text = self.text(operand)
                gap = " " if text[:1] == operator[-1] else ""
                return f"{operator}{gap}{text}"
            case m.Postfix(operator, operand):
                return f"{self.text(operand)}{operator}"
            case m.Binary():
                return self._binary(expression)
            case m.InstanceOf(operand, type_):
                text = self.text(enclosed(operand, precedence.BINARY["instanceof"]))
                return f'mailbox_.isA({text}, "{graph_name(type_.name)}")'
            case m.Conditional(condition, then, otherwise):
                return f"{self.text(condition)} ? {self.text(then)} : {self.text(otherwise)}"
            case m.Choice():
                return self._choice(expression)
            case m.Assign():
                return self._assign(expression)
            case m.New() | m.Broken():
                raise ValueError("an expression that the analysis reports as an error")
            case _:
                assert_never(expression)

    def _member(self, member: m.Member) -> str:
        if isinstance(member.target, m.Self):
            return f"this->{self.names.members[member.name]}"
        return f"{self.text(member.target)}.{member.name}"

    def stored(self, expression: m.Expression, type_: m.Type) -> str:
        """The expression as it is stored in a variable of a type: narrowed where C++ widens it."""
        text = self.text(expression)
        if type_.name in _NARROW and not type_.dimensions and self._widens(expression, type_):
            return f"narrow<{cpp_type(type_)}>({text})"
        return text

    def exact(self, expression: m.Expression, type_: m.Type) -> str:
        """The expression as of just this type in C++ too, so that it chooses among overloads."""
        given = self.type_of(expression)
        if given is None or given.dimensions:
            return self.text(expression)
        widened = is_integer(given) and is_int(expression)
        there = "int32_t" if widened else "" if given == NULL else stored_type(given)
        wanted = stored_type(type_)
        if there == wanted:
            return self.text(expression)
        helper = "narrow" if type_.name in _NARROW else "widen"
        return f"{helper}<{wanted}>({self.text(expression)})"

    def braced(self, expression: m.Expression, type_: m.Type) -> str:
        """The expression as stored by a list in braces, where C++ refuses what may lose digits."""
        text, given = self.stored(expression, type_), self.type_of(expression)
        if type_.name == "boolean" and is_bitwise(expression):
            return f"widen<bool>({text})"
        if given is None or not is_floating(type_) or not is_integer(given):
            return text
        value = constant(expression)
        if value is not None and abs(value) < _EXACT:
            return text
        return f"widen<{cpp_type(type_)}>({text})"

    def type_of(self, expression: m.Expression) -> m.Type | None:
        """The static type of an expression."""
        return self.analysis.types.get(id(expression))

    # --- parts ----------------------------------------------------------------------------------

    def _widens(self, expression: m.Expression, type_: m.Type) -> bool:
        """Whether C++ computes the expression as an int that the smaller type may not hold."""
        value = constant(expression)
        if value is not None:
            return not -_NARROW[type_.name] <= value < _NARROW[type_.name]
        match expression:
            case m.Paren(inner):
                return self._widens(inner, type_)
            case m.Binary() | m.Unary(operator="-" | "+" | "~"):
                return True
            case m.Conditional(then=then, otherwise=otherwise):
                return self._widens(then, type_) or self._widens(otherwise, type_)
            case _:
                return False

    def _name(self, name: m.Name) -> str:
        match self.analysis.symbols.get(id(name)):
            case StateSymbol() | KnownRebecSymbol():
                return self.names.members[name.name]
            case EnvSymbol():
                return self.names.env[name.name]
            case BuiltinSymbol():
                return _CLOCK[name.name]
            case _:
                return self.names.local(name.name)

    def _index(self, expression: m.Index) -> str:
        indices = indices_of(expression)
        if not conflicting(indices, self.analysis):
            return self._element(expression, [self.text(i) for i in indices])
        values = [self.text(i) for i in indices]
        names = self._locals(nth(len(values)), values)
        place = self._element(expression, names)
        return in_order(names, values, place).replace("[&] {", "[&]() -> auto& {", 1)

    def _element(self, expression: m.Expression, indices: Sequence[str]) -> str:
        """An element of an array, or of an array in one, by the text of its indices."""
        if not isinstance(expression, m.Index):
            return self.text(expression)
        array = self._element(expression.target, indices[:-1])
        type_ = self.type_of(expression.target)
        value = constant(expression.index)
        length = type_.dimensions[0] if type_ is not None and type_.dimensions else 0
        is_there = isinstance(value, int) and 0 <= value < length
        return f"{array}[{indices[-1]}]" if is_there else f"{array}.at({indices[-1]})"

    def _cast(self, type_: m.Type, operand: m.Expression) -> str:
        text = self.text(enclosed(operand, precedence.CAST))
        if type_.name in self.class_types:
            return f"as<{self.class_types[type_.name]}>({text})"
        return f"static_cast<{cpp_type(type_)}>({text})"

    def _binary(self, expression: m.Binary) -> str:
        operator, left, right = expression.operator, expression.left, expression.right
        if operator not in ("&&", "||") and conflicting((left, right), self.analysis):
            operands = [self.text(left), self.text(right)]
            names = self._locals(("left", "right"), operands)
            return in_order(names, operands, self._operation(expression, *names))
        if self._is_call(expression):
            level = precedence.BINARY[operator]
            sides = (enclosed(left, level), enclosed(right, level + 1))
            texts = [self.text(side) for side in sides]
            if not looks_like_template(sides, texts):
                return self._operation(expression, *texts)
        return self._operation(expression, self.text(left), self.text(right))

    def _is_call(self, expression: m.Binary) -> bool:
        """Whether an operation is a function of the run-time part."""
        if expression.operator in _SHIFTS:
            return not is_distance(expression.right)
        return expression.operator in ("/", "%") and self._needs_check(expression)

    def _operation(self, expression: m.Binary, left: str, right: str) -> str:
        operator = expression.operator
        if self._is_call(expression):
            return f"{_OPERATIONS[operator]}({left}, {right})"
        return f"{left} {operator} {right}"

    def _needs_check(self, expression: m.Binary) -> bool:
        """Whether an integer division may meet a divisor of 0 or -1; `%` of floats needs help."""
        types = (self.type_of(expression.left), self.type_of(expression.right))
        if any(t is not None and is_floating(t) for t in types):
            return expression.operator == "%"
        return constant(expression.right) in (None, 0, -1) or not all(
            t is not None and is_integer(t) for t in types
        )

    def _choice(self, expression: m.Choice) -> str:
        type_ = self.type_of(expression) or m.Type("int")
        types = {t.name for o in expression.options if (t := self.type_of(o)) is not None}
        casts = any(isinstance(n, m.Cast) for n in m.walk(expression))
        template = ""
        if casts or (is_floating(type_) and len(types) > 1):
            template = f"<{'int32_t' if is_integer(type_) else cpp_type(type_)}>"
        options = ", ".join(self.text(o) for o in expression.options)
        seen = self.seen.get(id(expression))
        return f"mailbox_.choose{template}({{{options}}}{f', {seen}' if seen else ''})"

    def _assign(self, expression: m.Assign) -> str:
        target, value = expression.target, expression.value
        type_ = self.type_of(target) or m.Type("int")
        operator = expression.operator
        if assigns_apart(expression, self.analysis):
            return self._assign_in_order(expression, type_)
        if operator == "=":
            return f"{self.text(target)} = {self.stored(value, type_)}"
        checked = not is_floating(type_) and constant(value) in (None, 0, -1)
        if operator in ("/=", "%=") and checked:
            function = "divideBy" if operator == "/=" else "remainderBy"
            return f"{function}({self.text(target)}, {self.text(value)})"
        if operator[:-1] in _SHIFTS and not is_distance(value):
            return f"{_SHIFTS[operator[:-1]]}By({self.text(target)}, {self.text(value)})"
        return f"{self.text(target)} {operator} {self.text(value)}"

    def _assign_in_order(self, expression: m.Assign, type_: m.Type) -> str:
        """Target first, then value, then the store; a compound operator reads the target first."""
        target, value = self.text(expression.target), self.stored(expression.value, type_)
        if expression.operator == "=":
            place, new = self._locals(("place", "value"), (target, value))
            stores = f"auto& {place} = {target}; const auto {new} = {value};"
            return f"[&] {{ {stores} return {place} = {new}; }}()"
        place, old, new = self._locals(("place", "left", "right"), (target, value))
        operator = expression.operator[:-1]
        result = f"{old} {operator} {new}"
        if operator in _OPERATIONS:
            result = f"{_OPERATIONS[operator]}({old}, {new})"
        stores = (
            f"auto& {place} = {target}; const auto {old} = {place}; const auto {new} = {value};"
        )
        return f"[&] {{ {stores} return {place} = static_cast<{cpp_type(type_)}>({result}); }}()"

    # --- calls ----------------------------------------------------------------------------------

    def _call(self, call: m.Call) -> str:
        send = send_of(call, self.analysis)
        if send is None:
            return self._function_call(call)
        parameters = send.server.declaration.parameters
        operands = list(call.arguments)
        values = self._arguments(call, tuple(p.type for p in parameters))
        if isinstance(send.target, ToAny):
            operands.insert(0, bare(call.target))
            values.insert(0, self.text(operands[0]))
        times = [t for t in (call.after, call.deadline) if t is not None]
        timed = [self.text(t) for t in times]
        helper = self._helper(call, send)
        apart = conflicting([*operands, *times], self.analysis)
        if not apart and not looks_like_template(operands, values):
            return f"{helper}({', '.join([*values, *when(call, timed)])})"
        stored = [*values, *timed]
        names = self._locals(nth(len(stored)), stored)
        passed = [*names[: len(operands)], *when(call, names[len(operands) :])]
        return in_order(names, stored, f"{helper}({', '.join(passed)})")

    def _helper(self, call: m.Call, send: Send) -> str:
        key = self.topics.called(send.server).key
        match send.target:
            case ToSelf():
                own = self.names.self_sends[key]
                return own if call.target is not None else f"this->{own}"
            case ToKnown(known):
                return self.names.send_to_known(known, key)
            case ToAny(class_name):
                return self.names.send_to_any(class_name, key)
            case _:
                assert_never(send.target)

    def _function_call(self, call: m.Call) -> str:
        symbol = self.analysis.symbols.get(id(call))
        if isinstance(symbol, MethodSymbol):
            types = tuple(p.type for p in symbol.declaration.parameters)
            values = self._arguments(call, types)
            if self._is_overloaded(symbol):
                pairs = zip(call.arguments, types, strict=True)
                values = [self.exact(a, t) for a, t in pairs]
            match call.target:
                case m.Super():
                    prefix = f"{self.class_types[symbol.owner]}::"
                case m.Self():
                    prefix = "this->"
                case _:
                    prefix = ""
            function = self.names.function(call.name, symbol.declaration.parameters)
            return self.call_in_order(f"{prefix}{function}", values, call.arguments)
        return self._built_in(call)

    def _is_overloaded(self, method: MethodSymbol) -> bool:
        """Whether C++ may choose another method than the model does."""
        return any(
            other.name == method.name and other.signature != method.signature
            for info in self.analysis.classes.values()
            for other in info.methods
        )

    def _built_in(self, call: m.Call) -> str:
        real = call.name in ("pow", "sqrt")
        values = [self.exact(a, DOUBLE) if real else self.text(a) for a in call.arguments]
        return self.call_in_order(
            f"{'std::' if real else 'mailbox_.'}{call.name}", values, call.arguments
        )

    def call_in_order(
        self, function: str, values: Sequence[str], arguments: Sequence[m.Expression]
    ) -> str:
        """A call whose arguments are evaluated from left to right where that matters."""
        apart = conflicting(arguments, self.analysis)
        if not apart and not looks_like_template(arguments, values):
            return f"{function}({', '.join(values)})"
        names = self._locals(nth(len(values)), values)
        return in_order(names, values, f"{function}({', '.join(names)})")

    def _arguments(self, call: m.Call, types: tuple[m.Type, ...]) -> list[str]:
        return [self.stored(a, t) for a, t in zip(call.arguments, types, strict=True)]

    def _locals(self, wanted: Sequence[str], values: Sequence[str]) -> list[str]:
        """Names for locals that hold operands: those that are wanted, numbered where taken."""
        used = {*self.taken, *(word for v in values for word in _WORD.findall(v))}
        return [unique(name, used, "") for name in wanted]


def _literal(
    literal: m.IntLiteral | m.FloatLiteral | m.BoolLiteral | m.StringLiteral | m.NullLiteral,
) -> str:
    match literal:
        case m.IntLiteral():
            return str(literal.value)
        case m.FloatLiteral():
            return float_literal(literal.text)
        case m.BoolLiteral():
            return "true" if literal.value else "false"
        case m.StringLiteral():
            return literal.text.replace("??", "?\\?")  # no trigraphs
        case m.NullLiteral():
            return "kNull"
        case _:
            assert_never(literal)
