"""With what code gives its own node arguments, and what takes those of the program."""

from __future__ import annotations

from collections.abc import Mapping

from rebsync.reverse.libraries.registry import derived, libraries
from rebsync.reverse.libraries.routines import Language, Routine


@derived
def own_in_cpp() -> Mapping[str, str]:
    """Methods that give a node arguments, each with the value that says nothing."""
    return _own(Language.CPP)


@derived
def own_in_python() -> Mapping[str, str]:
    """The same of keywords."""
    return _own(Language.PYTHON)


@derived
def taking_in_cpp() -> Mapping[str, Routine]:
    """What takes the arguments of the program, by full names."""
    return _taking(Language.CPP)


@derived
def taking_in_python() -> Mapping[str, Routine]:
    """The same of Python."""
    return _taking(Language.PYTHON)


def _own(language: Language) -> dict[str, str]:
    return {n: t for library in libraries(language) for n, t in library.own_arguments.items()}


def _taking(language: Language) -> dict[str, Routine]:
    found = ((n, r) for library in libraries(language) for n, r in library.functions.items())
    return {n: r for n, r in found if "arguments" in r.arguments}
