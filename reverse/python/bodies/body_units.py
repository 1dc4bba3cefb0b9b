"""What of a package's Python becomes reactive classes, and which callbacks are their servers."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import replace

from tree_sitter import Node

from rebsync.reverse.graph import (
    Callback,
    Fact,
    Graph,
    NodeFact,
    PublisherFact,
    RateFact,
    ServiceFact,
    SubscriptionFact,
    TimerFact,
)
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.nodes.node_names import Names
from rebsync.reverse.nodes.node_servers import Server, beside_topic, topic_of
from rebsync.reverse.nodes.node_units import Unit
from rebsync.reverse.python.bodies.body_scope import PyUnit
from rebsync.reverse.python.values.py_evaluator import lineage
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.py_index import CLASS, LAMBDA, PyCode, Scope

_GIVES = frozenset({"value", "augmented", "loop", "opaque"})
_PARALLEL = (b"MultiThreadedExecutor", b"CallbackGroup")
_CONNECTS = (PublisherFact, SubscriptionFact, TimerFact, ServiceFact)
_PRINTS = re.compile(r"^\s*print\s+[\"'\w]", re.MULTILINE)
_THREE = re.compile(r"#!.*python3|^from __future__ import .*division|\bf[\"']", re.MULTILINE)


def units_of(
    values: PyValues,
    graph: Graph,
    is_people: Callable[[Fact], bool],
    taken: Collection[str] = (),
    whole: bool = False,
) -> list[PyUnit]:
    """The classes and modules that talk to ROS, under names that are not `taken`.

    With `whole` those are units too that have clients or parameters alone.
    """
    code = values.code
    facts = [(f, scope_of(code, f)) for f in graph.facts if is_people(f)]
    grouped: dict[Scope, list[Fact]] = {}
    for fact, scope in facts:
        grouped.setdefault(scope.owner or scope.module, []).append(fact)
    owners = [
        o for o, own in grouped.items() if whole or any(isinstance(f, _CONNECTS) for f in own)
    ]
    families = {o: _family(values, o) for o in owners}
    below = {above for o in owners for above in families[o][1:]}
    names = Names.beside(taken)
    found = []
    for owner in owners:
        if owner in below:
            continue
        family = families[owner]
        together = [f for o in (family or (owner,)) for f in grouped.get(o, [])]
        found.append(_unit(owner, family, together, facts, names))
    return found


def _family(values: PyValues, owner: Scope) -> tuple[Scope, ...]:
    if owner.kind != CLASS:
        return ()
    return tuple(s for s in lineage(values, owner) if isinstance(s, Scope))


def _unit(
    owner: Scope,
    family: tuple[Scope, ...],
    together: Sequence[Fact],
    facts: Sequence[tuple[Fact, Scope]],
    names: Names,
) -> PyUnit:
    module = owner.module
    near = [f for f, s in facts if s.module is module and isinstance(f, NodeFact)]
    own = [f for f in together if isinstance(f, NodeFact)]
    stem = module.py.source.path.rpartition("/")[2].removesuffix(".py")
    asked = next((f.name for f in (*own, *near) if isinstance(f.name, str) and f.name), stem)
    node = asked.strip("/")
    wish = owner.name if family else node
    if family:
        together = [*together, *_rates_beside(facts, owner, together)]
    calls = {
        (f.site.place.source.path, f.site.call.id): number for number, f in enumerate(together)
    }
    text = module.py.source.text
    library = libraries.client_in(text)
    unit = Unit(names.give(wish), None, (), (), tuple(together), Code(), own=library.flat)
    is_new = library.flat or _THREE.search(text)
    version = 3 if is_new else (2 if _PRINTS.search(text) else 0)
    return PyUnit(unit, family, module, node, calls, version, library)


def _rates_beside(
    facts: Sequence[tuple[Fact, Scope]], owner: Scope, together: Sequence[Fact]
) -> Iterator[Fact]:
    """Rates that the program of a class loops with."""
    for fact, scope in facts:
        is_near = scope.module is owner.module and scope.owner is None
        if isinstance(fact, RateFact) and is_near and fact not in together:
            yield fact


def scope_of(code: PyCode, fact: Fact) -> Scope:
    """The function, class or module that a call stands in."""
    path = fact.site.place.source.path
    return scope_around(code, fact.site.call, path)


def scope_around(code: PyCode, node: Node, path: str) -> Scope:
    """The function, class or module around a node."""
    at = climb(node, lambda n: (path, n.id) in code.scopes)
    return code.scopes[path, at.id] if at is not None else code.modules[path]


# --- servers ------------------------------------------------------------------------------------


def servers_of(code: PyCode, unit: PyUnit, names: Names) -> dict[int, Server]:
    """The servers of a unit by the numbers of the facts whose callbacks they are."""
    places = {
        (s.py.source.path, s.py.span(s.node.child_by_field_name("name") or s.node).start): s
        for s in code.scopes.values()
        if s.kind != CLASS
    }
    found: dict[int, Server] = {}
    known: dict[tuple[object, ...], int] = {}
    for number, fact in enumerate(unit.unit.facts):
        if not isinstance(fact, SubscriptionFact | TimerFact | ServiceFact):
            continue
        if len(fact.callbacks) != 1 or not isinstance(fact.callbacks[0], Callback):
            continue
        callback = fact.callbacks[0]
        scope = places.get((callback.place.source.path, callback.place.span.start))
        if scope is None or not _is_own(unit, scope):
            continue
        key = scope.node.id, callback.bound, _kind(fact)
        if key in known and isinstance(fact, SubscriptionFact):
            before = found[known[key]]
            both = replace(before, subscriptions=(*before.subscriptions, fact))
            for other in [n for n, s in found.items() if s is before]:
                found[other] = both
            found[number] = both
        elif key in known:
            found[number] = found[known[key]]
        else:
            known[key] = number
            found[number] = _server(fact, callback, scope, names)
    return found


def _kind(fact: Fact) -> object:
    match fact:
        case SubscriptionFact():
            return "message", str(fact.type), topic_of(fact)
        case TimerFact() if fact.one_shot is not True:
            return fact.site.call.id
        case _:
            return type(fact).__name__


def _is_own(unit: PyUnit, scope: Scope) -> bool:
    """Whether a callback is of the unit itself: one of another class is not."""
    owner = scope.owner
    return owner in unit.lineage if owner is not None else True


def _server(fact: Fact, callback: Callback, scope: Scope, names: Names) -> Server:
    kept = fact.site.kept.rpartition(".")[2].strip("_")
    wish = scope.name if scope.kind != LAMBDA else f"{kept or 'callback'}"
    parameters = scope.parameters[1:] if scope.self_name is not None else scope.parameters
    first = len(callback.bound)
    message = parameters[first].name if len(parameters) > first else ""
    name = names.give(wish, *beside_topic(wish, fact))
    plain = Server(name, callback, scope.py, scope.node, message, ())
    match fact:
        case SubscriptionFact():
            type_ = fact.type if isinstance(fact.type, str) else None
            return replace(plain, type=type_, subscriptions=(fact,))
        case TimerFact():
            return replace(plain, timers=(fact,))
        case ServiceFact():
            return replace(plain, service=fact)
        case _:
            return plain


def runs_in_threads(unit: PyUnit, code: PyCode) -> bool:
    """Whether callbacks run beside each other: always in rospy, in rclpy where groups are made."""
    texts = [scope.node.text or b"" for scope in code.modules.values()]
    several = all(any(word in text for text in texts) for word in _PARALLEL)
    return unit.library.threads or several


def wakes(unit: PyUnit, code: PyCode, starts: bool) -> bool:
    """Whether a thread is left that lets the rates of rclpy, which are timers, end their sleep."""
    texts = (scope.node.text or b"" for scope in code.modules.values())
    if not unit.library.flat or (starts and any(b"Thread" in text for text in texts)):
        return True
    return runs_in_threads(unit, code)


def names_of(code: PyCode, unit: PyUnit) -> set[str]:
    """The names of variables in the code of a unit: parameters of servers get others."""
    modules = {s.module for s in unit.lineage} | {unit.module}
    found = {a for s in unit.lineage for a in s.attributes}
    for scope in code.scopes.values():
        if scope.module in modules:
            found |= {n for n, of in scope.names.items() if any(b.how in _GIVES for b in of)}
    for module in modules:
        found |= {n for n, of in module.names.items() if any(b.how in _GIVES for b in of)}
    return found


def has_word(unit: PyUnit, word: str) -> bool:
    """Whether the code of a unit uses a name: known rebecs get others."""
    waiting = [s.node for s in unit.lineage] or [unit.module.node]
    bytes_ = word.encode()
    while waiting:
        node = waiting.pop()
        if node.type == "identifier" and node.text == bytes_:
            return True
        if bytes_ in (node.text or b""):
            waiting += node.named_children
    return False
