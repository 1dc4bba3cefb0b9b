"""What files declare and do not define: functions, methods, operators, classes, and bases."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from tree_sitter import Node

from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.syntax.cpp_declarations import CppFunction, function_of
from rebsync.reverse.syntax.cpp_index import CONTAINERS, Code, CppClass
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, named, text_of
from rebsync.reverse.values.cpp_flow import Texts

# Bases of nodes that are the client libraries' own, or have no functions to be called.
_PLAIN_BASES = frozenset({"Nodelet", "Node", "LifecycleNode", "noncopyable"})
_PLAIN_BASES |= {"enable_shared_from_this"}
_WITHOUT_BODY = frozenset({"default_method_clause", "delete_method_clause"})


class Undefined:
    """What some code declares without a definition."""

    def __init__(self, code: Code, texts: Texts) -> None:
        self.code = code
        self.texts = texts

    def lacks_body(self, owner: CppClass, name: str) -> bool:
        """Whether a class declares more functions of a name than the files define."""
        declared = [f for f in owner.functions if f.name == name]
        open_ = [f for f in declared if f.body is None and not _is_defaulted(f)]
        apart = self.code.definitions.get((owner.name, name), ())
        return len(open_) > len(apart)

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
        return frozenset(f.name for f in found if f is not None) - self.defined

    @cached_property
    def forward(self) -> frozenset[str]:
        """The classes that are declared without their members."""
        kinds = ("class_specifier", "struct_specifier")
        found = (node for _, node in self._top if node.type in kinds)
        names = (n for node in found if (n := node.child_by_field_name("name")) is not None)
        return frozenset(map(text_of, names)) - self.code.all_classes.keys()

    @cached_property
    def undefined(self) -> frozenset[str]:
        """The names of methods of which a class has no body, and of functions that are members."""
        every = [c for classes in self.code.all_classes.values() for c in classes]
        lacking = {f.name for c in every for f in c.functions if self.lacks_body(c, f.name)}
        return frozenset(lacking)

    @cached_property
    def has_undefined(self) -> bool:
        """Whether a class has a constructor or destructor without a body."""
        every = [c for classes in self.code.all_classes.values() for c in classes]
        return any(self.lacks_body(c, n) for c in every for n in (c.name, f"~{c.name}"))

    @cached_property
    def operators(self) -> frozenset[str]:
        """The operators that lack a body."""
        names = self.undefined | self.declared
        return frozenset(n for n in names if n.startswith("operator"))


def _declared_inside(cpp: Cpp) -> Iterator[Node]:
    """Declarations in classes, of friends, and in functions, of what is elsewhere."""
    if b"friend" in cpp.words:
        for each in inside(cpp.root, "friend_declaration"):
            yield from (n for n in named(each) if n.type == "declaration")
    if b"extern" in cpp.words:
        for each in inside(cpp.root, "declaration"):
            if any(text_of(c) == "extern" for c in each.named_children):
                yield each


def is_library(name: str) -> bool:
    """Whether a full name is of a library that the tables know, or of a message."""
    first, scope, rest = name.removeprefix("::").partition("::")
    if not scope:
        return False
    known = {s.removesuffix("::") for s in libraries.scopes()} | libraries.copying_scopes()
    is_message = any(f"{kind}::" in rest for kind in ("msg", "srv", "action"))
    return first in known or is_message or first.endswith(("_msgs", "_srvs"))


def _is_defaulted(function: CppFunction) -> bool:
    """Whether it is `= default` or `= delete`, which no file need say more of."""
    return any(child.type in _WITHOUT_BODY for child in function.node.named_children)


def _bases(class_: CppClass) -> Iterator[str]:
    for clause in class_.node.named_children:
        if clause.type == "base_class_clause":
            for base in named(clause):
                if base.type in ("type_identifier", "qualified_identifier", "template_type"):
                    yield "".join(text_of(base).split())
