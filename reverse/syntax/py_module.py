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


# Each import of a package asks this of the modules that it may mean.
@lru_cache(maxsize=128)
def bound_in(text: str) -> frozenset[str] | None:
    """The names that a module binds for who imports it; None where only a run tells them all."""
    tree = module_of(text)
    if tree is None:
        return None
    found: set[str] = set()
    for node in ast.walk(tree):
        match node:
            case ast.ImportFrom(names=[ast.alias(name="*")]):
                return None
            case ast.Name(id="globals" | "global_enum" | "exec") | ast.Attribute(attr="_convert_"):
                return None
            case ast.Global(names=names):
                found.update(names)
            case _:
                pass
    found.update(("__name__", "__doc__", "__file__"), *map(_bound, tree.body))
    return frozenset(found) if "__getattr__" not in found else None


def _bound(node: ast.AST) -> frozenset[str]:
    """The names that a statement at the top binds, with those inside it."""
    match node:
        case ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name) | ast.ClassDef(name=name):
            return frozenset({name})
        case ast.Import(names=names) | ast.ImportFrom(names=names):
            return frozenset((a.asname or a.name).partition(".")[0] for a in names)
        case ast.ExceptHandler(name=str(name)):
            inner = frozenset({name})
        case ast.Name(id=name, ctx=ast.Store()):
            return frozenset({name})
        case ast.Lambda() | ast.ListComp() | ast.SetComp() | ast.DictComp() | ast.GeneratorExp():
            return frozenset()
        case _:
            inner = frozenset()
    return inner.union(*map(_bound, ast.iter_child_nodes(node)))
