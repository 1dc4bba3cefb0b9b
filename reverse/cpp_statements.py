"""Statements of C++ as statements of the model."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import field

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.cpp_expressions import MOVE, CppExpressions
from rebsync.reverse.cpp_tree import Cpp, markers_in, named, part, text_of
from rebsync.reverse.cpp_types import type_of
from rebsync.reverse.findings import Findings, Unread
from rebsync.reverse.scope import Scope, Stores
from rebsync.reverse.written import annotation

_LOGGING = ("ROS_DEBUG", "ROS_INFO", "ROS_WARN", "ROS_ERROR", "ROS_FATAL")


@dataclass(slots=True)
class CppStatements:
    """Reads one body. A statement without a meaning in the model is listed in `findings`.

    `hoisted` are locals that C++ declares before a switch and the model in one of its cases.
    """

    cpp: Cpp
    scope: Scope
    findings: Findings
    within: str
    hoisted: dict[str, m.Type] = field(default_factory=dict)

    def block(self, node: Node) -> m.Block:
        """A body in braces; its locals end with it."""
        outside = self.scope
        statements = tuple(self._statements(node.named_children))
        self.scope = outside
        return m.Block(statements, span=self.cpp.span(node))

    def read(self, nodes: Sequence[Node]) -> tuple[m.Statement, ...]:
        """Statements that follow each other; their locals stay in `scope`."""
        return tuple(self._statements(nodes))

    def _known(
        self, node: Node, known: Sequence[m.Statement | Stores | Node]
    ) -> Iterator[m.Statement]:
        """What stands for a statement whose meaning is known from elsewhere."""
        for each in known:
            match each:
                case Stores(target, value):
                    span = self.cpp.span(node)
                    try:
                        written = (
                            self._expressions.read(target) if isinstance(target, Node) else target
                        )
                    except Unread:
                        continue  # it is stored outside
                    read = self._expressions.read(value) if isinstance(value, Node) else value
                    yield m.ExpressionStatement(m.Assign("=", written, read, span), (), span)
                case Node():
                    yield from self._statement(each, (), False)
                case _:
                    yield each

    def _statements(self, nodes: Sequence[Node]) -> Iterator[m.Statement]:
        comments: list[str] = []
        for node in nodes:
            if node.type == "comment":
                comments.append(text_of(node))
                continue
            markers = markers_in(comments)
            annotations = tuple(
                a for text in markers if (a := annotation(text, self.cpp.span(node))) is not None
            )
            local = any(text.startswith("local ") for text in markers)
            comments = []
            self.findings.statements[self.within] += 1
            try:
                if (known := self.scope.instead.get(node.id)) is not None:
                    yield from self._known(node, known)
                else:
                    yield from self._statement(node, annotations, local)
            except Unread as unread:
                yield self._unreadable(node, unread)
            except ValueError:
                yield self._unreadable(node, self._unread(node, "this does not parse as C++"))

    def _unreadable(self, node: Node, unread: Unread) -> m.Statement:
        """What stands in the model for a statement that it lacks."""
        self.findings.unreadable(self.cpp.source, unread, self.within)
        return m.Empty((m.Annotation("Unreadable"),), self.cpp.span(node))

    def _statement(
        self, node: Node, annotations: tuple[m.Annotation, ...], local: bool
    ) -> Iterator[m.Statement]:
        span = self.cpp.span(node)
        match node.type:
            case "expression_statement":
                yield from self._expression_statement(node, annotations)
            case "declaration":
                yield from self._declaration(node, annotations, local)
            case "compound_statement" | "initializer_list":
                block = self.block(node)
                if self._is_hoisting(node):
                    yield from block.statements
                else:
                    yield m.Block(block.statements, annotations, span)
            case "if_statement":
                yield self._if(node, annotations)
            case "while_statement":
                condition, body = self._condition(node), part(node, "body")
                yield m.While(condition, self._branch(body), annotations, span)
            case "for_statement":
                yield self._for(node, annotations)
            case "switch_statement":
                yield self._switch(node, annotations)
            case "return_statement":
                yield from self._return(node, annotations)
            case "break_statement":
                yield m.Break(annotations, span)
            case "continue_statement":
                yield m.Continue(annotations, span)
            case _:
                raise self._unread(node, f"the model has no {node.type.replace('_', ' ')}")

    def _unread(self, node: Node, why: str) -> Unread:
        return Unread(self.cpp.span(node), why)

    @property
    def _expressions(self) -> CppExpressions:
        return CppExpressions(self.cpp, self.scope)

    # --- expressions and declarations -----------------------------------------------------------

    def _expression_statement(
        self, node: Node, annotations: tuple[m.Annotation, ...]
    ) -> Iterator[m.Statement]:
        span, children = self.cpp.span(node), named(node)
        if not children:
            yield m.Empty(annotations, span)
            return
        expression = children[0]
        if _calls(expression, "unused") or _logs(expression):
            return
        if declared := self._late_declaration(expression):
            yield m.Local(declared, annotations, span)
            return
        read = self._effect(expression)
        if isinstance(read, m.Call) and read.name == MOVE:
            cells = zip(("X", "Y"), read.arguments, strict=False)
            move = m.Annotation("Move", tuple(_cell(axis, offset) for axis, offset in cells))
            yield m.Empty((*annotations, move), span)
            return
        yield m.ExpressionStatement(read, annotations, span)

    def _effect(self, node: Node) -> m.Expression:
        """An expression for what it does; generated code says of one without effect that it is."""
        if node.type == "call_expression":
            function = part(node, "function")
            if text_of(function) == "static_cast<void>":
                return self._expressions.read(named(part(node, "arguments"))[0])
        return self._expressions.read(node)

    def _late_declaration(self, node: Node) -> m.Declaration | None:
        """The assignment that is the declaration of a local which C++ declares before a switch."""
        if node.type != "assignment_expression":
            return None
        name, value = text_of(part(node, "left")), part(node, "right")
        type_ = self.hoisted.get(name)
        if type_ is None:
            return None
        del self.hoisted[name]
        initial: m.Initializer | None
        if value.type == "compound_literal_expression":
            initial = self._braces(part(value, "value"), type_)
        else:
            initial = self._expressions.read(value)
        declarator = m.Declarator(self.scope.local(name), initial, self.cpp.span(node))
        return m.Declaration(type_, (declarator,), span=self.cpp.span(node))

    def _declaration(
        self, node: Node, annotations: tuple[m.Annotation, ...], hoisted: bool
    ) -> Iterator[m.Statement]:
        declaration = self._declared(node)
        if hoisted:
            for name in _declared_names(node):
                self.hoisted[name] = declaration.type
            return
        yield m.Local(declaration, annotations, self.cpp.span(node))

    def _declared(self, node: Node) -> m.Declaration:
        """The declaration; its names are locals from here on."""
        written = part(node, "type")
        type_ = type_of(written)
        if type_ is None:
            raise self._unread(node, f'the model has no type "{text_of(written)}"')
        declarators = []
        for declarator in node.children_by_field_name("declarator"):
            declarators.append(self._declarator(declarator, type_))
        return m.Declaration(type_, tuple(declarators), span=self.cpp.span(node))

    def _declarator(self, node: Node, type_: m.Type) -> m.Declarator:
        name, initial = node, None
        if node.type == "init_declarator":
            name, value = part(node, "declarator"), part(node, "value")
            if value.type == "initializer_list":
                initial = self._braces(value, type_)
            else:
                initial = self._expressions.read(value)
        if name.type != "identifier":
            raise self._unread(node, "the model has no pointers and references")
        self.scope = self.scope.declare(text_of(name))
        local = self.scope.local(text_of(name))
        return m.Declarator(local, initial, self.cpp.span(node), self.cpp.span(name))

    def _braces(self, node: Node, type_: m.Type) -> m.Initializer | None:
        """`{}` is no initial value; arrays have a pair of braces around the elements, or two."""
        values = named(node)
        if not values:
            return None
        if not type_.dimensions:
            return self._expressions.read(values[0])
        inner = m.Type(type_.name, type_.dimensions[1:])
        if len(values) == 1 and values[0].type == "initializer_list":
            values = named(values[0])
        read: list[m.Initializer] = []
        for value in values:
            element = self._braces(value, inner) if value.type == "initializer_list" else None
            read.append(element if element is not None else self._expressions.read(value))
        return m.ArrayInitializer(tuple(read), self.cpp.span(node))

    # --- control --------------------------------------------------------------------------------

    def _condition(self, node: Node) -> m.Expression:
        condition = part(node, "condition")
        if condition.type == "condition_clause":
            condition = part(condition, "value")
        return self._expressions.read(condition)

    def _branch(self, node: Node) -> m.Block:
        """The body of a branch or loop, in braces or not."""
        if node.type == "compound_statement":
            return self.block(node)
        outside = self.scope
        statements = tuple(self._statements([node]))
        self.scope = outside
        return m.Block(statements, span=self.cpp.span(node))

    def _if(self, node: Node, annotations: tuple[m.Annotation, ...]) -> m.If:
        condition = self._condition(node)
        then = self._branch(part(node, "consequence"))
        otherwise: m.Statement | None = None
        alternative = node.child_by_field_name("alternative")
        if alternative is not None:
            (body,) = named(alternative)
            otherwise = self._if(body, ()) if body.type == "if_statement" else self._branch(body)
        return m.If(condition, then, otherwise, annotations, self.cpp.span(node))

    def _for(self, node: Node, annotations: tuple[m.Annotation, ...]) -> m.For:
        outside = self.scope
        first = node.child_by_field_name("initializer")
        initial: m.Declaration | tuple[m.Expression, ...] = ()
        if first is not None and first.type == "declaration":
            initial = self._declared(first)
        elif first is not None:
            initial = tuple(self._listed(first))
        tested = node.child_by_field_name("condition")
        condition = self._expressions.read(tested) if tested is not None else None
        update = node.child_by_field_name("update")
        updates = tuple(self._listed(update)) if update is not None else ()
        body = self._branch(part(node, "body"))
        self.scope = outside
        return m.For(initial, condition, updates, body, annotations, self.cpp.span(node))

    def _listed(self, node: Node) -> Iterator[m.Expression]:
        if node.type == "comma_expression":
            for child in named(node):
                yield from self._listed(child)
        else:
            yield self._effect(node)

    def _switch(self, node: Node, annotations: tuple[m.Annotation, ...]) -> m.Switch:
        subject = self._condition(node)
        outside = self.scope
        cases = [self._case(c) for c in named(part(node, "body"))]
        self.scope = outside
        return m.Switch(subject, tuple(cases), annotations, self.cpp.span(node))

    def _case(self, node: Node) -> m.Case:
        if node.type != "case_statement":
            raise self._unread(node, "this stands before the first case")
        value = node.child_by_field_name("value")
        read = self._expressions.read(value) if value is not None else None
        body = [c for c in node.named_children if value is None or c.start_byte >= value.end_byte]
        inside = [c for c in body if c.type != "comment"]
        if len(inside) == 1 and inside[0].type == "compound_statement":
            statements = self.block(inside[0]).statements
        else:
            statements = tuple(self._statements(body))
        return m.Case(read, statements, span=self.cpp.span(node))

    def _is_hoisting(self, node: Node) -> bool:
        """Whether a block only holds locals of a switch, and the switch."""
        comments = [text_of(c) for c in node.named_children if c.type == "comment"]
        return any(t.startswith("local ") for t in markers_in(comments))

    def _return(self, node: Node, annotations: tuple[m.Annotation, ...]) -> Iterator[m.Statement]:
        values = named(node)
        if values and values[0].type == "initializer_list" and not named(values[0]):
            return  # what C++ wants behind the last statement of a method
        read = self._expressions.read(values[0]) if values else None
        yield m.Return(read, annotations, self.cpp.span(node))


def _calls(node: Node, function: str) -> bool:
    return node.type == "call_expression" and text_of(part(node, "function")) == function


def _logs(node: Node) -> bool:
    called = node.type == "call_expression" and part(node, "function").type == "identifier"
    return called and text_of(part(node, "function")).startswith(_LOGGING)


def _declared_names(node: Node) -> Iterator[str]:
    for declarator in node.children_by_field_name("declarator"):
        inner = declarator.child_by_field_name("declarator")
        yield text_of(inner or declarator)


def _cell(axis: str, offset: m.Expression) -> m.Expression:
    """`X`, `X + 1`, `X - 1` for an offset."""
    match offset:
        case m.IntLiteral(0):
            return m.Name(axis)
        case m.Unary("-", operand):
            return m.Binary("-", m.Name(axis), operand)
        case _:
            return m.Binary("+", m.Name(axis), offset)
