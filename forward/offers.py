"""Servers that are offered as services or actions, and what the model replies to their requests.

`@Service(done)` and `@Action(done)` offer a server. Who asks from outside has a name as rebecs
have, which is the request's `sender`; the first message `done` that is sent to that name is the
response, or the result. `@Action(done, seen)` names what goes there before it: the feedback.
"""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.forward.sends import ToAny, sends
from rebsync.forward.topics import ServerTopic, Topics, signature
from rebsync.model import Annotation, MessageServer, Name, ReactiveClass
from rebsync.reserved import OFFERS
from rebsync.static import Analysis


def offer_annotation(server: MessageServer) -> Annotation | None:
    """`@Service(reply)` or `@Action(reply)` of a server."""
    return next((a for a in server.annotations if a.name in OFFERS), None)


def reply_names(annotation: Annotation) -> tuple[str, ...]:
    """The servers that an annotation names: that of the reply, and that of the feedback."""
    return tuple(a.name for a in annotation.arguments or () if isinstance(a, Name))


def replies(
    class_name: str, reply: str, analysis: Analysis, topics: Topics
) -> tuple[ServerTopic, ...]:
    """What the rebecs of a class send as `reply` to `sender` or to whom a variable holds."""
    found: dict[str, ServerTopic] = {}
    for declaration in _relatives(class_name, analysis):
        for send in sends(declaration, analysis):
            if isinstance(send.target, ToAny) and send.server.name == reply:
                of = send.server.declaration
                topic = topics.of(send.target.class_name, signature(of.name, of.parameters))
                found.setdefault(topic.message.name, topic)
    return tuple(found.values())


def _relatives(class_name: str, analysis: Analysis) -> Iterator[ReactiveClass]:
    """A class, those that it descends from, and those that descend from it."""
    above = {class_name, *analysis.classes[class_name].ancestors}
    for name, info in analysis.classes.items():
        declaration = info.declaration
        related = name in above or class_name in info.ancestors
        if related and isinstance(declaration, ReactiveClass):
            yield declaration
