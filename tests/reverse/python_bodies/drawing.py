"""Draws nodes of Python whose callbacks compute, branch, loop and publish."""

from __future__ import annotations

from random import Random

TOPICS = {"on_whole": "Int32", "on_truth": "Bool", "on_real": "Float64", "on_small": "UInt8"}
OUT = {"whole": "Int32", "truth": "Bool", "real": "Float64", "small": "UInt8"}
_WHOLES = (
    "self.a",
    "self.b",
    "self.c",
    "0",
    "1",
    "2",
    "3",
    "5",
    "-1",
    "7",
    "100",
    "65536",
    "LIMIT",
)
_REALS = ("self.r", "0.5", "2.0", "-1.25", "1e3")
# By what a message holds, what a callback may put into it.
_CHANGES = {"whole": ("3", "self.b", "-1"), "truth": ("True", "self.f"), "real": ("0.5", "self.r")}
# Statements of Python that have no like in the model.
_IDIOMS = {
    7: "self.a, self.b = self.b, self.a",
    8: "self.a, self.b, self.c = self.c, self.a, self.b",
    9: "self.a = self.b = self.c",
    10: """for j in (1, self.a, 4):
    if j > self.c:
        break
    self.a = j
else:
    self.b = 3
self.c = j""",
    11: """self.w = 3
while self.w > 0:
    if self.w == self.a:
        break
    self.w -= 1
else:
    self.b = self.w""",
    12: """if (k := self.c) > 2:
    self.a = k
self.b = k""",
    13: """match self.b:
    case 1 | 2:
        self.a = 5
    case -1:
        self.a = 4
    case x if x > 3:
        self.c = x
    case _:
        self.b = 8""",
    14: """self.a = (self.b > 1) + int(self.f) - (self.c == 2)
self.f = (self.f ^ (self.a > 1)) | (self.b == 3)""",
    15: """self.a = self.b or 4
self.b = self.c and self.a
self.f = self.f is True""",
    16: """for v in range(3):
    self.a = v
self.c = v""",
    17: "self.a = self.pick(self.b)",
    18: "self.b = self.step(self.c)",
    19: "self.c = self.first",
}
_METHODS = """
    def pick(self, v):
        k = 2
        if v > 3:
            k = v
        elif v < 0:
            return self.c
        return k if self.f else 1

    def step(self, v):
        self.a = v
        return self.c if self.f else 3

    @property
    def first(self):
        return self.a if self.f else self.b

    def use(self):  # what nobody calls may get anything: here all get numbers
        self.help(self.pick(clamp(1, 2)))
        self.settle(self.step(3))
"""
_SIGNS = ("<", "<=", ">", ">=", "==", "!=")
_SINK = """
class Sink:
    def __init__(self):
        self.got = 0
{subscriptions}
{callbacks}
"""


