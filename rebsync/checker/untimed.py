"""What core Rebeca has not: time and priorities."""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.diagnostics import Diagnostic
from rebsync.model import Annotation, Call, Name, walk
from rebsync.source import Span
from rebsync.static import Analysis
from rebsync.static.symbols import BuiltinFunctionSymbol, BuiltinSymbol

_PRIORITIES = ("priority", "globalPriority")


def check_untimed(analysis: Analysis) -> tuple[Diagnostic, ...]:
    """Everything in a model that core Rebeca has no meaning for."""
    hint = "check it as a timed model, without --language core"
    return tuple(
        Diagnostic("RS926", span, f"core Rebeca has no {what}", hint)
        for span, what in _timed(analysis)
    )


def _timed(analysis: Analysis) -> Iterator[tuple[Span, str]]:
    for node in walk(analysis.model):
        match node:
            case Call(after=after, deadline=deadline):
                for time, word in ((after, "after"), (deadline, "deadline")):
                    if time is not None:
                        yield time.span, word
                symbol = analysis.symbol_of(node)
                if isinstance(symbol, BuiltinFunctionSymbol) and symbol.name == "delay":
                    yield node.span, "delay"
            case Name(name):
                symbol = analysis.symbol_of(node)
                if isinstance(symbol, BuiltinSymbol) and name not in ("self", "super", "sender"):
                    yield node.span, name
            case Annotation(name) if name in _PRIORITIES:
                yield node.span, f"@{name}"
