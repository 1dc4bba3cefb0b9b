"""Draws bodies: well-typed expressions and statements over the names in scope."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias, TypeVar

from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from rebsync import model as m

_T = TypeVar("_T")
_Drawer: TypeAlias = "Callable[[DrawFn, Scope, int], m.Statement]"

INTEGERS = ("byte", "short", "int")
NUMBERS = (*INTEGERS, "float", "double")
PRIMITIVES = (*NUMBERS, "boolean")
_LARGEST = {"byte": 100, "short": 3000, "int": 100_000}
_COMPOUND = ("+=", "-=", "*=", "/=")
_COMPOUND_INTEGER = (*_COMPOUND, "%=", "&=", "|=", "^=", "<<=", ">>=")
_COMPARISONS = ("<", "<=", ">", ">=", "==", "!=")


@dataclass(frozen=True)
class Variable:
    """Something that can be read, and perhaps assigned: its text as a tree and its type."""

    read: m.Expression
    type: m.Type
    assignable: bool = True


@dataclass(frozen=True)
class Signature:
    """A server or method of a class."""

    name: str
    types: tuple[m.Type, ...]
    result: str = "void"


@dataclass
class Scope:
    """What a body may use."""

    owner: str
    kind: str  # "server", "method" or "constructor"
    variables: list[Variable]
    servers: dict[str, list[Signature]]
    methods: list[Signature]
    ancestors: dict[str, tuple[str, ...]]
    robot: bool = False
    locals: int = 0
    prefix: str = "v"
    result: str = "void"
    sender: bool = False

    def fresh(self) -> str:
        """A name for a local variable."""
        self.locals += 1
        return f"{self.prefix}{self.locals}"


def _one(draw: DrawFn, options: Sequence[_T]) -> _T:
    return draw(st.sampled_from(options))


def _chance(draw: DrawFn, out_of: int) -> bool:
    return draw(st.integers(0, out_of - 1)) == out_of - 1


def type_of(name: str, *dimensions: int) -> m.Type:
    """A type by name."""
    return m.Type(name, dimensions)


def _fits(source: str, target: str, scope: Scope) -> bool:
    if source == target:
        return True
    if source in NUMBERS and target in NUMBERS:
        return NUMBERS.index(source) <= NUMBERS.index(target)
    return target in scope.ancestors.get(source, ())


# --- expressions -------------------------------------------------------------------------------


def draw_expression(draw: DrawFn, scope: Scope, kind: str, depth: int = 2) -> m.Expression:
    """An expression whose value fits the type named `kind`."""
    if kind == "boolean":
        return _boolean(draw, scope, depth)
    if kind in NUMBERS:
        return _number(draw, scope, kind, depth)
    return _rebec(draw, scope, kind)


def _readable(draw: DrawFn, scope: Scope, kind: str) -> list[m.Expression]:
    found = []
    for variable in scope.variables:
        if _fits(variable.type.name, kind, scope):
            found.append(_element(draw, variable))
    return found


def _element(draw: DrawFn, variable: Variable) -> m.Expression:
    expression = variable.read
    for length in variable.type.dimensions:
        expression = m.Index(expression, m.IntLiteral(draw(st.integers(0, length - 1))))
    return expression


def literal(draw: DrawFn, kind: str) -> m.Expression:
    """A literal whose type fits `kind`."""
    if kind == "boolean":
        return m.BoolLiteral(draw(st.booleans()))
    if kind in INTEGERS:
        return m.IntLiteral(draw(st.integers(0, _LARGEST[kind])))
    return m.FloatLiteral(_one(draw, ("0.5", "1.0", "2.25", "1.00")))


def _number(draw: DrawFn, scope: Scope, kind: str, depth: int) -> m.Expression:
    leaves = [literal(draw, kind), *_readable(draw, scope, kind)]
    if depth == 0:
        return _one(draw, leaves)
    match draw(st.integers(0, 9)):
        case 0 | 1 | 2:
            return _binary(draw, scope, kind, depth)
        case 3:
            signs = ("-", "+", "~") if kind in INTEGERS else ("-", "+")
            operand = draw_expression(draw, scope, kind, depth - 1)
            return m.Unary(_one(draw, signs), _operand(operand))
        case 4:
            source = _one(draw, NUMBERS)
            inner = draw_expression(draw, scope, source, depth - 1)
            return m.Cast(type_of(kind), m.Paren(inner))
        case 5:
            return m.Paren(_number(draw, scope, kind, depth - 1))
        case 6:
            return _conditional(draw, scope, kind, depth)
        case 7:
            return _call_or(draw, scope, kind, depth, leaves)
        case _:
            return _one(draw, leaves)


def _operand(expression: m.Expression) -> m.Expression:
    """Signs of literals are left to the printer; everything lower gets its parentheses."""
    loose = (m.Binary, m.Conditional, m.Assign, m.InstanceOf)
    return m.Paren(expression) if isinstance(expression, loose) else expression


def _conditional(draw: DrawFn, scope: Scope, kind: str, depth: int) -> m.Expression:
    condition = _operand(_boolean(draw, scope, depth - 1))
    then = draw_expression(draw, scope, kind, depth - 1)
    otherwise = draw_expression(draw, scope, kind, depth - 1)
    return m.Paren(m.Conditional(condition, then, otherwise))


def _binary(draw: DrawFn, scope: Scope, kind: str, depth: int) -> m.Expression:
    operators = ["+", "-", "*", "/"]
    if kind in INTEGERS:
        operators += ["%", "<<", ">>", "&", "|", "^"]
    operator = _one(draw, operators)
    left = _operand(draw_expression(draw, scope, kind, depth - 1))
    if operator in ("/", "%", "<<", ">>"):
        amount = m.IntLiteral(draw(st.integers(1, 7)))
        return m.Binary(operator, left, amount)
    return m.Binary(operator, left, _operand(draw_expression(draw, scope, kind, depth - 1)))


def _call_or(
    draw: DrawFn, scope: Scope, kind: str, depth: int, leaves: Sequence[m.Expression]
) -> m.Expression:
    calls = [f for f in scope.methods if f.result != "void" and _fits(f.result, kind, scope)]
    if calls and scope.kind != "method":
        return _call_of(draw, scope, None, _one(draw, calls), depth - 1)
    if kind == "double":
        name = _one(draw, ("sqrt", "pow"))
        count = 1 if name == "sqrt" else 2
        arguments = [_number(draw, scope, "double", depth - 1) for _ in range(count)]
        return m.Call(None, name, tuple(arguments))
    return _one(draw, leaves)


def _call_of(
    draw: DrawFn, scope: Scope, target: m.Expression | None, callee: Signature, depth: int
) -> m.Call:
    return m.Call(
        target, callee.name, tuple(_argument(draw, scope, t, depth) for t in callee.types)
    )


def _argument(draw: DrawFn, scope: Scope, wanted: m.Type, depth: int) -> m.Expression:
    """Of exactly the parameter's type, so that overloads stay unambiguous."""
    if wanted.dimensions:
        return _one(draw, [v.read for v in scope.variables if v.type == wanted])
    if wanted.name in NUMBERS:
        return m.Cast(wanted, m.Paren(draw_expression(draw, scope, wanted.name, depth)))
    return draw_expression(draw, scope, wanted.name, depth)


