"""Which attributes a constructor of Python reads before it has set them: in what it calls, too.

A constructor of a base runs methods of the class that is made, whose attributes may come later
(definite assignment through the calls that a constructor makes of its own object's methods).
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.analysis.stores import Member
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import Class, Function, FunctionKind
from rebsync.reverse.ir.walk import STATEMENTS, Node, parts

_DEEPEST = 12
_HOOKS = ("__getattr__", "__getattribute__")
_RUN = frozenset({FunctionKind.FUNCTION, FunctionKind.CONSTRUCTOR})


class ConstructionOrder:
    """The classes of one program."""

    def __init__(self, origins: Origins) -> None:
        self._origins = origins
        self._graph = origins.graph
        self._program = origins.graph.program

    def reads_early(self, function: str, attribute: str) -> bool:
        """Whether a function may read an attribute of its object before a constructor sets it."""
        return (function, attribute) in self._early

    @cached_property
    def _early(self) -> frozenset[tuple[str, str]]:
        found = set[tuple[str, str]]()
        if not self._origins.names.sets_by_text:
            for class_ in self._program.classes.values():
                found |= _Construction(self._origins, class_).early()
        return frozenset(found)


class _Construction:
    """The construction of an object of one class."""

    def __init__(self, origins: Origins, class_: Class) -> None:
        self._program = origins.graph.program
        self._stores = origins.graph.stores
        line = [class_.name, *origins.graph.bases(class_.name)]
        self._line = [self._program.classes[c] for c in line if c in self._program.classes]
        self._is_known = all(None not in c.bases for c in self._line)
        self._found = set[tuple[str, str]]()

    def early(self) -> set[tuple[str, str]]:
        """The attributes that are read too early, with the functions that read them."""
        maker = self._method("__init__", self._line)
        hooks = (self._method(name, self._line) for name in _HOOKS)
        if maker is not None and self._is_known and not any(hooks):
            self._body(maker, maker.body, frozenset(), (maker.name,))
        return self._found

    def _method(self, name: str, line: list[Class]) -> Function | None:
        """The method that the first of some classes has."""
        methods = (dict(c.methods).get(name) for c in line)
        found = next((f for f in methods if f is not None), None)
        return self._program.function(found) if found is not None else None

    def _is_set_here(self, name: str) -> bool:
        """Whether the line of classes alone sets an attribute, and in its objects only."""
        shared = {f.name for c in self._line for f in c.fields if f.is_shared}
        shared |= {p.name for c in self._line for p in c.properties}
        shared |= {n for c in self._line for n, _ in c.methods}
        owners = {self._program.function(f).owner for f, _ in self._stores.of(Member(name))}
        names = {c.name for c in self._line}
        return name not in shared and bool(owners) and owners <= names

    # --- statements ------------------------------------------------------------------------------

    def _body(
        self, function: Function, body: s.Body, assigned: frozenset[str], active: tuple[str, ...]
    ) -> frozenset[str]:
        """What is assigned after some statements, where some is before."""
        for node in body:
            assigned = self._statement(function, node, assigned, active)
        return assigned

    def _statement(
        self,
        function: Function,
        node: s.Statement,
        assigned: frozenset[str],
        active: tuple[str, ...],
    ) -> frozenset[str]:
        target = getattr(node, "target", None)
        for name in _read(node, function.receiver or "", target):
            if name not in assigned and self._is_set_here(name):
                self._found.add((function.name, name))

        def inside(inner: s.Body) -> frozenset[str]:
            return self._body(function, inner, assigned, active)

        match node:
            case s.If(_, then, otherwise):
                return _joined(then, otherwise, inside(then), inside(otherwise))
            case s.With(_, _, inner) | s.Block(inner):
                return inside(inner)
            case s.Try(inner, handlers, otherwise, final):
                ways = [inside((*h.prelude, *h.body)) for h in handlers]
                return inside((*inner, *otherwise)).intersection(*ways) | inside(final)
            case s.ForEach(_, _, inner) | s.Loop(_, inner):
                inside(inner)
            case s.Call(_, callee):
                assigned = self._called(function, callee, assigned, active)
            case _:
                pass
        targets = node.targets if isinstance(node, s.Unpack) else [target]
        return assigned | _attributes(function, targets)

    def _called(
        self,
        function: Function,
        callee: s.Callee,
        assigned: frozenset[str],
        active: tuple[str, ...],
    ) -> frozenset[str]:
        """What is assigned after a call of a method of the object that is made."""
        match callee:
            case s.MethodCallee(_, name, _, str() as after):
                names = [c.name for c in self._line]
                at = names.index(after) + 1 if after in names else len(names)
                called = self._method(name, self._line[at:])
            case s.MethodCallee(e.Local(of), name, None, None) if of == function.receiver:
                called = self._method(name, self._line)
            case _:
                return assigned
        if called is None or called.receiver is None or called.kind not in _RUN:
            return assigned
        if called.name in active or len(active) > _DEEPEST:
            return assigned
        return self._body(called, called.body, assigned, (*active, called.name))


def _joined(
    then: s.Body, otherwise: s.Body, first: frozenset[str], second: frozenset[str]
) -> frozenset[str]:
    """What is assigned after the one or the other branch, where both go on."""
    if _leaves(then):
        return second
    return first if _leaves(otherwise) else first & second


def _leaves(body: s.Body) -> bool:
    return bool(body) and isinstance(body[-1], s.Return | s.Raise)


def _read(node: s.Statement, receiver: str, target: object) -> Iterator[str]:
    """The attributes of an object that a statement itself reads, other than those within it."""
    waiting: list[Node] = [p for p in parts(node) if p is not target]
    own = e.Local(receiver)
    while waiting:
        part = waiting.pop()
        if isinstance(part, (*STATEMENTS, e.Closure)):
            continue
        if isinstance(part, e.Attribute) and part.object == own:
            yield part.name
        waiting += parts(part)


def _attributes(function: Function, targets: object) -> frozenset[str]:
    """The attributes of a function's own object among some targets."""
    own = e.Local(function.receiver or "")
    assert isinstance(targets, list | tuple)
    return frozenset(t.name for t in targets if isinstance(t, e.Attribute) and t.object == own)
