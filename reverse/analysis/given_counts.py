"""Numbers of elements that constructors of containers and texts get.

One that is negative is a great one of an unsigned type: no memory holds as many, and it throws
([sequence.reqmts], [string.cons]).
"""

from __future__ import annotations

import re

from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir import types as t
from rebsync.reverse.libraries.outcome_classes import UNKNOWN_CLASS

_FORWARDS = re.compile(r"(?:std::)?(?:new|make_unique|make_shared)(?!\w)")
_OF_MANY = re.compile(r"(?:std::)?\w+<(?:sequence|text|bytes|\*)")


def count_given(node: s.Call) -> e.Expression | None:
    """The argument of a constructor that may be a number of elements; None if none is.

    A function that hands its arguments to a constructor is one of what it makes.
    """
    if not isinstance(node.callee, s.LibraryCallee) or not node.arguments:
        return None
    name, value = node.callee.name, node.arguments[0].value
    if _FORWARDS.match(name) and not _OF_MANY.match(name):
        return None
    while isinstance(value, e.Convert | e.AddressOf):
        value = value.operand if isinstance(value, e.Convert) else value.target
    type_ = getattr(value, "type", t.UNKNOWN)
    is_alone = len(node.arguments) == 1 and name != UNKNOWN_CLASS and "string" not in name
    is_number = isinstance(type_, t.Integer | t.Float) or (is_alone and type_ == t.UNKNOWN)
    return value if is_number else None
