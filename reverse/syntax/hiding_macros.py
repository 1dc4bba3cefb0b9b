"""Macros by the name of something else: where it is named, compilers read the macro's text.

"Macro replacement" in the standard knows no scopes: `#define slow fast` renames methods, variables
and what libraries declare. Readers take such a name for what is declared.
"""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.findings import Finding, Grade
from rebsync.reverse.libraries.cpp_calls import library_names
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import Cpp, by_types, inside, text_of

_MACROS = ("preproc_def", "preproc_function_def")
# Words of the language that say nothing of what code does, and may be taken away.
_SAYING_NOTHING = frozenset(
    {
        *("private", "protected", "public", "inline", "override", "final", "noexcept", "register"),
        *("constexpr", "restrict", "nullptr", "NULL", "static_assert", "alignas", "thread_local"),
    }
)
_WORDS = frozenset(
    {
        *("if", "else", "for", "while", "do", "switch", "case", "default", "break", "continue"),
        *("return", "goto", "try", "catch", "throw", "true", "false", "this", "new", "delete"),
        *("int", "char", "bool", "short", "long", "signed", "unsigned", "float", "double", "void"),
        *("const", "static", "virtual", "volatile", "mutable", "auto", "class", "struct", "enum"),
        *("union", "sizeof", "operator", "and", "or", "not", "size_t", "string", "main"),
        *("int8_t", "int16_t", "int32_t", "int64_t"),
        *("uint8_t", "uint16_t", "uint32_t", "uint64_t"),
    }
)
_DECLARING = {
    "declarator": frozenset(
        {
            *("declaration", "field_declaration", "init_declarator", "function_declarator"),
            *("parameter_declaration", "optional_parameter_declaration", "pointer_declarator"),
            *("reference_declarator", "array_declarator", "for_range_loop", "type_definition"),
        }
    ),
    "name": frozenset(
        {
            *("class_specifier", "struct_specifier", "enum_specifier", "enumerator"),
            *("alias_declaration", "namespace_definition"),
        }
    ),
}
_SEVERAL = "this is worked out of what has several values"
_WHY = "a macro by the name of something else: it is read as that"


def hiding_macros(code: Code) -> Iterator[Finding]:
    """The macros of some files by names that the files or libraries declare."""
    macros: dict[str, list[tuple[Cpp, Node]]] = {}
    for cpp in code.files:
        if b"define" in cpp.words:
            for nodes in by_types(cpp.root, _MACROS).values():
                for node in nodes:
                    name = text_of(node.children_by_field_name("name")[0])
                    macros.setdefault(name, []).append((cpp, node))
    for name, defined in macros.items():
        if name in _SAYING_NOTHING or all(_is_itself(node, name) for _, node in defined):
            continue
        if name in _WORDS or name in library_names() or _is_declared(code, name):
            for cpp, node in defined:
                line = cpp.span(node)
                yield Finding(Grade.UNREADABLE, cpp.source, line, f"{_WHY}: {name}")
    yield from _enumerators(code)


def _enumerators(code: Code) -> Iterator[Finding]:
    """Enumerators by what their file defines in one way, and other files or the build in another.

    What a constant is counts where it is named, but their values are those of the file alone.
    """
    for each in (e for found in code.enumerators.values() for e in found):
        value = each.node.child_by_field_name("value")
        for name in map(text_of, inside(value, "identifier")):
            in_file = code.constant(each.cpp, name) is not None
            if in_file and name not in code.constants_for(each.cpp):
                span = each.cpp.span(each.node)
                yield Finding(Grade.UNREADABLE, each.cpp.source, span, f"{_SEVERAL}: {name}")


def _is_itself(node: Node, name: str) -> bool:
    """`#define name name`, by which others can ask whether there is one."""
    value = node.child_by_field_name("value")
    return value is not None and text_of(value).strip() == name


def _is_declared(code: Code, name: str) -> bool:
    """Whether a file declares something of a name, or a member or scope has it."""
    word = name.encode()
    return any(
        _declares(node)
        for cpp in code.files
        if word in cpp.words
        for node in code.named(cpp, cpp.root, (name,))
    )


def _declares(node: Node) -> bool:
    """Whether a name is declared where it stands, or is looked for in something."""
    if node.type in ("field_identifier", "namespace_identifier"):
        return True
    parent = node.parent
    while parent is not None and parent.type in ("qualified_identifier", "destructor_name"):
        node, parent = parent, parent.parent
    if parent is None:
        return False
    is_typed = parent.type != "declaration" or parent.child_by_field_name("type") is not None
    return is_typed and any(
        parent.type in kinds and node in parent.children_by_field_name(field)
        for field, kinds in _DECLARING.items()
    )
