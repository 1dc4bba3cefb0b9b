"""What calls of Python's own library give for arguments: what these refuse, a call raises for.

What no signature says is refused; so is a value of another kind than the signature has there.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, TypeAlias

from rebsync.reverse.analysis.facts import Facts
from rebsync.reverse.analysis.held_values import held_by
from rebsync.reverse.analysis.python.operator_types import (
    ITERABLE,
    SEQUENCES,
    SIZED,
    are_ordered,
    is_hashable,
)
from rebsync.reverse.analysis.python.plain_values import is_copied, is_written
from rebsync.reverse.analysis.python.value_types import (
    ContainerType,
    InstanceType,
    LibraryType,
    OwnType,
    ValueType,
    ValueTypes,
    at_index,
    elements_of,
    own_type,
    union,
)
from rebsync.reverse.analysis.stores import CallResult
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.calls import Callee
from rebsync.reverse.ir.operators import Operator
from rebsync.reverse.libraries.python_signatures import LibrarySignature, signatures
from rebsync.reverse.libraries.routines import Language

if TYPE_CHECKING:
    from rebsync.reverse.analysis.outcomes.outcome_expressions import OutcomeExpressions

_Given: TypeAlias = "dict[int | str, e.Expression]"
_Test: TypeAlias = Callable[[e.Expression, str, Facts], bool]
_REFUSED = "gets other arguments than it takes"
_WRONG = "is of another type"
_BEYOND = "may refuse what it gets"
_LONGEST = 2**63 / 10**9  # s, of what has nanoseconds
_NUMBER, _TEXT = OwnType.NUMBER, OwnType.TEXT
# The types that a kind has; those that are missing here have none of Python's own.
_OWN: Mapping[str, Collection[OwnType]] = {
    **dict.fromkeys(("number", "whole", "length", "natural", "seconds", "share"), (_NUMBER,)),
    **dict.fromkeys(("text", "separator", "letter", "pattern", "replacement"), (_TEXT,)),
    "bytes": (OwnType.BYTES,),
    "message": (OwnType.MESSAGE,),
    "list": (OwnType.LIST,),
    **dict.fromkeys(("tuple", "texts_of_tuple"), (OwnType.TUPLE,)),
    "mapping": (OwnType.MAPPING,),
    "sequence": SEQUENCES | {OwnType.QUEUE},
    "sized": SIZED,
    **dict.fromkeys(("iterable", "hashables", "numbers", "texts", "pairs"), ITERABLE),
}
_OF_ELEMENTS = {"numbers": {_NUMBER}, "texts": {_TEXT}, "texts_of_tuple": {_TEXT}}
_METHODS_OF = frozenset(
    {
        *(OwnType.TEXT, OwnType.BYTES, OwnType.LIST, OwnType.TUPLE, OwnType.SET, OwnType.MAPPING),
        *(OwnType.QUEUE, OwnType.NUMBER),
    }
)
_NODE = "Node"  # of whatever object: its methods make ends of topics
_FOR_EACH = frozenset({"builtins.map", "builtins.filter"})


# What is given with a star, and with two.
_SPREAD = {1: "iterable", 2: "mapping"}


class LibraryArguments:
    """The calls of one function."""

    def __init__(self, expressions: OutcomeExpressions) -> None:
        self._expressions = expressions
        self._notes = expressions.notes
        self._kinds = expressions.types.kinds
        self._objects = expressions.notes.counts.rules.objects
        self._has_hash = expressions.notes.counts.rules.decorators.has_hash
        self._copying: set[str] = set()

    def check(self, node: s.Call, facts: Facts) -> None:
        """Notes that a call of a function or method may be refused what it gives."""
        if self._notes.table.language is not Language.PYTHON:
            return
        self._asks(node, self._named(node.callee, facts), facts)
        for name, whole in self._of_partial(node):
            self.of_value(whole, name, facts)
        self._called_for_each(node, facts)

    def _of_partial(self, node: s.Call) -> Iterator[tuple[str, s.Call]]:
        """The functions of libraries that a partial function calls, with all that they get."""
        if not isinstance(node.callee, s.ValueCallee):
            return
        held = held_by(self._notes.origins, node.callee.value, self._notes.function.name)
        for _, value in held:
            match value:
                case CallResult(s.Call(_, s.LibraryCallee("functools.partial"), (first, *rest))):
                    if isinstance(first.value, e.LibraryReference):
                        yield first.value.name, replace(node, arguments=(*rest, *node.arguments))
                case _:
                    pass

    def of_value(self, node: s.Call, name: str, facts: Facts) -> None:
        """The same of a function that is stored under a name, or in a partial one."""
        if self._notes.table.is_of_language(name) and self._has_end(name):
            self._asks(node, [name], facts)

    def _has_end(self, name: str) -> bool:
        """Whether nothing but arguments is to be asked of a function, or a signature says these."""
        return not self._notes.table.function(name).acts or bool(signatures(name))

    def _asks(self, node: s.Call, names: Iterable[str], facts: Facts) -> None:
        names = [*names]
        spread = [(a.value, _SPREAD[a.stars]) for a in node.arguments if a.stars] if names else []
        if not all(self._is_of(value, kind, facts) for value, kind in spread):
            self._notes.fails(node, _WRONG)
        if any(a.stars for a in node.arguments):
            return
        for name in names:
            given = _given(node)
            fitting = [each for each in signatures(name) if _is_bound(each, given.keys())]
            if not fitting:
                self._notes.fails(node, _REFUSED)
            elif not any(self._fit(each, given, facts, self._is_of) for each in fitting):
                self._notes.fails(node, _WRONG)
            elif not any(self._fit(each, given, facts, self.is_within) for each in fitting):
                self._notes.fails(node, _BEYOND)
            for value in self._asking(fitting, given):
                self._expressions.none.check(value, node, facts)

    def _named(self, callee: Callee, facts: Facts) -> Iterable[str]:
        """The full names of what is called in Python's own library, and does no more than that."""
        match callee:
            case s.LibraryCallee(name, None):
                is_own = self._notes.table.is_of_language(name)
                is_known = self._has_end(name) if is_own else bool(signatures(name))
                return [name] if is_known else []
            case s.MethodCallee(receiver, name, None, None):
                classes = set(map(_class_of, self._kinds.types(receiver, facts)))
                is_own = bool(self._notes.origins.methods_of_any(name))
                classes |= set() if is_own else {_NODE}
                found = sorted(f"{each}.{name}" for each in classes if each)
                return [f for f in found if not f.startswith(_NODE) or signatures(f)]
            case _:
                return []

    def _asking(self, signed: Sequence[LibrarySignature], given: _Given) -> list[e.Expression]:
        """The arguments that must not be None."""
        kinds = {name: {k for each in signed for k in each.kind(name).split("|")} for name in given}
        return [given[n] for n, found in kinds.items() if not found & {"any", "none", "hashable"}]

    def _fit(self, signed: LibrarySignature, given: _Given, facts: Facts, test: _Test) -> bool:
        return all(
            any(test(value, kind, facts) for kind in signed.kind(name).split("|"))
            for name, value in given.items()
        )

    # --- types -----------------------------------------------------------------------------------

    def _is_of(self, value: e.Expression, kind: str, facts: Facts) -> bool:
        """Whether a value is of the types of a kind."""
        types = self._kinds.known(self._kinds.types(value, facts))
        match kind:
            case "any" | "value":
                return True
            case "none":
                return isinstance(value, e.Literal) and value.value is None
            case "function":
                return not (types - {None}) or any(isinstance(t, InstanceType) for t in types)
            case "instance":
                return all(isinstance(t, InstanceType) for t in types)
            case "quality":  # of a service, of which no class here is known
                return all(own_type(t) is None and not isinstance(t, InstanceType) for t in types)
            case "hashable":
                return is_hashable(types, self._has_hash)
            case "plain" | "orderly":
                return is_written(types, is_sorted=kind == "orderly")
            case "shallow" | "deep":
                return is_copied(types, self._is_copied_object, is_deep=kind == "deep")
            case "whole" | "natural" if self._expressions.types.is_float(value):
                return False
        return all(self._is_type(type_, kind) for type_ in types)

    def _is_copied_object(self, name: str) -> bool:
        """Whether objects of a class can be copied: what they hold can, as far as it is known."""
        if not self._objects.is_plain(name):
            return False
        if name in self._copying:
            return True
        self._copying.add(name)
        rules = self._notes.counts.rules
        held = (rules.types.of_member(each, name) for each in rules.fixed.stored_in(name))
        try:
            return all(is_copied(types, self._is_copied_object, is_deep=True) for types in held)
        finally:
            self._copying.discard(name)

    def _is_type(self, type_: ValueType | None, kind: str) -> bool:
        if isinstance(type_, InstanceType):  # whose class answers as it is written
            return not self._objects.is_bare(type_.name)
        if isinstance(type_, ContainerType) and type_.own is None:
            is_taken = _OWN.get(kind) is ITERABLE
        else:
            is_taken = own_type(type_) in _OWN.get(kind, ())
        if not is_taken:
            return False
        inside = self._kinds.known(elements_of(frozenset((type_,))))
        match kind:
            case "hashables":
                return is_hashable(inside, self._has_hash)
            case "pairs":
                return all(map(_is_pair, inside)) and is_hashable(
                    union(map(_key, inside)), self._has_hash
                )
            case _ if kind in _OF_ELEMENTS:
                return {own_type(each) for each in inside} <= _OF_ELEMENTS[kind]
            case _:
                return True

    # --- values ----------------------------------------------------------------------------------

    def is_within(self, value: e.Expression, kind: str, facts: Facts) -> bool:
        """Whether a value is one that a kind has, if it is of its types."""
        if not self._is_of(value, kind, facts):
            return False
        texts = self._expressions.texts(value)
        match kind:
            case "seconds" if isinstance(value, e.Literal):
                return isinstance(value.value, int | float) and abs(value.value) < _LONGEST
            case "length" | "natural" | "share":
                return self._expressions.is_positive(value, facts) or self._is_given(value)
            case "separator":
                return bool(texts) and all(texts)
            case "letter":
                return bool(texts) and all(len(text) == 1 for text in texts)
            case "pattern":
                return bool(texts) and all(map(_is_pattern, texts))
            case "replacement":
                return bool(texts) and not any("\\" in text for text in texts)
            case _:
                return True

    def _is_given(self, value: e.Expression) -> bool:
        """Whether a parameter gets nothing but numbers in the source, which are not negative."""
        if not (isinstance(value, e.Local) and self._notes.is_parameter(value)):
            return False
        arguments = self._notes.counts.rules.arguments
        given = [v for _, v in arguments.arguments(self._notes.function.name, value.name)]
        return bool(given) and all(
            isinstance(v, e.Literal) and isinstance(v.value, int | float) and v.value >= 0
            for v in given
        )

    # --- functions that are handed over ----------------------------------------------------------

    def _called_for_each(self, node: s.Call, facts: Facts) -> None:
        """Notes that a function of the library is called with elements that it does not take."""
        given = _given(node)
        called, through = given.get("key"), [given[0]] if 0 in given else []
        match node.callee:
            case s.LibraryCallee(name) if name in _FOR_EACH:
                called, through = given.get(0), [v for n, v in given.items() if n not in (0, "key")]
            case s.LibraryCallee("functools.reduce") if 1 in given:
                self._reduced(node, given, facts)
                return
            case s.LibraryCallee() if len(given) > 2:
                through = []
            case s.MethodCallee(receiver):
                through = [receiver]
        if isinstance(called, e.LibraryReference) and self._notes.table.is_of_language(called.name):
            inside = [elements_of(self._kinds.types(v, facts)) for v in through]
            if not self._takes(called.name, inside):
                self._notes.fails(node, _WRONG)

    def _reduced(self, node: s.Call, given: _Given, facts: Facts) -> None:
        """Notes that a function does not take what is reduced so far with the next element."""
        called = given[0]
        if isinstance(called, e.LibraryReference):
            inside = elements_of(self._kinds.types(given[1], facts))
            first = self._kinds.types(given[2], facts) if 2 in given else inside
            if not self._takes(called.name, [first | inside, inside]):
                self._notes.fails(node, _WRONG)

    def _takes(self, name: str, types: Sequence[ValueTypes]) -> bool:
        """Whether a function takes values of some types, one for each of its places."""
        known = [self._kinds.known(of) for of in types]
        return any(
            each.required <= len(types)
            and all(self._has_kind(of, each.kind(at)) for at, of in enumerate(known))
            and ("value" not in each.places or are_ordered(union(known), self._has_order))
            for each in signatures(name)
        )

    def _has_order(self, name: str) -> bool:
        return not self._objects.class_lacks(name, Operator.LESS)

    def _has_kind(self, types: ValueTypes, kinds: str) -> bool:
        """Whether values of some types are of one of the kinds that an argument may be of."""
        return any(
            kind in ("any", "value") or all(self._is_type(t, kind) for t in types)
            for kind in kinds.split("|")
        )


