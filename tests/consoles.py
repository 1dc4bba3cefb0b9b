"""Pages as tests: the files that they show are written, their commands run and print the same."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parent.parent

_BLOCK = re.compile(r"^```(\w+) ?(\S*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@dataclass(frozen=True, slots=True)
class Command:
    """A command of a console block and what the page says that it prints."""

    text: str
    output: str


@dataclass(frozen=True, slots=True)
class File:
    """A block that stands for a file: its info string has the name."""

    name: str
    text: str


def steps(page: str) -> Iterator[Command | File]:
    """What a page has its reader do, in order."""
    for language, name, body in _BLOCK.findall(page):
        if language == "console":
            for part in re.split(r"^\$ ", body, flags=re.MULTILINE)[1:]:
                command, _, output = part.partition("\n")
                yield Command(command, output)
        elif name:
            yield File(name, body)


def play(page: str, folder: Path) -> Iterator[tuple[Command, str]]:
    """Do what a page says in a folder: each command, and what it really prints."""
    environment = _environment(folder)
    home = folder / "home"
    home.mkdir()
    for step in steps(page):
        if isinstance(step, File):
            (home / step.name).parent.mkdir(exist_ok=True)
            (home / step.name).write_text(step.text, encoding="utf-8")
            continue
        done = subprocess.run(
            step.text, shell=True, cwd=home, env=environment, capture_output=True, text=True
        )
        yield step, done.stdout + _without_remarks(done.stderr)


def _environment(folder: Path) -> dict[str, str]:
    tool = folder / "bin" / "rebsync"
    tool.parent.mkdir()
    tool.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m rebsync "$@"\n')
    tool.chmod(0o755)
    path = f"{tool.parent}:{os.environ['PATH']}"
    return {**os.environ, "PATH": path, "PYTHONPATH": str(ROOT)}


def _without_remarks(errors: str) -> str:
    """Standard error without what only counts or confirms."""
    remark = re.compile(r"(?:formatted .*|\d+ (?:error|warning|note)s?\b.*)\n")
    return remark.sub("", errors)
