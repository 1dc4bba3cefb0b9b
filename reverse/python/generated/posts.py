"""What classes of generated Python post to their own mailboxes, as `cpp_posts` has it for C++."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.generated.annotations import PRIORITIES, best_priority
from rebsync.reverse.python.generated.descriptors import servers_of
from rebsync.reverse.python.generated.function_names import plain_name
from rebsync.reverse.python.generated.py_types import call_parts, passed_on, string_value
from rebsync.reverse.python.generated.roles import PyRoles
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_tree import field, named, text_of

POST = "self._mailbox.post"
_LITERALS = frozenset({"integer", "float", "true", "false"})  # the same whenever it is evaluated
_EARLY = _LITERALS | {"identifier", "attribute"}
_LOOPS = frozenset({"for_statement", "while_statement"})
_INNER = frozenset({"function_definition", "lambda"})

_NONE: Mapping[str, Node] = {}

RolesOf = Callable[[Scope], PyRoles]


@dataclass(frozen=True, slots=True)
class Post:
    """`self._mailbox.post(_SERVER, when, text(given), lambda: self.handler(given))`.

    `is_held` says that the arguments are what they were when it was posted.
    """

    server: str
    priority: tuple[m.Annotation, ...]
    handler: str
    given: tuple[Node, ...]
    when: Node
    is_held: bool


def posts_of(function: Scope) -> Iterator[tuple[Node, Post]]:
    """What a function posts: the calls that post a message, and nothing else."""
    if POST not in text_of(function.node):
        return
    servers = {n: s for n, s in servers_of(function.module).items() if is_told(function.module, n)}
    for call in _calls_in(function.node):
        post = _post(function, call, servers)
        if post is not None:
            yield call, post


def _calls_in(node: Node) -> Iterator[Node]:
    """The calls that post, but for those in functions within."""
    for child in node.children:
        if child.type == "call" and text_of(field(child, "function")) == POST:
            yield child
        if child.type not in _INNER:
            yield from _calls_in(child)


def is_told(module: Scope, descriptor: str) -> bool:
    """Whether a descriptor is made once, with a priority that the model can have, or none."""
    bindings = module.names.get(descriptor, [])
    if descriptor not in servers_of(module):
        return False
    _, arguments = call_parts(bindings[0].value) or ("", [])
    _, annotations = servers_of(module)[descriptor]
    return len(bindings) == 1 and len(arguments) == 1 + len(annotations) < 3


def _post(
    function: Scope, call: Node, servers: Mapping[str, tuple[str, tuple[m.Annotation, ...]]]
) -> Post | None:
    _, arguments = call_parts(call) or ("", [])
    if len(arguments) != 4 or text_of(arguments[0]) not in servers:
        return None
    _, when, told, serve = arguments
    server, priority = servers[text_of(arguments[0])]
    handler, given = passed_on(serve) or ("", [])
    own = serve.child_by_field_name("parameters") if serve.type == "lambda" else None
    if not handler.startswith("self.") or own is not None or not tells_arguments(told, given):
        return None
    held = _EARLY if serve.type != "lambda" else _LITERALS
    is_held = all(v.type in held or _is_kept(function, call, v) for v in given)
    return Post(server, priority, handler.removeprefix("self."), tuple(given), when, is_held)


def tells_arguments(told: Node, given: Sequence[Node], taken: Mapping[str, Node] = _NONE) -> bool:
    """Whether a text is that of some arguments, and is made by nothing else.

    `taken` are the values of names that stand for one value each.
    """
    if not given:
        return string_value(told) == ""
    called, arguments = call_parts(told) or ("", [])
    texts = ([text_of(taken.get(text_of(n), n)) for n in each] for each in (arguments, given))
    return called == "text" and next(texts) == next(texts)


def _is_kept(function: Scope, call: Node, value: Node) -> bool:
    """Whether a name stands for one value as long as a call of the function may be remembered."""
    name = text_of(value)
    if value.type != "identifier" or len(function.names.get(name, ())) != 1:
        return False
    if any(name == p.name for p in function.parameters):
        return True
    return all(n.type not in _LOOPS for n in ancestors(call, lambda n: n == function.node))


def own_posts(
    line: Sequence[Scope], roles: RolesOf, function: Scope
) -> Iterator[tuple[Node, Post]]:
    """The posts of a function to servers of its class, by what serves them, with their priority.

    `line` are the class and those above it, nearest first.
    """
    handlers = _handlers(line, roles)
    for call, post in posts_of(function):
        shown = (roles(c).shown.get(post.handler) for c in line)
        annotations = next((a for a in shown if a is not None), None)
        if handlers.get(post.handler) != post.server or annotations is None:
            continue
        if tuple(a for a in annotations if a.name in PRIORITIES) == post.priority:
            yield call, post


def _handlers(line: Sequence[Scope], roles: RolesOf) -> dict[str, str]:
    return {f: s for c in reversed(line) for f, s in roles(c).handlers.items()}


# --- servers that only the rebec itself sends to ------------------------------------------------


def learn_servers(line: Sequence[Scope], roles: RolesOf) -> None:
    """Adds the servers of a class that are known by what it posts alone."""
    for function in roles(line[0]).functions.values():
        for _, post in posts_of(function):
            above = _declaring(line, roles, post)
            handlers = _handlers(line, roles)
            if above is None or post.handler in handlers or post.server in handlers.values():
                continue
            own = best_priority([post.priority])
            best = best_priority(shown for c in line for shown in roles(c).shown.values())
            if own is not None and (best is None or own < best):
                continue  # the mailbox does not know that anything is so urgent
            roles(above).handlers[post.handler] = post.server
            roles(above).shown[post.handler] = post.priority
            roles(above).posted.add(post.server)


def _declaring(line: Sequence[Scope], roles: RolesOf, post: Post) -> Scope | None:
    """The topmost class with the function that serves a post; None for what can be no server."""
    found = [c for c in line if post.handler in roles(c).functions]
    may_serve = all(_may_serve(roles(c), roles(c).functions[post.handler], post) for c in found)
    return found[-1] if found and may_serve else None


def _may_serve(roles: PyRoles, function: Scope, post: Post) -> bool:
    said = function.node.child_by_field_name("return_type")
    gives = any(v.type != "none" for r in function.returns for v in named(r))
    is_other = roles.is_plumbing(function.name) or function.name.startswith("construct")
    is_void = (said is None or text_of(said) == "None") and not gives
    return is_void and not is_other and plain_name(function) == post.server
