"""The cache: only this user's folders, only what is under the user's seal."""

from __future__ import annotations

import os
import stat
import subprocess
from pathlib import Path

import platformdirs
import pytest

from rebsync import cache
from rebsync.cache import open_cache, refused
from tests.cli.run import rebsync

MODEL = "reactiveclass A(2) { A() { } } main { A a():(); }"


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A user whose cache and key lie where they lie by default, and nothing told before."""
    for name in ("REBSYNC_CACHE", "XDG_CACHE_HOME", "XDG_STATE_HOME", cache.KEY_VARIABLE):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setattr(cache, "_refused", {})
    monkeypatch.setattr(cache, "_opened", cache._opened.__wrapped__)  # as in a new process
    return tmp_path


def why() -> str:
    found = refused()
    return found.diagnostics[0].message if found is not None else ""


def test_what_is_stored_is_loaded_and_is_this_users_alone(home: Path) -> None:
    old = os.umask(0)
    try:
        kept = open_cache("values")
        assert kept is not None
        kept.store("a", b"content")
    finally:
        os.umask(old)
    assert kept.load("a") == b"content"
    made = [p for p in home.rglob("*") if p != home]
    modes = {stat.S_IMODE(p.stat().st_mode) for p in made if p.is_dir()}
    assert modes == {0o700}
    assert {stat.S_IMODE(p.stat().st_mode) for p in made if p.is_file()} == {0o600}
    assert sorted(p.name for p in made if p.is_file()) == ["a", "cache.key"]


@pytest.mark.parametrize("chosen", [None, "", "relative/folder"])
def test_it_lies_where_the_system_has_such_files(
    chosen: str | None, home: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("cache", "state"):
        if chosen is not None:
            monkeypatch.setenv(f"XDG_{name.upper()}_HOME", chosen)
        place = home / "Library" / name  # as on macOS
        monkeypatch.setattr(
            platformdirs, f"user_{name}_path", lambda app, appauthor, at=place: at / app
        )
    kept = open_cache("values")
    assert kept is not None
    assert kept.folder == home / "Library/cache/rebsync/values"
    assert (home / "Library/state/rebsync/cache.key").is_file()


def test_a_user_without_folders_has_no_cache(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(platformdirs, "user_cache_path", lambda app, appauthor: Path("~") / app)
    assert open_cache("values") is None


@pytest.mark.parametrize("chosen", ["REBSYNC_CACHE", "XDG_CACHE_HOME", "XDG_STATE_HOME"])
def test_no_cache_in_a_work_tree(
    chosen: str, home: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    subprocess.run(["git", "init", "-q", tmp_path / "repository"], check=True)
    folder = tmp_path / "repository" / "deep" / "cache"
    monkeypatch.setenv(chosen, str(folder))
    assert open_cache("values") is None
    assert "work tree of the git repository" in why()
    assert not folder.exists()


def test_no_cache_through_a_link_of_a_work_tree(
    home: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "repository" / ".git").mkdir(parents=True)
    (tmp_path / "elsewhere").mkdir(mode=0o700)
    (tmp_path / "repository" / "cache").symlink_to(tmp_path / "elsewhere")
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / "repository" / "cache"))
    assert open_cache("values") is None
    assert not list((tmp_path / "elsewhere").iterdir())


def test_no_cache_through_a_link_into_a_work_tree(
    home: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "repository").mkdir()
    (tmp_path / "repository" / ".git").write_text("gitdir: elsewhere\n")  # as of a submodule
    (tmp_path / "link").symlink_to(tmp_path / "repository")
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / "link" / "cache"))
    assert open_cache("values") is None


@pytest.mark.parametrize("mode", [0o777, 0o770, 0o707])
@pytest.mark.parametrize("writable", ["shared", "shared/cache", "shared/cache/values"])
def test_no_cache_where_others_may_write(
    writable: str, mode: int, home: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "shared/cache/values").mkdir(parents=True, mode=0o700)
    (tmp_path / writable).chmod(mode)
    monkeypatch.setattr("rebsync.cache_folder._is_of_one_user", lambda _: False)
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / "shared/cache"))
    assert open_cache("values") is None
    assert "others may" in why()


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can give files away")
@pytest.mark.parametrize("given", ["of-other", "of-other/cache/values"])
def test_no_cache_of_another_user(
    given: str, home: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "of-other/cache/values").mkdir(parents=True, mode=0o700)
    os.chown(tmp_path / given, 12345, 12345)
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / "of-other/cache"))
    assert open_cache("values") is None
    assert why()


def test_an_entry_without_our_seal_is_not_loaded(
    home: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A whole cache of somebody else, as a job of CI may restore it; and one entry as another."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "another"))
    theirs = open_cache("values")
    monkeypatch.delenv("XDG_STATE_HOME")
    ours = open_cache("values")
    assert theirs is not None
    assert ours is not None
    assert theirs.folder == ours.folder
    theirs.store("a", b"evil")
    assert theirs.load("a") == b"evil"
    assert ours.load("a") is None
    ours.store("b", b"good")
    (ours.folder / "b").rename(ours.folder / "c")
    assert ours.load("c") is None
    part = open_cache("templates")
    assert part is not None
    (ours.folder / "c").rename(part.folder / "b")
    assert part.load("b") is None


def test_no_link_and_no_pipe_is_an_entry(home: Path, tmp_path: Path) -> None:
    kept = open_cache("values")
    assert kept is not None
    kept.store("a", b"content")
    (kept.folder / "link").symlink_to(kept.folder / "a")
    os.mkfifo(kept.folder / "pipe", 0o600)
    assert kept.load("link") is None
    assert kept.load("pipe") is None


def test_a_key_that_others_can_read_is_made_anew(home: Path) -> None:
    kept = open_cache("values")
    assert kept is not None
    kept.store("a", b"content")
    (path,) = home.rglob("cache.key")
    path.chmod(0o644)
    again = open_cache("values")
    assert again is not None
    assert again.key != kept.key
    assert again.load("a") is None
    assert stat.S_IMODE(path.stat().st_mode) == 0o600


def test_jobs_with_the_same_key_share_entries(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(cache.KEY_VARIABLE, "k" * 32)
    first = open_cache("values")
    assert first is not None
    first.store("a", b"content")
    monkeypatch.setenv("XDG_STATE_HOME", str(home / "another"))
    second = open_cache("values")
    assert second is not None
    assert second.load("a") == b"content"
    monkeypatch.setenv(cache.KEY_VARIABLE, "short")
    assert open_cache("values") is None
    assert "fewer than 32" in why()


def test_there_are_never_too_many_entries(home: Path) -> None:
    kept = open_cache("values")
    assert kept is not None
    for number in range(25):
        kept.store(f"{number}", b"")
        kept.tidy(10)
    assert len(list(kept.folder.iterdir())) <= 10
    assert kept.load("24") == b""


def test_a_command_says_that_the_cache_is_not_used(tmp_path: Path) -> None:
    subprocess.run(["git", "init", "-q", tmp_path], check=True)
    (tmp_path / "a.rebeca").write_text(MODEL)
    env = {"REBSYNC_CACHE": "cache"}
    outcome = rebsync("generate", "a.rebeca", "-o", "out", cwd=tmp_path, env=env)
    assert outcome.status == 0
    assert "RS820" in outcome.err
    assert outcome.err.count("RS820") == 1
    assert not (tmp_path / "cache").exists()
