"""Publishers of generated code, as bodies use them that somebody has changed."""

from __future__ import annotations

from collections.abc import Mapping

from rebsync.model import Type
from rebsync.names import uncarry
from rebsync.reserved import RUNTIME_TOPICS
from rebsync.reverse.bodies.scope import Outside, Publishes, Target
from rebsync.reverse.generated.ros1_roles import Advertised


def publisher(
    advertised: Advertised,
    servers: Mapping[str, str],
    messages: Mapping[str, Mapping[str, Type | None]],
) -> Publishes | Outside:
    """What a publisher sends, and to whom; one to all rebecs of a class is used by sends only.

    `servers` are those of all classes by the types of their messages.
    """
    if advertised.known is None:
        return Outside(reaches=True)
    server = servers.get(advertised.message) or uncarry(advertised.key, RUNTIME_TOPICS)
    full = next((t for t in messages if t.rpartition("/")[2] == advertised.message), "")
    fields = tuple(messages.get(full, ()))
    return Publishes((Target(advertised.known, server, fields),), full, timed=True)
