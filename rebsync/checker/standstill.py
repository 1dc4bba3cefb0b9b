"""Zeno behaviour: time that cannot advance, and cycles in which it stands still.

A state is Zeno when a run goes on from it for ever in one moment, and no step can be reached in
which time passes, nor a deadlock.
"""

from __future__ import annotations

from array import array

from rebsync.checker.graph import Graph
from rebsync.checker.program import Program

ENDLESS, LEAVES = 1, 2  # as in templates/standstill.h


def may_stand_still(program: Program) -> bool:
    """Whether servers can call for each other in a circle without a delay or an `after`.

    Where this is False no run takes infinitely many steps in one moment, so the search of the
    state space for such runs is not needed.
    """
    if _may_wait_in_place(program):
        return True
    follows = [
        {
            rebec.dispatch[selector]
            for selector in _at_once(program, server.body, set())
            for rebec in program.rebecs
            if rebec.dispatch[selector] >= 0
        }
        for server in program.servers
    ]
    return _has_cycle(follows)


def _may_wait_in_place(program: Program) -> bool:
    """Whether a body could be split again and again by delays of 0."""
    delays = any(i.op == "DELAY" and not i.constants for i in program.code)
    return delays and any(
        i.op == "CALL" or (i.op == "JUMP" and i.a <= pc) for pc, i in enumerate(program.code)
    )


def _at_once(program: Program, body: int, seen: set[int]) -> set[int]:
    """Selectors to which a body can send at the moment in which it starts."""
    if body in seen:
        return set()
    seen.add(body)
    found: set[int] = set()
    waiting, visited = [program.bodies[body].entry], set[int]()
    while waiting:
        pc = waiting.pop()
        if pc in visited:
            continue
        visited.add(pc)
        instruction = program.code[pc]
        match instruction.op:
            case "JUMP":
                waiting.append(instruction.a)
                continue
            case "JUMPF" | "JUMPT":
                waiting.append(instruction.a)
            case "RET":
                continue
            case "DELAY" if instruction.constants:
                continue
            case "CALL":
                found |= _at_once(program, instruction.a, seen)
            case "SEND" | "SENDBY" if not instruction.constants[0]:
                found.add(instruction.a)
        waiting.append(pc + 1)
    return found


def _has_cycle(follows: list[set[int]]) -> bool:
    """Whether a graph has a cycle: nodes without successors are taken away until none is left."""
    left = {node: set(targets) for node, targets in enumerate(follows)}
    while True:
        ends = {node for node, targets in left.items() if not targets}
        if not ends:
            return bool(left)
        left = {n: targets - ends for n, targets in left.items() if n not in ends}


# --- in the state space ------------------------------------------------------------------------


def marks_of(graph: Graph) -> bytearray:
    """For each state ENDLESS if a run without time goes on for ever from it, LEAVES if it can end.

    It ends by a step of time, by a deadlock, or where the search has not been.
    """
    count = len(graph)
    marks = bytearray(count)
    ahead = array("l", bytes(8 * count))  # steps without time to states that may go on for ever
    before: dict[int, list[int]] = {}
    for state in range(count):
        edges = range(graph.first[state], graph.first[state + 1])
        marks[state] = LEAVES * (not edges or any(graph.time[e] > 0 for e in edges))
        for edge in edges:
            if _stays(graph, edge):
                before.setdefault(graph.target[edge], []).append(state)
                ahead[state] += 1
    _spread(marks, before)
    _peel(ahead, before)
    for state in range(count):
        marks[state] |= ENDLESS * (ahead[state] > 0)
    return marks


def _stays(graph: Graph, edge: int) -> bool:
    return graph.target[edge] >= 0 and graph.time[edge] == 0


def _spread(marks: bytearray, before: dict[int, list[int]]) -> None:
    """Marks every state from which a marked one can be reached in no time."""
    waiting = [state for state, marked in enumerate(marks) if marked]
    while waiting:
        for state in before.get(waiting.pop(), ()):
            if not marks[state]:
                marks[state] = LEAVES
                waiting.append(state)


def _peel(ahead: array[int], before: dict[int, list[int]]) -> None:
    """Takes away what leads to no cycle: `ahead` stays above 0 on endless runs only."""
    ends = [state for state, count in enumerate(ahead) if not count]
    while ends:
        for state in before.get(ends.pop(), ()):
            ahead[state] -= 1
            if not ahead[state]:
                ends.append(state)


def cycle_from(graph: Graph, marks: bytearray) -> tuple[int, tuple[int, ...], tuple[int, ...]]:
    """The first Zeno state, ordinals from there into a cycle, and those of the cycle."""
    start = state = marks.index(ENDLESS)
    seen: dict[int, int] = {}
    ordinals: list[int] = []
    while state not in seen:
        seen[state] = len(ordinals)
        edges = range(graph.first[state], graph.first[state + 1])
        edge = next(e for e in edges if _stays(graph, e) and marks[graph.target[e]] == ENDLESS)
        ordinals.append(edge - graph.first[state])
        state = graph.target[edge]
    return start, tuple(ordinals[: seen[state]]), tuple(ordinals[seen[state] :])
