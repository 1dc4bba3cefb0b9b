"""What stands around the names and types of declarations ([dcl.decl])."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.reverse.ir import types as t
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_declarations import REFERRING, declared_name
from rebsync.reverse.syntax.cpp_tree import Cpp, named, text_of

_NOT_ONE_ELEMENT = frozenset({"initializer_list", "initializer_pair", "parameter_pack_expansion"})
_TEXTS = frozenset({"string_literal", "concatenated_string", "raw_string_literal"})


def has_const(type_: Node) -> bool:
    """Whether `const` stands beside the type, within the same declaration."""
    parent = type_.parent
    return parent is not None and any(
        c.type == "type_qualifier" and text_of(c) in ("const", "constexpr")
        for c in parent.named_children
    )


def is_template_parameter(cpp: Cpp, node: Node) -> bool:
    """Whether a name is that of a parameter of a template around, which any type may be."""
    if b"template" not in cpp.words:
        return False
    templates = (n for n in ancestors(node) if n.type == "template_declaration")
    lists = (n.child_by_field_name("parameters") for n in templates)
    parameters = (p for list_ in lists if list_ is not None for p in named(list_))
    names = (c for p in parameters for c in named(p) if c.type == "type_identifier")
    return any(name.text == node.text for name in names)


def is_pointer_to_function(node: Node) -> bool:
    """Whether it is `(*f)(int)`."""
    inner = node.child_by_field_name("declarator")
    return inner is None or inner.type in (
        "parenthesized_declarator",
        "abstract_parenthesized_declarator",
    )


def inner_declarator(node: Node) -> Node | None:
    """The inner declarator of a reference, which the grammar has in no field."""
    inner = [c for c in named(node) if c.type != "type_qualifier"]
    return inner[-1] if inner else None


def variable_name(declarator: Node) -> Node | None:
    """The name of a variable, also of one that points or refers to functions: `(*f)(int)`."""
    inner = declarator.child_by_field_name("declarator")
    if declarator.type != "function_declarator" or inner is None:
        return declared_name(declarator)
    is_led = inner.type == "parenthesized_declarator" and inner.named_children
    return declared_name(inner) if is_led and inner.named_children[-1].type in REFERRING else None


def deduced_length(declarator: Node, element: t.Type) -> int | None:
    """How many elements its braces give to an array of unknown bound ([dcl.init.aggr]).

    None for parameters, and where braces may be elided or a text is the elements.
    """
    around = declarator.parent
    is_pointer = around is not None and around.type == "pointer_declarator"
    while around is not None and around.type == "pointer_declarator":
        around = around.parent
    value = around.child_by_field_name("value") if around is not None else None
    if value is None or value.type != "initializer_list" or value.has_error:
        return None
    is_text = is_pointer or isinstance(element, t.Text)
    if not is_text and not isinstance(element, t.Integer | t.Float | t.Truth):
        return None
    odd = _NOT_ONE_ELEMENT if is_text else _NOT_ONE_ELEMENT | _TEXTS
    parts = named(value)
    is_odd = any(n.type in odd or n.type.startswith("preproc") for n in parts)
    return None if is_odd else len(parts) or None
