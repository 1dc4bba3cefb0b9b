"""`rebsync init`: what models and packages a repository has, and files to keep them in step."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import click

from rebsync.cli import team_files
from rebsync.cli.status import Status
from rebsync.config import FILE_NAME, TARGETS
from rebsync.files import operating_on, read_source
from rebsync.terminal import say_lines
from rebsync.trees import repository
from rebsync.writing import replace_tree

if TYPE_CHECKING:
    from rebsync.roundtrip.package.inventory import Inventory, ModelFiles

_NO_PACKAGE = "hooks and a CI workflow are written once there is a package to keep in step"


@click.command("init")
@click.argument("directory", metavar="[DIR]", default=".")
def command(directory: str) -> Status:
    """Set a repository up, and tell what it has of models and packages.

    Writes `rebsync.toml` beside each model; where there are packages to keep in step, hooks of
    pre-commit and a CI workflow as well. A file that is there is not changed: what to add to it is
    shown. DIR is in the repository; the current directory if none is given.
    """
    from rebsync.roundtrip.package.inventory import inventory

    with operating_on(directory), os.scandir(directory):
        root = _root(directory)
    found = inventory(root)
    is_kept_in_step = any(model.packages for model in found.models)
    files = {**dict(_settings(root, found)), **(_files(root) if is_kept_in_step else {})}
    missing = {p: t for p, t in files.items() if not os.path.lexists(f"{root}/{p}")}
    say_lines(_summary(found))
    replace_tree(root, missing)
    say_lines(_written(root, missing))
    say_lines(_to_add(root) if is_kept_in_step else (_NO_PACKAGE,))
    return Status.CLEAN


def _root(directory: str) -> str:
    """The working tree of git that a directory is in, or else the directory."""
    tree = repository(os.path.realpath(directory))
    if tree is None or Path(directory).is_absolute():
        return tree or directory
    return os.path.relpath(tree)


def _settings(root: str, found: Inventory) -> Iterator[tuple[str, str]]:
    """The settings beside each model; several models in one directory share them."""
    from rebsync.config import Config
    from rebsync.forward.generate import package_name

    folders: dict[str, list[ModelFiles]] = {}
    for model in found.models:
        folders.setdefault(str(Path(model.path).parent), []).append(model)
    for folder, models in folders.items():
        packages = [package for model in models for package in model.packages]
        target = packages[0].target if packages else _target(found)
        config = Config(target=target)
        name = packages[0].name if packages else package_name(Path(models[0].path).stem, config)
        text = team_files.SETTINGS.format(
            model=" and ".join(Path(model.path).name for model in models),
            package=f'package = "{name}"\n' if len(models) == 1 else "",
            target=target,
        )
        yield Path(os.path.relpath(folder, root), FILE_NAME).as_posix(), text


def _target(found: Inventory) -> str:
    """The dialect that fits the packages that are there: most of a repository are of one ROS."""
    texts = [read_source(f"{package}/package.xml").text for package in found.packages]
    for build, target in (("ament_cmake", "ros2-cpp"), ("ament_python", "ros2-py")):
        if any(build in text for text in texts):
            return target
    return TARGETS[0]


def _files(root: str) -> dict[str, str]:
    """Hooks, and a workflow of GitHub where no other service is used."""
    files = {team_files.HOOKS: team_files.HOOKS_FILE}
    if not os.path.lexists(f"{root}/{team_files.GITLAB}"):
        files[team_files.GITHUB] = team_files.WORKFLOW
    return files


def _summary(found: Inventory) -> Iterator[str]:
    if not found.models:
        yield "no model is here: `rebsync examples DIR` has some, `rebsync new` begins one"
    for model in found.models:
        yield f"model {model.path}"
        yield f"  properties  {model.properties or 'none'}"
        for package in model.packages:
            yield f"  package     {package.root}, {package.target}"
        if not model.packages:
            yield f"  package     none: `rebsync generate {model.path}` writes one"
    for path in found.properties:
        yield f"properties {path}: no model of this name is beside them"
    for root in found.packages:
        yield f"package {root}: of no model here; `rebsync ask {root} QUESTION` looks at its nodes"


def _written(root: str, missing: Mapping[str, str]) -> Iterator[str]:
    for path in missing:
        yield f"wrote {os.path.normpath(f'{root}/{path}')}"
    if team_files.HOOKS in missing:
        yield "`pre-commit install` puts the hooks into this clone"


def _to_add(root: str) -> Iterator[str]:
    """What is to be added to files that were there before."""
    for path, text in (
        (team_files.HOOKS, team_files.HOOK_ENTRIES),
        (team_files.GITLAB, team_files.GITLAB_JOB),
    ):
        place = os.path.normpath(f"{root}/{path}")
        if os.path.lexists(place) and "rebsync" not in read_source(place).text:
            yield f"{place} is yours; to add there:"
            yield from text.splitlines()
