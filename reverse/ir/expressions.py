"""Expressions of the intermediate form: trees that are evaluated once, from left to right.

An expression reads and may fail (divide by zero, find no element). It has no other effect unless
it is `dynamic`: then its operands may be objects whose classes say what is done (operators,
properties, hooks), and whatever these do may happen. A lowering says `dynamic=False` only where
types exclude that. Calls, assignments and all else that has effects are statements.
"""

from __future__ import annotations

from dataclasses import field
from typing import TypeAlias

from rebsync.records import dataclass
from rebsync.reverse.ir.operators import Conversion, Operator
from rebsync.reverse.ir.types import UNKNOWN, Container, FunctionType, Record, Type
from rebsync.source import NOWHERE, Span


def place_field() -> Span:
    """A field for the place in the source; it takes no part in equality."""
    return field(default=NOWHERE, compare=False, repr=False)


# --- values that are named -----------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Literal:
    """A constant; `text` is how the source writes it."""

    value: int | float | complex | bool | str | bytes | None
    type: Type = UNKNOWN
    text: str = field(default="", compare=False, repr=False)
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Local:
    """A variable of the function itself, parameters included; names are unique in a function."""

    name: str
    type: Type = UNKNOWN
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Temporary:
    """A variable that a lowering adds: it is assigned before it is read, and never captured."""

    number: int
    type: Type = UNKNOWN
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Captured:
    """The variable `name` of the enclosing function `function`."""

    function: str
    name: str
    type: Type = UNKNOWN
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Global:
    """A variable of a module or namespace."""

    module: str
    name: str
    type: Type = UNKNOWN
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class ClassReference:
    """A class of the program; attributes of it are those that all its objects share."""

    name: str
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class ModuleReference:
    """A module of the program."""

    name: str
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class LibraryReference:
    """What a library of others has under a full name: a function, class, module or constant."""

    name: str
    type: Type = UNKNOWN
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class FunctionReference:
    """A function of the program that captures nothing and has no defaults of its own."""

    name: str
    type: Type = FunctionType()
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Capture:
    """What a closure takes from around it: the variable, or (by value) what it holds now."""

    variable: Local | Captured
    by_reference: bool = True


@dataclass(frozen=True, slots=True)
class Closure:
    """A new function value: `defaults` are evaluated now, and used when arguments lack.

    What a body names of enclosing functions is `Captured`; `captures` says how. `function` is the
    name under which the program has the body.
    """

    function: str
    captures: tuple[Capture, ...] = ()
    defaults: tuple[tuple[str, Expression], ...] = ()
    type: Type = FunctionType()
    place: Span = place_field()


# --- parts of values -----------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Attribute:
    """A member of an object or class, or a name of a module.

    Of one that is `dynamic` the object's own attributes are looked up, then its class's and bases'
    (methods become bound), and properties and hooks run. Otherwise it is a field, and `name` tells
    apart fields that a class and its base call alike.
    """

    object: Expression
    name: str
    type: Type = UNKNOWN
    dynamic: bool = True
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Index:
    """An element of a container by its index or key; a part of it where the index is a slice.

    `from_end` is whether negative indices count from the end. It fails where there is no such
    element, unless it is not `checked`: then it is undefined.
    """

    object: Expression
    index: Expression
    type: Type = UNKNOWN
    dynamic: bool = True
    from_end: bool = True
    checked: bool = field(default=True, compare=False)
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Slice:
    """Indices from `low` to before `high`; only as an index."""

    low: Expression | None = None
    high: Expression | None = None
    step: Expression | None = None
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Dereference:
    """What a reference leads to, where that is said in the source; it fails at null."""

    reference: Expression
    type: Type = UNKNOWN
    dynamic: bool = True
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class AddressOf:
    """A reference to a variable or part of one."""

    target: Lvalue
    type: Type = UNKNOWN
    place: Span = place_field()


# --- operations ----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Unary:
    operator: Operator
    operand: Expression
    type: Type = UNKNOWN
    dynamic: bool = True
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Binary:
    """An operator between two values; a number that its `type` does not hold wraps."""

    operator: Operator
    left: Expression
    right: Expression
    type: Type = UNKNOWN
    dynamic: bool = True
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class And:
    """The left value if it counts as false, else the right, which is evaluated only then."""

    left: Expression
    right: Expression
    type: Type = UNKNOWN
    dynamic: bool = True
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Or:
    """The left value if it counts as true, else the right, which is evaluated only then."""

    left: Expression
    right: Expression
    type: Type = UNKNOWN
    dynamic: bool = True
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Conditional:
    """The one or the other value; only that one is evaluated. `dynamic` is of the test's truth."""

    test: Expression
    then: Expression
    otherwise: Expression
    type: Type = UNKNOWN
    dynamic: bool = True
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Convert:
    """A value made one of `type`."""

    conversion: Conversion
    operand: Expression
    type: Type
    dynamic: bool = True
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Copy:
    """A new value that is equal: what is done to it is not done to the operand."""

    operand: Expression
    type: Type = UNKNOWN
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Move:
    """The value, which its variable may have lost afterwards."""

    operand: Expression
    type: Type = UNKNOWN
    place: Span = place_field()


# --- new values ----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Spread:
    """The elements of what is iterated, each by itself; only in a `Build` or `BuildMapping`."""

    operand: Expression
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Build:
    """A new sequence, tuple, set or array of elements."""

    type: Type
    elements: tuple[Expression | Spread, ...] = ()
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class BuildMapping:
    """A new mapping; of keys that are equal the last counts. What is spread is a mapping."""

    type: Container
    entries: tuple[tuple[Expression, Expression] | Spread, ...] = ()
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class BuildRecord:
    """A new record without a constructor that runs: a value for each of its fields."""

    type: Record
    fields: tuple[tuple[str, Expression], ...] = ()
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Format:
    """A text of pieces; `style` of each is how a value becomes text, in the source's own words."""

    pieces: tuple[FormatPiece, ...]
    type: Type = UNKNOWN
    dynamic: bool = True
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class FormatPiece:
    """A value within a formatted text; the style may have values in it as well."""

    value: Expression
    conversion: str = ""
    style: Expression | None = None


Lvalue: TypeAlias = Local | Temporary | Captured | Global | Attribute | Index | Dereference

Expression: TypeAlias = (
    Literal
    | Lvalue
    | ClassReference
    | ModuleReference
    | LibraryReference
    | FunctionReference
    | Closure
    | Slice
    | AddressOf
    | Unary
    | Binary
    | And
    | Or
    | Conditional
    | Convert
    | Copy
    | Move
    | Build
    | BuildMapping
    | BuildRecord
    | Format
)
