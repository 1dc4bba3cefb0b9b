"""What runs with objects though no call stands there: of their bases and members, of elements.

To make or end an object makes or ends what it consists of; what libraries have in containers they
compare, hash and copy by the operators of its class.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from rebsync.records import dataclass
from rebsync.reverse.bodies.effects.cpp_undefined import Undefined
from rebsync.reverse.syntax.cpp_declarations import CppField
from rebsync.reverse.syntax.cpp_index import CppClass
from rebsync.reverse.syntax.cpp_tree import text_of
from rebsync.reverse.values.cpp_flow import Texts
from rebsync.reverse.values.cpp_static_types import POINTING, StaticType, StaticTypes

UNDEFINED = "no file that was read defines it"
_KEYED = re.compile(r"map\Z|set\Z|priority_queue\Z")
_KEPT = POINTING | {"function", "move_only_function"}  # which are made without what they hold


@dataclass(frozen=True, slots=True)
class ObjectParts:
    """Whether what objects consist of has functions that no file defines."""

    texts: Texts
    statics: StaticTypes
    open: Undefined

    def of_object(self, type_: StaticType | None, is_held: bool = False) -> str | None:
        """Why to make or end an object of a type may run what was not read.

        Of one that is `is_held` by a pointer the class may be one below.
        """
        if type_ is None or type_.pointers or not self.open.has_undefined:
            return None
        owner = self.statics.class_of(type_)
        below = self.texts.descendants(owner) if owner is not None and is_held else []
        found = [*self._classes([type_]), *(c for b in below for c in self.within(b))]
        return UNDEFINED if any(map(self.open.is_made_unread, found)) else None

    def of_class(self, owner: CppClass | None) -> str | None:
        """Why to make an object of a class may."""
        if owner is None or not self.open.has_undefined:
            return None
        return UNDEFINED if any(map(self.open.is_made_unread, self.within(owner))) else None

    def of_elements(self, types: Iterable[StaticType | None]) -> str | None:
        """Why a library may that has elements of some types: by an operator of their classes."""
        if not self.open.operators:
            return None
        types = [*types]
        if self.open.compares_unread and any(t and _KEYED.search(t.last) for t in types):
            return UNDEFINED
        return self.of_operands(t for each in types if each for t in self._arguments(each))

    def of_operands(self, types: Iterable[StaticType | None]) -> str | None:
        """Why a library may that gets objects of some types: by an operator of their classes."""
        for type_ in types if self.open.operators else ():
            owner = self.statics.class_of(type_)
            lineage = self.texts.lineage(owner) if owner is not None else []
            own = {f.name for c in lineage for f in c.functions}
            if owner is not None and self.open.operators & (own | self.open.declared):
                return UNDEFINED
        return None

    def within(self, owner: CppClass) -> list[CppClass]:
        """A class, and those of what its objects consist of."""
        return self._classes([StaticType(owner.cpp, owner.name)])

    def _arguments(self, type_: StaticType) -> Iterator[StaticType]:
        """The types that are arguments of a template, and of those in turn."""
        for node in type_.arguments:
            inner = self.statics.written(type_.cpp, node)
            if inner is not None:
                yield inner
                yield from self._arguments(inner)

    def _classes(self, types: Iterable[StaticType | None]) -> list[CppClass]:
        """The classes of the objects that some types are, and consist of."""
        waiting, found = [*types], dict[int, CppClass]()
        while waiting:
            type_ = waiting.pop()
            if type_ is None or type_.pointers or type_.last in _KEPT:
                continue
            owner = self.statics.class_of(type_)
            if owner is None:
                waiting += (self.statics.written(type_.cpp, a) for a in type_.arguments)
                continue
            new = [c for c in self.texts.lineage(owner) if c.node.id not in found]
            found |= {c.node.id: c for c in new}
            members = (f for c in new for f in (*c.fields, *c.others) if not _refers(f))
            waiting += (self.statics.written(f.cpp, f.type) for f in members)
        return [*found.values()]


def _refers(member: CppField) -> bool:
    """Whether a member is a pointer or a reference."""
    text = text_of(member.node).partition("=")[0]
    return "*" in text or "&" in text
