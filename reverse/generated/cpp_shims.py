"""The shims of generated code: functions that hand the messages of a subscription to handlers.

The model says nothing of a shim, so each does what was generated: all fields, once, in their order,
with the message's own times and sender.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from itertools import dropwhile
from typing import TypeAlias

from tree_sitter import Node

from rebsync.model import Type
from rebsync.reverse.bodies.cpp_pointers import is_null
from rebsync.reverse.generated.cpp_handed import arguments_of, handed_on, holds_captured
from rebsync.reverse.generated.cpp_idle import working
from rebsync.reverse.generated.cpp_names import declared_type
from rebsync.reverse.generated.cpp_posts import tells_arguments
from rebsync.reverse.generated.cpp_roles import Roles, Taken, call_in
from rebsync.reverse.generated.send_functions import is_kept
from rebsync.reverse.syntax.cpp_calls import CppCall, calls_in
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import inside, named, part, text_of

_CHANGES = ("assignment_expression", "update_expression")

Fields: TypeAlias = "Mapping[str, Mapping[str, Type | None]]"


def odd_in_shim(
    code: Code,
    owner: CppClass,
    function: CppFunction,
    roles: Roles,
    fields: Fields,
) -> Iterator[Node]:
    """The whole body, unless it hands every field on once, in the message's order."""
    received = [t for t in roles.taken if t.shim == function.node]
    names = {t.message.name for t in received}
    statements = [*dropwhile(lambda s: _is_for_none(s, names), working(function.body))]
    if len(statements) != 1 or len(received) != 1:
        yield from statements
        return
    (taken,) = received
    if not _is_all(statements[0], taken.call.node):
        yield from statements
        return
    known = fields.get(taken.type)
    if not (_hands_fields_on(taken, known) and _fits(code, owner, taken, known or {})):
        yield taken.call.arguments[-1]
    elif not _tells_of_message(code, owner, taken, known or {}) or not _is_shown(taken):
        yield taken.call.node


def _is_for_none(statement: Node, messages: Collection[str]) -> bool:
    """Whether a statement does something only if no message has come: client libraries hand one."""
    if statement.type != "if_statement" or statement.child_by_field_name("alternative") is not None:
        return False
    condition = part(statement, "condition")
    tested = next(iter(named(condition)), condition)
    match tested.type, [n for n in named(tested) if not is_null(n)]:
        case "unary_expression", [pointer]:
            is_none = text_of(part(tested, "operator")) in ("!", "not")
        case "binary_expression", [pointer]:
            is_none = text_of(part(tested, "operator")) == "=="
        case _:
            return False
    return is_none and len(named(condition)) == 1 and text_of(pointer) in messages


def _is_all(statement: Node, call: Node) -> bool:
    """Whether a statement is a call, and not one that it may come to."""
    return statement.type == "expression_statement" and named(statement)[0] == call


def _fits(code: Code, owner: CppClass, taken: Taken, fields: Mapping[str, Type | None]) -> bool:
    """Whether fields are of the types of the handler's parameters, so that no value is cut."""
    own = _handlers(code, owner, taken, len(fields))
    return not own or any(_takes_in(code, f, fields) for f in own)


def _handlers(code: Code, owner: CppClass, taken: Taken, count: int) -> list[CppFunction]:
    """The functions that may serve a message with so many fields, of the class itself first."""
    every = (f for c in code.lineage(owner.name) for f in code.functions_of(c))
    return [f for f in every if f.name == taken.handler and len(f.parameters) == count]


def _takes_in(code: Code, function: CppFunction, fields: Mapping[str, Type | None]) -> bool:
    types = (declared_type(code, p.type) for p in function.parameters)
    return all(map(is_kept, fields.values(), types))


def _tells_of_message(
    code: Code, owner: CppClass, taken: Taken, fields: Mapping[str, Type | None]
) -> bool:
    """Whether the mailbox gets the message's own times, and its sender where that is asked for."""
    times, sender = ("".join(text_of(a).split()) for a in taken.call.arguments[1:3])
    name = taken.message.name
    if times != f"{name}->timing":
        return False
    return sender == f"{name}->sender" or not _asks_for_sender(code, owner, taken, fields)


def _is_shown(taken: Taken) -> bool:
    """Whether the mailbox gets the text of what the handler gets, which is made by nothing else."""
    told, given = taken.call.arguments[3], arguments_of(taken)
    if taken.handler is not None and given is not None:
        return tells_arguments(told, given)
    calls = {call.name.partition("<")[0] for call in calls_in(told)}
    return calls <= {"text", "unflatten"} and not inside(told, *_CHANGES)


def _asks_for_sender(
    code: Code, owner: CppClass, taken: Taken, fields: Mapping[str, Type | None]
) -> bool:
    """Whether what serves a message asks who has sent it; what it sends is served apart."""
    called = call_in(taken.call.arguments[-1])
    if called is None or taken.handler is None:
        return any(_is_question(call) for call in code.calls_of(taken.function))
    functions = _told_by_number(code, owner)
    own = _handlers(code, owner, taken, len(called[1]))
    waiting = [f for f in own if not fields or _takes_in(code, f, fields)][:1]
    seen: set[int] = set()
    while waiting:
        function = waiting.pop()
        if function.node.id in seen:
            continue
        seen.add(function.node.id)
        for call in code.calls_of(function):
            if _is_question(call):
                return True
            called_next = functions.get((call.name.rpartition("::")[2], len(call.arguments)))
            waiting += [called_next] if called_next is not None else []
    return False


def _told_by_number(code: Code, owner: CppClass) -> dict[tuple[str, int], CppFunction]:
    """The functions by name and number of parameters, without those that only types tell apart.

    Nor those that send.
    """
    found: dict[tuple[str, int], CppFunction] = {}
    several: set[tuple[str, int]] = set()
    lineage = reversed(code.lineage(owner.name))
    for function in (f for c in lineage for f in code.functions_of(c)):
        key = function.name, len(function.parameters)
        if "When" in function.types[-1:] or found.get(key, function).types != function.types:
            several.add(key)
        found[key] = function
    return {key: function for key, function in found.items() if key not in several}


def _is_question(call: CppCall) -> bool:
    return call.name == "sender" and call.on == "mailbox_"


def _hands_fields_on(taken: Taken, order: Collection[str] | None) -> bool:
    """Whether a handler gets the fields; a lambda that is the handler takes what it wants."""
    if taken.handler is None:
        return holds_captured(taken)
    passed = handed_on(taken)
    return passed is not None and (order is None or passed == list(order))
