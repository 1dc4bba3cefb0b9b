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
    namespace: str
    parameters: Mapping[str, Any]
    remappings: Sequence[tuple[str, str]]
    ros_arguments: Sequence[str]


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


@dataclass(frozen=True, slots=True)
class _Configuration:
    name: str


@dataclass(frozen=True, slots=True)
class _Declared:
    """An argument of the launch file."""

    name: str
    default_value: Any
    description: str


@dataclass(frozen=True, slots=True)
class _Facts:
    """How a package is launched."""

    package: Path
    arguments: Mapping[str, Any]


def _node(**facts: object) -> dict[str, Any]:
    return facts


@contextmanager
def _stand_ins() -> Iterator[None]:
    """The modules that launch files import, as far as generated ones use them."""
    names: dict[str, dict[str, Any]] = {
        "launch": {"LaunchDescription": list},
        "launch.actions": {"DeclareLaunchArgument": _Declared},
        "launch.substitutions": {
            "LaunchConfiguration": _Configuration,
            "PathJoinSubstitution": _Join,
        },
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


def launched(package: Path, stem: str = "", /, **arguments: str) -> list[Launched]:
    """The nodes of a launch file, that of the package if none is named, started with arguments."""
    file = package / "launch" / f"{stem or package.name}.launch.py"
    with _stand_ins():
        actions = runpy.run_path(str(file))["generate_launch_description"]()
    declared = {a.name: a.default_value for a in actions if isinstance(a, _Declared)}
    assert arguments.keys() <= declared.keys()
    facts = _Facts(package, declared | arguments)
    return [_launched(facts, a) for a in actions if not isinstance(a, _Declared)]


def _launched(facts: _Facts, node: Mapping[str, Any]) -> Launched:
    parameters: dict[str, Any] = {}
    for source in node.get("parameters", ()):
        given = _resolved(facts, source)
        if isinstance(given, dict):
            parameters |= {key: _evaluated(_resolved(facts, v)) for key, v in given.items()}
        else:
            parameters |= _file(facts.package, given)
    return Launched(
        node["package"],
        node["executable"],
        node["name"],
        _resolved(facts, node.get("namespace", "")),
        parameters,
        node.get("remappings", ()),
        [_resolved(facts, word) for word in node.get("ros_arguments", ())],
    )


def _resolved(facts: _Facts, value: object) -> Any:  # noqa: ANN401 whatever stands there
    """What a configuration holds."""
    return facts.arguments[value.name] if isinstance(value, _Configuration) else value


def _file(package: Path, path: _Join | str) -> dict[str, Any]:
    if isinstance(path, _Join):
        assert path.parts[0] == _Share(package.name)
        path = str(package.joinpath(*path.parts[1:]))
    content = yaml.safe_load(Path(path).read_text())
    return dict(_flat(content["/**"]["ros__parameters"], ""))


def _flat(table: Mapping[str, Any], prefix: str) -> Iterator[tuple[str, Any]]:
    for key, value in table.items():
        if isinstance(value, dict):
            yield from _flat(value, f"{prefix}{key}.")
        else:
            yield f"{prefix}{key}", value


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
