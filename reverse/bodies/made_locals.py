"""Locals that the code does not have, made for the fields of messages, taken out again."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace

from rebsync import model as m
from rebsync.reverse.models.building import is_calm


def tidied(statements: tuple[m.Statement, ...], made: Collection[str]) -> tuple[m.Statement, ...]:
    """The same with less: what is set once and used once, in the next statement, stands there.

    `made` are the locals that may go.
    """
    if not made:
        return statements
    inner = [_inside(s, made) for s in statements]
    names = _NameCounts()
    return tuple(_used(list(_declared_late(inner, made, names)), made, names))


def _inside(statement: m.Statement, made: Collection[str]) -> m.Statement:
    match statement:
        case m.Block(inner):
            return replace(statement, statements=tidied(inner, made))
        case m.If(_, then, otherwise):
            other = _inside(otherwise, made) if otherwise is not None else None
            return replace(statement, then=_inside(then, made), otherwise=other)
        case m.While() | m.For():
            return replace(statement, body=_inside(statement.body, made))
        case m.Switch(_, cases):
            read = tuple(replace(c, statements=tidied(c.statements, made)) for c in cases)
            return replace(statement, cases=read)
        case _:
            return statement


class _NameCounts:
    """How often statements name variables: each is looked through once."""

    def __init__(self) -> None:
        self._known: dict[int, tuple[m.Node, Counter[str]]] = {}

    def mentions(self, node: m.Node, name: str) -> int:
        """How often a statement or expression names a variable."""
        if id(node) not in self._known:
            names = [n.name for n in m.walk(node) if isinstance(n, m.Name)]
            self._known[id(node)] = node, Counter(names)  # with the node the id stays its own
        return self._known[id(node)][1][name]

    def next(self, statements: Sequence[m.Statement], index: int, name: str) -> int:
        """The next statement that names a variable; 0 if there is none."""
        for later in range(index + 1, len(statements)):
            if self.mentions(statements[later], name):
                return later
        return 0


def _local(statement: m.Statement, made: Collection[str]) -> m.Declarator | None:
    match statement:
        case m.Local(m.Declaration(type_, (declarator,)), ()) if declarator.name in made:
            return None if type_.dimensions else declarator
        case _:
            return None


# --- where a local is declared ------------------------------------------------------------------


def _declared_late(
    statements: list[m.Statement], made: Collection[str], names: _NameCounts
) -> Iterator[m.Statement]:
    """Declares a local where it gets its first value, if that is in the same block."""
    changed: dict[int, m.Statement | None] = {}
    for index, statement in enumerate(statements):
        declarator = _local(statement, made)
        if declarator is None or not isinstance(statement, m.Local):
            continue
        if not _is_calm_initial(declarator.initial):
            continue
        later = names.next(statements, index, declarator.name)
        value = _first_value(statements[later], declarator.name, names) if later else None
        if value is not None:
            known = replace(declarator, initial=value)
            declaration = replace(statement.declaration, declarators=(known,))
            changed |= {index: None, later: replace(statement, declaration=declaration)}
    for index, statement in enumerate(statements):
        kept = changed.get(index, statement)
        if kept is not None:
            yield kept


def _is_calm_initial(initial: m.Initializer | None) -> bool:
    return initial is None or (not isinstance(initial, m.ArrayInitializer) and is_calm(initial))


def _first_value(statement: m.Statement, name: str, names: _NameCounts) -> m.Expression | None:
    match statement:
        case m.ExpressionStatement(m.Assign("=", m.Name(written), value), ()):
            return value if written == name and not names.mentions(value, name) else None
        case _:
            return None


# --- where its value is used --------------------------------------------------------------------


def _used(
    statements: list[m.Statement], made: Collection[str], names: _NameCounts
) -> Iterator[m.Statement]:
    """Puts the value of a local where it is used: once, with nothing done in between."""
    for index, statement in enumerate(statements):
        declarator = _local(statement, made)
        if declarator is None or not _may_wait(declarator.initial):
            yield statement
            continue
        name, initial = declarator.name, declarator.initial
        uses = sum(names.mentions(s, name) for s in statements[index + 1 :])
        if uses == 0 and _is_calm_initial(initial):
            continue
        later = names.next(statements, index, name)
        between = statements[index + 1 : later]
        replaced = None
        if uses == 1 and later and all(_is_calm_local(s, made) for s in between):
            assert initial is not None and not isinstance(initial, m.ArrayInitializer)
            replaced = _replaced(statements[later], name, initial)
        if replaced is None:
            yield statement
        else:
            statements[later] = replaced


def _may_wait(initial: m.Initializer | None) -> bool:
    """Whether a value is the same behind declarations of other locals."""
    if initial is None or isinstance(initial, m.ArrayInitializer):
        return False
    return is_calm(initial) or isinstance(initial, m.Choice)


def _is_calm_local(statement: m.Statement, made: Collection[str]) -> bool:
    declarator = _local(statement, made)
    return declarator is not None and _may_wait(declarator.initial)


def _replaced(statement: m.Statement, name: str, value: m.Expression) -> m.Statement | None:
    """A send, or what gives a variable its value, with a value in the place of a name."""
    used = m.Name(name)
    match statement:
        case m.ExpressionStatement(m.Call(_, _, arguments) as call) if used in arguments:
            if not all(is_calm(a) or isinstance(a, m.Choice) for a in arguments):
                return None
            known = tuple(value if a == used else a for a in arguments)
            return replace(statement, expression=replace(call, arguments=known))
        case m.ExpressionStatement(m.Assign("=", m.Name(), right) as assigned) if right == used:
            return replace(statement, expression=replace(assigned, value=value))
        case m.Local(m.Declaration(_, (declarator,)) as declaration):
            if declarator.initial != used:
                return None
            known_ = replace(declarator, initial=value)
            return replace(statement, declaration=replace(declaration, declarators=(known_,)))
        case _:
            return None
