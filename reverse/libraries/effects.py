"""What a call of a library does, for analyses: effect, purity, blocking, what is written.

Asked for by a function's full name. What no table has may do anything. Functions of the standard
libraries do what is said of them with values of plain types: an object's own operators and
conversions, which they may call, are code of its own.
"""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.records import dataclass
from rebsync.reverse.libraries.registry import libraries
from rebsync.reverse.libraries.routines import (
    Effect,
    Kind,
    Language,
    Routine,
)

_PREFIXES = ("std::this_thread::", "std::", "boost::")
_CALLING = frozenset({Kind.HOOK, Kind.START, Kind.OTHER})


@dataclass(frozen=True, slots=True)
class CallEffect:
    """What a call does besides giving its result.

    `writes` are the places of arguments that it may write, -1 that of the object it is called on;
    None where it may write anything. One that calls its arguments is not pure.
    """

    effect: Effect
    is_pure: bool
    writes: frozenset[int] | None


UNKNOWN = CallEffect(Effect.UNKNOWN, False, None)


def of_function(language: Language, name: str) -> CallEffect:
    """What a function, macro or constructor does, by its full name."""
    names = _names(language, name)
    found = [_of(r) for candidate in names for r in _functions(language, candidate)]
    return found[0] if found and all(f == found[0] for f in found) else UNKNOWN


def _names(language: Language, name: str) -> Iterator[str]:
    """The names under which a function may stand in a table."""
    if language is Language.PYTHON:
        yield name
        return
    plain = name.removeprefix("::")
    yield plain
    for prefix in _PREFIXES:
        if plain.startswith(prefix):
            yield plain.removeprefix(prefix)


def _functions(language: Language, name: str) -> Iterator[Routine]:
    for library in libraries(language):
        if name in library.functions:
            yield library.functions[name]


def _of(routine: Routine) -> CallEffect:
    writes = routine.written
    if routine.effect is Effect.CHANGES and not writes:
        return CallEffect(routine.effect, False, None)
    calls = routine.effect is Effect.ASKS or routine.kind in _CALLING
    is_called = calls and any(role == "callback" for _, role in routine.keywords)
    pure = routine.is_pure and not routine.callbacks and not is_called
    return CallEffect(routine.effect, pure, writes)
