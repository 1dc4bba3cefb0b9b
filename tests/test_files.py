"""Reading texts, and replacing files so that what was there survives every failure."""

from __future__ import annotations

import errno
import os
import signal
import stat
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest

from rebsync.diagnostics import RebsyncError
from rebsync.files import names_below, read_source
from rebsync.writing import replace_text, replace_tree
from tests.cli.run import environment, rebsync


def snapshot(folder: Path) -> dict[str, bytes]:
    """Every file below a folder, temporary ones included."""
    return {
        p.relative_to(folder).as_posix(): p.read_bytes() for p in folder.rglob("*") if p.is_file()
    }


def mistake(error: RebsyncError) -> tuple[str, str]:
    """The code of the one finding of an error, and where it is."""
    (findings,) = error.findings
    (diagnostic,) = findings.diagnostics
    place = findings.source.position(diagnostic.span.start)
    return diagnostic.code, f"{place.line}:{place.column}"


# --- reading -----------------------------------------------------------------------------------


def test_the_byte_order_mark_is_no_text_and_line_ends_stay(tmp_path: Path) -> None:
    path = tmp_path / "a.rebeca"
    path.write_bytes(b"\xef\xbb\xbfenv\r\n\xc3\xa4")
    assert read_source(str(path)).text == "env\r\nä"


@pytest.mark.parametrize(
    ("data", "place"),
    [(b"\xff", "1:1"), ("ä\nöü".encode() + b"\xe4x", "2:3"), (b"a\n\xc3", "2:1")],
)
def test_the_first_byte_that_is_not_utf8_is_shown(tmp_path: Path, data: bytes, place: str) -> None:
    path = tmp_path / "a.rebeca"
    path.write_bytes(data)
    with pytest.raises(RebsyncError) as caught:
        read_source(str(path))
    assert mistake(caught.value) == ("RS804", place)


def test_utf16_is_recognised(tmp_path: Path) -> None:
    path = tmp_path / "a.rebeca"
    path.write_text("env", encoding="utf-16")
    with pytest.raises(RebsyncError) as caught:
        read_source(str(path))
    assert "UTF-16" in str(caught.value.findings[0].diagnostics[0].hint)


@pytest.mark.parametrize(
    ("path", "code"),
    [("missing", "RS801"), (".", "RS802"), ("file/below", "RS802"), ("a\0b", "RS806")],
)
def test_what_cannot_be_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, path: str, code: str
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("file").touch()
    with pytest.raises(RebsyncError) as caught:
        read_source(path)
    assert mistake(caught.value)[0] == code


# --- one file ----------------------------------------------------------------------------------


def test_a_file_is_written_only_if_it_changes(tmp_path: Path) -> None:
    path = tmp_path / "a"
    assert replace_text(str(path), "x\n")
    before = path.stat()
    assert not replace_text(str(path), "x\n")
    assert path.stat() == before
    assert snapshot(tmp_path) == {"a": b"x\n"}


def test_mode_and_byte_order_mark_are_kept(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"\xef\xbb\xbfold")
    path.chmod(0o640)
    assert replace_text(str(path), "new")
    assert path.read_bytes() == b"\xef\xbb\xbfnew"
    assert stat.S_IMODE(path.stat().st_mode) == 0o640
    assert not replace_text(str(path), "new")


def test_a_link_is_followed_to_the_real_file(tmp_path: Path) -> None:
    real, link = tmp_path / "deep" / "real", tmp_path / "link"
    real.parent.mkdir()
    real.write_text("old")
    link.symlink_to("deep/real")
    replace_text(str(link), "new")
    assert link.is_symlink()
    assert real.read_text() == "new"


def test_a_device_is_written_to_and_not_replaced() -> None:
    assert replace_text(os.devnull, "text")
    assert not Path(os.devnull).is_file()


@pytest.mark.parametrize("path", ["folder", "missing/a"])
def test_what_cannot_be_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, path: str) -> None:
    monkeypatch.chdir(tmp_path)
    Path("folder").mkdir()
    with pytest.raises(RebsyncError) as caught:
        replace_text(path, "text")
    assert mistake(caught.value)[0] in ("RS801", "RS802")
    assert snapshot(tmp_path) == {}


def full_disk(*_: object) -> None:
    """Fails as a write does when the disk is full."""
    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def test_a_full_disk_leaves_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "a"
    path.write_text("old")
    monkeypatch.setattr(os, "fsync", full_disk)
    with pytest.raises(RebsyncError) as caught:
        replace_text(str(path), "new")
    assert mistake(caught.value)[0] == "RS805"
    assert snapshot(tmp_path) == {"a": b"old"}


# --- trees -------------------------------------------------------------------------------------


def test_a_tree_is_written_and_later_only_what_changed(tmp_path: Path) -> None:
    root = tmp_path / "out" / "package"
    texts = {"a.txt": "a", "src/b.py": "b", "old": "gone"}
    assert replace_tree(str(root), texts) == ("a.txt", "src/b.py", "old")
    del texts["old"]
    texts["new/c"] = "c"
    assert replace_tree(str(root), texts, remove=["old", "never"]) == ("new/c", "old")
    assert replace_tree(str(root), texts) == ()
    assert snapshot(tmp_path / "out") == {
        "package/a.txt": b"a",
        "package/src/b.py": b"b",
        "package/new/c": b"c",
    }


