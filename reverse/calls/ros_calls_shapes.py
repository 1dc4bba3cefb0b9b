"""Calls that ask for something, as they stand in the code, and small pieces of their facts."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.calls.ros_calls_callbacks import Called
from rebsync.reverse.graph import (
    Callback,
    Fact,
    FromParameter,
    NodeFact,
    OneOf,
    Resolved,
    Site,
    Unresolved,
)
from rebsync.reverse.libraries.routines import Routine
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of, unqualified
from rebsync.reverse.values.cpp_flow import declaration_of, made_of
from rebsync.reverse.values.cpp_values_names import one_of
from rebsync.reverse.values.cpp_values_plain import Frame

MAKERS = frozenset({"make_shared", "make_unique"})
TEMPLATES = ("template_type", "template_function", "template_method")


@dataclass(frozen=True, eq=False)
class Asked:
    """A call that asks for something; `target` is the object whose method it is."""

    ask: Routine
    site: Site
    arguments: tuple[Node, ...]
    types: tuple[Node, ...] = ()
    target: Node | None = None


def types_of(node: Node | None) -> tuple[Node, ...]:
    """The arguments of the template that a name, or the last of several, is one of."""
    node = unqualified(node) if node is not None else None
    if node is None or node.type not in TEMPLATES:
        return ()
    return tuple(named(part(node, "arguments")))


def given_to(frame: Frame) -> frozenset[int]:
    """The arguments of the calls that led into a function, as numbers of nodes."""
    found: set[int] = set()
    at: Frame | None = frame
    while at is not None:
        found |= {node.id for node in at.call.arguments} if at.call is not None else set()
        at = at.caller
    return frozenset(found)


def is_used(cpp: Cpp, scopes: Iterable[str], name: str) -> bool:
    """Whether a file names what is in one of some namespaces without these."""
    lines = (f"using {used};" for s in scopes for used in (f"namespace {s}", f"{s}::{name}"))
    return any(line.encode() in cpp.original for line in lines)


def objects_of(node: Node, above: Node) -> Iterator[tuple[Node, tuple[Node, ...]]]:
    """The objects that are made where a type is named, with their arguments."""
    match above.type:
        case "declaration":
            for declarator in above.children_by_field_name("declarator"):
                name = declarator
                while name.type not in ("identifier", "field_identifier"):
                    inner = name.child_by_field_name("declarator")
                    if inner is None:
                        break
                    name = inner
                if declaration_of(name) is not None and (given := made_of(name)):
                    yield declarator, given
        case "call_expression" if part(above, "function") == node:
            yield above, tuple(named(part(above, "arguments")))
        case "new_expression":
            arguments = above.child_by_field_name("arguments")
            yield above, tuple(named(arguments)) if arguments is not None else ()
        case "type_descriptor" if (call := _maker_of(above)) is not None:
            yield call, tuple(named(part(call, "arguments")))
        case _:
            return


def _maker_of(type_: Node) -> Node | None:
    """The call of `make_shared<T>(...)` that a type stands in."""
    maker = type_.parent.parent if type_.parent is not None else None
    if maker is None or maker.type != "template_function":
        return None
    if text_of(part(maker, "name")) not in MAKERS:
        return None
    call = climb(maker, lambda n: n.type != "qualified_identifier")
    return call if call is not None and call.type == "call_expression" else None


def nodelets_of(asked: Asked) -> Iterator[Fact]:
    given = dict(zip(asked.ask.arguments, asked.arguments, strict=False))
    base = text_of(given["base"]).rpartition("::")[2] if "base" in given else ""
    if base == "Nodelet":
        name = text_of(given["class"]).rpartition("::")[2]
        yield NodeFact(asked.site, None, nodelet=name)


def distinct(called: list[Called]) -> tuple[Callback | Unresolved, ...]:
    found: dict[tuple[str, int], Callback | Unresolved] = {}
    for one in called:
        callback = one.callback
        label = callback.name if isinstance(callback, Callback) else callback.why
        start = callback.place.span.start if isinstance(callback, Callback) and not label else 0
        found.setdefault((label, start), callback)
    return tuple(found.values())


def truth_of(value: Resolved) -> Resolved:
    match value:
        case int() if value in (0, 1):
            return bool(value)
        case OneOf(values):
            return one_of(truth_of(v) for v in values) or False
        case FromParameter():
            return value
        case _:
            return value


def called_as(node: Node, above: Node) -> tuple[str, Node] | None:
    """The scope that the name of a function is called in, and the call; None for no call of it.

    `above` is what the name stands in; of `a::b::f()` the scope is the last one.
    """
    scope = ""
    while above.type == "qualified_identifier" and part(above, "name") == node:
        if not scope:
            written = above.child_by_field_name("scope")
            scope = text_of(written) if written is not None else ""
        if above.parent is None:
            return None
        node, above = above, above.parent
    is_called = above.type == "call_expression" and part(above, "function") == node
    return (scope, above) if is_called else None


def handed_on(call: Node) -> bool:
    """Whether an object is only the argument of a call, or of a declaration."""
    above = call.parent
    if above is None or call.type == "init_declarator" or above.type == "declaration":
        return False
    return above.type in ("argument_list", "init_declarator", "optional_parameter_declaration")
