"""Types of the intermediate form."""

from __future__ import annotations

from enum import Enum
from typing import TypeAlias

from rebsync.records import dataclass


@dataclass(frozen=True, slots=True)
class Unknown:
    """Any type at all: what is of it may have operators, attributes and hooks of its own."""


@dataclass(frozen=True, slots=True)
class UnitType:
    """The type of the one value that says that there is none; the result of procedures."""


@dataclass(frozen=True, slots=True)
class Integer:
    """Whole numbers of `bits` bits, or without bounds where that is None."""

    bits: int | None = None
    signed: bool = True


@dataclass(frozen=True, slots=True)
class Float:
    """Binary floating point numbers of `bits` bits."""

    bits: int = 64


@dataclass(frozen=True, slots=True)
class Truth:
    """True and false."""


@dataclass(frozen=True, slots=True)
class Text:
    """Texts, whose elements are bytes where `is_bytes` says so, else characters."""

    is_bytes: bool = False


@dataclass(frozen=True, slots=True)
class Enumeration:
    """The enumerators of a declared enumeration, which are `underlying` numbers."""

    name: str
    underlying: Integer


@dataclass(frozen=True, slots=True)
class Array:
    """`length` elements in place: assigning one copies all of them."""

    element: Type
    length: int


class ContainerKind(Enum):
    """What a container is to its elements; `elements` of a mapping are keys and values."""

    SEQUENCE = "sequence"
    TUPLE = "tuple"  # of fixed length, with a type for each element; never changes
    QUEUE = "queue"
    SET = "set"
    MAPPING = "mapping"


@dataclass(frozen=True, slots=True)
class Container:
    """A container of the languages' own libraries; it holds at most `bound` elements."""

    kind: ContainerKind
    elements: tuple[Type, ...] = ()
    bound: int | None = None


@dataclass(frozen=True, slots=True)
class Optional:
    """A value of a type, or none."""

    of: Type


@dataclass(frozen=True, slots=True)
class Record:
    """An object of a class of the program or of a library, by the class's full name."""

    name: str


@dataclass(frozen=True, slots=True)
class RosMessage:
    """A ROS message, request or response, by its full name."""

    name: str


@dataclass(frozen=True, slots=True)
class RosHandle:
    """What a library gives to be asked and told through: a publisher, a timer, a node."""

    name: str


class Ownership(Enum):
    """Whether a value ends with the references to it."""

    NONE = ""
    UNIQUE = "unique"  # with this one
    SHARED = "shared"  # with the last one


@dataclass(frozen=True, slots=True)
class Reference:
    """What leads to a value that others may reach as well; it leads nowhere if it may be null."""

    to: Type
    may_be_null: bool = False
    ownership: Ownership = Ownership.NONE


@dataclass(frozen=True, slots=True)
class FunctionType:
    """What can be called."""

    parameters: tuple[Type, ...] | None = None
    result: Type = Unknown()


Type: TypeAlias = (
    Unknown
    | UnitType
    | Integer
    | Float
    | Truth
    | Text
    | Enumeration
    | Array
    | Container
    | Optional
    | Record
    | RosMessage
    | RosHandle
    | Reference
    | FunctionType
)

UNKNOWN = Unknown()
NOTHING = UnitType()
UNBOUNDED = Integer()
TRUTH = Truth()
TEXT = Text()
DOUBLE = Float()


def is_plain(type_: Type) -> bool:
    """Whether values of a type are numbers or texts: no class gives them operators of its own."""
    return isinstance(type_, UnitType | Integer | Float | Truth | Text | Enumeration)
