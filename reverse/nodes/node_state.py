"""What the variables of a unit are in the model: state variables, messages, publishers, timers."""

from __future__ import annotations

from collections.abc import Collection, Container, Iterator, Mapping, Sequence
from dataclasses import field

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_messages import is_pointer, zero_of
from rebsync.reverse.bodies.cpp_places import HELD
from rebsync.reverse.bodies.cpp_pointers import is_null, is_tested
from rebsync.reverse.bodies.cpp_unknowns import domain_near
from rebsync.reverse.bodies.effects.cpp_pointees import is_changed
from rebsync.reverse.bodies.effects.known_functions import is_matrix
from rebsync.reverse.bodies.scope import Member, Outside, Record, Stores, Variable
from rebsync.reverse.bodies.types.cpp_types import Carried, arguments_of, carried_in, is_time, wider
from rebsync.reverse.bodies.types.cpp_widths import place_of
from rebsync.reverse.build.message_types import MessageTypes
from rebsync.reverse.findings import Findings
from rebsync.reverse.models.texts import TEXT
from rebsync.reverse.nodes.node_declarations import (
    declarations,
    is_asked,
    is_static,
    number_of,
    stands_in,
    stored_in_optional,
)
from rebsync.reverse.nodes.node_names import Names, model_word
from rebsync.reverse.nodes.node_taken import UsedNames
from rebsync.reverse.nodes.node_units import Unit
from rebsync.reverse.syntax.cpp_declarations import CppField, declared_name
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, named, text_of
from rebsync.static.types import BOOLEAN, INT


@dataclass(frozen=True, slots=True)
class UnsetVariable:
    """A variable that is made without a value, by its name in the code."""

    name: str
    variable: Variable
    cpp: Cpp
    node: Node


@dataclass(frozen=True, slots=True)
class Wide:
    """A variable whose type holds more than the model's `int`: bits without the sign, and why."""

    bits: int
    cpp: Cpp
    node: Node
    why: str


