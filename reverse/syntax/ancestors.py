"""What stands around a node of a syntax tree, from the inside."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from tree_sitter import Node


def _never(_: Node) -> bool:
    return False


def ancestors(node: Node, stop: Callable[[Node], bool] = _never) -> Iterator[Node]:
    """The nodes around one, innermost first, before the first for which `stop` holds."""
    above = node.parent
    while above is not None and not stop(above):
        yield above
        above = above.parent


def holds(outer: Node, inner: Node) -> bool:
    """Whether a node of a tree is in another one, or is that."""
    return outer.start_byte <= inner.start_byte and inner.end_byte <= outer.end_byte


def climb(node: Node, stop: Callable[[Node], bool]) -> Node | None:
    """The nearest node around for which `stop` holds."""
    return next((above for above in ancestors(node) if stop(above)), None)


def functions_around(node: Node) -> Iterator[Node]:
    """The functions that something is defined in, innermost first."""
    return (above for above in ancestors(node) if above.type == "function_definition")
