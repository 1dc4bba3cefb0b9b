"""What classes of C++ have: members with their types, and which functions do the implicit work."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from rebsync.records import dataclass
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.context import Unlowered, World
from rebsync.reverse.ir.cpp.symbols import ClassSymbol, FieldSymbol, FunctionSymbol
from rebsync.reverse.ir.cpp.types import Declared, ReferenceKind

# Classes of the standard library whose destructors do nothing that code could see.
_SILENT = ("std::pair<", "std::tuple<", "std::chrono::", "std::iterator", "std::stringstream")
_SILENT_NAMES = frozenset(
    {
        *("std::ostringstream", "std::istringstream", "std::mutex", "std::recursive_mutex"),
        *("std::ofstream", "std::ifstream", "std::stack", "std::priority_queue", "std::bitset"),
        *(
            "std::multimap",
            "std::multiset",
            "std::random_device",
            "std::mt19937",
            "std::thread::id",
        ),
        *("std::string_view", "std::default_random_engine", "std::exception", "std::runtime_error"),
    }
)


@dataclass(frozen=True, slots=True)
class DataMember:
    """A field of a class under the name that the form has for it."""

    key: str
    declared: Declared
    symbol: FieldSymbol


def members(world: World, owner: ClassSymbol) -> Iterator[DataMember]:
    """The fields that a class itself declares, in their order; static members apart."""
    for symbol in owner.fields:
        if not symbol.is_static:
            declared = field_type(world, owner, symbol)
            yield DataMember(field_key(world, owner, symbol.name), declared, symbol)


def field_type(world: World, owner: ClassSymbol, symbol: FieldSymbol) -> Declared:
    """The type of a field; a bit-field is an integer of its bits."""
    declared = world.types.declared(symbol.cpp, owner.name, symbol.type, symbol.declarator)
    if symbol.bits is not None and isinstance(declared.type, t.Integer):
        bits = world.types.constant(symbol.bits, owner.name, symbol.cpp)
        if bits is not None and 0 < bits < (declared.type.bits or 64):
            return Declared(t.Integer(bits, declared.type.signed))
    return declared


def field_key(world: World, owner: ClassSymbol, name: str) -> str:
    """The name of a field: with its class where a base or derived class has one of that name."""
    return f"{owner.name}::{name}" if (owner.name, name) in _clashing(world) else name


def _clashing(world: World) -> frozenset[tuple[str, str]]:
    """The fields of which another class on one line of descent has the name as well."""
    symbols = world.symbols
    cached: frozenset[tuple[str, str]] | None = symbols.__dict__.get("clashing")
    if cached is None:
        found: set[tuple[str, str]] = set()
        for name in symbols.classes:
            owners: dict[str, set[str]] = {}
            for class_ in symbols.lineage(name):
                for symbol in class_.fields:
                    owners.setdefault(symbol.name, set()).add(class_.name)
            found |= {(o, f) for f, them in owners.items() if len(them) > 1 for o in them}
        cached = symbols.__dict__["clashing"] = frozenset(found)
    return cached


def find_member(world: World, owner: str, name: str) -> tuple[ClassSymbol, FieldSymbol] | None:
    """The field or static member that a name means in a class or its bases."""
    for class_ in world.symbols.lineage(owner):
        for symbol in class_.fields:
            if symbol.name == name:
                return class_, symbol
    return None


def methods_named(world: World, owner: str, name: str) -> list[FunctionSymbol]:
    """The overloads of the nearest class that has any of a name ([class.member.lookup])."""
    for class_ in world.symbols.lineage(owner):
        found = [f for f in class_.functions if f.simple == name != class_.simple]
        if found:
            return found
    return []


def is_base(world: World, base: t.Type, type_: t.Type) -> bool:
    """Whether a type is a class that another is, or descends from."""
    if not isinstance(base, t.Record) or not isinstance(type_, t.Record):
        return False
    return world.symbols.descends(type_.name, base.name)


def has_unknown_base(world: World, owner: str) -> bool:
    """Whether a class has a base that the program does not have."""
    symbols = world.symbols
    return any(b is None for c in symbols.lineage(owner) for _, b in symbols.bases(c))


# --- what is trivial ([class.prop]) --------------------------------------------------------------


def ends_silently(world: World, type_: t.Type) -> bool:
    """Whether the end of a value runs nothing: its destructor is trivial, or only frees memory."""
    match type_:
        case t.Record(name):
            owner = world.symbols.classes.get(name)
            if owner is None:
                return name.startswith(_SILENT) or name in _SILENT_NAMES
            return _parts_are(world, owner, ends_silently) and not _is_written(owner.destructor)
        case t.Array(element, _):
            return ends_silently(world, element)
        case t.Container(_, elements):
            return all(ends_silently(world, element) for element in elements)
        case t.Optional(of):
            return ends_silently(world, of)
        case t.Reference(to, _, ownership):
            return ownership is t.Ownership.NONE or ends_silently(world, _pointed(world, to))
        case t.Unknown():
            return False
        case _:
            return True


def _pointed(world: World, type_: t.Type) -> t.Type:
    """What a smart pointer ends; that of a class on its own line of descent is taken as silent."""
    if isinstance(type_, t.Record) and type_.name not in world.symbols.classes:
        return t.UnitType()  # an object of a library, which ends itself as the library says
    return t.UnitType() if type_ == t.UNKNOWN else type_


def copies_trivially(world: World, type_: t.Type) -> bool:
    """Whether a copy is the same values in another place, and nothing runs."""
    match type_:
        case t.Record(name):
            owner = world.symbols.classes.get(name)
            if owner is None:
                return True
            own = [f for f in owner.functions if is_copy(owner, f) or f.simple == "operator="]
            written = any(_is_written(f) for f in own)
            is_whole = all(b is not None for _, b in world.symbols.bases(owner))
            return is_whole and not written and _parts_are(world, owner, copies_trivially)
        case t.Array(element, _):
            return copies_trivially(world, element)
        case t.Container(_, elements):
            return all(copies_trivially(world, element) for element in elements)
        case t.Optional(of):
            return copies_trivially(world, of)
        case _:
            return True


def _parts_are(world: World, owner: ClassSymbol, holds: Callable[[World, t.Type], bool]) -> bool:
    parts = [m.declared.type for m in members(world, owner) if not _refers(m.declared)]
    bases = [t.Record(b.name if b is not None else name) for name, b in world.symbols.bases(owner)]
    return all(holds(world, type_) for type_ in (*bases, *parts))


def _refers(declared: Declared) -> bool:
    return declared.reference is not ReferenceKind.NONE


def _is_written(function: FunctionSymbol | None) -> bool:
    return function is not None and not function.is_default and not function.is_deleted


def is_copy(owner: ClassSymbol, function: FunctionSymbol) -> bool:
    """Whether a function is a copy or move constructor of a class."""
    if function.simple != owner.simple or len(function.code.parameters) != 1:
        return False
    parameter = function.code.parameters[0]
    text = (parameter.type.text or b"").decode()
    return "".join(text.split()).rpartition("::")[2] == owner.simple


def is_aggregate(owner: ClassSymbol) -> bool:
    """Whether braces give its fields their values ([dcl.init.aggr])."""
    written = [f for f in owner.constructors if not f.is_default and not f.is_deleted]
    is_virtual = any(f.is_virtual for f in owner.functions)
    return not written and not is_virtual and not owner.bases and not owner.is_union


def needs_constructor(world: World, owner: ClassSymbol) -> bool:
    """Whether the implicit default constructor runs anything ([class.default.ctor])."""
    if owner.bases or any(f.is_default for f in owner.constructors if not f.code.parameters):
        return True
    return any(
        m.symbol.value is not None or _constructs(world, m.declared) for m in members(world, owner)
    )


def _constructs(world: World, declared: Declared) -> bool:
    match declared.type:
        case t.Record(_) | t.Container() | t.Text() | t.Optional() | t.RosMessage() | t.Unknown():
            return not _refers(declared)
        case t.Reference(_, _, ownership):
            return ownership is not t.Ownership.NONE
        case t.Array(element, _):
            return _constructs(world, Declared(element))
        case _:
            return False


def implicit_constructor(owner: ClassSymbol) -> str:
    """The name of the constructor that the language declares by itself."""
    return f"{owner.name}::{owner.simple}"


def called_implicitly(owner: ClassSymbol) -> str:
    """The same where it is called; templates have none, as it depends on their arguments."""
    if owner.is_template:
        raise Unlowered("an object of a template that declares no constructor")
    return implicit_constructor(owner)
