"""Functions of generated code that only send: they fill a message from their arguments.

Whatever else a function does makes it a function of the model, whose body shows what it sends.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence

from tree_sitter import Node

from rebsync.names import uncarry
from rebsync.reserved import RUNTIME_TOPICS
from rebsync.reverse.bodies.scope import Sends
from rebsync.reverse.generated.ros1_roles import Advertised, Roles, call_in, server_of
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of, calls_in
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import named, part, text_of


def add_sends(
    code: Code,
    owner: CppClass,
    all_roles: dict[str, Roles],
    fields: Mapping[str, Collection[str]],
) -> None:
    """Reads which functions of a class send what to whom, and which do more than that.

    `fields` are those of each message type, in their order.
    """
    lineage = [all_roles[c.name] for c in code.lineage(owner.name)]
    publishers = {n: p for roles in reversed(lineage) for n, p in roles.publishers.items()}
    servers = {m: s for roles in all_roles.values() for m, s in roles.messages.items()}
    roles = all_roles[owner.name]
    for function in code.functions_of(owner):
        if not _takes_times(function):
            continue
        for call in code.calls_of(function):
            sends = _sent(code, function, call, publishers, servers)
            if sends is None:
                continue
            odd = list(_odd_send(function, sends, lineage, fields))
            if odd:
                roles.odd_sends[function.name] = odd
            else:
                roles.sends[function.name] = sends


def _takes_times(function: CppFunction) -> bool:
    """Whether the last parameter says when what is sent arrives and expires."""
    return bool(function.types) and function.types[-1] == "When"


def _sent(
    code: Code,
    function: CppFunction,
    call: CppCall,
    publishers: dict[str, Advertised],
    servers: dict[str, str],
) -> Sends | None:
    if call.name == "post" and len(call.arguments) == 4 and call.on == "mailbox_":
        server = server_of(code, function.cpp, text_of(call.arguments[0]))
        return Sends("self", server, len(function.parameters) - 1) if server else None
    if call.name != "publish" or call.on != "mailbox_" or len(call.arguments) != 3:
        return None
    where, others = call.arguments[0], 1
    chosen = call_of(where)
    if chosen is not None and chosen.name == "to" and chosen.arguments:
        where, others = chosen.arguments[0], 2
    publisher = publishers.get(text_of(where))
    if publisher is None:
        return None
    server = servers.get(publisher.message) or uncarry(publisher.key, RUNTIME_TOPICS)
    return Sends(publisher.known, server, len(function.parameters) - others)


def _odd_send(
    function: CppFunction,
    sends: Sends,
    lineage: Sequence[Roles],
    fields: Mapping[str, Collection[str]],
) -> Iterator[Node]:
    handlers = {f: s for roles in reversed(lineage) for f, s in roles.handlers.items()}
    statements = named(function.body) if function.body is not None else []
    made = next((s for s in statements if s.type == "declaration"), None)
    type_ = text_of(part(made, "type")).rpartition("::")[2] if made is not None else ""
    order = list(fields[type_]) if type_ in fields else None
    return _odd_in_send(function, sends, handlers, order)


def _odd_in_send(
    function: CppFunction, sends: Sends, handlers: Mapping[str, str], fields: Sequence[str] | None
) -> Iterator[Node]:
    """Statements that do not put one parameter after the other into the message, or send it.

    `handlers` are the servers by their functions, `fields` those of the message in their order,
    if they are known.
    """
    *names, when = [p.name for p in function.parameters]
    waiting = names[sends.known is None :]
    order = list(fields) if fields is not None and len(fields) == len(waiting) else None
    message = ""
    for statement in named(function.body) if function.body is not None else []:
        if statement.type == "declaration":
            message = text_of(part(statement, "declarator"))
            continue
        call = next(calls_in(statement), None)
        if call is not None and call.name == "post":
            called = call_in(call.arguments[-1])
            passed = [text_of(a) for a in called[1]] if called is not None else None
            right = called is not None and handlers.get(called[0]) == sends.server
            if not right or passed != waiting or not _at(call, 1, when):
                yield statement
            waiting = []
        elif call is not None and call.name == "publish":
            if not _at(call, 2, when):
                yield statement
        elif not _is_sender(statement, message):
            field = f"{message}.{order.pop(0)}" if order else None
            if not waiting or not _stores(statement, waiting.pop(0), message, field):
                yield statement
    if waiting and function.body is not None:
        yield function.body


def _at(call: CppCall, index: int, when: str) -> bool:
    """Whether what is sent arrives and expires when the caller says."""
    return len(call.arguments) > index and text_of(call.arguments[index]) == when


def _stores(statement: Node, parameter: str, message: str, field: str | None) -> bool:
    """Whether it is `msg_.field = parameter;` or `flatten(parameter, msg_.field);`."""
    (expression,) = named(statement) or [statement]
    if expression.type == "assignment_expression":
        target, value = part(expression, "left"), part(expression, "right")
    elif (call := next(calls_in(expression), None)) is not None and call.name == "flatten":
        value, target = call.arguments
    else:
        return False
    stored = "".join(text_of(target).split())
    right = stored == field if field is not None else stored.startswith(f"{message}.")
    return right and text_of(value) == parameter


def _is_sender(statement: Node, message: str) -> bool:
    return "".join(text_of(statement).split()) == f"{message}.sender=mailbox_.self();"
