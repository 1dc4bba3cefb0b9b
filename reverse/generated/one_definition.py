"""Classes and functions that two files of generated code define.

A program has one definition of each (the one-definition rule of C++, [basic.def.odr]); which of
two files a program is made of is not known here where both are read.
"""

from __future__ import annotations

from collections.abc import Iterator

from rebsync.reverse.findings import Finding, Grade
from rebsync.reverse.syntax.cpp_index import Code, CppClass

_HINT = "take one of them out of the build, or out of the package"


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
