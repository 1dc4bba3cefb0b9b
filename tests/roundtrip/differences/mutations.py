"""Small changes of drawn models, each with the element that it is in; and what equality is."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any, TypeVar

from hypothesis import assume
from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from rebsync import model as m
from rebsync.roundtrip.diff.normal_form import normal, rewrite

_Node = TypeVar("_Node")
_BODIES = (m.Constructor, m.MessageServer, m.Method)
_KINDS = {m.Constructor: "constructor", m.MessageServer: "msgsrv", m.Method: "method"}


@dataclass(frozen=True)
class Mutated:
    """A changed model and, in words, the element that has changed."""

    model: m.Model
    element: str


# --- pieces of a model --------------------------------------------------------------------------


def classes_of(model: m.Model) -> list[m.ReactiveClass]:
    return [c for c in model.classes if isinstance(c, m.ReactiveClass)]


def with_class(model: m.Model, old: m.ReactiveClass, new: m.ReactiveClass) -> m.Model:
    return replace(model, classes=tuple(new if c is old else c for c in model.classes))


def with_member(
    model: m.Model, owner: m.ReactiveClass, old: m.ClassMember, new: m.ClassMember
) -> m.Model:
    members = tuple(new if x is old else x for x in owner.members)
    return with_class(model, owner, replace(owner, members=members))


def bodies(model: m.Model) -> list[tuple[m.ReactiveClass, Any]]:
    """The members with bodies, with their classes."""
    return [
        (c, x) for c in classes_of(model) for x in c.members if isinstance(x, _BODIES) and x.body
    ]


def named(owner: m.ReactiveClass, member: Any) -> str:  # noqa: ANN401
    """The element that a member is; overloads share a name."""
    path = owner.name if isinstance(member, m.Constructor) else f"{owner.name}.{member.name}"
    return f"{_KINDS[type(member)]} {path}"


def chosen(draw: DrawFn, options: list[_Node]) -> _Node:
    assume(options)
    return draw(st.sampled_from(options))


def nth(tree: _Node, wanted: Callable[[object], bool], number: int, rule: Any) -> _Node:  # noqa: ANN401
    """A tree with `rule` applied to one of the nodes that are wanted."""
    seen = iter(range(1_000_000))

    def each(node: object) -> object:
        return rule(node) if wanted(node) and next(seen) == number else node

    return rewrite(tree, each)


def count(tree: object, wanted: Callable[[object], bool]) -> int:
    found = 0

    def each(node: object) -> object:
        nonlocal found
        found += wanted(node)
        return node

    rewrite(tree, each)
    return found


def one_node(
    draw: DrawFn,
    model: m.Model,
    wanted: Callable[[object], bool],
    rule: Callable[[Any], object],
) -> Mutated:
    """One node of some body changed."""
    fitting = [(c, x) for c, x in bodies(model) if count(x.body, wanted)]
    owner, member = chosen(draw, fitting)
    number = draw(st.integers(0, count(member.body, wanted) - 1))
    body = nth(member.body, wanted, number, rule)
    changed = with_member(model, owner, member, replace(member, body=body))
    return Mutated(changed, named(owner, member))


# --- what is different --------------------------------------------------------------------------


def literal(draw: DrawFn, model: m.Model) -> Mutated:
    """Another number, but for labels of cases: they change what a whole case is."""
    assume(not any(isinstance(node, m.Switch) for node in m.walk(model)))
    return one_node(
        draw,
        model,
        lambda n: isinstance(n, m.IntLiteral) and n.value > 1,
        lambda n: m.IntLiteral(n.value + 100_001),
    )


def operator(draw: DrawFn, model: m.Model) -> Mutated:
    """Another comparison."""
    return one_node(
        draw,
        model,
        lambda n: isinstance(n, m.Binary) and n.operator in ("<", ">="),
        lambda n: replace(n, operator="!="),
    )


def statement_removed(draw: DrawFn, model: m.Model) -> Mutated:
    """A statement less at the top of a body, one that declares nothing."""

    def removable(body: m.Block) -> list[int]:
        return [
            i
            for i, s in enumerate(body.statements)
            if not isinstance(s, m.Local | m.Empty | m.Block)
        ]

    fitting = [(c, x) for c, x in bodies(model) if removable(x.body)]
    owner, member = chosen(draw, fitting)
    at = chosen(draw, removable(member.body))
    statements = member.body.statements[:at] + member.body.statements[at + 1 :]
    new = replace(member, body=replace(member.body, statements=statements))
    return Mutated(with_member(model, owner, member, new), named(owner, member))


def statement_inserted(draw: DrawFn, model: m.Model) -> Mutated:
    """An assertion more."""
    owner, member = chosen(draw, bodies(model))
    at = draw(st.integers(0, len(member.body.statements)))
    call = m.Call(None, "assertion", (m.BoolLiteral(False), m.StringLiteral('"new"')))
    more = (m.ExpressionStatement(call),)
    statements = member.body.statements[:at] + more + member.body.statements[at:]
    new = replace(member, body=replace(member.body, statements=statements))
    return Mutated(with_member(model, owner, member, new), named(owner, member))


def queue_length(draw: DrawFn, model: m.Model) -> Mutated:
    owner = chosen(draw, classes_of(model))
    new = replace(owner, queue_length=owner.queue_length + 1)
    return Mutated(with_class(model, owner, new), f"reactiveclass {owner.name}")


def argument(draw: DrawFn, model: m.Model) -> Mutated:
    """Another argument of a rebec."""
    assert model.main is not None
    fitting = [
        r for r in model.main.rebecs if any(isinstance(a, m.BoolLiteral) for a in r.arguments)
    ]
    rebec = chosen(draw, fitting)
    at = next(i for i, a in enumerate(rebec.arguments) if isinstance(a, m.BoolLiteral))
    old = rebec.arguments[at]
    assert isinstance(old, m.BoolLiteral)
    given = (*rebec.arguments[:at], m.BoolLiteral(not old.value), *rebec.arguments[at + 1 :])
    rebecs = tuple(replace(r, arguments=given) if r is rebec else r for r in model.main.rebecs)
    return Mutated(replace(model, main=m.Main(rebecs)), f"rebec {rebec.name}")


def server_renamed(draw: DrawFn, model: m.Model) -> Mutated:
    """A server with another name, in all that send to it."""
    names = [x.name for _, x in bodies(model) if isinstance(x, m.MessageServer)]
    declared = [x.name for c in model.classes for x in _members(c)]
    fitting = [
        (c, x) for c, x in bodies(model) if names.count(x.name) == 1 == declared.count(x.name)
    ]
    fitting = [(c, x) for c, x in fitting if isinstance(x, m.MessageServer)]
    owner, member = chosen(draw, fitting)
    new = f"{member.name}Now"

    def rule(node: object) -> object:
        if isinstance(node, m.Call | m.MessageServer) and node.name == member.name:
            return replace(node, name=new)
        return node

    return Mutated(rewrite(model, rule), named(owner, member))


def _members(node: m.ReactiveClass | m.Interface) -> Iterator[Any]:
    members = node.members if isinstance(node, m.ReactiveClass) else node.servers
    yield from (x for x in members if isinstance(x, _BODIES))


def variable_renamed(draw: DrawFn, model: m.Model) -> Mutated:
    """A state variable with another name, wherever it is used."""
    fitting = [
        (c, d.name)
        for c in classes_of(model)
        for section in c.members
        if isinstance(section, m.StateVars)
        for declaration in section.declarations
        for d in declaration.declarators
    ]
    owner, name = chosen(draw, fitting)

    def rule(node: object) -> object:
        if isinstance(node, m.Name | m.Member | m.Declarator) and node.name == name:
            return replace(node, name=f"{name}_now")
        return node

    return Mutated(rewrite(model, rule), f"statevar {owner.name}.{name}")


# --- what is equal ------------------------------------------------------------------------------


def local_renamed(draw: DrawFn, model: m.Model) -> Mutated:
    """A local variable with another name."""

    def locals_in(body: m.Block) -> list[str]:
        found = [n.name for n in m.walk(body) if isinstance(n, m.Declarator)]
        return [name for name in found if found.count(name) == 1]

    owner, member = chosen(draw, [(c, x) for c, x in bodies(model) if locals_in(x.body)])
    name = chosen(draw, locals_in(member.body))
    taken = {n.name for n in m.walk(member.body) if isinstance(n, m.Name | m.Declarator)}
    fresh = next(n for i in itertools.count(1) if (n := f"other{i}") not in taken)

    def rule(node: object) -> object:
        if isinstance(node, m.Name | m.Declarator) and node.name == name:
            return replace(node, name=fresh)
        return node

    new = replace(member, body=rewrite(member.body, rule))
    return Mutated(with_member(model, owner, member, new), named(owner, member))


def parenthesised(draw: DrawFn, model: m.Model) -> Mutated:
    def wanted(node: object) -> bool:
        return isinstance(node, m.Binary | m.Unary | m.Conditional)

    return one_node(draw, model, wanted, m.Paren)


def braced(draw: DrawFn, model: m.Model) -> Mutated:
    def wanted(node: object) -> bool:
        return isinstance(node, m.If) and not isinstance(node.then, m.Block)

    return one_node(draw, model, wanted, lambda n: replace(n, then=m.Block((n.then,))))


def classes_swapped(draw: DrawFn, model: m.Model) -> Mutated:
    assume(len(model.classes) > 1)
    order = draw(st.permutations(model.classes).filter(lambda o: tuple(o) != model.classes))
    return Mutated(replace(model, classes=tuple(order)), "")


def members_swapped(draw: DrawFn, model: m.Model) -> Mutated:
    """The members of a class in another order, but for known rebecs, which main binds in order."""
    owner = chosen(draw, [c for c in classes_of(model) if len(c.members) > 1])
    order = tuple(draw(st.permutations(owner.members)))
    new = replace(owner, members=order)
    return Mutated(with_class(model, owner, new), owner.name)


def sections_split(draw: DrawFn, model: m.Model) -> Mutated:
    """A section for each variable, in the opposite order."""
    fitting = [
        (c, x)
        for c in classes_of(model)
        for x in c.members
        if isinstance(x, m.StateVars) and len(x.declarations) > 1
    ]
    owner, section = chosen(draw, fitting)
    parts = tuple(m.StateVars((d,)) for d in reversed(section.declarations))
    at = next(i for i, x in enumerate(owner.members) if x is section)
    members = (*owner.members[:at], *parts, *owner.members[at + 1 :])
    return Mutated(with_class(model, owner, replace(owner, members=members)), owner.name)


def rebecs_swapped(draw: DrawFn, model: m.Model) -> Mutated:
    assert model.main is not None
    assume(len(model.main.rebecs) > 1)
    return Mutated(replace(model, main=m.Main(tuple(reversed(model.main.rebecs)))), "")


DIFFERENT = (
    literal,
    operator,
    statement_removed,
    statement_inserted,
    queue_length,
    argument,
    server_renamed,
    variable_renamed,
)
EQUAL = (
    local_renamed,
    parenthesised,
    braced,
    classes_swapped,
    members_swapped,
    sections_split,
    rebecs_swapped,
)


# --- equality, told in another way --------------------------------------------------------------


def equal_form(model: m.Model) -> m.Model:
    """A form that equal models have in common, made without comparing: for drawn models only."""
    plain = rewrite(normal(model), _fold)
    classes = sorted((_sorted_class(c) for c in plain.classes), key=lambda c: c.name)
    heads = tuple(sorted(plain.heads, key=repr))
    rebecs = plain.main.rebecs if plain.main is not None else ()
    return m.Model(heads, tuple(classes), m.Main(tuple(sorted(rebecs, key=repr))))


def _fold(node: object) -> object:
    match node:
        case m.Paren(inner):
            return inner
        case m.FloatLiteral(text):
            return m.FloatLiteral(repr(float(text)))
        case m.Call(m.Self()):
            return replace(node, target=None)
        case m.Member(m.Self(), name):
            return m.Name(name)
        case m.If(otherwise=m.Block(())):
            return replace(node, otherwise=None)
        case m.Block(statements) | m.Case(statements=statements):
            return replace(node, statements=tuple(_spliced(statements)))
        case _:
            return node


def _spliced(statements: tuple[m.Statement, ...]) -> Iterator[m.Statement]:
    for statement in statements:
        match statement:
            case m.Empty(()):
                pass
            case m.Block(inner, ()) if not any(isinstance(s, m.Local) for s in inner):
                yield from inner
            case _:
                yield statement


def _sorted_class(node: m.ReactiveClass | m.Interface) -> m.ReactiveClass | m.Interface:
    if isinstance(node, m.Interface):
        return replace(node, servers=tuple(sorted(node.servers, key=repr)))
    members: list[m.ClassMember] = []
    for member in node.members:
        if isinstance(member, m.StateVars):
            members.append(m.StateVars(tuple(sorted(member.declarations, key=repr))))
        elif isinstance(member, m.KnownRebecs):
            members.append(member)
        else:
            members.append(_numbered(member))
    notes = tuple(sorted(node.annotations, key=repr))
    return replace(node, members=tuple(sorted(members, key=repr)), annotations=notes)


def _numbered(member: _Node) -> _Node:
    """A body whose locals are called after their order; drawn ones hide nothing."""
    names: dict[str, str] = {}
    for node in m.walk(member):  # type: ignore[arg-type]
        if isinstance(node, m.Declarator):
            names.setdefault(node.name, f"local{len(names)}")

    def rule(node: object) -> object:
        if isinstance(node, m.Name | m.Declarator) and node.name in names:
            return replace(node, name=names[node.name])
        return node

    return rewrite(member, rule)
