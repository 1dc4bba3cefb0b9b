"""What the integers of a model's rebecs hold between two messages: intervals, class by class."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import reduce

from rebsync import model as m
from rebsync.intervals import INTEGERS, Interval, exactly
from rebsync.reverse.analysis.intervals.invariants import Body, BodyStart, between_messages
from rebsync.static import Analysis


def invariants_of(analysis: Analysis, asked: Collection[str]) -> dict[str, Mapping[str, Interval]]:
    """For each class `asked` of, what its integer variables hold whenever a message server starts.

    Messages and constants (`env`) may be anything; constructors get what `main` says. A class that
    extends another, or is extended, has none.
    """
    model = analysis.model
    classes = [c for c in model.classes if isinstance(c, m.ReactiveClass)]
    extended = {c.extends for c in classes}
    plain = [c for c in classes if c.extends is None and c.name not in extended]
    known = [c for c in plain if c.name in asked]
    return {c.name: between_messages([*_bodies(c, analysis)], _state(c)) for c in known}


def _state(class_: m.ReactiveClass) -> dict[str, m.Type]:
    return {
        declarator.name: declaration.type
        for section in class_.members
        if isinstance(section, m.StateVars)
        for declaration in section.declarations
        for declarator in declaration.declarators
    }


def _bodies(class_: m.ReactiveClass, analysis: Analysis) -> Iterator[Body]:
    constants = {n: s.type for n, s in analysis.env.items() if s.type is not None}
    around = constants | _state(class_)
    methods = [x for x in class_.members if isinstance(x, m.Method)]
    results = {x.name: x.type for x in methods}
    for member in class_.members:
        if not isinstance(member, m.Constructor | m.MessageServer | m.Method):
            continue
        if member.body is None:
            continue
        names = [p.name for p in member.parameters]
        types = around | {p.name: p.type for p in member.parameters}
        entry, given = BodyStart.BETWEEN, dict[str, Interval]()
        if isinstance(member, m.Method):
            entry = BodyStart.WITHIN
        elif isinstance(member, m.Constructor):
            entry, given = BodyStart.FIRST, _arguments(member, analysis)
        yield Body(
            member.name, entry, member.body.statements, types, names, results, arguments=given
        )


def _arguments(constructor: m.Constructor, analysis: Analysis) -> dict[str, Interval]:
    """What the parameters of a constructor get in `main`, where these are numbers."""
    main = analysis.model.main
    rebecs = main.rebecs if main is not None else ()
    made = [r.arguments for r in rebecs if analysis.constructor_of(r) is constructor]
    found = {}
    for parameter, values in zip(constructor.parameters, zip(*made, strict=True), strict=False):
        numbers = _numbers(values, analysis)
        if numbers is not None and parameter.type.name in INTEGERS:
            whole = INTEGERS[parameter.type.name]
            found[parameter.name] = reduce(Interval.join, map(exactly, numbers)).in_type(whole)
    return found


def _numbers(values: Iterable[m.Expression], analysis: Analysis) -> Sequence[int] | None:
    """The numbers that expressions are, without those of `env`: they may change at the start."""
    found = []
    for value in values:
        number = analysis.value_of(value)
        if type(number) is not int or any(isinstance(n, m.Name) for n in m.walk(value)):
            return None
        found.append(number)
    return found or None
