"""Compiled templates are kept where only the user can write, and damage to them does not matter."""

from __future__ import annotations

import marshal
from pathlib import Path

import pytest

from rebsync.cache import open_cache
from rebsync.forward.templating import environment, fill


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path))
    environment.cache_clear()
    return tmp_path


def first_line() -> str:
    environment.cache_clear()
    return fill("ros1_cpp/clang-format.j2").partition("\n")[0]


def test_damaged_templates_are_compiled_anew(cache: Path) -> None:
    assert first_line() == "BasedOnStyle: Google"
    kept = list(cache.glob("templates/*"))
    assert kept
    for damage in (b"", b"junk", kept[0].read_bytes()[:-20]):
        kept[0].write_bytes(damage)
        assert first_line() == "BasedOnStyle: Google"


def test_a_folder_that_others_can_write_to_is_not_used(cache: Path) -> None:
    cache.chmod(0o777)
    assert first_line() == "BasedOnStyle: Google"
    assert not list(cache.glob("templates/*"))


def test_code_of_somebody_else_is_not_run(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """An attacker has the names and all else, but for the key."""
    assert first_line() == "BasedOnStyle: Google"
    evil = marshal.dumps(compile("raise SystemExit('run')", "evil", "exec"))
    monkeypatch.setenv("REBSYNC_CACHE_KEY", "of somebody else, who has thought about it")
    theirs = open_cache("templates")
    assert theirs is not None
    for path in cache.glob("templates/*"):
        theirs.store(path.name, evil)
    with pytest.raises(SystemExit):
        first_line()  # it is code that would run
    monkeypatch.delenv("REBSYNC_CACHE_KEY")
    assert first_line() == "BasedOnStyle: Google"
