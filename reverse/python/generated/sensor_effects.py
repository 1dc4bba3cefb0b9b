"""What functions of Python do that say what a sensor saw: their effects besides a value.

Whatever they give is among the model's choices. They get messages of the type that the sensor has
in the class, whatever they are annotated with.
"""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace
from functools import cached_property

from rebsync.reverse.analysis.origins import FunctionOrigin, Origins
from rebsync.reverse.analysis.outcomes.outcomes import OutcomeAnalysis
from rebsync.reverse.analysis.python.argument_types import message_name
from rebsync.reverse.build.message_types import MessageTypes
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.generated.sensors import sensor_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.program import Function, Program
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.python.generated.people_program import PeopleProgram
from rebsync.reverse.syntax.py_index import PyCode
from rebsync.reverse.syntax.py_module import module_of
from rebsync.source import Source, Span

_ASKED = "this runs when it is asked what a sensor saw"
_UNKNOWN = "only a function of a module says what a sensor saw"
# What a function is made of that only gives a value of what it gets.
_PLAIN = (ast.Return, ast.Attribute, ast.Name, ast.Constant, ast.expr_context)


def list_sensor_effects(
    code: PyCode, generated: Collection[str], types: MessageTypes, findings: Findings
) -> None:
    """Lists what modules do where generated ones, by their paths, ask what a sensor saw."""
    texts = {path: scope.py.source for path, scope in code.modules.items()}
    asked = [
        (path, given, _message(source, given))
        for path, source in texts.items()
        if source.path in generated and ".choose(" in source.text
        for given in _given(source)
    ]
    fields = {
        message: types.python_fields(message, types.has_octets) for *_, message in asked if message
    }
    if all(_is_plain(texts, given, fields.get(message)) for _, given, message in asked):
        return
    sensors = _SensorModules(code, frozenset(generated), fields.get)
    for path, given, message in asked:
        for source, span, why in sensors.acting(path, given, message):
            start = source.text.rfind("\n", 0, span.start) + 1
            line = source.text[start:].partition("\n")[0]
            findings.unreadable(source, Unread(Span(start, start + len(line)), why), "")


def _given(source: Source) -> list[ast.expr]:
    """What choices of the model are handed besides: what a sensor makes of its message."""
    found = []
    for node in ast.walk(module_of(source.text) or ast.Module([], [])):
        match node:
            case ast.Call(func=ast.Attribute(attr="choose"), args=[_, given]):
                found.append(given)
            case _:
                pass
    return found


def _looked(given: ast.expr) -> ast.expr | None:
    """What a sensor is handed, to say what it saw; None where no sensor is asked."""
    match given:
        case ast.Call(
            func=ast.Attribute(ast.Attribute(ast.Name("self"), member), "seen"), args=[looked]
        ) if sensor_of(member) is not None:
            return looked
        case _:
            return None


def _message(source: Source, given: ast.expr) -> str:
    """The type of the messages that the sensor which is asked gets; empty if that is not told."""
    match given:
        case ast.Call(func=ast.Attribute(ast.Attribute(ast.Name("self"), member))):
            pass
        case _:
            return ""
    types, names = set[str](), dict[str, str]()
    for node in ast.walk(module_of(source.text) or ast.Module([], [])):
        match node:
            case ast.Assign([ast.Attribute(_, attr)], ast.Call(args=[*_, ast.Name(type_)])) if (
                attr == member
            ):
                types.add(type_)
            case ast.ImportFrom(str(module)):
                names |= {a.asname or a.name: f"{module}.{a.name}" for a in node.names}
            case _:
                pass
    found = {message_name(names.get(name, "")) for name in types}
    return (found.pop() or "") if len(found) == 1 else ""


def _is_plain(texts: dict[str, Source], given: ast.expr, fields: Mapping[str, str] | None) -> bool:
    """Whether all functions of a name only give a field of what they get, as generated ones do."""
    looked = _looked(given)
    if not isinstance(looked, ast.Name):
        return False
    trees = (module_of(t.text) for t in texts.values() if f"def {looked.id}(" in t.text)
    nodes = (n for tree in trees if tree is not None for n in ast.walk(tree))
    functions = [n for n in nodes if isinstance(n, ast.FunctionDef) and n.name == looked.id]
    bodies = [n for f in functions for body in f.body for n in ast.walk(body)]
    asked = {n.attr for n in bodies if isinstance(n, ast.Attribute)}
    is_there = fields is None or asked <= fields.keys()
    return is_there and bool(functions) and all(isinstance(n, _PLAIN) for n in bodies)


class _SensorModules(PeopleProgram):
    """The program of a package, with what its values may be."""

    @cached_property
    def origins(self) -> Origins:
        return Origins.of_program(self.program, self.table)

    def analysis(self, names: Collection[str], message: str) -> OutcomeAnalysis:
        """How functions end where these get messages of a type."""

        def lowered(name: str) -> Function:
            function = self.program.function(name)
            if name not in names or not function.parameters or not message:
                return function
            first, *others = function.parameters
            typed = (replace(first, type=t.RosMessage(message)), *others)
            return replace(function, parameters=typed)

        given = self.program
        program = Program(given.functions, given.classes.values(), lowered, given.modules.items())
        return self.outcomes(program)

    def acting(
        self, path: str, given: ast.expr, message: str
    ) -> Iterator[tuple[Source, Span, str]]:
        """The places that may do more than to say what was seen in a message of a type."""
        source = self.code.modules[path].py.source
        place = _place(source, given)
        looked = _looked(given)
        if looked is None:
            yield source, place, "no sensor is asked here"
            return
        names = self._functions(path, source, looked)
        if not names:
            yield source, place, _UNKNOWN
        analysis = self.analysis(names, message)
        found = {problem for name in names for problem in analysis.of(name)}
        for problem in sorted(found, key=lambda p: (p.function, p.place.start, p.why)):
            of = self.code.modules[problem.function.partition(":")[0]].py.source
            yield of, problem.place, f"{_ASKED}: {problem.why}"

    def _functions(self, path: str, source: Source, looked: ast.expr) -> list[str]:
        """The functions that say what was seen."""
        if isinstance(looked, ast.Lambda):
            start = _place(source, looked).start
            inner = (n for n in self.whole.functions if n.startswith(f"{path}:"))
            lambdas = (n for n in inner if "<lambda" in n)
            return [n for n in lambdas if self.whole.function(n).place.start == start]
        if not isinstance(looked, ast.Name):
            return []
        name = looked.id
        values: list[e.Expression] = [e.Global(path, name)]
        for node in walk(self.whole.function(path)):
            match node:
                case s.Import(e.Global(_, bound), module, item, True) if bound == name and item:
                    values.append(e.Global(module, item))
                case _:
                    pass
        held = {origin for value in values for origin in self.origins.of(value, "")}
        return sorted({o.name for o in held if isinstance(o, FunctionOrigin)})


def _place(source: Source, node: ast.expr) -> Span:
    """Where a node stands, in characters."""
    line = source.start_of(node.lineno)
    text = source.text[line:].encode()
    start = line + len(text[: node.col_offset].decode())
    return Span(start, start + 1)
