"""What comes into a model from the code is laid out as its author does it."""

from __future__ import annotations

import pytest

from rebsync.roundtrip.diff.operands import SourcedModel
from rebsync.roundtrip.merge.models import Favour, merged_model
from rebsync.roundtrip.package.models import parsed
from rebsync.source import Source

BASE = """reactiveclass Robot(3) {
  statevars {
    int x;
  }

  Robot() {
    x = 0;
    self.go();
  }

  msgsrv go() {
    x = x + 1;
  }
}

main {
  Robot robot():();
}
"""
CODE = (
    BASE.replace("    int x;\n", "    int x;\n    int y;\n")
    .replace(
        "    x = x + 1;\n", "    if ((x == 3) && ((y) > 2)) {\n      x = ((y + 1)) * 2;\n    }\n"
    )
    .replace(
        "main {", "reactiveclass Other(1) {\n  msgsrv no() {\n    delay((1));\n  }\n}\n\nmain {"
    )
)
WANTED = (
    BASE.replace("    int x;\n", "    int x;\n    int y;\n")
    .replace("    x = x + 1;\n", "    if (x == 3 && y > 2) {\n      x = (y + 1) * 2;\n    }\n")
    .replace("main {", "reactiveclass Other(1) {\n  msgsrv no() {\n    delay(1);\n  }\n}\n\nmain {")
)


def given(text: str) -> SourcedModel:
    source = Source("m.rebeca", text)
    return SourcedModel(parsed(source), source)


@pytest.mark.parametrize("step", ["  ", "    ", "\t"])
def test_by_the_indentation_of_the_file_and_without_parentheses(step: str) -> None:
    base = given(BASE.replace("  ", step))
    merged = merged_model(base, base, given(CODE), Favour.MARKERS)
    assert merged.text == WANTED.replace("  ", step)


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("x < 0 || x > 9", "x < 0 || x > 9 || x == 5"),
        ("x > 1 && x < 5", "x > 1 && x < 5 && x != 3"),
        ("x + 1 > 3", "x + 1 + 2 * x > 3"),
        ("x - 1 > 3", "x - (1 - x) > 3"),
        ("x * 2 > 3", "(x + 1) * 2 > 3"),
        ("x * 2 > 3", "x * (2 + x) > 3"),
        ("!(x > 3)", "!(x > 4)"),
        ("-x > 3", "-(x + 1) > 3"),
    ],
)
def test_parts_of_an_expression_have_no_more_parentheses_than_they_need(
    before: str, after: str
) -> None:
    text = BASE.replace("x = x + 1;", f"if ({before}) x = 1;")
    base = given(text)
    wanted = text.replace(f"if ({before})", f"if ({after})")
    merged = merged_model(base, base, given(wanted), Favour.MARKERS)
    assert merged.text == wanted
