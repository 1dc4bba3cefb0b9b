"""What evaluating an expression may do: divide by zero, lack an element, name the model's."""

from __future__ import annotations

from rebsync.reverse.analysis.facts import (
    Facts,
    HasKey,
    Holds,
    IsBelow,
    IsSize,
    IsThere,
    bare,
    names_of,
    tested,
)
from rebsync.reverse.analysis.foreign_values import ForeignValues
from rebsync.reverse.analysis.held_values import held_by
from rebsync.reverse.analysis.numbers.constant_numbers import ConstantNumbers, is_floating
from rebsync.reverse.analysis.numbers.least_numbers import LeastNumbers
from rebsync.reverse.analysis.numbers.magnitudes import Magnitudes
from rebsync.reverse.analysis.numbers.signs import Signs
from rebsync.reverse.analysis.origins import AnyOrigin, ClassOrigin, LibraryOrigin, Origin
from rebsync.reverse.analysis.outcomes.element_bounds import ElementBounds
from rebsync.reverse.analysis.outcomes.library_operators import LibraryOperators
from rebsync.reverse.analysis.outcomes.undefined_lookups import UndefinedLookups
from rebsync.reverse.analysis.problems import SHIFTS_TOO_FAR, ParameterNeed, ProblemNotes
from rebsync.reverse.analysis.python.none_values import NoneValues
from rebsync.reverse.analysis.python.type_errors import TypeErrors
from rebsync.reverse.analysis.python.unset_names import UnsetNames
from rebsync.reverse.analysis.python.value_types import OwnType
from rebsync.reverse.analysis.stores import key_of
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import types as t
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.ir.walk import parts
from rebsync.reverse.libraries.outcome_classes import PLAIN_CLASSES, TERMINATES
from rebsync.reverse.libraries.routines import Language

_DIVIDING = frozenset(
    {
        *(Operator.TRUE_DIVIDE, Operator.CLASSIC_DIVIDE, Operator.FLOOR_DIVIDE),
        *(Operator.TRUNCATING_DIVIDE, Operator.FLOOR_MODULO, Operator.TRUNCATING_REMAINDER),
    }
)
_INDEXING = ("__getitem__", "__class_getitem__")
_SEQUENCES = ("list", "tuple", "deque", "str")


