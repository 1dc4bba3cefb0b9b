"""Which description of a launch file in Python counts: the one that its function gives back.

`ros2 launch` calls the function that the name `generate_launch_description` is bound to once the
module has run, and starts what is in the `LaunchDescription` that this gives back. A second
function of the name, a `return` before another, and a description that nobody gives back change
what is started, though every node still stands in the text.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator, Mapping
from typing import TypeAlias

from rebsync.reverse.launch.python_arguments import called

_FUNCTION = "generate_launch_description"
_SCOPES = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.Lambda)
_Place: TypeAlias = "ast.stmt | ast.expr"


def misleading(tree: ast.Module, names: Mapping[str, ast.expr]) -> Iterator[_Place]:
    """Places by which it is not known that all descriptions in the text are the one that counts.

    `names` are bound once. Of a module without the function nothing is said: it only helps others.
    """
    bound = [n for n in _in_scope(tree) if _FUNCTION in _bound_by(n)]
    if not bound:
        return
    if len(bound) > 1 or not isinstance(bound[0], ast.FunctionDef) or bound[0] not in tree.body:
        yield bound[-1]
        return
    yield from bound[0].decorator_list
    yield from (n for n in _in_scope(bound[0]) if isinstance(n, ast.Raise))
    yield from _renamed(tree)
    functions = {n.name: n for n in tree.body if isinstance(n, ast.FunctionDef)}
    given = _given_back(bound[0], functions, names)
    if not isinstance(given, ast.Call) or called(given) != "LaunchDescription":
        yield given
        return
    yield from _beside(tree, given, names)


def _renamed(tree: ast.Module) -> Iterator[ast.stmt]:
    """Where the name of a class of launch files, by which it is known, means something else."""
    made = {called(n) for n in ast.walk(tree) if isinstance(n, ast.Call)}
    for node in ast.walk(tree):
        match node:
            case ast.ImportFrom(names=aliases):
                others = {a.asname for a in aliases if a.asname not in (None, a.name)}
            case ast.FunctionDef(name=name) | ast.ClassDef(name=name):
                others = {name}
            case ast.Assign():
                others = set(_bound_by(node))
            case _:
                continue
        if any(name is not None and name[:1].isupper() and name in made for name in others):
            yield node


def _given_back(
    function: ast.FunctionDef,
    functions: Mapping[str, ast.FunctionDef],
    names: Mapping[str, ast.expr],
) -> _Place:
    """The expression that a function gives back in any case, or the place that leaves it open."""
    asked = {function.name}
    while True:
        returns = [n for n in _in_scope(function) if isinstance(n, ast.Return)]
        last = function.body[-1]
        if returns != [last] or returns[0].value is None:
            return next((r for r in returns if r is not last), last)
        value = returns[0].value
        if isinstance(value, ast.Name):
            value = names.get(value.id, value)
        match value:
            case ast.Call(func=ast.Name(id=name)) if name in functions and name not in asked:
                asked.add(name)
                function = functions[name]
            case _:
                return value


def _beside(tree: ast.Module, given: ast.Call, names: Mapping[str, ast.expr]) -> Iterator[ast.expr]:
    """Descriptions that are not the one that is given back, and what is added to such.

    What is added where the one that is given back is not made need not be added at all.
    """
    kept = {name for name, value in names.items() if value is given}
    added = {call for scope in _made_in(tree, given) for call in _run(scope.body)}
    for node in ast.walk(tree):
        match node:
            case ast.Call(func=ast.Attribute(value=receiver, attr="add_action")):
                if node not in added or not (
                    isinstance(receiver, ast.Name) and receiver.id in kept
                ):
                    yield node
            case ast.Call() if called(node) == "LaunchDescription" and node is not given:
                yield node
            case _:
                pass


def _made_in(
    tree: ast.Module, given: ast.Call
) -> Iterator[ast.Module | ast.FunctionDef | ast.AsyncFunctionDef]:
    """The module or function whose own statements make a description."""
    for scope in ast.walk(tree):
        if isinstance(scope, ast.Module | ast.FunctionDef | ast.AsyncFunctionDef):
            own = (n for s in _in_scope(scope) for n in _within(s))
            if any(n is given for n in own):
                yield scope


def _within(node: ast.AST) -> Iterator[ast.AST]:
    """A statement and what stands in it, without what functions and classes in it do."""
    yield node
    for child in ast.iter_child_nodes(node) if not isinstance(node, _SCOPES) else ():
        yield from _within(child)


def _run(body: Iterable[ast.stmt]) -> Iterator[ast.expr]:
    """The expressions that run as statements of a body, under what conditions and loops say."""
    for statement in body:
        match statement:
            case ast.Expr(value=value):
                yield value
            case ast.If(body=inner, orelse=other) | ast.While(body=inner, orelse=other):
                yield from _run((*inner, *other))
            case ast.For(body=inner, orelse=other):
                yield from _run((*inner, *other))
            case ast.With(body=inner):
                yield from _run(inner)
            case _:
                pass


def _in_scope(node: ast.AST) -> Iterator[ast.stmt]:
    """The statements of a module or a function, without those of functions and classes in it."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.stmt):
            yield child
        if not isinstance(child, _SCOPES):
            yield from _in_scope(child)


def _bound_by(node: ast.stmt) -> set[str]:
    """The names that a statement binds itself."""
    match node:
        case ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name) | ast.ClassDef(name=name):
            return {name}
        case ast.Import(names=aliases) | ast.ImportFrom(names=aliases):
            return {alias.asname or alias.name for alias in aliases}
        case ast.Assign() | ast.AnnAssign() | ast.Delete():
            stored = (n for n in ast.walk(node) if isinstance(n, ast.Name))
            return {n.id for n in stored if not isinstance(n.ctx, ast.Load)}
        case _:
            return set()