class Body:
    """Draws the statements of one function; `field` is what its message holds."""

    def __init__(self, random: Random, field: str | None) -> None:
        self.random = random
        self.field = field
        self.locals: list[str] = []
        self.count = 0
        self.beside = Random(f"{random.getstate()[1][:3]} {field}")  # draws nothing of the others

    def lines(self, depth: int, most: int) -> list[str]:
        found: list[str] = []
        for _ in range(self.random.randint(1, most)):
            found += self.unknown() if depth == 0 else []
            found += self.one(depth)
        return found or ["pass"]

    def unknown(self) -> list[str]:
        """Statements on what the model does not have, or not any more."""
        match self.beside.randint(0, 19):
            case 0:
                return ["for each in self.names:", "    self.d = each + self.d"]
            case 1:
                return ["if self.d > 3:", f"    self.a = {self.beside.randint(0, 9)}"]
            case 2:
                return ["for each in self.names:", "    if each > 1:", "        self.settle(each)"]
            case 3:
                return ["self.names.append(2)"]
            case 4 | 5 if self.field in _CHANGES:
                return [f"msg.data = {self.beside.choice(_CHANGES[self.field])}"]
            case 6 if self.field in _CHANGES:
                return ["msg.data += 1" if self.field != "truth" else "msg.data = not msg.data"]
            case number:
                return _IDIOMS.get(number, "").splitlines()

    def one(self, depth: int) -> list[str]:
        draw = self.random.randint(0, 13 if depth < 3 else 7)
        match draw:
            case 0 | 1:
                target = self.random.choice(("self.a", "self.b", "self.c"))
                return [f"{target} = {self.whole(2)}"]
            case 2:
                return [f"self.f = {self.truth(2)}"]
            case 3:
                return [f"self.r = {self.real(2)}"]
            case 4:
                target = self.random.choice(("self.a", "self.b", "self.c"))
                operator = self.random.choice(("+", "-", "*", "//", "%", "&"))
                return [f"{target} {operator}= {self.whole(1)}"]
            case 5:
                return self.publish()
            case 6:
                self.count += 1
                name = f"n{self.count}_{depth}"
                line = f"{name} = {self.whole(2)}"
                if depth == 0:
                    self.locals.append(name)
                return [line]
            case 7:
                return [f"self.{self.random.choice(('help', 'settle'))}({self.whole(1)})"]
            case 8 | 9 | 10:
                found = [f"if {self.truth(2)}:", *_in(self.lines(depth + 1, 2))]
                if self.random.random() < 0.3:
                    found += [f"elif {self.truth(1)}:", *_in(self.lines(depth + 1, 2))]
                if self.random.random() < 0.5:
                    found += ["else:", *_in(self.lines(depth + 1, 2))]
                return found
            case 11:
                self.count += 1
                name = f"i{self.count}"
                bounds = self.random.choice(("3", "1, 4", "5, 0, -2", "self.c % 4"))
                self.locals.append(name)
                inner = self.lines(depth + 1, 2)
                self.locals.remove(name)
                return [f"for {name} in range({bounds}):", *_in(inner)]
            case 12:
                return [f"if {self.truth(1)}:", "    return"]
            case _:
                return [
                    "self.w = 0",
                    f"while self.w < {self.random.randint(1, 4)}:",
                    *_in(self.lines(3, 1)),
                    "    self.w += 1",
                ]

    def publish(self) -> list[str]:
        kind = self.random.choice(tuple(OUT))
        value = {"whole": self.whole, "truth": self.truth, "real": self.real}.get(kind)
        text = (
            value(1) if value is not None else self.random.choice(("3", "self.b % 200", "self.c"))
        )
        if kind == "real":
            text = f"float({text})"
        if self.random.random() < 0.5:
            return [f"self.{kind}_pub.publish({OUT[kind]}(data={text}))"]
        return [f"m = {OUT[kind]}()", f"m.data = {text}", f"self.{kind}_pub.publish(m)"]

    def whole(self, depth: int) -> str:
        if depth == 0 or self.random.random() < 0.3:
            extra = ("msg.data",) * 3 if self.field == "whole" else ()
            return _one(self.random, (*_WHOLES, *self.locals, *extra))
        one, other = self.whole(depth - 1), self.whole(depth - 1)
        match self.random.randint(0, 12):
            case 0 | 1:
                return f"({one} + {other})"
            case 2:
                return f"({one} - {other})"
            case 3:
                return f"{one} * {other}" if self.random.random() < 0.5 else f"({one}) * 2"
            case 4:
                return f"({one}) % {self.random.choice(('5', '7', '-3', 'self.c', '2'))}"
            case 5:
                return f"({one}) // {self.random.choice(('2', '3', 'self.b', '10'))}"
            case 6:
                return f"{self.random.choice(('min', 'max'))}({one}, {other})"
            case 7:
                return f"abs({one})"
            case 8:
                return f"({one} if {self.truth(depth - 1)} else {other})"
            case 9:
                return f"({one} {self.random.choice('&|^')} {other})"
            case 10:
                return f"(-({one}))"
            case 11:
                return f"clamp({one}, 50)"
            case _:
                return f"int({self.truth(depth - 1)})"

    def truth(self, depth: int) -> str:
        if depth == 0 or self.random.random() < 0.2:
            extra = ("msg.data",) * 2 if self.field == "truth" else ()
            return _one(self.random, ("self.f", "True", "False", *extra))
        match self.random.randint(0, 6):
            case 0 | 1 | 2:
                sign, other = self.random.choice(_SIGNS), self.random.choice(_SIGNS)
                tail = f" {other} {self.whole(0)}" if self.random.random() < 0.2 else ""
                return f"({self.whole(depth - 1)} {sign} {self.whole(depth - 1)}{tail})"
            case 3:
                return f"({self.real(depth - 1)} {self.random.choice(_SIGNS)} {self.real(0)})"
            case 4:
                word = self.random.choice(("and", "or"))
                return f"({self.truth(depth - 1)} {word} {self.truth(depth - 1)})"
            case 5:
                return f"(not {self.truth(depth - 1)})"
            case _:
                return f"bool({self.whole(depth - 1)})"

    def real(self, depth: int) -> str:
        if depth == 0 or self.random.random() < 0.3:
            extra = ("msg.data",) * 2 if self.field == "real" else ()
            return _one(self.random, (*_REALS, *extra))
        match self.random.randint(0, 4):
            case 0 | 1:
                sign = self.random.choice("+-*")
                return f"({self.real(depth - 1)} {sign} {self.real(depth - 1)})"
            case 2:
                return f"({self.real(depth - 1)} / {self.random.choice(('2', '4.0', '2.5'))})"
            case 3:
                return f"({self.whole(0)} * {self.real(0)})"
            case _:
                return f"({self.whole(depth - 1)} / {self.random.choice(('2', '3', '8'))})"


