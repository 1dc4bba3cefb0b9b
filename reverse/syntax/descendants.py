"""What stands in a node of a syntax tree, in the order of the text."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node


def nodes_in(node: Node, *whole: str) -> Iterator[Node]:
    """A node and all that are in it; of those of the types in `whole` not what is in them."""
    waiting = [node]
    while waiting:
        current = waiting.pop()
        yield current
        if not whole or current.type not in whole:
            waiting += reversed(current.named_children)
