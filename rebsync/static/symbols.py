"""What names refer to, and what a class consists of once its ancestors are known."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from typing import TypeAlias

from rebsync.model import (
    Constructor,
    Declarator,
    Interface,
    MessageServer,
    Method,
    Parameter,
    ReactiveClass,
    Rebec,
    Type,
)
from rebsync.records import dataclass

# Symbols compare by identity: one object stands for one declaration, `type` is None when the
# declared type is itself a reported mistake.


@dataclass(frozen=True, slots=True, eq=False)
class EnvSymbol:
    """A constant of the model, declared by `env`."""

    name: str
    type: Type | None
    declaration: Declarator
    value: int | float | bool | None = None


@dataclass(frozen=True, slots=True, eq=False)
class StateSymbol:
    """A state variable; `owner` is the class that declares it."""

    name: str
    type: Type | None
    owner: str
    declaration: Declarator


@dataclass(frozen=True, slots=True, eq=False)
class KnownRebecSymbol:
    """A known rebec; `owner` is the class that declares it."""

    name: str
    type: Type | None
    owner: str
    declaration: Declarator


@dataclass(frozen=True, slots=True, eq=False)
class LocalSymbol:
    """A local variable of a body."""

    name: str
    type: Type | None
    declaration: Declarator


@dataclass(frozen=True, slots=True, eq=False)
class ParameterSymbol:
    """A parameter of a constructor, message server or method."""

    name: str
    type: Type | None
    declaration: Parameter


@dataclass(frozen=True, slots=True, eq=False)
class BuiltinSymbol:
    """`self`, `super`, `sender`, `now`, `currentMessageArrival` and its kin."""

    name: str
    type: Type | None


@dataclass(frozen=True, slots=True, eq=False)
class RebecSymbol:
    """An instance in `main`."""

    name: str
    type: Type | None
    declaration: Rebec


@dataclass(frozen=True, slots=True, eq=False)
class ServerSymbol:
    """A message server; `owner` is the class or interface that declares this version of it."""

    name: str
    owner: str
    signature: tuple[Type | None, ...]
    declaration: MessageServer


@dataclass(frozen=True, slots=True, eq=False)
class MethodSymbol:
    """A local method with the type that it returns."""

    name: str
    type: Type | None
    owner: str
    signature: tuple[Type | None, ...]
    declaration: Method


@dataclass(frozen=True, slots=True, eq=False)
class BuiltinFunctionSymbol:
    """`delay`, `assertion`, `pow` or `sqrt`."""

    name: str
    type: Type
    signatures: tuple[tuple[Type, ...], ...]


Variable: TypeAlias = (
    EnvSymbol
    | StateSymbol
    | KnownRebecSymbol
    | LocalSymbol
    | ParameterSymbol
    | BuiltinSymbol
    | RebecSymbol
)

Callable: TypeAlias = ServerSymbol | MethodSymbol

Symbol: TypeAlias = Variable | Callable | BuiltinFunctionSymbol


@dataclass(frozen=True, slots=True, eq=False)
class ConstructorInfo:
    """A constructor with the types of its parameters."""

    signature: tuple[Type | None, ...]
    declaration: Constructor


@dataclass(frozen=True, slots=True, eq=False)
class ClassInfo:
    """A class or interface with everything that it inherits.

    `ancestors` go from the nearest to the farthest; `state` and `known` start with those of the
    farthest ancestor, so `known` is in the order in which `main` binds them. `servers` and
    `methods` hold, for each signature, the version that this class would run.
    """

    name: str
    declaration: ReactiveClass | Interface
    ancestors: tuple[str, ...] = ()
    state: tuple[StateSymbol, ...] = ()
    known: tuple[KnownRebecSymbol, ...] = ()
    servers: tuple[ServerSymbol, ...] = ()
    methods: tuple[MethodSymbol, ...] = ()
    constructors: tuple[ConstructorInfo, ...] = ()
    variables: Mapping[str, StateSymbol | KnownRebecSymbol] = field(default_factory=dict)
    callables: Mapping[str, tuple[Callable, ...]] = field(default_factory=dict)
    partial: bool = False

    @property
    def is_interface(self) -> bool:
        return isinstance(self.declaration, Interface)

    @property
    def is_abstract(self) -> bool:
        return self.is_interface or getattr(self.declaration, "abstract", False)

    @property
    def lineage(self) -> tuple[str, ...]:
        """The class itself and its ancestors, nearest first."""
        return (self.name, *self.ancestors)

    def annotated(self, name: str) -> bool:
        """Whether the class itself carries `@name`."""
        return any(a.name == name for a in self.declaration.annotations)


Classes: TypeAlias = Mapping[str, ClassInfo]
