"""Modules of Python as Python's own parser has them: for what runs when a module is imported."""

from __future__ import annotations

import ast
import warnings
from functools import lru_cache


# Several readers ask for the same few modules of a package, and a merge reads packages again.
@lru_cache(maxsize=128)
def module_of(text: str) -> ast.Module | None:
    """The tree of a module, which nobody changes; None of what is no Python."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return ast.parse(text)
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            return None
