"""Where a search begins: at the constructors, or in the middle of a run, by what was observed."""

from __future__ import annotations

from collections import deque
from dataclasses import replace
from typing import Literal, TypeAlias

from rebsync.checker.endless import EndlessBody
from rebsync.checker.state import Local, State
from rebsync.checker.steps import Failure
from rebsync.conform.graph import Node, StateGraph
from rebsync.conform.possible import Config
from rebsync.conform.recording import Served
from rebsync.conform.stream import Stream
from rebsync.records import dataclass

CONSTRUCTOR = "constructor"
REACHED = 200_000  # states of the model among which those are looked for that fit


Mode: TypeAlias = Literal["constructors", "earliest", "latest"]
"""Where to begin: at time 0; in the middle, at the first time that a rebec shows, as in a part of a
recording; or when all have shown a state, as nodes that latch it may show an old one."""


@dataclass(frozen=True, slots=True)
class Start:
    """Possible states at a time; `is_middle`: by synchronisation, which `is_whole` if no state of
    the model was left out. `mismatch` is a constructor's observation that no start of the model
    has, `missing` are the rebecs whose constructors were not observed. `skipped` observations are
    up to that time, and `unseen` of them say more than where a rebec was."""

    configs: tuple[Config, ...]
    time: int
    is_middle: bool
    is_whole: bool = True
    mismatch: Served | None = None
    missing: tuple[int, ...] = ()
    skipped: int = 0
    unseen: int = 0


def modes(
    graph: StateGraph, stream: Stream, hidden: frozenset[int] = frozenset()
) -> tuple[Mode, ...]:
    """The ways to begin that a recording leaves open, the one that says most first.

    Of the rebecs in `hidden` nothing is recorded.
    """
    shown = [rebec for rebec in _constructed(graph) if rebec not in hidden]
    first = [stream.get(rebec, 0) for rebec in shown]
    begins = [served is not None and _is_constructor(served) for served in first]
    if all(begins) and begins:
        return ("constructors",)
    if any(begins):
        return ("constructors", "earliest", "latest")
    return ("earliest", "latest")


def start(graph: StateGraph, stream: Stream, mode: Mode, most: int = REACHED) -> Start:
    """The possible states from which a recording goes on."""
    if mode != "constructors":
        return _synchronised(graph, stream, mode, most)
    first: dict[int, Served] = {}
    missing: list[int] = []
    for rebec in _constructed(graph):
        served = stream.get(rebec, 0)
        if served is not None and _is_constructor(served):
            first[rebec] = served
        else:
            missing.append(rebec)
    return replace(_from_constructors(graph, first), missing=tuple(missing))


def _constructed(graph: StateGraph) -> list[int]:
    """The rebecs that have constructors: nodes of others show none."""
    return [r for r, info in enumerate(graph.program.rebecs) if info.constructor >= 0]


def _is_constructor(served: Served) -> bool:
    return served.server == CONSTRUCTOR and served.start == 0


def _from_constructors(graph: StateGraph, first: dict[int, Served]) -> Start:
    nodes = graph.start()
    configs = [c for node in nodes if (c := _possible(graph, node, first)) is not None]
    wrong = None if configs else _wrong(graph, nodes, first)
    return Start(tuple(configs), 0, False, mismatch=wrong)


def _possible(graph: StateGraph, node: Node, first: dict[int, Served]) -> Config | None:
    positions = []
    for rebec, local in enumerate(node.state):
        served = first.get(rebec)
        if served is not None and not _is_of(graph, local, served):
            return None
        positions.append(0 if served is None or local.point is not None else 1)
    return Config(node, tuple(positions))


def _is_of(graph: StateGraph, local: Local, served: Served) -> bool:
    """Whether a constructor, whose end is observed, may have led to a state or be suspended."""
    if served.arguments or served.arrival != 0:
        return False
    if local.point is not None:
        return True
    is_same = graph.observable.is_same(served.rebec, served.cells, local.variables)
    return served.now == 0 and is_same


