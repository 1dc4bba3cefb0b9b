"""Writing whole state spaces: `--states` and `--export` of `rebsync verify`."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from rebsync.cli.options import write_output, write_pieces
from rebsync.terminal import say

if TYPE_CHECKING:
    from rebsync.checker.problem import Options, Problem
    from rebsync.checker.show.space import StateSpace

SUFFIXES = (".dot", ".svg", ".json")


def check_name(path: str | None, output: str) -> None:
    """A UsageError when a file name does not say how to draw a state space, or is the output's."""
    if path is None:
        return
    if Path(path).suffix not in SUFFIXES:
        raise click.UsageError(
            f'--states takes a file that ends in {", ".join(SUFFIXES)}: "{path}"'
        )
    if Path(path) == Path(output):
        raise click.UsageError(f'--states and --output name one file: "{path}"')


def write_space(
    problem: Problem, options: Options, states: str | None, exported: str | None
) -> bool:
    """Draws the state space to the file `states`, and exports it in RMC's format to `exported`.

    The interpreter makes it. False if a bound has left out a part.
    """
    from rebsync.checker.choosing import semantics_for
    from rebsync.checker.formulas import Atom
    from rebsync.checker.lowering import lower
    from rebsync.checker.search import Interpreted
    from rebsync.checker.show.rmc_xml import rmc_xml
    from rebsync.checker.spaces import space_of
    from rebsync.checker.telling import Teller
    from rebsync.cli.progress import progress

    program, formulas = lower(problem.analysis, problem.properties)
    semantics = options.semantics or semantics_for(program, problem)
    search = Interpreted(program, semantics)
    limits = options.limits
    if states is not None and states.endswith(".svg") and exported is None:
        from rebsync.checker.show.space_svg import LARGEST

        limits = replace(limits, states=min(limits.states or LARGEST + 1, LARGEST + 1))
    with progress(sys.stderr) as report:
        found = search.run(limits, report)
    invariants = {f.formula.predicate: f.name for f in formulas if isinstance(f.formula, Atom)}
    space = space_of(search, Teller(search.view, problem.source), invariants)
    if states is not None:
        write_pieces(states, _drawn(space, Path(states).suffix))
    if exported is not None:
        write_output(exported, rmc_xml(space, program))
    if found.reason is not None:
        say(f"this is not the whole state space: {found.reason}", err=True)
    return found.reason is None


def _drawn(space: StateSpace, suffix: str) -> Iterable[str]:
    if suffix == ".svg":
        from rebsync.checker.show.space_svg import space_svg

        return (space_svg(space),)
    from rebsync.checker.show.space import space_dot_pieces, space_json_pieces

    return space_dot_pieces(space) if suffix == ".dot" else space_json_pieces(space)
