"""What the functions of C++ do that say what a sensor saw: their effects besides a value.

Whatever they give is among the model's choices. What they compute, keep for themselves and ask of
hardware is theirs; the rebec, its messages and its time are the model's.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping

from tree_sitter import Node

from rebsync.model import Type
from rebsync.reverse.analysis.outcomes.outcomes import OutcomeAnalysis
from rebsync.reverse.analysis.problems import Problem
from rebsync.reverse.findings import Unread
from rebsync.reverse.generated.cpp_meanings import is_runtime_header
from rebsync.reverse.generated.cpp_names import has_mailbox
from rebsync.reverse.generated.ill_formed import ill_formed
from rebsync.reverse.generated.sensors import sensor_of
from rebsync.reverse.generated.user_blocks import user_blocks
from rebsync.reverse.ir.cpp.functions import lambda_names
from rebsync.reverse.ir.cpp.lowering import CppLowering
from rebsync.reverse.ir.cpp.symbols import FunctionSymbol
from rebsync.reverse.ir.program import Program
from rebsync.reverse.libraries.outcomes import LibraryOutcomes
from rebsync.reverse.libraries.routines import Language
from rebsync.reverse.syntax.cpp_calls import CppCall, call_of
from rebsync.reverse.syntax.cpp_index import Code, CppFunction
from rebsync.reverse.syntax.cpp_tree import Cpp, inside, part, text_of
from rebsync.reverse.syntax.descendants import nodes_in
from rebsync.source import Source, Span

_ASKED = "this runs when it is asked what a sensor saw"
_UNKNOWN = "only a function of the package says what a sensor saw"
_DEFINED = re.compile(rb"^[ \t]*#[ \t]*define[ \t]+(\w+)", re.MULTILINE)
# What a function is made of that only gives a field of what it gets, as generated ones do.
_PLAIN = frozenset(
    {"return_statement", "field_expression", "identifier", "field_identifier", "comment"}
)


def acting_for_sensors(
    code: Code, cpp: Cpp, body: Node, messages: Mapping[str, Mapping[str, Type | None]]
) -> Iterator[tuple[Source, Unread]]:
    """The places that may do more than to say what was seen, where a body asks its sensors.

    `messages` are the fields of the package's types of messages.
    """
    asked = [c.arguments[1] for c in code.calls_in(cpp, body) if _asks(c)]
    looked = []
    for argument in asked:
        if (found := _seeing(argument)) is None:
            yield cpp.source, Unread(cpp.span(argument), "no sensor is asked here")
            continue
        functions = _functions_named(code, found)
        for function in functions:
            yield from _without_field(function, messages)
            yield from ((function.cpp.source, unread) for unread in ill_formed(code, function))
        if not _is_plain(functions):
            looked.append(found)
    if looked:
        yield from _SensorProgram(code).acting(cpp, looked)


def acting_in_blocks(
    code: Code, cpp: Cpp, body: Node, listed: Collection[Span]
) -> Iterator[tuple[Source, Unread]]:
    """The places in users' own blocks of a body that do not go on with what stands after them.

    Blocks with places that are `listed` already are left out.
    """
    around = cpp.span(body)
    every = user_blocks(cpp.source.text)
    blocks = [b for b in every if around.holds(b)]
    spans = [b for b in blocks if not any(b.start <= at.start <= b.end for at in listed)]
    if spans:
        yield from _SensorProgram(code).acting_in(body, spans)


class _SensorProgram:
    """The program that a package is, without the model's classes."""

    def __init__(self, code: Code) -> None:
        self.code = code
        self.lowering = CppLowering(code)
        self.modelled = _modelled(code)
        program = self.lowering.program()
        own = [name for name in program.functions if not self._is_model(name)]
        classes = [c for c in program.classes.values() if not self._is_model(c.name)]
        self.program = Program(own, classes, program.function, program.modules.items())
        macros = {m.decode() for cpp in code.files for m in _DEFINED.findall(cpp.data)}
        table = LibraryOutcomes(Language.CPP, frozenset(macros))
        self.analysis = OutcomeAnalysis(self.program, table, self._is_model)

    def _is_model(self, name: str) -> bool:
        """Whether a class, function or file is of the rebecs or of the run-time part."""
        symbol = self._symbols.get(name)
        if symbol is not None and symbol.owner is None:
            return False
        parts = name.split("::")
        return any(each.partition("<")[0] in self.modelled for each in parts) or (
            "/" in name and is_runtime_header(name)
        )

    @property
    def _symbols(self) -> dict[str, FunctionSymbol]:
        return self.lowering.world.symbols.functions

    def acting(self, cpp: Cpp, looked: list[Node]) -> Iterator[tuple[Source, Unread]]:
        """What the functions do that are handed over, and what these call."""
        found = set[Problem]()
        for node in looked:
            names = self._functions(node)
            if not names:
                yield cpp.source, Unread(cpp.span(node), _UNKNOWN)
            found = found.union(*map(self.analysis.of, names))
        for problem in sorted(found, key=lambda p: (p.function, p.place.start, p.why)):
            source = self.lowering.file_of(problem.function).source
            yield source, Unread(problem.place, f"{_ASKED}: {problem.why}")

    def acting_in(self, body: Node, spans: list[Span]) -> Iterator[tuple[Source, Unread]]:
        """What statements of a body do."""
        names = (n for n, s in self._symbols.items() if s.code.body == body)
        for function in map(self.program.function, names):
            for span in spans:
                for problem in sorted(self.analysis.of_statements(function, span), key=str):
                    source = self.lowering.file_of(problem.function).source
                    yield source, Unread(problem.place, f"in a user's block: {problem.why}")

    def _functions(self, node: Node) -> list[str]:
        """The functions that say what was seen: all of a name, or a lambda of a method."""
        if node.type == "lambda_expression":
            for symbol in self._symbols.values():
                owner = self.lowering.world.symbols.classes.get(symbol.owner or "")
                if node.id in (names := lambda_names(symbol, owner)):
                    return [names[node.id]]
            return []
        name = text_of(node).lstrip("& ").rpartition("::")[2]
        own = (n for n, s in self._symbols.items() if s.simple == name and s.owner is None)
        return sorted(n for n in own if n in self.program)


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
    is_sensor = call is not None and call.name == "seen" and sensor_of(call.on) is not None
    if call is None or not is_sensor or len(call.arguments) != 1:
        return None
    looked = call.arguments[0]
    is_name = looked.type in ("identifier", "qualified_identifier", "pointer_expression")
    return looked if is_name or looked.type == "lambda_expression" else None


