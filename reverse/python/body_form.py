"""What readers of bodies in Python ask of the intermediate form, by nodes of the trees."""

from __future__ import annotations

from functools import cached_property

from tree_sitter import Node

from rebsync.reverse.analysis.loop_endings import ProgramLoops
from rebsync.reverse.analysis.origins import Origins
from rebsync.reverse.ir.program import Program
from rebsync.reverse.ir.python.lowering import python_program
from rebsync.reverse.libraries.outcomes import LibraryOutcomes
from rebsync.reverse.libraries.routines import Language
from rebsync.reverse.python.py_index import PyCode
from rebsync.reverse.python.py_tree import Py


class PyForm:
    """The form of some modules, of which nothing is lowered before something is asked."""

    def __init__(self, code: PyCode) -> None:
        self._code = code

    @cached_property
    def program(self) -> Program:
        """The functions and classes of the modules."""
        return python_program(self._code)

    @cached_property
    def _origins(self) -> Origins:
        return Origins.of_program(self.program, LibraryOutcomes(Language.PYTHON))

    @cached_property
    def _loops(self) -> ProgramLoops:
        return ProgramLoops(self._origins)

    def ends(self, py: Py, loop: Node) -> bool:
        """Whether a loop ends, if what it goes through does, and what stands in it."""
        place = py.span(loop)
        paths = (path for path, module in self._code.modules.items() if module.py is py)
        return any(
            self._loops.ends(name, place)
            for path in paths
            for name in self.program.functions
            if name == path or name.startswith(f"{path}:")
        )
