"""The states that a search has met, each once, with the steps that fit what was observed.

The steps are those of the checker's exact view; nothing here says what a model means.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from rebsync.checker.program import Cell, Program
from rebsync.checker.state import Message, State
from rebsync.checker.steps import TIME, Action, Failure, Step
from rebsync.checker.views import Exact, Steps
from rebsync.conform.observable import Observable
from rebsync.conform.recording import Served

MOST = 50_000  # states that are remembered

Key = tuple[int, str, str, int, tuple[Cell, ...]]
"""What of an observation decides about a step: rebec, server, arguments, arrival - start, state."""


class Move(NamedTuple):
    """A step of a rebec that fits: where it leads, and whether the body ends in it."""

    rebec: int
    node: Node
    ended: bool
    message: Message | None


class Node:
    """A state of the model. `able` are the rebecs that can act; else `later` is after some time."""

    __slots__ = ("_actions", "_steps", "able", "after", "moves", "state", "truth")

    def __init__(self, state: State, steps: Sequence[Step]) -> None:
        self.state = state
        self._steps = steps
        self._actions = steps.actions() if isinstance(steps, Steps) else [s.action for s in steps]
        self.able = tuple(dict.fromkeys(a.actor for a in self._actions if a.actor != TIME))
        self.moves: dict[Key, Fitting] = {}
        self.after: tuple[Node, int] | None = None
        self.truth: dict[int, bool | None] = {}  # of predicates; None: it has no value

    @property
    def waits(self) -> Step | None:
        """The step in which time passes, when nobody can act."""
        return self._steps[0] if self._actions and self._actions[0].actor == TIME else None

    def of(self, rebec: int) -> list[tuple[int, Action]]:
        """The numbers and actions of a rebec's steps."""
        return [(i, a) for i, a in enumerate(self._actions) if a.actor == rebec]

    def step(self, number: int) -> Step:
        """A step by its number."""
        return self._steps[number]

    def steps(self) -> Sequence[Step]:
        """All steps."""
        return self._steps

    def message(self, action: Action) -> Message | None:
        """The message that an action serves; None of a constructor."""
        local = self.state[action.actor]
        message = local.bag[action.slot] if action.slot >= 0 else None
        if message is None and local.point is not None:
            message = local.point.message
        return message if message is not None and message.server >= 0 else None


class Fitting(NamedTuple):
    """The steps of a rebec that fit an observation, and how those fail that fit and fail."""

    moves: tuple[Move, ...]
    failures: tuple[Failure, ...]


NOTHING = Fitting((), ())


class StateGraph:
    """The part of the state space that a search has looked at."""

    def __init__(self, program: Program, observable: Observable) -> None:
        self.view = Exact(program)
        self.program = program
        self.observable = observable
        self._nodes: dict[State, Node] = {}
        self._texts: dict[tuple[int, tuple[Cell, ...]], str] = {}

    def node(self, state: State) -> Node:
        """The node of a state."""
        found = self._nodes.get(state)
        if found is None:
            if len(self._nodes) >= MOST:
                self.forget()
            found = self._nodes[state] = Node(state, self.view.steps(state))
        return found

    def forget(self) -> None:
        """Lets go of all states, and of what actors remember, so that memory stays bounded."""
        for node in self._nodes.values():
            node.moves.clear()  # or whoever holds one would hold all
            node.after = None
        self._nodes.clear()
        self._texts.clear()
        coverage = self.view.coverage
        self.view = Exact(self.program)
        self.view.coverage = coverage

    def start(self) -> tuple[Node, ...]:
        """The states in which all constructors have run, or are suspended."""
        results = [s.result for s in self.view.initial_states()]
        return tuple(self.node(r) for r in results if not isinstance(r, Failure))

    def later(self, node: Node) -> tuple[Node, int] | None:
        """The state after time has passed, and how much; None when nothing is left to do."""
        if node.after is None:
            step = node.waits
            if step is None or isinstance(step.result, Failure):
                return None
            node.after = self.node(step.result), step.time
        return node.after

    def fitting(self, node: Node, key: Key, served: Served) -> Fitting:
        """The steps of a rebec that serve what was observed, and end in its state if they end."""
        found = node.moves.get(key)
        if found is None:
            found = node.moves[key] = self._fitting(node, served)
        return found

    def _fitting(self, node: Node, served: Served) -> Fitting:
        rebec = served.rebec
        moves, failures = [], []
        for number, action in node.of(rebec):
            message = node.message(action)
            if action.slot >= 0 and not self.serves(message, served, served.start):
                continue
            result = node.step(number).result
            if isinstance(result, Failure):
                failures.append(result)
                continue
            ended = result[rebec].point is None
            variables = result[rebec].variables
            if not ended or self.observable.is_same(rebec, served.cells, variables):
                moves.append(Move(rebec, self.node(result), ended, message))
        return Fitting(tuple(moves), tuple(failures)) if moves or failures else NOTHING

    def all_of(self, node: Node, rebec: int) -> Fitting:
        """All steps of a rebec, whatever was observed."""
        moves, failures = [], []
        for number, action in node.of(rebec):
            result = node.step(number).result
            if isinstance(result, Failure):
                failures.append(result)
            else:
                ended = result[rebec].point is None
                moves.append(Move(rebec, self.node(result), ended, node.message(action)))
        return Fitting(tuple(moves), tuple(failures))

    def serves(self, message: Message | None, served: Served, time: int) -> bool:
        """Whether a message, whose times count from `time`, is the one that was served."""
        if message is None:
            return served.server == "constructor"
        server = self.program.servers[message.server]
        return (
            server.name == served.server
            and time + message.arrival == served.arrival
            and self.text(message) == served.arguments
        )

    def text(self, message: Message) -> str:
        """The arguments of a message as nodes write them."""
        key = message.server, message.arguments
        found = self._texts.get(key)
        if found is None:
            found = self._texts[key] = self.observable.arguments(*key)
        return found
