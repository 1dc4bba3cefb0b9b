"""Which locals of C++ may be read before they have a value: a definite assignment analysis.

A local of a scalar type that is declared without an initial value has an indeterminate one
([dcl.init]): reading it is undefined. It must get a value on each way to its use. An element of
an array counts for all of them where the index is not a literal, as loops store it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import field

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.syntax.cpp_tree import inside, named, part, text_of

UNSET = "this may be read before it has a value"
SCALARS = frozenset({"boolean", "byte", "short", "int", "float", "double"})

# Functions of the client libraries that store what they read in an argument.
_STORING = ("getParam", "getParamCached", "get_parameter", "get_parameter_or", "param", "tie")
_UNEVALUATED = ("sizeof_expression", "decltype", "noexcept", "comment", "type_descriptor")
_LOOPS = ("while_statement", "for_statement", "for_range_loop", "do_statement")
_LEAVES = ("return_statement", "throw_statement", "co_return_statement", "goto_statement")
_STATEMENTS = ("compound_statement", "labeled_statement", "else_clause", "translation_unit")


def may_reach_end(body: Node) -> bool:
    """Whether control may come to the end of a body."""
    return not _Flow("").sequence(body.named_children, False)


class _ReadUnset(Exception):
    """The local is read where it may have no value."""


def may_be_unset(declarator: Node, name: str) -> bool:
    """Whether a local that is declared without a value may be read before it gets one."""
    declaration = declarator
    while declaration.parent is not None and declaration.type != "declaration":
        declaration = declaration.parent
    around = declaration.parent
    if around is None:
        return True
    later = [n for n in around.named_children if n.start_byte >= declarator.end_byte]
    within = [n for n in declaration.named_children if n.start_byte >= declarator.end_byte]
    flow = _Flow(name)
    try:
        flow.sequence(later, flow.sequence(within, False))
    except _ReadUnset:
        return True
    return False


@dataclass(slots=True)
class _Flow:
    """Whether a name has a value after a statement that began so; it has where nothing goes on."""

    name: str
    breaks: list[list[bool]] = field(default_factory=list)  # of the loops and switches around

    def sequence(self, nodes: Iterable[Node], known: bool) -> bool:
        """What follows each other."""
        for node in nodes:
            if self._declares(node):
                return known  # another variable of this name
            known = self._after(node, known)
        return known

    def _declares(self, node: Node) -> bool:
        if node.type != "declaration":
            return False
        inner = [d.child_by_field_name("declarator") or d for d in node.named_children[1:]]
        return any(d.type == "identifier" and text_of(d) == self.name for d in inner)

    def _after(self, node: Node, known: bool) -> bool:
        """Whether the name has a value after a statement or an expression."""
        match node.type:
            case "identifier":
                return self._read(node, known)
            case "if_statement":
                return self._branches(node, known)
            case "switch_statement":
                return self._switch(node, known)
            case kind if kind in _LOOPS:
                return self._loop(node, known)
            case "try_statement":
                body = self._after(part(node, "body"), known)
                handlers = [n for n in node.named_children if n.type == "catch_clause"]
                return all([body, *(self._after(part(h, "body"), known) for h in handlers)])
            case "break_statement":
                if self.breaks:
                    self.breaks[-1].append(known)
                return True
            case "continue_statement":
                return True
            case kind if kind in _LEAVES:
                self.sequence(node.named_children, known)
                return True
            case kind if kind in _STATEMENTS:
                return self.sequence(node.named_children, known)
            case kind if kind.startswith("preproc_"):
                self.sequence(node.named_children, known)
                return known
            case kind if kind in _UNEVALUATED:
                return known
            case _:
                return self._expression(node, known)

    def _expression(self, node: Node, known: bool) -> bool:
        match node.type:
            case "assignment_expression":
                return self._assigned(node, known)
            case "conditional_expression":
                known = self._after(part(node, "condition"), known)
                then = self._after(part(node, "consequence"), known)
                return self._after(part(node, "alternative"), known) and then
            case "binary_expression" if text_of(part(node, "operator")) in ("&&", "||"):
                known = self._after(part(node, "left"), known)
                self._after(part(node, "right"), known)
                return known
            case "call_expression" if _called(node) in _STORING:
                given = named(part(node, "arguments"))
                stored = any(self._is_it(n) for n in given)
                others = [n for n in given if not self._is_it(n)]
                return self.sequence(others, known) or stored
            case "call_expression" if (index := self._stored_in(node)) is not None:
                given = named(part(node, "arguments"))
                self.sequence([*given[:index], *given[index + 1 :]], known)
                return True
            case "pointer_expression" if self._is_it(part(node, "argument")):
                return True  # whoever has the address may store
            case "field_expression":
                return self._after(part(node, "argument"), known)
            case _:
                return self.sequence(node.named_children, known)

    def _assigned(self, node: Node, known: bool) -> bool:
        left, right = part(node, "left"), part(node, "right")
        known = self._after(right, known)
        if text_of(part(node, "operator")) != "=":
            return self._after(left, known)
        if self._is_it(left) or self._is_element(left):
            if left.type == "subscript_expression":
                self.sequence(left.named_children[1:], known)
            return True
        return self._after(left, known)

    def _stored_in(self, call: Node) -> int | None:
        """The argument that the name is, of a function of the file that stores there first."""
        given = named(part(call, "arguments"))
        own = [index for index, n in enumerate(given) if self._is_it(n)]
        function = part(call, "function")
        if len(own) != 1 or function.type != "identifier":
            return None
        root = call
        while root.parent is not None:
            root = root.parent
        name = text_of(function)
        found = [
            n
            for n in inside(root, "function_definition")
            if (d := _function_declarator(n)) is not None and text_of(part(d, "declarator")) == name
        ]
        return own[0] if len(found) == 1 and _stores_first(found[0], own[0]) else None

    def _is_element(self, node: Node) -> bool:
        """`a[i]` or `a.at(i)`, in which the name is the array."""
        if node.type == "subscript_expression":
            return self._is_it(node.named_children[0])
        if node.type != "call_expression":
            return False
        function = part(node, "function")
        is_at = function.type == "field_expression" and text_of(part(function, "field")) == "at"
        return is_at and self._is_it(part(function, "argument"))

    def _is_it(self, node: Node) -> bool:
        return node.type == "identifier" and text_of(node) == self.name

    def _read(self, node: Node, known: bool) -> bool:
        if not known and self._is_it(node):
            raise _ReadUnset
        return known

    def _branches(self, node: Node, known: bool) -> bool:
        known = self._after(part(node, "condition"), known)
        then = self._after(part(node, "consequence"), known)
        otherwise = node.child_by_field_name("alternative")
        return then and (known if otherwise is None else self._after(otherwise, known))

    def _loop(self, node: Node, known: bool) -> bool:
        """After a loop: what is known where its condition is asked first."""
        body = part(node, "body")
        self.breaks.append([])
        if node.type == "do_statement":
            after = self._after(body, known)
            leaves_early = bool(self.breaks.pop()) or "continue" in text_of(body)
            after = known if leaves_early else after
            return self._after(part(node, "condition"), after)
        heads = [n for n in node.named_children if n != body]
        first = [n for n in heads if n != node.child_by_field_name("update")]
        known = self.sequence(first, known)
        inside = self._after(body, known)
        self.sequence((n for n in heads if n not in first), inside or known)
        has_break = bool(self.breaks.pop())
        return known or (_is_endless(node) and not has_break)

    def _switch(self, node: Node, known: bool) -> bool:
        known = self._after(part(node, "condition"), known)
        self.breaks.append([])
        through, has_default = True, False
        for case in _cases(part(node, "body")):
            value = case.child_by_field_name("value")
            has_default = has_default or value is None
            inside = [n for n in case.named_children if n != value]
            through = self.sequence(inside, known and through)
        return all([*self.breaks.pop(), through, has_default or known])


def _is_endless(loop: Node) -> bool:
    """Whether a loop has no condition, or one that is always true."""
    condition = loop.child_by_field_name("condition")
    if loop.type == "for_statement":
        return condition is None
    return condition is not None and text_of(condition).strip("() ") in ("true", "1")


def _cases(body: Node) -> Sequence[Node]:
    return [n for n in body.named_children if n.type == "case_statement"]


def _called(node: Node) -> str:
    """The last name of what a call is of."""
    return re.split(r"\.|::|->", text_of(part(node, "function")))[-1]


def _function_declarator(function: Node) -> Node | None:
    return next(
        iter(inside(function.child_by_field_name("declarator"), "function_declarator")), None
    )


def _stores_first(function: Node, index: int) -> bool:
    """Whether a function, before anything else, stores in a parameter that is a reference."""
    declarator, body = _function_declarator(function), function.child_by_field_name("body")
    given = named(part(declarator, "parameters")) if declarator is not None else []
    if body is None or index >= len(given):
        return False
    target = given[index].child_by_field_name("declarator")
    if target is None or target.type != "reference_declarator" or "const" in text_of(given[index]):
        return False
    name = text_of(target.named_children[-1])
    for statement in named(body):
        inner = named(statement)[0] if statement.type == "expression_statement" else None
        words = {text_of(n) for n in inside(statement, "identifier")}
        if inner is None or inside(statement, "lambda_expression"):
            return False
        if inner.type == "assignment_expression" and text_of(part(inner, "left")) == name:
            value = {text_of(n) for n in inside(part(inner, "right"), "identifier")}
            return text_of(part(inner, "operator")) == "=" and name not in value
        if name in words:
            return False
    return False
