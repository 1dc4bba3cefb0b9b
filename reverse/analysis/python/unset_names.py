"""Which variables and attributes of Python may have no value yet: a definite assignment analysis.

A local variable must get a value on each way to its use; an attribute of a function's own object on
each way through the constructor of its class, or before its use in the function itself.
"""

from __future__ import annotations

from collections.abc import Iterable

from rebsync.reverse.analysis.facts import Facts, HasKey, IsBound
from rebsync.reverse.analysis.origins import ClassOrigin, Origins
from rebsync.reverse.analysis.problems import ProblemNotes
from rebsync.reverse.analysis.python.entry_attributes import is_set_at_entry
from rebsync.reverse.analysis.python.none_values import falls_through
from rebsync.reverse.analysis.stores import Member
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import Class, Function, FunctionKind
from rebsync.reverse.libraries.routines import Language

_STARTED = IsBound(e.Literal(None))  # that a function is followed from its first statement on
UNSET = "may have no value yet"
LACKS = "may have no such attribute yet"
_HOOKS = ("__getattr__", "__getattribute__")
_CALLED = frozenset({FunctionKind.FUNCTION, FunctionKind.GENERATOR, FunctionKind.COROUTINE})


class UnsetNames:
    """The names of one function: in C++ its parameters alone."""

    def __init__(self, notes: ProblemNotes) -> None:
        self._notes = notes
        self._function = notes.function
        self._program = notes.origins.graph.program

    def first(self) -> Facts:
        """What is known at the first statement of the function."""
        if self._notes.table.language is not Language.PYTHON:
            return frozenset(IsBound(e.Local(p.name, p.type)) for p in self._function.parameters)
        names = (IsBound(e.Local(p.name)) for p in self._function.parameters)
        return frozenset({_STARTED, *names})

    def check(self, value: e.Local | e.Attribute, facts: Facts) -> None:
        """Notes that what is read may have no value."""
        if _STARTED not in facts or IsBound(value) in facts:
            return
        if isinstance(value, e.Local):
            if value.name not in self._function.captured:
                self._notes.fails(value, UNSET)
        elif value.object == e.Local(self._function.receiver or "") and self._may_lack(
            value, facts
        ):
            self._notes.fails(value, LACKS)

    def _may_lack(self, value: e.Attribute, facts: Facts) -> bool:
        """Whether the own object of a function may lack an attribute when it is called."""
        owner, name = self._function.owner, value.name
        if owner is None or HasKey(value.object, e.Literal(name)) in facts:
            return False
        if self._notes.counts.rules.construction.reads_early(self._function.name, name):
            return True
        if self._function.kind not in _CALLED:
            return False
        graph = self._notes.origins.graph
        classes = {owner, *graph.subclasses.get(owner, ())} & self._program.classes.keys()
        return any(_may_lack(self._notes.origins, self._function, each, name) for each in classes)


def _may_lack(origins: Origins, function: Function, owner: str, name: str) -> bool:
    """Whether an object of a class may lack an attribute where a method of it is entered."""
    graph, program = origins.graph, origins.graph.program
    line = [owner, *graph.bases(owner)]
    known = [program.classes[c] for c in line if c in program.classes]
    if any(origins.has_method(owner, each) for each in (name, *_HOOKS)):
        return False
    declared = {p.name for c in known for p in c.properties} | {
        f.name for c in known for f in c.fields if f.is_shared
    }
    stored = [function for function, _ in graph.stores.of(Member(name))]
    bodies = {c.body for c in known}
    if name in declared or not bodies.isdisjoint(stored) or origins.names.sets_by_text:
        return False
    own = any(program.function(f).owner in line for f in stored)
    if not own:  # the attributes of libraries' classes are trusted, and what is set from outside
        return not stored and len(known) == len(line) and None not in _bases(known)
    setters = {f.rpartition(".")[2] for f in stored if program.function(f).owner in line}
    if not setters <= origins.names.read_attributes:
        return False  # what the program itself calls, it calls before it needs what that sets
    makers = (f for c in known for n, f in c.methods if n == "__init__")
    first = next(makers, None)
    made = frozenset[str]()
    if first is not None:
        made = _set_by(origins, program.function(first), frozenset())

    def sets(user: Function, node: s.Statement) -> frozenset[str]:
        return _set_at(origins, user, node, frozenset({user.name}))

    return not is_set_at_entry(origins, function, name, made, sets)


def _bases(classes: Iterable[Class]) -> set[str | None]:
    return {base for each in classes for base in each.bases}


def _set_by(origins: Origins, function: Function, active: frozenset[str]) -> frozenset[str]:
    """The attributes of its object that a function surely sets, with what it calls."""
    if function.name in active or function.receiver is None:
        return frozenset()
    return _set_in(origins, function, function.body, active | {function.name})


def _set_in(
    origins: Origins, function: Function, body: Iterable[s.Statement], active: frozenset[str]
) -> frozenset[str]:
    found = frozenset[str]()
    for node in body:
        found |= _set_at(origins, function, node, active)
    return found


def _set_at(
    origins: Origins, function: Function, node: s.Statement, active: frozenset[str]
) -> frozenset[str]:
    """The attributes that a statement surely sets, where the function goes on behind it."""

    def inside(body: s.Body) -> frozenset[str]:
        return _set_in(origins, function, body, active)

    match node:
        case s.If(_, then, otherwise) if falls_through(then) and falls_through(otherwise):
            return inside(then) & inside(otherwise)
        case s.If(_, then, otherwise):
            return inside(then if falls_through(then) else otherwise)
        case s.With(_, _, body) | s.Block(body):
            return inside(body)
        case s.Try(body, handlers, otherwise, final):
            ways = [inside((*h.prelude, *h.body)) for h in handlers if falls_through(h.body)]
            return inside((*body, *otherwise)).intersection(*ways) | inside(final)
        case s.Call(target, callee):
            called = _called(origins, function, callee)
            sets = [_set_by(origins, origins.graph.program.function(f), active) for f in called]
            own = sets[0].intersection(*sets[1:]) if sets else frozenset[str]()
            return own | _attributes(function, [target])
        case s.Unpack(targets):
            return _attributes(function, targets)
        case _:
            return _attributes(function, [getattr(node, "target", None)])


def _called(origins: Origins, function: Function, callee: s.Callee) -> frozenset[str]:
    """The methods that a call may run of the object of a function."""
    graph, line = origins.graph, list[str]()
    match callee:
        case s.MethodCallee(_, _, _, str() as after):
            line = graph.bases(after)
        case s.MethodCallee(e.Local(of)) if of == function.receiver and function.owner:
            line = [function.owner, *graph.bases(function.owner)]
        case s.MethodCallee(receiver):
            held = origins.of(receiver, function.name)
            classes = [o.name for o in held if isinstance(o, ClassOrigin) and not o.of_object]
            line = classes if len(classes) == len(held) == 1 else []
        case _:
            return frozenset()
    known = (graph.program.classes[c] for c in line if c in graph.program.classes)
    found = (f for class_ in known for name, f in class_.methods if name == callee.name)
    return frozenset(list(found)[:1])


def _attributes(function: Function, targets: Iterable[object]) -> frozenset[str]:
    own = e.Local(function.receiver or "")
    return frozenset(t.name for t in targets if isinstance(t, e.Attribute) and t.object == own)
