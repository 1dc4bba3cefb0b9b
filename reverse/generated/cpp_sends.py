"""Functions of generated code that only send: they fill a message from their arguments.

Whatever else a function does makes it a function of the model, whose body shows what it sends.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial

from tree_sitter import Node

from rebsync.model import Type
from rebsync.names import uncarry
from rebsync.reserved import RUNTIME_CLASSES, RUNTIME_TOPICS
from rebsync.reverse.bodies.cpp_mailbox import AT_ONCE
from rebsync.reverse.bodies.overloads import Served, Signature, plain
from rebsync.reverse.bodies.scope import Sends
from rebsync.reverse.bodies.types.cpp_types import class_name
from rebsync.reverse.generated.cpp_descriptors import server_of
from rebsync.reverse.generated.cpp_idle import working
from rebsync.reverse.generated.cpp_names import declared_type
from rebsync.reverse.generated.cpp_posts import CppPost, own_post, rivals_of
from rebsync.reverse.generated.cpp_roles import Advertised, Roles
from rebsync.reverse.generated.cpp_shims import Fields
from rebsync.reverse.generated.send_functions import (
    Filled,
    MessageMade,
    MessagePosted,
    MessagePublished,
    SendFunction,
    Signed,
    Step,
    in_order_of_fields,
    is_kept,
)
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of, calls_in
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import (
    Cpp,
    default_of,
    last_name,
    named,
    part,
    squeezed,
    text_of,
)


def add_sends(
    code: Code,
    owner: CppClass,
    all_roles: dict[str, Roles],
    fields: Fields,
    served: Served,
    signed: frozenset[str],
) -> None:
    """Reads which functions of a class send what to whom, and which do more than that.

    `fields` are those of each message type, in their order, `served` what all classes serve,
    `signed` those that have a field for who sends them.
    """
    lineage = [all_roles[c.name] for c in code.lineage(owner.name)]
    publishers = {n: p for roles in reversed(lineage) for n, p in roles.publishers.items()}
    rivals = partial(rivals_of, code, owner, all_roles, served)
    servers = served.servers
    taken = (t for roles in all_roles.values() for t in roles.taken)
    signed = signed.union(t.type for t in taken if t.tells_sender)
    roles = all_roles[owner.name]
    posted = {server for each in all_roles.values() for server in each.posted}
    sending = [f for f in code.functions_of(owner) if _takes_times(f)]
    for function in sending:
        for call in code.calls_of(function):
            sends = _sent(code, function, call, publishers, servers)
            if sends is None:
                continue
            message = publishers[_publisher(call)].message if call.name == "publish" else ""
            post = partial(own_post, code, owner, all_roles, function)
            assert function.body is not None
            steps, known = [*_steps(function, post)], fields.get(message)
            plain = tuple(p.name for p in function.parameters[sends.known is None : -1])
            given = in_order_of_fields(plain, known or (), steps)
            wanted = SendFunction(
                given, message, None if known is None else [*known], message in signed
            )
            odd = wanted.odd(steps, function.body)
            odd = odd or [*_misfits(code, function, given, known or {})]
            odd = odd or [*_rival(sending, function)]
            if given != plain:
                sends = replace(sends, order=tuple(map(plain.index, given)))
            if message and message not in served.servers and sends.server in posted:
                odd.append(call.node)
                roles.lost.add(call.node.id)
            if odd:
                roles.odd_sends[function.name] = odd
            else:
                told = _told(code, function, call, publishers, sends, served, rivals)
                roles.sends[function.name] = replace(told, usual=_usual(owner, function))
            break


def families_of(code: Code, all_roles: Mapping[str, Roles]) -> dict[str, dict[str, str]]:
    """By class the servers, those above included, by the types of their messages."""
    found = {}
    for name in code.classes:
        if name in RUNTIME_CLASSES:
            continue  # a class of the model may be called alike
        lines = [all_roles[above.name].messages for above in reversed(code.lineage(name))]
        found[class_name(name)] = {t: s for line in lines for t, s in line.items()}
    return found


def _rival(sending: Sequence[CppFunction], function: CppFunction) -> Iterator[Node]:
    """The function, if only the types of what is sent tell it from another that sends."""
    same = (f.types for f in sending if f.name == function.name)
    if any(len(t) == len(function.types) and t != function.types for t in same):
        yield part(function.node, "declarator")


def _misfits(
    code: Code, function: CppFunction, given: Sequence[str], fields: Mapping[str, Type | None]
) -> Iterator[Node]:
    """The parameters that are not of the types of the message's fields, which would be cut."""
    named_ = {p.name: p for p in function.parameters}
    for type_, name in zip(fields.values(), given[-len(fields) :], strict=False):
        if not is_kept(type_, declared_type(code, named_[name].type)):
            yield named_[name].node


