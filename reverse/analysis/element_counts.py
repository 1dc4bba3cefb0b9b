"""How many elements containers have at least, by all that is ever stored and done in a program."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property

from rebsync.reverse.analysis.cpp_facts import parts_moved
from rebsync.reverse.analysis.foreign_emptying import ForeignEmptying
from rebsync.reverse.analysis.held_values import held_by, is_own
from rebsync.reverse.analysis.origins import FunctionOrigin, LibraryOrigin, Origin, Origins
from rebsync.reverse.analysis.python.python_rules import PythonRules
from rebsync.reverse.analysis.stores import (
    AnyValue,
    CallResult,
    ClassValue,
    Key,
    ObjectValue,
    Stored,
    key_of,
)
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.ir.walk import Node, walk
from rebsync.reverse.libraries.outcome_rules import Size, Tells
from rebsync.reverse.libraries.routines import Language

_LIMIT = 8  # sizes from here on are one
# Parts that texts have, whatever is in them: of `split`, by a text, there is always a first one.
_PARTS_OF_TEXT = {"split": 1, "rsplit": 1, "partition": 3, "rpartition": 3}
_PAIRS = frozenset({"builtins.divmod", "os.path.split", "os.path.splitext", "math.modf"})
_OF_OBJECT = frozenset({"builtins.getattr"})  # they give methods of their first argument
_LOSING = (Size.LOSES, Size.ANY)
# Operators of `+=` and the like, and methods, that leave a container with fewer elements.
_LESSENING = frozenset({Operator.MULTIPLY, Operator.SUBTRACT, Operator.BIT_AND, Operator.BIT_XOR})
_SPECIAL = frozenset({"__delitem__", "__imul__", "__isub__", "__iand__", "__ixor__"})


class ElementCounts:
    """The containers of one program."""

    def __init__(self, origins: Origins) -> None:
        self.origins = origins
        self.graph = origins.graph
        self.table = origins.table
        self.emptying = ForeignEmptying(origins)
        self.rules = PythonRules(origins)
        self.unset: dict[tuple[Key, frozenset[str], bool], frozenset[str] | None] = {}

    def size(self, value: e.Expression, function: str) -> int:
        """How many elements a container has at least, whenever that is asked."""
        return self._size(value, function, {})

    def _size(self, value: e.Expression, function: str, assumed: dict[Key, int]) -> int:
        match value:
            case e.Build(_, elements):
                parts = (
                    self._size(p.operand, function, assumed) if isinstance(p, e.Spread) else 1
                    for p in elements
                )
                return min(sum(parts), _LIMIT)
            case e.Literal(str() as text):
                return len(text)
            case e.BuildMapping(_, entries):
                return int(any(not isinstance(p, e.Spread) for p in entries))
            case e.Binary(Operator.ADD, left, right):
                sizes = (self._size(p, function, assumed) for p in (left, right))
                return min(sum(sizes), _LIMIT)
            case e.Binary(Operator.MULTIPLY, of, e.Literal(int() as times)):
                return min(self._size(of, function, assumed) * max(times, 0), _LIMIT)
            case e.Index(of, e.Slice(low, high, None)):
                return _of_slice(self._size(of, function, assumed), low, high)
            case e.Conditional(_, left, right):
                return min(self._size(p, function, assumed) for p in (left, right))
            case e.Copy(of) | e.Dereference(of) | e.AddressOf(of):
                return self._size(of, function, assumed)
        if isinstance(value, e.Attribute) and not is_own(self.origins, value.object, function):
            return 0
        key = key_of(value, function)
        return 0 if key is None or self._may_lose(key) else self._least(key, assumed)

    def _least(self, key: Key, assumed: dict[Key, int]) -> int:
        """The least size that is stored under a name: the greatest that is true of all stores."""
        if key in assumed:
            return assumed[key]
        stored, size = self.graph.stores.of(key), _LIMIT if self.graph.stores.of(key) else 0
        while size:
            sizes = (self._stored_size(each, {**assumed, key: size}) for each in stored)
            least = min(sizes)
            if least >= size:
                break
            size = least
        return size

    def _stored_size(self, stored: Stored, assumed: dict[Key, int]) -> int:
        function, value = stored
        match value:
            case CallResult(s.Call(_, s.LibraryCallee(name))) if name in _PAIRS:
                return 2
            case CallResult(s.Call(_, s.LibraryCallee(name), arguments)) if arguments:
                copies = self.table.function(name).tells is Tells.SAME
                size = self._size(arguments[0].value, function, assumed) if copies else 0
                return min(size, self._bound_of(arguments, function))
            case CallResult(s.Call(_, s.MethodCallee(_, name), (_, *_))) if self._is_of_text(name):
                return _PARTS_OF_TEXT[name]
            case CallResult(call):
                return min((self._size(v, f, assumed) for f, v in self._results(call)), default=0)
            case AnyValue() | ClassValue() | ObjectValue():
                return 0
            case _:
                return self._size(value, function, assumed)

    def _is_of_text(self, method: str) -> bool:
        """Whether a method is one of texts that tells how many parts there are, and of no other."""
        return method in _PARTS_OF_TEXT and not self.origins.methods_of_any(method)

    def bound(self, value: e.Expression, function: str) -> int:
        """How many elements a container may always have."""
        key = key_of(value, function)
        calls = [
            (around, stored.call)
            for around, stored in (self.graph.stores.of(key) if key is not None else ())
            if isinstance(stored, CallResult)
        ]
        return min((self._bound_of(c.arguments, around) for around, c in calls), default=_LIMIT)

    def _bound_of(self, arguments: Sequence[s.CallArgument], function: str) -> int:
        """The bound that a container gets where it is made; none is known to be greater than 0."""
        value = next((a.value for a in arguments if a.name == "maxlen"), e.Literal(None))
        key = key_of(value, function)
        stored = [v for _, v in self.graph.stores.of(key)] if key is not None else [value]
        bounds = [v.value for v in stored if isinstance(v, e.Literal)]
        if not bounds or len(bounds) < len(stored):
            return 0
        return min(b if isinstance(b, int) else _LIMIT for b in bounds)

    def _results(self, call: s.Call) -> Iterator[tuple[str, e.Expression]]:
        """What the functions of the program give that a call may reach."""
        match call.callee:
            case s.FunctionCallee(name):
                called = frozenset[Origin]({FunctionOrigin(name)})
            case s.ValueCallee(value):
                called = self.origins.of(value, "")
            case s.MethodCallee(name=name):
                methods = self.origins.methods_of_any(name)
                called = frozenset(map(FunctionOrigin, methods))
            case _:
                return
        for origin in called:
            if isinstance(origin, FunctionOrigin):
                for node in walk(self.graph.program.function(origin.name)):
                    if isinstance(node, s.Return) and node.value is not None:
                        yield origin.name, node.value

    def has_key(self, value: e.Expression, key: e.Literal, function: str) -> bool:
        """Whether a mapping has something at a constant key, whenever that is asked."""
        name = key_of(value, function)
        stored = held_by(self.origins, value, function)
        return (
            name is not None
            and bool(stored)
            and not self._may_lose(name)
            and all(_has(v, key) for _, v in stored)
        )

    def elements(
        self, value: e.Expression, function: str, around: frozenset[Key] = frozenset()
    ) -> int:
        """How many elements each element of a container has at least.

        Of names that are stored in each other, as those `around` are, nothing is known.
        """
        match value:
            case e.Build(_, parts):
                return min(
                    (self.size(p, function) for p in parts if not isinstance(p, e.Spread)),
                    default=0,
                )
            case e.Dereference(of) | e.Copy(of) | e.Index(of, e.Slice()):
                return self.elements(of, function, around)
        key = key_of(value, function)
        if key is None or key in self._growing or key in around:
            return 0
        stored = held_by(self.origins, value, function)
        return min((self._elements(each, around | {key}) for each in stored), default=0)

    def _elements(self, stored: Stored, around: frozenset[Key]) -> int:
        function, value = stored
        match value:
            case CallResult(s.Call(_, s.LibraryCallee(name), arguments)) if arguments:
                tells = self.table.function(name).tells
                if tells is Tells.PAIRS:
                    return max(2, len(arguments))
                is_same = tells is Tells.SAME
                return self.elements(arguments[0].value, function, around) if is_same else 0
            case CallResult(s.Call(_, s.MethodCallee(_, name))):
                return 2 if self.table.method(None, name).tells is Tells.PAIRS else 0
            case AnyValue() | ClassValue() | ObjectValue() | CallResult():
                return 0
            case _:
                return self.elements(value, function, around)

    @cached_property
    def _growing(self) -> frozenset[Key | None]:
        """The names of containers that get more elements."""
        found = set[Key | None]()
        for name in self.origins.own:
            for node in walk(self.graph.program.function(name)):
                match node:
                    case s.Call(_, s.MethodCallee(receiver, method)):
                        size = self.table.method(None, method).size
                        if size in (Size.GROWS, Size.MORE):
                            found.add(key_of(receiver, name))
                    case _:
                        pass
        return frozenset(found)

    def _may_lose(self, key: Key) -> bool:
        """Whether elements may be taken out of what is stored under a name, by whatever name."""
        is_lost = self._losing is None or key in self._losing
        return is_lost or key in self.emptying.handed

    @property
    def keeps_elements(self) -> bool:
        """Whether no function takes elements out of containers."""
        return self._losing == frozenset()

    def has_other_names(self, container: e.Local, function: str) -> bool:
        """Whether a container may be known by another name than that of a local variable."""
        key = key_of(container, function)
        assert key is not None
        stores = self.graph.stores
        if not stores.of(key) or any(_is_other(v) for _, v in stores.initial(key)):
            return True
        kept = (value for _, value in stores.everything())
        return any(container in _parts(v) for v in kept) or self._is_passed(container, function)

    def _is_passed(self, container: e.Local, function: str) -> bool:
        """Whether a call gets a container by which it may become known elsewhere."""
        for node in walk(self.graph.program.function(function)):
            match node:
                case s.Call(_, s.LibraryCallee(name), arguments):
                    # Others are put into the first one, unless a method of that is handed on.
                    first = [a for a in arguments[:1] if isinstance(a.value, e.Attribute)]
                    passed = (*(arguments if name in _OF_OBJECT else first), *arguments[1:])
                case s.Call(_, s.MethodCallee(_, name, None), arguments):
                    is_own = bool(self.origins.methods_of_any(name))
                    grows = self.table.method(None, name).size in (Size.GROWS, Size.MORE)
                    passed = arguments if is_own or grows else ()
                case s.Call(_, _, arguments) | s.Construct(_, _, arguments):
                    passed = arguments
                case s.Yield(_, value):
                    passed = (s.CallArgument(value),)
                case _:
                    continue
            if any(container in _parts(a.value) for a in passed):
                return True
        return False

    @cached_property
    def _losing(self) -> frozenset[Key] | None:
        """The names of containers that lose elements; None where these have other names too."""
        found: set[Key] = set()
        for name in self.origins.own:
            for node in walk(self.graph.program.function(name)):
                for container in self._loses(node, name):
                    key = key_of(container, name)
                    # In C++ containers are values: whoever takes an address may store anything.
                    if self.table.language is Language.CPP:
                        found |= {key} if key is not None else set()
                        continue
                    if key is None or any(_is_other(v) for _, v in self.graph.stores.of(key)):
                        return None
                    found.add(key)
        return frozenset(found)

    def _loses(self, node: Node, function: str) -> Iterator[e.Expression]:
        """The containers that a node may take elements out of, or hands on what does."""
        match node:
            case e.Move(of):
                yield of
                yield from parts_moved(self.graph.program, of, function)
            case s.Delete(e.Index(of)) | s.Assign(e.Index(of, e.Slice())):
                yield of
            case s.CompoundAssign(target, operator) if operator in _LESSENING:
                if self._may_be_container(target, function):
                    yield target
            case s.Call(_, s.MethodCallee(of, name)) | e.Attribute(of, name):
                if name in _SPECIAL or self.table.method(None, name).size in _LOSING:
                    yield of
            case s.Call(_, s.LibraryCallee(name, of), arguments):
                if self.table.function(name).size in _LOSING:
                    yield from [of] if of is not None else [a.value for a in arguments[:1]]
            case _:
                pass

    def _may_be_container(self, value: e.Expression, function: str) -> bool:
        """Whether an operator that a value is changed by may take elements out of it."""
        held = self.origins.of(value, function)
        return not held.isdisjoint(LibraryOrigin(name, True) for name in ("list", "set", "deque"))


def _has(value: object, key: e.Literal) -> bool:
    if not isinstance(value, e.BuildMapping):
        return False
    return any(not isinstance(p, e.Spread) and p[0] == key for p in value.entries)


def _parts(value: object) -> Iterator[object]:
    """A value, and what it has in it: a container its elements, a method its object."""
    yield value
    match value:
        case e.Attribute(of):
            yield of
        case e.Build(_, elements):
            for element in elements:
                yield from _parts(element)
        case e.BuildMapping(_, entries):
            for entry in entries:
                yield from () if isinstance(entry, e.Spread) else _parts(entry[1])
        case e.BuildRecord(_, fields):
            for _, each in fields:
                yield from _parts(each)
        case e.Conditional(_, one, other) | e.And(one, other) | e.Or(one, other):
            yield from _parts(one)
            yield from _parts(other)
        case _:
            pass


def _is_other(value: object) -> bool:
    """Whether a stored value may be one that another name stands for."""
    fresh = e.Build | e.BuildMapping | e.Literal | e.Binary | e.Copy | CallResult
    return not isinstance(value, fresh)


def _of_slice(size: int, low: e.Expression | None, high: e.Expression | None) -> int:
    """How many elements a part has at least of a container of a size."""
    match low, high:
        case None, None:
            return size
        case e.Literal(int() as first), None if first >= 0:
            return max(size - first, 0)
        case e.Unary(Operator.NEGATE, e.Literal(int() as last)), None:
            return min(size, last)
        case None, e.Literal(int() as end) if end >= 0:
            return min(size, end)
        case _:
            return 0
