"""One run in a page: its controls, its chart, its states, its plots, how its robots move."""

from __future__ import annotations

from dataclasses import replace

from rebsync.checker.branching import Branches, Branchings, unbranched
from rebsync.checker.falsified import Falsified, unasserted
from rebsync.checker.movement.ways import Movement, Moving, nowhere
from rebsync.checker.result import Violation
from rebsync.checker.show import words
from rebsync.checker.show.branches import branches_data
from rebsync.checker.show.chart import chart_inside
from rebsync.checker.show.markup import Markup, element
from rebsync.checker.show.movement import movement_controls, movement_section
from rebsync.checker.show.movement_data import frames
from rebsync.checker.show.page_states import states_table
from rebsync.checker.show.playback import playback_controls
from rebsync.checker.show.plots import plots_section
from rebsync.checker.trace import Trace
from rebsync.records import dataclass
from rebsync.source import Source

FOLLOWED = 0  # the number of the run that somebody follows; those of the page count from 1


@dataclass(frozen=True, slots=True)
class RunDetails:
    """What a page shows of a run besides its steps: how robots move, and what else could happen.

    `falsified` tells the assertions that are false in the states of a run. `live` is the address by
    which other steps are followed; None in a page that stands alone. `start` is the run from which
    they are followed in a page that has no other.
    """

    moving: Moving = nowhere
    branches: Branches = unbranched
    falsified: Falsified = unasserted
    live: str | None = None
    start: Trace | None = None


@dataclass(frozen=True, slots=True)
class Shown:
    """A run of the page: its heading, the place that the heading is about, what is wrong.

    `movement` is that of its robots, if the model moves any; `branchings` is what else could
    happen, if that is known.
    """

    heading: str
    trace: Trace
    movement: Movement | None
    branchings: Branchings
    falsified: tuple[tuple[str, ...], ...] = ()  # of each step; of a violation, its message says it
    message: str = ""
    place: str | None = None  # the target of a link in the page
    ending: str | None = None


def shown_run(heading: str, trace: Trace, details: RunDetails) -> Shown:
    """A run in which nothing is wrong but what its steps say."""
    return Shown(
        heading, trace, details.moving(trace), details.branches(trace), details.falsified(trace)
    )


def shown_violation(
    violation: Violation, source: Source, properties: Source | None, details: RunDetails
) -> Shown:
    """The run to a violation."""
    trace = violation.trace
    failed = any(step.failure is not None for step in trace.steps)
    ending = None if failed or trace.loop is not None else violation.message
    place = None
    if violation.line and violation.path == source.path:
        place = f"L{violation.line}"
    elif violation.line and properties is not None and violation.path == properties.path:
        place = f"P{violation.line}"
    message = violation.message + (f": {violation.formula}" if violation.formula else "")
    found = details.moving(trace), details.branches(trace)
    return Shown(words.title(violation), trace, *found, message=message, place=place, ending=ending)


def followed_run(trace: Trace, details: RunDetails) -> str:
    """The section of a run that somebody follows in a live page; it is the last of its page."""
    heading = f"What if: a run of {words.counted(len(trace.steps), 'step')}"
    run = shown_run(heading, trace, details)
    if run.branchings[-1].is_end and trace.steps[-1].failure is None:
        run = replace(run, ending="nothing can happen after this: a deadlock")
    return run_section(run, FOLLOWED)


def run_section(run: Shown, number: int) -> Markup:
    """The section of a run, the one of this number in its page."""
    name = f"v{number}"
    about = [": ", run.message] if run.message else []
    if run.place is not None:
        said = f"line {run.place[1:]} of the {'model' if run.place[0] == 'L' else 'properties'}"
        about += [" (", element("a", said, href=f"#{run.place}"), ")"]
    upper = [plots_section(run.trace)]
    if run.movement is not None:
        upper.insert(0, movement_section(run.movement, frames(run.trace), name))
    return element(
        "section",
        element("h2", run.heading, *about),
        _controls(run, name),
        element("div", *upper, class_="upper"),
        element("div", _chart(run, name), _states(run, name), class_="panes"),
        branches_data(run.branchings) if run.branchings else None,
        class_="run",
        id=name,
        data_run=str(number),
    )


def _chart(run: Shown, name: str) -> Markup:
    drawn = chart_inside(run.trace, run.ending, f"{name}-chart")
    return element(
        "div", drawn, class_="pane chart view-chart", tabindex="0", aria_label="Chart", role="group"
    )


def _states(run: Shown, name: str) -> Markup:
    table = states_table(run.trace, name, run.ending, run.falsified)
    return element(
        "div", table, class_="pane view-states", tabindex="0", aria_label="States", role="group"
    )


def _controls(run: Shown, name: str) -> Markup:
    if run.movement is not None:
        return movement_controls(run.movement, frames(run.trace), name)
    steps = [(step.number, step.time) for step in run.trace.steps]
    return playback_controls(name, steps, steps[0][1], steps[-1][1])
