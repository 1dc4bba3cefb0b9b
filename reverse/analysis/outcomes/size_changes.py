"""Whether what runs in a loop may change the number of elements of the containers that it is over.

A container that has no other name is changed only by that name. Any other may be one that the loop
is over.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from rebsync.reverse.analysis.facts import bare
from rebsync.reverse.analysis.foreign_filling import ForeignFilling
from rebsync.reverse.analysis.origins import LibraryOrigin, PlainOrigin
from rebsync.reverse.analysis.outcomes.outcome_sizes import OutcomeSizes
from rebsync.reverse.analysis.problems import ProblemNotes
from rebsync.reverse.analysis.stores import CallResult, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.walk import Node, walk
from rebsync.reverse.libraries.outcome_rules import Size, Tells
from rebsync.reverse.libraries.routines import Language
from rebsync.reverse.libraries.size_effects import (
    CHANGING_ARGUMENTS,
    CHANGING_OBJECT,
    LESSENING,
    READING,
    VIEWS,
)

GROWING = frozenset({Size.GROWS, Size.MORE})
CHANGING = GROWING | {Size.LOSES, Size.ANY}
_ORDERED = frozenset(LibraryOrigin(n, True) for n in ("list", "tuple", "str", "deque", "set"))
_INDEXED = frozenset(LibraryOrigin(n, True) for n in ("list", "tuple", "str"))
_NUMBERS = frozenset({PlainOrigin(), LibraryOrigin("str", True)})
_DEFAULTING = LibraryOrigin("defaultdict", True)
_NOTHING = frozenset[e.Expression]()
_NAMED = e.Local | e.Temporary | e.Captured | e.Global | e.Attribute | e.Index | e.Dereference
_VALUES = t.Integer | t.Float | t.Truth | t.Enumeration


class SizeChanges:
    """The loops of one function."""

    def __init__(self, notes: ProblemNotes, sizes: OutcomeSizes) -> None:
        self.notes = notes
        self.sizes = sizes
        self.origins = notes.origins
        self.program = notes.origins.graph.program
        self.function = notes.function.name
        self._foreign = ForeignFilling(notes)

    def in_loop(self, loop: s.Loop) -> bool:
        """Whether the containers whose sizes or ends a loop tests may get more elements."""
        over = frozenset(self._tested(loop))
        if not over:
            return False
        inner = (*loop.prelude, *loop.body, *loop.step)
        return self._changes(inner, over, GROWING) or self._stores(inner, over)

    def in_bound(self, loop: s.Loop, bound: e.Expression) -> bool:
        """Whether a loop may store in what a bound is made of."""
        return self._stores((*loop.prelude, *loop.body, *loop.step), frozenset({bound}))

    def in_for_each(self, loop: s.ForEach) -> bool:
        """Whether the containers that a loop takes elements from may have more, or fewer."""
        over = frozenset(self._views(loop.iterable))
        keys = frozenset(self._keys(loop))
        if self._is_left_to_others(loop.body, over):
            return True
        return bool(over) and self._changes(loop.body, over, CHANGING, keys)

    def _is_left_to_others(self, body: s.Body, over: frozenset[e.Expression]) -> bool:
        """Whether a generator stops within a loop, and others may change what it is over.

        A list has indices, and may change: whoever asks for elements has a loop of its own.
        """
        if not any(isinstance(n, s.Yield | s.Await) for n in walk(body)):
            return False
        shared = (c for c in over if isinstance(c, e.Global | e.Captured | e.Attribute | e.Index))
        return any(not self.origins.of(c, self.function) <= _INDEXED for c in shared)

    def is_own(self, loop: s.ForEach) -> bool:
        """Whether a loop in C++ may go by an iterator that the program has itself."""
        if self.notes.table.language is not Language.CPP:
            return False
        graph, classes = self.origins.graph, self.program.classes
        return any(
            self.origins.has_method(name, "begin") or {*graph.bases(name)} <= {*classes}
            for name in self.origins.own_classes(loop.iterable, self.function)
        ) or self.origins.may_have_method(loop.iterable, "begin")

    # --- what a loop is over ---------------------------------------------------------------------

    def _tested(self, loop: s.Loop) -> Iterator[e.Expression]:
        tests = {*walk(loop.test)}
        for node in loop.prelude:
            if isinstance(node, s.Call) and node.target in tests:
                for container in (self.sizes.bound(node), self.sizes.emptied(node)):
                    if container is not None:
                        yield container
        test = bare(loop.test)
        if isinstance(test, e.Local | e.Global | e.Captured | e.Attribute):
            yield test  # while values:
        for part in tests:
            if isinstance(part, e.Index):  # while i < values[0]
                yield part.object

    def _views(
        self, iterable: e.Expression, seen: frozenset[e.Expression] = _NOTHING
    ) -> Iterator[e.Expression]:
        """The containers whose elements an iterable gives, as they are in each round."""
        if isinstance(iterable, e.Index) and isinstance(iterable.index, e.Slice):
            return
        referred = iterable
        if isinstance(iterable, e.Dereference) and isinstance(iterable.reference, e.Temporary):
            iterable = iterable.reference
        if isinstance(iterable, e.Build | e.BuildMapping | e.Literal):
            return
        if not isinstance(iterable, e.Temporary):
            yield iterable
        key = key_of(iterable, self.function)
        stored = self.origins.graph.stores.of(key) if key is not None else []
        for function, value in () if iterable in seen else stored:
            match value:
                case CallResult(call) if function == self.function:
                    yield from self._views_of(call, iterable, seen | {iterable})
                case e.Build() | e.BuildMapping():
                    pass
                case e.AddressOf(target) if not isinstance(target, e.Temporary):
                    yield target
                case e.Local(_, t.Reference()) if isinstance(referred, e.Dereference):
                    yield replace(referred, reference=value)
                case _:
                    yield iterable

    def _views_of(
        self, call: s.Call, iterable: e.Expression, seen: frozenset[e.Expression]
    ) -> Iterator[e.Expression]:
        match call.callee:
            case s.LibraryCallee(name, None):
                outcome = self.notes.table.function(name)
                is_new = outcome.gives or outcome.tells is Tells.RANGE
                for argument in () if is_new else call.arguments:
                    yield from self._views(argument.value, seen)
            case s.LibraryCallee(name, receiver) if receiver is not None:
                if name.rpartition("::")[2] in VIEWS:
                    yield from self._views(receiver, seen)
            case s.MethodCallee(receiver, name):
                if name in VIEWS:
                    yield from self._views(receiver, seen)
                if self.origins.methods_of_any(name):
                    yield iterable
            case _:
                yield iterable
                for argument in call.arguments:
                    yield from self._views(argument.value, seen)

    def _keys(self, loop: s.ForEach) -> Iterator[tuple[e.Expression, e.Expression]]:
        """The keys that are known to be in what a loop goes through."""
        yield loop.iterable, loop.target
        key = key_of(loop.iterable, self.function)
        stored = self.origins.graph.stores.of(key) if key is not None else []
        match [value for _, value in stored], loop.body[:2]:
            case [CallResult(s.Call(_, s.MethodCallee(of, "items")))], (
                s.Unpack((first, *_), value),
                s.Assign(e.Local() as name, given),
            ) if isinstance(loop.iterable, e.Temporary) and value == loop.target and given == first:
                if sum(name in _targets(node) for node in walk(loop.body)) == 1:
                    yield of, name
            case _:
                pass

    # --- what changes sizes ----------------------------------------------------------------------

    def _changes(
        self,
        body: s.Body,
        over: frozenset[e.Expression],
        sizes: frozenset[Size],
        keys: frozenset[tuple[e.Expression, e.Expression]] = frozenset(),
    ) -> bool:
        """Whether a body, or what it calls of the program, changes sizes of containers so."""
        for function, inner in self.origins.runs(body, self.function):
            is_own = function == self.function
            read, known = (over, keys) if is_own else (_NOTHING, frozenset())
            if Size.GROWS in sizes and self._foreign.may_fill(inner, function, over):
                return True
            for node in walk(inner):
                if isinstance(node, s.Unsupported) or self._may_be_any(node, function, over):
                    return True
                for changed in self._changed(node, function, sizes, read, known):
                    if changed in read:
                        return True
                    if self._is_apart(changed, function, over):
                        continue
                    is_other = all(self._are_other(changed, function, each) for each in over)
                    if not is_other and not self._is_private(changed, function):
                        return True
        return False

    def _may_be_any(self, node: Node, function: str, over: frozenset[e.Expression]) -> bool:
        """Whether a call of a value that is kept may be a method of what a loop is over."""
        if not isinstance(node, s.Call):
            return False
        if not isinstance(node.callee, s.ValueCallee | s.MethodCallee):
            return False
        own = f".{node.callee.name}" if isinstance(node.callee, s.MethodCallee) else ""
        found = self.origins.graph.callee(node.callee, self.program.function(function))
        kept = {name[1:] for name in found.libraries if name.startswith(".") and name != own}
        if not found.unknown and not any(self._is_changing(name, CHANGING) for name in kept):
            return False
        return not all(self._is_private(each, self.function) for each in over)

    def _is_apart(
        self, changed: e.Expression, function: str, over: frozenset[e.Expression]
    ) -> bool:
        """Whether an object in C++ is none of those that a loop is over: they have other names."""
        if self.notes.table.language is not Language.CPP or not _is_object(changed):
            return False
        key = key_of(changed, function)
        return all(
            self._is_older(each)
            if isinstance(each, e.Dereference) and isinstance(changed, e.Local)
            else _is_object(each) and key_of(each, self.function) not in (None, key)
            for each in over
        )

    def _is_older(self, value: e.Dereference) -> bool:
        """Whether what a reference leads to was there before the function began."""
        type_ = getattr(value.reference, "type", None)
        is_fixed = isinstance(type_, t.Reference) and not type_.may_be_null
        return is_fixed and self.notes.is_parameter(value.reference)

    def _are_other(self, changed: e.Expression, function: str, over: e.Expression) -> bool:
        """Whether two containers are of classes of the library that are not the same."""
        kinds = self.origins.of(changed, function), self.origins.of(over, self.function)
        is_known = all(isinstance(o, LibraryOrigin) and o.of_object for k in kinds for o in k)
        return is_known and kinds[0].isdisjoint(kinds[1])

    def _changed(
        self,
        node: Node,
        function: str,
        sizes: frozenset[Size],
        over: frozenset[e.Expression],
        keys: frozenset[tuple[e.Expression, e.Expression]],
    ) -> Iterator[e.Expression]:
        """The containers whose sizes a node may change."""
        match node:
            case s.Call():
                yield from self._changed_by(node, function, sizes, over)
            case s.Delete(e.Index(of)) if Size.ANY in sizes:
                yield of
            case s.Assign(e.Index(of, e.Slice())) | s.CompoundAssign(e.Index(of, e.Slice())):
                yield of
            case s.Assign(e.Index(of, index)) | s.CompoundAssign(e.Index(of, index)):
                if (of, index) not in keys and self._takes_keys(of, function):
                    yield of
            case s.CompoundAssign(target) if not self._is_number(target, function):
                yield target
            case e.Index(of, index) if (of, index) not in keys:
                if _DEFAULTING in self.origins.of(of, function):
                    yield of
            case _:
                pass

    def _changed_by(
        self, node: s.Call, function: str, sizes: frozenset[Size], over: frozenset[e.Expression]
    ) -> Iterator[e.Expression]:
        """The containers that a call of a library may change the sizes of."""
        receiver: e.Expression | None = None
        size = Size.SAME
        match node.callee:
            case s.LibraryCallee(name, receiver):
                names, size = {name}, self.notes.table.function(name).size
            case s.MethodCallee(receiver, name):
                names, size = {name}, self.notes.table.method(None, name).size
            case s.ValueCallee(value):
                held = self.origins.of(value, function)
                names = {o.name for o in held if isinstance(o, LibraryOrigin)}
            case _:
                return
        plain = {name.replace("::", ".").rpartition(".")[2] for name in names}
        for argument in node.arguments:  # `map(values.append, others)`
            match argument.value:
                case e.Attribute(of, name) if self._is_changing(name, sizes):
                    yield of
                case _:
                    pass
        if receiver is None and any(self._is_changing(name, sizes) for name in plain):
            yield from (a.value for a in node.arguments[:1])  # `list.append(values, other)`
        if receiver is not None:
            is_read = plain <= (READING if Size.ANY in sizes else READING | LESSENING)
            if size in sizes or plain & CHANGING_OBJECT or (receiver in over and not is_read):
                yield receiver
        if plain & CHANGING_ARGUMENTS:
            for argument in node.arguments:
                value = argument.value
                yield value.target if isinstance(value, e.AddressOf) else value

    def _is_changing(self, name: str, sizes: frozenset[Size]) -> bool:
        """Whether methods of a name change the sizes of their objects so."""
        size = self.notes.table.method(None, name).size
        return size in sizes or name in CHANGING_OBJECT

    def _takes_keys(self, container: e.Expression, function: str) -> bool:
        """Whether storing at an index may add an element: in mappings, and what is not known."""
        match getattr(container, "type", t.UNKNOWN):
            case t.Container(kind):
                return kind is t.ContainerKind.MAPPING
            case t.Array() | t.Text() | t.Reference():
                return False
            case _:
                return not self.origins.of(container, function) <= _ORDERED

    def _is_number(self, target: e.Expression, function: str) -> bool:
        """Whether `+=` leaves containers as they are: all that is stored before are numbers."""
        if isinstance(getattr(target, "type", None), _VALUES):
            return True
        key = key_of(target, function)
        stored = self.origins.graph.stores.initial(key) if key is not None else []
        kinds = (self.origins.of_stored(each) for each in stored)
        return bool(stored) and all(kind <= _NUMBERS for kind in kinds)

    def _stores(self, body: s.Body, read: frozenset[e.Expression]) -> bool:
        """Whether a body, or what it calls, stores in what some values are read from."""
        named = [n for each in read for n in walk(each) if isinstance(n, _NAMED)]
        keys = {key_of(n, self.function) for n in named if not isinstance(n, e.Temporary)}
        referred = [n for n in named if isinstance(n, e.Dereference)]
        has_parts = bool(referred) or any(isinstance(n, e.Index) for n in named)
        is_private = all(self._is_unshared(n) for n in named)
        for function, inner in self.origins.runs(body, self.function):
            for each in (target for node in walk(inner) for target in _targets(node)):
                match each:
                    case e.Index(of) if function == self.function and of in read:
                        continue  # an element of what is read
                    case e.Index() if has_parts:
                        return True
                    case e.Dereference() if has_parts or not is_private:
                        if has_parts or not isinstance(each.type, _VALUES):
                            return True
                        if any(each.type == getattr(n, "type", None) for n in named):
                            return True
                    case e.Local() if referred and self._may_be(each, referred, function):
                        return True
                if key_of(each, function) in keys - {None}:
                    return True
        return False

    def _is_unshared(self, value: e.Expression) -> bool:
        """Whether no reference leads to a variable."""
        is_local = isinstance(value, e.Local) and value.name not in self.notes.function.captured
        return is_local or isinstance(value, e.Temporary)

    def _may_be(self, stored: e.Local, referred: list[e.Dereference], function: str) -> bool:
        """Whether a reference that is read may lead to a variable, which is no older than it."""
        if function != self.function or self._is_unshared(stored):
            return False
        return not all(self._is_older_than_locals(r.reference) for r in referred)

    def _is_older_than_locals(self, reference: e.Expression) -> bool:
        """Whether a reference leads to no variable of the function: a smart pointer owns."""
        type_ = getattr(reference, "type", None)
        is_owner = isinstance(type_, t.Reference) and type_.ownership is not t.Ownership.NONE
        return is_owner or self.notes.is_parameter(reference)

    def _is_private(self, container: e.Expression, function: str) -> bool:
        """Whether a container is one that a function made itself, and that has no other name."""
        captured = self.program.function(function).captured
        if not isinstance(container, e.Local) or container.name in captured:
            return False
        return not self.notes.counts.has_other_names(container, function)


def _targets(node: Node) -> Iterator[e.Lvalue]:
    """What a statement stores in."""
    if isinstance(node, s.Unpack):
        yield from node.targets
    elif (
        not isinstance(node, e.AddressOf) and (target := getattr(node, "target", None)) is not None
    ):
        yield target


def _is_object(value: e.Expression) -> bool:
    """Whether a variable or member is a container itself, and no reference to one."""
    is_named = isinstance(value, e.Local | e.Captured | e.Global | e.Attribute)
    return is_named and isinstance(getattr(value, "type", None), t.Container | t.Text)
