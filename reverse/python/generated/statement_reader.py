"""The interface between the parts of the reader of generated statements, and their state."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Collection
from dataclasses import field as with_default
from itertools import chain, count

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reserved import PYTHON_RESERVED, uncarry_local
from rebsync.reverse.analysis.intervals.evaluation_order import note_store
from rebsync.reverse.findings import Findings
from rebsync.reverse.python.generated.callees import known_there, there
from rebsync.reverse.python.generated.expressions import Expressions
from rebsync.reverse.python.generated.names import Closure
from rebsync.reverse.syntax.py_tree import field, named

_AGAIN = re.compile(r"(.+?)__\d+\Z")


@dataclass(eq=False, slots=True)
class ModelStatementReader(ABC):
    """Reads the bodies of one function; `within` names it where something is listed.

    `hoisted` are the locals that a switch declares before it, `cases` the names of the switches
    around a statement, innermost last. `implied` are the locals of a block, `annotated` the types
    that names of the function have been given, `inner` are functions within. `lasting` is the
    variable of a loop that is read behind it.
    """

    expressions: Expressions
    findings: Findings
    within: str
    types: frozenset[str] = frozenset()
    hoisted: dict[str, m.Type] = with_default(default_factory=dict)
    cases: list[str] = with_default(default_factory=list)
    implied: set[str] = with_default(default_factory=set)
    annotated: dict[str, m.Type] = with_default(default_factory=dict)
    inner: dict[str, Closure] = with_default(default_factory=dict)
    lasting: str = ""

    def in_order(self, store: m.Expression) -> None:
        """Lists an assignment if its value has to be known after what it stores into."""
        note_store(self.findings, self.expressions.py.source, self.within, store)

    def local(self, name: str) -> str:
        """The model's name of a local variable or parameter."""
        taken = self.types | {t.removesuffix("_v") for t in self.types}
        return uncarry_local(name, PYTHON_RESERVED | taken, self.types)

    def free(self, *names: str, pattern: str, first: int = 1, taken: Collection[str] = ()) -> str:
        """The first of some names, or of those with a number in a pattern, that nothing has."""
        known = {*self.expressions.locals.values(), *self.expressions.names.types, *taken}
        numbered = (pattern.format(number) for number in count(first))
        return next(name for name in chain(names, numbered) if name not in known)

    def without_number(self, name: str) -> str:
        """The name of a local that Python must tell from another of this name: `i` for `i__2`."""
        again = _AGAIN.match(name)
        return again[1] if again is not None else name

    def declaration(
        self, name: str, local: str, type_: m.Type, value: m.Expression | None, node: Node
    ) -> m.Local:
        """The local of the model that a name is until the block ends, with its type."""
        span = self.expressions.py.span(node)
        self.implied.add(name)
        self.expressions.locals[name] = local
        self.expressions.types[local] = type_
        declared = m.Declaration(type_, (m.Declarator(local, value, span),), span=span)
        return m.Local(declared, span=span)

    def suite(self, node: Node, nodes: list[Node] | None = None) -> m.Block:
        """The body of a loop; only some `nodes` of it, if they are given."""
        outer, self.cases = self.cases, []
        found = self.branch(node, nodes)
        self.cases = outer
        return found

    def branch(self, node: Node, nodes: list[Node] | None = None) -> m.Block:
        """A block, or some `nodes` of it. What it names first nobody knows behind it."""
        outer, closures = self.implied, self.expressions.closures
        sends = self.expressions.kept_sends
        self.expressions.kept_sends = dict(sends)
        moments, self.expressions.moments = self.expressions.moments, dict(self.expressions.moments)
        inner, self.inner = self.inner, dict(self.inner)
        tables, self.expressions.kept_tables = (
            self.expressions.kept_tables,
            {**self.expressions.kept_tables},
        )
        self.implied, self.expressions.closures = set(), dict(closures)
        found = self.block(named(node) if nodes is None else nodes, node)
        for name in self.implied:
            self.expressions.locals.pop(name, None)
        self.implied, self.expressions.closures, self.inner = outer, closures, inner
        self.expressions.kept_sends, self.expressions.moments = sends, moments
        self.expressions.kept_tables = tables
        return found

    def part(self, part: Node) -> m.Block:
        """A branch of an `if`; a function is there where its condition says so."""
        if part.type == "else_clause":
            return self.branch(field(part, "body"))
        sends = self.expressions.kept_sends
        if (known := known_there(self.expressions, field(part, "condition"))) is not None:
            name, _ = known
            self.expressions.kept_sends = sends | {name: there(sends[name])}
        found = self.branch(field(part, "consequence"))
        self.expressions.kept_sends = sends
        return found

    @abstractmethod
    def block(self, nodes: list[Node], span_of: Node) -> m.Block:
        """The statements of a suite."""

    @abstractmethod
    def implied_local(self, name: str, value: Node, node: Node) -> m.Local:
        """A local without a type, which is that of its value."""
