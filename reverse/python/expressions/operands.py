"""What the readers of generated and of people's Python give to the rules that both follow.

Each reader has values of its own: expressions of the model, with what it knows of them.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from contextlib import AbstractContextManager
from typing import ClassVar, Generic, TypeVar

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import is_calm
from rebsync.source import Span

V = TypeVar("V")


class OperandReader(ABC, Generic[V]):
    """Reads operands; `mixes` says whether it compares whole numbers with others as Python does.

    `asking` are functions for which only the truth of what they are given matters.
    """

    __slots__ = ()
    mixes: ClassVar[bool]
    asking: ClassVar[frozenset[str]] = frozenset()

    @abstractmethod
    def read(self, node: Node) -> V:
        """The value of an expression. Unread: the model has none for it."""

    @abstractmethod
    def condition(self, node: Node) -> m.Expression:
        """What must hold."""

    @abstractmethod
    def made(self, expression: m.Expression, type_: m.Type) -> V:
        """An expression of a type as a value."""

    @abstractmethod
    def shown(self, value: V) -> m.Expression:
        """The expression that a value is."""

    @abstractmethod
    def kind(self, value: V) -> m.Type | None:
        """The widest type of the kind of a value, if it can be told."""

    @abstractmethod
    def truth(self, value: V, node: Node) -> m.Expression:
        """What Python takes for true."""

    @abstractmethod
    def compared(self, sign: str, left: V, right: V, node: Node, number: int) -> m.Expression:
        """The comparison with a number in `node`."""

    @abstractmethod
    def operation(self, operator: str, left: V, right: V, node: Node) -> V:
        """An operation on two numbers."""

    @abstractmethod
    def joined(self, asked: m.Expression, one: V, other: V, node: Node) -> V:
        """One of two values, as a condition says."""

    @abstractmethod
    def library(self, function: Node) -> str:
        """The full name of a function that is not of the code, as `builtins.min`; else empty."""

    @abstractmethod
    def container(self, node: Node, ordered: bool) -> Sequence[V] | None:
        """The elements of what has a name, or the keys of a table; None if nobody knows these."""

    @abstractmethod
    def table(self, node: Node) -> Sequence[tuple[V, V]] | None:
        """The keys and values of a table that has a name."""

    @abstractmethod
    def standing_for(
        self, names: Sequence[str], values: Sequence[V]
    ) -> AbstractContextManager[None]:
        """Lets names stand for values meanwhile."""

    def dotted(self, node: Node) -> V:
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
    def refused(self, node: Node, why: str) -> Unread:
        """What is raised where the model has no such value."""

    def is_calm(self, *values: V) -> bool:
        """Whether evaluating values changes nothing, however often it is done."""
        return all(is_calm(self.shown(value)) for value in values)
