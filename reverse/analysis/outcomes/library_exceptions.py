"""Which exceptions calls of libraries raise, by what they get."""

from __future__ import annotations

import datetime
import re
import time
from collections.abc import Sequence
from typing import Literal, TypeAlias

from rebsync.reverse.analysis.cpp_parameters import CppParameters
from rebsync.reverse.analysis.facts import Facts, HasKey, bare, names_of
from rebsync.reverse.analysis.numbers.given_counts import count_given, is_position, takes_part
from rebsync.reverse.analysis.numbers.magnitudes import Magnitudes
from rebsync.reverse.analysis.origins import ClassOrigin, Origin, PlainOrigin
from rebsync.reverse.analysis.outcomes.outcome_expressions import OutcomeExpressions
from rebsync.reverse.analysis.outcomes.stream_failures import STREAM_FAILURE, may_fail
from rebsync.reverse.analysis.outcomes.time_arguments import OF_TIMES, TimeArguments
from rebsync.reverse.analysis.problems import BEYOND_TIMES, ODD_PARAMETER, ProblemNotes
from rebsync.reverse.analysis.python.format_strings import has_pieces
from rebsync.reverse.analysis.python.value_types import OwnType
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.libraries.outcome_classes import NUMBERED
from rebsync.reverse.libraries.outcome_rules import Raises
from rebsync.reverse.libraries.outcomes import CallOutcome
from rebsync.reverse.libraries.routines import Language
from rebsync.unions import assert_never


def _is_positive(value: object) -> bool:
    return isinstance(value, int | float) and value > 0


_OfNumbers: TypeAlias = Literal[Raises.NEGATIVE, Raises.ZERO_SECOND, Raises.ZERO_STEP, Raises.POWER]
_Plain: TypeAlias = Literal[Raises.NO_TEXT, Raises.UNWRITTEN]
_OF_MOMENTS = {"datetime": datetime, "time": time}
_NAME = re.compile(r"(?:[A-Za-z~/][\w/]*)?", re.ASCII)  # of ROS
_MEMORY = 1 << 40
_WHOLE = (["utf-8"], ["utf8"], ["UTF-8"])  # encodings that have all characters


