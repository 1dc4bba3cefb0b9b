"""Where a search begins: at the constructors, or in the middle of a run, by what was observed."""

from __future__ import annotations

from collections import deque

from rebsync.checker.machine import EndlessBody
from rebsync.checker.state import Local, State
from rebsync.checker.steps import Failure
from rebsync.records import dataclass
from rebsync.roundtrip.conform.graph import Graph, Node
from rebsync.roundtrip.conform.recording import Served
from rebsync.roundtrip.conform.search import Config
from rebsync.roundtrip.conform.stream import Stream

CONSTRUCTOR = "constructor"
REACHED = 200_000  # states of the model among which those are looked for that fit


@dataclass(frozen=True, slots=True)
class Start:
    """Possible states at a time; `is_middle`: by synchronisation, which `is_whole` if no state of
    the model was left out. `mismatch` is a constructor's observation that no start of the model
    has."""

    configs: tuple[Config, ...]
    time: int
    is_middle: bool
    is_whole: bool = True
    mismatch: Served | None = None


def start(graph: Graph, stream: Stream, most: int = REACHED) -> Start:
    """The possible states from which a recording goes on."""
    first: dict[int, Served] = {}  # of the rebecs that have constructors: others show none
    for rebec, info in enumerate(graph.program.rebecs):
        if info.constructor >= 0:
            served = stream.get(rebec, 0)
            if served is None or served.server != CONSTRUCTOR or served.start != 0:
                return _synchronised(graph, stream, most)
            first[rebec] = served
    return _from_constructors(graph, first)


def _from_constructors(graph: Graph, first: dict[int, Served]) -> Start:
    nodes = graph.start()
    configs = [c for node in nodes if (c := _constructed(graph, node, first)) is not None]
    wrong = None if configs else _wrong(graph, nodes, first)
    return Start(tuple(configs), 0, False, mismatch=wrong)


def _constructed(graph: Graph, node: Node, first: dict[int, Served]) -> Config | None:
    positions = []
    for rebec, local in enumerate(node.state):
        served = first.get(rebec)
        if served is not None and not _is_of(graph, local, served):
            return None
        positions.append(0 if served is None or local.point is not None else 1)
    return Config(node, tuple(positions))


def _is_of(graph: Graph, local: Local, served: Served) -> bool:
    """Whether a constructor, whose end is observed, may have led to a state or be suspended."""
    if served.arguments or served.arrival != 0:
        return False
    if local.point is not None:
        return True
    is_same = graph.observable.is_same(served.rebec, served.cells, local.variables)
    return served.now == 0 and is_same


def _wrong(graph: Graph, nodes: tuple[Node, ...], first: dict[int, Served]) -> Served | None:
    """The first constructor whose observation no start has."""
    for rebec, served in first.items():
        if not any(_is_of(graph, node.state[rebec], served) for node in nodes):
            return served
    return next(iter(first.values()), None)


# --- in the middle of a run


def _synchronised(graph: Graph, stream: Stream, most: int) -> Start:
    """The reachable states that fit what each rebec has shown last, at the first time possible."""
    rebecs = range(len(graph.program.rebecs))
    first = [served for rebec in rebecs if (served := stream.get(rebec, 0)) is not None]
    time = max((served.now for served in first), default=0)
    last: list[Served | None] = []
    following: list[Served | None] = []
    positions: list[int] = []
    for rebec in rebecs:
        position, shown = 0, None
        while (served := stream.get(rebec, position)) is not None and served.now <= time:
            position, shown = position + 1, served
        last.append(shown)
        following.append(served)
        positions.append(position)
    states, is_whole = _reachable(graph, most)
    configs = []
    for state in states:
        if _fits(graph, state, last, following, time):
            configs.append(Config(graph.node(state), tuple(positions)))
    return Start(tuple(configs), time, True, is_whole)


def _fits(
    graph: Graph, state: State, last: list[Served | None], following: list[Served | None], time: int
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


def _reachable(graph: Graph, most: int) -> tuple[list[State], bool]:
    """The reachable states in which time passes next, or nothing; and whether these are all."""
    view = graph.view
    begun = [s.result for s in view.initial_states()]
    work = deque(s for s in begun if not isinstance(s, Failure))
    seen: set[State] = set(work)
    found: list[State] = []
    while work:
        state = work.popleft()
        try:
            steps = view.steps(state)
        except EndlessBody:
            return found, False
        if all(step.action.actor < 0 for step in steps):
            found.append(state)
        for step in steps:
            if not isinstance(step.result, Failure) and step.result not in seen:
                if len(seen) >= most:
                    return found, False
                seen.add(step.result)
                work.append(step.result)
    return found, True
