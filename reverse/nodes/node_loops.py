"""Loops that keep a node running, `while (ros::ok())`, as servers that send to themselves."""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.findings import Unread
from rebsync.reverse.graph import Fact, RateFact, TimerFact
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_calls import calls_in
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_tree import named, operator_of, text_of
from rebsync.reverse.syntax.descendants import nodes_in

_LOOPS = frozenset({"while_statement", "do_statement", "for_statement"})
_LOOP_WORDS = re.compile(rb"\b(?:while|for|do)\b")
_EARLY = "messages are served here, before the program goes on: what they change is not read"
_WITHIN = "messages are served in the middle of a round: the model serves them before or after it"
_STATEMENTS = frozenset(
    {"expression_statement", "declaration", "if_statement", "compound_statement"}
)
_BEHIND = "this follows a loop that may end while the node runs: it is not read"
_JUMPS = frozenset({"break_statement", "goto_statement", "throw_statement"})
_APART = frozenset({"lambda_expression", "switch_statement", "for_range_loop"})


@dataclass(frozen=True, slots=True)
class NodeLoop:
    """A loop that runs as long as the node does.

    Between `first` and `rest` of its body it sleeps, as `rate` says, or not at all. `guard` are
    the conditions besides that the node runs.
    """

    function: CppFunction
    node: Node
    first: tuple[Node, ...]
    rest: tuple[Node, ...]
    guard: tuple[Node, ...]
    rate: RateFact | None
    sleeps: bool


def loops_in(function: CppFunction, rates: Sequence[RateFact]) -> Iterator[NodeLoop]:
    """The loops of a function that run as long as the node does, outer ones only."""
    body = function.body
    if body is None:
        return
    first = body.start_byte
    places = [first + word.start() for word in _LOOP_WORDS.finditer(body.text or b"")]
    waiting = [body] if places else []
    while waiting:
        node = waiting.pop()
        if node.type in _LOOPS and (loop := _loop(function, node, rates)) is not None:
            yield loop
        elif node.type != "lambda_expression":
            waiting += [c for c in reversed(node.named_children) if _has_one(c, places)]


def _has_one(node: Node, places: Sequence[int]) -> bool:
    """Whether one of some places, in their order, is in a node."""
    at = bisect_left(places, node.start_byte)
    return at < len(places) and places[at] < node.end_byte


def spins(statement: Node) -> bool:
    """Whether a statement only lets ROS serve messages."""
    if statement.type != "expression_statement":
        return False
    names = {c.name.rpartition("::")[2] for c in calls_in(statement)}
    return bool(names & libraries.named(Kind.SERVE)) and len(names) == 1


def _loop(function: CppFunction, node: Node, rates: Sequence[RateFact]) -> NodeLoop | None:
    body, condition = node.child_by_field_name("body"), node.child_by_field_name("condition")
    if body is None:
        return None
    parts = list(_conjuncts(condition)) if condition is not None else []
    runs = [p for p in parts if _is_awake(p)]
    if (parts and not runs) or (node.type == "for_statement" and parts and len(parts) != len(runs)):
        return None
    if node.type == "for_statement" and node.child_by_field_name("update") is not None:
        return None
    statements = named(body) if body.type == "compound_statement" else [body]
    guard = tuple(p for p in parts if p not in runs)
    endless = all(text_of(p) in ("true", "1") for p in parts)
    if not has_word(body, ("sleep", *libraries.named(Kind.SERVE))):  # it waits for nothing
        whole = NodeLoop(function, node, tuple(statements), (), guard, None, False)
        return None if endless else whole
    at, rate = _sleep(statements, rates)
    serving = [spins(s) for s in statements]
    inside = any(serving) or any(c.name == "sleep" for s in statements for c in calls_in(s))
    if not inside and endless:
        return None
    pairs = list(zip(statements, serving, strict=True))
    first = [s for s, serves in pairs[: len(pairs) if at is None else at] if not serves]
    rest = [] if at is None else [s for s, serves in pairs[at + 1 :] if not serves]
    sleeps = at is not None or any(
        c.name.rpartition("::")[2] in ("sleep", "usleep", "sleep_for") for c in calls_in(body)
    )
    return NodeLoop(function, node, tuple(first), tuple(rest), guard, rate, sleeps)


