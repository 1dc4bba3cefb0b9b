"""An environment that closes a model: a rebec that sends whatever may come from outside.

It sends at most one message of each topic, and calls each service at most once, in each unit of
time, from time 0 on; the fields of a message are any of the values that the model tells apart.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from math import prod

from rebsync import model as m
from rebsync.literals import exact_literal_of, literal_of
from rebsync.names import unique
from rebsync.properties import Properties
from rebsync.records import dataclass
from rebsync.reserved import KEEP_LAST, OPEN
from rebsync.reverse.build.message_types import MessageTypes
from rebsync.reverse.environment.representatives import of_texts, representatives
from rebsync.reverse.environment.scopes import Scope
from rebsync.reverse.models.building import declarations
from rebsync.reverse.models.texts import OTHER, TEXT
from rebsync.reverse.nodes.node_names import model_word
from rebsync.reverse.nodes.open_ends import OpenEnd
from rebsync.static.constants import Value

_NONE: Mapping[str, int] = {}
_DEEPEST = 3  # messages of a topic that are taken to wait where the code does not say less
_MOST = 4096  # messages of one topic that may come at the same time
_EITHER = m.Choice((m.BoolLiteral(False), m.BoolLiteral(True)))


@dataclass(frozen=True, slots=True)
class ClosedModel:
    """A closed model; what is assumed of the environment, and where that may be too little.

    `gaps` say of which values only some are sent, so that nothing is proved.
    """

    model: m.Model
    assumptions: tuple[str, ...] = ()
    gaps: tuple[str, ...] = ()


def closed(
    model: m.Model,
    ends: Sequence[OpenEnd],
    properties: Properties,
    types: MessageTypes,
    texts: Sequence[str] = (),
    fed: Sequence[OpenEnd] = (),
) -> ClosedModel:
    """The model with an environment at its open ends; without `main` it stays as it is.

    `texts` are those that the model tells apart, by their numbers. The ends that are `fed` by
    rebecs of the model get room for messages alone.
    """
    started = {r.name for r in model.main.rebecs} if model.main is not None else set()
    at = [e for e in ends if e.rebec in started]
    waiting = tuple(_waiting(model, (*at, *fed)))
    if not at:
        more = _more_messages(fed)
        classes = tuple(without_open(c, more.get(c.name, {})) for c in model.classes)
        return ClosedModel(replace(model, classes=classes), waiting)
    environment = _Environment(model, properties, types, texts, set(started))
    for together in _topics(at).values():
        environment.add(together)
    return ClosedModel(
        environment.closed(at, fed), (*environment.assumptions, *waiting), tuple(environment.gaps)
    )


def _waiting(model: m.Model, ends: Iterable[OpenEnd]) -> Iterator[str]:
    """Of which topics fewer messages wait here than may in the code."""
    for end in ends:
        if _is_slow(model, end.owner) and _kept(end) != end.depth:
            yield f"of {end.name or end.server} no more than {_DEEPEST} wait for {end.rebec}"


def _topics(ends: Iterable[OpenEnd]) -> dict[tuple[str, str], list[OpenEnd]]:
    """The ends of each topic: those that get the same messages."""
    found: dict[tuple[str, str], list[OpenEnd]] = {}
    for end in ends:
        own = end.name is None or end.is_service
        key = (end.rebec, end.server) if own else (end.name or "", "")
        found.setdefault(key, []).append(end)
    return found


@dataclass(frozen=True, slots=True)
class _Field:
    """A field of the messages of a topic: the local of the environment that has its value."""

    variable: str
    type: m.Type
    values: tuple[Value, ...]
    is_text: bool = False


@dataclass(slots=True)
class _Environment:
    """Collects what an environment sends; `used` are names that its class has for other things."""

    model: m.Model
    properties: Properties
    types: MessageTypes
    texts: Sequence[str]
    used: set[str]
    assumptions: list[str] = field(default_factory=list)
    gaps: list[str] = field(default_factory=list)
    servers: list[m.MessageServer] = field(default_factory=list)

    def add(self, ends: Sequence[OpenEnd]) -> None:
        """A server that sends the messages of a topic, or calls a service."""
        name = unique(model_word((ends[0].name or ends[0].server).strip("/")), self.used)
        parameters = [parameters_of(self.model, end) for end in ends]
        fields = dict(self._fields(ends, parameters))
        sends = [
            _sent(end, [fields[path].variable for path in own])
            for end, own in zip(ends, parameters, strict=True)
        ]
        chosen = [
            m.Local(m.Declaration(f.type, (m.Declarator(f.variable, _choice(f)),)))
            for f in fields.values()
        ]
        again = m.ExpressionStatement(m.Call(m.Self(), name, (), m.IntLiteral(1)))
        body = m.If(_EITHER, m.Block((*chosen, *sends)))
        self.servers.append(m.MessageServer(name, (), m.Block((body, again))))
        self._tell(ends[0], fields)

    def _fields(
        self, ends: Sequence[OpenEnd], parameters: Sequence[dict[str, m.Parameter]]
    ) -> Iterator[tuple[str, _Field]]:
        """The fields of a message by their paths, which all its receivers get alike."""
        for path in dict.fromkeys(path for own in parameters for path in own):
            given = [(e, own[path]) for e, own in zip(ends, parameters, strict=True) if path in own]
            places = {Scope.of(*_server(self.model, end)).variable(own.name) for end, own in given}
            type_ = given[0][1].type
            range_ = self.types.range_of(ends[0].type or "", path)
            found = representatives(self.model, places, type_, self.properties, range_)
            texts = {self._is_text(end, path) for end, _ in given}
            if texts == {True}:
                found = of_texts(found, self.texts)
            elif True in texts:
                found = replace(found, is_exact=False)
            if not found.is_exact:
                what = f"{ends[0].name or ends[0].server}.{path}"
                tried = f"only {_some(found.values)} is sent" if found.values else "none is sent"
                self.gaps.append(f"{what} is more than copied and compared with constants: {tried}")
            variable = unique(model_word(path.replace(".", "_")), self.used)
            yield path, _Field(variable, type_, found.values, texts == {True})

    def _is_text(self, end: OpenEnd, path: str) -> bool:
        return (self.types.fields(end.type or "") or {}).get(path) == TEXT

    def _tell(self, end: OpenEnd, fields: dict[str, _Field]) -> None:
        name = end.name or end.server
        if prod(len(f.values) for f in fields.values()) > _MOST:
            self.gaps.append(f"{name} has more than {_MOST:,} different messages")
        what = f"{name} is called" if end.is_service else f"{name} comes"
        values = [f"{path} {self._told(f)}{_finite(f)}" for path, f in fields.items()]
        said = f"{what} at most once in each unit of time"
        self.assumptions.append(f"{said}, with {', '.join(values)}" if values else said)

    def _told(self, of: _Field) -> str:
        """The values of a field."""
        if not of.is_text:
            return _some(of.values)
        named = [f'"{self.texts[int(v)]}"' for v in of.values if v != OTHER]
        return f"one of {', '.join(named)} or any other text" if named else "any text"

    def closed(self, ends: Sequence[OpenEnd], fed: Sequence[OpenEnd]) -> m.Model:
        """The model with the environment in it, where no server is open any more."""
        assert self.model.main is not None
        names = {c.name for c in self.model.classes} | {r.name for r in self.model.main.rebecs}
        class_, rebec = unique("Environment", names), unique("environment", names | self.used)
        owners = {r.name: r.type for r in self.model.main.rebecs}
        known = [n for n in owners if any(e.rebec == n for e in ends)]
        rebecs = declarations((n, owners[n]) for n in known)
        first = tuple(m.ExpressionStatement(m.Call(m.Self(), s.name)) for s in self.servers)
        constructor = m.Constructor(class_, (), m.Block(first))
        members: tuple[m.ClassMember, ...] = (m.KnownRebecs(rebecs), constructor, *self.servers)
        environment = m.ReactiveClass(class_, len(self.servers) + 1, members)
        more = _more_messages((*ends, *fed))
        classes = tuple(without_open(c, more.get(c.name, {})) for c in self.model.classes)
        started = m.Rebec(m.Type(class_), rebec, tuple(map(m.Name, known)), ())
        main = replace(self.model.main, rebecs=(*self.model.main.rebecs, started))
        return replace(self.model, classes=(*classes, environment), main=main)


def _server(model: m.Model, end: OpenEnd) -> tuple[m.ReactiveClass, m.MessageServer]:
    """The server of an open end, and its class."""
    return next(
        (owner, member)
        for owner in model.classes
        if isinstance(owner, m.ReactiveClass) and owner.name == end.owner
        for member in owner.members
        if isinstance(member, m.MessageServer) and member.name == end.server
    )


def parameters_of(model: m.Model, end: OpenEnd) -> dict[str, m.Parameter]:
    """The parameters of an open server by the paths of the fields that they get."""
    parameters = _server(model, end)[1].parameters
    paths = end.fields if len(end.fields) == len(parameters) else None
    return dict(zip(paths or (p.name for p in parameters), parameters, strict=True))


def _sent(end: OpenEnd, variables: Iterable[str]) -> m.Statement:
    call = m.Call(m.Name(end.rebec), end.server, tuple(map(m.Name, variables)))
    return m.ExpressionStatement(call)


def _kept(end: OpenEnd) -> int:
    """How many messages of an end wait at most."""
    return min(end.depth or _DEEPEST, _DEEPEST)


def _more_messages(ends: Iterable[OpenEnd]) -> dict[str, dict[str, int]]:
    """By class and server how many messages from outside may wait at the same time."""
    found: dict[str, dict[str, int]] = {}
    for end in ends:
        servers = found.setdefault(end.owner, {})
        servers[end.server] = max(servers.get(end.server, 0), _kept(end))
    return found


def without_open(
    owner: m.ReactiveClass | m.Interface, waiting: Mapping[str, int] = _NONE
) -> m.ReactiveClass | m.Interface:
    """A class without `@Open`, with room for messages from outside.

    Where it is busy for some time no more than those `waiting` are there, by servers: the queues of
    ROS lose the oldest. Else each is served before the next comes.
    """
    if not isinstance(owner, m.ReactiveClass):
        return owner
    lossy = waiting if _delays(owner) else _NONE
    members = tuple(
        replace(x, annotations=tuple(_closed_annotations(x, lossy.get(x.name, 0))))
        if isinstance(x, m.MessageServer)
        else x
        for x in owner.members
    )
    room = sum(lossy.values()) if lossy else len(waiting)
    return replace(owner, members=members, queue_length=owner.queue_length + room)


def _closed_annotations(server: m.MessageServer, depth: int) -> Iterator[m.Annotation]:
    if depth:
        yield m.Annotation(KEEP_LAST, (m.IntLiteral(depth),))
    yield from (a for a in server.annotations if a.name != OPEN)


def _is_slow(model: m.Model, owner: str) -> bool:
    return any(c.name == owner and _delays(c) for c in model.classes)


def _delays(owner: m.ReactiveClass | m.Interface) -> bool:
    """Whether a body takes time."""
    return any(
        isinstance(n, m.Call) and n.target is None and n.name == "delay" for n in m.walk(owner)
    )


def _choice(of: _Field) -> m.Expression | None:
    literals = tuple(map(exact_literal_of if of.type.name == "double" else literal_of, of.values))
    return m.Choice(literals) if len(literals) > 1 else next(iter(literals), None)


def _finite(of: _Field) -> str:
    return ", a finite number" if of.type.name in ("float", "double") else ""


def _some(values: Sequence[Value]) -> str:
    literals = [str(v).lower() if isinstance(v, bool) else f"{v:g}" for v in values]
    told = tuple(dict.fromkeys(literals))
    return f"one of {', '.join(told)}" if len(told) > 1 else "".join(told)
