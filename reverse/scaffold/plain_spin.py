"""Programs that say in more words that an executor of one thread serves one node."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from rebsync.records import dataclass
from rebsync.source import Span

# Statements without their layout. The variable keeps the node: an executor does not.
_NODE = re.compile(r"(?:const)?auto(?:const)?(\w+)=(std::make_shared<[\w:]+>\(.*\));\Z")
_EXECUTOR = re.compile(r"rclcpp::executors::SingleThreadedExecutor(\w+)(?:\{\})?;\Z")


@dataclass(frozen=True, slots=True)
class Piece:
    """A token, or a statement without its layout, and its place."""

    text: str
    span: Span


def with_plain_spin(pieces: Sequence[Piece]) -> Iterator[Piece]:
    """The statements of a program, with `rclcpp::spin(node)` for what does just that.

    `rclcpp::spin` makes such an executor, adds the node and spins.
    """
    at = 0
    while at < len(pieces):
        made, count = _spins([p.text for p in pieces[at : at + 4]])
        if count:
            span = pieces[at].span.to(pieces[at + count - 1].span)
            yield Piece(f"rclcpp::spin({made});", span)
        else:
            yield pieces[at]
        at += count or 1


def _spins(texts: Sequence[str]) -> tuple[str, int]:
    """What makes the node, and how many statements spin it; none if these do something else."""
    nodes = [found for text in texts[:2] if (found := _NODE.match(text))]
    executors = [found for text in texts[:2] if (found := _EXECUTOR.match(text))]
    if len(nodes) != 1:
        return "", 0
    name, made = nodes[0][1], nodes[0][2]
    if texts[1:2] == [f"rclcpp::spin({name});"]:
        return made, 2
    if len(executors) == 1:
        executor = executors[0][1]
        if [*texts[2:]] == [f"{executor}.add_node({name});", f"{executor}.spin();"]:
            return made, 4
    return "", 0
