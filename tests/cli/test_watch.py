"""`rebsync watch`: which commands a change asks for, and a session in which files are saved."""

from __future__ import annotations

import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from queue import Queue
from threading import Thread

import pytest

from rebsync.cli import main
from rebsync.cli.watch_steps import WatchOptions, commands
from rebsync.roundtrip.package.inventory import Inventory, inventory
from tests.cli.run import environment

_PATIENCE = 120  # s, of a machine that is busy
VERIFYING = WatchOptions(is_verifying=True, max_time="9s", page=None)
LINT = "lint hello/hello.rebeca hello/hello.property"
VERIFY = "verify hello/hello.rebeca --max-time 9s"
CHECK = "check hello/hello"
PROVE = f"{CHECK} --verify --max-time 9s"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A directory with an example."""
    assert main(["examples", str(tmp_path), "hello"]) == 0
    monkeypatch.chdir(tmp_path)
    return tmp_path


def planned(known: Inventory, *changed: Path, options: WatchOptions = VERIFYING) -> list[str]:
    """The commands that these changes ask for."""
    paths = set(map(str, changed)) or None
    return [" ".join(each.arguments) for each in commands(known, paths, options)]


def test_what_a_change_asks_for(folder: Path) -> None:
    known = inventory(".")
    assert planned(known) == [LINT, VERIFY, CHECK]
    for name in ("hello.rebeca", "hello.property", "rebsync.toml"):
        assert planned(known, folder / "hello" / name) == [LINT, VERIFY, CHECK]
    assert planned(known, folder / "hello/hello/src/walker.cpp") == [PROVE]
    assert planned(known, folder / "hello") == [LINT, VERIFY, PROVE]
    assert planned(known, folder / "hello/README.md") == []
    lazy = WatchOptions(is_verifying=False, max_time="9s", page=None)
    assert planned(known, folder / "hello", options=lazy) == [LINT, CHECK]


def test_a_shared_run_time_part_is_of_each_package(folder: Path) -> None:
    generated = ["generate", "--runtime", "package", "hello/hello.rebeca", "-o", "hello"]
    assert main(generated) == 0
    known = inventory(".")
    assert known.packages == ()
    runtime = folder / "hello/rebsync_runtime/include/rebsync_runtime"
    assert planned(known, runtime / "mailbox.h") == [PROVE]
    assert planned(known, folder / "hello/other/mailbox.h") == []


def test_what_the_page_asks_for(folder: Path) -> None:
    options = WatchOptions(is_verifying=True, max_time="9s", page="p")
    assert planned(inventory("."), options=options) == [
        LINT,
        f"{VERIFY} --format html -o p/hello_hello.rebeca-run.html",
        CHECK,
        "graph hello/hello --format html -o p/hello_hello-graph.html",
        "diff hello/hello.rebeca hello/hello --format html -o p/hello_hello-drift.html",
    ]


def test_what_is_gone_is_known_by_what_was_there(folder: Path) -> None:
    before = inventory(".")
    (folder / "hello/hello.rebeca").unlink()
    known = inventory(".").beside(before)
    assert CHECK in planned(known, folder / "hello/hello.rebeca")
    shutil.rmtree(folder / "hello/hello")
    assert planned(inventory(".").beside(known), folder / "hello/hello") == []


class Watch:
    """A `rebsync watch` that runs, and the lines that it prints."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self.process = process
        self.lines: Queue[str] = Queue()
        self.reader = Thread(target=self._read, daemon=True)
        self.reader.start()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self.lines.put(line.rstrip("\n"))

    def until(self, part: str) -> str:
        """The next line with a text in it."""
        while part not in (line := self.lines.get(timeout=_PATIENCE)):
            pass
        return line


@contextmanager
def watching(folder: Path, *options: str) -> Iterator[Watch]:
    """A session, which ends when the block does."""
    process = subprocess.Popen(
        [sys.executable, "-m", "rebsync", "watch", *options],
        cwd=folder,
        env={**environment(), "PYTHONUNBUFFERED": "1"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    with process:
        try:
            yield Watch(process)
        finally:
            process.kill()


def save(path: Path, old: str, new: str) -> None:
    """Saves a file as editors do: another one takes its place."""
    text = path.read_text(encoding="utf-8")
    assert old in text
    beside = path.with_name(f".{path.name}.swp")
    beside.write_text(text.replace(old, new), encoding="utf-8")
    beside.replace(path)


def test_a_session(folder: Path) -> None:
    model, code = folder / "hello/hello.rebeca", folder / "hello/hello/src/walker.cpp"
    with watching(folder) as watch:
        watch.until("hello/hello: in step")
        watch.until("watching")
        save(model, "steps + 1", "step + 1")
        watch.until("RS203 unknown variable")
        save(model, "step + 1", "steps + 1")  # while the mistake is still told
        watch.until("hello/hello: in step")
        save(code, "delay(2)", "delay(3)")
        watch.until("the code is ahead")
        (folder / "hello").rename(folder / "moved")
        watch.until("moved/hello: the code is ahead")
        shutil.rmtree(folder / "moved")
        assert main(["examples", str(folder), "hello"]) == 0
        watch.until("hello/hello: in step")
        watch.process.send_signal(signal.SIGINT)
        assert watch.process.wait(_PATIENCE) == 130
        watch.reader.join(_PATIENCE)
        assert not any("Traceback" in line for line in watch.lines.queue)


def test_a_directory_that_is_gone_is_waited_for(folder: Path) -> None:
    with watching(folder, "hello", "--page", "page") as watch:
        watch.until("hello/hello: graph: ")
        assert "hello_hello-graph.html" in (folder / "page/parts.js").read_text()
        (folder / "hello").rename(folder / "moved")
        assert main(["examples", str(folder), "hello"]) == 0
        watch.until("$ rebsync lint hello/hello.rebeca")
        watch.until("hello/hello: in step")
