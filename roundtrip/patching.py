"""Puts elements of one model into the text of another: what is not about them keeps its bytes."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import field, replace
from typing import TypeAlias

from rebsync import model as m
from rebsync.printing import print_class, print_expression, print_line, print_member
from rebsync.records import dataclass
from rebsync.roundtrip.difference import Depth
from rebsync.roundtrip.matching import Matching, Pair, matched, names_of
from rebsync.roundtrip.patching_bodies import BodyPatch
from rebsync.roundtrip.patching_text import TextPatch
from rebsync.roundtrip.sides import Given, Item, Side, side
from rebsync.roundtrip.tokens import Tokens
from rebsync.source import NOWHERE, Span

_CLASSES = ("reactiveclass", "interface")
_VARIABLES = {"statevar": m.StateVars, "knownrebec": m.KnownRebecs}
_BODIES = ("msgsrv", "method", "constructor")
_INDENT = "  "
_Callable: TypeAlias = m.Constructor | m.MessageServer | m.Method


def patched(today: Given, code: Given, wanted: Callable[[Item | None, Item | None], bool]) -> str:
    """The text of today's model with those elements as in the code that are wanted.

    `wanted` is asked of each element, as it is in the model and in the code; None where one of the
    two does not have it.
    """
    left, right = side(today, Depth.EQUAL), side(code, Depth.EQUAL)
    return _Patch.of(left, right).result(wanted)


@dataclass(frozen=True, slots=True)
class _Declared:
    """A variable as it is in the text: with the declaration and the section that it is in."""

    declarator: m.Declarator
    declaration: m.Declaration
    section: m.Env | m.StateVars | m.KnownRebecs


@dataclass(slots=True, eq=False)
class _Patch:
    left: Side
    right: Side
    matching: Matching
    bodies: BodyPatch
    out: TextPatch
    partners: dict[int, Item] = field(default_factory=dict)
    gone: set[Span] = field(default_factory=set)

    @classmethod
    def of(cls, left: Side, right: Side) -> _Patch:
        matching = matched(left, right)
        first, second = names_of(matching)
        out = TextPatch(left.given.source.text)
        printed = Tokens(replace(right, depth=Depth.IDENTICAL), second)
        bodies = BodyPatch(Tokens(left, first), Tokens(right, second), printed, out)
        return cls(left, right, matching, bodies, out, {id(r): x for x, r in matching.pairs})

    def result(self, wanted: Callable[[Item | None, Item | None], bool]) -> str:
        moved = [p for p in self.matching.pairs if self._is_moved(p)]
        for x, r in self.matching.pairs:
            if wanted(x, r) and (x, r) not in moved:
                self._pair(x, r)
        out = [x for x in self.matching.lefts if wanted(x, None)]
        new = [r for r in self.matching.rights if wanted(None, r)]
        for pair in moved:
            if wanted(*pair):
                out.append(pair[0])
                new.append(pair[1])
        self._remove(out)
        order = {id(item): i for i, item in enumerate(self.right.items)}
        self._add(sorted(new, key=lambda item: order[id(item)]))
        return self.out.result()

    def _is_moved(self, pair: Pair) -> bool:
        x, r = pair
        return bool(x.owner) and self.bodies.right.class_name(r.owner) != x.owner

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
        printed = self.bodies.printed
        made = replace(printed.of(r), name=x.name if isinstance(x, m.Constructor) else r.name)
        whole = print_member(made)
        if x.body is None or r.body is None:
            if (x.body is None) != (r.body is None) or not self._is_head_same(x, r):
                self.out.replace(x.span, whole)
            return
        if not self._is_head_same(x, r):
            same = self.bodies.same(x.annotations, r.annotations)
            start = _past(self.out.text, x.annotations, x.span.start) if same else x.span.start
            shown = replace(made, body=None, annotations=() if same else made.annotations)
            head = print_member(shown).removesuffix("\n").removesuffix(";")
            self.out.replace(Span(start, x.body.span.start), f"{head} ")
        if not self.bodies.body(x.body, r.body):
            self.out.replace(x.span, whole)

    def _is_head_same(self, x: _Callable, r: _Callable) -> bool:
        heads = [
            print_member(replace(tokens.of(node), body=None))
            for tokens, node in ((self.bodies.left, x), (self.bodies.right, r))
        ]
        if isinstance(x, m.Constructor) and isinstance(r, m.Constructor):
            heads[1] = heads[1].replace(f"{r.name}(", f"{x.name}(", 1)
        return heads[0] == heads[1]

    def _class_head(
        self, x: m.ReactiveClass | m.Interface, r: m.ReactiveClass | m.Interface
    ) -> None:
        text = self.out.text
        name = self.bodies.right.class_name
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
        noted = self.bodies.same(x.annotations, r.annotations)
        if same and noted:
            return
        start = x.span.start
        if noted:
            start = _past(text, x.annotations, start)
            bare = replace(bare, annotations=())
        opening = text.index("{", max(start, x.name_span.end))
        head = print_class(bare).rstrip().removesuffix("{}").rstrip()
        end = opening - (text[opening - 1] == " ")
        self.out.replace(Span(start, end), head)

    def _rebec(self, x: m.Rebec, r: m.Rebec) -> None:
        alike = self.bodies.same(x.type, r.type) and self.bodies.same(x.annotations, r.annotations)
        mark = len(self.out.edits)
        if alike and x.name == r.name:
            pairs = ((x.bindings, r.bindings), (x.arguments, r.arguments))
            if all(len(a) == len(b) for a, b in pairs) and all(
                self._given(a, b) for one, other in pairs for a, b in zip(one, other, strict=True)
            ):
                return
        self.out.take_back(mark)
        self.out.replace(x.span, print_line(self.bodies.printed.of(r)))

    def _given(self, x: m.Expression, r: m.Expression) -> bool:
        if not self.bodies.same(x, r):
            if x.span == NOWHERE:
                return False
            self.out.replace(x.span, print_expression(self.bodies.printed.of(r)))
        return True

    # --- variables ------------------------------------------------------------------------------

    def _declared(self, item: Item) -> _Declared | None:
        """A variable of the model as it is in the text."""
        return next(
            (d for d in _variables(self.left.given.model, item) if d.declarator.name == item.name),
            None,
        )

    def _line(self, r: Item) -> str:
        assert r.type is not None
        assert isinstance(r.node, m.Declarator)
        printed = self.bodies.printed
        notes = tuple(map(printed.of, r.annotations))
        made = m.Declaration(printed.of(r.type), (printed.of(r.node),), notes)
        return f"{'env ' if r.kind == 'env' else ''}{print_line(made)}"

    def _variable(self, x: Item, r: Item) -> None:
        old = self._declared(x)
        if old is None or not isinstance(x.node, m.Declarator):
            return
        assert isinstance(r.node, m.Declarator)
        same_type = self.bodies.same(x.type, r.type)
        if same_type and self.bodies.same(x.annotations, r.annotations) and x.name == r.name:
            first, second = x.node.initial, r.node.initial
            if self.bodies.same(first, second):
                return
            if old.declarator.initial is not None and second is not None:
                text = self._line(r).partition("=")[2].strip().removesuffix(";")
                self.out.replace(old.declarator.initial.span, text)
                return
        line = self._line(r).removeprefix("env ").removesuffix(";")
        if len(old.declaration.declarators) == 1:
            self.out.replace(old.declaration.span, line)
            return
        self._take_out(old)
        at = self._end(old)
        indent = self.out.indent_at(old.declaration.span.start)
        self.out.after(at, self._line(r), indent)

    def _end(self, old: _Declared) -> int:
        """The place behind a declaration and its semicolon."""
        if isinstance(old.section, m.Env):
            return old.section.span.end
        return self.out.text.index(";", old.declaration.span.end) + 1

    def _take_out(self, old: _Declared) -> None:
        """One variable out of a declaration of several."""
        all_of = old.declaration.declarators
        at = next(i for i, d in enumerate(all_of) if d is old.declarator)
        if at:
            self.out.replace(Span(all_of[at - 1].span.end, all_of[at].span.end), "")
        else:
            self.out.replace(Span(all_of[0].span.start, all_of[1].span.start), "")

    # --- removed --------------------------------------------------------------------------------

    def _remove(self, items: Sequence[Item]) -> None:
        classes = {i.name for i in items if i.kind in _CLASSES}
        rest = [i for i in items if not (i.owner in classes and i.owner)]
        variables = [d for i in rest if (d := self._declared(i)) is not None]
        declarations = {id(d.declaration): d for d in variables}
        for item in rest:
            self.gone.add(item.node.span)
            if not isinstance(item.node, m.Declarator):
                self.out.remove(item.node.span, above=True)
        names = {id(d.declarator) for d in variables}
        for one in declarations.values():
            if all(id(d) in names for d in one.declaration.declarators):
                self.out.remove(Span(one.section.span.start, self._end(one)), above=True) if (
                    isinstance(one.section, m.Env)
                ) else self.out.remove(Span(one.declaration.span.start, self._end(one)))
                continue
            self._take_some_out(one.declaration, names)

    def _take_some_out(self, declaration: m.Declaration, names: set[int]) -> None:
        """Those variables out of a declaration that go, and what is between them."""
        kept = [d for d in declaration.declarators if id(d) not in names]
        text = ", ".join(self.out.text[d.span.start : d.span.end] for d in kept)
        all_of = declaration.declarators
        self.out.replace(Span(all_of[0].span.start, all_of[-1].span.end), text)

    # --- added ----------------------------------------------------------------------------------

    def _add(self, items: Sequence[Item]) -> None:
        classes = {i.name for i in items if i.kind in _CLASSES}
        inserts: dict[tuple[int, str], list[str]] = {}
        for item in items:
            if item.owner in classes and item.owner:
                continue
            if item.kind in _VARIABLES:
                self._add_variable(item, inserts)
            else:
                at, indent = self._place(item)
                blank = "\n" if item.kind in (*_CLASSES, *_BODIES) else ""
                inserts.setdefault((at, indent), []).append(blank + self._new(item))
        for (at, indent), texts in inserts.items():
            if at == 0:
                self.out.insert(0, "".join(f"{text.strip()}\n" for text in texts))
            else:
                self.out.after(at, "\n".join(texts), indent)

    def _new(self, item: Item) -> str:
        printed = self.bodies.printed
        match item.node:
            case m.ReactiveClass() | m.Interface() as node:
                return print_class(self._renamed(printed.of(node))).removesuffix("\n")
            case m.Rebec() as node:
                return print_line(printed.of(node))
            case m.Constructor() as node:
                made = replace(printed.of(node), name=printed.class_name(item.owner))
                return print_member(made).removesuffix("\n")
            case m.MessageServer() | m.Method() as node:
                return print_member(printed.of(node)).removesuffix("\n")
            case _:
                return self._line(item)

    def _renamed(self, node: m.ReactiveClass | m.Interface) -> m.ReactiveClass | m.Interface:
        name = self.bodies.printed.class_name
        if isinstance(node, m.Interface):
            return replace(node, extends=tuple(map(name, node.extends)))
        extends = name(node.extends) if node.extends else None
        return replace(node, extends=extends, implements=tuple(map(name, node.implements)))

    def _place(self, item: Item) -> tuple[int, str]:
        """Behind what a new element goes, and its indentation; 0 is the start of the text."""
        model = self.left.given.model
        previous = self._previous(item)
        if previous is not None:
            span = previous.span
            return span.end, self.out.indent_at(span.start)
        match item.kind:
            case "rebec":
                assert model.main is not None
                opening = self.out.text.index("{", model.main.span.start) + 1
                return opening, self.out.indent_at(model.main.span.start) + _INDENT
            case _ if item.owner:
                owner = self._owner(item)
                start = owner.name_span.end
                opening = self.out.text.index("{", start) + 1
                return opening, self.out.indent_at(owner.span.start) + _INDENT
            case _:
                return 0, ""

    def _owner(self, item: Item) -> m.ReactiveClass | m.Interface:
        name = self.bodies.right.class_name(item.owner)
        return next(c for c in self.left.given.model.classes if c.name == name)

    def _previous(self, item: Item) -> m.Node | None:
        """What a new element follows in the text: the one before it, or the last of its kind."""
        model = self.left.given.model
        if item.kind in _CLASSES:
            return self._last(model.classes)
        if item.kind == "env":
            return self._last([h for h in model.heads if isinstance(h, m.Env)])
        before: Item | None = None
        for each in self.right.items:
            if each is item:
                break
            alike = each.kind == item.kind if item.kind == "rebec" else each.kind in _BODIES
            x = self.partners.get(id(each))
            if alike and each.owner == item.owner and x and x.node.span not in self.gone:
                before = x
        if before is not None and not isinstance(before.node, m.Declarator):
            return before.node
        if item.kind == "rebec":
            return self._last(model.main.rebecs) if model.main is not None else None
        owner = self._owner(item)
        members = owner.members if isinstance(owner, m.ReactiveClass) else owner.servers
        return self._last([x for x in members if isinstance(x, m.KnownRebecs | m.StateVars)])

    def _last(self, nodes: Sequence[m.Node]) -> m.Node | None:
        return next((n for n in reversed(nodes) if n.span not in self.gone), None)

    def _add_variable(self, item: Item, inserts: dict[tuple[int, str], list[str]]) -> None:
        """A variable behind those of its kind that are before it, or in a section of its own."""
        before: _Declared | None = None
        for each in self.right.items:
            if each is item:
                break
            x = self.partners.get(id(each))
            same = each.kind == item.kind and each.owner == item.owner
            if same and x and x.node.span not in self.gone:
                before = self._declared(x)
        if before is not None:
            indent = self.out.indent_at(before.declaration.span.start)
            inserts.setdefault((self._end(before), indent), []).append(self._line(item))
            return
        owner = self._owner(item)
        members = owner.members if isinstance(owner, m.ReactiveClass) else ()
        section = next((x for x in members if isinstance(x, _VARIABLES[item.kind])), None)
        indent = self.out.indent_at(owner.span.start) + _INDENT
        if section is not None:
            at = self.out.text.index("{", section.span.start) + 1
            inserts.setdefault((at, indent + _INDENT), []).append(self._line(item))
            return
        at = self.out.text.index("{", owner.name_span.end) + 1
        key = (at, indent)
        word = {"statevar": "statevars", "knownrebec": "knownrebecs"}[item.kind]
        texts = inserts.setdefault(key, [])
        head = f"{word} {{\n"
        known = next((i for i, t in enumerate(texts) if t.startswith(head)), None)
        line = f"{_INDENT}{self._line(item)}\n}}"
        if known is None:
            texts.append(f"{head}{line}")
        else:
            texts[known] = texts[known].removesuffix("}") + line


# --- texts --------------------------------------------------------------------------------------


def _variables(model: m.Model, item: Item) -> Iterator[_Declared]:
    """The variables of the kind and class of one of them, as they are in the text."""
    if item.kind == "env":
        for head in model.heads:
            if isinstance(head, m.Env):
                for d in head.declaration.declarators:
                    yield _Declared(d, head.declaration, head)
        return
    kind = _VARIABLES.get(item.kind)
    for each in model.classes:
        if each.name != item.owner or not isinstance(each, m.ReactiveClass) or kind is None:
            continue
        for member in each.members:
            if isinstance(member, kind) and isinstance(member, m.StateVars | m.KnownRebecs):
                for declaration in member.declarations:
                    for d in declaration.declarators:
                        yield _Declared(d, declaration, member)


def _head_of(node: m.ReactiveClass) -> tuple[object, ...]:
    return node.queue_length, node.abstract, node.extends, node.implements


def _past(text: str, annotations: Sequence[m.Annotation], start: int) -> int:
    """Where an element begins behind its annotations."""
    at = max([start, *(a.span.end for a in annotations)])
    found = re.compile(r"\s*").match(text, at)
    return found.end() if found is not None else at
