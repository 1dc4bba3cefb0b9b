"""What a callable of a library does, as the analyses of the intermediate form want it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from rebsync.records import dataclass

RECEIVER = -1
WITH, IMPORT = ".with", ".import"


@dataclass(frozen=True, slots=True)
class LibraryEffect:
    """What one callable may do.

    `elements` are the arguments (by their places, `RECEIVER` for the object of a method) of which
    it may change elements, `members` those of which it may change anything. With `calls` it may use
    operators and methods that the classes of its arguments have, and ask them for elements; with
    `applies` it may call the arguments themselves. One that `acts` does what can be seen outside of
    the program; one that `registers` keeps functions among its arguments, to be called later.
    """

    elements: frozenset[int] = frozenset()
    members: frozenset[int] = frozenset()
    calls: bool = True
    applies: bool = False
    acts: bool = False
    registers: bool = False
    raises: bool = True
    blocks: bool = False


# By the full name of a function or class; `.name` is a method of an object whose class is not
# known, `WITH` what contexts do that are entered, `IMPORT` what importing a module does. None:
# nothing is known, so that it may do anything.
LibraryTable: TypeAlias = Callable[[str], LibraryEffect | None]


def nothing_known(name: str) -> LibraryEffect | None:
    """The table without entries."""
    return None