class LibraryExceptions:
    """Calls of libraries in one function."""

    def __init__(self, notes: ProblemNotes, expressions: OutcomeExpressions) -> None:
        self.expressions = expressions
        self.table = notes.table
        self.origins = notes.origins
        self.function = notes.function.name

    def of(
        self, node: s.Call, outcome: CallOutcome, receiver: e.Expression | None, facts: Facts
    ) -> frozenset[str]:
        """The exceptions that a call of a library may raise, by what it gets."""
        plain = [a.value for a in node.arguments if a.name is None]
        if receiver is not None and self.expressions.foreign.has(receiver, self.function):
            return frozenset()
        if may_fail(self.origins, node):
            return outcome.raises | {STREAM_FAILURE}
        raised = outcome.raises if self._may_raise(node, outcome.when, facts) else frozenset()
        of = receiver
        if of is None and node.arguments:
            of = node.arguments[0].value
        is_field = isinstance(of, e.Attribute | e.Index)
        # Of a variable of which nothing is known, a text is made a number.
        is_number = of is not None and (is_field or self._is_number(of))
        if raised and outcome.when is Raises.INFINITE and is_number:
            raised |= {"builtins.OverflowError"}
        has_default = any(a.name == "default" for a in node.arguments)
        is_many = receiver is None and (len(plain) > 1 or has_default)
        if is_many or (of is not None and self._has_elements(of, facts)):
            return raised
        return raised | outcome.empty

    def _has_elements(self, value: e.Expression, facts: Facts) -> bool:
        kinds = self.expressions.types.kinds.of(value, facts)
        return bool(self.expressions.size(value, facts)) or kinds == {OwnType.MODEL_ARRAY}

    def why(self, name: str, outcome: CallOutcome) -> str:
        """What is said of a call that may raise something."""
        if outcome.when in (Raises.OTHER_TYPE, Raises.REPEATED):
            return ODD_PARAMETER
        is_of_time = outcome.when in OF_TIMES
        return BEYOND_TIMES if is_of_time else f'"{name}" may raise an exception'

    def has_pieces(self, node: s.Call, text: e.Expression) -> bool:
        """Whether a call that formats a text gets all arguments that the text names."""
        if self.table.language is not Language.PYTHON:
            return True
        texts = self.expressions.texts(text)
        by_place = sum(a.name is None for a in node.arguments)
        names = {a.name for a in node.arguments if a.name is not None}
        stars = any(a.stars for a in node.arguments)
        return bool(texts) and not stars and all(has_pieces(t, by_place, names) for t in texts)

    def _may_raise(self, node: s.Call, when: Raises, facts: Facts) -> bool:
        """Whether a call gets arguments for which its rule says that it raises."""
        values = [a.value for a in node.arguments]
        if any(a.stars for a in node.arguments):
            return True
        match when:
            case Raises.ANY:
                return True
            case Raises.ALONE:
                return not values
            case Raises.NO_ERROR_CODE:
                return not any(map(_is_error_code, values))
            case Raises.NO_DEFAULT:
                return len(values) < 2 and not self._is_there(node, facts)
            case Raises.ABSENT:
                return len(values) > 1 or not self._is_there(node, facts)
            case Raises.NEGATIVE | Raises.ZERO_SECOND | Raises.ZERO_STEP | Raises.POWER:
                return not self._are_numbers(values, when, facts)
            case Raises.COUNT:
                return self._is_count(node, facts)
            case Raises.PART:
                return takes_part(node) or self._is_count(node, facts)
            case Raises.POSITION:
                return bool(values) and is_position(bare(values[0]))
            case Raises.TEXT:
                first = values[:1]
                return not all(self._is_number_text(v, facts) for v in first)
            case Raises.INFINITE | Raises.BOUNDLESS:
                return self._may_be_infinite(values[:1], when)
            case Raises.COMPUTED:
                return not all(map(self.expressions.is_written, values)) or _is_no_time(node)
            case Raises.NO_START:
                return len(values) < 3 and not any(
                    self.expressions.size(v, facts) for v in values[1:]
                )
            case Raises.CODED:
                return any(self.expressions.texts(v) not in _WHOLE for v in values)
            case Raises.NO_TEXT | Raises.UNWRITTEN:
                return not self._are_plain(values, when, facts)
            case Raises.UNDECLARED | Raises.UNDECLARED_ALONE | Raises.REPEATED | Raises.OTHER_TYPE:
                return self._is_odd_parameter(node, when, facts)
            case Raises.NO_NAME:
                texts = (text for v in values for text in self.expressions.texts(v))
                return not all(map(_NAME.fullmatch, texts))
            case Raises.UNORDERED:
                return not self._are_ordered(values, facts)
            case _:
                return TimeArguments(self.origins, self.function).are_beyond(values, when)

    def _may_be_infinite(self, values: Sequence[e.Expression], when: Raises) -> bool:
        """Whether numbers may be greater than all, or (`INFINITE`) values may be no numbers."""
        is_finite = Magnitudes(self.origins, self.function).is_finite
        if when is Raises.BOUNDLESS:
            return not all(map(is_finite, values))
        is_whole = self.expressions.types.kinds.is_whole
        if all(is_whole(v) or self._is_of_number(v, int) for v in values):
            return False
        return not all(self._is_number(v) and is_finite(v) for v in values)

    def _is_odd_parameter(self, node: s.Call, when: Raises, facts: Facts) -> bool:
        """Whether a parameter may not be declared that is asked for, or is declared again."""
        if when is Raises.UNDECLARED_ALONE:
            return len(node.arguments) == 1 and not self._are_declared(node.arguments[0].value)
        if when is Raises.OTHER_TYPE:
            return CppParameters(self.origins).is_of_other_type(node, self.function)
        if self.table.language is Language.CPP:
            return CppParameters(self.origins).is_declared_again(self.function)
        declared = self.expressions.notes.counts.rules.declared
        if when is Raises.REPEATED:
            return declared.may_have(self.function)
        return not self._is_there(node, facts) and declared.may_lack(node, self.function)

    def _are_plain(self, values: Sequence[e.Expression], when: _Plain, facts: Facts) -> bool:
        """Whether the arguments are of the types for which a call does not raise."""
        kinds = self.expressions.types.kinds
        match when:
            case Raises.NO_TEXT:
                return all(kinds.of(v, facts) <= {OwnType.TEXT, None} for v in values[:1])
            case Raises.UNWRITTEN:
                return all(map(self.expressions.texts, values[:1]))
            case _:
                assert_never(when)

    def _are_numbers(self, values: Sequence[e.Expression], when: _OfNumbers, facts: Facts) -> bool:
        """Whether the arguments are numbers for which a rule says that a call does not raise."""
        match when:
            case Raises.NEGATIVE:
                return all(self._is_size(v, facts) for v in values[:1])
            case Raises.ZERO_SECOND:
                return all(self.expressions.is_nonzero(v, facts) for v in values[1:2])
            case Raises.ZERO_STEP:
                return all(self.expressions.is_nonzero(v, facts) for v in values[2:])
            case Raises.POWER:
                numbers = [bare(v) for v in values[1:2]]
                return all(isinstance(v, e.Literal) and _is_positive(v.value) for v in numbers)
            case _:
                assert_never(when)

    def _is_there(self, node: s.Call, facts: Facts) -> bool:
        """Whether the object of a method is known to have the first argument."""
        match node.callee, node.arguments:
            case s.MethodCallee(receiver), (s.CallArgument(value), *_):
                return any(HasKey(of, value) in facts for of in names_of(facts, receiver))
            case s.LibraryCallee(), (s.CallArgument(value), *_):  # a parameter, by its name
                return HasKey(value, value) in facts
            case _:
                return False

    def _are_declared(self, name: e.Expression) -> bool:
        """Whether parameters are declared under all names that a text may be."""
        names = self.expressions.texts(name)
        return bool(names) and self.origins.of_cpp.declared_parameters.issuperset(names)

    def _is_number(self, value: e.Expression) -> bool:
        """Whether a value is a number by how it is computed, or a member that is one."""
        held = self.origins.of(value, self.function)
        return bool(held) and all(map(self._is_plain, held))

    def _is_plain(self, origin: Origin) -> bool:
        match origin:
            case PlainOrigin():
                return True
            case ClassOrigin(name, True):
                return not NUMBERED.isdisjoint(self.origins.graph.bases(name))
            case _:
                return False

    def _is_number_text(self, value: e.Expression, facts: Facts) -> bool:
        """Whether a value is a number, or a text that is one."""
        is_known = self.expressions.types.kinds.of(value, facts) == {OwnType.NUMBER}
        if isinstance(value, e.Convert) and isinstance(value.type, t.Integer | t.Float):
            return True
        return is_known or self._is_number(value) or self._is_of_number(value, float)

    def _is_of_number(self, value: e.Expression, kind: type[int] | type[float]) -> bool:
        """Whether a value is one of some texts in the source, which are those of numbers."""
        texts = self.expressions.texts(value)
        try:
            return bool(texts) and all(isinstance(kind(text), kind) for text in texts)
        except ValueError:
            return False

    def _is_count(self, node: s.Call, facts: Facts) -> bool:
        """Whether a call gets a number of elements that may be negative."""
        count = count_given(node)
        return count is not None and not self._is_size(count, facts)

    def _is_size(self, value: e.Expression, facts: Facts) -> bool:
        """Whether a number is not negative; in C++ nor one of more elements than any memory has."""
        is_cpp = self.table.language is Language.CPP
        is_great = is_cpp and self.expressions.bounds.range_of(value, facts).low > _MEMORY
        return not is_great and self.expressions.is_positive(value, facts)

    def _are_ordered(self, values: list[e.Expression], facts: Facts) -> bool:
        """Whether of two numbers the second is not the smaller one."""
        match values:
            case [e.Literal(int() as low), e.Literal(int() as high)]:
                return low <= high
            case [e.Literal(int() as low), high]:
                return low <= 0 and self.expressions.is_positive(high, facts)
            case _:
                return False


