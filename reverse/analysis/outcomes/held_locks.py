"""Locks that a thread may wait for while it holds them, for ever.

What locks a mutex for a block (`std::lock_guard` and its kin, `with`) holds it to the end of the
block; `m.lock();` holds to `m.unlock();` in the same block, if nothing between leaves it. Nothing
in there, and nothing that it calls, may lock the same one, unless it is recursive. A function that
leaves a mutex locked locks it for who calls it: objects of classes whose constructors do so are
guards too. What `enter_context` of an `ExitStack` enters is held for the rest of its block.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Collection, Iterator
from functools import cached_property, partial

from rebsync.reverse.analysis.element_counts import ElementCounts
from rebsync.reverse.analysis.fixpoint import Equation, LeastFixpoint, Transfer
from rebsync.reverse.analysis.origins import AnyOrigin, ClassOrigin, LibraryOrigin, Origins
from rebsync.reverse.analysis.outcomes.lock_classes import (
    BY_HAND,
    OTHERWISE,
    UNLOCKS,
    has_guard,
    inner_of,
    is_by_hand,
    is_guard,
    is_mutex,
    is_or_has_guard,
    is_tag,
)
from rebsync.reverse.analysis.problems import Problem, ProblemNotes
from rebsync.reverse.analysis.stores import CallResult, Key, Member, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.program import Function, FunctionKind
from rebsync.reverse.ir.walk import STATEMENTS, Node, walk
from rebsync.reverse.libraries.outcome_classes import UNKNOWN_CLASS

_NAMED = e.AddressOf | e.Local | e.Temporary | e.Global | e.Captured | e.Attribute
_ASKING = frozenset({"acquire", "__enter__"})
_LEAVING = (s.Return, s.Raise, s.Break, s.Continue, s.Yield, s.Unsupported)
_LOCKS = frozenset(
    LibraryOrigin(name, True)
    for name in (
        *("threading.Lock", "threading.Condition", "threading.Semaphore"),
        *("threading.BoundedSemaphore", "_thread.allocate_lock", "thread.allocate_lock"),
    )
)
_REENTRANT = LibraryOrigin("threading.RLock")
_OF = "::"  # between a class and its field
_AGAIN = "this waits for ever where the lock is held already"
UNKNOWN_LOCK = "what this locks is not known"
_NOT_HELD = "this unlocks what is not locked here, and may do anything"
_LONGER = "this may hold a lock for longer than its block"

# The mutexes that something locks; None is one of which nothing is known.
Mutexes = frozenset[Key | None]
_NONE: Mutexes = frozenset()


class HeldLocks:
    """The locks of one program, in which `known` functions leave nothing locked."""

    def __init__(self, origins: Origins, known: Collection[str] = ()) -> None:
        self.origins = origins
        self._known = known
        self.stores = origins.graph.stores
        self._counts = ElementCounts(origins)
        self._left = LeastFixpoint[Key | None](self._left_by)

    def check(self, function: Function, notes: ProblemNotes) -> None:
        """Notes where a function may lock what it has locked."""
        for used in walk(function.body):
            if isinstance(used, e.LibraryReference) and is_guard(used.name):
                notes.problem(used, _LONGER)
            if isinstance(used, s.Declare) and has_guard(used.type):
                notes.problem(used, _LONGER)
            if isinstance(used, s.Call | s.Unsupported) and self._is_unknown(used):
                notes.problem(used, UNKNOWN_LOCK)
        for unlock in (
            _unpaired(function.body) if function.kind is not FunctionKind.DESTRUCTOR else ()
        ):
            notes.problem(unlock, _NOT_HELD)
        scoped = _scoped(function.body)
        for node, inside in _with_rest(function.body):
            mutexes = self._locked(node, function.name)
            if not mutexes:
                continue
            inside, is_longer = _held(node, inside)
            is_longer = is_longer and id(node) not in scoped
            if is_longer or (isinstance(node, s.Construct) and not self._unlocks(node.class_name)):
                notes.problem(node, _LONGER)
            for name, body in self.origins.runs(inside, function.name):
                if name != function.name and self._is_guard_of(name):
                    continue  # who makes the object locks
                later = (self._locked(inner, name) for inner in walk(body))
                if any(_meet(mutexes, others) for others in later) or _acquires(body):
                    notes.problem(node, _AGAIN)

    def _is_unknown(self, node: s.Call | s.Unsupported) -> bool:
        """Whether a node may lock something in a way that is not known."""
        match node:
            case s.Call(_, s.LibraryCallee(name, None), arguments) if not is_guard(name):
                is_given = any(is_mutex(a.value) for a in arguments)
                is_odd = name == UNKNOWN_CLASS and self._has_guards
                return is_given or is_odd or OTHERWISE.fullmatch(name) is not None
            case s.Unsupported(target=e.Local(type=t.Record(name))):
                line = {name, *self.origins.graph.bases(name)}
                every = self.origins.graph.program.functions
                return any(n.rpartition("::")[0] in line and self._is_guard_of(n) for n in every)
            case _:
                return False

    @cached_property
    def _has_guards(self) -> bool:
        """Whether objects of some class of the program, perhaps a template, hold a lock."""
        program = self.origins.graph.program
        every = map(program.function, program.functions)
        makers = [f for f in every if f.kind is FunctionKind.CONSTRUCTOR]
        return any(self.left_by(f.name) or _asks(f.body, BY_HAND) for f in makers)

    def of(self, name: str) -> frozenset[Problem]:
        """Where a function of a program may lock what it has locked."""
        function = self.origins.graph.program.function(name)
        notes = ProblemNotes(function, self.origins, self._counts, lambda _: False, {})
        self.check(function, notes)
        return frozenset(p for p in notes.found if isinstance(p, Problem))

    def _locked(self, node: Node, function: str) -> Mutexes:
        """The mutexes that a statement locks, other than recursive ones."""
        seen = (
            self._seen(arguments, function, left)
            for name, arguments in self._calls(node, function)
            for left in self.left_by(name)
        )
        return self._by_library(node, function).union(*seen)

    def _by_library(self, node: Node, function: str) -> Mutexes:
        match node:
            case s.Call(_, s.LibraryCallee(name), arguments) if is_guard(name):
                values = (a.value for a in arguments)
                found = [self._mutexes(v, function, _NONE) for v in values if not is_tag(v)]
            case s.Call(_, s.LibraryCallee(name)) if OTHERWISE.fullmatch(name):
                return frozenset({None})
            case s.Call(_, s.LibraryCallee(name, receiver)) if is_by_hand(name):
                found = [] if receiver is None else [self._mutexes(receiver, function, _NONE)]
            case s.Call(_, s.MethodCallee(_, "enter_context"), arguments):
                found = [self._entered(a.value, function) for a in arguments]
            case s.With(context):
                found = [self._entered(context, function)]
            case _:
                return _NONE
        return _NONE.union(*found)

    def _entered(self, context: e.Expression, function: str) -> Mutexes:
        """The mutexes that `with` locks by a context; None is one that an own context locks."""
        held = self.origins.of(context, function)
        if not held.isdisjoint(_LOCKS) or AnyOrigin() in held:
            return self._mutexes(context, function, _NONE)
        own = (o.name for o in held if isinstance(o, ClassOrigin) and o.of_object)
        enters = {f for name in own for f in self.origins.methods(name, "__enter__")}
        return frozenset({None}) if any(map(self._asks_lock, enters)) else _NONE

    def _asks_lock(self, name: str) -> bool:
        """Whether a function, or what it runs, asks a lock of Python."""
        body = self.origins.graph.program.function(name).body
        return any(_acquires(inner) for _, inner in self.origins.runs(body, name))

    def left_by(self, name: str) -> Mutexes:
        """The mutexes that a function may leave locked; None is one that it gets."""
        return _NONE if name in self._known else self._left.of(name)

    def _left_by(self, name: str) -> Equation[Key | None]:
        own, uses = set[Key | None](), list[tuple[str, Transfer[Key | None]]]()
        body = self.origins.graph.program.function(name).body
        scoped = _scoped(body)
        for node, rest in _with_rest(body):
            if id(node) in scoped:
                continue
            calls = self._calls(node, name)
            locked = self._by_library(node, name)
            if (calls or locked) and (_held(node, rest)[1] or _is_given(node, rest)):
                own |= locked
                uses += ((called, partial(self._seen, given, name)) for called, given in calls)
        return Equation(frozenset(own), tuple(uses))

    def _calls(self, node: Node, function: str) -> list[tuple[str, tuple[s.CallArgument, ...]]]:
        """The functions of the program that a statement runs, with what they get."""
        match node:
            case s.Construct(_, _, arguments, str() as name):
                return [(name, arguments)]
            case s.Call(_, s.MethodCallee(_, "enter_context")):
                return []  # it enters what it gets
            case s.Call(_, s.FunctionCallee() | s.MethodCallee(), arguments):
                return [(name, arguments) for name in self.origins.reached(node, function)]
            case _:
                return []

    def _seen(
        self, arguments: tuple[s.CallArgument, ...], function: str, left: Key | None
    ) -> Mutexes:
        """A mutex that a function of the program leaves locked, as seen where it is called."""
        given = [a.value for a in arguments if is_mutex(a.value)] if left is None else []
        return (
            _NONE.union(*(self._mutexes(v, function, _NONE) for v in given))
            if given
            else (frozenset({left}))
        )

    def _is_guard_of(self, name: str) -> bool:
        """Whether a function makes an object that holds a lock."""
        function = self.origins.graph.program.function(name)
        return function.kind is FunctionKind.CONSTRUCTOR and bool(self.left_by(name))

    def _unlocks(self, class_name: str) -> bool:
        """Whether objects of a class unlock something when they end."""
        graph = self.origins.graph
        every = (graph.program.classes.get(c) for c in (class_name, *graph.bases(class_name)))
        classes = [c for c in every if c is not None]
        if any(is_or_has_guard(f.type) for c in classes for f in c.fields):
            return True
        bodies = (graph.program.function(c.destructor) for c in classes if c.destructor)
        calls = (n.callee for body in bodies for n in walk(body) if isinstance(n, s.Call))
        return any(isinstance(c, s.LibraryCallee) and c.name.endswith("unlock") for c in calls)

    def _mutexes(self, value: e.Expression, function: str, seen: Mutexes) -> Mutexes:
        """The mutexes that a value may be, or lead to."""
        while isinstance(value, e.AddressOf | e.Dereference | e.Convert | e.Copy | e.Move):
            value = inner_of(value)
        key = key_of(value, function)
        type_ = getattr(value, "type", t.UNKNOWN)
        if isinstance(type_, t.Record):
            return _NONE if "recursive" in type_.name else frozenset({self._of_class(value) or key})
        stored = self.stores.of(key) if key is not None and key not in seen else []
        found = list[Mutexes]()
        for of, each in stored:
            match each:
                case CallResult(s.Call(_, callee)) if self._is_reentrant(callee, of):
                    continue
                case CallResult(s.Call(_, s.LibraryCallee())):
                    found.append(frozenset({key}))  # a new one
                case e.AddressOf(to) if to == value:
                    continue
                case _ if isinstance(each, _NAMED):
                    found.append(self._mutexes(each, of, seen | {key}))
                case _:
                    found.append(frozenset({None}))
        return _NONE.union(*found) if stored else frozenset({None})

    def _of_class(self, value: e.Expression) -> Member | None:
        """A mutex that is a field, by the class that declares it; None if that is not known."""
        if not isinstance(value, e.Attribute) or value.dynamic:
            return None
        of = getattr(value.object, "type", t.UNKNOWN)
        of = of.to if isinstance(of, t.Reference) else of
        graph = self.origins.graph
        names = (of.name, *graph.bases(of.name)) if isinstance(of, t.Record) else ()
        classes = (graph.program.classes.get(name) for name in names)
        declare = (c for c in classes if c and any(f.name == value.name for f in c.fields))
        declaring = next(declare, None)
        return Member(f"{declaring.name}{_OF}{value.name}") if declaring is not None else None

    def _is_reentrant(self, callee: s.Callee, function: str) -> bool:
        match callee:
            case s.LibraryCallee(name):
                return name == _REENTRANT.name
            case s.ValueCallee(value):
                return self.origins.of(value, function) == {_REENTRANT}
            case _:
                return False


def _acquires(body: s.Body) -> bool:
    """Whether a body asks a lock of Python, whichever it is."""
    return _asks(body, _ASKING)


def _asks(body: s.Body, methods: Collection[str]) -> bool:
    """Whether a body calls some methods of objects of which no more is known."""
    calls = (n for n in walk(body) if isinstance(n, s.Call))
    called = (n.callee for n in calls if isinstance(n.callee, s.MethodCallee))
    return any(callee.name in methods for callee in called)


def _scoped(body: s.Body) -> frozenset[int]:
    """The ids of calls that enter a context for the rest of the block of an `ExitStack`."""
    return frozenset(
        id(node)
        for outer in walk(body)
        if isinstance(outer, s.With) and outer.body and isinstance(outer.body[0], s.Assign)
        for node in outer.body
        if isinstance(node, s.Call)
        and isinstance(node.callee, s.MethodCallee)
        and outer.body[0].value == outer.target
        and node.callee.receiver == outer.body[0].target
    )


def _held(node: s.Statement, rest: s.Body) -> tuple[s.Body, bool]:
    """What runs while a lock is held, of what follows it; and whether more than that may."""
    if not isinstance(node, s.Call | s.Construct):
        return rest, any(isinstance(n, s.Yield) for n in walk(rest))
    if isinstance(node, s.Construct):
        return rest, _outlives(node.target, rest)
    if not isinstance(node.callee, s.LibraryCallee):
        is_given = is_or_has_guard(node.target.type) if node.target is not None else False
        return rest, not is_given or _outlives(node.target, rest)
    if not is_by_hand(node.callee.name):
        return rest, _outlives(node.target, rest)
    unlock = node.callee.name.rpartition("::")[0] + "::unlock"
    for number, later in enumerate(rest):
        match later:
            case s.Call(_, s.LibraryCallee(name, of)) if name == unlock:
                if of == node.callee.receiver:
                    between = rest[:number]
                    return between, any(isinstance(n, _LEAVING) for n in walk(between))
            case _:
                pass
    return rest, True


def _unpaired(body: s.Body) -> list[s.Call]:
    """The calls that unlock a mutex which nothing before them in their block has locked."""
    unlocks = {id(n): n for n in walk(body) if isinstance(n, s.Call) and _mutex_of(n, UNLOCKS)}
    for node, rest in _with_rest(body) if unlocks else ():
        if isinstance(node, s.Call) and (mutex := _mutex_of(node, BY_HAND)) is not None:
            later = (n for n in rest if id(n) in unlocks and _mutex_of(n, UNLOCKS) == mutex)
            unlocks.pop(id(next(later, None)), None)
    return list(unlocks.values())


def _mutex_of(node: s.Statement, methods: Collection[str]) -> e.Expression | None:
    """The mutex of a library whose method a statement calls, if it is one of these."""
    match node:
        case s.Call(_, s.LibraryCallee(name, mutex)):
            of, _, method = name.rpartition("::")
            return mutex if of.endswith("mutex") and method in methods else None
        case _:
            return None


def _with_rest(body: s.Body) -> Iterator[tuple[s.Statement, s.Body]]:
    """The statements of a body, each with those that run while it holds a lock."""
    for number, node in enumerate(body):
        yield node, node.body if isinstance(node, s.With) else body[number + 1 :]
        for inner in _bodies(node):
            yield from _with_rest(inner)


def _bodies(node: object) -> Iterator[s.Body]:
    """The bodies within a statement, those of cases and handlers included."""
    for field in dataclasses.fields(node):  # type: ignore[arg-type]
        value = getattr(node, field.name)
        if not isinstance(value, tuple) or not value:
            continue
        if isinstance(value[0], s.Case | s.Handler):
            for each in value:
                yield from _bodies(each)
        elif isinstance(value[0], tuple):
            yield from value
        elif isinstance(value[0], STATEMENTS):
            yield value


def _outlives(guard: e.Lvalue | None, rest: s.Body) -> bool:
    """Whether what holds a lock may be there after its block: it is no variable, or moved."""
    if not isinstance(guard, e.Local):
        return True
    ended = (n for n in walk(rest) if isinstance(n, e.Move | s.Return))
    return any(guard in walk(n) for n in ended)


def _is_given(node: s.Statement, rest: s.Body) -> bool:
    """Whether a variable that holds a lock is what the function gives: it is moved to there."""
    guard = node.target if isinstance(node, s.Call) else None
    moved = (n.value for n in walk(rest) if isinstance(n, s.Assign))
    return isinstance(guard, e.Local) and any(value == guard for value in moved)


def _meet(mutexes: Mutexes, others: Mutexes) -> bool:
    if not mutexes or not others:
        return False
    if None in mutexes or None in others or not mutexes.isdisjoint(others):
        return True
    return not _any_class(mutexes).isdisjoint(others) or not _any_class(others).isdisjoint(mutexes)


def _any_class(mutexes: Mutexes) -> Mutexes:
    """The same fields of classes that are not known."""
    fields = (m.name for m in mutexes if isinstance(m, Member) and _OF in m.name)
    return frozenset(Member(name.rpartition(_OF)[2]) for name in fields)
