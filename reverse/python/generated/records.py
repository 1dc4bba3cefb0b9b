"""Locals of generated Python that are records: `cell = Cell(x, y)` is a local for each field.

A record may be changed, so that only its fields may be read, and it may be called nothing else.
A tuple, whose fields are numbered, does not change: it is only bound once.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.python.generated.module_variables import hidden_names, imported_as
from rebsync.reverse.python.generated.py_types import type_of
from rebsync.reverse.python.generated.statement_reader import ModelStatementReader
from rebsync.reverse.python.generated.stored import declaration
from rebsync.reverse.python.generated.tuples import parts
from rebsync.reverse.python.values.py_worth import Class
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import Scope, has_splat
from rebsync.reverse.syntax.py_tree import SCOPES, field, is_label, named, text_of

_TARGETS = frozenset(
    {
        *("pattern_list", "tuple_pattern", "list_pattern", "as_pattern_target", "dotted_name"),
        *("delete_statement", "global_statement", "nonlocal_statement", "aliased_import"),
        *("parameters", "typed_parameter", "default_parameter", "typed_default_parameter"),
        *("expression_list", "list_splat", "list_splat_pattern", "dictionary_splat"),
    }
)
_DATACLASS = re.compile(r"([\w.]+)(?:\((?:\s*(?:frozen|order|eq)\s*=\s*(?:True|False)\s*,?)*\))?\Z")


def behind(reader: ModelStatementReader, node: Node, rest: list[Node]) -> list[m.Statement] | None:
    """The statements of one that makes a local record, and behind it; None if it does not."""
    inner = named(node)[0] if node.type == "expression_statement" and named(node) else node
    value = inner.child_by_field_name("right") if inner.type == "assignment" else None
    if value is None or field(inner, "left").type != "identifier":
        return None
    name = text_of(field(inner, "left"))
    given: Sequence[tuple[str, Node | m.Expression]] | None
    values = named(value) if value.type == "tuple" else _chosen(reader, value)
    if values:
        fields: Sequence[str] = [*map(str, range(len(values)))]
        given = [*zip(fields, values, strict=True)]
    else:
        is_call = value.type == "call"
        fields = _fields_of(reader, text_of(field(value, "function"))) or () if is_call else ()
        given = _given(value, fields) if fields else []
    if not given or not _is_only_read(inner, name, fields):
        return None
    if any(f"{name}_{f}" in reader.expressions.locals for f in fields):
        return None
    found: list[m.Statement] = [_local(reader, f"{name}_{f}", v, node) for f, v in given]
    own = reader.expressions
    local = [own.value(m.Name(reader.local(f"{name}_{f}"))) for f, _ in given]
    with own.standing_for([f"{name}.{f}" for f, _ in given], local):
        return [*found, *reader.block(rest, node).statements]


def _chosen(reader: ModelStatementReader, value: Node) -> Sequence[Node | m.Expression] | None:
    """The elements of a tuple that a condition or a table chooses."""
    is_one = value.type in ("conditional_expression", "call", "subscript")
    return parts(reader.expressions, value, arrays=False) if is_one else None


def _local(
    reader: ModelStatementReader, name: str, value: Node | m.Expression, node: Node
) -> m.Local:
    if isinstance(value, Node):
        return reader.implied_local(name, value, node)
    type_ = reader.expressions.kind(value)
    if type_ is None:
        raise reader.expressions.unread(node, "say these values one by one")
    return declaration(reader, name, type_, value, node)


def _fields_of(reader: ModelStatementReader, name: str) -> Sequence[str] | None:
    """The fields of a data class whose objects only hold what they are made of; none has a default.

    None: a name is not that of one, or of something else too.
    """
    names = reader.expressions.names
    if name in hidden_names(names.constants.code.code, names.constants.module):
        return None
    match names.constants.code.of(names.constants.module, name):
        case Class(owner) if _is_record(owner) or _is_tuple(owner):
            return _fields(owner) or None
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


def _given(call: Node, fields: Sequence[str]) -> list[tuple[str, Node]] | None:
    """What each field is made of, in the order of evaluation; None where that fails."""
    found = []
    for index, argument in enumerate(named(field(call, "arguments"))):
        if argument.type == "keyword_argument":
            found.append((text_of(field(argument, "name")), field(argument, "value")))
        elif index < len(fields):
            found.append((fields[index], argument))
    is_whole = sorted(f for f, _ in found) == sorted(fields) and not has_splat(call)
    return found if is_whole and len(found) == len(named(field(call, "arguments"))) else None


def _is_only_read(assignment: Node, name: str, fields: Sequence[str]) -> bool:
    """Whether a local is bound once, and else only read: a record its fields, in the function."""
    function = climb(assignment, lambda n: n.type in SCOPES)
    if function is None:
        return False
    uses = [n for n in nodes_in(function) if n.type == "identifier" and text_of(n) == name]
    others = [n for n in uses if n != field(assignment, "left") and not is_label(n)]
    taken = {f"{name}_{each}" for each in fields}
    if any(n.type == "identifier" and text_of(n) in taken for n in nodes_in(function)):
        return False
    return all(_is_read(n, function, fields) for n in others)


def _is_read(use: Node, function: Node, fields: Sequence[str]) -> bool:
    node, above = use, use.parent
    if "0" not in fields:
        if above is None or text_of(above.child_by_field_name("attribute") or use) not in fields:
            return False
        node, above = above, above.parent
    elif above is not None and above.type == "subscript":
        node, above = above, above.parent
    is_target = above is None or above.type in _TARGETS
    if above is not None and above.type in _STORING:
        stored = (above.children_by_field_name(n) for n in ("left", "function", "name"))
        is_target = any(node in each for each in stored)
    return not is_target and climb(use, lambda n: n.type in SCOPES) == function


_STORING = frozenset(
    {
        *("assignment", "augmented_assignment", "for_statement", "for_in_clause", "call"),
        "named_expression",
    }
)


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
        elif not (named(statement) and named(statement)[0].type == "string"):
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
