"""Definite assignment of members and of variables of files: what runs before they hold something.

What is stored there first, in constructors or `main`, before other code runs; and callbacks that
only run while something is there, as those of a timer.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from rebsync.reverse.analysis.cpp_facts import emptied_by
from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.analysis.stores import (
    CallResult,
    GlobalVariable,
    Key,
    Member,
    Stored,
    Value,
    key_of,
)
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import Function, FunctionKind
from rebsync.reverse.ir.walk import Node, walk
from rebsync.reverse.libraries.cpp import named, running_callbacks, waiting
from rebsync.reverse.libraries.cpp_calls import first_called
from rebsync.reverse.libraries.routines import ASKING
from rebsync.reverse.libraries.size_effects import BINDING
from rebsync.source import SourceSpan, Span

_DEEPEST = 4  # of functions that call each other
_FIRST = (FunctionKind.CONSTRUCTOR, FunctionKind.MODULE)
_MAIN = "main"
_NULL = e.Literal(None)


class MemberAssignment:
    """Of one program; `is_nothing` says whether what is stored, so deep, leads to nothing."""

    def __init__(self, origins: Origins, is_nothing: Callable[[Stored, int], bool]) -> None:
        self._origins = origins
        self._is_nothing = is_nothing
        self._program = origins.graph.program

    # --- callbacks of what is stored ---

    def is_kept_by(
        self, value: e.Expression, key: Key, function: str, nothing: Iterable[str], depth: int
    ) -> bool:
        """Whether a function is a callback of what its object's member holds, as of its timer.

        It only runs while there is such an object, and constructors leave none out of it later.
        """
        if not (isinstance(value, e.Attribute) and _is_this(value.object)):
            return False
        return self._is_callback_of(key, function, depth) and all(
            self._only_starts_with(key, self._program.function(f), depth) for f in nothing
        )

    def _is_callback_of(self, key: Key, function: str, depth: int) -> bool:
        if depth > _DEEPEST:
            return False
        around, call = self._origins.of_cpp.handed_to.get(function, ("", None))
        if call is not None:
            stores = (n for n in walk(self._program.function(around)) if isinstance(n, s.Assign))
            here = [n.target for n in stores if bare(n.value) == call.target is not None]
            owners = (n.object for n in here if isinstance(n, e.Attribute))
            is_own = len(here) == 1 and all(map(_is_this, owners))
            return is_own and last_name(call) in named(*ASKING) and key_of(here[0], around) == key
        calls = self._origins.of_cpp.calls.get(function, ())
        return bool(calls) and all(
            bool(c.arguments)
            and _is_this(c.arguments[0].value)
            and self._is_callback_of(key, caller, depth + 1)
            for caller, c in calls
        )

    def _only_starts_with(self, key: Key, function: Function, depth: int) -> bool:
        """Whether a function is a constructor that stores nothing but before it asks for calls."""
        body = function.body
        firsts = (i for i, n in enumerate(body) if key in dict(self._stores(n, function.name)))
        at = next(firsts, len(body)) + 1
        asks = any(isinstance(n, e.Closure) for n in walk(body[:at]))
        is_first = function.kind is FunctionKind.CONSTRUCTOR and not asks
        return is_first and not self._empties(key, body[at:], function.name, depth)

    # --- definite assignment ---------------------------------------------------------------------

    def is_end(self, value: e.Expression, function: Function) -> bool:
        """Whether a member is asked for at the end of an object that is as constructors made it."""
        is_own = isinstance(value, e.Attribute) and self._is_own(value.object, function.name)
        return is_own and self._ends_whole(function)

    def _ends_whole(self, function: Function) -> bool:
        """Whether a function is the end of objects that nothing moves from."""
        family = self._origins.graph.family(function.owner or "")
        is_moved = not family.isdisjoint(self._origins.of_cpp.moved_classes)
        return function.kind is FunctionKind.DESTRUCTOR and not is_moved

    def unset_in(
        self, key: Key, nothing: Iterable[str], is_end: bool, depth: int
    ) -> frozenset[str] | None:
        """The functions that may run before a variable leads to something.

        Of the functions that store `nothing` in it; None where it may stay so, or become so again.
        Nothing that is asked for at the end of an object runs before this is made.
        """
        if not isinstance(key, Member | GlobalVariable):
            return None
        found, asked = set[str](), set[str]()
        firsts = [f for f in map(self._program.function, nothing) if f.kind in _FIRST]
        for first in firsts:
            found.add(first.name)
            entries = [first.name] if is_end else self._entries(first)
            bodies = [each for each in entries if each in self._program]
            for at, entry in enumerate(bodies):
                body = tuple(_in_order(self._program.function(entry).body))
                before = self._before(key, entry, body, is_end, depth)
                if before is not None:
                    asked.add(entry)
                    found |= before | self._origins.all_run(bodies[:at])
                    break
            else:
                return None
        others = set(nothing).difference(f.name for f in firsts)
        return frozenset(found) if others <= asked else None

    def _entries(self, first: Function) -> list[str]:
        """A constructor and what runs before else is served; of variables of files `main`."""
        if first.kind is FunctionKind.MODULE:
            mains = [n for n in self._program.functions if n.partition(" ")[0] == _MAIN]
            places = {n: self._program.function(n).place for n in mains}
            return [n for n, p in places.items() if _is_in(p, first.name)]
        return [first.name, *(f"{first.owner}::{entry}" for entry in sorted(first_called()))]

    def _before(
        self, key: Key, function: str, body: s.Body, is_end: bool, depth: int
    ) -> frozenset[str] | None:
        """What runs before a function stores something under a name; None where it may not do so.

        Neither does it where it stores nothing there again, or lets callbacks run before.
        """
        at = self._first_store(key, body, function, depth)
        if at is None:
            return None
        rest = body[at + 1 :] if is_end else _until_served(body, at + 1)
        if self._empties(key, rest, function, depth):
            return None
        if is_end:
            return frozenset()
        before = list(self._origins.runs(_at_once(body[:at]), function))
        if any(map(_serves, (n for _, inner in before for n in walk(inner)))):
            return None
        return frozenset(n for n, _ in before if not self._ends_made(function, n))

    def _ends_made(self, constructor: str, function: str) -> bool:
        """Whether a function is the end of what a constructor makes, which is after that."""
        first, last = map(self._program.function, (constructor, function))
        is_pair = first.kind is FunctionKind.CONSTRUCTOR and self._ends_whole(last)
        return is_pair and last.owner in self._origins.graph.family(first.owner or "")

    def _first_store(self, key: Key, body: s.Body, function: str, depth: int) -> int | None:
        """The first of some statements that stores something under a name whenever it runs."""
        for at, node in enumerate(body):
            if self._always_stores(key, node, function, depth):
                return at
            if function.partition(" ")[0] != _MAIN and any(
                isinstance(n, s.Return) for n in walk(node)
            ):
                return None
        return None

    def _always_stores(self, key: Key, node: s.Statement, function: str, depth: int) -> bool:
        match node:
            case s.Assign(target) | s.Declare(target) | s.Call(target) if (
                target is not None and key_of(target, function) == key
            ):
                is_own = not isinstance(target, e.Attribute) or self._is_own(
                    target.object, function
                )
                return is_own and not self._empties(key, (node,), function, depth)
            case s.Call(_, s.FunctionCallee(name), arguments) if depth <= _DEEPEST:
                of = arguments[0].value if arguments else None
                if isinstance(key, Member) and not self._is_own(of, function):
                    return False
                body = tuple(_in_order(self._program.function(name).body))
                return self._first_store(key, body, name, depth + 1) is not None
            case _:
                return False

    def _is_own(self, value: e.Expression | None, function: str) -> bool:
        """Whether a value is the object that a method is called on."""
        receiver = self._program.function(function).receiver
        return isinstance(value, e.Local) and value.name == receiver

    def _empties(self, key: Key, body: s.Body, function: str, depth: int) -> bool:
        """Whether some statements may store nothing under a name."""
        stores = (each for node in walk(body) for each in self._stores(node, function))
        return any(
            self._is_nothing((function, value), depth + 1)
            for other, value in stores
            if other == key
        )

    def _stores(self, node: Node, function: str) -> Iterator[tuple[Key, Value]]:
        """The variables that a node stores in, with what it stores there."""
        yield from ((key, _NULL) for key in emptied_by(self._program, (node,), function))
        match node:
            case s.Assign(target, value) | s.Declare(target, _, value) if value is not None:
                stored: Value = value
            case s.Call(target) if target is not None:
                stored = CallResult(node)
            case _:
                return
        key = key_of(target, function)
        if key is not None:
            yield key, stored


def _is_in(place: Span, path: str) -> bool:
    """Whether a place is in a file."""
    return isinstance(place, SourceSpan) and place.source.path == path


def _in_order(body: s.Body) -> Iterator[s.Statement]:
    """Statements that run one after the other whenever the first does, but for exceptions."""
    for node in body:
        match node:
            case s.Block(inner) | s.Try(inner, ()):
                yield from _in_order(inner)
            case s.Unsequenced(parts):
                for part in parts:
                    yield from _in_order(part)
            case _:
                yield node


def _is_this(value: e.Expression) -> bool:
    return isinstance(value, e.Local | e.Captured) and value.name == "this"


def _at_once(body: s.Body) -> s.Body:
    """Some statements without those that ask for what calls back later."""
    return tuple(n for n in body if last_name(n) not in named(*ASKING) | BINDING)


def _until_served(body: s.Body, start: int) -> s.Body:
    """Some statements up to the last one that lets callbacks run, if there is one."""
    serving = [at for at, node in enumerate(body) if any(map(_serves, walk(node)))]
    return body[start : serving[-1] + 1 if serving else None]


def _serves(node: object) -> bool:
    """Whether a call lets callbacks run."""
    return last_name(node) in waiting() | running_callbacks()


def last_name(node: object) -> str:
    callee = node.callee if isinstance(node, s.Call) else None
    return getattr(callee, "name", "").partition("<")[0].rpartition("::")[2]


def bare(value: e.Expression) -> e.Expression:
    """A pointer itself, which a reference may lead to."""
    while True:
        match value:
            case e.Dereference(of) | e.Convert(_, of) | e.Copy(of) | e.Move(of):
                value = of
            case _:
                return value
