"""Options that several commands share."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, TypeVar

import click

from rebsync.diagnostics import RebsyncError
from rebsync.report import FORMATS
from rebsync.terminal import write_data

_Command = TypeVar("_Command", bound=Callable[..., Any])


def format_option(command: _Command) -> _Command:
    """`--format text|json|sarif|github`, as the argument `style`."""
    option = click.option(
        "--format",
        "style",
        type=click.Choice(FORMATS),
        default="text",
        show_default=True,
        help="How to print the findings.",
    )
    return option(command)


def names_option(command: _Command) -> _Command:
    """`--property-name NAME`, several times, as the argument `names`."""
    option = click.option(
        "--property-name",
        "names",
        multiple=True,
        metavar="NAME",
        help="Check the properties of these names only.",
    )
    return option(command)


def output_option(command: _Command) -> _Command:
    """`-o FILE`, as the argument `output`."""
    option = click.option(
        "-o",
        "--output",
        default="-",
        metavar="FILE",
        help="Write to FILE instead of standard output.",
    )
    return option(command)


def refuse_to_overwrite(given: str, output: str) -> None:
    """A RebsyncError when the output file is the one that was read."""
    with suppress(OSError):
        if "-" not in (given, output) and Path(output).samefile(given):
            raise RebsyncError.of(output, "RS802", "this file would be overwritten by its output")


def write_pieces(output: str, pieces: Iterable[str]) -> None:
    """Write a text to a file as it is made."""
    from rebsync.writing import replace_pieces

    replace_pieces(output, pieces)


def write_output(output: str, text: str) -> None:
    """Write a text to a file, or to standard output for `-`: in UTF-8, cleaned for terminals."""
    if output == "-":
        write_data(text)
        return
    from rebsync.writing import replace_text

    replace_text(output, text)


def check_served(given: Mapping[str, Any], output: str) -> None:
    """A UsageError where something is to be served, and written as well."""
    if given["serve"] and (given["style"] != "text" or output != "-"):
        raise click.UsageError("--serve shows a page: leave --format and --output out")
    if given["port"] and not given["serve"]:
        raise click.UsageError("--port is that of --serve")


def serve_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """The options of what is shown by a page that is served."""
    for option in (
        click.option(
            "--port",
            type=click.IntRange(0, 65535),
            default=0,
            metavar="N",
            help="With --serve: the port (default: any that is free).",
        ),
        click.option(
            "--serve",
            is_flag=True,
            help="Serve a page on this machine that follows every possible step.",
        ),
    ):
        command = option(command)
    return command
