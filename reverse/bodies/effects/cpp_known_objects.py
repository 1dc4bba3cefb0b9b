"""Objects of C++ that are known by their declarations: of plain classes of the files, constants."""

from __future__ import annotations

import re
from functools import cached_property

from tree_sitter import Node

from rebsync.reverse.bodies.effects.cpp_form_places import FormPlaces
from rebsync.reverse.ir import types as t
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_calls import CppCall
from rebsync.reverse.syntax.cpp_declarations import CppField, CppFunction
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, part, text_of
from rebsync.reverse.values.cpp_flow import Texts

_CONSTANT = re.compile(r"(?:static\s+|inline\s+)*const(?:expr)?\s+std::")
_TYPE_NAMES = frozenset({"type_identifier", "namespace_identifier"})
_BRACKETS = ("array_declarator", "abstract_array_declarator")
_ALIASES = ("alias_declaration", "type_definition")
_NAMING = frozenset({"qualified_identifier", "template_type"})


class KnownObjects:
    """Finds what is known of an object by its type."""

    def __init__(self, code: Code, places: FormPlaces) -> None:
        self.code = code
        self.places = places

    @cached_property
    def _arrays(self) -> frozenset[str]:
        """The names that are declared with brackets; empty for a type that is one of arrays."""
        found = [n for cpp in self.code.files for n in inside(cpp.root, *_BRACKETS)]
        names = (n for each in found for n in inside(each, "identifier", "field_identifier"))
        is_aliased = any(above.type in _ALIASES for each in found for above in ancestors(each))
        return frozenset(map(text_of, names)) | ({""} if is_aliased else frozenset())

    def methods_meant(self, cpp: Cpp, call: CppCall) -> tuple[CppFunction, ...]:
        """The functions of a class of the files that a call on an object of it may mean.

        What a pointer leads to may be in other hands.
        """
        if call.target is None or any(c.type == "->" for c in part(call.node, "function").children):
            return ()
        return tuple(f for f in self.places.called(cpp, call.node) if f.name == call.name)

    def free_function(self, call: CppCall) -> CppFunction | None:
        """The one function outside of classes that a call by its name alone means."""
        found = self.code.definitions.get(("", call.name), ()) if call.target is None else ()
        return found[0] if len(found) == 1 and found[0].body is not None else None

    def is_constant(self, cpp: Cpp, node: Node) -> bool:
        """Whether it names a constant object of the standard library outside of classes."""
        variable = self.places.variable(cpp, node)
        around = (variable.declarator, *ancestors(variable.declarator)) if variable else ()
        declaration = next((n for n in around if n.type == "declaration"), None)
        return declaration is not None and _CONSTANT.match(text_of(declaration)) is not None

    def is_pointer(self, cpp: Cpp, node: Node) -> bool:
        """Whether an array is a pointer as a value: of all but those that are known for objects."""
        names = {text_of(n) for n in inside(node, "identifier", "field_identifier")}
        is_led_to = isinstance(self.places.type_of(cpp, node), t.Unknown | t.Reference)
        return is_led_to or not self._arrays.isdisjoint({"", *names})

    def is_type(self, name: str) -> bool:
        """Whether a name is used as that of a type, where no call could stand."""
        return name in self.code.all_classes or any(
            place.type in _TYPE_NAMES and not _is_called(place)
            for _, place in Texts(self.code).everywhere(name)
        )

    def fields_of(self, type_: str) -> tuple[CppField, ...]:
        """The variables of the one class of a name."""
        return self.code.all_classes[type_][0].fields

    def is_aggregate(self, type_: str) -> bool:
        """Whether objects of a class of the files are made of copies of what stands in braces."""
        found = self.code.all_classes.get(type_, [])
        if len(found) != 1 or found[0].bases or found[0].roots or found[0].others:
            return False
        return not any(f.name in (type_, f"~{type_}") for f in found[0].functions)


def _is_called(place: Node) -> bool:
    """Whether a name may be called, though the grammar takes it for a type: `T x(name());`."""
    above = place.parent
    while above is not None and above.type in _NAMING:
        above = above.parent
    around = above.child_by_field_name("declarator") if above is not None else None
    return around is not None and around.type == "abstract_function_declarator"
