"""What comes into a model from the code is laid out as its author does it."""

from __future__ import annotations

import pytest

from rebsync.roundtrip.merge_models import Favour, merged_model
from rebsync.roundtrip.models import parsed
from rebsync.roundtrip.sides import Given
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


def given(text: str) -> Given:
    source = Source("m.rebeca", text)
    return Given(parsed(source), source)


@pytest.mark.parametrize("step", ["  ", "    ", "\t"])
def test_by_the_indentation_of_the_file_and_without_parentheses(step: str) -> None:
    base = given(BASE.replace("  ", step))
    merged = merged_model(base, base, given(CODE), Favour.MARKERS)
    assert merged.text == WANTED.replace("  ", step)
