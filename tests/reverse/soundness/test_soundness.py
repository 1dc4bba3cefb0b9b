"""Whatever a callback can do, the recovered model can do too, or the place is listed."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from rebsync import model as m
from rebsync.reverse.bodies.effects import cpp_call_effects
from rebsync.reverse.bodies.types import cpp_widths
from tests.reverse.soundness.comparing import CALLS, recovered, tallied
from tests.reverse.soundness.effects import compare
from tests.reverse.soundness.nodes import LIBRARY_FROM, WIDE_FROM, draw_node
from tests.reverse.soundness.programs import inputs, run

DRAWN = int(os.environ.get("REBSYNC_DRAWN_NODES", "24"))
BATCH = 24
FOUND = (109, 114, 274, 340)  # nodes that have shown mistakes

pytestmark = pytest.mark.skipif(shutil.which("g++") is None, reason="g++ is not installed")


@pytest.mark.parametrize("first", range(0, DRAWN, BATCH))
def test_models_can_do_what_the_code_does(first: int, tmp_path: Path) -> None:
    drawn = range(first, min(first + BATCH, DRAWN))
    tally = tallied(tmp_path, (*drawn, *FOUND) if first == 0 else drawn)
    assert tally.refused == []
    assert tally.unsound == []
    assert tally.inexact == []
    assert tally.exact + tally.approximated > tally.unreadable


@pytest.mark.parametrize("first", range(WIDE_FROM, WIDE_FROM + DRAWN // 2, BATCH // 2))
def test_models_of_wide_numbers_can_do_what_the_code_does(first: int, tmp_path: Path) -> None:
    tally = tallied(tmp_path, range(first, first + BATCH // 2))
    assert tally.refused == []
    assert tally.unsound == []
    assert tally.inexact == []
    assert tally.exact + tally.approximated > 0


def test_models_of_what_uses_macros_can_do_what_the_code_does(tmp_path: Path) -> None:
    tally = tallied(tmp_path, range(LIBRARY_FROM, LIBRARY_FROM + DRAWN // 4))
    assert tally.refused == []
    assert tally.unsound == []
    assert tally.inexact == []
    assert tally.exact > tally.unreadable


def test_macros_that_do_more_are_found_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cpp_call_effects, "_is_calm_macro", lambda *_: True)
    assert tallied(tmp_path, (LIBRARY_FROM + 120,)).unsound


def test_numbers_that_wrap_are_found_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("check", "check_truth", "check_whole"):
        monkeypatch.setattr(cpp_widths, name, lambda *_: None)
    assert tallied(tmp_path, range(WIDE_FROM, WIDE_FROM + 4)).unsound


def test_a_model_that_does_something_else_is_found_out(tmp_path: Path) -> None:
    node = draw_node(1)
    calls = inputs(node, 1, CALLS)
    (seen,) = run(tmp_path, [node], [calls])
    found = recovered(node)
    assert not compare(node, found, calls, seen).unsound
    classes = tuple(emptied(c) for c in found.model.classes)
    other = replace(found, model=replace(found.model, classes=classes))
    assert compare(node, other, calls, seen).unsound


def test_a_model_that_can_do_more_is_found_out(tmp_path: Path) -> None:
    node = draw_node(1)
    calls = inputs(node, 1, CALLS)
    (seen,) = run(tmp_path, [node], [calls])
    found = recovered(node)
    assert not compare(node, found, calls, seen).inexact
    classes = tuple(perhaps(c) for c in found.model.classes)
    more = replace(found, model=replace(found.model, classes=classes))
    assert compare(node, more, calls, seen).inexact


def changed(
    declaration: m.ReactiveClass | m.Interface, change: Callable[[m.Block], m.Block]
) -> m.ReactiveClass | m.Interface:
    """The class with other bodies of its servers."""
    if isinstance(declaration, m.Interface):
        return declaration
    members = tuple(
        replace(c, body=change(c.body)) if isinstance(c, m.MessageServer) and c.body else c
        for c in declaration.members
    )
    return replace(declaration, members=members)


def emptied(declaration: m.ReactiveClass | m.Interface) -> m.ReactiveClass | m.Interface:
    """The class with servers that do nothing."""
    return changed(declaration, lambda body: m.Block(()))


def perhaps(declaration: m.ReactiveClass | m.Interface) -> m.ReactiveClass | m.Interface:
    """The class with servers that may do nothing."""
    may = m.Choice((m.BoolLiteral(True), m.BoolLiteral(False)))
    return changed(declaration, lambda body: m.Block((m.If(may, body, None),)))
