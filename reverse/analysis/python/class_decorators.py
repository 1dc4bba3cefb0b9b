"""What decorates the classes of a program of Python, and what data classes get from that.

See `dataclasses` in the library reference: each field that is declared is a parameter, in order.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property

from rebsync.records import dataclass
from rebsync.reverse.analysis.call_graph import CallGraph
from rebsync.reverse.analysis.stores import CallResult, ClassValue, Value, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import ImplicitCall, Operator
from rebsync.reverse.ir.program import Class, Parameter, ParameterKind
from rebsync.reverse.ir.walk import walk_all

_DATACLASS = "dataclasses.dataclass"
_FIELD = "dataclasses.field"
_ORDERING = "functools.total_ordering"
_TUPLES = frozenset({"typing.NamedTuple"})
# Decorators that leave a class as it is, or of which it is known what they add.
_KNOWN = frozenset({_DATACLASS, _ORDERING, "enum.unique", "typing.final"})
_ORDERED = frozenset({Operator.LESS, Operator.LESS_EQUAL, Operator.GREATER, Operator.GREATER_EQUAL})
_KEYWORDS_BEHIND = "_"  # of the type `KW_ONLY`: what is declared behind it is given by name


@dataclass(frozen=True, slots=True)
class Decorator:
    """A decorator of a library, with its arguments; of an unknown one the name is empty."""

    name: str
    arguments: tuple[s.CallArgument, ...] = ()

    def has(self, option: str) -> bool:
        """Whether an option is given that is not false."""
        return any(a.name == option and not _is_false(a.value) for a in self.arguments)

    def lacks(self, option: str) -> bool:
        """Whether an option is given that is false."""
        return any(a.name == option and _is_false(a.value) for a in self.arguments)


class ClassDecorators:
    """The classes of one program."""

    def __init__(self, graph: CallGraph) -> None:
        self._graph = graph
        self._program = graph.program

    def of(self, name: str) -> Sequence[Decorator]:
        """The decorators of a class."""
        return self._decorators.get(name, ())

    def is_plain(self, class_: Class) -> bool:
        """Whether all is known of what a class itself has, decorators included."""
        found = self.of(class_.name)
        is_known = bool(found) and all(d.name in _KNOWN for d in found)
        return class_.complete or (class_.is_plain and is_known)

    def is_frozen(self, name: str) -> bool:
        """Whether nothing is stored in objects of a class: a data class, or a named tuple."""
        return any(d.name == _DATACLASS and d.has("frozen") for d in self.of(name))

    def answers(self, name: str, call: Operator | ImplicitCall) -> bool:
        """Whether a decorator of a class, or one that it extends, adds what answers a call."""
        decorators = (d for each in (name, *self._graph.bases(name)) for d in self.of(each))
        return call in _ORDERED and any(d.has("order") or d.name == _ORDERING for d in decorators)

    def has_hash(self, name: str) -> bool:
        """Whether objects of a class may be keys: one that says what is equal has a hash too."""
        class_ = self._program.classes[name]
        methods = dict(class_.methods)
        if "__hash__" in methods or not self.is_plain(class_):
            return True
        data = self._of_data(name)
        kept = (d.has("frozen") or d.has("unsafe_hash") or d.lacks("eq") for d in data)
        return "__eq__" not in methods and all(kept)

    def parameters(self, name: str) -> list[Parameter] | None:
        """What a call of a class takes that declares its fields; None for any other class."""
        line = [name, *self._graph.bases(name)]
        own = [c for c in line if c in self._program.classes]
        is_tuple = not _TUPLES.isdisjoint(line)
        others = set(line) - set(own) - _TUPLES - {"builtins.object", "abc.ABC", "typing.Generic"}
        if others or not all(self.is_plain(self._program.classes[c]) for c in own):
            return None
        if not is_tuple and not self._makes(name):
            return None
        found: dict[str, Parameter] = {}
        for each in reversed(own):
            if is_tuple or self._of_data(each):
                found |= {p.name: p for p in self._fields(each)}
        return list(found.values())

    def _makes(self, name: str) -> bool:
        """Whether the constructor of a class is that which a decorator writes."""
        has_own = "__init__" in dict(self._program.classes[name].methods)
        return not has_own and any(not d.lacks("init") for d in self._of_data(name))

    def _of_data(self, name: str) -> list[Decorator]:
        return [d for d in self.of(name) if d.name == _DATACLASS]

    def _fields(self, name: str) -> Iterator[Parameter]:
        """The fields that the body of a class declares, as parameters."""
        body = self._program.classes[name].body
        nodes = self._program.function(body).body if body is not None else ()
        by_name = any(d.has("kw_only") for d in self._of_data(name))
        made: dict[e.Expression, s.Call] = {}
        defaults: dict[str, e.Expression] = {}
        for node in nodes:
            match node:
                case s.Call(target, s.LibraryCallee(called)) if called == _FIELD and target:
                    made[target] = node
                case s.Assign(e.Attribute(e.ClassReference(), field), value):
                    defaults[field] = value
                case s.Declare(e.Attribute(e.ClassReference(), field)):
                    if field == _KEYWORDS_BEHIND:
                        by_name = True
                        continue
                    default = defaults.get(field)
                    options = made[default].arguments if default in made else None
                    yield from _parameter(field, default is not None, options, by_name)
                case _:
                    pass

    @cached_property
    def _decorators(self) -> dict[str, list[Decorator]]:
        found: dict[str, list[Decorator]] = {}
        for function, node in walk_all(self._program):
            match node:
                case s.Call(e.Temporary(), callee, (s.CallArgument(e.Temporary() as given),)):
                    for name in self._classes(given, function):
                        found.setdefault(name, []).append(self._decorator(callee, function))
                case _:
                    pass
        return found

    def _classes(self, value: e.Expression, function: str) -> Iterator[str]:
        """The classes that are defined under a name, or decorated."""
        key = key_of(value, function)
        for _, stored in self._graph.stores.of(key) if key is not None else ():
            match stored:
                case ClassValue(name):
                    yield name
                case CallResult(s.Call(_, _, (s.CallArgument(e.Temporary() as inner),))):
                    yield from self._classes(inner, function)
                case _:
                    pass

    def _decorator(self, callee: s.Callee, function: str) -> Decorator:
        match callee:
            case s.LibraryCallee(name):
                return Decorator(name)
            case s.ValueCallee(value):
                key = key_of(value, function)
                stored = self._graph.stores.of(key) if key is not None else []
                return _made(stored[0][1]) if len(stored) == 1 else Decorator("")
            case _:
                return Decorator("")


def _is_false(value: e.Expression) -> bool:
    return isinstance(value, e.Literal) and value.value is False


def _made(value: Value) -> Decorator:
    """A decorator that a call of a library gives, as `dataclass(frozen=True)`."""
    match value:
        case CallResult(s.Call(_, s.LibraryCallee(name), arguments)):
            return Decorator(name, arguments)
        case _:
            return Decorator("")


def _parameter(
    name: str, has_default: bool, options: tuple[s.CallArgument, ...] | None, by_name: bool
) -> Iterator[Parameter]:
    """The parameter for a field, with the options that `field` gets for it; none if it is not."""
    given = Decorator(_FIELD, options or ())
    if given.lacks("init"):
        return
    by_name |= given.has("kw_only")
    if options is not None:
        has_default = any(a.name in ("default", "default_factory") for a in options)
    kind = ParameterKind.BY_NAME if by_name else ParameterKind.PLAIN
    yield Parameter(name, kind=kind, has_default=has_default)
