"""Expressions of C++ as expressions of the model (mapping, "Behaviour", from right to left)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync import precedence
from rebsync.records import dataclass
from rebsync.reverse.bodies import (
    cpp_algorithms,
    cpp_called,
    cpp_idioms,
    cpp_mailbox,
    cpp_pointers,
    cpp_texts,
)
from rebsync.reverse.bodies.cpp_constants import constant_named
from rebsync.reverse.bodies.cpp_expression_reader import CppExpressionReader, Exchange
from rebsync.reverse.bodies.cpp_misread import Chain, ChainOperand, Operation, chain_of, is_misread
from rebsync.reverse.bodies.cpp_places import is_this, resolve
from rebsync.reverse.bodies.cpp_stores import kept
from rebsync.reverse.bodies.cpp_time import written
from rebsync.reverse.bodies.cpp_unknowns import HINT, Unknown, choice, domain_near
from rebsync.reverse.bodies.effects.cpp_effects import Effects
from rebsync.reverse.bodies.scope import (
    Inline,
    Itself,
    Lambda,
    Outside,
    Publishes,
    Record,
    Runtime,
    TimerOf,
    Variable,
)
from rebsync.reverse.bodies.serving import Serves
from rebsync.reverse.bodies.types import cpp_casts, cpp_widths
from rebsync.reverse.bodies.types.cpp_conversions import (
    alternatives,
    as_number,
    converted_to,
    operands,
    place_of,
    type_in,
)
from rebsync.reverse.bodies.types.cpp_literals import in_range, is_bare_macro, literal, text_in
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import binary, is_calm, is_place, tight
from rebsync.reverse.models.texts import TEXT, text_literal
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.static.types import BOOLEAN, converts, is_boolean, is_floating

_PREFIX = frozenset({"+", "-", "!", "~"})
_WORDS = {"and": "&&", "or": "||", "not": "!", "not_eq": "!=", "bitand": "&", "bitor": "|"}
_TRUTH, _EITHER = Variable("", BOOLEAN), (m.BoolLiteral(True), m.BoolLiteral(False))
_ONE_OF = "it is one of the values in the comment"
_STANDS = "stands for all that comparisons do not tell apart"
MOVE = cpp_mailbox.MOVE


@dataclass(frozen=True, slots=True)
class CppExpressions(CppExpressionReader):
    """Reads the expressions of one body. What has no meaning in the model raises `Unread`.

    A value that the model cannot know raises `Unknown`, unless its place allows for a choice:
    that is listed in `findings`. Without `inlines` no function's body can stand for its call.
    `subscripts` gets the places of elements whose indices nobody tests, with the lengths.
    """

    def read(self, node: Node) -> m.Expression:
        """The expression, with parentheses where the code has them or the model needs them."""
        if node.id in self.scope.values:
            return self.scope.values[node.id]
        self.check_operator(node)
        match node.type:
            case "identifier" | "qualified_identifier":
                return self._name(node)
            case "this":
                return m.Self(self.cpp.span(node))
            case "parenthesized_expression":
                return m.Paren(self.read(self.only(node)), self.cpp.span(node))
            case "field_expression" | "pointer_expression":
                return cpp_algorithms.dereferenced(self, node) or self._field(node)
            case "subscript_expression":
                return self.index(node, named(part(node, "indices")))
            case "unary_expression":
                return self._unary(node)
            case "update_expression":
                return self._update(node)
            case "binary_expression" | "cast_expression" if is_misread(self.scope, node):
                return self._joined(node, chain_of(self.cpp, self.scope, node))
            case "binary_expression":
                return self._computed(node)
            case "assignment_expression":
                return self.assign(node, self._operator(node), named(node))
            case "conditional_expression":
                condition, then, otherwise = named(node)
                tested = tight(self.condition(condition), precedence.CHAIN)
                ways = alternatives(self.scope, self.read(then), self.read(otherwise))
                cpp_texts.check_alike(self, node, *ways)
                cpp_widths.check(self, node, "+", (then, otherwise))
                return m.Conditional(tested, *ways, self.cpp.span(node))
            case "cast_expression":
                return self.cast(part(node, "type"), part(node, "value"), node)
            case "compound_literal_expression" if len(named(part(node, "value"))) == 1:
                return self.cast(part(node, "type"), named(part(node, "value"))[0], node)
            case "call_expression":
                return cpp_called.called(self, node)
            case _:
                return self._literal(node)

    def condition(self, node: Node, place: Variable | None = None) -> m.Expression:
        """An expression as a truth value that `place` holds; of what is not known a choice."""
        self.check_operator(node)
        match node.type:
            case "parenthesized_expression":
                return m.Paren(self.condition(self.only(node), place), self.cpp.span(node))
            case "unary_expression" if self._sign(node) == "!":
                inner = tight(self.condition(part(node, "argument")), precedence.PREFIX)
                is_either = self.scope.open and inner == m.Choice(_EITHER)
                return inner if is_either else m.Unary("!", inner, self.cpp.span(node))
            case "binary_expression" if self._sign(node) in ("&&", "||"):
                return self.binary(node, self._sign(node), named(node))
        if (there := cpp_pointers.is_there(self, node)) is not None:
            return there
        try:
            read = self.read(node)
            cpp_texts.check_no_text(self, node, read)
            cpp_widths.check_truth(self, node)
        except Unread as unread:
            if not isinstance(unread, Unknown) and not self.scope.open:
                raise
            self.approximate(node, unread)
            return m.Choice(_EITHER, self.cpp.span(node))
        return kept(self, node, read, place or _TRUTH)

    def stored(self, node: Node, place: Variable) -> m.Expression:
        """A value as `place` holds it; where a hint says what it can be, a choice of that."""
        try:
            if place.type is not None and is_boolean(place.type):
                return self.condition(node, place)
            read = self.read(node)
            cpp_texts.check_stored(self, node, read, place)
            cpp_widths.check_stored(self, node, read, place)
            return converted_to(self.scope, read, place)
        except Unread as unread:
            marked = domain_near(node) if self.cpp.has_markers else None
            values, why = marked or place.domain, _ONE_OF
            values = () if place.type == TEXT else values
            if not values and isinstance(unread, Unknown) and self.scope.regions is not None:
                values = self.scope.regions(place)
                why = f'one value of "{place.name}" {_STANDS}'
            if not values or not (self.scope.open or isinstance(unread, Unknown)):
                if place.type == TEXT and isinstance(unread, Unknown):
                    self.scope.changed_texts.add(place.name)
                raise
            why = f"{unread.why}: {why}"
            self.approximate(node, Unread(unread.span, why, HINT if why.endswith(_STANDS) else ""))
            pinned = tuple(converted_to(self.scope, v, place) for v in values)
            return choice(tuple(dict.fromkeys(pinned)))

    def approximate(self, node: Node, unread: Unread) -> None:
        """Lists that a choice stands for an expression, which must touch nothing of the model."""
        if self.findings is None:
            raise Unread(unread.span, f"how often this is done again is not known: {unread.why}")
        if not self.scope.chooses:
            why = ", and only a message server can choose"
            raise Unread(unread.span, unread.why + why, unread.hint)
        Effects(self.cpp, self.scope).check(node)
        self.check_comes_back(node)
        told = unread.span, unread.why, unread.hint, self.within
        self.findings.approximated(self.cpp.source, *told)

    # --- names ----------------------------------------------------------------------------------

    def _literal(self, node: Node) -> m.Expression:
        if (length := written(self, node)) is not None:
            return length
        try:
            if self.scope.open and node.type in ("string_literal", "concatenated_string"):
                return self._text(node)
            read = literal(self.cpp, node)
            held = in_range(read, node) if self.scope.open else read
            if held is not read:
                self.scope.lowered.add(read)
            return held
        except Unread as unread:
            if node.type in ("string_literal", "raw_string_literal", "null", "sizeof_expression"):
                raise self.unknown(node, unread.why) from None
            raise

    def _text(self, node: Node) -> m.Expression:
        text = text_in(node)
        if text is None:
            raise self.unknown(node, "the model has no such texts")
        return text_literal(text, self.cpp.span(node))

    def _name(self, node: Node) -> m.Expression:
        name, span = text_of(node), self.cpp.span(node)
        last = name.rpartition("::")[2]
        match resolve(self.scope, node):
            case Variable(of_model) if name not in self.scope.locals and self.scope.hides(of_model):
                why = f'a local of the name "{of_model}" hides this in the model'
                raise self.unread(node, why, "give the local another name")
            case Variable(of_model):
                return m.Name(of_model, span)
            case Runtime():
                raise self.unread(node, f'"{name}" belongs to the run-time part')
            case Outside():
                raise Unknown(span, f'the model cannot know "{name}"')
            case Record() | Publishes() | Serves() | TimerOf() | Lambda() | Itself():
                raise self.unread(node, f'"{name}" is no value of the model')
            case None:
                pass
            case expression:
                return expression
        for spelled in (name, *(n for n in (last,) if n != name)):
            if spelled in self.scope.enumerators:
                return cpp_idioms.enumerator(self.scope.enumerators[spelled], span)
            if spelled in self.scope.constants:
                cpp, value = self.scope.constants[spelled]
                if is_bare_macro(cpp, value, node):
                    raise self.unread(node, "what stands beside this macro may bind tighter")
                scope = self.scope.without_constant(spelled)
                if spelled == "kNull" and not self.scope.open and text_of(value) == '""':
                    return literal(self.cpp, node)
                return constant_named(self, node, replace(self, cpp=cpp, scope=scope), value)
        if (known := cpp_idioms.constant_named(name, span)) is not None:
            return known
        if self.scope.open:
            raise Unknown(span, f'the model cannot know "{name}"')
        return literal(self.cpp, node)

    def _field(self, node: Node) -> m.Expression:
        span, meaning = self.cpp.span(node), resolve(self.scope, node)
        if text_of(node).startswith("&"):
            raise self.unread(node, "the model has no pointers and references")
        match meaning:
            case Variable(of_model):
                target = node.child_by_field_name("argument")
                if node.type == "field_expression" and target is not None and is_this(target):
                    self_ = m.Self(self.cpp.span(target))
                    return m.Member(self_, of_model, span, self.cpp.span(part(node, "field")))
                return m.Name(of_model, span)
            case Outside():
                if (number := cpp_pointers.constant_of_message(self.scope, node)) is not None:
                    return cpp_idioms.enumerator(number, span)
                raise Unknown(span, f'the model cannot know "{text_of(node)}"')
            case Runtime() | Record() | Lambda() | Itself():
                raise self.unread(node, f'"{text_of(node)}" is no value of the model')
            case Publishes() | Serves() | TimerOf():
                raise self.unread(node, f'"{text_of(node)}" is no value of the model')
            case None:
                raise self.unknown(node, f'"{text_of(node)}" is no variable of the model')
            case expression:
                return expression

    # --- operators ------------------------------------------------------------------------------

    def _sign(self, node: Node) -> str:
        operator = self.cpp.operator(node)
        return _WORDS.get(operator, operator)

    def _operator(self, node: Node) -> str:
        operator = self._sign(node)
        if operator not in precedence.BINARY and not operator.endswith("="):
            raise self.unread(node, f'the model has no operator "{operator}"')
        return operator

    def index(self, node: Node, indices: Sequence[Node]) -> m.Expression:
        array = self.operand(part(node, "argument"), precedence.PRIMARY)
        if len(indices) != 1:
            raise self.unread(node, "an array of the model has one index at a time")
        cpp_texts.check_no_text(self, node, array)
        index, span = as_number(self.scope, self.read(indices[0])), self.cpp.span(node)
        if node.type == "subscript_expression":
            whole = place_of(self.scope, array).type
            length = whole.dimensions[0] if whole is not None and whole.dimensions else 0
            if not (isinstance(index, m.IntLiteral) and 0 <= index.value < length):
                self.subscripts[span] = min(length, self.subscripts.get(span, length))
        return m.Index(array, index, span)

    def _unary(self, node: Node) -> m.Expression:
        operator = self._sign(node)
        if operator not in _PREFIX:
            raise self.unread(node, f'the model has no operator "{operator}"')
        if operator == "!":
            return self.condition(node)
        operand = self.operand(part(node, "argument"), precedence.PREFIX)
        cpp_texts.check_no_text(self, node, operand)
        operand = tight(as_number(self.scope, operand), precedence.PREFIX)
        return m.Unary(operator, operand, self.cpp.span(node))

    def _update(self, node: Node) -> m.Expression:
        operator, span = text_of(part(node, "operator")), self.cpp.span(node)
        argument = part(node, "argument")
        before = argument.start_byte != node.start_byte
        counted = self.read(argument)
        if not is_place(counted):
            raise self.unread(argument, "what is changed here is only known when it runs")
        place = place_of(self.scope, counted)
        real = place.type is not None and is_floating(place.type)
        if place.bits or real:
            if not before and node.parent is not None and node.parent.type.endswith("expression"):
                why = "the model counts only whole numbers" if real else "this wraps sooner"
                raise self.unread(node, why, "count in a statement of its own")
            target = self.read(argument)
            value = binary(*operands(self.scope, operator[0], target, m.IntLiteral(1)))
            return m.Assign("=", target, kept(self, node, value, place), span)
        if before:
            return m.Unary(operator, self.operand(argument, precedence.PREFIX), span)
        return m.Postfix(operator, self.operand(argument, precedence.POSTFIX), span)

    def _joined(self, whole: Node, chain: Chain) -> m.Expression:
        """A chain of operators of which the grammar took a part for a cast."""
        match chain:
            case ChainOperand(cpp, node) if cpp is self.cpp:
                return self.read(node)
            case ChainOperand(cpp, node):
                try:
                    value = replace(self, cpp=cpp).read(node)
                except Unread as unread:
                    span = self.cpp.span(whole)
                    raise type(unread)(span, unread.why, unread.hint) from None
                return value if self.scope.open else m.Paren(value)
            case Operation(operator, left, right):
                sides = self._joined(whole, left), self._joined(whole, right)
                for side in (left, right):
                    if isinstance(side, ChainOperand) and cpp_widths.is_wide(self, side):
                        raise self.unknown(whole, "what this gives depends on how wide it is")
                return binary(*operands(self.scope, operator, *sides))

    def _computed(self, node: Node) -> m.Expression:
        operator = self._operator(node)
        found = cpp_texts.of_compare(self, node, operator)
        if found := found or cpp_algorithms.compared(self, operator, named(node)):
            return found
        drawn = cpp_idioms.drawn(self, node, named(node)) if operator == "%" else None
        return drawn or self.binary(node, operator, named(node))

    def binary(self, node: Node, operator: str, sides: Sequence[Node]) -> m.Expression:
        reads = self.condition if operator in ("&&", "||") else self.read
        left, right = (reads(side) for side in sides)
        if (of_texts := cpp_texts.operation(self, node, operator, left, right)) is not None:
            return of_texts
        operator = cpp_widths.exact(self, operator, sides)
        operator, left, right = operands(self.scope, operator, left, right)
        if (found := cpp_widths.ordered(self, operator, sides, (left, right))) is not None:
            return found
        cpp_widths.check(self, node, operator, sides)
        return binary(operator, left, right, self.cpp.span(node))

    def assign(self, node: Node, operator: str, sides: Sequence[Node]) -> m.Expression:
        target, value = sides
        written = self.operand(target, precedence.CHAIN)
        if not is_place(written):
            raise self.unread(target, "what is changed here is only known when it runs")
        place, span = place_of(self.scope, written), self.cpp.span(node)
        if operator == "=":
            return m.Assign("=", written, self.stored(value, place), span)
        right = self.read(value)
        cpp_texts.check_no_text(self, node, written, right)
        cpp_widths.check(self, node, operator[:-1], sides)
        done, left, right = operands(self.scope, operator[:-1], written, right)
        result = type_in(self.scope, binary(done, left, right))
        if place.type is None or result is None or not is_calm(written):
            return m.Assign(operator, written, right, span)
        if place.bits or left is not written or not converts(result, place.type, {}):
            whole = kept(self, node, binary(done, left, right), place)
            return m.Assign("=", written, whole, span)
        return m.Assign(operator, written, right, span)

    def cast(self, to: Node, operand: Node, node: Node) -> m.Expression:
        """A value that is converted by a cast of whatever kind."""
        return cpp_casts.cast(self, to, operand, node)

    # --- calls ----------------------------------------------------------------------------------

    def inlined(
        self, node: Node, function: Inline | Lambda | Exchange, arguments: Sequence[Node]
    ) -> m.Expression:
        """What a call gives for which the function's body stands."""
        if self.inlines is None:
            raise self.unread(node, "the model cannot run this function inside an expression")
        match self.inlines(node, function, arguments):
            case Variable(name):
                return m.Name(name, self.cpp.span(node))
            case Outside():
                raise Unknown(self.cpp.span(node), "the model cannot know what this gives")
            case None | Record() | Runtime() | Lambda() | Itself():
                raise self.unread(node, "what this gives is no value of the model")
            case Publishes() | Serves() | TimerOf():
                raise self.unread(node, "what this gives is no value of the model")
            case expression:
                return expression
