"""Runs a generated package on the stub of rclcpp and reads what happened."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import yaml

from tests.ros1.recording import ERROR, WARNING, Heard, Logged, Recording, Served
from tests.ros2.asking import Answer, Ask
from tests.ros2.launching import Launched, launched

_LEVELS = {"INFO": 2, "WARN": WARNING, "ERROR": ERROR}
_BOOL = "tag:yaml.org,2002:bool"
_BODY = ("server", "arguments", "arrival", "start", "now")


class RunError(Exception):
    """The run did not come to its end; the text is what it printed."""


def run(
    package: Path,
    driver: Path,
    directory: Path,
    until: float,
    foreign: Sequence[str] = (),
    step: float | None = None,
    parameters: Mapping[str, object] | None = None,
    changes: Mapping[str, Sequence[tuple[float, str]]] | None = None,
    arguments: Mapping[str, str] | None = None,
    beside: Sequence[str] = (),
) -> Recording:
    """What happens in a run without clients of services and actions."""
    return run_asked(
        package, driver, directory, until, (), foreign, step, parameters, changes, arguments, beside
    )[0]


def run_asked(
    package: Path,
    driver: Path,
    directory: Path,
    until: float,
    asks: Sequence[Ask],
    foreign: Sequence[str] = (),
    step: float | None = None,
    parameters: Mapping[str, object] | None = None,
    changes: Mapping[str, Sequence[tuple[float, str]]] | None = None,
    arguments: Mapping[str, str] | None = None,
    beside: Sequence[str] = (),
) -> tuple[Recording, tuple[Answer, ...]]:
    """Run the package's launch file for that many seconds of its clock.

    A tool has subscribed to the `foreign` topics and asks for what was sent before, which rebecs do
    not keep. With a `step` the clock is that of a simulation. Each node gets the `parameters` too.
    The `changes` of the life cycles of nodes come after so many seconds; the `arguments` are those
    of the launch file. What other launch files `beside` it start, comes first.
    """
    system = directory / "system.txt"
    own = parameters or {}
    started = [n for other in beside for n in launched(package, other)]
    started += launched(package, **(arguments or {}))
    nodes = [replace(n, parameters={**n.parameters, **own}) for n in started]
    listened = [f"foreign\t{topic}" for topic in foreign]
    lines = [*listened, *(_asked(number, ask) for number, ask in enumerate(asks))]
    for node in nodes:
        lines += _lines(node)
        lines += [f"change\t{at}\t{name}" for at, name in (changes or {}).get(node.name, ())]
    system.write_text("".join(f"{line}\n" for line in lines))
    # A node that waits for a reader of its pipe would seem to wait for a moment, which then comes.
    said = directory / "said"
    with said.open("wb") as out:
        done = subprocess.run(
            [str(driver), str(system), str(until), *([] if step is None else [str(step)])],
            stdout=out,
            stderr=subprocess.PIPE,
            text=True,
            timeout=120,
        )
    output = said.read_text(encoding="utf-8")
    if done.returncode != 0:
        raise RunError(f"{done.returncode}: {done.stderr}\n{output[-2000:]}")
    return _recording(output), _answers(output, asks)


def _asked(number: int, ask: Ask) -> str:
    values = [f"{name}={_text(value)}" for name, value in ask.values.items()]
    kind = "cancel" if ask.cancels else "ask"
    return "\t".join([kind, str(ask.at), str(number), ask.name, *values])


def _answers(output: str, asks: Sequence[Ask]) -> tuple[Answer, ...]:
    lines = [line.split("\t") for line in output.splitlines()]
    zero = _zero(lines)
    return tuple(
        Answer(asks[int(n)].name, asks[int(n)].values, _seconds(int(t), zero), state, _fields(text))
        for _, t, n, state, text in _of(lines, "answer")
    )


def _zero(lines: list[list[str]]) -> int:
    """Time 0 of the model, which nodes tell as they start."""
    told = (_fields(text) for _, _, topic, text in _of(lines, "message") if _is_start(topic))
    return max((int(fields["zero"]) for fields in told), default=0)


def _is_start(topic: str) -> bool:
    return topic.endswith("/startup")


def _lines(node: Launched) -> Iterator[str]:
    yield f"node\t{node.executable}\t{node.name}"
    for name, value in node.parameters.items():
        yield "\t".join(["param", name, *_typed(value)])
    for before, after in node.remappings:
        yield f"remap\t{before}\t{after}"


def _typed(value: object) -> list[str]:
    if isinstance(value, list):
        return [f"{type(value[0]).__name__}s", *map(_text, value)]
    return [type(value).__name__, _text(value)]


def _text(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def _recording(output: str) -> Recording:
    lines = [line.split("\t") for line in output.splitlines()]
    messages = [(int(t), topic, text) for kind, t, topic, text in _of(lines, "message")]
    fields = [(t, topic, _fields(text)) for t, topic, text in messages]
    zero = max((f["zero"] for _, topic, f in fields if _is_start(topic)), default=0)
    heard = tuple(Heard(topic, _seconds(t, zero), found) for t, topic, found in fields)
    log = tuple(
        Logged(node, _LEVELS[level], _seconds(int(t), zero), text)
        for _, t, level, node, text in _of(lines, "log")
    )
    served = tuple(_served(m) for m in heard if set(_BODY) <= set(m.fields))
    return Recording(served, heard, log, (), output)


def _of(lines: list[list[str]], kind: str) -> list[list[str]]:
    return [line for line in lines if line[0] == kind]


def _seconds(nanoseconds: int, zero: int) -> float:
    return round((nanoseconds - zero) / 1e9, 6)


class _Loader(yaml.CSafeLoader):
    """YAML in which a field may be called `on`: only `true` and `false` are truth values."""


_Loader.yaml_implicit_resolvers = {
    first: [(tag, of) for tag, of in all_ if tag != _BOOL or first in "tf"]
    for first, all_ in yaml.CSafeLoader.yaml_implicit_resolvers.items()
}


def _fields(text: str) -> dict[str, Any]:
    fields = yaml.load(text, _Loader)
    assert isinstance(fields, dict)
    return fields


def _served(message: Heard) -> Served:
    fields = message.fields
    state = {name: value for name, value in fields.items() if name not in _BODY}
    rebec = message.topic.strip("/").rsplit("/", 1)[0]
    server, arguments, arrival, start, now = (fields[name] for name in _BODY)
    return Served(rebec, server, arguments, arrival, start, now, message.stamp, state)