def draw_node(seed: int) -> str:
    """A file of Python with a node that computes, and one that gets what it sends."""
    random = Random(seed)
    lines = ["#!/usr/bin/env python3", "import rospy"]
    lines += ["from std_msgs.msg import Bool, Float64, Int32, UInt8", "LIMIT = 40", ""]
    lines += ["def clamp(x, high):", "    return min(max(x, 0), high)", ""]
    lines += ["class Drawn:", "    def __init__(self):"]
    lines += [f"        self.{n} = {random.choice(('0', '1', '5', '-2'))}" for n in "abc"]
    lines += [
        f"        self.f = {random.choice(('True', 'False'))}",
        "        self.r = 0.5",
        "        self.w = 0",
        "        self.d = 0",
        "        self.names = [1, 2]",
    ]
    for kind, type_ in OUT.items():
        lines += [f"        self.{kind}_pub = rospy.Publisher('out/{kind}', {type_}, queue_size=9)"]
    for name, type_ in TOPICS.items():
        lines += [f"        self.{name}_sub = rospy.Subscriber('in/{name}', {type_}, self.{name})"]
    for name in ("help", "settle"):
        body = Body(random, None)
        body.locals.append("given")
        plain = [x for x in body.lines(3, 3) if "self.help" not in x and "self.settle" not in x]
        lines += [f"    def {name}(self, given):", *_in(["    pass", *_in(plain)])]
    for name in TOPICS:
        field = {"on_small": "whole"}.get(name, name.removeprefix("on_"))
        lines += [f"    def {name}(self, msg):", *_in(_in(Body(random, field).lines(0, 4)))]
    lines += _METHODS.splitlines()
    subscriptions = [
        f"        self.{k}_in = rospy.Subscriber('out/{k}', {t}, self.get_{k})"
        for k, t in OUT.items()
    ]
    callbacks = [f"    def get_{k}(self, msg):\n        self.last_{k} = msg.data" for k in OUT]
    sink = _SINK.format(subscriptions="\n".join(subscriptions), callbacks="\n".join(callbacks))
    end = ["if __name__ == '__main__':", "    rospy.init_node('drawn')", "    drawn = Drawn()"]
    return "\n".join([*lines, sink, *end, "    sink = Sink()", "    rospy.spin()", ""])


def _one(random: Random, words: tuple[str, ...]) -> str:
    return random.choice(words)


def _in(lines: list[str]) -> list[str]:
    return [f"    {line}" for line in lines]