def _boolean(draw: DrawFn, scope: Scope, depth: int) -> m.Expression:
    leaves = [literal(draw, "boolean"), *_readable(draw, scope, "boolean")]
    if depth == 0:
        return _one(draw, leaves)
    match draw(st.integers(0, 7)):
        case 0 | 1 | 2:
            kind = _one(draw, NUMBERS)
            left, right = (
                _operand(draw_expression(draw, scope, kind, depth - 1)) for _ in range(2)
            )
            return m.Binary(_one(draw, _COMPARISONS), left, right)
        case 3:
            return m.Unary("!", _operand(_boolean(draw, scope, depth - 1)))
        case 4:
            operator = _one(draw, ("&&", "||", "&", "|", "^", "==", "!="))
            left, right = (_operand(_boolean(draw, scope, depth - 1)) for _ in range(2))
            return m.Binary(operator, left, right)
        case 5:
            return m.Paren(_boolean(draw, scope, depth - 1))
        case 6:
            return _about_rebecs(draw, scope)
        case _:
            return _one(draw, leaves)


def _about_rebecs(draw: DrawFn, scope: Scope) -> m.Expression:
    rebecs = [v for v in scope.variables if v.type.name not in PRIMITIVES]
    if not rebecs:
        return m.BoolLiteral(draw(st.booleans()))
    chosen = _one(draw, rebecs)
    read = _element(draw, chosen)
    if draw(st.booleans()):
        return m.Binary(_one(draw, ("==", "!=")), read, m.NullLiteral())
    return m.InstanceOf(read, type_of(chosen.type.name))


def _rebec(draw: DrawFn, scope: Scope, kind: str) -> m.Expression:
    options: list[m.Expression] = [m.NullLiteral(), *_readable(draw, scope, kind)]
    if _fits(scope.owner, kind, scope):
        options.append(m.Self())
    if scope.sender:
        options.append(m.Cast(type_of(kind), m.Name("sender")))
    return _one(draw, options)


def _choice(draw: DrawFn, kind: str) -> m.Expression:
    if kind == "boolean":
        first = draw(st.booleans())
        return m.Choice((m.BoolLiteral(first), m.BoolLiteral(not first)))
    if kind in INTEGERS:
        values = draw(st.lists(st.integers(0, 100), min_size=2, max_size=3, unique=True))
        return m.Choice(tuple(m.IntLiteral(v) for v in values))
    return m.Choice((m.FloatLiteral("0.5"), m.FloatLiteral("1.5")))


