"""The units of a file of Python, by LibCST: imports, classes, functions, variables, attributes."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from contextlib import suppress
from warnings import catch_warnings, simplefilter

import libcst as cst

from rebsync.records import dataclass
from rebsync.reverse.syntax.code_units import CodeUnit, UnitScope, lines_of, unit_with_body

_SETS_UP = "__init__"
_ACCESSORS = frozenset({"setter", "getter", "deleter"})


def py_units(text: str) -> CodeUnit | None:
    """A file as one unit; None where it does not parse."""
    lines = lines_of(text)
    if lines is None or not _is_python(text):
        return None
    with suppress(cst.ParserSyntaxError, RecursionError):
        module = cst.parse_module(text)
        reader = _UnitReader(module, lines)
        head = len(module.header)
        body = list(reader.units(module.body, head, UnitScope.DECLARATIONS))
        at = head + sum(unit.text.count("\n") for unit in body)
        found = unit_with_body("", "".join(lines[:head]), body, "".join(lines[at:]))
        return found if found.text == text else None
    return None


def _is_python(text: str) -> bool:
    """Whether Python reads it; the tree of LibCST is not for what nests too deep for that."""
    with suppress(SyntaxError, ValueError, RecursionError, MemoryError), catch_warnings():
        simplefilter("ignore")
        ast.parse(text)
        return True
    return False


@dataclass(frozen=True, slots=True, eq=False)
class _UnitReader:
    module: cst.Module
    lines: list[str]

    def units(
        self, body: Sequence[cst.BaseStatement], at: int, scope: UnitScope
    ) -> Iterator[CodeUnit]:
        """The units of the statements of a body that begins at a line."""
        for statement in body:
            end = at + self._height(statement)
            unit = self._unit(statement, at, end, scope)
            if unit.names and (remarks := _remarks(statement)):
                yield CodeUnit("", self._text(at, at + remarks))
                unit = CodeUnit(unit.key, self._text(at + remarks, end), names=unit.names)
            yield unit
            at = end

    def _text(self, start: int, end: int) -> str:
        return "".join(self.lines[start:end])

    def _height(self, node: cst.CSTNode) -> int:
        """How many lines a statement has, with the remarks above it."""
        return self.module.code_for_node(node).count("\n")

    def _unit(self, node: cst.BaseStatement, start: int, end: int, scope: UnitScope) -> CodeUnit:
        match node:
            case _ if scope is UnitScope.STATEMENTS:
                return CodeUnit("", self._text(start, end))
            case cst.ClassDef(name=cst.Name(name), body=body):
                return self._whole(f"class {name}", body, start, end, UnitScope.DECLARATIONS)
            case cst.If(test=cst.Name("TYPE_CHECKING" as name), body=body, orelse=None):
                return self._whole(f"if {name}", body, start, end, UnitScope.DECLARATIONS)
            case cst.FunctionDef(name=cst.Name(name), body=body):
                key = f"def {name}" + "".join(_accessor(d) for d in node.decorators)
                inner = UnitScope.SET_UP if name == _SETS_UP else UnitScope.STATEMENTS
                return self._whole(key, body, start, end, inner)
            case cst.SimpleStatementLine(body=[statement]):
                key, names = self._declared(statement, scope)
                return CodeUnit(key, self._text(start, end), names=names)
            case _:
                return CodeUnit("", self._text(start, end))

    def _whole(
        self, key: str, body: cst.BaseSuite, start: int, end: int, scope: UnitScope
    ) -> CodeUnit:
        if not isinstance(body, cst.IndentedBlock):
            return CodeUnit(key, self._text(start, end))
        last = end - len(body.footer)
        first = last - sum(self._height(statement) for statement in body.body)
        inside = list(self.units(body.body, first, scope))
        return unit_with_body(key, self._text(start, first), inside, self._text(last, end))

    def _declared(
        self, node: cst.BaseSmallStatement, scope: UnitScope
    ) -> tuple[str, frozenset[str]]:
        """The key of a statement, and the names that it imports."""
        match node:
            case cst.ImportFrom(names=[*names]):
                module = self._module(node)
                if module == "__future__":  # has to stand above all others
                    return "", frozenset()
                brought = frozenset(f"{module} {self._code(n)}" for n in _plain(names))
                return f"from {module}", brought
            case cst.Import(names=names):
                brought = frozenset(f"import {self._code(n)}" for n in _plain(names))
                return " ".join(sorted(brought)), brought
            case (
                cst.Assign(targets=[cst.AssignTarget(target=target)]) | cst.AnnAssign(target=target)
            ):
                kinds = (cst.Name, cst.Attribute) if scope is UnitScope.SET_UP else cst.Name
                is_plain = isinstance(target, kinds)
                return f"= {self._code(target)}" if is_plain else "", frozenset()
            case _:
                return "", frozenset()

    def _code(self, node: cst.CSTNode) -> str:
        return self.module.code_for_node(node)

    def _module(self, node: cst.ImportFrom) -> str:
        return "." * len(node.relative) + (self._code(node.module) if node.module else "")


def _accessor(decorator: cst.Decorator) -> str:
    """`.setter` where a function is one of another's."""
    match decorator.decorator:
        case cst.Attribute(value=cst.Name(), attr=cst.Name(name)) if name in _ACCESSORS:
            return f".{name}"
        case _:
            return ""


def _plain(names: Sequence[cst.ImportAlias]) -> Iterator[cst.ImportAlias]:
    """Imported names without what is around them."""
    for each in names:
        yield each.with_changes(comma=cst.MaybeSentinel.DEFAULT)


def _remarks(node: cst.BaseStatement) -> int:
    """How many lines above a statement end with a remark."""
    lines = node.leading_lines if isinstance(node, cst.SimpleStatementLine) else ()
    return max((n for n, line in enumerate(lines, 1) if line.comment is not None), default=0)
