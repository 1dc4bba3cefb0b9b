"""Functions that come back with a value are known to, in both languages, and no others."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from rebsync.reverse.analysis.outcomes.outcomes import OutcomeAnalysis
from rebsync.reverse.analysis.problems import NOTHING_THERE
from rebsync.reverse.ir.cpp.lowering import program_of
from rebsync.reverse.ir.python.lowering import python_program
from rebsync.reverse.libraries.outcomes import LibraryOutcomes
from rebsync.reverse.libraries.routines import Language
from rebsync.reverse.syntax.cpp_index import Code
from rebsync.reverse.syntax.cpp_tree import parse as parse_cpp
from rebsync.reverse.syntax.py_index import PyCode
from rebsync.reverse.syntax.py_tree import parse as parse_python
from rebsync.source import Source

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

_HERE = Path(__file__).parent / "outcomes"
_GOT = (-1000, -7, -1, 0, 1, 2, 3, 10, 20, 100)  # what sensors get
# Where an index is within bounds, or a key there, for a reason that no analysis here has.
_NOT_SHOWN = frozenset(
    (name, "cpp") for name in ("map_tested", "counted_loop", "median_of_deque", "ring_buffer")
)
_DEFINED = re.compile(r"#define (\w+)")


def _cases(file: str) -> list[tuple[str, str, str]]:
    """Name, dialect or language, text."""
    table = tomllib.loads((_HERE / file).read_text("utf-8"))
    return [(name, key, text) for name, of in table.items() for key, text in of.items()]


def _problems(key: str, text: str) -> list[str]:
    """What the function of a text may do besides giving a value."""
    if key.endswith("cpp"):
        code = Code.of([parse_cpp(Source("sensors.h", text))])
        table = LibraryOutcomes(Language.CPP, frozenset(_DEFINED.findall(text)))
        found = OutcomeAnalysis(program_of(code), table, lambda _: False).of("seenS11")
    else:
        program = python_program(PyCode.of([parse_python(Source("sensors.py", text))]))
        table = LibraryOutcomes(Language.PYTHON)
        found = OutcomeAnalysis(program, table, lambda _: False).of("sensors.py:seen_S11")
    return sorted(p.why for p in found)


@pytest.mark.parametrize(("name", "key", "text"), _cases("harmless.toml"))
def test_harmless_functions_are_known(name: str, key: str, text: str) -> None:
    known = [NOTHING_THERE] if (name, key) in _NOT_SHOWN else []
    assert _problems(key, text) == known


@pytest.mark.parametrize(("name", "key", "text"), _cases("harmful.toml"))
def test_other_functions_are_listed(name: str, key: str, text: str) -> None:
    assert _problems(key, text) != []


_RUN = [case for case in _cases("harmless.toml") if case[1] == "py"]


@pytest.mark.parametrize(("name", "key", "text"), _RUN)
def test_harmless_functions_come_back(name: str, key: str, text: str) -> None:
    space: dict[str, object] = {"__name__": __name__}
    exec(compile("from __future__ import annotations\n" + text, name, "exec"), space)
    seen = space["seen_S11"]
    assert callable(seen)
    for data in (*_GOT, *reversed(_GOT)):
        assert isinstance(seen(SimpleNamespace(data=data)), int)
