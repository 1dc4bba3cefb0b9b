"""Of which of Python's own types values may be, by what the program stores: a type analysis.

What comes from elsewhere is not known, and is trusted to fit. Attributes are told apart by names,
and by their class where a function asks its own object.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Mapping
from typing import TypeAlias

from rebsync.reverse.analysis.facts import Facts, Holds, IsBound, IsOf, OwnType
from rebsync.reverse.analysis.held_values import is_of_other, is_own
from rebsync.reverse.analysis.origins import ClassOrigin
from rebsync.reverse.analysis.problems import ProblemNotes
from rebsync.reverse.analysis.stores import (
    AnyValue,
    CallResult,
    ClassValue,
    Key,
    Member,
    ObjectValue,
    Stored,
    key_of,
)
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import COMPARISONS, Operator
from rebsync.reverse.ir.program import Function, FunctionKind
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.libraries.outcome_classes import ENUMERATIONS

_CONTAINERS = {
    t.ContainerKind.SEQUENCE: OwnType.LIST,
    t.ContainerKind.TUPLE: OwnType.TUPLE,
    t.ContainerKind.QUEUE: OwnType.QUEUE,
    t.ContainerKind.SET: OwnType.SET,
    t.ContainerKind.MAPPING: OwnType.MAPPING,
}
_BY_NAME = {kind.value: kind for kind in OwnType if kind is not OwnType.ARRAY}
ATTRIBUTES: Mapping[OwnType, frozenset[str]] = {
    OwnType.NUMBER: frozenset(dir(int)) | frozenset(dir(float)),
    OwnType.TEXT: frozenset(dir(str)),
    OwnType.LIST: frozenset(dir(list)),
    OwnType.TUPLE: frozenset(dir(tuple)),
    OwnType.SET: frozenset(dir(set)),
    OwnType.MAPPING: frozenset(dir(dict)) | {"has_key", "iteritems", "iterkeys", "itervalues"},
    OwnType.QUEUE: frozenset(dir(deque)),
    OwnType.ARRAY: frozenset(dir(object)) | {"at"},
}
_FIRST = frozenset({FunctionKind.CONSTRUCTOR, FunctionKind.CLASS, FunctionKind.MODULE})
_ADDED = frozenset({OwnType.TEXT, OwnType.LIST, OwnType.TUPLE, OwnType.QUEUE})
_IN_TEXTS = frozenset(
    {OwnType.NUMBER, OwnType.TEXT, OwnType.LIST, OwnType.TUPLE, OwnType.MAPPING, None}
)
_DEEPEST = 12
UNKNOWN = None  # in a set of kinds: a value that may be of any type
Kinds: TypeAlias = "frozenset[OwnType | None]"
_ANY: Kinds = frozenset({UNKNOWN})
_A_NUMBER: Kinds = frozenset({OwnType.NUMBER})


class OperandKinds:
    """The values of one function."""

    def __init__(self, notes: ProblemNotes) -> None:
        self._notes = notes
        self._graph = notes.origins.graph
        self._name = notes.function.name

    def of(self, value: e.Expression, facts: Facts) -> Kinds:
        """The types of what a value may be where some facts are known; None is looked for apart."""
        known = [fact.types for fact in facts if isinstance(fact, IsOf) and fact.value == value]
        if known:  # what a test says is not told apart, and is any type
            return known[0] if _ANY not in known else self._declared(value, self._name) or _ANY
        if declared := self._declared(value, self._name):
            return declared
        key = key_of(value, self._name)
        if key is None or isinstance(value, e.Temporary):
            return self._of(value, self._name, frozenset())
        if isinstance(value, e.Attribute) and not self._has_own(value.object, self._name):
            return _ANY
        found = list(self._stored(key))
        if isinstance(key, Member):
            here = self._notes.function
            found = [s for s in found if not is_of_other(self._graph, here, value, key, s[0])]
        if Holds(value) in facts:
            found = [s for s in found if not _is_nothing(s[1])]
        if isinstance(key, Member) and IsBound(value) in facts:
            # What makes objects ran before this function stored something there.
            kinds = {n: self._graph.program.function(n).kind for n, _ in found}
            found = [s for s in found if kinds[s[0]] not in _FIRST]
        return self._union(found, frozenset({key}))

    def _declared(self, value: e.Expression, function: str) -> Kinds:
        """The types that parameters, attributes and their elements are declared with."""
        types = self._declared_types(value, self._graph.program.function(function))
        return frozenset(kind for each in types if (kind := _of_type(each)) is not None)

    def _declared_types(self, value: e.Expression, around: Function) -> list[t.Type]:
        program = self._graph.program
        match value:
            case e.Local(name):
                return [p.type for p in around.parameters if p.name == name]
            case e.Attribute(e.Local(of), name) if of == around.receiver and around.owner:
                classes = map(program.classes.get, self._graph.family(around.owner))
                fields = (f for c in classes if c is not None for f in c.fields)
                return [f.type for f in fields if f.name == name]
            case e.Index(of, index) if not isinstance(index, e.Slice):
                arrays = self._declared_types(of, around)
                return [a.element for a in arrays if isinstance(a, t.Array)]
            case _:
                return []

    def may_be_plain(self, value: e.Expression, facts: Facts) -> bool:
        """Whether a value may be made of numbers, texts, lists and mappings alone."""
        match value:
            case e.Build(t.Container(t.ContainerKind.SEQUENCE | t.ContainerKind.TUPLE), parts):
                within = [p.operand if isinstance(p, e.Spread) else p for p in parts]
                return all(self.may_be_plain(p, facts) for p in within)
            case e.BuildMapping(_, entries):
                pairs = (entry for entry in entries if not isinstance(entry, e.Spread))
                return all(self.may_be_plain(part, facts) for pair in pairs for part in pair)
            case e.Conditional(_, one, other):
                return self.may_be_plain(one, facts) and self.may_be_plain(other, facts)
        held = self._notes.origins.of(value, self._name)
        is_object = any(isinstance(o, ClassOrigin) and o.of_object for o in held)
        return not is_object and self.of(value, facts) <= _IN_TEXTS

    def is_whole(self, value: e.Expression) -> bool:
        """Whether a value is declared as a whole number."""
        types = self._declared_types(value, self._graph.program.function(self._name))
        return bool(types) and all(isinstance(each, t.Integer | t.Truth) for each in types)

    def _has_own(self, of: e.Expression, function: str) -> bool:
        """Whether attributes of an object have what the program stores, as it is."""
        origins = self._notes.origins
        if not is_own(origins, of, function):
            return False
        classes = (o.name for o in origins.of(of, function) if isinstance(o, ClassOrigin))
        # Of an enumeration they are its members, which have that as their values.
        return all(ENUMERATIONS.isdisjoint(self._graph.bases(name)) for name in classes)

    def _stored(self, key: Key) -> Iterator[Stored]:
        """What is stored under a name, with what operators compute there."""
        yield from self._graph.stores.initial(key)
        yield from self._graph.stores.changed(key)

    def _union(self, stored: list[Stored], seen: frozenset[Key]) -> Kinds:
        if not stored or len(seen) > _DEEPEST:
            return _ANY
        return frozenset[OwnType | None]().union(*(self._of_stored(each, seen) for each in stored))

    def _of_stored(self, stored: Stored, seen: frozenset[Key]) -> Kinds:
        function, value = stored
        match value:
            case CallResult(call):
                return self._given(call, function, seen)
            case AnyValue() | ClassValue() | ObjectValue():
                return _ANY
            case _:
                return self._of(value, function, seen)

    def _of(self, value: e.Expression, function: str, seen: frozenset[Key]) -> Kinds:
        return self._declared(value, function) or self._known(value, function, seen)

    def _known(self, value: e.Expression, function: str, seen: frozenset[Key]) -> Kinds:
        match value:
            case e.Literal(None):
                return frozenset()
            case e.Literal(int() | float()) | e.Unary(Operator.NOT):
                return _A_NUMBER
            case e.Literal(str()) | e.Format():
                return frozenset({OwnType.TEXT})
            case e.Build(t.Container(kind)) | e.BuildMapping(t.Container(kind)):
                return frozenset({_CONTAINERS[kind]})
            case e.Conditional(_, one, other) | e.And(one, other) | e.Or(one, other):
                return self._of(one, function, seen) | self._of(other, function, seen)
            case e.Binary(operator) if operator in COMPARISONS:
                return _A_NUMBER
            case e.Binary(operator, left, right):
                both = self._of(left, function, seen), self._of(right, function, seen)
                return _computed(operator, *both)
            case e.Unary(_, of):
                return _A_NUMBER if self._of(of, function, seen) == _A_NUMBER else _ANY
            case e.Attribute(of) if not self._has_own(of, function):
                return _ANY
            case e.Local() | e.Temporary() | e.Captured() | e.Global() | e.Attribute():
                key = key_of(value, function)
                if key is None or key in seen:
                    return _ANY if key is None else frozenset()
                return self._union(list(self._stored(key)), seen | {key})
            case _:
                return _ANY

    def _given(self, call: s.Call, function: str, seen: frozenset[Key]) -> Kinds:
        """The types of what a call gives."""
        match call.callee:
            case s.LibraryCallee(name):
                kind = _BY_NAME.get(self._notes.table.function(name).gives)
                return frozenset({kind})
            case callee:
                around = self._graph.program.function(function)
                targets = self._graph.callee(callee, around)
        if targets.unknown or targets.libraries or not targets.functions:
            return _ANY
        found: Kinds = frozenset()
        for name in targets.functions:
            body = self._graph.program.function(name)
            if body.kind is not FunctionKind.FUNCTION or len(seen) > _DEEPEST:
                return _ANY
            for node in walk(body):
                if isinstance(node, s.Return) and node.value is not None:
                    found |= self._of(node.value, name, seen)
        return found


def _of_type(type_: t.Type) -> OwnType | None:
    """The type of Python's own that a declared one is."""
    match type_:
        case t.Integer() | t.Float() | t.Truth():
            return OwnType.NUMBER
        case t.Text():
            return OwnType.TEXT
        case t.Array():
            return OwnType.ARRAY
        case _:
            return None


def _computed(operator: Operator, left: Kinds, right: Kinds) -> Kinds:
    """The types of what an operator gives for operands of some types."""
    if left == right == _A_NUMBER:
        return _A_NUMBER
    if operator is Operator.ADD and left == right and left <= _ADDED:
        return left
    if operator is Operator.FLOOR_MODULO and left == {OwnType.TEXT}:
        return left
    return _ANY


def _is_nothing(value: object) -> bool:
    """Whether a stored value counts as false."""
    match value:
        case e.Literal(constant):
            return not constant
        case e.Build(_, ()) | e.BuildMapping(_, ()):
            return True
        case _:
            return False
