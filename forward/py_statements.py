"""Statements of the model in Python: one list of lines a body."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import field

from rebsync import model as m
from rebsync.forward.hoisting import crossing_locals
from rebsync.forward.py_expressions import PyExpressions
from rebsync.forward.py_layout import INDENT
from rebsync.forward.py_locals import local_names
from rebsync.forward.py_loops import counting, steps
from rebsync.forward.py_operators import ATOM, UNARY
from rebsync.forward.py_places import bare, compound, is_in_order, step
from rebsync.forward.py_switches import Branch, branches, is_place
from rebsync.forward.py_types import py_type, unset_value
from rebsync.forward.remarks import Remarks
from rebsync.names import unique
from rebsync.printing import print_line
from rebsync.records import dataclass
from rebsync.static.types import INT
from rebsync.unions import assert_never


@dataclass(slots=True)
class PyStatements:
    """Prints the bodies of one class; `remarks` are the model's comments.

    `hoisted` are the locals that stand before a `switch`, `repeated` those whose name has its type
    from another block. `cases` are the names of the switches around a statement, `loop` the number
    of those that are inside of its innermost loop, `again` what tells the first round of a loop.
    """

    expressions: PyExpressions
    remarks: Remarks
    hoisted: Collection[int]
    repeated: Collection[int] = ()
    cases: list[str] = field(default_factory=list)
    loop: int = 0
    again: str = "again"
    result: m.Type | None = None

    def body(
        self, block: m.Block, parameters: tuple[m.Parameter, ...], result: m.Type | None = None
    ) -> list[str]:
        """The lines of a body; `result` is the type that it returns."""
        self.result = result
        self._name_locals(block, parameters)
        return self._suite(block.statements, block.span.start + 1, block.span.end - 1)

    def returns(self, statement: m.Statement) -> bool:
        """Whether every way through a statement ends in a `return`."""
        match statement:
            case m.Return():
                return True
            case m.Block(statements):
                return bool(statements) and self.returns(statements[-1])
            case m.If(then=then, otherwise=otherwise):
                return otherwise is not None and self.returns(then) and self.returns(otherwise)
            case m.Switch() if (plain := self._plain(statement)) is not None:
                ends = [b.statements[-1:] for b in plain]
                return not plain[-1].values and all(e and self.returns(e[0]) for e in ends)
            case _:
                return False

    def _name_locals(self, block: m.Block, parameters: tuple[m.Parameter, ...]) -> None:
        names, e = self.expressions.names, self.expressions
        given = [names.local(p.name) for p in parameters]
        found = local_names(block, given, self.hoisted, e.analysis, names.local)
        e.locals |= found.names
        self.repeated = found.repeated
        e.used = {*names.hidden(), *given, *found.names.values()}
        self.cases, self.again = [], _numbered("again", e.used)

    # --- sequences ------------------------------------------------------------------------------

    def _suite(self, statements: tuple[m.Statement, ...], start: int, end: int) -> list[str]:
        lines = list(self._statements(statements, start, end))
        code = [line for line in lines if not line.lstrip().startswith("#")]
        return lines if code else [*lines, "pass"]

    def _statements(
        self, statements: tuple[m.Statement, ...], start: int, end: int
    ) -> Iterator[str]:
        at = start
        for statement in statements:
            yield from self._remarks(at, statement.span.start)
            if not isinstance(statement, m.For | m.Switch):
                yield from self._annotations(statement)
            own = tuple(self._statement(statement))
            lines, at = self.remarks.beside(own, statement.span.end, end, "#")
            yield from lines
        yield from self._remarks(at, end)

    def _annotations(self, statement: m.Statement | m.Case) -> Iterator[str]:
        """The markers of annotations, which stand right above what they are on."""
        for annotation in statement.annotations:
            if annotation.name != "Move":
                yield f"# rebsync: annotation {print_line(annotation).strip()}"

    def _remarks(self, start: int, end: int) -> Iterator[str]:
        return (f"#{line[2:]}" for line in self.remarks.between(start, end))

    def _branch(self, body: m.Statement) -> Iterator[str]:
        if isinstance(body, m.Block) and not body.annotations:
            lines = self._suite(body.statements, body.span.start, body.span.end)
        else:
            lines = self._suite((body,), body.span.start, 0)
        yield from (INDENT + line for line in lines)

    def _statement(self, statement: m.Statement) -> Iterator[str]:
        text = self.expressions.text
        match statement:
            case m.Block():
                yield "with block():"
                yield from self._branch(m.Block(statement.statements, span=statement.span))
            case m.ExpressionStatement(expression):
                yield self._effect(expression)
            case m.Local(declaration):
                yield from self._local(declaration)
            case m.If():
                yield from self._if(statement)
            case m.While(condition, body):
                yield f"while {text(condition)}:"
                yield from self._looped(body)
            case m.For():
                yield from self._for(statement)
            case m.Switch():
                yield from self._switch(statement)
            case m.Return(value):
                yield "return" if value is None else f"return {self._returned(value)}"
            case m.Break():
                yield "break"
            case m.Continue():
                yield from self._continue()
            case m.Empty():
                yield from self._empty(statement)
            case _:
                assert_never(statement)

    def _returned(self, value: m.Expression) -> str:
        type_ = self.result or self.expressions.type_of(value) or INT
        return self.expressions.stored(value, type_)

    # --- effects --------------------------------------------------------------------------------

    def _effect(self, expression: m.Expression) -> str:
        """An expression for what it does."""
        e = self.expressions
        match expression:
            case m.Assign(operator, target) if is_in_order(e, expression):
                place = e.operand(bare(target), ATOM)
                if operator == "=":
                    return f"{place} = {e.stored(expression.value, e.type_of(target) or INT)}"
                if self._is_simple(target):
                    return f"{place} = {compound(e, expression, place)}"
            case m.Unary("++" | "--", operand) | m.Postfix(operand=operand):
                if self._is_simple(operand):
                    place = e.operand(bare(operand), ATOM)
                    return f"{place} = {step(e, expression, place)}"
            case _:
                pass
        return e.raw(expression).text

    def _is_simple(self, target: m.Expression) -> bool:
        """Whether a target may be named twice, for reading and for storing."""
        return not any(
            isinstance(n, m.Assign | m.Call | m.Postfix | m.Choice)
            or (isinstance(n, m.Unary) and n.operator in ("++", "--"))
            for n in m.walk(target)
        )

    def _local(self, declaration: m.Declaration) -> Iterator[str]:
        for declarator in declaration.declarators:
            name, type_ = self._name(declarator), declaration.type
            is_typed = id(declarator) in self.hoisted or id(declarator) in self.repeated
            typed = name if is_typed else f"{name}: {py_type(type_)}"
            yield f"{typed} = {self._initial(declarator, type_)}"

    def _name(self, declarator: m.Declarator) -> str:
        return self.expressions.locals[id(declarator)]

    def _initial(self, declarator: m.Declarator, type_: m.Type) -> str:
        match declarator.initial:
            case None:
                return unset_value(type_)
            case m.ArrayInitializer():
                return self._array(declarator.initial, type_)
            case expression:
                return self.expressions.stored(expression, type_)

    def _array(self, initial: m.ArrayInitializer, type_: m.Type) -> str:
        inner = m.Type(type_.name, type_.dimensions[1:])
        values = [
            self._array(v, inner)
            if isinstance(v, m.ArrayInitializer)
            else self.expressions.stored(bare(v), inner)  # a formatter takes parentheses away
            for v in initial.values
        ]
        return f"Array([{', '.join(values)}])"

    # --- control --------------------------------------------------------------------------------

    def _if(self, statement: m.If) -> Iterator[str]:
        yield f"if {self.expressions.text(statement.condition)}:"
        yield from self._branch(statement.then)
        otherwise = statement.otherwise
        while isinstance(otherwise, m.If) and not otherwise.annotations:
            yield f"elif {self.expressions.text(otherwise.condition)}:"
            yield from self._branch(otherwise.then)
            otherwise = otherwise.otherwise
        if otherwise is not None:
            yield "else:"
            yield from self._branch(otherwise)

    def _looped(self, body: m.Statement) -> Iterator[str]:
        outer, self.loop = self.loop, 0
        yield from self._branch(body)
        self.loop = outer

    def _for(self, statement: m.For) -> Iterator[str]:
        counter = counting(statement, self.expressions.analysis)
        if counter is not None:
            yield from self._annotations(statement)
            yield f"for {self._name(counter)} in range({self._ends(counter, statement)}):"
            yield from self._looped(statement.body)
            return
        if isinstance(statement.initial, m.Declaration):
            yield from self._local(statement.initial)
        else:
            yield from map(self._effect, statement.initial)
        yield from self._annotations(statement)
        condition = statement.condition
        if condition is not None and (last := steps(statement)):
            yield f"while {self.expressions.text(condition)}:"
            yield from self._looped(statement.body)
            yield f"{INDENT}# rebsync: step"
            yield from (INDENT + self._effect(u) for u in last)
            return
        yield f"for {self.again} in rounds():"
        if statement.updates:
            yield f"{INDENT}if {self.again}:"
            yield from (INDENT * 2 + self._effect(u) for u in statement.updates)
        if statement.condition is not None:
            yield f"{INDENT}if not {self.expressions.operand(statement.condition, UNARY)}:"
            yield f"{INDENT * 2}break"
        yield from self._looped(statement.body)

    def _ends(self, counter: m.Declarator, loop: m.For) -> str:
        """The arguments of `range` for what a loop counts from and to."""
        start, end = counter.initial, loop.condition
        assert isinstance(end, m.Binary) and not isinstance(start, m.ArrayInitializer | None)
        first = self.expressions.text(start)
        last = self.expressions.text(end.right)
        return last if start == m.IntLiteral(0) else f"{first}, {last}"

    def _continue(self) -> Iterator[str]:
        """In a switch, `continue` means the loop around it."""
        if self.loop:
            yield f"{self.cases[-1]}.go_on()"
            yield "break"
        else:
            yield "continue"

    def _switch(self, statement: m.Switch) -> Iterator[str]:
        for declaration, declarator in crossing_locals(statement, self.expressions.analysis):
            yield f"# rebsync: local {declarator.name}"
            name = self._name(declarator)
            yield f"{name}: {py_type(declaration.type)} = {unset_value(declaration.type)}"
        plain = self._plain(statement)
        if plain is not None:
            yield from self._annotations(statement)
            yield from self._chain(statement.subject, plain)
            return
        case = _numbered("case", {*self.expressions.used, *self.cases})
        self.cases.append(case)
        self.loop += 1
        yield from self._annotations(statement)
        yield f"for {case} in switch({self.expressions.text(statement.subject)}):"
        lines = [
            INDENT + line for i in range(len(statement.cases)) for line in self._one(statement, i)
        ]
        yield from lines or [f"{INDENT}pass"]
        self.cases.pop()
        self.loop -= 1
        if any(line.strip() == f"{case}.go_on()" for line in lines):
            yield f"if {case}.goes_on:"
            yield from (INDENT + line for line in self._continue())

    def _plain(self, statement: m.Switch) -> tuple[Branch, ...] | None:
        """The branches of a switch that is an `if` chain in Python."""
        is_steady = is_place(statement.subject, self.expressions.analysis)
        return branches(statement) if is_steady else None

    def _chain(self, subject: m.Expression, plain: tuple[Branch, ...]) -> Iterator[str]:
        """A switch whose cases do not fall through."""
        asked = self.expressions.operand(subject, ATOM)
        yield "# rebsync: switch"
        for branch in plain:
            values = [self.expressions.text(v) for v in branch.values]
            word = "if" if branch is plain[0] else "elif"
            match values:
                case []:
                    yield "else:"
                case [value]:
                    yield f"{word} {asked} == {value}:"
                case _:
                    yield f"{word} {asked} in ({', '.join(values)}):"
            lines = self._suite(branch.statements, branch.start, branch.end)
            yield from (INDENT + line for line in lines)

    def _one(self, statement: m.Switch, index: int) -> Iterator[str]:
        case = statement.cases[index]
        name = self.cases[-1]
        yield from self._annotations(case)
        if case.value is None:
            later = [c.value for c in statement.cases[index + 1 :] if c.value is not None]
            yield f"if {name}.default({', '.join(map(self.expressions.text, later))}):"
        else:
            yield f"if {name}({self.expressions.text(case.value)}):"
        suite = self._suite(case.statements, case.span.start, case.span.start)
        yield from (INDENT + line for line in suite)

    # --- moves ----------------------------------------------------------------------------------

    def _empty(self, statement: m.Empty) -> Iterator[str]:
        moves = [a for a in statement.annotations if a.name == "Move"]
        if not moves:
            yield "..."
        for move in moves:
            cells = [self._offset(a) for a in move.arguments or ()]
            yield f"self._drive.move({', '.join(cells)})"

    def _offset(self, argument: m.Expression) -> str:
        """`X + e` as `e`, `X - e` as `-e`, `X` as 0."""
        match argument:
            case m.Paren(inner):
                return self._offset(inner)
            case m.Name():
                return "0"
            case m.Binary(operator="-", right=right):
                return f"-{self.expressions.operand(right, UNARY)}"
            case m.Binary(right=right):
                return self.expressions.text(right)
            case _:
                return self.expressions.text(argument)


def _numbered(name: str, used: Collection[str]) -> str:
    """The name, with a number behind it where that is used."""
    return unique(name, set(used), "")
