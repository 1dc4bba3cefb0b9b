"""Expressions of C++ as expressions of the model (mapping, "Behaviour", from right to left)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync import precedence
from rebsync.names import original
from rebsync.records import dataclass
from rebsync.reverse.cpp_literals import literal
from rebsync.reverse.cpp_tree import Cpp, named, part, text_of
from rebsync.reverse.cpp_types import class_name, type_of
from rebsync.reverse.findings import Unread
from rebsync.reverse.scope import (
    Called,
    Lambda,
    Outside,
    Publishes,
    Record,
    Runtime,
    Scope,
    Sends,
    TimerOf,
    Variable,
)

_OPERATIONS = {
    "divide": "/",
    "remainder": "%",
    "shiftLeft": "<<",
    "shiftRight": ">>",
}
_ASSIGNMENTS = {f"{name}By": f"{operator}=" for name, operator in _OPERATIONS.items()}
_CLOCK = {
    "now": "now",
    "arrival": "currentMessageArrival",
    "expiry": "currentMessageDeadline",
    "waitingTime": "currentMessageWaitingTime",
    "sender": "sender",
}
_MATHEMATICS = frozenset({"pow", "sqrt"})
_WIDTHS = frozenset({"narrow", "widen"})
# The function under which a statement of `@Move` is read, until it is one.
MOVE = "@Move"
_PREFIX = frozenset({"+", "-", "!", "~"})


@dataclass(frozen=True, slots=True)
class CppExpressions:
    """Reads the expressions of one body. What has no meaning in the model raises `Unread`."""

    cpp: Cpp
    scope: Scope

    def read(self, node: Node) -> m.Expression:
        """The expression, with parentheses where the code has them or the model needs them."""
        span = self.cpp.span(node)
        if node.id in self.scope.values:
            return self.scope.values[node.id]
        match node.type:
            case "identifier":
                return self._name(node)
            case "this":
                return m.Self(span)
            case "parenthesized_expression":
                return m.Paren(self.read(self._only(node)), span)
            case "field_expression":
                return self._field(node)
            case "subscript_expression":
                return self._index(node, named(part(node, "indices")))
            case "unary_expression":
                return self._unary(node)
            case "update_expression":
                return self._update(node)
            case "binary_expression":
                return self._binary(node, self._operator(node), named(node))
            case "assignment_expression":
                return self._assign(node, self._operator(node), named(node))
            case "conditional_expression":
                condition, then, otherwise = named(node)
                tested = self.operand(condition, precedence.CHAIN)
                return m.Conditional(tested, self.read(then), self.read(otherwise), span)
            case "cast_expression":
                return self._cast(part(node, "type"), part(node, "value"), node)
            case "call_expression":
                return self._call(node)
            case _:
                return literal(self.cpp, node)

    def operand(self, node: Node, binding: int) -> m.Expression:
        """An operand that binds at least so tightly, in parentheses if it does not."""
        expression = self.read(node)
        if precedence.binding(expression) < binding:
            return m.Paren(expression, self.cpp.span(node))
        return expression

    def unread(self, node: Node, why: str, hint: str = "") -> Unread:
        """What to raise where a node has no meaning in the model."""
        return Unread(self.cpp.span(node), why, hint)

    # --- names ----------------------------------------------------------------------------------

    def _name(self, node: Node) -> m.Expression:
        name, span = text_of(node), self.cpp.span(node)
        match self.scope.meaning(name):
            case Variable(of_model):
                return m.Name(of_model, span)
            case Runtime():
                raise self.unread(node, f'"{name}" belongs to the run-time part')
            case None if name in self.scope.constants:
                cpp, value = self.scope.constants[name]
                return CppExpressions(cpp, self.scope.without_constant(name)).read(value)
            case None:
                return literal(self.cpp, node)
            case Outside() | Record() | Publishes() | TimerOf() | Lambda():
                raise self.unread(node, f'the model cannot know "{name}"')
            case expression:
                return expression

    def _field(self, node: Node) -> m.Expression:
        target, name = part(node, "argument"), part(node, "field")
        if target.type == "this":
            match self.scope.members.get(text_of(name)):
                case Variable(of_model):
                    self_ = m.Self(self.cpp.span(target))
                    return m.Member(self_, of_model, self.cpp.span(node), self.cpp.span(name))
        raise self.unread(node, f'"{text_of(node)}" is no variable of the model')

    def _only(self, node: Node) -> Node:
        children = named(node)
        if len(children) != 1:
            raise self.unread(node, "this is not one expression")
        return children[0]

    # --- operators ------------------------------------------------------------------------------

    def _operator(self, node: Node) -> str:
        operator = text_of(part(node, "operator"))
        if operator not in precedence.BINARY and not operator.endswith("="):
            raise self.unread(node, f'the model has no operator "{operator}"')
        return operator

    def _index(self, node: Node, indices: Sequence[Node]) -> m.Expression:
        array = self.operand(part(node, "argument"), precedence.PRIMARY)
        if len(indices) != 1:
            raise self.unread(node, "an array of the model has one index at a time")
        return m.Index(array, self.read(indices[0]), self.cpp.span(node))

    def _unary(self, node: Node) -> m.Expression:
        operator = text_of(part(node, "operator"))
        if operator not in _PREFIX:
            raise self.unread(node, f'the model has no operator "{operator}"')
        operand = self.operand(part(node, "argument"), precedence.PREFIX)
        return m.Unary(operator, operand, self.cpp.span(node))

    def _update(self, node: Node) -> m.Expression:
        operator, span = text_of(part(node, "operator")), self.cpp.span(node)
        argument = part(node, "argument")
        if argument.start_byte == node.start_byte:
            return m.Postfix(operator, self.operand(argument, precedence.POSTFIX), span)
        return m.Unary(operator, self.operand(argument, precedence.PREFIX), span)

    def _binary(self, node: Node, operator: str, operands: Sequence[Node]) -> m.Expression:
        left, right = operands
        level = precedence.BINARY[operator]
        return m.Binary(
            operator,
            self.operand(left, level),
            self.operand(right, level + 1),
            self.cpp.span(node),
        )

    def _assign(self, node: Node, operator: str, operands: Sequence[Node]) -> m.Expression:
        target, value = operands
        written = self.operand(target, precedence.CHAIN)
        return m.Assign(operator, written, self.read(value), self.cpp.span(node))

    def _cast(self, to: Node, operand: Node, node: Node) -> m.Expression:
        type_ = type_of(to)
        if type_ is None or type_.dimensions:
            raise self.unread(node, f'the model has no type "{text_of(to)}"')
        return m.Cast(type_, self.operand(operand, precedence.CAST), self.cpp.span(node))

    # --- calls ----------------------------------------------------------------------------------

    def _call(self, node: Node) -> m.Expression:
        function, arguments = part(node, "function"), named(part(node, "arguments"))
        match function.type:
            case "identifier":
                return self._call_by_name(node, text_of(function), arguments, m.Self)
            case "template_function":
                return self._template(node, function, arguments)
            case "qualified_identifier":
                return self._qualified(node, function, arguments)
            case "field_expression":
                return self._of_object(node, function, arguments)
            case "lambda_expression" if not arguments:
                return self._in_order(function)
            case _:
                raise self.unread(node, "the model cannot call this")

    def _call_by_name(
        self, node: Node, name: str, arguments: Sequence[Node], own: type[m.Self] | None
    ) -> m.Expression:
        """A call of a function of the class; `own` is None where it is written as `this->f()`."""
        match self.scope.functions.get(name):
            case Sends() as sends:
                return self._send(node, sends, arguments, implicit=own is None)
            case Called(_, server=True):
                why = f'"{name}" is a message server: a call runs it at once, a send does not'
                raise self.unread(node, why, "send the message instead")
            case Called(called):
                target = None if own is not None else m.Self(self.cpp.span(node))
                return self._calls(node, target, called, arguments)
        if own is not None and name in _OPERATIONS and len(arguments) == 2:
            return self._binary(node, _OPERATIONS[name], arguments)
        if own is not None and name in _ASSIGNMENTS and len(arguments) == 2:
            return self._assign(node, _ASSIGNMENTS[name], arguments)
        raise self.unread(node, f'"{name}" is no function of this class')

    def _calls(
        self, node: Node, target: m.Expression | None, name: str, arguments: Sequence[Node]
    ) -> m.Call:
        values = tuple(self.read(a) for a in arguments)
        return m.Call(target, name, values, span=self.cpp.span(node))

    def _template(self, node: Node, function: Node, arguments: Sequence[Node]) -> m.Expression:
        name, types = text_of(part(function, "name")), named(part(function, "arguments"))
        if len(types) != 1 or len(arguments) != 1:
            raise self.unread(node, f'the model has no function "{name}"')
        if name in _WIDTHS:  # what the model does unasked
            return self.read(arguments[0])
        if name == "static_cast":
            return self._cast(types[0], arguments[0], node)
        if name == "as":
            operand = self.operand(arguments[0], precedence.CAST)
            return m.Cast(m.Type(class_name(text_of(types[0]))), operand, self.cpp.span(node))
        raise self.unread(node, f'the model has no function "{name}"')

    def _qualified(self, node: Node, function: Node, arguments: Sequence[Node]) -> m.Expression:
        owner, name = text_of(part(function, "scope")), text_of(part(function, "name"))
        if owner == "std" and name in _MATHEMATICS:
            return self._calls(node, None, name, arguments)
        called = self.scope.functions.get(name)
        if owner in self.scope.bases and isinstance(called, Called) and not called.server:
            return self._calls(node, m.Super(self.cpp.span(function)), called.name, arguments)
        raise self.unread(node, f'the model has no function "{owner}::{name}"')

    def _of_object(self, node: Node, function: Node, arguments: Sequence[Node]) -> m.Expression:
        target, name = part(function, "argument"), part(function, "field")
        if target.type == "this":
            return self._call_by_name(node, text_of(name), arguments, None)
        if text_of(name) == "at" and not self._is_runtime(target):
            return self._index(function, arguments)
        if self._is_runtime(target):
            return self._built_in(node, target, name, arguments)
        raise self.unread(node, f'the model cannot call "{text_of(function)}"')

    def _is_runtime(self, node: Node) -> bool:
        name = text_of(node)
        member = self.scope.members.get(name)
        return name not in self.scope.locals and isinstance(member, Runtime)

    def _built_in(
        self, node: Node, target: Node, name: Node, arguments: Sequence[Node]
    ) -> m.Expression:
        member, span = self.scope.members[text_of(target)], self.cpp.span(node)
        function = text_of(part(name, "name") if name.type == "template_method" else name)
        if isinstance(member, Runtime) and member.kind == "drive" and function == "move":
            return self._calls(node, None, MOVE, arguments)
        if not isinstance(member, Runtime) or member.kind != "mailbox":
            raise self.unread(node, f'the model cannot call "{text_of(target)}.{function}"')
        match function, len(arguments):
            case "self", 0:
                return m.Self(span)
            case "choose", 1 | 2:
                return m.Choice(tuple(self.read(o) for o in named(arguments[0])), span)
            case "isA", 2:
                operand = self.operand(arguments[0], precedence.BINARY["instanceof"])
                return m.InstanceOf(operand, m.Type(self._class_named(arguments[1])), span)
            case _, 0 if function in _CLOCK:
                return m.Name(_CLOCK[function], span)
            case "delay" | "assertion", _:
                return self._calls(node, None, function, arguments)
            case _:
                raise self.unread(node, f'the model has no function "{function}"')

    def _class_named(self, node: Node) -> str:
        """The class whose name a literal holds."""
        if node.type != "string_literal":
            raise self.unread(node, "this class is not known before the node runs")
        return original(text_of(node)[1:-1])

    def _in_order(self, function: Node) -> m.Expression:
        """`[&] { const auto op1_ = a; return f(op1_); }()`: operands in the order of the model."""
        reader, values = self, []
        *stores, result = named(part(function, "body"))
        for store in stores:
            declarator = part(store, "declarator") if store.type == "declaration" else store
            if declarator.type != "init_declarator" or result.type != "return_statement":
                raise self.unread(function, "the model has no functions inside expressions")
            values.append(reader.read(part(declarator, "value")))
            name = text_of(part(declarator, "declarator")).lstrip("& ")
            reader = replace(reader, scope=reader.scope.with_locals({name: values[-1]}))
        read = reader.read(reader._only(result))
        match values, read:
            case [target, read_first, value], m.Assign("=", written, m.Cast(_, computed)) if (
                target == read_first == written
            ):
                inner = computed.inner if isinstance(computed, m.Paren) else computed
                if isinstance(inner, m.Binary):
                    return m.Assign(f"{inner.operator}=", target, value, self.cpp.span(function))
        return read

    # --- sends ----------------------------------------------------------------------------------

    def _send(
        self, node: Node, sends: Sends, arguments: Sequence[Node], implicit: bool
    ) -> m.Expression:
        expected = sends.arguments + (sends.known is None)
        if not expected <= len(arguments) <= expected + 1:
            raise self.unread(node, f"this sends with {expected} arguments")
        target: m.Expression | None
        if sends.known is None:
            target = self.operand(arguments[0], precedence.PRIMARY)
        elif sends.known == "self":
            target = None if implicit else m.Self(self.cpp.span(node))
        else:
            target = m.Name(sends.known, self.cpp.span(node))
        values = tuple(self.read(a) for a in arguments[expected - sends.arguments : expected])
        times = self._times(arguments[expected]) if len(arguments) > expected else {}
        after, deadline = times.get("after"), times.get("deadline")
        return m.Call(target, sends.server, values, after, deadline, self.cpp.span(node))

    def _times(self, node: Node) -> dict[str, m.Expression]:
        """`after(a).deadline(d)`."""
        if node.type != "call_expression":
            raise self.unread(node, "this is no time of a send")
        function, arguments = part(node, "function"), named(part(node, "arguments"))
        found: dict[str, m.Expression] = {}
        name = function
        if function.type == "field_expression":
            found = self._times(part(function, "argument"))
            name = part(function, "field")
        if text_of(name) not in ("after", "deadline") or len(arguments) != 1:
            raise self.unread(node, "this is no time of a send")
        return found | {text_of(name): self.read(arguments[0])}
