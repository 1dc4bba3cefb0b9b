"""Variables of a model that only get constants, and which: constant propagation without order.

As in a flow-insensitive analysis with sets of constants (Aho, Lam, Sethi, Ullman 2006, chapter 9);
variables of one name in one body are taken together.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from typing import TypeAlias

from rebsync import model as m
from rebsync.intervals import INTEGERS
from rebsync.literals import exact_literal_of
from rebsync.reverse.environment.scopes import Scope, Variable
from rebsync.static.constants import Value, constant

Constants: TypeAlias = Mapping[Variable, frozenset[Value] | None]  # None: it may get others

_MOST = 32  # constants of one variable


def constant_variables(model: m.Model, env: Mapping[str, Value]) -> Constants:
    """The constants that variables get; those of `env` have their values."""
    gets = [g for c in model.classes if isinstance(c, m.ReactiveClass) for g in _gets(c, model)]
    found: dict[Variable, frozenset[Value] | None] = {g[0]: frozenset() for g in gets}
    types = _types(model)
    changed = True
    while changed:
        changed = False
        for variable, expression, scope in gets:
            known = found[variable]
            if known is None:
                continue
            more = _values(expression, scope, found, env)
            fit = more is not None and all(_fits(value, types[variable]) for value in more)
            joined = known | more if more is not None and fit else None
            joined = joined if joined is not None and len(joined) <= _MOST else None
            changed |= joined != known
            found[variable] = joined
    return found


def _types(model: m.Model) -> Mapping[Variable, set[str]]:
    """The types of variables, of all that have one name in a body."""
    found: dict[Variable, set[str]] = defaultdict(set)
    for owner in (c for c in model.classes if isinstance(c, m.ReactiveClass)):
        for member in owner.members:
            scope = Scope.of(owner, member)
            for node in m.walk(member):
                match node:
                    case m.Declaration(type, declarators):
                        for each in declarators:
                            found[scope.variable(each.name)].add(type.name)
                    case m.Parameter(type, name):
                        found[scope.variable(name)].add(type.name)
                    case _:
                        pass
    return found


def _fits(value: Value, types: Iterable[str]) -> bool:
    """Whether a value stays the same number in variables of some types; floats may be rounded."""
    whole = isinstance(value, int) and not isinstance(value, bool)
    return all(
        whole and INTEGERS[type_].low <= value <= INTEGERS[type_].high
        for type_ in types
        if type_ in INTEGERS
    )


def _values(
    get: m.Expression | None, scope: Scope, variables: Constants, env: Mapping[str, Value]
) -> frozenset[Value] | None:
    return None if get is None else possible_constants(get, scope, variables, env)


def possible_constants(
    expression: m.Expression, scope: Scope, variables: Constants, env: Mapping[str, Value]
) -> frozenset[Value] | None:
    """The values of an expression in a body, if it is made of constants and variables of them.

    None: it may have others. Numbers that are computed with may be rounded: they are left out.
    """
    match expression:
        case m.IntLiteral() | m.FloatLiteral() | m.BoolLiteral() | m.Unary("-", m.IntLiteral()):
            value = constant(expression)
            return None if value is None else frozenset({value})
        case m.Unary("-", m.FloatLiteral()):
            value = constant(expression)
            return None if value is None else frozenset({value})
        case m.Name(name) if name in env and name not in scope.locals:
            return frozenset({env[name]})
        case m.Name(name):
            return variables.get(scope.variable(name))
        case m.Member(m.Self(), name):
            return variables.get((scope.owner, name))
        case m.Paren(inner):
            return possible_constants(inner, scope, variables, env)
        case m.Cast(type, operand):
            found = possible_constants(operand, scope, variables, env)
            return None if found is None else _cast(type, found)
        case m.Conditional(_, then, otherwise):
            return _joined((then, otherwise), scope, variables, env)
        case _:
            return None


def _cast(type_: m.Type, values: Iterable[Value]) -> frozenset[Value] | None:
    found = {constant(m.Cast(type_, exact_literal_of(v))) for v in values}
    known = frozenset(v for v in found if v is not None)
    return known if len(known) == len(found) else None


def _joined(
    expressions: Iterable[m.Expression],
    scope: Scope,
    variables: Constants,
    env: Mapping[str, Value],
) -> frozenset[Value] | None:
    found: frozenset[Value] = frozenset()
    for each in expressions:
        values = possible_constants(each, scope, variables, env)
        if values is None:
            return None
        found |= values
    return found


_Get: TypeAlias = tuple[Variable, m.Expression | None, Scope]
_OUTSIDE = Scope("")


def _gets(owner: m.ReactiveClass, model: m.Model) -> Iterator[_Get]:
    """What the variables of a class get, with the body in which that is evaluated."""
    for member in owner.members:
        match member:
            case m.StateVars(declarations):
                for declaration in declarations:
                    yield from _declared(Scope(owner.name), declaration)
            case m.Constructor():
                yield from _started(owner, member, model)
                yield from _assigned(Scope.of(owner, member), member.body)
            case m.MessageServer() | m.Method():
                scope = Scope.of(owner, member)
                yield from ((scope.variable(p.name), None, _OUTSIDE) for p in member.parameters)
                yield from _assigned(scope, member.body)
            case _:
                pass


def _declared(scope: Scope, declaration: m.Declaration) -> Iterator[_Get]:
    zero = m.BoolLiteral(False) if declaration.type.name == "boolean" else m.IntLiteral(0)
    for each in declaration.declarators:
        variable = scope.variable(each.name)
        if declaration.type.dimensions or isinstance(each.initial, m.ArrayInitializer):
            yield variable, None, _OUTSIDE
        else:
            yield variable, each.initial or zero, scope


def _started(owner: m.ReactiveClass, member: m.Constructor, model: m.Model) -> Iterator[_Get]:
    for rebec in model.main.rebecs if model.main is not None else ():
        if rebec.type.name == owner.name:
            for taken, argument in zip(member.parameters, rebec.arguments, strict=False):
                yield Scope.of(owner, member).variable(taken.name), argument, _OUTSIDE


def _assigned(scope: Scope, body: m.Block | None) -> Iterator[_Get]:
    for node in m.walk(body) if body is not None else ():
        match node:
            case m.Assign("=", m.Name(name), value):
                yield scope.variable(name), value, scope
            case m.Assign("=", m.Member(m.Self(), name), value):
                yield (scope.owner, name), value, scope
            case m.Assign(_, target) | m.Postfix(_, target) | m.Unary("++" | "--", target):
                while isinstance(target, m.Index):
                    target = target.target
                if isinstance(target, m.Name):
                    yield scope.variable(target.name), None, _OUTSIDE
                elif isinstance(target, m.Member):
                    yield (scope.owner, target.name), None, _OUTSIDE
            case m.Declaration():
                yield from _declared(scope, node)
