"""Loops that keep a node running."""

from __future__ import annotations

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.python.bodies.body_scope import Frame
from rebsync.reverse.syntax.py_tree import field, text_of


@dataclass(frozen=True, eq=False, slots=True)
class EndlessLoop:
    """A loop that keeps a node running, as the server that it becomes."""

    name: str
    node: Node
    frame: Frame
    running: tuple[int, ...]
    only: tuple[str, ...]


def forever(node: Node) -> bool:
    """Whether a loop goes on for as long as the node runs."""
    if node.type != "while_statement":
        return False
    return libraries.running().search(text_of(field(node, "condition"))) is not None
