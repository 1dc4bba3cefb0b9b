"""Contexts of client libraries, which `with` enters and leaves."""

from __future__ import annotations

from rebsync.reverse.libraries.python import clients
from rebsync.reverse.libraries.registry import derived
from rebsync.reverse.libraries.routines import Kind


@derived
def starting_contexts() -> frozenset[str]:
    """Functions that give what starts a program where `with` enters it, and ends it behind that."""
    classes = {
        owner
        for library in clients()
        for owner, methods in library.methods.items()
        if (enter := methods.get("__enter__")) is not None and enter.kind is Kind.START
    }
    functions = (each for library in clients() for each in library.functions.items())
    return frozenset(name for name, routine in functions if routine.result in classes)
