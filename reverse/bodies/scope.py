"""What the names in the body of a C++ function stand for."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import field, fields, replace
from fractions import Fraction
from functools import lru_cache
from operator import attrgetter
from typing import Literal, TypeAlias

from tree_sitter import Node

from rebsync.model import Expression, Name, Statement, Type
from rebsync.records import dataclass
from rebsync.reserved import RESERVED, uncarry_local
from rebsync.reverse.bodies.effects.calm import Calm
from rebsync.reverse.bodies.effects.cpp_form import CppForm
from rebsync.reverse.bodies.serving import Serves
from rebsync.reverse.bodies.types.cpp_types import Carried, carried
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of
from rebsync.reverse.syntax.cpp_index import CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, part, text_of

WIDE = 32  # bits without the sign, from which on numbers hold more than the model's `int`

# --- variables ----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Variable:
    """A state variable, a known rebec, a constant, a parameter or a local of the model.

    With `type` None nothing is converted when it is read or written: the code says it all.
    `bits` is the width of an unsigned type that `type` holds but that wraps sooner (8 or 16). A
    truth value with bits is a number in the code, which can hold others than 0 and 1.
    `domain` are the values that a hint beside its declaration gives it. `wide` are the bits,
    without the sign, of a number of which the model's `int` has the lower half: 32, 63 or 64.
    """

    name: str
    type: Type | None = None
    bits: int = 0
    domain: tuple[Expression, ...] = ()
    wide: int = 0


def of_width(name: str, type_: Type, width: int) -> Variable:
    """A variable for a field of a message: of so many bits without the sign, 0 for the model's."""
    return Variable(name, type_, wide=width) if width >= WIDE else Variable(name, type_, width)


@dataclass(frozen=True, slots=True)
class Runtime:
    """A member through which a class talks to the run-time part of generated code."""

    kind: Literal["mailbox", "drive", "sensor"]


@dataclass(frozen=True, slots=True)
class Outside:
    """What the model does not have: reading it gives a value that the model cannot know.

    Writing it changes nothing of the model. `type` is what its values would be in the model, if
    that is known. `reaches` says that its member functions may act on what the model has;
    `indexed` that to call it gives an element of it, as of a matrix.
    """

    type: Type | None = None
    reaches: bool = False
    indexed: bool = False


@dataclass(frozen=True, slots=True)
class Record:
    """A message whose fields are variables of the model, each by its path: `linear.x`.

    Fields that are not named here are outside. `type` is `package/Type` where it is known.
    A `constant` one cannot be changed through its name; a `pointer` is copied by its name alone.
    `there` says whether a member points to a message; `shared` ones other pointers may change.
    """

    fields: Mapping[str, Variable]
    type: str = ""
    constant: bool = False
    pointer: bool = False
    there: str = ""
    shared: bool = False


@dataclass(frozen=True, slots=True)
class Target:
    """A receiver of what a publisher sends: a known rebec (None: the class itself) and its server.

    `fields` are the paths of the message's fields that the server's parameters get, in their order,
    `rivals` the types that other servers of the name take.
    """

    known: str | None
    server: str
    fields: tuple[str, ...] = ()
    rivals: frozenset[tuple[Type | None, ...]] = frozenset()


@dataclass(frozen=True, slots=True)
class Publishes:
    """A publisher; without targets nobody in the model receives what it sends.

    With `timed` a message gets its times from the mailbox: without, its receiver drops it.
    """

    targets: tuple[Target, ...]
    type: str = ""
    timed: bool = False


@dataclass(frozen=True, slots=True)
class Switch:
    """The state variables of a timer that is stopped and started, and its period in units.

    One that goes off once has one more: whether it will.
    """

    running: str
    stale: str
    period: int
    waiting: str = ""


@dataclass(frozen=True, slots=True)
class TimerOf:
    """A timer whose callback is a server.

    Of one that is stopped and started `switch` says whether it runs and how many messages of it
    that wait do not count any more: two state variables, and the units between two messages.
    """

    server: str
    periodic: bool = True
    switch: Switch | None = None


@dataclass(frozen=True, slots=True)
class Lambda:
    """A local that holds a function: its body reads what the names around it stood for.

    A member that does has no `scope`. `own` are the names that it makes itself: `[n = e]`.
    """

    node: Node
    scope: Scope | None
    own: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True)
class Itself:
    """The object whose class is read, under the name that `main` has for it."""


Endpoint: TypeAlias = Publishes | Serves | TimerOf
Member: TypeAlias = Itself | Variable | Runtime | Outside | Record | Lambda | Endpoint
Meaning: TypeAlias = Member | Expression

# --- functions ----------------------------------------------------------------------------------

# What is passed on for a parameter: its value, those fields of a message, or nothing.
Takes: TypeAlias = Type | tuple[str, ...] | None


