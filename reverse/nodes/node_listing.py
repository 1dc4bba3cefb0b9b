"""What of hand-written nodes the model does not show as it is: listed, each place once."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Sequence
from dataclasses import field
from typing import TypeAlias

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.build.message_types import MessageTypes
from rebsync.reverse.findings import Findings, Grade, Unread
from rebsync.reverse.graph import (
    ClientFact,
    Fact,
    Place,
    PublisherFact,
    ServiceFact,
    SubscriptionFact,
    TimerFact,
)
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.nodes.failing_parameters import declared_again, never_declared
from rebsync.reverse.nodes.kept_objects import (
    called_by_listeners,
    is_kept,
    odd_uses,
    replacing,
    weak_pointers,
)
from rebsync.reverse.nodes.node_servers import Server
from rebsync.reverse.nodes.node_units import Unit, bodies
from rebsync.reverse.nodes.node_unmodelled import shared_state, statics
from rebsync.reverse.nodes.node_values import Instance
from rebsync.reverse.nodes.node_wiring import (
    Wiring,
    nobody_publishes,
    nobody_subscribes,
    unfed,
    unheard,
)
from rebsync.reverse.syntax.cpp_index import Code, CppField
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, text_of
from rebsync.reverse.unknowns import Open
from rebsync.source import Span

_ENTRIES = frozenset(
    {
        *("ActionServer", "ActionClient", "SimpleActionServer", "SimpleActionClient"),
        *("TimeSynchronizer", "Synchronizer", "MessageFilter"),
    }
)
# Options of subscriptions by which the middleware leaves messages out.
_CHOOSING = frozenset({"ignore_local_publications", "content_filter_options"})
_NAMING = ("preproc_def", "alias_declaration", "type_definition", "base_class_clause")
_WORD = re.compile(r"\w+")
# What makes callbacks that a container may run at the same time as others.
_GROUPS = frozenset({"create_callback_group"})
# What gives all timers, subscriptions and services of a node, or of a group of it.
_REACHING = frozenset({"for_each_callback_group", "collect_all_ptrs", "find_timer_ptrs_if"})
_TEXTS = frozenset({"string_literal", "concatenated_string", "raw_string_literal"})
_NO_NUMBER = re.compile(r"string|char\b|chrono|Duration|Node[A-Z]\w*|Node\b|Ptr|_ptr")
_Served: TypeAlias = SubscriptionFact | TimerFact | ServiceFact
_REPLACING = "the variable has another one already, which ends here: the model keeps both"
_OTHER_NAME = "this may end a timer, subscription or service, by another name than its first"
_SEVERAL = "its callbacks may run at the same time as others: the model has one at a time"


@dataclass(slots=True)
class FindingList:
    """Lists places in findings, each once with the same reason."""

    findings: Findings
    types: MessageTypes
    # What is listed: so many findings, the places of those that are unreadable, and the reasons.
    _known: int = 0
    _unreadable: set[tuple[int, Span]] = field(default_factory=set)
    _reasons: set[tuple[Span, str]] = field(default_factory=set)
    _odd: dict[int, frozenset[str]] = field(default_factory=dict)

    def unit(self, unit: Unit, servers: Iterable[Server]) -> None:
        """What a unit has that its reactive class has not."""
        served = {id(f) for s in servers for f in (*s.subscriptions, *s.timers, s.service)}
        weak = weak_pointers(unit)
        for fact in unit.facts:
            self._fact(unit, fact, id(fact) in served)
            if isinstance(fact, _Served) and _is_lost(fact, weak):
                why = "nothing keeps what this gives: ROS ends it at once, the model does not"
                self._unread(fact.site.place, why, unit.name, "keep it in a member")
        for fact in replacing(unit.facts):
            self._unread(fact.site.place, _REPLACING, unit.name)
        for cpp, node in odd_uses(unit):
            self._unread(Place(cpp.source, cpp.span(node)), _OTHER_NAME, unit.name)
        for fact, why in (*declared_again(unit.facts), *never_declared(unit.facts)):
            self._unread(fact.site.place, why, unit.name)
        for server in servers:
            self._wide(unit, server)
        for cpp, body in bodies(unit):
            self._words(unit, cpp, body)
        for cpp in unit.code.files:
            self._renamed(unit, cpp)
        for member in (f for c in unit.lineage for f in (*c.fields, *c.others)):
            self._words(unit, member.cpp, member.type)

    def _fact(self, unit: Unit, fact: Fact, served: bool) -> None:
        match fact:
            case SubscriptionFact(single=True):
                self._unread(fact.site.place, "it waits here for one message", unit.name)
            case SubscriptionFact() if not served:
                why = "it is not known which function gets these messages"
                self._unread(fact.site.place, why, unit.name)
            case PublisherFact(site) if not site.kept:
                why = "it is not known what is published here: the publisher is in no variable"
                self._unread(fact.site.place, why, unit.name)
            case PublisherFact(site) if _is_elsewhere(site.kept):
                why = "the publisher is kept in another object: what that publishes is not read"
                self._unread(fact.site.place, why, unit.name)
            case PublisherFact(site) if (given := called_by_listeners(fact)) is not None:
                why = "this is called when somebody subscribes, or leaves: the model has no such"
                self._unread(Place(site.cpp.source, site.cpp.span(given)), why, unit.name)
            case ServiceFact() if served:
                why = "a service is a message server to which nobody in the model sends"
                self._assumed(fact.site.place, why, unit.name, _CALLS)
            case ServiceFact():
                why = "it is not known which function this service calls"
                self._unread(fact.site.place, why, unit.name)
            case ClientFact():
                why = "the model has no services: what this one answers is open"
                self._assumed(fact.site.place, why, unit.name)

    def _wide(self, unit: Unit, server: Server) -> None:
        for parameter in server.parameters:
            if self.types.holds_more(server.type or "", parameter.path):
                for fact in server.subscriptions[:1]:
                    why = f'"{parameter.path}" holds more than the model\'s int does'
                    self._assumed(fact.site.place, why, f"{unit.name}.{server.name}")

    def _words(self, unit: Unit, cpp: Cpp, body: Node) -> None:
        listed = self._listed(cpp)
        for node in reversed(unit.code.named(cpp, body, listed)) if listed else ():
            name = text_of(node)
            place = Place(cpp.source, cpp.span(node))
            if name in _CHOOSING:
                self._unread(place, f'"{name}": some messages may not come to the node', unit.name)
            elif name in _REACHING:
                self._unread(place, _OTHER_NAME, unit.name)
            elif name in _ENTRIES:
                why = f'"{name}" calls functions of the node in ways that the model does not have'
                self._unread(place, why, unit.name)
            else:
                self._unread(place, f'"{name}": {_SEVERAL}', unit.name)

    def _renamed(self, unit: Unit, cpp: Cpp) -> None:
        """Other names of what runs callbacks beside each other: macros, aliases, classes below."""
        listed = self._listed(cpp) & libraries.threaded()
        for node in inside(cpp.root, *_NAMING) if listed else ():
            if not listed.isdisjoint(_WORD.findall(text_of(node))):
                self._unread(Place(cpp.source, cpp.span(node)), _SEVERAL, unit.name)

    def _listed(self, cpp: Cpp) -> frozenset[str]:
        """The words of a file that are listed wherever the code names them."""
        if id(cpp) not in self._odd:
            known = _CHOOSING | _ENTRIES | _REACHING | libraries.threaded()
            words = {n for n in known if n.encode() in cpp.words}
            self._odd[id(cpp)] = frozenset(words)
        return self._odd[id(cpp)]

    # --- wiring ---------------------------------------------------------------------------------

    def wiring(self, wiring: Wiring, units: list[Unit]) -> None:
        """Topics of some units that are not known, and those with nobody at their other end."""
        asked = {id(unit) for unit in units}
        wanted = [i for i in wiring.instances if id(i.start.unit) in asked]
        for instance in wanted:
            self._topics(instance)
        for instance, fact in unheard(wiring):
            topic = instance.topic(fact.topic)
            if isinstance(topic, str) and id(instance.start.unit) in asked:
                why = nobody_subscribes(topic)
                self._assumed(fact.site.place, why, instance.start.unit.name, _OPEN)
        for instance, _, heard in unfed(wiring):
            topic = instance.topic(heard.topic)
            if isinstance(topic, str) and id(instance.start.unit) in asked:
                why = nobody_publishes(topic)
                self._assumed(heard.site.place, why, instance.start.unit.name, _CLOSE)
        self._services(wiring, wanted)
        self._shared(wanted)

    def _services(self, wiring: Wiring, wanted: list[Instance]) -> None:
        """Calls of services of the model's own nodes: these are no messages."""
        offered = {
            i.topic(f.name)
            for i in wiring.instances
            for f in i.start.unit.facts
            if isinstance(f, ServiceFact)
        }
        for instance in wanted:
            for fact in instance.start.unit.facts:
                if isinstance(fact, ClientFact) and instance.topic(fact.name) in offered:
                    why = "the model does not send what this asks of another of its nodes"
                    self._unread(fact.site.place, why, instance.start.unit.name)

    def _topics(self, instance: Instance) -> None:
        for fact in instance.start.unit.facts:
            if isinstance(fact, PublisherFact | SubscriptionFact):
                topic = instance.topic(fact.topic)
                if isinstance(topic, Open):
                    why = f"the topic is not known: {topic.why}"
                    self._unread(fact.site.place, why, instance.start.unit.name)

    def _shared(self, instances: list[Instance]) -> None:
        """Objects of one program that share its thread, and nodes that may not be there."""
        loaded = [i for i in instances if i.start.program is None]  # into one process, or several
        self._common_variables(list({i.start.unit.name: i.start.unit for i in loaded}.values()))
        for unit in (i.start.unit for i in loaded):
            for cpp, body in bodies(unit):
                for node in unit.code.named(cpp, body, _GROUPS):
                    self._unread(Place(cpp.source, cpp.span(node)), _SEVERAL, unit.name)
        nodes: dict[tuple[int, int], list[Instance]] = {}
        for instance in instances:
            if instance.start.program is not None:
                key = instance.start.program.main.node.id, id(instance.launched)
                nodes.setdefault(key, []).append(instance)
            if instance.start.made is not None and instance.start.made.repeated:
                why = "how many of these are made is not known: the model has one"
                if (place := _where_made(instance)) is not None:
                    self._unread(place, why, instance.start.unit.name)
            launched = instance.launched
            if launched is not None and launched.only_if:
                why = f"it is started only `{launched.only_if[-1]}`: in the model it always is"
                self._assumed(Place(launched.source, launched.span), why)
        for together in nodes.values():
            self._common_variables(
                list({i.start.unit.name: i.start.unit for i in together}.values())
            )
            self._of_one_class(together)
            if len(together) > 1:
                why = "objects of one program take turns; in the model they act by themselves"
                self._made(together[1], why)

    def _common_variables(self, units: list[Unit]) -> None:
        """Variables of files, and static ones of classes, that several rebecs of a process use."""
        if len(units) < 2:
            return
        code = units[0].code
        shared = [(name, v[0], "") for name, v in code.variables.items() if not _constant(code, v)]
        shared += [(f.name, f, c.name) for c in code.classes.values() for f in statics(c)]
        for name, variable, owner in shared:
            if sum(_uses(unit, name, owner) for unit in units) > 1:
                place = Place(variable.cpp.source, variable.cpp.span(variable.node))
                why = f'several rebecs of one program share "{name}": in the model each has its own'
                self._unread(place, why, units[0].name)

    def _of_one_class(self, together: list[Instance]) -> None:
        """What objects of one class share, and what each gets of its own, if it is a number."""
        of_classes: dict[str, list[Instance]] = {}
        for instance in together:
            of_classes.setdefault(instance.start.unit.name, []).append(instance)
        for objects in of_classes.values():
            unit = objects[0].start.unit
            if len(objects) < 2:
                continue
            for cpp, node in shared_state(unit):
                why = "objects of one class share this: in the model each has its own"
                self._unread(Place(cpp.source, cpp.span(node)), why, unit.name)
            made = [i.start.made.arguments for i in objects if i.start.made is not None]
            given = [_numbers(unit, arguments) for arguments in made]
            if unit.program is None and any(g != given[0] for g in given[1:]):
                owner = unit.lineage[0]
                place = Place(owner.cpp.source, owner.cpp.span(owner.node))
                why = "its objects are made with other values: the model's have those of the first"
                self._unread(place, why, unit.name)

    def _made(self, instance: Instance, why: str) -> None:
        program, place = instance.start.program, _where_made(instance)
        if program is not None and place is not None:
            self._assumed(place, why, program.name)

    # --- once -----------------------------------------------------------------------------------

    def _unread(self, place: Place, why: str, within: str, hint: str = "") -> None:
        self._look()
        if (id(place.source), place.span) not in self._unreadable:
            self.findings.unreadable(place.source, Unread(place.span, why, hint), within)

    def _assumed(self, place: Place, why: str, within: str = "", hint: str = "") -> None:
        self._look()
        if (place.span, why) not in self._reasons:
            self.findings.assumed(place.source, place.span, why, hint, within)

    def _look(self) -> None:
        """Takes note of the findings since the last time."""
        for finding in self.findings.all[self._known :]:
            self._reasons.add((finding.span, finding.why))
            if finding.grade is Grade.UNREADABLE:
                self._unreadable.add((id(finding.source), finding.span))
        self._known = len(self.findings.all)


