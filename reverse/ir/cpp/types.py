"""Types of C++ as types of the form: fundamental types, the standard library's, the program's."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from enum import Enum
from typing import TypeAlias

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.cpp.declarators import (
    deduced_length,
    has_const,
    inner_declarator,
    is_pointer_to_function,
    is_template_parameter,
)
from rebsync.reverse.ir.cpp.symbol_table import SymbolTable
from rebsync.reverse.ir.cpp.symbols import AliasSymbol, ClassSymbol, EnumSymbol
from rebsync.reverse.ir.dump_types import dump_type
from rebsync.reverse.syntax.cpp_tree import Cpp, named, text_of

INT = t.Integer(32)
UNSIGNED = t.Integer(32, False)
LONG = t.Integer(64)
SIZE = t.Integer(64, False)
CHAR = t.Integer(8)
FLOAT = t.Float(32)
STRING = t.Text(is_bytes=True)
CHARACTERS = t.Reference(CHAR, may_be_null=True)  # what `const char*` is

_BITS = {"8": 8, "16": 16, "32": 32, "64": 64}
_FIXED = re.compile(r"(?:std::)?(u?)int(?:_fast|_least)?(8|16|32|64)_t\Z")
_FUNDAMENTAL: Mapping[str, t.Type] = {
    **{"void": t.NOTHING, "bool": t.TRUTH, "char": CHAR, "int": INT, "float": FLOAT},
    **{"double": t.DOUBLE, "size_t": SIZE, "std::size_t": SIZE, "uint": UNSIGNED},
    **{"ssize_t": LONG, "ptrdiff_t": LONG, "std::ptrdiff_t": LONG, "uintptr_t": SIZE},
    **{"wchar_t": INT, "char16_t": t.Integer(16, False), "char32_t": UNSIGNED},
    **{"std::string": STRING, "std::nullptr_t": CHARACTERS},
}
_SEQUENCES = frozenset({"vector", "list", "deque", "initializer_list", "forward_list"})
_SETS, _MAPS = frozenset({"set", "unordered_set"}), frozenset({"map", "unordered_map"})
_OWNERS: Mapping[str, t.Ownership] = {
    "unique_ptr": t.Ownership.UNIQUE,
    "shared_ptr": t.Ownership.SHARED,
    "scoped_ptr": t.Ownership.UNIQUE,
}
_POINTER_ALIASES: Mapping[str, t.Ownership] = {
    **dict.fromkeys(("Ptr", "ConstPtr", "SharedPtr", "ConstSharedPtr"), t.Ownership.SHARED),
    **dict.fromkeys(("UniquePtr", "ConstUniquePtr"), t.Ownership.UNIQUE),
}
_MESSAGE = re.compile(
    r"(?:::)?(\w+)::(?:(?:msg|srv|action)::)(\w+(?:::\w+)*)\Z|(?:::)?(\w+_(?:msgs|srvs))::(\w+(?:::\w+)*)\Z"
)


class ReferenceKind(Enum):
    """How a parameter, variable or result refers to a value, if it is no value of its own."""

    NONE = ""
    LVALUE = "&"
    CONSTANT = "const &"
    RVALUE = "&&"


@dataclass(frozen=True, slots=True)
class Declared:
    """The type of a variable, parameter or result: of values, or references to such values."""

    type: t.Type
    reference: ReferenceKind = ReferenceKind.NONE
    is_constant: bool = False

    @property
    def form(self) -> t.Type:
        """The type that the form gives it: references are values of their own there."""
        is_value = self.reference is ReferenceKind.NONE
        return self.type if is_value else t.Reference(self.type)


AUTO = Declared(t.UNKNOWN)
Lookup: TypeAlias = Callable[[Node, str, Cpp], "int | None"]


class TypeReader:
    """The types that nodes name. `constant` gives the number that an expression is."""

    def __init__(self, symbols: SymbolTable, constant: Lookup) -> None:
        self.symbols = symbols
        self.constant = constant
        self.tuples: dict[str, tuple[tuple[str, t.Type], ...]] = {}

    def declared(self, cpp: Cpp, scope: str, type_: Node, declarator: Node | None) -> Declared:
        """The type of what a declarator declares; `const` stands beside the type."""
        is_constant = has_const(type_)
        type_read = self.of(cpp, scope, type_)
        return self._wrapped(cpp, scope, type_read, declarator, is_constant)

    def _wrapped(
        self, cpp: Cpp, scope: str, of: t.Type, declarator: Node | None, is_constant: bool
    ) -> Declared:
        """What is around a name: pointers, references, arrays, from the outermost."""
        reference = ReferenceKind.NONE
        node = declarator
        while node is not None:
            match node.type:
                case "pointer_declarator" | "abstract_pointer_declarator":
                    of = t.Reference(of, may_be_null=True)
                    is_constant = any(text_of(c) == "const" for c in node.named_children)
                case "reference_declarator" | "abstract_reference_declarator":
                    is_double = any(c.type == "&&" for c in node.children)
                    reference = _kind_of(is_double, is_constant)
                case "array_declarator" | "abstract_array_declarator":
                    return self._array(cpp, scope, of, node, is_constant)
                case "function_declarator" | "abstract_function_declarator":
                    if not is_pointer_to_function(node):
                        break  # what is around the declarator of a function is its result
                    return Declared(t.FunctionType(), reference, is_constant)
                case "pointer_expression":  # which the grammar takes a pointer to a function for
                    return Declared(t.FunctionType(), reference, is_constant)
                case "parenthesized_declarator" | "abstract_parenthesized_declarator":
                    pass
                case _:
                    break
            inner = node.child_by_field_name("declarator")
            node = inner if inner is not None else inner_declarator(node)
        return Declared(of, reference, is_constant)

    def _array(self, cpp: Cpp, scope: str, of: t.Type, node: Node, is_constant: bool) -> Declared:
        """`int x[2][3]`: the innermost bound is the outermost of the text."""
        lengths: list[int | None] = []
        current: Node | None = node
        while current is not None and "array_declarator" in current.type:
            size = current.child_by_field_name("size")
            lengths.append(None if size is None else self.constant(size, scope, cpp))
            current = current.child_by_field_name("declarator")
        inner = self._wrapped(cpp, scope, of, current, is_constant).type
        if lengths == [None]:
            lengths = [deduced_length(node, inner)]
        for length in lengths:
            if length is None:
                return Declared(t.Reference(inner, may_be_null=True), is_constant=is_constant)
            inner = t.Array(inner, length)
        return Declared(inner, is_constant=is_constant)

    def descriptor(self, cpp: Cpp, scope: str, node: Node) -> Declared:
        """A type as an argument of a template or in a cast."""
        if node.type != "type_descriptor":
            return Declared(self.of(cpp, scope, node))
        type_ = node.child_by_field_name("type")
        declarator = node.child_by_field_name("declarator")
        return AUTO if type_ is None else self.declared(cpp, scope, type_, declarator)

    def of(self, cpp: Cpp, scope: str, node: Node) -> t.Type:
        """The type that a node names."""
        match node.type:
            case "type_identifier" if is_template_parameter(cpp, node):
                return t.UNKNOWN
            case "primitive_type" | "type_identifier" | "namespace_identifier" | "identifier":
                return self.named(cpp, scope, text_of(node))
            case "sized_type_specifier":
                return _sized(text_of(node).split())
            case "type_descriptor":
                return self.descriptor(cpp, scope, node).type
            case "template_type" | "qualified_identifier":
                return self._qualified(cpp, scope, node)
            case "class_specifier" | "struct_specifier" | "enum_specifier" | "union_specifier":
                name = node.child_by_field_name("name")
                return t.UNKNOWN if name is None else self.named(cpp, scope, text_of(name))
            case "dependent_type":
                inner = named(node)
                return self.of(cpp, scope, inner[-1]) if inner else t.UNKNOWN
            case _:
                return t.UNKNOWN

    # --- names ----------------------------------------------------------------------------------

    def named(self, cpp: Cpp, scope: str, name: str) -> t.Type:
        """The type of a name without template arguments."""
        name = "".join(name.split())
        symbol = self.symbols.type_named(name, scope, cpp.source.path)
        match symbol:
            case ClassSymbol():
                return t.UNKNOWN if symbol.is_template or symbol.is_union else t.Record(symbol.name)
            case EnumSymbol():
                return t.Enumeration(symbol.name, self.underlying(symbol))
            case AliasSymbol():
                return self.declared(symbol.cpp, symbol.scope, symbol.type, symbol.declarator).type
        for full in self.symbols.candidates(name, scope, cpp.source.path):
            if full in self.symbols.forward and full not in self.symbols.classes:
                return t.Record(full)
        outer, _, last = name.rpartition("::")
        if last in _POINTER_ALIASES and isinstance(of := self.named(cpp, scope, outer), t.Record):
            return t.Reference(of, True, _POINTER_ALIASES[last])
        return self._of_library(cpp, self.without_alias(cpp, scope, name))

    def without_alias(self, cpp: Cpp, scope: str, name: str) -> str:
        """`Clock::now` by the class of a library that `Clock` is another name of."""
        outer, _, last = name.rpartition("::")
        found = self.symbols.type_named(outer, scope, cpp.source.path) if outer else None
        if isinstance(found, AliasSymbol):
            type_ = self.named(cpp, scope, outer)
            if isinstance(type_, t.Record):
                return f"{type_.name}::{last}"
        return name

    def underlying(self, symbol: EnumSymbol) -> t.Integer:
        """The integers that an enumeration's values are."""
        base = symbol.node.child_by_field_name("base")
        type_ = INT if base is None else self.of(symbol.cpp, symbol.scope, base)
        return type_ if isinstance(type_, t.Integer) else INT

    def _of_library(self, cpp: Cpp, name: str) -> t.Type:
        name = self.imported(cpp, name)
        if (fixed := _FIXED.match(name)) is not None:
            return t.Integer(_BITS[fixed[2]], not fixed[1])
        if name in _FUNDAMENTAL:
            return _FUNDAMENTAL[name]
        outer, _, last = name.rpartition("::")
        if outer and last in _POINTER_ALIASES:
            return t.Reference(self._of_library(cpp, outer), True, _POINTER_ALIASES[last])
        if (message := _MESSAGE.match(name)) is not None:
            package, inner = message[1] or message[3], message[2] or message[4]
            return t.RosMessage(f"{package}/{inner.replace('::', '_')}")
        return t.Record(name) if outer else t.UNKNOWN

    def imported(self, cpp: Cpp, name: str) -> str:
        """A library's name in full where the file says `using`."""
        head, _, rest = name.removeprefix("::").partition("::")
        full = self.symbols.names.get(cpp.source.path, {}).get(head)
        full = full or (self.symbols.spaces.get(head) if rest else None)
        if full is not None:
            return self.imported(cpp, f"{full}::{rest}") if rest else full
        if not rest and "std" in self.symbols.imports.get(cpp.source.path, ()):
            known = f"std::{name}" in _FUNDAMENTAL or name in _STANDARD
            if known:
                return f"std::{name}"
        if not rest and (space := self._foreign_space(cpp)) is not None:
            return f"{space}::{name}"
        return name.removeprefix("::")

    def _foreign_space(self, cpp: Cpp) -> str | None:
        """The namespace of a library that a file says `using namespace` of, but for `std`."""
        spaces = self.symbols.imports.get(cpp.source.path, ())
        others = (s for s in spaces if not s.startswith("std") and "literals" not in s)
        own = self.symbols.own_spaces
        return next(
            (s for s in others if s not in own and s.rpartition("::")[2] != "placeholders"), None
        )

    # --- templates ------------------------------------------------------------------------------

    def _qualified(self, cpp: Cpp, scope: str, node: Node) -> t.Type:
        """`a::b::c<d>`; `c<d>::Ptr`."""
        text = "".join(text_of(node).split())
        if "<" not in text:
            return self.named(cpp, scope, text)
        last, template = node, None
        path: list[str] = []
        while last.type == "qualified_identifier":
            outer, inner = last.child_by_field_name("scope"), last.child_by_field_name("name")
            if outer is not None and outer.type == "template_type":
                template = outer
            path.append("" if outer is None else text_of(outer))
            if inner is None:
                return t.UNKNOWN
            last = inner
        if last.type != "template_type":
            return self._member_of_template(template, path, text_of(last))
        name, arguments = last.child_by_field_name("name"), last.child_by_field_name("arguments")
        if name is None or arguments is None:
            return t.UNKNOWN
        full = self.imported(cpp, "::".join([*filter(None, path), text_of(name)]))
        return self._template(cpp, scope, full, named(arguments))

    def _member_of_template(self, template: Node | None, path: list[str], last: str) -> t.Type:
        if template is None or last not in _POINTER_ALIASES:
            return t.UNKNOWN
        name = template.child_by_field_name("name")
        outer = [p for p in path if "<" not in p]
        full = "::".join([*filter(None, outer), text_of(name) if name is not None else ""])
        return t.Reference(t.Record(full), True, _POINTER_ALIASES[last])

    def _template(self, cpp: Cpp, scope: str, full: str, arguments: list[Node]) -> t.Type:
        space, _, name = full.rpartition("::")
        if space not in ("std", "boost"):
            known = self.symbols.type_named(full, scope, cpp.source.path)
            if known is not None or not space:
                return t.UNKNOWN
            return self._of_classes(full, [self.descriptor(cpp, scope, a).form for a in arguments])
        if name == "bitset":
            return t.Record(full)
        if name == "array":
            length = self.constant(arguments[-1], scope, cpp)
            inner = self.descriptor(cpp, scope, arguments[0]).type
            return t.UNKNOWN if length is None else t.Array(inner, length)
        if name == "function":
            return self._function(cpp, scope, arguments[0])
        inner_types = tuple(self.descriptor(cpp, scope, a).form for a in arguments)
        return self._standard(name, full, inner_types)

    def _standard(self, name: str, full: str, inner: tuple[t.Type, ...]) -> t.Type:
        match name:
            case name if name in _SEQUENCES:
                return t.Container(t.ContainerKind.SEQUENCE, inner[:1])
            case name if name in _SETS:
                return t.Container(t.ContainerKind.SET, inner[:1])
            case name if self._are_own(inner[2:]):
                return self._of_classes(full, inner)
            case name if name in _MAPS:
                return t.Container(t.ContainerKind.MAPPING, inner[:2])
            case "queue":
                return t.Container(t.ContainerKind.QUEUE, inner[:1])
            case "optional":
                return t.Optional(inner[0])
            case "atomic" | "reference_wrapper":
                return inner[0] if name == "atomic" else t.Reference(inner[0])
            case "basic_string":
                return STRING
            case name if name in _OWNERS:
                return t.Reference(inner[0], True, _OWNERS[name])
            case "pair":
                return self.record_of("std::pair", ("first", "second"), inner)
            case "tuple":
                return self.record_of("std::tuple", tuple(map(str, range(len(inner)))), inner)
            case _:
                return self._of_classes(full, inner)

    def _of_classes(self, full: str, inner: Sequence[t.Type]) -> t.Record:
        """A class of a library, with the arguments of the template if a class of the program is."""
        if not self._are_own(inner):
            return t.Record(full)
        return t.Record(f"{full}<{', '.join(map(dump_type, inner))}>")

    def _are_own(self, types: Iterable[t.Type]) -> bool:
        return any(isinstance(x, t.Record) and x.name in self.symbols.classes for x in types)

    def record_of(self, name: str, fields: tuple[str, ...], types: tuple[t.Type, ...]) -> t.Record:
        """`std::pair<A, B>` and `std::tuple`: records whose fields have these types."""
        full = f"{name}<{', '.join(map(dump_type, types))}>"
        self.tuples[full] = tuple(zip(fields, types, strict=False))
        return t.Record(full)

    def _function(self, cpp: Cpp, scope: str, node: Node) -> t.Type:
        """`void(int, const A&)`, the argument of `std::function`."""
        declarator, result = (
            node.child_by_field_name("declarator"),
            node.child_by_field_name("type"),
        )
        list_ = declarator.child_by_field_name("parameters") if declarator is not None else None
        if list_ is None or result is None:
            return t.FunctionType()
        found = [
            self.declared(cpp, scope, type_, p.child_by_field_name("declarator")).form
            for p in named(list_)
            if (type_ := p.child_by_field_name("type")) is not None
        ]
        return t.FunctionType(
            tuple(f for f in found if f != t.NOTHING), self.of(cpp, scope, result)
        )


_STANDARD = (
    _SEQUENCES
    | _SETS
    | _MAPS
    | _OWNERS.keys()
    | {"pair", "tuple", "optional", "array", "function", "atomic", "queue", "mutex", "lock_guard"}
    | {"unique_lock", "thread", "stringstream", "ostringstream", "cout", "cerr", "endl"}
)


def _sized(words: list[str]) -> t.Type:
    """`unsigned long int` and the like, on 64-bit Linux (LP64)."""
    if "double" in words:
        return t.Float(64) if words == ["double"] else t.UNKNOWN
    bits = 64 if "long" in words else 16 if "short" in words else 8 if "char" in words else 32
    return t.Integer(bits, "unsigned" not in words)


def _kind_of(is_double: bool, is_constant: bool) -> ReferenceKind:
    if is_double:
        return ReferenceKind.RVALUE
    return ReferenceKind.CONSTANT if is_constant else ReferenceKind.LVALUE
