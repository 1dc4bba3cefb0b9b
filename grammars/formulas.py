"""Tells the parts of a formula that speak of time apart from its state expressions."""

from __future__ import annotations

from typing import cast

from rebsync import model as m
from rebsync import properties as p
from rebsync.diagnostics import Diagnostic, did_you_mean
from rebsync.records import dataclass
from rebsync.source import Span

_LTL = {"G": 1, "F": 1, "X": 1, "U": 2, "W": 2}
_TCTL = {"AG": 1, "AF": 1, "AU": 2, "EG": 1, "EF": 1, "EU": 2}
OPERATORS = {"LTL": _LTL, "TCTL": _TCTL}
"""The temporal operators of each section, with the formulas that each takes."""
_COMPARISONS = ("<", "<=", ">", ">=", "==")


def lift(expression: m.Expression, section: str, found: list[Diagnostic]) -> p.Formula:
    """The formula that an expression of a section stands for; mistakes go to `found`."""
    return _Lifting(section, found).formula(expression)


@dataclass(frozen=True, slots=True)
class _Lifting:
    section: str
    found: list[Diagnostic]

    def formula(self, node: m.Expression) -> p.Formula:
        match node:
            case m.Paren(inner):
                lifted = self.formula(inner)
                return node if lifted is inner else lifted
            case m.Binary("->", left, right):
                return p.Implies(self.formula(left), self.formula(right), node.span)
            case m.Binary("&&" | "||" as operator, left, right):
                below = (self.formula(left), self.formula(right))
                if below[0] is left and below[1] is right:
                    return node
                kind = p.And if operator == "&&" else p.Or
                return kind(*below, node.span)
            case m.Unary("!", operand):
                inside = self.formula(operand)
                return node if inside is operand else p.Not(inside, node.span)
            case m.Call():
                return self._operator(node)
            case _:
                return self._state(node)

    def _operator(self, call: m.Call) -> p.Formula:
        known = OPERATORS.get(self.section, {})
        if call.name not in known:
            self._no_operator(call)
            return m.Broken(call.span)
        arguments = call.arguments
        bound = None
        if self.section == "TCTL" and arguments and _is_bound(arguments[0]):
            bound, arguments = self._bound(cast("m.Binary", arguments[0])), arguments[1:]
        wanted = known[call.name]
        if len(arguments) != wanted:
            self._report(
                "RS907",
                call.span,
                f"{call.name} takes {wanted} formula{'s' * (wanted > 1)}, not {len(arguments)}",
                _shape(call.name, wanted, self.section),
            )
            return m.Broken(call.span)
        operands = tuple(self.formula(each) for each in arguments)
        if self.section == "TCTL":
            return p.Tctl(cast("p.TctlOperator", call.name), bound, operands, call.span)
        return p.Ltl(cast("p.LtlOperator", call.name), operands, call.span)

    def _no_operator(self, call: m.Call) -> None:
        home = next((s for s, known in OPERATORS.items() if call.name in known), None)
        if home:
            message = f"the temporal operator {call.name} cannot stand in {_place(self.section)}"
            self._report("RS906", call.span, message, f"it belongs into {home} {{ ... }}")
        else:
            known = OPERATORS.get(self.section, {})
            message = f'unknown operator "{call.name}"'
            hint = did_you_mean(call.name, known) or (
                "known here: " + ", ".join(known) if known else "properties call no methods"
            )
            self._report("RS906", call.name_span, message, hint)

    def _bound(self, bound: m.Binary) -> p.TimeBound | None:
        if bound.operator in _COMPARISONS:
            comparison = cast("p.TimeBound", bound.operator)
            return p.TimeBound(comparison, bound.right, bound.span)  # type: ignore[arg-type]
        self._report("RS907", bound.span, f"time cannot be bounded with {bound.operator}")
        return None

    def _state(self, node: m.Expression) -> p.Formula:
        """Temporal operators and `->` cannot hide in arithmetic."""
        for below in m.walk(node):
            match below:
                case m.Call():
                    self._report(
                        "RS906", below.span, f"{below.name}(...) cannot be part of an expression"
                    )
                    return m.Broken(node.span)
                case m.Binary("->"):
                    self._report("RS906", below.span, "`->` cannot be part of an expression")
                    return m.Broken(node.span)
        return node

    def _report(self, code: str, span: Span, message: str, hint: str | None = None) -> None:
        self.found.append(Diagnostic(code, span, message, hint))


def _is_bound(node: m.Expression) -> bool:
    return isinstance(node, m.Binary) and node.left == m.Name("time")


def _place(section: str) -> str:
    return "a define" if section == "define" else f"{section} {{ ... }}"


def _shape(name: str, count: int, section: str) -> str:
    formulas = "p" if count == 1 else "p, q"
    if section == "TCTL":
        return f"write {name}({formulas}) or {name}(time <= 5, {formulas})"
    return f"write {name}({formulas})"
