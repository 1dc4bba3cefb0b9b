"""What C++ looks up that may not be there: elements, objects behind pointers and iterators, texts.

The language leaves undefined what such code does; the program may end. A local pointer or iterator
must lead to something by all that is stored in it, or by what was tested; a member or a variable of
a file that gets an object anywhere is trusted to have got it before.
"""

from __future__ import annotations

from collections.abc import Sequence

from rebsync.reverse.analysis.facts import NO_FACTS, Facts, Holds, names_of, tested
from rebsync.reverse.analysis.held_values import all_held
from rebsync.reverse.analysis.outcomes.element_bounds import ElementBounds
from rebsync.reverse.analysis.problems import NOTHING_THERE, ODD_FORMAT, ProblemNotes
from rebsync.reverse.analysis.python.format_strings import conversions
from rebsync.reverse.analysis.stores import AnyValue, CallResult, Value
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.libraries.cpp import logging
from rebsync.reverse.libraries.outcome_classes import TERMINATES
from rebsync.reverse.libraries.outcome_rules import Size
from rebsync.reverse.libraries.outcomes import CallOutcome
from rebsync.reverse.libraries.size_effects import LEADING_ON, LEADING_TO_FIRST, SEARCHING

_DEEPEST = 4  # of variables that are stored in others
_LASTING = (e.Attribute, e.Global, e.Captured)
_AT_ENDS = frozenset({"front", "back", "top"})
_PRINTING = ("printf", "fprintf")


class UndefinedLookups:
    """Lookups in one function."""

    def __init__(self, notes: ProblemNotes, bounds: ElementBounds) -> None:
        self._notes = notes
        self._bounds = bounds

    def element(self, value: e.Index, facts: Facts) -> None:
        """Notes an element that a container may not have."""
        type_ = getattr(value.object, "type", t.UNKNOWN)
        is_mapping = isinstance(type_, t.Container) and type_.kind is t.ContainerKind.MAPPING
        # Arrays in messages have the elements that code names by numbers.
        is_part = type_ == t.UNKNOWN and isinstance(value.object, e.Attribute)
        is_trusted = is_part and isinstance(value.index, e.Literal)
        if is_mapping or is_trusted or isinstance(type_, t.Record):
            return
        if not self._bounds.is_within(value, facts):
            self._notes.problem(value, NOTHING_THERE)

    def pointee(self, value: e.Dereference, facts: Facts) -> None:
        """Notes an object that a pointer, an optional or an iterator may not lead to."""
        if self.may_be_nothing(value.reference, facts):
            self._notes.problem(value, NOTHING_THERE)

    def text(self, value: e.Convert, facts: Facts) -> None:
        """Notes a text that is made of a pointer which may lead to none."""
        if self.may_be_nothing(value.operand, facts):
            self._notes.problem(value, NOTHING_THERE)

    def call(
        self, node: s.Call, outcome: CallOutcome, of: e.Expression | None, facts: Facts
    ) -> None:
        """Notes what a call of a library takes out of what is empty, or for a text."""
        name = getattr(node.callee, "name", "")
        values = [a.value for a in node.arguments]
        last = name.rpartition("::")[2]
        taken = of if not values and (outcome.size is Size.LOSES or last in _AT_ENDS) else None
        is_short = taken is not None and not self._bounds.size(taken, facts)
        is_erased = last == "erase" and len(values) == 1
        letters, told = _formatted(name, values)
        texts = [v for letter, v in zip(letters, told, strict=False) if letter == "s"]
        if len(letters) > len(told) or any(map(_is_number, texts)):
            self._notes.problem(node, ODD_FORMAT, TERMINATES)
        asked = [*texts, *(values if is_erased else ())]
        if is_short or any(self.may_be_nothing(v, facts) for v in asked):
            self._notes.problem(node, NOTHING_THERE)

    # --- pointers ---------------------------------------------------------------------------------

    def may_be_nothing(self, value: e.Expression, facts: Facts, depth: int = 0) -> bool:
        """Whether a pointer may be null, an optional empty, an iterator the end."""
        value = value.target if isinstance(value, e.AddressOf) else value
        type_ = getattr(value, "type", t.UNKNOWN)
        if isinstance(type_, t.Reference) and not (type_.may_be_null or type_.ownership.value):
            return False
        if any(Holds(name) in facts for name in names_of(facts, value)):
            return False
        match value:
            case e.Literal(None):
                return True
            case e.Convert(_, operand) | e.Copy(operand) | e.Move(operand):
                return self.may_be_nothing(operand, facts, depth)
            case e.Conditional(test, then, otherwise):
                first = self.may_be_nothing(then, tested(facts, test, True), depth)
                return first or self.may_be_nothing(otherwise, tested(facts, test, False), depth)
            case e.Local() | e.Temporary() | e.Captured() | e.Global() | e.Attribute():
                known = facts if isinstance(value, e.Temporary) else NO_FACTS
                return self._may_hold_nothing(value, type_, known, depth)
            case e.Index() | e.Dereference():
                return _is_plain(type_)
            case _:
                return False

    def _may_hold_nothing(
        self, value: e.Expression, type_: t.Type, facts: Facts, depth: int
    ) -> bool:
        """Whether a variable may hold nothing by what is stored in it, at other places."""
        stored = all_held(self._notes.origins, value, self._notes.function.name)
        if self._notes.is_parameter(value) or not stored or depth > _DEEPEST:
            return _is_plain(type_)
        found = (self._is_nothing(v, type_, facts, depth + 1) for _, v in stored)
        return all(found) if isinstance(value, _LASTING) else any(found)

    def _is_nothing(self, stored: Value, type_: t.Type, facts: Facts, depth: int) -> bool:
        match stored:
            case AnyValue():
                return _is_plain(type_)
            case CallResult(s.Call(_, s.FunctionCallee(name))):
                return any(
                    map(_returns_nothing, walk(self._notes.origins.graph.program.function(name)))
                )
            case CallResult(call):
                return self._gives_nothing(call, facts)
            case _:
                if not isinstance(stored, e.Expression):
                    return False
                return self.may_be_nothing(stored, facts, depth)

    def _gives_nothing(self, call: s.Call, facts: Facts) -> bool:
        """Whether a function of a library may find nothing, or lead to the first of no elements."""
        name = getattr(call.callee, "name", "").partition("<")[0].rpartition("::")[2]
        of = getattr(call.callee, "receiver", None)
        first = next((a.value for a in call.arguments), of) if of is None else of
        if name in SEARCHING or first is None:
            return name in SEARCHING
        first = first.target if isinstance(first, e.AddressOf) else first
        if name in LEADING_ON:
            first = call.arguments[0].value if call.arguments else first
            return self.may_be_nothing(first, facts)
        return name in LEADING_TO_FIRST and not self._bounds.size(first, facts)