def _told(
    code: Code,
    function: CppFunction,
    call: CppCall,
    publishers: Mapping[str, Advertised],
    sends: Sends,
    served: Served,
    rivals_in: Callable[[str, Signature], frozenset[Signature]],
) -> Sends:
    """A send with the types of what it sends, and those that overloads take."""
    if sends.known == "self":
        types = plain([declared_type(code, p.type) for p in function.parameters[:-1]])
        rivals = rivals_in(sends.server, types)
    else:
        message = publishers[_publisher(call)].message
        types = plain(served.fields.get(message, ()))
        rivals = served.rivals(message, types) if len(types) == sends.arguments else frozenset()
    return replace(sends, types=types, rivals=rivals)


def _usual(owner: CppClass, function: CppFunction) -> tuple[Cpp, Node] | None:
    """The time at which a function sends where its caller says none; None for at once."""
    for declared in (function, *(f for f in owner.functions if f.types == function.types)):
        if declared.name == function.name:
            default = default_of(declared.parameters[-1].node)
            if default is not None and squeezed(default) not in AT_ONCE:
                return declared.cpp, default
    return None


def _takes_times(function: CppFunction) -> bool:
    """Whether the last parameter says when what is sent arrives and expires."""
    return bool(function.types) and function.types[-1] == "When"


def _sent(
    code: Code,
    function: CppFunction,
    call: CppCall,
    publishers: dict[str, Advertised],
    servers: Mapping[str, str],
) -> Sends | None:
    if call.name == "post" and len(call.arguments) == 4 and call.on == "mailbox_":
        server = server_of(code, function.cpp, text_of(call.arguments[0]))
        return Sends("self", server, len(function.parameters) - 1) if server else None
    if call.name != "publish" or call.on != "mailbox_" or len(call.arguments) != 3:
        return None
    publisher = publishers.get(_publisher(call))
    others = 1 if _chosen(call) is None else 2
    if publisher is None:
        return None
    server = servers.get(publisher.message) or uncarry(publisher.key, RUNTIME_TOPICS)
    return Sends(publisher.known, server, len(function.parameters) - others)


def _chosen(call: CppCall) -> CppCall | None:
    """`to(publishers, to_)`, if that is where a call publishes."""
    chosen = call_of(call.arguments[0])
    return chosen if chosen is not None and chosen.name == "to" and chosen.arguments else None


def _publisher(call: CppCall) -> str:
    """The member that a call publishes with."""
    chosen = _chosen(call)
    where = call.arguments[0] if chosen is None else chosen.arguments[0]
    return text_of(where).removeprefix("this->")


def _steps(
    function: CppFunction, post: Callable[[CppCall], CppPost | None]
) -> Iterator[tuple[Node, Step]]:
    """What the statements of a function do; `post` tells what a call posts."""
    *names, when = [p.name for p in function.parameters]
    message = ""
    for statement in working(function.body):
        call = _called(statement)
        if statement.type == "declaration" and next(calls_in(statement), None) is None:
            message = _declared(statement)
            yield statement, MessageMade(last_name(part(statement, "type")))
        elif call is not None and call.name == "post":
            posted = post(call) if _at(call, 1, when) else None
            given = tuple(map(text_of, posted.given)) if posted is not None else None
            yield statement, MessagePosted(given)
        elif call is not None and call.name == "publish":
            to = call_of(call.arguments[0])
            is_to = to is None or (bool(names) and _at(to, 1, names[0]))
            yield (
                statement,
                MessagePublished(is_to and _at(call, 1, message) and _at(call, 2, when)),
            )
        elif message and squeezed(statement) == f"{message}.sender=mailbox_.self();":
            yield statement, Signed()
        else:
            field, value = _stored(statement)
            is_own = bool(message) and field.startswith(f"{message}.")
            yield statement, Filled(field.removeprefix(f"{message}."), value) if is_own else None


def _called(statement: Node) -> CppCall | None:
    """The call that a statement is."""
    inner = named(statement)
    plain = statement.type == "expression_statement" and len(inner) == 1
    return call_of(inner[0]) if plain else None


def _declared(declaration: Node) -> str:
    declarator = part(declaration, "declarator")
    inner = declarator.child_by_field_name("declarator")
    return text_of(inner if inner is not None else declarator)


def _at(call: CppCall, index: int, when: str) -> bool:
    """Whether what is sent arrives and expires when the caller says."""
    return len(call.arguments) > index and text_of(call.arguments[index]) == when


def _stored(statement: Node) -> tuple[str, str]:
    """The place and the value of `msg_.field = parameter;` or `flatten(parameter, msg_.field);`."""
    inner = named(statement)
    if statement.type != "expression_statement" or len(inner) != 1:
        return "", ""
    (expression,) = inner
    call = call_of(expression)
    if expression.type == "assignment_expression" and text_of(part(expression, "operator")) == "=":
        target, value = part(expression, "left"), part(expression, "right")
    elif call is not None and call.name == "flatten" and len(call.arguments) == 2:
        value, target = call.arguments
    else:
        return "", ""
    return squeezed(target), text_of(value)
