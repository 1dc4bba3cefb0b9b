"""What readers of bodies in C++ ask of the intermediate form, by nodes of the trees."""

from __future__ import annotations

from functools import cached_property

from tree_sitter import Node

from rebsync.reverse.analysis.loop_endings import ProgramLoops
from rebsync.reverse.ir.cpp.functions import lambda_names
from rebsync.reverse.ir.cpp.lowering import CppLowering
from rebsync.reverse.ir.cpp.symbols import FunctionSymbol
from rebsync.reverse.libraries.outcomes import LibraryOutcomes
from rebsync.reverse.libraries.routines import Language
from rebsync.reverse.syntax.ancestors import ancestors
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
    def _functions(self) -> dict[int, FunctionSymbol]:
        """The functions that have a body, by their nodes."""
        symbols = self._lowering.world.symbols.functions.values()
        return {f.code.node.id: f for f in symbols if f.code.body is not None}

    def ends(self, cpp: Cpp, loop: Node) -> bool:
        """Whether a loop in a function ends, if what stands in it does."""
        name = self._around(loop)
        return name is not None and self._loops.ends(name, cpp.span(loop))

    def _around(self, node: Node) -> str | None:
        """The name of the function or lambda that a node stands in; None if it is in none."""
        around = [n for n in ancestors(node) if n.type in _FUNCTIONS]
        symbol = next((self._functions[n.id] for n in around if n.id in self._functions), None)
        if symbol is None:
            return None
        if around[0].type == "function_definition":
            return symbol.name
        owner = self._lowering.world.symbols.classes.get(symbol.owner or "")
        return lambda_names(symbol, owner).get(around[0].id)
