"""A small state space as people read it, and its simpler forms: DOT and JSON."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from rebsync.checker.show import words
from rebsync.checker.show.data import Json, rebec_json
from rebsync.checker.trace import ShownRebec
from rebsync.records import dataclass
from rebsync.terminal import json_text, printable


@dataclass(frozen=True, slots=True)
class SpaceEdge:
    """A step from a state; `time` passes with it. A failed step has a `failure` and no target.

    `rebec` takes `server` from `sender`, or goes on with it (`resumes`); all are empty when only
    time passes.
    """

    source: int
    target: int | None
    label: str
    time: int = 0
    failure: str | None = None
    rebec: str = ""
    server: str = ""
    sender: str = ""
    resumes: bool = False


@dataclass(frozen=True, slots=True)
class StateSpace:
    """All states of a model, by number, with times that count from the present moment.

    States and edges may be made when they are asked for: a large space is gone through once.
    `marks` are states with what is wrong in them; `holds` has for each state the properties that
    hold in it, or is empty.
    """

    model: str
    semantics: str
    states: Sequence[tuple[ShownRebec, ...]]
    edges: Iterable[SpaceEdge]
    initial: tuple[int, ...]
    marks: tuple[tuple[int, str], ...] = ()
    holds: tuple[tuple[str, ...], ...] = ()


def levels(space: StateSpace) -> tuple[list[int], list[int | None]]:
    """For each state its distance from the initial ones, and the state before it on a way there.

    A state that nothing leads to has level 0.
    """
    following: list[list[int]] = [[] for _ in space.states]
    for edge in space.edges:
        if edge.target is not None:
            following[edge.source].append(edge.target)
    depth = [0] * len(space.states)
    before: list[int | None] = [None] * len(space.states)
    seen = set(space.initial)
    waiting = list(space.initial)
    for state in waiting:
        for target in following[state]:
            if target not in seen:
                seen.add(target)
                depth[target], before[target] = depth[state] + 1, state
                waiting.append(target)
    return depth, before


def edge_label(edge: SpaceEdge) -> str:
    """The label of an edge with the time that passes."""
    return f"{edge.label} +{edge.time}" if edge.time and edge.rebec else edge.label


def state_lines(rebecs: tuple[ShownRebec, ...]) -> list[str]:
    """All of a state: variables, what rebecs do, their bags."""
    lines = []
    for rebec in rebecs:
        lines.append(words.values(rebec))
        if doing := words.doing(rebec):
            lines.append(f"  {doing}")
        lines += [f"  {words.waiting(message)}" for message in rebec.bag]
    return lines


# --- DOT ---------------------------------------------------------------------------------------


def space_dot(space: StateSpace) -> str:
    """The state space in the language of Graphviz."""
    return "".join(space_dot_pieces(space))


def space_dot_pieces(space: StateSpace) -> Iterator[str]:
    """The same, line by line."""
    return (f"{line}\n" for line in _dot(space))


def _dot(space: StateSpace) -> Iterator[str]:
    wrong = dict(space.marks)
    yield f"digraph {_quoted(space.model)} {{"
    yield '  node [shape=box, style=rounded, fontname="monospace", fontsize=10];'
    yield '  edge [fontname="monospace", fontsize=9];'
    yield '  start [shape=point, label=""];'
    for number, rebecs in enumerate(space.states):
        lines = [str(number), *state_lines(rebecs)]
        colour = ", color=red, penwidth=2" if number in wrong else ""
        if number in wrong:
            lines.append(wrong[number])
        yield f"  s{number} [label={_quoted(*lines)}{colour}];"
    for number in space.initial:
        yield f"  start -> s{number};"
    for place, edge in enumerate(space.edges):
        target = f"s{edge.target}"
        if edge.target is None:
            target = f"f{place}"
            said = _quoted(edge.failure or "failure")
            yield f"  {target} [shape=octagon, color=red, label={said}];"
        style = "" if edge.rebec else ", style=dashed"
        yield f"  s{edge.source} -> {target} [label={_quoted(edge_label(edge))}{style}];"
    yield "}"


def _quoted(*lines: str) -> str:
    """Lines as a string of DOT; several are aligned on the left."""
    escaped = [printable(line).replace("\\", "\\\\").replace('"', '\\"') for line in lines]
    return (
        f'"{escaped[0]}"' if len(escaped) == 1 else '"' + "".join(f"{e}\\l" for e in escaped) + '"'
    )


# --- JSON --------------------------------------------------------------------------------------


def space_json(space: StateSpace) -> str:
    """The state space as one object; times count from the moment of each state."""
    return "".join(space_json_pieces(space))


def space_json_pieces(space: StateSpace) -> Iterator[str]:
    """The same, a state or an edge at a time, each on a line."""
    head = {"model": space.model, "semantics": space.semantics, "initial": list(space.initial)}
    for name, value in head.items():
        yield f"{'{' if name == 'model' else ','}\n  {json_text(name)}: {json_text(value)}"
    yield ',\n  "states": ['
    yield from _lines(_states(space))
    yield '],\n  "edges": ['
    yield from _lines(map(_edge, space.edges))
    yield "]\n}\n"


def _lines(values: Iterable[Json]) -> Iterator[str]:
    for number, value in enumerate(values):
        yield f"{',' if number else ''}\n    {json_text(value)}"
    yield "\n  "


def _states(space: StateSpace) -> Iterator[Json]:
    wrong: dict[int, list[str]] = {}
    for number, what in space.marks:
        wrong.setdefault(number, []).append(what)
    for number, rebecs in enumerate(space.states):
        yield {
            "number": number,
            "rebecs": [rebec_json(rebec) for rebec in rebecs],
            "holds": list(space.holds[number]) if space.holds else [],
            "wrong": wrong.get(number, []),
        }


def _edge(edge: SpaceEdge) -> Json:
    return {
        "source": edge.source,
        "target": edge.target,
        "label": edge.label,
        "time": edge.time,
        "failure": edge.failure,
    }
