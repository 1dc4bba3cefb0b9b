"""`rebsync simulate`: one run of a model, by chance or by hand."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from contextlib import suppress
from itertools import count
from typing import TYPE_CHECKING, Any

import click

from rebsync.cli.options import check_served, names_option, serve_options
from rebsync.cli.problem import keep_what_is_read, measured, read_problem
from rebsync.cli.runs import STYLES, serve_run, write_run
from rebsync.cli.status import Status
from rebsync.cli.verify import view_named, view_options
from rebsync.terminal import say

if TYPE_CHECKING:
    from rebsync.checker.problem import Problem
    from rebsync.checker.simulate import Chooser
    from rebsync.checker.state import State
    from rebsync.checker.steps import Step
    from rebsync.checker.telling import Teller
    from rebsync.checker.trace import TraceStep

_STEPS = 100
_FEWEST = 30  # runs, from which on means are about normally distributed


@click.command("simulate")
@click.argument("model", metavar="MODEL")
@view_options
@names_option
@click.option("--seed", type=int, metavar="N", help="Chance that can be repeated.")
@click.option("--until", type=click.IntRange(0), metavar="T", help="End at the time T.")
@click.option(
    "--steps", type=click.IntRange(0), metavar="N", help=f"End after N steps (default: {_STEPS})."
)
@click.option(
    "--runs",
    type=click.IntRange(_FEWEST, 10_000_000),
    metavar="N",
    help=f"Make N runs, at least {_FEWEST}, and tell how they end.",
)
@click.option(
    "--measure",
    "measures",
    multiple=True,
    metavar="EXPR",
    help="With --runs: tell how the values of an expression are distributed.",
)
@click.option("--interactive", is_flag=True, help="Choose each step yourself.")
@click.option(
    "--format",
    "style",
    type=click.Choice(STYLES),
    default="text",
    show_default=True,
    help="svg: a message sequence chart. html: a page with chart, states and source.",
)
@click.option("-o", "--output", default="-", metavar="FILE", help="Write the run to FILE.")
@serve_options
@click.pass_context
def command(ctx: click.Context, /, model: str, output: str, **_: object) -> Status:
    """Make one run of a model, by chance or by hand.

    Without --seed every run is another one; the seed is told on standard error. With --serve each
    step is chosen in the browser, from the start, or after a run by chance with --seed. Exit
    status: 3 if the run (or one of them) ends in a step that fails, 4 if in a body that does not
    end, else 0.
    """
    from rebsync.checker.choosing import semantics_for
    from rebsync.checker.endless import EndlessBody, endless_reason
    from rebsync.checker.lowering import lower
    from rebsync.checker.simulate import by_chance, run
    from rebsync.checker.telling import Teller
    from rebsync.checker.trace import Trace
    from rebsync.checker.views import view_of

    given = ctx.params
    if given["interactive"] and given["seed"] is not None:
        raise click.UsageError("--interactive and --seed exclude each other")
    check_served(given, output)
    if given["serve"] and (given["interactive"] or given["runs"] or given["measures"]):
        raise click.UsageError("--serve shows one run: leave --interactive and --runs out")
    problem = read_problem(model, given["property_file"], untimed=given["language"] == "core")
    problem = problem.named(given["names"])
    keep_what_is_read(problem, output)
    if given["runs"] or given["measures"]:
        return _many(measured(problem, given["measures"]), given, output)
    program, _formulas = lower(problem.analysis, problem.properties)
    semantics = view_named(given) or semantics_for(program, problem)
    teller = Teller(view_of(program, semantics), problem.source)
    until, steps, seed = given["until"], given["steps"], given["seed"]
    if steps is None and until is None:
        steps = 0 if given["serve"] and seed is None else _STEPS
    if seed is None and steps == 0:
        seed = 0  # nothing is left to chance but where the run starts
    choose = _by_hand(teller) if given["interactive"] else by_chance(_seed(seed))
    told: list[TraceStep] = []
    reason = None
    try:
        for step in run(teller, choose, until=until, steps=steps):
            told.append(step)
    except EndlessBody as endless:
        reason = endless_reason(program, endless.cut, problem.source)
    if told and not (given["interactive"] and _told_already(given["style"], output)):
        trace = Trace(problem.source.path, semantics, tuple(told))
        if given["serve"]:
            serve_run(trace, problem, given["port"])
        else:
            write_run(trace, problem, given["style"], output)
    if reason is not None:
        say(f"the run ends here: {reason}", err=True)
        return Status.UNDETERMINED
    return Status.VIOLATED if told and told[-1].failure else Status.CLEAN


def _many(problem: Problem, given: dict[str, Any], output: str) -> Status:
    """Many runs by chance: what is told of them is a distribution."""
    from rebsync.checker.choosing import semantics_for
    from rebsync.checker.lowering import lower
    from rebsync.checker.sampling import samples
    from rebsync.cli.estimates import write_estimates

    if not given["runs"] or given["interactive"]:
        raise click.UsageError("--measure is of many runs by chance: --runs N")
    if given["style"] not in ("text", "json"):
        raise click.UsageError("--runs prints a distribution: --format text or json")
    program, _ = lower(problem.analysis, problem.properties, measures=problem.measures)
    semantics = view_named(given) or semantics_for(program, problem)
    seed, until, steps = _seed(given["seed"]), given["until"], given["steps"]
    if steps is None and until is None:
        steps = _STEPS
    made = tuple(samples(program, semantics, seed, given["runs"], until=until, steps=steps))
    return write_estimates(problem, semantics, seed, made, given["style"], output)


def _seed(given: int | None) -> int:
    if given is not None:
        return given
    from random import SystemRandom

    seed = SystemRandom().randrange(1_000_000)
    say(f"seed {seed}", err=True)
    return seed


def _by_hand(teller: Teller) -> Chooser:
    """Asks on the terminal, unless there is only one step, and tells what the step does."""
    from rebsync.checker.show.pieces import print_lines
    from rebsync.checker.show.text import step_lines
    from rebsync.checker.show.words import option

    numbers = count()

    def choose(time: int, state: State, steps: Sequence[Step]) -> int | None:
        number = next(numbers)
        told = [teller.step(number, time, state, step) for step in steps]
        picked = _asked(time, [option(step) for step in told]) if len(told) > 1 else 0
        if picked is not None:
            print_lines(step_lines(told[picked], teller.source.path), sys.stderr)
        return picked

    return choose


def _told_already(style: str, output: str) -> bool:
    """Whether a run that was made by hand would be shown to the same eyes a second time."""
    return style == "text" and output == "-" and sys.stdout.isatty() and sys.stderr.isatty()


def _asked(time: int, options: Sequence[str]) -> int | None:
    """The number of the option that is picked; None after an empty line, q, or the last line."""
    numbers = [str(number) for number in range(1, len(options) + 1)]
    for number, option in zip(numbers, options, strict=True):
        say(f"  {number}) {option}", err=True)
    while True:
        say(f"at {time}, 1 to {len(options)}, q to end: ", err=True, end="")
        answer = _line()
        if answer in ("", "q"):
            return None
        if answer in numbers:
            return numbers.index(answer)


def _line() -> str:
    """The next line of standard input; nothing when it has ended, or is closed."""
    if sys.stdin is None:
        return ""
    with suppress(AttributeError, ValueError):
        sys.stdin.reconfigure(errors="backslashreplace")  # type: ignore[union-attr]
    return sys.stdin.readline().strip()
