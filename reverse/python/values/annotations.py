"""Annotations that Python evaluates when it makes a class, and that name what is not bound then.

Without `from __future__ import annotations` each is evaluated where it stands (PEP 563): a name
that is bound later, or only for type checkers, ends the import of the module.
"""

from __future__ import annotations

import builtins
from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_bindings import Binding
from rebsync.reverse.syntax.py_index import FUNCTION, Scope
from rebsync.reverse.syntax.py_tree import field, named, text_of

_CHECKING = frozenset({"TYPE_CHECKING", "typing.TYPE_CHECKING"})
_PARAMETERS = frozenset({"typed_parameter", "typed_default_parameter"})
_BUILT_IN = frozenset(dir(builtins)) | {"__name__", "__file__"}


def unbound_annotations(scope: Scope) -> Iterator[tuple[Node, str]]:
    """The names in annotations of a class that nothing has bound when it is made, with why."""
    if any(_is_future(s) for s in named(scope.module.node)):
        return
    for annotation in _evaluated(scope.node):
        for node in nodes_in(annotation):
            if node.type == "identifier" and _is_name(node) and not _is_bound(node, scope):
                yield node, f'"{text_of(node)}" is not bound where this annotation is evaluated'


def _is_future(statement: Node) -> bool:
    return statement.type == "future_import_statement" and "annotations" in text_of(statement)


def _evaluated(node: Node) -> Iterator[Node]:
    """The annotations of a class and of the heads of its functions."""
    match node.type:
        case "function_definition":
            for parameter in named(field(node, "parameters")):
                if parameter.type in _PARAMETERS:
                    yield field(parameter, "type")
            if (gives := node.child_by_field_name("return_type")) is not None:
                yield gives
        case "assignment" if (said := node.child_by_field_name("type")) is not None:
            yield said
        case "lambda" | "call":
            return
        case _:
            for child in named(node):
                yield from _evaluated(child)


def _is_name(node: Node) -> bool:
    """Whether a word is a name that is looked up, not an attribute or a keyword."""
    above = node.parent
    if above is None or above.type not in ("attribute", "keyword_argument"):
        return True
    first = named(above)[0]
    return above.type == "attribute" and first == node


def _is_bound(node: Node, owner: Scope) -> bool:
    name, scope = text_of(node), owner
    if name in _BUILT_IN or "*" in owner.module.names:
        return True
    while True:
        is_later = scope.kind == FUNCTION  # one around, which has run up to here, or further
        bindings = scope.names.get(name, ())
        if any(not _is_for_checkers(b) and (is_later or _is_before(b, node)) for b in bindings):
            return True
        if scope.parent is None:
            return False
        scope = scope.parent


def _is_before(binding: Binding, node: Node) -> bool:
    return binding.node.end_byte <= node.start_byte


def _is_for_checkers(binding: Binding) -> bool:
    """Whether only type checkers see what binds a name."""
    below = binding.node
    for above in ancestors(binding.node):
        is_asked = above.type == "if_statement" and text_of(field(above, "condition")) in _CHECKING
        if is_asked and field(above, "consequence") == below:
            return True
        below = above
    return False
