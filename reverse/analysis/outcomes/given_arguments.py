"""What a function does with None or too few elements that it gets, seen from each of its calls.

A place that asks something of a parameter fails where a call gives no such thing for it: a summary
of the function by its parameters, which each call evaluates with what it gives (Sharir, Pnueli
1981).
"""

from __future__ import annotations

from dataclasses import replace
from itertools import dropwhile

from rebsync.reverse.analysis.facts import Facts
from rebsync.reverse.analysis.outcomes.outcome_expressions import OutcomeExpressions
from rebsync.reverse.analysis.problems import NOTHING_THERE, ParameterNeed, Problem
from rebsync.reverse.analysis.python.call_binding import bound
from rebsync.reverse.ir import statements as s
from rebsync.reverse.ir.program import Function


class GivenArguments:
    """What one call gives for the parameters of a function that it runs."""

    def __init__(
        self,
        expressions: OutcomeExpressions,
        call: s.Call | s.Construct,
        called: Function,
        facts: Facts,
    ) -> None:
        self._expressions = expressions
        self._none = expressions.none
        self._facts = facts
        self._called = called
        self._values = bound(call, called)
        behind = dropwhile(lambda a: not a.stars, call.arguments)
        self._behind = [a.value for a in behind if a.name is None and not a.stars]

    def __call__(self, problem: Problem) -> frozenset[Problem]:
        """What a problem of the function is for the one that calls it."""
        if problem.given is None:
            return frozenset({problem})
        name = problem.given.parameter
        if problem.given.size:
            return self._sized(problem, problem.given)
        if name not in self._values:
            is_none = self._none.is_default(self._called.name, name)
            is_none |= any(self._none.may_be(value, self._facts) for value in self._behind)
            return frozenset({problem.of_call()} if is_none else ())
        value, pointers = self._values[name], self._expressions.undefined.pointers
        asked = pointers if problem.why == NOTHING_THERE else self._none
        if asked.may_be(value, self._facts):
            return frozenset({problem.of_call()})
        given = asked.given(value, self._facts)
        return frozenset() if given is None else frozenset({replace(problem, given=given)})

    def _sized(self, problem: Problem, given: ParameterNeed) -> frozenset[Problem]:
        """What a problem is that is one where there are too few elements."""
        value = self._values.get(given.parameter)
        if value is None:
            return frozenset({problem.of_call()})
        divides = problem.raises == "builtins.ZeroDivisionError"
        if self._expressions.size(value, self._facts) >= given.size:
            if divides or self._expressions.is_sequence(value):
                return frozenset()
            return frozenset({problem.of_call()})
        of = self._expressions.sized_by_caller(value, given.size)
        return frozenset({problem.of_call() if of is None else replace(problem, given=of)})


def with_none(problem: Problem) -> frozenset[Problem]:
    """What a problem of a function is for a call that may give None for any parameter."""
    return frozenset({problem if problem.given is None else problem.of_call()})
