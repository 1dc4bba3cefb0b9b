"""Values that stand for all that a parameter of a message server can hold.

A value that is only copied, and compared with constants, lies in one of the regions between these:
one value of each region shows all that the model does with it (predicate abstraction, Graf and
Saidi 1997, by the comparisons of the model). Data flow is followed without regard to order.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import field
from itertools import pairwise
from math import ceil, floor

from rebsync import model as m
from rebsync.intervals import INT32, INTEGERS, Interval
from rebsync.properties import Properties, state_expressions
from rebsync.records import dataclass
from rebsync.reverse.environment.constant_variables import (
    Constants,
    constant_variables,
    possible_constants,
)
from rebsync.reverse.environment.scopes import Scope, Variable
from rebsync.reverse.models.texts import OTHER, is_text
from rebsync.static.constants import Value, constant, single

_COMPARISONS = frozenset({"==", "!=", "<", "<=", ">", ">="})
_LOGIC = frozenset({"&&", "||"})
_REAL = frozenset({"float", "double"})
# Casts by the type of the value after which it is the same number.
_WIDER = {
    "byte": frozenset({"byte", "short", "int", *_REAL}),
    "short": frozenset({"short", "int", *_REAL}),
    "int": frozenset({"int", "double"}),
    "float": _REAL,
    "double": frozenset({"double"}),
}
_PROPERTIES = ""  # the class of what only properties name
_BODIES = (m.Constructor, m.MessageServer, m.Method)


@dataclass(frozen=True, slots=True)
class Representatives:
    """Some values of a parameter; `is_exact` says that they show all that the model can do.

    `cuts` are the constants that it is compared with.
    """

    values: tuple[Value, ...]
    is_exact: bool
    cuts: frozenset[Value] = field(default=frozenset(), compare=False)


def representatives(
    model: m.Model,
    places: Collection[Variable],
    type_: m.Type,
    properties: Properties,
    within: Interval | None = None,
) -> Representatives:
    """Values for parameters of servers that get the same value.

    Whole numbers are those of the type, or `within` an interval.
    """
    if type_.dimensions or type_.name not in (*INTEGERS, *_REAL, "boolean"):
        return Representatives((), False)
    if type_.name == "boolean":
        return Representatives((False, True), True)
    env = _constants(model)
    flow = DataFlow(type_.name, env, constant_variables(model, env), set(places))
    flow.follow(model, properties)
    integer = type_.name in INTEGERS
    range_ = within or INTEGERS.get(type_.name, INT32)
    values = _integers(flow.cuts, range_) if integer else _reals(flow.cuts, type_.name)
    return Representatives(tuple(values), flow.is_exact, frozenset(flow.cuts))


def of_texts(numbers: Representatives, texts: Sequence[str]) -> Representatives:
    """The same for a text: those of the texts of the model that are told apart, and others.

    With all of them, and `OTHER`, it does not matter what else is done with the text.
    """
    every = [n for n, text in enumerate(texts) if is_text(text)]
    told = [n for n in every if n in numbers.cuts] if numbers.is_exact else every
    return Representatives((*told, OTHER), True)


def _reals(cuts: Iterable[Value], type_: str) -> Iterator[Value]:
    """Each cut, and a number of each region: the one that is nearest to 0 below and above all.

    A literal of the model may be one of single precision, which is another number.
    """
    numbers = [float(c) for c in cuts]
    points = sorted({*map(single, numbers), *(numbers if type_ == "double" else ())})
    if not points:
        yield 0.0
        return
    yield 0.0 if points[0] > 0 else points[0] - 1
    for one, next_ in pairwise(points):
        yield from (one, (one + next_) / 2)
    yield from (points[-1], 0.0 if points[-1] < 0 else points[-1] + 1)


def _integers(cuts: Iterable[Value], range_: Interval) -> Iterator[Value]:
    """The same for whole numbers, between which a cut may lie."""
    whole = {n for c in cuts for n in (floor(c), ceil(c))}
    points = sorted(n for n in whole if range_.low <= n <= range_.high)
    if not points:
        yield 0
        return
    found = [0 if points[0] > 0 else points[0] - 1]
    for one, next_ in pairwise(points):
        found += [one, *([one + 1] if one + 1 < next_ else [])]
    found += [points[-1], 0 if points[-1] < 0 else points[-1] + 1]
    yield from (n for n in found if range_.low <= n <= range_.high)


def _constants(model: m.Model) -> dict[str, Value]:
    """The values of `env` constants."""
    declared = (h.declaration for h in model.heads if isinstance(h, m.Env))
    found = {d.name: d.initial for each in declared for d in each.declarators}
    return {
        name: value
        for name, initial in found.items()
        if initial is not None
        and not isinstance(initial, m.ArrayInitializer)
        and (value := constant(initial)) is not None
    }


@dataclass(slots=True)
class DataFlow:
    """Where a value of a type goes: variables by class and name, and methods that return it.

    `cuts` are the constants that it is compared with, also as `settled` variables. It is no more
    `is_exact` once something else is done with it than to copy and to compare it so.
    """

    type: str
    constants: Mapping[str, Value]
    settled: Constants
    variables: set[Variable]
    methods: set[tuple[str, str]] = field(default_factory=set)
    cuts: set[Value] = field(default_factory=set)
    is_exact: bool = True

    def follow(self, model: m.Model, properties: Properties) -> None:
        """Takes note of all places that the value gets to in a model, and of who looks at them."""
        classes = [c for c in model.classes if isinstance(c, m.ReactiveClass)]
        owners = {r.name: r.type.name for r in (model.main.rebecs if model.main else ())}
        self.is_exact &= not any(c.extends for c in classes)
        before = -1
        while before != len(self.variables) + len(self.methods):
            before = len(self.variables) + len(self.methods)
            for owner in classes:
                for member in owner.members:
                    if isinstance(member, _BODIES) and member.body is not None:
                        scope = Scope.of(owner, member)
                        _FlowThroughBody(self, classes, owners, scope).visit(member.body)
            outside = _FlowThroughBody(self, classes, owners, Scope(_PROPERTIES))
            for define in properties.defines:
                for expression in state_expressions(define.value):
                    if outside.visit(expression):
                        self.variables.add((_PROPERTIES, define.name))
            for each in properties.all:
                for expression in state_expressions(each.formula):
                    outside.visit(expression)


@dataclass(frozen=True, slots=True)
class _FlowThroughBody:
    """Follows the value through one body."""

    flow: DataFlow
    classes: Collection[m.ReactiveClass]
    owners: Mapping[str, str]  # the classes of the rebecs
    scope: Scope

    def visit(self, node: m.Node) -> bool:
        """Goes through a part of the body; whether it is the value, or may be."""
        match node:
            case m.Name(name):
                return self.scope.variable(name) in self.flow.variables
            case m.Member(m.Self(), name):
                return (self.scope.owner, name) in self.flow.variables
            case m.Member(m.Name(rebec), name) if self.scope.owner == _PROPERTIES:
                return (self.owners.get(rebec, ""), name) in self.flow.variables
            case m.Binary(operator, left, right):
                return self._binary(operator, left, right)
            case m.Assign(operator, target, value):
                return self._assign(operator, target, value)
            case m.Declarator(name, initial) if initial is not None:
                return self.visit(initial) and self._flows_to(self.scope.variable(name))
            case m.Call():
                return self._call(node)
            case m.Return(value) if value is not None:
                if self.visit(value):
                    self.flow.methods.add((self.scope.owner, self.scope.body))
                return False
            case m.Conditional(condition, then, otherwise):
                self._tested(condition)
                return self._any((then, otherwise))
            case m.Index(target, index):
                self._used(index)
                return self.visit(target)
            case m.Switch(subject, cases):
                return self._switch(subject, cases)
            case m.Paren() | m.Choice() | m.Cast():
                found = self._any(m.children(node))
                if isinstance(node, m.Cast) and node.type.name not in _WIDER[self.flow.type]:
                    self._inexact(found)
                return found
            case m.Unary("!", operand):
                return self.visit(operand)
            case m.Unary() | m.Postfix() | m.InstanceOf():
                return self._inexact(self._any(m.children(node)))
            case _:
                for part in m.children(node):
                    self.visit(part)
                return False

    def _any(self, nodes: Iterable[m.Node]) -> bool:
        """Goes through all of some parts; whether any is the value."""
        found = False
        for node in nodes:
            found |= self.visit(node)
        return found

    def _binary(self, operator: str, left: m.Expression, right: m.Expression) -> bool:
        ours, theirs = self.visit(left), self.visit(right)
        if operator in _LOGIC:
            return False
        if operator not in _COMPARISONS:
            return self._inexact(ours or theirs)
        if ours or theirs:
            flow, other = self.flow, right if ours else left
            values = possible_constants(other, self.scope, flow.settled, flow.constants)
            if values is not None and ours != theirs:
                flow.cuts |= values
            else:
                self._inexact(True)
        return False

    def _assign(self, operator: str, target: m.Expression, value: m.Expression) -> bool:
        found = self.visit(value)
        if operator != "=":
            found = self._inexact(self.visit(target) or found)
        while isinstance(target, m.Index):
            self._used(target.index)
            target = target.target
        match target:
            case m.Name(name) if found:
                self._flows_to(self.scope.variable(name))
            case m.Member(_, name) if found:
                self._flows_to((self.scope.owner, name))
            case _:
                pass
        return found

    def _call(self, call: m.Call) -> bool:
        given = [self.visit(argument) for argument in call.arguments]
        for time in (call.after, call.deadline):
            if time is not None:
                self._used(time)
        own = call.target is None or isinstance(call.target, m.Self)
        known = False
        for owner in self.classes:
            for member in owner.members if not own or owner.name == self.scope.owner else ():
                if isinstance(member, m.MessageServer | m.Method) and member.name == call.name:
                    known = True
                    for taken, found in zip(member.parameters, given, strict=False):
                        if found:
                            self._flows_to(Scope.of(owner, member).variable(taken.name))
        if not known:
            self._inexact(any(given))
        return (self.scope.owner, call.name) in self.flow.methods

    def _switch(self, subject: m.Expression, cases: Iterable[m.Case]) -> bool:
        found = self.visit(subject)
        for case in cases:
            value = constant(case.value) if case.value is not None else None
            if found and value is not None:
                self.flow.cuts.add(value)
            for statement in case.statements:
                self.visit(statement)
        return False

    def _tested(self, condition: m.Expression) -> None:
        self._inexact(self.visit(condition))

    def _used(self, expression: m.Expression) -> None:
        self._inexact(self.visit(expression))

    def _inexact(self, found: bool) -> bool:
        if found:
            self.flow.is_exact = False
        return found

    def _flows_to(self, variable: Variable) -> bool:
        self.flow.variables.add(variable)
        return True
