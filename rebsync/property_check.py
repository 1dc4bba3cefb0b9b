"""Checks a property file against its model: names, types, definitions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field

from rebsync import model as m
from rebsync import properties as p
from rebsync.diagnostics import Diagnostic, Severity, did_you_mean
from rebsync.records import dataclass
from rebsync.source import Span
from rebsync.static import Analysis
from rebsync.static.constants import constant
from rebsync.static.operators import binary_type, unary_type
from rebsync.static.types import (
    BOOLEAN,
    DOUBLE,
    FLOAT,
    NULL,
    casts,
    common,
    element,
    integer_type,
    is_boolean,
    is_integer,
    is_numeric,
)

_OF_MESSAGES = ("now", "sender", "currentMessage")


def check_properties(
    properties: p.Properties, analysis: Analysis, *, incomplete: bool = False
) -> tuple[Diagnostic, ...]:
    """What is wrong with properties of a model; of `incomplete` ones a part was not readable."""
    check = _Check(properties, analysis, incomplete)
    try:
        check.run()
    except RecursionError:
        check.report("RS111", properties.span, "a formula nests deeper than rebsync reads")
    return tuple(sorted(check.found, key=lambda d: (d.span.start, d.code)))


def check_measure(
    formula: p.Formula, properties: p.Properties, analysis: Analysis, *, is_event: bool = False
) -> tuple[Diagnostic, ...]:
    """What is wrong with an expression to be measured, or an event, which must be true or false.

    It may use the definitions of the properties, which have no mistakes.
    """
    check = _Check(properties, analysis, False)
    try:
        if is_event:
            check.event(formula)
        else:
            check.measure(formula)
    except RecursionError:
        check.report("RS111", properties.span, "a formula nests deeper than rebsync reads")
    return tuple(check.found)


@dataclass
class _Check:
    """One file being checked; `types` are those of the defines known so far."""

    properties: p.Properties
    analysis: Analysis
    incomplete: bool
    found: list[Diagnostic] = field(default_factory=list)
    defines: dict[str, p.Define] = field(default_factory=dict)
    types: dict[str, m.Type | None] = field(default_factory=dict)
    rebecs: dict[str, m.Rebec] = field(default_factory=dict)
    used: set[str] = field(default_factory=set)
    open: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        main = self.analysis.model.main
        self.rebecs = {rebec.name: rebec for rebec in (main.rebecs if main else ())}
        self.defines = {define.name: define for define in reversed(self.properties.defines)}

    def run(self) -> None:
        self._unique(self.properties.defines)
        self._unique(self.properties.all)
        for define in self.properties.defines:
            self._define(define)
        for each in self.properties.all:
            self._truth(each.formula, f'the property "{each.name}"')
        for define in self.properties.defines:
            if define.name not in self.used:
                self._unused(define)

    def measure(self, formula: p.Formula) -> None:
        type_ = self._formula(formula)
        if type_ is None or is_integer(type_) or is_boolean(type_):
            return
        hint = "cast it: (int) (...)" if is_numeric(type_) else None
        message = f"only whole numbers and truth values are measured, not a {type_}"
        self.report("RS903", formula.span, message, hint)

    def event(self, formula: p.Formula) -> None:
        self._truth(formula, "an event")

    # --- definitions

    def _unique(self, entries: tuple[p.Define, ...] | tuple[p.Property, ...]) -> None:
        first: dict[str, Span] = {}
        for entry in entries:
            if entry.name in first:
                related = ((first[entry.name], "first defined here"),)
                message = f'"{entry.name}" is defined twice'
                self.report("RS905", entry.name_span, message, related=related)
            first.setdefault(entry.name, entry.name_span)

    def _define(self, define: p.Define) -> m.Type | None:
        name = define.name
        if name in self.types:
            return self.types[name]
        if name in self.open:
            circle = " -> ".join([*self.open[self.open.index(name) :], name])
            message = f'the definition of "{name}" depends on itself: {circle}'
            self.report("RS904", define.name_span, message)
            self.types[name] = None
            return None
        self.open.append(name)
        type_ = self._formula(define.value)
        self.open.pop()
        return self.types.setdefault(name, type_)

    def _unused(self, define: p.Define) -> None:
        message = f'the definition "{define.name}" is never used'
        self.report("RS910", define.name_span, message, severity=Severity.WARNING)

    # --- formulas

    def _formula(self, formula: p.Formula) -> m.Type | None:
        match formula:
            case p.Not() | p.And() | p.Or() | p.Implies() | p.Ltl():
                self._truths(formula)
                return BOOLEAN
            case p.Tctl(_, bound):
                if bound:
                    self._bound(bound)
                self._truths(formula)
                return BOOLEAN
            case _:
                return self._expression(formula)

    def _truths(self, formula: p.Formula) -> None:
        for operand in p.operands(formula):
            self._truth(operand, "this part")

    def _truth(self, formula: p.Formula, of: str) -> None:
        type_ = self._formula(formula)
        if type_ is None or is_boolean(type_):
            return
        hint = "write a comparison, such as x != 0" if is_numeric(type_) else None
        message = f"{of} must be true or false, but it is of the type {type_}"
        self.report("RS903", formula.span, message, hint)

    def _bound(self, bound: p.TimeBound) -> None:
        type_ = self._expression(bound.limit)
        if type_ is None:
            return
        value = constant(bound.limit, self._constant)
        if not is_integer(type_) or value is None or value < 0:
            message = "a time bound must be a constant whole number, 0 or more"
            self.report("RS907", bound.limit.span, message)

    def _constant(self, name: m.Name) -> int | float | bool | None:
        env = self.analysis.env.get(name.name)
        return env.value if env else None

    # --- expressions

    def _expression(self, node: m.Expression) -> m.Type | None:
        match node:
            case m.Paren(inner):
                return self._expression(inner)
            case m.IntLiteral(value) if value > 2**31:
                self.report("RS305", node.span, "the number does not fit an int of 32 bits")
                return None
            case m.IntLiteral(value):
                return integer_type(value)
            case m.FloatLiteral():
                return DOUBLE if node.is_double else FLOAT
            case m.BoolLiteral():
                return BOOLEAN
            case m.NullLiteral():
                return NULL
            case m.Name():
                return self._name(node)
            case m.Member():
                return self._member(node)
            case m.Index():
                return self._index(node)
            case m.Unary(operator, operand):
                return self._unary(node, operator, self._expression(operand))
            case m.Binary():
                return self._binary(node)
            case m.Conditional():
                return self._conditional(node)
            case m.Cast(type_, operand):
                return self._cast(node, type_, self._expression(operand))
            case m.Broken():
                return None
            case _:
                self.report("RS908", node.span, "this cannot stand in a property")
                return None

    def _name(self, node: m.Name) -> m.Type | None:
        name = node.name
        if name in self.defines:
            self.used.add(name)
            return self._define(self.defines[name])
        if name in self.rebecs:
            return self.rebecs[name].type
        if env := self.analysis.env.get(name):
            return env.type
        if not self.incomplete:
            self._unknown(node)
        return None

    def _unknown(self, node: m.Name) -> None:
        if node.name == "time" or node.name.startswith(_OF_MESSAGES):
            hint: str | None = "properties speak of state variables; AG(time <= 5, p) of time"
        else:
            known = (*self.defines, *self.rebecs, *self.analysis.env)
            hint = did_you_mean(node.name, known) or self._owner_hint(node.name)
        self.report("RS901", node.span, f'unknown name "{node.name}"', hint)

    def _owner_hint(self, variable: str) -> str | None:
        for rebec in self.rebecs.values():
            if variable in self._variables(rebec):
                return f"write {rebec.name}.{variable}"
        return None

    def _member(self, node: m.Member) -> m.Type | None:
        if not isinstance(node.target, m.Name):
            if self._expression(node.target) is not None:
                message = "only the variables of a rebec of main can be reached"
                self.report("RS908", node.span, message, "write rebec.variable")
            return None
        rebec = self.rebecs.get(node.target.name)
        if rebec is None:
            self._no_rebec(node.target)
            return None
        variables = self._variables(rebec)
        if node.name in variables:
            return variables[node.name]
        if rebec.type.name in self.analysis.classes:
            self._no_variable(node, rebec, variables)
        return None

    def _no_rebec(self, target: m.Name) -> None:
        hint = did_you_mean(target.name, self.rebecs)
        if target.name in self.analysis.classes:
            of = [r.name for r in self.rebecs.values() if r.type.name == target.name]
            hint = f"write the rebec, not its class: {' or '.join(of)}" if of else None
        message = f'main has no rebec "{target.name}"'
        self.report("RS901", target.span, message, hint)

    def _no_variable(
        self, node: m.Member, rebec: m.Rebec, variables: Mapping[str, m.Type | None]
    ) -> None:
        info = self.analysis.classes[rebec.type.name]
        hint = did_you_mean(node.name, variables)
        if any(known.name == node.name for known in info.known):
            hint = "known rebecs are fixed in main: properties speak of state variables"
        elif node.name in info.callables:
            hint = "this is a server or method: properties speak of state variables"
        message = f'"{rebec.type.name}" has no state variable "{node.name}"'
        self.report("RS902", node.name_span, message, hint)

    def _variables(self, rebec: m.Rebec) -> dict[str, m.Type | None]:
        info = self.analysis.classes.get(rebec.type.name)
        return {symbol.name: symbol.type for symbol in (info.state if info else ())}

    def _index(self, node: m.Index) -> m.Type | None:
        array, index = self._expression(node.target), self._expression(node.index)
        if index is not None and not is_integer(index):
            self.report("RS903", node.index.span, "an index must be a whole number")
        if array is None:
            return None
        if not array.dimensions:
            self.report("RS903", node.span, f"only an array has an index, not a {array}")
            return None
        value = constant(node.index, self._constant)
        if isinstance(value, int) and not 0 <= value < array.dimensions[0]:
            message = f"the index {value} is outside of 0 to {array.dimensions[0] - 1}"
            self.report("RS909", node.index.span, message)
        return element(array)

    def _unary(self, node: m.Unary, operator: str, operand: m.Type | None) -> m.Type | None:
        if operand is None:
            return None
        result = None if operand.dimensions else unary_type(operator, operand)
        if result is None:
            self.report("RS903", node.span, f"{operator} is not for a value of the type {operand}")
        return result

    def _binary(self, node: m.Binary) -> m.Type | None:
        left, right = self._expression(node.left), self._expression(node.right)
        if left is None or right is None:
            return BOOLEAN if node.operator in ("&&", "||", "==", "!=", "<", ">") else None
        result = binary_type(node.operator, left, right, self.analysis.classes)
        if result is None:
            message = f"{node.operator} is not for values of the types {left} and {right}"
            self.report("RS903", node.span, message)
        return result

    def _conditional(self, node: m.Conditional) -> m.Type | None:
        self._truth(node.condition, "the condition")
        then, otherwise = self._expression(node.then), self._expression(node.otherwise)
        if then is None or otherwise is None:
            return None
        both = common(then, otherwise, self.analysis.classes)
        if both is None:
            self.report("RS903", node.span, f"{then} or {otherwise}: both must be of one type")
        return both

    def _cast(self, node: m.Cast, target: m.Type, source: m.Type | None) -> m.Type | None:
        if source is not None and not casts(source, target, self.analysis.classes):
            self.report("RS903", node.span, f"a {source} cannot become a {target}")
        return target

    def report(
        self,
        code: str,
        span: Span,
        message: str,
        hint: str | None = None,
        *,
        related: tuple[tuple[Span, str], ...] = (),
        severity: Severity = Severity.ERROR,
    ) -> None:
        """Add one finding."""
        self.found.append(Diagnostic(code, span, message, hint, related=related, severity=severity))
