"""What a package that was generated needs and lacks, so that its nodes cannot be built or run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import TYPE_CHECKING
from warnings import catch_warnings, simplefilter

from rebsync.diagnostics import Findings, RebsyncError
from rebsync.files import read_source
from rebsync.reverse.files.packages import MANIFEST
from rebsync.reverse.files.python_files import SETUP, is_python
from rebsync.reverse.files.stores import Disk, join
from rebsync.reverse.python.generated.unbound import unbound_names
from rebsync.roundtrip.package.managed import ManagedPackage
from rebsync.roundtrip.package.manifest import BASE
from rebsync.roundtrip.package.record import Record
from rebsync.roundtrip.package.state import NOT_EXECUTABLE, PackageState
from rebsync.roundtrip.package.units import folders_of
from rebsync.roundtrip.verdict.included_instead import included_instead
from rebsync.roundtrip.verdict.missing_definitions import finding, missing_definitions
from rebsync.roundtrip.verdict.shadowing import shadowing
from rebsync.source import NOWHERE, Source, Span

if TYPE_CHECKING:
    from rebsync.reverse.build.named import Named

_BUILD = "CMakeLists.txt"
_DECLARE = "name what has it in package.xml, or import it where ImportError is caught"
_READ = frozenset({_BUILD, MANIFEST, SETUP})


def missing_files(
    package: ManagedPackage, record: Record, now: PackageState
) -> tuple[Findings, ...]:
    """What was generated and is gone while the build names it, or code uses it."""
    codes = dict(_codes(now))
    return (
        *_files(record, now),
        *missing_definitions(now, [*codes.items()]),
        *_failing(record, now, codes),
        *_packages(package, record, now),
        *shadowing(record, now),
        *included_instead(package, record, now),
        *_refused(now),
        *_not_executable(now),
    )


def _failing(record: Record, now: PackageState, codes: Mapping[str, Source]) -> Iterator[Findings]:
    """The imports of Python that fail."""
    if any(name in codes and is_python(name, codes[name]) for name in now.changed):
        from rebsync.reverse.build.unresolved_imports import unresolved_imports

        for source, span, why in unresolved_imports(codes, now.changed, record.files):
            yield finding(source, span, why, _DECLARE)


def _refused(now: PackageState) -> Iterator[Findings]:
    """The files of Python that have a tree, but that Python does not take."""
    for name in now.changed:
        path = now.listing.files.get(name, "")
        source = _code(path) if name.endswith(".py") else None
        if source is None:
            continue
        try:
            with catch_warnings():
                simplefilter("ignore")
                compile(source.text, path, "exec", dont_inherit=True)
            for span, bare in unbound_names(source):
                yield finding(source, span, f'nothing here defines or imports "{bare}"')
        except (SyntaxError, ValueError, RecursionError) as error:
            last = source.text.count("\n") + 1
            line = source.start_of(min(getattr(error, "lineno", None) or 1, last))
            message = f"Python does not take this: {getattr(error, 'msg', error)}"
            yield finding(source, Span(line, line + 1), message)


def _not_executable(now: PackageState) -> Iterator[Findings]:
    """The generated programs that no launch file can start: their executable bit is gone."""
    for name in now.changed:
        if now.digests[name].startswith(NOT_EXECUTABLE):
            source = Source(now.listing.files[name], "")
            message = "this program is not executable, so that nothing can start it"
            yield finding(source, NOWHERE, message, "make it executable again: `chmod +x`")


def _code(path: str) -> Source | None:
    with suppress(RebsyncError):  # what cannot be read, extraction lists
        return read_source(path)
    return None


def _files(record: Record, now: PackageState) -> Iterator[Findings]:
    if not now.missing:
        return
    from rebsync.reverse.build.named import named

    listing = now.listing
    store = listing.store or Disk()
    for folder in folders_of(listing.files) or ("",):
        prefix = f"{folder}/" if folder else ""
        own = (n for n in listing.files if n.startswith(prefix))
        inside = {name.removeprefix(prefix): listing.files[name] for name in own}
        files = {name: _read(path, name) for name, path in inside.items()}
        for each in named(files):
            name = f"{prefix}{each.path}"
            path = join(listing.root, name)
            if each.path not in files and name in record.files and not store.exists(path):
                yield _gone(path, each)


def _gone(path: str, each: Named) -> Findings:
    by = f"{each.source.path}:{each.source.position(each.span.start).line}"
    return finding(Source(path, ""), NOWHERE, f"this is gone, and {by} names it")


def _read(path: str, name: str) -> Source:
    """A build file; of others only the path matters."""
    if name.rpartition("/")[2] in _READ:
        with suppress(RebsyncError):  # what cannot be read, extraction lists
            return read_source(path)
    return Source(path, "")


def _packages(package: ManagedPackage, record: Record, now: PackageState) -> Iterator[Findings]:
    """The packages that a build file no longer asks for, and that code still needs."""
    for name in now.changed:
        if name.rpartition("/")[2] not in (_BUILD, MANIFEST):
            continue
        from rebsync.reverse.build.dependencies import asked_for, uses

        for before, source in _sides(package, record, now, name):
            for dependency in sorted(asked_for(name, before) - asked_for(name, source)):
                if any(uses(path, code, dependency) for path, code in _codes(now)):
                    message = f"this no longer asks for {dependency}, and code needs it"
                    yield finding(source, Span(0, 1), message)


def _sides(
    package: ManagedPackage, record: Record, now: PackageState, name: str
) -> Iterator[tuple[Source, Source]]:
    """A generated file as it was generated and as it is; none where one cannot be read."""
    if name in record.files and name in now.listing.files:
        with suppress(RebsyncError):
            yield read_source(f"{package.root}/{BASE}{name}"), read_source(now.listing.files[name])


def _codes(now: PackageState) -> Iterator[tuple[str, Source]]:
    """The files of a package that can be read."""
    for name, path in now.listing.files.items():
        with suppress(RebsyncError):
            yield name, read_source(path)
