"""What classes of generated code post to their own mailboxes.

A message server is known by the subscription that takes in its messages. One that only the rebec
itself sends to need not have any: then it is known by what is posted.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies.overloads import Served, Signature, plain
from rebsync.reverse.bodies.scope import Sends
from rebsync.reverse.bodies.types.cpp_types import class_name
from rebsync.reverse.generated.annotations import PRIORITIES
from rebsync.reverse.generated.cpp_annotations import set_up_of
from rebsync.reverse.generated.cpp_descriptors import priority_of, server_of, tells_priority
from rebsync.reverse.generated.cpp_names import declared_type, has_mailbox, plain_name
from rebsync.reverse.generated.cpp_roles import Roles, call_in, parameters_of
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of, calls_in, string_of
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import inside, part, squeezed, text_of

_BINDS = frozenset({"std::bind", "boost::bind"})
_NAMES = ("identifier", "type_identifier")
_BINDING = frozenset({"reference_declarator", "structured_binding_declarator", "using_declaration"})
_AROUND = frozenset({"construct", "mailbox", "publishState"})


@dataclass(frozen=True, slots=True)
class CppPost:
    """`mailbox_.post(kServer, when, text(given), [=] { handler(given); })`."""

    server: str
    descriptor: str
    priority: tuple[m.Annotation, ...]
    handler: str
    given: tuple[Node, ...]
    when: Node


def post_of(code: Code, owner: CppClass, function: CppFunction, call: CppCall) -> CppPost | None:
    """What a call in a function posts; None where it posts nothing, or not just that."""
    if call.name != "post" or call.on != "mailbox_" or len(call.arguments) != 4:
        return None
    descriptor, when, told, serve = call.arguments
    cpp, constant, called = function.cpp, text_of(descriptor), call_in(serve)
    server = server_of(code, cpp, constant)
    if server is None or called is None or not tells_priority(code, cpp, constant):
        return None
    handler, given = called
    if not (_holds(owner, serve, given) and tells_arguments(told, given)):
        return None
    own = {f.name for c in code.lineage(owner.name) for f in c.fields}
    names = {constant, "mailbox_", "text"} | ({handler} if not _is_of_object(serve) else set())
    if own & {constant, handler} or _hides(function, names):
        return None
    priority = tuple(priority_of(code, cpp, constant))
    return CppPost(server, constant, priority, handler, tuple(given), when)


def _is_of_object(serve: Node) -> bool:
    """Whether what serves a message is called as `this->handler(...)`: no local hides that."""
    call = next(calls_in(serve.child_by_field_name("body")), None)
    return call is not None and call.target is not None and call.target.type == "this"


def _hides(function: CppFunction, names: Collection[str]) -> bool:
    """Whether a function declares something by one of some names, which means that from there."""
    return any(
        text_of(node) in names and node.parent is not None and _declares(node.parent, node)
        for node in (*inside(part(function.node, "declarator"), *_NAMES), *_named_in(function))
    )


def _named_in(function: CppFunction) -> list[Node]:
    return inside(function.body, *_NAMES) if function.body is not None else []


def _declares(above: Node, name: Node) -> bool:
    """Whether a name stands where something gets it, not where it is used."""
    if above.type in ("function_declarator", "qualified_identifier"):
        return False  # that of the function itself, or of what another has
    fields = (above.child_by_field_name(field) for field in ("declarator", "name", "left"))
    is_stored = above.type in ("assignment_expression", "binary_expression")
    return above.type in _BINDING or (name in fields and not is_stored)


def _holds(owner: CppClass, serve: Node, given: list[Node]) -> bool:
    """Whether what serves a message has its arguments as they were when it was posted."""
    bound = call_of(serve)
    if bound is not None:
        of = squeezed(bound.arguments[0]).removeprefix("&").rpartition("::")[0]
        is_own = of.rpartition("::")[2] == owner.name and bound.name in _BINDS
        return is_own and text_of(bound.arguments[1]) == "this"
    captures = part(serve, "captures")
    own = [*inside(captures, "lambda_capture_initializer"), *parameters_of(serve)]
    text = text_of(captures)
    return not own and "*" not in text and not (given and "&" in text)


def tells_arguments(told: Node, given: list[Node]) -> bool:
    """Whether a text is that of some arguments, and is made by nothing else."""
    if not given:
        return string_of(told) == ""
    call = call_of(told)
    if call is None or call.target is not None or call.name.rpartition("::")[2] != "text":
        return False
    return [squeezed(a) for a in call.arguments] == [squeezed(a) for a in given]


def own_post(
    code: Code,
    owner: CppClass,
    all_roles: Mapping[str, Roles],
    function: CppFunction,
    call: CppCall,
) -> CppPost | None:
    """A post to a server of a class, by the function that serves it, with its priority."""
    post = post_of(code, owner, function, call)
    if post is None or _handlers(code, owner, all_roles).get(post.handler) != post.server:
        return None
    shown = [
        tuple(a for a in set_up if a.name in PRIORITIES)
        for of in _serving(code, owner, post, function.types[:-1])
        if (set_up := set_up_of(code, all_roles, owner, of, post.server)) is not None
    ]
    return post if shown and all(each == post.priority for each in shown) else None


def _handlers(code: Code, owner: CppClass, all_roles: Mapping[str, Roles]) -> dict[str, str]:
    """The servers of a class by the functions that serve them, those above included."""
    lineage = [all_roles[c.name].handlers for c in code.lineage(owner.name)]
    return {f: s for handlers in reversed(lineage) for f, s in handlers.items()}


def _serving(
    code: Code, owner: CppClass, post: CppPost, types: tuple[str, ...] = ()
) -> list[CppFunction]:
    """The functions that may serve what is posted: of overloads that of these types, if any."""
    every = (f for c in code.lineage(owner.name) for f in c.functions if f.name == post.handler)
    found = [f for f in every if len(f.parameters) == len(post.given)]
    return [f for f in found if f.types == types] or found


def rivals_of(
    code: Code,
    owner: CppClass,
    all_roles: Mapping[str, Roles],
    served: Served,
    server: str,
    types: Signature,
) -> frozenset[Signature]:
    """What other servers of this name take, be they known by subscriptions or by what is posted."""
    handlers = _handlers(code, owner, all_roles)
    functions = (f for c in code.lineage(owner.name) for f in c.functions)
    own = [f for f in functions if handlers.get(f.name) == server]
    posted = {plain([declared_type(code, p.type) for p in f.parameters]) for f in own}
    others = frozenset(of for of in posted if len(of) == len(types)) - {types}
    return served.rivals_in(class_name(owner.name), server, types) | others


def posts_in_bodies(
    code: Code, owner: CppClass, all_roles: Mapping[str, Roles], served: Served
) -> Iterator[tuple[int, tuple[Sends, tuple[Node, ...]]]]:
    """The posts in functions of a class, by the ids of their nodes: the sends, and their arguments.

    Not those to one of several functions that only types tell apart.
    """
    for function in code.functions_of(owner):
        for call in code.calls_of(function):
            post = own_post(code, owner, all_roles, function, call)
            serving = _serving(code, owner, post) if post is not None else []
            if post is None or len({f.types for f in serving}) != 1:
                continue
            types = plain([declared_type(code, p.type) for p in serving[0].parameters])
            rivals = rivals_of(code, owner, all_roles, served, post.server, types)
            sends = Sends("self", post.server, len(post.given), types=types, rivals=rivals)
            yield call.node.id, (sends, (*post.given, post.when))


# --- servers that only the rebec itself sends to ------------------------------------------------


def learn_servers(
    code: Code, owner: CppClass, all_roles: Mapping[str, Roles], types: frozenset[str]
) -> None:
    """Adds the servers of a class that are known by what it posts alone.

    `types` are the names of classes and messages, which functions give way to.
    """
    for function in code.functions_of(owner) if has_mailbox(code, owner) else ():
        for call in code.calls_of(function):
            post = post_of(code, owner, function, call)
            above = _declaring(code, owner, post, types) if post is not None else None
            if post is None or above is None:
                continue
            all_roles[owner.name].constants.add(post.descriptor)
            if _is_free(code, owner, all_roles, post):
                all_roles[above.name].handlers[post.handler] = post.server
                all_roles[above.name].posted.add(post.server)
            key = post.server, len(post.given)
            lineage = (all_roles[c.name] for c in code.lineage(owner.name))
            if all(key not in roles.annotations for roles in lineage):
                all_roles[above.name].annotations[key] = [post.priority]


def _declaring(
    code: Code, owner: CppClass, post: CppPost, types: frozenset[str]
) -> CppClass | None:
    """The topmost class with the function that serves a post; None for what can be no server."""
    found = [
        (c, f) for c in code.lineage(owner.name) for f in c.functions if f.name == post.handler
    ]
    may_serve = all(
        f.result is not None
        and text_of(f.result) == "void"
        and f.name not in _AROUND
        and f.types[-1:] != ("When",)
        and plain_name(f, types) == post.server
        for _, f in found
    )
    return found[-1][0] if found and may_serve else None


def _is_free(code: Code, owner: CppClass, all_roles: Mapping[str, Roles], post: CppPost) -> bool:
    """Whether nothing else serves the messages of a server, nor this function those of others."""
    lineage = [all_roles[c.name] for c in code.lineage(owner.name)]
    if any(post.handler in roles.shims for roles in lineage):
        return False
    handlers = _handlers(code, owner, all_roles)
    served = {*handlers.values(), *(t.server for roles in lineage for t in roles.taken)}
    return post.handler not in handlers and post.server not in served
