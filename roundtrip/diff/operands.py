"""One of two models that are compared: its elements by name, and what names in it refer to."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import field, replace
from typing import TypeAlias

from rebsync import model as m
from rebsync.diagnostics import RebsyncError
from rebsync.records import dataclass
from rebsync.roundtrip.diff.difference import Depth, Element, Place, place
from rebsync.roundtrip.diff.normal_form import as_in_python, normal
from rebsync.source import NOWHERE, Source, SourceSpan, Span
from rebsync.statements import UNREADABLE
from rebsync.static import Analysis, analyse

Callable: TypeAlias = m.Constructor | m.MessageServer | m.Method
Declared: TypeAlias = m.Declarator | Callable | m.ReactiveClass | m.Interface | m.Rebec

_PYTHON = ".py"
_MARKER = re.compile(r"rebsync:\s*([\w-]+\s+\S+?)\s*(?:-->|\*/)?\s*$")
_COMMENT = ("//", "/*", "*", "#", "<!--")


@dataclass(frozen=True, slots=True)
class UnreadPlace:
    """A place of the code that is not in the model; `within` is the body it belongs to."""

    place: Place
    why: str
    within: str = ""


@dataclass(frozen=True, slots=True)
class SourcedModel:
    """A model to compare, with the text that its plain spans are about.

    `partial` says that it was read from a part of the code: what it lacks may be elsewhere.
    """

    model: m.Model
    source: Source
    unread: tuple[UnreadPlace, ...] = ()
    partial: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Item:
    """An element of a model; `owner` is its class, empty for what has none."""

    kind: str
    name: str
    owner: str
    node: Declared
    type: m.Type | None = None
    annotations: tuple[m.Annotation, ...] = ()
    signature: tuple[str, ...] = ()

    @property
    def path(self) -> str:
        """The path in the model, as markers name it."""
        if self.kind == "constructor" or not self.owner:
            return self.name
        return f"{self.owner}.{self.name}"

    @property
    def element(self) -> Element:
        return Element(self.kind, self.path)


@dataclass(frozen=True, slots=True, eq=False)
class Operand:
    """A model as it is compared at some depth, what is known of it, and its elements."""

    model: m.Model
    analysis: Analysis
    given: SourcedModel
    depth: Depth
    items: tuple[Item, ...] = field(repr=False)
    in_python: bool = False

    def place(self, *spans: Span) -> Place | None:
        """The first of the spans that is a place."""
        for span in spans:
            if span != NOWHERE and (found := place(span, self.given.source)) is not None:
                return found
        return None

    @property
    def whole(self) -> Place:
        """The model or code as a whole."""
        return Place(self.given.source, NOWHERE)

    def place_of(self, item: Item) -> Place | None:
        """Where the name of an element is, or else the element."""
        return self.place(getattr(item.node, "name_span", NOWHERE), item.node.span)


def side(given: SourcedModel, depth: Depth, others: frozenset[str] | None = None) -> Operand:
    """A model made ready for a comparison; in one with Python, `others` are the classes in C++.

    RebsyncError: something in it nests too deeply.
    """
    try:
        model = normal(given.model) if depth is Depth.EQUAL else given.model
        if others is not None and depth is Depth.EQUAL:
            classes = (c if c.name in others else as_in_python(c) for c in model.classes)
            model = replace(model, classes=tuple(classes))
        analysis = analyse(model, fragment=True, incomplete=True)
        items = tuple(_items(model))
    except RecursionError:
        raise too_deep(given) from None
    return Operand(model, analysis, given, depth, items, others is not None)


def two_sides(left: SourcedModel, right: SourcedModel, depth: Depth) -> tuple[Operand, Operand]:
    """Two models made ready for a comparison, alike where one of them was read from Python.

    RebsyncError: something in one nests too deeply.
    """
    if not (in_python(left) or in_python(right)):
        return side(left, depth), side(right, depth)
    others = _others(left) | _others(right)
    return side(left, depth, others), side(right, depth, others)


def in_python(given: SourcedModel) -> bool:
    """Whether classes of a model were read from Python."""
    return any(_language(c) == _PYTHON for c in given.model.classes)


def _others(given: SourcedModel) -> frozenset[str]:
    """The classes that were read from C++."""
    found = (c.name for c in given.model.classes if _language(c) not in ("", _PYTHON))
    return frozenset(found)


def _language(declaration: m.ReactiveClass | m.Interface) -> str:
    """How the file ends that a class was read from; empty for a model's own."""
    span = declaration.span
    return f".{span.source.path.rpartition('.')[2]}" if isinstance(span, SourceSpan) else ""


def too_deep(given: SourcedModel) -> RebsyncError:
    """What is told of a model that nests deeper than Python can follow."""
    message = "an expression or statement nests deeper than rebsync reads"
    hint = "give parts of it names of their own"
    return RebsyncError.of(given.source.path, "RS111", message, hint)


# --- elements -----------------------------------------------------------------------------------


def _items(model: m.Model) -> Iterator[Item]:
    for head in model.heads:
        if isinstance(head, m.Env):
            yield from _variables("env", "", head.declaration)
    for each in model.classes:
        kind = "interface" if isinstance(each, m.Interface) else "reactiveclass"
        yield Item(kind, each.name, "", each, annotations=each.annotations)
        members = each.servers if isinstance(each, m.Interface) else each.members
        for member in members:
            yield from _member(each.name, member)
    for rebec in model.main.rebecs if model.main is not None else ():
        yield Item("rebec", rebec.name, "", rebec, rebec.type, rebec.annotations)


def _member(owner: str, member: m.ClassMember) -> Iterator[Item]:
    match member:
        case m.KnownRebecs(declarations):
            for declaration in declarations:
                yield from _variables("knownrebec", owner, declaration)
        case m.StateVars(declarations):
            for declaration in declarations:
                yield from _variables("statevar", owner, declaration)
        case m.Constructor() | m.MessageServer() | m.Method():
            kind = {m.Constructor: "constructor", m.MessageServer: "msgsrv"}.get(type(member))
            type_ = member.type if isinstance(member, m.Method) else None
            signature = tuple(str(p.type) for p in member.parameters)
            notes = member.annotations
            yield Item(kind or "method", member.name, owner, member, type_, notes, signature)


def _variables(kind: str, owner: str, declaration: m.Declaration) -> Iterator[Item]:
    for declarator in declaration.declarators:
        node = declarator
        yield Item(kind, node.name, owner, node, declaration.type, declaration.annotations)


# --- markers and unread places ------------------------------------------------------------------


def markers_at(item: Item) -> frozenset[str]:
    """`kind path` of the markers in the code right before an element, or at the end of its line."""
    span = item.node.span
    if not isinstance(span, SourceSpan):
        return frozenset()
    lines = span.source.text.split("\n")
    at = span.source.position(span.start).line - 1
    near = [lines[at]]
    while at > 0 and lines[at - 1].strip().startswith(_COMMENT):
        at -= 1
        near.append(lines[at])
    return frozenset(" ".join(f[1].split()) for line in near if (f := _MARKER.search(line)))


def is_unreadable(statement: object) -> bool:
    """Whether a statement stands for code that could not be read."""
    return isinstance(statement, m.Empty) and any(
        note.name == UNREADABLE for note in statement.annotations
    )