def has_word(node: Node, words: Iterable[str]) -> bool:
    """Whether one of some words stands in a node at all, which is quickly told."""
    text = node.text or b""
    return any(word.encode() in text for word in words)


def _conjuncts(node: Node) -> Iterator[Node]:
    """The conditions that all have to hold."""
    inner = named(node)
    if node.type in ("condition_clause", "parenthesized_expression") and len(inner) == 1:
        yield from _conjuncts(inner[0])
    elif (
        node.type == "binary_expression" and len(inner) == 2 and operator_of(node) in ("&&", "and")
    ):
        for each in inner:
            yield from _conjuncts(each)
    else:
        yield node


def _is_awake(node: Node) -> bool:
    text = "".join(text_of(node).split())
    if text in (
        "true",
        "1",
        *(f"!{name}()" for name in libraries.names_of(Kind.RUNNING, result="!bool")),
    ):
        return True
    names = {c.name.rpartition("::")[2] for c in calls_in(node)}
    awake = {name.rpartition("::")[2] for name in libraries.names_of(Kind.RUNNING, result="bool")}
    return node.type == "call_expression" and len(names) == 1 and bool(names & awake)


def _sleep(
    statements: Sequence[Node], rates: Sequence[RateFact]
) -> tuple[int | None, RateFact | None]:
    """Which statement sleeps, and by which rate."""
    for index, statement in enumerate(statements):
        if statement.type != "expression_statement":
            continue
        for call in calls_in(statement):
            if call.name != "sleep" or call.target is None:
                continue
            for rate in rates:
                kept = (rate.site.kept or _variable(rate.site.call)).removeprefix("this->")
                made = rate.site.call
                inside = call.node.start_byte <= made.start_byte < call.node.end_byte
                same = rate.site.cpp.source.path == rate.site.place.source.path and inside
                if (kept and call.on.removeprefix("this->") == kept) or same:
                    return index, rate
    return None, None


def _variable(call: Node) -> str:
    """The variable that is declared with what a call makes."""
    at: Node | None = call
    while at is not None and at.type not in ("declaration", "compound_statement"):
        at = at.parent
    while at is not None and at.type not in ("identifier", "compound_statement"):
        at = at.child_by_field_name("declarator")
    return text_of(at) if at is not None and at.type == "identifier" else ""


# --- behind a loop ------------------------------------------------------------------------------


def behind(loop: NodeLoop) -> Iterator[tuple[Node, Unread | None]]:
    """What stands behind a loop, each with why it must be listed.

    Where the loop goes on for as long as the node, nothing of it matters to the model.
    """
    ends = _may_end(loop)
    for after in later(loop.node):
        listed = ends and not _is_over(after)
        yield after, Unread(loop.function.cpp.span(after), _BEHIND) if listed else None


def later(node: Node) -> Iterator[Node]:
    """The statements behind one, in the block that it stands in."""
    after = node.next_named_sibling
    while after is not None:
        yield after
        after = after.next_named_sibling


def served_early(
    function: CppFunction, loops: Collection[int], without: Collection[int]
) -> Iterator[Unread]:
    """Calls that serve messages while a function goes on to something else.

    `loops` are the nodes of the loops that keep the node running, which do that; `without` are
    statements that mean nothing.
    """
    body = function.body
    if body is None:
        return
    for call in calls_in(body):
        if call.name.rpartition("::")[2] not in libraries.running_callbacks():
            continue
        around = _around(call.node, body)
        if any(n.id in loops for n in around):
            continue
        looped = any(n.type in _LOOPS or n.type == "for_range_loop" for n in around)
        after = (n for s in around if s.type in _STATEMENTS for n in later(s))
        if looped or any(
            n.id not in without and n.id not in loops and not spins(n) and not _is_over(n)
            for n in after
        ):
            yield Unread(function.cpp.span(call.node), _EARLY)


def served_within(loop: NodeLoop) -> Iterator[Unread]:
    """Where a round serves messages between other things that it does.

    In the model messages are served between two rounds, or where a round sleeps.
    """
    body = loop.node.child_by_field_name("body")
    statements = named(body) if body is not None and body.type == "compound_statement" else []
    kept = {s.id for s in loop.first}, {s.id for s in loop.rest}
    for number, statement in enumerate(statements):
        if not spins(statement):
            continue
        sides = statements[:number], statements[number + 1 :]
        acts = [[s for s in side if not _is_nothing(s)] for side in sides]
        if any(all(any(s.id in part for s in side) for side in acts) for part in kept):
            yield Unread(loop.function.cpp.span(statement), _WITHIN)


