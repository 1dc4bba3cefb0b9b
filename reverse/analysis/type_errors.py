"""What Python asks of values of its own types that these have not: a TypeError, an AttributeError.

A value that may be of several types must have what is asked in each; one of which no type is known
is trusted.
"""

from __future__ import annotations

from collections.abc import Iterable

from rebsync.reverse.analysis.facts import Facts, OwnType
from rebsync.reverse.analysis.format_strings import refuses
from rebsync.reverse.analysis.log_arguments import LogArguments
from rebsync.reverse.analysis.operand_kinds import ATTRIBUTES, Kinds, OperandKinds
from rebsync.reverse.analysis.origins import ClassOrigin
from rebsync.reverse.analysis.problems import ProblemNotes
from rebsync.reverse.analysis.stores import GlobalVariable, Member
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import ImplicitCall, Operator
from rebsync.reverse.ir.walk import Node, walk
from rebsync.reverse.libraries.routines import Language

_WRONG = "is of another type"
_LACKS = "has no such attribute"
_UNDEFINED = "names what nothing defines"
_OF_MODULES = frozenset({"__name__", "__file__", "__doc__", "__package__", "__spec__"})
_HOOKS = ("__getattr__", "__getattribute__")
NUMBER, TEXT = OwnType.NUMBER, OwnType.TEXT
_SEQUENCES = frozenset({TEXT, OwnType.LIST, OwnType.TUPLE})
_INDEXED = _SEQUENCES | {OwnType.QUEUE, OwnType.MAPPING, OwnType.ARRAY}
_SIZED = frozenset(OwnType) - {NUMBER, OwnType.ARRAY}
_UNHASHABLE = frozenset({OwnType.LIST, OwnType.SET, OwnType.MAPPING, OwnType.QUEUE, OwnType.ARRAY})
_ORDERED = (Operator.LESS, Operator.LESS_EQUAL, Operator.GREATER, Operator.GREATER_EQUAL)
_EQUALITY = (Operator.EQUAL, Operator.UNEQUAL)
_SORTING = frozenset({"builtins.sorted", "builtins.max", "builtins.min"})
_OF_SETS = (Operator.BIT_AND, Operator.BIT_OR, Operator.BIT_XOR, Operator.SUBTRACT)
_OF_NUMBERS = frozenset(
    f"builtins.{n}" for n in ("abs", "round", "float", "int", "divmod", "pow", "range", "chr")
)
_OF_NUMBER, _OF_WHOLE = "bcdeEfFgGnoxX%", "bcdoxX"  # how styles end
_OF_TEXTS = frozenset({"builtins.float", "builtins.int"})  # which take texts as well
_OF_ELEMENTS = frozenset(
    f"builtins.{n}"
    for n in (
        *("len", "sum", "any", "all", "sorted", "list", "tuple", "set", "enumerate"),
        *("iter", "zip"),
    )
)


