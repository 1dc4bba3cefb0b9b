"""What a body runs though no call of it stands there: operators, properties, hooks, generators.

By what the classes of the program answer them with, whatever the operands are: all may run.
"""

from __future__ import annotations

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
_KEYS = (ImplicitCall.HASH, Operator.EQUAL)


@dataclass(frozen=True, slots=True)
class ImplicitCalls:
    """The functions that run, and whether a library is called, which may run operators too."""

    functions: frozenset[str]
    has_library: bool


def implicit_calls(graph: CallGraph, function: Function) -> ImplicitCalls:
    """What a body itself runs so, without what its calls run."""
    visitor = _Visitor(graph, function)
    for statement in function.body:
        visitor.visit(statement)
    return ImplicitCalls(frozenset(visitor.functions), visitor.has_library)


class _Visitor:
    def __init__(self, graph: CallGraph, function: Function) -> None:
        self.graph = graph
        self.function = function
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

    def _runs(self, *calls: Operator | ImplicitCall) -> None:
        self.functions |= self.graph.implicit(calls)

    def _iterates(self) -> None:
        self._runs(*_ITERATED)
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
                self._runs(ImplicitCall.SET_ITEM, ImplicitCall.DELETE_ITEM, *_KEYS)
                self._runs(ImplicitCall.NUMBER)
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
            case e.Attribute(_, name, _, True):
                self._gets(name)
            case e.Index():
                self._runs(ImplicitCall.GET_ITEM, ImplicitCall.NUMBER, *_KEYS)
            case e.Unary(operator, _, _, True):
                self._runs(operator)
            case e.Binary(operator, _, _, _, True):
                if operator not in (Operator.SAME, Operator.NOT_SAME):
                    self._binary(operator)
            case e.And() | e.Or() | e.Conditional() | s.If() | s.Assert() | s.Loop():
                if node.dynamic:
                    self._runs(ImplicitCall.TRUTH)
            case e.Convert(_, _, _, True):
                self._runs(ImplicitCall.NUMBER, ImplicitCall.TRUTH, ImplicitCall.TEXT)
            case e.Format(_, _, True):
                self._runs(ImplicitCall.TEXT)
            case e.Spread() | s.Unpack():
                self._iterates()
            case e.BuildMapping() | e.Build() | s.Insert():
                self._runs(*_KEYS)
            case e.Copy() | e.Move():
                self._runs(ImplicitCall.COPY, ImplicitCall.MOVE)
            case _:
                self._statement(node)

    def _gets(self, name: str) -> None:
        """An attribute is looked up, which hooks may answer."""
        self._runs(ImplicitCall.GET_ATTRIBUTE, ImplicitCall.DESCRIBE)
        self.functions |= self.graph.accessors(name, "getter")

    def _binary(self, operator: Operator) -> None:
        """An operator of classes; containers apply it to their elements."""
        if operator in _EQUALITY:
            self._runs(*_EQUALITY)
        else:
            self._runs(*(_COMPARED if operator in _COMPARED else (operator,)))
        if operator in _CONTAINED:
            self._runs(*_CONTAINED, *_COMPARED)
            self._iterates()
            self._runs(*_KEYS)
        self._runs(ImplicitCall.TEXT, ImplicitCall.NUMBER)

    def _statement(self, node: Node) -> None:
        match node:
            case s.CompoundAssign(target, operator, value, dynamic):
                self.visit(target)
                if dynamic:
                    self._binary(operator)
                    if not isinstance(value, e.Literal):  # a list takes what one goes through
                        self._iterates()
            case s.ForEach() | s.Yield():
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
                if is_program:
                    self.functions.add(self.graph.program.modules[module])
                else:
                    self.has_library = True
            case _:
                pass

    def _call(self, node: s.Call) -> None:
        self.has_library |= bool(self.graph.targets(node, self.function).libraries)
        if any(a.stars for a in node.arguments):
            self._iterates()
        if isinstance(node.callee, s.MethodCallee) and node.callee.dynamic:
            self._gets(node.callee.name)
        called = node.callee
        name = called.name if isinstance(called, s.MethodCallee | s.LibraryCallee) else ""
        if name.rpartition(".")[2] in _COMPARING:
            self._runs(*_COMPARED)
        self._runs(ImplicitCall.CALL)


def _target(node: Node) -> Node | None:
    """The part of a node that is stored in."""
    return getattr(node, "target", None) if isinstance(node, _STORING) else None


_STORING = (
    *(s.Assign, s.CompoundAssign, s.Declare, s.Delete, s.Call, s.Construct, s.Import),
    *(s.DefineClass, s.Yield, s.Await, s.Unsupported, s.ForEach, s.With, s.Handler),
)
