"""How programs of Python start and end: contexts that `with` enters, and what only tidies up."""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.reverse.libraries.python import clients
from rebsync.reverse.libraries.registry import derived
from rebsync.reverse.libraries.routines import Effect, Kind, Routine


@derived
def starting_contexts() -> frozenset[str]:
    """Functions that give what starts a program where `with` enters it, and ends it behind that."""
    classes = {
        owner
        for library in clients()
        for owner, methods in library.methods.items()
        if (enter := methods.get("__enter__")) is not None and enter.kind is Kind.START
    }
    return frozenset(name for name, routine in _functions() if routine.result in classes)


@derived
def over() -> frozenset[str]:
    """Names of what only tidies up when a program ends."""
    methods = (
        each for library in clients() for of in library.methods.values() for each in of.items()
    )
    found = (
        (n.rpartition(".")[2], r) for n, r in (*_functions(), *methods) if r.kind is Kind.START
    )
    return frozenset(n for n, r in found if r.effect is Effect.ENDS)


def _functions() -> Iterator[tuple[str, Routine]]:
    for library in clients():
        yield from library.functions.items()
