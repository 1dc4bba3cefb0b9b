"""`rebsync monitor`: write the node that compares a run of a system with its model."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import click

from rebsync.cli.status import Status
from rebsync.config import TARGETS, Config, settings_beside
from rebsync.diagnostics import Diagnostic, Findings
from rebsync.files import read_source
from rebsync.locking import alone_in
from rebsync.report import print_report
from rebsync.roundtrip.package.manifest import FOLDER
from rebsync.source import NOWHERE, Source
from rebsync.terminal import say, say_lines
from rebsync.writing import replace_tree


@click.command("monitor")
@click.argument("model", metavar="MODEL")
@click.option("-o", "--output", default=".", metavar="DIR", help="Where the package's folder is.")
@click.option(
    "--target",
    type=click.Choice(TARGETS),
    help="The dialect of the code (default: that of the settings, else ros1-cpp).",
)
@click.option("--list", "only_list", is_flag=True, help="List the files; write nothing.")
@click.option("--force", is_flag=True, help="Overwrite files that are there and differ.")
def command(model: str, output: str, target: str | None, only_list: bool, force: bool) -> Status:
    """Write the monitor of a model, and nothing else, to DIR/<package>.

    While the system runs it compares what the nodes serve with the model, and publishes what it
    finds on /diagnostics. `generate --monitor` writes the whole package, with its build entries.
    """
    _, config = settings_beside(model)
    if target is not None:
        config = replace(config, target=target)
    folder, files = monitor_files(model, config, output)
    if only_list:
        say_lines(str(folder / path) for path in sorted(files))
        return Status.CLEAN
    with alone_in(str(folder)):
        others = [] if force else list(_others(folder, files))
        if others:
            print_report(others, sys.stderr)
            return Status.FINDINGS
        written = replace_tree(str(folder), files)
    say(f"{folder}: {len(files)} files of the monitor, {len(tuple(written))} of them written")
    say("`rebsync generate --monitor` has the package build them")
    return Status.CLEAN


def monitor_files(model: str, config: Config, output: str) -> tuple[Path, dict[str, str]]:
    """The package's folder, and what a package with a monitor has beside the same without one."""
    from rebsync.cli.generate import package_files

    source = read_source(model)
    name, plain = package_files(source, replace(config, monitor=False), output)
    _, monitored = package_files(source, replace(config, monitor=True), output)
    own = {p: t for p, t in monitored.items() if p not in plain and not p.startswith(f"{FOLDER}/")}
    if not own:
        raise click.UsageError(f"{model}: a monitor needs the rebecs of `main`")
    return Path(output) / name, own


def _others(folder: Path, files: dict[str, str]) -> Iterator[Findings]:
    """The files that would be overwritten and are not as they would be."""
    message = "this file is there and differs; nothing was written"
    found = Diagnostic("RS701", NOWHERE, message, "with --force it is overwritten")
    for name, text in files.items():
        path = folder / name
        if path.exists() and read_source(str(path)).text != text:
            yield Findings(Source(str(path), ""), (found,))
