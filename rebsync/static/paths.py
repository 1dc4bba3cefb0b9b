"""How bodies can end, and how much each way out does at least."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from enum import Enum
from typing import TypeAlias

from rebsync.model import (
    Assign,
    Binary,
    Block,
    Break,
    Call,
    Cast,
    Conditional,
    Continue,
    Declaration,
    Empty,
    Expression,
    ExpressionStatement,
    For,
    If,
    Local,
    Paren,
    Return,
    Statement,
    Switch,
    Unary,
    While,
)
from rebsync.records import dataclass
from rebsync.static.constants import constant
from rebsync.unions import assert_never


class Exit(Enum):
    """A way out of a statement; END goes on to the next one."""

    END = "end"
    RETURN = "return"
    BREAK = "break"
    CONTINUE = "continue"


Outcome: TypeAlias = dict[Exit, int]


@dataclass(frozen=True, slots=True)
class Paths:
    """Sums up `weigh` along every path; tells `dead` about each statement on none."""

    weigh: Callable[[Call], int]
    dead: Callable[[Statement], None]

    def sequence(self, statements: tuple[Statement, ...]) -> Outcome:
        """The least weight for every way out of some statements."""
        total: Outcome = {Exit.END: 0}
        for statement in statements:
            if Exit.END not in total:
                self.dead(statement)
                break
            total = _then(total, self._statement(statement))
        return total

    def _statement(self, statement: Statement) -> Outcome:
        match statement:
            case ExpressionStatement(expression):
                return {Exit.END: self._weight(expression)}
            case Local(declaration):
                return {Exit.END: self._declared(declaration)}
            case Block(statements):
                return self.sequence(statements)
            case If():
                return self._if(statement)
            case While(condition, body):
                return self._loop(condition, body)
            case For(initial, condition, _, body):
                start = self._initial(initial)
                return _then({Exit.END: start}, self._loop(condition, body))
            case Switch():
                return self._switch(statement)
            case Return(value):
                return {Exit.RETURN: self._weight(value)}
            case Break():
                return {Exit.BREAK: 0}
            case Continue():
                return {Exit.CONTINUE: 0}
            case Empty():
                return {Exit.END: 0}
            case _:
                assert_never(statement)

    def _if(self, statement: If) -> Outcome:
        # A loop, since a chain of else-ifs nests as deep as it is long.
        total: Outcome = {}
        before = 0
        current: Statement | None = statement
        while isinstance(current, If):
            before += self._weight(current.condition)
            value = constant(current.condition)
            if value is False:
                self.dead(current.then)
            else:
                taken = self._statement(current.then)
                total = _either(total, _then({Exit.END: before}, taken))
            if value is True:
                if current.otherwise is not None:
                    self.dead(current.otherwise)
                return total
            current = current.otherwise
        rest = {Exit.END: 0} if current is None else self._statement(current)
        return _either(total, _then({Exit.END: before}, rest))

    def _loop(self, condition: Expression | None, body: Statement) -> Outcome:
        value = True if condition is None else constant(condition)
        if value is False:
            self.dead(body)
            return {Exit.END: 0}
        before = self._weight(condition)
        inside = _then({Exit.END: before}, self._statement(body))
        total = {Exit.RETURN: inside[Exit.RETURN]} if Exit.RETURN in inside else {}
        if value is not True:
            total[Exit.END] = before
        elif Exit.BREAK in inside:
            total[Exit.END] = inside[Exit.BREAK]
        return total

    def _switch(self, switch: Switch) -> Outcome:
        before = {Exit.END: self._weight(switch.subject)}
        entries: Outcome = {} if any(c.value is None for c in switch.cases) else {Exit.END: 0}
        following: Outcome = {Exit.END: 0}
        for case in reversed(switch.cases):
            following = _then(self.sequence(case.statements), following)
            entries = _either(entries, following)
        if Exit.BREAK in entries:
            left = {Exit.END: entries.pop(Exit.BREAK)}
            entries = _either(entries, left)
        return _then(before, entries)

    def _initial(self, initial: Declaration | tuple[Expression, ...]) -> int:
        if isinstance(initial, Declaration):
            return self._declared(initial)
        return sum(self._weight(e) for e in initial)

    def _declared(self, declaration: Declaration) -> int:
        initials = (d.initial for d in declaration.declarators)
        return sum(self._weight(i) for i in initials if isinstance(i, Call | Assign | Binary))

    def _weight(self, expression: Expression | None) -> int:
        return sum(self.weigh(call) for call in calls_always_made(expression))


def calls_always_made(expression: Expression | None) -> Iterator[Call]:
    """The calls that happen whenever an expression is evaluated."""
    match expression:
        case Call():
            for argument in expression.arguments:
                yield from calls_always_made(argument)
            yield expression
        case Assign(_, _, inner) | Paren(inner) | Cast(_, inner) | Unary(_, inner):
            yield from calls_always_made(inner)
        case Conditional(condition, _, _):
            yield from calls_always_made(condition)
        case Binary():
            *operands, first = _spine(expression)
            yield from calls_always_made(first.left)
            for node in (first, *reversed(operands)):
                if node.operator not in ("&&", "||"):
                    yield from calls_always_made(node.right)


def _spine(expression: Binary) -> list[Binary]:
    """The operators of a chain such as `a + b + c`, the last one first."""
    spine = [expression]
    while isinstance(spine[-1].left, Binary):
        spine.append(spine[-1].left)
    return spine


def _then(first: Outcome, second: Outcome) -> Outcome:
    if Exit.END not in first:
        return first
    at_end = first[Exit.END]
    rest: Outcome = dict(first)
    del rest[Exit.END]
    return _either(rest, {exit_: at_end + n for exit_, n in second.items()})


def _either(one: Outcome, other: Outcome) -> Outcome:
    both = dict(one)
    for exit_, n in other.items():
        both[exit_] = min(n, both.get(exit_, n))
    return both