def _given(node: s.Call) -> _Given:
    """The arguments of a call by their places and names."""
    given: _Given = {}
    given.update(enumerate(a.value for a in node.arguments if a.name is None))
    given.update({a.name: a.value for a in node.arguments if a.name is not None})
    return given


def _class_of(type_: ValueType | None) -> str:
    """The class of which signatures have the methods, for values of a type; empty if none."""
    if isinstance(type_, LibraryType):
        return type_.name if type_.name.startswith("datetime.") else ""
    own = own_type(type_)
    if own is OwnType.FROZEN:
        return OwnType.SET.value  # it has fewer methods, which take the same
    return own.value if own in _METHODS_OF else ""


def _is_bound(signed: LibrarySignature, given: Collection[int | str]) -> bool:
    places = sum(isinstance(name, int) for name in given)
    return signed.required <= places and all(map(signed.kind, given))


def _is_pair(type_: ValueType | None) -> bool:
    """Whether values of a type are two, as of an item."""
    parts = type_.parts if isinstance(type_, ContainerType) else None
    return parts is not None and len(parts) == 2


def _key(type_: ValueType | None) -> ValueTypes:
    """The types of the first part of a pair."""
    return at_index(frozenset((type_,)), 0)


def _is_pattern(text: str) -> bool:
    try:
        return bool(re.compile(text))
    except re.error:
        return False
