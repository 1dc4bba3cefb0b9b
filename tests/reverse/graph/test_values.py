"""How values are combined: names under handles, several ways, and arithmetic as C++ does it."""

from __future__ import annotations

import pytest

from rebsync.reverse.graph import FromParameter, OneOf, Place, Plain, Resolved, Under, Unresolved
from rebsync.reverse.values.cpp_values_names import name_under, one_of, tidy
from rebsync.reverse.values.cpp_values_numbers import added, computed, converted
from rebsync.source import Source, Span

HERE = Place(Source("a.cpp", "x"), Span(0, 1))


@pytest.mark.parametrize(
    ("namespace", "name", "full"),
    [
        ("", "x", "x"),
        ("~", "x", "~x"),
        ("~", "/x", "/x"),
        ("~a", "x", "~a/x"),
        ("a", "~x", "~x"),
        ("/", "x", "/x"),
        ("/a", "b/", "/a/b"),
        (Under("a"), "x", Under("a/x")),
        (Under(""), "/x", "/x"),
        (OneOf(("", "~")), "x", OneOf(("x", "~x"))),
        ("~", OneOf(("x", "/y")), OneOf(("~x", "/y"))),
        ("~", FromParameter("~p", "x"), FromParameter("~p", "~x", within=("~",))),
        ("", FromParameter("~p", "x"), FromParameter("~p", "x")),
        ("~", Unresolved("why", HERE, "*/x"), Unresolved("why", HERE, "~*/x")),
        ("", Unresolved("why", HERE), Unresolved("why", HERE)),
        (Unresolved("why", HERE), "x", Unresolved("why", HERE, "*/x")),
    ],
)
def test_a_handle_resolves_names(namespace: Resolved, name: Resolved, full: Resolved) -> None:
    assert name_under(namespace, name) == full


@pytest.mark.parametrize(
    ("values", "together"),
    [
        (["a", "a"], "a"),
        (["a", OneOf(("b", "a"))], OneOf(("a", "b"))),
        ([1, True], OneOf((1, True))),
        (["~out", Unresolved("why", HERE, "~*")], Unresolved("why", HERE, "~*")),
        (
            ["a/x", Unresolved("why", HERE, "*/x"), "b/x"],
            Unresolved("why", HERE, "*/x"),
        ),
        ([1, Unresolved("why", HERE)], Unresolved("why", HERE)),
        (
            [FromParameter("p"), FromParameter("p", within=("~",))],
            FromParameter("p", within=("", "~")),
        ),
        ([Under("x"), "~x"], "~x"),
    ],
)
def test_several_values_together(values: list[Resolved], together: Resolved) -> None:
    found = one_of(values)
    assert found == together
    assert type(found) is type(together)


def test_no_values_are_none() -> None:
    assert one_of([]) is None


@pytest.mark.parametrize(
    ("name", "short"), [("~/x", "~x"), ("a//b", "a/b"), ("/", "/"), ("**", "*")]
)
def test_names_are_tidied(name: str, short: str) -> None:
    assert tidy(name) == short


@pytest.mark.parametrize(
    ("left", "operator", "right", "result"),
    [
        (7, "/", 2, 3),
        (-7, "/", 2, -3),
        (-7, "%", 2, -1),
        (7.0, "/", 2, 3.5),
        (1, "/", 0, None),
        (1, "<<", 3, 8),
        ("a", "==", "a", True),
        ("a", "!=", "a", False),
        ("a", "-", "b", None),
        (1, "<", 2, True),
    ],
)
def test_operations_are_those_of_cpp(
    left: Plain, operator: str, right: Plain, result: Plain | None
) -> None:
    found = computed(operator, left, right)
    assert found == result
    assert type(found) is type(result)


@pytest.mark.parametrize(
    ("value", "type_", "result"),
    [
        (2.9, "int", 2),
        (3, "double", 3.0),
        (0, "bool", False),
        ("false", "bool", True),
        (True, "int", 1),
        ("x", "std::string", "x"),
        (FromParameter("p", 3), "double", FromParameter("p", 3.0)),
    ],
)
def test_variables_convert_what_they_are_given(
    value: Resolved, type_: str, result: Resolved
) -> None:
    found = converted(value, type_)
    assert found == result
    assert type(found) is type(result)


def test_texts_behind_a_parameter_are_one_text() -> None:
    once = added(FromParameter("p", "a"), "/b")
    assert added(once, "/c") == FromParameter("p", "a/b/c", 'value + "/b/c"')
