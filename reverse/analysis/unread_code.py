"""Calls that may run code of which no file that was read has the body: unresolved calls.

Such code may do anything to what it can reach: it may change what the node has, publish, or throw.
What the files declare without a body, or leave to whoever derives a class, is code of theirs, which
knows their variables. An object that somebody else made, and handed to the node, may have been told
of it. What a library has, and got nothing of the node, can reach nothing of it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from collections.abc import Set as AbstractSet

from rebsync.records import dataclass
from rebsync.reverse.analysis.makers import Makers, ObjectMaker
from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.analysis.stores import AnyValue, key_of
from rebsync.reverse.analysis.unread_objects import UnreadObjects, led_to
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.walk import Node, walk
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.looked_through import is_library
from rebsync.source import NOWHERE, Span

_UNDEFINED = "no file that was read defines it"
_OVERRIDDEN = "a class that was not read may override it"
_INHERITED = "a class that was not read may have it"
_GIVEN = "nothing that was read makes the object"
_HELD = "which function is held there is not known"
# Classes of libraries whose objects call what they got.
_CALLED = frozenset({"function", "move_only_function", "signal", "packaged_task"})
# Functions of libraries that do not call what they get.
_KEEPING = frozenset(
    {"move", "forward", "ref", "cref", "bind", "swap", "exchange", "ignore_unused"}
)
# Methods of containers and pointers that make elements, or end some; those that compare none.
_MAKING = frozenset(
    {"emplace", "emplace_back", "emplace_front", "push_back", "push_front", "push", "insert"}
    | {"resize", "assign", "clear", "erase", "pop_back", "pop_front", "pop", "reset"}
)
_COUNTING = frozenset({"size", "empty", "begin", "end", "cbegin", "cend", "front", "back", "data"})
_COUNTING |= _MAKING - {"insert", "emplace", "erase", "push"}
# Bases of nodes that are the client libraries' own, or have no functions to be called.
_PLAIN_BASES = frozenset({"Nodelet", "Node", "LifecycleNode", "noncopyable"})
_PLAIN_BASES |= {"enable_shared_from_this"}


@dataclass(frozen=True, slots=True)
class UnreadRun:
    """A place that may run what was not read; `called` is the function that is to blame, if any.

    That is the name of one that has a body, of a method, or of the variable that holds one.
    """

    place: Span
    why: str
    called: str = ""


class UnreadCode:
    """Which places of a program of C++ may run what was not read, and why.

    What `known` functions run of themselves is known: those of the run-time part run what they got.
    """

    def __init__(self, origins: Origins, known: AbstractSet[str] = frozenset()) -> None:
        self._known = known
        self._origins = origins
        self._graph = origins.graph
        self._program = origins.graph.program
        self._makers = Makers(origins)
        self.objects = UnreadObjects(origins.graph)
        self._found: dict[str, tuple[UnreadRun, ...]] = {}
        self._why_of: dict[str, str | None] = {}

    def of(self, name: str) -> tuple[UnreadRun, ...]:
        """The places in a function that may run what was not read, and why."""
        if name not in self._found:
            self._found[name] = tuple(self._places(name))
        return self._found[name]

    def _places(self, name: str) -> Iterator[UnreadRun]:
        for node in walk(self._program.function(name)):
            why = self._why(node, name) or next(
                filter(None, map(self._reason, self.run(node))), None
            )
            if why is not None:
                yield UnreadRun(getattr(node, "place", NOWHERE), why, self._blamed(node))

    def _blamed(self, node: Node) -> str:
        match node:
            case s.Call(_, s.FunctionCallee(name)) | s.Construct(_, _, _, str() as name):
                return name if name in self._program else ""
            case s.Call(_, s.MethodCallee(_, name)):
                return name
            case s.Call(_, s.ValueCallee(e.Attribute(_, name) | e.Local(name))):
                return name
            case _:
                return ""

    # --- functions that run -----------------------------------------------------------------------

    def _reason(self, name: str) -> str | None:
        """Why a function may, as it has no body, or by all that it may run."""
        if name not in self._why_of:
            waiting, seen, found = [name], {name}, list[str]()
            while waiting and not found:
                current = waiting.pop()
                found += [_UNDEFINED] if current in self._program.undefined else []
                is_here = current in self._program and current not in self._known
                for node in walk(self._program.function(current)) if is_here else ():
                    why = self._why(node, current)
                    found += [] if why is None else [why]
                    new = set(self.run(node)) - seen
                    seen |= new
                    waiting += new
            self._why_of[name] = next(iter(found), None)
        return self._why_of[name]

    def run(self, node: Node) -> Iterator[str]:
        """The functions of the files that a node itself may run."""
        match node:
            case s.Call(_, callee):
                yield from self.functions(callee)
            case s.Construct(_, name, _, constructor):
                yield from self.objects.made(t.Record(name))
                yield from () if constructor is None else (constructor,)
            case s.Destroy(target, name):
                type_ = getattr(target, "type", t.UNKNOWN) if name is None else t.Record(name)
                yield from self.objects.ended(type_, isinstance(target, e.Dereference))
            case s.Assign(target):
                type_ = getattr(target, "type", t.UNKNOWN)
                is_pointer = isinstance(type_, t.Reference)
                yield from self.objects.ended(type_, True) if is_pointer else ()
            case s.ForEach(_, of):
                classes = self.objects.parts(led_to(getattr(of, "type", t.UNKNOWN)))[:1]
                yield from (f for c in classes for n, f in c.methods if n in ("begin", "end"))
            case _:
                pass

    def functions(self, callee: s.Callee) -> Iterator[str]:
        """The functions of the files that a call may be of, by its callee."""
        match callee:
            case s.FunctionCallee(name):
                yield name
            case s.LibraryCallee(name) if name in self._program.undefined:
                yield name
            case s.MethodCallee(_, name, str() as declared):
                yield from self._origins.methods(declared, name) - self._program.pure
                above = self._graph.bases(declared)
                known = (self._program.classes[c] for c in above if c in self._program.classes)
                methods = (f for c in known for n, f in c.methods if n == name)
                yield from (f for f in methods if f not in self._program.pure)
            case s.LibraryCallee(name, receiver) if receiver is not None:
                of = getattr(receiver, "type", t.UNKNOWN)
                if name.rpartition("::")[2] in _MAKING and not isinstance(of, t.Record):
                    is_pointer = isinstance(of, t.Reference)
                    yield from self.objects.ended(of, is_pointer)
                    yield from () if is_pointer else self.objects.made(of)
            case s.LibraryCallee(name) if "::make_" in name.partition("<")[0]:
                yield from self.objects.made(t.Record(name.partition("<")[2].rstrip(">")))
            case _:
                pass

    # --- what is not known ------------------------------------------------------------------------

    def _why(self, node: Node, function: str) -> str | None:
        match node:
            case s.Unsupported(reason, raises=True):  # others are looked at by the reader of bodies
                return f"it has no form: {reason}"
            case s.Call(_, callee, arguments):
                return self._called(callee, [a.value for a in arguments], function)
            case e.FunctionReference(name) | e.LibraryReference(name):
                return _UNDEFINED if name in self._program.undefined else None
            case e.Binary(_, left, right) | s.CompoundAssign(left, _, right):
                return self._operates((left, right), function)
            case e.Index(of) | e.Unary(_, of) | e.Convert(_, of) | s.ForEach(_, of):
                return self._operates((of,), function)
            case _:
                return None

    def _called(
        self, callee: s.Callee, values: Sequence[e.Expression], function: str
    ) -> str | None:
        match callee:
            case s.LibraryCallee(name, None):
                last = name.partition("<")[0].rpartition("::")[2]
                if last in _KEEPING or name in self._program.undefined:
                    return None
                is_held = "::" in name and any(self._is_held(v, function) for v in values)
                return _HELD if is_held else self._operates(values, function)
            case s.LibraryCallee(name, receiver) if receiver is not None:
                return self._library_method(receiver, name, values, function)
            case s.MethodCallee(receiver, name, None):
                return self._by_name(receiver, name, function) or self._operates(values, function)
            case s.MethodCallee(receiver):
                if next(self.functions(callee), None) is None:
                    return _UNDEFINED
                is_made = self._makers.of(receiver, function) is ObjectMaker.PROGRAM
                return None if is_made else _OVERRIDDEN
            case s.ValueCallee(value):
                return self._value(value, function)
            case _:
                return None

    def _library_method(
        self, receiver: e.Expression, name: str, values: Sequence[e.Expression], function: str
    ) -> str | None:
        of, last = getattr(receiver, "type", t.UNKNOWN), name.rpartition("::")[2]
        if isinstance(of, t.Record) and of.name in self._program.classes:
            return self._inherits(of.name, last)
        if isinstance(of, t.Record) and of.name in self._program.forward:
            return _UNDEFINED
        is_trusted = is_library(name) or last in libraries.looking()
        if not is_trusted and self._makers.of(receiver, function) is ObjectMaker.OTHERS:
            return _GIVEN
        return None if last in _COUNTING else self._operates((receiver, *values), function)

    def _by_name(self, receiver: e.Expression, name: str, function: str) -> str | None:
        """Of an object whose class is not known: whether a class has such a method, unread."""
        if name in ("first", "second"):
            return _HELD
        of = self._type(receiver, function)
        if isinstance(of, t.Container) and len(of.elements) == 1:
            of = led_to(of.elements[0])
        known = isinstance(of, t.Record) and of.name in self._program.classes
        owners = [of.name] if known else self._program.classes  # type: ignore[union-attr]
        methods = (m for c in owners for m in self._program.classes[c].methods)
        found = {f for n, f in methods if n.partition("(")[0] == name}
        return _UNDEFINED if found & self._program.undefined else None

    def _inherits(self, owner: str, name: str) -> str | None:
        """A method that no class of the files has: of a base that was not read."""
        line = {owner, *self._graph.bases(owner)} & self._program.classes.keys()
        above = (b or "" for c in line for b in self._program.classes[c].bases)
        bases = (b for b in above if b not in self._program.classes)
        unread = (b.rpartition("::")[2] for b in bases if not is_library(b))
        is_plain = name in libraries.node_methods() or name in libraries.looking()
        return None if is_plain or _PLAIN_BASES.issuperset(unread) else _INHERITED

    # --- values -----------------------------------------------------------------------------------

    def _value(self, value: e.Expression, function: str) -> str | None:
        """What a variable holds is called: a lambda's body stands where it was made."""
        type_ = getattr(value, "type", t.UNKNOWN)
        if isinstance(type_, t.Record):
            last = type_.name.partition("<")[0].rpartition("::")[2]
            return _HELD if last in _CALLED else None
        return None if self._is_lambda(value, function) else _HELD

    def _is_lambda(self, value: e.Expression, function: str) -> bool:
        """Whether a value surely is a lambda, whose body stands where it was made."""
        value = value.target if isinstance(value, e.AddressOf) else value
        key = key_of(value, function)
        is_local = isinstance(value, e.Local | e.Captured | e.Temporary) and key is not None
        stored = [v for _, v in self._graph.stores.of(key)] if is_local and key is not None else []
        found = [v for v in stored if not isinstance(v, AnyValue)] or [value]
        return all(isinstance(v, e.Closure) for v in found)

    def _is_held(self, value: e.Expression, function: str) -> bool:
        """Whether a value holds a function that is not known."""
        if isinstance(value, e.FunctionReference) or self._is_lambda(value, function):
            return False
        type_ = led_to(getattr(value, "type", t.UNKNOWN))
        if isinstance(type_, t.Record):
            return type_.name.partition("<")[0].rpartition("::")[2] in _CALLED
        return isinstance(type_, t.FunctionType)

    def _operates(self, values: Iterable[e.Expression], function: str) -> str | None:
        """Why a library may that gets some values: by an operator of their classes."""
        is_unread = self.objects.operates_unread(self._type(v, function) for v in values)
        return _UNDEFINED if is_unread else None

    def _type(self, value: e.Expression, function: str) -> t.Type:
        """The type that a value leads to; of an iterator that of its container."""
        type_ = led_to(getattr(value, "type", t.UNKNOWN))
        if type_ != t.UNKNOWN:
            return type_
        inner = getattr(value, "reference", None) or getattr(value, "target", None)
        if inner is not None:
            return self._type(inner, function)
        key = key_of(value, function)
        stored = (
            self._graph.stores.of(key) if isinstance(value, e.Local | e.Temporary) and key else []
        )
        for around, each in stored:
            call = getattr(each, "call", None)
            receiver = getattr(getattr(call, "callee", None), "receiver", None)
            if receiver is not None:
                return self._type(receiver, around)
        return type_
