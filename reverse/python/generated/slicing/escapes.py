"""Values in code that may only tell people something: what of the model can be reached from them.

A value is free if no array of the model, and not the node itself, can be reached from it. Arrays
are looked at: their elements are numbers.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Iterator, Mapping
from dataclasses import field as with_default

from rebsync.records import dataclass
from rebsync.reverse.analysis.origins import ClassOrigin, LibraryOrigin, Origin, Origins
from rebsync.reverse.analysis.python.value_types import A_NUMBER, A_TEXT, ValueTypes
from rebsync.reverse.analysis.stores import key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.ir.program import Function
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.python.bodies.body_form import PyForm
from rebsync.reverse.python.generated.slicing.library_calls import is_known
from rebsync.source import Span

LOGGER = LibraryOrigin("logger", True)
_CLASS = LibraryOrigin("builtins.type", True)
_SCALARS = (t.Integer, t.Float, t.Truth, t.Text)
_OF_WHOLE = frozenset(
    {
        *(Operator.ADD, Operator.SUBTRACT, Operator.MULTIPLY),
        *(Operator.FLOOR_DIVIDE, Operator.FLOOR_MODULO),
    }
)
_HOOKS = frozenset({"__getattr__", "__getattribute__"})
_OF_ANYTHING = (Operator.EQUAL, Operator.UNEQUAL, Operator.SAME, Operator.NOT_SAME)


@dataclass(frozen=True, eq=False, slots=True)
class ToldPlaces:
    """Where a function may keep what is told: attributes, locals, and `variables` of the module.

    `publishers` are attributes that publish what only people look at, `logging` methods that only
    tell people something, with how many arguments each takes; `logs` says whether the object has a
    logger of its own, as nodes of rclpy have.
    """

    attributes: Collection[str] = ()
    locals: Collection[str] = ()
    variables: Collection[str] = ()
    publishers: Collection[str] = ()
    logging: Mapping[str, int] = with_default(default_factory=dict)
    logs: bool = False


class Foreign(ABC):
    """What is known of the functions that a class of the model does not have.

    `plain` are attributes of the class that are a number, truth value or text, `arrays` those that
    are an array of such; `messages` are types of messages for people, by full names.
    """

    form: PyForm
    plain: Collection[str]
    arrays: Collection[str]
    messages: Collection[str]

    @property
    def origins(self) -> Origins:
        """What values may be."""
        return self.form.origins

    @abstractmethod
    def is_foreign(self, name: str) -> bool:
        """Whether a function does nothing to the model where it gets free values only."""

    @abstractmethod
    def acting(self, name: str) -> Iterator[tuple[str, Span]]:
        """Where a function acts, and what it calls."""

    @abstractmethod
    def gives_free(self, getter: str) -> bool:
        """Whether a method of the object gives a free value for such, and does nothing else."""

    @abstractmethod
    def describes(self, owner: str) -> bool:
        """Whether to make a text of an object of a class does nothing but that."""

    @abstractmethod
    def is_closed(self, name: str) -> bool:
        """The same of one that gets free values only from around it as well."""


@dataclass(eq=False, slots=True)
class ToldValues(ABC):
    """Those of a function, or of statements of a method; without `places` it is none of the model.

    A generator that is written within a method has that `outside`. `tables` are locals and
    temporaries that hold an array of the model, and so are only looked at; `loggers` those that
    hold a logger, `clocks` a clock or what one says, `publishing` a publisher, `fields` a message
    for people or its field, `whole` a whole number; `known` are the places of calls, by functions,
    of which the rest of the form does not know what they do; `gives` says that a result is free.
    """

    effects: Foreign
    function: Function
    places: ToldPlaces | None
    tables: set[e.Expression] = with_default(default_factory=set)
    made: set[e.Expression] = with_default(default_factory=set)
    loggers: set[e.Expression] = with_default(default_factory=set)
    clocks: set[e.Expression] = with_default(default_factory=set)
    publishing: set[e.Expression] = with_default(default_factory=set)
    fields: set[e.Expression] = with_default(default_factory=set)
    known: set[tuple[str, Span]] = with_default(default_factory=set)
    outside: ToldValues | None = None
    whole: set[e.Expression] = with_default(default_factory=set)
    loops: int = 0
    gives: bool = False

    @property
    def depth(self) -> int:
        """How many functions this one is looked at within."""
        return 0 if self.outside is None else 1 + self.outside.depth

    @property
    def is_all_own(self) -> bool:
        """Whether the whole function is looked at, and its locals are its own."""
        return self.places is None or self.outside is not None

    @abstractmethod
    def enters(self, origin: Origin) -> bool:
        """Whether calling a value does nothing to the model."""

    def is_kept(self, value: e.Expression) -> bool:
        """Whether a value is free, and none that a module, a class or a library keeps."""
        kept = (e.Global, e.LibraryReference, e.ClassReference, e.ModuleReference)
        return self.is_free(value) and not any(isinstance(n, kept) for n in walk((value,)))  # type: ignore[arg-type]

    def is_own(self, value: e.Expression) -> bool:
        """Whether a value is an object of a class that is known."""
        held = self.held(value)
        return bool(held) and all(isinstance(o, ClassOrigin) and o.of_object for o in held)

    def held(self, value: e.Expression) -> frozenset[Origin]:
        """What a value may be; the object of a method is of its class."""
        owner, receiver = self.function.owner, self.function.receiver
        if isinstance(value, e.Local) and value.name == receiver and owner is not None:
            return frozenset({ClassOrigin(owner)})
        return self.effects.origins.of(value, self.function.name)

    # --- types ----------------------------------------------------------------------------------

    def _types(self, value: e.Expression) -> ValueTypes:
        """The types of what a value may be: it must not fail where it is used."""
        return self.effects.form.kinds(self.function).types(value, frozenset())

    def _is_plain(self, piece: e.FormatPiece) -> bool:
        """Whether a value has styles: numbers and texts."""
        types = self._types(piece.value)
        return bool(piece.conversion) or (bool(types) and types <= A_NUMBER | A_TEXT)

    def is_typed(self, *values: e.Expression) -> bool:
        return all(is_known(self._types(value)) for value in values)

    def arguments(self, node: s.Call) -> list[tuple[str | None, ValueTypes]]:
        return [(a.name, self._types(a.value)) for a in node.arguments]

    def has_keys(self, node: s.Call) -> bool:
        """Whether all that a call gets may be a key: numbers and texts."""
        return all(self._types(a.value) in (A_NUMBER, A_TEXT) for a in node.arguments)

    def has_whole(self, node: s.Call) -> bool:
        """Whether all numbers that a call gets are whole."""
        values = (a.value for a in node.arguments)
        return all(self._types(v) != A_NUMBER or self._is_whole(v) for v in values)

    def _is_whole(self, value: e.Expression) -> bool:
        match value:
            case e.Literal(number):
                return isinstance(number, int)
            case e.Binary(operator, left, right) if operator in _OF_WHOLE:
                return self._is_whole(left) and self._is_whole(right)
            case e.Temporary():
                return value in self.whole
            case _:
                return self.effects.form.kinds(self.function).is_whole(value)

    # --- values ---------------------------------------------------------------------------------

    def is_free_or_none(self, value: e.Expression | None) -> bool:
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
            case e.Attribute(of, name) if self.is_object(of):
                own = self.places.attributes if self.places is not None else ()
                return name in own or name in self.effects.plain or self._gives_free(name)
            case e.Attribute(of, name):
                return self.is_free(of) and self._is_known(of, name)
            case e.Index(of, index):
                is_seen = self.is_seen(index) and self.is_seen(of, whole=False)
                return is_seen and self.is_typed(of)
            case e.Unary(operator, operand):
                return self.is_seen(operand) and (
                    operator is Operator.NOT or self.is_typed(operand)
                )
            case e.Binary(operator, left, right):
                return (self.is_seen(left) and self.is_seen(right)) and (
                    operator in _OF_ANYTHING or self.is_typed(left, right)
                )
            case e.Conditional(test, then, otherwise):
                return self.is_seen(test) and self.is_free(then) and self.is_free(otherwise)
            case e.And(left, right) | e.Or(left, right):
                return self.is_free(left) and self.is_free(right)
            case e.Slice(low, high, step):
                return all(map(self.is_free_or_none, (low, high, step)))
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
                fits = all(self.is_free_or_none(p.style) and self._is_plain(p) for p in styled)
                return fits and all(self.is_shown(p.value) for p in pieces)
            case _:
                return False

    def _is_part(self, value: e.Expression | e.Spread) -> bool:
        return (
            self.is_seen(value.operand, whole=False)
            if isinstance(value, e.Spread)
            else (self.is_free(value))
        )

    def is_seen(self, value: e.Expression, *, whole: bool = True) -> bool:
        """Whether a value is free, or an array that is only looked at.

        What is looked at as a `whole` may be any local, and an attribute of one that no property
        computes: a number or a text is made of it.
        """
        if self.is_table(value) or self.is_free(value):
            return True
        match value:
            case e.Attribute(e.Local() as of, name) if not self._is_computed(name):
                return whole and not self.is_object(of)
            case e.Local() | e.Global():
                return whole and not self.is_object(value)
            case e.And(left, right) | e.Or(left, right):
                return self.is_seen(left, whole=whole) and self.is_seen(right, whole=whole)
            case _:
                return False

    def is_shown(self, value: e.Expression) -> bool:
        """Whether a value is seen, or the object itself, where a text is made of it."""
        owner = self.function.owner
        is_own = self.is_object(value) and owner is not None and self.effects.describes(owner)
        return is_own or self.is_seen(value)

    def is_table(self, value: e.Expression) -> bool:
        """Whether a value is an array of the model, or a constant, with numbers and texts in it."""
        match value:
            case e.Attribute(of, name) if self.is_object(of):
                return name in self.effects.arrays
            case e.Global():
                return self._is_constant_table(value)
            case e.Local() if self.places is not None and self.outside is None:
                type_ = self._type_of(value)
                return isinstance(type_, t.Array) and isinstance(type_.element, _SCALARS)
            case _:
                return value in self.tables

    def _is_free_local(self, value: e.Local | e.Captured) -> bool:
        if self.is_object(value) or value in self.tables:
            return False
        if isinstance(value, e.Captured):
            return self.outside is None or self.outside.is_free(e.Local(value.name))
        if self.places is None or self.outside is not None or value in self.made:
            return True
        return value.name in self.places.locals or isinstance(self._type_of(value), _SCALARS)

    def _type_of(self, value: e.Local) -> t.Type | None:
        """The type of a parameter."""
        return next((p.type for p in self.function.parameters if p.name == value.name), None)

    def is_object(self, value: e.Expression) -> bool:
        """Whether a value is the object of the model itself."""
        match value:
            case e.Captured(name=name) if self.outside is not None:
                return self.outside.is_object(e.Local(name))
            case e.Local(name) if self.outside is None:
                return self.places is not None and name == self.function.receiver
            case _:
                return False

    def _is_free_global(self, value: e.Global) -> bool:
        """Whether a variable of a module is a function or class, a logger, or one plain value."""
        if self.is_variable(value):
            return True
        held = self.effects.origins.of(value, self.function.name)
        if held and all(o == LOGGER or self.enters(o) for o in held):
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

    def is_variable(self, value: e.Expression) -> bool:
        """Whether a value is a variable of the module that only people look at."""
        named = self.places.variables if self.places is not None else ()
        return isinstance(value, e.Global) and value.name in named

    def is_publisher(self, value: e.Expression) -> bool:
        """Whether a value is a member that publishes what only people look at."""
        match value:
            case e.Attribute(of, name) if self.is_object(of) and self.places is not None:
                return name in self.places.publishers
            case _:
                return False

    def is_message(self, value: e.Expression) -> bool:
        """Whether a value is a message for people that the code makes, or a field of one."""
        match value:
            case e.Attribute(of) if not self.is_object(of):
                return self.is_message(of)
            case e.Index(of):
                return self.is_message(of)
            case e.Temporary() if value in self.fields:
                return True
            case _:
                held = self.held(value)
                messages = self.effects.messages
                made = (isinstance(o, LibraryOrigin) and o.name in messages for o in held)
                return bool(held) and all(made)

    def _is_computed(self, name: str) -> bool:
        """Whether code of the program may run where an attribute is read."""
        classes = self.effects.form.program.classes.values()
        hooks = (n for c in classes for n, _ in c.methods if n in _HOOKS)
        return bool(self._getters(name)) or any(True for _ in hooks)

    def _getters(self, name: str) -> list[str | None]:
        classes = self.effects.form.program.classes.values()
        return [p.getter for c in classes for p in c.properties if p.name == name]

    def _gives_free(self, name: str) -> bool:
        """Whether an attribute of the object is a property that only looks at what is there."""
        getters = self._getters(name)
        return bool(getters) and all(g is not None and self.effects.gives_free(g) for g in getters)

    def _is_known(self, of: e.Expression, name: str) -> bool:
        """Whether an attribute is of a message, or of an object of a class that is known;
        properties run for it.
        """
        if of in self.clocks or self.is_message(of):
            return True
        if name == "__name__" and self.held(of) == {_CLASS}:
            return True
        return self.is_own(of) and all(
            g and self.effects.is_foreign(g) for g in self._getters(name)
        )
