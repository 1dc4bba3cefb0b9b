"""Finds the packages that are kept in step with models, and the model of each."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from rebsync.diagnostics import RebsyncError
from rebsync.files import STANDARD_INPUT, operating_on, os_mistake
from rebsync.roundtrip.package.managed import SKIPPED, SUFFIX, ManagedPackage
from rebsync.roundtrip.package.manifest import FOLDER
from rebsync.trees import (
    repository,
    tree_of,
)

SETTINGS = "rebsync.toml"


def find(paths: Iterable[str], model: str | None = None) -> Iterator[ManagedPackage]:
    """The packages that paths stand for, each once: those in a directory, or around a file.

    A run-time part that packages share stands for all of these.

    RebsyncError: there is no such path, or no package is there.
    """
    seen: set[tuple[int, int]] = set()
    for path in paths:
        named = path if Path(path or ".").is_dir() else str(Path(path).parent)
        every = [replace(package, named=named) for package in _packages(path, model)]
        if not every:
            message = "there is no package here that was made from a model"
            hint = f"`rebsync generate` makes one, with a folder {FOLDER} that is to be committed"
            raise RebsyncError.of(path, "RS960", message, hint)
        found = [package for package in every if _is_new(package, seen)]
        if model is not None and len(found) > 1:
            message = f"--model is for one package, and here are {len(found)}"
            raise RebsyncError.of(path, "RS960", message, "name the package")
        yield from found


def _is_new(package: ManagedPackage, seen: set[tuple[int, int]]) -> bool:
    """Whether a package is not one of those seen, by another path or a link; it is from now on."""
    with operating_on(package.root):
        status = Path(package.root).stat()
    key = status.st_dev, status.st_ino
    is_new = key not in seen
    seen.add(key)
    return is_new


def _packages(path: str, model: str | None) -> Iterator[ManagedPackage]:
    with operating_on(path):
        is_folder = Path(path or ".").is_dir()
        if not is_folder:
            Path(path).stat()
    if path.endswith(SUFFIX) and not is_folder:
        for folder in _around_model(path):
            every = list(_below(folder))
            yield from (
                ManagedPackage(_from_here(k.root), k.tree, path) for k in every if _is_of(k, path)
            )
        return
    around = _around(path)
    if around is not None:
        yield ManagedPackage(around, tree_of(around), model)
    elif sharing := list(_sharing(path)):
        yield from (ManagedPackage(root, tree_of(root), model) for root in sharing)
    elif is_folder:
        found = list(_below(path)) or list(_unrecorded_at(path, model))
        yield from (ManagedPackage(k.root, k.tree, model or k.model) for k in found)


def _sharing(path: str) -> Iterator[str]:
    """The packages that share a run-time part, of which a path is the folder or something in it."""
    from rebsync.roundtrip.package.record import read_record
    from rebsync.roundtrip.package.shared_runtime import folders_beside

    absolute = Path(os.path.realpath(path))
    folder = next((f for f in (absolute, *absolute.parents) if (f / "package.xml").is_file()), None)
    if folder is None or not os.access(folder.parent, os.R_OK):
        return
    for beside in sorted(folder.parent.iterdir()):
        if (beside / FOLDER).is_dir():
            with suppress(RebsyncError):
                if str(folder) in folders_beside(str(beside), read_record(str(beside)).files):
                    yield _as_named(str(beside), path)


def _as_named(root: str, path: str) -> str:
    return root if Path(path).is_absolute() else os.path.relpath(root)


def _unrecorded_at(path: str, model: str | None) -> Iterator[ManagedPackage]:
    """Packages without records of which a user or settings say what their model is."""
    if model is not None:
        from rebsync.roundtrip.package.units import units

        roots = (u.root.removeprefix("./") for u in units([path]) if u.is_package)
        yield from (ManagedPackage(root, tree_of(root), model) for root in roots)
        return
    if not Path(path, "package.xml").is_file():
        return
    above = Path(os.path.normpath(Path(path).absolute())).parent
    if (above / SETTINGS).is_file():
        for package in _unrecorded(os.path.relpath(above), []):
            if Path(package.root).samefile(path):
                yield ManagedPackage(path, package.tree, package.model)


def _around_model(path: str) -> tuple[str, ...]:
    """The directories with all packages that may be made from a model: its repository.

    Without one these are the current directory and that of the model.
    """
    tree = repository(str(Path(os.path.realpath(path)).parent))
    trees = (tree,) if tree is not None else (os.curdir, str(Path(path).parent))
    return trees if Path(path).is_absolute() else tuple(map(os.path.relpath, trees))


def _from_here(path: str) -> str:
    return path if Path(path).is_absolute() else os.path.relpath(path)


def _is_of(package: ManagedPackage, model: str) -> bool:
    if package.model is not None:
        return Path(package.model).samefile(model)
    from rebsync.roundtrip.package.model_file import model_of
    from rebsync.roundtrip.package.record import read_record

    try:
        return Path(model_of(package, read_record(package.root))).samefile(model)
    except (RebsyncError, OSError):
        return False


def _around(path: str) -> str | None:
    """The nearest package above a path, or at it; the search ends with the repository."""
    start = Path(os.path.normpath(Path(path).absolute()))
    for each in (start, *start.parents):
        if _is_kept(each):
            shown = str(each) if Path(path).is_absolute() else os.path.relpath(each)
            return path.rstrip("/") if each == start else shown
        if (each / ".git").exists():
            break
    return None


def _is_kept(folder: Path) -> bool:
    return (folder / FOLDER).is_dir()


# --- walking ------------------------------------------------------------------------------------


def _below(path: str) -> Iterator[ManagedPackage]:
    """The packages in a directory, in the order of their names.

    Of links only those are followed that lead to a package at once, as in a workspace.
    """
    waiting = [path]
    settings: list[str] = []
    roots: list[str] = []
    while waiting:
        folder = waiting.pop()
        names, folders = _entries(folder, top=folder == path)
        if FOLDER in folders:
            roots.append(folder)
            continue
        if SETTINGS in names and any(n.endswith(SUFFIX) for n in names):
            settings.append(folder)
        waiting += [_joined(folder, n) for n in reversed(folders)]
    lost = [each for folder in settings for each in _unrecorded(folder, roots)]
    every = [*(ManagedPackage(root, tree_of(root)) for root in roots), *lost]
    yield from sorted(every, key=lambda k: k.root)


def _is_link_to_package(entry: os.DirEntry[str]) -> bool:
    """Whether it is a link to a package that is kept in step; what is in this is not looked at."""
    return entry.is_symlink() and _is_kept(Path(entry.path))


def _entries(folder: str, top: bool) -> tuple[list[str], list[str]]:
    """The files of a directory, and the directories in it that may hold packages."""
    try:
        with os.scandir(folder) as entries:
            every = sorted(entries, key=lambda e: e.name)
    except OSError as error:
        if top:
            raise os_mistake(folder, error) from None
        return [], []
    folders, names = [], []
    for entry in every:
        try:
            is_folder = entry.is_dir(follow_symlinks=False) or _is_link_to_package(entry)
            is_folder |= entry.name == FOLDER and entry.is_dir()  # if a link, reading it says so
        except OSError:
            continue
        if not is_folder:
            names.append(entry.name)
        elif entry.name == FOLDER or (entry.name[0] != "." and entry.name not in SKIPPED):
            folders.append(entry.name)
    return names, folders


def _joined(folder: str, name: str) -> str:
    return name if folder == "." else f"{folder.rstrip('/')}/{name}"


def _unrecorded(folder: str, roots: list[str]) -> Iterator[ManagedPackage]:
    """The packages that settings and models in a directory stand for, without any records."""
    prefix = "" if folder == "." else f"{folder.rstrip('/')}/"
    if any(root.startswith(prefix) for root in roots):
        return
    from rebsync.config import Config, settings_beside
    from rebsync.forward.generate import package_name

    config = Config()
    with suppress(RebsyncError):
        _, config = settings_beside(f"{prefix}{SETTINGS}")
    for model in sorted(Path(folder).glob(f"*{SUFFIX}")):
        root = f"{prefix}{package_name(model.stem, config)}"
        if Path(root, "package.xml").is_file():
            yield ManagedPackage(root, tree_of(root), f"{prefix}{model.name}")


def path_to_model(model: str, root: str, name: str) -> str:
    """The path from a package's folder to its model, if that is worth recording.

    Empty for a model that lies beside the folder with the name of the package's model, where it is
    found anyway, and for one that is not kept together with it: in another repository, or so far
    away that the path would name directories of this machine.
    """
    there, here = Path(os.path.realpath(model)), Path(os.path.realpath(root))
    if model == STANDARD_INPUT or there == here.parent / name:
        return ""
    if repository(str(there)) != repository(str(here)):
        return ""
    if repository(str(here)) is None and _is_of_machine(os.path.commonpath((there, here))):
        return ""
    return Path(os.path.relpath(there, here)).as_posix()


def _is_of_machine(folder: str) -> bool:
    """Whether what is in a directory is named by the machine or its users: above all homes."""
    with suppress(RuntimeError):  # a user without a home
        if Path(folder) in Path(os.path.realpath(Path.home())).parents:
            return True
    return folder == Path(folder).anchor
