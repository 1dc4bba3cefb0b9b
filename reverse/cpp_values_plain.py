"""What an expression of C++ may be worth while nothing runs, and how such values are combined.

Besides the values of a graph there are some that lead to them: handles, spans of time, objects.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TypeAlias, cast

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.cpp_index import CppFunction
from rebsync.reverse.cpp_tree import Cpp
from rebsync.reverse.graph import FromParameter, OneOf, Place, Plain, Resolved, Under, Unresolved

# More ways than these to go are not followed one by one.
MOST = 64


@dataclass(frozen=True, eq=False)
class Use:
    """A place that calls a function, or hands it on with arguments (`handed`)."""

    cpp: Cpp
    node: Node
    arguments: tuple[Node, ...]
    around: CppFunction | None
    handed: bool = False


@dataclass(frozen=True, eq=False)
class Frame:
    """A function on the way to a value, and the call that led into it.

    Without `call` its parameters are open, and asked of all callers; if it is `outside`, no file
    calls it.
    """

    cpp: Cpp
    function: CppFunction | None = None
    call: Use | None = None
    caller: Frame | None = None
    outside: bool = False

    @property
    def root(self) -> Frame:
        """The frame at the start of the way."""
        return self if self.caller is None else self.caller.root

    @property
    def depth(self) -> int:
        """How many calls led here."""
        return 0 if self.caller is None else self.caller.depth + 1


class Open(Exception):
    """A parameter was asked for whose callers are still open."""

    def __init__(self, frame: Frame) -> None:
        super().__init__()
        self.frame = frame


@dataclass(frozen=True, slots=True)
class Nothing:
    """What a variable holds that was given no value."""


@dataclass(frozen=True, slots=True)
class Handle:
    """A node handle of a namespace."""

    namespace: Resolved


@dataclass(frozen=True, slots=True)
class Length:
    """A span of time in seconds; `each` says that it was given as a frequency."""

    seconds: Resolved
    each: bool = False


@dataclass(frozen=True, slots=True)
class Found:
    """The full name of a parameter that a search upwards found."""

    name: Resolved


@dataclass(frozen=True, eq=False)
class Made:
    """An object of a class, with the arguments it is made of."""

    type: str
    use: Use
    frame: Frame


@dataclass(frozen=True, eq=False)
class Function:
    """A function, lambda or functor as a value."""

    node: Node
    frame: Frame


@dataclass(frozen=True, slots=True)
class Choice:
    """One of several values."""

    values: tuple[Value, ...]


Value: TypeAlias = "Resolved | Nothing | Handle | Length | Found | Made | Function | Choice"


def ways(value: Value) -> Iterator[Value]:
    """The values that it may be."""
    match value:
        case Choice(values):
            for inner in values:
                yield from ways(inner)
        case OneOf(resolved):
            yield from resolved
        case _:
            yield value


def choice(values: Iterable[Value]) -> Value:
    """One of these values; of several that are equal, one. Nothing gives way to anything."""
    found: list[Value] = []
    for value in values:
        for way in ways(value):
            if not any(same(way, f) for f in found):
                found.append(way)
    some = [v for v in found if not isinstance(v, Nothing)]
    if len(some) > MOST:
        some = some[:MOST]
    match some:
        case []:
            return Nothing()
        case [only]:
            return only
        case _:
            return Choice(tuple(some))


def same(left: Value, right: Value) -> bool:
    """Whether two values are the same: `1` and `True` are not."""
    return type(left) is type(right) and left == right


def each(do: Callable[[Value], Value], value: Value) -> Value:
    """What is made of each value that it may be."""
    return choice(do(way) for way in ways(value))


def pairs(do: Callable[[Value, Value], Value], left: Value, right: Value) -> Value:
    """What is made of each pair of values that they may be."""
    return choice(do(a, b) for a in ways(left) for b in ways(right))


def resolved(value: Value, unknown: Unresolved) -> Resolved | None:
    """A value as one of the graph: None for nothing, `unknown` for what is no such value."""
    found: list[Resolved] = []
    for way in ways(value):
        match way:
            case Nothing():
                continue
            case Length(seconds):
                found.append(seconds)
            case Found(name):
                found.append(FromParameter(name, search=True))
            case Handle() | Made() | Function() | Choice():
                found.append(unknown)
            case _:
                found.append(way)
    return one_of(found)


def one_of(values: Iterable[Resolved]) -> Resolved | None:
    """One of these; unknown as soon as one of them is, with what they have in common."""
    found: list[Resolved] = []
    for value in values:
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


# --- names --------------------------------------------------------------------------------------


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
            known = isinstance(joined, str)
            return Unresolved(why, place, tidy(joined) if known and joined != "*" else partial)
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


# --- texts and numbers --------------------------------------------------------------------------


def added(left: Value, right: Value) -> Value:
    """The sum of two values: of texts, the one after the other."""
    match left, right:
        case str(), str():
            return left + right
        case ((int() | float()), (int() | float())):
            return left + right
        case (Unresolved(), str()) | (str(), Unresolved()) | (Unresolved(), Unresolved()):
            unknown = cast(Unresolved, left if isinstance(left, Unresolved) else right)
            partial = "".join(
                (v.partial or "*") if isinstance(v, Unresolved) else str(v) for v in (left, right)
            )
            return Unresolved(unknown.why, unknown.place, partial.replace("**", "*"))
        case FromParameter(), str():
            return _used(left, f'value + "{right}"', lambda v: added(v, right))
        case str(), FromParameter():
            return _used(right, f'"{left}" + value', lambda v: added(left, v))
        case FromParameter(), (int() | float()):
            return _used(left, f"value+{right}", lambda v: added(v, right))
        case ((int() | float()), FromParameter()):
            return _used(right, f"{left}+value", lambda v: added(left, v))
        case _:
            return Nothing()


def _used(value: FromParameter, expression: str, do: Callable[[Value], Value]) -> FromParameter:
    """What is made of a parameter's value, and of what stands in for it."""
    if value.expression is not None:
        inner = value.expression if value.expression.isalnum() else f"({value.expression})"
        expression = expression.replace("value", inner)
    default = each(do, value.default) if value.default is not None else None
    known = default if isinstance(default, (bool, int, float, str)) else None
    return FromParameter(value.name, known, expression, value.search, value.within)


