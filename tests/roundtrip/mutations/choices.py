"""What stands in for numbers, state variables, rebecs and statements, in whatever language."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from tests.roundtrip.mutations.package import Edit, Package, Part, Texts, within


def stepped(by: int, *, shown: str = "{}") -> Texts:
    """A number that is greater; the last group of the match, or the whole of it."""

    def text(package: Package, part: Part, found: re.Match[str]) -> str:
        return shown.format(int(found[found.re.groups]) + by)

    return text


def other_member(package: Package, part: Part, found: re.Match[str]) -> str | None:
    """Another state variable of the same type for the one called `name`."""
    members = package.members_of(part.owner)
    own = next((m for m in members if m.name == found["name"]), None)
    if own is None:
        return None
    others = [m for m in members if m.type == own.type and m != own]
    return found[0].replace(own.name, others[0].name, 1) if others else None


def other_rebec(pattern: str) -> Texts:
    """Another rebec that a method of the same file gives, as the pattern finds them."""
    given = re.compile(pattern, re.MULTILINE)

    def text(package: Package, part: Part, found: re.Match[str]) -> str | None:
        names = sorted(set(given.findall(package.files[part.path])))
        others = [n for n in names if n != found[1]]
        if found[1] not in names or not others:
            return None
        return found[0].replace(found[1], others[0])

    return text


def swapped(depend: Callable[[str, str], bool]) -> Texts:
    """Two statements in the other order, where that makes a difference."""

    def text(package: Package, part: Part, found: re.Match[str]) -> str | None:
        first, second = found["first"], found["second"]
        both = found["indent"] + second + found["indent"] + first
        return both if depend(first, second) else None

    return text


def edits(package: Package, pattern: str, text: Texts) -> Iterator[Edit]:
    """The edits in bodies, for patterns that are put together."""
    yield from (e for e in within(pattern, text)(package) if isinstance(e, Edit))
