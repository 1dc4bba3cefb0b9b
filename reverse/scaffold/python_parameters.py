"""Parameters of rclpy that people read in its own words, as generated code reads them."""

from __future__ import annotations

import ast

_ANSWERS = frozenset({"integer_value", "double_value", "bool_value", "string_value"})


def as_declared(value: ast.expr, function: ast.FunctionDef) -> ast.expr:
    """`declared(self, "x", 7)` for what a function reads of a parameter that it declares.

    That is `self.declare_parameter("x", 7).value`, or `self.get_parameter("x").value` behind the
    declaration, which extraction makes sure of. Other values stay as they are.
    """
    asked = _asked(value)
    match asked:
        case ast.Call(ast.Attribute(ast.Name("self"), "declare_parameter"), [key, default, *more]):
            return value if _ignores(asked, more) else _declared(key, default)
        case ast.Call(ast.Attribute(ast.Name("self"), "get_parameter"), [ast.Constant() as key]):
            found = [d for k, d in _declarations(function) if k.value == key.value]
            return _declared(key, found[0]) if len(found) == 1 else value
        case _:
            return value


def _asked(value: ast.expr) -> ast.expr | None:
    """The parameter whose value is read."""
    match value:
        case ast.Attribute(asked, "value"):
            return asked
        case ast.Attribute(ast.Call(ast.Attribute(asked, "get_parameter_value"), []), kind):
            return asked if kind in _ANSWERS else None
        case _:
            return None


def _declarations(function: ast.FunctionDef) -> list[tuple[ast.Constant, ast.expr]]:
    """The names of parameters that statements of a function declare, with what stands in."""
    found = []
    for statement in function.body:
        match statement:
            case ast.Expr(
                ast.Call(
                    ast.Attribute(ast.Name("self"), "declare_parameter"),
                    [ast.Constant() as key, default, *more],
                ) as call
            ) if not _ignores(call, more):
                found.append((key, default))
            case _:
                pass
    return found


def _ignores(call: ast.Call, more: list[ast.expr]) -> bool:
    """Whether a declaration may have `ignore_override`: nobody else gives it a value then."""
    return len(more) > 1 or any(k.arg != "descriptor" for k in call.keywords)


def _declared(key: ast.expr, default: ast.expr) -> ast.expr:
    described = ast.Constant("...")
    return ast.Call(ast.Name("declared"), [ast.Name("self"), key, default, described], [])