def _wrong(graph: StateGraph, nodes: tuple[Node, ...], first: dict[int, Served]) -> Served | None:
    """The first constructor whose observation no start has."""
    for rebec, served in first.items():
        if not any(_is_of(graph, node.state[rebec], served) for node in nodes):
            return served
    return next(iter(first.values()), None)


# --- in the middle of a run


def _synchronised(graph: StateGraph, stream: Stream, mode: Mode, most: int) -> Start:
    """The reachable states that fit what each rebec has shown last."""
    rebecs = range(len(graph.program.rebecs))
    first = [served for rebec in rebecs if (served := stream.get(rebec, 0)) is not None]
    times = [served.now for served in first] or [0]
    time = min(times) if mode == "earliest" else max(times)
    unseen = 0
    last: list[Served | None] = []
    following: list[Served | None] = []
    positions: list[int] = []
    for rebec in rebecs:
        position, shown = 0, None
        while (served := stream.get(rebec, position)) is not None and served.now <= time:
            if not _has_server(graph, rebec, served.server):
                return Start((), time, True, mismatch=served)
            unseen += shown is not None and shown.now < time
            position, shown = position + 1, served
        last.append(shown)
        following.append(served)
        positions.append(position)
    reached = _reachable(graph, most)
    at = tuple(positions)

    def fitting(states: list[State]) -> tuple[Config, ...]:
        fit = (s for s in states if _fits(graph, s, last, following, time))
        return tuple(Config(graph.node(state), at) for state in fit)

    configs, skipped = fitting(reached.passing), sum(positions)
    if not configs and not any(following):
        # It ends within this moment, of which only what each rebec has shown last is compared.
        configs = fitting(reached.within)
        unseen = skipped - sum(shown is not None for shown in last)
    return Start(configs, time, True, reached.is_whole, skipped=skipped, unseen=unseen)


def _has_server(graph: StateGraph, rebec: int, name: str) -> bool:
    """Whether the class of a rebec has a message server, or is constructed."""
    program = graph.program
    servers = {program.servers[n].name for n in program.rebecs[rebec].dispatch if n >= 0}
    return name in servers or (name == CONSTRUCTOR and program.rebecs[rebec].constructor >= 0)


def _fits(
    graph: StateGraph,
    state: State,
    last: list[Served | None],
    following: list[Served | None],
    time: int,
) -> bool:
    """Whether a state in which time is about to pass fits what was observed around that time."""
    for rebec, local in enumerate(state):
        served, busy = last[rebec], following[rebec]
        if busy is not None and busy.start > time:
            busy = None
        if graph.program.reads_clock and local.clock != time:
            return False
        if local.point is None:
            variables = local.variables
            if busy is not None or (
                served is not None and not graph.observable.is_same(rebec, served.cells, variables)
            ):
                return False
        elif busy is not None:
            message = local.point.message if local.point.message.server >= 0 else None
            if busy.now < time + local.busy or not graph.serves(message, busy, time):
                return False
        elif following[rebec] is not None:
            return False
    return True


@dataclass(frozen=True, slots=True)
class _Reached:
    """Reachable states: those in which time passes next, or nothing, and those within a moment."""

    passing: list[State]
    within: list[State]
    is_whole: bool


def _reachable(graph: StateGraph, most: int) -> _Reached:
    """The reachable states, up to so many."""
    view = graph.view
    begun = [s.result for s in view.initial_states()]
    work = deque(s for s in begun if not isinstance(s, Failure))
    seen: set[State] = set(work)
    passing: list[State] = []
    within: list[State] = []
    while work:
        state = work.popleft()
        try:
            steps = view.steps(state)
        except EndlessBody:
            return _Reached(passing, within, False)
        is_passing = all(step.action.actor < 0 for step in steps)
        (passing if is_passing else within).append(state)
        for step in steps:
            if not isinstance(step.result, Failure) and step.result not in seen:
                if len(seen) >= most:
                    return _Reached(passing, within, False)
                seen.add(step.result)
                work.append(step.result)
    return _Reached(passing, within, True)
