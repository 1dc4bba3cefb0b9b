"""The fields of messages as the shims of generated code hand them on to the handlers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from tree_sitter import Node

from rebsync.reverse.bodies.overloads import Served
from rebsync.reverse.build.field_order import Messages, are_named, in_order
from rebsync.reverse.generated.cpp_roles import Roles, Taken, call_in
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import inside, part, text_of


def as_handed_on(
    code: Code, messages: Messages, served: Served, roles: Mapping[str, Roles]
) -> tuple[Messages, Served]:
    """Message types, and what classes serve, with the fields in the order of the parameters."""
    found = in_order(messages, _orders(code, roles))
    types = {t.rpartition("/")[2]: tuple(f.values()) for t, f in found.items()}
    return found, replace(served, fields={**served.fields, **types})


def _orders(code: Code, roles: Mapping[str, Roles]) -> Iterator[tuple[str, Sequence[str]]]:
    for name, of in roles.items():
        functions = [f for c in code.lineage(name) for f in code.functions_of(c)]
        for taken in of.taken:
            fields = handed_on(taken) or ()
            handlers = (f for f in functions if f.name == taken.handler)
            if any(are_named(fields, [p.name for p in f.parameters]) for f in handlers):
                yield taken.type, fields


def handed_on(taken: Taken) -> list[str] | None:
    """The fields that a shim hands on to a handler in their order, each once; None for others."""
    given = arguments_of(taken)
    passed = [_field(a, taken.message.name) for a in given] if given is not None else [None]
    found = [name for name in passed if name is not None]
    return found if len(set(found)) == len(passed) else None


def arguments_of(taken: Taken) -> list[Node] | None:
    """What a shim hands on; what its lambda has captured under another name, as it was there."""
    serve = taken.call.arguments[-1]
    called = call_in(serve)
    if called is None or (called[1] and not holds_captured(taken)):
        return None
    captured = {
        text_of(part(each, "left")): part(each, "right")
        for each in inside(serve, "lambda_capture_initializer")
    }
    return [captured.get(text_of(a), a) for a in called[1]]


def holds_captured(taken: Taken) -> bool:
    """Whether what serves a message has copies of what it uses: it runs when the shim has ended."""
    serve, message = taken.call.arguments[-1], taken.message.name
    captures = serve.child_by_field_name("captures")
    held = (text_of(part(each, "right")) for each in inside(serve, "lambda_capture_initializer"))
    is_copied = captures is None or "&" not in text_of(captures)
    return is_copied and all(t == message or t.startswith(f"{message}->") for t in held)


def _field(argument: Node, message: str) -> str | None:
    """The field of `msg->x`, `msg->x != 0` or `unflatten<T>(msg->x)`."""
    text = "".join(text_of(argument).split()).removesuffix("!=0")
    if text.startswith("unflatten<") and text.endswith(")"):
        text = text[text.rindex("(") + 1 : -1]
    name = text.removeprefix(f"{message}->")
    return name if name != text and name.isidentifier() else None
