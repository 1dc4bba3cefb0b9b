"""Libraries made from C: the cache whatever lies in it, and compilers that are not there."""

from __future__ import annotations

import shutil
import stat
import subprocess
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest

from rebsync.cache import open_cache
from rebsync.checker import build
from rebsync.checker.build import Unit, libraries
from rebsync.checker.exploration import Unavailable

_REAL = next(filter(None, map(shutil.which, ("cc", "gcc", "clang"))), None)
pytestmark = pytest.mark.skipif(_REAL is None, reason="no C compiler")


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty cache of its own."""
    monkeypatch.setenv("REBSYNC_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache" / "libraries"


def _works(value: str = "5") -> None:
    """Two libraries are built or found, and answer."""
    texts = f"int answer(void) {{ return {value}; }}", f"int answer(void) {{ return -{value}; }}"
    units = tuple(
        Unit(f"part{i}", partial(str, text), (text,), "-O0") for i, text in enumerate(texts)
    )
    assert [library.answer() for library in libraries(units)] == [int(value), -int(value)]


def _libraries(cache: Path) -> list[Path]:
    return sorted(cache.glob("*.so"))


# --- the cache -----------------------------------------------------------------------------------


def test_what_was_compiled_is_kept_by_content(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _works()
    kept = _libraries(cache)
    assert len(kept) == 2
    assert sorted(cache.iterdir()) == kept
    assert all(stat.S_IMODE(path.stat().st_mode) == 0o700 for path in kept)
    monkeypatch.setattr(subprocess, "Popen", None)  # compiles nothing any more
    _works()
    with pytest.raises(TypeError):
        _works("7")
    assert _libraries(cache) == kept


DAMAGE: dict[str, Callable[[bytes], bytes]] = {
    "empty": lambda old: b"",
    "half": lambda old: old[: len(old) // 2],
    "one byte": lambda old: old[:-9] + bytes([old[-9] ^ 1]) + old[-8:],
    "foreign": lambda old: b"\0" * 500,
}


@pytest.mark.parametrize("damage", DAMAGE)
def test_a_damaged_library_is_made_again(damage: str, cache: Path) -> None:
    _works()
    kept = {path: path.read_bytes() for path in _libraries(cache)}
    for path, content in kept.items():
        path.unlink()  # this process has it loaded
        path.write_bytes(DAMAGE[damage](content))
    _works()
    assert {path: path.read_bytes() for path in _libraries(cache)} == kept


def test_a_library_that_does_not_load_is_made_again(cache: Path) -> None:
    _works()
    content = b"no library"
    sealed = open_cache("libraries")
    assert sealed is not None
    for path in _libraries(cache):
        path.unlink()
        sealed.put(build._name(sealed, path.name[:32], content), content)
    _works()
    assert len(_libraries(cache)) == 2


def test_a_library_that_others_can_write_is_not_loaded(cache: Path) -> None:
    _works()
    for path in _libraries(cache):
        path.chmod(0o777)
    _works()
    assert all(stat.S_IMODE(path.stat().st_mode) == 0o700 for path in _libraries(cache))


def test_in_a_folder_that_others_can_write_nothing_is_kept(cache: Path) -> None:
    cache.mkdir(parents=True)
    cache.chmod(0o777)
    _works()
    assert not _libraries(cache)


def test_without_a_cache_it_works(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "file"
    file.write_text("")
    monkeypatch.setenv("REBSYNC_CACHE", str(file / "inside"))
    _works()


def test_where_nothing_may_be_run_it_works(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A file system that is mounted so: what lies there is not loaded."""
    load = build._load

    def refused(path: Path) -> object:
        if path.parent == cache:
            raise Unavailable("failed to map segment from shared object")
        return load(path)

    monkeypatch.setattr(build, "_load", refused)
    _works()
    _works()


def test_a_full_disk_does_not_matter(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", full)
    _works()
    assert not list(cache.iterdir())


def test_nowhere_to_compile(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tempfile.tempdir", "/dev/null")
    with pytest.raises(Unavailable, match="cannot be compiled: Not a directory"):
        _works()


def test_old_libraries_are_removed(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(build, "_KEPT", 3)
    for value in ("5", "6", "7"):
        _works(value)
    assert 0 < len(_libraries(cache)) <= 3


_RUN = """\
from tests.checker.test_build import _works
_works("9")
"""


def test_two_at_once_build_the_same(cache: Path) -> None:
    root = Path(__file__).parents[2]
    runs = [subprocess.Popen([sys.executable, "-c", _RUN], cwd=root) for _ in range(2)]
    assert [run.wait(timeout=60) for run in runs] == [0, 0]
    assert len(_libraries(cache)) == 2
    assert sorted(cache.glob("*.tmp")) == []
    _works("9")


def test_nothing_is_left_over(cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    scratch = tmp_path / "scratch"
    scratch.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(scratch))
    _works()
    assert list(scratch.iterdir()) == []


# --- compilers -----------------------------------------------------------------------------------


def _compiler(folder: Path, script: str) -> str:
    path = folder / "compiler"
    path.write_text(f"#!/bin/sh\n{script}\n")
    path.chmod(0o755)
    return str(path)


def test_no_compiler(cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(Unavailable, match="no C compiler"):
        _works()


@pytest.mark.parametrize(
    ("script", "message"),
    [
        ("echo 'model.c:1: it is broken'; exit 1", "fails: model.c:1: it is broken"),
        ("exit 3", "fails: it says nothing"),
        ('for last; do :; done; while [ "$1" != -o ]; do shift; done; echo no > "$2"', "be loaded"),
        ("exit 0", "made nothing"),
    ],
)
def test_a_compiler_that_fails(
    script: str, message: str, cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("CC", _compiler(tmp_path, script))
    with pytest.raises(Unavailable, match=message) as raised:
        _works()
    assert "\n" not in str(raised.value)


def test_a_compiler_that_is_not_wanted_any_more_is_ended(
    cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    late = tmp_path / "late"
    monkeypatch.setenv("CC", _compiler(tmp_path, f"sh -c 'sleep 0.7; touch {late}'; exit 1"))
    unit = Unit("part", lambda: "", (), "-O0")
    with pytest.raises(Unavailable, match="not wanted any more"):
        libraries((unit,), wanted=lambda: False)
    time.sleep(0.8)
    assert not late.exists()


def test_a_compiler_that_takes_too_long(
    cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("CC", _compiler(tmp_path, "sleep 100"))
    monkeypatch.setattr(build, "_PATIENCE", 0.2)
    with pytest.raises(Unavailable, match="takes too long"):
        _works()


@pytest.mark.parametrize(
    ("chosen", "message"),
    [("not-there -O3", "the C compiler not-there is not there"), ("'", "CC is no command")],
)
def test_a_compiler_that_is_not_there(
    chosen: str, message: str, cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("CC", chosen)
    with pytest.raises(Unavailable, match=message):
        _works()


def test_a_chosen_compiler_with_arguments(
    cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    script = f'touch {tmp_path}/ran; exec {_REAL} "$@"'
    monkeypatch.setenv("CC", f"{_compiler(tmp_path, script)} -g")
    _works()
    assert (tmp_path / "ran").exists()
