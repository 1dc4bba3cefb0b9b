"""Draws nodes, runs them, recovers their models, and compares what both do."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rebsync.reverse.recovery import Extracted, extract
from rebsync.source import Source
from tests.reverse.soundness.effects import Tally, compare
from tests.reverse.soundness.nodes import DrawnNode, draw_node
from tests.reverse.soundness.programs import inputs, run

CALLS = 20  # of each node


def recovered(node: DrawnNode) -> Extracted:
    """What is extracted from a node's package."""
    return extract({path: Source(path, text) for path, text in node.files.items()})


def tallied(folder: Path, seeds: Sequence[int]) -> Tally:
    """What the nodes of these seeds show, all in one program."""
    nodes = [draw_node(seed) for seed in seeds]
    calls = [inputs(node, seed, CALLS) for node, seed in zip(nodes, seeds, strict=True)]
    tally = Tally()
    for node, made, seen in zip(nodes, calls, run(folder, nodes, calls), strict=True):
        tally += compare(node, recovered(node), made, seen)
    return tally
