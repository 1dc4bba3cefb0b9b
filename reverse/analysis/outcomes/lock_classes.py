"""Classes and functions of libraries that lock: guards, mutexes, what locks otherwise."""

from __future__ import annotations

import re

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import types as t

_GUARDS = frozenset({"lock_guard", "unique_lock", "scoped_lock", "shared_lock"})
# Functions that lock, or wait, besides.
OTHERWISE = re.compile(
    r"(?:std::)?(?:try_)?lock|pthread_\w*(?<!un)lock|pthread_\w*wait\w*|sem_\w*wait"
)
BY_HAND = frozenset({"lock", "lock_shared", "try_lock", "try_lock_for", "try_lock_until"})

UNLOCKS = frozenset({"unlock", "unlock_shared"})


def is_guard(name: str) -> bool:
    """Whether a class is a guard; or what makes objects of one, as `std::make_unique` does."""
    plain, _, of = name.partition("<")
    if plain.rpartition("::")[2].startswith("make_"):
        plain = of.partition("<")[0].partition(">")[0]
    return plain.rpartition("::")[2] in _GUARDS


def has_guard(type_: t.Type) -> bool:
    """Whether objects of a type have guards in them, which others may put there and take out."""
    match type_:
        case t.Optional(inner) | t.Array(inner):
            return is_or_has_guard(inner)
        case t.Reference(inner, _, ownership):
            return ownership is not t.Ownership.NONE and is_or_has_guard(inner)
        case t.Container(_, elements):
            return any(map(is_or_has_guard, elements))
        case _:
            return False


def is_or_has_guard(type_: t.Type) -> bool:
    """Whether objects of a type are guards, or have some in them."""
    return has_guard(type_) or (isinstance(type_, t.Record) and is_guard(type_.name))


def is_mutex(value: e.Expression) -> bool:
    """Whether a value is a mutex of a library, or a reference to one."""
    while isinstance(value, e.AddressOf | e.Dereference | e.Convert | e.Copy | e.Move):
        value = inner_of(value)
    type_ = getattr(value, "type", t.UNKNOWN)
    type_ = type_.to if isinstance(type_, t.Reference) else type_
    return isinstance(type_, t.Record) and type_.name.endswith("mutex")


def is_by_hand(name: str) -> bool:
    """Whether a method locks a mutex until somebody unlocks it."""
    of, _, method = name.rpartition("::")
    return of.endswith("mutex") and "recursive" not in of and method in BY_HAND


def is_tag(value: e.Expression) -> bool:
    """Whether an argument only says how to lock."""
    return isinstance(value, e.LibraryReference | e.Literal)


def inner_of(
    value: e.AddressOf | e.Dereference | e.Convert | e.Copy | e.Move,
) -> e.Expression:
    """What leads to something, or is made of it."""
    match value:
        case e.AddressOf(inner) | e.Dereference(inner):
            return inner
        case e.Copy(inner) | e.Move(inner) | e.Convert(_, inner):
            return inner
