"""What was read is kept between runs; what is damaged, foreign or too much is not taken."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync import model as m
from rebsync.grammars.parser import parse_model
from rebsync.roundtrip import extraction_cache
from rebsync.roundtrip.difference import Place
from rebsync.roundtrip.extraction_cache import keep, kept, key_of
from rebsync.source import NOWHERE, Source, Span

MODEL = parse_model(Source("a.rebeca", "reactiveclass A(2) { A() { } } main { A a():(); }")).model


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path))
    return tmp_path / "values"


def test_a_model_comes_back_with_its_places(folder: Path) -> None:
    keep("a", MODEL)
    found = kept("a", m.Model)
    assert found == MODEL
    assert found is not None
    assert [c.span for c in found.classes] == [c.span for c in MODEL.classes]
    assert [p.name for p in folder.iterdir()] == ["a"]
    assert kept("b", m.Model) is None
    assert kept("a", Source) is None


def test_no_place_stays_no_place(folder: Path) -> None:
    place = Place(Source("a.cpp", "a"), NOWHERE)
    keep("a", place)
    found = kept("a", Place)
    assert found is not None
    assert (str(found), found.line) == ("a.cpp", None)


def test_what_others_can_write_is_not_taken(folder: Path) -> None:
    keep("a", MODEL)
    (folder / "a").chmod(0o666)
    assert kept("a", m.Model) is None


def test_old_entries_go(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(extraction_cache, "_MOST", 10)
    for number in range(25):
        keep(f"{number}", Span(number, number))
    assert len(list(folder.iterdir())) <= 11
    assert kept("24", Span) == Span(24, 24)


def test_without_a_place_nothing_is_kept(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / "file"))
    keep("a", MODEL)
    assert kept("a", m.Model) is None


def test_keys_tell_parts_apart() -> None:
    assert key_of("a", "bc") != key_of("ab", "c")
    assert key_of("a") == key_of("a")


def test_a_verdict_of_somebody_else_is_not_taken(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Not one under another key, not one of ours under another name, not a part of one."""
    keep("a", MODEL)
    keep("b", Span(1, 2))
    ours = {path.name: path.read_bytes() for path in folder.iterdir()}
    monkeypatch.setenv("REBSYNC_CACHE_KEY", "of somebody else, who has thought about it")
    keep("a", Span(3, 4))
    assert kept("a", Span) == Span(3, 4)
    monkeypatch.delenv("REBSYNC_CACHE_KEY")
    assert kept("a", Span) is None
    for damaged in (ours["b"], *(ours["a"][:n] for n in range(0, len(ours["a"]), 7))):
        (folder / "a").write_bytes(damaged)
        assert (kept("a", Span), kept("a", m.Model)) == (None, None)
    (folder / "a").write_bytes(ours["a"])
    assert kept("a", m.Model) == MODEL
