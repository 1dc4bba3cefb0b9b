"""Which rebecs may be exchanged: by their bindings, and by what is asked of them."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rebsync.checker.lowering import lower
from rebsync.checker.problem import Options, Problem
from rebsync.checker.symmetry import LARGEST, symmetry_of
from rebsync.checker.verify import verify
from rebsync.diagnostics import RebsyncError
from tests.checker.comparing import System

MODEL = """\
reactiveclass Cart(4) {
  knownrebecs { Cart next; Desk desk; }
  statevars { int n; boolean in; float x; int[2] a; Cart seen; }
  Cart(int start) { n = start; self.go(); }
  msgsrv go() { in = !in; desk.ask() after(1); }
}
reactiveclass Desk(9) {
  msgsrv ask() { Cart cart = (Cart) sender; %DELAY% cart.go() after(1); }
}
main {
%MAIN%
  Desk desk():();
}
"""
OWN = "\n".join(f"  Cart {c}({c}, desk):({n});" for n, c in enumerate("abc"))
RING = "  Cart a(b, desk):(0); Cart b(c, desk):(0); Cart c(a, desk):(0);"
LINE = "  Cart a(b, desk):(0); Cart b(c, desk):(0); Cart c(c, desk):(0);"

ALL, SWAP, NONE = 6, 2, 1


def _problem(main: str, assertion: str = "", delay: str = "", kind: str = "Assertion") -> Problem:
    properties = f"property {{ {kind} {{ p: {assertion}; }} }}" if assertion else ""
    model = MODEL.replace("%MAIN%", main).replace("%DELAY%", delay)
    system = System.of(model, properties)
    return Problem(system.source, system.analysis, system.properties)


def _order(problem: Problem) -> int:
    program, _ = lower(problem.analysis, problem.properties)
    try:
        return symmetry_of(program, problem, Options(symmetry=True)).order
    except RebsyncError:
        return 1


@pytest.mark.parametrize(("main", "order"), [(OWN, 6), (RING, 3), (LINE, 1)])
def test_bindings_decide_who_may_be_exchanged(main: str, order: int) -> None:
    assert _order(_problem(main)) == order


def test_priorities_count_and_arguments_do_not() -> None:
    assert _order(_problem(OWN.replace("Cart b", "@priority(1) Cart b"))) == SWAP
    assert _order(_problem(OWN.replace("(2)", "(9)"))) == ALL


def test_of_many_equals_some_stay_where_they_are() -> None:
    many = "\n".join(f"  Cart c{n}(c{n}, desk):(0);" for n in range(12))
    assert _order(_problem(many)) == LARGEST


@pytest.mark.parametrize(
    ("assertion", "order"),
    [
        ("!a.in || !b.in || !c.in", ALL),
        ("!(a.in && b.in) && !(c.in && b.in) && !(a.in && c.in)", ALL),
        ("!(a.in && b.in) && !(b.in && c.in)", SWAP),  # b is in the middle
        ("a.n + c.n + b.n < 3", ALL),
        ("a.n - b.n - c.n < 3", NONE),  # could be SWAP: differences are not sorted
        ("a.x + b.x + c.x < 3.0", SWAP),  # sums of real numbers are not associative
        ("(a.in ? 1 : 0) + (b.in ? 1 : 0) + (c.in ? 1 : 0) < 2", ALL),
        ("a.a[0] + b.a[0] == b.a[1] + a.a[1]", SWAP),
        ("a.a[b.a[0]] == 0 && b.a[a.a[0]] == 0", NONE),  # an index may be wrong: order counts
        ("a.n == 0", SWAP),
        ("a.seen == b", NONE),
        ("a.seen != a && b.seen != b && c.seen != c", ALL),
    ],
)
def test_properties_restrict_the_symmetries(assertion: str, order: int) -> None:
    assert _order(_problem(OWN, assertion)) == order


def test_of_a_temporal_formula_each_part_counts() -> None:
    one = "G(!a.in) && G(!b.in) && G(!c.in)"
    assert _order(_problem(OWN, one, kind="LTL")) == NONE
    assert _order(_problem(OWN, "G(!a.in && !b.in && !c.in)", kind="LTL")) == ALL


def test_a_rebec_that_is_remembered_over_a_delay_is_renamed() -> None:
    for delay in ("delay(1);", "int k = 1; delay(k); cart = null;"):
        problem = _problem(
            OWN.replace("1)", "0)").replace("2)", "0)"), "a.in || b.in || c.in || true", delay
        )
        results = [verify(problem, Options("tts", symmetry=s)) for s in (False, True)]
        assert results[0].verdict == results[1].verdict
        assert results[1].states < results[0].states / 2


@pytest.mark.parametrize(
    ("problem", "options", "said"),
    [
        (_problem(LINE), Options(), "no two rebecs have one class"),
        (_problem(OWN, "a.n == 0 && b.n < 1"), Options(), "told apart by p"),
        (_problem(OWN), Options(reduce=True), "--reduce"),
        (_problem(OWN, "G(F(!a.in))", kind="LTL"), Options(fairness="weak"), "weak fairness"),
    ],
)
def test_what_does_not_go_with_symmetries_is_refused(
    problem: Problem, options: Options, said: str
) -> None:
    with pytest.raises(RebsyncError) as refused:
        verify(problem, replace(options, symmetry=True))
    diagnostic = refused.value.findings[0].diagnostics[0]
    assert diagnostic.code == "RS932"
    assert said in diagnostic.message
