"""The interface between the parts of the writer of Python expressions, and their state."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import field

from rebsync import model as m
from rebsync.forward.py_names import PyNames
from rebsync.forward.topics import Topics
from rebsync.names import unique
from rebsync.records import dataclass
from rebsync.static import Analysis


@dataclass(slots=True)
class PyExpressionWriter(ABC):
    """Prints the expressions of one class.

    `seen` has what samples the sensor of a draw; `locals` the names of local variables, by their
    declaration; `used` are all names of a body, of its class and of the module.
    """

    analysis: Analysis
    topics: Topics
    names: PyNames
    class_types: dict[str, str]
    seen: dict[int, str]
    locals: dict[int, str] = field(default_factory=dict)
    used: set[str] = field(default_factory=set)

    def type_of(self, expression: m.Expression) -> m.Type | None:
        """The static type of an expression."""
        return self.analysis.types.get(id(expression))

    def temporary(self, name: str) -> str:
        """A name for a value that is needed twice, with a number behind it where that is used."""
        return unique(name, self.used, "")

    @abstractmethod
    def text(self, expression: m.Expression) -> str:
        """The expression, of exactly the value that it has in the model."""

    @abstractmethod
    def stored(self, expression: m.Expression, type_: m.Type) -> str:
        """The expression as it is stored in a variable of a type."""

    @abstractmethod
    def operand(self, expression: m.Expression, least: int, exact: bool = True) -> str:
        """The expression as an operand of an operator that binds at a level."""
