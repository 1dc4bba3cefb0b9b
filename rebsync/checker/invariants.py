"""Which predicates a search looks at in every state."""

from __future__ import annotations

from rebsync.checker.formulas import Atom, NamedFormula, atoms
from rebsync.checker.program import Program

MAY_FAIL = ("DIV", "MOD", "OFFSET")  # instructions after which a predicate may have no value


def invariants_of(
    program: Program, assertions: tuple[NamedFormula, ...], formulas: tuple[NamedFormula, ...]
) -> tuple[int, ...]:
    """The predicates of assertions, and all that may have no value."""
    everywhere = [*asserted(assertions)]
    for formula in formulas[len(assertions) :]:
        for number in predicates_of(formula):
            body = program.bodies[program.predicates[number]]
            if any(i.op in MAY_FAIL for i in program.code[body.entry : body.end]):
                everywhere.append(number)
    return tuple(dict.fromkeys(everywhere))


def asserted(assertions: tuple[NamedFormula, ...]) -> dict[int, None]:
    """The predicates that assertions are."""
    return {f.formula.predicate: None for f in assertions if isinstance(f.formula, Atom)}


def predicates_of(formula: NamedFormula) -> tuple[int, ...]:
    """The numbers of the predicates in a formula."""
    return tuple(atoms(formula.formula))
