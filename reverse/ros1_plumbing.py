"""What generated code does around its bodies, and whether somebody has changed that.

The model says nothing of how a message is filled or unpacked, so what is there must be what was
generated. Anything else is listed: the model would not show it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from tree_sitter import Node

from rebsync.reverse.cpp_calls import call_of, calls_in
from rebsync.reverse.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.cpp_tree import named, part, text_of
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.ros1_roles import Roles

_SETS_UP = frozenset(
    {
        *("param", "advertise", "advertiseAll", "subscribe", "subscribeOnBridge"),
        *("readArray", "onServed", "construct", "unused"),
    }
)


def check_plumbing(
    code: Code, owner: CppClass, all_roles: Mapping[str, Roles], findings: Findings
) -> None:
    """Lists what a class does outside of its bodies that the model cannot show."""
    roles = all_roles[owner.name]
    topics = {t for c in code.lineage(owner.name) for t in all_roles[c.name].topics}
    for function in code.functions_of(owner):
        if function.body is None:
            continue
        if function.name == owner.name:
            odd = _odd_in_constructor(function, roles)
            why = "a constructor of generated code only sets up; the model's own is construct()"
        elif function.name in roles.shims and function.name not in topics:
            odd = iter((function.node,))
            why = "no subscription takes messages to this: those of others do not arrive"
        elif function.name in roles.shims:
            odd = _odd_in_shim(function)
            why = "this does more than to hand a message to its handler"
        elif function.name in roles.sends:
            odd = _odd_in_send(function)
            why = "this does more than to send its arguments"
        elif function.name == "construct" and not _is_constructed(code, owner):
            odd = iter((function.node,))
            why = "no constructor has this run"
        else:
            continue
        for node in odd:
            unread = Unread(function.cpp.span(node), why)
            findings.unreadable(function.cpp.source, unread, f"{owner.name}.{function.name}")


def _is_constructed(code: Code, owner: CppClass) -> bool:
    """Whether the model's constructor runs, or no node is of this class alone."""
    own = [f for f in code.functions_of(owner) if f.name == owner.name]
    concrete = any(f.name == "publishState" and not f.pure for f in owner.functions)
    return not concrete or any(c.name == "construct" for f in own for c in code.calls_of(f))


def _statements(function: CppFunction) -> list[Node]:
    return named(function.body) if function.body is not None else []


def _odd_in_constructor(function: CppFunction, roles: Roles) -> Iterator[Node]:
    """Statements that neither set up anything nor prepare that."""
    for statement in _statements(function):
        names = {c.name for c in calls_in(statement)}
        given = text_of(statement).partition("=")[0].strip()
        handle = text_of(statement).startswith("const ros::NodeHandle ")
        if not (names & _SETS_UP or handle or given in roles.globals):
            yield statement


def _odd_in_shim(function: CppFunction) -> Iterator[Node]:
    """The whole body, unless it hands every field on once."""
    received = [c for c in calls_in(function.body) if c.name == "receive"]
    statements = _statements(function)
    if len(statements) != 1 or len(received) != 1:
        yield from statements
        return
    body = received[0].arguments[-1]
    called = [c for c in calls_in(body) if c.target is None or c.target.type == "this"]
    handler = called[0] if called else None
    if handler is None or len(named(part(body, "body"))) != 1:
        yield body
        return
    fields = [_field(a) for a in handler.arguments]
    if None in fields or len(set(fields)) != len(fields):
        yield body


def _field(argument: Node) -> str | None:
    """The field of `msg->x`, `msg->x != 0` or `unflatten<T>(msg->x)`."""
    text = "".join(text_of(argument).split()).removesuffix("!=0")
    if text.startswith("unflatten<") and text.endswith(")"):
        text = text[text.rindex("(") + 1 : -1]
    name = text.removeprefix("msg->")
    return name if name != text and name.isidentifier() else None


def _odd_in_send(function: CppFunction) -> Iterator[Node]:
    """Statements that do not put one parameter after the other into the message, or send it."""
    waiting = [p.name for p in function.parameters if p.name not in ("when_", "to_")]
    for statement in _statements(function):
        if statement.type == "declaration":
            continue
        call = next(calls_in(statement), None)
        if call is not None and call.name == "post":
            if _passed(call.arguments[-1]) != waiting:
                yield statement
            waiting = []
        elif call is not None and (call.name == "publish" or _is_sender(statement)):
            continue
        elif not waiting or not _stores(statement, waiting.pop(0)):
            yield statement
    if waiting and function.body is not None:
        yield function.body


def _stores(statement: Node, parameter: str) -> bool:
    """Whether it is `msg_.field = parameter;` or `flatten(parameter, msg_.field);`."""
    (expression,) = named(statement) or [statement]
    if expression.type == "assignment_expression":
        target, value = part(expression, "left"), part(expression, "right")
    elif (call := next(calls_in(expression), None)) is not None and call.name == "flatten":
        value, target = call.arguments
    else:
        return False
    return text_of(value) == parameter and text_of(target).startswith("msg_.")


def _is_sender(statement: Node) -> bool:
    return "".join(text_of(statement).split()) == "msg_.sender=mailbox_.self();"


def _passed(body: Node) -> list[str] | None:
    """The arguments of the call that is all a lambda does; None where it does something else."""
    statements = named(part(body, "body")) if body.type == "lambda_expression" else []
    inner = named(statements[0]) if len(statements) == 1 else []
    call = call_of(inner[0]) if len(inner) == 1 else None
    return [text_of(a) for a in call.arguments] if call is not None else None
