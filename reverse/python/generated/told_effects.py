"""Effects of statements that may only tell people something, by their intermediate form.

A statement does nothing to the model if what it stores lies in places that nothing of the model
looks at, and if nothing that it can reach is the model's. So this is an escape analysis: a value is
free if no array of the model, and not the node itself, can be reached from it. Numbers, truth
values and texts are free, so is what is made of free values; only free values are stored, and given
to functions. Arrays are looked at: their elements are numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import field as with_default
from functools import cached_property

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.analysis.origins import (
    ClassOrigin,
    FunctionOrigin,
    LibraryOrigin,
    Origin,
    Origins,
)
from rebsync.reverse.analysis.python.value_types import ValueTypes
from rebsync.reverse.analysis.stores import key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.ir.program import Function
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.libraries.effects import of_function
from rebsync.reverse.libraries.routines import Effect, Language
from rebsync.reverse.libraries.tables.runtime import names_in_model
from rebsync.reverse.python.bodies.body_form import PyForm
from rebsync.reverse.python.generated.told_calls import is_known, method_takes, takes
from rebsync.reverse.syntax.py_tree import Py
from rebsync.source import Span

_SCALARS = (t.Integer, t.Float, t.Truth, t.Text)
_LOG_LEVELS = frozenset({"debug", "info", "warn", "warning", "error", "fatal", "critical"})
_SUPPRESS = "contextlib.suppress"
_CONTEXTS = frozenset({LibraryOrigin(_SUPPRESS, True)})
_ASKING = frozenset({"get", "items", "keys", "values", "index", "count"})  # of a constant table
# What only gives a number, or a text, of what it gets; the rest goes through its elements.
_WHOLE = frozenset({"str", "repr", "len", "int", "float", "bool", "abs", "round"})


@dataclass(frozen=True, eq=False, slots=True)
class ToldPlaces:
    """Where a function may keep what is told: attributes of the object, and locals.

    `publishers` are attributes that publish what only people look at; `logs` says whether the
    object has a logger of its own, as nodes of rclpy have.
    """

    attributes: Collection[str] = ()
    locals: Collection[str] = ()
    publishers: Collection[str] = ()
    logs: bool = False


class ToldEffects:
    """Those of one class of the model; `variables` are its state, by attributes."""

    def __init__(
        self, form: PyForm, variables: Mapping[str, m.Type], constants: Collection[str]
    ) -> None:
        self.form = form
        self.plain = {n for n, type_ in variables.items() if not type_.dimensions} | {*constants}
        self.arrays = {n for n, type_ in variables.items() if len(type_.dimensions) == 1}
        self.foreign: dict[str, bool] = {}

    @cached_property
    def origins(self) -> Origins:
        """What values may be."""
        return self.form.origins

    def only_tells(self, py: Py, place: Span, places: ToldPlaces) -> bool:
        """Whether the statements at a place of a method do nothing but to compute and to keep."""
        function, body = self.form.statements(py, place)
        if function is None or function.receiver is None or not body:
            return False
        scope = _Scope(self, function, places)
        if not scope.body(body):
            return False
        acting = self.form.acting(function, place)
        return all(problem.place in scope.known for problem in acting)

    def is_foreign(self, name: str) -> bool:
        """Whether a function does nothing to the model where it gets free values only."""
        body = self.form.program.function(name).body
        return not any(isinstance(n, e.Captured) for n in walk(body)) and self.is_closed(name)

    def is_closed(self, name: str) -> bool:
        """The same of one that gets free values only from around it as well."""
        if name not in self.foreign:
            self.foreign[name] = False  # while it is looked at: none may call itself
            function = self.form.program.function(name)
            self.foreign[name] = _Scope(self, function, None).body(function.body)
        return self.foreign[name]


@dataclass(eq=False, slots=True)
class _Scope:
    """One function, or some statements of a method; without `places` it is no method of the model.

    A generator that is written within a method has that `outside`. `tables` are locals and temporaries that hold an array of the model, and so are only looked at;
    `loggers` those that hold a logger; `known` the places of calls of which the
    rest of the form does not know what they do.
    """

    effects: ToldEffects
    function: Function
    places: ToldPlaces | None
    tables: set[e.Expression] = with_default(default_factory=set)
    made: set[e.Expression] = with_default(default_factory=set)
    loggers: set[e.Expression] = with_default(default_factory=set)
    known: set[Span] = with_default(default_factory=set)
    outside: _Scope | None = None
    loops: int = 0

    @property
    def _is_all_own(self) -> bool:
        """Whether the whole function is looked at, and its locals are its own."""
        return self.places is None or self.outside is not None

    # --- statements -----------------------------------------------------------------------------

    def body(self, body: s.Body) -> bool:
        """Whether some statements only compute, and keep what they made."""
        return all(map(self._statement, body))

    def _statement(self, node: s.Statement) -> bool:
        match node:
            case s.Evaluate(value):
                return self.is_free(value)
            case s.Declare(target, _, None):
                return self._is_place(target)
            case s.Assign(target, value) | s.Declare(target, _, e.Expression() as value):
                return self._keeps(target, value)
            case s.CompoundAssign(target, _, value):
                is_kept = self._is_place(target) and self.is_free(value)
                return is_kept and self._is_typed(target, value)
            case s.Unpack(targets, value):
                self.made.update(targets)
                return self._is_seen(value) and self._is_typed(value)
            case s.Insert(container, value, key):
                return container in self.made and self.is_free(value) and self._is_free(key)
            case s.Delete(target):
                return self._is_place(target)
            case s.Call() | s.Construct():
                return self._called(node)
            case s.Return(value):
                return self._is_all_own and self._is_free(value)
            case s.Yield(target, value):
                return self._is_all_own and target is None and self.is_free(value)
            case s.Break() | s.Continue():
                return self.loops > 0
            case _:
                return self._structured(node)

    def _structured(self, node: s.Statement) -> bool:
        match node:
            case s.Block(body):
                return self.body(body)
            case s.If(test, then, otherwise):
                return self._is_seen(test) and self.body(then) and self.body(otherwise)
            case s.With(context, target, body, waits=False):
                held = self.effects.origins.of(context, self.function.name)
                if target is not None:
                    self.made.add(target)
                return held <= _CONTEXTS and self.body(body)
            case s.Try(body, handlers, otherwise, final):
                caught = all(self.body((*h.prelude, *h.body)) for h in handlers)
                kept = all(h.target is None or self._is_place(h.target) for h in handlers)
                return caught and kept and all(map(self.body, (body, otherwise, final)))
            case s.ForEach(target, iterable, body, otherwise, waits=False):
                is_read = self._is_seen(iterable) and self._is_typed(iterable)
                is_read = is_read and self._is_place(target)
                return is_read and self._repeated(body) and self.body(otherwise)
            case s.Loop(test, body, prelude, step, otherwise):
                is_read = self._repeated((*prelude, *body, *step)) and self._is_seen(test)
                return is_read and self.body(otherwise)
            case _:
                return False

    def _repeated(self, body: s.Body) -> bool:
        self.loops += 1
        found = self.body(body)
        self.loops -= 1
        return found

    def _keeps(self, target: e.Lvalue, value: e.Expression) -> bool:
        """Whether a value may be kept in a place; a temporary may stand for an array too."""
        if isinstance(target, e.Temporary) and value in self.loggers:
            self.loggers.add(target)
            return True
        if isinstance(target, e.Temporary) and self._is_table(value):
            self.tables.add(target)
            return True
        return self.is_free(value) and self._is_place(target)

    def _is_place(self, target: e.Lvalue) -> bool:
        """Whether nothing of the model looks at a place."""
        match target:
            case e.Temporary():
                self.made.add(target)
                return target not in self.tables
            case e.Local(name):
                is_inner = "@" in name or self._is_all_own
                if is_inner:
                    self.made.add(target)
                return is_inner or (self.places is not None and name in self.places.locals)
            case e.Attribute(of, name) if self._is_object(of):
                return self.places is not None and name in self.places.attributes
            case e.Attribute(of):
                return self._is_own(of) and self.is_free(of)
            case e.Index(of, index):
                return self._is_seen(index) and self._is_kept(of)
            case _:
                return False

    def _is_kept(self, value: e.Expression) -> bool:
        """Whether a value is free, and none that a module, a class or a library keeps."""
        kept = (e.Global, e.LibraryReference, e.ClassReference, e.ModuleReference)
        return self.is_free(value) and not any(isinstance(n, kept) for n in walk((value,)))  # type: ignore[arg-type]

    def _is_own(self, value: e.Expression) -> bool:
        """Whether a value is an object of a class that is known."""
        held = self._held(value)
        return bool(held) and all(isinstance(o, ClassOrigin) and o.of_object for o in held)

    def _held(self, value: e.Expression) -> frozenset[Origin]:
        """What a value may be; the object of a method is of its class."""
        owner, receiver = self.function.owner, self.function.receiver
        if isinstance(value, e.Local) and value.name == receiver and owner is not None:
            return frozenset({ClassOrigin(owner)})
        return self.effects.origins.of(value, self.function.name)

    # --- types ----------------------------------------------------------------------------------

    def _types(self, value: e.Expression) -> ValueTypes:
        """The types of what a value may be: it must not fail where it is used."""
        return self.effects.form.kinds(self.function).types(value, frozenset())

    def _is_typed(self, *values: e.Expression) -> bool:
        return all(is_known(self._types(value)) for value in values)

    def _arguments(self, node: s.Call) -> list[tuple[str | None, ValueTypes]]:
        return [(a.name, self._types(a.value)) for a in node.arguments]

    # --- values ---------------------------------------------------------------------------------

    def _is_free(self, value: e.Expression | None) -> bool:
        return value is None or self.is_free(value)

    def is_free(self, value: e.Expression) -> bool:
        """Whether nothing of the model can be changed through a value."""
        match value:
            case e.Literal() | e.LibraryReference():
                return True
            case e.FunctionReference(name):
                return self.effects.is_foreign(name)
            case e.Closure(name, captures, defaults):
                kept = all(self.is_free(c.variable) for c in captures)
                given = all(self.is_free(d) for _, d in defaults)
                return kept and given and self.effects.is_closed(name)
            case e.Temporary():
                return value in self.made
            case e.Local() | e.Captured():
                return self._is_free_local(value)
            case e.Global():
                return self._is_free_global(value)
            case e.Attribute(of, name) if self._is_object(of):
                told = self.places.attributes if self.places is not None else ()
                return name in told or name in self.effects.plain
            case e.Attribute(of, name):
                return self.is_free(of) and self._is_known(of, name)
            case e.Index(of, index):
                is_seen = self._is_seen(index) and self._is_seen(of, whole=False)
                return is_seen and self._is_typed(of)
            case e.Unary(operator, operand):
                return self._is_seen(operand) and (
                    operator is Operator.NOT or self._is_typed(operand)
                )
            case e.Binary(operator, left, right):
                return (self._is_seen(left) and self._is_seen(right)) and (
                    operator in _OF_ANYTHING or self._is_typed(left, right)
                )
            case e.Conditional(test, then, otherwise):
                return self._is_seen(test) and self.is_free(then) and self.is_free(otherwise)
            case e.And(left, right) | e.Or(left, right):
                return self.is_free(left) and self.is_free(right)
            case e.Slice(low, high, step):
                return all(map(self._is_free, (low, high, step)))
            case e.Copy(operand) | e.Move(operand):
                return self.is_free(operand)
            case _:
                return self._is_made(value)

    def _is_made(self, value: e.Expression) -> bool:
        match value:
            case e.Build(_, elements):
                return all(map(self._is_part, elements))
            case e.BuildMapping(_, entries):
                return all(
                    self._is_part(x)
                    if isinstance(x, e.Spread)
                    else self.is_free(x[0]) and self.is_free(x[1])
                    for x in entries
                )
            case e.Format(pieces):
                styled = [p for p in pieces if p.style is not None]
                fits = all(self._is_free(p.style) and self._is_typed(p.value) for p in styled)
                return fits and all(self._is_seen(p.value) for p in pieces)
            case _:
                return False

    def _is_part(self, value: e.Expression | e.Spread) -> bool:
        return self._is_seen(value.operand, whole=False) if isinstance(value, e.Spread) else (
            self.is_free(value)
        )

    def _is_seen(self, value: e.Expression, *, whole: bool = True) -> bool:
        """Whether a value is free, or an array that is only looked at.

        What is looked at as a `whole` may be any local: a number or a text is made of it.
        """
        if self._is_table(value) or self.is_free(value):
            return True
        return whole and isinstance(value, e.Local) and not self._is_object(value)

    def _is_table(self, value: e.Expression) -> bool:
        """Whether a value is an array of the model, or a constant, with numbers and texts in it."""
        match value:
            case e.Attribute(of, name) if self._is_object(of):
                return name in self.effects.arrays
            case e.Global():
                return self._is_constant_table(value)
            case e.Local() if self.places is not None and self.outside is None:
                type_ = self._type_of(value)
                return isinstance(type_, t.Array) and isinstance(type_.element, _SCALARS)
            case _:
                return value in self.tables

    def _is_free_local(self, value: e.Local | e.Captured) -> bool:
        if self._is_object(value) or value in self.tables:
            return False
        if isinstance(value, e.Captured):
            return self.outside is None or self.outside.is_free(e.Local(value.name))
        if self.places is None or self.outside is not None or value in self.made:
            return True
        if value.name in self.places.locals:
            return True
        return isinstance(self._type_of(value), _SCALARS)

    def _type_of(self, value: e.Local) -> t.Type | None:
        """The type of a parameter."""
        return next((p.type for p in self.function.parameters if p.name == value.name), None)

    def _is_object(self, value: e.Expression) -> bool:
        """Whether a value is the object of the model itself."""
        if self.outside is not None:
            is_captured = isinstance(value, e.Captured)
            return is_captured and self.outside._is_object(e.Local(value.name))
        is_local = self.places is not None and isinstance(value, e.Local)
        return is_local and value.name == self.function.receiver

    def _is_free_global(self, value: e.Global) -> bool:
        """Whether a variable of a module is a function or class, a logger, or one plain value."""
        held = self.effects.origins.of(value, self.function.name)
        if held and all(o == _LOGGER or self._enters(o) for o in held):
            return True
        return isinstance(self._only_value(value), e.Literal)

    def _only_value(self, value: e.Global) -> e.Expression | None:
        """What a variable of a module is, if only one thing is ever stored there."""
        key = key_of(value, self.function.name)
        stored = self.effects.origins.graph.stores.of(key) if key is not None else []
        only = stored[0][1] if len(stored) == 1 else None
        return only if isinstance(only, e.Literal | e.Build | e.BuildMapping) else None

    def _is_constant_table(self, value: e.Global) -> bool:
        """Whether a variable of a module is a table with numbers and texts in it."""
        table = self._only_value(value)
        inner = walk((table,)) if isinstance(table, e.Build | e.BuildMapping) else ()  # type: ignore[arg-type]
        found = [n for n in inner if n is not table]
        return bool(found) and all(isinstance(n, e.Literal) for n in found)

    def _is_known(self, of: e.Expression, name: str) -> bool:
        """Whether an attribute is of an object of a class that is known; properties run for it."""
        classes = self.effects.form.program.classes.values()
        getters = [p.getter for c in classes for p in c.properties if p.name == name]
        return self._is_own(of) and all(g and self.effects.is_foreign(g) for g in getters)

    # --- calls ----------------------------------------------------------------------------------

    def _called(self, node: s.Call | s.Construct) -> bool:
        """Whether a call does nothing to the model; what it gives is free."""
        if isinstance(node, s.Construct):
            is_made = self._enters(ClassOrigin(node.class_name, False)) and self._given(node)
        else:
            is_made = self._calls(node)
        if not is_made:
            return False
        return node.target is None or self._is_place(node.target)

    def _given(self, node: s.Call | s.Construct, *, seen: bool = False) -> bool:
        """Whether all arguments are free, or are `seen` only."""
        return all(
            self._is_seen(a.value) if seen and not a.stars else self.is_free(a.value)
            for a in node.arguments
        )

    def _calls(self, node: s.Call) -> bool:
        match node.callee:
            case s.FunctionCallee(name):
                return self._given(node) and self.effects.is_foreign(name)
            case s.LibraryCallee(name, None):
                return self._calls_library(node, name)
            case s.ValueCallee(e.Closure(name)):
                return self._runs(node, name)
            case s.ValueCallee(value):
                held = self.effects.origins.of(value, self.function.name)
                return bool(held) and self._given(node) and all(map(self._enters, held))
            case s.MethodCallee(receiver, name, after=None):
                return self._calls_method(node, receiver, name)
            case _:
                return False

    def _runs(self, node: s.Call, name: str) -> bool:
        """A generator that is written in place goes through what it gets: an array, perhaps."""
        function = self.effects.form.program.function(name)
        inner = _Scope(self.effects, function, self.places, outside=self)
        for parameter, argument in zip(function.parameters, node.arguments, strict=False):
            if self._is_table(argument.value):
                inner.tables.add(e.Local(parameter.name))
            elif not self.is_free(argument.value):
                return False
        return inner.body(function.body)

    def _calls_library(self, node: s.Call, name: str) -> bool:
        effect = of_function(Language.PYTHON, name).effect
        if effect is Effect.LOGS:
            return self._given(node, seen=True)
        if any(a.stars for a in node.arguments):
            return False
        if name == _SUPPRESS:
            return all(isinstance(a.value, e.LibraryReference) for a in node.arguments)
        is_whole = name.removeprefix("builtins.") in _WHOLE
        seen = all(self._is_seen(a.value, whole=is_whole) for a in node.arguments)
        return seen and takes(name, self._arguments(node))

    def _calls_method(self, node: s.Call, receiver: e.Expression, name: str) -> bool:
        places = self.places
        if self._is_object(receiver):
            is_logger = places is not None and places.logs and name == "get_logger"
            if is_logger and node.target is not None:
                self.loggers.add(node.target)
            self.known.add(node.place)
            return is_logger and not node.arguments and isinstance(node.target, e.Temporary)
        if receiver in self.loggers:
            self.known.add(node.place)
            return name in _LOG_LEVELS and self._given(node, seen=True)
        if isinstance(receiver, e.Attribute) and self._is_object(receiver.object):
            if receiver.name == "_mailbox":
                self.known.add(node.place)
                return name in names_in_model(Language.PYTHON) and not node.arguments
            if places is not None and receiver.name in places.publishers:
                self.known.add(node.place)
                return name == "publish" and self._given(node)
        if self._is_table(receiver):
            is_asked = name in _ASKING and self._given(node)
            return is_asked and method_takes(name, self._arguments(node))
        held = self._held(receiver)
        is_logging = held == {_LOGGER} and name in _LOG_LEVELS
        if is_logging or not self._given(node):
            return is_logging and self._given(node, seen=True)
        answers = (self._answers(node, o, name) for o in held)
        return self._is_kept(receiver) and bool(held) and all(answers)

    def _answers(self, node: s.Call, origin: Origin, name: str) -> bool:
        """Whether a method of an object that the receiver may be does nothing to the model."""
        match origin:
            case LibraryOrigin(of, True):
                return of in _CONTAINERS and method_takes(name, self._arguments(node))
            case ClassOrigin(of, True):
                found = self.effects.origins.methods(of, name)
                return bool(found) and all(map(self.effects.is_foreign, found))
            case _:
                return False

    def _enters(self, origin: Origin) -> bool:
        """Whether calling a value does nothing to the model."""
        match origin:
            case FunctionOrigin(name):
                return self.effects.is_foreign(name)
            case ClassOrigin(name, False):
                graph = self.effects.origins.graph
                return all(map(self.effects.is_foreign, graph.construction(name).functions))
            case _:
                return False


_LOGGER = LibraryOrigin("logging.getLogger", True)
_OF_ANYTHING = (Operator.EQUAL, Operator.UNEQUAL, Operator.SAME, Operator.NOT_SAME)
_CONTAINERS = frozenset(
    {
        *("str", "list", "dict", "set", "tuple", "deque"),
        *("collections.deque", "collections.Counter", "collections.OrderedDict"),
    }
)
