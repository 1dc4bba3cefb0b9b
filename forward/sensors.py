"""Sensors: what a `@Sensor` server draws, and where the real data comes from."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Protocol

from rebsync.config import Config
from rebsync.model import (
    Assign,
    Call,
    Choice,
    Local,
    MessageServer,
    Name,
    ReactiveClass,
    Self,
    Type,
    walk,
)
from rebsync.names import camel_case, field_names, snake_case, unique
from rebsync.package import Draw, NodeClass, Sensor, Value
from rebsync.records import dataclass
from rebsync.static import Analysis
from rebsync.static.constants import constant
from rebsync.static.symbols import EnvSymbol
from rebsync.static.types import INT, is_integer


def sensors_of(
    declaration: ReactiveClass,
    analysis: Analysis,
    config: Config,
    used_types: set[str],
    used_names: set[str],
) -> tuple[Sensor, ...]:
    """The sensors of a class, in the order of the text."""
    return tuple(
        _sensor(declaration.name, member, analysis, config, used_types, used_names)
        for member in declaration.members
        if isinstance(member, MessageServer)
        and member.body is not None
        and any(a.name == "Sensor" for a in member.annotations)
    )


def draws_of(server: MessageServer) -> tuple[Choice, ...]:
    """The `?(...)` of a server, in the order of the text."""
    if server.body is None:
        return ()
    return tuple(node for node in walk(server.body) if isinstance(node, Choice))


class SensorNames(Protocol):
    """By server: the member that has its sensor, and for each `?(...)` the function to ask."""

    @property
    def sensors(self) -> Mapping[str, str]: ...

    @property
    def seen(self) -> Mapping[str, Sequence[str]]: ...


def samplers(
    node: NodeClass,
    declaration: ReactiveClass | None,
    names: SensorNames,
    sample: Callable[[str, str], str],
) -> dict[int, str]:
    """By the identity of each `?(...)` of a sensor server, the code that samples the sensor.

    `sample` makes it of the member that has the sensor and of the function that tells what is seen.
    """
    if declaration is None:
        return {}
    servers = {m.name: m for m in declaration.members if isinstance(m, MessageServer)}
    return {
        id(choice): sample(names.sensors[sensor.server], function)
        for sensor in node.sensors
        for choice, function in zip(
            draws_of(servers[sensor.server]), names.seen[sensor.server], strict=True
        )
    }


@dataclass(frozen=True, slots=True)
class PlayedSensor:
    """A sensor that a stand-in plays: its topic, type, period in model time, and its draws."""

    name: str
    type: str
    period: float
    draws: tuple[tuple[str, str], ...]


def played_sensors(node: NodeClass, choices: Callable[[Draw], str]) -> list[PlayedSensor]:
    """The sensors of a class that are not bound; the draws are fields with their choices."""
    return [
        PlayedSensor(s.name, s.type, s.period, tuple((d.field, choices(d)) for d in s.draws))
        for s in node.sensors
        if s.stands_in
    ]


def _sensor(
    class_name: str,
    server: MessageServer,
    analysis: Analysis,
    config: Config,
    used_types: set[str],
    used_names: set[str],
) -> Sensor:
    choices = draws_of(server)
    fields = field_names([_drawn_into(server, choice) or server.name for choice in choices])
    draws = tuple(
        Draw(field, _type(choice, analysis), _alternatives(choice))
        for field, choice in zip(fields, choices, strict=True)
    )
    binding = config.sensor(class_name, server.name)
    name, period = unique(snake_case(server.name), used_names), _period(server, analysis)
    if binding is not None:
        type_ = binding.type.replace("/msg/", "/")
        return Sensor(server.name, name, type_, binding.topic, draws, period, binding.seen)
    type_ = unique(f"{camel_case(class_name)}{camel_case(server.name)}Data", used_types, "")
    return Sensor(server.name, name, type_, None, draws, period)


def _drawn_into(server: MessageServer, choice: Choice) -> str | None:
    """The variable that a choice is first stored in."""
    assert server.body is not None
    for node in walk(server.body):
        match node:
            case Local(declaration=declaration):
                for declarator in declaration.declarators:
                    if declarator.initial is choice:
                        return declarator.name
            case Assign(target=Name(name), value=value) if value is choice:
                return name
            case _:
                pass
    return None


def _type(choice: Choice, analysis: Analysis) -> Type:
    type_ = analysis.types.get(id(choice), INT)
    return INT if is_integer(type_) else type_


def _alternatives(choice: Choice) -> tuple[Value, ...]:
    values = (constant(option) for option in choice.options)
    return tuple(v for v in values if v is not None)


def _period(server: MessageServer, analysis: Analysis) -> float:
    """The rate of the sensor: the `after` of its send to itself; 1 where that is not constant."""
    assert server.body is not None
    for node in walk(server.body):
        match node:
            case Call(target=None | Self(), name=server.name, after=after) if after is not None:
                value = constant(after, lambda name: _env_value(name, analysis))
                if value is not None and value > 0:
                    return float(value)
            case _:
                pass
    return 1.0


def _env_value(name: Name, analysis: Analysis) -> int | float | bool | None:
    symbol = analysis.symbols.get(id(name))
    return symbol.value if isinstance(symbol, EnvSymbol) else None
