"""Variables without an initial value: C++ leaves in them what is in memory, a model has zero."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.models.building import bare
from rebsync.static.constants import constant

# The variables that have a value, elements of arrays as `a[0]`; None where no way goes on.
Set = frozenset[str]
Ways = Set | None


def read_unset(
    variables: Mapping[str, m.Type],
    constructor: m.Block,
    servers: Sequence[m.MessageServer],
    methods: Sequence[m.Method],
) -> list[str]:
    """Those variables that some body may read before any has written them."""
    reads = _Reads(variables, {f.name: f for f in methods}, set(), [], {})
    known = reads.body(constructor, frozenset())
    for server in servers:
        if server.body is not None:
            reads.body(server.body, known)
    return [name for name in variables if name in reads.found]


@dataclass(slots=True)
class _Reads:
    """Follows bodies: `found` are the variables read too early, `left` what held at returns.

    `known` are methods with what they read first and what they always write.
    """

    variables: Mapping[str, m.Type]
    methods: Mapping[str, m.Method]
    found: set[str]
    left: list[Set]
    known: dict[str, tuple[Set, Set]]

    def body(self, body: m.Block, known: Set) -> Set:
        """What has a value after a body."""
        around, self.left = self.left, []
        after = self._statement(body, known)
        ends = [*self.left, *([after] if after is not None else [])]
        self.left = around
        return frozenset.intersection(*ends) if ends else known

    def _each(self, statements: Sequence[m.Statement], known: Set) -> Ways:
        ways: Ways = known
        for statement in statements:
            if ways is None:
                break
            ways = self._statement(statement, ways)
        return ways

    def _statement(self, statement: m.Statement, known: Set) -> Ways:
        match statement:
            case m.Block(statements):
                return self._each(statements, known)
            case m.ExpressionStatement(expression):
                return self._expression(expression, known)
            case m.Local(declaration):
                return self._declared(declaration, known)
            case m.If(condition, then, otherwise):
                known = self._expression(condition, known)
                ways = self._statement(then, known)
                other = self._statement(otherwise, known) if otherwise is not None else known
                return _both(ways, other)
            case m.While(condition, body):
                known = self._expression(condition, known)
                self._statement(body, known)
                return known
            case m.For():
                return self._for(statement, known)
            case m.Switch(subject, cases):
                known = self._expression(subject, known)
                for case in cases:
                    self._each(case.statements, known)
                return known
            case m.Return(value):
                self.left.append(self._expression(value, known) if value is not None else known)
                return None
            case m.Break() | m.Continue():
                return None
            case _:
                return known

    def _declared(self, declaration: m.Declaration, known: Set) -> Set:
        for declarator in declaration.declarators:
            for value in _values(declarator.initial):
                known = self._expression(value, known)
        return known

    def _for(self, loop: m.For, known: Set) -> Set:
        if isinstance(loop.initial, m.Declaration):
            known = self._declared(loop.initial, known)
        else:
            known = self._all(loop.initial, known)
        if loop.condition is not None:
            known = self._expression(loop.condition, known)
        after = self._statement(loop.body, known)
        if after is not None:
            self._all(loop.updates, after)
        return known | {a for a in _filled(loop) if _length(self.variables, a) <= _rounds(loop)}

    # --- expressions ----------------------------------------------------------------------------

    def _all(self, expressions: Sequence[m.Expression], known: Set) -> Set:
        for expression in expressions:
            known = self._expression(expression, known)
        return known

    def _expression(self, expression: m.Expression, known: Set) -> Set:
        match expression:
            case m.Assign("=", target, value):
                return self._written(bare(target), self._expression(value, known))
            case m.Name(name) | m.Member(m.Self(), name):
                if name in self.variables and name not in known:
                    self.found.add(name)
                return known
            case m.Index(m.Name(name), m.IntLiteral(index)) if f"{name}[{index}]" in known:
                return known
            case m.Binary("&&" | "||", left, right):
                known = self._expression(left, known)
                self._expression(right, known)
                return known
            case m.Conditional(condition, then, otherwise):
                known = self._expression(condition, known)
                return self._expression(then, known) & self._expression(otherwise, known)
            case m.Call(None | m.Self(), name, arguments) if name in self.methods:
                known = self._all(arguments, known)
                first, always = self._method(name)
                self.found |= first - known
                return known | always
            case _:
                return self._all(tuple(_parts(expression)), known)

    def _written(self, target: m.Expression, known: Set) -> Set:
        match target:
            case m.Name(name) | m.Member(m.Self(), name):
                return known | {name}
            case m.Index(m.Name(name), m.IntLiteral(index)):
                known |= {f"{name}[{index}]"}
                last = _length(self.variables, name) - 1
                # from the end, as most are written in their order: so the first that lacks ends it
                every = last >= 0 and all(f"{name}[{i}]" in known for i in range(last, -1, -1))
                return known | {name} if every else known
            case m.Index(m.Name(), index):
                return self._expression(index, known)
            case _:
                return self._expression(target, known)

    def _method(self, name: str) -> tuple[Set, Set]:
        """What a method reads before it writes it, and what it writes whichever way it takes."""
        if name not in self.known:
            body = self.methods[name].body or m.Block(())
            mentioned = {n.name for n in m.walk(body) if isinstance(n, m.Name)}
            self.known[name] = frozenset(mentioned & self.variables.keys()), frozenset()
            around, self.found = self.found, set()
            always = self.body(body, frozenset())
            self.known[name] = frozenset(self.found), always
            self.found = around
        return self.known[name]


def _both(ways: Ways, others: Ways) -> Ways:
    """What has a value where two ways meet."""
    if ways is None or others is None:
        return others if ways is None else ways
    return ways & others


def _values(initial: m.Initializer | None) -> Iterator[m.Expression]:
    if isinstance(initial, m.ArrayInitializer):
        for value in initial.values:
            yield from _values(value)
    elif initial is not None:
        yield initial


def _parts(expression: m.Expression) -> Iterator[m.Expression]:
    """The expressions that an expression is made of."""
    match expression:
        case m.Paren(inner) | m.Cast(_, inner) | m.Unary(_, inner) | m.Postfix(_, inner):
            yield inner
        case m.Member(inner) | m.InstanceOf(inner):
            yield inner
        case m.Binary(_, left, right) | m.Index(left, right) | m.Assign(_, left, right):
            yield from (left, right)
        case m.Choice(options):
            yield from options
        case m.Call(target, _, arguments, after, deadline):
            yield from (e for e in (target, *arguments, after, deadline) if e is not None)


# --- arrays -------------------------------------------------------------------------------------


def _length(variables: Mapping[str, m.Type], name: str) -> int:
    """The elements of an array of one dimension; 0 for others."""
    type_ = variables.get(name)
    return type_.dimensions[0] if type_ is not None and len(type_.dimensions) == 1 else 0


def _rounds(loop: m.For) -> int:
    """Up to where a loop counts from 0, one by one; -1 where it does something else."""
    match loop.initial, loop.condition, loop.updates:
        case (
            m.Declaration(_, (m.Declarator(name, m.IntLiteral(0)),)),
            m.Binary("<", m.Name(tested), bound),
            (m.Postfix("++", m.Name(counted)) | m.Unary("++", m.Name(counted)),),
        ) if name == tested == counted:
            limit = constant(bound)
            return limit if isinstance(limit, int) else -1
        case _:
            return -1


def _filled(loop: m.For) -> Iterator[str]:
    """The arrays of which each round of a loop writes the element of its number."""
    initial = loop.initial
    counter = initial.declarators[0].name if isinstance(initial, m.Declaration) else ""
    body = loop.body.statements if isinstance(loop.body, m.Block) else (loop.body,)
    for statement in body:
        match statement:
            case m.ExpressionStatement(m.Assign("=", m.Index(m.Name(name), m.Name(at)), _)):
                if at == counter:
                    yield name
            case m.ExpressionStatement(m.Assign()):
                continue
            case _:
                return
