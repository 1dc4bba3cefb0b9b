"""The form itself: every kind of node has a place, is gone through, and is shown as text."""

from __future__ import annotations

import dataclasses

import pytest

from rebsync.reverse.ir import calls as c
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.operators import Conversion, Operator
from rebsync.reverse.ir.program import Function, Parameter, Program
from rebsync.reverse.ir.types import DOUBLE, TRUTH, UNBOUNDED, Integer
from rebsync.reverse.ir.walk import STATEMENTS, statements, walk
from rebsync.source import Source, Span
from tests.reverse.ir.dump import dump_body, dump_function

_SELF = e.Local("self")
_SPEED = e.Attribute(_SELF, "speed")
_ONE = e.Literal(1, UNBOUNDED)
_BODY: s.Body = (
    s.Call(e.Temporary(1), c.MethodCallee(_SELF, "read"), (c.CallArgument(_ONE, "at"),)),
    s.If(
        e.Binary(Operator.LESS, e.Temporary(1), _ONE, TRUTH),
        (s.CompoundAssign(_SPEED, Operator.ADD, e.Temporary(1)),),
        (s.Assign(_SPEED, e.Convert(Conversion.WRAP, _ONE, Integer(8), False)), s.Return()),
    ),
    s.Try((s.Raise(_ONE),), final=(s.Destroy(e.Local("guard")),)),
)
_FUNCTION = Function("m.C.f", (Parameter("self"), Parameter("x", DOUBLE)), _BODY, owner="m.C")


def test_text() -> None:
    assert dump_function(_FUNCTION) == (
        "m.C.f(self, x: float64) of m.C\n"
        "  $1 = call method self?.read(at=1)\n"
        "  if? $1 <? 1\n"
        "    self?.speed +?= $1\n"
        "  else\n"
        "    self?.speed = wrap<i8>(1)\n"
        "    return\n"
        "  try\n"
        "    raise 1\n"
        "  finally\n"
        "    destroy guard\n"
    )


def test_each_statement_is_gone_through_once_and_before_its_parts() -> None:
    kinds = [type(statement) for statement in statements(_BODY)]
    assert kinds == [s.Call, s.If, s.CompoundAssign, s.Assign, s.Return, s.Try, s.Raise, s.Destroy]
    assert list(walk(_FUNCTION)) == list(walk(_BODY))
    assert [n for n in walk(_BODY) if isinstance(n, e.Temporary)] == [e.Temporary(1)] * 3


def test_a_place_takes_no_part_in_equality() -> None:
    place = Source("a", "self.x").within(Span(0, 4))
    assert e.Local("self", place=place) == e.Local("self")
    assert hash(s.Break(place=place)) == hash(s.Break())


@pytest.mark.parametrize("kind", STATEMENTS)
def test_every_statement_has_a_place(kind: type) -> None:
    assert "place" in {f.name for f in dataclasses.fields(kind)}


def test_a_body_is_lowered_when_it_is_first_asked_for() -> None:
    lowered = []

    def lower(name: str) -> Function:
        lowered.append(name)
        return dataclasses.replace(_FUNCTION, name=name)

    program = Program(("f", "g"), (), lower)
    assert "f" in program and "h" not in program and not lowered
    assert program.function("g") is program.function("g")
    assert lowered == ["g"]
    assert dump_body(program.function("g").body).startswith("$1 = call")
