"""Functions, classes and modules in the intermediate form; bodies are lowered when asked for."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from enum import Enum

from rebsync.records import dataclass
from rebsync.reverse.ir.expressions import Global, place_field
from rebsync.reverse.ir.operators import ImplicitCall, Operator
from rebsync.reverse.ir.statements import Body
from rebsync.reverse.ir.types import UNKNOWN, Type
from rebsync.source import Span


class ParameterKind(Enum):
    """Which arguments a parameter may take."""

    PLAIN = ""  # by its place or its name
    BY_PLACE = "by place"
    BY_NAME = "by name"
    REST = "*"  # all further ones by place, as a tuple
    NAMED_REST = "**"  # all further ones by name, as a mapping


@dataclass(frozen=True, slots=True)
class Parameter:
    """A parameter, which is a local variable of its function.

    Defaults are not here: a closure has the values, or the call has the expression, as the
    language evaluates them when the function is defined, or when it is called.
    """

    name: str
    type: Type = UNKNOWN
    kind: ParameterKind = ParameterKind.PLAIN
    has_default: bool = False
    place: Span = place_field()


class FunctionKind(Enum):
    """When and how a body runs."""

    FUNCTION = "function"
    CONSTRUCTOR = "constructor"
    DESTRUCTOR = "destructor"
    GENERATOR = "generator"  # a call runs nothing; asking the result for elements does
    COROUTINE = "coroutine"  # a call runs nothing; awaiting the result does
    MODULE = "module"  # when the module is first imported, or starts the program
    CLASS = "class"  # when the class is defined; it sets attributes of the class


@dataclass(frozen=True, slots=True)
class Function:
    """A function with its body. The names of functions are unique in a program.

    The `receiver` is the parameter (the first) that is the object a method is called on, and
    `owner` the class that declares it. `captured` are the locals that closures within share, or
    references lead to. An exception that would leave one that is `noexcept` ends the program.
    """

    name: str
    parameters: tuple[Parameter, ...]
    body: Body
    result: Type = UNKNOWN
    kind: FunctionKind = FunctionKind.FUNCTION
    receiver: str | None = None
    owner: str | None = None
    captured: frozenset[str] = frozenset()
    place: Span = place_field()
    noexcept: bool = False


def innermost(functions: Iterable[Function], place: Span) -> Function | None:
    """The function that a place is in, and none that is around that one; None if it is in none."""
    around = (f for f in functions if f.place.holds(place))
    return min(around, key=lambda f: f.place.end - f.place.start, default=None)


@dataclass(frozen=True, slots=True)
class Property:
    """An attribute that is computed: the functions that get, set and delete it."""

    name: str
    getter: str | None = None
    setter: str | None = None
    deleter: str | None = None

    @property
    def functions(self) -> tuple[str, ...]:
        """Those of them that there are."""
        return tuple(f for f in (self.getter, self.setter, self.deleter) if f is not None)


@dataclass(frozen=True, slots=True)
class Field:
    """A member that each object has, or (`is_shared`) one that all objects of the class share."""

    name: str
    type: Type = UNKNOWN
    is_shared: bool = False
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Class:
    """A class of the program: `name` is its full one, `bases` in the order of the source.

    A base is the name of a class of the program, of a library, or None if it is not known.
    `methods` are pairs of a name and a function; `operators` say which method names operators
    and implicit calls are answered by, in this language. It is `complete` if nothing changes or
    adds to what is said here: no decorator, metaclass, or attribute that is set from outside; one
    that is only `is_plain` may have decorators.
    `virtual` are the methods that a call finds by the object's own class; None is all of them.
    """

    name: str
    bases: tuple[str | None, ...] = ()
    methods: tuple[tuple[str, str], ...] = ()
    properties: tuple[Property, ...] = ()
    fields: tuple[Field, ...] = ()
    operators: tuple[tuple[Operator | ImplicitCall, str], ...] = ()
    virtual: frozenset[str] | None = None
    constructor: str | None = None
    destructor: str | None = None
    body: str | None = None
    complete: bool = False
    is_plain: bool = False
    place: Span = place_field()


class Program:
    """All that was read, by names; a body is lowered when it is first asked for, and kept.

    `lower` gives the function of a name that is among `functions`. `modules` are pairs of the name
    of a module and the function that is its body. `undefined` are the functions that files declare
    and none defines, of which the `pure` ones need not be; so are the classes that are `forward`.
    """

    def __init__(
        self,
        functions: Iterable[str],
        classes: Iterable[Class],
        lower: Callable[[str], Function],
        modules: Iterable[tuple[str, str]] = (),
        globals_: Iterable[Global] = (),
        undefined: Iterable[str] = (),
        pure: Iterable[str] = (),
        forward: Iterable[str] = (),
    ) -> None:
        self.functions: tuple[str, ...] = tuple(functions)
        self.classes: Mapping[str, Class] = {c.name: c for c in classes}
        self.modules: Mapping[str, str] = dict(modules)
        self.globals: tuple[Global, ...] = tuple(globals_)
        self.undefined = frozenset(undefined)
        self.pure = frozenset(pure)
        self.forward = frozenset(forward)
        self._names = frozenset(self.functions)
        self._lower = lower
        self._bodies: dict[str, Function] = {}

    def __contains__(self, name: str) -> bool:
        return name in self._names

    def function(self, name: str) -> Function:
        """The function of a name, lowered now if it was not."""
        body = self._bodies.get(name)
        if body is None:
            body = self._bodies[name] = self._lower(name)
        return body

    @classmethod
    def of(cls, functions: Iterable[Function], classes: Iterable[Class] = ()) -> Program:
        """A program of bodies that are there already."""
        bodies = {f.name: f for f in functions}
        return cls(bodies, classes, bodies.__getitem__)
