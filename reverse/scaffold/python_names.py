"""Trees of generated Python with texts in place of their names, and calls for partial ones."""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Iterator

from rebsync.reverse.scaffold.python_trees import bindings


def resolved(tree: ast.Module) -> ast.Module:
    """The same tree, which changes for that; a name is followed if nothing else ever binds it."""
    bound = Counter(name for node in ast.walk(tree) for name in _bound(node))
    texts = {n: v for s in tree.body for n, v in _texts(s) if bound[n] == 1}
    partial = {n for n, (of, _) in bindings(tree).items() if of == "functools.partial"}
    partial |= {f"{n}.partial" for n, (of, _) in bindings(tree).items() if of == "functools"}
    partial = {name for name in partial if bound[name.partition(".")[0]] == 1}
    found = _Resolved(texts, partial, bound).visit(tree)
    assert isinstance(found, ast.Module)
    return found


def _texts(statement: ast.stmt) -> Iterator[tuple[str, ast.Constant]]:
    """The name that a statement gives a text."""
    match statement:
        case ast.Assign([ast.Name(name)], ast.Constant(str()) as value):
            yield name, value
        case ast.AnnAssign(ast.Name(name), _, ast.Constant(str()) as value):
            yield name, value
        case _:
            pass


def _bound(node: ast.AST) -> Iterator[str]:
    """The names that a node of a tree binds."""
    match node:
        case ast.Name(name, ast.Store() | ast.Del()):
            yield name
        case ast.FunctionDef(name) | ast.AsyncFunctionDef(name) | ast.ClassDef(name):
            yield name
        case ast.arg(name) | ast.ExceptHandler(_, str(name)):
            yield name
        case ast.MatchAs(_, str(name)) | ast.MatchStar(str(name)):
            yield name
        case ast.MatchMapping(_, _, str(name)):
            yield name
        case ast.alias(name, other):
            yield other or name.partition(".")[0]
        case ast.Global(names) | ast.Nonlocal(names):
            yield from names
        case _:
            pass


class _Resolved(ast.NodeTransformer):
    def __init__(
        self, texts: dict[str, ast.Constant], partial: set[str], bound: Counter[str]
    ) -> None:
        self.texts, self.partial, self.bound = texts, partial, bound
        self.own = Counter[str]()

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        around, self.own = self.own, Counter(n for each in ast.walk(node) for n in _bound(each))
        self.generic_visit(node)
        self.own = around
        return node

    def visit_Name(self, node: ast.Name) -> ast.AST:
        is_text = isinstance(node.ctx, ast.Load) and node.id in self.texts
        return ast.copy_location(ast.Constant(self.texts[node.id].value), node) if is_text else node

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """`partial(f, x)` as `lambda: f(x)`, which asks later for what does not change.

        What a descriptor is given by name, it is given by place.
        """
        self.generic_visit(node)
        names, takes = [k.arg for k in node.keywords], ["name", "rank"][len(node.args) :]
        if ast.unparse(node.func) == "Server" and names == takes[: len(names)]:
            node.args += [k.value for k in node.keywords]
            node.keywords = []
        is_partial = ast.unparse(node.func) in self.partial and not node.keywords
        if not is_partial or not all(map(self._is_steady, node.args[1:])):
            return node
        nothing = ast.arguments([], [], None, [], [], None, [])
        return ast.copy_location(
            ast.Lambda(nothing, ast.Call(node.args[0], node.args[1:], [])), node
        )

    def _is_steady(self, node: ast.expr) -> bool:
        """Whether a value is a constant, or a name that the function binds once."""
        if isinstance(node, ast.Name):
            return self.own[node.id] == 1
        return isinstance(node, ast.Constant)
