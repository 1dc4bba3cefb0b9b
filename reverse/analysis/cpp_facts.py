"""What a program of C++ says as a whole: which parameters are declared, what runs at the start."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property

from rebsync.reverse.analysis.ended_objects import ended_by, left_dangling
from rebsync.reverse.analysis.facts import Facts, IsBound, bare, without
from rebsync.reverse.analysis.stores import Key, Stored, key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.program import Function, FunctionKind, Program
from rebsync.reverse.ir.walk import Node, walk
from rebsync.reverse.libraries.client_times import is_of_times
from rebsync.reverse.libraries.cpp import keeping_arguments, logging
from rebsync.reverse.libraries.size_effects import RELEASING, SWAPPING

# The types of parameters, by how the form writes those of C++.
_TYPES = (("float", float), ("truth", bool), ("i", int), ("text", str), ("bytes", str))


class CppFacts:
    """Of one program; each is looked for when it is first asked for."""

    def __init__(self, program: Program) -> None:
        self._program = program

    @cached_property
    def constructing(self) -> frozenset[str]:
        """The constructors of C++, and what these call at once."""
        program = self._program
        kinds = {f: program.function(f).kind for f in program.functions}
        found = {f for f, kind in kinds.items() if kind is FunctionKind.CONSTRUCTOR}
        waiting = [*found]
        while waiting:
            body = program.function(waiting.pop()).body
            calls = (n.callee for n in walk(body) if isinstance(n, s.Call))
            called = {c.name for c in calls if isinstance(c, s.FunctionCallee)}
            waiting += [name for name in called - found if name in program]
            found |= called
        return frozenset(found)

    @cached_property
    def constructors(self) -> Mapping[str, tuple[str, ...]]:
        """By each class the constructors that it has, or the implicit one."""
        found: dict[str, tuple[str, ...]] = {}
        for f in self._functions:
            if f.kind is FunctionKind.CONSTRUCTOR and f.owner is not None:
                found[f.owner] = (*found.get(f.owner, ()), f.name)
        return found

    @cached_property
    def has_throwing_streams(self) -> bool:
        """Whether a stream is asked to throw where an operation on it fails."""
        calls = (n for f in self._functions for n in walk(f) if isinstance(n, s.Call))
        asking = (c for c in calls if c.arguments)
        names = (getattr(c.callee, "name", "").rpartition("::")[2] for c in asking)
        return "exceptions" in names

    @cached_property
    def declared_parameters(self) -> frozenset[str]:
        """The names that stand in calls which declare a parameter of a node in C++."""
        every = (self._program.function(name) for name in self._program.functions)
        calls = (n for f in every for n in walk(f) if isinstance(n, s.Call))
        declaring = (c for c in calls if "declare_parameter" in getattr(c.callee, "name", ""))
        texts = (
            n.value
            for c in declaring
            for a in c.arguments
            for n in walk(a.value)
            if isinstance(n, e.Literal)
        )
        return frozenset(text for text in texts if isinstance(text, str))

    @cached_property
    def parameter_types(self) -> Mapping[str, frozenset[type | None]]:
        """By the names of parameters the types that they are declared with; None if not known."""
        found: dict[str, frozenset[type | None]] = {}
        calls = (n for f in self._functions for n in walk(f) if isinstance(n, s.Call))
        for call in calls:
            name, _, given = getattr(call.callee, "name", "").partition("<")
            values = [a.value for a in call.arguments]
            if name.rpartition("::")[2] != "declare_parameter" or not values:
                continue
            match values[0]:
                case e.Literal(str() as text):
                    types = found.get(text, frozenset())
                    found[text] = types | {_declared_type(given, values[1:2])}
                case _:
                    pass
        return found

    @cached_property
    def unchanging_addresses(self) -> Mapping[Key, int]:
        """By each variable in how many places its address is taken only to look at it.

        Classes of times and logs look at what they get by its address; functions of the program do
        if none of them stores through their parameter. `stored_through` says what is stored through
        a temporary.
        """
        places = ((key_of(of, f.name)) for f in self._functions for of in self._looked_at(f))
        return Counter(key for key in places if key is not None)

    @cached_property
    def stored_through(self) -> Mapping[Key, list[Stored]]:
        """By each variable what is stored in it through a temporary that has its address."""
        found: dict[Key, list[Stored]] = {}
        for function in self._functions:
            stored = _stored_through(function)
            for node in walk(function) if stored else ():
                match node:
                    case s.Assign(e.Temporary(number), e.AddressOf(of)) if number in stored:
                        key = key_of(of, function.name)
                        if key is not None:
                            values = [(function.name, v) for v in stored[number]]
                            found.setdefault(key, []).extend(values)
                    case _:
                        pass
        return found

    @cached_property
    def emptied(self) -> Mapping[Key, frozenset[str]]:
        """By each pointer the functions that leave it without an object, other than by `=`."""
        found: dict[Key, frozenset[str]] = {}
        for function in self._functions:
            for key in emptied_by(self._program, walk(function), function.name):
                found[key] = found.get(key, frozenset()) | {function.name}
        return found

    @cached_property
    def calls(self) -> Mapping[str, Sequence[tuple[str, s.Call | s.Construct]]]:
        """By each function its calls, with where they stand, if nothing else may call it."""
        found: dict[str, list[tuple[str, s.Call | s.Construct]]] = {}
        others = {"main"}
        for function in self._functions:
            for node in walk(function):
                match node:
                    case s.Call(_, s.FunctionCallee(name)) | s.Construct(_, _, _, str() as name):
                        found.setdefault(name, []).append((function.name, node))
                    case e.FunctionReference(name) | e.Closure(name):
                        others.add(name)
                    case s.Call(_, s.MethodCallee(name=name)):
                        others.update(n for n in self._program.functions if n.endswith(f"::{name}"))
                    case _:
                        pass
        return {name: calls for name, calls in found.items() if name not in others}

    @cached_property
    def handed_to(self) -> Mapping[str, tuple[str, s.Call]]:
        """By each lambda the call of a library that alone gets it, with where that stands."""
        found: dict[str, tuple[str, s.Call]] = {}
        every = Counter[str]()
        for function in self._functions:
            nodes = list(walk(function))
            every.update(n.function for n in nodes if isinstance(n, e.Closure))
            named = Counter[e.Expression](n for n in nodes if isinstance(n, e.Temporary))
            stores = (n for n in nodes if isinstance(n, s.Assign))
            # A temporary is named where it is stored in, and where it is handed over.
            kept: dict[e.Expression, e.Expression] = {
                n.target: n.value for n in stores if named[n.target] == 2
            }
            for node in nodes:
                match node:
                    case s.Call(_, s.LibraryCallee(), arguments):
                        values = (kept.get(a.value, a.value) for a in arguments)
                        lambdas = (v.function for v in values if isinstance(v, e.Closure))
                        found |= dict.fromkeys(lambdas, (function.name, node))
                    case _:
                        pass
        return {name: call for name, call in found.items() if every[name] == 1}

    @cached_property
    def left_dangling(self) -> frozenset[Key]:
        """The members and variables of files whose object may end twice."""
        return left_dangling(self._program)

    @cached_property
    def moved_classes(self) -> frozenset[str]:
        """The classes whose objects may be moved from: copied, handed to libraries, or elements."""
        handed = (type_ for f in self._functions for n in walk(f) for type_ in _handed(n))
        return self.copied_classes | {type_.name for type_ in handed if isinstance(type_, t.Record)}

    @cached_property
    def copied_classes(self) -> frozenset[str]:
        """The classes whose objects are copied or moved part by part, or are elements."""
        types = (type_ for f in self._functions for n in walk(f) for type_ in _copied(n))
        return frozenset(type_.name for type_ in types if isinstance(type_, t.Record))

    @property
    def _functions(self) -> Iterator[Function]:
        return (self._program.function(name) for name in self._program.functions)

    def _looked_at(self, function: Function) -> Iterator[e.Expression]:
        """What a function takes the address of, other than to change it."""
        for node in walk(function):
            match node:
                case s.Assign(e.Temporary(), e.AddressOf(of)):
                    yield of
                case s.Call(_, s.FunctionCallee(name), arguments):
                    called = self._program.function(name)
                    shifted = len(called.parameters) - len(arguments)
                    pairs = zip(called.parameters[max(shifted, 0) :], arguments, strict=False)
                    for parameter, argument in pairs:
                        is_kept = parameter.name not in _stored_into(called)
                        if isinstance(argument.value, e.AddressOf) and is_kept:
                            yield argument.value.target
                case s.Call(_, s.LibraryCallee(name), arguments) if _looks(name):
                    values = (a.value for a in arguments)
                    yield from (v.target for v in values if isinstance(v, e.AddressOf))
                case e.Dereference(e.AddressOf(of)):
                    yield of
                case _:
                    pass


def emptied_by(program: Program, nodes: Iterable[Node], function: str) -> Iterator[Key]:
    """The pointers that some nodes of a function leave without an object, in objects too."""
    for of in (of for node in nodes for of in moved_out_by(node)):
        for part in (of, *parts_moved(program, of, function)):
            key = key_of(part, function)
            if key is not None:
                yield key


def parts_moved(program: Program, of: e.Expression, function: str) -> Iterator[e.Attribute]:
    """The members of an object that is moved from, each of which is ([class.copy.ctor]).

    Of a variable that nothing behind it in its function names there are none: it only ends.
    """
    if isinstance(of, e.Local) and not isinstance(of.type, t.Reference):
        nodes = list(walk(program.function(function)))
        is_again = any(isinstance(n, s.Loop | s.ForEach) for n in nodes)
        at = next((i for i, n in enumerate(nodes) if isinstance(n, e.Move) and n.operand is of), 0)
        ends = sum(isinstance(n, s.Destroy) and n.target == of for n in nodes[at:])
        if at and not is_again and nodes[at:].count(of) == 1 + ends:
            return
    yield from _parts(program, of)


def _parts(program: Program, of: e.Expression) -> Iterator[e.Attribute]:
    type_ = getattr(of, "type", t.UNKNOWN)
    waiting = [type_.name] if isinstance(type_, t.Record) else []
    while waiting:
        class_ = program.classes.get(waiting.pop())
        for field in class_.fields if class_ is not None else ():
            part = e.Attribute(of, field.name, field.type, False)
            yield part
            yield from _parts(program, part)
        waiting += [] if class_ is None else [base for base in class_.bases if base is not None]


def without_moved(facts: Facts, node: Node | s.Body) -> Facts:
    """The facts that are left where pointers lose their objects, and names their values."""
    for each in walk(node):
        for of in moved_out_by(each):
            facts = without(facts, of)
        unbound = (each.target,) if isinstance(each, s.Delete) else map(bare, ended_by(each))
        facts = facts.difference(IsBound(of) for of in unbound)
    return facts


def moved_out_by(node: object) -> Iterator[e.Expression]:
    """What a node leaves without an object: it is moved from, deleted or given up."""
    match node:
        case e.Move(of):
            yield of
        case s.Destroy(e.Dereference(of)):
            yield of
        case s.Call(_, s.LibraryCallee("delete[]"), (s.CallArgument(of),)):
            yield of
        case s.Call(_, s.LibraryCallee(name, of), values):
            last = name.rpartition("::")[2]
            if of is not None and last in RELEASING and not (values and last == "reset"):
                yield of
            if last in SWAPPING:
                yield from (v.value.target for v in values if isinstance(v.value, e.AddressOf))
        case _:
            pass


def _handed(node: Node) -> Iterator[t.Type]:
    """The types of what a node hands to a library, which may move from it."""
    if isinstance(node, s.Call) and isinstance(node.callee, s.LibraryCallee):
        values = (a.value for a in node.arguments)
        targets = (v.target if isinstance(v, e.AddressOf) else v for v in values)
        yield from (getattr(v, "type", t.UNKNOWN) for v in targets)


def _copied(node: Node) -> Iterator[t.Type]:
    """The types of what a node may copy, or move, part by part."""
    if isinstance(node, e.Copy | e.Move):
        yield getattr(node.operand, "type", t.UNKNOWN)
    match getattr(node, "type", None):
        case t.Container(_, elements):
            yield from elements
        case t.Optional(element):
            yield element
        case _:
            pass


def _looks(name: str) -> bool:
    """Whether a function of a library only looks at what it gets."""
    is_told = name.startswith(logging()) or name.rpartition("::")[2] in keeping_arguments()
    return is_told or is_of_times(name)


def _declared_type(given: str, values: list[e.Expression]) -> type | None:
    """The type of a parameter, by the argument of the template, or by its first value."""
    if given:
        return next((type_ for text, type_ in _TYPES if given.startswith(text)), None)
    for value in values:
        while isinstance(value, e.Convert):
            value = value.operand
        if isinstance(value, e.Literal) and isinstance(value.value, bool | int | float | str):
            return type(value.value)
    return None


def _stored_through(function: Function) -> dict[int, list[e.Expression]]:
    """By each temporary of a function what is stored at the address that it has."""
    found: dict[int, list[e.Expression]] = {}
    for node in walk(function):
        match node:
            case s.Assign(e.Dereference(e.Temporary(number)), value):
                found.setdefault(number, []).append(value)
            case _:
                pass
    return found


def _stored_into(function: Function) -> frozenset[str]:
    """The parameters of a function at whose addresses it may store something, or lets others."""
    found = set[str]()
    for node in walk(function):
        match node:
            case s.Assign(e.Dereference(e.Local(name))) | s.Call(e.Dereference(e.Local(name))):
                found.add(name)
            case s.CompoundAssign(e.Dereference(e.Local(name))):
                found.add(name)
            case s.Assign(_, e.Local(name)):
                found.add(name)
            case s.Call(_, s.FunctionCallee(), arguments):
                found |= {a.value.name for a in arguments if isinstance(a.value, e.Local)}
            case _:
                pass
    return frozenset(found)
