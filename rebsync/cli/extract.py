"""`rebsync extract`: read the code of packages back into models."""

from __future__ import annotations

import sys
from dataclasses import replace
from itertools import chain, islice
from pathlib import Path
from typing import TYPE_CHECKING

import click

from rebsync.cli.options import output_option, refuse_to_overwrite, write_output
from rebsync.cli.status import Status, worst
from rebsync.diagnostics import RebsyncError
from rebsync.records import dataclass
from rebsync.report import print_report

if TYPE_CHECKING:
    from rebsync.reverse.reading import Chosen
    from rebsync.reverse.recovery import Extracted

_STATUS = {
    "exact": Status.CLEAN,
    "over-approximated": Status.FINDINGS,
    "unreadable": Status.UNDETERMINED,
}


@click.command("extract")
@click.argument("paths", metavar="PATH...", nargs=-1, required=True)
@click.option(
    "--format",
    "form",
    type=click.Choice(["text", "json"]),
    default="text",
    show_default=True,
    help="Print the model; or for each package one object with all that is known of it.",
)
@click.option(
    "--report",
    "style",
    type=click.Choice(["text", "json"]),
    help="Print how much of each body is exact, and what is not, instead of the model.",
)
@output_option
def command(paths: tuple[str, ...], form: str, style: str | None, output: str) -> Status:
    """Read the code of packages back into models.

    PATH is a package, a directory with several, or a file: then the classes of that file. What has
    no meaning in the model is listed. Exit status: 0 all exact, 1 over-approximated, 4 something
    unreadable, 2 nothing read.
    """
    from rebsync.reverse.reading import packages

    if style is not None and form == "json":
        raise click.UsageError("--format json has the report in it: leave out --report")
    for path in paths:
        refuse_to_overwrite(path, output)
    each = packages(paths)
    first = list(islice(each, 2))
    task = _Task(form, style, output, len(first) > 1)
    task.check()
    statuses = [s for given in chain(first, each) if (s := task.run(given)) is not None]
    if not statuses:
        raise _nothing(paths[0], task.has_graph)
    return worst(statuses)


@dataclass(slots=True)
class _Task:
    """What is done with each package."""

    form: str
    style: str | None
    output: str
    several: bool
    has_graph: bool = False

    def check(self) -> None:
        """A RebsyncError when several packages would be written to one file."""
        if self.several and self.output != "-" and not Path(self.output).is_dir():
            hint = f"make it: mkdir {self.output}"
            message = "for several packages a directory is wanted here"
            raise RebsyncError.of(self.output, "RS802", message, hint)

    def run(self, given: Chosen) -> Status | None:
        """Prints what is known of a package; None where that is nothing."""
        from rebsync.reverse.recovery import extract
        from rebsync.reverse.report import diagnostics, grade_of, graph_in

        extracted = extract(given.files, given.only)
        extracted = replace(extracted, findings=given.findings + extracted.findings)
        has_model, has_graph = bool(extracted.model.classes), bool(graph_in(extracted).facts)
        self.has_graph |= has_graph
        if self.form == "json":
            if not (has_model or has_graph):
                return None
            self._write_object(given, extracted)
            return _STATUS[grade_of(extracted)]
        if has_model:
            self._write_model(given, extracted)
        if self.style != "json":
            print_report(diagnostics(extracted.findings), sys.stderr)
        if not has_model and has_graph and self.several:
            print_report(_nothing(given.root, True).findings, sys.stderr)
            return Status.UNDETERMINED
        return _STATUS[grade_of(extracted)] if has_model else None

    def _write_object(self, given: Chosen, extracted: Extracted) -> None:
        from rebsync.reverse.report import package_json

        write_output(self._target(given, ".json"), package_json(given, extracted) + "\n")

    def _write_model(self, given: Chosen, extracted: Extracted) -> None:
        from rebsync.printing import print_model
        from rebsync.reverse.report import as_json, as_text

        target = self._target(given, ".rebeca")
        if self.style is None or target != "-":
            head = f"// {given.root}\n" if self.several else ""
            write_output(target, head + print_model(extracted.model))
        if self.style is not None:
            head = f"{given.root}:\n" if self.several and self.style == "text" else ""
            text = as_json(extracted) if self.style == "json" else as_text(extracted)
            click.echo(head + text, nl=False)

    def _target(self, given: Chosen, suffix: str) -> str:
        """The file for a package: the one that was named, or one in the directory."""
        from rebsync.reverse.report import package_name

        if self.output == "-" or not Path(self.output).is_dir():
            return self.output
        name = package_name(given) or Path(given.root).resolve().name
        return str(Path(self.output) / f"{name}{suffix}")


def _nothing(path: str, has_graph: bool) -> RebsyncError:
    hint = "--format json tells what the code asks of ROS" if has_graph else None
    return RebsyncError.of(path, "RS943", "no class of a model was found here", hint)
