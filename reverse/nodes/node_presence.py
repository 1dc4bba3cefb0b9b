"""Whether a package can have hand-written nodes at all, told without resolving what calls ask for.

Generated packages have none: there all calls to ROS stand in classes that rebsync made, in the
run-time headers, or in the programs that stand in for sensors.
"""

from __future__ import annotations

from rebsync.reserved import RUNTIME_CLASSES
from rebsync.reverse.calls.ros_calls import Asking
from rebsync.reverse.libraries.routines import Kind
from rebsync.reverse.nodes.node_programs import Program
from rebsync.reverse.syntax.cpp_index import Code, CppClass
from rebsync.reverse.syntax.cpp_tree import named, part, text_of

STAND_IN = "_stand_in"
_CONNECTING = frozenset({Kind.PUBLISHER, Kind.SUBSCRIPTION, Kind.SINGLE, Kind.TIMER, Kind.SERVICE})


def is_generated(code: Code) -> bool:
    """Whether there are classes that rebsync made."""
    return any(_has_mailbox(c) for c in code.classes.values())


def may_have_nodes(code: Code, asking: Asking, programs: tuple[Program, ...]) -> bool:
    """Whether code beside generated classes may be a node; True where a closer look must tell."""
    if any(len(same) > 1 for same in code.all_classes.values()):
        return True  # which of them is meant takes more to tell
    if any(not _is_made(code, c) for c in code.classes.values() if c.functions or c.bases):
        return True
    nodes = [p for p in programs if not p.name.endswith(STAND_IN)]
    return any(
        asked.ask.kind in _CONNECTING and any(p.has(asked.site.cpp) for p in nodes)
        for asked in asking.calls_outside(code.classes)
    )


def makes_generated(code: Code, program: Program) -> bool:
    """Whether the `main` of a program makes an object of a generated class."""
    body = program.main.body
    declared = (s for s in named(body) if s.type == "declaration") if body is not None else ()
    names = (text_of(part(s, "type")).rpartition("::")[2] for s in declared)
    return any(n in code.classes and _is_made(code, code.classes[n]) for n in names)


def _is_made(code: Code, owner: CppClass) -> bool:
    """Whether a class is generated, or part of the run-time headers."""
    return owner.name in RUNTIME_CLASSES or any(map(_has_mailbox, code.lineage(owner.name)))


def _has_mailbox(owner: CppClass) -> bool:
    return any(text_of(f.type) == "Mailbox" for f in owner.fields)
