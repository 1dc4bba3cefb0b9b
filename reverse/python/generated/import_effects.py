"""What modules that people wrote do when generated code imports them, by their top statements.

An import runs a module from its first statement to its last: what of this is not known to do
nothing but to bind names may change the run-time part, the environment, or the library of ROS.
"""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterable, Mapping, Sequence

from tree_sitter import Node

from rebsync.reverse.analysis.outcomes.outcome_calls import UNKNOWN_CALL
from rebsync.reverse.analysis.problems import Problem
from rebsync.reverse.build.built_python import files_of_import, imported_by
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.python.generated.imported_code import IN_SETUP, PLAIN, ImportedCode, LaunchCode
from rebsync.reverse.python.generated.people_program import PeopleProgram, is_import
from rebsync.reverse.syntax.py_index import PyCode, Scope
from rebsync.reverse.syntax.py_module import module_of
from rebsync.reverse.syntax.py_runtime_files import is_runtime_file
from rebsync.source import NOWHERE, Source, Span

_WHY = "this runs when the module is imported: what it does is not in the model"


def list_import_effects(
    sources: Mapping[str, Source], code: PyCode, generated: Collection[str], findings: Findings
) -> None:
    """Lists what modules do that generated ones import; these are given by their paths.

    `sources` have paths within the package, as imports name them.
    """
    trees = {path: module_of(source.text) for path, source in sources.items()}
    reached = set[str]()
    waiting = [path for path, source in sources.items() if source.path in generated]
    while waiting:
        path = waiting.pop()
        tree = trees[path]
        names = imported_by(tree) if tree is not None else ()
        fresh = {p for n in names for p in files_of_import(n, path, sources)} - reached
        reached |= fresh
        waiting += fresh
    # What cannot be parsed is listed, and what is generated is read itself.
    own = {sources[p]: tree for p in sorted(reached) if (tree := trees[p]) is not None}
    own = {source: tree for source, tree in own.items() if source.path not in generated}
    acting = _acting_when_imported(code, generated, [s.path for s in own]) if own else {}
    for source, tree in own.items():
        lines = {n.lineno for n in ImportedCode(tree).acting()} | acting[source.path]
        _list(source, sorted(lines), findings)


def _acting_when_imported(
    code: PyCode, generated: Collection[str], paths: Collection[str]
) -> dict[str, set[int]]:
    """The lines of modules, by their paths, at which an import of them may act, by their form."""
    people = PeopleProgram(code, frozenset(generated))
    program = people.imported()
    outcomes = people.outcomes(program)
    found = {path: set[int]() for path in paths}
    # What a module lacks is asked of its `__getattr__`, by imports of names as well.
    run = [n for path in paths for n in (path, f"{path}:__getattr__") if n in program.functions]
    for problem in (problem for name in run for problem in outcomes.of(name)):
        of = problem.function.partition(":")[0]
        if of in found and not is_import(program.function(problem.function), problem.place):
            source = code.modules[of].py.source
            around = program.function(problem.function).place
            place = problem.place if problem.place != NOWHERE else around
            is_made = _is_made_decorator(problem, source)
            found[of] |= set() if is_made else {source.position(place.start).line}
    return found


def _is_made_decorator(problem: Problem, source: Source) -> bool:
    """Whether decorators are called of which all are a library's, perhaps made with constants."""
    if problem.why != UNKNOWN_CALL:
        return False
    code = ImportedCode(module_of(source.text) or ast.Module([], []))
    line = source.position(problem.place.start).line
    nodes = (n for n in ast.walk(code.tree) if isinstance(n, ast.ClassDef | ast.FunctionDef))
    decorators = (n.decorator_list for n in nodes)
    return any(
        of and of[0].lineno == line and all(map(code.is_library_decorator, of)) for of in decorators
    )


def list_definition_effects(source: Source, own: Collection[str], findings: Findings) -> None:
    """Lists what runs in a module of generated classes when functions and classes are defined.

    `own` are the names of these classes, which are read themselves.
    """
    tree = module_of(source.text)
    if tree is not None:
        package = source.path.split("/")[-2:][0]
        made = {"values.When", f"{package}.values.When"}
        acting = ImportedCode(tree, PLAIN | made).defining(own)
        _list(source, [n.lineno for n in acting], findings)


def acting_lines(
    code: PyCode, module: Scope, own: Collection[str], statements: Sequence[Node]
) -> frozenset[int] | None:
    """The lines of a module of classes at which statements stand that may do more than bind names.

    `own` are the names of these classes, `statements` those of its top that nothing else reads.
    None: Python takes no such module.
    """
    tree = module_of(module.py.source.text)
    if tree is None:
        return None
    source = module.py.source
    modules = {path: each.py.source for path, each in code.modules.items()}
    path = next(path for path, each in modules.items() if each is source)
    runtime = frozenset(s.path for s in modules.values() if is_runtime_file(s))
    people = PeopleProgram(code, runtime, classes=frozenset(f"{path}:{name}" for name in own))
    program = people.imported()
    outcomes = people.outcomes(program)
    acting = (
        node.start_point.row + 1
        for node in statements
        for problem in outcomes.of_statements(program.function(path), module.py.span(node))
        if not problem.raises
        and not is_import(program.function(problem.function), problem.place)
        and not _is_made_decorator(problem, source)
    )
    return frozenset(acting) | {node.lineno for node in ImportedCode(tree).acting()}


def list_setup_effects(source: Source, findings: Findings) -> None:
    """Lists what `setup.py` does besides to say what is installed."""
    tree = module_of(source.text)
    if tree is not None:
        code = ImportedCode(tree, IN_SETUP)
        classes = (n for n in ast.walk(tree) if isinstance(n, ast.ClassDef))
        methods = (n for of in classes for n in of.body if isinstance(n, ast.FunctionDef))
        acting = [*code.acting(), *(n for method in methods for n in code.acting_in(method))]
        _list(source, [n.lineno for n in acting], findings)


def list_launch_effects(source: Source, findings: Findings) -> None:
    """Lists what a launch file does itself besides to describe what is started."""
    tree = module_of(source.text)
    if tree is None:
        return
    code = LaunchCode(tree)
    functions = (n for n in ast.walk(tree) if isinstance(n, ast.FunctionDef))
    acting = [*code.acting(), *(n for function in functions for n in code.acting_in(function))]
    _list(source, [n.lineno for n in acting], findings)


def _list(source: Source, lines: Iterable[int], findings: Findings) -> None:
    for number in lines:
        start = source.start_of(number)
        line = source.text[start:].partition("\n")[0]
        findings.unreadable(source, Unread(Span(start, start + len(line)), _WHY), "")
