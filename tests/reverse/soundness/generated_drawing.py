"""Draws what people write into generated Python, where the model says it otherwise."""

from __future__ import annotations

from random import Random

SERVERS = 8
MODEL = """
reactiveclass Calc(9) {
  knownrebecs { Sink sink; }
  statevars { int a; int b; int c; boolean f; boolean g; int[3] xs; int[3] ys; boolean[3] fs; }
  Calc() { self.tell(0); }
  msgsrv tell(int n) { sink.got(n); sink.said(true); }
  SERVERS
  int help(int n) { c = c + n; xs[1] = c; return c - n; }
  int twice(int n) { return n + n; }
}
reactiveclass Sink(9) {
  statevars { int last; boolean flag; }
  Sink() { last = 0; }
  msgsrv got(int v) { last = v; }
  msgsrv said(boolean v) { flag = v; }
}
main { Calc calc(sink):(); Sink sink():(); }
"""
_FUNCTIONS = """

def clamp(x: int, low: int, high: int) -> int:
    if x < low:
        return low
    return min(x, high)


def weight(p: bool, x: int) -> int:
    x += 1
    return x if p else -x


class Calc:
    @staticmethod
    def apart(x: int, y: int) -> int:
        return abs(x - y)

    @classmethod
    def nearest(cls, x: int, y: int) -> int:
        found = x
        for each in (3, 1, -2):
            if cls.apart(each, y) < cls.apart(found, y):
                found = each
        return found

    @staticmethod
    def spread(values: Array[int, Literal[3]]) -> int:
        return max(values) - min(values)
"""
_SIGNS = ("<", "<=", ">", ">=", "==", "!=")
_WHOLES = ("self._a", "self._b", "self._c", "k", "n", "0", "1", "2", "-1", "4")
_TRUTHS = ("self._f", "self._g", "p", "True", "False")


def server_model() -> str:
    """The model with its servers, whose bodies nobody has written yet."""
    servers = (f"msgsrv m{i}(int n, int k, boolean p) {{ a = 1; }}" for i in range(SERVERS))
    return MODEL.replace("SERVERS", "\n  ".join(servers))


def edited(text: str, seed: int) -> str:
    """The class of generated code with drawn bodies, and functions that these call."""
    random = Random(seed)
    for number in range(SERVERS):
        head = f"def m{number}(self, n: int, k: int, p: bool) -> None:\n"
        old = f"{head}        self._a = 1\n"
        assert old in text
        body = "".join(f"        {line}\n" for line in Body(random).lines(0, 4))
        text = text.replace(old, head + body)
    functions, own = _FUNCTIONS.split("class Calc:\n")
    text = text.replace(
        "    # rebsync: method Calc.help", f"{own}\n    # rebsync: method Calc.help"
    )
    text = text.replace(", int32, text", ", divide, int32, remainder, text")
    return text.replace(
        "\n\n# rebsync: reactiveclass Calc", f"{functions}\n# rebsync: reactiveclass Calc", 1
    )


