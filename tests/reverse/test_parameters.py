"""Parameter files: YAML 1.1 as rosparam takes it, with the place of each value."""

from __future__ import annotations

import math

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from rebsync.reverse.launch.parameters import ParameterValue, Struct, read_parameters
from rebsync.reverse.unknowns import Open
from rebsync.source import Source


def values(text: str) -> dict[str, ParameterValue | Open]:
    return {p.name: p.value for p in read_parameters(Source("p.yaml", text)).entries}


def test_mappings_become_parts_of_names() -> None:
    found = read_parameters(Source("p.yaml", "a: 1\nb:\n  c: x\n  d: {e: 2.5, f: [1, on]}\n"))
    assert [(p.name, p.value) for p in found.entries] == [
        ("a", 1),
        ("b/c", "x"),
        ("b/d/e", 2.5),
        ("b/d/f", (1, True)),
    ]
    assert [p.source.slice(p.span) for p in found.entries] == ["1", "x", "2.5", "[1, on]"]
    assert not found.unknowns


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("010", 8),
        ("0x1F", 31),
        ("1_000", 1000),
        ("1:30", 90),
        ("1e-07", "1e-07"),
        ("1.0e-07", 1e-07),
        ("yes", True),
        ("'yes'", "yes"),
        ("y", "y"),
        ("rad(pi/2)", math.pi / 2),
        ("deg(180)", math.pi),
        ("!degrees 90", math.pi / 2),
        ("!radians 2*pi", 2 * math.pi),
        ("'deg(180)'", "deg(180)"),
        ("[{a: 1, b: x}, 2]", (Struct((("a", 1), ("b", "x"))), 2)),
    ],
)
def test_values(text: str, value: ParameterValue) -> None:
    (found,) = values(f"v: {text}").values()
    assert (found, type(found)) == (value, type(value))


@pytest.mark.parametrize(
    "text",
    [
        "",
        "~",
        "2020-01-31",
        "2020-13-45",
        "!!binary aGVsbG8=",
        "!!python/object:os.system x",
        "!!int x",
        "!other x",
        "4294967296",
        "[1, ~]",
        "[{1: a}]",
        "rad(open)",
        "=",
    ],
)
def test_what_the_server_cannot_hold_is_open(text: str) -> None:
    found = read_parameters(Source("p.yaml", f"a: 1\nv: {text}\n"))
    assert isinstance(found.entries[1].value, Open)
    assert [u.what for u in found.unknowns] == ["the parameter `v`"]
    assert found.unknowns[0].source.position(found.unknowns[0].span.start).line == 2


def test_the_last_of_several_counts() -> None:
    assert values("a: 1\nb: 2\na: 3\n") == {"b": 2, "a": 3}


def test_anchors_and_merges() -> None:
    text = "x: &x {a: 1, b: 2}\ny: &y {b: 3}\nz: {<<: [*y, *x], a: 4}\nw: *x\n"
    assert values(text) == {
        **{"x/a": 1, "x/b": 2, "y/b": 3},
        **{"z/b": 3, "z/a": 4, "w/a": 1, "w/b": 2},
    }


def test_a_lone_value_has_no_name() -> None:
    assert values("[1, 2]") == {"": (1, 2)}
    assert values("") == {}
    assert values("{}") == {}


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("a: [1\nb: 2", 2),
        ("a:\n\tb: 1", 2),
        ("a: 1\n---\nb: 2", 2),
        ("a: \x07", 1),
        ("a: &x [*x]", 1),
        ("[" * 5000, 1),
        ("1: a", 1),
        ("~a: 1", 1),
        ("yes: 1", 1),
        ("a: {<<: 1}", 1),
    ],
)
def test_mistakes_have_a_place(text: str, line: int) -> None:
    found = read_parameters(Source("p.yaml", text))
    assert [u.source.position(u.span.start).line for u in found.unknowns] == [line]


def test_aliases_that_double_end() -> None:
    doubled = "".join(f"a{i + 1}: &a{i + 1} [*a{i}, *a{i}]\n" for i in range(40))
    assert read_parameters(Source("p.yaml", f"a0: &a0 [1]\n{doubled}")).unknowns
    merged = "".join(f"a{i + 1}: &a{i + 1} {{<<: [*a{i}, *a{i}]}}\n" for i in range(40))
    assert read_parameters(Source("p.yaml", f"a0: &a0 {{b: 1}}\n{merged}")).unknowns


_SCALARS = (
    st.booleans() | st.integers(-99, 99) | st.floats(-9, 9) | st.text("ab: #'\n~0", max_size=5)
)
_VALUES = st.recursive(
    _SCALARS,
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.text("abc", min_size=1), inner, max_size=3)
    ),
)


def _plain(value: object) -> object:
    match value:
        case list():
            return tuple(map(_plain, value))
        case dict():
            return Struct(tuple((k, _plain(v)) for k, v in value.items()))  # type: ignore[misc]
        case _:
            return value


@given(_VALUES)
def test_what_pyyaml_writes_is_read(value: object) -> None:
    text = yaml.safe_dump({"v": [value]}, sort_keys=False)
    assert values(text) == {"v": (_plain(value),)}


@given(st.text() | st.text("ab:{}[]-&*!<>|'\"\n #,?%@`~"))
def test_any_text_is_read(text: str) -> None:
    found = read_parameters(Source("p.yaml", text))
    assert all(str(u) for u in found.unknowns)
