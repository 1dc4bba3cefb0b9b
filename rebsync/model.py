"""The typed syntax tree of Timed Rebeca: frozen values; spans take no part in equality.

The language is that of the official compiler 2.30 (core 2.3 with time) with the annotations of
the RoboRebeca thesis. Parentheses are kept (`Paren`), so that a tree prints back as written.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field, fields
from functools import cache
from typing import TypeAlias

from rebsync.expressions import (
    Annotation,
    Assign,
    Binary,
    BoolLiteral,
    Broken,
    Call,
    Cast,
    Choice,
    Conditional,
    Expression,
    FloatLiteral,
    Index,
    InstanceOf,
    IntLiteral,
    Member,
    Name,
    New,
    NullLiteral,
    Paren,
    Postfix,
    Self,
    StringLiteral,
    Super,
    Type,
    Unary,
    span_field,
)
from rebsync.records import dataclass
from rebsync.source import Span
from rebsync.statements import (
    ArrayInitializer,
    Block,
    Break,
    Case,
    Continue,
    Declaration,
    Declarator,
    Empty,
    ExpressionStatement,
    For,
    If,
    Initializer,
    Local,
    Parameter,
    Return,
    Statement,
    Switch,
    While,
)

__all__ = [
    "Annotation",
    "ArrayInitializer",
    "Assign",
    "Binary",
    "Block",
    "BoolLiteral",
    "Break",
    "Broken",
    "Call",
    "Case",
    "Cast",
    "Choice",
    "ClassMember",
    "Conditional",
    "Constructor",
    "Continue",
    "Declaration",
    "Declarator",
    "Empty",
    "Env",
    "Expression",
    "ExpressionStatement",
    "FloatLiteral",
    "For",
    "Head",
    "If",
    "Index",
    "Initializer",
    "InstanceOf",
    "IntLiteral",
    "Interface",
    "KnownRebecs",
    "Local",
    "Main",
    "Member",
    "MessageServer",
    "Method",
    "Model",
    "Name",
    "New",
    "Node",
    "NullLiteral",
    "Parameter",
    "Paren",
    "Postfix",
    "ReactiveClass",
    "Rebec",
    "Refused",
    "Return",
    "Self",
    "StateVars",
    "Statement",
    "StringLiteral",
    "Super",
    "Switch",
    "Type",
    "Unary",
    "While",
    "children",
    "walk",
]


@dataclass(frozen=True, slots=True)
class KnownRebecs:
    """One `knownrebecs { ... }` section; a class may have any number, in any order."""

    declarations: tuple[Declaration, ...]
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class StateVars:
    """One `statevars { ... }` section; a class may have any number, in any order."""

    declarations: tuple[Declaration, ...]
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Constructor:
    name: str
    parameters: tuple[Parameter, ...]
    body: Block | None
    annotations: tuple[Annotation, ...] = ()
    span: Span = span_field()
    name_span: Span = span_field()


@dataclass(frozen=True, slots=True)
class MessageServer:
    """`msgsrv name(parameters) { ... }`; without a body in interfaces and when abstract."""

    name: str
    parameters: tuple[Parameter, ...]
    body: Block | None
    abstract: bool = False
    annotations: tuple[Annotation, ...] = ()
    span: Span = span_field()
    name_span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Method:
    """A local method; `type` is `void` or the type that it returns."""

    type: Type
    name: str
    parameters: tuple[Parameter, ...]
    body: Block | None
    abstract: bool = False
    annotations: tuple[Annotation, ...] = ()
    span: Span = span_field()
    name_span: Span = span_field()


ClassMember: TypeAlias = KnownRebecs | StateVars | Constructor | MessageServer | Method


@dataclass(frozen=True, slots=True)
class ReactiveClass:
    """`reactiveclass name(queue_length) { ... }`."""

    name: str
    queue_length: int
    members: tuple[ClassMember, ...]
    abstract: bool = False
    extends: str | None = None
    implements: tuple[str, ...] = ()
    annotations: tuple[Annotation, ...] = ()
    span: Span = span_field()
    name_span: Span = span_field()
    extends_span: Span = span_field()
    implements_spans: tuple[Span, ...] = field(default=(), compare=False, repr=False)
    queue_span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Interface:
    name: str
    servers: tuple[MessageServer, ...]
    extends: tuple[str, ...] = ()
    annotations: tuple[Annotation, ...] = ()
    span: Span = span_field()
    name_span: Span = span_field()
    extends_spans: tuple[Span, ...] = field(default=(), compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Rebec:
    """An instance in `main`: `C name(bindings):(arguments);`."""

    type: Type
    name: str
    bindings: tuple[Expression, ...]
    arguments: tuple[Expression, ...]
    annotations: tuple[Annotation, ...] = ()
    span: Span = span_field()
    name_span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Main:
    rebecs: tuple[Rebec, ...]
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Env:
    """`env int a = 1, b = 2;`: constants of the model."""

    declaration: Declaration
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Refused:
    """A `featurevar`, `record`, `package` or `import`: recognised, then refused."""

    keyword: str
    text: str
    span: Span = span_field()


Head: TypeAlias = Env | Refused


@dataclass(frozen=True, slots=True)
class Model:
    """A whole model; `main` is None only for classes read from code alone."""

    heads: tuple[Head, ...]
    classes: tuple[ReactiveClass | Interface, ...]
    main: Main | None
    span: Span = span_field()


Node: TypeAlias = (
    Type
    | Annotation
    | Expression
    | ArrayInitializer
    | Declarator
    | Declaration
    | Parameter
    | Statement
    | Case
    | ClassMember
    | ReactiveClass
    | Interface
    | Rebec
    | Main
    | Env
    | Refused
    | Model
)


_PLAIN = frozenset(
    {"str", "int", "bool", "str | None", "tuple[str, ...]", "tuple[int, ...]", "Span"}
)


@cache
def child_fields(kind: type) -> tuple[str, ...]:
    """The names of the fields of a kind of nodes that hold nodes."""
    return tuple(f.name for f in fields(kind) if f.compare and f.type not in _PLAIN)


@cache
def _last_first(kind: type) -> tuple[str, ...]:
    return child_fields(kind)[::-1]


def children(node: Node) -> Iterator[Node]:
    """The direct sub-nodes of a node, in the order of its fields."""
    kind: type = type(node)
    for name in child_fields(kind):
        value = getattr(node, name)
        if isinstance(value, tuple):
            yield from value
        elif value is not None:
            yield value


def walk(node: Node) -> Iterator[Node]:
    """The node and everything below it, parents first, in source order."""
    stack = [node]
    while stack:
        current = stack.pop()
        yield current
        kind: type = type(current)
        for name in _last_first(kind):
            value = getattr(current, name)
            if isinstance(value, tuple):
                stack += value[::-1]
            elif value is not None:
                stack.append(value)