class OutcomeExpressions:
    """Expressions of one function."""

    def __init__(self, notes: ProblemNotes) -> None:
        self.notes = notes
        self.function = notes.function.name
        self.origins = notes.origins
        self._signs = Signs(notes)
        self.types = TypeErrors(notes)
        self.bounds = ElementBounds(notes, self._signs, self.types.kinds)
        self.undefined = UndefinedLookups(notes, self.bounds)
        self._constants = ConstantNumbers(notes.origins, notes.function.name)
        self.none = NoneValues(notes)
        self._unset = UnsetNames(notes)
        self.foreign = ForeignValues(notes.origins)
        self.operators = LibraryOperators(notes)

    def check(self, value: e.Expression, facts: Facts) -> None:
        """Notes what evaluating an expression may do."""
        match value:
            case e.And(left, right):
                self.check(left, facts)
                self.check(right, tested(facts, left, True))
            case e.Or(left, right):
                self.check(left, facts)
                self.check(right, tested(facts, left, False))
            case e.Conditional(test, then, otherwise):
                self.check(test, facts)
                self.check(then, tested(facts, test, True))
                self.check(otherwise, tested(facts, test, False))
            case e.Closure(_, _, defaults):
                for _, default in defaults:
                    self.check(default, facts)
            case _:
                for part in parts(value):
                    self._part(part, facts)
                self._itself(value, facts)

    def _part(self, part: object, facts: Facts) -> None:
        match part:
            case e.Spread(operand) | e.FormatPiece(operand):
                self.check(operand, facts)
            case e.Capture():
                pass
            case _:
                self.check(part, facts)  # type: ignore[arg-type]

    def _itself(self, value: e.Expression, facts: Facts) -> None:
        self.types.check(value, facts)
        self.none.computed(value, facts)
        if isinstance(value, e.Attribute | e.Local):
            self._unset.check(value, facts)
        self.operators.check(value)
        match value:
            case e.Binary(operator, left, right) if operator in _DIVIDING:
                self._divides(value, left, right, facts)
            case e.Binary() if self.notes.table.language is Language.PYTHON:
                self._computes(value, facts)
            case e.Binary(Operator.SHIFT_LEFT | Operator.SHIFT_RIGHT, left, right):
                self._shifts(value, left, right, facts)
            case e.Index(_, e.Slice(_, _, step)) if step is not None:
                if not self.is_nonzero(step, facts):
                    self.notes.fails(value, "has a step of zero")
            case e.Index():
                self._reads_at(value, facts)
            case e.Format(pieces):
                self._formats(value, pieces, facts)
            case e.Dereference(of):
                if isinstance(getattr(of, "type", None), t.Optional) and Holds(of) not in facts:
                    self.notes.fails(value, "is empty")
                self.undefined.pointee(value, facts)
            case e.Convert(_, _, t.Text()):
                self.undefined.text(value, facts)
            case e.Convert(_, _, t.Reference()):
                self.undefined.lifetimes.check(value, facts)
            case e.LibraryReference(name):
                if acts := self.notes.table.function(name).acts:
                    self.notes.problem(value, f'"{name}": {acts}')
            case e.Global(name) | e.ClassReference(name) | e.ModuleReference(name):
                self._names(value, name)
            case e.FunctionReference(name):
                self._names(value, name)
            case e.Attribute(e.Captured(owner), _, _, True) if self.notes.is_model(owner):
                self.notes.problem(value, "this is the model's")
            case _:
                pass

    def _names(self, value: e.Expression, name: str) -> None:
        if self.notes.is_model(name):
            self.notes.problem(value, f'"{name.rpartition("/")[2]}" is the model\'s')

    # --- division --------------------------------------------------------------------------------

    def _divides(
        self, value: e.Binary, left: e.Expression, right: e.Expression, facts: Facts
    ) -> None:
        is_cpp = self.notes.table.language is Language.CPP
        is_float = isinstance(value.type, t.Float) and not value.dynamic
        if is_cpp and (is_float or is_floating(left) or is_floating(right)):
            return  # the other operand becomes one ([expr.arith.conv])
        if value.operator is Operator.FLOOR_MODULO and self.is_text(left):
            return
        if self.types.is_path(value, facts):
            return
        if not self.is_nonzero(right, facts) and not self._constants.of(right):
            sizes = [f for f in facts if isinstance(f, IsSize) and f.value == bare(right)]
            given = [g for f in sizes if (g := self.sized_by_caller(f.container, 1)) is not None]
            self.notes.fails(value, "divides by zero", next(iter(given), None))
        if (
            is_cpp
            and LeastNumbers(self.origins, self.function).may_be(left)
            and not self.is_positive(right, facts)
        ):
            self.notes.fails(value, "divides the least number by -1")

    def _computes(self, value: e.Binary, facts: Facts) -> None:
        """Shifts and powers: by a negative number, greater than any float, complex ones; None."""
        match value:
            case e.Binary(Operator.SHIFT_LEFT | Operator.SHIFT_RIGHT, _, right):
                if not self.is_positive(right, facts):
                    self.notes.fails(value, "shifts by less than zero")
            case e.Binary(Operator.POWER, left, right):
                if not self.is_positive(right, facts) and not self.is_nonzero(left, facts):
                    self.notes.fails(value, "divides by zero")
                is_finite = Magnitudes(self.origins, self.function).is_finite
                is_written = isinstance(right, e.Literal)
                if not self._is_bounded(right, facts) or (is_written and not is_finite(value)):
                    self.notes.fails(value, "is too great")
                is_root = self.types.is_float(right) and not _is_whole(right)
                if is_root and not self.is_positive(left, facts):
                    self.notes.fails(value, "may be a complex number")
            case e.Binary(Operator.IN | Operator.NOT_IN, left, right):
                if OwnType.TEXT in self.types.kinds.of(right, facts):
                    self.none.check(left, value, facts)
            case _:
                pass

    def _shifts(
        self, value: e.Binary, left: e.Expression, right: e.Expression, facts: Facts
    ) -> None:
        """A number has as many bits as it is promoted to; streams are of no such type."""
        type_ = getattr(left, "type", t.UNKNOWN)
        if isinstance(type_, t.Integer) and not _is_streamed(value):
            by = self.bounds.range_of(right, facts)
            if by.low < 0 or by.high >= max(type_.bits or 32, 32):
                self.notes.problem(value, SHIFTS_TOO_FAR, TERMINATES)

    def _is_bounded(self, value: e.Expression, facts: Facts) -> bool:
        """Whether a number is below one that the source has, by how it is computed."""
        if any(isinstance(f, IsBelow) and f.value == value for f in facts):
            return True
        match value:
            case e.Binary(Operator.FLOOR_MODULO, _, right):
                return self.is_written(right)
            case e.Binary(Operator.BIT_AND, left, right):
                return self.is_written(left) or self.is_written(right)
            case _:
                return self.is_written(value)

    def _formats(self, value: e.Format, pieces: tuple[e.FormatPiece, ...], facts: Facts) -> None:
        """A width or precision that is computed may be negative."""
        styles = (piece.style for piece in pieces)
        inner = (s for style in styles if isinstance(style, e.Format) for s in style.pieces)
        for piece in inner:
            if not self.is_positive(piece.value, facts):
                self.notes.fails(value, "has a style that is none")

    def is_text(self, value: e.Expression) -> bool:
        """Whether a value is a text."""
        return self.origins.of(value, self.function) == {LibraryOrigin("str", True)}

    def texts(self, value: e.Expression) -> list[str]:
        """The texts that a value may be; none if that is not known."""
        return self.notes.texts_of(value)

    def is_nonzero(self, value: e.Expression, facts: Facts) -> bool:
        """Whether a number is known not to be zero."""
        if Holds(value) in facts:
            return True
        match value:
            case e.Literal(int() | float() as number):
                return number != 0
            case e.Convert(_, operand, type_) if not isinstance(type_, t.Truth):
                return self.is_nonzero(operand, facts) and self._is_kept(operand, type_)
            case e.Unary(Operator.NEGATE | Operator.PLUS, operand):
                return self.is_nonzero(operand, facts)
            case e.Conditional(test, then, otherwise):
                first = self.is_nonzero(then, tested(facts, test, True))
                return first and self.is_nonzero(otherwise, tested(facts, test, False))
            case e.Binary(Operator.MULTIPLY, left, right, type_):
                is_exact = not isinstance(type_, t.Integer) or type_.bits is None
                return is_exact and all(self.is_nonzero(p, facts) for p in (left, right))
            case e.Binary(Operator.ADD, left, e.Literal(int() | float() as more), type_):
                wraps = isinstance(type_, t.Integer) and type_.bits and not type_.signed
                return more > 0 and not wraps and self.is_positive(left, facts)
            case _:
                sizes = (f for f in facts if isinstance(f, IsSize) and f.value == value)
                if any(self.size(f.container, facts) for f in sizes):
                    return True
                return self._is_constant(value)

    def there(self, target: e.Expression, value: e.Expression, facts: Facts) -> Facts:
        """That a variable has a value which is not nothing, if what is stored in it is not."""
        if isinstance(getattr(target, "type", None), t.Reference | t.Optional):
            is_null = self.undefined.pointers.may_be(value, facts)
            return frozenset(() if is_null else (IsThere(target), Holds(target)))
        return frozenset(() if self.none.may_be(value, facts) else (IsThere(target),))

    def _is_kept(self, operand: e.Expression, type_: t.Type) -> bool:
        """Whether a number that is not zero is none either as one of a type."""
        of = getattr(operand, "type", t.UNKNOWN)
        if isinstance(operand, e.Literal | e.Convert | e.Temporary) or isinstance(type_, t.Float):
            return True
        wide = isinstance(type_, t.Integer) and (type_.bits or 64) >= 32
        return wide and isinstance(of, t.Integer)

    def _is_constant(self, value: e.Expression) -> bool:
        """Whether all that is ever stored under a name are numbers other than zero."""
        if not isinstance(value, e.Global | e.Attribute | e.Local | e.Captured):
            return False
        values = [v for _, v in held_by(self.origins, value, self.function)]
        return bool(values) and all(
            isinstance(v, e.Literal) and isinstance(v.value, int | float) and v.value != 0
            for v in values
        )

    def is_sequence(self, value: e.Expression) -> bool:
        """Whether a value is a container that has its elements at numbers."""
        return self._is_of(self.origins.of(value, self.function), *_SEQUENCES)

    def sized_by_caller(self, container: e.Expression, size: int) -> ParameterNeed | None:
        """That it is up to those who call the function whether a container has so many elements."""
        is_known = self.notes.table.language is Language.PYTHON and size > 0
        if not (is_known and isinstance(container, e.Local) and self.notes.is_parameter(container)):
            return None
        key = key_of(container, self.function)
        is_changed = key is None or len(self.origins.graph.stores.of(key)) > 1
        return None if is_changed else ParameterNeed(self.function, container.name, size)

    # --- elements --------------------------------------------------------------------------------

    def size(self, container: e.Expression, facts: Facts) -> int:
        """How many elements a container has at least."""
        return self.bounds.size(container, facts)

    def _reads_at(self, value: e.Index, facts: Facts) -> None:
        if isinstance(value.index, e.Slice):
            return
        if not value.checked:
            if self.notes.table.language is Language.CPP:
                self.undefined.element(value, facts)
            return
        holders = names_of(facts, value.object)
        indices = names_of(facts, value.index) | {_as_key(value)}
        if any(HasKey(holder, index) in facts for holder in holders for index in indices):
            return
        kinds = self.origins.of(value.object, self.function)
        if all(self._is_foreign(kind) or self._answers(kind) for kind in kinds):
            return
        if isinstance(value.index, e.Literal) and self.foreign.has(value.object, self.function):
            return
        is_mapping = self._is_of(kinds, "dict") or _is_typed_mapping(value.object)
        if self._is_of(kinds, "dict", "defaultdict"):
            literal = isinstance(value.index, e.Literal)
            if self._is_of(kinds, "defaultdict"):
                return
            if literal and self.notes.counts.has_key(value.object, value.index, self.function):  # type: ignore[arg-type]
                return
        if not is_mapping and self.bounds.is_within(value, facts):
            return
        at = value.index.value if isinstance(value.index, e.Literal) else None
        given = self.sized_by_caller(value.object, at + 1) if isinstance(at, int) else None
        given = None if is_mapping or AnyOrigin() not in kinds else given
        self.notes.fails(value, "lacks the key" if is_mapping else "lacks the element", given)
        if AnyOrigin() in kinds and not is_mapping and value.from_end:
            self.notes.fails(value, "lacks the key", given)

    def _is_foreign(self, kind: Origin) -> bool:
        """Whether a value is an object of a library that no table has to know."""
        if not isinstance(kind, LibraryOrigin) or kind.name in PLAIN_CLASSES:
            return False
        return kind.of_object and not self.notes.table.is_standard(kind.name)

    def _answers(self, kind: Origin) -> bool:
        """Whether a value is an object of the program whose class says what an index gives."""
        return isinstance(kind, ClassOrigin) and any(
            self.origins.has_method(kind.name, name) for name in _INDEXING
        )

    def is_positive(self, value: e.Expression, facts: Facts) -> bool:
        """Whether a number cannot be negative, by how it is computed or what was tested."""
        return self._signs.is_positive(value, facts)

    def is_written(self, value: e.Expression) -> bool:
        """Whether a number is one that the source has."""
        match value:
            case e.Literal(int() | float()):
                return True
            case e.Unary(Operator.NEGATE | Operator.PLUS, operand):
                return self.is_written(operand)
            case _:
                return self._is_constant(value)

    def stored_at(self, target: e.Index, facts: Facts) -> None:
        """Notes what storing an element may do: a mapping takes any key."""
        self.check(target.object, facts)
        self.types.stores(target, facts)
        match target.index:
            case e.Slice(_, _, step):
                if not isinstance(step, e.Literal | None) or (step and step.value not in (None, 1)):
                    self.notes.fails(target, "has another number of elements")
            case index:
                self.check(index, facts)
        kinds = self.origins.of(target.object, self.function)
        if not self._is_of(kinds, "dict", "defaultdict"):
            self._reads_at(target, facts)

    def _is_of(self, kinds: frozenset[Origin], *names: str) -> bool:
        return bool(kinds) and kinds <= {LibraryOrigin(name, True) for name in names}


