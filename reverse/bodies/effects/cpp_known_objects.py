"""Objects of C++ that are known by their declarations: of plain classes of the files, constants."""

from __future__ import annotations

import re

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_calls import CppCall
from rebsync.reverse.syntax.cpp_declarations import CppField, CppFunction
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import Cpp, text_of
from rebsync.reverse.values.cpp_static_types import StaticTypes

_CONSTANT = re.compile(r"(?:static\s+|inline\s+)*const(?:expr)?\s+std::")


@dataclass(frozen=True, slots=True)
class KnownObjects:
    """Finds what is known of an object by its type."""

    code: Code
    statics: StaticTypes

    def methods_meant(self, cpp: Cpp, call: CppCall) -> tuple[CppFunction, ...]:
        """The functions of a class of the files that a call on an object of it may mean."""
        if call.target is None:
            return ()
        owner = self.statics.class_of(self.statics.of(cpp, call.target))
        found = self.code.functions_of(owner) if owner is not None else ()
        return tuple(f for f in found if f.name == call.name)

    def free_function(self, call: CppCall) -> CppFunction | None:
        """The one function outside of classes that a call by its name alone means."""
        found = self.code.definitions.get(("", call.name), ()) if call.target is None else ()
        return found[0] if len(found) == 1 and found[0].body is not None else None

    def is_constant(self, cpp: Cpp, node: Node) -> bool:
        """Whether it names a constant object of the standard library outside of classes."""
        variable = self.statics.variable(cpp, node)
        if variable is None or variable.kind != "global" or variable.owner is not None:
            return False
        around = (variable.name, *ancestors(variable.name))
        declaration = next((n for n in around if n.type == "declaration"), None)
        return declaration is not None and _CONSTANT.match(text_of(declaration)) is not None

    def is_pointer(self, cpp: Cpp, node: Node) -> bool:
        """Whether an array is a pointer as a value: of all but those that are known for objects."""
        type_ = self.statics.of(cpp, node)
        return type_ is None or type_.pointers > 0

    def fields_of(self, type_: str) -> tuple[CppField, ...]:
        """The variables of the one class of a name."""
        return self.code.all_classes[type_][0].fields

    def is_aggregate(self, type_: str) -> bool:
        """Whether objects of a class of the files are made of copies of what stands in braces."""
        found = self.code.all_classes.get(type_, [])
        if len(found) != 1 or found[0].bases or found[0].roots or found[0].others:
            return False
        return not any(f.name in (type_, f"~{type_}") for f in found[0].functions)
