"""No run of a body shows a number that the interval analysis says cannot be."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from random import Random

import pytest
from hypothesis import HealthCheck, assume, given, note, settings
from hypothesis import strategies as st

from rebsync import model as m
from rebsync.intervals import ANY, Interval
from rebsync.printing import print_expression, print_statement
from rebsync.reverse.analysis.intervals.interval_analysis import IntervalAnalysis
from rebsync.reverse.analysis.intervals.invariants import Body, BodyStart, unbounded
from rebsync.reverse.analysis.intervals.needs import Need
from rebsync.reverse.models.rewriting import rewritten
from tests.reverse.analysis.drawing import BITS, LENGTH, STATE, bodies, type_of, widths
from tests.reverse.analysis.running import Run, Stop, bits_of, is_int

_STARTS = 12
_ALL = (*STATE, "w1", "v1", "u1")
_PYTHON = ("i0", "i2", "i3", "a0")
_EDGES = (0, 1, 2, 7, 100, 2**15, 2**31 - 1, -1, -3, -(2**31), 2**40, -(2**63), 2**64 - 1)
_Values = Mapping[str, "int | list[int]"]


def _start(random: Random, overflowing: set[str]) -> dict[str, int | list[int]]:
    """Values of the state of which wide ones are an `int`, but those that overflow."""

    def one(name: str) -> int:
        bits = bits_of(name)
        least = 0 if bits in (32, 64) else -(1 << bits)
        most = (1 << bits) - 1
        if name not in overflowing:
            least, most = max(least, -(2**31)), min(most, 2**31 - 1)
        known = [n for n in _EDGES if least <= n <= most]
        return random.choice([*known, random.randint(least, most)])

    return {n: [one(n) for _ in range(LENGTH)] if n[0] in "az" else one(n) for n in STATE}


def _analysed(statements: Sequence[m.Statement]) -> tuple[IntervalAnalysis, set[str]]:
    """Analyses again until no variable overflows but those that are taken to."""
    overflowing: set[str] = set()
    while True:
        analysis = IntervalAnalysis(
            {n: b for n, b in widths(_ALL).items() if n not in overflowing},
            {n: type_of(n) for n in STATE},
            always=dict.fromkeys(overflowing, ANY),
            state=STATE,
            called=STATE,
        )
        analysis.body(statements)
        if not analysis.broken:
            return analysis, overflowing
        overflowing |= analysis.broken


@given(bodies(), st.integers(0, 2**32))
def test_numbers_of_a_run_in_cpp_are_in_their_intervals(
    body: tuple[m.Statement, ...], seed: int
) -> None:
    probes = ("w0", "z0", "i0", "s0", "b0", "a0")
    into = [m.Index(m.Name("z0"), m.IntLiteral(number)) for number in range(LENGTH)]
    from_ = [m.Index(m.Name(n), m.IntLiteral(1)) if n[0] in "az" else m.Name(n) for n in probes]
    ends = [m.Assign("=", into[n % LENGTH], value) for n, value in enumerate(from_)]
    note("\n".join(map(print_statement, body)))
    statements = (*body, *(m.ExpressionStatement(e) for e in ends))
    analysis, overflowing = _analysed(statements)

    def stored(name: str, value: int) -> None:
        if name[0] not in BITS or name in overflowing:
            return
        if name in analysis.counted and not is_int(value):
            raise Stop  # it counts for so long: that is told
        assert is_int(value)
        assert analysis.stored[name].includes(Interval(value, value))

    random = Random(seed)
    for _ in range(_STARTS):
        with suppress(Stop):
            left = Run(_start(random, overflowing), random, stored=stored).body(statements)
            _lie_in(left, analysis.left, overflowing | analysis.counted)


def _lie_in(values: _Values, intervals: Mapping[str, Interval], others: set[str]) -> None:
    for name, held in values.items():
        for value in held if isinstance(held, list) else [held]:
            if name in intervals and name not in others:
                assert intervals[name].includes(Interval(value, value)), name


@settings(max_examples=settings().max_examples // 3)
@given(
    st.lists(bodies(_PYTHON, wide=False, calls=False), min_size=2, max_size=3),
    st.integers(0, 2**32),
)
def test_numbers_of_a_class_in_python_are_what_is_proved(
    each: list[tuple[m.Statement, ...]], seed: int
) -> None:
    note("\n// next\n".join("\n".join(map(print_statement, s)) for s in each))
    random = Random(seed)
    sets = [m.Assign("=", m.Name(n), m.IntLiteral(k)) for k, n in enumerate(_PYTHON) if n != "a0"]
    constructor, *servers = [(*(m.ExpressionStatement(s) for s in sets), *each[0]), *each[1:]]
    nodes = [n for s in each for t in s for n in m.walk(t) if isinstance(n, m.Binary | m.Name)]
    needs = {}
    for number, node in enumerate(nodes):
        bounds = Interval(random.choice((-(2**40), -5, 0, 1)), random.choice((1, 3, 100, 2**40)))
        needs[id(node)] = [Need(node, bounds, ("", number, 0, ""))]
    names = frozenset({*_PYTHON, "i1", "i5", "i6", "s1", "b1"})
    first, *others = (
        Body("", BodyStart.BETWEEN, s, {}, needs=needs) for s in (constructor, *servers)
    )
    found = unbounded(first, others, frozenset(_PYTHON), names)
    assume(not found.broken)

    def seen(node: m.Expression, value: int) -> None:
        for need in needs.get(id(node), ()):
            holds = need.bounds.includes(Interval(value, value))
            assert holds or need.mark in found.failed, (print_expression(node), value, need.bounds)

    def stored(name: str, value: int) -> None:
        if name in found.counted and not is_int(value):
            raise Stop
        assert is_int(value)

    for _ in range(_STARTS):
        values: _Values = {n: [0] * LENGTH if n[0] == "a" else 0 for n in _PYTHON}
        with suppress(Stop):
            for statements in (constructor, *random.choices(servers, k=8)):
                values = Run(values, random, False, stored, seen).body(statements)


# --- C++ itself ---------------------------------------------------------------------------------

_TYPES = {"w": "int64_t", "v": "uint64_t", "u": "uint32_t", "z": "int64_t"}
_TYPES |= {"i": "int", "s": "int16_t", "b": "int8_t", "a": "int"}
_CASTS = {"byte": "int8_t", "short": "int16_t"}


@pytest.mark.skipif(shutil.which("g++") is None, reason="g++ is not installed")
@settings(max_examples=1, derandomize=True, suppress_health_check=list(HealthCheck))
@given(st.lists(bodies(calls=False), min_size=60, max_size=60), st.integers(0, 2**32))
def test_runs_are_those_of_cpp(
    tmp_path_factory: pytest.TempPathFactory, drawn: list[tuple[m.Statement, ...]], seed: int
) -> None:
    """What the tests above take for a run is one."""
    random, functions, expected = Random(seed), [], []
    for number, statements in enumerate(drawn):
        for _ in range(4):
            start = _start(random, set())
            with suppress(Stop):
                expected.append(_shown(Run(start, random).body(statements)))
                functions.append(_function(f"f{number}_{len(expected)}", start, statements))
    assert len(expected) > 60
    assert _run(tmp_path_factory.mktemp("runs"), functions) == expected


def _run(folder: Path, functions: Sequence[str]) -> list[str]:
    calls = "".join(f"  {f.split('(')[0].split()[-1]}();\n" for f in functions)
    head = "#include <cstdint>\n#include <cstdio>\n"
    code = folder / "runs.cpp"
    code.write_text(f"{head}{''.join(functions)}int main() {{\n{calls}}}\n")
    command = ["g++", "-std=c++17", "-O0", "-fwrapv", "-w", "-o"]
    subprocess.run([*command, str(folder / "runs"), str(code)], check=True)
    done = subprocess.run([str(folder / "runs")], check=True, capture_output=True, text=True)
    return done.stdout.splitlines()


def _function(name: str, start: _Values, statements: Sequence[m.Statement]) -> str:
    """A function that runs a body and prints what is in its variables then."""
    variables = "".join(f"  {_variable(n, v)};\n" for n, v in start.items())
    body = "\n".join(print_statement(_in_cpp(s)) for s in statements)
    numbers = [f"{n}[{k}]" if n[0] in "az" else n for n in STATE for k in _places(n)]
    prints = "".join(f'  printf("%lld ", (long long){n});\n' for n in numbers)
    return f'void {name}() {{\n{variables}  [&]() {{\n{body}\n  }}();\n{prints}  puts("");\n}}\n'


def _places(name: str) -> range:
    return range(LENGTH if name[0] in "az" else 1)


def _variable(name: str, value: int | list[int]) -> str:
    if isinstance(value, list):
        return f"{_TYPES[name[0]]} {name}[] = {{{', '.join(map(_literal, value))}}}"
    return f"{_TYPES[name[0]]} {name} = {_literal(value)}"


def _literal(value: int) -> str:
    return f"{value}" if value > -(2**31) else f"({value + 1} - 1)"


def _in_cpp(statement: m.Statement) -> m.Statement:
    """The statement with the types of C++."""

    def changed(node: object) -> object:
        match node:
            case m.Declaration(_, (m.Declarator(name),) as declarators):
                return m.Declaration(m.Type(_TYPES[name[0]]), declarators)
            case m.Cast(m.Type(name), operand):
                return m.Cast(m.Type(_CASTS.get(name, name)), operand)
            case _:
                return node

    return rewritten(statement, changed)


def _shown(values: _Values) -> str:
    numbers = [v for n in STATE for v in _listed(values[n])]
    return "".join(f"{v if v < 2**63 else v - 2**64} " for v in numbers)


def _listed(held: int | list[int]) -> list[int]:
    return held if isinstance(held, list) else [held]
