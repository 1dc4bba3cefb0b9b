"""The interface between the parts of the reader of C++ statements, and their state."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import field

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_expression_reader import Exchange
from rebsync.reverse.bodies.cpp_expressions import CppExpressions
from rebsync.reverse.bodies.cpp_unknowns import Demote
from rebsync.reverse.bodies.scope import Inline, Lambda, Meaning, Scope, Variable
from rebsync.reverse.bodies.shared import Shared
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.models.building import bare, is_calm, is_effect
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of


@dataclass(slots=True)
class CppStatementReader(ABC):
    """Reads one body. A statement without a meaning in the model is listed in `findings`.

    `hoisted` are locals that C++ declares before a switch and the model in one of its cases.
    `own` are the locals that the body declares, by their names in C++; `before` is what must run
    before the statement that is read; `returns` is where the value of a `return` goes.
    """

    cpp: Cpp
    scope: Scope
    findings: Findings
    within: str
    hoisted: dict[str, m.Type] = field(default_factory=dict)
    own: set[str] = field(default_factory=set)
    shared: Shared = field(default_factory=Shared)
    before: list[m.Statement] = field(default_factory=list)
    returns: Meaning | None = None
    _depth: int = 0
    _root: Node | None = None
    # The bytes in the statements around that are known to touch what the model has.
    _touching: tuple[int, int] | None = None

    def demote(self, names: set[str], unread: Unread) -> None:
        """Has the body read again without these locals, if there are any."""
        if names - self.shared.demoted:
            raise Demote(names)
        if names:
            raise unread

    def unread(self, node: Node, why: str, hint: str = "") -> Unread:
        """What to raise where a node has no meaning in the model."""
        return Unread(self.cpp.span(node), why, hint)

    def check_comes_back(self, node: Node) -> None:
        """Raises `Unread` where a statement of which the model has nothing may throw."""
        why = self.scope.form.raises(self.cpp, node) if self.scope.form is not None else None
        if why is not None:
            raise self.unread(node, why, "catch what it throws, or look before")

    @property
    def expressions(self) -> CppExpressions:
        """The reader of expressions with the names of this place."""
        lengths = self.shared.subscripts
        return CppExpressions(
            self.cpp, self.scope, self.findings, self.within, self.inlined, lengths
        )

    def text(self) -> str:
        """The text of the whole body."""
        return text_of(self._root) if self._root is not None else self.cpp.source.text

    def meaning(self, name: str, meaning: Meaning, own: bool = False) -> None:
        """Says what a name stands for from here on; `own` for a variable of the body."""
        self.scope = self.scope.with_locals({name: meaning})
        if own:
            self.own.add(name)

    def local(self, node: Node, variable: Variable, initial: m.Initializer | None) -> m.Local:
        """The declaration of a local."""
        span = self.cpp.span(node)
        self.shared.add(variable)
        declarator = m.Declarator(variable.name, initial, span)
        return m.Local(m.Declaration(variable.type or m.Type("int"), (declarator,), span=span))

    def done(
        self, node: Node, read: m.Expression, annotations: tuple[m.Annotation, ...] = ()
    ) -> Iterator[m.Statement]:
        """The statement of an expression, if it does anything."""
        span = self.cpp.span(node)
        if is_effect(read) or not self.scope.open:
            yield m.ExpressionStatement(bare(read) if self.scope.open else read, annotations, span)
        elif not is_calm(read):
            raise self.unread(node, "what this changes stands within an expression")

    def effect(self, node: Node) -> m.Expression:
        """An expression for what it does; generated code says of one without effect that it is."""
        if node.type == "call_expression":
            function = part(node, "function")
            if text_of(function) == "static_cast<void>":
                return self.expressions.read(named(part(node, "arguments"))[0])
        if node.type == "cast_expression" and text_of(part(node, "type")) == "void":
            return self.effect(part(node, "value"))
        return self.expressions.read(node)

    def branch(self, node: Node) -> m.Block:
        """The body of a branch or loop, in braces or not."""
        is_block = node.type == "compound_statement"
        outside = self.scope
        read = tuple(self.statements(node.named_children if is_block else [node]))
        self.scope = outside
        return m.Block(read, span=self.cpp.span(node))

    @abstractmethod
    def read(self, nodes: Sequence[Node]) -> tuple[m.Statement, ...]:
        """Statements that follow each other; their locals stay in `scope`."""

    @abstractmethod
    def statements(self, nodes: Sequence[Node]) -> Iterator[m.Statement]:
        """Statements."""

    @abstractmethod
    def inlined(
        self, node: Node, function: Inline | Lambda | Exchange, arguments: Sequence[Node]
    ) -> Meaning | None:
        """What a call gives for which the function's body stands, now in `before`."""

    @abstractmethod
    def inside(self, cpp: Cpp, scope: Scope, own: set[str] | frozenset[str]) -> CppStatementReader:
        """A reader for a body that stands in this one."""

    @abstractmethod
    def fresh(self, name: str, inlining: bool = False) -> str:
        """A name of the model for a local of that name: another one where it is taken.

        One of a body that stands in another is taken from there to the end of that.
        """

    @abstractmethod
    def declaration(
        self, node: Node, annotations: tuple[m.Annotation, ...], hoisted: bool
    ) -> Iterator[m.Statement]:
        """Declaration."""
