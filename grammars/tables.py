"""Grammars compiled to parser tables, kept in the user's cache between runs."""

from __future__ import annotations

import hashlib
import json
import sys
from typing import TypeVar

import lark
from lark import Lark
from lark.grammar import Rule
from lark.lexer import TerminalDef

from rebsync import __version__
from rebsync.cache import open_cache

T = TypeVar("T")
_MOST = 20  # grammars, of a few versions


def load(grammar: str, start: list[str], transformer: object = None) -> Lark:
    """An LALR parser for a grammar text; its tables come from the cache where possible."""
    cache = open_cache("tables")
    if cache is None:
        return _compiled(grammar, start, transformer)
    made_for = "\0".join((*start, __version__, lark.__version__, sys.version, grammar))
    name = hashlib.sha256(made_for.encode()).hexdigest()
    text = cache.load(name)
    if text is not None:
        return _deserialised(text, transformer)
    compiled = _compiled(grammar, start, transformer)
    cache.store(name, _serialised(compiled))
    cache.tidy(_MOST)
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


# --- tables as JSON ------------------------------------------------------------------------------


def _serialised(compiled: Lark) -> bytes:
    data, memo = compiled.memo_serialize([TerminalDef, Rule])
    data["options"].pop("transformer")
    return json.dumps({"data": data, "memo": memo}, separators=(",", ":")).encode("ascii")


def _deserialised(text: bytes, transformer: object) -> Lark:
    """The parser that a text tells; in JSON the numbers of states and tokens are texts."""
    tables = json.loads(text)
    parser = tables["data"]["parser"]["parser"]
    memo, parser["tokens"] = _by_number(tables["memo"]), _by_number(parser["tokens"])
    states = {state: _by_number(actions) for state, actions in parser["states"].items()}
    parser["states"] = _by_number(states)
    data = tables["data"]
    return Lark._load_from_dict(data, memo, transformer=transformer)  # type: ignore[no-untyped-call, no-any-return]


def _by_number(table: dict[str, T]) -> dict[int, T]:
    return dict(zip(map(int, table), table.values(), strict=True))
