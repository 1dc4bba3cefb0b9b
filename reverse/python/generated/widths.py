"""What must hold of the integers of generated Python, so that they are those of the model.

Python's integers have no width, the model's have 32 bits or fewer and wrap. A sum that nothing
cuts differs from the model's by a multiple of 2^32 at most. That is enough for what is added or cut
later on; wherever else it is used, it must be within the bounds of what is expected there. So must
the distance of a shift, which the model takes from the lowest five bits.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import field
from itertools import zip_longest

from rebsync import model as m
from rebsync.intervals import INT32, INTEGERS, Interval
from rebsync.records import dataclass
from rebsync.reverse.analysis.intervals.needs import Mark, Need
from rebsync.reverse.analysis.intervals.writes import array_of, is_own, own
from rebsync.reverse.models.building import bare
from rebsync.reverse.python.generated.cuts import Cut, other_division
from rebsync.reverse.python.generated.kinds import is_floating, kind_of, type_of
from rebsync.source import NOWHERE, Span

_SUMS = frozenset({"+", "-", "*", "&", "|", "^"})
_SIGNS = frozenset({"+", "-", "~"})
_DISTANCES = Interval(0, 31)
# Numbers that are no index of an array of less than 2^30 elements, or are the same cut to 32 bits.
_INDICES = Interval(-(3 << 30), (1 << 32) - 1)
_TESTS = frozenset({"<", "<=", ">", ">=", "==", "!=", "&&", "||"})
_EXACT = Interval(-(1 << 24), 1 << 24)  # the integers that 32 bits with a point hold
_OTHER = "not the number of the model"
_UNROUNDED = f"{_OTHER}: not rounded to 32 bits"
_ASSIGNMENT = re.compile(r"([\w.\[\]]+) (?:([-+*&|^])=|=) ([^=\n]+)")


@dataclass(frozen=True, slots=True)
class WidthContext:
    """The types around a body: of names, of what functions give, and of what they take."""

    types: Mapping[str, m.Type]
    results: Mapping[str, m.Type]
    taken: Mapping[str, Sequence[m.Type | None]]
    cuts: Mapping[int, Cut]
    rounded: Collection[int]
    called: Mapping[int, tuple[m.Expression, str]]
    floored: Mapping[int, m.Binary]


@dataclass(frozen=True, slots=True)
class Wanted:
    """What must hold of the integers of a body, and what does not whatever they are."""

    needs: Mapping[int, Sequence[Need]]
    told: Sequence[Mark]


def wanted_of(body: m.Block, result: m.Type, path: str, known: WidthContext) -> Wanted:
    """What must hold of the integers of a body, so that they are those of the model."""
    widths = _Widths(known, path, result, dict(known.types))
    widths.block(body)
    for key, division in known.floored.items():
        if key not in widths.divided:  # it became something else, which nothing is asked of
            widths.tell(division, _floored(division))
    return Wanted(widths.needs, widths.told)


@dataclass(slots=True)
class _Widths:
    """Collects what must hold, for the interval analysis; `types` are those of the names here."""

    known: WidthContext
    path: str
    result: m.Type
    types: dict[str, m.Type]
    needs: dict[int, list[Need]] = field(default_factory=dict)
    told: list[Mark] = field(default_factory=list)
    divided: set[int] = field(default_factory=set)
    against_zero: set[int] = field(default_factory=set)  # operands of `== 0` and `!= 0`
    at: Span = NOWHERE

    # --- statements -----------------------------------------------------------------------------

    def block(self, block: m.Block) -> None:
        outer = dict(self.types)
        for statement in block.statements:
            self.statement(statement)
        self.types = outer

    def statement(self, statement: m.Statement) -> None:
        self.at = statement.span if statement.span != NOWHERE else self.at
        match statement:
            case m.Block():
                self.block(statement)
            case m.ExpressionStatement(expression):
                self.used(expression, None)
            case m.Local(declaration):
                self._declared(declaration)
            case m.If(condition, then, otherwise):
                self.used(condition, INT32)
                self.statement(then)
                if otherwise is not None:
                    self.statement(otherwise)
            case m.While(condition, body):
                self.used(condition, INT32)
                self.statement(body)
            case m.For():
                self._for(statement)
            case m.Switch(subject, cases):
                self.used(subject, INT32)
                for case in cases:
                    self.block(m.Block(case.statements))
            case m.Return(value) if value is not None:
                self._given(value, self.result)
            case _:
                pass
        for annotation in statement.annotations:
            for argument in annotation.arguments or ():
                self._moved(argument)

    def _declared(self, declaration: m.Declaration) -> None:
        for declarator in declaration.declarators:
            waiting = [declarator.initial] if declarator.initial is not None else []
            while waiting:
                value = waiting.pop()
                if isinstance(value, m.ArrayInitializer):
                    waiting += value.values
                else:
                    self._given(value, declaration.type)
            self.types[declarator.name] = declaration.type

    def _for(self, loop: m.For) -> None:
        outer = dict(self.types)
        if isinstance(loop.initial, m.Declaration):
            self._declared(loop.initial)
        else:
            for expression in loop.initial or ():
                self.used(expression, None)
        if loop.condition is not None:
            self.used(loop.condition, INT32)
        self.statement(loop.body)
        self.at = loop.span
        for update in loop.updates:
            self.used(update, None)
        self.types = outer

    def _moved(self, cells: m.Expression) -> None:
        """How far a robot moves, of which the model says where it is then."""
        match cells:
            case m.Binary("+" | "-", m.Name("X" | "Y"), distance):
                self.used(distance, INT32)
            case _:
                self.used(cells, INT32)

    # --- expressions ----------------------------------------------------------------------------

    def _given(self, value: m.Expression, type_: m.Type | None) -> None:
        """A value that is stored, passed or returned as one of a type."""
        name = type_.name if type_ is not None else ""
        inner = bare(value)
        is_cut = id(inner) in self.known.cuts or id(inner) in self.known.rounded
        if isinstance(inner, m.Conditional) and not is_cut:
            around = self.at
            self.at = inner.span if inner.span != NOWHERE else around
            self.used(inner.condition, INT32)
            self._given(inner.then, type_)
            self._given(inner.otherwise, type_)
            self.at = around
            return
        wanted = INTEGERS.get(name, _EXACT if name == "float" and not is_cut else INT32)
        self.used(value, wanted)
        if name in INTEGERS and self._is_real(value) and not is_cut:
            self.tell(value, _uncut(wanted))
        if name == "float" and self._real_type(value) == "double" and not is_cut:
            self.tell(value, _UNROUNDED)

    def used(self, expression: m.Expression, wanted: Interval | None) -> None:
        """An expression where a value within bounds is expected, or (None) one that may differ."""
        around = self.at
        span = getattr(expression, "span", NOWHERE)
        self.at = span if span != NOWHERE else around
        self._used(expression, wanted)
        self.at = around

    def _used(self, expression: m.Expression, wanted: Interval | None) -> None:
        match expression:
            case m.Paren(inner):
                self.used(inner, wanted)
                return
            case m.Conditional(condition, then, otherwise) if id(expression) not in self.known.cuts:
                self.used(condition, INT32)
                self.used(then, wanted)
                self.used(otherwise, wanted)
                return
            case m.Choice(options):
                for option in options:
                    self.used(option, wanted)
                return
            case _:
                pass
        if wanted is not None and self._may_be_other(expression, wanted):
            self._need(expression, wanted, _uncut(wanted))
        self._parts(expression)

    def _parts(self, expression: m.Expression) -> None:
        cut = self.known.cuts.get(id(expression))
        match expression:
            case m.Assign(operator, target, value):
                self._stored(expression, operator, target, value)
            case m.Postfix(operator, target) | m.Unary("++" | "--" as operator, target):
                self._stored(expression, f"{operator[0]}=", target, m.IntLiteral(1))
            case m.Conditional(condition, then, otherwise):
                self.used(condition, INT32)
                self.used(then, None)
                self.used(otherwise, None)
            case m.Unary(operator, operand):
                self.used(operand, None if operator in _SIGNS else INT32)
            case m.Binary(operator, left, right):
                real = self._real_type(m.Binary("+", left, right))
                if operator in ("==", "!=") and m.IntLiteral(0) in (bare(left), bare(right)):
                    self.against_zero |= {id(bare(left)), id(bare(right))}
                self._divided(expression, left, right)
                self._operands(operator, (left, right), cut, real)
                if operator not in _TESTS and self._real_type(expression) == "float":
                    self._round(expression)
            case m.Index(array, index):
                self.used(index, _INDICES)
                if array_of(expression) is None or isinstance(array, m.Index):
                    self.used(array, None)
            case m.Cast(type_, operand):
                self.used(operand, None if type_.name in INTEGERS else INT32)
            case m.Call(target, _, arguments, after, deadline):
                _, function = self.known.called.get(id(expression), (expression, ""))
                types = self.known.taken.get(function, ())
                for argument, of in zip_longest(arguments, types[: len(arguments)]):
                    self._given(argument, of)
                for time in (after, deadline):
                    if time is not None:
                        self.used(time, INT32)
                if target is not None:
                    self.used(target, None)
            case m.InstanceOf(operand):
                self.used(operand, None)
            case _:
                pass

    def _operands(
        self, operator: str, sides: Sequence[m.Expression], cut: Cut | None, real: str | None
    ) -> None:
        """What an operator computes with; of an update that is its right side alone."""
        whole = _EXACT if real == "float" else INT32
        goes_on = None if real is None else whole
        if operator in ("<<", ">>"):
            for left in sides[:-1]:
                self.used(left, goes_on if operator == "<<" else INT32)
            self.used(sides[-1], INT32 if cut is not None and cut.by_function else _DISTANCES)
        else:
            for side in sides:
                is_rounded = id(bare(side)) in self.known.rounded
                bounds = goes_on if operator in _SUMS else whole
                self.used(side, INT32 if is_rounded else bounds)

    def _divided(self, whole: m.Binary, left: m.Expression, right: m.Expression) -> None:
        """A division that rounds to the lower number: as to 0, where nothing is below that.

        Whether a remainder is 0 does not depend on how is rounded.
        """
        if id(whole) in self.known.floored:
            self.divided.add(id(whole))
            is_multiple = whole.operator == "%" and id(whole) in self.against_zero
            if not is_multiple:
                self._need(left, Interval(0, INT32.high), _floored(whole))
            self._need(right, Interval(1, INT32.high), _floored(whole))

    def _stored(
        self, whole: m.Expression, operator: str, target: m.Expression, value: m.Expression
    ) -> None:
        if isinstance(bare(target), m.Index):
            self.used(target, None)
        type_ = self._type_of(bare(target))
        wanted = INTEGERS.get(type_.name if type_ is not None else "", INT32)
        cut = self.known.cuts.get(id(whole))
        if operator == "=":
            self._given(value, type_)
            return
        real = self._real_type(m.Binary("+", target, value))
        is_rounded = id(whole) in self.known.rounded  # the function rounds its operand as well
        self._operands(operator[:-1], (value,), cut, "double" if is_rounded else real)
        is_cut = cut is not None and wanted.includes(cut.bounds)
        if not is_cut and real is None and not self._is_truth(target):
            self._need(whole, wanted, _uncut(wanted))
        if self._real_type(target) == "float" and id(whole) not in self.known.rounded:
            self.tell(whole, _UNROUNDED)

    # --- numbers with a point -------------------------------------------------------------------

    def _round(self, expression: m.Expression) -> None:
        """Tells of a number of 32 bits that is not rounded to these."""
        if id(expression) in self.known.rounded or self._real_type(expression) != "float":
            return
        self.tell(expression, _UNROUNDED)

    def _real_type(self, expression: m.Expression) -> str | None:
        found = type_of(expression, self.types.get, self.known.results)
        return found.name if found is not None and is_floating(found) else None

    # --- what may be other ----------------------------------------------------------------------

    def _may_be_other(self, expression: m.Expression, wanted: Interval) -> bool:
        """Whether an expression is an integer, so that the analysis has to look at its bounds."""
        if wanted == _EXACT and id(expression) in self.known.rounded:
            return False
        if self._is_real(expression):
            return False
        type_ = self._type_of(expression) or self._kind(expression)
        return type_ is None or type_.name in INTEGERS

    def _kind(self, expression: m.Expression) -> m.Type | None:
        return kind_of(expression, self.types.get, self.known.results)

    def _type_of(self, place: m.Expression) -> m.Type | None:
        name = array_of(place)
        if name is None:
            return None
        return self.types.get(own(name) if is_own(place) else name)

    def _is_real(self, expression: m.Expression) -> bool:
        return self._real_type(expression) is not None

    def _is_truth(self, expression: m.Expression) -> bool:
        return self._kind(expression) == m.Type("boolean")

    def tell(self, expression: m.Expression, why: str) -> None:
        span = getattr(bare(expression), "span", NOWHERE)
        span = span if span != NOWHERE else self.at
        self.told.append((self.path, span.start, span.end, why))

    def _need(self, expression: m.Expression, wanted: Interval, why: str) -> None:
        mark = (self.path, self.at.start, self.at.end, why)
        self.needs.setdefault(id(bare(expression)), []).append(Need(expression, wanted, mark))


def _uncut(wanted: Interval) -> str:
    if wanted == _DISTANCES:
        return f"{_OTHER}: shifted by any distance"
    if wanted == _EXACT:
        return _UNROUNDED
    if wanted == _INDICES:
        wanted = INT32
    return f"{_OTHER}: not cut to {(wanted.high + 1).bit_length()} bits"


def _floored(division: m.Binary) -> str:
    return other_division("//" if division.operator == "/" else division.operator)


def hint_of(text: str, why: str) -> str:
    """What to write for an expression, by why it is another than that of the model."""
    format_ = "float" if why == _UNROUNDED else "int"
    bits = "".join(filter(str.isdecimal, why))
    if bits and (assigned := _ASSIGNMENT.fullmatch(text)):
        target, operator, value = assigned.groups()
        if operator:
            operand = value if re.fullmatch(r"[\w.]+", value) else f"({value})"
            value = f"{target} {operator} {operand}"
        return f"write {target} = {format_}{bits}({value})"
    if bits and not re.search(r"(?<![=<>!])=(?!=)|^\w+ \w+ in ", text):
        return f"write {format_}{bits}({text})"
    return "let the model's own functions say it: int32(...), int8(...), divide, remainder"
