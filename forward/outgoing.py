"""What the classes of a model publish, and what they send to themselves."""

from __future__ import annotations

from rebsync import package as p
from rebsync.forward.sends import Send, ToAny, ToKnown, ToSelf, sends
from rebsync.forward.topics import Signature, Topics, signature
from rebsync.model import MessageServer, ReactiveClass
from rebsync.names import free_name, graph_name
from rebsync.reserved import OWN_TOPICS
from rebsync.static import Analysis


class Outgoing:
    """The sends of the classes of a model."""

    def __init__(self, topics: Topics, analysis: Analysis) -> None:
        self._topics = topics
        self._analysis = analysis
        self._publishers: dict[str, tuple[p.Publisher, ...]] = {}

    def publishers(self, declaration: ReactiveClass) -> tuple[p.Publisher, ...]:
        """Where a class sends messages, but for what its ancestors do; ask for those first."""
        ancestors = self._analysis.classes[declaration.name].ancestors
        above = {_place(q) for a in ancestors for q in self._publishers.get(a, ())}
        found: dict[tuple[str | None, str, str], p.Publisher] = {}
        for send in sends(declaration, self._analysis):
            publisher = self._publisher(declaration.name, send)
            if publisher is not None and _place(publisher) not in above:
                found.setdefault(_place(publisher), publisher)
        self._publishers[declaration.name] = tuple(found.values())
        return self._publishers[declaration.name]

    def _publisher(self, class_name: str, send: Send) -> p.Publisher | None:
        to: str | None
        match send.target:
            case ToSelf():
                return None
            case ToKnown(known):
                to, target = known, self._type_of_known(class_name, known)
                topic = self._topics.called(send.server)
                private = f"{free_name(known, OWN_TOPICS)}/{topic.key}"
            case ToAny(target):
                to = None
                topic = self._topics.of(target, _signature_of(send.server.declaration))
                private = graph_name(target)
        return p.Publisher(
            topic.key, target, to, topic.name, private, topic.message, topic.parameters
        )

    def _type_of_known(self, class_name: str, known: str) -> str:
        symbols = self._analysis.classes[class_name].known
        return next(s.type.name for s in symbols if s.name == known and s.type is not None)

    def self_sends(self, declaration: ReactiveClass) -> tuple[p.SelfSend, ...]:
        """The servers that a class sends to itself."""
        found: dict[str, p.SelfSend] = {}
        for send in sends(declaration, self._analysis):
            if isinstance(send.target, ToSelf):
                topic = self._topics.called(send.server)
                parameters = send.server.declaration.parameters
                found.setdefault(topic.key, p.SelfSend(topic.key, topic.name, parameters))
        return tuple(found.values())


def _place(publisher: p.Publisher) -> tuple[str | None, str, str]:
    """What tells the publishers of a class apart."""
    return publisher.known, "" if publisher.known else publisher.target, publisher.key


def _signature_of(server: MessageServer) -> Signature:
    return signature(server.name, server.parameters)
