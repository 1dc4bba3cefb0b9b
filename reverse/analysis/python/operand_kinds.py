"""Of which types the operands of a function of Python are, where it is known what was tested.

By what the program stores (`inferred_types.py`), and by what was tested or stored on the way.
Attributes are told apart by names, and by their class where a function asks its own object.
"""

from __future__ import annotations

from collections import Counter, OrderedDict, defaultdict, deque
from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import TypeAlias

from rebsync.reverse.analysis.facts import Facts, Holds, IsBound, IsOf
from rebsync.reverse.analysis.held_values import is_of_other
from rebsync.reverse.analysis.origins import ANYTHING, ClassOrigin, LibraryOrigin
from rebsync.reverse.analysis.problems import ProblemNotes
from rebsync.reverse.analysis.python.inferred_types import computed
from rebsync.reverse.analysis.python.value_types import (
    A_NUMBER,
    ANY_TYPE,
    NO_TYPES,
    ContainerType,
    InstanceType,
    LibraryType,
    OwnType,
    ValueType,
    ValueTypes,
    at_index,
    of_declared,
    own_type,
    union,
)
from rebsync.reverse.analysis.stores import Member, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import COMPARISONS
from rebsync.reverse.ir.program import FunctionKind
from rebsync.reverse.ir.walk import walk

ATTRIBUTES: Mapping[OwnType | None, frozenset[str]] = {
    OwnType.NUMBER: frozenset(dir(int)) | frozenset(dir(float)),
    OwnType.TEXT: frozenset(dir(str)),
    OwnType.BYTES: frozenset(dir(bytes)),
    OwnType.LIST: frozenset(dir(list)),
    OwnType.TUPLE: frozenset(dir(tuple)),
    OwnType.SET: frozenset(dir(set)),
    OwnType.FROZEN: frozenset(dir(frozenset)),
    OwnType.MAPPING: frozenset({"has_key", "iteritems", "iterkeys", "itervalues"}).union(
        *map(dir, (dict, defaultdict, OrderedDict, Counter))
    ),
    OwnType.QUEUE: frozenset(dir(deque)),
    OwnType.MODEL_ARRAY: frozenset(dir(object)) | {"at"},
}
_ASKING = frozenset(f"builtins.{n}" for n in ("isinstance", "type", "hasattr", "callable"))
_FIRST = frozenset({FunctionKind.CONSTRUCTOR, FunctionKind.CLASS, FunctionKind.MODULE})
_CLASSES = dict.fromkeys(("int", "float", "bool"), "number")
Kinds: TypeAlias = "frozenset[OwnType | None]"


