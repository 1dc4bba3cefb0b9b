"""Reads what belongs to what a user names: a file, a directory, one package or many."""

from __future__ import annotations

import codecs
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

from rebsync.diagnostics import RebsyncError
from rebsync.files import BOM, operating_on, os_mistake
from rebsync.long_numbers import MOST_DIGITS, long_number
from rebsync.records import dataclass
from rebsync.reverse.files.compiled_text import compiled_text, odd_encoding
from rebsync.reverse.files.contents import contents
from rebsync.reverse.files.packages import CODE, Listing, listings, shown, suffix_of
from rebsync.reverse.files.python_files import SUFFIX, is_script, relevant_python
from rebsync.reverse.files.relevance import relevant
from rebsync.reverse.files.stores import Store
from rebsync.reverse.findings import Finding, Grade
from rebsync.source import NOWHERE, Source, Span
from rebsync.terminal import controls_in_text

_MUCH = 4 << 20
_CONTROLS = bytes([*range(1, 9), 11, *range(14, 32), 127])
_LATIN = "rebsync-latin-1"
_HINT = "save the file as UTF-8"
_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
_PYTHON_COMMENT = re.compile(r"#[^\n]*")


@dataclass(frozen=True, slots=True)
class Chosen:
    """The files of a package or directory by path in it, and the one that is asked for, if one.

    Code that has nothing to do with ROS, and that nothing else needs, is left out: so many files
    are `skipped`. `findings` are the files that could not be read as they are.
    """

    files: dict[str, Source]
    only: str | None
    root: str = "."
    findings: tuple[Finding, ...] = ()
    skipped: int = 0


def chosen(path: str) -> Chosen:
    """What a path stands for, if it is not several packages: of these the first.

    RebsyncError: there is no such path, or it may not be read.
    """
    return next(packages([path]), Chosen({}, None, path))


def packages(paths: Iterable[str], store: Store | None = None) -> Iterator[Chosen]:
    """What paths stand for: each package in turn, so that one at a time is in memory.

    `store` is where they are, if not on the disk. RebsyncError: there is no such path, or it may
    not be read.
    """
    for listing in all_listings(paths, store):
        yield read(listing)


def all_listings(paths: Iterable[str], store: Store | None = None) -> Iterator[Listing]:
    """The packages that paths stand for, not yet read; files outside of packages if they matter."""
    for path in paths:
        found = listings(path, store=store)
        first = next(found, None)
        second = next(found, None)
        if first is not None and (second is None or first.is_package or _has_code(first)):
            yield first
        if second is not None:
            yield second
        yield from found


def _has_code(listing: Listing) -> bool:
    return any(_is_code(name) for name in listing.files)


def _is_code(name: str) -> bool:
    """Whether a file is code by its name; a script without a suffix is no other that is read."""
    suffix = suffix_of(name)
    return suffix in CODE or suffix == SUFFIX or not suffix


def read(listing: Listing) -> Chosen:
    """The files of a package that matter."""
    findings = [_listed(listing, name, why) for name, why in listing.odd.items()]
    texts, code, python = dict[str, bytes](), dict[str, bytes](), dict[str, bytes]()
    for name, data in _contents(listing):
        if isinstance(data, RebsyncError):
            if name == listing.only:
                raise data
            if _is_code(name):
                findings.append(_listed(listing, name, data.findings[0].diagnostics[0].message))
            continue
        suffix = suffix_of(name)
        is_python = suffix == SUFFIX or (not suffix and is_script(data))
        (code if suffix in CODE else python if is_python else texts)[name] = data
    wanted = relevant(code, listing.only) | relevant_python(python, listing.only)
    code |= python
    files: dict[str, Source] = {}
    for name in sorted([*texts, *wanted]):
        data = code.get(name) or texts.get(name, b"")
        source = _text(listing, name, data, findings, is_python=name in python)
        if source is not None:
            files[name] = source
    return Chosen(
        files, listing.only, shown(listing.root), tuple(findings), len(code) - len(wanted)
    )


