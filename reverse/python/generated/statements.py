"""Statements of generated Python, as the model has them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.findings import Unread
from rebsync.reverse.python.generated import (
    aliases,
    callees,
    counts,
    endings,
    going_on,
    idioms,
    lazy,
    loops,
    records,
    stored,
    switches,
    users,
)
from rebsync.reverse.python.generated import inner as inner_functions
from rebsync.reverse.python.generated.decorators import context_of
from rebsync.reverse.python.generated.failing import told_people
from rebsync.reverse.python.generated.filled import filled
from rebsync.reverse.python.generated.kinds import is_kind
from rebsync.reverse.python.generated.py_types import (
    annotations_above,
    call_parts,
    is_unset,
    markers_above,
    type_of,
    without_parentheses,
)
from rebsync.reverse.python.generated.sends import moved
from rebsync.reverse.python.generated.statement_reader import ModelStatementReader
from rebsync.reverse.syntax.ancestors import climb
from rebsync.reverse.syntax.py_tree import field, named, text_of
from rebsync.statements import UNREADABLE

_HOISTED = "local "


@dataclass(eq=False, slots=True)
class Statements(ModelStatementReader):
    """Reads the bodies of one function."""

    def block(self, nodes: list[Node], span_of: Node) -> m.Block:
        """The statements of a suite."""
        return m.Block(tuple(self._all(nodes)), span=self.expressions.py.span(span_of))

    def _all(self, nodes: list[Node]) -> Iterator[m.Statement]:
        found: list[m.Statement] = []
        waiting = list(nodes)
        while waiting:
            node = waiting.pop(0)
            try:
                if (told := told_people(self.expressions, node)) is not None:
                    found += told
                    continue
                if users.is_users(self.expressions, node):
                    users.check(self.expressions, node)
                    continue
                if going_on.goes_on(self, node, waiting):
                    found.append(m.Continue(span=self.expressions.py.span(node)))
                    waiting.pop(0)
                    continue
                read_behind = aliases.behind(self, node, list(waiting))
                if read_behind is None:
                    read_behind = records.behind(self, node, list(waiting))
                if read_behind is not None:
                    self.findings.statements[self.within] += 1
                    return iter([*found, *read_behind])
                sent = filled(self.expressions, node, waiting)
                if sent is None:
                    found += stored.declared_before(self, node, waiting)
                    sent = self._read(node, found)
                read = self._with_annotations(node, sent)
            except Unread as unread:
                self.findings.unreadable(self.expressions.py.source, unread, self.within)
                read = [m.Empty((m.Annotation(UNREADABLE),), self.expressions.py.span(node))]
            self.findings.statements[self.within] += 1
            found += read
        return iter(found)

    def _read(self, node: Node, before: list[m.Statement]) -> list[m.Statement]:
        try:
            return self._statement(node, before)
        except RecursionError:
            span = self.expressions.py.span(node)
            raise Unread(span, "this nests too deep to be read") from None

    def _with_annotations(self, node: Node, read: list[m.Statement]) -> list[m.Statement]:
        given = annotations_above(self.expressions.py, node)
        if given and read:
            read[-1] = _annotated(read[-1], given)
        return read

    def _statement(self, node: Node, before: list[m.Statement]) -> list[m.Statement]:
        span = self.expressions.py.span(node)
        match node.type:
            case "pass_statement":
                return []
            case "assert_statement":
                return stored.asserted(self, node)
            case "delete_statement":
                return stored.deleted(self, node)
            case "try_statement":
                return stored.tried(self, node)
            case "function_definition":
                return inner_functions.declare(self, node)
            case "expression_statement":
                return self._effects(node)
            case "if_statement":
                return self._if(node)
            case "match_statement":
                return loops.match(self, node)
            case "while_statement":
                return endings.with_else(self, node, lambda: self._while(node, before))
            case "for_statement":
                return self._for(node, before)
            case "with_statement" if "block()" in text_of(node).partition(":")[0]:
                return [self.suite(field(node, "body"))]
            case "with_statement" if held := self.expressions.names.silent.locked(
                self.expressions.py, node
            ):
                return list(self.block(named(held), held).statements)
            case "with_statement" if (told := self._told(node)) is not None:
                return list(self.block(named(told), told).statements)
            case "return_statement":
                return self._return(node)
            case "break_statement":
                return [m.Break(span=span)]
            case "continue_statement":
                return [m.Continue(span=span)]
            case _:
                raise Unread(span, "the model has no such statement")

    def _told(self, node: Node) -> Node | None:
        """What is done in a context that only tells people of it."""
        names = self.expressions.names
        return context_of(names.constants.code, names.constants.module, node, names.silent)

    def _return(self, node: Node) -> list[m.Statement]:
        values = [v for v in named(node) if v.type != "none"]
        function = climb(node, lambda n: n.type == "function_definition")
        is_last = function is not None and node == named(field(function, "body"))[-1]
        if is_last and values and is_unset(without_parentheses(values[0])):
            return []  # only Python wants one here
        value = self.expressions.expression(values[0]) if values else None
        return [m.Return(value, span=self.expressions.py.span(node))]

    # --- effects --------------------------------------------------------------------------------

    def _effects(self, node: Node) -> list[m.Statement]:
        """An expression as a statement; of a tuple that is not used, each in turn."""
        return [found for inner in named(node) for found in self._effect(node, inner)]

    def _effect(self, node: Node, inner: Node) -> list[m.Statement]:
        span = self.expressions.py.span(node)
        if inner.type == "ellipsis":
            return [m.Empty(span=span)]
        if lazy.does_nothing(self.expressions, inner):
            return []
        if inner.type == "assignment":
            return self.assigned(inner)
        if inner.type == "augmented_assignment":
            changed = idioms.augmented(self.expressions, inner)
            return [m.ExpressionStatement(changed, span=span)]
        called, arguments = call_parts(inner) or ("", [])
        if called in self.inner:
            return inner_functions.inline_call(self, inner, called, arguments)
        if called.removeprefix("self.") in self.expressions.names.inlined and "." in called:
            return inner_functions.inline_method(self, inner, called, arguments)
        if called == "self._drive.move":
            return [moved(self.expressions, inner, arguments)]
        return [callees.evaluated(self.expressions, inner)]

    def assigned(self, node: Node) -> list[m.Statement]:
        span, left = self.expressions.py.span(node), field(node, "left")
        value = field(node, "right")
        name = text_of(left)
        if (number := counts.declared(self, node, name, value)) is not None:
            return number
        type_ = type_of(node.child_by_field_name("type"))
        if type_ is not None and left.type == "identifier":
            if any(x.startswith(_HOISTED) for x in markers_above(self.expressions.py, node)):
                self.hoisted[name] = type_
                return []
            self.implied.add(name)
            self.annotated[name] = type_
            return [self._declared(name, type_, value, node)]
        if name in self.hoisted:
            return [self._declared(name, self.hoisted.pop(name), value, node)]
        if inner_functions.named_lambda(self, left, value):
            return []
        if (sends := inner_functions.kept_send(self, left, value)) is not None:
            return sends
        if inner_functions.kept_table(self, left, value):
            return []
        if (times := inner_functions.kept_moment(self, left, value)) is not None:
            return times
        if value.type == "assignment":
            return stored.chained(self, node)
        if left.type in ("pattern_list", "tuple_pattern"):
            return stored.unpacked(self, node)
        if (elements := stored.all_elements(self, left, value)) is not None:
            return elements
        if left.type == "identifier" and name not in self.expressions.locals:
            return [self.implied_local(name, value, node)]
        target = self.expressions.expression(left)
        changed = self.expressions.stored(target, left, value, node, statement=True)
        self.in_order(changed)
        return [m.ExpressionStatement(changed, span=span)]

    def _declared(self, name: str, type_: m.Type, value: Node, node: Node) -> m.Local:
        span = self.expressions.py.span(node)
        initial = self._initial(value)
        plain = self.local(self.without_number(name))
        self.expressions.locals[name] = plain
        self.expressions.types[plain] = type_
        declarator = m.Declarator(plain, initial, span)
        return m.Local(m.Declaration(type_, (declarator,), span=span), span=span)

    def implied_local(self, name: str, value: Node, node: Node) -> m.Local:
        """A local without a type, which is that of its value, or of the name in another block."""
        if name in self.expressions.names.constants:
            raise self.expressions.unread(node, f'"{name}" is a constant elsewhere')
        type_ = idioms.kind_at(self.expressions, value)
        type_ = type_ or idioms.copied_type(self.expressions, value)
        elsewhere = self.annotated.get(name)
        if elsewhere is not None and is_kind(elsewhere, type_):
            type_ = elsewhere
        if type_ is None:
            raise self.expressions.unread(node, f'say the type of "{name}" where it is first set')
        self.implied.add(name)
        return self._declared(name, type_, value, node)

    def _initial(self, value: Node) -> m.Initializer | None:
        if is_unset(value):
            return None
        called, arguments = call_parts(value) or ("", [])
        if called == "Array" and len(arguments) == 1 and arguments[0].type == "list":
            values = tuple(v for a in named(arguments[0]) if (v := self._initial(a)) is not None)
            return m.ArrayInitializer(values, self.expressions.py.span(value))
        read = self.expressions.expression(value)
        idioms.check_copied(self.expressions, value, read)
        return read

    # --- control --------------------------------------------------------------------------------

    def _if(self, node: Node) -> list[m.Statement]:
        if going_on.says_so(self, node):
            return []
        if (switch := switches.switched(self, node)) is not None:
            return [switch]
        parts = [node, *node.children_by_field_name("alternative")]
        otherwise: m.Statement | None = None
        counted, stands = counts.before(self, node, field(node, "condition"))
        asked = [field(p, "condition") for p in parts if p.type != "else_clause"]
        with self.expressions.standing_for(
            [*stands], [*map(self.expressions.value, stands.values())]
        ):
            conditions = [*map(self.expressions.condition, asked)]
        bodies = []
        for part in parts:
            bodies.append(self.part(part))
        if parts[-1].type == "else_clause":
            said = [n for n in named(field(parts[-1], "body")) if n.type != "comment"]
            is_silent = not bodies[-1].statements and all(n.type != "pass_statement" for n in said)
            otherwise = None if is_silent else bodies[-1]
            bodies.pop()
        for condition, body, part in reversed(list(zip(conditions, bodies, parts, strict=False))):
            otherwise = m.If(condition, body, otherwise, span=self.expressions.py.span(part))
        assert otherwise is not None
        return [*counted, otherwise]

    def _for(self, node: Node, before: list[m.Statement]) -> list[m.Statement]:
        called, arguments = call_parts(field(node, "right")) or ("", [])
        name = text_of(field(node, "left"))
        is_switch = called == "switch" and len(arguments) == 1
        if not is_switch and called != "rounds":
            through = partial(self._through, node, arguments)
            return endings.with_else(self, node, lambda: endings.with_last(self, node, through))
        if node.child_by_field_name("alternative") is not None:  # which what ends it would skip
            raise self.expressions.unread(node, "the model has no such loop")
        if is_switch:
            return [self._switch(node, name, arguments[0])]
        return [self._rounds(node, name, before)]

    def _through(self, node: Node, arguments: list[Node]) -> m.Statement:
        """A loop of Python through numbers or values."""
        name, right = text_of(field(node, "left")), field(node, "right")
        library = self.expressions.library(field(right, "function")) if right.type == "call" else ""
        called = library.removeprefix("builtins.")
        if called == "range":
            return loops.counted(self, node, name)
        found = loops.through(self, node, called, arguments)
        if found is not None:
            return found
        return loops.numbered(self, node, "", [name], [right])

    def _while(self, node: Node, before: list[m.Statement]) -> list[m.Statement]:
        condition = self.expressions.condition(field(node, "condition"))
        span, body = self.expressions.py.span(node), field(node, "body")
        nodes, last = loops.stepped(self, body)
        if not last:
            return [m.While(condition, self.suite(body), span=span)]
        block = self.suite(body, nodes)
        steps = self.branch(body, last).statements
        updates = tuple(s.expression for s in steps if isinstance(s, m.ExpressionStatement))
        if len(updates) != len(steps):
            raise self.expressions.unread(last[0], "a step of a loop changes variables")
        initial = self._initially(before, condition, updates)
        return [m.For(initial, condition, updates, block, span=span)]

    def _rounds(self, node: Node, name: str, before: list[m.Statement]) -> m.For:
        """`for again in rounds():` with its step and its condition first."""
        nodes = named(field(node, "body"))
        updates: tuple[m.Expression, ...] = ()
        condition: m.Expression | None = None
        if nodes and nodes[0].type == "if_statement" and _asks(nodes[0]) == name:
            steps = self.branch(field(nodes.pop(0), "consequence")).statements
            updates = tuple(s.expression for s in steps if isinstance(s, m.ExpressionStatement))
        if nodes and nodes[0].type == "if_statement" and _ends(nodes[0]):
            asked = field(nodes.pop(0), "condition")
            inner = field(without_parentheses(asked), "argument")
            read = self.expressions.expression(inner)
            condition = read.inner if isinstance(read, m.Paren) else read
        body = self.suite(field(node, "body"), nodes)
        initial = self._initially(before, condition, updates)
        return m.For(initial, condition, updates, body, span=self.expressions.py.span(node))

    def _initially(
        self,
        before: list[m.Statement],
        condition: m.Expression | None,
        updates: tuple[m.Expression, ...],
    ) -> m.Declaration | tuple[m.Expression, ...]:
        """What a loop begins with: nobody knows behind the loop what is declared there."""
        initial = loops.taken_before(before, condition, updates)
        if isinstance(initial, m.Declaration):
            declared = {d.name for d in initial.declarators}
            known = self.expressions.locals
            for name in [n for n, local in known.items() if local in declared]:
                del known[name]
        return initial

    def _switch(self, node: Node, name: str, subject: Node) -> m.Switch:
        read = self.expressions.expression(subject)
        self.cases.append(name)
        silent = self.expressions.names.silent
        inside = (c for c in named(field(node, "body")) if not silent.holds(c))
        cases = [self._case(c) for c in inside]
        self.cases.pop()
        return m.Switch(read, tuple(cases), span=self.expressions.py.span(node))

    def _case(self, node: Node) -> m.Case:
        asked = node.child_by_field_name("condition")
        called, arguments = call_parts(asked) or ("", [])
        is_case = called in (self.cases[-1], f"{self.cases[-1]}.default")
        if not is_case or node.child_by_field_name("alternative") is not None:
            raise self.expressions.unread(node, "only cases stand in a switch")
        is_default = called.endswith(".default")
        value = None if is_default else self.expressions.expression(arguments[0])
        body = self.branch(field(node, "consequence"))
        return m.Case(
            value,
            body.statements,
            annotations_above(self.expressions.py, node),
            self.expressions.py.span(node),
        )


def _asks(node: Node) -> str:
    return text_of(without_parentheses(field(node, "condition")))


def _ends(node: Node) -> bool:
    """`if not condition: break`."""
    body = named(field(node, "consequence"))
    is_break = len(body) == 1 and body[0].type == "break_statement"
    return is_break and without_parentheses(field(node, "condition")).type == "not_operator"


def _annotated(statement: m.Statement, given: tuple[m.Annotation, ...]) -> m.Statement:
    return replace(statement, annotations=(*given, *statement.annotations))
