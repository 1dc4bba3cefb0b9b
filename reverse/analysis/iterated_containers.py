"""Mappings, sets and deques that are changed while they are iterated, which raises in Python."""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.records import dataclass
from rebsync.reverse.analysis.origins import LibraryOrigin, Origin
from rebsync.reverse.analysis.problems import ProblemNotes
from rebsync.reverse.analysis.stores import CallResult, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.libraries.outcome_rules import Size
from rebsync.reverse.libraries.routines import Language

_CHECKED = frozenset(LibraryOrigin(n, True) for n in ("dict", "defaultdict", "set", "deque"))
_PLAIN = frozenset(LibraryOrigin(n, True) for n in ("list", "tuple", "str"))
_COUNTING = frozenset({"builtins.enumerate", "builtins.zip"})
_VIEWS = frozenset({"items", "keys", "values"})
_LAZY = frozenset(
    f"builtins.{n}" for n in ("enumerate", "zip", "iter", "map", "filter", "reversed")
)


@dataclass(frozen=True, slots=True)
class _Iterated:
    """The names of a container, and of a key that it has; one that `is_list` has indices."""

    names: frozenset[e.Expression]
    keys: frozenset[e.Expression]
    is_list: bool


class IteratedContainers:
    """The loops of one function."""

    def __init__(self, notes: ProblemNotes) -> None:
        self._notes = notes
        self._origins = notes.origins
        self._name = notes.function.name

    def is_changed(self, loop: s.ForEach) -> bool:
        """Whether a round may add to what is iterated, or take of it, and another round follows."""
        if self._notes.table.language is not Language.PYTHON:
            return False
        return any(self._changes(loop.body, i, False) for i in self._iterated(loop))

    def _iterated(self, loop: s.ForEach) -> Iterator[_Iterated]:
        """The containers whose elements come one by one; a copy is none of them."""
        waiting = [(loop.iterable, "")]
        while waiting:
            value, view = waiting.pop()
            if not isinstance(value, e.Temporary):
                held = self._origins.of(value, self._name)
                if not held <= _PLAIN:
                    is_list = view in _COUNTING and not held & _CHECKED
                    yield _Iterated(self._names(value), _keys(loop, view), is_list)
                continue
            key = key_of(value, self._name)
            for _, stored in self._origins.graph.stores.of(key) if key is not None else ():
                match stored.call.callee if isinstance(stored, CallResult) else None:
                    case s.MethodCallee(receiver, name) if name in _VIEWS:
                        waiting.append((receiver, view or name))
                    case s.LibraryCallee(name) if name in _LAZY and isinstance(stored, CallResult):
                        waiting += [(a.value, name) for a in stored.call.arguments]
                    case _:
                        pass

    def _names(self, container: e.Expression) -> frozenset[e.Expression]:
        """The names of a container in the function."""
        names = {container}
        for node in walk(self._notes.function):
            match node:
                case s.Assign(target, value) if value == container:
                    names.add(target)
                case s.Assign(target, e.Local() | e.Global() | e.Captured() | e.Attribute() as of):
                    if target == container:
                        names.add(of)
                case _:
                    pass
        return frozenset(names)

    def _changes(self, body: s.Body, of: _Iterated, is_inner: bool) -> bool:
        """Whether a body changes a container and does not leave the loop after that.

        One that `is_inner` is within another loop, which a `break` leaves then.
        """
        if body and _leaves(body, is_inner):
            return False
        return any(
            self._changes_itself(statement, of)
            or any(self._changes(inner, of, is_in) for inner, is_in in _bodies(statement, is_inner))
            for statement in body
        )

    def _changes_itself(self, node: s.Statement, of: _Iterated) -> bool:
        match node:
            case s.Delete(e.Index(container)):
                return container in of.names
            case s.Assign(e.Index(container, index)) | s.CompoundAssign(e.Index(container, index)):
                return container in of.names and index not in of.keys and not of.is_list
            case s.Call():
                return self._calls_change(node, of) or self._adds_by_reading(node, of)
            case s.Yield() | s.Await():
                return any(map(_is_shared, of.names))
            case _:
                return self._adds_by_reading(node, of)

    def _adds_by_reading(self, node: s.Statement, of: _Iterated) -> bool:
        """Whether a key is asked for that a `defaultdict` then adds."""
        held = frozenset[Origin]().union(*(self._origins.of(n, self._name) for n in of.names))
        return LibraryOrigin("defaultdict", True) in held and any(
            isinstance(n, e.Index) and n.object in of.names and n.index not in of.keys
            for n in walk((node,))
        )

    def _calls_change(self, node: s.Call, of: _Iterated) -> bool:
        match node.callee:
            case s.MethodCallee(receiver, name) if receiver in of.names:
                size = self._notes.table.method(self._class_of(receiver), name).size
                is_there = any(a.value in of.keys for a in node.arguments[:1])
                return size is not Size.SAME and not (size is Size.GROWS and is_there)
            case _:
                pass
        targets = self._origins.graph.targets(node, self._notes.function)
        is_passed = any(a.value in of.names for a in node.arguments)
        return any(self._is_changed_in(f, of, is_passed, set()) for f in targets.functions)

    def _class_of(self, container: e.Expression) -> str | None:
        held = [o.name for o in self._origins.of(container, self._name) if o in _CHECKED]
        return held[0] if len(held) == 1 else None

    def _is_changed_in(self, name: str, of: _Iterated, is_passed: bool, seen: set[str]) -> bool:
        """Whether a function that is called changes a container that it shares, or gets."""
        if name in seen:
            return False
        seen.add(name)
        function = self._origins.graph.program.function(name)
        for node in walk(function):
            changed: e.Expression | None = None
            match node:
                case s.Delete(e.Index(other)) | s.Assign(e.Index(other)):
                    changed = other
                case s.CompoundAssign(e.Index(other)):
                    changed = other
                case s.Call(_, s.MethodCallee(receiver, method)) if (
                    self._notes.table.method(None, method).size is not Size.SAME
                ):
                    changed = receiver
                case _:
                    pass
            if changed is not None and (is_passed or self._may_be(changed, of.names)):
                return True
            if isinstance(node, s.Call):
                targets = self._origins.graph.targets(node, function).functions
                if any(self._is_changed_in(t, of, is_passed, seen) for t in targets):
                    return True
        return False

    def _may_be(self, other: e.Expression, names: frozenset[e.Expression]) -> bool:
        """Whether an expression of another function may be the same container."""
        match other:
            case e.Attribute(_, name):
                return any(isinstance(n, e.Attribute) and n.name == name for n in names)
            case e.Captured(function, name):
                locals_ = {n.name for n in names if isinstance(n, e.Local)}
                return other in names or (function == self._name and name in locals_)
            case _:
                return isinstance(other, e.Global) and other in names


