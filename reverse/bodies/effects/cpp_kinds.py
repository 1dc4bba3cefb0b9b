"""Kinds of nodes of C++ by what they may do to a model."""

from __future__ import annotations

_COROUTINES = ("co_await_expression", "co_yield_statement", "co_return_statement")
LEAVES = {
    "ERROR": "this does not parse as C++",
    "return_statement": "this leaves the function",
    "throw_statement": "an exception leaves the function",
    "goto_statement": "the model has no goto",
    "gnu_asm_expression": "the model has no assembly",
    **dict.fromkeys(_COROUTINES, "the model has no coroutines"),
}
LOOPS = frozenset({"for_statement", "while_statement", "do_statement", "for_range_loop"})
# The operators whose right operand may not be evaluated.
SHORT_CIRCUIT = frozenset({"&&", "||", "and", "or"})
REPEATED = LOOPS | {"switch_statement"}
# What touches nothing, whatever it is: not looked into, as most of all nodes are of these.
PLAIN = frozenset(
    {
        *("identifier", "field_identifier", "type_identifier", "namespace_identifier", "this"),
        *("number_literal", "string_literal", "char_literal", "true", "false", "null", "comment"),
        *("primitive_type", "sized_type_specifier"),
    }
)
# Methods that leave a text as it is, besides those of all containers.
OF_TEXTS = frozenset(
    {"compare", "find", "rfind", "substr", "starts_with", "ends_with", "contains"}
    | {f"find_{way}_{of}" for way in ("first", "last") for of in ("of", "not_of")}
)
# Declarations that do nothing when they are run.
NOTHING = frozenset(
    {"using_declaration", "alias_declaration", "type_definition", "static_assert_declaration"}
)
