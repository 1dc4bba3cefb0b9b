"""What classes and functions of generated Python are, by their markers, names and decorators."""

from __future__ import annotations

from rebsync.reverse.python.generated.py_types import markers_above
from rebsync.reverse.syntax.py_index import Scope


def is_marked(owner: Scope) -> bool:
    """Whether a marker says that a class is one of the model."""
    kinds = ("interface ", "reactiveclass ")
    return any(x.startswith(kinds) for x in markers_above(owner.py, owner.node))


def is_constructor(name: str) -> bool:
    """Whether a function of that name is a constructor of the model."""
    return name == "construct" or name.startswith("construct__")


def is_abstract(function: Scope) -> bool:
    """Whether a function has no body in the model."""
    return "abstractmethod" in function.decorators
