"""Dataclasses that are quick to define: what `dataclass` of the standard library makes, in less.

The standard one compiles up to seven functions for each class, which was a third of the start of
every command. Here only `__init__` is compiled; the other methods are shared by all classes, and
read the fields when they are called. Type checkers see the standard one.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from dataclasses import MISSING, Field, FrozenInstanceError
from operator import attrgetter
from types import MemberDescriptorType
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

_set = object.__setattr__


class _Values(Protocol):
    def __call__(self, record: object, /) -> object: ...


def _dataclass(
    cls: type | None = None, /, *, frozen: bool = False, slots: bool = False, eq: bool = True
) -> Any:  # noqa: ANN401
    """As `dataclasses.dataclass`. Frozen classes do not mix with those of the standard library."""
    if cls is None:
        return lambda given: _dataclass(given, frozen=frozen, slots=slots, eq=eq)
    cls.__doc__ = cls.__doc__ or cls.__name__  # or else a signature is made for it
    own = set(vars(cls))
    if vars(cls).get("__hash__") is None:
        own.discard("__hash__")  # Python's own, beside an `__eq__`
    made: type = dataclasses.dataclass(init=False, repr=False, eq=False, slots=slots)(cls)
    fields = dataclasses.fields(made)
    methods: dict[str, Any] = {"__init__": _init(made, fields, frozen), "__repr__": _repr}
    if eq:
        values = _values_of(tuple(f.name for f in fields if f.compare))
        methods["__eq__"] = _eq(values)
        methods["__hash__"] = _hash(values) if frozen else None
    if frozen:
        methods |= _FROZEN
    for name, method in methods.items():
        if name not in own:
            setattr(made, name, method)
    return made


def _init(cls: type, fields: tuple[Field[object], ...], frozen: bool) -> Callable[..., None]:
    """The function `__init__`, compiled: a call for each object must be quick."""
    names: dict[str, object] = {"_records_set": _set, "_records_missing": MISSING}
    by_place, by_name = ["self"], list[str]()
    body = []
    for field in fields:
        parameter, value = _taken(field, names)
        if field.init:
            (by_name if field.kw_only is True else by_place).append(parameter)
        if value:
            body.append(
                _stored(cls, field.name, value, names) if frozen else f"self.{field.name} = {value}"
            )
    if hasattr(cls, "__post_init__"):
        body.append("self.__post_init__()")
    parameters = ", ".join([*by_place, *["*"] * bool(by_name), *by_name])
    space: dict[str, Callable[..., None]] = {}
    exec(f"def __init__({parameters}):\n " + "\n ".join(body or ["pass"]), names, space)
    made = space["__init__"]
    made.__qualname__ = f"{cls.__qualname__}.__init__"
    return made


def _stored(cls: type, name: str, value: str, names: dict[str, object]) -> str:
    """The statement that stores a value in a frozen object; slots have a quicker way."""
    slot = getattr(cls, name, None)
    if not isinstance(slot, MemberDescriptorType):
        return f"_records_set(self, {name!r}, {value})"
    names[f"_records_slot_{name}"] = slot.__set__
    return f"_records_slot_{name}(self, {value})"


def _taken(field: Field[object], names: dict[str, object]) -> tuple[str, str]:
    """The parameter of a field, and what is stored; empty when nothing is. Adds its default."""
    name, default = field.name, f"_records_{field.name}"
    if field.default is not MISSING:
        names[default] = field.default
        return f"{name}={default}", name if field.init else default
    if field.default_factory is not MISSING:
        names[default] = field.default_factory
        made = f"{default}()"
        given = f"{made} if {name} is _records_missing else {name}"
        return f"{name}=_records_missing", given if field.init else made
    return name, name if field.init else ""


# --- methods that are shared ---------------------------------------------------------------------


def _repr(self: DataclassInstance) -> str:
    shown = (f"{f.name}={getattr(self, f.name)!r}" for f in dataclasses.fields(self) if f.repr)
    return f"{type(self).__qualname__}({', '.join(shown)})"


def _values_of(names: tuple[str, ...]) -> _Values:
    if len(names) > 1:
        return attrgetter(*names)
    return lambda record: tuple(getattr(record, name) for name in names)


def _eq(values: _Values) -> Callable[[object, object], bool]:
    def __eq__(self: object, other: object) -> bool:
        if other.__class__ is not self.__class__:
            return NotImplemented
        return values(self) == values(other)

    return __eq__


def _hash(values: _Values) -> Callable[[object], int]:
    def __hash__(self: object) -> int:
        return hash(values(self))

    return __hash__


def _refuse_to_set(self: object, name: str, value: object) -> None:
    raise FrozenInstanceError(f"cannot assign to field {name!r}")


def _refuse_to_delete(self: object, name: str) -> None:
    raise FrozenInstanceError(f"cannot delete field {name!r}")


def _restore(self: object, state: dict[str, object] | tuple[dict[str, object] | None, ...]) -> None:
    """What copying and unpickling do; `state` is as `object.__reduce_ex__` gives it."""
    for part in state if isinstance(state, tuple) else (state,):
        for name, value in (part or {}).items():
            _set(self, name, value)


_FROZEN = {
    "__setattr__": _refuse_to_set,
    "__delattr__": _refuse_to_delete,
    "__setstate__": _restore,
}

if TYPE_CHECKING:
    from dataclasses import dataclass as dataclass
else:
    dataclass = _dataclass
