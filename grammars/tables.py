"""Grammars compiled to parser tables, kept in the user's cache between runs."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from lark import Lark

from rebsync import __version__


def cache_directory() -> Path | None:
    """Where tables are kept: `$REBSYNC_CACHE`, else the user's cache; None if not writable."""
    chosen = os.environ.get("REBSYNC_CACHE")
    base = os.environ.get("XDG_CACHE_HOME")
    folder = (
        Path(chosen) if chosen else (Path(base) if base else Path.home() / ".cache") / "rebsync"
    )
    try:
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)
    except OSError:
        return None
    return folder if os.access(folder, os.W_OK) else None


def load(grammar: str, start: list[str], transformer: object = None) -> Lark:
    """An LALR parser for a grammar text; its tables come from the cache where possible."""
    folder = cache_directory()
    cached = (
        str(folder / f"{'-'.join(start)}-{__version__}-{sys.hexversion:x}.tables")
        if folder
        else False
    )
    return Lark(
        grammar,
        parser="lalr",
        lexer="basic",
        start=start,
        keep_all_tokens=True,
        maybe_placeholders=False,
        transformer=transformer,
        cache=cached,
    )
