"""What Python asks of ROS, in small pieces of code whose comments say it."""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.reverse.findings import Findings
from rebsync.reverse.python.recovery import PythonCode, read_python
from rebsync.reverse.python.values.py_calls import graph_with
from rebsync.reverse.python.values.py_values import PyValues
from rebsync.reverse.syntax.py_index import PyCode
from rebsync.reverse.syntax.py_tree import parse, unparsed
from rebsync.source import Source
from tests.reverse.graph.notation import noted

CASES = Path(__file__).parent / "cases"


def _files(case: Path) -> dict[str, str]:
    paths = [case] if case.is_file() else sorted(case.rglob("*.py"))
    return {p.relative_to(CASES).as_posix(): p.read_text(encoding="utf-8") for p in paths}


def _said(files: dict[str, str]) -> list[str]:
    """The facts that comments say after `#=`, several of one line split by `//=`."""
    found = []
    for path, text in files.items():
        for number, line in enumerate(text.splitlines(), 1):
            for said in line.partition("#=")[2].split("//="):
                if said:
                    found.append(f"{path}:{number}: {said.strip()}")
    return found


@pytest.mark.parametrize("case", sorted(CASES.iterdir()), ids=lambda p: p.stem)
def test_what_is_found_is_what_the_comments_say(case: Path) -> None:
    files = _files(case)
    trees = [parse(Source(path, text)) for path, text in files.items()]
    assert [unparsed(py) for py in trees] == [[] for _ in trees]
    found = [
        f"{f.site.place.source.path}:{f.site.place.line}: {noted(f)}"
        for f in graph_with(PyValues(PyCode.of(trees))).facts
    ]
    assert found == _said(files)


def test_what_is_no_python_is_listed_and_the_rest_is_read() -> None:
    text = "import rospy\nrospy.init_node('n')\ndef f(:\n  x = = 1\n"
    findings = Findings()
    graph = read_python(PythonCode.of({"a.py": Source("a.py", text)}, findings), findings).graph
    assert [noted(f) for f in graph.facts] == ['node "n"']
    assert "this is no Python that can be read" in {f.why for f in findings.all}


def test_places_count_characters() -> None:
    text = "import rospy\nname = 'é€'; rospy.init_node('n')\n"
    fact = graph_with(PyValues(PyCode.of([parse(Source("a.py", text))]))).facts[0]
    assert fact.site.place.source.slice(fact.site.place.span) == "init_node('n')"


def test_cycles_end() -> None:
    text = (
        "import rospy\nclass A(B): pass\nclass B(A):\n  def f(self):\n"
        "    self.x = self.x + 'a'\n    return self.f()\n"
        "a = b\nb = a\nrospy.Publisher(a + A().f() + B().x, a)\n"
    )
    (fact,) = graph_with(PyValues(PyCode.of([parse(Source("a.py", text))]))).facts
    assert noted(fact).startswith("publisher ?")
