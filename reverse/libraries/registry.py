"""Which libraries there are: the modules of `tables`, and those that a caller has beside them."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import cache
from typing import ParamSpec, TypeVar, cast

from rebsync.reverse.libraries import tables
from rebsync.reverse.libraries.routines import Language, Library

P = ParamSpec("P")
T = TypeVar("T")

_beside: list[Library] = []
_caches: list[Callable[[], None]] = []


def derived(function: Callable[P, T]) -> Callable[P, T]:
    """A function that makes something of the tables, once for each set of libraries."""
    cached = cache(function)
    _caches.append(cached.cache_clear)
    return cast("Callable[P, T]", cached)


@derived
def _all() -> tuple[Library, ...]:
    names = sorted(module.name for module in pkgutil.iter_modules(tables.__path__))
    modules = [importlib.import_module(f"{tables.__name__}.{name}") for name in names]
    found: list[Library] = [library for module in modules for library in module.LIBRARIES]
    return (*found, *_beside)


def libraries(language: Language) -> tuple[Library, ...]:
    """The libraries that code of a language may call."""
    return tuple(library for library in _all() if library.language is language)


@derived
def brings() -> Mapping[str, frozenset[str]]:
    """The modules of Python that are installed with a library, by its name."""
    return {library.name: library.brings for library in libraries(Language.PYTHON)}


@contextmanager
def beside(*more: Library) -> Iterator[None]:
    """More libraries as long as something runs."""
    _beside.extend(more)
    _forget()
    try:
        yield
    finally:
        for library in more:
            _beside.remove(library)
        _forget()


def _forget() -> None:
    for clear in _caches:
        clear()
