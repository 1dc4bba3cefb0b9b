"""Faults put into recordings: what networks, nodes and people do to runs, one at a time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from random import Random

from rebsync.conform.recording import Place, Served

Fault = Callable[[Sequence[Served], int], list[Served]]
"""Makes a recording with the fault at the step of that number."""


def dropped(run: Sequence[Served], at: int) -> list[Served]:
    """The state message of a step is not recorded."""
    return _numbered([*run[:at], *run[at + 1 :]])


def late(run: Sequence[Served], at: int, by: int = 1) -> list[Served]:
    """A rebec serves a message later than it has to; so does it end later."""
    step = run[at]
    return _numbered(
        [*run[:at], step._replace(start=step.start + by, now=step.now + by), *run[at + 1 :]]
    )


def longer(run: Sequence[Served], at: int) -> list[Served]:
    """A body takes longer."""
    return _numbered([*run[:at], run[at]._replace(now=run[at].now + 1), *run[at + 1 :]])


def wrong_state(run: Sequence[Served], at: int, variable: int = 0) -> list[Served]:
    """A state variable has another value after a step."""
    step = run[at]
    cells = list(step.cells)
    place = variable % len(cells)
    # Of a floating number a bit that is more than libraries of mathematics leave open.
    cells[place] += 1 if abs(cells[place]) < 2**31 else 2**40
    return _numbered([*run[:at], step._replace(cells=tuple(cells)), *run[at + 1 :]])


def wrong_server(run: Sequence[Served], at: int) -> list[Served]:
    """A step serves another message."""
    step = run[at]
    return _numbered([*run[:at], step._replace(server=f"{step.server}x"), *run[at + 1 :]])


def wrong_arguments(run: Sequence[Served], at: int) -> list[Served]:
    """A step serves a message with other arguments."""
    step = run[at]
    arguments = f"{step.arguments}, 1" if step.arguments else "1"
    return _numbered([*run[:at], step._replace(arguments=arguments), *run[at + 1 :]])


def wrong_arrival(run: Sequence[Served], at: int) -> list[Served]:
    """A step serves a message that arrived before."""
    return _numbered([*run[:at], run[at]._replace(arrival=run[at].arrival - 1), *run[at + 1 :]])


def swapped(run: Sequence[Served], at: int) -> list[Served]:
    """A rebec serves its next two messages in the other order: each is said with its own times."""
    step = run[at]
    other = next((i for i in range(at + 1, len(run)) if run[i].rebec == step.rebec), None)
    if other is None:
        return _numbered(run)
    found = list(run)
    found[at], found[other] = run[other], step
    return _numbered(found)


def repeated(run: Sequence[Served], at: int) -> list[Served]:
    """A state message is recorded twice."""
    return _numbered([*run[: at + 1], run[at], *run[at + 1 :]])


def second_publisher(run: Sequence[Served], at: int) -> list[Served]:
    """A second node of the same name begins, and publishes its constructor's state."""
    first = next(s for s in run if s.rebec == run[at].rebec)
    return _numbered(
        [*run[: at + 1], first._replace(stamp=run[at].stamp, publisher="/other"), *run[at + 1 :]]
    )


FAULTS: dict[str, Fault] = {
    "dropped": dropped,
    "late": late,
    "longer": longer,
    "wrong state": wrong_state,
    "wrong server": wrong_server,
    "wrong arguments": wrong_arguments,
    "wrong arrival": wrong_arrival,
    "swapped": swapped,
    "repeated": repeated,
    "second publisher": second_publisher,
}


def some(run: Sequence[Served], random: Random) -> tuple[str, int, list[Served]]:
    """A fault by chance, where it is, and the recording with it."""
    name = random.choice(sorted(FAULTS))
    at = random.randrange(len(run))
    if not run[at].cells and name == "wrong state":
        name = "dropped"
    return name, at, FAULTS[name](run, at)


def _numbered(run: Sequence[Served]) -> list[Served]:
    """The steps with the numbers of their new places."""
    return [step._replace(place=Place(0, number)) for number, step in enumerate(run)]
