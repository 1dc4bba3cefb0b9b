"""`rebsync extract`: read the code of packages back into models."""

from __future__ import annotations

import json
import os
import re
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import field
from functools import partial
from itertools import chain, islice
from pathlib import Path
from typing import TYPE_CHECKING

import click

from rebsync.cli.options import output_option, refuse_to_overwrite, write_output
from rebsync.cli.status import Status, worst
from rebsync.diagnostics import RebsyncError
from rebsync.files import followed, operating_on
from rebsync.records import dataclass
from rebsync.report import print_report
from rebsync.terminal import json_text, lines_text, named, one_line, say, write_data

if TYPE_CHECKING:
    from rebsync.reverse.answer import Answer

_STATUS = {
    "exact": Status.CLEAN,
    "over-approximated": Status.FINDINGS,
    "assumed": Status.FINDINGS,
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
    no meaning in the model is listed. Exit status: 0 all exact, 1 over-approximated or assumed,
    4 something unreadable or a generated run-time part edited, 2 nothing read.
    """
    from rebsync.reverse.answer import answer
    from rebsync.reverse.build.workspace import in_workspace
    from rebsync.reverse.files.parallel import each
    from rebsync.roundtrip.package.units import units

    if style is not None and form == "json":
        raise click.UsageError("--format json has the report in it: leave out --report")
    for path in paths:
        refuse_to_overwrite(path, output)
    answers = each(in_workspace(units(paths)), partial(answer, style=style, whole=form == "json"))
    first = list(_one(answers, output) if _is_one_file(output) else islice(answers, 2))
    told = _Told(output, len(first) > 1)
    statuses = [s for given in chain(first, answers) if (s := told.tell(given)) is not None]
    if not statuses:
        raise _nothing(paths[0], told.asks)
    return worst(statuses)


def _is_one_file(output: str) -> bool:
    return output != "-" and not Path(output).is_dir()


def _one(answers: Iterator[Answer], output: str) -> Iterator[Answer]:
    """All answers, if there is something to write of one of them only.

    RebsyncError: there is more, which would be written to one file.
    """
    found = 0
    for each in answers:
        found += each.is_read or (bool(each.whole) and each.grade != "exact")
        if found > 1:
            hint = f"make it: mkdir {output}"
            message = "for several packages a directory is wanted here"
            raise RebsyncError.of(output, "RS802", message, hint)
        yield each


@dataclass(slots=True)
class _Told:
    """Where the answers go; `asks` says that there was one without a model but with nodes.

    `names` counts the packages of each name, so that none is written over another.
    """

    output: str
    several: bool
    asks: bool = False
    names: Counter[str] = field(default_factory=Counter)

    def tell(self, given: Answer) -> Status | None:
        """Prints what is known of a package; None where that is nothing."""
        told = self._tell_code(given)
        if told is None:
            return None
        from rebsync.roundtrip.verdict.unmodelled import unmodelled_edits

        edits = unmodelled_edits(given.root)
        print_report(edits, sys.stderr)
        return Status.UNDETERMINED if edits else told

    def _tell_code(self, given: Answer) -> Status | None:
        if given.whole:
            if given.is_read or given.grade != "exact":
                write_output(self._target(given, ".json"), given.whole + "\n")
            return _STATUS[given.grade] if given.is_read else None
        if given.model is not None:
            self._tell_model(given, given.model)
        print_report(given.findings, sys.stderr)
        if given.model is None:
            self.asks |= given.asks
            is_open = given.asks and given.grade == "unreadable"
            if not (self.several and given.asks) and not is_open:
                return None
            print_report(_nothing(given.root, True).findings, sys.stderr)
            return Status.UNDETERMINED
        if given.summary and not given.report:
            sys.stdout.flush()
            say(f"{named(given.root)}: {given.summary}", err=True)
        return _STATUS[given.grade]

    def _tell_model(self, given: Answer, model: str) -> None:
        target = self._target(given, ".rebeca")
        if not given.report or target != "-":
            is_headed = self.several and not _is_one_file(self.output)
            head = f"// {one_line(given.root)}\n" if is_headed else ""
            write_output(target, head + model)
        if given.report:
            write_data(self._report(given))

    def _report(self, given: Answer) -> str:
        """The report; of several each says of which package it is."""
        if not self.several:
            return given.report
        if not given.report.startswith("{"):
            return lines_text([f"{named(given.root)}:"]) + given.report
        told = {"path": given.root, **json.loads(given.report)}
        return json_text(told) + "\n"

    def _target(self, given: Answer, suffix: str) -> str:
        """The file for a package: the one that was named, or one in the directory."""
        if self.output == "-" or not Path(self.output).is_dir():
            return self.output
        # What a package calls itself may be a path, or hidden.
        name = re.sub(r"[^\w+.-]", "_", given.name).lstrip(".") or "package"
        self.names[name] += 1
        again = f"_{self.names[name]}" if self.names[name] > 1 else ""
        path = str(Path(self.output) / f"{name}{again}{suffix}")
        if os.path.islink(path):  # noqa: PTH114
            with operating_on(path):
                followed(path, self.output)
        return path


def _nothing(path: str, asks: bool) -> RebsyncError:
    hint = "--format json tells what the code asks of ROS" if asks else None
    return RebsyncError.of(path, "RS943", "no class of a model was found here", hint)
