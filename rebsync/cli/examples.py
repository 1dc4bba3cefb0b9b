"""`rebsync examples`: the examples, each with its model, properties, settings and package."""

from __future__ import annotations

import os
from pathlib import Path

import click

from rebsync.cli.status import Status
from rebsync.config import parse_config
from rebsync.files import MODEL, read_source
from rebsync.source import Source
from rebsync.terminal import say
from rebsync.writing import replace_tree

SHIPPED = Path(__file__).parents[1] / "examples"


@click.command("examples")
@click.argument("directory", metavar="DIR")
@click.argument("names", metavar="[NAME...]", nargs=-1)
def command(directory: str, names: tuple[str, ...]) -> Status:
    """Write the examples to DIR, or those that are named; what is there already stays as it is."""
    known = sorted(path.stem for path in SHIPPED.glob(f"*/*{MODEL}"))
    for name in names:
        if name not in known:
            raise click.UsageError(f'no example "{name}"; there are {", ".join(known)}')
    for name in names or known:
        folder = f"{directory}/{name}"
        if os.path.lexists(folder):
            say(f"{folder}: is there already")
            continue
        files = _files(name, folder)
        replace_tree(folder, files)
        say(f"{folder}: {len(files)} files")
    return Status.CLEAN


def _files(name: str, folder: str) -> dict[str, str]:
    """The files of an example: those that people wrote, and its package as it is generated."""
    from rebsync.cli.generate import package_files

    own = {p.name: read_source(str(p)).text for p in SHIPPED.glob(f"{name}/*") if p.is_file()}
    model = f"{name}{MODEL}"
    config = parse_config(Source(f"{folder}/rebsync.toml", own["rebsync.toml"]))
    package, files = package_files(Source(f"{folder}/{model}", own[model]), config, folder)
    return {**own, **{f"{package}/{path}": text for path, text in files.items()}}
