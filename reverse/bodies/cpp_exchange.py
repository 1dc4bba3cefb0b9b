"""Calls that store a value and give the one before: `std::exchange`, `x.fetch_add(e)`."""

from __future__ import annotations

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies.cpp_expression_reader import Exchange
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.effects.cpp_kinds import SHORT_CIRCUIT
from rebsync.reverse.bodies.scope import Variable
from rebsync.reverse.bodies.types.cpp_conversions import converted_to, operands, place_of
from rebsync.reverse.bodies.types.cpp_widths import check
from rebsync.reverse.models.building import bare, binary, is_calm, is_place
from rebsync.reverse.syntax.cpp_tree import named, part, text_of


def exchanged(reader: CppStatementReader, node: Node, call: Exchange) -> Variable:
    """Stores the new value before the statement that is read; the local with the old one."""
    written = bare(reader.expressions.read(call.target))
    place, span = place_of(reader.scope, written), reader.cpp.span(node)
    is_plain = place.type is not None and not place.type.dimensions
    if not _is_first(node):
        raise reader.unread(node, "what else is evaluated before this is not known", "use a local")
    if not is_plain or not is_place(written) or not is_calm(written):
        raise reader.unread(node, "the model has nothing that exchanges this")
    if call.operator:
        check(reader.expressions, node, call.operator, (call.target, call.value))
        sides = operands(reader.scope, call.operator, written, reader.expressions.read(call.value))
        value = converted_to(reader.scope, binary(*sides), place)
    else:
        value = reader.expressions.stored(call.value, place)
    if not is_calm(value):
        raise reader.unread(call.value, "this is evaluated once here, and later there")
    name = reader.fresh("before", inlining=True)
    old = Variable(name, place.type, place.bits, (), place.wide)
    reader.scope.results[name] = old
    store = m.ExpressionStatement(m.Assign("=", written, value, span), (), span)
    reader.before += [reader.local(node, old, written), store]
    return old


def _is_first(node: Node) -> bool:
    """Whether a statement, or the condition of one, evaluates nothing before a call."""
    above = node.parent
    match above.type if above is not None else "":
        case "expression_statement" | "return_statement":
            return True
        case "condition_clause":
            return above is not None and above.parent is not None and _chooses(above.parent)
        case "parenthesized_expression" | "unary_expression":
            return above is not None and _is_first(above)
        case "binary_expression" if above is not None:
            left, right = part(above, "left"), part(above, "right")
            first = text_of(part(above, "operator")) in SHORT_CIRCUIT
            alone = right.type == "number_literal" or first
            return left == node and alone and _is_first(above)
        case "init_declarator" if above is not None and above.parent is not None:
            one = len(above.parent.children_by_field_name("declarator")) == 1
            return one and above.parent.type == "declaration" and not _is_in_head(above.parent)
        case "assignment_expression" if above is not None:
            named_ = part(above, "left").type == "identifier"
            return named_ and part(above, "right") == node and _is_first(above)
        case "argument_list" if above is not None and above.parent is not None:
            call = above.parent
            plain = call.type == "call_expression" and len(named(above)) == 1
            return plain and part(call, "function").type == "identifier" and _is_first(call)
        case _:
            return False


def _chooses(node: Node) -> bool:
    return node.type in ("if_statement", "switch_statement")


def _is_in_head(declaration: Node) -> bool:
    """Whether a declaration stands in the head of a statement, which may be a loop."""
    above = declaration.parent
    return above is None or above.type not in ("compound_statement", "case_statement")
