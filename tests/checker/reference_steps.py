"""States and steps of the reference.

Times are absolute; two states are one when they are equal after subtracting the present moment
(`Explorer.identity`).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Literal, NamedTuple

from rebsync import model as m
from rebsync.source import Source
from rebsync.static import Analysis
from rebsync.static.symbols import BuiltinSymbol, MethodSymbol, Symbol
from tests.checker.reference_bodies import Body
from tests.checker.reference_frames import Fails, Key, Variables, World, key_of
from tests.checker.reference_main import UNRANKED, Instance, environment, instances, priority
from tests.checker.reference_values import Value, bits, wrap, zero

View = Literal["tts", "ftts", "core"]
_CLOCK = ("now", "currentMessageArrival", "currentMessageDeadline")
_WAITED = "currentMessageWaitingTime"
_FOREVER = 2**31 - 1
_CONSTRUCTOR: Key = ("", ())


class Mail(NamedTuple):
    """A message in a bag."""

    arrival: int
    key: Key
    sender: int
    deadline: int | None
    arguments: tuple[Value, ...]


@dataclass(frozen=True)
class Stand:
    """A suspended body: what it serves since when, where it is, and how to get there again."""

    mail: Mail
    taken: int
    frames: tuple[object, ...]
    start: Variables
    log: tuple[object, ...]


@dataclass(frozen=True)
class Actor:
    """One rebec; it is busy before `until`."""

    variables: Variables
    bag: tuple[Mail, ...] = ()
    until: int = 0
    stand: Stand | None = None


@dataclass(frozen=True)
class State:
    """All rebecs at a time."""

    time: int
    actors: tuple[Actor, ...]


class Violation(NamedTuple):
    """A failed step: kind, rebec, and the line of the model, or the server of a missed deadline."""

    kind: str
    rebec: str
    place: int | str


Result = State | Violation


class Suspended(Exception):
    """A body comes to a delay (exact view)."""

    def __init__(self, time: int) -> None:
        super().__init__(time)
        self.time = time


@dataclass
class _Draft:
    """An actor while a step changes it."""

    bag: list[Mail]
    serving: bool
    capacity: int


@dataclass
class _Present(World):
    """The world at one step: what the acting rebec is told and what it does to the others."""

    view: View
    time: int
    actor: int
    mail: Mail
    drafts: list[_Draft]
    script: list[int]
    taken: int
    depths: Mapping[tuple[int, Key], int]  # how many messages of a server wait at most
    options: list[int] = field(default_factory=list)
    elapsed: int = 0

    def choose(self, count: int) -> int:
        self.options.append(count)
        if len(self.options) > len(self.script):
            self.script.append(0)
        return self.script[len(self.options) - 1]

    def read(self, name: str) -> int:
        now = self.time + self.elapsed
        match name:
            case "now":
                return wrap(now)
            case "currentMessageArrival":
                return wrap(self.mail.arrival)
            case "currentMessageDeadline":
                return _FOREVER if self.mail.deadline is None else wrap(self.mail.deadline)
            case _:
                return wrap(self.taken - self.mail.arrival)

    def send(
        self, node: m.Call, receiver: int, key: Key, arguments: Value, times: tuple[int, int | None]
    ) -> None:
        draft, now = self.drafts[receiver], self.time + self.elapsed
        waiting = [mail for mail in draft.bag if mail.key == key]
        depth = self.depths.get((receiver, key))
        if depth is not None and receiver != self.actor and len(waiting) >= depth:
            draft.bag.remove(min(waiting, key=lambda mail: mail.arrival))
        if len(draft.bag) + draft.serving >= draft.capacity:
            raise Fails("overflow", node, receiver)
        assert isinstance(arguments, tuple)
        due = None if times[1] is None else now + times[1]
        draft.bag.append(Mail(now + times[0], key, self.actor, due, arguments))

    def wait(self, time: int) -> None:
        if self.view == "tts":
            raise Suspended(time)
        self.elapsed += time


@dataclass(frozen=True)
class Explorer:
    analysis: Analysis
    source: Source
    view: View
    env: Variables
    rebecs: tuple[Instance, ...]
    is_global: bool
    reads_clock: bool

    @staticmethod
    def of(analysis: Analysis, source: Source, view: View) -> Explorer:
        nodes = list(m.walk(analysis.model))
        names = {s.name for n in nodes if isinstance(s := analysis.symbol_of(n), BuiltinSymbol)}
        servers = [n for n in nodes if isinstance(n, m.MessageServer)]
        ranks = {a.name for server in servers for a in server.annotations}
        env = environment(analysis)
        rebecs = instances(analysis, env)
        is_global = "globalPriority" in ranks
        return Explorer(
            analysis, source, view, env, rebecs, is_global, not names.isdisjoint(_CLOCK)
        )

    # --- states ----------------------------------------------------------------------------------

    def identity(self, state: State) -> object:
        """What decides whether two states are the same."""
        clock = state.time if self.reads_clock else None
        return clock, tuple(self._local(i, a, state.time) for i, a in enumerate(state.actors))

    def _local(self, index: int, actor: Actor, time: int) -> object:
        bag = [repr(_relative(mail, time)) for mail in actor.bag]
        stand: object = None
        if actor.stand is not None:
            mail = actor.stand.mail
            asks = mail.key != _CONSTRUCTOR and self._asks(index, self._server(index, mail))
            waited = actor.stand.taken - mail.arrival if asks else None
            stand = (_relative(mail, time), waited, actor.stand.frames)
        return (
            tuple(bits(v) for v in actor.variables.values()),
            tuple(bag if self.view == "core" else sorted(bag)),
            max(actor.until - time, 0),
            stand,
        )

    def _asks(self, index: int, declared: m.Node) -> bool:
        """Whether a body, or a method that it may call, reads how long its message waited."""
        work, seen = [declared], [declared]
        while work:
            for node in m.walk(work.pop()):
                symbol = self.analysis.symbol_of(node)
                if isinstance(symbol, BuiltinSymbol) and symbol.name == _WAITED:
                    return True
                if isinstance(node, m.Call) and isinstance(symbol, MethodSymbol):
                    own = self.rebecs[index].info.methods
                    called = [s.declaration for s in (symbol, *own) if s.name == symbol.name]
                    new = [c for c in called if not any(c is each for each in seen)]
                    work += new
                    seen += new
        return False

    def initial(self) -> Iterator[Result]:
        """The states after all constructors, or what went wrong in one."""
        blank = tuple(
            Actor({s: zero(_known_type(s)) for s in rebec.info.state}) for rebec in self.rebecs
        )
        yield from self._constructed(State(0, blank), 0)

    def _constructed(self, state: State, index: int) -> Iterator[Result]:
        if index == len(self.rebecs):
            yield self._advanced(state)
            return
        mail = Mail(0, _CONSTRUCTOR, index, None, ())
        for result in self._every_way(state, index, state.actors[index].bag, mail):
            if isinstance(result, Violation):
                yield result
            else:
                yield from self._constructed(result, index + 1)

    # --- steps -----------------------------------------------------------------------------------

    def steps(self, state: State) -> Iterator[Result]:
        """Everything that can happen next."""
        able = [i for i in range(len(self.rebecs)) if self._able(state, i)]
        if not able:
            if self.view == "tts" and not is_dead(state):
                yield State(min(_next_event(a) for a in state.actors), state.actors)
            return
        least = min(self._rank(state, i) for i in able)
        for index in able:
            if self._rank(state, index) == least:
                yield from self._acts(state, index)

    def _able(self, state: State, index: int) -> bool:
        actor = state.actors[index]
        if self.view == "core":
            return bool(actor.bag)
        return _next_event(actor) <= state.time

    def _rank(self, state: State, index: int) -> int:
        if self.view == "core":
            return 0
        if not self.is_global:
            return self.rebecs[index].rank
        stand = state.actors[index].stand
        if stand is not None:
            return self._priority(index, stand.mail)
        return min(self._priority(index, mail) for mail in self._candidates(state, index))

    def _priority(self, index: int, mail: Mail) -> int:
        if mail.key == _CONSTRUCTOR or self.view == "core":
            return UNRANKED
        server = self._server(index, mail)
        return priority(server.annotations)

    def _server(self, index: int, mail: Mail) -> m.MessageServer:
        servers = self.rebecs[index].info.servers
        return next(s.declaration for s in servers if key_of(s) == mail.key)

    def _depths(self) -> dict[tuple[int, Key], int]:
        return {
            (index, key_of(server)): note.arguments[0].value
            for index, rebec in enumerate(self.rebecs)
            for server in rebec.info.servers
            for note in server.declaration.annotations
            if note.name == "KeepLast" and note.arguments
            if isinstance(note.arguments[0], m.IntLiteral)
        }

    def _candidates(self, state: State, index: int) -> list[Mail]:
        """The messages of which an idle rebec takes one."""
        bag = state.actors[index].bag
        if self.view == "core":
            return [bag[0]]
        first = min(mail.arrival for mail in bag)
        earliest = [mail for mail in bag if mail.arrival == first]
        best = min(self._priority(index, mail) for mail in earliest)
        return [mail for mail in earliest if self._priority(index, mail) == best]

    def _acts(self, state: State, index: int) -> Iterator[Result]:
        actor = state.actors[index]
        if actor.stand is not None:
            for result in self._every_way(state, index, actor.bag, actor.stand.mail):
                yield self._advanced(result) if isinstance(result, State) else result
            return
        for mail in self._candidates(state, index):
            if mail.deadline is not None and mail.deadline < state.time:
                owner = self.rebecs[index].info.name
                yield Violation("deadline", self.rebecs[index].name, f"{owner}.{mail.key[0]}")
                continue
            rest = list(actor.bag)
            rest.remove(mail)
            for result in self._every_way(state, index, tuple(rest), mail):
                yield self._advanced(result) if isinstance(result, State) else result

    def _advanced(self, state: State) -> State:
        """Floating view: the moment at which the next message is taken."""
        events = [max(_next_event(a), state.time) for a in state.actors if a.bag]
        if self.view != "ftts" or not events:
            return state
        return State(min(events), state.actors)

    def _every_way(
        self, state: State, index: int, bag: tuple[Mail, ...], mail: Mail
    ) -> Iterator[Result]:
        """What comes of a body, for every way to choose; later choices change first."""
        script: list[int] = []
        while True:
            drafts = self._drafts(state, index, bag, mail)
            standing = state.actors[index].stand
            since = state.time if standing is None else standing.taken
            depths = self._depths()
            present = _Present(self.view, state.time, index, mail, drafts, script, since, depths)
            yield self._run(state, index, present)
            taken = list(zip(present.script, present.options, strict=True))
            while taken and taken[-1][0] + 1 == taken[-1][1]:
                taken.pop()
            if not taken:
                return
            script = [choice for choice, _ in taken]
            script[-1] += 1

    def _drafts(self, state: State, index: int, bag: tuple[Mail, ...], mail: Mail) -> list[_Draft]:
        drafts = []
        for i, actor in enumerate(state.actors):
            standing = actor.stand.mail if actor.stand is not None else None
            served = mail if i == index else standing
            serving = served is not None and served.key != _CONSTRUCTOR
            drafts.append(
                _Draft(list(bag if i == index else actor.bag), serving, self.rebecs[i].capacity)
            )
        return drafts

    def _run(self, state: State, index: int, present: _Present) -> Result:
        actor = state.actors[index]
        start = actor.stand.start if actor.stand else actor.variables
        log = [*actor.stand.log, None] if actor.stand else []
        body = self._body(index, dict(start), present, log)
        stand, until = None, state.time
        try:
            self._start(body, index, present.mail)
            until += present.elapsed
        except Suspended as suspended:
            frames = tuple(frame.identity() for frame in body.frames)
            stand = Stand(present.mail, present.taken, frames, start, tuple(body.log))
            until += suspended.time
        except Fails as failed:
            rebec = self.rebecs[index if failed.rebec is None else failed.rebec]
            line = self.source.position(failed.node.span.start).line
            return Violation(failed.kind, rebec.name, line)
        actors = [
            Actor(a.variables, tuple(d.bag), a.until, a.stand)
            for a, d in zip(state.actors, present.drafts, strict=True)
        ]
        actors[index] = Actor(body.variables, actors[index].bag, until, stand)
        return State(state.time, tuple(actors))

    def _body(self, index: int, variables: Variables, world: World, log: list[object]) -> Body:
        rebec = self.rebecs[index]
        sender = world.mail.sender if isinstance(world, _Present) else index
        return Body(
            self.analysis,
            rebec.info,
            index,
            rebec.known,
            self.env,
            variables,
            sender,
            world,
            log,
        )

    def _start(self, body: Body, index: int, mail: Mail) -> None:
        if mail.key == _CONSTRUCTOR:
            rebec = self.rebecs[index]
            if rebec.constructor is not None:
                constructor = rebec.constructor
                body.run(constructor.parameters, rebec.arguments, constructor.body)
            return
        server = self._server(index, mail)
        body.run(server.parameters, mail.arguments, server.body)


def is_dead(state: State) -> bool:
    return not any(a.bag or a.stand for a in state.actors)


def _next_event(actor: Actor) -> int:
    """When a rebec can act by itself; never is a very late time."""
    if actor.stand is not None:
        return actor.until
    return max(actor.until, min(mail.arrival for mail in actor.bag)) if actor.bag else 2**60


def _relative(mail: Mail, time: int) -> tuple[object, ...]:
    due = None if mail.deadline is None else mail.deadline - time
    return mail.arrival - time, mail.key, mail.sender, due, bits(mail.arguments)


def _known_type(symbol: Symbol) -> m.Type:
    type_ = getattr(symbol, "type", None)
    assert isinstance(type_, m.Type)
    return type_
