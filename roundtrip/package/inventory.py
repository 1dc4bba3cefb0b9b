"""What a repository has of models, properties and packages, and which of them belong together."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from rebsync.config import Config, config_of_record
from rebsync.diagnostics import RebsyncError
from rebsync.files import MODEL, PROPERTY
from rebsync.forward.generate import package_name
from rebsync.records import dataclass
from rebsync.reverse.files.packages import MANIFEST
from rebsync.roundtrip.package.discovery import find
from rebsync.roundtrip.package.managed import SKIPPED
from rebsync.roundtrip.package.model_file import model_of, properties_beside
from rebsync.roundtrip.package.record import read_record
from rebsync.roundtrip.package.shared_runtime import folders_beside
from rebsync.trees import is_within


@dataclass(frozen=True, slots=True)
class GeneratedPackage:
    """A package with records: where it is, its name, its dialect, the real path of its model.

    `shared` are the real paths of run-time packages that it shares with others.
    """

    root: str
    name: str
    target: str
    model: str
    shared: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True)
class ModelFiles:
    """A model, its property file, and the packages made from it."""

    path: str
    properties: str | None
    packages: tuple[GeneratedPackage, ...]


@dataclass(frozen=True, slots=True)
class Inventory:
    """The models of a directory; packages of which no model is known; properties of no model."""

    models: tuple[ModelFiles, ...]
    packages: tuple[str, ...]
    properties: tuple[str, ...]

    def beside(self, former: Inventory) -> Inventory:
        """What is there, and what was there before of models and their packages."""
        models = {each.path: each for each in former.models}
        for each in self.models:
            old = models[each.path].packages if each.path in models else ()
            packages = {package.root: package for package in (*old, *each.packages)}
            models[each.path] = replace(each, packages=tuple(packages.values()))
        return replace(self, models=tuple(models.values()))


def inventory(root: str) -> Inventory:
    """What is in a directory. RebsyncError: it may not be read."""
    paths = sorted(_files(root))
    generated = tuple(_generated(root))
    models = tuple(
        ModelFiles(path, properties_beside(path), _made_from(path, generated))
        for path in paths
        if path.endswith(MODEL)
    )
    known = [os.path.realpath(package.root) for each in models for package in each.packages]
    known += [path for package in generated for path in package.shared]
    roots = (str(Path(path).parent) for path in paths if Path(path).name == MANIFEST)
    return Inventory(
        models,
        tuple(r for r in roots if not any(is_within(os.path.realpath(r), k) for k in known)),
        tuple(p for p in paths if p.endswith(PROPERTY) and not Path(p).with_suffix(MODEL).exists()),
    )


def _files(root: str) -> Iterator[str]:
    for folder, folders, names in os.walk(root):
        folders[:] = [n for n in folders if n[0] != "." and n not in SKIPPED]
        for name in names:
            if name == MANIFEST or (name.endswith((MODEL, PROPERTY)) and name[0] != "."):
                yield os.path.normpath(f"{folder}/{name}")


def _generated(root: str) -> Iterator[GeneratedPackage]:
    """The packages below a directory whose records lead to a model."""
    with suppress(RebsyncError):
        for package in find([root]):
            with suppress(RebsyncError):
                record = read_record(package.root)
                config = config_of_record(record.options) or Config()
                name = package_name(Path(record.model).stem, config)
                model = os.path.realpath(model_of(package, record))
                shared = folders_beside(package.root, record.files)
                yield GeneratedPackage(package.root, name, config.target, model, shared)


def _made_from(model: str, packages: tuple[GeneratedPackage, ...]) -> tuple[GeneratedPackage, ...]:
    real = os.path.realpath(model)
    return tuple(package for package in packages if package.model == real)
