"""What the classes of a model serve and call: message servers and local methods."""

from __future__ import annotations

from rebsync import package as p
from rebsync.forward.offers import offer_annotation, replies, reply_names
from rebsync.forward.topics import ServerTopic, Signature, Topics, declared_servers, signature
from rebsync.model import Annotation, Interface, MessageServer, Method, ReactiveClass
from rebsync.static import Analysis
from rebsync.static.constants import constant


class Incoming:
    """The servers and methods of the classes of a model."""

    def __init__(self, topics: Topics, analysis: Analysis) -> None:
        self._topics = topics
        self._analysis = analysis

    def subscriptions(self, declaration: ReactiveClass | Interface) -> tuple[p.Subscription, ...]:
        """The servers declared here, and those of interfaces that this class is first to have."""
        name = declaration.name
        found = [self._subscription(name, s) for s in declared_servers(declaration)]
        if isinstance(declaration, ReactiveClass):
            declared = {signature(s.name, s.parameters) for s in declared_servers(declaration)}
            for server in self._analysis.classes[name].servers:
                wanted = signature(server.name, server.declaration.parameters)
                first = self._topics.subscriber(name, wanted) == name
                if wanted not in declared and first and server.owner != name:
                    found.append(self._subscription(name, server.declaration))
        return tuple(found)

    def _subscription(self, class_name: str, server: MessageServer) -> p.Subscription:
        wanted = signature(server.name, server.parameters)
        topic = self._topics.of(class_name, wanted)
        subscriber = self._topics.subscriber(class_name, wanted)
        info = self._analysis.classes[class_name]
        return p.Subscription(
            server.name,
            topic.key,
            f"port/{topic.key}" if topic.port else topic.key,
            self._analysis.classes[subscriber].annotated("Controller"),
            topic.message,
            server.parameters,
            server.body,
            f"{class_name}.{server.name}",
            server.annotations,
            priority_of(server.annotations),
            inherited=subscriber != class_name or self._declared_above(class_name, wanted),
            overridden=info.is_abstract or self._is_redeclared(class_name, wanted),
            offer=self._offer(class_name, server, topic),
        )

    def _offer(self, class_name: str, server: MessageServer, topic: ServerTopic) -> p.Offer | None:
        annotation = offer_annotation(server)
        if annotation is None or topic.offer is None:
            return None
        reply, *feedback = (
            (name, sent.message)
            for name in reply_names(annotation)
            for sent in replies(class_name, name, self._analysis, self._topics)
        )
        is_action = annotation.name == "Action"
        more = feedback[0] if feedback else (None, None)
        return p.Offer(topic.offer, is_action, topic.message, *reply, *more)

    def _declared_above(self, class_name: str, wanted: Signature) -> bool:
        """Whether a reactive class above this one has made the subscription already."""
        return self._topics.subscriber(class_name, wanted) != class_name

    def _is_redeclared(self, class_name: str, wanted: Signature) -> bool:
        return any(
            class_name in info.ancestors
            and wanted
            in {signature(s.name, s.parameters) for s in declared_servers(info.declaration)}
            for info in self._analysis.classes.values()
        )

    def functions(self, declaration: ReactiveClass | None) -> tuple[p.Function, ...]:
        """The local methods of a class."""
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
                for i in self._analysis.classes.values()
            ),
            overrides=any(
                wanted in _own_methods(self._analysis.classes[a].declaration)
                for a in self._analysis.classes[declaration.name].ancestors
            ),
            annotations=method.annotations,
        )


def _own_methods(declaration: ReactiveClass | Interface) -> set[Signature]:
    if isinstance(declaration, Interface):
        return set()
    methods = (m for m in declaration.members if isinstance(m, Method))
    return {signature(m.name, m.parameters) for m in methods}


def priority_of(annotations: tuple[Annotation, ...]) -> int | None:
    """The number of `@priority` or `@globalPriority`, if there is one."""
    for annotation in annotations:
        if annotation.name in ("priority", "globalPriority") and annotation.arguments:
            value = constant(annotation.arguments[0])
            if isinstance(value, int):
                return value
    return None