_OPEN = "add the package that has the receivers, if they matter"
_CALLS = "add a class to the model that calls it, or message servers that send to it"
_CLOSE = "add the package that publishes it, or a class to the model that sends what may come"


def _where_made(instance: Instance) -> Place | None:
    """Where an object is made; None where no program makes it."""
    program, made = instance.start.program, instance.start.made
    if program is None:
        return None
    node = program.main.node
    if made is not None and made.statement is not None:
        node = made.statement
    return Place(program.main.cpp.source, program.main.cpp.span(node))


def _is_elsewhere(kept: str) -> bool:
    """Whether a variable is part of another object: `helper_->pub`."""
    own = kept.removeprefix("this->").partition("[")[0]
    return "." in own or "->" in own


def _numbers(unit: Unit, arguments: Sequence[Node]) -> list[str]:
    """What an object is made with, without texts and handles of nodes."""
    constructors = unit.constructors(unit.lineage[0])
    types = {
        at: text_of(p.type)
        for c in constructors
        if len(constructors) == 1
        for at, p in enumerate(c.parameters)
    }
    return [
        text_of(argument)
        for at, argument in enumerate(arguments)
        if not _NO_NUMBER.search(types.get(at, "")) and argument.type not in _TEXTS
    ]


def _is_lost(fact: _Served, weak: Collection[str]) -> bool:
    above = fact.site.call.parent
    if above is None or (isinstance(fact, SubscriptionFact) and fact.single):
        return False
    return above.type == "expression_statement" or _is_dropped(fact, above, weak)


def _is_dropped(fact: _Served, above: Node, weak: Collection[str]) -> bool:
    """Whether only a local of a function other than `main` has it, which nothing else keeps."""
    function, name = fact.site.function, above.child_by_field_name("declarator")
    if function is None or function.name == "main" or function.body is None:
        return False
    if above.type != "init_declarator" or name is None or name.type != "identifier":
        return False
    return not is_kept(function.body, above, text_of(name), weak)


def _constant(code: Code, variables: Iterable[CppField]) -> bool:
    return any((v.cpp.source.path, v.name) in code.constants for v in variables)


def _uses(unit: Unit, name: str, owner: str) -> bool:
    """Whether functions of a unit name a variable, of a class if it is of one."""
    names = frozenset({name})
    found = (node for cpp, body in bodies(unit) for node in unit.code.named(cpp, body, names))
    return any(not owner or owner in unit.names or _is_of(node, owner) for node in found)


def _is_of(node: Node, owner: str) -> bool:
    """Whether a name is that of a member of a class: `Gate::level`, or by an object."""
    above = node.parent
    if above is None or above.type != "qualified_identifier":
        return above is not None and above.type == "field_expression"
    return owner in text_of(above).split("::")
