"""The view: a Timed Rebeca model as a ROS package that knows no dialect."""

from __future__ import annotations

from collections.abc import Sequence
from keyword import kwlist

from rebsync import package as p
from rebsync.config import Config
from rebsync.forward.incoming import Incoming
from rebsync.forward.instances import Instances
from rebsync.forward.outgoing import Outgoing
from rebsync.forward.sends import bodies, known_as_values
from rebsync.forward.sensors import sensors_of
from rebsync.forward.topics import Topics
from rebsync.model import (
    Annotation,
    Constructor,
    Env,
    InstanceOf,
    Interface,
    KnownRebecs,
    Model,
    Name,
    ReactiveClass,
    StateVars,
    walk,
)
from rebsync.names import free_name, graph_name, message_class, node_name, snake_case
from rebsync.reserved import MONITOR_FILES, RESERVED_GLOBALS, RUNTIME_CLASSES, RUNTIME_HEADERS
from rebsync.static import Analysis
from rebsync.static.symbols import EnvSymbol
from rebsync.static.values import env_value

# What catkin_create_pkg and `ros2 pkg create` write where nobody has said it.
_NO_LICENSE = "TODO: License declaration"
_NOBODY = p.Maintainer("TODO: maintainer", "user@todo.todo")
_FILES = ("", "_node", "_sensors", "_stand_in")
# What no module of a package can be called: what no import can name, and what ROS 1 generates.
_NO_MODULE = {"ros1-py": frozenset({*kwlist, "msg", "srv"}), "ros2-py": frozenset(kwlist)}


def view(model: Model, analysis: Analysis, config: Config, name: str) -> tuple[p.Package, Topics]:
    """The package that carries out a model, and the topic of each server.

    `analysis` must be free of errors.
    """
    seen = _View(model, analysis, config)
    return seen.package(name), seen.topics


