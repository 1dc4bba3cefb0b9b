"""The program that people's own modules in a generated package are."""

from __future__ import annotations

from dataclasses import replace

from rebsync.reverse.analysis.outcomes.outcomes import OutcomeAnalysis
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.ir.program import Function, Program
from rebsync.reverse.ir.python.lowering import python_program
from rebsync.reverse.ir.walk import walk
from rebsync.reverse.libraries.outcomes import LibraryOutcomes, MessageFields, no_fields
from rebsync.reverse.libraries.routines import Language
from rebsync.reverse.syntax.py_index import PyCode
from rebsync.reverse.syntax.py_runtime_files import is_runtime_file
from rebsync.source import Span


class PeopleProgram:
    """`generated` are the paths of the modules of classes and of the run-time part, `classes` the
    names in the form of further classes of the model, of which the modules are looked at.
    """

    def __init__(
        self,
        code: PyCode,
        generated: frozenset[str],
        fields: MessageFields = no_fields,
        classes: frozenset[str] = frozenset(),
    ) -> None:
        self.own_classes = classes
        self.whole = python_program(code)
        self.code = code
        self.generated = generated
        given = self.whole
        own = [name for name in given.functions if not self.is_model(name)]
        people = [c for c in given.classes.values() if not self.is_model(c.name)]
        self.program = Program(own, people, given.function, given.modules.items())
        folders = {part for path in code.modules for part in path.split("/")[:-1]}
        modules = {path.rpartition("/")[2].removesuffix(".py") for path in code.modules}
        opaque = frozenset(folders | modules) - {"", "src"}
        self.table = LibraryOutcomes(Language.PYTHON, opaque, fields=fields)

    def is_model(self, name: str) -> bool:
        """Whether a module or function is of the generated classes or run-time part."""
        path, _, function = name.partition(":")
        if path not in self.code.modules:
            return False
        if f"{path}:{function.partition('.')[0]}" in self.own_classes:
            return True
        source = self.code.modules[path].py.source
        if not function or is_runtime_file(source):
            return source.path in self.generated
        return source.path in self.generated and ("." in function or function[:1].isupper())

    def outcomes(self, program: Program | None = None) -> OutcomeAnalysis:
        """How functions end, and what they do besides giving a value."""
        return OutcomeAnalysis(program or self.program, self.table, self.is_model)

    def imported(self) -> Program:
        """The program as modules run that others import, and none looks at for its types."""

        def lowered(name: str) -> Function:
            function = self.program.function(name)
            is_module = name in self.code.modules
            return replace(function, body=_imported(function.body)) if is_module else function

        given = self.program
        return Program(given.functions, given.classes.values(), lowered, given.modules.items())


def _imported(body: s.Body) -> s.Body:
    """The statements of a module that run when another one imports it."""
    found: list[s.Statement] = []
    for node in body:
        match node:
            case s.If(test=e.LibraryReference("typing.TYPE_CHECKING"), otherwise=others):
                found += _imported(others)
            case s.If(
                test=e.Binary(Operator.EQUAL, e.Global(_, "__name__"), e.Literal("__main__")),
                otherwise=others,
            ):
                found += _imported(others)
            case _:
                found.append(node)
    return tuple(found)


def is_import(function: Function, place: Span) -> bool:
    """Whether a function imports something at a place."""
    return any(isinstance(n, s.Import) and n.place == place for n in walk(function.body))