def test_what_python_compiled_is_no_file_of_a_package(tmp_path: Path) -> None:
    names = ("a.py", "src/b.py", "__pycache__/a.cpython-311.pyc", "src/__pycache__/b.pyc")
    replace_tree(str(tmp_path), {f"kept/{name}": "" for name in names})
    assert sorted(names_below(str(tmp_path), "kept")) == ["a.py", "src/b.py"]


def test_programs_can_be_run_but_for_their_records(tmp_path: Path) -> None:
    texts = {"scripts/a": "#!/bin/sh\n", ".rebsync/base/scripts/a": "#!/bin/sh\n", "b.py": "b"}
    replace_tree(str(tmp_path / "new"), texts)
    (tmp_path / "there").mkdir()
    replace_tree(str(tmp_path / "there"), texts)
    for root in (tmp_path / "new", tmp_path / "there"):
        assert [name for name in texts if os.access(root / name, os.X_OK)] == ["scripts/a"]
        (root / "scripts/a").chmod(0o640)
        replace_tree(str(root), {**texts, "scripts/a": "#!/bin/bash\n"})
        assert stat.S_IMODE((root / "scripts/a").stat().st_mode) == 0o640


@pytest.mark.parametrize("there", [True, False], ids=["existing", "new"])
@pytest.mark.parametrize("kind", [OSError(errno.ENOSPC, "full"), KeyboardInterrupt()], ids=repr)
@pytest.mark.parametrize("after", range(12))
def test_a_failure_at_any_step_leaves_all_or_nothing(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    there: bool,
    kind: BaseException,
    after: int,
) -> None:
    root = tmp_path / "package"
    if there:
        replace_tree(str(root), {"a": "old", "b": "old", "gone": "old"})
    before = snapshot(tmp_path)
    new = {"a": "new", "b": "new", "sub/c": "new"}
    steps = iter(range(100))

    def failing(real: Callable[..., object]) -> Callable[..., object]:
        def step(*arguments: object, **named: object) -> object:
            if next(steps) == after:
                raise kind
            return real(*arguments, **named)

        return step

    for name in ("replace", "rename", "unlink"):
        monkeypatch.setattr(Path, name, failing(getattr(Path, name)))
    for name in ("fsync", "open"):
        monkeypatch.setattr(os, name, failing(getattr(os, name)))
    with suppress(RebsyncError, KeyboardInterrupt):
        replace_tree(str(root), new, remove=["gone"])
        before = {}
    monkeypatch.undo()
    left = {n: d for n, d in snapshot(tmp_path).items() if not n.endswith(".tmp")}
    assert left in (before, {f"package/{n}": d.encode() for n, d in new.items()})


_WRITER = """
import sys, time
from pathlib import Path
from rebsync.cli import main
import rebsync.writing as writing
moment, pause, real = int(sys.argv[1]), float(sys.argv[2]), writing._put
def put(each, count=iter(range(100))):
    if next(count) == moment:
        print("ready", flush=True)
        time.sleep(pause)
    real(each)
writing._put = put
sys.argv[1:] = ["generate", "m.rebeca"]
sys.exit(main())
"""


def _model(rate: int) -> str:
    send = f"self.go() after({rate});"
    return f"reactiveclass R(2) {{ R() {{ {send} }} msgsrv go() {{ }} }} main {{ R r():(); }}"


@pytest.mark.parametrize("moment", [0, 1, 3])
@pytest.mark.parametrize(
    "number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL], ids=lambda n: n.name
)
def test_a_signal_leaves_the_old_package_or_the_new_one(
    tmp_path: Path, number: signal.Signals, moment: int
) -> None:
    (tmp_path / "m.rebeca").write_text(_model(1))
    assert rebsync("generate", "m.rebeca", cwd=tmp_path).status == 0
    old = snapshot(tmp_path / "m")
    (tmp_path / "m.rebeca").write_text(_model(2))
    process = subprocess.Popen(
        [sys.executable, "-c", _WRITER, str(moment), "0.3"],
        cwd=tmp_path,
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    assert process.stdout and process.stdout.readline() == b"ready\n"
    process.send_signal(number)
    _, err = process.communicate(timeout=20)
    left = snapshot(tmp_path / "m")
    assert b"Traceback" not in err
    assert rebsync("generate", "m.rebeca", cwd=tmp_path).status == 0
    new = snapshot(tmp_path / "m")
    assert b"after(2)" in new["src/r.cpp"] and not any(name.endswith(".tmp") for name in new)
    if number is not signal.SIGKILL:
        assert left in (old, new)


def test_one_process_at_a_time_writes_a_tree(tmp_path: Path) -> None:
    for rate in (1, 2):
        (tmp_path / "m.rebeca").write_text(_model(rate))
        running = [
            subprocess.Popen(
                [sys.executable, "-m", "rebsync", "generate", "m.rebeca", "-o", "new/folder"],
                cwd=tmp_path,
                env=environment(),
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
            )
            for _ in range(4)
        ]
        ended = [process.communicate(timeout=60) for process in running]
        assert [process.returncode for process in running] == [0] * 4, ended
        assert sum(b" 0 of them written" in out for out, _ in ended) == 3, ended


def test_interrupted_when_all_is_done_nothing_is_taken_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a"
    path.write_text("old")

    def interrupted(_: Path) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("rebsync.writing._sync_directory", interrupted)
    with pytest.raises(KeyboardInterrupt):
        replace_text(str(path), "new")
    assert snapshot(tmp_path) == {"a": b"new"}
