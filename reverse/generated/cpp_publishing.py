"""Publishers of generated code, as bodies use them that somebody has changed."""

from __future__ import annotations

from collections.abc import Mapping

from rebsync.model import Type
from rebsync.names import uncarry
from rebsync.reserved import RUNTIME_TOPICS
from rebsync.reverse.bodies.overloads import Served, plain
from rebsync.reverse.bodies.scope import Member, Outside, Publishes, Target, Variable
from rebsync.reverse.generated.cpp_hand import acts
from rebsync.reverse.generated.cpp_names import declared_type, runtime_of, variable_name
from rebsync.reverse.generated.cpp_roles import Advertised, Roles
from rebsync.reverse.syntax.cpp_index import Code, CppField
from rebsync.reverse.syntax.cpp_tree import text_of


def meaning_of(
    member: CppField,
    code: Code,
    roles: Roles,
    served: Served,
    messages: Mapping[str, Mapping[str, Type | None]],
) -> Member:
    """What a member of a class stands for in bodies."""
    if (runtime := runtime_of(member)) is not None:
        return runtime
    if (advertised := roles.publishers.get(member.name)) is not None:
        return publisher(advertised, served, messages)
    if declared_type(code, member.type) is None or member.name in roles.silent:
        return Outside(reaches=acts(text_of(member.type)))
    return Variable(variable_name(roles, member), declared_type(code, member.type))


def publisher(
    advertised: Advertised,
    served: Served,
    messages: Mapping[str, Mapping[str, Type | None]],
) -> Publishes | Outside:
    """What a publisher sends, and to whom; one to all rebecs of a class is used by sends only.

    `served` is what all classes serve.
    """
    if advertised.known is None:
        return Outside(reaches=True)
    message = advertised.message
    server = served.servers.get(message) or uncarry(advertised.key, RUNTIME_TOPICS)
    full = next((t for t in messages if t.rpartition("/")[2] == message), "")
    fields = messages.get(full, {})
    rivals = served.rivals(message, plain([*fields.values()]))
    target = Target(advertised.known, server, tuple(fields), rivals)
    return Publishes((target,), full, timed=True)
