"""How calls of generated Python bind arguments to parameters, and what stands in for others."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

from tree_sitter import Node

from rebsync.reverse.models.building import is_calm
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.idioms import ahead
from rebsync.reverse.python.generated.idioms import times as times_of
from rebsync.reverse.python.generated.py_types import call_parts
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.reverse.syntax.py_index import BY_NAME, BY_PLACE, PyCode, PyParameter, Scope
from rebsync.reverse.syntax.py_tree import field, text_of

_OTHERS = "this has other arguments than those that are asked for"
_CONSTANT = frozenset({"integer", "float", "true", "false", "none"})
_DEFAULTS = frozenset({"default_parameter", "typed_default_parameter"})


def has_constant(parameter: Node) -> bool:
    """Whether a parameter has a default that is the same at any time."""
    return parameter.type in _DEFAULTS and _is_constant(field(parameter, "value"))


def _is_constant(default: Node | None) -> bool:
    if default is not None and default.type == "unary_operator":
        default = field(default, "argument")
    return default is not None and default.type in _CONSTANT


def in_order(
    reader: ModelExpressionReader,
    node: Node,
    arguments: list[Node],
    parameters: Sequence[PyParameter],
) -> list[Node]:
    """The arguments in the order of the parameters; a constant default stands for one left out.

    Those behind the last that is known are left out. Unread: one is not taken, or is there twice,
    or their order might matter.
    """
    by_name = [a for a in arguments if a.type == "keyword_argument"]
    placed = [a for a in arguments if a not in by_name]
    places = [p for p in parameters if p.by != BY_NAME]
    if not by_name and places == [*parameters] and any(a.type == "list_splat" for a in placed):
        return arguments
    bound = {p.name: a for p, a in zip(places, placed, strict=False)}
    free = {p.name for p in parameters if p.by != BY_PLACE} - bound.keys()
    named_ = {text_of(field(a, "name")): field(a, "value") for a in by_name}
    is_spread = any(a.type.endswith("_splat") for a in placed)
    is_whole = len(bound) == len(placed) and len(named_) == len(by_name)
    if is_spread or not (is_whole and named_.keys() <= free):
        raise reader.unread(node, _OTHERS)
    ordered = [p.name for p in parameters if p.name in named_]
    if [*named_] != ordered and not all(_is_calm(reader, *each) for each in named_.items()):
        raise reader.unread(node, "give these in the order of the parameters")
    bound |= named_
    found = [
        bound.get(p.name) or (p.default if _is_constant(p.default) else None) for p in parameters
    ]
    known = found[: found.index(None)] if None in found else found
    if any(p.name in bound for p in parameters[len(known) :]):
        raise reader.unread(node, _OTHERS)
    return [each for each in known if each is not None]


def _is_calm(reader: ModelExpressionReader, name: str, argument: Node) -> bool:
    """Whether an argument does nothing, whichever of them is evaluated first."""
    if argument.type == "identifier":
        return True
    with ahead(reader):
        times = times_of(reader, argument) if name == "when" else None
        found = [reader.expression(argument)] if times is None else [*times.values()]
    return all(map(is_calm, found))


def shared(
    code: PyCode, line: Callable[[Scope], Sequence[Scope]], method: Scope
) -> tuple[PyParameter, ...]:
    """What a method is given besides its object, whichever method of its name is called.

    Where others of that name, in classes above or below, take something else, only places tell what
    is what.
    """
    own, owner = text_of(field(method.node, "parameters")), method.owner
    named_so = ((f, f.owner) for f in code.methods.get(method.name, ()))
    others = (f for f, c in named_so if c and owner and (owner in line(c) or c in line(owner)))
    if all(text_of(field(f.node, "parameters")) == own for f in others):
        return tuple(method.parameters[1:])
    return tuple(replace(p, default=None, by=p.by or BY_PLACE) for p in method.parameters[1:])


def is_given_all(name: str, bodies: Iterable[Node], count: int) -> bool:
    """Whether all that name a function in some bodies call it with so many arguments."""
    attributes = (n for body in bodies for n in nodes_in(body) if n.type == "attribute")
    found = (n for n in attributes if text_of(field(n, "attribute")) == name)
    return all(_given(each) == count for each in found)


def _given(function: Node) -> int | None:
    """How many arguments a function gets; None where it is not called, or something is spread."""
    _, arguments = call_parts(function.parent) or ("", [])
    above = function.parent
    if above is None or above.type != "call" or field(above, "function") != function:
        return None
    is_spread = any(a.type in ("list_splat", "dictionary_splat") for a in arguments)
    return None if is_spread else len(arguments)
