"""The typed syntax tree of Timed Rebeca: frozen values; spans take no part in equality.

The language is that of the official compiler 2.30 (core 2.3 with time) with the annotations of
the RoboRebeca thesis. Parentheses are kept (`Paren`), so that a tree prints back as written.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, fields
from typing import TypeAlias

from rebsync.source import NOWHERE, Span


def _span() -> Span:
    return field(default=NOWHERE, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Type:
    """A type by name, with the lengths of its array dimensions: `int[2][3]`."""

    name: str
    dimensions: tuple[int, ...] = ()
    span: Span = _span()

    def __str__(self) -> str:
        return self.name + "".join(f"[{n}]" for n in self.dimensions)


@dataclass(frozen=True, slots=True)
class Annotation:
    """`@name` or `@name(arguments)`; `arguments` is None without parentheses."""

    name: str
    arguments: tuple[Expression, ...] | None = None
    span: Span = _span()


# --- expressions -------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class IntLiteral:
    value: int
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class FloatLiteral:
    """`text` is the literal as written, since `1.0` and `1.00` print back differently."""

    text: str
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class BoolLiteral:
    value: bool
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class StringLiteral:
    """`text` is the literal as written, quotes included."""

    text: str
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class NullLiteral:
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Name:
    """A variable, a known rebec, `sender`, `now` and its kin: whatever the name resolves to."""

    name: str
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Self:
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Super:
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Member:
    """`target.name`."""

    target: Expression
    name: str
    span: Span = _span()
    name_span: Span = _span()


@dataclass(frozen=True, slots=True)
class Index:
    """`target[index]`."""

    target: Expression
    index: Expression
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Call:
    """A send, a method call or a built-in: `target.name(arguments) after(a) deadline(d)`."""

    target: Expression | None
    name: str
    arguments: tuple[Expression, ...] = ()
    after: Expression | None = None
    deadline: Expression | None = None
    span: Span = _span()
    name_span: Span = _span()


@dataclass(frozen=True, slots=True)
class Paren:
    """`(inner)`."""

    inner: Expression
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Cast:
    """`(type) operand`; binds to a primary only: `(int) d / 2` is `((int) d) / 2`."""

    type: Type
    operand: Expression
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Unary:
    """A prefix operator: `+ - ! ~ ++ --`."""

    operator: str
    operand: Expression
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Postfix:
    """`operand++` or `operand--`."""

    operator: str
    operand: Expression
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Binary:
    operator: str
    left: Expression
    right: Expression
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class InstanceOf:
    operand: Expression
    type: Type
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Conditional:
    """`condition ? then : otherwise`."""

    condition: Expression
    then: Expression
    otherwise: Expression
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Choice:
    """A nondeterministic expression `?(a, b, ...)`."""

    options: tuple[Expression, ...]
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Assign:
    """`target operator value`, with `=` or a compound operator such as `+=`."""

    operator: str
    target: Expression
    value: Expression
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class New:
    """`new C(bindings):(arguments)`: part of core 2.2; recognised, then refused."""

    type: Type
    bindings: tuple[Expression, ...]
    arguments: tuple[Expression, ...]
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Broken:
    """Stands where an expression could not be read; its mistake has been reported."""

    span: Span = _span()


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


# --- declarations of variables -----------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class ArrayInitializer:
    """`{a, b}` after `=` in a local or env declaration."""

    values: tuple[Initializer, ...]
    span: Span = _span()


Initializer: TypeAlias = "Expression | ArrayInitializer"


@dataclass(frozen=True, slots=True)
class Declarator:
    """One `name = initial` of a declaration."""

    name: str
    initial: Initializer | None = None
    span: Span = _span()
    name_span: Span = _span()


@dataclass(frozen=True, slots=True)
class Declaration:
    """`@annotations type a, b = 1`: state variables, known rebecs, env, locals."""

    type: Type
    declarators: tuple[Declarator, ...]
    annotations: tuple[Annotation, ...] = ()
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Parameter:
    type: Type
    name: str
    span: Span = _span()
    name_span: Span = _span()


# --- statements --------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Block:
    statements: tuple[Statement, ...]
    annotations: tuple[Annotation, ...] = ()
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class ExpressionStatement:
    expression: Expression
    annotations: tuple[Annotation, ...] = ()
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Local:
    """A declaration of local variables."""

    declaration: Declaration
    annotations: tuple[Annotation, ...] = ()
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class If:
    condition: Expression
    then: Statement
    otherwise: Statement | None = None
    annotations: tuple[Annotation, ...] = ()
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class While:
    condition: Expression
    body: Statement
    annotations: tuple[Annotation, ...] = ()
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class For:
    """`initial` is a declaration, or a list of expressions (perhaps empty)."""

    initial: Declaration | tuple[Expression, ...]
    condition: Expression | None
    updates: tuple[Expression, ...]
    body: Statement
    annotations: tuple[Annotation, ...] = ()
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Case:
    """`case value:` with its statements; `value` is None for `default:`."""

    value: Expression | None
    statements: tuple[Statement, ...]
    annotations: tuple[Annotation, ...] = ()
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Switch:
    subject: Expression
    cases: tuple[Case, ...]
    annotations: tuple[Annotation, ...] = ()
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Return:
    value: Expression | None = None
    annotations: tuple[Annotation, ...] = ()
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Break:
    annotations: tuple[Annotation, ...] = ()
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Continue:
    annotations: tuple[Annotation, ...] = ()
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Empty:
    """A lone `;`: what `@Move(X+1, Y);` annotates."""

    annotations: tuple[Annotation, ...] = ()
    span: Span = _span()


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


# --- classes -----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class KnownRebecs:
    """One `knownrebecs { ... }` section; a class may have any number, in any order."""

    declarations: tuple[Declaration, ...]
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class StateVars:
    """One `statevars { ... }` section; a class may have any number, in any order."""

    declarations: tuple[Declaration, ...]
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Constructor:
    name: str
    parameters: tuple[Parameter, ...]
    body: Block | None
    annotations: tuple[Annotation, ...] = ()
    span: Span = _span()
    name_span: Span = _span()


@dataclass(frozen=True, slots=True)
class MessageServer:
    """`msgsrv name(parameters) { ... }`; without a body in interfaces and when abstract."""

    name: str
    parameters: tuple[Parameter, ...]
    body: Block | None
    abstract: bool = False
    annotations: tuple[Annotation, ...] = ()
    span: Span = _span()
    name_span: Span = _span()


@dataclass(frozen=True, slots=True)
class Method:
    """A local method; `type` is `void` or the type that it returns."""

    type: Type
    name: str
    parameters: tuple[Parameter, ...]
    body: Block | None
    abstract: bool = False
    annotations: tuple[Annotation, ...] = ()
    span: Span = _span()
    name_span: Span = _span()


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
    span: Span = _span()
    name_span: Span = _span()
    extends_span: Span = _span()
    implements_spans: tuple[Span, ...] = field(default=(), compare=False, repr=False)
    queue_span: Span = _span()


@dataclass(frozen=True, slots=True)
class Interface:
    name: str
    servers: tuple[MessageServer, ...]
    extends: tuple[str, ...] = ()
    annotations: tuple[Annotation, ...] = ()
    span: Span = _span()
    name_span: Span = _span()
    extends_spans: tuple[Span, ...] = field(default=(), compare=False, repr=False)


# --- the model ---------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Rebec:
    """An instance in `main`: `C name(bindings):(arguments);`."""

    type: Type
    name: str
    bindings: tuple[Expression, ...]
    arguments: tuple[Expression, ...]
    annotations: tuple[Annotation, ...] = ()
    span: Span = _span()
    name_span: Span = _span()


@dataclass(frozen=True, slots=True)
class Main:
    rebecs: tuple[Rebec, ...]
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Env:
    """`env int a = 1, b = 2;`: constants of the model."""

    declaration: Declaration
    span: Span = _span()


@dataclass(frozen=True, slots=True)
class Refused:
    """A `featurevar`, `record`, `package` or `import`: recognised, then refused."""

    keyword: str
    text: str
    span: Span = _span()


Head: TypeAlias = Env | Refused


@dataclass(frozen=True, slots=True)
class Model:
    """A whole model; `main` is None only for classes read from code alone."""

    heads: tuple[Head, ...]
    classes: tuple[ReactiveClass | Interface, ...]
    main: Main | None
    span: Span = _span()


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


_CHILD_FIELDS: dict[type, tuple[str, ...]] = {}


def _child_fields(kind: type) -> tuple[str, ...]:
    names = _CHILD_FIELDS.get(kind)
    if names is None:
        plain = ("str", "int", "bool", "str | None", "tuple[str, ...]", "tuple[int, ...]", "Span")
        names = tuple(f.name for f in fields(kind) if f.compare and f.type not in plain)
        _CHILD_FIELDS[kind] = names
    return names


def children(node: Node) -> Iterator[Node]:
    """The direct sub-nodes of a node, in the order of its fields."""
    for name in _child_fields(type(node)):
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
        stack.extend(reversed(list(children(current))))
