"""Statements of the model in C++: one list of lines a body."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace

from rebsync import model as m
from rebsync.forward.cpp_expressions import CppExpressions
from rebsync.forward.cpp_types import cpp_type
from rebsync.forward.hoisting import crossing_locals, read_declarations
from rebsync.forward.remarks import Remarks
from rebsync.printing import print_line
from rebsync.records import dataclass
from rebsync.unions import assert_never

_INDENT = "  "


@dataclass(frozen=True, slots=True)
class CppStatements:
    """Prints the bodies of one class; `remarks` are the model's comments."""

    expressions: CppExpressions
    remarks: Remarks
    read: Collection[int]
    hoisted: Collection[int]

    def body(self, block: m.Block | None, parameters: tuple[m.Parameter, ...]) -> list[str]:
        """The lines of a body; parameters that it does not use are marked as such."""
        if block is None:
            return self._unused(
                [(self.expressions.names.local(p.name), p) for p in parameters], frozenset()
            )
        names = self.expressions.names
        read = read_declarations([block], self.expressions.analysis)
        named = [(names.local(p.name), p) for p in parameters]
        declared = {names.local(d.name) for d in m.walk(block) if isinstance(d, m.Declarator)}
        taken = names.hidden() | declared | {name for name, _ in named}
        inner = replace(self, expressions=replace(self.expressions, taken=frozenset(taken)))
        return [
            *self._unused(named, read),
            *inner._statements(block.statements, block.span.start + 1, block.span.end - 1),
        ]

    def returns(self, block: m.Block) -> bool:
        """Whether every way through a body ends in a `return`."""
        return _returns(block)

    def _unused(self, named: list[tuple[str, m.Parameter]], read: Collection[int]) -> list[str]:
        names = [name for name, parameter in named if id(parameter) not in read]
        return [f"unused({', '.join(names)});"] if names else []

    def _statements(
        self, statements: tuple[m.Statement, ...], start: int, end: int
    ) -> Iterator[str]:
        at = start
        for statement in statements:
            yield from self.remarks.between(at, statement.span.start)
            yield from _annotations(statement)
            own = tuple(self._statement(statement))
            lines, at = self.remarks.beside(own, statement.span.end, end)
            yield from lines
        yield from self.remarks.between(at, end)

    def _statement(self, statement: m.Statement) -> Iterator[str]:
        text = self.expressions.text
        match statement:
            case m.Block(statements):
                yield "{"
                yield from self._nested(statements, statement)
                yield "}"
            case m.ExpressionStatement(expression):
                yield from self._expression_statement(expression)
            case m.Local(declaration):
                yield from self._local(declaration)
            case m.If():
                yield from self._if(statement)
            case m.While(condition, body):
                yield f"while ({text(condition)}) {{"
                yield from self._branch(body)
                yield "}"
            case m.For():
                yield from self._for(statement)
            case m.Switch():
                yield from self._switch(statement)
            case m.Return(value):
                yield "return;" if value is None else f"return {text(value)};"
            case m.Break():
                yield "break;"
            case m.Continue():
                yield "continue;"
            case m.Empty():
                yield from self._empty(statement)
            case _:
                assert_never(statement)

    def _nested(self, statements: tuple[m.Statement, ...], within: m.Statement) -> Iterator[str]:
        for line in self._statements(statements, within.span.start, within.span.end):
            yield _INDENT + line if line else line

    def _branch(self, body: m.Statement) -> Iterator[str]:
        """The lines of a branch or loop body, whose braces the caller writes."""
        if isinstance(body, m.Block) and not body.annotations:
            yield from self._nested(body.statements, body)
        else:
            yield from (_INDENT + line for line in self._statements((body,), body.span.start, 0))

    def _expression_statement(self, expression: m.Expression) -> Iterator[str]:
        yield f"{self._effect(expression)};"

    def _effect(self, expression: m.Expression) -> str:
        """An expression for what it does; its value is marked as unused where it does nothing."""
        text, type_ = self.expressions.text(expression), self.expressions.type_of(expression)
        void = type_ is not None and type_.name == "void"
        return text if void or _has_effect(expression) else f"static_cast<void>({text})"

    def _local(self, declaration: m.Declaration) -> Iterator[str]:
        here = tuple(d for d in declaration.declarators if id(d) not in self.hoisted)
        for declarator in declaration.declarators:
            if id(declarator) in self.hoisted:
                yield f"{self._declarator(declarator, declaration.type, assigned=True)};"
        if here:
            yield f"{self._declaration(replace(declaration, declarators=here))};"
        names = [
            self.expressions.names.local(d.name)
            for d in declaration.declarators
            if id(d) not in self.read
        ]
        if names:
            yield f"unused({', '.join(names)});"

    def _if(self, statement: m.If) -> Iterator[str]:
        yield f"if ({self.expressions.text(statement.condition)}) {{"
        yield from self._branch(statement.then)
        otherwise = statement.otherwise
        while isinstance(otherwise, m.If) and not otherwise.annotations:
            yield f"}} else if ({self.expressions.text(otherwise.condition)}) {{"
            yield from self._branch(otherwise.then)
            otherwise = otherwise.otherwise
        if otherwise is not None:
            yield "} else {"
            yield from self._branch(otherwise)
        yield "}"

    def _for(self, statement: m.For) -> Iterator[str]:
        text = self.expressions.text
        if isinstance(statement.initial, m.Declaration):
            initial = self._declaration(statement.initial)
        else:
            initial = ", ".join(map(self._effect, statement.initial))
        condition = f" {text(statement.condition)}" if statement.condition is not None else ""
        updates = ", ".join(map(self._effect, statement.updates))
        yield f"for ({initial};{condition};{f' {updates}' if updates else ''}) {{"
        yield from self._branch(statement.body)
        yield "}"

    def _switch(self, statement: m.Switch) -> Iterator[str]:
        crossing = crossing_locals(statement, self.expressions.analysis)
        if not crossing:
            yield from self._cases(statement)
            return
        yield "{"
        for declaration, declarator in crossing:
            name = self.expressions.names.local(declarator.name)
            yield f"{_INDENT}// rebsync: local {declarator.name}"
            yield f"{_INDENT}{cpp_type(declaration.type)} {name}{{}};"
        yield from (_INDENT + line for line in self._cases(statement))
        yield "}"

    def _cases(self, statement: m.Switch) -> Iterator[str]:
        yield f"switch ({self.expressions.text(statement.subject)}) {{"
        for i, case in enumerate(statement.cases):
            label = "default" if case.value is None else f"case {self.expressions.text(case.value)}"
            lines = list(self._statements(case.statements, case.span.start, case.span.start))
            last = i == len(statement.cases) - 1
            yield from (_INDENT + line for line in _annotations(case))
            if not lines and not last:
                yield f"{_INDENT}{label}:"
                continue
            yield f"{_INDENT}{label}: {{"
            yield from (f"{_INDENT * 2}{line}" for line in lines)
            yield f"{_INDENT}}}"
            if not last and case.statements and not _leaves(case.statements[-1]):
                yield f"{_INDENT * 2}// fall through"
        yield "}"

    def _empty(self, statement: m.Empty) -> Iterator[str]:
        moves = [a for a in statement.annotations if a.name == "Move"]
        if not moves:
            yield ";"
        for move in moves:
            arguments = move.arguments or ()
            cells = [self._offset(a) for a in arguments]
            yield f"{self.expressions.call_in_order('drive_.move', cells, arguments)};"

    def _offset(self, argument: m.Expression) -> str:
        """`X + e` as `e`, `X - e` as `-e`, `X` as 0."""
        match argument:
            case m.Paren(inner):
                return self._offset(inner)
            case m.Name():
                return "0"
            case m.Binary(operator="-", right=right):
                text = self.expressions.text(right)
                simple = isinstance(right, m.IntLiteral | m.Name | m.Paren | m.Call)
                return f"-{text}" if simple else f"-({text})"
            case m.Binary(right=right):
                return self.expressions.text(right)
            case _:
                return self.expressions.text(argument)

    def _declaration(self, declaration: m.Declaration) -> str:
        type_ = declaration.type
        parts = [self._declarator(d, type_) for d in declaration.declarators]
        return f"{cpp_type(type_)} {', '.join(parts)}"

    def _declarator(self, declarator: m.Declarator, type_: m.Type, assigned: bool = False) -> str:
        name = self.expressions.names.local(declarator.name)
        before = f"{name} = {cpp_type(type_)}" if assigned else name
        match declarator.initial:
            case None:
                return f"{before}{{}}"
            case m.ArrayInitializer():
                return f"{before}{self._array(declarator.initial, type_)}"
            case expression:
                return f"{name} = {self.expressions.stored(expression, type_)}"

    def _array(self, initial: m.ArrayInitializer, type_: m.Type) -> str:
        inner = m.Type(type_.name, type_.dimensions[1:])
        values = [
            self._array(v, inner)
            if isinstance(v, m.ArrayInitializer)
            else self.expressions.braced(v, inner)
            for v in initial.values
        ]
        return "{{" + ", ".join(values) + "}}"


