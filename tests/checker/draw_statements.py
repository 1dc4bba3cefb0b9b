"""Draws the texts of statements of small systems."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from hypothesis import strategies as st

from tests.checker.draw_expressions import (
    BOUND,
    Body,
    arguments,
    callable_methods,
    index,
    number,
    truth,
    value,
)

_Writer: TypeAlias = "Callable[[Body, int], list[str]]"


def block(b: Body, depth: int, most: int = 3, least: int = 0) -> list[str]:
    """The lines of a block without its braces."""
    mark = b.scope_mark()
    lines = [line for _ in range(b.drawer.up_to(most, least)) for line in statement(b, depth)]
    b.leave(mark)
    return lines


def _braced(head: str, lines: list[str], tail: str = "") -> list[str]:
    return [f"{head} {{", *(f"  {line}" for line in lines), f"}}{tail}"]


def statement(b: Body, depth: int) -> list[str]:
    """One statement."""
    simple: list[_Writer] = [
        _assign,
        _assign,
        _assign,
        _send,
        _send,
        _local,
        _time,
        _check,
        _method,
    ]
    nested: list[_Writer] = [_if, _if, _while, _for, _switch]
    return b.drawer.one(simple + nested if depth else simple)(b, depth)


def _assign(b: Body, _: int) -> list[str]:
    d = b.drawer
    targets = [(k, n) for k, n in b.variables if k in (*BOUND, "boolean", "float", "double")]
    for kind, name in b.variables:
        if kind == "int[2]":
            targets.append(("int", f"{name}[{index(b, 1)}]"))
        elif kind == "byte[2][2]":
            targets.append(("byte", f"{name}[{d.up_to(1)}][{index(b, 1)}]"))
        elif kind in b.classes:
            targets.append((kind, name))
    if not targets:
        return []
    kind, target = d.one(targets)
    if kind == "byte" and d.flag(3):
        return [f"{target} += {d.one(['64', '100 % 64', '(byte) (-128)'])};"]
    if kind == "int" and d.flag(4):
        return [f"{target} {d.one(['*=', '-=', '+=', '^='])} {number(b, 1)};", f"{target} %= 2;"]
    if kind in BOUND and d.flag(3):
        return [f"{target} = {BOUND[kind].format(f'{target} + 1')};"]
    if kind == "boolean" and d.flag(3):
        return [f"{target} = !{target};"]
    return [f"{target} = {value(b, kind, 2)};"]


def _send(b: Body, depth: int) -> list[str]:
    d = b.drawer
    if depth and d.up_to(2):
        return _braced(f"if ({truth(b, 1)})", _send(b, 0))
    receivers = [("self", b.owner.name)]
    if b.kind != "constructor":
        seen = [*b.variables, *b.fixed, *b.fixed, *b.fixed]
        receivers += [(n, k) for k, n in seen if k in b.classes]
    if b.kind == "server" and d.flag(4):
        kind = d.one(b.classes)
        target = f"(({kind}) sender)"
        sent = [f"{target}.{_message(b, kind)};"]
        return sent if d.flag(4) else _braced(f"if (sender instanceof {kind})", sent)
    target, kind = d.one(receivers)
    sent = [f"{target}.{_message(b, kind)};"]
    if (kind, target) in b.variables and d.up_to(5):
        return _braced(f"if ({target} != null)", sent)
    return sent


def _message(b: Body, kind: str) -> str:
    server = b.drawer.one(b.drawer.servers_of(kind))
    return f"{server.name}({arguments(b, server, 1)}){_times(b)}"


def beat(b: Body) -> list[str]:
    """A message by which something goes on, mostly after a while."""
    d = b.drawer
    if b.fixed and b.kind == "server" and d.flag(3):
        kind, name = d.one(b.fixed)
        server = d.one(d.servers_of(kind))
        return [f"{name}.{server.name}({arguments(b, server, 1)}){_times(b)};"]
    server = d.one(d.servers_of(b.owner.name))
    times = f" after({d.up_to(4, least=1)})" if d.features.timed and d.up_to(8) else ""
    return [f"{d.one(['self.', ''])}{server.name}({arguments(b, server, 1)}){times};"]


def _times(b: Body) -> str:
    d = b.drawer
    if not d.features.timed:
        return ""
    times = ""
    if d.up_to(5):
        options = ["1", "1", "2", "3", "4", "0"]
        if b.kind == "server":
            options += ["?(0, 2)", "?(1, 3)", "?(1, 2)", "(currentMessageWaitingTime + 1)"]
        if b.of("int"):
            options.append(f"({d.one(b.of('int'))} & 1)")
            if d.flag(4):
                options.append(d.one(b.of("int")))
        times += f" after({d.one(options)})"
    if d.flag(4):
        times += f" deadline({d.up_to(6)})"
    return times


def _local(b: Body, _: int) -> list[str]:
    d = b.drawer
    name, kind = b.fresh(), d.one(["int", "int", "byte", "boolean", "int[2]", b.owner.name])
    if kind == "int[2]":
        first, second = value(b, "int"), value(b, "int")
        text = f"{kind} {name} = {{{first}, {second}}};" if d.flag() else f"{kind} {name};"
    else:
        text = f"{kind} {name} = {value(b, kind)};" if d.up_to(3) else f"{kind} {name};"
    b.variables.append((kind, name))
    return [text]


def _time(b: Body, _: int) -> list[str]:
    d = b.drawer
    if not b.may_delay:
        return _send(b, 0)
    options = ["1", "1", "2", "3", "0"]
    if b.kind == "server":
        options += ["?(0, 1)", "?(2, 1)"]
    if b.of("int"):
        options.append(f"({d.one(b.of('int'))} & 1)")
        if d.flag(5):
            options.append(d.one(b.of("int")))
    return [f"delay({d.one(options)});"]


def _check(b: Body, _: int) -> list[str]:
    d = b.drawer
    if b.kind != "constructor" and d.flag(4):
        return [f'assertion({truth(b, 1)} || {truth(b, 1)} || {number(b, 0)} != 2, "drawn");']
    if b.drawer.features.clock and b.kind == "server":
        read = d.one(["now", "currentMessageArrival", "currentMessageDeadline"])
        if b.of("int", fixed=False):
            return [f"{d.one(b.of('int', fixed=False))} = {read} % 2;"]
        return [f"assertion({read} >= 0);"]
    return _assign(b, 0)


def _method(b: Body, _: int) -> list[str]:
    methods = callable_methods(b)
    if not methods:
        return _assign(b, 0)
    callee = b.drawer.one(methods)
    prefix = b.drawer.one(["", "", "self."])
    if b.owner.base and callee in b.owner.base.all_methods() and b.drawer.flag():
        prefix = "super."
    return [f"{prefix}{callee.name}({arguments(b, callee, 1)});"]


def _if(b: Body, depth: int) -> list[str]:
    lines = _braced(f"if ({truth(b, 2)})", block(b, depth - 1, least=1))
    if b.drawer.flag():
        lines[-1:] = _braced("} else", block(b, depth - 1))
    return lines


def _leaving(b: Body) -> list[str]:
    """A way out of a loop, or on to its next round."""
    d = b.drawer
    if d.flag():
        return []
    ends = ["break;", "continue;"]
    if b.kind != "constructor" and b.result == "void":
        ends.append("return;")
    return _braced(f"if ({truth(b, 1)})", [d.one(ends)])


def _while(b: Body, depth: int) -> list[str]:
    name, mark = b.fresh(), b.scope_mark()
    b.fixed.append(("int", name))
    inner = [f"{name}++;", *_leaving(b), *block(b, depth - 1)]
    b.leave(mark)
    counted = ("int", name)
    b.fixed.append(counted)
    return [f"int {name} = 0;", *_braced(f"while ({name} < {b.drawer.up_to(2, 1)})", inner)]


def _for(b: Body, depth: int) -> list[str]:
    name, mark = b.fresh(), b.scope_mark()
    b.fixed.append(("int", name))
    head = f"for (int {name} = 0; {name} < {b.drawer.up_to(2, 1)}; {name}++)"
    inner = [*_leaving(b), *block(b, depth - 1)]
    b.leave(mark)
    return _braced(head, inner)


def _switch(b: Body, depth: int) -> list[str]:
    d, mark = b.drawer, b.scope_mark()
    lines = []
    labels = d.draw(st.lists(st.integers(-1, 3), min_size=1, max_size=3, unique=True))
    for label in [*labels, *([None] if d.flag() else [])]:
        lines.append("default:" if label is None else f"case {label}:")
        for _ in range(d.up_to(2)):
            lines += [f"  {line}" for line in statement(b, depth - 1)]
        if d.up_to(2):
            lines.append("  break;")
    b.leave(mark)
    return _braced(f"switch ({number(b, 1)})", lines)
