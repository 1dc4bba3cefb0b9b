"""What is known where a statement stands: sizes of containers, keys that are there, what is true.

Facts are about expressions as they are written. An assignment ends those that name its target, and
whatever may take elements out of a container ends those about all containers.
"""

from __future__ import annotations

from typing import TypeAlias

from rebsync.intervals import ANY, Interval, compared, exactly
from rebsync.records import dataclass
from rebsync.reverse.analysis.python.value_types import ANY_TYPE, ValueTypes
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import MIRRORED, Operator
from rebsync.reverse.ir.walk import walk

_LIMIT = 8


@dataclass(frozen=True, slots=True)
class HasSize:
    """A container has so many elements, or more."""

    container: e.Expression
    size: int


@dataclass(frozen=True, slots=True)
class HasKey:
    """A container has something at a key or index."""

    container: e.Expression
    key: e.Expression


@dataclass(frozen=True, slots=True)
class Holds:
    """A value is other than nothing: true, not zero, or there."""

    value: e.Expression


@dataclass(frozen=True, slots=True)
class IsThere:
    """A value was other than None, and the function has stored nothing in it since then."""

    value: e.Expression


@dataclass(frozen=True, slots=True)
class IsBound:
    """A local variable, or an attribute of the function's object, has got a value."""

    value: e.Expression


@dataclass(frozen=True, slots=True)
class IsSize:
    """A value was the number of elements of a container."""

    value: e.Expression
    container: e.Expression


@dataclass(frozen=True, slots=True)
class IsSame:
    """A temporary holds what a variable does."""

    value: e.Temporary
    other: e.Expression


@dataclass(frozen=True, slots=True)
class IsBelow:
    """A value is a whole number from zero to before a bound."""

    value: e.Expression
    bound: int


@dataclass(frozen=True, slots=True)
class IsWithin:
    """A value was compared with numbers; where it is a whole one, it is of an interval."""

    value: e.Expression
    interval: Interval


@dataclass(frozen=True, slots=True)
class IsLess:
    """A value is less than another."""

    value: e.Expression
    other: e.Expression


@dataclass(frozen=True, slots=True)
class IsEnd:
    """A value is the iterator behind the last element of a container."""

    value: e.Expression


@dataclass(frozen=True, slots=True)
class IsPositive:
    """A value is a number that is not negative."""

    value: e.Expression


@dataclass(frozen=True, slots=True)
class IsOf:
    """A value is of one of some types; None among these is any type."""

    value: e.Expression
    types: ValueTypes


@dataclass(frozen=True, slots=True)
class Implies:
    """If a value counts as true (or as false), something else is so as well."""

    value: e.Expression
    is_true: bool
    fact: HasSize | HasKey | IsThere | IsOf


Fact: TypeAlias = (
    HasSize
    | HasKey
    | Holds
    | IsThere
    | IsBound
    | IsSize
    | IsSame
    | IsBelow
    | IsWithin
    | IsLess
    | IsEnd
    | IsPositive
    | IsOf
    | Implies
)
Facts: TypeAlias = frozenset[Fact]
NO_FACTS: Facts = frozenset()


def sized(container: e.Expression, size: int) -> Facts:
    """That a container has some elements; fewer are implied, so that facts can be intersected."""
    return frozenset(HasSize(container, n) for n in range(1, min(size, _LIMIT) + 1))


def size_of(facts: Facts, container: e.Expression) -> int:
    """How many elements a container is known to have."""
    sizes = (f.size for f in facts if isinstance(f, HasSize) and f.container == container)
    return max(sizes, default=0)


def names_of(facts: Facts, value: e.Expression) -> frozenset[e.Expression]:
    """A value, and what else is known to be the same."""
    others = (f.other for f in facts if isinstance(f, IsSame) and f.value == value)
    return frozenset({value, *others})


def _led_to(facts: Facts, target: e.Expression) -> e.Expression:
    """What is stored in where a temporary has its address; else the target itself."""
    if isinstance(target, e.Dereference):
        for other in names_of(facts, target.reference):
            if isinstance(other, e.AddressOf):
                return other.target
    return target


