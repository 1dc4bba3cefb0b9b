"""The classes of a package with all that their C++ needs to know."""

from __future__ import annotations

from collections.abc import Mapping

from rebsync.forward.cpp_class import CppClass
from rebsync.forward.cpp_expressions import CppExpressions
from rebsync.forward.cpp_names import CppNames, class_names
from rebsync.forward.cpp_statements import CppStatements
from rebsync.forward.cpp_types import cpp_type, cpp_value
from rebsync.forward.cpp_words import CppWords
from rebsync.forward.effects import hoisted, read_declarations
from rebsync.forward.remarks import Remarks
from rebsync.forward.sends import bodies
from rebsync.forward.sensors import draws_of
from rebsync.forward.topics import Topics
from rebsync.model import MessageServer, ReactiveClass
from rebsync.package import NodeClass, Package, Sensor
from rebsync.records import dataclass
from rebsync.static import Analysis


def classes(
    package: Package, analysis: Analysis, topics: Topics, remarks: Remarks, words: CppWords
) -> Mapping[str, CppClass]:
    """Every class by its name in the model, in the words of one generation of ROS."""
    names = class_names(package, topics.class_types)
    found: dict[str, CppClass] = {}
    for node in package.classes:
        declaration = analysis.classes[node.name].declaration
        reactive = declaration if isinstance(declaration, ReactiveClass) else None
        expressions = CppExpressions(
            analysis,
            topics,
            names[node.name],
            topics.class_types,
            _seen(node, reactive, names[node.name]),
        )
        own = list(bodies(reactive)) if reactive else []
        found[node.name] = CppClass(
            package,
            node,
            topics.class_types[node.name],
            tuple(topics.class_types[b] for b in node.bases),
            names[node.name],
            CppStatements(
                expressions, remarks, read_declarations(own, analysis), hoisted(own, analysis)
            ),
            _remarks_above(reactive, remarks) if reactive else {},
            words,
        )
    return found


def _remarks_above(declaration: ReactiveClass, remarks: Remarks) -> dict[int, tuple[str, ...]]:
    """For each body, the comments that stand before its member."""
    found = {}
    at = declaration.queue_span.end
    for member in declaration.members:
        body = getattr(member, "body", None)
        if body is not None:
            found[id(body)] = tuple(remarks.between(at, member.span.start))
        at = member.span.end
    return found


def _seen(node: NodeClass, declaration: ReactiveClass | None, names: CppNames) -> dict[int, str]:
    """For each `?(...)` of a sensor server, the C++ that samples the sensor."""
    if declaration is None:
        return {}
    servers = {m.name: m for m in declaration.members if isinstance(m, MessageServer)}
    return {
        id(choice): f"{names.sensors[sensor.server]}.seen(&{function})"
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


def played_sensors(node: NodeClass) -> list[PlayedSensor]:
    """The sensors of a class that are not bound; the draws are fields with their choices."""
    return [_played(s) for s in node.sensors if s.stands_in]


def _played(sensor: Sensor) -> PlayedSensor:
    draws = (
        (d.field, _choices(cpp_type(d.type), [cpp_value(v) for v in d.alternatives]))
        for d in sensor.draws
    )
    return PlayedSensor(sensor.name, sensor.type, sensor.period, tuple(draws))


def _choices(type_: str, values: list[str]) -> str:
    return f"std::initializer_list<{type_}>{{{', '.join(values)}}}"
