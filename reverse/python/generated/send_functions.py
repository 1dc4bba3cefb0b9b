"""Functions of generated Python that only send, statement by statement."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.generated.messages import OwnMessages
from rebsync.reverse.generated.send_functions import (
    Filled,
    MessageMade,
    MessagePosted,
    MessagePublished,
    SendFunction,
    Signed,
    Step,
    is_kept,
)
from rebsync.reverse.python.generated.filled import PUBLISH, made_of
from rebsync.reverse.python.generated.posts import POST, Post
from rebsync.reverse.python.generated.py_types import (
    call_parts,
    expression_in,
    stored_into,
    type_of,
)
from rebsync.reverse.python.generated.roles import PySends
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_tree import text_of

_SENDER = "self._mailbox.self()"
_TIME = "when"


def odd_in_send(
    function: Scope,
    body: Sequence[Node],
    sends: PySends,
    messages: OwnMessages,
    posts: Mapping[int, Post],
) -> list[Node]:
    """What a function does beside sending what it is given, its statements or the whole of it.

    `body` are those of its statements that do not only tell people something, `posts` what is
    posted, by the ids of the calls.
    """
    names = [p.name for p in function.parameters[1:] if p.name != _TIME]
    message = sends.server.partition(" ")[0] if sends.known != "self" else ""
    given = tuple(names[sends.known is None :])
    fields = messages.fields.get(message)
    wanted = SendFunction(
        given, message, list(fields) if fields is not None else None, message in messages.signed
    )
    types = dict(_types(function))
    odd = wanted.odd(_steps(function, body, sends, types, posts), function.node)
    if odd or _is_as_generated(function, types, [*(fields or {}).values()], given):
        return odd
    return [function.node]


def _is_as_generated(
    function: Scope,
    types: Mapping[str, m.Type | None],
    fields: Sequence[m.Type | None],
    given: Sequence[str],
) -> bool:
    """Whether its parameters are of the types of the fields."""
    if any(p.star for p in function.parameters):
        return False
    is_known = len(fields) == len(given)
    return not is_known or all(map(is_kept, fields, (types.get(name) for name in given)))


def _types(function: Scope) -> Iterator[tuple[str, m.Type | None]]:
    """The parameters with the types that they are said to have."""
    for parameter, node in zip(function.parameters, function.parameter_nodes, strict=False):
        yield parameter.name, type_of(node.child_by_field_name("type"))


def _steps(
    function: Scope,
    body: Sequence[Node],
    sends: PySends,
    types: Mapping[str, m.Type | None],
    posts: Mapping[int, Post],
) -> Iterator[tuple[Node, Step]]:
    names = [p.name for p in function.parameters[1:]]
    message = ""
    for statement in body:
        inner = expression_in(statement)
        called, arguments = call_parts(inner) or ("", [])
        left = stored_into(inner)
        value = inner.child_by_field_name("right") if inner is not None else None
        if inner is None:
            yield statement, None
        elif left.isidentifier() and left not in names and not message:
            message = left
            yield from ((statement, step) for step in _made(value, types))
        elif value is not None and message and left.startswith(f"{message}."):
            yield statement, _filled(left.removeprefix(f"{message}."), value, types)
        elif called == PUBLISH and len(arguments) == 3:
            to, what, when = arguments
            if not message:
                yield from ((statement, step) for step in _made(what, types))
            is_what = not message or text_of(what) == message
            is_to = sends.known is not None or _receiver(to) == names[:1]
            yield statement, MessagePublished(is_to and is_what and text_of(when) == _TIME)
        elif called == POST:
            post = posts.get(inner.id)
            held = post is not None and post.is_held and text_of(post.when) == _TIME
            passed = tuple(map(text_of, post.given)) if post is not None and held else None
            yield statement, MessagePosted(passed)
        else:
            yield statement, None


def _receiver(publisher: Node) -> list[str]:
    """The rebec that `to(self._pubs, to_)` chooses the publisher of."""
    called, arguments = call_parts(publisher) or ("", [])
    return [*map(text_of, arguments[1:])] if called == "to" else []


def _made(value: Node | None, types: Mapping[str, m.Type | None]) -> Iterator[Step]:
    """A message that is made, with what it is filled with at once."""
    type_, fields = made_of(value)
    yield MessageMade(type_)
    for name, each in fields.items():
        yield _filled(name, each, types)


def _filled(name: str, value: Node, types: Mapping[str, m.Type | None]) -> Step:
    """A field that gets a value: an array by its elements, which nothing else is."""
    if name == "sender":
        return Signed() if text_of(value) == _SENDER else None
    called, arguments = call_parts(value) or ("", [])
    is_flat = called == "flatten" and len(arguments) == 1
    plain = text_of(arguments[0] if is_flat else value)
    type_ = types.get(plain)
    is_right = type_ is None or is_flat == bool(type_.dimensions)
    return Filled(name, plain if is_right else "")
