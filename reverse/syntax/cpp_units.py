"""The units of a file of C++: includes, classes with their members, functions, variables."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.syntax.code_units import CodeUnit, UnitScope, lines_of, unit_with_body
from rebsync.reverse.syntax.cpp_declarations import TYPES, CppFunction, declared_name, function_of
from rebsync.reverse.syntax.cpp_tree import Cpp, parse_as_it_is, text_of
from rebsync.reverse.syntax.unparsed import errors_in
from rebsync.source import Source

_CLASSES = TYPES - {"enum_specifier"}
_BODIES = frozenset({"declaration_list", "field_declaration_list", "compound_statement"})
_ELSE = frozenset({"preproc_else", "preproc_elif", "preproc_elifdef"})


def cpp_units(text: str) -> CodeUnit | None:
    """A file as one unit; None where it does not parse."""
    lines = lines_of(text)
    cpp = parse_as_it_is(Source("-", text))
    if lines is None or (cpp.root.has_error and any(errors_in(cpp))):
        return None
    body = _UnitBody(cpp.root.children, 0, len(lines), "")
    with suppress(RecursionError):
        return _CppUnitReader(cpp, lines).whole("", 0, body, len(lines))
    return None


@dataclass(frozen=True, slots=True)
class _UnitBody:
    """The nodes of a body, and its lines: behind that of `{`, before that of `}`."""

    nodes: Sequence[Node]
    start: int
    end: int
    owner: str
    scope: UnitScope = UnitScope.DECLARATIONS


@dataclass(frozen=True, slots=True, eq=False)
class _CppUnitReader:
    cpp: Cpp
    lines: list[str]

    def whole(self, key: str, start: int, body: _UnitBody, end: int) -> CodeUnit:
        """A unit with a body; what is left of its lines belongs to those that close it."""
        inside = list(self._units(body))
        at = body.start + sum(unit.text.count("\n") for unit in inside)
        return unit_with_body(key, self._text(start, body.start), inside, self._text(at, end))

    def _units(self, body: _UnitBody) -> Iterator[CodeUnit]:
        """The units of the lines of some nodes, up to the last node that is no remark."""
        at = body.start
        for group in _by_lines(_within(body)):
            code = [n for n in group if n.type not in ("comment", ";")]
            node = code[0] if len(code) == 1 and body.scope is not UnitScope.STATEMENTS else None
            until = _end(group[-1])
            if node is not None and node.type == "preproc_include" and group[0] is not node:
                yield CodeUnit("", self._text(at, node.start_point.row))
                at = node.start_point.row
            text = CodeUnit("", self._text(at, until))
            yield self._unit(node, at, until, body.owner) if node is not None else text
            at = until

    def _text(self, start: int, end: int) -> str:
        return "".join(self.lines[start:end])

    def _unit(self, node: Node, start: int, end: int, owner: str) -> CodeUnit:
        inner = _declared_in(node)
        key = self._key(inner, owner)
        if inner.type == "preproc_include":
            return CodeUnit(key, self._text(start, end), names=frozenset({key}))
        body = self._body(inner, owner)
        if body is None or any(_is_beside(n, body) for n in body.nodes):
            return CodeUnit(key, self._text(start, end))
        return self.whole(key, start, body, end)

    def _body(self, node: Node, owner: str) -> _UnitBody | None:
        """What has units of its own: the body of a namespace, class, function or `#ifdef`."""
        if node.type == "preproc_ifdef":
            if any(child.type in _ELSE for child in node.children):
                return None
            return _UnitBody(
                node.children[2:-1], _end(node.children[1]), _row(node.children[-1]), owner
            )
        body = node.child_by_field_name("body")
        if body is None or body.type not in _BODIES:
            return None
        nodes, start, end = body.children[1:-1], _row(body) + 1, _end(body) - 1
        function = function_of(self.cpp, node, owner)
        if function is not None:
            is_set_up = function.name == function.owner
            scope = UnitScope.SET_UP if is_set_up else UnitScope.STATEMENTS
            return _UnitBody(nodes, start, end, owner, scope)
        return _UnitBody(
            nodes, start, end, _field(node, "name") if node.type in _CLASSES else owner
        )

    def _key(self, node: Node, owner: str) -> str:
        function = function_of(self.cpp, node, owner)
        if function is not None:
            return _function_key(function)
        match node.type:
            case "preproc_include":
                return f"include {_field(node, 'path')}"
            case "namespace_definition" | "preproc_ifdef" | "alias_declaration":
                return f"{node.type} {_field(node, 'name')}"
            case kind if kind in TYPES:
                is_whole = node.child_by_field_name("body") is not None
                return f"{kind} {_field(node, 'name')}" if is_whole else f"declared {text_of(node)}"
            case "field_declaration" | "declaration":
                names = list(_variables(node))
                return f"variable {' '.join(names)}" if all(names) else ""
            case "expression_statement" if node.named_child_count == 1:
                left = node.named_children[0].child_by_field_name("left")
                return f"= {text_of(left)}" if left is not None else ""
            case _:
                return ""


def _by_lines(nodes: Sequence[Node]) -> Iterator[list[Node]]:
    """Nodes that share lines together, and the remarks above with what follows them."""
    group: list[Node] = []
    for node in nodes:
        is_apart = bool(group) and _row(node) >= _end(group[-1])
        if is_apart and any(n.type != "comment" for n in group):
            yield group
            group = []
        group.append(node)
    if any(n.type != "comment" for n in group):
        yield group


def _row(node: Node) -> int:
    return node.start_point.row


def _end(node: Node) -> int:
    """The line behind those of a node; some end behind their line's end."""
    return node.end_point.row + (node.end_point.column > 0)


def _is_beside(node: Node, body: _UnitBody) -> bool:
    """Whether a node shares a line with what is around the body."""
    return node.type != "comment" and not body.start <= _row(node) < _end(node) <= body.end


def _within(body: _UnitBody) -> list[Node]:
    return [n for n in body.nodes if body.start <= _row(n) and _end(n) <= body.end]


def _declared_in(node: Node) -> Node:
    """What a template is of."""
    if node.type == "template_declaration" and node.named_children:
        return node.named_children[-1]
    return node


def _function_key(function: CppFunction) -> str:
    kind = "declared" if function.body is None else "function"
    return f"{kind} {function.owner}::{function.name}({', '.join(function.types)})"


def _variables(node: Node) -> Iterator[str]:
    """The variables that a declaration declares; empty for what is no plain one."""
    declarators = node.children_by_field_name("declarator")
    for each in declarators:
        inner = each.child_by_field_name("declarator") if each.type == "init_declarator" else each
        name = declared_name(inner) if inner is not None else None
        yield text_of(name) if name is not None else ""
    if not declarators:
        yield ""


def _field(node: Node, name: str) -> str:
    child = node.child_by_field_name(name)
    return text_of(child) if child is not None else ""
