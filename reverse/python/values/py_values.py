"""What expressions of Python may be worth: followed through names, attributes, calls, and loops."""

from __future__ import annotations

from collections.abc import Iterable

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.graph import FromParameter, Plain, Unresolved
from rebsync.reverse.python.values.py_evaluator import PyEvaluator
from rebsync.reverse.python.values.py_worth import (
    MOST,
    Duration,
    Items,
    NoneValue,
    Table,
    Value,
    Ways,
    computed,
    distinct,
    joined,
    used,
)
from rebsync.reverse.syntax.py_bindings import Binding
from rebsync.reverse.syntax.py_index import Scope
from rebsync.reverse.syntax.py_tree import field, named, number_of, string_parts, text_of

_DEEPEST = 60
_MOST_STEPS = 4000  # expressions that are followed for one value
_CONSTANTS: dict[str, Value] = {"true": True, "false": False, "none": NoneValue()}


@dataclass(eq=False, slots=True)
class PyValues(PyEvaluator):
    """The values of expressions in some files; what was found is kept."""

    def ways(self, node: Node, scope: Scope) -> Ways:
        """All that an expression may be worth.

        What depends on itself adds nothing to its own value; what was found on such a way holds
        for that way only, and is not kept.
        """
        key = scope.py.source.path, node.id
        if key in self.kept:
            return self.kept[key]
        if key in self.under_way:
            self.cycles[-1].add(key)
            return ()
        if not self.under_way:
            self.steps = 0
        self.steps += 1
        if len(self.under_way) > _DEEPEST or self.steps > _MOST_STEPS:
            return (self.unknown("it takes too long to follow", node, scope),)
        self.under_way.add(key)
        self.cycles.append(set())
        try:
            found = distinct(self._ways(node, scope))
        finally:
            self.under_way.discard(key)
            open_ = self.cycles.pop() - {key}
            if self.cycles:
                self.cycles[-1].update(open_)
        if len(found) > MOST:
            found = (self.unknown("too many values are possible", node, scope),)
        if not open_:
            self.kept[key] = found
        return found

    def bound(self, binding: Binding, name: str, scope: Scope) -> Ways:
        """What a binding of a name in a scope gives."""
        from rebsync.reverse.python.values.py_lookup import bound

        return bound(self, binding, name, scope)

    # --- expressions ----------------------------------------------------------------------------

    def _ways(self, node: Node, scope: Scope) -> Iterable[Value]:
        match node.type:
            case "string" | "concatenated_string":
                return self._text(node, scope)
            case "integer" | "float":
                number = number_of(node)
                return [number if number is not None else self.unknown("a number", node, scope)]
            case "true" | "false" | "none":
                return [_CONSTANTS[node.type]]
            case "parenthesized_expression" | "await":
                return self.ways(named(node)[0], scope) if named(node) else ()
            case "tuple" | "list" | "expression_list" | "set":
                return self._items(node, scope)
            case "dictionary":
                return self._table(node, scope)
            case "conditional_expression":
                first, *_, last = named(node)
                return [*self.ways(first, scope), *self.ways(last, scope)]
            case "boolean_operator":
                return self._either(node, scope)
            case "unary_operator" | "binary_operator":
                return self._operation(node, scope)
            case "named_expression":
                return self.ways(field(node, "value"), scope)
            case "lambda":
                from rebsync.reverse.python.values.py_worth import Function

                return [Function(self.code.scope_of(node, scope.py))]
            case "list_comprehension" | "generator_expression":
                return [Items((self.ways(field(node, "body"), scope),))]
            case _:
                from rebsync.reverse.python.values.py_lookup import followed

                return followed(self, node, scope)

    def _text(self, node: Node, scope: Scope) -> Ways:
        """A text, put together of its parts."""
        strings = named(node) if node.type == "concatenated_string" else [node]
        if any("b" in text_of(s.children[0]).rstrip("\"'").lower() for s in strings):
            return (self.unknown("bytes", node, scope),)
        parts: list[Ways] = []
        for part in (p for s in strings for p in string_parts(s)):
            if isinstance(part, str):
                parts.append((part,))
            else:
                parts.append(self.ways(field(part, "expression"), scope))
        return self.join(parts, node, scope)

    def _items(self, node: Node, scope: Scope) -> list[Value]:
        inner = named(node)
        if any(c.type == "list_splat" for c in inner):
            return [self.unknown("a list of which a part is unpacked", node, scope)]
        return [Items(tuple(self.ways(c, scope) for c in inner))]

    def _table(self, node: Node, scope: Scope) -> list[Value]:
        if any(c.type == "dictionary_splat" for c in named(node)):
            return [self.unknown("a table of which a part is unpacked", node, scope)]
        pairs = [c for c in named(node) if c.type == "pair"]
        return [
            Table(
                tuple(
                    (self.ways(field(p, "key"), scope), self.ways(field(p, "value"), scope))
                    for p in pairs
                )
            )
        ]

    def _either(self, node: Node, scope: Scope) -> list[Value]:
        """`a or b`: what is empty does not count on the left."""
        left = self.ways(field(node, "left"), scope)
        right = self.ways(field(node, "right"), scope)
        if text_of(field(node, "operator")) == "or":
            sure = left and all(isinstance(v, (int, float, str)) and v for v in left)
            return [v for v in left if v or not isinstance(v, (int, float, str))] + (
                [] if sure else list(right)
            )
        return [self.unknown("a condition", node, scope)]

    # --- operations -----------------------------------------------------------------------------

    def _operation(self, node: Node, scope: Scope) -> Iterable[Value]:
        if node.type == "unary_operator":
            return [
                self._negated(v, node, scope) for v in self.ways(field(node, "argument"), scope)
            ]
        left = self.ways(field(node, "left"), scope)
        operator = text_of(field(node, "operator"))
        right = self.ways(field(node, "right"), scope)
        return self.operated(operator, left, right, node, scope)

    def operated(
        self, operator: str, left: Ways, right: Ways, node: Node, scope: Scope
    ) -> Iterable[Value]:
        """An operation on all that its operands may be."""
        from rebsync.reverse.python.values.py_texts import formatted

        if operator == "%" and any(isinstance(v, str) for v in left):
            return [w for v in left for w in formatted(self, v, right, node, scope)]
        if len(left) * len(right) > MOST:
            return [self.unknown("too many values are possible", node, scope)]
        return [self._combined(operator, a, b, node, scope) for a in left for b in right]

    def _negated(self, value: Value, node: Node, scope: Scope) -> Value:
        sign = text_of(field(node, "operator"))
        match value:
            case int() | float() if sign in "+-":
                return -value if sign == "-" else value
            case FromParameter() if sign == "-":
                return used(value, "-", "", lambda v: -v if isinstance(v, (int, float)) else v)
            case Unresolved():
                return value
            case _:
                return self.unknown("an operation on what is not known", node, scope)

    def _combined(self, operator: str, a: Value, b: Value, node: Node, scope: Scope) -> Value:
        def none() -> Unresolved:
            return self.unknown("an operation on what is not known", node, scope)

        def on(left: Plain, right: Plain) -> Value:
            result = computed(operator, left, right)
            return result if result is not None else none()

        match a, b:
            case ((bool() | int() | float() | str()), (bool() | int() | float() | str())):
                return on(a, b)
            case (str(), _) | (_, str()) if operator == "+":
                return joined((a, b), none)
            case (FromParameter(expression=str() as use), Unresolved()) if (
                operator == "+" and "'" in use
            ):
                return joined((a, b), none)
            case FromParameter(), FromParameter():
                return none()
            case FromParameter(), (int() | float()):
                return used(a, "", f" {operator} {b!r}", lambda v: on(v, b))
            case ((int() | float()), FromParameter()):
                return used(b, f"{a!r} {operator} ", "", lambda v: on(a, v))
            case Duration(seconds), (int() | float()) if isinstance(seconds, (int, float)):
                return _length(on(seconds, b)) or none()
            case ((int() | float()), Duration(seconds)) if isinstance(seconds, (int, float)):
                return _length(on(a, seconds)) or none()
            case Items(first), Items(second) if operator == "+":
                return Items((*first, *second))
            case (Unresolved() as open_, _) | (_, Unresolved() as open_):
                return Unresolved(open_.why, open_.place)
            case _:
                return none()


def _length(value: Value) -> Duration | None:
    return Duration(value) if isinstance(value, (int, float)) else None
