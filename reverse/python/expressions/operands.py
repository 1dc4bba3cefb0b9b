"""What the readers of generated and of people's Python give to the rules that both follow.

Each reader has values of its own: expressions of the model, with what it knows of them.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from contextlib import AbstractContextManager
from typing import ClassVar

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import is_calm
from rebsync.reverse.python.expressions.values import Value
from rebsync.source import Span


class OperandReader(ABC):
    """Reads operands; `mixes` says whether it compares whole numbers with others as Python does.

    `asking` are functions for which only the truth of what they are given matters.
    """

    __slots__ = ()
    mixes: ClassVar[bool]
    asking: ClassVar[frozenset[str]] = frozenset()

    @property
    @abstractmethod
    def rounds_to_whole(self) -> bool:
        """Whether rounding gives whole numbers, as since Python 3."""

    @abstractmethod
    def read(self, node: Node) -> Value:
        """The value of an expression. Unread: the model has none for it."""

    @abstractmethod
    def condition(self, node: Node) -> m.Expression:
        """What must hold."""

    @abstractmethod
    def truth(self, value: Value, node: Node) -> m.Expression:
        """What Python takes for true."""

    @abstractmethod
    def compared(
        self, sign: str, left: Value, right: Value, node: Node, number: int
    ) -> m.Expression:
        """The comparison with a number in `node`."""

    @abstractmethod
    def operation(self, operator: str, left: Value, right: Value, node: Node) -> Value:
        """An operation on two numbers."""

    @abstractmethod
    def joined(self, asked: m.Expression, one: Value, other: Value, node: Node) -> Value:
        """One of two values, as a condition says."""

    @abstractmethod
    def library(self, function: Node) -> str:
        """The full name of a function that is not of the code, as `builtins.min`; else empty."""

    @abstractmethod
    def container(self, node: Node, ordered: bool) -> Sequence[Value] | None:
        """The elements of what has a name, or the keys of a table; None if nobody knows these."""

    @abstractmethod
    def table(self, node: Node) -> Sequence[tuple[Value, Value]] | None:
        """The keys and values of a table that has a name."""

    @abstractmethod
    def standing_for(
        self, names: Sequence[str], values: Sequence[Value]
    ) -> AbstractContextManager[None]:
        """Lets names stand for values meanwhile."""

    def dotted(self, node: Node) -> Value:
        """The constant that a pattern names with dots. Unread: it is none of the model."""
        raise Unread(self.span(node), "the model has no such case")

    @abstractmethod
    def may_fail(self, node: Node) -> bool:
        """Whether the model has it that evaluating an expression may fail."""

    @abstractmethod
    def hides(self, comprehension: Node) -> bool:
        """Whether the variable of a comprehension is none of the function around it."""

    @abstractmethod
    def span(self, node: Node) -> Span:
        """The place of a node."""

    @abstractmethod
    def unread(self, node: Node, why: str) -> Unread:
        """What is raised where the model has no such value."""

    def is_calm(self, *values: Value) -> bool:
        """Whether evaluating values changes nothing, however often it is done."""
        return all(is_calm(value.expression) for value in values)
