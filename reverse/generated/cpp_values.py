"""The values that members of generated code have before the model's constructor runs."""

from __future__ import annotations

from collections.abc import Container, Iterator

from tree_sitter import Node

from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppField
from rebsync.reverse.syntax.cpp_tree import Cpp, named, text_of

_ZEROS = frozenset({"0", "0.0", "0.0f", "false", "{}", ""})


def initial_values(
    code: Code, owner: CppClass, without: Container[str] = ()
) -> Iterator[tuple[CppField, Cpp, Node]]:
    """Members with a value other than zero: where they are declared, or given by a constructor."""
    given = dict(_listed(code, owner))
    for member in owner.fields:
        cpp, value = given.get(member.name, (member.cpp, member.value))
        if (
            member.name not in without
            and value is not None
            and (inner := _inner(value)) is not None
        ):
            yield member, cpp, inner


def _listed(code: Code, owner: CppClass) -> Iterator[tuple[str, tuple[Cpp, Node]]]:
    """`member(value)` of the initialiser lists of the constructors."""
    for function in code.functions_of(owner):
        if function.name == owner.name and function.initialisers is not None:
            for initialiser in named(function.initialisers):
                name, *_, value = initialiser.named_children
                yield text_of(name), (function.cpp, value)


def _inner(value: Node) -> Node | None:
    """The one value in braces or parentheses; None for zero, or for none."""
    while value.type in ("initializer_list", "argument_list", "parenthesized_expression"):
        inside = named(value)
        if len(inside) != 1:
            return value if inside else None
        value = inside[0]
    return value if text_of(value) not in _ZEROS else None
