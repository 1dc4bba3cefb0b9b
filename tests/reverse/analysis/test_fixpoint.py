"""What functions do does not depend on which is looked at first, nor on how long a chain is."""

from __future__ import annotations

import pytest

from rebsync.reverse.analysis.fixpoint import Equation, LeastFixpoint, in_cycles
from rebsync.reverse.analysis.outcomes.outcomes import OutcomeAnalysis
from rebsync.reverse.ir.cpp.lowering import program_of
from rebsync.reverse.libraries.outcomes import LibraryOutcomes
from rebsync.reverse.libraries.routines import Language
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import parse
from rebsync.source import Source

_CYCLE = """
#include <stdexcept>
int pong(int n);
int ping(int n) { if (n > 9) throw std::runtime_error("ping"); return n > 0 ? pong(n - 1) : 0; }
int pong(int n) { return ping(n); }
"""
_HANDLED = """
#include <stdexcept>
int outer(int n);
int inner(int n) { if (n > 9) throw std::runtime_error("inner"); return outer(n - 1); }
int outer(int n) { try { return inner(n); } catch (const std::runtime_error &) { return 0; } }
"""
_STORED = """
#include <utility>
#include <vector>
int sum(const std::vector<std::pair<int, int>> & all) { throw 1; }
void use() {
  std::vector<std::pair<int, int>> one, other;
  one = other;
  other = one;
  for (auto each : one) { sum(one); }
}
"""


def _analysis(text: str) -> OutcomeAnalysis:
    code = Code.of([parse(Source("node.cpp", text))])
    return OutcomeAnalysis(program_of(code), LibraryOutcomes(Language.CPP), lambda _: False)


@pytest.mark.parametrize("order", [("ping", "pong"), ("pong", "ping")])
def test_exceptions_leave_all_functions_that_call_each_other(order: tuple[str, ...]) -> None:
    analysis = _analysis(_CYCLE)
    raised = {name: {p.raises for p in analysis.of(name)} - {""} for name in order}
    assert raised == {"ping": {"std::runtime_error"}, "pong": {"std::runtime_error"}}


@pytest.mark.parametrize("order", [("inner", "outer"), ("outer", "inner")])
def test_handled_exceptions_stay_in_a_cycle(order: tuple[str, ...]) -> None:
    analysis = _analysis(_HANDLED)
    raised = {name: {p.raises for p in analysis.of(name)} - {""} for name in order}
    assert raised == {"inner": {"std::runtime_error"}, "outer": set()}
    assert all(any("may call itself" in p.why for p in analysis.of(name)) for name in order)


def test_chains_of_calls_are_followed_to_their_end() -> None:
    length = 400
    calls = (f"void f{n}(int x) {{ f{n + 1}(x); }}" for n in reversed(range(length)))
    last = f"void f{length}(int x) {{ throw 1; }}\n"
    analysis = _analysis(last + "\n".join(calls))
    assert {p.raises for p in analysis.of("f0")} == {"an exception"}


def test_containers_that_are_stored_in_each_other_end() -> None:
    assert {p.raises for p in _analysis(_STORED).of("use")} == {"an exception"}


class _Given:
    """Equations by the names of their sets."""

    def __init__(self, equations: dict[str, Equation[int]]) -> None:
        self._equations = equations

    def equation(self, name: str) -> Equation[int]:
        return self._equations[name]


def test_the_least_sets_are_found() -> None:
    def same(x: int) -> frozenset[int]:
        return frozenset({x})

    def next_of(x: int) -> frozenset[int]:
        return frozenset({x + 1}) if x < 3 else frozenset()

    given = _Given(
        {
            "a": Equation(frozenset({1}), (("b", same),)),
            "b": Equation(frozenset[int](), (("a", next_of), ("c", same))),
            "c": Equation(frozenset({7}), (("c", same),)),
        }
    )
    found = LeastFixpoint(given.equation)
    assert found.of("b") == {2, 3, 7}
    assert found.of("a") == {1, 2, 3, 7}


def test_cycles_are_told_from_what_is_between_them() -> None:
    edges = {"a": "b", "b": "ac", "c": "d", "d": "e", "e": "e", "f": "a"}
    assert in_cycles(edges) == {"a", "b", "e"}
