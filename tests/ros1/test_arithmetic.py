"""Drawn statements, run by a generated node on a real roscore, against a small interpreter."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from rebsync import model as m
from rebsync.config import Config
from rebsync.grammars.parser import parse_model
from rebsync.source import Source
from tests.forward.compiling import generated, written
from tests.ros1.arithmetic import Abandoned, State, Undefined, Value, run
from tests.ros1.conftest import Build
from tests.ros1.run import Clock
from tests.ros1.run import run as launch

_CASES = 250
_INTEGERS = ("byte", "short", "int")
_NUMBERS = (*_INTEGERS, "float", "double")
_VARIABLES = {
    "byte": ("b1", "b2"),
    "short": ("s1", "s2"),
    "int": ("i1", "i2", "i3"),
    "float": ("f1", "f2"),
    "double": ("d1", "d2"),
    "boolean": ("p1", "p2"),
}
_ARRAYS = {"int": "ai", "byte": "ab", "double": "ad"}
_TYPES = {n: t for t, names in _VARIABLES.items() for n in names} | {
    n: t for t, n in _ARRAYS.items()
}
START: dict[str, Value] = {
    **{"b1": 100, "b2": -3, "s1": 30000, "s2": -7, "i1": 5, "i2": -2000000000, "i3": 1},
    **{"f1": 0.5, "f2": -3.25, "d1": 1.75, "d2": -100.5, "p1": True, "p2": False},
    **{"ai": [1, 2, 3], "ab": [4, -5, 6], "ad": [0.5, 1.5, -2.5]},
}


class _Drawing:
    """Draws text that the static rules accept."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)

    def one(self, *options: str) -> str:
        return self.random.choice(options)

    def body(self) -> str:
        return " ".join(self.statement() for _ in range(self.random.randint(2, 4)))

    def statement(self) -> str:
        if self.random.random() < 0.2:
            return f"if ({self.boolean(2)}) {{ {self.statement()} }} else {{ {self.statement()} }}"
        return f"{self.effect()};"

    def effect(self) -> str:
        kind = self.one(*_NUMBERS, "int", "int", "boolean")
        if kind == "boolean":
            return f"{self.place(kind)} {self.one('=', '&=', '|=', '^=')} {self.boolean(2)}"
        if kind in _INTEGERS and self.random.random() < 0.2:
            return self.step(kind)
        operators = ["=", "=", "+=", "-=", "*=", "/="]
        operators += ["%=", "<<=", ">>=", "&=", "|=", "^="] if kind in _INTEGERS else []
        return f"{self.place(kind)} {self.one(*operators)} {self.number(kind, 3)}"

    def place(self, kind: str) -> str:
        if kind in _ARRAYS and self.random.random() < 0.3:
            return f"{_ARRAYS[kind]}[{self.index()}]"
        return self.one(*_VARIABLES[kind])

    def index(self) -> str:
        return self.one(
            "0", "1", "2", "i3", "i3++ & 1", "--i3 & 1", "i1 % 3", self.number("int", 1)
        )

    def step(self, kind: str) -> str:
        place, sign = self.place(kind), self.one("++", "--")
        return self.one(f"{place}{sign}", f"{sign}{place}")

    def number(self, kind: str, depth: int) -> str:
        if depth == 0 or self.random.random() < 0.2:
            return self.leaf(kind)
        less = depth - 1
        match self.random.randint(0, 9):
            case 0 | 1 | 2 | 3:
                operators = ["+", "-", "*", "/"]
                operators += ["%", "<<", ">>", "&", "|", "^"] if kind in _INTEGERS else []
                left, right = self.number(kind, less), self.number(self.narrower(kind), less)
                return f"({left}) {self.one(*operators)} ({right})"
            case 4:
                return (
                    f"{self.one('-', '+', *('~' * (kind in _INTEGERS)))}({self.number(kind, less)})"
                )
            case 5:
                return f"({kind}) ({self.number(self.one(*_NUMBERS), less)})"
            case 6:
                return f"({self.boolean(less)} ? {self.number(kind, less)} : {self.leaf(kind)})"
            case 7 if kind in _INTEGERS:
                return self.step(kind)
            case 8:
                return f"({self.place(kind)} = {self.number(kind, less)})"
            case 9 if kind == "double":
                return f"sqrt({self.one('f1', 'i1', '2', '1.5', 'd1')} * 0 + 2)"
            case _:
                return self.number(self.narrower(kind), less)

    def narrower(self, kind: str) -> str:
        return self.random.choice(_NUMBERS[: _NUMBERS.index(kind) + 1])

    def leaf(self, kind: str) -> str:
        if self.random.random() < 0.7:
            return self.place(kind)
        match kind:
            case "byte":
                return str(self.random.choice([0, 1, 2, 3, 7, 31, 100, 127]))
            case "short":
                return str(self.random.choice([0, 33, 300, 32767]))
            case "int":
                return str(self.random.choice([1, 40, 65536, 2147483647]))
            case _:
                return self.one("0.5", "1.25", "3.0", "0.1")

    def boolean(self, depth: int) -> str:
        if depth == 0:
            return self.one("p1", "p2", "true", "false")
        less = depth - 1
        match self.random.randint(0, 4):
            case 0 | 1:
                kind, sign = self.one(*_NUMBERS), self.one("<", "<=", ">", ">=", "==", "!=")
                return f"({self.number(kind, less)}) {sign} ({self.number(kind, less)})"
            case 2:
                sign = self.one("&&", "||", "&", "|", "^", "==", "!=")
                return f"({self.boolean(less)}) {sign} ({self.boolean(less)})"
            case 3:
                return f"!({self.boolean(less)})"
            case _:
                return f"({self.place('boolean')} = {self.boolean(less)})"


