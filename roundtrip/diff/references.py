"""Tells apart what two sides write alike and mean otherwise, by what a name in it refers to."""

from __future__ import annotations

from typing import cast

from rebsync import model as m
from rebsync.roundtrip.diff.tokens import Tokens
from rebsync.static.symbols import (
    EnvSymbol,
    KnownRebecSymbol,
    LocalSymbol,
    ParameterSymbol,
    RebecSymbol,
    StateSymbol,
)

_KINDS: tuple[tuple[type, str], ...] = (
    (LocalSymbol, "a local variable"),
    (ParameterSymbol, "a parameter"),
    (StateSymbol, "a state variable"),
    (KnownRebecSymbol, "a known rebec"),
    (EnvSymbol, "an env variable"),
    (RebecSymbol, "a rebec"),
)


def apart_by_reference(
    text: str, left: tuple[Tokens, object], right: tuple[Tokens, object]
) -> tuple[str, str]:
    """A text of both sides, for each with what the first name in it is that refers elsewhere.

    The sides are trees of a comparison. What no name tells apart stays as it is.
    """
    for a, b in zip(_names(left[1]), _names(right[1]), strict=False):
        if a.name != b.name:
            one, other = _referred(left[0], a), _referred(right[0], b)
            if one is not None and other is not None and one != other:
                return f"{text}, {one}", f"{text}, {other}"
    return text, text


def _names(tree: object) -> list[m.Name | m.Member]:
    if not hasattr(tree, "__dataclass_fields__"):
        return []
    return [node for node in m.walk(cast("m.Node", tree)) if isinstance(node, m.Name | m.Member)]


def _referred(tokens: Tokens, made: m.Name | m.Member) -> str | None:
    """What a name refers to: its kind, and for a variable of a body its type and place."""
    written = tokens.written(made)
    symbol = tokens.side.analysis.symbol_of(written)
    kind = next((said for type_, said in _KINDS if isinstance(symbol, type_)), None)
    if kind is None or not isinstance(written, m.Name | m.Member):
        return None
    if not isinstance(symbol, LocalSymbol):
        return f"{written.name} being {kind}"
    place = tokens.side.place(symbol.declaration.name_span)
    where = f" of line {place.line}" if place is not None else ""
    return f"{written.name} being {kind} ({symbol.type}){where}"