def without(facts: Facts, target: e.Expression) -> Facts:
    """The facts that are left when something else is stored in a target."""
    base = target
    while isinstance(base, e.Index):
        base = base.object
    if isinstance(base, e.Dereference):
        facts = _without_referred(facts, base)
    kept = isinstance(target, e.Index)
    return frozenset(f for f in facts if isinstance(f, IsBound) or not _names(f, base, kept))


def _without_referred(facts: Facts, target: e.Dereference) -> Facts:
    """The facts that are left when what something refers to has changed, whatever that is.

    Pointers stay what they were, unless it is one.
    """
    is_pointer = isinstance(getattr(target, "type", None), t.Reference)

    def is_apart(value: e.Expression) -> bool:
        is_local = isinstance(value, e.Local) and isinstance(value.type, t.Reference)
        return isinstance(value, e.Temporary) or (is_local and not is_pointer)

    return frozenset(
        f for f in facts if isinstance(f, IsBound) or all(map(is_apart, _expressions(f)))
    )


def stored(facts: Facts, target: e.Expression, types: ValueTypes | None = None) -> Facts:
    """What is known when something of some types is stored in a target, which then has a value."""
    is_of = IsOf(target, ANY_TYPE if types is None else types)
    return without(facts, _led_to(facts, target)) | {IsBound(target), is_of}


def is_bound(fact: Fact) -> bool:
    """Whether a fact says that a variable has a value."""
    return isinstance(fact, IsBound)


def without_shared(facts: Facts) -> Facts:
    """The facts that are left when other code ran: those of variables of the function only.

    What was there and what has a value is asked together with what other code stores.
    """
    lasting = (IsThere, IsBound)
    return frozenset(
        f for f in facts if isinstance(f, lasting) or not any(map(_is_shared, _expressions(f)))
    )


def without_sizes(facts: Facts) -> Facts:
    """The facts that are left when some container may have lost elements."""
    lost = (HasSize, HasKey, IsSize, Implies)
    return frozenset(f for f in facts if not isinstance(f, lost))


def _expressions(fact: Fact) -> tuple[e.Expression, ...]:
    match fact:
        case HasSize(container):
            return (container,)
        case HasKey(container, key):
            return container, key
        case Holds(value) | IsThere(value) | IsBound(value) | IsBelow(value) | IsPositive(value):
            return (value,)
        case IsWithin(value) | IsEnd(value):
            return (value,)
        case IsLess(value, other):
            return value, other
        case IsSize(value, container):
            return value, container
        case IsSame(value, other):
            return value, other
        case IsOf(value):
            return (value,)
        case Implies(value, _, inner):
            return value, *_expressions(inner)


def _names(fact: Fact, base: e.Expression, is_part: bool) -> bool:
    """Whether a fact is about what is stored in; to store in a part leaves sizes as they are."""
    for expression in _expressions(fact):
        for node in walk(expression):
            if node == base and not (is_part and expression == base):
                return True
            same = isinstance(node, e.Attribute) and isinstance(base, e.Attribute)
            if same and node.name == base.name:  # type: ignore[union-attr]
                return True
    return False


def _is_shared(expression: e.Expression) -> bool:
    shared = (e.Global, e.Captured, e.Attribute, e.Index, e.Dereference)
    return any(isinstance(n, shared) for n in walk(expression))


def joined(one: Facts | None, other: Facts | None) -> Facts | None:
    """What is known where two ways meet."""
    if one is None or other is None:
        return other if one is None else one
    return one & other


# --- what tests say -------------------------------------------------------------------------------

_OPPOSITE = {
    Operator.EQUAL: Operator.UNEQUAL,
    Operator.UNEQUAL: Operator.EQUAL,
    Operator.LESS: Operator.GREATER_EQUAL,
    Operator.GREATER_EQUAL: Operator.LESS,
    Operator.GREATER: Operator.LESS_EQUAL,
    Operator.LESS_EQUAL: Operator.GREATER,
    Operator.IN: Operator.NOT_IN,
    Operator.NOT_IN: Operator.IN,
    Operator.SAME: Operator.NOT_SAME,
    Operator.NOT_SAME: Operator.SAME,
}
_AT_LEAST = (Operator.GREATER, Operator.GREATER_EQUAL, Operator.EQUAL)


