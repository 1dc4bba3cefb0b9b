"""What names in generated code stand for in the model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field as with_default
from typing import TypeAlias

from tree_sitter import Node

from rebsync import model as m
from rebsync.records import dataclass
from rebsync.reverse.python.generated.named_constants import NamedConstants
from rebsync.reverse.python.generated.posts import Post
from rebsync.reverse.python.generated.roles import PySends
from rebsync.reverse.python.generated.slicing.silent import NOTHING, Silent
from rebsync.reverse.syntax.py_index import PyParameter, Scope


@dataclass(frozen=True, slots=True)
class ModelNames:
    """What the names of a class stand for: attributes, sends and functions, ancestors included.

    `servers` are those of the functions that serve messages; `constants` what names of the module,
    and those of the class behind `self.`, are bound to. `types` are those of variables, `results`
    those of functions, by their names in the model; `properties` functions that are read.
    `parameters` are what functions are given besides the object, by their names in the code.
    `imported` are what names of the module are of, `helpers` functions without an object,
    `fillings` what publishers send, `posts` what is posted, by the ids of the calls. `silent` is
    what only people are told, `beside` methods that give what no variable holds, `inlined`
    methods whose statements stand where they are called.
    """

    variables: Mapping[str, str]
    sends: Mapping[str, PySends]
    functions: Mapping[str, str]
    constants: NamedConstants
    servers: frozenset[str] = frozenset()
    types: Mapping[str, m.Type] = with_default(default_factory=dict)
    results: Mapping[str, m.Type] = with_default(default_factory=dict)
    properties: frozenset[str] = frozenset()
    imported: Mapping[str, str] = with_default(default_factory=dict)
    helpers: Mapping[str, Helper] = with_default(default_factory=dict)
    parameters: Mapping[str, tuple[PyParameter, ...]] = with_default(default_factory=dict)
    fillings: Mapping[str, Filling] = with_default(default_factory=dict)
    posts: Mapping[int, Post] = with_default(default_factory=dict)
    silent: Silent = NOTHING
    beside: Mapping[str, Scope] = with_default(default_factory=dict)
    inlined: Mapping[str, Scope] = with_default(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Helper:
    """A function by its `name` in the model; `own` is what it calls the object that it is given."""

    name: str
    function: Scope
    own: str = ""


@dataclass(frozen=True, slots=True)
class Filling:
    """What a publisher sends: the type of its messages, and what each field is filled with.

    `fields` are those of the parameters of the server, in their order, with what is put around the
    value; `others` all else that is stored, by its field.
    """

    message: str
    sends: PySends
    fields: tuple[tuple[str, str], ...]
    others: tuple[tuple[str, str], ...]


@dataclass(frozen=True, eq=False, slots=True)
class Closure:
    """A function of a body: its parameters with their types, and its block or its only value."""

    parameters: tuple[tuple[str, m.Type | None], ...]
    body: Node


@dataclass(frozen=True, slots=True)
class ChosenCallee:
    """One of two functions, as a condition says."""

    asked: m.Expression
    then: Callee
    otherwise: Callee


Callee: TypeAlias = "str | ChosenCallee"
