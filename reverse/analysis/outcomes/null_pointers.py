"""Which pointers of C++ may be null, optionals empty, iterators the end: null-dereference analysis.

A local leads to something by all that is stored in it, or by what was tested. A member or variable
of a file does where its constructors, or `main`, store something before other code runs (definite
assignment), and nothing else empties it.
"""

from __future__ import annotations

from rebsync.reverse.analysis.facts import NO_FACTS, Facts, Holds, IsThere, names_of, tested
from rebsync.reverse.analysis.held_values import all_held, is_of_other
from rebsync.reverse.analysis.outcomes.element_bounds import ElementBounds
from rebsync.reverse.analysis.outcomes.member_assignment import MemberAssignment, bare, last_name
from rebsync.reverse.analysis.problems import ParameterNeed, ProblemNotes
from rebsync.reverse.analysis.python.call_binding import bound
from rebsync.reverse.analysis.stores import (
    AnyValue,
    CallResult,
    Stored,
    key_of,
)
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import Conversion
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.libraries.size_effects import (
    LEADING_ON,
    LEADING_TO_FIRST,
    MAKING,
    SEARCHING,
)

_DEEPEST = 4  # of variables that are stored in others
_NULL = e.Literal(None)


class NullPointers:
    """Pointers, optionals and iterators in one function."""

    def __init__(self, notes: ProblemNotes, bounds: ElementBounds) -> None:
        self._notes = notes
        self._bounds = bounds
        self._origins = notes.origins
        self._program = notes.origins.graph.program

    def may_be(self, value: e.Expression, facts: Facts) -> bool:
        """Whether a pointer, or what is handed over by its address, may lead to nothing."""
        value = value.target if isinstance(value, e.AddressOf) else value
        return self._may_be(value, self._name, facts, 0)

    def given(self, value: e.Expression, facts: Facts) -> ParameterNeed | None:
        """That it is up to those who call the function whether a pointer leads to something."""
        value = value.target if isinstance(value, e.AddressOf) else value
        if not _may_be_null(_type_of(value)):
            return None
        value = bare(value)
        if not (isinstance(value, e.Local) and self._notes.is_parameter(value)):
            return None
        is_known = any(Holds(name) in facts for name in names_of(facts, value))
        return None if is_known else ParameterNeed(self._name, value.name)

    def gives(self, call: s.Call) -> bool:
        """Whether a call gives a new object, or another pointer that is not null."""
        name = last_name(call).partition(" ")[0]
        leads = _leads(_type_of(call.target)) and not isinstance(call.callee, s.ValueCallee)
        stored = self._name, CallResult(call)
        return name in MAKING or (leads and not self._is_nothing(stored, t.UNKNOWN, NO_FACTS, 0))

    @property
    def _assignment(self) -> MemberAssignment:
        """Made each time: kept here, neither would be freed without a collection."""
        return MemberAssignment(
            self._origins, lambda each, depth: self._is_nothing(each, t.UNKNOWN, NO_FACTS, depth)
        )

    @property
    def _name(self) -> str:
        return self._notes.function.name

    def _may_be(self, value: e.Expression, function: str, facts: Facts, depth: int) -> bool:
        type_ = _type_of(value)
        if isinstance(type_, t.Reference) and not _may_be_null(type_):
            return False
        if any(Holds(name) in facts for name in names_of(facts, value)):
            return False
        match value:
            case e.Literal(None):
                return True
            case e.Convert(Conversion.CAST, operand, _, True) if _leads(_type_of(operand)):
                return True  # a dynamic cast
            case e.Convert(_, operand) | e.Copy(operand) | e.Move(operand):
                return self._may_be(operand, function, facts, depth)
            case e.Conditional(test, then, otherwise):
                ways = (then, tested(facts, test, True)), (otherwise, tested(facts, test, False))
                return any(self._may_be(way, function, known, depth) for way, known in ways)
            case e.Local() | e.Temporary() | e.Captured() | e.Global() | e.Attribute():
                return self._may_hold_nothing(value, function, facts, depth)
            case e.Index(of, checked=False) if _is_mapping(of):
                return _leads(type_)  # a new element is null
            case e.Index() | e.Dereference():
                return _is_plain(type_)
            case _:
                return False

    def _may_hold_nothing(
        self, value: e.Expression, function: str, facts: Facts, depth: int
    ) -> bool:
        """Whether a variable may hold nothing by what is stored in it."""
        type_ = _type_of(value)
        around = self._program.function(function)
        stored, key = all_held(self._origins, value, function), key_of(value, function)
        if isinstance(value, e.Local) and value.name in {p.name for p in around.parameters}:
            return _is_plain(type_) and self._may_get_nothing(value.name, function, depth)
        if not stored or key is None or depth > _DEEPEST:
            return _is_plain(type_)
        stored += [(f, _NULL) for f in self._origins.of_cpp.emptied.get(key, ())]
        known = facts if isinstance(value, e.Temporary) else NO_FACTS
        nothing = [
            each
            for each in stored
            if not is_of_other(self._origins.graph, around, value, key, each[0])
            and self._is_nothing(each, type_, known, depth + 1)
        ]
        if not nothing:
            return False
        known_of = self._notes.counts.unset
        asked = key, frozenset(f for f, _ in nothing), self._assignment.is_end(value, around)
        if asked not in known_of:
            known_of[asked] = self._assignment.unset_in(*asked, depth)
        unset = known_of[asked]
        may_be_unset = unset is None or (function in unset and IsThere(value) not in facts)
        return may_be_unset and not self._assignment.is_kept_by(
            value, key, function, asked[1], depth
        )

    def _may_get_nothing(self, parameter: str, function: str, depth: int) -> bool:
        """Whether a function may get nothing for a pointer: `given` says so of its own ones."""
        calls = self._origins.of_cpp.calls.get(function)
        if calls is None or depth > _DEEPEST:
            return True
        if function == self._name and not depth:
            return False
        called = self._program.function(function)
        values = ((around, bound(call, called).get(parameter)) for around, call in calls)
        return any(
            value is None or self._may_be(value, around, NO_FACTS, depth + 1)
            for around, value in values
        )

    def _is_nothing(self, stored: Stored, type_: t.Type, facts: Facts, depth: int) -> bool:
        function, value = stored
        match value:
            case AnyValue():
                return _is_plain(type_)
            case CallResult(s.Call(_, s.FunctionCallee(name))):
                return any(map(_returns_nothing, walk(self._program.function(name))))
            case CallResult(call):
                return self._gives_nothing(call, function, facts, depth)
            case _:
                if not isinstance(value, e.Expression):
                    return False
                return self._may_be(value, function, facts, depth)

    def _gives_nothing(self, call: s.Call, function: str, facts: Facts, depth: int) -> bool:
        """Whether a function of a library may find nothing, or lead to the first of no elements."""
        name = last_name(call)
        of = getattr(call.callee, "receiver", None)
        first = next((a.value for a in call.arguments), of) if of is None else of
        if name in SEARCHING or first is None:
            return name in SEARCHING
        first = first.target if isinstance(first, e.AddressOf) else first
        if name in LEADING_ON:
            first = call.arguments[0].value if call.arguments else first
            return self._may_be(first, function, facts, depth)
        return name in LEADING_TO_FIRST and not self._bounds.size(first, facts)


def _returns_nothing(node: object) -> bool:
    """Whether a statement gives null, or an optional without a value, as it is written."""
    return (
        isinstance(node, s.Return)
        and node.value is not None
        and any(isinstance(n, e.Literal) and n.value is None for n in walk(node.value))
    )


def _may_be_null(type_: t.Type) -> bool:
    if not isinstance(type_, t.Reference):
        return False
    return type_.may_be_null or bool(type_.ownership.value)


def _type_of(value: e.Expression | None) -> t.Type:
    type_: t.Type = getattr(value, "type", t.UNKNOWN)
    return type_


def _is_mapping(container: e.Expression) -> bool:
    type_ = _type_of(container)
    return isinstance(type_, t.Container) and type_.kind is t.ContainerKind.MAPPING


def _leads(type_: t.Type) -> bool:
    """Whether what is of a type leads to something, or to nothing."""
    return isinstance(type_, t.Optional | t.Reference)


def _is_plain(type_: t.Type) -> bool:
    """Whether what is of a type may lead to nothing, whoever gives it: no object that is shared."""
    is_owned = isinstance(type_, t.Reference) and bool(type_.ownership.value)
    return _leads(type_) and not is_owned
