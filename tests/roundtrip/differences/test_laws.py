"""Drawn models: what is equal has no differences, what is changed has one, at the right place."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from hypothesis import given, settings
from hypothesis import strategies as st

from rebsync import model as m
from rebsync.roundtrip.diff.compare import compare, compare_in_full
from rebsync.roundtrip.diff.difference import Changed, Comparison, Depth, Renamed
from rebsync.roundtrip.diff.normal_form import rewrite
from rebsync.roundtrip.diff.operands import SourcedModel
from rebsync.source import Source
from tests.roundtrip.differences.lines import line_of
from tests.roundtrip.differences.mutations import (
    DIFFERENT,
    EQUAL,
    Mutated,
    equal_form,
    server_renamed,
    statement_inserted,
    statement_removed,
    variable_renamed,
)
from tests.strategies import models

FEW = settings(max_examples=settings().max_examples // 3)  # each is compared several times

Mutation: TypeAlias = "Callable[[st.DrawFn, m.Model], Mutated]"

SOURCE = Source("drawn.rebeca", "")
STATEMENTS = (statement_inserted, statement_removed)
RENAMES = (server_renamed, variable_renamed)


def compared(left: m.Model, right: m.Model, depth: Depth = Depth.EQUAL) -> Comparison:
    """The differences that are looked for in full; the quick answer must be none of its own."""
    sides = SourcedModel(left, SOURCE), SourcedModel(right, SOURCE)
    found = compare_in_full(*sides, depth)
    assert compare(*sides, depth) == found
    return found


def told(comparison: Comparison) -> list[str]:
    return [line_of(d) for d in comparison.differences]


@FEW
@given(models())
def test_a_model_is_like_itself(model: m.Model) -> None:
    copy = rewrite(model, lambda node: node)
    for depth in Depth:
        assert told(compared(model, copy, depth)) == []


@FEW
@given(st.data(), models())
def test_what_is_equal(data: st.DataObject, model: m.Model) -> None:
    changed = mutated(data, data.draw(st.sampled_from(EQUAL)), model)
    assert told(compared(model, changed.model)) == []
    assert told(compared(changed.model, model)) == []
    identical = compared(model, changed.model, Depth.IDENTICAL)
    assert identical.is_empty == (model == changed.model)


@FEW
@given(st.data(), models())
def test_what_is_different(data: st.DataObject, model: m.Model) -> None:
    mutation = data.draw(st.sampled_from(DIFFERENT))
    changed = mutated(data, mutation, model)
    for depth in Depth:
        found = compared(model, changed.model, depth).differences
        assert [str(d.element) for d in found] == [changed.element], list(map(line_of, found))
        if mutation in RENAMES:
            assert isinstance(found[0], Renamed)
        elif mutation not in STATEMENTS:
            assert isinstance(found[0], Changed)


@FEW
@given(st.data(), models())
def test_nothing_is_told_where_and_only_where_models_are_equal(
    data: st.DataObject, model: m.Model
) -> None:
    other = model
    for _ in range(data.draw(st.integers(0, 4))):
        other = mutated(data, data.draw(st.sampled_from((*EQUAL, *DIFFERENT))), other).model
    found = compared(model, other)
    assert found.is_empty == (equal_form(model) == equal_form(other)), told(found)
    assert compared(model, other, Depth.IDENTICAL).is_empty == (model == other)


@FEW
@given(models(), models())
def test_two_models_can_always_be_compared(left: m.Model, right: m.Model) -> None:
    for depth in Depth:
        for difference in compared(left, right, depth).differences:
            assert "\n" not in line_of(difference)


def mutated(data: st.DataObject, mutation: Mutation, model: m.Model) -> Mutated:
    return data.draw(st.composite(lambda draw: mutation(draw, model))())
