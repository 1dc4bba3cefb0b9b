"""What a search has seen as a state space for people."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from typing import overload

from rebsync.checker.endless import EndlessBody
from rebsync.checker.machine import Failed
from rebsync.checker.search import Interpreted
from rebsync.checker.show import words
from rebsync.checker.show.space import SpaceEdge, StateSpace
from rebsync.checker.state import State
from rebsync.checker.steps import Failure, Step
from rebsync.checker.telling import Teller
from rebsync.checker.trace import ShownRebec


def space_of(search: Interpreted, teller: Teller, invariants: Mapping[int, str]) -> StateSpace:
    """All states that a search with the interpreter has seen, and the steps between them.

    `invariants` are properties by the number of their predicate; where one is false, the state
    is marked, as is a deadlock.
    """
    holds = tuple(
        tuple(name for number, name in invariants.items() if _holds(search, state, number))
        for state in search.states
    )
    marks = []
    for number, state in enumerate(search.states):
        marks += [
            (number, f"{n} does not hold") for n in invariants.values() if n not in holds[number]
        ]
        if _is_deadlock(search, state):
            marks.append((number, "deadlock"))
    initial = [s.result for s in search.view.initial_states() if not isinstance(s.result, Failure)]
    return StateSpace(
        teller.source.path,
        search.semantics,
        _States(search, teller),
        _Edges(search, teller),
        tuple(dict.fromkeys(search.numbers[state] for state in initial if state in search.numbers)),
        tuple(marks),
        holds,
    )


class _States(Sequence[tuple[ShownRebec, ...]]):
    """The states in words, each told when it is asked for."""

    def __init__(self, search: Interpreted, teller: Teller) -> None:
        self._search = search
        self._teller = teller

    def __len__(self) -> int:
        return len(self._search.states)

    @overload
    def __getitem__(self, index: int) -> tuple[ShownRebec, ...]: ...
    @overload
    def __getitem__(self, index: slice) -> list[tuple[ShownRebec, ...]]: ...
    def __getitem__(
        self, index: int | slice
    ) -> tuple[ShownRebec, ...] | list[tuple[ShownRebec, ...]]:
        if isinstance(index, slice):
            return [self._teller.state(state, 0) for state in self._search.states[index]]
        return self._teller.state(self._search.states[index], 0)


class _Edges:
    """The steps in words, told anew each time that they are gone through."""

    def __init__(self, search: Interpreted, teller: Teller) -> None:
        self._search = search
        self._teller = teller

    def __iter__(self) -> Iterator[SpaceEdge]:
        for number, state in enumerate(self._search.states):
            yield from _edges(self._search, self._teller, number, state)


def _holds(search: Interpreted, state: State, predicate: int) -> bool:
    """Whether a predicate holds; one that has no value does not."""
    try:
        return search.holds(state, predicate)
    except Failed:
        return False


def _is_deadlock(search: Interpreted, state: State) -> bool:
    try:
        return search.view.is_deadlock(state)
    except EndlessBody:
        return False


def _steps(search: Interpreted, state: State) -> Iterator[Step]:
    """The steps from a state, up to one that does not end, where the search gave up too."""
    with suppress(EndlessBody):
        yield from search.view.steps(state)


def _edges(search: Interpreted, teller: Teller, number: int, state: State) -> Iterator[SpaceEdge]:
    """The steps from a state, but for those to states that a bounded search has not seen."""
    for step in _steps(search, state):
        target = None
        if not isinstance(step.result, Failure):
            target = search.numbers.get(step.result)
            if target is None:
                continue
        yield _edge(teller, number, state, step, target)


def _edge(teller: Teller, number: int, state: State, step: Step, target: int | None) -> SpaceEdge:
    told = teller.deed(0, state, step)
    chosen = f" ?({', '.join(told.choices)})" if told.choices else ""
    match told.kind, told.message:
        case "time", _:
            return SpaceEdge(number, target, f"+{step.time}", step.time, told.failure)
        case kind, None:
            label, server, sender = f"{told.rebec} goes on", "", told.rebec
        case kind, message:
            on = " goes on" if kind == "resume" else ""
            label = f"{told.rebec}.{words.call(message)}{on}"
            server, sender = message.server, message.sender
    return SpaceEdge(
        number,
        target,
        label + chosen,
        step.time,
        told.failure,
        told.rebec,
        server,
        sender,
        told.kind == "resume",
    )
