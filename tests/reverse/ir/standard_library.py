"""Functions of the standard library of C++, as far as cases use them, on values of Python."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from tests.reverse.ir.memory import Held

FUNCTIONS: Mapping[str, Callable[..., Any]] = {
    "std::abs": abs,
    "std::min": min,
    "std::max": max,
    "std::to_string": str,
    "std::sqrt": math.sqrt,
    "std::floor": lambda x: float(math.floor(x)),
    "std::vector": lambda count, value: [value] * count,
}
METHODS: Mapping[str, Callable[..., Any]] = {
    "std::vector::push_back": lambda of, value: of.append(value),
    "std::vector::pop_back": lambda of: of.pop() and None,
    "std::vector::size": len,
    "std::vector::empty": lambda of: not of,
    "std::vector::clear": lambda of: of.clear(),
    "std::map::size": len,
    "std::map::count": lambda of, key: int(key in of),
    "std::map::keys": sorted,
    "std::set::elements": sorted,
    "std::set::insert": lambda of, value: of.add(value),
    "std::set::count": lambda of, key: int(key in of),
    "std::set::size": len,
    "std::string::size": len,
    "std::string::length": len,
    "std::string::empty": lambda of: not of,
    "std::string::substr": lambda of, start, count=None: of[start:][:count],
}


def text_method(name: str, held: str, arguments: Sequence[Held]) -> tuple[Held, str]:
    """What a method of a text gives, and the text after it."""
    match name:
        case "push_back":
            return None, held + chr(arguments[0])
        case "clear":
            return None, ""
        case _:
            raise NotImplementedError(name)