def _contents(listing: Listing) -> Iterator[tuple[str, bytes | RebsyncError]]:
    """The bytes of each file, or why it has none."""
    with operating_on(listing.root), contents(listing) as files:
        for name, path in listing.files.items():
            try:
                data: bytes | RebsyncError = files.read(name)
            except RebsyncError as error:
                data = error
            except OSError as error:
                data = os_mistake(path, error)
            yield name, data


# --- text ---------------------------------------------------------------------------------------


def _text(
    listing: Listing, name: str, data: bytes, findings: list[Finding], *, is_python: bool
) -> Source | None:
    """The text of a file; None where it has none, which is then listed if it is code."""
    path = shown(listing.files[name])
    is_code = _is_code(name)
    why, hint = _unreadable(data)
    if why:
        if is_code:
            findings.append(Finding(Grade.UNREADABLE, Source(path, ""), NOWHERE, why, hint))
        return None
    text = data.removeprefix(BOM).decode("utf-8", _LATIN)
    source = Source(path, compiled_text(name, text.replace("\0", " ")))
    if is_python and (odd := odd_encoding(data, text)) is not None:
        why = f"Python reads this file in another encoding than UTF-8: {odd[1]}"
        findings.append(Finding(Grade.UNREADABLE, source, odd[0], why, _HINT))
    if (span := long_number(text)) is not None:
        why = f"a number of more than {MOST_DIGITS:,} digits: the file is not read"
        findings.append(Finding(Grade.UNREADABLE, source, span, why, ""))
        return None
    if is_code and _may_have_controls(data) and (span := _first_control(text, name)) is not None:
        why = f"the control character U+{ord(text[span.start]):04X} is carried as an escape"
        findings.append(Finding(Grade.APPROXIMATED, source, span, why, "write it as an escape"))
    if data.isascii() and "\0" not in text:
        return source
    if is_code and (at := _first_odd(data, text, name)) is not None:
        why = f"a byte that is not UTF-8 is read as Latin-1: {text[at]!r}"
        if text[at] == "\0":
            why, hint = "a NUL byte is read as a blank", "take it out"
        span = Span(at, at + 1)
        findings.append(Finding(Grade.APPROXIMATED, source, span, why, hint or _HINT))
    return source


def _unreadable(data: bytes) -> tuple[str, str]:
    """Why the bytes of a file are no text that can be read, and what to do."""
    if data[:2] in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE):
        return "the file looks like UTF-16", _HINT
    if len(data) > _MUCH:
        return f"larger than {_MUCH >> 20} MiB, too large to read", "split the file"
    if data.count(0) * 10 > len(data):
        return "the file is no text", ""
    return "", ""


def _may_have_controls(data: bytes) -> bool:
    return not data.isascii() or len(data.translate(None, _CONTROLS)) < len(data)


def _first_control(text: str, name: str) -> Span | None:
    """The first control character, outside of comments, that a text of the model must not hold."""
    found = controls_in_text(_without_comments(text, name).replace("\0", " "))
    return Span(found.start(), found.start() + 1) if found is not None else None


def _without_comments(text: str, name: str) -> str:
    comment = _COMMENT if suffix_of(name) in CODE else _PYTHON_COMMENT
    return comment.sub(lambda m: " " * len(m[0]), text)


def _first_odd(data: bytes, text: str, name: str) -> int | None:
    """Where, outside of comments, the first byte is that is not UTF-8, or NUL."""
    try:
        data.decode("utf-8")
        odd = "\0"
        if odd not in text:
            return None
    except UnicodeDecodeError:
        odd = "\0" + "".join(map(chr, range(0x80, 0x100)))
    blank = _without_comments(text, name)
    return next((i for i, c in enumerate(blank) if c in odd), None)


def _latin(error: UnicodeError) -> tuple[str, int]:
    """What stands for bytes that are no UTF-8: the characters that they are in Latin-1."""
    if not isinstance(error, UnicodeDecodeError):
        raise error
    return error.object[error.start : error.end].decode("latin-1"), error.end


codecs.register_error(_LATIN, _latin)


# --- what is listed -----------------------------------------------------------------------------


def _listed(listing: Listing, name: str, why: str) -> Finding:
    path = shown(listing.files.get(name) or str(Path(listing.root) / name))
    return Finding(Grade.UNREADABLE, Source(path, ""), NOWHERE, why)
