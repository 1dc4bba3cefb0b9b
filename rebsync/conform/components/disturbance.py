"""Which bodies of a class may disturb each other where they run in threads.

Two bodies that overlap do what they do one after the other if one of them reads what they share
once, and does not write it, and the other writes it once at most: the read is before that write or
after it (Lipton: "Reduction: a method of proving properties of parallel programs", 1975).
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from math import inf

from rebsync import model as m


def conflicts(class_: m.ReactiveClass) -> Iterator[tuple[str, str]]:
    """Pairs of servers, both ways, whose bodies may do together what they cannot do in turn."""
    variables = {
        d.name
        for member in class_.members
        if isinstance(member, m.StateVars)
        for each in member.declarations
        for d in each.declarators
    }
    servers = [s for s in class_.members if isinstance(s, m.MessageServer)]
    has_methods = any(isinstance(member, m.Method) for member in class_.members)
    for one, other in combinations(servers, 2):
        if has_methods or _disturb(one, other, variables):
            yield one.name, other.name
            yield other.name, one.name


def _disturb(one: m.MessageServer, other: m.MessageServer, variables: set[str]) -> bool:
    written, read = _written(one) & variables, _used(one) & variables
    shared = (written & _used(other)) | (_written(other) & read)
    if not shared:
        return False
    both = (one, other), (other, one)
    return not any(_is_one_read(a, shared) and _writes(b, shared) <= 1 for a, b in both)


def _is_one_read(server: m.MessageServer, shared: set[str]) -> bool:
    names = [n for n in m.walk(server) if isinstance(n, m.Name) and n.name in shared]
    loops = any(isinstance(n, m.While | m.For) for n in m.walk(server))
    return len(names) == 1 and not loops and not _written(server) & shared


def _writes(node: m.Node | None, shared: set[str]) -> float:
    """How often a body writes one of some variables at most."""
    match node:
        case None:
            return 0
        case m.If(condition=condition, then=then, otherwise=otherwise):
            ways = (_writes(then, shared), _writes(otherwise, shared))
            return _own(condition, shared) + max(ways)
        case m.Block(statements=statements):
            return sum(_writes(each, shared) for each in statements)
        case m.MessageServer(body=body):
            return _writes(body, shared)
        case m.While() | m.For():
            return inf if _own(node, shared) else 0
        case _:
            return _own(node, shared)


def _own(node: m.Node, shared: set[str]) -> int:
    return sum(bool(_targets(each) & shared) for each in m.walk(node))


def _used(node: m.Node) -> set[str]:
    return {n.name for n in m.walk(node) if isinstance(n, m.Name)}


def _written(node: m.Node) -> set[str]:
    return {name for each in m.walk(node) for name in _targets(each)}


def _targets(node: m.Node) -> set[str]:
    match node:
        case m.Assign(target=target) | m.Unary("++" | "--", target) | m.Postfix(_, target):
            return _used(target)
        case _:
            return set()
