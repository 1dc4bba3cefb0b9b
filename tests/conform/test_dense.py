"""Formulas in real time against runs drawn by chance that may have been recorded so.

Stamps and bounds are quarters of a second, so that eighths show all that a run has.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import inf
from random import Random

import pytest

from rebsync.checker.formulas import And, Atom, Formula, Not, Or, Temporal, Timed
from rebsync.conform.components.dense import DenseRun, TopicChanges
from rebsync.conform.components.signals import Signal

P, Q = Atom(0), Atom(1)
FORMULAS: tuple[Formula, ...] = (
    Temporal("G", (Timed("AF", ("<=", 3), (P,)),)),
    Temporal("G", (Or(Not(P), Timed("AF", ("<=", 2), (Q,))),)),
    Temporal("G", (Or(Not(P), Timed("AG", ("<=", 2), (Q,))),)),
    Temporal("G", (Or(Not(P), Timed("AG", (">=", 2), (Or(P, Q),))),)),
    Temporal("G", (Or(P, Not(Timed("AF", ("<=", 2), (Q,)))),)),
    Temporal("F", (And(Not(Q), Timed("AU", ("<=", 2), (P, Q))),)),
    Temporal("G", (Timed("AU", ("<=", 4), (P, Q)),)),
    Temporal("G", (Or(Not(P), Temporal("U", (Not(Q), Timed("AG", ("<=", 1), (P,))))),)),
    Temporal("G", (Temporal("W", (P, Q)),)),
    Temporal("F", (Timed("AG", ("<=", 3), (Or(P, Q),)),)),
    Not(Temporal("F", (And(Q, Timed("EF", ("==", 2), (P,))),))),
    And(Temporal("G", (Or(P, Q),)), Timed("AF", ("<=", 2), (P,))),
    Timed("AG", None, (Timed("AF", ("<=", 2), (Timed("AG", ("<=", 1), (Not(P),)),)),)),
)
STEP, SLACK = 0.125, 0.5
World = tuple[list[bool], list[bool]]


def recorded(random: Random) -> DenseRun:
    """Two topics; what the second shows is what somebody got."""
    topics = (TopicChanges(False), TopicChanges(True))
    for topic in topics:
        stamp, value = random.randint(0, 4) / 4, random.randint(0, 1)
        while stamp < 12:
            topic.see(stamp, (value,))
            stamp, value = stamp + random.randint(1, 16) / 4, 1 - value

    def truth(state: Mapping[int, tuple[int, ...]]) -> Mapping[int, bool]:
        return {number: bool(values[0]) for number, values in state.items()}

    return DenseRun(topics, truth, 12.0, SLACK)


def world(run: DenseRun, random: Random) -> World:
    """What may have been from 4 s before the recording to 8 s after it, by eighths of a second."""
    found = []
    for topic in run.topics:
        late = 0.5 if topic.is_got else 0.0
        times = sorted(
            (stamp + random.choice([-SLACK, -0.25, 0.0, late]), n)
            for n, (stamp, _) in enumerate(topic.changes)
        )
        places = [time for time, _ in times]
        changes = [(-inf, random.random() < 0.5)]
        changes += [(-4 + random.randint(0, 14) / 4, random.random() < 0.5) for _ in range(3)]
        changes = [c for c in changes if c[0] < places[0]]
        changes += zip(places, (bool(v[0]) for _, v in topic.changes), strict=True)
        changes += [(12 + random.randint(-1, 24) / 4, random.random() < 0.5) for _ in range(3)]
        changes.sort(key=lambda change: change[0])
        grid = [-4 + n * STEP for n in range(int(24 / STEP))]
        found.append([[v for t, v in changes if t <= time][-1] for time in grid])
    return found[0], found[1]


def values(formula: Formula, of: World) -> list[bool]:
    """A formula in each moment of a run, whose last state stays."""
    count = len(of[0])

    def within(bound: tuple[str, int] | None, at: int) -> range:
        limit = round(bound[1] / STEP) if bound else 0
        match bound[0] if bound else ">=":
            case "<=":
                return range(at, at + limit + 1)
            case "==":
                return range(at + limit, at + limit + 1)
            case _:
                return range(min(at + limit, count - 1), count)

    match formula:
        case Atom(number):
            return of[number]
        case Not(operand):
            return [not value for value in values(operand, of)]
        case And(left, right):
            return [a and b for a, b in zip(values(left, of), values(right, of), strict=True)]
        case Or(left, right):
            return [a or b for a, b in zip(values(left, of), values(right, of), strict=True)]
        case Temporal(name, operands):
            operator, bound = str(name), None
        case Timed(name, bound, operands):
            operator = name[1]
    first, last = values(operands[0], of), values(operands[-1], of)
    found = []
    for at in range(count):
        times = [min(n, count - 1) for n in within(bound, at)]
        match operator:
            case "F":
                found.append(any(last[n] for n in times))
            case "G":
                found.append(all(last[n] for n in times))
            case _:
                stop = next((n for n in range(at, count) if not first[n]), count)
                until = any(last[n] for n in times if n <= stop)
                found.append(until or (operator == "W" and stop == count))
    return found


@pytest.mark.parametrize("number", range(len(FORMULAS)))
def test_verdicts_are_those_of_all_runs(number: int) -> None:
    formula, said = FORMULAS[number], set()
    for seed in range(8):
        random = Random(seed)
        run = recorded(random)
        found = run.evaluated(formula, 0.0, 1.0, 0.001)
        said.add(found.verdict)
        if found.verdict in ("violated", "satisfied"):
            for _ in range(6):
                drawn = world(run, random)
                expected = found.verdict == "satisfied"
                assert values(formula, drawn)[0] == expected, (seed, found, drawn)
    assert said & {"violated", "satisfied"}


def test_until_looks_no_further_than_its_bound() -> None:
    reached = Signal(((8, 9),), ((-inf, 8), (9, inf)))
    holds = Signal(((0, 10),), ((-inf, 0), (10, inf)))
    found = reached.until(holds, 3)
    assert found == Signal(((5, 9),), ((-inf, 5), (9, inf)))
