"""What the parameters of a lambda get where it has a name and is only called by it."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_declarations import lambda_parameters
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.reverse.values.cpp_flow import Texts, scope_of
from rebsync.reverse.values.cpp_flow_types import Variable


def arguments_of(texts: Texts, variable: Variable) -> list[Node] | None:
    """The arguments that the calls of a lambda give for one of its parameters.

    None where something else may call it, or where a call leaves the parameter out.
    """
    lambda_ = variable.scope
    holder = lambda_.parent if lambda_ is not None else None
    if lambda_ is None or holder is None or holder.type != "init_declarator":
        return None
    name, index = part(holder, "declarator"), _index(lambda_, variable)
    declaration = holder.parent
    scope = scope_of(declaration) if declaration is not None else None
    if name.type != "identifier" or index is None or scope is None:
        return None
    found: list[Node] = []
    for place in texts.within(variable.cpp, text_of(name), name.end_byte, scope.end_byte):
        call = place.parent
        if call is None or call.type != "call_expression" or part(call, "function") != place:
            return None
        given = named(part(call, "arguments"))
        if index >= len(given) or _inside(call, lambda_):
            return None
        found.append(given[index])
    return found or None


def _index(lambda_: Node, variable: Variable) -> int | None:
    """Which parameter of a lambda a variable is."""
    for index, parameter in enumerate(lambda_parameters(lambda_)):
        if parameter.start_byte <= variable.name.start_byte < parameter.end_byte:
            return index
    return None


def _inside(node: Node, lambda_: Node) -> bool:
    """Whether a lambda calls itself there."""
    return climb(node, lambda n: n == lambda_) is not None
