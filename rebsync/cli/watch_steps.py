"""What `rebsync watch` does when files have changed: commands of rebsync, in order."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path

from rebsync.config import FILE_NAME
from rebsync.records import dataclass
from rebsync.roundtrip.package.inventory import GeneratedPackage, Inventory, ModelFiles
from rebsync.trees import is_within


@dataclass(frozen=True, slots=True)
class WatchOptions:
    """Whether models are verified, for how long each, and the directory of the live page."""

    is_verifying: bool
    max_time: str
    page: str | None


@dataclass(frozen=True, slots=True)
class Command:
    """The arguments of a command; the title and file of the part of the page that it writes."""

    arguments: tuple[str, ...]
    title: str = ""
    file: str = ""


def commands(
    known: Inventory, changed: set[str] | None, options: WatchOptions
) -> tuple[Command, ...]:
    """What is to be done anew when files and directories have changed; all for None.

    They go by their real paths.
    """
    return tuple(dict.fromkeys(_commands(known, changed, options)))


def _commands(
    known: Inventory, changed: set[str] | None, options: WatchOptions
) -> Iterator[Command]:
    for path in known.properties:
        if changed is None or os.path.realpath(path) in changed:
            yield Command(("lint", path))
    for model in known.models:
        is_there = Path(model.path).is_file()
        is_new = changed is None or any(is_within(o, c) for o in _own(model) for c in changed)
        if is_new and is_there:
            yield from _of_model(model, options)
        for package in model.packages:
            roots = (os.path.realpath(package.root), *package.shared)
            is_touched = changed is not None and any(
                is_within(path, root) or is_within(root, path) for path in changed for root in roots
            )
            if (is_new or is_touched) and Path(package.root).is_dir():
                yield from _of_package(model, package, is_touched, options)


def _own(model: ModelFiles) -> set[str]:
    """The real paths of a model, its properties and its settings."""
    path = Path(os.path.realpath(model.path))
    return {str(path), str(path.with_suffix(".property")), str(path.with_name(FILE_NAME))}


def _of_model(model: ModelFiles, options: WatchOptions) -> Iterator[Command]:
    yield Command(("lint", model.path, *filter(None, (model.properties,))))
    if options.is_verifying:
        verify = ("verify", model.path, "--max-time", options.max_time)
        yield _for_page(verify, model.path, "run", options) or Command(verify)


def _of_package(
    model: ModelFiles, package: GeneratedPackage, is_touched: bool, options: WatchOptions
) -> Iterator[Command]:
    bounded = ("--verify", "--max-time", options.max_time)
    yield Command(
        ("check", package.root, *(bounded if is_touched and options.is_verifying else ()))
    )
    if (part := _for_page(("graph", package.root), package.root, "graph", options)) is not None:
        yield part
    difference = ("diff", model.path, package.root)
    part = _for_page(difference, package.root, "drift", options)
    if part is not None and Path(model.path).is_file():
        yield part


def _for_page(
    arguments: tuple[str, ...], path: str, kind: str, options: WatchOptions
) -> Command | None:
    """The command that writes a part of the page; None where there is none."""
    if options.page is None:
        return None
    file = f"{re.sub(r'[^A-Za-z0-9.-]+', '_', path)}-{kind}.html"
    written = ("--format", "html", "-o", str(Path(options.page, file)))
    return Command((*arguments, *written), f"{path}: {kind}", file)
