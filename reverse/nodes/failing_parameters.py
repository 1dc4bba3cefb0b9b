"""Parameters that end the start of a node of ROS 2, by what it asks: in C++ and in Python."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rebsync.reverse.graph import Fact, ParameterFact
from rebsync.reverse.libraries.routines import Access
from rebsync.reverse.syntax.cpp_tree import text_of

_AGAIN = "this parameter is declared elsewhere too: the second time raises an exception"
_ASKING = b"if_not_declared"  # in the names of helpers that look first


def failing_parameters(facts: Iterable[Fact]) -> Iterator[tuple[ParameterFact, str]]:
    """What declares a parameter again, which nobody asks for whether it is there."""
    asked = [f for f in facts if isinstance(f, ParameterFact) and isinstance(f.name, str)]
    looked_for = {f.name for f in asked if f.access is Access.HAS}
    first: dict[object, ParameterFact] = {}
    for fact in asked:
        if fact.access is not Access.DECLARE or _ASKING in (fact.site.call.text or b""):
            continue
        before = first.setdefault(fact.name, fact)
        if fact.name not in looked_for and before.site.place != fact.site.place:
            yield fact, _AGAIN
