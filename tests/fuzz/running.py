"""Inputs in child processes: what a process dies of, or takes for ever, is found as well."""

from __future__ import annotations

import json
import os
import resource
import select
import shutil
import signal
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, BinaryIO

from tests.fuzz.cases import ROOT, case, write
from tests.fuzz.oracle import run

_BATCH = 100  # inputs for one process
_MEMORY = 3 << 30  # bytes
_CANARY = "canary"
_Say = Callable[..., None]


@dataclass(frozen=True)
class Ran:
    """How often the commands of one input were run, and how long that took."""

    number: int
    kind: str
    commands: int
    seconds: float


@dataclass(frozen=True)
class Finding:
    """Something that is wrong with one command of an input."""

    seed: int
    number: int
    kind: str
    arguments: tuple[str, ...]
    wrong: str
    details: str = ""

    def text(self) -> str:
        """What it is, and how to see it again."""
        again = f"--seed {self.seed} --first {self.number} --inputs 1"
        what = f"{self.kind} {self.number}: {self.wrong}: rebsync {' '.join(self.arguments)}"
        return f"{what}\n  again: python -m tests.fuzz {again}\n{self.details}"


@dataclass(frozen=True)
class Figures:
    """What was run, and how many different things were found."""

    inputs: int = 0
    commands: int = 0
    kinds: Counter[str] = field(default_factory=Counter)
    findings: Counter[str] = field(default_factory=Counter)

    def with_(self, each: Ran | Finding) -> Figures:
        """These and one more."""
        if isinstance(each, Finding):
            found = self.findings + Counter([each.wrong])
            return Figures(self.inputs, self.commands, self.kinds, found)
        kinds = self.kinds + Counter([each.kind])
        return Figures(self.inputs + 1, self.commands + each.commands, kinds, self.findings)

    def text(self) -> str:
        """`12,000 inputs (model 4,000, ...), 30,000 commands, 2 kinds of findings`."""
        kinds = ", ".join(f"{k} {n:,}" for k, n in sorted(self.kinds.items()))
        lines = [f"  {n:6,}  {wrong}" for wrong, n in self.findings.most_common()]
        head = f"{self.inputs:,} inputs ({kinds}), {self.commands:,} commands, "
        return "\n".join([*lines, f"{head}{len(self.findings)} kinds of findings"])


def warm_up() -> None:
    """Loads once what all child processes need: they are copies of this one."""
    home = Path(tempfile.mkdtemp(prefix="fuzz-", dir=_memory_disk()))
    os.environ["XDG_CACHE_HOME"] = str(home)
    try:
        hello = str(ROOT / "examples/hello")
        for command in (("lint", hello), ("check", hello), ("extract", f"{hello}/hello")):
            run(command, home, 60.0)
    finally:
        shutil.rmtree(home, ignore_errors=True)


def run_inputs(
    seed: int, numbers: range, seconds: float, limit: float, keep: Path | None = None
) -> Iterator[Ran | Finding]:
    """Runs inputs until they or the seconds are used up; `limit` is for one command."""
    end = time.monotonic() + seconds
    at = numbers.start
    shown: Counter[str] = Counter()
    while at < numbers.stop and time.monotonic() < end:
        batch = range(at, min(at + _BATCH, numbers.stop))
        for each in _in_child(seed, batch, end, limit):
            at = each.number + 1
            if isinstance(each, Finding):
                shown[each.wrong] += 1
                if keep is not None and shown[each.wrong] <= 3:
                    write(case(seed, each.number), keep / f"{each.kind}-{each.number}")
            yield each


def _in_child(seed: int, batch: range, end: float, limit: float) -> Iterator[Ran | Finding]:
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reading)
        status = 1
        try:
            with os.fdopen(writing, "wb") as stream:
                _child(seed, batch, end, limit, stream)
            status = 0
        except BaseException:
            traceback.print_exc()  # a mistake of this runner's
        finally:
            sys.stderr.flush()
            os._exit(status)
    os.close(writing)
    begun: dict[str, Any] = {"number": batch.start, "kind": "?", "arguments": []}
    with os.fdopen(reading, "rb") as stream:
        for message in _messages(stream, child, 3 * limit + 30):
            match message.pop("type"):
                case "begun":
                    begun = message
                case "ran":
                    yield Ran(**message)
                case _:
                    yield Finding(seed, **{**message, "arguments": tuple(message["arguments"])})
    _, status = os.waitpid(child, 0)
    if os.WIFEXITED(status) and status:
        raise RuntimeError("the runner itself failed")
    if status:
        name = signal.Signals(os.WTERMSIG(status)).name
        arguments = tuple(begun["arguments"])
        yield Finding(seed, begun["number"], begun["kind"], arguments, f"the process died: {name}")


def _messages(stream: BinaryIO, child: int, patience: float) -> Iterator[dict[str, Any]]:
    """What a child says; one that says nothing for so long is killed."""
    buffer = b""
    while True:
        ready, _, _ = select.select([stream], [], [], patience)
        if not ready:
            os.kill(child, signal.SIGKILL)
        data = os.read(stream.fileno(), 1 << 16)
        if not data:
            return
        *lines, buffer = (buffer + data).split(b"\n")
        yield from map(json.loads, lines)


def _child(seed: int, batch: range, end: float, limit: float, stream: BinaryIO) -> None:
    def say(type_: str, /, **message: object) -> None:
        stream.write(json.dumps({"type": type_, **message}).encode() + b"\n")
        stream.flush()

    resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    home = Path(tempfile.mkdtemp(prefix="fuzz-", dir=_memory_disk()))
    os.environ |= {"XDG_CACHE_HOME": str(home / "cache"), "HOME": str(home), "NO_COLOR": ""}
    try:
        for number in batch:
            if time.monotonic() >= end:
                break
            _one(seed, number, home, limit, say)
    finally:
        shutil.rmtree(home, ignore_errors=True)


def _memory_disk() -> str | None:
    return "/dev/shm" if os.access("/dev/shm", os.W_OK) else None


def _one(seed: int, number: int, home: Path, limit: float, say: _Say) -> None:
    say("begun", number=number, kind="?", arguments=[])
    given = case(seed, number)
    around = home / "around"
    folder = around / "case"
    folder.mkdir(parents=True)
    (around / _CANARY).write_text(_CANARY)
    write(given, folder)
    began = time.monotonic()
    count = 0
    for i, command in enumerate(given.commands):
        about = {"number": number, "kind": given.kind, "arguments": command}
        say("begun", **about)
        ran = run(command, folder, limit, seen=(number + i) % 4 == 0)
        count += 1
        wrong = ran.wrong or _outside(around)
        if wrong:
            say("found", **about, wrong=wrong, details=ran.details)
            break
    say("ran", number=number, kind=given.kind, commands=count, seconds=time.monotonic() - began)
    shutil.rmtree(around, ignore_errors=True)


def _outside(around: Path) -> str:
    """Whether something was written beside the folder of the input."""
    names = sorted(path.name for path in around.iterdir())
    if names != [_CANARY, "case"] or (around / _CANARY).read_text() != _CANARY:
        return "something was written outside of the folder"
    return ""
