"""Functions and properties of the node that only compute a value, as one expression."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from tree_sitter import Node

from rebsync.reverse.bodies.cpp_unknowns import Unknown
from rebsync.reverse.findings import Unread
from rebsync.reverse.models.building import is_calm
from rebsync.reverse.python.bodies.body_arguments import Argument, arguments
from rebsync.reverse.python.bodies.body_effects import (
    HARMLESS_DECORATORS,
    getter,
    is_harmless,
    is_still,
)
from rebsync.reverse.python.bodies.body_expression_reader import BodyExpressionReader
from rebsync.reverse.python.bodies.body_reading import has_nonlocals
from rebsync.reverse.python.bodies.body_scope import Frame, Meaning, Message, Nobody, Own, Pending
from rebsync.reverse.python.expressions.values import Value
from rebsync.reverse.python.values.py_callbacks import body_of
from rebsync.reverse.syntax.py_index import Scope, arguments_of, has_splat
from rebsync.reverse.syntax.py_tree import field, named, text_of

_NOTHING = frozenset({"comment", "pass_statement"})
_PATTERNS = frozenset({"pattern_list", "tuple_pattern"})
_MOST = 40  # statements, each counted once for each way to it


def value_of_call(reader: BodyExpressionReader, own: Scope, call: Node) -> Value:
    """The value of a function that only computes it from what it is given.

    Unknown: it changes nothing, but what it gives is not known. Unread: it may do more.
    """
    try:
        if has_splat(call):
            why = "what stars unpack into the arguments is not read"
            raise Unread(reader.frame.span(call), why)
        if not HARMLESS_DECORATORS.issuperset(own.decorators):
            raise _unread(reader, own, call)
        return _computed(reader, own, arguments(own, call), call)
    except Pending:
        raise
    except (Unknown, Unread) as failed:
        given = all(is_harmless(reader.reading, n, reader.frame) for n in _given(call))
        if not given or not is_still(reader.reading, own):
            if isinstance(failed, Unread):
                raise
            raise _unread(reader, own, call) from failed
        why = f'the model cannot know what "{own.name}" gives'
        raise Unknown(reader.frame.span(call), why, "") from failed


def value_of_property(reader: BodyExpressionReader, node: Node) -> Value | None:
    """The value of a property of the object; None for other expressions."""
    own = getter(reader.reading, node, reader.frame)
    return _computed(reader, own, (), node) if own is not None else None


def _computed(
    reader: BodyExpressionReader, own: Scope, given_: Iterable[Argument], call: Node
) -> Value:
    text = text_of(own.node)
    if own.node.id in reader.running or own.outer or has_nonlocals(own):
        raise _unread(reader, own, call)
    if text.startswith("async") or "yield" in text:
        raise _unread(reader, own, call)
    frame = Frame(own, server=reader.frame.server, outer=reader.frame)
    for parameter, node, given in given_:
        if node is None or not given:
            ways = reader.reading.values.ways(node, own) if node is not None else ()
            frame.bound[parameter.name] = reader.reading.constant(ways) or Nobody()
        else:
            frame.bound[parameter.name] = _argument(reader, own, node)
    running = (*reader.running, own.node.id)
    inner = type(reader)(reader.reading, frame, reader.within, running)
    return _ComputingBody(inner, own).value(body_of(own))


def _argument(reader: BodyExpressionReader, own: Scope, node: Node) -> Meaning:
    """What a parameter stands for."""
    if node.type in ("identifier", "attribute"):
        meaning, path = reader.meaning(node)
        if isinstance(meaning, Own | Message) and not path:
            return meaning
    value = reader.read(node)
    if not is_calm(value.expression):
        raise _unread(reader, own, node)
    return value


class _ComputingBody:
    """The value of a body, of which each local stands for what it was last given."""

    def __init__(self, reader: BodyExpressionReader, own: Scope) -> None:
        self.reader, self.own, self.count = reader, own, 0

    def value(self, nodes: Sequence[Node]) -> Value:
        """What the statements return."""
        for number, node in enumerate(nodes):
            self.count += 1
            if self.count > _MOST:
                break
            match node.type:
                case "return_statement" if named(node):
                    return self.reader.read(named(node)[0])
                case "if_statement":
                    return self._branch(node, nodes[number + 1 :])
                case "expression_statement":
                    for inner in named(node):
                        self._expression(inner)
                case kind if kind not in _NOTHING:
                    raise _unread(self.reader, self.own, node)
        raise _unread(self.reader, self.own, self.own.node)

    def _branch(self, node: Node, rest: Sequence[Node]) -> Value:
        """A branch: each of its ways goes on with what follows."""
        before = dict(self.reader.frame.bound)
        found: list[tuple[Node, Value]] = []
        asked = []
        last: Sequence[Node] = ()
        for each in (node, *node.children_by_field_name("alternative")):
            if each.type == "else_clause":
                last = named(field(each, "body"))
                continue
            asked.append(self.reader.condition(field(each, "condition")))
            taken = self.value([*named(field(each, "consequence")), *rest])
            found.append((each, taken))
            self.reader.frame.bound = dict(before)
        value = self.value([*last, *rest])
        self.reader.frame.bound = before
        for condition, (each, taken) in zip(reversed(asked), reversed(found), strict=True):
            value = self.reader.joined(condition, taken, value, each)
        return value

    def _expression(self, node: Node) -> None:
        match node.type:
            case "assignment" if node.child_by_field_name("right") is not None:
                target, right = field(node, "left"), field(node, "right")
                if target.type not in _PATTERNS:
                    self._bind([target], [right])
                elif right.type in ("expression_list", "tuple"):
                    self._bind(named(target), named(right))
                else:
                    raise _unread(self.reader, self.own, node)
            case "augmented_assignment":
                target = field(node, "left")
                values = self.reader.read(target), self.reader.read(field(node, "right"))
                operator = text_of(field(node, "operator")).removesuffix("=")
                self._set(target, self.reader.operation(operator, *values, node))
            case _ if not is_harmless(self.reader.reading, node, self.reader.frame):
                raise _unread(self.reader, self.own, node)

    def _bind(self, targets: list[Node], values: list[Node]) -> None:
        if len(targets) != len(values):
            raise _unread(self.reader, self.own, targets[0])
        found = [self.reader.read(value) for value in values]
        for target, value in zip(targets, found, strict=True):
            self._set(target, value)

    def _set(self, target: Node, value: Value) -> None:
        if target.type != "identifier" or not is_calm(value.expression):
            raise _unread(self.reader, self.own, target)
        self.reader.frame.bound[text_of(target)] = value


def _given(call: Node) -> list[Node]:
    plain, keywords = arguments_of(call)
    return [*plain, *keywords.values()]


def _unread(reader: BodyExpressionReader, own: Scope, node: Node) -> Unread:
    return Unread(reader.frame.span(node), f'the value of "{own.name}" is not read')
