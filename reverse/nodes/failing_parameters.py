"""Parameters that end the start of a node of ROS 2, by what it asks: in C++ and in Python."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from rebsync.reverse.graph import Fact, ParameterFact
from rebsync.reverse.libraries.routines import Access

_AGAIN = "this parameter is declared elsewhere too: the second time raises an exception"
_MISSING = "nobody is known to declare this parameter: to ask for it raises an exception then"
_ASKING = b"if_not_declared"  # in the names of helpers that look first
_ALLOWED = b"allow_undeclared_parameters"
_ALWAYS = frozenset({"use_sim_time", "start_type_description_service"})


def declared_again(facts: Iterable[Fact]) -> Iterator[tuple[ParameterFact, str]]:
    """What declares a parameter again, which nobody asks for whether it is there."""
    asked = _named(facts)
    looked_for = {f.name for f in asked if f.access is Access.HAS}
    first: dict[object, ParameterFact] = {}
    for fact in asked:
        if fact.access is not Access.DECLARE or _ASKING in (fact.site.call.text or b""):
            continue
        before = first.setdefault(fact.name, fact)
        if fact.name not in looked_for and before.site.place != fact.site.place:
            yield fact, _AGAIN


def never_declared(facts: Sequence[Fact]) -> Iterator[tuple[ParameterFact, str]]:
    """What asks in C++ by its name alone for a parameter that nothing here declares.

    Where names of parameters that are declared are not known, each may be one of them.
    """
    declaring = [f for f in facts if isinstance(f, ParameterFact) and f.access is Access.DECLARE]
    if any(not isinstance(f.name, str) for f in declaring):
        return
    declared = _ALWAYS | {f.name for f in declaring}
    for fact in _named(facts):
        if fact.access is Access.GET and fact.name not in declared and _is_by_name_alone(fact):
            yield fact, _MISSING


def _named(facts: Iterable[Fact]) -> list[ParameterFact]:
    return [f for f in facts if isinstance(f, ParameterFact) and isinstance(f.name, str)]


def _is_by_name_alone(fact: ParameterFact) -> bool:
    """Whether it is asked for so that it has to be declared, in a file that does not do that."""
    call, text = fact.site.call, fact.site.cpp.source.text
    function, given = (call.child_by_field_name(n) for n in ("function", "arguments"))
    if function is None or given is None or not (function.text or b"").endswith(b"get_parameter"):
        return False
    of_file = rf'declare_param[^;]*"{re.escape(str(fact.name))}"'
    alone = sum(n.type != "comment" for n in given.named_children) == 1
    return alone and _ALLOWED not in fact.site.cpp.words and re.search(of_file, text) is None
