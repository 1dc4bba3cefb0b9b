"""Grammars compiled to parser tables, kept in the user's cache between runs."""

from __future__ import annotations

import hashlib
import os
import pickle
import secrets
import sys
from contextlib import suppress
from io import BytesIO
from pathlib import Path
from typing import Any, NoReturn

import lark
from lark import Lark

from rebsync import __version__
from rebsync.cache import cache_directory, is_ours


def load(grammar: str, start: list[str], transformer: object = None) -> Lark:
    """An LALR parser for a grammar text; its tables come from the cache where possible."""
    folder = cache_directory()
    if folder is None:
        return _compiled(grammar, start, transformer)
    path = folder / f"{'-'.join(start)}-{__version__}-{sys.hexversion:x}.tables"
    made_for = f"{lark.__version__}\n{sys.version}\n{grammar}".encode()
    tables = _kept(path, made_for)
    if tables is not None:
        return Lark._load_from_dict(**tables, transformer=transformer)  # type: ignore[no-untyped-call, no-any-return]
    compiled = _compiled(grammar, start, transformer)
    _keep(path, made_for, compiled)
    return compiled


def _compiled(grammar: str, start: list[str], transformer: object) -> Lark:
    return Lark(
        grammar,
        parser="lalr",
        lexer="basic",
        start=start,
        keep_all_tokens=True,
        maybe_placeholders=False,
        transformer=transformer,
    )


# --- the file: a digest, then the pickled tables -------------------------------------------------

_DIGEST = 32


class _PlainData(pickle.Unpickler):
    """Reads dictionaries, lists, texts and numbers, nothing that could run."""

    def find_class(self, module: str, name: str) -> NoReturn:
        raise pickle.UnpicklingError(f"tables do not contain {module}.{name}")


def _kept(path: Path, made_for: bytes) -> dict[str, Any] | None:
    """The tables in a file; None unless this user wrote it, for the same grammar, and whole."""
    try:
        if not path.is_file() or not is_ours(path.stat()):
            return None
        data = path.read_bytes()
    except OSError:
        return None
    digest, pickled = data[:_DIGEST], data[_DIGEST:]
    if digest != _digest(made_for, pickled):
        return None
    try:
        tables = _PlainData(BytesIO(pickled)).load()
    except pickle.UnpicklingError:
        return None
    return tables if isinstance(tables, dict) else None


def _keep(path: Path, made_for: bytes, compiled: Lark) -> None:
    buffer = BytesIO()
    compiled.save(buffer, exclude_options=("transformer",))
    pickled = buffer.getvalue()
    staged = path.with_name(f"{path.name}.{secrets.token_hex(4)}.tmp")
    try:
        handle = os.open(staged, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
        with os.fdopen(handle, "wb") as file:
            file.write(_digest(made_for, pickled) + pickled)
        staged.replace(path)
    except OSError:
        with suppress(OSError):
            staged.unlink()


def _digest(made_for: bytes, pickled: bytes) -> bytes:
    return hashlib.sha256(made_for + b"\0" + pickled).digest()