def _is_nothing(statement: Node) -> bool:
    """Whether it makes no difference if a statement runs before callbacks or after them."""
    if statement.type == "declaration":
        return not any("declarator" in d.type for d in statement.named_children)
    return statement.type == "comment" or spins(statement) or _is_over(statement)


def _around(node: Node, body: Node) -> list[Node]:
    """A node and what is around it in a body, from inside."""
    return [node, *ancestors(node, lambda n: n.id == body.id)] if node.id != body.id else []


def loop_around(node: Node) -> Node | None:
    """The loop that a node is in the condition of."""
    below = node
    while (at := below.parent) is not None and not at.type.endswith("_definition"):
        if at.type in ("while_statement", "do_statement"):
            return at if at.child_by_field_name("condition") == below else None
        below = at
    return None


def cancels(code: Code, functions: Sequence[CppFunction], facts: Sequence[Fact]) -> bool:
    """Whether anything but a timer is cancelled: an executor, which then ends to serve."""
    kept = {f.site.kept.removeprefix("this->") for f in facts if isinstance(f, TimerFact)}
    calls = (c for f in functions for c in code.calls_of(f))
    return any(c.name == "cancel" and c.on.removeprefix("this->") not in kept for c in calls)


def ended_early(statement: Node, without: Collection[int]) -> bool:
    """Whether more than the end of the program follows a statement."""
    return any(n.id not in without and not _is_over(n) for n in later(statement))


def _may_end(loop: NodeLoop) -> bool:
    """Whether a loop may end while the node still runs."""
    return bool(loop.guard) or any(
        n.type in _JUMPS for s in (*loop.first, *loop.rest) for n in nodes_in(s, *_LOOPS, *_APART)
    )


def _is_over(statement: Node) -> bool:
    """Whether a statement behind such a loop only ends the program, serves on, or logs."""
    if statement.type in ("comment", "return_statement"):
        return True
    if statement.type != "expression_statement":
        return False
    names = {c.name for c in calls_in(statement)}
    return bool(names) and all(
        n.startswith(libraries.logging()) or n in libraries.finishing() for n in names
    )


# --- leaving a loop -----------------------------------------------------------------------------


def left(statements: Sequence[m.Statement], again: m.Statement) -> tuple[m.Statement, ...]:
    """The body of a loop as that of a server: to leave the loop ends it, to go on sends again."""
    return tuple(_left(s, again, True) for s in statements)


def _left(node: m.Statement, again: m.Statement, breaks: bool) -> m.Statement:
    match node:
        case m.Break() if breaks:
            return m.Return(None, node.annotations, node.span)
        case m.Return(value) if value is not None:
            return m.Return(None, node.annotations, node.span)
        case m.Continue() if breaks:
            return m.Block((again, m.Return(None, (), node.span)), node.annotations, node.span)
        case m.Block(statements):
            inner_ = [_left(s, again, breaks) for s in statements]
            flat = [p for s in inner_ for p in (s.statements if isinstance(s, m.Block) else (s,))]
            local = any(isinstance(p, m.Local) for p in flat)
            return replace(node, statements=tuple(inner_ if local else flat))
        case m.If(_, then, otherwise):
            other = _left(otherwise, again, breaks) if otherwise is not None else None
            return replace(node, then=_left(then, again, breaks), otherwise=other)
        case m.While(_, body) | m.For(body=body):
            return replace(node, body=_left(body, again, False))
        case m.Switch(_, cases):
            inner = tuple(
                replace(c, statements=tuple(_in_switch(s, again, breaks) for s in c.statements))
                for c in cases
            )
            return replace(node, cases=inner)
        case other_:
            return other_


def _in_switch(node: m.Statement, again: m.Statement, goes_on: bool) -> m.Statement:
    """As `_left`; a `break` in a switch ends the switch."""
    match node:
        case m.Break():
            return node
        case m.Block(statements):
            inner = tuple(_in_switch(s, again, goes_on) for s in statements)
            return replace(node, statements=inner)
        case m.If(_, then, otherwise):
            other = _in_switch(otherwise, again, goes_on) if otherwise is not None else None
            return replace(node, then=_in_switch(then, again, goes_on), otherwise=other)
        case _:
            return _left(node, again, goes_on)
