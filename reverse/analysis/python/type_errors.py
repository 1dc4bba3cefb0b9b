"""What Python asks of values of its own types that these have not: a TypeError, an AttributeError.

A value that may be of several types must have what is asked in each; one of which no type is known
has nothing.
"""

from __future__ import annotations

from collections.abc import Collection

from rebsync.reverse.analysis.facts import Facts, stored
from rebsync.reverse.analysis.origins import ClassOrigin
from rebsync.reverse.analysis.problems import ProblemNotes
from rebsync.reverse.analysis.python.attribute_errors import AttributeErrors
from rebsync.reverse.analysis.python.class_values import are_classes, is_in_class, is_searched
from rebsync.reverse.analysis.python.element_errors import ElementErrors
from rebsync.reverse.analysis.python.filled_texts import FilledTexts
from rebsync.reverse.analysis.python.format_strings import (
    OF_NUMBERS,
    styles_in,
)
from rebsync.reverse.analysis.python.log_arguments import LogArguments
from rebsync.reverse.analysis.python.message_errors import MessageErrors
from rebsync.reverse.analysis.python.operand_kinds import OperandKinds
from rebsync.reverse.analysis.python.operator_types import (
    INDEXED,
    ITERABLE,
    OF_ELEMENTS,
    ORDERED,
    SEQUENCES,
    given_by,
    takes,
)
from rebsync.reverse.analysis.python.value_types import (
    ContainerType,
    InstanceType,
    LibraryType,
    OwnType,
    ValueType,
    ValueTypes,
    own_type,
    union,
)
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import ImplicitCall, Operator
from rebsync.reverse.libraries.attributes import PATH
from rebsync.reverse.libraries.routines import Language

_WRONG = "is of another type"
_LACKS = "has no such attribute"
NUMBER, TEXT = OwnType.NUMBER, OwnType.TEXT
_EQUALITY = (Operator.EQUAL, Operator.UNEQUAL)
_OF_BITS = frozenset(
    {Operator.BIT_AND, Operator.BIT_OR, Operator.BIT_XOR}
    | {Operator.SHIFT_LEFT, Operator.SHIFT_RIGHT}
)
_PATHS: ValueTypes = frozenset((LibraryType(PATH),))
_OF_WHOLE = "bcdoxX"  # how styles of whole numbers end


