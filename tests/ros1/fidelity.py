"""Recorded runs of nodes against their models, and what of it is told at the end of all tests."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from rebsync.cli.problem import read_problem
from rebsync.config import Config, settings_beside
from rebsync.conform.conformance import Conformance
from rebsync.conform.matching import Subject, conform
from rebsync.conform.reading import recordings
from rebsync.conform.topics import Topics
from tests.ros1.recording import Recording

FIDELITY = "fidelity"


def subject(model: Path, config: Config | None = None) -> Subject:
    """A model with the settings beside it, or others."""
    settings = config if config is not None else settings_beside(str(model))[1]
    return Subject.of(read_problem(str(model), None), settings)


def compared(model: Path, recording: Path, config: Config | None = None) -> Conformance:
    """What `rebsync conform` says of a recording."""
    of = subject(model, config)
    opened = recordings([str(recording)], Topics.of(of.observable), of.observable.package, None)
    return conform(of, opened)


def log_of(recording: Recording, folder: Path) -> Path:
    """The log of a run, as `rebsync conform` reads it; written where the run has left none.

    Then its stamps count from time 0, and what nodes announce of that is of another clock.
    """
    if recording.run_log.is_file():
        return recording.run_log
    path = folder / "run.jsonl"
    heard = (m for m in recording.messages if not m.topic.endswith("/startup"))
    lines = ({"topic": m.topic, "stamp": m.stamp, "data": m.fields} for m in heard)
    path.write_text("".join(f"{json.dumps(line, default=list)}\n" for line in lines))
    return path


def run_name(request: pytest.FixtureRequest, name: str) -> str:
    """The name of a run: where its test is, and what it was run with."""
    callspec = getattr(request.node, "callspec", None)
    return f"{request.path.parent.name} {callspec.id if callspec is not None else name}"


def note(recording: Path, model: str, dialect: str) -> None:
    """Writes beside a log what it is of, for tests/conform/record.py."""
    text = json.dumps({"model": model, "dialect": dialect})
    recording.with_name("subject.json").write_text(text, encoding="utf-8")


def fidelity(name: str, found: Conformance) -> tuple[str, int, int, float]:
    """Name, steps compared, steps that are not allowed, greatest time error in seconds."""
    greatest = found.lateness.greatest
    refused = 1 if found.verdict == "deviates" else 0
    return name, found.compared, refused, abs(greatest[2]) if greatest is not None else 0.0


def summary_lines(runs: list[tuple[str, int, int, float]]) -> list[str]:
    """The lines at the end of the tests."""
    lines = [
        f"{name}: {steps} steps, {refused} not allowed, time error {error:.3f} s"
        for name, steps, refused, error in sorted(runs)
    ]
    steps, refused = sum(r[1] for r in runs), sum(r[2] for r in runs)
    worst = max((r[3] for r in runs), default=0.0)
    total = f"{len(runs)} runs: {steps} steps, {refused} not allowed, time error {worst:.3f} s"
    return [*lines, total]
