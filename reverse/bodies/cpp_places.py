"""What an expression of C++ that names a place stands for: a variable, a message, a field of it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from tree_sitter import Node

from rebsync.reverse.bodies.scope import (
    Itself,
    Meaning,
    Outside,
    Publishes,
    Record,
    Scope,
    Variable,
)
from rebsync.reverse.syntax.cpp_tree import named, part, text_of

HELD = "*"  # the path of the value in an optional
_GET = re.compile(r"std::get<(\d+)>")
_SAME = frozenset({"std::move", "std::ref", "std::cref", "boost::ref", "boost::cref"})


def resolve(scope: Scope, node: Node) -> Meaning | None:
    """What a place stands for; None for one whose name is not known, and for other expressions."""
    match node.type:
        case "identifier":
            return scope.meaning(text_of(node))
        case "qualified_identifier":
            name = text_of(node)
            return scope.locals.get(name) or scope.members.get(name.rpartition("::")[2])
        case "parenthesized_expression" if len(named(node)) == 1:
            return resolve(scope, named(node)[0])
        case "pointer_expression":
            inner = resolve(scope, part(node, "argument"))
            return _held(inner) if text_of(node).startswith("*") else inner
        case "field_expression":
            return _field(scope, node)
        case "call_expression":
            return _handed_on(scope, node)
        case "subscript_expression":
            return _element(scope, part(node, "argument"), named(part(node, "indices")))
        case _:
            return None


def _element(scope: Scope, container: Node, keys: Sequence[Node]) -> Meaning | None:
    """A publisher that is kept in a map or vector, by a key that stands in the code."""
    if len(keys) != 1 or keys[0].type not in ("string_literal", "number_literal"):
        return None
    name = text_of(container).removeprefix("this->")
    kept = scope.members.get(f"{name}[{text_of(keys[0])}]") if name not in scope.locals else None
    return kept if isinstance(kept, Publishes) else None


def _field(scope: Scope, node: Node) -> Meaning | None:
    target, name = part(node, "argument"), text_of(part(node, "field"))
    if is_this(target):
        return scope.members.get(name)
    match resolve(scope, target):
        case Itself():
            return scope.members.get(name)
        case Record() as record:
            return field_of(record, name)
        case Outside():
            return Outside()
        case _:
            return None


def _held(meaning: Meaning | None) -> Meaning | None:
    """The value of an optional; what else a pointer leads to has the pointer's meaning."""
    return meaning.fields.get(HELD, meaning) if isinstance(meaning, Record) else meaning


def is_this(node: Node) -> bool:
    """Whether it is `this` or `(*this)`."""
    while node.type == "parenthesized_expression" and len(named(node)) == 1:
        node = named(node)[0]
    if node.type == "pointer_expression":
        return is_this(part(node, "argument"))
    return node.type == "this"


def _handed_on(scope: Scope, node: Node) -> Meaning | None:
    """`pointer.get()`, `std::move(message)`."""
    function, arguments = part(node, "function"), named(part(node, "arguments"))
    if function.type == "field_expression" and not arguments:
        match text_of(part(function, "field")):
            case "get":
                return resolve(scope, part(function, "argument"))
            case "value":
                held = _held(resolve(scope, part(function, "argument")))
                return held if isinstance(held, Variable) else None
        return None
    if function.type == "field_expression" and text_of(part(function, "field")) == "at":
        return _element(scope, part(function, "argument"), arguments)
    if len(arguments) == 1 and text_of(function) in _SAME:
        return resolve(scope, arguments[0])
    return None


def field_of(record: Record, name: str) -> Meaning:
    """A field of a message: a variable, a part of the message, or something outside."""
    if name in record.fields:
        return record.fields[name]
    inner = {
        path.removeprefix(f"{name}."): variable
        for path, variable in record.fields.items()
        if path.startswith(f"{name}.")
    }
    return replace(record, fields=inner, type="", there="") if inner else Outside()


def element_of(scope: Scope, name: str, arguments: Sequence[Node]) -> Variable | None:
    """The part that `std::get<0>(x)` is; None for any other function."""
    found = _GET.fullmatch("".join(name.split()))
    record = resolve(scope, arguments[0]) if found and len(arguments) == 1 else None
    if found is None or not isinstance(record, Record) or record.type:
        return None
    fields, index = list(record.fields.values()), int(found[1])
    return fields[index] if index < len(fields) else None
