"""Statements of C++ as statements of the model."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.analysis.intervals.evaluation_order import note_body
from rebsync.reverse.bodies import (
    cpp_arrays,
    cpp_control,
    cpp_counts,
    cpp_either,
    cpp_exchange,
    cpp_inline,
    cpp_locals,
    cpp_loops,
    cpp_moments,
    cpp_plain_locals,
    cpp_sequencing,
    cpp_special,
    cpp_texts,
    cpp_trying,
    cpp_unsaid_failures,
    cpp_users,
)
from rebsync.reverse.bodies.cpp_expression_reader import Exchange
from rebsync.reverse.bodies.cpp_expressions import MOVE
from rebsync.reverse.bodies.cpp_hiding import check_hiding
from rebsync.reverse.bodies.cpp_mailbox import has_mailbox
from rebsync.reverse.bodies.cpp_statement_reader import CppStatementReader
from rebsync.reverse.bodies.cpp_unknowns import Demote, Unknown
from rebsync.reverse.bodies.effects.cpp_effects import Effects, touching
from rebsync.reverse.bodies.effects.touches import Touches
from rebsync.reverse.bodies.effects.unknown_names import UnknownNames
from rebsync.reverse.bodies.made_locals import tidied
from rebsync.reverse.bodies.scope import Inline, Lambda, Meaning, Scope, Stores
from rebsync.reverse.bodies.shared import WORDS
from rebsync.reverse.bodies.types import cpp_aliases
from rebsync.reverse.bodies.types.wide_locals import broken_locals
from rebsync.reverse.bodies.written import annotations_in
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import cell, is_calm, is_effect
from rebsync.reverse.syntax.cpp_tree import Cpp, markers_in, named, part, text_of
from rebsync.statements import UNREADABLE


@dataclass(slots=True)
class CppStatements(CppStatementReader):
    """Reads one body. A statement without a meaning in the model is listed in `findings`.

    `hoisted` are locals that C++ declares before a switch and the model in one of its cases.
    `own` are the locals that the body declares, by their names in C++; `before` is what must run
    before the statement that is read; `returns` is where the value of a `return` goes.
    """

    def block(self, node: Node) -> m.Block:
        """A body in braces; its locals end with it."""
        outside = self.scope
        statements = self.read(node.named_children)
        self.scope = outside
        return m.Block(statements, span=self.cpp.span(node))

    def read(self, nodes: Sequence[Node]) -> tuple[m.Statement, ...]:
        """Statements that follow each other; their locals stay in `scope`."""
        if self._depth or self.shared.running or not self.scope.open:
            return tuple(self.statements(nodes))
        self._root = nodes[0].parent if nodes else None
        self._depth += 1
        try:
            return self._read_again(nodes)
        finally:
            self._depth -= 1

    def _read_again(self, nodes: Sequence[Node]) -> tuple[m.Statement, ...]:
        """Reads until it is known which locals get values that the model cannot know."""
        scope, marked = self.scope, self.findings.mark()
        while True:
            read = tuple(self.statements(nodes))
            if not self.shared.again:
                broken = broken_locals(read, self.shared.wide, self.scope) - scope.overflowing
                if not broken:
                    self.scope.wide.update(self.shared.wide)
                    read = tidied(read, self.shared.made)
                    note_body(self.findings, self.cpp.source, self.within, read)
                    return read
                scope = replace(scope, overflowing=scope.overflowing | broken)
            self.scope, self.before = scope, []
            self.own.clear()
            self.shared.clear()
            self.findings.back_to(marked)

    def _known(
        self, node: Node, known: Sequence[m.Statement | Stores | Node]
    ) -> Iterator[m.Statement]:
        """What stands for a statement whose meaning is known from elsewhere."""
        for each in known:
            match each:
                case Stores():
                    yield from cpp_special.stores(self, node, each)
                case Node():
                    yield from self._statement(each, (), False)
                case _:
                    yield each

    def statements(self, nodes: Sequence[Node]) -> Iterator[m.Statement]:
        comments: list[str] = []
        users: Effects | None = None
        for index, node in enumerate(nodes):
            if (kind := node.type) == "comment" and self.cpp.has_markers:
                comments.append(text_of(node))
            if kind == "comment" or node.start_byte in self.cpp.filled:
                continue
            markers = markers_in(comments) if comments else ()
            annotations = annotations_in(markers, self.cpp.span(node)) if markers else ()
            local = bool(markers) and any(text.startswith("local ") for text in markers)
            comments = []
            self.findings.statements[self.within] += 1
            if (both := cpp_either.behind(self, node, nodes[index + 1 :])) is not None:
                yield from both
                return
            if (users := cpp_users.block_after(self, markers, users)) and not self.scope.open:
                yield from self._of_user(node, users)
            else:
                yield from self._unless_outside(node, annotations, local)

    def _of_user(self, node: Node, block: Effects) -> Iterator[m.Statement]:
        """Nothing for what a user's block does, unless it touches what the model has."""
        try:
            block.check(node)
            cpp_users.check_names(self, node)
        except Unread as unread:
            yield from self._unreadable(node, unread)

    def _unless_outside(
        self, node: Node, annotations: tuple[m.Annotation, ...], local: bool
    ) -> Sequence[m.Statement]:
        """What stands for a statement that is not outside, if it can be read at all."""
        around = self._touching
        try:
            read: Sequence[m.Statement] = ()
            check_hiding(self, node)
            if node.id in self.scope.instead or not self._is_outside(node):
                read = self._one(node, annotations, local)
            if not read:
                self._check_names(node)
                self.check_comes_back(node)
            cpp_unsaid_failures.check(self, node)
            return read
        except Unread as unread:
            return self._listed(node, unread)
        except Demote as demote:
            self.shared.demote(demote.names)
        except RecursionError:
            why = "this leads deeper than it can be read"
            return self._listed(node, self.unread(node, why))
        finally:
            self._touching = around
        return ()

    def _is_outside(self, node: Node) -> bool:
        """Whether a statement that people wrote, or that logs, touches nothing of the model."""
        if cpp_aliases.declares_nothing(self, node):
            return True
        if node.type == "declaration" or not (self.scope.open or cpp_users.tells(self, node)):
            return False
        if (at := self._touching) and node.start_byte <= at[0] and at[1] <= node.end_byte:
            return False
        touches = touching(self.cpp, self.scope, node)
        self._touching = touches.at if touches is not None else None
        return touches is None

    def _one(
        self, node: Node, annotations: tuple[m.Annotation, ...], local: bool
    ) -> Sequence[m.Statement]:
        """What stands for a statement: before it what its expressions need."""
        around, self.before = self.before, []
        try:
            known = self.scope.instead.get(node.id)
            if known is None:
                read = list(self._statement(node, annotations, local))
            else:
                read = list(self._known(node, known))
            return [*self.before, *read]
        except Unread as unread:
            return list(self._unreadable(node, unread))
        except ValueError:
            return list(self._unreadable(node, self.unread(node, "this does not parse as C++")))
        finally:
            self.before = around

    def _check_names(self, node: Node) -> None:
        """Raises `Unread` where a generated class does something to what nobody knows."""
        if not has_mailbox(self.scope):
            return
        unknown = next(UnknownNames.of(self.scope, node).uses(node), None)
        if unknown is not None:
            raise self.unread(unknown, f'nobody here knows what "{text_of(unknown)}" does')

    def _unreadable(self, node: Node, unread: Unread) -> Iterator[m.Statement]:
        """What stands in the model for a statement that it lacks; nothing for what is outside.

        One that only gives locals values that the model cannot know makes these outside as well.
        """
        if self.scope.open and node.id not in self.scope.instead:
            effects = Effects(self.cpp, self.scope, frozenset(self.own))
            try:
                effects.check(node)
                self.demote(effects.written, unread)
                return
            except Touches as touches:
                self.scope.changed_texts.update(touches.texts)
                texts = cpp_texts.texts_among(self.scope, effects.written)
                if texts - self.shared.demoted:
                    self.demote(texts, unread)
                if (counts := cpp_counts.counted(self, node)) is not None:
                    yield from counts
                    return
                if not self.shared.again:
                    self.findings.open_members |= cpp_special.opened(self, node, unread)
                unread = touches if _says_more(node, unread) else unread
            except Unread:
                pass
        yield from self._listed(node, unread)

    def _listed(self, node: Node, unread: Unread) -> tuple[m.Statement, ...]:
        """Lists a statement as unreadable; what stands for it in the model."""
        self.findings.unreadable(self.cpp.source, unread, self.within)
        unread.with_traceback(None)  # the frames that it came through refer to it
        return (m.Empty((m.Annotation(UNREADABLE),), self.cpp.span(node)),)

    def _statement(
        self, node: Node, annotations: tuple[m.Annotation, ...], local: bool
    ) -> Iterator[m.Statement]:
        if (kind := node.type) == "expression_statement":
            yield from self._expression_statement(node, annotations)
            return
        if kind == "declaration":
            yield from self.declaration(node, annotations, local)
            return
        span = self.cpp.span(node)
        match kind:
            case "compound_statement" | "initializer_list":
                block = m.Block(self.branch(node).statements, annotations, span)
                yield from block.statements if cpp_plain_locals.is_hoisting(node) else (block,)
            case "if_statement":
                yield from cpp_control.branches(self, node, annotations)
            case "while_statement":
                condition = cpp_loops.condition_of(self, part(node, "condition"))
                yield m.While(condition, self.branch(part(node, "body")), annotations, span)
            case "for_statement":
                yield cpp_control.counted(self, node, annotations)
            case "for_range_loop":
                yield from cpp_loops.range_loop(self, node, annotations)
            case "do_statement":
                yield from cpp_loops.do_loop(self, node, annotations)
            case "switch_statement":
                yield cpp_control.switched(self, node, annotations)
            case "try_statement":
                yield from cpp_trying.tried(self, node)
            case "return_statement":
                yield from cpp_control.returned(self, node, annotations)
            case "throw_statement":
                raise self.unread(node, "an exception leaves the function")
            case "break_statement":
                yield m.Break(annotations, span)
            case "continue_statement":
                yield m.Continue(annotations, span)
            case kind if kind.startswith("preproc_"):
                raise self.unread(node, "which of these alternatives counts is not known")
            case "attributed_statement" if text_of(node) == "[[fallthrough]];":
                pass
            case "attributed_statement":
                yield from self.statements(
                    [n for n in named(node) if n.type != "attribute_declaration"]
                )
            case "ERROR":
                raise self.unread(node, "this does not parse as C++")
            case kind:
                raise self.unread(node, f"the model has no {kind.replace('_', ' ')}")

    # --- what others read with ------------------------------------------------------------------

    def inlined(
        self, node: Node, function: Inline | Lambda | Exchange, arguments: Sequence[Node]
    ) -> Meaning | None:
        """What a call gives for which the function's body stands, now in `before`."""
        if isinstance(function, Exchange):
            cpp_sequencing.check_place(self, node)
            return cpp_exchange.exchanged(self, node, function)
        form = self.scope.form
        call = self.scope.call(node) if node.type == "call_expression" else None
        name = call.name.rpartition("::")[2] if call is not None else ""
        why = form.places.unread(self.cpp, node, name) if form is not None else None
        if why is not None:
            raise self.unread(node, why)
        return cpp_inline.inlined(self, node, function, arguments)

    def inside(self, cpp: Cpp, scope: Scope, own: set[str] | frozenset[str]) -> CppStatements:
        """A reader for a body that stands in this one."""
        within, shared = self.within, self.shared
        return CppStatements(cpp, scope, self.findings, within, own=set(own), shared=shared)

    def fresh(self, name: str, inlining: bool = False) -> str:
        """A name of the model for a local of that name: another one where it is taken.

        One of a body that stands in another is taken from there to the end of that.
        """
        inlining = inlining or bool(self.shared.running)
        taken = self.shared.taken(self.scope) | WORDS | self.shared.kept
        if inlining:
            taken |= self.shared.names
        plain = self.scope.local(name)
        free, number = plain, 2
        while free in taken:
            free, number = f"{plain}_{number}", number + 1
        self.shared.names.add(free)
        if inlining:
            self.shared.kept.add(free)
        return free

    # --- expressions and declarations -----------------------------------------------------------

    def _expression_statement(
        self, node: Node, annotations: tuple[m.Annotation, ...]
    ) -> Iterator[m.Statement]:
        children = named(node)
        if not children:
            yield m.Empty(annotations, self.cpp.span(node))
            return
        if cpp_users.tells(self, node):
            if (touches := touching(self.cpp, self.scope, node)) is not None:
                raise touches
            return
        if cpp_users.is_unused(self, node, expression := children[0]):
            return
        if declared := cpp_plain_locals.late(self, expression):
            yield m.Local(declared, annotations, self.cpp.span(node))
            return
        if (special := cpp_special.read(self, expression)) is not None:
            yield from special
            return
        if (stores := cpp_arrays.filled(self, expression)) is not None:
            yield from stores
            return
        if (loop := cpp_loops.for_each(self, expression)) is not None:
            yield loop
            return
        read = self.effect(expression)
        if expression.type == "cast_expression" and not is_effect(read) and is_calm(read):
            return  # `(void)x;`, which only people write
        if isinstance(read, m.Call) and read.name == MOVE:
            cells = zip(("X", "Y"), read.arguments, strict=False)
            move = m.Annotation("Move", tuple(cell(axis, offset) for axis, offset in cells))
            yield m.Empty((*annotations, move), self.cpp.span(node))
            return
        yield from self.done(node, read, annotations)

    def declaration(
        self, node: Node, annotations: tuple[m.Annotation, ...], hoisted: bool
    ) -> Iterator[m.Statement]:
        if cpp_moments.is_moment(self, node):
            yield from cpp_moments.declared(self, node)
            return
        if self.scope.open or not cpp_plain_locals.is_plain(node):
            yield from cpp_locals.declarations(self, node)
            return
        declaration = cpp_plain_locals.declared(self, node)
        if hoisted:
            names = cpp_plain_locals.declared_names(node)
            self.hoisted |= dict.fromkeys(names, declaration.type)
            return
        yield m.Local(declaration, annotations, self.cpp.span(node))

    # --- control --------------------------------------------------------------------------------


def _says_more(node: Node, unread: Unread) -> bool:
    """Whether what a statement touches is a better reason than that its value is not known."""
    if not isinstance(unread, Unknown):
        return False
    inner = named(node) if node.type == "expression_statement" else []
    return bool(inner) and inner[0].type == "call_expression"