def _is_no_time(node: s.Call) -> bool:
    """Whether numbers in the source are no time: the library is asked, as it is the same here."""
    if not isinstance(node.callee, s.LibraryCallee):
        return False
    module, _, name = node.callee.name.partition(".")
    plain = [_written(a.value) for a in node.arguments if a.name is None]
    named = {a.name: _written(a.value) for a in node.arguments if a.name is not None}
    make = getattr(_OF_MOMENTS.get(module), name, None)
    if make is None or None in (*plain, *named.values()):
        return False
    try:
        make(*plain, **named)
    except (ArithmeticError, OSError, TypeError, ValueError):
        return True
    return False


def _written(value: e.Expression) -> object:
    """A number that stands in the source; None for any other value."""
    match value:
        case e.Literal(number):
            return number
        case e.Unary(Operator.NEGATE, e.Literal(int() | float() as number)):
            return -number
        case _:
            return None


def _is_error_code(value: e.Expression) -> bool:
    """Whether an argument is the place for an error, so that nothing is thrown."""
    while isinstance(value, e.AddressOf | e.Convert):
        value = value.target if isinstance(value, e.AddressOf) else value.operand
    type_ = getattr(value, "type", t.UNKNOWN)
    return isinstance(type_, t.Record) and type_.name.endswith("::error_code")
