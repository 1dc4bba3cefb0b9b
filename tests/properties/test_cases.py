"""`cases/*.property`, checked against `cases/model.rebeca`.

What must be found stands behind the line that it is found on: `// E: RS901 message begins so`,
or `// W:` for a warning. Nothing else may be found.
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest

from rebsync.codes import PROPERTIES
from rebsync.diagnostics import Diagnostic, Severity
from rebsync.edits import apply_edits, certain_edits
from rebsync.files import read_source
from rebsync.grammars.parser import parse_model
from rebsync.grammars.properties import parse_properties
from rebsync.lint import lint
from rebsync.property_check import check_properties
from rebsync.source import Source
from rebsync.static import Analysis, analyse

FOLDER = Path(__file__).parent / "cases"
CASES = sorted(FOLDER.glob("*.property"))
EXPECTED = re.compile(r"// ([EW]): (RS\d+) ?(.*)")


@cache
def analysis() -> Analysis:
    """The model that all cases speak of."""
    found = analyse(parse_model(read_source(str(FOLDER / "model.rebeca"))).model)
    assert not found.errors
    return found


def findings(source: Source) -> tuple[Diagnostic, ...]:
    """Everything that is found in a property file."""
    parsed = parse_properties(source)
    checked = check_properties(parsed.properties, analysis(), incomplete=not parsed.complete)
    return (*parsed.diagnostics, *checked)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.stem)
def test_findings(case: Path) -> None:
    source = read_source(str(case))
    wanted = [
        (number, *match.groups())
        for number, line in enumerate(source.text.splitlines(), start=1)
        for match in EXPECTED.finditer(line)
    ]
    found = sorted(
        (
            source.position(d.span.start).line,
            "EW"[d.severity is Severity.WARNING],
            d.code,
            d.message,
        )
        for d in findings(source)
    )
    assert [f[:3] for f in found] == [w[:3] for w in wanted]
    for seen, expected in zip(found, wanted, strict=True):
        assert str(seen[3]).startswith(str(expected[3]))


def test_the_notation_of_other_checkers_is_answered_with_ours() -> None:
    found = findings(read_source(str(FOLDER / "foreign.property")))
    hints = [d.hint or "" for d in found]
    assert all("G(p)" in hint or "AG(" in hint for hint in hints), hints
    assert not any(d.edits for d in found)


def test_every_code_has_a_case() -> None:
    text = "".join(case.read_text(encoding="utf-8") for case in CASES)
    assert set(PROPERTIES) - {"RS911"} <= set(re.findall(r"RS9\d\d", text))


def test_the_slips_of_the_thesis_have_certain_corrections() -> None:
    source = read_source(str(FOLDER / "thesis.property"))
    mended = apply_edits(source.text, certain_edits(parse_properties(source).diagnostics))
    assert "Collision_Avoidance: !(xPos" in mended
    assert not findings(Source(source.path, mended))


def test_without_its_model_a_property_file_is_only_read(tmp_path: Path) -> None:
    alone = tmp_path / "alone.property"
    alone.write_text("property { Assertion { a: nobody.x; } }")
    (found,) = lint(read_source(str(alone))).diagnostics
    assert found.code == "RS911"


def test_hints() -> None:
    text = (
        "property { Assertion { a: robot1.mving; b: fuel > 1; c: AG(true); } LTL { d: Gx(true); } }"
    )
    hints = [d.hint for d in findings(Source("hints.property", text))]
    assert sorted(hint for hint in hints if hint) == [
        'did you mean "moving"?',
        "it belongs into TCTL { ... }",
        "known here: G, F, X, U, W",
        "write robot1.fuel",
    ]


def test_a_formula_too_deep_is_said_so() -> None:
    text = "property { Assertion { a: " + "!" * 3000 + "true; } }"
    assert "RS111" in {d.code for d in findings(Source("deep.property", text))}
