"""Abstract locations: what functions may share, each standing for many places in memory.

Attributes are told apart by their names, not by their objects (field-based); all elements of all
containers are one location.
"""

from __future__ import annotations

from typing import TypeAlias

from rebsync.records import dataclass


@dataclass(frozen=True, slots=True)
class GlobalVariable:
    """A variable of a module."""

    module: str
    name: str


@dataclass(frozen=True, slots=True)
class CapturedVariable:
    """A local variable of all calls of a function that functions within it share."""

    function: str
    name: str


@dataclass(frozen=True, slots=True)
class Member:
    """An attribute of any object, class or module; any attribute where the name is None."""

    name: str | None


@dataclass(frozen=True, slots=True)
class Elements:
    """All elements of all containers."""


Location: TypeAlias = GlobalVariable | CapturedVariable | Member | Elements


def covers(locations: frozenset[Location], location: Location) -> bool:
    """Whether a location is among those of a set."""
    if location in locations:
        return True
    return isinstance(location, Member) and Member(None) in locations
