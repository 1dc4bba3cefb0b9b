"""What classes of generated code said before, as far as an edit has nothing to do with it.

A class is read from all of the text of the files that it, the classes above and those below it
stand in, and of other files from what is outside of the bodies of member functions. Of those bodies
it knows only what was found in them for all classes together, their roles; so it is known again by
a digest of all three. What else changes anything reads all classes again.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping
from dataclasses import field, fields
from fractions import Fraction
from typing import Protocol, TypeAlias

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.findings import Finding, Findings, Ordered
from rebsync.reverse.generated.cpp_classes import Classes
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, text_of
from rebsync.source import Source

_AROUND = frozenset(
    {
        *("namespace_definition", "declaration_list", "linkage_specification"),
        *("preproc_if", "preproc_ifdef", "preproc_else", "preproc_elif"),
    }
)
_OF_ONE_RUN = frozenset({"wired", "reading"})  # what goes by the places of nodes in memory
_Bodies: TypeAlias = "dict[int, Node]"


@dataclass(frozen=True, slots=True)
class ClassRead:
    """What one class says, with everything that reading it has listed and counted."""

    read: m.ReactiveClass | m.Interface
    findings: tuple[Finding, ...]
    statements: tuple[tuple[str, int], ...]
    open_members: frozenset[str]
    ordered: tuple[Ordered, ...] = ()


class Memory(Protocol):
    """Where it is kept what classes said; `sources` are the texts of today by their paths."""

    def recall(self, key: str, sources: Mapping[str, Source]) -> ClassRead | None:
        """What is known under a key, if all texts that it has places in are as they were."""
        ...

    def keep(self, key: str, read: ClassRead, sources: Mapping[str, Source]) -> None:
        """Keeps this for later, if that can be done."""
        ...


def read_with(
    memory: Memory, classes: Classes, wanted: set[str] | None = None
) -> tuple[m.ReactiveClass | m.Interface, ...]:
    """The classes as `Classes.read` gives them, of which as few as can be are read again."""
    chosen = list(classes.chosen(wanted))
    if len(chosen) < 2:
        return tuple(map(classes.read_one, chosen))
    sources = {cpp.source.path: cpp.source for cpp in classes.code.files}
    keys = _Keys(classes)
    found = []
    for owner in chosen:
        key = keys.of(owner)
        known = memory.recall(key, sources)
        if known is None:
            known = _read(classes, owner)
            memory.keep(key, known, sources)
        found.append(known.read)
        classes.findings.all += known.findings
        classes.findings.statements.update(dict(known.statements))
        classes.findings.open_members |= known.open_members
        classes.findings.ordered += known.ordered
    return tuple(found)


def _read(classes: Classes, owner: CppClass) -> ClassRead:
    """What one class says and lists, told apart from the others."""
    every, own = classes.findings, Findings()
    classes.findings = own
    try:
        read = classes.read_one(owner)
    finally:
        classes.findings = every
    counted = tuple(own.statements.items())
    ordered, members = tuple(own.ordered), frozenset(own.open_members)
    return ClassRead(read, tuple(own.all), counted, members, ordered)


# --- keys ---------------------------------------------------------------------------------------


@dataclass(slots=True, eq=False)
class _Keys:
    """Digests of all that single classes are read from."""

    classes: Classes
    common: str = ""
    whole: dict[str, str] = field(default_factory=dict)
    outside: dict[str, str] = field(default_factory=dict)
    files: dict[str, set[str]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        code = self.classes.code
        bodies = _bodies(code)
        for cpp in code.files:
            path = cpp.source.path
            self.whole[path] = _digest(cpp.source.text)
            self.outside[path] = _digest("\n".join(_outside(cpp, bodies.get(path, {}))))
        for name, several in code.all_classes.items():
            self.files.setdefault(name, set()).update(c.cpp.source.path for c in several)
        for (owner, _), functions in code.definitions.items():
            self.files.setdefault(owner, set()).update(f.cpp.source.path for f in functions)
        self.common = _digest("\n".join(_common(self.classes)))

    def of(self, owner: CppClass) -> str:
        """The digest of what a class is read from."""
        code = self.classes.code
        own: set[str] = set()
        for name in code.classes:
            lineage = {c.name for c in code.lineage(name)}
            if owner.name in lineage or name in {c.name for c in code.lineage(owner.name)}:
                own |= self.files.get(name, set())
        told = (
            f"{path} whole {self.whole[path]}" if path in own else f"{path} {self.outside[path]}"
            for path in self.whole
        )
        return _digest("\n".join((owner.name, self.common, *told)))


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


def _bodies(code: Code) -> dict[str, _Bodies]:
    """By file the bodies of member functions that stand outside of classes, by where they begin."""
    found: dict[str, _Bodies] = {}
    for (owner, _), functions in code.definitions.items():
        for function in functions if owner else ():
            body = function.body
            if body is not None and body.type == "compound_statement":
                of_file = found.setdefault(function.cpp.source.path, {})
                of_file[function.node.start_byte] = body
    return found


def _outside(cpp: Cpp, bodies: _Bodies) -> Iterator[str]:
    """A file without these bodies, and without comments outside of all declarations.

    As a whole where it is not plain what belongs to which function. Comments with markers stay.
    """
    if cpp.root.has_error or cpp.deep or cpp.inverted or cpp.filled:
        yield cpp.source.text
        return
    yield from _parts(cpp.root, bodies)


def _parts(around: Node, bodies: _Bodies) -> Iterator[str]:
    comments: list[str] = []
    row = -1
    for node in around.children:
        if node.type == "comment":
            comments.append(f"{node.start_point.row == row} {text_of(node)}")
            row = node.end_point.row
            continue
        yield from _with_markers(comments)
        comments, row = [], node.end_point.row
        body = bodies.get(node.start_byte) if node.type == "function_definition" else None
        if node.type in _AROUND:
            yield from _parts(node, bodies)
        elif body is None or b"#" in (body.text or b""):
            yield text_of(node)
        else:
            data = node.text or b""
            head = data[: body.start_byte - node.start_byte]
            tail = data[body.end_byte - node.start_byte :]
            yield (head + b"{}" + tail).decode("utf-8", "replace")
    yield from _with_markers(comments)


def _with_markers(comments: list[str]) -> list[str]:
    """Comments that follow each other, if there is a marker in them: it may be split over them."""
    return comments if any("rebsync:" in comment for comment in comments) else []


# --- what was found for all classes ---------------------------------------------------------------


def _common(classes: Classes) -> Iterator[str]:
    """All that the reading of a class has beside the code."""
    told = _Told({})
    for each in (classes.roles, classes.timers, classes.meanings, classes.messages):
        yield from told.of(each)
    every = (
        classes.unit,
        classes.types,
        classes.fields,
        classes.served,
        classes.shown,
        classes.signed,
    )
    yield from told.of(every)


@dataclass(frozen=True, slots=True, eq=False)
class _Told:
    """Values as texts; a piece of code is told with all of the function that it stands in."""

    functions: dict[int, str]

    def of(self, value: object) -> Iterator[str]:
        """The texts that tell a value. TypeError: it is of a kind that nobody thought of."""
        match value:
            case None | bool() | int() | str() | float() | Fraction():
                yield repr(value)
            case Node():
                yield self._node(value)
            case CppFunction():
                yield f"{value.cpp.source.path} {value.owner}::{value.name}"
                yield self._node(value.node)
            case Cpp() | Source():
                yield value.source.path if isinstance(value, Cpp) else value.path
            case frozenset() | set():
                yield from sorted("\n".join(self.of(each)) for each in value)
            case tuple() | list():
                yield f"{len(value)} of"
                for each in value:
                    yield from self.of(each)
            case Mapping():
                yield f"{len(value)} pairs"
                for pair in value.items():
                    yield from self.of(pair)
            case _:
                yield type(value).__name__
                for each in fields(value):  # type: ignore[arg-type]
                    if each.compare and each.name not in _OF_ONE_RUN:
                        yield from self.of(getattr(value, each.name))

    def _node(self, node: Node) -> str:
        functions = [n for n in ancestors(node) if n.type == "function_definition"]
        function = functions[-1] if functions else node
        if function.id not in self.functions:
            self.functions[function.id] = _digest(text_of(function))
        start = node.start_byte - function.start_byte
        return (
            f"{node.type} {start} {node.end_byte - node.start_byte} {self.functions[function.id]}"
        )
