"""What keeps an object of ROS alive in C++, by which names, and what of it the middleware calls."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.graph import Fact, PublisherFact, ServiceFact, SubscriptionFact, TimerFact
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.nodes.node_kept import FILLS, LOOKS, is_appended
from rebsync.reverse.nodes.node_units import Unit, bodies
from rebsync.reverse.syntax.ancestors import ancestors, holds
from rebsync.reverse.syntax.cpp_calls import call_of
from rebsync.reverse.syntax.cpp_declarations import CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, part, text_of

_NUMBERS = frozenset({"true", "false", "number_literal"})
_WRITTEN = _NUMBERS | {"identifier"}  # where it is known to be whether it latches
_JOINING = re.compile(r"\bcreate_\w+(<.*>)?\Z", re.DOTALL)
_PART = re.compile(r"\.|->")
_SERVED = (SubscriptionFact, TimerFact, ServiceFact)
_BRANCHES = frozenset({"else_clause", "case_statement"})
_LATCHED = 2  # the place where `advertise` takes whether it latches, or else functions


def is_kept(body: Node, made: Node, name: str, weak: Collection[str]) -> bool:
    """Whether a body may keep the local that a declarator makes: to call it does not.

    What stands within the declarator has names of its own, or ends with the local. Pointers by the
    names in `weak` keep nothing.
    """
    return any(
        text_of(node) == name and not _is_called(node) and not _is_weak(node, weak)
        for node in inside(body, "identifier")
        if not made.start_byte <= node.start_byte < made.end_byte
    )


def weak_pointers(unit: Unit) -> frozenset[str]:
    """The variables of a unit that keep nothing of what they point to."""
    fields = (f for c in unit.lineage for f in (*c.fields, *c.others))
    return frozenset(f.name for f in fields if "weak" in text_of(f.type).lower())


def _is_weak(node: Node, weak: Collection[str]) -> bool:
    """Whether a name is stored in a pointer that keeps nothing."""
    above = node.parent
    if above is None or above.type not in ("assignment_expression", "init_declarator"):
        return False
    if above.type == "init_declarator":
        return above.parent is not None and "weak" in text_of(above.parent).partition("=")[0]
    return text_of(part(above, "left")).removeprefix("this->") in weak


def _is_called(node: Node) -> bool:
    """Whether a name is only that of an object of which a part is named: `timer->reset()`."""
    above = node.parent
    return above is not None and above.type == "field_expression"


def is_local_group(call: Node, body: Node | None) -> bool:
    """Whether only a local has a group of callbacks: those who are in it do not keep it."""
    made = call.parent
    name = made.child_by_field_name("declarator") if made is not None else None
    if made is None or made.type != "init_declarator" or name is None or body is None:
        return False
    uses = (n for n in inside(body, "identifier") if text_of(n) == text_of(name))
    return all(n == name or _is_called(n) or _is_joined(n) for n in uses)


def _is_joined(node: Node) -> bool:
    """Whether something becomes part of the group that is named: `options.callback_group = g`."""
    above = node.parent
    if above is None:
        return False
    if above.type == "assignment_expression":
        return text_of(part(above, "left")).endswith("callback_group")
    call = above.parent if above.type == "argument_list" else None
    function = call.child_by_field_name("function") if call is not None else None
    return function is not None and _JOINING.search(text_of(function)) is not None


def replacing(facts: Iterable[Fact]) -> Iterator[Fact]:
    """Subscriptions and services that a variable gets in place of others, which end then."""
    first: dict[str, Fact] = {}
    for fact in facts:
        if not isinstance(fact, SubscriptionFact | ServiceFact) or "[" in fact.site.kept:
            continue
        name = fact.site.kept.removeprefix("this->")
        if not name or _is_local(fact) or is_appended(fact):
            continue
        before = first.setdefault(name, fact).site.call
        if before.id != fact.site.call.id and not _excludes(fact.site.call, before):
            yield fact


def _is_local(fact: Fact) -> bool:
    above = fact.site.call.parent
    return above is not None and above.type == "init_declarator"


def _excludes(node: Node, other: Node) -> bool:
    """Whether a node stands in a branch that does not run if that of another one did."""
    return any(
        n.type in _BRANCHES
        and not holds(n, other)
        and n.parent is not None
        and holds(n.parent, other)
        for n in ancestors(node)
    )


@dataclass(frozen=True, slots=True)
class _Handle:
    """A name of what is served: the first one that code gives it, a `copy`, or a container.

    `body` is that of the function whose local it is.
    """

    name: str
    body: Node | None
    copy: bool = False
    container: bool = False


def odd_uses(unit: Unit) -> Iterator[tuple[Cpp, Node]]:
    """Where a unit may end or stop what is served by another name than the first one.

    By a copy, or as an element of a container.
    """
    waiting = list(dict.fromkeys(_first_names(unit)))
    seen = set(waiting)
    while waiting:
        handle = waiting.pop()
        for cpp, body in bodies(unit):
            if handle.body is not None and handle.body.id != body.id:
                continue
            for node in unit.code.named(cpp, body, frozenset({handle.name})):
                match _use(node, handle, body):
                    case _Handle() as copy if copy not in seen:
                        seen.add(copy)
                        waiting.append(copy)
                    case True:
                        yield cpp, node


def _first_names(unit: Unit) -> Iterator[_Handle]:
    for fact in unit.facts:
        if not isinstance(fact, _SERVED):
            continue
        place, _, index = fact.site.kept.removeprefix("this->").partition("[")
        name = _PART.split(place)[-1]  # of a part of another object, the part
        function = fact.site.function
        if name.isidentifier():
            given = function is not None and any(p.name == name for p in function.parameters)
            is_local = function is not None and (given or _is_local(fact))
            body = function.body if function is not None and is_local else None
            copy = given or name != place
            yield _Handle(name, body, copy, bool(index) or is_appended(fact))
            yield from _handed(unit, function, name) if function is not None and given else ()
        elif (whole := _whole(fact.site.call)) is not None:
            yield _Handle(whole, None, container=True)


def _handed(unit: Unit, function: CppFunction, name: str) -> Iterator[_Handle]:
    """What calls of a function give for a parameter in which it stores what it makes."""
    at = next(n for n, p in enumerate(function.parameters) if p.name == name)
    for cpp, body in bodies(unit):
        for node in unit.code.named(cpp, body, frozenset({function.name})):
            call = call_of(node.parent) if node.parent is not None else None
            if call is not None and len(call.arguments) > at:
                given = _PART.split(text_of(call.arguments[at]))[-1]
                if given.isidentifier():
                    yield _Handle(given, None, copy=True)


def _whole(call: Node) -> str | None:
    """The variable of which an object is a part that stands among the arguments of a call."""
    if call.parent is None or call.parent.type != "argument_list":
        return None
    for above in ancestors(call, lambda n: n.type.endswith(("_statement", "definition"))):
        outer = call_of(above)
        if outer is not None and outer.name in FILLS and outer.on:
            return outer.on.removeprefix("this->")
        for field in ("left", "declarator"):
            kept = above.child_by_field_name(field)
            if above.type in ("assignment_expression", "init_declarator") and kept is not None:
                return text_of(kept).removeprefix("this->")
    return None


def _use(node: Node, handle: _Handle, body: Node) -> _Handle | bool:
    """The name that something gets at a place, or whether it may be ended there."""
    at, above = node, node.parent
    if above is not None and above.type == "field_expression" and part(above, "field") == node:
        at, above = above, above.parent  # a part of the own object, or of another one
    if above is None:
        return False
    match above.type:
        case "field_expression" if part(above, "argument") == at:
            known = FILLS | LOOKS if handle.container else libraries.looking()
            called = text_of(part(above, "field"))
            return (handle.container or handle.copy) and called not in known
        case "subscript_expression":
            return not _is_stored_in(above)
        case "assignment_expression" if part(above, "right") == at:
            return _copy(part(above, "left"), None)
        case "init_declarator" if part(above, "value") == at:
            return _copy(part(above, "declarator"), body)
        case "argument_list" if (call := above.parent and call_of(above.parent)) is not None:
            if call.name in FILLS and call.on:
                return _Handle(call.on.removeprefix("this->"), None, container=True)
            return True
        case "return_statement" | "initializer_list" | "for_range_loop":
            return True
        case _:
            return False


def _copy(place: Node, body: Node | None) -> _Handle | bool:
    name = text_of(place).removeprefix("this->")
    return _Handle(name, body, copy=True) if name.isidentifier() else True


def _is_stored_in(element: Node) -> bool:
    above = element.parent
    return (
        above is not None
        and above.type == "assignment_expression"
        and part(above, "left") == element
    )


def called_by_listeners(fact: PublisherFact) -> Node | None:
    """The first argument of `advertise` that is a function, called as subscribers come and go."""
    call = fact.site.call
    function, given = (call.child_by_field_name(n) for n in ("function", "arguments"))
    if function is None or given is None or "advertise" not in text_of(function):
        return None
    arguments = [n for n in given.named_children if n.type != "comment"]
    found = arguments[_LATCHED : _LATCHED + 1]
    flags = _WRITTEN if isinstance(fact.latched, bool) else _NUMBERS
    return next((n for n in found if n.type not in flags), None)
