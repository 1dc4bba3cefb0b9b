"""Generated code that no model describes: the run-time part, programs, stand-ins of sensors.

What somebody has changed there is not in the model that is extracted, so that nothing can be said
of the system. Layout and comments do not count, nor does another name of the package.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from types import MappingProxyType

from rebsync.diagnostics import Findings, RebsyncError
from rebsync.files import read_source
from rebsync.reverse.files.compiled_text import compiled_text
from rebsync.reverse.scaffold.facts import package_name
from rebsync.reverse.scaffold.python_trees import MODULE
from rebsync.reverse.scaffold.runtime_cpp import HEADER, first_cpp_difference, may_be_cpp_runtime
from rebsync.reverse.scaffold.runtime_python import PYTHON, first_difference, is_python_runtime
from rebsync.reverse.scaffold.stand_ins import STAND_IN, plays_on
from rebsync.roundtrip.package.managed import ManagedPackage
from rebsync.roundtrip.package.manifest import BASE
from rebsync.roundtrip.package.record import Record
from rebsync.roundtrip.package.shared_runtime import inside, is_shared, path_beside
from rebsync.roundtrip.package.state import PackageState
from rebsync.roundtrip.package.units import manifest_of
from rebsync.roundtrip.verdict.missing_definitions import finding
from rebsync.source import NOWHERE, Source, Span

_HINT = "take the edit back, or tell of it in the model; `rebsync generate --diff` shows it"


def edited(
    package: ManagedPackage,
    record: Record | None,
    now: PackageState,
    renamed: Mapping[str, str] = MappingProxyType({}),
) -> tuple[Findings, ...]:
    """The places that are not as they were generated.

    `renamed` are classes of last time with their names in the code, which programs may use.
    """
    if record is None:
        return ()
    paths = (
        f"{package.root}/{BASE}{manifest_of(record.files)}",
        now.listing.files.get(manifest_of(now.listing.files), ""),
    )
    own = frozenset(filter(None, map(package_name, paths)))
    gone = sorted(n for n in now.missing if is_shared(n))
    names = sorted(({*now.changed, *now.missing} & record.files.keys()).difference(gone[1:]))
    return tuple(
        f for name in names if _may_be(name) for f in _edited(package, now, name, own, renamed)
    )


def _may_be(name: str) -> bool:
    """Whether a generated file may be of the run-time part, or a program."""
    is_message = is_shared(name) and name.endswith(".msg")
    return is_message or may_be_cpp_runtime(inside(name)) or PYTHON.match(name) is not None


def _edited(
    package: ManagedPackage,
    now: PackageState,
    name: str,
    own: frozenset[str],
    renamed: Mapping[str, str],
) -> Iterator[Findings]:
    """The place where a file is not as it was generated; `own` are the names of the package."""
    path = now.listing.files.get(name) or (None if is_shared(name) else _moved(now, name))
    if path is None:
        if is_shared(name):
            yield _gone(package, name)
        elif HEADER.match(name) or MODULE.match(name) or _is_python_program(package, name):
            message = "generated code that the rest needs is gone"
            yield finding(Source(f"{package.root}/{name}", ""), NOWHERE, message, _HINT)
        return
    try:
        source = Source(path, compiled_text(name, read_source(path).text))
        base = read_source(f"{package.root}/{BASE}{name}")
    except RebsyncError as error:
        found = error.findings[0]
        message = f"generated code that no model describes cannot be compared with {BASE}{name}"
        message += f": {found.diagnostics[0].message}"
        yield finding(Source(path, ""), NOWHERE, message, _HINT)
        return
    span = _difference(name, base, source, own)
    if span is not None and _difference(name, base, _named_as(source, renamed), own) is not None:
        yield finding(
            source, span, "this is not as it was generated, and no model describes it", _HINT
        )


def _gone(package: ManagedPackage, name: str) -> Findings:
    """What is to be done where the run-time part that packages share is not beside one."""
    message = "the run-time part that this package shares with others is not here"
    hint = "`rebsync generate --runtime package` writes it beside the package"
    return finding(Source(path_beside(package.root, name), ""), NOWHERE, message, hint)


def _named_as(source: Source, renamed: Mapping[str, str]) -> Source:
    """A text in which classes have the names that they had."""
    text = source.text
    for old, new in renamed.items():
        text = re.sub(rf"\b{re.escape(new)}\b", old, text)
    return Source(source.path, text)


def _is_python_program(package: ManagedPackage, name: str) -> bool:
    """Whether a file that is gone was a program, or played sensors."""
    if not PYTHON.match(name):
        return False
    try:
        base = read_source(f"{package.root}/{BASE}{name}")
    except RebsyncError:
        return False
    return is_python_runtime(name, base.text)


def _difference(name: str, base: Source, source: Source, own: frozenset[str]) -> Span | None:
    """Where a file is not as it was generated, if no model describes it."""
    if name.endswith(".msg"):
        return None if _fields(base) == _fields(source) else Span(0, min(1, len(source.text)))
    is_python = PYTHON.match(name) is not None
    if STAND_IN.fullmatch(name) and plays_on(base.text, source.text, is_python=is_python):
        return None
    if is_python:
        is_described = not is_python_runtime(name, base.text)
        return None if is_described else first_difference(base, source, own)
    return first_cpp_difference(inside(name), base, source, own)


def _fields(message: Source) -> list[str]:
    lines = (line.partition("#")[0].split() for line in message.text.splitlines())
    return [" ".join(line) for line in lines if line]


def _moved(now: PackageState, name: str) -> str | None:
    """The file of that name that is somewhere else, as in a package that was renamed."""
    last = name.rpartition("/")[2]
    same = [p for n, p in now.listing.files.items() if n.rpartition("/")[2] == last]
    return same[0] if len(same) == 1 else None