def _value(draw: DrawFn, scope: Scope, kind: str) -> m.Expression:
    if scope.kind == "server" and kind in PRIMITIVES and _chance(draw, 4):
        return _choice(draw, kind)
    return draw_expression(draw, scope, kind)


# --- statements --------------------------------------------------------------------------------


def draw_block(draw: DrawFn, scope: Scope, depth: int, most: int = 3) -> m.Block:
    """A block; what it declares is gone behind it."""
    known = len(scope.variables)
    count = draw(st.integers(0, most))
    statements = tuple(draw_statement(draw, scope, depth) for _ in range(count))
    del scope.variables[known:]
    return m.Block(statements)


def draw_body(draw: DrawFn, scope: Scope) -> m.Block:
    """The whole body of a server, method or constructor."""
    block = draw_block(draw, scope, 2, most=5)
    if scope.result == "void":
        return block
    end = m.Return(draw_expression(draw, scope, scope.result))
    return m.Block((*block.statements, end))


def draw_statement(draw: DrawFn, scope: Scope, depth: int) -> m.Statement:
    """One statement."""
    simple: list[_Drawer] = [_assign, _assign, _step, _send, _send, _local, _builtin, _annotated]
    nested: list[_Drawer] = [_if, _if, _while, _for, _switch, _inner_block]
    kind = _one(draw, simple + nested if depth else simple)
    return kind(draw, scope, depth)


def _inner(draw: DrawFn, scope: Scope, depth: int) -> m.Statement:
    """The statement that a header governs: with braces or without."""
    if draw(st.booleans()):
        return draw_block(draw, scope, depth - 1)
    known = len(scope.variables)
    statement = draw_statement(draw, scope, depth - 1)
    del scope.variables[known:]
    return m.Block((statement,)) if isinstance(statement, m.Local) else statement


def _inner_block(draw: DrawFn, scope: Scope, depth: int) -> m.Statement:
    return draw_block(draw, scope, depth - 1)


def _assign(draw: DrawFn, scope: Scope, _: int) -> m.Statement:
    targets = [v for v in scope.variables if v.assignable]
    if not targets:
        return m.Empty()
    target = _one(draw, targets)
    kind = target.type.name
    operator = "="
    if kind in NUMBERS and _chance(draw, 3):
        operator = _one(draw, _COMPOUND_INTEGER if kind in INTEGERS else _COMPOUND)
    value = _value(draw, scope, kind) if operator == "=" else draw_expression(draw, scope, kind, 1)
    return m.ExpressionStatement(m.Assign(operator, _element(draw, target), value))


def _step(draw: DrawFn, scope: Scope, _: int) -> m.Statement:
    targets = [v for v in scope.variables if v.assignable and v.type.name in INTEGERS]
    if not targets:
        return m.Empty()
    target = _element(draw, _one(draw, targets))
    operator = _one(draw, ("++", "--"))
    prefix = draw(st.booleans())
    step = m.Unary(operator, target) if prefix else m.Postfix(operator, target)
    return m.ExpressionStatement(step)


def _receivers(draw: DrawFn, scope: Scope) -> list[tuple[m.Expression | None, str]]:
    receivers: list[tuple[m.Expression | None, str]] = [(m.Self(), scope.owner)]
    if scope.kind == "constructor":
        return receivers
    receivers.append((None, scope.owner))
    for variable in scope.variables:
        if variable.type.name not in PRIMITIVES:
            receivers.append((_element(draw, variable), variable.type.name))
    if scope.sender:
        kind = _one(draw, sorted(scope.servers))
        receivers.append((m.Paren(m.Cast(type_of(kind), m.Name("sender"))), kind))
    return receivers


def _send(draw: DrawFn, scope: Scope, _: int) -> m.Statement:
    options = [
        (target, server)
        for target, kind in _receivers(draw, scope)
        for server in scope.servers[kind]
        if all(not t.dimensions or _has(scope, t) for t in server.types)
    ]
    if not options:
        return m.Empty()
    target, server = _one(draw, options)
    call = _call_of(draw, scope, target, server, 1)
    if draw(st.booleans()):
        call = replace(call, after=_time(draw, scope))
    if _chance(draw, 4):
        call = replace(call, deadline=_time(draw, scope, at_least=50))
    return m.ExpressionStatement(call)


def _has(scope: Scope, wanted: m.Type) -> bool:
    return any(v.type == wanted for v in scope.variables)


