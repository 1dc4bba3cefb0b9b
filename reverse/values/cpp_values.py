"""What expressions of C++ are worth, as far as the files alone tell: asked for one at a time.

The value of a variable is what may have been put into it; that of a parameter is what the callers
give. Where the files do not tell, the value is unknown, with the reason.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import field
from typing import TypeVar

from tree_sitter import Node

from rebsync.records import dataclass
from rebsync.reverse.graph import FromParameter
from rebsync.reverse.syntax.cpp_calls import string_of
from rebsync.reverse.syntax.cpp_numerals import numeral
from rebsync.reverse.syntax.cpp_tree import Cpp, named, part, text_of
from rebsync.reverse.values.cpp_evaluator import CppEvaluator
from rebsync.reverse.values.cpp_flow import Texts, nearness
from rebsync.reverse.values.cpp_flow_calls import Calls
from rebsync.reverse.values.cpp_flow_types import Types
from rebsync.reverse.values.cpp_values_calls import called_value
from rebsync.reverse.values.cpp_values_made import constructed
from rebsync.reverse.values.cpp_values_numbers import converted
from rebsync.reverse.values.cpp_values_operators import binary, unary
from rebsync.reverse.values.cpp_values_plain import (
    MOST,
    Frame,
    Function,
    Nothing,
    OpenCallers,
    Use,
    Value,
    choice,
    each,
)
from rebsync.reverse.values.cpp_values_ros2 import literal, named_by_ros2
from rebsync.reverse.values.cpp_values_variables import Variables

T = TypeVar("T")

_DEEPEST = 48
_LONGEST = 6
_STEPS = 1_500  # the longest question on public code takes 800
_KNOWN = {
    "M_PI": 3.141592653589793,
    "M_PI_2": 1.5707963267948966,
    "M_PI_4": 0.7853981633974483,
    "INT_MAX": 2147483647,
    "INT32_MAX": 2147483647,
}
_NONE = frozenset({"NULL", "nullptr"})
# Their values are not kept: to find them takes no longer.
_LITERALS = frozenset({"string_literal", "true", "false", "null"})


@dataclass(slots=True)
class Values(CppEvaluator):
    """Finds the values of expressions in some code."""

    variables: Variables = field(init=False)
    _active: set[tuple[int, int]] = field(default_factory=set)
    _memo: dict[tuple[int, int], tuple[Value, Frame]] = field(default_factory=dict)
    _steps: int = 0

    def __post_init__(self) -> None:
        self.texts = Texts(self.code)
        self.types = Types(self.texts)
        self.calls = Calls(self.texts, self.types)
        self.variables = Variables(self)

    def end(self) -> None:
        """Lets go of what refers back to it: nothing is asked of it any more."""
        self.variables.end()
        del self.variables

    # --- ways into a function -------------------------------------------------------------------

    def settle(self, frame: Frame, do: Callable[[Frame], T]) -> list[T]:
        """What `do` gives in a frame; if it asks for open parameters, for each of the callers.

        Callers outside of the files count only where there are none inside.
        """
        return self.settle_all([frame], do)

    def settle_all(
        self, frames: list[Frame], do: Callable[[Frame], T], used: list[Frame] | None = None
    ) -> list[T]:
        """As `settle`, for several frames; `used` gets the frames that gave something."""
        waiting = [*frames]
        inside: list[T] = []
        outside: list[T] = []
        while waiting and len(inside) + len(outside) < MOST:
            current = waiting.pop(0)
            try:
                result = do(current)
            except OpenCallers as asked:
                if asked.frame is not current.root:
                    raise
                waiting += self._called(current)
                continue
            if used is not None:
                used.append(current)
            root = current.root
            away = root.outside or (root is not current and self._is_unused(root))
            (outside if away else inside).append(result)
        self.truncated = self.truncated or bool(waiting)
        return inside or outside

    def _is_unused(self, frame: Frame) -> bool:
        """Whether a frame is that of a constructor by which no file makes an object."""
        function = frame.function
        if function is None or function.name != function.owner:
            return False
        return not self.calls.uses(function)

    def _called(self, frame: Frame) -> Iterator[Frame]:
        """The frame with each of the calls that lead into it."""
        root = frame.root
        uses = self.calls.uses(root.function) if root.function is not None else []
        uses = [u for u in uses if not _on_the_way(frame, u)]
        self.truncated = (
            self.truncated or len(uses) > MOST or (frame.depth >= _LONGEST and bool(uses))
        )
        if frame.depth >= _LONGEST or not uses:
            yield _with_root(frame, Frame(root.cpp, root.function, outside=True))
            return
        for use in uses[:MOST]:
            caller = Frame(use.cpp, use.around)
            yield _with_root(frame, Frame(root.cpp, root.function, use, caller))

    def open_frame(self, cpp: Cpp, node: Node) -> Frame:
        """A frame for a place, its callers open."""
        return Frame(cpp, self.texts.function_around(cpp, node))

    # --- expressions ----------------------------------------------------------------------------

    def fresh(self) -> None:
        """Begins a question of its own: nothing of the one before counts against it."""
        self._steps = 0
        self.truncated = False
        self._active.clear()
        self._memo.clear()
        self.variables.fresh()

    def value(self, node: Node, frame: Frame) -> Value:
        """The value of an expression in a frame. Open: it needs the frame's callers."""
        key = node.id, id(frame)
        self._steps += 1
        if key in self._active:
            self.cuts += 1
            return Nothing()
        if key in self._memo:
            return self._memo[key][0]
        if len(self._active) > _DEEPEST or self._steps > _STEPS:
            return self.unknown("too far to follow", node, frame)
        if node.type in _LITERALS:
            return self._value(node, frame)
        self._active.add(key)
        before = self.cuts
        try:
            value = self._value(node, frame)
        finally:
            self._active.discard(key)
        value = self.bounded(value, node, frame)
        if self.cuts == before:
            self._memo[key] = value, frame
        return value

    def _value(self, node: Node, frame: Frame) -> Value:
        match node.type:
            case "string_literal" | "concatenated_string":
                text = string_of(node)
                return text if text is not None else self.unknown("a text of macros", node, frame)
            case "raw_string_literal" | "char_literal":
                return "".join(text_of(c) for c in node.named_children[-1:]) or text_of(node)
            case "number_literal":
                return _number(node, self, frame)
            case "true" | "false":
                return node.type == "true"
            case "null":
                return Nothing()
            case "identifier" | "field_identifier" | "type_identifier" | "qualified_identifier":
                return self._named(node, frame)
            case "field_expression":
                return self.variables.field_value(node, frame)
            case "call_expression":
                return called_value(self, node, frame)
            case "new_expression" | "compound_literal_expression":
                return self._constructed(node, frame)
            case "lambda_expression":
                return Function(node, frame)
            case "user_defined_literal":
                return literal(self, node, frame)
            case _:
                return self._combined(node, frame)

    def _combined(self, node: Node, frame: Frame) -> Value:
        match node.type:
            case "parenthesized_expression" | "condition_clause":
                inside = named(node)
                value = self.value(inside[-1], frame) if inside else Nothing()
                return each(_in_parentheses, value)
            case "pointer_expression":
                return self._pointed(node, frame)
            case "unary_expression":
                return unary(self, node, frame)
            case "binary_expression":
                return binary(self, node, frame)
            case "conditional_expression":
                return self._conditional(node, frame)
            case "cast_expression":
                type_ = self.types.plain(frame.cpp, part(node, "type"))
                return converted(self.value(part(node, "value"), frame), type_)
            case "assignment_expression":
                return self.value(part(node, "right"), frame)
            case "initializer_list":
                return self._listed(node, frame)
            case "subscript_expression":
                return self._picked(node, frame)
            case _:
                return self.unknown("no expression that is followed", node, frame)

    def _listed(self, node: Node, frame: Frame) -> Value:
        found = [self.value(n, frame) for n in named(node)]
        plain = [v for v in found if isinstance(v, (bool, int, float, str, tuple))]
        if len(found) == 1:
            return found[0]
        if len(plain) == len(found):
            return tuple(plain) if plain else Nothing()
        return self.unknown("a list that is not known", node, frame)

    def _picked(self, node: Node, frame: Frame) -> Value:
        listed = self.value(part(node, "argument"), frame)
        indices = named(part(node, "indices"))
        index = self.value(indices[0], frame) if len(indices) == 1 else None
        if isinstance(listed, tuple) and listed:
            if isinstance(index, int) and 0 <= index < len(listed):
                return listed[index]
            return choice(listed)
        return self.unknown("an element picked at run time", node, frame)

    def _pointed(self, node: Node, frame: Frame) -> Value:
        argument = part(node, "argument")
        if argument.type == "qualified_identifier" and node.children[0].type == "&":
            return Function(node, frame)
        return self.value(argument, frame)

    def _constructed(self, node: Node, frame: Frame) -> Value:
        given = node.child_by_field_name("arguments") or node.child_by_field_name("value")
        arguments = tuple(named(given)) if given is not None else ()
        use = Use(frame.cpp, node, arguments, frame.function)
        return constructed(self, self.types.plain(frame.cpp, part(node, "type")), use, frame)

    def _named(self, node: Node, frame: Frame) -> Value:
        text = "".join(text_of(node).split())
        name = text.rpartition("::")[2]
        if name in _KNOWN:
            return _KNOWN[name]
        if name in _NONE:
            return Nothing()
        variable = self.types.variable(frame.cpp, node)
        if variable is not None:
            return self.variables.value(variable, "", node, frame)
        found = self._enumerator(text, frame.cpp)
        if found is not None:
            return found
        constants = self.code.constants_for(frame.cpp)
        constant = constants.get(text) or constants.get(name)
        if constant is not None:
            return self._constant(*constant)
        if self.code.definitions.get(("", name)):
            return Function(node, frame)
        if (known := named_by_ros2(text)) is not None:
            return known
        return self.unknown(f"{text} is not declared in the files", node, frame)

    def _constant(self, cpp: Cpp, node: Node) -> Value:
        inside = named(node) if node.type in ("argument_list", "initializer_list") else [node]
        return self.value(inside[0], Frame(cpp)) if len(inside) == 1 else Nothing()

    def _enumerator(self, text: str, cpp: Cpp) -> int | None:
        scope, _, name = text.rpartition("::")
        scope = scope.rpartition("::")[2]
        found = self.code.enumerators.get(name, [])
        found = [e for e in found if not scope or scope in (e.enum, e.scope)] or found
        return max(found, key=lambda e: nearness(e.cpp, cpp)).value if found else None

    def _conditional(self, node: Node, frame: Frame) -> Value:
        known = self.holds(part(node, "condition"), frame)
        yes, no = part(node, "consequence"), part(node, "alternative")
        sides = [yes] if known is True else [no] if known is False else [yes, no]
        return choice([self.value(side, frame) for side in sides])


def _on_the_way(frame: Frame, use: Use) -> bool:
    at_: Frame | None = frame
    while at_ is not None:
        if at_.call is not None and at_.call.node == use.node:
            return True
        if at_.function is not None and at_.function is use.around:
            return True
        at_ = at_.caller
    return False


def _with_root(frame: Frame, root: Frame) -> Frame:
    if frame.caller is None:
        return root
    return Frame(frame.cpp, frame.function, frame.call, _with_root(frame.caller, root))


def _number(node: Node, values: Values, frame: Frame) -> Value:
    found = numeral(text_of(node))
    # what no type of C++ holds is no constant either
    if found is None or (found.whole or 0) >= 1 << 64:
        return values.unknown(f"the number {text_of(node)}", node, frame)
    return found.value


def _in_parentheses(value: Value) -> Value:
    if not isinstance(value, FromParameter) or value.expression is None:
        return value
    expression = f"({value.expression})"
    return FromParameter(value.name, value.default, expression, value.search, value.within)
