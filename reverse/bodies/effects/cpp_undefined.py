"""What files declare and do not define: functions, methods, operators, classes, and bases."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from functools import cached_property

from tree_sitter import Node

from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_declarations import CppFunction, function_of
from rebsync.reverse.syntax.cpp_index import CONTAINERS, Code, CppClass
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, named, part, text_of
from rebsync.reverse.values.cpp_flow import Texts

# Bases of nodes that are the client libraries' own, or have no functions to be called.
_PLAIN_BASES = frozenset({"Nodelet", "Node", "LifecycleNode", "noncopyable"})
_PLAIN_BASES |= {"enable_shared_from_this"}
_SCOPES = ("namespace_definition", "class_specifier", "struct_specifier")
ALLOCATING = frozenset({"operator new", "operator new[]", "operator delete", "operator delete[]"})
# Classes of the standard library by which containers keep their elements apart.
_COMPARING = ("hash", "less", "greater", "less_equal", "greater_equal", "equal_to")
_FUNCTION = ("function_definition",)
_ARGUMENTS = re.compile(r"<[^<>]*>")
_WITHOUT_BODY = frozenset({"default_method_clause", "delete_method_clause"})


class Undefined:
    """What some code declares without a definition."""

    def __init__(self, code: Code, texts: Texts) -> None:
        self.code = code
        self.texts = texts

    def lacks_body(self, owner: CppClass, name: str) -> bool:
        """Whether a class declares more functions of a name than the files define."""
        declared = [f for f in owner.functions if f.name == name]
        open_ = [f for f in declared if f.body is None and not is_defaulted(f)]
        apart = self.code.definitions.get((owner.name, name), ())
        if len(self.code.all_classes.get(owner.name, ())) > 1:
            path = (*_scopes_around(owner.node), owner.name)
            apart = [f for f in apart if _scopes_of(f) == path]
        return len(open_) > len(apart)

    def lacks_override(self, owner: CppClass, name: str) -> bool:
        """Whether a class says that it has a function of a name, and the files do not define it."""
        is_own = any(f.name == name and not f.pure for f in owner.functions)
        return is_own and self.lacks_body(owner, name)

    def unread_bases(self, owner: CppClass) -> frozenset[str]:
        """The classes that a class descends from that no file has, and that no table knows."""
        found = set()
        for class_ in self.texts.lineage(owner):
            for base in _bases(class_):
                last = base.partition("<")[0].rpartition("::")[2]
                is_read = self.texts.class_near(last, class_.cpp) is not None
                if not (is_read or last in _PLAIN_BASES or is_library(base)):
                    found.add(last)
        return frozenset(found)

    # --- what the files declare -----------------------------------------------------------------

    @cached_property
    def _top(self) -> list[tuple[Cpp, Node]]:
        """What stands outside of functions and classes."""
        found: list[tuple[Cpp, Node]] = []
        waiting = [(cpp, cpp.root) for cpp in self.code.files]
        while waiting:
            cpp, node = waiting.pop()
            for child in node.named_children:
                (waiting if child.type in CONTAINERS else found).append((cpp, child))
        return found

    @cached_property
    def defined(self) -> frozenset[str]:
        """The names of functions that have a body."""
        return frozenset(name for _, name in self.code.definitions)

    @cached_property
    def declared(self) -> frozenset[str]:
        """The functions outside of classes that are only declared."""
        nodes = [(cpp, node) for cpp, node in self._top if node.type == "declaration"]
        nodes += [(cpp, n) for cpp in self.code.files for n in _declared_inside(cpp)]
        found = (function_of(cpp, node, "") for cpp, node in nodes)
        return frozenset(f.name for f in found if f is not None and not self._is_defined(f))

    def _is_defined(self, function: CppFunction) -> bool:
        """Whether one of these has a body: overloads by the number of what they take."""
        count, path = _taken(function), _scopes_of(function)
        bodies = self.bodies.get(function.name, ())
        return any(_taken(f) == count and _scopes_of(f) == path for f in bodies)

    @cached_property
    def bodies(self) -> dict[str, list[CppFunction]]:
        """The functions with a body, by their names; friends that classes define too."""
        found: dict[str, list[CppFunction]] = {}
        for function in _friends(self.code):
            found.setdefault(function.name, []).append(function)
        for (_, name), functions in self.code.definitions.items():
            found.setdefault(name, []).extend(functions)
        return found

    @cached_property
    def forward(self) -> frozenset[str]:
        """The classes that are declared without their members, with and without their scopes."""
        kinds = ("class_specifier", "struct_specifier")
        found = [node for _, node in self._top if node.type in kinds]
        names = [(n, text_of(name)) for n in found if (name := n.child_by_field_name("name"))]
        every = [c for classes in self.code.all_classes.values() for c in classes]
        read = {(*_scopes_around(c.node), c.name) for c in every}
        paths = {(*_scopes_around(node), name) for node, name in names} - read
        plain = {name for _, name in names} - self.code.all_classes.keys()
        return frozenset(plain.union("::".join(p) for p in paths if len(p) > 1))

    def is_forward(self, name: str) -> bool:
        """Whether a class that is named with its scope is one that is only declared."""
        plain = name.removeprefix("::")
        return any(f == plain or f.endswith(f"::{plain}") for f in self.forward)

    @cached_property
    def undefined(self) -> frozenset[str]:
        """The names of methods of which a class has no body, and of functions that are members."""
        every = [c for classes in self.code.all_classes.values() for c in classes]
        lacking = {f.name for c in every for f in c.functions if self.lacks_body(c, f.name)}
        return frozenset(lacking)

    @cached_property
    def has_undefined(self) -> bool:
        """Whether to make or end objects of some class runs what has no body."""
        return any(
            map(self.is_made_unread, (c for each in self.code.all_classes.values() for c in each))
        )

    def is_made_unread(self, owner: CppClass) -> bool:
        """Whether to make or end an object of a class runs what has no body, its parts apart."""
        if any(self.lacks_body(owner, n) for n in (owner.name, f"~{owner.name}", *ALLOCATING)):
            return True
        made = (p.node for f in owner.functions if f.name == owner.name for p in f.parameters)
        defaults = (p.child_by_field_name("default_value") for p in made)
        fields = (f.value for f in (*owner.fields, *owner.others))
        values = (value for value in (*fields, *defaults) if value is not None)
        return bool(self.declared) and any(
            text_of(part(call, "function")) in self.declared
            for value in values
            for call in inside(value, "call_expression")
        )

    @cached_property
    def operators(self) -> frozenset[str]:
        """The operators that lack a body."""
        names = self.undefined | self.declared
        return frozenset(n for n in names if n.startswith("operator"))

    @cached_property
    def compares_unread(self) -> bool:
        """Whether a specialisation of what compares or hashes elements lacks a body."""
        classes = (c for name in _COMPARING for c in self.code.all_classes.get(name, ()))
        return any(self.lacks_body(c, "operator()") for c in classes)


def _friends(code: Code) -> Iterator[CppFunction]:
    """The functions that classes declare as friends, and define."""
    for cpp in code.files:
        for each in inside(cpp.root, "friend_declaration") if b"friend" in cpp.words else ():
            found = (function_of(cpp, n, "") for n in named(each) if n.type in _FUNCTION)
            yield from (f for f in found if f is not None)


def _declared_inside(cpp: Cpp) -> Iterator[Node]:
    """Declarations in classes, of friends, and in functions, of what is elsewhere."""
    if b"friend" in cpp.words:
        for each in inside(cpp.root, "friend_declaration"):
            yield from (n for n in named(each) if n.type == "declaration")
    if b"extern" in cpp.words:
        for each in inside(cpp.root, "declaration"):
            if any(text_of(c) == "extern" for c in each.named_children):
                yield each


def _scopes_around(node: Node, kinds: Collection[str] = _SCOPES) -> tuple[str, ...]:
    """The namespaces and classes that a node stands in, the outermost first."""
    names = (n.child_by_field_name("name") for n in ancestors(node) if n.type in kinds)
    return tuple(p for n in reversed([*names]) if n is not None for p in text_of(n).split("::"))


def _scopes_of(function: CppFunction) -> tuple[str, ...]:
    """The namespaces and classes that a function is of, which is defined outside of its class."""
    declarator = function.node.child_by_field_name("declarator")
    while declarator is not None and declarator.type != "function_declarator":
        inner = declarator.child_by_field_name("declarator")
        declarator = inner or next(iter(reversed(declarator.named_children)), None)
    name = declarator.child_by_field_name("declarator") if declarator is not None else None
    text = "".join(text_of(name).split()) if name is not None else ""
    while text != (plain := _ARGUMENTS.sub("", text)):
        text = plain
    around = _scopes_around(function.node, ("namespace_definition",))
    return (*around, *text.removeprefix("::").split("::")[:-1])


def _taken(function: CppFunction) -> int:
    """How many arguments a function takes; `(void)` is none."""
    types = ["".join(text_of(p.node).split()) for p in function.parameters]
    return 0 if types == ["void"] else len(types)


def is_library(name: str) -> bool:
    """Whether a full name is of a library that the tables know, or of a message."""
    first, scope, rest = name.removeprefix("::").partition("::")
    if not scope:
        return False
    known = {s.removesuffix("::") for s in libraries.scopes()} | libraries.copying_scopes()
    is_message = any(f"{kind}::" in rest for kind in ("msg", "srv", "action"))
    return first in known or is_message or first.endswith(("_msgs", "_srvs"))


def is_defaulted(function: CppFunction) -> bool:
    """Whether it is `= default` or `= delete`, which no file need say more of."""
    return any(child.type in _WITHOUT_BODY for child in function.node.named_children)


def _bases(class_: CppClass) -> Iterator[str]:
    for clause in class_.node.named_children:
        if clause.type == "base_class_clause":
            for base in named(clause):
                if base.type in ("type_identifier", "qualified_identifier", "template_type"):
                    yield "".join(text_of(base).split())
