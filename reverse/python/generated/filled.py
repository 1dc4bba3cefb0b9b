"""Messages that people fill and publish by hand where generated code calls a function that does."""

from __future__ import annotations

from collections.abc import Mapping

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.python.generated import idioms
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.names import Filling
from rebsync.reverse.python.generated.py_types import call_parts, expression_in
from rebsync.reverse.python.generated.roles import PyRoles, PySends
from rebsync.reverse.python.values.py_callbacks import body_of
from rebsync.reverse.syntax.py_tree import field, named, text_of

PUBLISH = "self._mailbox.publish"


def fillings_of(roles: PyRoles, sends: Mapping[str, PySends]) -> dict[str, Filling]:
    """What each publisher of a class sends, by its attribute, from the function that does it."""
    found = {}
    for name, own in roles.sends.items():
        inner_ones = map(expression_in, body_of(roles.functions[name]))
        statements = [inner for inner in inner_ones if inner is not None]
        published = [c for s in statements if (c := call_parts(s)) and c[0] == PUBLISH]
        if len(published) != 1 or own.known is None:
            continue
        member = text_of(published[0][1][0])
        values: dict[str, tuple[str, str]] = {}
        message, first = made_of(published[0][1][1]) if len(published[0][1]) > 1 else ("", {})
        values |= {key: _around(value) for key, value in first.items()}
        variable = ""
        for statement in statements:
            if statement.type != "assignment":
                continue
            left, right = text_of(field(statement, "left")), field(statement, "right")
            if left.isidentifier():
                variable, (message, first) = left, made_of(right)
                values |= {key: _around(value) for key, value in first.items()}
            else:
                values[left.removeprefix(f"{variable}.")] = _around(right)
        of_parameter = {plain: (key, around) for key, (plain, around) in values.items()}
        taken = [p.name for p in own.parameters if p.name != "when"]
        if message and all(p in of_parameter for p in taken):
            fields = tuple(of_parameter[p] for p in taken)
            own_fields = {key for key, _ in fields}
            others = tuple((k, text) for k, (text, _) in values.items() if k not in own_fields)
            found[member] = Filling(message, sends[name], fields, others)
    return found


def made_of(value: Node | None) -> tuple[str, dict[str, Node]]:
    """`Message(field=value)`: the type and the fields; nothing of what is made otherwise."""
    called, arguments = call_parts(value) or ("", [])
    if not all(a.type == "keyword_argument" for a in arguments):
        return "", {}
    return called, {text_of(field(a, "name")): field(a, "value") for a in arguments}


def _around(value: Node) -> tuple[str, str]:
    """A value, and the function around it."""
    called, given = call_parts(value) or ("", [])
    return text_of(given[0]) if len(given) == 1 else text_of(value), called if given else ""


def filled(
    reader: ModelExpressionReader, node: Node, after: list[Node]
) -> list[m.Statement] | None:
    """A message that is made here, filled in the next statements and published: one send.

    These are taken out of `after`. None: no message is made here. Unread: it is not sent as a send
    of the model is.
    """
    made = _made(reader, node)
    if made is None:
        return None
    name, message, given = made
    for taken, statement in enumerate(after, 1):
        inner = expression_in(statement) or statement
        called, arguments = call_parts(inner) or ("", [])
        left = text_of(field(inner, "left")) if inner.type == "assignment" else ""
        if left.startswith(f"{name}."):
            given[left.removeprefix(f"{name}.")] = field(inner, "right")
        elif called == PUBLISH and len(arguments) == 3 and text_of(arguments[1]) == name:
            _assert_gone(reader, node, name, after[taken:])
            del after[:taken]
            return [_sent(reader, node, message, given, arguments)]
        else:
            break
    raise reader.unread(node, "fill and publish this message in statements one after the other")


def _made(reader: ModelExpressionReader, node: Node) -> tuple[str, str, dict[str, Node]] | None:
    """`msg = Message(field=value)`: the variable, the type, the values."""
    inner = named(node)[0] if node.type == "expression_statement" and named(node) else node
    if inner.type != "assignment" or field(inner, "left").type != "identifier":
        return None
    value = inner.child_by_field_name("right")
    if (call_parts(value) or ("", []))[0] not in {
        f.message for f in reader.names.fillings.values()
    }:
        return None
    message, given = made_of(value)
    if not message:
        raise reader.unread(node, "name the fields of this message")
    return text_of(field(inner, "left")), message, given


def _assert_gone(reader: ModelExpressionReader, node: Node, name: str, rest: list[Node]) -> None:
    """Unread: a message that was sent is used again."""
    if any(name in idioms.names_in(statement) for statement in rest):
        raise reader.unread(node, "this message is used again when it is sent: make a new one")


def _sent(
    reader: ModelExpressionReader,
    node: Node,
    message: str,
    given: dict[str, Node],
    arguments: list[Node],
) -> m.Statement:
    filling = reader.names.fillings.get(text_of(arguments[0]))
    if filling is None or filling.message != message:
        raise reader.unread(node, "nobody knows whom this publisher sends such a message to")
    for key, text in filling.others:
        if key not in given or text_of(given.pop(key)) not in (text, f"str({text})"):
            raise reader.unread(node, f'"{key}" of this message is not filled as it is elsewhere')
    wanted = [key for key, _ in filling.fields]
    if missing := [key for key in wanted if key not in given]:
        raise reader.unread(node, f'"{missing[0]}" of this message is not filled')
    in_order = [key for key in given if key in wanted] == wanted and len(given) == len(wanted)
    if not in_order and not (set(given) == set(wanted) and all(map(_is_plain, given.values()))):
        raise reader.unread(node, "fill the fields in the order of the parameters")
    values = tuple(_value(reader, given[key], around) for key, around in filling.fields)
    times, span = idioms.times(reader, arguments[2]), reader.py.span(node)
    sends = filling.sends
    target = m.Name(sends.known or "", span)
    call = m.Call(target, sends.server, values, times.get("after"), times.get("deadline"), span)
    return m.ExpressionStatement(call, span=span)


def _is_plain(node: Node) -> bool:
    called, arguments = call_parts(node) or ("", [])
    return idioms.is_plain(arguments[0] if called and len(arguments) == 1 else node)


def _value(reader: ModelExpressionReader, node: Node, around: str) -> m.Expression:
    """A value of a field, in what a generated function puts around it."""
    called, arguments = call_parts(node) or ("", [])
    if around and called == around and len(arguments) == 1:
        return reader.expression(arguments[0])
    if around:
        raise reader.unread(node, f"this is to be {around}(...)")
    return reader.expression(node)
