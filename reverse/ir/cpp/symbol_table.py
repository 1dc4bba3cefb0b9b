"""Name lookup: which class, function, variable or type a name means in a scope."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import TypeAlias

from tree_sitter import Node

from rebsync.reverse.ir.cpp.collecting import Collected, Declaration, symbol_of
from rebsync.reverse.ir.cpp.symbols import (
    AliasSymbol,
    ClassSymbol,
    EnumSymbol,
    FunctionSymbol,
    VariableSymbol,
    joined,
    outward,
)
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import text_of

TypeSymbol: TypeAlias = ClassSymbol | EnumSymbol | AliasSymbol


class SymbolTable:
    """The entities of some code by their full names.

    A name that two files give to things of their own means none of them (`None` in `types`), but
    for functions, whose overloads are looked through by their users.
    """

    def __init__(self, code: Code) -> None:
        self.code = code
        collected = Collected()
        for cpp in code.files:
            collected.add(cpp)
        self.imports = collected.imports
        self.names = collected.names
        self.spaces = collected.spaces
        self.own_spaces = collected.own_spaces
        self.forward = frozenset(collected.forward)
        self.classes: dict[str, ClassSymbol] = {}
        self.types: dict[str, TypeSymbol | None] = {}
        declared: list[TypeSymbol] = [*collected.classes, *collected.enums, *collected.aliases]
        for found in declared:
            self._add_type(found)
        self.variables: dict[str, list[VariableSymbol]] = {}
        for variable in collected.variables:
            self.variables.setdefault(variable.name, []).append(variable)
        self.enumerators: dict[str, list[tuple[EnumSymbol, str]]] = {}
        for enum in collected.enums:
            self._add_enumerators(enum)
        self.functions: dict[str, FunctionSymbol] = {}
        self.overloads: dict[str, list[FunctionSymbol]] = {}
        self._add_functions(collected.functions)

    def _add_type(self, found: TypeSymbol) -> None:
        known = self.types.get(found.name, found)
        same = known is found or (
            known is not None and text_of(known_node(known)) == text_of(known_node(found))
        )
        if not same:
            self.types[found.name] = None
        elif known is found:
            self.types[found.name] = found
            if isinstance(found, ClassSymbol):
                self.classes[found.name] = found

    def _add_enumerators(self, enum: EnumSymbol) -> None:
        body = enum.node.child_by_field_name("body")
        scopes = [enum.name] if enum.is_scoped else [enum.name, enum.scope]
        for child in body.named_children if body is not None else ():
            name = child.child_by_field_name("name") if child.type == "enumerator" else None
            if name is not None:
                for scope in scopes:
                    full = joined(scope, text_of(name))
                    self.enumerators.setdefault(full, []).append((enum, text_of(name)))

    # --- functions ------------------------------------------------------------------------------

    def _add_functions(self, declarations: Iterable[Declaration]) -> None:
        groups: dict[tuple[str, tuple[str, ...], bool], list[Declaration]] = {}
        for each in declarations:
            each = self._with_owner(each)
            key = joined(each.scope, each.code.name), _signature(each), "const" in each.words
            groups.setdefault(key, []).append(each)
        names = [full for full, _, _ in groups]
        for (full, signature, _), group in groups.items():
            for defined in self._definitions(group):
                name = full if names.count(full) == 1 else f"{full}({', '.join(signature)})"
                self._add_function(name, full, group, defined)

    def _with_owner(self, each: Declaration) -> Declaration:
        """A qualified name that is a class's is of a member; it may be looked up outwards."""
        if each.owner is None or each.owner in self.classes:
            return each
        names = self.candidates(each.owner, "", each.code.cpp.source.path)
        owner = next((name for name in names if name in self.classes), None)
        return replace(each, owner=owner, scope=each.scope if owner is None else owner)

    def _definitions(self, group: list[Declaration]) -> list[Declaration]:
        """The bodies of a function: one, or one for each file that has its own."""
        bodies = {d.code.cpp.source.path: d for d in group if d.code.body is not None}
        return list(bodies.values()) or group[:1]

    def _add_function(
        self, name: str, full: str, group: list[Declaration], defined: Declaration
    ) -> None:
        if name in self.functions:
            name = (
                f"{name} in {defined.code.cpp.source.path}:{defined.code.node.start_point.row + 1}"
            )
        symbol = symbol_of(name, tuple(group), defined)
        self.functions[name] = symbol
        owner = self.classes.get(symbol.owner or "")
        if owner is not None:
            owner.functions.append(symbol)
        else:
            self.overloads.setdefault(full, []).append(symbol)

    # --- lookup ---------------------------------------------------------------------------------

    def candidates(self, name: str, scope: str, path: str) -> Iterator[str]:
        """The full names that a name may have, nearest first."""
        name = "".join(name.split())
        if name.startswith("::"):
            yield name[2:]
            return
        for outer in outward(scope):
            yield joined(outer, name)
            if outer in self.classes:
                for base in self.lineage(outer)[1:]:
                    yield joined(base.name, name)
        head, _, rest = name.partition("::")
        declared = self.names.get(path, {}).get(head)
        if declared is not None:
            yield f"{declared}::{rest}" if rest else declared
        for space in self.imports.get(path, ()):
            yield joined(space, name)
            for outer in outward(scope):
                yield joined(joined(outer, space), name)

    def type_named(self, name: str, scope: str, path: str) -> TypeSymbol | None:
        """The type that a name means."""
        for full in self.candidates(name, scope, path):
            if full in self.types:
                return self.types[full]
        return None

    def variable_named(self, name: str, scope: str, path: str) -> VariableSymbol | None:
        """The variable that a name means; that of the same file first."""
        for full in self.candidates(name, scope, path):
            found = self.variables.get(full, [])
            own = [v for v in found if v.cpp.source.path == path]
            if found:
                return (own or found)[-1] if len(found) == 1 or own else None
        return None

    def enumerator_named(self, name: str, scope: str, path: str) -> tuple[EnumSymbol, str] | None:
        """The enumeration and enumerator that a name means."""
        for full in self.candidates(name, scope, path):
            found = self.enumerators.get(full, [])
            if found:
                return found[0] if len(found) == 1 else None
        return None

    def functions_named(self, name: str, scope: str, path: str) -> list[FunctionSymbol]:
        """The free functions that a name may mean: the overloads of the nearest scope."""
        for full in self.candidates(name, scope, path):
            found = self.overloads.get(full, [])
            own = [f for f in found if f.code.cpp.source.path == path]
            if found:
                return own if own and len(own) < len(found) else found
        return []

    # --- classes --------------------------------------------------------------------------------

    def bases(self, owner: ClassSymbol) -> list[tuple[str, ClassSymbol | None]]:
        """The bases of a class by their names in the source, with those of the program."""
        found: list[tuple[str, ClassSymbol | None]] = []
        for name in owner.bases:
            type_: TypeSymbol | None = None
            for outer in outward(owner.scope):
                type_ = self.types.get(joined(outer, name)) or type_
                if type_ is not None:
                    break
            found.append((name, type_ if isinstance(type_, ClassSymbol) else None))
        return found

    def lineage(self, name: str) -> list[ClassSymbol]:
        """A class and those it descends from that the program has, nearest first."""
        found: dict[str, ClassSymbol] = {}
        waiting = [name]
        while waiting:
            current = self.classes.get(waiting.pop(0))
            if current is not None and current.name not in found:
                found[current.name] = current
                waiting += [b.name for _, b in self.bases(current) if b is not None]
        return list(found.values())

    def descends(self, name: str, base: str) -> bool:
        """Whether a class is another or descends from it."""
        return any(c.name == base for c in self.lineage(name))


def known_node(symbol: TypeSymbol) -> Node:
    """The node that tells whether two declarations are one."""
    return symbol.type if isinstance(symbol, AliasSymbol) else symbol.node


def _signature(declaration: Declaration) -> tuple[str, ...]:
    """The parameters' types as text, with what tells references and pointers apart."""
    found: list[str] = []
    for parameter, type_ in zip(declaration.code.parameters, declaration.code.types, strict=True):
        declarator = parameter.node.child_by_field_name("declarator")
        marks = (
            "".join(c for c in text_of(declarator).partition("(")[0] if c in "&*")
            if declarator
            else ""
        )
        is_const = bool(marks) and "const" in text_of(parameter.node).split()
        found.append(f"{'const ' * is_const}{type_}{marks}")
    return tuple(found)
