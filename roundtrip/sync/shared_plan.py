"""What writing the run-time part that packages share would do to the files that are there."""

from __future__ import annotations

from pathlib import Path

from rebsync.config import Config
from rebsync.files import source_below
from rebsync.reverse.files.packages import BESIDE
from rebsync.roundtrip.package.manifest import BASE
from rebsync.roundtrip.sync.plan import Action, Step


def shared_steps(package: Path, config: Config) -> tuple[Step, ...]:
    """One step for each of its files, by their paths from the folder that the package is in.

    A text that the package has in its records is one that nobody has edited.
    """
    if not config.shared_runtime:
        return ()
    from rebsync.forward.runtime_package import runtime_packages

    files = sorted(runtime_packages(config.target).items())
    return tuple(_step(package, path, text) for path, text in files)


def _step(package: Path, path: str, text: str) -> Step:
    old = _read(package.parent, path)
    if old is None:
        return Step(path, Action.CREATE, None, text)
    if old == text:
        return Step(path, Action.UNCHANGED, old, text)
    is_generated = old == _read(package, f"{BASE}{BESIDE}{path}")
    return Step(path, Action.UPDATE if is_generated else Action.CONFLICT, old, text)


def _read(folder: Path, name: str) -> str | None:
    source = source_below(str(folder), name)
    return source.text.replace("\r\n", "\n") if source is not None else None
