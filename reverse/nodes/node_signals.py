"""Signal handlers of C++: they run at any time, which the model does not have."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.bodies.runtime_part import runtime_part
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.nodes.node_bodies import Bodies
from rebsync.reverse.nodes.node_reach import all_functions
from rebsync.reverse.syntax.cpp_calls import CppCall, calls_in
from rebsync.reverse.syntax.cpp_index import CppFunction
from rebsync.reverse.syntax.cpp_tree import inside, part, text_of

_SETS = frozenset({"signal", "sigaction", "sigset", "bsd_signal"})
_MEMBERS = ("sa_handler", "sa_sigaction")
_WRITES = ("assignment_expression", "update_expression", "delete_expression")
_WHY = "what this signal handler does may happen at any time: the model has none"


def note_signals(bodies: Bodies, generated: bool) -> None:
    """Lists the calls that set signal handlers, but for those that only end the node.

    Those of the run-time part of `generated` classes are known: `check` compares its text.
    """
    runtime = runtime_part(bodies.code, generated)
    for function in all_functions(bodies.code):
        if function.cpp in runtime:
            continue
        for call in bodies.code.calls_of(function):
            if call.target is not None or call.name.rpartition("::")[2] not in _SETS:
                continue
            if not all(map(_only_ends, _handlers(bodies, function, call))):
                bodies.unread(function.cpp, call.node, _WHY)


def _handlers(bodies: Bodies, function: CppFunction, call: CppCall) -> Iterator[Node | None]:
    """The bodies of the functions that a call, or a member that it gets, may name as handlers."""
    named = list(call.arguments)
    if "sigaction" in call.name:
        stores = inside(function.body, "assignment_expression")
        named += [part(s, "right") for s in stores if text_of(part(s, "left")).endswith(_MEMBERS)]
    for each in named:
        yield from (part(n, "body") for n in inside(each, "lambda_expression"))
    names = {text_of(n) for each in named for n in inside(each, "identifier", "field_identifier")}
    yield from (f.body for f in all_functions(bodies.code) if f.name in names)


def _only_ends(handler: Node | None) -> bool:
    ends = libraries.finishing() | libraries.named(Kind.SHUTDOWN, Kind.EXIT)
    return (
        handler is not None
        and not inside(handler, *_WRITES)
        and all(
            call.name in ends
            or call.name.rpartition("::")[2] in ends
            or call.name.startswith(libraries.logging())
            for call in calls_in(handler)
        )
    )
