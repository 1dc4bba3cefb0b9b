"""Puts the changes of a body into the text of the model: only what changed gets a new text."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields

from rebsync import model as m
from rebsync.precedence import LOWEST, binding
from rebsync.printing import print_expression, print_statement
from rebsync.records import dataclass
from rebsync.reverse.models.building import bare
from rebsync.roundtrip.diff.alignment import aligned, overlap
from rebsync.roundtrip.diff.normal_form import joined_starts, with_starts
from rebsync.roundtrip.diff.similarity import head_of
from rebsync.roundtrip.diff.tokens import Tokens
from rebsync.roundtrip.merge.patch.text import TextPatch, dedented
from rebsync.source import NOWHERE, Span

_WORD = re.compile(r"\w+|[^\w\s(){},;.]+")
_OPERANDS = m.Binary | m.Unary | m.Postfix | m.Cast | m.InstanceOf | m.Conditional
_STATEMENTS = m.Block | m.If | m.While | m.For | m.Switch


@dataclass(frozen=True, slots=True, eq=False)
class BodyPatch:
    """Two models of which the first one's text becomes what the second one says.

    `printed` makes the trees of the second one as they are to be written: with the first one's
    names for what both have.
    """

    left: Tokens
    right: Tokens
    printed: Tokens
    out: TextPatch

    def same(self, x: object, r: object) -> bool:
        """Whether two nodes, or two lists of nodes, say the same."""
        if isinstance(x, tuple) and isinstance(r, tuple):
            return len(x) == len(r) and all(map(self.same, x, r))
        if not (hasattr(x, "__dataclass_fields__") and hasattr(r, "__dataclass_fields__")):
            return x == r
        return bool(self.left.of(x) == self.right.of(r))

    # --- statements -----------------------------------------------------------------------------

    def body(self, x: m.Statement, r: m.Statement) -> bool:
        """The body of a callable, a branch or a loop; False where that cannot be done in place."""
        if self.same(x, r):
            return True
        if not (isinstance(x, m.Block) and isinstance(r, m.Block)):
            return self.statement(x, r)
        if x.annotations != r.annotations:
            return False
        if x.span != NOWHERE:
            return self._lists(x.statements, r.statements, x.span)
        *starts, only = x.statements  # braces that are not in the text
        if starts:
            mark = len(self.out.edits)
            if len(x.statements) == len(r.statements) and all(
                map(self._in_place, x.statements, r.statements)
            ):
                return True
            self.out.take_back(mark)
            return self._whole(only, r)
        if len(r.statements) == 1 and self.statement(only, r.statements[0]):
            return True
        return self._whole(only, r)

    def statement(self, x: m.Statement, r: m.Statement) -> bool:
        """A statement; False where its text has no place of its own."""
        if self.same(x, r):
            return True
        return self._in_place(x, r) or self._whole(x, r)

    def _in_place(self, x: m.Statement, r: m.Statement) -> bool:
        """Changes parts of a statement; False, and nothing changed, where that is not enough."""
        mark = len(self.out.edits)
        if self.same(x, r):
            return True
        if type(x) is type(r) and self.same(x.annotations, r.annotations) and self._inside(x, r):
            return True
        self.out.take_back(mark)
        return False

    def _whole(self, x: m.Statement, r: m.Statement) -> bool:
        if x.span == NOWHERE:
            return False
        self.out.replace(x.span, self._text(r))
        return True

    def _inside(self, x: m.Statement, r: m.Statement) -> bool:
        match x, r:
            case (m.If(), m.If()):
                return (
                    self.expression(x.condition, r.condition)
                    and self.body(x.then, r.then)
                    and self._otherwise(x, r)
                )
            case (m.While(), m.While()):
                return self.expression(x.condition, r.condition) and self.body(x.body, r.body)
            case (m.For(), m.For()):
                return self._parts(x, r, but=("body",)) and self.body(x.body, r.body)
            case (m.Switch(), m.Switch()):
                return self._switch(x, r)
            case (m.Block(), m.Block()):
                return self.body(x, r)
            case _:
                return self._parts(x, r)

    def _otherwise(self, x: m.If, r: m.If) -> bool:
        old, new = x.otherwise, r.otherwise
        if old is not None and new is not None:
            return self.body(old, new)
        if old is not None:
            last = x.then if x.then.span != NOWHERE else _only(x.then)
            self.out.replace(Span(last.span.end, x.span.end), "")
        elif new is not None:
            if x.then.span == NOWHERE:
                return False
            indent = self.out.indent_at(x.then.span.start)
            text = self._text(new).replace("\n", f"\n{indent}")
            self.out.insert(x.then.span.end, f" else {text}")
        return True

    def _switch(self, x: m.Switch, r: m.Switch) -> bool:
        if len(x.cases) != len(r.cases) or not self.expression(x.subject, r.subject):
            return False
        for old, new in zip(x.cases, r.cases, strict=True):
            if not self.same(old.value, new.value) or old.annotations != new.annotations:
                return False
            if not self._lists(old.statements, new.statements, None):
                return False
        return True

    def _lists(
        self, xs: Sequence[m.Statement], rs: Sequence[m.Statement], block: Span | None
    ) -> bool:
        """Statements one after the other, in a block or in a case."""
        lefts, rights = [self.left.of(s) for s in xs], [self.right.of(s) for s in rs]
        if any(s.span == NOWHERE for s in xs) or (block is None and not xs and rs):
            return False
        heads = Heads.of(xs)
        pairs = [
            (
                self.left.written(x) if x is not None else None,
                self.right.written(r) if r is not None else None,
            )
            for x, r in aligned(lefts, rights, _similarity)
        ]
        added = [r for x, r in pairs if x is None]
        apart = [x for x, r in pairs if x is not None and r is None]
        gone = [x for x in apart if any(self.same(x, r) for r in added)]
        last: m.Statement | None = None
        for run in _runs(pairs):
            old, new = run[0]
            if old is not None and new is not None:
                if not (self._in_place(old, new) if old in heads else self.statement(old, new)):
                    return False
                last = old
                continue
            olds = [x for x, _ in run if x is not None]
            news = [r for _, r in run if r is not None]
            if not heads.go_whole(olds) or (last in heads and len(news) > len(olds)):
                return False
            olds = [x for x in olds if x not in heads]
            if self.printed.side.in_python:
                news = list(joined_starts(news))
            for x in (x for x in olds if x in gone):
                self.out.remove(x.span)
            olds = [x for x in olds if x not in gone]
            if news and not olds and last is None and block is None:
                return False
            last = self._run(olds, news, last, block, gone)
        return True

    def _run(
        self,
        old: Sequence[m.Statement],
        new: Sequence[m.Statement],
        last: m.Statement | None,
        block: Span | None,
        gone: Sequence[m.Statement],
    ) -> m.Statement | None:
        """Statements that came in place of others; gives the last one that is there before."""
        texts = [self._carried(r, gone) for r in new]
        for x, text in zip(old, texts, strict=False):
            self.out.replace(x.span, text)
            last = x
        for x in old[len(texts) :]:
            self.out.remove(x.span)
        if texts[len(old) :]:
            rest = "\n".join(texts[len(old) :])
            if last is not None:
                self.out.after(last.span.end, rest, self.out.indent_at(last.span.start))
            elif block is not None:
                self.out.within(block, rest)
        return last

    def _carried(self, r: m.Statement, gone: Sequence[m.Statement]) -> str:
        """The text of a statement: the one it has in the model, if it was elsewhere there."""
        for x in gone:
            if self.same(x, r):
                span = x.span
                text = self.out.text[span.start : span.end]
                remark = self.out.remark_of(span)
                return remark + dedented(text, self.out.indent_at(span.start))
        return self._text(r)

    def _text(self, r: m.Statement) -> str:
        made = self.printed.of(r)
        made = with_starts(made) if self.printed.side.in_python else made
        return self.out.printed(print_statement(made))

    # --- expressions ----------------------------------------------------------------------------

    def expression(self, x: m.Expression, r: m.Expression, least: int = LOWEST) -> bool:
        """An expression, in a place where only operators that bind so tightly may stand."""
        if self.same(x, r):
            return True
        if isinstance(x, m.Paren):
            return self.expression(x.inner, bare(r))
        mark = len(self.out.edits)
        inner = bare(r)
        if type(x) is type(inner) and self._parts(x, inner):
            return True
        self.out.take_back(mark)
        if x.span == NOWHERE:
            return False
        text = print_expression(self.printed.of(inner))
        self.out.replace(x.span, f"({text})" if binding(inner) < least else text)
        return True

    def _parts(self, x: object, r: object, but: tuple[str, ...] = ()) -> bool:
        """The parts of two nodes of one kind."""
        first, second = self.left.of(x), self.right.of(r)
        if type(first) is not type(x) or type(second) is not type(r):
            return False  # what has no effect is compared without: then the whole is replaced
        for each in fields(x):  # type: ignore[arg-type]
            if not each.compare or each.name in but:
                continue
            old, new = getattr(x, each.name), getattr(r, each.name)
            if getattr(first, each.name) == getattr(second, each.name):
                continue
            if isinstance(old, tuple) and isinstance(new, tuple):
                if len(old) != len(new):
                    return False
                pairs = list(zip(old, new, strict=True))
            else:
                pairs = [(old, new)]
            if not all(self._part(x, a, b, each.name) for a, b in pairs):
                return False
        return True

    def _part(self, parent: object, x: object, r: object, name: str) -> bool:
        if isinstance(x, m.Declaration | m.Declarator) and type(x) is type(r):
            return self._parts(x, r)
        if isinstance(x, m.Expression) and isinstance(r, m.Expression):
            return self.expression(x, r, _least(parent, x, name))
        return self.same(x, r)


def _least(parent: object, x: m.Expression, name: str) -> int:
    """How tightly what stands in place of a part must bind, so that it needs no parentheses."""
    match parent:
        case m.Binary():  # which group from the left
            return binding(parent) + (name == "right")
        case _ if isinstance(parent, _OPERANDS) or name == "target":
            return binding(x)
        case _:
            return LOWEST


@dataclass(frozen=True, slots=True, eq=False)
class Heads:
    """The statements that are in the heads of loops as written, each with its loop, by `id`."""

    loops: Mapping[int, int]

    @classmethod
    def of(cls, statements: Sequence[m.Statement]) -> Heads:
        """Those among some statements one after the other."""
        loops = [s for s in statements if isinstance(s, m.For)]
        inside = ((s, f) for s in statements for f in loops if s is not f and f.span.holds(s.span))
        return cls({id(s): id(f) for s, f in inside})

    def __contains__(self, statement: object) -> bool:
        return id(statement) in self.loops

    def go_whole(self, gone: Sequence[m.Statement]) -> bool:
        """Whether with each loop its start goes, and with each start its loop."""
        found = {id(s) for s in gone}
        return all((s in found) == (f in found) for s, f in self.loops.items())


def _only(block: m.Statement) -> m.Statement:
    """The statement that braces were put around."""
    return block.statements[-1] if isinstance(block, m.Block) else block


_Pair = tuple["m.Statement | None", "m.Statement | None"]


def _runs(pairs: Sequence[_Pair]) -> Iterator[Sequence[_Pair]]:
    """Each pair of two by itself, and what is between as one."""
    run: list[_Pair] = []
    for x, r in pairs:
        if x is None or r is None:
            run.append((x, r))
            continue
        if run:
            yield run
        run = []
        yield ((x, r),)
    if run:
        yield run


def _similarity(x: m.Statement, r: m.Statement) -> float:
    if type(x) is not type(r):
        return 0.0
    heads = [_words(head_of(s)) for s in (x, r)]
    inside = overlap(_words(x), _words(r))
    return max(inside, 0.95 * overlap(*heads)) if isinstance(x, _STATEMENTS) else inside


def _words(statement: m.Statement) -> Counter[str]:
    return Counter(_WORD.findall(print_statement(statement)))
