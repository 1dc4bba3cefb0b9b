"""Calls of Python's own libraries that only give a value, with what each takes without an error.

The form trusts values of which it knows no type. What is told to people must not raise, so each
argument is known to be of a type that is taken. All is in the oldest Python that ROS is used with.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from rebsync.reverse.analysis.python.value_types import (
    A_NUMBER,
    A_TEXT,
    ContainerType,
    OwnType,
    ValueType,
    ValueTypes,
    elements_of,
    own_type,
    values_of,
)
from rebsync.reverse.libraries import python as libraries
from rebsync.reverse.python.generated.slicing.log_words import COMPUTING

_PLAIN = frozenset({OwnType.NUMBER, OwnType.TEXT, OwnType.NONE})


def is_known(types: ValueTypes) -> bool:
    """Whether it is known of which types a value is, and its elements."""
    return bool(types) and all(map(_is_known, types))


def _is_known(type_: ValueType | None) -> bool:
    match type_:
        case None:
            return False
        case ContainerType(own, elements, values):
            within = (elements, values) if own is OwnType.MAPPING else (elements,)
            return all(_is_known(t) for of in within for t in of)
        case _:
            return True


def _anything(types: ValueTypes) -> bool:
    return True


def _number(types: ValueTypes) -> bool:
    return types == A_NUMBER


def _text(types: ValueTypes) -> bool:
    return types == A_TEXT


def _key(types: ValueTypes) -> bool:
    """What a mapping may have as a key: hashable, and of one kind, to be sorted."""
    return types in (A_NUMBER, A_TEXT)


def _texts(types: ValueTypes) -> bool:
    return is_known(types) and elements_of(types) == A_TEXT


def _elements(types: ValueTypes) -> bool:
    """What can be gone through."""
    is_gone_through = all(isinstance(t, ContainerType) or t is OwnType.TEXT for t in types)
    return is_known(types) and is_gone_through


def _comparable(types: ValueTypes) -> bool:
    """What has elements that can be sorted, or be keys: of one kind, or tuples of such."""
    return _elements(types) and _is_ordered(elements_of(types))


def _is_ordered(types: ValueTypes) -> bool:
    match [*types]:
        case [ContainerType(OwnType.TUPLE, _, _, tuple() as parts)]:
            return all(map(_is_ordered, parts))
        case _:
            return types in (A_NUMBER, A_TEXT)


def _mapping(types: ValueTypes) -> bool:
    return is_known(types) and all(own_type(type_) is OwnType.MAPPING for type_ in types)


def _numbers(types: ValueTypes) -> bool:
    return _elements(types) and elements_of(types) == A_NUMBER


def _plain(types: ValueTypes) -> bool:
    """What JSON has: numbers, texts, and lists and mappings of such with texts as keys."""
    return is_known(types) and all(
        t in _PLAIN
        or (
            isinstance(t, ContainerType)
            and t.own in (OwnType.LIST, OwnType.TUPLE, OwnType.MAPPING)
            and (t.own is not OwnType.MAPPING or t.elements == A_TEXT)
            and _plain(elements_of(frozenset({t})) or A_TEXT)
            and (t.own is not OwnType.MAPPING or _plain(values_of(frozenset({t})) or A_TEXT))
        )
        for t in types
    )


Takes = Callable[[ValueTypes], bool]
# What takes so many arguments: of each what it must be; the first number is of those needed.
_FUNCTIONS: dict[str, tuple[int, Sequence[Takes]]] = {
    **dict.fromkeys(("str", "repr", "bool", "type", "id"), (1, (_anything,))),
    **dict.fromkeys(("abs", "round", "float", "int", "bin", "hex"), (1, (_number,))),
    "range": (1, (_number, _number)),
    "divmod": (2, (_number, _number)),
    **dict.fromkeys(("list", "tuple", "len", "any", "all", "reversed"), (1, (_elements,))),
    "enumerate": (1, (_elements, _number)),
    "zip": (1, (_elements, _elements, _elements)),
    **dict.fromkeys(("set", "frozenset", "sorted", "max", "min"), (1, (_comparable,))),
    "sum": (1, (_numbers,)),
    "dict": (0, (_mapping,)),
    "collections.Counter": (0, ()),
    "collections.OrderedDict": (0, ()),
    "collections.deque": (0, ()),
    "json.dumps": (1, (_plain,)),
    "logging.getLogger": (0, (_text,)),
    **dict.fromkeys(("os.getpid", "platform.node", "socket.gethostname"), (0, ())),
    **{n: (1, (_number,)) for n in COMPUTING if n in ("math.floor", "math.ceil", "math.fabs")},
}
_NAMED: dict[str, dict[str, Takes]] = {
    "collections.deque": {"maxlen": _number},
    "json.dumps": {"sort_keys": _number, "indent": _number},
    "enumerate": {"start": _number},
}
_METHODS: dict[str, tuple[int, Sequence[Takes]]] = {
    **dict.fromkeys(("append", "appendleft"), (1, (_anything,))),
    **dict.fromkeys(("add", "discard"), (1, (_key,))),
    "extend": (1, (_elements,)),
    "pop": (0, (_number,)),  # that there is an element is asked of the form
    "popleft": (0, ()),
    "get": (1, (_key, _anything)),
    **dict.fromkeys(("clear", "copy", "items", "keys", "values"), (0, ())),
    "most_common": (0, (_number,)),
    **dict.fromkeys(("upper", "lower", "strip", "title", "capitalize", "split"), (0, ())),
    **dict.fromkeys(("lstrip", "rstrip", "swapcase", "casefold", "isdigit"), (0, ())),
    "replace": (2, (_text, _text)),
    **dict.fromkeys(("ljust", "rjust", "center", "zfill"), (1, (_number,))),
    **dict.fromkeys(("startswith", "endswith"), (1, (_text,))),
    "join": (1, (_texts,)),
}


# Of these a number with a point is none that they take.
_OF_WHOLE = frozenset({"range", "bin", "hex", "enumerate", "collections.deque", "json.dumps"})
_METHODS_OF_WHOLE = frozenset({"ljust", "rjust", "center", "zfill", "pop", "most_common"})


def takes(name: str, given: Sequence[tuple[str | None, ValueTypes]], *, whole: bool) -> bool:
    """Whether a function takes some arguments, by place or name, and only gives a value.

    `whole` says whether all numbers among them are whole.
    """
    if name in libraries.clocks():
        return not given
    plain = name.removeprefix("builtins.")
    if plain in _OF_WHOLE and not whole:
        return False
    if plain in ("max", "min") and len(given) > 1:
        return all(each == given[0] == (None, A_NUMBER) for each in given)
    return plain in _FUNCTIONS and _fits(_FUNCTIONS[plain], _NAMED.get(plain, {}), given)


def method_takes(name: str, given: Sequence[tuple[str | None, ValueTypes]], *, whole: bool) -> bool:
    """Whether a method of a container or text takes some arguments."""
    if name in _METHODS_OF_WHOLE and not whole:
        return False
    if name == "format":  # whether the text names these is asked of the form
        return all(_plain(types) for _, types in given)
    return name in _METHODS and _fits(_METHODS[name], {}, given)


def _fits(
    wanted: tuple[int, Sequence[Takes]],
    named: dict[str, Takes],
    given: Sequence[tuple[str | None, ValueTypes]],
) -> bool:
    least, taken = wanted
    places = [types for name, types in given if name is None]
    by_name = [(name, types) for name, types in given if name is not None]
    return (
        least <= len(places) <= len(taken)
        and all(take(types) for take, types in zip(taken, places, strict=False))
        and all(name in named and named[name](types) for name, types in by_name)
    )
