"""`rebsync verify`: check everything that can go wrong in a model, and its properties."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click

from rebsync.cli.amounts import amount, duration
from rebsync.cli.options import check_served, names_option, serve_options
from rebsync.cli.problem import keep_what_is_read, measured, read_problem
from rebsync.cli.status import STATUS_OF, Status, worst
from rebsync.cli.verify_output import write_result
from rebsync.diagnostics import RebsyncError

if TYPE_CHECKING:
    from rebsync.checker.problem import Options, Problem
    from rebsync.checker.result import Result
    from rebsync.checker.steps import Semantics

FORMATS = ("text", "json", "svg", "html")
_SHOW_STATES = ("states", "export")  # options that show all states
MOST_INSTRUCTIONS = 10**10  # their delays together stay within 64 bits


def view_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """The options that say which system is meant, and how it is seen."""
    for option in reversed(
        (
            click.option(
                "--property",
                "property_file",
                metavar="FILE",
                help="The properties (default: the .property file beside the model).",
            ),
            click.option(
                "--language",
                type=click.Choice(["timed", "core"]),
                default="timed",
                show_default=True,
                help="core: no time, first in first out.",
            ),
            click.option(
                "--semantics",
                type=click.Choice(["auto", "tts", "ftts"]),
                default="auto",
                show_default=True,
                help="tts: exact, one clock. ftts: floating time, fewer states.",
            ),
        )
    ):
        command = option(command)
    return command


@click.command("verify")
@click.argument("model", metavar="MODEL|PACKAGE")
@view_options
@click.option(
    "--environment",
    metavar="free|none|FILE",
    help="Of a package: what comes from outside: anything (the default), nothing, or what the "
    "classes of FILE send.",
)
@names_option
@click.option("--model", "written", metavar="FILE", help="Of a package: write its model to FILE.")
@click.option(
    "--engine",
    type=click.Choice(["auto", "interpreted", "compiled"]),
    default="auto",
    show_default=True,
    help="What searches; auto compiles large searches.",
)
@click.option(
    "--allow",
    type=click.Choice(["deadlock"]),
    multiple=True,
    help="What is no mistake here: systems that are meant to end.",
)
@click.option(
    "--fairness",
    type=click.Choice(["none", "weak", "progress"]),
    default="none",
    show_default=True,
    help="Which runs LTL is about.",
)
@click.option(
    "--stop-at",
    type=click.Choice(["first"]),
    help="End the search at the first violation (default on a terminal).",
)
@click.option("--all", "everything", is_flag=True, help="Look for all violations.")
@click.option("--max-states", type=click.IntRange(1), metavar="N", help="Stop at N states.")
@click.option("--max-time", callback=duration, metavar="TIME", help="Stop after 90, 90s, 5m or 1h.")
@click.option("--memory", callback=amount, metavar="SIZE", help="Stop at 500M or 2G of memory.")
@click.option("--until", type=click.IntRange(0), metavar="T", help="Look at times up to T only.")
@click.option(
    "--max-instructions",
    type=click.IntRange(1, MOST_INSTRUCTIONS),
    metavar="N",
    help="Give a body up after N instructions (default: 1,000,000,000).",
)
@click.option(
    "--hash-compaction",
    is_flag=True,
    help="Keep 64 bits for each state: less memory, and a small risk of missing states.",
)
@click.option(
    "--threads",
    type=click.IntRange(1, 2),
    default=1,
    metavar="1|2",
    help="With 2 one thread makes steps, and another stores what they lead to.",
)
@click.option(
    "--reduce/--no-reduce",
    default=None,
    help="Leave out orders of steps that cannot matter to the verdict, or nothing at all (default: "
    "what pays).",
)
@click.option(
    "--symmetry", is_flag=True, help="Count states that differ by an exchange of equal rebecs once."
)
@click.option(
    "--cluster",
    metavar="ADDRESS|local",
    help="Search with a cluster of Ray: at an address, or started on this machine.",
)
@click.option(
    "--workers",
    type=click.IntRange(1),
    metavar="N",
    help="Of a cluster: how many share the search (default: one for each processor).",
)
@click.option(
    "--format",
    "style",
    type=click.Choice(FORMATS),
    default="text",
    show_default=True,
    help="svg: the chart of one run. html: a page with chart, states and source.",
)
@click.option("-o", "--output", default="-", metavar="FILE", help="Write the result to FILE.")
@serve_options
@click.option(
    "--replay", metavar="FILE", help="Run a recorded run again: JSON of an earlier result."
)
@click.option("--violation", metavar="NAME", help="Which run to replay or to draw.")
@click.option(
    "--measure",
    "measures",
    multiple=True,
    metavar="EXPR",
    help="Tell the least and greatest value of an expression.",
)
@click.option(
    "--time-between",
    "between",
    nargs=2,
    multiple=True,
    metavar="P Q",
    help="Tell the least and greatest time from when P becomes true until Q holds.",
)
@click.option(
    "--for-all",
    "swept",
    multiple=True,
    metavar="env.NAME=VALUES",
    help="Verify once for each of 5..20 or 1,2,5 as value of a constant.",
)
@click.option(
    "--monotone",
    is_flag=True,
    help="Of --for-all: no property changes its verdict twice; search by bisection.",
)
@click.option("--full", is_flag=True, help="Show all steps of all runs.")
@click.option("--states", metavar="FILE", help="Draw the state space: .dot, .svg or .json.")
@click.option(
    "--export",
    type=click.Choice(["rmc-xml"]),
    help="Print the state space in RMC's format, and nothing else.",
)
@click.pass_context
def command(ctx: click.Context, /, model: str, output: str, **_: object) -> Status:
    """Check everything that can go wrong in a model, and its properties.

    Of a package its code is read, with an environment that sends what nobody in it does. Another
    directory stands for all models below it; with --environment it is read as a package.
    Always checked: deadlock, missed deadlines, full bags, assertions, array indices, division by
    zero, messages to null, time that cannot advance. Exit status: 0 satisfied, 3 violated,
    4 undetermined.
    """
    from rebsync.cli.paths import models_in
    from rebsync.cli.spaces import check_name

    given = ctx.params
    check_name(given["states"], output)
    check_served(given, output)
    of_code = given["environment"] or given["written"]
    models = [] if of_code else models_in(model)
    if not models:
        return _one(model, given, output)
    if len(models) > 1 and ((given["style"], output) != ("text", "-") or given["serve"]):
        raise click.UsageError(f"{len(models)} models are below {model}: name one of them")
    return worst([_of_several(each, given, output) for each in models])


def _of_several(model: str | RebsyncError, given: dict[str, Any], output: str) -> Status:
    """As `_one`; a mistake is told, and is not in the way of other models."""
    try:
        if isinstance(model, RebsyncError):
            raise model
        return _one(model, given, output)
    except RebsyncError as error:
        from rebsync.report import print_report

        sys.stdout.flush()
        print_report(error.findings, sys.stderr)
        return Status.UNUSABLE


def _one(model: str, given: dict[str, Any], output: str) -> Status:
    """Verifies a model or a package."""
    _check_cluster(given)
    if given["swept"]:
        return _swept(model, given, output)
    if given["monotone"]:
        raise click.UsageError("--monotone is about the values of --for-all")
    if given["replay"] is not None and (given["states"] or given["export"]):
        raise click.UsageError("--replay makes one run: leave --states and --export out")
    if given["serve"] and (given["replay"] is not None or given["export"]):
        raise click.UsageError("--serve shows what was found: leave --replay and --export out")
    if given["symmetry"] and (given["states"] or given["export"]):
        raise click.UsageError("--states and --export write all states: leave --symmetry out")
    problem = _read(model, given).named(given["names"])
    keep_what_is_read(problem, output, given["states"], replayed=given["replay"])
    problem = measured(problem, given["measures"], given["between"])
    if given["replay"] is not None:
        from rebsync.cli.runs import replay_file

        return replay_file(problem, given["replay"], given["violation"], given["style"], output)
    options = _options(given, model)
    if given["export"] or given["states"]:
        from rebsync.cli.spaces import write_space

        exported = output if given["export"] else None
        whole = write_space(problem, options, given["states"], exported)
        if given["export"]:
            return Status.CLEAN if whole else Status.UNDETERMINED
    result = _verified(problem, options)
    if not _is_package(model):
        from rebsync.roundtrip.verdict.property_cache import save_verdicts

        save_verdicts(problem, options, result)
    write_result(result, problem, given, output)
    return STATUS_OF[result.verdict]


def _check_cluster(given: dict[str, Any]) -> None:
    """Refuses what is not for a cluster; what a model asks for, the checker refuses."""
    if given["workers"] and not given["cluster"]:
        raise click.UsageError("--workers are those of a --cluster")
    if given["cluster"] and any(given[name] for name in ("replay", "states", "export", "swept")):
        wrong = "--replay, --states, --export and --for-all"
        raise click.UsageError(f"{wrong} are for one machine: leave --cluster out")


def _swept(model: str, given: dict[str, Any], output: str) -> Status:
    """Verifies once for each combination of values of constants."""
    from rebsync.cli.sweep import parameter, sweep, write_sweep

    parameters = [parameter(text) for text in given["swept"]]
    if _is_package(model) or _is_code(model):
        raise click.UsageError("--for-all is for models: leave it out for packages")
    if given["style"] == "html":
        raise click.UsageError("--for-all has no page: --format text, json or svg")
    if any(given[name] for name in ("replay", "states", "export", "violation", "serve")):
        raise click.UsageError("--for-all prints a table only, without runs and states")
    asked = given["measures"], given["between"]
    problem = measured(_read(model, given).named(given["names"]), *asked)
    keep_what_is_read(problem, output)
    options = _options({**given, "everything": not given["stop_at"]}, model)
    view = {"untimed": given["language"] == "core", "monotone": given["monotone"]}
    rows = sweep(problem, asked, parameters, options, **view)
    return write_sweep(problem.source.path, parameters, rows, given["style"], output)


def _read(model: str, given: dict[str, Any]) -> Problem:
    """The model in a file, or that of the code of a package."""
    if _is_code(model):
        hint = f"name its folder: rebsync verify {Path(model).parent}"
        raise RebsyncError.of(model, "RS802", "this is a file of code, not a model", hint)
    if not _is_package(model):
        for option in ("environment", "written"):
            if given[option]:
                raise click.UsageError("--environment and --model are for packages of code")
        return read_problem(model, given["property_file"], untimed=given["language"] == "core")
    if given["language"] == "core":
        raise click.UsageError("--language core is for models: code has time")
    from rebsync.cli.packages import read_package

    environment = given["environment"] or "free"
    return read_package(model, given["property_file"], environment, given["written"])


def _options(given: dict[str, Any], model: str) -> Options:
    """The options of the command line, and what the settings beside the model allow."""
    from rebsync.checker.exploration import INSTRUCTIONS, Limits
    from rebsync.checker.problem import Cluster, Options

    if given["language"] == "core" and given["fairness"] == "progress":
        raise click.UsageError("--language core has no time: leave --fairness progress out")
    if given["between"] and view_named(given) not in (None, "tts"):
        raise click.UsageError("--time-between needs the exact view: --semantics tts")
    return Options(
        semantics=view_named(given),
        engine=given["engine"],
        limits=Limits(
            given["max_states"],
            given["max_time"],
            given["memory"],
            given["until"],
            given["max_instructions"] or INSTRUCTIONS,
        ),
        fairness=given["fairness"],
        allowed=frozenset({*given["allow"], *_allowed(model)}),
        hash_compaction=given["hash_compaction"],
        threads=given["threads"],
        reduce=bool(given["reduce"]),
        symmetry=given["symmetry"],
        auto_reduce=given["reduce"] is None and not any(given[o] for o in _SHOW_STATES),
        cluster=Cluster(given["cluster"], given["workers"]) if given["cluster"] else None,
        first=_first(given),
    )


def _is_code(path: str) -> bool:
    from rebsync.reverse.files.packages import CODE

    return Path(path).suffix in CODE | {".py"} and Path(path).is_file()


def _is_package(path: str) -> bool:
    return Path(path).is_dir()


def _allowed(model: str) -> tuple[str, ...]:
    """What the settings beside a model allow; nodes of a package may wait for messages for ever."""
    from rebsync.config import settings_beside

    return ("deadlock",) if _is_package(model) else settings_beside(model)[1].allow


def _first(given: dict[str, Any]) -> bool:
    """Whether the search ends at the first violation: by itself where a person waits for it, and
    no values are measured."""
    if given["stop_at"] and given["everything"]:
        raise click.UsageError("--stop-at first and --all exclude each other")
    if given["stop_at"] or given["everything"] or given["measures"] or given["between"]:
        return bool(given["stop_at"])
    waits = sys.stdout.isatty() and sys.stderr.isatty()
    return waits and given["style"] == "text" and given["output"] == "-"


def view_named(given: dict[str, Any]) -> Semantics | None:
    """The view that the options ask for; None leaves it to the model."""
    if given["language"] == "core":
        if given["semantics"] != "auto":
            raise click.UsageError("--language core has no time: leave --semantics out")
        return "core"
    asked: Semantics | Literal["auto"] = given["semantics"]
    return None if asked == "auto" else asked


def _verified(problem: Problem, options: Options) -> Result:
    from rebsync.checker.cluster import NoCluster
    from rebsync.checker.exploration import Unavailable
    from rebsync.checker.verify import verify
    from rebsync.cli.progress import progress

    with progress(sys.stderr) as report:
        try:
            return verify(problem, options, report)
        except Unavailable as unavailable:
            hint = "--engine auto goes on without it"
            raise RebsyncError.of(problem.source.path, "RS931", str(unavailable), hint) from None
        except NoCluster as missing:
            hint = "without --cluster this machine searches"
            raise RebsyncError.of(problem.source.path, "RS933", str(missing), hint) from None
