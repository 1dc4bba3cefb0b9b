"""The entities that C++ files declare, by their full names."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.syntax.cpp_declarations import CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, named, text_of


@dataclass(frozen=True, slots=True, eq=False)
class VariableSymbol:
    """A variable of a namespace, or a static member; `value` is its initialiser, if it has one."""

    name: str
    type: Node
    declarator: Node
    value: Node | None
    cpp: Cpp
    scope: str


@dataclass(frozen=True, slots=True, eq=False)
class FieldSymbol:
    """A member variable in the order of declaration; `bits` is the width of a bit-field."""

    name: str
    type: Node
    declarator: Node
    value: Node | None
    cpp: Cpp
    is_static: bool = False
    bits: Node | None = None


@dataclass(frozen=True, slots=True, eq=False)
class FunctionSymbol:
    """A function under its unique name; `scope` is where names in it are looked up from.

    `default` and `deleted` are `= default` and `= delete`; `declarations` are all that declare it.
    """

    name: str
    simple: str
    scope: str
    owner: str | None
    code: CppFunction
    declarations: tuple[CppFunction, ...]
    is_static: bool = False
    is_virtual: bool = False
    is_const: bool = False
    is_explicit: bool = False
    is_default: bool = False
    is_deleted: bool = False
    is_template: bool = False
    converts_to: Node | None = None


@dataclass(frozen=True, slots=True, eq=False)
class EnumSymbol:
    """An enumeration; `is_scoped` is `enum class`. `node` has its base and enumerators."""

    name: str
    is_scoped: bool
    node: Node
    cpp: Cpp
    scope: str


@dataclass(frozen=True, slots=True, eq=False)
class AliasSymbol:
    """Another name for a type, with the declarator that a typedef may have."""

    name: str
    type: Node
    declarator: Node | None
    cpp: Cpp
    scope: str


@dataclass(frozen=True, slots=True, eq=False)
class ClassSymbol:
    """A class with a body. `bases` are texts of the source, looked up from `scope`."""

    name: str
    scope: str
    node: Node
    cpp: Cpp
    bases: tuple[str, ...]
    fields: tuple[FieldSymbol, ...]
    is_template: bool = False
    is_union: bool = False
    functions: list[FunctionSymbol] = field(default_factory=list)

    @property
    def simple(self) -> str:
        """The last part of its name, which constructors have."""
        return self.name.rpartition("::")[2]

    @property
    def constructors(self) -> list[FunctionSymbol]:
        """Its constructors, deleted ones included."""
        return [f for f in self.functions if f.simple == self.simple]

    @property
    def destructor(self) -> FunctionSymbol | None:
        """Its destructor, if the source declares one."""
        return next((f for f in self.functions if f.simple.startswith("~")), None)


def joined(scope: str, name: str) -> str:
    """A name in a scope."""
    return "::".join(filter(None, (scope, name)))


def outward(scope: str) -> Iterator[str]:
    """A scope and those around it, the innermost first, the global one last."""
    while scope:
        yield scope
        scope = scope.rpartition("::")[0]
    yield ""


def base_names(node: Node) -> Iterator[str]:
    """The texts of the bases of a class, without the arguments of templates."""
    for clause in node.named_children:
        if clause.type == "base_class_clause":
            for base in named(clause):
                if base.type in ("type_identifier", "qualified_identifier", "template_type"):
                    yield "".join(text_of(base).split()).partition("<")[0]