class OperandKinds:
    """The values of one function."""

    def __init__(self, notes: ProblemNotes) -> None:
        self._notes = notes
        self._graph = notes.origins.graph
        self._name = notes.function.name
        self._types = notes.counts.rules.types

    def of(self, value: e.Expression, facts: Facts) -> Kinds:
        """The types of Python's own of what a value may be; None is looked for apart."""
        return frozenset(map(own_type, self.types(value, facts)))

    def types(self, value: e.Expression, facts: Facts) -> ValueTypes:
        """The types of what a value may be where some facts are known."""
        known = [fact.types for fact in facts if isinstance(fact, IsOf) and fact.value == value]
        if isinstance(value, e.Local) and value.name in self._notes.function.captured:
            known = []  # functions within store there as well
        key = key_of(value, self._name)
        if key is None:  # what stands in a container may have been changed under another name
            known = [k for k in known if not any(isinstance(each, ContainerType) for each in k)]
        if known:
            told = sorted((types for types in known if None not in types), key=len)
            types = told[0] if told else self._declared(value) or ANY_TYPE
            return types if key is None else self._types.with_puts(key, types)
        if declared := self._declared(value):
            return declared
        match value:
            case e.Conditional(_, one, other) | e.And(one, other) | e.Or(one, other):
                return self.types(one, facts) | self.types(other, facts)
            case e.Binary(operator) if operator in COMPARISONS:
                return A_NUMBER
            case e.Binary(operator, left, right):
                as_operands = self._types.attributes.operands
                given = (as_operands(self.types(each, facts)) for each in (left, right))
                return computed(operator, *given)
            case e.Index(of, index) if not isinstance(index, e.Slice):
                at = index.value if isinstance(index, e.Literal) else None
                return at_index(self.types(of, facts), at)
            case e.Attribute():
                return self._attribute(value, facts)
            case e.Local() | e.Captured() | e.Global():
                return self._named(value, facts)
            case _:
                return self._types.of(value, self._name)

    def of_classes(self, classes: Iterable[e.Expression | e.Spread]) -> ValueTypes:
        """The types of objects of some classes."""
        found = NO_TYPES
        for value in classes:
            held = ANYTHING
            if not isinstance(value, e.Spread):
                held = self._notes.origins.of(value, self._name)
            for origin in held:
                match origin:
                    case ClassOrigin(name, False):
                        found |= {InstanceType(name)}
                    case LibraryOrigin(name, False):
                        plain = name.removeprefix("builtins.")
                        found |= self._types.attributes.of_class(_CLASSES.get(plain, plain))
                    case _:
                        found |= ANY_TYPE
        return found

    def asked(self, value: e.Expression, facts: Facts) -> Kinds:
        """The types of Python's own that an operator or a text must take; None for any other.

        Objects of classes answer for themselves, and times are told apart from numbers elsewhere.
        """
        types = self.types(value, facts)
        kinds = frozenset(own_type(type_) for type_ in types if not _answers(type_))
        return kinds - {None} if self._notes.table.trusts_types else kinds

    def known(self, types: ValueTypes) -> ValueTypes:
        """Types without any type, where values of no known type are trusted."""
        return types - {None} if self._notes.table.trusts_types else types

    def is_object(self, value: e.Expression, facts: Facts) -> bool:
        """Whether a value may be a library's object, which is no number and has no elements."""
        return any(isinstance(type_, LibraryType) for type_ in self.types(value, facts))

    def given(self, call: s.Call) -> ValueTypes:
        """The types of what a call of the function gives."""
        return self._types.of_call(call, self._name)

    def mapped(self, function: e.Expression) -> ValueTypes:
        """The types of what a function gives that another calls for each element."""
        return self._types.mapped(function, self._name)

    def is_whole(self, value: e.Expression) -> bool:
        """Whether a value is declared as a whole number, or is a parameter that only gets such."""
        constants = self._types.constants(key_of(value, self._name))
        types = self._types.attributes.declared(value, self._name)
        is_declared = bool(types) and all(isinstance(x, t.Integer | t.Truth) for x in types)
        return is_declared or (bool(constants) and all(isinstance(x, int) for x in constants))

    def length(self, value: e.Expression) -> int:
        """How many elements an array of generated code has, none of them asked for from its end."""
        types = self._types.attributes.declared(value, self._name)
        return min((each.length if isinstance(each, t.Array) else 0 for each in types), default=0)

    def _declared(self, value: e.Expression) -> ValueTypes:
        """The types that parameters, attributes and their elements are declared with."""
        return union(map(of_declared, self._types.attributes.declared(value, self._name)))

    def _attribute(self, value: e.Attribute, facts: Facts) -> ValueTypes:
        """The types of an attribute, by its object's class and what is stored under its name."""
        if self._types.attributes.has_own(value.object, self._name):
            key, here = Member(value.name), self._notes.function
            stored = [each for each, _ in self._graph.stores.of(key)]
            others = {n for n in stored if is_of_other(self._graph, here, value, key, n)}
            if others or Holds(value) in facts or IsBound(value) in facts:
                return self._named(value, facts)
        types = self.types(value.object, facts)
        return self._types.attributes.of(types, value.object, value.name, self._name)

    def _named(self, value: e.Expression, facts: Facts) -> ValueTypes:
        """The types of what is stored under a name, where some facts are known of it."""
        key = key_of(value, self._name)
        if isinstance(value, e.Local) and value.name in self._tested:
            return ANY_TYPE
        if key is None or self._types.attributes.receiver(value, self._name):
            return self._types.of(value, self._name)
        found = self._types.sources(key)
        if isinstance(key, Member):
            here = self._notes.function
            found = [s for s in found if not is_of_other(self._graph, here, value, key, s[0])]
        if Holds(value) in facts and found:
            found = [s for s in found if not _is_nothing(s[1])]
            if not found and not self._types.parameter(key):
                return NO_TYPES  # this place is never reached
        if isinstance(key, Member) and IsBound(value) in facts:
            # What makes objects ran before this function stored something there.
            kinds = {n: self._graph.program.function(n).kind for n, _ in found}
            kinds.pop(self._name, None)
            found = [s for s in found if kinds.get(s[0]) not in _FIRST]
        types = union(map(self._types.of_stored, found)) | self._types.parameter(key)
        return self._types.with_puts(key, types if found else types or ANY_TYPE)

    @cached_property
    def _tested(self) -> frozenset[str]:
        """The variables of whose types the function itself asks something: they may be of any."""
        return frozenset(
            argument.value.name
            for node in walk(self._notes.function)
            if isinstance(node, s.Call) and isinstance(node.callee, s.LibraryCallee)
            for argument in node.arguments[:1]
            if node.callee.name in _ASKING and isinstance(argument.value, e.Local)
        )


def _answers(type_: ValueType | None) -> bool:
    """Whether objects of a type have operators of their own."""
    return isinstance(type_, InstanceType | LibraryType)


def _is_nothing(value: object) -> bool:
    """Whether a stored value counts as false; containers may be filled later."""
    return isinstance(value, e.Literal) and not value.value
