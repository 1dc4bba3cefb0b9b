"""Trees of generated Python in which nothing is left of layout, remarks, types and logging."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress

from rebsync.reserved import RUNTIME_HEADERS
from rebsync.reverse.libraries.python import log_words, own_name_methods, own_names
from rebsync.reverse.python.generated.slicing.log_words import HARMLESS
from rebsync.source import Source, Span

# The modules of the run-time part.
MODULE = re.compile(rf"(?:.*/)?(?:__init__|{'|'.join(RUNTIME_HEADERS)})\.py\Z")

# Annotations by which a data class has another constructor.
_NO_FIELDS = frozenset({"ClassVar", "InitVar", "KW_ONLY"})

# What takes one text, and is there wherever its module is imported.
_LOGS_TEXTS = re.compile(
    r"(?:rospy\.log(?:debug|info|warn|err|fatal)(?:_once)?|print"
    r"|(?:logging|rebec\.get_logger\(\)|rclpy\.logging\.get_logger\('\w+'\))\.(?:debug|info|warning|error))\Z"
)


def tree_of(source: Source) -> ast.Module | None:
    """The tree of a text; None where it is no Python."""
    with suppress(SyntaxError, ValueError, RecursionError):
        return ast.parse(source.text)
    return None


def span_of(source: Source, node: ast.AST) -> Span:
    """The place of a node, in characters."""
    first, column = getattr(node, "lineno", 1), getattr(node, "col_offset", 0)
    last, end = getattr(node, "end_lineno", first), getattr(node, "end_col_offset", column)
    lines = source.text.split("\n")
    starts = [0]
    for line in lines[: last or first]:
        starts.append(starts[-1] + len(line) + 1)

    def place(number: int, bytes_: int) -> int:
        line = lines[number - 1].encode("utf-8")[:bytes_]
        return starts[number - 1] + len(line.decode("utf-8", "ignore"))

    return Span(place(first, column), place(last, end))


def said(body: list[ast.stmt], logs: Callable[[ast.Call], bool]) -> Iterator[ast.stmt]:
    """The statements but for texts, what only `logs`, and imports for type checkers."""
    for statement in body:
        match statement:
            case ast.Expr(ast.Constant()) | ast.Pass():
                continue
            case ast.Expr(ast.Call() as call) if logs(call):
                continue
            case ast.If(ast.Name("TYPE_CHECKING")):
                continue
            case ast.If(ast.Compare(ast.Name("__name__")), [ast.Expr(call)], []):
                if ast.unparse(call) != "main()":
                    yield statement
            case _:
                yield statement


def logs_texts(call: ast.Call) -> bool:
    """Whether a call logs texts and names of the node alone, so that nothing of it may fail."""
    if _LOGS_TEXTS.match(ast.unparse(call.func)) is None or call.keywords:
        return False
    match call.args:
        case [ast.Constant(str())]:
            return True
        case [ast.JoinedStr(values)]:
            return all(map(_is_text, values))
        case [ast.Constant(str(text)), *names]:
            return text.count("%s") == text.count("%") == len(names) and all(map(_is_name, names))
        case _:
            return False


def _is_text(part: ast.expr) -> bool:
    match part:
        case ast.FormattedValue(value, format_spec=None):
            return _is_name(value)
        case _:
            return isinstance(part, ast.Constant)


def _is_name(value: ast.expr) -> bool:
    """Whether it asks for the name of the node."""
    match value:
        case ast.Call(ast.Attribute(ast.Name("rebec"), method), [], []):
            return method in own_name_methods()
        case ast.Call(function, [], []):
            return ast.unparse(function) in own_names()
        case _:
            return False


def is_log(call: ast.Call) -> bool:
    """Whether a call only logs what is there already; whether it may fail, extraction asks."""
    if log_words().match(ast.unparse(call.func)) is None:
        return False
    inside = [n for a in (*call.args, *call.keywords) for n in ast.walk(a)]
    calls = (n for n in inside if isinstance(n, ast.Call))
    is_plain = not any(isinstance(n, ast.NamedExpr | ast.Await | ast.Yield) for n in inside)
    return is_plain and all(map(_looks, calls))


def _looks(call: ast.Call) -> bool:
    """Whether a call only looks at its arguments, or gives a node's name."""
    called = ast.unparse(call.func)
    name = called.rpartition(".")[2]
    if call.args or call.keywords:
        return name in HARMLESS
    return name in HARMLESS or called in own_names() or name in own_name_methods()


def _field(node: ast.AnnAssign) -> ast.AnnAssign:
    """A field without its type, if that does not say which kind of a field it is."""
    words = {n.id for n in ast.walk(node.annotation) if isinstance(n, ast.Name)}
    is_special = not words.isdisjoint(_NO_FIELDS)
    annotation = node.annotation if is_special else ast.Constant(...)
    return ast.copy_location(
        ast.AnnAssign(node.target, annotation, node.value, simple=node.simple), node
    )


class _Plain(ast.NodeTransformer):
    """Takes types out, and calls names as they are in another tree."""

    def __init__(self, names: Mapping[str, str]) -> None:
        self.names = names

    def visit_Name(self, node: ast.Name) -> ast.AST:
        return ast.Name(self.names.get(node.id, node.id), node.ctx)

    def visit_arg(self, node: ast.arg) -> ast.AST:
        return ast.arg(self.names.get(node.arg, node.arg), None)

    def visit_ClassDef(self, node: ast.ClassDef) -> ast.AST:
        """A class: what is annotated in its body may be a field, whatever its type is."""
        body = [_field(s) if isinstance(s, ast.AnnAssign) else self.visit(s) for s in node.body]
        node.body = []
        self.generic_visit(node)
        node.body = body
        return node

    def visit_AnnAssign(self, node: ast.AnnAssign) -> ast.AST:
        self.generic_visit(node)
        if node.value is None:
            return ast.Pass()
        made = ast.Assign([node.target], node.value, lineno=node.lineno)
        return ast.copy_location(made, node)

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        node.returns = None
        node.body = list(said(node.body, logs_texts)) or [ast.Pass()]
        self.generic_visit(node)
        return node


def without_types(tree: ast.Module) -> ast.Module:
    """The same tree, which changes for that."""
    found = _Plain({}).visit(tree)
    assert isinstance(found, ast.Module)
    return found


def plain(node: ast.AST, names: Mapping[str, str] | None = None) -> str:
    """What a tree says in one line, or several for a function."""
    copied = ast.parse(ast.unparse(node))
    return ast.unparse(_Plain(names or {}).visit(copied))


def bindings(tree: ast.Module) -> dict[str, tuple[str, ast.stmt]]:
    """What the imports of a module bring: by name what it is of, and the statement."""
    found: dict[str, tuple[str, ast.stmt]] = {}
    for statement in tree.body:
        match statement:
            case ast.Import(names):
                for each in names:
                    bound = each.asname or each.name.partition(".")[0]
                    found[bound] = each.name, statement
            case ast.ImportFrom(module, names, level):
                for each in names:
                    of = f"{'.' * level}{module or ''}.{each.name}"
                    found[each.asname or each.name] = of, statement
            case _:
                pass
    return found
