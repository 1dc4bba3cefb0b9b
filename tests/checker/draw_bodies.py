"""Draws the texts of expressions and statements of small systems."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypeAlias

from hypothesis import strategies as st

from rebsync import model as m
from rebsync.printing import print_expression
from tests.checker.draw_outlines import Callee, Drawer, Outline
from tests.drawing import Scope, Variable, draw_expression, type_of

_Writer: TypeAlias = "Callable[[Body, int], list[str]]"
_WHOLE = ("int", "byte")
_BOUND = {"int": "({}) % 3", "byte": "(byte) (({}) % 3)"}


@dataclass
class Body:
    """A body in the making: where it stands, and the variables that it sees as (type, name)."""

    drawer: Drawer
    owner: Outline
    kind: str  # "server", "method" or "constructor"
    variables: list[tuple[str, str]]
    fixed: list[tuple[str, str]] = field(default_factory=list)  # loop counters, known rebecs
    result: str = "void"
    rank: int = 0  # of a method: it may call those with a lower one
    locals: int = 0

    def fresh(self) -> str:
        """A name for a local variable."""
        self.locals += 1
        return f"x{self.locals}"

    def of(self, *kinds: str, fixed: bool = True) -> list[str]:
        """The names of variables of some types."""
        seen = [*self.variables, *(self.fixed if fixed else ())]
        return [name for kind, name in seen if kind in kinds]

    @property
    def classes(self) -> list[str]:
        """The names of all classes."""
        return [c.name for c in self.drawer.classes]

    @property
    def may_delay(self) -> bool:
        return self.drawer.features.delays

    def scope_mark(self) -> tuple[int, int]:
        """How many variables there are; for `leave`."""
        return len(self.variables), len(self.fixed)

    def leave(self, mark: tuple[int, int]) -> None:
        """The variables of an inner block are gone."""
        del self.variables[mark[0] :]
        del self.fixed[mark[1] :]


# --- expressions ---------------------------------------------------------------------------------


def number(b: Body, depth: int = 1) -> str:
    """A whole number; small, but for a few."""
    d = b.drawer
    leaves = [str(d.up_to(3)), *b.of(*_WHOLE), *b.of(*_WHOLE)]
    leaves += [f"{name}[{d.up_to(1)}]" for name in b.of("int[2]")]
    leaves += [f"{name}[{d.up_to(1)}][{d.up_to(1)}]" for name in b.of("byte[2][2]")]
    if b.kind == "server" and d.features.timed:
        leaves.append("currentMessageWaitingTime")
    if not depth or d.flag():
        return d.one(leaves)
    match d.up_to(13):
        case 0 | 1 | 2:
            return f"({number(b, depth - 1)} {d.one('+-*&|^')} {number(b, depth - 1)})"
        case 3:
            return f"({number(b, depth - 1)} {d.one(['/', '%'])} {d.up_to(3, least=1)})"
        case 4 if d.flag():
            return f"({number(b, depth - 1)} {d.one(['/', '%'])} {d.one(leaves)})"
        case 5 | 6 if b.kind == "server":
            return d.one(["?(0, 1)", "?(1, 2, 2)", "?(2, 0)", "?(0, 100)"])
        case 7:
            return f"({truth(b, depth - 1)} ? {number(b, depth - 1)} : {number(b, depth - 1)})"
        case 8 | 9:
            return call(b, _WHOLE, depth) or d.one(leaves)
        case 10 if b.of("int[2]"):
            return f"{d.one(b.of('int[2]'))}[{index(b, depth)}]"
        case 11 if b.of("byte[2][2]"):
            return f"{d.one(b.of('byte[2][2]'))}[{index(b, depth)}][{index(b, depth)}]"
        case 12:
            return _exotic(b)
        case 13 if b.of("int", fixed=False):
            return f"({d.one(b.of('int', fixed=False))}{d.one(['++', '--'])})"
        case _:
            return d.one(leaves)


def index(b: Body, depth: int) -> str:
    """An index of two; now and then out of range."""
    inner = number(b, depth - 1)
    return inner if b.drawer.flag(6) else f"({inner} & 1)"


def _exotic(b: Body) -> str:
    """Any arithmetic on all types of numbers."""
    seen = [Variable(m.Name(n), type_of(k)) for k, n in b.variables if k in (*_WHOLE, "boolean")]
    scope = Scope(b.owner.name, "method", seen, {}, [], {})
    kind = b.drawer.one(["int", "byte", "int", "float" if b.drawer.features.floats else "short"])
    drawn = draw_expression(b.drawer.draw, scope, kind, 2)
    return f"((int) ({print_expression(drawn)}))"


def truth(b: Body, depth: int = 1) -> str:
    """A condition."""
    d = b.drawer
    leaves = [*b.of("boolean"), "true", "false"] if b.of("boolean") else []
    if leaves and (not depth or d.flag(3)):
        return d.one(leaves)
    match d.up_to(8):
        case 0 | 1 | 2 | 3:
            compared = d.one(["==", "!=", "<", "<=", ">", ">="])
            return f"({number(b, max(depth - 1, 0))} {compared} {d.up_to(2)})"
        case 4 if depth:
            joined = d.one(["&&", "||", "&", "|", "^", "==", "!="])
            return f"({truth(b, depth - 1)} {joined} {truth(b, depth - 1)})"
        case 5 if depth:
            return f"!({truth(b, depth - 1)})"
        case 6 if b.kind == "server":
            return d.one(["?(true, false)", "(sender == self)", "?(false, true)"])
        case 7:
            known = b.of(*b.classes)
            if known:
                read = d.one(known)
                asked = d.one(["== null", "!= null", f"instanceof {d.one(b.classes)}"])
                return f"({read} {asked})"
            return "(self != null)"
        case 8 if depth:
            return call(b, ("boolean",), depth) or f"({number(b, 0)} > 0)"
        case _:
            return f"({number(b, 0)} == {d.up_to(2)})"


def call(b: Body, kinds: tuple[str, ...], depth: int) -> str | None:
    """A call of a method with a result, if there is one."""
    methods = [c for c in callable_methods(b) if c.result in kinds]
    if not methods:
        return None
    callee = b.drawer.one(methods)
    return f"{callee.name}({arguments(b, callee, depth - 1)})"


def callable_methods(b: Body) -> list[Callee]:
    """Methods that may be called from here without calling each other for ever."""
    methods = b.owner.all_methods()
    return [c for c in methods if b.kind != "method" or int(c.name[1:]) < b.rank]


def arguments(b: Body, callee: Callee, depth: int = 0) -> str:
    """Arguments of the right types."""
    return ", ".join(value(b, kind, depth) for kind, _ in callee.parameters)


def value(b: Body, kind: str, depth: int = 1) -> str:
    """A value of a type, from a small set."""
    if kind in _BOUND:
        return _BOUND[kind].format(number(b, max(depth, 0)))
    if kind == "boolean":
        return truth(b, max(depth, 0))
    if kind in ("float", "double"):
        whole = number(b, max(depth, 0))
        return f"({kind}) (({whole}) % 3) {b.drawer.one(['/ 2', '* 0.5', '/ 3', '+ 0.1'])}"
    return rebec(b, kind)


def rebec(b: Body, kind: str) -> str:
    """A rebec of a class, or null."""
    d = b.drawer
    heirs = [c.name for c in d.classes if any(a.name == kind for a in c.line())]
    options = [*b.of(*heirs), *b.of(*heirs)]
    if b.owner.name in heirs:
        options += ["self", "self"]
    if b.kind == "server":
        options.append(f"(({kind}) sender)")
    return d.one(options) if options and not d.flag(30) else "null"


# --- statements ----------------------------------------------------------------------------------


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
    targets = [(k, n) for k, n in b.variables if k in (*_BOUND, "boolean", "float", "double")]
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
    return [f"{target} = {value(b, kind, 2)};"]


def _send(b: Body, _: int) -> list[str]:
    d = b.drawer
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
    times = f" after({d.up_to(4, least=1)})" if d.features.timed and d.up_to(4) else ""
    return [f"{d.one(['self.', ''])}{server.name}({arguments(b, server, 1)}){times};"]


def _times(b: Body) -> str:
    d = b.drawer
    if not d.features.timed:
        return ""
    times = ""
    if d.up_to(3):
        options = ["1", "1", "2", "3", "0"]
        if b.kind == "server":
            options += ["?(0, 2)", "?(1, 2)", "(currentMessageWaitingTime + 1)"]
        if b.of("int"):
            options.append(f"({d.one(b.of('int'))} & 1)")
            if d.flag(4):
                options.append(d.one(b.of("int")))
        times += f" after({d.one(options)})"
    if d.flag(5):
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
    if d.flag(3):
        return [f'assertion({truth(b, 1)}, "drawn");']
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
    subject_mark = b.scope_mark()
    b.leave((min(mark[0], subject_mark[0]), min(mark[1], subject_mark[1])))
    return _braced(f"switch ({number(b, 1)})", lines)
