"""One rebec by itself: what its bodies publish, post to itself, and change."""

from __future__ import annotations

from rebsync.checker.machine import Coverage
from rebsync.checker.outcomes import Actor, Outcome
from rebsync.checker.program import NO_DEADLINE, Cell, Program
from rebsync.checker.state import Local, Message
from rebsync.checker.steps import Failure
from rebsync.records import dataclass

_REMEMBERED = 50_000  # bodies

Cells = tuple[Cell, ...]


@dataclass(frozen=True, slots=True)
class SentMessage:
    """A message that a body sends so many units after it began: to the server of its own rebec, or
    of the environment, which publishes it."""

    server: int
    cells: Cells
    after: int


@dataclass(frozen=True, slots=True)
class BodyRun:
    """A way that a body can go; it takes `busy` units. `failure`: the model breaks a rule."""

    variables: Cells
    published: tuple[SentMessage, ...]
    posted: tuple[SentMessage, ...]
    busy: int
    failure: Failure | None = None


class ComponentBodies:
    """The bodies of one rebec of a program in which `environment` is at the end of all topics."""

    def __init__(self, program: Program, rebec: int, environment: int) -> None:
        self._actor = Actor(program, rebec, "ftts", Coverage())
        self._rebec, self._environment = rebec, environment
        self._known: dict[tuple[Cells, int, Cells], tuple[BodyRun, ...]] = {}

    def constructed(self) -> tuple[BodyRun, ...]:
        """The ways to begin. EndlessBody: the constructor does not end."""
        return tuple(map(self._run, self._actor.construct(())))

    def runs(self, variables: Cells, server: int, arguments: Cells) -> tuple[BodyRun, ...]:
        """The ways to serve a message, equal ones once. EndlessBody: the body does not end."""
        key = variables, server, arguments
        found = self._known.get(key)
        if found is None:
            if len(self._known) >= _REMEMBERED:
                self._known.clear()
            message = Message(0, server, self._environment, NO_DEADLINE, arguments)
            outcomes = self._actor.outcomes(Local(variables, (message,)))
            found = self._known[key] = tuple(dict.fromkeys(map(self._run, outcomes)))
        return found

    def _run(self, outcome: Outcome) -> BodyRun:
        published = self._sent(outcome, self._environment)
        posted = self._sent(outcome, self._rebec)
        if isinstance(outcome.result, Failure):
            return BodyRun((), published, posted, 0, outcome.result)
        local = outcome.result
        return BodyRun(local.variables, published, posted, local.busy)

    def _sent(self, outcome: Outcome, receiver: int) -> tuple[SentMessage, ...]:
        """The messages of an outcome to one of the rebecs."""
        messages = (each.message for each in outcome.sends if each.receiver == receiver)
        return tuple(SentMessage(m.server, m.arguments, m.arrival) for m in messages)
