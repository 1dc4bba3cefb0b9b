"""Arguments and parameters that code gives its own node, beside what launch files and people give.

They rename the node and its topics, set parameters, or hide what a launch file sets. What launch
files set is read as if there were none: such places are listed.
"""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.reverse.findings import Finding, Grade
from rebsync.reverse.libraries import arguments
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of
from rebsync.reverse.syntax.cpp_declarations import function_of
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, part, text_of

OWN_ARGUMENTS = "arguments that the code gives its node by itself are not read"


def own_arguments(code: Code) -> Iterator[Finding]:
    """The places of some files that give nodes other arguments than the program's."""
    taking = (name.rpartition("::")[2] for name in arguments.taking_in_cpp())
    words = {*arguments.own_in_cpp(), *taking}
    for cpp in code.files:
        for node in code.named(cpp, cpp.root, words) if not cpp.is_beside else ():
            above = climb(node, lambda n: n.type == "call_expression")
            call = call_of(above) if above is not None else None
            name = call.name.rpartition("::")[2] if call is not None else ""
            if call is not None and name == text_of(node) and _gives(cpp, call):
                span = cpp.span(call.node)
                yield Finding(Grade.UNREADABLE, cpp.source, span, OWN_ARGUMENTS)


def _gives(cpp: Cpp, call: CppCall) -> bool:
    given = [text_of(a) for a in call.arguments]
    if call.target is not None:
        nothing = arguments.own_in_cpp().get(call.name)
        return nothing is not None and given not in ([], [nothing])
    full = "".join(text_of(part(call.node, "function")).split())
    routine = arguments.taking_in_cpp().get(full.removeprefix("::"))
    if routine is None:
        return False
    own = _parameters(cpp, call.node)
    wanted = [g for g, role in zip(given, routine.arguments, strict=False) if role == "arguments"]
    return any(text not in own for text in wanted)


def _parameters(cpp: Cpp, node: Node) -> set[str]:
    """The names of what the function around a node takes."""
    above = climb(node, lambda n: n.type == "function_definition")
    function = function_of(cpp, above, "") if above is not None else None
    found = function.parameters if function is not None else ()  # also of `char* argv[]`
    return {text_of(name) for p in found for name in inside(p.node, "identifier")}
