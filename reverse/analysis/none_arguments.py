"""What a function does with None that it gets for a parameter, seen from each of its calls.

A place that asks something of a parameter fails where a call gives None for that: a summary of the
function by its parameters, which each call evaluates with what it gives (Sharir, Pnueli 1981).
"""

from __future__ import annotations

from dataclasses import replace

from rebsync.reverse.analysis.facts import Facts
from rebsync.reverse.analysis.none_values import NoneValues
from rebsync.reverse.analysis.problems import Problem
from rebsync.reverse.ir import expressions as e
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import Function, ParameterKind


class NoneArguments:
    """What one call gives for the parameters of a function that it runs."""

    def __init__(
        self, none: NoneValues, call: s.Call | s.Construct, called: Function, facts: Facts
    ) -> None:
        self._none = none
        self._facts = facts
        self._called = called
        self._values = _bound(call, called)
        self._is_whole = not any(a.stars for a in call.arguments)

    def __call__(self, problem: Problem) -> frozenset[Problem]:
        """What a problem of the function is for the one that calls it."""
        if problem.given is None:
            return frozenset({problem})
        name = problem.given.parameter
        if name not in self._values:
            is_none = self._is_whole and self._none.is_default(self._called.name, name)
            return frozenset({_own(problem)} if is_none else ())
        value = self._values[name]
        if self._none.may_be(value, self._facts):
            return frozenset({_own(problem)})
        given = self._none.given(value, self._facts)
        return frozenset() if given is None else frozenset({replace(problem, given=given)})


def with_none(problem: Problem) -> frozenset[Problem]:
    """What a problem of a function is for a call that may give None for any parameter."""
    return frozenset({problem if problem.given is None else _own(problem)})


def _own(problem: Problem) -> Problem:
    """A problem of a call, whatever the function that it calls is given by others."""
    return replace(problem, given=None, is_of_call=True)


def _bound(call: s.Call | s.Construct, called: Function) -> dict[str, e.Expression]:
    """The arguments of a call by the parameters that they are for."""
    plain = (ParameterKind.PLAIN, ParameterKind.BY_PLACE)
    places = [p.name for p in called.parameters if p.kind in plain]
    is_function = isinstance(call, s.Call) and isinstance(call.callee, s.FunctionCallee)
    if called.receiver is not None and not is_function:
        places = [name for name in places if name != called.receiver]
    by_place = [a.value for a in call.arguments if a.name is None and not a.stars]
    by_name = {a.name: a.value for a in call.arguments if a.name is not None}
    return {**dict(zip(places, by_place, strict=False)), **by_name}


