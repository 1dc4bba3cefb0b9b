"""Values of the graph: what several of them have in common, and names under node handles."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeGuard

from rebsync.reverse.graph import FromParameter, OneOf, Resolved, Under, Unresolved
from rebsync.reverse.values.cpp_values_plain import (
    OWN_NAME,
    Choice,
    Found,
    Function,
    Handle,
    Length,
    Made,
    Nothing,
    Quality,
    Value,
    same,
    ways,
)


def resolved(value: Value, unknown: Unresolved) -> Resolved | None:
    """A value as one of the graph: None for nothing, `unknown` for what is no such value."""
    if is_plain(value):
        return value
    found: list[Resolved] = []
    for way in ways(value):
        match way:
            case Nothing():
                continue
            case Length(seconds):
                found.append(seconds)
            case Quality(depth):
                found.append(depth)
            case str() if OWN_NAME in way:
                found.append(_own(way, unknown))
            case Unresolved(why, place, partial) if partial is not None and OWN_NAME in partial:
                found.append(Unresolved(why, place, spoken(partial)))
            case Found(name):
                found.append(FromParameter(name, search=True))
            case Handle() | Made() | Function() | Choice():
                found.append(unknown)
            case _:
                found.append(way)
    return one_of(found)


def is_plain(value: Value) -> TypeGuard[bool | int | float | str]:
    """Whether a value is as it is one of the graph, on which nothing else depends."""
    if isinstance(value, str):
        return OWN_NAME not in value
    return isinstance(value, (bool, int, float))


def _own(text: str, unknown: Unresolved) -> Resolved:
    """A text with the name of the node: known if that is all of it, or a name below it."""
    said = spoken(text)
    if "*" not in said or "*" in text:
        return said
    return Unresolved("made of the name of the node", unknown.place, said)


def spoken(text: str) -> str:
    """A text with `~` for the name of the node, or `*` where that does not go."""
    if text == OWN_NAME or text.startswith(f"{OWN_NAME}/"):
        text = "~" + text[1:]
    return text.replace(OWN_NAME, "*")


def one_of(values: Iterable[Resolved]) -> Resolved | None:
    """One of these; unknown as soon as one of them is, with what they have in common."""
    found: list[Resolved] = []
    given = list(values)
    if len(given) == 1 and not isinstance(given[0], OneOf):
        return given[0]
    if not given:
        return None
    for value in given:
        for way in value.values if isinstance(value, OneOf) else (value,):
            if not any(same(way, f) for f in found):
                found.append(way)
    found = _joined(found)
    unknown = [v for v in found if isinstance(v, Unresolved)]
    if unknown and len(found) > 1:
        texts = [v.partial or "*" if isinstance(v, Unresolved) else v for v in found]
        if all(isinstance(t, str) for t in texts) and any(u.partial for u in unknown):
            partial = common([str(t) for t in texts])
            return Unresolved(unknown[0].why, unknown[0].place, partial)
        return Unresolved(unknown[0].why, unknown[0].place)
    if any(isinstance(v, Under) for v in found) and len(found) > 1:
        return _under(found)
    return (found[0] if len(found) == 1 else OneOf(tuple(found))) if found else None


def _joined(found: list[Resolved]) -> list[Resolved]:
    """Values of one parameter that differ in the namespaces of their names only, as one."""
    joined: list[Resolved] = []
    for value in found:
        index = next((i for i, v in enumerate(joined) if _alike(v, value)), None)
        before = joined[index] if index is not None else None
        if index is None or not (
            isinstance(before, FromParameter) and isinstance(value, FromParameter)
        ):
            joined.append(value)
            continue
        within = dict.fromkeys([*(before.within or ("",)), *(value.within or ("",))])
        joined[index] = FromParameter(
            value.name, value.default, value.expression, value.search, tuple(within)
        )
    return joined


def _alike(one: Resolved, other: Resolved) -> bool:
    match one, other:
        case FromParameter(), FromParameter():
            return (one.name, one.default, one.expression, one.search) == (
                other.name,
                other.default,
                other.expression,
                other.search,
            )
        case _:
            return False


def _under(found: list[Resolved]) -> Resolved:
    """Names under handles of which one is not known: the others say what callers inside give."""
    names = {v.name for v in found if isinstance(v, Under)}
    if len(names) != 1:
        return OneOf(tuple(found))
    known = [v for v in found if not isinstance(v, Under)]
    return known[0] if len(known) == 1 else OneOf(tuple(known))


def common(texts: list[str]) -> str:
    """What texts have in common at their starts and ends, `*` for the rest."""
    start = _shared(texts)
    rests = [t[len(start) :] for t in texts]
    end = _shared([t[::-1] for t in rests])[::-1]
    if all(not t[len(start) : len(t) - len(end)] for t in texts):
        return texts[0]
    return f"{start.rstrip('*')}*{end.lstrip('*')}"


def _shared(texts: list[str]) -> str:
    shortest = min(texts, key=len)
    for index, character in enumerate(shortest):
        if any(t[index] != character for t in texts):
            return shortest[:index]
    return shortest


def name_under(namespace: Resolved, name: Resolved) -> Resolved:
    """A name as a node handle of a namespace resolves it."""
    if isinstance(namespace, OneOf):
        if isinstance(name, FromParameter):
            return _within(name, namespace.values)
        return one_of(name_under(n, name) for n in namespace.values) or name
    match name:
        case OneOf(values):
            return one_of(name_under(namespace, v) for v in values) or name
        case str() if name.startswith("/"):
            return tidy(name)
        case str() if name.startswith("~"):
            return tidy(name)
        case FromParameter():
            return _within(name, (namespace,))
        case str():
            return _join(namespace, name)
        case Unresolved(why, place, partial):
            start = partial or "*"
            joined = start if start[0] in "/~" else _join(namespace, start)
            if isinstance(joined, str) and joined != "*":
                partial = tidy(joined)
            return Unresolved(why, place, partial)
        case _:
            return name


def _join(namespace: Resolved, name: str) -> Resolved:
    match namespace:
        case "":
            return tidy(name)
        case "~" | "/":
            return tidy(namespace + name)
        case str():
            return tidy(f"{namespace}/{name}")
        case Under(above, handles):
            return Under(tidy(f"{above}/{name}") if above else name, handles)
        case Unresolved(why, place, partial):
            return Unresolved(why, place, tidy(f"{partial or '*'}/{name}"))
        case FromParameter():
            return FromParameter(
                namespace.name,
                _join(namespace.default, name) if namespace.default is not None else None,
                f'value + "/{name}"',
                namespace.search,
                namespace.within,
            )
        case _:
            return name


def _within(name: FromParameter, namespaces: Iterable[Resolved]) -> Resolved:
    given = tuple(namespaces)
    default = None
    if name.default is not None:
        default = one_of(name_under(n, name.default) for n in given)
    texts = tuple(n if isinstance(n, str) else "*" for n in given)
    within = () if texts == ("",) else texts
    return FromParameter(name.name, default, name.expression, name.search, within)


def tidy(name: str) -> str:
    """A name without what it has no need for: `~/x` is `~x`, `a//b` is `a/b`."""
    while "//" in name:
        name = name.replace("//", "/")
    name = name.replace("**", "*")
    if name.startswith("~/"):
        name = "~" + name[2:]
    return name.removesuffix("/") if len(name) > 1 else name
