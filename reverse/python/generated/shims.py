"""The shims of generated Python: functions that hand the messages of a subscription to handlers.

The model says nothing of a shim, so each does what was generated: all fields, once, in their order,
with the message's own times and sender.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.generated.messages import OwnMessages
from rebsync.reverse.generated.send_functions import is_kept
from rebsync.reverse.python.generated.formats import FORMATS
from rebsync.reverse.python.generated.posts import POST, is_told, tells_arguments
from rebsync.reverse.python.generated.py_types import (
    call_parts,
    expression_in,
    field_read,
    passed_on,
    type_of,
)
from rebsync.reverse.python.generated.roles import PyRoles
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import FUNCTION, PyCode, Scope
from rebsync.reverse.syntax.py_runtime_files import is_runtime_file
from rebsync.reverse.syntax.py_tree import calls_in, field, text_of
from rebsync.static.types import PRIMITIVES

RECEIVE = "self._mailbox.receive"
_ASKS = "self._mailbox.sender"


def odd_in_shim(
    code: PyCode, roles: PyRoles, function: Scope, body: Sequence[Node], messages: OwnMessages
) -> Sequence[Node]:
    """The statements, unless there is one that hands every field on once, in their order.

    `body` are those that do not only tell people something.
    """
    taken = dict(filter(None, (_taken(function, s) for s in body[:-1])))
    is_one = len(body) == len(taken) + 1 and _receives(
        code, roles, function, body[-1], messages, taken
    )
    return () if is_one else body


def _taken(function: Scope, statement: Node) -> tuple[str, Node] | None:
    """The name that a statement gives a field of the message for good, and the field."""
    inner = expression_in(statement)
    value = inner.child_by_field_name("right") if inner is not None else None
    if inner is None or value is None or inner.type != "assignment":
        return None
    name, message = text_of(field(inner, "left")), function.parameters[-1].name
    is_read = text_of(value) == f"{message}.{field_read(value, message)}" or call_parts(value)
    is_once = len(function.names.get(name, ())) == 1 and name not in (message, "self")
    return (name, value) if is_once and is_read else None


def _receives(
    code: PyCode,
    roles: PyRoles,
    function: Scope,
    statement: Node,
    messages: OwnMessages,
    taken: Mapping[str, Node],
) -> bool:
    called, arguments = call_parts(expression_in(statement)) or ("", [])
    if called != RECEIVE or len(arguments) != 5:
        return False
    descriptor, times, sender, told, serve = arguments
    parameter = field(function.node, "parameters").named_children[-1]
    type_, message = parameter.child_by_field_name("type"), function.parameters[-1].name
    handler, values = roles.handler_of(function.name), (passed_on(serve) or ("", []))[1]
    if type_ is None or text_of(taken.get(text_of(times), times)) != f"{message}.timing":
        return False
    if serve.child_by_field_name("parameters") is not None:
        return False
    if not tells_arguments(told, values, taken) or not is_told(
        function.module, text_of(descriptor)
    ):
        return False
    is_signed = text_of(taken.get(text_of(sender), sender)) == f"{message}.sender"
    if not is_signed and (handler is None or _asks_for_sender(code, handler)):
        return False
    if not taken.keys() <= {text_of(n) for n in nodes_in(statement) if n.type == "identifier"}:
        return False  # what nobody asks for may be no field at all
    values = [taken.get(text_of(value), value) for value in values]
    return _hands_fields_on(message, values, handler, messages.fields.get(text_of(type_)))


def _hands_fields_on(
    message: str,
    values: Sequence[Node],
    handler: Scope | None,
    fields: Mapping[str, m.Type | None] | None,
) -> bool:
    """Whether a handler gets the fields of a message, all of them in their order, as they are."""
    given = [field_read(value, message) for value in values]
    count = len(handler.parameters) - 1 if handler is not None else len(given)
    nodes = handler.parameter_nodes[-count:] if handler and count else []
    types = [type_of(n.child_by_field_name("type")) for n in nodes] or [None] * len(given)
    if len(types) != len(given) or not all(map(_is_as_it_is, values, types)):
        return False
    if fields is None:
        return len(set(given)) == count == len(given) and all(map(str.isidentifier, given))
    return given == list(fields) and all(map(is_kept, fields.values(), types))


def _is_as_it_is(value: Node, type_: m.Type | None) -> bool:
    """Whether a value is a field as one of a type: `msg.x`, `Rebec(msg.x)`, `unflatten(...)`."""
    called, arguments = call_parts(value) or ("", [])
    match called:
        case "":
            return type_ is None or (type_.name in PRIMITIVES and not type_.dimensions)
        case "Rebec":
            is_rebec = type_ is None or not (type_.name in PRIMITIVES or type_.dimensions)
            return len(arguments) == 1 and is_rebec
        case "unflatten" if len(arguments) > 2:
            made = FORMATS.get(text_of(arguments[1]))
            lengths = [text_of(each) for each in arguments[2:]]
            is_made = type_ is None or made == (type_.name if type_.name in PRIMITIVES else None)
            return is_made and (type_ is None or lengths == [*map(str, type_.dimensions)])
        case _:
            return False


def _is_posted(call: Node) -> bool:
    """Whether a call stands in what is posted: it is done later, for a message of its own."""
    above = (n for n in ancestors(call) if n.type == "call")
    return any(text_of(field(n, "function")) == POST for n in above)


def _asks_for_sender(code: PyCode, handler: Scope) -> bool:
    """Whether a function, or one that it may call by its name, asks who has sent a message."""
    waiting, seen = [handler], {id(handler)}
    functions: dict[str, list[Scope]] = {}
    while waiting:
        now = (c for c in calls_in(waiting.pop().node) if not _is_posted(c))
        calls = [text_of(field(call, "function")) for call in now]
        if _ASKS in calls or any(each.endswith("mailbox.sender") for each in calls):
            return True
        if calls and not functions:
            for scope in code.scopes.values():
                if scope.kind == FUNCTION and not is_runtime_file(scope.py.source):
                    functions.setdefault(scope.name, []).append(scope)
        names = {each.rpartition(".")[2] for each in calls}
        found = [f for name in names for f in functions.get(name, ()) if id(f) not in seen]
        seen |= set(map(id, found))
        waiting += found
    return False
