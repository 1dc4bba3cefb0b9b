"""Functions that classes of generated code have from those above them."""

from __future__ import annotations

from collections.abc import Callable

from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.syntax.cpp_calls import call_of
from rebsync.reverse.syntax.cpp_index import Code, CppClass, CppFunction
from rebsync.reverse.syntax.cpp_tree import named, text_of


def only_forwards(code: Code, owner: CppClass, function: CppFunction) -> bool:
    """Whether a function only makes an inherited one that of an interface as well."""
    statements = named(function.body) if function.body is not None else []
    same = (f for f in owner.functions if _signature(f) == _signature(function))
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


def is_declared(
    code: Code, owner: CppClass, function: CppFunction, has_mailbox: Callable[[CppClass], bool]
) -> bool:
    """Whether the model declares an abstract function here, not only an interface above."""
    names = {f"msgsrv {owner.name}.", f"method {owner.name}."}
    if any(marker.startswith(n) for n in names for marker in function.markers):
        above = (c for c in code.lineage(owner.name)[1:] if not has_mailbox(c))
        return not any(_signature(f) == _signature(function) for c in above for f in c.functions)
    return True


def list_hiding(code: Code, owner: CppClass, function: CppFunction, findings: Findings) -> None:
    """Lists a function that classes above do not call where they call their own one of its name.

    In the model all methods are virtual ([class.virtual] says which functions of C++ are).
    """
    above = code.lineage(owner.name)[1:]
    same = [f for c in above for f in c.functions if _signature(f) == _signature(function)]
    if not same or any(_is_virtual(f) for f in same):
        return
    every = (f for c in above for f in code.functions_of(c))
    if any(call.name == function.name for f in every for call in code.calls_of(f)):
        why = f'"{same[0].owner}" calls its own "{function.name}", which is not virtual'
        unread = Unread(function.cpp.span(function.node), why, "make that one virtual")
        findings.unreadable(function.cpp.source, unread, f"{owner.name}.{function.name}")


def _signature(function: CppFunction) -> tuple[str, tuple[str, ...]]:
    return function.name, function.types


def _is_virtual(function: CppFunction) -> bool:
    """Whether a function says that it is virtual, by itself or by what it overrides."""
    said = any(text_of(c) == "virtual" for c in function.node.children)
    return said or function.overrides or function.pure
