"""Fields of messages in the wiring of generated nodes: they follow the parameters of servers.

Extraction reads which values a function hands on, in which order, and lists what is not handed on;
so the fields that stand in it say nothing more, and a field may go with its parameter.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from rebsync.names import field_names
from rebsync.reserved import RUNTIME_CLASSES
from rebsync.reverse.scaffold.fact import Fact, Facts
from rebsync.roundtrip.diff.difference import Comparison, Removed, Renamed

_WORD = re.compile(r"\w+")


def is_told_of(field: Fact, base: Facts, today: Facts, of_code: Comparison) -> bool:
    """Whether a field may be another: it goes with a parameter, or extraction tells of its name.

    Of the names in messages of the run-time part, which its own code has, it tells nothing.
    """
    if field.owner in RUNTIME_CLASSES:
        return False
    if field.key not in today and _goes_with_parameter(field, of_code):
        return True
    return _types(base, field.owner) == _types(today, field.owner)


def is_renamed(before: Iterable[Fact], now: Iterable[Fact], of_code: Comparison) -> bool:
    """Whether a state message is told the same state variable, which the code has renamed."""
    old, new = ({_WORD.sub(_bare, fact.value) for fact in facts} for facts in (before, now))
    names = {
        d.element.path.rpartition(".")[2]: d.name.rpartition(".")[2]
        for d in of_code.differences
        if isinstance(d, Renamed) and d.element.kind == "statevar"
    }
    return {_WORD.sub(lambda m: names.get(m[0], m[0]), value) for value in old} == new


def _bare(word: re.Match[str]) -> str:
    """A name without the signs that tell that it is a member's."""
    return word[0].strip("_")


def _types(facts: Facts, message: str) -> list[str]:
    """The types of a message's fields in their order."""
    owned = (found for (kind, m, _), found in facts.items() if (kind, m) == ("field", message))
    return [fact.value for found in owned for fact in found]


def _goes_with_parameter(field: Fact, of_code: Comparison) -> bool:
    """Whether a field of a message is that of a parameter that the code has no longer."""
    removed = (d.element for d in of_code.differences if isinstance(d, Removed))
    paths = (e.path.split(".") for e in removed if e.kind == "parameter" and e.path.count(".") == 2)
    return any(
        f"{owner}{server}".lower() == field.owner.lower() and field_names([name]) == (field.name,)
        for owner, server, name in paths
    )
