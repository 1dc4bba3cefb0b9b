"""An environment that people wrote, as part of a model: who gets what it publishes, and it gets."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import chain
from typing import TypeGuard

from rebsync import model as m
from rebsync.names import unique
from rebsync.reverse.bodies.cpp_messages import zero_of
from rebsync.reverse.environment.closing import parameters_of
from rebsync.reverse.environment.fragments import PUBLISH, SUBSCRIBE, Fragment, TopicServer
from rebsync.reverse.environment.observation import Hearer
from rebsync.reverse.models.building import bare, declarations
from rebsync.reverse.models.rewriting import rewritten
from rebsync.reverse.nodes.node_joined import OBSERVER
from rebsync.reverse.nodes.open_ends import OpenEnd


def hearers(fragment: Fragment, model: m.Model) -> tuple[dict[str, str], dict[str, list[Hearer]]]:
    """The rebecs of an environment by their classes, and those that hear a topic.

    Their names are nothing else's in the model, so that every class can know them by these.
    """
    used = {n.name for n in m.walk(model) if isinstance(n, m.Name | m.Declarator | m.Rebec)}
    used |= {n.name for n in m.walk(model) if isinstance(n, m.MessageServer | m.Method)}
    used |= {n.name for c in fragment.classes for n in m.walk(c) if isinstance(n, m.Declarator)}
    rebecs = {c.name: unique(c.name[:1].lower() + c.name[1:], used) for c in fragment.classes}
    found: dict[str, list[Hearer]] = {}
    for each in fragment.heard:
        hearer = Hearer(rebecs[each.owner], each.server, each.paths)
        found.setdefault(each.topic, []).append(hearer)
    return rebecs, found


def constructor_publishes(owner: m.ReactiveClass, topics: Collection[str]) -> Iterator[str]:
    """The topics to which a class publishes while it is made, when nobody can be sent to."""
    for member in (x for x in owner.members if isinstance(x, m.Constructor)):
        for node in m.walk(member):
            match node:
                case m.Call(m.Name(name), topic) if name == OBSERVER and topic in topics:
                    yield topic


def with_fragment(
    model: m.Model, fragment: Fragment, rebecs: Mapping[str, str], ends: Sequence[OpenEnd]
) -> m.Model:
    """The model with the rebecs of an environment; its classes send to these already.

    `ends` are the servers of the topics to which the environment publishes.
    """
    assert model.main is not None
    owners = {r.name: r.type for r in model.main.rebecs}
    types = {rebec: m.Type(name) for name, rebec in rebecs.items()}
    classes = [_knowing(c, types) for c in model.classes]
    known = {c.name: _environment_known(c, types) for c in classes}
    nodes = [
        replace(r, bindings=(*r.bindings, *map(m.Name, known.get(r.type.name, ()))))
        for r in model.main.rebecs
    ]
    started = []
    for owner in fragment.classes:
        own = [s for s in fragment.published if s.owner == owner.name]
        at = {s.server: [e for e in ends if e.name == s.topic] for s in own}
        to = list(dict.fromkeys(e.rebec for found in at.values() for e in found))
        classes.append(_publishing(owner, model, own, at, [(n, owners[n]) for n in to]))
        declared = [
            d for x in owner.members if isinstance(x, m.KnownRebecs) for d in x.declarations
        ]
        before = [rebecs[d.type.name] for d in declared for _ in d.declarators]
        bindings = tuple(map(m.Name, (*before, *to)))
        started.append(m.Rebec(m.Type(owner.name), rebecs[owner.name], bindings, ()))
    main = replace(model.main, rebecs=(*nodes, *started))
    return replace(model, heads=(*model.heads, *fragment.heads), classes=tuple(classes), main=main)


def _knowing(
    owner: m.ReactiveClass | m.Interface, types: Mapping[str, m.Type]
) -> m.ReactiveClass | m.Interface:
    """A class of the package with the rebecs of the environment that it sends to."""
    if not isinstance(owner, m.ReactiveClass):
        return owner
    targets = (n.target for n in m.walk(owner) if isinstance(n, m.Call))
    sent = {t.name for t in targets if isinstance(t, m.Name)}
    return _with_known(owner, [(n, t) for n, t in types.items() if n in sent])


def _with_known(owner: m.ReactiveClass, known: Sequence[tuple[str, m.Type]]) -> m.ReactiveClass:
    """A class with more known rebecs, behind those that it has."""
    if not known:
        return owner
    sections = [n for n, x in enumerate(owner.members, 1) if isinstance(x, m.KnownRebecs)]
    at = max(sections, default=0)
    more = m.KnownRebecs(declarations(known))
    return replace(owner, members=(*owner.members[:at], more, *owner.members[at:]))


def _environment_known(
    owner: m.ReactiveClass | m.Interface, types: Mapping[str, m.Type]
) -> list[str]:
    members = owner.members if isinstance(owner, m.ReactiveClass) else ()
    sections = (x for x in members if isinstance(x, m.KnownRebecs))
    found = (x.name for section in sections for d in section.declarations for x in d.declarators)
    return [name for name in found if name in types]


def _publishing(
    owner: m.ReactiveClass,
    model: m.Model,
    own: Sequence[TopicServer],
    at: Mapping[str, Sequence[OpenEnd]],
    to: Sequence[tuple[str, m.Type]],
) -> m.ReactiveClass:
    """A class of the environment that sends to the nodes what it publishes."""
    paths = {s.server: s.paths for s in own}
    servers = {
        x.name: dict(zip(paths[x.name], (p.type for p in x.parameters), strict=True))
        for x in owner.members
        if isinstance(x, m.MessageServer) and x.name in paths
    }
    used = {n.name for n in m.walk(owner) if isinstance(n, m.Name | m.Declarator | m.Parameter)}
    used |= {name for name, _ in to}

    sends: list[m.Block] = []

    def sent(part: object) -> object:
        match part:
            case m.ExpressionStatement(m.Call(m.Self(), name) as call) if name in servers:
                sends.append(_sends(model, call, servers[name], at[name], used))
                return sends[-1]
            case m.Block(statements):
                inner = (s.statements if _is_one(s, sends) else (s,) for s in statements)
                return replace(part, statements=tuple(chain.from_iterable(inner)))
            case _:
                return part

    members = [
        _plain(rewritten(member, sent))
        for member in owner.members
        if not (isinstance(member, m.MessageServer) and member.name in servers)
    ]
    return _with_known(replace(owner, members=tuple(members)), to)


def _is_one(statement: m.Statement, blocks: Sequence[m.Block]) -> TypeGuard[m.Block]:
    """Whether a statement is the very one of some blocks."""
    return any(statement is block for block in blocks)


def _plain(member: m.ClassMember) -> m.ClassMember:
    if not isinstance(member, m.MessageServer):
        return member
    kept = (a for a in member.annotations if a.name not in (PUBLISH, SUBSCRIBE))
    return replace(member, annotations=tuple(kept))


def _sends(
    model: m.Model,
    call: m.Call,
    types: Mapping[str, m.Type],
    ends: Sequence[OpenEnd],
    used: set[str],
) -> m.Block:
    """A message to each receiver of a topic, with one value of each field; others are 0."""
    statements: list[m.Statement] = []
    values: dict[str, m.Expression] = {}
    for (path, type_), argument in zip(types.items(), call.arguments, strict=True):
        values[path] = argument
        if len(ends) > 1 and not isinstance(bare(argument), m.IntLiteral | m.BoolLiteral | m.Name):
            name = unique(f"{call.name}_{path.replace('.', '_')}", used)
            declarator = m.Declarator(name, argument)
            statements.append(m.Local(m.Declaration(type_, (declarator,))))
            values[path] = m.Name(name)
    for end in ends:
        given = tuple(
            values[path] if path in values else zero_of(parameter.type)
            for path, parameter in parameters_of(model, end).items()
        )
        assert None not in given
        known = tuple(g for g in given if g is not None)
        to = m.Call(m.Name(end.rebec), end.server, known, call.after, call.deadline)
        statements.append(m.ExpressionStatement(to))
    return m.Block(tuple(statements))
