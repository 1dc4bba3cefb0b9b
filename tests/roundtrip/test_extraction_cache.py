"""What was read is kept between runs; what is damaged, foreign or too much is not taken."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync import model as m
from rebsync.grammars.parser import parse_model
from rebsync.roundtrip.diff.difference import Place
from rebsync.roundtrip.package.cache import store as extraction_cache
from rebsync.roundtrip.package.cache.store import key_of, load, save
from rebsync.source import NOWHERE, Source, Span

MODEL = parse_model(Source("a.rebeca", "reactiveclass A(2) { A() { } } main { A a():(); }")).model


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path))
    return tmp_path / "values"


def test_a_model_comes_back_with_its_places(folder: Path) -> None:
    save("a", MODEL)
    found = load("a", m.Model)
    assert found == MODEL
    assert found is not None
    assert [c.span for c in found.classes] == [c.span for c in MODEL.classes]
    assert [p.name for p in folder.iterdir()] == ["a"]
    assert load("b", m.Model) is None
    assert load("a", Source) is None


def test_no_place_stays_no_place(folder: Path) -> None:
    place = Place(Source("a.cpp", "a"), NOWHERE)
    save("a", place)
    found = load("a", Place)
    assert found is not None
    assert (str(found), found.line) == ("a.cpp", None)


def test_what_others_can_write_is_not_taken(folder: Path) -> None:
    save("a", MODEL)
    (folder / "a").chmod(0o666)
    assert load("a", m.Model) is None


def test_old_entries_go(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(extraction_cache, "_MOST", 10)
    for number in range(25):
        save(f"{number}", Span(number, number))
    assert len(list(folder.iterdir())) <= 11
    assert load("24", Span) == Span(24, 24)


def test_without_a_place_nothing_is_kept(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / "file"))
    save("a", MODEL)
    assert load("a", m.Model) is None


def test_keys_tell_parts_apart() -> None:
    assert key_of("a", "bc") != key_of("ab", "c")
    assert key_of("a") == key_of("a")


def test_a_verdict_of_somebody_else_is_not_taken(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Not one under another key, not one of ours under another name, not a part of one."""
    save("a", MODEL)
    save("b", Span(1, 2))
    ours = {path.name: path.read_bytes() for path in folder.iterdir()}
    monkeypatch.setenv("REBSYNC_CACHE_KEY", "of somebody else, who has thought about it")
    save("a", Span(3, 4))
    assert load("a", Span) == Span(3, 4)
    monkeypatch.delenv("REBSYNC_CACHE_KEY")
    assert load("a", Span) is None
    for damaged in (ours["b"], *(ours["a"][:n] for n in range(0, len(ours["a"]), 7))):
        (folder / "a").write_bytes(damaged)
        assert (load("a", Span), load("a", m.Model)) == (None, None)
    (folder / "a").write_bytes(ours["a"])
    assert load("a", m.Model) == MODEL
