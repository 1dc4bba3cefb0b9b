"""Dead store elimination for texts: most are only logged, of which a model has nothing.

State variables that nothing reads go, with what assigns them, and parameters of constructors.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import replace

from rebsync import model as m
from rebsync.reverse.models.building import is_calm
from rebsync.reverse.models.rewriting import STATEMENTS, rewritten
from rebsync.reverse.models.texts import TEXT

_GONE = m.Block(())  # in the place of a statement, until it is taken out of its block
_Nodes = tuple[list[m.ReactiveClass], list[m.Rebec]]


def without_dead_texts(classes: Sequence[m.ReactiveClass], rebecs: Sequence[m.Rebec]) -> _Nodes:
    """The classes without texts that nothing reads, and their rebecs without the arguments."""
    kept = [_live(owner) for owner in classes]
    places = {owner.name: _live_parameters(owner) for owner in kept}
    given = []
    for rebec in rebecs:
        live = places.get(rebec.type.name)
        arguments = rebec.arguments
        if live is not None:
            arguments = tuple(a for a, is_live in zip(arguments, live, strict=True) if is_live)
        given.append(replace(rebec, arguments=arguments))
    return [_without_parameters(owner, places[owner.name]) for owner in kept], given


def _live(owner: m.ReactiveClass) -> m.ReactiveClass:
    while dead := _dead(owner):
        owner = replace(owner, members=tuple(_without(x, dead) for x in owner.members))
        sections = (x for x in owner.members if not isinstance(x, m.StateVars) or x.declarations)
        owner = replace(owner, members=tuple(sections))
    return owner


def _dead(owner: m.ReactiveClass) -> set[str]:
    """The state variables that hold texts, and that nothing reads."""
    sections = (x for x in owner.members if isinstance(x, m.StateVars))
    declared = (d for x in sections for d in x.declarations if d.type == TEXT)
    names = {each.name for d in declared for each in d.declarators if each.initial is None}
    reads: Counter[str] = Counter()
    for node in m.walk(owner) if names else ():
        match node:
            case m.Name(name) | m.Member(m.Self(), name):
                reads[name] += 1
            case m.ExpressionStatement() if (stored := _stored(node)) is not None:
                reads[stored] -= 1
            case _:
                pass
    return {name for name in names if not reads[name]}


def _stored(statement: object) -> str | None:
    """The variable that a statement assigns, if that is all that it does."""
    match statement:
        case m.ExpressionStatement(m.Assign("=", target, value), ()) if is_calm(value):
            match target:
                case m.Name(name) | m.Member(m.Self(), name):
                    return name
    return None


def _without(member: m.ClassMember, dead: Collection[str]) -> m.ClassMember:
    if isinstance(member, m.StateVars):
        kept = (d for d in member.declarations if d.declarators[0].name not in dead)
        return replace(member, declarations=tuple(kept))

    def change(node: object) -> object:
        match node:
            case m.Block(statements) | m.Case(_, statements):
                left = tuple(s for s in statements if s is not _GONE)
                return replace(node, statements=left) if len(left) < len(statements) else node
            case _ if _stored(node) in dead:
                return _GONE
            case _:
                return node

    return rewritten(member, change, STATEMENTS)


def _live_parameters(owner: m.ReactiveClass) -> list[bool]:
    """Of each parameter of the constructor whether it is another value than a text, or read."""
    for member in owner.members:
        if isinstance(member, m.Constructor):
            names = {n.name for n in m.walk(member) if isinstance(n, m.Name)}
            return [p.type != TEXT or p.name in names for p in member.parameters]
    return []


def _without_parameters(owner: m.ReactiveClass, live: Sequence[bool]) -> m.ReactiveClass:
    def change(member: m.ClassMember) -> m.ClassMember:
        if not isinstance(member, m.Constructor):
            return member
        kept = (p for p, is_live in zip(member.parameters, live, strict=True) if is_live)
        return replace(member, parameters=tuple(kept))

    return replace(owner, members=tuple(map(change, owner.members)))
