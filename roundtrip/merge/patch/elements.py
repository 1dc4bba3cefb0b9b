"""Puts elements of one model into the text of another: what is not about them keeps its bytes."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeAlias

from rebsync import model as m
from rebsync.printing import print_class, print_expression, print_line, print_member
from rebsync.records import dataclass
from rebsync.roundtrip.diff.difference import Depth
from rebsync.roundtrip.diff.matching import Pair
from rebsync.roundtrip.diff.operands import Item, SourcedModel, two_sides
from rebsync.roundtrip.merge.patch.additions import Additions
from rebsync.roundtrip.merge.patch.pair import DeclaredVariable, Two
from rebsync.source import NOWHERE, Span

_CLASSES = ("reactiveclass", "interface")
_Callable: TypeAlias = m.Constructor | m.MessageServer | m.Method


def patched(
    today: SourcedModel, code: SourcedModel, wanted: Callable[[Item | None, Item | None], bool]
) -> str:
    """The text of today's model with those elements as in the code that are wanted.

    `wanted` is asked of each element, as it is in the model and in the code; None where one of the
    two does not have it.
    """
    left, right = two_sides(today, code, Depth.EQUAL)
    return _Patch(Two.of(left, right)).result(wanted)


@dataclass(slots=True, eq=False)
class _Patch:
    two: Two

    def result(self, wanted: Callable[[Item | None, Item | None], bool]) -> str:
        moved = [p for p in self.two.matching.pairs if self._is_moved(p)]
        for x, r in self.two.matching.pairs:
            if wanted(x, r) and (x, r) not in moved:
                self._pair(x, r)
        out = [x for x in self.two.matching.lefts if wanted(x, None)]
        new = [r for r in self.two.matching.rights if wanted(None, r)]
        for pair in moved:
            if wanted(*pair):
                out.append(pair[0])
                new.append(pair[1])
        self._remove(out)
        order = {id(item): i for i, item in enumerate(self.two.right.items)}
        Additions(self.two).add(sorted(new, key=lambda item: order[id(item)]))
        return self.two.out.result()

    def _is_moved(self, pair: Pair) -> bool:
        x, r = pair
        return bool(x.owner) and self.two.bodies.right.class_name(r.owner) != x.owner

    # --- changed --------------------------------------------------------------------------------

    def _pair(self, x: Item, r: Item) -> None:
        match x.node, r.node:
            case (m.Declarator(), m.Declarator()):
                self._variable(x, r)
            case (m.Rebec() as a, m.Rebec() as b):
                self._rebec(a, b)
            case (m.ReactiveClass() | m.Interface() as a, m.ReactiveClass() | m.Interface() as b):
                self._class_head(a, b)
            case (
                m.Constructor() | m.MessageServer() | m.Method() as a,
                m.Constructor() | m.MessageServer() | m.Method() as b,
            ):
                self._callable(a, b)

    def _callable(self, x: _Callable, r: _Callable) -> None:
        made = self.two.written(r)
        made = replace(made, name=x.name if isinstance(x, m.Constructor) else r.name)
        whole = self.two.out.printed(print_member(made))
        if x.body is None or r.body is None:
            if (x.body is None) != (r.body is None) or not self._is_head_same(x, r):
                self.two.out.replace(x.span, whole)
            return
        mark = len(self.two.out.edits)
        if not self._is_head_same(x, r):
            same = self.two.bodies.same(x.annotations, r.annotations)
            start = _past(self.two.out.text, x.annotations, x.span.start) if same else x.span.start
            shown = replace(made, body=None, annotations=() if same else made.annotations)
            head = print_member(shown).removesuffix("\n").removesuffix(";")
            self.two.out.replace(Span(start, x.body.span.start), f"{head} ")
        if not self.two.bodies.body(x.body, r.body):
            self.two.out.take_back(mark)
            self.two.out.replace(x.span, whole)

    def _is_head_same(self, x: _Callable, r: _Callable) -> bool:
        heads = [
            print_member(replace(tokens.of(node), body=None))
            for tokens, node in ((self.two.bodies.left, x), (self.two.bodies.right, r))
        ]
        if isinstance(x, m.Constructor) and isinstance(r, m.Constructor):
            heads[1] = heads[1].replace(f"{r.name}(", f"{x.name}(", 1)
        return heads[0] == heads[1]

    def _class_head(
        self, x: m.ReactiveClass | m.Interface, r: m.ReactiveClass | m.Interface
    ) -> None:
        text = self.two.out.text
        name = self.two.bodies.right.class_name
        if isinstance(r, m.Interface):
            bare: m.ReactiveClass | m.Interface = replace(
                r, name=x.name, servers=(), extends=tuple(map(name, r.extends))
            )
            same = isinstance(x, m.Interface) and x.extends == bare.extends
        else:
            bare = replace(
                r,
                name=x.name,
                members=(),
                extends=name(r.extends) if r.extends else None,
                implements=tuple(map(name, r.implements)),
            )
            same = isinstance(x, m.ReactiveClass) and _head_of(x) == _head_of(bare)
        noted = self.two.bodies.same(x.annotations, r.annotations)
        if same and noted:
            return
        start = x.span.start
        if noted:
            start = _past(text, x.annotations, start)
            bare = replace(bare, annotations=())
        opening = self.two.out.find("{", max(start, x.name_span.end))
        head = print_class(bare).rstrip().removesuffix("{}").rstrip()
        end = opening - (text[opening - 1] == " ")
        self.two.out.replace(Span(start, end), head)

    def _rebec(self, x: m.Rebec, r: m.Rebec) -> None:
        same = self.two.bodies.same
        alike = same(x.type, r.type) and same(x.annotations, r.annotations)
        mark = len(self.two.out.edits)
        if alike and x.name == r.name:
            pairs = ((x.bindings, r.bindings), (x.arguments, r.arguments))
            if all(len(a) == len(b) for a, b in pairs) and all(
                self._given(a, b) for one, other in pairs for a, b in zip(one, other, strict=True)
            ):
                return
        self.two.out.take_back(mark)
        self.two.out.replace(x.span, print_line(self.two.bodies.printed.of(r)))

    def _given(self, x: m.Expression, r: m.Expression) -> bool:
        if not self.two.bodies.same(x, r):
            if x.span == NOWHERE:
                return False
            self.two.out.replace(x.span, print_expression(self.two.bodies.printed.of(r)))
        return True

    # --- variables ------------------------------------------------------------------------------

    def _variable(self, x: Item, r: Item) -> None:
        old = self.two.declared(x)
        if old is None or not isinstance(x.node, m.Declarator):
            return
        assert isinstance(r.node, m.Declarator)
        same_type = self.two.bodies.same(x.type, r.type)
        if same_type and self.two.bodies.same(x.annotations, r.annotations) and x.name == r.name:
            first, second = x.node.initial, r.node.initial
            if self.two.bodies.same(first, second):
                return
            if old.declarator.initial is not None and second is not None:
                text = self.two.line(r).partition("=")[2].strip().removesuffix(";")
                self.two.out.replace(old.declarator.initial.span, text)
                return
        line = self.two.line(r).removeprefix("env ").removesuffix(";")
        if len(old.declaration.declarators) == 1:
            self.two.out.replace(old.declaration.span, line)
            return
        self._take_out(old)
        at = self.two.end(old)
        indent = self.two.out.indent_at(old.declaration.span.start)
        self.two.out.after(at, self.two.line(r), indent)

    def _take_out(self, old: DeclaredVariable) -> None:
        """One variable out of a declaration of several."""
        all_of = old.declaration.declarators
        at = next(i for i, d in enumerate(all_of) if d is old.declarator)
        if at:
            self.two.out.replace(Span(all_of[at - 1].span.end, all_of[at].span.end), "")
        else:
            self.two.out.replace(Span(all_of[0].span.start, all_of[1].span.start), "")

    # --- removed --------------------------------------------------------------------------------

    def _remove(self, items: Sequence[Item]) -> None:
        classes = {i.name for i in items if i.kind in _CLASSES}
        rest = [i for i in items if not (i.owner in classes and i.owner)]
        variables = [d for i in rest if (d := self.two.declared(i)) is not None]
        declarations = {id(d.declaration): d for d in variables}
        for item in rest:
            self.two.gone.add(item.node.span)
            if not isinstance(item.node, m.Declarator):
                self.two.out.remove(item.node.span, above=True)
        names = {id(d.declarator) for d in variables}
        for one in declarations.values():
            if all(id(d) in names for d in one.declaration.declarators):
                is_env = isinstance(one.section, m.Env)
                span = one.section.span if is_env else one.declaration.span
                self.two.out.remove(Span(span.start, self.two.end(one)), above=is_env)
                continue
            self._take_some_out(one.declaration, names)

    def _take_some_out(self, declaration: m.Declaration, names: set[int]) -> None:
        """Those variables out of a declaration that go, and what is between them."""
        kept = [d for d in declaration.declarators if id(d) not in names]
        text = ", ".join(self.two.out.text[d.span.start : d.span.end] for d in kept)
        all_of = declaration.declarators
        self.two.out.replace(Span(all_of[0].span.start, all_of[-1].span.end), text)


def _head_of(node: m.ReactiveClass) -> tuple[object, ...]:
    return node.queue_length, node.abstract, node.extends, node.implements


def _past(text: str, annotations: Sequence[m.Annotation], start: int) -> int:
    """Where an element begins behind its annotations."""
    at = max([start, *(a.span.end for a in annotations)])
    found = re.compile(r"\s*").match(text, at)
    return found.end() if found is not None else at
