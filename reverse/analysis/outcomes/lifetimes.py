"""Whether what is deleted, or given to an owner, is an object of `new` that has not ended yet.

Locals are followed by facts. A member or a variable of a file has to be stored in behind each
`delete` of it (`left_dangling`). All that is stored in either has to be new.
"""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.reverse.analysis.ended_objects import ended_by
from rebsync.reverse.analysis.facts import Facts, IsBound, bare
from rebsync.reverse.analysis.problems import NOTHING_THERE, ProblemNotes
from rebsync.reverse.analysis.python.call_binding import bound
from rebsync.reverse.analysis.stores import AnyValue, CallResult, ObjectValue, Stored, Value, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.program import FunctionKind
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.libraries.outcome_classes import TERMINATES

_DEEPEST = 4  # of variables that are stored in others, and functions that give them


class Lifetimes:
    """Of objects that one function ends."""

    def __init__(self, notes: ProblemNotes) -> None:
        self._notes = notes
        self._origins = notes.origins
        self._program = notes.origins.graph.program

    def check(self, node: s.Statement | e.Expression, facts: Facts) -> None:
        """Notes an object that may not be there any more, or never is one's own, and ends."""
        is_array = _of_array(node)
        if not all(self._lives(bare(of), is_array, facts) for of in ended_by(node)):
            self._notes.problem(node, NOTHING_THERE, TERMINATES)

    def _lives(self, pointer: e.Expression, is_array: bool | None, facts: Facts) -> bool:
        function = self._notes.function
        if isinstance(pointer, e.Local):
            is_element = self._is_element(pointer)
            if is_element and function.kind is FunctionKind.DESTRUCTOR:
                return True
            lives = IsBound(pointer) in facts
        else:
            key = key_of(pointer, function.name)
            dangling = self._origins.of_cpp.left_dangling
            lives = isinstance(pointer, e.Temporary) or key not in dangling
        return lives and self._is_new(pointer, function.name, is_array, 0)

    def _is_element(self, pointer: e.Local) -> bool:
        """Whether it is what a loop goes through: its container gives each once."""
        loops = (n for n in walk(self._notes.function) if isinstance(n, s.ForEach))
        return any(loop.target == pointer for loop in loops)

    def _is_new(self, value: Value, function: str, is_array: bool | None, depth: int) -> bool:
        """Whether a value is null, or what `new` made: in this form, as one or as an array."""
        match value:
            case e.Literal(None) | ObjectValue():
                return True
            case CallResult(s.Call(_, s.FunctionCallee(name))) if depth <= _DEEPEST:
                given = (n for n in walk(self._program.function(name)) if isinstance(n, s.Return))
                return all(
                    n.value is not None and self._is_new(n.value, name, is_array, depth + 1)
                    for n in given
                )
            case CallResult(s.Call(_, s.LibraryCallee(name))):
                is_right = is_array is None or is_array == (name == "new[]")
                return name.endswith("::release") or (name.startswith("new") and is_right)
            case e.Convert(_, of) | e.Copy(of) | e.Move(of):
                return self._is_new(of, function, is_array, depth)
            case e.Conditional(_, then, otherwise):
                ways = then, otherwise
                return all(self._is_new(way, function, is_array, depth) for way in ways)
            case e.Local(name) if name in self._parameters(function):
                return self._is_given_new(name, function, is_array, depth)
            case e.Captured() | e.Global() | e.Attribute() if depth:
                return False  # it has two names
            case e.Attribute(of) if self._is_copied(of):
                return False
            case e.Temporary() | e.Local() | e.Captured() | e.Global() | e.Attribute():
                stored = self._stored(value, function) if depth <= _DEEPEST else []
                return bool(stored) and all(
                    self._is_new(each, around, is_array, depth + 1) for around, each in stored
                )
            case _:
                return False

    def _stored(self, value: e.Expression, function: str) -> list[Stored]:
        """What is stored in a variable, but for what libraries do that get its address."""
        key, kept = key_of(value, function), list[Stored]()
        stored = [] if key is None else self._origins.graph.stores.of(key)
        handed = {
            around: sum(key_of(of, around) == key for of in self._handed(around))
            for around in {around for around, _ in stored}
        }
        for around, each in stored:
            if isinstance(each, AnyValue) and handed[around]:
                handed[around] -= 1
            else:
                kept.append((around, each))
        return kept

    def _handed(self, function: str) -> Iterator[e.Expression]:
        """What a function hands to libraries of others by its address, or what is not read."""
        nodes = list(walk(self._program.function(function)))
        stores = (n for n in nodes if isinstance(n, s.Assign))
        kept: dict[e.Expression, e.Expression] = {n.target: n.value for n in stores}
        for node in nodes:
            match node:
                case s.Call(_, s.LibraryCallee(name), arguments) if not name.startswith("std::"):
                    values = (kept.get(a.value, a.value) for a in arguments)
                    yield from (v.target for v in values if isinstance(v, e.AddressOf))
                case s.Unsupported(writes=writes):  # which may do anything, where it stands
                    yield from writes
                case _:
                    pass

    def _is_copied(self, value: e.Expression) -> bool:
        """Whether objects of a class are copied with the pointers that they have."""
        type_ = getattr(value, "type", t.UNKNOWN)
        type_ = type_.to if isinstance(type_, t.Reference) else type_
        return isinstance(type_, t.Record) and type_.name in self._origins.of_cpp.copied_classes

    def _parameters(self, function: str) -> set[str]:
        return {p.name for p in self._program.function(function).parameters}

    def _is_given_new(
        self, parameter: str, function: str, is_array: bool | None, depth: int
    ) -> bool:
        """Whether all calls of a function give something new for a parameter."""
        calls = self._origins.of_cpp.calls.get(function)
        if calls is None or depth > _DEEPEST:
            return False
        called = self._program.function(function)
        values = ((around, bound(call, called).get(parameter)) for around, call in calls)
        return all(
            value is not None and self._is_new(value, around, is_array, depth + 1)
            for around, value in values
        )


def _of_array(node: s.Statement | e.Expression) -> bool | None:
    """Whether a node deletes an array, or one object; None if it does neither."""
    match node:
        case s.Destroy():
            return False
        case s.Call(_, s.LibraryCallee("delete[]")):
            return True
        case _:
            return None
