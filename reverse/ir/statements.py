"""Statements of the intermediate form: what has effects, and the order in which it has them.

A statement evaluates what is called and its values in the order of its fields, then the parts of
its target, unless it says otherwise. A value that an effect gives is stored in a `target`.
"""

from __future__ import annotations

from typing import TypeAlias

from rebsync.records import dataclass
from rebsync.reverse.ir.calls import (
    Call as Call,
)
from rebsync.reverse.ir.calls import (
    CallArgument as CallArgument,
)
from rebsync.reverse.ir.calls import (
    Callee as Callee,
)
from rebsync.reverse.ir.calls import (
    Construct as Construct,
)
from rebsync.reverse.ir.calls import (
    Destroy as Destroy,
)
from rebsync.reverse.ir.calls import (
    FunctionCallee as FunctionCallee,
)
from rebsync.reverse.ir.calls import (
    LibraryCallee as LibraryCallee,
)
from rebsync.reverse.ir.calls import (
    MethodCallee as MethodCallee,
)
from rebsync.reverse.ir.calls import (
    ValueCallee as ValueCallee,
)
from rebsync.reverse.ir.expressions import Expression, Lvalue, Temporary, place_field
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.ir.types import UNKNOWN, Type
from rebsync.source import Span

# --- assignments ---------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Evaluate:
    """Evaluates an expression for what that does or fails at."""

    value: Expression
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Assign:
    """Evaluates the value, then the parts of the target, and stores."""

    target: Lvalue
    value: Expression
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class CompoundAssign:
    """`target = target operator value`, increments included.

    The parts of the target are evaluated once and first; then it is read, the value evaluated, the
    operator applied (in place, if it is `dynamic` and the object's class does so) and the result,
    as one of the target's type, stored.
    """

    target: Lvalue
    operator: Operator
    value: Expression
    dynamic: bool = True
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Unpack:
    """Iterates the value and stores its elements; it fails if there are more or fewer.

    The target at `rest` takes all elements that the others leave, as a new sequence.
    """

    targets: tuple[Temporary, ...]
    value: Expression
    rest: int | None = None
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Insert:
    """Puts an element into a container that a lowering made: at the end, or at its key."""

    container: Temporary
    value: Expression
    key: Expression | None = None
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Declare:
    """A local variable begins to be; without a value it holds nothing that may be read.

    An attribute of a class that is declared is one that each object will have.
    """

    target: Lvalue
    type: Type = UNKNOWN
    value: Expression | None = None
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Delete:
    """A variable, attribute or element is no more; reading it fails."""

    target: Lvalue
    place: Span = place_field()


# --- what else has effects -----------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Import:
    """Runs a module if it has not run, and stores it, or (with `name`) what it has by a name.

    `is_program` is whether the module is of the program; others are libraries.
    """

    target: Lvalue | None
    module: str
    name: str | None = None
    is_program: bool = False
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class DefineClass:
    """A class of the program begins to be: its bases are evaluated and its body runs."""

    target: Lvalue
    class_name: str
    bases: tuple[CallArgument, ...] = ()
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Yield:
    """Hands out a value (or all of another iteration), and goes on when asked for the next."""

    target: Lvalue | None
    value: Expression
    delegates: bool = False
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Await:
    """Waits for a value that is computed elsewhere; whatever else is ready may run before."""

    target: Lvalue | None
    value: Expression
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Unsupported:
    """What has no lowering: it may do anything to what it can reach, and end in any way.

    `reads` and `writes` are what the text names, for those who tell about it; what can be reached
    from there, and from what is global, is more. `raises` is not set for the end of an object, nor
    where the reader of bodies asks what is called there, and whether that raises.
    """

    reason: str
    reads: tuple[Expression, ...] = ()
    writes: tuple[Lvalue, ...] = ()
    target: Lvalue | None = None
    place: Span = place_field()
    raises: bool = True


# --- leaving -------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Return:
    value: Expression | None = None
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Raise:
    """Raises an exception; without a value the one that is being handled."""

    value: Expression | None = None
    cause: Expression | None = None
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Break:
    """Leaves the innermost loop or switch."""

    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Continue:
    """Goes on with the step of the innermost loop."""

    place: Span = place_field()


# --- control -------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Assert:
    """Raises unless the test counts as true. `message` runs only then and gives `text`."""

    test: Expression
    message: Body = ()
    text: Expression | None = None
    dynamic: bool = True
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Block:
    """Statements in a scope of their own."""

    body: Body
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class If:
    """`dynamic` is whether the truth of the test may be up to its class."""

    test: Expression
    then: Body
    otherwise: Body = ()
    dynamic: bool = True
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Loop:
    """`prelude` and test before each round, `step` after each; `otherwise` once the test fails.

    A `continue` goes to the step; a `break` leaves without `otherwise`. With `body_first` the first
    round is not tested.
    """

    test: Expression
    body: Body
    prelude: Body = ()
    step: Body = ()
    otherwise: Body = ()
    body_first: bool = False
    dynamic: bool = True
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class ForEach:
    """A round for each element, which is in the target; `otherwise` once there is no more.

    With `by_reference` the target stands for the element itself. `waits` is whether other code
    may run before each round.
    """

    target: Lvalue
    iterable: Expression
    body: Body
    otherwise: Body = ()
    by_reference: bool = False
    waits: bool = False
    dynamic: bool = True
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Case:
    """A place where a switch may enter: at one of these constants, or else (`is_default`)."""

    values: tuple[Expression, ...]
    body: Body
    is_default: bool = False
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Switch:
    """Enters at the case of the value; from the end of a case it goes on into the next."""

    value: Expression
    cases: tuple[Case, ...]
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Handler:
    """What is done with exceptions that are of one of the types; without types, with all.

    `prelude` runs before the types are evaluated. The target is deleted at the end.
    """

    types: tuple[Expression, ...] | None
    body: Body
    target: Lvalue | None = None
    prelude: Body = ()
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Try:
    """The first handler that fits handles; `otherwise` runs if nothing was raised; `final` runs
    however all of it is left, with the value of a `return` already computed.

    Scopes whose objects have destructors are such blocks too.
    """

    body: Body
    handlers: tuple[Handler, ...] = ()
    otherwise: Body = ()
    final: Body = ()
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class With:
    """Enters a context, stores what that gives, runs the body, and exits however it is left.

    What exits is told of an exception, and may swallow it. `waits` as in `ForEach`.
    """

    context: Expression
    target: Temporary | None
    body: Body
    waits: bool = False
    place: Span = place_field()


@dataclass(frozen=True, slots=True)
class Unsequenced:
    """Parts whose order the language leaves open: each may run before or between the others."""

    parts: tuple[Body, ...]
    place: Span = place_field()


Simple: TypeAlias = (
    Evaluate
    | Assign
    | CompoundAssign
    | Unpack
    | Insert
    | Declare
    | Delete
    | Call
    | Construct
    | Destroy
    | Import
    | DefineClass
    | Yield
    | Await
    | Unsupported
    | Return
    | Raise
    | Break
    | Continue
)
Structured: TypeAlias = Assert | Block | If | Loop | ForEach | Switch | Try | With | Unsequenced
Statement: TypeAlias = Simple | Structured
Body: TypeAlias = tuple[Statement, ...]