def tested(facts: Facts, test: e.Expression, is_true: bool) -> Facts:
    """What is known where a test was true, or false."""
    match test:
        case e.Unary(Operator.NOT, operand):
            return tested(facts, operand, not is_true)
        case e.And(left, right) if is_true:
            return tested(tested(facts, left, True), right, True)
        case e.Or(left, right) if not is_true:
            return tested(tested(facts, left, False), right, False)
        case e.Convert(_, operand):
            return tested(facts, operand, is_true) | _held(facts, test, is_true)
        case e.Conditional(inner, e.Literal(then), e.Literal(otherwise)):
            if bool(then) != bool(otherwise):
                return tested(facts, inner, is_true == bool(then))
            return facts
        case e.Binary(operator, left, right) if operator in _OPPOSITE:
            return _compared(facts, operator if is_true else _OPPOSITE[operator], left, right)
        case e.Temporary():  # of `a and f()`, which asks `a` first
            for other in names_of(facts, test) - {test}:
                facts = tested(facts, other, is_true)
            return _held(facts, test, is_true)
        case _:
            return _held(facts, test, is_true)


def _held(facts: Facts, value: e.Expression, is_true: bool) -> Facts:
    """A value that counts as true is not nothing, and a container is not empty."""
    found = set(facts)
    if is_true:
        found |= {Holds(value), IsThere(value), HasSize(value, 1)}
        found |= {
            HasSize(f.container, 1) for f in facts if isinstance(f, IsSize) and f.value == value
        }
    for fact in facts:
        if isinstance(fact, Implies) and fact.value == value and fact.is_true == is_true:
            found.add(fact.fact)
    return frozenset(found)


def _compared(facts: Facts, operator: Operator, left: e.Expression, right: e.Expression) -> Facts:
    if operator is Operator.IN:
        return facts | {HasKey(right, left)}
    if isinstance(left, e.Literal) and not isinstance(right, e.Literal):
        return _compared(facts, MIRRORED.get(operator, operator), right, left)
    if not isinstance(right, e.Literal):
        return facts | _between(facts, operator, left, right)
    number = right.value
    if number is None and operator in (Operator.NOT_SAME, Operator.UNEQUAL):
        return facts | {Holds(left), IsThere(left)}
    if not isinstance(number, int | float):
        return facts
    is_zero = number == 0
    facts |= _within(operator, left, number)
    if operator is Operator.EQUAL and is_zero:
        return _held(facts, left, False)
    excludes = {
        Operator.UNEQUAL: is_zero,
        Operator.EQUAL: not is_zero,
        Operator.GREATER: number >= 0,
        Operator.LESS: number <= 0,
        Operator.GREATER_EQUAL: number > 0,
        Operator.LESS_EQUAL: number < 0,
    }
    if excludes.get(operator, False):
        facts = _held(facts, left, True)
    if operator in _AT_LEAST and number >= 0:
        facts |= {IsPositive(left), IsPositive(bare(left))}
    least = {Operator.GREATER: number + 1, Operator.GREATER_EQUAL: number, Operator.EQUAL: number}
    if operator in least:
        for fact in list(facts):
            if isinstance(fact, IsSize) and fact.value == bare(left):
                facts |= sized(fact.container, int(least[operator]))
    return facts


def _between(facts: Facts, operator: Operator, left: e.Expression, right: e.Expression) -> Facts:
    """What it says of values to be less than another, or other than the end of a container.

    The one is said of a number as well before it became one without a sign.
    """
    if operator is Operator.UNEQUAL and any(IsEnd(v) in facts for v in (left, right)):
        return frozenset({Holds(left), Holds(right)})
    if operator is Operator.GREATER:
        operator, left, right = Operator.LESS, right, left
    less = {left, bare(left)} if operator is Operator.LESS else ()
    return frozenset(IsLess(value, right) for value in less)


def _within(operator: Operator, value: e.Expression, number: float) -> Facts:
    """The interval of the whole numbers that a comparison with a number lets through."""
    if not isinstance(number, int):
        return NO_FACTS
    interval = compared(ANY, operator.value, exactly(number))
    return NO_FACTS if interval in (None, ANY) else frozenset({IsWithin(value, interval)})


def bare(value: e.Expression) -> e.Expression:
    """A value without the conversions around it."""
    while isinstance(value, e.Convert):
        value = value.operand
    return value
