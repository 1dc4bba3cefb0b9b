"""The ends of actions that C++ makes: their servers and clients, each with its name and type.

What an action does has no place in a model, and what makes one must stay a call that may do
anything.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from tree_sitter import Node

from rebsync.reverse.calls.receivers import is_text
from rebsync.reverse.calls.ros_calls_facts import Facts
from rebsync.reverse.calls.ros_calls_shapes import Asked, called_as, objects_of, types_of
from rebsync.reverse.calls.ros_calls_sites import site_of
from rebsync.reverse.graph import ClientFact, ServiceFact, Unmodelled, UnmodelledFact
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.cpp_calls import last
from rebsync.reverse.libraries.routines import Kind, Routine
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of
from rebsync.reverse.values.cpp_values import Values

_AROUND = frozenset({"template_type", "template_function", "qualified_identifier"})
_AS_SERVICE = {Kind.ACTION_SERVER: Kind.SERVICE, Kind.ACTION_CLIENT: Kind.CLIENT}
_FIRST_NAMES = 5  # arguments among which the name is: up to four interfaces of a node come first


def actions_in(values: Values) -> Iterator[UnmodelledFact]:
    """The servers and clients of actions, read as those of services are."""
    facts = Facts(values)
    for full, (routine, library) in libraries.unmodelled().items():
        if routine.kind not in _AS_SERVICE:
            continue
        ask, what = replace(routine, kind=_AS_SERVICE[routine.kind]), Unmodelled[routine.kind.name]
        scope = full.rpartition("::")[0]
        for cpp, place in values.texts.everywhere(last(full)):
            for asked in _asked(values, cpp, place, ask, scope, library.flat):
                for fact in facts.of(asked):
                    if isinstance(fact, ServiceFact | ClientFact):
                        yield UnmodelledFact(fact.site, what, fact.name, fact.type)


def _asked(
    values: Values, cpp: Cpp, place: Node, routine: Routine, scope: str, is_flat: bool
) -> Iterator[Asked]:
    """`scope::create_server<T>(node, "name", ...)`, or objects of a class that is a template."""
    node, above = place, place.parent
    while above is not None and above.type in _AROUND:
        if above.type == "qualified_identifier" and part(above, "name") != node:
            return
        node, above = above, above.parent
    types = types_of(node)
    if above is None or not types:
        return
    if above.type == "field_initializer":
        return
    for call, given in _made(node, above, place, is_flat, scope):
        ask = replace(routine, arguments=_roles(values, cpp, given, routine))
        yield Asked(ask, site_of(values, cpp, place, call), given, types)
    if not is_flat and above.type == "field_declaration":
        yield from _of_member(values, above, routine, types)


def _made(
    node: Node, above: Node, place: Node, is_flat: bool, scope: str
) -> Iterator[tuple[Node, tuple[Node, ...]]]:
    if not is_flat:
        yield from objects_of(node, above)
        return
    inner = place.parent if place.parent is not None else place
    called = called_as(inner, inner.parent) if inner.parent is not None else None
    if called is not None and called[0] == scope:
        yield called[1], tuple(named(part(called[1], "arguments")))


def _of_member(
    values: Values,
    declared: Node,
    routine: Routine,
    types: tuple[Node, ...],
) -> Iterator[Asked]:
    """A member that the constructor of its class makes: `: server_(nh, "name", ...)`."""
    names = [text_of(n) for n in declared.children_by_field_name("declarator")]
    for name in names:
        for file, used in values.texts.everywhere(name):
            entry = used.parent
            if entry is None or entry.type != "field_initializer":
                continue
            inner = named(entry)
            given = tuple(named(inner[-1])) if len(inner) > 1 else ()
            if given:
                ask = replace(routine, arguments=_roles(values, file, given, routine))
                yield Asked(ask, site_of(values, file, used, entry), given, types)


def _roles(values: Values, cpp: Cpp, given: tuple[Node, ...], routine: Routine) -> tuple[str, ...]:
    """The roles of arguments: the name is the first that is a text."""
    at = next((i for i, a in enumerate(given[:_FIRST_NAMES]) if is_text(values, cpp, a)), None)
    if at is None:
        return routine.arguments
    first = routine.arguments[0] if at == 1 else ""
    return (*([first] if at else []), *([""] * (at - 1)), "name")
