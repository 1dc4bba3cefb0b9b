"""Draws modules of Python whose `run()` computes, branches, loops, fails and has effects."""

from __future__ import annotations

from random import Random

_HEAD = """
g = 3
class Base:
    n = 2
    items = [1]
    def m(self, x=1):
        self.a = log(self.a + x)
        return self.a % 5
    def v(self, x): return self.m(x) + 1
class C(Base):
    k = 7
    def __init__(self, a):
        self.a = a
        self._p = 0
        self.items = list(self.items)
    @property
    def p(self):
        self._p += 1
        return log(self._p)
    @p.setter
    def p(self, value): self._p = log(value) // 2
    def v(self, x): return super().v(x) * 2
    def __enter__(self):
        log("in")
        return self
    def __exit__(self, kind, error, trace):
        log(kind and kind.__name__)
        return kind is ZeroDivisionError
class D:
    def __init__(self, d): self.d = d
    def __add__(self, other): return log(self.d + (other.d if isinstance(other, D) else other))
    def __radd__(self, other): return log(other - self.d)
    def __iadd__(self, other):
        self.d = log(self.d + 10)
        return self
    def __lt__(self, other): return log(self.d) < other
    def __bool__(self): return log(self.d) % 2 == 0
def f(x, by=g, *rest, last=[0]):
    global g
    g = log(g + 1) % 9
    last.append(x)
    return x + by + len(rest) + len(last)
def shown(c): return {k: v for k, v in vars(c).items() if k != "m"}
def later(x):
    yield log(x)
    y = yield x + 1
    return y
"""
_NAMES = ("x", "y", "z")
_ATTRIBUTES = ("c.a", "c.k", "c.n", "c.p", "e.a", "C.n", "g", "c.items[0]", "l[i % 3]")
_SIGNS = ("+", "-", "*", "//", "%", "&", "|", "^")
_COMPARED = ("<", "<=", ">", ">=", "==", "!=")


