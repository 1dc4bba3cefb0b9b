"""The interface between the parts of the evaluator of C++, and their state."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import field
from typing import TypeVar

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.graph import Unresolved
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.values.cpp_flow import Texts
from rebsync.reverse.values.cpp_flow_calls import Calls
from rebsync.reverse.values.cpp_flow_types import Types
from rebsync.reverse.values.cpp_values_plain import (
    TOO_MANY,
    Frame,
    Value,
    at,
    is_large,
    ways,
)

T = TypeVar("T")


@dataclass(slots=True)
class CppEvaluator(ABC):
    """Finds the values of expressions in some code."""

    code: Code
    texts: Texts = field(init=False)
    types: Types = field(init=False)
    calls: Calls = field(init=False)
    # What functions return, by their nodes.
    returns: dict[int, list[Node]] = field(default_factory=dict)
    # Whether there were more ways than are followed.
    truncated: bool = False
    # How often a value was asked for while it was looked for: what comes of it is not kept.
    cuts: int = 0

    def unknown(self, why: str, node: Node, frame: Frame, partial: str | None = None) -> Unresolved:
        """An unknown value."""
        return Unresolved(why, at(frame.cpp, node), partial)

    def bounded(self, value: Value, node: Node, frame: Frame) -> Value:
        """A value, or an unknown one for one that has too many parts."""
        return value if not is_large(value) else self.unknown(TOO_MANY, node, frame)

    def holds(self, condition: Node, frame: Frame) -> bool | None:
        """Whether a condition is met; None if that is not known."""
        if condition.end_byte - condition.start_byte > 120:
            return None
        known = list(ways(self.value(condition, frame)))
        match known:
            case [bool() | int() | float()]:
                return bool(known[0])
            case _:
                return None

    @abstractmethod
    def settle_all(
        self, frames: list[Frame], do: Callable[[Frame], T], used: list[Frame] | None = None
    ) -> list[T]:
        """What `do` gives in frames; if it asks for open parameters, for each of the callers."""

    @abstractmethod
    def value(self, node: Node, frame: Frame) -> Value:
        """The value of an expression in a frame. Open: it needs the frame's callers."""