@dataclass(frozen=True, slots=True)
class Called:
    """A local method, or a message server, by its name in the model.

    `takes` says what the method gets for each parameter of the function (None: each as it is).
    `function` is the one in the code, if it is known; of several of that name all are `overloads`.
    A callback that other bodies call is `Called` with the method that the model has for its body.
    """

    name: str
    server: bool = False
    takes: tuple[Takes, ...] | None = None
    returns: Type | None = None
    function: CppFunction | None = None
    overloads: tuple[CppFunction, ...] = ()

    def taking(self, count: int) -> tuple[CppFunction, ...]:
        """The functions that may be meant where so many arguments are given."""
        if self.function is not None:
            return (self.function,) if self.function.may_take(count) else ()
        return tuple(f for f in self.overloads if f.may_take(count))


@dataclass(frozen=True, slots=True)
class Inline:
    """A function whose body stands in the place of its call: it takes or returns messages or
    references, or it chooses, which no method of a model can.

    `constants` are those that its file can name; None where these are the caller's.
    """

    function: CppFunction
    constants: Mapping[str, tuple[Cpp, Node]] | None = None


@dataclass(frozen=True, slots=True)
class Sends:
    """A function that fills a message from its arguments and sends it.

    To the known rebec `known`; or to itself, `known` being "self"; or, `known` being None, to the
    rebec that the first argument names. The last argument, if there is one more, is the time; where
    it is left out, that is `usual`. `order` says which argument each field gets, where that is not
    the next one. `types` are those of the fields, `rivals` the types that other servers of the name
    take.
    """

    known: str | None
    server: str
    arguments: int
    usual: tuple[Cpp, Node] | None = None
    order: tuple[int, ...] = ()
    types: tuple[Type | None, ...] = ()
    rivals: frozenset[tuple[Type | None, ...]] = frozenset()


@dataclass(frozen=True, slots=True)
class Ignored:
    """A function that touches nothing of the model and whose result it cannot know."""

    returns: Type | None = None


@dataclass(frozen=True, slots=True)
class Around:
    """A function of a generated class that no body of the model calls, such as `publishState`."""


Function: TypeAlias = Called | Inline | Sends | Ignored | Around


def is_another(called: Function | None, name: str) -> bool:
    """Whether a name with its class before it means a function of another class."""
    last = name.rpartition("::")[0].partition("<")[0].rpartition("::")[2]
    match called:
        case Inline(function):
            known: tuple[CppFunction, ...] = (function,)
        case Called(function=function, overloads=several):
            known = several if function is None else (function,)
        case _:
            known = ()
    return bool(last) and any(f.owner not in ("", last) for f in known)


def meant_by(called: Called | Inline, name: str, count: int) -> tuple[CppFunction, ...]:
    """The functions that a call of so many arguments may mean; none where that is not known."""
    if is_another(called, name):
        return ()
    if isinstance(called, Inline):
        return (called.function,) if called.function.may_take(count) else ()
    return called.taking(count)


# --- set-up -------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Stores:
    """A value that is stored where `target` says, as `getParam("x", x_)` does.

    Nothing where that is outside.
    """

    target: Node | Expression
    value: Node | Expression


