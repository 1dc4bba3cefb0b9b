"""What of hand-written Python the model does not show as it is: listed, each place once."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence

from tree_sitter import Node

from rebsync.reverse.findings import IN_THREADS, Findings, Unread
from rebsync.reverse.graph import (
    ClientFact,
    Fact,
    PublisherFact,
    ServiceFact,
    SubscriptionFact,
    TimerFact,
    Unresolved,
)
from rebsync.reverse.nodes.failing_parameters import declared_again
from rebsync.reverse.nodes.node_namespaces import note_namespaces
from rebsync.reverse.nodes.node_servers import Server
from rebsync.reverse.nodes.node_wiring import (
    Wiring,
    nobody_publishes,
    nobody_subscribes,
    unfed,
    unheard,
)
from rebsync.reverse.python.bodies.body_reading import Reading
from rebsync.reverse.python.bodies.body_scope import Key, PyUnit
from rebsync.reverse.python.nodes.object_model import list_object_model
from rebsync.reverse.python.nodes.refused_callbacks import odd_callback
from rebsync.reverse.python.values.py_lookup import scope_at
from rebsync.reverse.python.values.py_worth import Instance as Object
from rebsync.reverse.python.values.py_worth import Value
from rebsync.reverse.syntax.ancestors import holds
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_bindings import Binding
from rebsync.reverse.syntax.py_index import MODULE, Scope
from rebsync.reverse.syntax.py_tree import field, text_of
from rebsync.reverse.unknowns import Open

ENDLESS = "what this goes through may have no end"
_HANGS = "it is not known whether this loop ends"
_WAITS = "this may wait for ever for a lock that is held"
_SAME_OBJECT = "another callback of this topic gets the object that is changed here"
_LEFT = "in Python 2 this sets a variable of the function around"
_OPEN = "add the package that has the receivers, if they matter"
_CLOSE = "add the package that publishes it, or a class to the model that sends what may come"
_CALLS = "add a class to the model that calls it, or message servers that send to it"
_THREADS = (
    f" runs the callbacks of topics and timers, and loops, {IN_THREADS};"
    " in the model one runs after the other"
)


def list_unit(
    unit: PyUnit, servers: Mapping[int, Server], loops: int, threads: bool, findings: Findings
) -> None:
    """What a unit asks of ROS that the model has not, or not so."""
    note_namespaces(unit.unit, findings)
    for number, fact in enumerate(unit.unit.facts):
        _fact(unit, fact, number in servers, findings)
    if unit.library.threads:
        _changed(unit, servers, findings)
    for number, server in servers.items():
        if (odd := odd_callback(unit.unit.facts[number], server, unit.library)) is not None:
            source, span = unit.module.py.source, unit.module.py.span(odd[0])
            findings.unreadable(source, Unread(span, odd[1]), unit.name)
    for asked, why in declared_again(unit.unit.facts):
        place = asked.site.place
        findings.unreadable(place.source, Unread(place.span, why), unit.name)
    served = [f for n, f in enumerate(unit.unit.facts) if n in servers]
    # One topic has a thread for each of its publishers, one service one for each of its clients.
    beside_itself = any(isinstance(f, SubscriptionFact | ServiceFact) for f in served)
    if threads and served and (beside_itself or len(served) + loops > 1):
        place = served[-1].site.place
        why = unit.library.name + _THREADS
        findings.assumed(place.source, place.span, why, within=unit.name)


def _changed(unit: PyUnit, servers: Mapping[int, Server], findings: Findings) -> None:
    """Messages that a callback changes: all callbacks of a topic get the same object."""
    heard = {n: f for n, f in enumerate(unit.unit.facts) if isinstance(f, SubscriptionFact)}
    topics = Counter(f.topic for f in heard.values() if isinstance(f.topic, str))
    for number in servers.keys() & heard.keys():
        server, topic = servers[number], heard[number].topic
        if not isinstance(topic, str) or topics[topic] < 2 or not server.message:
            continue
        for node in _changes(server):
            place = unit.module.py.source, unit.module.py.span(node)
            findings.unreadable(place[0], Unread(place[1], _SAME_OBJECT), unit.name)


def _changes(server: Server) -> Iterator[Node]:
    """Where a callback stores in its message, or calls what a part of it has."""
    parts = {"assignment": "left", "augmented_assignment": "left", "call": "function"}
    for node in nodes_in(server.body):
        if node.type in parts:
            stored = text_of(field(node, parts[node.type]))
            if stored.startswith((f"{server.message}.", f"{server.message}[")):
                yield node


def _fact(unit: PyUnit, fact: Fact, served: bool, findings: Findings) -> None:
    place = fact.site.place
    match fact:
        case SubscriptionFact(single=True) | TimerFact():
            return
        case SubscriptionFact() if not served:
            why = "it is not known which function of the node gets these messages"
            findings.unreadable(place.source, Unread(place.span, why), unit.name)
        case PublisherFact(site) if not site.kept:
            why = "it is not known what is published here: the publisher is in no variable"
            findings.unreadable(place.source, Unread(place.span, why), unit.name)
        case ServiceFact() if served:
            why = "a service is a message server to which nobody in the model sends"
            findings.assumed(place.source, place.span, why, _CALLS, unit.name)
        case ServiceFact():
            why = "it is not known which function this service calls"
            findings.unreadable(place.source, Unread(place.span, why), unit.name)
        case ClientFact():
            why = "the model has no services: what this one answers is open"
            findings.assumed(place.source, place.span, why, "", unit.name)
        case _:
            return


def list_shared(
    units: Sequence[PyUnit], readings: Mapping[str, Reading], findings: Findings
) -> None:
    """What rebecs share in the code, and what sets their state from elsewhere."""
    users: dict[Key, list[str]] = {}
    for unit in units:
        for key in readings[unit.name].state.values():
            if key[0] in ("module", "local"):
                users.setdefault(key, []).append(unit.name)
    for (_, _, name), names in users.items():
        if len(names) < 2:
            continue
        unit = next(u for u in units if u.name == names[0])
        for binding in unit.module.names.get(name, [])[:1]:
            why = f'several rebecs of one program share "{name}": in the model each has its own'
            span = unit.module.py.span(binding.node)
            findings.unreadable(unit.module.py.source, Unread(span, why), names[0])
    read = {body for reading in readings.values() for body in reading.bodies}
    for unit in units:
        list_object_model(readings[unit.name], findings)
        for scope, binding in _set_elsewhere(unit, readings[unit.name], read):
            why = "this sets what is state of a rebec, in code that is not read"
            span = scope.py.span(binding.node)
            findings.unreadable(scope.py.source, Unread(span, why), unit.name)
        for scope, node in _left_variables(unit, readings[unit.name]):
            if not findings.has_unreadable(scope.py.source, scope.py.span(node)):
                unread = Unread(scope.py.span(node), _LEFT)
                findings.unreadable(scope.py.source, unread, unit.name)
    _note_turns(units, findings)


def list_endless(
    units: Sequence[PyUnit], readings: Mapping[str, Reading], findings: Findings
) -> None:
    """Where units go through iterators that may have no end, or loop, in code that is left out."""
    for unit in units:
        reading = readings[unit.name]
        if reading.form is None:
            continue
        classes = {scope.node.id for scope in reading.nodes}
        endless = ((*place, ENDLESS) for place in reading.form.endless(reading.bodies))
        hanging = ((*place, _HANGS) for place in reading.form.hanging(reading.bodies, classes))
        locks = ((*place, _WAITS) for place in reading.form.odd_locks(reading.bodies))
        for source, span, why in (*endless, *hanging, *locks):
            if not findings.has_unreadable(source, span):
                findings.unreadable(source, Unread(span, why), unit.name)


def _left_variables(unit: PyUnit, reading: Reading) -> Iterator[tuple[Scope, Node]]:
    """Lists made by a comprehension that set, in Python 2, a variable of the function around."""
    for scope in reading.code.scopes.values() if not unit.library.flat else ():
        if scope.node.id not in reading.bodies or "python3" in scope.py.source.text[:80]:
            continue
        for made in (n for n in nodes_in(scope.node) if n.type == "list_comprehension"):
            clauses = (n for n in made.named_children if n.type == "for_in_clause")
            names = (n for c in clauses for n in nodes_in(field(c, "left")))
            if any(_is_variable(scope, n, made) for n in names):
                yield scope, made


def _is_variable(scope: Scope, name: Node, made: Node) -> bool:
    """Whether a name is that of a variable which a function sets elsewhere too."""
    bindings = scope.names.get(text_of(name), ()) if name.type == "identifier" else ()
    return any(not holds(made, b.node) for b in bindings)


def _set_elsewhere(
    unit: PyUnit, reading: Reading, read: Collection[int]
) -> Iterator[tuple[Scope, Binding]]:
    """The assignments to what is state of the unit that its bodies do not have.

    Those of a module that functions make which are no bodies that are `read`, of any unit; and to
    attributes of the unit's object.
    """
    code = reading.code
    for name in (key[2] for key in reading.state.values() if key[0] == "module"):
        for binding in unit.module.names.get(name, ()):
            scope = scope_at(reading.values, binding, unit.module)
            if scope.kind != MODULE and scope.node.id not in read:
                yield scope, binding
    own = {key[2] for key in reading.state.values() if key[0] == "self"}
    for scope in (*code.scopes.values(), *code.modules.values()):
        for (_, name), bindings in scope.stores.items():
            if name not in own or scope.node.id in reading.bodies:
                continue
            for binding in bindings:
                target = field(binding.node, "left")
                holder = target.child_by_field_name("object")
                ways = reading.values.ways(holder, scope) if holder is not None else ()
                if any(_is_object(w, unit) for w in ways) and not _is_field(reading, holder):
                    yield scope, binding


def _is_field(reading: Reading, holder: Node | None) -> bool:
    """Whether what an expression names is a field of a message: no class of the files has it."""
    if holder is None or holder.type != "attribute":
        return False
    name = text_of(field(holder, "attribute"))
    code = reading.code
    for scope in (*code.scopes.values(), *code.modules.values()):
        if name in scope.names or name in scope.attributes:
            return False
        if any(name == stored for _, stored in scope.stores):
            return False
    return reading.types.has_field(name)


def _is_object(way: Value, unit: PyUnit) -> bool:
    return isinstance(way, Unresolved) or (isinstance(way, Object) and way.scope in unit.lineage)


def _note_turns(units: Sequence[PyUnit], findings: Findings) -> None:
    """Nodes of one program that a single thread serves."""
    for module in dict.fromkeys(u.module for u in units):
        together = [u for u in units if u.module is module]
        if len(together) > 1:
            place = together[1].unit.facts[0].site.place
            why = "objects of one program may take turns; in the model they act by themselves"
            findings.assumed(place.source, place.span, why, "", together[1].name)


def list_wiring(wiring: Wiring, wanted: Collection[str], findings: Findings) -> None:
    """Topics that are not known, and those with nobody at their other end."""
    for instance in wiring.instances:
        name = instance.start.unit.name
        launched = instance.launched
        if launched is not None and launched.only_if and name in wanted:
            why = f"it is started only `{launched.only_if[-1]}`: in the model it always is"
            findings.assumed(launched.source, launched.span, why)
        for fact in instance.start.unit.facts if name in wanted else ():
            if isinstance(fact, PublisherFact | SubscriptionFact):
                topic, place = instance.topic(fact.topic), fact.site.place
                if isinstance(topic, Open):
                    why = f"the topic is not known: {topic.why}"
                    findings.unreadable(place.source, Unread(place.span, why), name)
    for instance, fact in unheard(wiring):
        topic, place = instance.topic(fact.topic), fact.site.place
        if isinstance(topic, str) and instance.start.unit.name in wanted:
            why = nobody_subscribes(topic)
            findings.assumed(place.source, place.span, why, _OPEN, instance.start.unit.name)
    for instance, _, heard in unfed(wiring):
        topic, place = instance.topic(heard.topic), heard.site.place
        if isinstance(topic, str) and instance.start.unit.name in wanted:
            why = nobody_publishes(topic)
            findings.assumed(place.source, place.span, why, _CLOSE, instance.start.unit.name)