def used(value: FromParameter, expression: str, do: Callable[[Value], Value]) -> FromParameter:
    """A parameter's value used in an expression, with `value` for it."""
    return _used(value, expression, do)


def computed(operator: str, left: Plain, right: Plain) -> Plain | None:
    """The result of an operation on plain values, as C++ computes it; None where it has none."""
    match left, right:
        case str(), str() if operator in ("==", "!=", "+"):
            return left + right if operator == "+" else (left == right) == (operator == "==")
        case ((bool() | int() | float()), (bool() | int() | float())):
            return _number(operator, left, right)
        case _:
            return None


def _number(operator: str, a: float, b: float) -> Plain | None:
    whole = isinstance(a, int) and isinstance(b, int)
    match operator:
        case "+":
            return a + b
        case "-":
            return a - b
        case "*":
            return a * b
        case "/" if b:
            return _quotient(int(a), int(b)) if whole else a / b
        case "%" if b and whole:
            return int(a) - int(b) * _quotient(int(a), int(b))
        case "<":
            return a < b
        case ">":
            return a > b
        case "<=":
            return a <= b
        case ">=":
            return a >= b
        case "==":
            return a == b
        case "!=":
            return a != b
        case "&&":
            return bool(a) and bool(b)
        case "||":
            return bool(a) or bool(b)
        case "|" if whole:
            return int(a) | int(b)
        case "<<" if whole and 0 <= b < 64:
            return int(a) << int(b)
        case _:
            return None


def _quotient(a: int, b: int) -> int:
    return abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)


_WHOLE = frozenset(
    {
        *("int", "unsigned", "long", "short", "char", "size_t", "uint8_t", "int8_t", "uint16_t"),
        *("int16_t", "uint32_t", "int32_t", "uint64_t", "int64_t", "unsignedint", "longlong"),
        *("unsignedlong", "unsignedchar"),
    }
)


def converted(value: Value, type_: str) -> Value:
    """A value in a variable of a type: whole numbers as such, in floating point as such."""
    match value:
        case bool() if type_ in _WHOLE:
            return int(value)
        case int() | float() if type_ == "bool":
            return bool(value)
        case int() if type_ in ("double", "float") and not isinstance(value, bool):
            return float(value)
        case float() if type_ in _WHOLE:
            return int(value) if abs(value) < 1e18 else value
        case str() if type_ == "bool":
            return True  # the address of the text
        case FromParameter() if value.default is not None:
            default = converted(value.default, type_)
            plain = default if isinstance(default, (bool, int, float, str)) else value.default
            return FromParameter(value.name, plain, value.expression, value.search, value.within)
        case Choice() | OneOf():
            return each(lambda v: converted(v, type_), value)
        case _:
            return value


def at(cpp: Cpp, node: Node) -> Place:
    """The place of a node."""
    return Place(cpp.source, cpp.span(node))
