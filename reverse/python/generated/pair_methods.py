"""Functions of generated Python that give what the model has no type for: several values, texts.

Where a method is called that gives several values at once, these stand in its place: attributes of
the object, and numbers.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from tree_sitter import Node

from rebsync.reverse.python.generated.module_variables import imported_as
from rebsync.reverse.python.generated.py_types import is_text, type_of
from rebsync.reverse.python.values.py_callbacks import body_of
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import PyCode, Scope
from rebsync.reverse.syntax.py_tree import calls_in, field, is_label, named, text_of

_TIMES = frozenset({"When", "AT_ONCE"})
_PLAIN = frozenset({"attribute", "subscript", "integer", "true", "false", "identifier"})
_TEXTS = frozenset({"string", "concatenated_string"})
_TUPLES = (["expression_list"], ["tuple"])


def values_given(function: Scope) -> list[Node]:
    """The values of `return self._x, self._y`, if a method does no more; empty for any other."""
    body = [s for s in body_of(function) if not is_text(s)]
    given = named(body[0]) if len(body) == 1 and body[0].type == "return_statement" else []
    takes = [p.name for p in function.parameters]
    if takes != ["self"] or [g.type for g in given] not in _TUPLES:
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


def is_alone(code: PyCode, function: Scope) -> bool:
    """Whether a method, or property, is the only one of its name, by which alone it runs."""
    is_written = [*function.decorators] in ([], ["property"])
    is_written = is_written or is_context(function.module, function)
    is_called = is_written and function.name[:2] != "__"
    return is_called and len(code.methods.get(function.name, ())) == 1


def is_context(module: Scope, function: Scope) -> bool:
    """Whether a function only makes contexts: `@contextmanager`."""
    whole = [imported_as(module, each) for each in function.decorators]
    return whole == ["contextlib.contextmanager"]


def takes_time(parameter: Node) -> bool:
    """Whether a parameter is said to be the time of a send, which no variable of a model holds."""
    said = (parameter.child_by_field_name(name) for name in ("type", "value"))
    words = (text_of(node).strip("\"'").rpartition(".")[2] for node in said if node is not None)
    return any(word in _TIMES for word in words)


def is_inlined(code: PyCode, function: Scope, callers: Iterable[Scope]) -> bool:
    """Whether what a method does stands where it is called: it takes a time of sends.

    All of the package that names it are calls of it by its object, in methods of the model.
    """
    is_async = any(child.type == "async" for child in function.node.children)
    if function.decorators or is_async or not any(map(takes_time, function.parameter_nodes)):
        return False
    word = re.compile(rf"\b{re.escape(function.name)}\b")
    named_so = sum(len(word.findall(m.py.source.text)) for m in code.modules.values())
    calls = [text_of(field(call, "function")) for f in callers for call in calls_in(f.node)]
    return named_so == 1 + calls.count(f"self.{function.name}")


def is_beside(function: Scope) -> bool:
    """Whether a function gives what no variable of a model holds, such as a text: none has it.

    What it does where it is called is asked of the form.
    """
    said = function.node.child_by_field_name("return_type")
    if said is not None:
        return type_of(said) is None
    values = [v for r in function.returns for v in named(r)]
    return bool(values) and all(map(_is_text, values))


def _is_text(node: Node) -> bool:
    if node.type == "conditional_expression":
        then, _, otherwise = named(node)
        return _is_text(then) and _is_text(otherwise)
    return node.type in _TEXTS
