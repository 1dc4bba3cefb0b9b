"""What people put into classes of generated code that no generator writes.

A body that has such forms in it is read as people's own code is: by what it does.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from rebsync.reverse.bodies.scope import Member, Outside, Scope
from rebsync.reverse.syntax.cpp_index import Code, CppClass
from rebsync.reverse.syntax.cpp_tree import inside, text_of

_REFERS = ("pointer_declarator", "reference_declarator")


def as_by_hand(code: Code, owner: CppClass, scope: Scope) -> Scope:
    """What a body of a class can name, for a reader of what people write."""
    members: dict[str, Member] = dict(scope.members)
    for above in code.lineage(owner.name):
        for name in _referring(above):
            members[name] = Outside(reaches=True)
    return replace(scope, members=members, open=True, macros=code.macros)


def _referring(owner: CppClass) -> Iterator[str]:
    """The members that are pointers or references: to what, is not known."""
    for field in inside(owner.node, "field_declaration"):
        for declarator in field.children_by_field_name("declarator"):
            if declarator.type in _REFERS:
                yield text_of(declarator.named_children[-1])
