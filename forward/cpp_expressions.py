"""Expressions of the model in C++ (rows "Behaviour" of the mapping)."""

from __future__ import annotations

from dataclasses import dataclass

from rebsync import model as m
from rebsync.forward.cpp_names import CppNames, function_name, local_name
from rebsync.forward.cpp_types import cpp_type
from rebsync.forward.effects import conflicting, writes_to
from rebsync.forward.sends import ToAny, ToKnown, ToSelf, send_of
from rebsync.forward.topics import Topics
from rebsync.static import Analysis
from rebsync.static.constants import constant
from rebsync.static.symbols import (
    BuiltinSymbol,
    EnvSymbol,
    KnownRebecSymbol,
    MethodSymbol,
    StateSymbol,
)
from rebsync.static.types import is_floating, is_integer
from rebsync.unions import assert_never

_CLOCK = {
    "now": "mailbox_.now()",
    "currentMessageArrival": "mailbox_.arrival()",
    "currentMessageDeadline": "mailbox_.expiry()",
    "currentMessageWaitingTime": "mailbox_.waitingTime()",
    "sender": "mailbox_.sender()",
}
_NARROW = frozenset({"byte", "short"})


@dataclass(frozen=True, slots=True)
class CppExpressions:
    """Prints the expressions of one class; `seen` names the user's function of a sensor's draw."""

    analysis: Analysis
    topics: Topics
    names: CppNames
    class_types: dict[str, str]
    seen: dict[int, str]

    def text(self, expression: m.Expression) -> str:
        """The expression in C++, its parentheses as in the model."""
        match expression:
            case m.IntLiteral():
                return str(expression.value)
            case m.FloatLiteral():
                return _float(expression.text)
            case m.BoolLiteral():
                return "true" if expression.value else "false"
            case m.StringLiteral():
                return expression.text
            case m.NullLiteral():
                return "kNull"
            case m.Name():
                return self._name(expression)
            case m.Self():
                return "mailbox_.self()"
            case m.Super():
                return "*this"
            case m.Member(target=m.Self(), name=name):
                return f"this->{self.names.members[name]}"
            case m.Member(target=target, name=name):
                return f"{self.text(target)}.{name}"
            case m.Index():
                return self._index(expression)
            case m.Call():
                return self._call(expression)
            case m.Paren(inner):
                return f"({self.text(inner)})"
            case m.Cast(type_, operand):
                return self._cast(type_, operand)
            case m.Unary(operator, operand):
                text = self.text(operand)
                gap = " " if text[:1] == operator[-1] else ""
                return f"{operator}{gap}{text}"
            case m.Postfix(operator, operand):
                return f"{self.text(operand)}{operator}"
            case m.Binary():
                return self._binary(expression)
            case m.InstanceOf(operand, type_):
                return f'mailbox_.isA({self.text(operand)}, "{type_.name}")'
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

    def stored(self, expression: m.Expression, type_: m.Type) -> str:
        """The expression as it is stored in a variable of a type: narrowed where C++ widens it."""
        text = self.text(expression)
        if type_.name in _NARROW and not type_.dimensions and self._widens(expression):
            return f"narrow<{cpp_type(type_)}>({text})"
        return text

    def type_of(self, expression: m.Expression) -> m.Type | None:
        """The static type of an expression."""
        return self.analysis.types.get(id(expression))

    # --- parts ----------------------------------------------------------------------------------

    def _widens(self, expression: m.Expression) -> bool:
        """Whether C++ computes the expression as an int although the model's type is smaller."""
        if constant(expression) is not None:
            return False
        match expression:
            case m.Paren(inner):
                return self._widens(inner)
            case m.Binary() | m.Unary(operator="-" | "+" | "~"):
                return True
            case m.Conditional(then=then, otherwise=otherwise):
                return self._widens(then) or self._widens(otherwise)
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
                return local_name(name.name)

    def _index(self, expression: m.Index) -> str:
        array = self.text(expression.target)
        type_ = self.type_of(expression.target)
        value = constant(expression.index)
        length = type_.dimensions[0] if type_ is not None and type_.dimensions else 0
        if isinstance(value, int) and 0 <= value < length:
            return f"{array}[{self.text(expression.index)}]"
        return f"{array}.at({self.text(expression.index)})"

    def _cast(self, type_: m.Type, operand: m.Expression) -> str:
        inner = operand.inner if isinstance(operand, m.Paren) else operand
        if type_.name in self.class_types:
            return f"as<{self.class_types[type_.name]}>({self.text(inner)})"
        return f"static_cast<{cpp_type(type_)}>({self.text(operand)})"

    def _binary(self, expression: m.Binary) -> str:
        operator, left, right = expression.operator, expression.left, expression.right
        if operator not in ("&&", "||") and conflicting((left, right), self.analysis):
            operands = [self.text(left), self.text(right)]
            return self._in_order(operands, self._operation(expression, "op1_", "op2_"))
        return self._operation(expression, self.text(left), self.text(right))

    def _operation(self, expression: m.Binary, left: str, right: str) -> str:
        operator = expression.operator
        if operator in ("/", "%") and self._needs_check(expression):
            return f"{'divide' if operator == '/' else 'remainder'}({left}, {right})"
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
        types = {t.name for o in expression.options if (t := self.type_of(o)) is not None}
        floating = types & {"float", "double"}
        template = ""
        if floating and len(types) > 1:
            template = "<double>" if "double" in floating else "<float>"
        options = ", ".join(self.text(o) for o in expression.options)
        seen = self.seen.get(id(expression))
        return f"mailbox_.choose{template}({{{options}}}{f', {seen}' if seen else ''})"

    def _assign(self, expression: m.Assign) -> str:
        target, value = expression.target, expression.value
        type_ = self.type_of(target) or m.Type("int")
        operator = expression.operator
        if writes_to(target, value, self.analysis):
            return self._assign_in_order(expression, type_)
        if operator == "=":
            return f"{self.text(target)} = {self.stored(value, type_)}"
        checked = not is_floating(type_) and constant(value) in (None, 0, -1)
        if operator in ("/=", "%=") and checked:
            function = "divideBy" if operator == "/=" else "remainderBy"
            return f"{function}({self.text(target)}, {self.text(value)})"
        return f"{self.text(target)} {operator} {self.text(value)}"

    def _assign_in_order(self, expression: m.Assign, type_: m.Type) -> str:
        """Target first, then value, then the store; a compound operator reads the target first."""
        target, value = self.text(expression.target), self.stored(expression.value, type_)
        if expression.operator == "=":
            return (
                f"[&] {{ auto& op1_ = {target}; const auto op2_ = {value}; return op1_ = op2_; }}()"
            )
        operator = expression.operator[:-1]
        result = f"op2_ {operator} op3_"
        if operator in ("/", "%"):
            result = f"{'divide' if operator == '/' else 'remainder'}(op2_, op3_)"
        stores = f"auto& op1_ = {target}; const auto op2_ = op1_; const auto op3_ = {value};"
        return f"[&] {{ {stores} return op1_ = static_cast<{cpp_type(type_)}>({result}); }}()"

    # --- calls ----------------------------------------------------------------------------------

    def _call(self, call: m.Call) -> str:
        send = send_of(call, self.analysis)
        if send is not None:
            declaration = send.server.declaration
            arguments = self._arguments(call, tuple(p.type for p in declaration.parameters))
            when = self._when(call)
            everything = [*arguments, *([when] if when else [])]
            operands = [a for a in (*call.arguments, call.after, call.deadline) if a is not None]
            in_order = conflicting(operands, self.analysis)
            if in_order:
                everything = [f"op{i}_" for i in range(1, len(everything) + 1)]
            key = self.topics.called(send.server).key
            match send.target:
                case ToSelf():
                    own = self.names.self_sends[key]
                    helper = own if call.target is not None else f"this->{own}"
                case ToKnown(known):
                    helper = self.names.send_to_known(known, key)
                case ToAny(class_name):
                    helper = self.names.send_to_any(class_name, key)
                    everything.insert(0, self.text(_bare(call.target)))
            text = f"{helper}({', '.join(everything)})"
            values = [*arguments, *([when] if when else [])]
            return self._in_order(values, text) if in_order else text
        return self._function_call(call)

    def _when(self, call: m.Call) -> str:
        parts = []
        if call.after is not None:
            parts.append(f"after({self.text(call.after)})")
        if call.deadline is not None:
            parts.append(f"deadline({self.text(call.deadline)})")
        return ".".join(parts)

    def _function_call(self, call: m.Call) -> str:
        symbol = self.analysis.symbols.get(id(call))
        if isinstance(symbol, MethodSymbol):
            types = tuple(p.type for p in symbol.declaration.parameters)
            values = self._arguments(call, types)
            in_order = conflicting(call.arguments, self.analysis)
            passed = [f"op{i}_" for i in range(1, len(values) + 1)] if in_order else values
            match call.target:
                case m.Super():
                    prefix = f"{self.class_types[symbol.owner]}::"
                case m.Self():
                    prefix = "this->"
                case _:
                    prefix = ""
            text = f"{prefix}{function_name(call.name)}({', '.join(passed)})"
            return self._in_order(values, text) if in_order else text
        arguments = ", ".join(self.text(a) for a in call.arguments)
        match call.name:
            case "delay":
                return f"mailbox_.delay({arguments})"
            case "assertion":
                return f"mailbox_.assertion({arguments})"
            case _:
                return f"std::{call.name}({arguments})"

    def _arguments(self, call: m.Call, types: tuple[m.Type, ...]) -> list[str]:
        return [self.stored(a, t) for a, t in zip(call.arguments, types, strict=True)]

    def _in_order(self, values: list[str], result: str) -> str:
        """`result` over `op1_`, `op2_`, ...: the values in the order of the model.

        C++14 leaves the order of operands and arguments open; the statements of a lambda have one.
        """
        stores = "".join(f"const auto op{i}_ = {v}; " for i, v in enumerate(values, 1))
        return f"[&] {{ {stores}return {result}; }}()"


def _float(literal: str) -> str:
    """A literal of the model, float unless it says double, in C++, where it is the other way."""
    digits = literal.replace("_", "")
    if digits[-1] in "dD":
        return digits[:-1] if any(c in digits for c in ".eE") else f"{digits[:-1]}.0"
    if digits[-1] in "fF":
        digits = digits[:-1]
        return f"{digits}F" if any(c in digits for c in ".eE") else f"{digits}.0F"
    return f"{digits}f"


def _bare(target: m.Expression | None) -> m.Expression:
    """The target of a send without the parentheses that its cast needs in the model."""
    if isinstance(target, m.Paren):
        return _bare(target.inner)
    assert target is not None
    return target
