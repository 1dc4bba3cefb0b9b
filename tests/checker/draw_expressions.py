"""Draws the texts of expressions of small systems."""

from __future__ import annotations

from dataclasses import dataclass, field

from rebsync import model as m
from rebsync.printing import print_expression
from tests.checker.draw_outlines import Callee, Drawer, Outline
from tests.drawing import Scope, Variable, draw_expression, type_of

WHOLE = ("int", "byte")
BOUND = {"int": "({}) % 3", "byte": "(byte) (({}) % 3)"}


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
    leaves = [str(d.up_to(3)), *b.of(*WHOLE), *b.of(*WHOLE)]
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
            divisor = d.one(leaves) if d.flag(4) else f"({d.one(leaves)} | 1)"
            return f"({number(b, depth - 1)} {d.one(['/', '%'])} {divisor})"
        case 5 | 6 if b.kind == "server":
            return d.one(["?(0, 1)", "?(1, 2, 2)", "?(2, 0)", "?(0, 100)"])
        case 7:
            return f"({truth(b, depth - 1)} ? {number(b, depth - 1)} : {number(b, depth - 1)})"
        case 8 | 9:
            return call(b, WHOLE, depth) or d.one(leaves)
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
    seen = [Variable(m.Name(n), type_of(k)) for k, n in b.variables if k in (*WHOLE, "boolean")]
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
    if kind in BOUND:
        return BOUND[kind].format(number(b, max(depth, 0)))
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