def _is_whole(value: e.Expression) -> bool:
    """Whether a number that the source has is a whole one, of any type."""
    held = value.value if isinstance(value, e.Literal) else None
    return isinstance(held, int | float) and held % 1 == 0  # not of 1e999, which is no number


def _as_key(value: e.Index) -> e.Expression:
    """The key of a mapping before it becomes one of the keys' type, as it does in each call."""
    type_, index = getattr(value.object, "type", None), value.index
    if isinstance(type_, t.Container) and type_.kind is t.ContainerKind.MAPPING:
        key = type_.elements[0] if type_.elements else None
        while isinstance(key, t.Integer) and isinstance(index, e.Convert):
            if index.type not in (key, t.UNBOUNDED):
                break
            index = index.operand
    return index


def _is_typed_mapping(value: e.Expression) -> bool:
    type_ = getattr(value, "type", None)
    return isinstance(type_, t.Container) and type_.kind is t.ContainerKind.MAPPING


def _is_streamed(value: e.Expression) -> bool:
    """Whether a text is in a chain of `<<`, as in what a macro puts behind a stream."""
    match value:
        case e.Binary(Operator.SHIFT_LEFT, left, right):
            type_ = getattr(right, "type", t.UNKNOWN)
            return isinstance(type_, t.Text | t.Reference) or _is_streamed(left)
        case _:
            return False
