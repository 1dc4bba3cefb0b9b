"""What C++ looks up that may not be there: elements, objects behind pointers and iterators, texts.

The language leaves undefined what such code does; the program may end.
"""

from __future__ import annotations

from collections.abc import Sequence

from rebsync.reverse.analysis.facts import Facts
from rebsync.reverse.analysis.outcomes.element_bounds import ElementBounds
from rebsync.reverse.analysis.outcomes.lifetimes import Lifetimes
from rebsync.reverse.analysis.outcomes.null_pointers import NullPointers
from rebsync.reverse.analysis.problems import NOTHING_THERE, ODD_FORMAT, ProblemNotes
from rebsync.reverse.analysis.python.format_strings import conversions
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.libraries.cpp import logging
from rebsync.reverse.libraries.outcome_classes import TERMINATES
from rebsync.reverse.libraries.outcome_rules import Size
from rebsync.reverse.libraries.outcomes import CallOutcome
from rebsync.reverse.libraries.size_effects import TAKING_TEXTS

_AT_ENDS = frozenset({"front", "back", "top"})
_PRINTING = ("printf", "fprintf")


class UndefinedLookups:
    """Lookups in one function."""

    def __init__(self, notes: ProblemNotes, bounds: ElementBounds) -> None:
        self._notes = notes
        self._bounds = bounds
        self.pointers = NullPointers(notes, bounds)
        self.lifetimes = Lifetimes(notes)

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
            self._notes.problem(value, NOTHING_THERE, TERMINATES)

    def pointee(self, value: e.Dereference, facts: Facts) -> None:
        """Notes an object that a pointer, an optional or an iterator may not lead to."""
        self._led_to(value, value.reference, facts)

    def text(self, value: e.Convert, facts: Facts) -> None:
        """Notes a text that is made of a pointer which may lead to none."""
        self._led_to(value, value.operand, facts)

    def call(
        self, node: s.Call, outcome: CallOutcome, of: e.Expression | None, facts: Facts
    ) -> None:
        """Notes what a call of a library takes out of what is empty, or for a text."""
        self.lifetimes.check(node, facts)
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
        asked = [*texts, *(values if is_erased or last in TAKING_TEXTS else ())]
        if is_short:
            self._notes.problem(node, NOTHING_THERE, TERMINATES)
        for value in asked:
            self._led_to(node, value, facts)

    def _led_to(
        self, node: s.Statement | e.Expression, pointer: e.Expression, facts: Facts
    ) -> None:
        """Notes what asks for the object of a pointer that may have none."""
        if self.pointers.may_be(pointer, facts):
            self._notes.problem(node, NOTHING_THERE, TERMINATES)
        elif (given := self.pointers.given(pointer, facts)) is not None:
            self._notes.problem(node, NOTHING_THERE, TERMINATES, given)


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