class TypeErrors:
    """The values of one function."""

    def __init__(self, notes: ProblemNotes) -> None:
        self._notes = notes
        self.kinds = OperandKinds(notes)
        self._objects = notes.counts.rules.objects
        self._logs = LogArguments(notes, self.kinds)
        self._is_python = notes.table.language is Language.PYTHON

    def of(self, value: e.Expression, facts: Facts) -> Kinds | None:
        """The types that a value may be of; None in other languages."""
        return self.kinds.of(value, facts) if self._is_python else None

    def check(self, value: e.Expression, facts: Facts) -> None:
        """Notes what evaluating an expression asks of values that have it not."""
        if not self._is_python:
            return
        match value:
            case e.Attribute(of, name) if not isinstance(of, e.ClassReference):
                self._asks(value, of, name, facts)
            case e.Binary(operator, left, right):
                self._computes(value, operator, left, right, facts)
            case e.Unary(Operator.NEGATE | Operator.PLUS | Operator.INVERT as operator, of):
                self._answers(value, of, operator)
                self._needs(value, of, {NUMBER}, facts)
            case e.Index(of, index):
                self._at(value, of, index, facts)
            case e.Format(pieces):
                for piece in pieces:
                    if piece.style is not None:
                        self._styled(value, piece.value, piece.style, facts)
            case e.Global(module, name):
                self._named(value, module, name)
            case _:
                pass

    def call(self, node: s.Call, facts: Facts) -> None:
        """Notes what a call asks of what is called, and of what it gets."""
        if not self._is_python:
            return
        plain = [a.value for a in node.arguments if a.name is None and not a.stars]
        self._sorts(node, plain)
        self._logs.check(node, facts)
        match node.callee:
            case s.ValueCallee(value):
                self._needs(node, value, set(), facts)
            case s.MethodCallee(receiver, name, _, None):
                self._asks(node, receiver, name, facts)
                if name == "add" and self.kinds.of(receiver, facts) == {OwnType.SET}:
                    for value in plain:
                        self._needs(node, value, set(OwnType) - _UNHASHABLE, facts)
                if not self._notes.origins.methods_of_any(name):
                    self._needs(node, e.Attribute(receiver, name), set(), facts)
            case s.LibraryCallee("builtins.range") if any(map(_is_fraction, plain)):
                self._notes.fails(node, _WRONG)
            case s.LibraryCallee(name) if name in _OF_NUMBERS:
                taken = {NUMBER, TEXT} if name in _OF_TEXTS else {NUMBER}
                for value in plain:
                    self._needs(node, value, taken, facts)
            case s.LibraryCallee("builtins.format") if len(plain) > 1:
                self._styled(node, plain[0], plain[1], facts)
            case s.LibraryCallee("builtins.len"):
                for value in plain[:1]:
                    self._needs(node, value, _SIZED, facts)
                    self._answers(node, value, ImplicitCall.LENGTH)
            case s.LibraryCallee("builtins.reversed"):
                for value in plain:
                    self._needs(node, value, _SIZED, facts)
            case s.LibraryCallee(name) if name in _OF_ELEMENTS:
                for value in plain if name == "builtins.zip" else plain[:1]:
                    self.iterates(node, value, facts)
            case _:
                pass

    def _sorts(self, node: s.Call, plain: list[e.Expression]) -> None:
        """A call that compares the elements of a container by themselves."""
        match node.callee:
            case s.LibraryCallee(name) if name in _SORTING and len(plain) == 1:
                container = plain[0]
            case s.MethodCallee(receiver, "sort"):
                container = receiver
            case _:
                return
        function, has_key = self._notes.function.name, any(a.name == "key" for a in node.arguments)
        if not has_key and self._objects.has_lacking_elements(container, function, Operator.LESS):
            self._notes.fails(node, _WRONG)

    def iterates(self, node: s.Statement, value: e.Expression, facts: Facts) -> None:
        """Notes that something is gone through that has no elements."""
        if self._is_python:
            self._needs(node, value, set(OwnType) - {NUMBER}, facts)
            self._answers(node, value, ImplicitCall.ITERATE)

    def _answers(
        self,
        node: s.Statement | e.Expression,
        value: e.Expression,
        call: Operator | ImplicitCall,
    ) -> None:
        """A value's class must answer an operator, if it is one of the program's."""
        if self._objects.lacks(value, self._notes.function.name, call):
            self._notes.fails(node, _WRONG)

    def sets(self, target: e.Lvalue) -> None:
        """Notes that an attribute is stored in an object whose class has none to store in."""
        if not (self._is_python and isinstance(target, e.Attribute)):
            return
        origins = self._notes.origins
        held = origins.of(target.object, self._notes.function.name)
        if target.object == e.Local(self._notes.function.receiver or ""):
            held = frozenset({ClassOrigin(self._notes.function.owner or "")})
        classes = (o.name for o in held if isinstance(o, ClassOrigin) and o.of_object)
        if any(self._notes.counts.rules.fixed.refuses(each, target.name) for each in classes):
            self._notes.fails(target, _LACKS)

    def stores(self, target: e.Index, facts: Facts) -> None:
        """Notes that an element is stored in what takes none."""
        if not self._is_python:
            return
        changing = {OwnType.LIST, OwnType.MAPPING, OwnType.QUEUE, OwnType.ARRAY}
        self._needs(target, target.object, changing, facts)
        if self.kinds.of(target.object, facts) == {OwnType.MAPPING}:
            self._needs(target, target.index, set(OwnType) - _UNHASHABLE, facts)

    def _needs(
        self,
        node: s.Statement | e.Expression,
        value: e.Expression,
        taken: Iterable[OwnType],
        facts: Facts,
    ) -> None:
        if self.kinds.of(value, facts) - {*taken, None}:
            self._notes.fails(node, _WRONG)

    # --- attributes ------------------------------------------------------------------------------

    def _asks(
        self, node: s.Statement | e.Expression, of: e.Expression, name: str, facts: Facts
    ) -> None:
        """An attribute is asked of a value."""
        kinds = self.kinds.of(of, facts)
        if any(kind is not None and name not in ATTRIBUTES[kind] for kind in kinds) or (
            kinds == {None} and self._is_of_none(of, name)
        ):
            self._notes.fails(node, _LACKS)

    def _is_of_none(self, of: e.Expression, name: str) -> bool:
        """Whether no object of the classes that a value is of may have an attribute."""
        origins = self._notes.origins
        own = origins.graph.class_of(of, self._notes.function)
        held = origins.of(of, self._notes.function.name)
        if held and all(isinstance(o, ClassOrigin) and not o.of_object for o in held):
            names = {o.name for o in held if isinstance(o, ClassOrigin)}
            is_stored = bool(origins.graph.stores.of(Member(name))) or name in _OF_CLASSES
            return not is_stored and any(self._objects.lacks_attribute(n, name) for n in names)
        classes = {o.name for o in held if isinstance(o, ClassOrigin) and o.of_object}
        if own is not None:
            classes = {own}
        elif len(classes) != len(held):
            return False
        return bool(classes) and any(self._lacks(each, name) for each in classes)

    def _lacks(self, of: str, name: str) -> bool:
        """Whether a class, and all that it extends, say nothing of an attribute."""
        origins, program = self._notes.origins, self._notes.origins.graph.program
        family = origins.graph.family(of) - {"builtins.object"}
        if not family <= program.classes.keys() or name in _OF_OBJECTS:
            return False
        classes = [program.classes[each] for each in family]
        if any(None in c.bases or not c.complete for c in classes) or origins.sets_by_text:
            return False
        known = {n for c in classes for n, _ in c.methods}
        known |= {p.name for c in classes for p in c.properties}
        known |= {f.name for c in classes for f in c.fields}
        return known.isdisjoint({name, *_HOOKS}) and not origins.graph.stores.of(Member(name))

    def _named(self, value: e.Expression, module: str, name: str) -> None:
        """A name that no scope of a module binds, and no import brings in unseen."""
        graph = self._notes.origins.graph
        if name in _OF_MODULES or graph.stores.of(GlobalVariable(module, name)):
            return
        body = graph.program.modules.get(module)
        if body is None or self._notes.origins.sets_by_text:
            return
        nodes = walk(graph.program.function(body))
        if not any(isinstance(n, s.Unsupported) or _is_star(n) for n in nodes):
            self._notes.fails(value, _UNDEFINED)

    # --- operators -------------------------------------------------------------------------------

    def _computes(
        self,
        value: e.Binary,
        operator: Operator,
        left: e.Expression,
        right: e.Expression,
        facts: Facts,
    ) -> None:
        kinds = self.kinds.of(left, facts), self.kinds.of(right, facts)
        if operator in (Operator.IN, Operator.NOT_IN):
            wrong = bool(kinds[1] & {NUMBER}) or (
                kinds[1] == {TEXT} and bool(kinds[0] - {TEXT, None})
            )
        elif operator in (Operator.EQUAL, Operator.UNEQUAL, Operator.SAME, Operator.NOT_SAME):
            wrong = False
        else:
            wrong = any(not _takes(operator, a, b) for a in kinds[0] for b in kinds[1])
            is_times = operator is Operator.MULTIPLY and _is_fraction(right)
            wrong |= is_times and bool(kinds[0] - {NUMBER, None})
        if operator is Operator.FLOOR_MODULO and isinstance(left, e.Literal):
            wrong |= isinstance(left.value, str) and self._puts(left.value, right, facts)
        if wrong:
            self._notes.fails(value, _WRONG)
        if operator in (Operator.IN, Operator.NOT_IN):
            self._answers(value, right, operator)
        elif operator not in (*_EQUALITY, Operator.SAME, Operator.NOT_SAME):
            self._answers(value, left, operator)
            self._answers(value, right, operator)

    def _puts(self, text: str, value: e.Expression, facts: Facts) -> bool:
        """Whether `%` may not put values into a text: too many, too few, or of another type."""
        kinds = self.kinds.of(value, facts)
        if isinstance(value, e.Build) and kinds == {OwnType.TUPLE}:
            if any(isinstance(each, e.Spread) for each in value.elements):
                return True
            return refuses(text, [self.kinds.of(v, facts) for v in value.elements])  # type: ignore[arg-type]
        return kinds != {OwnType.TUPLE} and refuses(text, [kinds - {OwnType.TUPLE}])

    # --- elements and texts ----------------------------------------------------------------------

    def _at(self, value: e.Index, of: e.Expression, index: e.Expression, facts: Facts) -> None:
        self._needs(value, of, _INDEXED, facts)
        kinds = self.kinds.of(of, facts)
        if isinstance(index, e.Slice):
            self._needs(value, of, set(OwnType) - {OwnType.ARRAY}, facts)
            return
        if kinds and kinds <= _SEQUENCES | {OwnType.QUEUE, OwnType.ARRAY}:
            self._needs(value, index, {NUMBER}, facts)
            if _is_fraction(index):
                self._notes.fails(value, _WRONG)
        elif kinds == {OwnType.MAPPING}:
            self._needs(value, index, set(OwnType) - _UNHASHABLE, facts)

    def _styled(
        self,
        node: s.Statement | e.Expression,
        value: e.Expression,
        style: e.Expression,
        facts: Facts,
    ) -> None:
        """A style that a value of its type has not; other types have styles of their own."""
        if not (isinstance(style, e.Literal) and isinstance(style.value, str) and style.value):
            return
        kinds, letter = self.kinds.of(value, facts), style.value[-1]
        if kinds & {NUMBER, TEXT} and letter.isalpha() and letter not in _OF_NUMBER + "s":
            self._notes.fails(node, _WRONG)
        elif letter == "s":
            self._needs(node, value, {TEXT}, facts)
        elif letter in _OF_NUMBER:
            self._needs(node, value, {NUMBER}, facts)
            if letter in _OF_WHOLE and _is_fraction(value):
                self._notes.fails(node, _WRONG)
        else:
            self._needs(node, value, {NUMBER, TEXT}, facts)


