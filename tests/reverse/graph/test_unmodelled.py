"""What has no place in a model and is listed beside the facts, in code whose comments say it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from rebsync.reverse.calls.ros_calls import Asking
from rebsync.reverse.graph import Graph, UnmodelledFact
from rebsync.reverse.python.values.py_unmodelled import whole_graph
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import parse
from rebsync.reverse.syntax.py_index import PyCode
from rebsync.reverse.syntax.py_tree import parse as parse_python
from rebsync.source import Source

CASES = sorted((Path(__file__).parent / "unmodelled_cases").iterdir())


def _graph(source: Source) -> Graph:
    if source.path.endswith(".py"):
        return whole_graph(PyValues(PyCode.of([parse_python(source)])))
    return Asking(Code.of([parse(source)])).graph


def _noted(fact: UnmodelledFact) -> str:
    given = [json.dumps(v) for v in (fact.name, fact.type) if v is not None]
    return " ".join([f"{fact.site.owner} {fact.what.value} {fact.site.kept}", *given]).rstrip()


@pytest.mark.parametrize("case", CASES, ids=lambda p: p.name)
def test_what_is_listed_is_what_the_comments_say(case: Path) -> None:
    source = Source(case.name, case.read_text(encoding="utf-8"))
    lines = enumerate(source.text.splitlines(), 1)
    said = [f"{n}: {line.partition('#=')[2] or line.partition('//=')[2]}" for n, line in lines]
    expected = [s.replace(":  ", ": ", 1) for s in said if not s.endswith(": ")]
    found = [f"{u.site.place.line}: {_noted(u)}" for u in _graph(source).unmodelled]
    assert found == expected