class TypeErrors:
    """The values of one function."""

    def __init__(self, notes: ProblemNotes) -> None:
        self._notes = notes
        self.kinds = OperandKinds(notes)
        self._attributes = AttributeErrors(notes, self.kinds)
        self._elements = ElementErrors(notes, self.kinds)
        self._messages = MessageErrors(notes, self.kinds)
        self._filled = FilledTexts(notes, self.kinds)
        self._logs = LogArguments(notes, self.kinds, self._filled)
        self._objects = notes.counts.rules.objects
        self._is_python = notes.table.language is Language.PYTHON

    def of(self, value: e.Expression, facts: Facts) -> ValueTypes | None:
        """The types that a value may be of; None in other languages."""
        return self.kinds.types(value, facts) if self._is_python else None

    def is_path(self, value: e.Expression, facts: Facts) -> bool:
        """Whether a division is none of numbers: it says what is below a path."""
        return self.of(value, facts) == _PATHS

    def is_float(self, number: e.Expression) -> bool:
        """Whether a number may be a float."""
        return self._notes.counts.rules.floats.has(number, self._notes.function.name)

    def caught(self, facts: Facts, target: e.Lvalue | None) -> Facts:
        """What is known where a handler has stored what it catches."""
        types = frozenset((LibraryType("builtins.Exception"),)) if self._is_python else None
        return facts if target is None else stored(facts, target, types)

    def given(self, call: s.Call) -> ValueTypes | None:
        """The types of what a call gives; None in other languages."""
        return self.kinds.given(call) if self._is_python else None

    def check(self, value: e.Expression, facts: Facts) -> None:
        """Notes what evaluating an expression asks of values that have it not."""
        if not self._is_python:
            return
        match value:
            case e.Attribute(of, name) if not isinstance(of, e.ClassReference):
                self._attributes.asks(value, of, name, facts)
            case e.Binary(operator, left, right):
                self._computes(value, operator, left, right, facts)
            case e.Unary(Operator.NEGATE | Operator.PLUS | Operator.INVERT as operator, of):
                self._answers(value, of, operator)
                self._needs(value, of, {NUMBER}, facts)
                if operator is Operator.INVERT and self.is_float(of):
                    self._notes.fails(value, _WRONG)
            case e.Index(of, index):
                self._at(value, of, index, facts)
            case e.Build() | e.BuildMapping():
                self._elements.built(value, facts)
            case e.Format(pieces):
                for piece in pieces:
                    if piece.style is not None:
                        self._styled(value, piece.value, piece.style, facts)
            case e.Global(module, name):
                self._attributes.named(value, module, name)
            case e.LibraryReference(name):
                self._attributes.of_library(value, name)
            case _:
                pass

    def call(self, node: s.Call, facts: Facts) -> None:
        """Notes what a call asks of what is called, and of what it gets."""
        if not self._is_python:
            return
        plain = [a.value for a in node.arguments if a.name is None and not a.stars]
        self._elements.call(node, plain, facts)
        self._logs.check(node, facts)
        if isinstance(node.callee, s.LibraryCallee):
            self._attributes.of_library(node, node.callee.name)
            self._messages.made(node, node.callee.name, facts)
        match node.callee:
            case s.ValueCallee(value):
                self._is_called(node, value, facts)
            case s.MethodCallee(of, "format") if texts := self._notes.texts_of(of):
                for text in texts:
                    self._fills(node, text, plain, facts)
            case s.MethodCallee(_, name, _, str() as after):
                self._attributes.asks_base(node, after, name)
            case s.MethodCallee(receiver, name, _, None):
                self._attributes.asks(node, receiver, name, facts)
                self._attributes.takes_nothing(node, receiver, name, facts)
                if not self._notes.origins.methods_of_any(name):
                    self._is_called(node, e.Attribute(receiver, name), facts)
            case s.LibraryCallee(name):
                self._library_call(node, name, plain, facts)
            case _:
                pass

    def _library_call(
        self, node: s.Call, name: str, plain: list[e.Expression], facts: Facts
    ) -> None:
        match name:
            case "builtins.format" if len(plain) > 1:
                self._styled(node, plain[0], plain[1], facts)
            case "builtins.len":
                for value in plain[:1]:
                    self._answers(node, value, ImplicitCall.LENGTH)
            case "builtins.dict":
                types = [self.kinds.known(self.kinds.types(value, facts)) for value in plain[:1]]
                if not all(map(self._gives_pairs, union(types))):
                    self._notes.fails(node, _WRONG)
            case "builtins.isinstance" if len(plain) > 1:
                if not are_classes(self._notes, plain[1]):
                    self._notes.fails(node, _WRONG)
            case _ if name in OF_ELEMENTS:
                for value in plain if name == "builtins.zip" else plain[:1]:
                    self._answers(node, value, ImplicitCall.ITERATE)
            case _:
                pass

    def _gives_pairs(self, type_: ValueType | None) -> bool:
        """Whether a mapping can be made of a value: of another one, or of pairs."""
        match type_:
            case ContainerType(OwnType.MAPPING) | InstanceType():
                return True
            case ContainerType(_, elements):
                known = self.kinds.known(elements)
                parts = [each.parts for each in known if isinstance(each, ContainerType)]
                are_pairs = all(each is None or len(each) == 2 for each in parts)
                return are_pairs and {*map(own_type, known)} <= {OwnType.TUPLE, OwnType.LIST}
            case _:
                return False

    def _fills(self, node: s.Call, text: str, plain: list[e.Expression], facts: Facts) -> None:
        """Values that `format` puts into a text in some style, which None has not."""
        given: dict[int | str | None, e.Expression] = dict(enumerate(plain))
        given |= {a.name: a.value for a in node.arguments if a.name is not None}
        for piece, style in styles_in(text):
            if piece in given:
                self._styled(node, given[piece], e.Literal(style), facts)

    def iterates(self, node: s.Statement, value: e.Expression, facts: Facts) -> None:
        """Notes that something is gone through that has no elements."""
        if self._is_python:
            self._needs(node, value, ITERABLE, facts)
            self._answers(node, value, ImplicitCall.ITERATE)

    def _answers(
        self,
        node: s.Statement | e.Expression,
        value: e.Expression,
        call: Operator | ImplicitCall,
    ) -> None:
        """A value's class must answer an operator, if it is one of the program's."""
        if self._objects.lacks(value, self._notes.function.name, call):
            self._notes.fails(node, _WRONG)

    def sets(self, target: e.Lvalue, value: e.Expression | None, facts: Facts) -> None:
        """Notes that an attribute is stored in an object that has no place for it."""
        if not (self._is_python and isinstance(target, e.Attribute)):
            return
        origins, rules = self._notes.origins, self._notes.counts.rules
        self._messages.stored(target, value, facts)
        held = origins.of(target.object, self._notes.function.name)
        if target.object == e.Local(self._notes.function.receiver or ""):
            held = frozenset({ClassOrigin(self._notes.function.owner or "")})
        for origin in held:
            match origin:
                case ClassOrigin(of, True) if rules.fixed.refuses(of, target.name):
                    self._notes.fails(target, _LACKS)
                case ClassOrigin(of, False) if target.name in origins.enumerations.of(of):
                    if self._notes.function.name != of:  # the body of the class itself
                        self._notes.fails(target, _LACKS)
                case _:
                    pass

    def stores(self, target: e.Index, facts: Facts) -> None:
        """Notes that an element is stored in what takes none."""
        if not self._is_python:
            return
        changing = {OwnType.LIST, OwnType.MAPPING, OwnType.QUEUE, OwnType.ARRAY}
        changing |= {OwnType.MODEL_ARRAY}
        self._needs(target, target.object, changing, facts)
        if self.kinds.of(target.object, facts) == {OwnType.MAPPING}:
            self._elements.is_key(target, target.index, facts)

    def inserts(self, node: s.Insert, facts: Facts) -> None:
        """Notes that what a comprehension puts into a set or mapping has no hash."""
        if self._is_python:
            self._elements.inserted(node, facts)

    def _is_called(self, node: s.Call, value: e.Expression, facts: Facts) -> None:
        """What is called is no value of Python's own; what else it is, is asked of the call."""
        if self.kinds.of(value, facts) - {None} or self.kinds.is_object(value, facts):
            self._notes.fails(node, _WRONG)

    def _needs(
        self,
        node: s.Statement | e.Expression,
        value: e.Expression,
        taken: Collection[OwnType],
        facts: Facts,
    ) -> None:
        if not all(
            self._is_taken(type_, taken)
            for type_ in self.kinds.known(self.kinds.types(value, facts))
        ):
            self._notes.fails(node, _WRONG)

    def _is_taken(self, type_: ValueType | None, taken: Collection[OwnType]) -> bool:
        match type_:
            case InstanceType(name):  # whose class answers as it is written: `_answers`
                return not self._objects.is_bare(name)
            case ContainerType(None):  # which is only gone through
                return taken is ITERABLE
            case _:
                return own_type(type_) in taken

    def _computes(
        self,
        value: e.Binary,
        operator: Operator,
        left: e.Expression,
        right: e.Expression,
        facts: Facts,
    ) -> None:
        types = self.kinds.types(left, facts), self.kinds.types(right, facts)
        kinds = self.kinds.asked(left, facts), self.kinds.asked(right, facts)
        if operator in (Operator.IN, Operator.NOT_IN):
            wrong = not all(map(is_searched, self.kinds.known(types[1]))) or is_in_class(
                self._notes, left, right
            )
            wrong |= TEXT in kinds[1] and bool(kinds[0] - {TEXT})
            wrong |= OwnType.BYTES in kinds[1] and bool(kinds[0] - {NUMBER, OwnType.BYTES})
            wrong |= _is_none(right)
            if kinds[1] & {OwnType.SET, OwnType.FROZEN, OwnType.MAPPING}:
                self._elements.is_key(value, left, facts)
        elif operator in (Operator.EQUAL, Operator.UNEQUAL, Operator.SAME, Operator.NOT_SAME):
            wrong = False
        else:
            wrong = any(not takes(operator, a, b) for a in kinds[0] for b in kinds[1])
            wrong |= any(self._refuses(operator, a, b) for a in types[0] for b in types[1])
            wrong |= operator in ORDERED and not self._elements.are_comparable(*types)
            wrong |= operator in _OF_BITS and any(map(self.is_float, (left, right)))
            is_times = operator is Operator.MULTIPLY and self.is_float(right)
            wrong |= is_times and bool(kinds[0] - {NUMBER, None})
        if operator is Operator.FLOOR_MODULO and TEXT in kinds[0]:
            texts = self._notes.texts_of(left)
            wrong |= not texts or any(self._filled.refuse(text, right, facts) for text in texts)
        if wrong:
            self._notes.fails(value, _WRONG)
        if operator in (Operator.IN, Operator.NOT_IN):
            self._answers(value, right, operator)
        elif operator not in (*_EQUALITY, Operator.SAME, Operator.NOT_SAME):
            self._answers(value, left, operator)
            self._answers(value, right, operator)

    def _refuses(self, operator: Operator, left: ValueType | None, right: ValueType | None) -> bool:
        """Whether an object of a library is no operand of an operator."""
        pair = left, right
        is_text = operator is Operator.FLOOR_MODULO and left is OwnType.TEXT
        is_own = any(isinstance(type_, InstanceType) for type_ in pair)
        if is_text or is_own or not any(isinstance(type_, LibraryType) for type_ in pair):
            return False
        if None in pair:
            return not self._notes.table.trusts_types
        return not given_by(operator, left, right)

    # --- elements and texts ----------------------------------------------------------------------

    def _at(self, value: e.Index, of: e.Expression, index: e.Expression, facts: Facts) -> None:
        self._needs(value, of, INDEXED, facts)
        kinds = self.kinds.of(of, facts)
        if isinstance(index, e.Slice):
            self._needs(value, of, SEQUENCES, facts)
            for bound in (index.low, index.high, index.step):
                if bound is not None and not _is_none(bound):
                    self._needs(value, bound, {NUMBER}, facts)
            return
        if kinds and kinds <= SEQUENCES | {OwnType.QUEUE, OwnType.MODEL_ARRAY}:
            self._needs(value, index, {NUMBER}, facts)
            if self.is_float(index):
                self._notes.fails(value, _WRONG)
        elif kinds == {OwnType.MAPPING}:
            self._elements.is_key(value, index, facts)

    def _styled(
        self,
        node: s.Statement | e.Expression,
        value: e.Expression,
        style: e.Expression,
        facts: Facts,
    ) -> None:
        """A style that a value of its type has not; other types have styles of their own."""
        if not (isinstance(style, e.Literal) and isinstance(style.value, str) and style.value):
            return
        kinds, letter = self.kinds.of(value, facts), style.value[-1]
        if kinds & {NUMBER, TEXT} and letter.isalpha() and letter not in OF_NUMBERS | {"s"}:
            self._notes.fails(node, _WRONG)
        elif letter == "s":
            self._needs(node, value, {TEXT}, facts)
        elif letter in OF_NUMBERS:
            self._needs(node, value, {NUMBER}, facts)
            if letter in _OF_WHOLE and self.is_float(value):
                self._notes.fails(node, _WRONG)
        else:
            self._needs(node, value, {NUMBER, TEXT}, facts)


def _is_none(value: e.Expression) -> bool:
    return isinstance(value, e.Literal) and value.value is None