@dataclass(slots=True)
class State:
    """The variables of a unit by their names in the code.

    `variables` are the state variables with their types; `local` are those of one function that
    outlive it, by the id of the function's node; `initial` what holds before a constructor runs;
    `wide` are those that can hold more in the code, by their names in the model;
    `unset` are those that are made without a value, by their names in the model; `switches` those
    of timers that are stopped and started.
    """

    code: Code
    unit: Unit
    types: MessageTypes
    names: Names
    units: frozenset[str]
    enums: frozenset[str]
    members: dict[str, Member] = field(default_factory=dict)
    variables: dict[str, m.Type] = field(default_factory=dict)
    local: dict[int, dict[str, Member]] = field(default_factory=dict)
    initial: list[tuple[Cpp, Stores]] = field(default_factory=list)
    wide: dict[str, Wide] = field(default_factory=dict)
    unset: dict[str, UnsetVariable] = field(default_factory=dict)
    switches: dict[str, tuple[str, str, str]] = field(default_factory=dict)
    taken: UsedNames = field(init=False)  # the names that the unit's functions have
    outlived: dict[tuple[int, frozenset[str], bool], dict[int, tuple[Stores, ...]]] = field(
        default_factory=dict
    )

    def __post_init__(self) -> None:
        self.taken = UsedNames(self.code, self.unit.functions)
        for member in self._globals():
            self._add(member)
        for above in reversed(self.unit.lineage):
            for member in (*above.fields, *above.others):
                outside = self.code.statics.get((above.name, member.name))
                self._add(member, outside if member.value is None else None)
                if member.value is None and not is_static(member.node):
                    left = self.members[member.name]
                    self._leave(member.name, left, member.type, member.cpp, member.type)

    def _globals(self) -> Iterator[CppField]:
        for variables in self.code.variables.values():
            for variable in variables:
                path = variable.cpp.source.path
                if path in self.unit.files and (path, variable.name) not in self.code.constants:
                    yield variable

    def _add(self, member: CppField, outside: CppField | None = None) -> None:
        """`outside` gives the value of a static member that has it outside of its class."""
        declarator = _declarator(member.node, member.name)
        meaning = self.meaning(member.name, member.type, declarator, member.cpp, self.taken)
        self.members[member.name] = meaning
        given = outside if outside is not None else member
        if given.value is not None and not is_null(given.value):
            braces = given.value.type == "initializer_list"
            values = named(given.value) if braces else [given.value]
            self.initial += [(given.cpp, each) for each in self.stored(meaning, values)]

    def _leave(self, name: str, meaning: Member, type_: Node, cpp: Cpp, node: Node) -> None:
        """Keeps in mind that a variable has no value yet: times and messages have theirs."""
        match meaning:
            case Variable(of_model, kept) if not is_time(type_) and kept != TEXT:
                self.unset[of_model] = UnsetVariable(name, meaning, cpp, node)
            case Record({"*": held}) if not is_asked(name, self.unit.functions):
                self.unset[held.name] = UnsetVariable(name, held, cpp, node)
            case Record(fields, ""):
                owner = self.code.classes.get(text_of(type_).rpartition("::")[2])
                for member in owner.fields if owner is not None else ():
                    if member.name in fields and member.value is None:
                        inner = f"{name}.{member.name}"
                        self._leave(inner, fields[member.name], member.type, cpp, node)
            case _:
                pass

    def switch(self, timer: str, once: bool) -> tuple[str, str, str]:
        """Whether a timer runs, how many of its messages are stale, whether it goes off `once`."""
        if timer not in self.switches:
            wish = timer.rstrip("_")
            running = self._new([f"{wish}_running"], BOOLEAN)
            stale = self._new([f"{wish}_stale"], INT)
            waiting = self._new([f"{wish}_waiting"], BOOLEAN) if once else ""
            self.switches[timer] = running, stale, waiting
        return self.switches[timer]

    def zeros(self, meaning: Member | None) -> tuple[Stores, ...]:
        """What `x()` stores in the initialisers of a constructor."""
        match meaning:
            case Variable(name) if name in self.unset:
                return tuple(zeros(m.Name(name), self.variables[name]))
            case Record(fields):
                return tuple(s for field_ in fields.values() for s in self.zeros(field_))
            case _:
                return ()

    def stored(self, meaning: Member | None, values: list[Node]) -> tuple[Stores, ...]:
        """What a variable holds from the start; where parts have no value each, the first all."""
        match meaning:
            case Variable(name, m.Type(dimensions=(_, *_))) if values:
                around = _parent(values[0])
                braces = around.type == "initializer_list"
                return (Stores(m.Name(name), around if braces else values[0]),)
            case Variable(name) if values:
                value = values[0] if len(values) == 1 else _parent(values[0])
                return (Stores(m.Name(name), value),)
            case Record(fields, there=there) if HELD in fields and values:
                return stored_in_optional(m.Name(there), m.Name(fields[HELD].name), values[0])
            case Record(fields, "") if len(values) == len(fields) > 1:
                pairs = zip(fields.values(), values, strict=True)
                return tuple(Stores(m.Name(field_.name), value) for field_, value in pairs)
            case Record(fields) if values and fields:
                first = next(iter(fields.values()))
                return (Stores(m.Name(first.name), _parent(values[0])),)
            case _:
                return ()

    def meaning(
        self, name: str, type_: Node, declarator: Node | None, cpp: Cpp, taken: Container[str]
    ) -> Member:
        """What a variable of this type is; those of the model are state variables from here on."""
        wish = name.rstrip("_") or name
        shape = declarator.type if declarator is not None else "identifier"
        message = self.types.named(text_of(type_))
        if message is not None and shape in ("identifier", "field_identifier"):
            return self._record(message, name, wish, cpp, type_)
        if shape == "array_declarator" and declarator is not None:
            return self._array(wish, name, type_, declarator, cpp, taken)
        if shape not in ("identifier", "field_identifier", "init_declarator"):
            reaches = text_of(type_).rpartition("::")[2] in self.units
            return Outside(reaches=reaches, indexed=is_matrix(text_of(type_)))
        kept = carried_in(type_, self.enums)
        if kept is not None:
            free = self._free(taken, (wish, name, f"{wish}_"), f"{wish}_")
            given, domain = self._new(free, kept.type), domain_near(type_) or ()
            self._note_wide(given, kept, cpp, type_)
            return Variable(given, kept.type, kept.bits, domain, kept.wide)
        if is_matrix(text_of(type_)):
            return Outside(indexed=True)
        if pair := arguments_of(type_, "pair"):
            halves = zip(("first", "second"), pair, strict=True)
            both = {name: self._field(wish, name, each, cpp) for name, each in halves}
            fields = {name: field for name, field in both.items() if field is not None}
            return Record(fields) if len(fields) == len(both) else Outside()
        if inner := arguments_of(type_, "optional"):
            held = self._field(wish, "value", inner[0], cpp)
            if held is None or held.type == TEXT:
                return Outside()
            return Record({HELD: held}, there=self._new([f"{wish}_is_there"], BOOLEAN))
        return self._struct(text_of(type_).rpartition("::")[2], wish)

    def _free(self, taken: Container[str], wishes: Sequence[str], other: str) -> list[str]:
        """The wishes that are not taken, none after that which is given; or else another name."""
        found: list[str] = []
        for wish in wishes:
            if wish not in taken:
                found.append(wish)
                if model_word(wish) not in self.names.used:
                    break
        return found or [other]

    def _new(self, wishes: list[str], type_: m.Type) -> str:
        given = self.names.give(*wishes)
        self.variables[given] = type_
        return given

    def _record(self, message: str, name: str, wish: str, cpp: Cpp, node: Node) -> Record:
        fields = {}
        for path, type_ in (self.types.fields(message) or {}).items():
            plain = type_ is not None and not type_.dimensions
            if type_ is not None and plain and not f".{path}".count(".header."):
                given = self._new([f"{wish}_{path}".replace(".", "_")], type_)
                fields[path] = self.types.variable(message, path, given, type_)
                kept = Carried(type_, 0, wider(path), fields[path].wide)
                self._note_wide(given, kept, cpp, node)
        if not is_pointer(text_of(node)):
            return Record(fields, message)
        tested = any(is_tested(name, text_of(f.node)) for f in self.unit.functions)
        there = self._new([f"{wish}_is_there"], BOOLEAN) if tested else ""
        constant = "Const" in text_of(node) or "<const" in text_of(node)
        shared = not constant and is_changed(fields, self.unit.functions)
        return Record(fields, message, there=there, shared=shared)

    def _array(
        self, wish: str, name: str, type_: Node, declarator: Node, cpp: Cpp, taken: Container[str]
    ) -> Member:
        kept = carried_in(type_, self.enums)
        lengths: list[int] = []
        at: Node | None = declarator
        while at is not None and at.type == "array_declarator":
            size = at.child_by_field_name("size")
            length = number_of(self.code, cpp, size) if size is not None else None
            if length is None or length < 1:
                return Outside()
            lengths.insert(0, length)
            at = at.child_by_field_name("declarator")
        if kept is None or kept.type.dimensions or kept.bits or kept.type == TEXT:
            return Outside()
        array = m.Type(kept.type.name, tuple(lengths))
        free = self._free(taken, (wish, name), f"{wish}_")
        given = self._new(free, array)
        self._note_wide(given, kept, cpp, type_)
        return Variable(given, array, wide=kept.wide)

    def _struct(self, type_: str, wish: str) -> Member:
        """A plain structure is a message of its own; other objects are outside."""
        owner = self.code.classes.get(type_)
        if owner is None:
            return Outside(reaches=type_ in self.units)
        plain = not owner.bases and not owner.others and not owner.functions
        if type_ in self.units or not plain:
            return Outside(reaches=type_ in self.units)
        fields: dict[str, Variable] = {}
        for member in owner.fields:
            field_ = self._field(wish, member.name, member.type, member.cpp)
            if field_ is not None:
                fields[member.name] = field_
                if member.value is not None:
                    self.initial.append((member.cpp, Stores(m.Name(field_.name), member.value)))
        return Record(fields)

    def _field(self, wish: str, name: str, type_: Node, cpp: Cpp) -> Variable | None:
        kept = carried_in(type_, self.enums)
        if kept is None or kept.type.dimensions:
            return None
        given = self._new([f"{wish}_{name}"], kept.type)
        self._note_wide(given, kept, cpp, type_)
        return place_of(given, kept)

    # --- variables of functions -----------------------------------------------------------------

    def outlive(
        self, function: CppFunction, names: set[str], only_static: bool, within: Node | None = None
    ) -> dict[int, tuple[Stores, ...]]:
        """Makes variables of a function state variables; what stands for their declarations.

        Those that are declared `within` a loop live for one round only.
        """
        if not any(stands_in(function, word) for word in (("static",) if only_static else names)):
            return {}
        key = function.node.id, frozenset(names), only_static
        if key not in self.outlived:
            self.outlived[key] = self._outlive(function, names, only_static, within)
        return self.outlived[key]

    def _outlive(
        self, function: CppFunction, names: set[str], only_static: bool, within: Node | None
    ) -> dict[int, tuple[Stores, ...]]:
        instead: dict[int, tuple[Stores, ...]] = {}
        local = self.local.setdefault(function.node.id, {})
        for node in declarations(self.code, function):
            if within is not None and within.start_byte <= node.start_byte < within.end_byte:
                continue
            static = any(text_of(c) == "static" for c in node.named_children)
            found = [(d, n) for d in node.children_by_field_name("declarator") for n in _name(d)]
            wanted = [(d, n) for d, n in found if n in names or static]
            if not wanted or static != only_static or len(wanted) != len(found):
                continue
            type_ = node.child_by_field_name("type")
            stores = []
            for declarator, name in wanted:
                if type_ is None or name in local:
                    continue
                inner = _inner(declarator)
                meaning = self.meaning(name, type_, inner, function.cpp, set())
                local[name] = meaning
                if not only_static and declarator.type != "init_declarator":
                    self._leave(name, meaning, type_, function.cpp, type_)
                if only_static:  # what is put in the place of a call sees it too
                    self.members.setdefault(name, meaning)
                value = _value(declarator)
                if isinstance(meaning, Variable) and value is not None:
                    stores.append(Stores(m.Name(meaning.name), value))
            if only_static:  # the declaration is read as well: its first values may do something
                self.initial += [(function.cpp, s) for s in stores]
            else:
                instead[node.id] = tuple(stores)
        return instead

    def members_of(self, function: CppFunction | None) -> Mapping[str, Member]:
        """What the names of variables stand for in a function."""
        if function is None or function.node.id not in self.local:
            return self.members
        return {**self.members, **self.local[function.node.id]}

    def _note_wide(self, name: str, kept: Carried, cpp: Cpp, node: Node) -> None:
        if kept.wide:
            self.wide[name] = Wide(kept.wide, cpp, node, kept.why)

    def note(self, names: Collection[str], findings: Findings, within: str) -> None:
        """Lists those variables that hold more than the model's."""
        for name, wide in self.wide.items():
            if name in names:
                span = wide.cpp.span(wide.node)
                findings.assumed(wide.cpp.source, span, wide.why, within=within)


