"""Which values of Python may be None where something is asked of them: a null-dereference analysis.

By what is stored under a name anywhere in the program, and by what was tested or stored on the way.
"""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.reverse.analysis.facts import Facts, Holds, IsThere, names_of, tested
from rebsync.reverse.analysis.held_values import is_of_other, is_own
from rebsync.reverse.analysis.origins import LibraryOrigin
from rebsync.reverse.analysis.problems import ParameterNeed, ProblemNotes
from rebsync.reverse.analysis.python.format_strings import numbers_of, styles_in
from rebsync.reverse.analysis.python.unpacked_values import UnpackedValues
from rebsync.reverse.analysis.python.value_types import ContainerType, OwnType
from rebsync.reverse.analysis.stores import CallResult, Stored, is_none, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.ir.program import Function, FunctionKind
from rebsync.reverse.ir.walk import Node, walk
from rebsync.reverse.libraries.routines import Language

# Operators that None has too.
_OF_ANYTHING = frozenset(
    {Operator.SAME, Operator.NOT_SAME, Operator.EQUAL, Operator.UNEQUAL}
    | {Operator.IN, Operator.NOT_IN}
)
_OF_NUMBERS = (Operator.NEGATE, Operator.PLUS, Operator.INVERT)
_DEEPEST = 3
_DRAWING = frozenset({"get", "pop", "popleft", "setdefault"})  # methods that give an element
_FIRST = frozenset({FunctionKind.CONSTRUCTOR, FunctionKind.CLASS, FunctionKind.MODULE})


