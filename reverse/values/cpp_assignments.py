"""What a variable of C++ may hold: the interface by which its parts call each other."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import field

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.values.cpp_evaluator import CppEvaluator
from rebsync.reverse.values.cpp_flow_types import Variable
from rebsync.reverse.values.cpp_flow_writes import (
    Writes,
)
from rebsync.reverse.values.cpp_values_plain import (
    Frame,
    Value,
)


@dataclass(slots=True)
class CppAssignments(ABC):
    """Finds the values of variables; `values` those of the expressions that they are given."""

    values: CppEvaluator
    writes: Writes = field(init=False)

    @abstractmethod
    def ways_to(
        self, variable: Variable, path: str, node: Node | None, frame: Frame
    ) -> tuple[list[Value], bool]:
        """What may be put into a variable before a place, latest first; whether surely one is."""

    @abstractmethod
    def initial(self, variable: Variable, path: str) -> Value:
        """What a member or global holds by its declaration."""
