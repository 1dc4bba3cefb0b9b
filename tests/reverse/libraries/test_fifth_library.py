"""A fifth client library is one table: nodes that use it are extracted, in C++ and in Python.

`mesh.py` is all that there is of it. `cases/cpp` and `cases/py` do the same, written by hand.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from rebsync.printing import print_model
from rebsync.reverse.files.reading import chosen
from rebsync.reverse.libraries.effects import of_function, of_method
from rebsync.reverse.libraries.registry import beside
from rebsync.reverse.libraries.routines import Effect, Language
from rebsync.reverse.recovery import Extracted, extract
from rebsync.source import Source
from tests.reverse.libraries import mesh

CASES = Path(__file__).with_name("cases")
_LIMITS = {"cpp": ("Relay(int limit_given) {", "(sink):(3)"), "py": ("limit = 3;", "(sink):()")}
_LISTED = {
    'nobody in these files publishes "/in": the model gets no such message',
    "objects of one program take turns; in the model they act by themselves",
    "objects of one program may take turns; in the model they act by themselves",
}


def extracted(name: str) -> Extracted:
    return extract(chosen(str(CASES / name)).files)


@pytest.mark.parametrize("name", ["cpp", "py"])
def test_nodes_are_extracted_with_one_table(name: str) -> None:
    with beside(*mesh.LIBRARIES):
        found = extracted(name)
    text = print_model(found.model)
    assert [c.name for c in found.model.classes] == ["Relay", "Sink"]
    for part in (
        "msgsrv on(int data) {\n    if (data < limit) {\n      count = data;\n    }\n  }",
        "self.tick() after(2);",
        f"msgsrv tick() {{\n    sink.{'sub' if name == 'cpp' else 'on'}(count);",
        f"msgsrv {'sub' if name == 'cpp' else 'on'}(int data) {{\n    last = data;",
        *_LIMITS[name],
    ):
        assert part in text
    assert {f.why for f in found.findings} <= _LISTED
    assert {f.grade.value for f in found.findings} == {"over-approximated"}


@pytest.mark.parametrize("name", ["cpp", "py"])
def test_without_the_table_nothing_is_asked_for(name: str) -> None:
    assert not extracted(name).model.classes


@pytest.mark.parametrize("name", ["cpp", "py"])
def test_what_the_table_does_not_have_is_listed(name: str) -> None:
    with beside(*mesh.LIBRARIES):
        files = dict(chosen(str(CASES / name)).files)
        path, before = next((p, s) for p, s in files.items() if "relay." in p)
        changed = before.text.replace("log_info", "stop")
        files[path] = Source(before.path, changed)
        found = extract(files)
    assert changed != before.text
    assert "unreadable" in {f.grade.value for f in found.findings}


def test_the_table_is_short_and_says_what_calls_do() -> None:
    assert len(Path(mesh.__file__).read_text().splitlines()) < 200
    with beside(*mesh.LIBRARIES):
        for language, pause in ((Language.CPP, "mesh::pause"), (Language.PYTHON, "mesh.pause")):
            assert of_function(language, pause).effect is Effect.TIME
        assert of_method(Language.CPP, "mesh::Publisher", "put").effect is Effect.SENDS
        assert of_function(Language.PYTHON, "mesh.time").is_pure
    assert of_function(Language.CPP, "mesh::pause").effect is Effect.UNKNOWN
