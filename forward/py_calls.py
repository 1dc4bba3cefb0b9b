"""Calls of the model in Python: sends, local methods, what the language has built in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rebsync import model as m
from rebsync.forward.sends import Send, ToAny, ToKnown, ToSelf, send_of
from rebsync.static.symbols import MethodSymbol
from rebsync.unions import assert_never

if TYPE_CHECKING:
    from rebsync.forward.py_expression_writer import PyExpressionWriter

_BUILT_IN = {
    "pow": "power",
    "sqrt": "square_root",
    "delay": "self._mailbox.delay",
    "assertion": "self._mailbox.assertion",
}


def call(e: PyExpressionWriter, expression: m.Call) -> str:
    """A call; Python evaluates its arguments from left to right, as the model does."""
    send = send_of(expression, e.analysis)
    if send is None:
        return _function(e, expression)
    types = tuple(p.type for p in send.server.declaration.parameters)
    values = [e.stored(a, t) for a, t in zip(expression.arguments, types, strict=True)]
    if isinstance(send.target, ToAny):
        assert expression.target is not None
        values.insert(0, e.text(_bare(expression.target)))
    times = {"after": expression.after, "deadline": expression.deadline}
    timed = [f"{word}={e.text(time)}" for word, time in times.items() if time is not None]
    if timed:
        values.append(f"When({', '.join(timed)})")
    return f"self.{_helper(e, send)}({', '.join(values)})"


def _bare(target: m.Expression) -> m.Expression:
    return _bare(target.inner) if isinstance(target, m.Paren) else target


def _helper(e: PyExpressionWriter, send: Send) -> str:
    key = e.topics.called(send.server).key
    match send.target:
        case ToSelf():
            return e.names.self_sends[key]
        case ToKnown(known):
            return e.names.sends[(f"known {known}", key)]
        case ToAny(class_name):
            return e.names.sends[(f"any {class_name}", key)]
        case _:
            assert_never(send.target)


def _function(e: PyExpressionWriter, expression: m.Call) -> str:
    symbol = e.analysis.symbols.get(id(expression))
    if isinstance(symbol, MethodSymbol):
        parameters = symbol.declaration.parameters
        pairs = zip(expression.arguments, parameters, strict=True)
        values = ", ".join(e.stored(a, p.type) for a, p in pairs)
        owner = "super()" if isinstance(expression.target, m.Super) else "self"
        return f"{owner}.{e.names.function(expression.name, parameters)}({values})"
    values = ", ".join(map(e.text, expression.arguments))
    return f"{_BUILT_IN[expression.name]}({values})"
