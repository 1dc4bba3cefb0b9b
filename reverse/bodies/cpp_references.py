"""What a reference of C++ is bound to: a value of its own, or the place of another variable."""

from __future__ import annotations

import re

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.bodies import cpp_messages
from rebsync.reverse.bodies.cpp_places import resolve
from rebsync.reverse.bodies.scope import Called, Inline, Record, Scope
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_tree import named, part, text_of

_MAKING = frozenset(
    {
        *("binary_expression", "unary_expression", "cast_expression", "initializer_list"),
        *("number_literal", "char_literal", "string_literal", "true", "false"),
        *("compound_literal_expression", "lambda_expression"),
    }
)
_AS = re.compile(r"as<\w+>\Z")
_CONVERTS = re.compile(r"(?:static_cast<[^&]*>|(?:std::)?u?int\d+_t|int|double|float|bool)\Z")


def is_made(scope: Scope, value: Node) -> bool:
    """Whether an expression makes a value (a prvalue), which is the place of no other variable."""
    match value.type:
        case "parenthesized_expression" if len(named(value)) == 1:
            return is_made(scope, named(value)[0])
        case "conditional_expression":
            ways = (part(value, "consequence"), part(value, "alternative"))
            return all(is_made(scope, way) for way in ways)
        case "call_expression":
            called = text_of(part(value, "function")).removeprefix("this->")
            if _CONVERTS.match(called):
                return True
            if _AS.match(called) and "as" not in scope.functions:
                return True  # of the run-time part: it gives a rebec
            found = scope.functions.get(called)
            function = found.function if isinstance(found, Called | Inline) else None
            return function is not None and not function.gives_place
        case kind:
            return kind in _MAKING


def stays(place: m.Expression, declared: Node) -> bool:
    """Whether the index of an element is the same wherever a reference to it is used."""
    if not isinstance(place, m.Index):
        return False
    names = {n.name for n in m.walk(place.index) if isinstance(n, m.Name | m.Member)}
    block = climb(declared, lambda n: n.type == "compound_statement")
    text = text_of(block) if block is not None else ""
    return not any(re.search(rf"\b{n}_?\s*(?:[-+*/%&|^]?=[^=]|\+\+|--)", text) for n in names)


def message_of(scope: Scope, value: Node) -> str | None:
    """The type of message that an expression is, if it is one that the model knows."""
    match resolve(scope, value):
        case Record(type=type_) if type_:
            return type_
    if value.type == "call_expression" or value.type.endswith(
        ("literal_expression", "new_expression")
    ):
        text = (
            text_of(value.children_by_field_name("function")[0])
            if value.type == ("call_expression")
            else text_of(part(value, "type"))
        )
        made = re.match(r"(?:boost|std)::make_\w+<(.*)>\Z", text)
        return cpp_messages.message_type(scope, made[1] if made else text)
    return None


def is_made_pointer(scope: Scope, value: Node) -> bool:
    """Whether a value is a pointer to a message that is made there."""
    if value.type == "new_expression" or "::make_shared<" in text_of(value).partition("(")[0]:
        return True
    meaning = resolve(scope, value)
    return isinstance(meaning, Record) and meaning.pointer and value.type == "identifier"
