"""Which files a command line means: a directory stands for what lies below it."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from rebsync.diagnostics import RebsyncError
from rebsync.files import MODEL, STANDARD_INPUT, followed, os_mistake
from rebsync.terminal import say


def expand(paths: Sequence[str], suffixes: tuple[str, ...]) -> Iterator[str | RebsyncError]:
    """The files meant, in order, each once; a path that cannot be used gives its error."""
    seen: set[str] = set()
    for path in paths:
        for found in _files(path, suffixes):
            if isinstance(found, RebsyncError):
                yield found
            elif found not in seen:
                seen.add(found)
                yield found


def models_in(path: str) -> list[str | RebsyncError]:
    """The models below a directory that is no package, or why one cannot be used; else none.

    Code without a manifest is a package where no models are beside it; else this is said.
    """
    from rebsync.reverse.files.packages import CODE, MANIFEST

    folder = Path(path)
    if not folder.is_dir() or (folder / MANIFEST).exists():
        return []
    found = list(expand((path,), (MODEL,)))
    if not any(isinstance(each, str) for each in found):
        return []
    code = sorted(each.name for each in folder.iterdir() if each.suffix in CODE | {".py"})
    if code:
        say(
            f"{', '.join(code[:3])}{', ...' if len(code) > 3 else ''}: in no package, as there is "
            f"no {MANIFEST}: only the models are verified (--environment free reads the code)",
            err=True,
        )
    return found


def _files(path: str, suffixes: tuple[str, ...]) -> Iterator[str | RebsyncError]:
    if path == STANDARD_INPUT or not Path(path).is_dir():
        yield path
        return
    errors: list[OSError] = []
    found = False
    for folder, folders, names in os.walk(path, onerror=errors.append):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        for name in sorted(names):
            file = Path(folder, name)
            if name.endswith(suffixes) and not name.startswith(".") and not _special(file):
                found = True
                yield _within(str(file), path)
    for error in errors:
        yield os_mistake(str(error.filename or path), error)
    if not found and not errors:
        wanted = " or ".join(f"*{suffix}" for suffix in suffixes)
        yield RebsyncError.of(path, "RS811", f"there is no {wanted} below this directory")


def _within(file: str, named: str) -> str | RebsyncError:
    """A file below a directory that was named; its mistake where it is a link that leads out."""
    if os.path.islink(file):  # noqa: PTH114
        try:
            followed(file, named)
        except OSError as error:
            return os_mistake(file, error)
        except RebsyncError as error:
            return error
    return file


def _special(path: Path) -> bool:
    """Whether this is a pipe or the like, on which reading might wait for ever."""
    return path.exists() and not path.is_file()
