"""Reads a generated launch file by running it against stand-ins for launch and launch_ros."""

from __future__ import annotations

import runpy
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import yaml


@dataclass(frozen=True, slots=True)
class Launched:
    """A node that a launch file starts, its parameters with those of its files merged."""

    package: str
    executable: str
    name: str
    parameters: Mapping[str, Any]
    remappings: Sequence[tuple[str, str]]


@dataclass(frozen=True, slots=True)
class _Typed:
    value: Any
    value_type: Any


@dataclass(frozen=True, slots=True)
class _Join:
    parts: Sequence[Any]


@dataclass(frozen=True, slots=True)
class _Share:
    package: str


def _node(**facts: object) -> dict[str, Any]:
    return facts


@contextmanager
def _stand_ins() -> Iterator[None]:
    """The modules that launch files import, as far as generated ones use them."""
    names: dict[str, dict[str, Any]] = {
        "launch": {"LaunchDescription": list},
        "launch.substitutions": {"PathJoinSubstitution": _Join},
        "launch_ros": {},
        "launch_ros.actions": {"Node": _node},
        "launch_ros.parameter_descriptions": {"ParameterValue": _Typed},
        "launch_ros.substitutions": {"FindPackageShare": _Share},
    }
    before = {name: sys.modules.get(name) for name in names}
    for name, content in names.items():
        module = ModuleType(name)
        vars(module).update(content)
        sys.modules[name] = module
    try:
        yield
    finally:
        for name, old in before.items():
            if old is None:
                del sys.modules[name]
            else:
                sys.modules[name] = old


def launched(package: Path) -> list[Launched]:
    """The nodes of the package's launch file."""
    file = package / "launch" / f"{package.name}.launch.py"
    with _stand_ins():
        nodes = runpy.run_path(str(file))["generate_launch_description"]()
    return [_launched(package, facts) for facts in nodes]


def _launched(package: Path, facts: Mapping[str, Any]) -> Launched:
    parameters: dict[str, Any] = {}
    for source in facts.get("parameters", ()):
        parameters.update(_file(package, source) if isinstance(source, _Join) else _given(source))
    return Launched(
        facts["package"],
        facts["executable"],
        facts["name"],
        parameters,
        facts.get("remappings", ()),
    )


def _file(package: Path, path: _Join) -> dict[str, Any]:
    assert path.parts[0] == _Share(package.name)
    content = yaml.safe_load(package.joinpath(*path.parts[1:]).read_text())
    return dict(_flat(content["/**"]["ros__parameters"], ""))


def _flat(table: Mapping[str, Any], prefix: str) -> Iterator[tuple[str, Any]]:
    for key, value in table.items():
        if isinstance(value, dict):
            yield from _flat(value, f"{prefix}{key}.")
        else:
            yield f"{prefix}{key}", value


def _given(table: Mapping[str, Any]) -> dict[str, Any]:
    return {key: _evaluated(value) for key, value in table.items()}


def _evaluated(value: object) -> object:
    """launch_ros reads text as YAML, but for what has a type."""
    match value:
        case _Typed(typed, _):
            return typed
        case str():
            return yaml.safe_load(value)
        case list():
            return [_evaluated(item) for item in value]
        case _:
            return value
