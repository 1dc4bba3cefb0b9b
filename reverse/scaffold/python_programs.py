"""Programs of generated Python in other words: what they do besides only counts at their end."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

SERVES = "rebec.mailbox.serve()"
_STARTS = "rclpy.init"
_GUARD = "__name__ == '__main__'"
# What only comes up when a program is to end.
_ENDS = frozenset(
    {
        *("KeyboardInterrupt", "ExternalShutdownException", "SystemExit"),
        *("rospy.ROSInterruptException", "rclpy.executors.ExternalShutdownException"),
    }
)
_CLOSES = frozenset({"rebec.destroy_node()", "rclpy.shutdown()", "rclpy.try_shutdown()"})


def plain_program(module: ast.Module, is_script: bool) -> ast.Module:
    """A program without what is done when it ends, and without arguments that nobody gives.

    A script is only run, so that all of it may stand below `if __name__ == "__main__"`.
    """
    return ast.Module([*_plain(module.body, is_script)], [])


def _plain(body: Sequence[ast.stmt], is_script: bool, ends: bool = False) -> Iterator[ast.stmt]:
    """Statements; where these `ends` a program, nothing that does something follows them."""
    for statement in body:
        is_last = ends and statement is body[-1]
        match statement:
            case ast.If(test, inner, []) if is_script and ast.unparse(test) == _GUARD:
                yield from _plain(inner, False)
            case ast.Try(inner, handlers, [], last) if _only_ends(handlers, last):
                yield from _plain(inner, False, is_last)
            case ast.With([ast.withitem(ast.Call() as start, None)], inner) if (
                is_last and ast.unparse(start.func) == _STARTS
            ):  # what the context does behind its block is to shut down
                yield ast.copy_location(ast.Expr(start), statement)
                yield from _plain(inner, False, is_last)
            case ast.FunctionDef("main"):
                yield _without_arguments(statement)
            case _:
                yield statement


def _only_ends(handlers: list[ast.ExceptHandler], last: list[ast.stmt]) -> bool:
    """Whether what surrounds statements only does something when the program is to end."""
    is_closed = all(ast.unparse(s) in _CLOSES for s in last)
    return is_closed and all(
        each.type is not None
        and all(isinstance(s, ast.Pass) for s in each.body)
        and {ast.unparse(n) for n in _each(each.type)} <= _ENDS
        for each in handlers
    )


def _each(type_: ast.expr) -> list[ast.expr]:
    return type_.elts if isinstance(type_, ast.Tuple) else [type_]


def _without_arguments(main: ast.FunctionDef) -> ast.FunctionDef:
    """`def main(args=None)`, which only hands ROS the arguments, as `def main()`."""
    fields = dict(ast.iter_fields(main))
    body = [*_plain(main.body, False, True)]
    match main.args:
        case ast.arguments([], [ast.arg(name)], None, [], [], None, [ast.Constant(None)]):
            handed = f"rclpy.init(args={name})"
            rest = [s for s in body if ast.unparse(s) != handed]
            used = {n.id for s in rest for n in ast.walk(s) if isinstance(n, ast.Name)}
            if name not in used and len(rest) == len(body) - 1:
                made = ast.parse("rclpy.init()").body[0]
                body = [made if ast.unparse(s) == handed else s for s in body]
                fields["args"] = ast.arguments([], [], None, [], [], None, [])
        case _:
            pass
    return ast.copy_location(ast.FunctionDef(**{**fields, "body": body}), main)