# --- scopes -------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Scope:
    """The names of one class, those of its ancestors included, and the locals of one body.

    `constants` are those of C++ that the body's file can name: their values stand for them.
    """

    members: Mapping[str, Member]
    functions: Mapping[str, Function]
    bases: Mapping[str, str]
    types: frozenset[str] = frozenset()
    callable: frozenset[str] = frozenset()
    locals: Mapping[str, Meaning] = field(default_factory=dict)
    constants: Mapping[str, tuple[Cpp, Node]] = field(default_factory=dict)
    # Of enumerations the values by name (`RED`, `Color::RED`), and the names of the types.
    enumerators: Mapping[str, int | str] = field(default_factory=dict)
    enums: frozenset[str] = frozenset()
    # What the model keeps of types that the code names itself: aliases, a template's parameters.
    aliases: Mapping[str, Carried | None] = field(default_factory=dict)
    # The fields of message types by their paths; None where the model has no such type.
    messages: Mapping[str, Mapping[str, Type | None]] = field(default_factory=dict)
    # The widths in bits of their fields where these are not the model's type's.
    widths: Mapping[str, Mapping[str, int]] = field(default_factory=dict)
    # The wide numbers, by their names in the model, that an `int` need not hold.
    overflowing: frozenset[str] = frozenset()
    # What stands for values that nobody knows, of a variable that is only compared.
    regions: Callable[[Variable], tuple[Expression, ...]] | None = None
    # The servers of the callbacks that calls set timers for, by the ids of the calls' nodes.
    timers: Mapping[int, TimerOf] = field(default_factory=dict)
    # What calls (`post`) send the rebec itself, and with which arguments and time.
    posts: Mapping[int, tuple[Sends, tuple[Node, ...]]] = field(default_factory=dict)
    # What statements and expressions that set a node up stand for, by the ids of their nodes.
    instead: Mapping[int, tuple[Statement | Stores | Node, ...]] = field(default_factory=dict)
    values: Mapping[int, Expression] = field(default_factory=dict)
    # Whether names that are not known are outside: so it is in what people wrote.
    open: bool = False
    # Whether `?(...)` may stand here: only in the body of a message server.
    chooses: bool = True
    server: str | None = None  # whose body this is, if it is one
    unit: Fraction = Fraction(1)  # seconds that a unit of the model's time takes
    # The type of what the method gives whose body this is, if it is one.
    returns: Type | None = None
    # Locals that hold what the functions give whose bodies stand in this one, by their names.
    results: dict[str, Variable] = field(default_factory=dict, compare=False, repr=False)
    # The bits of locals wider than an `int`; texts that may be any; literals that are cut.
    wide: dict[str, int] = field(default_factory=dict, compare=False, repr=False)
    changed_texts: set[str] = field(default_factory=set, compare=False, repr=False)
    lowered: set[Expression] = field(default_factory=set, compare=False, repr=False)
    # Whether functions touch nothing: what has been found out.
    calm: Calm = field(default_factory=Calm, compare=False, repr=False)
    # Calls that were taken apart, by the ids of their nodes, which they keep.
    calls: dict[int, CppCall] = field(default_factory=dict, compare=False, repr=False)
    # The definitions of macros with parameters, by their names.
    macros: Mapping[str, Sequence[Node]] = field(default_factory=dict, compare=False, repr=False)
    form: CppForm | None = field(default=None, compare=False, repr=False)
    operands: frozenset[str] = frozenset()  # locals that stand for what is named in their values

    def carried(self, node: Node) -> Carried | None:
        """What the model keeps of a type, or None if it has nothing like it."""
        while node.type == "type_descriptor":
            node = part(node, "type")
        name = text_of(node) if node.type.endswith("identifier") else ""
        if name in self.aliases:
            return self.aliases[name]
        return carried(node, self.enums, texts=self.open)

    def width(self, type_: str, path: str) -> int:
        """The width of a field of a message type; 0 where it is that of the model's type."""
        return self.widths.get(type_, {}).get(path, 0)

    def meaning(self, name: str) -> Meaning | None:
        """What a name stands for: a local hides a member."""
        return self.locals.get(name) or self.members.get(name)

    def call(self, node: Node) -> CppCall | None:
        """The call that a node is: bodies are looked through again and again."""
        call = self.calls.get(node.id)
        if call is None and (call := call_of(node)) is not None:
            self.calls[node.id] = call
        return call

    def hides(self, name: str) -> bool:
        """Whether a local of generated code has a name of the model: people's get others there."""
        if self.open:
            return False
        # A reference to a member is that very member; a local of its name and type only equals it.
        members = {id(x) for x in self.members.values()}
        own = (x for n, x in self.locals.items() if id(x) not in members and n not in self.operands)
        return any(isinstance(x, Variable | Name) and x.name == name for x in own)

    def with_locals(self, found: Mapping[str, Meaning]) -> Scope:
        """The same with more locals, which hide what has their names."""
        whole = {**self.locals, **found}
        # Asked for often: `replace` is slow.
        return Scope(*(*_BEFORE(self), whole, *_BEHIND(self)))

    def with_operand(self, name: str, value: Meaning) -> Scope:
        """The same with a local that keeps a value until the operands behind it are known."""
        return replace(self.with_locals({name: value}), operands=self.operands | {name})

    def without_constant(self, name: str) -> Scope:
        """What the value of a constant can name: all but itself."""
        others = {n: v for n, v in self.constants.items() if n != name}
        return replace(self, constants=others, locals={})

    def local(self, name: str) -> str:
        """The model's name of a local variable or parameter."""
        return _of_model(name, self.types, self.callable)

    def declare(self, *names: str) -> Scope:
        """The same with these local variables."""
        return self.with_locals({n: Name(self.local(n)) for n in names})


@lru_cache(maxsize=1024)  # the same few names are declared again and again
def _of_model(name: str, types: frozenset[str], functions: frozenset[str]) -> str:
    return uncarry_local(name, RESERVED | types | functions, functions)


_ALL = tuple(f.name for f in fields(Scope))
_LOCALS = _ALL.index("locals")
_BEFORE, _BEHIND = attrgetter(*_ALL[:_LOCALS]), attrgetter(*_ALL[_LOCALS + 1 :])
