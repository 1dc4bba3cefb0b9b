"""Functions that classes of generated code have from those above them."""

from __future__ import annotations

from rebsync.reverse.syntax.cpp_calls import call_of
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import named, text_of


def only_forwards(code: Code, owner: CppClass, function: CppFunction) -> bool:
    """Whether a function only makes an inherited one that of an interface as well."""
    statements = named(function.body) if function.body is not None else []
    same = (f for f in owner.functions if (f.name, f.types) == (function.name, function.types))
    if len(statements) != 1 or not any(f.overrides for f in (function, *same)):
        return False
    inner = named(statements[0])
    call = call_of(inner[0]) if inner else None
    if call is None or any(x.startswith(("msgsrv ", "method ")) for x in function.markers):
        return False
    passed = [text_of(a) for a in call.arguments]
    inherited = {f"{c.name}::{function.name}" for c in code.lineage(owner.name)[1:]}
    called = "".join(call.name.split())  # a formatter may break it
    return called in inherited and passed == [p.name for p in function.parameters]
