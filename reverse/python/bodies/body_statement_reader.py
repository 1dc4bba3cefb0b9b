"""The interface between the parts of the reader of people's statements, and their state."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import field as with_default

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.python.bodies.body_expressions import PyExpressions
from rebsync.reverse.python.bodies.body_node_loops import EndlessLoop
from rebsync.reverse.python.bodies.body_reading import Reading
from rebsync.reverse.python.bodies.body_scope import Frame
from rebsync.reverse.syntax.py_tree import named


@dataclass(eq=False, slots=True)
class BodyStatementReader(ABC):
    """Reads the body of one function, and what stands in it in the place of calls.

    `running` are the functions around; `loops` are the loops that keep the node running. With
    `only` what mentions none of these words has nothing to do with the node.
    """

    reading: Reading
    frame: Frame
    within: str
    root: Node
    running: tuple[int, ...] = ()
    loops: list[EndlessLoop] = with_default(default_factory=list)
    only: tuple[str, ...] = ()
    is_over: bool = False

    @property
    def expressions(self) -> PyExpressions:
        return PyExpressions(self.reading, self.frame, self.within, self.running)

    def block(self, node: Node) -> m.Block:
        """The statements of a branch or loop."""
        self.frame.depth += 1
        try:
            found = self.statements(named(node))
        finally:
            self.frame.depth -= 1
        return m.Block(found, span=self.frame.span(node))

    @abstractmethod
    def body(self, nodes: Sequence[Node]) -> tuple[m.Statement, ...]:
        """All of a body, behind the locals that it must declare first."""

    @abstractmethod
    def statements(self, nodes: Sequence[Node]) -> tuple[m.Statement, ...]:
        """Statements that follow each other; each that has no meaning is listed."""

    @abstractmethod
    def expression(self, node: Node) -> Iterator[m.Statement]:
        """An expression as a statement."""
