"""`rebsync new`: begin a model from a conceptual model in TOML."""

from __future__ import annotations

import click

from rebsync.cli.options import output_option, refuse_to_overwrite, write_output
from rebsync.cli.status import Status
from rebsync.concept import parse_concept
from rebsync.diagnostics import RebsyncError
from rebsync.files import read_source


@click.command("new")
@click.argument("concept", metavar="FILE")
@output_option
@click.option("--force", is_flag=True, help="Replace the output file if there is one.")
def command(concept: str, output: str, force: bool) -> Status:
    """Begin a model from a conceptual model in TOML.

    FILE lists the robots with their command port, properties, activities (with execution times)
    and sensors (with rates), and the controller with its tasks and variables.
    """
    from pathlib import Path

    from rebsync.forward.skeleton import skeleton

    text = skeleton(parse_concept(read_source(concept)))
    if output != "-" and Path(output).exists() and not force:
        hint = "--force replaces it"
        raise RebsyncError.of(output, "RS802", "there is a file of this name already", hint)
    refuse_to_overwrite(concept, output)
    write_output(output, text)
    return Status.CLEAN
