"""Methods of generated Python that give several values at once, which the model has no type for.

Where one is called, what it gives stands in its place: attributes of the object, and numbers.
"""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.python.generated.py_types import is_text
from rebsync.reverse.python.values.py_callbacks import body_of
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import PyCode, Scope
from rebsync.reverse.syntax.py_tree import field, is_label, named, text_of

_PLAIN = frozenset({"attribute", "subscript", "integer", "true", "false", "identifier"})
_TUPLES = (["expression_list"], ["tuple"])


def values_given(code: PyCode, function: Scope) -> list[Node]:
    """The values of `return self._x, self._y`, if a method does no more; empty for any other."""
    body = [s for s in body_of(function) if not is_text(s)]
    is_alone = len(code.methods.get(function.name, ())) == 1 and not function.decorators
    given = named(body[0]) if len(body) == 1 and body[0].type == "return_statement" else []
    takes = [p.name for p in function.parameters]
    if not is_alone or takes != ["self"] or [g.type for g in given] not in _TUPLES:
        return []
    values = named(given[0])
    inside = [n for v in values for n in nodes_in(v) if n.is_named]
    is_plain = all(n.type in _PLAIN for n in inside) and all(
        text_of(field(n, "object")) == "self" for n in inside if n.type == "attribute"
    )
    names = {
        text_of(n)
        for v in values
        for n in nodes_in(v)
        if n.type == "identifier" and not is_label(n)
    }
    return values if is_plain and names <= {"self"} else []
