"""The classes of a package with all that their Python needs to know."""

from __future__ import annotations

from collections.abc import Mapping

from rebsync.forward.effects import hoisted
from rebsync.forward.py_class import PyClass
from rebsync.forward.py_expressions import PyExpressions
from rebsync.forward.py_names import PyNames, class_names
from rebsync.forward.py_statements import PyStatements
from rebsync.forward.py_types import class_type, py_value
from rebsync.forward.remarks import Remarks
from rebsync.forward.sends import bodies
from rebsync.forward.sensors import draws_of
from rebsync.forward.topics import Topics
from rebsync.model import MessageServer, ReactiveClass
from rebsync.package import NodeClass, Package
from rebsync.records import dataclass
from rebsync.static import Analysis


def classes(
    package: Package, analysis: Analysis, topics: Topics, remarks: Remarks
) -> Mapping[str, PyClass]:
    """Every class by its name in the model."""
    types = {name: class_type(name) for name in topics.class_types}
    names = class_names(package, types)
    found: dict[str, PyClass] = {}
    for node in package.classes:
        declaration = analysis.classes[node.name].declaration
        reactive = declaration if isinstance(declaration, ReactiveClass) else None
        own = names[node.name]
        expressions = PyExpressions(analysis, topics, own, types, _seen(node, reactive, own))
        inside = list(bodies(reactive)) if reactive else []
        found[node.name] = PyClass(
            package,
            node,
            types[node.name],
            tuple(types[b] for b in _bases(package, node)),
            own,
            PyStatements(expressions, remarks, hoisted(inside, analysis)),
            _remarks_above(reactive, remarks) if reactive else {},
        )
    return found


def _bases(package: Package, node: NodeClass) -> tuple[str, ...]:
    """The bases, in an order in which no class stands before one that descends from it."""
    above = {b: _above(package, b) for b in node.bases}
    return tuple(sorted(node.bases, key=lambda b: sum(b in a for a in above.values())))


def _above(package: Package, name: str) -> set[str]:
    bases = package.node_class(name).bases
    return set(bases).union(*(_above(package, b) for b in bases))


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


def _seen(node: NodeClass, declaration: ReactiveClass | None, names: PyNames) -> dict[int, str]:
    """For each `?(...)` of a sensor server, the Python that samples the sensor."""
    if declaration is None:
        return {}
    servers = {m.name: m for m in declaration.members if isinstance(m, MessageServer)}
    return {
        id(choice): f"self.{names.sensors[sensor.server]}.seen({function})"
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
    return [
        PlayedSensor(
            s.name,
            s.type,
            s.period,
            tuple((d.field, ", ".join(map(py_value, d.alternatives))) for d in s.draws),
        )
        for s in node.sensors
        if s.stands_in
    ]
