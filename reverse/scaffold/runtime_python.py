"""Where generated Python that no model describes is not as it was generated."""

from __future__ import annotations

import ast
import builtins
import re
from collections.abc import Iterator
from itertools import zip_longest

from rebsync.reverse.scaffold.python_programs import SERVES, plain_program
from rebsync.reverse.scaffold.python_trees import (
    bindings,
    logs_texts,
    said,
    span_of,
    tree_of,
    without_types,
)
from rebsync.source import Source, Span

_OTHERS = re.compile(r"(?:.*/)?(?:setup|\w+_sensors|\w+\.launch)\.py\Z")
PYTHON = re.compile(r"(?:.*\.py|(?:.*/)?scripts/\w+)\Z")
_CLASS = re.compile(r"^# rebsync: (?:reactiveclass|interface) ", re.M)
_READS = re.compile(r"(?:rospy\.get_param|declared|read_array|declare_array)\(")
_MAKES = "rospy.init_node"
_LEVELS = frozenset({"DEBUG", "INFO", "WARN", "ERROR", "FATAL"})
_SEVERITY = rf"(?:rclpy\.logging\.)?LoggingSeverity\.(?:{'|'.join(_LEVELS)})"
_DIAGNOSES = re.compile(
    r"(?:faulthandler\.enable\(\)|tracemalloc\.start\(\)"
    r"|warnings\.(?:simplefilter|filterwarnings)\('(?:ignore|default|always|module|once)'"
    r"(?:, category=\w+Warning)?\)"
    rf"|rebec\.get_logger\(\)\.set_level\({_SEVERITY}\)"
    rf"|rclpy\.logging\.set_logger_level\('\w+', {_SEVERITY}\))\Z"
)
_DIAGNOSING = frozenset(
    {"faulthandler", "rclpy", "rclpy.logging", "rclpy.logging.LoggingSeverity"}
    | {"tracemalloc", "warnings"}
)
_WARNINGS = frozenset(name for name in dir(builtins) if name.endswith("Warning"))
_IMPORTS = (ast.Import, ast.ImportFrom)
_TOLD = frozenset({"__version__", "__author__", "__license__", "__copyright__"})


def is_python_runtime(name: str, generated: str) -> bool:
    """Whether a generated file is one that no model describes; classes, extraction reads."""
    if not PYTHON.match(name) or _OTHERS.match(name):
        return False
    return _CLASS.search(generated) is None


def first_difference(base: Source, source: Source, own: frozenset[str]) -> Span | None:
    """The first place that is another; `own` are the names of the package."""
    old, new = tree_of(base), tree_of(source)
    if old is None or new is None:
        return None if base.text == source.text else Span(0, min(1, len(source.text)))
    if (odd := _imported(old, new, own)) is not None:
        return span_of(source, odd) if isinstance(odd, ast.stmt) else Span(0, 1)
    new = _without_main(old, new)
    if SERVES in base.text:
        new = _without_diagnostics(new)
        is_script = not source.path.endswith(".py")
        old, new = (plain_program(each, is_script) for each in (old, new))
        if (early := next(_too_early(new.body), None)) is not None:
            return span_of(source, early)
    old, new = without_types(old), without_types(new)
    last = len(source.text.rstrip())
    for one, other in zip_longest(_parts(old.body, own), _parts(new.body, own)):
        if one is None or other is None or one[0] != other[0]:
            return span_of(source, other[1]) if other is not None else Span(max(last - 1, 0), last)
    return None


def _without_main(old: ast.Module, new: ast.Module) -> ast.Module:
    """A program that does in `main()`, which it calls at its end, what it did at its top."""
    match new.body:
        case [*_, ast.If(test, [ast.Expr(call)], [])] if ast.unparse(call) == "main()":
            mains = [s for s in new.body if isinstance(s, ast.FunctionDef) and s.name == "main"]
            had_one = any(isinstance(s, ast.FunctionDef) and s.name == "main" for s in old.body)
            is_plain = ast.unparse(test) == "__name__ == '__main__'" and len(mains) == 1
            if had_one or not is_plain or mains[0].decorator_list or ast.unparse(mains[0].args):
                return new
            rest = [s for s in new.body[:-1] if s is not mains[0]]
            return ast.Module([*rest, *mains[0].body], [])
        case _:
            return new


def _imported(old: ast.Module, new: ast.Module, own: frozenset[str]) -> ast.stmt | bool | None:
    """An import that brings something else; True where one is missing."""
    before, now = bindings(old), bindings(new)
    for name, (of, _) in before.items():
        if name not in now:
            return True
        brought, statement = now[name]
        is_more = isinstance(statement, ast.Import) and brought.startswith(f"{of}.")
        if not is_more and _without(brought, own) != _without(of, own):
            return statement
    used = {n.id for n in ast.walk(old) if isinstance(n, ast.Name)}
    return next((now[name][1] for name in now if name not in before and name in used), None)