def _is_star(node: Node) -> bool:
    """Whether a node imports all that a module has."""
    return isinstance(node, s.Import) and node.name == "*"


_OF_CLASSES = frozenset(dir(type)) | {"__members__"}
_OF_OBJECTS = frozenset(dir(object)) | {"__dict__", "__module__", "__name__", "__slots__"}


def _is_fraction(value: e.Expression) -> bool:
    """Whether a number is a float by how it is computed, other than of whole numbers only."""
    match value:
        case e.Literal(float()):
            return True
        case e.Binary(operator):
            return operator is Operator.TRUE_DIVIDE
        case _:
            return False


def _takes(operator: Operator, left: OwnType | None, right: OwnType | None) -> bool:
    """Whether an operator takes operands of two types, as far as they are known."""
    if left is None or right is None:
        return True
    match operator:
        case _ if left is right is NUMBER:
            return True
        case Operator.ADD:
            return left is right and left in _SEQUENCES | {OwnType.QUEUE}
        case Operator.MULTIPLY:
            return {left, right} in [{NUMBER, each} for each in _SEQUENCES | {OwnType.QUEUE}]
        case Operator.FLOOR_MODULO:
            return left is TEXT
        case _ if operator in _ORDERED:
            return left is right and left not in (OwnType.MAPPING, OwnType.ARRAY)
        case _ if operator in _OF_SETS:
            is_mapping = left is right is OwnType.MAPPING and operator is Operator.BIT_OR
            return left is right is OwnType.SET or is_mapping
        case _:
            return False
