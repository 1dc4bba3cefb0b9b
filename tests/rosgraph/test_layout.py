"""The layered drawing: nothing overlaps, and what has no cycle goes from left to right."""

from __future__ import annotations

from itertools import combinations

from hypothesis import given, settings
from hypothesis import strategies as st

from rebsync.rosgraph.layout import Spot, layout

_SIZES = st.lists(st.tuples(st.floats(10, 300), st.floats(10, 60)), min_size=1, max_size=12)


def _edges(count: int) -> st.SearchStrategy[list[tuple[int, int]]]:
    number = st.integers(0, count - 1)
    return st.lists(st.tuples(number, number), max_size=20)


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_boxes_do_not_overlap_and_are_inside(data: st.DataObject) -> None:
    sizes = data.draw(_SIZES)
    found = layout(sizes, data.draw(_edges(len(sizes))))
    for a, b in combinations(range(len(sizes)), 2):
        (x, y), (other_x, other_y) = _corner(found.spots[a]), _corner(found.spots[b])
        beside = x + sizes[a][0] <= other_x or other_x + sizes[b][0] <= x
        below = y + sizes[a][1] <= other_y + 0.01 or other_y + sizes[b][1] <= y + 0.01
        assert beside or below
    for spot, (width, height) in zip(found.spots, sizes, strict=True):
        assert 0 <= spot.x <= found.width - width + 0.01
        assert 0 <= spot.y <= found.height - height + 0.01


def _corner(spot: Spot) -> tuple[float, float]:
    return spot.x, spot.y


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_edges_go_to_the_right(data: st.DataObject) -> None:
    sizes = data.draw(_SIZES)
    edges = [(a, b) for a, b in data.draw(_edges(len(sizes))) if a < b]
    found = layout(sizes, edges)
    for a, b in edges:
        assert found.spots[a].x < found.spots[b].x


def test_a_cycle_is_drawn_too() -> None:
    found = layout([(10, 10)] * 3, [(0, 1), (1, 2), (2, 0), (1, 1)])
    assert [spot.x for spot in found.spots] == sorted(spot.x for spot in found.spots)
