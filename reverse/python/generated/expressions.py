"""Expressions of generated Python, as the model has them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.names import original
from rebsync.records import dataclass
from rebsync.reverse.models.building import binary, chosen, located
from rebsync.reverse.python.expressions import functions
from rebsync.reverse.python.expressions.conditions import comparison, connected, signs_of
from rebsync.reverse.python.expressions.tables import looked_up, pairs_of
from rebsync.reverse.python.expressions.values import WHOLE, Value
from rebsync.reverse.python.generated import arrays, closures, formats, idioms, places, tuples
from rebsync.reverse.python.generated.arguments import in_order
from rebsync.reverse.python.generated.callees import callee, known_there
from rebsync.reverse.python.generated.decorators import is_cast
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.failing import may_fail
from rebsync.reverse.python.generated.helpers import arguments_for
from rebsync.reverse.python.generated.kinds import float_literal
from rebsync.reverse.python.generated.names import Callee, ChosenCallee
from rebsync.reverse.python.generated.py_types import (
    call_parts,
    in_double_quotes,
    is_new_type,
    only_breaks_lines,
    string_value,
)
from rebsync.reverse.python.generated.sends import of_mailbox, sent
from rebsync.reverse.syntax.py_tree import field, named, number_of, text_of, whole_number_of
from rebsync.static.types import PRIMITIVES
from rebsync.terminal import with_escapes

_LIBRARIES = ("math", "random")
_CASTS = {f"to_{name}": type_ for name, type_ in PRIMITIVES.items()}
_LEVELS = {"|": 6, "^": 7, "&": 8, "<<": 9, ">>": 9, "+": 10, "-": 10}
_LEVELS |= dict.fromkeys(("*", "/", "%", "//"), 11)
_NOT, _COMPARISON, _PRODUCT, _UNARY = 4, 5, 11, 12


@dataclass(eq=False, slots=True)
class Expressions(ModelExpressionReader):
    """Reads the expressions of one body."""

    def expression(self, node: Node) -> m.Expression:
        """An expression. Unread: the model has none for it."""
        span = self.py.span(node)
        match node.type:
            case "integer" if (whole := whole_number_of(node)) is not None:
                return m.IntLiteral(whole, span)
            case "float" if number_of(node) is not None:
                return float_literal(text_of(node), span)
            case "true" | "false":
                return m.BoolLiteral(node.type == "true", span)
            case "string" if not _is_argument(node):
                raise self.unread(node, "no variable of the model holds a text")
            case "string":
                return m.StringLiteral(with_escapes(in_double_quotes(text_of(node))), span)
            case "identifier":
                return self._name(node)
            case "attribute":
                return self._attribute(node)
            case "subscript":
                return self._element(node)
            case "parenthesized_expression" if only_breaks_lines(node):
                return self.expression(named(node)[0])
            case "parenthesized_expression":
                return self._in_parentheses(node)
            case "call":
                return self._call(node)
            case _:
                return self._operation(node)

    def condition(self, node: Node) -> m.Expression:
        """What must hold."""
        known = known_there(self, node)
        return known[1] if known is not None else self.truth(self.read(node), node)

    def _operation(self, node: Node) -> m.Expression:
        span = self.py.span(node)
        match node.type:
            case "not_operator":
                asked = self._operand(field(node, "argument"), _NOT)
                kind = self.kind(asked)
                if kind is not None and kind.name == "int":
                    return binary("==", asked, m.IntLiteral(0), span)
                return m.Unary("!", asked, span)
            case "unary_operator":
                operator = text_of(field(node, "operator"))
                return m.Unary(operator, self._operand(field(node, "argument"), _UNARY), span)
            case "boolean_operator":
                return connected(self, node).expression
            case "binary_operator":
                operator = text_of(field(node, "operator"))
                level = _LEVELS.get(operator)
                if level is None:
                    raise self.unread(node, f'the model has no operator "{operator}"')
                left = self._operand(field(node, "left"), level)
                right = self._operand(field(node, "right"), level + 1)
                if operator in "+-*":
                    left, right = idioms.as_number(self, left), idioms.as_number(self, right)
                read = m.Binary(operator, left, right, span)
                is_divided = level == _PRODUCT and operator != "*"
                return idioms.divided(self, node, read) if is_divided else read
            case "comparison_operator":
                return self._comparison(node)
            case "conditional_expression":
                then, condition, otherwise = named(node)
                parts = self.condition(condition), self.expression(then), self.expression(otherwise)
                return m.Conditional(*parts, span)
            case "named_expression":
                target = self._name(field(node, "name"))
                return self.stored(target, field(node, "name"), field(node, "value"), node)
            case _:
                raise self.unread(node, "the model has no such expression")

    def _comparison(self, node: Node) -> m.Expression:
        operands, signs = named(node), signs_of(node)
        if operands[-1].type in ("true", "false"):  # which there is one of each
            signs = [_SAME.get(sign, sign) for sign in signs]
        if (among := tuples.is_among(self, node, signs)) is not None:
            return among
        if len(operands) != 2 or signs[0] not in ("<", "<=", ">", ">=", "==", "!="):
            found = comparison(self, node)
            is_one = isinstance(found, m.Binary) and found.operator not in ("&&", "||")
            return found if is_one else idioms.grouped(node, found)
        if (compared := tuples.compared(self, node, signs[0], operands)) is not None:
            return compared
        left, right = (self._operand(o, _COMPARISON + 1) for o in operands)
        left, right = idioms.alike(self, node, signs[0], (left, right))
        return m.Binary(signs[0], left, right, self.py.span(node))

    def _operand(self, node: Node, least: int) -> m.Expression:
        """An operand; parentheses that only Python needs around it are none of the model's."""
        if node.type == "parenthesized_expression":
            core = node
            while core.type == "parenthesized_expression" and named(core):
                core = named(core)[0]
            level = {"not_operator": _NOT, "comparison_operator": _COMPARISON}.get(core.type)
            if level is not None and level < least:
                return self.expression(named(node)[0])
            return self._in_parentheses(node)
        return self.expression(node)

    def _in_parentheses(self, node: Node) -> m.Expression:
        inner = named(node)[0]
        if inner.type == "named_expression":
            return self.expression(inner)
        return m.Paren(self.expression(inner), self.py.span(node))

    # --- what the rules of Python ask -----------------------------------------------------------

    def truth(self, value: Value, node: Node) -> m.Expression:
        """What an integer says as a condition."""
        if value.kind != WHOLE:
            return value.expression
        return binary("!=", value.expression, m.IntLiteral(0))

    def compared(
        self, sign: str, left: Value, right: Value, node: Node, number: int
    ) -> m.Expression:
        sides = idioms.alike(self, node, sign, (left.expression, right.expression))
        return binary("!=" if sign == "<>" else sign, *sides, self.span(node))

    def operation(self, operator: str, left: Value, right: Value, node: Node) -> Value:
        return self.value(binary(operator, left.expression, right.expression))

    def joined(self, asked: m.Expression, one: Value, other: Value, node: Node) -> Value:
        return self.value(chosen(asked, one.expression, other.expression))

    def container(self, node: Node, ordered: bool) -> list[Value] | None:
        found = tuples.parts(self, node)
        if found is None and not ordered:
            found = tuples.members(self, node)
        return None if found is None else [*map(self.value, found)]

    def table(self, node: Node) -> Sequence[tuple[Value, Value]] | None:
        written = tuples.table(self, node)
        return pairs_of(self, written) if written is not None else None

    def dotted(self, node: Node) -> Value:
        if (constant := self.names.constants.get(text_of(node))) is None:
            raise self.unread(node, "the model has no such case")
        return self.value(located(constant, self.span(node)))

    def library(self, function: Node) -> str:
        holder, _, name = text_of(function).rpartition(".")
        if not holder:
            is_own = self.names.constants.binds(name) or self.hides_name(name)
            return "" if is_own else f"builtins.{name}"
        return text_of(function) if holder in _LIBRARIES and self._is_of_library(holder) else ""

    def _is_of_library(self, name: str) -> bool:
        """Whether a module of the standard library has its own name here."""
        return self.names.imported.get(name) == name and name not in self.locals

    def may_fail(self, node: Node) -> bool:
        return may_fail(self, node)

    # --- names ----------------------------------------------------------------------------------

    def _name(self, node: Node) -> m.Expression:
        text, span = text_of(node), self.py.span(node)
        if text == "NULL":
            return m.NullLiteral(span)
        if text in self.bound:
            return self.bound[text]
        if text in self.kept:
            return self.expression(self.kept[text])
        if text not in self.locals:
            if (constant := self.names.constants.get(text)) is None:
                raise self.unread(node, f'the model has no variable "{text}"')
            return located(constant, span)
        return m.Name(self.locals[text], span)

    def _attribute(self, node: Node) -> m.Expression:
        span, name = self.py.span(node), text_of(field(node, "attribute"))
        variable = self.names.variables.get(name)
        if (stands := self.bound.get(text_of(node))) is not None:
            return stands
        if (constant := self.names.constants.get(text_of(node))) is not None:
            return located(constant, span)
        is_own = text_of(field(node, "object")) == self.own
        if is_own and name in self.names.properties:
            return m.Call(None, self.names.functions[name], span=span)
        if not is_own or variable is None:
            raise self.unread(node, f'the model has no variable "{text_of(node)}"')
        if variable in self.locals.values():
            return m.Member(m.Self(span), variable, span)
        return m.Name(variable, span)

    def _element(self, node: Node) -> m.Expression:
        if (constant := self.names.constants.get(text_of(node))) is not None:
            return located(constant, self.py.span(node))
        at = text_of(field(node, "subscript"))
        if (stands := self.bound.get(f"{text_of(field(node, 'value'))}.{at}")) is not None:
            return stands
        if tuples.table(self, field(node, "value")) is not None:
            return idioms.grouped(node, tuples.looked_up_one(self, node))
        target = self.expression(field(node, "value"))
        return m.Index(target, self.index(field(node, "subscript")), self.py.span(node))

    def index(self, node: Node) -> m.Expression:
        """An index: as it is, kept in a name, or checked by `at` of an array that is."""
        if node.type == "identifier" and text_of(node) in self.kept:
            return self.index(self.kept[text_of(node)])
        called, arguments = call_parts(node) or ("", [])
        if called.endswith(".at") and called.removesuffix(".at") in self.kept:
            return self.expression(arguments[0])
        return self.expression(node)

    # --- assignments ----------------------------------------------------------------------------

    def stored(
        self, target: m.Expression, place: Node, value: Node, whole: Node, statement: bool = False
    ) -> m.Expression:
        """An assignment: `x = int32.add(x, 1)` is what the model writes `x++`, or `++x`."""
        span = self.py.span(whole)
        called, arguments = call_parts(value) or ("", [])
        called = self.of_run_time(called)
        updated: m.Expression | None = formats.updated(self, target, called, arguments)
        if updated is not None:
            if statement and isinstance(updated, m.Unary):
                updated = m.Postfix(updated.operator, target)
            changed = replace(updated, span=span)
            return self.cuts.converted(called.partition(".")[0], changed, update=True)
        read = self.expression(value)
        idioms.check_copied(self, value, read)
        if called in formats.NARROW and not formats.is_kept(self, target, called):
            read = located(formats.cast(called, read), self.py.span(value))
        return m.Assign("=", target, read, span)

    # --- calls ----------------------------------------------------------------------------------

    def _call(self, node: Node) -> m.Expression:
        _, arguments = call_parts(node) or ("", [])
        return self._run(node, callee(self, field(node, "function")), arguments)

    def _run(self, node: Node, called: Callee, arguments: list[Node]) -> m.Expression:
        if isinstance(called, ChosenCallee):
            then, other = (self._run(node, c, arguments) for c in (called.then, called.otherwise))
            return idioms.grouped(
                node, m.Conditional(called.asked, then, other, self.py.span(node))
            )
        if called in self.closures:
            return closures.value_of_call(self, node, called, arguments)
        if called in formats.FORMATS and len(arguments) == 1:
            return self._converted(called, arguments[0])
        if called in _CASTS and len(arguments) == 1:
            return m.Cast(_CASTS[called], self.expression(arguments[0]), self.py.span(node))
        if (operated := formats.operation(self, node, called, arguments)) is not None:
            return operated
        if called.startswith((f"{self.own}.", "super().")):
            plain = called.removeprefix(f"{self.own}.")
            called = called if plain == called else f"self.{plain}"
            if called not in self.names.helpers:
                return self._own_call(node, called, arguments)
        return self._function(node, called, arguments)

    def _converted(self, called: str, node: Node) -> m.Expression:
        """A conversion that the model implies; of a literal it tells its type."""
        if node.type == "float" and called in ("float32", "float64"):
            suffix = "d" if called == "float64" else ""
            return m.FloatLiteral(f"{text_of(node)}{suffix}", self.py.span(node))
        read = self.expression(node)
        call = node.parent.parent if node.parent is not None else None
        if called in formats.NARROW and call is not None and idioms.is_within(call):
            cast = formats.cast(called, read)  # the model narrows only what it stores
            return located(cast, self.py.span(call))
        return self.cuts.converted(called, read)

    def _function(self, node: Node, called: str, arguments: list[Node]) -> m.Expression:
        span = self.py.span(node)
        match called, len(arguments):
            case "power", 2:
                return m.Call(None, "pow", tuple(map(self.expression, arguments)), span=span)
            case "square_root", 1:
                return m.Call(None, "sqrt", (self.expression(arguments[0]),), span=span)
            case "copied" | "copy.deepcopy", 1 if called == "copied" or self._is_of_library("copy"):
                return self.expression(arguments[0])
            case "to_rebec", 2:
                type_ = m.Type(original(string_value(arguments[0]) or ""))
                return m.Cast(type_, self.expression(arguments[1]), span)
            case "put", 3:
                name = string_value(arguments[1]) or ""
                variable = self.names.variables.get(name)
                if variable is None:
                    raise self.unread(node, f'the model has no variable "{name}"')
                hidden = variable in self.locals.values()
                target = m.Member(m.Self(span), variable) if hidden else m.Name(variable, span)
                return self.stored(target, arguments[1], arguments[2], node)
            case "put_item", 3:
                return places.put_item(self, node, arguments)
            case "before", 2:
                return places.before(self, node, arguments)
            case _:
                return self._elsewhere(node, called, arguments)

    def _elsewhere(self, node: Node, called: str, arguments: list[Node]) -> m.Expression:
        """What a function of the code, of Python itself, or of its library gives."""
        helper = self.names.helpers.get(called)
        if helper is not None:
            given = arguments_for(helper, self, node, arguments)
            call = m.Call(None, helper.name, given, span=self.py.span(node))
            return self.cuts.passing(call, called)
        if (stands := self.bound.get(text_of(node))) is not None:
            return stands
        if len(arguments) == 2 and is_cast(self.names.constants.module, called):
            return self.expression(arguments[1])
        if len(arguments) == 1 and is_new_type(self.names.constants.module, called):
            return self.expression(arguments[0])
        if arrays.is_length(self, called, arguments):
            raise self.unread(node, arrays.NO_LENGTH.format(called))
        found = functions.called(self, node) or looked_up(self, node)
        if found is None:
            raise self.unread(node, f'the model has no function "{called}"')
        return located(idioms.grouped(node, found.expression), self.py.span(node))

    def _own_call(self, node: Node, called: str, arguments: list[Node]) -> m.Expression:
        if called.startswith("self._mailbox."):
            name = called.removeprefix("self._mailbox.")
            return of_mailbox(self, node, name, arguments)
        holder, _, name = called.rpartition(".")
        span = self.py.span(node)
        sends = self.names.sends.get(name)
        if sends is not None and holder == "self":
            return self.cuts.passing(sent(self, node, sends, arguments), name)
        function = self.names.functions.get(name)
        if function is None:
            raise self.unread(node, f'the model has no function "{called}"')
        if holder == "self" and name in self.names.servers:
            raise self.unread(node, "this serves a message at once; the model only sends them")
        target = m.Super(span) if holder == "super()" else None
        parameters = self.names.parameters.get(name, ())
        arguments = in_order(self, node, arguments, parameters)
        if len(arguments) != len(parameters):
            raise self.unread(node, f'"{name}" is called with other arguments')
        given = tuple(map(self.expression, arguments))
        return self.cuts.passing(m.Call(target, function, given, span=span), name)


_SAME = {"is": "==", "is not": "!="}


def _is_argument(node: Node) -> bool:
    """Whether an expression is an argument of a call by its place, or what an assertion says."""
    above = node.parent
    if above is not None and above.type == "assert_statement":
        return named(above)[0] != node
    return above is not None and above.type == "argument_list"
