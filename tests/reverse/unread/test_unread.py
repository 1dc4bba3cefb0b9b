"""Calls that may run what was not read are listed in each place; harmless twins in none."""

from __future__ import annotations

from collections.abc import Iterable

import pytest

from rebsync.reverse.analysis.problems import NOTHING_THERE
from rebsync.reverse.findings import Finding
from tests.reverse.unread import (
    CALLS,
    LIBRARIES,
    PROGRAMS,
    all_places,
    node,
    places,
    program,
    rows,
    unreadable,
)

_HARMFUL = {name: row for name, row in rows(CALLS).items() if "why" in row}
_HARMLESS = {name: row for name, row in rows(CALLS).items() if "why" not in row}


def _of_code(found: Iterable[Finding]) -> list[str]:
    """What is said of code; whether a pointer is null is another question."""
    return sorted(f.why for f in found if f.why != NOTHING_THERE)


@pytest.mark.parametrize("library", LIBRARIES)
@pytest.mark.parametrize("name", _HARMFUL)
def test_what_may_do_anything_is_listed_in_each_place(name: str, library: str) -> None:
    row = _HARMFUL[name]
    found = places(node(library, row, row["call"]))
    assert row["why"] in found["timer"]
    assert found.keys() >= set(all_places(library))


@pytest.mark.parametrize("library", LIBRARIES)
@pytest.mark.parametrize("name", _HARMLESS)
def test_what_is_known_is_not_listed(name: str, library: str) -> None:
    row = _HARMLESS[name]
    with_it, without = (unreadable(node(library, row, call)) for call in (row["call"], ""))
    assert _of_code(with_it) == _of_code(without)


@pytest.mark.parametrize("name", rows(PROGRAMS))
def test_what_reaches_a_node_is_listed(name: str) -> None:
    row = rows(PROGRAMS)[name]
    found = [finding.why for finding in unreadable(program(row))]
    assert row["why"] in found if "why" in row else not found
