"""What the rooms of the type inference ask of each other."""

from __future__ import annotations

from typing import Protocol

from rebsync.reverse.analysis.python.value_types import ValueTypes
from rebsync.reverse.analysis.stores import Source
from rebsync.reverse.ir import expressions as e


class TypeQueries(Protocol):
    """The types of the values of one program."""

    def of(self, value: e.Expression, function: str) -> ValueTypes:
        """The types of what an expression of a function may be."""

    def of_member(self, name: str, owner: str | None) -> ValueTypes:
        """The types of an attribute, of objects of a class if methods of that ask their own."""

    def of_stored(self, stored: Source) -> ValueTypes:
        """The types of what is stored somewhere."""

    def result(self, function: str) -> ValueTypes:
        """The types of what a function of the program gives."""

    def element(self, value: e.Expression | e.Spread, function: str) -> ValueTypes:
        """The types of what stands in a container, None among them."""

    def contents(self) -> ValueTypes:
        """What is put into containers, each time as one of its site."""
