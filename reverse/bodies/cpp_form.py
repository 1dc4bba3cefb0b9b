"""What readers of bodies in C++ ask of the intermediate form, by nodes of the trees."""

from __future__ import annotations

from functools import cached_property

from tree_sitter import Node

from rebsync.reverse.analysis.loop_endings import ProgramLoops
from rebsync.reverse.ir.cpp.functions import lambda_names
from rebsync.reverse.ir.cpp.lowering import CppLowering
from rebsync.reverse.libraries.outcomes import LibraryOutcomes
from rebsync.reverse.libraries.routines import Language
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import Cpp

_FUNCTIONS = frozenset({"function_definition", "lambda_expression"})


class CppForm:
    """The form of some files, of which nothing is lowered before something is asked."""

    def __init__(self, code: Code) -> None:
        self._code = code

    @cached_property
    def _lowering(self) -> CppLowering:
        return CppLowering(self._code)

    @cached_property
    def _loops(self) -> ProgramLoops:
        macros = frozenset(self._code.macros)
        return ProgramLoops(self._lowering.program(), LibraryOutcomes(Language.CPP, macros))

    @cached_property
    def _names(self) -> dict[int, str]:
        """The names of functions in the form, lambdas included, by their nodes."""
        symbols = self._lowering.world.symbols
        found: dict[int, str] = {}
        for name, symbol in symbols.functions.items():
            if symbol.code.body is not None:
                found[symbol.code.node.id] = name
                found |= lambda_names(symbol, symbols.classes.get(symbol.owner or ""))
        return found

    def ends(self, cpp: Cpp, loop: Node) -> bool:
        """Whether a loop in a function ends, if what stands in it does."""
        around = climb(loop, lambda node: node.type in _FUNCTIONS)
        name = self._names.get(around.id) if around is not None else None
        return name is not None and self._loops.ends(name, cpp.span(loop))