def zeros(place: m.Expression, type_: m.Type) -> Iterator[Stores]:
    """What a variable, or each element of an array, holds at first."""
    zero = zero_of(type_)
    if zero is not None:
        yield Stores(place, zero)
    for index in range(type_.dimensions[0] if type_.dimensions else 0):
        inner = m.Type(type_.name, type_.dimensions[1:])
        yield from zeros(m.Index(place, m.IntLiteral(index)), inner)


def _parent(node: Node) -> Node:
    return node.parent if node.parent is not None else node


def _declarator(node: Node, name: str) -> Node | None:
    """The declarator of one of the variables of a declaration."""
    for declarator in node.children_by_field_name("declarator"):
        inner = _inner(declarator)
        found = declared_name(inner)
        if found is not None and text_of(found) == name:
            return inner
    return None


def _inner(declarator: Node) -> Node:
    if declarator.type == "init_declarator":
        return declarator.child_by_field_name("declarator") or declarator
    return declarator


def _name(declarator: Node) -> list[str]:
    found = declared_name(_inner(declarator))
    return [text_of(found)] if found is not None else []


def _value(declarator: Node) -> Node | None:
    """The one value that a declarator gives."""
    if declarator.type != "init_declarator":
        return None
    value = declarator.child_by_field_name("value")
    if value is not None and value.type in ("argument_list", "initializer_list"):
        inside = named(value)
        return inside[0] if len(inside) == 1 else None
    return value
