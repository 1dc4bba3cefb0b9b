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
    name, arguments = node.callee.name, node.arguments
    if name.endswith("::insert"):  # behind the place; with one argument more it is of iterators
        if len(arguments) != 3:
            return None
        arguments = arguments[1:]
    value = arguments[0].value
    if _FORWARDS.match(name) and not _OF_MANY.match(name):
        return None
    value = _bare(value)
    type_ = getattr(value, "type", t.UNKNOWN)
    is_alone = len(arguments) == 1 and name != UNKNOWN_CLASS and "string" not in name
    is_filled = isinstance(getattr(_bare(arguments[-1].value), "type", None), t.Integer)
    may_be = type_ == t.UNKNOWN and (is_alone or (is_filled and len(arguments) == 2))
    return value if may_be or isinstance(type_, t.Integer | t.Float) else None


def takes_part(node: s.Call) -> bool:
    """Whether a call gets a text, other than a literal, and a position in it but zero.

    One that lies behind its end throws ([string.cons], [string.append]).
    """
    values = [argument.value for argument in node.arguments]
    text = _bare(values[0]) if len(values) > 1 else None
    is_text = isinstance(getattr(text, "type", None), t.Text) and not isinstance(text, e.Literal)
    return is_text and is_position(_bare(values[1]))


def is_position(value: e.Expression) -> bool:
    """Whether a value is a number that need not be zero, or leads to one."""
    value = _bare(value)
    is_number = isinstance(getattr(value, "type", None), t.Integer)
    return is_number and not (isinstance(value, e.Literal) and value.value == 0)


def _bare(value: e.Expression) -> e.Expression:
    while isinstance(value, e.Convert | e.AddressOf):
        value = value.operand if isinstance(value, e.Convert) else value.target
    return value
