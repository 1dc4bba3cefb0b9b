"""Two models of which one's elements go into the text of the other."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field, replace
from typing import TypeVar

from rebsync import model as m
from rebsync.printing import print_line
from rebsync.records import dataclass
from rebsync.roundtrip.diff.difference import Depth
from rebsync.roundtrip.diff.matching import Matching, matched, names_of
from rebsync.roundtrip.diff.normal_form import with_starts
from rebsync.roundtrip.diff.operands import Item, Operand
from rebsync.roundtrip.diff.tokens import Tokens
from rebsync.roundtrip.merge.patch.bodies import BodyPatch
from rebsync.roundtrip.merge.patch.text import TextPatch
from rebsync.source import Span

_Node = TypeVar("_Node")
SECTIONS = {"statevar": m.StateVars, "knownrebec": m.KnownRebecs}


@dataclass(frozen=True, slots=True)
class DeclaredVariable:
    """A variable as it is in the text: with the declaration and the section that it is in."""

    declarator: m.Declarator
    declaration: m.Declaration
    section: m.Env | m.StateVars | m.KnownRebecs


@dataclass(slots=True, eq=False)
class Two:
    """The model whose text changes, left, and the one that its elements come from.

    `partners` are the elements of the left one by the `id` of those of the right one, `gone` the
    places of those that are taken out.
    """

    left: Operand
    right: Operand
    matching: Matching
    bodies: BodyPatch
    out: TextPatch
    partners: dict[int, Item] = field(default_factory=dict)
    gone: set[Span] = field(default_factory=set)

    @classmethod
    def of(cls, left: Operand, right: Operand) -> Two:
        matching = matched(left, right)
        first, second = names_of(matching)
        out = TextPatch(left.given.source.text)
        printed = Tokens(replace(right, depth=Depth.IDENTICAL), second, bare=True)
        bodies = BodyPatch(Tokens(left, first), Tokens(right, second), printed, out)
        return cls(left, right, matching, bodies, out, {id(r): x for x, r in matching.pairs})

    def written(self, node: _Node) -> _Node:
        """A node of the right one as it is to be written into the left one."""
        made = self.bodies.printed.of(node)
        return with_starts(made) if self.right.in_python else made

    def declared(self, item: Item) -> DeclaredVariable | None:
        """A variable of the model as it is in the text."""
        return next(
            (d for d in variables(self.left.given.model, item) if d.declarator.name == item.name),
            None,
        )

    def line(self, r: Item) -> str:
        assert r.type is not None
        assert isinstance(r.node, m.Declarator)
        printed = self.bodies.printed
        notes = tuple(map(printed.of, r.annotations))
        made = m.Declaration(printed.of(r.type), (printed.of(r.node),), notes)
        return f"{'env ' if r.kind == 'env' else ''}{print_line(made)}"

    def end(self, old: DeclaredVariable) -> int:
        """The place behind a declaration and its semicolon."""
        if isinstance(old.section, m.Env):
            return old.section.span.end
        return self.out.find(";", old.declaration.span.end) + 1


def variables(model: m.Model, item: Item) -> Iterator[DeclaredVariable]:
    """The variables of the kind and class of one of them, as they are in the text."""
    if item.kind == "env":
        for head in model.heads:
            if isinstance(head, m.Env):
                for d in head.declaration.declarators:
                    yield DeclaredVariable(d, head.declaration, head)
        return
    kind = SECTIONS.get(item.kind)
    for each in model.classes:
        if each.name != item.owner or not isinstance(each, m.ReactiveClass) or kind is None:
            continue
        for member in each.members:
            if isinstance(member, kind) and isinstance(member, m.StateVars | m.KnownRebecs):
                for declaration in member.declarations:
                    for d in declaration.declarators:
                        yield DeclaredVariable(d, declaration, member)
