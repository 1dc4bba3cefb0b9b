"""Classes of generated Python whose objects only hold what they are made of."""

from __future__ import annotations

import re
from collections.abc import Sequence

from tree_sitter import Node

from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.module_variables import hidden_names, imported_as
from rebsync.reverse.python.generated.py_types import type_of
from rebsync.reverse.python.values.py_worth import Class
from rebsync.reverse.syntax.py_index import Scope, has_splat
from rebsync.reverse.syntax.py_tree import field, is_constant_text, named, text_of

_DATACLASS = re.compile(r"([\w.]+)(?:\((?:\s*(?:frozen|order|eq)\s*=\s*(?:True|False)\s*,?)*\))?\Z")


def fields_of(reader: ModelExpressionReader, name: str) -> Sequence[str] | None:
    """The fields of a data class whose objects only hold what they are made of; none has a default.

    None: a name is not that of one, or of something else too.
    """
    owner = _class_of(reader, name)
    if owner is None or not (_is_record(owner) or _is_tuple(owner)):
        return None
    return _fields(owner) or None


def is_tuple(reader: ModelExpressionReader, name: str) -> bool:
    """Whether the objects of such a class are tuples as well."""
    owner = _class_of(reader, name)
    return owner is not None and _is_tuple(owner)


def _class_of(reader: ModelExpressionReader, name: str) -> Scope | None:
    constants = reader.names.constants
    if not name or name in hidden_names(constants.code.code, constants.module):
        return None
    match constants.code.of(constants.module, name):
        case Class(owner):
            return owner
        case _:
            return None


def _is_record(owner: Scope) -> bool:
    heads = [_DATACLASS.match(d) for d in owner.decorators]
    whole = [imported_as(owner.module, head[1]) if head else "" for head in heads]
    return whole == ["dataclasses.dataclass"]


def _is_tuple(owner: Scope) -> bool:
    above = owner.node.child_by_field_name("superclasses")
    names = [imported_as(owner.module, text_of(n)) for n in named(above)] if above else []
    return names == ["typing.NamedTuple"] and not owner.decorators


def given_to(call: Node, fields: Sequence[str]) -> list[tuple[str, Node]] | None:
    """What each field is made of, in the order of evaluation; None where that fails."""
    found = []
    for index, argument in enumerate(named(field(call, "arguments"))):
        if argument.type == "keyword_argument":
            found.append((text_of(field(argument, "name")), field(argument, "value")))
        elif index < len(fields):
            found.append((fields[index], argument))
    is_whole = sorted(f for f, _ in found) == sorted(fields) and not has_splat(call)
    return found if is_whole and len(found) == len(named(field(call, "arguments"))) else None


def _fields(scope: Scope) -> tuple[str, ...]:
    """The fields of a data class; none where its objects may do more than to hold them."""
    if scope.node.child_by_field_name("superclasses") is not None and not _is_tuple(scope):
        return ()
    found = []
    for statement in named(field(scope.node, "body")):
        if statement.type == "function_definition":
            if not _is_idle(statement):
                return ()
        elif (name := _declared(statement)) is not None:
            found.append(name)
        elif not (named(statement) and is_constant_text(named(statement)[0])):
            return ()
    return tuple(found)


def _declared(statement: Node) -> str | None:
    """The field that `x: int` declares."""
    inner = named(statement)[0] if statement.type == "expression_statement" else statement
    if inner.type != "assignment" or inner.child_by_field_name("right") is not None:
        return None
    said = field(inner, "type")
    return text_of(field(inner, "left")) if type_of(said) or text_of(said) == "str" else None


def _is_idle(function: Node) -> bool:
    """Whether a method runs only where it is called by its name."""
    name = text_of(field(function, "name"))
    return not (name.startswith("__") and name.endswith("__"))
