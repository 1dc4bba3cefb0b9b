"""Names of the model in ROS and C++: legal there, and reversible."""

from __future__ import annotations

import re

from hypothesis import given
from hypothesis import strategies as st

from rebsync.names import (
    CPP_KEYWORDS,
    carry,
    field_names,
    free_name,
    graph_name,
    node_name,
    original,
    snake_case,
    uncarry,
)

_WORDS = ("class", "class_v", "x_", "_X", "a__b", "esc_", "esc_z5fz", "zz", "drive_v", "_", "$")
_TAKEN = frozenset({"class", "template", "state", "x"})

names = st.one_of(
    st.sampled_from(_WORDS),
    st.from_regex(r"[A-Za-z_$zéß][\w$]{0,8}", fullmatch=True),
    st.builds(lambda word, times: word + "_v" * times, st.sampled_from(_WORDS), st.integers(0, 3)),
)


@given(names)
def test_carried_names_come_back(name: str) -> None:
    carried = carry(name, _TAKEN)
    assert uncarry(carried, _TAKEN) == name
    assert carried not in _TAKEN
    assert re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", carried)


@given(st.lists(names, unique=True, max_size=6))
def test_carried_names_stay_apart(several: list[str]) -> None:
    assert len({carry(n, CPP_KEYWORDS) for n in several}) == len(several)
    assert len({node_name(n) for n in several}) == len(several)


@given(names)
def test_graph_names_come_back(name: str) -> None:
    graph = graph_name(name)
    assert original(graph) == name
    assert re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", graph)
    assert "__" not in graph


@given(names)
def test_free_names_come_back(name: str) -> None:
    free = free_name(name, _TAKEN)
    assert free not in _TAKEN
    assert re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", free)
    stem = re.sub(r"(_v)+\Z", "", free)
    assert original(free[:-2] if stem in _TAKEN else free) == name


@given(st.lists(names, unique=True, max_size=8), st.sets(st.sampled_from(("timing", "sender"))))
def test_fields_are_distinct_and_legal(several: list[str], taken: set[str]) -> None:
    fields = field_names(several, taken)
    assert len(set(fields)) == len(several)
    assert not taken & set(fields)
    for field in fields:
        assert re.fullmatch(r"[a-z][a-z0-9_]*", field)
        assert field not in CPP_KEYWORDS


def test_words_of_a_name() -> None:
    assert [snake_case(n) for n in ("moveForward", "R_1", "HTTPServer")] == [
        "move_forward",
        "r_1",
        "http_server",
    ]
    assert field_names(["posX", "pos_x", "class", "serialize"]) == (
        "pos_x",
        "pos_x_2",
        "class_value",
        "serialize_value",
    )
    assert node_name("rosout") == "rosout_v"
