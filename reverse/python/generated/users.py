"""Users' own blocks in the bodies of generated Python, which no model describes.

They may look at what the model has, and do what they like with the rest.
"""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterator
from functools import lru_cache

from tree_sitter import Node

from rebsync.reverse.analysis.outcomes.outcomes import OutcomeAnalysis
from rebsync.reverse.analysis.problems import Problem
from rebsync.reverse.generated.user_blocks import user_blocks
from rebsync.reverse.ir.program import innermost
from rebsync.reverse.ir.python.lowering import python_program
from rebsync.reverse.libraries.outcomes import LibraryOutcomes
from rebsync.reverse.libraries.routines import Language
from rebsync.reverse.python.generated.expression_reader import ModelExpressionReader
from rebsync.reverse.python.generated.slicing.log_words import HARMLESS
from rebsync.reverse.syntax.py_index import PyCode
from rebsync.reverse.syntax.py_module import module_of
from rebsync.reverse.syntax.py_tree import Py, field, named, text_of
from rebsync.source import Source, Span

_LEAVING = frozenset(
    {"return_statement", "break_statement", "continue_statement", "raise_statement", "yield"}
)
_PLAIN = frozenset({"values", "msg", "srv"})  # modules of a package that only have values
_STORING = {
    "assignment": "left",
    "augmented_assignment": "left",
    "for_statement": "left",
    "named_expression": "name",
    "as_pattern_target": "",
    "delete_statement": "",
    "for_in_clause": "left",
}
_FILES = "builtins.OSError"


def is_users(reader: ModelExpressionReader, node: Node) -> bool:
    """Whether a statement stands between `rebsync: user NAME` and `rebsync: end`."""
    span = reader.py.span(node)
    return any(b.holds(span) for b in user_blocks(reader.py.source.text))


def check(reader: ModelExpressionReader, node: Node) -> None:
    """Unread: a statement of a user's block does something to what the model has."""
    _check_part(reader, node)
    effects = _effects_of(reader.py, _modelled(reader.py.source))
    for problem in effects.acting(reader.py.span(node)):
        raise reader.unread(node, f"in a user's block: {problem.why}")


@lru_cache(maxsize=8)
def _modelled(source: Source) -> frozenset[str]:
    """What a module imports of the package but for plain values, by full names."""
    tree = module_of(source.text) or ast.Module([], [])
    own = source.path.rpartition("/")[0].rpartition("/")[2]
    imports = (n for n in ast.walk(tree) if isinstance(n, ast.ImportFrom))
    return frozenset(
        f"{'.' * node.level}{node.module or ''}.{a.name}"
        for node in imports
        for a in node.names
        if _is_of_package(node, own) and (node.module or "").rpartition(".")[2] not in _PLAIN
    )


def _is_of_package(node: ast.ImportFrom, own: str) -> bool:
    return node.level > 0 or (node.module or "").partition(".")[0] == own


def _check_part(reader: ModelExpressionReader, node: Node) -> None:
    if node.type in _LEAVING:
        raise reader.unread(node, "a user's block must be run through")
    if node.type in _STORING:
        target = field(node, _STORING[node.type]) if _STORING[node.type] else node
        for each in named(target) or [target]:
            _check_stored(reader, each)
    if node.type in ("identifier", "attribute"):
        _check_name(reader, node)
        return
    for child in named(node):
        _check_part(reader, child)


def _check_stored(reader: ModelExpressionReader, target: Node) -> None:
    base = target
    while base.type == "subscript":
        base = named(base)[0]
    text = text_of(base)
    hides = text in reader.locals or text in reader.names.constants
    if hides or text.removeprefix("self.") in reader.names.variables:
        raise reader.unread(
            target, f"\"{text}\" is the model's, which a user's block only looks at"
        )


def _check_name(reader: ModelExpressionReader, node: Node) -> None:
    """What a block may name: values of the model, but no function of it, nor a whole array."""
    text = text_of(node)
    holder, _, name = text.partition(".")
    if holder != "self":
        return
    own = name.partition(".")[0]
    does = own in reader.names.sends or own in reader.names.functions
    if not own or does or own in ("_mailbox", "_drive"):
        raise reader.unread(node, f'"{text}" does what a model shows, in a user\'s block')
    variable = reader.names.variables.get(own)
    type_ = reader.names.types.get(variable or "")
    if type_ is not None and type_.dimensions and not _is_looked_at(node):
        raise reader.unread(node, f'"{text}" might be changed in a user\'s block')


def _is_looked_at(node: Node) -> bool:
    above = node.parent
    if above is not None and above.type == "argument_list" and above.parent is not None:
        called = text_of(field(above.parent, "function")).rpartition(".")[2]
        return called in HARMLESS
    return above is not None and above.type in ("subscript", "interpolation", "comparison_operator")


class _UserEffects:
    """The effects of users' blocks of a module, by what the form says of their statements.

    What they compute, keep for themselves and write to files is theirs; the rebec, its messages and
    its time are the model's. Errors of files do not count: that they may be is said of no block.
    `modelled` are modules that have to do with the model.
    """

    def __init__(self, py: Py, modelled: Collection[str]) -> None:
        self.program = python_program(PyCode.of([py]))
        table = LibraryOutcomes(Language.PYTHON, frozenset(modelled))
        self.analysis = OutcomeAnalysis(self.program, table, self._is_model)

    @staticmethod
    def _is_model(name: str) -> bool:
        """Whether a function is one of a class of the module."""
        return "." in name.partition(":")[2]

    def acting(self, span: Span) -> Iterator[Problem]:
        """What the statements at a place may do besides to compute."""
        function = innermost(map(self.program.function, self.program.functions), span)
        found = self.analysis.of_statements(function, span) if function is not None else ()
        yield from sorted((p for p in found if p.raises != _FILES), key=str)


@lru_cache(maxsize=8)
def _effects_of(py: Py, modelled: frozenset[str]) -> _UserEffects:
    """The effects of a module, read once."""
    return _UserEffects(py, modelled)
