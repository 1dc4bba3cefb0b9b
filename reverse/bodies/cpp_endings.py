"""Whether loops of C++ end that change nothing of the model: what their tests ask must change."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.bodies.cpp_kinds import LOOPS
from rebsync.reverse.bodies.cpp_roots import root
from rebsync.reverse.bodies.scope import Called, Inline, Record, Scope, Variable
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of
from rebsync.reverse.syntax.cpp_tree import inside, part, text_of

_LEAVE = ("break_statement", "return_statement", "throw_statement", "goto_statement")
_GUARDS = LOOPS | {"if_statement", "switch_statement", "catch_clause"}


def may_end(scope: Scope, loop: Node) -> bool:
    """Whether a loop that changes nothing of the model may end, or is a `switch`.

    One of its tests has to ask what it changes, or a function that is not known: that of the loop,
    or those around a statement that leaves it. What else is asked stays as it is, as nobody else
    runs meanwhile; `ros::ok()` is true for as long as the node matters.
    """
    if loop.type in ("switch_statement", "for_range_loop"):
        return True
    condition = loop.child_by_field_name("condition")
    if condition is not None and _may_turn(scope, condition, loop):
        return True
    return any(all(_may_turn(scope, test, loop) for test in tests) for tests in _exits(loop, loop))


def _exits(node: Node, loop: Node) -> Iterator[list[Node]]:
    """The tests that lead to each statement that leaves a loop."""
    for leave in inside(loop, *_LEAVE):
        tests: list[Node] = []
        at = leave
        while at.id != loop.id and at.parent is not None:
            at = at.parent
            if _keeps(at, leave, loop):
                break
            if at.type in _GUARDS and at.id != loop.id:
                test = at.child_by_field_name("condition")
                tests.append(test if test is not None else at)
        else:
            yield tests


def _keeps(around: Node, leave: Node, loop: Node) -> bool:
    """Whether something in a loop keeps a statement within it from leaving the loop."""
    if around.type == "lambda_expression":
        return True
    if leave.type == "break_statement":
        return around.id != loop.id and around.type in {*LOOPS, "switch_statement"}
    return leave.type == "throw_statement" and around.type == "try_statement"


def _may_turn(scope: Scope, test: Node, loop: Node) -> bool:
    """Whether a test may come out otherwise the next time, or lets the loop end at once."""
    if text_of(test).strip("() ") in ("false", "0"):
        return True
    calls = (call_of(node) for node in inside(test, "call_expression"))
    if any(call is not None and _is_open(scope, call) for call in calls):
        return True
    asked = {text_of(node) for node in inside(test, "identifier", "field_identifier")}
    return not asked.isdisjoint(_changed(loop))


def _is_open(scope: Scope, call: CppCall) -> bool:
    """Whether a call may give something else each time, for all that is known."""
    last = call.name.rpartition("::")[2]
    if last in libraries.named(Kind.RUNNING):
        return False
    if call.target is not None:
        return not isinstance(root(scope, (), call.target)[1], Variable | Record)
    return not isinstance(scope.functions.get(last), Called | Inline)


def _changed(loop: Node) -> set[str]:
    """The names of what a loop may change."""
    changed: list[Node] = []
    for node in inside(loop, "assignment_expression"):
        changed.append(part(node, "left"))
    for node in inside(loop, "update_expression", "pointer_expression"):
        if not text_of(node).startswith("*"):
            changed.append(part(node, "argument"))
    for node in inside(loop, "binary_expression"):
        if part(node, "operator").type == ">>":
            changed.append(part(node, "right"))
    for call in map(call_of, inside(loop, "call_expression")):
        if call is not None:
            changed += call.arguments
            if call.target is not None and call.name not in libraries.looking():
                changed.append(call.target)
    return {text_of(n) for c in changed for n in inside(c, "identifier", "field_identifier")}
