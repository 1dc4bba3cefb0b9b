"""The view: a Timed Rebeca model as a ROS package that knows no dialect."""

from __future__ import annotations

from rebsync import package as p
from rebsync.config import Config
from rebsync.forward.instances import Instances
from rebsync.forward.sends import Send, ToAny, ToKnown, ToSelf, bodies, sends
from rebsync.forward.sensors import sensors_of
from rebsync.forward.topics import (
    RUNTIME_CLASSES,
    Signature,
    Topics,
    declared_servers,
    signature,
)
from rebsync.forward.values import env_value
from rebsync.model import (
    Annotation,
    Constructor,
    Env,
    InstanceOf,
    Interface,
    KnownRebecs,
    MessageServer,
    Method,
    Model,
    Name,
    ReactiveClass,
    StateVars,
    walk,
)
from rebsync.names import carry, graph_name, snake_case, unique
from rebsync.static import Analysis
from rebsync.static.constants import constant
from rebsync.static.symbols import EnvSymbol

RESERVED_GLOBALS = frozenset(
    {
        "drive",
        "mailbox",
        "rosdistro",
        "roslaunch",
        "rosversion",
        "run_id",
        "startup",
        "use_sim_time",
    }
)


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
        self._files: set[str] = set()
        self._types = {m.name for m in self.topics.messages} | RUNTIME_CLASSES
        self._types |= {s.name for s in self.topics.states.values()}
        self._types |= set(self.topics.class_types.values())
        self._publishers: dict[str, tuple[p.Publisher, ...]] = {}

    def package(self, name: str) -> p.Package:
        config = self.config
        classes = tuple(self._class(c) for c in self._ancestors_first())
        instances = Instances(self.model, self.analysis, self.topics, classes)
        return p.Package(
            name,
            config.version,
            config.description or f"Generated from the Timed Rebeca model {name}.",
            config.license or "Proprietary",
            tuple(p.Maintainer(m.name, m.email) for m in config.maintainers)
            or (p.Maintainer("maintainer", "maintainer@example.org"),),
            p.Settings(
                config.time_unit,
                config.slack,
                config.seed,
                config.cell_size,
                config.drive,
                config.heading,
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
        for head in self.model.heads:
            if isinstance(head, Env):
                type_ = head.declaration.type
                for declarator in head.declaration.declarators:
                    key = carry(declarator.name, RESERVED_GLOBALS)
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
        publishers = self._publishers_of(reactive) if reactive else ()
        self._publishers[name] = publishers
        annotations = {a.name for a in declaration.annotations}
        return p.NodeClass(
            name,
            unique(snake_case(name) or "node", self._files),
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
            self._known(reactive),
            self._env_of(reactive),
            self._constructors(reactive),
            self._subscriptions(declaration),
            publishers,
            self._self_sends(reactive) if reactive else (),
            self._functions(reactive),
            sensors_of(reactive, self.analysis, self.config, self._types) if reactive else (),
            self.topics.states[name],
            not info.is_abstract,
            reactive is not None
            and any(isinstance(n, InstanceOf) for b in bodies(reactive) for n in walk(b)),
        )

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
            p.Member(d.name, section.type, f"{declaration.name}.{d.name}")
            for member in (declaration.members if declaration else ())
            if isinstance(member, StateVars)
            for section in member.declarations
            for d in section.declarators
            if declaration is not None
        )

    def _known(self, declaration: ReactiveClass | None) -> tuple[p.KnownRebec, ...]:
        return tuple(
            p.KnownRebec(d.name, section.type.name, f"{declaration.name}.{d.name}")
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
                c.parameters, tuple(graph_name(a.name) for a in c.parameters), c.body, c.annotations
            )
            for c in found
        ) or (p.ConstructorOf((), (), None),)

    # --- servers and methods --------------------------------------------------------------------

    def _subscriptions(self, declaration: ReactiveClass | Interface) -> tuple[p.Subscription, ...]:
        """The servers declared here, and those of interfaces that this class is first to have."""
        name = declaration.name
        found = [self._subscription(name, s) for s in declared_servers(declaration)]
        if isinstance(declaration, ReactiveClass):
            declared = {signature(s.name, s.parameters) for s in declared_servers(declaration)}
            for server in self.analysis.classes[name].servers:
                wanted = signature(server.name, server.declaration.parameters)
                first = self.topics.subscriber(name, wanted) == name
                if wanted not in declared and first and server.owner != name:
                    found.append(self._subscription(name, server.declaration))
        return tuple(found)

    def _subscription(self, class_name: str, server: MessageServer) -> p.Subscription:
        wanted = signature(server.name, server.parameters)
        topic = self.topics.of(class_name, wanted)
        subscriber = self.topics.subscriber(class_name, wanted)
        info = self.analysis.classes[class_name]
        return p.Subscription(
            server.name,
            topic.key,
            f"port/{topic.key}" if topic.port else topic.key,
            self.analysis.classes[subscriber].annotated("Controller"),
            topic.message,
            server.parameters,
            server.body,
            f"{class_name}.{server.name}",
            server.annotations,
            priority_of(server.annotations),
            inherited=subscriber != class_name or self._declared_above(class_name, wanted),
            overridden=info.is_abstract or self._is_redeclared(class_name, wanted),
        )

    def _declared_above(self, class_name: str, wanted: Signature) -> bool:
        """Whether a reactive class above this one has made the subscription already."""
        return self.topics.subscriber(class_name, wanted) != class_name

    def _is_redeclared(self, class_name: str, wanted: Signature) -> bool:
        return any(
            class_name in info.ancestors
            and wanted
            in {signature(s.name, s.parameters) for s in declared_servers(info.declaration)}
            for info in self.analysis.classes.values()
        )

    def _functions(self, declaration: ReactiveClass | None) -> tuple[p.Function, ...]:
        members = declaration.members if declaration else ()
        return tuple(self._function(declaration, m) for m in members if isinstance(m, Method))

    def _function(self, declaration: ReactiveClass | None, method: Method) -> p.Function:
        assert declaration is not None
        wanted = signature(method.name, method.parameters)
        return p.Function(
            method.name,
            method.type,
            method.parameters,
            method.body,
            f"{declaration.name}.{method.name}",
            overridden=any(
                declaration.name in i.ancestors and wanted in _own_methods(i.declaration)
                for i in self.analysis.classes.values()
            ),
            overrides=any(
                wanted in _own_methods(self.analysis.classes[a].declaration)
                for a in self.analysis.classes[declaration.name].ancestors
            ),
            annotations=method.annotations,
        )

    # --- sends ----------------------------------------------------------------------------------

    def _publishers_of(self, declaration: ReactiveClass) -> tuple[p.Publisher, ...]:
        ancestors = self.analysis.classes[declaration.name].ancestors
        above = {_place(q) for a in ancestors for q in self._publishers.get(a, ())}
        found: dict[tuple[str | None, str, str], p.Publisher] = {}
        for send in sends(declaration, self.analysis):
            publisher = self._publisher(declaration.name, send)
            if publisher is not None and _place(publisher) not in above:
                found.setdefault(_place(publisher), publisher)
        return tuple(found.values())

    def _publisher(self, class_name: str, send: Send) -> p.Publisher | None:
        to: str | None
        match send.target:
            case ToSelf():
                return None
            case ToKnown(known):
                to, target = known, self._type_of_known(class_name, known)
                topic = self.topics.called(send.server)
                private = f"{graph_name(known)}/{topic.key}"
            case ToAny(target):
                to = None
                topic = self.topics.of(target, _signature_of(send.server.declaration))
                private = graph_name(target)
        return p.Publisher(
            topic.key, target, to, topic.name, private, topic.message, topic.parameters
        )

    def _type_of_known(self, class_name: str, known: str) -> str:
        symbols = self.analysis.classes[class_name].known
        return next(s.type.name for s in symbols if s.name == known and s.type is not None)

    def _self_sends(self, declaration: ReactiveClass) -> tuple[p.SelfSend, ...]:
        found: dict[str, p.SelfSend] = {}
        for send in sends(declaration, self.analysis):
            if isinstance(send.target, ToSelf):
                topic = self.topics.called(send.server)
                parameters = send.server.declaration.parameters
                found.setdefault(topic.key, p.SelfSend(topic.key, topic.name, parameters))
        return tuple(found.values())


def _bases(declaration: ReactiveClass | Interface) -> tuple[str, ...]:
    if isinstance(declaration, Interface):
        return declaration.extends
    extends = (declaration.extends,) if declaration.extends else ()
    return (*extends, *declaration.implements)


def _own_methods(declaration: ReactiveClass | Interface) -> set[Signature]:
    if isinstance(declaration, Interface):
        return set()
    methods = (m for m in declaration.members if isinstance(m, Method))
    return {signature(m.name, m.parameters) for m in methods}


def _place(publisher: p.Publisher) -> tuple[str | None, str, str]:
    """What tells the publishers of a class apart."""
    return publisher.known, "" if publisher.known else publisher.target, publisher.key


def _signature_of(server: MessageServer) -> Signature:
    return signature(server.name, server.parameters)


def priority_of(annotations: tuple[Annotation, ...]) -> int | None:
    """The number of `@priority` or `@globalPriority`, if there is one."""
    for annotation in annotations:
        if annotation.name in ("priority", "globalPriority") and annotation.arguments:
            value = constant(annotation.arguments[0])
            if isinstance(value, int):
                return value
    return None