class NoneValues:
    """The values of one function, in Python."""

    def __init__(self, notes: ProblemNotes) -> None:
        self._notes = notes
        self._origins = notes.origins
        self._graph = notes.origins.graph
        self._name = notes.function.name
        self._loops: list[s.ForEach] | None = None
        self._asked: set[e.Expression] = set()  # while copies are followed
        self._unpacked = UnpackedValues(self._graph, notes.counts.rules.arguments)

    def check(
        self,
        value: e.Expression,
        node: s.Statement | e.Expression,
        facts: Facts,
        failure: str = "is None",
    ) -> None:
        """Notes that something is asked of a value that None has not."""
        if self._notes.table.language is not Language.PYTHON:
            return
        if self.may_be(value, facts):
            self._notes.fails(node, failure)
        elif (given := self.given(value, facts)) is not None:
            self._notes.fails(node, failure, given)

    def computed(self, value: e.Expression, facts: Facts) -> None:
        """Notes what an expression asks of its parts that None has not."""
        match value:
            case e.Attribute(of):
                self.check(of, value, facts, "asks None for an attribute")
            case e.Index(of) | e.Binary(Operator.IN | Operator.NOT_IN, _, of):
                self.check(of, value, facts)
            case e.Binary(Operator.FLOOR_MODULO, left, e.Build(_, parts)):
                for text in self._notes.texts_of(left):
                    for part in numbers_of(text, parts):
                        if not isinstance(part, e.Spread):
                            self.check(part, value, facts)
            case e.Binary(operator, left, right) if operator not in _OF_ANYTHING:
                self.check(left, value, facts)
                self.check(right, value, facts)
            case e.Unary(operator, of) if operator in _OF_NUMBERS:
                self.check(of, value, facts)
            case e.Format(pieces):
                for piece in pieces:
                    if piece.style not in (None, e.Literal("")) and not piece.conversion:
                        self.check(piece.value, value, facts)
            case _:
                pass

    def filled(self, node: s.Call, text: e.Expression, facts: Facts) -> None:
        """Notes that `format` puts None into a text in a style that it has not."""
        given: dict[object, e.Expression] = dict(
            enumerate(a.value for a in node.arguments if a.name is None)
        )
        given |= {a.name: a.value for a in node.arguments if a.name is not None}
        for piece in {p for each in self._notes.texts_of(text) for p, _ in styles_in(each)}:
            if piece in given:
                self.check(given[piece], node, facts)

    def given(self, value: e.Expression, facts: Facts) -> ParameterNeed | None:
        """The parameter of the function that a value is, if nothing says that it is not None."""
        is_known = any(fact in facts for fact in (Holds(value), IsThere(value)))
        if is_known or not isinstance(value, e.Local) or not self._notes.is_parameter(value):
            return None
        is_own = value.name == self._notes.function.receiver
        return None if is_own else ParameterNeed(self._name, value.name)

    def is_default(self, function: str, parameter: str) -> bool:
        """Whether a parameter is None where no argument is for it."""
        return parameter in self._graph.stores.absent_by_default.get(function, ())

    def has_none(self, container: e.Expression, function: str = "") -> bool:
        """Whether None may be stored in a container of a function as an element."""
        types = self._notes.counts.rules.types.of(container, function or self._name)
        own = [each for each in types if isinstance(each, ContainerType)]
        return any(OwnType.NONE in each.elements | each.values for each in own)

    def may_be(self, value: e.Expression, facts: Facts) -> bool:
        """Whether a value may be None."""
        while isinstance(value, e.Convert):
            value = value.operand
        names = names_of(facts, value)
        if any(Holds(name) in facts for name in names):
            return False
        match value:
            case e.Conditional(test, one, other):
                if self.may_be(one, tested(facts, test, True)):
                    return True
                return self.may_be(other, tested(facts, test, False))
            case e.Or(left, right):
                return self.may_be(right, tested(facts, left, False))
            case e.And(left, right):
                return self.may_be(left, facts) or self.may_be(right, tested(facts, left, True))
        is_there = any(IsThere(name) in facts for name in names)
        if is_there and self._is_variable(value):
            return False
        nothing = list(self._nothing(value, facts))
        if is_there:
            # Whatever ran since then, it was not what makes objects, or it made another one.
            nothing = [n for n in nothing if self._graph.program.function(n).kind not in _FIRST]
        return bool(nothing)

    def gives(self, call: s.Call) -> bool:
        """Whether a call of the function may give None."""
        return self._gives_nothing(call, self._name, 0)

    def _is_variable(self, value: e.Expression) -> bool:
        """Whether a value is a variable in which the function alone stores."""
        is_shared = isinstance(value, e.Local) and value.name in self._notes.function.captured
        return isinstance(value, e.Local | e.Temporary) and not is_shared

    def _is_copied(self, value: e.Expression, facts: Facts) -> bool:
        """Whether a variable may have been given None that is stored under another name."""
        if not self._is_variable(value) or value in self._asked or self._is_parameter(value):
            return False
        key = key_of(value, self._name)
        stored = [*(self._graph.stores.of(key) if key is not None else ())]
        stored += self._unpacked.of(value, self._name)
        self._asked.add(value)
        try:
            return any(
                self._is_own(v) and self.may_be(v, facts)
                for function, v in stored
                if function == self._name
            )
        finally:
            self._asked.discard(value)

    def _is_own(self, value: object) -> bool:
        """Whether the program alone stores what a value is: in a variable, or in its objects."""
        match value:
            case e.Attribute(of):
                return is_own(self._origins, of, self._name)
            case e.Local() | e.Temporary() | e.Global() | e.Captured() | e.Conditional():
                return True
            case _:
                return False

    def _is_parameter(self, value: e.Expression) -> bool:
        return isinstance(value, e.Local) and self._notes.is_parameter(value)

    def _nothing(self, value: e.Expression, facts: Facts) -> Iterator[str]:
        """The functions that store None under the name of a value."""
        if self._is_copied(value, facts):
            yield self._name
        if isinstance(value, e.Literal) and value.value is None:
            yield self._name
        if isinstance(value, e.Index) and self.has_none(value.object):
            yield self._name
        if isinstance(value, e.Local) and any(map(self.has_none, self._gone_through(value))):
            yield self._name
        if any(self._is_nothing(each, 0) for each in self._unpacked.of(value, self._name)):
            yield self._name
        key = key_of(value, self._name)
        stored = self._graph.stores.of(key) if key is not None else ()
        for each in stored:
            here = self._notes.function
            if self._is_nothing(each, 0) and not is_of_other(
                self._graph, here, value, key, each[0]
            ):
                yield each[0]

    def unpacks_wrongly(self, node: s.Unpack) -> bool:
        """Whether a sequence may have more or fewer parts than it is unpacked into."""
        is_python = self._notes.table.language is Language.PYTHON
        return is_python and self._unpacked.has_another_length(node, self._name)

    def _gone_through(self, element: e.Local) -> Iterator[e.Expression]:
        """The containers of which a variable of the function is an element in a loop."""
        if self._loops is None:
            self._loops = [n for n in walk(self._notes.function) if isinstance(n, s.ForEach)]
        return (loop.iterable for loop in self._loops if loop.target == element)

    def _is_nothing(self, stored: Stored, depth: int) -> bool:
        function, value = stored
        match value:
            case e.Literal(None):
                return True
            case e.Conditional(_, one, other) | e.And(one, other):
                return any(self._is_nothing((function, each), depth) for each in (one, other))
            case e.Or(_, other) | e.Convert(_, other):
                return self._is_nothing((function, other), depth)
            case CallResult(call):
                return self._gives_nothing(call, function, depth)
            case e.Index(of):
                return self.has_none(of, function)
            case e.Temporary() | e.Local() if depth < _DEEPEST:
                key = key_of(value, function)
                found = [*(self._graph.stores.of(key) if key is not None else ())]
                found += self._unpacked.of(value, function)
                return any(self._is_nothing(each, depth + 1) for each in found)
            case _:
                return False

    def _gives_nothing(self, call: s.Call, function: str, depth: int) -> bool:
        """Whether a call may give None, and something else: no code asks anything of None alone."""
        match call.callee:
            case s.LibraryCallee(name) if self._notes.table.function(name).may_be_none:
                return len(call.arguments) < 2 or not name.endswith("get")
            case s.MethodCallee(receiver, "get") if len(call.arguments) == 1:
                return self._origins.of(receiver, function) == {LibraryOrigin("dict", True)}
            case s.MethodCallee(receiver, name) if name in _DRAWING and self.has_none(
                receiver, function
            ):
                return True
            case s.MethodCallee(receiver, name) if self._may_give_none(receiver, name, function):
                return True
            case callee:
                around = self._graph.program.function(function)
                called = self._graph.callee(callee, around).functions
        return depth < _DEEPEST and any(self._returns_nothing(name, depth + 1) for name in called)

    def _may_give_none(self, receiver: e.Expression, method: str, function: str) -> bool:
        """Whether a method of a library may give None, by the class of its object."""
        held = self._origins.of(receiver, function)
        classes = (o.name for o in held if isinstance(o, LibraryOrigin) and o.of_object)
        return any(self._notes.table.method(each, method).may_be_none for each in classes)

    def _is_kept(self, function: Function, value: e.Expression) -> bool:
        """Whether None is stored under a name that a function gives back without any test."""
        if not isinstance(value, e.Attribute | e.Global):
            return False
        key = key_of(value, function.name)
        stored = self._graph.stores.of(key) if key is not None else []
        is_tested = any(_asks(node, value) for node in walk(function))
        is_set = any(isinstance(n, s.Assign | s.Call) and n.target == value for n in walk(function))
        return not is_tested and not is_set and any(is_none(v) for _, v in stored)

    def _returns_nothing(self, name: str, depth: int) -> bool:
        function = self._graph.program.function(name)
        if function.kind is not FunctionKind.FUNCTION:
            return False
        values = [n.value for n in walk(function) if isinstance(n, s.Return)]
        some = [v for v in values if v is not None]
        nothing = [
            v for v in some if self._is_nothing((name, v), depth) or self._is_kept(function, v)
        ]
        if all(map(is_none, some)) and self._is_overridden(function):
            return False
        return bool(nothing) or None in values or falls_through(function.body)

    def _is_overridden(self, function: Function) -> bool:
        """Whether a method is there for the classes below to have it in its place."""
        owner, name = function.owner or "", function.name.rpartition(".")[2]
        below = self._graph.subclasses.get(owner, set()) - {owner}
        classes = (self._graph.program.classes.get(each) for each in below)
        return any(name in dict(c.methods) for c in classes if c is not None)


def _asks(node: Node, value: e.Expression) -> bool:
    """Whether a node tests something of a value."""
    match node:
        case s.If(test) | s.Loop(test) | s.Assert(test) | e.Conditional(test):
            return value in walk(test) or value == test
        case e.And(left) | e.Or(left):
            return value in walk(left) or value == left
        case _:
            return False


def falls_through(body: s.Body) -> bool:
    """Whether a body may come to its end, as far as its last statement says."""
    match body[-1] if body else None:
        case s.Return() | s.Raise() | s.Break() | s.Continue():
            return False
        case s.If(e.Literal(True), then):
            return falls_through(then)
        case s.If(_, then, otherwise):
            return falls_through(then) or falls_through(otherwise)
        case s.With(_, _, inner) | s.Block(inner):
            return falls_through(inner)
        case s.Try(inner, handlers, otherwise, final):
            if final and not falls_through(final):
                return False
            ways = (*inner, *otherwise), *(h.body for h in handlers)
            return any(map(falls_through, ways))
        case s.Loop(e.Literal(True), inner):
            return any(isinstance(n, s.Break) for n in walk(inner))
        case _:
            return True
