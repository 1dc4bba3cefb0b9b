"""What a body runs though no call of it stands there: operators, properties, hooks, generators.

By what the classes of the program answer them with, whatever the operands are: all may run.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol, TypeAlias

from rebsync.records import dataclass
from rebsync.reverse.analysis.call_graph import CallGraph
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import COMPARISONS, ImplicitCall, Operator
from rebsync.reverse.ir.program import Function
from rebsync.reverse.ir.walk import Node, parts

_CONTAINED = (Operator.IN, Operator.NOT_IN)
_EQUALITY = (Operator.EQUAL, Operator.UNEQUAL)
_COMPARED = COMPARISONS - {Operator.SAME, Operator.NOT_SAME, *_CONTAINED}
_ITERATED = (ImplicitCall.ITERATE, ImplicitCall.NEXT)
# What compares elements of containers, in Python.
_COMPARING = frozenset(
    {"sort", "sorted", "max", "min", "index", "remove", "count", "insort", "insort_left"}
    | {"insort_right", "bisect", "bisect_left", "bisect_right", "heappush", "heappop", "heapify"}
    | {"heapreplace", "heappushpop", "nlargest", "nsmallest", "merge"}
)
_Values: TypeAlias = "Sequence[e.Expression] | None"
_KEYS = (ImplicitCall.HASH, Operator.EQUAL)


@dataclass(frozen=True, slots=True)
class ImplicitCalls:
    """The functions that run, and whether a library is called, which may run operators too."""

    functions: frozenset[str]
    has_library: bool


class Operands(Protocol):
    """What says which classes may answer for a value, or for what is in it."""

    def of(self, value: e.Expression, function: str, asks_elements: bool) -> frozenset[str] | None:
        """The classes; None if they are not known."""


def implicit_calls(
    graph: CallGraph, function: Function, operands: Operands | None = None
) -> ImplicitCalls:
    """What a body itself runs so, without what its calls run; without `operands` by names alone."""
    visitor = _Visitor(graph, function, operands)
    for statement in function.body:
        visitor.visit(statement)
    return ImplicitCalls(frozenset(visitor.functions), visitor.has_library)


class _Visitor:
    def __init__(self, graph: CallGraph, function: Function, operands: Operands | None) -> None:
        self.graph = graph
        self.function = function
        self.operands = operands
        self.functions: set[str] = set()
        self.has_library = False

    def visit(self, node: Node) -> None:
        """Notes what a node runs, and all within it."""
        self._note(node)
        written = _target(node)
        for part in parts(node):
            if part is written:
                self._write(part)
            else:
                self.visit(part)

    def _runs(
        self, *calls: Operator | ImplicitCall, of: _Values = None, asks_elements: bool = False
    ) -> None:
        """Notes what may answer calls, of some values if these are known."""
        found = self.graph.implicit(calls)
        self.functions |= self._of_values(found, of, asks_elements) if found else found

    def _of_values(
        self, functions: frozenset[str], of: _Values, asks_elements: bool = False
    ) -> frozenset[str]:
        """The methods among some that classes of values have; all where these are not known."""
        classes = self._classes(of, asks_elements)
        if classes is None:
            return functions
        owners = {f: self.graph.program.function(f).owner for f in functions}
        return frozenset(f for f, owner in owners.items() if owner in classes)

    def _classes(self, of: _Values, asks_elements: bool) -> frozenset[str] | None:
        found = frozenset[str]()
        for value in of or ():
            if self.operands is None:
                return None
            classes = self.operands.of(value, self.function.name, asks_elements)
            if classes is None:
                return None
            found |= classes
        return None if of is None else found

    def _iterates(self, of: _Values = None) -> None:
        self._runs(*_ITERATED, of=of)
        if self.graph.suspended and self._classes(of, False) is None:
            self.functions |= self.graph.suspended

    def _write(self, target: Node) -> None:
        """A target is stored in or deleted; what it is a part of is read."""
        match target:
            case e.Attribute(holder, name, _, dynamic):
                if dynamic:
                    self._runs(ImplicitCall.SET_ATTRIBUTE, ImplicitCall.DELETE_ATTRIBUTE)
                    self._runs(ImplicitCall.DESCRIBE)
                    for part in ("setter", "deleter"):
                        self.functions |= self.graph.accessors(name, part)
                self.visit(holder)
            case e.Index(holder, index):
                self._runs(ImplicitCall.SET_ITEM, ImplicitCall.DELETE_ITEM, of=(holder,))
                self._runs(ImplicitCall.NUMBER, *_KEYS, of=_at(index), asks_elements=True)
                if isinstance(index, e.Slice):
                    self._iterates()
                self.visit(holder)
                self.visit(index)
            case e.Dereference(reference):
                self.visit(reference)
            case _:
                pass

    def _note(self, node: Node) -> None:
        match node:
            case e.Attribute(of, name, _, True):
                self._gets(of, name)
            case e.Index(of, index):
                self._runs(ImplicitCall.GET_ITEM, of=(of,))
                self._runs(ImplicitCall.NUMBER, *_KEYS, of=_at(index), asks_elements=True)
            case e.Unary(operator, of, _, True):
                self._runs(operator, of=(of,))
            case e.Binary(operator, left, right, _, True):
                if operator not in (Operator.SAME, Operator.NOT_SAME):
                    self._binary(operator, left, right)
            case e.And(of) | e.Or(of) | e.Conditional(of) | s.If(of) | s.Assert(of):
                if node.dynamic:
                    self._runs(ImplicitCall.TRUTH, of=(of,))
            case s.Loop(test=of, dynamic=True):
                self._runs(ImplicitCall.TRUTH, of=(of,))
            case e.Convert(_, of, _, True):
                asked = ImplicitCall.NUMBER, ImplicitCall.TRUTH, ImplicitCall.TEXT
                self._runs(*asked, of=(of,), asks_elements=True)
            case e.Format(pieces, _, True):
                self._runs(ImplicitCall.TEXT, of=[p.value for p in pieces], asks_elements=True)
            case e.Spread(of) | s.Unpack(_, of):
                self._iterates((of,))
            case e.BuildMapping(_, entries):
                keys = [p.operand if isinstance(p, e.Spread) else p[0] for p in entries]
                self._runs(*_KEYS, of=keys, asks_elements=True)
            case e.Build(_, elements):
                values = [p.operand if isinstance(p, e.Spread) else p for p in elements]
                self._runs(*_KEYS, of=values, asks_elements=True)
            case s.Insert():
                self._runs(*_KEYS)
            case e.Copy() | e.Move():
                self._runs(ImplicitCall.COPY, ImplicitCall.MOVE)
            case _:
                self._statement(node)

    def _gets(self, of: e.Expression, name: str) -> None:
        """An attribute is looked up, which hooks may answer."""
        self._runs(ImplicitCall.GET_ATTRIBUTE, of=(of,))
        self.functions |= self._of_values(self.graph.accessors(name, "getter"), (of,))
        if self._classes((of,), False) != frozenset():
            self._runs(ImplicitCall.DESCRIBE)

    def _binary(self, operator: Operator, left: e.Expression, right: e.Expression) -> None:
        """An operator of classes; containers apply it to their elements."""
        both = left, right
        compares = _EQUALITY if operator in _EQUALITY else _COMPARED
        asked = compares if operator in (*_EQUALITY, *_COMPARED) else (operator,)
        self._runs(*asked, of=both, asks_elements=True)
        if operator in _CONTAINED:
            self._runs(*_COMPARED, *_KEYS, of=both, asks_elements=True)
            self._runs(*_CONTAINED, of=(right,))
            self._iterates((right,))
        self._runs(ImplicitCall.TEXT, ImplicitCall.NUMBER, of=both, asks_elements=True)

    def _statement(self, node: Node) -> None:
        match node:
            case s.CompoundAssign(target, operator, value, dynamic):
                self.visit(target)
                if dynamic:
                    self._binary(operator, target, value)
                    if not isinstance(value, e.Literal):  # a list takes what one goes through
                        self._iterates((value,))
            case s.ForEach(_, iterable):
                self._iterates((iterable,))
            case s.Yield():
                self._iterates()
            case s.Await():
                self._iterates()
                self._runs(ImplicitCall.AWAIT)
            case s.With():
                self._runs(ImplicitCall.ENTER, ImplicitCall.EXIT)
                self.has_library = True
            case s.Raise(value) if value is not None:
                self._runs(ImplicitCall.CONSTRUCT)
            case s.Handler(_, _, target) if target is not None:
                self._write(target)
            case s.Call():
                self._call(node)
            case s.Construct(_, name, _, None):
                self.has_library |= bool(self.graph.construction(name).libraries)
            case s.Destroy():
                self._runs(ImplicitCall.DESTROY)
            case s.DefineClass(_, name):
                self.functions.add(name)
                self._runs(ImplicitCall.DERIVE, ImplicitCall.DESCRIBE)
                self._runs(ImplicitCall.CONSTRUCT, ImplicitCall.CALL)
            case s.Import(_, module, _, is_program):
                modules = self.graph.program.modules
                if is_program and module in modules:  # one may be left out of the program
                    self.functions.add(modules[module])
                else:
                    self.has_library = True
            case _:
                pass

    def _call(self, node: s.Call) -> None:
        self.has_library |= bool(self.graph.targets(node, self.function).libraries)
        if any(a.stars for a in node.arguments):
            self._iterates()
        if isinstance(node.callee, s.MethodCallee) and node.callee.dynamic:
            self._gets(node.callee.receiver, node.callee.name)
        called = node.callee
        name = called.name if isinstance(called, s.MethodCallee | s.LibraryCallee) else ""
        if name.rpartition(".")[2] in _COMPARING:
            self._runs(*_COMPARED)
        self._runs(ImplicitCall.CALL)


def _at(index: e.Expression) -> Sequence[e.Expression]:
    """The values of an index, of which a slice has several."""
    if not isinstance(index, e.Slice):
        return (index,)
    return [part for part in (index.low, index.high, index.step) if part is not None]


def _target(node: Node) -> Node | None:
    """The part of a node that is stored in."""
    return getattr(node, "target", None) if isinstance(node, _STORING) else None


_STORING = (
    *(s.Assign, s.CompoundAssign, s.Declare, s.Delete, s.Call, s.Construct, s.Import),
    *(s.DefineClass, s.Yield, s.Await, s.Unsupported, s.ForEach, s.With, s.Handler),
)