def _keys(loop: s.ForEach, view: str) -> frozenset[e.Expression]:
    """The names of the key of a round, which is in the container already."""
    if view not in ("", "keys", "items"):
        return frozenset()
    found: set[e.Expression] = set() if view == "items" else {loop.target}
    for node in walk(loop.body):
        match node:
            case s.Unpack(targets, value) if value == loop.target and view == "items":
                found.add(targets[0])
            case s.Assign(e.Local() as target, value) if value in found:
                found.add(target)
            case _:
                pass
    stored = [getattr(n, "target", None) for n in (loop, *walk(loop.body))]
    return frozenset(key for key in found if isinstance(key, e.Temporary) or stored.count(key) == 1)


def _leaves(body: s.Body, is_inner: bool) -> bool:
    """Whether no round follows once a body has run."""
    is_last = isinstance(body[-1], s.Return) or (isinstance(body[-1], s.Break) and not is_inner)
    return is_last and not any(isinstance(n, s.Continue) for n in walk(body))


def _bodies(node: s.Statement, is_inner: bool) -> Iterator[tuple[s.Body, bool]]:
    """The bodies within a statement, and whether a `break` leaves that statement."""
    match node:
        case s.If(_, then, otherwise):
            yield from ((then, is_inner), (otherwise, is_inner))
        case s.Loop(_, body, prelude, step, otherwise):
            yield from ((b, True) for b in (prelude, body, step, otherwise))
        case s.ForEach(_, _, body, otherwise):
            yield from ((body, True), (otherwise, True))
        case s.Block(body) | s.With(_, _, body):
            yield body, is_inner
        case s.Try(body, handlers, otherwise, final):
            for each in (body, *(h.body for h in handlers), otherwise, final):
                yield each, is_inner
        case s.Switch(_, cases):
            yield from ((case.body, True) for case in cases)
        case s.Unsequenced(parts):
            yield from ((part, is_inner) for part in parts)
        case _:
            pass


def _is_shared(container: e.Expression) -> bool:
    return isinstance(container, e.Global | e.Captured | e.Attribute | e.Index)
