"""Puts elements that only one model has into the text of another: each behind what it follows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rebsync import model as m
from rebsync.printing import print_class, print_line, print_member
from rebsync.records import dataclass
from rebsync.roundtrip.diff.operands import Item
from rebsync.roundtrip.merge.patch.pair import SECTIONS, DeclaredVariable, Two

_CLASSES = ("reactiveclass", "interface")
_BODIES = ("msgsrv", "method", "constructor")


@dataclass(frozen=True, slots=True, eq=False)
class Additions:
    """Adds elements of the right model to the text of the left one."""

    two: Two

    def add(self, items: Sequence[Item]) -> None:
        classes = {i.name for i in items if i.kind in _CLASSES}
        inserts: dict[tuple[int, str], list[str]] = {}
        for item in items:
            if item.owner in classes and item.owner:
                continue
            if item.kind in SECTIONS:
                self._add_variable(item, inserts)
            else:
                at, indent = self._place(item)
                blank = "\n" if item.kind in (*_CLASSES, *_BODIES) else ""
                inserts.setdefault((at, indent), []).append(blank + self._new(item))
        for (at, indent), texts in inserts.items():
            if at == 0:
                self.two.out.insert(0, "".join(f"{text.strip()}\n" for text in texts))
            else:
                self.two.out.after(at, "\n".join(texts), indent)

    def _new(self, item: Item) -> str:
        printed, written = self.two.bodies.printed, self.two.written
        match item.node:
            case m.ReactiveClass() | m.Interface() as node:
                text = print_class(self._renamed(written(node)))
            case m.Rebec() as node:
                return print_line(printed.of(node))
            case m.Constructor() as node:
                made = replace(written(node), name=printed.class_name(item.owner))
                text = print_member(made)
            case m.MessageServer() | m.Method() as node:
                text = print_member(written(node))
            case _:
                return self.two.line(item)
        return self.two.out.printed(text.removesuffix("\n"))

    def _renamed(self, node: m.ReactiveClass | m.Interface) -> m.ReactiveClass | m.Interface:
        name = self.two.bodies.printed.class_name
        if isinstance(node, m.Interface):
            return replace(node, extends=tuple(map(name, node.extends)))
        extends = name(node.extends) if node.extends else None
        return replace(node, extends=extends, implements=tuple(map(name, node.implements)))

    def _place(self, item: Item) -> tuple[int, str]:
        """Behind what a new element goes, and its indentation; 0 is the start of the text."""
        model = self.two.left.given.model
        previous = self._previous(item)
        if previous is not None:
            span = previous.span
            return span.end, self.two.out.indent_at(span.start)
        match item.kind:
            case "rebec":
                assert model.main is not None
                opening = self.two.out.find("{", model.main.span.start) + 1
                return opening, self.two.out.indent_at(model.main.span.start) + self.two.out.step
            case _ if item.owner:
                owner = self._owner(item)
                start = owner.name_span.end
                opening = self.two.out.find("{", start) + 1
                return opening, self.two.out.indent_at(owner.span.start) + self.two.out.step
            case _:
                return 0, ""

    def _owner(self, item: Item) -> m.ReactiveClass | m.Interface:
        name = self.two.bodies.right.class_name(item.owner)
        return next(c for c in self.two.left.given.model.classes if c.name == name)

    def _previous(self, item: Item) -> m.Node | None:
        """What a new element follows in the text: the one before it, or the last of its kind."""
        model = self.two.left.given.model
        if item.kind in _CLASSES:
            return self._last(model.classes)
        if item.kind == "env":
            return self._last([h for h in model.heads if isinstance(h, m.Env)])
        before: Item | None = None
        for each in self.two.right.items:
            if each is item:
                break
            alike = each.kind == item.kind if item.kind == "rebec" else each.kind in _BODIES
            x = self.two.partners.get(id(each))
            if alike and each.owner == item.owner and x and x.node.span not in self.two.gone:
                before = x
        if before is not None and not isinstance(before.node, m.Declarator):
            return before.node
        if item.kind == "rebec":
            return self._last(model.main.rebecs) if model.main is not None else None
        owner = self._owner(item)
        members = owner.members if isinstance(owner, m.ReactiveClass) else owner.servers
        return self._last([x for x in members if isinstance(x, m.KnownRebecs | m.StateVars)])

    def _last(self, nodes: Sequence[m.Node]) -> m.Node | None:
        return next((n for n in reversed(nodes) if n.span not in self.two.gone), None)

    def _add_variable(self, item: Item, inserts: dict[tuple[int, str], list[str]]) -> None:
        """A variable behind those of its kind that are before it, or in a section of its own."""
        before: DeclaredVariable | None = None
        for each in self.two.right.items:
            if each is item:
                break
            x = self.two.partners.get(id(each))
            same = each.kind == item.kind and each.owner == item.owner
            if same and x and x.node.span not in self.two.gone:
                before = self.two.declared(x)
        if before is not None:
            indent = self.two.out.indent_at(before.declaration.span.start)
            inserts.setdefault((self.two.end(before), indent), []).append(self.two.line(item))
            return
        owner = self._owner(item)
        members = owner.members if isinstance(owner, m.ReactiveClass) else ()
        section = next((x for x in members if isinstance(x, SECTIONS[item.kind])), None)
        indent = self.two.out.indent_at(owner.span.start) + self.two.out.step
        if section is not None:
            at = self.two.out.find("{", section.span.start) + 1
            inserts.setdefault((at, indent + self.two.out.step), []).append(self.two.line(item))
            return
        at = self.two.out.find("{", owner.name_span.end) + 1
        key = (at, indent)
        word = {"statevar": "statevars", "knownrebec": "knownrebecs"}[item.kind]
        texts = inserts.setdefault(key, [])
        head = f"{word} {{\n"
        known = next((i for i, t in enumerate(texts) if t.startswith(head)), None)
        line = f"{self.two.out.step}{self.two.line(item)}\n}}"
        if known is None:
            texts.append(f"{head}{line}")
        else:
            texts[known] = texts[known].removesuffix("}") + line
