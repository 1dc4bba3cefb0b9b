"""A model as a language module of LTSmin: C of one file, behind PINS.

The Partitioned Next-State Interface (Blom, van de Pol & Weber 2010) is what the engines of LTSmin
take a model by. What the module does is in templates/pins.c, on the kernel of templates/kernel.h.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator
from pathlib import PurePath

from rebsync import properties as p
from rebsync.checker.build import header
from rebsync.checker.compile_model import ModelText, rendered
from rebsync.checker.invariants import predicates_of
from rebsync.checker.lowering import lower
from rebsync.checker.marking import is_truth
from rebsync.checker.problem import Problem
from rebsync.checker.steps import Semantics
from rebsync.model import Name

_OURS = re.compile(r'#include "(.+)"\n')


def pins_module(problem: Problem, semantics: Semantics) -> str:
    """The text of the module; it includes nothing but the headers of LTSmin and of C.

    Its state labels are the assertions and the definitions that are true or false, by their names.
    """
    program, formulas = lower(problem.analysis, _labels(problem))
    atoms = [(each.name, number) for each in formulas for number in predicates_of(each)]
    rebecs = [rebec.name for rebec in program.rebecs]
    names = {
        "semantics": semantics.upper(),
        "status": _literal(_unused("status", [name for name, _ in atoms])),
        "model": _literal(PurePath(problem.source.path).name),
        "slots": ", ".join(_literal(f"local {name}") for name in rebecs),
        "actors": ", ".join(map(_literal, (*rebecs, "time passes"))),
        "atoms": [(_literal(name), number) for name, number in atoms],
    }
    parts = ModelText(program).render(), rendered(header("pins.h.j2"), names), header("pins.c")
    included = set[str]()
    return "".join(_in_one(part, included) for part in parts)


def _labels(problem: Problem) -> p.Properties:
    """Each assertion, and each definition that is true or false as one."""
    given = problem.properties
    names = {each.name for each in given.assertions}
    truths = (d for d in given.defines if d.name not in names and is_truth(problem, d))
    defined = (p.Property(d.name, Name(d.name), d.span) for d in truths)
    return p.Properties(given.defines, (*given.assertions, *defined))


def _unused(name: str, taken: Iterable[str]) -> str:
    while name in taken:
        name += "_"
    return name


def _literal(text: str) -> str:
    """A string of C."""
    return json.dumps(re.sub(r"[^ -~]", "_", text))


def _in_one(text: str, included: set[str]) -> str:
    """A text of C with what it includes of ours in its place, each file once."""
    return "".join(_pieces(text, included))


def _pieces(text: str, included: set[str]) -> Iterator[str]:
    at = 0
    for found in _OURS.finditer(text):
        yield text[at : found.start()]
        at = found.end()
        if found[1] not in included:
            included.add(found[1])
            yield _in_one(header(found[1]), included)
    yield text[at:]
