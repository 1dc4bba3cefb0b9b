"""Where functions of generated Python give None in place of their result."""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.reverse.analysis.python.none_values import falls_through
from rebsync.reverse.findings import Unread
from rebsync.reverse.python.bodies.body_form import PyForm
from rebsync.reverse.python.values.py_callbacks import body_of
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_tree import named

_HINT = "return something on each way"


def without_result(form: PyForm, function: Scope) -> Iterator[Unread]:
    """The places where a function with a result ends without one; in the model it would have 0."""
    py = function.py
    for node in function.returns:
        if all(value.type == "none" for value in named(node)):
            yield Unread(py.span(node), "this gives no result", _HINT)
    last = [s.type for s in body_of(function)][-1:]
    if last and last[0] not in ("return_statement", "raise_statement"):
        lowered, _ = form.statements(py, py.span(function.node))
        if lowered is None or falls_through(lowered.body):
            yield Unread(py.span(function.node), "this may end without a result", _HINT)
