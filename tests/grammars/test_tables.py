"""The kept parser tables: whatever lies in the cache, what is read is right."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from lark import Lark

from rebsync.grammars import tables

GRAMMAR = 'start: "a"+\n'


DAMAGE: dict[str, Callable[[bytes], bytes]] = {
    "empty": lambda old: b"",
    "half": lambda old: old[: len(old) // 2],
    "one byte": lambda old: old[:-9] + bytes([old[-9] ^ 1]) + old[-8:],
    "foreign": lambda old: b"\0" * 500,
}


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache" / "tables"


def _load() -> Lark:
    return tables.load(GRAMMAR, ["start"])


@pytest.mark.parametrize("damage", DAMAGE.values(), ids=DAMAGE)
def test_damaged_tables_do_not_matter(
    cache: Path, monkeypatch: pytest.MonkeyPatch, damage: Callable[[bytes], bytes]
) -> None:
    _load()
    (kept,) = cache.iterdir()
    kept.write_bytes(damage(kept.read_bytes()))
    assert _load().parse("aaa").data == "start"
    assert [p.name for p in cache.parent.iterdir()] == ["tables"]
    monkeypatch.setattr(tables, "_compiled", None)
    assert _load().parse("a").data == "start"  # and the next run finds good ones


def test_kept_tables_are_used(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _load()
    monkeypatch.setattr(tables, "_compiled", None)
    assert _load().parse("aa").data == "start"


def test_tables_that_others_could_have_written_are_not_used(
    cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    _load()
    (kept,) = cache.iterdir()
    kept.chmod(0o666)
    monkeypatch.setattr(tables, "_deserialised", None)
    assert _load().parse("aa").data == "start"


@pytest.mark.parametrize("name", ["REBSYNC_CACHE", "XDG_CACHE_HOME", "HOME"])
@pytest.mark.parametrize("value", ["/proc/nowhere", "/dev/null", "", "relative"])
def test_a_cache_that_cannot_be_written_does_not_matter(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, value: str
) -> None:
    monkeypatch.chdir(tmp_path)
    for each in ("REBSYNC_CACHE", "XDG_CACHE_HOME"):
        monkeypatch.delenv(each, raising=False)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    monkeypatch.setenv(name, value)
    assert _load().parse("aa").data == "start"
