"""First values of state variables: what a constructor of the model stores before its own body."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.models.building import is_default
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.syntax.py_index import Scope

_SHARED = "descendants start with this value too, and the model runs one constructor of a rebec"
_HINT = "store it in the constructor of each class"


def stores(
    values: Iterable[tuple[str, Node, Scope]],
    names: dict[str, tuple[str, m.Type, Node]],
    reader: ModelExpressionReader,
    findings: Findings,
    within: str,
) -> Iterator[m.Statement]:
    """One assignment per first value that no variable of the model starts with by itself.

    `values` are attributes, what is stored in each, and the function that does it, in the order of
    execution; `names` has the name in the model of each attribute.

    Unreadable: values that a class shares with its descendants (`_wire`), whose constructors do
    not call its own.
    """
    given: set[str] = set()
    for attribute, value, function in values:
        read = reader.expression(value)
        if attribute in given or not is_default(read):
            span = function.py.span(value)
            if function.name != "__init__":
                unread = Unread(span, _SHARED, _HINT)
                findings.unreadable(function.py.source, unread, within)
            else:
                assign = m.Assign("=", m.Name(names[attribute][0]), read)
                yield m.ExpressionStatement(assign, span=span)
        given.add(attribute)
