"""The effects of one body without those of what it calls, and what it calls."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import field

from rebsync.records import dataclass
from rebsync.reverse.analysis.call_graph import CallGraph, Targets, join_all
from rebsync.reverse.analysis.library_effects import IMPORT, WITH
from rebsync.reverse.analysis.locations import (
    CapturedVariable,
    Elements,
    GlobalVariable,
    Location,
    Member,
)
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import COMPARISONS, ImplicitCall, Operator
from rebsync.reverse.ir.program import Function
from rebsync.reverse.ir.walk import Node, parts, walk
from rebsync.source import Span


@dataclass(eq=False, slots=True)
class BodyEffects:
    """What was found in one body.

    `implicit` are functions that operators and the like may call; `calls` are calls with their
    places and targets, `passed` what may be called among the arguments of each.
    """

    reads: frozenset[Location] = frozenset()
    writes: frozenset[Location] = frozenset()
    implicit: frozenset[str] = frozenset()
    calls: list[tuple[Span, Targets]] = field(default_factory=list)
    passed: dict[Span, Targets] = field(default_factory=dict)
    may_raise: bool = False
    may_block: bool = False
    may_diverge: bool = False
    unsupported: frozenset[tuple[str, Span]] = frozenset()


_COMPARED = frozenset(o for o in COMPARISONS if o not in (Operator.SAME, Operator.NOT_SAME))
_ITERATED = (ImplicitCall.ITERATE, ImplicitCall.NEXT)
_KEYS = (ImplicitCall.HASH, Operator.EQUAL)


def local_effects(graph: CallGraph, function: Function) -> BodyEffects:
    """What a body does itself."""
    visitor = _Visitor(graph, function)
    for statement in function.body:
        visitor.visit(statement)
    return visitor.found


class _Visitor:
    def __init__(self, graph: CallGraph, function: Function) -> None:
        self.graph = graph
        self.function = function
        self.found = BodyEffects()
        self.aliases = _aliases(function)

    def visit(self, node: Node) -> None:
        """Notes what a node does, and all within it."""
        self._note(node)
        written = _target(node)
        for part in parts(node):
            if part is written:
                self._write(part)
            else:
                self.visit(part)

    # --- what is noted ---------------------------------------------------------------------------

    def _reads(self, *locations: Location) -> None:
        self.found.reads |= frozenset(locations)

    def _writes(self, *locations: Location) -> None:
        self.found.writes |= frozenset(locations)

    def _implicit(self, *calls: Operator | ImplicitCall) -> None:
        self.found.implicit |= self.graph.implicit(calls)
        self.found.may_raise = True

    def _iterates(self) -> None:
        self._implicit(*_ITERATED)
        self.found.implicit |= self.graph.suspended
        self._reads(Elements())

    def _write(self, target: Node) -> None:
        """A target is stored in or deleted; what it is a part of is read."""
        match target:
            case e.Local(name) if name in self.aliases:
                self._writes(Elements())
            case e.Local(name):
                if name in self.function.captured:
                    self._writes(CapturedVariable(self.function.name, name))
            case e.Captured(function, name):
                self._writes(CapturedVariable(function, name))
            case e.Global(module, name):
                self._writes(GlobalVariable(module, name))
            case e.Attribute(holder, name, _, dynamic):
                self._attribute(target, self._writes)
                if dynamic:
                    self._implicit(ImplicitCall.SET_ATTRIBUTE, ImplicitCall.DELETE_ATTRIBUTE)
                    self._implicit(ImplicitCall.DESCRIBE)
                    for part in ("setter", "deleter"):
                        self.found.implicit |= self.graph.accessors(name, part)
                self.visit(holder)
            case e.Index(holder, index):
                self._writes(Elements())
                self._implicit(ImplicitCall.SET_ITEM, ImplicitCall.DELETE_ITEM, *_KEYS)
                self._implicit(ImplicitCall.NUMBER)
                if isinstance(index, e.Slice):
                    self._iterates()
                self.visit(holder)
                self.visit(index)
            case e.Dereference(reference):
                self._writes(Elements(), Member(None), *self.graph.addressed)
                self.visit(reference)
            case _:
                pass

    def _attribute(self, node: e.Attribute, add: Callable[..., None]) -> None:
        add(Member(node.name))
        if isinstance(node.object, e.ModuleReference):
            add(GlobalVariable(node.object.name, node.name))

    def _note(self, node: Node) -> None:
        match node:
            case e.Local(name) if name in self.aliases:
                self._reads(Elements())
            case e.Local(name):
                if name in self.function.captured:
                    self._reads(CapturedVariable(self.function.name, name))
                self.found.may_raise = True
            case e.Captured(function, name):
                self._reads(CapturedVariable(function, name))
                self.found.may_raise = True
            case e.Global(module, name):
                self._reads(GlobalVariable(module, name))
                self.found.may_raise = True
            case e.Attribute(_, name, _, dynamic):
                self._attribute(node, self._reads)
                self.found.may_raise = True
                if dynamic:
                    self._implicit(ImplicitCall.GET_ATTRIBUTE, ImplicitCall.DESCRIBE)
                    self.found.implicit |= self.graph.accessors(name, "getter")
            case e.Index():
                self._reads(Elements())
                self._implicit(ImplicitCall.GET_ITEM, ImplicitCall.NUMBER, *_KEYS)
            case e.Dereference():
                self._reads(Elements(), Member(None), *self.graph.addressed)
                self.found.may_raise = True
            case _:
                self._operation(node)

    def _operation(self, node: Node) -> None:
        match node:
            case e.Unary(operator, _, _, True):
                self._implicit(operator)
            case e.Binary(operator, _, _, _, dynamic):
                self.found.may_raise = True
                if dynamic and operator not in (Operator.SAME, Operator.NOT_SAME):
                    self._binary(operator)
            case e.And() | e.Or() | e.Conditional() | s.If() | s.Assert() | s.Loop():
                self.found.may_diverge |= isinstance(node, s.Loop)
                self.found.may_raise |= isinstance(node, s.Assert)
                if node.dynamic:
                    self._implicit(ImplicitCall.TRUTH)
            case e.Convert(_, _, _, dynamic):
                self.found.may_raise = True
                if dynamic:
                    self._implicit(ImplicitCall.NUMBER, ImplicitCall.TRUTH, ImplicitCall.TEXT)
            case e.Format(_, _, True):
                self._implicit(ImplicitCall.TEXT)
                self._reads(Elements(), Member(None))
            case e.Spread() | s.Unpack():
                self._iterates()
            case e.BuildMapping() | e.Build() | s.Insert():
                self._implicit(*_KEYS)
            case e.Copy() | e.Move():
                self._reads(Elements(), Member(None))
                self._implicit(ImplicitCall.COPY, ImplicitCall.MOVE)
            case _:
                self._statement(node)

    def _binary(self, operator: Operator) -> None:
        """An operator of classes; containers apply it to their elements."""
        self._implicit(*(_COMPARED if operator in _COMPARED else (operator,)))
        if operator in (Operator.IN, Operator.NOT_IN):
            self._iterates()
            self._implicit(*_KEYS)
        self._implicit(ImplicitCall.TEXT, ImplicitCall.NUMBER)
        self._reads(Elements())

    def _statement(self, node: Node) -> None:
        match node:
            case s.CompoundAssign(target, operator, _, dynamic):
                self.visit(target)
                if dynamic:
                    self._binary(operator)
                    self._writes(Elements())
                    self._iterates()
            case s.ForEach(_, iterable):
                self._iterates()
                self.found.may_diverge |= not isinstance(iterable, e.Build)
                self.found.may_block |= node.waits
            case s.With(_, _, _, waits):
                self._implicit(ImplicitCall.ENTER, ImplicitCall.EXIT)
                self._unknown_context(node)
                self.found.may_block |= waits
            case s.Raise(value):
                self.found.may_raise = True
                if value is not None:
                    self._implicit(ImplicitCall.CONSTRUCT)
            case s.Handler(_, _, target):
                if target is not None:
                    self._write(target)
            case s.Yield() | s.Await():
                self._suspends(node)
            case s.Call() | s.Construct() | s.Destroy() | s.DefineClass() | s.Import():
                self.found.may_raise = True
                self._call(node)
            case s.Unsupported(reason):
                self.found.unsupported |= {(reason, node.place)}
            case _:
                pass

    def _suspends(self, node: s.Yield | s.Await) -> None:
        """Whoever asks for the next element may do anything in between."""
        self._iterates()
        self.found.may_block = True
        if isinstance(node, s.Await):
            self._implicit(ImplicitCall.AWAIT)
            self.found.calls.append((node.place, Targets(unknown=True)))

    def _unknown_context(self, node: s.With) -> None:
        """What a library's context does when it is entered and left."""
        self.found.calls.append((node.place, Targets(libraries=frozenset({WITH}))))

    # --- calls -----------------------------------------------------------------------------------

    def _call(self, node: s.Call | s.Construct | s.Destroy | s.DefineClass | s.Import) -> None:
        match node:
            case s.Call(_, callee, arguments):
                targets = self.graph.targets(node, self.function)
                self.found.calls.append((node.place, targets))
                values = [a.value for a in arguments]
                self._pass(node.place, values)
                if any(a.stars for a in arguments):
                    self._iterates()
                if isinstance(callee, s.MethodCallee):
                    self._method(callee)
                self._implicit(ImplicitCall.CALL)
            case s.Construct(_, name, _, constructor):
                known = Targets(frozenset({constructor})) if constructor is not None else None
                self.found.calls.append((node.place, known or self.graph.construction(name)))
            case s.Destroy():
                self._implicit(ImplicitCall.DESTROY)
            case s.DefineClass(_, name, bases):
                self.found.implicit |= {name}
                self._implicit(ImplicitCall.DERIVE, ImplicitCall.DESCRIBE)
                self._implicit(ImplicitCall.CONSTRUCT, ImplicitCall.CALL)
                if any(a.name is not None for a in bases):
                    self.found.calls.append((node.place, Targets(unknown=True)))
            case s.Import(_, module, _, is_program):
                if is_program:
                    self.found.implicit |= {self.graph.program.modules[module]}
                else:
                    self.found.calls.append((node.place, Targets(libraries=frozenset({IMPORT}))))

    def _method(self, callee: s.MethodCallee) -> None:
        """Looking a method up reads the attribute, which hooks may answer."""
        self._reads(Member(callee.name))
        if callee.dynamic:
            self._implicit(ImplicitCall.GET_ATTRIBUTE, ImplicitCall.DESCRIBE)
            self.found.implicit |= self.graph.accessors(callee.name, "getter")

    def _pass(self, place: Span, values: Iterable[e.Expression]) -> None:
        found = join_all(self._passed(value) for value in values)
        before = self.found.passed.get(place, Targets())
        self.found.passed[place] = before.join(found)

    def _passed(self, value: e.Expression) -> Targets:
        """What may be called of an argument; numbers and texts cannot be."""
        if isinstance(value, e.Literal | e.Format | e.Binary | e.Unary):
            return Targets()
        return self.graph.value(value, self.function)


def _aliases(function: Function) -> frozenset[str]:
    """The variables of a function that stand for elements of what is iterated."""
    loops = (n for n in walk(function) if isinstance(n, s.ForEach) and n.by_reference)
    targets = (loop.target for loop in loops)
    return frozenset(target.name for target in targets if isinstance(target, e.Local))


def _target(node: Node) -> Node | None:
    """The part of a node that is stored in."""
    return getattr(node, "target", None) if isinstance(node, _STORING) else None


_STORING = (
    *(s.Assign, s.CompoundAssign, s.Declare, s.Delete, s.Call, s.Construct, s.Import),
    *(s.DefineClass, s.Yield, s.Await, s.Unsupported, s.ForEach, s.With, s.Handler),
)
