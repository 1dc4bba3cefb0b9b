"""Where names stand in C++ code, and what stands around them: searched for only when asked.

A name is found in the text first and then looked up in the tree, so that nobody walks whole trees.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator
from dataclasses import field
from functools import lru_cache

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.syntax.ancestors import ancestors, climb
from rebsync.reverse.syntax.cpp_declarations import CppAlias, unscoped
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction, function_of
from rebsync.reverse.syntax.cpp_tree import Cpp, part, text_of, unqualified
from rebsync.reverse.syntax.cpp_words import places_of

# Macros of tests that make a member function of the class they name first.
FIXTURES = frozenset({"TEST_F", "TEST_P", "TYPED_TEST"})
# How many functions may stand within one another, in classes inside of functions.
_NESTED = 12
_NAMES = frozenset(
    {"identifier", "field_identifier", "type_identifier", "namespace_identifier", "this"}
)
_DECLARATORS = frozenset(
    {
        *("pointer_declarator", "reference_declarator", "array_declarator"),
        *("parenthesized_declarator", "init_declarator", "function_declarator"),
    }
)
_DECLARATIONS = frozenset(
    {
        *("declaration", "parameter_declaration", "optional_parameter_declaration"),
        "for_range_loop",
    }
)
# What stands around a name that is used: most of them.
_USES = frozenset(
    {
        *("field_expression", "call_expression", "argument_list", "assignment_expression"),
        *("binary_expression", "pointer_expression", "subscript_expression", "field_initializer"),
    }
)
_SCOPES = frozenset(
    {
        *("compound_statement", "for_statement", "for_range_loop", "if_statement"),
        *("while_statement", "switch_statement", "lambda_expression", "function_definition"),
        *("catch_clause", "translation_unit", "declaration_list"),
    }
)


@dataclass(slots=True)
class Texts:
    """Finds names in the files of some code, and the functions and classes around places."""

    code: Code
    _found: dict[tuple[int, str], list[Node]] = field(default_factory=dict)
    _everywhere: dict[str, list[tuple[Cpp, Node]]] = field(default_factory=dict)
    _functions: dict[int, CppFunction] | None = None
    _ranges: dict[int, tuple[list[int], list[tuple[int, int, CppFunction]]]] | None = None
    _starts: dict[tuple[int, str], list[int]] = field(default_factory=dict)
    _lineages: dict[int, list[CppClass]] = field(default_factory=dict)
    _descendants: dict[int, list[CppClass]] = field(default_factory=dict)
    _classes: dict[int, CppClass | None] = field(default_factory=dict)
    _homes: dict[int, CppFunction | None] = field(default_factory=dict)
    _other_names: dict[str, list[str]] | None = None

    def named(self, cpp: Cpp, name: str) -> list[Node]:
        """All places of a file where a name stands in the code."""
        key = id(cpp), name
        if key not in self._found:
            self._found[key] = list(self._search(cpp, name.encode()))
            self._starts[key] = [n.start_byte for n in self._found[key]]
        return self._found[key]

    def within(self, cpp: Cpp, name: str, start: int, end: int) -> list[Node]:
        """The places between two bytes of a file where a name stands."""
        found = self.named(cpp, name)
        starts = self._starts[id(cpp), name]
        return found[bisect_left(starts, start) : bisect_left(starts, end)]

    def everywhere(self, name: str) -> list[tuple[Cpp, Node]]:
        """All places of all files where a name stands."""
        if name not in self._everywhere:
            word = name.encode()
            holders = [c for c in self.code.files if word in c.words or not name.isascii()]
            self._everywhere[name] = [(c, n) for c in holders for n in self.named(c, name)]
        return self._everywhere[name]

    def _search(self, cpp: Cpp, name: bytes) -> Iterator[Node]:
        for at in places_of(cpp.original, name):
            node = cpp.root.descendant_for_byte_range(at, at + len(name))
            if node is not None and node.type in _NAMES and node.start_byte == at:
                yield node

    # --- around a place -------------------------------------------------------------------------

    def function_around(self, cpp: Cpp, node: Node) -> CppFunction | None:
        """The function in whose definition a node stands; lambdas are part of it."""
        found = self._function_at(cpp, node.start_byte)
        if found is not None:
            return found if node != found.node else None
        home = climb(node, lambda n: n.type == "function_definition")
        if home is None:
            return None
        if home.id not in self._homes:
            known = self.functions().get(home.id)
            if known is None:
                class_ = self.class_node_around(home)
                name = class_.child_by_field_name("name") if class_ is not None else None
                known = function_of(cpp, home, unscoped(name) if name is not None else "")
            self._homes[home.id] = known
        return self._homes[home.id]

    def _function_at(self, cpp: Cpp, at: int) -> CppFunction | None:
        """The innermost function of the index around a byte."""
        if self._ranges is None:
            self._ranges = {}
            ranges: dict[int, list[tuple[int, int, CppFunction]]] = {}
            for function in self.functions().values():
                if (node := function.node).type == "function_definition":
                    span = node.start_byte, node.end_byte, function
                    ranges.setdefault(id(function.cpp), []).append(span)
            for key, spans in ranges.items():
                spans.sort(key=lambda s: s[:2])
                self._ranges[key] = [s[0] for s in spans], spans
        starts, spans = self._ranges.get(id(cpp), ([], []))
        index = bisect_right(starts, at) - 1
        for back in range(index, max(index - _NESTED, -1), -1):
            if spans[back][0] <= at < spans[back][1]:
                return spans[back][2]
        return None

    def functions(self) -> dict[int, CppFunction]:
        """The functions of all files by their nodes."""
        if self._functions is None:
            found = {}
            for definitions in self.code.definitions.values():
                found.update({f.node.id: f for f in definitions})
            for classes in self.code.all_classes.values():
                found.update({f.node.id: f for c in classes for f in c.functions})
            self._functions = found
        return self._functions

    def class_node_around(self, node: Node) -> Node | None:
        """The class in whose body a node stands."""
        return climb(node, lambda n: n.type in ("class_specifier", "struct_specifier"))

    def class_near(self, name: str, cpp: Cpp) -> CppClass | None:
        """The class that a file means by a name: of several, the nearest."""
        found = self.code.all_classes.get(name)
        if not found:
            found = self._by_other_name(name)
        if not found:
            return None
        return found[0] if len(found) == 1 else max(found, key=lambda c: nearness(c.cpp, cpp))

    def _by_other_name(self, name: str) -> list[CppClass]:
        """The classes that `using name = type` and the like give another name."""
        seen = {name}
        while (known := self.code.aliases.get(name)) and not self.code.all_classes.get(name):
            name = _last_name(known[0].type)
            if name in seen:
                return []
            seen.add(name)
        return self.code.all_classes.get(name, []) if len(seen) > 1 else []

    def renamed(self, cpp: Cpp, name: Node) -> CppAlias | None:
        """The declaration that gives a type the name that a file has for it: the nearest."""
        text = text_of(unqualified(name))
        aliases = self.code.aliases.get(text)
        if not aliases or text in self.code.all_classes:
            return None
        best = max(aliases, key=lambda a: nearness(a.cpp, cpp))
        return best if best.type.id != name.id else None

    def pointed_to(self, name: str) -> str | None:
        """The class whose pointers have a name as generated messages do: `ImageConstPtr`."""
        for ending in ("ConstPtr", "Ptr"):
            if name.endswith(ending) and name.removesuffix(ending) in self.code.all_classes:
                return name.removesuffix(ending)
        return None

    def names(self, class_: CppClass) -> list[str]:
        """The name of a class and the other names for it."""
        if self._other_names is None:
            self._other_names = {}
            for alias in self.code.aliases:
                if alias not in self.code.all_classes and (found := self._by_other_name(alias)):
                    self._other_names.setdefault(found[0].name, []).append(alias)
        return [class_.name, *self._other_names.get(class_.name, ())]

    def class_of(self, function: CppFunction | None) -> CppClass | None:
        """The class that a function is a member of."""
        if function is None:
            return None
        if function.node.id not in self._classes:
            self._classes[function.node.id] = self._class_of(function)
        return self._classes[function.node.id]

    def _class_of(self, function: CppFunction) -> CppClass | None:
        if function.name in FIXTURES and function.parameters:
            return self.class_near(text_of(function.parameters[0].type), function.cpp)
        if not function.owner:
            return None
        around = self.class_node_around(function.node)
        if around is not None:
            for class_ in self.code.all_classes.get(function.owner, []):
                if class_.node.id == around.id:
                    return class_
        return self.class_near(function.owner, function.cpp)

    def lineage(self, class_: CppClass | None) -> list[CppClass]:
        """A class and those it descends from, nearest first."""
        if class_ is None:
            return []
        key = class_.node.id
        if key not in self._lineages:
            found: dict[int, CppClass] = {}
            waiting = [class_]
            while waiting:
                current = waiting.pop(0)
                if current.node.id not in found:
                    found[current.node.id] = current
                    above = [self.class_near(b, current.cpp) for b in current.bases]
                    waiting += [c for c in above if c is not None]
            self._lineages[key] = list(found.values())
        return self._lineages[key]

    def giving(self, class_: CppClass | None, name: str) -> CppFunction | None:
        """The method of a class, or of those it descends from, whose result is declared."""
        functions = (f for c in self.lineage(class_) for f in c.functions)
        return next((f for f in functions if f.name == name and f.result is not None), None)

    def descendants(self, class_: CppClass) -> list[CppClass]:
        """The classes that descend from a class."""
        key = class_.node.id
        if key not in self._descendants:
            every = [c for classes in self.code.all_classes.values() for c in classes if c.bases]
            below = [c for c in every if c is not class_]
            self._descendants[key] = [
                c for c in below if any(above is class_ for above in self.lineage(c))
            ]
        return self._descendants[key]


def nearness(one: Cpp, other: Cpp) -> tuple[int, int]:
    """How near two files are: the folders they share; a file is nearest to itself."""
    return _near(one.source.path, other.source.path)


@lru_cache(maxsize=1 << 14)  # few files are compared often
def _near(one: str, other: str) -> tuple[int, int]:
    if one == other:
        return (1000, 0)
    left, right = one.split("/")[:-1], other.split("/")[:-1]
    shared = 0
    while shared < min(len(left), len(right)) and left[shared] == right[shared]:
        shared += 1
    return shared, -len(left)


def _last_name(type_: Node) -> str:
    """The name of a type without its scope and the arguments of its template."""
    while type_.type in ("type_descriptor", "qualified_identifier", "template_type"):
        inner = type_.child_by_field_name("type" if type_.type == "type_descriptor" else "name")
        if inner is None:
            return ""
        type_ = inner
    return text_of(type_)


# --- declarations of variables ------------------------------------------------------------------


def declaration_of(name: Node) -> Node | None:
    """The declaration that a name is declared by as a variable, if it is."""
    below, above = name, name.parent
    if above is None or above.type in _USES:
        return None
    while above is not None and (above.type in _DECLARATORS or _of_pointer(above)):
        if above.type in ("init_declarator", "function_declarator") and (
            part(above, "declarator") != below
        ):
            return None
        below, above = above, above.parent
    if above is None or above.type not in _DECLARATIONS or below not in _declarators(above):
        return None
    if below.type == "function_declarator" and not _makes(above, below):
        return None
    return above


def _of_pointer(node: Node) -> bool:
    """Whether a node is the `C::*f` of a pointer to a method."""
    if node.type == "pointer_type_declarator":
        return True
    above = node.parent
    return (
        node.type == "qualified_identifier"
        and above is not None
        and above.type == "parenthesized_declarator"
    )


def _declarators(declaration: Node) -> list[Node]:
    return declaration.children_by_field_name("declarator")


def _makes(declaration: Node, declarator: Node) -> bool:
    """Whether `C c(x)` in a body makes an object: the grammar takes it for a function."""
    around = declaration.parent
    if around is None or around.type not in ("compound_statement", "case_statement"):
        return False
    given = part(declarator, "parameters").named_children
    return bool(given) and all(p.child_by_field_name("declarator") is None for p in given)


def made_of(name: Node) -> tuple[Node, ...] | None:
    """The arguments that a declared variable is made of; None where it is given none."""
    for above in ancestors(name, lambda n: n.type not in _DECLARATORS and not _of_pointer(n)):
        if above.type == "function_declarator" and not is_pointer(above):
            found = [
                p.child_by_field_name("type") for p in part(above, "parameters").named_children
            ]
            return tuple(f for f in found if f is not None)
        if above.type == "init_declarator":
            value = part(above, "value")
            if value.type in ("argument_list", "initializer_list"):
                return tuple(n for n in value.named_children if n.type != "comment")
            return (value,)
    return None


def is_pointer(declarator: Node) -> bool:
    """Whether a function's declarator is that of a pointer to one."""
    return part(declarator, "declarator").type == "parenthesized_declarator"


def scope_of(declaration: Node) -> Node | None:
    """The piece of code in which what is declared can be named."""
    if declaration.type == "for_range_loop":
        return declaration
    return climb(declaration, lambda n: n.type in _SCOPES)
