"""Messages of topics as state variables, so that properties can name what was said last.

`out_cmd_vel_linear_x` is the field `linear.x` of what a rebec has published to `/cmd_vel` last,
`in_bumper_data` the field `data` of what it got last from `/bumper`; `out_cmd_vel` and `in_bumper`
are true from the first message on, `out_count_cmd_vel` counts messages, as far as properties do.
They are set together with what sends or serves the message.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from functools import partial
from typing import TypeVar

from rebsync import model as m
from rebsync.names import unique
from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_messages import zero_of
from rebsync.reverse.build.message_types import MessageTypes
from rebsync.reverse.graph import PublisherFact
from rebsync.reverse.models.building import declarations
from rebsync.reverse.models.rewriting import rewritten
from rebsync.reverse.models.texts import TEXT
from rebsync.reverse.nodes.node_joined import OBSERVER, Joined, Observed
from rebsync.reverse.nodes.node_names import model_word
from rebsync.reverse.nodes.open_ends import wholly_open

_Begun = TypeVar("_Begun", m.MessageServer, m.Constructor)
ANY = ""  # in the place of a field's path: whether there was a message
COUNT = "#"  # and how many there were


@dataclass(frozen=True, slots=True)
class Observation:
    """A state variable that looks at the messages of a topic in one class.

    `path` is that of the field, or `ANY` or `COUNT`. `server` is the one that gets the messages,
    empty for those that the class publishes.
    """

    owner: str
    variable: str
    topic: str
    path: str
    type: m.Type
    server: str = ""


@dataclass(frozen=True, slots=True)
class Hearer:
    """A rebec of an environment that gets what is published to a topic, with these fields."""

    rebec: str
    server: str
    paths: tuple[str, ...]

    def call(self, values: Mapping[str, m.Expression]) -> m.Statement:
        """What sends it a message with some values of fields."""
        given = tuple(values[path] for path in self.paths)
        return m.ExpressionStatement(m.Call(m.Name(self.rebec), self.server, given))


Hearers = Mapping[str, Sequence[Hearer]]
_NOBODY: Hearers = {}


def observations(joined: Joined, types: MessageTypes) -> Iterator[tuple[str, Observation]]:
    """All that can be observed, with the rebec of whom.

    Of messages from outside that are all fields; of others those that the receiver reads. Where
    several servers of a rebec get the same messages, each notes these, and the first counts them.
    """
    from_outside, names = wholly_open(joined), Variables()
    for instance in (i for i in joined.wiring.instances if not i.idle):
        owner = joined.class_of(instance)
        for fact in instance.start.unit.facts:
            topic = instance.topic(fact.topic) if isinstance(fact, PublisherFact) else None
            if isinstance(fact, PublisherFact) and isinstance(topic, str):
                for path, type_ in _fields(types, fact.type):
                    name = names.of(owner, "out", topic, path)
                    yield instance.name, Observation(owner, name, topic, path, type_)
        counted = set[str]()
        for server in joined.wiring.servers[instance.start.unit.name]:
            topics = {instance.topic(f.topic) for f in server.subscriptions}
            topic = topics.pop() if len(topics) == 1 else None
            if isinstance(topic, str):
                known = (ANY,) if topic in counted else (ANY, COUNT)
                taken = (*known, *joined.taken(instance.start.unit.name, server))
                counted.add(topic)
                for path, type_ in _fields(types, server.type):
                    is_open = path != COUNT and (owner, server.name) in from_outside
                    if path in taken or is_open:
                        name = names.of(owner, "in", topic, path)
                        found = Observation(owner, name, topic, path, type_, server.name)
                        yield instance.name, found


@dataclass(frozen=True, slots=True)
class Variables:
    """The names of observations, by class: no two topics have one name."""

    given: dict[tuple[str, str, str, str], str] = field(default_factory=dict)
    used: dict[str, set[str]] = field(default_factory=dict)

    def of(self, owner: str, direction: str, topic: str, path: str) -> str:
        """The variable of a class for a field of what it publishes or gets."""
        key = owner, direction, topic, path
        if key not in self.given:
            wish, used = _variable(direction, topic, path), self.used.setdefault(owner, set())
            self.given[key] = unique(wish, used)
        return self.given[key]


def _fields(types: MessageTypes, type_: object) -> Iterator[tuple[str, m.Type]]:
    """What is known of each message, and the fields that the model can hold."""
    yield ANY, m.Type("boolean")
    yield COUNT, m.Type("int")
    fields = types.fields(type_) if isinstance(type_, str) else None
    for path, of in (fields or {}).items():
        if of is not None and not of.dimensions:
            yield path, of


def _of_model(type_: m.Type) -> m.Type:
    """The type of the state variable that a field is: the number of a text."""
    return m.Type("int") if type_ == TEXT else type_


def _variable(direction: str, topic: str, path: str) -> str:
    match path:
        case "":
            words = [direction, model_word(topic)]
        case "#":
            words = [direction, "count", model_word(topic)]
        case _:
            words = [direction, model_word(topic), path.replace(".", "_")]
    return "_".join(words)


def observed_fields(wanted: Iterable[Observation]) -> Observed:
    """By topic the fields of what is published that are asked for."""
    found: dict[str, dict[str, None]] = {}
    for each in wanted:
        if not each.server:
            paths = found.setdefault(each.topic, {})
            if each.path not in (ANY, COUNT):
                paths[each.path] = None
    return {topic: tuple(paths) for topic, paths in found.items()}


def with_observations(
    owner: m.ReactiveClass,
    wanted: Collection[Observation],
    observed: Observed,
    fields: Mapping[str, tuple[str, ...]],
    most: int,
    hearers: Hearers = _NOBODY,
) -> m.ReactiveClass:
    """The class with the state variables that it is asked for, which its bodies set.

    What it sends to the observer is taken out, but for what the `hearers` of a topic get. `fields`
    are those that its servers get. Messages are counted up to `most`.
    """
    own = [o for o in wanted if o.owner == owner.name]
    variables = {o.variable: _of_model(o.type) for o in own}
    rebecs = frozenset(h.rebec for several in hearers.values() for h in several)
    noted = frozenset(o.variable for o in own) | rebecs

    def stored(part: object, to: Hearers) -> object:
        match part:
            case m.ExpressionStatement(m.Call(m.Name(name), topic, arguments)) if name == OBSERVER:
                values = dict(zip(observed[topic], arguments, strict=True))
                sent = [o for o in own if o.topic == topic and not o.server]
                heard = (h.call(values) for h in to.get(topic, ()))
                return m.Block((*_noted(sent, values, most), *heard))
            case m.Block(statements):
                return replace(part, statements=tuple(_flat(statements, noted)))
            case _:
                return part

    members: list[m.ClassMember] = []
    for member in owner.members:
        to = _NOBODY if isinstance(member, m.Constructor) else hearers
        member = rewritten(member, partial(stored, to=to))
        if isinstance(member, m.MessageServer) and member.body is not None:
            heard = [o for o in own if o.server == member.name]
            names = (m.Name(p.name) for p in member.parameters)
            given = dict(zip(fields.get(member.name, ()), names, strict=False))
            more = [o for o in heard if o.path not in (ANY, COUNT, *given)]
            given.update((o.path, m.Name(parameter_of(o))) for o in more)
            member = _after(_noted(heard, given, most), member)
            given_too = (m.Parameter(_of_model(o.type), parameter_of(o)) for o in more)
            parameters = (*member.parameters, *given_too)
            member = replace(member, parameters=parameters)
        if isinstance(member, m.Constructor) and member.body is not None:
            member = _after([_assign(v, zero_of(t)) for v, t in variables.items()], member)
        members.append(member)
    if own and not any(isinstance(x, m.Constructor) for x in members):
        first = tuple(_assign(v, zero_of(t)) for v, t in variables.items())
        members.append(m.Constructor(owner.name, (), m.Block(first)))
    at = sum(isinstance(x, m.KnownRebecs | m.StateVars) for x in members)
    section = (m.StateVars(declarations(variables.items())),) if variables else ()
    return replace(owner, members=(*members[:at], *section, *members[at:]))


def unread_fields(
    wanted: Iterable[Observation], fields: Mapping[str, Mapping[str, tuple[str, ...]]]
) -> Mapping[tuple[str, str], tuple[str, ...]]:
    """By class and server the fields that are asked for and that the server does not read.

    `with_observations` gives it parameters for them, in this order behind its own.
    """
    found: dict[tuple[str, str], dict[str, None]] = {}
    for each in wanted:
        read = fields.get(each.owner, {}).get(each.server, ())
        if each.server and each.path not in (ANY, COUNT, *read):
            found.setdefault((each.owner, each.server), {})[each.path] = None
    return {key: tuple(paths) for key, paths in found.items()}


def parameter_of(seen: Observation) -> str:
    """The parameter of a server for a field that only an observation asks for."""
    return f"{seen.variable}_given"


def _flat(statements: Iterable[m.Statement], names: Collection[str]) -> Iterator[m.Statement]:
    """The statements of a block, with those that note a message in the place of a block."""
    for statement in statements:
        match statement:
            case m.Block(inner) if all(_notes(s, names) for s in inner):
                yield from inner
            case _:
                yield statement


def _notes(statement: m.Statement, names: Collection[str]) -> bool:
    match statement:
        case m.ExpressionStatement(m.Assign("=", m.Name(name)) | m.Call(m.Name(name))):
            return name in names
        case _:
            return False


def _noted(
    observations: Iterable[Observation], values: Mapping[str, m.Expression], most: int
) -> Iterator[m.Statement]:
    """What is noted of a message with some values of fields."""
    for each in observations:
        own = m.Name(each.variable)
        match each.path:
            case "":
                yield _assign(each.variable, m.BoolLiteral(True))
            case "#":
                more = m.Binary("+", own, m.IntLiteral(1))
                fewer = m.Binary("<", own, m.IntLiteral(most))
                yield _assign(each.variable, m.Conditional(fewer, more, own))
            case path if path in values:
                yield _assign(each.variable, values[path])


def _after(first: Iterable[m.Statement], member: _Begun) -> _Begun:
    body: m.Block = member.body or m.Block(())
    return replace(member, body=replace(body, statements=(*first, *body.statements)))


def _assign(name: str, value: m.Expression | None) -> m.Statement:
    assert value is not None
    return m.ExpressionStatement(m.Assign("=", m.Name(name), value))