class Drawing:
    """Draws with the choices of a `Random`; `depth` bounds how deep it nests."""

    def __init__(self, random: Random) -> None:
        self.random = random
        self.loops = 0
        self.functions = 0

    def module(self) -> str:
        body = self.block(3, 4)
        lines = ["def run():", *_indented([*_START, *body, _END])]
        return _HEAD + "\n".join(lines) + "\n"

    def block(self, depth: int, most: int) -> list[str]:
        found: list[str] = []
        for _ in range(self.random.randint(1, most)):
            found += self.statement(depth)
        return found

    # --- expressions -----------------------------------------------------------------------------

    def value(self, depth: int = 2) -> str:
        pick = self.random.randint(0, 21 if depth else 4)
        match pick:
            case 0 | 1:
                return self.random.choice(_NAMES)
            case 2 | 3:
                return self.random.choice(_ATTRIBUTES)
            case 4:
                return str(self.random.randint(-3, 9))
            case 5 | 6 | 7 | 8:
                return f"({self.value(depth - 1)} {self.sign()} {self.value(depth - 1)})"
            case 9:
                return f"f({self.arguments(depth - 1)})"
            case 10:
                method = self.random.choice(("c.m", "c.v", "e.m", "e.v"))
                return f"{method}({self.value(depth - 1)})"
            case 11:
                test = self.test(depth - 1)
                return f"({self.value(depth - 1)} if {test} else {self.value(depth - 1)})"
            case 12:
                return f"({self.test(depth - 1)} {self.logic()} {self.value(depth - 1)})"
            case 13:
                return f"({self.random.choice(_NAMES)} := {self.value(depth - 1)})"
            case 14:
                return f"sum([{self.value(depth - 1)} for x in range(3) if {self.test(depth - 1)}])"
            case 15:
                return f"(lambda x, y={self.value(depth - 1)}: x + y)({self.value(depth - 1)})"
            case 16:
                return f"int(f'{{{self.value(0)}}}{{abs({self.value(0)})}}')"
            case 17:
                return f"-{self.value(depth - 1)}"
            case 18:
                return f"(d + {self.value(depth - 1)})"
            case 19:
                return f"({self.value(depth - 1)} + d)"
            case 20:
                return f"sum({self.value(0)} for y in l if y != {self.value(0)})"
            case _:
                return f"len([{self.value(depth - 1)}, *l, {self.value(depth - 1)}])"

    def arguments(self, depth: int) -> str:
        first = self.value(depth)
        more = (", by=" + self.value(depth), f", {self.value(depth)}, *l", ", **{'by': 2}", "")
        return first + self.random.choice(more)

    def test(self, depth: int = 1) -> str:
        match self.random.randint(0, 7 if depth else 3):
            case 0 | 1:
                return f"{self.value(0)} {self.compared()} {self.value(depth)}"
            case 2:
                start = f"{self.value(0)} {self.compared()} {self.value(depth)}"
                return f"({start} {self.compared()} {self.value(0)})"
            case 3:
                return self.value(depth)
            case 4:
                return f"not {self.test(depth - 1)}"
            case 5:
                return f"({self.test(depth - 1)} {self.logic()} {self.test(depth - 1)})"
            case 6:
                return f"{self.value(depth - 1)} in l"
            case _:
                return self.random.choice(("d", "d < 3", "c is e", "x is not None"))

    def sign(self) -> str:
        return self.random.choice(_SIGNS)

    def logic(self) -> str:
        return self.random.choice(("and", "or"))

    def compared(self) -> str:
        return self.random.choice(_COMPARED)

    # --- statements ------------------------------------------------------------------------------

    def target(self) -> str:
        choices = (*_NAMES, "c.a", "c.p", "c.k", "e.a", "C.n", "l[0]", "l[x % 3]", "c.items[0]")
        return self.random.choice(choices)

    def statement(self, depth: int) -> list[str]:
        match self.random.randint(0, 20 if depth else 9):
            case 0 | 1 | 2:
                return [f"{self.target()} = {self.value()}"]
            case 3 | 4:
                return [f"{self.target()} {self.sign()}= {self.value()}"]
            case 5:
                return [f"{self.target()}, {self.target()} = {self.value(1)}, {self.value(1)}"]
            case 6:
                return [f"{self.target()} = {self.target()} = {self.value()}"]
            case 7:
                return [f"log({self.value()})"]
            case 8:
                return [self.random.choice(_ODD)]
            case 9:
                return [self.leaving()]
            case 10 | 11 | 12:
                return self.branch(depth - 1)
            case 13 | 14:
                return self.loop(depth - 1)
            case 15 | 16:
                return self.handled(depth - 1)
            case 17:
                with_ = f"with C({self.value(1)}) as e, c:"
                return [with_, *_indented(self.block(depth - 1, 3))]
            case 18:
                return self.function(depth - 1)
            case 19:
                test = f"assert {self.test()}, {self.value(1)}"
                return ["try:", f"    {test}", "except AssertionError as err:", "    log(err.args)"]
            case _:
                cases = [f"case {n}:" for n in ("1 | 2", "-1", "x if x > 3", "_")]
                inner = [_indented([c, *_indented(self.block(depth - 1, 2))]) for c in cases]
                return [f"match {self.value(1)}:", *(line for lines in inner for line in lines)]

    def leaving(self) -> str:
        choices = ["return log(x)", "raise KeyError(x)", "pass"]
        if self.loops:
            choices += ["break", "continue"] * 3
        return f"if {self.test()}: {self.random.choice(choices)}"

    def branch(self, depth: int) -> list[str]:
        lines = [f"if {self.test()}:", *_indented(self.block(depth, 3))]
        if self.random.random() < 0.4:
            lines += [f"elif {self.test()}:", *_indented(self.block(depth, 2))]
        if self.random.random() < 0.5:
            lines += ["else:", *_indented(self.block(depth, 2))]
        return lines

    def loop(self, depth: int) -> list[str]:
        self.loops += 1
        body = _indented(self.block(depth, 3))
        self.loops -= 1
        tail = ["else:", "    log('else')"] if self.random.random() < 0.5 else []
        if self.random.random() < 0.4:
            return ["w = 3", f"while (w := w - 1) > 0 and {self.test()}:", *body, *tail]
        heads = ("x in range(3)", "i in l[:2]", "x, y in ((1, 2), (3, 4))", "c.a in later(x)")
        return [f"for {self.random.choice(heads)}:", *body, *tail]

    def handled(self, depth: int) -> list[str]:
        lines = ["try:", *_indented(self.block(depth, 3))]
        kinds = ("ZeroDivisionError", "(KeyError, ValueError)", "Exception as err")
        caught = [k for k in kinds if self.random.random() < 0.5]
        for kind in caught:
            lines += [f"except {kind}:", *_indented(self.block(depth, 2))]
        if caught and self.random.random() < 0.4:
            lines += ["else:", *_indented(self.block(depth, 2))]
        if not caught or self.random.random() < 0.5:
            lines += ["finally:", *_indented(self.block(depth, 2))]
        return lines

    def function(self, depth: int) -> list[str]:
        self.functions += 1
        name, outer = f"h{self.functions}", self.loops
        self.loops = 0
        body = ["nonlocal z", f"z = z + {self.value(1)}", *self.block(depth, 2), "return z"]
        self.loops = outer
        head = f"def {name}(x, y={self.value(1)}, i=1):"
        return [head, *_indented(body), f"{self.target()} = {name}({self.value(1)})"]


_START = (
    *("x, y, z, w, i = 1, 2, 3, 3, 0", "c, e, d = C(1), C(5), D(4)", "l = [3, 4, 5]"),
    "c.k = 8",
)
_END = "return x, y, z, i, g, shown(c), shown(e), C.n, Base.items, l, type(d).__name__"
_ODD = (
    *("l.append(x)", "del l[3:]", "d += x", "c.items += [y]", "t = l, c.items", "x, *y = 1, 2, 3"),
    *("y = len(l)", "del z; z = 4", "list(later(y))", "l = sorted(l, key=lambda v: v % 3)"),
    *("x = [*later(x)][-1]", "d = D(x)", "(x, (y, z)) = 1, (2, 3)", "c.m = e.m", "print(end='')"),
)


def _indented(lines: list[str]) -> list[str]:
    return [f"    {line}" for line in lines]


def module_text(random: Random) -> str | None:
    """One module with a function `run`; None where it is no Python after all."""
    text = Drawing(random).module()
    try:
        compile(text, "drawn", "exec")
    except SyntaxError:  # as of `[x := 1 for x in l]`
        return None
    return text