def _annotations(of: m.Statement | m.Case) -> Iterator[str]:
    """The markers of annotations, which stand right above what they are on."""
    for annotation in of.annotations:
        if annotation.name != "Move":
            yield f"// rebsync: annotation {print_line(annotation).strip()}"


def _returns(statement: m.Statement) -> bool:
    match statement:
        case m.Return():
            return True
        case m.Block(statements):
            return bool(statements) and _returns(statements[-1])
        case m.If(then=then, otherwise=otherwise):
            return otherwise is not None and _returns(then) and _returns(otherwise)
        case m.Switch(cases=cases) if any(c.value is None for c in cases):
            parts = [c.statements for c in cases]
            ends = all(_returns(part[-1]) for part in parts if part) and bool(parts[-1])
            return ends and not any(_breaks(s) for part in parts for s in part)
        case _:
            return False


def _breaks(statement: m.Node) -> bool:
    """Whether a `break` within a statement is one of the switch that the statement is in."""
    if isinstance(statement, m.For | m.While | m.Switch):
        return False
    return isinstance(statement, m.Break) or any(map(_breaks, m.children(statement)))


def _has_effect(expression: m.Expression) -> bool:
    match expression:
        case m.Assign() | m.Call() | m.Postfix() | m.Unary(operator="++" | "--"):
            return True
        case _:
            return False


def _leaves(statement: m.Statement) -> bool:
    """Whether control never goes on behind the statement to the next case."""
    match statement:
        case m.Break() | m.Continue() | m.Return():
            return True
        case m.Block(statements):
            return bool(statements) and _leaves(statements[-1])
        case m.If(then=then, otherwise=otherwise):
            return otherwise is not None and _leaves(then) and _leaves(otherwise)
        case _:
            return False
