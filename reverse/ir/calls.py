"""Calls of the intermediate form: who is called, with what, and objects that begin and end."""

from __future__ import annotations

from typing import TypeAlias

from rebsync.records import dataclass
from rebsync.reverse.ir.expressions import Expression, Lvalue, place_field
from rebsync.source import Span


@dataclass(frozen=True, slots=True)
class CallArgument:
    """An argument by its place or name; with one star the elements of a sequence, with two the
    entries of a mapping by their names.
    """

    value: Expression
    name: str | None = None
    stars: int = 0


@dataclass(frozen=True, slots=True)
class FunctionCallee:
    """A function of the program: no other can be meant. A receiver is its first argument."""

    name: str


@dataclass(frozen=True, slots=True)
class LibraryCallee:
    """A function or class of a library, by its full name; `receiver` is the object it is of."""

    name: str
    receiver: Expression | None = None


@dataclass(frozen=True, slots=True)
class MethodCallee:
    """The method that the receiver's class has by a name, looked up in it and its bases.

    With `after`, the bases of the receiver's class behind that class. `declared` is the class that
    the source gives the receiver, if it does: then it is of that or one that extends it. The object
    may have an attribute of the name that hides the method, if it is `dynamic`.
    """

    receiver: Expression
    name: str
    declared: str | None = None
    after: str | None = None
    dynamic: bool = True


@dataclass(frozen=True, slots=True)
class ValueCallee:
    """Whatever function, class or object with a call operator an expression gives."""

    value: Expression


Callee: TypeAlias = FunctionCallee | LibraryCallee | MethodCallee | ValueCallee


@dataclass(frozen=True, slots=True)
class Call:
    """Evaluates what is called, then the arguments, calls, and stores the result."""

    target: Lvalue | None
    callee: Callee
    arguments: tuple[CallArgument, ...] = ()
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Construct:
    """A new object of a class of the program, in a variable; `constructor` is the function that
    runs on it, where the lowering knows which, with the object before the arguments.
    """

    target: Lvalue | None
    class_name: str
    arguments: tuple[CallArgument, ...] = ()
    constructor: str | None = None
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Destroy:
    """An object ends: its destructor runs, then those of its members and bases."""

    target: Lvalue
    class_name: str | None = None
    place: Span = place_field()
