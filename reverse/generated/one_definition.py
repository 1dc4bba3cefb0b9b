"""Classes and functions that two files of generated code define, or that a library may define.

A program has one definition of each (the one-definition rule of C++, [basic.def.odr]); which of
two files a program is made of is not known here where both are read, nor which one a linker takes.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reserved import RESERVED, RUNTIME_CLASSES
from rebsync.reverse.findings import Finding, Grade
from rebsync.reverse.generated.cpp_meanings import is_runtime_header
from rebsync.reverse.generated.cpp_names import has_mailbox
from rebsync.reverse.syntax.ancestors import ancestors
from rebsync.reverse.syntax.cpp_declarations import CppFunction
from rebsync.reverse.syntax.cpp_index import Code, CppClass
from rebsync.reverse.syntax.cpp_tree import part, text_of

_HINT = "take one of them out of the build, or out of the package"
_REPLACED = "this may stand in place of what a library, or the run-time part, defines"
# Outermost namespaces of what generated programs are linked with, and those that C++ reserves.
_OF_LIBRARIES = re.compile(
    r"_.*|abi|boost|builtin_interfaces|gnu.*|log4cxx|message_filters|rc[lp]\w*|rcutils|rmw\w*|ros\w*|"
    r"std|tf2?\w*|tracetools|XmlRpc|\w+_(?:interfaces|msgs|srvs)"
)
_INNER = "detail"  # the namespace of what the run-time part keeps for itself


def defined_again(code: Code, owner: CppClass) -> Iterator[Finding]:
    """The further definitions of a class and of its functions in other files than the first."""
    for other in code.all_classes.get(owner.name, ()):
        if other.cpp.source.path != owner.cpp.source.path:
            why = f"{owner.cpp.source.path} defines this class, too"
            span = other.cpp.span(other.node)
            yield Finding(Grade.UNREADABLE, other.cpp.source, span, why, _HINT, owner.name)
    for name in dict.fromkeys(f.name for f in owner.functions):
        first: dict[tuple[str, ...], str] = {}
        for function in code.definitions.get((owner.name, name), ()):
            source = function.cpp.source
            path = first.setdefault(function.types, source.path)
            if path != source.path:
                why, span = f"{path} defines this function, too", function.cpp.span(function.node)
                within = f"{owner.name}.{name}"
                yield Finding(Grade.UNREADABLE, source, span, why, _HINT, within)


def in_place_of_others(code: Code) -> Iterator[Finding]:
    """What is defined in a namespace of a library, or beside the run-time part."""
    own = {_namespaces(c.node)[:1] for c in code.classes.values() if has_mailbox(code, c)}
    functions: list[CppFunction | CppClass] = [
        f for found in code.definitions.values() for f in found if f.body is not None
    ]
    classes = [c for found in code.all_classes.values() for c in found if not c.outer]
    for each in (*functions, *classes):
        spaces = _namespaces(each.node)
        name = each.name if isinstance(each, CppClass) else each.owner or each.name
        of_runtime = name in (RUNTIME_CLASSES | RESERVED) - {"main"} or _INNER in spaces
        is_foreign = bool(spaces) and spaces[:1] not in own and _is_linked(spaces[0])
        is_shared = "" not in spaces and not is_runtime_header(each.cpp.source.path)
        if is_shared and (is_foreign or (of_runtime and spaces[:1] in own)):
            span = each.cpp.span(each.node)
            yield Finding(Grade.UNREADABLE, each.cpp.source, span, _REPLACED)


def _is_linked(space: str) -> bool:
    """Whether a library that generated programs are linked with has an outermost namespace."""
    return _OF_LIBRARIES.fullmatch(space) is not None


def _namespaces(node: Node) -> tuple[str, ...]:
    """The namespaces that a definition is in, outermost first; one without a name is empty."""
    found: list[str] = []
    for above in ancestors(node):
        if above.type == "namespace_definition":
            name = above.child_by_field_name("name")
            found[:0] = text_of(name).split("::") if name is not None else [""]
    return (*found, *_qualified(node))


def _qualified(node: Node) -> Iterator[str]:
    """The scopes that a definition names before its own name, but for the class of a function."""
    name = node.child_by_field_name("declarator") if node.type == "function_definition" else None
    while name is not None and name.type != "qualified_identifier":
        name = name.child_by_field_name("declarator")
    while name is not None and part(name, "name").type == "qualified_identifier":
        scope = name.child_by_field_name("scope")
        yield text_of(scope) if scope is not None else ""
        name = part(name, "name")
