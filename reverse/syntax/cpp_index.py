"""The declarations of the C++ files of a package: classes, functions, constants.

Header and source are read together: a function's body is looked for wherever it is.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import field
from typing import TypeVar

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_calls import CppCall
from rebsync.reverse.syntax.cpp_declarations import (
    TYPES,
    CppAlias,
    CppClass,
    CppEnumerator,
    CppField,
    CppFunction,
    CppParameter,
    bases_of,
    constant_name,
    declared_name,
    function_of,
    is_constant,
    members_of,
    only_braces,
    other_fields,
    plain_fields,
    roots_of,
    unscoped,
    valued,
    with_values,
)
from rebsync.reverse.syntax.cpp_initialisers import initialised_in
from rebsync.reverse.syntax.cpp_numbers import KnownNumbers, enumerated
from rebsync.reverse.syntax.cpp_searches import Searches
from rebsync.reverse.syntax.cpp_tree import Cpp, markers_above, parse, part, text_of
from rebsync.source import Source

__all__ = [
    "Code",
    "CppAlias",
    "CppClass",
    "CppEnumerator",
    "CppField",
    "CppFunction",
    "CppParameter",
    "function_of",
]

_K = TypeVar("_K")
_V = TypeVar("_V")

_HEADERS = (".h", ".hh", ".hpp", ".hxx", ".cuh", ".ipp", ".tpp")
CONTAINERS = frozenset(
    {
        *("translation_unit", "namespace_definition", "declaration_list", "ERROR"),
        *("linkage_specification", "preproc_if", "preproc_ifdef", "preproc_else", "preproc_elif"),
        *("preproc_elifdef", "template_declaration"),
    }
)

# The types of enumerations whose constants become an `int`.
_INTS = frozenset(["char", "int", "int8_t", "int16_t", "int32_t", "short", "uint8_t", "uint16_t"])


@dataclass(slots=True)
class Code:
    """All declarations of some files.

    `classes` has the first class of each name; `all_classes` has all of them, those inside of
    classes too. `statics` are static members with the values that stand outside of their class;
    `macros` those that take something. `constants` go by file and name, whatever their scope, and
    `disagreeing` constants are defined in several ways, or `initialised` by a constructor as well.
    """

    files: list[Cpp] = field(default_factory=list)
    all_classes: dict[str, list[CppClass]] = field(default_factory=dict)
    enumerators: dict[str, list[CppEnumerator]] = field(default_factory=dict)
    aliases: dict[str, list[CppAlias]] = field(default_factory=dict)
    variables: dict[str, list[CppField]] = field(default_factory=dict)
    statics: dict[tuple[str, str], CppField] = field(default_factory=dict)
    classes: dict[str, CppClass] = field(default_factory=dict)
    definitions: dict[tuple[str, str], list[CppFunction]] = field(default_factory=dict)
    constants: dict[tuple[str, str], tuple[Cpp, Node]] = field(default_factory=dict)
    disagreeing: set[tuple[str, str]] = field(default_factory=set)
    initialised: set[str] = field(default_factory=set)
    macros: dict[str, list[Node]] = field(default_factory=dict)
    _types: dict[int, tuple[str, ...]] = field(default_factory=dict)
    _visible: dict[str, dict[str, tuple[Cpp, Node]]] = field(default_factory=dict)
    _searches: Searches = field(default_factory=Searches)
    _parts: dict[int, Code] = field(default_factory=dict)
    _functions: dict[int, tuple[CppFunction, ...]] = field(default_factory=dict)

    @staticmethod
    def of(files: Iterable[Cpp]) -> Code:
        """The declarations of these files."""
        code = Code()
        for cpp in files:
            part_ = code._parts[id(cpp)] = Code([cpp], initialised=initialised_in(cpp))
            part_._add(cpp, cpp.root)
            code._take(part_)
        return code

    def view(self, files: Iterable[Cpp]) -> Code:
        """The declarations of some of its files, which are not read again."""
        code = Code(_types=self._types, _searches=self._searches, _parts=self._parts)
        for cpp in files:
            code._take(self._parts[id(cpp)])
        return code

    def _take(self, one: Code) -> None:
        """Adds the declarations of one more file."""
        self.files += one.files
        _append(self.all_classes, one.all_classes)
        _append(self.enumerators, one.enumerators)
        _append(self.aliases, one.aliases)
        _append(self.variables, one.variables)
        _append(self.macros, one.macros)
        _append(self.definitions, one.definitions)
        self.constants |= one.constants
        self.initialised |= one.initialised
        self.disagreeing |= one.disagreeing
        self.disagreeing |= {key for key in self.constants if key[1] in self.initialised}
        for name, class_ in one.classes.items():
            self.classes.setdefault(name, class_)
        self.statics |= {k: v for k, v in one.statics.items() if k not in self.statics}

    def lineage(self, name: str) -> list[CppClass]:
        """A class and those it descends from, as far as they are known, nearest first."""
        found: dict[str, CppClass] = {}
        waiting = [name]
        while waiting:
            current = self.classes.get(waiting.pop(0))
            if current is not None and current.name not in found:
                found[current.name] = current
                waiting += current.bases
        return list(found.values())

    def functions_of(self, owner: CppClass) -> tuple[CppFunction, ...]:
        """The functions of a class, with their bodies where these are known."""
        if owner.node.id not in self._functions:
            found = tuple(self._defined(declared) or declared for declared in owner.functions)
            self._functions[owner.node.id] = found
        return self._functions[owner.node.id]

    def file_of(self, node: Node) -> Cpp:
        """The file that a node is in: one of these, or of the code that this is a view of."""
        root = [node, *ancestors(node)][-1]
        files = (cpp for part_ in self._parts.values() for cpp in part_.files)
        return next(cpp for cpp in files if cpp.root == root)

    def inside(self, cpp: Cpp, node: Node | None, *types: str) -> list[Node]:
        """The nodes of some types in a node of a file: see `Searches`."""
        return self._searches.inside(cpp, node, *types)

    def calls_of(self, function: CppFunction) -> tuple[CppCall, ...]:
        """The calls in a function's body."""
        return self.calls_in(function.cpp, function.body) if function.body is not None else ()

    def calls_in(self, cpp: Cpp, body: Node) -> tuple[CppCall, ...]:
        """The calls in a body of a file, outer ones first, in the order of the text."""
        return self._searches.calls_in(cpp, body)

    def names_called(self, function: CppFunction) -> frozenset[str]:
        """The last names of what a function's body calls."""
        body = function.body
        return self._searches.names_called(function.cpp, body) if body is not None else frozenset()

    def named(self, cpp: Cpp, node: Node, names: Collection[str]) -> list[Node]:
        """The nodes in a node of a file that are some words, in the order of the text."""
        return self._searches.named(cpp, node, names)

    def handed_on(self, wanted: Collection[str]) -> frozenset[str]:
        """The names of functions that some code calls on an object, or hands on: the wanted."""
        files = (self._searches.handed_on(cpp, wanted) for cpp in self.files)
        return frozenset(wanted).intersection(*[frozenset[str]().union(*files)])

    def constant(self, cpp: Cpp, name: str) -> tuple[Cpp, Node] | None:
        """The value of a constant of a file."""
        key = cpp.source.path, name
        return self.constants.get(key) if key not in self.disagreeing else None

    def constants_for(self, cpp: Cpp) -> dict[str, tuple[Cpp, Node]]:
        """The constants that a file can name: what it and the headers define in one way only.

        Which scope's another one would be is not looked at.
        """
        if cpp.source.path not in self._visible:
            self._visible[cpp.source.path] = self._constants_for(cpp)
        return self._visible[cpp.source.path]

    def _constants_for(self, cpp: Cpp) -> dict[str, tuple[Cpp, Node]]:
        found: dict[str, tuple[Cpp, Node]] = {}
        differing = set(self.enumerators)
        for (path, name), value in self.constants.items():
            if path.endswith(_HEADERS) or path == cpp.source.path:
                before = found.setdefault(name, value)
                is_one = text_of(before[1]) == text_of(value[1])
                if not is_one or (path, name) in self.disagreeing:
                    differing.add(name)
        return {n: v for n, v in found.items() if n not in differing}

    def _agreed(self) -> dict[tuple[str, str], tuple[Cpp, Node]]:
        return {k: v for k, v in self.constants.items() if k not in self.disagreeing}

    def _add_constant(self, cpp: Cpp, name: Node, value: tuple[Cpp, Node]) -> None:
        key = cpp.source.path, text_of(name)
        if text_of(self.constants.setdefault(key, value)[1]) != text_of(value[1]):
            self.disagreeing.add(key)

    def _defined(self, declared: CppFunction) -> CppFunction | None:
        if declared.body is not None:
            return None
        found = self.definitions.get((declared.owner, declared.name), [])
        found = [f for f in found if len(f.parameters) == len(declared.parameters)]
        return next((f for f in found if self._types_of(f) == self._types_of(declared)), None)

    def _types_of(self, function: CppFunction) -> tuple[str, ...]:
        key = function.node.id
        if key not in self._types:
            self._types[key] = function.types
        return self._types[key]

    # --- collecting -----------------------------------------------------------------------------

    def _add(self, cpp: Cpp, node: Node) -> None:
        for child in node.named_children:
            match child.type:
                case "class_specifier" | "struct_specifier":
                    self._add_class(cpp, child)
                case "preproc_def":
                    self._add_macro(cpp, child)
                case "preproc_function_def":
                    name = text_of(child.children_by_field_name("name")[0])
                    self.macros.setdefault(name, []).append(child)
                case "enum_specifier":
                    self._add_enum(cpp, child, "")
                case "type_definition" | "alias_declaration":
                    self._add_aliases(cpp, child)
                case "function_definition":
                    self._add_function(cpp, child)
                case "declaration":
                    if only_braces(child):
                        self._add_function(cpp, child)
                    self._add_variables(cpp, child)
                case kind if kind in CONTAINERS:
                    self._add(cpp, child)

    def _add_function(self, cpp: Cpp, node: Node) -> None:
        if (function := function_of(cpp, node, "")) is not None:
            self.definitions.setdefault((function.owner, function.name), []).append(function)

    def _add_class(self, cpp: Cpp, node: Node, outer: str = "") -> None:
        name, body = node.child_by_field_name("name"), node.child_by_field_name("body")
        if name is None or body is None:
            return
        own = unscoped(name)
        fields: list[CppField] = []
        others: list[CppField] = []
        functions: list[CppFunction] = []
        for member in members_of(body):
            function = function_of(cpp, member, own)
            if function is not None:
                functions.append(function)
            elif member.type in ("type_definition", "alias_declaration"):
                self._add_aliases(cpp, member)
            elif member.type != "field_declaration":
                continue
            elif not self._add_nested(cpp, member, own) and is_constant(cpp, member):
                for declarator, value in valued(member):
                    self._add_constant(cpp, constant_name(member, declarator), (cpp, value))
                others += plain_fields(cpp, member, with_values(member))
            else:
                declared = with_values(member)
                fields += plain_fields(cpp, member, declared)
                others += other_fields(cpp, member, declared)
        read = CppClass(
            own,
            tuple(bases_of(node)),
            tuple(fields),
            tuple(functions),
            markers_above(node) if cpp.has_markers else (),
            cpp,
            node,
            tuple(others),
            outer,
            tuple(roots_of(node)),
        )
        self.all_classes.setdefault(own, []).append(read)
        if not outer:
            self.classes.setdefault(own, read)

    def _add_nested(self, cpp: Cpp, member: Node, outer: str) -> bool:
        """Takes the class or enumeration that a member declares, if it does."""
        type_ = member.child_by_field_name("type")
        if type_ is None or type_.type not in TYPES:
            return False
        if type_.type == "enum_specifier":
            self._add_enum(cpp, type_, outer)
        else:
            self._add_class(cpp, type_, outer)
        return True

    def _add_enum(self, cpp: Cpp, node: Node, scope: str) -> None:
        name, is_plain = node.child_by_field_name("name"), _is_of_int(node)
        known = KnownNumbers(self.enumerators, self._agreed(), cpp)
        for child, number in enumerated(node, known.of):
            own = text_of(part(child, "name"))
            value = number if is_plain else None
            read = CppEnumerator(own, text_of(name) if name else "", scope, value, cpp, child)
            self.enumerators.setdefault(own, []).append(read)

    def _add_type(self, cpp: Cpp, type_: Node) -> None:
        """A type that is defined where it is named."""
        if type_.type in ("class_specifier", "struct_specifier"):
            self._add_class(cpp, type_)
        elif type_.type == "enum_specifier":
            self._add_enum(cpp, type_, "")

    def _add_aliases(self, cpp: Cpp, node: Node) -> None:
        type_ = node.child_by_field_name("type")
        names = node.children_by_field_name("declarator") + node.children_by_field_name("name")
        if type_ is None:
            return
        self._add_type(cpp, type_)
        for name in names:
            if name.type == "type_identifier":
                read = CppAlias(text_of(name), type_, cpp)
                self.aliases.setdefault(read.name, []).append(read)

    def _add_variables(self, cpp: Cpp, node: Node) -> None:
        type_ = node.child_by_field_name("type")
        if type_ is None:
            return
        self._add_type(cpp, type_)
        constant = is_constant(cpp, node)
        for declarator in node.children_by_field_name("declarator"):
            value = None
            if declarator.type == "init_declarator":
                value, declarator = part(declarator, "value"), part(declarator, "declarator")
                if constant:
                    self._add_constant(cpp, constant_name(node, declarator), (cpp, value))
            if declarator.type == "qualified_identifier" and value is not None:
                self._add_static(cpp, node, declarator, value)
                continue
            name = declared_name(declarator)
            if name is not None:
                read = CppField(text_of(name), type_, value, (), cpp, node)
                self.variables.setdefault(read.name, []).append(read)

    def _add_static(self, cpp: Cpp, node: Node, declarator: Node, value: Node) -> None:
        """`int C::x = 3;`, outside of the class."""
        scope = ""
        while declarator.type == "qualified_identifier":
            above = declarator.child_by_field_name("scope")
            scope = unscoped(above) if above is not None else scope
            declarator = part(declarator, "name")
        read = CppField(text_of(declarator), part(node, "type"), value, (), cpp, node)
        self.statics.setdefault((scope, read.name), read)

    def _add_macro(self, cpp: Cpp, node: Node) -> None:
        """`#define LIMIT 8`: the text as an expression, if it is one."""
        name, text = node.child_by_field_name("name"), node.child_by_field_name("value")
        if name is None or text is None:
            return
        inside = parse(Source(cpp.source.path, f"const auto x = {text_of(text)};"))
        declaration = inside.root.named_children[0] if inside.root.named_children else None
        if declaration is None or inside.root.has_error or declaration.type != "declaration":
            return
        declarator = part(declaration, "declarator")
        if (value := declarator.child_by_field_name("value")) is not None:
            self._add_constant(cpp, name, (inside, value))


def _append(to: dict[_K, list[_V]], more: dict[_K, list[_V]]) -> None:
    for key, values in more.items():
        if (known := to.get(key)) is not None:
            known += values
        else:
            to[key] = [*values]


def _is_of_int(node: Node) -> bool:
    """Whether the constants of an enumeration are numbers of an `int` wherever one computes."""
    base = node.child_by_field_name("base")
    is_scoped = any(child.type in ("class", "struct") for child in node.children)
    return base is None or is_scoped or text_of(base).removeprefix("std::") in _INTS
