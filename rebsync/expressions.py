"""Expressions of the syntax tree, with the types and annotations that they are made of."""

from __future__ import annotations

from dataclasses import field
from typing import TypeAlias

from rebsync.records import dataclass
from rebsync.source import NOWHERE, Span


def span_field() -> Span:
    """A field for a place in the text, which takes no part in equality."""
    return field(default=NOWHERE, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Type:
    """A type by name, with the lengths of its array dimensions: `int[2][3]`."""

    name: str
    dimensions: tuple[int, ...] = ()
    span: Span = span_field()

    def __str__(self) -> str:
        return self.name + "".join(f"[{n}]" for n in self.dimensions)


@dataclass(frozen=True, slots=True)
class Annotation:
    """`@name` or `@name(arguments)`; `arguments` is None without parentheses."""

    name: str
    arguments: tuple[Expression, ...] | None = None
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class IntLiteral:
    value: int
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class FloatLiteral:
    """`text` is the literal as written, since `1.0` and `1.00` print back differently."""

    text: str
    span: Span = span_field()

    @property
    def is_double(self) -> bool:
        """Whether it is a double, as `0.1d` is; others are floats."""
        return self.text[-1] in "dD"


@dataclass(frozen=True, slots=True)
class BoolLiteral:
    value: bool
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class StringLiteral:
    """`text` is the literal as written, quotes included."""

    text: str
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class NullLiteral:
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Name:
    """A variable, a known rebec, `sender`, `now` and its kin: whatever the name resolves to."""

    name: str
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Self:
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Super:
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Member:
    """`target.name`."""

    target: Expression
    name: str
    span: Span = span_field()
    name_span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Index:
    """`target[index]`."""

    target: Expression
    index: Expression
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Call:
    """A send, a method call or a built-in: `target.name(arguments) after(a) deadline(d)`."""

    target: Expression | None
    name: str
    arguments: tuple[Expression, ...] = ()
    after: Expression | None = None
    deadline: Expression | None = None
    span: Span = span_field()
    name_span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Paren:
    """`(inner)`."""

    inner: Expression
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Cast:
    """`(type) operand`; binds to a primary only: `(int) d / 2` is `((int) d) / 2`."""

    type: Type
    operand: Expression
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Unary:
    """A prefix operator: `+ - ! ~ ++ --`."""

    operator: str
    operand: Expression
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Postfix:
    """`operand++` or `operand--`."""

    operator: str
    operand: Expression
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Binary:
    operator: str
    left: Expression
    right: Expression
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class InstanceOf:
    operand: Expression
    type: Type
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Conditional:
    """`condition ? then : otherwise`."""

    condition: Expression
    then: Expression
    otherwise: Expression
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Choice:
    """A nondeterministic expression `?(a, b, ...)`."""

    options: tuple[Expression, ...]
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Assign:
    """`target operator value`, with `=` or a compound operator such as `+=`."""

    operator: str
    target: Expression
    value: Expression
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class New:
    """`new C(bindings):(arguments)`: part of core 2.2; recognised, then refused."""

    type: Type
    bindings: tuple[Expression, ...]
    arguments: tuple[Expression, ...]
    span: Span = span_field()


@dataclass(frozen=True, slots=True)
class Broken:
    """Stands where an expression could not be read; its mistake has been reported."""

    span: Span = span_field()


Expression: TypeAlias = (
    IntLiteral
    | FloatLiteral
    | BoolLiteral
    | StringLiteral
    | NullLiteral
    | Name
    | Self
    | Super
    | Member
    | Index
    | Call
    | Paren
    | Cast
    | Unary
    | Postfix
    | Binary
    | InstanceOf
    | Conditional
    | Choice
    | Assign
    | New
    | Broken
)