class _View:
    def __init__(self, model: Model, analysis: Analysis, config: Config) -> None:
        self.model = model
        self.analysis = analysis
        self.config = config
        self.topics = Topics(model, analysis)
        self.env = {e.name: e for e in self._globals()}
        self._files = {*RUNTIME_HEADERS, *(MONITOR_FILES if config.monitor else ())}
        rebecs = model.main.rebecs if model.main is not None else ()
        self._running = {id(analysis.constructor_of(r)) for r in rebecs}
        self._types = {m.name for m in self.topics.messages} | RUNTIME_CLASSES
        self._types |= {s.name for s in self.topics.states.values()}
        self._types |= set(self.topics.class_types.values())
        self._sensor_names: dict[str, set[str]] = {}
        self._incoming = Incoming(self.topics, analysis)
        self._outgoing = Outgoing(self.topics, analysis)
        reactive = (c for c in model.classes if isinstance(c, ReactiveClass))
        used = (s for c in reactive for s in known_as_values(c, analysis))
        self._values = frozenset((s.owner, s.name) for s in used)

    def package(self, name: str) -> p.Package:
        config = self.config
        classes = tuple(self._class(c) for c in self._ancestors_first())
        instances = Instances(self.model, self.analysis, self.topics, classes)
        return p.Package(
            name,
            config.version,
            config.description or f"Generated from the Timed Rebeca model {name}.",
            config.license or _NO_LICENSE,
            config.copyright,
            tuple(p.Maintainer(m.name, m.email) for m in config.maintainers) or (_NOBODY,),
            p.Settings(
                config.time_unit,
                config.slack,
                config.seed,
                config.cell_size,
                config.drive,
                config.heading,
                config.odometry,
                config.lifecycle,
                config.monitor,
            ),
            self.topics.messages,
            tuple(self.env.values()),
            tuple(sorted(classes, key=lambda c: self._order(c.name))),
            instances.instances(),
            instances.stand_ins(),
            instances.instances_of(),
        )

    def _order(self, class_name: str) -> int:
        return [c.name for c in self.model.classes].index(class_name)

    def _ancestors_first(self) -> list[ReactiveClass | Interface]:
        classes = list(self.model.classes)
        return sorted(classes, key=lambda c: len(self.analysis.classes[c.name].ancestors))

    def _globals(self) -> list[p.GlobalParameter]:
        found = []
        taken = RESERVED_GLOBALS | {
            node_name(r.name) for r in (self.model.main.rebecs if self.model.main else ())
        }
        for head in self.model.heads:
            if isinstance(head, Env):
                type_ = head.declaration.type
                for declarator in head.declaration.declarators:
                    key = free_name(declarator.name, taken)
                    value = env_value(declarator, type_, self.env_constant)
                    found.append(p.GlobalParameter(declarator.name, key, type_, value))
        return found

    def env_constant(self, name: Name) -> int | float | bool | None:
        symbol = self.analysis.symbols.get(id(name))
        return symbol.value if isinstance(symbol, EnvSymbol) else None

    # --- a class --------------------------------------------------------------------------------

    def _class(self, declaration: ReactiveClass | Interface) -> p.NodeClass:
        info = self.analysis.classes[declaration.name]
        reactive = declaration if isinstance(declaration, ReactiveClass) else None
        name = declaration.name
        publishers = self._outgoing.publishers(reactive) if reactive else ()
        annotations = {a.name for a in declaration.annotations}
        return p.NodeClass(
            name,
            self._file(name),
            _bases(declaration),
            reactive.queue_length if reactive else 0,
            reactive.abstract if reactive else True,
            reactive is None,
            "Robot" in annotations,
            "Controller" in annotations,
            "Robot" in annotations or self._has_moves(reactive),
            any(name in i.ancestors for i in self.analysis.classes.values()),
            declaration.annotations,
            self._members(reactive),
            self._known(reactive, publishers),
            self._env_of(reactive),
            self._constructors(reactive),
            self._incoming.subscriptions(declaration),
            publishers,
            self._outgoing.self_sends(reactive) if reactive else (),
            self._incoming.functions(reactive),
            self._sensors(reactive) if reactive else (),
            self.topics.states[name],
            not info.is_abstract,
            reactive is not None
            and any(isinstance(n, InstanceOf) for b in bodies(reactive) for n in walk(b)),
        )

    def _file(self, class_name: str) -> str:
        """The stem of the class's files, none of which another class has."""
        stem = snake_case(class_name)
        reserved = _NO_MODULE.get(self.config.target_of(class_name), frozenset())
        candidate, number = stem, 2
        while candidate in reserved or any(candidate + s in self._files for s in _FILES):
            candidate, number = f"{stem}_{number}", number + 1
        self._files |= {candidate + suffix for suffix in _FILES}
        return candidate

    def _has_moves(self, declaration: ReactiveClass | None) -> bool:
        """Whether a body moves and no ancestor that is a robot has a drive already."""
        if declaration is None:
            return False
        return any(
            isinstance(node, Annotation) and node.name == "Move"
            for body in bodies(declaration)
            for node in walk(body)
        )

    def _members(self, declaration: ReactiveClass | None) -> tuple[p.Member, ...]:
        return tuple(
            p.Member(d.name, section.type, f"{declaration.name}.{d.name}", section.annotations)
            for member in (declaration.members if declaration else ())
            if isinstance(member, StateVars)
            for section in member.declarations
            for d in section.declarators
            if declaration is not None
        )

    def _known(
        self, declaration: ReactiveClass | None, publishers: Sequence[p.Publisher]
    ) -> tuple[p.KnownRebec, ...]:
        return tuple(
            p.KnownRebec(
                d.name,
                section.type.name,
                f"{declaration.name}.{d.name}",
                section.annotations,
                bool(section.annotations)
                or (declaration.name, d.name) in self._values
                or not _tell_class(d.name, section.type.name, publishers),
            )
            for member in (declaration.members if declaration else ())
            if isinstance(member, KnownRebecs)
            for section in member.declarations
            for d in section.declarators
            if declaration is not None
        )

    def _env_of(self, declaration: ReactiveClass | None) -> tuple[p.GlobalParameter, ...]:
        if declaration is None:
            return ()
        used = {
            node.name
            for body in bodies(declaration)
            for node in walk(body)
            if isinstance(node, Name) and isinstance(self.analysis.symbols.get(id(node)), EnvSymbol)
        }
        inherited = {
            e.name
            for ancestor in self.analysis.classes[declaration.name].ancestors
            for e in self._env_of(self._reactive(ancestor))
        }
        return tuple(e for name, e in self.env.items() if name in used - inherited)

    def _reactive(self, name: str) -> ReactiveClass | None:
        declaration = self.analysis.classes[name].declaration
        return declaration if isinstance(declaration, ReactiveClass) else None

    def _constructors(self, declaration: ReactiveClass | None) -> tuple[p.ConstructorOf, ...]:
        members = declaration.members if declaration else ()
        found = [m for m in members if isinstance(m, Constructor)]
        return tuple(
            p.ConstructorOf(
                c.parameters,
                tuple(graph_name(a.name) for a in c.parameters),
                c.body,
                c.annotations,
                runs=id(c) in self._running,
            )
            for c in found
        ) or (p.ConstructorOf((), (), None),)

    def _sensors(self, declaration: ReactiveClass) -> tuple[p.Sensor, ...]:
        above = self.analysis.classes[declaration.name].ancestors
        taken = {name for a in above for name in self._sensor_names.get(a, ())}
        found = sensors_of(declaration, self.analysis, self.config, self._types, taken)
        self._sensor_names[declaration.name] = {s.name for s in found}
        return found


def _bases(declaration: ReactiveClass | Interface) -> tuple[str, ...]:
    if isinstance(declaration, Interface):
        return declaration.extends
    extends = (declaration.extends,) if declaration.extends else ()
    return (*extends, *declaration.implements)


def _tell_class(known: str, class_name: str, publishers: Sequence[p.Publisher]) -> bool:
    """Whether publishers to a known rebec tell its class, all by their message types."""
    own = [q for q in publishers if q.known == known]
    return bool(own) and all(message_class(q.message.name, q.key) == class_name for q in own)
