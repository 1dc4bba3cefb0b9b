"""Values that stand for all that the comparisons of some code do not tell apart.

Where the code only compares a member with constants, of a value that nobody knows it matters only
between which of these it lies.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.bodies.scope import Variable
from rebsync.reverse.libraries import cpp as libraries
from rebsync.reverse.models.building import number_literal
from rebsync.reverse.syntax.cpp_calls import call_of
from rebsync.reverse.syntax.cpp_numbers import constant_number
from rebsync.reverse.syntax.cpp_tree import Cpp, named, text_of
from rebsync.reverse.syntax.cpp_words import places_of
from rebsync.static.types import is_floating, is_integer

_COMPARES = frozenset({"<", ">", "<=", ">=", "==", "!="})
_NAMES = frozenset({"identifier", "field_identifier", "preproc_arg"})
_DECLARES = frozenset({"field_declaration", "field_initializer"})
_STORES = frozenset({"param", "getParam", "getParamCached", "get", "getCached"})
_REAL = re.compile(r"[-+]?(\d+\.\d*|\.\d+|\d+)([eE][-+]?\d+)?[fF]?\Z")
_MOST = 24  # values
_RANGES = {"byte": 7, "short": 15, "int": 31}


@dataclass(slots=True)
class Regions:
    """Looks for the comparisons of members. `names` are those that the code has for variables."""

    files: Sequence[Cpp]
    names: Mapping[str, str]
    enumerators: Mapping[str, int | str]
    constants: Mapping[str, tuple[Cpp, Node]]
    _found: dict[str, tuple[m.Expression, ...]] = field(default_factory=dict)

    def of(self, variable: Variable) -> tuple[m.Expression, ...]:
        """One value of each range; none where the code does more than to compare the variable."""
        if variable.name not in self.names or variable.type is None or variable.type.dimensions:
            return ()
        if variable.name not in self._found:
            self._found[variable.name] = self._values(variable)
        return self._found[variable.name]

    def _values(self, variable: Variable) -> tuple[m.Expression, ...]:
        assert variable.type is not None
        bounds: set[float] = set()
        for node in self._places(self.names[variable.name]):
            found = self._compared(node)
            if found is None:
                return ()
            bounds |= found
        if len(bounds) > _MOST or not all(map(math.isfinite, bounds)):
            return ()
        if is_floating(variable.type):
            return tuple(map(_real, _between(sorted(bounds))))
        if not is_integer(variable.type):
            return ()
        bits = variable.bits or _RANGES[variable.type.name]
        unsigned = bool(variable.bits) or variable.wide in (32, 64)
        whole = (
            {0}
            if not bounds
            else {
                int(f(b)) + s for b in bounds for f in (math.floor, math.ceil) for s in (-1, 0, 1)
            }
        )
        least = 0 if unsigned else -(1 << bits)
        return tuple(number_literal(n) for n in _apart(whole, bounds) if least <= n < 1 << bits)

    # --- where a name stands --------------------------------------------------------------------

    def _places(self, name: str) -> Iterator[Node]:
        word = name.encode()
        for cpp in self.files:
            for at in places_of(cpp.data, word):
                node = cpp.root.descendant_for_byte_range(at, at + len(word))
                if node is not None and node.type in _NAMES:
                    yield node

    def _compared(self, node: Node) -> set[float] | None:
        """The numbers that a variable is compared with where it stands; None for other uses."""
        at, above = node, node.parent
        while above is not None and (
            above.type == "parenthesized_expression"
            or (above.type == "field_expression" and text_of(above).startswith("this->"))
        ):
            at, above = above, above.parent
        if above is None:
            return None
        match above.type:
            case kind if kind in _DECLARES:
                values = above.children_by_field_name("default_value")
                return set() if all(v.id != at.id for v in values) else None
            case "assignment_expression":
                return set() if _is_written(above, at) else None
            case "binary_expression":
                return self._with(above, at)
            case "condition_clause" if (switch := above.parent) is not None:
                return self._cases(switch) if switch.type == "switch_statement" else None
            case "argument_list":
                return set() if _is_harmless(above) else None
            case _:
                return None

    def _with(self, comparison: Node, side: Node) -> set[float] | None:
        sides = [comparison.child_by_field_name(s) for s in ("left", "right")]
        operator = comparison.child_by_field_name("operator")
        others = [s for s in sides if s is not None and s.id != side.id]
        if operator is None or text_of(operator) not in _COMPARES or len(others) != 1:
            return None
        value = self._number(others[0])
        return {value} if value is not None else None

    def _cases(self, switch: Node) -> set[float] | None:
        found: set[float] = set()
        for case in named(switch.child_by_field_name("body") or switch):
            value = case.child_by_field_name("value")
            number = self._number(value) if value is not None else None
            if value is not None and number is None:
                return None
            found |= {number} if number is not None else set()
        return found

    def _number(self, node: Node) -> float | None:
        text = text_of(node).strip("()").replace(" ", "")
        if _REAL.match(text) and not text.isdecimal():
            return float(text.rstrip("fF"))
        return constant_number(node, self._named)

    def _named(self, name: str) -> int | None:
        if name in self.enumerators:
            value = self.enumerators[name]
            return value if isinstance(value, int) else None
        known = self.constants.get(name.rpartition("::")[2])
        return constant_number(known[1], lambda _: None) if known is not None else None


def _is_written(assignment: Node, side: Node) -> bool:
    """Whether an assignment gives it a value that nothing else gets."""
    left = assignment.child_by_field_name("left")
    operator = assignment.child_by_field_name("operator")
    above = assignment.parent
    plain = operator is not None and text_of(operator) == "="
    alone = above is not None and above.type == "expression_statement"
    return left is not None and left.id == side.id and plain and alone


def _is_harmless(arguments: Node) -> bool:
    """Whether a call only logs it, or gives it the value of a parameter."""
    call = call_of(arguments.parent) if arguments.parent is not None else None
    if call is None:
        return False
    return call.name.startswith(libraries.logging()) or call.name.rpartition("::")[2] in _STORES


def _apart(whole: set[int], bounds: set[float]) -> list[int]:
    """Of whole numbers the first in each range between the bounds, and the bounds."""
    found: dict[tuple[bool, ...], int] = {}
    ordered = sorted(bounds)
    for number in sorted(whole):
        key = tuple(x for bound in ordered for x in (number < bound, number > bound))
        found.setdefault(key, number)
    return sorted(found.values())


def _between(bounds: Sequence[float]) -> list[float]:
    """The bounds, what lies between each two, and what lies outside."""
    found = [bounds[0] - 1.0 if bounds else 0.0]
    for index, bound in enumerate(bounds):
        found.append(bound)
        last = index + 1 == len(bounds)
        found.append(bound + 1.0 if last else (bound + bounds[index + 1]) / 2)
    return found


def _real(value: float) -> m.Expression:
    positive = m.FloatLiteral(f"{abs(value)!r}d")
    return m.Unary("-", positive) if value < 0 else positive
