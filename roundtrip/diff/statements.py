"""Differences between two bodies: statements that came, went, moved or changed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import field
from typing import TypeAlias

from rebsync import model as m
from rebsync.printing import print_line, print_statement
from rebsync.records import dataclass
from rebsync.roundtrip.diff.alignment import ALIKE, aligned, overlap
from rebsync.roundtrip.diff.difference import (
    Aspect,
    Changed,
    Difference,
    Element,
    Place,
    StatementInserted,
    StatementMoved,
    StatementRemoved,
    Undetermined,
)
from rebsync.roundtrip.diff.expressions import StatementPart, parts_of
from rebsync.roundtrip.diff.operands import is_unreadable
from rebsync.roundtrip.diff.references import apart_by_reference
from rebsync.roundtrip.diff.similarity import (
    are_akin,
    around_some,
    head_of,
    with_inner,
    words_of,
)
from rebsync.roundtrip.diff.tokens import Tokens
from rebsync.source import NOWHERE
from rebsync.statements import UNREADABLE

Statements: TypeAlias = tuple[m.Statement, ...]


@dataclass(slots=True, eq=False)
class BodyComparison:
    """Compares the statements of two bodies; `pairs` are the locals declared in one place."""

    element: Element
    left: Tokens
    right: Tokens
    ends: tuple[Place | None, Place | None]
    found: list[Difference] = field(default_factory=list)
    pairs: list[tuple[m.Declarator, m.Declarator]] = field(default_factory=list)
    removed: list[tuple[m.Statement, int]] = field(default_factory=list)
    inserted: list[tuple[m.Statement, int]] = field(default_factory=list)
    words: dict[int, Counter[str]] = field(default_factory=dict)

    def compare(self, lefts: Statements, rights: Statements) -> list[Difference]:
        """The differences between two lists of statements, in their order."""
        self._lists(lefts, rights, *self.ends)
        return self._with_moves()

    # --- lists ----------------------------------------------------------------------------------

    def _lists(
        self, lefts: Statements, rights: Statements, left: Place | None, right: Place | None
    ) -> None:
        """`left` and `right` are the places before the lists: where missing statements would be."""
        run: list[tuple[m.Statement | None, m.Statement | None]] = []
        for x, r in aligned(lefts, rights, self._similarity):
            if x is not None and r is not None:
                self._run(run, left, right)
                run = []
                left, right = self._place(self.left, x) or left, self._place(self.right, r) or right
                self._pair(x, r, left, right)
            else:
                run.append((x, r))
        self._run(run, left, right)

    def _run(
        self,
        run: Sequence[tuple[m.Statement | None, m.Statement | None]],
        left: Place | None,
        right: Place | None,
    ) -> None:
        """Statements without partners between two pairs; what may be one unread, is unknown."""
        lefts = [x for x, _ in run if x is not None]
        rights = [r for _, r in run if r is not None]
        unread = [self._is_unread(self.left, lefts), self._is_unread(self.right, rights)]
        self._unread(self.left, unread[0], left, right)
        self._unread(self.right, unread[1], left, right)
        lefts = [s for s in lefts if s not in unread[0]] if not unread[1] else []
        rights = [s for s in rights if s not in unread[1]] if not unread[0] else []
        if self._wrapped(lefts, rights, left, right):
            return
        for statement in lefts:
            self._only(self.left, statement, right)
        for statement in rights:
            self._only(self.right, statement, left)

    def _wrapped(
        self,
        lefts: list[m.Statement],
        rights: list[m.Statement],
        left: Place | None,
        right: Place | None,
    ) -> bool:
        """Whether a statement has come, or gone, around others that stayed; then it is told."""
        if not lefts or not rights:
            return False
        around = around_some(rights, lefts)
        if around is not None:
            outer, inner = around
            self._only(self.right, outer, left, self._head_text(self.right, outer))
            at = self._place(self.right, outer) or right
            self._lists(tuple(lefts), with_inner(rights, outer, inner), left, at)
            return True
        around = around_some(lefts, rights)
        if around is None:
            return False
        outer, inner = around
        self._only(self.left, outer, right, self._head_text(self.left, outer))
        at = self._place(self.left, outer) or left
        self._lists(with_inner(lefts, outer, inner), tuple(rights), at, right)
        return True

    def _is_unread(self, tokens: Tokens, statements: list[m.Statement]) -> list[m.Statement]:
        return [s for s in statements if is_unreadable(tokens.written(s))]

    def _unread(
        self,
        tokens: Tokens,
        statements: list[m.Statement],
        left: Place | None,
        right: Place | None,
    ) -> None:
        for statement in statements:
            place = self._place(tokens, statement)
            why = next(
                (u.why for u in tokens.side.given.unread if place and u.place.begins_in(place)),
                "a statement that could not be read",
            )
            places = (place or left, right) if tokens is self.left else (left, place or right)
            self.found.append(Undetermined(self.element, why, *places))

    def _only(
        self, tokens: Tokens, statement: m.Statement, other: Place | None, head: str = ""
    ) -> None:
        """A statement of one side; `head` is what is told of one whose inside is compared."""
        place, text = self._place(tokens, statement), head or self._text(tokens, statement)
        is_left = tokens is self.left
        left, right = (place, other) if is_left else (other, place)
        if not head:
            (self.removed if is_left else self.inserted).append((statement, len(self.found)))
        kind = StatementRemoved if is_left else StatementInserted
        self.found.append(kind(self.element, text, left, right))
        if not head:
            self._unread_inside(tokens, statement, left, right)

    def _unread_inside(
        self, tokens: Tokens, statement: m.Statement, left: Place | None, right: Place | None
    ) -> None:
        """What a whole statement holds that could not be read."""
        inner = [
            node
            for node in m.walk(statement)
            if isinstance(node, m.Empty) and is_unreadable(tokens.written(node))
        ]
        self._unread(tokens, list(inner), left, right)

    # --- pairs ----------------------------------------------------------------------------------

    def _pair(
        self, x: m.Statement, r: m.Statement, left: Place | None, right: Place | None
    ) -> None:
        self._note_locals(x, r)
        if x == r:
            return
        before = len(self.found)
        for part in parts_of(x, r, self.left, self.right):
            match part:
                case StatementPart():
                    self._changed(part, left, right)
                case (lefts, rights):
                    self._lists(lefts, rights, left, right)
        if len(self.found) == before:
            texts = self._text(self.left, x), self._text(self.right, r)
            if texts[0] == texts[1]:
                texts = apart_by_reference(texts[0], (self.left, x), (self.right, r))
            self.found.append(Changed(self.element, Aspect.EXPRESSION, "", *texts, left, right))

    def _changed(self, part: StatementPart, left: Place | None, right: Place | None) -> None:
        places = (
            self._place(self.left, part.left) or left if part.left is not None else left,
            self._place(self.right, part.right) or right if part.right is not None else right,
        )
        aspect = part.aspect
        if aspect is Aspect.AFTER and self._is_own(part.of):
            aspect = Aspect.PERIOD
        texts = self._shown(self.left, part.left), self._shown(self.right, part.right)
        if texts[0] == texts[1]:
            texts = apart_by_reference(texts[0], (self.left, part.left), (self.right, part.right))
        self.found.append(Changed(self.element, aspect, part.of, texts[0], texts[1], *places))

    def _is_own(self, of: str) -> bool:
        """Whether a send starts its own server again: then `after` is a period."""
        return self.element.kind == "msgsrv" and of in _own_sends(self.element)

    def _note_locals(self, x: m.Statement, r: m.Statement) -> None:
        """Locals that two statements declare in one place; also what is inside of equal ones."""
        both = zip(m.walk(x), m.walk(r), strict=True) if x == r else ((x, r),)
        for one, other in both:
            first, second = _declaration(one), _declaration(other)
            if first is not None and second is not None:
                self.pairs += [
                    (self.left.written(a), self.right.written(b))
                    for a, b in zip(first.declarators, second.declarators, strict=False)
                ]

    # --- moves ----------------------------------------------------------------------------------

    def _with_moves(self) -> list[Difference]:
        """A statement that went in one place and came in another has moved."""
        gone: set[int] = set()
        for statement, at in self.removed:
            for other, index in self.inserted:
                if index not in gone and other == statement and other != m.Empty():
                    text = self._text(self.left, statement)
                    places = self.found[at].left, self.found[index].right
                    self.found[at] = StatementMoved(self.element, text, *places)
                    gone.add(index)
                    break
        return [d for i, d in enumerate(self.found) if i not in gone]

    # --- texts and similarity -------------------------------------------------------------------

    def _similarity(self, x: m.Statement, r: m.Statement) -> float:
        if type(x) is not type(r) or UNREADABLE in (_note(self.left, x), _note(self.right, r)):
            return 0.0
        nests = head_of(x) is not x
        heads = overlap(words_of(head_of(x)), words_of(head_of(r))) * 0.95 if nests else 0.0
        if heads > 0.9:
            return heads  # what is inside need not be looked at
        whole = overlap(self._words(x), self._words(r))
        return max(whole, heads, ALIKE if are_akin(x, r) else 0.0)

    def _words(self, statement: m.Statement) -> Counter[str]:
        if id(statement) not in self.words:
            self.words[id(statement)] = words_of(statement)
        return self.words[id(statement)]

    def _text(self, tokens: Tokens, statement: m.Statement) -> str:
        return " ".join(print_statement(tokens.written(statement)).split())

    def _head_text(self, tokens: Tokens, statement: m.Statement) -> str:
        written = tokens.written(statement)
        if isinstance(written, m.Block):
            return "{...}"
        return " ".join(print_statement(head_of(written)).split()).replace("{}", "{...}")

    def _shown(self, tokens: Tokens, node: object) -> str:
        written = tokens.written(node)
        match written:
            case None:
                return ""
            case m.Type():
                return str(written)
            case m.Annotation():
                return print_line(written).strip()
            case tuple():
                return ", ".join(self._shown(tokens, each) for each in written)
            case m.ArrayInitializer(values):
                return "{" + ", ".join(self._shown(tokens, v) for v in values) + "}"
            case m.Declaration():
                return print_line(written).strip().removesuffix(";")
            case str():
                return written
            case _:
                text = print_statement(m.Return(written))  # type: ignore[arg-type]
                return text.removeprefix("return ").removesuffix(";")

    def _place(self, tokens: Tokens, node: object) -> Place | None:
        written = tokens.written(node)
        if isinstance(written, tuple):
            written = written[0] if written else None
        return tokens.side.place(getattr(written, "span", NOWHERE))


def _own_sends(element: Element) -> tuple[str, ...]:
    name = element.path.rpartition(".")[2]
    return (name, f"self.{name}")


def _note(tokens: Tokens, statement: m.Statement) -> str:
    return UNREADABLE if is_unreadable(tokens.written(statement)) else ""


def _declaration(statement: m.Node) -> m.Declaration | None:
    match statement:
        case m.Local(declaration):
            return declaration
        case m.For(m.Declaration() as declaration):
            return declaration
        case _:
            return None
