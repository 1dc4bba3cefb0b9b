"""One command in this process: its status and what it printed, and what is wrong with that."""

from __future__ import annotations

import io
import json
import os
import re
import signal
import sys
import time
import traceback
import unicodedata
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from typing import NoReturn
from xml.parsers import expat

ALLOWED = (0, 1, 2, 3, 4)
_DATA = ("fmt", "export", "extract", "new", "diff", "sync", "generate")  # may print their inputs


class TooSlow(BaseException):
    """A command that has used up its time."""


@dataclass(frozen=True)
class Ran:
    """What came of one command; `wrong` is empty, or says what is wrong."""

    arguments: tuple[str, ...]
    status: int | None
    seconds: float
    out: bytes
    err: bytes
    wrong: str = ""
    details: str = ""


class _Stream(io.TextIOWrapper):
    """Standard output as a command sees it; `seen` says whether somebody looks at a terminal."""

    def __init__(self, seen: bool) -> None:
        super().__init__(io.BytesIO(), encoding="utf-8", write_through=True)
        self.seen = seen

    def isatty(self) -> bool:
        return self.seen

    def value(self) -> bytes:
        raw = self.buffer
        assert isinstance(raw, io.BytesIO)
        return raw.getvalue()


def run(arguments: Sequence[str], folder: Path, seconds: float, seen: bool = False) -> Ran:
    """Runs a command in a folder, for so many seconds at most."""
    from rebsync.cli import main

    out, err = _Stream(seen), _Stream(seen)
    kept = sys.stdout, sys.stderr, sys.stdin
    before = Path.cwd()
    status, wrong, details = None, "", ""
    began = time.monotonic()
    os.chdir(folder)
    sys.stdout, sys.stderr, sys.stdin = out, err, io.TextIOWrapper(io.BytesIO())
    try:
        with _limited(seconds), warnings.catch_warnings():
            warnings.simplefilter("error")
            status = main(list(arguments))
    except TooSlow:
        wrong, details = "slow", traceback.format_exc(limit=-12)
    except BaseException as error:
        wrong, details = _name(error), traceback.format_exc(limit=-12)
    finally:
        sys.stdout, sys.stderr, sys.stdin = kept
        os.chdir(before)
    took = time.monotonic() - began
    printed = out.value(), err.value()
    wrong = wrong or _wrong(arguments, status, *printed, seen)
    return Ran(tuple(arguments), status, took, *printed, wrong, details)


@contextmanager
def _limited(seconds: float) -> Iterator[None]:
    def stop(_: int, __: FrameType | None) -> NoReturn:
        raise TooSlow

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, seconds, 1.0)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def _name(error: BaseException) -> str:
    """The kind of an exception and the innermost place of rebsync's that it went through."""
    places = [
        f"{Path(frame.filename).name}:{frame.name}"
        for frame in traceback.extract_tb(error.__traceback__)
        if "/tests/" not in frame.filename and "/lib/python" not in frame.filename
    ]
    return f"{type(error).__name__} in {places[-1] if places else '?'}"


def _wrong(arguments: Sequence[str], status: int | None, out: bytes, err: bytes, seen: bool) -> str:
    if status not in ALLOWED:
        return f"exit status {status}"
    if b"Traceback (most" in err:
        return "a traceback"
    forms = [form for form in ("json", "sarif", "junit", "svg", "html") if form in arguments]
    data = (arguments[0] in _DATA and not seen) or forms
    texts = [err] if data else [out, err]
    if any(_obeyed(text, seen) for text in texts):
        return f"{arguments[0]}: something that a terminal obeys"
    return _ill_formed(forms, status, out)


def _obeyed(data: bytes, seen: bool) -> bool:
    """Whether controls but line ends and tabs are in a text; colours are rebsync's own."""
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError:
        return True
    if seen:
        text = re.sub(r"\x1b\[[\d;]*[mK]|\r(?=\x1b\[K)", "", text)
    odd = (c for c in text if not c.isprintable() and c not in "\n\t")
    return any(unicodedata.category(c) in ("Cc", "Cf", "Cs", "Zl", "Zp") for c in odd)


def _ill_formed(forms: Sequence[str], status: int, out: bytes) -> str:
    if not out or status == 2:
        return ""
    try:
        if "json" in forms or "sarif" in forms:
            for line in (out.decode("utf-8"),):
                _decoded(line)
        elif "junit" in forms or "svg" in forms:
            expat.ParserCreate().Parse(out, True)
    except (ValueError, expat.ExpatError) as error:
        return f"ill-formed {forms[0]}: {type(error).__name__}"
    return ""


def _decoded(text: str) -> None:
    """One JSON value after another."""
    decoder, at = json.JSONDecoder(), 0
    while text[at:].strip():
        at += len(text[at:]) - len(text[at:].lstrip())
        _, at = decoder.raw_decode(text, at)
