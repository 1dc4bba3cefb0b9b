"""The interface between the parts of the reader of C++ expressions, and their state."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import field

from tree_sitter import Node

from rebsync import model as m
from rebsync import precedence
from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.bodies.scope import (
    Inline,
    Lambda,
    Meaning,
    Scope,
    Variable,
)
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.syntax.cpp_tree import Cpp, named, text_of
from rebsync.source import Span


@dataclass(frozen=True, slots=True)
class Exchange:
    """A call that stores `value` in `target`, or what an operator makes of both, and gives what
    was there.
    """

    target: Node
    value: Node
    operator: str = ""


# Reads the call of a function whose body stands in its place: what the call gives, if anything.
Inlines = Callable[[Node, Inline | Lambda | Exchange, Sequence[Node]], Meaning | None]


@dataclass(frozen=True, slots=True)
class CppExpressionReader(ABC):
    """Reads the expressions of one body. What has no meaning in the model raises `Unread`.

    A value that the model cannot know raises `Unknown`, unless its place allows for a choice:
    that is listed in `findings`. Without `inlines` no function's body can stand for its call.
    `subscripts` gets the places of elements whose indices nobody tests, with the lengths.
    """

    cpp: Cpp
    scope: Scope
    findings: Findings | None = None
    within: str = ""
    inlines: Inlines | None = None
    subscripts: dict[Span, int] = field(default_factory=dict)

    def operand(self, node: Node, binding: int) -> m.Expression:
        """An operand that binds at least so tightly, in parentheses if it does not."""
        expression = self.read(node)
        if precedence.binding(expression) < binding:
            return m.Paren(expression, self.cpp.span(node))
        return expression

    def unread(self, node: Node, why: str, hint: str = "") -> Unread:
        """What to raise where a node has no meaning in the model."""
        return Unread(self.cpp.span(node), why, hint)

    def unknown(self, node: Node, why: str) -> Unread:
        """What to raise for a value that the model cannot know, where there can be such values."""
        kind = Unknown if self.scope.open else Unread
        return kind(self.cpp.span(node), why)

    def check_operator(self, node: Node) -> None:
        """Raises `Unread` where an operator is the program's, of an enumeration: a function."""
        form = self.scope.form
        if form is not None and form.places.operates(self.cpp, node):
            sign = text_of(node.child_by_field_name("operator") or node.children[0])
            why = f'the program has an "operator{sign}" of its own for an enumeration'
            raise self.unread(node, why)

    def only(self, node: Node) -> Node:
        """The one expression in a node."""
        children = named(node)
        if len(children) != 1:
            raise self.unread(node, "this is not one expression")
        return children[0]

    def calls(
        self, node: Node, target: m.Expression | None, name: str, arguments: Sequence[Node]
    ) -> m.Call:
        """A call with all arguments as they are."""
        values = tuple(self.read(a) for a in arguments)
        return m.Call(target, name, values, span=self.cpp.span(node))

    @abstractmethod
    def read(self, node: Node) -> m.Expression:
        """The expression, with parentheses where the code has them or the model needs them."""

    @abstractmethod
    def condition(self, node: Node, place: Variable | None = None) -> m.Expression:
        """An expression as a truth value that `place` holds; of what is not known a choice."""

    @abstractmethod
    def stored(self, node: Node, place: Variable) -> m.Expression:
        """A value as `place` holds it; where a hint says what it can be, a choice of that."""

    def check_comes_back(self, node: Node) -> None:
        """Raises `Unread` where an expression of which the model has nothing may throw."""
        form = self.scope.form
        why = form.raises(self.cpp, node) if form is not None else None
        if why is not None:
            raise Unread(self.cpp.span(node), why, "catch what it throws, or look before")

    @abstractmethod
    def approximate(self, node: Node, unread: Unread) -> None:
        """Lists that a choice stands for an expression, which must touch nothing of the model."""

    @abstractmethod
    def index(self, node: Node, indices: Sequence[Node]) -> m.Expression:
        """Index."""

    @abstractmethod
    def binary(self, node: Node, operator: str, sides: Sequence[Node]) -> m.Expression:
        """Binary."""

    @abstractmethod
    def assign(self, node: Node, operator: str, sides: Sequence[Node]) -> m.Expression:
        """Assign."""

    @abstractmethod
    def cast(self, to: Node, operand: Node, node: Node) -> m.Expression:
        """A value that is converted by a cast of whatever kind."""

    @abstractmethod
    def inlined(
        self, node: Node, function: Inline | Lambda | Exchange, arguments: Sequence[Node]
    ) -> m.Expression:
        """What a call gives for which the function's body stands."""
