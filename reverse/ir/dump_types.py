"""Types of the intermediate form as text."""

from __future__ import annotations

from rebsync.reverse.ir import types as t
from rebsync.unions import assert_never


def dump_type(type_: t.Type) -> str:
    """A type on one line: `i32`, `sequence<float64>`, `&robot.Robot`."""
    match type_:
        case t.Unknown():
            return "?"
        case t.UnitType():
            return "nothing"
        case t.Integer(None, _):
            return "int"
        case t.Integer(bits, signed):
            return f"{'i' if signed else 'u'}{bits}"
        case t.Float(bits):
            return f"float{bits}"
        case t.Truth():
            return "truth"
        case t.Text(is_bytes):
            return "bytes" if is_bytes else "text"
        case t.Enumeration(name, underlying):
            return f"enum {name}:{dump_type(underlying)}"
        case t.Array(element, length):
            return f"{dump_type(element)}[{length}]"
        case t.Container(kind, elements, bound):
            inner = ", ".join(map(dump_type, elements))
            limit = "" if bound is None else f"<={bound}"
            return f"{kind.value}{f'<{inner}>' if inner else ''}{limit}"
        case t.Optional(of):
            return f"optional<{dump_type(of)}>"
        case t.Record(name):
            return name
        case t.RosMessage(name):
            return f"message {name}"
        case t.RosHandle(name):
            return f"handle {name}"
        case t.Reference(to, may_be_null, ownership):
            sign = f"{ownership.value} *" if ownership.value else "*" if may_be_null else "&"
            return f"{sign}{dump_type(to)}"
        case t.FunctionType(parameters, result):
            inner = "..." if parameters is None else ", ".join(map(dump_type, parameters))
            return f"({inner}) -> {dump_type(result)}"
        case _:
            assert_never(type_)
