"""What holds of every table of a library."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from rebsync.reverse.libraries.registry import libraries
from rebsync.reverse.libraries.routines import Kind, Language, Library, Routine

ALL = [library for language in Language for library in libraries(language)]
_NAMED = frozenset({Kind.PUBLISHER, Kind.SUBSCRIPTION, Kind.SINGLE, Kind.SERVICE, Kind.CLIENT})


def routines(library: Library) -> Iterator[tuple[str, Routine]]:
    yield from library.functions.items()
    for methods in library.methods.values():
        yield from methods.items()


def test_the_four_client_libraries_are_there() -> None:
    names = {library.name for library in ALL}
    assert {"roscpp", "rclcpp", "rospy", "rclpy", "std", "Python"} <= names


@pytest.mark.parametrize("library", ALL, ids=lambda library: library.name)
def test_roles_and_kinds_fit(library: Library) -> None:
    for name, routine in routines(library):
        roles = (*routine.arguments, *(role for _, role in routine.keywords))
        if routine.kind in _NAMED:
            assert "name" in roles, name
        if routine.kind in (Kind.PARAMETER, Kind.DECLARED, Kind.SET):
            assert routine.access is not None, name
        if routine.kind is Kind.TIMER:
            assert {"period", "callback"} <= set(roles), name
        assert routine.access is None or routine.kind in (
            *(Kind.PARAMETER, Kind.DECLARED, Kind.SET, Kind.READ),
        )
        assert set(routine.writes) <= {*routine.arguments, "self"}, name


@pytest.mark.parametrize("library", ALL, ids=lambda library: library.name)
def test_names_are_spelled_as_the_language_has_them(library: Library) -> None:
    other = "." if library.language is Language.CPP else "::"
    assert not [n for n, _ in routines(library) if other in n]