def _returns_nothing(node: object) -> bool:
    """Whether a statement gives null, or an optional without a value, as it is written."""
    return (
        isinstance(node, s.Return)
        and node.value is not None
        and any(isinstance(n, e.Literal) and n.value is None for n in walk(node.value))
    )


def _formatted(
    name: str, values: Sequence[e.Expression]
) -> tuple[Sequence[str], Sequence[e.Expression]]:
    """The letters of what a log, or a function of C that prints, puts into a text; the values."""
    texts = [i for i, v in enumerate(values) if isinstance(v, e.Literal) and type(v.value) is str]
    at = 1 if "_NAMED" in name else 0
    is_log = name.startswith(logging()) and "_STREAM" not in name
    if not (is_log or name.rpartition("::")[2] in _PRINTING) or len(texts) <= at:
        return (), ()
    letters = conversions(str(getattr(values[texts[at]], "value", "")))
    return letters or (), values[texts[at] + 1 :]


def _is_number(value: e.Expression) -> bool:
    """Whether a value is a number, which `%s` takes for the address of a text ([c.format])."""
    value = value.target if isinstance(value, e.AddressOf) else value
    return isinstance(getattr(value, "type", t.UNKNOWN), t.Integer | t.Float | t.Truth)


def _is_plain(type_: t.Type) -> bool:
    """Whether what is of a type may lead to nothing, whoever gives it: no object that is shared."""
    is_owned = isinstance(type_, t.Reference) and bool(type_.ownership.value)
    return isinstance(type_, t.Optional | t.Reference) and not is_owned