def model_of(bodies: list[str]) -> str:
    """A model whose methods are bodies."""
    variables = " ".join(f"{t} {', '.join(names)};" for t, names in _VARIABLES.items())
    arrays = " ".join(f"{t}[3] {name};" for t, name in _ARRAYS.items())
    resets = []
    for name, value in START.items():
        places: list[tuple[str, Value]] = [(name, value)]
        if isinstance(value, list):
            places = [(f"{name}[{i}]", v) for i, v in enumerate(value)]
        for place, start in places:
            resets.append(f"{place} = {str(start).lower()};")
    cases = " ".join(f"case {i}: m{i}(); break;" for i in range(len(bodies)))
    methods = "\n  ".join(f"void m{i}() {{ {body} }}" for i, body in enumerate(bodies))
    return f"""reactiveclass Calc(3) {{
  statevars {{ int number; {variables} {arrays} }}
  Calc() {{ self.go(0); }}
  msgsrv go(int k) {{
    number = k;
    if (k < {len(bodies) - 1}) self.go(k + 1);
    {" ".join(resets)}
    switch (k) {{ {cases} }}
  }}
  {methods}
}}
main {{ Calc calc():(); }}
"""


def drawn_bodies(count: int) -> list[str]:
    """Bodies, always the same, whose results the meaning does not leave open."""
    drawn = [_Drawing(seed).body() for seed in range(2 * count)]
    return [b for b, e in zip(drawn, expected_values(drawn), strict=True) if e is not None][:count]


def expected_values(bodies: list[str]) -> list[dict[str, Value] | None]:
    """The variables after each body, or None where the meaning leaves the result open."""
    model = parse_model(Source("calc", model_of(bodies))).model
    declaration = model.classes[0]
    assert isinstance(declaration, m.ReactiveClass)
    methods = [x for x in declaration.members if isinstance(x, m.Method)]
    return [_after(method.body) for method in methods]


def _after(body: m.Block | None) -> dict[str, Value] | None:
    assert body is not None
    start = {n: list(v) if isinstance(v, list) else v for n, v in START.items()}
    state = State(_TYPES, start)
    try:
        run(body, state)
    except Abandoned:
        pass
    except Undefined:
        return None
    return state.values


@pytest.fixture(scope="module")
def bodies() -> list[str]:
    return drawn_bodies(_CASES)


def test_arithmetic(bodies: list[str], build_workspace: Build, tmp_path: Path) -> None:
    assert len(bodies) == _CASES
    package = written(generated(model_of(bodies), "calc"), tmp_path, "calc", Config())
    workspace = build_workspace("calc", [package])
    clock = Clock(until=5, quiet=2)
    recording = launch(workspace, package / "launch" / "calc.launch", tmp_path, clock)
    served = {s.state["number"]: s.state for s in recording.bodies("calc")}
    assert sorted(served) == list(range(_CASES))
    wrong = []
    for number, wanted in enumerate(expected_values(bodies)):
        assert wanted is not None
        found = {name: served[number][name] for name in wanted}
        if found != wanted:
            differ = {n: (found[n], wanted[n]) for n in wanted if found[n] != wanted[n]}
            wrong.append(f"{bodies[number]}\n    {differ}")
    assert not wrong, "\n".join(wrong)
