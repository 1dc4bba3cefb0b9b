"""A fifth client library is one table: nodes that use it are extracted, in C++ and in Python.

`mesh.py` is all that there is of it; the packages in `cases` were written by hand, each with the
model and the findings that come out. `cpp` and `py` do the same, as `cpp_derived` and `py_derived`.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from rebsync.printing import print_model
from rebsync.reverse.files.reading import chosen
from rebsync.reverse.libraries import registry, tables
from rebsync.reverse.libraries.effects import of_function
from rebsync.reverse.libraries.registry import beside
from rebsync.reverse.libraries.routines import Effect, Language
from rebsync.reverse.recovery import Extracted, extract
from rebsync.source import Source
from tests.reverse.libraries import mesh

CASES = Path(__file__).with_name("cases")
NAMES = ("cpp", "cpp_derived", "py", "py_derived")


def extracted(name: str) -> Extracted:
    return extract(chosen(str(CASES / name)).files)


def said(found: Extracted) -> str:
    """The findings, one a line."""
    lines = (
        f"{f.grade.value} {f.source.position(f.span.start).line}: {f.why}\n" for f in found.findings
    )
    return "".join(sorted(lines))


@pytest.mark.parametrize("name", NAMES)
def test_nodes_are_extracted_with_one_table(name: str) -> None:
    with beside(*mesh.LIBRARIES):
        found = extracted(name)
    assert print_model(found.model) == (CASES / name / "expected.rebeca").read_text()
    assert said(found) == (CASES / name / "findings.txt").read_text()


@pytest.mark.parametrize("name", NAMES)
def test_without_the_table_nothing_is_asked_for(name: str) -> None:
    assert not extracted(name).model.classes


@pytest.mark.parametrize("name", NAMES)
def test_what_the_table_does_not_have_is_listed(name: str) -> None:
    with beside(*mesh.LIBRARIES):
        files = dict(chosen(str(CASES / name)).files)
        path, before = next((p, s) for p, s in files.items() if "log_info" in s.text)
        files[path] = Source(before.path, before.text.replace("log_info", "stop"))
        found = extract(files)
    assert "unreadable" in {f.grade.value for f in found.findings}


def test_a_module_among_the_tables_is_found(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copy(mesh.__file__, tmp_path)
    monkeypatch.setattr(tables, "__path__", [*tables.__path__, str(tmp_path)])
    with beside():
        assert "mesh" in {library.name for library in registry.libraries(Language.CPP)}
        assert extracted("cpp").model.classes
    monkeypatch.undo()
    with beside():
        assert "mesh" not in {library.name for library in registry.libraries(Language.CPP)}


def test_the_table_is_short_and_says_what_calls_do() -> None:
    assert len(Path(mesh.__file__).read_text().splitlines()) < 200
    with beside(*mesh.LIBRARIES):
        for language, pause in ((Language.CPP, "mesh::pause"), (Language.PYTHON, "mesh.pause")):
            assert of_function(language, pause).effect is Effect.TIME
        assert of_function(Language.PYTHON, "mesh.time").is_pure
    assert of_function(Language.CPP, "mesh::pause").effect is Effect.UNKNOWN
