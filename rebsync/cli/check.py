"""`rebsync check`: have model and code drifted apart?"""

from __future__ import annotations

import sys
from dataclasses import field, replace
from typing import TYPE_CHECKING, Any

import click

from rebsync.cli.amounts import amount, duration
from rebsync.cli.options import names_option
from rebsync.cli.status import STATUS_OF, Status, status_of, worst
from rebsync.diagnostics import RebsyncError
from rebsync.records import dataclass
from rebsync.roundtrip.package.discovery import find
from rebsync.roundtrip.package.managed import ManagedPackage
from rebsync.roundtrip.verdict.check_all import Result, check_all
from rebsync.roundtrip.verdict.outcome import IN_STEP, Outcome, verdict_of
from rebsync.roundtrip.verdict.result import CheckResult
from rebsync.terminal import named, say, say_lines

if TYPE_CHECKING:
    from rebsync.roundtrip.behaviour.proof import Proof

FORMATS = ("text", "json", "sarif", "github", "junit")
_FEW = 5000  # states of each side, within which --behaviour is to answer


@click.command("check")
@click.argument("paths", metavar="[PATH...]", nargs=-1)
@click.option("--model", metavar="FILE", help="The model, where it is not found by itself.")
@click.option(
    "--depth",
    type=click.Choice(["identical", "equal"]),
    default="equal",
    show_default=True,
    help="What counts as a difference; equal: not names of locals, order, parentheses.",
)
@click.option("--verify", is_flag=True, help="Check the model that the code extracts to as well.")
@click.option("--property", "property_file", metavar="FILE", help="The properties for --verify.")
@names_option
@click.option(
    "--allow",
    type=click.Choice(["deadlock"]),
    multiple=True,
    help="What is no mistake to --verify: systems that are meant to end.",
)
@click.option("--behaviour", is_flag=True, help="Tell whether what differs does the same.")
@click.option("--max-states", type=click.IntRange(1), metavar="N", help="Stop at N states.")
@click.option("--max-time", callback=duration, metavar="TIME", help="Stop after 90, 90s, 5m or 1h.")
@click.option("--memory", callback=amount, metavar="SIZE", help="Stop at 500M or 2G of memory.")
@click.option("--full", is_flag=True, help="Show all steps of long runs.")
@click.option(
    "--format",
    "style",
    type=click.Choice(FORMATS),
    default="text",
    show_default=True,
    help="How to print what was found.",
)
@click.option("-o", "--output", default="-", metavar="FILE", help="Write the result to FILE.")
@click.pass_context
def command(ctx: click.Context, /, paths: tuple[str, ...], style: str, **_: object) -> Status:
    """Tell whether packages and the models that they were made from are in step.

    PATH is a package, a directory with several, a file in a package, or a model; the current
    directory if none is given. Exit status: 0 in step, 1 not in step, 2 something cannot be read,
    3 a property is violated, 4 undetermined.
    """
    given = ctx.params
    if given["names"] and not given["verify"]:
        raise click.UsageError("--property-name picks properties for --verify")
    packages = list(find(paths or (".",), given["model"]))
    told = _Told(style, given["output"], given["full"])
    every = zip(packages, check_all(packages, given["depth"]), strict=True)
    found = [told.tell(_outcome(package, result, given)) for package, result in every]
    return worst([*found, told.finish()])


def _outcome(package: ManagedPackage, checked: Result, given: dict[str, Any]) -> Outcome:
    if not isinstance(checked, CheckResult):
        return Outcome(package.root, None, RebsyncError(checked))
    try:
        proof = _proof(checked, given) if given["verify"] else None
    except RebsyncError as error:
        return Outcome(package.root, None, error)
    except RecursionError:
        why = "something in it nests deeper than rebsync reads"
        return Outcome(package.root, None, RebsyncError.of(package.root, "RS111", why))
    if checked.drift is not None and checked.findings:
        from rebsync.roundtrip.verdict.unparsed import as_far_as_parsed

        checked = as_far_as_parsed(checked)
    checked = _with_refusals(checked)
    is_same = given["behaviour"] and _is_same(checked, given["max_states"])
    return Outcome(package.root, checked, proof=proof, is_same=is_same)


def _with_refusals(checked: CheckResult) -> CheckResult:
    """The same, with why `rebsync sync` would not take what has moved into the model."""
    from rebsync.roundtrip.sync.refusals import cached_refusals

    return replace(checked, findings=(*checked.findings, *cached_refusals(checked)))


def _is_same(checked: CheckResult, most: int | None) -> bool:
    """Whether model and code differ, and are proved to do the same within a bound."""
    is_open = any(d.code not in ("RS944", "RS970") for f in checked.findings for d in f.diagnostics)
    if checked.drift is None or not checked.drift.differences or is_open:
        return False
    from rebsync.roundtrip.behaviour.bisimulation import compare_behaviour
    from rebsync.roundtrip.package.models import read_code, read_model

    code = read_code(checked.package, checked.state).given
    return compare_behaviour(read_model(checked.model), code, most or _FEW).verdict == "same"


def _proof(checked: CheckResult, given: dict[str, Any]) -> Proof:
    from rebsync.checker.exploration import Limits
    from rebsync.checker.problem import Options
    from rebsync.config import settings_beside
    from rebsync.roundtrip.behaviour.proof import prove, unless_edited
    from rebsync.roundtrip.package.models import read_code, read_model

    code = read_code(checked.package, checked.state)
    today = read_model(checked.model)
    limits = Limits(given["max_states"], given["max_time"], given["memory"])
    _, settings = settings_beside(checked.model)
    options = Options(limits=limits, allowed=frozenset({*given["allow"], *settings.allow}))
    proof = prove(code, today, given["property_file"], options, given["names"])
    edited = [d.code for f in checked.findings for d in f.errors]
    edited += [each.code for each in checked.accepted]  # the properties do not go by these
    return unless_edited(proof, edited.count("RS956"))


@dataclass(slots=True)
class _Told:
    """Tells outcomes: text at once, the other forms when all are there."""

    style: str
    output: str
    is_full: bool
    all: list[Outcome] = field(default_factory=list)

    def tell(self, outcome: Outcome) -> Status:
        """Prints it, or keeps it; gives its part of the exit status."""
        if self.style != "text" or self.output != "-":
            self.all.append(outcome)
        elif outcome.is_plain:
            say(f"{named(outcome.root)}: {IN_STEP}")
        else:
            from rebsync.report import print_report
            from rebsync.roundtrip.verdict.report.text import told_lines

            say_lines(told_lines(outcome, is_full=self.is_full))
            print_report(outcome.findings, sys.stdout)
        return _status(outcome)

    def finish(self) -> Status:
        """Prints what was kept."""
        if self.style != "text" or self.output != "-":
            from rebsync.cli.options import write_output
            from rebsync.roundtrip.verdict.report.formats import as_text

            write_output(self.output, as_text(self.all, self.style, is_full=self.is_full))
        return Status.CLEAN


def _status(outcome: Outcome) -> Status:
    if outcome.checked is None:
        return Status.UNUSABLE
    found = [status_of(outcome.checked.findings)]
    if outcome.proof is not None:
        found.append(STATUS_OF[outcome.proof.verdict])
    match verdict_of(outcome):
        case "in step":
            found.append(Status.CLEAN)
        case "undetermined":
            found.append(Status.UNDETERMINED)
        case _:
            found.append(Status.FINDINGS)
    return worst(found)
