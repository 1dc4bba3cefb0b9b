"""Texts that code puts together piece by piece: in streams, and by formats."""

from __future__ import annotations

import re

from tree_sitter import Node

from rebsync.reverse.graph import FromParameter, Unresolved
from rebsync.reverse.syntax.cpp_tree import named, part, text_of
from rebsync.reverse.values.cpp_evaluator import CppEvaluator
from rebsync.reverse.values.cpp_flow_definitions import Definition
from rebsync.reverse.values.cpp_flow_reach import located, reaching
from rebsync.reverse.values.cpp_flow_types import Variable
from rebsync.reverse.values.cpp_values_numbers import added
from rebsync.reverse.values.cpp_values_plain import Frame, Value, pairs

_STREAMS = frozenset({"stringstream", "ostringstream"})
_CONVERSION = re.compile(r"%[-+ #0]*\d*(?:\.\d+)?(?:hh|h|ll|l|z)?([diufFeEgGxXcs%])")
_BY_FORMAT = {"sprintf": 1, "snprintf": 2}


def is_stream(type_: str) -> bool:
    """Whether a type is that of a stream into a text."""
    return type_.rpartition("::")[2] in _STREAMS


def streamed(values: CppEvaluator, variable: Variable, node: Node, frame: Frame) -> Value:
    """The text that a stream holds where `str()` is called on it.

    Only what is put in on all ways is followed: `s << "a" << name;`.
    """
    text: Value = ""
    scope = variable.scope
    if scope is None or variable.kind != "local":
        return values.unknown("a stream that others write to", node, frame, "*")
    places = values.texts.within(frame.cpp, variable.text, scope.start_byte, node.start_byte)
    for place in places[1:]:
        pieces = _pieces(place)
        definition = Definition("value", place, pieces[-1] if pieces else place)
        reach = list(reaching(located([definition]), node, lambda c: values.holds(c, frame)))
        if not pieces or not reach or not reach[0].sure:
            return values.unknown("a stream that is written to in parts", node, frame, "*")
        for piece in pieces:
            text = pairs(added, text, as_text(values, values.value(piece, frame), piece, frame))
    return text


def _pieces(place: Node) -> list[Node]:
    """What is put into a stream where it is named, in the order of writing."""
    pieces: list[Node] = []
    below, above = place, place.parent
    while above is not None and above.type == "binary_expression":
        if text_of(part(above, "operator")) != "<<" or part(above, "left") != below:
            return []
        pieces.append(part(above, "right"))
        below, above = above, above.parent
    return pieces


def as_text(values: CppEvaluator, value: Value, node: Node, frame: Frame) -> Value:
    """A value as a stream writes it."""
    match value:
        case bool():
            return str(int(value))
        case int():
            return str(value)
        case float():
            return f"{value:g}"
        case str() | FromParameter():
            return value
        case Unresolved(why, place, partial):
            return Unresolved(why, place, partial or "*")
        case _:
            return values.unknown("a piece of a text", node, frame, "*")


# --- formats ------------------------------------------------------------------------------------


def formatted(values: CppEvaluator, call: Node, frame: Frame) -> Value:
    """The text that `sprintf(buffer, "robot_%d", number)` writes."""
    given = named(part(call, "arguments"))
    name = text_of(part(call, "function")).rpartition("::")[2]
    index = _BY_FORMAT.get(name, 1)
    form = values.value(given[index], frame) if index < len(given) else None
    if not isinstance(form, str):
        return values.unknown("a format that is not known", call, frame, "*")
    rest = given[index + 1 :]
    text: Value = ""
    at = 0
    for match in _CONVERSION.finditer(form):
        text = pairs(added, text, form[at : match.start()])
        at = match.end()
        if match[1] == "%":
            text = pairs(added, text, "%")
        else:
            piece = _converted(values, match, rest.pop(0) if rest else call, frame)
            text = pairs(added, text, piece)
    return pairs(added, text, form[at:])


def _converted(values: CppEvaluator, match: re.Match[str], node: Node, frame: Frame) -> Value:
    value = values.value(node, frame)
    if isinstance(value, (bool, int, float, str)):
        try:
            return re.sub(r"hh|h|ll|l|z", "", match[0]) % value
        except (TypeError, ValueError):
            return values.unknown("a format of another type", node, frame, "*")
    if match[1] == "s":
        return as_text(values, value, node, frame)
    return values.unknown("a number that is written into a text", node, frame, "*")