class Body:
    """Draws the statements of one server: what is known is what Python has set for certain."""

    def __init__(self, random: Random) -> None:
        self.random = random
        self.wholes: list[str] = []
        self.truths: list[str] = []
        self.fixed: list[str] = []  # what loops count with, never below 0 nor above 2
        self.count = 0
        self.in_loop = False

    def lines(self, depth: int, most: int) -> list[str]:
        """A block, behind which nothing that it names first is used."""
        known = len(self.wholes), len(self.truths), len(self.fixed)
        found = [x for _ in range(self.random.randint(1, most)) for x in self.statement(depth)]
        del self.wholes[known[0] :], self.truths[known[1] :], self.fixed[known[2] :]
        return found

    def statement(self, depth: int) -> list[str]:
        simple = [
            self.assign,
            self.assign,
            self.many,
            self.send,
            self.local,
            self.grow,
            self.whole_array,
        ]
        nested = [self.branch, self.walrus, self.each, self.each, self.counting, self.tried]
        nested += [self.matched, self.inner, self.either]
        return self.random.choice(simple + nested if depth < 2 else simple)(depth)

    def fresh(self, word: str) -> str:
        self.count += 1
        return f"{word}{self.count}"

    def one(self, *options: str) -> str:
        return self.random.choice(options)

    # --- statements -----------------------------------------------------------------------------

    def place(self) -> str:
        index = self.index()
        return self.one("self._a", "self._b", "self._c", f"self._xs[{index}]", *self.wholes)

    def index(self) -> str:
        return self.one("0", "1", "2", "n", *self.fixed)

    def assign(self, depth: int) -> list[str]:
        match self.random.randint(0, 5):
            case 0:
                return [f"{self.one('self._f', 'self._g', *self.truths)} = {self.truth(2)}"]
            case 1:
                return [f"self._fs[{self.index()}] = {self.truth(1)}"]
            case 2:
                return [f"{self.place()} = {self.place()} = {self.plain()}"]
            case _:
                return [f"{self.place()} = {self.whole(2)}"]

    def grow(self, depth: int) -> list[str]:
        return [f"{self.place()} {self.one('+=', '-=', '&=', '|=', '^=')} {self.whole(1)}"]

    def many(self, depth: int) -> list[str]:
        match self.random.randint(0, 3):
            case 0:
                one, other = self.place(), self.place()
                return [f"{one}, {other} = {other}, {one}"]
            case 1:
                places = [self.place() for _ in range(3)]
                return [f"{', '.join(places)} = {self.one('self._xs', 'self._ys')}"]
            case 2:
                places = [self.place() for _ in range(2)]
                return [f"{', '.join(places)} = {self.plain()}, {self.plain()}"]
            case _:
                names = [self.fresh("u"), self.fresh("u")]
                given = [self.plain(), self.plain()]
                self.wholes += names
                return [f"{', '.join(names)} = {', '.join(given)}"]

    def send(self, depth: int) -> list[str]:
        if self.random.random() < 0.5:
            return [f"self.send_sink_got({self.whole(1)})"]
        return [f"self.send_sink_said({self.truth(2)})"]

    def local(self, depth: int) -> list[str]:
        if self.random.random() < 0.3:
            name, value = self.fresh("t"), self.truth(2)
            self.truths.append(name)
        else:
            name, value = self.fresh("n"), self.whole(2)
            self.wholes.append(name)
        return [f"{name} = {value}"]

    def whole_array(self, depth: int) -> list[str]:
        name = self.one("_xs", "_ys")
        values = ", ".join(self.plain() for _ in range(3))
        other = "_ys" if name == "_xs" else "_xs"
        loop = f"{self.element('x')} for x in {self.one(f'self.{other}', '(1, k, -2)')}"
        return [f"self.{name} = Array([{self.one(values, values, loop)}])"]

    def branch(self, depth: int) -> list[str]:
        found = [f"if {self.condition()}:", *_in(self.lines(depth + 1, 2))]
        if self.random.random() < 0.3:
            found += [f"elif {self.condition()}:", *_in(self.lines(depth + 1, 2))]
        if self.random.random() < 0.4:
            found += ["else:", *_in(self.lines(depth + 1, 2))]
        if self.random.random() < 0.15:
            found += [f"if {self.truth(1)}:", f"    {self.leave()}"]
        return found

    def leave(self) -> str:
        return self.one("return", *(("break", "continue") if self.in_loop else ()))

    def either(self, depth: int) -> list[str]:
        """A local that both branches set."""
        name, values = self.fresh("e"), (self.whole(1), self.whole(1))
        found = [f"if {self.condition()}:", f"    {name} = {values[0]}"]
        found += ["else:", f"    {name} = {values[1]}"]
        self.wholes.append(name)
        return found

    def walrus(self, depth: int) -> list[str]:
        name, value = self.fresh("w"), self.whole(1)
        known = len(self.wholes)
        head = self.one(
            f"({name} := {value}) {self.one(*_SIGNS)} {self.whole(1)}",
            f"{self.one(*_TRUTHS)} {self.one('and', 'or')} ({name} := {value}) > 0",
        )
        self.wholes.append(name)
        inner = self.lines(depth + 1, 2)
        if self.random.random() < 0.5:
            del self.wholes[known:]
        return [f"if {head}:", *_in(inner)]

    def each(self, depth: int) -> list[str]:
        """A loop through values that are known by then."""
        number, value, other = self.fresh("i"), self.fresh("v"), self.fresh("v")
        xs, ys = "self._xs", "self._ys"
        head, fixed, wholes = self.random.choice(
            [
                (f"{number}, {value} in enumerate({self.one(xs, ys)})", [number], [value]),
                (f"{value}, {other} in zip({xs}, {ys})", [], [value, other]),
                (f"{value} in {self.one(xs, ys)}", [], [value]),
                (f"{value} in {self.one('(1, 5, -2)', '[4, 4]', '(0,)')}", [], [value]),
                (
                    f"{number} in range({self.one('3', '1, 3', '2, 0, -1', '0, 3, 2')})",
                    [number],
                    [],
                ),
                (f"{number} in reversed(range(3))", [number], []),
                (f"{value} in range(n)", [value], []),
            ]
        )
        return [f"for {head}:", *self.round(depth, fixed, wholes)]

    def round(self, depth: int, fixed: list[str], wholes: list[str]) -> list[str]:
        outer, self.in_loop = self.in_loop, True
        known = len(self.fixed), len(self.wholes)
        self.fixed += fixed
        # What a loop gives is not stored in: extraction lists that.
        inner = self.lines(depth + 1, 3)
        shown = self.random.choice((*fixed, *wholes))
        inner.insert(0, self.one(f"self._b += {shown}", f"self.send_sink_got({shown})"))
        del self.fixed[known[0] :], self.wholes[known[1] :]
        self.in_loop = outer
        return _in(inner)

    def counting(self, depth: int) -> list[str]:
        name = self.fresh("w")
        most = self.random.randint(1, 4)
        inner = self.round(depth, [], [name])
        match self.random.randint(0, 2):
            case 0:
                return [f"{name} = 0", f"while ({name} := {name} + 1) < {most}:", *inner]
            case 1:
                start = [f"{name} = {most}", "while True:", f"    {name} -= 1"]
                return [*start, f"    if {name} < 0:", "        break", *inner]
            case _:
                return [f"{name} = {most}", f"while {name}:", f"    {name} -= 1", *inner]

    def tried(self, depth: int) -> list[str]:
        outer, self.in_loop = self.in_loop, False
        found = ["try:", *_in(self.lines(depth + 1, 2)), "finally:", *_in(self.lines(2, 1))]
        self.in_loop = outer
        return found

    def matched(self, depth: int) -> list[str]:
        found = [f"match {self.one('n', 'k', 'self._a')}:"]
        cases = self.random.sample(("0", "1 | 2", "-1", "3", "_"), 3)
        for case in sorted(cases, key="_".__eq__):
            found += [f"    case {case}:", *_in(_in(self.lines(depth + 1, 2)))]
        return found

    def inner(self, depth: int) -> list[str]:
        name = self.fresh("act")
        lines = [f"self.send_sink_got({self.whole(1)})"]
        found = [f"def {name}() -> None:", *_in(lines), *self.assign(depth), f"{name}()"]
        return [*found, f"if {self.truth(1)}:", f"    {name}()"]

    # --- expressions ----------------------------------------------------------------------------

    def plain(self) -> str:
        """What is the same however often it is evaluated; seldom something else."""
        if self.random.random() < 0.1:
            return self.whole(1)
        return self.one(self.whole(0), f"{self.whole(0)} {self.one(*'+-')} {self.whole(0)}")

    def whole(self, depth: int) -> str:
        if depth == 0 or self.random.random() < 0.25:
            index = self.index()
            elements = (f"self._xs[{index}]", f"self._ys[{index}]")
            return self.one(*_WHOLES, *self.wholes, *self.wholes, *self.fixed, *elements)
        one, other = self.whole(depth - 1), self.whole(depth - 1)
        return self.one(
            f"({one} + {other})",
            f"({one} - {other})",
            f"({one}) * 2",
            f"-({one})",
            f"({one} {self.one(*'&|^')} {other})",
            f"({one} if {self.truth(depth - 1)} else {other})",
            f"divide({one}, {self.one('2', '3', '-2')})",
            f"remainder({one}, {self.one('2', '3', '-2')})",
            f"abs({self.plain()})",
            f"int({self.truth(depth - 1)})",
            f"{self.one('min', 'max')}({self.plain()}, {self.plain()})",
            f"{self.one('min', 'max')}({self.plain()}, {self.whole(0)}, k)",
            f"sum({self.values()})",
            f"{self.one('min', 'max')}({self.one('self._xs', self.values())})",
            f"sum({self.truths_of()})",
            f"self.help({one})",
            f"self.twice({one})",
            f"clamp({one}, {self.one('0', '-1')}, {other})",
            f"weight({self.truth(depth - 1)}, {one})",
            f"{self.one('self', 'Calc')}.apart({one}, {other})",
            f"self.nearest({one}, {other})",
            "self.spread(self._xs)",
        )

    def values(self) -> str:
        """Something that `min`, `max` and `sum` go through."""
        of = self.one("self._xs", "self._ys", "(1, k, 1)", "{1, 2}", "{k, 1, n}", "range(3)")
        return self.one(
            self.one("self._xs", "self._ys", "[1, k, n]", "{k, 1, n}"),
            f"{self.element('x')} for x in {of}",
            f"{self.element('x')} for x in {of} if {self.test('x')}",
            f"[{self.element('x')} for x in {of} if {self.test('x')}]",
            self.one(
                "x * y for x, y in zip(self._xs, self._ys)", "i - x for i, x in enumerate(self._ys)"
            ),
            f"x * i for i, x in enumerate(self._xs) if {self.test('i')}",
            f"i for i, x in enumerate([x for x in self._xs if {self.test('x')}])",
        )

    def element(self, name: str) -> str:
        return self.one(
            name, f"{name} + 1", f"-{name}", f"abs({name})", f"{name} * 2", f"max({name}, n)"
        )

    def test(self, name: str) -> str:
        return self.one(f"{name} > 0", f"{name} != k", f"{name}", f"0 <= {name} < 3", "p")

    def truths_of(self) -> str:
        """Something that `any` and `all` go through."""
        return self.one(
            "self._fs",
            f"{self.test('x')} for x in self._xs".replace("x for", "x != 0 for"),
            "x > 0 for x in self._xs if x != k",
            "not x for x in self._fs",
            "x < y for x, y in zip(self._xs, self._ys)",
            "x == i for i, x in enumerate(self._xs)",
            "self._xs[i] > k for i in range(3)",
        )

    def condition(self) -> str:
        return self.one(self.truth(2), self.truth(1), self.whole(1))

    def truth(self, depth: int) -> str:
        if depth == 0 or self.random.random() < 0.2:
            return self.one(*_TRUTHS, *self.truths, f"self._fs[{self.index()}]")
        sign, other = self.one(*_SIGNS), self.one(*_SIGNS)
        one, two = self.truth(depth - 1), self.truth(depth - 1)
        return self.one(
            f"({self.whole(depth - 1)} {sign} {self.whole(depth - 1)})",
            f"({self.whole(0)} {sign} {self.whole(0)} {other} {self.whole(0)})",
            f"({self.whole(0)} {self.one('in', 'not in')} (0, k, {self.whole(0)}))",
            f"({one} {self.one('and', 'or')} {two})",
            f"({one} {self.one('==', '!=')} {self.one(two, two, two, self.whole(0))})",
            f"(not {one})",
            f"bool({self.whole(depth - 1)})",
            f"{self.one('any', 'all')}({self.truths_of()})",
            f"{self.one('any', 'all')}([self._f, p])",
            f"(not {self.whole(0)})",
        )


def _in(lines: list[str]) -> list[str]:
    return [f"    {line}" for line in lines]
