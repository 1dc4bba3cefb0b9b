"""Which view of a model is searched where nobody chose one."""

from __future__ import annotations

from rebsync.checker.problem import Problem
from rebsync.checker.program import Program
from rebsync.checker.steps import Semantics


def semantics_for(program: Program, problem: Problem) -> Semantics:
    """The floating view if the model has no `delay`; what counts steps or time needs the exact.

    Without `delay` the two views differ only by steps of time (FACS 2015).
    """
    from rebsync.checker.lowering.temporal import counts_steps

    properties = problem.properties
    exact = (
        program.has_delay
        or properties.tctl
        or problem.between
        or any(counts_steps(p.formula) for p in properties.ltl)
    )
    return "tts" if exact else "ftts"