def _time(draw: DrawFn, scope: Scope, at_least: int = 0) -> m.Expression:
    if scope.kind == "server" and _chance(draw, 5):
        return m.Choice((m.IntLiteral(at_least + 1), m.IntLiteral(at_least + 2)))
    return m.IntLiteral(at_least + draw(st.integers(0, 40)))


def _local(draw: DrawFn, scope: Scope, _: int) -> m.Statement:
    kind = _one(draw, PRIMITIVES)
    name = scope.fresh()
    if _chance(draw, 4):
        length = draw(st.integers(1, 3))
        type_ = type_of(kind, length)
        values = tuple(draw_expression(draw, scope, kind, 1) for _ in range(length))
        initial: m.Initializer | None = m.ArrayInitializer(values)
    else:
        type_ = type_of(kind)
        initial = _value(draw, scope, kind) if draw(st.integers(0, 3)) else None
    scope.variables.append(Variable(m.Name(name), type_))
    return m.Local(m.Declaration(type_, (m.Declarator(name, initial),)))


def _builtin(draw: DrawFn, scope: Scope, _: int) -> m.Statement:
    if scope.kind == "server" and draw(st.booleans()):
        return m.ExpressionStatement(m.Call(None, "delay", (_time(draw, scope),)))
    condition = _boolean(draw, scope, 1)
    text = (m.StringLiteral('"holds"'),) if draw(st.booleans()) else ()
    return m.ExpressionStatement(m.Call(None, "assertion", (condition, *text)))


def _annotated(draw: DrawFn, scope: Scope, _: int) -> m.Statement:
    if scope.robot and scope.kind == "server":
        right = m.Binary("+", m.Name("X"), m.IntLiteral(draw(st.integers(1, 2))))
        down = m.Binary("-", m.Name("Y"), m.IntLiteral(1))
        x: m.Expression = right if draw(st.booleans()) else m.Name("X")
        y: m.Expression = down if draw(st.booleans()) else m.Name("Y")
        return m.Empty((m.Annotation("Move", (x, y)),))
    return m.Empty((m.Annotation("note", (m.IntLiteral(1),)),) if draw(st.booleans()) else ())


def _if(draw: DrawFn, scope: Scope, depth: int) -> m.Statement:
    condition = _boolean(draw, scope, 2)
    then = _inner(draw, scope, depth)
    if draw(st.booleans()):
        return m.If(condition, _closed(then), _inner(draw, scope, depth))
    return m.If(condition, then)


def _closed(then: m.Statement) -> m.Statement:
    """Without an `if` at its end that would take the `else`."""
    nested = (m.If, m.While, m.For)
    return m.Block((then,)) if isinstance(then, nested) else then


def _while(draw: DrawFn, scope: Scope, depth: int) -> m.Statement:
    body = draw_block(draw, scope, depth - 1)
    end = m.Break()
    return m.While(_boolean(draw, scope, 1), m.Block((*body.statements, end)))


def _for(draw: DrawFn, scope: Scope, depth: int) -> m.Statement:
    name = scope.fresh()
    counter = Variable(m.Name(name), type_of("int"), assignable=False)
    scope.variables.append(counter)
    body = _inner(draw, scope, depth)
    if isinstance(body, m.Block) and _chance(draw, 3):
        skip: m.Statement = m.Break() if draw(st.booleans()) else m.Continue()
        leave = m.If(_boolean(draw, scope, 1), skip)
        body = m.Block((leave, *body.statements))
    scope.variables.remove(counter)
    declaration = m.Declaration(type_of("int"), (m.Declarator(name, m.IntLiteral(0)),))
    bound = m.Binary("<", m.Name(name), m.IntLiteral(draw(st.integers(1, 4))))
    counted = m.Name(name)
    update = m.Postfix("++", counted) if draw(st.booleans()) else m.Unary("++", counted)
    return m.For(declaration, bound, (update,), body)


def _switch(draw: DrawFn, scope: Scope, depth: int) -> m.Statement:
    subject = draw_expression(draw, scope, "int", 1)
    values = draw(st.lists(st.integers(-2, 5), min_size=1, max_size=3, unique=True))
    cases = [_case(draw, scope, depth, _signed(value)) for value in values]
    if draw(st.booleans()):
        cases.append(_case(draw, scope, depth, None))
    return m.Switch(subject, tuple(cases))


def _signed(value: int) -> m.Expression:
    if value < 0:
        return m.Unary("-", m.IntLiteral(-value))
    return m.IntLiteral(value)


def _case(draw: DrawFn, scope: Scope, depth: int, value: m.Expression | None) -> m.Case:
    inner = draw_block(draw, scope, depth - 1, most=2).statements
    statements = tuple(s for s in inner if not isinstance(s, m.Local))
    if len(statements) < len(inner):
        statements = (m.Block(inner),)
    end = (m.Break(),) if draw(st.integers(0, 2)) else ()
    return m.Case(value, (*statements, *end))
