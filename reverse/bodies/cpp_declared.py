"""Declarations of locals, taken apart."""

from __future__ import annotations

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.static.constants import constant
from rebsync.static.types import BOOLEAN, INT


@dataclass(frozen=True, slots=True)
class DeclaratorParts:
    """One declarator of a declaration, taken apart."""

    node: Node
    type: Node
    name: str
    kind: str
    value: Node | None
    length: Node | None
    constant: bool
    text: str  # of the type


def taken_apart(declarator: Node, type_: Node, text: str, constant_: bool) -> DeclaratorParts:
    """A declarator of a declaration, with what it declares."""
    value, target = None, declarator
    if declarator.type == "init_declarator":
        target, value = part(declarator, "declarator"), part(declarator, "value")
    kind, length = target.type, None
    while target.type not in ("identifier", "structured_binding_declarator", "operator_name"):
        if target.type == "array_declarator":
            length = target.child_by_field_name("size")
        inner = target.child_by_field_name("declarator")
        if inner is None and not named(target):
            break
        target = inner if inner is not None else named(target)[-1]
    return DeclaratorParts(declarator, type_, text_of(target), kind, value, length, constant_, text)


def only_value(declared: DeclaratorParts) -> Node | None:
    """The initial value: `= e`, `(e)` or `{e}`."""
    value = declared.value
    if value is not None and value.type == "argument_list":
        return named(value)[0] if len(named(value)) == 1 else None
    return value


def number_of(reader: CppStatementReader, declared: DeclaratorParts) -> m.Expression | None:
    """The whole number, or truth value, that a constant of a function is, whatever calls it."""
    kept, value = reader.scope.carried(declared.type), only_value(declared)
    plain = kept is not None and kept.type in (INT, BOOLEAN) and not (kept.bits or kept.wide)
    if value is None or not plain or declared.kind != "identifier":
        return None
    if value.type == "initializer_list" and len(named(value)) == 1:
        value = named(value)[0]
    read = reader.expressions.read(value)
    number = constant(read)
    fits = kept is not None and isinstance(number, bool) == (kept.type == BOOLEAN)
    return read if fits and isinstance(number, int) else None
