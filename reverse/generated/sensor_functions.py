"""What the functions of C++ do that say what a sensor saw: their effects besides a value.

Whatever they give is among the model's choices. What they compute, keep for themselves and ask of
hardware is theirs; the rebec, its messages and its time are the model's.
"""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.bodies.cpp_effects import Effects
from rebsync.reverse.bodies.cpp_kinds import LEAVES
from rebsync.reverse.bodies.cpp_plain_locals import declared_names
from rebsync.reverse.bodies.known_functions import acts, starts_nothing
from rebsync.reverse.bodies.scope import Scope
from rebsync.reverse.bodies.touches import Touches
from rebsync.reverse.findings import Unread
from rebsync.reverse.generated.ros1_meanings import is_runtime_header
from rebsync.reverse.generated.ros1_names import has_mailbox
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.libraries.effects import of_function
from rebsync.reverse.libraries.routines import Effect, Language
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of, calls_in
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, part, text_of
from rebsync.reverse.syntax.macros import hides
from rebsync.source import Source

_ASKED = "this runs when it is asked what a sensor saw"
_LOOKED_AT = frozenset({Effect.NONE, Effect.CLOCK, Effect.LOGS})
_NAMES = ("identifier", "type_identifier", "qualified_identifier", "namespace_identifier")
_NOT_ENDED = (*(kind for kind in LEAVES if kind != "return_statement"), "gnu_asm_expression")


@dataclass(frozen=True, slots=True)
class SensorFunctions:
    """Looks through what a body asks of its sensors; `scope` is what it can name."""

    code: Code
    scope: Scope

    def acting(self, cpp: Cpp, body: Node) -> Iterator[tuple[Source, Unread]]:
        """The places that may do more than to say what was seen."""
        asked = [c.arguments[1] for c in self.code.calls_in(cpp, body) if _asks(c)]
        if not asked:
            return
        waiting = [name for _, name in self.code.definitions if name.startswith("operator")]
        for argument in asked:
            looked = _seeing(argument)
            if looked is None:
                yield cpp.source, Unread(cpp.span(argument), "no sensor is asked here")
            elif looked.type == "lambda_expression":
                yield from self._of_lambda(cpp, looked)
            else:
                waiting.append(text_of(looked).lstrip("& ").rpartition("::")[2])
        yield from _Reach(self.code, _modelled(self.code)).acting(waiting)

    def _of_lambda(self, cpp: Cpp, node: Node) -> Iterator[tuple[Source, Unread]]:
        """A lambda in the body, which may look at the rebec."""
        try:
            Effects(cpp, self.scope, returning=True).check(part(node, "body"))
        except Touches as touches:
            yield cpp.source, touches


@dataclass(frozen=True, slots=True)
class _Reach:
    """Functions and what these name; `modelled` are the classes of rebecs and of their run time."""

    code: Code
    modelled: frozenset[str]

    def acting(self, waiting: list[str]) -> Iterator[tuple[Source, Unread]]:
        """What functions do, and what these call."""
        reached = set[str]()
        while waiting:
            if (name := waiting.pop()) not in reached:
                reached.add(name)
                for cpp, node in self._declared(name):
                    waiting += _names_in(node)
                    listed: list[Node] = []
                    for at, why in self._done_in(cpp, node):
                        if not any(_is_in(at, outer) for outer in listed):
                            listed.append(at)
                            yield cpp.source, Unread(cpp.span(at), f"{_ASKED}: {why}")

    def _declared(self, name: str) -> Iterator[tuple[Cpp, Node]]:
        """The functions, variables and macros of a name that stand in files of the user's."""
        for (owner, own), functions in self.code.definitions.items():
            if name in (own, owner) and owner not in self.modelled:
                yield from ((f.cpp, f.node) for f in functions)
        for class_ in self.code.all_classes.get(name, ()):
            if name not in self.modelled:
                yield class_.cpp, class_.node
        for variable in self.code.variables.get(name, ()):
            yield variable.cpp, variable.node
        for defined in self.code.macros.get(name, ()):
            yield self.code.file_of(defined), defined

    def _done_in(self, cpp: Cpp, node: Node) -> Iterator[tuple[Node, str]]:
        """What the text of a function, or the declaration of what it names, does."""
        own = frozenset(n for d in inside(node, "declaration") for n in declared_names(d))
        for leaving in inside(node, *_NOT_ENDED):
            yield leaving, LEAVES.get(leaving.type, "this does something")
        for call in calls_in(node):
            if (why := self._called(cpp, call)) is not None:
                yield call.node, why
        for each in inside(node, *_NAMES):
            if (why := self._named(text_of(each), own)) is not None:
                yield each, why
        if node.type == "preproc_function_def":
            yield node, "what this macro does is not known"

    def _named(self, name: str, own: frozenset[str]) -> str | None:
        """What naming something may do to the node."""
        last = name.partition("<")[0].rpartition("::")[2]
        if last in self.modelled:
            return f'"{name}" is the model\'s'
        if last in own:
            return None
        is_ros = name.startswith(libraries.scopes()) or last in libraries.own_classes()
        if is_ros and of_function(Language.CPP, name).effect not in _LOOKED_AT:
            return f'"{name}" has to do with the node'
        if last in libraries.acting() or not starts_nothing(last) or last in libraries.threaded():
            return f'"{name}" acts on the node'
        return None

    def _called(self, cpp: Cpp, call: CppCall) -> str | None:
        name = call.name.rpartition("::")[2]
        does = acts(cpp, call, True)
        if does is not None:
            return f'"{name}" {does}'
        if name in libraries.telling_words():
            return f'"{name}" has to do with messages'
        if hides(name) and name not in self.code.macros:
            return f'"{name}" may be a macro that hides statements'
        return None


def _modelled(code: Code) -> frozenset[str]:
    """The classes of rebecs, and those of the run-time part."""
    rebecs = (name for name, owner in code.classes.items() if has_mailbox(code, owner))
    runtime = (
        name
        for name, classes in code.all_classes.items()
        if any(is_runtime_header(c.cpp.source.path) for c in classes)
    )
    return frozenset(rebecs).union(runtime)


def _asks(call: CppCall) -> bool:
    return call.name == "choose" and len(call.arguments) == 2


def _seeing(node: Node) -> Node | None:
    """What `x_sensor_.seen(...)` gets; None where something else is asked for."""
    call = call_of(node)
    is_sensor = call is not None and call.name == "seen" and call.on.endswith("_sensor_")
    if call is None or not is_sensor or len(call.arguments) != 1:
        return None
    looked = call.arguments[0]
    is_name = looked.type in ("identifier", "qualified_identifier", "pointer_expression")
    return looked if is_name or looked.type == "lambda_expression" else None


def _names_in(node: Node) -> list[str]:
    return [text_of(n).rpartition("::")[2] for n in inside(node, *_NAMES, "field_identifier")]


def _is_in(node: Node, outer: Node) -> bool:
    return outer.start_byte <= node.start_byte and node.end_byte <= outer.end_byte
