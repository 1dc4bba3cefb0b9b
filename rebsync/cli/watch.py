"""`rebsync watch`: lint, check and verify what has changed, as files are saved."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import field
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

import click

from rebsync.cli.amounts import duration
from rebsync.cli.status import Status
from rebsync.diagnostics import RebsyncError
from rebsync.files import operating_on
from rebsync.records import dataclass
from rebsync.terminal import json_text, say
from rebsync.writing import replace_text, replace_tree

if TYPE_CHECKING:
    from rebsync.cli.watch_steps import Command, WatchOptions
    from rebsync.roundtrip.package.inventory import Inventory

_PAUSE = 100  # ms in which no file changes before something is done, and between two looks
_PATIENCE = 5.0  # s for a command that is to end
_SAID = {0: "all is well", 1: "findings", 3: "violated", 4: "undetermined"}


@click.command("watch")
@click.argument("directory", metavar="[DIR]", default=".")
@click.option("--verify", is_flag=True, help="Verify models, and code that was edited, as well.")
@click.option(
    "--max-time",
    callback=duration,
    default="60s",
    metavar="TIME",
    help="Bound of each search (default: 60s).",
)
@click.option("--page", metavar="DIR", help="Write a page there that shows all of it.")
def command(directory: str, verify: bool, max_time: float, page: str | None) -> Status:
    """Lint, check and, with --verify, verify what has changed, as files below DIR are saved.

    Each step is a command of rebsync, which is printed. Ctrl-C ends it.
    """
    from rebsync.cli.watch_steps import WatchOptions

    if find_spec("watchfiles") is None:
        hint = "pip install 'rebsync[watch]'"
        raise RebsyncError.of("watchfiles", "RS816", "`rebsync watch` needs this library", hint)
    with operating_on(directory), os.scandir(directory):
        options = WatchOptions(verify or page is not None, f"{max_time:g}s", page)
    watching = _Watching(directory, options)
    if page is not None:
        shell = Path(__file__).with_name("watch.html").read_text(encoding="utf-8")
        replace_tree(page, {"index.html": shell})
        watching.tell_page()
        say(f"the page is {Path(page, 'index.html')}")
    try:
        watching.run()
    finally:
        watching.stop()
    return Status.CLEAN


@dataclass(slots=True)
class _Watching:
    """What is known of a directory, the command that runs, and those that are to follow."""

    directory: str
    options: WatchOptions
    known: Inventory | None = None
    waiting: list[Command] = field(default_factory=list)
    running: tuple[Command, subprocess.Popen[bytes]] | None = None
    parts: dict[str, dict[str, object]] = field(default_factory=dict)

    def run(self) -> None:
        """Goes on for ever; a directory that is gone is waited for."""
        while True:
            if (place := _place(self.directory)) is None:
                self.stop()
                time.sleep(_PAUSE / 1000)
                continue
            self.begin(None)
            for changed in _changes(self.directory, self.options.page):
                if changed:
                    self.begin(changed)
                self.go_on()
                if _place(self.directory) != place:
                    break

    def begin(self, changed: set[str] | None) -> None:
        """Plans what is to be done; a command that runs is ended, and runs again in its turn."""
        from rebsync.cli.watch_steps import commands
        from rebsync.roundtrip.package.inventory import inventory

        with suppress(RebsyncError, OSError):  # a directory goes while it is looked at
            now = inventory(self.directory)
            self.known = now if self.known is None else now.beside(self.known)
        if self.known is None:
            return
        planned = list(commands(self.known, changed, self.options))
        if not planned:
            return
        interrupted = [self.running[0]] if self.running is not None else []
        self.stop()
        rest = [each for each in (*interrupted, *self.waiting) if each not in planned]
        self.waiting = [*planned, *rest]

    def go_on(self) -> None:
        """Starts the next command if none runs."""
        if self.running is not None:
            done, process = self.running
            if process.poll() is None:
                return
            self.running = None
            self.tell(done, process.returncode)
            if not self.waiting:
                say("watching")
        if self.waiting:
            following = self.waiting.pop(0)
            say(f"$ rebsync {' '.join(following.arguments)}")
            program = (sys.executable, "-m", "rebsync", *following.arguments)
            # Of its own group, so that it is ended with all that it has started.
            process = subprocess.Popen(program, start_new_session=True, stdin=subprocess.DEVNULL)
            self.running = following, process

    def stop(self) -> None:
        """Ends the command that runs."""
        if self.running is None:
            return
        _, process = self.running
        self.running = None
        for number in (signal.SIGTERM, signal.SIGKILL):
            with suppress(ProcessLookupError):
                os.killpg(process.pid, number)
            with suppress(subprocess.TimeoutExpired):
                process.wait(_PATIENCE)
                break

    def tell(self, done: Command, status: int) -> None:
        """Says what a part of the page shows, there and here."""
        if not done.file:
            return
        state = _SAID.get(status, "cannot be shown")
        version = time.time_ns()
        self.parts[done.title] = {
            "title": done.title,
            "file": done.file,
            "state": state,
            "version": str(version),
        }
        self.tell_page()
        say(f"{done.title}: {state}")

    def tell_page(self) -> None:
        """Writes which parts the page has."""
        assert self.options.page is not None
        parts = [self.parts[title] for title in sorted(self.parts)]
        replace_text(str(Path(self.options.page, "parts.js")), f"show({json_text(parts)});\n")


def _place(directory: str) -> tuple[int, int] | None:
    """What tells a directory from another one of its name; None where it is gone."""
    try:
        found = Path(directory).stat()
    except OSError:
        return None
    return found.st_dev, found.st_ino


def _changes(directory: str, page: str | None) -> Iterator[set[str]]:
    """The real paths of what has changed in a directory; now and then nothing."""
    from watchfiles import DefaultFilter, watch

    ignored: Sequence[str] = () if page is None else (os.path.realpath(page),)
    with suppress(FileNotFoundError):
        for found in watch(
            os.path.realpath(directory),
            watch_filter=DefaultFilter(ignore_paths=ignored),
            step=_PAUSE,
            rust_timeout=_PAUSE,
            yield_on_timeout=True,
        ):
            yield {path for _, path in found}
