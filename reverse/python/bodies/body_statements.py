"""Statements of Python as statements of the model."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies.returns import always_leaves
from rebsync.reverse.findings import Unread
from rebsync.reverse.python.bodies import (
    body_for,
    body_loops,
    body_match,
    body_messages,
    body_methods,
    body_setup,
    body_stores,
    body_switches,
    body_targets,
    body_trying,
    body_variables,
)
from rebsync.reverse.python.bodies.body_effects import (
    DEFINITIONS,
    defines_only,
    is_harmless,
    is_log,
)
from rebsync.reverse.python.bodies.body_expressions import short
from rebsync.reverse.python.bodies.body_locks import contexts_of, is_lock, waits_for_itself
from rebsync.reverse.python.bodies.body_match import Way
from rebsync.reverse.python.bodies.body_raising import raised
from rebsync.reverse.python.bodies.body_scope import Pending
from rebsync.reverse.python.bodies.body_statement_reader import BodyStatementReader
from rebsync.reverse.syntax.py_tree import field, is_constant_text, named, text_of
from rebsync.statements import UNREADABLE

_NOTHING = frozenset(
    {"comment", "pass_statement", "global_statement", "import_statement", "print_statement"}
    | {"import_from_statement", "future_import_statement", "nonlocal_statement"}
)
_CATCH = "look before whether it may"


@dataclass(eq=False, slots=True)
class PyStatements(BodyStatementReader):
    """Reads the body of one function, and what stands in it in the place of calls.

    `running` are the functions around; `loops` are the loops that keep the node running. With
    `only` what mentions none of these words has nothing to do with the node.
    """

    def body(self, nodes: Sequence[Node]) -> tuple[m.Statement, ...]:
        """All of a body, behind the locals that it must declare first."""
        self.reading.bodies.add(self.frame.scope.node.id)
        found = self.statements(nodes)
        first = [
            body_variables.declared(name, type_, None) for name, type_ in self.frame.hoisted.items()
        ]
        self.frame.hoisted.clear()
        return (*first, *found)

    def statements(self, nodes: Sequence[Node]) -> tuple[m.Statement, ...]:
        """Statements that follow each other; each that has no meaning is listed."""
        found: list[m.Statement] = []
        for node in nodes:
            if self.is_over:
                break
            found += self._listed(node)
        return tuple(found)

    def lambda_(self, node: Node) -> list[m.Statement]:
        """The one expression of a lambda, as a statement."""
        self.reading.findings.statements[self.within] += 1
        self.reading.listed.add(node.id)
        try:
            found = list(self.expression(node))
            if (why := raised(self, node)) is None:
                return found
            raise Unread(self.frame.span(node), why, _CATCH)
        except Unread as unread:
            self.reading.findings.unreadable(self.frame.py.source, unread, self.within)
        return [self._lacking(node)]

    def _listed(self, node: Node) -> list[m.Statement]:
        if node.type in _NOTHING:
            return []
        if node.type in DEFINITIONS and (
            self.frame.is_start or defines_only(self.reading, node, self.frame)
        ):
            return []
        if self.only and not any(word in text_of(node) for word in self.only):
            return []
        findings = self.reading.findings
        findings.statements[self.within] += 1
        self.reading.listed.add(node.id)
        try:
            found = list(self.statement(node))
            if (why := raised(self, node)) is None:
                return found
            unread = Unread(self.frame.span(node), why, _CATCH)
            findings.unreadable(self.frame.py.source, unread, self.within)
            return [self._lacking(node), *found]
        except Pending as pending:
            findings.unreadable(self.frame.py.source, pending, self.within)
        except Unread as unread:
            self._lose(node)
            findings.unreadable(self.frame.py.source, unread, self.within)
        except RecursionError:
            deep = Unread(self.frame.span(node), "this leads deeper than it can be read")
            findings.unreadable(self.frame.py.source, deep, self.within)
        return [self._lacking(node)]

    def _lacking(self, node: Node) -> m.Statement:
        return m.Empty((m.Annotation(UNREADABLE),), self.frame.span(node))

    def _lose(self, node: Node) -> None:
        """Of what a statement sets that is not read nothing is known."""
        for inner in body_trying.inside(node):
            if inner.type in ("assignment", "augmented_assignment", "for_statement"):
                body_variables.forget(self, field(inner, "left"))
            elif inner.type == "named_expression":
                body_variables.forget(self, field(inner, "name"))

    # --- kinds of statements --------------------------------------------------------------------

    def statement(self, node: Node) -> Iterator[m.Statement]:
        span = self.frame.span(node)
        match node.type:
            case "expression_statement":
                for inner in named(node):
                    yield from self.expression(inner)
            case "if_statement":
                yield from self._if(node)
            case "match_statement":
                first, of = body_match.subject(self, node)
                yield from first
                yield from self._branch(body_match.ways(self, node, of))
            case "while_statement":
                yield from body_loops.while_(self, node)
            case "for_statement":
                yield from body_for.for_(self, node)
            case "return_statement":
                yield from self._return(node)
            case "break_statement":
                yield m.Break((), span)
            case "continue_statement":
                yield m.Continue((), span)
            case "try_statement":
                yield from body_trying.try_(self, node)
            case "with_statement":
                yield from self._with(node)
            case "assert_statement":
                asked = self.expressions.condition(named(node)[0])
                yield m.ExpressionStatement(m.Call(None, "assertion", (asked,)), (), span)
            case "delete_statement":
                for inner in named(node):
                    body_targets.check_deleted(self, inner)
                    body_variables.forget(self, inner)
            case kind if kind in DEFINITIONS:
                raise Unread(span, "what runs when this is defined may change the node")
            case "raise_statement":
                raise Unread(span, "an exception ends the callback: the model has none")
            case _:
                raise Unread(span, f'"{node.type.replace("_", " ")}" is not read')

    def expression(self, node: Node) -> Iterator[m.Statement]:
        """An expression as a statement."""
        match node.type:
            case "assignment":
                yield from body_stores.assignment(self, node)
            case "augmented_assignment":
                yield from body_stores.augmented(self, node)
            case "call":
                yield from self._call(node)
            case _ if is_constant_text(node):
                return
            case _ if is_harmless(self.reading, node, self.frame):
                return
            case _:
                raise Unread(self.frame.span(node), f'"{short(node)}" is not read')

    def _call(self, node: Node) -> Iterator[m.Statement]:
        if is_log(node) and is_harmless(self.reading, node, self.frame):
            return
        sends = body_messages.published(self, node)
        if sends is not None:
            yield from sends
            return
        known = body_setup.asked(self, node) or body_switches.switched(self, node)
        if known is not None:
            yield from known
            return
        own = self.reading.function(field(node, "function"), self.frame)
        if own is not None:
            yield from body_methods.inlined(self, own, node)
        elif not is_harmless(self.reading, node, self.frame):
            what = short(field(node, "function"))
            raise Unread(self.frame.span(node), f'what "{what}" does is not known')

    def _return(self, node: Node) -> Iterator[m.Statement]:
        inner = named(node)
        span = self.frame.span(node)
        if inner and not is_harmless(self.reading, inner[0], self.frame):
            yield from self.expression(inner[0])
        yield m.Return(None, (), span)

    def _if(self, node: Node) -> Iterator[m.Statement]:
        if self.frame.is_start and "__name__" in text_of(field(node, "condition")):
            yield from self.statements(named(field(node, "consequence")))
            return
        ways: list[Way] = []
        for each in (node, *node.children_by_field_name("alternative")):
            if each.type == "else_clause":
                ways.append((each, lambda: ([], None), field(each, "body")))
            else:
                asked = partial(body_match.asked, self, field(each, "condition"))
                ways.append((each, asked, field(each, "consequence")))
        yield from self._branch(ways)

    def _branch(self, ways: Sequence[Way]) -> Iterator[m.Statement]:
        (node, asked, body), *others = ways
        first, condition = asked()
        yield from first
        if condition is None:
            yield self.block(body)
            return
        before = set(self.frame.assigned)
        then = self.block(body)
        after, self.frame.assigned = self.frame.assigned, before
        otherwise = self._otherwise(others) if others else None
        if always_leaves(then):
            pass
        elif otherwise is not None and always_leaves(otherwise):
            self.frame.assigned = after
        else:
            self.frame.assigned &= after
        yield m.If(condition, then, otherwise, (), self.frame.span(node))

    def _otherwise(self, ways: Sequence[Way]) -> m.Statement:
        self.frame.depth += 1
        try:
            found = tuple(self._branch(ways))
        finally:
            self.frame.depth -= 1
        return found[0] if len(found) == 1 else m.Block(found)

    def _with(self, node: Node) -> Iterator[m.Statement]:
        for context in contexts_of(node):
            if body_setup.is_entered(self, context):
                yield from self.expression(context)
            elif not is_lock(self.reading, context, self.frame):
                why = "what entering and leaving this does is not known"
                raise Unread(self.frame.span(node), why)
        if waits_for_itself(self.reading, node, self.frame):
            raise Unread(self.frame.span(node), "this may wait for ever for a lock that it holds")
        for item in named(named(node)[0]):
            value = field(item, "value")
            if value.type == "as_pattern":
                target = field(value, "alias")
                body_targets.check_target(self, target)
                body_variables.forget(self, target.named_children[0])
        yield from self.statements(named(field(node, "body")))
