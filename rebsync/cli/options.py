"""Options that several commands share."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any, TypeVar

import click

from rebsync.report import FORMATS

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


def write_output(output: str, text: str) -> None:
    """Write a text to a file, or to standard output for `-`, always in UTF-8."""
    if output == "-":
        sys.stdout.flush()
        sys.stdout.buffer.write(text.encode("utf-8"))
        sys.stdout.buffer.flush()
        return
    from rebsync.files import replace_text

    replace_text(output, text)