def _functions_named(code: Code, looked: Node) -> list[CppFunction]:
    """All functions of the name that a sensor is handed; none for a lambda."""
    name = text_of(looked).lstrip("& ").rpartition("::")[2]
    every = ((own, found) for (_, own), found in code.definitions.items())
    return [f for own, found in every if own == name for f in found] if name.isidentifier() else []


def _is_plain(functions: Collection[CppFunction]) -> bool:
    """Whether functions only give a field of what they get."""
    parts = (n for f in functions if f.body is not None for n in f.body.named_children)
    return bool(functions) and all(n.type in _PLAIN for p in parts for n in nodes_in(p))


def _without_field(
    function: CppFunction, messages: Mapping[str, Mapping[str, Type | None]]
) -> Iterator[tuple[Source, Unread]]:
    """The places where a function names a field that its message has not."""
    fields = {t.rpartition("/")[2]: of for t, of in messages.items()}
    types = {p.name: text_of(p.type).rpartition("::")[2] for p in function.parameters}
    for node in inside(function.body, "field_expression") if function.body is not None else ():
        type_, name = types.get(text_of(part(node, "argument")), ""), text_of(part(node, "field"))
        if type_ in fields and name not in fields[type_]:
            why = f'messages of {type_} have no field "{name}"'
            yield function.cpp.source, Unread(function.cpp.span(node), f"{_ASKED}: {why}")
