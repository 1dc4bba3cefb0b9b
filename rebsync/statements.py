"""Declarations of variables, and statements, of the syntax tree."""

from __future__ import annotations

from typing import TypeAlias

from rebsync.expressions import Annotation, Expression, Type, span_field
from rebsync.records import dataclass
from rebsync.source import Span


@dataclass(frozen=True, slots=True)
class ArrayInitializer:
    """`{a, b}` after `=` in a local or env declaration."""

    values: tuple[Initializer, ...]
    span: Span = span_field()


Initializer: TypeAlias = "Expression | ArrayInitializer"


@dataclass(frozen=True, slots=True)
class Declarator:
    """One `name = initial` of a declaration."""

    name: str
    initial: Initializer | None = None
    span: Span = span_field()
    name_span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Declaration:
    """`@annotations type a, b = 1`: state variables, known rebecs, env, locals."""

    type: Type
    declarators: tuple[Declarator, ...]
    annotations: tuple[Annotation, ...] = ()
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Parameter:
    type: Type
    name: str
    span: Span = span_field()
    name_span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Block:
    statements: tuple[Statement, ...]
    annotations: tuple[Annotation, ...] = ()
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class ExpressionStatement:
    expression: Expression
    annotations: tuple[Annotation, ...] = ()
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Local:
    """A declaration of local variables."""

    declaration: Declaration
    annotations: tuple[Annotation, ...] = ()
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class If:
    condition: Expression
    then: Statement
    otherwise: Statement | None = None
    annotations: tuple[Annotation, ...] = ()
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class While:
    condition: Expression
    body: Statement
    annotations: tuple[Annotation, ...] = ()
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class For:
    """`initial` is a declaration, or a list of expressions (perhaps empty)."""

    initial: Declaration | tuple[Expression, ...]
    condition: Expression | None
    updates: tuple[Expression, ...]
    body: Statement
    annotations: tuple[Annotation, ...] = ()
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Case:
    """`case value:` with its statements; `value` is None for `default:`."""

    value: Expression | None
    statements: tuple[Statement, ...]
    annotations: tuple[Annotation, ...] = ()
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Switch:
    subject: Expression
    cases: tuple[Case, ...]
    annotations: tuple[Annotation, ...] = ()
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Return:
    value: Expression | None = None
    annotations: tuple[Annotation, ...] = ()
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Break:
    annotations: tuple[Annotation, ...] = ()
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Continue:
    annotations: tuple[Annotation, ...] = ()
    span: Span = span_field()


# The annotation of an empty statement that stands for code that was not read.
UNREADABLE = "Unreadable"


@dataclass(frozen=True, slots=True)
class Empty:
    """A lone `;`: what `@Move(X+1, Y);` annotates."""

    annotations: tuple[Annotation, ...] = ()
    span: Span = span_field()


Statement: TypeAlias = (
    Block
    | ExpressionStatement
    | Local
    | If
    | While
    | For
    | Switch
    | Return
    | Break
    | Continue
    | Empty
)
