"""Values in launch files of ROS 2: texts put together of what only the launch knows.

Both kinds of files, Python and XML or YAML, write them; here is what they come to. What depends on
the machine, on a command or on an expression is open.
"""

from __future__ import annotations

import posixpath
from collections.abc import Mapping
from typing import TypeAlias

from rebsync.records import dataclass
from rebsync.reverse.launch.ros2_worked import worked_out
from rebsync.reverse.unknowns import Open, Text
from rebsync.source import Span
from rebsync.unions import assert_never

# What stands for the folder of a package that its files are installed in.
SHARE = "share:/"


@dataclass(frozen=True, slots=True)
class LaunchVariable:
    """What a launch configuration holds: `default` where nothing sets it."""

    name: Words
    default: Words | None = None


@dataclass(frozen=True, slots=True)
class Environment:
    """A variable of the environment, with what stands in for it."""

    name: Words
    default: Words | None = None


@dataclass(frozen=True, slots=True)
class Share:
    """The folder of a package."""

    package: Words


@dataclass(frozen=True, slots=True)
class Here:
    """The launch file, or its folder."""

    folder: bool


@dataclass(frozen=True, slots=True)
class Path:
    """Parts of a path, with slashes between them."""

    parts: tuple[Words, ...]


@dataclass(frozen=True, slots=True)
class Computed:
    """What is known only when the file runs."""

    why: str


@dataclass(frozen=True, slots=True)
class Worked:
    """What a substitution works out of other texts; `name` is its word in `ros2_worked`."""

    name: str
    parts: tuple[Words, ...]


Word: TypeAlias = "str | LaunchVariable | Environment | Share | Here | Path | Computed | Worked"


@dataclass(frozen=True, slots=True)
class Words:
    """A text: its parts one behind the other, and its place in the file."""

    parts: tuple[Word, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class LaunchContext:
    """What is known where a text is worked out: the configurations, and the file it is in."""

    variables: Mapping[str, Text]
    file: str


def evaluated(words: Words, known: LaunchContext) -> Text:
    """The text; open where a part of it is, with the reason of the first."""
    found = ""
    for word in words.parts:
        part = _part(word, known)
        if isinstance(part, Open):
            return part
        found += part
    return found


def _part(word: Word, known: LaunchContext) -> Text:
    match word:
        case str():
            return word
        case LaunchVariable(name, default):
            return _variable(name, default, known)
        case Environment(_, default):
            none = Open("it depends on the environment")
            return evaluated(default, known) if default is not None else none
        case Share(package):
            folder = evaluated(package, known)
            return folder if isinstance(folder, Open) else SHARE + folder
        case Here(folder):
            return posixpath.dirname(known.file) or "." if folder else known.file
        case Path(parts):
            return _path(parts, known)
        case Computed(why):
            return Open(why)
        case Worked(name, parts):
            texts = [evaluated(part, known) for part in parts]
            return next((t for t in texts if isinstance(t, Open)), None) or worked_out(
                name, [t for t in texts if isinstance(t, str)]
            )
        case _:
            assert_never(word)


def _variable(name: Words, default: Words | None, known: LaunchContext) -> Text:
    key = evaluated(name, known)
    if isinstance(key, Open):
        return key
    if key in known.variables:
        return known.variables[key]
    if default is not None:
        return evaluated(default, known)
    return Open(f"nothing here gives the argument `{key}`")


def _path(parts: tuple[Words, ...], known: LaunchContext) -> Text:
    found = [evaluated(part, known) for part in parts]
    texts = [f for f in found if isinstance(f, str)]
    if len(texts) < len(found):
        return next(f for f in found if isinstance(f, Open))
    return posixpath.join(*texts) if texts else ""


def below_share(path: str, package: str) -> str | None:
    """The path within the package's own folder; None for one elsewhere.

    Where it is not known of which package the files are, any package may be theirs.
    """
    if not path.startswith(SHARE):
        return None if path.startswith("/") else posixpath.normpath(path)
    owner, _, inner = path.removeprefix(SHARE).partition("/")
    return posixpath.normpath(inner) if owner == package or not package else None
