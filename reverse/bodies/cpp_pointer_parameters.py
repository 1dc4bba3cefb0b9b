"""Parameters that are pointers to variables: a name for each, and never null."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_pointers import is_null
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.scope import Record, Variable
from rebsync.reverse.syntax.cpp_declarations import CppParameter
from rebsync.reverse.syntax.cpp_tree import inside as nodes_in
from rebsync.reverse.syntax.cpp_tree import named, text_of


def check_pointer(
    inside: CppStatementReader, parameter: CppParameter, argument: Node, body: Node
) -> None:
    """Raises `Unread` where a pointer is more than a name for a variable; tests of it are true."""
    meaning = inside.scope.locals.get(parameter.name)
    is_variable = isinstance(meaning, Variable)
    leads = is_variable or (isinstance(meaning, Record) and text_of(argument).startswith("&"))
    if not leads or not parameter.is_pointer:
        return
    is_array = isinstance(meaning, Variable) and meaning.type and meaning.type.dimensions
    uses = () if is_variable else ("field_expression",)
    tests = _tests_of(body, parameter.name, ("subscript_expression",) if is_array else uses)
    if tests is None:
        raise inside.unread(body, f'what "{parameter.name}" leads to is not known')
    inside.scope = replace(inside.scope, values={**inside.scope.values, **tests})


def _tests_of(body: Node, name: str, uses: Collection[str]) -> dict[int, m.Expression] | None:
    """What tests of a pointer that leads to a variable give, by the ids of their nodes.

    None where the body does more with it than `*p`, to hand it on, and what `uses` says.
    """
    found: dict[int, m.Expression] = {}
    for node in (n for n in nodes_in(body, "identifier") if text_of(n) == name):
        above = node.parent
        kind = above.type if above is not None else ""
        if above is None or kind in ("argument_list", *uses):
            continue
        match kind, text_of(above.children[0]), above.child_by_field_name("operator"):
            case "pointer_expression", "*", _:
                pass
            case ("condition_clause", _, _) | ("unary_expression", "!", _):
                found[node.id] = m.BoolLiteral(True)
            case "binary_expression", _, Node() as sign if text_of(sign) in ("&&", "||"):
                found[node.id] = m.BoolLiteral(True)
            case "binary_expression", _, Node() as sign if any(map(is_null, named(above))):
                found[above.id] = m.BoolLiteral(text_of(sign) == "!=")
            case _:
                return None
    return found
