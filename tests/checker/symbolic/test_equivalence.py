"""Bodies that are proved to do the same do; those that plainly do are proved (cases.toml)."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import assume, event, given, settings
from hypothesis import strategies as st

from rebsync import model as m
from rebsync.checker.lowering import lower
from rebsync.checker.program import Program
from rebsync.checker.symbolic.equivalence import proofs
from rebsync.grammars.parser import parse_model
from rebsync.printing import print_model
from rebsync.roundtrip.behaviour.bisimulation import compare_behaviour
from rebsync.roundtrip.diff.normal_form import rewrite
from rebsync.roundtrip.diff.operands import SourcedModel
from rebsync.source import Source
from rebsync.static import analyse
from tests.checker.comparing import System
from tests.checker.draw_outlines import Features
from tests.checker.draw_systems import CLOCKED, REAL, TIMED, systems
from tests.roundtrip.differences.mutations import bodies, count, nth, with_member

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

FEW = settings(max_examples=settings().max_examples // 3)

CASES: list[dict[str, Any]] = tomllib.loads(
    Path(__file__).with_name("cases.toml").read_text(encoding="utf-8")
)["case"]
MODEL = """\
env int LIMIT = 5;
env int SPAN = 5;
env int[2] TABLE = {{7, 7}};
env double RATE = 0.0;
reactiveclass A(5) {{
  knownrebecs {{ A other; A third; }}
  statevars {{ int n; boolean on; byte b; int[3] xs; double x; double[2] rs; }}
  A() {{ self.go(1) after(1); }}
  msgsrv go(int k) {{ {body} }}
  void help(int q) {{ n += q; other.go(n); }}
  int least(int p, int q) {{ if (p < q) return p; return q; }}
}}
main {{ A a(b, c):(); A b(c, a):(); A c(a, b):(); }}
"""


def _system(body: str) -> System:
    return System.of(MODEL.format(body=body))


@pytest.mark.parametrize("case", CASES, ids=lambda c: c["name"])
def test_case(case: dict[str, Any]) -> None:
    left, right = _system(case["left"]), _system(case["right"])
    for first, second in ((left, right), (right, left)):
        assert _are_alike(first.program, second.program) is case["alike"]
    assert _are_alike(left.program, left.program)


def _are_alike(left: Program, right: Program) -> bool:
    return all(proof.is_alike for proof in proofs(left, right, {}))


# --- drawn systems ------------------------------------------------------------------------------


def _another(node: Any) -> object:  # noqa: ANN401
    """A node that is near to another one, and may mean the same."""
    match node:
        case m.IntLiteral(value):
            return m.IntLiteral(value + 1)
        case m.BoolLiteral(value):
            return m.BoolLiteral(not value)
        case m.Binary("<" | ">", left, right):
            return m.Binary("<=" if node.operator == "<" else ">=", left, right)
        case m.Binary("<=" | ">=" | "!=", left, right):
            return m.Binary("!=" if node.operator != "!=" else "<", left, right)
        case m.Binary("==", left, right):
            return m.Binary("<=", left, right)
        case m.Binary("+" | "*", left, right):
            return m.Binary("-" if node.operator == "+" else "+", left, right)
        case m.Binary("&&", left, right):
            return m.Binary("||", left, right)
        case m.Block((_, *rest)):
            return m.Block(tuple(rest))
        case m.If(condition, then, otherwise) if otherwise is not None:
            return m.If(condition, otherwise, then)
        case _:
            return node


def _is_changed(node: object) -> bool:
    return hasattr(node, "__dataclass_fields__") and _another(node) is not node


def _equal_form(node: Any) -> object:  # noqa: ANN401
    """Another way to write the same."""
    match node:
        case m.If(condition, then, None):
            return m.If(m.Unary("!", m.Paren(condition)), m.Block(()), then)
        case m.If(condition, then, otherwise) if otherwise is not None:
            return m.If(m.Unary("!", m.Paren(condition)), m.Block((otherwise,)), m.Block((then,)))
        case m.Binary("==" | "!=" as operator, left, right):
            other = m.Binary("!=" if operator == "==" else "==", left, right)
            return m.Paren(m.Unary("!", m.Paren(other)))
        case m.Binary("<" | ">" as operator, m.Name() as left, m.Name() as right):
            return m.Paren(m.Binary(">" if operator == "<" else "<", right, left))
        case _:
            return node


def _is_otherwise(node: object) -> bool:
    return hasattr(node, "__dataclass_fields__") and _equal_form(node) is not node


def _judged(left: m.Model, right: m.Model) -> str | None:
    """What the two do, by their state spaces, where one is proved to do what the other does."""
    sides = [
        SourcedModel(each, Source("drawn.rebeca", print_model(each))) for each in (left, right)
    ]
    analyses = [analyse(rewrite(each, lambda node: node)) for each in (left, right)]
    assume(not any(each.errors for each in analyses))
    if not _are_alike(*(lower(each)[0] for each in analyses)):
        return None
    return compare_behaviour(sides[0], sides[1], 2_000).verdict


@FEW
@given(st.data(), st.sampled_from((TIMED, CLOCKED, REAL)))
def test_what_is_proved_has_the_same_state_space(data: st.DataObject, features: Features) -> None:
    model = parse_model(Source("drawn.rebeca", data.draw(systems(features)).model)).model
    other = model
    for _ in range(data.draw(st.integers(1, 2))):
        other = _changed(data, other)
    assert _judged(model, other) != "different"


@FEW
@given(st.data(), st.sampled_from((TIMED, CLOCKED, REAL)))
def test_what_is_written_otherwise(data: st.DataObject, features: Features) -> None:
    model = parse_model(Source("drawn.rebeca", data.draw(systems(features)).model)).model
    other = rewrite(model, lambda node: _equal_form(node) if _is_otherwise(node) else node)
    assume(other != model)
    verdict = _judged(model, other)
    event(str(verdict))
    assert verdict != "different"


def _changed(data: st.DataObject, model: m.Model) -> m.Model:
    fitting = [(c, x) for c, x in bodies(model) if count(x.body, _is_changed)]
    assume(fitting)
    owner, member = data.draw(st.sampled_from(fitting))
    number = data.draw(st.integers(0, count(member.body, _is_changed) - 1))
    body = nth(member.body, _is_changed, number, _another)
    return with_member(model, owner, member, replace(member, body=body))
