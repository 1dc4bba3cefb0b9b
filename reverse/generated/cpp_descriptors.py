"""The descriptors of servers in generated code: `constexpr Server kX{"x", priority(1)}`."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync import model as m
from rebsync.reverse.generated.annotations import PRIORITIES, priority
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of, string_of
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_numerals import whole_number
from rebsync.reverse.syntax.cpp_tree import Cpp, named, text_of


def number_of(code: Code, cpp: Cpp, node: Node) -> int | None:
    """A whole number, or that of a constant."""
    found = code.constant(cpp, text_of(node))
    return whole_number(text_of(found[1] if found is not None else node))


def server_of(code: Code, cpp: Cpp, constant: str) -> str | None:
    """The server that a descriptor `constexpr Server kX{"x", priority}` is about."""
    found = _constant(code, cpp, constant)
    if found is None or found[1].type != "initializer_list":
        return None
    values = named(found[1])
    return string_of(values[0]) if values else None


def _constant(code: Code, cpp: Cpp, name: str) -> tuple[Cpp, Node] | None:
    """The value of a constant that has but one: a class may have one by a name of its file."""
    return code.constant(cpp, name) if name in code.constants_for(cpp) else None


def priority_of(code: Code, cpp: Cpp, descriptor: str) -> Iterator[m.Annotation]:
    """`@priority(n)` or `@globalPriority(n)` of a server's descriptor."""
    given = _given_priority(code, cpp, descriptor)
    called = call_of(given) if given is not None else None
    if called is not None and (number := _priority_in(code, cpp, called)) is not None:
        yield priority(called.name, number)


def _given_priority(code: Code, cpp: Cpp, descriptor: str) -> Node | None:
    """What the descriptor of a server says of its priority, a constant by its value."""
    found = _constant(code, cpp, descriptor)
    values = named(found[1]) if found is not None else []
    if len(values) != 2:
        return None
    constant = code.constant(cpp, text_of(values[1]))
    return constant[1] if constant is not None else values[1]


def _priority_in(code: Code, cpp: Cpp, call: CppCall) -> int | None:
    if call.name not in PRIORITIES or len(call.arguments) != 1:
        return None
    return number_of(code, cpp, call.arguments[0])


def tells_priority(code: Code, cpp: Cpp, descriptor: str) -> bool:
    """Whether a descriptor tells of its priority, or that it has none, as the model can."""
    given = _given_priority(code, cpp, descriptor)
    called = call_of(given) if given is not None else None
    if called is not None and _priority_in(code, cpp, called) is not None:
        return True
    return given is not None and text_of(given) == "kNoPriority"
