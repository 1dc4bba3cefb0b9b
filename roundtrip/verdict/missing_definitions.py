"""Headers and modules that are gone while code needs them, and what sensors are asked by.

Users write in some generated files: what these say no model tells, but code is built of them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from rebsync.diagnostics import Diagnostic, Findings
from rebsync.reverse.files.stores import join
from rebsync.roundtrip.package.shared_runtime import is_shared
from rebsync.roundtrip.package.state import PackageState
from rebsync.source import NOWHERE, Source, Span

_HINT = "put it back, or take out by hand all that belongs to it"
_SEEN = re.compile(r"\.seen\(&(\w+)\)")
_Codes = Sequence[tuple[str, Source]]


def missing_definitions(now: PackageState, codes: _Codes) -> Iterator[Findings]:
    """What is wrong, where the files of a package are these."""
    for name in (n for n in now.missing if not is_shared(n)):  # of which it is told at once
        if (user := next(_users(name, codes), None)) is not None:
            path = join(now.listing.root, name)
            yield finding(Source(path, ""), NOWHERE, f"this is gone, and {user.path} needs it")
    if now.changed or now.missing:
        yield from _seen(codes)


def finding(source: Source, span: Span, message: str, hint: str = _HINT) -> Findings:
    """That something in the code is not as it was generated, or is missing; what to do."""
    return Findings(source, (Diagnostic("RS956", span, message, hint),))


def _users(name: str, codes: _Codes) -> Iterator[Source]:
    """The code that includes a header, or imports a module."""
    folder, stem, suffix = _parts(name)
    use = rf"^\s*(?:from|import)\s+{folder}\.{stem}\b"
    if suffix in ("h", "hpp"):
        use = rf'^\s*#\s*include\s*["<](?:{folder}/)?{stem}\.{suffix}[">]'
    elif suffix != "py":
        return
    yield from (source for _, source in codes if re.search(use, source.text, re.M))


def _parts(name: str) -> tuple[str, str, str]:
    """The folder that a file is in, its name, and what that ends with."""
    inside, _, last = name.rpartition("/")
    stem, _, suffix = last.rpartition(".")
    return re.escape(inside.rpartition("/")[2]), re.escape(stem), suffix


def _seen(codes: _Codes) -> Iterator[Findings]:
    """The functions that C++ asks what a sensor has seen, and that nothing defines."""
    for _, source in codes:
        for found in _SEEN.finditer(source.text):
            call = re.compile(rf"\b{found[1]}\s*\(")
            if not any(call.search(each.text) for _, each in codes):
                yield finding(source, Span(*found.span(1)), f'nothing defines "{found[1]}"')
