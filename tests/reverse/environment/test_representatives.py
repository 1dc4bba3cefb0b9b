"""Representatives of regions show all that the values of a whole range do.

Models are drawn whose open server compares and copies what it gets; a property is violated with
representatives exactly if it is with all numbers of a range that has all constants inside.
"""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rebsync import model as m
from rebsync.checker.problem import Options, Problem
from rebsync.checker.result import Result
from rebsync.checker.verify import verify
from rebsync.grammars.parser import parse_model
from rebsync.grammars.properties import parse_properties
from rebsync.printing import print_model
from rebsync.reverse.build.message_types import MessageTypes
from rebsync.reverse.environment import closing
from rebsync.reverse.environment.closing import closed
from rebsync.reverse.environment.representatives import Representatives, representatives
from rebsync.reverse.nodes.open_ends import OpenEnd
from rebsync.source import Source
from rebsync.static import analyse

_TYPES = MessageTypes({}, "")
_END = OpenEnd("A", "a", "got", "/topic", None, ("value",))
_ALL = tuple(range(-5, 6))  # all regions between constants of -3 to 3

_constants = st.integers(-3, 3)
_operands = st.sampled_from(["v", "x", "y"])
_comparisons = st.builds(
    lambda left, sign, right: f"{left} {sign} {right}",
    _operands,
    st.sampled_from(["==", "!=", "<", "<=", ">", ">="]),
    _constants,
)
_conditions = st.one_of(
    _comparisons,
    st.builds(lambda a, b: f"({a}) && !({b})", _comparisons, _comparisons),
    st.just("b"),
)
_simple = st.one_of(
    st.builds(lambda to, of: f"{to} = {of};", st.sampled_from(["x", "y"]), _operands),
    st.builds(lambda to, of: f"{to} = {of};", st.sampled_from(["x", "y"]), _constants),
    st.builds(lambda c: f"b = {c};", _conditions),
    st.builds(lambda c, of: f"x = ({c}) ? {of} : y;", _comparisons, _operands),
    st.builds(lambda of: f"self.later({of});", _operands),
    st.builds(lambda of: f"x = half({of});", _operands),
)
_statements = st.one_of(
    _simple,
    st.builds(lambda c, a, b: f"if ({c}) {{ {a} }} else {{ {b} }}", _conditions, _simple, _simple),
    st.builds(
        lambda of, at, a: f"switch ({of}) {{ case {at}: {a} break; default: y = {at}; }}",
        _operands,
        st.integers(0, 3),
        _simple,
    ),
)
_MODEL = """reactiveclass A(12) {{
  statevars {{ int x; int y; boolean b; int[2][2] g; }}
  A() {{ x = 0; y = 0; b = false; }}
  int half(int given) {{ return given; }}
  @Open msgsrv got(int v) {{ {} }}
  msgsrv later(int w) {{ y = w; }}
}}
main {{ A a():(); }}
"""


def _verified(model: m.Model, properties: Source) -> Result:
    source = Source("a.rebeca", print_model(model))
    analysis = analyse(parse_model(source).model)
    assert not analysis.errors
    parsed = parse_properties(properties).properties
    return verify(Problem(source, analysis, parsed, properties), Options(engine="interpreted"))


@given(body=st.lists(_statements, min_size=1, max_size=4), asked=_conditions, other=_comparisons)
def test_representatives_show_what_all_values_do(body: list[str], asked: str, other: str) -> None:
    parsed = parse_model(Source("a.rebeca", _MODEL.format(" ".join(body))))
    assert parsed.ok
    names = {"x": "a.x", "y": "a.y", "v": "a.y", "b": "a.b"}
    texts = ["".join(names.get(c, c) for c in text) for text in (asked, other)]
    text = f"property {{ Assertion {{ P: !({texts[0]}); Q: {texts[1]} || a.b; }} }}"
    properties = Source("a.property", text)
    read = parse_properties(properties).properties
    few = closed(parsed.model, [_END], read, _TYPES)
    assert not few.gaps
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(closing, "representatives", lambda *_: Representatives(_ALL, True))
        every = closed(parsed.model, [_END], read, _TYPES)
    verdicts = [dict(_verified(c.model, properties).properties) for c in (few, every)]
    assert verdicts[0] == verdicts[1]


def _of(body: str, type_: str = "int") -> Representatives:
    model = parse_model(
        Source("a.rebeca", _MODEL.format(body).replace("int v", f"{type_} v"))
    ).model
    empty = parse_properties(Source("a.property", "property {}")).properties
    return representatives(model, [("A.got", "v")], m.Type(type_), empty)


@pytest.mark.parametrize(
    "body",
    [
        "x = v + 1;",
        "if (v > x + y) b = true;",
        "if (-v > 1) b = true;",
        "x += v;",
        "x = (byte) v;",
        "delay(v);",
        "self.later(1) after(v);",
        "x = v; y = x * 2;",
        "b = half(v) == half(y);",
        "x = abs(v);",
        "g[v][0] = 1;",
    ],
)
def test_what_does_more_than_to_copy_and_compare_is_not_exact(body: str) -> None:
    assert not _of(body).is_exact


@pytest.mark.parametrize(
    ("body", "type_", "values"),
    [
        ("x = v;", "int", (0,)),
        ("b = v > 3;", "int", (0, 3, 4)),
        ("b = v < -3;", "int", (-4, -3, 0)),
        ("b = v == 1; b = v == 2;", "int", (0, 1, 2, 3)),
        ("b = v == 1; b = v == 3;", "int", (0, 1, 2, 3, 4)),
        ("b = v > 127;", "byte", (0, 127)),
        ("b = v > 1.5;", "int", (0, 1, 2, 3)),
        ("b = v > 0.5d;", "double", (0.0, 0.5, 1.5)),
        ("b = v > 1; b = v < 2;", "double", (0.0, 1.0, 1.5, 2.0, 3.0)),
        ("g[v > 1 ? 1 : 0][0] = 3;", "int", (0, 1, 2)),
        ("b = v;", "boolean", (False, True)),
    ],
)
def test_there_is_a_value_of_each_region(body: str, type_: str, values: tuple[object, ...]) -> None:
    assert _of(body, type_) == Representatives(values, True)  # type: ignore[arg-type]


def test_an_array_has_no_representatives() -> None:
    model = parse_model(Source("a.rebeca", _MODEL.format("b = v[0] > 1;"))).model
    empty = parse_properties(Source("a.property", "property {}")).properties
    found = representatives(model, [("A.got", "v")], replace(m.Type("int"), dimensions=(3,)), empty)
    assert found == Representatives((), False)