def _without(text: str, own: frozenset[str]) -> str:
    for name in own:
        text = re.sub(rf"\b{re.escape(name)}(?=\b|_)", "", text)
    return text


def _is_told_to_people(statement: ast.stmt) -> bool:
    """Whether it says who made a module, or which one it is."""
    match statement:
        case ast.Assign(targets=[ast.Name(id=name)], value=ast.Constant()):
            return name in _TOLD
        case _:
            return False


def _without_diagnostics(module: ast.Module) -> ast.Module:
    """A program without what says from which level on it logs, or shows where it crashed."""
    bound = bindings(module)
    known = {name for name, (of, _) in bound.items() if of in _DIAGNOSING}
    known |= _WARNINGS - bound.keys()

    def rest(body: list[ast.stmt]) -> Iterator[ast.stmt]:
        made = False
        for statement in body:
            made = made or _makes_rebec(statement)
            names = {n.id for n in ast.walk(statement) if isinstance(n, ast.Name)}
            if isinstance(statement, ast.Expr) and "rebec" in names and not made:
                yield ast.copy_location(ast.Raise(), statement)  # there is none yet
            elif _DIAGNOSES.match(ast.unparse(statement)) is None or names - known - {"rebec"}:
                yield statement

    body = [*rest(module.body)]
    for each in body:
        if isinstance(each, ast.FunctionDef) and each.name == "main":
            each.body = [*rest(each.body)] or [ast.Pass()]
    return ast.Module(body, [])


def _parts(body: list[ast.stmt], own: frozenset[str]) -> Iterator[tuple[str, ast.stmt]]:
    """Each statement, what is inside of it apart, with its text."""
    for statement in said(body, logs_texts):
        if isinstance(statement, _IMPORTS) or _is_told_to_people(statement):
            continue
        inner = [getattr(statement, name, []) for name in ("body", "orelse", "finalbody")]
        handlers = getattr(statement, "handlers", [])
        if not any(inner) and not handlers:
            text = "a rebec" if _makes_rebec(statement) else ast.unparse(_quiet(statement))
            yield _without(text, own), statement
            continue
        yield _without(_head(statement), own), statement
        yield from _parts(inner[0], own)
        for handler in handlers:
            yield f"except {ast.unparse(handler.type) if handler.type else ''}", statement
            yield from _parts(handler.body, own)
        for name, each in zip(("else", "finally"), inner[1:], strict=True):
            if each:
                yield name, statement
                yield from _parts(each, own)
        yield "end", statement


def _quiet(statement: ast.stmt) -> ast.stmt:
    """A statement that makes a node, without the level from which on it logs."""
    match statement:
        case ast.Expr(ast.Call(function, given, keywords)) if ast.unparse(function) == _MAKES:
            rest = [k for k in keywords if not (_is_default(k) or _is_level(k))]
            return ast.Expr(ast.Call(function, given, rest))
        case _:
            return statement


def _is_default(given: ast.keyword) -> bool:
    """Whether an argument says what holds without it."""
    is_false = isinstance(given.value, ast.Constant) and given.value.value is False
    return given.arg in ("anonymous", "disable_signals") and is_false


def _is_level(given: ast.keyword) -> bool:
    match given:
        case ast.keyword("log_level", ast.Attribute(ast.Name("rospy"), level)):
            return level in _LEVELS
        case _:
            return False


def _head(statement: ast.stmt) -> str:
    """A statement without those inside of it."""
    if isinstance(statement, ast.Try):
        return "try"
    fields = dict(ast.iter_fields(statement))
    empty = {name: list[ast.stmt]() for name in fields if name in ("orelse", "finalbody")}
    copied = type(statement)(**{**fields, **empty, "body": [ast.Pass()]})
    return ast.unparse(ast.fix_missing_locations(copied))


def _too_early(body: list[ast.stmt]) -> Iterator[ast.stmt]:
    """The statements that name a rebec before the one that makes it: they fail, logs as well."""
    made = next((i for i, statement in enumerate(body) if _makes_rebec(statement)), 0)
    for statement in body[:made]:
        if any(isinstance(n, ast.Name) and n.id == "rebec" for n in ast.walk(statement)):
            yield statement
    for function in (s for s in body if isinstance(s, ast.FunctionDef)):
        yield from _too_early(function.body)


def _makes_rebec(statement: ast.stmt) -> bool:
    """Whether it makes a rebec of parameters as they are, which extraction reads."""
    match statement:
        case ast.Assign([ast.Name("rebec")], ast.Call(ast.Name(), arguments, [])):
            return all(_is_read(a) for a in arguments)
        case _:
            return False


def _is_read(argument: ast.expr) -> bool:
    match argument:
        case ast.Name("node"):
            return True
        case ast.Call(function, [inner], []) if ast.unparse(function) in _FORMATS:
            return _is_read(inner)
        case ast.Call():
            return _READS.match(ast.unparse(argument)) is not None
        case _:
            return False


_FORMATS = frozenset({"int8", "int16", "int32", "float32", "float64", "boolean", "Rebec"})
